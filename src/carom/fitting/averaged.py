"""Error bars where spins that nobody measured are averaged over: the curvature at the best place is not all there is to them.

The prior's width is the scatter of few spins, and what is likeliest is too small on average: of n normal numbers about a mean
that is fitted, with sum of squares S, it is the root of S/n, where that of S/(n - 3/2) is right on average (about a mean that is
given, n - 1/2). The friction is the edge of a scatter, and the deviance has a crease at each row that stands there: its curvature
between two creases is not how fast it rises across them.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from carom.fitting.parameters import INDEX
from carom.fitting.ways import Fit, go, scaled, ways_of

__all__ = ["with_averaged", "with_profile"]

Array = NDArray[np.float64]
ROUNDS, FAR_ROUNDS, LOOKS = 4, 8, 40
SMALL = 0.02  # of a friction, from where a width that is not known is sought


def with_averaged(fit: Fit, extra: float = 0.0) -> Fit:
    """The fit with such error bars, and a width that is right on average; ``fit.numbers`` stay what is likeliest.

    ``extra``: the part of the deviance that is not the rows'.
    """
    fit = _with_width(fit)
    width = _friction(fit, fit.deviance - extra)
    return fit if width is None else scaled(fit, "friction", width / _stderr(fit, "friction"))


def _stderr(fit: Fit, name: str) -> float:
    estimate = fit.estimates.get(name)
    return (estimate.stderr or 0.0) if estimate else 0.0


def _with_width(fit: Fit) -> Fit:
    """A relative error of 1/sqrt(2n) says how many rows tell the width: 3/2 times its square is what is missing. The mean's error
    bar is that width over the root of n, and lacks as much."""
    error = _stderr(fit, "spin_width")
    if not error:
        return fit
    width = float(fit.numbers[INDEX["spin_width"]])
    by = 1 + (1.5 if "spin_mean" in fit.names else 0.5) * (error / width) ** 2
    fit = scaled(fit, "spin_width", by)
    if _stderr(fit, "spin_mean"):
        fit = scaled(fit, "spin_mean", by)
    estimates = fit.estimates | {"spin_width": replace(fit.estimates["spin_width"], value=by * width)}
    return replace(fit, estimates=estimates)


def with_profile(fit: Fit, info: Array, extra: float = 0.0) -> Array:
    """The information with as much of the friction as its profile has, where the deviance rises by 1 on both sides; else as it is.

    Where a row stands at a crease just at the best place, the curvature there may say that nothing tells the friction.
    """
    place = fit.names.index("friction")
    best = float(fit.numbers[INDEX["friction"]])
    far, rise = _ends(fit, fit.deviance - extra, SMALL * max(best, SMALL), FAR_ROUNDS)
    if (np.abs(rise - 1) > 0.3).any():
        return info
    rest = np.delete(np.arange(len(info)), place)
    through = info[place, rest] @ np.linalg.pinv(info[np.ix_(rest, rest)], hermitian=True) @ info[rest, place]
    info = info.copy()
    info[place, place] = through + ((far[1] - far[0]) / 2) ** -2
    return info


def _friction(fit: Fit, base: float) -> float | None:
    """Half the width in which the deviance, all else fitted, rises by less than 1."""
    step = _stderr(fit, "friction")
    if not step:
        return None
    far, _rise = _ends(fit, base, step, ROUNDS)
    return float((far[1] - far[0]) / 2)


def _ends(fit: Fit, base: float, step: float, rounds: int) -> tuple[Array, Array]:
    """How far from the best friction, below and above, the deviance has risen by 1, all else fitted, sought from a step away; and
    the roots of its rise there, which are 1 but where a bound is in the way."""
    ways, names, _start, parameters = ways_of(fit.law, fit.problem)
    place, parameter = INDEX["friction"], parameters[names.index("friction")]
    held = replace(ways, free=ways.free[ways.free != place])
    best = float(fit.numbers[place])
    p, far = np.tile(fit.numbers, (2, 1)), np.array([-step, step])
    rise = np.zeros(2)
    for _ in range(rounds):
        p[:, place] = np.clip(best + far, parameter.low, parameter.high)
        p, deviance, _u, _h = go(held, fit.problem, p, LOOKS)
        # nearly a parabola: the next place follows from it
        rise = np.sqrt(np.maximum(deviance - base, 1e-3))
        if (np.abs(rise - 1) < 0.02).all():
            break
        far = np.clip(best + far / np.clip(rise, 0.4, 2.5), parameter.low, parameter.high) - best
    return far, rise
