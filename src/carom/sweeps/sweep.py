"""Sweeps: a space, the outcomes of every point, and a store; computed block by block, and resumed after an interruption."""

from __future__ import annotations

import functools
import math
import platform
import threading
import time
from collections.abc import Callable, Mapping
from importlib.resources import files
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from carom.core.jit.cache import source_hash
from carom.errors import CaromError, Fault, FaultList, did_you_mean, require_count, shown
from carom.files import as_path, require_memory
from carom.formatting import format_bytes, format_time
from carom.gas.scene import GasScene, load_gas
from carom.public.own_laws import with_own_laws
from carom.scene.presets import read_toml
from carom.scene.toml import load_scene
from carom.sweeps.axes import FAILED, FAILURES, NOT_DONE, WHY, Axis, Outcome, axis_from_data
from carom.sweeps.space import Space, subject_from_data
from carom.sweeps.store import (
    BLOCKS,
    Blocks,
    Store,
    blocks_of,
    checksum,
    dataset_of,
    first_failures,
    identity,
    open_dataset,
    require_few,
    run_on_cluster,
)

if TYPE_CHECKING:
    import xarray


class SweepPlan:
    """Plan of a sweep: :meth:`Sweep.explain`."""

    def __init__(self, text: str, **numbers: Any) -> None:
        self.text = text
        self.points: int = numbers["points"]
        self.blocks: int = numbers["blocks"]
        self.blocks_done: int = numbers["blocks_done"]
        self.bytes: int = numbers["bytes"]
        self.seconds: float = numbers["seconds"]
        """Time for the blocks that are not done, on this machine's cores."""

    def __repr__(self) -> str:
        """Return the table as text."""
        return self.text


# ----------------------------------------------------------------------------------------------------
# Sweeps: a space, the outcomes of every point, and a store; computed block by block, and resumed after an interruption.


Array = NDArray[Any]
Progress = Callable[[int, int], None]
BLOCK_POINTS = 1 << 16
SAMPLE_SECONDS = 0.25  # that points are computed for, so as to estimate how long all take
SAMPLE_PLACES = 16  # where these points lie, spread over the space


