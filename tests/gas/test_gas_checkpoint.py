"""Checkpoints: the same bits on, whole or as before, and no other file taken for one."""

from __future__ import annotations

import errno
import json
import math
import os
import pickle
import re
import resource
import signal
from contextlib import contextmanager
from pathlib import Path

import numpy as np
import pytest
from reference.exploring import tried
from reference.gases import MIXED, ROUGH

from carom import CaromError
from carom.gas import files as checkpoint
from carom.gas.files import load_checkpoint, save_checkpoint
from carom.gas.scene import GasScene, load_gas
from carom.gas.session import Session


def scene_of(folder: Path, text: str):
    path = folder / "gas.toml"
    path.write_text(text)
    return load_gas(path)


def stops(at: list[int]):
    """Says stop at these calls."""
    calls = 0

    def stop() -> bool:
        nonlocal calls
        calls += 1
        return calls in at

    return stop


def after(session: Session, collisions: int):
    """Says stop after so many collisions, however often it is asked."""
    begin = session.gas.collisions
    return lambda: session.gas.collisions >= begin + collisions


def measured(session: Session):
    return {name: value for name, value in session.result.to_dict().items() if name != "cpu_seconds"}


def bits(session: Session):
    """All of a session's state but the processor's time."""
    state = session.state()
    state["mark.numbers"] = state["mark.numbers"][:-1]
    return {name: array.tobytes() for name, array in state.items()}


@pytest.mark.parametrize("text", [ROUGH, MIXED], ids=["rough", "mixed"])
@pytest.mark.parametrize("every", [None, 700, 3.0])
@pytest.mark.slow(keep=1)
def test_a_run_in_pieces_has_the_same_bits(tmp_path, text, every):
    scene = scene_of(tmp_path, text)
    shots: list[tuple[float, int]] = []
    parts: list[tuple[float, int]] = []

    def taking(into):
        return None if every is None else lambda now: into.append((now.gas.time, now.gas.collisions))

    whole = Session(scene)
    assert whole.run(every=every, snapshot=taking(shots))
    session, pieces, piece = Session(scene), 0, whole.gas.collisions // 10
    while not session.run(stop=after(session, piece), every=every, snapshot=taking(parts)):
        pieces += 1
        save_checkpoint(session, tmp_path / "c.npz")
        session = load_checkpoint(tmp_path / "c.npz", scene)
    assert pieces > 5
    assert measured(session) == measured(whole)
    assert bits(session) == bits(whole)
    assert parts == shots
    if every is not None:
        assert len(shots) == session.snapshots_taken >= 6


def test_when_snapshots_are_taken_leaves_no_trace(tmp_path):
    scene = scene_of(tmp_path, MIXED)
    plain, often = Session(scene), Session(scene)
    plain.run()
    times: list[float] = []
    often.run(every=0.25, snapshot=lambda now: times.append(now.gas.time))
    assert times == pytest.approx(0.25 * np.arange(81), abs=1e-12)
    assert measured(often) == measured(plain)
    assert often.gas.balls().velocity.tobytes() == plain.gas.balls().velocity.tobytes()


def test_a_finished_run_goes_on_for_longer(tmp_path):
    short, long = scene_of(tmp_path, ROUGH.replace("60_000", "30_000")), scene_of(tmp_path, ROUGH)
    session = Session(short)
    session.run()
    save_checkpoint(session, tmp_path / "c.npz")
    again = load_checkpoint(tmp_path / "c.npz", long)
    assert not again.finished
    again.run()
    whole = Session(long)
    whole.run()
    assert measured(again) == measured(whole)
    assert again.measures.samples > whole.measures.samples  # at the intervals of the shorter run
    assert again.gas.balls().position.tobytes() == whole.gas.balls().position.tobytes()
    assert load_checkpoint(tmp_path / "c.npz").scene == short
    assert load_checkpoint(tmp_path / "c.npz").finished


# --- what is none --------------------------------------------------------------------------------------------------


@pytest.fixture
def kept(tmp_path) -> Path:
    session = Session(scene_of(tmp_path, ROUGH))
    session.run(stop=after(session, 10_000))
    save_checkpoint(session, tmp_path / "c.npz")
    return tmp_path / "c.npz"


