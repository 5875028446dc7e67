"""Figures with smooth curves: closed forms of areas and lengths, formulas and functions, splines, hostile texts."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from scipy.special import ellipe, gamma

import carom
from carom import billiards
from carom.scene.figures import figure

AREAS = {
    "limacon:eps=0.3,radius=2": 4 * math.pi * (1 + 0.3**2 / 2),
    "oval:eps=0.1,radius=1": math.pi * (1 + 0.1**2 / 2),
    "flower:leaves=5,eps=0.2,radius=1": math.pi * (1 + 0.2**2 / 2),
    "superellipse:half_axes=1,0.8,power=4": 4 * 0.8 * gamma(1.25) ** 2 / gamma(1.5),
    "superellipse:half_axes=1,0.8,power=3": 4 * 0.8 * gamma(4 / 3) ** 2 / gamma(5 / 3),
    "lemon:radius=1,distance=1": 2 * math.pi / 3 - math.sqrt(3) / 2,
    "mushroom:radius=1,stem=0.5,0.8": math.pi / 2 + 0.4,
    "squash:radii=1,0.5,distance=1": math.sin(math.pi / 3) * 1.5 + math.pi * 2 / 3 + math.pi / 3 * 0.25,
    "curve:r=1 + 0.1*cos(3*theta)": math.pi * (1 + 0.1**2 / 2),
    "curve:x=sin(s),y=0.8*cos(s)": 0.8 * math.pi,
}


@pytest.mark.parametrize("text", AREAS)
@pytest.mark.slow(keep=2)
def test_areas_are_those_of_closed_forms(text: str) -> None:
    made = figure(text)
    assert made.area == pytest.approx(AREAS[text], rel=1e-9)  # type: ignore[attr-defined]
    table = billiards.table(text)
    shape = table.wall()
    assert shape.lengths.sum() == pytest.approx(made.length, rel=1e-9)  # type: ignore[attr-defined]
    s = np.linspace(0, shape.lengths.sum(), 40_001)
    _k, x, n = shape.place(s[:-1])
    # the divergence theorem: the normals point inwards
    assert -(x * n).sum() * s[1] / 2 == pytest.approx(AREAS[text], rel=1e-4)


def test_an_ellipse_by_formulas_has_the_length_of_an_ellipse() -> None:
    assert billiards.table("curve", x="cos(s)", y="0.8*sin(s)").wall().lengths.sum() == pytest.approx(
        4 * ellipe(1 - 0.64), rel=1e-13
    )


def test_a_formula_and_a_function_are_the_same_curve() -> None:
    one = billiards.table("curve", r="1 + 0.2*cos(3*theta) - 0.1*sin(theta)**2")
    two = billiards.table("curve", r=lambda theta: 1 + 0.2 * np.cos(3 * theta) - 0.1 * np.sin(theta) ** 2)
    found = [billiards.orbit(t, ((0.1, 0.0), (1.0, 0.4), 0.3), 30).position for t in (one, two)]
    assert found[0] == pytest.approx(found[1], abs=1e-8)


def test_a_spline_goes_through_its_points_with_a_continuous_curvature() -> None:
    points = [(1.0, 0.0), (0.6, 0.7), (-0.5, 0.9), (-1.1, 0.1), (-0.2, -0.8), (0.7, -0.7)]
    table = billiards.table("curve", points=points)
    shape = table.wall()
    assert np.abs(shape.gap(np.array(points))).max() < 1e-14
    s = np.linspace(0, shape.lengths.sum(), 20_001)[:-1]
    k, x, _n = shape.place(s)
    assert np.abs(np.diff(shape.curvatures(k, x))).max() < 0.01
    assert (billiards.orbit(table, billiards.starts(table, 20, 1), 300).count == 300).all()
    # clockwise points are the same curve
    assert billiards.table("curve", points=points[::-1]).wall().lengths.sum() == pytest.approx(
        shape.lengths.sum(), rel=1e-9
    )


HOSTILE = {
    "__import__('os').system('touch ran')": "functions of one argument", "().__class__.__bases__[0]": "functions of one argument",
    "9**9**9": "finite values", "1/sin(theta)": "finite values", "theta": "a closed curve",
    "1 + 0.3*coz(theta)": "did you mean 'cos'",
    "1 + 0.3*cos(phi)": "theta, pi, e", "(" * 500 + "1" + ")" * 500: "a formula of theta", "-" * 300 + "1": "nested at most 60",
    "1+" * 1500 + "1": "at most 2,000 characters", "1 if theta else 2": "functions of one argument",
    "[1 for x in (1,)]": "functions",
    "lambda: 1": "functions of one argument", "cos(theta, 2)": "functions of one argument", "True": "functions of one argument",
    "1e999": "numbers below 1e308", "1e300": "lengths below 1e",
    "'1'": "functions of one argument", "open('ran', 'w')": "functions of one argument",
    "1\x00": "a formula of theta", "": "a formula of theta", "0.2 + cos(theta)": "does not meet itself",
    "1 + 0.3*abs(cos(theta))": "a continuous tangent", "1 + cos(theta)": "none near|cusp|does not meet",
    "1 + -1*cos(3*theta)": "none near",  # (a node of the scan lies in the cusp)
}  # fmt: skip


@pytest.mark.parametrize("text", HOSTILE)
def test_a_hostile_formula_is_one_line(text: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    with pytest.raises(carom.CaromError, match=HOSTILE[text]) as caught:
        billiards.table({"shape": "curve", "r": text}).wall()
    assert len(str(caught.value).splitlines()) == 1
    assert not list(tmp_path.iterdir())


@pytest.mark.parametrize(
    ("sizes", "text"),
    [
        ({}, "r, or x and y, or points"), ({"x": "cos(s)"}, "r, or x and y, or points"),
        ({"r": 1, "points": [(0, 0)] * 4}, "r, or x"),
        ({"points": [(0, 0), (1, 0), (1, 0), (0, 1)]}, "points that differ"), ({"points": [(0, 0), (1, 0)]}, "4 or more points"),
        ({"r": math.cos}, "NumPy's functions"), ({"r": True}, "a formula of theta"),
    ],
)  # fmt: skip
def test_other_faults_are_one_line(sizes: Any, text: str) -> None:
    with pytest.raises(carom.CaromError, match=text) as caught:
        billiards.table("curve", **sizes).wall()
    assert len(str(caught.value).splitlines()) == 1


def test_the_command_takes_formulas(tmp_path: Path) -> None:
    file = tmp_path / "room.toml"
    file.write_text('shape = "curve"\nr = "1 + 0.1*cos(3*theta)"\n')
    found = [carom.orbit(what, 20, seed=1).position for what in (file, "curve:r=1 + 0.1*cos(3*theta)")]
    np.testing.assert_array_equal(*found)


def test_a_function_without_its_argument_is_said() -> None:
    with pytest.raises(carom.CaromError, match="expected cos of something, such as cos\\(theta\\), got cos alone"):
        figure("curve:r=1+0.1*cos")
