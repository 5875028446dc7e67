"""Compare the predictions of laws for one incoming ball, and say which laws are admissible and why others are not.

:func:`incoming` makes a :class:`~carom.laws.law.Meeting` from a speed, an angle and a spin; :func:`compare` evaluates every
law; :mod:`carom.laws.comparison` describes a prediction in sentences. All of it runs as plain Python, so nothing is compiled.
"""

from __future__ import annotations

import inspect
import math
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass
from typing import Any, TypeVar

import numpy as np
from numpy.typing import ArrayLike

from carom.bodies import Ball, State, Surface, kinetic_energy, slip
from carom.errors import MAX_MAGNITUDE, CaromError, FaultList, checked_number, require_type, suggestion
from carom.formatting import Listing, format_length, format_number, format_time, json_value
from carom.laws.arrays import require_approach
from carom.laws.landing import Flight, FloorContact, Settled, TwoStep, angle_from
from carom.laws.law import Answer, Law, Meeting, holds_everywhere
from carom.laws.registry import law_named, one_or_several
from carom.laws.registry import laws as all_laws
from carom.public.defaults import GRAVITY, LIKE_SOLIDS, MASS, RADIUS


def remarks_on(meeting: Meeting, answer: Answer, final: State | None) -> Iterator[str]:
    """Yield sentences on what happens to one ball; ``final`` is None if it never rolls."""
    steps = answer.steps
    if isinstance(steps, TwoStep):
        yield from _wall(meeting, steps)
    if steps is not None:
        yield from _floor(meeting, steps)
    if final is None:
        yield f"the ball never rolls again: {answer.why}"
    else:
        yield from _way(meeting, final)


def _wall(meeting: Meeting, steps: TwoStep) -> Iterator[str]:
    hit = steps.wall
    mu = float(meeting.wall.friction)
    if np.any(steps.floor_impulse != 0):
        end = _ENDS[str(hit.regime)]
        yield f"the wall presses the ball on the floor: both act at once, and the wall contact ends {end}"
    elif hit.regime == "slide":
        needed = format_number(float(hit.required_friction))
        yield f"the ball slides on the wall: its friction {format_number(mu)} is below the {needed} required for sticking"
    elif hit.regime == "graze":
        yield "the ball only grazes the wall, without an impulse"


_ENDS = {
    "stick": "sticking", "slide": "sliding", "graze": "by separation", "jam": "jammed", "stall": "unresolved",
}  # fmt: skip


def _floor(meeting: Meeting, steps: Settled) -> Iterator[str]:
    flight = steps.flight
    if math.isfinite(flight.duration) and flight.duration > 0:
        yield (
            f"the ball flies for {format_time(flight.duration)}, {format_length(flight.distance)} far and up to"
            f" {format_length(flight.height)} high"
            + (", and bounces" if float(steps.after_floor.velocity[2]) > 0 else "")
        )
        if steps.floor.regime == "slide" and steps.rolls:
            mu, needed = (
                format_number(float(meeting.floor.friction)),
                format_number(float(steps.floor.required_friction)),
            )
            yield f"it lands sliding: the floor's friction {mu} is below the {needed} required for sticking"
    elif flight.duration == 0 and steps.rolls:
        left = slip(meeting.ball, steps.after_floor)
        speed = float(np.abs(steps.after_floor.velocity).sum())
        if float(np.abs(left).max()) > 1e-9 * speed:
            yield "the ball stays on the floor and slides until it rolls"


