"""What a law of impact is: its card, its kernel, its answer, and what scenes, billiards and fits need to know of it.

A law is one file of this package that ends with ``LAW = Law(...)`` (or ``wall_law(CARD, kernel)``, where the kernel of the wall
says it all). Everything else reads the descriptor: no other module names a law.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import Any, Literal, NamedTuple

import numpy as np
from numpy.typing import NDArray

from carom.bodies import Ball, State, Surface, kinetic_energy, slip
from carom.core.contact import slip_velocity, wall_contact
from carom.core.jit.kernel import Vec, kernel
from carom.laws.arrays import WallKernel, answer_rows, approaching, rows_of, wall_law_rows
from carom.laws.landing import settle
from carom.laws.results import GRAVITY, PAPER_FLOOR, PAPER_WALL, FloorContact, Settled

__all__ = [
    "CALLED_WALL", "CONTACT_WALL", "LIKE_SOLIDS", "MIRROR_WALL", "NO_SLIP_WALL", "ON_FLOOR", "ON_WALL", "ROLLING_WALL",
    "SURFACES", "TWO_STEP_WALL", "Answer", "Card", "Condition", "FitSpec", "Law", "Meeting", "approaches", "contact_kernel",
    "drives_into_floor", "impossible", "required_friction", "respond", "rubs", "slips", "slips_on_floor", "wall_law",
    "wall_then_floor",
]  # fmt: skip

Array = NDArray[np.float64]
ON_WALL = ("restitution", "friction", "tangential_restitution")
ON_FLOOR = ("floor_restitution", "floor_friction", "floor_tangential_restitution")
SURFACES = (*ON_WALL, "stiffness_ratio", *ON_FLOOR)
"""Numbers of wall and floor that a law may read."""
LIKE_SOLIDS = 14 / 17
"""Tangential over normal stiffness of the contact of like solids, 2 (1 - nu)/(2 - nu), at nu = 0.3."""

# How compiled loops (the event engine, billiards, fits) carry out a law. TWO_STEP_WALL: one contact, or wall and floor at once
# where the wall presses the ball on the floor; CONTACT_WALL: one contact, whatever the ball lies on; ROLLING_WALL: the
# conventional reflection of a rolling ball; NO_SLIP_WALL, MIRROR_WALL: one contact with e = 1, beta = 1, and with mu = 0;
# CALLED_WALL: the law's kernel, called by its address.
TWO_STEP_WALL, ROLLING_WALL, NO_SLIP_WALL, MIRROR_WALL, CONTACT_WALL, CALLED_WALL = range(6)


@dataclass(frozen=True)
class Card:
    """What a law says of itself: `carom laws`, the documentation and citations are made from it.

    >>> import carom
    >>> carom.CARDS["no-slip"].doi
    '10.1016/0167-2789(93)90205-F'
    """

    name: str
    summary: str
    """One sentence."""
    assumptions: tuple[str, ...]
    valid: str
    """When to use it, and when not."""
    equations: str
    """Where in its source, e.g. "paper (27)-(39)"."""
    citation: str
    doi: str = ""


@dataclass(frozen=True, eq=False)
class Meeting:
    """A ball and what it meets. Shapes (...) as the states'; ``normal`` of unit length, from the wall to the ball."""

    ball: Ball
    state: State
    normal: Array = field(default_factory=lambda: np.array([1.0, 0.0, 0.0]))
    wall: Surface = PAPER_WALL
    floor: Surface = PAPER_FLOOR
    gravity: float = GRAVITY
    """m/s^2."""
    height: Any = 0.0
    """(...), m: of the centre above its place on the floor."""
    floor_contact: FloorContact = "with"
    stiffness_ratio: Any = LIKE_SOLIDS
    """(...): of the wall's contact, tangential over normal; read by the laws of tangential compliance."""


@dataclass(frozen=True, eq=False)
class Answer:
    """What a law predicts. Shapes (...) as the states'."""

    after_wall: State
    final: State
    """The state when all is over: rolling again, or what the law leaves; NaN where there is none."""
    required_wall: Any
    """(...): the friction that the wall must have for what the law says; NaN where none can give it."""
    required_floor: Any
    why: Any
    """(...): why there is no final state; empty strings where there is one."""
    steps: Settled | None = None
    """Flight, landing and the rest, where the law has them."""


class Condition(NamedTuple):
    """A hypothesis of a law."""

    holds: Any
    """Mask (...)."""
    expected: str
    """What is expected, as a phrase."""
    field: str = ""
    """The number of the wall that it is about, where a scene can be checked for it before any ball moves: "restitution"..."""


