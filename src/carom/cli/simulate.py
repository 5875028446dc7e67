"""``carom simulate``: run a scene, and describe, print, plot, animate or save the result."""

from __future__ import annotations

import contextlib
import json
import math
import sys
import textwrap
import tomllib
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import numpy as np
import typer
from rich import box
from rich.table import Table
from rich.text import Text

from carom.cli.console import out, working
from carom.cli.options import OUTPUT, RUN, option, require_outputs, shared, wrote
from carom.cli.streams import noticed_interrupts, say_interrupted
from carom.errors import CaromError, FaultList
from carom.formatting import counted, format_number, json_value
from carom.public.own_laws import with_own_laws
from carom.simulation.contact_kinds import cushion_side
from carom.simulation.files import event_columns
from carom.simulation.narrate import describe_run
from carom.simulation.records import BALL, CLUSTERS, FLOOR, WALL, kind_names
from carom.simulation.trajectory import budget

if TYPE_CHECKING:
    from carom.bodies import State
    from carom.scene.scene import Scene
    from carom.simulation.trajectory import Trajectory

ANIMATIONS, TABLES = (".mp4", ".gif", ".html"), (".csv", ".parquet")


def register(app: typer.Typer) -> None:
    """Add the verb to the command."""
    app.command()(simulate)


def simulate(
    scene: Annotated[Path, typer.Argument(metavar="SCENE.toml", help="A scene file; carom scene new FILE writes one.")],
    law: Annotated[
        str | None, option(RUN, "Law of the walls, or my_law.py:law. Default: the scene's.", metavar="NAME")
    ] = None,
    allow_own_laws: Annotated[bool, shared("allow_own_laws")] = False,
    duration: Annotated[
        str | None, shared("duration", default="the scene's", help='Duration: a number in s, or "500 ms".')
    ] = None,
    max_events: Annotated[
        int | None, shared("max_events", default="the scene's", help="Largest number of events.")
    ] = None,
    set_: Annotated[
        list[str] | None,
        option(
            RUN,
            "Another value for numbers of the scene, such as walls.*.restitution=0.8 or balls.0.velocity=[2,1]; may be"
            " repeated.",
            "--set",
            metavar="PATH=VALUE",
        ),
    ] = None,
    at: Annotated[
        list[str] | None, option(OUTPUT, "Print the states at this time, s; may be repeated, or 0.5,1,2.", metavar="T")
    ] = None,
    events: Annotated[
        str | None,
        option(OUTPUT, "Rows of the table of events, bounces folded; all: every event. Default: 40.", metavar="all|N"),
    ] = None,
    as_json: Annotated[bool, shared("json")] = False,
    quiet: Annotated[bool, shared("quiet")] = False,
    sensitivity: Annotated[
        str | None,
        option(
            OUTPUT,
            "Print what matters: how far each ball's final place moves per cent of these numbers, such as"
            " balls.0.velocity,walls.*.friction.",
            metavar="PATHS",
        ),
    ] = None,
    plot: Annotated[Path | None, shared("plot")] = None,
    animate: Annotated[Path | None, option(OUTPUT, "Write an animation: .mp4, .gif or .html.", metavar="FILE")] = None,
    save: Annotated[
        Path | None, option(OUTPUT, "Save the run for carom.load_trajectory: .parquet.", metavar="FILE")
    ] = None,
    table: Annotated[Path | None, option(OUTPUT, "Write all events: .csv or .parquet.", metavar="FILE")] = None,
    out: Annotated[
        Path | None,
        option(
            OUTPUT,
            "Write place, velocity, spin and orientation of every ball frame by frame: .csv, .json or .parquet.",
            metavar="FILE",
        ),
    ] = None,
    frames: Annotated[float | None, option(OUTPUT, "Frames per second for --out. Default: 60.", metavar="RATE")] = None,
) -> None:
    """Simulate a scene event by event; print a description, the events, the final states and the energy budget."""
    from carom.cli.streams import say_notes
    from carom.scene.openings import scene_notes
    from carom.simulation.contacts_in_time import overlap_note
    from carom.simulation.files import FORMATS, FRAME_FORMATS
    from carom.simulation.simulate import law_notes

    try:
        found = FaultList()
        most, times = found.attempt(_most, events), found.attempt(_times, at)
        kinds = {"--animate": ANIMATIONS, "--save": FORMATS, "--table": TABLES, "--out": FRAME_FORMATS}
        outputs = {"--plot": plot, "--animate": animate, "--save": save, "--table": table, "--out": out}
        require_outputs(found, outputs, kinds)
        rate = found.attempt(_rate, frames, out)
        values: dict[str, Any] = {}
        for text in set_ or []:
            values |= with_own_laws(found.attempt(_assigned, text) or {})
        settings = {"law": with_own_laws(law), "duration": duration, "max_events": max_events}
        given = found.attempt(_scene, scene, allow_own_laws, settings, values)
        found.raise_if_any()
        say_notes(scene_notes(given))
        run = _run(given, quiet)
        notes = law_notes(run)
        if as_json and (overlap := overlap_note(run)) is not None:  # (else the description has it)
            notes.append(overlap)
        say_notes(notes)
        _reached(run, times)
        if out is not None:
            _frames(run, rate)
        matters = None if sensitivity is None else run.sensitivity(sensitivity.replace(",", " ").split())
        written = _write(run, quiet, outputs, rate)
        _tell(run, times, most, as_json, quiet, notes, matters)
        wrote(*(() if quiet else written))
    except KeyboardInterrupt:
        say_interrupted("carom: interrupted; nothing was written")
        raise


