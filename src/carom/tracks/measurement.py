"""Measure the contacts in tracks: fits of all contacts in rounds, and the steps before and after them.

Fit all contacts of some tracks, in rounds: all contacts together determine the floor and the noise for the next round.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, replace
from itertools import chain

import numpy as np
from numpy.typing import NDArray

from carom.errors import CaromError
from carom.files import require_library
from carom.formatting import counted
from carom.tracks.contact import (
    DECISIVE,
    BlindTime,
    Settings,
    TrackContact,
    View,
    WithError,
    certainly_sharp,
    estimate_blind_time,
    hop_notes,
    motion_before_resolved,
    pool_floor,
    pool_gravity,
    tracked_spin,
    turns_smoothly,
    with_hops,
    without_smooth_turns,
)
from carom.tracks.contact_models import fit_table, friction_excess
from carom.tracks.events import BEYOND_WALL_M, TrackEvent, WallLine, find_events, find_walls, flight_ends, velocity_jump
from carom.tracks.flights import (
    STILL_AIR,
    Air,
    air_and_notes,
    axis_points_down,
    falls_freely,
    fit_flight,
    moves_on_a_table,
    what_would_give,
)
from carom.tracks.least_squares import (
    AT_CONTACT,
    WHITE,
    ContactFit,
    Correlation,
    FittedFrames,
    FrameGroups,
    Prior,
    averaged_frames,
    averaging_error,
    estimate_correlation,
    weigh_correlations,
    whitening,
)
from carom.tracks.plausibility import (
    MIN_JUDGED,
    Turn,
    elsewhere_notes,
    facing_up,
    find_turns,
    flight_gravity,
    floor_of_turns,
    oblique_note,
    on_either_floor,
    only_level,
    restitution_note,
    restitutions_in_words,
    shared_error_notes,
    unlisted_turns,
    why_implausible,
    with_turns,
    without_oblique,
    without_turned,
)
from carom.tracks.preprocess import guess_view, prepared
from carom.tracks.track import Track

Array = NDArray[np.float64]
MIN_FRAMES_BEFORE, MIN_FRAMES_AFTER = 4, 5
# Largest number of frames on each side of a fit: with more, errors of the model outweigh the noise.
MAX_FRAMES = 500
# A fit that scatters more than this many times as much as the others is not free motion on both sides of a wall.
MAX_EXCESS_SCATTER = 3.0
# The first round has no noise estimate and takes the floor from the literature; the second estimates the floor from good starts.
ROUNDS = 3
MAX_ROUNDS = 5  # where the noise turns out to be correlated
# The noise that the residuals of a round show is at least this share of what was assumed in it.
MIN_NOISE_SHARE = 1e-3
VELOCITIES = ("vn_in", "vt_in", "vn_out", "vt_out", "vn_roll", "vt_roll")
UNFOUND = "a bounce that is too low or too short to be found"
Progress = Callable[[int, int], None]
NAMES = {"wall": "the wall {}", "ball": "ball {}", "gap": "a gap", "start": "the start of the track",
         "end": "the end of the track", "onset": "the ball's start", "turn": "a bounce elsewhere, at {}"}  # fmt: skip


@dataclass
class ContactFitter:
    """Fits all contacts, and estimates the noise, the blind time and the floor between rounds."""

    settings: Settings
    view: View
    walls: dict[str, WallLine]
    interval: float
    noise: float
    blind: BlindTime = field(default_factory=BlindTime)
    """Times before and after a contact whose frames are excluded."""
    air: Air = STILL_AIR
    floor: dict[str, WithError] = field(default_factory=dict)
    correlation: Correlation = WHITE
    frame_noise: float = 0.0
    """From frame to frame, m: what differences of neighbouring positions show, whatever the paths are."""

    def __post_init__(self) -> None:
        """Keep the noise before any fit."""
        self.frame_noise = self.noise

    def run(
        self,
        tracks: list[Track],
        events: dict[tuple[str, str], list[TrackEvent]],
        notes: list[str],
        progress: Progress | None,
    ) -> list[TrackContact]:
        """Fit all contacts; where they do not show that the floor has friction, on one without friction, too."""
        bare = replace(self, settings=replace(self.settings, floor_friction=0.0))
        said = list[str]()
        found = self._fitted(tracks, events, said, progress)
        excess = sum(one.friction_excess for one in found)
        if any(one.friction_excess for one in found) and excess > -DECISIVE:
            say = list[str]()
            straight = bare._fitted(tracks, events, say, progress)
            found, verdict = on_either_floor(found, straight, excess)
            if excess > 0:
                said = say
                self.noise, self.blind = bare.noise, bare.blind
                self.correlation, self.floor = bare.correlation, bare.floor
            said += verdict
        notes += said
        return found

    @property
    def judges_friction(self) -> bool:
        """Whether the frames have to say if the floor has friction."""
        return self.view == "above" and self.settings.floor_friction is None and self.settings.slides is None

    def _fitted(
        self,
        tracks: list[Track],
        events: dict[tuple[str, str], list[TrackEvent]],
        notes: list[str],
        progress: Progress | None,
    ) -> list[TrackContact]:
        """Fit all contacts: first with the floor of the literature, then with the estimate of all other contacts."""
        jobs = [
            (track, events[track.group, track.name], i)
            for track in tracks
            for i, event in enumerate(events[track.group, track.name])
            if event.kind == "wall"
        ]
        known = [prior := self._prior()] * len(jobs)
        found: list[TrackContact] | None = None
        number, rounds = 0, ROUNDS
        while number < rounds:
            found = self._round(jobs, known, found, number, progress)
            if number == 0 and self.settings.blind is None:
                self.blind = self._blind_time(found)
            if number in (ROUNDS - 1, ROUNDS) and self._estimated_correlation(found):
                rounds = MAX_ROUNDS  # with frames weighted anew
            number += 1
            if number < rounds:
                hopping = with_hops(found, self.settings.hops, doubtful=False)
                fits = [one.fit for one in hopping]
                if self.view != "above":
                    self.floor = pool_gravity(fits)
                    continue
                if prior.mu_g == 0:
                    self.floor = {"floor friction": WithError(0.0, 0.0)}
                    continue
                # a ball that slides where rolling is assumed, or rolls where sliding is, would bias the estimate of the floor
                usable, owners = [_determines_floor(one) for one in hopping], [(one.group, one.track) for one in found]
                self.floor, known = pool_floor(fits, owners, known, prior, self.settings.gravity, usable)
        found = self._with_error_of_correlation(found or [])
        done = [self._checked(one) for one in with_hops(found, self.settings.hops)]
        if self.view == "above":
            done = without_oblique(done, prior.k)
            notes += oblique_note(done)
        notes += hop_notes(done)
        if self.correlation != WHITE:
            notes.append(
                f"the noise is correlated from frame to frame, by {self.correlation.neighbours:.2f} between neighbours: a tracker"
                " that follows a shadow or an edge, smooths, or rounds. Fits weight their frames accordingly, and the error bars"
                " allow for it"
            )
        if not any(self.blind[:2]):
            return done
        shifted = self._with_blind_error(jobs, known, found, done) if any(self.blind[2:]) else done
        notes.append(self._blind_note(shifted))
        return shifted

    def _estimated_correlation(self, found: list[TrackContact]) -> bool:
        """Estimate the correlation of the noise from all contacts; return whether it is significant."""
        self.correlation = estimate_correlation([fitted for _ball, fitted in _fitted_frames(found)], self.interval)
        return self.correlation != WHITE

    def _with_error_of_correlation(self, found: list[TrackContact]) -> list[TrackContact]:
        """Add to the covariance of each contact what it lacks, since the correlation is not known exactly."""
        likely = weigh_correlations(_fitted_frames(found), self.interval)

        def widened(fit: ContactFit) -> ContactFit:
            if fit.fitted is None or fit.rate is None:
                return fit
            lacking = fit.rate @ averaging_error(fit.fitted, self.correlation, likely, self.interval) @ fit.rate.T
            return replace(fit, covariance=fit.covariance + lacking, hopping=fit.hopping and widened(fit.hopping))

        return [replace(one, fit=widened(one.fit)) if likely and one.fit is not None else one for one in found]

    def _blind_time(self, found: list[TrackContact]) -> BlindTime:
        """Estimate the blind time; frames that a hop explains are not left out."""
        blind, hopping = estimate_blind_time(found, self.interval), with_hops(found, self.settings.hops)
        if any(blind[:2]) and any(one.hop == "seen" for one in hopping):
            rest = estimate_blind_time(hopping, self.interval)
            return blind if any(rest[:2]) else rest
        return blind

    def _with_blind_error(
        self, jobs: list[tuple[Track, list[TrackEvent], int]], priors: Sequence[Prior], found: list[TrackContact],
        done: list[TrackContact],
    ) -> list[TrackContact]:  # fmt: skip
        """Add to each contact by how much its velocities change with one standard deviation less of the blind time.

        (With more, contacts would lose the frames that determine their velocities, and change by chance.)
        """
        blind, others = self.blind, []
        before, after = max(blind.before - blind.before_error, 0.0), max(blind.after - blind.after_error, 0.0)
        self.blind = blind._replace(before=before, after=after)
        for job, prior, one in zip(jobs, priors, found, strict=True):
            other = self._contact(*job, prior, one).fit if one.fit is not None else None
            if one.fit is not None and other is not None:  # the verdict on hops remains
                other = replace(other, hop_chi2=one.fit.hop_chi2)
            others.append(replace(one, fit=other))
        self.blind = blind
        return [
            replace(one, blind_shift=_changes(one.fit, other.fit))
            for one, other in zip(done, with_hops(others, self.settings.hops), strict=True)
        ]

    def _blind_note(self, found: list[TrackContact]) -> str:
        """Say which frames are left out, and what one standard deviation of that time changes."""
        (before, after), errors = self.blind[:2], self.blind[2:]
        times = [
            f"{1e3 * time:.3g} ± {1e3 * error:.2g} ms" for time, error in zip((before, after), errors, strict=True)
        ]
        fits = [(one.fit, one.blind_shift) for one in found if one.fit is not None and one.blind_shift]
        effect = ""
        if fits:
            e = [fit["vn_out"] / -fit["vn_in"] for fit, _shift in fits]
            new = [(fit["vn_out"] + shift["vn_out"]) / -(fit["vn_in"] + shift["vn_in"]) for fit, shift in fits]
            change = float(np.median(new) - np.median(e))
            effect = f"; one standard deviation less changes the median restitution by {change:+.2g}"
            effect += " (in the error bars of rebounds)"
        return (
            f"frames up to {times[0]} before and {times[1]} after a contact scatter across the wall far more than"
            f" others (a soft wall, or a tracker that smooths): left out (`blind` 0 keeps them){effect}"
        )

    def _round(
        self, jobs: list[tuple[Track, list[TrackEvent], int]], priors: Sequence[Prior], before: list[TrackContact] | None,
        done: int, progress: Progress | None,
    ) -> list[TrackContact]:  # fmt: skip
        """Fit every contact once, starting from the previous round."""
        found = []
        for number, (job, prior) in enumerate(zip(jobs, priors, strict=True)):
            old = before[number] if before else None
            judged = self.judges_friction and done >= ROUNDS - 1
            found.append(old if old is not None and old.fit is None else self._contact(*job, prior, old, judged))
            if progress:
                progress(min(done, ROUNDS - 1) * len(jobs) + number + 1, ROUNDS * len(jobs))
        found = without_smooth_turns(found, MAX_EXCESS_SCATTER * self.frame_noise)
        if self.settings.noise is None:
            self.noise = pooled_noise(with_hops(found, self.settings.hops, doubtful=False), self.noise)
        return found

    def _prior(self) -> Prior:
        given = self.settings
        k = given.kappa / (1 + given.kappa)
        prior = Prior(k=k)
        if given.floor_friction == 0 or given.slides is False:
            prior = replace(prior, mu_g=0.0, c_g=0.0)
        elif given.floor_friction is not None:
            mu_g = given.floor_friction * given.gravity
            prior = replace(prior, mu_g=mu_g, mu_g_error=1e-4 * given.floor_friction * given.gravity)
        if given.rolling_resistance is not None:
            c_g = given.rolling_resistance * given.gravity
            prior = replace(prior, c_g=c_g, c_g_error=max(1e-4 * given.rolling_resistance * given.gravity, 1e-6))
        return prior

    def _contact(
        self, track: Track, events: list[TrackEvent], i: int, prior: Prior, old: TrackContact | None = None,
        judged: bool = False,
    ) -> TrackContact:  # fmt: skip
        """Fit one contact, or return the reason why it cannot be fitted. ``old``: the contact of the previous round.

        ``judged``: say whether it shows that the floor has friction.
        """
        excess = 0.0
        event, wall = events[i], self._wall_of(events[i])
        middle = (event.low + event.high) / 2 if old is None else old.time
        rows, why = self._rows(track, events, i, middle)
        t = track.time[rows]
        before, after = int((t < middle).sum()), int((t >= middle).sum())
        bare = TrackContact(
            track.name,
            track.group,
            wall,
            middle,
            before,
            after,
            why=why,
            interval=self.interval,
            planar=self.view == "side" or prior.mu_g == 0,
            prior=prior,
        )
        if why:
            return bare
        x = wall.frame(track.position[rows])
        at = 0.0 if self.settings.hard else None
        if self.view == "above":
            single = t, x
            t, x, frames = averaged_frames(t, x, middle)
            known = None if old is None else old.fit
            weight, white = np.sqrt(frames.number), self._whitening(frames)
            fit = fit_table(
                t, x, middle, self.noise, prior, at, weight, known, self.settings.gravity, white, single
            )  # fmt: skip
            if judged:
                excess = friction_excess(t, x, middle, self.noise, self._prior(), at, weight, white, fit)
        else:
            gravity = wall.turned(self.settings.gravity * np.array(self.air.down))
            white = self._whitening(FrameGroups(t, t, np.ones(len(t))))
            fit = fit_flight(t, x, middle, self.noise, gravity, 0.05 * self.settings.gravity, at, self.air, white)
        if (not event.low - self.interval < fit["t"] < event.high + self.interval and self.view == "side") or (
            not np.isfinite(fit.value[AT_CONTACT]).all()
            or not np.isfinite(fit.covariance[AT_CONTACT, AT_CONTACT]).all()
        ):
            return replace(bare, why="the fit did not converge for these frames")
        scatter = fit.noise * float(np.sqrt(fit.chi2 / max(fit.dof, 1)))
        # (only frames that were fitted one by one: near the contact all are)
        jump = velocity_jump(track.time[rows], wall.frame(track.position[rows]), fit, self.frame_noise, self.interval)
        return replace(
            bare,
            jump=jump,
            time=fit["t"],
            fit=fit,
            last=float(track.time[rows[-1]]),
            scatter=scatter,
            spin=tracked_spin(track, rows, fit["t"]),
            friction_excess=excess,
        )

    def _wall_of(self, event: TrackEvent) -> WallLine:
        """Return the wall of a contact, through its own place if that is away from the wall's line."""
        wall = self.walls[event.what]
        return wall if event.place is None else replace(wall, point=event.place)

    def _whitening(self, frames: FrameGroups) -> Array | None:
        """Return the matrix that makes the errors of frames independent; None where they are."""
        return None if self.correlation == WHITE else whitening(frames, self.correlation, self.interval)

    def _rows(self, track: Track, events: list[TrackEvent], i: int, middle: float) -> tuple[NDArray[np.intp], str]:
        """Return the frames of free motion on both sides, and why they do not suffice."""
        event, before, after = events[i], events[i - 1], events[i + 1]
        said = [NAMES[other.kind].format(other.what) for other in (before, after)]
        for other, name in zip((before, after), said, strict=True):
            if other.kind in ("wall", "ball", "turn") and other.low <= event.high and event.low <= other.high:
                return np.zeros(
                    0, np.intp
                ), f"{name} is met within two frames: contacts that the frames cannot separate"
        # the frame nearest to another wall may lie on either side of that contact
        low = max(before.high + self.blind.after * (before.kind == "wall"), middle - self.settings.window)
        high = min(after.low - self.blind.before * (after.kind == "wall"), middle + self.settings.window)
        rows = np.arange(np.searchsorted(track.time, low), np.searchsorted(track.time, high, "right"))
        t, x = track.time[rows] - middle, track.position[rows]
        use = (t < -self.blind.before) | (t > self.blind.after)
        for other_wall in self.walls.values():
            # a single frame on the extreme line may have been clamped there, without a second row to show it
            if other_wall.clamped or other_wall.found:
                use &= np.abs(other_wall.frame(x)[:, 0]) > 1e-6
        first, second = rows[use & (t < 0)], rows[use & (t >= 0)]
        if self.view == "side":
            wall, down = self._wall_of(event), np.array(self.air.down)
            pull = -self.settings.gravity * float(np.array(wall.normal) @ down)
            d = wall.frame(track.position)[:, 0]

            def ends(part: NDArray[np.intp]) -> float:
                return flight_ends(np.abs(track.time[part] - middle), d[part], pull, self.frame_noise, self.interval)

            since, until = middle - ends(first[::-1]), middle + ends(second)
            if since > before.high + self.interval:
                first, said[0] = first[track.time[first] > since + self.interval / 2], UNFOUND
            if until < after.low - self.interval:
                second, said[1] = second[track.time[second] < until - self.interval / 2], UNFOUND
        rows = np.concatenate([first[-MAX_FRAMES:], second[:MAX_FRAMES]])
        for part, between, least in (
            (first, f"{said[0]} and the wall", MIN_FRAMES_BEFORE),
            (second, f"the wall and {said[1]}", MIN_FRAMES_AFTER),
        ):
            if len(part) < least:
                return rows, f"{counted(len(part), 'frame')} between {between}, expected {least} or more"
        return rows, ""

    def _checked(self, one: TrackContact) -> TrackContact:
        """Scale the errors to the noise of all contacts, or of this one if it scatters more; reject it if it scatters far more."""
        if one.fit is None:
            return one
        corner = self._second_wall(one, one.fit)
        if corner:
            return replace(one, fit=None, why=corner)
        excess = one.scatter / self.noise
        if excess > MAX_EXCESS_SCATTER:
            why = (
                f"the frames scatter by {1e3 * one.scatter:.2g} mm about {'slide and roll' if self.view == 'above' else 'flight'},"
                f" {excess:.1f} times as much as elsewhere: another contact, or a ball that hops?"
            )
            return replace(one, fit=None, why=why)
        # more than expected by chance in 1 of 1000 fits
        if excess**2 > 1 + 3.1 * np.sqrt(2 / max(one.fit.dof, 1)) + 3 / max(one.fit.dof, 1):
            return replace(one, fit=one.fit.scaled(one.scatter))
        return replace(one, fit=one.fit.scaled(self.noise))

    def _second_wall(self, one: TrackContact, fit: ContactFit) -> str:
        """Return a message if the ball may have met another wall as well between two frames, else an empty text.

        It moved toward that wall before, moves away from it after, and had the time to reach it.
        """
        time, t = fit.time, fit["t"]
        gap = float(time[time >= t].min(initial=np.inf) - time[time < t].max(initial=-np.inf))
        n = np.array(one.wall.normal)
        across = np.array([-n[1], n[0]])
        place = one.wall.back(np.array([[fit["away"], fit["along"]]]))
        for other in self.walls.values():
            if other.name == one.wall.name:
                continue
            before, after = (
                other.turned(fit[f"vn_{side}"] * n + fit[f"vt_{side}"] * across)[0] for side in ("in", "out")
            )
            slack = abs(before) * gap + 6 * self.noise
            # far beyond its line, as below a higher stair, there is no wall
            if before < 0 < after and -slack - BEYOND_WALL_M < other.frame(place)[0, 0] < slack:
                name = NAMES["wall"].format(other.name)
                return f"{name} is met within two frames: contacts that the frames cannot separate"
        return ""


