"""A ranking of laws as a table, and what it says in words."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from carom.fitting import Ranking

__all__ = ["show"]


def show(ranking: Ranking) -> None:
    """The ranking as a table, and the sentences below it."""
    from rich import box
    from rich.table import Table
    from rich.text import Text

    from carom.cli.shared import out
    from carom.fitting.output import with_error_bar

    console = out()
    table = Table(box=box.SIMPLE_HEAD, pad_edge=False, header_style="bold")
    for head, side in (
        ("law", "left"),
        ("AICc", "right"),
        ("weight", "right"),
        ("chi²/dof", "right"),
        ("CV score", "right"),
        ("numbers", "left"),
    ):
        table.add_column(head, justify=side, no_wrap=head != "numbers")  # type: ignore[arg-type]
    least = ranking.best.aicc
    for one in ranking.ranked:
        fit = one.fit
        goodness = "–" if fit.scatter or fit.dof <= 0 else f"{fit.chi2:.4g}/{fit.dof}"
        numbers = ", ".join(f"{name} {with_error_bar(estimate)}" for name, estimate in fit.estimates.items()) or "none"
        table.add_row(
            fit.law.name,
            f"{fit.aicc:.1f}" if one is ranking.ranked[0] else f"+{fit.aicc - least:.1f}",
            f"{one.weight:.3g}" if one.weight >= 1e-4 else "0",
            goodness,
            "–" if math.isnan(one.score) else f"{one.score:.3g}",
            numbers,
            style="bold" if one is ranking.ranked[0] else None,
        )
    console.print(table)
    console.print(
        Text(
            ranking.verdict,
            style="bold green" if ranking.fits and ranking.odds >= 20 and not ranking.swayed else "bold yellow",
        ),
        soft_wrap=True,
    )
    for sentence in ranking.degenerate:
        console.print(Text(f"not told: {sentence}"), soft_wrap=True)
    for outlier in ranking.outliers[:10]:
        console.print(Text(f"outlier: {outlier.row}: chi² {outlier.chi2:.1f}, {outlier.why}"), soft_wrap=True)
    if len(ranking.outliers) > 10:
        console.print(f"and {len(ranking.outliers) - 10} more outliers")
