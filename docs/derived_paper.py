"""The equations of the paper with their verdicts, for the pages that show them: derived once in a build, not once a page."""

from __future__ import annotations

import fcntl
import json
import os
import re
from functools import cache
from html import escape
from itertools import zip_longest
from pathlib import Path
from typing import Any

import sympy as sp

from carom.derive import paper
from carom.files import write_text


@cache
def records() -> list[dict[str, Any]]:
    """Return every entry as ``carom derive --json`` prints it, in the order of the derivation.

    Each has its ``section`` as well, and its lines as LaTeX in ``printed_tex`` and ``derived_tex``.
    """
    shared = os.environ.get("CAROM_DOCS_SHARED")  # a folder of this build (conf.py)
    if not shared:
        return _derived()
    file = Path(shared) / "paper.json"
    with open(Path(shared) / "paper.lock", "w") as lock:  # one page derives them, another one waits
        fcntl.flock(lock, fcntl.LOCK_EX)
        if not file.exists():
            write_text(file, json.dumps(_derived()))
        found: list[dict[str, Any]] = json.loads(file.read_text(encoding="utf-8"))
        return found


SIGNS = {
    r"\bdelta_varphi\b": "δφ",
    r"\bdelta_psi\b": "δψ",
    r"\bdelta_theta\b": "δθ",
    r"\b(d?)varphi\b": "\\1φ", r"\b(d?)psi\b": "\\1ψ", r"\b(d?)theta\b": "\\1θ", r"\bomega_([xyz]\d?)": "ω_\\1", r"\bomega\b": "ω",
    r"\bkappa\b": "κ", r"\bbeta\b": "β", r"\bmu\b": "μ", r"\bpi\b": "π", r"\bDelta\b": "Δ",
    r"\b(d?)thetadot": "\\1θ̇", r"\b(d?)varphidot": "\\1φ̇", r"\b(d?)psidot": "\\1ψ̇",
    r"\bxdot": "ẋ", r"\bydot": "ẏ", r"\bzdot": "ż", r"\*\*2": "²", r"\*\*3": "³", r"\^2": "²", r"(?<=[\w)])\*(?=[\w(])": " ",
    r"->": "→", r"\bsqrt\(": "√(",
}  # fmt: skip


def in_signs(words: str) -> str:
    """Return a sentence with Greek letters, dots, powers, roots and indices as signs, for HTML."""
    for pattern, sign in SIGNS.items():
        words = re.sub(pattern, sign, words)
    return re.sub(r"(?<=[\wω])_([A-Za-z0-9]+)", r"<sub>\1</sub>", escape(words))


def side_by_side(entry: dict[str, Any]) -> str:
    """Return an entry as HTML that MathJax typesets: each line of the paper beside the derived one, and below both the note."""
    number = (
        f"({entry['id']})" if entry["id"][0].isdigit() else f"section {entry['id'][1:].replace('-', ', statement ')}"
    )
    head = f"<a href='#eq-{entry['id']}'>{number}</a> {in_signs(entry['title'])}: <strong>{entry['status']}</strong>"
    rows = ["<span class='side'>the paper</span>", "<span class='side'>derived</span>"]
    for pair in zip_longest(entry["printed_tex"], entry["derived_tex"], fillvalue=""):
        typeset = [escape(rf"\[{line}\]") if line else "" for line in pair]
        rows += [f"<div class='math'>{line}</div>" for line in typeset]
    return (
        f"<div class='verdict' id='eq-{entry['id']}'><p>{head}</p>"
        f"<div class='lines'>{''.join(rows)}</div><p>{in_signs(entry['note'])}</p></div>"
    )


def tables(*sections: int) -> str:
    """Return the equations of some sections as HTML; a part that holds is shown in its equation only."""
    shown = [
        one
        for one in records()
        if one["section"] in sections and (one["status"] == "misprint" or not re.fullmatch(r"\d+[a-z]", one["id"]))
    ]
    return "".join(map(side_by_side, shown))


def _of_named_quantities(tex: str) -> str:
    """Return LaTeX in which symbols that are named after what they stand for are set as that."""
    for name, sign in (
        ("dvarphi/dtheta", r"d\varphi/d\theta"),
        ("dpsi/dtheta", r"d\psi/d\theta"),
        (r"tan_{\tau i}", r"\tan\tau_i"),
        (r"tan_{\tau r}", r"\tan\tau_r"),
        (r"\tau_{r deg}", r"\tau_r/1^\circ"),
        ("r_{closure}", r"r_\mathrm{closure}"),
    ):
        tex = tex.replace(name, sign)
    return tex


def lines(entry: paper.Entry) -> dict[str, list[str]]:
    """Return the lines of an entry as LaTeX."""
    return {
        name: [_of_named_quantities(sp.latex(line)) for line in some]
        for name, some in (("printed_tex", entry.printed), ("derived_tex", entry.derived))
    }


def _derived() -> list[dict[str, Any]]:
    return [
        {"section": section, **paper.as_record(entry, paper.judge(entry)), **lines(entry)}
        for _, build, _, section in paper.STAGES
        for entry in build()
    ]
