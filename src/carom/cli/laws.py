"""``carom laws``: what each law assumes, when it is valid, where it comes from."""

from __future__ import annotations

import json
import sys
from typing import TYPE_CHECKING, Annotated

import typer

if TYPE_CHECKING:
    from carom.laws.card import Card


def register(app: typer.Typer) -> None:
    """Add the verb to the command."""
    app.command("laws")(laws)


def laws(
    name: Annotated[str | None, typer.Argument(metavar="[NAME]", help="One law, with all that its card says.")] = None,
    as_json: Annotated[bool, typer.Option("--json", help="JSON on standard output, nothing else.")] = False,
) -> None:
    """List the laws, or print one law's card: assumptions, when it is valid, source."""
    from dataclasses import asdict

    from carom.cards import CARDS, card_named

    cards = [card_named(name)] if name is not None else list(CARDS.values())
    if as_json:
        told = [asdict(card) for card in cards]
        shown = told[0] if name is not None else {"laws": told}
        sys.stdout.write(json.dumps(shown, indent=2, ensure_ascii=False) + "\n")
    elif name is not None:
        _card(cards[0])
    else:
        _table(cards)


def _table(cards: list[Card]) -> None:
    from rich import box
    from rich.table import Table
    from rich.text import Text

    from carom.cli.shared import out

    table = Table(box=box.SIMPLE_HEAD, pad_edge=False, header_style="bold")
    table.add_column("law", no_wrap=True, style="bold")
    table.add_column("what it says", overflow="fold")
    table.add_column("when to use it", overflow="fold")
    for i, card in enumerate(cards):
        table.add_row(card.name, Text(card.summary), Text(card.valid), end_section=i == len(cards) - 1)
        if i < len(cards) - 1:
            table.add_row()
    console = out()
    console.print(table)
    console.print(Text("One law with its assumptions and source: carom laws NAME"))


def _card(card: Card) -> None:
    from rich.table import Table
    from rich.text import Text

    from carom.cli.shared import out

    table = Table.grid(padding=(0, 2))
    table.add_column(no_wrap=True, style="bold")
    table.add_column(overflow="fold")
    table.add_row("law", Text(card.name, style="bold"))
    table.add_row("says", Text(card.summary))
    for i, assumption in enumerate(card.assumptions):
        table.add_row("" if i else "assumes", Text(f"- {assumption}"))
    table.add_row("valid", Text(card.valid))
    table.add_row("equations", Text(card.equations))
    table.add_row("source", Text(card.citation))
    if card.doi:
        table.add_row("doi", Text(f"https://doi.org/{card.doi}"))
    out().print(table)
