"""All shapes of walls, and the field that takes any of them.

A file added to this package, with a class of :class:`carom.scene.wall.WallShape` that has a ``shape``, is found here: its shape is
then in scenes, in their files, and in the explorer once its module is built anew.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated, Any, Union

from carom.scene.presets import modules_of
from carom.scene.schema import OneOf
from carom.scene.shapes.curves import CurvedWallShape, CurveWallShape, FigureWall, OutlineWall, figure_walls
from carom.scene.shapes.planes import Box, Plane, Polygon, Segment, Strip, Wedge
from carom.scene.shapes.rounds import Arc, Cylinder, Sphere
from carom.scene.shapes.table import Table
from carom.scene.wall import WallShape

__all__ = [
    "PAGE_SHAPES", "SHAPES", "AnyWall", "Arc", "Box", "CurveWallShape", "CurvedWallShape", "Cylinder",
    "FigureWall", "OutlineWall", "Plane", "Polygon", "Segment",
    "Sphere", "Stadium", "Strip", "Table", "Wedge",
]  # fmt: skip

FIRST = (Plane, Segment, Polygon, Table, Box, Strip, Wedge, Cylinder, Arc, Sphere)


def _found() -> dict[str, type[WallShape]]:
    """Return the shapes by name: in the order in which messages list them, then the shapes of further files."""
    others: list[Any] = [x for one in modules_of(__name__, __path__) for x in vars(one).values() if isinstance(x, type)]
    walls = [one for one in others if issubclass(one, WallShape) and "shape" in one.model_fields]
    own = {one.model_fields["shape"].default: one for one in dict.fromkeys((*FIRST, *walls))}
    return own | figure_walls(tuple(own))


SHAPES = _found()
Stadium = SHAPES["stadium"]
PAGE_SHAPES = {name: shape for name, shape in SHAPES.items() if shape.in_page}
if TYPE_CHECKING:
    AnyWall = WallShape
else:
    AnyWall = Annotated[Union[tuple(SHAPES.values())], OneOf(SHAPES)]  # noqa: UP007  (made at run time)