def _way(meeting: Meeting, final: State) -> Iterator[str]:
    v0, v = meeting.state.velocity, final.velocity
    size = float(np.abs(v0).sum() + meeting.ball.radius * np.abs(meeting.state.spin).sum())
    if not float(np.abs(v[:2]).sum()) > 1e-12 * size:
        yield "the ball stops at the wall"
        return
    n = meeting.normal
    if float(n[0] * v[0] + n[1] * v[1]) < -1e-9 * size:
        yield "its spin turns the ball round: it rolls back to the wall and meets it again"
    along0, along = (float(n[0] * u[1] - n[1] * u[0]) for u in (v0, v))
    if along0 * along < 0 and abs(along) > 1e-12 * size:
        yield "the ball returns to the side of the normal from which it came"
    elif along0 == 0 and abs(along) > 1e-12 * size:
        yield f"the ball leaves to the {'left' if along > 0 else 'right'} of the wall's normal"


# ----------------------------------------------------------------------------------------------------
# Compare the predictions of laws for one incoming ball, and say which laws are admissible and why others are not.


Thing = TypeVar("Thing")


def incoming(
    speed: float = 1.0,
    angle_deg: float = 45.0,
    spin_z: float = 0.0,
    *,
    spin_x: float | None = None,
    spin_y: float | None = None,
    sliding: bool = False,
    vertical_speed: float = 0.0,
    height: float = 0.0,
    inertia: str | float = "solid",
    radius: float = RADIUS,
    mass: float = MASS,
    restitution: float = 1.0,
    friction: float = math.inf,
    tangential_restitution: float = 0.0,
    floor_restitution: float = 0.0,
    floor_friction: float = math.inf,
    gravity: float = GRAVITY,
    contact_height: float | None = None,
    floor_contact: FloorContact = "with",
    stiffness_ratio: float = LIKE_SOLIDS,
) -> Meeting:
    """Describe a ball that approaches the wall x = 0 by plain numbers; the paper's example by default.

    Parameters
    ----------
    speed : float
        Speed along the floor, m/s.
    angle_deg : float
        Angle of incidence, from the wall's normal, degrees, below 90: the ball moves along -x and +y.
    spin_z : float
        Spin about the vertical, rad/s.
    spin_x : float, optional
        Spin about x, in the fixed frame, rad/s. Default: that of a rolling ball (27), or 0 with ``sliding``.
    spin_y : float, optional
        Spin about y, rad/s. Default: the same.
    sliding : bool
        The ball slides: ``spin_x`` and ``spin_y`` are 0 by default.
    vertical_speed : float
        Upward speed at the wall, m/s.
    height : float
        Height of the ball above the floor when it meets the wall, m.
    inertia : str or float
        "solid", "hollow" or I/(m a^2).
    radius : float
        Radius, m.
    mass : float
        Mass, kg.
    restitution : float
        Coefficient of restitution, 0 to 1.
    friction : float
        Friction coefficient; inf: never slips.
    tangential_restitution : float
        Tangential restitution, -1 to 1: 0 stops the slip, 1 reverses it.
    floor_restitution : float
        Coefficient of restitution, 0 to 1.
    floor_friction : float
        Friction coefficient; inf: never slips.
    gravity : float
        Gravity, m/s^2.
    contact_height : float, optional
        Height of the contact above the floor, in ball radii; billiard cushions: 1.25 to 1.4. Default: 1, a vertical wall.
    floor_contact : "with" or "after"
        Whether a ball that the wall presses down meets the floor with the wall or after it (:func:`carom.two_step`).
    stiffness_ratio : float
        Tangential over normal stiffness, for laws with tangential compliance; 14/17: solids of the same material.

    Returns
    -------
    Meeting

    Raises
    ------
    CaromError
        One line per problem, all problems at once.

    Examples
    --------
    >>> import carom
    >>> meeting = carom.incoming(speed=2.0, angle_deg=30.0, restitution=0.85, friction=0.2)
    >>> meeting.state.velocity.round(4).tolist()
    [-1.7321, 1.0, 0.0]
    """
    faults = FaultList("incoming")
    ball = _gathered(faults, "Ball", lambda: Ball(radius, mass, inertia), Ball())
    wall = _gathered(faults, "wall", lambda: Surface(restitution, friction, tangential_restitution), Surface())
    floor = _gathered(faults, "floor", lambda: Surface(floor_restitution, floor_friction), Surface())
    v = checked_number(faults, "speed", speed, "a speed in m/s, > 0", lambda x: x > 0)
    what = "degrees from the wall's normal, at least 0 and below 90"
    tau = checked_number(faults, "angle_deg", angle_deg, what, lambda x: (x >= 0) & (x < 90))
    spins = {"spin_x": spin_x, "spin_y": spin_y, "spin_z": spin_z}
    given = {
        key: checked_number(faults, key, w, "a finite spin in rad/s", lambda x: abs(x) <= MAX_MAGNITUDE)
        for key, w in spins.items()
        if w is not None
    }
    vz = checked_number(
        faults, "vertical_speed", vertical_speed, "a finite speed in m/s, upwards", lambda x: abs(x) <= MAX_MAGNITUDE
    )
    g = checked_number(faults, "gravity", gravity, "a number >= 0 in m/s^2", lambda x: x >= 0)
    h = checked_number(faults, "height", height, "a length >= 0 in m", lambda x: x >= 0)
    k = checked_number(faults, "stiffness_ratio", stiffness_ratio, "a number > 0", lambda x: x > 0)
    if floor_contact not in ("with", "after"):
        faults.add("floor_contact", "'with' (wall and floor at once) or 'after' (first the wall)", repr(floor_contact))
    normal = np.array([1.0, 0.0, 0.0])
    if contact_height is not None:
        low, high = h / ball.radius, h / ball.radius + 2
        c = checked_number(
            faults, "contact_height", contact_height,
            f"radii above the floor, between the ball's bottom and its top: above {low:g} and below {high:g}",
            lambda x: (x > low) & (x < high),
        )  # fmt: skip
        nz = 1 + h / ball.radius - c
        normal = np.array([math.sqrt(1 - nz * nz) if abs(nz) < 1 else 1.0, 0.0, nz])
    faults.raise_if_any()
    x, y = -v * math.cos(math.radians(tau)), v * math.sin(math.radians(tau))
    # (27)
    spin = {"spin_x": 0.0, "spin_y": 0.0} if sliding else {"spin_x": -y / ball.radius, "spin_y": x / ball.radius}
    spin |= given
    state = State((x, y, vz), (spin["spin_x"], spin["spin_y"], spin["spin_z"]))
    return Meeting(ball, state, normal, wall, floor, g, h, floor_contact, k)


