"""``carom sweep``: maps over parameters of a scene, computed block by block into a store, and drawn."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from carom.cli.console import working
from carom.cli.options import OUTPUT, RUN, option, parse_assignments, require_outputs, shared, write_new, wrote
from carom.cli.streams import say_json
from carom.errors import CaromError, FaultList
from carom.formatting import counted

if TYPE_CHECKING:
    from carom.sweeps.sweep import Sweep

FILE = Annotated[
    Path, typer.Argument(metavar="FILE", help="A sweep, as TOML (carom sweep new writes one), or the store of one.")
]
STORE = Annotated[
    str, typer.Argument(metavar="STORE", help="The store of a sweep: a folder, or an address (s3://...).")
]
SHOWN_FAILURES = 5  # points without an outcome
OWN_LAWS = Annotated[bool, shared("allow_own_laws")]
JSON = Annotated[bool, shared("json")]


def new(
    file: Annotated[
        Path | None, typer.Argument(metavar="FILE", help="File to write. Default: standard output.")
    ] = None,
    force: Annotated[bool, shared("force")] = False,
) -> None:
    """Write a commented sweep that runs as it stands: where the balls of a carom table end, over speed and angle."""
    from carom.sweeps.sweep import new_sweep

    write_new(file, new_sweep(), force)


def explain(file: FILE, allow_own_laws: OWN_LAWS = False, as_json: JSON = False) -> None:
    """Say how many points, blocks, bytes and seconds a sweep has; a few points are computed, nothing is written."""
    from carom.cli.streams import say

    plan = _sweep(str(file), None, allow_own_laws).explain()
    if as_json:
        say_json({name: value for name, value in vars(plan).items() if name != "text"})
    else:
        say(plan.text)


def run(
    file: FILE,
    store: Annotated[
        str | None,
        option(
            OUTPUT,
            "Folder or address of the results.",
            "--store",
            metavar="STORE",
            show_default="FILE with the ending .zarr",
        ),
    ] = None,
    on: Annotated[
        str,
        option(
            RUN,
            "Where: on this machine's cores, or on a Dask cluster.",
            "--on",
            metavar="cores|dask:ADDRESS",
        ),
    ] = "cores",
    block: Annotated[
        str | None,
        option(RUN, "Only the K-th of N equal parts, for one of an array of jobs.", "--block", metavar="K/N"),
    ] = None,
    allow_own_laws: OWN_LAWS = False,
    as_json: JSON = False,
    quiet: Annotated[bool, shared("quiet")] = False,
) -> None:
    """Compute what is missing of a sweep, block by block; stopped, by Ctrl-C or kill, it goes on where it was."""
    from carom.cli.streams import say_interrupted

    part = None if block is None else _part(block)
    place = on.removeprefix("dask:")
    if on != "cores" and not on.startswith("dask:"):
        raise CaromError(f"--on: expected cores or dask:ADDRESS such as dask:tcp://host:8786, got {on!r:.60}")
    made = _sweep(str(file), store or str(file.with_suffix(".zarr")), allow_own_laws)
    assert made.store is not None
    try:
        with working("sweep", quiet=quiet or as_json, unit="points") as report:
            made.run(on=place, part=part, progress=report)
    except KeyboardInterrupt:
        say_interrupted(f"carom: stopped; what is done stays in {made.store.name}: the same command goes on")
        raise
    found = made.status(0 if as_json or quiet else SHOWN_FAILURES)
    _report(made.store.name, found, as_json, quiet)


def status(store: STORE, as_json: JSON = False, allow_own_laws: OWN_LAWS = False) -> None:
    """Say how far a sweep is, how many of its points have no outcome, and why: of the first five."""
    made = _stored(store, allow_own_laws)
    assert made.store is not None
    found = made.status(0 if as_json else SHOWN_FAILURES)
    _report(made.store.name, found, as_json, False)


def verify(
    store: STORE,
    blocks: Annotated[int, typer.Option("--blocks", min=0, help="Number of blocks that are computed again.")] = 3,
    allow_own_laws: OWN_LAWS = False,
    as_json: JSON = False,
) -> None:
    """Compare a store with its checksums, and some of its blocks with what is computed again; exit code 1 if any differ."""
    from carom.cli.streams import say

    made = _stored(store, allow_own_laws)
    with working("sweep", quiet=as_json, unit="points") as report:
        bad = made.verify(blocks, report)
    done = made.blocks.number - len(made.missing())
    if as_json:
        say_json({"blocks_done": done, "blocks_computed_again": min(blocks, done), "blocks_that_differ": bad})
    elif bad:
        say(f"{store}: {len(bad):,} of {done:,} blocks differ: {', '.join(map(str, bad[:12]))}")
    else:
        say(f"{store}: {done:,} blocks have their checksums, {min(blocks, done)} computed again are the same bits")
    if bad:
        raise typer.Exit(1)


def plot(
    store: STORE,
    out: Annotated[Path, shared("plot", flags=("--out", "--plot"), help="Figure to draw: .svg, .pdf or .png.")],
    of: Annotated[
        str | None,
        option(OUTPUT, "Outcome to draw, such as final.position.", "--of", metavar="NAME", show_default="the first"),
    ] = None,
    x: Annotated[str | None, option(OUTPUT, "Dimension along x.", "--x", metavar="DIM")] = None,
    y: Annotated[str | None, option(OUTPUT, "Dimension along y.", "--y", metavar="DIM")] = None,
    panels: Annotated[
        str | None, option(OUTPUT, "Dimension with a panel for each value.", "--panels", metavar="DIM")
    ] = None,
    at: Annotated[
        list[str] | None,
        option(OUTPUT, "Value of another dimension: ball=white, axis=x. May be repeated.", "--at", metavar="DIM=VALUE"),
    ] = None,
    allow_own_laws: OWN_LAWS = False,
) -> None:
    """Draw a map of an outcome over one or two dimensions, with small multiples for a third."""
    from carom.plot import save
    from carom.plot.sweeps import plot_sweep
    from carom.sweeps.store import open_dataset

    found = FaultList()
    require_outputs(found, {"--out": out})
    chosen = {name.strip(): value.strip() for name, value in parse_assignments(found, "--at", at)}
    made = found.attempt(_stored, store, allow_own_laws)
    found.raise_if_any()
    made.missing()
    save(plot_sweep(open_dataset(made), of, x=x, y=y, panels=panels, at=chosen), out)
    wrote(out)


# --- shared --------------------------------------------------------------------------------------------------------


def _sweep(file: str, store: str | None, allow_own_laws: bool) -> Sweep:
    """Return the sweep of a file, or of a store."""
    from carom.sweeps.sweep import load_sweep

    if "://" in file or Path(file).is_dir():
        return _stored(file, allow_own_laws)
    return load_sweep(file, store, allow_own_laws=allow_own_laws)


def _stored(store: str, allow_own_laws: bool) -> Sweep:
    from carom.sweeps.sweep import stored_sweep

    return stored_sweep(store, allow_own_laws)


def _part(text: str) -> tuple[int, int]:
    first, slash, second = text.partition("/")
    if not (slash and first.isdecimal() and second.isdecimal() and 1 <= int(first) <= int(second)):
        raise CaromError(f"--block: expected K/N with 1 <= K <= N, such as 17/64, got {text!r}")
    return int(first), int(second)


def _report(store: str, found: dict[str, Any], as_json: bool, quiet: bool) -> None:
    """Print how far a store is; ``found``: what its sweep says of it (Sweep.status)."""
    from carom.cli.streams import say

    if as_json:
        say_json(found)
    if as_json or quiet:
        return
    say(
        f"{store}: {found['points_done']:,} of {found['points']:,} points,"
        f" {found['blocks_done']:,} of {found['blocks']:,} blocks"
    )
    for reason, count in found["failed"].items():
        say(f"  without an outcome: {counted(count, 'point')} ({reason.replace('_', ' ')})")
    for line in found["first_failures"]:
        say(f"    {line}")
