"""A ranking as JSON holds it; a number with its error bar as people read it."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

from carom.fitting.parameters import NUMBERS
from carom.fitting.ways import GIVEN

if TYPE_CHECKING:
    from carom.fitting.fit import Estimate, Fit
    from carom.fitting.rank import Ranked, Ranking

__all__ = ["as_dict", "with_error_bar"]


def _finite(value: float | None) -> float | None:
    return float(value) if value is not None and math.isfinite(value) else None


def _estimate(estimate: Estimate) -> dict[str, Any]:
    found: dict[str, Any] = {"value": _finite(estimate.value), "stderr": _finite(estimate.stderr)}
    if estimate.interval_68 and estimate.interval_95:
        found |= {"interval_68": list(estimate.interval_68), "interval_95": list(estimate.interval_95)}
    if estimate.bootstrap is not None:
        found["bootstrap_stderr"] = _finite(estimate.bootstrap)
    if estimate.shared is not None:
        found["shared_stderr"] = _finite(estimate.shared)
    if estimate.note:
        found["note"] = estimate.note
    return found


def _covariance(fit: Fit) -> list[list[float | None]]:
    return [[_finite(x) for x in row] for row in fit.covariance.tolist()]


def _law(one: Ranked) -> dict[str, Any]:
    fit = one.fit
    return {
        "law": fit.law.name,
        "aicc": _finite(fit.aicc),
        "bic": _finite(fit.bic),
        "weight": one.weight,
        "cross_validated_log_score": _finite(one.score),
        "chi2": _finite(fit.chi2),
        "dof": fit.dof,
        "parameters": {name: _estimate(estimate) for name, estimate in fit.estimates.items()},
        "covariance": {"names": list(fit.names), "matrix": _covariance(fit)},
        "scatter": fit.scatter,
        "shared_errors": dict(
            zip((one.name for one in fit.problem.shared), fit.numbers[NUMBERS:].tolist(), strict=True)
        ),
    }


def as_dict(ranking: Ranking) -> dict[str, Any]:
    """Everything but the rows."""
    return {
        "ranking": [_law(one) for one in ranking.ranked],
        "degenerate": [
            {"law": one.fit.law.name, "parameters": list(one.fit.untold), "what": sentence}
            for one in ranking.ranked
            for sentence in one.fit.degenerate
        ],
        "verdict": ranking.verdict,
        "odds": _finite(ranking.odds),
        "against": ranking.against or None,
        "fits": ranking.fits,
        "enlarge_error_bars": ranking.enlarge,
        "outliers": [vars(outlier) for outlier in ranking.outliers],
        "swayed_by_outliers": ranking.swayed,
        "notes": list(ranking.notes),
        "rows": len(ranking.best.problem.x),
        "setting": {name: getattr(ranking.best.problem.setting, name) for name in ("radius", *GIVEN)},
    }


def with_error_bar(estimate: Estimate, *, interval: bool = False) -> str:
    """A value with its error bar, in as many digits as that is worth; with its 95 % interval, if it has one and is asked to."""
    if estimate.value is None:
        return f"? ({estimate.note})"
    if estimate.stderr is None or not estimate.stderr > 0:
        return f"{estimate.value:.4g} ({estimate.note or 'at its bound'})"
    places = max(0, 1 - math.floor(math.log10(estimate.stderr)))
    said = f"{estimate.value:.{places}f} ± {estimate.stderr:.{places}f}"
    if estimate.shared is not None:
        said += f" ± {estimate.shared:.{places}f}"
    if interval and estimate.interval_95:
        said += f" (95 %: {estimate.interval_95[0]:.{places}f} to {estimate.interval_95[1]:.{places}f})"
    return said
