"""Functions of rooms beside or above one's own: a result asks here for them, and the face of the package says where they are found.

Results stand on lower floors than their figures, and know nothing of them; so do runs of scenes of the rims that balls roll over.
``carom/__init__.py``, which stands above all rooms, hands in how a public function of a room is found.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

_find: list[Callable[[str, str], Any]] = []


def find_functions_with(find: Callable[[str, str], Any]) -> None:
    """Have :func:`function_of` find functions by the names of their rooms and their own with ``find``."""
    _find[:] = [find]


def function_of(room: str, name: str) -> Callable[..., Any]:
    """Return the public function of a room."""
    found: Callable[..., Any] = _find[0](room, name)
    return found


def figure_maker(name: str) -> Callable[..., Any]:
    """Return the function of that name that draws, or films, a result."""
    return function_of("plot", name)
