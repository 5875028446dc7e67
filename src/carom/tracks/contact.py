"""Contacts of balls with walls: settings, the blind time, estimates from all of them, hops, and contacts that are none.

Settings of a measurement, and contacts of balls with walls: measured, or the reason why not.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Literal, NamedTuple

import numpy as np
from numpy.typing import NDArray

from carom.errors import FaultList
from carom.tracks.contact_models import slide_would_show
from carom.tracks.events import VelocityJump, WallLine
from carom.tracks.least_squares import ContactFit, Prior
from carom.tracks.track import Track

View = Literal["above", "side"]
HopVerdict = Literal["none", "seen", "possible"]
NUMBERS = (int, float, np.integer, np.floating)
# A ball's radius, and what is expected of one: millimetres are easily given without their unit.
MAX_RADIUS_M, BALL_RADIUS = 1.0, "a ball's radius in m (a billiard ball's: 0.0286, or 28.6mm)"


@dataclass(frozen=True)
class Settings:
    """Prior knowledge of a film. None: determined from the data, or taken from the literature.

    Examples
    --------
    >>> from carom.tracks import Settings
    >>> Settings(radius=0.02625, view="above", noise=3e-4).window
    0.5
    """

    radius: float | None = None
    """m; needed where several balls are filmed, whose contacts are searched for; 0: they cannot meet."""
    kappa: float = 2 / 5
    """I/(m a^2)."""
    view: View | None = None
    """From above (a ball on a table) or from the side (a ball in flight)."""
    walls: tuple[WallLine, ...] | None = None
    noise: float | None = None
    """Standard deviation of one coordinate of one frame, m."""
    floor_friction: float | None = None
    """Coulomb friction of the floor; 0: none, as on an air table."""
    rolling_resistance: float | None = None
    """Rolling resistance: deceleration / g."""
    gravity: float = 9.80665
    """m/s^2."""
    drag_per_metre: float | None = None
    """1/m: air slows a ball of speed v down by drag_per_metre v^2 in flight. None: determined from the flights; 0: not at all."""
    window: float = 0.5
    """Longest time before and after a contact that a fit uses, s."""
    blind: float | None = None
    """Time on each side of a contact whose frames are excluded, s: a soft wall is compressed, and programs smooth over the
    contact. None: determined from the scatter of the frames there."""
    hard: bool = False
    """Whether the two motions have to meet on the wall's line."""
    hops: bool | None = None
    """Whether a ball on a table hops off the walls, as off one that it touches at its centre, or stays down, as under the nose of
    a cushion. None: determined from the frames."""
    slides: bool | None = None
    """Whether the floor has friction, on which a ball slides after a wall. None: determined from the frames."""

    def check(self) -> None:
        """Raise CaromError, one line per problem, for a number out of range."""
        faults = FaultList("tracks")
        for name, low in (("kappa", 0.0), ("gravity", 0.0), ("window", 0.0), ("noise", 0.0)):
            value = getattr(self, name)
            if value is not None and not (isinstance(value, NUMBERS) and low < value < np.inf):
                faults.add(name, "a number above 0", repr(value))
        if isinstance(self.kappa, NUMBERS) and 1 < self.kappa < np.inf:
            faults.add("kappa", "kappa = I/(m a^2), at most 1", repr(self.kappa))
        for name in ("radius", "floor_friction", "rolling_resistance", "blind", "drag_per_metre"):
            value = getattr(self, name)
            if value is not None and not (isinstance(value, NUMBERS) and 0 <= value < np.inf):
                faults.add(name, "a number of at least 0", repr(value))
        if isinstance(self.radius, NUMBERS) and MAX_RADIUS_M < self.radius < np.inf:
            faults.add("radius", BALL_RADIUS, repr(self.radius))
        if self.view not in (None, "above", "side"):
            faults.add("view", "'above' or 'side'", repr(self.view))
        for name in ("hops", "slides"):
            if getattr(self, name) not in (None, True, False):
                faults.add(name, "True, False or None", repr(getattr(self, name)))
        faults.raise_if_any()


class TrackedSpin(NamedTuple):
    """Spin of a ball that was tracked, rad/s; NaN if it was not."""

    before: float = np.nan
    after: float = np.nan
    before_error: float = np.nan
    after_error: float = np.nan


