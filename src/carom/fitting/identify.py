"""Errors of a law's parameters: covariance, combinations, profiles, fitted scatter, bootstrap, systematic errors.

Covariance of a law's parameters, and which of them, alone or in combination, the data do not identify.

The same code serves rebounds and whole tracks: each provides the information at the minimum, and the deviance where one parameter
is changed and the others are held or fitted again (:class:`Subject`).
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from typing import NamedTuple, Protocol

import numpy as np
from numpy.typing import NDArray

from carom.data.rebounds import Rebounds
from carom.fitting.laws import INDEX, Parameter
from carom.fitting.model import FitModel, feels_spins, model_of, predict_law
from carom.fitting.result import Estimate, Fit, refit, scaled, without_estimate, working_model
from carom.fitting.rows import Problem, make_problem

Array = NDArray[np.float64]
Mask = NDArray[np.bool_]
NOT_IDENTIFIABLE = "not identifiable from these data"
UNIDENTIFIED_STDERR = 0.5  # of a parameter's range, or of its size: with a larger standard error it is not identified
INVOLVED_SHARE = 0.3  # of an unidentified direction: a parameter with a larger component is involved
FAR = (5.0, 50.0)  # error bars from the minimum, where the deviance must have risen
FLAT_RISE = 6.63  # of the deviance, 99 % of one parameter: a profile that rises by less there is flat
ONE_SIDED = 2.706  # of the deviance: one-sided 95 % limit of one parameter
NEAR_BOUND = 1.5  # error bars: a parameter is not held at a bound that is nearer
COMPENSATED = (
    2.0  # ratio of a parameter's error bar to what it were with the others known, above which they compensate for it
)
SLIP_RETURN = ("tangential_restitution", "stiffness_ratio")
KINKED = ("friction", *SLIP_RETURN)  # numbers in which the deviance has kinks where spins are not measured
NEARER = 0.4  # of a step: 2 error bars where the step is 5
ALONG = np.array([-8.0, -4.0, -2.0, 2.0, 4.0, 8.0])  # steps along a valley
BISECTIONS = 20
OUTWARDS = 2.0 ** np.arange(-7, 1)  # of the distance to where a profile should have risen: where it is evaluated
STEEP = 100.0  # of the deviance: a side on which a profile has risen by so much is not followed any farther


class Subject(Protocol):
    """A fit at its minimum."""

    label: str
    names: tuple[str, ...]
    parameters: tuple[Parameter, ...]
    values: Array
    ranges: Array
    """Of each parameter: half of it is too large an error bar."""
    information: Array
    trade_offs: bool
    """Whether unmeasured spins may compensate for parameters, which has to be tested by fits."""

    def covariance(self, inside: NDArray[np.int64]) -> Array:
        """Return the covariance of some parameters."""

    def rise(self, i: int, value: float) -> float:
        """Return the rise of the deviance with parameter i at a value and the other parameters held."""

    def refit_rises(self, i: int, values: Array, start: Array | None = None) -> tuple[Array, Array]:
        """Return the rise of the deviance (m,) with parameter i held at values (m,) and all else fitted, and the parameters
        (m, k) there. The fits begin at the minimum, or at parameters ``start`` (m, k)."""


@dataclass(frozen=True, eq=False)
class Identified:
    """Covariance and estimates of a law's parameters, and the parameters that are not identifiable."""

    covariance: Array
    estimates: dict[str, Estimate]
    degenerate: tuple[str, ...]
    untold: tuple[str, ...]


def parameter_ranges(parameters: Sequence[Parameter], values: Array) -> Array:
    """Return each parameter's scale: its range, or for one with a wide range, such as a speed, its own size, at least 1."""
    ends = zip(values.tolist(), parameters, strict=True)
    return np.array([min(p.high - p.low, max(abs(v), 1.0)) for v, p in ends])


def identify(subject: Subject) -> Identified:
    """Compute covariance and estimates, and find the parameters that the data do not identify.

    A weak curvature, or parameters that compensate for each other near the minimum, only suggest that; the profile decides.
    """
    names, parameters, values = list(subject.names), subject.parameters, subject.values
    k, ranges = len(names), subject.ranges
    low, high = (np.array([getattr(p, end) for p in parameters]) for end in ("low", "high"))
    bound = (values <= low + 1e-9 * ranges) | (values >= high - 1e-9 * ranges)
    covariance, sentences, concerned = np.full((k, k), np.nan), [], np.zeros(k, bool)
    profiles = _Profiles(subject)

    def involve(which: Mask) -> None:
        which = which & np.array([bool(one) and not profiles.rises(i) for i, one in enumerate(which)])
        if which.any():
            concerned[which] = True
            sentences.append(_sentence(subject, profiles, [names[i] for i in np.flatnonzero(which)]))

    if k:
        # (directions among parameters without influence, even with all others known, are arbitrary: each is involved by itself)
        some = np.diag(subject.information) * ranges**2 > 1 / UNIDENTIFIED_STDERR**2
        some |= subject.trade_offs  # (fits tell which go together)
        for i in np.flatnonzero(~some).tolist():
            involve(np.arange(k) == i)
        strength, part, inner = _directions(subject.information[np.ix_(some, some)], ranges[some])
        direction, bars = np.zeros((k, len(strength))), np.zeros(k)
        direction[some], bars[some] = part, np.sqrt(np.diag(inner)) / ranges[some]
        for column in direction[:, ~(strength > 1 / UNIDENTIFIED_STDERR**2)].T:
            # a parameter is involved by its component, or if it changes by more than its own error bar
            which = (np.abs(column) > INVOLVED_SHARE) | (np.abs(column) * UNIDENTIFIED_STDERR > np.maximum(bars, 1e-3))
            if subject.trade_offs:
                i = int(np.argmax(np.abs(column)))
                which |= _compensating(subject, i, UNIDENTIFIED_STDERR * ranges[i], np.inf, bars * ranges)
            involve(which)
        if subject.trade_offs:
            for together in _trade_offs(subject, ranges, np.flatnonzero(~bound & ~concerned)):
                involve(together)
    inside = np.flatnonzero(~bound & ~concerned)
    if len(inside):
        subject.information = _completed(subject.information, profiles, ranges, inside)
        covariance[np.ix_(inside, inside)] = subject.covariance(inside)
        for i in inside.tolist():
            if concerned[i] or not (flat := _flat_side(subject, i, math.sqrt(covariance[i, i]))):
                continue
            along = np.zeros(k, bool)
            if subject.trade_offs:
                own = np.nan_to_num(np.sqrt(np.diag(covariance)), nan=np.inf)
                along = _compensating(subject, i, UNIDENTIFIED_STDERR * ranges[i], np.inf, own)
            along[i] = True
            if along.sum() > 1:
                involve(along)
            elif not profiles.rises(i):
                concerned[i] = True
                sentences.append(f"{subject.label}: {names[i]}: {flat}")
            covariance[concerned, :] = covariance[:, concerned] = np.nan
        for i in profiles.widths:
            if i in inside and not concerned[i]:
                by = max(profiles.widths[i] / math.sqrt(covariance[i, i]), 1.0)
                covariance[i, :] *= by
                covariance[:, i] *= by
    estimates = _estimates(subject, covariance, bound, concerned)
    untold = tuple(names[i] for i in np.flatnonzero(concerned))
    return Identified(covariance, estimates, tuple(dict.fromkeys(sentences)), untold)


