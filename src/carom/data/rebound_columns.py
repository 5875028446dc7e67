"""Measured rebounds from a table in memory: a dict of arrays, a data frame, a structured array."""

from __future__ import annotations

from typing import Any

import numpy as np

from carom.data.columns import as_columns
from carom.data.headers import missing_unit
from carom.data.rebounds import NAMED, Kind, Rebounds, kind_of_columns, make_rebounds
from carom.errors import FaultList

__all__ = ["as_rebounds"]


def as_rebounds(table: Any, kind: Kind | None = None, stage: str | None = None) -> Rebounds:
    """Return measured rebounds of columns in memory, with names and units as in a file (:func:`carom.data.read_rebounds`).

    Raises CaromError with all problems of the columns.

    Examples
    --------
    >>> as_rebounds({"v_n_in_mm_s": [1500.0], "v_t_in": [0.5], "v_n_out": [1.2], "spin_in": [0.0]})["v_n_in"]
    array([1.5])
    """
    if isinstance(table, Rebounds):
        return table
    faults = FaultList("rebounds")
    measured: dict[str, Any] = {}
    extra: dict[str, Any] = {}
    stages: Any = stage
    columns = as_columns(table, "rebounds")
    for header, column in columns.items():
        meaning = NAMED.parse(header)
        if header.strip().lower() == "stage":
            stages = column.astype(str) if stage is None else stage
        elif meaning is None:
            extra[header.strip()] = column.astype(str)
        elif meaning.unit is None:
            faults.append(missing_unit("rebounds", header, meaning))
        elif meaning.quantity in measured:
            faults.add(f"column {header!r}", f"one column for {meaning.quantity}", "two")
        else:
            try:
                measured[meaning.quantity] = meaning.unit.to_si(np.asarray(column, dtype=float))
            except (TypeError, ValueError):
                faults.add(f"column {header!r}", "numbers", f"{column.tolist()[0]!r:.40}")
    kind = kind or kind_of_columns(measured, stages is not None, list(columns), faults)
    faults.raise_if_any()
    return make_rebounds(kind, measured, stage=None if kind == "planar" else stages, extra=extra)
