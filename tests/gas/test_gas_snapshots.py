"""Snapshots read back with the library that HOOMD, freud and OVITO's file format come from."""

from __future__ import annotations

import math
import os
import stat
from pathlib import Path
from types import SimpleNamespace

import gsd.hoomd
import numpy as np
import pytest
from reference.gases import MIXED, ROUGH
from typer.testing import CliRunner

from carom import CaromError
from carom.cli import app
from carom.gas import GasScene, Session, gas_text
from carom.gas.results import LogTimes
from carom.gas.scene import load_gas
from carom.gas.session import build
from carom.gas.snapshots import (
    Snapshots,
    expected_snapshots,
    mean_free_time,
    read_initial_state,
    require_size,
    spins_of,
)


@pytest.fixture(params=["rough", "mixed"])
def gas(request, tmp_path):
    (tmp_path / "gas.toml").write_text(ROUGH if request.param == "rough" else MIXED)
    scene = load_gas(tmp_path / "gas.toml")
    return build(scene), tuple(one.name for one in scene.species)


def test_a_frame_says_what_the_gas_is(gas, tmp_path):
    gas, names = gas
    file = Snapshots(tmp_path / "s.gsd", names)
    file.write(gas)
    gas.run(3000)
    file.write(gas)
    file.close()
    balls, one = gas.balls(), gas.arrays.system[0]
    kinds = gas.arrays.materials.species[balls.species]
    with gsd.hoomd.open(str(tmp_path / "s.gsd")) as frames:
        assert len(frames) == 2
        frame = frames[1]
    axes = 3 if len(names) == 1 else 2
    frame.validate()
    box = frame.configuration.box
    assert frame.configuration.dimensions == axes
    assert box.tolist() == [*(float(np.float32(x)) for x in one["side"][:axes]), *[0.0] * (6 - axes)]
    assert frame.configuration.step == 3000
    assert frame.log["carom/time"] == [gas.time]
    particles = frame.particles
    assert particles.types == list(names)
    assert particles.typeid.tolist() == balls.species.tolist()
    assert np.array_equal(particles.mass, kinds["mass"].astype("f4"))
    assert np.array_equal(particles.diameter, (2 * kinds["radius"]).astype("f4"))
    half = np.where(np.arange(3) < axes, one["side"] / 2, 0)
    assert np.abs(particles.position - (balls.position - half)).max() < 1e-6
    assert (np.abs(particles.position) <= half + 1e-6).all()
    assert np.abs(particles.velocity - balls.velocity).max() < 1e-6
    assert particles.image.tolist() == balls.images.tolist()
    assert particles.image.any()
    assert np.abs(spins_of(particles) - balls.spin).max() < 1e-5
    # HOOMD's own form: the angular momentum about the body's axes is half of q* times the quaternion kept
    moment = kinds["kappa"] * kinds["mass"] * kinds["radius"] ** 2
    assert particles.orientation.tolist() == [[1, 0, 0, 0]] * len(balls.species)
    assert np.abs(particles.angmom[:, 1:] / 2 - moment[:, None] * balls.spin).max() < 1e-5
    # and its rotational energy sum of S^2 / 2I is ours
    there = particles.moment_inertia > 0
    spins = particles.angmom[:, 1:][there] ** 2 / (8 * particles.moment_inertia[there])
    assert spins.sum() == pytest.approx(gas.energy()[1], rel=1e-5)


def test_spins_of_turned_bodies():
    # a quarter turn about z takes the body's x to y
    frame = gsd.hoomd.Frame()
    q = np.array([[np.sqrt(0.5), 0, 0, np.sqrt(0.5)]])
    moment, w = 0.4, np.array([1.0, -2.0, 3.0])  # about the body's axes
    s = np.array([0, *moment * w])
    product = [
        q[0, 0] * s[0] - q[0, 1:] @ s[1:],
        *(q[0, 0] * s[1:] + s[0] * q[0, 1:] + np.cross(q[0, 1:], s[1:])),
    ]
    frame.particles.orientation, frame.particles.angmom = q, 2 * np.array([product])
    frame.particles.moment_inertia = np.full((1, 3), moment)
    assert spins_of(frame.particles)[0] == pytest.approx([2.0, 1.0, 3.0])
    frame.particles.moment_inertia = np.zeros((1, 3))
    assert spins_of(frame.particles) is None


