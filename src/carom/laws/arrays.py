"""Validate states, normals and parameters, broadcast them to rows, and apply a kernel to every row.

A few rows are evaluated in plain Python, many in a loop compiled by Numba; the results are bitwise identical. Rows are
velocities and spins (N, 3), normals (N or 1, 3), parameters (N or 1, K); a single row of normals or parameters serves all.
"""

from __future__ import annotations

import functools
import math
from collections import Counter
from collections.abc import Callable, Sequence
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from carom.bodies import Ball, State
from carom.core.jit.kernel import Vec, dot, kernel, prange, vector
from carom.core.jit.threads import sliced
from carom.core.motion.phases import ROUNDING
from carom.errors import (
    MAX_MAGNITUDE,
    MIN_MAGNITUDE,
    CaromError,
    broadcast_shape,
    first_bad_index,
    float_array,
    require_type,
)

Array = NDArray[np.float64]
# Fewer rows than FEW_AT_FIRST are evaluated in Python where the loop is no machine code yet, but for a loop of the package in at
# most so many calls: a row takes Python 5 us or, of a pressed ball, 10 ms.
FEW_AT_FIRST, CALLS_AT_FIRST = 400, 8
WallKernel = Callable[[Vec, Vec, Vec, float, float, float, float, float], tuple[Vec, Vec]]


def unit_normal(normal: ArrayLike) -> Array:
    """Return unit normals (..., 3) from vectors of any length; CaromError if one has zero length."""
    try:
        n = float_array(normal)
    except (TypeError, ValueError):
        raise CaromError(f"normal: expected 3 numbers, or an array (..., 3) of them, got {normal!r}") from None
    if n.ndim == 0 or n.shape[-1] != 3:
        raise CaromError(f"normal: expected 3 numbers, or an array (..., 3) of them, got shape {n.shape}")
    if n.ndim == 1:  # one normal, without arrays
        x, y, z = n.tolist()
        length = math.sqrt(x * x + y * y + z * z)
        if length == 1:
            return n
        if 0 < length <= MAX_MAGNITUDE:
            return n / length
    with np.errstate(over="ignore", invalid="ignore"):
        lengths = np.sqrt((n * n).sum(axis=-1, keepdims=True))
    bad = ~((lengths > 0) & (lengths <= MAX_MAGNITUDE))[..., 0]
    if bad.any():
        got = n[bad][0] if n.ndim > 1 else n
        raise CaromError(
            f"normal: expected a vector that points from the wall to the ball, got {got.tolist()}{bad_row(bad)};"
            " for the wall x = 0 with the ball at x > 0 it is (1, 0, 0)"
        )
    unit: Array = n / lengths
    return unit


def _rows_of(vectors: Sequence[Array], parameters: Sequence[Any]) -> tuple[tuple[int, ...], list[Array]]:
    """Broadcast vectors and parameters; return the shape, the vectors (N, 3) and the parameters (N or 1, K).

    Normals, the last of the vectors, stay a single row if they are common to all states, and so do parameters.
    """
    *moving, normal = vectors
    if set(map(type, parameters)) == {float}:  # (a single state takes as long as this function)
        shape, single = broadcast_shape(*{x.shape[:-1] for x in vectors}), True
    else:
        shape = broadcast_shape(*(x.shape[:-1] for x in vectors), *map(np.shape, parameters))
        single = all(np.ndim(x) == 0 for x in parameters)
    count = math.prod(shape)

    # (all are read-only, as the arrays of a State may be: loops are compiled once, not again for arrays that may be written to)
    def spread(array: Array) -> Array:
        rows = array if array.shape == (*shape, 3) else np.broadcast_to(array, (*shape, 3))
        return _read_only(np.ascontiguousarray(rows).reshape(count, 3))

    if single:
        p = np.array([[float(x) for x in parameters]])
    else:
        p = np.ascontiguousarray(np.stack([np.broadcast_to(x, shape).reshape(count) for x in parameters], axis=-1))
    return shape, [*map(spread, moving), _read_only(normal[None]) if normal.ndim == 1 else spread(normal), p]