def _changes(one: ContactFit | None, other: ContactFit | None) -> dict[str, float]:
    """Return by how much the velocities of another fit differ."""
    if one is None or other is None:
        return {}
    return {name: float(np.nan_to_num(other[name] - one[name])) for name in VELOCITIES}


def _fitted_frames(found: Sequence[TrackContact]) -> list[tuple[tuple[str, str], FittedFrames]]:
    """Return the frames of each fit that serve the estimate of the correlation, with the ball that they show."""
    fits = [((one.group, one.track), one.fit.fitted) for one in found if one.fit is not None]
    return [(ball, fitted) for ball, fitted in fits if fitted is not None]


def _determines_floor(one: TrackContact) -> bool:
    """Whether a contact may be used to estimate the floor: its motion before the wall is known."""
    return one.fit is not None and motion_before_resolved(one, one.fit) and not one.fit.slid_until_contact


def pooled_noise(contacts: Sequence[TrackContact], otherwise: float) -> float:
    """Estimate the noise from the residuals of all contacts, leaving out contacts that scatter far more than the others.

    Places without noise, computed and not measured, leave no residuals at all; the noise stays above 0.
    """
    fits = [(one.scatter, one.fit.dof) for one in contacts if one.fit is not None]
    if not fits:
        return otherwise
    scatter, dof = np.array(fits).T
    good = scatter <= 2 * np.median(scatter)
    found = float(np.sqrt((scatter[good] ** 2 * dof[good]).sum() / max(dof[good].sum(), 1.0)))
    return max(found, MIN_NOISE_SHARE * otherwise)


