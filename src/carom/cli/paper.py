"""``carom derive``: derive the paper's equations and report which hold. ``carom figures``: redraw its Figures 1 to 3."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from carom.cli.console import out, working
from carom.cli.options import shared, wrote
from carom.cli.streams import json_text, say
from carom.errors import CaromError
from carom.files import require_library, require_writable, write_text
from carom.formatting import Listing

if TYPE_CHECKING:
    from carom.derive.paper import Entry, EquationVerdict

_STYLE = {"holds": "green", "conditional": "yellow", "misprint": "bold red"}


def derive(
    destination: Annotated[
        Path | None,
        typer.Argument(metavar="FILE", help="With --json or --tex: the file to write. Default: standard output."),
    ] = None,
    equation: Annotated[
        str | None,
        typer.Option(
            "--equation",
            "-e",
            help="Show one equation with all steps: a number (31), a part (41e) or a statement (s4-1).",
        ),
    ] = None,
    as_json: Annotated[bool, shared("json")] = False,
    as_tex: Annotated[bool, typer.Option("--tex", help="Print a LaTeX document with every step.")] = False,
) -> None:
    """Derive every equation of the paper and report which hold, which hold conditionally, and which are misprints."""
    require_library("sympy", "derive")
    if as_json and as_tex:
        raise CaromError("derive: --json and --tex exclude each other; give one of them")
    if destination is not None and not (as_json or as_tex):
        raise CaromError(f"derive: {destination}: a file to write goes with --json or --tex; give one of them")
    if destination is not None:
        require_writable(destination, (".json",) if as_json else (".tex",))  # before the derivation, which takes long
    from carom.derive import paper

    with working("deriving") as show:
        rows = list(paper.derive_paper(show)) if equation is None else paper.find_entries(equation.strip("()"), show)
    if as_json:
        records = [paper.as_record(entry, verdict) for entry, verdict in rows]
        _put(json_text({"equations": records}, ensure_ascii=False), destination)
    elif as_tex:
        _put(paper.as_tex(rows), destination)
    elif equation is None:
        _table(rows)
    else:
        _steps(rows)


def _put(text: str, destination: Path | None) -> None:
    if destination is None:
        sys.stdout.write(text)
        return
    write_text(destination, text)
    wrote(destination)


def _table(rows: list[tuple[Entry, EquationVerdict]]) -> None:
    """Print a table of verdicts, without the parts of an equation unless they are misprints."""
    from carom.derive import paper

    listed: list[tuple[str, ...]] = []
    styles: dict[int, str] = {}
    counts = dict.fromkeys(_STYLE, 0)
    for entry, verdict in rows:
        part = entry.id[0].isdigit() and entry.id[-1].isalpha()
        counts[verdict.status] += not part
        if part and verdict.status != "misprint":
            continue
        styles[len(listed)] = _STYLE[verdict.status]
        listed.append((entry.id, verdict.status, entry.title, paper.as_record(entry, verdict)["note"]))
    console = out()
    console.table(Listing(("", "verdict", "subject", "note"), listed), styles, fold=(1, 2, 3))
    total = ", ".join(f"{count} {name}" for name, count in counts.items())
    console.print(
        f"{sum(counts.values())} equations and statements: {total}. All steps of one: carom derive --equation 31"
    )


def _steps(rows: list[tuple[Entry, EquationVerdict]]) -> None:
    """Print entries with every step."""
    from carom.derive import paper
    from carom.derive.paper.ledger import shown

    console = out()

    def line(words: str, style: str = "") -> None:
        console.print(words, style=style, soft_wrap=True)

    def formulas(*things: Any) -> None:
        for thing in things:
            line(f"    {shown(thing)}")

    for i, (entry, verdict) in enumerate(rows):
        part = entry.id[0].isdigit() and entry.id[-1].isalpha()
        if part and i > 0:  # the equation itself has the steps; its parts need only their verdicts
            line(f"({entry.id})  {verdict.status}    {shown(entry.printed[0])}", _STYLE[verdict.status])
            continue
        line(f"({entry.id})  {entry.title}" if entry.id[0].isdigit() else f"{entry.id}  {entry.title}", "bold")
        line("  printed")
        formulas(*entry.printed)
        line("  steps")
        for step in entry.steps:
            if step.text:
                line(f"    {step.text}")
            if step.result is not None:
                formulas(step.result)
        line("  derived")
        formulas(*entry.derived)
        line(f"  verdict: {verdict.status}", _STYLE[verdict.status])
        if note := paper.as_record(entry, verdict)["note"]:
            line(f"  {note}")


def figures(
    out: Annotated[
        Path, typer.Option("--out", metavar="DIR", help="Folder to write to; created if it does not exist.")
    ] = Path(),
) -> None:
    """Redraw the paper's Figures 1 to 3 as SVG and PDF."""
    from carom import plot

    for path in plot.figures(out):
        say(str(path))
