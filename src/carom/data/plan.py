"""Plan of a prediction from the headers of a table: which columns are read, what is assumed, which columns are added."""

from __future__ import annotations

import math
from collections import defaultdict
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any, Literal

import numpy as np

from carom.bodies import Ball, rolling
from carom.core.units import UNITS, Unit
from carom.data.headers import (
    WRITTEN_COLUMNS,
    ColumnNames,
    Heading,
    Style,
    header_with_unit,
    missing_unit,
    parse_header,
    without_unit,
)
from carom.data.rebounds import PASSED_ON, not_used
from carom.errors import (
    MAX_MAGNITUDE,
    MIN_MAGNITUDE,
    CaromError,
    Fault,
    FaultList,
    near_name,
    require_type,
)
from carom.laws.law import SURFACES, Law, Meeting
from carom.public.defaults import LIKE_SOLIDS

SpinRule = Literal["rolling", "none"]

# The paper's ball and surfaces, unless a column or an option gives the number, or the law has its authors' own.
DEFAULTS: dict[str, float] = {
    "radius": 0.02625, "mass": 0.1406, "kappa": 2 / 5,
    "restitution": 1.0, "friction": math.inf, "tangential_restitution": 0.0,
    "floor_restitution": 0.0, "floor_friction": math.inf, "floor_tangential_restitution": 0.0,
    "height": 0.0, "stiffness_ratio": LIKE_SOLIDS,
}  # fmt: skip
PARAMETERS = tuple(DEFAULTS)
BOUNCE = "bounce"  # the number of a contact of its ball, in tables of carom tracks
FORMS = (
    "velocity_x, velocity_y (velocity_z, spin_x, spin_y, spin_z)",
    "v_n_in (v_t_in, and spin_in or spin_z_in)",
    "speed, incidence_deg (spin_in or spin_z_in)",
)


@dataclass(frozen=True)
class PredictSettings:
    """The law of a prediction, and numbers that the table lacks.

    Examples
    --------
    >>> import carom
    >>> from carom.data import PredictSettings
    >>> PredictSettings(carom.LAWS["two-step"], given={"restitution": 0.9}, contact_height=1.4).gravity
    9.80665
    """

    law: Law
    given: dict[str, float] = field(default_factory=dict)
    """Numbers (SI) by the name of a column; they take precedence over columns."""
    normal: tuple[float, float, float] | None = None
    contact_height: float = 1.0
    """Height at which the wall touches the ball, in radii above the floor: 1 for a vertical wall, 1.4 for a snooker cushion."""
    spin: SpinRule | None = None
    gravity: float = 9.80665
    floor_contact: Literal["with", "after"] = "with"
    suffix: str | None = None


@dataclass(frozen=True)
class InputColumn:
    """A column that is read."""

    index: int
    header: str
    unit: Unit


@dataclass(frozen=True)
class OutputColumn:
    """A column that is added."""

    header: str
    unit: Unit


@dataclass(frozen=True)
class TablePlan:
    """How to read a row, and what to add to it."""

    settings: PredictSettings
    form: Literal["vector", "bounce", "angle"]
    air: bool
    """Whether it is a planar bounce of a ball in flight, without a floor; else a ball in space or on a table."""
    spin: Literal["given", "rolling", "none"]
    sources: dict[str, InputColumn]
    constants: dict[str, float]
    added: list[OutputColumn]
    rolls: bool
    """Whether the state once the ball rolls again is added as well."""
    note: str
    """Header of the column with the reason why a row has no answer."""
    notes: list[str]
    """Assumptions made."""

    @property
    def may_be_empty(self) -> tuple[str, ...]:
        """The columns that are read whose cells may be empty: the spin before, and the number of the bounce."""
        return tuple(name for name in ("spin_in", "spin_z_in", BOUNCE) if name in self.sources)


