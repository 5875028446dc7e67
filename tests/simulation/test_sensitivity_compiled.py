"""The pass over a log, compiled and as Python: the same bits on random scenes; many starts at once; what is refused."""

from __future__ import annotations

import functools
import math
from typing import Any

import numpy as np
import pytest
from reference.exploring import tried
from reference.scenes_of_all_laws import scene_of_all_laws
from reference.sensitivity_differences import paths_of

import carom
from carom.core.jit.dual import LANES, seeded
from carom.core.jit.threads import limit_threads, thread_count
from carom.scene.toml import replaced
from carom.simulation.records import SceneArrays, set_up
from carom.simulation.sensitivity.follow import (
    Column,
    _columns_of,
    _differences,
    _step_of,
    follow_compiled,
    follow_interpreted,
    parameters_of,
    shifted_scene,
)


def both(run: carom.Trajectory, paths: Any) -> tuple[Any, Any]:
    """Follow the log of a run in Python and compiled; CaromError where both end at a graze."""
    scene, log = run.scene, run.log
    parameters = parameters_of(scene, set_up(scene), paths, log["phase"][: len(scene.balls)].tolist())
    plain, row = follow_interpreted(scene, parameters, log)
    compiled, other = follow_compiled(scene, parameters, log, run.end)
    assert row == other
    if row >= 0:
        raise carom.CaromError("a graze")
    return plain, compiled


def same(one: Any, two: Any) -> bool:
    return np.array_equal(one, two, equal_nan=True)


# A scene whose wall presses a ball on the floor again and again: 0.7 s an impact as Python.
PRESSED = (10,)


@pytest.mark.parametrize("block", range(6))
@pytest.mark.slow(keep=1)
def test_compiled_and_interpreted_passes_have_the_same_bits(block: int) -> None:
    compared = 0
    for seed in range(10 * block, 10 * block + tried(5, 10)):
        scene = scene_of_all_laws(seed)
        most = tried(12, 40) if seed in PRESSED else 40
        scene = replaced(scene, {"run.max_events": min(most, scene.run.max_events or most)})
        paths = paths_of(scene)
        try:
            run = carom.simulate(scene)
            plain, compiled = both(run, paths)
        except carom.CaromError:  # (no run, a parameter that the scene fixes, or a graze)
            continue
        assert same(plain.derivatives, compiled.derivatives), seed
        assert all(same(plain.values[name], compiled.values[name]) for name in plain.values.dtype.names), seed
        for t in (0.6 * run.end, run.end):
            assert all(same(one, two) for one, two in zip(plain.at(t), compiled.at(t), strict=True)), seed
        compared += np.any(compiled.derivatives[..., 0] != 0)
    assert compared >= tried(3, 7)


def shot(**more: Any) -> carom.Scene:
    """Two balls, a wall and a floor: hops, slides, rolls, a collision."""
    wall = carom.scene.Plane(point=(0, 0, 0), normal=(1, 0, 0), restitution=0.85, friction=0.2)
    ball = carom.SceneBall(radius=0.03, mass=0.2, position=(1, 0), velocity=(-2, 0.3), **more)
    other = carom.SceneBall(radius=0.03, mass=0.2, position=(0.5, 0.1))
    floor = carom.Floor(friction=0.2, restitution=0.5, rolling_resistance=0.01)
    return carom.Scene(floor=floor, walls=[wall], balls=[ball, other], run=carom.Run(duration=2))


# more columns than the compiled pass follows at once
MANY_PATHS = ["balls.0.velocity", "balls.0.position", "balls.1.position", "walls.0.friction", "walls.0.restitution"]
MANY_PATHS += ["floor.friction", "floor.restitution", "ball_contact.friction", "ball_contact.restitution"]


def test_more_parameters_than_lanes() -> None:
    paths = MANY_PATHS
    run = carom.simulate(shot())
    plain, compiled = both(run, paths)
    assert compiled.derivatives.shape[-1] > LANES
    assert same(plain.derivatives, compiled.derivatives)
    # (each column by itself is what it is among others)
    alone = both(run, paths[-1:])[1]
    assert same(alone.derivatives[..., 0], compiled.derivatives[..., -1])