def _gathered(faults: FaultList, name: str, make: Callable[[], Thing], instead: Thing) -> Thing:
    """Return the result of ``make``; if it fails, append its problems, as faults of ``name``."""
    try:
        return make()
    except CaromError as error:
        faults += error.records_at(name)
        return instead


ROUNDING = 1e-12


def _degrees(x: float | None) -> str:
    return "–" if x is None else f"{x:.2f}°"


@dataclass(frozen=True, eq=False)
class Verdict:
    """One law's prediction for one ball, and why the law may not apply.

    Examples
    --------
    >>> import carom
    >>> verdict = carom.compare()["two-step"]
    >>> verdict.admissible, round(verdict.reflection_angle_deg, 2)
    (True, 51.52)
    """

    law: str
    """The law's name."""
    admissible: bool
    """Whether the law's conditions hold and there is no objection to its prediction."""
    why: tuple[str, ...]
    """Why the law is not admissible, in sentences; empty if it is."""
    remarks: tuple[str, ...]
    """Remarks on the motion of the ball that the numbers do not show directly, in sentences."""
    after_wall: State | None
    """None if the law makes no prediction."""
    final: State | None
    """None if the law makes no prediction, or the ball never rolls again."""
    angle_after_wall_deg: float | None
    """Angle of the velocity just after the wall from the wall's normal, along the floor, degrees; None if the ball is at rest."""
    reflection_angle_deg: float | None
    """The same angle for the final velocity, degrees."""
    energy_ratio: float | None
    """Final over incident kinetic energy."""
    energy_ratio_after_wall: float | None
    """Kinetic energy just after the wall over that before it."""
    required_wall: float | None
    """Friction of the wall that the prediction requires (two-step: to stick); inf if no friction suffices."""
    required_floor: float | None
    """Friction of the floor that the prediction requires, at the first landing."""
    answer: Answer | None
    """The law's full answer; None if there is no prediction."""

    @property
    def flight(self) -> Flight | None:
        """The flight after the wall; None where the law says nothing of it."""
        steps = None if self.answer is None else self.answer.steps
        return None if steps is None else steps.flight

    def as_dict(self) -> dict[str, Any]:
        """Return the verdict as JSON has it: NaN as None, infinity as the string "inf"."""
        steps = None if self.answer is None else self.answer.steps
        flight = json_value(self.flight, infinite=True)
        wall = steps.wall if isinstance(steps, TwoStep) else None
        return {
            "law": self.law,
            "after_wall": state_dict(self.after_wall),
            "final": state_dict(self.final),
            "angle_after_wall_deg": json_value(self.angle_after_wall_deg, infinite=True),
            "reflection_angle_deg": json_value(self.reflection_angle_deg, infinite=True),
            "energy_ratio_after_wall": json_value(self.energy_ratio_after_wall, infinite=True),
            "energy_ratio": json_value(self.energy_ratio, infinite=True),
            "required_friction": {
                "wall": json_value(self.required_wall, infinite=True),
                "floor": json_value(self.required_floor, infinite=True),
            },
            "regime": {"wall": wall and wall.regime, "floor": steps and steps.floor.regime},
            "flight": flight,
            "after_floor": None if steps is None else state_dict(steps.after_floor),
            "admissible": self.admissible,
            "why": list(self.why),
            "remarks": list(self.remarks),
        }


