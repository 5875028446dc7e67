"""Snapshots read back with the library that HOOMD, freud and OVITO's file format come from."""

from __future__ import annotations

import os
import stat

import gsd.hoomd
import numpy as np
import pytest
from reference.gases import MIXED, ROUGH

from carom import CaromError
from carom.gas.build import build, load_gas
from carom.gas.snapshots import Snapshots, spins_of


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
