"""The table of a film: cushions between the lines at which they reflect the centres of the balls."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any

from carom.scene.shapes import Table

__all__ = ["cushions_between", "reach_of"]


def reach_of(radius: float, nose: float | None) -> float:
    """Return how far from a cushion's edge at the height ``nose`` (m) the centre of a ball is when it touches it, m."""
    return radius if nose is None or nose <= radius else math.sqrt(radius * radius - (nose - radius) ** 2)


def cushions_between(lines: Mapping[str, float], radius: float, nose: float | None, **surface: Any) -> Table:
    """Return the table whose cushions reflect the centres of balls at lines: left, right, bottom, top, m."""
    reach = reach_of(radius, nose)
    x0, x1 = lines["left"] - reach, lines["right"] + reach
    y0, y1 = lines["bottom"] - reach, lines["top"] + reach
    return Table(length=x1 - x0, width=y1 - y0, center=((x0 + x1) / 2, (y0 + y1) / 2), nose_height=nose, **surface)
