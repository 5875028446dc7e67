"""Conditions and objections of laws: kernels, which Python and the explorer's module run, and sentences as data.

A condition is a kernel of a :class:`Case` without branches, so that it takes arrays (...) as it takes numbers. An objection is a
kernel of a case and of the law's answer, for one state. Both return whether they hold, and two numbers for their sentence.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np

from carom.core.contact import slip_velocity
from carom.core.jit.kernel import Vec, dot, kernel
from carom.core.motion.phases import ROUNDING
from carom.errors import MIN_MAGNITUDE
from carom.laws.arrays import RESOLVED

__all__ = [
    "APPROACHES", "DRIVES_INTO_FLOOR", "IMPOSSIBLE", "NOTICED", "UP", "Case", "Condition", "Conditions", "Objections", "Predicted",
    "Rule", "Said", "case_of", "energy_of", "has_friction", "holds_everywhere", "size_of", "slips", "slips_at_wall",
]  # fmt: skip

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
    """The conditions of a law: what a call with a meeting returns."""

    def __init__(self, *rules: Rule) -> None:
        self.rules = rules

    def __call__(self, meeting: Any) -> list[Condition]:
        """Return the conditions of a :class:`carom.Meeting`: masks (...) and phrases."""
        case = case_of(meeting)
        with np.errstate(invalid="ignore", over="ignore"):
            found = [(rule, rule.kernel(case)) for rule in self.rules]
        return [
            Condition(_mask(holds), rule.text.format(a=_one(a), b=_one(b)), rule.field) for rule, (holds, a, b) in found
        ]


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
