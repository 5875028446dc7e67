"""Sweeps over single impacts: a ball on a floor meets a wall, under one law or several."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Annotated, Any, Literal

import numpy as np
from numpy.typing import NDArray
from pydantic import BeforeValidator

from carom.bodies import Ball, State, Surface, kinetic_energy
from carom.core.geometry.circles import directions
from carom.errors import CaromError
from carom.laws.landing import angle_from
from carom.laws.law import Law, Meeting
from carom.laws.registry import find_law
from carom.public.defaults import GRAVITY, LIKE_SOLIDS
from carom.scene.ball import Inertia
from carom.scene.schema import Friction, Mass, Model, NotNegative, Number, Share, Size, Spin, Spring
from carom.scene.toml import stored_model
from carom.scene.wall import LawChoice
from carom.sweeps.axes import AXES, FAILURES, Axis, Outcome, blank, check_paths, plain_value, require_outcomes, unit_of

Array = NDArray[Any]
Columns = dict[str, Array]
REFUSED = FAILURES.index("refused")


class ImpactCase(Model):
    """A ball on a floor that comes to the wall x = 0: what :func:`carom.incoming` takes, and the law.

    Parameters
    ----------
    law : name of a law; default: "two-step"
    speed, angle : m/s; degrees from the wall's normal, 0 to below 90
    spin_z : rad/s; spin_x, spin_y : default: the spin of a rolling ball
    radius, mass, inertia : of the ball; default: a snooker ball, solid
    restitution, friction, tangential_restitution : of the wall; default: the paper's
    floor_restitution, floor_friction : of the floor; default: the paper's
    gravity : m/s^2; default: 9.80665
    contact_height : of the contact above the floor, in radii; default: 1, a vertical wall
    floor_contact : "with" or "after"
    stiffness_ratio : for laws with tangential compliance

    Examples
    --------
    >>> import numpy as np, carom
    >>> case = carom.sweeps.ImpactCase(restitution=0.85, friction=0.2)
    >>> space = carom.Space(case, {"law": ["mirror", "two-step"], "angle": [15.0, 45.0]})
    >>> carom.sweep(space, keep=["reflection_angle"]).run()["reflection_angle"].values.round(2)
    array([[17.5 , 49.64],
           [22.09, 57.99]])
    """

    law: LawChoice = "two-step"
    speed: Annotated[float, BeforeValidator(Number("a speed in m/s, > 0", "m/s", least=0, above=True))] = 1.0
    angle: Annotated[
        float,
        BeforeValidator(Number("degrees from the wall's normal, 0 to below 90", "degree", least=0, most=89.999999)),
    ] = 45.0
    spin_z: Spin = 0.0
    spin_x: Spin | None = None
    spin_y: Spin | None = None
    radius: Size = 0.02625
    mass: Mass = 0.1406
    inertia: Inertia = "solid"
    restitution: Share = 1.0
    friction: Friction = math.inf
    tangential_restitution: Spring = 0.0
    floor_restitution: Share = 0.0
    floor_friction: Friction = math.inf
    gravity: NotNegative = GRAVITY
    contact_height: Annotated[
        float, BeforeValidator(Number("radii above the floor, above 0 and below 2", least=1e-9, most=2 - 1e-9))
    ] = 1.0
    floor_contact: Literal["with", "after"] = "with"
    stiffness_ratio: NotNegative = LIKE_SOLIDS


_STATES = [
    Outcome(f"{when}.{part}", "f8", {"axis": AXES}, unit)
    for when in ("after_wall", "final")
    for part, unit in (("velocity", "m/s"), ("spin", "rad/s"))
]
_NUMBERS = [
    Outcome("reflection_angle", units="degree"),
    *map(Outcome, ("energy_ratio", "required_friction.wall", "required_friction.floor")),
]
OUTCOMES = {one.name: one for one in (*_STATES, *_NUMBERS)}


class Impacts:
    """A sweep's subject: impacts of a ball with a wall."""

    kind = "impact"

    def __init__(self, case: ImpactCase) -> None:
        self.case = case

    def describe(self) -> str:
        """Return a few words."""
        return "an impact"

    def to_data(self) -> dict[str, Any]:
        """Return the case as plain data."""
        return {"impact": stored_model("sweep", self.case)}

    def units(self, path: str) -> str:
        """Return the unit of a parameter."""
        return unit_of(path)

    def check(self, parameters: Mapping[str, Axis]) -> None:
        """Raise CaromError for paths that lead nowhere or overlap, and for values that no impact has."""
        check_paths(self.case, parameters)

    def outcomes(self, names: tuple[str, ...]) -> list[Outcome]:
        """Return the outcomes of some names. CaromError with the nearest name."""
        require_outcomes(names, list(OUTCOMES))
        return [OUTCOMES[name] for name in names]

    def evaluate(
        self, columns: Columns, outcomes: list[Outcome], first: int, seed: int, tick: Any = None
    ) -> tuple[Columns, Array]:
        """Return the outcomes of N points by name, and (N,) the codes of those without one."""
        count = len(next(iter(columns.values())))
        found = {outcome.name: blank(outcome, count) for outcome in outcomes}
        failed = np.full(count, REFUSED, np.int8)
        # (a law takes many balls at once, in one field of gravity)
        shared = {name: column for name, column in columns.items() if column.dtype.kind == "O" or name == "gravity"}
        labels = np.array(
            ["\0".join(map(str, parts)) for parts in zip(*(column.tolist() for column in shared.values()), strict=True)]
            or [""] * count
        )
        for label in dict.fromkeys(labels.tolist()):
            rows = np.flatnonzero(labels == label)
            case = self.case.model_copy(update={name: plain_value(column[rows[0]]) for name, column in shared.items()})
            given = {name: column[rows] for name, column in columns.items() if name not in shared}
            self._answer_accepted(case, given, rows, outcomes, found, failed)
        return found, failed

    def _answer_accepted(
        self, case: ImpactCase, given: Columns, rows: Array, outcomes: list[Outcome], found: Columns, failed: Array
    ) -> None:
        """Answer all points except impossible ones, such as a kappa above 2/3: the halves are asked until these are alone."""
        try:
            self._answer(case, given, rows, outcomes, found, failed)
        except CaromError:
            half = len(rows) // 2
            for part in (slice(half), slice(half, None)) if half else ():
                own = {name: column[part] for name, column in given.items()}
                self._answer_accepted(case, own, rows[part], outcomes, found, failed)

    def _answer(
        self, case: ImpactCase, given: Columns, rows: Array, outcomes: list[Outcome], found: Columns, failed: Array
    ) -> None:
        law = case.law if isinstance(case.law, Law) else find_law(case.law)
        good = np.ones(len(rows), bool)
        meeting = _meeting(case, given, len(rows))
        for holds, *_expected in law.conditions(meeting):
            good &= np.broadcast_to(holds, good.shape)
        if not good.all():
            rows, given = rows[good], {name: column[good] for name, column in given.items()}
            if not len(rows):
                return
            meeting = _meeting(case, given, len(rows))
        with np.errstate(all="ignore"):
            answer = law.answer(meeting)
            values = {
                "after_wall.velocity": answer.after_wall.velocity,
                "after_wall.spin": answer.after_wall.spin,
                "final.velocity": answer.final.velocity,
                "final.spin": answer.final.spin,
                "reflection_angle": np.degrees(angle_from(meeting.normal, answer.final)),
                "energy_ratio": kinetic_energy(meeting.ball, answer.final)
                / kinetic_energy(meeting.ball, meeting.state),
                "required_friction.wall": answer.required_wall,
                "required_friction.floor": answer.required_floor,
            }
        there = np.isfinite(answer.after_wall.velocity).all(axis=-1)
        for outcome in outcomes:
            column = np.broadcast_to(values[outcome.name], (len(rows), *outcome.shape))
            found[outcome.name][rows[there]] = column[there]
        failed[rows[there]] = 0

    def why(self, columns: Columns) -> str:
        """Return why the one point of ``columns`` has no outcome; empty if it has one."""
        from carom.laws.comparison import compare, incoming

        values = {path: plain_value(column[0]) for path, column in columns.items()}
        try:
            case = ImpactCase(**({name: getattr(self.case, name) for name in ImpactCase.model_fields} | values))
            numbers = {name: getattr(case, name) for name in ImpactCase.model_fields if name != "law"}
            numbers["angle_deg"] = numbers.pop("angle")
            verdict = compare(incoming(**numbers), [case.law]).verdicts[0]
        except CaromError as error:
            return str(error)
        return "" if verdict.after_wall is not None else "; ".join(verdict.why)


