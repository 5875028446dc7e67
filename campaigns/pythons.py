"""The test suite under several Pythons: what passes, fails and is skipped in each; and the lines of carom that it runs, by room.

    python campaigns/pythons.py --rows FILE --pythons PYTHON [PYTHON ...]

Each Python is an environment with carom's extra dev. The parts of the suite, its folders and the files
beside them, run one after the other, and a run that was ended goes on with the part that is missing. Where a Python has the package
coverage (7.10 or later, and Python 3.12 or later, whose monitoring costs little), its lines are counted, those of other processes
too. Lines of kernels are counted by themselves: the suite runs most of them as compiled code, which no such count sees.
"""

from __future__ import annotations

import ast
import json
import os
import re
import subprocess
import sys
import tempfile
from collections import Counter
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from campaign import ROOT, Campaign, campaign

SMALL = "tests/core/test_units.py"
UNCOUNTED = "tests/test_full_disk.py"  # where no further file has room, so lines cannot be counted there
ENDS = ("passed", "failed", "errors", "skipped")
ABOUT = """
import sys, sysconfig
from importlib.util import find_spec
name = ".".join(map(str, sys.version_info[:3])) + ("t" if sysconfig.get_config_var("Py_GIL_DISABLED") else "")
print(name, int(sys.version_info >= (3, 12) and find_spec("coverage") is not None))
"""
COVERAGE = """[run]
core = sysmon
source_pkgs = carom
parallel = true
patch = subprocess
data_file = {folder}/lines
"""
MARKS = re.compile(r"kernel|derived_by|slopes|root_of")
COMPILES = {"njit", "cfunc", "loop_for", "LoopSource"}


def parts() -> list[str]:
    """Return the parts of the suite: each folder of tests, and the files beside them."""
    tests = ROOT / "tests"
    folders = sorted({f"tests/{path.parent.name}" for path in tests.glob("*/test_*.py")})
    return [
        *folders,
        " ".join(sorted({f"tests/{path.name}" for path in tests.glob("test_*.py")} - {UNCOUNTED})),
        UNCOUNTED,
    ]


def run_part(python: str, files: str, folder: Path | None) -> dict[str, Any]:
    """Run a part of the suite; its counts, its seconds, and the names of what failed. ``folder``: where lines are counted."""
    cover: list[str] = []
    if folder is not None:
        folder.mkdir(parents=True, exist_ok=True)
        (folder / "settings").write_text(COVERAGE.format(folder=folder.resolve()), encoding="utf-8")
        cover = ["-m", "coverage", "run", f"--rcfile={folder.resolve() / 'settings'}"]
    paths = os.pathsep.join([str(Path(python).parent), os.environ.get("PATH", "")])
    sources = os.pathsep.join([str(ROOT / "src"), *filter(None, [os.environ.get("PYTHONPATH")])])
    done = subprocess.run(
        [
            python,
            *cover,
            "-m",
            "pytest",
            "-n0" if files == SMALL else "-n2",
            "-rfE",
            "-p",
            "no:cacheprovider",
            *files.split(),
        ],
        cwd=ROOT,
        env={**os.environ, "PATH": paths, "PYTHONPATH": sources, "MPLBACKEND": "Agg"},
        capture_output=True,
        text=True,
        check=False,
    )
    last = done.stdout.strip().rpartition("\n")[2]
    counts = {"errors" if end == "error" else end: int(n) for n, end in re.findall(r"(\d+) ([a-z]+)", last)}
    if not any(end in counts for end in ENDS):
        raise RuntimeError(f"{python}: expected a run of pytest, got: {done.stdout[-500:]}{done.stderr[-500:]}")
    found = {end: counts.get(end, 0) for end in ENDS}
    minutes = re.search(r"in ([\d.]+)s", last)
    return {
        **found,
        "seconds": float(minutes[1]) if minutes else 0.0,
        "names": re.findall(r"^(?:FAILED|ERROR) (\S+)", done.stdout, re.MULTILINE),
    }


def compiled_lines(path: Path) -> set[int]:
    """Return the lines of a module's kernels, and of functions that it hands to the compiler: what runs as compiled code."""
    tree = ast.parse(path.read_text(encoding="utf-8"))
    handed = {
        argument.id
        for call in ast.walk(tree)
        if isinstance(call, ast.Call) and ast.unparse(call.func).rpartition(".")[2] in COMPILES
        for argument in call.args[:1]
        if isinstance(argument, ast.Name)
    }
    kernels = (
        one
        for one in ast.walk(tree)
        if isinstance(one, ast.FunctionDef)
        and (one.name in handed or any(MARKS.search(ast.unparse(mark)) for mark in one.decorator_list))
    )
    return {line for one in kernels for line in range(one.body[0].lineno, (one.end_lineno or one.lineno) + 1)}


