"""Containers by the names of the release before: the size of the box around a round shape, a wedge, scatterers."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any

from carom.errors import CaromError, Fault
from carom.public.renamed import warn_of_rename

__all__ = ["with_new_container"]

ROUND = {"circle": 2, "cylinder": 3, "sphere": 3, "ellipse": 2, "stadium": 2, "wedge": 2}


def with_new_container(given: Mapping[str, Any], where: str = "container") -> dict[str, Any]:
    """Return the fields of a container by the names of today, with a warning for each old one."""
    found, shape = dict(given), given.get("shape")
    if "scatterers" in found:
        warn_of_rename(f"{where}: scatterers", "obstacles", 6)
        found["obstacles"] = found.pop("scatterers")
    size = found.get("size")
    if shape not in {*ROUND, "polygon"} or size is None:
        return found
    try:
        lengths = [float(x) for x in size]
    except (TypeError, ValueError):  # (units: a file of today has them as well)
        return found
    least = ROUND.get(str(shape), 0)
    if not all(x > 0 for x in lengths) or (least and not least <= len(lengths) <= 3):
        return found
    del found["size"]
    new = _sizes(where, str(shape), lengths)
    if both := [one for one in new if one in found and one != "shape"]:
        raise CaromError(Fault(where, "size", f"{both[0]} alone", "both", f"size of shape {shape} is its old name"))
    if new:
        warn_of_rename(f"{where}: size (of shape {shape})", " and ".join(one for one in new if one != "shape"), 6)
    return {**found, **new}


def _sizes(where: str, shape: str, size: list[float]) -> dict[str, Any]:
    """Return the sizes of a shape in the box around it, and its name of today."""
    if shape == "polygon":
        return {"height": size[-1]} if len(size) in {1, 3} else {}
    (width, depth), height = size[:2], {"height": size[2]} if len(size) == 3 and shape != "sphere" else {}
    if shape in {"circle", "cylinder", "sphere"} and len({*size[: 3 if shape == "sphere" else 2]}) > 1:
        raise CaromError(
            Fault("container", "size", f"the same lengths for a {shape}", f"{tuple(size)}", "shape = 'ellipse' has two")
        )
    if shape == "ellipse":
        return {"half_axes": (width / 2, depth / 2), **height}
    if shape == "stadium":
        if width <= depth:
            expected = "a stadium with its long side along x: a width of more than the depth"
            raise CaromError(Fault("container", "size", expected, f"{tuple(size)}"))
        return {"straight": width - depth, "radius": depth / 2, **height}
    if shape == "wedge":
        if width >= 2 * depth:
            expected = "a wedge less than twice as wide as deep"
            raise CaromError(Fault("container", "size", expected, f"{tuple(size)}"))
        return {"shape": "sector", "opening": math.degrees(2 * math.asin(width / 2 / depth)), "radius": depth, **height}
    return {"radius": width / 2, **height}
