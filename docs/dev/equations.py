"""Write the table of the paper's equations: the functions that compute each, and the one that derives it.

    python docs/dev/equations.py             # writes docs/reference/equations.md
    python docs/dev/equations.py --check     # exit status 1 if that page is not of today's sources

A function computes an equation if a comment that begins with its number, ``# (31)``, stands in it, and derives it if it makes the
entry of that number in :mod:`carom.derive.paper`. Numbers of other papers stand in docstrings, with their authors. ``ELSEWHERE``
says what is done about an equation that has no line of its own.
"""

from __future__ import annotations

import ast
import functools
import io
import re
import sys
import tokenize
from collections import defaultdict
from collections.abc import Iterator
from pathlib import Path

ROOT = Path(__file__).parents[2]
SOURCE = ROOT / "src" / "carom"
PAGE = ROOT / "docs" / "reference" / "equations.md"
LAST = 41  # of the paper
LIST = r"(?:\(\d+[a-z]?\)(?:-\(\d+\))?(?:, | and | with )?)+"
CITED = re.compile(rf"(?:^#\s*|: |; )({LIST})")
NUMBER = re.compile(r"\((\d+)[a-z]?\)(?:-\((\d+)\))?")
HEAD = """# Equations

The equations of the paper, and the functions of `src/carom` that compute them: the number of an equation stands in a
comment above its lines. `carom derive --equation 31` derives an equation with all steps
([verdicts](../theory/errata.md#every-equation)).
`python docs/dev/equations.py` writes this page.

| | what | computed by |
|---|---|---|
"""
WHAT = (
    "angular velocity in Euler rates", "rolling on the floor", "kinetic energy of the rolling ball", "no slip at the wall",
    "the same in Euler rates", "solved for two of the rates", "dψ/dθ", "its integral", "its constant", "dφ/dθ", "its integral",
    "virtual displacements", "the momentum that does not jump", "written out", "in differences", "at the paper's attitude",
    "in spins",
    "hypothesis 1: rolling", "hypothesis 2: restitution", "kinetic energy", "hypothesis 3: energy", "the conventional law",
    "rolling without side spin", "velocity of B before", "velocity of B after", "the slip is reversed", "rolling before",
    "impulse and momentum at the wall", "the friction cone", "no slip at B afterwards", "the first impact", "energy before",
    "energy after", "kinetic energy in flight", "momenta", "they do not jump", "in spins", "rolling afterwards",
    "the second impact",
    "example, after the wall", "example, after the floor",
)  # fmt: skip
ELSEWHERE = {
    6: "`derive/euler.py: wall_rates`, without the pole",
    **dict.fromkeys((7, 10), "[the integrals](../theory/conventional.md#the-integrals-7-to-11)"),
    9: "(8) with c = 0",
    **dict.fromkeys(
        (12, 13, 14, 15, 16, 17),
        "[the conserved momentum](../theory/conventional.md#the-momentum-that-does-not-jump-12-to-17)",
    ),
    21: "a consequence of (19) and (22); tested",
    23: "(27) with no side spin",
    **dict.fromkeys((25, 26), "a consequence of (22): `laws/conventional.py: conventional_reflection`"),
    **dict.fromkeys((35, 36), "[after the wall](../theory/two_step.md#landing)"),
    **dict.fromkeys((40, 41), "[the example](../theory/two_step.md#the-example-40-and-41)"),
}


def functions(tree: ast.Module) -> list[tuple[int, int, str]]:
    """Return first line, last line and name of all functions, inner ones after those around them."""
    kinds = (ast.FunctionDef, ast.ClassDef)
    return [(one.lineno, one.end_lineno or 0, one.name) for one in ast.walk(tree) if isinstance(one, kinds)]


@functools.cache
def computed() -> dict[int, list[str]]:
    """Return file:function of each equation that a comment cites."""
    found: dict[int, list[str]] = defaultdict(list)
    for path in sorted(SOURCE.rglob("*.py")):
        name = path.relative_to(SOURCE).as_posix()
        text = path.read_text(encoding="utf-8")
        if name.startswith(("derive/paper/", "plot/")) or not re.search(rf"#\s*{LIST}", text):
            continue
        around = functions(ast.parse(text))
        for token in tokenize.generate_tokens(io.StringIO(text).readline):
            if token.type == tokenize.COMMENT and re.match(rf"#\s*{LIST}", token.string):
                line = token.start[0]
                inside = [one for low, high, one in around if low <= line <= high]
                place = f"{name}: {inside[-1]}" if inside else name
                for number in cited(" ".join(CITED.findall(token.string))):
                    if place not in found[number]:
                        found[number].append(place)
    return found


def cited(text: str) -> Iterator[int]:
    """Yield the numbers of a list such as (19), (28)-(31)."""
    for low, high in NUMBER.findall(text):
        yield from range(int(low), int(high or low) + 1)


@functools.cache
def derived() -> dict[int, list[str]]:
    """Return file:function of each entry of the paper's derivation."""
    found: dict[int, list[str]] = defaultdict(list)
    for path in sorted((SOURCE / "derive" / "paper").glob("*.py")):
        tree = ast.parse(path.read_text(encoding="utf-8"))
        for function in (one for one in tree.body if isinstance(one, ast.FunctionDef)):
            for call in ast.walk(function):
                first = call.args[0] if isinstance(call, ast.Call) and call.args else None
                number = re.match(r"(\d+)[a-z]?$", str(getattr(first, "value", "")))
                place = f"{path.name}: {function.name}"
                if number and isinstance(first.value, str) and place not in found[int(number[1])]:
                    found[int(number[1])].append(place)
    return found


def page() -> str:
    """Return the page."""
    found = computed()
    rows = [
        f"| ({n}) | {what} | {', '.join(f'`{x}`' for x in found[n]) or ELSEWHERE[n]} |\n"
        for n, what in enumerate(WHAT, 1)
    ]
    return HEAD + "".join(rows)


if __name__ == "__main__":
    if "--check" in sys.argv[1:]:
        sys.exit(PAGE.read_text(encoding="utf-8") != page())
    PAGE.write_text(page(), encoding="utf-8")
