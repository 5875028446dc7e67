"""Descriptor of a law of impact: its card, its kernel, its prediction, and what scenes, billiards and fits need to know.

A law is one file of this package that ends with ``LAW = Law(...)``, or with ``wall_law(CARD, kernel)`` if the kernel of the
wall defines it completely. All other modules read the descriptor; none of them refers to a law by name.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from functools import partial
from typing import Any, Literal, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from carom.bodies import Ball, Numbers, State, Surface
from carom.core.contact import slip_velocity, wall_contact
from carom.core.jit.kernel import Vec, dot, kernel
from carom.core.motion.phases import ROUNDING
from carom.errors import MIN_MAGNITUDE, CaromError, require_type
from carom.laws.arrays import RESOLVED, WallKernel, answer_rows, bad_row, require_approach, unit_normal, wall_law_rows
from carom.laws.landing import PAPER_FLOOR, PAPER_WALL, FloorContact, Settled, landing_settings, settle
from carom.public.defaults import GRAVITY, LIKE_SOLIDS

Said = tuple[Any, float, float]
UP: Vec = (0.0, 0.0, 1.0)
NOTICED = 1e-9  # relative: what is less is rounding


class Case(NamedTuple):
    """A ball just before it meets a wall, as numbers; of a meeting of arrays, each is an array or a number."""

    v: Vec
    w: Vec
    n: Vec
    a: float
    kappa: float
    mass: float
    e: float
    mu: float
    beta: float
    stiffness: float
    planar: float
    """1 for a disc in the plane, which has no floor, else 0."""
    floor_mu: float
    floor_beta: float
    height: float
    together: float
    """1 where wall and floor may act at once, else 0."""


class Predicted(NamedTuple):
    """The answer of a law: the state after the wall, the required friction of wall and floor."""

    v: Vec
    w: Vec
    required_wall: float
    required_floor: float
    dropped: float
    """The vertical velocity that a law of cushions leaves out, m/s; else 0."""


class Condition(NamedTuple):
    """A hypothesis of a law."""

    holds: Any
    """Mask (...)."""
    expected: str
    """The hypothesis as a phrase, for messages of the form "expected ...".."""
    field: str = ""
    """The wall parameter concerned, if a scene can be checked before any ball moves: "restitution"..."""


class Rule(NamedTuple):
    """A condition or an objection: its kernel, its sentence with places for the numbers a and b, the field of a wall concerned."""

    kernel: Callable[..., Said]
    text: str
    field: str = ""


class Conditions:
    """The conditions of a law: those of every law (:data:`APPROACHES`) and its own, which are given here."""

    def __init__(self, *own: Rule) -> None:
        self.rules, self.own = (*APPROACHES, *own), own

    def __call__(self, meeting: Any) -> list[Condition]:
        """Return the conditions of a :class:`carom.Meeting`: masks (...) and phrases."""
        return _conditions(meeting, self.rules)

    def of_approaching(self, meeting: Any) -> list[Condition]:
        """Return the conditions that remain where the ball is known to approach the wall (:func:`require_approach`)."""
        return _conditions(meeting, self.own) if self.own else []


def _conditions(meeting: Any, rules: tuple[Rule, ...]) -> list[Condition]:
    case = case_of(meeting)
    if np.ndarray in map(type, (*case.v, *case[3:])):
        with np.errstate(invalid="ignore", over="ignore"):
            found = [(rule, rule.kernel(case)) for rule in rules]
    else:  # (setting NumPy's warnings, and formatting, take longer than the rules of one ball)
        found = [(rule, rule.kernel(case)) for rule in rules]
    return [Condition(_mask(holds), _filled(rule.text, a, b), rule.field) for rule, (holds, a, b) in found]


class Objections:
    """The objections to a law: a call returns sentences. ``dropped``: gives the vertical velocity that the law leaves out."""

    def __init__(self, *rules: Rule, dropped: Callable[[Any], Any] | None = None) -> None:
        self.rules, self.dropped = rules, dropped

    def __call__(self, meeting: Any, answer: Any) -> list[str]:
        """Return why an answer may not apply."""
        if not self.rules:
            return []
        case, after = case_of(meeting), answer.after_wall
        left_out = 0.0 if self.dropped is None else float(self.dropped(meeting))
        required = float(answer.required_wall), float(answer.required_floor)
        outcome = Predicted(_three(after.velocity), _three(after.spin), *required, left_out)
        found = [(rule.text, rule.kernel(case, outcome)) for rule in self.rules]
        return [text.format(a=a, b=b) for text, (holds, a, b) in found if holds]


def case_of(m: Any) -> Case:
    """Return a :class:`carom.Meeting` as numbers, or as arrays."""
    numbers = (
        m.ball.radius, m.ball.kappa, m.ball.mass, m.wall.restitution, m.wall.friction, m.wall.tangential_restitution,
        m.stiffness_ratio, float(m.ball.planar), m.floor.friction, m.floor.tangential_restitution, m.height,
        float(m.floor_contact == "with"),
    )  # fmt: skip
    plain: Any = (x if type(x) is float else float(x) if np.ndim(x) == 0 else np.asarray(x) for x in numbers)
    return Case(_three(m.state.velocity), _three(m.state.spin), _three(m.normal), *plain)


def _three(v: Any) -> Any:
    """Return the components of vectors (..., 3): numbers, or arrays (...)."""
    return tuple(v.tolist()) if v.ndim == 1 else tuple(np.moveaxis(v, -1, 0))


def _mask(holds: Any) -> Any:
    return np.bool_(holds) if isinstance(holds, bool) else np.asarray(holds)


def _filled(text: str, a: Any, b: Any) -> str:
    return text.format(a=_one(a), b=_one(b)) if "{" in text else text


def _one(x: Any) -> float:
    return float(x) if np.ndim(x) == 0 else float(np.asarray(x).flat[0])


def holds_everywhere(mask: Any) -> bool:
    """Return whether a condition holds for all balls (NumPy's all() takes 3 us for one of them)."""
    return bool(mask if getattr(mask, "ndim", 0) == 0 else np.all(mask))


# --- kernels that several laws use --------------------------------------------------------------------------------


@kernel
def size_of(v: Vec) -> float:
    """Return the sum of the components' sizes, by which rounding is measured."""
    return abs(v[0]) + abs(v[1]) + abs(v[2])


@kernel
def slips(v: Vec, w: Vec, n: Vec, a: float) -> Any:
    """Return whether the contact point with a surface slips by more than rounding."""
    _un, u = slip_velocity(v, w, n, a)
    least = NOTICED * (size_of(v) + a * size_of(w))
    return (abs(u[0]) > least) | (abs(u[1]) > least) | (abs(u[2]) > least)


@kernel
def slips_at_wall(c: Case) -> Any:
    """Return whether a ball slips on the wall."""
    return slips(c.v, c.w, c.n, c.a)


@kernel
def has_friction(mu: float, beta: float) -> Any:
    """Return whether a surface exerts any friction."""
    return (mu > 0) & (beta > -1)


@kernel
def energy_of(v: Vec, w: Vec, c: Case) -> float:
    """Return the kinetic energy, J."""
    return c.mass * dot(v, v) / 2 + c.kappa * c.mass * c.a * c.a * dot(w, w) / 2


@kernel
def _comes(c: Case) -> Said:
    return dot(c.v, c.n) <= ROUNDING * size_of(c.v), 0.0, 0.0


@kernel
def _resolved(c: Case) -> Said:
    most = MIN_MAGNITUDE
    fast = (abs(c.v[0]) >= most) | (abs(c.v[1]) >= most) | (abs(c.v[2]) >= most)
    spins = (abs(c.w[0]) >= most) | (abs(c.w[1]) >= most) | (abs(c.w[2]) >= most)
    return fast | spins | (size_of(c.v) + size_of(c.w) == 0), 0.0, 0.0


@kernel
def _creates_energy(c: Case, r: Predicted) -> Said:
    before, after = energy_of(c.v, c.w, c), energy_of(r.v, r.w, c)
    return after > before * (1 + NOTICED), 100 * after / before if before > 0 else math.inf, 0.0


@kernel
def _passes_through(c: Case, r: Predicted) -> Said:
    return dot(r.v, c.n) < -NOTICED * size_of(c.v), 0.0, 0.0


@kernel
def _goes_down(c: Case, r: Predicted) -> Said:
    return c.planar == 0 and c.height == 0 and r.v[2] < -NOTICED * size_of(c.v), 0.0, 0.0


APPROACHES = (Rule(_comes, "a ball that moves towards the wall"), Rule(_resolved, RESOLVED))
"""Conditions of every law: the ball does not leave the wall, nor move too slowly for squares."""
IMPOSSIBLE = (
    Rule(_creates_energy, "it creates energy: {a:.4g} % is left after the wall"),
    Rule(_passes_through, "it sends the ball through the wall"),
)
"""Objections to every law that is a kernel of the wall."""
DRIVES_INTO_FLOOR = Rule(
    _goes_down, "it drives the ball into the floor and ignores the simultaneous reaction of the floor"
)
"""The objection to a law that sends a ball on the floor downwards."""


# ----------------------------------------------------------------------------------------------------
# Descriptor of a law of impact: its card, its kernel, its prediction, and what scenes, billiards and fits need to know.


Array = NDArray[np.float64]
ON_WALL = ("restitution", "friction", "tangential_restitution")
ON_FLOOR = ("floor_restitution", "floor_friction", "floor_tangential_restitution")
SURFACES = (*ON_WALL, "stiffness_ratio", *ON_FLOOR)
"""Parameters of wall and floor that a law may read."""
LastNumber = Literal["tangential_restitution", "stiffness_ratio", "floor_friction"]

# How compiled loops (the event engine, billiards, fits) evaluate a law. TWO_STEP_WALL: one contact, or wall and floor at once
# where the wall presses the ball on the floor; CONTACT_WALL: one contact, regardless of the floor; ROLLING_WALL: the
# conventional reflection of a rolling ball; NO_SLIP_WALL, MIRROR_WALL: one contact with e = 1, beta = 1, and with mu = 0;
# CALLED_WALL: the law's kernel, called by its address.
TWO_STEP_WALL, ROLLING_WALL, NO_SLIP_WALL, MIRROR_WALL, CONTACT_WALL, CALLED_WALL = range(6)


@dataclass(frozen=True)
class Card:
    """Summary, assumptions, range of validity and source of a law, as listed by `carom laws` and the documentation.

    Examples
    --------
    >>> import carom
    >>> carom.CARDS["no-slip"].doi
    '10.1016/0167-2789(93)90205-F'
    """

    name: str
    """As in ``carom.LAWS``."""
    summary: str
    """One sentence."""
    assumptions: tuple[str, ...]
    """One phrase each."""
    valid: str
    """When to use the law, and when not to."""
    equations: str
    """Equation numbers in its source, e.g. "paper (27)-(39)"."""
    citation: str
    """Authors, journal or publisher, year; sources end with semicolons. PAPER where it is the paper that carom is based on."""
    doi: str = ""
    """Empty if there is none."""


PAPER = "Dynamics of a billiard-ball's collision with wall (the copy at hand names no author, year or journal)"


@dataclass(frozen=True, eq=False)
class Meeting:
    """A ball just before it meets a wall: all that a law may depend on. Shapes (...) as in the state.

    Examples
    --------
    >>> import carom
    >>> meeting = carom.Meeting(carom.Ball(), carom.rolling(carom.Ball(), (-1.0, 1.0)))
    >>> carom.LAWS["two-step"].answer(meeting).final.velocity.round(4).tolist()
    [0.6327, 0.7959, 0.0]
    """

    ball: Ball
    """Radius, mass and moment of inertia."""
    state: State
    """Velocity (m/s) and spin (rad/s) before the contact, shape (...)."""
    normal: Array = field(default_factory=lambda: np.array([1.0, 0.0, 0.0]))
    """(..., 3), of unit length, from the wall to the ball."""
    wall: Surface = PAPER_WALL
    """By default the paper's wall: e = 1, sticking."""
    floor: Surface = PAPER_FLOOR
    """By default the paper's floor: e = 0, sticking."""
    gravity: float = GRAVITY
    """m/s^2."""
    height: Numbers = 0.0
    """(...), m: of the centre above its position when the ball rests on the floor."""
    floor_contact: FloorContact = "with"
    """Whether a ball that the wall presses down meets the floor together with the wall, or after it."""
    stiffness_ratio: Numbers = LIKE_SOLIDS
    """(...): tangential over normal stiffness of the wall contact; read by laws with tangential compliance."""


@dataclass(frozen=True, eq=False, repr=False)
class Answer:
    """The prediction of a law. Shapes (...) as in the state."""

    after_wall: State
    final: State
    """The final state: rolling again, or the last one that the law predicts; NaN where there is none."""
    required_wall: Any
    """(...): the friction of the wall that the prediction requires; NaN where no friction suffices."""
    required_floor: Any
    why: Any
    """(...): why there is no final state; empty strings where there is one."""
    steps: Settled | None = None
    """Flight, landing and final rolling, for laws that describe them."""

    @property
    def rolling(self) -> State:
        """The final state, by the name that it has in :func:`carom.two_step`."""
        return self.final

    def __repr__(self) -> str:
        """Return one line: the velocities after the wall and at the end; of many only their shape."""
        if self.final.shape:
            return f"<Answer of shape {self.final.shape}>"
        after, end = (", ".join(f"{v:.4g}" for v in one.velocity) for one in (self.after_wall, self.final))
        return f"<Answer: after the wall {after} m/s, at the end {end} m/s>"


@dataclass(frozen=True)
class FitSpec:
    """How a law is fitted to one kind of rebound."""

    kind: Literal["planar", "table"]
    """A bounce in the plane (ball in the air, disc), or a ball on a table."""
    phrase: str = ""
    """Name of the law in reports. Default: the card's name."""
    free: tuple[str, ...] | None = None
    """Wall parameters that are fitted. Default: the parameters that the law reads and does not hold fixed."""
    pinned: Mapping[str, float] = field(default_factory=dict)
    """Parameters held fixed in addition to :attr:`Law.pinned`, such as the floor's."""
    nested_in: tuple[str, ...] = ()
    """Laws that contain this one: for some values of their parameters they are equivalent to it, or nearly so."""
    upright: bool = False
    """The law has no cushion nose: the wall touches the ball at the height of its centre."""
    rolling_only: bool = False
    """The law requires balls that roll before the wall."""
    redundant_upright: bool = False
    """With a wall that touches at the height of the centre, the law equals the one of which it is a variant, and is omitted."""
    on_request: bool = False
    """The law is fitted only if it is requested by name."""
    same_as: str = ""
    """Name of the law to which this one is equivalent for this kind of rebound."""
    absent: str = ""
    """Why the law cannot be fitted to this kind of rebound."""


@dataclass(frozen=True, eq=False, repr=False)
class Law:
    """A law: its conditions, its prediction, the objections to it, and how compiled loops and fits evaluate it.

    Examples
    --------
    >>> import carom
    >>> law = carom.LAWS["two-step"]
    >>> law.name, law.reads[:3]
    ('two-step', ('restitution', 'friction', 'tangential_restitution'))
    """

    card: Card
    """Summary, assumptions, validity and source."""
    answer: Callable[[Meeting], Answer]
    """The prediction, for states that meet the conditions."""
    conditions: Callable[[Meeting], list[Any]]
    """Pairs of a mask (...) that must hold and a phrase (:class:`Condition`); states that fail one get no prediction."""
    objections: Callable[[Meeting, Answer], list[str]]
    """For one state: sentences on why the law may not apply; empty if it is admissible."""
    kernel: WallKernel | None = None
    """The wall alone: (v, w, n, a, kappa, e, mu, last) -> (v, w); ``last`` is the parameter that :attr:`last` names."""
    reads: tuple[str, ...] | None = None
    """Parameters of wall and floor (:data:`SURFACES`) that the law reads; None: unknown, possibly all of them."""
    last: LastNumber = "tangential_restitution"
    """Name of the last argument of the kernel."""
    response: int = CALLED_WALL
    """How compiled loops evaluate the law (:data:`CALLED_WALL`: through its kernel)."""
    pinned: Mapping[str, float] = field(default_factory=dict)
    """Wall parameters that the law holds fixed, whatever the surface has."""
    needs: tuple[str, ...] = ()
    """Wall parameters that a scene must specify."""
    defaults: Mapping[str, float] = field(default_factory=dict)
    """Its authors' parameters, which scenes and tables use where they give none."""
    in_flight: bool = False
    """The law describes a single contact: in a table without spins the ball is assumed to be in flight, and two balls may meet by
    it (:attr:`for_pairs`)."""
    slip_friction: tuple[float, float, float] | None = None
    """mu, drop, rate (s/m) of a contact whose friction falls with the slip, mu + drop exp(-rate slip), whatever the surface has.
    Its kernel evaluates the same; where balls meet, the engine does."""
    ignores_floor: bool = False
    """The law ignores the floor: by default `compare` includes it only for a ball above the floor."""
    on_table: str = ""
    """The law that this one equals but for the vertical velocity of a ball on the table, which stays zero: a published law of
    cushions. `compare` includes it by default only for a ball on the table and a nose above the centre."""
    variant_of: str = ""
    """The law of which this one is a special case; `compare` includes it only if it is named."""
    fits: tuple[FitSpec, ...] = (FitSpec("planar"), FitSpec("table"))
    """How the law is fitted to each kind of rebound."""
    aliases: tuple[str, ...] = ()
    """Other names of the law."""
    chi_range: tuple[float, float] | None = None
    """Range of stiffness_ratio (1 + 1/kappa)/2 over which the law is tabulated."""
    line: tuple[str, Any] | None = None
    """Colour and dashes of its line in figures. Default: the next free ones."""
    order: int = 1000
    """Position in tables: laws are sorted by this number, then by name."""

    def __call__(
        self,
        ball: Ball,
        state: State,
        wall: Surface | None = None,
        floor: Surface = PAPER_FLOOR,
        normal: ArrayLike = (1.0, 0.0, 0.0),
        gravity: float = GRAVITY,
        height: ArrayLike = 0.0,
        floor_contact: FloorContact = "with",
        stiffness_ratio: float = LIKE_SOLIDS,
    ) -> Answer:
        """Compute the prediction for a ball that meets a wall, with the arguments of :func:`carom.two_step`.

        Parameters
        ----------
        ball, state, wall, floor, normal, gravity, height, floor_contact
            As in :func:`carom.two_step`. Default of the wall: the restitution and friction of the law's authors, else the paper's
            wall, e = 1 and sticking.
        stiffness_ratio : float
            Tangential over normal stiffness of the wall contact, for laws with tangential compliance.

        Returns
        -------
        Answer
            ``after_wall`` and ``final`` (velocity, spin), ``required_wall`` and ``required_floor`` friction, ``why``. Shapes (...).

        Raises CaromError, one line, for a state that does not meet the law's conditions.

        Examples
        --------
        >>> import carom
        >>> ball = carom.Ball(radius=0.0286, mass=0.17)
        >>> nose = (1.0, 0.0, -0.37)  # the cushion touches above the centre
        >>> law = carom.LAWS["mathavan2010"]
        >>> law(ball, carom.rolling(ball, (-2.0, 1.0)), normal=nose).after_wall.velocity.round(3).tolist()
        [1.629, 0.657, 0.0]
        """
        if wall is None:
            of = {name: self.defaults[name] for name in ON_WALL if name in self.defaults}
            wall = Surface(**of) if of else PAPER_WALL
        require_type(self.name, "wall", wall, Surface)
        require_type(self.name, "floor", floor, Surface)
        n = unit_normal(normal)
        require_approach(ball, state, n)
        g, h, _together = landing_settings(gravity, height, floor_contact, self.name)
        meeting = Meeting(ball, state, n, wall, floor, g, h, floor_contact, stiffness_ratio)
        _require_conditions(self, meeting)
        return self.answer(meeting)

    def __repr__(self) -> str:
        """Return one line: its name, and its summary."""
        return f"<Law {self.name}: {self.card.summary}>"

    @property
    def name(self) -> str:
        """The card's name."""
        return self.card.name

    @property
    def for_pairs(self) -> bool:
        """Whether two balls may meet by it: a single contact, which depends on their relative motion alone."""
        return self.in_flight and self.kernel is not None

    @property
    def one_contact(self) -> bool:
        """Whether the engine's own contact of two balls is this law, with the numbers that it holds fixed."""
        return self.response == CONTACT_WALL or self.slip_friction is not None

    @property
    def free(self) -> tuple[str, ...]:
        """Wall parameters that a fit may adjust."""
        wall = (*ON_WALL[:2], self.last)
        return tuple(name for name in wall if (self.reads is None or name in self.reads) and name not in self.pinned)


# --- evaluating the kernel of a wall --------------------------------------------------------------------------------


def respond(law: WallKernel, meeting: Meeting, last: Any = None) -> State:
    """Return the state (...) after a wall whose law is a kernel; ``last`` replaces the tangential restitution."""
    m = meeting
    beta = m.wall.tangential_restitution if last is None else last
    parameters = (m.ball.radius, m.ball.kappa, m.wall.restitution, m.wall.friction, beta)
    return State.of(*answer_rows(law, wall_law_rows(law), "vv", (m.state.velocity, m.state.spin, m.normal), parameters))


@kernel
def contact_kernel(v: Vec, w: Vec, n: Vec, a: float, kappa: float, e: float, mu: float, beta: float) -> tuple[Vec, Vec]:
    """Velocity and spin after one contact."""
    v1, w1, _j, _required, _regime = wall_contact(v, w, n, a, kappa, e, mu, beta)
    return v1, w1


def required_friction(ball: Ball, before: State, after: State, normal: Array) -> Any:
    """Return the friction (...), tangential over normal impulse, required of a wall to turn one state into the other."""
    j = (after.velocity - before.velocity) * np.asarray(ball.mass)[..., None]
    jn = (j * normal).sum(axis=-1)
    f = j - jn[..., None] * normal
    with np.errstate(invalid="ignore", divide="ignore"):
        return np.where(jn > 0, np.sqrt((f * f).sum(axis=-1)) / jn, 0.0)


def wall_then_floor(meeting: Meeting, after: State) -> Answer:
    """Return the answer of a law that defines the wall only; flight, landing, sliding and rolling follow as in any law."""
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
    """Make a law from a kernel of the wall; flight, landing, sliding and rolling follow as for any ball.

    For a disc in the plane there is no floor, so the state after the wall is final.

    Parameters
    ----------
    card : Card
        Name, summary, assumptions and source.
    kernel : callable (v, w, n, a, kappa, e, mu, beta) -> (v, w)
        Velocity (m/s) and spin (rad/s) after the wall, from 3-tuples and numbers in SI units.
    conditions : callable(meeting) -> list of (mask, expected), optional
        Default: the ball moves towards the wall.
    objections : callable(meeting, answer) -> list of sentences, optional
        In addition to those against energy gained and balls that pass through the wall.
    reads : names of :data:`SURFACES`, optional
        Parameters that the kernel reads. Default: unknown.
    more
        Other fields of :class:`Law`.

    Returns
    -------
    Law

    Examples
    --------
    >>> import carom
    >>> def soft(v, w, n, a, kappa, e, mu, beta):
    ...     return (-0.5 * v[0], v[1], v[2]), w
    >>> law = carom.wall_law(carom.Card("soft", "Halves the normal speed.", (), "An example.", "", ""), soft)
    >>> round(carom.compare(carom.incoming(friction=0.0), [law])["soft"].angle_after_wall_deg, 2)
    63.43
    """

    answer = partial(_answer_of_kernel, kernel, more.get("last", ""))
    against: Any = Objections(*IMPOSSIBLE)
    if isinstance(objections, Objections):
        against = Objections(*IMPOSSIBLE, *objections.rules, dropped=objections.dropped)
    elif objections is not None:
        against = partial(_against, objections)
    return Law(card, answer, conditions or approaches, against, kernel, reads=reads, **more)


def _against(objections: Callable[[Meeting, Answer], list[str]], meeting: Meeting, answer: Answer) -> list[str]:
    """Return the objections to energy gained and to passing through the wall, and a law's own."""
    return [*Objections(*IMPOSSIBLE)(meeting, answer), *objections(meeting, answer)]


def _answer_of_kernel(kernel: WallKernel, last: str, meeting: Meeting) -> Answer:
    """Return the answer of a law that is a kernel of the wall; ``last`` names the kernel's last argument."""
    value = {"stiffness_ratio": meeting.stiffness_ratio, "floor_friction": meeting.floor.friction}.get(last)
    return wall_then_floor(meeting, respond(kernel, meeting, value))


approaches = Conditions()
"""The conditions of every law: the ball does not leave the wall, nor move too slowly for squares."""


# ----------------------------------------------------------------------------------------------------
# Shared by the laws of tangential compliance: the parameters that they read, and when they may not apply.


COMPLIANT_READS = ("restitution", "friction", "stiffness_ratio", *ON_FLOOR)


@kernel
def _gives_back(c: Case, r: Predicted) -> Said:
    return c.beta != 0, 0.0, 0.0


compliant_objections = Objections(
    DRIVES_INTO_FLOOR,
    Rule(_gives_back, "it models the tangential rebound by springs and ignores this wall's tangential restitution"),
)


# ----------------------------------------------------------------------------------------------------
# The state after a wall under a law given by a kernel; an error with the reason where the law does not apply.


def reflect(law: Law, ball: Ball, state: State, normal: ArrayLike, surface: Surface) -> State:
    """Return the state (...) after the wall by a law's kernel; CaromError, one line per condition that fails."""
    meeting = Meeting(ball, state, unit_normal(normal), surface)
    require_approach(meeting.ball, meeting.state, meeting.normal)
    _require_conditions(law, meeting)
    assert law.kernel is not None  # all laws that are called here have one
    return respond(law.kernel, meeting)


def _require_conditions(law: Law, meeting: Meeting) -> None:
    """Raise CaromError, one line per condition of a law that fails, for a ball that is known to approach the wall."""
    of = law.conditions
    faults = [
        f"{law.name}: expected {expected}, got a state or a wall for which this does not hold{bad_row(~np.asarray(holds))}"
        for holds, expected, *_field in (of.of_approaching(meeting) if isinstance(of, Conditions) else of(meeting))
        if not holds_everywhere(holds)
    ]
    if faults:
        raise CaromError(*faults)
