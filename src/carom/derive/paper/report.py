"""All equations of the paper in order, as records for JSON and as a LaTeX document."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Sequence
from functools import cache
from typing import Any

import sympy as sp

from carom.derive.paper import section2, section3
from carom.derive.paper.ledger import Entry, EquationVerdict, judge, shown
from carom.errors import CaromError

Progress = Callable[[float, float, str], None]

# Stages of the derivation: name, function, equation numbers, section of the unnumbered statements
STAGES: tuple[tuple[str, Callable[[], list[Entry]], range, int], ...] = (
    ("kinematics (1)-(4)", section2.kinematics, range(1, 5), 2),
    ("integrals (5)-(11)", section2.integration, range(5, 12), 2),
    ("virtual displacements (12)-(17)", section2.momentum, range(12, 18), 2),
    ("hypotheses (18)-(22)", section2.closing, range(18, 23), 2),
    ("slip at B (23)-(26)", section2.slip, range(23, 27), 2),
    ("first impact (27)-(31)", section3.wall, range(27, 32), 3),
    ("energy (32)-(33)", section3.energies, range(32, 34), 3),
    ("flight", section3.flight, range(0), 3),
    ("second impact (34)-(39)", section3.floor, range(34, 40), 3),
    ("example (40)-(41)", section3.example, range(40, 42), 4),
    ("angles", section3.angles, range(0), 4),
    ("conclusions", section3.conclusions, range(0), 5),
    ("introduction", section3.introduction, range(0), 1),
)


def order(name: str) -> tuple[int, int, str]:
    """Return a sort key: numbered equations first, each followed by its parts; then statements by section and count."""
    plain = re.fullmatch(r"(\d+)([a-z]?)", name)
    if plain:
        return 0, int(plain[1]), plain[2]
    loose = re.fullmatch(r"s(\d+)-(\d+)", name)
    if not loose:
        raise CaromError(
            f"equation: expected a number such as 31, a part such as 41e or a statement such as s4-1, got {name}"
        )
    return int(loose[1]), int(loose[2]), ""


@cache
def entries_of(stage: int) -> tuple[Entry, ...]:
    """Return the entries of one stage, derived once."""
    return tuple(STAGES[stage][1]())


def derive_paper(progress: Progress | None = None) -> Iterator[tuple[Entry, EquationVerdict]]:
    """Yield every entry of the paper with its verdict; ``progress`` is called with (done, all, name) at each stage."""
    for i, (name, _, _, _) in enumerate(STAGES):
        if progress:
            progress(i, len(STAGES), name)
        for entry in entries_of(i):
            yield entry, judge(entry)
    if progress:
        progress(len(STAGES), len(STAGES), "done")


def find_entries(wanted: str, progress: Progress | None = None) -> list[tuple[Entry, EquationVerdict]]:
    """Return one equation (with its parts) or one statement; only its stage is derived.

    Raises CaromError for a name that the paper does not have.
    """
    first, second, _ = order(wanted)
    for i, (name, _, numbers, section) in enumerate(STAGES):
        if (second not in numbers) if first == 0 else (section != first):
            continue
        if progress:
            progress(i, len(STAGES), name)
        found = [
            x for x in entries_of(i) if x.id == wanted or (wanted.isdigit() and re.fullmatch(rf"{wanted}[a-z]", x.id))
        ]
        if found:
            return [(x, judge(x)) for x in found]
    raise CaromError(
        f"equation: the paper has no {wanted}; expected 1 to 41, a part such as 41e, or a statement such as s4-1"
    )


def as_record(entry: Entry, verdict: EquationVerdict) -> dict[str, str]:
    """Return an entry as ``carom derive`` prints it in JSON."""
    said = [part for part in (verdict.sentence, entry.note) if part]
    return {
        "id": entry.id,
        "status": verdict.status,
        "printed": "; ".join(shown(r) for r in entry.printed),
        "derived": "; ".join(shown(r) for r in entry.derived),
        "title": entry.title,
        "note": ". ".join(s.rstrip(".") for s in said) + ("." if said else ""),
    }


# -- LaTeX ------------------------------------------------------------------------------------------------------------

_HEAD = r"""\documentclass[a4paper]{article}
\usepackage[margin=2cm]{geometry}
\usepackage{amsmath,amssymb,color,graphicx}
\definecolor{holds}{rgb}{0,0.45,0}
\definecolor{conditional}{rgb}{0.75,0.45,0}
\definecolor{misprint}{rgb}{0.75,0,0}
\allowdisplaybreaks
\setlength{\parindent}{0pt}
\begin{document}
\title{Dynamics of a billiard-ball's collision with wall: each equation derived}
\author{carom derive}\date{}
\maketitle
"""

_TEXT = str.maketrans(
    {letter: f"\\{letter}" for letter in "&%$#_{}"}
    | {"\\": r"\textbackslash{}", "~": r"\textasciitilde{}", "^": r"\textasciicircum{}"}
    | {"<": r"\textless{}", ">": r"\textgreater{}"}
)


def text(words: str) -> str:
    """Words as LaTeX text."""
    return words.translate(_TEXT)


def maths(thing: Any) -> str:
    """An expression, relation or matrix as displayed LaTeX, small enough for a page."""
    body = sp.latex(thing)
    if len(body) <= 160:
        return f"\\[{body}\\]\n"
    size = r"\footnotesize" if len(body) > 260 else r"\small"
    inner = rf"\resizebox{{\ifdim\width>\linewidth\linewidth\else\width\fi}}{{!}}{{$\displaystyle {body}$}}"
    return f"\\begin{{center}}{size} {inner}\\end{{center}}\n"


def as_tex(rows: Sequence[tuple[Entry, EquationVerdict]]) -> str:
    """A LaTeX document with the printed form, the derived form, the steps and the verdict of each entry."""
    lines = [_HEAD]
    for entry, verdict in sorted(rows, key=lambda row: order(row[0].id)):
        label = f"({entry.id})" if entry.id[0].isdigit() else entry.id
        lines.append(
            f"\\subsection*{{{text(label)} {text(entry.title)} "
            f"--- \\textcolor{{{verdict.status}}}{{{verdict.status}}}}}\n"
        )
        lines.append("Printed:\n" + "".join(maths(r) for r in entry.printed))
        lines.append("Derived:\n" + "".join(maths(r) for r in entry.derived))
        if not re.fullmatch(r"\d+[a-z]", entry.id):
            lines += [
                text(step.text) + "\n" + (maths(step.result) if step.result is not None else "\n")
                for step in entry.steps
            ]
        note = as_record(entry, verdict)["note"]
        if note:
            lines.append("\\emph{" + text(note) + "}\n\n")
    lines.append("\\end{document}\n")
    return "\n".join(lines)
