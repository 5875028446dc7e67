"""The search for a plan of shots, on odds whose best plan is known: every further shot of a kind adds less."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from carom.fitting.design import ShotSearch

WORTH = np.array([1.0, 3.0, 2.0])


class Concave(ShotSearch):
    """A plan whose 2 log odds are the sum over the shots of worth times the square root of their number."""

    def __init__(self, order: list[int]) -> None:
        self.rows: Any = SimpleNamespace(cells=np.arange(3), each=1, of=lambda cells: cells)
        self.weights, self.order = np.bincount(order, minlength=3).astype(float), order
        self.best, self.total = self.lost()

    def gain(self, cells: NDArray[np.int64] | None = None) -> NDArray[np.float64]:
        gained: NDArray[np.float64] = WORTH * (np.sqrt(self.weights + 1) - np.sqrt(self.weights))
        return gained if cells is None else gained[cells]

    def lost(self, whole: bool = False) -> tuple[NDArray[np.float64], float]:
        return np.zeros((1, 1)), float(WORTH @ np.sqrt(self.weights))


def test_shots_are_moved_from_where_they_say_least_to_where_they_say_most() -> None:
    plan = Concave([0, 0, 1])
    plan._exchange()
    assert sorted(plan.order) == [1, 1, 2]  # 2 + 3 sqrt(2): the most that three shots can give
    assert plan.weights.tolist() == [0, 2, 1]
    assert plan.total == WORTH @ np.sqrt(plan.weights)
