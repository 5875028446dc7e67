"""``carom fit TRACKS --whole``: fit laws to whole tracks, each simulated from its own initial state."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from carom.cli.common import attempt, tell, write_report_page
from carom.cli.option_names import with_options
from carom.errors import CaromError

if TYPE_CHECKING:
    from carom.fitting import Setting
    from carom.fitting.data_files import DataFiles
    from carom.fitting.tracks import TrackRanking

__all__ = ["TRACK_NUMBERS", "fit_track_files"]

TRACK_NUMBERS = ("rolling_resistance", "spin_loss", "wall_left", "wall_right", "wall_bottom", "wall_top")
"""Parameters of whole tracks that a table of rebounds does not have."""
MEASURING = 0.4  # of the progress bar, until all contacts are measured


def fit_track_files(
    source: DataFiles,
    setting: Setting,
    laws: Sequence[str],
    where: Sequence[str],
    page: Path | None,
    as_json: bool,
    faults: list[Any],
    bar: Any,
) -> None:
    """Read, measure, fit, show. ``faults``: of the options, so far."""
    from carom.cli.console import err
    from carom.fitting.setting import require_settings
    from carom.fitting.tracks import fit_tracks

    attempt(faults, lambda: require_settings(setting, whole=True))
    attempt(faults, source.require_films)
    if faults:
        raise CaromError(*faults)
    console = err()
    with bar(console) as say:
        measured = source.tracks(setting, where, lambda done, total, text: say(text, MEASURING * done / total))
        ranking = fit_tracks(
            measured, setting, laws or None, say=lambda what, done: say(what, MEASURING + (1 - MEASURING) * done)
        )
        written = (
            None if page is None else write_report_page(lambda: _page(with_options(ranking), source.name, page), say)
        )
    tell(ranking, _show, as_json, console, written)


def _page(ranking: TrackRanking, name: str, page: Path) -> Path:
    from carom.plot.fit_tracks import write_track_report

    return write_track_report(ranking, name, page)


def _show(ranking: TrackRanking) -> None:
    """Print the ranking as a table, and the sentences below it."""
    from rich import box
    from rich.table import Table
    from rich.text import Text

    from carom.cli.console import out
    from carom.cli.ranking_output import show_unidentified
    from carom.fitting.result import with_error_bar
    from carom.formatting import counted

    console, best = out(), ranking.best
    tracks = best.frames.segments
    console.print(
        f"{counted(len(tracks), 'track segment')}, {counted(sum(len(one.contacts) for one in tracks), 'contact')},"
        f" {int(best.frames.count.sum()):,} frames; noise {1e3 * best.noise:.3g} mm {'as given' if best.known else 'estimated'}"
    )
    table = Table(box=box.SIMPLE_HEAD, pad_edge=False, header_style="bold")
    for head, side in (
        ("law", "left"),
        ("ΔAICc", "right"),
        ("chi²/dof", "right"),
        ("RMS, mm", "right"),
        ("parameters", "left"),
    ):
        table.add_column(head, justify=side, no_wrap=head != "parameters")  # type: ignore[arg-type]
    for fit in ranking.fits:
        numbers = ", ".join(
            f"{name} {with_error_bar(estimate)}"
            for name, estimate in fit.estimates.items()
            if not name.startswith("wall_")
        )
        table.add_row(
            fit.law.name,
            f"{fit.aicc - best.aicc:.1f}",
            f"{fit.chi2:.4g}/{fit.dof:.0f}" if fit.known else "–",
            f"{1e3 * fit.median_rms:.3g}",
            numbers,
            style="bold" if fit is best else None,
        )
    console.print(table)
    console.print(
        f"{ranking.aicc_note}\n"
        f"RMS: median of the segments; {best.law.name} over all {1e3 * best.rms():.3g} mm. Wall positions: --json, --report",
        style="dim",
    )
    console.print(Text(ranking.verdict, style="bold green" if ranking.decisive else "bold yellow"), soft_wrap=True)
    show_unidentified(dict.fromkeys(s for fit in ranking.fits for s in fit.degenerate))
