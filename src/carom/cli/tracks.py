"""``carom tracks show``: summary of a track file, and velocities before and after each contact with a wall.

``carom tracks example``: films to try it with.
"""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer
from rich.console import Console

from carom.cli.common import require_outputs, wrote
from carom.cli.console import err
from carom.cli.console import out as stdout
from carom.cli.options import FLOOR, option, parse_length, shared
from carom.cli.pair_output import pair_facts, tell_pairs
from carom.cli.progress import working
from carom.cli.streams import say_json
from carom.cli.tracks_output import facts, tell, tell_contacts
from carom.cli.verbs import App
from carom.errors import CaromError, FaultList, shortened_list
from carom.formatting import counted
from carom.public.defaults import GRAVITY, WINDOW

if TYPE_CHECKING:
    from carom.data.rebounds import Rebounds
    from carom.tracks.film_files import MeasuredFilms
    from carom.tracks.measurement import Measured
    from carom.tracks.read import TrackFile

TABLES = (".csv", ".txt", ".parquet", ".pq")
FILE, FIT = "Track file", "Contact fits"

tracks = App(help="Tracks of filmed balls: summarise a file, and measure its rebounds.")


def register(app: typer.Typer) -> None:
    """Add the verb."""
    tracks.command()(show)
    tracks.command()(example)
    app.add_typer(tracks, name="tracks")


def show(
    files: Annotated[
        list[Path],
        typer.Argument(
            metavar="FILE",
            help="Files from Tracker, Kinovea, trackpy, DeepLabCut ..., or columns t, x, y; several films make one table.",
        ),
    ],
    out: Annotated[Path | None, typer.Option(help="Write the rebounds: .csv or .parquet.")] = None,
    plot: Annotated[Path | None, shared("plot")] = None,
    json_: Annotated[bool, shared("json")] = False,
    stage: Annotated[str, typer.Option(help="Stage of balls on a table: best, after_wall, rolling or both.")] = "best",
    sliding: Annotated[
        bool, typer.Option("--sliding", help="Keep balls that are still sliding when they meet the wall.")
    ] = False,
    balls: Annotated[bool, shared("balls")] = False,
    format_: Annotated[str | None, option(FILE, "Format of the file; overrides detection.", "--format")] = None,
    scale: Annotated[str | None, shared("scale", rich_help_panel=FILE)] = None,
    rate: Annotated[float | None, shared("rate", rich_help_panel=FILE)] = None,
    down: Annotated[bool | None, option(FILE, "The second axis points down, as in images.", "--down/--up")] = None,
    view: Annotated[str | None, shared("view", default="by the motion", rich_help_panel=FILE)] = None,
    radius: Annotated[
        float | None,
        shared(
            "radius", help="Radius, 0.03075 (m) or 30.75mm; needed where several balls are filmed; 0: they cannot meet."
        ),
    ] = None,
    inertia: Annotated[str, shared("inertia")] = "solid",
    wall: Annotated[
        list[str] | None,
        option(
            FLOOR, "Line at which the ball's centre is reflected: x=0.03, y=1.4 or x1,y1,x2,y2 (m); may be repeated."
        ),
    ] = None,
    hard: Annotated[bool, option(FLOOR, "The wall is rigid: both motions meet on its line.", "--hard")] = False,
    floor_friction: Annotated[
        float | None, option(FLOOR, "Coulomb friction of the floor. Default: fitted.", "--floor-friction", "--cloth")
    ] = None,
    rolling_resistance: Annotated[
        float | None,
        option(FLOOR, "Deceleration / g of a rolling ball. Default: fitted.", "--rolling-resistance", "--rolling"),
    ] = None,
    gravity: Annotated[float, shared("gravity")] = GRAVITY,
    drag: Annotated[
        float | None,
        option(FLOOR, "Air drag k, 1/m: it slows a ball of speed v down by k v^2. Default: from the flights."),
    ] = None,
    noise: Annotated[str | None, shared("noise", default="estimated", rich_help_panel=FIT)] = None,
    window: Annotated[float, option(FIT, "Time fitted before and after a contact, s.", "--window", unit="s")] = WINDOW,
    blind: Annotated[
        float | None,
        option(FIT, "Time excluded before and after a contact, s. Default: from the frames.", "--blind", unit="s"),
    ] = None,
) -> None:
    """Summarise track files (format, tracks, frame rate, noise), and measure their contacts by fitting the physics.

    carom tracks show films/*.txt --out rebounds.csv
    """
    from carom.bodies import inertia_number
    from carom.tracks.film_files import measure_tracks

    faults = FaultList()
    lengths = {name: faults.attempt(parse_length, name, text) for name, text in (("scale", scale), ("noise", noise))}
    faults.attempt(inertia_number, inertia)
    for name, value, known in (
        ("stage", stage, ("best", "after_wall", "rolling", "both")),
        ("view", view, ("above", "side")),
    ):
        if value is not None and value not in known:
            faults.add(f"--{name}", f"one of {', '.join(known)}", repr(value))
    for file in files:
        require_outputs(faults, {"--plot": plot, "--out": out}, {"--out": TABLES}, source=file)
    if plot is not None and len(files) > 1:
        faults.add("--plot", "one film", str(len(files)), "name one file")
    faults.raise_if_any()
    console = err()
    with working("contacts", console) as bar:
        films = measure_tracks(
            files, format=format_, scale=lengths["scale"], rate=rate, down=down, view=view, radius=radius, inertia=inertia,
            wall=wall or (), hard=hard, floor_friction=floor_friction, rolling_resistance=rolling_resistance, gravity=gravity,
            drag=drag, noise=lengths["noise"], window=window, blind=blind, progress=bar,
        )  # fmt: skip
    names, found, measured = films.names, films.files, films.measured
    written = None
    lacking = FaultList()
    table = lacking.attempt(films.rebounds, stage, sliding=sliding, balls=balls)
    if out is not None:
        if table is None:
            _notes(console, names, found, measured, None)
            raise CaromError(*lacking)
        written = (table.save(out), len(table))
    if plot is not None:
        from carom.plot.style import save
        from carom.plot.tracks import plot_tracks

        save(plot_tracks(measured[0]), plot)
    if json_:
        each = [facts(film, one, stage, sliding) for film, one in zip(found, measured, strict=True)]
        if balls:
            each = [
                one | {"ball_contacts": [*map(pair_facts, met)]} for one, met in zip(each, films.pairs, strict=True)
            ]
        say_json(each[0] if len(each) == 1 else {"films": each})
    else:
        _tell(films, stage, sliding, balls)
    _notes(console, names, found, measured, table)
    if written:
        console.print(f"{counted(written[1], 'rebound')} in the table")
        wrote(written[0])
    if plot is not None:
        wrote(plot)


