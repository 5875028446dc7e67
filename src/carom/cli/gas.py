"""``carom gas``: run the scene of a gas; print, plot and save what was measured; stop and resume."""

from __future__ import annotations

import contextlib
import functools
import math
import shlex
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from carom.cli.options import (
    GAS_FILMS,
    OUTPUT,
    RUN,
    assigned,
    of_option,
    option,
    parse_with_unit,
    require_outputs,
    shared,
    write_files,
    wrote,
)
from carom.cli.streams import json_text, note, say_interrupted, say_json, say_notes, stop_requests
from carom.errors import CaromError, Fault, FaultList, collected
from carom.formatting import counted

if TYPE_CHECKING:
    from carom.cli.gas_output import Progress
    from carom.gas.results import Every
    from carom.gas.scene import GasScene
    from carom.gas.session import Session
    from carom.sweeps.ensembles import Ensemble


def run_ensemble(
    scene: GasScene,
    members: int,
    progress: Progress,
    plot: Path | None,
    measures: Path | None,
    as_json: bool,
    quiet: bool,
    store: Path | None,
    on: str,
) -> None:
    """Simulate an ensemble; print it, plot it, and write its measures."""
    from carom.cli.console import out
    from carom.cli.gas_output import no_diffusion, print_tables
    from carom.gas.results import EndedEarlyError
    from carom.sweeps.ensembles import gas_ensemble

    progress.note_compiling()
    found = FaultList()
    try:
        with progress:
            told = functools.partial(_show_members, progress, members)
            ensemble = gas_ensemble(scene, members, store=store, on=on.removeprefix("dask:"), progress=told)
    except EndedEarlyError as error:
        if error.result is None:
            raise
        ensemble = error.result
        found += error.records
    except KeyboardInterrupt:
        kept = (
            "nothing was saved" if store is None else f"the gases that are done are in {store}; run it again to go on"
        )
        say_interrupted(f"carom: interrupted; {kept}")
        raise
    written = write_files(found, ensemble, [(plot, _plot), (measures, _write)])
    # the report is printed even if a file cannot be written
    if as_json:
        say_json(_numbers(ensemble), 1)
    elif not quiet:
        undefined = not (scene.container.geometry.faces or scene.shear_rate) and math.isnan(ensemble.mean["diffusion"])
        notes = [no_diffusion("displacement" in ensemble.curves or not ensemble.curves)] if undefined else []
        if ensemble.ended_early:
            notes.append(f"{len(ensemble.ended_early)} of {members} gases ended early; each counts up to its end.")
        print_tables(scene, f"{members} gases: {scene.describe()}", ensemble.mean, ensemble.error, notes)
        out().print("In brackets: standard error of the mean, in units of the last digits.", soft_wrap=True)
    wrote(*(() if quiet else written))
    found.raise_if_any()


def _show_members(progress: Progress, members: int, done: float, total: float, _text: str) -> None:
    """Show how many gases are done, on a terminal as a bar."""
    if progress.bar is not None:
        progress.bar.describe(f"{members} gases")
        progress.bar.show(done / total, 1.0, f"{done:.0f} done")
    elif done == 0:
        progress.say(f"simulating {members} gases")


# --- output --------------------------------------------------------------------------------------------------------


def _numbers(ensemble: Ensemble) -> dict[str, Any]:
    """Return the object of ``--json``."""
    return {
        "ensemble": len(ensemble.seeds), "seeds": list(ensemble.seeds), "mean": ensemble.mean, "error": ensemble.error,
        "ended_early": {str(seed): end.to_dict() for seed, end in ensemble.ended_early.items()},
    }  # fmt: skip


def _write(ensemble: Ensemble, path: Path) -> None:
    """Write all measures, of each member and their means, and the curves as JSON."""
    from carom.files import write_text

    curves = {
        name: {part: values.tolist() for part, values in curve._asdict().items()}
        for name, curve in ensemble.curves.items()
    }
    found = _numbers(ensemble) | {"curves": curves, "members": ensemble.members}
    write_text(path, json_text(found, None))


# ----------------------------------------------------------------------------------------------------
# Snapshots of ``carom gas``: how large they may become.


UNITS = {"": 1.0, "B": 1.0, "KB": 1e3, "MB": 1e6, "GB": 1e9, "TB": 1e12}
SAID_FROM = 1e8  # bytes: smaller files need no word


