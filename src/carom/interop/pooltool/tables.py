"""A table of pooltool's as walls of a scene: a table with pockets where it has pooltool's layout, else segments and arcs."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from numpy.typing import NDArray

from carom.errors import CaromError
from carom.scene.pockets import Pockets
from carom.scene.shapes.rounds import Arc
from carom.scene.shapes.segments import Segment
from carom.scene.shapes.table import Table
from carom.scene.wall import WallShape
from carom.tracks.formats.pooltool_fields import Field

__all__ = ["walls_of"]

Array = NDArray[np.float64]
SAME = 1e-6  # m: places in a file and on a carom table this close count as the same
CORNERS, SIDES = ("lb", "rb", "rt", "lt"), ("lc", "rc")


def walls_of(table: Field, surface: dict[str, Any]) -> tuple[list[WallShape], list[str]]:
    """Return the walls for a table in a file, and what is left out of it."""
    cushions = table["cushion_segments"]
    lines = {key: np.array([one["p1"].array(3), one["p2"].array(3)]) for key, one in cushions["linear"].parts().items()}
    circles = {
        key: np.array([*one["center"].array(3), one["radius"].number()])
        for key, one in cushions["circular"].parts().items()
    }
    holes = {
        key: np.array([*one["center"].array(3)[:2], one["radius"].number()])
        for key, one in table["pockets"].parts().items()
    }
    for key, line in lines.items():
        if line[0, 2] != line[1, 2]:
            at = cushions["linear"][key]
            raise at.fault("p1 and p2 of one height", f"{line[0, 2]:g} and {line[1, 2]:g} m")
    whole = _table(lines, circles, holes, surface)
    if whole is not None:
        return [whole], []
    notes = [f"pockets {', '.join(holes)}: the cushions have not pooltool's usual layout"] if holes else []
    return [*_segments(lines, surface), *_arcs(lines, circles, surface)], notes


def _table(
    lines: dict[str, Array], circles: dict[str, Array], holes: dict[str, Array], surface: dict[str, Any]
) -> Table | None:
    """Return a carom table of the same noses, jaws and pockets; None where there is none.

    pooltool numbers its cushions: 3 and 12 along y, 18 and 9 along x, each side of a middle pocket by itself.
    """
    if not {"3", "9", "12", "18"} <= set(lines):
        return None
    x1, x2, y1, y2 = lines["3"][0, 0], lines["12"][0, 0], lines["18"][0, 1], lines["9"][0, 1]
    heights = {z for line in lines.values() for z in line[:, 2].tolist()} | {c[2] for c in circles.values()}
    if len(heights) != 1 or not (x2 > x1 and y2 > y1):
        return None
    numbers: dict[str, Any] = {
        "length": x2 - x1, "width": y2 - y1, "center": ((x1 + x2) / 2, (y1 + y2) / 2), "nose_height": heights.pop(), **surface,
    }  # fmt: skip
    if not (holes or circles):
        return Table(name="cushions", **numbers) if len(lines) == 4 else None
    if set(holes) != {*CORNERS, *SIDES} or not {"1", "5"} <= set(lines) or not {"1t", "5t"} <= set(circles):
        return None
    try:
        corner = _corner(lines, circles["1t"], holes["lb"], x1, y1)
        side = _side(lines, circles["5t"], holes["lc"], x1, (y1 + y2) / 2)
        found = Table(name="cushions", corner_pockets=corner, side_pockets=side, **numbers)
    except (CaromError, ValueError, ZeroDivisionError):  # (a shape that carom's tables do not have)
        return None
    return found if _same(found, lines, circles, holes) else None


# The tip of a jaw is where the lines of nose and facing meet. An arc of radius r touches both; with s the angle between the
# facing and the normal of the nose, it touches the facing r (1 - sin s) behind the line of the nose, and the nose at
# r cos s/(1 + sin s) from the tip.


def _jaw(depth: float, radius: float) -> tuple[float, float]:
    """Return the jaw's angle in degrees, and the distance from tip to arc."""
    s = math.asin(1 - depth / radius)
    return max(90.0, 90 + math.degrees(s)), radius * math.cos(s) / (1 + math.sin(s))


