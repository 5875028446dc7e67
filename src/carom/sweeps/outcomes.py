"""Outcomes of a point of a sweep: names, shapes, types, units; and why a point has no outcome."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from carom.errors import CaromError, Fault, did_you_mean, shown

__all__ = ["FAILED", "FAILURES", "NOT_DONE", "Outcome", "blank", "require_outcomes"]

AXES = ("x", "y", "z")
FAILED = "failed"
# Codes of the variable ``failed``.
FAILURES = ("no", "law_needs_a_rolling_ball", "law_undefined_for_pressed_ball", "ball_locked", "refused")
NOT_DONE = -1  # of a point that was not computed yet


@dataclass(frozen=True)
class Outcome:
    """One variable of a sweep's result.

    ``dims`` are its dimensions in addition to the space's, with the labels of their places.
    """

    name: str
    dtype: str = "f8"
    dims: dict[str, tuple[Any, ...]] = field(default_factory=dict)
    units: str = "1"
    meanings: tuple[str, ...] = ()
    """Meanings of its whole numbers, from 0 on; -1 stands for a point without an outcome."""

    @property
    def shape(self) -> tuple[int, ...]:
        """Sizes of its own dimensions."""
        return tuple(len(labels) for labels in self.dims.values())

    @property
    def fill(self) -> float:
        """Value of a point that has no outcome."""
        return float("nan") if self.dtype.startswith("f") else -1


def blank(outcome: Outcome, count: int) -> NDArray[Any]:
    """Return an array of ``count`` points without an outcome."""
    return np.full((count, *outcome.shape), outcome.fill, dtype=outcome.dtype)


def require_outcomes(names: tuple[str, ...], known: list[str]) -> None:
    """Raise CaromError, with the nearest name, for names that are not known."""
    for name in names:
        if name not in known:
            hint = did_you_mean(str(name), known)
            raise CaromError(Fault("sweep", "keep", f"names among {', '.join(known)}", shown(name, 60), hint))
