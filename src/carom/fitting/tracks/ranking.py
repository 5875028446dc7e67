"""Fit laws to whole tracks and rank them: which law the tracks favour, and with what odds."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, field
from itertools import pairwise
from typing import Any

import numpy as np
from numpy.typing import NDArray

from carom.errors import CaromError
from carom.files import require_library
from carom.fitting.evidence import weigh
from carom.fitting.ranking import step_callback
from carom.fitting.rows import Setting, require_settings
from carom.fitting.table_numbers import RankedByShots, compared_by_shots
from carom.fitting.tracks.fit import fit_track_law, starting_numbers, with_best_sidespins
from carom.fitting.tracks.model import find_segments, track_models
from carom.fitting.tracks.objective import MISFIT_AS_NOISE, TrackFit, settle
from carom.formatting import format_length, json_value
from carom.laws.registry import one_or_several
from carom.public.progress import Progress
from carom.tracks.measurement import Measured

Array = NDArray[np.float64]
LEAST_SEGMENTS = 3  # for a median
CLOTH = 3.0  # times the noise: larger distances before any contact are the cloth's
GROWTH = 1.5  # from one number of contacts to the next, for which the contacts are to blame


def distances_through_contacts(fit: TrackFit) -> Array:
    """Return the median over segments of the RMS distance (m) up to the first contact, through one contact, two, ...

    Each start is fitted anew to the frames of its stage alone, with the shared parameters of the fit, so that no stage pays for a
    later one. Stages with fewer than LEAST_SEGMENTS segments are left out.
    """
    table, found = fit.model.table(fit.numbers), []
    for contacts in range(1 + max(len(one.contacts) for one in fit.frames.segments)):
        which = np.array([n for n, one in enumerate(fit.frames.segments) if len(one.contacts) >= contacts])
        if len(which) < LEAST_SEGMENTS:
            break
        frames, starts, q = fit.frames.until(contacts).pick(which), fit.starts.pick(which), fit.q[which]
        if contacts:
            q = with_best_sidespins(fit.model, frames, starts, q, fit.numbers)
        gap = settle(table, frames, starts, q).gap * frames.sigma[:, None]
        found.append(float(np.median(np.sqrt((gap * gap).sum(axis=1) / frames.count))))
    return np.array(found)


def failing_part(distances: Sequence[float] | Array, noise: float) -> str:
    """Return a sentence on where a law leaves the frames; empty if there are too few segments to tell.

    Examples
    --------
    >>> from carom.fitting.tracks.ranking import failing_part
    >>> print(failing_part([0.0007, 0.002, 0.005], 0.0004))
    distance from the frames up to the first contact: 700 µm, through 1 contact: 2 mm, through 2: 5 mm (noise of a frame: 566 µm); \
