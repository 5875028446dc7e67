"""The passages of a run: what a pass over its log leaves, row by row, with derivatives."""

from __future__ import annotations

import functools
from collections.abc import Callable, Iterator
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from carom.bodies import holds_arrays
from carom.core.jit.dual.dual_records import float_places
from carom.simulation.sensitivity.dual import Dual
from carom.simulation.sensitivity.pass_kernels import PASSAGES

__all__ = ["Motion", "Passage", "Passages", "StateSensitivity", "rows_at"]

Array = NDArray[np.float64]
PLACES = float_places(PASSAGES)


class Motion(NamedTuple):
    """Position, velocity and spin, in dual numbers."""

    x: list[Any]
    v: list[Any]
    w: list[Any]


class Passage(NamedTuple):
    """One row of the log: its time, and what could switch there."""

    time: Any
    ball: Motion
    before: Motion
    """As it comes to the event."""
    approach: Any
    """Rate at which the gap closes (m/s); None where nothing is met."""
    required: Any
    friction: float | None
    slip: Any


@holds_arrays
class StateSensitivity(NamedTuple):
    """Derivatives of the states of all balls at a fixed time, each (B, 3, p); at times (...), each (..., B, 3, p)."""

    position: Array
    """m per unit of the parameter."""
    velocity: Array
    spin: Array


def rows_at(log: NDArray[np.void], ball: int, times: Array) -> NDArray[np.int64]:
    """Return the rows of a log (T,) that a ball follows at times (T,)."""
    own = np.flatnonzero(log["ball"] == ball)
    found: NDArray[np.int64] = own[np.searchsorted(log["t"][own], times, side="right") - 1]
    return found


class Passages:
    """A sequence of passages, which are made when they are asked for."""

    def __init__(
        self, values: NDArray[np.void], derivatives: Callable[[], Array], at: Callable[[Array], Array]
    ) -> None:
        self.values = values
        """(M,) of PASSAGES."""
        self._derivatives = derivatives
        self._at = at

    @functools.cached_property
    def derivatives(self) -> Array:
        """(M, numbers of PASSAGES, p)."""
        return self._derivatives()

    def at(self, t: ArrayLike) -> StateSensitivity:
        """Return the derivatives of all states at a time, s, or at times (...)."""
        times = np.asarray(t, dtype=float)
        found = self._at(times.ravel())
        found = found.reshape(*times.shape, *found.shape[1:])
        return StateSensitivity(*(found[..., k : k + 3, :] for k in (0, 3, 6)))

    def __len__(self) -> int:
        """How many rows the log has."""
        return len(self.values)

    def __iter__(self) -> Iterator[Passage]:
        """All passages."""
        return (self[n] for n in range(len(self)))

    def __getitem__(self, n: int) -> Passage:
        """Return the passage of one row."""
        row, d = self.values[n], self.derivatives[n]

        def numbers(name: str) -> list[Any]:
            return [Dual(float(x), g) for x, g in zip(np.atleast_1d(row[name]), d[PLACES[name]], strict=True)]

        def number(name: str) -> Any:
            return None if np.isnan(row[name]) else numbers(name)[0]

        slip = None if np.isnan(row["slip"][0]) else numbers("slip")
        friction = None if np.isnan(row["friction"]) else float(row["friction"])
        motion = Motion(*(numbers(name) for name in Motion._fields))
        before = Motion(motion.x, numbers("v_before"), numbers("w_before"))
        return Passage(number("time"), motion, before, number("approach"), number("required"), friction, slip)
