"""Fit of one law to whole tracks: searches from several frictions, continued beyond kinks, and the friction's profile.

A contact that changes between sliding and sticking causes a kink in the deviance, and a search on its wrong side stays there,
with a wrong friction for which sidespins and walls compensate. So the friction is held at other values until all else has been
fitted, and freed if this lowers the deviance.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import replace
from functools import partial
from typing import NamedTuple

import numpy as np

from carom.errors import CaromError
from carom.fitting.optimizer import cross_kinks
from carom.fitting.profile_likelihood import LEVELS, half_width
from carom.fitting.result import scaled
from carom.fitting.tracks.errors import ambiguous, held_rises, with_errors
from carom.fitting.tracks.fit import SearchEnd, finish, fit_windows, with_best_sidespins
from carom.fitting.tracks.model import TrackModel
from carom.fitting.tracks.objective import Array, Numbers, SegmentArrays, descend
from carom.fitting.tracks.result import TrackFit
from carom.fitting.tracks.segments import TrackSegment

__all__ = ["fit_track_law"]

FREED = 6  # number of held frictions that are then freed: a narrow minimum can be higher than others at a held friction
NEW_STARTS = (0.1, 0.3)  # frictions from which the search is repeated
DISTINCT = 3.0  # error bars: frictions that fit equally well and differ by more are distinct


class _Held(NamedTuple):
    """A minimum with the friction held."""

    chi2: float
    numbers: Numbers
    q: Array


def fit_track_law(
    model: TrackModel, found: Sequence[TrackSegment], noise: float, tell: Callable[[float], None]
) -> TrackFit:
    """Fit one law to segments; ``noise`` (m) of one coordinate of one frame; ``tell`` is given the fraction done."""
    frames = SegmentArrays.of(found, model.setting.noise or noise)

    def part(turn: int, done: float) -> None:
        tell((turn + done) / (2 + len(NEW_STARTS)))

    best = fit_windows(model, frames, noise, partial(part, 0))
    if "friction" not in model.free:
        return with_errors(*best)
    parameter = model.free["friction"]
    for turn, friction in enumerate(NEW_STARTS, 1):
        if best.fit.follows:
            break
        inside = replace(parameter, value=min(max(friction, parameter.low), parameter.high))
        other = fit_windows(replace(model, free=model.free | {"friction": inside}), frames, noise, partial(part, turn))
        if other.fit.deviance < best.fit.deviance:
            best = other
    best, others = _across_kinks(model, best._replace(fit=replace(best.fit, model=model)), noise)
    fit = with_errors(*best)
    return _with_friction_profile(fit, others) if fit.follows or fit.design_effect > 1 else fit


def _across_kinks(model: TrackModel, best: SearchEnd, noise: float) -> tuple[SearchEnd, list[tuple[float, float]]]:
    """Continue the search beyond kinks. Return the best end, and other frictions, each with its chi^2, of the last round.

    Widely spread frictions are tried too, with the walls at the measured contacts: first, and again if the law does not follow the
    frames.
    """
    walls = {name: one.value for name, one in model.free.items() if name.startswith("wall_")}
    seen: list[tuple[float, float]] = []

    def explore(end: SearchEnd, nearby: list[float], everywhere: list[float]) -> SearchEnd:
        best = end.fit
        held = [_hold(model, best, friction, best.numbers) for friction in nearby]
        held += [_hold(model, best, friction, best.numbers | walls) for friction in everywhere]
        freed = sorted(_other_minima(best, held) if best.follows else held, key=lambda one: one.chi2)[:FREED]
        others = [finish(model, best.frames, best.starts, one.q, one.numbers, noise, lambda: None) for one in freed]
        seen[:] = [(one.numbers["friction"], one.chi2) for one in held]
        # (by deviance: each has scatters, and so a chi^2, of its own)
        seen.extend((fit.numbers["friction"], best.chi2 + fit.deviance - best.deviance) for fit, _settled in others)
        return min([end, *others], key=lambda one: one.fit.deviance)

    best = cross_kinks(
        best, lambda end: end.fit.numbers["friction"], lambda end: end.fit.deviance, explore,
        lambda end: not end.fit.follows,
    )  # fmt: skip
    return best, seen


def _other_minima(best: TrackFit, held: Sequence[_Held]) -> list[_Held]:
    """Return the minima with held friction that belong to a different minimum than the best.

    These are those lower than their neighbours along the friction, and the lowest of each piece of the deviance in which other
    contacts slide: between kinks it is smooth and usually has one minimum, which may be too narrow to appear along the friction.
    """
    line = sorted([_Held(best.chi2, best.numbers, best.q), *held], key=lambda one: one.numbers["friction"])
    height = np.array([math.inf, *(one.chi2 for one in line), math.inf])
    low = (height[1:-1] < height[:-2]) & (height[1:-1] <= height[2:])
    pieces: dict[object, float] = {_regimes(best): -math.inf, None: -math.inf}
    for one in line:
        piece = _regimes(replace(best, numbers=one.numbers, q=one.q))
        pieces[piece] = min(one.chi2, pieces.get(piece, math.inf))
    there = [one for one, is_low in zip(line, low, strict=True) if is_low or one.chi2 in pieces.values()]
    return [one for one in there if one.numbers is not best.numbers]


def _regimes(fit: TrackFit) -> tuple[tuple[str, ...], ...] | None:
    """Return whether the contacts of each segment slide or stick; None where a start lies in a wall."""
    try:
        return tuple(tuple(event.regime for event in fit.simulate(n).events.of("wall")) for n in range(len(fit.q)))
    except CaromError:
        return None


def _hold(model: TrackModel, best: TrackFit, friction: float, numbers: Numbers) -> _Held:
    """Return the minimum with a friction held and all else fitted."""
    parameter = model.free["friction"]
    friction = min(max(friction, parameter.low), parameter.high)
    held = model.holding("friction", friction)
    others = {name: numbers[name] for name in held.free}
    q = with_best_sidespins(held, best.frames, best.starts, best.q, others)
    others, settled = descend(held, best.frames, best.starts, q, others, lambda: None, exact=False)
    return _Held(
        float(settled.cost.sum()), {name: (others | {"friction": friction})[name] for name in model.free}, settled.q
    )


def _with_friction_profile(best: TrackFit, others: Sequence[tuple[float, float]]) -> TrackFit:
    """Return the fit with the friction's error bar by profile likelihood, as for rebounds with unmeasured spins; and without an
    estimate where another friction, beyond a kink, fits as well (95 %). Where the law does not follow the frames, chi^2 counts
    by its design effect: at a kink the derivatives say nothing of how far a friction may be off."""
    step = best.estimates["friction"].stderr
    if not step:
        return best
    here, parameter = best.numbers["friction"], best.model.free["friction"]
    alike = [one for one, chi2 in others if chi2 < best.chi2 + LEVELS[1] and abs(one - here) > DISTINCT * step]
    if alike and best.follows:
        return ambiguous(best, "friction", alike[0])

    def rises(values: Array, _which: object) -> Array:
        return held_rises(best, "friction", values)[0] / best.design_effect

    half, _rise = half_width(rises, here, step, parameter.low, parameter.high)
    found: TrackFit = scaled(best, "friction", half / step)
    return found
