"""Laws fitted to the rows of each surface, ball or racket of one table by itself: ``carom.fit(by=...)``."""

from __future__ import annotations

from typing import Any

import numpy as np

from carom.data.rebounds import Rebounds
from carom.errors import CaromError, FaultList, shortened_list, suggestion
from carom.fitting.ranking import Ranking, fit_laws
from carom.fitting.setting import Setting

__all__ = ["RankingsBy", "fit_by"]


class RankingsBy(dict[str, Ranking]):
    """The ranking of laws for each value of a column, in the order of the table.

    Examples
    --------
    >>> from carom.fitting import RankingsBy
    >>> RankingsBy("surface").as_dict()
    {'by': 'surface', 'fits': {}, 'left_out': []}
    """

    def __init__(self, column: str) -> None:
        super().__init__()
        self.column = column
        self.left_out: list[str] = []
        """Values whose rows cannot be fitted, with the reason."""

    @property
    def notes(self) -> tuple[str, ...]:
        """Notes of all fits, each with the value."""
        own = [f"{value}: {note}" for value, ranking in self.items() for note in ranking.notes]
        return (*(f"left out: {text}" for text in self.left_out), *own)

    def as_dict(self) -> dict[str, Any]:
        """Return the rankings for JSON."""
        fits = {value: ranking.as_dict() for value, ranking in self.items()}
        return {"by": self.column, "fits": fits, "left_out": self.left_out}


def fit_by(
    rebounds: Rebounds, setting: Setting, laws: Any, column: str, *, forms: bool = False, **options: Any
) -> RankingsBy:
    """Fit laws to the rows of each value of a column; ``options`` as for :func:`carom.fitting.fit_laws`.

    ``forms``: whether functions of the impact are chosen for the parameters. Rows with an empty cell are a group of their own.

    Raises CaromError where the table has no such column, and where no value has rows that can be fitted.
    """
    if column not in rebounds.extra:
        known = list(rebounds.extra)
        hint = suggestion(column, known) if known else "there is none"
        faults = FaultList()
        faults.add("`by`", "an additional column of the table", repr(column), hint)
        faults.raise_if_any()
    cells = np.array([str(cell).strip() or f"(no {column})" for cell in rebounds.extra[column].tolist()])
    found = RankingsBy(column)
    for value in dict.fromkeys(cells.tolist()):
        try:
            ranking = fit_laws(rebounds.select(cells == value), setting, laws, **options)
            found[value] = ranking.with_forms() if forms else ranking
        except CaromError as error:
            found.left_out.append(f"{column} {value}: {shortened_list(list(map(str, error.faults)), 2)}")
    if not found:
        raise CaromError(*found.left_out)
    return found
