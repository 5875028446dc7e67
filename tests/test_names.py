"""The table of names: generated, complete, and several names for a quantity only where a remark says why."""

from __future__ import annotations

from collections import Counter

import pytest
from dev import names

ROWS = [row for rows in names.ROWS.values() for row in rows]
LISTED = [name for row in ROWS for name in row.names.split()]


def test_the_page_is_made_of_todays_declarations() -> None:
    assert names.PAGE.read_text(encoding="utf-8") == names.page()  # else: python docs/dev/names.py


@pytest.mark.parametrize("source", list(names.declared()))
def test_every_declared_name_stands_in_one_row(source: str) -> None:
    known = names.declared()[source]
    assert not [name for name in known if name not in LISTED and name.split(".")[-1] not in names.CHOICES]


def test_every_name_is_declared_and_stands_once() -> None:
    known = {name for found in names.declared().values() for name in found}
    assert set(LISTED) <= known
    assert {name.split(".")[-1] for name in known} >= names.CHOICES
    assert max(Counter(LISTED).values()) == 1


def test_several_names_of_a_quantity_have_a_reason() -> None:
    assert [row.title for row in ROWS if len(names.names_of(row)) > 1 and not row.remark] == []
    assert sum(len(names.names_of(row)) > 1 and not row.family for row in ROWS) <= 4
