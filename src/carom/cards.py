"""Every card there is: of the laws one can ask by name, of what they are made of, and of ball against ball."""

from __future__ import annotations

from carom.checks import expect, meant
from carom.errors import CaromError
from carom.law import LAWS
from carom.laws.card import Card
from carom.laws.simultaneous import CARD as WALL_AND_FLOOR
from carom.pairs import DOMENECH

__all__ = ["CARDS", "card_named"]

CARDS: dict[str, Card] = {card.name: card for card in (*(law.card for law in LAWS.values()), WALL_AND_FLOOR, DOMENECH)}


def card_named(name: str) -> Card:
    """The card of a law by name; CaromError with the nearest name where there is none."""
    expect("card_named", "name", name, str)
    if name not in CARDS:
        raise CaromError(f"law: expected one of {', '.join(CARDS)}, got {name!r}{meant(name, list(CARDS))}")
    return CARDS[name]
