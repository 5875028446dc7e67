"""A force across the walls: parabolas met exactly, what they conserve, and the gravitational wedge."""

import json
import math

import numpy as np
import pytest
from reference.exploring import tried
from reference.plane_tables import CLEARANCE, PLANE, first_outside
from typer.testing import CliRunner

import carom
from carom import billiards
from carom.cli import app
from carom.gas import Gas, Species, container

FALL = (0.4, -1.3)
TABLES = {
    "circle": billiards.under(billiards.circle(bounds="surface"), FALL),
    "ellipse": billiards.under(billiards.ellipse(), FALL),
    "ellipse-surface": billiards.under(billiards.ellipse(bounds="surface"), FALL),
    "narrow ellipse": billiards.under(billiards.ellipse(1.1, 0.25, bounds="surface"), FALL),
    "tall narrow ellipse": billiards.under(billiards.ellipse(0.25, 1.1, bounds="surface"), FALL),
    "wedge": billiards.under(billiards.wedge(70), (-1.0, 0.3)),
    "strip": billiards.under(billiards.strip(), FALL),
    "level strip": billiards.under(billiards.strip(), (0.0, -1.3)),
    "plates": billiards.under(billiards.plates(), (0.0, -1.3, 0.0)),
    "channel": billiards.cylinder(billiards.under(billiards.strip(), (0.0, -1.3)), 1.5),
    "prism": billiards.cylinder(billiards.under(billiards.wedge(70, bounds="surface"), (-1.0, 0.3)), 1.5),
    "L": billiards.under(billiards.polygon([(0, 0), (2, 0), (2, 1), (1, 1), (1, 2), (0, 2)], bounds="surface"), FALL),
    "stadium": billiards.under(billiards.stadium(), FALL),
    "sinai": billiards.under(billiards.sinai(), (0.02, -0.03)),
    "periodic strip": billiards.under(billiards.periodic_strip(bounds="surface"), (0.01, -1.0)),
    "sphere": billiards.under(billiards.sphere(), (*FALL, 0.5)),
    "box": billiards.under(billiards.box(), (*FALL, 0.5)),
    "cylinder with lids": billiards.cylinder(billiards.under(billiards.stadium(), FALL), 2.0, acceleration=-1.0),
}


@pytest.mark.parametrize("bounds", ["centre", "surface"])
@pytest.mark.parametrize("name", CLEARANCE)
@pytest.mark.slow(keep=5)
def test_meets_what_small_steps_meet(name, bounds):
    """From random places inside, on parabolas: the first wall is where a march in steps of 1e-3 first finds it, to 1e-9."""
    g = np.array([0.7, -2.1])
    table, clearance = billiards.under(PLANE[name](bounds=bounds), g), CLEARANCE[name]
    inset = 0.07 if bounds == "surface" else 0.0
    rng = np.random.default_rng(1)
    x = rng.uniform(-1, 2, (400, 2))
    x = x[clearance(x) > inset + 0.01][:12]
    angle = rng.uniform(0, math.tau, len(x))
    v = np.stack([np.cos(angle), np.sin(angle)], axis=-1) * rng.uniform(0.2, 2, len(x))[:, None]
    found = billiards.orbit(table, (x, v, 0.0), 1, ball=carom.Disc(0.07, 1.0), at_corner="pass")
    steps = np.arange(0, 5, 1e-3)

    def at(k, t):
        return x[k] + np.multiply.outer(t, v[k]) + np.multiply.outer(t * t / 2, g)

    for k in range(len(x)):
        out = first_outside(clearance, lambda t, k=k: at(k, t), steps, inset)
        assert out is not None
        low, high = steps[out - 1], steps[out]
        for _ in range(45):
            middle = (low + high) / 2
            if clearance(at(k, np.array([middle])))[0] < inset:
                high = middle
            else:
                low = middle
        t = found.t[k, 0]
        # (a step may pass over what is grazed: then earlier)
        assert t == pytest.approx(low, abs=1e-9) or (t < low and clearance(at(k, np.array([t])))[0] < inset + 1e-9)


@pytest.mark.parametrize("name", TABLES)
@pytest.mark.slow(keep=2)
def test_never_outside_and_no_energy_lost(name):
    table = TABLES[name]
    d, g = table.dimension, np.array(table.acceleration[: table.dimension])
    found = billiards.orbit(table, billiards.starts(table, 20, 1, speed=2.5), 500)
    assert (found.ended == "bounces").all()
    energy = found.speed**2 - 2 * found.position @ g
    assert np.abs(energy - energy[:, :1]).max() < 1e-13 * np.square(found.speed).max() * 10
    dt = np.diff(found.t, axis=1)[..., None] * np.linspace(0, 1, 22)[1:-1]
    way = found.position[:, :-1, None] + found.velocity[:, :-1, None] * dt[..., None] + g * (dt * dt / 2)[..., None]
    assert table.shape(float(found.setup.ball.radius)).gap(way.reshape(-1, d)).min() > -1e-11


