"""Mutants: one place of the code changed at random; do the tests of its room notice?

    python campaigns/mutants.py [N] [--only ROOM] [--rows FILE] [--minutes 10]

N mutants (40) of each room. A mutant is a copy of the package in which one operator, comparison, condition, sign or number is
another; it is killed if a test of its room fails, or takes longer than ``--minutes``. What survives and is judged to mean the same
stands, with the reason, in campaigns/equivalent_mutants.txt; every other survivor is a test that is missing.
"""

from __future__ import annotations

import ast
import copy
import os
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Iterator, Sequence
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from campaign import ROOT, Campaign, campaign

# The tests that a mutant of a room is shown to, its own first.
ROOMS = {
    "laws": ("laws",),
    "core": ("core", "laws", "simulation", "billiards"),
    "simulation": ("simulation", "laws/test_two_step.py"),
    "billiards": ("billiards",),
    "scene": ("scene", "simulation/test_simulate.py"),
    "gas": ("gas",),
    "tracks": ("tracks",),
    "fitting": ("fitting",),
}
EQUIVALENT = Path(__file__).with_name("equivalent_mutants.txt")
SWAPPED: dict[type, type] = {
    ast.Add: ast.Sub, ast.Sub: ast.Add, ast.Mult: ast.Div, ast.Div: ast.Mult,
    ast.Lt: ast.LtE, ast.LtE: ast.Lt, ast.Gt: ast.GtE, ast.GtE: ast.Gt, ast.Eq: ast.NotEq, ast.NotEq: ast.Eq,
    ast.And: ast.Or, ast.Or: ast.And,
}  # fmt: skip
CALLS = {"min": "max", "max": "min"}


class Mutant(NamedTuple):
    """A change of one expression."""

    path: str
    line: int
    before: str
    after: str
    source: str
    """The whole module with it."""


def changed(node: ast.AST) -> ast.AST | None:
    """Return a copy of an expression with another operator, sign or number; None where there is nothing to change."""
    new: Any = copy.deepcopy(node)
    match node:
        case ast.BinOp() if type(node.op) in SWAPPED:
            new.op = SWAPPED[type(node.op)]()
        case ast.BoolOp():
            new.op = SWAPPED[type(node.op)]()
        case ast.Compare() if type(node.ops[0]) in SWAPPED:
            new.ops[0] = SWAPPED[type(node.ops[0])]()
        case ast.UnaryOp(op=ast.USub() | ast.Not()):
            new = new.operand
        case ast.Call(func=ast.Name(id=name)) if name in CALLS:
            new.func.id = CALLS[name]
        case ast.Constant(value=value) if type(value) is int:
            new.value = value + 1
        case ast.Constant(value=value) if type(value) is float:
            new.value = value * 1.25 if value else 1.0
        case _:
            return None
    return new


def expressions(tree: ast.AST) -> Iterator[ast.expr]:
    """Yield what code computes: no annotations, decorators, messages or names that are exported."""
    for field, value in ast.iter_fields(tree):
        if field in ("annotation", "returns", "decorator_list") or isinstance(tree, (ast.Raise, ast.JoinedStr)):
            continue
        if isinstance(tree, ast.Assign) and any(isinstance(t, ast.Name) and t.id == "__all__" for t in tree.targets):
            continue
        for child in value if isinstance(value, list) else [value]:
            if isinstance(child, ast.AST):
                if isinstance(child, ast.expr):
                    yield child
                yield from expressions(child)


def draw(room: str, seed: int) -> Mutant:
    """Draw a place of a room, each as likely as every other."""
    places = []
    for path in sorted((ROOT / "src" / "carom" / room).rglob("*.py")):
        text = path.read_text(encoding="utf-8")
        places += [
            (path, text, node, new) for node in expressions(ast.parse(text)) if (new := changed(node)) is not None
        ]
    path, text, node, new = places[int(np.random.default_rng(seed).integers(len(places)))]
    lines = text.encode().splitlines(keepends=True)
    begin = sum(map(len, lines[: node.lineno - 1])) + node.col_offset
    end = sum(map(len, lines[: (node.end_lineno or 0) - 1])) + (node.end_col_offset or 0)
    whole = text.encode()
    after = ast.unparse(new)
    source = (whole[:begin] + f"({after})".encode() + whole[end:]).decode()
    name = path.relative_to(ROOT / "src" / "carom").as_posix()
    return Mutant(name, node.lineno, ast.unparse(node), after, source)