def make_plan(headers: list[str], settings: PredictSettings) -> TablePlan:
    """Return the plan for a table with these headers. Raises CaromError, one line per problem, if it cannot be read."""
    require_type("PredictSettings", "law", settings.law, Law)
    faults = FaultList()
    columns = _meanings(headers, settings, faults)
    form = _form(headers, columns, settings, faults)
    faults.raise_if_any()
    if "speed" in settings.given and form != "angle":
        faults.add("`speed`", "a table with incidence_deg", "one with the velocity", "leave it out")
    wanted, missing = _wanted(form, columns, settings)
    faults += [_missing(name, form, headers) for name in missing]
    air = form != "vector" and _in_air(columns, settings)
    if air and settings.contact_height != 1:
        got = "one in flight (a law of a single contact, or a spin_in column)"
        faults.add("`contact_height`", "a ball on a table", got)
    spin, remarks = _spin(form, air, columns, settings, faults)
    idle = unread(settings.law)
    columns, idle_columns = (
        {name: column for name, column in columns.items() if (name in idle) is one} for one in (False, True)
    )
    sources, constants = _sources(wanted, columns, settings, faults)
    if air and BOUNCE in headers:  # it says of which contacts a spin that was not measured is not that of the throw
        sources[BOUNCE] = InputColumn(headers.index(BOUNCE), BOUNCE, Unit(""))
    faults.raise_if_any()
    rolls = not air and _has_steps(settings.law)
    added, note, renamed = _added(headers, form, air, rolls, columns, settings)
    notes = [
        _reading(form, air, sources),
        *remarks,
        *_assumed(constants, settings, air),
        *_near_misses(headers, wanted, columns),
        *renamed,
    ]
    notes += [
        f"not read, since the law {settings.law.name} does not use it: {what}"
        for what in (
            ", ".join(f"column {source.header!r}" for source, _heading in idle_columns.values()),
            ", ".join(name for name in settings.given if name in idle),
        )
        if what
    ]
    unused = [name for name in settings.given if air and name.startswith(("floor", "height")) and name not in idle]
    notes += [f"not used, since the ball is in flight: {', '.join(unused)}"] if unused else []
    return TablePlan(
        settings, form, air, spin, sources, constants, added, rolls, note, [text for text in notes if text]
    )


def unread(law: Law) -> list[str]:
    """Return the numbers of wall and floor that a law does not read, if it declares what it reads."""
    return [] if law.reads is None else [name for name in SURFACES if name not in law.reads]


Columns = dict[str, tuple[InputColumn, Heading]]
WRITTEN_NAMES = ColumnNames(WRITTEN_COLUMNS)  # of what was measured, after the contact too


def _meanings(headers: list[str], settings: PredictSettings, faults: FaultList) -> Columns:
    """Return quantity -> its column; two columns for one quantity, or an unknown unit, are faults."""
    found: dict[str, list[tuple[InputColumn, Heading]]] = defaultdict(list)
    for index, header in enumerate(headers):
        meaning = parse_header(header)
        if meaning is None or meaning.quantity in settings.given:
            continue
        unit = meaning.unit or Unit("")
        if meaning.unit is None:
            faults.append(missing_unit("", header, meaning))
        found[meaning.quantity].append((InputColumn(index, header, unit), meaning))
    for quantity, those in found.items():
        if len(those) > 1:
            names = " and ".join(f"{source.header!r} (column {source.index + 1})" for source, _ in those)
            faults.add(f"columns {names}", f"one column for {quantity}", f"{len(those)}", "rename the others")
    return {quantity: those[0] for quantity, those in found.items()}


def _form(
    headers: list[str], columns: Columns, settings: PredictSettings, faults: FaultList
) -> Literal["vector", "bounce", "angle"]:
    if "velocity_x" in columns or "velocity_y" in columns:
        return "vector"
    if "v_n_in" in columns or "v_t_in" in columns:
        return "bounce"
    if "speed" in columns or "incidence" in columns:
        return "angle"
    if not faults:
        meant = ("velocity_x", "v_n_in", "speed", "incidence_deg")
        near = next(filter(None, (near_name(name, headers) for name in meant)), "")
        expected = f"an incoming state, {'; or '.join(FORMS)}; got {', '.join(map(repr, headers)) or 'none'}"
        faults.add("columns", expected, "", f"rename {near!r}" if near else "")
    return "angle"


