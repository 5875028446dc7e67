"""A billiard table: cushions with noses, pockets where it has them, and real tables by name."""

from __future__ import annotations

import functools
import math
from collections.abc import Sequence
from typing import Annotated, Any, ClassVar, Literal, NamedTuple

import numpy as np
from numpy.typing import NDArray
from pydantic import BeforeValidator, model_validator

from carom.core.geometry.circles import direction
from carom.core.geometry.features import FACE, OVER
from carom.core.jit.kernel import Vec, kept_kernel, kernel
from carom.formatting import format_length
from carom.laws.law import Law
from carom.scene.feature_builders import (
    UP,
    Flat,
    circle,
    length_2d,
    put,
    put_cushion,
    put_edges,
    put_number,
    put_round_cushion,
    put_standing,
)
from carom.scene.presets import preset_fault, presets, wall_fields
from carom.scene.restitution import Bounce
from carom.scene.ruled import FaultText, put_fault
from carom.scene.schema import ContactTime, Extent, Friction, Length, Model, Number, Place, Size, raise_faults
from carom.scene.wall import CUSHION, ContactParameters, Outline, Pocket, ShapeKernels, WallShape

Numbers = Sequence[float]


class Pockets(Model):
    """The shape of a table's four corner pockets, or of its two side pockets.

    Parameters
    ----------
    mouth : m: from tip to tip, where the lines of the noses meet the lines of the facings
    jaw_angle : degrees, 90 to 175: between nose and facing; a corner pocket with parallel facings has 135, a side pocket 90
    jaw_radius : m: of the arc that rounds each tip
    shelf : m: from the middle of the mouth to the pocket's edge; negative where the edge comes in front of the mouth
    radius : m: of the pocket's edge, a circle: a ball whose centre passes it falls

    Raises CaromError, one line per problem.

    Examples
    --------
    >>> import carom
    >>> corner = carom.scene.Pockets(mouth="116 mm", jaw_angle=142, jaw_radius=0.005, shelf=0.041, radius=0.062)
    >>> corner.mouth
    0.116
    """

    mouth: Size
    jaw_angle: Annotated[
        float, BeforeValidator(Number("an angle from 90 to 175 degrees", "degree", least=90, most=175))
    ]
    jaw_radius: Size
    shelf: Length
    radius: Size


class Jaw(NamedTuple):
    """One side of a pocket's mouth, as seen from above: where the nose ends, the arc, the facing."""

    nose_end: Flat
    center: Flat
    radius: float
    middle: Flat
    """Unit vector from the arc's centre to its middle."""
    cosine: float
    """Of half the arc's angle."""
    facing: Flat
    """Unit vector along the facing, into the pocket."""
    start: Flat
    end: Flat
    """Where the facing begins and ends; one point where the arc reaches the pocket."""
    reaches: bool
    """Whether the facing's line comes over the pocket at all."""
    forward: bool
    """Whether it lies at the end of its cushion, as one goes round the table counterclockwise."""


@kernel
def jaw_at(
    x: float, y: float, tx: float, ty: float, forward: bool, p: Numbers, first: int, px: float, py: float
) -> Jaw:
    """Return the jaw of a tip (x, y); the unit vector (tx, ty) leads along the nose towards the pocket, which is at (px, py).

    The numbers of the pocket's shape are those of p from ``first`` on.
    """
    angle, r, radius = 180 - p[first + 1], p[first + 2], p[first + 4]
    ox, oy = (ty, -tx) if forward else (-ty, tx)  # away from the table
    c, s = direction(angle)
    c2, s2 = direction(angle / 2)
    d = r * s / (1 + c)  # from the tip to where the arc touches the lines: r tan(turn / 2)
    fx, fy = c * tx + s * ox, c * ty + s * oy
    nose_end = (x - d * tx, y - d * ty)
    wx, wy = px - x, py - y
    on = wx * fx + wy * fy
    off2 = wx * wx + wy * wy - on * on
    reaches = off2 < radius * radius
    into = on - math.sqrt(radius * radius - off2) if reaches else d
    end = max(into, d)
    return Jaw(
        nose_end,
        (nose_end[0] + r * ox, nose_end[1] + r * oy),
        r,
        (s2 * tx - c2 * ox, s2 * ty - c2 * oy),
        c2,
        (fx, fy),
        (x + d * fx, y + d * fy),
        (x + end * fx, y + end * fy),
        reaches,
        forward,
    )