@dataclass(frozen=True)
class FitSpec:
    """How a law is fitted to one kind of rebound."""

    kind: Literal["planar", "table"]
    """A bounce in the plane (ball in the air, disc), or a ball on a table."""
    phrase: str = ""
    """What a report calls it; left out: the card's name."""
    free: tuple[str, ...] | None = None
    """Numbers of the wall that are fitted; left out: those of the wall that the law reads and does not hold fixed."""
    pinned: Mapping[str, float] = field(default_factory=dict)
    """Numbers that it holds fixed beside those of :attr:`Law.pinned`, such as the floor's."""
    nested_in: tuple[str, ...] = ()
    """Laws that contain it: with some values of their own numbers they are this one, or as good as."""
    upright: bool = False
    """It has no cushion nose: the wall touches at the height of the centre."""
    rolling_only: bool = False
    """It is about balls that roll before the wall."""
    redundant_upright: bool = False
    """Where the wall touches at the height of the centre it is the law that it is a variant of, and is left out."""
    on_request: bool = False
    """It takes part only where it is asked for by name."""
    same_as: str = ""
    """For this kind of rebound it is another law, by this name."""
    absent: str = ""
    """Why it cannot be fitted to this kind of rebound."""


@dataclass(frozen=True, eq=False)
class Law:
    """A law by name: when it may be applied, what it predicts, why it may not apply, and how others carry it out.

    >>> import carom
    >>> law = carom.LAWS["two-step"]
    >>> law.name, law.reads[:3]
    ('two-step', ('restitution', 'friction', 'tangential_restitution'))
    """

    card: Card
    answer: Callable[[Meeting], Answer]
    """For states that meet the conditions."""
    conditions: Callable[[Meeting], list[Any]]
    """Pairs of a mask (...) that must hold and what is expected (:class:`Condition`); states that fail one get no answer."""
    objections: Callable[[Meeting, Answer], list[str]]
    """For one state: sentences on why the law may not apply; none where it can be true."""
    kernel: WallKernel | None = None
    """The wall alone: (v, w, n, a, kappa, e, mu, last) -> (v, w); ``last`` is the number that :attr:`last` names."""
    reads: tuple[str, ...] | None = None
    """Those numbers of wall and floor (:data:`SURFACES`) that it reads; None: unknown, it may read them all."""
    last: Literal["tangential_restitution", "stiffness_ratio"] = "tangential_restitution"
    response: int = CALLED_WALL
    """How compiled loops carry it out (:data:`CALLED_WALL`: by its kernel)."""
    pinned: Mapping[str, float] = field(default_factory=dict)
    """Numbers of the wall that it holds fixed, whatever the surface says."""
    needs: tuple[str, ...] = ()
    """Numbers of the wall that a scene must give."""
    in_flight: bool = False
    """It is about one contact: in a table without spins the ball is taken to fly."""
    ignores_floor: bool = False
    """It leaves out the floor: `compare` asks it only for a ball above the floor, unless it is named."""
    variant_of: str = ""
    """The law that it is a special case of; `compare` asks it only where it is named."""
    fits: tuple[FitSpec, ...] = (FitSpec("planar"), FitSpec("table"))
    aliases: tuple[str, ...] = ()
    """Other names for it."""
    chi_range: tuple[float, float] | None = None
    """Range of stiffness_ratio (1 + 1/kappa)/2 over which the law is tabulated."""
    line: tuple[str, Any] | None = None
    """Colour and dashes of its line in figures; left out: the next that is free."""
    order: int = 1000
    """Its place in tables: laws stand in this order, then by name."""

    @property
    def name(self) -> str:
        """The card's name."""
        return self.card.name

    @property
    def free(self) -> tuple[str, ...]:
        """Numbers of the wall that a fit may adjust."""
        wall = (*ON_WALL[:2], self.last)
        return tuple(name for name in wall if (self.reads is None or name in self.reads) and name not in self.pinned)


# --- asking the kernel of a wall ------------------------------------------------------------------------------------


def respond(law: WallKernel, meeting: Meeting, last: Any = None) -> State:
    """Return the state (...) after a wall whose law is a kernel; ``last`` takes the place of the tangential restitution."""
    m = meeting
    rows = rows_of(
        m.state, m.normal, m.ball.radius, m.ball.kappa,
        m.wall.restitution, m.wall.friction, m.wall.tangential_restitution if last is None else last,
    )  # fmt: skip
    return State.of(*answer_rows(law, wall_law_rows(law), rows, "vv"))


@kernel
def contact_kernel(v: Vec, w: Vec, n: Vec, a: float, kappa: float, e: float, mu: float, beta: float) -> tuple[Vec, Vec]:
    """One contact, velocity and spin only."""
    v1, w1, _j, _required, _regime = wall_contact(v, w, n, a, kappa, e, mu, beta)
    return v1, w1


def required_friction(ball: Ball, before: State, after: State, normal: Array) -> Any:
    """Return the friction (...), tangential over normal impulse, that a wall needs to turn one state into the other."""
    j = (after.velocity - before.velocity) * np.asarray(ball.mass)[..., None]
    jn = (j * normal).sum(axis=-1)
    f = j - jn[..., None] * normal
    with np.errstate(invalid="ignore", divide="ignore"):
        return np.where(jn > 0, np.sqrt((f * f).sum(axis=-1)) / jn, 0.0)


