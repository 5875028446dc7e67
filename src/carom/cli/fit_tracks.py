"""``carom fit TRACKS --whole``: fit laws to whole tracks, each simulated from its own initial state."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

from carom.cli.common import attempt, noting, tell, write_report_page
from carom.cli.option_names import with_options
from carom.cli.options import parse_length
from carom.errors import CaromError, shortened_list

if TYPE_CHECKING:
    from carom.fitting import Ranked, Setting
    from carom.fitting.tracks import TrackFit, TrackRanking
    from carom.tracks.formats.text_table import Calibration

__all__ = ["TRACK_NUMBERS", "TrackOptions", "fit_track_files"]

TRACK_NUMBERS = ("rolling_resistance", "spin_loss", "wall_left", "wall_right", "wall_bottom", "wall_top")
"""Parameters of whole tracks that a table of rebounds does not have."""
MEASURING = 0.4  # of the progress bar, until all contacts are measured


class TrackOptions(NamedTuple):
    """Options of reading and simulating tracks."""

    view: str | None
    where: Sequence[str]
    cushions: int
    noise: str | None
    reading: Calibration


def fit_track_files(
    files: Sequence[Path],
    given: Setting,
    laws: Sequence[str],
    frames: TrackOptions,
    page: Path | None,
    as_json: bool,
    faults: list[str],
    bar: Any,
) -> None:
    """Read, measure, fit, show. ``faults``: of the options, so far."""
    from carom.cli.console import err
    from carom.fitting.setting import require_settings
    from carom.fitting.tracks import fit_tracks
    from carom.tracks.contact import Settings
    from carom.tracks.film_files import is_track, tracks_of_films

    view, where, cushions, noise, reading = frames
    setting = replace(given, noise=attempt(faults, parse_length, "noise", noise), cushions=cushions)
    attempt(faults, lambda: require_settings(setting, whole=True))
    for file in files:
        if file.is_file() and attempt(faults, is_track, file) is False:
            faults.append(f"{file}: expected a track with --whole, got a table of rebounds; omit --whole")
    if view == "side":
        faults.append("--view: expected above with --whole (balls on a table), got side")
    if faults:
        raise CaromError(*faults)
    console = err()
    with bar(console) as say:
        settings = Settings(radius=setting.radius, kappa=setting.kappa, view="above", noise=setting.noise)
        measured = tracks_of_films(
            files,
            reading,
            settings,
            where=where,
            progress=lambda done, total, text: say(text, MEASURING * done / total),
        )
        with noting(measured.notes):
            ranking = fit_tracks(
                measured, setting, laws or None, say=lambda what, done: say(what, MEASURING + (1 - MEASURING) * done)
            )
        written = None if page is None else write_report_page(lambda: _page(with_options(ranking), files, page), say)
    tell(ranking, _show, as_json, console, written)


def _page(ranking: TrackRanking, files: Sequence[Path], page: Path) -> Path:
    from carom.plot.fit_tracks import write_track_report

    return write_track_report(ranking, shortened_list([str(file) for file in files]), page)


def _show(ranking: TrackRanking) -> None:
    """Print a ranking of fits to whole tracks."""
    from carom.cli.console import out
    from carom.cli.ranking_output import print_ranking
    from carom.fitting.result import with_error_bar
    from carom.formatting import counted

    best, tracks = ranking.best, ranking.best.frames.segments
    out().print(
        f"{counted(len(tracks), 'track segment')}, {counted(sum(len(one.contacts) for one in tracks), 'contact')},"
        f" {int(best.frames.count.sum()):,} frames; noise {1e3 * best.noise:.3g} mm {'as given' if best.known else 'estimated'}"
    )

    def cells(one: Ranked[TrackFit]) -> tuple[str, ...]:
        fit = one.fit
        known = [f"{name} {with_error_bar(e)}" for name, e in fit.estimates.items() if not name.startswith("wall_")]
        chi2 = f"{fit.chi2:.4g}/{fit.dof:.0f}" if fit.known else "–"
        return chi2, f"{1e3 * fit.median_rms:.3g}", ", ".join(known)

    over_all = f"{best.law.name} over all {1e3 * best.rms():.3g} mm"
    more = f"\nRMS: median of the segments; {over_all}. Wall positions: --json, --report"
    print_ranking(ranking, ("chi²/dof", "RMS, mm"), cells, more)
