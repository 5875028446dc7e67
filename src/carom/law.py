"""Laws as `carom compare` and `carom predict` see them: one question, one answer, and what speaks against it.

A law of your own is one file: a kernel ``(v, w, n, a, kappa, e, mu, beta) -> (v, w)``, a :class:`~carom.laws.card.Card`
and ``law = wall_law(CARD, kernel)``.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from carom.ball import Ball
from carom.checks import expect, meant
from carom.errors import CaromError
from carom.kernel import Vec
from carom.laws.card import Card
from carom.laws.contact import CARD as CONTACT
from carom.laws.contact import slip_velocity, wall_contact
from carom.laws.conventional import CARD as CONVENTIONAL
from carom.laws.conventional import conventional_reflection
from carom.laws.maw import CARD as MAW
from carom.laws.maw import CHI, LIKE_SOLIDS, maw_contact, maw_kernel
from carom.laws.mirror import CARD as MIRROR
from carom.laws.mirror import mirror_reflection
from carom.laws.no_slip import CARD as NO_SLIP
from carom.laws.no_slip import no_slip_reflection
from carom.laws.simultaneous import LEAST_FIRM
from carom.laws.stronge import CARD as STRONGE
from carom.laws.stronge import STIFFNESS, stronge_contact, stronge_kernel
from carom.laws.two_step import CARD as TWO_STEP
from carom.loops import law_rows
from carom.rows import approaching, rows_of
from carom.state import State, kinetic_energy, slip
from carom.surface import Surface
from carom.verbs import FLOOR, GRAVITY, WALL, FloorContact, Settled, answer_rows, settle, two_step

__all__ = ["LAWS", "SURFACES", "Answer", "Law", "Meeting", "law_named", "wall_law"]

Array = NDArray[np.float64]
WallKernel = Callable[[Vec, Vec, Vec, float, float, float, float, float], tuple[Vec, Vec]]
Condition = tuple[NDArray[np.bool_], str]
ON_WALL = ("restitution", "friction", "tangential_restitution")
ON_FLOOR = ("floor_restitution", "floor_friction", "floor_tangential_restitution")
SURFACES = (*ON_WALL, "stiffness_ratio", *ON_FLOOR)
"""Numbers of wall and floor that a law may read."""


@dataclass(frozen=True, eq=False)
class Meeting:
    """A ball and what it meets. Shapes (...) as the states'; ``normal`` of unit length."""

    ball: Ball
    state: State
    normal: Array = field(default_factory=lambda: np.array([1.0, 0.0, 0.0]))
    wall: Surface = WALL
    floor: Surface = FLOOR
    gravity: float = GRAVITY
    height: Any = 0.0
    floor_contact: FloorContact = "with"
    stiffness_ratio: Any = LIKE_SOLIDS
    """Of the wall's contact, along the surface over normally; the compliant laws read it. Like solids of nu = 0.3: 14/17."""


@dataclass(frozen=True, eq=False)
class Answer:
    """What a law says. ``final`` is the state when all is over: rolling again, or what the law leaves."""

    after_wall: State
    final: State
    required_wall: Any
    """(...): the friction that the wall must have for what the law says; NaN where none can give it."""
    required_floor: Any
    why: Any
    """(...): why there is no final state; empty strings where there is one."""
    steps: Settled | None = None
    """Flight, landing and the rest, where the law has them."""


@dataclass(frozen=True)
class Law:
    """A law by name: its card, the conditions under which it may be asked, its answer, and what speaks against it."""

    card: Card
    answer: Callable[[Meeting], Answer]
    """For states that meet the conditions."""
    conditions: Callable[[Meeting], list[Condition]]
    """Masks (...) that must hold, each with what is expected; states that fail one get no answer."""
    objections: Callable[[Meeting, Answer], list[str]]
    """For one state: plain sentences on what is not admissible and why; none where the law can be true."""
    kernel: WallKernel | None = None
    """What the wall alone does, for engines; of a law that is ``compliant``, with the stiffness ratio of like solids."""
    in_flight: bool = False
    """It is about one contact: in a table without spins the ball is taken to fly."""
    compliant: WallKernel | None = None
    """What a wall alone does that gives along its surface: it reads the stiffness ratio in the place of beta."""
    reads: tuple[str, ...] | None = None
    """Those numbers of wall and floor (:data:`SURFACES`) that it reads; None: nobody said, and it may read them all."""

    @property
    def name(self) -> str:
        """The card's name."""
        return self.card.name


