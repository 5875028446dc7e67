"""``carom derive``: the paper, equation by equation: printed, derived, verdict."""

from __future__ import annotations

import importlib.util
import json
import sys
from collections.abc import Callable
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from carom.cli.shared import wrote
from carom.errors import CaromError
from carom.files import require_place, whole

if TYPE_CHECKING:
    from collections.abc import Iterator

    from carom.derive.paper import Entry, Verdict

_STYLE = {"holds": "green", "conditional": "yellow", "misprint": "bold red"}


def register(app: typer.Typer) -> None:
    """Add the verb to the command."""
    app.command("derive")(derive)


def derive(
    destination: Annotated[
        Path | None,
        typer.Argument(metavar="[FILE]", help="With --json or --tex: write there and not to standard output."),
    ] = None,
    equation: Annotated[
        str | None,
        typer.Option("--equation", "-e", help="One equation with all steps: 31, a part as 41e, a statement as s4-1."),
    ] = None,
    as_json: Annotated[bool, typer.Option("--json", help="JSON on standard output, nothing else.")] = False,
    as_tex: Annotated[bool, typer.Option("--tex", help="A LaTeX document with every step.")] = False,
) -> None:
    """Derive every equation of the paper and say which hold, which hold under a condition, and which are misprints."""
    if importlib.util.find_spec("sympy") is None:
        raise CaromError("derive: needs SymPy, which is not installed; run: pip install sympy")
    if as_json and as_tex:
        raise CaromError("derive: --json and --tex exclude each other; give one")
    if destination is not None and not (as_json or as_tex):
        raise CaromError(f"derive: a file to write ({destination}) goes with --json or --tex; give one of them")
    if destination is not None:
        require_place(destination, (".json",) if as_json else (".tex",))  # now: deriving takes half a minute
    from carom.derive import paper

    with _progress() as tell:
        rows = list(paper.derive_paper(tell)) if equation is None else paper.find_entries(equation.strip("()"), tell)
    if as_json:
        records = [paper.as_record(entry, verdict) for entry, verdict in rows]
        _put(json.dumps({"equations": records}, indent=2, ensure_ascii=False) + "\n", destination)
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
    with whole(destination) as part:
        part.write_text(text, encoding="utf-8")
    wrote(destination)


@contextmanager
def _progress() -> Iterator[Callable[[str, int, int], None]]:
    """A bar on standard error; it leaves nothing behind."""
    from rich.console import Console
    from rich.progress import BarColumn, Progress, TextColumn, TimeElapsedColumn

    console = Console(stderr=True)
    columns = (TextColumn("{task.description:<34}"), BarColumn(), TimeElapsedColumn())
    with Progress(*columns, console=console, transient=True) as bar:
        task = bar.add_task("starting", total=None)

        def tell(name: str, done: int, total: int) -> None:
            bar.update(task, description=name, completed=done, total=total)
            if not console.is_terminal:
                console.print(f"derive: {done}/{total} {name}", highlight=False, markup=False)

        yield tell


def _table(rows: list[tuple[Entry, Verdict]]) -> None:
    """Verdicts at a glance; the parts of an equation that holds as a whole are left out."""
    from rich.console import Console
    from rich.table import Table
    from rich.text import Text

    from carom.derive import paper

    table = Table(title="The paper, derived line by line", title_justify="left", row_styles=["", "dim"])
    for name in ("", "verdict", "what it is", "note"):
        table.add_column(name, overflow="fold", no_wrap=name == "verdict")
    counts = dict.fromkeys(_STYLE, 0)
    for entry, verdict in rows:
        part = entry.id[0].isdigit() and entry.id[-1].isalpha()
        counts[verdict.status] += not part
        if part and verdict.status != "misprint":
            continue
        record = paper.as_record(entry, verdict)
        table.add_row(
            entry.id, Text(verdict.status, style=_STYLE[verdict.status]), Text(entry.title), Text(record["note"])
        )
    console = Console()
    console.print(table)
    total = ", ".join(f"{count} {name}" for name, count in counts.items())
    console.print(
        Text(
            f"{sum(counts.values())} equations and statements: {total}. One with its steps: carom derive --equation 31"
        )
    )


def _steps(rows: list[tuple[Entry, Verdict]]) -> None:
    """Entries with every step."""
    from rich.console import Console
    from rich.text import Text

    from carom.derive import paper
    from carom.derive.paper.ledger import shown

    console = Console(highlight=False)

    def line(words: str, style: str = "") -> None:
        console.print(Text(words, style=style), soft_wrap=True)

    def formulas(things: tuple[Any, ...]) -> None:
        for thing in things:
            line(f"    {shown(thing)}")

    for i, (entry, verdict) in enumerate(rows):
        part = entry.id[0].isdigit() and entry.id[-1].isalpha()
        if part and i > 0:  # the whole has the steps; its lines need their verdicts only
            line(f"({entry.id})  {verdict.status}    {shown(entry.printed[0])}", _STYLE[verdict.status])
            continue
        line(f"({entry.id})  {entry.title}" if entry.id[0].isdigit() else f"{entry.id}  {entry.title}", "bold")
        line("  printed")
        formulas(entry.printed)
        line("  steps")
        for step in entry.steps:
            if step.text:
                line(f"    {step.text}")
            if step.result is not None:
                formulas((step.result,))
        line("  derived")
        formulas(entry.derived)
        line(f"  verdict: {verdict.status}", _STYLE[verdict.status])
        note = paper.as_record(entry, verdict)["note"]
        if note:
            line(f"  {note}")
