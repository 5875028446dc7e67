"""Work handed to another process: done, failed, given up; and nothing that is left running."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest

from carom.core.jit import workers as background
from carom.core.jit.progress import watch_compiling

FOREVER = "signal:pause"


@pytest.fixture(autouse=True)
def _twocore_count(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(background, "core_count", lambda: 2)


def test_the_work_is_done_by_another(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "work_of_mine.py").write_text(
        "import os, pathlib\ndef done(): pathlib.Path(__file__).with_suffix('.txt').write_text(str(os.getpid()))\n"
    )
    monkeypatch.syspath_prepend(tmp_path)
    with background.compile_in_background("work_of_mine:done"):
        background.wait_for("work_of_mine:done")
        background.wait_for("something else")  # which nobody does
    assert int((tmp_path / "work_of_mine.txt").read_text()) != os.getpid()


def test_what_it_compiles_is_announced_here(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "work_that_tells.py").write_text(
        "from carom.core.jit.progress import announce\ndef done():\n    announce('a.b:c', False)\n    announce('a.b:c', True)\n"
    )
    monkeypatch.syspath_prepend(tmp_path)
    seen: list[tuple[str, bool]] = []
    with (
        watch_compiling(lambda name, finished: seen.append((name, finished))),
        background.compile_in_background("work_that_tells:done"),
    ):
        background.wait_for("work_that_tells:done")
    assert seen == [("a.b:c", False), ("a.b:c", True)]


def test_what_fails_is_waited_for_no_longer() -> None:
    with background.compile_in_background("carom.nowhere:nothing"):
        process = background._processes["carom.nowhere:nothing"]
        background.wait_for("carom.nowhere:nothing")
        assert process.returncode != 0
    assert not background._processes


@pytest.mark.skipif(sys.platform == "win32", reason="no signals to pause for")
def test_it_does_not_outlive_who_asked_for_it() -> None:
    with background.compile_in_background(FOREVER):
        process = background._processes[FOREVER]
        assert process.poll() is None
    assert process.poll() is not None
    # nor one that is killed, which closes the pipe
    process = background._start(FOREVER)
    assert process is not None
    assert process.stdin is not None
    assert process.stdout is not None
    process.stdin.close()
    assert process.wait(60) == 1
    process.stdout.close()


def test_without_another_process_all_is_done_here(monkeypatch: pytest.MonkeyPatch) -> None:
    def refuse(*_: Any, **__: Any) -> Any:
        raise OSError

    monkeypatch.setattr(subprocess, "Popen", refuse)
    with background.compile_in_background(FOREVER):
        assert not background._processes
        background.wait_for(FOREVER)
    monkeypatch.undo()
    monkeypatch.setattr(sys, "executable", "")
    assert background._start(FOREVER) is None