@dataclass(frozen=True, eq=False)
class TrackContact:
    """A contact of a ball with a wall: measured, or the reason why not.

    :func:`carom.tracks.measure` makes them.

    Examples
    --------
    >>> import numpy as np
    >>> from carom.tracks import Settings, Track, measure
    >>> t = np.arange(12) / 100
    >>> x = np.abs(0.1 - t)  # two frames before the wall are too few
    >>> ball = Track("ball", t[8:], np.stack([x, 0.2 * t], axis=-1)[8:])
    >>> measure([ball], Settings(view="above", noise=1e-4)).contacts[0].why
    '2 frames between the start of the track and the wall, expected 4 or more'
    """

    track: str
    group: str
    wall: WallLine
    time: float
    """s; the time of the frame nearest to the wall if it was not measured."""
    before: int
    """Number of frames before the contact."""
    after: int
    """Number of frames after it."""
    fit: ContactFit | None = None
    why: str = ""
    """Why it was not measured; empty if it was."""
    blind_shift: Mapping[str, float] | None = None
    """By how much its velocities (m/s, by their names in the fit) change with one standard deviation less of the
    blind time; None where that has no error."""
    spin: TrackedSpin = field(default_factory=TrackedSpin)
    last: float = np.nan
    """Time of the last frame of the fit, s."""
    interval: float = np.nan
    """Between frames, s."""
    scatter: float = np.nan
    """Noise estimated from the residuals of this contact alone, m."""
    planar: bool = False
    """Whether the ball is in flight, or on a floor without friction: its spin does not change its path."""
    prior: Prior = field(default_factory=Prior)
    """Prior knowledge of the floor that the fit used."""
    jump: VelocityJump | None = None
    """How much of the jump of the velocity the frames near the contact show; None if it was not fitted."""
    hop: HopVerdict = "none"
    """Whether the contacts with this wall show that a ball on a table hops off it, or may hop."""
    friction_excess: float = 0.0
    """By how much chi2 is higher if the ball slides off the wall than if the floor has no friction; 0 where that was not asked."""

    def why_not(self, stage: str) -> str:
        """Return why there is no rebound of a stage, ``"after_wall"`` or ``"rolling"``; empty if there is one."""
        fit = self.fit
        if fit is None:
            return self.why
        if -fit["vn_in"] < 3 * fit.error("vn_in"):
            return "its speed toward the wall does not exceed its error"
        if self.planar:
            leaves = fit["vn_out"] > 3 * fit.error("vn_out")
            return "" if leaves else "its speed away from the wall does not exceed its error"
        if not motion_before_resolved(self, fit):
            span = fit["t"] - float(fit.time[0])
            return f"{self.before} frames in {1e3 * span:.3g} ms before the wall do not show whether it rolls or slides"
        if fit["slides"] < self.interval:
            # (the contact may as well have been some ms earlier or later, and the slide as much longer)
            frames = fit["slides"] / self.interval
            return f"it slides for only {frames:.1f} frames: when it began to roll and how it left cannot be determined"
        return _not_rolling(self, fit) if stage == "rolling" else _not_leaving(self, fit)


def motion_before_resolved(one: TrackContact, fit: ContactFit) -> bool:
    """Return whether the frames before the contact show if the ball slides or rolls there."""
    return fit.slid_before or slide_would_show(one.before, fit["t"] - float(fit.time[0]), fit.noise, fit["mu_g"])


def _not_rolling(one: TrackContact, fit: ContactFit) -> str:
    if fit["vn_roll"] < -3 * fit.error("vn_roll"):
        return "it comes back to the wall before it rolls, or a frame near the wall is mistracked"
    # long enough to distinguish rolling from sliding
    least = 3 * one.interval + np.sqrt(10 * fit.noise / fit["mu_g"])
    if one.last - fit["t"] - fit["slides"] < least:
        return "no frames show it rolling again: it slides until the last frame or nearly until it"
    return ""


