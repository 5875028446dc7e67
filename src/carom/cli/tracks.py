"""``carom tracks show``: summary of a track file, and velocities before and after each contact with a wall."""

from __future__ import annotations

import json
import math
from collections import Counter
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer
from rich.console import Console
from rich.text import Text

from carom.cli.common import attempt, require_outputs, wrote
from carom.cli.console import err
from carom.cli.console import out as stdout
from carom.cli.options import FLOOR, parse_inertia, parse_length, shared
from carom.errors import CaromError

if TYPE_CHECKING:
    from carom.tracks.contact import TrackContact
    from carom.tracks.measurement import Measured
    from carom.tracks.read import TrackFile

FILE, FIT = "Track file", "Contact fits"
MAX_TRACKS, MAX_ROWS = 12, 30

tracks = typer.Typer(help="Tracks of filmed balls: summarise a file, and measure its rebounds.", no_args_is_help=True)


def register(app: typer.Typer) -> None:
    """Add the verb."""
    tracks.command()(show)
    app.add_typer(tracks, name="tracks")


def show(
    file: Annotated[
        Path, typer.Argument(help="A file from Tracker, Kinovea, trackpy, DeepLabCut ..., or columns t, x, y.")
    ],
    out: Annotated[Path | None, typer.Option(help="Write the rebounds: .csv or .parquet.")] = None,
    plot: Annotated[Path | None, shared("plot")] = None,
    json_: Annotated[bool, shared("json")] = False,
    stage: Annotated[str, typer.Option(help="Stage of balls on a table: best, after_wall, rolling or both.")] = "best",
    sliding: Annotated[
        bool, typer.Option("--sliding", help="Keep balls that are still sliding when they meet the wall.")
    ] = False,
    format_: Annotated[
        str | None, typer.Option("--format", help="Format of the file; overrides detection.", rich_help_panel=FILE)
    ] = None,
    scale: Annotated[str | None, shared("scale", rich_help_panel=FILE)] = None,
    rate: Annotated[float | None, shared("rate", rich_help_panel=FILE)] = None,
    down: Annotated[
        bool | None,
        typer.Option("--down/--up", help="The second axis points down, as in images.", rich_help_panel=FILE),
    ] = None,
    view: Annotated[str | None, shared("view", default="by the motion", rich_help_panel=FILE)] = None,
    radius: Annotated[
        str | None, shared("radius", help="Radius, 0.03075 (m) or 30.75mm; needed where balls may meet.")
    ] = None,
    inertia: Annotated[str, shared("inertia")] = "solid",
    wall: Annotated[
        list[str] | None,
        typer.Option(
            help="Line at which the ball's centre is reflected: x=0.03, y=1.4 or x1,y1,x2,y2 (m); may be repeated.",
            rich_help_panel=FLOOR,
        ),
    ] = None,
    hard: Annotated[
        bool,
        typer.Option("--hard", help="The wall is rigid: both motions meet on its line.", rich_help_panel=FLOOR),
    ] = False,
    cloth: Annotated[
        float | None, typer.Option(help="Coulomb friction of the floor. Default: fitted.", rich_help_panel=FLOOR)
    ] = None,
    rolling: Annotated[
        float | None, typer.Option(help="Deceleration / g of a rolling ball. Default: fitted.", rich_help_panel=FLOOR)
    ] = None,
    gravity: Annotated[float, shared("gravity")] = 9.80665,
    noise: Annotated[str | None, shared("noise", default="estimated", rich_help_panel=FIT)] = None,
    window: Annotated[
        float, typer.Option(help="Time fitted before and after a contact, s.", rich_help_panel=FIT)
    ] = 0.5,
    blind: Annotated[
        float | None,
        typer.Option(
            help="Time excluded before and after a contact, s. Default: from the frames.", rich_help_panel=FIT
        ),
    ] = None,
) -> None:
    """Summarise a track file (format, tracks, frame rate, noise), and measure its contacts by fitting the physics."""
    from carom.tracks.formats.text_table import Calibration
    from carom.tracks.measurement import Settings, measure
    from carom.tracks.read import read_tracks
    from carom.tracks.rebounds import to_rebounds

    faults: list[str] = []
    lengths = {
        name: attempt(faults, parse_length, name, text)
        for name, text in (("scale", scale), ("radius", radius), ("noise", noise))
    }
    kappa = attempt(faults, parse_inertia, inertia)
    for name, value, known in (
        ("stage", stage, ("best", "after_wall", "rolling", "both")),
        ("view", view, ("above", "side")),
    ):
        if value is not None and value not in known:
            faults.append(f"--{name}: expected one of {', '.join(known)}, got {value!r}")
    require_outputs(faults, {"--plot": plot, "--out": out}, {"--out": (".csv", ".txt", ".parquet", ".pq")}, source=file)
    if faults:
        raise CaromError(*faults)
    found = read_tracks(file, format_, Calibration(lengths["scale"], rate, down))
    walls = None if not wall else tuple(_wall(text, found) for text in wall)
    settings = Settings(
        radius=lengths["radius"], kappa=kappa, view=view, walls=walls, noise=lengths["noise"],  # type: ignore[arg-type]
        cloth=cloth, rolling=rolling, gravity=gravity, window=window, blind=blind, hard=hard,
    )  # fmt: skip
    console = err()
    measured = _with_bar(console, lambda progress: measure(found.tracks, settings, progress))
    written = None
    if out is not None:
        table = to_rebounds(measured, stage, sliding=sliding)  # type: ignore[arg-type]
        written = (table.save(out), len(table))
    if plot is not None:
        from carom.plot.style import save
        from carom.plot.tracks import plot_tracks

        save(plot_tracks(measured), plot)
    if json_:
        print(json.dumps(_facts(found, measured, stage, sliding), indent=2, allow_nan=False))  # noqa: T201
    else:
        _tell(stdout(), found, measured, stage, sliding)
    for note in (*found.notes, *measured.notes):
        console.print(note, style="dim", soft_wrap=True)
    if written:
        console.print(f"{_count(written[1], 'rebound')} in the table")
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


