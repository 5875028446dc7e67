"""Derivatives of runs: closed forms, tangent maps, differences of whole runs, and what is refused."""

from __future__ import annotations

import json
import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from reference.commands import command, fails
from reference.pressed_shots import LIMIT, compare_shot
from reference.sensitivity_differences import compare

import carom

RADIUS = 0.1


def bullet(x: float, v: float, **more: Any) -> carom.SceneBall:
    return carom.SceneBall(radius=RADIUS, mass=1.0, position=(x, 0, 0), velocity=(v, 0, 0), **more)


def test_two_elastic_balls_of_nimblephysics_issue_97() -> None:
    # github.com/keenon/nimblephysics/issues/97: the struck ball ends at x1 + v0 T + 2 r, whatever its own start
    contact = carom.BallContact(restitution=1.0, friction=0.0)
    balls = [bullet(0.0, 1.0), bullet(0.52, 0.0)]
    scene = carom.Scene(gravity=0, balls=balls, ball_contact=contact, run=carom.Run(duration=1.0))
    wrt = ["balls.0.position.x", "balls.1.position.x", "balls.0.velocity.x", "balls.1.velocity.x"]
    found = carom.simulate(scene).sensitivity(wrt)
    assert found.final.position[1, 0] == pytest.approx([1, 0, 1, 0], abs=1e-12)
    assert found.final.position[0, 0] == pytest.approx([0, 1, 0, 1], abs=1e-12)


def test_a_ball_dropped_on_the_floor() -> None:
    # one bounce of restitution e: z(T) = a + e w s - g s^2/2, w = sqrt(2 g h), s = T - w/g
    g, h, e, end = 9.8, 0.7, 0.8, 0.6
    scene = carom.Scene(
        gravity=g,
        floor=carom.Floor(restitution=e, friction=0.1),
        balls=[carom.SceneBall(radius=RADIUS, mass=1.0, position=(0, 0, RADIUS + h))],
        run=carom.Run(duration=end),
    )
    run = carom.simulate(scene)
    found = run.sensitivity(["balls.0.position.z", "floor.restitution", "balls.0.velocity.z"])
    w = math.sqrt(2 * g * h)
    s = end - w / g
    rise = (g / w) * (e * s - e * w / g + s)  # dw/dh = g/w, ds/dw = -1/g
    assert found.events[0].time[0] == pytest.approx(1 / w, rel=1e-12)
    assert found.final.position[0, 2, 0] == pytest.approx(rise, rel=1e-10)
    assert found.final.position[0, 2, 1] == pytest.approx(w * s, rel=1e-12)
    assert found.margin[0].which == "graze"
    assert found.margin[0].distance == pytest.approx(w, rel=1e-12)


def test_elastic_flight_in_a_box_preserves_phase_space_volume() -> None:
    box = carom.scene.Plane(point=(0, 0, 0), normal=(1, 0, 0), law="mirror")
    post = carom.scene.Cylinder(point=(1.2, 0.3, 0), axis=(0, 0, 1), radius=0.2, law="mirror")
    ball = carom.SceneBall(radius=RADIUS, mass=1.0, position=(0.5, 0.1, 0), velocity=(1.0, 0.25, 0.1))
    scene = carom.Scene(gravity=0, walls=[box, post], balls=[ball], run=carom.Run(duration=1.5))
    run = carom.simulate(scene)
    assert len(run.events) == 2
    found = run.sensitivity(["balls.0.position", "balls.0.velocity"]).final
    map_ = np.concatenate([found.position[0], found.velocity[0]])
    form = np.block([[np.zeros((3, 3)), np.eye(3)], [-np.eye(3), np.zeros((3, 3))]])
    assert np.linalg.det(map_) == pytest.approx(1.0, abs=1e-11)
    assert map_.T @ form @ map_ == pytest.approx(form, abs=1e-11)


@pytest.mark.parametrize("seed", [0, 1, 4, 20, 36, 81, 92])
@pytest.mark.slow(keep=1)
def test_random_scenes_against_extrapolated_differences(seed: int) -> None:
    cases = [case for case in compare(seed) if case.verdict == "compared"]
    assert cases
    for case in cases:
        assert case.error <= 1e-7 + 30 * case.doubt, case


def test_states_between_events_and_a_shared_column() -> None:
    scene = _shot()
    run = carom.simulate(scene)
    found = run.sensitivity(["balls.0.velocity", "walls.*.friction"])
    assert found.columns == ["balls.0.velocity.x", "balls.0.velocity.y", "walls.*.friction"]
    assert found.at(0.0).velocity[0, :2, :2] == pytest.approx(np.eye(2))
    assert found.final.position.shape == (1, 3, 3)
    assert found.what_matters().shape == (1, 3)
    assert len(found.events) == len(found.margin) == len(run.events)


