"""Tables by name and sizes, as the command line and sweeps name them."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any

from carom.billiards import periodic_tables, solids, tables
from carom.billiards.tables import Table
from carom.errors import CaromError, Fault

__all__ = ["SIZES", "named_table"]

# The sizes that each table uses.
SIZES = {
    "circle": ("radius",),
    "ellipse": ("major", "minor"),
    "stadium": ("straight", "radius"),
    "polygon": ("sides", "radius", "vertices"),
    "rectangle": ("width", "height"),
    "strip": ("width", "acceleration"),
    "wedge": ("angle",),
    "sinai": ("radius", "side"),
    "periodic-strip": ("period", "width", "radius"),
    "sphere": ("radius",),
    "box": ("width", "height", "depth"),
    "plates": ("distance", "acceleration"),
}


def named_table(kind: str, sizes: Mapping[str, Any], bounds: Any = "centre") -> Table:  # noqa: PLR0911  (one return per table)
    """Return a table by its name, one of SIZES, and its sizes (m; a wedge's angle in degrees); what is left out is about 1 m.

    Raises CaromError for a size that no such table has.
    """
    given, b = dict(sizes), {"bounds": bounds}
    if kind == "polygon":
        if "vertices" in given:
            if len(given) > 1:
                others = " and ".join(name for name in given if name != "vertices")
                raise CaromError(Fault("polygon", "vertices", "no other size with it", f"{others}"))
            return tables.polygon(given["vertices"], **b)
        return tables.regular(given.pop("sides", 3), **given, **b)
    if kind == "wedge":
        angle = given.get("angle", 40.0)
        if not 0 < angle < 180:
            raise CaromError(Fault("wedge", "angle", "degrees > 0 and < 180", f"{angle:g}"))
        return tables.wedge(math.radians(angle), **b)
    if kind == "periodic-strip":
        r = given.pop("radius", 0.2)
        return periodic_tables.periodic_strip(**given, scatterers=((0.0, 0.0, r),), **b)
    if kind == "box":
        return solids.box([given.get(key, 1.0) for key in ("width", "height", "depth")], **b)
    if kind == "plates":
        g = given.pop("acceleration", 0.0)
        return solids.plates(**given, acceleration=(0.0, g), **b)
    module: Any = {"sinai": periodic_tables, "sphere": solids}.get(kind, tables)
    return getattr(module, kind)(**given, **b)  # type: ignore[no-any-return]