def _wall(text: str, found: TrackFile) -> Any:
    from carom.tracks.events import wall_through

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
    """Return the content of --json."""
    return {
        "file": str(found.path),
        "format": found.format,
        "view": measured.view,
        "frame_interval": _plain(measured.interval),
        "noise": _plain(measured.noise),
        "noise_given": measured.noise_given,
        "rounded_to": [_plain(x) for x in measured.step],
        "blind": list(measured.blind[:2]),
        "blind_stderr": list(measured.blind[2:]),
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


def _contact(one: TrackContact, stage: str, sliding: bool) -> dict[str, Any]:
    from carom.tracks.least_squares import OUTPUTS
    from carom.tracks.rebounds import usable_stages

    stages, why = usable_stages(one, stage, sliding)  # type: ignore[arg-type]
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
    """Return a number for JSON: null if it is unknown."""
    return float(x) if abs(float(x)) < float("inf") else None


def _tell(console: Console, found: TrackFile, measured: Measured, stage: str, sliding: bool) -> None:
    """Print the summary of the file, then the contacts."""
    from rich.table import Table

    from carom.formatting import format_length, format_number
    from carom.tracks.read import FORMATS

    facts = Table(box=None, show_header=False, padding=(0, 2, 0, 0))
    facts.add_row(Text("format", "bold"), FORMATS[found.format].title)
    for track in found.tracks[:MAX_TRACKS]:
        facts.add_row("track", _track_line(track))
    if len(found.tracks) > MAX_TRACKS:
        facts.add_row("", f"and {_count(len(found.tracks) - MAX_TRACKS, 'more track')}")
    facts.add_row(
        "camera", f"{1 / measured.interval:.5g} frames per second" if measured.interval > 0 else "frame rate unknown"
    )
    steps = ", ".join(format_length(x) if x else "no step" for x in measured.step)
    rounded = f"; positions rounded to {steps}" if any(measured.step) else ""
    facts.add_row(
        "noise", f"{format_length(measured.noise)} {'(given)' if measured.noise_given else '(estimated)'}{rounded}"
    )
    facts.add_row(
        "filmed from", "above: a ball on a table" if measured.view == "above" else "the side: a ball in flight"
    )
    for wall in measured.walls:
        n = wall.normal
        at = (
            f"x = {wall.point[0]:.4f} m"
            if abs(n[0]) == 1
            else f"y = {wall.point[1]:.4f} m"
            if abs(n[1]) == 1
            else "as given"
        )
        facts.add_row("wall", f"{wall.name}: {at}{', positions clamped to it' if wall.clamped else ''}")
    for name, (value, error) in measured.floor.items():
        facts.add_row(name, f"{format_number(value)} ± {format_number(error, 1)}")
    console.print(facts)
    _contacts(console, measured, stage, sliding)


def _track_line(track: Any) -> str:
    import numpy as np

    from carom.formatting import format_length

    seen = track.select(track.seen)
    label = " ".join(filter(None, (track.group, track.name)))
    gaps = int((~track.seen).sum())
    spans = " × ".join(format_length(float(x)) for x in np.ptp(seen.position, axis=0)) if len(seen) else "nothing"
    return f"{label}: {_count(len(seen), 'position')}{f', {gaps:,} missing' if gaps else ''}, {np.ptp(track.time):.3g} s, {spans}"


def _contacts(console: Console, measured: Measured, stage: str, sliding: bool) -> None:
    from rich.table import Table

    from carom.tracks.rebounds import usable_stages

    console.print(
        "\nVelocities before (v_n toward the wall) and after the contact (v_n away from it), v_t along the wall, m/s",
        soft_wrap=True,
    )
    table = Table(box=None, padding=(0, 1, 0, 0), header_style="dim")
    for head in ("ball", "wall", "t, s", "v_n in", "v_t in", "v_n out", "v_t out", "stage"):
        table.add_column(head, justify="left" if head in ("ball", "wall", "stage") else "right", no_wrap=True)
    whys: Counter[str] = Counter()
    shown = 0
    for one in measured.contacts:
        stages, why = usable_stages(one, stage, sliding)  # type: ignore[arg-type]
        if not stages:
            whys[why] += 1
        for name in stages:
            shown += 1
            if shown > MAX_ROWS:
                continue
            assert one.fit is not None
            tail = "roll" if name == "rolling" else "out"
            cells = [_with_error(one, key, sign) for key, sign in
                     (("vn_in", -1), ("vt_in", 1), (f"vn_{tail}", 1), (f"vt_{tail}", 1))]  # fmt: skip
            label = " ".join(filter(None, (one.group, one.track)))
            table.add_row(label, one.wall.name, f"{one.time:.4f}", *cells, "" if one.planar else name)
    if shown:
        console.print(table)
        console.print("Parentheses give the uncertainty in the last digits: 1.2292(12) is 1.2292 ± 0.0012", style="dim")
    if shown > MAX_ROWS:
        console.print(f"and {_count(shown - MAX_ROWS, 'more row')}: --out and --json list all")
    lost = sum(whys.values())
    found = (_count(len(measured.contacts), "contact"), "bold")
    console.print(
        Text.assemble(found, f", {len(measured.contacts) - lost} measured", f"; {lost} not measured:" if lost else "")
    )
    for why, count in whys.most_common():
        console.print(f"  {count} × {why}", soft_wrap=True)


def _count(number: int, noun: str) -> str:
    """Return a number with its noun, in the plural unless it is 1."""
    return f"{number:,} {noun}{'' if number == 1 else 's'}"


def _with_error(one: TrackContact, name: str, sign: int) -> str:
    """Return a value with its uncertainty in the last two digits: 1.2292(12) is 1.2292 ± 0.0012."""
    assert one.fit is not None
    value, error = sign * one.fit[name], one.fit.error(name)
    digits = 1 - math.floor(math.log10(error)) if 0 < error < 1 else 1
    return f"{value:.{digits}f}({error * 10**digits:.0f})"