def _shot() -> carom.Scene:
    wall = carom.scene.Plane(point=(0, 0, 0), normal=(1, 0, 0), restitution=0.85, friction=0.2)
    ball = carom.SceneBall(radius=0.03, mass=0.2, position=(1, 0), velocity=(-2, 1), rolling=True)
    return carom.Scene(floor=carom.Floor(friction=0.2), walls=[wall], balls=[ball], run=carom.Run(duration=2))


@pytest.mark.parametrize(
    ("wrt", "message"),
    [
        (["balls.0.velocty"], "did you mean 'balls.0.velocity'"),
        (["run.law"], "expected a finite real number"),
        ([], "expected one or more paths"),
        (["walls.0.normal.w"], "expected"),
    ],
)
def test_wrong_paths_are_refused_in_one_line(wrt: list[str], message: str) -> None:
    run = carom.simulate(_shot())
    with pytest.raises(carom.CaromError) as caught:
        run.sensitivity(wrt)
    assert message in str(caught.value)
    assert "\n" not in str(caught.value)


def test_the_motion_of_a_ball_at_rest_is_refused() -> None:
    ball = carom.SceneBall(radius=0.03, mass=0.2, position=(1, 0))
    run = carom.simulate(carom.Scene(floor=carom.Floor(friction=0.2), balls=[ball], run=carom.Run(duration=1)))
    with pytest.raises(carom.CaromError, match="expected a ball that moves"):
        run.sensitivity("balls.0.velocity")
    # one that turns about the vertical goes on turning: its spin has a derivative
    ball = carom.SceneBall(radius=0.03, mass=0.2, position=(1, 0), velocity=(0, 0), rolling=True, spin_z=5.0)
    floor = carom.Floor(friction=0.2, spin_friction=0.01)
    run = carom.simulate(carom.Scene(floor=floor, balls=[ball], run=carom.Run(duration=0.1)))
    assert run.sensitivity("balls.0.spin_z").final.spin[0].tolist() == [[0.0], [0.0], [1.0]]


def _soft(v: Any, w: Any, n: Any, a: float, kappa: float, e: float, mu: float, last: float) -> Any:
    u = -(v[0] * n[0] + v[1] * n[1] + v[2] * n[2])
    c = (1 + e / math.sqrt(1 + u * u)) * u
    return (v[0] + c * n[0], v[1] + c * n[1], v[2] + c * n[2]), w


def _arrays(v: Any, w: Any, n: Any, a: float, kappa: float, e: float, mu: float, last: float) -> Any:
    u = np.sqrt(v[0] * v[0] + v[1] * v[1])
    return (u * n[0], u * n[1], v[2]), w


def _meets(law: carom.Law) -> carom.Trajectory:
    wall = carom.scene.Plane(point=(0, 0, 0), normal=(1, 0, 0), restitution=0.5, friction=0.0, law=law)
    ball = carom.SceneBall(radius=RADIUS, mass=1.0, position=(1.1, 0, 0), velocity=(-2, 1, 0))
    return carom.simulate(carom.Scene(gravity=0, walls=[wall], balls=[ball], run=carom.Run(duration=1)))


def test_a_law_of_the_users_own_has_its_derivative() -> None:
    law = carom.wall_law(carom.Card("soft", "A test.", (), "", "", ""), _soft, reads=("restitution",))
    found = _meets(law).sensitivity(["balls.0.velocity.x", "walls.0.restitution"]).final.velocity[0, 0]
    # v' = e u / sqrt(1 + u^2), u = -v = 2
    assert found == pytest.approx([-0.5 / 5**1.5, 2 / math.sqrt(5)], rel=1e-10)


def test_a_law_that_leaves_pythons_numbers_is_refused() -> None:
    law = carom.wall_law(carom.Card("arrays", "A test.", (), "", "", ""), _arrays)
    with pytest.raises(carom.CaromError, match="expected a function that Numba compiles"):
        _meets(law).sensitivity(["balls.0.velocity.x"])


CELL = """
GAIN = {gain}
def own(v, w, n, a, kappa, e, mu, last):
    c = -(1 + GAIN) * (v[0] * n[0] + v[1] * n[1] + v[2] * n[2])
    return (v[0] + c * n[0], v[1] + c * n[1], v[2] + c * n[2]), w
"""


