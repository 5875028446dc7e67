"""Compiled code of several versions of carom: what is kept, what is removed, and never what a process uses."""

from __future__ import annotations

import json
import os
import subprocess
import sys
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest
from reference.forking import forking

from carom.core.jit import cache
from carom.core.jit.cache import MARK, generations, use_generation

DAY = 86_400.0
OWN = "00000000000000ff"
HOLD = "import sys, pathlib; from carom.core.jit.cache import use_generation as use; use(pathlib.Path(sys.argv[1]));"


def made(base: Path, name: str, days: float, size: int = 100, marked: bool = True) -> Path:
    """A generation that was last used so many days ago."""
    folder = base / name
    (folder / "laws_carom").mkdir(parents=True)
    (folder / "laws_carom" / "loop.nbc").write_bytes(bytes(size))
    if marked:
        (folder / MARK).write_text("used\n")
    then = time.time() - days * DAY
    for path in (*folder.rglob("*"), folder):
        os.utime(path, (then, then))
    return folder


@contextmanager
def in_use(folder: Path) -> Iterator[None]:
    """Another process uses a generation."""
    with subprocess.Popen(
        [sys.executable, "-c", HOLD + "print(flush=True); input()", str(folder)],
        stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True,
    ) as process:  # fmt: skip
        assert process.stdout is not None
        process.stdout.readline()
        try:
            yield
        finally:
            process.kill()


def names(base: Path) -> set[str]:
    return {path.name for path in base.iterdir() if path.is_dir()}


def test_two_versions_keep_their_code(tmp_path: Path) -> None:
    """Each used to remove the other's: 4.4 minutes of compiling at every change of clone or environment."""
    one, two = (tmp_path / name for name in ("000000000000000a", "000000000000000b"))
    with forking() as forked:
        for folder in (one, two, one):
            assert forked(tmp_path, "-c", f"import sys; sys.argv[1:] = [{str(folder)!r}]; {HOLD}") == (0, "", "")
            (folder / "code.nbc").touch()
    assert names(tmp_path) == {one.name, two.name}
    assert [found.folder for found in generations(tmp_path)].count(one) == 1


def test_what_was_not_used_for_a_month_is_removed(tmp_path: Path) -> None:
    kept = made(tmp_path, "000000000000000a", 29)
    gone, of_older_carom = made(tmp_path, "000000000000000b", 31), made(tmp_path, "000000000000000c", 31, marked=False)
    others = [tmp_path / "my documents 16c", tmp_path / "000000000000000A", tmp_path / "removed-of mine"]
    for path in others:
        path.mkdir()
    left_behind = tmp_path / "removed-123-000000000000000d"
    left_behind.mkdir()
    sources = [tmp_path / "sources.json", tmp_path / "sources-0123456789abcdef.json"]
    for path, days in zip(sources, (31, 2), strict=True):
        path.write_text("{}")
        os.utime(path, (time.time() - days * DAY,) * 2)
    use_generation(tmp_path / OWN)
    assert names(tmp_path) == {OWN, kept.name, *(path.name for path in others)}
    assert not gone.exists()
    assert not of_older_carom.exists()
    assert [path.exists() for path in sources] == [False, True]


