"""Forms of a law's parameters, and mixtures as priors of unmeasured spins: fitted on top of a law's own fit, chosen by AICc."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from carom.fitting.deviance import SPIN_MEAN, SPIN_WIDTH
from carom.fitting.evidence import DECIDED
from carom.fitting.fit import Place, fit_at, fit_law, none_above
from carom.fitting.identify import half_width, with_contact_scatter
from carom.fitting.laws import FORMS, INDEX, NUMBERS, PLACES
from carom.fitting.likelihood import SpinMixture, evaluate_components, mixture_deviances
from carom.fitting.model import FitModel, coarse_table, feels_spins, fine_table, model_of
from carom.fitting.result import Fit, scaled
from carom.fitting.rows import Problem, Setting
from carom.fitting.spin_chains import observed_information
from carom.fitting.varying import (
    ERRORS,
    NORMAL,
    Noise,
    Prediction,
    Smooth,
    VaryingFit,
    VaryingModel,
    fit_varying,
    held_out_score,
    predictive_of,
    smooth_parameter,
    varying_model,
)
from carom.formatting import json_value
from carom.public.progress import Progress

Array = NDArray[np.float64]
WIDTHS = (0.2, 0.06, 0.02, 0.006)  # of the second differences of a spline's coefficients, that are tried
MOST_ROWS = 1000  # among which, of more, the choice is made
ALONG_TRIED = ("linear", "exponential", "linear:v_n")
SPLINES = {
    "restitution": "v_n",
    "friction": "slip",
    "tangential_restitution": "slip/v_n",
    "stiffness_ratio": "slip/v_n",
}
MOST_AICC, ERRORS_OF_GAIN = 2.0, 2.0
LEAST_GAIN = 1.0  # of the log score of all rows


@dataclass(frozen=True, eq=False)
class TriedForm:
    """A law with some of its parameters as functions of the impact, and its scores."""

    words: str
    """The change from what was chosen before, such as "friction linear"; "constants" first."""
    fit: VaryingFit
    base: Fit
    score: float
    """Mean log density of a held-out row, per (m/s)^3."""
    rows: Array
    """(N,) the density of each."""
    gain: float
    """Of the score over what was chosen before,"""
    gain_error: float
    """and its standard error over the rows."""
    aicc_change: float = 0.0

    @property
    def aicc(self) -> float:
        """With the effective number of parameters."""
        return self.fit.aicc

    @property
    def better(self) -> bool:
        """Whether the gain is larger than twice its error, and than 1 for all rows, and AICc does not rise by more than 2."""
        return (
            self.gain > max(ERRORS_OF_GAIN * self.gain_error, LEAST_GAIN / len(self.rows))
            and self.aicc_change < MOST_AICC
        )


@dataclass(frozen=True, eq=False)
class FormChoice:
    """All that was tried for one law, in order, and what was chosen; made by :func:`choose_forms`."""

    law: str
    tried: tuple[TriedForm, ...]
    chosen: tuple[int, ...]
    """Indices of what was chosen, one after the other; the first is 0, constants."""

    @property
    def best(self) -> TriedForm:
        """The latest choice."""
        return self.tried[self.chosen[-1]]

    @property
    def sentence(self) -> str:
        """The choice in one sentence."""
        first, best = self.tried[0], self.best
        if best is first:
            return f"{self.law}: constants predict held-out rows best ({first.score:.3g} per row)"
        words = ", then ".join(self.tried[i].words for i in self.chosen[1:])
        return (
            f"{self.law}: {words}: held-out score {best.score:.3g} per row for {first.score:.3g} of constants, AICc"
            f" {best.aicc - first.aicc:+.1f}"
        )

    def predict(self, before: Any) -> Prediction:
        """Return mean and covariance of the states after the wall, as :meth:`carom.fitting.Fit.predict`."""
        return predictive_of(self.best.fit).of_states(before)

    def as_dict(self) -> dict[str, Any]:
        """Return the choice for JSON."""
        tried = [
            {"words": one.words, "aicc": json_value(one.aicc), "score": json_value(one.score), "gain": json_value(one.gain),
             "gain_stderr": json_value(one.gain_error), "chosen": i in self.chosen}
            for i, one in enumerate(self.tried)
        ]  # fmt: skip
        return {"law": self.law, "sentence": self.sentence, "tried": tried}


def choose_forms(
    fit: Fit, parameters: Sequence[str] | None = None, *, noise: bool = True, progress: Progress | None = None
) -> FormChoice:
    """Choose forms or splines for the parameters of a fitted law, and the distribution of errors, by held-out rows.

    Parameters
    ----------
    fit : Fit
        Of a law to rows whose spins before the wall were measured.
    parameters : sequence of str, optional
        Of which forms are tried. Default: all of the law's.
    noise : bool
        Whether scatter that grows with the speed, Student's t and exponential errors are tried, too.
    progress : callable(done, total, text), optional

    Returns
    -------
    FormChoice

    Raises
    ------
    CaromError
        Where spins were not measured.

    Examples
    --------
    >>> from carom.data import published_rebounds
    >>> from carom.fitting import Setting, fit_laws
    >>> rows = published_rebounds("tt_rackets").rebounds
    >>> ranking = fit_laws(rows, Setting(radius=0.02, kappa=2 / 3), "contact", where="racket=10_antispin", bootstrap=0)
    >>> choice = choose_forms(ranking.best, ["friction"])
    >>> [one.words for one in choice.tried][:3]
    ['constants', 'friction linear', 'friction exponential']
    """
    problem = fit.problem
    varying_model(fit)  # (says what is missing)
    if len(problem.x) > MOST_ROWS:
        some = problem.select(np.linspace(0, len(problem.x) - 1, MOST_ROWS).astype(int))
        fit = fit_law(fit.law, some)
    tried = [_tried("constants", fit, (), NORMAL, None)]
    chosen, varied = [0], set[str]()
    names = [name for name in SPLINES if name in fit.law.free and (parameters is None or name in parameters)]
    while True:
        now, found = tried[chosen[-1]], list[TriedForm]()
        for name in names:
            if name not in varied and getattr(problem.setting, name) == "constant":
                if progress:
                    progress(len(varied) / (len(names) + 1), 1.0, f"forms of the {name.replace('_', ' ')}")
                found += _forms(now, name)
        if not found:
            break
        best = max(range(len(found)), key=lambda i: (found[i].better, found[i].score))
        tried += found
        if not found[best].better:
            break
        chosen.append(len(tried) - len(found) + best)
        varied.add(next(name for name in names if found[best].words.startswith(name.replace("_", " "))))
    if noise:
        now = tried[chosen[-1]]
        grows = (Noise(grows=True),) if len(now.fit.model.scattered) else ()
        found = [_tried(_noise_words(one), now.base, now.fit.model.smooth, one, now)
                 for one in (*grows, *(Noise(errors) for errors in ERRORS[1:]))]  # fmt: skip
        best = max(range(len(found)), key=lambda i: (found[i].better, found[i].score))
        tried += found
        if found[best].better:
            chosen.append(len(tried) - len(found) + best)
    return FormChoice(fit.law.name, tuple(tried), tuple(chosen))


def _noise_words(noise: Noise) -> str:
    return "scatter that grows with the speed" if noise.grows else f"{noise.errors} errors"


def _tried(words: str, base: Fit, smooth: tuple[Smooth, ...], noise: Noise, before: TriedForm | None) -> TriedForm:
    """Fit, and score held-out rows."""
    model = varying_model(base, smooth, noise)
    starts = [model.start()]
    if before is not None:
        starts.append(_carried(model, before.fit, starts[0]))
        if len(smooth) > len(
            before.fit.model.smooth
        ):  # (what the form that is a line reaches lies beyond a kink, perhaps)
            form = "line" if smooth[-1].parameter == "restitution" else f"linear:{smooth[-1].variable}"
            other = _refitted(base, smooth[-1].parameter, form)
            starts.append(model.start(varying_model(other).base, other.numbers))
    fits = [fit_varying(base, smooth, noise, start) for start in starts]
    fit = min(fits, key=lambda one: one.deviance + one.model.penalty(one.q)[0])
    score, rows = held_out_score(fit)
    gains = rows - before.rows if before is not None else np.zeros(len(rows))
    error = float(gains.std(ddof=1) / math.sqrt(len(rows)))
    change = fit.aicc - before.aicc if before is not None else 0.0
    return TriedForm(words, fit, base, score, rows, float(gains.mean()), error, change)


def _carried(model: VaryingModel, before: VaryingFit, start: Array) -> Array:
    """Return a start with the numbers of another fit that the model has, too, where they are of the same form."""
    q, old = start.copy(), before.model
    new, was = model.problem.setting, old.problem.setting
    changed = {place for one in PLACES for place in PLACES[one] if getattr(new, one) != getattr(was, one)}
    for i, place in enumerate(model.free.tolist()):
        if place in old.free and place not in changed:
            q[i] = before.q[old.free.tolist().index(place)]
    for name in ("smooth", "scatter", "power", "shape"):
        at, of = model.parts[name], old.parts[name]
        common = min(at.stop - at.start, of.stop - of.start)
        q[at.start : at.start + common] = before.q[of.start : of.start + common]
    return q


def _refitted(base: Fit, name: str, form: str) -> Fit:
    changed: dict[str, Any] = {name: form}
    return fit_law(base.law, replace(base.problem, setting=replace(base.problem.setting, **changed)))


def _forms(now: TriedForm, name: str) -> list[TriedForm]:
    """Return all forms of one parameter, and its best spline, on top of what was chosen."""
    forms = [form for form in FORMS if form != "constant"] if name == "restitution" else ALONG_TRIED
    words, smooth, noise = name.replace("_", " "), now.fit.model.smooth, now.fit.model.noise
    found = [_tried(f"{words} {form}", _refitted(now.base, name, form), smooth, noise, now) for form in forms]
    splines = []
    for width in WIDTHS:
        one = smooth_parameter(now.base, name, SPLINES[name], width)
        splines.append(_tried(f"{words} spline of {one.variable}", now.base, (*smooth, one), noise, now))
    return [*found, max(splines, key=lambda one: one.score)]


# ----------------------------------------------------------------------------------------------------
# Fit of a law together with a prior of flexible shape for unmeasured spins: a mixture of normal distributions.
#
# Spins before a wall are seldom normal: of shots at a cushion many roll with running side, and the others are broad. A normal
# prior in their place lets a wrong law win, by odds that grow with the rows, whose restitution or compliance takes over the part
# of the missing tail. So each law is fitted again with a mixture, whose shares, means and widths are adjusted with the law's
# parameters, by descents from a few shapes; for the two best laws a third component is tried, where two are worth their
# parameters.


MOST_COMPONENTS = 3
HOPELESS = (
    60.0  # of AICc above the best, beyond twice the largest gain so far: a law that far behind keeps its normal prior
)
FEW_STEPS = 40
COMPARED, DESCENT = {"ftol": 1e-5, "maxiter": 150}, {"ftol": 1e-8, "maxiter": 150}  # of shapes; of the best of them
LEVELS, LEAST_RISE = (1.0, 4.0), 0.25  # of the deviance: of one and two error bars; of half of one
STILL = 4.0  # of the deviance: what all that follows the comparison of shapes may still gain
LEAST_WIDTH, MOST_WIDTH, MOST_MEAN, MOST_LOGIT = 0.02, 3.0, 2.0, 7.0
MOST_MIXTURE_ROWS = 5000
LEAST_ROWS_EACH = 8  # rows whose spins were not measured, for each component
RUNNING = 0.9  # v_t/a: mean of spins near that of a ball that rolls along the wall


def may_mix(setting: Setting, problem: Problem) -> bool:
    """Return whether the shape of the prior may be adjusted: it is normal, with fitted mean and width, and the rows are
    enough, and not so many that it would take minutes."""
    free = setting.spin_prior == "normal" and setting.spin_mean is None and setting.spin_width is None
    held = {"spin_mean", "spin_width"} & {*setting.fixed, *setting.bounds}
    few = problem.spins is None or not 2 * LEAST_ROWS_EACH <= int(problem.unknown.sum()) <= MOST_MIXTURE_ROWS
    return free and not held and not few and not problem.carried


class _Joint:
    """The deviance of a law's parameters, shared errors and a mixture, as one array: means, widths and logits come last."""

    def __init__(self, model: FitModel, p: Array, components: int) -> None:
        self.model, self.p, self.count = model, p, components
        self.own = np.array([i for i in model.free if i not in (SPIN_MEAN, SPIN_WIDTH)], dtype=int)
        place = {int(one): i for i, one in enumerate(model.free)}
        self.of = [place[int(i)] for i in self.own]
        self.prior = [place[SPIN_MEAN], place[SPIN_WIDTH]]
        n, c = len(self.own), components
        self.means, self.widths, self.logits = slice(n, n + c), slice(n + c, n + 2 * c), slice(n + 2 * c, n + 3 * c - 1)
        ends = ((-MOST_MEAN, MOST_MEAN), (LEAST_WIDTH, MOST_WIDTH), (-MOST_LOGIT, MOST_LOGIT))
        self.low, self.high = (
            np.concatenate([bound[self.own], *(np.full(m, end[i]) for end, m in zip(ends, (c, c, c - 1), strict=True))])
            for i, bound in enumerate((model.low, model.high))
        )

    def packed(self, p: Array, mixture: SpinMixture) -> Array:
        """Return numbers and a mixture as one array."""
        logits = np.log(mixture.share[:-1] / mixture.share[-1])
        return np.asarray(
            np.clip(np.concatenate([p[self.own], mixture.mean, mixture.width, logits]), self.low, self.high)
        )

    def unpacked(self, q: Array) -> tuple[Array, SpinMixture]:
        """Return all numbers, with mean and width of the whole prior, and the mixture."""
        mixture = SpinMixture(np.exp(self._log_shares(q[None])[0]), q[self.means], q[self.widths])
        p, mean = self.p.copy(), float(mixture.share @ mixture.mean)
        p[self.own] = q[: len(self.own)]
        spread = mixture.share @ (np.square(mixture.width) + np.square(mixture.mean - mean))
        p[SPIN_MEAN], p[SPIN_WIDTH] = mean, float(np.sqrt(spread))
        return p, mixture

    def _log_shares(self, q: Array) -> Array:
        logits = np.concatenate([q[:, self.logits], np.zeros((len(q), 1))], axis=1)
        return np.asarray(logits - np.log(np.exp(logits).sum(axis=1, keepdims=True)))

    def __call__(self, q: Array) -> tuple[Array, Array, Array]:
        """Return deviances (B,), scores (B, k) and information (B, k, k) at q (B, k)."""
        count, k, n, c = len(q), len(self.low), len(self.own), self.count
        every = np.repeat(np.tile(self.p, (count, 1)), c, axis=0)
        every[:, self.own] = np.repeat(q[:, :n], c, axis=0)
        every[:, SPIN_MEAN], every[:, SPIN_WIDTH] = q[:, self.means].ravel(), q[:, self.widths].ravel()
        log_share = self._log_shares(q)
        seen = evaluate_components(self.model.likelihood(), every, c)
        rows, belongs = mixture_deviances(seen.deviance, log_share)
        shared = self.own >= NUMBERS
        value = rows.sum(axis=1) + np.square(q[:, :n][:, shared]).sum(axis=1)
        score, information = np.zeros((count, k)), np.zeros((count, k, k))
        scores, blocks = (np.einsum("bcn,bcn...->bc...", belongs, x) for x in (seen.scores, seen.information))
        of = [*self.of, *self.prior]
        for j in range(c):
            at = [*range(n), n + j, n + c + j]
            score[:, at] += scores[:, j][:, of]
            information[np.ix_(range(count), at, at)] += blocks[:, j][np.ix_(range(count), of, of)]
        share = np.exp(log_share)
        score[:, self.logits] = (belongs.sum(axis=2) - rows.shape[1] * share)[:, :-1]
        spread = np.einsum("bi,ij->bij", share, np.eye(c)) - share[:, :, None] * share[:, None, :]
        information[:, self.logits, self.logits] = rows.shape[1] * spread[:, :-1, :-1]
        diagonal = np.flatnonzero(shared)
        score[:, diagonal] -= q[:, diagonal]
        information[:, diagonal, diagonal] += 1
        return value, score, information

    def descend(self, starts: Sequence[Array], most: float = math.inf) -> tuple[Array, float]:
        """Return the best end point of descents, and its deviance; where all shapes end above ``most``, of the comparison alone.

        By SciPy's L-BFGS-B (Byrd, Lu, Nocedal & Zhu 1995): steps from the information with known components are too short. Of
        several, only the best is followed to its bottom.
        """
        ends = [self._descend(start, COMPARED) for start in starts] if len(starts) > 1 else [(starts[0], -math.inf)]
        best = min(ends, key=lambda end: end[1])
        return best if best[1] > most else self._descend(best[0], DESCENT)

    def half_width(self, q: Array, name: str, bar: float) -> float:
        """Return an error bar for which the profile of a law's parameter, the mixture adjusted, too, rises as it should.

        The deviance has kinks, so that its curvature at the minimum (``bar`` is the error bar from it) may be many times too large.
        """
        i = self.own.tolist().index(self.model.places[name])
        base, ends = float(self(q[None])[0][0]), {-1: q, 1: q}

        def rises(values: Array, _which: NDArray[np.int64]) -> Array:
            found = []
            for value in values.tolist():
                side = 1 if value > q[i] else -1
                start = ends[side].copy()
                start[i] = value
                ends[side], deviance = self._descend(start, COMPARED, hold=i)
                found.append(deviance - base)
            return np.array(found)

        low, high = float(self.low[i]), float(self.high[i])
        return max(half_width(rises, float(q[i]), bar * level, low, high, level)[0] for level in LEVELS)

    def _descend(self, start: Array, options: dict[str, float], hold: int | None = None) -> tuple[Array, float]:
        """Return the end point of one descent, and its deviance; one number may be held."""
        from scipy.optimize import minimize

        scale = np.sqrt(np.maximum(np.diag(self(start[None])[2][0]), 1e-9))

        def scaled(z: Array) -> tuple[float, Array]:
            value, score, _information = self((z / scale)[None])
            return float(value[0]), -2 * score[0] / scale

        bounds = np.stack([self.low, self.high], axis=-1) * scale[:, None]
        if hold is not None:
            bounds[hold] = start[hold] * scale[hold]
        end = minimize(scaled, start * scale, jac=True, method="L-BFGS-B", bounds=bounds, options=options)
        return np.clip(end.x / scale, self.low, self.high), float(end.fun)

    def information(self, q: Array) -> Array:
        """Return the information on law and shared errors, with the mixture profiled out: from differences of the scores."""
        most = np.maximum((self.high - self.low) / 20, 1e-6)
        h = observed_information(lambda at: self(at)[1], q, self(q[None])[2][0], most, self.low, self.high)
        n = len(self.own)
        return np.asarray(h[:n, :n] - h[:n, n:] @ np.linalg.solve(h[n:, n:], h[n:, :n]))