def test_a_million_bounces_keep_their_energy():
    for name in tried(("L", "sphere"), ("circle", "L", "stadium", "sphere")):
        table = TABLES[name]
        d, kappa = table.dimension, 0.5 if table.dimension == 2 else 0.4
        begin = ((0.3, 0.4, 0.0)[:d], (0.7, 0.4, 0.1)[:d], 0.9 if d == 2 else (0.3, 0.2, 0.9))
        state, *_ = billiards.final(table, begin, 1_000_000)
        radius = 0.1 if table.bounds == "surface" else 1.0
        energy = [
            np.square(v).sum() + kappa * radius**2 * np.square(w).sum() - 2 * np.dot(table.acceleration[:d], x)
            for x, v, w in (begin, (state.position, state.velocity, state.spin))
        ]
        assert abs(energy[1] - energy[0]) < 3e-12 * (abs(energy[0]) + np.square(state.velocity).sum())


@pytest.mark.parametrize("name", ["circle", "ellipse-surface", "narrow ellipse", "L", "sphere"])
def test_comes_back(name):
    """Twelve bounces and back, before chaos has multiplied what rounding took."""
    _back, error = billiards.reverse(
        billiards.orbit(TABLES[name], billiards.starts(TABLES[name], 20, 2, speed=2.5), 12)
    )
    assert np.median(error) < 1e-11
    assert error.max() < 1e-7


def test_up_and_down():
    """Straight down on a floor: after 2 v/g again; and with a ceiling in the way, earlier."""
    table = billiards.under(billiards.strip(1.0), (0.0, -2.0))
    found = billiards.orbit(table, ((0, -0.5), (0.0, 1.0), 0.0), 5, law="mirror")
    np.testing.assert_allclose(found.t, np.arange(1, 6), rtol=1e-14)
    assert (found.piece == 0).all()
    found = billiards.orbit(table, ((0, -0.5), (0.0, 3.0), 0.0), 2, law="mirror")
    assert found.t[0] == pytest.approx((3 - math.sqrt(5)) / 2)
    assert found.t[1] == pytest.approx(2 * found.t[0])
    # a force away from the only wall that is there: it leaves for good; towards the vertex it does not
    away, to = (billiards.under(billiards.wedge(60), (g, 0.0)) for g in (1.0, -1.0))
    assert billiards.orbit(away, ((1, 0), (0.0, 0.1), 0.0), 50).ended == "escaped"
    assert billiards.orbit(to, ((1, 0), (0.0, 0.1), 0.0), 50).ended == "bounces"


def test_the_gas_of_one_disc_goes_the_same_way():
    """Two engines: the queue with its cells, and the loop for one ball."""
    table = billiards.under(billiards.ellipse(4.0, 2.5, bounds="surface"), FALL)
    begin = ((0.5, 0.2), (1.0, 0.4), 0.7)
    found = billiards.orbit(table, begin, 20, ball=carom.Disc(0.5, 1.0))
    gas = Gas(
        [Species(carom.Disc(0.5, 1.0), 1)], container("ellipse", half_axes=(4, 2.5)), contacts=carom.Surface(1, math.inf, 1),
        gravity=FALL, position=[(4.5, 2.7)], velocity=[begin[1]], spin=[begin[2]],
    )  # fmt: skip
    for k in range(20):
        gas.run(1)
        balls = gas.balls()
        assert gas.time == pytest.approx(found.t[k], rel=1e-9)
        np.testing.assert_allclose(balls.position[0, :2] - (4.0, 2.5), found.position[k], atol=1e-7)
        np.testing.assert_allclose(balls.spin[0, 2], found.spin[k], atol=1e-6)


MEASURED = ("circle", "stadium", "sphere", "cylinder with lids", "wedge", "level strip", "plates", "channel", "prism")


@pytest.mark.parametrize("law", ["no-slip", "mirror"])
@pytest.mark.parametrize("name", MEASURED)
@pytest.mark.slow(keep=3)
def test_the_measure_is_kept(name, law):
    """Starts drawn by the energy left there, thirty bounces on: heights and velocities across are spread as they were."""
    table, count = TABLES[name], tried(8000, 20_000)
    g = np.array(table.acceleration[: table.dimension])
    found = billiards.orbit(table, billiards.starts(table, count, 3, law=law, speed=1.2), 31, law=law)
    assert (found.ended == "bounces").mean() > 0.999
    for value in (found.position @ g, found.across, found.speed):
        # (rounded: two plates are two places)
        first, last = (np.sort(np.round(value[:, k], 9)) for k in (0, -1))
        both = np.sort(np.concatenate([first, last]))
        apart = np.abs(np.searchsorted(first, both, "right") - np.searchsorted(last, both, "right")).max() / count
        assert apart < 1.95 * math.sqrt(2 / count)  # (a chance of 1e-3)


