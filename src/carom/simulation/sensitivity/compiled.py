"""The pass over a log, compiled: dual numbers in registers, LANES parameters at a time."""

from __future__ import annotations

import contextlib
import functools
from collections.abc import Callable, Iterable
from typing import Any

import numpy as np
from numpy.typing import NDArray

from carom.core.geometry.features import FEATURES
from carom.core.jit.background import compile_in_background
from carom.core.jit.compile import array_of, is_finished, njit, signature
from carom.core.jit.dual.calls import dual_address, read_duals, register_calls_of_duals, write_duals
from carom.core.jit.dual.dual_records import dual_records, float_count, float_places, register_records
from carom.core.jit.dual.functions import overload_for_duals, register_functions
from carom.core.jit.dual.numbers import LANES, as_dual, register_numbers
from carom.core.jit.kernel import Vec, kernel
from carom.core.motion.phases import HELD
from carom.laws.callbacks import NUMBERS, WallKernel, register_calls
from carom.laws.law import Law
from carom.laws.two_step import first_impact_and_way
from carom.simulation.compiled import compiled_engine
from carom.simulation.motion import move_by
from carom.simulation.records import BALLS, LOG, WORLD
from carom.simulation.sensitivity.parameters import ARRAYS, Parameters, unpacked
from carom.simulation.sensitivity.pass_kernels import PASSAGES, follow_log, state_at_time
from carom.simulation.sensitivity.passages import Motion, Passages, rows_at
from carom.simulation.wall_and_floor import joint_impact

__all__ = [
    "FOLLOW", "SLOPES", "STATES", "compiled_follow", "compiled_states", "dual_users", "finished_meanwhile", "follow_compiled",
    "pass_loop", "register_pass",
]  # fmt: skip

Array = NDArray[np.float64]
X = float_places(BALLS)["x"].start


# --- what is compiled ------------------------------------------------------------------------------------------------


def pass_loop(
    worlds: Any, world_d: Any, walls: Any, features_d: Any, start: Any, balls_d: Any, balls: Any, log: Any, users: Any,
    end: float, out: Any, out_d: Any,
) -> int:  # fmt: skip
    """Follow a log once for each LANES parameters; return -1, or the row of a graze.

    Derivatives (C, N, numbers, LANES) of the world, the features, the balls (at first; afterwards those at the time ``end``), and
    of the passages ``out`` (M,), of which one row is enough if they are not wanted.
    """
    for c in range(balls_d.shape[0]):
        for k in range(balls.shape[0]):
            balls[k] = start[k]
        world, features = dual_records(worlds, world_d, c)[0], dual_records(walls, features_d, c)
        rows, passages = dual_records(balls, balls_d, c), dual_records(out, out_d, c)
        graze = follow_log(world, features, walls, rows, balls, log, users, passages)
        if graze >= 0:
            return graze
        for k in range(balls.shape[0]):
            if balls[k].phase < HELD:
                move_by(world, rows[k], as_dual(end) - rows[k].clock, as_dual(end))
    return -1


def _states(
    worlds: Any, world_d: Any, start: Any, start_d: Any, log: Any, which: Any, out: Any, out_d: Any, time: Any, balls: Any,
    balls_d: Any, states: Any, slopes: Any,
) -> None:  # fmt: skip
    """Compute the balls at times (T,), each from its row ``which`` (T, B) of the log.

    ``states`` (T, B, 9): position, velocity, spin; ``slopes`` (C, T, B, K, LANES): derivatives of the first K numbers of these.
    ``balls`` (B,) and ``balls_d`` (C, B, numbers, LANES) are work memory, which may be that of the starts' derivatives.
    """
    for c in range(balls_d.shape[0]):
        world, first = dual_records(worlds, world_d, c)[0], dual_records(start, start_d, c)
        rows, passages = dual_records(balls, balls_d, c), dual_records(out, out_d, c)
        for i in range(which.shape[0]):
            for k in range(balls.shape[0]):
                state_at_time(world, rows[k], first[k], passages[which[i, k]], log[which[i, k]].phase, time[i])
                for j in range(slopes.shape[3]):
                    for lane in range(LANES):
                        slopes[c, i, k, j, lane] = balls_d[c, k, X + j, lane]
                if c == 0:
                    for j in range(3):
                        states[i, k, j], states[i, k, 3 + j], states[i, k, 6 + j] = (
                            balls[k].x[j],
                            balls[k].v[j],
                            balls[k].w[j],
                        )


@kernel
def _joint_impact(
    v: Vec, w: Vec, n: Vec, a: float, kappa: float, e: float, mu: float, beta: float,
    floor_e: float, floor_mu: float, floor_beta: float, together: bool,
) -> Any:  # fmt: skip
    """:func:`joint_impact` of dual numbers; the version for floats is compiled by itself."""
    return first_impact_and_way(v, w, n, a, kappa, e, mu, beta, floor_e, floor_mu, floor_beta, 0.0, together)


