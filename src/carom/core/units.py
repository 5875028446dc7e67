"""Units of length, speed, spin, angle, time and mass: exact factors to SI, and texts such as ``"61.5 mm"`` as numbers.

One table serves columns and texts. Arrays are converted in floating point, ``x * numerator / denominator``. A text is converted
in decimal arithmetic, so that ``"61.5 mm"`` is the float next to 0.0615, as if it had been written in metres. Units that the
table lacks, and factors with pi, are looked up in pint (Decimal registry), which is imported when first needed.
"""

from __future__ import annotations

import functools
import math
import re
from dataclasses import dataclass
from decimal import Decimal
from typing import Any

import numpy as np


@dataclass(frozen=True)
class Unit:
    """A unit: SI = number * numerator / denominator.

    Two factors, because a division by 1000 is exact where a multiplication by 0.001 is not.
    """

    name: str
    numerator: float = 1.0
    denominator: float = 1.0
    exact: bool = True
    """Whether both factors are exact as written, in decimals: not those with pi."""

    def to_si(self, x: Any) -> Any:
        """Convert numbers in this unit to SI; those too large for a float become infinite."""
        with np.errstate(over="ignore"):
            return x if self.numerator == self.denominator else x * self.numerator / self.denominator

    def from_si(self, x: Any) -> Any:
        """Convert SI numbers to this unit; those too large for a float become infinite."""
        with np.errstate(over="ignore"):
            return x if self.numerator == self.denominator else x * self.denominator / self.numerator


def _units(factors: dict[str, tuple[float, float]], exact: bool = True) -> dict[str, Unit]:
    return {key: Unit(key.replace("_", "/"), *factor, exact) for key, factor in factors.items()}


# Dimension -> the ending of a header (v_n_in_mm_s) -> unit; the SI unit first, but for angles.
UNITS: dict[str, dict[str, Unit]] = {
    "speed": _units({
        "m_s": (1, 1), "cm_s": (1, 100), "mm_s": (1, 1000), "km_h": (1000, 3600), "ft_s": (0.3048, 1), "in_s": (0.0254, 1),
        "mph": (0.44704, 1),
    }),
    "spin": _units({"rad_s": (1, 1)})
    | _units({"deg_s": (math.pi, 180), "rpm": (2 * math.pi, 60), "rev_s": (2 * math.pi, 1)}, exact=False),
    "angle": _units({"deg": (math.pi, 180)}, exact=False) | _units({"rad": (1, 1)}),
    "length": _units({"m": (1, 1), "cm": (1, 100), "mm": (1, 1000), "in": (0.0254, 1)}),
    "time": _units({"s": (1, 1), "ms": (1, 1000)}),
    "mass": _units({"kg": (1, 1), "g": (1, 1000), "oz": (0.028349523125, 1)}),
    "acceleration": {"m_s2": Unit("m/s^2")},
    "number": {"": Unit("")},
}  # fmt: skip
# Other spellings of units in brackets, as in "spin [s^-1]".
SPELLINGS = {
    "m s^-1": "m/s",
    "m s-1": "m/s",
    "rad s^-1": "rad/s",
    "rad s-1": "rad/s",
    "1/s": "rad/s",
    "s^-1": "rad/s",
    "°": "deg",
    "sec": "s", "second": "s", "seconds": "s", "msec": "ms", "milliseconds": "ms",
    "metre": "m", "metres": "m", "meter": "m", "meters": "m",
    "centimetre": "cm", "centimetres": "cm", "centimeter": "cm", "centimeters": "cm",
    "millimetre": "mm", "millimetres": "mm", "millimeter": "mm", "millimeters": "mm",
}  # fmt: skip
# Units of quantities that end no header (t_min is a least time), and need no pint, whose import takes half a second.
_OF_CLOCKS = {"min": Unit("min", 60.0), "h": Unit("h", 3600.0)}
_DIMENSION_OF = {
    "m": "length", "m/s": "speed", "m/s^2": "acceleration", "kg": "mass", "s": "time", "rad/s": "spin",
}  # fmt: skip
LONGEST_NAME = 60  # of a unit
_QUANTITY = re.compile(r"\s*((?>[-+]?(?:\d[\d_]*\.?\d*|\.\d+)(?:[eE][-+]?\d+)?))\s*(\S.*)")