def _estimates(subject: Subject, covariance: Array, bound: Mask, concerned: Mask) -> dict[str, Estimate]:
    """Return the estimates, without a value where a parameter is not identifiable, without an error bar at a bound."""
    values, parameters, ranges = subject.values, subject.parameters, subject.ranges
    estimates = {}
    for i, name in enumerate(subject.names):
        if concerned[i]:
            estimates[name] = Estimate(None, None, NOT_IDENTIFIABLE)
        elif bound[i]:
            which_end = "lower" if values[i] <= parameters[i].low + 1e-9 * ranges[i] else "upper"
            value = float(values[i]) if abs(values[i]) > 1e-9 * ranges[i] else 0.0
            estimates[name] = Estimate(value, None, f"at its {which_end} bound, {value:g}")
        else:
            estimates[name] = Estimate(float(values[i]), float(math.sqrt(covariance[i, i])))
    return estimates


class _Profiles:
    """Profiles of single parameters, evaluated when they are first asked for."""

    def __init__(self, subject: Subject) -> None:
        self.subject, self.ranges = subject, subject.ranges
        self.known: dict[int, bool] = {}
        self.widths: dict[int, float] = {}

    def ends(self, i: int) -> list[float]:
        """Return the values to both sides at which a profile should have risen; none where a bound is near."""
        best, parameter = float(self.subject.values[i]), self.subject.parameters[i]
        step = UNIDENTIFIED_STDERR * self.ranges[i]
        ends: list[float] = np.clip(best + step * np.array([-1, 1]), parameter.low, parameter.high).tolist()
        return [end for end in ends if abs(end - best) >= step / 4]

    def rises_alone(self, i: int) -> bool:
        """Return whether the deviance rises to all sides with all else held, which costs little."""
        return all(self.subject.rise(i, end) >= FLAT_RISE for end in self.ends(i))

    def rises(self, i: int) -> bool:
        """Return whether the deviance rises to all sides with all else fitted, and near enough: the data identify the parameter.

        At a kink, where a contact changes between sticking and sliding, and beside a bound, the curvature says nothing about that.
        A number that is never negative, such as a friction, has to be known better than to half of itself.
        """
        if i not in self.known:
            best, parameter = float(self.subject.values[i]), self.subject.parameters[i]
            ends, known = np.array(self.ends(i)), self.rises_alone(i)
            if known:  # (where fits from the minimum show a flat profile, those along the valley can only be lower)
                far, _numbers = self.subject.refit_rises(i, ends)
                known = bool((far >= FLAT_RISE).all())
            if known:
                distances, rises = self._outwards(i, ends, far)
                known = bool((rises[:, -1] >= FLAT_RISE).all())
                self.widths[i] = max(map(_width, distances[:, ::-1], rises[:, ::-1])) if known else np.inf
                if parameter.low >= 0 and best > parameter.low + 1e-9 * self.ranges[i]:
                    known &= self.widths[i] < UNIDENTIFIED_STDERR * best
            self.known[i] = known
        return self.known[i]

    def _outwards(self, i: int, ends: Array, far: Array) -> tuple[Array, Array]:
        """Return distances from the minimum, from near to far, and the profile there (sides, m). At the ends it is ``far``, by fits
        from the minimum, or less; a side that is not followed to its end has the last value from there on.

        The fits follow the valley, which begins along the weakest direction: from elsewhere they may end beyond a kink.
        The first begin at the minimum, too, since a valley may end.
        """
        subject, values = self.subject, self.subject.values
        low, high = (np.array([getattr(p, end) for p in subject.parameters]) for end in ("low", "high"))
        strength, direction, _inner = _directions(subject.information, self.ranges)
        towards = direction[:, int(np.argmin(strength))] * self.ranges
        near = values[i] + OUTWARDS[0] * (ends - values[i])
        with np.errstate(all="ignore"):
            start = np.clip(values + (near - values[i])[:, None] * np.nan_to_num(towards / towards[i]), low, high)
        rises = np.empty((len(OUTWARDS), len(ends)))
        open_ended = np.arange(len(ends))
        for k, share in enumerate(OUTWARDS):
            there = values[i] + share * (ends - values[i])[open_ended]
            one, at = subject.refit_rises(i, there, start)
            if k == 0:
                two, from_minimum = subject.refit_rises(i, there)
                at = np.where((two < one)[:, None], from_minimum, at)
                one = np.minimum(one, two)
            rises[k:, open_ended] = one if k < len(OUTWARDS) - 1 else np.minimum(one, far[open_ended])
            start = np.clip(values + 2 * (at - values), low, high)[one < STEEP]
            open_ended = open_ended[one < STEEP]
            if not len(open_ended):
                break
        return np.abs(OUTWARDS * (ends - values[i])[:, None]), rises.T


