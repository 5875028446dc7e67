"""The best place of one law for whole tracks: the search, what lies across the creases about it, and how far friction is told.

A contact that changes between sliding and holding makes a crease in the deviance, and a search that is on the wrong side of one
stays there: with a wrong friction, for which sidespins and walls make up. So other frictions are held until all else has followed
them, and freed where that leads lower.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import replace
from functools import partial

import numpy as np

from carom.errors import CaromError
from carom.fitting.whole import WholeFit, ended, fit_once, sided
from carom.fitting.whole_descent import Frames, Numbers, descend
from carom.fitting.whole_laws import WholeLaw
from carom.fitting.whole_runs import Stretch
from carom.fitting.whole_told import or_else

__all__ = ["fit_law_whole"]

NEAR = (0.7, 0.82, 0.91, 0.96, 0.98, 1.02, 1.04, 1.1, 1.2, 1.4)  # times a friction: others that are held
ALL = (0.1, 0.15, 0.2, 0.25, 0.3, 0.4)  # and where the law does not follow
ACROSS, FREED = 3, 3  # times at most; of those held, freed each time
AGAIN = (0.1, 0.3)  # frictions with which the search begins anew
ALIKE = 3.84  # of chi^2, by which another friction may be worse and still be as good (95 %)
APART = 3.0  # error bars, from where on it is another
ROUNDS = 3


_Held = tuple[float, Numbers, np.ndarray]
"""Chi^2, numbers and starts with a friction held."""


def fit_law_whole(law: WholeLaw, found: Sequence[Stretch], noise: float, tell: Callable[[float], None]) -> WholeFit:
    """Fit one law to stretches; ``noise`` (m) of one coordinate of one frame; ``tell`` how much is done."""
    frames = Frames.of(found, law.setting.noise or noise)

    def part(turn: int, done: float) -> None:
        tell((turn + done) / (2 + len(AGAIN)))

    best = fit_once(law, frames, noise, partial(part, 0))
    if "friction" not in law.free:
        return best
    parameter = law.free["friction"]
    for turn, friction in enumerate(AGAIN, 1):
        if best.follows:
            break
        inside = replace(parameter, start=min(max(friction, parameter.low), parameter.high))
        begun = replace(law, free=law.free | {"friction": inside})
        other = fit_once(begun, frames, noise, partial(part, turn))
        if other.deviance < best.deviance:
            best = other
    best, others = _across(law, replace(best, law=law), noise)
    return _friction_told(law, best, others) if best.follows else best


def _across(law: WholeLaw, best: WholeFit, noise: float) -> tuple[WholeFit, list[tuple[float, float]]]:
    """The best, or what lies beyond the creases about it; and other frictions, each with its chi^2, that were looked at last.

    Held are near frictions, from where the search is, and, where the law does not follow, all kinds of them with the walls where
    the tracks room has them.
    """
    walls = {name: one.start for name, one in law.free.items() if name.startswith("wall_")}
    seen: list[tuple[float, float]] = []
    for _ in range(ACROSS):
        here = best.numbers["friction"]
        tried = [(share * here, best.numbers) for share in NEAR]
        tried += [] if best.follows else [(friction, best.numbers | walls) for friction in ALL]
        held = [_held(law, best, friction, numbers) for friction, numbers in tried]
        freed = sorted(_elsewhere(best, held) if best.follows else held, key=lambda one: one[0])[:FREED]
        others = [ended(law, best.frames, best.starts, q, numbers, noise, _silent) for _cost, numbers, q in freed]
        seen = [(numbers["friction"], cost) for cost, numbers, _q in held]
        seen += [(fit.numbers["friction"], fit.chi2) for fit in others]
        nearest = min([best, *others], key=lambda fit: fit.deviance)
        gained, best = best.deviance - nearest.deviance, nearest
        if gained < max(1.0, 1e-3 * abs(best.deviance)):
            break
    return best, seen


def _elsewhere(best: WholeFit, held: Sequence[_Held]) -> list[_Held]:
    """Of those that are held: what is in another valley than the best.

    Along the friction, what is lower than its neighbours; and the lowest of each piece of the deviance in which other contacts
    slide: between creases it is smooth, and has one valley as a rule, which may be too narrow to show along the friction.
    """
    line = sorted([(best.chi2, best.numbers, best.q), *held], key=lambda one: one[1]["friction"])
    height = np.array([math.inf, *(one[0] for one in line), math.inf])
    low = (height[1:-1] < height[:-2]) & (height[1:-1] <= height[2:])
    pieces: dict[object, float] = {_slides(best): -math.inf, None: -math.inf}
    for one in line:
        piece = _slides(replace(best, numbers=one[1], q=one[2]))
        pieces[piece] = min(one[0], pieces.get(piece, math.inf))
    there = [one for one, is_low in zip(line, low, strict=True) if is_low or one[0] in pieces.values()]
    return [one for one in there if one[1] is not best.numbers]


def _slides(fit: WholeFit) -> tuple[tuple[str, ...], ...] | None:
    """Of the contacts of each stretch, whether they slide or hold; None where a start lies in a wall."""
    try:
        return tuple(tuple(event.regime for event in fit.simulate(n).events.of("wall")) for n in range(len(fit.q)))
    except CaromError:
        return None


def _held(law: WholeLaw, best: WholeFit, friction: float, numbers: Numbers) -> _Held:
    """Chi^2, numbers and starts with a friction held and all else following."""
    parameter = law.free["friction"]
    friction = min(max(friction, parameter.low), parameter.high)
    held = _holding(law, friction)
    others = {name: numbers[name] for name in held.free}
    q = sided(held, best.frames, best.starts, best.q, others)
    others, settled = descend(held, best.frames, best.starts, q, others, _silent, exact=False)
    return float(settled.cost.sum()), {name: (others | {"friction": friction})[name] for name in law.free}, settled.q


def _holding(law: WholeLaw, friction: float) -> WholeLaw:
    free = {name: one for name, one in law.free.items() if name != "friction"}
    return replace(law, free=free, held=law.held | {"friction": friction})


def _friction_told(law: WholeLaw, best: WholeFit, others: Sequence[tuple[float, float]]) -> WholeFit:
    """With the friction's error bar by profile likelihood: half the width in which chi^2, all else fitted, rises by less than 1;
    and no number where another friction, on the other side of a crease, does as well."""
    step = best.estimates["friction"].stderr
    if not step:
        return best
    here = best.numbers["friction"]
    alike = [one for one, chi2 in others if chi2 < best.chi2 + ALIKE and abs(one - here) > APART * step]
    if alike:
        return or_else(best, "friction", alike[0])
    parameter = law.free["friction"]
    far = np.clip(here + np.array([-step, step]), parameter.low, parameter.high) - here
    for _ in range(ROUNDS):
        rises = []
        for one in (here + far).tolist():
            held = _holding(law, one)
            numbers = {name: best.numbers[name] for name in held.free}
            numbers, settled = descend(held, best.frames, best.starts, best.q, numbers, _silent)
            rises.append(max(float(settled.cost.sum()) - best.chi2, 1e-3))
        rise = np.sqrt(rises)
        if (np.abs(rise - 1) < 0.05).all():
            break
        far = np.clip(here + far / np.clip(rise, 0.4, 2.5), parameter.low, parameter.high) - here
    by = float(far[1] - far[0]) / (2 * step)
    i, covariance = list(law.free).index("friction"), best.covariance.copy()
    covariance[i, :] *= by
    covariance[:, i] *= by
    wider = replace(best.estimates["friction"], stderr=by * step)
    return replace(best, covariance=covariance, estimates=best.estimates | {"friction": wider})


def _silent() -> None:
    """No one is told."""
