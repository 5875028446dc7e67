"""Scenes, from Python and from TOML: what they mean, and what is said of those that mean nothing."""

from __future__ import annotations

import json
import math
import re
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from reference.commands import fails
from reference.scene_file import EXAMPLE
from typer.testing import CliRunner

import carom
from carom.cli import app
from carom.core.geometry.features import FEATURES
from carom.gas.scene import gas_text
from carom.laws.law import CALLED_WALL, CONTACT_WALL, MIRROR_WALL
from carom.laws.registry import LAWS
from carom.scene import (
    Arc,
    BallContact,
    Box,
    Cylinder,
    Floor,
    Plane,
    Rack,
    Run,
    Scene,
    SceneAir,
    SceneBall,
    Segment,
    Sphere,
    Table,
    load_scene,
    scene_text,
)
from carom.scene.restitution import Exponential, Han2005, Polynomial, Power, Viscoelastic
from carom.scene.shapes import SHAPES


def load(tmp_path: Path, text: str, **options: bool) -> Scene:
    file = tmp_path / "scene.toml"
    file.write_text(text, encoding="utf-8")
    return load_scene(file, **options)


# --- what a scene means -------------------------------------------------------------------------------------------


def test_the_designs_example_means_what_it_says(tmp_path: Path) -> None:
    expected = Scene(
        gravity=(0, 0, -9.80665),
        floor=Floor(restitution=0.5, friction=0.2, rolling_resistance=0.01, spin_friction=0.0127),
        walls=[Plane(point=(0, 0, 0), normal=(1, 0, 0), restitution=0.85, friction=0.2)],
        balls=[SceneBall(radius=0.03075, mass=0.21, position=(1, 0.5, 0.03075), velocity=(-2, 1, 0), rolling=True)],
        run=Run(law="two-step", duration=10),
    )
    scene = load(tmp_path, EXAMPLE)
    assert scene == expected
    ball, state = scene.balls[0].ball, scene.balls[0].state
    assert ball == carom.Ball(0.03075, 0.21)
    assert state == carom.rolling(ball, (-2.0, 1.0))
    assert state.position is not None
    assert state.position.tolist() == [1.0, 0.5, 0.03075]
    assert scene.describe() == (
        "a floor, a plane through (0, 0, 0) with normal (1, 0, 0), 1 ball, law two-step, 10 s"
    )  # fmt: skip


def test_what_is_left_out() -> None:
    scene = Scene(floor=Floor(friction=0.1), balls=[SceneBall(radius=1, mass=1, position=(0, 0))])
    assert scene.gravity == (0.0, 0.0, -9.80665)
    assert scene.run == Run(law="two-step", duration=None, max_events=None, floor_contact="with")
    assert scene.ball_contact.contact == (0, (1.0, 0.0, 0.0), 0.0, 0.0)
    assert scene.floor is not None
    assert scene.floor.contact == (0, (0.0, 0.0, 0.0), 0.1, 0.0)
    assert (scene.floor.rolling_resistance, scene.floor.spin_friction) == (0, 0)
    state = scene.balls[0].state
    assert [x.tolist() for x in (state.velocity, state.spin)] == [[0, 0, 0], [0, 0, 0]]
    assert len(scene.features()) == 0
    assert BallContact(restitution=0.9, friction=0.05, tangential_restitution=0.5).contact == (
        0,
        (0.9, 0, 0),
        0.05,
        0.5,
    )


def test_z_left_out_is_on_the_floor_or_in_the_plane() -> None:
    ball = SceneBall(radius=0.5, mass=1, position=(1, 2))
    assert Scene(balls=[ball], floor=Floor(friction=0)).balls[0].position == (1, 2, 0.5)
    assert Scene(balls=[ball]).balls[0].position == (1, 2, 0)
    high = SceneBall(radius=0.5, mass=1, position=(1, 2, 7))
    assert Scene(balls=[high], floor=Floor(friction=0)).balls[0].position == (1, 2, 7)


def test_gravity_is_a_number_downwards_or_a_vector() -> None:
    balls = [SceneBall(radius=0.5, mass=1, position=(1, 2))]
    assert Scene(gravity=1.5, balls=balls).gravity == (0, 0, -1.5)
    assert Scene(gravity="1 g0", balls=balls).gravity == (0, 0, -9.80665)
    assert Scene(gravity=(1, "2 m/s^2", np.float64(3)), balls=balls).gravity == (1, 2, 3)
    assert Scene(gravity=0, balls=balls, floor=Floor(friction=0)).gravity == (0, 0, 0)


def test_a_rolling_ball_has_its_side_free() -> None:
    ball = SceneBall(radius=0.03, mass=0.2, position=(0, 0), velocity=(1.0, -2.0), rolling=True, spin_z="2 rev/s")
    assert ball.state.spin.tolist() == pytest.approx([2 / 0.03, 1 / 0.03, 4 * math.pi])


def test_a_ball_and_its_state_become_a_scene_ball() -> None:
    ball = carom.Ball(0.03, 0.2, "hollow")
    state = carom.State((1, 2, 3), (4, 5, 6), (7, 8, 9))
    made = SceneBall.of(ball, state, name="white")
    assert made.ball == ball
    assert made.state == state
    assert made.state.position is not None
    assert made.state.position.tolist() == [7, 8, 9]
    assert made.name == "white"
    for wrong in (carom.State((1, 2, 3)), carom.State(np.zeros((2, 3)), position=np.zeros((2, 3)))):
        with pytest.raises(carom.CaromError, match=r"SceneBall\.of: state: expected one"):
            SceneBall.of(ball, wrong)
    with pytest.raises(carom.CaromError, match="a disc"):
        SceneBall.of(carom.Disc(), state)


