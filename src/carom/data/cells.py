"""Cells of text tables as numbers: the one reader that all tables share."""

from __future__ import annotations

from collections.abc import Collection, Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

__all__ = ["EMPTY", "MISSING", "ParsedCells", "parse_numbers"]

EMPTY = frozenset({""})
MISSING = frozenset({"", "nan", "na", "null", "-", "none"})  # as programs and people write that there is no number


class ParsedCells(NamedTuple):
    """A column of cells, as numbers."""

    values: NDArray[np.float64]
    """(n,); NaN where a cell is missing or no number."""
    bad: list[int]
    """Indices of the cells that are neither a number nor missing."""


def parse_numbers(
    cells: Sequence[str], *, decimal_comma: bool = False, missing: Collection[str] = MISSING
) -> ParsedCells:
    """Parse a column of cells as floats.

    Parameters
    ----------
    cells : sequence of n str
    decimal_comma : bool
        Whether a comma is a decimal sign; points remain decimal signs as well.
    missing : collection of str
        What a cell without a number may hold, in lower case and without blanks around it.

    Examples
    --------
    >>> parse_numbers(["1,5", "", "x"], decimal_comma=True)
    ParsedCells(values=array([1.5, nan, nan]), bad=[2])
    """
    if decimal_comma and any("," in cell for cell in cells):
        cells = [cell.replace(",", ".") for cell in cells]
    try:
        return ParsedCells(np.fromiter(map(float, cells), float, len(cells)), [])
    except ValueError:
        pass
    values, bad = np.full(len(cells), np.nan), []
    for k, cell in enumerate(cells):
        try:
            values[k] = float(cell)
        except ValueError:
            if cell.strip().lower() not in missing:
                bad.append(k)
    return ParsedCells(values, bad)
