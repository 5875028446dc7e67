"""Real tables by name: what presets fill, what is refused, and where their cushions and pockets are."""

from __future__ import annotations

import math
import re
import tomllib
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import carom
from carom.core.geometry.features import FALLS, LEAVES, LINE, OVER, RIM, gap_to_feature
from carom.scene import Pockets, Table
from carom.scene.presets import presets
from carom.scene.scene import scene_dict

CORNER = {"mouth": 0.116, "jaw_angle": 142, "jaw_radius": 0.005, "shelf": 0.041, "radius": 0.062}
SIDE = {"mouth": 0.129, "jaw_angle": 104, "jaw_radius": 0.005, "shelf": 0.005, "radius": 0.0645}


def refused(**fields: Any) -> list[str]:
    with pytest.raises(carom.CaromError) as caught:
        Table(**fields)
    return str(caught.value).splitlines()


@pytest.mark.parametrize("name", list(presets()))
def test_every_number_of_a_preset_has_a_source_and_makes_a_scene(name: str) -> None:
    preset = presets()[name]
    parts = {part: {field: one.value for field, one in found.items()} for part, found in preset.parts.items()}
    numbers = [*preset.cushions.values(), *(one for found in preset.parts.values() for one in found.values())]
    assert len(numbers) >= 13
    assert all(len(one.source) >= 8 for one in numbers)
    table = Table(preset=name)
    assert preset.title
    assert {field: getattr(table, field) for field in ("length", "width", "nose_height")} == {
        field: preset.cushions[field].value for field in ("length", "width", "nose_height")
    }
    ball = {**parts["ball"], "position": (0, 0), "velocity": (1, 0), "rolling": True}
    scene = carom.Scene(floor=parts["floor"], walls=[table], balls=[ball], ball_contact=parts["ball_contact"])
    assert scene.laws[0].name == "two-step"
    assert table.nose_height is not None
    assert ball["radius"] < table.nose_height < 2 * ball["radius"]
    assert len(table.pockets) in (0, 6)


def test_what_is_given_has_precedence_over_the_preset() -> None:
    table = Table(preset="snooker", nose_height=0.03, restitution=0.8, corner_pockets={"mouth": 0.09, "radius": 0.05})
    known = Table(preset="snooker")
    assert known.corner_pockets is not None
    assert (table.nose_height, table.length, table.friction) == (0.03, known.length, known.friction)
    assert table.corner_pockets == known.corner_pockets.model_copy(update={"mouth": 0.09, "radius": 0.05})
    assert table.side_pockets == known.side_pockets
    assert Table(preset="snooker", corner_pockets=None, side_pockets=None).pockets == ()
    assert carom.scene.Table is Table


def test_a_table_in_json_is_the_same_table_again() -> None:
    for name in presets():
        table = Table(preset=name)
        assert Table(**table.model_dump()) == table


@pytest.mark.parametrize(
    ("fields", "said"),
    [
        ({"preset": "snoker"}, "expected one of carom, carom-half-match, carom-small, pool-9ft, pool-8ft, pool-7ft, snooker, got"
                               " 'snoker'; did you mean 'snooker'?"),
        ({"preset": 9}, "got 9"),
        ({"length": 0.2, "width": 0.15, "corner_pockets": CORNER}, "a cushion between two pockets"),
        ({"length": 0.5, "width": 0.25, "corner_pockets": {**CORNER, "shelf": -0.1, "radius": 0.2}}, "overlap by"),
        ({"preset": "pool-9ft", "length": 0.42, "width": 0.3, "side_pockets": {"radius": 0.4}},
         "bottom left pocket and bottom middle pocket, which overlap by"),
        ({"preset": "pool-9ft", "corner_pockets": {"shelf": 0.3}}, "the pocket would lie outside the table"),
        ({"preset": "pool-9ft", "corner_pockets": {"shelf": -0.3}}, "the pocket would lie outside the table"),
        ({"preset": "pool-9ft", "side_pockets": {"radius": 0.03}}, "a pocket wide enough for the jaws to end over its edge"),
        ({"preset": "pool-9ft", "side_pockets": {"jaw_angle": 80}}, "an angle from 90 to 175 degrees"),
        ({"preset": "pool-9ft", "side_pockets": {"mouht": 0.1}}, "did you mean 'mouth'?"),
        ({"length": 2.0, "width": 1.0, "side_pockets": {"mouth": 0.1}}, "Table: side_pockets.jaw_angle: expected"),
    ],
)  # fmt: skip
def test_what_is_wrong_with_a_table_is_said(fields: dict[str, Any], said: str) -> None:
    lines = refused(**fields)
    assert any(said in line for line in lines), lines
    assert len(lines) == 1 or "jaw_angle" in said


