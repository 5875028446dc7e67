"""``carom tracks show``: what a track file holds, the contacts in it, and the rebounds that can be measured."""

from __future__ import annotations

import json
import math
from collections import Counter
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer
from rich.console import Console
from rich.markup import escape

from carom.cli.fit_options import length_of
from carom.cli.places import require_places
from carom.cli.shared import attempt, wrote
from carom.cli.shared import out as stdout
from carom.errors import CaromError

if TYPE_CHECKING:
    from carom.tracks.contact import Contact
    from carom.tracks.measure import Measured
    from carom.tracks.read import TrackFile

FILE, BALL, FLOOR, FIT = "What the file may lack", "The ball", "Walls and floor", "The fits"
MOST_TRACKS, MOST_CONTACTS = 12, 30

tracks = typer.Typer(help="Tracks of filmed balls: what a file holds, and the rebounds in it.", no_args_is_help=True)


def register(app: typer.Typer) -> None:
    """Add the verb."""
    tracks.command()(show)
    app.add_typer(tracks, name="tracks")


def show(
    file: Annotated[
        Path, typer.Argument(help="as Tracker, Kinovea, trackpy, DeepLabCut... wrote it, or columns t, x, y")
    ],
    out: Annotated[Path | None, typer.Option(help="write the rebounds here, .csv or .parquet")] = None,
    plot: Annotated[Path | None, typer.Option(help="draw a picture, .svg, .pdf or .png")] = None,
    json_: Annotated[bool, typer.Option("--json", help="everything as JSON on standard output")] = False,
    stage: Annotated[str, typer.Option(help="of a table: best, after_wall, rolling or both")] = "best",
    sliding: Annotated[
        bool, typer.Option("--sliding", help="keep balls that still slide when they meet the wall")
    ] = False,
    format_: Annotated[str | None, typer.Option("--format", help="overrules the guess", rich_help_panel=FILE)] = None,
    scale: Annotated[
        str | None, typer.Option(help="m to one unit of the file, a pixel say: 0.0005 or 0.5mm", rich_help_panel=FILE)
    ] = None,
    rate: Annotated[float | None, typer.Option(help="frames a second", rich_help_panel=FILE)] = None,
    down: Annotated[
        bool | None,
        typer.Option("--down/--up", help="the second axis points down, as in pictures", rich_help_panel=FILE),
    ] = None,
    view: Annotated[
        str | None,
        typer.Option(help="above (a table) or side (in flight); left out: by how it moves", rich_help_panel=FILE),
    ] = None,
    radius: Annotated[
        str | None, typer.Option(help="30.75mm; needed where balls may meet", rich_help_panel=BALL)
    ] = None,
    inertia: Annotated[str, typer.Option(help="solid, hollow or kappa", rich_help_panel=BALL)] = "solid",
    wall: Annotated[
        list[str] | None,
        typer.Option(
            help="where the centre turns: x=0.03, y=1.4 or x1,y1,x2,y2 (m); may be repeated", rich_help_panel=FLOOR
        ),
    ] = None,
    hard: Annotated[
        bool,
        typer.Option("--hard", help="the motions meet on the wall's line, it does not give", rich_help_panel=FLOOR),
    ] = False,
    cloth: Annotated[
        float | None, typer.Option(help="Coulomb friction of the floor; left out: fitted", rich_help_panel=FLOOR)
    ] = None,
    rolling: Annotated[
        float | None, typer.Option(help="deceleration / g of a rolling ball; left out: fitted", rich_help_panel=FLOOR)
    ] = None,
    gravity: Annotated[float, typer.Option(help="m/s^2", rich_help_panel=FLOOR)] = 9.80665,
    noise: Annotated[
        str | None, typer.Option(help="of one coordinate of one frame, 0.3mm; left out: found", rich_help_panel=FIT)
    ] = None,
    window: Annotated[float, typer.Option(help="s looked at before and after a contact", rich_help_panel=FIT)] = 0.5,
    blind: Annotated[
        float | None,
        typer.Option(help="s beside a contact left out; left out: as the frames show", rich_help_panel=FIT),
    ] = None,
) -> None:
    """What a track file holds: format, tracks, clock, noise; the contacts in it, measured by fitting the physics."""
    from carom.tracks.formats.sheet import Given
    from carom.tracks.measure import Settings, measure
    from carom.tracks.read import read_tracks
    from carom.tracks.table import to_rebounds

    faults: list[str] = []
    lengths = {
        name: attempt(faults, length_of, name, text)
        for name, text in (("scale", scale), ("radius", radius), ("noise", noise))
    }
    kappa = _kappa(inertia, faults)
    for name, value, known in (
        ("stage", stage, ("best", "after_wall", "rolling", "both")),
        ("view", view, ("above", "side")),
    ):
        if value is not None and value not in known:
            faults.append(f"--{name}: expected one of {', '.join(known)}, got {value!r}")
    require_places(faults, {"--plot": plot, "--out": out}, {"--out": (".csv", ".txt", ".parquet", ".pq")})
    if out is not None and out.exists() and file.exists() and out.samefile(file):
        faults.append(f"--out {out}: expected another file than the track itself, got the same; name a new one")
    if faults:
        raise CaromError(*faults)
    found = read_tracks(file, format_, Given(lengths["scale"], rate, down))
    walls = None if not wall else tuple(_wall(text, found) for text in wall)
    settings = Settings(
        radius=lengths["radius"], kappa=kappa, view=view, walls=walls, noise=lengths["noise"],  # type: ignore[arg-type]
        cloth=cloth, rolling=rolling, gravity=gravity, window=window, blind=blind, hard=hard,
    )  # fmt: skip
    console = Console(stderr=True, highlight=False)
    measured = _with_bar(console, lambda say: measure(found.tracks, settings, say))
    written = None
    if out is not None:
        table = to_rebounds(measured, stage, sliding=sliding)  # type: ignore[arg-type]
        written = (table.save(out), len(table))
    if plot is not None:
        from carom.plot.save import save
        from carom.plot.tracks import plot_tracks

        save(plot_tracks(measured), plot)
    if json_:
        print(json.dumps(_facts(found, measured, stage, sliding), indent=2, allow_nan=False))  # noqa: T201
    else:
        _tell(stdout(), found, measured, stage, sliding)
    for note in (*found.notes, *measured.notes):
        console.print(f"[dim]{escape(note)}[/]", soft_wrap=True)
    if written:
        console.print(f"{written[1]} rebounds in the table")
        wrote(written[0])
    if plot is not None:
        wrote(plot)


