"""Paths into scenes: what they find, what they replace, and what they say of a name that is not there."""

from __future__ import annotations

import math

import pytest

import carom
from carom.errors import CaromError
from carom.scene.toml import overlapping_paths, path_match, replaced


def scene() -> carom.Scene:
    walls = [
        carom.scene.Plane(point=(0, 0, 0), normal=(1, 0, 0), restitution=0.85, friction=0.2, name="left"),
        carom.scene.Plane(point=(9, 0, 0), normal=(-1, 0, 0), restitution=0.9, friction=0.3),
    ]
    balls = [
        carom.SceneBall(radius=0.03, mass=0.2, position=(1, 0), velocity=(-2, 1), rolling=True, name="white"),
        carom.SceneBall(radius=0.03, mass=0.2, position=(2, 0), name="red"),
    ]
    return carom.Scene(floor=carom.Floor(friction=0.2), walls=walls, balls=balls)


def test_what_a_path_finds() -> None:
    assert path_match(scene(), "walls.*.friction").values == (0.2, 0.3)
    assert path_match(scene(), "walls.left.friction") == path_match(scene(), "walls.0.friction")._replace(
        path="walls.left.friction"
    )
    assert path_match(scene(), "balls.white.velocity.y").values == (1.0,)
    assert path_match(scene(), "gravity.z").places == (("gravity", 2),)
    assert path_match(scene(), "run.law").values == ("two-step",)


def test_a_replaced_scene_is_the_scene_made_anew() -> None:
    changes = {
        "walls.*.friction": 0.25,
        "balls.0.velocity": (-1, 0.5),
        "floor.restitution": 0.4,
        "run.law": "mirror",
        "balls.red.position.x": "2.5 m",
    }
    found = replaced(scene(), changes)
    assert [wall.friction for wall in found.walls] == [0.25, 0.25]
    assert found.balls[0].velocity == (-1.0, 0.5, 0.0)
    assert found.balls[1].position == (2.5, 0.0, 0.03)
    assert found.floor is not None
    assert found.floor.contact.p[0] == 0.4
    assert found.run.law == "mirror"
    assert replaced(found, {"run.law": "two-step"}).walls == found.walls
    assert replaced(scene(), {}) == scene()


def test_a_strike_replaces_a_motion_and_a_motion_a_strike() -> None:
    rolling = replaced(scene(), {"balls.white.rolling": True, "balls.white.spin_z": 3.0})
    struck = replaced(rolling, {"balls.white.strike": {"speed": 2.0}})
    ball = struck.balls[0]
    assert (ball.velocity, ball.rolling, ball.spin, ball.spin_z) == ((0.0, 0.0, 0.0), False, None, None)
    assert (
        replaced(struck, {"balls.white.strike.speed": 3.0}).balls[0].strike
        == replaced(ball, {"strike.speed": 3.0}).strike
    )
    assert replaced(struck, {"balls.white.velocity": (1, 0)}).balls[0].strike is None
    with pytest.raises(CaromError, match="no velocity and no spin with strike"):
        replaced(scene(), {"balls.white.strike": {"speed": 2.0}, "balls.white.velocity": (1, 0)})
    with pytest.raises(CaromError, match=r"give it whole: balls\.white\.strike"):
        replaced(scene(), {"balls.white.strike.speed": 2.0})


def test_presets_and_forms_survive() -> None:
    table = carom.Scene(
        floor=carom.Floor(friction=0.2),
        walls=[{"shape": "table", "preset": "snooker"}],
        balls=[{"radius": 0.02625, "mass": 0.1406, "position": (0, 0)}],
    )
    assert replaced(table, {"walls.0.friction": table.walls[0].friction}) == table
    assert replaced(table, {"walls.0.friction": math.inf}).walls[0].restitution == table.walls[0].restitution


@pytest.mark.parametrize(
    ("path", "said"),
    [
        ("walls.0.frction", "did you mean 'walls.0.friction'?"),
        ("balls.whte.velocity", "did you mean 'balls.white'?"),
        ("balls.7.mass", "expected *, white, red in balls, got '7'"),
        ("balls.0.velocity.q", "expected x, y, z in balls.0.velocity"),
        ("run.law.x", "run.law, which has no fields here"),
        ("balls.0.strike.speed", "balls.0.strike, which has no fields here"),
        ("flor.friction", "did you mean 'floor'?"),
        ("", "expected a path such as"),
        ("balls..mass", "expected a path such as"),
    ],
)
def test_a_path_that_leads_nowhere(path: str, said: str) -> None:
    with pytest.raises(carom.CaromError) as caught:
        path_match(scene(), path)
    assert said in str(caught.value)
    assert len(caught.value.faults) == 1


def test_what_the_scene_refuses_is_said_with_its_place() -> None:
    with pytest.raises(carom.CaromError) as caught:
        replaced(scene(), {"walls.1.friction": -1, "balls.0.mass": 0})
    assert [fault.split(": expected")[0] for fault in caught.value.faults] == [
        "Scene: walls[1].friction",
        "Scene: balls[0].mass",
    ]


def test_overlapping_paths() -> None:
    paths = ["walls.*.friction", "walls.1.friction", "balls.0.velocity", "balls.0.velocity.x", "balls.1.velocity.x"]
    found = overlapping_paths([path_match(scene(), path) for path in paths])
    assert found == [("walls.*.friction", "walls.1.friction"), ("balls.0.velocity", "balls.0.velocity.x")]


def test_a_scene_is_not_changed_but_replaced() -> None:
    """Assignments gave pydantic's text of three lines."""
    ours = scene()
    assert carom.replaced(ours, {"run.max_events": 5}) == replaced(ours, {"run.max_events": 5})
    with pytest.raises(carom.CaromError, match=r"^Run: .*, got max_events = 5; carom\.replaced\(") as caught:
        ours.run.max_events = 5  # type: ignore[misc]
    assert "\n" not in str(caught.value)
    assert ours.run.max_events is None


def test_a_table_does_not_become_another_by_its_preset() -> None:
    """The name was replaced, and nothing that it stands for: a saved scene was another table."""
    table = carom.load_scene("pool-9ft")
    with pytest.raises(carom.CaromError, match=r"^path: walls\.0\.preset: expected .* make another scene$"):
        carom.replaced(table, {"walls.0.preset": "snooker"})