# ----------------------------------------------------------------------------------------------------
# Measurement of the contacts in tracks: camera clock, walls, events and fits; each contact not measured has a reason.


OF_VIEW: dict[View, str] = {"above": "from above", "side": "from the side"}
KIND_OF_MOTION: dict[View, str] = {"above": "a ball on a table", "side": "a ball in flight"}
SIDES = {"above": ("left", "right", "bottom", "top"), "side": ("bottom",)}


@dataclass(frozen=True, eq=False)
class Measured:
    """Result of a measurement: walls, events, contacts, noise and floor.

    Examples
    --------
    >>> import numpy as np
    >>> from carom.tracks import Settings, Track, measure
    >>> t = np.arange(40) / 100
    >>> ball = Track("ball", t, np.stack([np.abs(0.2 - t), 0.1 * t], axis=-1))
    >>> found = measure([ball], Settings(view="above", noise=1e-4))
    >>> [wall.name for wall in found.walls], len(found.contacts)
    (['left'], 1)
    """

    tracks: tuple[Track, ...]
    """The tracks as fitted: only frames in which the ball was found, with times on the camera's clock."""
    view: View
    walls: tuple[WallLine, ...]
    events: dict[tuple[str, str], list[TrackEvent]]
    """By group and name of a track."""
    contacts: tuple[TrackContact, ...]
    noise: float
    """Standard deviation of one coordinate of one frame, m."""
    noise_given: bool
    step: tuple[float, float]
    """Step to which positions were rounded along each axis, m; 0 if there is no sign of rounding."""
    interval: float
    """Between frames, s."""
    blind: BlindTime
    """Times before and after a contact whose frames were excluded, s."""
    floor: dict[str, WithError] = field(default_factory=dict)
    """Estimates from all contacts: ``floor friction`` and ``rolling resistance``, or ``gravity`` (m/s^2) and, if the
    flights show it, ``air drag`` (1/m), with their errors."""
    air: Air = STILL_AIR
    """Of a film from the side: the direction of gravity and the drag that the velocities at contacts allow for."""
    notes: tuple[str, ...] = ()
    gravity: float = 9.80665
    """m/s^2, by which decelerations were divided to give the friction of the floor."""
    radius: float | None = None
    """Radius of the balls, m; None if it was not given."""
    kappa: float = 2 / 5
    """I/(m a^2)."""
    correlation: float = 0.0
    """Correlation of the noise between neighbouring frames; 0 where the frames show none."""
    frame_correlation: Correlation = WHITE
    """The same between frames any time apart."""
    window: float = 0.5
    """Longest time before and after a contact that a fit uses, s."""
    view_reason: str = ""
    """Why the view was taken for what it is; empty if it was given."""

    @property
    def measured(self) -> list[TrackContact]:
        """The contacts that were measured."""
        return [contact for contact in self.contacts if contact.fit is not None]


