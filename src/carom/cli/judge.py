"""``carom judge``: the laws of mechanics that a trajectory of balls violates."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from carom.cli.options import require_outputs, shared, wrote
from carom.cli.parameters import Given, of_library

if TYPE_CHECKING:
    from carom.tracks.verdicts import Judgement


@of_library("tracks.judgement:judge", "tracks.video.film:track_film")
def judge(
    table: Annotated[
        Path,
        typer.Argument(
            metavar="FILE",
            help="Columns t, x, y, maybe z, ball, wx, wy, wz, radius, mass, kappa (.csv, .parquet), frames (.json), or a film.",
        ),
    ],
    *,
    given: Given,
    strict: Annotated[bool, typer.Option("--strict", help="Exit with 1 where a law is violated.")] = False,
    plot: Annotated[Path | None, shared("plot")] = None,
    as_json: Annotated[bool, shared("json")] = False,
) -> None:
    """Check a trajectory (of a physics engine, a film or a video model) for violations of mechanics: which, when, how large."""
    from carom.cli.streams import say_json, say_notes
    from carom.tracks.judgement import judge as find

    require_outputs(given.faults, {"--plot": plot}, source=table)
    given.faults.raise_if_any()
    found = find(table, **given)
    if as_json:
        violations = [vars(one) | {"sigmas": one.sigmas} for one in found.violations]
        say_json(vars(found) | {"scores": found.scores, "violations": violations})
    else:
        say_notes(found.notes)
        _show(found)
    if plot is not None:
        from carom.plot.tracks import plot_judgement

        plot_judgement(found, plot)
        wrote(plot)
    if strict and found.violations:
        raise typer.Exit(1)


def _show(found: Judgement) -> None:
    from carom.cli.console import out
    from carom.formatting import Listing, format_number

    rows = []
    for law, text in found.laws.items():
        worst = found.worst(law)
        said = f"not checked: {found.unchecked[law]}" if law in found.unchecked else text
        if worst is not None:
            errors = "more than 1000" if worst.sigmas > 1000 else format_number(worst.sigmas, 2)
            said = f"{worst.time:.4g} s, {' and '.join(worst.balls)}: {worst.text} ({errors} errors)"
        rows.append((law, f"{found.checked[law]:,}", f"{len(found.of(law)):,}", said))
    out().table(Listing(("law", "checked", "violated", "the clearest violation"), rows), grid=True, fold=(0, 3))
    out().print("\n" + f"noise of a coordinate {found.noise:.2g} {found.unit}\n" * bool(found.noise) + found.verdict)
