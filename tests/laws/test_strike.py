"""The cue strike: published speeds and squirts, conservation, the miscue limit, and an independent solution of the contact."""

from __future__ import annotations

import json
import math
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import carom
from carom.laws.strike import tip_impulse
from carom.scene.scene import scene_dict

BALL = carom.Ball(radius=0.028575, mass=0.17)


def test_a_central_hit_is_two_masses_on_a_line() -> None:
    cue = carom.Cue(mass=0.5, restitution=0.7)
    shot = carom.strike(BALL, cue, speed=2.0)
    assert shot.state.velocity.tolist() == pytest.approx([2.0 * 1.7 * 0.5 / 0.67, 0, 0])
    assert not shot.state.spin.any()
    assert shot.state.velocity[0] - shot.cue_velocity == pytest.approx(0.7 * 2.0)
    assert shot.squirt_deg == 0
    assert not shot.miscue


@pytest.mark.parametrize("offset", [0.1, 0.25, 0.5])
@pytest.mark.parametrize("ratio", [10.0, 22.0, 30.0])
def test_squirt_is_alciatores(offset: float, ratio: float) -> None:
    """TP A.31: tan(squirt) = 5/2 s sqrt(1 - s^2) / (1 + m/m_e + 5/2 (1 - s^2))."""
    cue = carom.Cue(end_mass=BALL.mass / ratio, friction=math.inf)
    k2 = 1 - offset**2
    expected = math.degrees(math.atan(2.5 * offset * math.sqrt(k2) / (1 + ratio + 2.5 * k2)))
    for place in ((offset, 0.0), (-offset, 0.0)):
        shot = carom.strike(BALL, cue, speed=3.0, offset=place)
        assert shot.squirt_deg == pytest.approx(expected, rel=1e-12)
        # a ball that is struck on the right goes to the left
        assert np.sign(shot.state.velocity[1]) == np.sign(place[0])


@pytest.mark.parametrize("offset", [0.0, 0.2, 0.4])
def test_speed_and_spin_without_end_mass_are_those_of_a_rigid_line(offset: float) -> None:
    """TP A.30 with restitution: v = V (1 + e) / (1 + m/M + 5/2 s^2); spin a w = 5/2 s v."""
    cue = carom.Cue(end_mass=1e-12, friction=math.inf)
    shot = carom.strike(BALL, cue, speed=2.0, offset=(0.0, offset))
    v = 2.0 * 1.73 / (1 + 0.17 / 0.54 + 2.5 * offset**2)
    assert shot.state.velocity[0] == pytest.approx(v, rel=1e-9)
    assert shot.state.spin[1] * BALL.radius == pytest.approx(2.5 * offset * v, rel=1e-9)


@pytest.mark.parametrize(("offset", "friction"), [(0.5, 0.577), (0.55, 0.659)])
def test_the_miscue_limit_is_alciatores(offset: float, friction: float) -> None:
    """TP 2.1, which leaves squirt out: with friction 0.577 a tip slips from half a radius on."""
    cue = carom.Cue(end_mass=1e-12, friction=friction)
    assert cue.miscue_offset(BALL) == pytest.approx(offset, abs=5e-4)
    assert not carom.strike(BALL, cue, offset=(offset - 0.01, 0)).miscue
    assert carom.strike(BALL, cue, offset=(offset + 0.01, 0)).miscue


def test_where_the_ball_and_its_spin_go() -> None:
    up = carom.strike(BALL, azimuth_deg=90, offset=(0, 0.3)).state
    assert up.velocity[1] > 0
    assert up.spin[0] < 0  # rolls along +y
    right = carom.strike(BALL, azimuth_deg=180, offset=(0.3, 0)).state
    assert right.velocity[0] < 0
    assert right.spin[2] > 0  # hit on the right it turns counterclockwise, seen from above
    down = carom.strike(BALL, azimuth_deg=30, elevation_deg=90).state
    assert down.velocity == pytest.approx([0, 0, -2 * 1.73 / (1 + 0.17 / 0.54)], abs=1e-12)


STRIKES = st.tuples(
    st.floats(0, 0.97), st.floats(0, 2 * math.pi), st.floats(-180, 180), st.floats(0, 90), st.floats(0.05, 2.0),
    st.floats(1e-4, 0.1), st.floats(0, 1), st.floats(0, 2.0), st.floats(0.1, 2 / 3),
)  # fmt: skip


