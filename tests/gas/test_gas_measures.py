"""What is measured of a gas, against what is known of gases."""

from __future__ import annotations

import math

import numpy as np
import pytest
from reference.drawn_options import random_gas

from carom import Ball, CaromError, Disc, Surface
from carom.gas import Drive, Gas, Species, container, lattice
from carom.gas.containers import CONTAINERS, CURVE
from carom.gas.measures import Measures, PairCorrelation, mean_square_displacement
from carom.gas.report import channels
from carom.gas.results import volume_within

SMOOTH, ROUGH = Surface(1, 0, -1), Surface(1, math.inf, 1)
SPHERE, DISC = Ball(0.5, 1.0, 0.4), Disc(0.5, 1.0, 0.5)


def looked(gas: Gas, looks: int, apart: float, *, pairs: int = 1, **options) -> Measures:
    measures = Measures(gas, **options)
    begin = gas.time
    for k in range(looks):
        gas.advance(until=begin + apart * (k + 1))
        measures.sample(gas, pairs=k % pairs == 0)
    return measures


@pytest.fixture(scope="module")
def dense():
    """Smooth hard spheres at a density of 0.5."""
    gas = Gas([Species(SPHERE, 4000)], (20.0,) * 3, contacts=SMOOTH, seed=11)
    gas.run(160_000)
    mark = gas.mark()
    return gas, looked(gas, 60, 1.2, pairs=2), gas.measured_since(mark)


def test_g_in_contact_is_not_given_for_few_pairs():
    """A parabola through the logarithms of some counts ends anywhere: 0.02 ± 0.07 for 1."""
    distance, unit = 1.0 + 0.01 * (np.arange(40) + 0.5), np.full(40, 0.3)
    counts = np.zeros(40)
    counts[[2, 3, 7, 11, 13, 18, 19, 22, 24]] = [2, 4, 2, 2, 4, 2, 2, 4, 2]
    few = PairCorrelation(distance, counts * unit, np.sqrt(2 * counts) * unit, 1.0, unit)
    assert math.isnan(few.contact)
    assert math.isnan(few.contact_error)
    many = PairCorrelation(
        distance, np.full(40, 900 * 1e-3), np.sqrt(2 * 900) * np.full(40, 1e-3), 1.0, np.full(40, 1e-3)
    )
    assert many.contact == pytest.approx(0.9)
    assert 0 < many.contact_error < 0.1


@pytest.mark.parametrize("shape", CONTAINERS)
@pytest.mark.slow(keep=8)
def test_volumes_within_containers_are_those_of_every_point_of_the_lattice(shape):
    """Against all of a million points, one by one, where walls are few; along curves against the area."""
    room = random_gas(list(CONTAINERS).index(shape), shape).container.geometry
    size, curved = np.array(room.size), any(face.form == CURVE for face in room.faces)
    if curved:
        assert volume_within(room, 0.0) == pytest.approx(room.volume, rel=4e-3)  # of the lattice
        return
    n = round(1e6 ** (1 / len(size)))
    x = np.zeros((n ** len(size), 3))
    x[:, : len(size)] = (np.indices([n] * len(size)).reshape(len(size), -1).T + 0.5) / n * size
    gap = room.clearance(0.0, x) if room.faces else np.full(len(x), math.inf)
    for depth in (0.0, 0.013 * size.min(), 0.21 * size.min()):
        assert volume_within(room, depth) == pytest.approx(size.prod() * (gap >= depth).mean(), rel=1e-3)


# --- pair correlation ----------------------------------------------------------------------------------------------