def test_frames_after_the_checkpoint_are_taken_away(gas, tmp_path):
    gas, names = gas
    path = tmp_path / "s.gsd"
    file = Snapshots(path, names)
    for _ in range(5):
        file.write(gas)
        gas.run(100)
    file.close()
    file = Snapshots(path, names, keep=3)
    file.write(gas)
    file.close()
    with gsd.hoomd.open(str(path)) as frames:
        assert [frame.configuration.step for frame in frames] == [0, 100, 200, 500]
        assert frames[1].particles.types == list(names)
    with pytest.raises(CaromError, match="expected at least 9 frames, as many as the checkpoint says, got 4"):
        Snapshots(path, names, keep=9)
    (tmp_path / "none.gsd").write_text("no such thing")
    with pytest.raises(CaromError, match="expected a GSD file to write to"):
        Snapshots(tmp_path / "none.gsd", names, keep=1)
    assert sorted(path.name for path in tmp_path.iterdir()) == ["gas.toml", "none.gsd", "s.gsd"]


@pytest.mark.skipif(os.name != "posix", reason="permissions of POSIX")
def test_files_have_the_permissions_of_other_new_files(gas, tmp_path):
    """They had 0640, whatever the umask."""
    gas, names = gas
    path = tmp_path / "gas.gsd"
    for umask, mode in ((0o022, 0o644), (0o077, 0o600)):
        before = os.umask(umask)
        try:
            file = Snapshots(path, names)
            for _ in range(2):
                file.write(gas)
            file.close()
            Snapshots(path, names, keep=1).close()  # one that is written again, shorter
        finally:
            os.umask(before)
        assert stat.S_IMODE(path.stat().st_mode) == mode
        path.unlink()


def test_a_gas_starts_from_the_last_frame(gas, tmp_path):
    gas, names = gas
    gas.run(2000)
    file = Snapshots(tmp_path / "s.gsd", names)
    file.write(gas)
    file.close()
    text = (tmp_path / "gas.toml").read_text()
    text = text.replace('"random"', '"s.gsd"') if "random" in text else text + 'start = "s.gsd"\n'
    (tmp_path / "again.toml").write_text(text)
    from_file = build(load_gas(tmp_path / "again.toml"))
    balls, again = gas.balls(), from_file.balls()
    order = np.argsort(balls.species, kind="stable")
    assert np.abs(again.velocity - balls.velocity[order]).max() < 1e-6
    assert np.abs(again.spin - balls.spin[order]).max() < 1e-5
    assert np.abs(again.position - balls.position[order]).max() < 1e-5
    (tmp_path / "again.toml").write_text(
        text.replace("[8.0, 7.5, 7.0]", "[8.0, 7.5, 7.1]").replace("[20.0, 16.0]", "[20.0, 17.0]")
    )
    with pytest.raises(CaromError, match="expected the box of the container"):
        build(load_gas(tmp_path / "again.toml"))


# --- how large they become -----------------------------------------------------------------------------------------


def cooling(**run):
    contact = {"between": ("a", "a"), "restitution": 0.95, "friction": 0, "tangential_restitution": -1}
    return GasScene(
        container={"shape": "periodic", "size": (60, 60)}, species=[{"count": 400, "radius": 0.5}], contacts=[contact],
        run={"equilibrate": 0, "seed": 1, **run},
    )  # fmt: skip


def test_the_size_of_a_file_is_estimated(tmp_path):
    scene = cooling(max_events=20_000)
    for every in (100, 20.0):  # of collisions, and of time: the gas cools, and takes ever longer between collisions
        size, session = expected_snapshots(scene, every), Session(scene)
        file = Snapshots(tmp_path / "s.gsd", session.names)
        session.run(every=every, snapshot=lambda now, file=file: file.write(now.gas))
        file.close()
        assert size.frames == pytest.approx(session.snapshots_taken, rel=0.1)
        assert size.total == pytest.approx((tmp_path / "s.gsd").stat().st_size, rel=0.2)


