"""Compile the event loop."""

from __future__ import annotations

import contextlib
import functools
from collections.abc import Callable
from typing import Any, NamedTuple

from carom.core.geometry.circles import rim_entry, rim_hit
from carom.core.geometry.curve_arc_paths import arc_hit
from carom.core.geometry.curve_features import arc_entry
from carom.core.geometry.features import CURVE, FEATURES, RIM
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
    return (run, finish, *(loop for loop, _entry in _called(scene)))


# What the loop calls by its address at features of a kind: the kernel that takes longest to compile, and the entry.
_CALLED: dict[int, tuple[Callable[..., Any], Callable[..., Any]]] = {
    RIM: (rim_hit, rim_entry),
    CURVE: (arc_hit, arc_entry),
}


def _called(scene: Scene) -> list[tuple[Callable[..., Any], Callable[..., Any]]]:
    kinds = {feature.kind for wall in scene.walls for feature in wall.features()}
    return [called for kind, called in _CALLED.items() if kind in kinds]


def compiled_before(scene: Scene | None = None) -> bool:
    """Return whether the compiled loop is at hand (what is compiled last is), with what it calls at the features of a scene."""
    called = [] if scene is None else _called(scene)
    return is_cached(_one_end) and all(is_cached(entry) for _loop, entry in called)


# Entries, and nothing else: what is called from Python is compiled with other flags, and so would be all that it calls, which
# its kernels call too.
# (One world, in an array: a single record takes 1.5 us to hand over, an array 0.1.)
def _one_run(
    worlds: Any, features: Any, balls: Any, log: Any, slow: float, until: float, most: int, users: Any, keep: int
) -> Any:
    return run(worlds[0], features, balls, log, slow, until, most, users, keep)


def _one_end(worlds: Any, balls: Any, t: float) -> None:
    finish(worlds[0], balls, t)