def lines_by_room(python: str, folder: Path) -> dict[str, Counter[str]]:
    """Return lines of Python and of kernels, and how many of each ran, by room: of what was counted in a folder."""
    every, report = f"--data-file={folder / 'all'}", folder / "report.json"
    counted = sorted(folder.glob("*/lines.*"))
    settings = f"--rcfile={counted[0].with_name('settings')}"
    for words in (
        ["combine", "--keep", settings, every, *map(str, counted)],
        ["json", "-q", "-i", settings, every, "-o", str(report)],
    ):
        subprocess.run([python, "-m", "coverage", *words], cwd=ROOT, check=True, capture_output=True)
    rooms: dict[str, Counter[str]] = {}
    for name, file in json.loads(report.read_text(encoding="utf-8"))["files"].items():
        if not (ROOT / name).is_relative_to(ROOT / "src"):  # (copies of the package that tests make)
            continue
        inside = (ROOT / name).relative_to(ROOT / "src" / "carom")
        room = rooms.setdefault(inside.parts[0] if len(inside.parts) > 1 else "(top)", Counter())
        compiled = compiled_lines(ROOT / name)
        for which, lines in (("ran", file["executed_lines"]), ("not", file["missing_lines"])):
            kernels = len(compiled.intersection(lines))
            room.update({f"{which} kernels": kernels, f"{which} python": len(lines) - kernels})
    return rooms


def say_rooms(run: Campaign, rooms: dict[str, Counter[str]]) -> None:
    """Print a line a room, and one for all."""

    def said(room: Counter[str], kind: str) -> str:
        ran = room[f"ran {kind}"]
        total = ran + room[f"not {kind}"]
        return f"{total:>8,} {f'{100 * ran / total:.1f} %' if total else '-':>8}"

    run.say(f"{'room':12} {'lines':>8} {'run':>8} {'kernels':>8} {'run':>8}")
    for name, room in [*sorted(rooms.items()), ("all", sum(rooms.values(), Counter()))]:
        run.say(f"{name:12} {said(room, 'python')} {said(room, 'kernels')}")


def main(words: Sequence[str] | None = None) -> int:
    """Print a line a Python, and a line a room; 1 if a test failed."""
    pythons = {"nargs": "+", "default": [sys.executable], "help": "interpreters (default: this one)"}
    known = {"action": "store_true", "help": "run nothing: print what is in --rows"}
    with (
        campaign("pythons", __doc__, words, pythons=pythons, known=known) as run,
        tempfile.TemporaryDirectory() as temporary,
    ):
        return report(run, Path(temporary))


def report(run: Campaign, temporary: Path) -> int:
    """Run what is not known yet, and print all."""
    files = [SMALL] if run.small else parts()
    given = run.given.rows
    kept = temporary if given is None else given.with_suffix(".lines")
    asked = (
        subprocess.run([one, "-c", ABOUT], capture_output=True, text=True, check=True) for one in run.given.pythons
    )
    known = {
        name: (path, counted == "1")
        for path, (name, counted) in zip(run.given.pythons, (a.stdout.split() for a in asked), strict=True)
    }

    def folder(name: str, k: int) -> Path | None:
        return kept / name / str(k) if known[name][1] and not run.small and files[k] != UNCOUNTED else None

    wanted = [(name, k) for name in known for k in range(len(files))]
    if run.given.known:
        wanted = [key for key in wanted if key in run.rows.known]
    rows = run.go_through(wanted, lambda name, k: run_part(known[name][0], files[k], folder(name, k)))
    run.say(f"{'Python':10} {'parts':>5} {'passed':>7} {'failed':>7} {'skipped':>7} {'minutes':>7}")
    for name in known:
        its = [row for row in rows if row["kind"] == name]
        total = Counter({end: sum(row[end] for row in its) for end in ENDS})
        failed, minutes = total["failed"] + total["errors"], sum(row["seconds"] for row in its) / 60
        run.say(
            f"{name:10} {f'{len(its)}/{len(files)}':>5} {total['passed']:>7,} {failed:>7,} {total['skipped']:>7,} {minutes:>7.0f}"
        )
        for test in (test for row in its for test in row["names"]):
            run.say(f"  {test}")
    for name in known:
        if (kept / name).exists():
            run.say(f"\nlines that the suite ran, Python {name}")
            say_rooms(run, lines_by_room(known[name][0], kept / name))
    return int(any(row["names"] for row in rows))


if __name__ == "__main__":
    raise SystemExit(main())