# --- options -------------------------------------------------------------------------------------------------------


def _most(text: str | None) -> int | None:
    """Return the number of rows of the table of events; None for all."""

    if text is None:
        return MOST_ROWS
    if text == "all":
        return None
    if not text.isdecimal():
        raise CaromError(f"--events: expected 'all' or a whole number >= 0, got {text!r}")
    return int(text)


def _times(texts: list[str] | None) -> list[float]:
    """Return the requested times, sorted."""
    found = []
    for text in ",".join(texts or []).replace(",", " ").split():
        try:
            t = float(text)
        except ValueError:
            t = math.nan
        if not 0 <= t < math.inf:
            raise CaromError(f"--at: expected times >= 0 in s, such as 0.5 or 0.5,1,2, got {text!r}")
        found.append(t)
    return sorted(found)


def _assigned(text: str) -> dict[str, Any]:
    """Return the value of PATH=VALUE by its path; a value as in a scene file, text without quotes as it is."""
    path, equals, value = text.partition("=")
    if not equals or not path.strip() or not value.strip():
        raise CaromError(f"--set: expected PATH=VALUE, such as walls.*.restitution=0.8, got {text!r}")
    try:
        return {path.strip(): tomllib.loads(f"value = {value}")["value"]}
    except (tomllib.TOMLDecodeError, RecursionError):
        return {path.strip(): value.strip()}


def _rate(frames: float | None, out: Path | None) -> float:
    """Return the number of frames per second of a file of frames."""
    from carom.simulation.files import FRAME_RATE

    if frames is not None and out is None:
        raise CaromError("--frames: has no effect without --out; name the file with --out FILE.csv, .json or .parquet")
    if frames is not None and not 0 < frames < math.inf:
        raise CaromError(f"--frames: expected frames per second, a number > 0, got {frames:g}")
    return FRAME_RATE if frames is None else frames


def _scene(path: Path, allow_own_laws: bool, changes: dict[str, Any], values: dict[str, Any]) -> Scene:
    """Return the scene of a file, with ``values`` at its paths, and the options in place of its [run] settings."""
    from carom.scene.scene import Run, Scene
    from carom.scene.toml import load_scene, replaced

    found = FaultList()
    scene = found.attempt(load_scene, path, allow_own_laws=allow_own_laws)
    if scene is not None and values:
        try:
            scene = replaced(scene, values)
        except CaromError as error:
            found += error.records_at("--set", "path", "Scene")
    changes = {name: value for name, value in changes.items() if value is not None}
    with contextlib.suppress(KeyError, ValueError):
        changes["duration"] = float(changes["duration"])
    now = {"max_events": 1} if scene is None else {name: getattr(scene.run, name) for name in Run.model_fields}
    # (the options are checked even if the scene itself is invalid)
    run = found.attempt(Run, **now | changes) if changes else None
    found.raise_if_any()
    if run is None:
        return scene  # type: ignore[no-any-return]
    try:  # validated again as a whole: another law may require parameters that the walls do not have
        return Scene(**{name: getattr(scene, name) for name in Scene.model_fields} | {"run": run})
    except CaromError as error:
        raise CaromError(*error.records_at(str(path), "Scene")) from None