def test_a_scene_file_with_an_unknown_table(tmp_path: Path) -> None:
    file = tmp_path / "scene.toml"
    file.write_text(
        '[[walls]]\nshape = "table"\npreset = "pool"\n[[balls]]\nradius = 0.03\nmass = 0.2\nposition = [0, 0]\n'
    )
    with pytest.raises(carom.CaromError) as caught:
        carom.load_scene(file)
    (line,) = str(caught.value).splitlines()
    assert line.startswith(f"{file}: walls[0].preset: expected one of carom, ")


def test_pockets_are_where_the_numbers_say() -> None:
    table = Table(length=2.54, width=1.27, corner_pockets=CORNER, side_pockets=SIDE)
    assert [pocket.name for pocket in table.pockets] == [
        "bottom left pocket", "bottom middle pocket", "bottom right pocket", "top right pocket", "top middle pocket",
        "top left pocket",
    ]  # fmt: skip
    tips = (
        np.array((-1.27 + CORNER["mouth"] / math.sqrt(2), -0.635)),
        np.array((-1.27, -0.635 + CORNER["mouth"] / math.sqrt(2))),
    )
    assert np.linalg.norm(tips[0] - tips[1]) == pytest.approx(CORNER["mouth"])
    corner, side = table.pockets[0], table.pockets[1]
    assert math.dist(corner.center, (tips[0] + tips[1]) / 2) == pytest.approx(CORNER["shelf"] + CORNER["radius"])
    assert corner.center[0] + 1.27 == pytest.approx(corner.center[1] + 0.635)
    assert side.center == pytest.approx((0.0, -0.635 - SIDE["shelf"] - SIDE["radius"]))
    upright = Table(length=1.27, width=2.54, corner_pockets=CORNER, side_pockets=SIDE)
    assert [pocket.name for pocket in upright.pockets][2] == "right middle pocket"
    assert upright.pockets[2].center == pytest.approx((0.635 + SIDE["shelf"] + SIDE["radius"], 0.0))


def test_jaws_are_tangent_to_noses_and_facings() -> None:
    scene = carom.Scene(
        floor={"friction": 0.2},
        walls=[Table(preset="snooker", nose_height=None)],
        balls=[{"radius": 0.02, "mass": 0.1, "position": (0, 0)}],
    )
    table = scene.walls[0]
    assert isinstance(table, Table)
    features = scene.features()
    jaws = [f for f in features.view(np.recarray) if f.kind == LINE and f.R > 0]
    assert len(jaws) == 12
    # a small ball that is led along the whole cushion, always in touch, touches one thing at a time, or two where they join
    a = 0.001
    for mouth in table._layout.mouths:
        for jaw in (mouth.before, mouth.after):
            for point in (jaw.nose_end, jaw.start):
                n = (np.array(point) - jaw.center) / jaw.radius
                assert np.linalg.norm(n) == pytest.approx(1, abs=1e-12)
                x = (*(np.array(point) + a * n), 0.02)
                gaps = [gap_to_feature(f, a, x) for f in features.view(np.recarray) if f.kind != OVER]
                assert min(gaps) == pytest.approx(0, abs=1e-12)
            assert np.dot(np.array(jaw.facing), np.array(jaw.start) - jaw.center) == pytest.approx(0, abs=1e-15)


def test_features_of_a_table_with_pockets() -> None:
    for height, gates in ((math.inf, 6), (0.05, 6 + 6 + 6 + 12 + 12)):
        table = Table(preset="pool-9ft", height=height)
        scene = carom.Scene(
            floor={"friction": 0.2}, walls=[table], balls=[{"radius": 0.0286, "mass": 0.16, "position": (0, 0)}]
        )
        features = scene.features()
        falls = features[features["ends"] == FALLS]
        assert falls["at"].tolist() == list(range(6))
        assert (falls["kind"] == OVER).all()
        assert (features["kind"] == OVER).sum() == gates
        assert (features["kind"] == RIM).sum() == (12 if height == math.inf else 24)
        assert set(features["ends"].tolist()) <= {FALLS, LEAVES}
    assert scene.pocket_names == tuple(pocket.name for pocket in table.pockets)


