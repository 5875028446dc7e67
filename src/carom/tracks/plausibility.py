"""Whether measured contacts are possible: restitutions of at most 1, free motion between them, a floor or a gravity that exists."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence

import numpy as np

from carom.errors import shortened_list
from carom.tracks.contact import SMOOTH_TURN, TrackContact, View
from carom.tracks.flights import Air
from carom.tracks.floor import WithError
from carom.tracks.least_squares import OUTPUTS, ContactFit

BEYOND = 3.0  # error bars by which a restitution has to exceed 1
MAX_SHARE_IMPOSSIBLE, MAX_SHARE_SCATTERED = 0.2, 0.5
MOSTLY = 0.75  # of a variance
MIN_JUDGED = 2  # contacts; a single one does not tell a view
MAX_CLOTH_FRICTION = 0.6  # of gravity a ball in flight would show 1
GRAVITY_TOLERANCE = 0.3


def restitutions_in_words(contacts: Sequence[TrackContact]) -> str:
    """Return the restitutions of the contacts that were measured, with their errors, for a note."""
    fits = [one.fit for one in contacts if one.fit is not None]
    each = [f"{ratio:.3f} ± {error:.1g}" for ratio, error in (fit.restitution for fit in fits if fit["vn_in"] < 0)]
    return shortened_list(each, 4) if each else "not measured"


def impossible(one: TrackContact) -> bool:
    """Return whether the ball leaves the wall faster than it came, beyond the error bar: no wall at rest does that."""
    return one.fit is not None and _gains(one.fit)


def _gains(fit: ContactFit) -> bool:
    if -fit["vn_in"] <= BEYOND * fit.error("vn_in"):  # it does not come towards the wall
        return False
    variance = fit.error("vn_in") ** 2 + fit.error("vn_out") ** 2 + 2 * fit.covariance_of("vn_in", "vn_out")
    return fit["vn_out"] + fit["vn_in"] > BEYOND * float(np.sqrt(max(variance, 0.0)))


def restitution_note(contacts: Sequence[TrackContact]) -> list[str]:
    """Return a note on contacts whose restitution exceeds 1 beyond the error bar."""
    fits = [one.fit for one in contacts if one.fit is not None]
    worst = [fit for fit in fits if _gains(fit)]
    if not worst:
        return []
    most = max(worst, key=lambda fit: -fit["vn_out"] / fit["vn_in"])
    count = f"{len(worst)} of {len(fits)} contacts have" if len(fits) > 1 else "the contact has"
    return [
        f"{count} a restitution above 1 beyond the error bar, up to {-most['vn_out'] / most['vn_in']:.3g} at t ="
        f" {most['t']:.4g} s: no wall at rest gives back more than it gets; is the view (`view`), scale or frame rate wrong?"
    ]


def shared_error_notes(contacts: Sequence[TrackContact], air: Air) -> list[str]:
    """Return notes on what all contacts of a film share and its flights do not show, if it makes most of the errors of results."""
    told = []
    drag = _share(contacts, "drag", ("vn_in", "vn_out"), lambda before, after: (-1 / before, 1 / after))
    if drag > MOSTLY and not air.drag_shown:
        told.append(
            "air drag: the flights do not show whether the air slows the ball down"
            f" (k = {air.drag_per_metre:.2g} ± {air.drag_error:.1g} 1/m is taken); this makes the error bars of the restitution"
            f" {(1 - drag) ** -0.5:.1f} times as large as with a drag that is known"
        )
    roll = _share(contacts, "roll", ("vt_in", "vt_out"), lambda _before, _after: (-1.0, 1.0))
    if roll > MOSTLY:
        told.append(
            f"camera roll: the flights show to {np.degrees(air.tilt_error):.1g}° only where down is; this makes the error bars of"
            f" the change of v_t, and so of friction, {(1 - roll) ** -0.5:.1f} times as large as with a floor whose line is known"
            " (`wall` gives it)"
        )
    return told


def _share(
    contacts: Sequence[TrackContact],
    cause: str,
    names: tuple[str, str],
    rates: Callable[[float, float], tuple[float, float]],
) -> float:
    """Return the median share of a cause in the variances of a result; ``rates``: its derivatives by two velocities."""
    shares = []
    both = [OUTPUTS.index(name) for name in names]
    for one in contacts:
        fit = one.fit
        if fit is None or cause not in fit.shifts or not (fit["vn_out"] > 0 > fit["vn_in"]):
            continue
        rate = np.array(rates(fit["vn_in"], fit["vn_out"]))
        variance = float(rate @ fit.covariance[np.ix_(both, both)] @ rate)
        shares.append(min(float(rate @ fit.shifts[cause][both]) ** 2 / max(variance, 1e-300), 0.9999))
    return float(np.median(shares)) if shares else 0.0


def why_implausible(
    contacts: Sequence[TrackContact], view: View, floor: Mapping[str, WithError], gravity: float
) -> str:
    """Return objections to the view in which contacts were measured; empty if nothing does, or too few were measured."""
    judged = [one for one in contacts if np.isfinite(one.scatter)]
    if len(judged) < MIN_JUDGED:
        return ""
    fits = [one.fit for one in judged if one.fit is not None]
    if len(judged) - len(fits) > MAX_SHARE_SCATTERED * len(judged):
        return _why_not_free(judged)
    bad = sum(map(_gains, fits))
    if bad >= max(MIN_JUDGED, MAX_SHARE_IMPOSSIBLE * len(judged)):
        return f"{bad} of {len(fits)} restitutions are above 1 beyond their error bars"
    friction = floor.get("floor friction")
    if view == "above" and friction is not None and friction.value - BEYOND * friction.error > MAX_CLOTH_FRICTION:
        return f"the floor's friction comes out as {friction.value:.2g}"
    found = floor.get("gravity")
    if view == "side" and found is not None and abs(found.value / gravity - 1) > GRAVITY_TOLERANCE:
        return f"gravity comes out as {found.value:.3g} m/s^2"
    return ""


def _why_not_free(judged: Sequence[TrackContact]) -> str:
    """Return why most contacts are none: the ball turns smoothly in most places, or scatters."""
    smooth = sum(one.why == SMOOTH_TURN for one in judged)
    if smooth > MAX_SHARE_SCATTERED * len(judged):
        return f"the ball turns in a smooth curve in {smooth} of {len(judged)} places: no contacts"
    lost = sum(one.fit is None for one in judged)
    return f"{lost} of {len(judged)} contacts scatter far more than free motion beside a wall"