def size_limit(text: str | None) -> float | None:
    """Return a size in bytes, such as "20 GB", as a number."""
    if text is None:
        return None
    words = text.strip().upper()
    number = words.rstrip("BKMGT ")
    with contextlib.suppress(ValueError, KeyError):
        if (size := float(number) * UNITS[words[len(number) :].strip()]) > 0:
            return size
    raise CaromError(f"--max-size: expected a size > 0, such as '20 GB' or '500 MB', got {text!r}")


def allowed_size(path: Path, scene: GasScene, every: Every | None, most: float | None, progress: Progress) -> float:
    """Return how many bytes of snapshots may be written. CaromError where more are expected."""
    from carom.gas.snapshots import MAX_BYTES, expected_snapshots, require_size

    assert every is not None
    size = expected_snapshots(scene, every, path.suffix.lower())
    limit = MAX_BYTES if most is None else most
    if size.total >= SAID_FROM:
        progress.say(f"snapshots: {size.describe(scene.count)}")
    try:
        require_size(path, size, scene.count, limit)
    except CaromError as error:
        raise CaromError(*(of_option("--snapshots", fault) for fault in error.records)) from None
    return limit


# ----------------------------------------------------------------------------------------------------
# ``carom gas``: run the scene of a gas; print, plot and save what was measured; stop and resume.


RESUME = "Stop and resume"
CHECKPOINT_INTERVAL = "10 min"
OPTIONS = {"max_events": "--max-events", "duration": "--duration", "from_time": "--from", "seed": "--seed"}
SET_GAS = (
    "Another value for numbers of the scene, such as contacts.*.restitution=0.9 or run.equilibrate=0; may be repeated."
)
SNAPSHOTS = 100  # per run, without --every


