"""Work handed to another process: done, failed, given up; and nothing that is left running."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest

from carom import beside

FOREVER = "signal:pause"


@pytest.fixture(autouse=True)
def _two_cores(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(beside, "_cores", lambda: 2)


def test_the_work_is_done_by_another(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "work_of_mine.py").write_text(
        "import os, pathlib\ndef done(): pathlib.Path(__file__).with_suffix('.txt').write_text(str(os.getpid()))\n"
    )
    monkeypatch.syspath_prepend(tmp_path)
    with beside.beside("work_of_mine:done"):
        beside.wait_for("work_of_mine:done")
        beside.wait_for("something else")  # which nobody does
    assert int((tmp_path / "work_of_mine.txt").read_text()) != os.getpid()


def test_what_fails_is_waited_for_no_longer() -> None:
    with beside.beside("carom.nowhere:nothing"):
        process = beside._at_work["carom.nowhere:nothing"]
        beside.wait_for("carom.nowhere:nothing")
        assert process.returncode != 0
    assert not beside._at_work


@pytest.mark.skipif(sys.platform == "win32", reason="no signals to pause for")
def test_it_does_not_outlive_who_asked_for_it() -> None:
    with beside.beside(FOREVER):
        process = beside._at_work[FOREVER]
        assert process.poll() is None
    assert process.poll() is not None
    # nor one that is killed, which closes the pipe
    process = beside._start(FOREVER)
    assert process is not None
    assert process.stdin is not None
    process.stdin.close()
    assert process.wait(60) == 1


def test_without_another_process_all_is_done_here(monkeypatch: pytest.MonkeyPatch) -> None:
    def refuse(*_: Any, **__: Any) -> Any:
        raise OSError

    monkeypatch.setattr(subprocess, "Popen", refuse)
    with beside.beside(FOREVER):
        assert not beside._at_work
        beside.wait_for(FOREVER)
    monkeypatch.undo()
    monkeypatch.setattr(sys, "executable", "")
    assert beside._start(FOREVER) is None