@pytest.mark.slow
def test_g_in_contact_is_that_of_carnahan_and_starling_and_of_the_collisions(dense):
    gas, measures, run = dense
    one = measures.pair_correlation("a", "a")
    phi = math.pi / 12
    # g(sigma) = (1 - phi/2) / (1 - phi)^3; the errors of the counts near contact leave some 0.7 %
    assert one.contact == pytest.approx((1 - phi / 2) / (1 - phi) ** 3, rel=0.02)
    # the same from the rate of collisions: 1 / t0 = 4 sqrt(pi) n sigma^2 g sqrt(T / m), here within the error of g's own
    assert one.contact == pytest.approx(1 / (run.mean_free_time * 4 * math.sqrt(math.pi) * 0.5), rel=0.015)
    assert one.g[-30:].mean() == pytest.approx(1, abs=0.003)
    assert one.distance[0] == pytest.approx(1 + 1 / 120)
    # the number of neighbours within a shell is the integral of g
    x = gas.balls().position
    r = x[:400, None] - x[None]
    r -= 20 * np.round(r / 20)
    near = (np.sqrt((r * r).sum(axis=2)) < 2).sum(axis=1).mean() - 1
    shells = 4 / 3 * np.pi * np.diff((1 + np.arange(61) / 60) ** 3)
    assert (one.g[:60] * shells).sum() * 0.5 == pytest.approx(near, rel=0.02)


def test_g_of_discs_in_contact():
    # Henderson: g = (1 - 7 phi / 16) / (1 - phi)^2
    share = 0.4
    side = math.sqrt(2000 * math.pi / 4 / share)
    gas = Gas([Species(DISC, 2000)], (side,) * 2, contacts=ROUGH, seed=2)
    gas.run(100_000)
    measures = looked(gas, 60, 2.0)
    assert measures.pair_correlation("a", "a").contact == pytest.approx(
        (1 - 7 * share / 16) / (1 - share) ** 2, rel=0.02
    )


def test_g_by_counting_all_pairs():
    species = [Species(SPHERE, 60, "a"), Species(Ball(0.3, 0.3, 0.4), 90, "b")]
    gas = Gas(species, (7.0, 6.5, 8.0), contacts=SMOOTH, seed=5)
    gas.run(3000)
    measures = looked(gas, 1, 0.3, names=("a", "b"))
    balls = gas.balls()
    side = np.array([7.0, 6.5, 8.0])
    r = balls.position[:, None] - balls.position[None]
    r -= side * np.round(r / side)
    far = np.sqrt((r * r).sum(axis=2))
    np.fill_diagonal(far, np.inf)
    for i, j in ((0, 0), (0, 1), (1, 1)):
        one = measures.pair_correlation("ab"[i], "ab"[j])
        distances = far[balls.species == i][:, balls.species == j].ravel()
        width = one.distance[1] - one.distance[0]
        edges = np.concatenate([one.distance - width / 2, one.distance[-1:] + width / 2])
        edges[0] -= 1e-9
        found, _ = np.histogram(distances, edges)
        pairs = (balls.species == i).sum() * ((balls.species == j).sum() - (i == j))
        expected = pairs * 4 / 3 * np.pi * np.diff(edges**3) / side.prod()
        assert one.g * expected == pytest.approx(found, abs=1e-4)
        assert one.contact_distance == pytest.approx([1.0, 0.8, 0.6][i + j])


@pytest.mark.parametrize("shape", ["box", "sphere", "cylinder"])
def test_g_of_an_ideal_gas_within_walls_is_one(shape):
    # very small balls know nothing of each other, but the walls must not show
    side = 10.0
    sizes = {
        "box": {"size": (side,) * 3},
        "sphere": {"radius": side / 2},
        "cylinder": {"radius": side / 2, "height": side},
    }
    room = container(shape, **sizes[shape])
    gas = Gas([Species(Ball(0.15, 1.0, 0.4), 3000)], room, contacts=SMOOTH, seed=3)
    gas.run(60_000)
    measures = looked(gas, 20, 1.0, container=room)
    one = measures.pair_correlation("a", "a")
    assert measures.inner < room.volume
    assert one.g[20:].mean() == pytest.approx(1, abs=0.02)
    assert not measures.has_diffusion


