"""Figures of results: a result asks here for the function that draws it, and the face of the package says where that is found.

Results stand on lower floors than their figures, and know nothing of them. ``carom/__init__.py``, which stands above all rooms,
hands in how a function of ``carom.plot`` is found.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

__all__ = ["figure_maker", "find_figures_with"]

_find: list[Callable[[str], Any]] = []


def find_figures_with(find: Callable[[str], Any]) -> None:
    """Have :func:`figure_maker` find functions by their names with ``find``."""
    _find[:] = [find]


def figure_maker(name: str) -> Callable[..., Any]:
    """Return the function of that name that draws, or films, a result."""
    found: Callable[..., Any] = _find[0](name)
    return found
