"""No text out of a file runs Python code, whatever the file is and whoever reads it; what a user types does."""

from __future__ import annotations

import json
import re
from collections import Counter
from pathlib import Path

import numpy as np
import pytest
import tomli_w
from reference.commands import command, fails
from reference.laws_in_files import AS_IT_IS, EVIL, KINDS, LAW, SWEEPS, Case, cases, tried

import carom
from carom import billiards, sweeps
from carom.billiards.setup import law_of
from carom.laws.registry import find_law
from carom.public.own_laws import OwnLaw, with_own_laws
from carom.scene.schema import from_file

ROOT = Path(carom.__file__).parent
LAW_FIELDS = (
    "run.law",
    "walls.*.law",
    "scene.run.law",
    "impact.law",
    "orbit.law",
    "parameters.law",
    "parameters.run.law",
)


def few(kind: str) -> list[Case]:
    """The cases of a kind; of stores those of a law, of films and tables, which have no field for one, one or two."""
    found = list(cases(kind))
    if kind == "store":
        return [case for case in found if case.kind == "store of impact" and "law" in case.place]
    if kind == "sweep":
        return [case for case in found if case.kind not in ("sweep of gas", "sweep of impact along")]
    if kind in ("track", "rebounds", "states", "shot"):
        return [case for case in found if case.place.endswith(("a column law", AS_IT_IS))]
    return found


