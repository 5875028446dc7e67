"""How far derivatives hold: margins and near misses against the first change of the sequence of events; one-sided derivatives."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest
from reference.sensitivity_differences import sequence

import carom
from carom.cli.trajectory_output import show_sensitivity
from carom.scene.toml import replaced
from carom.simulation.records import BALL, FLOOR, SETTLED, WALL
from carom.simulation.sensitivity.margins import _first_change

RADIUS = 0.1
PATH = "balls.0.velocity.x"


def table_shot(seed: int) -> carom.Scene:
    """Four balls on a table, one of which rolls."""
    rng = np.random.default_rng(seed)
    places: list[Any] = []
    while len(places) < 4:
        place = rng.uniform([-1.2, -0.6], [1.2, 0.6])
        if all(np.hypot(*(place - other)) > 0.1 for other in places):
            places.append(place)
    angle, speed = rng.uniform(0, 2 * np.pi), rng.uniform(0.8, 2.0)
    rolls = {"velocity": (speed * np.cos(angle), speed * np.sin(angle)), "rolling": True}
    balls = [
        carom.SceneBall(radius=0.03075, mass=0.21, position=tuple(place), **(rolls if k == 0 else {}))
        for k, place in enumerate(places)
    ]
    return carom.Scene(
        floor=carom.Floor(restitution=0.5, friction=0.2, rolling_resistance=0.01, spin_friction=0.0127),
        walls=[{"shape": "table", "preset": "carom" if seed % 2 else "pool-9ft"}],
        balls=balls,
        ball_contact=carom.BallContact(restitution=0.95, friction=0.06),
        run=carom.Run(duration=20),
    )


def of_each_ball(run: carom.Trajectory) -> list[list[tuple[int, ...]]]:
    """The events of each ball; those of two balls in no order. Low bounces on the floor are left out."""
    rows = [row for row in sequence(run, run.end) if row[0] not in (FLOOR, SETTLED)]
    return [[row for row in rows if row[1] == k] for k in range(len(run.scene.balls))]


def first_change(scene: carom.Scene) -> float:
    """The smallest change of a velocity that changes what happens, found by running."""
    x = scene.balls[0].state.velocity[0]
    expected, ends = of_each_ball(carom.simulate(scene)), []

    def same(by: float) -> bool:
        return of_each_ball(carom.simulate(replaced(scene, {PATH: float(x + by)}))) == expected

    for sign in (1, -1):
        low, high = 0.0, 1e-6
        while high < 0.1 and same(sign * high):
            low, high = high, 1.5 * high
        for _ in range(12):
            middle = (low + high) / 2
            low, high = (middle, high) if same(sign * middle) else (low, middle)
        ends.append(high)
    return min(ends)


@pytest.mark.parametrize(
    ("seed", "what"),
    [
        (0, "stick/slip"), (2, "table 0"), (4, "ball 3"), (5, "stick/slip"), (9, "table 0"), (13, "roll/slide"),
        (17, "stick/slip"), (18, "graze"), (19, "graze"),
    ],
)  # fmt: skip
def test_the_radius_is_where_the_sequence_of_events_changes_first(seed: int, what: str) -> None:
    scene = table_shot(seed)
    found = carom.simulate(scene).sensitivity(PATH)
    nearest = min(found.margin, key=lambda one: one.radius)
    miss = found.near_misses[0]
    assert (nearest.which if nearest.radius < miss.radius else miss.other) == what
    assert found.radius == min(nearest.radius, miss.radius)
    assert found.radius == pytest.approx(first_change(scene), rel=0.03)


def test_the_radius_of_a_pressed_ball_is_where_its_derivative_jumps() -> None:
    # (the log has the same regimes on both sides: what changes is how often the ball lands within the contact)
    scene = table_shot(1)
    found = carom.simulate(scene).sensitivity(PATH)
    x, radius = scene.balls[0].state.velocity[0], found.margin[0].radius

    def slope(share: float) -> Any:
        run = carom.simulate(replaced(scene, {PATH: float(x - share * radius)}))
        return run.sensitivity(PATH).events[0].velocity[0, 0]

    before, inside, outside, beyond = (slope(share) for share in (0.97, 0.985, 1.015, 1.03))
    assert found.radius == radius < 0.004
    assert abs(inside - outside) > 50 * max(abs(before - inside), abs(outside - beyond))


def pair(offset: float, v: float = 1.0) -> carom.Trajectory:
    """One ball that flies past another, whose centres come as near as 2 a (1 + offset)."""
    y = 2 * RADIUS * (1 + offset)
    balls = [
        carom.SceneBall(radius=RADIUS, mass=1.0, position=(-1, y, 0), velocity=(v, 0, 0)),
        carom.SceneBall(radius=RADIUS, mass=1.0, position=(0, 0, 0)),
    ]
    contact = carom.BallContact(restitution=1.0, friction=0.0)
    return carom.simulate(carom.Scene(gravity=0, balls=balls, ball_contact=contact, run=carom.Run(duration=2)))


def test_a_ball_that_flies_past_another() -> None:
    found = pair(0.01).sensitivity(["balls.0.position.y", "balls.0.velocity.x", "balls.1.radius"])
    (miss,) = found.near_misses
    assert (miss.ball, miss.other) == ("ball 0", "ball 1")
    assert miss.time == pytest.approx(1.0, abs=1e-7)
    assert miss.distance == pytest.approx(0.002, rel=1e-12)
    assert not miss.at_rest
    # d gap = dy - dr
    assert miss.radius == pytest.approx(0.002 / math.sqrt(2), rel=1e-9)
    assert found.margin == []


def test_a_ball_that_stops_before_a_wall(capsys: pytest.CaptureFixture[str]) -> None:
    v, c, g = 0.5, 0.02, 9.80665
    wall = carom.scene.Plane(point=(0, 0, 0), normal=(1, 0, 0), restitution=0.85, friction=0.2)
    way = v**2 / (2 * c * g)
    ball = carom.SceneBall(radius=0.03, mass=0.2, position=(0.031 + way, 0), velocity=(-v, 0), rolling=True)
    floor = carom.Floor(friction=0.2, rolling_resistance=c)
    scene = carom.Scene(gravity=g, floor=floor, walls=[wall], balls=[ball], run=carom.Run(duration=20))
    found = carom.simulate(scene).sensitivity("balls.0.velocity")
    (miss,) = found.near_misses
    show_sensitivity(found)  # (the command said that it "passes")
    said = f"Nearest miss: from {miss.time:.4g} s on ball 0 is at rest 1 mm from plane 0."
    assert said in " ".join(capsys.readouterr().out.split())
    assert miss.at_rest
    assert miss.other == "plane 0"
    assert miss.time == pytest.approx(v / (c * g), rel=1e-9)
    assert miss.distance == pytest.approx(0.001, rel=1e-9)
    assert miss.radius == pytest.approx(0.001 / (v / (c * g)), rel=1e-6)  # d way / d v = v / (c g)


def test_two_balls_hit_at_the_same_time_warn() -> None:
    d = 2 * RADIUS * math.cos(math.pi / 6)
    places = [(-1.0, 0.0), (d, RADIUS), (d, -RADIUS)]
    balls = [
        carom.SceneBall(radius=RADIUS, mass=1.0, position=(x, y, 0), velocity=(1.0 if k == 0 else 0.0, 0, 0))
        for k, (x, y) in enumerate(places)
    ]
    # (together, as contacts that take time, they depend on the place smoothly: tests/simulation/test_clusters.py)
    contact = carom.BallContact(restitution=1.0, friction=0.0, overlap=False)
    run = carom.simulate(carom.Scene(gravity=0, balls=balls, ball_contact=contact, run=carom.Run(duration=2)))
    with pytest.warns(UserWarning, match="at the same time as another impact of this ball"):
        found = run.sensitivity("balls.0.position.y")
    assert found.radius == 0


def test_a_wall_and_a_ball_of_the_same_number_at_once() -> None:
    balls = [
        carom.SceneBall(radius=0.1, mass=1, position=(0, 0, 1), velocity=(1, 1, 0)),
        carom.SceneBall(radius=0.1, mass=1, position=(0.5 + math.sqrt(0.03), 0.4, 1)),
    ]
    walls = [
        carom.scene.Plane(point=(0, y, 0), normal=(0, n, 0), restitution=1, friction=0) for y, n in ((-5, 1), (0.6, -1))
    ]
    scene = carom.Scene(
        gravity=0, balls=balls, walls=walls, ball_contact=carom.BallContact(overlap=False), run=carom.Run(duration=1)
    )  # (else the wall takes part in the contact of the balls)
    run = carom.simulate(scene)
    at_once = run.log[(run.log["ball"] == 0) & (np.abs(run.log["t"] - 0.5) < 1e-12)]
    assert {(row["kind"], row["other"]) for row in at_once} == {(WALL, 1), (BALL, 1)}
    with pytest.warns(UserWarning, match="at the same time as another impact of this ball"):
        found = run.sensitivity("balls.0.position.x")
    assert found.radius < 1e-12


def test_the_border_of_sticking_warns() -> None:
    # a ball that flies to a wall with a slip u sticks from mu = kappa u / ((1 + kappa) (1 + e) v_n) on
    e, kappa, v_n, u = 0.5, 0.4, 2.0, 1.0
    mu = kappa / (1 + kappa) * u / ((1 + e) * v_n)
    wall = carom.scene.Plane(point=(0, 0, 0), normal=(1, 0, 0), restitution=e, friction=mu)
    ball = carom.SceneBall(radius=RADIUS, mass=1.0, position=(1.1, 0, 0), velocity=(-v_n, u, 0))
    run = carom.simulate(carom.Scene(gravity=0, walls=[wall], balls=[ball], run=carom.Run(duration=1)))
    assert run.log["required"][1] == pytest.approx(mu, rel=1e-15)
    with pytest.warns(UserWarning, match="at the border of sticking and slipping"):
        found = run.sensitivity("walls.0.friction")
    # v_t' = v_t - mu (1 + e) v_n while it slides; once it sticks friction has no effect
    assert found.final.velocity[0, 1, 0] == pytest.approx(0.0, abs=1e-9)


@pytest.mark.parametrize("number", [9, 10, 13])
def test_the_first_change_along_any_number_of_an_impact(number: int) -> None:
    """Radius, inertia or surface alone may change: the step is bounded by the size of what changes."""
    now, slope = np.zeros(14), np.zeros(14)
    now[number], slope[number] = 0.9, 1.0
    assert _first_change(lambda x: x[number] > 1.0, now, slope) == pytest.approx(0.1, rel=1e-6)
    assert _first_change(lambda x: x[number] > 1.0, now, -slope) == math.inf
