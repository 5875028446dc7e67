"""Follow a log with dual numbers: in Python at first, compiled where that is at hand or pays; the bits are the same."""

from __future__ import annotations

import functools
import math
import sys
from collections.abc import Callable, Iterable, Mapping, Sequence
from types import FunctionType
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from carom.core.geometry.features import CURVE, FEATURES
from carom.core.jit.compile import array_of, compiling_failed, is_at_hand, is_cached, njit, signature
from carom.core.jit.dual import (
    LANES,
    as_dual,
    dual_records,
    float_count,
    float_places,
    overload_for_duals,
    register_records,
    seeded,
)
from carom.core.jit.kernel import DERIVED, ObjectArray, Vec, as_objects, kernel
from carom.core.motion.phases import CONSTANT, FLIGHT, HELD, PIVOTING, REST
from carom.errors import CaromError
from carom.laws.callbacks import call_user, dual_law_address, register_duals
from carom.laws.law import Law
from carom.laws.two_step import first_impact_and_way
from carom.scene.air import FOLLOWS
from carom.scene.scene import Scene
from carom.scene.toml import path_match, replaced
from carom.simulation.contact_kinds import joint_impact
from carom.simulation.loop import BEFORE_COMPILING, BEFORE_LOADING, MOST_RESTITUTION, compiled_engine
from carom.simulation.motion import move_by
from carom.simulation.records import BALLS, LOG, WALL, WORLD, SceneArrays, set_up
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
    """In the place of carom.core.jit.dual.seeded."""
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


# ----------------------------------------------------------------------------------------------------
# The derivatives of a scene's arrays with respect to the numbers that paths name: where the tangents of a run begin.
#
# The arrays are made by the scene's own construction, whatever the shape; their derivatives are differences of order 8 in steps so
# large that a number on which they depend linearly (velocities, frictions, a wall's point) has its derivative to the last digits.


Tangents = dict[str, dict[str, Array]]
Shifted = Callable[[float], SceneArrays]

# More parameters than this are refused: each event costs a time, and each row of the log memory, in proportion.
MOST_COLUMNS = 2000
WHERE = "sensitivity"
# f'(0) = sum of c_k (f(k h) - f(-k h)) / h, of order 8 (Fornberg, Math. Comp. 51, 699 (1988), table 1); and on one side, of order 4
CENTRAL = ((1, 4 / 5), (2, -1 / 5), (3, 4 / 105), (4, -1 / 280))
ONE_SIDED = ((0, -25 / 12), (1, 4.0), (2, -3.0), (3, 4 / 3), (4, -1 / 4))
STEP = 2.0**-7


class Column(NamedTuple):
    """One parameter: its name, and the paths and components that change together."""

    name: str
    path: str
    component: int | None
    values: tuple[Any, ...]

    @property
    def value(self) -> float:
        """Its value in the scene (of several places, the first one's)."""
        first = self.values[0]
        return float(first if self.component is None else first[self.component])