def _completed(information: Array, profiles: _Profiles, ranges: Array, inside: NDArray[np.int64]) -> Array:
    """Return the information with that of profiles in directions of some parameters in which the curvature is weak."""
    both = np.ix_(inside, inside)
    strength, direction, _inner = _directions(information[both], ranges[inside])
    for m in np.flatnonzero(~(strength > 1 / UNIDENTIFIED_STDERR**2)):
        i = int(np.argmax(np.abs(direction[:, m])))
        if profiles.rises(int(inside[i])):
            share = direction[i, m] * ranges[inside[i]] / profiles.widths[int(inside[i])]
            change = max(share**2 - strength[m], 0.0)
            along = direction[:, m] / ranges[inside]
            information = information.copy()
            information[both] += change * np.outer(along, along)
    return information


def _width(distance: Array, rises: Array) -> float:
    """Return the distance at which a rise, given from afar to near, is 1: its square root is nearly linear."""
    below = int(np.argmax(rises < 1)) if (rises < 1).any() else len(rises)
    outer, inner = below - 1, below
    near, low = (float(distance[inner]), max(float(rises[inner]), 0.0) ** 0.5) if below < len(rises) else (0.0, 0.0)
    share = (1 - low) / (float(rises[outer]) ** 0.5 - low)
    return float(near + share * (float(distance[outer]) - near))


def _directions(information: Array, ranges: Array) -> tuple[Array, Array, Array]:
    """Return the information along its principal directions, in units of the ranges, the directions, and the covariance of those
    that are identified."""
    strength, direction = np.linalg.eigh(information * np.outer(ranges, ranges))
    good = strength > 1 / UNIDENTIFIED_STDERR**2
    half = direction[:, good] / np.sqrt(strength[good])
    return strength, direction, half @ half.T * np.outer(ranges, ranges)


def identified_covariance(information: Array, ranges: Array) -> Array:
    """Return the covariance in the identified directions."""
    return _directions(information, ranges)[2]


def _trade_offs(subject: Subject, ranges: Array, inside: NDArray[np.int64]) -> Iterator[Mask]:
    """Yield parameters that compensate for each other: where spins are integrated over, the curvature between two kinks may be
    large and the profile flat. So the most compensated one is held five error bars away, and the others fitted again."""
    while len(inside):
        block, bars = subject.information[np.ix_(inside, inside)], np.zeros(len(ranges))
        bars[inside] = np.sqrt(np.diag(_directions(block, ranges[inside])[2]))
        times = np.diag(block) * bars[inside] ** 2
        i = int(inside[int(np.argmax(times))])
        if times.max() < COMPENSATED:
            # reversed slip and the spins before the wall are equivalent, whatever the curvature at a kink
            i = next((int(j) for j in inside if subject.names[j] in SLIP_RETURN), -1)
            if i < 0:
                return
        together = _compensating(subject, i, FAR[0] * float(bars[i]), bars[i], bars) & (bars > 0)
        if not together.any():
            return
        yield together
        inside = inside[~together[inside]]


def _compensating(subject: Subject, i: int, step: float, bar: float, bars: Array) -> Mask:
    """Return (k,) parameter i and those that move by more than their error bars when it is held a step away and all else is fitted;
    none if the deviance rises by a quarter of what its own error bar implies, or by the 99 % level if it has none, at both ends."""
    best, parameter = float(subject.values[i]), subject.parameters[i]
    # (a near point alone does not count: at a kink the deviance may be level for two error bars, and steep beyond)
    shares = np.array([-1, 1]) if bar == np.inf else np.array([-1, -NEARER, NEARER, 1])
    values = np.clip(best + step * shares, parameter.low, parameter.high)
    far = np.abs(values - best)
    some = far > max(NEAR_BOUND * bar if bar < np.inf else 0.0, step / 4)
    if not some.any():
        return np.zeros(len(bars), bool)
    rises, found = subject.refit_rises(i, values[some])
    short = rises - (np.square(far[some] / bar) / 4 if bar < np.inf else FLAT_RISE)
    if not (short < 0)[np.abs(shares[some]) == 1].any():
        return np.zeros(len(bars), bool)
    # along the whole valley: close by, a parameter with a wide error bar may hardly have moved yet
    rises_along, along = subject.refit_rises(i, np.clip(best + step * ALONG, parameter.low, parameter.high))
    flat = np.concatenate([found[short < 0], along[rises_along < FLAT_RISE]])
    moved: Mask = np.asarray((np.abs(flat - subject.values) > np.maximum(bars, 1e-9)).any(axis=0))
    moved[i] = True
    return moved


def _flat_side(subject: Subject, i: int, stderr: float) -> str:
    """Return a sentence if the deviance does not rise on one side, although the curvature at the minimum implies that it should.

    This happens if the last contact that identifies a parameter is at the edge between sticking and sliding. Five error bars
    away the deviance should have risen by 25; if it has risen by less than half of that, all else is fitted again, there and ten
    times as far.
    """
    best, parameter = float(subject.values[i]), subject.parameters[i]
    for sign, word in ((1, "more"), (-1, "less")):
        far = np.clip(best + sign * stderr * np.array(FAR), parameter.low, parameter.high)
        if abs(far[0] - best) < 0.8 * FAR[0] * stderr:
            continue  # the bound is near
        if subject.rise(i, float(far[0])) < FAR[0] ** 2 / 2 and (subject.refit_rises(i, far)[0] < FLAT_RISE).all():
            return (
                f"values beyond {best:.3g} fit nearly as well: only a limit is identifiable, {_limit(subject, i, -sign):.3g} or"
                f" {word} (95 %)"
            )
    return ""