def _speed(state: State, normal: Array) -> Any:
    return (state.velocity * normal).sum(axis=-1)


def approaches(meeting: Meeting) -> list[Condition]:
    """The condition of every law: the ball does not move away from the wall."""
    return [(approaching(meeting.state, meeting.normal), "a ball that moves towards the wall")]


def respond(kernel: WallKernel, meeting: Meeting, last: Any = None) -> State:
    """The state after a wall whose law is a kernel; ``last`` stands in the place of the tangential restitution."""
    m = meeting
    rows = rows_of(
        m.state, m.normal, m.ball.radius, m.ball.kappa,
        m.wall.restitution, m.wall.friction, m.wall.tangential_restitution if last is None else last,
    )  # fmt: skip
    return State.of(*answer_rows(kernel, law_rows(kernel), rows, "vv"))


def _required(ball: Ball, before: State, after: State, normal: Array) -> Any:
    """The friction, tangential over normal impulse, that a wall needs to turn one state into the other by itself."""
    j = (after.velocity - before.velocity) * np.asarray(ball.mass)[..., None]
    jn = (j * normal).sum(axis=-1)
    f = j - jn[..., None] * normal
    with np.errstate(invalid="ignore", divide="ignore"):
        return np.where(jn > 0, np.sqrt((f * f).sum(axis=-1)) / jn, 0.0)


def _and_the_floor(meeting: Meeting, after: State) -> Answer:
    m = meeting
    required = _required(m.ball, m.state, after, m.normal)
    if m.ball.planar:
        return Answer(after, after, required, np.zeros(after.shape), np.full(after.shape, ""))
    then = settle(m.ball, after, m.floor, m.normal, m.gravity, m.height)
    return Answer(after, then.rolling, required, then.floor.required_friction, then.why, then)


def wall_law(
    card: Card,
    kernel: WallKernel,
    conditions: Callable[[Meeting], list[Condition]] = approaches,
    objections: Callable[[Meeting, Answer], list[str]] | None = None,
    reads: tuple[str, ...] | None = None,
) -> Law:
    """A law from what the wall does; the floor then does what it does to any ball: flight, landing, sliding, rolling.

    A disc in the plane has no floor: what leaves the wall is final.
    """

    def answer(meeting: Meeting) -> Answer:
        return _and_the_floor(meeting, respond(kernel, meeting))

    def against(meeting: Meeting, answer: Answer) -> list[str]:
        return [*impossible(meeting, answer), *(objections(meeting, answer) if objections else [])]

    return Law(card, answer, conditions, against, kernel, reads=reads)


# --- the built-in laws: what the wall does, under which conditions, and what speaks against it ----------------------


def _rubs(surface: Surface) -> bool:
    return bool(np.any((np.asarray(surface.friction) > 0) & (np.asarray(surface.tangential_restitution) > -1)))


def _slips(meeting: Meeting, state: State, normal: Any) -> Any:
    """Mask (...): where a contact point slips by more than rounding."""
    a = meeting.ball.radius
    if state.velocity.ndim == 1 and normal.ndim == 1 and type(a) is float:  # one state, without arrays
        v, w, n = (tuple(x.tolist()) for x in (state.velocity, state.spin, normal))
        _un, ut = slip_velocity(v, w, n, a)
        return np.asarray(max(map(abs, ut)) > 1e-9 * (sum(map(abs, v)) + a * sum(map(abs, w))))
    u = slip(meeting.ball, state, normal)
    size = np.abs(state.velocity).sum(axis=-1) + a * np.abs(state.spin).sum(axis=-1)
    return np.abs(u).max(axis=-1) > 1e-9 * size


