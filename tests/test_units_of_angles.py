"""Angles: attributes, arguments and columns whose name ends in _deg are degrees, all others radians."""

from __future__ import annotations

import ast
import inspect
import math
import re
from collections.abc import Iterator

import numpy as np
import pytest
from reference.public_names import public_classes, public_functions

import carom
from carom import scene
from carom.fitting.design import Shots

NAMED = re.compile(r"(^|_)(angles?|azimuth|elevation|incidence|squirt|opening|span)(_|$)")
# Fields of scenes, sweeps and tables: a number without a unit is in degrees, as in their files, and a text names its unit
# ("0.5 rad"); they are the names of the files and of the paths to their numbers, from which a sweep draws.
FIELDS = {
    ("CueStrike", "azimuth"), ("CueStrike", "elevation"), ("Wedge", "from_angle"), ("Wedge", "to_angle"), ("Arc", "from_angle"),
    ("Arc", "to_angle"), ("StadiumWall", "angle"), ("Pockets", "jaw_angle"), ("ImpactCase", "angle"), ("OrbitCase", "angle"),
}  # fmt: skip
SEVERAL = {
    ("Aim", "values"),
    ("Wedge", "axis"),
    ("ImpactCase", "speed"),
}  # numbers of several units, by the names of fields


def documented(cls: type) -> Iterator[tuple[str, str]]:
    """Names of attributes of a class, each with the words that describe it."""
    for base in cls.__mro__:
        if not base.__module__.startswith("carom."):
            continue
        try:
            source = inspect.getsource(base)
        except OSError:  # a wall that is made of a figure has no source of its own
            continue
        body = ast.parse(inspect.cleandoc("\n" + source)).body[0]
        assert isinstance(body, ast.ClassDef)
        lines = (ast.get_docstring(body) or "").splitlines()
        for k, node in enumerate(body.body):
            if isinstance(node, ast.AnnAssign) and isinstance(node.target, ast.Name):
                after = body.body[k + 1] if k + 1 < len(body.body) else None
                own = after.value.value if isinstance(after, ast.Expr) and isinstance(after.value, ast.Constant) else ""
                above = " ".join(
                    line for line in lines if re.search(rf"\b{node.target.id}\b", line.partition(" : ")[0])
                )
                yield node.target.id, f"{own} {above}"
            elif isinstance(node, ast.FunctionDef) and "property" in ast.dump(
                node.decorator_list[0] if node.decorator_list else node
            ):
                yield node.name, ast.get_docstring(node) or ""


def test_attributes_in_degrees_say_so_in_their_names() -> None:
    wrong, seen = [], 0
    for cls in set(public_classes()) - {carom.derive.ImpulsiveMotion}:
        for name, words in documented(cls):
            if (cls.__name__, name) in FIELDS:
                continue
            degrees = "degrees" in words.lower().replace("degrees of freedom", "")
            if NAMED.search(name):
                seen += 1
                if name.endswith("_deg") == bool(re.search(r"\brad\b", words)):
                    wrong.append(f"{cls.__name__}.{name}: {words}")
            if degrees and not name.endswith("_deg") and (cls.__name__, name) not in SEVERAL:
                wrong.append(f"{cls.__name__}.{name}: {words}")
    assert not wrong, wrong
    assert seen > 10


def test_arguments_in_degrees_say_so_in_their_names() -> None:
    seen = set()
    for _name, function in public_functions():
        for name in inspect.signature(function).parameters:
            if NAMED.search(name):
                seen.add(f"{function.__name__}.{name}")
                text = re.search(
                    rf"^\s*[\w, ]*\b{name}\b[^\n]*(\n\s+[^\n]*)?", inspect.getdoc(function) or "", re.MULTILINE
                )
                said = text[0] if text else ""
                assert name.endswith("_deg") != bool(re.search(r"\brad\b|radians", said)), (function, name, said)
    assert {"incoming.angle_deg", "strike.azimuth_deg", "polar.angle_deg", "wedge.angle_deg"} <= seen


def test_fields_of_files_take_their_unit() -> None:
    one, two = (
        scene.Arc(center=(0, 0), radius=1, from_angle=0, to_angle=a, restitution=1, friction=0)
        for a in (90, "1.5707963267948966 rad")
    )
    assert one.span_deg == two.span_deg == 90


def test_results_are_in_these_units() -> None:
    hit = carom.two_step(carom.Ball(), carom.rolling(carom.Ball(), (-1.0, 1.0)))
    assert math.degrees(hit.reflection_angle) == pytest.approx(
        carom.compare()["two-step"].reflection_angle_deg, rel=1e-12
    )
    assert Shots().angles_deg == (5.0, 75.0)
    assert np.degrees(carom.billiards.orbit(carom.billiards.circle(), ((0, 0), (1, 0), 0), 2).angle).tolist() == [0, 0]
