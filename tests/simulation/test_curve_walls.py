"""Smooth curves and ellipses as walls of scenes: against circles, billiards, brute force; rooms, posts, open curves, every law."""

from __future__ import annotations

import math
import pickle
from typing import Any

import numpy as np
import pytest
from reference.curves import CURVES, depth

import carom
from carom import billiards
from carom.laws.registry import laws
from carom.scene.toml import replaced

MIRROR = {"restitution": 1.0, "friction": 0.0}
BALL = {"radius": 0.03, "mass": 0.2, "position": (0.1, 0.2), "velocity": (1.0, 0.6)}
FLOOR = {"friction": 0.2, "restitution": 0.5, "rolling_resistance": 0.01}


def run_in(*walls: Any, law: str = "mirror", events: int = 12, floor: Any = None, g: float = 0.0, **ball: Any) -> Any:
    limits = {"law": law, "max_events": events, "duration": 60}
    return carom.simulate(carom.Scene(gravity=g, floor=floor, walls=list(walls), balls=[BALL | ball], run=limits))


def contacts(run: Any) -> list[float]:
    return [one.t for one in run.events if one.kind == "wall"]


def test_a_circle_by_its_formula_is_a_circle() -> None:
    """On a floor too, where the ball slides, rolls and comes to rest; and a round post."""
    for law, floor, g in (("mirror", None, 0.0), ("no-slip", FLOOR, 9.8), ("two-step", FLOOR, 9.8)):
        wall = {"restitution": 0.9, "friction": 0.2, "center": (0.3, -0.1)}
        exact = run_in({"shape": "circle", "radius": 0.8, **wall}, law=law, floor=floor, g=g, events=30)
        found = run_in({"shape": "curve", "r": "0.8", "angle": 25.0, **wall}, law=law, floor=floor, g=g, events=30)
        assert [one.kind for one in found.events] == [one.kind for one in exact.events]
        assert np.array([one.t for one in found.events]) == pytest.approx([one.t for one in exact.events], rel=1e-9)
    post = {"shape": "curve", "r": "0.2", "inside": False, "center": (1.0, 0.8), **MIRROR}
    axis = {"point": (1.0, 0.8, 0.0), "axis": (0, 0, 1), "radius": 0.2}
    exact = run_in({"shape": "cylinder", **axis, **MIRROR}, {"shape": "circle", "radius": 2.0, **MIRROR})
    found = run_in(post, {"shape": "curve", "r": "2", **MIRROR})
    assert [one.name[:5] for one in found.events] == [
        {"cylin": "curve"}.get(one.name[:5], one.name[:5]).replace("circl", "curve") for one in exact.events
    ]
    assert contacts(found) == pytest.approx(contacts(exact), rel=1e-11)


@pytest.mark.parametrize(
    "text", ["ellipse:half_axes=1,0.6", "flower:leaves=3,eps=0.1,radius=1", "curve:r=1 + 0.3*cos(theta)"]
)
def test_a_room_is_the_billiard(text: str) -> None:
    figure = billiards.table(text, bounds="surface")
    from carom.scene import figure as made

    sizes = {name: value for name, value in made(text) if value is not None}
    run = run_in({**sizes, **MIRROR}, events=9)
    orbit = carom.orbit(figure, 8, law="mirror", position=(0.1, 0.2), velocity=(1.0, 0.6), ball_radius=0.03)
    assert contacts(run)[:8] == pytest.approx(orbit.t.tolist()[-8:], rel=1e-10)


def test_a_ball_larger_than_the_ends_of_an_ellipse_stays_inside() -> None:
    """It touches both sides near an end, and its centre is never nearer to the wall than its radius."""
    run = run_in({"shape": "ellipse", "half_axes": (1.0, 0.4), **MIRROR}, events=60, radius=0.25, position=(0.1, 0.02))
    t = np.linspace(0, run.end, 4000)
    far = depth(CURVES["swallowtail"][0], run.at(t).position[:, 0, :2])
    assert far.min() == pytest.approx(0.25, abs=1e-9)
    assert len(contacts(run)) == 60


def test_an_open_curve_has_two_sides_and_two_ends() -> None:
    """A quarter of a circle through points: hit from inside, from outside, and at its ends."""
    turn = np.linspace(0, math.pi / 2, 60)
    jaw = {"shape": "curve", "points": np.c_[np.cos(turn), np.sin(turn)].tolist(), "closed": False, **MIRROR}
    c = math.sqrt(0.5)
    inside = run_in(jaw, events=1, position=(0.0, 0.0), velocity=(c, c))
    outside = run_in(jaw, events=1, position=(2 * c, 2 * c), velocity=(-c, -c))
    end = run_in(jaw, events=1, position=(1.0, -1.0), velocity=(0.0, 1.0))
    assert [contacts(one) for one in (inside, outside, end)] == [[pytest.approx(0.97, abs=1e-8)]] * 3
    past = run_in(jaw, events=1, position=(-1.0, -1.0), velocity=(0.0, 1.0))
    assert contacts(past) == []
    assert "curve" in str(inside.scene.walls[0].describe())


