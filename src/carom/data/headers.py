"""Headers of tables: which quantity a column holds, and in which unit.

A header is a known name, alone (SI units), with a unit at its end (``v_n_in_m_s``, ``radius_mm``), with one in brackets
(``velocity_x [mm/s]``), or with one after a slash, a comma or the word in (``radius/mm``, ``radius, mm``, ``radius in mm``).
Case does not matter, nor does a space for an underscore.
"""

from __future__ import annotations

import re
import unicodedata
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Literal

from carom.core.units import UNITS, Unit, unit_named
from carom.errors import Fault

# The columns of a table of incoming states: name -> dimension, and other names of the same quantity.
STATE_COLUMNS: dict[str, tuple[str, tuple[str, ...]]] = {
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
# Columns of rebounds in other forms than components, before (in) and after (out) the contact: name -> dimension, other names.
WRITTEN_COLUMNS: dict[str, tuple[str, tuple[str, ...]]] = {
    "speed_in": ("speed", ("speed", "v_in", "v1", "impact_speed", "velocity_in", "v", "velocity", "impact_velocity")),
    "speed_out": ("speed", ("v_out", "v2", "rebound_speed", "velocity_out")),
    "incidence": (
        "angle",
        (*STATE_COLUMNS["incidence"][1], "angle_in_from_normal", "angle_of_incidence", "theta1", "angle1"),
    ),
    "reflection": (
        "angle",
        (
            "reflection_from_normal",
            "reflection_angle",
            "theta_out",
            "angle_out",
            "angle_out_from_normal",
            "rebound_angle",
            "reflection_out",
            "theta2",
            "angle2",
        ),
    ),
    "incidence_from_surface": ("angle", ("angle_in_from_surface", "grazing_angle_in", "impact_angle_from_surface")),
    "reflection_from_surface": ("angle", ("angle_out_from_surface", "grazing_angle_out", "rebound_angle_from_surface")),
    "e_n": ("number", ("en", "e_y", "e", "cor", "restitution", "coefficient_of_restitution", "normal_restitution")),
    "e_t": ("number", ("et", "tangential_speed_ratio", "v_t_ratio")),
    "e_x": ("number", ("ex", "e_t_cross", "e_x_cross")),
    "beta": ("number", ("beta_walton", "beta_0", "beta0", "rotational_restitution", "tangential_restitution")),
    "drop_height": ("length", ("h_drop", "h1", "height_in", "initial_height")),
    "peak_height": (
        "length",
        ("height", "heights", "h", "apex_height", "max_height", "maximum_height", "peak", "apex"),
    ),
    "rebound_height": ("length", ("bounce_height", "h_rebound", "h_bounce", "h2", "height_out")),
    "time_before": ("time", ("flight_time_in", "t_before", "time_in")),
    "time_after": ("time", ("flight_time_out", "t_after", "time_out")),
    "flight_time": ("time", ("time_between_bounces", "bounce_interval", "interval")),
    **{f"v{k}_in": ("speed", (f"v_{k}_in", f"velocity_{k}_in", f"velocity_{k}", f"v_{k}", f"v{k}")) for k in "xy"},
    **{f"v{k}_out": ("speed", (f"v_{k}_out", f"velocity_{k}_out")) for k in "xy"},
    **{
        f"normalised_spin_{side}": (
            "number",
            tuple(f"{name}_{side}" for name in ("normalized_spin", "spin_factor", "spin_parameter", "spin_ratio", "s")),
        )
        for side in ("in", "out")
    },
}
# Words of the headers of a series, one quantity of one ball bounce after bounce (h0, h1, h2; bounce 1 height): quantity -> its
# dimension, and the words that name it. Words beside these; and words of the value before the first bounce, which has no number.
SERIES_WORDS = {
    "height": ("length", {"h", "height", "heights"}),
    "speed": ("speed", {"v", "speed", "velocity"}),
    "flight time": ("time", {"t", "time", "interval", "flight", "duration"}),
    "angle": ("angle", {"theta", "angle"}),
}  # fmt: skip
_FILLERS = {
    "after", "apex", "at", "ball", "bounce", "bounces", "impact", "max", "maximum", "nd", "no", "nr", "number", "of", "peak", "rd",
    "rebound", "st", "th", "the",
}  # fmt: skip
_FIRST = {"drop", "dropped", "initial", "release", "start", "starting", "from"}
_ORDINALS = {"first": "1", "second": "2", "third": "3", "fourth": "4", "fifth": "5", "sixth": "6"}
# A column of the table of rebounds, and its cell in rows of which only the direction after the contact is known
DIRECTION_COLUMN, DIRECTION_UNIT = "unit_of_v_t_out", "speed_out"
NO_UNIT = ("", "-", "–", "1")  # below the header of a column of pure numbers
# (bounded, as all patterns that are searched in cells: else the time grows as the square of a damaged cell's length)
BRACKETS = re.compile(r"^(.{0,200}?)\s{0,9}[\[(]([^\])]{0,99})[\])]$")
_NAME_AND_UNIT = re.compile(r"^(.{0,200}?\S)\s{0,9}(?:/|,|\bin\s)\s{0,9}(\S.{0,99})$", re.IGNORECASE)
# (the longest first: m_s before s)
_SUFFIXES = sorted(
    {suffix for units in UNITS.values() for suffix in units if suffix}, key=lambda text: (-len(text), text)
)

Style = Literal["plain", "suffix", "bracket"]


@dataclass(frozen=True)
class Heading:
    """The meaning of a header: the quantity, the name used for it, its unit, and how the unit is written."""

    quantity: str
    alias: str
    unit: Unit | None
    """None if the unit in brackets is unknown, and for an angle without a unit."""
    style: Style
    dimension: str

    @property
    def units(self) -> str:
        """The units that the quantity may have, for a message."""
        return ", ".join(unit.name for unit in UNITS[self.dimension].values() if unit.name) or "none: a pure number"


class ColumnNames:
    """The names of columns in one kind of table: name -> (dimension, other names of the same quantity)."""

    def __init__(self, names: Mapping[str, tuple[str, tuple[str, ...]]]) -> None:
        self.names = names
        self.known = {
            later: name
            for name, (_dimension, others) in names.items()
            for alias in (name, *others)
            for later in _sided(alias)
        }
        self.by_length = sorted(self.known, key=len, reverse=True)

    def parse(self, header: str) -> Heading | None:
        """Return the meaning of a header; None for any other column, which is passed on unread."""
        if found := BRACKETS.match(header.strip()):
            return self._heading(_normalized(found[1]), "bracket", lambda dimension: unit_named(found[2], dimension))
        text = _normalized(header).removesuffix("_derived")
        if text in self.known:
            return self._heading(text, "plain", _unit_in_si)
        for alias in self.by_length:
            dimension = self.names[self.known[alias]][0]
            unit = UNITS[dimension].get(text.removeprefix(alias + "_")) if text.startswith(alias + "_") else None
            if unit is not None:
                return Heading(self.known[alias], alias, unit, "suffix", dimension)
        return self._with_unit_after_sign(header)

    def _heading(self, alias: str, style: Style, unit: Callable[[str], Unit | None]) -> Heading | None:
        """Return the meaning of a name; None for one that is not known."""
        if alias not in self.known:
            return None
        name = self.known[alias]
        dimension = self.names[name][0]
        return Heading(name, alias, unit(dimension), style, dimension)

    def _with_unit_after_sign(self, header: str) -> Heading | None:
        """Return the meaning of ``x/cm``, ``x, cm`` or ``x in cm``; None unless both the name and the unit are known."""
        if (found := _NAME_AND_UNIT.match(header.strip())) is None:
            return None
        meant = self._heading(_normalized(found[1]), "bracket", lambda dimension: unit_named(found[2], dimension))
        return None if meant is None or meant.unit is None else meant


def _unit_in_si(dimension: str) -> Unit | None:
    """Return the unit of a quantity without one: SI, but none for an angle, as degrees or radians are not guessed."""
    return None if dimension == "angle" else next(iter(UNITS[dimension].values()))


def with_units_below(kinds: Sequence[ColumnNames], headers: Sequence[str], row: Sequence[str]) -> list[str] | None:
    """Return the headers with the units of a row below them, in brackets; None unless all columns of these kinds have one.

    A column of pure numbers may have none, or a dash.
    """
    found = list(headers)
    for i, header in enumerate(headers):
        names = next((names for names in kinds if names.parse(header) is not None), None)
        meaning = None if names is None else names.parse(header)
        if names is None or meaning is None:
            continue
        unit = row[i].strip().strip("()[]") if i < len(row) else ""
        if meaning.dimension == "number" and unit in NO_UNIT:
            continue
        said = names.parse(f"{header.strip()} [{unit}]") if unit and meaning.style == "plain" else None
        if said is None or said.unit is None:
            return None
        found[i] = f"{header.strip()} [{unit}]"
    return found if found != list(headers) else None


def _sided(alias: str) -> list[str]:
    """Return a name with its side of the contact written in other ways: v_in, v_before, inbound_v, incoming_v."""
    for side, others in (("_in", ("_before", "inbound_", "incoming_")), ("_out", ("_after", "outbound_", "outgoing_"))):
        if alias.endswith(side):
            stem = alias.removesuffix(side)
            return [alias, *(stem + other if other.startswith("_") else other + stem for other in others)]
    return [alias]


def series_headings(headers: Sequence[str], faults: list[Fault]) -> dict[int, Heading]:
    """Return the meanings of columns that are a series, by place: the quantity is "height 0", "speed 2", or "sigma_height 0".

    Of a series of two whose names are known, such as v1 and v2, there are none. A number that is missing or there twice is a fault.
    """
    every = {i: meaning for i, header in enumerate(headers) if (meaning := _of_series(header)) is not None}
    known, found = ColumnNames(WRITTEN_COLUMNS), dict[int, Heading]()
    for quantity in SERIES_WORDS:
        places = [i for i, one in every.items() if one.quantity.rpartition(" ")[0] == quantity]
        numbers = sorted(int(every[i].quantity.rpartition(" ")[2]) for i in places)
        names = [None if (one := known.parse(headers[i])) is None else one.quantity for i in places]
        if len(places) < 2 or (len(places) == 2 and None not in names and names[0] != names[1]):
            continue
        if numbers != list(range(numbers[0], numbers[0] + len(numbers))):
            columns = ", ".join(repr(headers[i]) for i in places)
            faults.append(
                Fault("", f"columns {columns}", f"each {quantity} of a series once", f"the numbers {numbers}")
            )
        of_it = {f"{prefix}{quantity} {k}" for prefix in ("", "sigma_") for k in numbers}
        found |= {i: one for i, one in every.items() if one.quantity in of_it}
    return found


def _of_series(header: str) -> Heading | None:
    """Return the meaning of a header as one of a series; None for any other."""
    text = re.sub(r"[\[({](\d+)[\])}]", r"_\1_", unicodedata.normalize("NFKC", header).strip().lower())
    style: Style = "bracket"
    if (found := BRACKETS.match(text)) or ((found := _NAME_AND_UNIT.match(text)) and not re.search(r"\d", found[2])):
        text, name = found[1], found[2]
    else:
        text = _normalized(text)
        name = next((suffix for suffix in _SUFFIXES if text.endswith("_" + suffix)), "")
        text, name, style = text.removesuffix("_" + name), name.replace("_", "/"), "suffix" if name else "plain"
    words = [_ORDINALS.get(word, word) for word in re.findall(r"[^\W\d_]+|\d+", text)]
    prefix = "sigma_" if words and words[0] in ("sigma", "u") else ""
    number = [word for word in words if word.isdecimal()]
    rest = set(words[bool(prefix) :]).difference(number)
    first = not number and bool(rest & _FIRST)
    of_unit = [dimension for dimension in UNITS if name and unit_named(name, dimension) is not None]
    for quantity, (dimension, names) in SERIES_WORDS.items():
        said = bool(rest & names) or (dimension != "angle" and rest and dimension in of_unit)
        if not said or not (len(number) == 1 or first) or rest - names - _FILLERS - (_FIRST if first else set()):
            continue
        unit = unit_named(name, dimension) if name else _unit_in_si(dimension)
        return Heading(f"{prefix}{quantity} {int(*number)}", text, unit, style, dimension)
    return None


STATE_NAMES = ColumnNames(STATE_COLUMNS)


def parse_header(header: str) -> Heading | None:
    """Return the meaning of a header in a table of incoming states; None for any other column."""
    return STATE_NAMES.parse(header)


def missing_unit(where: str, header: str, meaning: Heading) -> Fault:
    """Return the fault of a column whose unit is missing or unknown."""
    example = header_with_unit(meaning.alias, next(iter(UNITS[meaning.dimension].values())), "suffix")
    advice = f"add it to the header, as in {example!r}"
    got = found[2].strip() if (found := BRACKETS.match(header.strip())) else ""
    return Fault(where, f"column {header!r}", f"a unit, one of {meaning.units}", got and repr(got), advice=advice)


def without_unit(header: str) -> str:
    """Return a header without its unit, in lower case, to compare names of columns."""
    found = BRACKETS.match(header.strip())
    text = _normalized(found[1] if found else header)
    for suffix in _SUFFIXES:
        if text.endswith("_" + suffix):
            return text.removesuffix("_" + suffix)
    return text


def header_with_unit(name: str, unit: Unit, style: Style) -> str:
    """Return a header with its unit, written in the style of the table."""
    if style == "plain" or not unit.name:
        return name
    return f"{name} [{unit.name}]" if style == "bracket" else f"{name}_{unit.name.replace('/', '_')}"


def _normalized(header: str) -> str:
    return re.sub(r"\s+", "_", header.strip().lower())
