"""Gases that cool for ever: over more orders of magnitude than anybody asks for, at any speed, in any frame; and their ends."""

from __future__ import annotations

import math

import numpy as np
import pytest

from carom import Ball, CaromError, Surface
from carom.gas import Gas, Measures, Session, Species, load_gas
from carom.gas.report import report

INELASTIC, ROUGH = Surface(0.6, math.inf, 1), Surface(1, math.inf, 1)
SCENE = """
[container]
shape = "periodic"
size = [6.0, 6.0, 6.0]
[[species]]
name = "a"
count = 50
radius = 0.5
mass = 1.0
[[contacts]]
between = ["a", "a"]
restitution = 0.6
friction = inf
tangential_restitution = 1.0
[run]
equilibrate = 500
max_events = 100_000
"""


def cooling(velocity=None, spin=None, **options):
    return Gas(
        [Species(Ball(0.5, 1.0, 0.4), 50)], (6.0,) * 3, contacts=INELASTIC, velocity=velocity, spin=spin, **options
    )


def relative(gas):
    """Twice the energy of the motion relative to the centre of mass, and that of the centre itself."""
    v = gas.balls().velocity
    return float(((v - v.mean(axis=0)) ** 2).sum()), len(v) * float((v.mean(axis=0) ** 2).sum())


COLD = """
container = {{shape = "periodic", size = [9.0, 9.0, 9.0]}}
species = [{{name = "a", count = 60, radius = 0.5, mass = 1.0, temperature = 1.0}}]
contacts = [{{between = ["a", "a"], restitution = 0.8, friction = inf, tangential_restitution = 0.3}}]
run = {{max_events = 3000, from_time = {begin}, seed = 2}}
"""


def test_a_free_gas_cools_over_150_orders_of_magnitude(tmp_path):
    # without the drift taken out, the balls fly side by side from the 28,000th collision on, and never meet again
    (tmp_path / "cool.toml").write_text(SCENE)
    session = Session(load_gas(tmp_path / "cool.toml"))
    assert session.run()
    gas, measures = session.gas, session.measures
    assert session.result.pair_collisions == 100_000
    apart, common = relative(gas)
    assert apart < 1e-145
    assert common < 1e-11 * apart
    # every collision takes the same share, at the end as at the beginning (Haff, in collisions instead of time) ...
    rows = measures.series
    hits, heat = rows["collisions"], np.log(rows["translational"])
    rates = [
        np.polyfit(hits[part], heat[part], 1)[0]
        for part in ((hits > 1e4 * k) & (hits < 1e4 * k + 2.5e4) for k in (0, 3, 6))
    ]
    assert rates == pytest.approx([np.mean(rates)] * 3, rel=0.05)
    # ... and the balls go as far from one to the next: the square of their way grows with the collisions, not with time
    events, square = measures.displacement_by_collisions()
    early, late = (np.polyfit(events[part], square[part], 1)[0] for part in (events < 5e4, events >= 5e4))
    assert 0.3 < late / early < 3
    assert not measures.is_stationary


def test_speed_has_no_scale():
    # 2^-300 and 2^100 times as fast is the same film, bit by bit
    films = []
    for scale in (1.0, 2.0**-300, 2.0**100):
        start = np.random.default_rng(5).normal(size=(2, 50, 3))
        start -= start.mean(axis=1, keepdims=True)
        gas = cooling(scale * start[0], scale * start[1])
        run = gas.run(20_000)
        balls = gas.balls()
        films.append(
            (balls.position, balls.velocity / scale, balls.spin / scale, gas.time * scale, run.mean_free_time * scale)
        )
    for film in films[1:]:
        for one, other in zip(films[0], film, strict=True):
            assert np.array_equal(one, other)


