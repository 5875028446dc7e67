"""States and derivatives at the times of frames, of one run and of many, with all balls."""

import numpy as np
import pytest

import carom

WRT = [
    "balls.0.velocity",
    "balls.0.spin",
    "balls.1.position",
    "walls.0.restitution",
    "floor.friction",
    "ball_contact.friction",
]
TIMES = np.linspace(0.0, 2.5, 40)


@pytest.fixture(scope="module")
def scene():
    ball = {"radius": 0.03075, "mass": 0.21}
    return carom.Scene(
        floor=carom.Floor(friction=0.2, rolling_resistance=0.006, spin_friction=0.01),
        walls=[carom.Table(length=2.84, width=1.42, nose_height=0.037, restitution=0.85, friction=0.2)],
        balls=[
            ball | {"position": (-0.9, -0.3), "velocity": (3.0, 0.9), "spin": (-10.0, 60.0, 30.0)},
            ball | {"position": (-0.3, -0.1)},
            ball | {"position": (0.8, 0.3)},
        ],
        ball_contact={"restitution": 0.93, "friction": 0.06},
        run={"duration": 3.0},
    )


def test_times_of_one_run_are_those_asked_one_by_one(scene):
    s = carom.simulate(scene).sensitivity(WRT)
    found = s.at(TIMES)
    assert found.position.shape == (40, 3, 3, len(s.columns))
    for i in (0, 7, 39):
        one = s.at(float(TIMES[i]))
        for all_of, alone in zip(found, one, strict=True):
            assert np.array_equal(all_of[i], alone)
    assert np.array_equal(s.at(3.0).position, s.final.position)
    assert s.at(TIMES.reshape(8, 5)).spin.shape == (8, 5, 3, 3, len(s.columns))
    with pytest.raises(carom.CaromError, match="times from 0 to 3 s"):
        s.at([1.0, 3.5])


def test_many_runs_at_times_are_single_runs(scene):
    start = scene.balls[0].state.velocity
    velocity = np.zeros((3, 3, 3))
    velocity[:, 0] = np.outer([1.0, 0.9, 1.1], start)
    many = carom.sensitivities(scene, WRT, velocity=velocity, times=TIMES)
    assert many.states.position.shape == (3, 40, 3, 3)
    for n in range(3):
        run = carom.simulate(carom.replaced(scene, {"balls.0.velocity": tuple(velocity[n, 0].tolist())}))
        assert np.array_equal(run.at(TIMES).position, many.states.position[n])
        assert np.array_equal(run.at(TIMES).spin, many.states.spin[n])
        at = run.sensitivity(WRT).at(TIMES)
        assert np.array_equal(at.position, many.slopes.position[n])
        assert np.array_equal(at.velocity, many.slopes.velocity[n])


def test_derivatives_at_times_are_central_differences(scene):
    run = carom.simulate(scene)
    s = run.sensitivity(["walls.0.restitution", "ball_contact.friction"])
    exact = s.at(TIMES).position
    for c, path in enumerate(s.columns):
        h = 1e-6
        ends = [
            carom.simulate(carom.replaced(scene, {path: s.values[c] + sign * h})).at(TIMES).position for sign in (1, -1)
        ]
        difference = (ends[0] - ends[1]) / (2 * h)
        assert np.abs(exact[..., c]).max() > 0.01
        assert np.abs(difference - exact[..., c]).max() < 1e-4 * np.abs(exact[..., c]).max()


def test_times_of_each_run_and_faults(scene):
    velocity = np.repeat(np.array([[one.state.velocity for one in scene.balls]]), 2, axis=0)
    both = carom.sensitivities(scene, WRT[:1], velocity=velocity, times=[TIMES, TIMES / 2])
    once = carom.sensitivities(scene, WRT[:1], times=TIMES / 2)
    assert np.array_equal(both.states.position[1], once.states.position[0])
    for times, said in (
        ([2.0, 1.0], "increasing"),
        ([1.0, 9.0], "0 to 3 s"),
        ([[1.0]] * 5, r"\(1, T\)"),
        (["x"], "times in s"),
    ):
        with pytest.raises(carom.CaromError, match=said):
            carom.sensitivities(scene, WRT[:1], times=times)
