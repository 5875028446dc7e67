"""Print a ranking of laws as a table, with its verdict and notes."""

from __future__ import annotations

import math
from collections.abc import Iterable
from typing import TYPE_CHECKING

from carom.formatting import counted

if TYPE_CHECKING:
    from carom.fitting import Ranking

__all__ = ["show", "show_unidentified"]

MAX_OUTLIERS = 10


def show(ranking: Ranking) -> None:
    """Print the ranking as a table, and the sentences below it."""
    from rich import box
    from rich.table import Table
    from rich.text import Text

    from carom.cli.console import out
    from carom.fitting.result import with_error_bar

    console = out()
    table = Table(box=box.SIMPLE_HEAD, pad_edge=False, header_style="bold")
    for head, side in (
        ("law", "left"),
        ("ΔAICc", "right"),
        ("weight", "right"),
        ("chi²/dof", "right"),
        ("CV score", "right"),
        ("parameters", "left"),
    ):
        table.add_column(head, justify=side, no_wrap=head != "parameters")  # type: ignore[arg-type]
    least = ranking.best.aicc
    for one in ranking.ranked:
        fit = one.fit
        goodness = "–" if fit.scatter or fit.dof <= 0 else f"{fit.chi2:.4g}/{fit.dof}"
        numbers = ", ".join(f"{name} {with_error_bar(estimate)}" for name, estimate in fit.estimates.items())
        numbers = ", ".join(part for part in (numbers, fit.scatter_in_words) if part) or "none"
        table.add_row(
            fit.law.name,
            f"{fit.aicc - least:.1f}",
            f"{one.weight:.3g}" if one.weight >= 1e-4 else "0",
            goodness,
            "–" if math.isnan(one.score) else f"{one.score:.3g}",
            numbers,
            style="bold" if one is ranking.ranked[0] else None,
        )
    console.print(table)
    console.print(Text(ranking.aicc_note, style="dim"), soft_wrap=True)
    console.print(Text(ranking.verdict, style="bold green" if ranking.decisive else "bold yellow"), soft_wrap=True)
    show_unidentified(ranking.degenerate)
    for outlier in ranking.outliers[:MAX_OUTLIERS]:
        console.print(Text(f"outlier: {outlier.row}: chi² {outlier.chi2:.1f}, {outlier.why}"), soft_wrap=True)
    if (more := len(ranking.outliers) - MAX_OUTLIERS) > 0:
        console.print(f"and {counted(more, 'more outlier')}")


def show_unidentified(sentences: Iterable[str]) -> None:
    """Print parameters that are not identifiable from the data, one law and parameter per line."""
    from rich.text import Text

    from carom.cli.console import out

    lines = list(sentences)
    if lines:
        out().print("Unconstrained parameters:")
    for line in lines:
        out().print(Text(f"  {line}"), soft_wrap=True)
