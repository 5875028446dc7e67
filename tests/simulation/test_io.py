"""Runs in files: back with the same bits, or one line that says why not."""

from __future__ import annotations

import json
import math
import sys
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

import carom
from carom.simulation import files as storage

pa = pytest.importorskip("pyarrow")
pq = pytest.importorskip("pyarrow.parquet")

KINDS = [".parquet"]
BALL = {"radius": 0.03, "mass": 0.2}
LAW = """
def turned(v, w, n, a, kappa, e, mu, beta):
    u = v[0] * n[0] + v[1] * n[1] + v[2] * n[2]
    return (v[0] - 2 * u * n[0], v[1] - 2 * u * n[1], v[2] - 2 * u * n[2]), w
"""


def scene(**more: Any) -> carom.Scene:
    """Three balls, bounces, every form of restitution, infinite numbers."""
    fields: dict[str, Any] = {
        "gravity": 9.81,
        "floor": {"friction": math.inf, "restitution": {"form": "exponential", "at_rest": 0.7, "at_speed": 0.3, "speed": 2.0}},
        "walls": [
            {"shape": "table", "length": 2.0, "width": 1.0, "restitution": {"form": "han-2005"}, "friction": 0.3},
            {"shape": "plane", "point": (0, 0, 1), "normal": (0, 0, -1), "law": "mirror", "name": "ceiling",
             "restitution": {"form": "power", "at_rest": 0.9, "speed": 0.1}},
            {"shape": "sphere", "center": (0.9, 0.4, 0), "radius": 0.05, "law": "no-slip",
             "restitution": {"form": "viscoelastic", "c": 0.1}},
            {"shape": "segment", "start": (0.5, -0.1), "end": (0.5, 0.1), "friction": math.inf,
             "restitution": {"form": "polynomial", "coefficients": (0.9, -0.1, 0.0)}},
        ],
        "balls": [
            BALL | {"position": (-0.7, 0.0), "velocity": (2.0, 0.05), "rolling": True, "spin_z": -0.1, "name": "wëiß"},
            BALL | {"position": (0.0, 0.04), "inertia": 0.3},
            BALL | {"position": (0.0, 0.4, 0.5), "velocity": (1 / 3, -0.0, 0.1), "spin": (1e-300, 2 / 7, -5)},
        ],
        "ball_contact": {"restitution": 0.95, "friction": 0.05},
        "run": {"duration": 1.7, "floor_contact": "after"},
    }  # fmt: skip
    return carom.Scene(**fields | more)


@pytest.fixture(scope="module")
def runs() -> dict[str, carom.Trajectory]:
    """One of many balls with bounces, one that ended by its number of events, one of no events at all."""
    still = carom.Scene(balls=[BALL | {"position": (0, 0)}], gravity=0.0)
    return {
        "bounces": carom.simulate(scene()),
        "max_events": carom.simulate(scene(run={"max_events": 7})),
        "nothing": carom.simulate(still),
    }


def changed(path: Path, tmp_path: Path, **about: Any) -> Path:
    """The same Parquet file with another description."""
    table = pq.read_table(path)
    found = json.loads(table.schema.metadata[b"carom"]) | about
    other = tmp_path / "changed.parquet"
    pq.write_table(table.replace_schema_metadata({"carom": json.dumps(found)}), other)
    return other


def one_line(path: Path, **options: bool) -> str:
    """What is said when a file cannot be loaded: one line, with its name."""
    with pytest.raises(carom.CaromError) as caught:
        carom.load_trajectory(path, **options)
    assert len(caught.value.faults) == 1
    assert "\n" not in caught.value.faults[0]
    assert str(path) in caught.value.faults[0]
    return caught.value.faults[0]


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("name", ["bounces", "max_events", "nothing"])
def test_the_same_bits_come_back(runs: dict[str, carom.Trajectory], name: str, kind: str, tmp_path: Path) -> None:
    run = runs[name]
    path = tmp_path / f"run{kind}"
    assert run.save(path) == path
    assert [file.name for file in tmp_path.iterdir()] == [path.name]
    back = carom.load_trajectory(path)
    assert back.log.dtype == run.log.dtype
    assert back.log.tobytes() == run.log.tobytes()
    assert (back.end, back.ended) == (run.end, run.ended)
    assert back.scene.model_dump() == run.scene.model_dump()
    assert repr(back.scene) == repr(run.scene)  # the signs of zeros, too
    times = np.linspace(0, run.end, 11)
    for ask in (carom.Trajectory.at, carom.Trajectory.orientation, carom.Trajectory.energy):
        one, two = ask(run, times), ask(back, times)
        if isinstance(one, carom.State) and isinstance(two, carom.State):
            assert one.position is not None
            assert two.position is not None
            assert one.position.tobytes() == two.position.tobytes()
            assert one.velocity.tobytes() == two.velocity.tobytes()
            assert one.spin.tobytes() == two.spin.tobytes()
        else:
            assert np.asarray(one).tobytes() == np.asarray(two).tobytes()
    assert back.events.kinds == run.events.kinds


