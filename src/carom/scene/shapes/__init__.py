"""All shapes of walls, and the field that takes any of them.

A file added to this package, with a class of :class:`carom.scene.wall.WallShape` that has a ``shape``, is found here: its shape is
then in scenes, in their files, and in the explorer once its module is built anew.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated, Union

from pydantic import Field

from carom.scene.by_file import models_by_shape
from carom.scene.shapes.planes import Box, Plane, Strip, Wedge
from carom.scene.shapes.rounds import Arc, Cylinder, Sphere, Stadium
from carom.scene.shapes.segments import Polygon, Segment
from carom.scene.shapes.table import Table
from carom.scene.wall import WallShape

__all__ = [
    "SHAPES", "AnyWall", "Arc", "Box", "Cylinder", "Plane", "Polygon", "Segment", "Sphere", "Stadium", "Strip", "Table", "Wedge",
]  # fmt: skip

FIRST = (Plane, Segment, Polygon, Table, Box, Strip, Wedge, Cylinder, Arc, Sphere, Stadium)


# (in the order in which messages list them; then those of further files)
SHAPES: dict[str, type[WallShape]] = {one.model_fields["shape"].default: one for one in FIRST}
SHAPES |= models_by_shape(__name__, __path__, WallShape)
if TYPE_CHECKING:
    AnyWall = WallShape
else:
    AnyWall = Annotated[Union[tuple(SHAPES.values())], Field(discriminator="shape")]  # noqa: UP007  (made at run time)
