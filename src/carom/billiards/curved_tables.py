"""Tables whose walls are smooth curves: of any outline of pieces, and of a curve by its formula."""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial
from typing import Any

from carom.billiards.boundary import Boundary, Obstacle
from carom.billiards.checks import Bounds, require_bounds
from carom.billiards.curved_region import curved_region
from carom.billiards.curved_wall import CurvedWall
from carom.billiards.tables import Table
from carom.errors import FaultList
from carom.scene.figures import Piece

__all__ = ["table_of_outline"]


def _curved_boundary(wall: CurvedWall, inset: float) -> Boundary:
    """Return the boundary of a curved wall for a centre that stays ``inset`` away from it."""
    region = curved_region(wall, inset)
    circles = len(region.reflex)
    outside = [Obstacle(x, y, inset, first, span) for x, y, first, span in region.reflex]
    # circles come before arcs among the pieces
    order = (
        None
        if region.order is None
        else [k + circles if k < len(region.arcs) else k - len(region.arcs) for k in region.order]
    )
    return Boundary(outside=outside, curve=region, order=order, size=wall.size)


def table_of_outline(
    name: str, outline: Sequence[Sequence[Piece]], sizes: dict[str, Any], bounds: Bounds = "centre"
) -> Table:
    """Return the table that loops of pieces bound, the open side on their left; the first loop is the outside.

    ``name`` and ``sizes``: what a table says of itself. Raises CaromError, one line per problem.
    """
    faults = FaultList(name)
    require_bounds(faults, bounds)
    faults.raise_if_any()
    wall = CurvedWall(name, tuple(tuple(loop) for loop in outline))
    wall.require_simple()
    return Table(name, bounds, 2, partial(_curved_boundary, wall), sizes)