def wall_then_floor(meeting: Meeting, after: State) -> Answer:
    """Return the answer of a law that says what the wall does; the floor then does what it does to any ball."""
    m = meeting
    required = required_friction(m.ball, m.state, after, m.normal)
    if m.ball.planar:
        return Answer(after, after, required, np.zeros(after.shape), np.full(after.shape, ""))
    then = settle(m.ball, after, m.floor, m.normal, m.gravity, m.height)
    return Answer(after, then.rolling, required, then.floor.required_friction, then.why, then)


def wall_law(
    card: Card,
    kernel: WallKernel,
    conditions: Callable[[Meeting], list[Any]] | None = None,
    objections: Callable[[Meeting, Answer], list[str]] | None = None,
    reads: tuple[str, ...] | None = None,
    **more: Any,
) -> Law:
    """Make a law of what the wall does; the floor then does what it does to any ball: flight, landing, sliding, rolling.

    A disc in the plane has no floor: what leaves the wall is final.

    Parameters
    ----------
    card : Card
    kernel : callable (v, w, n, a, kappa, e, mu, beta) -> (v, w)
        Velocity and spin after the wall, from 3-tuples and numbers.
    conditions : callable(meeting) -> list of (mask, expected), optional
        By default, that the ball moves towards the wall.
    objections : callable(meeting, answer) -> list of sentences, optional
    reads : names of :data:`SURFACES`, optional
    more
        Other fields of :class:`Law`.

    >>> import carom
    >>> def soft(v, w, n, a, kappa, e, mu, beta):
    ...     return (-0.5 * v[0], v[1], v[2]), w
    >>> law = carom.wall_law(carom.Card("soft", "Half of the normal speed.", (), "An example.", "", ""), soft)
    >>> round(carom.compare(carom.incoming(friction=0.0), [law])["soft"].angle_after_wall, 2)
    63.43
    """

    def answer(meeting: Meeting) -> Answer:
        last = meeting.stiffness_ratio if more.get("last") == "stiffness_ratio" else None
        return wall_then_floor(meeting, respond(kernel, meeting, last))

    def against(meeting: Meeting, answer: Answer) -> list[str]:
        return [*impossible(meeting, answer), *(objections(meeting, answer) if objections else [])]

    return Law(card, answer, conditions or approaches, against, kernel, reads=reads, **more)


# --- conditions and objections that laws share ----------------------------------------------------------------------

UPWARD = np.array([0.0, 0.0, 1.0])


def approaches(meeting: Meeting) -> list[Condition]:
    """Return the condition of every law: the ball does not move away from the wall."""
    return [Condition(approaching(meeting.state, meeting.normal), "a ball that moves towards the wall")]


def rubs(surface: Surface) -> bool:
    """Whether friction acts at a surface at all."""
    return bool(np.any((np.asarray(surface.friction) > 0) & (np.asarray(surface.tangential_restitution) > -1)))


def slips(meeting: Meeting, state: State, normal: Any) -> Any:
    """Return a mask (...): where the contact point with a surface slips by more than rounding."""
    a = meeting.ball.radius
    if state.velocity.ndim == 1 and normal.ndim == 1 and type(a) is float:  # one state, without arrays
        v, w, n = (tuple(x.tolist()) for x in (state.velocity, state.spin, normal))
        _un, ut = slip_velocity(v, w, n, a)
        return np.asarray(max(map(abs, ut)) > 1e-9 * (sum(map(abs, v)) + a * sum(map(abs, w))))
    u = slip(meeting.ball, state, normal)
    size = np.abs(state.velocity).sum(axis=-1) + a * np.abs(state.spin).sum(axis=-1)
    return np.abs(u).max(axis=-1) > 1e-9 * size


def slips_on_floor(meeting: Meeting, state: State) -> Any:
    """Return a mask (...): where the contact point with the floor slips by more than rounding."""
    return slips(meeting, state, UPWARD)


def drives_into_floor(meeting: Meeting, answer: Answer) -> list[str]:
    """Object to a law that sends a ball on the floor downwards."""
    down = answer.after_wall.velocity[..., 2] < -1e-9 * np.abs(meeting.state.velocity).sum(axis=-1)
    if meeting.ball.planar or not np.any(down & (np.asarray(meeting.height) == 0)):
        return []
    return ["it drives the ball into the floor, and leaves out that the floor pushes back at once"]


def impossible(meeting: Meeting, answer: Answer) -> list[str]:
    """Object to what no law can do: gain energy, or send the ball through the wall."""
    found = []
    before, after = kinetic_energy(meeting.ball, meeting.state), kinetic_energy(meeting.ball, answer.after_wall)
    if np.any(after > before * (1 + 1e-9)):
        found.append(f"it creates energy: {100 * float(np.max(after / before)):.4g} % is left after the wall")
    speed = np.abs(meeting.state.velocity).sum(axis=-1)
    if np.any((answer.after_wall.velocity * meeting.normal).sum(axis=-1) < -1e-9 * speed):
        found.append("it sends the ball through the wall")
    return found
