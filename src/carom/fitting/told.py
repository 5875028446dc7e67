"""What the data tell of a law's numbers: covariance, and the numbers and combinations of them that nothing depends on."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from carom.fitting.parameters import INDEX, NUMBERS, Parameter
from carom.fitting.ways import Estimate, Fit, Ways, parameters_of, predict_law, refit, rows_of_fit

__all__ = ["bent", "with_errors"]

Array = NDArray[np.float64]
BENT, MANY = 0.3, 0.06  # of an error bar, by which a row's law bends; of the rows
BLIND = 0.5  # a standard error of so much of a parameter's range, or of 1, tells nothing
FAR = (5.0, 50.0)  # error bars from the best place, where is looked whether the deviance has risen
NO_RISE = 6.63  # of the deviance: 99 % of one number
ONE_SIDE = 2.706  # 95 % of one number on one side
NEAR = 1.5  # error bars: a bound that is nearer is no place to look from
GIVE_BACK = ("tangential_restitution", "stiffness_ratio")
MADE_UP = 2.0  # times as much would a number be told, were the others known: they make up for it
SHARE = 0.3  # of a direction that the data do not tell: a parameter with more of it is concerned


def with_errors(fit: Fit, ways: Ways, parameters: list[Parameter], info: Array) -> Fit:
    """Covariance, and what the data do not tell."""
    k = len(fit.names)
    values = fit.numbers[ways.free]
    # (of a number that may be anything up to 100, such as a speed, its own size says what is little)
    ranges = np.array([
        min(p.high - p.low, max(abs(v), 1.0)) for v, p in zip(values.tolist(), parameters, strict=True)
    ])  # fmt: skip
    close = 1e-9 * ranges
    bound = np.array(
        [v <= p.low + c or v >= p.high - c for v, p, c in zip(values, parameters, close, strict=True)], dtype=bool
    )
    inside = np.flatnonzero(~bound)
    covariance = np.full((k, k), np.nan)
    untold: list[str] = []
    sentences: list[str] = []
    if k:
        strength, direction, inner = _directions(info, ranges)
        bars = np.sqrt(np.diag(inner)) / ranges
        concerned = np.zeros(k, bool)
        for column in direction[:, ~(strength > 1 / BLIND**2)].T:
            # it goes along by its share, or by more than its own error bar
            which = (np.abs(column) > SHARE) | (np.abs(column) * BLIND > np.maximum(bars, 1e-3))
            if fit.problem.spins is not None:
                i = int(np.argmax(np.abs(column)))
                which |= _moved(fit, ways, parameters, i, BLIND * ranges[i], np.inf, bars * ranges)
            concerned |= which
            sentences.append(_sentence(fit, [fit.names[i] for i in np.flatnonzero(which)]))
        if fit.problem.spins is not None:
            for together in _made_up(fit, ways, parameters, info, ranges, inside[~concerned[inside]]):
                concerned |= together
                sentences.append(_sentence(fit, [fit.names[i] for i in np.flatnonzero(together)]))
        untold = [fit.names[i] for i in np.flatnonzero(concerned)]
        inside = inside[~concerned[inside]]
    if len(inside):
        _strength, _direction, inner = _directions(info[np.ix_(inside, inside)], ranges[inside])
        covariance[np.ix_(inside, inside)] = inner
        for i in inside.tolist():
            if fit.names[i] in untold:
                continue
            flat = _flat(fit, fit.names[i], int(ways.free[i]), parameters[i], math.sqrt(covariance[i, i]))
            if flat:
                sentences.append(f"{fit.law.name}: {fit.names[i]}: {flat}")
                along = np.zeros(k, bool)
                if fit.problem.spins is not None:
                    own = np.sqrt(np.diag(covariance))
                    along = _moved(fit, ways, parameters, i, BLIND * ranges[i], np.inf, np.nan_to_num(own, nan=np.inf))
                along[i] = True
                if along.sum() > 1:
                    sentences[-1] = _sentence(fit, [fit.names[j] for j in np.flatnonzero(along)])
                untold += [fit.names[j] for j in np.flatnonzero(along) if fit.names[j] not in untold]
                covariance[along, :] = covariance[:, along] = np.nan
    estimates = {}
    for i, (name, parameter) in enumerate(zip(fit.names, parameters, strict=True)):
        if name in untold:
            estimates[name] = Estimate(None, None, "the data do not tell it")
        elif bound[i]:
            what = "least" if values[i] <= parameter.low + close[i] else "most"
            estimates[name] = Estimate(float(values[i]), None, f"at the {what} that it may be, {values[i]:g}")
        else:
            estimates[name] = Estimate(float(values[i]), float(math.sqrt(covariance[i, i])))
    return replace(
        fit,
        covariance=covariance,
        estimates=estimates,
        degenerate=tuple(dict.fromkeys(sentences)),
        untold=tuple(untold),
    )


def bent(fit: Fit) -> str:
    """A warning where the law bends within the error bars before the wall in many rows, or nothing.

    What a row tells is taken from the law's slopes where it was measured. If one error bar to one side it sticks and to the other
    it slides, these say little of where it really was, and of how well the row tells a number. Nor do profiles or the bootstrap.
    """
    problem, p = fit.problem, fit.numbers
    if problem.estimated.any() or not problem.vx.any():
        return ""
    here = fit.predicted()
    wide, turn = problem.vy.copy(), np.zeros(problem.y.shape)
    for o in range(3):
        step = np.zeros(3)
        bar = np.sqrt(problem.vx[:, o])[:, None]
        step[o] = 1.0
        up, down = (predict_law(fit.law, replace(problem, x=problem.x + sign * bar * step), p) for sign in (1, -1))
        wide += np.square((up - down) / 2)
        turn = np.maximum(turn, np.abs(up + down - 2 * here))
    seen = np.isfinite(problem.y)
    share = np.where(seen, turn / np.sqrt(np.where(seen, wide, 1.0)), 0.0).max(axis=1, initial=0.0)
    many = int((share > BENT).sum())
    if many < MANY * len(share):
        return ""
    return (
        f"error bars before the wall: in {many} of {len(share)} rows they reach from sticking to sliding under {fit.law.name};"
        " what is said to hold at 95 % does so at some 80 to 85 % then, bootstrap and profiles too; measure better before the wall"
    )


def _directions(info: Array, ranges: Array) -> tuple[Array, Array, Array]:
    """Information in directions of the scaled numbers, the directions, and the covariance of those that are told."""
    strength, direction = np.linalg.eigh(info * np.outer(ranges, ranges))
    told = strength > 1 / BLIND**2
    good = direction[:, told] / np.sqrt(strength[told])
    return strength, direction, good @ good.T * np.outer(ranges, ranges)


def _made_up(
    fit: Fit, ways: Ways, parameters: list[Parameter], info: Array, ranges: Array, inside: NDArray[np.int64]
) -> Iterator[NDArray[np.bool_]]:
    """Numbers that make up for each other, where spins are averaged over: a curvature that differs between creases may say that
    they are told. So the one that others make up for most is held five error bars away, and the others fitted anew."""
    while len(inside):
        block, bars = info[np.ix_(inside, inside)], np.zeros(len(ranges))
        bars[inside] = np.sqrt(np.diag(_directions(block, ranges[inside])[2]))
        times = np.diag(block) * bars[inside] ** 2
        i = int(inside[int(np.argmax(times))])
        if times.max() < MADE_UP:
            # what slip gives back and what spins there were are one, whatever the curvature at a crease says
            i = next((int(j) for j in inside if fit.names[j] in GIVE_BACK), -1)
            if i < 0:
                return
        together = _moved(fit, ways, parameters, i, FAR[0] * float(bars[i]), bars[i], bars)
        together &= bars > 0
        if not together.any():
            return
        yield together
        inside = inside[~together[inside]]


def _moved(
    fit: Fit, ways: Ways, parameters: list[Parameter], i: int, step: float, bar: float, bars: Array
) -> NDArray[np.bool_]:
    """(k,) number i, and those that move by more than their error bars when it is held a step away and all are fitted anew; none
    where the deviance rises by a quarter of what its own error bar says, or by 99 % if it has none."""
    place = ways.free[i]
    p = np.tile(fit.numbers, (2, 1))
    p[:, place] = np.clip(p[:, place] + step * np.array([-1, 1]), parameters[i].low, parameters[i].high)
    far = np.abs(p[:, place] - fit.numbers[place])
    some = far > max(NEAR * bar if bar < np.inf else 0.0, step / 4)
    none = np.zeros(len(bars), bool)
    if not some.any():
        return none
    found, deviance = refit(fit, fit.problem, p=p[some], hold=fit.names[i])
    short = deviance - fit.deviance - (np.square(far[some] / bar) / 4 if bar < np.inf else NO_RISE)
    if not (short < 0).any():
        return none
    best = found[int(np.argmin(short))]
    moved = np.abs(best[ways.free] - fit.numbers[ways.free]) > np.maximum(bars, 1e-9)
    moved[i] = True
    return moved  # type: ignore[no-any-return]


def _flat(fit: Fit, name: str, place: int, parameter: Parameter, stderr: float) -> str:
    """What to say where the deviance does not rise on one side, though the curvature at the best place says that it should.

    So it is where the last row that tells a number stands just at the edge between sticking and sliding. Five error bars away it
    should have risen by 25; where it has not by half of that, the rest is fitted anew, there and ten times as far.
    """
    base = float(rows_of_fit(fit, fit.problem, fit.numbers)[0].sum())
    best, shared = float(fit.numbers[place]), float(np.square(fit.numbers[NUMBERS:]).sum())
    for sign, word in ((1, "more"), (-1, "less")):
        p = np.tile(fit.numbers, (2, 1))
        p[:, place] = np.clip(best + sign * stderr * np.array(FAR), parameter.low, parameter.high)
        if abs(p[0, place] - best) < 0.8 * FAR[0] * stderr:
            continue  # the bound is near
        near = float(rows_of_fit(fit, fit.problem, p[0])[0].sum()) - base
        if near < FAR[0] ** 2 / 2 and (refit(fit, fit.problem, p=p, hold=name)[1] - base - shared < NO_RISE).all():
            end = _last(fit, place, -sign, base)
            said = f"what lies beyond {best:.3g} fits nearly as well"
            return f"{said}: {end:.3g} or {word} (95 %) is all that can be told"
    return ""


def _sentence(fit: Fit, names: list[str]) -> str:
    """What there is to say of numbers that the data do not tell."""
    said = f"{fit.law.name}: {' and '.join(names)}: "
    values = {name: float(fit.numbers[parameters_of(fit.law, fit.problem)[0][name][0]]) for name in fit.names}
    if names == ["friction"]:
        return said + "no row slides all the way, so only a least friction can be told" + _least_friction(fit)
    if names in (["tangential_restitution"], ["stiffness_ratio"]):
        return said + "every row slides all the way through the contact, so nothing depends on it; film steeper hits"
    if names in (["restitution", "friction"], ["friction", "restitution"]):
        product = values["friction"] * (1 + values["restitution"])
        return said + f"sliding contacts tell only friction (1 + restitution) = {product:.4g}, not each by itself"
    if len(names) > 1:
        return (
            said
            + "the data tell only a combination of them, no single value; measure more (spin, other angles) or fix one"
        )
    return said + "next to nothing in these rows depends on it"


def _least_friction(fit: Fit) -> str:
    """The friction below which the law is worse by 2.7 (95 %, one side), with the rest where it is."""
    base = float(rows_of_fit(fit, fit.problem, fit.numbers)[0].sum())
    return f": {_last(fit, INDEX['friction'], -1, base):.3g} or more (95 %)"


def _last(fit: Fit, place: int, sign: int, base: float) -> float:
    """How far down (or up) a number may be until the law is worse by what 95 % allow on one side, the rest where it is."""
    parameter = next(one for where, one in parameters_of(fit.law, fit.problem)[0].values() if where == place)
    inside, outside = float(fit.numbers[place]), parameter.low if sign < 0 else parameter.high
    for _ in range(30):
        p = fit.numbers.copy()
        p[place] = middle = (inside + outside) / 2
        rise = float(rows_of_fit(fit, fit.problem, p)[0].sum()) - base
        inside, outside = (inside, middle) if rise >= ONE_SIDE else (middle, outside)
    return (inside + outside) / 2
