"""The sources of every card: authors, year, and journal, publisher or identifier; or the paper, of which no more is known."""

from __future__ import annotations

import re

import pytest

import carom
from carom.laws.law import PAPER
from carom.laws.registry import card_named

SOURCES = [(name, source.strip()) for name, card in carom.CARDS.items() for source in re.split(r";", card.citation)]
AUTHOR = re.compile(r"\b[A-Z]\.(-?[A-Z]\.| [A-Z]\.)* ?[A-Z][a-zé]+")
YEAR = re.compile(r"\b(1[89]|20)\d\d\b|\(undated\)")
# volume and pages, a publisher, or where it can be had
PLACE = re.compile(
    r"\b[A-Z]?\s?\d+, \d+(-\d+)? \(|Press|arXiv \d{4}\.\d{4,5}|doi 10\.|billiards\.colostate\.edu|preprint"
)
DOI = re.compile(r"10\.\d{4,9}/\S+")


@pytest.mark.parametrize(("name", "source"), SOURCES, ids=[f"{name}-{i}" for i, (name, _) in enumerate(SOURCES)])
def test_a_source_has_author_year_and_place(name: str, source: str) -> None:
    if PAPER in source or source.startswith("as a cushion in pooltool"):
        return
    assert AUTHOR.search(source), f"{name}: no author in {source!r}"
    assert YEAR.search(source), f"{name}: no year in {source!r}"
    assert PLACE.search(source), f"{name}: no journal, publisher or identifier in {source!r}"


@pytest.mark.parametrize("name", list(carom.CARDS))
def test_a_card_has_an_identifier_or_is_from_the_paper_alone(name: str) -> None:
    card = carom.CARDS[name]
    if card.doi:
        assert DOI.fullmatch(card.doi)
    elif "technical proof" in card.citation:
        assert re.search(r"TP [AB]\.\d+ .*billiards\.colostate\.edu", card.citation)
    else:
        assert PAPER in card.citation
        assert ";" not in card.citation


def test_no_card_speaks_of_the_paper_without_its_title() -> None:
    assert not [name for name, card in carom.CARDS.items() if "the paper" in card.citation.lower()]
    assert sum(PAPER in card.citation for card in carom.CARDS.values()) > 5


def test_a_card_is_found_by_the_other_names_of_its_law() -> None:
    assert card_named("marlow") is carom.CARDS["alciatore"]
