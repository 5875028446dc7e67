"""Rows of a table whose columns have given values: ``where`` of a fit, in Python and on the command line."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from carom.errors import FaultList, did_you_mean, shortened_list, suggestion

Where = str | Sequence[str] | Mapping[str, Any]
"""Conditions that a row has to meet, all of them: ``"racket=smooth"``, several of these, or ``{"racket": "smooth"}``."""


def rows_where(
    columns: Mapping[str, ArrayLike], where: Where, count: int, expected: str = "an additional column of the table"
) -> NDArray[np.bool_]:
    """Return which of ``count`` rows have the given values in their columns; values are compared as text.

    Raises CaromError with one line per condition that names no column, or a value that the column does not have, and where no row
    meets all conditions. ``expected`` says which columns there may be.

    Examples
    --------
    >>> rows_where({"racket": ["smooth", "rough", "smooth"]}, "racket=smooth", 3)
    array([ True, False,  True])
    """
    if isinstance(where, str):
        where = [where]
    texts = [f"{name}={value}" for name, value in where.items()] if isinstance(where, Mapping) else list(where)
    faults = FaultList()
    keep = np.ones(count, bool)
    for text in texts:
        name, _equals, value = text.partition("=")
        if name not in columns:
            hint = suggestion(name, list(columns)) if columns else "there is none"
            faults.add("`where`", f"COLUMN=VALUE, with {expected}", repr(text), hint)
            continue
        cells = np.asarray(columns[name]).astype(str)
        rows = cells == value
        if not rows.any():
            known = list(dict.fromkeys(sorted(cells.tolist())))
            wanted = f"one of its values ({shortened_list([one or 'an empty text' for one in known])})"
            faults.add(f"`where` {name}", wanted, repr(value), did_you_mean(value, known))
        keep &= rows
    if not faults and not keep.any():
        faults.add("`where`", "conditions that some rows meet", "none that meet all of them")
    faults.raise_if_any()
    return keep


def kinds_note(columns: Mapping[str, NDArray[Any]], count: int) -> list[str]:
    """Return a note for each column of words that divides ``count`` rows into a few kinds, which a fit takes together."""
    notes = []
    for name, column in columns.items():
        values = sorted(set(column.tolist()))
        if 1 < len(values) <= count // 5 and is_of_words(values):
            named = ", ".join(map(str, values[:4])) + (", ..." if len(values) > 4 else "")
            notes.append(
                f"{name}: {len(values)} kinds of rows are fitted together ({named}); `where` {name}={values[0]} selects one"
                " of them"
            )
    return notes


def is_of_words(cells: Sequence[Any]) -> bool:
    """Return whether a column holds names, not numbers; empty cells are neither."""
    try:
        _numbers = [float(cell) for cell in cells if str(cell).strip()]
    except (TypeError, ValueError):
        return True
    return False