def measure(tracks: Sequence[Track], settings: Settings | None = None, progress: Progress | None = None) -> Measured:
    """Find and measure the contacts of balls with walls in tracks filmed with one camera.

    On both sides of a contact the motion is fitted by the physics: sliding and rolling with friction on a table, parabolas in
    flight; the two motions meet at the wall. Floor, noise and blind time are estimated from all contacts together. A view that
    is not given is guessed from the acceleration of the ball; if contacts are impossible in it and not in the other, that is
    taken.

    Parameters
    ----------
    tracks : sequence of Track
        In one coordinate system, m and s; tracks of one ``group`` were filmed together.
    settings : Settings, optional
        Prior knowledge of the film.
    progress : callable(done, total), optional
        Called after each fit.

    Returns
    -------
    Measured
        Walls, events, contacts, noise and floor.

    Raises
    ------
    CaromError
        For settings out of range, tracks with three coordinates, an unknown radius where balls may meet, and without SciPy.

    Examples
    --------
    A ball in flight bounces at t = 0.1 s:

    >>> import numpy as np
    >>> from carom.tracks import Settings, Track, measure
    >>> t = np.arange(40) / 200
    >>> y = np.where(t < 0.1, 2 * (0.1 - t), 1.6 * (t - 0.1)) - 9.81 / 2 * (t - 0.1) ** 2
    >>> found = measure([Track("ball", t, np.stack([0.5 * t, y], axis=-1))], Settings(view="side", noise=1e-4))
    >>> contact = found.contacts[0]
    >>> contact.wall.name, round(contact.time, 6), round(contact.fit["vn_out"], 3)
    ('bottom', 0.1, 1.6)
    """
    settings = settings or Settings()
    found = _measured(tracks, settings, progress)
    if not any(one.sigma_time is not None and np.nan_to_num(one.sigma_time).any() for one in tracks):
        return found
    # (an error that all times have in common: what it changes, once more with it)
    late = [one if one.sigma_time is None else replace(one, time=one.time + one.sigma_time) for one in tracks]
    others = _measured(late, replace(settings, view=found.view), None).measured
    return replace(found, contacts=tuple(_with_change(one, others) for one in found.contacts))