def gas(
    scene: Annotated[
        Path | None,
        typer.Argument(
            metavar="SCENE.toml", help="A gas; carom scene new --gas FILE writes one. With --resume: optional."
        ),
    ] = None,
    max_events: Annotated[
        int | None, shared("max_events", default="the scene's", help="Number of collisions to measure.")
    ] = None,
    duration: Annotated[str | None, shared("duration", default="the scene's", help="Duration to measure.")] = None,
    from_time: Annotated[
        str | None, option(RUN, "Simulated time before which nothing is measured.", "--from", metavar="T")
    ] = None,
    seed: Annotated[int | None, shared("seed", default="the scene's")] = None,
    set_: Annotated[list[str] | None, shared("set", help=SET_GAS)] = None,
    ensemble: Annotated[
        int | None,
        option(
            RUN,
            "Simulate N independent gases, on all cores; report mean and standard error of every measure.",
            metavar="N",
        ),
    ] = None,
    store: Annotated[
        Path | None,
        option(RUN, "Where gases of an ensemble that are done are kept: run it again to go on.", metavar="FILE.zarr"),
    ] = None,
    on: Annotated[
        str, option(RUN, "Of an ensemble: cores, or dask:ADDRESS of a cluster, with a store.", metavar="WHERE")
    ] = "cores",
    as_json: Annotated[bool, shared("json")] = False,
    quiet: Annotated[bool, shared("quiet")] = False,
    plot: Annotated[Path | None, shared("plot")] = None,
    animate: Annotated[
        Path | None,
        option(
            OUTPUT,
            "A film of the gas as it goes on after the run: .svg (moves in a page), .gif or .mp4.",
            metavar="FILE",
        ),
    ] = None,
    measures: Annotated[
        Path | None, option(OUTPUT, "All measures, with the curves of the plot: .json.", metavar="FILE")
    ] = None,
    snapshots: Annotated[
        Path | None,
        option(OUTPUT, "Snapshots of the balls: .gsd (OVITO), .npz (NumPy) or .xyz (extended XYZ).", metavar="FILE"),
    ] = None,
    every: Annotated[
        str | None, option(OUTPUT, "Time between snapshots, '5000 events', or '20 per decade' of time.", metavar="T")
    ] = None,
    max_size: Annotated[
        str | None, option(OUTPUT, "Largest size of the snapshots: '20 GB'. Default: 1 GB.", metavar="SIZE")
    ] = None,
    yes: Annotated[bool, option(OUTPUT, "Write snapshots of any size for which there is room.", "--yes")] = False,
    force: Annotated[bool, shared("force", help="Overwrite snapshots that exist.")] = False,
    checkpoint: Annotated[
        Path | None, option(RESUME, "Save the state of the run, to resume from.", metavar="FILE")
    ] = None,
    checkpoint_every: Annotated[
        str, option(RESUME, "Interval of checkpoints: '10 min', or '1000000 events'.", metavar="T")
    ] = CHECKPOINT_INTERVAL,
    resume: Annotated[
        Path | None,
        option(
            RESUME,
            "Resume from a checkpoint. Without --checkpoint the state of the run is saved to FILE too, and replaces it.",
            metavar="FILE",
        ),
    ] = None,
) -> None:
    """Simulate a gas of balls or discs, event by event, and report what was measured as tables, JSON or a plot."""
    from carom.cli.gas_output import Progress, show
    from carom.gas.files import RunFiles, run_with_files
    from carom.gas.report import report

    found = FaultList()
    kept = {
        "--checkpoint": checkpoint,
        "--resume": resume if checkpoint is None and resume and resume.exists() else None,
    }
    _check_files(found, {"--plot": plot, "--animate": animate, "--measures": measures, "--snapshots": snapshots}, kept)
    if ensemble is not None:
        if ensemble < 2:
            found.add("--ensemble", "a number of gases >= 2", str(ensemble))
        files = {
            "--animate": animate, "--snapshots": snapshots, "--every": every, "--max-size": max_size, "--yes": yes or None,
            "--checkpoint": checkpoint, "--resume": resume,
        }  # fmt: skip
        advice = "run one of its gases by its --seed, which --json prints"
        given_too = {name: str(value) for name, value in files.items() if value is not None}
        found += [Fault("", name, "none with --ensemble", value, advice) for name, value in given_too.items()]
    elif store is not None or on != "cores":
        found.add("--ensemble", "a number of gases with --store and --on", "none")
    if snapshots is not None and resume is None and not force and snapshots.is_file():
        found.add(f"--snapshots {snapshots}", "a new file", "an existing one", "--force overwrites it")
    interval = found.attempt(_interval, "--checkpoint-every", checkpoint_every)
    if interval is not None and checkpoint_every != CHECKPOINT_INTERVAL and checkpoint is None and resume is None:
        found.add("--checkpoint-every", "--checkpoint FILE as well", "none")
    changes = {"max_events": max_events, "duration": duration, "from_time": from_time, "seed": seed}
    given = found.attempt(_scene, scene, resume, changes, assigned(found, set_))
    snapshot_every, most = _snapshot_options(found, snapshots, every, max_size, yes, given)
    found.raise_if_any()
    progress = Progress(quiet)
    if ensemble is not None:
        return run_ensemble(given, ensemble, progress, plot, measures, as_json, quiet, store, on)
    session = _session(
        given, resume, progress
    )  # (until it is made nothing can be kept: signals end the command at once)
    with stop_requests() as signals:
        snapshot_every = _keep_outputs(
            session, {"--snapshots": snapshots, "--measures": measures, "--plot": plot}, snapshot_every, progress
        )
        kept_files = RunFiles(
            snapshots,
            snapshot_every,
            math.inf if snapshots is None else allowed_size(snapshots, session.scene, snapshot_every, most, progress),
            checkpoint or resume,
            interval,
            Path(f"{Path(given.where if resume is None else resume).stem}.checkpoint.npz"),
        )
        with progress:
            end = run_with_files(
                session, kept_files, stop=lambda: bool(signals), progress=progress.show, say=progress.say
            )
    if end.checkpoint is not None and not end.finished:
        again = {
            "--max-events": max_events,
            "--duration": duration,
            "--from": from_time,
            "--snapshots": snapshots,
            "--every": every,
            "--max-size": "inf" if yes and max_size is None else max_size,
            "--set": set_,
        }
        _stopped(session, given, end.checkpoint, signals[0], again, end.faults)
    found += end.faults
    if end.finished:
        # the report is printed even if a file cannot be written
        actions = [(plot, _plot), (animate, lambda one, path: _animate(one, path, quiet)), (measures, _write_measures)]
        written = write_files(found, session, actions)
        with collected(found):
            if as_json:
                say_json(report(session), 1)
            elif not quiet:
                show(session)
        if not quiet:
            if end.checkpoint is not None:
                note(f"checkpoint written: {end.checkpoint}")
            wrote(*written, *([] if end.snapshots is None else [end.snapshots]))
    found.raise_if_any()


