"""Large gases: no start, snapshot or checkpoint has a second copy of the balls in memory; blocks change no bit."""

from __future__ import annotations

import tracemalloc
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

import carom
from carom.gas import Gas, GasScene, Session, Snapshots, Species, load_checkpoint, save_checkpoint, thermal
from carom.gas.edmd import driver
from carom.gas.initial import first_overlap

BALLS = 200_000


def session() -> Session:
    return Session(
        GasScene(
            container={"shape": "periodic", "size": ((BALLS / 0.5) ** (1 / 3),) * 3},
            species=[{"count": BALLS, "radius": 0.5}],
            contacts=[{"between": ("a", "a"), "restitution": 1, "friction": 0.2, "tangential_restitution": 0.5}],
            run={"equilibrate": 1 << 60, "max_events": 1},
        )
    )


def peak(action: Callable[[], Any]) -> float:
    """The memory that an action takes at most beside what there is, in bytes per ball."""
    tracemalloc.start()
    action()
    most = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()
    return most / BALLS


@pytest.fixture(scope="module")
def large() -> Session:
    made = session()
    made.gas.advance(BALLS // 10)
    return made


def test_a_start_takes_the_memory_of_the_gas(large):
    # beside the gas, 201 bytes a ball, one array of positions or of drawn velocities and its products
    assert peak(session) < large.gas.bytes_per_ball + 120


def test_snapshots_and_checkpoints_have_no_copy_of_the_gas(large, tmp_path):
    file = Snapshots(tmp_path / "gas.gsd", ("a",))
    # one quantity of all balls (four numbers in single precision), the places of the balls, and one block of everything
    assert peak(lambda: file.write(large.gas)) < 16 + 4 + 320 * driver.BLOCK / BALLS
    file.close()
    path = tmp_path / "gas.npz"
    assert peak(lambda: save_checkpoint(large, path)) < 2.2 * 64 * driver.BLOCK / BALLS
    # its arrays are read one at a time
    assert peak(lambda: load_checkpoint(path)) < large.gas.bytes_per_ball + 120
    again = load_checkpoint(path)
    for one in (large, again):
        one.gas.advance(1000)
    one, two = (x.gas.state() for x in (large, again))
    assert all(one[name].tobytes() == two[name].tobytes() for name in one)


def test_blocks_change_no_bit(large, monkeypatch):
    balls, energy = large.gas.balls(), large.gas.energy()
    state = {name: array.tobytes() for name, array in large.gas.state().items()}
    monkeypatch.setattr(driver, "BLOCK", 777)
    other = large.gas.balls()
    for name in ("position", "velocity", "spin", "species", "images"):
        assert getattr(balls, name).tobytes() == getattr(other, name).tobytes()
    assert large.gas.energy() == pytest.approx(energy, rel=1e-13)  # (sums in another order)
    assert {name: array.tobytes() for name, array in large.gas.state().items()} == state


def test_thermal_velocities_are_those_of_the_formula():
    rng, mass = np.random.default_rng(3), np.linspace(1, 2, 50)
    v = rng.normal(size=(50, 3)) / np.sqrt(mass)[:, None]
    v -= (mass[:, None] * v).sum(axis=0) / mass.sum()
    v *= np.sqrt(2.0 * 50 * 3 / (mass[:, None] * v * v).sum())
    assert thermal(mass, (0, 1, 2), 2.0, np.random.default_rng(3)).tobytes() == v.tobytes()


@pytest.mark.parametrize("periodic", [(True, True, True), (True, False, True)])
def test_the_first_overlap_is_that_of_all_pairs(periodic):
    species = [Species(carom.Ball(0.5, 1.0), 4)]
    gas = Gas(species, (9.0, 8.0, 7.0), periodic=periodic, contacts=carom.Surface(1, 0, -1))
    one, rng = gas.arrays.system[0], np.random.default_rng(5)
    side = np.array([9.0, 8.0, 7.0])
    # cells for these 60 balls, not for four
    one["cells"], one["cell_size"] = (9, 8, 7), 1.0
    for radius, found in ((0.5, True), (1e-4, False)):
        for _ in range(10):
            x, radii = rng.random((60, 3)) * side, np.full(60, radius)
            r = x[:, None] - x
            r -= np.where(periodic, side * np.round(r / side), 0)
            pairs = np.argwhere(np.triu((r * r).sum(axis=2) < (2 * radius) ** 2, 1))
            expected = tuple(pairs[0].tolist()) if len(pairs) else None
            assert first_overlap(one, radii, x, 0.0) == expected
            assert (expected is not None) == found
