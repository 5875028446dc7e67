"""``carom gas``: a gas of rough balls, run as its scene says; measured, drawn, kept, and gone on with."""

from __future__ import annotations

import json
import signal
import sys
from collections.abc import Callable, Iterator
from contextlib import ExitStack, contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from carom.cli.places import require_places
from carom.cli.shared import attempt, wrote
from carom.errors import CaromError

if TYPE_CHECKING:
    from carom.cli.gas_progress import Progress
    from carom.gas.model import GasScene
    from carom.gas.session import Session
    from carom.gas.snapshots import Snapshots

RUN, SHOWN, FILES, KEPT = "The run", "What is shown", "Files", "Stop and go on"
RHYTHM = "10 min"  # of checkpoints
SNAPSHOTS = 100  # in a run, if it is not said how often


def register(app: typer.Typer) -> None:
    """Add the verb to the command."""
    app.command()(gas)


def gas(
    scene: Annotated[
        Path | None,
        typer.Argument(
            metavar="SCENE.toml", help="A gas; carom scene new --gas FILE writes one. With --resume: optional."
        ),
    ] = None,
    max_events: Annotated[
        int | None, typer.Option(metavar="N", help="Collisions to measure, not the scene's.", rich_help_panel=RUN)
    ] = None,
    duration: Annotated[
        str | None, typer.Option(metavar="T", help="Time to measure, not the scene's.", rich_help_panel=RUN)
    ] = None,
    seed: Annotated[int | None, typer.Option(metavar="N", help="In place of the scene's.", rich_help_panel=RUN)] = None,
    as_json: Annotated[
        bool, typer.Option("--json", help="JSON on standard output, nothing else.", rich_help_panel=SHOWN)
    ] = False,
    quiet: Annotated[
        bool, typer.Option("--quiet", help="Nothing on the screen but errors.", rich_help_panel=SHOWN)
    ] = False,
    plot: Annotated[
        Path | None, typer.Option(metavar="FILE", help="Draw it: .svg, .pdf or .png.", rich_help_panel=FILES)
    ] = None,
    measures: Annotated[
        Path | None,
        typer.Option(metavar="FILE", help="All that was measured, what is drawn too: .json.", rich_help_panel=FILES),
    ] = None,
    snapshots: Annotated[
        Path | None, typer.Option(metavar="FILE", help="Balls on the way, for OVITO: .gsd.", rich_help_panel=FILES)
    ] = None,
    every: Annotated[
        str | None,
        typer.Option(metavar="T", help="Time between snapshots; or '5000 events'.", rich_help_panel=FILES),
    ] = None,
    force: Annotated[
        bool, typer.Option("--force", help="Write over snapshots that are there.", rich_help_panel=FILES)
    ] = False,
    checkpoint: Annotated[
        Path | None, typer.Option(metavar="FILE", help="Keep where it is, to go on from.", rich_help_panel=KEPT)
    ] = None,
    checkpoint_every: Annotated[
        str, typer.Option(metavar="T", help="How often: '10 min', or '1000000 events'.", rich_help_panel=KEPT)
    ] = RHYTHM,
    resume: Annotated[
        Path | None, typer.Option(metavar="FILE", help="Go on from a checkpoint.", rich_help_panel=KEPT)
    ] = None,
) -> None:
    """Run a gas of balls or discs event by event: what was measured, as a table, as JSON, as a picture."""
    from carom.cli.gas_progress import Progress

    found: list[str] = []
    kept = {
        "--checkpoint": checkpoint,
        "--resume": resume if checkpoint is None and resume and resume.exists() else None,
    }
    _places(found, plot, measures, snapshots, kept)
    if snapshots is not None and resume is None and not force and snapshots.is_file():
        found.append(f"--snapshots {snapshots}: expected a new file, got one that is there; --force writes over it")
    rhythm = attempt(found, _rhythm, "--checkpoint-every", checkpoint_every)
    if rhythm is not None and checkpoint_every != RHYTHM and checkpoint is None and resume is None:
        found.append("--checkpoint-every: expected --checkpoint FILE beside it, got none")
    changes = {"max_events": max_events, "duration": duration, "seed": seed}
    given = attempt(found, _scene, scene, resume, changes)
    frames = attempt(found, _rhythm, "--every", every) if every is not None else None
    if every is not None and snapshots is None:
        found.append("--every: expected --snapshots FILE.gsd beside it, got none")
    if found:
        raise CaromError(*found)
    progress = Progress(quiet)
    with ExitStack() as stack:
        asked = stack.enter_context(_signals())
        session = _session(scene, given, resume, progress)
        file = None if snapshots is None else stack.enter_context(_snapshots(snapshots, session, resume is not None))
        keeper = _Keeper(checkpoint or resume, rhythm, file, progress)

        def on_the_way(now: Session) -> None:
            progress.show(now)
            keeper.look(now)

        with progress:
            whole = session.run(
                stop=lambda: bool(asked),
                progress=on_the_way,
                every=None if file is None else _frames(frames, session),
                snapshot=None if file is None else lambda now: file.write(now.gas),
            )
        if not whole and keeper.path is None:
            keeper.path = Path(f"{(scene or resume or Path('gas')).stem}.checkpoint.npz")
        written: list[Path] = []
        _done(found, written, keeper.path, keeper.keep, session)
    if not whole and not found:
        _stopped(session, scene, keeper.path, asked[0])
    if whole:
        # what was measured is told, whatever becomes of the files
        _done(found, written, plot, _draw, session, plot)
        _done(found, written, measures, _list, session, measures)
        _tell(session, as_json, quiet)
        wrote(*(() if quiet else (*written, *([] if snapshots is None else [snapshots]))))
    if found:
        raise CaromError(*found)


