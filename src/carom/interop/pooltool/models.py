"""carom's laws as models of pooltool's resolver, 0.6.0 or main. Only this module, ``floor`` and ``systems`` import pooltool."""

from __future__ import annotations

import warnings
from typing import Any

import attrs
from cattrs.gen import make_dict_unstructure_fn, override
from pooltool.physics.resolve.ball_ball import ball_ball_models
from pooltool.physics.resolve.ball_ball.core import CoreBallBallCollision
from pooltool.physics.resolve.ball_cushion import ball_ccushion_models, ball_lcushion_models
from pooltool.physics.resolve.ball_cushion.core import CoreBallCCushionCollision, CoreBallLCushionCollision
from pooltool.physics.resolve.resolver import default_resolver
from pooltool.serialize import SerializeFormat, conversion

from carom.bodies import Ball, State, Surface
from carom.errors import CaromError
from carom.interop.pooltool.dimensions import leave, needed
from carom.interop.pooltool.physics import (
    after_collision,
    after_cushion,
    apart,
    has_flights,
    nose_normal,
    off_cushion,
    off_floor,
)
from carom.laws.landing import Flight
from carom.laws.law import Law
from carom.laws.pair import collide
from carom.laws.registry import law_named

CUSHION, PAIR = "carom_cushion", "carom_collide"


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


def _floor(params: Any, is_3d: bool = False) -> Surface:
    """The cloth: pooltool's friction of a sliding ball. In two dimensions a ball that lands does not bounce: none could show it."""
    return Surface(params.e_t if is_3d else 0.0, params.u_s)


def _note(flights: list[Flight], flight: Flight) -> None:
    """Keep a flight that is left out; the first one is a warning."""
    if not flight.height > 0:
        return
    flights.append(flight)
    if len(flights) == 1:
        text = (
            f"pooltool in two dimensions has no gravity: a hop {1000 * flight.height:.3g} mm high, {flight.duration:.3g} s and"
            f" {1000 * flight.distance:.3g} mm long is left out, the ball lands at once; the model's list flights has all"
        )
        warnings.warn(text, stacklevel=2)


@attrs.define
class _Cushion:
    """Which law, with which surface; what is None is the ball's own e_c and f_c, as in pooltool's models."""

    law: Any = attrs.field(default="two-step", validator=_known)
    restitution: float | None = None
    friction: float | None = None
    tangential_restitution: float = 0.0
    is_3d: bool = False
    model: str = attrs.field(default=CUSHION, init=False, repr=False)
    flights: list[Flight] = attrs.field(factory=list, init=False, repr=False, eq=False)

    @property
    def dim(self) -> Any:
        """The simulations of pooltool's main branch that this model is for."""
        return needed(self.is_3d)

    def solve(self, ball: Any, cushion: Any) -> tuple[Any, Any]:
        """Return ball and cushion after the impact and, in two dimensions, the landing."""
        law = self.law if isinstance(self.law, Law) else law_named(self.law)
        p, rvw = ball.params, ball.state.rvw
        e = p.e_c if self.restitution is None else self.restitution
        mu = p.f_c if self.friction is None else self.friction
        meeting = (
            law, Ball(p.R, p.m), State(rvw[1], rvw[2]), nose_normal(cushion.get_normal_xy(rvw[0]), rvw[1], cushion.height, p.R),
            Surface(e, mu, self.tangential_restitution), _floor(p, self.is_3d), p.g,
        )  # fmt: skip
        if self.is_3d:
            state = off_cushion(*meeting)
        else:
            state, flight = after_cushion(*meeting)
            _note(self.flights, flight)
        leave(ball, state, self.is_3d)
        return ball, cushion


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
    is_3d: bool = False
    model: str = attrs.field(default=PAIR, init=False, repr=False)
    flights: list[Flight] = attrs.field(factory=list, init=False, repr=False, eq=False)

    @property
    def dim(self) -> Any:
        """The simulations of pooltool's main branch that this model is for."""
        return needed(self.is_3d)

    def solve(self, ball1: Any, ball2: Any) -> tuple[Any, Any]:
        """Return both balls after the contact and, in two dimensions, after what it lifts has landed."""
        p, q = ball1.params, ball2.params
        e = (p.e_b + q.e_b) / 2 if self.restitution is None else self.restitution
        mu = (p.u_b + q.u_b) / 2 if self.friction is None else self.friction
        states = tuple(State(one.state.rvw[1], one.state.rvw[2]) for one in (ball1, ball2))
        normal = ball1.state.rvw[0] - ball2.state.rvw[0]
        body, pair = Ball(p.R, p.m), (states[0], states[1])
        if self.is_3d:
            met = pair if apart(pair, normal) else collide(body, pair[0], body, pair[1], normal, Surface(e, mu)).after
            for ball, state in zip((ball1, ball2), met, strict=True):
                on_floor = ball.state.rvw[0, 2] <= p.R
                leave(ball, off_floor(body, state, _floor(p, True)) if on_floor else state, True)
            return ball1, ball2
        after, flights = after_collision(body, pair, normal, Surface(e, mu), _floor(p), p.g)
        for ball, state, flight in zip((ball1, ball2), after, flights, strict=True):
            _note(self.flights, flight)
            leave(ball, state, False)
        return ball1, ball2