UP = np.array([0.0, 0.0, 1.0])


def _into_floor(meeting: Meeting, answer: Answer) -> list[str]:
    down = answer.after_wall.velocity[..., 2] < -1e-9 * np.abs(meeting.state.velocity).sum(axis=-1)
    if meeting.ball.planar or not np.any(down & (np.asarray(meeting.height) == 0)):
        return []
    return ["it drives the ball into the floor, and leaves out that the floor pushes back at once"]


def impossible(meeting: Meeting, answer: Answer) -> list[str]:
    """What no law can do: gain energy, or send the ball through the wall."""
    found = []
    before, after = kinetic_energy(meeting.ball, meeting.state), kinetic_energy(meeting.ball, answer.after_wall)
    if np.any(after > before * (1 + 1e-9)):
        found.append(f"it creates energy: {100 * float(np.max(after / before)):.4g} % is left after the wall")
    speed = np.abs(meeting.state.velocity).sum(axis=-1)
    if np.any(_speed(answer.after_wall, meeting.normal) < -1e-9 * speed):
        found.append("it sends the ball through the wall")
    return found


def _not_elastic(meeting: Meeting) -> list[str]:
    e = np.asarray(meeting.wall.restitution)
    return [f"it takes the restitution for 1, this wall's is {float(e.flat[0]):g}"] if np.any(e != 1) else []


def _mirror_kernel(v: Vec, w: Vec, n: Vec, a: float, kappa: float, e: float, mu: float, beta: float) -> tuple[Vec, Vec]:
    v1, w1, _j = mirror_reflection(v, w, n, a, e)
    return v1, w1


def _mirror_answer(meeting: Meeting) -> Answer:
    after = respond(_mirror_kernel, meeting)
    nothing = np.zeros(after.shape)
    return Answer(after, after, nothing, nothing, np.full(after.shape, ""))


def _mirror_objections(meeting: Meeting, answer: Answer) -> list[str]:
    found = _into_floor(meeting, answer)
    if _rubs(meeting.wall) and np.any(_slips(meeting, meeting.state, meeting.normal)):
        found.append("the ball slips on the wall, and this wall has friction: an impulse along it is left out")
    if not meeting.ball.planar and _rubs(meeting.floor) and np.any(_slips(meeting, answer.after_wall, UP)):
        found.append("the ball leaves the wall sliding, and this floor has friction: its path will bend")
    return found


def _conventional_kernel(
    v: Vec, w: Vec, n: Vec, a: float, kappa: float, e: float, mu: float, beta: float
) -> tuple[Vec, Vec]:
    return conventional_reflection(v, w, n, a, kappa)


def conventional_conditions(meeting: Meeting) -> list[Condition]:
    """The hypotheses: the ball rolls on the floor, the wall is vertical and returns all of the normal velocity."""
    grounded = np.asarray((meeting.state.velocity[..., 2] == 0) & (np.asarray(meeting.height) == 0))
    rolls = ~_slips(meeting, meeting.state, UP)
    return [
        *approaches(meeting),
        (grounded & rolls, "hypothesis 1: a ball that rolls on the floor without sliding"),
        (
            np.asarray(np.abs(meeting.normal[..., 2]) < 1e-12),
            "hypothesis 1: a vertical wall (no other leaves it on the floor)",
        ),
        (
            np.asarray(np.asarray(meeting.wall.restitution) == 1),
            "hypothesis 3: a wall of restitution 1 (with less, the energy would have to come from nowhere)",
        ),
        (np.asarray(not meeting.ball.planar), "a ball on a floor, not a disc in the plane"),
    ]