def test_a_wedge_is_as_long_as_a_ball_gets():
    """Places count by what is left there, K in the plane and K^(5/2) in space, which goes down to nothing in a line."""
    g, angle, speed = np.array([-1.0, 0.3]), 1.2, 1.7
    along = np.array([[math.cos(angle / 2), math.sin(angle / 2)], [math.cos(angle / 2), -math.sin(angle / 2)]])
    reach = -(speed**2) / (2 * along @ g)
    for power, table in (
        (1.0, billiards.wedge(math.degrees(angle))),
        (2.5, billiards.cylinder(billiards.under(billiards.wedge(math.degrees(angle)), g))),
    ):
        table = billiards.under(table, g) if table.dimension == 2 else table  # noqa: PLW2901
        x = billiards.starts(table, 40_000, 6, speed=speed).position
        s, upper = np.linalg.norm(x[:, :2], axis=1), x[:, 1] > 0
        assert upper.mean() == pytest.approx(reach[0] / reach.sum(), abs=0.01)
        for one, length in ((upper, reach[0]), (~upper, reach[1])):
            assert s[one].max() < length
            # (the k-th moment of (1 - u)^power on (0, 1))
            assert (s[one] / length).mean() == pytest.approx(1 / (power + 2), abs=0.005)
            assert ((s[one] / length) ** 2).mean() == pytest.approx(2 / ((power + 2) * (power + 3)), abs=0.004)


def test_the_gravitational_wedge():
    """Lehtihet & Miller (1986): a point in a symmetric wedge is integrable where its walls stand at a right angle, chaotic

    everywhere where it is wider (Wojtkowski 1990 has the proof), and both, by the start, where it is narrower.
    """
    angle = np.linspace(0, math.tau, 40, endpoint=False) + 0.1
    begin = (np.tile([0.7, 0.0], (40, 1)), math.sqrt(0.6) * np.stack([np.cos(angle), np.sin(angle)], axis=1), 0.0)

    def greatest(half):
        table = billiards.under(billiards.wedge(2 * half), (-1.0, 0.0))
        return billiards.lyapunov(table, begin, 3000, law="mirror").per_bounce

    assert np.abs(greatest(45)).max() < 0.005
    for half, least in ((50, 0.48), (60, 0.57), (75, 0.34)):
        found = greatest(half)
        assert found[:, 0].min() > least
        assert np.abs(found.sum(axis=1)).max() < 2e-3
    mixed = greatest(25)[:, 0]
    assert 5 < (mixed < 0.005).sum() < 20 < ((mixed > 0.2) & (mixed < 0.27)).sum()
    # between walls at a right angle the motion along each keeps its own part of the energy
    square = billiards.under(billiards.wedge(90), (-1.0, 0.0))
    found = billiards.orbit(square, (begin[0], begin[1], 0.0), 2000, law="mirror")
    for n in (np.array([1, 1]) / math.sqrt(2), np.array([1, -1]) / math.sqrt(2)):
        part = (found.velocity @ n) ** 2 / 2 + found.position @ n / math.sqrt(2)
        assert np.abs(part - part[:, :1]).max() < 1e-12


def test_command_line_and_faults(tmp_path):
    def run(*words):
        return CliRunner().invoke(app, ["orbit", *words])

    picture = tmp_path / "fall.png"
    found = run("circle", "--acceleration", "0,-1", "--bounces", "60", "--json", "--plot", str(picture))
    facts = json.loads(found.stdout)
    assert facts["energy_drift"] < 1e-12
    assert facts["table"]["acceleration"] == [0.0, -1.0]
    assert "drift" not in facts
    assert "caustics" not in facts
    assert picture.stat().st_size > 5000
    solid = run("cylinder:stadium:height=2", "--acceleration", "0.1,0,-9.81", "--bounces", "30", "--json")
    assert len(json.loads(solid.stdout)["bounces"]) == 30
    for words, said in (
        (("circle", "--acceleration", "-1"), "expected two numbers"),
        (("sphere", "--acceleration", "0,1"), "expected three numbers"),
    ):
        assert said in str(run(*words).exception)
    for make, said in (
        (lambda: billiards.under(billiards.circle(), (1.0,)), "2 numbers"),
        (lambda: billiards.under("circle", (1.0, 0.0)), "a table"),
        (lambda: billiards.starts(billiards.under(billiards.circle(), (0.0, -9.81)), 3, speed=math.nan), "speed"),
        (lambda: billiards.orbit(TABLES["circle"], ((0, 0), (1, 0), 0.0), 3, law="rolling"), "horizontal"),
        (lambda: billiards.caustics(billiards.orbit(TABLES["circle"], ((0, 0), (1, 0), 0.0), 3)), "straight"),
    ):
        with pytest.raises(carom.CaromError, match=said):
            make()


def test_caustics_of_an_orbit_of_one_bounce() -> None:
    """One flight touches one circle; there is no second."""
    found = billiards.orbit(billiards.circle(), ((0.0, 0.5), (1.0, 0.0), 0.0), bounces=1, law="mirror")
    caustics = billiards.caustics(found)
    np.testing.assert_allclose(caustics.radii, [0.5, np.nan], atol=1e-12)
    np.testing.assert_equal(caustics.scatter, [0.0, np.nan])