@given(STRIKES)
def test_against_a_solution_in_space(values: Any) -> None:
    """The mobility of ball and cue as 3 x 3 matrices; friction by its definition; momentum and energy."""
    s, way, azimuth, elevation, mass, end_mass, e, mu, kappa = values
    ball, cue = carom.Ball(0.03, 0.2, kappa), carom.Cue(mass, end_mass, mu, e)
    shot = carom.strike(ball, cue, 1.7, azimuth, elevation, (s * math.cos(way), s * math.sin(way)))
    ca, ce = np.radians(azimuth), np.radians(elevation)
    c = np.array([np.cos(ce) * np.cos(ca), np.cos(ce) * np.sin(ca), -np.sin(ce)])
    right = np.array([np.sin(ca), -np.cos(ca), 0.0])
    up = np.cross(right, c)
    q = math.cos(way) * right + math.sin(way) * up
    n = math.sqrt(1 - s * s) * c - s * q
    one = np.eye(3)
    w = (one + (one - np.outer(n, n)) / kappa) / 0.2 + np.outer(c, c) / mass + (one - np.outer(c, c)) / end_mass
    stick = np.linalg.solve(w, (1 + e) * 1.7 * c)
    t = c - (c @ n) * n
    if np.linalg.norm(stick - (stick @ n) * n) <= mu * (stick @ n) or np.linalg.norm(t) < 1e-12:
        impulse = stick
    else:
        pull = n + mu * t / np.linalg.norm(t)
        impulse = (1 + e) * 1.7 * (c @ n) / (n @ w @ pull) * pull
    np.testing.assert_allclose(shot.impulse, impulse, rtol=1e-9, atol=1e-9 * np.linalg.norm(impulse))
    np.testing.assert_allclose(shot.state.velocity * 0.2, impulse, rtol=1e-9, atol=1e-9)
    arm = np.cross(-0.03 * n, impulse) / (kappa * 0.2 * 0.03**2)
    np.testing.assert_allclose(shot.state.spin, arm, rtol=1e-8, atol=1e-8 * (1 + np.abs(arm).max()))
    # the cue, with its end mass aside, loses what the ball takes, and more
    aside = impulse - (impulse @ c) * c
    left = 0.5 * mass * shot.cue_velocity**2 + 0.5 * (aside @ aside) / end_mass
    assert left + carom.kinetic_energy(ball, shot.state) <= 0.5 * mass * 1.7**2 * (1 + 1e-9)


def test_arrays_and_single_strikes_have_the_same_bits() -> None:
    right = np.linspace(-0.9, 0.9, 600)
    many = carom.strike(
        BALL, speed=np.array([[1.0], [4.0]]), elevation_deg=20.0, offset=np.stack([right, 0.1 + 0 * right], axis=-1)
    )
    assert many.state.velocity.shape == (2, 600, 3)
    for i in (0, 311, 599):
        one = carom.strike(BALL, speed=4.0, elevation_deg=20.0, offset=(right[i], 0.1))
        assert one.impulse.tolist() == many.impulse[1, i].tolist()
        assert one.miscue == many.miscue[1, i]


def test_the_impulse_grows_steadily_into_a_miscue() -> None:
    limit = carom.Cue().miscue_offset(BALL)
    below, above = (tip_impulse(limit + d, 0.03, 0.17, 0.4, 0.54, 0.006, 0.73, 0.6)[:2] for d in (-1e-9, 1e-9))
    np.testing.assert_allclose(below, above, rtol=1e-6)


def test_jump_and_masse_follow() -> None:
    floor = carom.Floor(friction=0.2, restitution=0.5)
    ball = {"radius": 0.028575, "mass": 0.17, "position": (0, 0)}

    def run(**how: Any) -> carom.Trajectory:
        scene = carom.Scene(floor=floor, balls=[carom.SceneBall(**ball, strike=how)], run=carom.Run(duration=2))
        return carom.simulate(scene)

    jump = run(speed=4, elevation=40)
    down = -jump.start.velocity[0, 2]
    # it leaves the slate with half of the speed at which it was pressed down
    top = 0.5 * down / 9.80665
    assert jump.at(top).position[0, 2] - 0.028575 == pytest.approx((0.5 * down) ** 2 / (2 * 9.80665), rel=1e-9)
    masse = run(speed=4, elevation=70, offset=(0.4, -0.2))
    x, y = masse.at(np.linspace(0, 2, 50)).position[:, 0, :2].T
    heading = np.degrees(np.unwrap(np.arctan2(np.diff(y), np.diff(x))))
    assert heading[-1] < heading[0] - 10  # hit on the right it curves to the right
    straight = run(speed=3, elevation=0, offset=(0.4, -0.2))
    assert abs(np.degrees(np.arctan2(*straight.final.velocity[0, 1::-1]))) < 3