def test_wall_and_floor_at_once() -> None:
    nose = carom.scene.Plane(point=(0, 0, 0), normal=(1, 0, -0.2), restitution=0.85, friction=0.2)
    run = carom.simulate(replaced(shot(), {"walls": (nose,)}))
    assert run.log["floor_impulse"].any()
    plain, compiled = both(run, ["balls.0.velocity", "walls.0.friction", "floor.friction"])
    assert same(plain.derivatives, compiled.derivatives)


def _shifted_arrays(scene: carom.Scene, column: Column, by: float) -> SceneArrays:
    return set_up(shifted_scene(scene, column, by), compiled=False)


def test_parameters_that_the_arrays_hold_themselves_are_not_differenced() -> None:
    scene = shot()
    setup = set_up(scene, compiled=False)
    for path in (
        "balls.0.velocity",
        "balls.0.mass",
        "walls.0.friction",
        "floor.restitution",
        "floor.rolling_resistance",
    ):
        found = parameters_of(scene, setup, path, [1, 4])
        for column, slopes in zip(_columns_of(scene, path, [1, 4]), found.slopes, strict=True):
            shifted = functools.partial(_shifted_arrays, scene, column)
            expected = _differences(setup, shifted, _step_of(column))
            assert expected is not None
            for name, fields in expected.items():
                for field, slope in fields.items():
                    assert slopes[name][field] == pytest.approx(slope, abs=1e-12), (column.name, name, field)
    assert parameters_of(scene, setup, "balls.0.velocity", [1, 4]) is parameters_of(
        scene, setup, "balls.0.velocity", [1, 4]
    )


def test_many_starts_are_those_of_single_runs_on_any_number_of_cores() -> None:
    scene, paths = shot(), ["balls.0.velocity", "balls.0.position", "walls.*.friction"]
    angles = np.linspace(-0.02, 0.02, 7)
    velocity = np.zeros((7, 2, 3))
    velocity[:, 0, 0], velocity[:, 0, 1] = -2 * np.cos(angles), 0.3 + np.sin(angles)
    many = carom.sensitivities(scene, paths, velocity=velocity)
    plain = carom.simulate_many(scene, velocity=velocity)
    assert many.columns == [
        "balls.0.velocity.x", "balls.0.velocity.y", "balls.0.position.x", "balls.0.position.y", "walls.*.friction",
    ]  # fmt: skip
    assert same(many.final.position, plain.final.position)
    assert same(many.final.spin, plain.final.spin)
    assert (many.phase == plain.phase).all()
    for n, (x, y, _z) in enumerate(velocity[:, 0].tolist()):
        one = carom.simulate(replaced(scene, {"balls.0.velocity": (x, y)})).sensitivity(paths).final
        for name in one._fields:
            expected = getattr(one, name)
            error = np.abs(getattr(many.derivatives, name)[n] - expected).max()
            assert error <= 1e-12 * np.abs(expected).max() * max(many.count[n], 1)
    threads = thread_count()
    limit_threads(1)
    try:
        again = carom.sensitivities(scene, paths, velocity=velocity)
    finally:
        limit_threads(threads)
    assert same(many.derivatives.position, again.derivatives.position)


def test_many_starts_with_more_parameters_than_lanes() -> None:
    scene = shot()
    start = [[ball.state.velocity.tolist() for ball in scene.balls]]
    many = carom.sensitivities(scene, MANY_PATHS, velocity=start)
    one = carom.simulate(scene).sensitivity(MANY_PATHS)
    assert many.columns == one.columns
    assert len(many.columns) > LANES
    for name in one.final._fields:
        expected = getattr(one.final, name)
        np.testing.assert_allclose(
            getattr(many.derivatives, name)[0], expected, rtol=1e-9, atol=1e-9 * np.abs(expected).max()
        )