worst described: the contacts
    """
    if not len(distances):
        return ""
    of_frame = float(np.sqrt(2.0)) * noise
    stages = [f"up to the first contact: {format_length(distances[0])}"]
    stages += [
        f"through {n}{' contact' if n == 1 else ''}: {format_length(distance)}"
        for n, distance in enumerate(distances[1:], 1)
    ]
    worst = []
    if distances[0] > CLOTH * of_frame:
        worst.append("the motion on the cloth before any contact (a slope, an obstacle that was not tracked)")
    if any(after > GROWTH * before for before, after in pairwise(distances)):
        worst.append("the contacts")
    said = f"distance from the frames {', '.join(stages)} (noise of a frame: {format_length(of_frame)})"
    return f"{said}; worst described: {', '.join(worst)}" if worst else said


# ----------------------------------------------------------------------------------------------------
# Fit laws to whole tracks and rank them: which law the tracks favour, and with what odds.


@dataclass(frozen=True, eq=False, repr=False)
class TrackRanking(RankedByShots[TrackFit]):
    """All laws fitted to whole tracks, best first, and the verdict; made by :func:`fit_tracks`, with an example there.

    If no law follows the frames to within their noise, weights are overconfident, and the verdict counts shots.
    """

    distances: Array = field(default_factory=lambda: np.zeros(0))
    """m: of the best law, up to the first contact, through one contact, two, ...; empty where it follows the frames."""

    @property
    def fits(self) -> tuple[TrackFit, ...]:
        """The fits, best first."""
        return tuple(one.fit for one in self.ranked)

    @property
    def weights(self) -> Array:
        """Their Akaike weights."""
        return np.array([one.weight for one in self.ranked])

    def as_dict(self) -> dict[str, Any]:
        """Return the ranking for JSON: numbers in full precision, None where there is none."""
        best = self.best
        return super().as_dict() | {
            "follows": best.follows,
            "closer_in": None if self.closer is None else {"shots": self.closer[0], "of": self.closer[1]},
            "chance": json_value(self.chance),
            "distance_through_contacts": self.distances.tolist(),
            "noise": best.noise,
            "noise_given": best.known,
            "tracks": [
                {
                    "shot": one.group, "ball": one.name, "since": one.since, "frames": int(best.frames.count[n]),
                    "walls": list(one.walls), "contacts": one.contacts.tolist(),
                    "slides_at_start": bool(best.starts.free[n].all()),
                    "rms": {fit.law.name: fit.rms([n]) for fit in self.fits},
                    "start": {fit.law.name: fit.start(n).tolist() for fit in self.fits},
                }
                for n, one in enumerate(best.frames.segments)
            ],
        }  # fmt: skip


def fit_tracks(
    measured: Measured, setting: Setting, laws: str | Sequence[str] | None = None, *, progress: Progress | None = None
) -> TrackRanking:
    """Fit laws to whole tracks by simulating every ball, and rank them.

    Parameters
    ----------
    measured : Measured
        Tracks with their walls and contacts (:func:`carom.tracks.measurement.measure`).
    setting : Setting
        The ball, the noise, and the extent of the simulation.
    laws : str or sequence of str, optional
        Names. Default: all laws for balls on a table.
    progress : callable(done, total, text), optional
        Called with the fraction done, 1, and the current step.

    Returns
    -------
    TrackRanking
        All laws, best first, with a verdict.

    Raises
    ------
    CaromError
        If no track can be simulated, or for an invalid setting, one line per problem.

    Examples
    --------
    >>> import carom
    >>> import numpy as np
    >>> from carom.fitting import Setting
    >>> from carom.fitting.tracks import fit_tracks
    >>> from carom.tracks import Settings, Track, measure
    >>> wall = carom.scene.Plane(point=(0, 0, 0), normal=(1, 0, 0), restitution=0.8, friction=0.2)
    >>> ball = carom.SceneBall(radius=0.03, mass=0.2, position=(0.5, 0.1), velocity=(-1.5, 0.5), rolling=True)
    >>> scene = carom.Scene(floor=carom.Floor(friction=0.2), walls=[wall], balls=[ball], run=carom.Run(duration=1))
    >>> run, t = carom.simulate(scene), np.arange(120) / 120
    >>> track = Track("ball", t, np.array([run.at(time).position[0, :2] for time in t]))
    >>> measured = measure([track], Settings(radius=0.03, view="above", noise=1e-4))
    >>> ranking = fit_tracks(measured, Setting(radius=0.03, noise=1e-4), ["two-step"])
    >>> round(ranking.best.estimates["restitution"].value, 3)
    0.8
    """
    require_library("scipy", "fit")
    if measured.view != "above":
        raise CaromError(
            "tracks: expected balls on a table, seen from above, got balls in flight; fit their rebounds instead"
        )
    require_settings(setting, whole=True)
    found, notes = find_segments(measured, setting.cushions, setting.after)
    if not found:
        raise CaromError(
            "tracks: expected a ball that is seen before and after a wall, without another contact in between, got none"
            + "".join(f"; {note}" for note in notes)
        )
    tell = step_callback(progress)
    chosen, more = track_models(
        one_or_several("fit_tracks", laws) if laws else None, setting, measured.walls, starting_numbers(measured)
    )
    fits = []
    for i, model in enumerate(chosen):

        def part(done: float, i: int = i, name: str = model.law.name) -> None:
            tell(f"fit {name}", (i + done) / len(chosen))

        part(0.0)
        fits.append(fit_track_law(model, found, measured.noise, part))
    fits.sort(key=lambda fit: fit.aicc)
    notes = [*measured.notes, *more, *notes]
    rolling = [fit.law.name for fit in fits if fit.model.rolling_only]
    if rolling and any(one.slides for one in found):
        notes.append(f"{', '.join(rolling)}: for balls that roll; balls that slide at the start were assumed to roll")
    return _ranked(fits, notes)


def _ranked(fits: list[TrackFit], notes: list[str]) -> TrackRanking:
    best = fits[0]
    poor = best.known and not best.follows
    evidence = weigh(fits, max(math.sqrt(best.chi2 / max(best.dof, 1)), 1.0) if poor else 1.0)
    compared = compared_by_shots(
        fits, evidence, lambda fit: np.array([fit.rms(one) for one in best.frames.groups]), "the tracks",
        by_odds=best.follows, before=_misfit(best),
    )  # fmt: skip
    distances = np.zeros(0) if best.follows else distances_through_contacts(best)
    if failing := failing_part(distances, best.noise):
        notes.append(f"{best.law.name}: {failing}")
    return TrackRanking(**compared, notes=tuple(notes), distances=distances)


def _misfit(best: TrackFit) -> str:
    """Return why no law fits, as the beginning of the verdict; empty if the best one follows the frames."""
    if best.follows:
        return ""
    worst = best.frames.segments[int(np.argmax(best.scatter))].label
    scatter, noise = (format_length(size) for size in (float(np.median(best.scatter)), best.noise))
    said = f"No law fits: the best, {best.law.called}, leaves {scatter} where the noise is {noise}"
    said += f", chi^2 {best.chi2:.0f} for {best.dof:.0f} degrees of freedom" if best.known else ""
    said += f", most in {worst}" if len(best.scatter) > 1 else ""
    loose = any(estimate.note == MISFIT_AS_NOISE for estimate in best.estimates.values())
    return f"{said}{'; its error bars take this as noise that is correlated from frame to frame' if loose else ''}. "