# --- the run -------------------------------------------------------------------------------------------------------


def _run(scene: Scene, quiet: bool) -> Trajectory:
    from carom.cli.console import working
    from carom.simulation.simulate import simulate as follow

    with working("simulating", quiet=quiet) as show, noticed_interrupts(always=True) as asked:

        def on_the_way(events: float, _total: float, time: str) -> None:
            if asked:  # an interrupt was swallowed
                raise KeyboardInterrupt
            if show is not None:
                show(0, None, f"{events:,} events, {time}")

        found = follow(scene, on_the_way)
    if asked:  # the exception was swallowed elsewhere
        raise KeyboardInterrupt
    return found


def _reached(run: Trajectory, times: list[float]) -> None:
    """Raise CaromError for times that the run did not reach."""
    if run.ended != "nothing more happens" and times and times[-1] > run.end:
        raise CaromError(
            f"--at: expected times from 0 to {run.end:.9g} s, the end of the run, got {times[-1]:g}; increase --duration"
            " or --max-events"
        )


def _frames(run: Trajectory, rate: float) -> None:
    """Raise CaromError for more frames than a file may have."""
    from carom.simulation.files import frame_times

    try:
        frame_times(run, rate)
    except CaromError as error:
        raise CaromError(*(fault.replace("rate:", "--frames:") for fault in error.faults)) from None


# --- output --------------------------------------------------------------------------------------------------------


def _write(run: Trajectory, quiet: bool, outputs: dict[str, Path | None], rate: float) -> list[Path]:
    """Write the files, all of them or none."""
    from carom.files import atomic_path
    from carom.simulation.files import event_columns, write_columns

    makers: dict[str, Callable[[Path], Any]] = {
        "--plot": run.plot,
        "--save": run.save,
        "--table": lambda part: write_columns(event_columns(run, run.events.rows), part),
        "--out": lambda part: run.save_frames(part, rate),
        "--animate": lambda part: _animate(run, part, quiet),
    }
    asked = [(path, make) for option, make in makers.items() if (path := outputs[option]) is not None]
    with contextlib.ExitStack() as stack:
        for path, make in asked:
            part = stack.enter_context(atomic_path(path))
            try:
                make(part)
            except CaromError as error:  # with the file name as given
                raise CaromError(*(fault.replace(str(part), str(path)) for fault in error.faults)) from None
    return [path for path, _make in asked]


def _animate(run: Trajectory, path: Path, quiet: bool) -> None:

    with working("rendering", quiet=quiet) as progress:
        run.animate(path, progress=progress)


def _tell(
    run: Trajectory,
    times: list[float],
    most: int | None,
    as_json: bool,
    quiet: bool,
    notes: list[str],
    matters: Any = None,
) -> None:

    if as_json:
        sys.stdout.write(run_as_json(run, times, notes, matters))
    elif not quiet:
        show(run, times, most)
        if matters is not None:
            show_sensitivity(matters)


# ----------------------------------------------------------------------------------------------------
# Print a run: a description, tables of events and states, the energy budget; or write it as JSON.


MOST_ROWS = 40
WIDE = 112  # least width at which the table has room for the spin
# a law of impact may take energy only
CONTACTS, CREATED = ("at walls", "between balls"), " (by a law that creates energy)"
ROUNDING = 1e-12
RISES = ("flight", "bouncing")  # phases after a contact with the floor that is a bounce


# --- on the screen -------------------------------------------------------------------------------------------------