class Sweep:
    """A sweep: made by :func:`carom.sweep`.

    Examples
    --------
    >>> import numpy as np, carom
    >>> ball = carom.SceneBall(radius=0.03, mass=0.2, position=(1, 0, 0))
    >>> wall = carom.scene.Plane(point=(0, 0, 0), normal=(1, 0, 0), restitution=0.85, friction=0.2)
    >>> scene = carom.Scene(gravity=0, walls=[wall], balls=[ball], run=carom.Run(duration=2))
    >>> space = carom.Space(scene, {"balls.0.velocity": carom.polar(2.0, np.linspace(120, 240, 5)), "walls.*.friction": [0.1, 0.3]})
    >>> ds = carom.sweep(space, keep=["final.velocity", "events.wall.count"]).run()
    >>> ds["events.wall.count"].sel(friction=0.3).values
    array([1, 1, 1, 1, 1])
    """

    def __init__(self, space: Space, keep: tuple[str, ...], store: Store | None, blocks: Blocks) -> None:
        self.space = space
        self.outcomes: list[Outcome] = space.subject.outcomes(keep)
        space.require_names({FAILED, BLOCKS, *keep, *(dim for one in self.outcomes for dim in one.dims)})
        require_few(blocks)
        self.store = store
        self.blocks = blocks
        # (a worker of a cluster reads the names of laws from the store, where they have no mark)
        self.own_laws = space.has_own_laws

    def __repr__(self) -> str:
        """Return one line."""
        blocks = "1 block" if self.blocks.number == 1 else f"{self.blocks.number:,} blocks"
        return f"<Sweep: {self.space.size:,} points of {self.space.subject.describe()}, {blocks}>"

    @functools.cached_property
    def specification(self) -> dict[str, Any]:
        """Return the identity of the sweep, as plain data: its computation, the hash of the kernels' sources, types, blocks."""
        import carom

        data = {
            **self.space.to_data(),
            "keep": [outcome.name for outcome in self.outcomes],
            "dtypes": [outcome.dtype for outcome in self.outcomes],
            "sources": source_hash(),
            "block": [list(self.blocks.shape), self.blocks.axis, self.blocks.rows],
        }
        versions = {"carom": carom.__version__, "numpy": np.__version__, "python": platform.python_version()}
        return {"identity": identity(data), **data, "versions": versions}

    # --- computing -------------------------------------------------------------------------------------------------

    def compute(self, block: int, tick: Callable[[], None] | None = None) -> dict[str, Array]:
        """Compute a block; return its outcomes and ``failed``, (N, ...) by name."""
        first, stop = self.blocks.points(block)
        return self._compute(first, stop, tick)

    def _compute(self, first: int, stop: int, tick: Callable[[], None] | None = None) -> dict[str, Array]:
        columns = self.space.columns(first, stop)
        found, failed = self.space.subject.evaluate(columns, self.outcomes, first, self.space.seed, tick)
        return {**found, FAILED: failed}

    def missing(self) -> list[int]:
        """Return the blocks that are not done."""
        if self.store is None:
            return list(range(self.blocks.number))
        return np.flatnonzero(self._checksums() == 0).tolist()

    def _checksums(self) -> Array:
        assert self.store is not None
        there = self.store.attributes()
        self._require_same(there)
        if there is None or not there["complete"]:
            return np.zeros(self.blocks.number, np.uint64)
        self.store.require_arrays(self.blocks, self.outcomes)
        return self.store.checksums()

    def _require_same(self, there: dict[str, Any] | None) -> None:
        """Raise CaromError if the store holds another sweep, and say in what it differs."""
        assert self.store is not None
        here = self.specification
        if there is not None and there["identity"] != here["identity"]:
            parts = [name for name in here if name not in ("identity", "versions") and there.get(name) != here[name]]
            if parts == ["sources"]:
                raise CaromError(
                    f"{self.store.name}: expected a store of this version of carom, got one computed by other code"
                    f" (or by another version of Python or Numba; carom {there.get('versions', {}).get('carom', '?')}, sources"
                    f" {there.get('sources')}; here {here['sources']}); name a new store, or resume it with that version"
                )
            raise CaromError(
                f"{self.store.name}: expected the store of this sweep, got the store of another, which differs in"
                f" {', '.join(parts)}; name a new store"
            )

    def prepare(self) -> None:
        """Make the store, if there is none. CaromError if it holds something else."""
        if self.store is None:
            return
        there = self.store.attributes()
        self._require_same(there)
        if there is None or not there["complete"]:
            self.store.create(
                self.specification, self.blocks, tuple(self.space.dims), self.outcomes, self.space.coordinates
            )

    def write(self, block: int, tick: Callable[[], None] | None = None) -> int:
        """Compute a block and write it to the store; return its checksum."""
        assert self.store is not None
        return self.store.write(block, self.blocks, self.outcomes, self.compute(block, tick))

    def run(
        self, on: Any = "cores", *, part: tuple[int, int] | None = None, progress: Progress | None = None
    ) -> xarray.Dataset:
        """Compute what is missing, and return the result.

        Parameters
        ----------
        on : "cores", the address of a Dask scheduler such as "tcp://host:8786", or a ``distributed.Client``
            Where: on this machine's cores (default), or on a cluster, whose workers write to the store themselves.
        part : (int, int), optional
            (17, 64): only the blocks of the 17th of 64 equal parts, for a job of an array of jobs.
        progress : function of (points done, points in all), optional

        Returns
        -------
        xarray.Dataset
            The outcomes over the dimensions of the space; from a store they are read when they are used.

        Raises CaromError: a store of another sweep, a full disk, a cluster that cannot be reached; blocks that are done stay.
        """
        if on == "cuda":
            raise CaromError(
                "sweep: run: on: expected 'cores' or a cluster, got 'cuda': carom has no sweeps on a GPU any more"
            )
        blocks = self.missing()
        if part is not None:
            blocks = [block for block in blocks if block % part[1] == part[0] - 1]
        if self.store is None:
            if on != "cores":
                raise CaromError(
                    f"sweep: run: on: expected a store for a run on {on!r:.60}, got none; give store='FILE.zarr'"
                )
            return self._in_memory(progress)
        self.prepare()
        total = self.space.size
        done = total - sum(self._size(block) for block in self.missing())
        if progress is not None:
            progress(done, total)
        for block in self._written(blocks, on):
            done += self._size(block)
            if progress is not None:
                progress(done, total)
        return open_dataset(self)

    def _written(self, blocks: list[int], on: Any) -> Any:
        """Yield blocks as they are done."""
        if on == "cores":
            for block in blocks:
                self.write(block)
                yield block
        else:
            yield from run_on_cluster(self, write_block, blocks, on)

    def _size(self, block: int) -> int:
        first, stop = self.blocks.points(block)
        return stop - first

    def _in_memory(self, progress: Progress | None) -> Any:
        advice = "give a store, FILE.zarr, which keeps them on disk"
        require_memory(
            "sweep", "points", self.space.size, 2 * self._bytes_each(), advice
        )  # (parts, and all of them as one)
        parts: list[dict[str, Array]] = []
        done = 0
        for block in range(self.blocks.number):
            parts.append(self.compute(block))
            done += self._size(block)
            if progress is not None:
                progress(done, self.space.size)
        shape = self.space.shape
        values = {
            name: np.concatenate([part[name] for part in parts]).reshape((*shape, *parts[0][name].shape[1:]))
            for name in parts[0]
        }
        return dataset_of(self, values)

    # --- looking ---------------------------------------------------------------------------------------------------

    def _bytes_each(self) -> int:
        """Return the bytes of all outcomes of a point."""
        return sum(np.dtype(one.dtype).itemsize * math.prod(one.shape) for one in self.outcomes) + 1

    def explain(self) -> SweepPlan:
        """Say how many points, blocks, bytes and seconds the sweep has; a few points are computed to estimate its time.

        Nothing is written.
        """
        points = self.space.size
        each = self._bytes_each()
        missing = len(self.missing())
        seconds = self._seconds_each() * points * missing / self.blocks.number
        rows = [
            ("dimensions", " x ".join(f"{dim} {size:,}" for dim, size in self.space.dims.items()) or "none"),
            ("points", f"{points:,}"),
            (
                "blocks",
                f"{self.blocks.number:,} of up to {math.prod(self.blocks.box) if self.blocks.shape else 1:,} points",
            ),
            ("done", f"{self.blocks.number - missing:,} blocks"),
            ("size", f"{format_bytes(points * each)} before compression ({each} bytes a point)"),
            ("time", f"about {format_time(seconds)} on the cores of this machine"),
        ]
        text = "\n".join(f"{name:<11} {value}" for name, value in rows)
        return SweepPlan(
            text,
            points=points,
            blocks=self.blocks.number,
            blocks_done=self.blocks.number - missing,
            bytes=points * each,
            seconds=seconds,
        )

    def _seconds_each(self) -> float:
        """Return how long a point takes, from points spread over the space."""
        size, each = self.space.size, 1
        starts = np.unique(np.linspace(0, size - 1, min(size, SAMPLE_PLACES)).astype(int)).tolist()
        for start in starts:  # (what has to be compiled is not counted)
            self._compute(start, start + 1)
        while True:
            begin = time.perf_counter()
            computed = 0
            for start in starts:
                stop = min(start + each, size)
                self._compute(start, stop)
                computed += stop - start
            took = time.perf_counter() - begin
            if took > SAMPLE_SECONDS or each * len(starts) >= min(size, BLOCK_POINTS):
                return took / computed
            each *= 4

    def why(self, *place: int) -> str:
        """Return why a point, by its indices along the dimensions, has no outcome; empty if it has one."""
        index = int(np.ravel_multi_index(place, self.space.shape)) if self.space.shape else 0
        return self.space.subject.why(self.space.columns(index, index + 1))

    def status(self, failures: int = 0) -> dict[str, Any]:
        """Return how far the store is: points and blocks, done and in all, and how many points have no outcome, by reason.

        With ``failures`` also a line each of the first ones, by their parameters.
        """
        done = np.flatnonzero(self._checksums() != 0).tolist()
        failed = np.zeros(len(FAILURES), int)
        assert self.store is not None
        for block in done:
            codes = self.store.read(FAILED, self.blocks.region(block)).ravel()
            self.store.require_possible(WHY, codes)
            failed += np.bincount(codes[codes != NOT_DONE], minlength=len(FAILURES))
        shown = {"first_failures": first_failures(self, failures) if failed.any() else []} if failures else {}
        return {
            "points": self.space.size,
            "points_done": sum(self._size(block) for block in done),
            "blocks": self.blocks.number,
            "blocks_done": len(done),
            "failed": {name: int(count) for name, count in zip(FAILURES[1:], failed[1:], strict=True) if count},
            **shown,
        }

    def verify(self, blocks: int = 3, progress: Progress | None = None) -> list[int]:
        """Compute some blocks of the store again, spread over it, and compare; return the blocks that differ.

        What the store holds is compared with its checksums as well, for all blocks that are done.
        """
        assert self.store is not None
        sums = self._checksums()
        done = np.flatnonzero(sums).tolist()
        again = {done[int(k)] for k in np.linspace(0, len(done) - 1, min(max(blocks, 0), len(done)))}
        bad = []
        for count, block in enumerate(done):
            region = self.blocks.region(block)
            values = {one.name: self.store.read(one.name, region) for one in (*self.outcomes, WHY)}
            same = checksum(self.outcomes, values) == sums[block]
            same &= not any(one.impossible(values[one.name]).any() for one in (*self.outcomes, WHY))
            if same and block in again:
                same = checksum(self.outcomes, self.compute(block)) == sums[block]
            if not same:
                bad.append(block)
            if progress is not None:
                progress(count + 1, len(done))
        return bad


