"""Stores of sweeps: killed and resumed, bit for bit; what is another's is refused; what is damaged is found."""

from __future__ import annotations

import functools
import json
import signal
import sys
from pathlib import Path

import numpy as np
import pytest
import xarray
from reference.exploring import tried
from reference.forking import Forked
from reference.sweep_scenes import KEEP, files_of, space, table_scene

import carom
from carom import sweeps
from carom.sweeps.store import Blocks, blocks_of


@pytest.mark.parametrize("shape", [(), (1,), (7,), (3, 5), (4, 3, 5), (2, 3, 4, 5)])
@pytest.mark.parametrize("points", [1, 2, 7, 16, 1000])
def test_blocks_cover_every_point_once_in_order(shape: tuple[int, ...], points: int) -> None:
    blocks = blocks_of(shape, points)
    index = np.arange(int(np.prod(shape))).reshape(shape)
    seen = []
    for block in range(blocks.number):
        first, stop = blocks.points(block)
        assert stop - first <= max(points, 1)
        assert np.array_equal(index[blocks.region(block)].ravel(), np.arange(first, stop))
        seen += list(range(first, stop))
    assert seen == list(range(index.size))
    assert isinstance(blocks, Blocks)


def test_a_store_holds_what_memory_holds(tmp_path: Path) -> None:
    memory = carom.sweep(space(), KEEP).run()
    stored = carom.sweep(space(), KEEP, store=tmp_path / "s.zarr", block=50).run()
    xarray.testing.assert_equal(memory.drop_attrs(), stored.drop_attrs()[list(memory.data_vars)].load())
    assert stored["final.position"].attrs["units"] == "m"
    assert stored["speed"].attrs == {"path": "balls.0.velocity.speed", "units": "m/s"}
    assert stored["final.phase"].attrs["flag_meanings"][4] == "rest"
    assert set(stored.attrs) >= {"identity", "sources", "seed", "carom_version", "specification"}
    # and without carom: any program that reads Zarr
    plain = xarray.open_zarr(tmp_path / "s.zarr", consolidated=False, mask_and_scale=False)
    assert np.array_equal(plain["final.position"].values, memory["final.position"].values)
    assert np.array_equal(plain["angle"].values, memory["angle"].values)


def test_names_as_coordinates(tmp_path: Path) -> None:
    parameters = {"run.law": ["two-step", "mirror"], "floor.friction": [0.2]}
    found = carom.sweep(carom.Space(table_scene(), parameters), ["final.position"], store=tmp_path / "s.zarr").run()
    assert found["law"].values.tolist() == ["two-step", "mirror"]
    assert found["final.position"].sel(law="mirror", ball="white", axis="x").ndim == 0
    again = carom.sweep(tmp_path / "s.zarr")
    assert again.space.size == 2
    assert again.missing() == []


def test_parts_of_an_array_of_jobs_make_the_whole(tmp_path: Path) -> None:
    carom.sweep(space(), KEEP, store=tmp_path / "whole.zarr", block=30).run()
    for part in (3, 1, 2):
        made = carom.sweep(space(), KEEP, store=tmp_path / "parts.zarr", block=30)
        before = len(made.missing())
        made.run(part=(part, 3))
        assert len(made.missing()) < before
    assert files_of(tmp_path / "parts.zarr") == files_of(tmp_path / "whole.zarr")
    assert carom.sweep(tmp_path / "parts.zarr").status() == {
        "points": 320, "points_done": 320, "blocks": made.blocks.number, "blocks_done": made.blocks.number, "failed": {},
    }  # fmt: skip


PROGRAM = """
import os, signal, sys, threading
sys.path[:0] = PATHS
import carom
from reference.sweep_scenes import KEEP, space
left = BLOCKS
def tell(done, total):
    global left
    left -= 1
    if left == 0:
        threading.Timer(SECONDS, os.kill, (os.getpid(), signal.SIGKILL)).start()
carom.sweep(space(), KEEP, store=STORE, block=8).run(progress=tell)
"""


