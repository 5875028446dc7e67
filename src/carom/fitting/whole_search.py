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


def fit_law_whole(law: WholeLaw, found: Sequence[Stretch], noise: float, tell: Callable[[float], None]) -> WholeFit:
    """Fit one law to stretches; ``noise`` (m) of one coordinate of one frame; ``tell`` how much is done."""
    frames = Frames.of(found, law.setting.noise or noise)

    def part(turn: int, done: float) -> None:
        tell((turn + done) / (2 + len(AGAIN)))

    best = fit_once(law, frames, law.setting, noise, partial(part, 0))
    if "friction" not in law.free:
        return best
    best, others = _across(law, best, noise)
    parameter = law.free["friction"]
    for turn, friction in enumerate(AGAIN, 2):
        if best.follows:
            break
        inside = replace(parameter, start=min(max(friction, parameter.low), parameter.high))
        begun = replace(law, free=law.free | {"friction": inside})
        other = fit_once(begun, frames, law.setting, noise, partial(part, turn))
        if other.deviance < best.deviance:
            best, others = _across(law, other, noise)
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
        # a parabola about the best place would be so high there; what is half as high belongs to another valley
        error = best.estimates["friction"].stderr or math.inf
        held = [
            one
            for one in held
            if not best.follows or one[0] < best.chi2 + ((one[1]["friction"] - here) / error) ** 2 / 2
        ]
        held = sorted(held, key=lambda one: one[0])[:FREED]
        others = [ended(law, best.frames, best.starts, q, numbers, noise, _silent) for _cost, numbers, q in held]
        seen = [(numbers["friction"], cost) for cost, numbers, _q in held]
        seen += [(fit.numbers["friction"], fit.chi2) for fit in others]
        nearest = min([best, *others], key=lambda fit: fit.deviance)
        gained, best = best.deviance - nearest.deviance, nearest
        if gained < max(1.0, 1e-3 * abs(best.deviance)):
            break
    return best, seen


def _held(law: WholeLaw, best: WholeFit, friction: float, numbers: Numbers) -> tuple[float, Numbers, np.ndarray]:
    """Chi^2, numbers and starts with a friction held and all else following."""
    parameter = law.free["friction"]
    friction = min(max(friction, parameter.low), parameter.high)
    free = {name: one for name, one in law.free.items() if name != "friction"}
    held = replace(law, free=free, held=law.held | {"friction": friction})
    others = {name: numbers[name] for name in free}
    q = sided(held, best.frames, best.starts, best.q, others, law.setting)
    others, settled = descend(held, best.frames, best.starts, q, others, _silent, exact=False)
    return float(settled.cost.sum()), {name: (others | {"friction": friction})[name] for name in law.free}, settled.q


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
    far = np.array([-step, step])
    for _ in range(ROUNDS):
        rises = []
        for one in (here + far).tolist():
            free = {name: one for name, one in law.free.items() if name != "friction"}
            held = replace(law, free=free, held=law.held | {"friction": one})
            numbers = {name: best.numbers[name] for name in free}
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