def _columns_of(scene: Scene, wrt: Any, phases: Any) -> list[Column]:
    """Return the parameters that paths name; CaromError for a path that leads nowhere, or to what is no real number."""
    paths = [wrt] if isinstance(wrt, str) else list(wrt)
    found: list[Column] = []
    if not paths:
        raise CaromError(f"{WHERE}: wrt: expected one or more paths such as 'balls.0.velocity', got none")
    for path in paths:
        match = path_match(scene, path, f"{WHERE}: wrt")
        # (a constant restitution is its number)
        match = match._replace(
            values=tuple(one.value if getattr(one, "form", "") == "constant" else one for one in match.values)
        )
        first = match.values[0]
        if isinstance(first, tuple) and first and all(isinstance(one, int | float) for one in first):
            # (position and velocity of a ball on the floor have two components, a spin has three everywhere)
            turns = all(keys[0] == "balls" and keys[-1] == "spin" for keys in match.places)
            whole = len(first) < 3 or turns or _flies(match.places, phases)
            names = ("x", "y", "z")[: len(first) if whole else 2]
            if len(first) > 3:
                raise CaromError(f"{WHERE}: wrt: {path}: expected a number or a vector, got {len(first)} numbers")
            found += [Column(f"{path}.{name}", path, k, match.values) for k, name in enumerate(names)]
        else:
            found.append(Column(path, path, None, match.values))
        for keys in match.places:
            number = keys[2] if keys[0] == "balls" and len(keys) > 2 else ""
            if number in ("velocity", "spin", "spin_z") and scene.balls[int(keys[1])].strike is not None:
                ball = path.rpartition(f".{number}")[0]
                others = ", ".join(f"{ball}.strike.{name}" for name in ("speed", "azimuth", "offset"))
                expected = "expected a number that can change a little, got one which the cue's strike fixes"
                raise CaromError(f"{WHERE}: wrt: {path}: {expected}; take {others}")
            if number in ("velocity", "spin") and phases[keys[1]] in (PIVOTING, REST):
                raise CaromError(
                    f"{WHERE}: wrt: {path}: expected a ball that moves, got ball {keys[1]} at rest on the floor, where the "
                    "derivative depends on the direction; give it a small velocity"
                )
    for one in found:
        for number in one.values:
            x = number if one.component is None else number[one.component]
            if isinstance(x, bool) or not isinstance(x, int | float) or not math.isfinite(x):
                got = (
                    f"nothing: it follows from {FOLLOWS[one.path]}; take these" if one.path in FOLLOWS else f"{x!r:.60}"
                )
                raise CaromError(f"{WHERE}: wrt: {one.path}: expected a finite real number, got {got}")
    if len(found) > MOST_COLUMNS:
        raise CaromError(
            f"{WHERE}: wrt: expected at most {MOST_COLUMNS} parameters, got {len(found)}; time and memory grow in proportion"
        )
    return found


def _flies(places: Any, phases: Any) -> bool:
    return all(keys[0] != "balls" or phases[keys[1]] == FLIGHT for keys in places)


def tangents_of(scene: Scene, wrt: Any, phases: Any, setup: SceneArrays) -> tuple[list[Column], list[Tangents]]:
    """Return the parameters that paths name, and the derivatives of the scene's arrays with respect to each.

    A component that the scene does not let change (gravity along a floor, the height of a ball on it) is left out of its vector;
    CaromError for a number, or a whole vector, that cannot change.
    """
    columns = _columns_of(scene, wrt, phases)
    try:
        slopes = [_slopes(scene, one, setup) for one in columns]
    except CurveChangesError as error:
        expected = "expected a number that leaves the curve of a wall as it is, such as its center or its angle"
        raise CaromError(f"{WHERE}: wrt: {expected}, got {error}, on which the curve depends") from None
    for one, slope in zip(columns, slopes, strict=True):
        whole = [found for other, found in zip(columns, slopes, strict=True) if other.path == one.path]
        if slope is None and all(found is None for found in whole):
            raise CaromError(
                f"{WHERE}: wrt: {one.name}: expected a number that can change a little, got {one.value!r}, which"
                " the scene fixes"
            )
    kept = [(one, slope) for one, slope in zip(columns, slopes, strict=True) if slope is not None]
    return [one for one, _slope in kept], [slope for _one, slope in kept]


def _slopes(scene: Scene, column: Column, setup: SceneArrays) -> Tangents | None:
    """Return the derivatives of the arrays with respect to one parameter; None where the scene fixes it."""
    h = _step_of(column)

    # (three searches for the derivatives ask for the same scenes)
    @functools.cache
    def shifted(by: float) -> SceneArrays:
        made = set_up(shifted_scene(scene, column, by), compiled=False)
        if _curves_of(made) != curves:
            raise CurveChangesError(column.name)
        return made

    curves = _curves_of(setup)

    # (of several places with different values the arrays hold no one number)
    x = column.value if len(set(column.values)) == 1 else math.nan
    return linear_slopes(setup, shifted, x, h) or _differences(setup, shifted, h)