def _missing(name: str, form: str, headers: list[str]) -> Fault:
    near = near_name(name, [header for header in headers if parse_header(header) is None])
    advice = f"rename {near!r}" if near else f"the table has {', '.join(map(repr, headers))}"
    return Fault("", f"column {name!r}", f"this column for the {form} form", "none", advice)


def _near_misses(headers: list[str], wanted: list[str], columns: Columns) -> list[str]:
    """Return notes on unread columns: with nearly the name of a missing one (a typing error, or an unknown unit), and others."""
    free = [name for name in (*wanted, *PARAMETERS) if name not in columns]
    notes, rest = [], []
    for header in headers:
        name = without_unit(header)
        if parse_header(header) is not None or "out" in name.split("_"):
            continue
        near = next((known for known in free if name.startswith(known + "_")), "") or near_name(name, free)
        if near:
            notes.append(f"not read: column {header!r}; did you mean {near!r}, or {near!r} with a known unit?")
        elif not (PASSED_ON.fullmatch(name) or name.startswith("sigma_") or WRITTEN_NAMES.parse(header)):
            rest.append(header)
    return notes + not_used(rest)


def _wanted(form: str, columns: Columns, settings: PredictSettings) -> tuple[list[str], list[str]]:
    """Return which quantities are read, and which required ones are missing."""
    if form == "vector":
        wanted = ["velocity_x", "velocity_y", "velocity_z", "spin_x", "spin_y", "spin_z"]
        must = ["velocity_x", "velocity_y"]
        normals = [name for name in ("normal_x", "normal_y", "normal_z") if name in columns]
        if normals and settings.normal is None:
            wanted += ["normal_x", "normal_y", "normal_z"]
            must += ["normal_x", "normal_y"]
    elif form == "bounce":
        wanted, must = ["v_n_in", "v_t_in", "spin_in", "spin_z_in"], ["v_n_in"]
    else:
        wanted, must = ["speed", "incidence", "spin_in", "spin_z_in"], ["speed", "incidence"]
    missing = [name for name in must if name not in columns and name not in settings.given]
    label = {"incidence": "incidence_deg"}
    return wanted, [label.get(name, name) for name in missing]


def _in_air(columns: Columns, settings: PredictSettings) -> bool:
    if "spin_in" in columns:
        return True
    return settings.law.in_flight and "spin_z_in" not in columns and settings.spin != "rolling"


def _spin(
    form: str, air: bool, columns: Columns, settings: PredictSettings, faults: FaultList
) -> tuple[Literal["given", "rolling", "none"], list[str]]:
    level = [name for name in ("spin_x", "spin_y") if name in columns] if form == "vector" else []
    if len(level) == 1:
        missing = "spin_y" if level == ["spin_x"] else "spin_x"
        expected = f"this column beside {level[0]!r}"
        faults.add(f"column {missing!r}", expected, "none", "give both, or neither and `spin`")
    if "spin_in" in columns and "spin_z_in" in columns and form != "vector":
        faults.add("columns", "spin_in (a planar bounce) or spin_z_in (a ball on a table)", "both")
    if level or (air and "spin_in" in columns):
        if settings.spin is not None and (level or settings.spin == "rolling"):
            faults.add(f"`spin` {settings.spin}", "", "", "has no effect, as the table has the spin; omit it")
        return "given", []
    rule = settings.spin or ("none" if settings.law.in_flight else "rolling")
    about = " about level axes" if form != "vector" and not air else ""
    meant = {
        "rolling": f"no spin{about} in the table: the ball is taken to roll on the floor (`spin` none: no spin)",
        "none": f"no spin{about} in the table: taken as 0"
        + ("" if air else " (`spin` rolling: the ball rolls on the floor)"),
    }
    if rule == "rolling" and air:
        faults.add("`spin` rolling", "a ball on a table", "one in flight", "leave it out")
    return rule, [meant[rule]]


