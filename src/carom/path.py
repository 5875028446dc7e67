"""States between events: the closed forms of carom.motion, for many times at once."""

from __future__ import annotations

import functools
from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import NDArray

from carom.engine.loop import move_by
from carom.engine.predict import begin, pace_of
from carom.kernel import vector
from carom.motion.phases import BOUNCING, HELD
from carom.motion.rotation import turned, turned_bouncing

__all__ = ["orientations", "states"]

Array = NDArray[np.float64]
# Below this many rows Python itself is quicker than loading what was compiled.
FEW = 200


def _state_rows(worlds: Any, balls: Any, after: Any) -> None:
    """Move every ball, each by its own time."""
    for i in range(balls.shape[0]):
        begin(worlds[0], balls[i])
        move_by(worlds[0], balls[i], after[i], after[i])


def _turn_rows(worlds: Any, balls: Any, after: Any, q: Any) -> None:
    """Turn every orientation (N, 4) by what its ball turns in its time."""
    world = worlds[0]
    for i in range(balls.shape[0]):
        ball = balls[i]
        v, w = vector(ball.v), vector(ball.w)
        old = (q[i, 0], q[i, 1], q[i, 2], q[i, 3])
        if ball.phase == BOUNCING:
            new = turned_bouncing(
                old, v, w, ball.radius, ball.kappa, world.g, world.floor_form, vector(world.floor_p),
                world.floor_mu, world.floor_beta, after[i],
            )  # fmt: skip
        else:
            _acc, turn, _lasts = pace_of(world, ball)
            new = turned(old, w, turn, after[i])
        q[i, 0], q[i, 1], q[i, 2], q[i, 3] = new


@functools.cache
def _compiled(loop: Callable[..., None]) -> Callable[..., None]:
    from carom.compiled import njit

    return njit(loop)


def _run(loop: Callable[..., None], world: Any, balls: Any, *rest: Any) -> None:
    if balls.shape[0] >= FEW:
        _compiled(loop)(world, balls, *rest)
    else:  # records with their fields as attributes, which compiled code has by itself
        with np.errstate(all="ignore"):
            loop(world.view(np.recarray), balls.view(np.recarray), *rest)


def _rows(balls: Any, which: Any, log: Any) -> Any:
    """Balls as a log's rows left them."""
    rows = balls[which].copy()
    for field in ("x", "v", "w", "phase"):
        rows[field] = log[field]
    rows["clock"] = 0
    return rows


def states(world: Any, balls: Any, log: Any, after: Array) -> tuple[Array, Array, Array, Any]:
    """Position, velocity, spin (N, 3) and phase (N,), each a time ``after`` (N,) its row of the log.

    NaN where the ball is no longer followed.
    """
    rows = _rows(balls, log["ball"], log)
    gone = (rows["phase"] >= HELD) & (after > 0)
    _run(_state_rows, world, rows, np.where(gone, 0.0, after))
    for field in ("x", "v", "w"):
        rows[field][gone] = np.nan
    return rows["x"], rows["v"], rows["w"], rows["phase"]


def orientations(world: Any, balls: Any, log: Any, after: Array, q: Array) -> Array:
    """Quaternions (N, 4) a time ``after`` (N,) each row of the log, which left the ball turned by q (N, 4)."""
    rows = _rows(balls, log["ball"], log)
    q = np.array(q)
    _run(_turn_rows, world, rows, np.where(rows["phase"] >= HELD, 0.0, after), q)
    return q