def test_snapshots_at_equal_ratios_of_time_and_gaps():
    scene, times = cooling(duration=500.0), []
    every = LogTimes(mean_free_time(scene), 8)
    session = Session(scene)
    session.run(every=every, snapshot=lambda now: times.append(now.gas.time))
    assert times[:2] == [0.0, pytest.approx(every.first)]
    assert np.diff(np.log10(times[1:])) == pytest.approx(1 / 8)
    assert len(times) == expected_snapshots(scene, every).frames
    # (a run that goes on without snapshots, and then with them again, says which are missing)
    session, taken = Session(scene), []
    assert not session.run(
        every=20.0, snapshot=lambda now: taken.append(now.gas.time), stop=lambda: session.gas.time > 45.0
    )
    assert session.snapshot_gap(20.0) is None
    assert not session.run(stop=lambda: session.gas.time > 150.0)
    assert session.snapshot_gap(20.0) == (60.0, session.gas.time)
    assert session.snapshot_gap(100) is None  # another unit: a new series


@pytest.mark.parametrize("every", ["0 per decade", "x per decade", "5 per decade from -1"])
def test_a_number_per_decade(tmp_path, every):
    (tmp_path / "gas.toml").write_text(gas_text(cooling(max_events=2000)))
    words = ["gas", str(tmp_path / "gas.toml"), "--quiet", "--snapshots", str(tmp_path / "s.gsd"), "--every"]
    done = CliRunner().invoke(app, [*words, every])
    assert "a number per decade of time" in str(done.exception)
    assert CliRunner().invoke(app, [*words, "5 per decade", "--yes"]).exit_code == 0
    with gsd.hoomd.open(tmp_path / "s.gsd") as frames:
        assert len(frames) > 3


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (["--yes"], "--yes: expected --snapshots FILE as well, got none"),
        (["--from", "50 events"], "--from: expected a time > 0, such as 0.5, or '10 min', got '50 events'"),
        (["--duration", "50 events"], "--duration: expected a time > 0, such as 0.5, or '10 min', got '50 events'"),
    ],
)
def test_options_that_do_not_fit(tmp_path, words, said):
    (tmp_path / "gas.toml").write_text(gas_text(cooling(max_events=20)))
    assert str(CliRunner().invoke(app, ["gas", str(tmp_path / "gas.toml"), *words]).exception) == said


def test_an_interval_of_time_counts_collisions_by_kinetic_theory():
    scene = cooling(duration=200.0)
    session = Session(scene)
    session.run()
    assert expected_snapshots(scene, 10).frames == pytest.approx(session.gas.collisions / 10, rel=0.05)


def test_nothing_is_known_of_a_gas_that_starts_at_rest():
    scene = cooling(max_events=2000)
    scene = scene.model_copy(update={"species": (scene.species[0].model_copy(update={"temperature": 0.0}),)})
    size = expected_snapshots(scene, 20.0)
    assert math.isnan(size.frames)
    require_size(Path("s.gsd"), size, 400, 1e3)  # (the limit on the file itself holds)


def test_no_frame_makes_a_file_larger_than_allowed(tmp_path):
    session = Session(cooling(max_events=2000))
    file = Snapshots(tmp_path / "s.gsd", session.names, max_bytes=200_000)
    with pytest.raises(
        CaromError, match=r"s.gsd: expected snapshots of at most 200 kB, got \d+ frames with .*max_bytes"
    ):
        session.run(every=10, snapshot=lambda now: file.write(now.gas))
    file.close()
    assert 100_000 < (tmp_path / "s.gsd").stat().st_size < 250_000