def _sources(
    wanted: list[str], columns: Columns, settings: PredictSettings, faults: FaultList
) -> tuple[dict[str, InputColumn], dict[str, float]]:
    sources: dict[str, InputColumn] = {}
    constants: dict[str, float] = {}
    for name in [*wanted, *PARAMETERS]:
        if name in settings.given:
            constants[name] = settings.given[name]
        elif name in columns:
            sources[name] = columns[name][0]
        elif name in DEFAULTS:
            constants[name] = settings.law.defaults.get(name, DEFAULTS[name])
        elif not (name.startswith("spin") or name == "incidence"):
            constants[name] = 0.0
    faults += bad_numbers(constants, settings.normal, settings.contact_height, settings.gravity)
    return sources, constants


def _has_steps(law: Law) -> bool:
    """Return whether a law also gives the motion after the wall, by trying it on the paper's ball."""
    try:
        return law.answer(Meeting(Ball(), rolling(Ball()))).steps is not None
    except Exception:  # an error of a user's law is reported at the first row
        return False


def _added(
    headers: list[str], form: str, air: bool, rolls: bool, columns: Columns, settings: PredictSettings
) -> tuple[list[OutputColumn], str, list[str]]:
    """Return the added columns in the style of the table; ``_predicted`` is appended if a name exists already."""
    stem, spin_stem = "velocity_", "spin_"
    if form == "vector":
        first = columns["velocity_x"][1]
        stem = first.alias[:-1]
        spin_stem = columns["spin_x"][1].alias[:-1] if "spin_x" in columns else "spin_"
    else:
        first = columns.get("v_n_in", columns.get("speed", (None, None)))[1] or columns["incidence"][1]
    speed_unit = first.unit if first.quantity != "incidence" and first.unit else UNITS["speed"]["m_s"]
    spin = next((columns[name][1] for name in ("spin_in", "spin_z_in", "spin_x") if name in columns), None)
    spin_unit = spin.unit if spin and spin.unit else UNITS["spin"]["rad_s"]
    names: list[tuple[str, str, Unit, Style]] = []  # before and after the stage's name, the unit and how it is written

    def add(stage: str, speeds: list[str], spins: list[str]) -> None:
        names.extend((name, stage, speed_unit, first.style) for name in speeds)
        names.extend((name, stage, spin_unit, first.style) for name in spins)
        if form == "angle":
            angle = columns["incidence"][1]
            names.append(("speed", stage, speed_unit, first.style))
            names.append(("reflection", stage, angle.unit or UNITS["angle"]["deg"], angle.style))

    if form == "vector":
        for stage in ("out", "rolling")[: 1 + rolls]:
            add(stage, [stem + k for k in "xyz"], [spin_stem + k for k in "xyz"])
    elif air:
        add("out", ["v_n", "v_t"], [(spin.alias if spin else "spin_in").removesuffix("_in")])
    else:
        add("out", ["v_n", "v_t", "v_z"], ["spin_n", "spin_t", "spin_z"])
        if rolls:
            add("rolling", ["v_n", "v_t"], ["spin_z"])

    there = {without_unit(header) for header in headers}
    asked = None if not settings.suffix else settings.suffix.strip("_")
    tail, remarks = ("", []) if not asked else ("_" + asked, [])
    bases = [f"{name}_{stage}" for name, stage, *_ in names] + ["note"]
    if not asked and any(base in there for base in bases):
        tail = "_predicted"
        clash = [base for base in bases if base in there]
        remarks = [f"the table has {', '.join(clash)} already: the added columns are named ..._predicted"]
    again = [base + tail for base in bases if base + tail in there]
    if again:
        raise CaromError(
            f"columns: the table has {', '.join(map(repr, again))} already, and the added columns have these names; choose others"
            " with `suffix`"
        )
    added = [
        OutputColumn(header_with_unit(f"{name}_{stage}{tail}", unit, how), unit) for name, stage, unit, how in names
    ]
    return added, f"note{tail}", remarks


