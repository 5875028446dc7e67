"""carom's laws as models of the resolver of pooltool 0.6 and its main branch. Only this module and ``systems`` import pooltool."""

from __future__ import annotations

import warnings
from typing import Any

import attrs
import numpy as np
from cattrs.gen import make_dict_unstructure_fn, override
from pooltool import constants
from pooltool.objects.ball.datatypes import BallState
from pooltool.physics.resolve.ball_ball import ball_ball_models
from pooltool.physics.resolve.ball_ball.core import CoreBallBallCollision
from pooltool.physics.resolve.ball_cushion import ball_ccushion_models, ball_lcushion_models
from pooltool.physics.resolve.ball_cushion.core import CoreBallCCushionCollision, CoreBallLCushionCollision
from pooltool.physics.resolve.resolver import default_resolver
from pooltool.serialize import SerializeFormat, conversion

from carom.bodies import Ball, State, Surface
from carom.errors import CaromError
from carom.interop.pooltool.physics import (
    after_collision,
    after_cushion,
    bounced,
    landed,
    lifted_by_cushion,
    nose_normal,
)
from carom.laws.law import Law
from carom.laws.pair import collide
from carom.laws.registry import law_named
from carom.laws.results import Flight

__all__ = ["CaromCircular", "CaromLinear", "CaromPair", "build_engine", "register_models"]

CUSHION, PAIR = "carom_cushion", "carom_collide"
LEAST_HOP = 1e-4  # m: pooltool follows bounces one by one, and would never end with them
try:  # the main branch, after 0.6.0: engines of two or three dimensions
    from pooltool.evolution.engine import SimulationEngine
    from pooltool.physics.dimensionality import Dim
    from pooltool.physics.resolve.ball_table.core import CoreBallTableCollision, final_ball_motion_state
except ImportError:
    from pooltool.physics.engine import PhysicsEngine

    Dim: Any = None  # type: ignore[no-redef]


def _planar() -> Any:
    return None if Dim is None else Dim.TWO


def _known(_model: Any, _field: Any, law: Any) -> None:
    if not isinstance(law, Law):
        law_named(law)


def _name(law: Any) -> str:
    if isinstance(law, Law):
        raise CaromError(
            f"pooltool: law: expected a law of carom's by name in a file, got the custom law {law.name!r};"
            " give it to carom.interop.pooltool.engine each time"
        )
    return str(law)


def _floor(params: Any) -> Surface:
    """The cloth: pooltool's friction of a sliding ball; a ball that lands does not bounce, as pooltool could not show it."""
    return Surface(0.0, params.u_s)


def _note(flights: list[Flight], flight: Flight) -> None:
    """Keep a flight that is left out; the first one is a warning."""
    if not flight.height > 0:
        return
    flights.append(flight)
    if len(flights) == 1:
        text = (
            f"pooltool 0.6 has no gravity: a hop {1000 * flight.height:.3g} mm high, {flight.duration:.3g} s and"
            f" {1000 * flight.distance:.3g} mm long is left out, the ball lands at once; the model's `flights` lists all"
        )
        warnings.warn(text, stacklevel=2)


@attrs.define
class _Cushion:
    """Which law, with which surface; what is None is the ball's own e_c and f_c, as in pooltool's models."""

    law: Any = attrs.field(default="two-step", validator=_known)
    restitution: float | None = None
    friction: float | None = None
    tangential_restitution: float = 0.0
    model: str = attrs.field(default=CUSHION, init=False, repr=False)
    dim: Any = attrs.field(factory=_planar, init=False, repr=False, eq=False)
    flights: list[Flight] = attrs.field(factory=list, init=False, repr=False, eq=False)

    def solve(self, ball: Any, cushion: Any) -> tuple[Any, Any]:
        """Return ball and cushion after the impact and the landing."""
        law = self.law if isinstance(self.law, Law) else law_named(self.law)
        p, rvw = ball.params, ball.state.rvw
        e = p.e_c if self.restitution is None else self.restitution
        mu = p.f_c if self.friction is None else self.friction
        above = float(rvw[0][2]) - p.R if _in_space(self) else 0.0
        normal = nose_normal(cushion.get_normal_xy(rvw[0]), rvw[1], cushion.height - above, p.R)
        meeting = (
            law, Ball(p.R, p.m), State(rvw[1], rvw[2]), normal, Surface(e, mu, self.tangential_restitution), _floor(p), p.g,
        )  # fmt: skip
        if _in_space(self):
            _leave_in_space(ball, lifted_by_cushion(*meeting, max(above, 0.0)))
            return ball, cushion
        state, flight = after_cushion(*meeting)
        _note(self.flights, flight)
        _leave(ball, state)
        return ball, cushion


def _in_space(model: Any) -> bool:
    """Return whether a model plays in three dimensions."""
    return Dim is not None and model.dim == Dim.THREE


def _leave_in_space(ball: Any, state: State) -> None:
    """Set a ball's state; one on the table that is pushed into it lands at once."""
    x, p = ball.state.rvw[0], ball.params
    if state.velocity[2] < 0 and x[2] <= p.R * (1 + 1e-9):
        state = landed(Ball(p.R, p.m), state, _floor(p), p.g)[0]
    rvw = np.array([x, state.velocity, state.spin])
    ball.state = BallState(rvw, final_ball_motion_state(rvw, p.R))


