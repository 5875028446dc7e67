"""Sweeps disturbed at random moments: the finished store is bit-equal to one that was never disturbed.

    python campaigns/sweep_kills.py [N] [--only driver|worker|disk]

Of each kind N disturbances (100): the process that runs the sweep is killed (SIGKILL) after a random number of blocks and a random
moment of the next; a worker of a Dask cluster of two processes is killed, most often within a block; a write fails for want of
room (ENOSPC) at a random file. After each the sweep is resumed, and begun anew when it is finished. Every finished store is
compared with that of an undisturbed run, file by file.
"""

from __future__ import annotations

import os
import shutil
import signal
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable, Sequence
from pathlib import Path

import numpy as np
from campaign import ROOT, Campaign, campaign
from reference.sweep_scenes import KEEP, files_of, space

import carom

KINDS = ("driver", "worker", "disk")
BLOCK, FEW = 4, 20
"""Points of a block; where the campaign runs as small as it goes, there are few blocks."""
PROGRAM = """
import sys, carom
from reference.sweep_scenes import KEEP, space
def tell(done, total):
    print(done, flush=True)
carom.sweep(space(), KEEP, store=sys.argv[1], block=int(sys.argv[2])).run(progress=tell)
"""


def clean(store: Path) -> dict[str, str]:
    """Return the hashes of a store's files, without what was being written when a process was killed."""
    for part in store.rglob("*.partial"):
        part.unlink()
    return files_of(store)


def kill_driver(store: Path, block: int, rng: np.random.Generator) -> bool:
    """Run the sweep in a process of its own and kill it; return whether it was killed before its end."""
    environment = {**os.environ, "PYTHONPATH": os.pathsep.join([str(ROOT / "src"), str(ROOT / "tests")])}
    command = [sys.executable, "-c", PROGRAM, str(store), str(block)]
    with subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, env=environment) as process:
        assert process.stdout is not None
        for _line in range(int(rng.integers(1, 12))):
            process.stdout.readline()
        time.sleep(rng.uniform(0, 0.02))
        process.send_signal(signal.SIGKILL)
    return process.returncode == -signal.SIGKILL


def kill_worker(store: Path, block: int, rng: np.random.Generator) -> bool:
    """Run the sweep on a cluster and kill a worker; return whether one was killed before the end."""
    import distributed

    killed = False
    with (
        distributed.LocalCluster(n_workers=2, threads_per_worker=1, processes=True, dashboard_address=None) as cluster,
        distributed.Client(cluster) as client,
    ):
        client.wait_for_workers(2)
        after = rng.uniform(0, 0.9)

        def kill(done: int, total: int) -> None:
            nonlocal killed
            if not killed and done > after * total:
                time.sleep(rng.uniform(0, 0.02))
                os.kill(rng.choice(list(client.run(os.getpid).values())), signal.SIGKILL)
                killed = True

        carom.sweep(space(), KEEP, store=store, block=block).run(on=client, progress=kill)
    return killed


def fill_disk(store: Path, block: int, rng: np.random.Generator) -> bool:
    """Run the sweep where a write fails; return whether it ended with one clear line."""
    from zarr.storage import _local

    whole, left = _local._put, int(rng.integers(0, 200))

    def full(path: Path, value: object, exclusive: bool = False) -> int:
        nonlocal left
        left -= 1
        if left < 0:
            raise OSError(28, "No space left on device")
        return whole(path, value, exclusive)  # type: ignore[arg-type]

    _local._put = full
    try:
        carom.sweep(space(), KEEP, store=store, block=block).run()
    except carom.CaromError as error:
        return len(error.faults) == 1 and "No space left on device" in str(error)
    finally:
        _local._put = whole
    return False


def report(
    run: Campaign, kind: str, disturb: Callable[[Path, int, np.random.Generator], bool], whole: dict[str, str]
) -> bool:
    """Disturb sweeps of a kind; print how many ended otherwise."""
    rng, block = np.random.default_rng(KINDS.index(kind)), FEW if run.small else BLOCK
    disturbed = finished = otherwise = 0
    with tempfile.TemporaryDirectory(prefix="carom-sweep-") as folder:
        store = Path(folder) / "s.zarr"
        while disturbed < run.count:
            disturbed += disturb(store, block, rng)
            made = carom.sweep(space(), KEEP, store=store, block=block)
            if rng.random() < 0.3 or not made.missing() or disturbed == run.count:
                made.run()
                finished += 1
                otherwise += clean(store) != whole
                shutil.rmtree(store)
    run.say(f"{kind}: {disturbed} disturbances of {finished} sweeps: {otherwise} stores ended otherwise")
    return otherwise == 0


def main(words: Sequence[str] | None = None) -> int:
    """A line for each kind; 1 if a store ended otherwise."""
    kinds = {"driver": kill_driver, "worker": kill_worker, "disk": fill_disk}
    with campaign("sweep_kills", __doc__, words, count=100, small=1) as run, tempfile.TemporaryDirectory() as folder:
        carom.sweep(space(), KEEP, store=Path(folder) / "s.zarr", block=FEW if run.small else BLOCK).run()
        whole = clean(Path(folder) / "s.zarr")
        good = [
            report(run, kind, disturb, whole)
            for kind, disturb in kinds.items()
            if run.wants(kind, ["driver"] if run.small else kinds)
        ]
    return int(not all(good))


if __name__ == "__main__":
    raise SystemExit(main())
