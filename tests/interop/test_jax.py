"""Runs as functions of JAX: gradients forward and reverse, batches, and what is refused."""

from __future__ import annotations

import numpy as np
import pytest
from reference.sweep_scenes import table_scene

import carom

jax = pytest.importorskip("jax")


@pytest.fixture(autouse=True)
def double_precision() -> object:
    before = jax.config.jax_enable_x64
    jax.config.update("jax_enable_x64", True)
    yield
    jax.config.update("jax_enable_x64", before)


def shot() -> carom.Scene:
    return table_scene(duration=1.5)


def test_derivatives_are_those_of_the_run_forward_and_reverse() -> None:
    scene, wrt = shot(), ["balls.0.velocity", "walls.*.friction"]
    place = carom.interop.jax.function(scene, wrt)
    run = carom.simulate(scene)
    exact = run.sensitivity(wrt).final.position
    x = jax.numpy.array(place.start)
    assert place.columns == ["balls.0.velocity.x", "balls.0.velocity.y", "walls.*.friction"]
    assert np.array_equal(place(x), run.final.position)
    assert np.array_equal(jax.jacfwd(place)(x), exact)
    assert np.asarray(jax.jacrev(place)(x)) == pytest.approx(exact, abs=1e-15)

    def miss(x: object) -> object:
        return ((place(x)[1, :2] - jax.numpy.array([1.0, 0.4])) ** 2).sum()

    apart = run.final.position[1, :2] - np.array([1.0, 0.4])
    assert np.asarray(jax.jit(jax.grad(miss))(x)) == pytest.approx(2 * apart @ exact[1, :2], rel=1e-12)


def test_a_batch_is_that_of_its_points() -> None:
    scene = shot()
    speed = carom.interop.jax.function(scene, ["balls.0.velocity"], of="final.velocity")
    points = jax.numpy.array(speed.start) + 0.05 * np.arange(4)[:, None]
    batch, slopes = jax.vmap(speed)(points), jax.jit(jax.vmap(jax.jacrev(speed)))(points)
    assert slopes.shape == (4, 3, 3, 2)
    for k in range(4):
        assert np.array_equal(batch[k], speed(points[k]))
        assert np.asarray(slopes[k]) == pytest.approx(np.asarray(jax.jacfwd(speed)(points[k])), abs=1e-14)


def test_a_struck_ball_has_its_derivative_away_from_the_start() -> None:
    def struck(azimuth: float) -> carom.Scene:
        ball = carom.SceneBall(radius=0.03, mass=0.17, position=(0, 0), strike={"speed": 2.0, "azimuth": azimuth})
        floor = carom.Floor(friction=0.2, rolling_resistance=0.02)
        return carom.Scene(floor=floor, balls=[ball], run=carom.Run(duration=2))

    wrt = ["balls.0.strike.azimuth"]
    place = carom.interop.jax.function(struck(0.0), wrt)
    exact = carom.simulate(struck(60.0)).sensitivity(wrt).final.position
    assert np.asarray(jax.jacfwd(place)(jax.numpy.array([60.0]))) == pytest.approx(exact, abs=1e-12)


def test_descent_finds_the_speed_that_stops_at_a_place() -> None:
    ball = carom.SceneBall(radius=0.03, mass=0.2, position=(0, 0), velocity=(0.5, 0), rolling=True)
    scene = carom.Scene(floor=carom.Floor(friction=0.2, rolling_resistance=0.02), balls=[ball])
    place = carom.interop.jax.function(scene, ["balls.0.velocity"])
    miss = jax.value_and_grad(lambda x: (place(x)[0, 0] - 1.0) ** 2)
    x = jax.numpy.array(place.start)
    for _step in range(60):
        _value, slope = miss(x)
        x = x - 0.05 * slope
    assert float(x[0]) == pytest.approx(np.sqrt(2 * 0.02 * 9.80665), rel=1e-6)


def test_what_is_refused() -> None:
    scene = shot()
    with pytest.raises(carom.CaromError, match=r"did you mean 'balls\.0\.velocity'"):
        carom.interop.jax.function(scene, ["balls.0.velocty"])
    with pytest.raises(
        carom.CaromError, match=r"of: expected final\.position, final\.velocity, final\.spin, got 'final'"
    ):
        carom.interop.jax.function(scene, ["balls.0.velocity"], of="final")
    place = carom.interop.jax.function(scene, ["walls.*.friction"])
    with pytest.raises(Exception, match=r"friction: expected"):
        place(jax.numpy.array([-1.0]))
    with pytest.raises(Exception, match=r"expected 1 numbers"):
        place(jax.numpy.array([0.1, 0.2]))