def _conventional_answer(meeting: Meeting) -> Answer:
    after = respond(_conventional_kernel, meeting)
    none = np.full(after.shape, "")
    slips = _slips(meeting, meeting.state, meeting.normal)
    # Wall and floor share one unknown: S_z, by which the floor pushes up and the wall pulls down. With more of it the
    # friction that the floor needs falls towards 1 and stays above it: none at or below 1 will do. The wall's tends to 1 then.
    needed = np.where(slips, 1.0, 0.0)
    return Answer(after, after, needed, needed, none)


def _conventional_objections(meeting: Meeting, answer: Answer) -> list[str]:
    found = []
    if np.any(answer.required_floor > 0):
        found.append(
            "it reverses the slip at the wall, which friction can only stop: the wall would have to pull the ball down"
            " and the floor hold it with a friction above 1, at whatever impulses"
        )
    return found


def _no_slip_kernel(
    v: Vec, w: Vec, n: Vec, a: float, kappa: float, e: float, mu: float, beta: float
) -> tuple[Vec, Vec]:
    v1, w1, _j, _required = no_slip_reflection(v, w, n, a, kappa)
    return v1, w1


def _no_slip_objections(meeting: Meeting, answer: Answer) -> list[str]:
    found = _not_elastic(meeting)
    if np.any(_slips(meeting, meeting.state, meeting.normal)):
        beta, mu = float(np.min(meeting.wall.tangential_restitution)), float(np.min(meeting.wall.friction))
        if beta < 1:
            found.append(
                f"it returns all of the slip at the wall; this wall's tangential restitution is {beta:g}, not 1"
            )
        required = float(np.max(answer.required_wall))
        if required > mu:
            found.append(f"it needs a wall friction of {required:.3g}; this wall has {mu:g}")
    return [*found, *_into_floor(meeting, answer)]


def contact_kernel(v: Vec, w: Vec, n: Vec, a: float, kappa: float, e: float, mu: float, beta: float) -> tuple[Vec, Vec]:
    """The wall's part of the two-step law: one contact."""
    v1, w1, _j, _required, _regime = wall_contact(v, w, n, a, kappa, e, mu, beta)
    return v1, w1


def _contact_answer(meeting: Meeting) -> Answer:
    m = meeting
    after = respond(contact_kernel, m)
    needed = _required(m.ball, m.state, after, m.normal)
    return Answer(after, after, needed, np.zeros(after.shape), np.full(after.shape, ""))


def _contact_objections(meeting: Meeting, answer: Answer) -> list[str]:
    m = meeting
    grounded = np.any((np.asarray(m.height) == 0) & (m.state.velocity[..., 2] == 0))
    moved = np.any(answer.after_wall.velocity[..., 2] != 0) or np.any(_slips(m, answer.after_wall, UP))
    return ["it leaves out the floor, which this ball lies on"] if grounded and moved and not m.ball.planar else []


def _two_step_answer(meeting: Meeting) -> Answer:
    m = meeting
    if m.ball.planar:  # no floor: one contact, and that is all
        after = respond(contact_kernel, m)
        nothing = np.zeros(after.shape)
        return Answer(after, after, _required(m.ball, m.state, after, m.normal), nothing, np.full(after.shape, ""))
    two = two_step(m.ball, m.state, m.wall, m.floor, m.normal, m.gravity, m.height, m.floor_contact)
    # What the floor needs: to hold the landing, or what it gave while the wall pressed the ball on it.
    jf = two.floor_impulse
    with np.errstate(invalid="ignore", divide="ignore"):
        used = np.where(jf[..., 2] > 0, np.hypot(jf[..., 0], jf[..., 1]) / jf[..., 2], 0.0)
    used = np.where(used >= LEAST_FIRM / 2, np.inf, used)  # an infinite friction that had to be one
    needed = np.fmax(two.floor.required_friction, used)
    return Answer(two.after_wall, two.rolling, two.wall.required_friction, needed, two.why, two)