@pytest.mark.parametrize(
    ("text", "metres"),
    [
        ("61.5 mm", 0.0615),
        ("61.5mm", 0.0615),
        ("2.25 in", 0.05715),
        ("1e2 cm", 1.0),
        ("+.5 km", 500.0),
        ("1_000 mm", 1.0),
    ],
)
def test_a_length_with_a_unit_is_the_float_next_to_it(text: str, metres: float) -> None:
    assert Sphere(center=(text, 0, 0), radius=1).center[0] == metres


def test_all_quantities_take_units() -> None:
    ball = SceneBall(
        radius="3 cm", mass="210 g", position=("1 mm", "2 mm", "1 m"), velocity=("3.6 km/h", 0), spin=(0, "60 rpm", "1 turn/s"),
    )  # fmt: skip
    assert (ball.radius, ball.mass, ball.position, ball.velocity) == (0.03, 0.21, (0.001, 0.002, 1.0), (1.0, 0.0, 0.0))
    assert ball.spin == pytest.approx((0, 2 * math.pi, 2 * math.pi))
    assert Run(duration="2 minutes").duration == 120
    assert Arc(center=(0, 0), radius=1, from_angle="0 rad", to_angle="3.141592653589793 rad").to_angle == pytest.approx(
        180
    )


def test_forms_of_restitution() -> None:
    def form(table: object) -> object:
        return Sphere(center=(0, 0, 0), radius=1, restitution=table).restitution

    assert form({"form": "han-2005"}) == Han2005()
    assert Han2005().p == (0.39, 0.257, -0.044)
    assert Han2005().at(1.0) == pytest.approx(0.603)
    assert Han2005().at(50.0) == pytest.approx(0.39 + 0.257**2 / (4 * 0.044))
    assert form({"form": "polynomial", "coefficients": [0.39, 0.257, -0.044]}) == Polynomial(coefficients=Han2005().p)
    power = form({"form": "power", "at_rest": 0.9, "speed": "10 cm/s"})
    assert power == Power(at_rest=0.9, speed=0.1, exponent=0.25)
    assert isinstance(power, Power)
    assert power.at(1.6) == pytest.approx(0.45)
    assert form({"form": "viscoelastic", "c": 0.1}) == Viscoelastic(c=0.1)
    assert Viscoelastic(c=0.1).at(1.0) == pytest.approx(1 - 0.1 + 0.6 * 0.01, abs=1e-3)
    fading = Exponential(at_rest=0.9, at_speed=0.5, speed=3.0)
    assert form({"form": "exponential", "at_rest": 0.9, "at_speed": 0.5, "speed": 3}) == fading
    assert fading.at(3.0) == pytest.approx(0.5 + 0.4 / math.e)
    number = form(0.85)
    assert number == form({"form": "constant", "value": 0.85})
    assert number.code == 0  # type: ignore[attr-defined]
    assert number.p == (0.85, 0, 0)  # type: ignore[attr-defined]


def test_features_carry_surface_and_law() -> None:
    scene = Scene(
        gravity=0,
        walls=[
            Table(length=2, width=1, height=0.5, restitution=0.8, friction=0.2),
            Sphere(center=(0, 0, 0.3), radius=0.1, law="no-slip"),
            Plane(
                point=(0, 0, 9), normal=(0, 0, -1), restitution=Han2005(), friction=math.inf, tangential_restitution=0.5
            ),
        ],
        balls=[SceneBall(radius=0.03, mass=0.2, position=(0.5, 0, 0.1))],
    )
    rows = scene.features()
    assert rows.dtype == FEATURES
    assert rows["wall"].tolist() == [0] * 12 + [1, 2]
    assert [rows[name][0].tolist() for name in ("form", "e", "mu", "beta", "law", "ends")] == [
        0,
        [0.8, 0, 0],
        0.2,
        0,
        0,
        1,
    ]
    assert [rows[name][12].tolist() for name in ("form", "e", "mu", "beta", "law", "ends")] == [
        0, [1, 0, 0], math.inf, 0, 2, 0,
    ]  # fmt: skip
    assert [rows[name][13].tolist() for name in ("form", "e", "mu", "beta", "law", "ends")] == [
        1, [0.39, 0.257, -0.044], math.inf, 0.5, 0, 0,
    ]  # fmt: skip
    assert rows["p"][12].tolist() == [0, 0, 0.3]
    assert scene.wall_names == ("table 0", "sphere 1", "plane 2")
    assert scene.ball_names == ("ball 0",)


def test_a_scene_comes_back_from_json_the_same() -> None:
    scene = Scene(
        gravity=0.1 + 0.2,
        floor=Floor(friction=math.inf),
        walls=[
            Segment(start=(0, 1 / 3), end=(1, 1 / 7), restitution=Han2005(), friction=math.inf, name="rail"),
            Box(corner=(-9, -9, -9), size=(20, 20, 20), inside=True, law="no-slip"),
        ],
        balls=[SceneBall(radius=0.1, mass=1, position=(0, 0), rolling=True, spin_z=1 / 3)],
        run=Run(max_events=7, floor_contact="after"),
    )
    assert Scene.model_validate_json(scene.model_dump_json()) == scene


OWN = """
def soft(v, w, n, a, kappa, e, mu, beta):
    u = v[0] * n[0] + v[1] * n[1] + v[2] * n[2]
    return (v[0] - 1.5 * u * n[0], v[1] - 1.5 * u * n[1], v[2] - 1.5 * u * n[2]), w
"""


