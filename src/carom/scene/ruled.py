"""Rules about the numbers of a part of a scene: kernels that report codes, and the texts of the faults as data.

Python runs the kernels, and so does the explorer's module; both fill the same texts, so that they say the same.
"""

from __future__ import annotations

import functools
import math
from collections.abc import Callable, Mapping, Sequence
from types import UnionType
from typing import Annotated, Any, ClassVar, NamedTuple, Union, get_args, get_origin

import numpy as np
from pydantic import model_validator

from carom.core.geometry.features import feature_normal, gap_to_feature
from carom.core.jit.kernel import Vec, kernel
from carom.errors import Fault, shown
from carom.formatting import format_length
from carom.scene.schema import Components, Model, raise_faults

MOST_FAULTS, FAULT_COLUMNS = 64, 4
Report = Callable[[Any, Any], int]


class FaultText(NamedTuple):
    """The text of a fault that a kernel reports.

    Names in braces are fields of the part that is checked, and a, b, c the fault's numbers: ``{low}`` as in files, ``{low:g}`` as
    a number, ``{low:m}`` as a length, ``{point:v}`` as a vector, ``{name:s}`` as a text, ``{a:pocket}`` as the name of the pocket
    at a place.
    """

    field: str
    expected: str
    got: str
    advice: str = ""


def format_vector(v: Sequence[float]) -> str:
    """Format a point or a direction; rounding errors are shown as zero."""
    return f"({', '.join(f'{x if abs(x) > 1e-12 else 0:.6g}' for x in v)})"


class _Shown:
    """A value of a fault's text, by the specifications of :class:`FaultText`."""

    def __init__(self, value: Any, places: Sequence[str]) -> None:
        self._value, self._places = value, places

    def __getattr__(self, name: str) -> _Shown:
        return _Shown(getattr(self._value, name), self._places)

    def __format__(self, how: str) -> str:
        value: Any = list(self._value) if isinstance(self._value, tuple) else self._value
        if how == "pocket":
            return self._places[int(value)]
        own: dict[str, Callable[[Any], str]] = {"": shown, "m": format_length, "v": format_vector, "s": str}
        return own[how](value) if how in own else format(value, how)


def filled(text: FaultText, values: Mapping[str, Any], places: Sequence[str] = ()) -> Fault:
    """Return the fault of a text with the values in their places."""
    asked = {name: _Shown(value, places) for name, value in values.items()}
    return Fault("", *(one.format_map(asked) for one in text))


@kernel
def no_faults(p: Sequence[float], out: Any) -> int:
    """Report no fault."""
    return 0


@kernel
def put_fault(code: int, a: float, b: float, c: float, i: int, out: Any) -> int:
    """Write fault number i, its code and three numbers that its text may show; return the number of the next one."""
    if i < out.shape[0]:
        out[i, 0], out[i, 1], out[i, 2], out[i, 3] = code, a, b, c
    return i + 1


# --- numbers of a part --------------------------------------------------------------------------------------------


@functools.cache
def number_fields(model: type[Ruled]) -> dict[str, int | tuple[str, ...]]:
    """Return how many numbers each field that a part's rules read takes in its ``numbers``; 0: a list, which its length precedes.

    Of a part, such as the pockets of a table, the names of its fields, a number each. Texts and choices are no numbers.
    """
    own = {name: model.model_fields[name] for name in model.ruled_fields()}
    counts = {name: _count(info.annotation, list(info.metadata)) for name, info in own.items()}
    return {name: count for name, count in counts.items() if count is not None}


def _count(annotation: Any, metadata: list[Any]) -> int | tuple[str, ...] | None:
    """Return how many numbers a field takes, by its type, or their names; None for a text."""
    while get_origin(annotation) is Annotated:
        annotation, *more = get_args(annotation)
        metadata = [*metadata, *more]
    if get_origin(annotation) in (Union, UnionType):
        return _count(next(one for one in get_args(annotation) if one is not type(None)), metadata)
    for one in metadata:
        if isinstance(one := getattr(one, "func", None), Components):
            return one.counts[0] if len(one.counts) == 1 else 0
    if isinstance(annotation, type) and issubclass(annotation, Model):
        return tuple(annotation.model_fields)
    return 1 if annotation in (float, int, bool) else None


def _flattened(value: Any, count: int | tuple[str, ...]) -> list[float]:
    if value is None:
        return [math.nan] * (len(count) if isinstance(count, tuple) else count)
    if isinstance(value, Model):
        return [x for _name, x in value]
    if not isinstance(value, tuple):
        return [float(value)]
    items = [x for one in value for x in (one if isinstance(one, tuple) else (one,))]
    return items if count else [float(len(value)), *items]