def with_flexible_prior(
    fits: list[Fit], problem: Problem, enlarge: float, progress: Callable[[str], None] = lambda _text: None
) -> tuple[list[Fit], list[Fit], list[str]]:
    """Return the fits of all laws, best first, under the shape of the spins' prior that the rows support; those under the other
    shape; and notes.

    The shape is a mixture where it is better than a normal prior by odds of 20 to 1, each with its best law. ``enlarge``: factor by
    which error bars would have to be larger for the best law to fit.
    """
    needed = 2 * math.log(DECIDED) * enlarge**2
    mixed = sorted(with_mixtures(fits, problem, progress, needed), key=lambda fit: fit.aicc)
    gain, best = fits[0].aicc - mixed[0].aicc, mixed[0]
    if best.problem.mixture is None or not gain > needed:
        return fits, mixed, []
    said = (
        f"unmeasured spins: their distribution is not normal (with a mixture of {len(best.problem.mixture.share)} normal ones AICc"
        f" is {gain:.3g} lower, {best.law.name}: {best.problem.mixture.in_words}, means in v_t/a, widths in v/a); each law is"
        " fitted with a mixture of its own"
    )
    return mixed, fits, [said]


class _Mixed(NamedTuple):
    """End of a search: a fit without error bars, where it ended, and the contribution of the scatter to the deviance."""

    fit: Fit
    joint: _Joint
    q: Array
    extra: float

    @property
    def at(self) -> tuple[Array, SpinMixture]:
        """All numbers, and the mixture."""
        return self.joint.unpacked(self.q)