def sweep(
    space: Space | str | Path,
    keep: tuple[str, ...] | list[str] = (),
    store: Any = None,
    *,
    block: int = BLOCK_POINTS,
    allow_own_laws: bool = False,
) -> Sweep:
    """Make a sweep of a space, or take up the one of a store.

    Parameters
    ----------
    space : Space, or str or Path of a store
        With a store: the sweep that it holds, to resume or to read it.
    keep : sequence of str
        Outcomes of every point; of a scene "final.position", "final.phase", "final.pocket", "final.time", "events.count",
        "events.wall.count", "events.wall.0.position", ...; the error about an unknown name lists them.
    store : str, Path, or address that fsspec knows, optional
        Where results go, block by block; default: memory.
    block : int, optional
        Points of a block, at most. Default: 65,536.
    allow_own_laws : bool, optional
        Whether laws of one's own, "file.py:name", in a store that is opened may be run.

    Returns
    -------
    Sweep
        ``.explain()``, ``.run(on=...)``, ``.status()``, ``.verify()``.

    Raises CaromError: an unknown outcome, a store that is not there or is none.

    Examples
    --------
    >>> import carom
    >>> ball = carom.SceneBall(radius=0.03, mass=0.2, position=(1, 0, 0), velocity=(-1, 0, 0))
    >>> wall = carom.scene.Plane(point=(0, 0, 0), normal=(1, 0, 0), restitution=0.85, friction=0.2)
    >>> scene = carom.Scene(gravity=0, walls=[wall], balls=[ball], run=carom.Run(duration=2))
    >>> made = carom.sweep(carom.Space(scene, {"walls.0.restitution": [0.5, 1.0]}), keep=["final.velocity"])
    >>> made.run()["final.velocity"].values[:, 0, 0]
    array([0.5, 1. ])
    """
    if isinstance(space, str | Path):
        return stored_sweep(space, allow_own_laws)
    return sweep_over(space, keep, store, block)


