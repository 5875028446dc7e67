"""Functions of rooms above one's own: results stand on lower floors than their figures, and ask for them by name."""

from __future__ import annotations

import sys
from collections.abc import Callable
from typing import Any


def figure_maker(name: str) -> Callable[..., Any]:
    """Return the function of that name that draws, or films, a result."""
    found: Callable[..., Any] = getattr(sys.modules["carom"].plot, name)
    return found


def saved_figure(name: str, file: Any, result: Any, **options: Any) -> Any:
    """Return the figure of a result by the function of that name, and write it to ``file`` if one is given."""
    figure = figure_maker(name)(result, **options)
    if file is not None:
        figure_maker("save")(figure, file)
    return figure