def test_a_law_of_ones_own_lies_beside_the_scene(tmp_path: Path) -> None:
    (tmp_path / "soft.py").write_text(OWN)
    text = EXAMPLE.replace('law = "two-step"', 'law = "soft.py:soft"').replace(
        "restitution = 0.85\nfriction = 0.2\n", ""
    )
    scene = load(tmp_path, text, allow_own_laws=True)
    assert [law.name for law in scene.called_laws] == ["soft"]
    assert scene.features()["law"].tolist() == [CALLED_WALL]


def test_a_law_object_will_do() -> None:
    walls = [
        Plane(point=(0, 0, 0), normal=(1, 0, 0), restitution=0.9, friction=0.2, law=LAWS["contact"]),
        Sphere(center=(5, 0, 0), radius=1, law="mirror"),
    ]
    scene = Scene(walls=walls, balls=[SceneBall(radius=0.1, mass=1, position=(1, 0))], run=Run(law="no-slip"))
    assert [law.name for law in scene.laws] == ["contact", "mirror"]
    assert scene.called_laws == ()
    assert scene.features()["law"].tolist() == [CONTACT_WALL, MIRROR_WALL]


def test_the_new_scene_is_sound_and_shows_every_field(tmp_path: Path) -> None:
    scene = load(tmp_path, scene_text())
    assert scene.describe() == (
        "a floor, a table of 2.84 m by 1.42 m, cushion noses at 37 mm, 1 ball, law two-step, 20 s"
    )  # fmt: skip
    shown = {line.lstrip("# ").split(" =")[0] for line in scene_text().splitlines() if " = " in line}
    for model in (Scene, Floor, SceneAir, Table, Plane, Segment, Rack, SceneBall, BallContact, Run):
        tables = {"floor", "air", "walls", "rack", "balls", "ball_contact", "run"}
        assert set(model.model_fields) - tables <= shown, model


def test_its_commented_lines_are_sound_too(tmp_path: Path) -> None:
    text = (
        scene_text().replace("# spin = ", "## spin = ").replace("# strike = ", "## strike = ")
    )  # faults beside rolling = true
    scene = load(tmp_path, re.sub(r"^# (?=\w+ = |\[)", "", text, flags=re.MULTILINE))
    assert [wall.kind for wall in scene.walls] == ["table", "plane", "segment"]


# --- what is said of those that mean nothing ----------------------------------------------------------------------


