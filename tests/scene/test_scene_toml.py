"""Scenes from files, from texts and by the name of a real table; scenes written to files."""

from __future__ import annotations

from pathlib import Path

import pytest
from reference.brute_force_scene import random_scene

import carom
from carom.scene.presets import presets


@pytest.mark.parametrize("name", list(presets()))
def test_the_name_of_a_real_table_is_its_scene(name: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "table.toml").write_text(carom.scene_text(name), encoding="utf-8")
    assert (
        carom.load_scene(name) == carom.load_scene(tmp_path / "table.toml") == carom.load_scene(carom.scene_text(name))
    )
    # a file of that name has precedence
    monkeypatch.chdir(tmp_path)
    (tmp_path / name).write_text(carom.scene_text(), encoding="utf-8")
    assert len(carom.load_scene(name).balls) == 1


def test_a_table_that_is_not_there_is_named_and_a_file_with_the_command_that_writes_it() -> None:
    with pytest.raises(carom.CaromError, match=r"did you mean 'pool-9ft'\?$"):
        carom.load_scene("pool9ft.toml")
    with pytest.raises(carom.CaromError, match=r"No such file or directory; did you mean 'pool-9ft'\?$"):
        carom.load_scene("pool9ft")
    with pytest.raises(carom.CaromError, match=r"a file's name ends with \.toml; tables have the names carom, "):
        carom.load_scene("table")
    assert carom.new_scene("pool-9ft", break_speed="8 m/s") == carom.new_scene("pool-9ft", break_speed=8)
    with pytest.raises(carom.CaromError, match="break_speed: expected a speed in m/s, > 0 and at most 100, got '8 mm'"):
        carom.new_scene("pool-9ft", break_speed="8 mm")
    with pytest.raises(carom.CaromError, match="scene: line 2: expected TOML"):
        carom.load_scene("gravity = 1\nb")


def test_a_saved_scene_is_equal(tmp_path: Path) -> None:
    made = 0
    for seed in range(120):
        try:
            scene = random_scene(seed)
        except carom.CaromError:
            continue
        assert carom.load_scene(carom.save_scene(scene, tmp_path / "scene.toml")) == scene
        made += 1
    assert made > 80
    struck = {
        "radius": 0.03,
        "mass": 0.2,
        "position": (0.5, 0),
        "strike": {"speed": 2, "azimuth": 20, "offset": [0.2, 0.1]},
    }
    wall = {"shape": "plane", "point": (0, 0, 0), "normal": (1, 0, 0), "friction": float("inf")}
    wall |= {"restitution": {"form": "power", "at_rest": 0.8, "speed": 1.0}, "law": "no-slip"}
    scene = carom.Scene(floor={"friction": 0.2}, walls=[wall], balls=[struck], run={"floor_contact": "after"})
    assert carom.load_scene(carom.save_scene(scene, tmp_path / "struck.toml")) == scene


def test_what_a_file_cannot_hold_is_refused_and_nothing_written(tmp_path: Path) -> None:
    law = carom.LAWS["mirror"]
    scene = carom.Scene(gravity=0, balls=[{"radius": 0.03, "mass": 0.2, "position": (0, 0, 0)}], run={"law": law})
    with pytest.raises(carom.CaromError, match=r"got the carom.Law 'mirror'.*file.py:name"):
        carom.save_scene(scene, tmp_path / "scene.toml")
    with pytest.raises(carom.CaromError, match=r"ends with .toml"):
        carom.save_scene(scene, tmp_path / "scene.json")
    assert not list(tmp_path.iterdir())


def test_a_table_needs_a_floor() -> None:
    ball = {"radius": 0.03, "mass": 0.2, "position": (0, 0)}
    with pytest.raises(carom.CaromError, match=r"walls\[0\]: expected a floor, as there is a table, got none"):
        carom.Scene(walls=[carom.Table(preset="pool-9ft")], balls=[ball])
    carom.Scene(walls=[carom.Table(preset="pool-9ft")], balls=[ball], gravity=0)