def _reading(form: str, air: bool, sources: dict[str, InputColumn]) -> str:
    where = {"vector": "vectors", "bounce": "a ball on a table", "angle": "a ball on a table"}[form]
    read = ", ".join(source.header for source in sources.values())
    return f"read as {'a ball in flight, in the plane' if air else where}: {read}"


def _assumed(constants: dict[str, float], settings: PredictSettings, air: bool) -> list[str]:
    units = {"radius": " m", "mass": " kg", "height": " m"}
    skip = ("floor", "height") if air else ()
    lasts = {"tangential_restitution": "tangential", "stiffness_ratio": "stiffness"}
    skip = (*skip, *unread(settings.law), *(word for last, word in lasts.items() if last != settings.law.last))
    taken = [
        f"{name} {value:g}{units.get(name, '')}"
        for name, value in constants.items()
        if name in DEFAULTS and name not in settings.given and not name.startswith(skip)
    ]
    zero = [name for name, value in constants.items() if name in ("v_t_in", "velocity_z") and value == 0]
    return [
        f"neither in the table nor given, defaults used: {', '.join(taken)}" if taken else "",
        f"no {', '.join(zero)} in the table: taken as 0" if zero else "",
    ]


# ----------------------------------------------------------------------------------------------------
# Admissible ranges of the numbers of a table of incoming states, and of the options that stand in for its columns.


def _within(low: float, high: float) -> Callable[[Any], Any]:
    return lambda x: (x >= low) & (x <= high)


def _positive(x: Any) -> Any:
    return (x >= MIN_MAGNITUDE) & (x <= MAX_MAGNITUDE)


def _friction(x: Any) -> Any:
    return (x >= 0) & ((x <= MAX_MAGNITUDE) | (x == math.inf))


FINITE = (_within(-MAX_MAGNITUDE, MAX_MAGNITUDE), "a finite number")
# In SI; any other column may hold any finite number.
CHECKS: dict[str, tuple[Callable[[Any], Any], str]] = {
    "radius": (_positive, "a length above 0"),
    "mass": (_positive, "a mass above 0"),
    "kappa": (lambda x: (x > 0) & (x <= 2 / 3 * (1 + 1e-12)), "kappa = I/(m a^2) in (0, 2/3]"),
    "restitution": (_within(0, 1), "a number from 0 to 1"),
    "friction": (_friction, "a number >= 0, or inf"),
    "tangential_restitution": (_within(-1, 1), "a number from -1 to 1"),
    "floor_restitution": (_within(0, 1), "a number from 0 to 1"),
    "floor_friction": (_friction, "a number >= 0, or inf"),
    "floor_tangential_restitution": (_within(-1, 1), "a number from -1 to 1"),
    "height": (_within(0, MAX_MAGNITUDE), "a length >= 0"),
    "stiffness_ratio": (_positive, "a number above 0"),
    "speed": (_within(0, MAX_MAGNITUDE), "a speed >= 0"),
    "incidence": (_within(-math.pi / 2, math.pi / 2), "an angle from the normal, -90 to 90 degrees"),
}


def bad_numbers(
    numbers: dict[str, float], normal: tuple[float, float, float] | None, contact_height: float, gravity: float
) -> FaultList:
    """Return a fault for each argument whose number (SI) is out of range."""
    faults = FaultList()
    for name, value in numbers.items():
        holds, expected = CHECKS.get(name, FINITE)
        if not holds(np.asarray(value)):
            faults.add(f"`{'inertia' if name == 'kappa' else name}`", expected, f"{value!r}")
    if normal is not None and not 0 < math.sqrt(sum(x * x for x in normal)) < math.inf:
        faults.add("`normal`", "a vector from the wall to the ball, such as 1,0,0", f"{normal}")
    if not 0 < contact_height < 2:
        faults.add("`contact_height`", "a height in radii, above 0 and below 2", f"{contact_height!r}")
    if not 0 <= gravity < math.inf:
        faults.add("`gravity`", "a number >= 0 in m/s^2", f"{gravity!r}")
    return faults
