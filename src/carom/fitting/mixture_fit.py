"""Fit of a law together with a prior of flexible shape for unmeasured spins: a mixture of normal distributions.

Spins before a wall are seldom normal: of shots at a cushion many roll with running side, and the others are broad. A normal prior
in their place lets a wrong law win, by odds that grow with the rows, whose restitution or compliance takes over the part of the
missing tail. So each law is fitted again with a mixture, whose shares, means and widths are adjusted with the law's parameters, by
descents from a few shapes; for the two best laws a third component is tried, where two are worth their parameters.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import replace
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from carom.fitting.data import Problem
from carom.fitting.deviance import SPIN_MEAN, SPIN_WIDTH
from carom.fitting.evidence import DECIDED
from carom.fitting.fit import Place, fit_at
from carom.fitting.model import FitModel, feels_spins, model_of
from carom.fitting.optimizer import observed_information
from carom.fitting.parameters import INDEX, NUMBERS
from carom.fitting.result import Estimate, Fit
from carom.fitting.scatter import with_contact_scatter
from carom.fitting.setting import Setting
from carom.fitting.spin_mixture import SpinMixture, evaluate_components, mixture_deviances
from carom.fitting.tabulated import coarse_table, fine_table

__all__ = ["may_mix", "with_flexible_prior", "with_mixtures"]

Array = NDArray[np.float64]
MOST_COMPONENTS = 3
HOPELESS = (
    60.0  # of AICc above the best, beyond twice the largest gain so far: a law that far behind keeps its normal prior
)
FEW_STEPS = 40
COMPARED, DESCENT = {"ftol": 1e-5, "maxiter": 150}, {"ftol": 1e-8, "maxiter": 150}  # of shapes; of the best of them
STILL = 4.0  # of the deviance: what all that follows the comparison of shapes may still gain
LEAST_WIDTH, MOST_WIDTH, MOST_MEAN, MOST_LOGIT = 0.02, 3.0, 2.0, 7.0
MOST_ROWS = 5000
LEAST_ROWS_EACH = 8  # rows whose spins were not measured, for each component
RUNNING = 0.9  # v_t/a: mean of spins near that of a ball that rolls along the wall


def may_mix(setting: Setting, problem: Problem) -> bool:
    """Return whether the shape of the prior may be adjusted: it is normal, with fitted mean and width, and the rows are
    enough, and not so many that it would take minutes."""
    free = setting.spin_prior == "normal" and setting.spin_mean is None and setting.spin_width is None
    held = {"spin_mean", "spin_width"} & {*setting.fixed, *setting.bounds}
    few = problem.spins is None or not 2 * LEAST_ROWS_EACH <= int(problem.unknown.sum()) <= MOST_ROWS
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

    def _descend(self, start: Array, options: dict[str, float]) -> tuple[Array, float]:
        """Return the end point of one descent, and its deviance."""
        from scipy.optimize import minimize

        scale = np.sqrt(np.maximum(np.diag(self(start[None])[2][0]), 1e-9))

        def scaled(z: Array) -> tuple[float, Array]:
            value, score, _information = self((z / scale)[None])
            return float(value[0]), -2 * score[0] / scale

        bounds = np.stack([self.low, self.high], axis=-1) * scale[:, None]
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
    mixed = sorted(with_mixtures(fits, problem, progress), key=lambda fit: fit.aicc)
    gain, best = fits[0].aicc - mixed[0].aicc, mixed[0]
    if best.problem.mixture is None or not gain > 2 * math.log(DECIDED) * enlarge**2:
        return fits, mixed, []
    said = (
        f"unmeasured spins: their distribution is not normal (with a mixture of {len(best.problem.mixture.share)} normal ones AICc"
        f" is {gain:.3g} lower, {best.law.name}: {best.problem.mixture.in_words}, means in v_t/a, widths in v/a); each law is"
        " fitted with a mixture of its own"
    )
    return mixed, fits, [said]


class _Mixed(NamedTuple):
    """End of a search: what :func:`carom.fitting.fit.fit_at` takes, and the criterion."""

    aicc: float
    p: Array
    problem: Problem
    joint: _Joint
    q: Array
    scatter: tuple[dict[str, float], float, Estimate | None]


def with_mixtures(
    fits: Sequence[Fit], problem: Problem, progress: Callable[[str], None] = lambda _text: None
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
    """
    found: dict[str, _Mixed] = {}
    gain = 0.0
    for fit in fits:
        asks = feels_spins(fit.law, fit.problem) and {"spin_mean", "spin_width"} <= set(fit.names)
        if not asks or fit.aicc > fits[0].aicc + HOPELESS + 2 * gain:
            continue
        progress(fit.law.name)
        mean, width = (float(fit.numbers[i]) for i in (SPIN_MEAN, SPIN_WIDTH))
        mixed = _search(fit, problem, fit.numbers, fit.problem, _shapes(mean, width))
        gain = max(gain, fit.aicc - mixed.aicc)
        found[fit.law.name] = mixed
    by_name = {fit.law.name: fit for fit in fits}
    if int(problem.unknown.sum()) >= MOST_COMPONENTS * LEAST_ROWS_EACH:
        for name in sorted(found, key=lambda name: found[name].aicc)[:2]:
            was, fit = found[name], by_name[name]
            if was.aicc < fit.aicc:
                more = _search(fit, problem, was.p, was.problem, _split(was.joint.unpacked(was.q)[1]))
                found[name] = min(was, more, key=lambda one: one.aicc)
    return [
        _settled(fit, found[fit.law.name]) if fit.law.name in found and found[fit.law.name].aicc < fit.aicc else fit
        for fit in fits
    ]


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
    p, mixture = joint.unpacked(q)
    done = replace(fit, problem=replace(rows, mixture=mixture), deviance=deviance + scatter[1], scatter=scatter[0],
                   names=tuple(name for name in fit.names if not name.startswith("spin_")))  # fmt: skip
    return _Mixed(done.aicc, p, done.problem, joint, q, scatter)


def _settled(fit: Fit, mixed: _Mixed) -> Fit:
    """Return the fit at the end of a search, with error bars for which the mixture was adjusted, too."""
    scatter, extra, contacts = mixed.scatter
    held, table = model_of(fit.law, mixed.problem), mixed.joint.model.tabulated
    deviance = float(held.row_deviances(mixed.p)[0].sum() + np.square(mixed.p[NUMBERS:]).sum())
    place = Place(mixed.p, deviance, mixed.joint.information(mixed.q))
    return fit_at(held, place, scatter, extra, contacts, table)


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