def _with_change(contact: TrackContact, others: Sequence[TrackContact]) -> TrackContact:
    """Return a contact whose covariance has the change of its values to those of the same contact among others."""
    same = [
        one
        for one in others
        if (one.group, one.track, one.wall.name) == (contact.group, contact.track, contact.wall.name)
    ]
    near = min(same, key=lambda one: abs(one.time - contact.time), default=None)
    if contact.fit is None or near is None or near.fit is None:
        return contact
    change = np.nan_to_num(near.fit.value - contact.fit.value)
    return replace(contact, fit=replace(contact.fit, covariance=contact.fit.covariance + np.outer(change, change)))


def _measured(tracks: Sequence[Track], settings: Settings, progress: Progress | None) -> Measured:
    require_library("scipy", "tracks")
    settings.check()
    if not tracks or not all(isinstance(track, Track) for track in tracks):
        raise CaromError(f"measure: tracks: expected one or more carom.tracks.Track, got {tracks!r:.60}")
    notes: list[str] = []
    seen, groups, interval, step, noise = prepared(tracks, settings.gravity, notes)
    noise = settings.noise if settings.noise is not None else noise
    if settings.radius is None and any(len(members) > 1 for members in groups.values()):
        raise CaromError(
            "tracks: expected the balls' radius, since several were filmed together and may meet, got none;"
            " `radius` 30.75mm, or `radius` 0 if they cannot meet"
        )
    _require_axis_up(seen, settings)
    film = Measured(
        tracks=tuple(seen), view="above", walls=(), events={}, contacts=(), noise=noise, noise_given=settings.noise is not None,
        step=step, interval=interval, blind=BlindTime(*(settings.blind or 0.0,) * 2), gravity=settings.gravity,
        radius=settings.radius or None, kappa=settings.kappa, window=settings.window,
    )  # fmt: skip
    if settings.view is not None:
        found = _in_view(film, settings.view, settings, groups, progress)
    else:
        found = _in_likely_view(film, settings, groups, progress)
    return replace(found, notes=(*notes, *found.notes, *restitution_note(found.contacts)))


