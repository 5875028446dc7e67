"""Profiles of a fit's parameters by many descents and a search without derivatives, and verdicts that they contradict."""

from __future__ import annotations

from typing import Any

import numpy as np
from scipy.optimize import minimize

from carom.fitting.laws import NUMBERS
from carom.fitting.model import model_of

RISE = 6.63  # chi^2 of one parameter, 99 %
DRAWN = 12  # random starts at each value
SHARES = (0.1, 0.25, 0.5, 1.0)  # of the distance to the outermost point


def size(parameter: Any, best: float) -> float:
    """The parameter's range, or its own size, at least 1."""
    return float(min(parameter.high - parameter.low, max(abs(best), 1.0)))


def least_deviance(model: Any, starts: np.ndarray) -> tuple[float, np.ndarray]:
    """The least deviance of descents from starts (B, K), continued by Nelder and Mead's search; and where it is."""
    found = model.minimize(starts)
    p, free = found.p[np.argmin(found.value)].copy(), model.free
    if not len(free):
        return float(found.value.min()), p
    low, high = model.low[free], model.high[free]

    def deviance(q: np.ndarray) -> float:
        p[free] = np.clip(q, low, high)
        return float(model.deviances(p[None])[0])

    ended = minimize(deviance, p[free], method="Nelder-Mead", options={"maxfev": 60 * len(free), "fatol": 0.01})
    p[free] = np.clip(ended.x, low, high)
    return min(float(ended.fun), float(found.value.min())), p


def profile(
    fit: Any, name: str, reach: float, seed: int = 0, shares: tuple[float, ...] = SHARES
) -> list[tuple[float, float]]:
    """(value, rise) of one parameter outwards to both sides, as far as a distance or its bound; none where that is near."""
    model = model_of(fit.law, fit.problem)
    place, parameter, held = model.places[name], model.parameters[name], model.holding(name)
    best, rng = float(fit.numbers[place]), np.random.default_rng(seed)
    base = least_deviance(model, fit.numbers[None])[0]
    points = []
    for sign in (-1, 1):
        here = fit.numbers
        far = float(np.clip(best + sign * reach, parameter.low, parameter.high))
        if abs(far - best) < reach / 4:
            continue
        for share in shares:
            starts = np.tile(fit.numbers, (DRAWN + 2, 1))
            starts[1] = here
            for i in held.free[held.free < NUMBERS]:
                low, high = held.low[i], held.high[i]
                span = min(high - low, 2 * max(abs(fit.numbers[i]), 1.0))
                starts[2:, i] = rng.uniform(max(low, fit.numbers[i] - span), min(high, fit.numbers[i] + span), DRAWN)
            starts[:, place] = best + share * (far - best)
            least, here = least_deviance(held, starts)
            points.append((float(starts[0, place]), least - base))
    return points


def ends(fit: Any, name: str, reach: float, seed: int = 0) -> list[tuple[float, float]]:
    """The outermost points of a profile."""
    return profile(fit, name, reach, seed)[len(SHARES) - 1 :: len(SHARES)]


def is_identified(fit: Any, name: str) -> tuple[bool, list[tuple[float, float]]]:
    """Whether the deviance rises at half the parameter's size to both sides, and, of a number that is never negative, by 1 at half
    of itself; and the points."""
    model = model_of(fit.law, fit.problem)
    parameter, best = model.parameters[name], float(fit.numbers[model.places[name]])
    found = ends(fit, name, size(parameter, best) / 2)
    rises = bool(found) and all(rise >= RISE for _value, rise in found)
    if rises and parameter.low >= 0 and best > parameter.low + 1e-9:
        rises = all(rise >= 1 for _value, rise in ends(fit, name, best / 2))
    return rises, found


def wrongly_untold(fit: Any) -> list[str]:
    """Parameters that are said to be not identifiable although the deviance rises on both sides, in words."""
    every = {name: is_identified(fit, name) for name in fit.untold}
    return [f"{fit.law.name}: {name}: {points}" for name, (identified, points) in every.items() if identified]
