"""Walls in contacts that overlap in time, against an integration of its own (tests/reference/hertz_contacts.py)."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest
from reference.hertz_contacts import MASS, RADIUS, Case, Wall, integrate, known, known_case
from simulation.test_clusters import energy, scene_of

import carom
from carom.core.jit.kernel import as_objects
from carom.simulation.loop import ALL, run
from carom.simulation.records import BALL, IN_CLUSTER, LOG, WALL, WALL_IN_CLUSTER, event_numbers, set_up
from carom.simulation.trajectory import budget

CASES = known()["walls"]
JAWS = CASES["between jaws of half angle 60 deg"]
Array = Any


def with_walls(one: dict[str, Any], duration: float = 1e-6, law: str = "contact", **contact: Any) -> carom.Scene:
    walls = [{"shape": "plane", **wall} for wall in one["walls"]]
    scene = scene_of(known_case(one), duration, **contact)
    return scene.model_copy(update={"walls": carom.Scene(balls=scene.balls, walls=walls, gravity=0).walls, "run": carom.Run(
        law=law, duration=duration
    )})  # fmt: skip


def by_python(scene: carom.Scene, duration: float = 1e-6) -> tuple[Any, Any]:
    """Rows of the log, and the balls, of a run in Python."""
    setup = set_up(scene, compiled=False)
    rows, balls = as_objects(np.zeros(60, LOG)), as_objects(setup.balls)
    answer = run(as_objects(setup.world)[0], as_objects(setup.features), balls, rows, -1.0, duration, 99, [], ALL)
    return rows[: answer[2]], balls


@pytest.mark.parametrize("name", CASES)
def test_walls_in_a_cluster_have_the_velocities_of_the_reference(name: str) -> None:
    one = CASES[name]
    case, size = known_case(one), np.abs(one["velocity"]).max()
    rows, balls = by_python(with_walls(one))
    v, w = (np.array([getattr(ball, field) for ball in balls]) for field in "vw")
    smooth = one["friction"] == 0
    assert np.abs(v - one["out_velocity"]).max() < (4e-4 if smooth else 3e-3) * size
    assert RADIUS * np.abs(w - np.array(one["out_spin"])).max() < (1e-12 if smooth else 1e-2) * size
    # what the balls have gained is what the walls gave; balls give each other nothing in sum
    own = [row.impulse for row in rows if row.kind in (WALL, WALL_IN_CLUSTER)]
    assert np.sum(own, axis=0) == pytest.approx(MASS * (v - case.velocity).sum(axis=0), abs=1e-15)
    pairs = [row.impulse for row in rows if row.kind in (BALL, IN_CLUSTER)]
    assert np.sum(pairs, axis=0) == pytest.approx(np.zeros(3) if pairs else 0.0, abs=1e-15)
    before, after = energy(case, np.array(case.velocity), np.array(case.spin)), energy(case, v, w)
    if case.restitution == 1 and all(wall["restitution"] == 1 for wall in one["walls"]):
        assert after == pytest.approx(before, rel=1e-12)
    assert after <= before * (1 + 1e-12)
    # one contact at a time, as on demand, is far from it
    _rows, others = by_python(with_walls(one, overlap=False))
    assert np.abs(np.array([ball.v for ball in others]) - one["out_velocity"]).max() > 0.06 * size


@pytest.mark.parametrize(("masses", "time", "right"), [
    ((2, 1, 2), 3e-4, (-0.9151, -0.5011, -0.1924)), ((2, 2, 1), 1e-3, (-0.8367, -0.5241, -0.2248)),
])  # fmt: skip
@pytest.mark.parametrize("gap", [0.0, 5e-9])
def test_a_ball_that_is_sent_back_to_a_wall_leaves_it(masses: Any, time: float, right: Any, gap: float) -> None:
    # a row on an elastic wall (right: SciPy's DOP853)
    pitch = 2 * RADIUS + gap
    balls = [
        {"radius": RADIUS, "mass": MASS * m, "position": (pitch * k, 0, 0), "velocity": (float(k == 0), 0, 0)}
        for k, m in enumerate(masses)
    ]
    wall = {
        "shape": "plane",
        "point": (2 * pitch + RADIUS + gap, 0, 0),
        "normal": (-1, 0, 0),
        "restitution": 1,
        "friction": 0,
    }
    scene = carom.Scene(
        gravity=0, walls=[{**wall, "contact_time": time}], balls=balls, ball_contact={"restitution": 1, "friction": 0},
        run={"duration": 0.05, "law": "contact"},
    )  # fmt: skip
    _rows, found = by_python(scene, 0.05)
    assert [ball.v[0] for ball in found] == pytest.approx(right, abs=2e-4)


@pytest.mark.parametrize(("angles", "spin", "e", "mu", "right"), [
    ((60, -10), 0, 0.95, (0, 0), [(0.0259, 0.0452), (0.1092, -0.8366), (0.4395, -0.0745)]),
    ((30,), 1, 0.95, (0.2, 0.3), [(0.1626, 0.5813), (0.3779, -0.3663)]),
])  # fmt: skip
def test_a_ball_frozen_to_a_hard_wall(angles: Any, spin: float, e: float, mu: Any, right: Any) -> None:
    # the first comes at an angle; it is the ball at the wall that the second number is of (right: SciPy's DOP853)
    ways = [(2 * RADIUS * math.cos(math.radians(a)), 2 * RADIUS * math.sin(math.radians(a))) for a in angles]
    ball, (x, y) = {"radius": RADIUS, "mass": MASS}, ways[0]
    v = (-1.0, 0.0, 0.0) if spin else (-x / (2 * RADIUS), -y / (2 * RADIUS), 0.0)
    balls = [
        {**ball, "position": (RADIUS + x, y, 0), "velocity": v, "spin": (0, 0, spin / RADIUS)},
        {**ball, "position": (RADIUS, 0, 0)},
        *({**ball, "position": (RADIUS + x, y, 0)} for x, y in ways[1:]),
    ]
    wall = {"shape": "plane", "point": (0, 0, 0), "normal": (1, 0, 0), "restitution": 0.85, "friction": mu[1]}
    scene = carom.Scene(
        gravity=0, walls=[wall], balls=balls, ball_contact={"restitution": e, "friction": mu[0]},
        run={"duration": 0.02, "law": "contact"},
    )  # fmt: skip
    _rows, found = by_python(scene, 0.02)
    assert np.array([ball.v[:2] for ball in found]) == pytest.approx(np.array(right), abs=5e-4)
    if spin:
        assert [RADIUS * ball.w[2] for ball in found] == pytest.approx([1.2040, -0.3333], abs=5e-4)


def test_a_ball_that_a_cushion_sends_back_meets_one_that_has_moved_on() -> None:
    # it leaves the cushion 3 ms later, and meets the other one once more (right: tests/reference/contacts_followed.py)
    x, y = 2 * RADIUS * math.cos(math.radians(-10)), 2 * RADIUS * math.sin(math.radians(-10))
    ball = {"radius": RADIUS, "mass": MASS}
    balls = [
        {**ball, "position": (0, 0, 0)},
        {**ball, "position": (x, y, 0)},
        {**ball, "position": (x, y - 2 * RADIUS, 0), "velocity": (0.4, 0.9, 0)},
    ]
    wall = {"shape": "plane", "normal": (1, 0, 0), "restitution": 1, "friction": 0, "contact_time": 3e-3}
    scene = carom.Scene(
        gravity=0, walls=[{**wall, "point": (-RADIUS - 9e-5, 0, 0)}], balls=balls,
        ball_contact={"restitution": 1, "friction": 0}, run={"duration": 0.02, "law": "contact"},
    )  # fmt: skip
    done = carom.simulate(scene)
    right = np.array([(0.0710, 0.0322), (0.2230, 0.8679), (0.4013, -0.0001)])
    assert done.final.velocity[:, :2] == pytest.approx(right, abs=3e-4)
    # (one event after the other is 0.05 off)
    alone = carom.simulate(carom.replaced(scene, {"walls.0.contact_time": 0.0})).final.velocity[:, :2]
    assert np.abs(alone - right).max() > 0.05


def test_a_ball_between_jaws_goes_straight_whatever_the_numbers() -> None:
    for walls in (JAWS["walls"], JAWS["walls"][::-1]):
        _rows, balls = by_python(with_walls({**JAWS, "walls": walls}))
        assert [ball.v[1] for ball in balls] == pytest.approx([0.0, 0.0], abs=1e-9)
    side = CASES["between hard jaws of half angle 60 deg, from the side"]
    mirror = np.array([1.0, -1.0, 1.0])
    turned = {**side, **{name: (np.array(side[name]) * mirror).tolist() for name in ("position", "velocity")}}
    (_, one), (_, two) = by_python(with_walls(side)), by_python(with_walls(turned))
    for ball, image in zip(one, two, strict=True):
        assert image.v == pytest.approx((np.array(ball.v) * mirror).tolist(), abs=1e-9)


def test_the_log_has_a_row_for_each_wall_that_a_ball_touches() -> None:
    done = carom.simulate(with_walls(JAWS))
    log = done.log[2:]
    assert log["kind"].tolist() == [BALL, BALL, WALL_IN_CLUSTER, WALL_IN_CLUSTER]
    assert log["ball"].tolist() == [0, 1, 1, 1]
    assert log["other"].tolist() == [1, 0, 0, 1]
    assert done.events.kinds == ["ball", "ball", "wall", "wall"]
    assert len(done.events.of("wall", ball=1)) == 2
    assert event_numbers(done.log).tolist() == [0, 1, 2, 2, 2, 2]
    assert (log["v_before"][2:] == log["v"][2:]).all()
    text = " ".join(done.describe())
    assert ", touching plane 0 and plane 1 meanwhile" in text
    lost = budget(done)
    assert lost.walls == 0
    assert lost.balls == pytest.approx(lost.start - lost.end, rel=1e-12)


def test_two_balls_that_come_to_a_wall_together_are_an_event_of_the_wall() -> None:
    done = carom.simulate(with_walls(CASES["two that touch, together to a hard wall, e 1"]))
    log = done.log[2:]
    assert log["kind"].tolist() == [WALL, IN_CLUSTER, IN_CLUSTER]
    assert log["ball"].tolist() == [1, 1, 0]
    assert log["v_before"][:, 0] == pytest.approx([1.0, log["v"][0, 0], 1.0])
    assert log["impulse"][1] == pytest.approx(-log["impulse"][2], abs=1e-15)
    assert ", touching ball 0 meanwhile" in " ".join(done.describe())


def test_python_and_compiled_code_have_the_same_bits() -> None:
    one = CASES["frozen to a rough hard wall, 30 deg, with spin"]
    scene = with_walls(one)
    rows, _balls = by_python(scene)
    carom.simulate_many(scene, velocity=[one["velocity"]])  # (the compiled loop is loaded from here on)
    compiled = carom.simulate(scene).log
    assert [row.v for row in rows] == compiled["v"].tolist()
    assert [row.impulse for row in rows] == compiled["impulse"].tolist()


def near_a_wall(gap: float, **wall: Any) -> carom.Scene:
    """A ball at rest, a gap from a wall, and another one that comes to it."""
    ball = {"radius": RADIUS, "mass": MASS}
    return carom.Scene(
        gravity=0,
        walls=[{"shape": "plane", "point": (0, 0, 0), "normal": (-1, 0, 0), "restitution": 0.85, "friction": 0.1} | wall],
        balls=[
            {**ball, "position": (-0.4, 0.002, 0), "velocity": (1, 0, 0)},
            {**ball, "position": (-RADIUS - gap, 0, 0)},
        ],
        ball_contact={"restitution": 0.95, "friction": 0.05},
        run={"duration": 0.4, "law": "contact"},
    )  # fmt: skip


def test_in_the_open_nothing_changes() -> None:
    # the wall is touched after the balls have parted: the law of the wall, with the same bits as one after the other; so do walls
    # whose contacts take no time, and walls of laws without one
    walls: list[tuple[float, dict[str, Any]]] = [
        (5e-3, {}), (5e-4, {"law": "two-step"}), (0.0, {"contact_time": 0.0}), (0.0, {"law": "no-slip"})
    ]  # fmt: skip
    for gap, wall in walls:
        scene = near_a_wall(gap, **wall)
        alone = carom.simulate(carom.replaced(scene, {"ball_contact.overlap": False})).log
        assert carom.simulate(scene).log.tobytes() == alone.tobytes()
    assert (carom.simulate(near_a_wall(0.0)).log["kind"] == WALL_IN_CLUSTER).any()


def test_a_smooth_right_angled_corner_keeps_the_law_of_the_walls() -> None:
    # two smooth walls at right angles do not act on each other: one after the other
    walls = [
        {"shape": "plane", "point": (0, 0, 0), "normal": n, "restitution": 0.8, "friction": 0.0}
        for n in ((1, 0, 0), (0, 1, 0))
    ]
    balls = [{"radius": 0.03, "mass": 0.2, "position": (0.5, 0.50001, 0), "velocity": (-1, -1, 0)}]
    scene = carom.Scene(gravity=0, walls=walls, balls=balls, run={"duration": 1.0, "law": "contact"})
    log = carom.simulate(scene).log
    assert log["kind"].tolist()[1:3] == [WALL, WALL]
    assert log.tobytes() == carom.simulate(carom.replaced(scene, {"ball_contact.overlap": False})).log.tobytes()


@pytest.mark.parametrize("spin", [(0.0, 0.0, 0.0), (20.0, -10.0, 50.0)])
def test_walls_of_a_rough_right_angled_corner_act_at_once(spin: tuple[float, float, float]) -> None:
    # each rubs along the normal of the other: the order of the walls does not matter, and the integration has the same answer
    normals = np.eye(3)[:2]
    place, velocity = np.full(3, RADIUS + 1e-9), np.array([-1.0, -1.0, 0.0])
    walls = [Wall(np.zeros(3).tolist(), n.tolist(), 3e-4, 0.8, 0.25) for n in normals]
    case = Case([place], [velocity], [spin], walls=tuple(walls))
    _x, v, w = integrate(case, 4e-4, 5e-7)
    for some in (walls, walls[::-1]):
        rows, balls = by_python(with_walls(case._asdict() | {"walls": [wall._asdict() for wall in some]}))
        assert WALL_IN_CLUSTER in [row.kind for row in rows]
        assert balls[0].v == pytest.approx(v[0], abs=0.02)
        assert RADIUS * np.array(balls[0].w) == pytest.approx(RADIUS * w[0], abs=0.03)
        if not any(spin):
            assert balls[0].v[0] == pytest.approx(balls[0].v[1], abs=1e-12)


def test_a_ball_that_lies_in_a_groove_comes_to_rest_there() -> None:
    # low bounces to and fro, that its weight drives, are never resolved together, however long the walls' contacts last
    half = math.radians(35)
    walls = [
        {
            "shape": "plane",
            "point": (0, 0, 0),
            "normal": (s * math.cos(half), 0, math.sin(half)),
            "restitution": 0.5,
            "friction": 0.0,
        }
        for s in (1, -1)
    ]
    balls = [{"radius": 0.03, "mass": 0.2, "position": (1e-5, 0, 0.06)}]
    done = carom.simulate(
        carom.Scene(walls=walls, balls=balls, run={"duration": 5.0, "max_events": 20_000, "law": "contact"})
    )
    assert done.final_phase[0] == "held"
    assert done.final.position[0, 2] == pytest.approx(0.03 / math.sin(half), rel=1e-2)
    assert (done.log["kind"] == WALL_IN_CLUSTER).any()  # (at first it falls on both)
    assert len(done.log) < 200


def test_on_a_table_the_floor_bears_what_a_cushion_pushes_down() -> None:
    # frozen to a cushion whose nose is above its centre: it stays on the floor, and is as fast as at an upright wall of rubber
    table = {"shape": "table", "length": 2.0, "width": 1.0, "restitution": 0.85, "friction": 0.0}
    balls = [
        {"radius": RADIUS, "mass": MASS, "position": (0.8, 0.0), "velocity": (1.0, 0.0)},
        {"radius": RADIUS, "mass": MASS, "position": (1.0 - RADIUS, 0.0)},
    ]
    for nose in (None, 0.0363):
        high = 0.0 if nose is None else RADIUS - math.sqrt(RADIUS**2 - (nose - RADIUS) ** 2)
        placed = [balls[0], {**balls[1], "position": (1.0 - RADIUS + high, 0.0)}]
        scene = carom.Scene(
            floor={"friction": 0.0}, walls=[{**table, "nose_height": nose}], balls=placed,
            ball_contact={"restitution": 0.95}, run={"duration": 0.5, "law": "contact"},
        )  # fmt: skip
        found = carom.simulate(scene)
        log = found.log[(found.log["kind"] == BALL) & (found.log["ball"] == 1)]
        assert log["v"][0, 0] == pytest.approx(-0.07, abs=1e-3)
        assert abs(log["v"][0, 2]) < 1e-12


def test_cushions_are_soft_and_other_walls_hard() -> None:
    assert carom.scene.Table(preset="pool-9ft").contact_time == 3e-3
    assert carom.scene.Plane(point=(0, 0, 0), normal=(1, 0, 0)).contact_time == 3e-4


def test_derivatives_are_those_of_differences() -> None:
    scene = near_a_wall(2e-5)
    values = {
        "balls.0.velocity.y": 0.0,
        "walls.0.contact_time": 3e-4,
        "walls.0.restitution": 0.85,
        "balls.1.mass": MASS,
    }
    found = carom.simulate(scene).sensitivity(list(values)).final.velocity
    for k, (name, value) in enumerate(values.items()):
        h = 1e-6 * max(abs(value), 1e-3)
        ends = [carom.simulate(carom.replaced(scene, {name: value + s * h})).final.velocity for s in (1, -1)]
        differences = (ends[0] - ends[1]) / (2 * h)
        assert found[..., k] == pytest.approx(differences, abs=1e-3 * np.abs(differences).max())


def test_a_contact_time_is_a_time() -> None:
    with pytest.raises(carom.CaromError, match="contact_time: expected a time in s, from 0 to 1, got -1"):
        carom.scene.Plane(point=(0, 0, 0), normal=(1, 0, 0), contact_time=-1)
    assert carom.scene.Plane(point=(0, 0, 0), normal=(1, 0, 0), contact_time="3 ms").contact_time == 3e-3


@pytest.mark.parametrize("degrees", [2, 4, 7])
def test_a_ball_in_a_flat_corner_meets_both_faces(degrees: float) -> None:
    half = math.radians(degrees) / 2
    normals = [np.array([math.cos(half), side * math.sin(half), 0.0]) for side in (1, -1)]
    walls = [Wall(-RADIUS * n, n, 3e-4) for n in normals]
    case = Case(np.array([[0.0, 0.0, RADIUS]]), np.array([[-0.95, 0.3, 0.0]]), np.zeros((1, 3)), walls=tuple(walls))
    _x, v, _w = integrate(case, 1e-3, 1e-6)
    planes = [{"shape": "plane", "point": wall.point.tolist(), "normal": wall.normal.tolist(), "contact_time": 3e-4,
               "restitution": 0.85, "friction": 0.0} for wall in walls]  # fmt: skip
    ball = {"radius": RADIUS, "mass": MASS, "position": (0.0, 0.0, RADIUS), "velocity": (-0.95, 0.3, 0.0)}
    scene = carom.Scene(balls=[ball], walls=planes, gravity=0, run={"law": "contact", "duration": 1e-6})
    _rows, balls = by_python(scene)
    # (one wall after the other, or the nearer one alone, is 0.05 to 0.12 off)
    assert np.abs(np.array(balls[0].v) - v[0]).max() < 1e-3