@pytest.mark.parametrize("restitution", [0.0, 0.5])
@pytest.mark.parametrize(
    ("elevation", "offset"), [(30, (0.4, 0.0)), (60, (0.3, -0.2)), (75, (-0.2, -0.4)), (50, (0.0, -0.45))]
)
def test_a_masse_ends_along_coriolis_line(elevation: float, offset: tuple[float, float], restitution: float) -> None:
    """Coriolis (1835), TP A.19: without squirt it ends along the line from where it rested to where the axis meets the cloth."""
    radius, floor = 0.03, carom.Floor(friction=0.2, restitution=restitution)
    how = {"speed": 3, "elevation": elevation, "offset": offset, "cue": {"end_mass": 1e-12, "friction": math.inf}}
    ball = carom.SceneBall(radius=radius, mass=0.2, position=(0, 0), strike=how)
    final = carom.simulate(carom.Scene(floor=floor, balls=[ball], run=carom.Run(duration=4))).final.velocity[0]
    c = np.array([np.cos(np.radians(elevation)), 0, -np.sin(np.radians(elevation))])
    start = np.array([0, 0, radius]) + radius * (offset[0] * np.array([0, -1, 0]) + offset[1] * np.cross([0, -1, 0], c))
    aim = start + c * start[2] / -c[2]
    assert np.degrees(np.arctan2(final[1], final[0])) == pytest.approx(np.degrees(np.arctan2(aim[1], aim[0])), abs=1e-6)


@pytest.mark.parametrize(
    ("options", "said"),
    [
        ({"speed": 0}, "strike: speed: expected a speed in m/s, > 0, got 0"),
        ({"elevation_deg": -1}, "strike: elevation_deg: expected an angle in degrees, 0 to 90, got -1"),
        (
            {"offset": (0.8, 0.7)},
            r"strike: offset: expected a point on the ball, .*got \[0.8, 0.7\]; the tip would miss the ball",
        ),
        ({"offset": 0.5}, r"strike: offset: expected 2 numbers"),
        ({"offset": (math.nan, 0)}, r"strike: offset: expected"),
        ({"cue": 0.54}, "strike: cue: expected a Cue"),
    ],
)
def test_faults_are_told(options: Any, said: str) -> None:
    with pytest.raises(carom.CaromError, match=said):
        carom.strike(BALL, **options)


def test_a_cue_tells_all_its_faults() -> None:
    with pytest.raises(carom.CaromError) as caught:
        carom.Cue(mass=0, friction=-1, restitution=2)
    assert len(caught.value.faults) == 3


def test_a_scene_says_what_is_wrong_with_a_strike() -> None:
    ball = {"radius": 0.03, "mass": 0.2, "position": (0, 0)}
    with pytest.raises(carom.CaromError, match=r"strike.offset: expected .* got \[1.0, 0.2\]; the tip would miss"):
        carom.SceneBall(**ball, strike={"speed": 1, "offset": (1, 0.2)})
    with pytest.raises(carom.CaromError, match="strike: expected no velocity and no spin with strike, got both"):
        carom.SceneBall(**ball, velocity=(1, 0), strike={"speed": 1})


def test_a_struck_scene_is_saved_and_shown_as_it_is(tmp_path: Any) -> None:
    text = """
    [floor]
    friction = 0.2
    [[balls]]
    radius = 0.03
    mass = 0.2
    position = [0.0, 0.0]
    strike = { speed = "2 m/s", azimuth = "0.5 rad", elevation = 3, offset = [0.2, -0.1], cue = { mass = "0.5 kg" } }
    [run]
    duration = 1
    """
    (tmp_path / "shot.toml").write_text(text)
    scene = carom.load_scene(tmp_path / "shot.toml")
    run = carom.simulate(scene)
    again = carom.load_trajectory(run.save(tmp_path / "run.parquet"))
    assert again.scene == scene
    plain = carom.Scene(**json.loads(json.dumps(scene_dict(scene))))
    assert carom.simulate(plain).log.tobytes() == run.log.tobytes()