def _limit(subject: Subject, i: int, sign: int) -> float:
    """Return the one-sided 95 % limit of a parameter, from the rise of the deviance with the others held."""
    parameter = subject.parameters[i]
    inside, outside = float(subject.values[i]), parameter.low if sign < 0 else parameter.high
    for _ in range(BISECTIONS):
        middle = (inside + outside) / 2
        inside, outside = (inside, middle) if subject.rise(i, middle) >= ONE_SIDED else (middle, outside)
    return (inside + outside) / 2


def _sentence(subject: Subject, profiles: _Profiles, names: list[str]) -> str:
    """Return a sentence about parameters that the data do not identify."""
    said, values = f"{subject.label}: {' and '.join(names)}: ", dict(zip(subject.names, subject.values, strict=True))
    if sorted(names) == ["friction", "restitution"]:
        i = list(subject.names).index("friction")
        if subject.rise(i, subject.parameters[i].high) < FLAT_RISE:
            limit = _limit(subject, i, -1) * (1 + values["restitution"])
            return (
                f"{said}no contact slides throughout, so only a lower limit of friction (1 + restitution) is identifiable:"
                f" {limit:.3g} or more (95 %)"
            )
        product = values["friction"] * (1 + values["restitution"])
        return f"{said}sliding contacts identify only the product friction (1 + restitution) = {product:.4g}"
    if len(names) > 1:
        return f"{said}only a combination of them is identifiable, not each value; measure more (spin, other angles), or fix one"
    i = subject.names.index(names[0])
    if profiles.rises_alone(i):
        return f"{said}other parameters compensate for it; measure more (spin, other angles), or fix one"
    if names == ["friction"] and subject.rise(i, subject.parameters[i].low) >= ONE_SIDED:
        limit = _limit(subject, i, -1)
        return f"{said}no contact slides throughout, so only a lower limit is identifiable: {limit:.3g} or more (95 %)"
    said += (
        "every contact slides throughout, so no measurement depends on it; film steeper hits"
        if (names[0] in SLIP_RETURN)
        else "these data hardly depend on it"
    )
    return said


# ----------------------------------------------------------------------------------------------------
# Profile likelihood: the deviance above its minimum against one parameter, with all others fitted, and the intervals from it.


Indices = NDArray[np.int64]
Rises = Callable[[Array, Indices], Array]
LEVELS = (1.0, 3.8415)  # of the deviance: 68.3 % and 95 % of one parameter
ROUNDS, HALF_WIDTH_ROUNDS = 36, 8
CLOSE, HALF_WIDTH_CLOSE = 1e-3, 0.04  # of a level: an end whose deviance is this close is accepted
TIGHT = 1e-9  # of the parameter: a bracket of this width is closed
LEAST_SHARE = 0.1  # of a bracket: no step is shorter, so that both of its ends converge
GROWTH = 2.5  # of a distance in one step, if no bracket is known
WIDE = 1.1  # error bars: a half-interval, over its number of them, that is larger replaces the error bar
SLOPE_STEP = 0.1  # of an error bar: the step of a numerical derivative
PROFILE_START = 6.0  # error bars from the minimum, where a profile begins


def profile_ends(
    rises: Rises, best: float, far: Array, edge: Array, goals: Array, *, jump: bool, rounds: int = ROUNDS,
    close: float = CLOSE,
) -> tuple[Array, Array]:  # fmt: skip
    """Find where a profile, the deviance above its minimum with all else fitted, has risen to its goals. Returns ends and rises.

    ``rises(values, which)`` evaluates some of the ends. From ``far`` on the search goes outwards, by a parabola, or at once to the
    ``edge`` (``jump``), until the goal is bracketed; then the square root of the rise, which is nearly linear, is interpolated, and
    every third step halves the bracket, because of kinks. If the rise at the edge is below its goal, the profile is open.
    """
    far, edge = np.where((far - best) * (edge - best) < 0, edge, far), np.asarray(edge, float)
    end, rise = far.copy(), np.zeros(len(far))
    inner, low = np.full(len(far), best), np.zeros(len(far))
    outer, high = np.full(len(far), np.nan), np.full(len(far), np.nan)
    left = np.arange(len(far))
    for turn in range(rounds):
        rise[left] = now = rises(end[left], left)
        under = now < goals[left]
        at, root = end[left], np.sqrt(np.maximum(now, 0.0))
        inner[left[under]], low[left[under]] = at[under], root[under]
        outer[left[~under]], high[left[~under]] = at[~under], root[~under]
        bracket = np.abs(outer[left] - inner[left])
        left = left[
            (np.abs(now - goals[left]) > close * goals[left])
            & ~(under & (at == edge[left]))
            & ~(bracket <= TIGHT * max(abs(best), 1e-12))
        ]
        if not len(left):
            break
        known = ~np.isnan(outer[left])
        share = (np.sqrt(goals[left]) - low[left]) / (high[left] - low[left])
        share = np.clip(share, LEAST_SHARE, 1 - LEAST_SHARE) if turn % 3 < 2 else np.full(len(left), 0.5)
        within = inner[left] + share * (outer[left] - inner[left])
        by = np.clip(np.sqrt(goals[left]) / np.maximum(low[left], 1e-3), 1.05, GROWTH)
        beyond = best + (inner[left] - best) * by
        beyond = np.where(np.abs(beyond - best) > np.abs(edge[left] - best), edge[left], beyond)
        end[left] = np.where(known, within, edge[left] if jump else beyond)
    return end, rise