def _corner(lines: dict[str, Array], jaw: Array, hole: Array, x: float, y: float) -> Pockets:
    angle, d = _jaw(y - lines["1"][1, 1], jaw[3])
    mouth = (min(lines["18"][:, 0]) - x - d) * math.sqrt(2)
    out = math.sqrt(2) * (x - hole[0])
    return Pockets(mouth=mouth, jaw_angle=angle, jaw_radius=jaw[3], shelf=out - hole[2] + mouth / 2, radius=hole[2])


def _side(lines: dict[str, Array], jaw: Array, hole: Array, x: float, middle: float) -> Pockets:
    angle, d = _jaw(x - lines["5"][1, 0], jaw[3])
    mouth = 2 * (jaw[1] - d - middle)
    return Pockets(mouth=mouth, jaw_angle=angle, jaw_radius=jaw[3], shelf=x - hole[0] - hole[2], radius=hole[2])


def _same(table: Table, lines: dict[str, Array], circles: dict[str, Array], holes: dict[str, Array]) -> bool:
    """Return whether all noses, arcs of jaws and pockets of a carom table agree with the file.

    (Facings are not compared: pooltool draws the middle pockets' ones with sin for tan, and they end 0.04 mm beside their line.)
    """
    noses, mouths = table._layout
    own = [(*start, *end) for start, end, _along in noses]
    theirs = [(*line[0, :2], *line[1, :2]) for key, line in lines.items() if key in NOSES]
    turned = [(*line[2:], *line[:2]) for line in theirs]
    arcs = [(*jaw.center, jaw.radius) for mouth in mouths for jaw in (mouth.before, mouth.after)]
    edges = [(*mouth.pocket.center, mouth.pocket.radius) for mouth in mouths]
    return (
        len(theirs) == len(own) and _all_in(own, theirs + turned)
        and len(circles) == len(arcs) and _all_in(arcs, [(*c[:2], c[3]) for c in circles.values()])
        and _all_in(edges, [tuple(hole) for hole in holes.values()])
    )  # fmt: skip


NOSES = ("3", "6", "9", "12", "15", "18")


def _all_in(some: list[Any], others: list[Any]) -> bool:
    gaps = np.abs(np.array(some)[:, None] - np.array(others)[None]).max(axis=-1)
    return bool((gaps.min(axis=1) < SAME).all())


# --- any other layout ---------------------------------------------------------------------------------------------------


def _segments(lines: dict[str, Array], surface: dict[str, Any]) -> list[WallShape]:
    return [
        Segment(start=line[0, :2].tolist(), end=line[1, :2].tolist(), low=line[0, 2], name=f"cushion {key}", **surface)
        for key, line in lines.items()
    ]


def _arcs(lines: dict[str, Array], circles: dict[str, Array], surface: dict[str, Any]) -> list[WallShape]:
    """Return the arcs between the cushions that touch each circle; of a circle that stands alone, all but the last bit."""
    found: list[WallShape] = []
    ends = np.array([end[:2] for line in lines.values() for end in line]).reshape(-1, 2)
    for key, (x, y, z, radius) in circles.items():
        near = ends[np.abs(np.hypot(ends[:, 0] - x, ends[:, 1] - y) - radius) < SAME]
        angles = sorted(math.degrees(math.atan2(q - y, p - x)) for p, q in near)
        first, last = (angles[0], angles[-1]) if len(angles) == 2 else (0.0, 359.999)
        if last - first > 180 and len(angles) == 2:
            first, last = last, first + 360
        found.append(
            Arc(center=(x, y), radius=radius, from_angle=first, to_angle=last, low=z, name=f"jaw {key}", **surface)
        )
    return found