def sweep_over(space: Space, keep: tuple[str, ...] | list[str], store: Any, block: int) -> Sweep:
    """Return the sweep over a space, as :func:`sweep` does."""
    if not isinstance(space, Space):
        raise CaromError(
            f"sweep: space: expected a Space or the name of a store, got {type(space).__name__} {space!r:.60}"
        )
    if isinstance(keep, str) or not keep or not all(isinstance(one, str) for one in keep):
        raise CaromError(f"sweep: keep: expected a list of outcomes such as ['final.position'], got {keep!r:.60}")
    require_count("sweep", "block", block)
    return Sweep(
        space, tuple(dict.fromkeys(keep)), None if store is None else Store(store), blocks_of(space.shape, block)
    )


def stored_sweep(place: str | Path, allow_own_laws: bool = False) -> Sweep:
    """Return the sweep of a store, as :func:`sweep` does."""
    from carom.sweeps.axes import axis_from_data
    from carom.sweeps.space import subject_from_data

    store = Store(place)
    data = store.attributes()
    if data is None:
        raise CaromError(
            f"{store.name}: expected a store of a sweep, got nothing there; carom.sweep(space, keep, store=...) makes one"
        )
    try:
        subject = subject_from_data(data["subject"], store.name, allow_own_laws=allow_own_laws)
        given = with_own_laws(data["parameters"]) if allow_own_laws else data["parameters"]
        parameters = {path: axis_from_data(one, f"{store.name}: {path}") for path, one in given.items()}
        space = Space(subject, parameters, data["repeats"], data["seed"])
        shape, axis, rows = data["block"]
        found = Sweep(space, tuple(data["keep"]), store, Blocks(tuple(shape), axis, rows))
    except (AttributeError, KeyError, TypeError, ValueError) as error:
        if isinstance(error, CaromError):
            raise
        raise CaromError(
            f"{store.name}: expected a store of a sweep, got one whose attributes are damaged ({error})"
        ) from None
    return found


# --- what a worker of a cluster does -------------------------------------------------------------------------------

# Numba's threads serve one loop at a time: a worker that runs several tasks lets them take turns.
_turns = threading.Lock()


@functools.lru_cache(maxsize=4)
def _opened(place: str, identity: str, own_laws: bool) -> Sweep:
    found = stored_sweep(place, own_laws)
    if found.specification["identity"] != identity:
        raise CaromError(
            f"{place}: expected workers with the same version of carom as here, got other sources"
            f" ({found.specification['sources']}); install the same versions of carom, Python and Numba everywhere"
        )
    return found


