"""Cushions of a table with surfaces of their own: the run, its derivatives, files and faults."""

from __future__ import annotations

import pickle
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from reference.sweep_scenes import CAROM_TABLE

import carom
from carom.core.geometry.features import FALLS
from carom.scene.scene import scene_dict
from carom.scene.shapes import Table

VELOCITIES = {"bottom": (0.6, -3.0), "right": (3.0, 0.6), "top": (-0.6, 3.0), "left": (-3.0, -0.6)}
REST, RUBBING = 0.7, 0.11


def on_table(velocity: tuple[float, float] = (3.0, 0.6), **fields: Any) -> carom.Scene:
    ball = {"radius": 0.03075, "mass": 0.21, "position": (0.1, 0.05), "velocity": velocity, "rolling": True}
    return carom.Scene(
        floor={"friction": 0.2, "rolling_resistance": 0.006},
        walls=[CAROM_TABLE | fields],
        balls=[ball],
        run={"duration": 1.0},
    )


def after_wall(scene: carom.Scene) -> np.ndarray:
    """Velocity and spin after the first cushion."""
    event = carom.simulate(scene).events.of("wall")[0]
    return np.array([event.after.velocity, event.after.spin])


@pytest.mark.parametrize("name", VELOCITIES)
def test_a_cushion_with_a_surface_of_its_own_answers_as_a_table_that_has_it_everywhere(name: str) -> None:
    own = {"restitution": REST, "friction": RUBBING}
    for side, velocity in VELOCITIES.items():
        found = after_wall(on_table(velocity, sides={name: own}))
        alike = after_wall(on_table(velocity, **(own if side == name else {})))
        assert np.array_equal(found, alike)
        assert np.array_equal(found, after_wall(on_table(velocity))) == (side != name)


def test_one_number_of_a_side_leaves_the_other_to_the_table() -> None:
    scene = on_table(sides={"right": {"friction": RUBBING}})
    assert np.array_equal(after_wall(scene), after_wall(on_table(friction=RUBBING)))
    features = on_table(sides={"top": {"restitution": {"form": "han-2005"}}}).features()
    assert len(np.unique(features["form"])) == 2
    assert np.all(features["mu"] == 0.2)


def test_jaws_have_the_surface_of_the_cushion_that_they_end() -> None:
    four = {"bottom": 0.5, "right": 0.6, "top": 0.7, "left": 0.8}
    sides = {name: {"restitution": e} for name, e in four.items()}
    table = Table(preset="pool-9ft", sides=sides)
    ball = {"radius": 0.028575, "mass": 0.17, "position": (0.0, 0.0)}
    features = carom.Scene(floor={"friction": 0.2}, walls=[table], balls=[ball]).features()
    found = features[features["ends"] != FALLS]  # (the edges of pockets have no surface)
    near = {"bottom": (1, -table.width / 2), "right": (0, table.length / 2)}
    near |= {"top": (1, table.width / 2), "left": (0, -table.length / 2)}
    for name, (axis, line) in near.items():
        (mine,) = np.nonzero(found["e"][:, 0] == four[name])
        # noses, and two jaws at each of their pockets, within a mouth of the line of the cushion
        assert len(mine) > 8
        assert np.all(np.abs(found["p"][mine, axis] - line) < 0.1)
    assert set(np.unique(found["e"][:, 0])) == set(four.values())


def test_the_derivative_by_the_number_of_a_side_is_that_of_differences() -> None:
    path = "walls.0.sides.right.restitution"
    scene = on_table(sides={"right": {"restitution": REST}})
    found = carom.simulate(scene).sensitivity([path]).final.position[..., 0]
    ends = [carom.simulate(carom.replaced(scene, {path: REST + h})).final.position for h in (1e-6, -1e-6)]
    assert np.allclose(found, (ends[0] - ends[1]) / 2e-6, rtol=0, atol=1e-7)
    assert np.abs(found).max() > 0.1
    other = carom.replaced(scene, {"walls.0.sides.left.restitution": REST})
    assert not np.any(carom.simulate(other).sensitivity(["walls.0.sides.left.restitution"]).final.position)


def test_a_side_is_set_by_its_path_on_any_table() -> None:
    found = carom.replaced(
        on_table(), {"walls.0.sides.right.restitution": REST, "walls.0.sides.right.friction": RUBBING}
    )
    assert found == on_table(sides={"right": {"restitution": REST, "friction": RUBBING}})
    assert found.walls[0].sides.left == on_table().walls[0].sides.left


def test_files_and_pickles_keep_sides(tmp_path: Path) -> None:
    scene = on_table(
        sides={"right": {"restitution": REST}, "left": {"restitution": {"form": "han-2005"}, "friction": 0.1}}
    )
    file = carom.save_scene(scene, tmp_path / "scene.toml")
    assert "[walls.sides.right]\nrestitution = 0.7" in file.read_text(encoding="utf-8")
    assert carom.load_scene(file) == scene
    assert pickle.loads(pickle.dumps(scene)) == scene
    assert "sides" not in carom.scene_text(on_table())
    assert "sides" not in scene_dict(on_table())["walls"][0]
    assert scene_dict(scene)["walls"][0]["sides"]["left"]["friction"] == 0.1


@pytest.mark.parametrize(
    ("sides", "line"),
    [
        ({"nroth": {}}, "Scene: walls[0].sides.nroth: expected a field that is known here, got 'nroth'; known are bottom"),
        ({"rigth": {}}, "Scene: walls[0].sides.rigth: expected a field that is known here, got 'rigth'; did you mean 'right'?"),
        ({"right": {"restitution": 2}}, "Scene: walls[0].sides.right.restitution: expected a number from 0 to 1, or a table"),
        ({"top": {"friction": -1}}, "Scene: walls[0].sides.top.friction: expected a number >= 0 (inf: never slips), got -1"),
        ({"top": 0.8}, "Scene: walls[0].sides.top: expected a table of fields, got 0.8"),
    ],
)  # fmt: skip
def test_faults_of_sides_are_one_line(sides: Any, line: str) -> None:
    with pytest.raises(carom.CaromError) as error:
        on_table(sides=sides)
    assert str(error.value).startswith(line)
    assert "\n" not in str(error.value)


def test_a_law_that_cannot_have_the_restitution_of_a_side_says_which() -> None:
    with pytest.raises(carom.CaromError) as error:
        on_table(law="conventional", restitution=1.0, nose_height=None, sides={"right": {"restitution": 0.5}})
    said = str(error.value)
    assert said.startswith("Scene: walls[0].sides.right.restitution: expected hypothesis 3: a wall of restitution 1")
    assert said.endswith("for the law conventional, got 0.5")
    assert "\n" not in said