def half_width(
    rises: Rises, best: float, step: float, low: float, high: float, level: float = 1.0, farther: bool = False
) -> tuple[float, Array]:
    """Return half the width within which a profile rises by less than a level, or the distance to its ``farther`` end, searched for
    from a step away, in error bars of this level, and the rises at its ends, which are that level except at a bound."""
    far = np.clip(best + step * np.array([-1.0, 1.0]), low, high)
    end, rise = profile_ends(
        rises, best, far, np.array([low, high]), np.full(2, level), jump=False, rounds=HALF_WIDTH_ROUNDS, close=HALF_WIDTH_CLOSE,
    )  # fmt: skip
    nearly = np.where(np.abs(rise - level) <= HALF_WIDTH_CLOSE * level, rise, level)  # (its root is nearly linear)
    distance = np.abs(end - best) / np.sqrt(nearly)
    return float(distance.max() if farther else distance.mean()), rise


def with_profiles(fit: Fit, names: Sequence[str] | None = None) -> Fit:
    """Add the intervals of 68 % and 95 % of each identified parameter, or of those named, by profile likelihood.

    The curvature is that of the minimum found. Where the interval of 95 % is far wider, since it holds another minimum or a slope
    beyond a kink, half its width is 1.96 error bars.

    Parameters
    ----------
    fit : Fit
        Of one law.
    names : sequence of str, optional
        Parameters. Default: all identified ones.

    Returns
    -------
    Fit
        With ``interval_68`` and ``interval_95`` in its estimates.

    Examples
    --------
    >>> from carom.data.rebounds import make_rebounds
    >>> from carom.fitting import Setting, fit_law, make_problem, with_profiles
    >>> from carom.fitting.laws import laws_named
    >>> v = [1.0, 2.0, 3.0, 4.0]
    >>> columns = {"v_n_in": v, "v_t_in": v, "spin_in": [0.0] * 4, "v_n_out": [0.81, 1.59, 2.42, 3.18], "v_t_out": v,
    ...            "sigma_v_n_out": 0.02, "sigma_v_t_out": 0.02}
    >>> problem, notes = make_problem(make_rebounds("planar", columns), Setting(radius=0.02))
    >>> mirror = laws_named(["mirror"], "planar", True)[0][0]
    >>> fit = with_profiles(fit_law(mirror, problem))
    >>> low, high = fit.estimates["restitution"].interval_95
    >>> low < 0.8 < high
    True
    """
    problem = fit.problem
    # (scatter of residuals follows along the profile; error bars before the wall need it held)
    model = replace(model_of(fit.law, problem), profiled=bool(problem.estimated.any()) and not problem.vx.any())
    base = float(model.minimize(fit.numbers[None]).value[0])
    for name, estimate in fit.estimates.items():
        if estimate.value is None or not (names is None or name in names):
            continue
        place, parameter = model.places[name], model.parameters[name]
        best = float(fit.numbers[place])
        levels, bars_out = _levels(fit, name, model.profiled)
        goals, up = np.repeat(levels, 2), np.tile([False, True], 2)
        edge = np.where(up, parameter.high, parameter.low)
        reach = PROFILE_START * estimate.stderr if estimate.stderr else np.inf
        far = np.where(up, np.minimum(best + reach, edge), np.maximum(best - reach, edge))
        end, rise = profile_ends(profile_rises(fit, name, place, base, model=model), best, far, edge, goals, jump=True)
        open_ = (rise < goals * (1 - CLOSE)) & (end == edge)
        one, two = (float(end[0]), float(end[1])), (float(end[2]), float(end[3]))
        fit = with_estimate(fit, name, replace(estimate, interval_68=one, interval_95=two))
        # an end at a bound, many standard errors away: the parabola at the best place is only the bottom of the profile
        far_off = np.abs(end[2:] - best) > PROFILE_START * (estimate.stderr or np.inf)
        if (open_[2:] & far_off).any():
            least = f"{end[2]:.3g} or more" if open_[3] and far_off[1] else f"{end[3]:.3g} or less"
            said = f"{fit.law.name}: {name}: only a limit is identifiable, {least} (95 %); values beyond fit as well"
            fit = without_estimate(fit, name, Estimate(None, None, f"{least} (95 %)", one, two), said)
        elif estimate.stderr:
            bar = max((high - low) / 2 / out for (low, high), out in zip((one, two), bars_out, strict=True))
            if bar > WIDE * estimate.stderr:
                fit = scaled(fit, name, bar / estimate.stderr)
    return fit


def _levels(fit: Fit, name: str, profiled: bool) -> tuple[tuple[float, float], tuple[float, float]]:
    """Return the rises of the deviance at the ends of the intervals of 68.3 and 95 %, and the error bars from the minimum to there.

    Where scatter is estimated from n_j numbers of an output, the intervals are those of Student's t: with n_j - p_j degrees of
    freedom, p_j the parameters that the output determines (its leverage); of several outputs by Satterthwaite's sum, each with its
    part of the parameter's information (Biometrics Bull. 2, 110 (1946)). Outputs that are weighted by their own estimated scatter
    seem to agree too well: Meier's factor widens for it (Biometrics 9, 59 (1953)). ``profiled``: the deviance is that with
    the scatter of the residuals at each place, n_j log of their mean square.
    """
    from scipy.special import stdtrit

    problem = fit.problem
    inside = [i for i in range(len(fit.names)) if np.isfinite(fit.covariance[i, i]) and fit.covariance[i, i] > 0]
    if not problem.estimated.any() or problem.spins is not None or fit.names.index(name) not in inside:
        return LEVELS, (1.0, math.sqrt(LEVELS[1]))
    model, slopes = model_of(fit.law, problem), []
    for i in inside:
        step = np.zeros(len(fit.numbers))
        step[model.places[fit.names[i]]] = SLOPE_STEP * math.sqrt(fit.covariance[i, i])
        ends = [predict_law(fit.law, problem, fit.numbers + sign * step) for sign in (1, -1)]
        slopes.append((ends[0] - ends[1]) / (2 * step.max()))
    slope = np.where(np.isfinite(problem.y), np.stack(slopes), 0.0)
    information = np.einsum("anj,bnj,nj->jab", slope, slope, 1 / np.where(problem.vy > 0, problem.vy, np.inf))
    inverse = np.linalg.pinv(information.sum(axis=0), hermitian=True)
    along = inverse[:, inside.index(fit.names.index(name))]
    part = np.einsum("a,jab,b->j", along, information, along)
    part = part / part.sum() if part.sum() > 0 else np.full(3, 1 / 3)
    count = np.isfinite(problem.y).sum(axis=0)
    free = np.maximum(count - np.einsum("ab,jba->j", inverse, information), 1.0)
    share = np.where(problem.estimated, part * count / free, part)
    degrees = share.sum() ** 2 / max(float((np.square(share) / free)[problem.estimated].sum()), 1e-12)
    meier = 1 + 4 * float((part * (1 - part) / free)[problem.estimated].sum())
    one, two = (float(stdtrit(degrees, (1 + p) / 2)) for p in (0.6827, 0.95))
    rises = np.multiply.outer(np.square([one, two]) * share.sum() * meier, part)
    if profiled:
        rises = np.where(problem.estimated, count * np.log1p(rises / np.maximum(count, 1)), rises)
    low, high = rises.sum(axis=1).tolist()
    return (low, high), (one, two)