@dataclass(frozen=True, eq=False, repr=False)
class Comparison:
    """Predictions of several laws for one incoming ball; ``comparison["two-step"]`` is the verdict on one law.

    Examples
    --------
    >>> import carom
    >>> comparison = carom.compare(laws=["mirror", "two-step"])
    >>> [(verdict.law, round(verdict.reflection_angle_deg, 2)) for verdict in comparison.verdicts]
    [('mirror', 45.0), ('two-step', 51.52)]
    """

    meeting: Meeting
    """The incoming ball, the wall and the floor."""
    incident_angle_deg: float
    """Angle of incidence from the wall's normal, along the floor, degrees."""
    verdicts: tuple[Verdict, ...]
    """One per law."""

    def __repr__(self) -> str:
        """Return one line: the incidence, and the final angle under each law, with * where it is admissible."""
        parts = [
            f"{one.law} {format_number(one.reflection_angle_deg, 4)}{'*' * one.admissible}" for one in self.verdicts
        ]
        return f"<Comparison at {format_number(self.incident_angle_deg, 4)} degrees: {', '.join(parts)}>"

    def table(self, spin: bool = True, ticks: Sequence[str] = "✓✗") -> Listing:
        """Return a row per prediction, with the final spin or without it; laws that predict the same share a row.

        ``ticks``: words for admissible, and for not.
        """

        def vector(state: State | None, part: str, count: int) -> str:  # (rounding errors are zero)
            numbers = () if state is None else map(float, getattr(state, part)[:count])
            return ", ".join(format_number(0.0 if abs(x) < ROUNDING else x) for x in numbers) or "–"

        columns: dict[str, Callable[[Verdict], str]] = {
            "law": lambda one: one.law,
            "angle\nafter\nwall": lambda one: _degrees(one.angle_after_wall_deg),
            "final\nangle": lambda one: _degrees(one.reflection_angle_deg),
            "final\nvelocity\nx, y, m/s": lambda one: vector(one.final, "velocity", 2),
            "final spin\nx, y, z, rad/s": lambda one: vector(one.final, "spin", 3),
            "flight\nheight\nmm": lambda one: format_number(
                None if one.flight is None else 1e3 * float(one.flight.height)
            ),
            "flight\nlength\nmm": lambda one: format_number(
                None if one.flight is None else 1e3 * float(one.flight.distance)
            ),
            "energy\nkept": lambda one: "–" if one.energy_ratio is None else f"{one.energy_ratio:.1%}",
            "needed\nμ of\nwall": lambda one: format_number(one.required_wall),
            "needed\nμ of\nfloor": lambda one: format_number(one.required_floor),
            "ok": lambda one: ticks[not one.admissible],
        }
        used = {head: cell for head, cell in columns.items() if spin or "spin" not in head}
        rows: dict[tuple[str, ...], list[list[str]]] = {}
        for one in self.verdicts:
            cells = [cell(one) for cell in used.values()]
            same = [cell for cell, head in zip(cells, used, strict=True) if head != "law" and "needed" not in head]
            rows.setdefault((*same, one.law * (one.after_wall is None)), []).append(cells)
        return Listing(
            list(used),
            [[", ".join(dict.fromkeys(cells)) for cells in zip(*laws, strict=True)] for laws in rows.values()],
        )

    def _repr_html_(self) -> str:
        return self.table()._repr_html_()

    def __getitem__(self, law: str) -> Verdict:
        """Return the verdict on a law by its name; KeyError if the law was not compared."""
        for verdict in self.verdicts:
            if verdict.law == law:
                return verdict
        raise KeyError(law)

    def as_dict(self) -> dict[str, Any]:
        """Return the comparison as JSON has it: full precision, None if undefined, "inf" for infinity."""
        m = self.meeting
        return {
            "incident": {**(state_dict(m.state) or {}), "angle_deg": self.incident_angle_deg},
            "laws": [verdict.as_dict() for verdict in self.verdicts],
            "settings": {
                "ball": {"radius": m.ball.radius, "mass": m.ball.mass, "kappa": m.ball.kappa},
                "wall": {**json_value(m.wall, infinite=True), "normal": m.normal.tolist()},
                "floor": json_value(m.floor, infinite=True),
                "gravity": m.gravity,
                "height": m.height,
                "floor_contact": m.floor_contact,
                "stiffness_ratio": json_value(m.stiffness_ratio, infinite=True),
            },
        }


