"""Sweeps on a real Dask cluster of processes: the same bits, with workers that die, and with nobody there."""

from __future__ import annotations

import os
import signal
import time
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from reference.sweep_scenes import KEEP, files_of, space

import carom

dask = pytest.importorskip("dask")
distributed = pytest.importorskip("distributed")
pytestmark = pytest.mark.filterwarnings("ignore")  # (Dask's own, of sockets that dying workers leave)


@pytest.fixture
def cluster() -> Iterator[Any]:
    # all workers, also those that follow a dead one, are forked from one process that has imported what they need
    with dask.config.set({"distributed.worker.multiprocessing-method": "forkserver"}):
        distributed.utils.get_mp_context().set_forkserver_preload(
            ["distributed.nanny", "distributed.worker", "carom.sweeps.sweep", "carom.sweeps.shots", "xarray", "zarr"]
        )
        with (
            distributed.LocalCluster(n_workers=2, threads_per_worker=1, processes=True, dashboard_address=None) as made,
            distributed.Client(made) as client,
        ):
            client.wait_for_workers(2)
            yield client


@pytest.mark.slow
def test_a_cluster_gives_the_same_bits_though_workers_die_and_connections_are_lost(
    cluster: Any, tmp_path: Path
) -> None:
    carom.sweep(space(), KEEP, store=tmp_path / "whole.zarr", block=4).run()
    made = carom.sweep(space(), KEEP, store=tmp_path / "cluster.zarr", block=4)
    killed: list[int] = []

    def kill(done: int, total: int) -> None:
        if len(killed) < 2 and done > total * (1 + len(killed)) / 4:
            # (from those who started them: a worker that has just died answers nobody)
            workers = [one.pid for one in cluster.cluster.workers.values() if one.pid not in (None, *killed)]
            killed.append(workers[0])
            os.kill(workers[0], signal.SIGKILL)

    made.run(on=cluster, progress=kill)
    assert len(killed) == 2
    for part in (tmp_path / "cluster.zarr").rglob("*.partial"):
        part.unlink()
    assert files_of(tmp_path / "cluster.zarr") == files_of(tmp_path / "whole.zarr")

    # the whole cluster goes: nothing that was stored is lost
    lost = carom.sweep(space(), KEEP, store=tmp_path / "lost.zarr", block=4)

    def stop(done: int, total: int) -> None:
        if done > total / 4:
            cluster.cluster.close(timeout=5)

    with pytest.raises(carom.CaromError, match="run it again to go on"):
        lost.run(on=cluster.cluster.scheduler_address, progress=stop)
    assert 0 < len(lost.missing()) < lost.blocks.number
    lost.run()
    assert files_of(tmp_path / "lost.zarr") == files_of(tmp_path / "whole.zarr")


def test_nobody_answers(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("carom.sweeps.store.CONNECT_SECONDS", 1)
    made = carom.sweep(space(), KEEP, store=tmp_path / "s.zarr", block=40)
    begin = time.monotonic()
    with pytest.raises(carom.CaromError, match="expected a Dask scheduler that answers at tcp://127"):
        made.run(on="tcp://127.0.0.1:9")
    assert time.monotonic() - begin < 15
    with pytest.raises(carom.CaromError, match="expected 'cores', the address of a Dask scheduler"):
        made.run(on="elsewhere")
    with pytest.raises(carom.CaromError, match="expected a store for a run on"):
        carom.sweep(space(), KEEP).run(on="tcp://127.0.0.1:9")


@pytest.mark.slow
def test_a_cluster_without_workers_is_given_up(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """It was waited for, for ever; what was done stays."""
    monkeypatch.setattr("carom.sweeps.store.ALONE_SECONDS", 0.2)
    monkeypatch.setattr("carom.sweeps.store.ASK_SECONDS", 0.1)
    made = carom.sweep(space(), KEEP, store=tmp_path / "s.zarr", block=4)
    with (
        distributed.LocalCluster(n_workers=1, threads_per_worker=1, processes=False, dashboard_address=None) as one,
        distributed.Client(one) as client,
        pytest.raises(carom.CaromError, match=r"expected a worker, got none for 0\.2 s after [1-9]"),
    ):
        made.run(on=client, progress=lambda done, _total: one.scale(0) if done else None)
    assert 0 < len(made.missing()) < made.blocks.number
    made.run()
    assert not made.missing()