def tried(room: str, mutant: Mutant, minutes: float) -> str:
    """Return "killed", "slow" or "survived": what the tests of its room say of a mutant."""
    with tempfile.TemporaryDirectory(prefix="carom-mutant-") as folder:
        for name in ("src", "tests", "docs", "campaigns"):
            shutil.copytree(ROOT / name, Path(folder, name), ignore=shutil.ignore_patterns("__pycache__", "_build"))
        for name in ("pyproject.toml", "README.md"):
            shutil.copy(ROOT / name, folder)
        Path(folder, "src", "carom", mutant.path).write_text(mutant.source, encoding="utf-8")
        here = os.environ | {
            "PYTHONPATH": str(Path(folder, "src")), "CAROM_CACHE": str(Path(folder, "cache")), "MPLBACKEND": "Agg",
        }  # fmt: skip
        tests = [str(Path("tests", part)) for part in ROOMS[room]]
        command = [sys.executable, "-m", "pytest", "-x", "-n0", "-p", "no:cacheprovider", *tests]
        with subprocess.Popen(
            command, cwd=folder, env=here, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL
        ) as run:
            try:
                return "survived" if run.wait(timeout=60 * minutes) == 0 else "killed"
            except subprocess.TimeoutExpired:
                run.kill()
                return "slow"


def one(room: str, seed: int, minutes: float) -> dict[str, Any]:
    """A mutant, and what became of it."""
    mutant = draw(room, seed)
    about = f"{mutant.path}:{mutant.line}: {mutant.before} -> {mutant.after}"
    return {"mutant": about, "fate": tried(room, mutant, minutes)}


def judged_equivalent() -> set[str]:
    """Return the mutants that mean the same, as "path: before -> after"."""
    lines = EQUIVALENT.read_text(encoding="utf-8").splitlines()
    return {line.split(" | ")[0] for line in lines if line and not line.startswith("#")}


def main(words: Sequence[str] | None = None) -> None:
    """A line a room, and one for each survivor."""
    minutes = {"type": float, "default": 10.0, "help": "after which a mutant counts as noticed"}
    with campaign("mutants", __doc__, words, count=40, small=2, minutes=minutes) as run:
        for room in ROOMS:
            if run.small or run.wants(room, ROOMS):
                report(run, room)


def report(run: Campaign, room: str) -> None:
    """Try the mutants of a room, as many at once as there are cores; with --small only draw them."""
    if run.small:
        for seed in range(run.count):
            mutant = draw(room, seed)
            ast.parse(mutant.source)
            run.say(f"{room}: {mutant.path}:{mutant.line}: {mutant.before} -> {mutant.after}")
        return
    with ThreadPoolExecutor(os.cpu_count()) as pool:
        new = {seed: pool.submit(one, room, seed, run.given.minutes) for seed in range(run.count)
               if (room, seed) not in run.rows.known}  # fmt: skip
        rows = run.rows.fill(room, range(run.count), lambda seed: new[seed].result())
    known = judged_equivalent()
    left = [row["mutant"] for row in rows if row["fate"] == "survived"]
    same = [about for about in left if about.replace(f":{about.split(':')[1]}:", ":", 1) in known]
    killed = len(rows) - len(left)
    share = 100 * killed / max(len(rows) - len(same), 1)
    run.say(
        f"{room:12} {len(rows)} mutants: {killed} killed, {len(same)} equivalent, {len(left) - len(same)} survived ({share:.0f} %)"
    )
    for about in left:
        if about not in same:
            run.say(f"    {about}")


if __name__ == "__main__":
    main()