@pytest.mark.parametrize("shape", ["box", "cylinder"])
@pytest.mark.slow(keep=1)
def test_g_under_gravity_between_side_walls_tends_to_one(shape):
    # centres reach only 9.4 of 10 across: the mean density over a whole slice is an eighth too low
    sizes = {"size": (10.0, 10.0, 30.0)} if shape == "box" else {"radius": 5.0, "height": 30.0}
    room = container(shape, **sizes)
    gas = Gas([Species(Ball(0.3, 1.0), 1500)], room, contacts=SMOOTH, gravity=(0, 0, -0.05), seed=3)
    gas.run(30_000)
    measures = looked(gas, 40, 1.0, container=room)
    one = measures.pair_correlation("a", "a")
    assert measures.is_layered
    assert one.g[one.distance > 1.2].mean() == pytest.approx(1, abs=0.01)
    # the profile is per volume of the container: it adds up to all balls
    found = measures.profile("a")
    assert (found.density * room.volume / len(found.density)).sum() == pytest.approx(1500, rel=0.006)


# --- distributions -------------------------------------------------------------------------------------------------


def test_velocities_are_maxwellian(dense):
    _gas, measures, _run = dense
    one = measures.velocity("a")
    assert one.density.sum() * 0.1 == pytest.approx(1, abs=1e-9)
    assert (one.density * one.center**2).sum() * 0.1 == pytest.approx(1 + 0.1**2 / 12, rel=1e-3)
    assert one.a2 == pytest.approx(0, abs=0.006)
    # chi square a bin, of those with many counts
    many = one.density > 1e-3
    assert (((one.density - one.maxwell)[many] / one.error[many]) ** 2).mean() == pytest.approx(1, abs=0.4)
    assert math.isnan(measures.spin("a").a2) or measures.spin("a").a2 == pytest.approx(0, abs=0.01)


@pytest.mark.parametrize("ball", [SPHERE, DISC])
def test_the_fourth_cumulant_of_what_is_no_maxwellian(ball):
    flat = ball is DISC
    rng = np.random.default_rng(1)
    side = (40.0, 40.0) if flat else (12.0,) * 3
    axes = len(side)
    # all have one speed: <c^4> = <c^2>^2, so a2 = d / (d + 2) - 1
    v = rng.normal(size=(900, axes))
    v /= np.sqrt((v * v).sum(axis=1))[:, None]
    v[450:] = -v[:450]  # as a whole they stay where they are
    w = rng.uniform(-1, 1, size=900) if flat else rng.uniform(-1, 1, size=(900, 3))
    x = lattice(900, side)[:, :axes]
    gas = Gas([Species(ball, 900)], side, contacts=SMOOTH, position=x, velocity=v, spin=w)
    measures = Measures(gas)
    measures.sample(gas)
    assert measures.velocity("a").a2 == pytest.approx(axes / (axes + 2) - 1, abs=1e-12)
    about = 1 if flat else 3
    square = w * w if flat else (w * w).sum(axis=1)
    assert measures.spin("a").a2 == pytest.approx(
        about / (about + 2) * (square**2).mean() / square.mean() ** 2 - 1, abs=1e-12
    )
    translational, rotational = measures.temperature("a")
    assert translational == pytest.approx(1 / axes)
    assert rotational == pytest.approx(ball.moment * square.mean() / about)


def test_a_cooling_gas_is_no_maxwellian_and_its_spins_lag_behind():
    # van Noije & Ernst: a2 = 16 (1 - e)(1 - 2 e^2) / (81 - 17 e + 30 e^2 (1 - e)); at e = 0.6: 0.0174..., smooth
    e = 0.6
    gas = Gas([Species(SPHERE, 8000)], (60.0,) * 3, contacts=Surface(e, 0, 0), seed=8)
    gas.run(60_000)
    measures = Measures(gas)
    for _ in range(12):
        gas.advance(6000)
        measures.sample(gas, pairs=False)
    known = 16 * (1 - e) * (1 - 2 * e * e) / (81 - 17 * e + 30 * e * e * (1 - e))
    assert measures.velocity("a").a2 == pytest.approx(known, abs=0.012)
    assert measures.velocity("a").a2 > 0.003
    t = measures.series["translational"]
    assert (np.diff(t) < 0).all()