def _require_axis_up(tracks: Sequence[Track], settings: Settings) -> None:
    """Raise CaromError if a ball filmed from the side falls upward."""
    if settings.view == "above":
        return
    upward = axis_points_down(tracks, settings.gravity)
    if upward:
        raise CaromError(
            f"tracks: expected positions that count upward, but the ball falls upward, with {upward:.3g} m/s^2: they count"
            " downward, as in pictures; give `down` (y with the other sign), or `view` above if the ball is on a table"
        )
    across = [replace(track, position=track.position[:, ::-1]) for track in tracks]
    for sign, side in ((1, "left"), (-1, "right")):
        if falls_freely(across, sign * settings.gravity) and not falls_freely(tracks, settings.gravity):
            raise CaromError(
                f"tracks: expected a second axis that points up, but the ball falls to the {side}: the picture lies on its side;"
                " exchange x and y, or `view` above if the ball is on a table"
            )


def _in_likely_view(
    film: Measured, settings: Settings, groups: dict[str, list[Track]], progress: Progress | None
) -> Measured:
    """Measure in the view that the motion suggests; where the contacts are impossible there, in the other, if they are not."""
    view, why = guess_view(film.tracks, settings.gravity)
    gravity = flight_gravity(film.tracks, settings.gravity)
    other: View = "above" if view == "side" else "side"
    found = _in_view(film, view, settings, groups, progress)
    wrong = why_implausible(found.contacts, view, found.floor, gravity)
    certain = view == "side" and falls_freely(film.tracks, settings.gravity) > 0
    unsure = not certain and not moves_on_a_table(film.tracks, settings.gravity) and gravity == settings.gravity
    second, wrong_too, doubts = None, "", list[str]()
    if (wrong and not certain) or unsure:
        second = _in_view(film, other, settings, groups, progress)
        wrong_too = why_implausible(second.contacts, other, second.floor, gravity)
        if not wrong_too and turns_smoothly(found.contacts) and not certainly_sharp(second.contacts):
            wrong_too = "the frames show no velocity that jumps"
        if wrong and not wrong_too and len(second.measured) >= MIN_JUDGED:
            found, second, view, other, why, wrong = second, found, other, view, f"{OF_VIEW[view]}, {wrong}", ""
    if wrong:
        also = f"; {OF_VIEW[other]}, {wrong_too}" if wrong_too else ""
        doubts.append(
            f"the motion fits no view: {OF_VIEW[view]}, {wrong}{also}. Is it a ball on a curved rail, another scale or frame"
            f" rate? Trust none of these contacts, or try `view` {other}"
        )
    elif unsure and second is not None and second.measured:
        doubts.append(
            f"the frames do not show for sure from where it was filmed; {OF_VIEW[other]} (`view` {other}), out/in is"
            f" {restitutions_in_words(second.contacts)}"
        )
    said = f"assumed to be filmed {OF_VIEW[view]}, {KIND_OF_MOTION[view]}: {why} (`view` {other} overrides this)"
    return replace(found, view_reason=why, notes=(said, *doubts, *found.notes))