@pytest.mark.slow
def test_killed_and_gone_on_with(tmp_path: Path, forked: Forked) -> None:
    carom.sweep(space(), KEEP, store=tmp_path / "whole.zarr", block=8).run()
    store = tmp_path / "killed.zarr"
    for kill in tried((0, 2), (0, 1, 2)):
        words = {
            "PATHS": [str(Path(__file__).parents[1])], "STORE": str(store),
            "BLOCKS": 3 + 4 * kill, "SECONDS": 0.003 * kill,
        }  # fmt: skip
        program = functools.reduce(lambda text, name: text.replace(name, repr(words[name])), words, PROGRAM)
        assert forked(tmp_path, "-c", program)[0] == -signal.SIGKILL
    made = carom.sweep(store)
    assert 0 < len(made.missing()) < made.blocks.number
    made.run()
    for part in store.rglob("*.partial"):  # (of a file that was being written when the process was killed)
        part.unlink()
    assert files_of(store) == files_of(tmp_path / "whole.zarr")
    assert made.verify(5) == []


@pytest.mark.slow
def test_a_store_whose_making_was_killed_is_made_again(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    from zarr.storage import _local

    small = carom.Space(sweeps.ImpactCase(), {"angle": [10.0, 20.0], "law": ["mirror", "two-step"]})
    whole, count = _local._put, 0

    def counted(path: Path, value: object, exclusive: bool = False) -> int:
        nonlocal count
        count += 1
        if count > most:
            raise RuntimeError("killed")
        return whole(path, value, exclusive)  # type: ignore[arg-type]

    monkeypatch.setattr(_local, "_put", counted)
    most = 1000
    carom.sweep(small, ["reflection_angle", "final.velocity"], store=tmp_path / "whole.zarr").run()
    writes = count
    assert writes > 15
    for most in range(writes):
        store, count = tmp_path / f"{most}.zarr", 0
        with pytest.raises(RuntimeError, match="killed"):
            carom.sweep(small, ["reflection_angle", "final.velocity"], store=store).run()
        count = -1000
        carom.sweep(small, ["reflection_angle", "final.velocity"], store=store).run()
        assert files_of(store) == files_of(tmp_path / "whole.zarr"), most


def test_a_store_of_another_sweep_is_refused(tmp_path: Path) -> None:
    carom.sweep(space(), KEEP, store=tmp_path / "s.zarr", block=100).run()
    before = files_of(tmp_path / "s.zarr")
    other = carom.Space(table_scene(duration=2.0), {"floor.friction": [0.1]}, seed=5)
    for made, differs in (
        (carom.sweep(other, KEEP, store=tmp_path / "s.zarr", block=100), "parameters, block"),
        (carom.sweep(space(), ["final.spin"], store=tmp_path / "s.zarr", block=100), "keep, dtypes"),
    ):
        with pytest.raises(
            carom.CaromError, match=f"got the store of another, which differs in {differs}; name a new store"
        ):
            made.run()
    assert files_of(tmp_path / "s.zarr") == before


def test_a_store_that_was_computed_by_other_code_is_refused(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    carom.sweep(space(), KEEP, store=tmp_path / "s.zarr", block=100).run()
    monkeypatch.setattr(sys.modules["carom.sweeps.sweep"], "source_hash", lambda: "0123456789abcdef")
    with pytest.raises(carom.CaromError, match="got one computed by other code"):
        carom.sweep(tmp_path / "s.zarr").run()


@pytest.mark.parametrize("what", ["file", "folder", "group", "nothing"])
def test_what_is_no_store_is_refused(tmp_path: Path, what: str) -> None:
    import zarr

    place = tmp_path / "s.zarr"
    if what == "file":
        place.write_text("text")
    elif what == "folder":
        place.mkdir()
        (place / "mine.txt").write_text("text")
    elif what == "group":
        zarr.create_group(place)
    with pytest.raises(carom.CaromError, match="expected a store of a sweep, "):
        carom.sweep(place)
    if what != "nothing":
        with pytest.raises(carom.CaromError, match="name a new one"):
            carom.sweep(space(), KEEP, store=place).run()
    if what == "folder":
        assert [path.name for path in place.iterdir()] == ["mine.txt"]


def test_damage_is_found(tmp_path: Path) -> None:
    made = carom.sweep(space(), KEEP, store=tmp_path / "s.zarr", block=40)
    made.run()
    assert made.verify(2) == []
    import zarr

    group = zarr.open_group(tmp_path / "s.zarr", mode="r+")
    region = made.blocks.region(3)
    group["events.wall.count"][region] = group["events.wall.count"][region] + 1
    assert made.verify(0) == [3]
    # a block with the right checksum of wrong numbers is found by computing it again
    values = {one.name: made.store.read(one.name, region) for one in made.outcomes}
    values["failed"] = made.store.read("failed", region)
    flat = {name: array.reshape(-1, *array.shape[len(made.space.shape) :]) for name, array in values.items()}
    made.store.write(3, made.blocks, made.outcomes, flat)
    assert made.verify(0) == []
    assert made.verify(made.blocks.number) == [3]


@pytest.mark.parametrize(
    ("name", "value"), [("failed", 100), ("failed", -3), ("final.phase", 99), ("events.wall.count", -2)]
)
@pytest.mark.slow(keep=1)
def test_numbers_that_cannot_be_are_found_behind_a_right_checksum(tmp_path: Path, name: str, value: int) -> None:
    made = carom.sweep(space(), [*KEEP, "final.phase"], store=tmp_path / "s.zarr", block=40)
    made.run()
    region = made.blocks.region(1)
    values = {one: made.store.read(one, region) for one in (*(one.name for one in made.outcomes), "failed")}
    values[name].flat[0] = value
    flat = {name: array.reshape(-1, *array.shape[len(made.space.shape) :]) for name, array in values.items()}
    made.store.write(1, made.blocks, made.outcomes, flat)
    assert made.verify(0) == [1]
    for look in (carom.sweep(tmp_path / "s.zarr").run, *([made.status] if name == "failed" else [])):
        with pytest.raises(carom.CaromError, match=f"expected {name} from -1 to .*, got {value}"):
            look()


def test_a_full_disk_is_one_line_and_loses_nothing(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    made = carom.sweep(space(), KEEP, store=tmp_path / "s.zarr", block=40)
    from zarr.storage import _local

    whole, count = _local._put, 0

    def full(path: Path, value: object, exclusive: bool = False) -> int:
        nonlocal count
        count += "c" in path.parts
        if count > 30:
            raise OSError(28, "No space left on device")
        return whole(path, value, exclusive)  # type: ignore[arg-type]

    monkeypatch.setattr(_local, "_put", full)
    with pytest.raises(carom.CaromError, match="No space left on device; blocks that are done stay") as caught:
        made.run()
    assert len(caught.value.faults) == 1
    monkeypatch.undo()
    again = carom.sweep(tmp_path / "s.zarr")
    assert 0 < len(again.missing()) < again.blocks.number
    again.run()
    carom.sweep(space(), KEEP, store=tmp_path / "whole.zarr", block=40).run()
    assert files_of(tmp_path / "s.zarr") == files_of(tmp_path / "whole.zarr")


def test_sweeps_of_impacts_orbits_and_gases_are_taken_up(tmp_path: Path) -> None:
    case = sweeps.ImpactCase(friction=float("inf"))
    carom.sweep(carom.Space(case, {"angle": [10.0, 20.0]}), ["reflection_angle"], store=tmp_path / "i.zarr").run()
    assert carom.sweep(tmp_path / "i.zarr").missing() == []
    orbit = sweeps.OrbitCase(table="stadium", bounces=50)
    carom.sweep(carom.Space(orbit, {"table.straight": [0.5, 1.0]}), ["time"], store=tmp_path / "o.zarr").run()
    assert carom.sweep(tmp_path / "o.zarr").verify(2) == []


@pytest.mark.parametrize(
    "part", ["subject", "parameters", "repeats", "seed", "keep", "block", "complete", "all but identity"]
)
def test_a_stub_of_a_store(tmp_path: Path, part: str) -> None:
    """Attributes that are missing, or of another kind: one line, or the sweep is taken up; a missing word ended in a KeyError."""
    store = tmp_path / "s.zarr"
    carom.sweep(
        carom.Space(table_scene(duration=0.1), {"floor.friction": [0.1, 0.2]}), ["final.time"], store=store
    ).run()
    file = store / "zarr.json"
    whole = json.loads(file.read_text())
    about = whole["attributes"]["carom"]
    kinds = ("missing", [], 7, "x", None, {}, [[1], 0, 1]) if part in about else ("missing",)
    taken_up = 0
    for value in kinds:
        changed = {name: one for name, one in about.items() if name != part} if part in about else {"identity": "x"}
        if value != "missing":
            changed[part] = value
        whole["attributes"]["carom"] = changed
        file.write_text(json.dumps(whole))
        try:
            carom.sweep(store).status()
        except carom.CaromError as error:
            unclear = [fault for fault in error.faults if "fit its documentation" in fault]
            assert unclear == []
        else:
            taken_up += 1
    assert taken_up <= (len(kinds) if part == "complete" else 2)