def test_names_are_checked():
    gas = Gas([Species(SPHERE, 30)], (5.0,) * 3, contacts=SMOOTH)
    with pytest.raises(CaromError, match="expected a species, got 'b'; known are a"):
        Measures(gas).velocity("b")


# --- motion --------------------------------------------------------------------------------------------------------


def test_diffusion_of_hard_spheres(dense):
    _gas, measures, _run = dense
    moved = measures.displacement()
    # 0.247 for large systems, at a density of 0.5; this run's error is 2 %
    assert moved.diffusion == pytest.approx(0.247, rel=0.05)
    assert moved.lag[-1] == pytest.approx(35, abs=1)
    assert (np.diff(moved.square) > 0).all()


def test_displacements_go_round_the_box_and_not_with_the_whole():
    # layers that slide over each other, so that no two balls ever meet, and all drift
    x = lattice(64, (20.0,) * 3)
    v = np.zeros((64, 3))
    v[:, 0] = 5.0
    v[:, 1] = np.where(x[:, 2] < 10, 1.0, -1.0)
    assert v[:, 1].sum() == 0
    gas = Gas([Species(Ball(0.01, 1.0, 0.4), 64)], (20.0,) * 3, contacts=SMOOTH, position=x, velocity=v)
    measures = looked(gas, 12, 7.0)
    moved = measures.displacement()
    # all of a lag have the same: t^2, 5 t along x taken out
    lags = np.round(moved.lag / 7)
    assert moved.square == pytest.approx((7 * lags) ** 2, rel=1e-9)
    assert gas.collisions == 0
    assert np.abs(gas.balls().images).max() >= 20


def test_mean_square_displacement_of_frames():
    rng = np.random.default_rng(4)
    steps = rng.normal(size=(400, 50, 3))
    x = np.cumsum(steps, axis=0)
    found = mean_square_displacement(x)
    assert found[0] == 0
    assert found[1:20] == pytest.approx(3 * np.arange(1, 20) * (1 - 1 / 50), rel=0.03)
    weights = rng.uniform(1, 2, size=50)
    drift = np.linspace(0, 100, 400)[:, None, None] * np.ones(3)
    assert mean_square_displacement(x + drift, weights) == pytest.approx(mean_square_displacement(x, weights), rel=1e-9)


def test_the_error_of_g_in_contact_is_that_of_repeated_runs():
    """It was printed with three decimals where the second one was noise."""
    found = []
    for seed in range(24):
        gas = Gas([Species(SPHERE, 200)], (10.0,) * 3, contacts=SMOOTH, seed=seed)
        gas.advance(4000)
        found.append(looked(gas, 20, 1.0).pair_correlation("a", "a"))
    contact, error = (np.array([getattr(one, name) for one in found]) for name in ("contact", "contact_error"))
    assert error.mean() == pytest.approx(contact.std(ddof=1), rel=0.4)
    phi = 0.2 * math.pi / 6
    assert abs(contact.mean() - (1 - phi / 2) / (1 - phi) ** 3) < 4 * error.mean() / math.sqrt(24)


# --- profiles ------------------------------------------------------------------------------------------------------


def test_density_falls_with_height_and_g_is_relative_to_it():
    """A dilute elastic gas under gravity: n = n0 exp(-m g y / T), T everywhere the same, and no correlation at a distance."""
    gas = Gas([Species(Disc(0.02, 1.0, 0.5), 1000)], (40.0, 12.0), periodic=(True, False), contacts=SMOOTH,
              gravity=(0, -1.0), seed=4)  # fmt: skip
    gas.run(60_000)
    measures = looked(gas, 60, 2.0)
    found = measures.profile("a")
    width = 12.0 / len(found.density)
    assert found.axis == "y"
    assert (found.density * width * 40.0).sum() == pytest.approx(1000, rel=1e-12)
    warm = measures.temperature("a")[0]
    low = (found.middle > 0.5) & (found.middle < 8)
    slope = np.polyfit(found.middle[low], np.log(found.density[low]), 1, w=np.sqrt(found.density[low]))[0]
    assert slope == pytest.approx(-1 / warm, rel=0.05)
    assert found.temperature[low].mean() == pytest.approx(warm, rel=0.05)
    g = measures.pair_correlation("a", "a")
    far = g.distance > 0.06
    assert (g.g[far] * g.distance[far]).sum() / g.distance[far].sum() == pytest.approx(1, abs=0.06)  # (was about 2)