@pytest.mark.parametrize("kind", KINDS)
def test_a_long_description(kind: str, tmp_path: Path) -> None:
    """HDF5 has a limit of 64 kB for some attributes."""
    balls = [BALL | {"position": (i, 0), "name": f"ball number {i}"} for i in range(1000)]
    run = carom.simulate(carom.Scene(balls=balls, floor={"friction": 0.2}))
    assert len(run.scene.model_dump_json()) > 100_000
    back = carom.load_trajectory(run.save(tmp_path / f"run{kind}"))
    assert back.scene.model_dump() == run.scene.model_dump()


def test_the_runs_are_worth_saving(runs: dict[str, carom.Trajectory]) -> None:
    kinds = set(runs["bounces"].events.kinds)
    assert {"wall", "floor", "ball"} <= kinds
    assert runs["max_events"].ended == "max_events"
    assert len(runs["nothing"].events) == 0


def test_what_it_says_to_other_programs(runs: dict[str, carom.Trajectory], tmp_path: Path) -> None:
    run = runs["bounces"]
    table = pq.read_table(run.save(tmp_path / "run.parquet"))
    assert table.column("kind").to_pylist()[:4] == ["start", "start", "start", run.events[0].kind]
    assert table.schema.field("vx").metadata == {b"unit": b"m/s"}


@pytest.mark.parametrize("kind", KINDS)
def test_a_law_from_a_file_is_kept_by_name(kind: str, tmp_path: Path) -> None:
    law = tmp_path / "law.py"
    law.write_text(LAW)
    run = carom.simulate(scene(run={"max_events": 5, "law": f"{law}:turned"}))
    back = carom.load_trajectory(run.save(tmp_path / f"run{kind}"), allow_own_laws=True)
    assert back.scene.run.law == f"{law}:turned"
    assert back.log.tobytes() == run.log.tobytes()
    law.unlink()
    assert "law.py:turned': expected a Python file, got" in one_line(tmp_path / f"run{kind}", allow_own_laws=True)


@pytest.mark.parametrize("kind", KINDS)
def test_a_law_without_a_file_is_refused(kind: str, tmp_path: Path) -> None:
    namespace: dict[str, Any] = {}
    exec(LAW, namespace)
    law = carom.wall_law(carom.Card("mine", "", (), "", "", ""), namespace["turned"])
    for own in (scene(run={"max_events": 2, "law": law}), scene(walls=[{**scene().walls[0].model_dump(), "law": law}])):
        with pytest.raises(carom.CaromError, match=r"carom\.Law 'mine'.*file\.py:name"):
            carom.simulate(own).save(tmp_path / f"run{kind}")
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("name", ["run.csv", "run.nc", "run", "no/run.parquet"])
def test_where_it_cannot_be_saved(runs: dict[str, carom.Trajectory], name: str, tmp_path: Path) -> None:
    with pytest.raises(carom.CaromError, match=name) as caught:
        runs["nothing"].save(tmp_path / name)
    assert len(caught.value.faults) == 1
    assert list(tmp_path.iterdir()) == []


