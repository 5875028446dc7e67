"""carom's runs shown in pooltool, and pooltool's game with carom's laws."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import Any

import pytest
from reference.forking import Forked

import carom
from carom.interop.pooltool import to_system

BALL: dict[str, Any] = {"radius": 0.03, "mass": 0.2}


def a_run(walls: list[Any], balls: list[Any]) -> carom.Trajectory:
    floor = carom.Floor(friction=0.2, rolling_resistance=0.01, spin_friction=0.01)
    return carom.simulate(carom.Scene(floor=floor, walls=walls, balls=balls, run=carom.Run(duration=1)))


TABLE = {"shape": "table", "length": 2.84, "width": 1.42, "restitution": 0.85, "friction": 0.2}


@pytest.mark.parametrize(
    ("walls", "more", "said"),
    [
        ([{"shape": "segment", "start": (0, -1), "end": (0, 1), "restitution": 0.8, "friction": 0.2}], {}, "of shape 'table'"),
        ([TABLE], {"radius": 0.02}, "balls of one radius and mass"),
        ([{**TABLE, "nose_height": 0.037,
           "corner_pockets": {"mouth": 0.116, "jaw_angle": 142, "jaw_radius": 0.005, "shelf": 0.041, "radius": 0.062}}],
         {}, "six pockets or none"),
    ],
)  # fmt: skip
def test_what_pooltool_cannot_show_is_one_line(walls: list[Any], more: Any, said: str) -> None:
    run = a_run(
        walls, [carom.SceneBall(**BALL, position=(0.5, 0.1)), carom.SceneBall(**{**BALL, **more}, position=(0.9, 0.1))]
    )
    with pytest.raises(carom.CaromError, match=f"^to_system: run: expected .*{said}.*got") as caught:
        to_system(run)
    assert len(caught.value.faults) == 1


def test_cushions_with_surfaces_of_their_own_are_said_in_one_line(monkeypatch: pytest.MonkeyPatch) -> None:
    """They were left out without a word."""
    monkeypatch.setitem(sys.modules, "pooltool", None)
    own = {"right": {"restitution": 0.7}, "top": {"friction": 0.1}}
    run = a_run([{**TABLE, "sides": own}], [carom.SceneBall(**BALL, position=(0.5, 0.1))])
    with (
        pytest.warns(
            UserWarning, match=r"^to_system: run: sides.right, sides.top of the table are left out.*pooltool has one"
        ),
        pytest.raises(carom.CaromError, match="pooltool"),
    ):
        to_system(run)


def test_a_bad_step_is_one_line() -> None:
    run = a_run([TABLE], [carom.SceneBall(**BALL, position=(0.5, 0.1))])
    with pytest.raises(carom.CaromError, match="to_system: dt: expected a time in s, > 0, got 0"):
        to_system(run, dt=0)


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (["play", "--restitution", "0.8"], "play: expected --restitution and --friction together"),
        (["play", "--cushion", "x"], "law: expected"),
    ],
)  # fmt: skip
def test_play_says_what_is_wrong_and_ends_with_2(
    arguments: list[str], said: str, tmp_path: Path, forked: Forked
) -> None:
    code = f"import runpy, sys; sys.argv = ['play', *{arguments}]; runpy.run_module('carom.interop.pooltool', run_name='__main__')"
    ended, _out, err = forked(tmp_path, "-c", code)
    assert ended == 2
    assert err.startswith(said)
    assert err.count("\n") == 1