def test_profiles_lie_along_gravity_or_across_driven_walls_and_need_walls():
    side, contacts = (6.0, 7.0, 8.0), {("a", "a"): SMOOTH, ("a", "wall"): SMOOTH}

    def profiles(**options):
        return Measures(Gas([Species(SPHERE, 20)], side, contacts=contacts, **options)).profiles

    assert (profiles(periodic=False).axis, profiles(periodic=False).layered) == (0, False)
    pulled = profiles(periodic=False, gravity=(0, 0, -1.0))
    assert (pulled.axis, pulled.layered) == (2, True)
    shaken = profiles(periodic=(True, False, False), drives={"top": Drive(amplitude=0.1, frequency=1.0)})
    assert (shaken.axis, shaken.layered) == (2, True)
    heated = profiles(periodic=False, drives={"front": Drive(temperature=2.0)})
    assert (heated.axis, heated.layered) == (1, True)
    without = Measures(Gas([Species(SPHERE, 20)], side, contacts=SMOOTH))
    with pytest.raises(CaromError, match=r"^Measures.profile: expected a gas between walls, got one without"):
        without.profile("a")


# --- what contacts did ---------------------------------------------------------------------------------------------


@pytest.mark.slow
def test_rates_of_collisions_by_species():
    # a dilute mixture: the rate of ball 1 with species 2 is n2 pi s12^2 sqrt(8 T / (pi mu)), g from the mixture's density
    small = Ball(0.3, 0.5, 0.4)
    gas = Gas([Species(SPHERE, 1500), Species(small, 2500, "b")], (60.0,) * 3, contacts=SMOOTH, seed=6)
    gas.run(80_000)
    mark = gas.mark()
    gas.advance(400_000)
    rows = {row.between: row for row in channels(gas, mark, ("a", "b"))}
    assert set(rows) == {("a", "a"), ("a", "b"), ("b", "b")}
    assert sum(row.collisions for row in rows.values()) == 400_000
    volume, temperature = 60.0**3, gas.measured_since(mark).temperature_translational
    for between, other, s, reduced in (("aa", 1500, 1.0, 0.5), ("ab", 2500, 0.8, 1 / 3), ("bb", 2500, 0.6, 0.25)):
        rate = other / volume * math.pi * s * s * math.sqrt(8 * temperature / (math.pi * reduced))
        # (g in contact is a few thousandths above one)
        assert rows[between[0], between[1]].rate == pytest.approx(rate, rel=0.03), between
    for row in rows.values():
        assert (row.lost_normal, row.lost_tangential, row.to_spin) == (0, 0, 0)


def test_walls_count_for_themselves():
    room = container("cylinder", radius=6.0, height=8.0)
    gas = Gas([Species(SPHERE, 200)], room, contacts={("a", "a"): SMOOTH, ("a", "wall"): Surface(0.9, 0.2, 0)}, seed=1)
    mark = gas.mark()
    gas.advance(5000)
    rows = {row.between[1]: row for row in channels(gas, mark, ("a",))}
    assert set(rows) == {"a", "side", "bottom", "top"}
    run = gas.measured_since(mark)
    assert sum(rows[name].collisions for name in ("side", "bottom", "top")) == run.wall_collisions
    lost = sum(row.lost_normal + row.lost_tangential for row in rows.values())
    assert lost == pytest.approx(sum(mark.energy) - sum(gas.energy()), rel=1e-10)
    assert rows["a"].lost_normal == 0 < rows["side"].lost_tangential
