"""The loop of many balls against all pairs after every event, and what must hold whatever happens."""

import math

import numpy as np
import pytest
from reference.brute_force_gas import Brute, follow
from reference.exploring import tried

from carom import Ball, CaromError, Disc, Surface
from carom.gas import WALLS, Gas, Species, lattice
from carom.gas.edmd.loop import CACHED_BALLS, SORT_INTERVAL

ROUGH, SMOOTH = Surface(1, math.inf, 1), Surface(1, 0, 0)


def box(
    *, axes=3, periodic=True, gravity=(0.0, 0.0, 0.0), rough=True, counts=(9, 8, 7), seed=0, elastic=False, dense=1.0
):
    """Three species of all sizes, masses and surfaces."""
    rng = np.random.default_rng(seed)
    made = Disc if axes == 2 else Ball
    balls = [made(0.5, 1.0, 0.4), made(0.3, 0.4, 0.25), made(0.42, 3.0, 0.6)]
    names = ["a", "b", "c"]
    species = [Species(ball, n, name, 1.0, 0.5) for ball, n, name in zip(balls, counts, names, strict=True) if n]
    names = [one.name for one in species]
    contacts = {}
    for i, one in enumerate(names):
        for other in [*names[i:], "wall"]:
            e = 1.0 if elastic else rng.uniform(0.8, 1)
            contacts[one, other] = Surface(e, rng.uniform(0.1, 1), rng.uniform(-1, 1)) if rough else Surface(e, 0, 0)
    contacts["a", "left"] = Surface(0.9, math.inf, 0.3)
    side = np.array([5.1, 4.3, 3.9] if axes == 3 else [7.3, 6.1]) / dense
    return Gas(species, side, periodic=periodic, contacts=contacts, gravity=gravity, seed=seed), contacts, names


def brute_of(gas, contacts, names):
    one, balls = gas.arrays.system[0], gas.balls()
    kinds = gas.arrays.materials.species[balls.species]

    def surface(*keys):
        found = next(contacts[key] for key in keys if key in contacts)
        return found.restitution, found.friction, found.tangential_restitution

    def pair(i, j):
        first, second = (names[balls.species[k]] for k in (i, j))
        return surface((first, second), (second, first))

    def wall(i, k):
        first = names[balls.species[i]]
        return surface((first, WALLS[k]), (first, "wall"))

    return Brute(
        balls.position, balls.velocity, balls.spin, kinds["radius"], kinds["mass"], kinds["kappa"], one["side"],
        one["periodic"] == 1, one["gravity"], pair, wall, int(one["dimensions"]),
    )  # fmt: skip


@pytest.mark.parametrize(
    ("axes", "periodic", "gravity", "rough"),
    [
        (3, True, (0, 0, 0), True),
        (3, True, (0, 0, 0), False),
        (3, False, (0, 0, 0), True),
        (3, (True, True, False), (0, 0.0, -2.0), True),
        (3, (False, True, False), (0.3, 0.5, -1.0), True),
        (2, True, (0, 0), True),
        (2, False, (0.4, -1.5), True),
        (2, (True, False), (0, 0), False),
    ],
)
def test_the_same_events_as_all_pairs(axes, periodic, gravity, rough):
    gas, contacts, names = box(axes=axes, periodic=periodic, gravity=gravity, rough=rough)
    brute = brute_of(gas, contacts, names)
    walls = sum(follow(gas, brute) for _ in range(tried(80, 150)))
    assert (walls > tried(10, 20)) == (periodic is not True)


def test_a_dense_gas_in_the_smallest_periodic_box():
    # three cells along each axis: every neighbour is one over the border as well
    gas, contacts, names = box(counts=(27, 0, 0), dense=1.28, elastic=True)
    assert (gas.arrays.system[0]["cells"] == 3).any()
    brute = brute_of(gas, contacts, names)
    for _ in range(tried(80, 200)):
        follow(gas, brute)


@pytest.mark.parametrize("axes", [2, 3])
def test_back_in_time(axes):
    gas = Gas(
        [Species(Disc(0.5, 1.0, 0.5) if axes == 2 else Ball(0.5, 1.0, 0.4), 60)], (12.0,) * 2 if axes == 2 else (5.5,) * 3,
        contacts=ROUGH, periodic=False, seed=3,
    )  # fmt: skip
    start = gas.balls()
    until = 1.6
    run = gas.run(until=until)
    assert run.pair_collisions + run.wall_collisions > 100
    end = gas.balls()
    back = Gas(
        [Species(Disc(0.5, 1.0, 0.5) if axes == 2 else Ball(0.5, 1.0, 0.4), 60)], (12.0,) * 2 if axes == 2 else (5.5,) * 3,
        contacts=ROUGH, periodic=False, position=end.position, velocity=-end.velocity, spin=-end.spin,
    )  # fmt: skip
    back.run(until=until)
    again = back.balls()
    assert np.abs(again.position - start.position).max() < 1e-5
    assert np.abs(again.velocity + start.velocity).max() < 1e-4
    assert np.abs(again.spin + start.spin).max() < 1e-4
    assert np.abs(end.position - start.position).max() > 0.3