@kernel
def put_jaw(jaw: Jaw, low: float, high: float, i: int, out: Any) -> int:
    """Write arc and facing of a jaw, which stands from low to high."""
    u = (jaw.middle[0], jaw.middle[1], 0.0)
    i = put_round_cushion(jaw.center[0], jaw.center[1], jaw.radius, u, jaw.cosine, low, high, i, out)
    if jaw.start[0] == jaw.end[0] and jaw.start[1] == jaw.end[1]:
        return i
    # (its ends in the order in which they are passed counterclockwise)
    one, two = (jaw.start, jaw.end) if jaw.forward else (jaw.end, jaw.start)
    return put_cushion(one[0], one[1], two[0], two[1], low, high, i, out)


def jaw_line(jaw: Jaw) -> NDArray[np.float64]:
    """Return a jaw as seen from above, a polyline (n, 2) from the nose's end into the pocket."""
    middle, half = math.atan2(jaw.middle[1], jaw.middle[0]), math.acos(jaw.cosine)
    first, last = (middle + half, middle - half) if jaw.forward else (middle - half, middle + half)
    return np.vstack([circle(jaw.center, jaw.radius, first, last), jaw.end])


@kernel
def put_pocket(place: int, x: float, y: float, R: float, high: float, i: int, out: Any) -> int:
    """Write the edge of a pocket: balls fall below the height of the cushions; above it they have left the table."""
    i = put(out, i, OVER, (x, y, 0.0), UP, R, 1.0, (1.0, 0.0, 0.0), -1.0, 1.0, -math.inf, high, place)
    if high < math.inf:
        i = put(out, i, OVER, (x, y, 0.0), UP, R, 1.0, (1.0, 0.0, 0.0), -1.0, 1.0, high, math.inf, -1)
    return i


@kernel
def is_free(x: Vec, jaw: Jaw) -> bool:
    """Return whether a point behind the line of the nose is not in the rubber of a jaw."""
    fx, fy = jaw.facing
    nx, ny = (-fy, fx) if jaw.forward else (fy, -fx)
    if nx * (x[0] - jaw.start[0]) + ny * (x[1] - jaw.start[1]) >= 0:
        return True
    rx, ry = x[0] - jaw.center[0], x[1] - jaw.center[1]
    far = math.sqrt(rx * rx + ry * ry)  # in the sector that the arc rounds off, and beyond the arc
    return far >= jaw.radius and rx * jaw.middle[0] + ry * jaw.middle[1] >= jaw.cosine * far


# ----------------------------------------------------------------------------------------------------
# The four cushions of a table, where their surfaces differ.


class Side(Model):
    """A cushion of a table with a surface of its own.

    Parameters
    ----------
    restitution : number from 0 to 1, or a form of the normal speed; default: the table's
    friction : number >= 0, or inf; default: the table's

    Raises CaromError, one line per problem.
    """

    restitution: Bounce | None = None
    friction: Friction | None = None


class Sides(Model):
    """The cushions of a table by name, in the order of their numbers: counterclockwise from the bottom one.

    Parameters
    ----------
    bottom, right, top, left : Side
        Where y is least, x is greatest, y is greatest, x is least. The jaws at its ends belong to a cushion. Default: the
        surface of the table.

    Raises CaromError, one line per problem.

    Examples
    --------
    >>> import carom
    >>> table = carom.scene.Table(preset="carom", friction=0.2, sides={"right": {"restitution": 0.83}})
    >>> table.sides.right.restitution.value, table.sides.left.restitution
    (0.83, None)
    """

    bottom: Side = Side()
    right: Side = Side()
    top: Side = Side()
    left: Side = Side()


# ----------------------------------------------------------------------------------------------------
# A billiard table: cushions with noses, pockets where it has them, and real tables by name.


