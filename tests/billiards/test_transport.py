"""Mean flights, corridors, diffusion, recurrence, escape rates and errors of drifts against closed forms and an own simulation."""

from __future__ import annotations

import math

import numpy as np
import pytest
from reference.lorentz_gas import machta_zwanzig, measured_diffusion

import carom
from carom import billiards

STATISTICAL = 4.0  # standard errors


def triangular(w: float) -> billiards.Table:
    """Return two discs of radius 1 in the rectangle of a triangular lattice with gaps w."""
    a = 2 + w
    b = a * math.sqrt(3)
    return billiards.torus((a, b), [(-a / 4, -b / 4, 1.0), (a / 4, b / 4, 1.0)])


@pytest.mark.parametrize(
    ("table", "area", "length"),
    [
        (billiards.stadium(2.0, 1.0), 4 + math.pi, 4 + math.tau),
        (billiards.stadium(2.0, 1.0, bounds="surface"), 3.6 + 0.81 * math.pi, 4 + 1.8 * math.pi),
        (billiards.sinai(0.3), 1 - 0.09 * math.pi, 0.6 * math.pi),
        (billiards.periodic_strip(1.0, 1.0, [(0, 0, 0.2)]), 1 - 0.04 * math.pi, 2 + 0.4 * math.pi),
        (billiards.polygon([(0, 0), (2, 0), (1, 0.5), (0, 2)]), 1.5, 2 + math.sqrt(1.25) + math.sqrt(3.25) + 2),
        (billiards.strip(2.0), 2.0, 2.0),
    ],
    ids=lambda one: getattr(one, "name", ""),
)
def test_mean_flights_are_exact(table: billiards.Table, area: float, length: float) -> None:
    bounce, spins = billiards.mean_flight(table, law="mirror", speed=2.0), billiards.mean_flight(table, speed=2.0)
    assert bounce.path == spins.path == pytest.approx(math.pi * area / length, rel=1e-12)
    assert bounce.time == pytest.approx(math.pi * area / length / 2, rel=1e-12)
    assert spins.time == pytest.approx(4 * area / length / 2, rel=1e-12)
    assert billiards.mean_flight(table, law="rolling").time == pytest.approx(
        4 * math.sqrt(1.5) * area / length, rel=1e-12
    )


def test_mean_flights_in_space() -> None:
    assert billiards.mean_flight(billiards.sphere(1.0)).path == pytest.approx(4 / 3)
    assert billiards.mean_flight(billiards.box((1, 2, 3)), law="mirror").path == pytest.approx(24 / 22)
    assert billiards.mean_flight(billiards.cylinder(1.0, 2.0)).path == pytest.approx(8 * math.pi / (6 * math.pi))
    # six components share the energy: 15 pi/8 V/S
    assert billiards.mean_flight(billiards.plates(1.0)).time == pytest.approx(15 * math.pi / 16)


@pytest.mark.parametrize("law", ["mirror", "no-slip"])
def test_orbits_have_the_mean_flights(law: str) -> None:
    for table in (billiards.stadium(), billiards.sinai(0.52), billiards.table("limacon")):
        start = billiards.starts(table, 200, seed=2, law=law, spins=law == "no-slip")
        run = billiards.orbit(table, start, 400, law=law)
        times, paths = run.last[:, 0] / 400, np.linalg.norm(np.diff(run.position, axis=1), axis=-1).mean(1)
        for seen, expected in zip((paths, times), billiards.mean_flight(table, law=law), strict=True):
            assert abs(seen.mean() - expected) < STATISTICAL * seen.std() / math.sqrt(len(seen))


def test_starts_without_spin_have_one_speed_and_the_same_directions() -> None:
    table = billiards.cylinder(1.0, 2.0)
    start = billiards.starts(table, 4000, seed=1, law="mirror", speed=3.0, spins=False)
    run = billiards.orbit(table, start, 1, law="mirror")
    assert not np.any(start.spin)
    assert np.allclose(np.linalg.norm(start.velocity, axis=1), 3.0, rtol=1e-14)
    # Lambert's law: the square of the sine to the normal is uniform
    square = np.sort(1 - (run.across[:, 0] / 3.0) ** 2)
    assert np.abs(square - (np.arange(4000) + 0.5) / 4000).max() < 1.95 / math.sqrt(4000)