def _not_leaving(one: TrackContact, fit: ContactFit) -> str:
    if fit.error("vn_out") <= 0.2 * max(fit["vn_out"], 1e-9):
        return ""
    frames = fit["slides"] / one.interval
    return "the speed at which it leaves is uncertain by more than 20 %" + (
        f": it slides for only {frames:.1f} frames" if frames < 4 else ""
    )


def tracked_spin(track: Track, rows: NDArray[np.intp], contact: float) -> TrackedSpin:
    """Return the spin before and after with their errors, if the track has an angle or a spin."""
    source = track.spin if track.spin is not None else track.angle
    if source is None:
        return TrackedSpin()
    found = []
    for side in (track.time[rows] < contact, track.time[rows] >= contact):
        some = rows[side][np.isfinite(source[rows][side])]
        if track.spin is not None:
            found.append(_mean_spin(track.spin[some], None if track.sigma_spin is None else track.sigma_spin[some]))
            continue
        if len(some) < 3:
            found.append((np.nan, np.nan))
            continue
        t, y = track.time[some] - track.time[some].mean(), np.unwrap(source[some])
        slope = float(t @ y / (t @ t))
        gap = y - y.mean() - slope * t
        found.append((slope, float(np.sqrt(gap @ gap / max(len(t) - 2, 1) / (t @ t)))))
    values, errors = zip(*found, strict=True)
    return TrackedSpin(*values, *errors)


def _mean_spin(spins: Array, sigma: Array | None) -> tuple[float, float]:
    """Return the mean of measured spins with its standard error; NaN where neither error bars nor scatter show it.

    A value that stands in several frames in turn, as the spin of a flight does, was measured once.
    """
    first = np.flatnonzero(np.diff(spins, prepend=np.nan) != 0)
    values = spins[first]
    scatter = float(values.std(ddof=1) / np.sqrt(len(values))) if len(values) > 1 else np.nan
    if sigma is None or not len(values) or not (sigma[first] > 0).all():
        return (float(spins.mean()), scatter) if len(spins) > 1 else (np.nan, np.nan)
    weights = sigma[first] ** -2.0
    return float(values @ weights / weights.sum()), float(np.fmax(weights.sum() ** -0.5, scatter))


# ----------------------------------------------------------------------------------------------------
# The blind time: for how long before and after a contact the frames do not show free motion.
#
# A wall that gives way affects the frames of the contact itself, a tracker that smooths some frames after it. There the residuals
# across the wall are large. Their start and end are a change point: bins next to the contact in which half of the residuals
# exceed a threshold, beyond them as many as far away. If there is one, it is the mean of those of greatest likelihood in contacts
# drawn with replacement, because residuals of one contact are not independent, each draw weighted by the prior that long blind
# times are rare. Few contacts often have a second maximum far out, which so moves their mean little.


Array = NDArray[np.float64]
BINS = 40  # of half a frame
FAR_FRAMES, MIN_FAR = 5.0, 50  # residuals beyond so many frames show the usual scatter; so many are needed
USUAL_QUANTILE, EXCEEDS = 0.8, 1.8  # a residual is large if it exceeds this quantile of the usual ones so many times
# (of a few contacts, large residuals may come from a floor unlike the literature's)
MIN_CONTACTS = 10
LARGE_SHARE = 0.5  # of the residuals within the blind time
MIN_SHARE = 0.02  # of large residuals far away, at least
BLIND_EXISTS = 6.0  # log likelihood ratio from which a blind time is taken to exist
DRAWS = 200
USUAL_BINS = 8.0  # four frames: mean of the exponential prior of the blind time


class BlindTime(NamedTuple):
    """Time before and after a contact, s, with standard deviations."""

    before: float = 0.0
    after: float = 0.0
    before_error: float = 0.0
    after_error: float = 0.0