# --- what is asked for ---------------------------------------------------------------------------------------------


def _places(
    found: list[str], plot: Path | None, measures: Path | None, snapshots: Path | None, kept: dict[str, Path | None]
) -> None:
    """Faults of the files that are to be written, or of libraries that they need."""
    from carom.files import library
    from carom.gas.checkpoint import require_checkpoint

    # (a checkpoint has any name)
    kinds = {option: (path.suffix.lower(),) for option, path in kept.items() if path is not None}
    named = {"--plot": plot, "--measures": measures, "--snapshots": snapshots, **kept}
    require_places(found, named, {"--measures": (".json",), "--snapshots": (".gsd",), **kinds})
    checkpoint = kept["--checkpoint"]
    if checkpoint is not None and not any(fault.startswith("--checkpoint ") for fault in found):
        faults: list[str] = []
        attempt(faults, require_checkpoint, checkpoint)
        found += [f"--checkpoint {fault}" for fault in faults]
    if snapshots is not None:
        attempt(found, library, "gsd.hoomd", "gsd", "--snapshots")


def _rhythm(option: str, text: str) -> int | float:
    """So many collisions (an int), or a time (a float; a unit of time makes it seconds)."""
    from carom.scene.quantities import Number

    words = text.replace("_", "").replace(",", "").split()
    if len(words) == 2 and words[1] in {"event", "events"} and words[0].isdecimal() and int(words[0]) > 0:
        return int(words[0])
    try:
        value: Any = float(text)
    except ValueError:
        value = text
    try:
        return Number("a time > 0", "s", least=0, above=True)(value)
    except Exception:  # pydantic's own error, which only a model makes a line of
        raise CaromError(
            f"{option}: expected a time > 0, such as 0.5, '10 min', or '5000 events', got {text!r}"
        ) from None


def _scene(path: Path | None, resume: Path | None, changes: dict[str, Any]) -> GasScene | None:
    """The gas of a file, with what the options say in place of its [run]; None: that of the checkpoint."""
    from carom.gas.model import GasScene, GasSettings
    from carom.gas.toml import load_gas

    changes = {name: value for name, value in changes.items() if value is not None}
    if path is None:
        if resume is None:
            raise CaromError("SCENE.toml: expected a scene, got none; carom scene new --gas FILE writes one")
        if changes:
            options = ", ".join(f"--{name.replace('_', '-')}" for name in changes)
            raise CaromError(f"{options}: expected a scene beside it, got only a checkpoint; name the SCENE.toml too")
        return None
    scene = load_gas(path)
    if not changes:
        return scene
    if "duration" in changes:
        value = _rhythm("--duration", changes["duration"])
        changes["duration"] = float(value)
    try:
        run = GasSettings(**{name: getattr(scene.run, name) for name in GasSettings.model_fields} | changes)
    except CaromError as error:
        said = [fault.replace("GasSettings: ", "--").replace("max_events", "max-events", 1) for fault in error.faults]
        raise CaromError(*said) from None
    return scene.model_copy(update={"run": run}) if isinstance(scene, GasScene) else scene