def _meeting(case: ImpactCase, given: Columns, count: int) -> Meeting:
    """Return N balls before the wall, as :func:`carom.incoming` makes one."""

    def get(name: str) -> Array:
        value = given.get(name, getattr(case, name))
        return np.broadcast_to(np.asarray(value, dtype=float), (count,))

    turned = directions(get("angle"))
    x, y = -get("speed") * turned[:, 0], get("speed") * turned[:, 1]
    radius = get("radius")
    # (27)
    rolling = {"spin_x": -y / radius, "spin_y": x / radius}
    w = [
        get(name) if name in given or getattr(case, name) is not None else rolling[name]
        for name in ("spin_x", "spin_y")
    ]
    nz = 1 - get("contact_height")
    normal = np.stack([np.sqrt(1 - nz * nz), np.zeros(count), nz], axis=1)
    inertia: Any = get("inertia") if "inertia" in given else case.inertia
    return Meeting(
        Ball(radius, get("mass"), inertia),
        State(np.stack([x, y, np.zeros(count)], axis=1), np.stack([*w, get("spin_z")], axis=1)),
        normal if (nz != 0).any() else np.array([1.0, 0.0, 0.0]),
        Surface(get("restitution"), get("friction"), get("tangential_restitution")),
        Surface(get("floor_restitution"), get("floor_friction")),
        float(case.gravity),
        0.0,
        case.floor_contact,
        get("stiffness_ratio"),
    )
