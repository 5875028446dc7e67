"""Sweeps on a Dask cluster: blocks as tasks, whose workers write to the store themselves."""

from __future__ import annotations

import itertools
import os
import time
from collections.abc import Callable, Iterator
from typing import Any

from carom.errors import CaromError
from carom.files import import_optional

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
        yield from _follow(distributed, client, sweep, write_block, blocks, place)
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


def _follow(
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
