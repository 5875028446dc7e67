"""Gases against what is known of them."""

import math

import numpy as np
import pytest

from carom import Ball, CaromError, Disc, Surface, simulate_gas
from carom.gas import Gas, Species, Thermostat, lattice, scattered, thermal

SMOOTH, ROUGH = Surface(1, 0, -1), Surface(1, math.inf, 1)
SPHERE, DISC = Ball(0.5, 1.0, 0.4), Disc(0.5, 1.0, 0.5)


def test_mean_free_time_of_hard_spheres():
    _gas, run = simulate_gas([Species(SPHERE, 4000)], (20.0,) * 3, contacts=SMOOTH, max_events=1_000_000)
    assert run.pair_collisions == 1_000_000
    # Kolafa's equation of state: 0.13017; one in a thousand is 7 standard errors of this run
    assert run.mean_free_time == pytest.approx(0.13017, rel=2e-3)
    assert abs(run.energy_drift) < 1e-12
    assert run.temperature_translational == pytest.approx(1, abs=1e-9)
    assert run.max_overlap < 1e-13


def carnahan_starling(y):
    return (1 + y + y**2 - y**3) / (1 - y) ** 3


def henderson(y):
    return (1 + y * y / 8) / (1 - y) ** 2


@pytest.mark.parametrize("density", [0.3, 0.7])
def test_pressure_of_spheres(density):
    side = (2000 / density) ** (1 / 3)
    _gas, run = simulate_gas([Species(SPHERE, 2000)], (side,) * 3, contacts=SMOOTH, max_events=600_000)
    assert run.pressure / density == pytest.approx(carnahan_starling(density * math.pi / 6), rel=4e-3)


@pytest.mark.parametrize("share", [0.3, 0.45])
def test_pressure_of_discs(share):
    side = math.sqrt(2000 * math.pi / 4 / share)
    _gas, run = simulate_gas([Species(DISC, 2000)], (side,) * 2, contacts=SMOOTH, max_events=600_000)
    assert run.pressure / (2000 / side**2) == pytest.approx(henderson(share), rel=5e-3)


def test_pressure_on_the_walls_is_that_of_the_virial():
    _gas, run = simulate_gas(
        [Species(SPHERE, 3000)], (40.0, 35.0, 30.0), contacts=SMOOTH, periodic=False, max_events=600_000
    )
    assert run.wall_collisions > 20_000
    # the virial of the walls: they act on centres that have a diameter less of room
    inner = np.repeat([39 / 40, 34 / 35, 29 / 30], 2)
    assert np.mean([*run.wall_pressure.values()] * inner) == pytest.approx(run.pressure, rel=3e-3)
    assert np.ptp([*run.wall_pressure.values()]) < 0.1 * run.pressure


@pytest.mark.parametrize("ball", [SPHERE, DISC])
def test_rough_balls_share_their_energy_with_the_spins(ball):
    flat = ball is DISC
    side = (50.0, 40.0) if flat else (14.0, 12.0, 13.0)
    gas = Gas([Species(ball, 1200, temperature=1.0, temperature_rotational=0.0)], side, contacts=ROUGH, seed=1)
    assert gas.energy()[1] == 0
    gas.run(100_000)
    run = gas.run(400_000)
    # (discs: two translations to one spin)
    assert run.temperature_translational == pytest.approx(2 / 3 if flat else 1 / 2, rel=0.02)
    assert run.temperature_rotational == pytest.approx(run.temperature_translational, rel=0.04)
    assert abs(run.energy_drift) < 1e-12
    assert np.abs(gas.balls().velocity.sum(axis=0)).max() < 1e-9


def test_a_mixture_shares_its_energy():
    species = [
        Species(Ball(0.5, 1.0, 0.4), 600, "a", 2.0, 0.0),
        Species(Ball(0.3, 0.2, 0.6), 900, "b", 0.5, 0.0),
    ]
    gas = Gas(species, (14.0, 13.0, 12.0), contacts=ROUGH, seed=2)
    gas.run(150_000)
    shares = []
    for _ in range(20):
        gas.run(10_000)
        balls = gas.balls()
        square = (balls.velocity**2).sum(axis=1)
        shares.append([mass * square[balls.species == k].mean() for k, mass in ((0, 1.0), (1, 0.2))])
    first, second = np.mean(shares, axis=0)
    assert first == pytest.approx(second, rel=0.05)


@pytest.mark.slow
def test_no_drift_over_a_long_run():
    gas = Gas([Species(SPHERE, 200)], (8.0, 7.0, 7.0), contacts=ROUGH, periodic=(True, False, True))
    run = gas.run(4_000_000)
    assert abs(run.energy_drift) < 1e-11
    assert run.max_overlap < 1e-13