PLANE = "[[walls]]\nshape = 'plane'\npoint = [0, 0, 0]\nnormal = [1, 0, 0]\nrestitution = 0.8\nfriction = 0.2\n"
BALL = "[[balls]]\nradius = 0.03\nmass = 0.2\nposition = [1, 0]\n"
FLOOR = "[floor]\nfriction = 0.2\n"
SOUND = FLOOR + PLANE + BALL
FREE = "expected a place where the ball touches nothing, got"
LAW = f"expected one of {', '.join(LAWS)}, or file.py:name"
WRONG = {
    "unknown field": (
        SOUND.replace("mass", "mas"),
        "balls[0].mass: expected a mass in kg, > 0, got nothing",
        "balls[0].mas: expected a field that is known here, got 'mas'; did you mean 'mass'?",
    ),
    "unknown field at the top": (
        "gravty = 1\n" + SOUND, "gravty: expected a field that is known here, got 'gravty'; did you mean 'gravity'?",
    ),
    "a field of another shape": (
        SOUND.replace("friction = 0.2\n[[b", "friction = 0.2\nsize = 3\n[[b"),
        "walls[0].size: expected a field that is known here, got 'size'; known are restitution, friction,"
        " tangential_restitution, stiffness_ratio, contact_time, yield_time, law, name, shape, point, normal",
    ),
    "unknown shape": (
        SOUND.replace("'plane'", "'plnae'"),
        f"walls[0].shape: expected one of {', '.join(SHAPES)}, got 'plnae'; did you mean 'plane'?",
    ),
    "no shape": (
        SOUND.replace("shape", "shpe"),
        f"walls[0].shape: expected one of {', '.join(SHAPES)}, got nothing; is 'shpe' meant to be 'shape'?",
    ),
    "one bracket": (
        SOUND.replace("[[walls]]", "[walls]"),
        "walls: expected a list, got {'shape': 'plane', 'point': [0, 0, 0], 'normal': [1, 0, 0], 'restitution': 0....;"
        " write [[walls]], with double brackets",
    ),
    "missing field": (
        SOUND.replace("normal = [1, 0, 0]\n", ""), "walls[0].normal: expected 3 numbers: a direction, got nothing",
    ),
    "missing friction of the floor": (
        "[floor]\n" + PLANE + BALL, "floor.friction: expected a number >= 0 (inf: never slips), got nothing",
    ),
    "missing surface": (
        SOUND.replace("restitution = 0.8\nfriction = 0.2\n", ""),
        "walls[0].restitution: expected a number from 0 to 1, or a form, got nothing; the law two-step reads it; mirror,"
        " conventional, no-slip do not need it",
        "walls[0].friction: expected a number >= 0 (inf: never slips), got nothing; the law two-step reads it; mirror,"
        " conventional, no-slip do not need it",
    ),
    "wrong type": (SOUND.replace("[1, 0, 0]", "[1, true, 0]"), "walls[0].normal[1]: expected a number, got True"),
    "text for a vector": (SOUND.replace("[1, 0, 0]", "'x'"), "walls[0].normal: expected 3 numbers: a direction, got 'x'"),
    "short vector": (SOUND.replace("[1, 0, 0]", "[1, 0]"), "walls[0].normal: expected 3 numbers: a direction, got [1, 0]"),
    "table for a number": (
        SOUND.replace("mass = 0.2", "mass = { kg = 1 }"), "balls[0].mass: expected a mass in kg, > 0, got {'kg': 1}",
    ),
    "one for true": (SOUND + "rolling = 1\n", "balls[0].rolling: expected true or false, got 1"),
    "text for true": (
        SOUND.replace("shape = 'plane'\npoint = [0, 0, 0]\nnormal = [1, 0, 0]", "shape = 'sphere'\ncenter = [0, 0, 0]\n"
                      "radius = 3\ninside = 'yes'"),
        "walls[0].inside: expected true or false, got 'yes'",
    ),
    "wrong unit": (
        SOUND.replace("radius = 0.03", "radius = '30 kg'"),
        "balls[0].radius: expected a length in m, > 0, got '30 kg'; 'kg' is a unit of another quantity",
    ),
    "unknown unit": (
        SOUND.replace("radius = 0.03", "radius = '30 mn'"),
        "balls[0].radius: expected a length in m, > 0, got '30 mn'; 'mn' is not a known unit",
    ),
    "number as text": (
        SOUND.replace("radius = 0.03", "radius = '0.03'"),
        "balls[0].radius: expected a length in m, > 0, got '0.03'; units are written as in '61.5 mm'",
    ),
    "turns or radians": (
        SOUND + "spin = [0, 0, '30 Hz']\n",
        "balls[0].spin[2]: expected a spin in rad/s, got '30 Hz'; 'Hz' may mean turns or radians per second;"
        " write rev/s or rad/s",
    ),
    "a unit where none is": (
        SOUND.replace("friction = 0.2", "friction = '1 m'", 1),
        "floor.friction: expected a number >= 0 (inf: never slips), got '1 m'",
    ),
    "nan": (SOUND.replace("[1, 0]", "[nan, 0]"), "balls[0].position[0]: expected a length in m, got nan"),
    "inf": (SOUND.replace("[1, 0]", "[inf, 0]"), "balls[0].position[0]: expected a length in m, got inf"),
    "huge": (SOUND.replace("0.03", "1e200"), "balls[0].radius: expected a length in m, > 0, at most 1e+100 in size, got 1e+200"),
    "huge whole number": (
        SOUND.replace("0.03", "1" + 400 * "0"),
        "balls[0].radius: expected a length in m, > 0, got 1" + 76 * "0" + "...",
    ),
    "negative radius": (SOUND.replace("0.03", "-0.03"), "balls[0].radius: expected a length in m, > 0, got -0.03"),
    "zero mass": (SOUND.replace("mass = 0.2", "mass = 0"), "balls[0].mass: expected a mass in kg, > 0, got 0"),
    "zero normal": (
        SOUND.replace("[1, 0, 0]", "[0, 0, 0]"),
        "walls[0].normal: expected a direction, not all zero, got [0.0, 0.0, 0.0]",
    ),
    "e > 1": (
        SOUND.replace("restitution = 0.8", "restitution = 1.5"),
        "walls[0].restitution: expected a number from 0 to 1, or a table { form = ... }, got 1.5",
    ),
    "negative friction": (
        SOUND.replace("friction = 0.2", "friction = -0.2", 1),
        "floor.friction: expected a number >= 0 (inf: never slips), got -0.2",
    ),
    "beta > 1": (
        SOUND.replace("restitution = 0.8", "restitution = 0.8\ntangential_restitution = 2"),
        "walls[0].tangential_restitution: expected a number from -1 to 1, got 2",
    ),
    "unknown form": (
        SOUND.replace("restitution = 0.8", "restitution = { form = 'han' }"),
        "walls[0].restitution.form: expected one of constant, polynomial, han-2005, power, viscoelastic, exponential, got"
        " 'han'; did you mean 'han-2005'?",
    ),
    "a form's field": (
        SOUND.replace("restitution = 0.8", "restitution = { form = 'power', at_rest = 2, sped = 1 }"),
        "walls[0].restitution.at_rest: expected a number from 0 to 1, got 2",
        "walls[0].restitution.speed: expected a speed in m/s, > 0, got nothing",
        "walls[0].restitution.sped: expected a field that is known here, got 'sped'; did you mean 'speed'?",
    ),
    "inertia": (
        SOUND + "inertia = 'sold'\n",
        "balls[0].inertia: expected 'solid', 'hollow', or kappa = I/(m a^2) in (0, 2/3], got 'sold'; did you mean 'solid'?",
    ),
    "kappa": (
        SOUND + "inertia = 0.7\n", "balls[0].inertia: expected 'solid', 'hollow', or kappa = I/(m a^2) in (0, 2/3], got 0.7",
    ),
    "two spins": (
        SOUND + "rolling = true\nspin = [0, 0, 1]\n",
        "balls[0].spin: expected no spin with rolling = true, got [0.0, 0.0, 1.0]; the spin of a ball that rolls follows from"
        " its velocity, except for spin_z; leave out rolling, or spin",
    ),
    "side without rolling": (
        SOUND + "spin_z = 3\n",
        "balls[0].spin_z: expected no spin_z without rolling = true, got 3.0; give spin = [x, y, z]",
    ),
    "rolling upwards": (
        SOUND + "rolling = true\nvelocity = [1, 0, 1]\n",
        "balls[0].velocity[2]: expected no speed along z with rolling = true, got 1.0",
    ),
    "rolling in the air": (
        SOUND.replace("[1, 0]", "[1, 0, 1]") + "rolling = true\n",
        "balls[0].position[2]: expected z = radius = 0.03, got 1 of a ball that rolls; leave out z, or rolling",
    ),
    "rolling on nothing": (
        PLANE + BALL + "rolling = true\n", "balls[0].rolling: expected a floor to roll on, got true in a scene without one",
    ),
    "no balls": (
        FLOOR + PLANE, "balls: expected at least one ball, got none; a file has a table [[balls]] for each",
    ),
    "in the floor": (
        SOUND.replace("[1, 0]", "[1, 0, 0.02]"),
        "balls[0].position[2]: expected z of at least the radius, 0.03, got 0.02, which overlaps the floor by 10 mm; leave out"
        " z to put it on the floor",
    ),
    "in a wall": (
        SOUND.replace("[1, 0]", "[0.01, 0]"),
        f"balls[0].position: {FREE} (0.01, 0, 0.03), which overlaps walls[0] (plane 0) by 20 mm at (0, 0, 0.03); move it by"
        " 20 mm or more",
    ),
    "in a post": (
        SOUND.replace("shape = 'plane'\npoint = [0, 0, 0]\nnormal = [1, 0, 0]", "name = 'rail'\nshape = 'segment'\n"
                      "start = [1.02, 0]\nend = [2, 0]"),
        f"balls[0].position: {FREE} (1, 0, 0.03), which overlaps walls[0] (rail) by 10 mm at (1.02, 0, 0.03); move it by 10 mm"
        " or more",
    ),
    "on a thin wall": (
        SOUND.replace("shape = 'plane'\npoint = [0, 0, 0]\nnormal = [1, 0, 0]", "shape = 'segment'\nstart = [1, -1]\nend = [1, 1]"),
        f"balls[0].position: {FREE} (1, 0, 0.03), which overlaps walls[0] (segment 0) by 30 mm at (1, 0, 0.03); move it by"
        " 30 mm or more",
    ),
    "in another ball": (
        SOUND + BALL.replace("[1, 0]", "[1, 0.05]"),
        f"balls[1].position: {FREE} (1, 0.05, 0.03), which overlaps balls[0] by 10 mm; move it by 10 mm or more",
    ),
    "behind a wall": (
        SOUND.replace("[1, 0]", "[-1, 0]"),
        "balls[0].position: expected a place on the free side of walls[0] (plane 0), got (-1, 0, 0.03), where no ball can"
        " be; move the ball; or turn the normal round",
    ),
    "out of the tube": (
        SOUND.replace("shape = 'plane'\npoint = [0, 0, 0]\nnormal = [1, 0, 0]", "shape = 'cylinder'\npoint = [0, 0, 0]\n"
                      "radius = 0.5\ninside = true"),
        "balls[0].position: expected a place on the free side of walls[0] (cylinder 0), got (1, 0, 0.03), where no ball"
        " can be; move the ball",
    ),
    "too small a tube": (
        SOUND.replace("shape = 'plane'\npoint = [0, 0, 0]\nnormal = [1, 0, 0]", "shape = 'cylinder'\npoint = [1, 0, 0]\n"
                      "radius = '3 cm'\ninside = true"),
        "walls[0]: expected room for a ball of radius 30 mm (balls[0]), got room for radii below 30 mm; make the wall larger,"
        " or the ball smaller",
    ),
    "tilted floor": (
        "gravity = [1, 0, -9.8]\n" + SOUND,
        "gravity: expected gravity along -z, as there is a floor, got (1, 0, -9.8); for a tilted floor give"
        " floor.slope, such as [0.001, 0] for a fall of 1 mm per metre along x",
    ),
    "gravity upwards": (
        "gravity = -9.8\n" + SOUND, "gravity: expected gravity along -z, as there is a floor, got (0, 0, 9.8)",
    ),
    "law misspelt": (
        SOUND + "[run]\nlaw = 'two-stp'\n",
        f"run.law: {LAW}, got 'two-stp'; did you mean"
        " 'two-step'?",
    ),
    "a wall's law misspelt": (
        SOUND.replace("friction = 0.2\n[[b", "friction = 0.2\nlaw = 'miror'\n[[b"),
        f"walls[0].law: {LAW}, got 'miror'; did you mean"
        " 'mirror'?",
    ),
    "conventional, tilted": (
        SOUND.replace("[1, 0, 0]", "[1, 0, 1]").replace("restitution = 0.8\n", "") + "[run]\nlaw = 'conventional'\n",
        "walls[0]: expected hypothesis 1: a vertical wall (any other lifts the ball or presses it down), for the law conventional,"
        " got a plane that meets a ball above or below its centre",
    ),
    "conventional, lossy": (
        SOUND + "[run]\nlaw = 'conventional'\n",
        "walls[0].restitution: expected hypothesis 3: a wall of restitution 1 (with less, energy would have to be created),"
        " for the law conventional, got 0.8",
    ),
    "conventional, no floor": (
        PLANE.replace("restitution = 0.8\n", "") + BALL + "[run]\nlaw = 'conventional'\n",
        "run.law: expected hypothesis 1: a ball that rolls on the floor without sliding, for the law conventional, got a scene"
        " without a floor",
    ),
    "duration": (SOUND + "[run]\nduration = 0\n", "run.duration: expected a time in s, > 0, got 0"),
    "max_events": (SOUND + "[run]\nmax_events = 1.5\n", "run.max_events: expected a whole number >= 1, got 1.5"),
    "floor contact": (
        SOUND + "[run]\nfloor_contact = 'before'\n", "run.floor_contact: expected 'with' or 'after', got 'before'",
    ),
    "several at once": (
        "gravity = 'x'\n" + SOUND.replace("0.03", "-1").replace("0.8", "8") + "[run]\nlaw = 3\n",
        "gravity: expected an acceleration in m/s^2, or 3 of them, got 'x'; units are written as in '9.81 m/s^2'",
        "walls[0].restitution: expected a number from 0 to 1, or a table { form = ... }, got 8",
        "balls[0].radius: expected a length in m, > 0, got -1",
        f"run.law: {LAW}, got 3; carom.wall_law(card,"
        " function) makes a law of a function",
    ),
    "several of the whole": (
        "gravity = [0, 1, -1]\n" + SOUND.replace("[1, 0]", "[-1, 0, 0]") + BALL.replace("[1, 0]", "[-1, 0]"),
        "gravity: expected gravity along -z, as there is a floor, got (0, 1, -1); for a tilted floor give"
        " floor.slope, such as [0.001, 0] for a fall of 1 mm per metre along x",
        "balls[0].position[2]: expected z of at least the radius, 0.03, got 0, which overlaps the floor by 30 mm; leave out z"
        " to put it on the floor",
        "balls[0].position: expected a place on the free side of walls[0] (plane 0), got (-1, 0, 0), where no ball can be;"
        " move the ball; or turn the normal round",
        "balls[1].position: expected a place on the free side of walls[0] (plane 0), got (-1, 0, 0.03), where no ball can"
        " be; move the ball; or turn the normal round",
        f"balls[1].position: {FREE} (-1, 0, 0.03), which overlaps balls[0] by 30 mm; move it by 30 mm or more",
    ),
}  # fmt: skip


