"""Find which of many initial states overlap a wall, the floor, or each other."""

from __future__ import annotations

import functools
from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import NDArray

from carom.core.geometry.features import OVER, gap_to_feature
from carom.core.jit.kernel import vector
from carom.core.jit.slices import row_slices
from carom.scene.scene_rules import BALLS_TOUCH, TOUCH
from carom.simulation.setup import SceneArrays

__all__ = ["overlapping"]


def _overlaps(worlds: Any, features: Any, balls: Any, bad: Any) -> None:
    for n in range(balls.shape[0]):
        for i in range(balls.shape[1]):
            ball = balls[n, i]
            x, a = vector(ball.x), ball.radius
            if worlds[0].floor != 0 and x[2] < a * (1 - TOUCH):
                bad[n] = True
            for f in range(features.shape[0]):
                # (a gap below -a: the ball is behind a face, which may be the back of another)
                if features[f].kind != OVER and -a < gap_to_feature(features[f], a, x) < -TOUCH * a:
                    bad[n] = True
            for k in range(i):
                other = balls[n, k]
                reach = a + other.radius - BALLS_TOUCH * min(a, other.radius)
                r = (x[0] - other.x[0], x[1] - other.x[1], x[2] - other.x[2])
                if r[0] * r[0] + r[1] * r[1] + r[2] * r[2] < reach * reach:
                    bad[n] = True


@functools.cache
def _compiled() -> Callable[..., None]:
    from carom.core.jit.compile import njit

    return njit(_overlaps)


def overlapping(setup: SceneArrays, balls: NDArray[np.void]) -> NDArray[np.bool_]:
    """Return (N,) which of the initial states ``balls`` (N, B) overlap a wall, the floor, or each other, by more than touches."""
    bad = np.zeros(len(balls), dtype=bool)
    check = _compiled()
    for rows in row_slices(len(balls), 1024):
        check(setup.world, setup.features, balls[rows], bad[rows])
    return bad
