"""All shapes of walls, and the field that takes any of them."""

from __future__ import annotations

from typing import Annotated

from pydantic import Field

from carom.scene.planes import Box, Plane, Strip, Wedge
from carom.scene.rounds import Arc, Cylinder, Sphere, Stadium
from carom.scene.segments import Polygon, Segment
from carom.scene.table import Table

__all__ = [
    "AnyWall", "Arc", "Box", "Cylinder", "Plane", "Polygon", "Segment", "Sphere", "Stadium", "Strip", "Table", "Wedge",
]  # fmt: skip

AnyWall = Annotated[
    Plane | Segment | Polygon | Table | Box | Strip | Wedge | Cylinder | Arc | Sphere | Stadium,
    Field(discriminator="shape"),
]
