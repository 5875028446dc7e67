"""The numbers of a scene, each with what is expected of it: lengths, speeds, masses, with a unit where one is written."""

from __future__ import annotations

import functools
import math
import re
from collections.abc import Iterable
from dataclasses import dataclass
from decimal import Decimal
from numbers import Real
from typing import Annotated, Any

import numpy as np
from pydantic import AfterValidator, BeforeValidator, Strict

from carom.checks import LARGEST, within
from carom.scene.faults import Fault

__all__ = [
    "Acceleration", "Angle", "Coefficient", "Components", "Direction", "Extent", "Flag", "Friction", "Length", "Mass",
    "NotNegative", "Number", "Place", "Point", "PositiveNumber", "Share", "Size", "Sizes", "Speed", "Spin", "Spring",
    "Time", "Vector",
]  # fmt: skip

Vector = tuple[float, float, float]
QUANTITY = re.compile(r"\s*((?>[-+]?(?:\d[\d_]*\.?\d*|\.\d+)(?:[eE][-+]?\d+)?))\s*(\S.*)")
EXAMPLES = {
    "m": "61.5 mm", "m/s": "2 m/s", "m/s^2": "9.81 m/s^2", "kg": "210 g", "s": "10 s", "rad/s": "30 rev/s", "degree": "0.5 rad",
    "J": "2 uJ", "1/s": "50 Hz",
}  # fmt: skip
# Powers of ten that need no registry, whose loading takes longer than most runs: what nearly every scene is written in.
PLAIN = {
    "m": {"m": 0, "cm": -2, "mm": -3}, "kg": {"kg": 0, "g": -3}, "s": {"s": 0, "ms": -3}, "m/s": {"m/s": 0, "mm/s": -3},
    "m/s^2": {"m/s^2": 0}, "rad/s": {"rad/s": 0},
}  # fmt: skip


@functools.cache
def _units() -> Any:
    """The unit registry. Decimal numbers: "61.5 mm" is the float next to 0.0615, as if it had been written so."""
    import pint

    units: Any = pint.UnitRegistry(non_int_type=Decimal)
    units.define("@alias turn = rev")
    return units


def _in_unit(text: str, unit: str) -> float:
    """The number that a text like "61.5 mm" is in a unit; ValueError, with the reason, where it is none."""
    found = QUANTITY.fullmatch(text)
    if found is None:
        raise ValueError
    amount = Decimal(found[1].replace("_", ""))
    if (power := PLAIN.get(unit, {}).get(found[2].strip())) is not None:
        return float(amount.scaleb(power))
    units = _units()
    try:
        given = units.parse_units(found[2])
    except Exception:  # pint hands on what its parser stumbles over, of many classes
        raise ValueError(f"{found[2]!r} is no unit that is known") from None
    if not given.is_compatible_with(unit):
        raise ValueError(f"{found[2]!r} is a unit of something else")
    if unit == "rad/s" and "hertz" in str(given):
        raise ValueError("'Hz' leaves open whether turns or radians are meant; write rev/s or rad/s")
    return float(units.Quantity(amount, given).to(unit).magnitude)


@dataclass(frozen=True)
class Number:
    """What is expected of a number; called with what came, it gives a float or raises the fault.

    With a unit, a string like "61.5 mm" is a number too. ``above``: greater than ``least``, not equal to it.
    """

    what: str
    unit: str = ""
    least: float = -math.inf
    most: float = math.inf
    above: bool = False
    infinite: bool = False

    def __call__(self, value: Any) -> float:
        """The number as a float."""
        x = math.nan
        advice = f"units are written as in {EXAMPLES[self.unit]!r}" if self.unit and isinstance(value, str) else ""
        if isinstance(value, str) and self.unit:
            try:
                x = _in_unit(value, self.unit)
            except ValueError as error:
                advice = str(error) or advice
        elif isinstance(value, Real) and not isinstance(value, bool):
            x = _float(value)
        elif isinstance(value, np.ndarray) and value.ndim == 0 and value.dtype.kind in "iuf":
            x = float(value)
        held = self.least < x if self.above else self.least <= x
        if not (held and x <= self.most and (abs(x) <= LARGEST or (self.infinite and math.isinf(x)))):
            raise Fault(within(self.what, x), value, advice).error()
        return x


def _float(value: Real) -> float:
    try:
        return float(value)
    except OverflowError:
        return math.nan


@dataclass(frozen=True)
class Components:
    """What is expected of a vector: so many numbers. Its numbers are looked at afterwards, one by one."""

    what: str
    counts: tuple[int, ...]

    def __call__(self, value: Any) -> tuple[Any, ...]:
        """The components as a tuple."""
        if isinstance(value, Iterable) and not isinstance(value, (str, dict, set)):
            parts = tuple(value)
            if len(parts) in self.counts:
                return parts
        raise Fault(self.what, value).error()


def _not_zero(value: Vector) -> Vector:
    if not any(value):
        raise Fault("a direction, not all zero", list(value)).error()
    return value


Flag = Annotated[bool, Strict()]
Coefficient = Annotated[float, BeforeValidator(Number("a number"))]
PositiveNumber = Annotated[float, BeforeValidator(Number("a number > 0", least=0, above=True))]
NotNegative = Annotated[float, BeforeValidator(Number("a number >= 0", least=0))]
Share = Annotated[float, BeforeValidator(Number("a number from 0 to 1", least=0, most=1))]
Spring = Annotated[float, BeforeValidator(Number("a number from -1 to 1", least=-1, most=1))]
Friction = Annotated[
    float, BeforeValidator(Number("a number >= 0 (inf: never slips)", least=0, infinite=True))
]  # fmt: skip

Length = Annotated[float, BeforeValidator(Number("a length in m", "m"))]
Size = Annotated[float, BeforeValidator(Number("a length in m, > 0", "m", least=0, above=True))]
Extent = Annotated[float, BeforeValidator(Number("a length in m, or inf", "m", infinite=True))]
Mass = Annotated[float, BeforeValidator(Number("a mass in kg, > 0", "kg", least=0, above=True))]
Time = Annotated[float, BeforeValidator(Number("a time in s, > 0", "s", least=0, above=True))]
Speed = Annotated[float, BeforeValidator(Number("a speed in m/s", "m/s"))]
Spin = Annotated[float, BeforeValidator(Number("a spin in rad/s", "rad/s"))]
Acceleration = Annotated[float, BeforeValidator(Number("an acceleration in m/s^2", "m/s^2"))]
Angle = Annotated[float, BeforeValidator(Number("an angle in degrees", "degree"))]

Point = Annotated[
    tuple[Length, Length, Length], BeforeValidator(Components("3 lengths in m: x, y, z", (3,)))
]  # fmt: skip
Place = Annotated[
    tuple[Length, Length], BeforeValidator(Components("2 lengths in m: x, y, as seen from above", (2,)))
]  # fmt: skip
Sizes = Annotated[
    tuple[Size, Size, Size], BeforeValidator(Components("3 lengths in m, > 0: along x, y, z", (3,)))
]  # fmt: skip
Direction = Annotated[
    tuple[Coefficient, Coefficient, Coefficient],
    BeforeValidator(Components("3 numbers: a direction", (3,))),
    AfterValidator(_not_zero),
]