def refused(path: Path, scene=None) -> str:
    with pytest.raises(CaromError) as found:
        load_checkpoint(path, scene)
    (line,) = found.value.faults
    assert line.startswith(f"{path}: expected ")
    return line


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        ("radius = 0.5", "radius = 0.4", "its species[0].radius is 0.5, not 0.4"),
        ("seed = 1", "seed = 2", "its run.seed is 1, not 2"),
        ("equilibrate = 5_000", "equilibrate = 6_000", "its run.equilibrate is 5000, not 6000"),
        ("friction = inf", "friction = 7", "its contacts[0].friction is inf, not 7.0"),
        ('"periodic"', '"box"\nperiodic = ["x", "y", "z"]', "its container.periodic is [], not ['x', 'y', 'z']"),
    ],
)
def test_another_scene(tmp_path, kept, old, new, said):
    line = refused(kept, scene_of(tmp_path, ROUGH.replace(old, new)))
    assert f"expected a checkpoint of this scene, got one of another scene: {said}; only run.max_events" in line


@pytest.mark.parametrize(
    ("run", "said"),
    [
        ("max_events = 5_000", "a run.max_events of at least 60,000, as in the checkpoint, got 5,000"),
        ("max_events = 60_000\nduration = 2.5", "no run.duration, as in the checkpoint, got 2.5"),
    ],
)
def test_a_run_cannot_become_shorter(tmp_path, kept, run, said):
    line = refused(kept, scene_of(tmp_path, ROUGH.replace("max_events = 60_000", run)))
    assert line == f"{kept}: expected {said}; a run can only be continued for longer"


def test_files_that_are_no_checkpoint(tmp_path, kept):
    assert "expected a checkpoint, got: No such file or directory" in refused(tmp_path / "none.npz")
    other = tmp_path / "other.npz"
    np.savez(other, position=np.zeros((3, 3)))
    assert "got another file" in refused(other)
    np.save(tmp_path / "array.npy", np.zeros(3))
    assert "got another file" in refused(tmp_path / "array.npy")
    for text in (b"", b"[container]\n", b"PK\x03\x04 and nothing"):
        other.write_bytes(text)
        assert "got a file that cannot be read" in refused(other)
    whole = kept.read_bytes()
    for share in (0.1, 0.5, 0.9, 0.999):
        other.write_bytes(whole[: int(len(whole) * share)])
        assert "got a file that cannot be read" in refused(other)


