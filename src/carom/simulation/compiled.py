"""Compile the event loop."""

from __future__ import annotations

import contextlib
import functools
from collections.abc import Callable
from typing import Any, NamedTuple

from carom.core.geometry.circles import rim_entry, rim_hit
from carom.core.geometry.features import FEATURES, RIM
from carom.core.jit.background import compile_in_background
from carom.core.jit.compile import array_of, is_cached, njit, signature
from carom.laws.callbacks import register_calls
from carom.scene.scene import Scene
from carom.simulation.loop import finish, run
from carom.simulation.records import BALLS, LOG, WORLD
from carom.simulation.wall_and_floor import PART, register_joint_impact

__all__ = [
    "ENGINE_RUN",
    "Engine",
    "compiled_before",
    "compiled_engine",
    "is_loaded",
    "loops_of",
    "plain_engine",
]


class Engine(NamedTuple):
    """The compiled loop."""

    run: Callable[..., Any]
    finish: Callable[..., Any]


# What the loop and its end return, and what they take.
ENGINE_END = (None, array_of(WORLD), array_of(BALLS), float)
ENGINE_RUN = (
    (int, int, int, int, float, float),
    *(array_of(kind) for kind in (WORLD, FEATURES, BALLS, LOG)), float, float, int, array_of(int), int,
)  # fmt: skip


@functools.cache
def compiled_engine() -> Engine:
    """Return the compiled event loop; from the second time on it is loaded from the cache."""
    needs = (register_calls, register_joint_impact)
    with contextlib.nullcontext() if compiled_before() else compile_in_background(PART):
        # (nothing is made in the loop: no counting of who holds an array)
        return Engine(
            njit(_one_run, signature(*ENGINE_RUN), needs, _nrt=False),
            njit(_one_end, signature(*ENGINE_END), needs, _nrt=False),
        )


def plain_engine() -> Engine:
    """Return the entries of the event loop as functions that are not compiled."""
    return Engine(_one_run, _one_end)


def is_loaded() -> bool:
    """Return whether this process has the compiled loop at hand."""
    return compiled_engine.cache_info().currsize > 0


def loops_of(scene: Scene) -> tuple[Callable[..., Any], ...]:
    """Return the functions that are compiled for a scene: their names tell how much there is to compile."""
    return (run, finish, *((rim_hit,) if _has_rims(scene) else ()))


def _has_rims(scene: Scene) -> bool:
    return any(feature.kind == RIM for wall in scene.walls for feature in wall.features())


def compiled_before(scene: Scene | None = None) -> bool:
    """Return whether the compiled loop is at hand (what is compiled last is), and rims, if the scene has any."""
    rims = scene is not None and _has_rims(scene)
    return is_cached(_one_end) and (not rims or is_cached(rim_entry))


# Entries, and nothing else: what is called from Python is compiled with other flags, and so would be all that it calls, which
# its kernels call too.
# (One world, in an array: a single record takes 1.5 us to hand over, an array 0.1.)
def _one_run(
    worlds: Any, features: Any, balls: Any, log: Any, slow: float, until: float, most: int, users: Any, keep: int
) -> Any:
    return run(worlds[0], features, balls, log, slow, until, most, users, keep)


def _one_end(worlds: Any, balls: Any, t: float) -> None:
    finish(worlds[0], balls, t)