def build_engine(law: str | Law, wall: Surface | None, pairs: bool, is_3d: bool) -> Any:
    """Return pooltool's engine with its default models but carom's for cushions and, if asked, pairs; in 3-D for the floor too."""
    surface = (None, None, 0.0) if wall is None else (wall.restitution, wall.friction, wall.tangential_restitution)
    numbers: tuple[Any, ...] = (law, *surface, is_3d)
    resolver = default_resolver()
    resolver.ball_linear_cushion = CaromLinear(*numbers)
    resolver.ball_circular_cushion = CaromCircular(*numbers)
    resolver.ball_circular_cushion.flights = resolver.ball_linear_cushion.flights  # one list, one warning
    if pairs:
        resolver.ball_ball = CaromPair(is_3d=is_3d)
    return make_engine(resolver, is_3d)


def make_engine(resolver: Any, is_3d: bool) -> Any:
    """Return the engine of the pooltool that is installed. In 3-D its cue is the one that can lift a ball, its floor carom's."""
    if not has_flights():
        from pooltool.physics.engine import PhysicsEngine

        return PhysicsEngine(resolver=resolver)
    from pooltool.evolution.engine import SimulationEngine

    if is_3d:
        from pooltool.physics.resolve.stick_ball.instantaneous_point import InstantaneousPoint3D

        from carom.interop.pooltool.floor import CaromFloor

        cue = resolver.stick_ball
        resolver.stick_ball = InstantaneousPoint3D(cue.english_throttle, cue.squirt_throttle)
        resolver.ball_table = CaromFloor()
    return SimulationEngine(is_3d=is_3d, resolver=resolver)


def register_models() -> None:
    """Add carom's models to the models that pooltool knows in resolver files."""
    ball_lcushion_models[CUSHION] = CaromLinear
    ball_ccushion_models[CUSHION] = CaromCircular
    ball_ball_models[PAIR] = CaromPair
    models: list[Any] = [CaromLinear, CaromCircular, CaromPair]
    if has_flights():
        from carom.interop.pooltool.floor import CaromFloor, register_floor

        register_floor()
        models.append(CaromFloor)
    for form in (SerializeFormat.YAML, SerializeFormat.JSON):
        for cls in models:
            changed = {"flights": override(omit=True)} if hasattr(cls, "flights") else {}
            if issubclass(cls, _Cushion):
                changed["law"] = override(unstruct_hook=_name)
            # without the field `model`, which has no place in __init__, the file could not be read again
            hook = make_dict_unstructure_fn(cls, conversion[form], _cattrs_include_init_false=True, **changed)
            conversion.register_unstructure_hook(cls, hook, which=(form,))
