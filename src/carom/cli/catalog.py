"""``carom laws``: assumptions, range of validity and source of each law.

``carom datasets``: list the published tables that come with carom, print one, or write it to a file.
"""

from __future__ import annotations

import sys
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from carom.cli.console import err
from carom.cli.console import out as stdout
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
    from carom.formatting import Listing
    from carom.laws.registry import laws_of_pairs

    rows: list[tuple[str, str, str]] = []
    for card in cards:
        name = f"{card.name}\nalso of pairs" if card.name in laws_of_pairs() else card.name
        valid = card.valid.split(". ", maxsplit=1)[0].removesuffix(".")
        rows += [(name, card.summary, f"{valid}."), ("", "", "")]
    stdout().table(Listing(("law", "model", "valid for"), rows[:-1]), fold=(1, 2))
    stdout().print("Assumptions, range of validity and source of one law: carom laws NAME")


def _card(card: Card) -> None:
    from carom.laws.registry import laws_of_pairs

    pairs = f"by it in scenes, ball_contact.law = {card.name!r}, and carom.collide(law={card.name!r})"
    assumed = "\n".join(f"- {one}" for one in card.assumptions)
    rows = {
        "law": card.name, "model": card.summary, "assumes": assumed, "valid for": card.valid,
        "two balls": pairs if card.name in laws_of_pairs() else "", "equations": card.equations, "source": card.citation,
        "doi": card.doi and f"https://doi.org/{card.doi}",
    }  # fmt: skip
    stdout().facts((name, text) for name, text in rows.items() if text)


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
        keys = ("name", "title", "citation", "doi", "notes", "path")
        cards = [{key: str(getattr(one, key)) for key in keys} for one in chosen]
        say_json(cards if name is None else cards[0], ensure_ascii=False)
    elif name is None:
        stdout().facts((one.name, f"{one.title}\n{one.citation}") for one in chosen)
    if name is None:
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