def show(run: Trajectory, times: list[float], most: int | None) -> None:
    """Print a run: scene, description, a table of at most ``most`` events (None: all), states, energy budget."""
    console = out()
    console.print(Text(f"Scene: {run.scene.describe()}"), soft_wrap=True)
    for paragraph in describe_run(run):
        text = textwrap.fill(paragraph[0].upper() + paragraph[1:], max(min(console.width, 110), 40))
        console.print(Text(f"\n{text}"), soft_wrap=True)
    if most != 0 and len(run.events):
        table, hidden = _events(run, most, console.width >= WIDE)
        console.print(table)
        if hidden > 0:
            said = f"{counted(hidden, 'event')} not shown: --events all shows all, --table FILE.csv writes them."
            console.print(Text(said, style="dim"), soft_wrap=True)
    console.print(_states(run, times, console.width >= WIDE))
    console.print(Text(_energy(run)), soft_wrap=True)


def show_sensitivity(found: Any) -> None:
    """Print the sensitivity: how far each ball's final place moves when a number changes by 1 %."""
    head, rows = found.table()
    table = _new(
        [(name, k == 0) for k, name in enumerate(["changed by 1 %", "value", *(f"{name}, mm" for name in head[2:])])]
    )
    for row in rows:
        table.add_row(*(Text(cell) for cell in row))
    console = out()
    console.print(Text("What matters: how far the final places move"), soft_wrap=True)
    console.print(table)
    misses = [one for one in found.near_misses[:1] if one.radius < np.inf]
    for one in misses:
        away = f"{1e3 * one.distance:.3g} mm"
        if not one.at_rest:
            said = f"Nearest miss: at {one.time:.4g} s {one.ball} passes {one.other}, {away} away."
        else:  # (it would have come nearer if it had gone on)
            said = f"Nearest miss: from {one.time:.4g} s on {one.ball} is at rest {away} from {one.other}."
        console.print(Text(said), soft_wrap=True)


def _new(heads: list[tuple[str, bool]]) -> Table:
    """Return an empty table; for each column its head, and whether it holds words."""
    table = Table(box=box.SIMPLE_HEAD, padding=(0, 1), pad_edge=False, header_style="bold")
    for head, words in heads:
        table.add_column(head, justify="left" if words else "right", no_wrap=True, overflow="fold", vertical="bottom")
    return table


def _triple(values: Any, count: int = 3) -> str:
    """Format numbers with three digits; rounding errors as zero."""
    return ", ".join(format_number(0.0 if abs(x) < ROUNDING else x) for x in map(float, values[:count]))


def _time(t: float) -> str:
    """Format a time so that the events of a long run can be distinguished."""
    return f"{t:.4f}" if t >= 0.01 or t == 0 else format_number(t, 4)


def _axes(run: Trajectory) -> int:
    """Return how many axes the tables show: two if all balls stay on the floor."""
    z = run.log["x"][:, 2] - np.array([ball.radius for ball in run.scene.balls])[run.log["ball"]]
    return 2 if run.scene.floor is not None and not z.any() and not run.log["v"][:, 2].any() else 3


def _folded(run: Trajectory) -> list[list[int]]:
    """Return the indices of the events of each row: a ball's contacts with the floor, one after the other, are one row."""
    rows: list[list[int]] = []
    last: dict[int, list[int] | None] = {}  # of each ball the row that its next contact with the floor belongs to
    for k, (kind, ball) in enumerate(zip(kind_names(run.events.rows), run.events.rows["ball"].tolist(), strict=True)):
        row = last.get(ball) if kind == "floor" else None
        if row is None:
            row = []
            rows.append(row)
        row.append(k)
        last[ball] = row if kind == "floor" else None
    return sorted(rows, key=lambda row: row[-1])


