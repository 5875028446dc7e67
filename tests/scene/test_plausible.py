"""Sizes, masses and speeds that are hardly in SI units are said; those of balls that exist are not."""

from __future__ import annotations

from pathlib import Path

import pytest
from typer.testing import CliRunner

import carom
from carom.cli import app
from carom.scene.openings import scene_notes

ROOT = Path(__file__).parents[2]


def notes(radius: float, mass: float, speed: float = 1.0, **fields: float) -> list[str]:
    ball = carom.SceneBall(name="white", radius=radius, mass=mass, position=(0, 0, 99), velocity=(speed, 0, 0))
    return scene_notes(carom.Scene(balls=[ball], **fields))


@pytest.mark.parametrize(
    ("radius", "mass", "speed", "said"),
    [
        (28.6, 0.17, 1.0, "lighter than air; is the radius in mm"),
        (0.0286, 170.0, 1.0, "denser than any metal; is the mass in g"),
        (0.0286, 0.17, 2000.0, "a speed of 2000 m/s"),
    ],
)
def test_what_is_hardly_in_si_units_is_said(radius: float, mass: float, speed: float, said: str) -> None:
    (line,) = notes(radius, mass, speed)
    assert line.startswith("balls.white: ")
    assert said in line
    assert not notes(radius, mass, speed, gravity=0.0)  # (other units are likely there)


@pytest.mark.parametrize(
    ("radius", "mass", "speed"), [(0.0286, 0.17, 12.0), (0.02, 0.0027, 30.0), (0.11, 7.26, 14.0), (0.12, 0.62, 9.0)]
)
def test_balls_that_exist_are_not(radius: float, mass: float, speed: float) -> None:
    assert notes(radius, mass, speed) == []


@pytest.mark.parametrize("name", ["carom_table", "three_balls"])
def test_no_scene_of_the_docs_has_a_note(name: str) -> None:
    assert scene_notes(carom.load_scene(ROOT / "docs" / "scenes" / f"{name}.toml")) == []


def test_a_ball_that_would_bounce_unseen_for_ever_is_said() -> None:
    ball = {"radius": 0.03, "mass": 0.2}

    def said(z: float, restitution: float, **fields: float) -> list[str]:
        balls = [{**ball, "position": (0, 0, z)}]
        return scene_notes(carom.Scene(floor={"restitution": restitution, "friction": 0.2}, balls=balls, **fields))

    (line,) = said(0.03 + 1.2e-8, 1.0)
    assert line.startswith("balls.0: ")
    assert "every 0.0989 ms" in line  # 2 (2 h/g)^(1/2)
    assert not said(0.03, 1.0) + said(0.03 + 1.2e-8, 0.9) + said(0.5, 1.0) + said(0.03 + 1.2e-8, 1.0, gravity=0.0)


@pytest.mark.parametrize("verb", [["scene", "check"], ["simulate", "--quiet"]])
def test_the_command_says_it_and_goes_on(verb: list[str], tmp_path: Path) -> None:
    scene = tmp_path / "scene.toml"
    scene.write_text("[floor]\nfriction = 0.2\n[[balls]]\nradius = 28.6\nmass = 170\nposition = [0, 0]\n")
    found = CliRunner().invoke(app, [*verb, str(scene)])
    assert found.exit_code == 0
    assert (
        'note: balls.0: 170 kg with a radius of 28.6 m: lighter than air; is the radius in mm? write "28.6 mm"'
        in found.stderr
    )


def test_a_comparison_says_it_too() -> None:
    found = CliRunner().invoke(app, ["compare", "--radius", "28.6"])
    assert found.exit_code == 0
    assert "note: ball: 0.1406 kg with a radius of 28.6 m: lighter than air" in found.stderr
