"""Functions of rooms above one's own: results stand on lower floors than their figures, and ask for them by name."""

from __future__ import annotations

import sys
from collections.abc import Callable
from typing import Any


def figure_maker(name: str) -> Callable[..., Any]:
    """Return the function of that name that draws, or films, a result."""
    found: Callable[..., Any] = getattr(sys.modules["carom"].plot, name)
    return found