def test_the_same_bits_however_it_is_cut_into_chunks_saved_and_restored():
    # (after 1338 collisions a ball lies on the wall: an inelastic collapse)
    whole, *_ = box(periodic=(True, False, True), gravity=(0, -1, 0), seed=5)
    parts, *_ = box(periodic=(True, False, True), gravity=(0, -1, 0), seed=5)
    whole.run(1300)
    parts.run(432, chunk=7)
    parts = Gas.restore(parts.state())
    parts.run(1300 - 432, chunk=100)
    for name, array in whole.state().items():
        assert array.tobytes() == parts.state()[name].tobytes() or name == "system", name
    one, other = whole.state()["system"], parts.state()["system"]
    for name in one.dtype.names:
        if name != "overlap":  # the largest of each run
            assert one[name].tobytes() == other[name].tobytes(), name


def test_the_same_bits_of_so_many_balls_that_they_are_asked_for_ahead_and_put_in_order():
    count = CACHED_BALLS + 1
    side = (count / 0.5) ** (1 / 3)
    whole, parts = (Gas([Species(Ball(0.5, 1.0, 0.4), count)], (side,) * 3, contacts=ROUGH, seed=1) for _ in range(2))
    whole.run(300_000)
    parts.run(170_000)
    parts = Gas.restore(parts.state())
    parts.run(130_000)
    assert parts.time == whole.time
    assert whole.arrays.system[0]["cycles"] > SORT_INTERVAL
    assert (whole.arrays.balls.numbers != np.arange(count)).any()
    assert whole.arrays.system[0]["invalidated"] > 1000
    for name in ("position", "velocity", "spin"):
        assert getattr(parts.balls(), name).tobytes() == getattr(whole.balls(), name).tobytes()
    assert abs(sum(whole.energy()) / (3 * count) - 1) < 0.02


def test_conserved():
    gas, *_ = box(counts=(60, 80, 40), dense=0.55, elastic=True, rough=False, seed=2)
    mass = gas.arrays.materials.species["mass"][gas.balls().species][:, None]
    run = gas.run(100_000)
    assert abs(run.energy_drift) < 1e-12
    assert np.abs((mass * gas.balls().velocity).sum(axis=0)).max() < 1e-11
    assert run.max_overlap < 1e-13


def test_clocks_keep_their_digits():
    gas, *_ = box(counts=(9, 8, 7), elastic=True, rough=False)
    gas.run(50_000)
    one = gas.arrays.system[0]
    assert gas.time > 100
    assert one["cycles"] > 100
    assert abs(one["now"]) < 5
    assert np.abs(gas.arrays.balls.motions["time"]).max() < 20


def test_small_balls_that_crowd_in_a_cell():
    x = np.concatenate(([[2.0, 3.4, 2.0]], lattice(300, (4.0, 2.8, 4.0), 0.1)))
    gas = Gas(
        [Species(Ball(0.5, 1.0, 0.4), 1, "big"), Species(Ball(0.1, 0.01, 0.4), 300, "small")], (4.0, 4.0, 4.0),
        contacts=SMOOTH, periodic=(False, False, True), gravity=(0, -300.0, 0), position=x,
    )  # fmt: skip
    run = gas.run(20_000)
    plans = gas.arrays.balls.plans[:-1]
    _cells, most = np.unique(np.stack([plans[axis] for axis in ("cx", "cy", "cz")]), axis=1, return_counts=True)
    assert most.max() > 10
    assert abs(run.energy_drift) < 1e-10
    assert run.max_overlap < 1e-12


def test_a_collapse_is_ended_by_the_contact_time():
    # balls on the ground give back half of their speed: without a rule they hit it ever faster
    options = {"periodic": (True, True, False), "gravity": (0, 0, -1.0), "contacts": Surface(0.5, 0, 0)}
    gas = Gas([Species(Ball(0.5, 1.0, 0.4), 20)], (4.0, 4.0, 6.0), contact_time=1e-3, **options)
    gas.run(until=20.0)
    assert gas.time == 20.0
    assert gas.energy()[0] < 1.0


@pytest.mark.parametrize(
    ("change", "said"),
    [
        ({"side": (2.0, 5.0, 5.0)}, "at least 3 diameters"),
        ({"position": [[1, 1, 1], [1.5, 1, 1]]}, "balls 0 and 1"),
        ({"position": [[1, 1, 1], [1.5, 1, 1]], "periodic": False, "side": (6, 6, 6)}, "balls 0 and 1"),
        ({"position": [[0.2, 1, 1], [3, 1, 1]], "periodic": False}, "overlaps a wall"),
        ({"position": [[0.2, 1, 1], [4.9, 1, 1]]}, "balls 0 and 1"),
        ({"contacts": {("a", "b"): ROUGH}}, "'b'"),
        ({"contacts": {("a", "a"): ROUGH}, "periodic": False}, "wall"),
        ({"velocity": [1, 2, 3]}, "velocity"),
        ({"gravity": (0, math.nan, 0)}, "gravity"),
    ],
)
def test_what_cannot_be(change, said):
    options = {"side": (5.0, 5.0, 5.0), "contacts": ROUGH, **change}
    with pytest.raises(CaromError, match=said):
        Gas([Species(Ball(0.5, 1.0, 0.4), 2)], **options)
