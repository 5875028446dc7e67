"""A full disk: one line that says so, exit code 2, and nothing else lost.

The kernel is asked to refuse files above some size: it says EFBIG where a full disk says ENOSPC, and both go the same way. Each
command runs in a process of its own: a library that ends the process would end the tests.
"""

from __future__ import annotations

import json
import os
from collections.abc import Callable
from pathlib import Path

import pytest
from reference.forking import Forked
from reference.gases import ROUGH

pytestmark = pytest.mark.skipif(os.name != "posix", reason="needs limits of processes")

SCENE = """
[floor]
friction = 0.2
restitution = 0.5
[[walls]]
shape = "table"
length = 2.0
width = 1.0
restitution = 0.9
friction = 0.1
[[balls]]
radius = 0.03
mass = 0.2
position = [0, 0]
velocity = [3, 1]
[run]
law = "mirror"
max_events = 60
"""


Limited = Callable[..., tuple[int, str, list[str]]]


@pytest.fixture(scope="module")
def limited(forked: Forked) -> Limited:
    """Run carom in a folder where no file can be larger than some size: exit code, standard output, lines of standard error."""

    def limited(folder: Path, size: int, *words: str, **environment: str) -> tuple[int, str, list[str]]:
        code, out, err = forked(folder, *words, size=size, **environment)
        return code, out, err.splitlines()

    return limited


def room(name: str) -> str:
    return f"carom: {name}: expected room to write, got: File too large; free some space, or choose another place"


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    (tmp_path / "scene.toml").write_text(SCENE)
    (tmp_path / "gas.toml").write_text(ROUGH)
    return tmp_path


@pytest.mark.parametrize("size", [0, 3000])
def test_a_run_that_cannot_be_saved(size: int, folder: Path, limited: Limited) -> None:
    before = sorted(path.name for path in folder.iterdir())
    code, out, err = limited(folder, size, "simulate", "scene.toml", "--quiet", "--save", "run.parquet")
    assert (code, out, err) == (2, "", [room("run.parquet")])
    assert sorted(path.name for path in folder.iterdir()) == before


@pytest.mark.parametrize("size", [1000, 60_000])
def test_snapshots_that_do_not_fit_lose_nothing_else(size: int, folder: Path, limited: Limited) -> None:
    """The run goes on, its measures are written and printed, and the fault is told at its end."""
    pytest.importorskip("gsd")
    words = (
        "gas",
        "gas.toml",
        "--max-events",
        "20000",
        "--snapshots",
        "gas.gsd",
        "--measures",
        "measures.json",
        "--json",
    )
    code, out, err = limited(folder, size, *words)
    assert code == 2
    faults = [line for line in err if line.startswith("carom:")]
    assert faults[-1].startswith("carom: gas.gsd: expected "), err
    assert "Traceback" not in "".join(err)
    if size > 1000:
        told = json.loads(out)
        measured = json.loads((folder / "measures.json").read_text())
        assert any(line.endswith("the run continues without snapshots") for line in err)
        assert told["pair_collisions"] == measured["pair_collisions"] == 20000
        assert "written: measures.json" in err
        assert "written: gas.gsd" not in err


def test_a_cache_that_cannot_be_written_costs_time_only(folder: Path, limited: Limited) -> None:
    """What is compiled is not kept, and used."""
    (folder / "shots.csv").write_text("speed,incidence_deg\n" + "1,45\n" * 500)
    (folder / "none").write_text("a file, and no folder")
    words = ("predict", "shots.csv", "--law", "mirror", "--out", "out.csv", "--json")
    for cache, size in (("cache", 300), ("none", 10**9)):
        code, out, err = limited(folder, size, *words, CAROM_CACHE=str(folder / cache))
        faults = [line for line in err if line.startswith("carom:") or "Error" in line]
        assert faults == ([] if size > 300 else [room("out.csv")])  # (the table does not fit either)
        assert (code, bool(out)) == ((0, True) if size > 300 else (2, False))
        assert (folder / cache).is_dir() == (cache == "cache")  # (it is the cache of this process)
    assert len((folder / "out.csv").read_text().splitlines()) == 501
    assert all(path.stat().st_size <= 300 for path in folder.glob("cache/**/*") if path.is_file())