def _with_bar(console: Console, run: Any) -> Any:
    if not console.is_terminal:
        return run(None)
    from rich.progress import Progress

    with Progress(console=console, transient=True) as bar:
        task = bar.add_task("contacts", total=None)
        return run(lambda done, total: bar.update(task, completed=done, total=total))


def _kappa(text: str, faults: list[str]) -> float:
    from carom.ball import INERTIAS

    try:
        return INERTIAS[text] if text in INERTIAS else float(text)
    except ValueError:
        faults.append(f"--inertia: expected solid, hollow or kappa = I/(m a^2), got {text!r}")
        return 0.4


def _wall(text: str, found: TrackFile) -> Any:
    from carom.tracks.contacts import wall_through

    name, _sign, value = text.partition("=")
    try:
        if name.strip() in ("x", "y") and value:
            at = float(value)
            points = ((at, 0.0), (at, 1.0)) if name.strip() == "x" else ((0.0, at), (1.0, at))
        else:
            x1, y1, x2, y2 = (float(part) for part in text.replace(",", " ").split())
            points = ((x1, y1), (x2, y2))
        if points[0] == points[1] or not all(math.isfinite(x) for point in points for x in point):
            raise ValueError
    except ValueError:
        raise CaromError(f"--wall: expected x=0.03, y=1.4 or x1,y1,x2,y2 with two points (m), got {text!r}") from None
    return wall_through(text, *points, found.tracks)


def _facts(found: TrackFile, measured: Measured, stage: str, sliding: bool) -> dict[str, Any]:
    """All that is known, for --json."""
    return {
        "file": str(found.path),
        "format": found.format,
        "view": measured.view,
        "frame_interval": _plain(measured.interval),
        "noise": _plain(measured.noise),
        "noise_given": measured.noise_given,
        "rounded_to": [_plain(x) for x in measured.step],
        "blind": list(measured.blind),
        "tracks": [
            {"group": track.group, "name": track.name, "samples": len(track), "missing": int((~track.seen).sum()),
             "time": [_plain(track.time.min()), _plain(track.time.max())]} for track in found.tracks
        ],
        "walls": [{"name": one.name, "point": one.point, "normal": one.normal, "clamped": one.clamped, "found": one.found}
                  for one in measured.walls],
        "floor": {name: {"value": _plain(value), "stderr": _plain(error)} for name, (value, error) in measured.floor.items()},
        "contacts": [_contact(one, stage, sliding) for one in measured.contacts],
        "notes": [*found.notes, *measured.notes],
    }  # fmt: skip


def _contact(one: Contact, stage: str, sliding: bool) -> dict[str, Any]:
    from carom.tracks.fitted import OUTPUTS
    from carom.tracks.table import chosen

    stages, why = chosen(one, stage, sliding)  # type: ignore[arg-type]
    facts: dict[str, Any] = {"group": one.group, "track": one.track, "wall": one.wall.name, "t": _plain(one.time),
             "frames_before": one.before, "frames_after": one.after, "stages": stages, "why_not": why}  # fmt: skip
    if one.fit is not None:
        facts["fit"] = {
            "names": list(OUTPUTS),
            "values": [_plain(x) for x in one.fit.value],
            "covariance": [[_plain(x) for x in row] for row in one.fit.covariance],
            "chi2": one.fit.chi2,
            "dof": one.fit.dof,
        }
    return facts