_COMMA = re.compile(r"(\s*[-+]?)(\d*),(\d+)(?![\d.,])(?s:(.*))")


def decimal_point(text: str) -> str:
    """Return a text that is a number, maybe with a unit, with a point for its decimal comma; 1,500 may be a thousand, and stays.

    >>> decimal_point("28,6mm"), decimal_point("0,028"), decimal_point("1,500"), decimal_point("1,2,3")
    ('28.6mm', '0.028', '1,500', '1,2,3')
    """
    found = _COMMA.fullmatch(text)
    if found is None or "," in found[4] or (len(found[3]) == 3 and found[2].strip("0")):
        return text
    return f"{found[1]}{found[2]}.{found[3]}{found[4]}"


def unit_named(text: str, dimension: str) -> Unit | None:
    """Return the unit of a dimension that is written so, as in ``mm/s``; None if the table has none."""
    text = SPELLINGS.get(text.strip(), text.strip())
    if dimension == "number" and text in ("", "1", "-"):
        return UNITS["number"][""]
    return next((unit for unit in UNITS[dimension].values() if unit.name == text), None)


@functools.cache
def _registry() -> Any:
    """The unit registry of pint, with decimal numbers."""
    import pint

    units: Any = pint.UnitRegistry(non_int_type=Decimal)
    units.define("@alias turn = rev")
    return units


def in_si(value: Any, unit: str) -> Any:
    """Return the number of a text such as "26 mm" in an SI unit; anything else, and a text that is none, as it is.

    >>> in_si("26 mm", "m"), in_si(0.026, "m"), in_si("26", "m")
    (0.026, 0.026, '26')
    """
    if not isinstance(value, str):
        return value
    try:
        return parse_quantity(value, unit)
    except ValueError:
        return value


def parse_quantity(text: str, unit: str) -> float:
    """Return the number that a text such as ``"61.5 mm"`` is in an SI unit (or in ``degree``), rounded once.

    Raises ValueError, with the reason if there is one, for a text that is no number with a unit of this kind.

    Examples
    --------
    >>> parse_quantity("61.5 mm", "m")
    0.0615
    >>> parse_quantity("30 rpm", "rad/s")
    3.141592653589793
    """
    found = _QUANTITY.fullmatch(decimal_point(text))
    if found is None:
        raise ValueError
    amount, name = Decimal(found[1].replace("_", "")), found[2].strip()
    known = unit_named(name, _DIMENSION_OF[unit]) if unit in _DIMENSION_OF else None
    if unit == "s":
        known = known or _OF_CLOCKS.get(name)
    if known is not None and known.exact:
        return float(amount * Decimal(repr(known.numerator)) / Decimal(repr(known.denominator)))
    units = _registry()
    if len(name) > LONGEST_NAME:  # pint takes minutes for some long texts
        raise ValueError(f"{name[:LONGEST_NAME]!r}... is not a known unit")
    try:
        given = units.parse_units(name)
    except Exception:  # pint hands on what its parser stumbles over, of many classes
        raise ValueError(f"{name!r} is not a known unit") from None
    if not given.is_compatible_with(unit):
        raise ValueError(f"{name!r} is a unit of another quantity")
    if unit == "rad/s" and "hertz" in str(given):
        raise ValueError("'Hz' may mean turns or radians per second; write rev/s or rad/s")
    return float(units.Quantity(amount, given).to(unit).magnitude)


AIR, OSMIUM = 1.2, 22_600.0  # kg/m^3: density of nearly every ball lies between


def unlikely_density(radius: float, mass: float) -> str:
    """Return the line about a ball that is lighter than air or denser than any metal (m, kg); "" for all others."""
    density = mass / (4 / 3 * math.pi * radius**3)
    is_ball = f"{mass:g} kg with a radius of {radius:g} m"
    if density < AIR:
        return f'{is_ball}: lighter than air; is the radius in mm? write "{radius:g} mm"'
    return f'{is_ball}: denser than any metal; is the mass in g? write "{mass:g} g"' if density > OSMIUM else ""