def test_a_gas_that_moves_as_a_whole_is_the_same_gas():
    drift = np.array([3.0, -7.0, 0.5])
    start = cooling(seed=2)
    v, w = start.balls().velocity, start.balls().spin
    options = {"contacts": ROUGH, "position": start.balls().position, "spin": w}
    still, moved = (Gas([Species(Ball(0.5, 1.0, 0.4), 50)], (6.0,) * 3, velocity=u, **options) for u in (v, v + drift))
    marks = [gas.mark() for gas in (still, moved)]
    for gas in (still, moved):
        gas.advance(100)
    assert moved.time == pytest.approx(still.time, rel=1e-9)
    one, two = still.balls(), moved.balls()
    assert np.abs(two.velocity - drift - one.velocity).max() < 1e-8
    way = one.position + 6.0 * one.images + drift * still.time
    assert np.abs(two.position + 6.0 * two.images - way).max() < 1e-8
    assert ((two.position >= 0) & (two.position <= 6)).all()
    # energy is that of all motion, temperature and pressure that of the motion within
    assert moved.energy()[0] == pytest.approx(still.energy()[0] + 50 * (drift**2).sum() / 2, rel=1e-12)
    for gas in (still, moved):
        gas.advance(20_000)
    runs = [gas.measured_since(mark) for gas, mark in zip((still, moved), marks, strict=True)]
    assert runs[0].temperature_translational == pytest.approx(runs[1].temperature_translational, rel=0.03)
    assert runs[0].pressure == pytest.approx(runs[1].pressure, rel=0.03)
    assert abs(runs[1].energy_drift) < 1e-12
    measures = Measures(moved)
    measures.sample(moved)
    assert measures.temperature("a")[0] == pytest.approx(relative(moved)[0] / 150, rel=1e-12)


def test_a_stream_between_smooth_walls_cools_within():
    # nothing stops what streams along them; without friction at the walls they leave the gas free along x and y
    v = np.random.default_rng(3).normal(size=(40, 3)) + np.array([20.0, 3.0, 0])
    gas = Gas(
        [Species(Ball(0.5, 1.0, 0.4), 40)], (6.0,) * 3, periodic=(True, True, False), velocity=v,
        contacts={("a", "a"): INELASTIC, ("a", "wall"): Surface(0.9, 0, 0)},
    )  # fmt: skip
    gas.run(100_000)
    assert gas.balls().velocity.mean(axis=0) == pytest.approx([*v.mean(axis=0)[:2], 0], abs=1e-9)
    measures = Measures(gas)
    measures.sample(gas)
    assert measures.temperature("a")[0] < 1e-60


def test_one_ball_alone_flies_as_it_is_told():
    gas = Gas(
        [Species(Ball(0.5, 1.0, 0.4), 1)], (6.0,) * 3, contacts=ROUGH, position=[[1, 2, 3]], velocity=[[1, -2, 0.25]]
    )
    gas.advance(until=10.0)
    balls = gas.balls()
    assert balls.velocity.tolist() == [[1, -2, 0.25]]
    assert balls.position + 6 * balls.images == pytest.approx(np.array([[11, -18, 5.5]]), abs=1e-12)


def test_the_same_bits_however_a_cooling_gas_is_cut():
    whole, parts = (cooling(np.random.default_rng(1).normal(size=(50, 3)) + 5.0) for _ in range(2))
    whole.advance(80_000)
    for chunk in (7, 1000, 77, 30_000):
        parts = Gas.restore(parts.state())
        parts.advance(20_000, chunk=chunk)
    assert relative(whole)[0] < 1e-26  # nothing can be told of it beside the drift of 5, and yet it is followed
    assert whole.time == parts.time
    for name in ("motions", "plans", "bodies"):
        assert whole.state()[name].tobytes() == parts.state()[name].tobytes()


# --- ends ----------------------------------------------------------------------------------------------------------


