"""Means over time are those of time: against flight by flight, against closed forms, and whatever the run is divided into."""

from __future__ import annotations

import math

import numpy as np
import pytest
from reference.gas_flights import Flights

import carom
from carom import Ball, Disc, Surface
from carom.gas import Drive, Gas, GasScene, Session, Species, container
from carom.gas.report import report

ROUGH = Surface(0.9, 0.3, 0.5)
DISCS = [Species(Disc(0.5, 1.0), 12)]
STRIP = {"periodic": (True, False), "contacts": ROUGH, "seed": 1}
GASES = {
    "two species, periodic": lambda: Gas(
        [Species(Ball(0.5, 1.0), 20), Species(Ball(0.4, 0.5), 10, "b")], (6.0, 6.0, 6.0), contacts=ROUGH, seed=1
    ),
    "falling in a box": lambda: Gas(
        [Species(Ball(0.5, 2.0), 20)], (4.0, 4.0, 8.0), periodic=False, gravity=(0, 0, -1.0), contacts=ROUGH, seed=1
    ),
    "on a shaken floor": lambda: Gas(
        DISCS, (8.0, 16.0), gravity=(0, -1.0), drives={"bottom": Drive(amplitude=0.3, frequency=1.0)}, **STRIP
    ),
    "two species on an inclined floor": lambda: Gas(
        [*DISCS, Species(Disc(0.3, 2.0), 5, "b")], (8.0, 16.0), gravity=(0.3, -1.0),
        drives={"bottom": Drive(amplitude=0.3, frequency=1.0)}, **STRIP,
    ),
    "between heated walls": lambda: Gas(DISCS, (8.0, 16.0), drives={"bottom": Drive(temperature=2.0)}, **STRIP),
    "across a circle": lambda: Gas(DISCS, container("circle", radius=4.0), contacts=ROUGH, seed=2),
}  # fmt: skip


@pytest.mark.parametrize("name", GASES)
def test_means_are_those_of_every_flight(name):
    gas = GASES[name]()
    gas.advance(40)
    whole, one = gas.arrays.averages.whole[0], gas.arrays.system[0]
    axis, axes = int(whole["axis"]), int(one["dimensions"])
    edges = None if axis < 0 else one["cell_size"][axis] * np.arange(int(one["cells"][axis]) + 1)
    mark = gas.mark()
    flights = Flights(gas, 100, axis, edges)
    run = gas.measured_since(mark)
    means = run.averages
    assert means.time == pytest.approx(flights.time, rel=1e-12)
    count = gas.balls().species.size * means.shares
    trace = np.trace(flights.flux, axis1=1, axis2=2) / (axes * count)
    np.testing.assert_allclose(means.temperatures[:, 0], trace, rtol=1e-11)
    np.testing.assert_allclose(means.temperatures[:, 1], flights.spins / ((3 if axes == 3 else 1) * count), rtol=1e-11)
    whole_flux = flights.flux.sum(axis=0)[:axes, :axes] / one["volume"]
    np.testing.assert_allclose(means.kinetic_stress, whole_flux, atol=1e-11 * whole_flux.max())
    assert means.potential_energy == pytest.approx(flights.height, rel=1e-11)
    assert run.temperature_translational == pytest.approx(float(count @ trace / count.sum()), rel=1e-11)
    if means.layers is not None:
        layers, mass = means.layers, gas.arrays.materials.species["mass"]
        np.testing.assert_allclose(layers.number.sum(axis=0), flights.number, atol=1e-10)
        p = np.nansum(mass[:, None, None] * layers.number[:, :, None] * layers.velocity, axis=0)
        np.testing.assert_allclose(p, flights.momentum[:, :axes], atol=1e-10)
        if not flights.around:
            area = one["side"][:axes].prod() / one["side"][axis]
            np.testing.assert_allclose(layers.energy_flux[1:-1], flights.energy_up[1:-1] / area, atol=1e-10)
            u = flights.momentum / (mass @ layers.number)[:, None]
            work = (np.nan_to_num(u[1:] + u[:-1]) / 2 * flights.momentum_up[1:-1]).sum(axis=1)
            np.testing.assert_allclose(layers.heat_flux[1:-1], (flights.energy_up[1:-1] - work) / area, atol=1e-10)
        if len(mass) == 1:
            held = flights.number > 1e-9
            flow = mass[0] * (flights.momentum[held] / (mass[0] * flights.number[held, None])) ** 2
            warm = (flights.square[held] / flights.number[held] - flow.sum(axis=1)) / axes
            np.testing.assert_allclose(layers.temperature[0, held], warm, atol=1e-9)


def test_means_do_not_depend_on_how_a_run_is_divided():
    whole, parts = (GASES["on a shaken floor"]() for _ in range(2))
    found = whole.run(3000).averages
    mark = parts.mark()
    for _ in range(6):
        parts.advance(500)
        parts = Gas.restore(parts.state())
    again = parts.measured_since(mark).averages
    assert again.stress.tobytes() == found.stress.tobytes()
    assert again.layers.temperature.tobytes() == found.layers.temperature.tobytes()


