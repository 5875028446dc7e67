"""Print a ranking of laws, fitted to rebounds or to whole tracks, as a table, with its verdict and notes."""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, Any

from carom.formatting import counted

if TYPE_CHECKING:
    from carom.fitting import Fit, Ranked, Ranking, RankingsBy
    from carom.fitting.form_choice import FormChoice
    from carom.fitting.shots import ShotsRanking
    from carom.fitting.tracks import TrackRanking

__all__ = ["print_ranking", "show", "show_each"]

MAX_OUTLIERS = 10
GAP, EDGES = 3, 2  # characters between columns, and at both edges of a table
LEAST_ROOM = 26  # characters, for the longest names of parameters


def show(ranking: Ranking) -> None:
    """Print a ranking of fits to rebounds."""
    from rich.text import Text

    from carom.cli.console import out
    from carom.fitting.result import with_error_bar

    def cells(one: Ranked[Fit]) -> tuple[str, ...]:
        fit = one.fit
        numbers = ", ".join(f"{name} {with_error_bar(estimate)}" for name, estimate in fit.estimates.items())
        return (
            f"{one.weight:.3g}" if one.weight >= 1e-4 else "0",
            "–" if fit.scatter or fit.dof <= 0 else f"{fit.chi2:.4g}/{fit.dof}",
            "–" if math.isnan(one.score) else f"{one.score:.3g}",
            ", ".join(part for part in (numbers, fit.scatter_in_words) if part) or "none",
        )

    print_ranking(ranking, ("weight", "chi²/dof", "CV score"), cells)
    for choice in ranking.forms:
        _print_forms(choice)
    for outlier in ranking.outliers[:MAX_OUTLIERS]:
        out().print(Text(f"outlier: {outlier.row}: chi² {outlier.chi2:.1f}, {outlier.why}"), soft_wrap=True)
    if (more := len(ranking.outliers) - MAX_OUTLIERS) > 0:
        out().print(f"and {counted(more, 'more outlier')}")


def _print_forms(choice: FormChoice) -> None:
    """Print the functions of the impact that were tried for a law's parameters, and the choice."""
    from rich import box
    from rich.table import Table
    from rich.text import Text

    from carom.cli.console import out

    table = Table(box=box.SIMPLE_HEAD, pad_edge=False, header_style="bold")
    for head in (f"{choice.law}: parameters as", "ΔAICc", "held-out score", "gain"):
        table.add_column(head, justify="left" if head.startswith(choice.law) else "right", no_wrap=True)
    first = choice.tried[0]
    for i, one in enumerate(choice.tried):
        gain = f"{one.gain:+.3f} ± {one.gain_error:.3f}" if i else ""
        cells = (one.words, f"{one.aicc - first.aicc:+.1f}", f"{one.score:.3f}", gain)
        table.add_row(*cells, style="bold" if i in choice.chosen else None)
    out().print(table)
    out().print(Text(f"{choice.sentence}."), soft_wrap=True)


def show_each(rankings: RankingsBy) -> None:
    """Print the rankings of the values of a column, one after the other."""
    from rich.text import Text

    from carom.cli.console import out

    for value, ranking in rankings.items():
        out().print(Text(f"{rankings.column} {value}", style="bold"))
        show(ranking)


def _in_lines(parameters: str, room: int) -> str:
    """Return names with their numbers in lines of so many characters, which end between two of them, or before a number."""
    lines: list[str] = []
    for item in re.split(r"(?<=,) (?=[a-z])", parameters):
        if lines and len(lines[-1]) + 1 + len(item) <= room:
            lines[-1] += f" {item}"
        else:
            lines += [item] if len(item) <= room else item.split(" ", 1)
    return "\n".join(lines)


def print_ranking(
    ranking: Ranking | TrackRanking | ShotsRanking,
    heads: Sequence[str],
    cells: Callable[[Any], Sequence[str]],
    more: str = "",
) -> None:
    """Print the laws as a table, best first, and the sentences below it.

    ``cells`` of a ranked fit: one for each of ``heads``, and the parameters; ``more``: a note on the columns.
    """
    from rich import box
    from rich.table import Table
    from rich.text import Text

    from carom.cli.console import out

    table = Table(box=box.SIMPLE_HEAD, pad_edge=False, header_style="bold")
    names = ("law", "ΔAICc", *heads, "parameters")
    for head in names:
        words = head in ("law", "parameters")
        table.add_column(head, justify="left" if words else "right", no_wrap=head != "parameters")
    rows = [(one.fit.law.name, f"{one.fit.aicc - ranking.best.aicc:.1f}", *cells(one)) for one in ranking.ranked]
    others = list(zip(names, *rows, strict=True))[:-1]
    room = out().width - EDGES - sum(GAP + max(map(len, column)) for column in others)
    beside = room >= LEAST_ROOM
    if not beside:  # the numbers of each law stand below the table
        table.columns.pop()
    for i, row in enumerate(rows):
        table.add_row(*row[:-1], *([_in_lines(row[-1], room)] if beside else []), style=None if i else "bold")
    out().print(table)
    for law, *_cells, numbers in [] if beside else rows:
        out().print(Text(f"{law}: {numbers}"))
    out().print(Text(f"{ranking.aicc_note}{more}", style="dim"), soft_wrap=True)
    out().print(Text(ranking.verdict, style="bold green" if ranking.decisive else "bold yellow"), soft_wrap=True)
    if unidentified := dict.fromkeys(ranking.degenerate):
        out().print("Unconstrained parameters:")
    for line in unidentified:
        out().print(Text(f"  {line}"), soft_wrap=True)
