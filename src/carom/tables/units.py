"""Headers of tables: which quantity a column holds, and in which unit.

A header is a known name, alone (SI units), with a unit at its end (``v_n_in_m_s``, ``radius_mm``) or with one in
brackets (``velocity_x [mm/s]``). Case does not matter, nor does a space for an underscore.
"""

from __future__ import annotations

import math
import re
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, Literal

__all__ = ["NAMES", "UNITS", "Heading", "Unit", "Words", "bare", "heading"]


@dataclass(frozen=True)
class Unit:
    """A unit: SI = number * up / down. Two factors, because a division by 1000 is exact where 0.001 times is not."""

    name: str
    up: float = 1.0
    down: float = 1.0

    def to_si(self, x: Any) -> Any:
        """Numbers in this unit, in SI."""
        return x if self.up == self.down else x * self.up / self.down

    def from_si(self, x: Any) -> Any:
        """SI numbers, in this unit."""
        return x if self.up == self.down else x * self.down / self.up


def _units(**factors: tuple[float, float]) -> dict[str, Unit]:
    return {key: Unit(key.replace("_", "/"), up, down) for key, (up, down) in factors.items()}


PI = math.pi
UNITS = {
    "speed": _units(
        m_s=(1, 1),
        cm_s=(1, 100),
        mm_s=(1, 1000),
        km_h=(1000, 3600),
        ft_s=(0.3048, 1),
        in_s=(0.0254, 1),
        mph=(0.44704, 1),
    ),
    "spin": _units(rad_s=(1, 1), deg_s=(PI, 180), rpm=(2 * PI, 60), rev_s=(2 * PI, 1)),
    "angle": _units(deg=(PI, 180), rad=(1, 1)),
    "length": _units(m=(1, 1), cm=(1, 100), mm=(1, 1000), **{"in": (0.0254, 1)}),
    "time": _units(s=(1, 1), ms=(1, 1000)),
    "mass": _units(kg=(1, 1), g=(1, 1000), oz=(0.028349523125, 1)),
    "number": {"": Unit("")},
}
# Ways to write a unit in brackets, besides the keys above with a slash.
SPELT = {
    "m s^-1": "m/s",
    "m s-1": "m/s",
    "rad s^-1": "rad/s",
    "rad s-1": "rad/s",
    "1/s": "rad/s",
    "s^-1": "rad/s",
    "°": "deg",
}

# What may stand in a table: name -> dimension, and the other names by which people call it.
NAMES: dict[str, tuple[str, tuple[str, ...]]] = {
    **{f"velocity_{k}": ("speed", (f"v_{k}", f"v{k}")) for k in "xyz"},
    **{f"spin_{k}": ("spin", (f"omega_{k}", f"w_{k}", f"w{k}")) for k in "xyz"},
    "v_n_in": ("speed", ("vn_in",)),
    "v_t_in": ("speed", ("vt_in",)),
    "spin_in": ("spin", ("spin_y_in",)),
    "spin_z_in": ("spin", ()),
    "speed": ("speed", ("speed_in", "v_in")),
    "incidence": ("angle", ("incidence_from_normal", "incidence_angle", "theta_in", "angle_in")),
    "radius": ("length", ()),
    "mass": ("mass", ()),
    "kappa": ("number", ()),
    "restitution": ("number", ()),
    "friction": ("number", ()),
    "tangential_restitution": ("number", ()),
    "stiffness_ratio": ("number", ()),
    "floor_restitution": ("number", ()),
    "floor_friction": ("number", ()),
    "floor_tangential_restitution": ("number", ()),
    "height": ("length", ()),
    **{f"normal_{k}": ("number", ()) for k in "xyz"},
}
BRACKETS = re.compile(r"^(.*?)\s*[\[(]([^\])]*)[\])]$")
# (the longest first: m_s before s)
SUFFIXES = sorted(
    {suffix for units in UNITS.values() for suffix in units if suffix}, key=lambda text: (-len(text), text)
)

Style = Literal["plain", "suffix", "bracket"]


@dataclass(frozen=True)
class Heading:
    """What a header says: the quantity, the name used for it, its unit, and how the unit is written."""

    quantity: str
    alias: str
    unit: Unit | None
    """None where the unit in brackets is unknown, or where an angle has none."""
    style: Style
    dimension: str

    @property
    def units(self) -> str:
        """The units that the quantity may have, for a message."""
        return ", ".join(unit.name for unit in UNITS[self.dimension].values() if unit.name) or "none: a pure number"


def _plain(header: str) -> str:
    return re.sub(r"\s+", "_", header.strip().lower())


class Words:
    """The names that a kind of table knows: name -> (dimension, the other names by which people call it)."""

    def __init__(self, names: Mapping[str, tuple[str, tuple[str, ...]]]) -> None:
        self.names = names
        self.known = {alias: name for name, (_dimension, others) in names.items() for alias in (name, *others)}
        self.by_length = sorted(self.known, key=len, reverse=True)

    def heading(self, header: str) -> Heading | None:
        """What a header means; None for a column that is none of these, which passes through."""
        found = BRACKETS.match(header.strip())
        if found:
            alias = _plain(found[1])
            name = self.known.get(alias)
            if name is None:
                return None
            dimension = self.names[name][0]
            text = SPELT.get(found[2].strip(), found[2].strip())
            return Heading(name, alias, _unit_called(text, dimension), "bracket", dimension)
        text = _plain(header).removesuffix("_derived")
        if text in self.known:
            name = self.known[text]
            dimension = self.names[name][0]
            # an angle without a unit is a guess that nobody should make
            unit = None if dimension == "angle" else next(iter(UNITS[dimension].values()))
            return Heading(name, text, unit, "plain", dimension)
        for alias in self.by_length:
            if not text.startswith(alias + "_"):
                continue
            name = self.known[alias]
            dimension = self.names[name][0]
            unit = UNITS[dimension].get(text.removeprefix(alias + "_"))
            if unit is not None:
                return Heading(name, alias, unit, "suffix", dimension)
        return None


WORDS = Words(NAMES)


def heading(header: str) -> Heading | None:
    """What a header of a table of states means; None for a column that is none of carom's, which passes through."""
    return WORDS.heading(header)


def _unit_called(text: str, dimension: str) -> Unit | None:
    if dimension == "number" and text in ("", "1", "-"):
        return UNITS["number"][""]
    return next((unit for unit in UNITS[dimension].values() if unit.name == text), None)


def bare(header: str) -> str:
    """A header without its unit, in small letters: to see whether a table has a column of some name already."""
    found = BRACKETS.match(header.strip())
    text = _plain(found[1] if found else header)
    for suffix in SUFFIXES:
        if text.endswith("_" + suffix):
            return text.removesuffix("_" + suffix)
    return text


def written(name: str, unit: Unit, style: Style) -> str:
    """A new header in the manner of the table's own."""
    if style == "plain" or not unit.name:
        return name
    return f"{name} [{unit.name}]" if style == "bracket" else f"{name}_{unit.name.replace('/', '_')}"