def test_a_straight_arc_ends_where_it_ends() -> None:
    """Its tangents are one line, on which a ball beyond an end touches nothing, at rest and on a parabola."""
    straight = {"shape": "curve", "points": [(0, 0), (0.3, 0), (0.6, 0), (1, 0)], "closed": False, **MIRROR}
    for x, met in ((-0.5, 0), (0.5, 1), (1.5, 0)):
        run = run_in(straight, g=(0.02, -1.0, 0.0), position=(x, 0.5), velocity=(0.0, 0.0), events=1)
        assert len(contacts(run)) == met
        if not met:
            run_in(straight, position=(x, 0.0), events=1)
    # 0.27 m from a post with flat sides, on the line of one of them
    post = {
        "shape": "superellipse",
        "half_axes": (0.49603796510439463, 1.5767749600539827),
        "power": 5,
        "inside": False,
    }
    run_in(post | MIRROR, position=(-0.89045667, 2.00572573), radius=0.455, velocity=(-1.0, 0.0), events=1)


@pytest.mark.parametrize("law", [law.name for law in laws().values() if law.kernel is not None])
def test_every_law_has_the_normal_of_the_ellipse(law: str) -> None:
    """The first contact is one with the plane that touches the ellipse there."""
    floor = FLOOR if law not in ("mirror", "contact") else None
    surface = {"restitution": 1.0 if law == "conventional" else 0.9, "friction": 0.2}
    numbers = {"law": law, "floor": floor, "g": 9.8 if floor else 0.0, "events": 8}
    run = run_in({"shape": "ellipse", "half_axes": (1.0, 0.6), **surface}, **numbers)
    hit = next(one for one in run.events if one.kind == "wall")
    at = np.asarray(hit.before.position)
    # (the foot of the normal through the centre)
    u = math.atan2(at[1] / 0.6, at[0])
    for _ in range(40):
        p, d = np.array([math.cos(u), 0.6 * math.sin(u)]), np.array([-math.sin(u), 0.6 * math.cos(u)])
        u -= float(((p - at[:2]) @ d) / (d @ d + (p - at[:2]) @ -p))
    out = np.array([0.6 * math.cos(u), math.sin(u)]) / math.hypot(0.6 * math.cos(u), math.sin(u))
    plane = {"shape": "plane", "point": (*p.tolist(), 0.0), "normal": (*(-out).tolist(), 0.0), **surface}
    flat = run_in(plane, **numbers)
    other = next(one for one in flat.events if one.kind == "wall")
    assert other.t == pytest.approx(hit.t, rel=1e-12)
    assert np.asarray(other.after.velocity) == pytest.approx(np.asarray(hit.after.velocity), abs=1e-9)


def test_refusals_in_one_line() -> None:
    for wall, said in (
        ({"shape": "curve", "r": "1 + 0.3*coz(theta)"}, "coz"),
        ({"shape": "curve", "x": "cos(s/2)", "y": "sin(s)"}, "closed = false"),
        ({"shape": "curve", "points": [(0, 0), (1, 1), (1, 0), (0, 1)]}, "does not meet itself"),
        ({"shape": "ellipse", "half_axes": (0.02, 0.5)}, "where the ball touches nothing"),
        ({"shape": "ellipse", "half_axes": (0.5, 0.5), "center": (3.0, 0.0)}, "where no ball can be"),
    ):
        with pytest.raises(carom.CaromError) as error:
            run_in({**wall, **MIRROR}, position=(0.0, 0.0))
        assert said in str(error.value)
        assert "\n" not in str(error.value)


def test_it_is_drawn_kept_and_told() -> None:
    wall = {"shape": "ellipse", "half_axes": (1.0, 0.6), **MIRROR}
    run = run_in(wall)
    assert "ellipse 0" in " ".join(run.describe())
    (outline,) = run.scene.walls[0].outline()
    assert np.abs((outline / [1.0, 0.6]) ** 2 @ [1, 1] - 1).max() < 1e-12
    again = pickle.loads(pickle.dumps(run.scene))
    assert contacts(carom.simulate(again)) == contacts(run)


def test_derivatives_are_differences() -> None:
    """By starts, friction, the place and the angle of the curve; sizes of the curve are refused."""
    wall = {"shape": "flower", "leaves": 3, "eps": 0.1, "radius": 1.0, "restitution": 0.9, "friction": 0.2}
    scene = carom.Scene(gravity=9.8, floor=FLOOR, walls=[wall], balls=[BALL], run={"law": "two-step", "duration": 2.2})
    run = carom.simulate(scene)
    found = run.sensitivity(["balls.0.velocity", "walls.0.center", "walls.0.angle", "walls.0.restitution"])
    steps = {
        "balls.0.velocity.x": ("balls.0.velocity", lambda h: (1.0 + h, 0.6)),
        "walls.0.center.y": ("walls.0.center", lambda h: (0.0, h)),
        "walls.0.angle": ("walls.0.angle", lambda h: h), "walls.0.restitution": ("walls.0.restitution", lambda h: 0.9 + h),
    }  # fmt: skip
    for name, (path, value) in steps.items():
        ends = [carom.simulate(replaced(scene, {path: value(h)})).final.position[0] for h in (1e-5, -1e-5)]
        expected = (np.asarray(ends[0]) - np.asarray(ends[1])) / 2e-5
        assert found.final.position[0, :, found.columns.index(name)] == pytest.approx(expected, rel=1e-5, abs=1e-7)
    with pytest.raises(carom.CaromError, match="leaves the curve of a wall as it is"):
        run.sensitivity(["walls.0.eps"])
