"""``carom judge``: the laws of mechanics that a trajectory of balls violates."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from carom.cli.options import of_films, parse_scale, quantity, require_outputs, shared, wrote
from carom.errors import FaultList

if TYPE_CHECKING:
    from carom.tracks.judgement import Judgement


def register(app: typer.Typer) -> None:
    """Add the verb to the command."""
    app.command()(judge)


def judge(
    table: Annotated[
        Path,
        typer.Argument(
            metavar="FILE",
            help="Columns t, x, y, maybe z, ball, wx, wy, wz, radius, mass (.csv, .parquet), .json of saved frames, or a film.",
        ),
    ],
    radius: Annotated[
        float | None,
        typer.Option(help="Of the balls, m. Default: each ball's least height.", **quantity("--radius", "m")),
    ] = None,
    mass: Annotated[float, typer.Option(help="Of the balls, kg.", **quantity("--mass", "kg"))] = 0.17,
    friction: Annotated[float, typer.Option(help="Largest friction between balls that counts as possible.")] = 1.0,
    floor_friction: Annotated[float, typer.Option(help="Largest friction of the floor that counts as possible.")] = 1.0,
    slope: Annotated[
        str | None, typer.Option(metavar="X,Y", help="How far the floor falls per metre along x and y. Default: level.")
    ] = None,
    noise: Annotated[
        float | None,
        typer.Option(help="Standard deviation of a coordinate, m. Default: estimated.", **quantity("--noise", "m")),
    ] = None,
    scale: Annotated[str | None, shared("scale", default="of a film: by gravity, or the radius")] = None,
    rate: Annotated[float | None, shared("rate", default="from the times")] = None,
    length: Annotated[str | None, shared("length")] = None,
    readout: Annotated[float | None, shared("readout")] = None,
    ball: Annotated[list[str] | None, shared("ball")] = None,
    colour: Annotated[str | None, shared("colour")] = None,
    region: Annotated[str | None, shared("region")] = None,
    start: Annotated[float | None, shared("start")] = None,
    end: Annotated[float | None, shared("end")] = None,
    strict: Annotated[bool, typer.Option("--strict", help="Exit with 1 where a law is violated.")] = False,
    plot: Annotated[Path | None, shared("plot")] = None,
    as_json: Annotated[bool, shared("json")] = False,
) -> None:
    """Find which laws of mechanics a trajectory violates, when, and by how many error bars: of an engine, a film, a video model."""
    from carom.cli.options import parse_pair
    from carom.cli.streams import say_json, say_notes
    from carom.tracks.judgement import judge as find

    faults = FaultList()
    require_outputs(faults, {"--plot": plot}, source=table)
    faults.raise_if_any()
    falls = (0.0, 0.0) if slope is None else parse_pair("--slope", slope)
    film = of_films(
        length=length, readout=readout, ball=ball, colour=colour, region=region, start=start, end=end,
        balls=len(ball) if ball else None,
    )  # fmt: skip
    found = find(
        table, radius=radius, mass=mass, friction=friction, floor_friction=floor_friction, slope=falls, noise=noise,
        scale=parse_scale(scale), rate=rate, film=film,
    )  # fmt: skip
    if as_json:
        say_json(vars(found) | {"violations": [vars(one) | {"sigmas": one.sigmas} for one in found.violations]})
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
    from rich.table import Table

    from carom.cli.console import out
    from carom.formatting import format_number
    from carom.tracks.judgement import LAWS

    table = Table(box=None)
    for name, side in (
        ("law", "left"),
        ("checked", "right"),
        ("violated", "right"),
        ("the clearest violation", "left"),
    ):
        table.add_column(name, justify=side)  # type: ignore[arg-type]
    for law, text in LAWS.items():
        worst = found.worst(law)
        said = f"not checked: {found.unchecked[law]}" if law in found.unchecked else text
        if worst is not None:
            errors = "more than 1000" if worst.sigmas > 1000 else format_number(worst.sigmas, 2)
            said = f"{worst.time:.4g} s, {' and '.join(worst.balls)}: {worst.text} ({errors} errors)"
        table.add_row(law, f"{found.checked[law]:,}", f"{len(found.of(law)):,}", said)
    out().print(table)
    out().print(f"\nnoise of a coordinate {found.noise:.2g} m\n{found.verdict}")