class CurveChangesError(Exception):
    """A parameter changes the curve of a wall."""


def _curves_of(setup: SceneArrays) -> list[float]:
    """Return the addresses of the tables of curves."""
    found: list[float] = setup.features["lo1"][setup.features["kind"] == CURVE].tolist()
    return found


def linear_slopes(setup: SceneArrays, shifted: Shifted, x: float, h: float) -> Tangents | None:
    """Return the derivatives of arrays that are linear in a parameter x, else None; ``shifted(dx)`` are those at x + dx."""
    return _of_itself(setup, shifted, x, h) or _linear(setup, shifted, h)


def _of_itself(setup: SceneArrays, shifted: Shifted, x: float, h: float) -> Tangents | None:
    """Return the derivatives where the arrays hold the parameter itself, and nothing else changes with it; else None.

    (As :mod:`carom.sweeps` finds parameters. One scene is made for it, where differences make eight.)
    """
    try:
        made = shifted(h)
    except CaromError:
        return None
    found: Tangents = {}
    for name in ("world", "features", "balls"):
        old, new = getattr(setup, name), getattr(made, name)
        if len(old) != len(new):
            return None
        found[name] = {}
        for field in old.dtype.names:
            changed = old[field] != new[field]
            if old.dtype[field].base.kind == "f":
                changed &= ~(np.isnan(old[field]) & np.isnan(new[field]))
                found[name][field] = changed.astype(float)
            if changed.any() and not ((old[field][changed] == x) & (new[field][changed] == x + h)).all():
                return None
    return found


def _linear(setup: SceneArrays, shifted: Shifted, h: float) -> Tangents | None:
    """Return the derivatives where the arrays are linear in the parameter: two differences agree to their rounding; else None."""
    try:
        far, back, near, behind = (shifted(k * h) for k in (4, -4, 1, -1))
    except CaromError:
        return None
    found: Tangents = {}
    for name in ("world", "features", "balls"):
        ends = [getattr(one, name) for one in (setup, far, back, near, behind)]
        if len({len(one) for one in ends}) > 1:
            return None
        found[name] = {}
        for field in ends[0].dtype.names:
            x, x4, y4, x1, y1 = (one[field] for one in ends)
            if ends[0].dtype[field].base.kind != "f":
                if not all((one == x).all() for one in (x4, y4, x1, y1)):
                    return None
                continue
            with np.errstate(invalid="ignore"):
                slope, bend = (x4 - y4) / (8 * h), (x4 - y4) / 4 - (x1 - y1)
            # (infinite extents and frictions do not change)
            # (a small number may be the difference of two large ones: the field's largest is the measure of rounding)
            rounding = (
                16 * np.finfo(float).eps * np.abs(x4, where=np.isfinite(x4), out=np.zeros_like(x4)).max(initial=0.0)
            )
            if not (np.isinf(x) | (np.abs(bend) <= rounding)).all():
                return None
            found[name][field] = np.where(np.isinf(x), 0.0, slope)
    return found


def _differences(setup: SceneArrays, shifted: Shifted, h: float) -> Tangents | None:
    """Return the derivatives of the arrays' floating-point fields, by array and field; None where the scene fixes the number."""
    for stencil in _stencils():
        try:
            made = [(c, shifted(k * h)) for k, c in stencil]
        except CaromError:
            continue
        found: dict[str, dict[str, Array]] = {}
        for name in ("world", "features", "balls"):
            base = getattr(setup, name)
            fields = [field for field in base.dtype.names if base.dtype[field].base.kind == "f"]
            if any(len(getattr(one, name)) != len(base) for _c, one in made):
                break
            with np.errstate(invalid="ignore"):
                slopes = {field: sum(c * getattr(one, name)[field] for c, one in made) / h for field in fields}
            # (infinite extents and frictions do not change)
            found[name] = {field: np.nan_to_num(np.asarray(d, dtype=float), nan=0.0) for field, d in slopes.items()}
        else:
            return found
    return None


