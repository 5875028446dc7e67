"""The one progress callback of public functions: ``progress(done, total, text)``."""

from __future__ import annotations

import inspect
import warnings
from collections.abc import Callable
from typing import Any

__all__ = ["Progress", "as_progress", "loop_callback"]

Progress = Callable[[float, float, str], None]
"""Called now and then with the amount done, the total (NaN where it is not known), and the current step in words."""


def as_progress(progress: Callable[..., Any] | None, old: Callable[[float, float, str], tuple[Any, ...]]) -> Any:
    """Return a callback that is called with (done, total, text), from one that may be of the release before.

    ``old`` makes the arguments of such an older callback, which is called with a DeprecationWarning.
    """
    if progress is None or _takes(progress, 3):
        return progress
    _warn_of_older_form()
    return lambda done, total, text: progress(*old(done, total, text))


def loop_callback(progress: Callable[..., Any] | None, new: Callable[[Progress], Callable[..., Any]]) -> Any:
    """Return the callback that a loop calls with arguments of its own: ``new(progress)``, which calls it with (done, total, text).

    A callback of the release before took the loop's own arguments; it is returned as it is, with a DeprecationWarning.
    """
    if progress is None or _takes(progress, 3):
        return progress and new(progress)
    _warn_of_older_form()
    return progress


def _warn_of_older_form() -> None:
    warnings.warn(
        "progress: it is called with (done, total, text) now; the form of the last release goes with the next one",
        DeprecationWarning,
        stacklevel=5,
    )


def _takes(progress: Callable[..., Any], count: int) -> bool:
    try:
        inspect.signature(progress).bind(*[None] * count)
    except TypeError:
        return False
    except ValueError:  # a built-in without a signature
        return True
    return True
