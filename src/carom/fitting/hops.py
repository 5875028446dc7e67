"""Hops of a rolling ball at a vertical wall, which films from above do not show, and what they do to velocities measured there."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from carom.fitting.data import Problem
from carom.fitting.result import Fit

__all__ = ["hop_note", "hop_speeds"]

Array = NDArray[np.float64]
GRAVITY = 9.80665  # m/s^2
UPRIGHT = 1.05  # radii: a wall that touches the ball higher presses it down
MIN_ERRORS, MIN_SHARE = 1.0, 0.01  # of v_n_out: error bars, and share of it, that a hop has to change to be noted


def hop_speeds(problem: Problem, restitution: float, friction: float) -> Array:
    """Return the upward speed (N,), m/s, with which rolling balls leave a vertical wall with Coulomb friction.

    The front of a ball that rolls toward the wall moves down at its speed v_n, so the friction pushes the ball up. A spin that was
    not measured counts as none.
    """
    v_n, v_t = problem.x[:, 0], problem.x[:, 1]
    down = problem.setting.roll * v_n
    slip = np.hypot(v_t - problem.setting.radius * np.nan_to_num(problem.x[:, 2]), down)
    kappa = problem.setting.kappa
    impulse = np.minimum(friction * (1 + restitution) * v_n, slip * kappa / (1 + kappa))
    return np.asarray(np.divide(impulse * down, slip, out=np.zeros_like(slip), where=slip > 0))


def hop_note(best: Fit) -> str:
    """Return a note where balls measured in a film, as they leave an upright wall, hop by more than their error bars allow for.

    A film from above is fitted as if the ball slid on the floor at once. A ball that hops loses speed only when it lands, by the
    floor's friction times its vertical speed, so that v_n just after the wall comes out too large by that much.
    """
    problem = best.problem
    rebounds, setting = problem.rebounds, problem.setting
    friction, restitution = (best.estimates.get(name) for name in ("friction", "restitution"))
    upright = setting.contact_height <= UPRIGHT and "contact_height" not in best.estimates
    if rebounds.kind != "table" or "cloth_friction" not in rebounds.extra or not upright:
        return ""
    if friction is None or friction.value is None:
        return ""
    e = restitution.value if restitution is not None and restitution.value is not None else 1.0
    up = hop_speeds(problem, e, friction.value)
    change, error = (setting.floor_friction or 0.0) * up, np.sqrt(problem.vy[:, 0])
    rows = (
        (rebounds.stage == "after_wall")
        & (change > MIN_ERRORS * error)
        & (change > MIN_SHARE * np.nan_to_num(problem.y[:, 0], nan=math.inf))
    )
    if not rows.any():
        return ""
    return (
        f"hops: a wall that touches a rolling ball level with its centre pushes it up: with friction {friction.value:.2g} it hops,"
        f" up to {1e3 * float(up[rows].max()) ** 2 / 2 / GRAVITY:.2g} mm high. Films from above are measured as if it slid at once,"
        f" so v_n_out of {rows.sum()} rows after_wall may be too large, by up to {float(change[rows].max()):.2g} m/s, and the"
        " restitution with it: use the state in which it rolls again (--stage rolling, of carom tracks show or of tracks in carom"
        " fit). A cushion touches the ball higher: --contact-height"
    )