def test_a_disk_without_room_is_said_beforehand(tmp_path, monkeypatch):
    monkeypatch.setattr("shutil.disk_usage", lambda _path: SimpleNamespace(free=10_000_000))
    size = expected_snapshots(cooling(max_events=200_000), 100)
    with pytest.raises(
        CaromError, match=r"fit on the disk, where 10 MB are free, got about 2\d(\.\d)? MB: 2,001 frames"
    ):
        require_size(tmp_path / "s.gsd", size, 400, 1e9)


def test_the_command_refuses_large_files_in_one_line(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "gas.toml").write_text(
        '[container]\nshape = "periodic"\nsize = [60, 60]\n[[species]]\ncount = 400\nradius = 0.5\n[[contacts]]\n'
        'between = ["a", "a"]\nrestitution = 0.95\nfriction = 0.0\ntangential_restitution = -1\n'
        "[run]\nmax_events = 100_000\nequilibrate = 0\n"
    )
    words = ["gas", "gas.toml", "--quiet", "--snapshots", "s.gsd", "--every"]
    done = CliRunner().invoke(app, [*words, "20"])  # (13 GB)
    (line,) = done.exception.faults
    assert line.startswith("--snapshots s.gsd: expected snapshots of at most 1 GB, got about 13")
    assert line.endswith("choose a larger `every`, or allow more with `max_bytes`")
    assert not (tmp_path / "s.gsd").exists()
    done = CliRunner().invoke(app, [*words, "50000 events", "--max-size", "0.00001GB"])
    assert done.exit_code == 1
    assert "at most 10 kB" in str(done.exception)
    assert CliRunner().invoke(app, [*words, "50000 events", "--max-size", "1 MB"]).exit_code == 0
    done = CliRunner().invoke(app, [*words, "20", "--force", "--max-size", "much"])
    assert str(done.exception) == "--max-size: expected a size > 0, such as '20 GB' or '500 MB', got 'much'"


@pytest.mark.parametrize("kind", [".npz", ".xyz"])
def test_snapshots_in_double_precision_keep_the_bits_and_go_on(gas, tmp_path, kind):
    gas, names = gas
    path = tmp_path / f"s{kind}"
    file, seen = Snapshots(path, names), []
    for _ in range(3):
        file.write(gas)
        seen.append((gas.time, gas.balls()))
        gas.run(500)
    file.close()
    file = Snapshots(path, names, keep=2)  # (of a run that goes on from a checkpoint before the third)
    file.write(gas)
    file.close()
    seen[2] = (gas.time, gas.balls())
    if kind == ".npz":
        found = np.load(path)
        frames = list(zip(*(found[name] for name in ("time", "position", "velocity", "spin")), strict=True))
        assert found["species"].tolist() == [names[gas.groups[k]] for k in seen[0][1].species]
    else:
        count = len(seen[0][1].position)
        lines = path.read_text().splitlines()
        parts = [lines[k * (count + 2) : (k + 1) * (count + 2)] for k in range(3)]
        assert len(lines) == 3 * (count + 2)
        frames = []
        for number, head, *rows in parts:
            table = np.array([row.split()[1:] for row in rows], dtype=float)
            assert int(number) == count
            frames.append((float(head.partition("Time=")[2].split()[0]), table[:, :3], table[:, 3:6], table[:, 6:9]))
    assert len(frames) == 3
    for (time, balls), (t, x, v, w) in zip(seen, frames, strict=True):
        assert t == time
        assert all(np.array_equal(a, b) for a, b in ((x, balls.position), (v, balls.velocity), (w, balls.spin)))
    with pytest.raises(CaromError, match="expected at least 9 frames"):
        Snapshots(path, names, keep=9)


def test_a_start_from_stacked_snapshots_is_their_last_frame(gas, tmp_path):
    gas, names = gas
    file = Snapshots(tmp_path / "s.npz", names)
    file.write(gas)
    gas.run(300)
    file.write(gas)
    file.close()
    one = gas.arrays.system[0]
    axes = int(one["dimensions"])
    found = read_initial_state(tmp_path / "s.npz", axes, tuple(one["side"][:axes]), len(gas.balls().position))
    assert np.array_equal(found.position, gas.balls().position)
    assert np.array_equal(found.spin, gas.balls().spin)