@pytest.fixture
def evil(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A law beside which tests run, and the mark that it leaves when it is run."""
    mark = tmp_path / "ran"
    (tmp_path / "evil.py").write_text(EVIL.format(mark=str(mark)))
    monkeypatch.chdir(tmp_path)
    return mark


def one_ball(**run: object) -> carom.Scene:
    """A ball that meets a wall."""
    wall = carom.scene.Plane(point=(0, 0, 0), normal=(1, 0, 0), restitution=1, friction=0)
    ball = carom.SceneBall(radius=0.1, mass=1, position=(1, 0), velocity=(-1, 0))
    return carom.Scene(walls=[wall], balls=[ball], run=carom.Run(max_events=1, **run))


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.slow(keep=3)
def test_no_file_runs_a_law(kind: str, tmp_path: Path) -> None:
    if kind == "store":
        pytest.importorskip("zarr")
    if kind == "run":
        pytest.importorskip("pyarrow")
    answers = Counter[str]()
    for i, case in enumerate(few(kind)):
        everyone = kind in ("scene", "sweep") and case.place in LAW_FIELDS
        for found in tried(case, tmp_path / "here", None if everyone else i):
            assert found.answer in ("answered", "refused"), found
            assert found.answer == "answered" or case.place != AS_IT_IS or kind == "track", found
            answers[found.answer] += 1
    assert answers["answered"]


@pytest.mark.parametrize("kind", ["scene", "impact", "orbit"])
def test_a_sweep_runs_a_law_where_that_is_allowed(kind: str, evil: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """The same check finds a law that is run; and the store that is made asks again."""
    pytest.importorskip("zarr")
    tree = SWEEPS[kind]
    name = "run.law" if kind == "scene" else "law"
    file = Path("sweep.toml")
    file.write_text(tomli_w.dumps(tree | {"parameters": {name: ["mirror", LAW]}}))
    for verb in ("explain", "run"):
        [line] = fails(capsys, "sweep", verb, str(file))
        assert "opening a file runs no code, got 'evil.py:law'" in line
    assert not evil.exists()
    assert sorted(path.name for path in Path().iterdir()) == ["evil.py", "sweep.toml"]
    made = sweeps.load_sweep(file, "sweep.zarr", allow_own_laws=True)
    assert made.own_laws
    assert not made.run()["failed"].any()
    assert evil.exists()
    evil.unlink()
    for verb in (("explain",), ("run",), ("status",), ("verify",), ("plot", "--out", "map.svg")):
        [line] = fails(capsys, "sweep", *verb, "sweep.zarr")
        assert "opening a file runs no code, got 'evil.py:law'" in line
    with pytest.raises(carom.CaromError, match="runs no code"):
        carom.sweep("sweep.zarr")
    assert not evil.exists()
    code, _out, _err = command(capsys, "sweep", "verify", "sweep.zarr", "--allow-own-laws")
    assert code == 0
    assert evil.exists()


def test_what_is_typed_in_python_is_run(evil: Path) -> None:
    scene = one_ball()
    for law in (carom.replaced(scene, {"run.law": LAW}).run.law, carom.Run(law=LAW).law, scene.model_copy().run.law):
        assert isinstance(law, OwnLaw) == (law == LAW)
    assert carom.simulate(scene, law=LAW).scene.laws[0].name == "law"
    assert billiards.orbit(billiards.circle(), ((0.2, 0.1), (0.8, 0.3), 0.5), bounces=2, law=LAW).count == 2
    for values in ([LAW, "mirror"], np.array([LAW, "mirror"]), sweeps.along("rule", [LAW, "mirror"])):
        space = carom.Space(scene, {"run.law": values})
        assert space.has_own_laws
        assert list(space.columns(0, 1)["run.law"]) == [LAW]
    case = sweeps.OrbitCase(table="circle", law=LAW, bounces=5)
    found = carom.sweep(carom.Space(case, {"kappa": [0.2, 0.3]}), keep=["bounces.count"]).run()
    assert not found["failed"].any()
    assert find_law(LAW).name == "law"
    assert evil.exists()


def test_a_name_without_a_mark_is_refused_inside_of_carom(evil: Path) -> None:
    """Whoever adds a way in and thinks of nothing: his reader hands a text on, and it is refused."""
    forgotten = {
        "__name__": "carom.scene.a_new_reader",
        "carom": carom,
        "scene": one_ball(),
        "find_law": find_law,
        "law_of": law_of,
    }
    for text in (
        "find_law('evil.py:law')",
        "law_of('evil.py:law', None)",
        "carom.Run(law='evil.py:law')",
        "carom.Scene(run={'law': 'evil.py:law'})",
        "carom.scene.Plane(point=(0, 0, 0), normal=(1, 0, 0), law='evil.py:law')",
        "carom.replaced(scene, {'run.law': 'evil.py:law'})",
        "carom.simulate(scene, law='evil.py:law')",
        "carom.billiards.orbit(carom.billiards.circle(), ((0.2, 0.1), (0.8, 0.3)), 2, law='evil.py:law')",
        "carom.sweeps.OrbitCase(table='circle', law='evil.py:law')",
        "carom.sweeps.ImpactCase(law='evil.py:law')",
        "carom.Space(carom.sweeps.ImpactCase(), {'law': ['mirror', 'evil.py:law']})",
        "list(map(find_law, ['evil.py:law']))",
    ):
        with pytest.raises(carom.CaromError, match="runs no code"):
            eval(text, dict(forgotten))
    assert not evil.exists()


def test_a_mark_is_kept_where_a_scene_is_changed_and_lost_in_a_file(evil: Path) -> None:
    assert isinstance(carom.replaced(one_ball(law=LAW), {"run.max_events": 3}).run.law, OwnLaw)
    marked = carom.Run(law=LAW)
    assert isinstance(from_file("x", carom.Run, {"law": LAW}, allow_own_laws=True).law, OwnLaw)
    assert marked.model_dump_json() == carom.Run().model_dump_json().replace("two-step", LAW)
    assert evil.exists()
    evil.unlink()
    with pytest.raises(carom.CaromError, match="runs no code"):
        from_file("x", carom.Run, json.loads(marked.model_dump_json()))
    assert not evil.exists()
    assert with_own_laws({"a": ["mirror", 1.0, (LAW,)]}) == {"a": ["mirror", 1.0, (LAW,)]}
    assert type(with_own_laws({"a": ["mirror", 1.0, (LAW,)]})["a"][2][0]) is OwnLaw


def test_one_module_runs_files() -> None:
    """``exec_module`` stands in one place, and nothing unpickles but Numba's cache."""
    words = re.compile(r"\b(exec_module|load_module|run_path|run_module|runpy|Unpickler|allow_pickle=True)\b")
    found = {
        (path.relative_to(ROOT).as_posix(), word)
        for path in ROOT.rglob("*.py")
        for word in words.findall(path.read_text(encoding="utf-8"))
    }
    assert found == {("laws/registry.py", "exec_module")}