# A scene is made again with another friction or ball, and its walls stay as they are: answers about some walls are kept, unless
# their outlines are long.
KEPT, LONG = 1024, 200


@functools.lru_cache(KEPT)
def fault_rows(report: Report, numbers: tuple[float, ...]) -> list[list[float]]:
    """Return the rows of faults, code and numbers, that a kernel reports about numbers."""
    rows = np.empty((MOST_FAULTS, FAULT_COLUMNS))
    found: list[list[float]] = rows[: report(numbers, rows)].tolist()
    return found


def about(asked: Any, function: Any, numbers: tuple[float, ...]) -> Any:
    """Return the value of a cached function for a kernel and numbers; for many numbers it is computed anew."""
    return asked(function, numbers) if len(numbers) < LONG else asked.__wrapped__(function, numbers)


class Ruled(Model):
    """A part of a scene whose numbers are checked against each other by a kernel."""

    rules: ClassVar[Report] = no_faults
    """(p, rows): write codes of faults with three numbers each; return their number. p are the part's ``numbers``."""
    fault_texts: ClassVar[tuple[FaultText, ...]] = ()
    """Texts of the faults that the rules report, by their codes."""
    ruled: ClassVar[tuple[str, ...]] = ()
    """Names of the fields that the rules read."""
    pocket_places: ClassVar[tuple[str, ...]] = ()

    @classmethod
    def ruled_fields(cls) -> tuple[str, ...]:
        """Return the names of the fields that the rules read."""
        return cls.ruled

    @classmethod
    def fault_rules(cls) -> Report:
        """Return the kernel of its rules."""
        return cls.rules

    @property
    def numbers(self) -> tuple[float, ...]:
        """Return the fields that its rules read as numbers, in their order: what its kernels take.

        A flag is 0 or 1; of what is not given, NaN; a list of any length is preceded by its length.
        """
        fields = number_fields(type(self)).items()
        return tuple(x for name, count in fields for x in _flattened(getattr(self, name), count))

    @model_validator(mode="after")
    def _keeps_its_rules(self) -> Ruled:
        rows = about(fault_rows, self.fault_rules(), self.numbers)
        if rows:
            own = {name: getattr(self, name) for name in type(self).model_fields}
            raise_faults(
                filled(
                    self.fault_texts[int(code)], {**own, **dict(zip("abc", numbers, strict=True))}, self.pocket_places
                )
                for code, *numbers in rows
            )
        return self


# ----------------------------------------------------------------------------------------------------
# Rules about a scene as a whole, whose parts are sound: kernels that report codes, and the texts of the faults as data.
#
# Python asks them of the balls and walls that may be concerned; the explorer's module asks them of all (``carom.explorer.rules``).


TOUCH = 1e-9  # of the radius: what overlaps by less touches
BALLS_TOUCH = 1e-7  # so do balls: a rack in a file is rounded to some digits
DEEPEST = 0.5  # of the radius: softer balls would press deeper, where Hertz's force is no answer
HARDEST = 1e15  # Pa, a thousand times that of diamond: harder balls press less than they may overlap
COLUMNS = 7  # of the rows of faults: code, ball i, wall or other ball k, and four numbers


class BallRow(NamedTuple):
    """A ball as these rules see it."""

    x: float
    y: float
    z: float
    radius: float
    rolling: float
    first: float
    """Number of the first ball of its name."""
    named: float
    """Whether the name was given."""


_GRAVITY = ("gravity", "gravity along -z, as there is a floor", "{gravity:v}")
_FREE = ("balls[{i:g}].position", "a place on the free side of {wall:s}", "{ball.center:v}, where no ball can be")
_ALONE = ("balls[{i:g}].position", "a place where the ball touches nothing")
_SOFT = ("ball_contact.young", "{ball_contact.young:.3g} Pa", "overlap = false takes contacts as hard")

