"""Units: one table for columns and for texts, which pint confirms, to the last bit where factors are exact."""

from __future__ import annotations

import pytest

from carom.core import units
from carom.core.random import added
from carom.core.units import UNITS, Unit, parse_quantity, unit_named

SI = {dimension: name for name, dimension in units._DIMENSION_OF.items()} | {"angle": "rad"}
TABLE = [
    (SI[dimension], unit) for dimension, known in UNITS.items() if dimension != "number" for unit in known.values()
]


@pytest.mark.parametrize(("si", "unit"), TABLE, ids=[f"{si}: {unit.name}" for si, unit in TABLE])
def test_the_table_is_what_pint_says(si: str, unit: Unit, monkeypatch: pytest.MonkeyPatch) -> None:
    texts = [f"{number} {unit.name}" for number in ("61.5", "-1e-7", "0.1", "1_000.25", "3e99", "7")]
    found = [parse_quantity(text, si) for text in texts]
    monkeypatch.setattr(units, "_DIMENSION_OF", {})
    assert [parse_quantity(text, si) for text in texts] == found
    assert unit.to_si(7.0) == pytest.approx(found[-1], rel=1e-15)
    assert unit.from_si(unit.to_si(7.0)) == pytest.approx(7.0, rel=1e-15)


@pytest.mark.parametrize(
    ("text", "si", "number"),
    [("61.5 mm", "m", 0.0615), ("2.25in", "m", 0.05715), ("1e-3 m", "m", 1e-3), ("9.81 m/s^2", "m/s^2", 9.81)],
)
def test_a_text_is_the_float_next_to_it(text: str, si: str, number: float) -> None:
    assert parse_quantity(text, si) == number


@pytest.mark.parametrize(
    ("text", "reason"),
    [
        ("0.03", "^$"),
        ("mm", "^$"),
        ("3 kg", "another quantity"),
        ("3 mn", "not a known unit"),
        ("1 2 mm", "not a known unit"),
    ],
)
def test_what_is_no_length(text: str, reason: str) -> None:
    with pytest.raises(ValueError, match=reason):
        parse_quantity(text, "m")


def test_spellings() -> None:
    for text in ("rad/s", " rad s^-1", "1/s", "s^-1"):
        assert unit_named(text, "spin") is UNITS["spin"]["rad_s"]
    assert unit_named("", "number") is UNITS["number"][""]
    assert unit_named("mm", "mass") is None


def test_sums_have_the_same_bits_in_every_python() -> None:
    assert added([1.0, 1e100, 1.0, -1e100]) == 0.0  # (2 by the built-in sum from 3.12 on)
    assert added(iter([2, 3])) == 5
