"""Follow a log with dual numbers: in Python at first, compiled where that is at hand or pays; the bits are the same."""

from __future__ import annotations

import functools
import math
import sys
from collections.abc import Callable, Iterable
from types import FunctionType
from typing import Any

import numpy as np
from numpy.typing import NDArray

from carom.core.geometry.features import FEATURES
from carom.core.jit.compile import array_of, compiling_failed, is_at_hand, is_cached, njit, signature
from carom.core.jit.dual.dual_records import (
    dual_records,
    float_count,
    float_places,
    register_records,
)
from carom.core.jit.dual.numbers import LANES, as_dual, overload_for_duals, seeded
from carom.core.jit.kernel import DERIVED, ObjectArray, Vec, as_objects, kernel
from carom.core.motion.phases import CONSTANT, HELD
from carom.errors import CaromError
from carom.laws.callbacks import call_user, dual_law_address, register_duals
from carom.laws.law import Law
from carom.laws.two_step import first_impact_and_way
from carom.simulation.contact_kinds import joint_impact
from carom.simulation.loop import BEFORE_COMPILING, BEFORE_LOADING, MOST_RESTITUTION, compiled_engine
from carom.simulation.motion import move_by
from carom.simulation.records import BALLS, LOG, WALL, WORLD
from carom.simulation.sensitivity.passages import (
    DUAL_MATH,
    PASSAGES,
    Dual,
    Motion,
    Passages,
    derivative,
    follow_log,
    rows_at,
    state_at_time,
    value,
)
from carom.simulation.sensitivity.seeds import ARRAYS, Parameters, unpacked

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
                state_at_time(world, rows[k], first[k], passages[which[i, k]], log[which[i, k]], time[i])
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
    register_duals()
    compiled_engine()  # (which has the impact of wall and floor at once)
    register_records()
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


@functools.cache
def compiled_states() -> Callable[..., None]:
    """Return the states at a time, compiled."""
    return njit(_states, signature(*STATES), (register_pass,), _nrt=False)


def dual_users(laws: Iterable[Law]) -> NDArray[np.int64]:
    """Return the addresses of laws that are not compiled in; raises what the compiler says of one that it refuses."""
    return np.array([dual_law_address(law.kernel) for law in laws if law.kernel is not None], dtype=np.int64)


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


# ----------------------------------------------------------------------------------------------------
# Derived kernels: the very functions that the engine runs, with ``math`` replaced by its extension to dual numbers.
#
# A kernel is a function of numbers that names what it calls by the globals of its module. The derived one has the same code and
# other globals, in which ``math`` is :data:`carom.simulation.sensitivity.passages.DUAL_MATH` and every function is a derived one
# too. So each law, phase and shape has its exact derivative, without a line written by hand for it. What a kernel finds by trial
# and error says so (:func:`carom.core.jit.kernel.root_of`), and has the derivative of the implicit function theorem.


_spaces: dict[str, dict[str, Any]] = {}
# math's functions that were imported by name
_BY_FUNCTION = {getattr(math, name): function for name, function in vars(DUAL_MATH).items() if callable(function)}


def _float(number: Any) -> Any:
    """In the place of Python's float: a number with a derivative stays one."""
    return number if isinstance(number, Dual) else float(number)


def _call_law(law: Any, *numbers: Any) -> Any:
    """In the place of carom.laws.callbacks.call_user, which goes through an address."""
    return lifted(law)(*numbers)


def _seeded(value: float, k: int, slope: float) -> Dual:
    """In the place of carom.core.jit.dual.numbers.seeded."""
    slopes = np.zeros(LANES)
    slopes[k] = slope
    return Dual(value, slopes)


_INSTEAD: dict[Any, Any] = {call_user: _call_law, seeded: _seeded}


def _space(names: dict[str, Any], module: str, spaces: dict[Any, dict[str, Any]], key: Any) -> dict[str, Any]:
    """Return the globals of a module with derived functions in the place of its own and of imported functions."""
    if key in spaces:
        return spaces[key]
    space = spaces[key] = dict(names)
    space["float"] = _float
    for name, one in names.items():
        if one is math:
            space[name] = DUAL_MATH
        elif isinstance(one, FunctionType) and one in _INSTEAD:
            space[name] = _INSTEAD[one]
        elif isinstance(one, FunctionType) and _is_kernel(one, module):
            space[name] = lifted(one, None if spaces is _spaces else spaces)
        elif callable(one) and not isinstance(one, type) and _BY_FUNCTION.get(one) is not None:
            space[name] = _BY_FUNCTION[one]
    return space


def _is_kernel(one: FunctionType, module: str) -> bool:
    return one.__module__ == module or one.__module__.startswith("carom.")