def compare(
    meeting: Meeting | None = None, laws: str | Law | Iterable[str | Law] | None = None, **numbers: Any
) -> Comparison:
    """Compare the predictions of several laws for one ball, and find which laws are admissible.

    Parameters
    ----------
    meeting : Meeting
        One ball, one wall. Default: made from ``numbers``, the arguments of :func:`incoming`, such as ``angle_deg=30``;
        without any, the paper's example.
    laws : a name or a Law, or several
        Default: the laws of ``carom.LAWS``, in their order, without special cases of others (:attr:`Law.variant_of`); laws
        that ignore the floor (contact) are included only for a ball above it, and published laws of cushions only for a
        ball on the floor and a wall that touches it above the centre.

    Returns
    -------
    Comparison
        A law whose conditions do not hold for this ball is listed too, without numbers and with the reason.

    Raises
    ------
    CaromError
        For an unknown law (with the nearest name), for a ball that moves away from the wall, and for more than one ball.

    Examples
    --------
    >>> import carom
    >>> comparison = carom.compare(carom.incoming(speed=2.0, angle_deg=30.0, restitution=0.85, friction=0.2))
    >>> round(comparison["two-step"].reflection_angle_deg, 2), comparison["mirror"].admissible
    (41.17, False)
    """
    known = list(inspect.signature(incoming).parameters)
    if strange := [name for name in numbers if name not in known]:
        faults = [
            f"compare: expected laws, meeting or an argument of carom.incoming, got {name!r}; {suggestion(name, [*known, 'laws'])}"
            for name in strange
        ]
        raise CaromError(*faults)
    if meeting is not None and numbers:
        raise CaromError(f"compare: expected a meeting or numbers, got both ({', '.join(numbers)}); give one of them")
    m = incoming(**numbers) if meeting is None else meeting
    require_type("compare", "meeting", m, Meeting)
    parts = [m.ball.radius, m.ball.mass, m.ball.kappa, m.height, *vars(m.wall).values(), *vars(m.floor).values()]
    if m.state.shape or m.normal.ndim != 1 or any(np.ndim(x) for x in parts):
        raise CaromError("compare: expected one ball and one wall, got arrays; functions such as two_step take arrays")
    require_approach(m.ball, m.state, m.normal)
    if laws is None:
        aloft = m.height > 0 or m.ball.planar
        cushion = not aloft and m.normal[2] < 0
        laws = [
            law
            for law in all_laws().values()
            if not law.variant_of and (aloft or not law.ignores_floor) and (cushion or not law.on_table)
        ]
    asked = [law if isinstance(law, Law) else law_named(law) for law in one_or_several("compare", laws)]
    angle = math.degrees(angle_from(m.normal, m.state, incoming=True))
    once = {law.name: law for law in asked}  # a law named twice is evaluated once
    return Comparison(m, angle, tuple(_verdict(law, m) for law in once.values()))