# --- options -------------------------------------------------------------------------------------------------------


def _check_files(found: FaultList, named: dict[str, Path | None], kept: dict[str, Path | None]) -> None:
    """Add the faults of the files to be written, and of missing libraries, to ``found``."""
    from carom.gas.files import require_checkpoint

    # (a checkpoint has any name)
    kinds: dict[str, tuple[str, ...]] = {
        option: (path.suffix.lower(),) for option, path in kept.items() if path is not None
    }
    kinds |= {"--animate": GAS_FILMS, "--measures": (".json",), "--snapshots": (".gsd", ".npz", ".xyz")}
    require_outputs(found, named | kept, kinds)
    if kept["--checkpoint"] is not None and not any(str(fault).startswith("--checkpoint ") for fault in found):
        faults = FaultList()
        faults.attempt(require_checkpoint, kept["--checkpoint"])
        found += [of_option("--checkpoint", fault) for fault in faults]


def _snapshot_options(
    found: FaultList, snapshots: Path | None, every: str | None, max_size: str | None, yes: bool, scene: GasScene | None
) -> tuple[Every | None, float | None]:
    """Return the interval of snapshots and their largest size in bytes, None if not given; add faults to ``found``."""
    interval = found.attempt(_spacing, every, scene) if every is not None else None
    for name, value in (("--every", every), ("--max-size", max_size), ("--yes", yes or None)):
        if value is not None and snapshots is None:
            found.add(name, "--snapshots FILE as well", "none")
    return interval, math.inf if yes and max_size is None else found.attempt(size_limit, max_size)


def _spacing(text: str, scene: GasScene | None) -> Every:
    """Return the interval of snapshots; of so many per decade of time the first is at the gas's mean free time."""
    from carom.gas.results import LogTimes
    from carom.gas.snapshots import mean_free_time

    words = text.split()
    if words[1:] in (["per", "decade"], ["per", "decade", "from", words[-1]]):
        try:
            count = float(words[0])
            first = float(words[-1]) if len(words) > 3 else math.nan if scene is None else mean_free_time(scene)
        except ValueError:
            count = first = math.nan
        if 0 < count < math.inf and 0 < first < math.inf:
            return LogTimes(first, count)
        raise CaromError(
            f"--every: expected a number per decade of time, such as '20 per decade from 0.5', got {text!r}"
        )
    return _interval("--every", text)


def _interval(option: str, text: str) -> int | float:
    """Return a number of collisions (an int), or a time (a float; in s if it has a unit)."""
    words = text.replace("_", "").replace(",", "").split()
    if len(words) == 2 and words[1] in {"event", "events"} and words[0].isdecimal() and int(words[0]) > 0:
        return int(words[0])
    return _time(option, text, "0.5, '10 min', or '5000 events'")


def _time(option: str, text: str, such_as: str = "0.5, or '10 min'") -> float:
    """Return a time (in s if it has a unit)."""
    with contextlib.suppress(CaromError):
        if 0 < (found := parse_with_unit(option, "s", text)) < math.inf:
            return found
    raise CaromError(f"{option}: expected a time > 0, such as {such_as}, got {text!r}")


def _scene(path: Path | None, resume: Path | None, changes: dict[str, Any], values: dict[str, Any]) -> GasScene | None:
    """Return the scene of a file, with ``values`` at its paths, and the options in place of its [run]; None: the checkpoint's."""
    from carom.gas.scene import GasSettings, load_gas
    from carom.scene.toml import replaced

    changes = {name: value for name, value in changes.items() if value is not None}
    if path is None:
        if resume is None:
            raise CaromError("SCENE.toml: expected a scene, got none; carom scene new --gas FILE writes one")
        if changes or values:
            options = ", ".join([*(OPTIONS[name] for name in changes), *["--set"] * bool(values)])
            raise CaromError(f"{options}: expected SCENE.toml as well, got only a checkpoint; name the scene too")
        return None
    scene = load_gas(path)
    if values:
        where = scene.where
        try:
            scene = replaced(scene, values)
        except CaromError as error:
            raise CaromError(*error.records_at("--set", "path", "GasScene")) from None
        object.__setattr__(scene, "where", where)
    say_notes(scene.notes())
    if not changes:
        return scene
    for name in ("duration", "from_time"):
        if name in changes:
            changes[name] = _time(OPTIONS[name], changes[name])
    run = GasSettings(**{name: getattr(scene.run, name) for name in GasSettings.model_fields} | changes)
    return scene.model_copy(update={"run": run})