def test_balls_that_have_come_to_rest():
    # head on, without rebound: both stop
    options = {"position": [[1, 3, 3], [4, 3, 3]], "velocity": [[1, 0, 0], [-1, 0, 0]], "spin": np.zeros((2, 3))}
    gas = Gas([Species(Ball(0.5, 1.0, 0.4), 2)], (6.0,) * 3, contacts=Surface(0, 0, -1), **options)
    assert not gas.at_rest
    gas.advance(until=100.0)
    assert gas.time == 100.0
    assert gas.at_rest
    assert gas.energy() == (0.0, 0.0, 0.0)
    with pytest.raises(CaromError, match=r"expected a gas with collisions to come, got a gas at rest at t = 100\.0"):
        gas.run(1000)


@pytest.mark.parametrize("end", ["max_events = 1000", "duration = 50.0"])
def test_a_session_whose_balls_come_to_rest(tmp_path, end):
    (tmp_path / "two.csv").write_text("x,y,z,vx,vy,vz,wx,wy,wz\n1,3,3,1,0,0,0,0,0\n4,3,3,-1,0,0,0,0,0\n")
    text = SCENE.replace("count = 50", "count = 2").replace("= 0.6", "= 0").replace("= inf", "= 0")
    text = text.replace("tangential_restitution = 1.0\n", "").replace("equilibrate = 500", "equilibrate = 0")
    text = text.replace("max_events = 100_000", end) + 'start = "two.csv"\n'
    (tmp_path / "two.toml").write_text(text)
    session = Session(load_gas(tmp_path / "two.toml"))
    if "duration" in end:
        assert session.run()
        assert session.gas.time == 50.0
        assert session.result.pair_collisions == 1
    else:
        with pytest.raises(CaromError, match="a gas with collisions to come, got a gas at rest at t = "):
            session.run()


def test_numbers_that_end():
    with pytest.raises(CaromError, match="expected speeds above 1e-140, got slower balls at t = "):
        cooling(1e-130 * np.random.default_rng(0).normal(size=(50, 3)), np.zeros((50, 3))).run(100_000)


TWO = SCENE.replace("max_events = 100_000", "max_events = 3_000").replace("equilibrate = 500", "equilibrate = 0")
TWO = TWO.replace(
    'name = "a"\ncount = 50', 'name = "b"\ncount = 20\nradius = 0.4\nmass = 0.3\n[[species]]\nname = "a"\ncount = 30'
)
TWO += "".join(
    f'[[contacts]]\nbetween = ["{one}", "b"]\nrestitution = 0.8\nfriction = 0.2\ntangential_restitution = 0.3\n'
    for one in "ab"
)


@pytest.mark.parametrize("text", [SCENE.replace("100_000", "3_000").replace("500", "0"), TWO])
def test_temperatures_of_gas_and_species_are_the_same_mean(tmp_path, text):
    # those of the species were means over samples at equal numbers of collisions: 0.0735 beside 0.0043 of the gas
    (tmp_path / "cool.toml").write_text(text)
    session = Session(load_gas(tmp_path / "cool.toml"))
    session.run()
    found, measures = report(session), session.measures
    count = {one.name: one.count for one in session.scene.species}
    for name in ("temperature_translational", "temperature_rotational"):
        mean = sum(count[kind] * one[name] for kind, one in found["species"].items()) / 50
        assert mean == pytest.approx(found[name], rel=1e-12)
    # the samples' own integral over time agrees: it lacks the time before the first one
    t = measures.series["time"]
    between = np.trapezoid(measures.series["translational"], t) / (t[-1] - t[0])
    own = sum(count[kind] * measures.temperature(kind)[0] for kind in count) / 50
    assert own == pytest.approx(between, rel=1e-12)
    assert own < measures.series["translational"].mean() / 3


@pytest.mark.parametrize("begin", [1e3, 1e6, 1e12])
def test_what_a_cold_gas_loses_is_summed_from_where_it_is_measured(tmp_path, begin):
    path = tmp_path / "gas.toml"
    path.write_text(COLD.format(begin=begin))
    session = Session(load_gas(path))
    session.run()
    found = report(session)
    assert 0 < found["energy_end"] < found["energy_start"] < 60
    assert abs(found["energy_imbalance"]) < 1e-12
