"""Fit all contacts of some tracks, in rounds: all contacts together determine the floor and the noise for the next round."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, replace

import numpy as np
from numpy.typing import NDArray

from carom.formatting import counted
from carom.tracks.camera import oblique_note, without_oblique
from carom.tracks.contact import (
    BlindTime,
    Settings,
    TrackContact,
    View,
    estimate_blind_time,
    motion_before_resolved,
    tracked_spin,
    without_smooth_turns,
)
from carom.tracks.contact_models import fit_table, friction_excess
from carom.tracks.events import BEYOND_WALL_M, TrackEvent, WallLine, flight_ends, velocity_jump
from carom.tracks.flights import STILL_AIR, Air, fit_flight
from carom.tracks.floor import DECISIVE, WithError, averaged, hop_notes, pool_floor, pool_gravity, with_hops
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
from carom.tracks.plausibility import restitutions_in_words
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
            found, verdict = _on_either_floor(found, straight, excess)
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


def _on_either_floor(
    sliding: Sequence[TrackContact], straight: Sequence[TrackContact], excess: float
) -> tuple[list[TrackContact], list[str]]:
    """Return contacts that are fitted with and without friction of the floor, as its verdict has them, and a note on it.

    A ball that rolls into a wall leaves it sliding, and friction slows it down and turns it; on an air table it goes straight on.
    In doubt the velocities are means of both, and their error bars contain the difference.
    ``excess``: by how much all of them together are fitted worse with friction, which is not certain.
    """
    straight = [replace(one, friction_excess=its.friction_excess) for one, its in zip(straight, sliding, strict=True)]
    if excess >= DECISIVE:
        return straight, [
            "the floor has no friction, as of an air table: the ball goes straight on at constant speed where friction would"
            " slow it down after a wall; its spin is unknown (`floor_friction` gives one)"
        ]
    likelier, other = (straight, sliding) if excess > 0 else (sliding, straight)
    share = 1 / (1 + float(np.exp(abs(excess) / 2)))
    mixed = [
        replace(one, fit=averaged(one.fit, its.fit, share)) if one.fit is not None and its.fit is not None else one
        for one, its in zip(likelier, other, strict=True)
    ]
    told = [f"{restitutions_in_words(some)} {how} friction" for some, how in ((sliding, "with"), (straight, "without"))]
    return mixed, [
        f"the frames do not show whether the floor has friction: out/in is {told[0]}, {told[1]}; the velocities after the contacts"
        " are means of both, and their error bars contain the difference (`floor_friction` 0, as of an air table, or 0.2 decides)"
    ]
