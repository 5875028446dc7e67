"""Settings of a measurement, and contacts of balls with walls: measured, or the reason why not."""

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
        if self.fit is None:
            return self.why
        return _why_not(self, stage)


def motion_before_resolved(one: TrackContact, fit: ContactFit) -> bool:
    """Return whether the frames before the contact show if the ball slides or rolls there."""
    return fit.slid_before or slide_would_show(one.before, fit["t"] - float(fit.time[0]), fit.noise, fit["mu_g"])


def _why_not(one: TrackContact, stage: str) -> str:
    fit = one.fit
    assert fit is not None
    if -fit["vn_in"] < 3 * fit.error("vn_in"):
        return "its speed toward the wall does not exceed its error"
    if one.planar:
        return (
            "" if fit["vn_out"] > 3 * fit.error("vn_out") else "its speed away from the wall does not exceed its error"
        )
    if not motion_before_resolved(one, fit):
        span = fit["t"] - float(fit.time[0])
        return f"{one.before} frames in {1e3 * span:.3g} ms before the wall do not show whether it rolls or slides"
    if fit["slides"] < one.interval:
        # (the contact may as well have been some ms earlier or later, and the slide as much longer)
        frames = fit["slides"] / one.interval
        return f"it slides for only {frames:.1f} frames: when it began to roll and how it left cannot be determined"
    return _not_rolling(one, fit) if stage == "rolling" else _not_leaving(one, fit)


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
DECISIVE = 6.0  # log likelihood ratio from which a blind time is taken to exist
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
        drawn = np.array([_change_point(row, -np.inf if exists else DECISIVE) for row in weights @ gain])
        prior = np.exp(-drawn / USUAL_BINS)
        middle = float(np.average(drawn, weights=prior)) if exists else 0.0
        found.append(middle / 2 * interval)
        errors.append(float(np.average((drawn - middle) ** 2, weights=prior)) ** 0.5 / 2 * interval)
    return BlindTime(*found, *errors)


def _change_point(gain: Array, decisive: float = DECISIVE) -> int:
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
