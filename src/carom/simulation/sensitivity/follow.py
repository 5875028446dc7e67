"""Follow a log with dual numbers: in Python at first, compiled where that is at hand or pays; the bits are the same."""

from __future__ import annotations

import time
from typing import Any

import numpy as np
from numpy.typing import NDArray

from carom.core.jit.compile import compiling_failed, is_cached
from carom.core.motion.restitution import CONSTANT
from carom.errors import CaromError
from carom.simulation.compiled import is_loaded
from carom.simulation.interpreted import BEFORE_COMPILING, BEFORE_LOADING, MOST_RESTITUTION
from carom.simulation.records import WALL
from carom.simulation.sensitivity.compiled import compiled_follow, follow_compiled, pass_loop
from carom.simulation.sensitivity.interpreted import follow_interpreted
from carom.simulation.sensitivity.parameters import Parameters
from carom.simulation.sensitivity.passages import Passages

__all__ = ["follow"]

# What one row of a log takes Python, s.
PER_ROW = 1e-3
_spent = 0.0


def _worth_interpreting(scene: Any, rows: int) -> bool:
    """Return whether Python should follow a log: it is short, and the compiled pass is not at hand."""
    if compiled_follow.cache_info().currsize > 0:
        return False
    if scene.floor is not None:  # (one event may be ten thousands of bounces: carom.simulation.interpreted)
        form, numbers, *_ = scene.floor.contact
        if form != CONSTANT or MOST_RESTITUTION < numbers[0] < 1:
            return False
    if is_cached(pass_loop):
        return not is_loaded() and _spent + PER_ROW * rows < BEFORE_LOADING
    return _spent + PER_ROW * rows < BEFORE_COMPILING


def follow(scene: Any, parameters: Parameters, log: NDArray[np.void], end: float) -> Passages:
    """Return the passages of a run, with the derivatives with respect to parameters.

    Raises CaromError at a graze, and for a law that takes no dual numbers.
    """
    passages, graze = _follow_to_graze(scene, parameters, log, end)
    if graze >= 0:
        row = log[graze]
        pressed = row["kind"] == WALL and np.any(row["floor_impulse"])
        border = ", or a ball that is pressed on the floor at a border of regimes" if pressed else ""
        raise CaromError(
            f"sensitivity: events[{graze - len(scene.balls)}] ({row['t']:.9g} s, ball {int(row['ball'])}): expected an impact, got"
            f" a graze (or the last of ever lower bounces{border}), where no derivative exists; move a start a little, or end the"
            " run before"
        )
    return passages


def _follow_to_graze(scene: Any, parameters: Parameters, log: NDArray[np.void], end: float) -> tuple[Passages, int]:
    """Return the passages of a run, and the row of the first event without a derivative, up to which they hold, or -1."""
    global _spent  # noqa: PLW0603
    found = None
    if _worth_interpreting(scene, len(log)):
        began = time.perf_counter()
        found = _interpreted(scene, parameters, log)
        _spent += time.perf_counter() - began
    if found is None:
        try:
            found = follow_compiled(scene, parameters, log, end)
        except compiling_failed():  # (a law of the user's: Python says what is wrong, or follows it)
            found = follow_interpreted(scene, parameters, log)
    return found


def _interpreted(scene: Any, parameters: Any, log: Any) -> Any:
    """None where Python refuses what compiled code has a number for, such as a division by zero."""
    try:
        return follow_interpreted(scene, parameters, log)
    except (ArithmeticError, ValueError):
        return None