def test_a_changed_bit_is_noticed_or_changes_nothing(tmp_path, kept):
    whole, before = kept.read_bytes(), bits(load_checkpoint(kept))
    other = tmp_path / "changed.npz"
    noticed = 0
    for place in range(100, len(whole), len(whole) // 60):
        changed = bytearray(whole)
        changed[place] ^= 1
        other.write_bytes(changed)
        try:
            session = load_checkpoint(other)
        except CaromError as error:
            noticed += "got a file that cannot be read" in str(error)
        else:  # a date in the archive, say
            assert bits(session) == before
    assert noticed > 50


def test_checkpoints_of_a_later_carom(tmp_path, kept):
    with np.load(kept) as file:
        arrays = dict(file)
    about = json.loads(str(arrays.pop("carom_checkpoint")))
    later = tmp_path / "later.npz"
    np.savez(later, carom_checkpoint=np.array(json.dumps(about | {"format": 99, "carom": "9.9"})), **arrays)
    assert "expected a checkpoint of format 7, got format 99 of carom 9.9; continue with that version" in refused(later)
    np.savez(later, carom_checkpoint=np.array(json.dumps(about)), **arrays)
    told = []
    load_checkpoint(later, compiling=lambda: told.append("now"))
    assert told == ["now"]
    # what is missing is told of before anything is compiled
    for name in ("gas.plans", "gas.time", "session", "clock"):
        part = {key: array for key, array in arrays.items() if key != name}
        np.savez(later, carom_checkpoint=np.array(json.dumps(about)), **part)
        with pytest.raises(CaromError, match="expected a checkpoint that this carom can continue"):
            load_checkpoint(later, compiling=lambda: told.append("too early"))
    other = arrays | {"gas.bodies": np.zeros(len(arrays["gas.bodies"]))}
    np.savez(later, carom_checkpoint=np.array(json.dumps(about)), **other)
    with pytest.raises(CaromError, match="other records of 'bodies'"):
        load_checkpoint(later, compiling=lambda: told.append("too early"))
    assert told == ["now"]


@pytest.mark.parametrize(
    ("about", "said"),
    [
        ({"format": 3}, "expected a checkpoint of format 7, got format 3 of carom of an unknown version"),
        ({"format": 3, "carom": None, "scene": 5}, "expected a checkpoint of format 7, got format 3"),
        ({"format": 7}, "got a file that cannot be read (it holds no scene)"),
        ({"format": 7, "scene": []}, "got a file that cannot be read (it holds no scene)"),
        ({"format": 7, "scene": {}, "outputs": [1]}, "got a file that cannot be read (it holds no scene)"),
        ({"format": 7, "scene": {}}, "container: "),
        ({"format": True, "scene": {}}, "got a file that cannot be read (it does not say its format)"),
        ({"format": "7"}, "got a file that cannot be read (it does not say its format)"),
        ([], "got a file that cannot be read (it does not say its format)"),
        (None, "got a file that cannot be read (it does not say its format)"),
    ],
)
def test_a_stub_of_a_checkpoint(tmp_path, about, said):
    """A file that says a format and nothing else ended in a KeyError."""
    stub = tmp_path / "stub.npz"
    np.savez(stub, carom_checkpoint=np.array(json.dumps(about)))
    with pytest.raises(CaromError) as caught:
        load_checkpoint(stub)
    assert caught.value.faults[0].startswith(str(stub))
    assert said in str(caught.value)


def _spoiled(array: np.ndarray, how: str) -> np.ndarray:
    """An array with another type, another shape, or a NaN, or numbers out of range; itself where it cannot have that."""
    if how == "type":
        return (
            array.astype("f4") if array.dtype.names is None and array.dtype.kind == "f" else np.zeros(array.shape, "i2")
        )
    if how == "longer":
        return np.concatenate([array.ravel(), array.ravel()[:1]]) if array.size else np.zeros(1, array.dtype)
    if how == "flat":
        return array.reshape(*array.shape, 1)
    array = array.copy()
    if how == "nan":
        if array.dtype.names is not None:
            name = next(name for name in array.dtype.names if array.dtype[name].base.kind == "f")
            array[name] = np.nan
        elif array.dtype.kind == "f":
            array[...] = np.nan
    elif array.dtype.names is not None:  # "wild"
        for name in array.dtype.names:
            if array.dtype[name].base.kind in "iu":
                array[name] = 2**31 - 7
    return array


@pytest.mark.parametrize("how", ["type", "longer", "flat", "nan", "wild"])
@pytest.mark.parametrize("text", tried([MIXED], [ROUGH, MIXED]))
@pytest.mark.slow(keep=1)
def test_an_array_that_is_another(tmp_path, text, how):
    """One array of a checkpoint has another type, shape or content: refused in one line, and no compiled loop sees it."""
    session = Session(scene_of(tmp_path, text))
    session.run(stop=stops([4]))
    save_checkpoint(session, tmp_path / "c.npz")
    with np.load(tmp_path / "c.npz") as file:
        arrays = dict(file)
    assert any(name.startswith("measures.") for name in arrays)
    spoiled = {name: _spoiled(array, how) for name, array in arrays.items() if name != "carom_checkpoint"}
    if how == "wild":  # (counts so far may be any number)
        spoiled = {f"gas.{name}": spoiled[f"gas.{name}"] for name in ("system", "motions", "plans")}
    count = 0
    for name, array in spoiled.items():
        if (
            array.dtype == arrays[name].dtype
            and array.tobytes() == arrays[name].tobytes()
            and array.shape == arrays[name].shape
        ):
            continue
        np.savez(tmp_path / "other.npz", **arrays | {name: array})
        assert "expected a checkpoint that this carom can continue" in refused(tmp_path / "other.npz"), name
        count += 1
    assert count >= 3


def test_numpys_advice_to_load_unsafely_is_not_passed_on(tmp_path, kept):
    with np.load(kept) as file:
        arrays = dict(file)
    objects = tmp_path / "objects.npz"
    np.savez(objects, allow_pickle=True, **arrays | {"clock": np.array([None, {}, print], dtype=object)})
    pickled = tmp_path / "pickled.npz"
    pickled.write_bytes(pickle.dumps({"scene": 1}))
    for path in (objects, pickled):
        line = refused(path)
        assert "got a file that cannot be read (not a file of NumPy)" in line
        assert not re.search("pickle|unsafe", line.replace("pickled.npz", ""))


# --- a full disk ---------------------------------------------------------------------------------------------------


@contextmanager
def no_file_larger_than(size: int):
    """The kernel refuses to write more than this to a file: it says EFBIG where a full disk says ENOSPC."""
    soft, hard = resource.getrlimit(resource.RLIMIT_FSIZE)
    before = signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
    resource.setrlimit(resource.RLIMIT_FSIZE, (size, hard))
    try:
        yield
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, (soft, hard))
        signal.signal(signal.SIGXFSZ, before)


