"""``carom doctor --warm``: every loop compiled in advance, by several processes."""

from __future__ import annotations

import importlib
from pathlib import Path

import pytest

from carom.cli.doctor import COMPILE_JOBS
from carom.core.jit import threads as workers


def test_every_job_exists() -> None:
    for job in COMPILE_JOBS:
        module, _, name = job.partition(":")
        assert callable(getattr(importlib.import_module(module), name))


def test_jobs_are_shared_by_the_workers(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "work_of_mine.py").write_text(
        "import os, pathlib\n"
        "def write(name): (pathlib.Path(__file__).parent / name).write_text(str(os.getpid()))\n"
        "def one(): write('one')\n"
        "def two(): write('two')\n"
        "def fails(): raise ValueError\n"
    )
    monkeypatch.syspath_prepend(tmp_path)
    found: dict[str, str] = {}
    jobs = [f"work_of_mine:{name}" for name in ("one", "fails", "two")]
    workers.run_in_workers(jobs, 1, found.__setitem__)
    assert list(found.values()) == ["", "ValueError:", ""]
    assert (tmp_path / "one").read_text() == (tmp_path / "two").read_text()  # one process did both
