"""Tables of the plane for one ball: what bounds it, its surface or its centre."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from typing import Any, Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

from carom.checks import Faults, float_array, nearest, number
from carom.errors import CaromError
from carom.orbits.shape import Shape, face
from carom.outlines import outline_faults

__all__ = [
    "BOUNDS", "Bounds", "Table", "acceleration_of", "check_bounds", "circle", "ellipse", "need_room", "periodic_strip",
    "polygon", "positive", "rectangle", "regular", "sinai", "stadium", "strip", "torus", "under", "wedge",
]  # fmt: skip

Array = NDArray[np.float64]
Bounds = Literal["centre", "surface"]
BOUNDS = ("centre", "surface")


@dataclass(frozen=True, eq=False)
class Table:
    """A table, made by one of the verbs of this module.

    ``bounds`` says what the given curve bounds: the ball's "centre", as mathematicians have it, or its "surface". With
    "surface" the centre keeps to the parallel curve, one radius inside.
    """

    name: str
    bounds: str
    dimension: int
    """2: a disc in the plane, its spin a number. 3: a ball."""
    make: Callable[[float], Shape]
    """From how far inside the centre keeps to what bounds it."""
    sizes: dict[str, Any]
    """What it was made of."""
    pull: tuple[float, float, float] = (0.0, 0.0, 0.0)
    """A constant acceleration, m/s^2."""

    def shape(self, radius: float) -> Shape:
        """What bounds the centre of a ball of that radius."""
        return self.make(radius if self.bounds == "surface" else 0.0)

    def wall(self) -> Shape:
        """The curve that was given."""
        return self.make(0.0)

    def __str__(self) -> str:
        """Its name and its sizes, in a line."""
        sizes = ", ".join(f"{key} {value}" for key, value in self.sizes.items())
        return f"{self.name} ({sizes}; bounds the {self.bounds})"


def under(table: Table, acceleration: Sequence[float]) -> Table:
    """The same table with a force on the ball: a constant acceleration (x, y), in space (x, y, z), m/s^2, across walls as well.

    It takes the place of the one that the table had. The ball flies on parabolas; gravity in a wedge, in a circle.
    """
    faults = Faults("under")
    if not isinstance(table, Table):
        faults.add("table", "a table, as carom.orbits.circle() makes one", f"{table!r:.60}")
        faults.done()
    g = acceleration_of(faults, acceleration, table.dimension)
    faults.done()
    sizes = {key: value for key, value in table.sizes.items() if key != "acceleration"} | {"acceleration": list(g)}
    return replace(table, sizes=sizes, pull=(g[0], g[1], g[2] if table.dimension == 3 else 0.0))


def positive(faults: Faults, field: str, value: Any, most: float = math.inf) -> float:
    """A length > 0 (or a number below a limit), and a fault where it is none."""
    what = "a length > 0" if most == math.inf else f"a number > 0 and < {most:.6g}"
    found = number(faults, field, value, what, lambda x: (x > 0) & (x < most))
    if isinstance(found, float):
        return found
    faults.add(field, "one number", repr(value))
    return 1.0


def acceleration_of(faults: Faults, value: Any, count: int = 1) -> tuple[float, ...]:
    """Accelerations along so many axes."""
    try:
        array = np.atleast_1d(float_array(value))
    except (TypeError, ValueError):
        array = np.full(1, np.nan)
    if array.shape != (count,) or not np.isfinite(array).all():
        faults.add("acceleration", "a number" if count == 1 else f"{count} numbers", repr(value))
        return (0.0,) * count
    return tuple(float(x) for x in array)


def check_bounds(faults: Faults, bounds: str) -> None:
    """A fault where it is neither centre nor surface."""
    if bounds not in BOUNDS:
        faults.add("bounds", "'centre' or 'surface'", f"{bounds!r}; {nearest(str(bounds), list(BOUNDS))}")


def need_room(name: str, left: float, what: str, inset: float) -> None:
    """CaromError where a ball is too large."""
    if not left > 0:
        raise CaromError(
            f"{name}: radius of the ball: expected one that has room {what}, got {inset!r}; take a smaller ball"
        )


def strip(width: float = 1.0, *, bounds: Bounds = "centre", acceleration: float = 0.0) -> Table:
    """Two parallel walls y = -width/2 and y = width/2; ``acceleration`` along them, in x."""
    faults = Faults("strip")
    width = positive(faults, "width", width)
    check_bounds(faults, bounds)
    (g,) = acceleration_of(faults, acceleration)
    faults.done()

    def make(inset: float) -> Shape:
        need_room("strip", width / 2 - inset, "between the walls", inset)
        c = inset - width / 2
        return Shape(faces=[face(0, 1, c), face(0, -1, c)], size=width)

    sizes = {"width": width} | ({"acceleration": g} if g else {})
    return Table("strip", bounds, 2, make, sizes, (g, 0.0, 0.0))


def wedge(angle: float, *, bounds: Bounds = "centre") -> Table:
    """Two walls from the origin, so many radians apart (0 to pi), on either side of the x axis."""
    faults = Faults("wedge")
    angle = positive(faults, "angle", angle, math.pi)
    check_bounds(faults, bounds)
    faults.done()
    cos, sin = math.cos(angle / 2), math.sin(angle / 2)

    def make(inset: float) -> Shape:
        # the centre's wedge has its vertex at (inset/sin, 0)
        tip = cos * inset / sin
        # ball on the left: in along the upper wall, out along the lower
        return Shape(faces=[face(sin, cos, inset, tip), face(sin, -cos, inset, end=-tip)], size=1.0 + inset)

    return Table("wedge", bounds, 2, make, {"angle": angle})


def polygon(vertices: ArrayLike, *, bounds: Bounds = "centre", name: str = "polygon") -> Table:
    """Any polygon, from its vertices (N, 2) in order. It need not be convex; its sides must not meet but at its corners.

    What is wrong with one is told with the numbers of the corners, counted from 1: corners in one place, sides that cross, lie
    on each other or run back (a slit has a width).
    """
    faults = Faults(name)
    check_bounds(faults, bounds)
    try:
        corners = float_array(vertices)
    except (TypeError, ValueError):
        corners = np.empty(0)
    if corners.ndim != 2 or corners.shape[1:] != (2,) or len(corners) < 3 or not np.isfinite(corners).all():
        faults.add("vertices", "three or more points (x, y)", f"{vertices!r:.60}")
        faults.done()
    for expected, got in outline_faults(corners):
        faults.also("vertices", expected, got)
    faults.done()
    x, y = (corners - corners[0]).T
    if np.sum(x * np.roll(y, -1) - y * np.roll(x, -1)) < 0:
        corners = corners[::-1].copy()
    sides = np.roll(corners, -1, axis=0) - corners
    lengths = np.hypot(sides[:, 0], sides[:, 1])
    t = sides / lengths[:, None]
    turn = t[:, 0] * np.roll(t[:, 1], -1) - t[:, 1] * np.roll(t[:, 0], -1)  # at the end of each side
    reflex = turn < -1e-12
    smooth = np.abs(turn) <= 1e-12
    size = float(lengths.max())

    def make(inset: float) -> Shape:
        # inset/tan(half the inner angle) is what a convex corner takes of both its sides
        cos = (t * np.roll(t, -1, axis=0)).sum(-1)
        cut = np.where(reflex | smooth, 0.0, inset * turn / (1 + cos))
        faces: list[Any] = []
        outside: list[Any] = []
        order: list[int] = []
        for k in range(len(corners)):
            (tx, ty), before = t[k], k - 1
            x0 = tx * corners[k, 0] + ty * corners[k, 1]
            begin, end = float(x0 + cut[before]), float(x0 + lengths[k] - cut[k])
            need_room(name, end - begin, f"to touch side {k + 1}", inset)
            # round the outside of a reflex vertex the centre goes on along a circle
            low = -math.inf if smooth[before] or (reflex[before] and inset) else begin
            high = math.inf if smooth[k] or (reflex[k] and inset) else end
            c = -ty * corners[k, 0] + tx * corners[k, 1] + inset
            faces.append(face(-float(ty), float(tx), float(c), begin, end, low=low, high=high))
            order.append(k)
            if reflex[k] and inset:
                x, y = corners[(k + 1) % len(corners)]
                span = math.acos(max(-1.0, min(1.0, float(cos[k]))))
                order.append(len(corners) + len(outside))
                outside.append((float(x), float(y), inset, math.atan2(tx, -ty), span))
        return Shape(
            faces=faces, outside=outside, order=order, limited=bool(reflex.any()), size=size,
            vertices=corners if reflex.any() else None, clearance=inset,
        )  # fmt: skip

    return Table(name, bounds, 2, make, {"vertices": [[float(x), float(y)] for x, y in corners]})


def regular(sides: int, radius: float = 1.0, *, bounds: Bounds = "centre") -> Table:
    """A regular polygon with its vertices on a circle of that radius; the lowest side is level."""
    faults = Faults("polygon")
    if not (isinstance(sides, int | np.integer) and 3 <= sides <= 10_000):
        faults.add("sides", "a whole number from 3 to 10000", repr(sides))
        sides = 3
    radius = positive(faults, "radius", radius)
    faults.done()
    angle = -math.pi / 2 + math.pi / sides * (2 * np.arange(sides) - 1)
    made = polygon(radius * np.stack([np.cos(angle), np.sin(angle)], axis=-1), bounds=bounds)
    return replace(made, sizes={"sides": int(sides), "radius": radius})


def rectangle(width: float = 2.0, height: float = 1.0, *, bounds: Bounds = "centre") -> Table:
    """A rectangle about the origin."""
    faults = Faults("rectangle")
    x, y = positive(faults, "width", width) / 2, positive(faults, "height", height) / 2
    faults.done()
    made = polygon([(-x, -y), (x, -y), (x, y), (-x, y)], bounds=bounds, name="rectangle")
    return replace(made, sizes={"width": 2 * x, "height": 2 * y})


def circle(radius: float = 1.0, *, bounds: Bounds = "centre") -> Table:
    """The inside of a circle about the origin."""
    faults = Faults("circle")
    radius = positive(faults, "radius", radius)
    check_bounds(faults, bounds)
    faults.done()

    def make(inset: float) -> Shape:
        need_room("circle", radius - inset, "in the circle", inset)
        return Shape(inside=[(0.0, 0.0, radius - inset, 0)], size=radius)

    return Table("circle", bounds, 2, make, {"radius": radius})


def ellipse(major: float = 1.0, minor: float = 0.8, *, bounds: Bounds = "centre") -> Table:
    """The inside of the ellipse (x/major)^2 + (y/minor)^2 = 1.

    With bounds="surface" the centre keeps to the parallel curve, no ellipse, and is followed on it exactly (flights that
    leave the wall at less than 1e-8 rad end as "grazed"). A ball that is larger than the ellipse's smallest radius of
    curvature does not come to the ends of the long axis: its centre's curve has two arcs, and a corner where it touches both
    sides at once. One as large as the smaller half axis has no room.
    """
    faults = Faults("ellipse")
    p, q = positive(faults, "major", major), positive(faults, "minor", minor)
    check_bounds(faults, bounds)
    faults.done()

    def make(inset: float) -> Shape:
        need_room("ellipse", min(p, q) - inset, "in the ellipse", inset)
        return Shape(ellipse=(p, q, inset), size=max(p, q))

    return Table("ellipse", bounds, 2, make, {"major": p, "minor": q})


def stadium(straight: float = 2.0, radius: float = 1.0, *, bounds: Bounds = "centre") -> Table:
    """Bunimovich's stadium: two straight sides of that length in x, and two half circles."""
    faults = Faults("stadium")
    straight, radius = positive(faults, "straight", straight), positive(faults, "radius", radius)
    check_bounds(faults, bounds)
    faults.done()

    def make(inset: float) -> Shape:
        r, x = radius - inset, straight / 2
        need_room("stadium", r, "in the stadium", inset)
        sides = [
            face(0, 1, -r, -x, x, low=-math.inf, high=math.inf),
            face(0, -1, -r, -x, x, low=-math.inf, high=math.inf),
        ]
        # a parallel curve of a stadium is a stadium
        return Shape(
            faces=sides, inside=[(x, 0.0, r, 1), (-x, 0.0, r, -1)], order=[0, 2, 1, 3], limited=True,
            size=radius + x,
        )  # fmt: skip

    return Table("stadium", bounds, 2, make, {"straight": straight, "radius": radius})