def _verdict(law: Law, meeting: Meeting) -> Verdict:
    missing = [expected for holds, expected, *_field in law.conditions(meeting) if not holds_everywhere(holds)]
    if missing:
        return _refusal(law, f"no prediction: it requires {'; and '.join(missing)}")
    try:
        answer = law.answer(meeting)
    except CaromError as error:
        return _refusal(law, *(f"no prediction: {fault}" for fault in error.faults))
    m = meeting
    if np.isnan(answer.after_wall.velocity).any():
        return _refusal(law, f"no prediction: {answer.why}")
    why = tuple(law.objections(m, answer))
    final = None if np.isnan(answer.final.velocity).any() else answer.final
    energy = float(kinetic_energy(m.ball, m.state))
    ratio = float(kinetic_energy(m.ball, answer.after_wall)) / energy if energy > 0 else None
    verdict = Verdict(
        law=law.name,
        admissible=not why,
        why=why,
        remarks=(),
        after_wall=answer.after_wall,
        final=final,
        angle_after_wall_deg=_angle(m, answer.after_wall),
        reflection_angle_deg=None if final is None else _angle(m, final),
        energy_ratio=float(kinetic_energy(m.ball, final)) / energy if final is not None and energy > 0 else None,
        energy_ratio_after_wall=ratio,
        required_wall=_known(answer.required_wall),
        required_floor=_known(answer.required_floor),
        answer=answer,
    )
    return Verdict(**{**vars(verdict), "remarks": tuple(remarks_on(m, answer, final))})


def _refusal(law: Law, *why: str) -> Verdict:
    return Verdict(law.name, False, why, (), None, None, None, None, None, None, None, None, None)


def _angle(meeting: Meeting, state: State) -> float | None:
    """Return the angle in degrees; None if the velocity along the floor is zero up to rounding."""
    size = float(np.abs(meeting.state.velocity).sum() + meeting.ball.radius * np.abs(meeting.state.spin).sum())
    if not float(np.abs(state.velocity[:2]).sum()) > 1e-12 * size:
        return None
    return math.degrees(angle_from(meeting.normal, state))


def _known(x: ArrayLike) -> float | None:
    value = float(np.asarray(x))
    return None if math.isnan(value) else value


def state_dict(state: State | None) -> dict[str, Any] | None:
    """Return velocity and spin as lists; None if there is no state, or it is NaN."""
    if state is None or np.isnan(state.velocity).any():
        return None
    return {"velocity": state.velocity.tolist(), "spin": state.spin.tolist()}
