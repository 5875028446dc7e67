"""Laws fitted to the rows of each surface, ball or racket of one table by itself: ``carom.fit(by=...)``."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np

from carom.data.rebounds import Rebounds
from carom.errors import CaromError, FaultList, shortened_list, suggestion
from carom.fitting.population import Population, fit_population
from carom.fitting.ranking import Ranking, fit_laws
from carom.fitting.setting import Setting

__all__ = ["RankingsBy", "fit_by"]


USABLE = ("where", "sigma_v", "sigma_spin", "spin", "every_contact")


class RankingsBy(dict[str, Ranking]):
    """The ranking of laws for each value of a column, in the order of the table.

    Examples
    --------
    >>> from carom.fitting import RankingsBy
    >>> RankingsBy("surface").as_dict()
    {'by': 'surface', 'fits': {}, 'left_out': [], 'population': None}
    """

    def __init__(self, column: str) -> None:
        super().__init__()
        self.column = column
        self.left_out: list[str] = []
        """Values whose rows cannot be fitted, with the reason."""
        self.population: Population | None = None
        """The common distribution of the numbers of the law that fits all values best, where it was asked for."""

    @property
    def notes(self) -> tuple[str, ...]:
        """Notes of all fits, each with the value."""
        own = [f"{value}: {note}" for value, ranking in self.items() for note in ranking.notes]
        return (*(f"left out: {text}" for text in self.left_out), *own)

    def as_dict(self) -> dict[str, Any]:
        """Return the rankings for JSON."""
        fits = {value: ranking.as_dict() for value, ranking in self.items()}
        return {"by": self.column, "fits": fits, "left_out": self.left_out,
                "population": None if self.population is None else self.population.as_dict()}  # fmt: skip


def fit_by(
    rebounds: Rebounds, setting: Setting, laws: Any, column: str, *, forms: bool = False, population: bool = False,
    **options: Any,
) -> RankingsBy:  # fmt: skip
    """Fit laws to the rows of each value of a column; ``options`` as for :func:`carom.fitting.fit_laws`.

    ``forms``: whether functions of the impact are chosen for the parameters; ``population``: whether the numbers of the law with
    the least sum of AICc are fitted with a common distribution (:func:`carom.fitting.fit_population`). Rows with an empty cell are
    a group of their own.

    Raises CaromError where the table has no such column, where no value has rows that can be fitted, and as ``fit_population``.
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
    if population:
        rows = rebounds.select(np.isin(cells, list(found)))
        rows = replace(rows, extra=rows.extra | {column: cells[np.isin(cells, list(found))]})
        usable = {name: options[name] for name in USABLE if name in options}
        found.population = fit_population(rows, setting, column, _best_of_all(found), **usable)
    return found


def _best_of_all(rankings: RankingsBy) -> str:
    """Return the law with the least sum of AICc, of those that were fitted to the rows of every value."""
    each = [{one.fit.law.name: one.fit.aicc for one in ranking.ranked} for ranking in rankings.values()]
    return min(set.intersection(*map(set, each)), key=lambda law: sum(aicc[law] for aicc in each))