def _frames(frames: int | float | None, session: Session) -> int | float:
    """How often a snapshot is taken: as it was said, or a hundred times in the run."""
    run = session.scene.run
    if frames is not None:
        return frames
    if run.max_events is not None:
        return max(run.max_events // SNAPSHOTS, 1)
    assert run.duration is not None
    return run.duration / SNAPSHOTS


# --- the run -------------------------------------------------------------------------------------------------------


def _session(path: Path | None, scene: GasScene | None, resume: Path | None, progress: Progress) -> Session:
    from carom.gas.checkpoint import load_checkpoint
    from carom.gas.session import Session

    if resume is not None:
        session = load_checkpoint(resume, scene, compiling=progress.note_compiling)
        progress.say(f"going on from {resume}: {session.gas.collisions:,} collisions, t = {session.gas.time:.6g}")
        return session
    assert scene is not None
    progress.note_compiling()
    return Session(scene, str(path), progress.growing)


@contextmanager
def _snapshots(path: Path, session: Session, resumed: bool) -> Iterator[Snapshots]:
    from carom.gas.snapshots import Snapshots

    file = Snapshots(path, session.names, session.frames if resumed and session.frames else None)
    try:
        yield file
    finally:
        file.close()


@contextmanager
def _signals() -> Iterator[list[int]]:
    """Signals that ask the run to end, as they come; the second one ends it at once."""
    asked: list[int] = []

    def note(which: int, _frame: Any) -> None:
        if asked:
            sys.stderr.write("carom: interrupted; nothing was kept\n")
            raise typer.Exit(128 + which)
        asked.append(which)

    before = {which: signal.signal(which, note) for which in (signal.SIGINT, signal.SIGTERM)}
    try:
        yield asked
    finally:
        for which, handler in before.items():
            signal.signal(which, handler)


class _Keeper:
    """Writes checkpoints, as often as it is asked to."""

    def __init__(self, path: Path | None, every: int | float, file: Snapshots | None, progress: Progress) -> None:
        import time

        self.path, self.every, self.file, self.progress, self.clock = path, every, file, progress, time.monotonic
        self.last: float | None = None

    def look(self, session: Session) -> None:
        """Write one if it is time to. Where that fails the run goes on, with the checkpoint before."""
        now = session.gas.collisions if isinstance(self.every, int) else self.clock()
        if self.path is None or self.last is None:
            self.last = now if self.last is None else self.last
        elif now - self.last >= self.every:
            self.last = now
            try:
                self.keep(session)
            except CaromError as error:
                self.progress.say(f"carom: {error}; the one before stays, and the run goes on")

    def keep(self, session: Session) -> None:
        """Write one now."""
        from carom.gas.checkpoint import save_checkpoint

        if self.path is not None:
            if self.file is not None:
                self.file.flush()
            save_checkpoint(session, self.path)


def _stopped(session: Session, scene: Path | None, kept: Path | None, which: int) -> None:
    """Say where it is and how to go on, and end."""
    words = " ".join(str(part) for part in ("carom gas", scene, "--resume", kept) if part is not None)
    sys.stderr.write(
        f"carom: stopped after {session.done:,} events of the {'run' if session.measuring else 'equilibration'},"
        f" t = {session.gas.time:.6g}; go on with: {words}\n"
    )
    raise typer.Exit(128 + which)


# --- what comes of it ----------------------------------------------------------------------------------------------


def _done(found: list[str], written: list[Path], path: Path | None, action: Callable[..., Any], *args: Any) -> None:
    """Write a file, if it was asked for: its path to ``written``, or the fault to ``found``."""
    if path is not None:
        before = len(found)
        attempt(found, action, *args)
        written += [path] * (len(found) == before)


def _draw(session: Session, plot: Path) -> None:
    from carom.plot.gas import plot_gas

    plot_gas(session, plot)


def _list(session: Session, measures: Path) -> None:
    from carom.cli.gas_tables import finite
    from carom.files import whole
    from carom.gas.report import report, series

    with whole(measures) as part:
        part.write_text(json.dumps(finite(report(session) | series(session)), allow_nan=False) + "\n", encoding="utf-8")


def _tell(session: Session, as_json: bool, quiet: bool) -> None:
    from carom.cli import gas_tables as tables

    if as_json:
        sys.stdout.write(tables.as_json(session))
    elif not quiet:
        tables.show(session)
