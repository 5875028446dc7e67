"""Pooled estimates from all contacts: friction and rolling resistance of the floor, or gravity."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import NamedTuple

import numpy as np

from carom.tracks.contact import HopVerdict, TrackContact
from carom.tracks.least_squares import ContactFit, Prior

# Number of contacts above which the weight of one contact in the mean of all is negligible.
MAX_LEAVE_ONE_OUT = 400
# Relative standard deviation of a median absolute deviation, times sqrt(n).
MAD_SCATTER = 1.17


class WithError(NamedTuple):
    """An estimate and its standard deviation."""

    value: float
    error: float


class RobustMean(NamedTuple):
    """Mean of some values of which a few may be outliers."""

    mean: float
    variance: float
    """Variance of the mean."""
    between: float
    """Variance between the values beyond their errors."""


def robust_mean(values: Sequence[float], variances: Sequence[float]) -> RobustMean:
    """Return the mean of values with errors, and the variance between them, without regard to a few outliers.

    The centre is the weighted median. The spread about it is the median absolute deviation, less the share of the errors, if
    it is more than chance produces: of repeated measurements of one number half of all samples scatter more than their errors.
    """
    y, v = np.array(values), np.array(variances)
    if len(y) == 0:
        return RobustMean(np.nan, np.inf, 0.0)
    w = 1 / v
    between, most = 0.0, 1 + MAD_SCATTER / len(y) ** 0.5
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
    return RobustMean(float((w * y).sum() / w.sum()), float(1 / w.sum()), float(between))


def pool_floor(
    fits: Sequence[ContactFit | None],
    owners: Sequence[tuple[str, str]],
    priors: Sequence[Prior],
    prior: Prior,
    gravity: float,
    usable: Sequence[bool],
) -> tuple[dict[str, WithError], list[Prior]]:
    """Estimate friction and rolling resistance from all contacts, and the prior of each contact from all the others.

    Parameters
    ----------
    fits : sequence of n ContactFit or None
    owners : sequence of n
        Group and name of the track of each contact.
    priors : sequence of n Prior
        The prior that each fit used; its weight is subtracted from the result of the fit.
    prior : Prior
        That of the literature.
    gravity : float
        m/s^2.
    usable : sequence of n bool
        Which fits may be used.

    Returns
    -------
    floor : dict
        ``floor friction`` and ``rolling resistance``, if some contact determines them or they were given.
    known : list of n Prior
        Without the contact's own frames, which would count twice: contacts of the same ball that share frames with it are
        left out as well.
    """
    found: dict[str, WithError] = {}
    known = [prior] * len(fits)
    for name, label in (("mu_g", "floor friction"), ("c_g", "rolling resistance")):
        before, error = getattr(prior, name), getattr(prior, f"{name}_error")
        alone: dict[int, tuple[float, float]] = {}
        for i, fit in enumerate(fits):
            if fit is None or not usable[i] or not fit[name] > 1e-6 or not fit.error(name) > 0:
                continue  # the fit may have attributed another motion to friction, or is at a bound
            weight, was = fit.error(name) ** -2, getattr(priors[i], f"{name}_error") ** -2
            # a fit whose own frames determine less than the literature is excluded
            if weight - was > error**-2:
                alone[i] = ((weight * fit[name] - was * getattr(priors[i], name)) / (weight - was), 1 / (weight - was))
        alone = _without_shared_frames(alone, fits, owners)
        mean, variance, between = robust_mean(*_values_and_variances(alone))
        apart = between
        weight_before = 1 / error**2
        total = weight_before + (1 / variance if np.isfinite(variance) else 0.0)
        middle = (before * weight_before + (mean / variance if np.isfinite(variance) else 0.0)) / total
        if alone or error < 1e-3 * before:  # measured here, or fixed; else it is the literature's, not a result
            found[label] = WithError(middle / gravity, total**-0.5 / gravity)
        for i in range(len(fits)):
            if len(alone) <= MAX_LEAVE_ONE_OUT:
                others = {
                    j: one for j, one in alone.items() if owners[i] != owners[j] or not _share_frames(fits[i], fits[j])
                }
                mean, variance, apart = robust_mean(*_values_and_variances(others))
            if i in alone:
                known[i] = replace(known[i], **{f"{name}_between": between})
            if np.isfinite(variance):
                spread = variance + apart
                # the literature's prior, with its small weight
                weights = np.array([1 / spread, weight_before])
                value = float((weights * [mean, before]).sum() / weights.sum())
                known[i] = replace(
                    known[i], **{name: max(value, 1e-3 * before), f"{name}_error": float(weights.sum() ** -0.5)}
                )
    return found, known


def shared_fraction(own: float, prior_error: float, between: float | None) -> float:
    """Return the fraction of the floor's error in a contact's fit that it shares with the mean of all contacts.

    The prior of the fit had the error T (``prior_error``), the fit has s (``own``), so its own frames determine the floor with
    v = s^2 / (1 - s^2/T^2). Their error enters the mean of all with the weight 1/(v + b^2), b^2 the variance ``between``
    contacts, and the error of the mean enters the prior: v/(v + b^2) of both. For a contact that is not in the mean (None) the
    fraction is that of the prior, s^2/T^2.
    """
    rest = min((own / prior_error) ** 2, 1.0)
    together = 0.0 if between is None else own**2 + (1 - rest) * between
    return own**2 / together if together > 0 else rest


def _without_shared_frames(
    alone: dict[int, tuple[float, float]], fits: Sequence[ContactFit | None], owners: Sequence[tuple[str, str]]
) -> dict[int, tuple[float, float]]:
    """Keep the most precise contacts, so that each frame is used once: between two walls a frame is in two fits."""
    kept: dict[tuple[str, str], list[int]] = {}
    for i in sorted(alone, key=lambda i: alone[i][1]):
        same = kept.setdefault(owners[i], [])
        if not any(_share_frames(fits[i], fits[j]) for j in same):
            same.append(i)
    return {i: alone[i] for i in sorted(i for same in kept.values() for i in same)}


def _share_frames(one: ContactFit | None, other: ContactFit | None) -> bool:
    """Return whether two fits of a ball have frames in common."""
    if one is None or other is None:
        return one is other
    return bool(one.time[0] <= other.time[-1] and other.time[0] <= one.time[-1])


def _values_and_variances(alone: dict[int, tuple[float, float]]) -> tuple[list[float], list[float]]:
    return [one[0] for one in alone.values()], [one[1] for one in alone.values()]


def pool_gravity(fits: Sequence[ContactFit | None]) -> dict[str, WithError]:
    """Estimate gravity, m/s^2, from all parabolas."""
    good = [fit for fit in fits if fit is not None]
    size = [float(np.hypot(fit["mu_g"], fit["c_g"])) for fit in good]
    mean, variance, between = robust_mean(size, [max(fit.error("mu_g"), 1e-9) ** 2 for fit in good])
    return {"gravity": WithError(mean, float(np.sqrt(variance + between / max(len(good), 1))))} if good else {}


# ----------------------------------------------------------------------------------------------------
# Whether a ball on a table hops off a wall: decided from all contacts with it.
#
# A wall that a ball touches at its centre lifts a ball that rolls into it, by its friction; the nose of a cushion, above the
# centre, presses the ball down. The frames of one contact seldom show which, but the hop that a wall at the centre would cause
# follows from the spin after the contact, which the fit determines: contacts that are fitted better with this hop than without
# it, or worse, add up to a verdict. After hops the velocities after the wall come from a fit with a hop of any length; in doubt
# they are the mean of both, weighted with the odds, and their error bars contain the difference.
#
# Between these heights, up to about 1.15 radii above the floor, a wall causes shorter hops. Frames do not distinguish them from
# none.


DECISIVE = 9.2  # sum of the differences of chi2: odds of 100 to 1
MOST = 9.2  # the share of one contact in the sum: it may be mistracked


def with_hops(contacts: Sequence[TrackContact], known: bool | None = None, doubtful: bool = True) -> list[TrackContact]:
    """Return the contacts with the verdict on hops, and with a hop where balls hop; means of both where it is ``doubtful``.

    ``known``: whether balls hop, if that is known.
    """
    walls: dict[str, float] = {}
    for one in contacts:
        walls[one.wall.name] = walls.get(one.wall.name, 0.0) + hop_excess(one)
    together = sum(walls.values())  # walls that do not decide by themselves are taken to be like the others
    if known is not None:
        walls, together = dict.fromkeys(walls, 0.0), -np.inf if known else np.inf
    return [_with_hop(one, walls[one.wall.name], together, doubtful) for one in contacts]


def hop_excess(one: TrackContact) -> float:
    """Return a contact's part of the sum for all: the rise of chi2 by a hop, within MOST."""
    return 0.0 if one.fit is None else float(np.clip(one.fit.hop_chi2, -MOST, MOST))