def example(
    folder: Annotated[Path, typer.Argument(metavar="FOLDER", help="Folder for the files; made if it is not there.")],
) -> None:
    """Write sixteen synthetic films of a ball at a cushion, as Tracker exports them, to try the commands with.

    carom tracks example films && carom tracks show films/*.txt --radius 28.6mm --out rebounds.csv

    The ball has radius 28.6 mm, the cushion's nose a height of 36 mm; one shot per film, 60 frames per second.
    """
    from carom.fitting.example_films import write_example_films

    paths = write_example_films(folder)
    err().print(f"written: {paths[0]} to {paths[-1].name}", soft_wrap=True)


def _tell(films: MeasuredFilms, stage: str, sliding: bool, balls: bool) -> None:
    """Print a table of each film, and one of all contacts."""
    for name, film, one in zip(films.names, films.files, films.measured, strict=True):
        if name:
            stdout().print(f"{name}: {film.path}", style="bold", soft_wrap=True)
        tell(stdout(), film, one)
    if balls:
        tell_pairs(stdout(), list(zip(films.names, films.pairs, strict=True)))
    else:
        tell_contacts(stdout(), list(zip(films.names, films.measured, strict=True)), stage, sliding)


def _notes(
    console: Console,
    names: Sequence[str],
    found: Sequence[TrackFile],
    measured: Sequence[Measured],
    table: Rebounds | None,
) -> None:
    """Print the notes of all films, each once, and of their rebounds what the contacts alone do not show."""
    from carom.tracks.oblique import needs_lines

    films: dict[str, list[str]] = {}
    for name, film, one in zip(names, found, measured, strict=True):
        for note in dict.fromkeys((*film.notes, *one.notes)):
            films.setdefault(note, []).append(name)
    notes = [
        f"all {len(names)} films: {note}" if len(of) == len(names) > 1
        else ": ".join(filter(None, (shortened_list(of), note)))
        for note, of in films.items()
    ]  # fmt: skip
    bare = [name for name, one in zip(names, measured, strict=True) if not one.measured]
    if bare and len(names) > 1:
        notes.append(f"{shortened_list(bare)}: no contact measured")
    notes += [] if table is None else [note for note in table.notes if note.startswith(("energy:", "v_t_out:"))]
    if any(needs_lines(one.contacts) for one in measured):
        notes.append("--wall x1,y1,x2,y2 gives the line of a wall by two points (m), and may be repeated")
    for note in notes:
        console.print(note, style="dim", soft_wrap=True)