def _step_of(column: Column) -> float:
    """Return the smallest step of the differences, a power of two."""
    scale = max((abs(x if column.component is None else x[column.component]) for x in column.values), default=0.0)
    return STEP * (2.0 ** round(math.log2(scale)) if scale > 0 else 1.0)


def _stencils() -> Any:
    yield [(sign * k, sign * c) for k, c in CENTRAL for sign in (1, -1)]
    for sign in (1, -1):
        yield [(sign * k, sign * c) for k, c in ONE_SIDED]


def shifted_scene(scene: Scene, column: Column, by: float) -> Scene:
    """Return the scene with the parameter changed by ``by`` at every place."""
    changes: dict[str, Any] = {}
    for place, x in zip(path_match(scene, column.path).places, column.values, strict=True):
        path = ".".join(map(str, place))
        changes[path] = (
            x + by
            if column.component is None
            else tuple(one + by if k == column.component else one for k, one in enumerate(x))
        )
    return replaced(scene, changes)


# ----------------------------------------------------------------------------------------------------
# The parameters of a sensitivity: names, and the derivatives of the scene's arrays; kept while the scene is alive.


ARRAYS = ("world", "features", "balls")


class Parameters:
    """Columns, and the derivatives of the arrays of a scene with respect to each."""

    def __init__(
        self, arrays: SceneArrays, wrt: tuple[str, ...], columns: list[Column], slopes: list[Tangents]
    ) -> None:
        self.arrays, self.wrt, self.columns, self.slopes = arrays, wrt, columns, slopes

    def __len__(self) -> int:
        """How many there are."""
        return len(self.columns)

    @functools.cached_property
    def packed(self) -> dict[str, Array]:
        """By array, as compiled code takes them: (C, N, numbers, LANES)."""
        return packed(self.slopes, {name: getattr(self.arrays, name).dtype for name in ARRAYS})


def packed(slopes: Sequence[Tangents], dtypes: Mapping[str, Any]) -> dict[str, Array]:
    """Return the derivatives of arrays of those types as compiled code takes them, by array: (C, N, numbers, LANES)."""
    found = {}
    for name, dtype in dtypes.items():
        rows = len(next(iter(slopes[0][name].values())))
        found[name] = np.zeros((-(-len(slopes) // LANES), rows, float_count(dtype), LANES))
        for j, one in enumerate(slopes):
            lanes = found[name][j // LANES, ..., j % LANES]
            for field, place in float_places(dtype).items():
                lanes[:, place] = one[name][field].reshape(rows, place.stop - place.start)
    return found


def unpacked(found: Array, p: int) -> Array:
    """Return derivatives (N, numbers, p) from the compiled code's, (C, N, numbers, LANES)."""
    return np.moveaxis(found, 0, 2).reshape(*found.shape[1:3], -1)[..., :p]


MOST_KEPT = 8


def parameters_of(scene: Scene, arrays: SceneArrays, wrt: Any, phases: list[int]) -> Parameters:
    """Return the parameters that paths name; CaromError for a path that leads nowhere, or to what is no real number.

    The scene keeps the last of them: a shot takes less time than finding what its paths name.
    """
    kept = scene.kept.setdefault("parameters", {})
    paths = (wrt,) if isinstance(wrt, str) else tuple(wrt)
    if not all(isinstance(path, str) for path in paths):
        return _made(scene, arrays, paths, phases)
    asked = paths, tuple(phases)
    if asked not in kept:
        made = _made(scene, arrays, paths, phases)
        while len(kept) >= MOST_KEPT:
            kept.pop(next(iter(kept)))
        kept[asked] = made
    found: Parameters = kept[asked]
    return found


def _made(scene: Scene, arrays: SceneArrays, wrt: Any, phases: list[int]) -> Parameters:
    return Parameters(arrays, wrt, *tangents_of(scene, wrt, phases, arrays))
