"""Lees-Edwards boundaries: event by event beside brute force, exact means, layers, checkpoints, bad input."""

from __future__ import annotations

import math

import numpy as np
import pytest
from reference.brute_force_shear import Sheared

from carom import Ball, CaromError, Disc, Surface
from carom.gas import Gas, GasScene, Species

ROUGH = Surface(0.9, 0.3, 0.4)
SMALL = {
    "rough balls of two sizes": ((3.1, 3.6, 3.2), Ball, 0.9),
    "discs, sheared backwards and fast": ((6.2, 5.1), Disc, -3.0),
}


def small_gas(name):
    side, kind, rate = SMALL[name]
    species = [Species(kind(0.5, 1.0), 6, "a", 1.0, 0.5), Species(kind(0.35, 0.4), 4, "b", 1.0, 0.5)]
    contacts = {("a", "a"): ROUGH, ("a", "b"): Surface(0.95, 0.2, -0.3), ("b", "b"): Surface(0.8, 0.0, -1.0)}
    return Gas(species, side, contacts=contacts, shear_rate=rate, seed=4), contacts


@pytest.mark.parametrize("name", SMALL)
def test_events_and_means_are_those_of_brute_force(name):
    gas, contacts = small_gas(name)
    now, one = gas.balls(), gas.arrays.system[0]
    kinds, axes = gas.arrays.materials.species[now.species], int(one["dimensions"])

    def pair(i, j):
        between = tuple(sorted("ab"[now.species[k]] for k in (i, j)))
        surface = contacts[between]
        return surface.restitution, surface.friction, surface.tangential_restitution

    brute = Sheared(
        now.position, now.velocity, now.spin, kinds["radius"], kinds["mass"], kinds["kappa"], one["side"], gas.shear_rate, pair,
        axes,
    )  # fmt: skip
    mark, crossed = gas.mark(), 0
    for _ in range(120):
        brute.step()
        done = gas.run(1)
        assert gas.time == pytest.approx(brute.t, abs=1e-9)
        assert done.max_overlap < 1e-12
        crossed += abs(brute.image[1]) > 0
        now = gas.balls()
        turns = np.floor(brute.x[:, 1] / brute.side[1])
        at, moves = brute.x.copy(), brute.v.copy()
        at[:, 1] -= turns * brute.side[1]
        at[:, 0] -= turns * brute.speed * brute.t
        moves[:, 0] -= turns * brute.speed
        r = now.position - at
        assert np.abs(r - np.round(r / brute.side) * brute.side).max() < 1e-8
        assert np.abs(now.velocity - moves).max() < 1e-8
        assert np.abs(now.spin - brute.w).max() < 1e-8
        brute.x, brute.v, brute.w, brute.t = now.position.copy(), now.velocity.copy(), now.spin.copy(), gas.time
    assert crossed > 10  # contacts of images that move
    run = gas.measured_since(mark)
    scale = one["volume"] * brute.measured
    kinetic, collisional = (part[:axes, :axes] / scale for part in (brute.flux, brute.transfer))
    assert run.simulated_time == pytest.approx(brute.measured, rel=1e-9)
    np.testing.assert_allclose(run.averages.kinetic_stress, kinetic, atol=1e-8 * kinetic.max())
    np.testing.assert_allclose(run.averages.collisional_stress, collisional, atol=1e-7 * np.abs(collisional).max())
    # the work of the shear is what the balance of the energy lacks
    lost = float(sum(pair["lost_normal"] + pair["lost_tangential"] for pair in gas.arrays.materials.pairs))
    start = brute_energy = sum(mark.energy)
    assert sum(gas.energy()) == pytest.approx(start + run.shear.energy - lost, rel=1e-9 * max(1.0, brute_energy))


