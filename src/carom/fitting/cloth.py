"""An error that all rows of a film share: velocities after a cushion hang on the friction of the cloth, which is measured once.

A table that carom makes of a film says in columns cloth_v_n_in ... cloth_v_t_out how far each velocity would move if that friction
was one of its error bars larger. Rows by themselves then have what is left of their error bars, and the cloth is one more number
and one more datum: z, normal with width 1, which moves all rows at once. A law is fitted with z where it likes it best, and its
numbers are told as z is.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from carom.fitting.data import Problem
from carom.fitting.ways import Fit, Ways, go

__all__ = ["best_shift", "with_cloth"]

Array = NDArray[np.float64]
LOOKS = 60
FURTHEST = 5.0  # error bars of the cloth: beyond, a parabola that was seen at 1 says little


def moved(problem: Problem, z: float) -> Problem:
    """The rows with z error bars more of that."""
    assert problem.cloth is not None
    change = z * problem.cloth
    return replace(problem, x=problem.x - change[:, :3], y=problem.y - change[:, 3:])


def best_shift(ways: Ways, problem: Problem, p: Array) -> tuple[Problem, float, Array, float]:
    """Near the best numbers p (K,): the rows with z where the law likes it best, z^2, by how much each free number follows z, and
    the variance of z."""
    ends = [go(ways, moved(problem, z), p[None], LOOKS) for z in (-1.0, 0.0, 1.0)]
    low, middle, high = (float(end[1][0]) + z * z for end, z in zip(ends, (-1.0, 0.0, 1.0), strict=True))
    slope, curve = (high - low) / 2, max(high + low - 2 * middle, 2.0)  # of the deviance; its own z^2 makes 2
    z = float(np.clip(-slope / curve, -FURTHEST, FURTHEST))
    follows = (ends[2][0][0, ways.free] - ends[0][0][0, ways.free]) / 2
    return moved(problem, z), z * z, follows, 2 / curve


def with_cloth(fit: Fit, follows: Array, variance: float) -> Fit:
    """The fit with error bars to which that of the cloth is added."""
    covariance = fit.covariance + variance * np.outer(follows, follows)
    estimates = dict(fit.estimates)
    for i, name in enumerate(fit.names):
        if estimates[name].stderr:
            estimates[name] = replace(estimates[name], stderr=float(np.sqrt(covariance[i, i])))
    return replace(fit, covariance=covariance, estimates=estimates)