def _read_only(array: Array) -> Array:
    """Return a view of an array that nothing can be written to."""
    view = array.view()
    view.flags.writeable = False
    return view


def bad_row(bad: Any) -> str:
    """Return which row of many fails a condition, the first, and how to go on with the others; empty for one state."""
    return first_bad_index(bad, "go on with the others, state[keep]; carom.predict skips such rows")


def approaching(state: State, normal: Array) -> Any:
    """Return a mask (...): whether a ball does not move away from the wall, u_n <= 0 up to the rounding of the normal."""
    v = state.velocity
    if v.ndim == normal.ndim == 1:  # one state, without arrays
        return np.bool_(_approaches(vector(v.tolist()), vector(normal.tolist())))
    broadcast_shape(state.shape, normal.shape[:-1])
    return np.asarray((v * normal).sum(axis=-1) <= ROUNDING * np.abs(v).sum(axis=-1))


@kernel
def _approaches(v: Vec, n: Vec) -> bool:
    return dot(v, n) <= ROUNDING * (abs(v[0]) + abs(v[1]) + abs(v[2]))


@kernel
def _moves_plainly(v: Vec, n: Vec) -> bool:
    """Whether a ball certainly moves towards a wall, and fast enough for the square of its speed to be a float."""
    return abs(v[0]) >= MIN_MAGNITUDE and _approaches(v, n)


def _doubtful_rows(v: Array, n: Array, doubtful: Any) -> None:
    """Mark the rows to be looked at again: what does not plainly move towards the wall."""
    sn = min(n.shape[0] - 1, 1)
    for i in prange(v.shape[0]):
        k = i * sn
        doubtful[i] = 0 if _moves_plainly((v[i, 0], v[i, 1], v[i, 2]), (n[k, 0], n[k, 1], n[k, 2])) else 1


def _all_move_plainly(v: Array, n: Array) -> bool:
    """Return whether all balls certainly move towards the wall, in one pass over the velocities and without a copy of them.

    NumPy's expressions for the same write five arrays as large as the velocities, which took two thirds of the time of an impact.
    """
    if v.ndim == n.ndim == 1:
        return _moves_plainly(vector(v.tolist()), vector(n.tolist()))
    count = v.size // 3
    if not v.flags.c_contiguous or (n.ndim != 1 and n.shape != v.shape):
        return False
    doubtful, normals = np.empty(count, np.int8), np.ascontiguousarray(n).reshape(-1, 3)
    loop_for(_doubtful_rows, count)(_read_only(v.reshape(count, 3)), _read_only(normals), doubtful)
    return not doubtful.any()


RESOLVED = f"a ball at rest, or a component of velocity or spin of at least {MIN_MAGNITUDE:g}"


def motion_resolved(state: State) -> Any:
    """Return a mask (...): whether a ball is at rest, or moves fast enough for the square of its speed to be a float."""
    v, w = state.velocity, state.spin
    if v.ndim == 1:
        size = max(map(abs, v.tolist() + w.tolist()))
        return np.bool_(size == 0 or size >= MIN_MAGNITUDE)
    good = np.asarray(np.abs(v[..., 0]) >= MIN_MAGNITUDE)
    if not good.all():  # (most often it is that component)
        largest = np.maximum(np.abs(v).max(axis=-1), np.abs(w).max(axis=-1))
        good = good | (largest == 0) | (largest >= MIN_MAGNITUDE)
    return good


def require_resolved(where: str, state: State) -> None:
    """Raise CaromError where a ball moves so slowly that squares of its speed underflow."""
    good = motion_resolved(state)
    if good.ndim == 0 and good:  # (`any` of one value takes NumPy 3 us)
        return
    bad = ~good
    if bad.any():
        largest = np.maximum(np.abs(state.velocity).max(axis=-1), np.abs(state.spin).max(axis=-1))
        raise CaromError(f"{where}: expected {RESOLVED}, got {float(largest[bad].flat[0])!r}{bad_row(bad)}")


