"""``carom laws``: assumptions, range of validity and source of each law.

``carom datasets``: list the published tables that come with carom, print one, or write it to a file.
"""

from __future__ import annotations

import sys
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from carom.cli.console import err
from carom.cli.options import require_outputs, shared, wrote
from carom.cli.streams import say_json
from carom.errors import CaromError, FaultList

if TYPE_CHECKING:
    from carom.laws.law import Card


def laws(
    name: Annotated[str | None, typer.Argument(metavar="NAME", help="Name of a law, to print its full card.")] = None,
    as_json: Annotated[bool, shared("json")] = False,
) -> None:
    """List the laws, or print one law's card: assumptions, range of validity, source; and whether two balls may meet by it."""
    from dataclasses import asdict

    from carom.laws.registry import CARDS, card_named, laws_of_pairs

    cards = [card_named(name)] if name is not None else list(CARDS.values())
    if as_json:
        facts = [asdict(card) | {"for_pairs": card.name in laws_of_pairs()} for card in cards]
        shown = facts[0] if name is not None else {"laws": facts}
        say_json(shown, ensure_ascii=False)
    elif name is not None:
        _card(cards[0])
    else:
        _table(cards)


def _table(cards: list[Card]) -> None:
    from rich import box
    from rich.table import Table
    from rich.text import Text

    from carom.cli.console import out
    from carom.laws.registry import laws_of_pairs

    pairs = laws_of_pairs()
    table = Table(box=box.SIMPLE_HEAD, pad_edge=False, header_style="bold")
    table.add_column("law", no_wrap=True, style="bold")
    table.add_column("model", overflow="fold")
    table.add_column("valid for", overflow="fold")
    for i, card in enumerate(cards):
        name = Text.assemble(card.name, ("\nalso of pairs", "dim not bold") if card.name in pairs else "")
        table.add_row(name, Text(card.summary), Text(_first_sentence(card.valid)), end_section=i == len(cards) - 1)
        if i < len(cards) - 1:
            table.add_row()
    console = out()
    console.print(table)
    console.print(Text("Assumptions, range of validity and source of one law: carom laws NAME"))


def _first_sentence(text: str) -> str:
    return text.split(". ", maxsplit=1)[0].removesuffix(".") + "."


def _card(card: Card) -> None:
    from rich.table import Table
    from rich.text import Text

    from carom.cli.console import out
    from carom.laws.registry import laws_of_pairs

    table = Table.grid(padding=(0, 2))
    table.add_column(no_wrap=True, style="bold")
    table.add_column(overflow="fold")
    table.add_row("law", Text(card.name, style="bold"))
    table.add_row("model", Text(card.summary))
    for i, assumption in enumerate(card.assumptions):
        table.add_row("" if i else "assumes", Text(f"- {assumption}"))
    table.add_row("valid for", Text(card.valid))
    if card.name in laws_of_pairs():
        table.add_row(
            "two balls",
            Text(f"by it in scenes, ball_contact.law = {card.name!r}, and carom.collide(law={card.name!r})"),
        )
    table.add_row("equations", Text(card.equations))
    table.add_row("source", Text(card.citation))
    if card.doi:
        table.add_row("doi", Text(f"https://doi.org/{card.doi}"))
    out().print(table)


def datasets(
    name: Annotated[str | None, typer.Argument(help="Name of a table. Default: list all.")] = None,
    out: Annotated[Path | None, typer.Option(help="Write the table to this file.")] = None,
    json_: Annotated[bool, shared("json")] = False,
) -> None:
    """List the published measurements that come with carom, print one, or write it to a file."""
    from carom.data.datasets import load, names

    if name is None and out is not None:
        raise CaromError(
            f"--out {out}: expected the name of a table before it, got none; known are {', '.join(names())}"
        )
    faults = FaultList()
    require_outputs(faults, {"--out": out}, {"--out": (".csv", ".txt")})
    faults.raise_if_any()
    chosen = [load(one) for one in (names() if name is None else [name])]
    if json_:
        cards = [
            {key: str(getattr(one, key)) for key in ("name", "title", "citation", "doi", "notes", "path")}
            for one in chosen
        ]
        say_json(cards if name is None else cards[0], ensure_ascii=False)
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
    console = err()
    console.print(f"{one.citation}{' doi ' + one.doi if one.doi else ''}", soft_wrap=True)
    console.print(one.notes, style="dim", soft_wrap=True)
    if out is not None:
        wrote(out)


def _list(chosen: list[Any]) -> None:
    from rich.table import Table
    from rich.text import Text

    from carom.cli.console import out

    table = Table(box=None, padding=(0, 2, 0, 0), show_header=False)
    for one in chosen:
        table.add_row(Text(one.name, "bold"), Text.assemble(f"{one.title}\n", (one.citation, "dim")))
    out().print(table)