def profile_rises(
    fit: Fit, name: str, place: int, base: float, steps: int | None = None, model: FitModel | None = None
) -> Rises:
    """Return the profile of a parameter above ``base``; with ``steps`` each end goes on from where it was left. The others begin
    there, and where the covariance has them: across a kink one of the two may end higher. Of a tabulated law they are fitted with
    its table, and the deviance there is the law's."""
    model = (model or model_of(fit.law, fit.problem)).holding(name)
    seeds: dict[int, Array] = {}
    places, own = [model.places[one] for one in fit.names], fit.names.index(name)
    with np.errstate(all="ignore"):
        along = np.nan_to_num(fit.covariance[own] / fit.covariance[own, own])

    def rises(values: Array, which: Indices) -> Array:
        here = np.array([fit.numbers if steps is None else seeds.get(i, fit.numbers) for i in which.tolist()])
        p, far = np.concatenate([here, here]), (values - here[:, place])[:, None]
        p[: len(here), places] = np.clip(here[:, places] + far * along, model.low[places], model.high[places])
        p[:, place] = np.tile(values, 2)
        found = model.minimize(p) if steps is None else model.minimize(p, steps)
        least = np.argmin(found.value.reshape(2, -1), axis=0) * len(here) + np.arange(len(here))
        seeds.update(zip(which.tolist(), found.p[least], strict=True))
        return (found.value[least] if model.tabulated is None else model.using(None).deviances(found.p[least])) - base

    return rises


def with_estimate(fit: Fit, name: str, estimate: Estimate) -> Fit:
    """Return the fit with another estimate of a parameter."""
    return replace(fit, estimates=fit.estimates | {name: estimate})


# ----------------------------------------------------------------------------------------------------
# Fitted scatter: of outputs without error bars, or of contacts in addition to given error bars.
#
# Outputs without error bars have one scatter each, estimated from the law's residuals. The scatter between contacts is one number
# s that adds in quadrature to the error bars after the wall: s times the speed before it ("share"), or s itself ("absolute"); of
# a spin over the radius. It is fitted in turn with the law's parameters, as the minimum of the deviance plus log det S(s) - log
# det S(0). Without error bars before the wall, this is the likelihood; with them, only the change of log det S with s may be
# included (:mod:`carom.fitting.deviance`).


Search = Callable[[FitModel], Array]
Descend = Callable[[FitModel, Array], Array]
SCATTER_ROUNDS, CONTACT_ROUNDS = 40, 12
FIRST_SHARE = 0.05  # of the speed: the scatter with which the search begins
SETTLED, ROUGHLY = 2e-3, 0.1  # of the scatter: a smaller change ends the search
SMALLEST_SHARE, MOST_SHARE = 1e-5, 1.0
REACH = 0.5  # of log s, within which it is sought near where it was
CURVATURE_STEP = 0.02  # of log s
JACOBIAN_STEP = 0.1  # of an error bar before the wall
CONTACT_SCATTER = "contacts"


class Scattered(NamedTuple):
    """Starting points of the descent, the model with its scatter, and the contribution of the scatter to the deviance."""

    p: Array
    model: FitModel
    extra: float
    scatter: dict[str, float]
    estimate: Estimate | None


def with_estimated_scatter(model: FitModel, search: Search, descend: Descend) -> Scattered:
    """Fit parameters with the scatter of outputs without error bars, which at each place is that of the residuals there.

    Error bars before the wall, beside outputs without any, enter with the scatter held, in turn.
    """
    problem = model.problem
    at = replace(model, profiled=True)
    p = descend(at, search(at))
    at = at.with_scatter_of(p)
    for _ in range(SCATTER_ROUNDS if problem.vx.any() else 0):
        p, was = descend(at, p[None]), at.problem.vy
        at = replace(at, problem=problem).with_scatter_of(p)
        if np.allclose(at.problem.vy, was, rtol=1e-6, atol=0.0):
            break
    outputs = ("v_n_out", "v_t_out", "spin_out" if model.law.kind == "planar" else "spin_z_out")
    n, variance = np.isfinite(problem.y).sum(axis=0), at.problem.vy[0]
    scatter = {outputs[j]: math.sqrt(variance[j]) for j in np.flatnonzero(problem.estimated).tolist()}
    estimated = problem.estimated & (n > 0)
    return Scattered(p[None], at, float((n[estimated] * np.log(variance[estimated])).sum()), scatter, None)


