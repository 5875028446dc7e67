"""Run tests in a copy of the package: without a mutant, which tells what each test reaches and takes, and with one."""

from __future__ import annotations

import contextlib
import fcntl
import functools
import hashlib
import json
import os
import shutil
import signal
import subprocess
import sys
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from mutation.places import Mutant

__all__ = ["Copy", "NotGreenError"]

PLAIN_LIMIT = 2.0  # s of the processor: a test that takes longer with kernels as plain Python is run compiled
SLOWER = 10.0  # times what a test takes without a mutant, after which it counts as failed
COMPILED_LIMIT = 600.0  # s
STARTING, COMPILING = 4.0, 120.0  # s, added to that, as the test may be the first that compiles
LONGEST = 600.0  # s: what all tests of a mutant may take, and three times as long as they do without one
Tests = dict[str, dict[str, Any]]


class NotGreenError(Exception):
    """Tests fail without a mutant."""


class Copy:
    """A copy of the package and of its tests, in which one module at a time is changed."""

    def __init__(self, root: Path, work: Path) -> None:
        work.mkdir(parents=True, exist_ok=True)
        work = work.resolve()  # (tests run in another folder)
        self.work, self.tree = work, work / "tree"
        self._lock = (work / "lock").open("w")
        try:
            fcntl.flock(self._lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            self.close()
            raise NotGreenError(
                f"{work}: expected a folder of its own for this run, got one in use by another"
            ) from None
        shutil.rmtree(self.tree, ignore_errors=True)
        for name in ("src", "tests", "docs", "campaigns"):
            shutil.copytree(root / name, self.tree / name, ignore=shutil.ignore_patterns("_build", "_generated"))
        for name in ("pyproject.toml", "README.md"):
            shutil.copy2(root / name, self.tree)

    def close(self) -> None:
        """Let another run have the folder."""
        self._lock.close()

    @property
    def package(self) -> Path:
        """The package's folder."""
        return self.tree / "src" / "carom"

    def baseline(self, parts: Sequence[str]) -> tuple[Tests, Tests]:
        """Run some of the tests without a mutant: what passes quickly as plain Python, and the others compiled.

        NotGreenError where one fails. What is found is kept, for as long as neither the package nor these tests change.
        """
        plain, compiled = dict[str, Any](), dict[str, Any]()
        for part in parts:
            kept = self.work / f"baseline-{part.replace('/', '-')}-{self._hash(part)}.json"
            if not kept.exists():
                first = self._record(part, plain=True)
                # (not those that start another process, which would compile)
                alone = {name: row for name, row in first.items() if row["passed"] and "*" not in row["reached"]}
                again = self._record(part, plain=True, tests=limits(alone), reach=False)  # in another order
                alone = {name: row for name, row in alone.items() if again[name]["passed"]}
                rest = dict.fromkeys(first.keys() - alone.keys(), COMPILED_LIMIT)
                found = self._record(part, plain=False, tests=rest) if rest else {}
                if bad := [name for name, row in found.items() if not row["passed"]] or not first:
                    raise NotGreenError(f"{part}: tests fail without a mutant: {bad}")
                kept.write_text(json.dumps([alone, found]))
            for rows, new in zip((plain, compiled), json.loads(kept.read_text()), strict=True):
                rows.update(new)
        return plain, compiled

    def try_mutant(self, mutant: Mutant, baseline: tuple[Tests, Tests]) -> str:
        """Return who killed a mutant, "plain" or "compiled", or "slow" where it took too long, or "survived"."""
        plain, compiled = baseline
        first = reaching(mutant, plain)
        others = {name: row for name, row in compiled.items() if name not in plain}
        second, every = reaching(mutant, others), self._nearest_first(mutant, limits(others))
        module = self.package / mutant.path
        before, times = module.read_bytes(), module.stat()
        try:
            module.write_text(mutant.source, encoding="utf-8")
            for kind, tests, more in (("plain", first, None), ("compiled", second, every)):
                if tests or more:
                    fate = self._killed(kind == "plain", tests, more)
                    if fate:
                        return kind if fate == "killed" else fate
        finally:
            module.write_bytes(before)
            os.utime(module, ns=(times.st_atime_ns, times.st_mtime_ns))
        return "survived"

    def _nearest_first(self, mutant: Mutant, tests: dict[str, float]) -> dict[str, float]:
        """Order tests by how often their file names the mutant's module, its package, or functions' names of that module."""
        module = "carom." + mutant.path.removesuffix(".py").replace("/", ".")
        names = (module, module.rpartition(".")[0] + " import " + module.rpartition(".")[2], mutant.function)

        def near(test: str) -> int:
            return -sum(text.count(name) for name in names if name) if (text := self._text(test)) else 0

        return dict(sorted(tests.items(), key=lambda item: near(item[0])))

    @functools.cache  # noqa: B019
    def _text(self, test: str) -> str:
        return (self.tree / test.split("::", maxsplit=1)[0]).read_text(encoding="utf-8")

    def control(self, mutant: Mutant, baseline: tuple[Tests, Tests]) -> None:
        """Raise NotGreenError where the code without a mutant is "killed" by the tests that the mutant would be shown to."""
        done = self.work / f"control-{mutant.path.split('/')[0]}-{self._hash('')}"
        if done.exists():
            return
        source = (self.package / mutant.path).read_text(encoding="utf-8")
        fate = self.try_mutant(mutant._replace(source=source), baseline)
        if fate != "survived":
            raise NotGreenError(f"tests fail without a mutant: {(self.work / 'last.log').read_text()[-2000:]}")
        done.touch()

    def _killed(self, plain: bool, tests: dict[str, float], more: dict[str, float] | None) -> str:
        cache = self.work / "cache"
        shutil.rmtree(cache, ignore_errors=True)
        every = tests | (more or {})
        files = list(dict.fromkeys(name.split("::")[0] for name in every))
        if not plain:
            tests, more = later(tests), later(more or {})
        allowed = LONGEST + 3 * sum(every.values()) / SLOWER
        task = {"plain": plain, "warm": str(self.work / "warm"), "tests": tests, "if_compiled": more}
        rc = self._pytest(task, files, cache, allowed, ["-x"], {"PYTHONDONTWRITEBYTECODE": "1"})
        if rc in (3, 4):
            raise NotGreenError(f"tests could not be run: {(self.work / 'last.log').read_text()[-2000:]}")
        # (5: none of these tests had to be run)
        return "slow" if rc is None else "" if rc in (0, 5) else "killed"

    def _record(self, part: str, plain: bool, tests: dict[str, float] | None = None, reach: bool = True) -> Tests:
        record = self.work / "record.json"
        record.unlink(missing_ok=True)
        warm = self.work / "warm"
        task = {"plain": plain, "record": str(record), "limit": PLAIN_LIMIT, "keep": str(warm), "tests": tests}
        task["reach"] = reach
        self._pytest(task, [f"tests/{part}"], self.work / "own-cache", None, [], {})
        rows: Tests = json.loads(record.read_text())
        return rows

    def _pytest(
        self,
        task: dict[str, Any],
        files: Sequence[str],
        cache: Path,
        allowed: float | None,
        words: Sequence[str],
        more: dict[str, str],
    ) -> int | None:
        paths = [str(self.tree / "src"), str(self.tree / "campaigns")]
        # (files, as a room may have more tests than a variable or a command line holds)
        asked, chosen = (self.work / "task.json").resolve(), (self.work / "tests.txt").resolve()
        asked.write_text(json.dumps(task), encoding="utf-8")
        chosen.write_text("\n".join(files))
        here = os.environ | {
            "CAROM_MUTATION": str(asked), "PYTHONPATH": os.pathsep.join(paths), "CAROM_CACHE": str(cache),
            "MPLBACKEND": "Agg",
        } | more  # fmt: skip
        options = ["-n0", "-p", "no:cacheprovider", "-p", "mutation.watch", "--tb=no", *words]
        with (self.work / "last.log").open("w") as log, subprocess.Popen(
            [sys.executable, "-m", "pytest", *options, f"@{chosen}"], cwd=self.tree, env=here, stdin=subprocess.DEVNULL,
            stdout=log, stderr=subprocess.STDOUT, start_new_session=True,
        ) as run:  # fmt: skip
            try:
                return run.wait(allowed)
            except subprocess.TimeoutExpired:
                return None
            finally:
                with contextlib.suppress(ProcessLookupError):
                    os.killpg(run.pid, signal.SIGKILL)

    def _hash(self, part: str) -> str:
        digest, tests = hashlib.sha256(), self.tree / "tests"
        for folder in (self.package, tests / "reference", tests / part):
            for path in sorted(folder.rglob("*.py")) or [folder]:
                digest.update(path.read_bytes())
        return digest.hexdigest()[:16]


def reaching(mutant: Mutant, tests: Tests) -> dict[str, float]:
    """Return the tests that reach a mutant, the shortest first, and how long each may take; all for code of the module itself."""
    place = f"{mutant.path}:{mutant.function}"
    own = f"{mutant.path}:"
    if mutant.function:
        tests = {name: row for name, row in tests.items() if place in row["reached"] or "*" in row["reached"]}
    # those that use the module at all come first
    first = {name: row for name, row in tests.items() if any(one.startswith(own) for one in row["reached"])}
    return limits(first) | {name: s for name, s in limits(tests).items() if name not in first}


def limits(tests: Tests) -> dict[str, float]:
    """Return how long tests may take, the shortest first."""
    times = sorted((row["seconds"], name) for name, row in tests.items())
    return {name: STARTING + SLOWER * seconds for seconds, name in times}


def later(tests: dict[str, float]) -> dict[str, float]:
    """Return longer times, in which loops can be compiled."""
    return {name: seconds + COMPILING for name, seconds in tests.items()}