def test_inelastic_gas_cools_as_haff_says():
    e, n, size = 0.95, 2000, 34.2  # a density of 0.05
    gas = Gas([Species(SPHERE, n)], (size,) * 3, contacts=Surface(e, 0, 0), seed=4)
    gas.run(20 * n)
    begin, time = gas.energy()[0], gas.time
    # T' = -(1 - e^2)/3 * nu * T (d = 3, Maxwellian): with nu ~ sqrt(T), 1/sqrt(T) grows linearly
    gas.run(2 * n)
    rate = 2 * 2 * n / n / (gas.time - time)  # collisions a ball and time
    mean = math.sqrt(gas.energy()[0] / begin)
    until = 5 / ((1 - e * e) / 6 * rate / math.sqrt(mean))
    gas.run(until=time + until)
    assert math.sqrt(begin / gas.energy()[0]) == pytest.approx(6, rel=0.06)


@pytest.mark.parametrize("periodic", [True, False])
def test_the_channels_account_for_all_energy(periodic):
    species = [Species(Ball(0.5, 1.0, 0.4), 150, "a"), Species(Ball(0.3, 0.2, 0.6), 150, "b", 2.0, 0.5)]
    contacts = {
        ("a", "a"): Surface(0.9, 0.3, 0.5), ("a", "b"): Surface(0.8, math.inf, 0.0), ("b", "b"): Surface(0.7, 0.0, -1.0),
        ("a", "wall"): Surface(0.6, 0.5, 0.2), ("b", "wall"): Surface(1.0, math.inf, 1.0),
    }  # fmt: skip
    gas = Gas(species, (9.0, 8.0, 7.0), contacts=contacts, periodic=periodic, seed=5)
    mark = gas.mark()
    gas.advance(3000)
    run, end = gas.measured_since(mark), gas.energy()
    pairs, walls = gas.arrays.materials.pairs, gas.arrays.walls.contacts
    assert pairs["collisions"].sum() == run.pair_collisions
    assert walls["collisions"].sum() == run.wall_collisions
    for name in ("lost_normal", "lost_tangential"):
        assert (pairs[name] > 0).tolist() == [True, True, True, name == "lost_normal"], name
    lost = sum(float(part[name].sum()) for part in (pairs, walls) for name in ("lost_normal", "lost_tangential"))
    assert lost == pytest.approx(sum(mark.energy) - sum(end), rel=1e-12)
    spun = float(pairs["to_spin"].sum() + walls["to_spin"].sum())
    assert spun == pytest.approx(end[1] - mark.energy[1], rel=1e-11)


def test_starts():
    rng = np.random.default_rng(0)
    mass = np.array([1.0, 2.0, 3.0, 0.5] * 50)
    v = thermal(mass, (0, 1, 2), 0.7, rng)
    assert np.abs(mass @ v).max() < 1e-12
    assert (mass[:, None] * v * v).sum() == pytest.approx(3 * 200 * 0.7, rel=1e-14)
    x = scattered(np.full(500, 0.5), (10.0, 10.0, 10.0), (True, False, True), rng)
    assert ((x >= 0) & (x <= 10)).all()
    assert ((x[:, 1] >= 0.5) & (x[:, 1] <= 9.5)).all()
    gas = Gas([Species(SPHERE, 500)], (10.0,) * 3, contacts=SMOOTH, periodic=(True, False, True), position=x)
    assert gas.run(1000).max_overlap < 1e-13
    with pytest.raises(CaromError, match="random insertion"):
        scattered(np.full(500, 0.5), (7.0, 7.0, 7.0), True, rng)
    assert len(np.unique(lattice(1000, (12.0, 12.0)), axis=0)) == 1000


def test_a_run_whose_next_collision_is_far_away_can_be_stopped():
    gas = Gas([Species(Ball(0.5, 1.0), 2)], (1e7, 1e7, 1e7), contacts=Surface(1, 0, -1), seed=1)
    asked = []
    gas.advance(1000, stop=lambda: asked.append(gas.collisions) or len(asked) > 1)
    assert gas.collisions < 1000
    assert len(asked) <= 4


def test_a_thermostat_that_lets_no_ball_move_is_refused():
    with pytest.raises(
        CaromError, match=r"^Gas: contacts: expected a carom.Surface \(no custom law\), or one for each pair"
    ):
        Gas([Species(SPHERE, 20)], (5.0,) * 3)
    with pytest.raises(
        CaromError, match=r"thermostat.rate: expected at most 1e.06 thermal speeds per radius .* lower it"
    ):
        Gas(
            [Species(Ball(0.5, 1.0), 8)],
            (6, 6, 6),
            contacts=Surface(1, 0, -1),
            thermostat=Thermostat(temperature=1.0, rate=1e15),
        )


def test_progress_and_an_interrupt_between_chunks():
    gas = Gas([Species(SPHERE, 100)], (6.0,) * 3, contacts=SMOOTH)
    seen = []

    def stop(*said):
        seen.append(said)
        if len(seen) == 3:
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        gas.run(10_000, progress=stop, chunk=100)
    assert seen == [(done, 10_000, "collisions") for done in (100, 200, 300)]
    whole = Gas([Species(SPHERE, 100)], (6.0,) * 3, contacts=SMOOTH)
    whole.run(1000)
    gas.run(700)
    assert gas.balls().position.tobytes() == whole.balls().position.tobytes()