def with_contact_scatter(model: FitModel, search: Search, descend: Descend, near: float | None = None) -> Scattered:
    """Fit parameters and the scatter between contacts in turn until neither changes; ``near``: a scatter to begin with, else it is
    settled roughly."""
    from scipy.optimize import minimize_scalar

    plain, unit = model.problem, _unit(model.problem)
    size = float(np.median(np.hypot(plain.x[:, 0], plain.x[:, 1]))) if plain.setting.scatter == "absolute" else 1.0
    low, high = math.log(SMALLEST_SHARE * size), math.log(MOST_SHARE * size)

    def having(s: float) -> FitModel:
        return replace(model, problem=replace(plain, vy=plain.vy + np.square(s * unit)))

    def deviance(p: Array) -> Callable[[float], float]:
        """Return the deviance with numbers p as a function of log s: derivatives of the law are with respect to p alone."""
        moved = _moved_by_errors(model, p)
        without = log_determinants(model, moved).sum()

        def of_scatter(log_s: float) -> float:
            at = having(math.exp(log_s))
            rows = replace(at, free=at.free[:0]).row_deviances(p)[0]
            return float(rows.sum() + log_determinants(at, moved).sum() - without)

        return of_scatter

    log_s, curvature = math.log(near or FIRST_SHARE * size), 0.0
    p = search(having(math.exp(log_s)).without_shared())
    for turn in range(CONTACT_ROUNDS):
        at = having(math.exp(log_s))
        p = descend(at if turn or near else at.without_shared(), p)[None]
        was, of_scatter = log_s, deviance(p[0])
        if turn or near:  # (near its minimum it is a parabola)
            less, here, more = (of_scatter(was + step) for step in (-CURVATURE_STEP, 0.0, CURVATURE_STEP))
            curvature = (less + more - 2 * here) / CURVATURE_STEP**2
            log_s = min(was + (less - more) / (2 * CURVATURE_STEP * curvature), high) if curvature > 0 else math.inf
        if not (turn or near) or abs(log_s - was) > REACH:
            log_s = float(minimize_scalar(of_scatter, bounds=(low, high), method="bounded", options={"xatol": 0.05}).x)
        if abs(log_s - was) < (SETTLED if near else ROUGHLY) or log_s < low + 0.1:
            break
    if log_s < low + 0.1:
        return Scattered(p, model, 0.0, {CONTACT_SCATTER: 0.0}, Estimate(0.0, None, "none beyond the error bars"))
    s, at = math.exp(log_s), having(math.exp(log_s))
    stderr = s * math.sqrt(2 / curvature) if curvature > 0 else None
    moved = _moved_by_errors(model, p[0])
    extra = float(log_determinants(at, moved).sum() - log_determinants(model, moved).sum())
    return Scattered(p, at, extra, {CONTACT_SCATTER: s}, Estimate(s, stderr))


def _unit(problem: Problem) -> Array:
    """Return the change (N, 3) of the measurements after the wall by a scatter of 1."""
    speed = np.hypot(problem.x[:, 0], problem.x[:, 1])
    velocity = np.ones(len(speed)) if problem.setting.scatter == "absolute" else speed
    return np.stack([velocity, velocity, velocity / problem.setting.radius], axis=-1)


def _moved_by_errors(model: FitModel, p: Array) -> dict[int, Array]:
    """Return the changes (N, 3) of the prediction by an error bar of v_n, v_t and spin before the wall, where there is one."""
    law, problem, found = model.law, model.problem, {}
    here = predict_law(law, problem, p)
    for o in range(3):
        size = np.sqrt(problem.vx[:, o])
        if size.any():
            step = size[:, None] * np.eye(3)[o] * JACOBIAN_STEP
            then = predict_law(law, replace(problem, x=problem.x + step), p)
            found[o] = np.nan_to_num(then - here) / JACOBIAN_STEP
    return found


def log_determinants(model: FitModel, moved: dict[int, Array]) -> Array:
    """Return log det S of each row (N,), ``moved`` by errors before the wall; for a row whose spin was not measured, of the normal
    part and of the variances along the wall under a mirror law, to which its deviance is relative."""
    law, problem = model.law, model.problem
    seen = np.isfinite(problem.y)
    s = np.einsum("im,mn->imn", problem.vy, np.eye(3))
    for o, change in moved.items():
        s += change[:, :, None] * change[:, None, :]
        if o < 2:  # errors before and after that go together
            size = np.sqrt(problem.vx[:, o])
            slope = change / np.where(size > 0, size, 1.0)[:, None]
            s[:, :, o] -= slope * problem.covariance[:, o, None]
            s[:, o, :] -= slope * problem.covariance[:, o, None]
    pair = seen[:, :, None] & seen[:, None, :]
    s = np.where(pair, s, np.eye(3))
    found = np.linalg.slogdet(s)[1]
    if feels_spins(law, problem):
        side = np.where(seen, problem.vy + problem.vx, 1.0)[:, 1:].prod(axis=1)
        found = np.where(problem.unknown, np.log(s[:, 0, 0] * side), found)
    return np.asarray(found)


# ----------------------------------------------------------------------------------------------------
# Uncertainty beyond curvature: bootstrap, systematic errors, and the friction where spins are not measured.


NO_ROOT = 0.3  # deviation of the root of a rise from 1, above which a profile has no end there
MIN_STEP = 0.02  # of a friction, where the search for an unknown half-width begins
MARGINAL_STEPS, BOOTSTRAP_BATCH = 40, 250