def with_mixtures(
    fits: Sequence[Fit],
    problem: Problem,
    progress: Callable[[str], None] = lambda _text: None,
    needed: float = -math.inf,
) -> list[Fit]:
    """Return the fits of laws with a mixture as the prior of unmeasured spins; or without, where none is worth its parameters.

    Parameters
    ----------
    fits : sequence of Fit
        Of all laws, best first, with a normal prior of fitted mean and width.
    problem : Problem
        The rows to which they were fitted, without a scatter between contacts.
    progress : callable(text), optional
        Called with the law at hand.
    needed : float
        How much lower the least AICc has to be; else the mixtures have no error bars, which take long.
    """
    found: dict[str, _Mixed] = {}
    gain = 0.0
    for fit in fits:
        asks = feels_spins(fit.law, fit.problem) and {"spin_mean", "spin_width"} <= set(fit.names)
        if not asks or fit.aicc > fits[0].aicc + HOPELESS + 2 * gain:
            continue
        progress(fit.law.name)
        mean, width = (float(fit.numbers[i]) for i in (SPIN_MEAN, SPIN_WIDTH))
        p = fit.numbers.copy()
        p[INDEX["friction"]] = p[INDEX["friction"]] if fit.edge is None else fit.edge
        mixed = _search(fit, problem, p, fit.problem, _shapes(mean, width))
        gain = max(gain, fit.aicc - mixed.fit.aicc)
        found[fit.law.name] = mixed
    by_name = {fit.law.name: fit for fit in fits}

    def again(mixed: _Mixed, inner: _Mixed) -> _Mixed:
        fit, (p, mixture) = by_name[mixed.fit.law.name], inner.at
        return _search(fit, problem, model_of(fit.law, problem).near(p)[0], inner.fit.problem, [mixture])

    if int(problem.unknown.sum()) >= MOST_COMPONENTS * LEAST_ROWS_EACH:
        for name in sorted(found, key=lambda name: found[name].fit.aicc)[:2]:
            was, fit = found[name], by_name[name]
            if was.fit.aicc < fit.aicc:
                p, mixture = was.at
                more = _search(fit, problem, p, was.fit.problem, _split(mixture))
                found[name] = min(was, more, key=lambda one: one.fit.aicc)
    found = none_above(found, lambda mixed: mixed.fit, again)
    ends = [found[fit.law.name].fit if fit.law.name in found else fit for fit in fits]
    better = [end if end.aicc < fit.aicc else fit for fit, end in zip(fits, ends, strict=True)]
    if fits[0].aicc - min(one.aicc for one in better) < needed:
        return better
    return [fit if one is fit else _settled(fit, found) for fit, one in zip(fits, better, strict=True)]


