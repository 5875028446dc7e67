"""Output of ``carom fit TRACKS --shot``: whole shots, from the stroke to rest."""

from __future__ import annotations

import math
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from carom.errors import shortened_list

if TYPE_CHECKING:
    from carom.fitting import Ranked
    from carom.fitting.shots import ShotsFit, ShotsRanking

__all__ = ["show_shots", "write_shots_page"]


def write_shots_page(ranking: ShotsRanking, files: Sequence[Path], page: Path) -> Path:
    """Write the report, and return its path."""
    from carom.plot.shots import write_shots_report

    return write_shots_report(ranking, shortened_list([str(file) for file in files]), page)


def show_shots(ranking: ShotsRanking) -> None:
    """Print a ranking of fits to whole shots, then the sentences on the best one."""
    from rich.text import Text

    from carom.cli.console import out
    from carom.cli.ranking_output import print_ranking
    from carom.fitting.result import with_error_bar
    from carom.fitting.shots.result import HORIZONS
    from carom.formatting import counted

    best = ranking.best
    frames = sum(len(one.film.time) for one in best.shots)
    out().print(f"{counted(len(best.shots), 'shot')}, {frames:,} frames; noise {1e3 * best.noise:.2g} mm estimated")

    def cells(one: Ranked[ShotsFit]) -> tuple[str, ...]:
        numbers = ", ".join(f"{name} {with_error_bar(estimate)}" for name, estimate in one.fit.estimates.items())
        medians = (1e3 * one.fit.median(name) for name in HORIZONS)
        return (*("–" if math.isnan(mm) else f"{mm:.1f}" for mm in medians), numbers or "none")

    said = f"\nRMS distances in mm: median of the shots, to the first ball, through its cushions, to rest. Errors: {_errors(best)}"
    print_ranking(ranking, ("ball", "1", "2", "3 cushions", "whole"), cells, said)
    for line in best.describe()[1:]:
        out().print(Text(line), soft_wrap=True)


def _errors(fit: ShotsFit) -> str:
    return (
        "from the scatter of shots."
        if fit.by_shots
        else "from the residuals of the frames, of which correlated ones count as one."
    )
