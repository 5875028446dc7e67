"""Acceptance windows: closed forms of a direct hit and of a bank, and single runs on either side of every edge."""

from __future__ import annotations

import json
import math
from pathlib import Path

import pytest
from reference.commands import command, fails
from sweeps.test_aim import bank

import carom
from carom.sweeps.aiming import Window


def test_windows_of_a_direct_hit_and_of_a_bank_have_their_closed_forms() -> None:
    scene = carom.replaced(bank(), {"floor.friction": 0.0})  # (straight on after the wall)
    found = carom.aim_windows(scene, {"balls.0.velocity": (1.0, 2.0)}, {"hit": "red"}, speeds=3, directions=720)
    assert [one.outcome for one in found] == ["red"] * 6
    assert sorted(one.shot for one in found) == ["1-cushion kick"] * 3 + ["direct"] * 3
    # the red ball, and its mirror image in the line that the centre turns round at
    for x, y in ((0.3, 0.9), (-1.24, 0.9)):
        middle, half = math.degrees(math.atan2(y, x)), math.degrees(math.asin(0.06 / math.hypot(x, y)))
        same = [one for one in found if one.low_deg < middle < one.high_deg]
        assert sorted(one.speed for one in same) == [1.0, 1.5, 2.0]
        for one in same:
            assert (one.low_deg, one.high_deg) == pytest.approx((middle - half, middle + half), abs=1e-5)
    after = carom.aim_windows(
        scene, {"balls.0.velocity": (1.0, 2.0)}, {"hit": "red", "cushions": 1}, speeds=1, directions=720
    )
    assert [round(one.low_deg) for one in after] == [round(found[-1].low_deg)]


def pool() -> carom.Scene:
    ball = {"radius": 0.028575, "mass": 0.17}
    return carom.Scene(
        floor={"restitution": 0.5, "friction": 0.2, "rolling_resistance": 0.01, "spin_friction": 0.0127},
        walls=[{"shape": "table", "preset": "pool-9ft"}],
        balls=[{**ball, "position": (-0.6, -0.2), "name": "cue"}, {**ball, "position": (0.2, 0.15), "name": "one"}],
        ball_contact={"restitution": 0.95, "friction": 0.06},
        run={"duration": 20},
    )


def pocket_of(scene: carom.Scene, speed: float, degrees: float) -> str:
    turned = math.radians(degrees)
    velocity = (speed * math.cos(turned), speed * math.sin(turned), 0.0)
    fell = carom.simulate(carom.replaced(scene, {"balls.0.velocity": velocity})).events.of("pocketed", ball="one")
    return fell[0].name if len(fell) else ""


def test_single_runs_on_either_side_of_the_edges() -> None:
    scene = pool()
    found = carom.aim_windows(
        scene, {"balls.0.velocity": (1.5, 4.0)}, {"ball": "one", "pocket": "any"}, speeds=2, directions=1440
    )
    assert len(found) >= 4
    assert len({one.outcome for one in found}) >= 2
    assert [one.width_deg for one in found] == sorted((one.width_deg for one in found), reverse=True)
    for one in found[:4]:
        for inside, outside in ((one.low_deg + 1e-4, one.low_deg - 1e-4), (one.high_deg - 1e-4, one.high_deg + 1e-4)):
            assert pocket_of(scene, one.speed, inside) == one.outcome
            assert pocket_of(scene, one.speed, outside) != one.outcome


def kind_of(scene: carom.Scene, window: Window, target: int) -> str:
    """Return the kind of the shot just within a window, from what its one run says event by event."""
    turned = math.radians(window.low_deg + min(1e-4, window.width_deg / 2))
    velocity = (window.speed * math.cos(turned), window.speed * math.sin(turned), 0.0)
    run = carom.simulate(carom.replaced(scene, {"balls.0.velocity": velocity}))
    pocket = next(p for wall in scene.walls for p in wall.pockets if p.name == window.outcome)
    first: dict[int, int] = {}
    kick, bank, touched = 0, 0, 0
    for event in run.events:
        if event.kind == "pocketed" and event.ball == target:
            break
        if event.kind == "ball":
            first.setdefault(event.ball, event.other)
        kick += event.kind == "wall" and event.ball == 0 and 0 not in first
        touched += event.kind == "wall" and event.ball == target
        # a bank goes over a cushion that the pocket is not beside: those of its own only brush the ball
        if event.kind == "wall" and event.ball == target:
            x, y = event.position[:2]
            bank = bank if min(abs(x - pocket.center[0]), abs(y - pocket.center[1])) < 0.1 else touched
    parts = [] if first[0] == target else ["carom" if first[target] == 0 else "combination"]
    parts += [f"{kick}-cushion kick"] if kick else []
    parts += [f"{bank}-cushion bank"] if bank else []
    return ", ".join(parts) or "direct"


def test_kinds_of_shots_are_what_single_runs_say() -> None:
    two = {"radius": 0.028575, "mass": 0.17, "position": (1.18, 0.58), "name": "two"}
    three = pool().model_copy(update={"balls": (*pool().balls, carom.SceneBall(**two))})
    seen = set()
    for scene, target in ((pool(), 1), (three, 2)):
        found = carom.aim_windows(
            scene, {"balls.0.velocity": (4.8, 5.0)}, {"ball": target, "pocket": "any"}, speeds=1, directions=3600
        )
        for one in found:
            assert kind_of(scene, one, target) == one.shot, one
            seen |= set(one.shot.split(", "))
    assert {"direct", "1-cushion kick", "1-cushion bank", "combination", "carom"} <= seen


def test_the_command_prints_and_draws_them(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    file, picture = tmp_path / "bank.toml", tmp_path / "windows.png"
    carom.save_scene(bank(), file)
    words = ["aim", str(file), "--hit", "red", "--free", "balls.0.velocity=1:2", "--windows", "2"]
    printed = command(capsys, *words, "--json", "--plot", str(picture))
    found = json.loads(printed[1])
    assert [one["outcome"] for one in found["windows"]] == ["red"] * 4
    assert found["speeds"] == [1.0, 2.0]
    assert picture.stat().st_size > 5000
    assert "expected" in " ".join(fails(capsys, *words[:-1], "0"))


def test_what_has_no_windows_is_refused() -> None:
    for free, many in ((["balls.0.spin_z"], 3), (["balls.0.velocity", "balls.0.spin_z"], 3), (["balls.0.velocity"], 0)):
        with pytest.raises(carom.CaromError) as error:
            carom.aim_windows(bank(), free, {"hit": "red"}, speeds=many)
        assert error.value.records[0].field in ("free", "speeds")