def two_step_conditions(meeting: Meeting) -> list[Condition]:
    """The ball approaches; and no wall with tangential restitution presses it on the floor."""
    m = meeting
    found = approaches(m)
    beta = np.asarray(m.wall.tangential_restitution)
    if not m.ball.planar and m.floor_contact == "with" and np.any((beta != 0) & (beta != -1)):
        u = slip(m.ball, m.state, m.normal)
        size = np.sqrt((u * u).sum(axis=-1))
        mu = np.minimum(m.wall.friction, 1e300)
        down = (m.normal[..., 2] < 0) | ((u[..., 2] > 0) & (mu * u[..., 2] > m.normal[..., 2] * size))
        on_floor = (np.asarray(m.height) == 0) & (m.state.velocity[..., 2] <= 0)
        pressed = on_floor & (down | (m.state.velocity[..., 2] < 0)) & (beta != 0) & (beta != -1)
        found.append((~np.asarray(pressed), "tangential restitution 0 where the wall presses the ball on the floor"))
    return found


def _compliant_law(
    card: Card, kernel: WallKernel, for_engines: WallKernel, known: Callable[[Meeting], Condition]
) -> Law:
    """A wall that gives along its surface too: the meeting's stiffness ratio in the place of tangential restitution."""

    def answer(meeting: Meeting) -> Answer:
        return _and_the_floor(meeting, respond(kernel, meeting, meeting.stiffness_ratio))

    def conditions(meeting: Meeting) -> list[Condition]:
        return [*approaches(meeting), known(meeting)]

    def objections(meeting: Meeting, answer: Answer) -> list[str]:
        found = [*impossible(meeting, answer), *_into_floor(meeting, answer)]
        beta = float(np.max(np.abs(meeting.wall.tangential_restitution)))
        if beta > 0:
            found.append("it has springs in the place of this wall's tangential restitution, which it does not read")
        return found

    reads = ("restitution", "friction", "stiffness_ratio", *ON_FLOOR)
    return Law(card, answer, conditions, objections, for_engines, in_flight=True, compliant=kernel, reads=reads)


def _maw_knows(meeting: Meeting) -> Condition:
    share = (1 + 1 / np.asarray(meeting.ball.kappa)) / 2
    chi = np.asarray(meeting.stiffness_ratio) * share
    low, high = CHI[0] / np.min(share), CHI[1] / np.max(share)
    return (chi >= CHI[0]) & (
        chi <= CHI[1]
    ), f"a stiffness ratio from {low:.3g} to {high:.3g}, where its curve is known"


def _stronge_knows(meeting: Meeting) -> Condition:
    k = np.asarray(meeting.stiffness_ratio)
    return (k >= STIFFNESS[0]) & (k <= STIFFNESS[1]), f"a stiffness ratio from {STIFFNESS[0]:g} to {STIFFNESS[1]:g}"


LAWS: dict[str, Law] = {
    law.name: law
    for law in (
        Law(MIRROR, _mirror_answer, approaches, _mirror_objections, _mirror_kernel, reads=("restitution",)),
        Law(
            CONVENTIONAL,
            _conventional_answer,
            conventional_conditions,
            _conventional_objections,
            _conventional_kernel,
            reads=("restitution",),  # which must be 1
        ),
        wall_law(NO_SLIP, _no_slip_kernel, objections=_no_slip_objections, reads=ON_FLOOR),
        Law(
            TWO_STEP,
            _two_step_answer,
            two_step_conditions,
            lambda _meeting, _answer: [],
            contact_kernel,
            reads=(*ON_WALL, *ON_FLOOR),
        ),
        _compliant_law(MAW, maw_contact, maw_kernel, _maw_knows),
        _compliant_law(STRONGE, stronge_contact, stronge_kernel, _stronge_knows),
        Law(CONTACT, _contact_answer, approaches, _contact_objections, contact_kernel, in_flight=True, reads=ON_WALL),
    )
}


def law_named(name: str) -> Law:
    """A law by its name; CaromError with the nearest name where there is none."""
    expect("law_named", "name", name, str)
    if name not in LAWS:
        raise CaromError(f"law: expected one of {', '.join(LAWS)}, got {name!r}{meant(name, list(LAWS))}")
    return LAWS[name]