def test_a_missing_library_is_named(
    runs: dict[str, carom.Trajectory], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    path = runs["nothing"].save(tmp_path / "run.parquet")
    monkeypatch.setitem(sys.modules, "pyarrow", None)
    for call in (lambda: runs["nothing"].save(path), lambda: carom.load_trajectory(path)):
        with pytest.raises(carom.CaromError, match=r"run\.parquet: needs pyarrow, .*install .*\[parquet\]"):
            call()


def test_a_file_that_is_there_stays_if_saving_fails(runs: dict[str, carom.Trajectory], tmp_path: Path) -> None:
    path = tmp_path / "run.parquet"
    path.write_text("before")
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(pq, "write_table", lambda *_args: (_ for _ in ()).throw(OSError(28, "No space left")))
        with pytest.raises(carom.CaromError, match="No space left"):
            runs["nothing"].save(path)
    assert path.read_text() == "before"
    assert [file.name for file in tmp_path.iterdir()] == ["run.parquet"]


def test_other_names_and_missing_files(tmp_path: Path) -> None:
    assert "No such file" in one_line(tmp_path / "none.parquet")
    assert "'.txt'" in one_line(tmp_path / "run.txt")
    folder = tmp_path / "folder.parquet"
    folder.mkdir()
    one_line(folder)


@pytest.mark.parametrize("kind", KINDS)
def test_damaged_files(runs: dict[str, carom.Trajectory], kind: str, tmp_path: Path) -> None:
    path = runs["bounces"].save(tmp_path / f"run{kind}")
    whole = path.read_bytes()
    for text in (b"", b"nonsense" * 100, whole[: len(whole) // 2]):
        path.write_bytes(text)
        assert "expected" in one_line(path)


@pytest.mark.parametrize("kind", KINDS)
def test_one_changed_bit_is_seen(runs: dict[str, carom.Trajectory], kind: str, tmp_path: Path) -> None:
    run = runs["bounces"]
    path = run.save(tmp_path / f"run{kind}")
    number = run.log["v"][-1, 0].tobytes()
    whole = path.read_bytes()
    assert number in whole
    at = whole.rindex(number)
    path.write_bytes(whole[:at] + bytes([whole[at] ^ 1]) + whole[at + 1 :])
    assert "changed since" in one_line(path)


def test_foreign_files(tmp_path: Path) -> None:
    pq.write_table(pa.table({"t": [1.0]}), tmp_path / "other.parquet")
    assert "a Parquet file without one" in one_line(tmp_path / "other.parquet")


def test_a_file_of_a_later_carom(runs: dict[str, carom.Trajectory], tmp_path: Path) -> None:
    path = runs["nothing"].save(tmp_path / "run.parquet")
    said = one_line(changed(path, tmp_path, carom_format=storage.FORMAT + 1, carom="9.9"))
    assert f"format {storage.FORMAT + 1} of carom 9.9" in said


def test_another_description_or_other_columns(runs: dict[str, carom.Trajectory], tmp_path: Path) -> None:
    path = runs["bounces"].save(tmp_path / "run.parquet")
    other = runs["nothing"].scene.model_dump_json()
    for field, value in (("scene", other), ("end", 1.0), ("ended", "max_events")):
        assert "changed since" in one_line(changed(path, tmp_path, **{field: value}))
    one_line(changed(path, tmp_path, end="soon"))
    one_line(changed(path, tmp_path, scene=None))
    assert "no number of its format" in one_line(changed(path, tmp_path, carom_format="1"))
    table = pq.read_table(path)
    for text in ("[" * 100_000, "7" * 5000, "[]", "no JSON"):
        pq.write_table(table.replace_schema_metadata({"carom": text}), tmp_path / "other.parquet")
        assert "unreadable description" in one_line(tmp_path / "other.parquet")
    pq.write_table(table.drop_columns(["vx"]), tmp_path / "less.parquet")
    assert "vx" in one_line(tmp_path / "less.parquet")
    kinds = pa.array(["unheard of"] * len(table))
    pq.write_table(table.set_column(table.column_names.index("kind"), "kind", kinds), tmp_path / "kind.parquet")
    assert "unheard of" in one_line(tmp_path / "kind.parquet")
    words = pa.array(["a"] * len(table))
    pq.write_table(table.set_column(table.column_names.index("vx"), "vx", words), tmp_path / "words.parquet")
    assert "'vx'" in one_line(tmp_path / "words.parquet")


@pytest.mark.parametrize(
    ("field", "value"),
    [
        ("t", math.nan), ("t", -1.0), ("t", math.inf), ("t", 1e9), ("ball", 3), ("ball", -1), ("kind", 0), ("other", 9),
        ("other", -2),
        ("x", math.nan), ("v", math.inf), ("w_before", -math.inf), ("impulse", math.nan), ("regime", 17), ("required", -0.1),
        ("end", math.nan), ("end", -1.0), ("ended", "tired"),
    ],
)  # fmt: skip
def test_numbers_that_no_run_has_are_one_line_behind_a_right_checksum(
    runs: dict[str, carom.Trajectory], tmp_path: Path, field: str, value: Any
) -> None:
    run = runs["bounces"]
    log = run.log.copy()
    about = {"end": run.end, "ended": run.ended}
    if field in about:
        about[field] = value
    else:
        log[field][np.flatnonzero(log["met"] == 1)[1]] = value
    path = storage.save(SimpleNamespace(scene=run.scene, log=log, **about), tmp_path / "run.parquet")  # type: ignore[arg-type]
    assert field.removesuffix("ed") in one_line(path)
    assert len(carom.load_trajectory(run.save(path)).log) == len(log)