def test_a_full_disk_leaves_the_checkpoint_before(kept):
    before = kept.read_bytes()
    session = load_checkpoint(kept)
    session.run(stop=after(session, 1))
    for size in (0, 1000, len(before) // 2, len(before) - 100):
        with no_file_larger_than(size), pytest.raises(CaromError) as found:
            save_checkpoint(session, kept)
        (line,) = found.value.faults
        assert line == (
            f"{kept}: expected room to write, got: {os.strerror(errno.EFBIG)}; free some space, or choose another place"
        )
        assert kept.read_bytes() == before
        assert sorted(path.name for path in kept.parent.iterdir()) == ["c.npz", "gas.toml"]
    save_checkpoint(session, kept)
    assert kept.read_bytes() != before


def test_a_disk_that_fails_at_the_last_moment(kept, monkeypatch):
    before = kept.read_bytes()

    def full(_handle):
        raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))

    monkeypatch.setattr(checkpoint.os, "fsync", full)
    with pytest.raises(CaromError, match="expected room to write, got: No space left on device"):
        save_checkpoint(load_checkpoint(kept), kept)
    assert kept.read_bytes() == before
    assert sorted(path.name for path in kept.parent.iterdir()) == ["c.npz", "gas.toml"]


def test_a_cooling_gas_is_run_in_few_pieces(tmp_path: Path) -> None:
    """Its collisions come ever more rarely: pieces of one length of time would each have fewer, without end."""
    text = ROUGH.replace("restitution = 1.0\nfriction", "restitution = 0.6\nfriction").replace(
        "count = 200", "count = 30"
    )
    scene = scene_of(tmp_path, text.replace("equilibrate = 5_000", "equilibrate = 0"))
    pieces: list[int] = []
    session = Session(
        scene.model_copy(update={"run": scene.run.model_copy(update={"max_events": 6000, "duration": None})})
    )
    assert session.run(progress=lambda *_: pieces.append(session.done))
    assert session.done == 6000
    assert session.gas.time > 1e6
    assert len(pieces) < 250


@pytest.mark.parametrize(
    ("array", "field", "place"),
    [("gas.system", "pair_collisions", 0), ("gas.system", "wall_collisions", 0), ("gas.pairs", "collisions", 0),
     ("gas.motions", "collisions", 3), ("session", None, 0), ("session", None, 1)],
)  # fmt: skip
def test_counts_that_disagree_are_refused(tmp_path, array, field, place):
    """A checkpoint that said it had had 2^31 collisions ran on without end."""
    scene = scene_of(tmp_path, MIXED)
    session = Session(scene)
    session.run(stop=stops([3]))
    state = {name: values.copy() for name, values in session.state().items()}
    (state[array] if field is None else state[array][field])[place] += 2**31
    with pytest.raises(ValueError, match="contents that no gas of this scene has"):
        Session.restore(scene, state)


def test_a_gas_kept_warm_is_resumed(tmp_path):
    # (a kick of the thermostat counts as a collision of its ball)
    contact = {"between": ("a", "a"), "restitution": 0.9, "friction": 0.3}
    scene = GasScene(
        container={"shape": "periodic", "size": (6, 6, 6)}, species=[{"count": 64, "radius": 0.5}], contacts=[contact],
        thermostat={"temperature": 1.0, "rate": 0.5}, run={"equilibrate": 100, "max_events": 400},
    )  # fmt: skip
    session = Session(scene)
    session.run()
    assert session.gas.arrays.system[0]["kicks"] > 0
    save_checkpoint(session, tmp_path / "warm.npz")
    assert load_checkpoint(tmp_path / "warm.npz").gas.time == session.gas.time


@pytest.mark.parametrize("value", [math.inf, -1e300])
@pytest.mark.slow
def test_no_number_of_a_checkpoint_is_out_of_bounds(tmp_path, value):
    """Infinite times and frictions below 0 went on, with NaN in positions; what a scene says has to be the scene's."""
    scene = scene_of(tmp_path, MIXED)
    session = Session(scene)
    session.run(stop=stops([4]))
    state, taken = session.state(), []
    for name, array in state.items():
        for field in array.dtype.names or ("",):
            if (array[field] if field else array).dtype.kind != "f" or not array.size:
                continue
            spoiled = array.copy()
            (spoiled[field] if field else spoiled).flat[0] = value
            if spoiled.tobytes() == array.tobytes():
                continue
            try:
                Session.restore(scene, state | {name: spoiled}).gas.advance(300)
            except (ValueError, CaromError):
                continue
            taken.append(f"{name}.{field}")
    # (sums over events may have any finite size; last contacts and overlaps begin at minus infinity)
    summed = (
        "gas.pairs.",
        "gas.contacts.",
        "gas.faces.",
        "gas.whole.",
        "gas.flows.",
        "gas.layers.",
        "mark.",
        "measures.",
    )
    assert {one for one in taken if value == math.inf or not one.startswith(summed)} <= {
        "clock.", "gas.bodies.last_contact", "gas.plans.collision_time", "gas.plans.event_time", "gas.system.overlap",
        "gas.faces.stop", "gas.system.thermostat_energy", "mark.system.overlap",
    }  # fmt: skip