# In their values: gravity, ball_contact; ball, other and wall: balls i and k, and wall k by its place and name; a, b, c, d, and
# place: (b, c, d).
SCENE_FAULTS = (
    FaultText(*_GRAVITY),
    FaultText(*_GRAVITY, "for a tilted floor give floor.slope, such as [0.001, 0] for a fall of 1 mm per metre along x"),
    FaultText(
        "walls[{k:g}]", "a floor, as there is a table", "none",
        "a table is its cushions alone, and balls would fall: add a floor, or set gravity = 0",
    ),
    FaultText(
        "balls[{i:g}].position[2]", "z of at least the radius, {ball.radius:g}", "{a:g}, which overlaps the floor by {b:m}",
        "leave out z to put it on the floor",
    ),
    FaultText("balls[{i:g}].rolling", "a floor to roll on", "true in a scene without one"),
    FaultText(
        "balls[{i:g}].position[2]", "z = radius = {ball.radius:g}", "{a:g} of a ball that rolls", "leave out z, or rolling"
    ),
    FaultText(
        "walls[{k:g}]", "room for a ball of radius {ball.radius:m} (balls[{i:g}])", "room for radii below {a:m}",
        "make the wall larger, or the ball smaller",
    ),
    FaultText(
        "walls[{k:g}].nose_height", "less than {b:m}, the diameter of balls[{i:g}], which would roll under it", "{a}",
        "a cushion's nose stands at 5/4 to 7/5 of the radius",
    ),
    FaultText(*_FREE, "move the ball"),
    FaultText(*_FREE, "move the ball; or turn the normal round"),
    FaultText(
        *_ALONE, "{ball.center:v}, which overlaps {wall:s} by {a:m} at {place:v}", "move it by {a:m} or more"
    ),
    FaultText(*_ALONE, "{ball.center:v}, which overlaps balls[{k:g}] by {a:m}", "move it by {a:m} or more"),
    FaultText("balls[{i:g}].name", "a name that no other ball has", "{name}, as balls[{k:g}] is called"),
    FaultText(
        _SOFT[0], "at least {a:.3g} Pa: softer balls press deeper than {b:m} at {c:.3g} m/s", *_SOFT[1:]
    ),
    FaultText(_SOFT[0], "at most {a:g} Pa", *_SOFT[1:]),
)  # fmt: skip
(
    UPWARDS, ASKEW, TABLE, BELOW, NO_FLOOR, ABOVE, ROOM, NOSE, BLOCKED, BEHIND, OVERLAP, BALLS_OVERLAP, NAME, SOFT, HARD,
) = range(len(SCENE_FAULTS))  # fmt: skip

NEEDED = {"restitution": "a number from 0 to 1, or a form", "friction": "a number >= 0 (inf: never slips)"}
"""The parameter that a wall's law needs."""
LAW_FAULTS = {
    "needed": FaultText("{at:s}.{name:s}", "{expected:s}", "nothing", "the law {law:s} reads it; {others:s} do not need it"),
    "unmet": FaultText("{at:s}", "{expected:s}, for the law {law:s}", "{got:s}"),
    "springs": FaultText(
        "{at:s}.tangential_restitution", "0 for the law {law:s}", "{beta}",
        "that law computes the tangential rebound from springs; omit it, and give stiffness_ratio",
    ),
    "floor": FaultText("", "", "a scene without a floor"),
    "shape": FaultText("", "", "a {shape:s} that meets a ball above or below its centre"),
    "restitution": FaultText("", "", "of the form {form:s}"),
}  # fmt: skip
"""Texts of what a law expects of a scene; of the last three only what came instead, by the part that a condition concerns."""


@kernel
def put(code: int, i: int, k: int, a: float, b: float, c: float, d: float, row: int, out: Any) -> int:
    """Write a fault; return the number of the next one."""
    if row < out.shape[0]:
        out[row, 0], out[row, 1], out[row, 2] = code, i, k
        out[row, 3], out[row, 4], out[row, 5], out[row, 6] = a, b, c, d
    return row + 1


@kernel
def gravity_faults(gravity: Vec, floor: bool, table: int, row: int, out: Any) -> int:
    """Report a floor that does not lie across gravity, and a table (number of the first, or -1) without a floor."""
    if floor and (gravity[0] != 0 or gravity[1] != 0):
        return put(ASKEW, 0, 0, 0.0, 0.0, 0.0, 0.0, row, out)
    if floor and gravity[2] > 0:
        return put(UPWARDS, 0, 0, 0.0, 0.0, 0.0, 0.0, row, out)
    if not floor and gravity[2] < 0 and table >= 0:
        return put(TABLE, 0, table, 0.0, 0.0, 0.0, 0.0, row, out)
    return row