def _keep_outputs(
    session: Session, outputs: dict[str, Path | None], every: Every | None, progress: Progress
) -> Every | None:
    """Keep the names of a run's files for those who resume it; say which files of the run resumed are not named again.

    Return the interval of snapshots, if there are any: as given, as before, or a hundredth of the run.
    """
    before = session.outputs
    if missing := {option: name for option, name in before.items() if outputs.get(option, "") is None}:
        again = missing | (
            {"--every": before["--every"]} if {"--snapshots"} & {*missing} and "--every" in before else {}
        )
        options = " ".join(f"{option} {shlex.quote(name)}" for option, name in again.items())
        progress.say(f"this run wrote {', '.join(missing.values())}; repeat {options} to continue it")
    session.outputs = before | {option: str(path) for option, path in outputs.items() if path is not None}
    if outputs["--snapshots"] is None:
        return None
    run = session.scene.run
    if every is None and "--every" in before:
        every = _spacing(before["--every"], None)
    elif every is None and run.duration and run.max_events is None:
        every = run.duration / SNAPSHOTS
    elif every is None:
        every = max((run.max_events or 0) // SNAPSHOTS, 1)
    session.outputs["--every"] = _spaced(every)
    return every


def _spaced(every: Every) -> str:
    """Return an interval of snapshots as the option has it."""
    if isinstance(every, int):
        return f"{every} events"
    return repr(every) if isinstance(every, float) else f"{every.per_decade!r} per decade from {every.first!r}"


# --- run -----------------------------------------------------------------------------------------------------------


def _session(scene: GasScene | None, resume: Path | None, progress: Progress) -> Session:
    from carom.cli.console import working
    from carom.gas.files import load_checkpoint
    from carom.gas.session import Session

    if resume is not None:
        session = load_checkpoint(resume, scene, compiling=progress.note_compiling)
        progress.say(f"resuming from {resume}: {session.gas.collisions:,} collisions, t = {session.gas.time:.6g}")
        return session
    assert scene is not None
    progress.note_compiling()
    with working("growing a dense start", quiet=progress.quiet) as show:
        return Session(scene, show)


def _stopped(
    session: Session,
    scene: GasScene | None,
    checkpoint: Path | None,
    which: int,
    options: dict[str, Any],
    faults: FaultList,
) -> None:
    """Print faults, where the run was stopped and how to resume it, with the options that it needs again, and exit."""
    for fault in faults:
        note(f"carom: {fault}")
    given = [(name, one) for name, value in options.items() for one in (value if isinstance(value, list) else [value])]
    again = [part for name, value in given if value is not None for part in (name, shlex.quote(str(value)))]
    parts = ("carom gas", scene and scene.where, "--resume", checkpoint, *again)
    command = " ".join(str(part) for part in parts if part is not None)
    note(
        f"carom: stopped after {counted(session.done, 'event')} of the {'run' if session.measuring else 'equilibration'},"
        f" t = {session.gas.time:.6g}; resume with: {command}"
    )
    raise typer.Exit(128 + which)


# --- output --------------------------------------------------------------------------------------------------------


def _plot(found: Session | Ensemble, path: Path) -> None:
    found.plot(path)


def _animate(session: Session, path: Path, quiet: bool) -> None:
    """Write the film."""
    from carom.cli.console import working
    from carom.plot.film import animate_gas

    with working("rendering", quiet=quiet) as progress:
        animate_gas(session, path, progress=progress)


def _write_measures(session: Session, measures: Path) -> None:
    """Write all measures as JSON."""
    from carom.files import write_text
    from carom.gas.report import report, series

    write_text(measures, json_text(report(session) | series(session), None))