# Counterclockwise, as the corners are: at each corner, and in the middle of the side after it.
PLACES = (
    "bottom left pocket", "bottom middle pocket", "bottom right pocket", "right middle pocket", "top right pocket",
    "top middle pocket", "top left pocket", "left middle pocket",
)  # fmt: skip
TURNS: tuple[Flat, Flat, Flat, Flat] = ((1.0, 0.0), (0.0, 1.0), (-1.0, 0.0), (0.0, -1.0))
# Where the numbers of a table are: length, width, center, nose_height, height, and from these on those of its pockets.
NOSE, HEIGHT, CORNER, SIDE = 4, 5, 6, 11


class Mouth(NamedTuple):
    """A pocket with the jaws that one passes before and after it."""

    pocket: Pocket
    before: Jaw
    after: Jaw


class Layout(NamedTuple):
    """A table with pockets, as seen from above."""

    noses: list[tuple[Flat, Flat, Flat]]
    """Start, end, and direction of each."""
    mouths: list[Mouth]


@kernel
def _has_pocket(p: Numbers, place: int) -> bool:
    """Return whether there is a pocket at a place: in a corner, or in the middle of a longer side."""
    if place % 2 == 0:
        return bool(p[CORNER] == p[CORNER])
    return bool(p[SIDE] == p[SIDE]) and (place // 2) % 2 == (0 if p[0] >= p[1] else 1)


@kernel
def _any_pocket(p: Numbers) -> bool:
    return bool(p[CORNER] == p[CORNER] or p[SIDE] == p[SIDE])


@kernel
def _corner_of(p: Numbers, k: int) -> Flat:
    """Return corner k, counterclockwise from the bottom left one."""
    dx, dy = p[0] / 2, p[1] / 2
    x = p[2] - dx if k in (0, 3) else p[2] + dx
    return (x, p[3] - dy if k < 2 else p[3] + dy)


@kept_kernel
def _mouth(p: Numbers, place: int) -> tuple[Flat, Jaw, Jaw]:
    """Return the centre of the pocket at a place, and the jaws that one passes before and after it."""
    k = place // 2
    x, y = _corner_of(p, k)
    tx, ty = TURNS[k]
    if place % 2 == 0:
        # outwards along the diagonal, from the corner
        half = math.sqrt(0.5)
        sx, sy = TURNS[(k + 3) % 4]
        mouth, shelf, radius = p[CORNER], p[CORNER + 3], p[CORNER + 4]
        gx, gy, far = half * (sx - tx), half * (sy - ty), shelf + radius - mouth / 2
        px, py = x + far * gx, y + far * gy
        m = half * mouth
        one = jaw_at(x - m * sx, y - m * sy, sx, sy, True, p, CORNER, px, py)
        return (px, py), one, jaw_at(x + m * tx, y + m * ty, -tx, -ty, False, p, CORNER, px, py)
    ux, uy = _corner_of(p, (k + 1) % 4)
    mx, my, m, far = (x + ux) / 2, (y + uy) / 2, p[SIDE] / 2, p[SIDE + 3] + p[SIDE + 4]
    px, py = mx + far * ty, my - far * tx
    one = jaw_at(mx - m * tx, my - m * ty, tx, ty, True, p, SIDE, px, py)
    return (px, py), one, jaw_at(mx + m * tx, my + m * ty, -tx, -ty, False, p, SIDE, px, py)


@kernel
def _nose(p: Numbers, place: int) -> tuple[Flat, Flat]:
    """Return where the nose that begins at a place begins and ends."""
    here = _mouth(p, place)[2].nose_end if _has_pocket(p, place) else _corner_of(p, place // 2)
    after = (place + 1) % 8
    if after % 2 == 1 and not _has_pocket(p, after):
        after = (after + 1) % 8
    return here, _mouth(p, after)[1].nose_end if _has_pocket(p, after) else _corner_of(p, after // 2)


@kernel
def _table_features(p: Numbers, out: Any) -> int:
    """Write faces, noses, upper edges, and gates; then jaws and pockets."""
    low, high = p[NOSE] if p[NOSE] == p[NOSE] else -math.inf, p[HEIGHT]
    i = 0
    if not _any_pocket(p):
        for k in range(4):
            (x, y), (u, v) = _corner_of(p, k), _corner_of(p, (k + 1) % 4)
            first = i
            if low < high:
                i = put_standing(FACE, u, v, x, y, low, high, i, out)
            i = put_number(k, first, put_edges(x, y, u, v, low, high, i, out), out)
        if high < math.inf:
            for k in range(4):
                (x, y), (u, v) = _corner_of(p, k), _corner_of(p, (k + 1) % 4)
                i = put_standing(OVER, u, v, x, y, high, math.inf, i, out)
        return i
    for place in range(8):
        if place % 2 == 0 or _has_pocket(p, place):
            (x, y), (u, v) = _nose(p, place)
            i = put_number(place // 2, i, put_cushion(x, y, u, v, low, high, i, out), out)
    for place in range(8):
        if _has_pocket(p, place):
            _at, before, after = _mouth(p, place)
            # (the one before a corner is that of the side before)
            i = put_number((place + 7) % 8 // 2, i, put_jaw(before, low, high, i, out), out)
            i = put_number(place // 2, i, put_jaw(after, low, high, i, out), out)
    for place in range(8):
        if _has_pocket(p, place):
            (x, y), _before, _after = _mouth(p, place)
            i = put_pocket(place, x, y, p[(CORNER if place % 2 == 0 else SIDE) + 4], high, i, out)
    return i


@kernel
def _blocked_by_table(p: Numbers, x: Vec) -> bool:
    """Return whether a point is beyond a cushion, or over a pocket."""
    out = abs(x[0] - p[2]) > p[0] / 2 or abs(x[1] - p[3]) > p[1] / 2
    for place in range(8):
        if _has_pocket(p, place):
            (px, py), before, after = _mouth(p, place)
            r = p[(CORNER if place % 2 == 0 else SIDE) + 4]
            if (x[0] - px) * (x[0] - px) + (x[1] - py) * (x[1] - py) < r * r:
                return True
            # between the jaws, in front of the pocket
            mx, my = (before.start[0] + after.start[0]) / 2, (before.start[1] + after.start[1]) / 2
            gx, gy = px - mx, py - my
            front = (x[0] - mx) * gx + (x[1] - my) * gy < gx * gx + gy * gy
            width = length_2d(before.nose_end[0] - after.nose_end[0], before.nose_end[1] - after.nose_end[1])
            near = length_2d(x[0] - px, x[1] - py) < 2 * r + width
            if out and front and near and is_free(x, before) and is_free(x, after):
                return False
    return out


@kernel
def _vertical_table(p: Numbers, z: float) -> bool:
    """Return whether it has no nose above the balls' centres, and is not lower than they are."""
    return not p[NOSE] > z and z <= p[HEIGHT]


@kernel
def _encloses(p: Numbers) -> bool:
    return True


@kernel
def _half_width(p: Numbers) -> float:
    return min(p[0], p[1]) / 2


@kernel
def _pocket_faults(p: Numbers, first: int, code: int, i: int, out: Any) -> int:
    """Report pockets of one kind outside the table, or jaws that do not lead into their pocket."""
    if abs(p[first + 3]) > p[first]:
        return put_fault(code, 0.0, 0.0, 0.0, i, out)
    for place in range(0 if first == CORNER else 1, 8, 2):
        if _has_pocket(p, place):
            _at, before, after = _mouth(p, place)
            if not (before.reaches and after.reaches):
                return put_fault(code + 2, 0.0, 0.0, 0.0, i, out)
    return i


@kernel
def _table_faults(p: Numbers, out: Any) -> int:
    """Report a height below nose or floor; then the first kind of fault of its pockets."""
    nose = p[NOSE] == p[NOSE]
    low = p[NOSE] if nose else 0.0
    if not (p[HEIGHT] >= low and p[HEIGHT] > 0):
        return put_fault(1 if nose else 0, 0.0, 0.0, 0.0, 0, out)
    if not _any_pocket(p):
        return 0
    which = 1 if p[SIDE] == p[SIDE] else 0
    for place in range(8):
        if place % 2 == 0 or _has_pocket(p, place):
            (x, y), (u, v) = _nose(p, place)
            tx, ty = TURNS[place // 2]
            if (u - x) * tx + (v - y) * ty <= 0:
                return put_fault(2 + which, 0.0, 0.0, 0.0, 0, out)
    i = _pocket_faults(p, CORNER, 4, 0, out) if p[CORNER] == p[CORNER] else 0
    i = _pocket_faults(p, SIDE, 5, i, out) if p[SIDE] == p[SIDE] else i
    if i > 0:
        return i
    for one in range(8):
        for two in range(one + 1, 8):
            if _has_pocket(p, one) and _has_pocket(p, two):
                (x, y), (u, v) = _mouth(p, one)[0], _mouth(p, two)[0]
                radii = p[(CORNER if one % 2 == 0 else SIDE) + 4], p[(CORNER if two % 2 == 0 else SIDE) + 4]
                gap = math.sqrt((x - u) * (x - u) + (y - v) * (y - v)) - radii[0] - radii[1]
                if gap < 0:
                    return put_fault(8 + which, one, two, -gap, 0, out)
    return 0


SMALLER, OUTSIDE = "make mouth or jaw_radius smaller", "the pocket would lie outside the table"
WIDER, APART = "make radius larger, or mouth smaller", "make radius smaller, or the table larger"


def _of_pockets(*texts: str) -> list[FaultText]:
    """Return the texts of a fault of corner pockets, and of side pockets."""
    return [FaultText(*(text.format(of=of) for text in texts)) for of in ("corner_pockets", "side_pockets")]


class Table(WallShape):
    """A rectangular table: four cushions, and pockets where it has them.

    Parameters
    ----------
    preset : str, optional
        A real table by name, which fills all other fields but ``center`` and ``height``: "carom", "carom-half-match",
        "carom-small", "pool-9ft", "pool-8ft", "pool-7ft", "snooker". What is given beside it has precedence.
    length, width : m: along x and y, from nose to nose
    center : 2 lengths, m, as seen from above; default: the origin
    nose_height : m, optional: each cushion begins with an edge at this height. A ball of a smaller radius meets it above its
        centre; one in flight may meet the cushion above it
    height : m: the cushions' upper edge; default: infinite, so that no ball leaves the table
    corner_pockets, side_pockets : Pockets, optional: in the corners, and in the middle of the longer sides. A ball whose centre
        passes a pocket's edge, below the cushions' upper edge, falls: an event ``pocketed``; it is followed no further
    sides : Sides, optional: cushions that differ, by name: left, right, bottom, top, each with a restitution or a friction of
        its own. Default: those of the table
    restitution, friction, ..., law, name : the fields of every wall, as of :class:`Plane`

    Raises CaromError, one line per problem.

    Examples
    --------
    >>> import carom
    >>> table = carom.scene.Table(length=2.84, width=1.42, nose_height="37 mm", restitution=0.9, friction=0.2)
    >>> table.nose_height, table.room
    (0.037, 0.71)
    >>> carom.scene.Table(preset="snooker", friction=0.2).describe()
    'a table of 3.57 m by 1.78 m, cushion noses at 36.8 mm, six pockets'
    """

    kernels: ClassVar = ShapeKernels(
        _table_features, _blocked_by_table, _vertical_table, _encloses, _half_width, _table_faults
    )
    pocket_places: ClassVar = PLACES
    fault_texts: ClassVar = (
        FaultText("height", "a height above the floor", "{height}"),
        FaultText("height", "at least nose_height = {nose_height:g} m", "{height}"),
        *(_of_pockets("{of}.mouth", "a cushion between two pockets", "mouths and jaws that leave none", SMALLER)),
        *(_of_pockets("{of}.shelf", "a shelf of at most the mouth, {{{of}.mouth:m}}", "{{{of}.shelf}}", OUTSIDE)),
        *(
            _of_pockets(
                "{of}.radius", "a pocket wide enough for the jaws to end over its edge", "{{{of}.radius}}", WIDER
            )
        ),
        *(
            _of_pockets(
                "{of}", "pockets that lie apart", "{{a:pocket}} and {{b:pocket}}, which overlap by {{c:m}}", APART
            )
        ),
    )
    shape: Literal["table"] = "table"
    preset: str | None = None
    length: Size
    width: Size
    center: Place = (0.0, 0.0)
    nose_height: Size | None = None
    height: Extent = math.inf
    corner_pockets: Pockets | None = None
    side_pockets: Pockets | None = None
    sides: Sides = Sides()
    contact_time: ContactTime = CUSHION

    @model_validator(mode="before")
    @classmethod
    def _filled(cls, fields: Any) -> Any:
        """Fill what a preset says and the scene does not."""
        name = fields.get("preset") if isinstance(fields, dict) else None
        if name is None:
            return fields
        raise_faults(preset_fault(name))
        preset = wall_fields(presets()[name])
        if any(name in preset and value is None for name, value in fields.items()):
            fields = {**fields, "preset": None}  # (a file has no word for what a table lacks of its preset)
        filled = {**preset, **fields}
        for part in ("corner_pockets", "side_pockets"):
            own, known = fields.get(part), wall_fields(presets()[name]).get(part)
            if isinstance(own, dict) and known is not None:
                filled[part] = {**known, **own}
        return filled

    @classmethod
    def ruled_fields(cls) -> tuple[str, ...]:
        """Return the names of the fields of its shape; the surfaces of its sides are none."""
        return tuple(name for name in super().ruled_fields() if name != "sides")

    @property
    def own_surfaces(self) -> dict[str, WallShape]:
        """Return tables with the surfaces of the cushions that differ, by their paths."""
        found: dict[str, WallShape] = {}
        for name, side in self.sides:
            own = {field: value for field, value in side if value is not None}
            if own:
                found[f"sides.{name}"] = self.model_copy(update=own)
        return found

    def contacts_of(self, law: Law) -> tuple[ContactParameters, ...]:
        """Return the surfaces of its four cushions as numbers under a law, and last that of all else."""
        every, own = self.contact_of(law), self.own_surfaces
        four = [own[at].contact_of(law) if (at := f"sides.{name}") in own else every for name, _side in self.sides]
        return (*four, every)

    @property
    def _layout(self) -> Layout:
        return _layout(self.numbers)

    @property
    def _corners(self) -> list[Flat]:
        return [_corner_of(self.numbers, k) for k in range(4)]

    def outline(self) -> Outline:
        """Return a rectangle; of a table with pockets, noses and jaws."""
        noses, mouths = self._layout
        if not mouths:
            return [np.array([*self._corners, self._corners[0]])]
        return [np.array(nose[:2]) for nose in noses] + [jaw_line(jaw) for m in mouths for jaw in (m.before, m.after)]

    @property
    def bed(self) -> NDArray[np.float64] | None:
        """Return the outline (n, 2) of the cloth of a table with pockets."""
        noses, mouths = self._layout
        if not mouths:
            return None
        before = {mouth.before.nose_end: mouth for mouth in mouths}
        parts: list[Any] = []
        for start, end, _t in noses:
            parts += [start, end]
            if end in before:
                mouth = before[end]
                parts += [*jaw_line(mouth.before), mouth.pocket.center, *jaw_line(mouth.after)[::-1]]
        return np.array(parts)

    def describe(self) -> str:
        """Return a description of a few words."""
        nose = "" if self.nose_height is None else f", cushion noses at {format_length(self.nose_height)}"
        count = {2: ", two pockets", 4: ", four pockets", 6: ", six pockets"}.get(len(self.pockets), "")
        return f"a table of {format_length(self.length)} by {format_length(self.width)}{nose}{count}"


@functools.lru_cache(64)
def _layout(p: tuple[float, ...]) -> Layout:
    """Lay out noses, pockets and jaws, in the order in which one comes by, counterclockwise from the bottom left corner."""
    if not _any_pocket(p):
        return Layout([], [])
    noses = [(*_nose(p, place), TURNS[place // 2]) for place in range(8) if place % 2 == 0 or _has_pocket(p, place)]
    mouths = []
    for place in range(8):
        if _has_pocket(p, place):
            center, before, after = _mouth(p, place)
            mouths.append(Mouth(Pocket(PLACES[place], center, p[(SIDE if place % 2 else CORNER) + 4]), before, after))
    return Layout(noses, mouths)
