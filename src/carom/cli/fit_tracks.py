"""Output of ``carom fit TRACKS --whole``: laws fitted to whole tracks, each simulated from its own initial state."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from carom.errors import shortened_list

if TYPE_CHECKING:
    from carom.fitting import Ranked
    from carom.fitting.tracks import TrackFit, TrackRanking

__all__ = ["show_whole", "write_whole_page"]


def write_whole_page(ranking: TrackRanking, files: Sequence[Path], page: Path) -> Path:
    """Write the report, and return its path."""
    from carom.plot.fit_tracks import write_track_report

    return write_track_report(ranking, shortened_list([str(file) for file in files]), page)


def show_whole(ranking: TrackRanking) -> None:
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