def write_block(place: str, identity: str, own_laws: bool, block: int) -> int:
    """Compute a block and write it to the store at ``place``; return its number. (What a worker does, with all of its threads.)"""
    from distributed import get_worker

    from carom.core.jit.threads import limit_threads

    with _turns:
        limit_threads(get_worker().state.nthreads)
        _opened(place, identity, own_laws).write(block)
    return block


# ----------------------------------------------------------------------------------------------------
# Sweeps in files: what is swept, its parameters, what is kept.


SUBJECTS = ("scene", "gas", "impact", "orbit")
FIELDS = ("keep", "repeats", "seed", "block", "parameters", *SUBJECTS)


def new_sweep() -> str:
    """Return the text of a commented sweep file that runs as it stands.

    Examples
    --------
    >>> from carom import sweeps
    >>> sweeps.new_sweep().splitlines()[0].startswith("# A sweep for carom")
    True
    """
    return files("carom.sweeps").joinpath("new.toml").read_text(encoding="utf-8")


def load_sweep(path: str | Path, store: Any = None, *, allow_own_laws: bool = False) -> Sweep:
    """Read a sweep from a TOML file; ``carom sweep new`` writes one.

    Parameters
    ----------
    path : str or Path
    store : str or Path, optional
        Where results go; default: memory.
    allow_own_laws : bool, optional
        Whether laws of one's own, "file.py:name", may be run. Default: they are refused.

    Returns
    -------
    Sweep. Raises CaromError, one line per problem.

    Examples
    --------
    >>> import pathlib, tempfile
    >>> from carom import sweeps
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     file = pathlib.Path(folder) / "sweep.toml"
    ...     _ = file.write_text(sweeps.new_sweep(), encoding="utf-8")
    ...     sweeps.load_sweep(file)
    <Sweep: 1,488 points of a scene, 1 block>
    """
    path = as_path("load_sweep", path)
    table = read_toml(path, f"carom sweep new {path} writes one", "a sweep file")
    if allow_own_laws:
        table = with_own_laws(table)
    if not set(FIELDS) & set(table) and (
        strange := sorted({"balls", "container", "floor", "species", "walls"} & set(table))
    ):
        scene = f"the scene itself, with {' and '.join(strange)}"
        raise CaromError(
            Fault(f"{path}", "", "a sweep of a scene", scene, f"in a sweep file it is named: scene = '{path.name}'")
        )
    found = FaultList(str(path))
    for name in table:
        if name not in FIELDS:
            found.add(name, f"one of {', '.join(FIELDS)}", repr(name), did_you_mean(name, FIELDS))
    given = [name for name in SUBJECTS if name in table]
    if len(given) != 1:
        expected, got = f"one of {', '.join(SUBJECTS)}, which is swept", " and ".join(given) or "none"
        found.add("", expected, got, "scene = 'scene.toml', or a table [scene]")
    subject = None
    if len(given) == 1:
        subject = found.attempt(_subject, path, given[0], table[given[0]], allow_own_laws)
    parameters: dict[str, Axis] = {}
    if not isinstance(table.get("parameters"), Mapping):
        found.add("parameters", "a table [parameters] of paths", shown(table.get("parameters"), 60))
    else:
        for name, data in table["parameters"].items():
            axis = found.attempt(axis_from_data, data, f"{path}: {name}")
            parameters |= {} if axis is None else {name: axis}
    made = None
    if subject is not None and parameters:  # (what is sound is looked at even where something is not)
        try:
            space = Space(subject, parameters, table.get("repeats", 1), table.get("seed", 0))
            made = sweep_over(space, table.get("keep", ()), store, table.get("block", BLOCK_POINTS))
        except CaromError as error:
            found += error.records_at(found.where)
    if found or made is None:
        raise CaromError(*found)
    return made


def _subject(path: Path, kind: str, given: Any, allow_own_laws: bool) -> Any:
    if isinstance(given, str) and kind in ("scene", "gas"):
        file = path.parent / given
        if kind == "scene":
            return load_scene(file, allow_own_laws=allow_own_laws)
        gas = load_gas(file)
        if not isinstance(gas, GasScene):
            raise CaromError(
                f"{file}: expected a gas of balls in a container, got another kind; sweep one of {GasScene.__name__}"
            )
        return gas
    if not isinstance(given, Mapping):
        raise CaromError(f"{path}: {kind}: expected a table [{kind}], got {given!r:.60}")
    return subject_from_data({kind: given}, f"{path}: {kind}", allow_own_laws=allow_own_laws)