@functools.cache
def register_pass() -> None:
    """Tell the compiler all that the pass calls."""
    register_calls()
    compiled_engine()  # (which has the impact of wall and floor at once)
    register_numbers()
    register_functions()
    register_records()
    register_calls_of_duals(NUMBERS)
    overload_for_duals(joint_impact, _joint_impact)


SLOPES = array_of(float, 4)
# What the two functions return, and what they take.
FOLLOW = (
    int, array_of(WORLD), SLOPES, array_of(FEATURES), SLOPES, array_of(BALLS), SLOPES, array_of(BALLS), array_of(LOG),
    array_of(int), float, array_of(PASSAGES), SLOPES,
)  # fmt: skip
STATES = (
    None, array_of(WORLD), SLOPES, array_of(BALLS), SLOPES, array_of(LOG), array_of(int, 2), array_of(PASSAGES), SLOPES,
    array_of(float), array_of(BALLS), SLOPES, array_of(float, 3), array_of(float, 5),
)  # fmt: skip


@functools.cache
def compiled_follow() -> Callable[..., int]:
    """Return the compiled pass; from the second time on it is loaded from the cache."""
    return njit(pass_loop, signature(*FOLLOW), (register_pass,), _nrt=False)


def finish_follow() -> None:
    """Have the machine code of the pass in the cache: a job of another process (:func:`finished_meanwhile`)."""
    getattr(compiled_follow(), "address", None)


def finished_meanwhile() -> contextlib.AbstractContextManager[None]:
    """While inside, another process makes the machine code of the pass, where the cache has none; whoever needs it waits."""
    ready = is_finished(pass_loop)
    return contextlib.nullcontext() if ready else compile_in_background(f"{__name__}:{finish_follow.__name__}")


@functools.cache
def compiled_states() -> Callable[..., None]:
    """Return the states at a time, compiled."""
    return njit(_states, signature(*STATES), (register_pass,), _nrt=False)


@functools.cache
def _user(law: WallKernel) -> int:
    """Return the address of a law compiled with dual numbers."""
    return dual_address(law_of_duals(law), (register_pass,), keep=str(law.__module__).startswith("carom."))


def law_of_duals(law: WallKernel) -> Callable[..., None]:
    """Return the function of a place to read dual numbers from, and of one to write to, by which a law is called."""
    kernel(law)

    def entry(given: Any, out: Any) -> None:
        x = read_duals(given)
        v, w = law((x[0], x[1], x[2]), (x[3], x[4], x[5]), (x[6], x[7], x[8]), x[9], x[10], x[11], x[12], x[13])
        write_duals(out, v, w)

    return entry


def dual_users(laws: Iterable[Law]) -> NDArray[np.int64]:
    """Return the addresses of laws that are not compiled in; raises whatever the compiler says of one that it refuses."""
    return np.array([_user(law.kernel) for law in laws if law.kernel is not None], dtype=np.int64)


def follow_compiled(scene: Any, parameters: Parameters, log: NDArray[np.void], end: float) -> tuple[Passages, int]:
    """Follow a log; return its passages, and -1 or the row of a graze. Raises what the compiler says of a law that it refuses."""
    arrays = parameters.arrays
    world_d, features_d, start_d = (parameters.packed[name] for name in ARRAYS)
    out = np.empty(len(log), PASSAGES)
    out_d = np.empty((len(world_d), len(log), float_count(PASSAGES), LANES))
    start, last, last_d = arrays.balls_to_move(), arrays.balls_to_move(), start_d.copy()
    p, places = len(parameters), float_places(BALLS)
    graze = compiled_follow()(
        arrays.world,
        world_d,
        arrays.features,
        features_d,
        start,
        last_d,
        last,
        log,
        dual_users(scene.called_laws),
        end,
        out,
        out_d,
    )

    def at(times: Array) -> Array:
        if len(times) == 1 and times[0] == end:
            all_of = unpacked(last_d, p)
            return np.concatenate([all_of[None, :, places[name]] for name in Motion._fields], axis=2)
        which = np.stack([rows_at(log, k, times) for k in range(len(last))], axis=1)
        states, slopes = np.empty((*which.shape, 9)), np.zeros((len(world_d), *which.shape, 9, LANES))
        compiled_states()(
            arrays.world, world_d, start, start_d, log, which, out, out_d, times, last.copy(), np.zeros_like(start_d), states,
            slopes,
        )  # fmt: skip
        return np.moveaxis(slopes, 0, 3).reshape(*which.shape, 9, -1)[..., :p]

    return Passages(out, lambda: unpacked(out_d, p), at), int(graze)