def _plain(x: Any) -> float | None:
    """A number for JSON: null where it is not known."""
    return float(x) if abs(float(x)) < float("inf") else None


def _tell(console: Console, found: TrackFile, measured: Measured, stage: str, sliding: bool) -> None:
    """For people: what was understood, then the contacts."""
    from rich.table import Table

    from carom.tracks.read import FORMATS
    from carom.units import length, number

    facts = Table(box=None, show_header=False, padding=(0, 2, 0, 0))
    facts.add_row("[bold]format[/]", FORMATS[found.format].title)
    for track in found.tracks[:MOST_TRACKS]:
        facts.add_row("track", _track_line(track))
    if len(found.tracks) > MOST_TRACKS:
        facts.add_row("", f"and {len(found.tracks) - MOST_TRACKS} more tracks")
    facts.add_row("camera", f"{1 / measured.interval:.4g} frames a second" if measured.interval > 0 else "no clock")
    steps = ", ".join(length(x) if x else "no step" for x in measured.step)
    rounded = f"; places rounded to {steps}" if any(measured.step) else ""
    facts.add_row("noise", f"{length(measured.noise)} {'as given' if measured.noise_given else 'found'}{rounded}")
    facts.add_row("seen from", "above: a ball on a table" if measured.view == "above" else "the side: a ball in flight")
    for wall in measured.walls:
        n = wall.normal
        at = (
            f"x = {wall.point[0]:.4f} m"
            if abs(n[0]) == 1
            else f"y = {wall.point[1]:.4f} m"
            if abs(n[1]) == 1
            else "as given"
        )
        facts.add_row("wall", f"{wall.name}: {at}{', places clamped on it' if wall.clamped else ''}")
    for name, (value, error) in measured.floor.items():
        facts.add_row(name, f"{number(value)} ± {number(error, 1)}")
    console.print(facts)
    _contacts(console, measured, stage, sliding)


def _track_line(track: Any) -> str:
    import numpy as np

    from carom.units import length

    seen = track.pick(track.seen)
    label = escape(" ".join(filter(None, (track.group, track.name))))
    gaps = int((~track.seen).sum())
    spans = " × ".join(length(float(x)) for x in np.ptp(seen.position, axis=0)) if len(seen) else "nothing"
    return f"{label}: {len(seen):,} places{f', {gaps:,} missing' if gaps else ''}, {np.ptp(track.time):.3g} s, {spans}"


def _contacts(console: Console, measured: Measured, stage: str, sliding: bool) -> None:
    from rich.table import Table

    from carom.tracks.table import chosen

    console.print(
        "\nContacts: velocity before, toward the wall and along it; after, away from it and along it, m/s",
        soft_wrap=True,
    )
    table = Table(box=None, padding=(0, 1, 0, 0), header_style="dim")
    for head in ("ball", "wall", "t, s", "v_n in", "v_t in", "v_n out", "v_t out", "stage"):
        table.add_column(head, justify="left" if head in ("ball", "wall", "stage") else "right", no_wrap=True)
    whys: Counter[str] = Counter()
    shown = 0
    for one in measured.contacts:
        stages, why = chosen(one, stage, sliding)  # type: ignore[arg-type]
        if not stages:
            whys[why] += 1
        for name in stages:
            shown += 1
            if shown > MOST_CONTACTS:
                continue
            assert one.fit is not None
            tail = "roll" if name == "rolling" else "out"
            cells = [_with_error(one, key, sign) for key, sign in
                     (("vn_in", -1), ("vt_in", 1), (f"vn_{tail}", 1), (f"vt_{tail}", 1))]  # fmt: skip
            label = escape(" ".join(filter(None, (one.group, one.track))))
            table.add_row(label, one.wall.name, f"{one.time:.4f}", *cells, "" if one.planar else name)
    if shown:
        console.print(table)
        console.print("[dim]1.2292(12) is 1.2292 ± 0.0012[/]")
    if shown > MOST_CONTACTS:
        console.print(f"and {shown - MOST_CONTACTS} more rows: --out and --json have them all")
    lost = sum(whys.values())
    console.print(
        f"[bold]{len(measured.contacts)} contacts[/], {len(measured.contacts) - lost} measured"
        + (", not:" if lost else "")
    )
    for why, count in whys.most_common():
        console.print(f"  {count} × {escape(why)}", soft_wrap=True)


def _with_error(one: Contact, name: str, sign: int) -> str:
    """A value with its error on the last two digits: 1.2292(12) is 1.2292 ± 0.0012."""
    assert one.fit is not None
    value, error = sign * one.fit[name], one.fit.error(name)
    digits = 1 - math.floor(math.log10(error)) if 0 < error < 1 else 1
    return f"{value:.{digits}f}({error * 10**digits:.0f})"