@kernel
def floor_faults(i: int, z: float, a: float, rolling: bool, floor: bool, row: int, out: Any) -> int:
    """Report a ball in the floor, and one that is to roll where it cannot."""
    if floor and z < a * (1 - TOUCH):
        return put(BELOW, i, 0, z, a - z, 0.0, 0.0, row, out)
    if rolling and not floor:
        return put(NO_FLOOR, i, 0, 0.0, 0.0, 0.0, 0.0, row, out)
    if rolling and z > a * (1 + TOUCH):
        return put(ABOVE, i, 0, z, 0.0, 0.0, 0.0, row, out)
    return row


@kernel
def _overlap(i: int, k: int, x: Vec, a: float, features: Any, first: int, end: int, row: int, out: Any) -> int:
    """Report the deepest overlap of a ball with a wall; a face that the ball is behind does not count."""
    least, at = -TOUCH * a, -1
    for f in range(first, end):
        gap = gap_to_feature(features[f], a, x)
        if -a <= gap < least:
            least, at = gap, f
    if at < 0:
        return row
    n = feature_normal(features[at], x)
    back = least + a
    return put(OVERLAP, i, k, -least, x[0] - back * n[0], x[1] - back * n[1], x[2] - back * n[2], row, out)


@kernel
def wall_faults(
    k: int, plane: bool, room: float, nose: float, least: int, most: int, balls: Any, blocked: Any, features: Any, first: int,
    end: int, row: int, out: Any,
) -> int:  # fmt: skip
    """Report a wall that is too small, cushions that a ball would roll under, and balls that are in it or behind it.

    ``least`` and ``most`` are the numbers of the smallest and the largest ball, ``nose`` the height of cushions (NaN: none),
    ``blocked`` tells which balls are where no ball can be; the wall's features are those from ``first`` to ``end``.
    """
    if balls[most][3] >= room:
        return put(ROOM, most, k, room, 0.0, 0.0, 0.0, row, out)
    diameter = 2 * balls[least][3]
    # (there is nothing behind a cushion)
    if nose >= diameter:
        row = put(NOSE, least, k, nose, diameter, 0.0, 0.0, row, out)
    for i in range(len(balls)):
        if blocked[i]:
            row = put(BEHIND if plane else BLOCKED, i, k, 0.0, 0.0, 0.0, 0.0, row, out)
        else:
            x = (balls[i][0], balls[i][1], balls[i][2])
            row = _overlap(i, k, x, balls[i][3], features, first, end, row, out)
    return row


@kernel
def name_fault(i: int, balls: Any, row: int, out: Any) -> int:
    """Report a name that an earlier ball has: a path, and a ball in a table, would be either. (Unnamed balls are "ball 1".)"""
    first = int(balls[i][5])
    if first == i:
        return row
    named = balls[i][6] != 0
    return put(NAME, i if named else first, first if named else i, 0.0, 0.0, 0.0, 0.0, row, out)


@kernel
def pair_fault(i: int, k: int, balls: Any, row: int, out: Any) -> int:
    """Report ball i where it overlaps an earlier ball k."""
    a, b = balls[i][3], balls[k][3]
    x, y, z = balls[i][0] - balls[k][0], balls[i][1] - balls[k][1], balls[i][2] - balls[k][2]
    gap = math.sqrt(x * x + y * y + z * z) - a - b
    return put(BALLS_OVERLAP, i, k, -gap, 0.0, 0.0, 0.0, row, out) if gap < -BALLS_TOUCH * min(a, b) else row


@kernel
def least_young(young: float, modulus: float, speed: float, mass: float, a: float) -> float:
    """Return the modulus (Pa) below which a ball of a speed would press one alike by more than half its radius.

    Two elastic balls press (15 m u^2 / (16 E* sqrt(R*)))^(2/5) deep (K. L. Johnson, Contact Mechanics, 11.4; m and R* are halves).
    ``modulus`` is E* of ``young``.
    """
    deep = DEEPEST * a
    least = 15 * mass / 2 * speed * speed / (16 * math.sqrt(a / 2) * (deep * deep * math.sqrt(deep)))
    return young * least / modulus


@kernel
def stiffness_faults(young: float, modulus: float, speed: float, mass: float, a: float, row: int, out: Any) -> int:
    """Report a modulus that makes balls too soft for the fastest of them, or harder than any matter."""
    least = least_young(young, modulus, speed, mass, a)
    if young < least:
        row = put(SOFT, 0, 0, least, DEEPEST * a, speed, 0.0, row, out)
    if young > HARDEST:
        row = put(HARD, 0, 0, HARDEST, 0.0, 0.0, 0.0, row, out)
    return row