def estimate_blind_time(contacts: Sequence[TrackContact], interval: float) -> BlindTime:
    """Estimate the blind time from the residuals of fits to all frames; ``interval``: between frames, s."""
    parts = [(one.fit.time - one.fit["t"], np.abs(one.fit.residuals[:, 0])) for one in contacts if one.fit is not None]
    if len(parts) < MIN_CONTACTS:
        return BlindTime()
    far = np.concatenate([size[np.abs(t) > FAR_FRAMES * interval] for t, size in parts])
    if len(far) < MIN_FAR:
        return BlindTime()
    limit = EXCEEDS * float(np.quantile(far, USUAL_QUANTILE))
    usual = min(max(float((far > limit).mean()), MIN_SHARE), LARGE_SHARE / 2)
    gains = np.log(LARGE_SHARE / usual), np.log((1 - LARGE_SHARE) / (1 - usual))
    weights = np.random.default_rng(0).multinomial(len(parts), np.full(len(parts), 1 / len(parts)), DRAWS)
    found, errors = [], []
    for sign in (-1, 1):
        # (contacts, BINS) by how much the likelihood of each bin's residuals is greater within the blind time
        gain = np.zeros((len(parts), BINS))
        for row, (t, size) in zip(gain, parts, strict=True):
            k = np.floor(2 * sign * t / interval).astype(int)
            here = (sign * t >= 0) & (k < BINS)
            np.add.at(row, k[here], np.where(size[here] > limit, *gains))
        exists = _change_point(gain.sum(axis=0)) > 0
        drawn = np.array([_change_point(row, -np.inf if exists else BLIND_EXISTS) for row in weights @ gain])
        prior = np.exp(-drawn / USUAL_BINS)
        middle = float(np.average(drawn, weights=prior)) if exists else 0.0
        found.append(middle / 2 * interval)
        errors.append(float(np.average((drawn - middle) ** 2, weights=prior)) ** 0.5 / 2 * interval)
    return BlindTime(*found, *errors)


def _change_point(gain: Array, decisive: float = BLIND_EXISTS) -> int:
    """Return how many bins belong to the blind time; 0 unless the log likelihood gains more than ``decisive``."""
    total = np.concatenate([[0.0], np.cumsum(gain)])
    best = int(np.argmax(total))
    return best if total[best] > decisive else 0


# ----------------------------------------------------------------------------------------------------
# Contacts that are none: where a ball turns in a smooth curve, as on a curved rail or at the end of a string.


SMOOTH_TURN = (
    "the ball turns over several frames there, as on a curved rail or at the end of a string; at a wall it turns between two"
    " frames: not used"
)


def without_smooth_turns(contacts: Sequence[TrackContact], scatter: float) -> list[TrackContact]:
    """Return the contacts without those at which the ball turns smoothly, which are none.

    A turn that is neither certainly smooth nor certainly sharp is none either if the frames scatter about the fit by more than
    ``scatter``, m; where the turns at a wall are smooth on the whole, only sharp ones that scatter less remain.
    """
    smooth = {name for name in {one.wall.name for one in contacts} if _smooth_on_the_whole(contacts, name)}
    found = []
    for one in contacts:
        jump = one.jump
        good = jump is None or jump.sharp, one.scatter < scatter
        none = jump is not None and (jump.smooth or not (all(good) if one.wall.name in smooth else any(good)))
        found.append(replace(one, fit=None, why=SMOOTH_TURN) if none and one.fit is not None else one)
    return found


def _smooth_on_the_whole(contacts: Sequence[TrackContact], wall: str) -> bool:
    """Return whether most turns at a wall are smooth, or all of them together."""
    jumps = [one.jump for one in contacts if one.wall.name == wall and one.jump is not None]
    weights = np.array([one.error**-2 for one in jumps])
    if not weights.sum() > 0:
        return False
    share = float(weights @ np.array([one.share if one.error < np.inf else 0.0 for one in jumps]) / weights.sum())
    together = VelocityJump(share, float(weights.sum() ** -0.5))
    return together.smooth or sum(one.smooth for one in jumps) > sum(one.sharp for one in jumps)


def certainly_sharp(contacts: Sequence[TrackContact]) -> bool:
    """Return whether the velocity certainly jumps in most of the measured contacts."""
    jumps = [one.jump for one in contacts if one.fit is not None and one.jump is not None]
    return 2 * sum(one.sharp for one in jumps) > len(jumps)


def turns_smoothly(contacts: Sequence[TrackContact]) -> bool:
    """Return whether some contacts were left out because the ball turns smoothly there."""
    return any(one.why == SMOOTH_TURN for one in contacts)


# ----------------------------------------------------------------------------------------------------
# Pooled estimates from all contacts: friction and rolling resistance of the floor, or gravity.


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