# --- cells --------------------------------------------------------------------------------------------------------------


def torus(
    cell: Sequence[float] = (1.0, 1.0),
    scatterers: Sequence[Sequence[float]] = ((0.0, 0.0, 0.3),),
    *,
    bounds: Bounds = "centre",
) -> Table:
    """A periodic cell (width, height) about the origin with circular scatterers (x, y, radius)."""
    return _cell("torus", cell, scatterers, bounds, periodic=(True, True))


def sinai(radius: float = 0.3, side: float = 1.0, *, bounds: Bounds = "centre") -> Table:
    """Sinai's billiard: one circular scatterer in a square torus."""
    faults = Faults("sinai")
    radius, side = positive(faults, "radius", radius), positive(faults, "side", side)
    faults.done()
    made = _cell("sinai", (side, side), ((0.0, 0.0, radius),), bounds, periodic=(True, True))
    return replace(made, sizes={"radius": radius, "side": side})


def periodic_strip(
    period: float = 1.0,
    width: float = 1.0,
    scatterers: Sequence[Sequence[float]] = ((0.0, 0.0, 0.2),),
    *,
    bounds: Bounds = "centre",
) -> Table:
    """A strip that repeats itself in x, with walls y = -width/2 and y = width/2 and scatterers (x, y, radius) in each period."""
    return _cell("periodic strip", (period, width), scatterers, bounds, periodic=(True, False))