def _with_hop(one: TrackContact, excess: float, together: float, doubtful: bool) -> TrackContact:
    """Return a contact as it is with a hop, as far as the excess of chi2 of a wall, or of all of them, does not exclude it."""
    excess = excess if abs(excess) >= DECISIVE else together
    hopping = one.fit.hopping if one.fit is not None else None
    if one.fit is None or hopping is None or excess >= DECISIVE:
        return one
    verdict: HopVerdict = "seen" if excess <= -DECISIVE else "possible"
    if verdict == "possible" and not doubtful:
        return one
    share = 1.0 if verdict == "seen" else 1 / (1 + float(np.exp(excess / 2)))
    fit = averaged(one.fit, hopping, share)
    return replace(one, fit=fit, scatter=fit.noise * float(np.sqrt(fit.chi2 / max(fit.dof, 1))), hop=verdict)


def averaged(one: ContactFit, other: ContactFit, share: float) -> ContactFit:
    """Return the mean of two fits with the probability ``share`` of the second; its errors contain the difference between them."""
    gap = np.nan_to_num(other.value - one.value)  # (what one of them does not have stays as it is)
    covariance = one.covariance + share * (other.covariance - one.covariance)
    return replace(
        one if share < 0.5 else other, value=one.value + share * gap,
        covariance=covariance + share * (1 - share) * np.outer(gap, gap), hop_chi2=one.hop_chi2,
    )  # fmt: skip


def hop_notes(contacts: Sequence[TrackContact]) -> list[str]:
    """Return a note for each wall off which balls hop, or may hop."""
    notes = []
    for name in dict.fromkeys(one.wall.name for one in contacts):
        verdicts = {one.hop for one in contacts if one.fit is not None and one.wall.name == name}
        if "seen" in verdicts:
            notes.append(
                f"wall {name}: the ball hops off it; the rebounds are of balls that roll again (`stage` after_wall: as they"
                " leave the wall)"
            )
        elif "possible" in verdicts:
            notes.append(
                f"wall {name}: the frames do not show whether the ball hops off it, as off a wall that it touches at its centre, or"
                " stays down, as under the nose of a cushion: the error bars of the velocity after the wall include both, and the"
                " rebounds are of balls that roll again, which a hop does not affect"
            )
    return notes
