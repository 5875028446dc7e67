"""What whole tracks tell of a law's shared numbers: error bars, and the combinations that nothing depends on."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from carom.fitting.told import BLIND, SHARE
from carom.fitting.ways import Estimate
from carom.fitting.whole_descent import Settled, projected, settle, shared_slope

if TYPE_CHECKING:
    from carom.fitting.whole import WholeFit

__all__ = ["TOO_SMALL", "or_else", "with_errors"]

Array = NDArray[np.float64]
EDGE = 1e-4  # of its range: a number so near its bound is at it
FLAT = 5.0  # of chi^2, five error bars away, where 25 is due
TOO_SMALL = "error bar too small: the law does not follow the frames"
SPARE = 4  # shots more than numbers, from which on the shots' own scatter makes the error bars


def with_errors(fit: WholeFit, settled: Settled) -> WholeFit:
    """Covariance, estimates, and what the data do not tell.

    Where the law follows the frames, from the slopes and the noise, with all starts free. Where it does not, what it leaves over
    goes on from frame to frame, and frames are no independent witnesses: shots are, and the error bars are from how they
    scatter (White, Econometrica 48, 817 (1980), by shot).
    """
    names = list(fit.law.free)
    if not names:
        return fit
    gaps, known = projected(settled, fit.starts, shared_slope(fit.law, fit.frames, settled.q, fit.numbers))
    low = np.array([fit.law.free[name].low for name in names])
    high = np.array([fit.law.free[name].high for name in names])
    ranges = np.minimum(high - low, 1.0)
    values = np.array([fit.numbers[name] for name in names])
    bound = (values - low < EDGE * ranges) | (high - values < EDGE * ranges)
    info = np.einsum("ntp,ntq->pq", gaps, gaps) + np.einsum("nkp,nkq->pq", known, known)
    strength, direction = np.linalg.eigh(info * np.outer(ranges, ranges))
    weak = ~(strength > 1 / BLIND**2)
    concerned = np.zeros(len(names), bool)
    sentences = []
    for column in direction[:, weak].T:
        which = np.abs(column) > SHARE
        concerned |= which
        sentences.append(_sentence(fit, [names[i] for i in np.flatnonzero(which)]))
    inside = np.flatnonzero(~concerned & ~bound)
    covariance = np.full((len(names), len(names)), np.nan)
    by_shots = False
    if len(inside):
        inverse = np.linalg.inv(info[np.ix_(inside, inside)])
        shots = _scores(fit, settled, gaps, known)[:, inside]
        by_shots = not fit.follows and len(shots) >= len(inside) + SPARE
        if by_shots:
            inverse = inverse @ (shots.T @ shots) @ inverse * len(shots) / (len(shots) - len(inside))
        covariance[np.ix_(inside, inside)] = inverse
    for i in inside.tolist():
        flat = _flat(fit, names[i], math.sqrt(covariance[i, i]), fit.chi2)
        if flat:
            concerned[i] = True
            covariance[i, :] = covariance[:, i] = np.nan
            sentences.append(flat)
    estimates = {}
    for i, name in enumerate(names):
        if concerned[i]:
            estimates[name] = Estimate(None, None, "the data do not tell it")
        elif bound[i]:
            what = "least" if values[i] - low[i] < EDGE * ranges[i] else "most"
            edge = low[i] if what == "least" else high[i]
            estimates[name] = Estimate(float(edge), None, f"at the {what} that it may be, {edge:g}")
        else:
            note = "" if fit.follows or by_shots else TOO_SMALL
            estimates[name] = Estimate(float(values[i]), float(math.sqrt(covariance[i, i])), note)
    untold = tuple(names[i] for i in np.flatnonzero(concerned))
    return replace(
        fit, covariance=covariance, estimates=estimates, degenerate=tuple(dict.fromkeys(sentences)), untold=untold
    )


def or_else(fit: WholeFit, name: str, other: float) -> WholeFit:
    """The fit without a number for what has two that fit alike."""
    here = fit.numbers[name]
    said = (
        f"{fit.law.name}: {name}: {min(here, other):.4g} and {max(here, other):.4g} fit alike: a contact stands at the edge between"
        " sliding and holding; film another shot"
    )
    covariance = fit.covariance.copy()
    i = list(fit.law.free).index(name)
    covariance[i, :] = covariance[:, i] = np.nan
    estimates = fit.estimates | {name: Estimate(None, None, "the data do not tell it")}
    return replace(
        fit, covariance=covariance, estimates=estimates, degenerate=(*fit.degenerate, said), untold=(*fit.untold, name)
    )


def _flat(fit: WholeFit, name: str, step: float, base: float) -> str:
    """What to say where nothing gets worse on one side, though the slopes at the best place say that it should.

    So it is where the last contact that slides is just at the edge of holding. ``step``: one standard error.
    """
    parameter, value = fit.law.free[name], fit.numbers[name]
    for sign, word in ((1, "more"), (-1, "less")):
        tried = min(max(value + sign * 5 * step, parameter.low), parameter.high)
        if abs(tried - value) < 4 * step:
            continue
        scene = fit.law.scene({**fit.numbers, name: tried})
        if float(settle(scene, fit.frames, fit.starts, fit.q, 4).cost.sum()) < base + FLAT:
            if name == "friction" and sign > 0:
                return _sentence(fit, [name])
            return (
                f"{fit.law.name}: {name}: {value:.3g} or {word} is all that can be told; what lies beyond fits as well"
            )
    return ""


def _scores(fit: WholeFit, settled: Settled, gaps: Array, known: Array) -> Array:
    """(G, P): by shot, the slopes of half the sum of squares."""
    prior = np.sqrt(fit.starts.weight) * settled.q
    each = np.einsum("ntp,nt->np", gaps, settled.gap) + np.einsum("nkp,nk->np", known, prior)
    groups = [one.group or one.name for one in fit.frames.stretches]
    return np.array([each[[g == group for g in groups]].sum(axis=0) for group in dict.fromkeys(groups)])


def _sentence(fit: WholeFit, names: list[str]) -> str:
    """What there is to say of numbers that the data do not tell."""
    said = f"{fit.law.name}: {' and '.join(names)}: "
    if names == ["friction"]:
        return said + f"no contact slides all the way, so only a least friction can be told: about {_held(fit):.2g}"
    if names == ["tangential_restitution"]:
        return said + "every contact slides all the way through, so nothing depends on it; film steeper hits"
    if len(names) > 1:
        return (
            said
            + "the tracks tell only a combination of them, no single value; film other angles or speeds, or --fix one"
        )
    return said + "nothing in these tracks depends on it"


def _held(fit: WholeFit) -> float:
    """The largest friction that any contact needed to hold."""
    needed = [
        event.required_friction
        for n in range(len(fit.q))
        for event in fit.simulate(n).events.of("wall")
        if math.isfinite(event.required_friction)
    ]
    return max(needed, default=0.0)