def _search(fit: Fit, problem: Problem, p: Array, rows: Problem, mixtures: Sequence[SpinMixture]) -> _Mixed:
    """Return the best end of descents from numbers p and some shapes; its criterion is infinite where it is by far not worth its
    parameters against a normal prior. ``rows``: with the scatter between contacts so far."""

    def descend(
        rows: Problem, p: Array, mixtures: Sequence[SpinMixture], last: bool = True
    ) -> tuple[_Joint, Array, float]:
        model = model_of(fit.law, replace(rows, mixture=None))
        coarse = coarse_table(model)
        joint = _Joint(model.using(coarse), p, len(mixtures[0].share))
        normal = float(joint.model.minimize(fit.numbers[None], FEW_STEPS).value[0])
        most = normal - 2 * (mixtures[0].parameters - 2) + STILL
        q, deviance = joint.descend([joint.packed(p, one) for one in mixtures], most)
        if deviance > most:
            return joint, q, math.inf
        if coarse is not None and last:
            e, mu = (
                fit.estimates[name].stderr or 0.0 if name in fit.estimates else 0.0
                for name in ("restitution", "friction")
            )
            p, mixture = joint.unpacked(q)
            joint = _Joint(model.using(fine_table(coarse, (e, mu), float(p[INDEX["friction"]]))), p, len(mixture.share))
            q, _value = joint.descend([joint.packed(p, mixture)])
            p, mixture = joint.unpacked(q)
            exact = model_of(fit.law, replace(rows, mixture=mixture)).row_deviances(p)[0]
            deviance = float(exact.sum() + np.square(p[NUMBERS:]).sum())
        return joint, q, deviance

    scatter = (fit.scatter, fit.determinants, fit.contact_scatter)
    joint, q, deviance = descend(rows, p, mixtures, last=not problem.setting.scatter)
    if problem.setting.scatter and deviance < math.inf:
        p, mixture = joint.unpacked(q)
        held = model_of(fit.law, replace(problem, mixture=mixture)).using(joint.model.tabulated)
        again = with_contact_scatter(
            held, lambda _model: p[None], lambda at, p: at.minimize(p, FEW_STEPS).p[0], *fit.scatter.values()
        )
        scatter, rows = (again.scatter, again.extra, again.estimate), again.model.problem
        joint, q, deviance = descend(rows, again.p[0], [mixture])
    _p, mixture = joint.unpacked(q)
    sizes, extra, contacts = scatter
    done = replace(fit, problem=replace(rows, mixture=mixture), deviance=deviance + extra, scatter=sizes, contact_scatter=contacts,
                   names=tuple(name for name in fit.names if not name.startswith("spin_")))  # fmt: skip
    return _Mixed(done, joint, q, extra)