def _cell(
    name: str, cell: Sequence[float], scatterers: Sequence[Sequence[float]], bounds: str, periodic: tuple[bool, bool]
) -> Table:
    faults = Faults(name)
    check_bounds(faults, bounds)
    side = np.ones(2)
    circles = np.zeros((0, 3))
    for field, value, shape, what in (
        ("cell", cell, (2,), "two lengths > 0"),
        (
            "scatterers",
            scatterers,
            (len(scatterers) if hasattr(scatterers, "__len__") else 0, 3),
            "one or more (x, y, radius)",
        ),
    ):
        try:
            array = float_array(value)
        except (TypeError, ValueError):
            array = np.empty(0)
        lengths = array if field == "cell" else array[..., 2:]
        if array.shape != shape or not array.size or not np.isfinite(array).all() or not (lengths > 0).all():
            faults.add(field, what, repr(value))
        elif field == "cell":
            side = array
        else:
            circles = array
    faults.done()
    w, h = (float(x) for x in side / 2)
    if (np.abs(circles[:, :2]) > side / 2).any():
        faults.add("scatterers", f"centres within the cell, |x| <= {w:.6g} and |y| <= {h:.6g}", repr(scatterers))
    faults.done()

    def make(inset: float) -> Shape:
        found = Shape(size=float(side.max()), cell=(2 * w, 2 * h if periodic[1] else math.inf))
        along = [(2 * w, 0.0)]
        if periodic[1]:
            along += [(0.0, 2 * h), (2 * w, 2 * h), (2 * w, -2 * h)]
        else:
            c = inset - h
            need_room(name, -c, "between the walls", inset)
            # (its length is a period's; a ball that goes through a window goes on along it)
            found.faces = [
                face(0, 1, c, -w, w, low=-math.inf, high=math.inf),
                face(0, -1, c, -w, w, low=-math.inf, high=math.inf),
            ]
        found.windows = [face(1, 0, -w), face(-1, 0, -w)] + ([face(0, 1, -h), face(0, -1, -h)] if periodic[1] else [])
        found.windows = [(n, c, 2 * (w if n[0] else h), *rest) for n, c, _r, *rest in found.windows]
        for k, (x, y, r) in enumerate(circles.tolist()):
            r += inset  # noqa: PLW2901
            if r >= math.hypot(w, h if periodic[1] else h - inset + abs(y)):
                what = (
                    "one that covers the cell"
                    if not inset
                    else f"one that, with a ball of radius {inset:g}, covers the cell"
                )
                raise CaromError(f"{name}: scatterers: expected room between them, got {what}; take a smaller one")
            found.outside.append((x, y, r, 0.0, math.tau))
            for dx, dy in along + [(-dx, -dy) for dx, dy in along]:
                if abs(x + dx) < w + r and abs(y + dy) < h + r:
                    found.images.append((x + dx, y + dy, r, k))
        return found

    return Table(name, bounds, 2, make, {"cell": [2 * w, 2 * h], "scatterers": circles.tolist()})