def test_where_no_ball_can_be() -> None:
    table = Table(preset="pool-9ft")
    z = 0.0286
    pocket = table.pockets[0]
    diagonal = np.array((1.0, 1.0)) / math.sqrt(2)
    edge = np.array(pocket.center) + pocket.radius * diagonal
    assert table.blocked((*(edge - 1e-6 * diagonal), z))  # over the pocket
    assert not table.blocked((*(edge + 1e-6 * diagonal), z))  # between the jaws
    assert abs(edge[0]) < 1.27
    assert table.blocked((-1.2, -0.66, z))  # in the rubber of a jaw
    assert table.blocked((-1.3, -0.67, z))  # behind the pocket
    assert table.blocked((0.6, -0.64, z))  # in a cushion
    assert not table.blocked((0.6, -0.63, z))
    deep = Table(preset="snooker")
    tip = deep._layout.mouths[1].after
    rounded = np.array(tip.center) + (tip.radius + 0.001) * np.array(tip.middle)
    assert abs(rounded[1]) > deep.width / 2  # beyond the nose's line, in front of the jaw that is rounded off
    assert not deep.blocked((*rounded, z))
    assert deep.blocked((*(rounded - 0.002 * np.array(tip.middle)), z))


def test_pockets_in_json() -> None:
    corner = Pockets(**CORNER)
    scene = carom.Scene(
        floor={"friction": 0.2},
        walls=[Table(length=2, width=1, corner_pockets=corner, restitution=0.8, friction=0.1)],
        balls=[{"radius": 0.0286, "mass": 0.16, "position": (0, 0)}],
    )
    wall = scene_dict(scene)["walls"][0]
    assert wall["corner_pockets"] == {**CORNER, "jaw_angle": 142.0}
    assert wall["side_pockets"] is None
    assert wall["preset"] is None


@pytest.mark.parametrize("name", list(presets()))
def test_a_new_scene_of_a_table_has_all_its_numbers_and_runs(name: str, tmp_path: Path) -> None:
    file = tmp_path / "scene.toml"
    text = carom.scene_text(name)
    file.write_text(text, encoding="utf-8")
    scene = carom.load_scene(file)
    preset = presets()[name]
    parts = {part: {field: one.value for field, one in found.items()} for part, found in preset.parts.items()}
    assert scene.walls[0] == Table(preset=name, name="cushions")
    assert {(ball.radius, ball.mass) for ball in scene.balls} == {(parts["ball"]["radius"], parts["ball"]["mass"])}
    assert scene.floor == carom.Floor(**parts["floor"])
    assert scene.ball_contact == carom.BallContact(**parts["ball_contact"])
    assert len(scene.balls) == {"c": 3, "p": 16, "s": 22}[name[0]]
    # its sources, once each at the end; and its comments are sound fields
    for one in (*preset.cushions.values(), *(one for part in preset.parts.values() for one in part.values())):
        assert text.count(f"# {one.key}: ") == 1
    loose = re.sub(r"^# (?=[\w.]+ = )", "", text, flags=re.MULTILINE)
    file.write_text(loose, encoding="utf-8")
    assert carom.load_scene(file) == scene


def test_the_first_shot_of_the_carom_table_scores() -> None:
    run = carom.simulate(carom.Scene(**tomllib.loads(carom.scene_text("carom"))))
    met = [event.name for event in run.events.of("wall", "ball", ball=0)]
    assert met[0] == "red"
    assert met.index("yellow") >= 4
    assert set(met[1 : met.index("yellow")]) == {"cushions"}
    # a real nose: the ball hops by less than its radius
    assert run.at(np.linspace(0, run.end, 2000)).position[:, 0, 2].max() < 1.2 * 0.03075


def test_no_other_table_has_a_scene() -> None:
    with pytest.raises(
        carom.CaromError, match=r"^table: expected one of carom, .*, got 'karom'; did you mean 'carom'\?$"
    ):
        carom.scene_text("karom")


def test_the_scene_of_the_readme_is_that_of_the_table() -> None:
    file = Path(__file__).parents[2] / "docs" / "scenes" / "carom_table.toml"
    assert file.read_text(encoding="utf-8") == carom.scene_text("carom")
