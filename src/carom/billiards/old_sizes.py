"""Names of a table's sizes in the release before, such as ``major`` and ``minor`` of an ellipse."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from carom.public.renamed import warn_of_rename

__all__ = ["OLD_SIZES", "new_sizes", "old_paths", "with_new_sizes"]

# Sizes that are components of a vector now.
VECTORS = {
    "ellipse": ("half_axes", {"major": 1.0, "minor": 0.8}),
    "rectangle": ("size", {"width": 2.0, "height": 1.0}),
    "box": ("size", {"width": 1.0, "height": 1.0, "depth": 1.0}),
}
SINGLE = {"vertices": "points", "angle_deg": "angle"}
OLD_SIZES = (
    "radius", "major", "minor", "straight", "sides", "vertices", "width", "height", "depth", "angle", "side", "period", "distance",
)  # fmt: skip


def new_sizes(table: str, given: Mapping[str, Any]) -> tuple[str, dict[str, Any], dict[str, str]]:
    """Return a figure's name and its sizes by the names of today, and what was renamed: old -> new."""
    over, colon, flat = table.partition(":")
    kind = flat if over == "cylinder" and colon else over
    sizes, renamed = dict(given), {}
    if kind == "polygon" and not {"points", "vertices"} & set(sizes) and (colon == "" or kind == flat):
        table, renamed = table.replace("polygon", "regular"), {"polygon without points": "regular"}
    for old, new in SINGLE.items():
        if old in sizes:
            renamed[old], sizes[new] = new, sizes.pop(old)
    field, parts = VECTORS.get(kind, ("", {}))
    if found := [old for old in parts if old in sizes]:
        renamed |= dict.fromkeys(found, field)
        sizes[field] = tuple(sizes.pop(old, usual) for old, usual in parts.items())
    return table, sizes, renamed


def with_new_sizes(where: str, table: str, given: Mapping[str, Any]) -> tuple[str, dict[str, Any]]:
    """Return a figure's name and its sizes by the names of today, with a warning for each old one."""
    name, sizes, renamed = new_sizes(table, given)
    for old, new in renamed.items():
        warn_of_rename(f"{where}: {old}", new, 5)
    return name, sizes


def old_paths(kind: str) -> dict[str, str]:
    """Return the paths to a table's sizes in a sweep, by their names in the release before: old -> new."""
    field, parts = VECTORS.get(kind, ("", {}))
    components = {old: f"table.{field}.{axis}" for old, axis in zip(parts, "xyz", strict=False)}
    return {name: f"table.{SINGLE.get(name, name)}" for name in OLD_SIZES} | components