def _leave(ball: Any, state: State) -> None:
    ball.state = BallState(np.array([ball.state.rvw[0], state.velocity, state.spin]), constants.sliding)
    ball.state.rvw[1, 2] = 0.0  # (of the size of rounding)


@attrs.define
class CaromLinear(_Cushion, CoreBallLCushionCollision):
    """A law of carom's at pooltool's straight cushions."""


@attrs.define
class CaromCircular(_Cushion, CoreBallCCushionCollision):
    """A law of carom's at pooltool's jaws."""


@attrs.define
class CaromPair(CoreBallBallCollision):
    """carom.collide for two balls of pooltool's, with the means of their e_b and u_b where nothing else is given."""

    restitution: float | None = None
    friction: float | None = None
    model: str = attrs.field(default=PAIR, init=False, repr=False)
    dim: Any = attrs.field(factory=_planar, init=False, repr=False, eq=False)
    flights: list[Flight] = attrs.field(factory=list, init=False, repr=False, eq=False)

    def solve(self, ball1: Any, ball2: Any) -> tuple[Any, Any]:
        """Return both balls after the contact, and after what it lifts has landed."""
        p, q = ball1.params, ball2.params
        e = (p.e_b + q.e_b) / 2 if self.restitution is None else self.restitution
        mu = (p.u_b + q.u_b) / 2 if self.friction is None else self.friction
        states = tuple(State(one.state.rvw[1], one.state.rvw[2]) for one in (ball1, ball2))
        normal = ball1.state.rvw[0] - ball2.state.rvw[0]
        if _in_space(self):
            found = collide(Ball(p.R, p.m), states[0], Ball(q.R, q.m), states[1], normal, Surface(e, mu)).after
            for ball, state in zip((ball1, ball2), found, strict=True):
                _leave_in_space(ball, state)
            return ball1, ball2
        after, flights = after_collision(Ball(p.R, p.m), (states[0], states[1]), normal, Surface(e, mu), _floor(p), p.g)
        for ball, state, flight in zip((ball1, ball2), after, flights, strict=True):
            _note(self.flights, flight)
            _leave(ball, state)
        return ball1, ball2


def _table_model() -> Any:
    """Return carom's contact of a ball with the table, for the main branch's engine of three dimensions."""

    @attrs.define
    class CaromTable(CoreBallTableCollision):
        """The contact kernel, with the ball's e_t and u_s."""

        def solve(self, ball: Any) -> Any:
            """Return the ball after it has met the table."""
            p, rvw = ball.params, ball.state.rvw
            after = bounced(Ball(p.R, p.m), State(rvw[1], rvw[2]), Surface(p.e_t, p.u_s), LEAST_HOP, p.g)
            made = np.array([rvw[0], after.velocity, after.spin])
            ball.state = BallState(made, final_ball_motion_state(made, p.R))
            return ball

    return CaromTable()


def build_engine(law: str | Law, wall: Surface | None, pairs: bool, is_3d: bool = False) -> Any:
    """Return pooltool's engine with its default models but carom's for cushions and, if asked, pairs and the third dimension."""
    numbers = () if wall is None else (wall.restitution, wall.friction, wall.tangential_restitution)
    resolver = default_resolver()
    resolver.ball_linear_cushion = CaromLinear(law, *numbers)
    resolver.ball_circular_cushion = CaromCircular(law, *numbers)
    resolver.ball_circular_cushion.flights = resolver.ball_linear_cushion.flights  # one list, one warning
    if pairs:
        resolver.ball_ball = CaromPair()
    if Dim is None:
        if is_3d:
            raise CaromError(
                "engine: is_3d: expected pooltool's main branch (after 0.6.0), which has a third dimension, got 0.6;"
                " leave is_3d out: the ball then lands at once"
            )
        return PhysicsEngine(resolver=resolver)
    if is_3d:
        for model in (resolver.ball_linear_cushion, resolver.ball_circular_cushion, resolver.ball_ball):
            if isinstance(model, _Cushion | CaromPair):
                model.dim = Dim.THREE
        resolver.ball_table = _table_model()
    return SimulationEngine(is_3d=is_3d, resolver=resolver)


def register_models() -> None:
    """Add carom's models to those that pooltool knows in resolver files."""
    ball_lcushion_models[CUSHION] = CaromLinear
    ball_ccushion_models[CUSHION] = CaromCircular
    ball_ball_models[PAIR] = CaromPair
    for form in (SerializeFormat.YAML, SerializeFormat.JSON):
        for cls in (CaromLinear, CaromCircular, CaromPair):
            changed = {"flights": override(omit=True), "dim": override(omit=True)}
            if cls is not CaromPair:
                changed["law"] = override(unstruct_hook=_name)
            # without the field `model`, which has no place in __init__, the file could not be read again
            hook = make_dict_unstructure_fn(cls, conversion[form], _cattrs_include_init_false=True, **changed)
            conversion.register_unstructure_hook(cls, hook, which=(form,))
