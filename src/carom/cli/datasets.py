"""``carom datasets``: the tables that come with carom, listed, printed or written to a file."""

from __future__ import annotations

import json
import sys
from pathlib import Path
from typing import Annotated, Any

import typer
from rich.console import Console

from carom.cli.shared import wrote
from carom.errors import CaromError


def register(app: typer.Typer) -> None:
    """Add the verb."""
    app.command()(datasets)


def datasets(
    name: Annotated[str | None, typer.Argument(help="left out: the list of them")] = None,
    out: Annotated[Path | None, typer.Option(help="write the table to this file")] = None,
    json_: Annotated[bool, typer.Option("--json", help="as JSON on standard output")] = False,
) -> None:
    """Published measurements that come with carom: list them, print one, or write it to a file."""
    from carom.datasets import load, names
    from carom.files import require_place

    if name is None and out is not None:
        raise CaromError(
            f"--out {out}: expected the name of a table before it, got none; known are {', '.join(names())}"
        )
    if out is not None:
        require_place(out, (".csv", ".txt"))
    chosen = [load(one) for one in (names() if name is None else [name])]
    if json_:
        cards = [
            {key: str(getattr(one, key)) for key in ("name", "title", "citation", "doi", "notes", "path")}
            for one in chosen
        ]
        print(json.dumps(cards if name is None else cards[0], indent=2, ensure_ascii=False))  # noqa: T201
    if name is None:
        if not json_:
            _list(chosen)
        return
    one = chosen[0]
    if out is not None:
        one.to_csv(out)
    elif not json_:
        sys.stdout.write(one.path.read_text(encoding="utf-8"))
        sys.stdout.flush()
    console = Console(stderr=True, highlight=False)
    console.print(f"{one.citation}{' doi ' + one.doi if one.doi else ''}", markup=False, soft_wrap=True)
    console.print(one.notes, markup=False, style="dim", soft_wrap=True)
    if out is not None:
        wrote(out)


def _list(chosen: list[Any]) -> None:
    from rich.table import Table

    table = Table(box=None, padding=(0, 2, 0, 0), show_header=False)
    for one in chosen:
        table.add_row(f"[bold]{one.name}[/]", f"{one.title}\n[dim]{one.citation}[/]")
    Console(highlight=False).print(table)
