"""Error bars of what all rows may have wrong together: an axis that was set wrongly, a scale, a camera that leans.

Rows do not scatter by it, so no chi^2 shows it and no number of rows averages it away. The fit is done again with one standard
error of each such thing put in; how far the numbers move, added in quadrature, is what it may have done to them.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from carom.fitting.data import make_problem
from carom.fitting.fit import Fit, parameters_of, refit
from carom.fitting.rank import Ranking
from carom.rebounds import Rebounds

__all__ = ["with_shared"]


def with_shared(ranking: Ranking, shifted: Sequence[tuple[str, Rebounds]]) -> Ranking:
    """A ranking whose estimates have ``shared``; ``shifted``: the same rows with one such error in each, in words before."""
    if not shifted:
        return ranking
    ranked = tuple(replace(one, fit=_moved(one.fit, shifted)) for one in ranking.ranked)
    note = f"what all rows may have wrong together ({', '.join(words for words, _rows in shifted)}) is the second error bar"
    return replace(ranking, ranked=ranked, notes=(*ranking.notes, note))


def _moved(fit: Fit, shifted: Sequence[tuple[str, Rebounds]]) -> Fit:
    free, _start, _form = parameters_of(fit.law, fit.problem)
    places = [place for place, _parameter in free.values()]
    moves = np.zeros((len(shifted), len(places)))
    for move, (_words, rebounds) in zip(moves, shifted, strict=True):
        problem = replace(make_problem(rebounds, fit.problem.setting)[0], vx=fit.problem.vx, vy=fit.problem.vy)
        move[:] = refit(fit, problem)[0][0, places] - fit.numbers[places]
    sizes = np.sqrt((moves * moves).sum(axis=0))
    estimates = {
        name: estimate if estimate.value is None else replace(estimate, shared=float(size))
        for (name, estimate), size in zip(fit.estimates.items(), sizes, strict=True)
    }
    return replace(fit, estimates=estimates)