def lifted(function: Callable[..., Any], own: dict[Any, dict[str, Any]] | None = None) -> Callable[..., Any]:
    """Return a kernel that takes and returns dual numbers where the given one takes and returns floats.

    Those of carom's modules are kept. A user's are made anew with every law (``own``: the globals made for this one): a notebook's
    cell may be run again, and two modules may have one name.
    """
    if not isinstance(function, FunctionType) or hasattr(function, "__wrapped__"):
        return function
    function = DERIVED.get(function, function)
    module, names = function.__module__, function.__globals__
    if module.startswith("carom."):
        space = _space(vars(sys.modules[module]) if module in sys.modules else names, module, _spaces, module)
    else:
        space = _space(names, module, {} if own is None else own, id(names))
    return FunctionType(function.__code__, space, function.__name__, function.__defaults__, function.__closure__)


# ----------------------------------------------------------------------------------------------------
# The pass over a log as plain Python, with nothing compiled: for the first few, and for what compiled code does not take.


class _Values:
    """A ball whose numbers are values."""

    def __init__(self, ball: Any) -> None:
        self._ball = ball

    def __getattr__(self, name: str) -> Any:
        """Return the value of a field."""
        one = getattr(self._ball, name)
        return [value(x) for x in one] if isinstance(one, list) else value(one)


def seeded_records(records: NDArray[np.void], slopes: list[dict[str, Any]]) -> Any:
    """Return objects for records, whose numbers have their derivatives: one dict of fields for each parameter."""
    objects = as_objects(np.array(records))
    for field in slopes[0]:
        all_of = np.stack([one[field] for one in slopes], axis=-1)
        for row, d in zip(objects, all_of, strict=True):
            if not d.any():
                continue
            old = getattr(row, field)
            new = (
                [Dual(x, g) if g.any() else x for x, g in zip(old, d, strict=True)]
                if isinstance(old, list)
                else Dual(old, d)
            )
            setattr(row, field, new)
    return objects


def _arrays(objects: Any, p: int) -> tuple[NDArray[np.void], Array]:
    """Return the values of passages (M,), and their derivatives (M, numbers, p)."""
    values, d = np.empty(len(objects), PASSAGES), np.zeros((len(objects), float_count(PASSAGES), p))
    for name, place in float_places(PASSAGES).items():
        for n, one in enumerate(objects):
            numbers = getattr(one, name)
            many = numbers if isinstance(numbers, list) else [numbers]
            values[name][n] = [value(x) for x in many] if isinstance(numbers, list) else value(numbers)
            d[n, place] = [derivative(x, p) for x in many]
    return values, d


def follow_interpreted(scene: Any, parameters: Parameters, log: NDArray[np.void]) -> tuple[Passages, int]:
    """Follow a log; return its passages, and -1 or the row of a graze.

    Raises CaromError for a law that calls what takes no dual numbers.
    """
    p, slopes, arrays = len(parameters), parameters.slopes, parameters.arrays
    world, features, balls = (seeded_records(getattr(arrays, name), [one[name] for one in slopes]) for name in ARRAYS)
    first = seeded_records(arrays.balls, [one["balls"] for one in slopes])
    walls, plain, rows = as_objects(arrays.features), ObjectArray(map(_Values, balls)), as_objects(log)
    out = as_objects(np.full(len(log), np.nan, PASSAGES))
    users = [law.kernel for law in scene.called_laws]
    with np.errstate(all="ignore"):
        try:
            graze = lifted(follow_log)(world[0], features, walls, balls, plain, rows, users, out)
        except TypeError as error:
            number = next(n for n, one in enumerate(out) if value(one.time) != value(one.time)) - len(balls)
            raise CaromError(
                f"sensitivity: events[{number}]: expected a wall's law made of + - * / and functions of math, got: {error}"
            ) from error

    def at(times: Array) -> Array:
        here, found = as_objects(np.array(arrays.balls)), np.zeros((len(times), len(arrays.balls), 9, p))
        for k, ball in enumerate(here):
            for i, row in enumerate(rows_at(log, k, times).tolist()):
                with np.errstate(all="ignore"):
                    lifted(state_at_time)(world[0], ball, first[k], out[row], rows[row], float(times[i]))
                numbers = [x for name in Motion._fields for x in getattr(ball, name)]
                found[i, k] = [derivative(x, p) for x in numbers]
        return found

    values, derivatives = _arrays(out, p)
    return Passages(values, lambda: derivatives, at), int(graze)


# ----------------------------------------------------------------------------------------------------
# Follow a log with dual numbers: in Python at first, compiled where that is at hand or pays; the bits are the same.


_followed = 0  # rows


def _worth_interpreting(scene: Any, rows: int) -> bool:
    """Return whether Python should follow a log: it is short, and the compiled pass is not at hand."""
    if compiled_follow.cache_info().currsize > 0 or is_at_hand(pass_loop):
        return False
    if scene.floor is not None:  # (one event may be ten thousands of bounces: carom.simulation.loop)
        form, numbers, *_ = scene.floor.contact
        if form != CONSTANT or MOST_RESTITUTION < numbers[0] < 1:
            return False
    return _followed + rows < (BEFORE_LOADING if is_cached(pass_loop) else BEFORE_COMPILING)


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
    global _followed  # noqa: PLW0603
    found = None
    if _worth_interpreting(scene, len(log)):
        found = _interpreted(scene, parameters, log)
        _followed += len(log)
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
