"""carom's floor as a model of the resolver of pooltool's main branch, for balls that land."""

from __future__ import annotations

from typing import Any

import attrs
from pooltool.physics.resolve.ball_table import ball_table_models
from pooltool.physics.resolve.ball_table.core import CoreBallTableCollision

from carom.bodies import Ball, State, Surface
from carom.interop.pooltool.dimensions import leave
from carom.interop.pooltool.physics import off_floor

FLOOR = "carom_floor"


@attrs.define
class CaromFloor(CoreBallTableCollision):
    """carom.impact on the cloth, with the ball's own e_t and u_s where nothing else is given.

    A bounce that would be lower than ``least_bounce`` (m) is the last: without a limit an inelastic ball has infinitely many.
    """

    restitution: float | None = None
    friction: float | None = None
    least_bounce: float = 1e-9
    model: str = attrs.field(default=FLOOR, init=False, repr=False)

    def solve(self, ball: Any) -> Any:
        """Return the ball after its contact with the cloth."""
        p, rvw = ball.params, ball.state.rvw
        e = p.e_t if self.restitution is None else self.restitution
        mu = p.u_s if self.friction is None else self.friction
        after = off_floor(Ball(p.R, p.m), State(rvw[1], rvw[2]), Surface(e, mu))
        x, y, z = after.velocity.tolist()
        if z * z / (2 * p.g) < self.least_bounce:
            after = State((x, y, 0.0), after.spin)
        leave(ball, after, True)
        return ball


def register_floor() -> None:
    """Add the model to the models that pooltool knows in resolver files."""
    ball_table_models[FLOOR] = CaromFloor