def test_a_long_run_keeps_its_flow_and_its_energy_balance_and_can_be_divided():
    species = [Species(Ball(0.5, 1.0), 500, "a", 1.0, 0.5)]
    gas, parts = (Gas(species, (10.0, 9.0, 11.0), contacts=ROUGH, shear_rate=0.4, seed=2) for _ in range(2))
    gas.run(15_000)
    for _ in range(3):
        parts.run(5000)
        parts = Gas.restore(parts.state())
    assert parts.balls().velocity.tobytes() == gas.balls().velocity.tobytes()
    mark, lost = gas.mark(), float(gas.arrays.materials.pairs["lost_normal"].sum())
    lost += float(gas.arrays.materials.pairs["lost_tangential"].sum())
    run = gas.run(20_000)
    after = sum(float(gas.arrays.materials.pairs[f"lost_{way}"].sum()) for way in ("normal", "tangential"))
    assert sum(gas.energy()) == pytest.approx(sum(mark.energy) + run.shear.energy - (after - lost), rel=1e-10)
    assert run.max_overlap < 1e-12
    layers = run.averages.layers
    middle = (layers.edges[1:] + layers.edges[:-1]) / 2
    np.testing.assert_allclose(layers.velocity[0, :, 0], 0.4 * (middle - 4.5), atol=0.1)
    assert np.nanmean(layers.temperature) == pytest.approx(run.temperature_translational, rel=0.05)
    assert run.shear.viscosity > 0
    # (the next cell of the balls that have just met, and the first images, are those of a new gas)
    assert run.averages.stress[0, 1] == pytest.approx(run.averages.stress[1, 0], rel=0.1)


def test_bad_input_is_one_line():
    elastic, kind = Surface(1, 0, -1), [Species(Ball(0.5, 1.0), 8)]
    for options, said in (
        ({"periodic": (True, False, True)}, "Gas: shear_rate: expected a box that is periodic along all axes"),
        ({"gravity": (0, 0, -1)}, "Gas: shear_rate: expected no gravity"),
        ({"shear_rate": math.nan}, "Gas: shear_rate: expected a rate, got nan"),
        (
            {"shear_rate": -1e8},
            "Gas: shear_rate: expected at most 1e.06 thermal speeds across the box, 1.67e.05, got -1e.08",
        ),
    ):
        with pytest.raises(CaromError, match=said):
            Gas(kind, (6.0, 6.0, 6.0), contacts=elastic, **({"shear_rate": 0.1} | options))
    contacts = [{"between": ("a", "*"), "restitution": 1, "friction": 0}]
    scene = {
        "container": {"shape": "box", "size": (6, 6, 6)},
        "species": [{"count": 8, "radius": 0.5}],
        "shear_rate": 0.1,
    }
    fast = scene | {"container": {"shape": "periodic", "size": (6, 6, 6)}, "shear_rate": 1e8}
    with pytest.raises(CaromError, match=r"shear_rate: expected at most 1e.06 thermal speeds across the box"):
        GasScene(**fast, contacts=contacts, run={"max_events": 10})
    with pytest.raises(CaromError, match=r"shear_rate: expected a box that is periodic .* got walls left"):
        GasScene(**scene, contacts=contacts, run={"max_events": 10})


def test_a_gas_of_which_each_step_looks_at_many_images_can_be_stopped():
    """Of 65,536 first steps each looked at 256 images of each ball of a row: no stop was heard for hours."""
    side = (4000.0, 8.0, 8.0)
    gas = Gas([Species(Ball(0.5, 1.0), 4000, temperature=1e6)], side, contacts=Surface(0.9, 0, 0), shear_rate=1e8)
    gas.advance(10**9, stop=lambda: True)
    assert gas.arrays.system[0]["planned"] < 4000
    assert gas.collisions == 0


def test_a_sheared_gas_at_rest_has_no_pressure():
    gas = Gas([Species(Ball(0.5, 1.0), 8, temperature=0)], (6.0, 6.0, 6.0), contacts=Surface(0.9, 0, 0), shear_rate=0.1)
    run = gas.run(until=0.01)
    assert (run.pressure, run.shear.viscosity) == (0, 0)
    assert math.isnan(run.shear.normal_difference)


def test_no_collision_is_missed_behind_the_border_that_slides() -> None:
    """A ball that had crossed it knew of the row that it left the balls nearby only, past which others slide: 0.7 of a distance."""
    for seed in range(4):
        gas = Gas([Species(Disc(0.5, 1.0), 20)], (10.0, 10.0), contacts=Surface(0.9, 0, -1), shear_rate=1.0, seed=seed)
        assert gas.run(30_000).max_overlap < 1e-12