def with_bootstrap(fit: Fit, draws: int, seed: int = 0) -> Fit:
    """Add standard errors from fits to rows drawn with replacement (Efron 1979), with shared errors drawn at random.

    Parameters
    ----------
    fit : Fit
        Of one law.
    draws : int
        Number of fits, 2 or more.
    seed : int
        Of the random numbers.

    Returns
    -------
    Fit
        With ``bootstrap`` in its estimates.

    Examples
    --------
    >>> from carom.data.rebounds import make_rebounds
    >>> from carom.fitting import FITTED, Setting, fit_law, make_problem, with_bootstrap
    >>> v = [1.0, 2.0, 3.0, 4.0]
    >>> columns = {"v_n_in": v, "v_t_in": v, "spin_in": [0.0] * 4, "v_n_out": [0.81, 1.59, 2.42, 3.18], "v_t_out": v,
    ...            "sigma_v_n_out": 0.02, "sigma_v_t_out": 0.02}
    >>> problem, _notes = make_problem(make_rebounds("planar", columns), Setting(radius=0.02))
    >>> fit = with_bootstrap(fit_law(FITTED[0], problem), 20)
    >>> 0 < fit.estimates["restitution"].bootstrap < 0.02
    True
    """
    places = model_of(fit.law, fit.problem).places
    n = len(fit.problem.x)
    rng = np.random.default_rng(seed)
    found = []
    for first in range(0, draws, BOOTSTRAP_BATCH):
        weights = rng.multinomial(n, np.full(n, 1 / n), size=min(BOOTSTRAP_BATCH, draws - first)).astype(float)
        centers = rng.normal(size=(len(weights), len(fit.problem.shared)))
        found.append(refit(fit, fit.problem, weights, centers=centers)[0])
    spread = np.nan_to_num(np.concatenate(found), posinf=0.0).std(axis=0, ddof=1)
    estimates = {
        name: one if one.value is None else replace(one, bootstrap=float(spread[places[name]]))
        for name, one in fit.estimates.items()
    }
    return replace(fit, estimates=estimates)


def with_shared(fit: Fit, shifted: Sequence[tuple[str, Rebounds]]) -> Fit:
    """Add standard errors from systematic errors common to all rows: an axis misaligned, a scale, a tilted camera.

    They do not cause scatter between rows, so chi^2 does not show them, and they do not average out. ``shifted``: the rows with one
    standard error of each applied. The fit is repeated with each; the shifts of the parameters are added in quadrature.
    """
    places = list(model_of(fit.law, fit.problem).places.values())
    moves = np.zeros((len(shifted), len(places)))
    for move, (_words, rebounds) in zip(moves, shifted, strict=True):
        made = make_problem(rebounds, fit.problem.setting)[0]
        problem = replace(made, vx=fit.problem.vx, covariance=fit.problem.covariance, vy=fit.problem.vy)
        move[:] = refit(fit, problem)[0][0, places] - fit.numbers[places]
    sizes = np.sqrt((moves * moves).sum(axis=0))
    estimates = {
        name: estimate if estimate.value is None else replace(estimate, shared=float(size))
        for (name, estimate), size in zip(fit.estimates.items(), sizes, strict=True)
    }
    return replace(fit, estimates=estimates)


def with_marginal_errors(fit: Fit, extra: float = 0.0) -> Fit:
    """Correct estimates if unmeasured spins are integrated over: error bars by profiles, and an unbiased prior width.

    The friction is the edge of a scatter, and the deviance has a kink for each row at that edge, so its curvature between two
    kinks does not represent its rise across them; so it is with the other numbers along the wall. The prior's width is the scatter
    of few spins, and its maximum-likelihood value is too small on average: for n normal numbers about a fitted mean, with sum of
    squares S, it is sqrt(S/n), whereas sqrt(S/(n - 3/2)) is unbiased (about a given mean, n - 1/2). ``fit.numbers`` are not
    changed; ``extra``: the part of the deviance that does not depend on the rows.
    """
    fit = _with_unbiased_width(fit)
    # (else the curvature is that between distant points, or profiles are those of law and mixture together)
    names = fit.estimates if not fit.problem.carried and fit.problem.mixture is None else ()
    for name in (name for name in KINKED if name in names):
        if stderr := fit.estimates[name].stderr:
            fit = scaled(fit, name, _profile_width(fit, name, extra, stderr)[0] / stderr)
    return fit


def _with_unbiased_width(fit: Fit) -> Fit:
    """Scale the prior's width: its relative error 1/sqrt(2n) gives the effective number of rows n, and 3/2 times the square of this
    error is the bias. The mean's error bar is the width over the root of n, and is scaled by the same factor."""
    estimate = fit.estimates.get("spin_width")
    if estimate is None or not estimate.stderr:
        return fit
    width = float(fit.numbers[INDEX["spin_width"]])
    by = 1 + (1.5 if "spin_mean" in fit.names else 0.5) * (estimate.stderr / width) ** 2
    fit = scaled(fit, "spin_width", by)
    if "spin_mean" in fit.estimates and fit.estimates["spin_mean"].stderr:
        fit = scaled(fit, "spin_mean", by)
    return with_estimate(fit, "spin_width", replace(fit.estimates["spin_width"], value=by * width))


def with_profiled_friction(fit: Fit, information: Array, extra: float = 0.0) -> Array:
    """Return the information with that on the friction from its profile, if the deviance rises by 1 on both sides; else unchanged.

    If a row is at a kink exactly at the minimum, the curvature there may suggest that the friction is not identifiable.
    """
    i, best = fit.names.index("friction"), float(fit.numbers[INDEX["friction"]])
    half, rise = _profile_width(fit, "friction", extra, MIN_STEP * max(best, MIN_STEP))
    if (np.abs(np.sqrt(np.maximum(rise, 0.0)) - 1) > NO_ROOT).any():
        return information
    rest = np.delete(np.arange(len(information)), i)
    inverse = np.linalg.pinv(information[np.ix_(rest, rest)], hermitian=True)
    information = information.copy()
    information[i, i] = information[i, rest] @ inverse @ information[rest, i] + half**-2
    return information


def _profile_width(fit: Fit, name: str, extra: float, step: float) -> tuple[float, Array]:
    """Return the half-width of a number's profile, searched for from a step away, and the rises at its ends."""
    model = working_model(fit, fit.problem)
    place, parameter = model.places[name], model.parameters[name]
    rises = profile_rises(fit, name, place, fit.deviance - extra, MARGINAL_STEPS, model)
    return half_width(rises, float(fit.numbers[place]), step, parameter.low, parameter.high)
