"""Laws of the cloth that are options of a scene: resistance that grows with the speed, spin that fades by several laws."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import mpmath
import numpy as np
import pytest
from reference.cloth_shots import Ball, Cloth, Shot, Wall
from reference.exploring import tried

import carom
from carom.core.motion.phases import ROLLING, SLIDING, decay_integrals, time_of_integral, time_of_path
from carom.scene.toml import path_match
from carom.simulation.motion import begin_phase
from carom.simulation.predict import pair_hit

A = 0.03075
SIDES = (((1, 0), -1.4), ((-1, 0), -1.4), ((0, 1), -0.7), ((0, -1), -0.7))
LAWS: dict[str, dict[str, Any]] = {
    "drag": {"rolling_drag": 0.0018},
    "strong drag": {"rolling_drag": 0.03, "rolling_resistance": 0.002},
    "drag alone": {"rolling_drag": 0.02, "rolling_resistance": 0.0},
    "damping": {"spin_damping": 0.4},
    "damping alone": {"spin_damping": 0.4, "spin_friction": 0.0},
    "spin drag": {"spin_drag": 5.0},
    "spin drag and drag": {"spin_drag": 5.0, "rolling_drag": 0.01, "spin_friction": 0.0},
    "slope": {"slope": (0.0003, -0.0004)},
    "slope that holds no ball": {"slope": (0.004, 0.012), "spin_damping": 0.3},
}


def scene(law: dict[str, Any], seed: int, duration: float = 5.0, **wall: Any) -> carom.Scene:
    """Three balls between four walls, drawn: mirrors, so that only the cloth is in question."""
    draw = np.random.default_rng(seed)
    places = [(-0.9, -0.3), (0.1, 0.15), (0.7, -0.2)]
    balls = [
        {
            "radius": A, "mass": 0.21, "position": place,
            "velocity": (draw.uniform(-2, 2), draw.uniform(-2, 2)) if i < 2 else (0, 0),
            **({"rolling": True, "spin_z": draw.uniform(-40, 40)} if i == 1 else
               {"spin": tuple(draw.uniform(-40, 40, 3))} if i == 0 else {}),
        }
        for i, place in enumerate(places)
    ]  # fmt: skip
    walls = [
        {
            "shape": "plane",
            "point": (-n[0] * -at, -n[1] * -at, 0),
            "normal": (*n, 0),
            "restitution": 0.8,
            "friction": 0,
            **wall,
        }
        for n, at in SIDES
    ]
    floor = {"friction": 0.2, "rolling_resistance": 0.006, "spin_friction": 0.01, **law}
    return carom.Scene(
        floor=floor, walls=walls, balls=balls, run={"law": "mirror", "duration": duration},
        ball_contact={"restitution": 1, "friction": 0, "overlap": False},
    )  # fmt: skip


def in_small_steps(made: carom.Scene, until: float) -> Shot:
    """Integrate the same scene without carom."""
    floor = made.floor
    assert floor is not None
    names = ("friction", "rolling_resistance", "spin_friction", "rolling_drag", "spin_damping", "spin_drag", "slope")
    balls = [
        Ball(np.array(one.position[:2]), np.array(one.state.velocity[:2]), np.array(one.state.spin), one.radius)
        for one in made.balls
    ]
    walls = [
        Wall(np.array(n, float), at, yield_time=one.yield_time, deepest=0.5)
        for (n, at), one in zip(SIDES, made.walls, strict=True)
    ]
    shot = Shot(balls, walls, Cloth(**{name: getattr(floor, name) for name in names}))
    shot.run(until)
    return shot


def agrees(run: carom.Trajectory, shot: Shot, error: float) -> None:
    """Compare every contact and every final state."""
    kinds = ("wall", "ball", "rolling")
    mine = [
        (one.t, one.kind)
        for one in run.events
        if one.kind in kinds and not (one.kind == "ball" and one.ball > one.other)
    ]
    theirs = [(t, kind) for t, kind, _i, _k in shot.events if kind in kinds]
    assert [kind for _t, kind in mine] == [kind for _t, kind in theirs]
    np.testing.assert_allclose([t for t, _k in mine], [t for t, _k in theirs], atol=error)
    for i, ball in enumerate(shot.balls):
        np.testing.assert_allclose(run.final.position[i, :2], ball.x, atol=error)
        np.testing.assert_allclose(run.final.velocity[i, :2], ball.v, atol=error)
        np.testing.assert_allclose(run.final.spin[i], ball.w, atol=100 * error)


@pytest.mark.parametrize("law", LAWS)
@pytest.mark.slow(keep=2)
def test_the_closed_forms_are_small_steps_of_newtons_equations(law: str) -> None:
    made = scene(LAWS[law], 3)
    agrees(carom.simulate(made), in_small_steps(made, 5.0), 1e-9)


@pytest.mark.parametrize("k", [0.0, 1e-9, 0.02, 1.0, 7.0, 300.0])
def test_integrals_of_a_decay_are_rounded_values(k: float) -> None:
    for s in (1e-3, 0.3, 2.0, 9.0):
        with mpmath.workdps(50):
            rate, time = mpmath.mpf(k), mpmath.mpf(s)
            one = time if k == 0 else -mpmath.expm1(-rate * time) / rate
            exact = [float(x) for x in (mpmath.exp(-rate * time), one, time**2 / 2 if k == 0 else (time - one) / rate)]
        rest, once, twice = decay_integrals(k, s)
        assert rest == pytest.approx(exact[0], rel=1e-12, abs=1e-300)
        assert [once, twice] == pytest.approx(exact[1:], rel=4e-16)
        if k * s < 30:
            assert time_of_integral(k, once) == pytest.approx(s, rel=1e-15 / rest + 1e-14)
        # a ball whose speed is gone after 1.25 s, at the least
        c = 0.8 / once
        assert time_of_path(k, c, s - c * twice, 2 * s) == pytest.approx(s, rel=1e-13)
    if k > 0:
        assert time_of_integral(k, 1.01 / k) == np.inf


def moving(draw: np.random.Generator, world: Any, x: Any, rolls: bool) -> Any:
    """A ball that rolls, or slides, as the event loop has it."""
    v = draw.uniform(-2, 2, 2)
    w = np.array([-v[1] / A, v[0] / A, 0.0]) + (0 if rolls else draw.uniform(-40, 40, 3))
    ball = SimpleNamespace(
        radius=A, mass=0.2, kappa=0.4, x=[*x, A], v=[*v, 0.0], w=w.tolist(), phase=ROLLING if rolls else SLIDING, clock=0.0,
        acc=[0.0] * 3, turn=[0.0] * 3, decays=0, fade=0.0, spin_fade=0.0, spin_gain=0.0, lasts=0.0, lean=[0.0] * 4, borne_by=0,
        air=0.0, buoyancy=0.0, spin_decay=0.0,
    )  # fmt: skip
    begin_phase(world, ball)
    return ball


def path_of(ball: Any, world: Any, t: Any) -> Any:
    """Places (n, 2) at times, from v' = -(a + b v) or Coriolis' parabola."""
    x, v, s = np.array(ball.x[:2]), np.array(ball.v[:2]), t[:, None]
    if ball.phase == SLIDING:
        slip = v + A * np.array([-ball.w[1], ball.w[0]])
        return x + v * s - world.floor_mu * world.g * slip / np.linalg.norm(slip) * s * s / 2
    a, b, speed = world.resistance * world.g, world.rolling_drag * world.g, np.linalg.norm(v)
    return x + v / speed * ((speed + a / b) * -np.expm1(-b * s) - a * s) / b


def test_no_contact_of_balls_that_slow_down_is_missed() -> None:
    """Two balls, drawn, aimed so that they graze or just miss: the first contact is that of a fine table of the gap."""
    draw, met, passed = np.random.default_rng(7), 0, 0
    for n in range(150):
        world = SimpleNamespace(
            floor=1, force=[0, 0, -9.8], g=9.8, floor_mu=0.2, resistance=draw.uniform(0.001, 0.01), spin_friction=0.0,
            rolling_drag=10 ** draw.uniform(-3, -0.5), spin_damping=0.0, spin_drag=0.0,
            wind=[0.0] * 3,
        )  # fmt: skip
        one, other = moving(draw, world, (0.0, 0.0), True), moving(draw, world, (0.0, 0.0), n % 2 == 0)
        until = min(one.lasts, other.lasts, 2.0)
        # at the time ``when`` they are a little more, or less, than two radii apart
        when = draw.uniform(0.05, 1) * until
        t = np.linspace(0, until, 20001)
        apart = path_of(one, world, t) - path_of(other, world, t)
        k = int(when / until * 20000)
        rate = apart[k] - apart[k - 1]
        across = np.array([-rate[1], rate[0]]) / np.linalg.norm(rate)
        miss = 2 * A * (1 + (-1) ** n * 10 ** draw.uniform(-7, -1))
        other.x = [*(apart[k] - miss * across), A]
        gap = np.linalg.norm(path_of(one, world, t) - path_of(other, world, t), axis=1) - 2 * A
        if gap[0] < 0:
            continue
        found = pair_hit(one, other, 0.0, until, 1e-14)
        below = np.flatnonzero(gap < 0)
        if len(below):
            met += 1
            assert t[below[0] - 1] - 1e-9 <= found <= t[below[0]] + 1e-9
            there = np.array([found])
            assert np.linalg.norm(path_of(one, world, there) - path_of(other, world, there)) == pytest.approx(
                2 * A, abs=1e-14
            )
        else:
            passed += found == np.inf
            # (deeper than the table resolves)
            assert found == np.inf or abs(gap).min() < 1e-7
    assert met > 40
    assert passed > 40


DERIVED: dict[str, tuple[dict[str, Any], tuple[str, ...]]] = {
    "drag": (
        {"rolling_drag": 0.01, "spin_drag": 3.0},
        ("floor.rolling_drag", "floor.spin_drag", "floor.rolling_resistance", "floor.spin_friction", "floor.friction"),
    ),
    "damping": ({"spin_damping": 0.4}, ("floor.spin_damping", "floor.spin_friction", "balls.0.velocity.x")),
    "slope": (
        {"slope": (0.004, -0.002)},
        ("floor.slope.x", "floor.slope.y", "floor.rolling_resistance", "floor.friction", "balls.0.velocity.x"),
    ),
    "defaults": ({}, ("floor.rolling_drag", "floor.spin_drag", "floor.spin_damping")),
    "level": ({}, ("floor.slope.x", "floor.slope.y")),
}


@pytest.mark.parametrize("case", DERIVED)
def test_derivatives_are_differences(case: str) -> None:
    law, paths = DERIVED[case]
    made = carom.replaced(scene(law, 4, 2.0), {"run.law": "two-step", "walls.*.friction": 0.2})
    run = carom.simulate(made)
    exact = run.sensitivity(paths).final
    mine = np.concatenate([exact.position, exact.velocity, exact.spin / 100], axis=1)

    def state(path: str, x: float) -> Any:
        final = carom.simulate(carom.replaced(made, {path: x})).final
        return np.concatenate([final.position, final.velocity, final.spin / 100], axis=1)

    for k, path in enumerate(paths):
        value, h = float(path_match(made, path).values[0]), 1e-6
        if value == 0 and "slope" in path:
            slope = (state(path, h) - state(path, -h)) / (2 * h)
        elif value == 0:
            slope = (4 * state(path, h) - 3 * state(path, 0.0) - state(path, 2 * h)) / (2 * h)
        else:
            h *= max(10 * abs(value), 0.01)
            slope = (state(path, value + h) - state(path, value - h)) / (2 * h)
        np.testing.assert_allclose(mine[:, :, k], slope, atol=1e-6 * abs(slope).max())


def test_orientation_follows_a_spin_that_decays() -> None:
    """Against small rotations, along a roll whose side spin ends on the way."""
    for law in ({"rolling_drag": 0.05, "spin_drag": 20.0}, {"rolling_drag": 0.05, "spin_damping": 1.0}):
        ball = {"radius": A, "mass": 0.2, "position": (0, 0), "velocity": (1, 0.2), "rolling": True, "spin_z": 15.0}
        floor = {"friction": 0.2, "rolling_resistance": 0.01, "spin_friction": 0.012, **law}
        run = carom.simulate(carom.Scene(floor=floor, balls=[ball], run={"duration": 1.5}))
        times = (np.arange(6000) + 0.5) / 4000
        q = np.array([1.0, 0, 0, 0])
        for w in run.at(times).spin[:, 0]:
            half = np.linalg.norm(w) / 8000
            q = _product((np.cos(half), *(np.sin(half) / np.linalg.norm(w) * w)), q)
        assert abs(run.final.spin[0, 2]) == 0
        np.testing.assert_allclose(run.orientation(1.5)[0], q, atol=2e-6)


def _product(p: Any, q: Any) -> Any:
    a, b = np.array(p[1:]), np.array(q[1:])
    return np.array([p[0] * q[0] - a @ b, *(p[0] * b + q[0] * a + np.cross(a, b))])


def test_the_laws_of_the_cloth_are_by_default_those_of_before() -> None:
    floor = carom.Floor(friction=0.2)
    assert (floor.rolling_drag, floor.spin_damping, floor.spin_drag) == (0, 0, 0)
    with pytest.raises(carom.CaromError, match=r"spin_drag: expected 0 with spin_damping > 0, got 2.*one law"):
        carom.Floor(friction=0.2, spin_damping=0.3, spin_drag=2)
    with pytest.raises(carom.CaromError, match=r"rolling_drag: expected a number in s/m, >= 0, got -1"):
        carom.Floor(friction=0.2, rolling_drag=-1)


def test_a_spin_that_only_damps_never_ends() -> None:
    ball = {"radius": A, "mass": 0.2, "position": (0, 0), "spin": (0, 0, 20.0)}
    made = carom.Scene(floor={"friction": 0.2, "spin_damping": 0.5}, balls=[ball], run={"duration": 3})
    run = carom.simulate(made)
    assert run.final.spin[0, 2] == pytest.approx(20 * np.exp(-1.5), rel=1e-15)
    assert carom.simulate(carom.replaced(made, {"run.duration": None})).end == 0


@pytest.mark.parametrize("c", [0.004, 0.012])
def test_a_wall_that_yields_is_met_at_a_depth_of_its_time_times_the_speed(c: float) -> None:
    for law in ({}, {"rolling_drag": 0.02}):
        made = scene(law, 5, 5.0, yield_time=c)
        run = carom.simulate(made)
        agrees(run, in_small_steps(made, 5.0), 1e-9)
        rows = run.log[run.log["kind"] == 1]
        for row in rows:
            n, at = SIDES[row["other"]]
            gap = np.dot(n, row["x"][:2]) - at - A
            assert gap == pytest.approx(max(c * np.dot(n, row["v_before"][:2]), -A / 2), abs=1e-13)
        assert len(rows) > 1


@pytest.mark.slow
def test_round_walls_yield_along_their_normals() -> None:
    """A pillar and the inside of a tube: the place of contact is a root of a fine table of the path."""
    pillar = {
        "shape": "cylinder",
        "point": (0, 0, 0),
        "axis": (0, 0, 1),
        "radius": 0.1,
        "restitution": 0.8,
        "friction": 0.1,
    }
    tube = {**pillar, "radius": 1.0, "inside": True}
    draw = np.random.default_rng(3)
    for n in range(tried(12, 30)):
        wall, side = ((pillar, 1), (tube, -1))[n % 2]
        wall = {**wall, "yield_time": draw.uniform(0, 0.01)}
        v, spin = draw.uniform(-2, 2, 2), draw.uniform(-60, 60, 3)
        way = v / np.linalg.norm(v)
        start = (-0.3 * way + draw.uniform(-0.12, 0.12) * np.array([-way[1], way[0]])) if n % 2 == 0 else (0.1, 0.2)
        ball = {"radius": A, "mass": 0.2, "position": tuple(start), "velocity": tuple(v), "spin": tuple(spin)}
        run = carom.simulate(
            carom.Scene(floor={"friction": 0.2}, walls=[wall], balls=[ball], run={"max_events": 2, "law": "contact"})
        )
        free = carom.simulate(carom.Scene(floor={"friction": 0.2}, balls=[ball], run={"duration": 3}))
        t = np.linspace(0, 3, 60001)
        path = free.at(t)
        x, u = path.position[:, 0, :2], path.velocity[:, 0, :2]
        far = np.linalg.norm(x, axis=1)
        gap, rate = side * (far - wall["radius"]) - A, side * (x * u).sum(axis=1) / far
        short = gap + np.minimum(wall["yield_time"] * np.maximum(-rate, 0), A / 2)
        hits = run.log[run.log["kind"] == 1]
        if not (short < 0).any():
            assert len(hits) == 0
            continue
        k = int(np.argmax(short < 0))
        exact = t[k - 1] + (t[k] - t[k - 1]) * short[k - 1] / (short[k - 1] - short[k])
        assert hits[0]["t"] == pytest.approx(exact, abs=1e-7)


def test_what_is_driven_into_a_wall_that_yields_stays_at_its_depth() -> None:
    """Topspin presses a ball on the cushion: it loses energy, and neither sinks in nor creeps out."""
    ball = {"radius": 0.03, "mass": 0.2, "position": (0.3, 0), "velocity": (-1, 0.3), "spin": (0, -333.0, 40)}
    wall = {"shape": "plane", "point": (0, 0, 0), "normal": (1, 0, 0), "restitution": 0.4, "friction": 0.15}
    ends = []
    for c in (0.0, 0.006):
        walls = [{**wall, "yield_time": c}]
        run = carom.simulate(
            carom.Scene(
                floor={"friction": 0.2, "rolling_resistance": 0.01}, walls=walls, balls=[ball], run={"duration": 4}
            )
        )
        log = run.log
        energy = (log["v"] ** 2).sum(axis=1) + 0.4 * 0.03**2 * (log["w"] ** 2).sum(axis=1)
        assert np.diff(energy).max() < 1e-15
        depth = 0.03 - log["x"][log["kind"] == 1, 0]
        if c > 0:
            assert depth[:4] == pytest.approx([8.68e-3, 3.74e-3, 1.56e-3, 0.577e-3], rel=5e-3)
        assert np.ptp(depth[5:]) < 1e-12
        ends.append((len(log), run.final.position[0, 1]))
    assert ends[1][0] < 1.5 * ends[0][0]
    assert ends[1][1] == pytest.approx(ends[0][1], abs=0.01)


def test_derivatives_by_the_yield_time_are_differences() -> None:
    for c, law in ((0.006, {}), (0.006, {"rolling_drag": 0.01}), (0.0, {})):
        made = carom.replaced(scene(law, 4, 2.0, yield_time=c), {"run.law": "two-step", "walls.*.friction": 0.2})
        paths = ("walls.*.yield_time", "floor.friction", "balls.0.velocity.x")
        exact = carom.simulate(made).sensitivity(paths).final.position
        for k, path in enumerate(paths):
            value, h = float(path_match(made, path).values[0]), 1e-7
            ends = [carom.simulate(carom.replaced(made, {path: value + s * h})).final.position for s in (0, 1, 2)]
            slope = (4 * ends[1] - 3 * ends[0] - ends[2]) / (2 * h)
            np.testing.assert_allclose(exact[:, :, k], slope, atol=1e-8 + 3e-6 * abs(slope).max())


def test_a_ball_between_a_ball_and_a_wall_that_yields_is_in_contact_with_both() -> None:
    """Contacts that overlap in time: the wall acts where the ball is, and does not let it through."""
    wall = {
        "shape": "plane",
        "point": (0, 0, 0),
        "normal": (1, 0, 0),
        "restitution": 0.8,
        "friction": 0.1,
        "contact_time": 3e-3,
    }
    for c in (0.0, 0.006):
        balls = [
            {"radius": A, "mass": 0.2, "position": (0.2, 0), "velocity": (-2, 0)},
            {"radius": A, "mass": 0.2, "position": (A + 0.0005, 0.002)},
        ]
        made = carom.Scene(floor={"friction": 0.2}, walls=[{**wall, "yield_time": c}], balls=balls, run={"duration": 1})
        run = carom.simulate(made)
        assert run.final.position[:, 0].min() > A - 2 * 0.006
        assert run.log["x"][:, 0].min() > 0.3 * A
        moved = run.final.velocity[0, 0]
        assert moved > 0


def test_a_nose_that_yields_goes_with_the_ball() -> None:
    """Deeper, the ball leaves with what it would leave with: the nose, above its centre, touches it where it did."""
    after = []
    for c in (0.0, 0.002, 0.006):
        cushions = {"shape": "table", "length": 2.84, "width": 1.42, "nose_height": 0.037, "yield_time": c}
        ball = {
            "radius": A,
            "mass": 0.21,
            "position": (0.9, 0.1),
            "velocity": (2.0, 1.0),
            "rolling": True,
            "spin_z": 20.0,
        }
        made = carom.Scene(
            floor={"friction": 0.2},
            walls=[{**cushions, "restitution": 0.85, "friction": 0.2}],
            balls=[ball],
            run={"max_events": 1},
        )
        run = carom.simulate(made)
        row = run.log[1]
        after.append([*row["v"], *row["w"] * A])
        assert (row["x"][0] > 1.42 - 0.97 * A) == (c > 0)
        slope = run.sensitivity("walls.0.nose_height").events[0].velocity[:, 0]
        h = 1e-7
        ends = [
            carom.simulate(carom.replaced(made, {"walls.0.nose_height": 0.037 + s * h})).log[1]["v"] for s in (-1, 1)
        ]
        np.testing.assert_allclose(slope, (ends[1] - ends[0]) / (2 * h), atol=1e-5 * abs(slope).max())
    np.testing.assert_allclose(after[1:], [after[0]] * 2, atol=1e-12)


@pytest.mark.parametrize("c", [0.003, 0.007, 0.1])
@pytest.mark.parametrize("speed", [3.0, 10.0, 30.0])
def test_no_ball_goes_through_a_nose_that_yields(c: float, speed: float) -> None:
    """However far it would go in the yield time: it gets half a radius deep at most."""
    cushions = {"shape": "table", "length": 2.0, "width": 1.0, "nose_height": 0.0363, "yield_time": c}
    ball = {"radius": 0.028575, "mass": 0.17, "position": (0.5, 0.0), "velocity": (speed, 0.1 * speed)}
    made = carom.Scene(
        floor={"friction": 0.2},
        walls=[{**cushions, "restitution": 0.85, "friction": 0.2}],
        balls=[ball],
        run={"max_events": 1},
    )
    row = carom.simulate(made).log[1]
    assert row["v"][0] < 0 < row["v_before"][0]
    touch = 1 - (0.028575**2 - (0.0363 - 0.028575) ** 2) ** 0.5
    assert row["x"][0] - touch == pytest.approx(min(c * row["v_before"][0], 0.0162), rel=0.1)


def test_a_slope_holds_a_ball_or_sets_it_going() -> None:
    """At rest up to f/(1 + kappa) = c g; from there on straight downhill, and a ball that rolls up comes back."""
    g, kappa, c = 9.80665, 0.4, 0.01

    def run(slope: Any, **ball: Any) -> carom.Trajectory:
        one = {"radius": A, "mass": 0.2, "position": (0, 0), **ball}
        floor = {"friction": 0.2, "rolling_resistance": c, "slope": slope}
        return carom.simulate(carom.Scene(gravity=g, floor=floor, balls=[one], run={"duration": 2}))

    limit = c * (1 + kappa) / np.hypot(1, c * (1 + kappa))  # of the sine
    assert np.all(run((limit * 0.9999, 0)).final.position[0, :2] == 0)
    for x in (limit * 1.01, 0.05):
        final = run((0, -x)).final
        acceleration = g * x / (1 + kappa) - c * g * np.sqrt(1 - x * x)
        np.testing.assert_allclose(final.position[0, :2], (0, -acceleration * 2), rtol=1e-12, atol=1e-15)
        np.testing.assert_allclose(final.spin[0, :2] * A, (2 * acceleration, 0), rtol=1e-12, atol=1e-15)
    up = run((-0.05, 0), velocity=(0.2, 0), rolling=True)
    down, hold = g * 0.05 / 1.4, c * g * np.sqrt(1 - 0.05**2)
    turns = 0.2 / (down + hold)
    assert up.events[0].t == pytest.approx(turns, rel=1e-14)
    assert up.final.position[0, 0] == pytest.approx(0.1 * turns - (down - hold) * (2 - turns) ** 2 / 2, rel=1e-12)
    # too steep for rolling: mu (1 + 1/kappa) = 0.7
    steep = run((0.6, 0))
    assert steep.final.velocity[0, 0] == pytest.approx(2 * g * (0.6 - 0.2 * 0.8), rel=1e-12)
    assert steep.final.spin[0, 1] == pytest.approx(2 * 0.2 * 0.8 * g / (kappa * A), rel=1e-12)


def test_a_slope_keeps_the_energy_of_a_ball_that_rolls_without_resistance() -> None:
    """Up, around and down again: kinetic energy and that of height, to rounding."""
    ball = {"radius": A, "mass": 0.2, "position": (0, 0), "velocity": (-0.6, 0.3), "rolling": True}
    floor = {"friction": 0.2, "slope": (0.03, 0.01)}
    run = carom.simulate(carom.Scene(floor=floor, balls=[ball], run={"duration": 10.0}))
    energy = run.energy(np.linspace(0, 10, 21))
    assert run.final.velocity[0, 0] > 1
    np.testing.assert_allclose(energy, energy[0], rtol=1e-12)


@pytest.mark.parametrize("rolls", [True, False])
def test_a_graze_on_a_slope_is_neither_missed_nor_invented(rolls: bool) -> None:
    """Pillars beside the path, a nanometre into it or off it; the path by sums of exponentials, as docs/theory/motion.md has it."""
    draw = np.random.default_rng(5)
    for n in range(16):
        slope, c = 10.0 ** draw.uniform(-4, -1.5) * np.array([1.0, 0.0]), 10.0 ** draw.uniform(-2, -1.2)
        v = draw.uniform(-1.5, 1.5, 2)
        spin = draw.uniform(-60, 60, 3)
        ball = {"radius": A, "mass": 0.2, "position": (0, 0), "velocity": tuple(v)}
        ball |= {"rolling": True} if rolls else {"spin": tuple(spin)}
        g, pull = 9.80665 * np.sqrt(1 - slope @ slope), 9.80665 * slope[0]
        w = v if rolls else v - A * np.array([spin[1], -spin[0]])
        m, f, q = (c * g, pull / 1.4, 1.0) if rolls else (0.2 * g * 3.5, pull, 2 / 7)
        size = np.hypot(*w)
        p, k = (size + w[0]) / 2, (size - w[0]) / 2
        tau = draw.uniform(0.1, 0.4) / m if rolls else draw.uniform(0.1, 0.2)

        def integral(rate: float, tau: float = tau) -> float:
            return float(-np.expm1(-rate * tau) / rate) if rate else tau

        t = p * integral(m - f) + k * integral(m + f)
        now = np.array([p * np.exp(-(m - f) * tau) - k * np.exp(-(m + f) * tau), w[1] * np.exp(-m * tau)])
        way = np.array([p * p * integral(2 * (m - f)) - k * k * integral(2 * (m + f)),
                        w[1] * (p * integral(2 * m - f) + k * integral(2 * m + f))])  # fmt: skip
        place = (v - q * w) * t + (1 - q) * np.array([f, 0]) * t * t / 2 + q * way
        speed = (v - q * w) + (1 - q) * np.array([f, 0]) * t + q * now
        across = (-1) ** (n // 2) * np.array([-speed[1], speed[0]]) / np.hypot(*speed)
        center = place + across * (0.02 + A + (1e-9 if n % 2 else -1e-9))
        if np.hypot(*center) < 0.03 + A:  # (where the ball begins)
            continue
        pillar = {
            "shape": "cylinder",
            "point": (*center, 0),
            "axis": (0, 0, 1),
            "radius": 0.02,
            "restitution": 1,
            "friction": 0,
        }
        floor = {"friction": 0.2, "rolling_resistance": c, "slope": tuple(slope)}
        run = carom.simulate(
            carom.Scene(floor=floor, walls=[pillar], balls=[ball], run={"law": "mirror", "duration": t * 1.05})
        )
        hits = run.events.of("wall")
        assert len(hits) == 1 - n % 2
        if hits:
            assert hits[0].t == pytest.approx(t, abs=3e-4)


def test_balls_at_the_foot_of_a_slope_come_to_rest() -> None:
    walls = [{"shape": "plane", "point": (0, 0, 0), "normal": (1, 0, 0), "restitution": 0.6, "friction": 0.1}]
    balls = [{"radius": A, "mass": 0.2, "position": (x, y)} for x, y in ((0.2, 0), (0.5, 0.01))]
    floor = {"friction": 0.2, "rolling_resistance": 0.01, "slope": (-0.05, 0)}
    run = carom.simulate(carom.Scene(floor=floor, walls=walls, balls=balls, run={"duration": 6}))
    assert len(run.log) < 400
    assert run.final.position[:, 0].min() == pytest.approx(A, abs=1e-7)


@pytest.mark.parametrize("other", ["rolling_drag", "spin_drag"])
def test_a_slope_goes_with_constant_resistance(other: str) -> None:
    with pytest.raises(
        carom.CaromError, match=rf"{other}: expected 0 on a floor with a slope, got 0.01; .*closed form"
    ):
        carom.Floor(friction=0.2, slope=(0.01, 0), **{other: 0.01})
    with pytest.raises(
        carom.CaromError, match=r"slope: expected a floor that is less steep than upright, got \[1.0, 0.0\]"
    ):
        carom.Floor(friction=0.2, slope=(1, 0))


@pytest.mark.parametrize(
    ("losses", "said"), [({}, True), ({"spin_friction": 0.02}, False), ({"spin_damping": 0.2}, False)]
)
def test_a_ball_that_spins_on_for_ever_is_named_at_the_end_of_a_run(losses: dict[str, float], said: bool) -> None:
    floor = carom.Floor(friction=0.2, rolling_resistance=0.01, **losses)
    ball = carom.SceneBall(radius=0.03, mass=0.2, position=(0, 0), velocity=(1, 0), spin_z=30, rolling=True)
    words = carom.simulate(carom.Scene(floor=floor, balls=[ball]), duration=12.0).describe()
    line = "Spin on the spot without an end: ball 0; floor.spin_friction is 0, cloth has 0.0125."
    assert (line in words) is said