def test_corridors_of_lattices() -> None:
    assert billiards.corridors(triangular(0.3)) == []
    for one in (found := billiards.corridors(triangular(0.4))):
        assert one.width == pytest.approx(1.2 * math.sqrt(3) - 2, rel=1e-12)
    assert sorted(one.cells for one in found) == [(1, -1), (1, 0), (1, 0), (1, 1)]
    # a square lattice: corridors of the direction (p, q) are 1/sqrt(p^2 + q^2) - 2 r wide
    seen = {one.cells: one.width for one in billiards.corridors(billiards.sinai(0.15))}
    directions = [(1, 0), (0, 1)] + [(p, k * q) for p, q in ((1, 1), (1, 2), (2, 1), (1, 3), (3, 1)) for k in (1, -1)]
    assert seen == pytest.approx({(p, q): 1 / math.hypot(p, q) - 0.3 for p, q in directions})
    assert billiards.corridors(billiards.periodic_strip(1.0, 1.0, [(0, 0.1, 0.3)]))[0].width == pytest.approx(0.6)


def test_diffusion_of_the_triangular_lorentz_gas() -> None:
    # an own simulation, of 2,000 particles: D(0.1) = 0.1003(11), D(0.3) = 0.2501(28)
    for w, d, error in ((0.1, 0.1003, 0.0011), (0.3, 0.2501, 0.0028)):
        found = billiards.diffusion(triangular(w), 300, 1500, law="mirror", seed=3)
        assert abs(found.coefficient - d) < STATISTICAL * math.hypot(found.error, error)
        assert abs(found.exponent - 1) < STATISTICAL * found.exponent_error + 0.01
        assert np.allclose(found.tensor, found.tensor.T, atol=0)
        assert abs(found.tensor[0, 1]) < STATISTICAL * found.tensor_error[0, 1]
        assert found.corridors == ()
    # for narrow gaps a particle forgets how it came in
    narrow = billiards.diffusion(triangular(0.01), 300, 6000, law="mirror", window=400.0)
    assert abs(narrow.coefficient - machta_zwanzig(0.01)) < STATISTICAL * narrow.error
    # the ball of radius 0.3 among discs of radius 0.7 is the same particle
    a, b = 2.3, 2.3 * math.sqrt(3)
    table = billiards.torus((a, b), [(-a / 4, -b / 4, 0.7), (a / 4, b / 4, 0.7)], bounds="surface")
    same = billiards.diffusion(table, 300, 1500, law="mirror", seed=3, ball=carom.Disc(0.3))
    assert same.coefficient == pytest.approx(found.coefficient, rel=1e-2)


def test_the_own_simulation_agrees_in_small() -> None:
    d, error = measured_diffusion(0.3, 100, 2, 20.0)
    assert abs(d - 0.2501) < STATISTICAL * error


def test_diffusion_says_what_cannot_be_measured() -> None:
    assert "grows as ln t" in billiards.diffusion(billiards.sinai(0.3), 10, 300, law="mirror").describe()
    strip = billiards.diffusion(billiards.periodic_strip(), 10, 300, law="mirror")
    assert strip.tensor.shape == (1, 1)
    for words, arguments in (
        ("a periodic cell", {"table": billiards.circle()}),
        ("a whole number >= 2", {"table": triangular(0.2), "orbits": 1}),
        ("bounces for two windows", {"table": triangular(0.2), "orbits": 5, "bounces": 10}),
        ("a time > 0 s", {"table": triangular(0.2), "window": -1.0}),
        ("a law that keeps the energy", {"table": triangular(0.2), "law": "contact", "surface": carom.Surface(0.5)}),
    ):
        with pytest.raises(carom.CaromError, match=words) as error:
            billiards.diffusion(**arguments)
        assert "\n" not in str(error.value)