def _in_view(
    film: Measured, view: View, settings: Settings, groups: dict[str, list[Track]], progress: Progress | None
) -> Measured:
    """Find and measure the contacts of a film in a view."""
    gravity = flight_gravity(film.tracks, settings.gravity) if view == "side" else settings.gravity
    air, notes = STILL_AIR, list[str]()
    if view == "side":
        given = settings.walls is not None
        air, notes = air_and_notes(film.tracks, film.noise, film.interval, gravity, settings.drag_per_metre, given)
    walls = settings.walls
    turns = dict[tuple[str, str], list[Turn]]()
    if view == "side":
        turns = {
            (one.group, one.name): find_turns(one, film.noise, air.down, gravity, film.interval) for one in film.tracks
        }
    if walls is None:
        walls = tuple(find_walls(film.tracks, film.noise, SIDES[view], air.down))
        walls = floor_of_turns(walls, [*chain.from_iterable(turns.values())], air.down)
    elif view == "side":
        walls = tuple(facing_up(wall, film.tracks, film.noise, air.down) for wall in walls)
    radii = 2 * settings.radius if settings.radius else None

    def events_in(track: Track, noise: float) -> list[TrackEvent]:
        others = [other for other in groups[track.group] if other is not track]
        found = find_events(track, others, walls, noise, radii, film.interval)
        if view == "above":
            return found
        return with_turns(found, track, walls, noise, air.down, turns[track.group, track.name], film.interval)

    def fitted(noise: float) -> tuple[ContactFitter, list[TrackContact], list[str]]:
        """Fit the contacts that stand out of a noise."""
        events.update({(track.group, track.name): events_in(track, noise) for track in film.tracks})
        lines, said = {wall.name: wall for wall in walls}, list[str]()
        job = ContactFitter(replace(settings, gravity=gravity), view, lines, film.interval, film.noise, film.blind, air)
        return job, job.run(list(film.tracks), events, said, progress), said

    events = dict[tuple[str, str], list[TrackEvent]]()
    job, contacts, said = fitted(film.noise)
    # neighbouring frames differ by less than correlated noise, so that a ball at rest on the floor seems to bounce
    if (
        view == "side"
        and job.correlation != WHITE
        and any(events_in(track, job.noise) != events[track.group, track.name] for track in film.tracks)
    ):
        job, contacts, said = fitted(job.noise)
    if view == "side":
        contacts = only_level(contacts, walls, settings.kappa / (1 + settings.kappa))
        lost = sum(turn.lost and turn.meets for turn in chain.from_iterable(turns.values()))
        notes += elsewhere_notes(chain.from_iterable(events.values()), len(walls) > 1, lost)
    notes += said
    if view == "above":
        turned = list[str]()
        if settings.walls is None:
            contacts, turned = without_turned(contacts, film.tracks, events, film.noise, film.interval)
        unlisted = unlisted_turns(film.tracks, events, film.interval)
        notes += turned or elsewhere_notes(unlisted, len(walls) > 1, 0)
    notes += shared_error_notes(contacts, air)
    if not walls:
        notes.append("no wall found: no ball turns back at an extreme of the positions (`wall` gives one)")
    other = what_would_give(gravity, settings.gravity, film.interval) if gravity != settings.gravity else ""
    notes += _plausibility_notes(
        walls, events, job.floor.get("gravity", WithError(gravity, 0.0)).value, other, settings
    )
    return replace(
        film, view=view, walls=walls, events=events, contacts=tuple(contacts), noise=job.noise,
        correlation=job.correlation.neighbours, frame_correlation=job.correlation, blind=job.blind, air=air,
        floor=job.floor | ({"air drag": WithError(air.drag_per_metre, air.drag_error)} if air.drag_shown else {}),
        notes=tuple(notes),
    )  # fmt: skip


def _plausibility_notes(
    walls: Sequence[WallLine], events: dict[tuple[str, str], list[TrackEvent]], gravity: float, other: str,
    settings: Settings,
) -> list[str]:  # fmt: skip
    """Return notes on signs of a misplaced wall, or of a wrong scale, rate or view.

    ``gravity``: from the film, m/s^2; ``other``: the change that would make it the setting's, if known.
    """
    met = {event.what for some in events.values() for event in some}
    notes = [
        f"wall {wall.name}: no ball reaches it; `wall` is the line at which the ball's centre is reflected, in m"
        for wall in walls
        if not wall.found and wall.name not in met
    ]
    if not abs(gravity / settings.gravity - 1) < 0.1:
        notes.append(
            f"gravity is {gravity:.3g} m/s^2 in this film instead of {settings.gravity:.3g}: is the scale (`scale`),"
            f" the frame rate (`rate`) or the view (`view`) wrong?{f' {other[0].upper()}{other[1:]}' if other else ''}"
        )
    return notes
