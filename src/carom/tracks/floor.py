"""What all contacts together say of the floor: the friction of the cloth, the rolling resistance; or of gravity."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from carom.tracks.fitted import Fitted, Prior

__all__ = ["cloth", "combined", "shared_part", "weight"]

# Of so many contacts, one's own share in what all say is nothing.
MANY = 400
# By how much of themselves median deviations scatter, times sqrt(n).
BY_CHANCE = 1.17


def combined(values: Sequence[float], variances: Sequence[float]) -> tuple[float, float, float]:
    """Mean, its variance, and the variance between the values beyond their errors; few wild values have no say.

    The weighted median; the spread about it by the median deviation, of which the errors' own share is taken where it is more than
    chance does: of one number, measured many times, half of all samples scatter more than their errors.
    """
    y, v = np.array(values), np.array(variances)
    if len(y) == 0:
        return np.nan, np.inf, 0.0
    w = 1 / v
    between, most = 0.0, 1 + BY_CHANCE / len(y) ** 0.5
    for _ in range(20):
        order = np.argsort(y)
        share = np.cumsum(w[order]) / w.sum()
        middle = float(y[order][np.searchsorted(share, 0.5)])
        wild = float(np.median(np.abs(y - middle) / np.sqrt(v + between))) / 0.6745
        if len(y) < 4 or (wild <= most if between == 0 else abs(wild - 1) <= 0.02):
            break
        between = max(wild**2 * float(np.median(v + between)) - float(np.median(v)), 0.0)
        w = 1 / (v + between)
    good = np.abs(y - middle) < 3 * np.sqrt(v + between)
    w, y = w[good], y[good]
    return float((w * y).sum() / w.sum()), float(1 / w.sum()), float(between)


def cloth(
    fits: Sequence[Fitted | None],
    owners: Sequence[tuple[str, str]],
    told: Sequence[Prior],
    prior: Prior,
    gravity: float,
    sure: Sequence[bool],
) -> tuple[dict[str, tuple[float, float]], list[Prior]]:
    """Friction and rolling resistance with errors, where some contact tells them, and what each may know from all the others.

    ``told``: what each fit was told before, which is taken off what it says; ``prior``: what the literature has; ``sure``: which
    fits have a say. Each fit's own frames are taken out of what it is told, or they would count twice: with it go the contacts of
    the same ball (``owners``) whose frames it shares, before or after.
    """
    found: dict[str, tuple[float, float]] = {}
    known = [prior] * len(fits)
    for name, label in (("mu_g", "cloth friction"), ("c_g", "rolling resistance")):
        before, error = getattr(prior, name), getattr(prior, f"{name}_error")
        alone: dict[int, tuple[float, float]] = {}
        for i, fit in enumerate(fits):
            if fit is None or not sure[i] or not fit[name] > 1e-6 or not fit.error(name) > 0:
                continue  # it may have taken another motion for the floor; or is at the edge of what is allowed
            weight, was = fit.error(name) ** -2, getattr(told[i], f"{name}_error") ** -2
            # a fit whose own frames say less than the literature has no say
            if weight - was > error**-2:
                alone[i] = ((weight * fit[name] - was * getattr(told[i], name)) / (weight - was), 1 / (weight - was))
        alone = _once(alone, fits, owners)
        mean, variance, between = combined(*_both(alone))
        apart = between
        weight_before = 1 / error**2
        total = weight_before + (1 / variance if np.isfinite(variance) else 0.0)
        middle = (before * weight_before + (mean / variance if np.isfinite(variance) else 0.0)) / total
        if alone or error < 1e-3 * before:  # measured here, or fixed; else it is what the literature has, no finding
            found[label] = (middle / gravity, total**-0.5 / gravity)
        for i in range(len(fits)):
            if len(alone) <= MANY:
                others = {j: one for j, one in alone.items() if owners[i] != owners[j] or not _share(fits[i], fits[j])}
                mean, variance, apart = combined(*_both(others))
            if i in alone:
                known[i] = replace(known[i], **{f"{name}_between": between})
            if np.isfinite(variance):
                spread = variance + apart
                # before pooling, as a weak opinion among many
                weights = np.array([1 / spread, weight_before])
                value = float((weights * [mean, before]).sum() / weights.sum())
                known[i] = replace(
                    known[i], **{name: max(value, 1e-3 * before), f"{name}_error": float(weights.sum() ** -0.5)}
                )
    return found, known


def shared_part(own: float, told: float, between: float | None) -> float:
    """How much of the floor's error in a contact's fit is that of what all contacts say.

    The fit was told the floor with an error T and has s left (``own``), so its own frames say it with v = s^2 / (1 - s^2/T^2).
    Their error is in the mean of all, by its weight 1/(v + b^2), b^2 the variance ``between`` contacts, and the mean's error in
    what the fit was told: v/(v + b^2) of both. Of a contact that is not in the mean (None): what it was told, s^2/T^2.
    """
    rest = min((own / told) ** 2, 1.0)
    return rest if between is None else own**2 / (own**2 + (1 - rest) * between)


def _once(
    alone: dict[int, tuple[float, float]], fits: Sequence[Fitted | None], owners: Sequence[tuple[str, str]]
) -> dict[int, tuple[float, float]]:
    """Those that say most, each frame in one of them: between two walls a ball's frames are in two fits."""
    kept: dict[tuple[str, str], list[int]] = {}
    for i in sorted(alone, key=lambda i: alone[i][1]):
        same = kept.setdefault(owners[i], [])
        if not any(_share(fits[i], fits[j]) for j in same):
            same.append(i)
    return {i: alone[i] for i in sorted(i for same in kept.values() for i in same)}


def _share(one: Fitted | None, other: Fitted | None) -> bool:
    """Whether two fits of a ball have frames in common."""
    if one is None or other is None:
        return one is other
    return bool(one.time[0] <= other.time[-1] and other.time[0] <= one.time[-1])


def _both(alone: dict[int, tuple[float, float]]) -> tuple[list[float], list[float]]:
    return [one[0] for one in alone.values()], [one[1] for one in alone.values()]


def weight(
    fits: Sequence[Fitted | None],
    owners: Sequence[tuple[str, str]],
    told: Sequence[Prior],
    prior: Prior,
    gravity: float,
    sure: Sequence[bool],
) -> tuple[dict[str, tuple[float, float]], list[Prior]]:
    """The gravity that the parabolas show, with its error; nothing that a fit would be told."""
    good = [fit for fit in fits if fit is not None]
    size = [float(np.hypot(fit["mu_g"], fit["c_g"])) for fit in good]
    mean, variance, between = combined(size, [max(fit.error("mu_g"), 1e-9) ** 2 for fit in good])
    del gravity, owners, told, sure
    return ({"gravity": (mean, float(np.sqrt(variance + between / max(len(good), 1))))} if good else {}), [prior] * len(
        fits
    )