def test_a_run_of_many_that_has_no_derivative_says_why() -> None:
    # at y = 0.2 the ball touches the post's side at a right angle to its way
    post = carom.scene.Cylinder(point=(0, 0, 0), axis=(0, 0, 1), radius=0.1, law="mirror")
    ball = carom.SceneBall(radius=0.1, mass=1.0, position=(-1, 0, 0), velocity=(1, 0, 0))
    scene = carom.Scene(gravity=0, walls=[post], balls=[ball], run=carom.Run(duration=1.5))
    y = 0.2 * (1 - 1e-15)
    many = carom.sensitivities(scene, "balls.0.velocity.y", position=[[-1, 0.1, 0], [-1, y, 0], [-1, 0.3, 0]])
    assert many.why[0] == many.why[2] == ""
    if many.count[1]:
        assert "graze" in many.why[1]
        assert np.isnan(many.derivatives.position[1]).all()
    # what flies past moves by T
    assert many.derivatives.position[2, 0, 1, 0] == pytest.approx(1.5, rel=1e-12)


def test_a_long_run_among_many() -> None:
    walls = [
        carom.scene.Plane(point=point, normal=normal, law="mirror")
        for point, normal in (
            ((0, 0, 0), (1, 0, 0)),
            ((1, 0, 0), (-1, 0, 0)),
            ((0, 0, 0), (0, 1, 0)),
            ((0, 1, 0), (0, -1, 0)),
        )
    ]
    ball = carom.SceneBall(radius=0.1, mass=1.0, position=(0.5, 0.5, 0.5), velocity=(1, 0.3, 0.2))
    scene = carom.Scene(gravity=0, walls=walls, balls=[ball], run=carom.Run(max_events=1000))
    many = carom.sensitivities(scene, "balls.0.velocity", velocity=[[1, 0.3, 0.2], [1.1, 0.3, 0.2]])
    assert (many.count == 1000).all()
    # x_n = (-1)^n (x_0 + v t) + ..., at the fixed end
    assert np.abs(many.derivatives.position[:, 0, 0, 0]) == pytest.approx(many.end, rel=1e-9)


def own(v: Any, w: Any, n: Any, a: float, kappa: float, e: float, mu: float, beta: float) -> Any:
    """Every function that a law of one's own may call."""
    u = -(v[0] * n[0] + v[1] * n[1] + v[2] * n[2])
    c = math.exp(-u * u) + math.log(1 + u) / (1 + math.tanh(u)) + math.atan2(u, 1 + e) + math.hypot(u, e)
    c += math.sin(u) * math.cos(u) - math.sinh(u) / math.cosh(u) + math.asin(u / 9) * math.acos(u / 9) + math.tan(u / 9)
    c += math.atan(u) + math.expm1(-u) + math.log1p(u) + max(u, e) * min(u, e, 0.5) + abs(-u) + math.sqrt(u) + u**2
    c += math.copysign(u, -e) + math.floor(u) + int(u) + float(u)
    if math.isfinite(u) and not math.isnan(c):
        c = 1 + e + 0.01 * c
    return (v[0] + c * u * n[0], v[1] + c * u * n[1], v[2] + c * u * n[2]), w


@pytest.mark.slow
def test_a_law_of_ones_own_is_compiled_too() -> None:
    law = carom.wall_law(carom.Card("own", "A test.", (), "", "", ""), own, reads=("restitution",))
    wall = carom.scene.Plane(point=(0, 0, 0), normal=(1, 0, 0), restitution=0.5, friction=0.0, law=law)
    ball = carom.SceneBall(radius=0.1, mass=1.0, position=(1.1, 0, 0), velocity=(-2.3, 1, 0))
    run = carom.simulate(carom.Scene(gravity=0, walls=[wall], balls=[ball], run=carom.Run(duration=1)))
    plain, compiled = both(run, ["balls.0.velocity.x", "walls.0.restitution"])
    assert plain.derivatives == pytest.approx(compiled.derivatives, rel=1e-12, nan_ok=True)
    step = 1e-6
    ends = []
    for v in (-2.3 + step, -2.3 - step):
        moved = replaced(run.scene, {"balls.0.velocity": (v, 1, 0)})
        ends.append(carom.simulate(moved).final.velocity[0, 0])
    assert compiled.at(run.end)[1][0, 0, 0] == pytest.approx((ends[0] - ends[1]) / (2 * step), rel=1e-7)


def test_what_only_compiled_code_has_says_so() -> None:
    with pytest.raises(TypeError, match="seeded: expected a call from compiled code"):
        seeded(1.0, 0, 1.0)
