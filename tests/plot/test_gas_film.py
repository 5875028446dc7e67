"""Films of gases: what they show is where the balls are."""

from __future__ import annotations

import re
from xml.etree import ElementTree

import numpy as np
import pytest
from reference.commands import command, fails

import carom
from carom.gas import GasScene, Session, gas_text
from carom.plot import animate_gas

CONTACT = {"between": ("*", "*"), "restitution": 0.9, "friction": 0.3}
FLOOR = {"wall": "bottom", "amplitude": 0.3, "frequency": 0.5}
SVG = "{http://www.w3.org/2000/svg}"


def shaken(**changes):
    return Session(
        GasScene(
            **{
                "gravity": 1.0, "container": {"shape": "box", "size": (8, 10), "periodic": ["x"], "plates": [(2, 5, 6, 6)]},
                "species": [{"count": 12, "radius": 0.5}], "contacts": [CONTACT], "drives": [FLOOR], "run": {"max_events": 100},
            }
            | changes
        )
    )  # fmt: skip


def test_a_picture_that_moves_has_the_places_of_the_balls_and_of_the_floor(tmp_path):
    session, again = shaken(), shaken()
    animate_gas(session, tmp_path / "gas.svg", frames=9, interval=0.25)
    assert session.gas.time == 0
    root = ElementTree.parse(tmp_path / "gas.svg").getroot()
    balls = root.find(f".//{SVG}g[@id='balls']")
    assert len(balls) == 12
    scale = 1000 / max(10 + 0.3 + 0.08, 8.08)
    for k in (0, 4, 8):
        again.gas.advance(until=0.25 * k) if k else None
        x = again.gas.balls().position[:, :2]
        for i, ball in enumerate(balls):
            moves = ball.find(f"{SVG}animateTransform[@type='translate']")
            values = moves.get("values").split(";")
            keys = moves.get("keyTimes")
            keys = [float(t) for t in keys.split(";")] if keys else [t / 8 for t in range(9)]
            at = len(keys) - 1 - keys[::-1].index(k / 8)  # (the last of two at a jump)
            assert np.array(values[at].split(","), float) == pytest.approx(x[i] * scale, abs=1.0)
    line = next(one for one in root.iter(f"{SVG}animateTransform") if one.get("values").startswith("0,"))
    lifts = [float(one.split(",")[1]) for one in line.get("values").split(";")]
    # (the floor moves on parabolas: furthest into the gas after a quarter of its period of 2)
    assert lifts[2] == pytest.approx(0.3 * scale, abs=1)
    assert lifts[4] == pytest.approx(0, abs=1)
    assert lifts[6] == pytest.approx(-0.3 * scale, abs=1)


def test_films_in_pixels_have_their_frames_of_discs_and_spheres(tmp_path):
    from PIL import Image

    path = animate_gas(shaken(), tmp_path / "discs.gif", frames=5)
    with Image.open(path) as film:
        assert film.n_frames == 5
    spheres = shaken(container={"shape": "periodic", "size": (6, 6, 6)}, gravity=0.0, drives=[])
    with Image.open(animate_gas(spheres, tmp_path / "spheres.gif", frames=3)) as film:
        assert film.n_frames == 3


def test_what_is_wrong_is_one_line(tmp_path):
    spheres = shaken(container={"shape": "periodic", "size": (6, 6, 6)}, gravity=0.0, drives=[])
    for session, name, options, said in (
        (spheres, "a.svg", {}, "animate_gas: path: expected .gif or .mp4 for spheres"),
        (shaken(), "a.svg", {"frames": 1}, "animate_gas: frames: expected a whole number from 2 to"),
        (shaken(), "a.gif", {"fps": 80}, "animate_gas: fps: expected a number > 0, at most 50, got 80"),
        (shaken(), "a.gif", {"interval": -1.0}, "animate_gas: interval: expected a number > 0, got -1.0"),
        (shaken(), "a.pdf", {}, r"a.pdf: expected .*\.svg, \.gif"),
    ):
        with pytest.raises(carom.CaromError, match=said) as error:
            animate_gas(session, tmp_path / name, **options)
        assert len(error.value.faults) == 1
    assert not list(tmp_path.iterdir())


def test_the_command_writes_a_film(tmp_path, capsys):
    (tmp_path / "gas.toml").write_text(gas_text(shaken().scene), encoding="utf-8")
    code, _out, err = command(capsys, "gas", str(tmp_path / "gas.toml"), "--animate", str(tmp_path / "gas.svg"))
    assert (code, "written: " in err) == (0, True)
    assert len(re.findall("<circle", (tmp_path / "gas.svg").read_text())) == 12
    (line,) = fails(capsys, "gas", str(tmp_path / "gas.toml"), "--animate", str(tmp_path / "gas.html"))
    assert line.startswith("carom: --animate ")
    (line,) = fails(capsys, "gas", str(tmp_path / "gas.toml"), "--animate", str(tmp_path / "a.svg"), "--ensemble", "2")
    assert "--animate: expected none with --ensemble" in line