def test_recurrence_follows_kac() -> None:
    table = billiards.stadium()
    run = billiards.orbit(table, billiards.starts(table, 300, seed=4), 500)
    back = billiards.recurrence(run, [(0.5, 1.0), (-0.2, 0.1)])
    assert abs(back.mean - (4 + math.tau) / 0.8) < STATISTICAL * back.error
    # of one orbit in a circle all returns follow from its rotation by 2 of 2 pi
    turn = 2.0
    start = (math.cos(0.1), math.sin(0.1)), (-math.sin(0.1 + turn / 2), math.cos(0.1 + turn / 2)), 0.0
    run = billiards.orbit(billiards.circle(), start, 1000, law="mirror")
    visits = np.flatnonzero((0.1 + turn * np.arange(1, 1001)) % math.tau < 0.5)
    back = billiards.recurrence(run, [(0.0, 0.5)])
    assert back.bounces.tolist() == np.diff(visits).tolist()
    assert np.allclose(back.time, 2 * math.sin(turn / 2) * back.bounces)
    assert math.isnan(back.error)
    share, error = back.survival([0, 10**6])
    assert share.tolist() == [1.0, 0.0]
    assert error.tolist() == [0.0, 0.0]
    same = billiards.recurrence(run, run.position[:, 0] > math.cos(0.25))
    assert same.mean == 1000 / int((run.position[:, 0] > math.cos(0.25)).sum())
    with pytest.raises(carom.CaromError, match=r"recurrence: visits: expected a hole in the wall"):
        billiards.recurrence(run, [(7.0, 8.0)])


def test_a_small_hole_lets_orbits_out_at_its_share_of_the_flow() -> None:
    # the rate is h v/(pi A) to first order in h/L, here 0.8 %
    table, hole = billiards.sinai(0.4), 0.02
    start = billiards.starts(table, 2000, seed=6, law="mirror", speed=2.0, spins=False)
    decay = billiards.escape(table, start, 800, holes=[(0.3, 0.3 + hole)], law="mirror").decay(after=6.0)
    assert decay.kind == "exponential"
    assert abs(decay.rate - hole * 2.0 / (math.pi * (1 - 0.16 * math.pi))) < STATISTICAL * decay.rate_error
    # islands of the no-slip law that the hole does not touch keep their orbits
    start = billiards.starts(table, 2000, seed=6)
    assert billiards.escape(table, start, 800, holes=[(0.3, 0.3 + hole)]).decay(after=30.0).rate < 0.7 * decay.rate / 2


def test_survival_in_a_circle_falls_as_one_over_time() -> None:
    table = billiards.circle()
    start = billiards.starts(table, 4000, seed=1, law="mirror", spins=False)
    found = billiards.escape(table, start, 300, holes=[(0.0, 1.0)], law="mirror")
    decay = found.decay(after=60, by="bounces")
    assert decay.kind == "power law"
    assert abs(decay.exponent - 1) < STATISTICAL * decay.exponent_error
    share, error = found.survival([0, 60, 240, 301], by="bounces")
    assert share[0] == 1.0
    assert math.isnan(share[3])
    assert abs(share[2] - share[1] / 4) < STATISTICAL * error[1]
    # exactly: the angle of an orbit turns by the same amount at each bounce
    angle = np.arctan2(*np.moveaxis(np.asarray(start.position)[:, ::-1], -1, 0))
    turn = 2 * np.arcsin(np.einsum("ni,ni->n", start.velocity, np.stack([-np.sin(angle), np.cos(angle)], -1)))
    there = (angle[:, None] + (np.pi - turn)[:, None] * np.arange(1, 301)) % math.tau
    assert found.escaped.tolist() == (there < 1.0).any(1).tolist()
    for words, arguments in (("two escapes or more between", {"after": 1e9}), ('"time" or "bounces"', {"by": "mass"})):
        with pytest.raises(carom.CaromError, match=words):
            found.decay(**arguments)


def test_errors_of_drifts_hold_the_truth() -> None:
    table = triangular(0.1)
    run = billiards.orbit(table, billiards.starts(table, 300, seed=3, law="mirror", spins=False), 1000, law="mirror")
    found = billiards.drift(run, 0)
    for value, error in ((found.velocity, found.velocity_error), (found.acceleration, found.acceleration_error)):
        inside = np.mean(np.abs(value) < error)
        assert abs(inside - 0.683) < STATISTICAL * math.sqrt(0.683 * 0.317 / 300)
    short = billiards.drift(billiards.orbit(billiards.strip(), ((0.0, 0.0), (0.7, 0.4), 0.9), 39), 0)
    assert math.isnan(short.velocity_error)
