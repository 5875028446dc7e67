"""Starts of a gas: lattices and random packings in rooms of all forms."""

import math

import numpy as np
import pytest
from scipy.spatial import cKDTree

from carom import Ball, CaromError, Disc, Surface
from carom.gas import Gas, Species, container, lattice, scattered
from carom.gas.initial import dense

SMOOTH = Surface(1, 0, -1)
ROOMS = [
    container("sphere", radius=6.0),
    container("cylinder", radius=5.0, height=12.0),
    container("circle", radius=15.0),
    container("stadium", straight=16.0, radius=7.0),
    container("polygon", points=[(0, 0), (30, 0), (20, 25)]),
    container("ellipse", half_axes=(15.0, 9.0), bounds="centre"),
    container("periodic", (10.0,) * 3, obstacles=[(5.0, 5.0, 5.0, 2.0)]),
]
IDS = [room.shape for room in ROOMS]


def gaps(x, radius, side=None):
    """Least gap between two balls of each one's nearest."""
    axes = 2 if (x[:, 2] == 0).all() else 3
    tree = cKDTree(x[:, :axes] % side if side is not None else x[:, :axes], boxsize=side)
    distance, who = tree.query(tree.data, k=min(20, len(x)))
    return (distance - radius[:, None] - radius[who])[:, 1:].min()


def share(x, radius, room):
    axes = len(room.size)
    return (radius**axes).sum() * (math.pi if axes == 2 else 4 / 3 * math.pi) / room.volume


@pytest.mark.parametrize("room", ROOMS, ids=IDS)
def test_random_starts_in_all_rooms(room):
    rng = np.random.default_rng(1)
    radius = rng.choice([0.5, 0.35], size=150)
    side = room.size if all(room.periodic) else None
    x = scattered(radius * 0.7, room, rng=rng)
    assert room.clearance(radius * 0.7, x).min() >= 0
    assert gaps(x, radius * 0.7, side) > 0
    count = int(0.5 * len(radius) / share(x, radius, room))
    radius = rng.choice([0.5, 0.35], size=count)
    x = dense(radius, room)
    assert share(x, radius, room) == pytest.approx(0.5, abs=0.05)
    assert room.clearance(radius, x).min() > -1e-12
    assert gaps(x, radius, side) > -1e-12


@pytest.mark.parametrize("room", ROOMS, ids=IDS)
def test_lattices_in_all_rooms(room):
    x = lattice(100, room, 0.5)
    assert room.clearance(0.5, x).min() >= 0
    assert len(np.unique(x.round(9), axis=0)) == 100
    assert gaps(x, np.full(100, 0.5)) > 0


@pytest.mark.parametrize(
    ("axes", "fraction", "radii"),
    [(3, 0.60, (0.5,)), (3, 0.62, (0.5, 0.7)), (2, 0.80, (0.5,)), (2, 0.82, (0.5, 0.6, 0.75))],
)
def test_dense_packings(axes, fraction, radii):
    radius = np.resize(radii, 600)
    side = ((radius**axes).sum() * (math.pi if axes == 2 else 4 / 3 * math.pi) / fraction) ** (1 / axes)
    x = dense(radius, (side,) * axes, seed=3)
    assert gaps(x, radius, side) > -1e-12
    assert (dense(radius, (side,) * axes, seed=3) == x).all()
    assert np.abs(dense(radius, (side,) * axes, seed=4) - x).max() > 0.1
    made = Disc if axes == 2 else Ball
    species = [Species(made(a, 1.0, 0.4), int((radius == a).sum()), f"{a}") for a in radii]
    order = np.argsort(radius, kind="stable")
    run = Gas(species, (side,) * axes, contacts=SMOOTH, position=x[order]).run(20_000)
    assert abs(run.energy_drift) < 1e-12
    assert run.max_overlap < 1e-12


def test_a_random_packing_is_disordered():
    radius, side = np.full(800, 0.5), (800 * math.pi / 6 / 0.6) ** (1 / 3)
    x = dense(radius, (side,) * 3)
    tree = cKDTree(x % side, boxsize=side)
    counts = np.diff(tree.count_neighbors(tree, [1.0, 1.15, 1.35, 1.45, 2.05])) / 800
    # fcc at this density would have 12, 0, 6 and so on; a fluid has neighbours at all distances
    assert 5 < counts[0] < 11
    assert counts[1] > 1
    assert counts[2] < 2


def test_jammed_and_impossible():
    with pytest.raises(CaromError, match=r"at most 0\.7405, the densest packing of equal spheres"):
        dense(np.full(100, 0.5), (4.0,) * 3)
    with pytest.raises(CaromError, match=r"at most 0\.9069, the densest packing of equal discs"):
        dense(np.full(100, 0.5), (9.0, 9.0))
    with pytest.raises(CaromError, match="a packing fraction of at most 1, got"):
        dense(np.resize([0.5, 0.6], 100), (4.0,) * 3)
    with pytest.raises(CaromError, match=r"got 0\.70\d*: the balls jam at 0\.[56]"):
        dense(np.full(150, 0.5), ((150 * math.pi / 6 / 0.7) ** (1 / 3),) * 3)
    with pytest.raises(CaromError, match="number > 0"):
        dense([0.5, -0.5], (4.0,) * 3)


def test_a_gas_that_has_no_room_on_a_lattice_starts_from_a_packing():
    room = container("circle", radius=7.0)
    gas = Gas([Species(Disc(0.5, 1.0, 0.5), 130)], room, contacts=SMOOTH)
    assert room.clearance(0.5, gas.balls().position).min() > -1e-12
    assert gas.run(2000).max_overlap < 1e-12
    with pytest.raises(CaromError, match="a packing fraction of at most"):
        Gas([Species(Disc(0.5, 1.0, 0.5), 190)], room, contacts=SMOOTH)


def test_discs_are_refused_in_three_dimensions():
    """A disc has one spin, about z; spheres in a plane, a monolayer, are a model that people use."""
    with pytest.raises(
        CaromError, match=r"^Gas: species\[0\]: expected carom\.Ball in three dimensions, got a Disc, .*: a$"
    ):
        Gas([Species(Disc(0.5, 1.0), 10)], (9.0, 9.0, 9.0), contacts=SMOOTH)
    assert Gas([Species(Ball(0.5, 1.0), 10)], (9.0, 9.0), contacts=SMOOTH).run(10).pair_collisions == 10
