"""Compiled loops are shared by installations of the same code, and compiled by one process at a time."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest

from carom.core.jit.compile import is_cached
from carom.core.jit.file_locks import locked
from carom.core.jit.shared_cache import Locator

# A module of carom's, at a path of its own; it prints how often its loop was compiled, and how often it was loaded.
MODULE = """
from carom.core.jit.compile import njit

def loop(n):
    x = 0.0
    for i in range(n):
        x += (i * 0.5) ** 3 / (1.0 + x)
    return x

compiled = njit(loop)
compiled(3)
print(sum(compiled.stats.cache_misses.values()), sum(compiled.stats.cache_hits.values()))
"""

IMPORT_IT = "import sys, carom; carom.__path__.append(sys.argv[1]); import carom.trial"


def test_two_installations_compile_a_loop_once(tmp_path: Path) -> None:
    running = []
    for name in ("here", "there"):
        (tmp_path / name).mkdir()
        (tmp_path / name / "trial.py").write_text(MODULE)
        running.append(
            subprocess.Popen(
                [sys.executable, "-c", IMPORT_IT, str(tmp_path / name)],
                stdout=subprocess.PIPE,
                text=True,
                env={**os.environ, "CAROM_CACHE": str(tmp_path / "cache")},
            )
        )
    assert sorted(process.communicate()[0].split() for process in running) == [["0", "1"], ["1", "0"]]


def test_functions_of_others_keep_numbas_own_place(monkeypatch: pytest.MonkeyPatch) -> None:
    assert isinstance(Locator.from_function(locked, __file__), Locator)
    monkeypatch.setattr("numba.config.CACHE_DIR", "")
    assert Locator.from_function(lambda x: x, __file__) is None


def test_a_lock_that_cannot_be_had_is_done_without(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("carom.core.jit.file_locks.LONGEST_WAIT", 0.1)
    (tmp_path / "file").touch()
    with locked(tmp_path / "file" / "below"):  # no folder can be made there
        pass
    with locked(tmp_path / "lock"), locked(tmp_path / "lock"):  # held for longer than anybody waits
        pass


def test_a_folder_that_vanishes_while_it_is_searched_holds_nothing(monkeypatch: pytest.MonkeyPatch) -> None:
    """Another process removed the folders of an older version at that moment: simulations ended with FileNotFoundError."""

    def gone(*_given: object) -> object:
        raise FileNotFoundError("locks")

    monkeypatch.setattr(Path, "glob", gone)
    assert not is_cached(gone)


def test_what_numba_cannot_cache_is_said_and_not_raised() -> None:
    """With NUMBA_OPT=0 loops keep references to large arrays; Numba's warning names the file of the function."""
    from numba.core.caching import CompileResultCacheImpl
    from numba.core.errors import NumbaWarning

    class Result:
        lifted: tuple[Any, ...] = ()
        library = type("Library", (), {"has_dynamic_globals": True})
        fndesc = type("Described", (), {"qualname": "carom.core.jit.file_locks.locked"})

    found = CompileResultCacheImpl.__new__(CompileResultCacheImpl)
    found._lineno, found._locator = 1, Locator.from_function(locked, __file__)
    with pytest.warns(NumbaWarning, match="dynamic globals"):
        assert not found.check_cachable(Result())