def _settled(fit: Fit, ends: dict[str, _Mixed]) -> Fit:
    """Return the fit at the end of a search, with error bars for which the mixture was adjusted, too. The laws that it contains end
    elsewhere in the same valley, or in another: an error bar that does not reach there would contradict their deviance."""
    mixed = ends[fit.law.name]
    (p, _mixture), joint = mixed.at, mixed.joint
    inner = [end for end in ends.values() if fit.law.name in end.fit.law.within]
    held = model_of(fit.law, mixed.fit.problem)
    deviance = float(held.row_deviances(p)[0].sum() + np.square(p[NUMBERS:]).sum())
    place = Place(p, deviance, joint.information(mixed.q))
    found = fit_at(held, place, mixed.fit.scatter, mixed.extra, mixed.fit.contact_scatter, joint.model.tabulated)
    for name, one in found.estimates.items():
        if one.stderr:
            i, bar = held.places[name], joint.half_width(mixed.q, name, one.stderr)
            reach = [
                abs(end.at[0][i] - p[i]) / math.sqrt(max(end.fit.deviance - mixed.fit.deviance, LEAST_RISE))
                for end in inner
            ]
            found = scaled(found, name, float(max([bar, *reach])) / one.stderr)
    return found


def _shapes(mean: float, width: float) -> list[SpinMixture]:
    """Return mixtures of two, from a normal prior: two apart, and a running side beside the others."""
    half = np.array([0.5, 0.5])
    pairs = (((mean - width, mean + width), (width, width)), ((RUNNING, mean), (0.15, 1.5 * width)))
    return [SpinMixture(half, np.array(means), np.clip(widths, 2 * LEAST_WIDTH, MOST_WIDTH)) for means, widths in pairs]


def _split(mixture: SpinMixture) -> list[SpinMixture]:
    """Return mixtures with one component more: each one is divided, into two apart and into a narrow and a wide one."""
    found = []
    for i in range(len(mixture.share)):
        for apart, narrow, wide in ((1.0, 1.0, 1.0), (0.0, 0.4, 1.6)):
            share, mean, width = (np.append(column, column[i]) for column in mixture)
            share[[i, -1]] /= 2
            mean[i], mean[-1] = mean[i] - apart * width[i], mean[i] + apart * width[i]
            width[i], width[-1] = narrow * width[i], wide * width[i]
            found.append(SpinMixture(share, mean, np.clip(width, 2 * LEAST_WIDTH, MOST_WIDTH)))
    return found