@pytest.mark.parametrize("again", ["hessian", "grad", "jacfwd", "jacrev", "vmap", "jit"])
def test_second_derivatives_are_refused(again: str) -> None:
    place = carom.interop.jax.function(shot(), ["balls.0.velocity"])

    def number(x: object) -> object:
        return place(x).sum()

    start = jax.numpy.array(place.start)
    ways = {
        "hessian": lambda: jax.hessian(number)(start),
        "grad": lambda: jax.grad(lambda x: jax.grad(number)(x)[0])(start),
        "jacfwd": lambda: jax.jacfwd(jax.jacfwd(number))(start),
        "jacrev": lambda: jax.jacrev(jax.jacfwd(number))(start),
        "vmap": lambda: jax.vmap(jax.hessian(number))(start[None]),
        "jit": lambda: jax.jit(jax.hessian(number))(start),
    }
    with pytest.raises(carom.CaromError, match="expected first derivatives, got a derivative of one"):
        ways[again]()


@pytest.mark.parametrize("bad", [np.nan, np.inf])
def test_what_no_run_has_is_refused_in_one_line(bad: float) -> None:
    """JAX's own error of a callback was eighty lines long."""
    for wrt in ("balls.0.velocity", "walls.*.restitution"):
        place = carom.interop.jax.function(shot(), [wrt])
        x = jax.numpy.array(place.start).at[0].set(bad)
        for way in (place, jax.grad(lambda x, place=place: place(x).sum()), jax.jacfwd(place), jax.jacrev(place)):
            with pytest.raises(carom.CaromError, match="expected"):
                way(x)
        for other in (x * 1j, "text", None, 1.0, x[None], x > 0):
            with pytest.raises(carom.CaromError, match=r"interop\.jax\.function: expected"):
                place(other)


def test_one_impact_is_that_of_the_kernel_and_has_derivatives() -> None:
    rng, ball = np.random.default_rng(0), carom.Ball(0.03, 0.2, 0.4)
    impact = carom.interop.jax.impact
    for mu in (0.0, 0.1, 0.5, np.inf):
        for _ in range(8):
            v, w, n = rng.normal(size=(3, 3)) * np.array([[1.0], [20.0], [1.0]])
            v -= max(v @ n, 0.0) * 2 * n / (n @ n)  # (towards the surface)
            e, beta = rng.uniform(0, 1), rng.uniform(-1, 1)
            after = carom.impact(ball, carom.State(v, w), n, carom.Surface(e, mu, beta)).after
            found = impact(v, w, ball=ball, normal=n, restitution=e, friction=mu, tangential_restitution=beta)
            assert np.asarray(found[0]) == pytest.approx(after.velocity, abs=1e-14)
            assert np.asarray(found[1]) == pytest.approx(after.spin, abs=1e-12)

    def velocity(e: float, mu: float) -> object:
        return impact((-1.0, 1.0, 0.2), (3.0, 5.0, 7.0), ball=ball, restitution=e, friction=mu)[0]

    h = 1e-6
    for k, x in enumerate((0.9, 0.1)):
        sides = ([0.9, 0.1], [0.9, 0.1])
        sides[0][k], sides[1][k] = x + h, x - h
        by = (np.asarray(velocity(*sides[0])) - np.asarray(velocity(*sides[1]))) / (2 * h)
        assert np.asarray(jax.jacrev(velocity, k)(0.9, 0.1)) == pytest.approx(by, abs=1e-8)
    # a ball without slip: the root of the slip has no derivative, friction has no effect
    assert np.isfinite(jax.jacfwd(velocity, 1)(0.9, np.inf)).all()
    assert float(jax.grad(lambda mu: impact((-1.0, 0, 0), (0, 0, 0), friction=mu)[0][1])(0.3)) == 0
    for given in ({"restitution": 1.9}, {"friction": -0.2}):
        with pytest.raises(carom.CaromError, match=next(iter(given))):
            impact((-1.0, 0, 0), (0, 0, 0), **given)
