"""The folder of compiled code: removed a month after its last use; what cannot be kept is compiled anew."""

from __future__ import annotations

import os
import subprocess
import sys
import time
from pathlib import Path

import pytest

from carom.core.jit.cache import hash_of_files, use_folder, version_folders
from carom.core.jit.compile import is_cached
from carom.core.jit.threads import watch_compiling

DAY = 86_400.0
OWN = "00000000000000ff"

# A loop that Numba compiles and keeps; it says how often it was compiled, and how often it was loaded.
LOOP = """
from carom.core.jit.compile import njit, signature

def loop(n):
    x = 0.0
    for i in range(n):
        x += (i * 0.5) ** 3 / (1.0 + x)
    return x

compiled = njit(loop, signature(float, int))
print(sum(compiled.stats.cache_misses.values()), sum(compiled.stats.cache_hits.values()), compiled(3) > 0)
"""


def made(base: Path, name: str, days: float) -> Path:
    """The folder of a version that was last used so many days ago."""
    folder = base / name
    (folder / "laws").mkdir(parents=True)
    (folder / "laws" / "loop.nbc").write_bytes(bytes(100))
    then = time.time() - days * DAY
    os.utime(folder, (then, then))
    return folder


def test_what_was_not_used_for_a_month_is_removed_and_nothing_else(tmp_path: Path) -> None:
    old, recent = made(tmp_path, f"{1:016x}", 31), made(tmp_path, f"{2:016x}", 29)
    (tmp_path / "something of the user's").mkdir()
    os.utime(tmp_path / "something of the user's", (0, 0))
    use_folder(tmp_path / OWN)
    assert not old.exists()
    assert set(version_folders(tmp_path)) == {recent, tmp_path / OWN}
    assert (tmp_path / "something of the user's").exists()


def test_a_use_is_marked_once_a_day_and_keeps_a_version(tmp_path: Path) -> None:
    used, old = made(tmp_path, OWN, 40), made(tmp_path, f"{1:016x}", 31)
    use_folder(used)
    assert (used / "laws" / "loop.nbc").exists()
    assert time.time() - used.stat().st_mtime < DAY
    assert not old.exists()
    old = made(tmp_path, f"{1:016x}", 31)
    use_folder(used)  # (it was marked today: nothing is looked for)
    assert old.exists()


def test_a_place_where_no_folder_can_be_is_no_error(tmp_path: Path) -> None:
    (tmp_path / "file").touch()
    use_folder(tmp_path / "file" / OWN)
    assert version_folders(tmp_path / "file") == []


def test_the_hash_is_of_the_modules_that_may_hold_kernels(tmp_path: Path) -> None:
    for name in ("core", "plot"):
        (tmp_path / name).mkdir()
        (tmp_path / name / "one.py").write_text("x = 1\n")
    first = hash_of_files(tmp_path)
    (tmp_path / "plot" / "one.py").write_text("x = 2\n")
    assert hash_of_files(tmp_path) == first
    (tmp_path / "core" / "one.py").write_text("x = 2\n")
    assert hash_of_files(tmp_path) != first


@pytest.mark.parametrize("kept", [True, False])
@pytest.mark.slow
def test_a_loop_is_compiled_once_where_it_can_be_kept(kept: bool, tmp_path: Path) -> None:
    (tmp_path / "loop.py").write_text(LOOP)
    cache = tmp_path / "cache"
    if not kept:
        cache.touch()  # a file in the place of the folder
    said = [
        subprocess.run(
            [sys.executable, str(tmp_path / "loop.py")], capture_output=True, text=True, check=True,
            env={**os.environ, "CAROM_CACHE": str(cache)},
        ).stdout.split()
        for _ in range(2)
    ]  # fmt: skip
    assert said == ([["1", "0", "True"], ["0", "1", "True"]] if kept else [["1", "0", "True"]] * 2)


def test_a_folder_that_vanishes_while_it_is_searched_holds_nothing(monkeypatch: pytest.MonkeyPatch) -> None:
    def gone(*_given: object) -> object:
        raise FileNotFoundError("laws")

    monkeypatch.setattr(Path, "glob", gone)
    assert not is_cached(gone)


def test_watchers_hear_of_numba_functions_while_they_watch() -> None:
    from carom.core.jit.compile import njit

    seen: list[tuple[str, bool]] = []
    with watch_compiling(lambda name, finished: seen.append((name, finished))):
        double = njit(lambda x: 2 * x, cache=False)
        assert double(2) == 4
        assert double(3) == 6
    assert [finished for _name, finished in seen] == [False, True]
    assert double(2.5) == 5
    assert len(seen) == 2
