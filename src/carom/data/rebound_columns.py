"""Measured rebounds from a table in memory: a dict of arrays, a data frame, a structured array."""

from __future__ import annotations

from typing import Any

import numpy as np

from carom.data.columns import as_columns
from carom.data.rebound_files import Numbers, rebounds_of_columns
from carom.data.rebounds import Kind, Rebounds
from carom.errors import FaultList

__all__ = ["as_rebounds"]


def as_rebounds(
    table: Any, kind: Kind | None = None, stage: str | None = None, ball: tuple[float, float] | None = None
) -> Rebounds:
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
    columns = as_columns(table, "rebounds")
    headers, every = list(columns), list(columns.values())

    def number(i: int, header: str) -> Numbers:
        try:
            return np.asarray(every[i], dtype=float), None
        except (TypeError, ValueError):
            faults.add(f"column {header!r}", "numbers", f"{every[i].tolist()[0]!r:.40}")
        return np.full(len(every[i]), np.nan), None

    rows = [f"row {i + 1}" for i in range(len(every[0]) if every else 0)]
    return rebounds_of_columns(
        headers, lambda i: every[i].astype(str).tolist(), number, rows, kind, stage, faults, "rebounds", ball
    )