@pytest.mark.parametrize("name", WRONG)
def test_every_fault_is_one_line(name: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    text, *lines = WRONG[name]
    file = tmp_path / "s.toml"
    file.write_text(text)
    assert fails(capsys, "scene", "check", str(file)) == [f"carom: {file}: {line}" for line in lines]


def test_the_sound_one_is_sound(tmp_path: Path) -> None:
    """What the faults are made from has none: whatever is told of them is the change."""
    load(tmp_path, SOUND)


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("x = 1\ny 2\n", "line 2: expected TOML, got 'y 2'; Expected '=' after a key in a key/value pair"),
        ("x = [1,\n", "line 1: expected TOML, got 'x = [1,'; Invalid value"),
        ("a = 1\na = 2\n", "line 2: expected TOML, got 'a = 2'; Cannot overwrite a value"),
    ],
)
def test_text_that_is_no_toml(text: str, said: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    file = tmp_path / "s.toml"
    file.write_text(text)
    assert fails(capsys, "scene", "check", str(file)) == [f"carom: {file}: {said}"]


def test_files_that_are_none(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    file = tmp_path / "none.toml"
    said = f"carom: {file}: expected a scene file, got: No such file or directory; carom scene new {file} writes one"
    assert fails(capsys, "scene", "check", str(file)) == [said]
    said = f"carom: {tmp_path}: expected a scene file, got a folder"
    assert fails(capsys, "scene", "check", str(tmp_path)) == [f"{said}; name a file; it has none that ends with .toml"]
    file.touch()
    assert fails(capsys, "scene", "check", str(tmp_path)) == [f"{said}; name a file in it: {file}"]
    file.write_bytes(b"name = '\xff'")
    assert fails(capsys, "scene", "check", str(file)) == [f"carom: {file}: expected text in UTF-8, got byte 0xff"]


def test_a_law_file_that_is_none(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    file, law = tmp_path / "s.toml", tmp_path / "own.py"
    file.write_text(SOUND + "[run]\nlaw = 'own.py:soft'\n")
    expected = f"carom: {file}: run.law: expected a law in a Python file, got"
    check = ("scene", "check", str(file), "--allow-own-laws")
    assert fails(capsys, *check) == [f"{expected} '{law}:soft': expected a Python file, got: No such file or directory"]
    law.write_text("def sift(v, w, n, a, kappa, e, mu, beta):\n    return v, w\n")
    assert fails(capsys, *check) == [
        f"{expected} '{law}:soft': expected 'soft' in the file, got no such name; did you mean 'sift'?"
    ]


def test_what_touches_does_not_overlap() -> None:
    touching = SceneBall(radius=0.1, mass=1, position=(0.1, 0, 0.1))
    Scene(
        floor=Floor(friction=0),
        walls=[Plane(point=(0, 0, 0), normal=(1, 0, 0), restitution=1, friction=0)],
        balls=[touching, SceneBall(radius=0.1, mass=1, position=(0.3, 0, 0.1))],
    )


def test_overlaps_are_found_among_many() -> None:
    rng = np.random.default_rng(3)
    x, a = rng.uniform(0, 1, (300, 3)), rng.uniform(0.005, 0.04, 300)
    gaps = np.linalg.norm(x[:, None] - x[None], axis=-1) - a[:, None] - a[None]
    pairs = [(i, k) for i in range(300) for k in range(i + 1, 300) if gaps[i, k] < 0]
    assert len(pairs) > 10
    balls = [SceneBall(radius=r, mass=1, position=p) for r, p in zip(a, x, strict=True)]
    with pytest.raises(carom.CaromError) as error:
        Scene(balls=balls)
    told = [
        line.split(": ")[1].split(".")[0] + " " + line.split("overlaps ")[1].split(" by")[0]
        for line in error.value.faults
    ]
    assert told == [f"balls[{k}] balls[{i}]" for i, k in pairs]


def test_a_conventional_wall_is_looked_at_where_balls_meet_it() -> None:
    balls = [SceneBall(radius=0.03, mass=1, position=(0.5, 0))]

    def made(**wall: object) -> Scene:
        return Scene(floor=Floor(friction=1), walls=[wall], balls=balls, run=Run(law="conventional"))

    made(shape="table", length=2, width=1, nose_height=0.03)
    made(shape="cylinder", point=(0, 0, 0), radius=0.1)
    made(shape="segment", start=(0, 0), end=(0, 1), height=0.03)
    made(shape="box", center=(0, 0, 0), size=(0.1, 0.1, 1))
    for wall in (
        {"shape": "table", "length": 2, "width": 1, "nose_height": 0.031},
        {"shape": "segment", "start": (0, 0), "end": (0, 1), "height": 0.02},
        {"shape": "cylinder", "point": (0, 0, 0), "radius": 0.1, "axis": (0, 1, 5)},
        {"shape": "sphere", "center": (0, 0, 0), "radius": 0.1},
        {"shape": "box", "center": (0, 0, 0), "size": (0.1, 0.1, 0.04)},
    ):
        with pytest.raises(carom.CaromError, match="a vertical wall"):
            made(**wall)


def test_a_ball_does_not_roll_under_a_tables_nose() -> None:
    balls = [SceneBall(radius=a, mass=1, position=(x, 0)) for a, x in ((0.03, 0.5), (0.02, 0.2))]
    surface = {"restitution": 0.9, "friction": 0.2}

    def made(nose: float) -> Scene:
        wall = {"shape": "table", "length": 2, "width": 1, "nose_height": nose, **surface}
        return Scene(floor=Floor(friction=1), walls=[wall], balls=balls, run=Run(duration=1))

    made(0.0399)
    with pytest.raises(carom.CaromError) as error:
        made(0.04)
    assert error.value.faults == (
        "Scene: walls[0].nose_height: expected less than 40 mm, the diameter of balls[1], which would roll under it, got 0.04;"
        " a cushion's nose stands at 5/4 to 7/5 of the radius",
    )


def test_faults_in_python_name_the_class_and_the_parts() -> None:
    with pytest.raises(carom.CaromError) as error:
        Scene(walls=[{"shape": "cylinder", "radius": -1}], balls=[{"radius": 1}])
    assert error.value.faults == (
        "Scene: walls[0].point: expected 3 lengths in m: x, y, z, got nothing",
        "Scene: walls[0].radius: expected a length in m, > 0, got -1",
        "Scene: balls[0].mass: expected a mass in kg, > 0, got nothing",
        "Scene: balls[0].position: expected 2 or 3 lengths in m: x, y and z, of the centre, got nothing",
    )
    with pytest.raises(carom.CaromError, match=r"^Cylinder: radius: expected a length in m, > 0, got -1$"):
        Cylinder(point=(0, 0, 0), radius=-1)


# --- the command --------------------------------------------------------------------------------------------------


def test_new_writes_and_check_says_what_it_is(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    runner, file = CliRunner(), tmp_path / "s.toml"
    assert runner.invoke(app, ["scene", "new"]).stdout == scene_text()
    result = runner.invoke(app, ["scene", "new", str(file)])
    assert (result.exit_code, result.stdout) == (0, "")
    assert file.read_text() == scene_text()
    assert result.stderr == f"written: {file}\n"
    file.write_bytes(b"\xef\xbb\xbf" + scene_text().replace("\n", "\r\n").encode())  # as Notepad saves it
    result = runner.invoke(app, ["scene", "check", str(file)])
    assert result.exit_code == 0
    assert result.stdout == (
        f"{file}: a floor, a table of 2.84 m by 1.42 m, cushion noses at 37 mm, 1 ball, law two-step, 20 s: ok\n"
    )
    file.write_text("mine")
    assert fails(capsys, "scene", "new", str(file)) == [
        f"carom: {file}: expected a new file, got one that exists; --force overwrites it"
    ]
    assert file.read_text() == "mine"
    assert runner.invoke(app, ["scene", "new", "--force", str(file)]).exit_code == 0
    assert file.read_text() == scene_text()
    nowhere = tmp_path / "none" / "s.toml"
    assert fails(capsys, "scene", "new", str(nowhere)) == [
        f"carom: {nowhere}: expected a folder that exists, got: No such file or directory; make it first"
    ]


def test_check_prints_the_scene_in_full_as_json(tmp_path: Path) -> None:
    file = tmp_path / "s.toml"
    file.write_text("""
gravity = 9.8
[floor]
friction = inf
[[walls]]
shape = "cylinder"
point = [0, 0, 0]
radius = "500 mm"
inside = true
restitution = { form = "power", at_rest = 0.9, speed = "20 cm/s" }
friction = 0.2
[[balls]]
radius = "30 mm"
mass = 0.2
position = [0.1, 0.2]
velocity = [1, 2]
rolling = true
[[balls]]
radius = "30 mm"
mass = 0.2
inertia = "hollow"
position = [-0.1, 0.2, 0.3]
""")
    result = CliRunner().invoke(app, ["scene", "check", str(file), "--json"])
    assert result.exit_code == 0, result.stderr
    assert json.loads(result.stdout) == {
        "gravity": [0.0, 0.0, -9.8],
        "floor": {"restitution": {"form": "constant", "value": 0.0}, "friction": "inf", "tangential_restitution": 0.0,
                  "rolling_resistance": 0.0, "spin_friction": 0.0, "rolling_drag": 0.0, "spin_damping": 0.0, "spin_drag": 0.0,
                  "slope": [0.0, 0.0]},
        "walls": [
            {"shape": "cylinder", "point": [0.0, 0.0, 0.0], "axis": [0.0, 0.0, 1.0], "radius": 0.5, "inside": True,
             "height": "inf", "restitution": {"form": "power", "at_rest": 0.9, "speed": 0.2, "exponent": 0.25},
             "friction": 0.2, "tangential_restitution": 0.0, "stiffness_ratio": 14 / 17,
             "contact_time": 3e-4, "yield_time": 0.0, "law": None, "name": None},
        ],
        "balls": [
            {"radius": 0.03, "mass": 0.2, "inertia": 0.4, "position": [0.1, 0.2, 0.03], "velocity": [1.0, 2.0, 0.0],
             "rolling": True, "spin": None, "spin_z": 0.0, "name": None},
            {"radius": 0.03, "mass": 0.2, "inertia": 2 / 3, "position": [-0.1, 0.2, 0.3], "velocity": [0.0, 0.0, 0.0],
             "rolling": False, "spin": [0.0, 0.0, 0.0], "spin_z": None, "name": None},
        ],
        "ball_contact": {"restitution": {"form": "constant", "value": 1.0}, "friction": 0.0, "tangential_restitution": 0.0,
                         "law": "contact", "stiffness_ratio": None, "young": 5.84e9, "poisson": 0.34, "overlap": True},
        "run": {"law": "two-step", "duration": None, "max_events": None, "floor_contact": "with"},
    }  # fmt: skip
    gas = tmp_path / "gas.toml"
    gas.write_text(gas_text())
    result = CliRunner().invoke(app, ["scene", "check", str(gas), "--json"])
    assert result.exit_code == 0, result.stderr
    assert {"container", "species", "run"} <= set(json.loads(result.stdout))


def test_what_reads_no_scene_does_not_load_what_reads_scenes() -> None:
    code = (
        "import sys, json; import carom.core.geometry.features;"
        "print(json.dumps([m in sys.modules for m in ('pydantic', 'pint')]));"
        "import carom.scene as s; s.Plane(point=(0, 0, 0), normal=(1, 0, 0)); print(json.dumps('pint' in sys.modules))"
    )
    out = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True).stdout.splitlines()
    assert [json.loads(line) for line in out] == [[False, False], False]


def test_a_motion_whose_square_is_no_float_is_refused(tmp_path: Path) -> None:
    text = EXAMPLE.replace("velocity = [-2.0, 1.0]", "velocity = [-2e-161, 1e-161]").replace(
        "mass = 0.21", "mass = 1e-320"
    )
    with pytest.raises(carom.CaromError) as error:
        load(tmp_path, text)
    assert len(error.value.faults) == 1
    assert "mass: expected a mass in kg, > 0, at least 1e-100 in size, got 1e-320" in error.value.faults[0]
    with pytest.raises(
        carom.CaromError,
        match="velocity: expected a ball at rest, or a component of velocity or spin of at least 1e-100",
    ):
        load(tmp_path, text.replace("1e-320", "0.21"))


def test_laws_of_a_scene_are_listed_in_one_place():
    """The template and the page name the command that lists them, and no list of their own."""
    root = Path(carom.__file__).parent
    places = {
        root / "scene" / "new.toml": 'law = "two-step"',
        root.parents[1] / "docs/howto/scene.md": '| `law` | `"two-step"` |',
    }
    for path, begin in places.items():
        if not path.exists():  # (installed without the docs)
            continue
        (line,) = (line for line in path.read_text(encoding="utf-8").splitlines() if line.startswith(begin))
        assert "carom laws" in line
        assert not [name for name in carom.LAWS if name in line.removeprefix(begin)]
    assert all(carom.Run(law=name).law == name for name in carom.LAWS)


def test_no_two_balls_have_one_name():
    """A path, and a ball in a table, would be either; a number of its own is no other ball's name."""

    def named(*names):
        balls = [SceneBall(radius=0.03, mass=0.2, position=(0.1 * i, 0, 0), name=name) for i, name in enumerate(names)]
        return Scene(gravity=0, balls=balls)

    with pytest.raises(carom.CaromError, match=r"^Scene: balls\[2\].name: expected a name that no other ball has, got 'red', as"
                       r" balls\[0\] is called$"):  # fmt: skip
        named("red", "white", "red")
    with pytest.raises(carom.CaromError, match=r"balls\[0\].name: .*got 'ball 1', as balls\[1\] is called"):
        named("ball 1", None)
    assert named("1", "0", None, "9").ball_names == (
        "1",
        "0",
        "ball 2",
        "9",
    )  # (of a rack: a name goes before a number)


def test_the_modulus_of_the_balls_has_units(tmp_path: Path) -> None:
    text = "[[balls]]\nradius = 0.03\nmass = 0.2\nposition = [0, 0, 0.03]\n[ball_contact]\nyoung = {}\n"
    assert load(tmp_path, text.format('"5.84 GPa"')).ball_contact.young == 5.84e9
    with pytest.raises(
        carom.CaromError,
        match=r"young: expected Young's modulus in Pa, > 0, got '5 m'",
    ):
        load(tmp_path, text.format('"5 m"'))
