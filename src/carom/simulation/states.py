"""Compute states between events from the closed forms of carom.core.motion, for many times at once."""

from __future__ import annotations

import contextlib
import functools
from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import NDArray

from carom.core.jit.compile import is_cached, njit
from carom.core.jit.kernel import vector
from carom.core.jit.objects import as_objects, write_back
from carom.core.jit.slices import sliced
from carom.core.motion.phases import BOUNCING, HELD
from carom.core.motion.rotation import orientation_after, orientation_after_bounces, orientation_after_decay
from carom.simulation.motion import begin_phase, lean, move_by

__all__ = ["orientations", "state_rows", "states"]

Array = NDArray[np.float64]
# Below so many rows Python is quicker than loading the compiled loop; and than compiling it.
FEW, FEW_BEFORE_COMPILING = 200, 20_000


def state_rows(worlds: Any, balls: Any, after: Any) -> None:
    """Advance every ball, each by its own time."""
    for i in range(balls.shape[0]):
        begin_phase(worlds[0], balls[i])
        move_by(worlds[0], balls[i], after[i], after[i])


def _turn_rows(worlds: Any, balls: Any, after: Any, q: Any) -> None:
    """Rotate every orientation (N, 4) by the rotation of its ball in its time."""
    world = worlds[0]
    for i in range(balls.shape[0]):
        ball = balls[i]
        v, w = vector(ball.v), vector(ball.w)
        old = (q[i, 0], q[i, 1], q[i, 2], q[i, 3])
        if ball.phase == BOUNCING:
            new = orientation_after_bounces(
                old, v, w, ball.radius, ball.kappa, world.g, world.floor_form, vector(world.floor_p),
                world.floor_mu, world.floor_beta, after[i],
            )  # fmt: skip
        else:
            begin_phase(world, ball)
            turn = vector(ball.turn)
            if ball.decays == 0:
                new = orientation_after(old, w, turn, after[i])
            else:
                slope = (ball.phase, v, ball.radius, ball.kappa, lean(ball))
                new = orientation_after_decay(old, w, turn, ball.fade, ball.spin_fade, ball.spin_gain, slope, after[i])
        q[i, 0], q[i, 1], q[i, 2], q[i, 3] = new


@functools.cache
def _compiled(loop: Callable[..., None]) -> Callable[..., None]:
    return njit(loop)


def _run(loop: Callable[..., None], world: Any, balls: Any, after: Array, *q: Array) -> None:
    count = balls.shape[0]
    if count < FEW or (count < FEW_BEFORE_COMPILING and not is_cached(loop)):
        objects, turned_q = as_objects(balls), [np.array(one) for one in q]
        # (what Python refuses, such as a division by zero, compiled code has a number for)
        with contextlib.suppress(ArithmeticError, ValueError), np.errstate(all="ignore"):
            loop(as_objects(world), objects, after.tolist(), *turned_q)
            write_back(objects, balls)
            for one, new in zip(q, turned_q, strict=True):
                one[:] = new
            return
    sliced(_compiled(loop), count)(world, balls, after, *q)


def _rows(balls: Any, which: Any, log: Any) -> Any:
    """Return the balls in the states of a log's rows."""
    rows = balls[which].copy()
    for field in ("x", "v", "w", "phase"):
        rows[field] = log[field]
    rows["clock"] = 0
    return rows


def states(world: Any, balls: Any, log: Any, after: Array) -> tuple[Array, Array, Array, Any]:
    """Return position, velocity, spin (N, 3) and phase (N,), each a time ``after`` (N,) its row of the log.

    NaN where the ball is no longer followed.
    """
    rows = _rows(balls, log["ball"], log)
    gone = (rows["phase"] >= HELD) & (after > 0)
    _run(state_rows, world, rows, np.where(gone, 0.0, after))
    for field in ("x", "v", "w"):
        rows[field][gone] = np.nan
    return rows["x"], rows["v"], rows["w"], rows["phase"]


def orientations(world: Any, balls: Any, log: Any, after: Array, q: Array) -> Array:
    """Return unit quaternions (N, 4) a time ``after`` (N,) each row of the log, at which the orientation was q (N, 4)."""
    rows = _rows(balls, log["ball"], log)
    q = np.array(q)
    _run(_turn_rows, world, rows, np.where(rows["phase"] >= HELD, 0.0, after), q)
    return q