def require_approach(ball: Ball, state: State, normal: Array) -> None:
    """Raise CaromError if a ball moves away from the wall, or a disc leaves its plane."""
    require_type("", "ball", ball, Ball, "make one with carom.Ball(radius, mass); the ball is the first argument")
    made = "carom.rolling(ball, velocity) or carom.State(velocity, spin)"
    require_type("", "state", state, State, f"make one with {made}; the state is the second argument")
    if not ball.planar and _all_move_plainly(state.velocity, normal):
        return
    require_resolved("state", state)
    away = ~approaching(state, normal)
    if away.any():
        speed = float(np.broadcast_to((state.velocity * normal).sum(axis=-1), away.shape)[away].flat[0])
        raise CaromError(
            f"state: expected a ball that moves towards the wall, got {speed:.6g} m/s away from it{bad_row(away)};"
            " the normal points from the wall to the ball"
        )
    if ball.planar:
        out = (state.velocity[..., 2] != 0) | (state.spin[..., :2] != 0).any(axis=-1)
        if np.any(out) or np.any(normal[..., 2] != 0):
            raise CaromError(
                "state: expected a disc in the plane z = 0 (v_z = 0, spin along z, a wall that stands on the plane),"
                f" got something else{bad_row(np.asarray(out)) if np.any(out) else ' for the normal'};"
                " use carom.Ball in space"
            )


def answer_rows(
    kernel: Callable[..., Any],
    loop: Callable[..., None],
    widths: str,
    vectors: Sequence[Array],
    parameters: Sequence[Any],
    *more: Any,
    integrated: Callable[..., bool] | None = None,
) -> list[Any]:
    """Return a kernel's results for all states; ``widths`` gives their types: "v" vector (..., 3), "x" number, "c" code.

    Vectors, the last of them normals, and parameters broadcast. A single state is passed to the kernel as Python numbers, and its
    vectors share the memory of one array; many are evaluated by the loop, and so is a single one that has to be ``integrated``
    (a function of the kernel's arguments), which takes Python long.
    """
    plain = set(map(type, parameters)) == {float}
    alone = max([x.ndim for x in vectors]) == 1 and (plain or not any(map(np.ndim, parameters)))
    numbers = parameters if plain else map(float, parameters)
    one = (*[tuple(x.tolist()) for x in vectors], *numbers, *more) if alone else ()
    if alone and not (integrated is not None and integrated(*one) and is_ready(loop)):
        found = kernel(*one)
        if widths == "vv":  # (a custom law may return lists)
            return [*np.array(found, dtype=float)]
        made = iter(np.array([x for x in found if type(x) is tuple], dtype=float))
        return [next(made) if type(x) is tuple else x for x in found]
    shape, rows = _rows_of(vectors, parameters)
    n = len(rows[0])
    arrays: list[NDArray[Any]] = [
        np.empty((n, 3)) if kind == "v" else np.empty(n, dtype=float if kind == "x" else np.int8) for kind in widths
    ]
    (_compiled(loop) if alone else loop_for(loop, n))(*rows, *more, *arrays)
    return [x.item() if alone and x.ndim == 1 else x.reshape(*shape, *x.shape[1:]) for x in arrays]


def state_arrays(state: State, out: State) -> list[Array]:
    """Return velocities and spins of both states as flat views (3 N,); CaromError if ``out`` is not contiguous."""
    require_type("", "state", state, State)
    require_type("", "out", out, State)
    for name, array in (("velocity", out.velocity), ("spin", out.spin)):
        _require_room(f"out: {name}", array, state.velocity.shape, np.dtype(float))
    before = [_read_only(x.reshape(-1)) for x in (state.velocity, state.spin)]
    return [*before, out.velocity.reshape(-1), out.spin.reshape(-1)]


def reason_array(state: State, why: Any) -> Any:
    """Return the array that receives a reason for each ball as a flat view (N,); CaromError if it does not fit the state."""
    _require_room("why", why, state.shape, np.dtype(np.int8))
    return why.reshape(-1)


