"""Run the event loop as plain Python: for short runs while the compiled loop would have to be compiled, or loaded, first.

A kernel gives the same bits as Python and compiled, so a run may begin here and go on in the compiled loop
(:mod:`carom.simulation.compiled`). Python is some 500 times as slow: a shot of a few balls takes tens of milliseconds; compiling
takes ten seconds or more, loading half a second.
"""

from __future__ import annotations

import time
from typing import Any

import numpy as np

from carom.core.jit.objects import as_objects, write_back
from carom.core.motion.restitution import CONSTANT
from carom.scene.scene import Scene
from carom.simulation.compiled import compiled_before, is_loaded
from carom.simulation.loop import run

__all__ = ["MOST_FEATURES", "run_interpreted", "worth_interpreting"]

# What Python may take in a process, s, until the loop is compiled, or loaded where it lies compiled in the cache.
BEFORE_COMPILING, BEFORE_LOADING = 2.0, 0.3
# In a larger scene one event takes Python too long.
MOST_BALLS, MOST_FEATURES = 24, 200
# A floor that returns more than this of the speed makes a ball bounce so often that Python takes seconds for one event.
MOST_RESTITUTION = 0.99

_spent = 0.0


def worth_interpreting(scene: Scene) -> bool:
    """Return whether the next events of a scene should be run as Python: few balls, and no compiled loop at hand."""
    if is_loaded() or len(scene.balls) > MOST_BALLS:
        return False
    if scene.floor is not None:
        form, numbers, *_ = scene.floor.contact
        # (nor where the floor is tilted: one touch of a curved path takes thousands of integrals)
        if form != CONSTANT or MOST_RESTITUTION < numbers[0] < 1 or any(scene.floor.slope):
            return False
    return _spent < (BEFORE_LOADING if compiled_before(scene) else BEFORE_COMPILING)


def run_interpreted(
    worlds: Any, features: Any, balls: Any, log: Any, slow: float, until: float, most: int, users: Any, keep: int
) -> Any:
    """Run :func:`carom.simulation.loop.run` as Python, with the arguments and the answer of the compiled one.

    None where Python refuses what compiled code has a number for, such as a division by zero; ``balls`` are as they were.
    """
    global _spent  # noqa: PLW0603
    begin = time.perf_counter()
    world, ours, rows = as_objects(worlds)[0], as_objects(balls), as_objects(log)
    try:
        with np.errstate(all="ignore"):  # (laws with tables bring numbers of NumPy's in)
            answer = run(world, as_objects(features), ours, rows, slow, until, most, users, keep)
    except (ArithmeticError, ValueError):
        return None
    finally:
        _spent += time.perf_counter() - begin
    write_back(ours, balls)
    write_back(rows, log, answer[2])
    return answer