@pytest.mark.parametrize("interpreted", [True, False])
def test_a_law_that_is_defined_again_has_its_own_derivative(interpreted: bool, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("carom.simulation.sensitivity.follow._worth_interpreting", lambda *_given: interpreted)
    space: dict[str, Any] = {"__name__": "a_notebook"}
    for gain in (0.5, 0.9):
        exec(CELL.format(gain=gain), space)
        law = carom.wall_law(carom.Card("own", "A test.", (), "", "", ""), space["own"])
        found = _meets(law).sensitivity(["balls.0.velocity.x"]).final.velocity[0, 0]
        assert found == pytest.approx([-gain], rel=1e-12)


# A slip that ends straight (off by 1e10 and by 50 before), after low hops, and any others.
@pytest.mark.parametrize("seed", [1075, 147, 1087, 0, 14])
def test_shots_at_a_nose_against_differences(seed: int) -> None:
    cases = compare_shot(seed)
    assert any(case.verdict == "compared" for case in cases)
    assert all(case.worst < LIMIT for case in cases)


def test_a_whole_shot_against_differences() -> None:
    assert [case.worst < LIMIT for case in compare_shot(0, whole=True)] == [True, True]


def test_a_spin_has_three_columns_on_the_floor_too() -> None:
    wall = carom.scene.Plane(point=(0, 0, 0), normal=(1, 0, 0), restitution=0.85, friction=0.2)
    ball = carom.SceneBall(radius=0.03, mass=0.2, position=(1, 0), velocity=(-2, 0.3), spin=(1.0, 0.5, 20.0))
    floor = carom.Floor(friction=0.2, restitution=0.5)
    scene = carom.Scene(floor=floor, walls=[wall], balls=[ball], run=carom.Run(duration=1.5))
    found = carom.simulate(scene).sensitivity(["balls.0.velocity", "balls.0.spin"])
    names = ["velocity.x", "velocity.y", "spin.x", "spin.y", "spin.z"]
    assert found.columns == [f"balls.0.{name}" for name in names]
    alone = carom.simulate(scene).sensitivity("balls.0.spin.2")
    assert np.array_equal(found.final.velocity[..., 4], alone.final.velocity[..., 0])
    assert np.any(alone.final.velocity)
    many = carom.sensitivities(scene, "balls.*.spin")
    assert many.columns == [f"balls.*.spin.{name}" for name in "xyz"]
    assert np.array_equal(many.derivatives.velocity[0, ..., 2], alone.final.velocity[..., 0])


def test_the_table_of_what_matters(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    ball = "radius = 0.03\nmass = 0.2\nvelocity = [1.0, 0.2]\nposition = [0, 0]\nrolling = true\n"
    (tmp_path / "shot.toml").write_text(f"[floor]\nfriction = 0.2\nrolling_resistance = 0.02\n[[balls]]\n{ball}")
    words = ["simulate", str(tmp_path / "shot.toml"), "--sensitivity"]
    code, told, notes = command(capsys, *words, "balls.0.velocity,floor.rolling_resistance", "--json")
    assert code == 0, notes
    rows = json.loads(told)["sensitivity"]
    # the way is v^2 / (2 c g): 2 % of the part along x for 1 % of v_x, and the resistance's 1 %
    way = (1.0 + 0.04) / (2 * 0.02 * 9.80665)
    assert [row["parameter"] for row in rows] == [
        "balls.0.velocity.x",
        "balls.0.velocity.y",
        "floor.rolling_resistance",
    ]
    assert rows[2]["mm_per_cent"][0] == pytest.approx(10 * way, rel=1e-6)
    assert "What matters" in command(capsys, *words, "balls.0.velocity,floor.rolling_resistance")[1]
    assert "did you mean 'balls.0.velocity'" in " ".join(fails(capsys, *words, "balls.0.velocty"))
    # an angle is changed by a degree: 1 % of 0 degrees is nothing
    struck = "radius = 0.03\nmass = 0.2\nposition = [0, 0]\nstrike = { speed = 1.0, azimuth = 0.0 }\n"
    (tmp_path / "shot.toml").write_text(f"[floor]\nfriction = 0.2\nrolling_resistance = 0.02\n[[balls]]\n{struck}")
    found = json.loads(command(capsys, *words, "balls.0.strike.azimuth", "--json")[1])
    way = math.hypot(*found["final"][0]["position"][:2])
    assert found["sensitivity"][0]["mm_per_degree"][0] == pytest.approx(1e3 * math.radians(way), rel=1e-6)


def test_the_end_of_a_slide_on_a_slope_to_the_rounding_of_its_time() -> None:
    """The clock in which a slip turns is infinite at its end; a unit in the last place before, it had no derivatives."""
    ball = {
        "radius": 0.029383410938544983, "mass": 0.22, "position": (0.19530171550644548, -0.3432228327463358, 0.029383410938544983),
        "velocity": (-1.0637543123395488, 1.3736137187194233, 1.1754387565172353),
        "spin": (-5.3020849365350315, 0.1806709664797991, 20.268190221866455),
    }  # fmt: skip
    floor = {"friction": 0.2, "slope": (-0.044275603848393776, 0.04568653498804298)}
    scene: Any = carom.Scene(gravity=7.0352182361844475, floor=floor, balls=[ball], run={"duration": 0.6})
    found = carom.simulate(scene).sensitivity(["balls.0.velocity"]).at(0.56)
    ends = [
        carom.simulate(
            carom.replaced(
                scene, {"balls.0.velocity": (ball["velocity"][0], ball["velocity"][1] + h, ball["velocity"][2])}
            )
        )
        for h in (1e-5, -1e-5)
    ]
    expected = (ends[0].at(0.56).position - ends[1].at(0.56).position)[0] / 2e-5
    assert found.position[0, :, 1] == pytest.approx(expected, abs=1e-8)


def test_a_wall_that_stops_pressing_a_ball_on_a_floor_of_infinite_friction() -> None:
    """The floor takes its slip from the ball at once, up to where the wall's friction no longer presses the ball down."""
    ball = {
        "radius": 0.028631705131047243, "mass": 0.0971, "position": (0.6092708223057393, -0.5113711810276402, 0.028631705131047243),
        "velocity": (1.7859831458215223, 1.4617421960047128, 0.0),
        "spin": (10.606962561177403, -17.474524551266096, 51.78673765861679),
    }  # fmt: skip
    wall = {"shape": "strip", "point": (0, 0, 0), "normal": (1, 0.2, 0), "width": 2.0, "friction": 0.47629234871928366}
    scene: Any = carom.Scene(
        gravity=0.0,
        floor={"friction": math.inf},
        walls=[wall | {"restitution": {"form": "han-2005"}}],
        balls=[ball],
        run={"duration": 1.3},
    )
    found = carom.simulate(scene).sensitivity(["balls.0.radius", "walls.0.friction"])
    for c, (path, value) in enumerate({"balls.0.radius": ball["radius"], "walls.0.friction": wall["friction"]}.items()):
        h = 1e-6 * value
        ends = [carom.simulate(carom.replaced(scene, {path: value + d})).at(1.0).velocity[0] for d in (h, -h)]
        assert found.at(1.0).velocity[0, :, c] == pytest.approx((ends[0] - ends[1]) / (2 * h), abs=1e-6)


def test_a_ball_in_a_corner_of_walls_that_yield_meets_the_one_that_it_falls_back_to() -> None:
    """It has turned in both, and gravity drives it back into one, of which it is farther from the face."""
    ball = {
        "radius": 0.03703842832814348, "mass": 0.0965, "inertia": 0.3,
        "position": (-0.5788931403620415, -0.20416646047327003, 0.48786916839480343),
        "velocity": (-1.0124621413556203, -1.7465259048500728, 0.9669704088396809),
    }  # fmt: skip
    wall = {
        "shape": "regular", "sides": 3, "radius": 1.0, "restitution": 0.010593787393216259, "friction": 0.23837497279194453,
        "tangential_restitution": -0.3677207324877576, "contact_time": 3e-4, "yield_time": 0.0006879554303687932,
    }  # fmt: skip
    contact: Any = {"young": 5.84e9, "poisson": 0.34, "law": "contact", "overlap": True}
    scene: Any = carom.Scene(
        gravity=(0.1, -0.2, -9.0),
        walls=[wall],
        balls=[ball],
        ball_contact=contact,
        run={"duration": 1.0, "max_events": 8},
    )
    found = carom.simulate(scene).sensitivity(["balls.0.velocity", "walls.0.friction"]).at(0.2731)
    vx, vy, vz = ball["velocity"]
    for c, changed in (
        (1, lambda h: {"balls.0.velocity": (vx, vy + h, vz)}),
        (3, lambda h: {"walls.0.friction": wall["friction"] + h}),
    ):
        ends = [carom.simulate(carom.replaced(scene, changed(h))).at(0.2731).velocity[0] for h in (1e-6, -1e-6)]
        assert found.velocity[0, :, c] == pytest.approx((ends[0] - ends[1]) / 2e-6, abs=1e-5)