def _require_room(field: str, array: Any, shape: tuple[int, ...], dtype: np.dtype[Any]) -> None:
    """Raise CaromError unless results can be written into an array: compiled loops write beyond the end of a short one."""
    if isinstance(array, np.ndarray) and array.shape == shape and array.dtype == dtype and array.flags.carray:
        return
    got = type(array).__name__
    if isinstance(array, np.ndarray):
        got = "one that is " + ("read-only" if array.flags.c_contiguous else "not contiguous")
        if array.shape != shape or array.dtype != dtype:
            got = f"shape {array.shape} and type {array.dtype}"
    raise CaromError(
        f"{field}: expected a contiguous array of shape {shape} and type {dtype}, to be written into, got {got}"
    )


def one_normal(normal: ArrayLike) -> Array:
    """Return a unit normal (3,), the same for all balls; CaromError for several normals."""
    unit = unit_normal(normal)
    if unit.ndim != 1:
        raise CaromError(f"normal: expected 3 numbers, the same for all balls, got shape {unit.shape}")
    return _read_only(unit)


@functools.cache
def wall_law_rows(law: WallKernel) -> Callable[..., None]:
    """Return the loop over rows of a wall law with the signature (v, w, n, a, kappa, e, mu, beta) -> (v, w)."""
    kernel(law)  # compiled loops call only functions marked as kernels, and a custom law need not be marked

    def rows(v: Array, w: Array, n: Array, p: Array, v1: Array, w1: Array) -> None:
        sn, sp = min(n.shape[0] - 1, 1), min(p.shape[0] - 1, 1)
        for i in prange(v.shape[0]):
            k, q = i * sn, i * sp
            x, y = law(
                (v[i, 0], v[i, 1], v[i, 2]),
                (w[i, 0], w[i, 1], w[i, 2]),
                (n[k, 0], n[k, 1], n[k, 2]),
                p[q, 0], p[q, 1], p[q, 2], p[q, 3], p[q, 4],
            )  # fmt: skip
            v1[i, 0], v1[i, 1], v1[i, 2] = x
            w1[i, 0], w1[i, 1], w1[i, 2] = y

    return fresh_unless_own(rows, law)


def fresh_unless_own(rows: Callable[..., None], law: WallKernel) -> Callable[..., None]:
    """Return the loop over rows of a law, marked as one that is not cached where the law is a custom one."""
    if not law.__module__.startswith("carom."):
        _FRESH.add(rows)
    return rows


# Loops over custom kernels are not cached: the cache's key is a hash of carom's own sources, so an outdated version of a
# custom law would be loaded after it has been edited.
_FRESH: set[Callable[..., None]] = set()


@functools.cache
def _compiled(loop: Callable[..., None]) -> Callable[..., None]:
    from carom.core.jit.compile import njit

    return njit(loop, parallel=True, cache=loop not in _FRESH)


def loop_for(loop: Callable[..., None], rows: int) -> Callable[..., None]:
    """Return the loop: compiled and in slices, or in Python for few rows before it is machine code, with the same bits."""
    if rows < FEW_AT_FIRST and not is_ready(loop):
        return _without_warnings(loop)
    from carom.core.jit.compile import compiler_is_off

    return _without_warnings(loop) if compiler_is_off() else sliced(_compiled(loop), rows)


_ready: dict[Callable[..., None], bool] = {}
_calls: Counter[Callable[..., None]] = Counter()


def is_ready(loop: Callable[..., None]) -> bool:
    """Return whether a loop of the package is taken for few rows: it is machine code already, or Python was called often enough."""
    if loop not in _ready:
        from carom.core.jit.native import is_kept

        kept = is_kept(loop)
        if kept is False and _calls[loop] < CALLS_AT_FIRST:
            _calls[loop] += 1
            return False
        _ready[loop] = kept is not None
    return _ready[loop]


def _without_warnings(loop: Callable[..., None]) -> Callable[..., None]:
    """Suppress the warnings of NumPy scalars (0 * inf), which compiled code does not give."""

    def quiet(*args: Any) -> None:
        with np.errstate(all="ignore"):
            loop(*args)

    return quiet
