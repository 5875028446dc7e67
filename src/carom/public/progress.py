"""The one progress callback of public functions: ``progress(done, total, text)``."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

Progress = Callable[[float, float, str], None]
"""Called now and then with the amount done, the total (NaN where it is not known), and the current step in words."""


def loop_callback(progress: Progress | None, new: Callable[[Progress], Callable[..., Any]]) -> Any:
    """Return the callback that a loop calls with arguments of its own: ``new(progress)``; None without one."""
    return progress and new(progress)
