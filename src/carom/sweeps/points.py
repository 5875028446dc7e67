"""Sweeps whose points are computed one by one: orbits, and gases."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from carom.errors import CaromError
from carom.scene.paths import replaced
from carom.scene.schema import Model
from carom.scene.toml import stored_model
from carom.sweeps.axes import Axis
from carom.sweeps.fields import check_paths, plain_value, unit_of
from carom.sweeps.outcomes import FAILURES, Outcome, blank

__all__ = ["PointByPoint"]

Array = NDArray[Any]
REFUSED = FAILURES.index("refused")


class PointByPoint(ABC):
    """A sweep's subject that computes one point at a time; a kind of it says what a point is."""

    kind = ""

    def __init__(self, model: Any) -> None:
        self.model: Model = model

    def describe(self) -> str:
        """Return a few words."""
        return f"a{'n' if self.kind[0] in 'aeiou' else ''} {self.kind}"

    def to_data(self) -> dict[str, Any]:
        """Return the model as plain data."""
        return {self.kind: stored_model("sweep", self.model)}

    def units(self, path: str) -> str:
        """Return the unit of a parameter."""
        return unit_of(path)

    def check(self, parameters: Mapping[str, Axis]) -> None:
        """Raise CaromError for paths that lead nowhere or overlap, and for values that the model refuses."""
        check_paths(self.model, parameters)

    @abstractmethod
    def outcomes(self, names: tuple[str, ...]) -> list[Outcome]:
        """Return the outcomes of some names. CaromError with the nearest name."""

    @abstractmethod
    def compute(self, model: Any, seed: int, index: int) -> Mapping[str, Any]:
        """Return the outcomes of the point with this index."""

    def evaluate(
        self, columns: dict[str, Array], outcomes: list[Outcome], first: int, seed: int, tick: Any = None
    ) -> tuple[dict[str, Array], Array]:
        """Return the outcomes of N points by name, and (N,) the codes of those without one."""
        count = len(next(iter(columns.values())))
        found = {outcome.name: blank(outcome, count) for outcome in outcomes}
        failed = np.zeros(count, np.int8)
        for k in range(count):
            try:
                values = self.compute(self._at(columns, k), seed, first + k)
            except CaromError:
                failed[k] = REFUSED
                continue
            for outcome in outcomes:
                found[outcome.name][k] = values[outcome.name]
            if tick is not None:
                tick()
        return found, failed

    def _at(self, columns: dict[str, Array], k: int) -> Any:
        return replaced(self.model, {path: plain_value(column[k]) for path, column in columns.items()})

    def why(self, columns: dict[str, Array]) -> str:
        """Return why the one point of ``columns`` has no outcome; empty if it has one."""
        try:
            self.compute(self._at(columns, 0), 0, 0)
        except CaromError as error:
            return str(error)
        return ""
