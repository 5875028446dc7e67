"""``carom simulate``: run a scene, and describe, print, plot, animate or save the result."""

from __future__ import annotations

import contextlib
import math
import sys
from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from carom.cli.console import working
from carom.cli.options import OUTPUT, RUN, assigned, option, require_outputs, shared, wrote
from carom.cli.streams import noticed_interrupts, say_interrupted
from carom.errors import CaromError, FaultList
from carom.public.own_laws import with_own_laws

if TYPE_CHECKING:
    from carom.scene.scene import Scene
    from carom.simulation.trajectory import Trajectory

ANIMATIONS, TABLES = (".mp4", ".gif", ".html"), (".csv", ".parquet")


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
    set_: Annotated[list[str] | None, shared("set")] = None,
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
            "Print sensitivities: how far each ball's final place moves where these numbers change by 1 % (angles by 1°), such as"
            " balls.0.velocity,walls.*.friction.",
            metavar="PATHS",
        ),
    ] = None,
    plot: Annotated[Path | None, shared("plot")] = None,
    animate: Annotated[Path | None, option(OUTPUT, "Write an animation: .mp4, .gif or .html.", metavar="FILE")] = None,
    save: Annotated[
        Path | None, option(OUTPUT, "Save the run for carom.load_trajectory: .parquet.", metavar="FILE")
    ] = None,
    save_events: Annotated[Path | None, option(OUTPUT, "Write all events: .csv or .parquet.", metavar="FILE")] = None,
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
    from carom.cli import trajectory_output as tables
    from carom.cli.streams import say_notes
    from carom.scene.openings import scene_notes
    from carom.simulation.contact_kinds import overlap_note
    from carom.simulation.files import FORMATS, FRAME_FORMATS
    from carom.simulation.simulate import law_notes

    try:
        found = FaultList()
        most, times = found.attempt(_most, events), found.attempt(_times, at)
        kinds = {"--animate": ANIMATIONS, "--save": FORMATS, "--save-events": TABLES, "--out": FRAME_FORMATS}
        outputs = {"--plot": plot, "--animate": animate, "--save": save, "--save-events": save_events, "--out": out}
        require_outputs(found, outputs, kinds)
        rate = found.attempt(_rate, frames, out)
        values = assigned(found, set_)
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
        if as_json:
            sys.stdout.write(tables.as_json(run, times, notes, matters))
        elif not quiet:
            tables.show(run, times, most)
            if matters is not None:
                tables.show_sensitivity(matters)
        wrote(*(() if quiet else written))
    except KeyboardInterrupt:
        say_interrupted("carom: interrupted; nothing was written")
        raise


# --- options -------------------------------------------------------------------------------------------------------


def _most(text: str | None) -> int | None:
    """Return the number of rows of the table of events; None for all."""
    from carom.cli.trajectory_output import MOST_ROWS

    if text in (None, "all"):
        return MOST_ROWS if text is None else None
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
        "--save-events": lambda part: write_columns(event_columns(run, run.events.rows), part),
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
