"""Growth of small displacements: flights, a ball that disperses, differences of runs, and what is printed."""

from __future__ import annotations

import json
import math
from pathlib import Path

import numpy as np
import pytest
from reference.commands import command, fails
from reference.sweep_scenes import table_scene

import carom
from carom.scene.paths import replaced


def pair(offset: float, duration: float) -> carom.Scene:
    """A smooth elastic ball flies at another one that is at rest, without gravity."""
    balls = [
        carom.SceneBall(radius=0.1, mass=1.0, position=(0, offset, 0), velocity=(1, 0, 0)),
        carom.SceneBall(radius=0.1, mass=1.0, position=(1.2, 0, 0), velocity=(0, 0, 0)),
    ]
    contact = carom.BallContact(restitution=1.0, friction=0.0)
    return carom.Scene(gravity=0, balls=balls, ball_contact=contact, run=carom.Run(duration=duration))


def test_nothing_grows_without_an_impact() -> None:
    growth = carom.simulate(pair(0.5, 1.0)).lyapunov()
    assert growth.stretch == pytest.approx(np.ones_like(growth.stretch), abs=1e-14)
    assert growth.exponent == pytest.approx(0.0, abs=1e-14)
    assert growth.horizon(1e-3, 1.0) == math.inf


def test_a_full_hit_turns_an_offset_into_a_direction() -> None:
    # full on: an offset d of the first ball turns the direction of the second by d / (2 a), which then moves away from the axis by
    # d (1 + s / (2 a)) or so over the way s; both balls move apart by as much
    run = carom.simulate(pair(0.0, 5.0))
    s, a = 4.0, 0.1
    growth = run.lyapunov()
    position = run.sensitivity(["balls.0.position"]).final.position
    assert abs(position[1, 1, 1]) == pytest.approx(s / (2 * a), rel=1e-12)
    assert growth.stretch[-1] > s / (2 * a)
    assert growth.stretch[0] == pytest.approx(1.0)


def test_growth_is_that_of_differences() -> None:
    scene = replaced(table_scene(duration=2.0), {"balls.0.velocity": (2.2, 1.05)})
    run = carom.simulate(scene)
    assert (run.log["kind"] == 3).any()  # (two balls meet)
    growth, h = run.lyapunov(), 1e-6
    columns = []
    for i in range(3):
        for k in range(2):
            ends = []
            for sign in (1, -1):
                x = np.array([ball.center for ball in scene.balls])
                x[i, k] += sign * h
                ends.append(carom.simulate_many(scene, position=x[None]).final.position[0].ravel())
            columns.append((ends[0] - ends[1]) / (2 * h))
    assert growth.stretch[-1] == pytest.approx(np.linalg.norm(np.array(columns), 2), rel=1e-4)
    assert growth.horizon(1e-3, 1e-3) == 0.0
    error = 0.5 / float(growth.stretch.max())
    assert 0 < growth.horizon(error, 0.4) <= 2.0


def test_the_horizon_refuses_no_lengths() -> None:
    growth = carom.simulate(pair(0.5, 1.0)).lyapunov()
    for error, size in [(0.0, 1.0), (1e-3, math.nan)]:
        with pytest.raises(carom.CaromError, match="expected a length > 0"):
            growth.horizon(error, size)


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
