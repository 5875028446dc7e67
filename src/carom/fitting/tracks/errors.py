"""Covariance of the shared parameters of whole tracks, and what the tracks do not identify."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from carom.fitting.by_shots import covariance_by_shot
from carom.fitting.identifiability import NOT_IDENTIFIABLE, identify, parameter_ranges
from carom.fitting.result import Estimate, without_estimate
from carom.fitting.tracks.objective import BestStarts, descend, projected, settle, shared_slope
from carom.fitting.tracks.result import TrackFit

__all__ = ["MISFIT_AS_NOISE", "ambiguous", "with_errors"]

Array = NDArray[np.float64]
MISFIT_AS_NOISE = "the law does not follow the frames; error bar as if their distances were correlated noise"
LEAST_SHOTS = 5  # for error bars from the scatter of shots
FOLLOWING_STEPS = 5  # of the starts after a parameter has been changed


def misfit_as_noise(gap: Array, count: NDArray[np.int64], dof: float) -> float:
    """Return by how much variances grow if the gaps (N, 2 T), in standard deviations, are noise that fades from frame to frame.

    With the correlation r of neighbours a mean has (1 + r) / (1 - r) times the variance that independent frames would give it, at
    most that of one free number a segment; ``count`` (N,): frames of each.
    """
    steps = gap.reshape(len(gap), -1, 2)
    r = max(float((steps[:, 1:] * steps[:, :-1]).sum()) / max(float((gap * gap).sum()), 1e-300), 0.0)
    length = min((1 + r) / max(1 - r, 1e-9), float(count.mean()))
    return float(max((gap * gap).sum() / max(dof, 1.0) * length, 1.0))


class _Subject:
    """A fit of whole tracks, for :func:`carom.fitting.identifiability.identify`.

    If the law follows the frames, the covariance is computed from derivatives and the noise, with all starts free. If not,
    residuals are correlated from frame to frame; only shots are independent, and the covariance is computed from the scores of
    shots, each corrected for how much of the information is its own (CR2 of Bell & McCaffrey, Survey Methodology 28, 169 (2002));
    of fewer than five shots their segments are taken as independent, and of fewer than five segments the covariance is enlarged as
    by noise of this size and correlation.
    The design effect is the median over the parameters of this variance over the variance of independent frames.
    """

    def __init__(self, fit: TrackFit, settled: BestStarts) -> None:
        self.fit, self.label, self.names, self.trade_offs = fit, fit.law.name, fit.names, False
        self.parameters = tuple(fit.model.free.values())
        self.values = np.array([fit.numbers[name] for name in self.names])
        self.ranges = parameter_ranges(self.parameters, self.values)
        rest = projected(settled, fit.starts, shared_slope(fit.model, fit.frames, settled.q, fit.numbers))
        by_segment = np.einsum("ntp,ntq->npq", rest, rest)
        self.information = by_segment.sum(axis=0)
        each = np.einsum("ntp,nt->np", rest, settled.residual(fit.starts))
        # (of few shots the balls: each has walls of its own)
        groups = fit.frames.groups
        groups = groups if len(groups) >= LEAST_SHOTS else [np.array([n]) for n in range(len(each))]
        self.scores = np.array([each[rows].sum(axis=0) for rows in groups])
        self.by_shot = np.array([by_segment[rows].sum(axis=0) for rows in groups])
        self.by_shots, self.design_effect = False, 1.0
        self.misfit = misfit_as_noise(settled.gap, fit.frames.count, fit.dof)

    def covariance(self, inside: NDArray[np.int64]) -> Array:
        """Return the covariance of some parameters."""
        independent = np.linalg.inv(self.information[np.ix_(inside, inside)])
        self.by_shots = not self.fit.follows and len(self.scores) >= LEAST_SHOTS
        if not self.by_shots:
            if not self.fit.follows:
                self.design_effect = self.misfit
            return np.asarray(self.design_effect * independent)
        both = np.ix_(inside, inside)
        by_shot = np.array([one[both] for one in self.by_shot])
        found = covariance_by_shot(self.information[both], self.scores[:, inside], by_shot)
        self.design_effect = float(max(np.median(np.diag(found) / np.diag(independent)), 1.0))
        return found

    def rise(self, i: int, value: float) -> float:
        """Return the deviance above its minimum with one shared parameter changed and the starts fitted again."""
        fit = self.fit
        table = fit.model.table({**fit.numbers, self.names[i]: value})
        return float(settle(table, fit.frames, fit.starts, fit.q, FOLLOWING_STEPS).cost.sum()) - fit.chi2

    def refit_rises(self, i: int, values: Array, start: Array | None = None) -> tuple[Array, Array]:
        """Return the profile above its minimum, and the shared parameters there."""
        return held_rises(self.fit, self.names[i], values, start)


def held_rises(fit: TrackFit, name: str, values: Array, start: Array | None = None) -> tuple[Array, Array]:
    """Return the rise of chi^2 (m,) with a parameter held at values (m,) and all else fitted, from the minimum or from parameters
    ``start`` (m, P), and the parameters (m, P) there."""
    rises, found = [], []
    for j, value in enumerate(values.tolist()):
        begin = fit.numbers if start is None else fit.numbers | dict(zip(fit.names, start[j].tolist(), strict=True))
        numbers, settled = descend(fit.model.holding(name, value), fit.frames, fit.starts, fit.q, begin, lambda: None)
        rises.append(float(settled.cost.sum()) - fit.chi2)
        found.append([(numbers | {name: value})[other] for other in fit.names])
    return np.array(rises), np.array(found)


def with_errors(fit: TrackFit, settled: BestStarts) -> TrackFit:
    """Return the fit with covariance, estimates, and sentences on parameters that are not identifiable."""
    if not fit.names:
        return fit
    subject = _Subject(fit, settled)
    found = identify(subject)
    note: dict[str, Any] = {} if fit.follows or subject.by_shots else {"note": MISFIT_AS_NOISE}
    estimates = {name: one if one.stderr is None else replace(one, **note) for name, one in found.estimates.items()}
    return replace(fit, **{**vars(found), "estimates": estimates}, design_effect=subject.design_effect)


def ambiguous(fit: TrackFit, name: str, other: float) -> TrackFit:
    """Return the fit without an estimate of a parameter for which two values fit equally well."""
    here = fit.numbers[name]
    said = (
        f"{fit.law.name}: {name}: {min(here, other):.4g} and {max(here, other):.4g} fit equally well: a contact is at the edge"
        " between sliding and sticking; film another shot"
    )
    found: TrackFit = without_estimate(fit, name, Estimate(None, None, NOT_IDENTIFIABLE), said)
    return found