def _events(run: Trajectory, most: int | None, wide: bool) -> tuple[Table, int]:
    """Return the table of events, and how many are not shown; ``most``: rows, hops folded; None: every event in its own row."""
    several, axes = len(run.scene.balls) > 1, _axes(run)
    names = ", ".join("xyz"[:axes])
    heads = [("t, s", False), *([("ball", True)] if several else []), ("event", True), (f"position\n{names}, m", False)]
    heads += [(f"velocity after\n{names}, m/s", False)]
    heads += [("spin after\nx, y, z, rad/s", False)] if wide else []
    table = _new([*heads, ("energy lost\nJ", False), ("next phase", True)])
    rows = [[k] for k in range(len(run.events))] if most is None else _folded(run)
    parts = [rows]
    if most is not None and len(rows) > most:
        parts = [rows[: (most + 1) // 2], rows[len(rows) - most // 2 :]]
    features = run.scene.features().view(np.recarray)
    for k, part in enumerate(parts):
        if k > 0:
            table.add_row("...")
        for row in part:
            table.add_row(*_event_row(run, features, row, several, axes, wide))
    return table, len(run.events) - sum(len(row) for part in parts for row in part)


def _event_row(run: Trajectory, features: Any, folded: list[int], several: bool, axes: int, wide: bool) -> list[str]:
    """Return the cells of one event; of hops the time of the last and the state after it, and the energy lost in all."""
    events = [run.events[k] for k in folded]
    first, event = events[0], events[-1]
    side = cushion_side(run, features, run.events.rows[folded[-1]]) if event.kind == "wall" else ""
    what = " ".join(one for one in (event.kind, event.name, side) if one)
    if len(events) > 1:
        bounces = sum(one.phase in RISES for one in events)
        since = f" since {_time(first.t)} s" if event.t > first.t else ""
        what = f"lands, {counted(bounces, 'bounce')}{since}"
    row = [_time(event.t), *([run.scene.ball_names[event.ball]] if several else []), what]
    row += [_triple(event.after.position, axes), _triple(event.after.velocity, axes)]
    row += [_triple(event.after.spin)] if wide else []
    # energy is lost instantaneously only in contacts
    lost, kind = math.nan, run.events.rows["kind"][folded[0]]
    if kind == FLOOR:
        lost = sum(one.energy_lost for one in events)
    elif kind == WALL or (kind == BALL and _is_first(run.events.rows, folded[0])):
        lost = sum(one.energy_lost for one in _contacts(run.events, folded[0]))
    return [
        *row,
        format_number(0.0 if abs(lost) < ROUNDING else lost),
        "" if event.phase == event.kind else event.phase,
    ]


def _is_first(rows: Any, k: int) -> bool:
    """Return whether a row is the first of a meeting of balls, which has the energy that all of them lost together."""

    def paired(i: int) -> bool:
        one, two = rows[i], rows[i + 1]
        meet = one["kind"] == two["kind"] == BALL and (one["ball"], one["other"]) == (two["other"], two["ball"])
        return bool(meet and one["t"] == two["t"])

    start = k  # (the same balls may meet several times in an instant)
    while start > 0 and paired(start - 1):
        start -= 1
    return (k - start) % 2 == 0 and k + 1 < len(rows) and paired(k)


def _contacts(events: Any, first: int) -> list[Any]:
    """Return the events of an impact, from its first row on: of a wall or two balls, and all whose contacts overlapped with it."""
    own = 2 if events.rows["kind"][first] == BALL else 1
    kinds = events.rows["kind"][first + own :]
    return [events[k] for k in range(first, first + own + int(np.argmin([*np.isin(kinds, CLUSTERS), False])))]


def _states(run: Trajectory, times: list[float], wide: bool) -> Table:
    """Return a table of the states at the requested times, and at the end."""
    axes = 3 if times else _axes(run)
    names = ", ".join("xyz"[:axes])
    heads = [("at t, s", True), ("ball", True), ("phase", True), (f"position\n{names}, m", False)]
    heads += [(f"velocity\n{names}, m/s", False), ("spin\nx, y, z, rad/s", False)]
    table = _new(heads if wide else heads[:5])
    asked = [(_time(t), run.at(t), list(run.phase(t))) for t in times]
    for when, state, phases in [*asked, (f"end: {_time(run.end)}", run.final, run.final_phase)]:
        assert state.position is not None
        for i, name in enumerate(run.scene.ball_names):
            row = [_triple(state.position[i], axes), _triple(state.velocity[i], axes), _triple(state.spin[i])]
            table.add_row(when if i == 0 else "", name, phases[i], *(row if wide else row[:2]))
    return table


def _energy(run: Trajectory) -> str:
    found = budget(run)
    rounding = ROUNDING * max(abs(found.start), abs(found.end)) * (1 + len(run.events))
    places = (
        ("at walls", found.walls),
        ("in landings", found.floor),
        ("between balls", found.balls),
        ("in sliding, rolling and small bounces", found.way),
    )
    told = [
        f"{format_number(abs(x))} J {'lost' if x > 0 else 'gained'} {where}{CREATED if x < 0 and where in CONTACTS else ''}"
        for where, x in places
        if abs(x) > rounding
    ]
    left = format_number(0.0 if abs(found.end) < rounding else found.end)
    fallen = [i for i, phase in enumerate(run.final_phase) if phase == "pocketed"]
    theirs = (
        float(np.sum(run.kinetic_energy(fallen, run.final.velocity[fallen], run.final.spin[fallen]))) if fallen else 0.0
    )
    held = f" ({format_number(theirs)} J as balls fell into pockets)" if theirs > rounding else ""
    return f"Energy: {format_number(found.start)} J at the start; {''.join(f'{part}, ' for part in told)}{left} J left{held}."


# --- as JSON -------------------------------------------------------------------------------------------------------


def run_as_json(run: Trajectory, times: list[float], notes: Sequence[str] = (), matters: Any = None) -> str:
    """Return events and final states as JSON in full precision, one event per line; infinite and undefined numbers are null."""
    columns = {name: values.tolist() for name, values in event_columns(run, run.events.rows).items()}
    vectors = {
        name: zip(*(columns[f"{of}{axis}"] for axis in "xyz"), strict=True)
        for name, of in (("position", ""), ("velocity", "v"), ("spin", "w"), ("impulse", "impulse_"))
    }
    series: dict[str, Any] = {
        **{name: columns[name] for name in ("t", "kind", "ball")},
        **{name: vectors[name] for name in ("position", "velocity", "spin")},
        **{name: columns[name] for name in ("other", "name", "phase")},
        "impulse": vectors["impulse"],
        **{name: columns[name] for name in ("required_friction", "energy_lost")},
    }
    events = [_line(dict(zip(series, row, strict=True))) for row in zip(*series.values(), strict=True)]
    final = [_line(row) for row in _balls(run, run.final, run.final_phase)]
    parts = [f'"events": {_listed(events)}', f'"final": {_listed(final)}']
    if times:
        asked = [{"t": t, "states": _balls(run, run.at(t), list(run.phase(t)))} for t in times]
        parts.append(f'"at": {_listed([_line(one) for one in asked])}')
    if matters is not None:
        moved = zip(matters.columns, matters.values.tolist(), (1e3 * matters.what_matters()).T.tolist(), strict=True)
        rows = [{"parameter": name, "value": value, "mm_per_cent": by_ball} for name, value, by_ball in moved]
        parts.append(f'"sensitivity": {_listed([_line(one) for one in rows])}')
    parts += [f'"end": {_line(run.end)}', f'"ended": {_line(run.ended)}']
    parts += [f'"notes": {_line(list(notes))}'] if notes else []
    return "{\n" + ",\n".join(parts) + "\n}\n"


def _balls(run: Trajectory, state: State, phases: list[str]) -> list[dict[str, Any]]:
    assert state.position is not None
    return [
        {
            "position": state.position[i].tolist(), "velocity": state.velocity[i].tolist(),
            "spin": state.spin[i].tolist(), "phase": str(phases[i]), "name": name,
        }
        for i, name in enumerate(run.scene.ball_names)
    ]  # fmt: skip


def _listed(lines: list[str]) -> str:
    return "[\n" + ",\n".join(lines) + "\n]" if lines else "[]"


def _line(value: Any) -> str:
    return json.dumps(json_value(value), allow_nan=False)
