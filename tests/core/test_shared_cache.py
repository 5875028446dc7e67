"""Compiled loops are shared by installations of the same code, and compiled by one process at a time."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest

from carom.core.jit.cache import Locator, locked
from carom.core.jit.compile import is_cached

# A module of carom's, at a path of its own; it says how often its loop was compiled, and how often it was loaded.
MODULE = """
from carom.core.jit.compile import njit

def loop(n):
    x = 0.0
    for i in range(n):
        x += (i * 0.5) ** 3 / (1.0 + x)
    return x

compiled = njit(loop)
compiled(3)
found = sum(compiled.stats.cache_misses.values()), sum(compiled.stats.cache_hits.values())
"""

# Two processes that begin together; what they import is imported once, before they part.
IMPORT_IT = """
import os, sys
import carom
from carom.core.jit.compile import register_kernels
register_kernels()
children = []
for folder in sys.argv[1:]:
    child = os.fork()
    if child == 0:
        carom.__path__.append(folder)
        import carom.trial
        print(*carom.trial.found, flush=True)
        os._exit(0)
    children.append(child)
for child in children:
    os.waitpid(child, 0)
"""


def test_two_installations_compile_a_loop_once(tmp_path: Path) -> None:
    folders = [tmp_path / name for name in ("here", "there")]
    for folder in folders:
        folder.mkdir()
        (folder / "trial.py").write_text(MODULE)
    done = subprocess.run(
        [sys.executable, "-c", IMPORT_IT, *map(str, folders)],
        capture_output=True,
        text=True,
        check=True,
        env={**os.environ, "CAROM_CACHE": str(tmp_path / "cache")},
    )
    assert sorted(done.stdout.splitlines()) == ["0 1", "1 0"]


def test_functions_of_others_keep_numbas_own_place(monkeypatch: pytest.MonkeyPatch) -> None:
    assert isinstance(Locator.from_function(locked, __file__), Locator)
    monkeypatch.setattr("numba.config.CACHE_DIR", "")
    assert Locator.from_function(lambda x: x, __file__) is None


def test_a_lock_that_cannot_be_had_is_done_without(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("carom.core.jit.cache.LONGEST_WAIT", 0.1)
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
        fndesc = type("Described", (), {"qualname": "carom.core.jit.cache.locked"})

    found = CompileResultCacheImpl.__new__(CompileResultCacheImpl)
    found._lineno, found._locator = 1, Locator.from_function(locked, __file__)
    with pytest.warns(NumbaWarning, match="dynamic globals"):
        assert not found.check_cachable(Result())
