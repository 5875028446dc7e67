"""Fit laws to whole tracks and rank them: which law the tracks favour, and with what odds."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from carom.errors import CaromError
from carom.files import require_library
from carom.fitting.by_shots import RankedByShots, compared_by_shots
from carom.fitting.evidence import DECIDED, LEANS, Evidence, odds_in_words, verdict_words, weigh
from carom.fitting.ranking import step_callback
from carom.fitting.setting import Setting, require_settings
from carom.fitting.tracks.errors import MISFIT_AS_NOISE
from carom.fitting.tracks.fit import starting_numbers
from carom.fitting.tracks.model import track_models
from carom.fitting.tracks.result import TrackFit
from carom.fitting.tracks.search import fit_track_law
from carom.fitting.tracks.segments import find_segments
from carom.fitting.tracks.stages import distances_through_contacts, failing_part
from carom.formatting import json_value
from carom.laws.registry import one_or_several
from carom.public.progress import Progress
from carom.tracks.measurement import Measured

__all__ = ["TrackRanking", "fit_tracks"]

Array = NDArray[np.float64]


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
    compared = compared_by_shots(fits, evidence, lambda fit: np.array([fit.rms(one) for one in best.frames.groups]))
    support, reason, odds = compared.support, compared.reason, math.nan
    if best.follows and evidence.rival is not None:
        odds = support = evidence.odds
        reason = f"{odds_in_words(odds)} over {evidence.rival.law.name}"
    verdict, decisive = _verdict(best, evidence, support, reason)
    distances = np.zeros(0) if best.follows else distances_through_contacts(best)
    if failing := failing_part(distances, best.noise):
        notes.append(f"{best.law.name}: {failing}")
    return TrackRanking(
        **compared.fields, verdict=verdict, odds=odds, notes=tuple(notes), decisive=decisive, distances=distances
    )


def _verdict(best: TrackFit, evidence: Evidence, support: float, reason: str) -> tuple[str, bool]:
    """Return the verdict, and whether it is a decision. Where no law follows the frames, these are not independent, and the
    verdict is by shots."""
    from carom.formatting import format_length

    first = ""
    if not best.follows:
        worst = best.frames.segments[int(np.argmax(best.scatter))].label
        scatter, noise = (format_length(size) for size in (float(np.median(best.scatter)), best.noise))
        first = f"No law fits: the best, {best.law.called}, leaves {scatter} where the noise is {noise}"
        first += f", chi^2 {best.chi2:.0f} for {best.dof:.0f} degrees of freedom" if best.known else ""
        first += f", most in {worst}" if len(best.scatter) > 1 else ""
        loose = any(estimate.note == MISFIT_AS_NOISE for estimate in best.estimates.values())
        first += "; its error bars take this as noise that is correlated from frame to frame. " if loose else ". "
    said = verdict_words(best.law.called, evidence, "the tracks", support, reason)
    if support < LEANS and not best.follows:
        said += f"; {best.law.name} is {reason}"
    decided = evidence.rival is not None and support >= DECIDED
    return f"{first}{said[0].upper()}{said[1:]}.", decided