def test_beyond_the_size_the_least_recently_used_goes_first(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("carom.core.jit.cache.KEPT_BYTES", 3500)
    own = made(tmp_path, OWN, 3, 1000)
    for days in (4, 7, 12, 20):
        made(tmp_path, f"{days:016x}", days, 1000)
    use_generation(own)
    assert names(tmp_path) == {OWN, f"{4:016x}", f"{7:016x}"}
    monkeypatch.setattr("carom.core.jit.cache.KEPT_BYTES", 10)
    made(tmp_path, f"{1:016x}", 0.5, 0)
    use_generation(tmp_path / f"{1:016x}")  # (it was marked today: nothing is looked for)
    assert names(tmp_path) == {OWN, f"{1:016x}", f"{4:016x}", f"{7:016x}"}


def test_what_a_process_uses_is_kept_while_it_does(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("carom.core.jit.cache.KEPT_BYTES", 10)
    busy, idle = made(tmp_path, "000000000000000a", 3), made(tmp_path, "000000000000000b", 2)
    with in_use(busy):
        old = time.time() - 40 * DAY  # (a process that began long ago)
        os.utime(busy / MARK, (old, old))
        use_generation(tmp_path / OWN)
        assert names(tmp_path) == {OWN, busy.name}
    assert not idle.exists()
    other = tmp_path / "00000000000000fe"
    use_generation(other)
    assert names(tmp_path) == {OWN, other.name}  # (this process uses both)


def test_a_use_is_marked_once_a_day(tmp_path: Path) -> None:
    for days, marked in ((0.5, False), (1.5, True)):
        folder = made(tmp_path, f"{round(days * 10):016x}", days)
        use_generation(folder)
        assert (time.time() - (folder / MARK).stat().st_mtime < 0.2 * DAY) == marked


def test_without_locks_what_was_used_lately_counts_as_in_use(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("carom.core.jit.cache.KEPT_BYTES", 10)
    monkeypatch.setitem(sys.modules, "fcntl", None)
    made(tmp_path, "000000000000000a", 1.5)
    made(tmp_path, "000000000000000b", 2.5)
    use_generation(tmp_path / OWN)
    assert names(tmp_path) == {OWN, "000000000000000a"}


def test_a_cache_that_cannot_be_written_is_no_fault(tmp_path: Path) -> None:
    (tmp_path / "file").touch()
    use_generation(tmp_path / "file" / OWN)
    assert generations(tmp_path / "file") == []


MANY = """
import os, pathlib, sys, time
import carom.core.jit.cache as g
g.KEPT_BYTES = 10
begin, go = os.pipe()  # (all wait for its end)
children = []
for number in range(12):
    child = os.fork()
    if child == 0:
        os.close(go)
        os.read(begin, 1)
        folder = pathlib.Path(sys.argv[1]) / f"{number % 4:016x}"
        g.use_generation(folder)
        time.sleep(0.3)
        os._exit(0 if folder.is_dir() else 1)
    children.append(child)
os.close(go)
print([os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]) for child in children])
"""


def test_many_processes_at_once(tmp_path: Path) -> None:
    """Twelve that begin together, each with a cache that is full: none fails, and what they use is there at the end."""
    done = subprocess.run([sys.executable, "-c", MANY, str(tmp_path)], capture_output=True, text=True, check=True)
    assert (done.stdout.strip(), done.stderr) == (str([0] * 12), "")
    assert names(tmp_path) == {f"{number:016x}" for number in range(4)}


def test_two_clones_know_their_own_modules(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """One file for all installations was written over by each: a second and a half at every start of the other."""
    roots = [tmp_path / place / "carom" for place in ("here", "there")]
    for root in roots:
        (root / "core").mkdir(parents=True)
        (root / "core" / "one.py").write_text(f"x = {root.parent.name!r}\n")
    found = [cache.hash_of(root, tmp_path) for root in roots]
    assert found[0] != found[1]
    with monkeypatch.context() as patched:
        patched.setattr(cache, "_code_hash", lambda path: pytest.fail(f"{path} was compiled again"))
        assert [cache.hash_of(root, tmp_path) for root in roots] == found
    assert [len(json.loads(path.read_text())) for path in tmp_path.glob("sources-*.json")] == [1, 1]
    (roots[0] / "core" / "one.py").write_text("x = 'there'\n")  # (what counts is what the code does)
    assert cache.hash_of(roots[0], tmp_path) == found[1]
    monkeypatch.setattr(cache, "_numba_version", lambda: b"another")
    assert cache.hash_of(roots[0], tmp_path) != found[1]
