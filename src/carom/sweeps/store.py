"""Stores of sweeps: a Zarr v3 group that xarray opens, written block by block, the mark that a block is done last.

    /                       attributes: carom (specification, identity, versions; complete: when everything else stands)
    /<outcome>              one array each, one shard a block
    /failed                 why a point has no outcome
    /<dimension>, ...       coordinates
    /blocks/checksum        of every block, 0 where it is not done

Several processes may write different blocks at once, without locks: no two of them write the same file.
"""

from __future__ import annotations

import contextlib
import hashlib
import itertools
import json
import math
import os
import time
import warnings
from collections import Counter
from collections.abc import Callable, Iterator, Mapping
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from carom.errors import CaromError
from carom.files import import_optional
from carom.formatting import counted, format_number
from carom.sweeps.axes import FAILED, WHY, Outcome
from carom.sweeps.space import Coordinate

Array = NDArray[Any]
ATTRIBUTE = "carom"
BLOCKS = "blocks"  # the group of what is known of blocks
MOST_BLOCKS = 1 << 25  # of a sweep: one number each lies in memory
INNER_POINTS = 8192  # of a chunk within a shard: what a reader of a few points has to read


class Blocks(NamedTuple):
    """How points are divided into blocks: boxes of ``rows`` places along one dimension and all of the later ones."""

    shape: tuple[int, ...]
    axis: int
    rows: int

    @property
    def box(self) -> tuple[int, ...]:
        """Shape of a block; the last ones along ``axis`` may be shorter."""
        return (*(1,) * self.axis, self.rows, *self.shape[self.axis + 1 :]) if self.shape else ()

    @property
    def along(self) -> int:
        """Number of blocks along ``axis``."""
        return -(-self.shape[self.axis] // self.rows) if self.shape else 1

    @property
    def number(self) -> int:
        """Number of blocks."""
        return math.prod(self.shape[: self.axis]) * self.along

    def region(self, block: int) -> tuple[slice, ...]:
        """Return where a block lies in the arrays."""
        if not self.shape:
            return ()
        before, k = divmod(block, self.along)
        start = np.unravel_index(before, self.shape[: self.axis]) if self.axis else ()
        rows = slice(k * self.rows, min((k + 1) * self.rows, self.shape[self.axis]))
        return (*(slice(int(i), int(i) + 1) for i in start), rows, *(slice(0, n) for n in self.shape[self.axis + 1 :]))

    def points(self, block: int) -> tuple[int, int]:
        """Return the first point of a block and the one after its last: blocks are contiguous in C order."""
        if not self.shape:
            return 0, 1
        before, k = divmod(block, self.along)
        inner = math.prod(self.shape[self.axis + 1 :])
        whole = self.shape[self.axis] * inner
        return before * whole + k * self.rows * inner, before * whole + min((k + 1) * self.rows * inner, whole)


def blocks_of(shape: tuple[int, ...], points: int) -> Blocks:
    """Return blocks of about so many points, at most."""
    inner = 1
    for axis in range(len(shape) - 1, -1, -1):
        if inner * shape[axis] > points or axis == 0:
            rows, chunk = min(max(points // inner, 1), shape[axis]), max(INNER_POINTS // inner, 1)
            # (a whole number of chunks: the last block may reach over the end)
            return Blocks(shape, axis, rows if rows <= chunk else rows - rows % chunk)
        inner *= shape[axis]
    return Blocks(shape, 0, 1)


def require_few(blocks: Blocks) -> None:
    """Raise CaromError for more blocks than lists of them may have in memory."""
    if blocks.number > MOST_BLOCKS:
        raise CaromError(
            f"sweep: block: expected at most {MOST_BLOCKS:,} blocks, got {blocks.number:,}; take larger blocks, or fewer points"
        )


def _inner(blocks: Blocks) -> tuple[int, ...]:
    """Return the shape of chunks within a block's shard: a whole number of them along its axis."""
    if not blocks.shape:
        return ()
    rest = math.prod(blocks.box[blocks.axis + 1 :])
    chunk = min(max(INNER_POINTS // rest, 1), blocks.rows)
    return (*(1,) * blocks.axis, chunk, *blocks.box[blocks.axis + 1 :])


def checksum(outcomes: list[Outcome], values: Mapping[str, Array]) -> int:
    """Return a block's checksum, never 0: 8 bytes of BLAKE2b over all outcomes and ``failed``."""
    digest = hashlib.blake2b(digest_size=8)
    for name in (one.name for one in (*outcomes, WHY)):
        digest.update(np.ascontiguousarray(values[name]).data)
    return int.from_bytes(digest.digest(), "little") or 1


class Store:
    """A sweep's store: a folder, an address that fsspec knows (s3://...), or a store of Zarr's own."""

    def __init__(self, place: Any) -> None:
        self.zarr = import_optional("zarr", "sweep: store")
        self.place = place if not isinstance(place, str) and hasattr(place, "list_prefix") else str(place)
        self.name = str(place)

    @contextlib.contextmanager
    def _explaining(self, what: str) -> Iterator[None]:
        try:
            with warnings.catch_warnings():
                # (consolidated metadata are Zarr's own extension of v3)
                warnings.filterwarnings("ignore", message=".*onsolidated metadata.*")
                yield
        except (OSError, PermissionError) as error:
            said = error.strerror or str(error) or type(error).__name__
            raise CaromError(
                f"{self.name}: expected a store that can be {what}, got: {said}; blocks that are done stay: run it again to"
                " go on"
            ) from None

    # --- reading ---------------------------------------------------------------------------------------------------

    def attributes(self) -> dict[str, Any] | None:
        """Return the store's description of its sweep; None where there is nothing. CaromError for what is no store of a sweep."""
        with self._explaining("read"):
            try:
                group = self.zarr.open_group(self.place, mode="r", zarr_format=3)
            except (FileNotFoundError, self.zarr.errors.GroupNotFoundError):
                self._require_empty()
                return None
            except Exception as error:
                if isinstance(error, OSError) and not isinstance(error, NotADirectoryError):
                    raise
                raise CaromError(
                    f"{self.name}: expected a store of a sweep, got something else ({type(error).__name__}); name a new one"
                ) from None
        found = dict(group.attrs).get(ATTRIBUTE)
        if not isinstance(found, dict) or "identity" not in found:
            raise CaromError(f"{self.name}: expected a store of a sweep, got a Zarr group without one; name a new one")
        # (the metadata of all arrays, in one place, are what is written last)
        return found | {"complete": found.get("complete") is True and group.metadata.consolidated_metadata is not None}

    def _require_empty(self) -> None:
        import os

        if isinstance(self.place, str) and "://" not in self.place and os.path.exists(self.place):
            if not os.path.isdir(self.place):
                raise CaromError(f"{self.name}: expected a store of a sweep, a folder, got a file; name a new one")
            if any(not name.endswith(".partial") for name in os.listdir(self.place)):
                raise CaromError(
                    f"{self.name}: expected a store of a sweep, got a folder with other things; name a new one"
                )

    def require_arrays(self, blocks: Blocks, outcomes: list[Outcome]) -> None:
        """Raise CaromError for arrays that are not as :meth:`create` makes them: of another size, nothing of them is read."""
        with self._explaining("read"):
            group = self.zarr.open_group(self.place, mode="r", zarr_format=3)
            expected: dict[str, tuple[Any, ...]] = {
                one.name: (np.dtype(one.dtype), (*blocks.shape, *one.shape), (*_inner(blocks), *one.shape))
                for one in [*outcomes, WHY]
            }
            expected[f"{BLOCKS}/checksum"] = np.dtype("u8"), (blocks.number,), (1,)
            for name, (dtype, shape, chunks) in expected.items():
                array = group.get(name)
                got = "nothing" if array is None else "an array" if hasattr(array, "shape") else "a group"
                if got == "an array" and (array.dtype, array.shape) == (dtype, shape):
                    if array.chunks == chunks or math.prod(array.chunks) <= max(math.prod(shape), 1):
                        continue
                    got = f"chunks of {array.chunks}"
                elif got == "an array":
                    got = f"{array.dtype} {array.shape}"
                raise CaromError(
                    f"{self.name}: expected {name} as this sweep makes it, {dtype} {shape}, got {got}: the store is damaged; name a"
                    " new one"
                )

    def checksums(self) -> Array:
        """Return (blocks,) the checksums: 0 where a block is not done."""
        return self.read(f"{BLOCKS}/checksum", (slice(None),))

    def read(self, name: str, region: tuple[slice, ...]) -> Array:
        """Return a part of a variable."""
        with self._explaining("read"):
            array = self.zarr.open_group(self.place, mode="r", zarr_format=3)[name]
            return np.asarray(array[region if array.ndim else ...])

    def require_possible(self, outcome: Outcome, values: Array) -> None:
        """Raise CaromError for a value that an outcome cannot have: other code wrote it, its checksum may be right."""
        wrong = values[outcome.impossible(values)]
        if wrong.size:
            low, high = outcome.bounds
            raise CaromError(
                f"{self.name}: expected {outcome.name} from {low:g} to {high:g}, got {wrong[0].item()!r}: the store is damaged;"
                " name a new one"
            )

    # --- writing ---------------------------------------------------------------------------------------------------

    def create(
        self,
        specification: dict[str, Any],
        blocks: Blocks,
        dims: tuple[str, ...],
        outcomes: list[Outcome],
        coordinates: list[Coordinate],
    ) -> None:
        """Make the arrays, and say last what they are. What another process has made already stays as it is."""
        with self._explaining("written"):
            # (a process that is killed here leaves a store that says whose it is, and is made again)
            begun = {ATTRIBUTE: {**specification, "complete": False}}
            group = self.zarr.open_group(self.place, mode="a", zarr_format=3, attributes=begun)
            for outcome in [*outcomes, WHY]:
                inner = outcome.shape
                self._array(
                    group,
                    outcome.name,
                    _about(outcome),
                    shape=(*blocks.shape, *inner),
                    dtype=outcome.dtype,
                    chunks=(*_inner(blocks), *inner) or "auto",
                    shards=(*blocks.box, *inner) or None,
                    fill_value=outcome.fill,
                    dimension_names=(*dims, *outcome.dims),
                )
                for dim, labels in outcome.dims.items():
                    self._coordinate(group, dim, (dim,), np.array(labels), {})
            for one in coordinates:
                self._coordinate(group, one.name, one.dims, one.values, one.about)
            inside = group.require_group(BLOCKS)
            self._array(
                inside,
                "checksum",
                {},
                shape=(blocks.number,),
                dtype="u8",
                chunks=(1,),
                fill_value=0,
                dimension_names=("block",),
            )
            group.attrs[ATTRIBUTE] = {**specification, "complete": True}
            self.zarr.consolidate_metadata(group.store)

    def _coordinate(
        self, group: Any, name: str, dims: tuple[str, ...], values: Array, attributes: dict[str, Any]
    ) -> None:
        if values.dtype.kind == "U":
            # (texts have no type in Zarr v3 yet: names are numbered, and their meanings written beside them)
            attributes = attributes | {"names": values.tolist()}
            values = np.arange(len(values))
        array = self._array(
            group,
            name,
            attributes,
            shape=values.shape,
            dtype=values.dtype,
            chunks=values.shape,
            fill_value=0,
            dimension_names=dims,
        )
        array[:] = values

    def _array(self, group: Any, name: str, attributes: dict[str, Any], **about: Any) -> Any:
        try:
            return group.create_array(name, attributes=attributes, **about)
        except (self.zarr.errors.ContainsArrayError, FileExistsError):
            return group[name]

    def write(self, block: int, blocks: Blocks, outcomes: list[Outcome], values: Mapping[str, Array]) -> int:
        """Write a block, and then that it is done; return its checksum."""
        with self._explaining("written"):
            group = self.zarr.open_group(self.place, mode="r+", zarr_format=3)
            region = blocks.region(block)
            shape = tuple(one.stop - one.start for one in region)
            for name in (one.name for one in (*outcomes, WHY)):
                array = values[name].reshape((*shape, *values[name].shape[1:]))
                group[name][region if region else ...] = array if region else array.reshape(tuple(group[name].shape))
            found = checksum(outcomes, values)
            group[f"{BLOCKS}/checksum"][block] = found
            return found


def identity(data: dict[str, Any]) -> str:
    """Return the hash of a specification."""
    return hashlib.sha256(json.dumps(data, sort_keys=True).encode()).hexdigest()


# ----------------------------------------------------------------------------------------------------
# Results of sweeps as labelled arrays: an ``xarray.Dataset`` with coordinates, units and attributes.


LOOKED_AT = 100  # points without an outcome
MOST_LOOKED_AT = 2e7  # bytes of a store whose values are looked at when it is opened; of a larger one `verify` does


def _attributes(sweep: Any) -> dict[str, Any]:
    about = sweep.specification
    found = {name: about[name] for name in ("identity", "sources", "seed", "repeats")}
    versions = {f"{name}_version": version for name, version in about["versions"].items()}
    return {"specification": json.dumps(about, sort_keys=True), **found, **versions}


def _about(outcome: Outcome) -> dict[str, Any]:
    found: dict[str, Any] = {} if outcome.units == "1" else {"units": outcome.units}
    if outcome.meanings:
        found |= {"flag_values": list(range(len(outcome.meanings))), "flag_meanings": list(outcome.meanings)}
    return found


def _coordinates(sweep: Any) -> dict[str, Any]:
    found: dict[str, Any] = {}
    for one in sweep.space.coordinates:
        found[one.name] = (one.dims, one.values, one.about)
    for outcome in sweep.outcomes:
        for dim, labels in outcome.dims.items():
            found.setdefault(dim, ((dim,), np.array(labels)))
    return found


def dataset_of(sweep: Any, values: dict[str, Any]) -> Any:
    """Return the result as an ``xarray.Dataset``; ``values`` by name have the shape of the space, and then their own."""
    xarray = import_optional("xarray", "sweep")
    dims = tuple(sweep.space.dims)
    variables = {one.name: ((*dims, *one.dims), values[one.name], _about(one)) for one in (*sweep.outcomes, WHY)}
    return xarray.Dataset(variables, _coordinates(sweep), _attributes(sweep))


def open_dataset(sweep: Any) -> Any:
    """Return the result in a store as an ``xarray.Dataset``, whose values are read when they are used."""
    xarray = import_optional("xarray", "sweep")
    assert sweep.store is not None
    with warnings.catch_warnings():
        warnings.filterwarnings("ignore", message=".*onsolidated metadata.*")
        found = xarray.open_dataset(sweep.store.place, engine="zarr", chunks=None, mask_and_scale=False)
    # (names are numbers in a store)
    if sum(variable.nbytes for variable in found.values()) <= MOST_LOOKED_AT:
        for one in (*sweep.outcomes, WHY):
            sweep.store.require_possible(one, found[one.name].values)
    found = found[[one.name for one in (*sweep.outcomes, WHY)]].assign_coords(_coordinates(sweep))
    del found.attrs["carom"]  # (which is in "specification", as text)
    return found.assign_attrs(_attributes(sweep))


def first_failures(sweep: Any, most: int) -> list[str]:
    """Return the first points without an outcome, by their parameters, and why each one has none; repeats are counted."""
    codes = open_dataset(sweep)[FAILED].values
    shown: Counter[str] = Counter()
    for place in np.argwhere(codes > 0)[:LOOKED_AT]:
        index = int(np.ravel_multi_index(tuple(place), codes.shape)) if codes.shape else 0
        values = sweep.space.columns(index, index + 1)
        point = ", ".join(f"{path} = {_words(value)}" for path, value in values.items())
        line = f"{point}: {sweep.why(*place)}"
        if line in shown or len(shown) < most:
            shown[line] += 1
    left = int((codes > 0).sum()) - shown.total()
    lines = [line if count == 1 else f"{line} ({count:,} times)" for line, count in shown.items()]
    return [*lines, f"and {counted(left, 'more point')}"] if left else lines


def _words(value: Any) -> str:
    return ", ".join(format_number(x, 6) if isinstance(x, int | float) else str(x) for x in np.ravel(value).tolist())


# ----------------------------------------------------------------------------------------------------
# Sweeps on a Dask cluster: blocks as tasks, whose workers write to the store themselves.

CONNECT_SECONDS = 10
IN_FLIGHT = (
    4  # tasks of each thread of the cluster that the scheduler knows of: its graph stays small for any number of blocks
)
ALONE_SECONDS = 60.0  # after which a cluster without a worker is given up: one that starts them anew takes some seconds
POLL_SECONDS, ASK_SECONDS = 0.02, 1.0  # between looks for tasks that are done, and for workers
MOST_LOST = 1000  # blocks that are begun anew after the scheduler has given them up: three of their workers died


def run_on_cluster(sweep: Any, write_block: Callable[..., int], blocks: list[int], on: Any) -> Iterator[int]:
    """Have the blocks of a Sweep computed on a cluster, and yield each as it is done.

    ``write_block(place, identity, own_laws, block)`` is what a worker does.

    ``on`` is the address of a scheduler, or a ``distributed.Client``. Raises CaromError where nobody answers within 10 s, where the
    connection is lost, where no worker is there for a minute, and where a worker cannot write.
    """
    distributed = import_optional("distributed", "sweep: run: on")
    assert sweep.store is not None
    if not isinstance(sweep.store.place, str):
        raise CaromError(
            "sweep: run: on: expected a store with a name that workers can open, got an object; name a folder or an address"
        )
    client, own = _client(distributed, on)
    place = sweep.store.place if "://" in sweep.store.place else os.path.abspath(sweep.store.place)
    try:
        yield from _submit_blocks(distributed, client, sweep, write_block, blocks, place)
    finally:
        if own:
            client.close(timeout=2)


def _client(distributed: Any, on: Any) -> tuple[Any, bool]:
    if isinstance(on, distributed.Client):
        return on, False
    if not isinstance(on, str) or "://" not in on:
        raise CaromError(
            "sweep: run: on: expected 'cores', the address of a Dask scheduler such as 'tcp://host:8786', or a Client, got"
            f" {on!r:.60}"
        )
    try:
        return distributed.Client(on, timeout=CONNECT_SECONDS, set_as_default=False), True
    except (OSError, TimeoutError, ValueError) as error:
        raise CaromError(
            f"sweep: run: on: expected a Dask scheduler that answers at {on} within {CONNECT_SECONDS} s, got none"
            f" ({type(error).__name__}); is it running, and can this machine reach it?"
        ) from None


def _submit_blocks(
    distributed: Any, client: Any, sweep: Any, write_block: Callable[..., int], blocks: list[int], place: str
) -> Iterator[int]:
    identity = sweep.specification["identity"]
    threads = sum(worker["nthreads"] for worker in client.scheduler_info(n_workers=-1)["workers"].values())
    waiting, tries = iter(blocks), 0
    done = 0
    running: dict[Any, int] = {}

    def submit(block: int) -> Any:
        key = f"carom-{identity[:12]}-{block}-{tries}"
        future = client.submit(write_block, place, identity, sweep.own_laws, block, key=key, pure=False)
        running[future] = block
        return future

    line = distributed.as_completed(
        [submit(block) for block in itertools.islice(waiting, IN_FLIGHT * max(threads, 1))],
        raise_errors=False,
        loop=client.loop,
    )
    try:
        for future in _as_they_come(client, line):
            if future is None:
                raise _given_up(f"a worker, got none for {ALONE_SECONDS:g} s", done, len(blocks))
            block = running.pop(future)
            if future.status == "finished":
                done += 1
                yield block
                following = next(waiting, None)
            elif _was_lost(distributed, future) and tries < MOST_LOST:
                following, tries = block, tries + 1
            else:
                raise _explained(future, done, len(blocks))
            if following is not None:
                line.add(submit(following))
    except (OSError, TimeoutError) as error:
        raise _given_up(
            f"the connection to the scheduler to last, got {type(error).__name__}", done, len(blocks)
        ) from None


def _as_they_come(client: Any, line: Any) -> Iterator[Any]:
    """Yield tasks that are done; None, at last, where no worker is there to do the others."""
    with_workers = asked = time.monotonic()
    while not line.is_empty():
        if line.has_ready():
            yield next(line)
            continue
        time.sleep(POLL_SECONDS)
        now = time.monotonic()
        if now - asked > ASK_SECONDS:
            asked = now
            if client.scheduler_info(n_workers=-1)["workers"]:
                with_workers = now
            elif now - with_workers > ALONE_SECONDS:
                yield None


def _given_up(what: str, done: int, count: int) -> CaromError:
    return CaromError(
        f"sweep: run: on: expected {what} after {done:,} of {count:,} blocks; they stay: run it again to go on"
    )


def _was_lost(distributed: Any, future: Any) -> bool:
    """Return whether a task failed because the workers it was on died, several of them one after the other."""
    return future.status == "error" and isinstance(future.exception(), distributed.scheduler.KilledWorker)


def _explained(future: Any, done: int, count: int) -> CaromError:
    if future.status in ("cancelled", "lost"):
        return _given_up(f"the connection to the scheduler to last, got {future.status}", done, count)
    error = future.exception()
    if isinstance(error, CaromError):
        return error
    return _given_up(f"a block from every task, got {type(error).__name__}: {error}", done, count)