def test_a_window_is_the_difference_of_two():
    gas = GASES["on a shaken floor"]()
    begin = gas.mark()
    first = gas.run(300)
    second = gas.run(until=gas.time + 5.0)
    both = gas.measured_since(begin).averages
    t = first.simulated_time, second.simulated_time
    for name in ("temperatures", "kinetic_stress", "collisional_stress", "potential_energy"):
        one, two = (getattr(run.averages, name) for run in (first, second))
        np.testing.assert_allclose(getattr(both, name), (one * t[0] + two * t[1]) / sum(t), rtol=1e-9, atol=1e-12)
    np.testing.assert_allclose(both.final, second.averages.final)


def test_one_ball_thrown_upwards_again_and_again():
    """Its energies, density and speeds at every height have closed forms."""
    g, height = 2.0, 3.0
    gas = Gas(
        [Species(Disc(0.5, 1.0), 1)], (4.0, 8.0), periodic=(True, False), gravity=(0, -g), contacts=Surface(1, 0, -1),
        position=[[2.0, 0.5 + height]], velocity=[[0.3, 0.0]], spin=[2.0],
    )  # fmt: skip
    found = gas.run(until=40 * 2 * math.sqrt(2 * height / g)).averages  # whole periods
    assert found.kinetic_stress[1, 1] * 32 == pytest.approx(2 * g * height / 3, rel=1e-12)
    np.testing.assert_allclose(found.layers.velocity[0, :2, 0], 0.3, rtol=1e-12)  # (of the whole gas, which drifts)
    assert found.potential_energy == pytest.approx(g * (0.5 + 2 * height / 3), rel=1e-12)
    assert found.temperature_rotational == pytest.approx(0.125 * 4.0, rel=1e-12)
    # below the turning point by d it has been since sqrt(2 d / g)
    depth = np.clip(0.5 + height - found.layers.edges, 0.0, height)
    np.testing.assert_allclose(found.layers.number[0], -np.diff(np.sqrt(depth / height)), atol=1e-12)


def test_stress_of_a_gas_in_equilibrium():
    """It is the same along all axes, symmetric in the mean, and its kinetic part that of an ideal gas."""
    gas = Gas([Species(Ball(0.5, 1.0), 500)], (10.0, 10.0, 10.0), contacts=Surface(1, 0, -1), seed=3)
    gas.advance(10_000)
    run = gas.run(100_000)
    stress = run.averages.stress
    assert run.temperature_translational == pytest.approx(1.0, abs=1e-10)
    assert np.trace(run.averages.kinetic_stress) == pytest.approx(3 * 0.5, rel=1e-10)
    assert run.pressure == pytest.approx(np.trace(stress) / 3)
    np.testing.assert_allclose(np.diag(stress), run.pressure, rtol=0.02)
    off = run.averages.collisional_stress
    np.testing.assert_allclose(off, off.T, rtol=1e-9, atol=1e-12)  # (central forces)
    assert np.abs(stress - np.diag(np.diag(stress))).max() < 0.02 * run.pressure


def test_a_cooling_gas_reports_its_end_and_a_window():
    """Ratios are those of equal times, and nothing before ``from_time`` enters any mean."""
    contact = {"between": ("a", "a"), "restitution": 0.8, "friction": math.inf}
    scene = GasScene(
        container={"shape": "periodic", "size": (9, 9, 9)}, species=[{"count": 100, "radius": 0.5}], contacts=[contact],
        run={"equilibrate": 0, "duration": 40.0},
    )  # fmt: skip
    whole = Session(scene)
    whole.run()
    found, end = report(whole), whole.gas.energy()
    assert (
        found["temperature_ratio"] == found["final"]["temperature_ratio"] == pytest.approx(end[1] / end[0], rel=1e-12)
    )
    assert found["species"]["a"]["temperature_ratio"] == found["temperature_ratio"]
    assert found["temperature_translational"] > 5 * found["final"]["temperature_translational"]
    late = Session(carom.replaced(scene, {"run.from_time": 30.0, "run.duration": 10.0}))
    late.run()
    part = report(late)
    assert part["simulated_time"] == pytest.approx(10.0, rel=1e-12)
    assert part["final"]["species"]["a"] == pytest.approx(found["final"]["species"]["a"], rel=1e-9)
    assert 1 < part["temperature_translational"] / part["final"]["temperature_translational"] < 2
    gas, run = carom.simulate_gas(scene, from_time="30 s", duration=10.0)
    assert gas.time == pytest.approx(40.0)
    assert run.temperature_translational == part["temperature_translational"]


def test_a_ratio_of_few_shaken_discs_is_one_of_means():
    """Their temperature differs from sample to sample by more than a factor of two, and does not cool."""
    contact = {"between": ("*", "*"), "restitution": 0.9, "friction": 0.3, "tangential_restitution": 0.4}
    scene = GasScene(
        container={"shape": "box", "size": (10, 30), "periodic": ["x"]}, species=[{"count": 40, "radius": 0.5}],
        contacts=[contact], gravity=1.0, contact_time=1e-5, drives=[{"wall": "bottom", "amplitude": 0.6, "frequency": 1.0}],
        run={"equilibrate": 4000, "max_events": 10_000, "seed": 3},
    )  # fmt: skip
    session = Session(scene)
    session.run()
    warm, found = session.measures.series["translational"], report(session)
    assert warm.max() > 2 * warm.min()
    ratio = found["temperature_rotational"] / found["temperature_translational"]
    assert found["temperature_ratio"] == found["species"]["a"]["temperature_ratio"] == pytest.approx(ratio, rel=1e-12)
