"""Opening a file runs no code: a scene that names a Python file as a law is refused, unless that is asked for."""

from __future__ import annotations

import ast
import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from pydantic import ValidationError
from reference.commands import command, fails

import carom
from carom.scene import Plane
from carom.scene.schema import Model

# (a law that leaves a trace when its file is run)
OWN = """
import pathlib
pathlib.Path(__file__).with_name("ran").touch()

def soft(v, w, n, a, kappa, e, mu, beta):
    u = v[0] * n[0] + v[1] * n[1] + v[2] * n[2]
    return (v[0] - 1.5 * u * n[0], v[1] - 1.5 * u * n[1], v[2] - 1.5 * u * n[2]), w
"""
BALL = {"radius": 0.1, "mass": 1.0, "position": (1.0, 0.0), "velocity": (-1.0, 0.0)}
PLANE = {"shape": "plane", "point": (0, 0, 0), "normal": (1, 0, 0)}
SCENE = """
gravity = 0
[[walls]]
shape = "plane"
point = [0, 0, 0]
normal = [1, 0, 0]
{wall}
[[balls]]
radius = 0.1
mass = 1
position = [1, 0]
velocity = [-1, 0]
[run]
max_events = 1
{run}
"""
NAMED = {
    "by the run": {"wall": "", "run": 'law = "own.py:soft"'},
    "by a wall": {"wall": 'law = "own.py:soft"', "run": ""},
}


def refused(lines: tuple[str, ...] | list[str], file: Path) -> bool:
    """Whether one line names the law's file, and the way to allow it, in Python or on the command line."""
    words = (str(file), "own.py:soft", "opening a file runs no code")
    allowed = any(word in lines[0] for word in ("--allow-own-laws", "`allow_own_laws=True`"))
    return len(lines) == 1 and allowed and all(word in lines[0] for word in words)


@pytest.fixture(params=[*NAMED])
def scene(request: pytest.FixtureRequest, tmp_path: Path) -> Path:
    """A scene file with a law beside it."""
    (tmp_path / "own.py").write_text(OWN)
    file = tmp_path / "scene.toml"
    file.write_text(SCENE.format(**NAMED[request.param]))
    return file


def test_a_scene_file_runs_no_code(scene: Path) -> None:
    with pytest.raises(carom.CaromError) as caught:
        carom.load_scene(scene)
    assert refused(caught.value.faults, scene)
    assert not (scene.parent / "ran").exists()
    assert carom.load_scene(scene, allow_own_laws=True).laws[0].name == "soft"
    assert (scene.parent / "ran").exists()


@pytest.mark.parametrize("verb", [("scene", "check"), ("simulate",), ("simulate", "--law", "mirror")])
def test_no_verb_runs_code_unasked(scene: Path, verb: tuple[str, ...], capsys: pytest.CaptureFixture[str]) -> None:
    assert refused([fault.removeprefix("carom: ") for fault in fails(capsys, *verb, str(scene))], scene)
    assert not (scene.parent / "ran").exists()
    code, out, _err = command(capsys, *verb, str(scene), "--allow-own-laws")
    assert code == 0
    assert out
    assert (scene.parent / "ran").exists()


def test_a_law_that_is_typed_is_asked_for(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (tmp_path / "own.py").write_text(OWN)
    file = tmp_path / "scene.toml"
    file.write_text(SCENE.format(wall="restitution = 1\nfriction = 0", run=""))
    code, out, _err = command(capsys, "simulate", str(file), "--law", f"{tmp_path / 'own.py'}:soft", "--json")
    assert code == 0
    assert json.loads(out)["events"][0]["velocity"] == [0.5, 0.0, 0.0]
    law = f"{tmp_path / 'own.py'}:soft"
    assert Plane(**PLANE, law=law).law == law
    in_python = carom.Scene(walls=[PLANE | {"law": law}], balls=[BALL], run={"law": law, "max_events": 1})
    assert [one.name for one in in_python.laws] == ["soft"]


def test_a_saved_run_runs_no_code(scene: Path) -> None:
    pytest.importorskip("pyarrow")
    run = carom.simulate(carom.load_scene(scene, allow_own_laws=True))
    file = run.save(scene.parent / "run.parquet")
    (scene.parent / "ran").unlink()
    with pytest.raises(carom.CaromError) as caught:
        carom.load_trajectory(file)
    assert refused(caught.value.faults, file)
    assert not (scene.parent / "ran").exists()
    assert carom.load_trajectory(file, allow_own_laws=True).log.tobytes() == run.log.tobytes()


@pytest.mark.parametrize(
    "law", ["own.py:soft", "own.py", "./own.py:soft", "/own.py:soft", "own.py:soft:soft", "a:own.py"]
)
@pytest.mark.parametrize(
    "read", [carom.Scene.model_validate, lambda table: carom.Scene.model_validate_json(json.dumps(table))]
)
def test_what_is_not_made_in_python_is_refused_by_default(
    law: str, read: Callable[[Any], Any], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Whoever reads a scene from somewhere else, at some later time, has to say that it may run code."""
    monkeypatch.chdir(tmp_path)
    (tmp_path / "own.py").write_text(OWN)
    with pytest.raises(ValidationError, match="runs no code"):
        read({"walls": [PLANE], "balls": [BALL], "run": {"law": law}})
    assert not (tmp_path / "ran").exists()


@pytest.mark.slow
def test_one_gate_for_all_files() -> None:
    """No module but the schema's asks pydantic for a scene by itself."""
    names = {name for name in dir(Model) if name.startswith(("model_validate", "parse_", "model_construct"))}
    source = Path(carom.__file__).parent
    strange = [
        f"{path.relative_to(source)}:{node.lineno}"
        for path in source.rglob("*.py")
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8")))
        if isinstance(node, ast.Attribute) and node.attr in names and path.name != "schema.py"
    ]
    assert not strange
