"""Derivatives of many runs of a scene, on all cores: each is run, and its log is followed, by the thread that has its arrays."""

from __future__ import annotations

import functools
import math
from collections.abc import Callable, Iterable
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from carom.bodies import State
from carom.core.geometry.features import FEATURES
from carom.core.jit.compile import array_of, njit, signature
from carom.core.jit.dual.dual_records import float_count, float_places
from carom.core.jit.dual.numbers import LANES
from carom.core.jit.kernel import kernel
from carom.core.jit.pointers import caller_of, compiled_address
from carom.core.jit.slices import block_slices
from carom.core.jit.threads import call_in_threads, thread_count
from carom.core.motion.phases import PHASES
from carom.errors import CaromError, require_type
from carom.scene.paths import replaced
from carom.scene.scene import Scene
from carom.simulation.compiled import ENGINE_END, ENGINE_RUN, compiled_engine
from carom.simulation.contacts.contact import DONE
from carom.simulation.contacts.kinds import REFUSALS
from carom.simulation.event_rows import ALL
from carom.simulation.loop import FULL, LIMIT, QUIET
from carom.simulation.records import BALLS, LOG, WORLD
from carom.simulation.run_log import run_limits, run_scene
from carom.simulation.sensitivity.at_times import Limits, states_and_slopes
from carom.simulation.sensitivity.compiled import FOLLOW, SLOPES, compiled_follow, dual_users
from carom.simulation.sensitivity.parameters import ARRAYS, Parameters, parameters_of
from carom.simulation.sensitivity.pass_kernels import PASSAGES
from carom.simulation.sensitivity.passages import StateSensitivity
from carom.simulation.setup import SceneArrays, set_up
from carom.simulation.starts import starts_of

__all__ = ["ManySensitivities", "sensitivities"]

Array = NDArray[np.float64]
# Runs in one call of the compiled loop: Python sees Ctrl-C between two of them.
BLOCK = 4096
# Rows of a log at first; a run that needs more is run again.
ROWS_AT_FIRST, MOST_ROWS = 512, 1 << 20
NO_DERIVATIVE = "a graze, or nearly one: no derivative exists"

# The compiled functions, called through their addresses, once there are any.
_call_run: Any = None
_call_finish: Any = None
_call_follow: Any = None


@kernel
def _copy(numbers: Any, into: Any, first: int) -> None:
    """Copy the derivatives (C, B, numbers, LANES) of numbers from the first on. (Numba takes 3 s to compile a[:] = b.)"""
    for c in range(into.shape[0]):
        for k in range(into.shape[1]):
            for number in range(into.shape[2]):
                for lane in range(LANES):
                    into[c, k, number, lane] = numbers[c, k, first + number, lane]


def _many(
    functions: Any, worlds: Any, world_d: Any, features: Any, features_d: Any, starts: Any, starts_d: Any,
    which: Any, users: Any, laws: Any, until: float, most: int, first: int, log: Any, out: Any, out_d: Any,
    balls: Any, balls_d: Any, finals: Any, finals_d: Any, ends: Any, ended: Any,
) -> None:  # fmt: skip
    """Run the starts (N, B) whose numbers are in ``which``, and follow each log.

    ``log`` (M,), ``out`` (1,), ``out_d``, ``balls`` (B,), ``balls_d`` (C, B, numbers, LANES) are for one run at a time. ``finals``
    (N, B) and ``finals_d`` (N, C, B, M, LANES): the final states, and the derivatives of their numbers from ``first``
    on; ``ends`` (N,): times; ``ended`` (N, 3): status, events, and -1 or the row of a graze. ``functions`` (3,): addresses of
    what is called.
    """
    for m in range(which.shape[0]):
        n = which[m]
        for k in range(starts.shape[1]):
            finals[n, k] = starts[n, k]
        status, events, rows, _ball, _slow, t = _call_run(
            functions[0], (worlds, features, finals[n], log, -1.0, until, most, users, ALL)
        )
        ended[n, 0], ended[n, 1], ended[n, 2] = status, events, -1
        if status not in (DONE, QUIET, LIMIT):
            continue
        ends[n] = until if until < math.inf and status != LIMIT else t
        _call_finish(functions[1], (worlds, finals[n], ends[n]))
        _copy(starts_d, balls_d, 0)
        ended[n, 2] = _call_follow(
            functions[2],
            (worlds, world_d, features, features_d, starts[n], balls_d, balls, log[:rows], laws, ends[n], out, out_d),
        )
        _copy(balls_d, finals_d[n], first)


@functools.cache
def _declare_calls() -> None:
    """Tell the compiler what the loop calls by address."""
    global _call_run, _call_finish, _call_follow
    _call_run, _call_finish, _call_follow = caller_of(*ENGINE_RUN), caller_of(*ENGINE_END), caller_of(*FOLLOW)


@functools.cache
def compiled_many() -> Callable[..., None]:
    """Return the compiled loop, for one thread."""
    addresses = np.array([compiled_address(one) for one in (*compiled_engine(), compiled_follow())])
    loop = signature(
        None, array_of(int), array_of(WORLD), SLOPES, array_of(FEATURES), SLOPES, array_of(BALLS, 2), SLOPES, array_of(int),
        array_of(int), array_of(int), float, int, int, array_of(LOG), array_of(PASSAGES), SLOPES, array_of(BALLS), SLOPES,
        array_of(BALLS, 2), array_of(float, 5), array_of(float), array_of(int, 2),
    )  # fmt: skip
    return functools.partial(njit(_many, loop, (_declare_calls,), nogil=True), addresses)


@dataclass(frozen=True, eq=False)
class ManySensitivities:
    """Final states of N runs of B balls, and their derivatives with respect to p parameters."""

    columns: list[str]
    """Names of the p parameters."""
    final: State
    """(N, B, 3)."""
    derivatives: StateSensitivity
    """Derivatives of the final states at the fixed time ``end``, each (N, B, 3, p); NaN where a run has none (``why``)."""
    code: NDArray[np.int64]
    """(N, B): final phases as numbers; ``phase`` has their names."""
    end: Array
    """(N,), s."""
    count: NDArray[np.int64]
    """(N,): number of events."""
    why: NDArray[np.str_]
    """(N,): empty, or why a run ended at an event for which a law has no answer, or has no derivative."""
    states: State | None = None
    """(N, T, B, 3): the states at the ``times``, if these were given; NaN where a run has ended before at such an event."""
    slopes: StateSensitivity | None = None
    """Derivatives of these states, each (N, T, B, 3, p); NaN from an event without a derivative on."""

    @property
    def phase(self) -> NDArray[np.str_]:
        """(N, B): flight, sliding, rolling, pivoting, rest, bouncing, held, left, pocketed."""
        return np.array(PHASES)[self.code]


def sensitivities(
    scene: Scene,
    wrt: str | Iterable[str],
    velocity: ArrayLike | None = None,
    spin: ArrayLike | None = None,
    position: ArrayLike | None = None,
    *,
    times: ArrayLike | None = None,
) -> ManySensitivities:
    """Simulate a scene from many initial states, on all cores, with exact derivatives of the final states.

    As :func:`carom.simulate_many`, with what ``run.sensitivity`` computes of each run. How an initial state depends on a parameter
    (the spin of a ball with ``rolling`` on its velocity) is taken from the scene.

    Parameters
    ----------
    scene : Scene
    wrt : list of str
        Paths such as ``balls.0.velocity`` and ``walls.*.friction``, as for ``run.sensitivity``.
    velocity, spin, position : array (N, B, 3), or (N, 3) for a scene of one ball only, optional
        Initial velocities (m/s), spins (rad/s) and positions (m); default: the scene's. One run's, (1, B, 3), are those of all.
        A ball that is to roll at another velocity than the scene's needs its spin too: that of :func:`carom.rolling`.
    times : array (T,) or (N, T), optional
        Increasing times, s, of all runs or of each, at which states and derivatives are wanted as well, as ``run.at`` and
        ``run.sensitivity(...).at`` return them.

    Returns
    -------
    ManySensitivities
        Bitwise identical whatever the number of cores.

    Raises
    ------
    CaromError
        For paths as ``run.sensitivity`` does, for initial states as ``simulate_many`` does, for runs of more than a million events,
        and for a law that takes no dual numbers.

    Examples
    --------
    >>> import carom
    >>> wall = carom.scene.Plane(point=(0, 0, 0), normal=(1, 0, 0), restitution=0.5, friction=0)
    >>> ball = carom.SceneBall(radius=0.1, mass=0.2, position=(1.1, 0, 0), velocity=(-2, 1, 0))
    >>> scene = carom.Scene(gravity=0, walls=[wall], balls=[ball], run=carom.Run(duration=1))
    >>> many = carom.sensitivities(scene, "walls.0.restitution", velocity=[[-2, 1, 0], [-4, 1, 0]])
    >>> many.derivatives.position[:, 0, 0, 0].round(6).tolist()
    [1.0, 3.0]
    >>> many = carom.sensitivities(scene, "walls.0.restitution", velocity=[[-2, 1, 0], [-4, 1, 0]], times=[0.25, 0.75])
    >>> many.states.position[:, :, 0, 0].round(6).tolist(), many.slopes.position[:, :, 0, 0, 0].round(6).tolist()
    ([[0.6, 0.35], [0.1, 1.1]], [[0.0, 0.5], [0.0, 2.0]])
    """
    require_type("sensitivities", "scene", scene, Scene)
    arrays = set_up(scene)
    starts = starts_of("sensitivities", scene, arrays, velocity, spin, position)
    wanted = None if times is None else _times(times, len(starts), scene)
    parameters = parameters_of(scene, arrays, wrt, _phases(scene))
    found, rows = _run_all(scene, arrays, parameters, starts)
    return found if wanted is None else _with_states(found, scene, parameters, starts, wanted, rows)


def _times(times: ArrayLike, runs: int, scene: Scene) -> Array:
    """Return the times (1 or N, T) of frames; CaromError for times that no run has."""
    where, until = "sensitivities", run_limits(scene)[0]
    try:
        found = np.atleast_2d(np.asarray(times, dtype=float))
    except (TypeError, ValueError):
        found = np.full((1, 1), math.nan)
    if found.ndim != 2 or not found.size or len(found) not in (1, runs) or np.isnan(found).any():
        got = f"shape {found.shape}" if not np.isnan(found).any() else f"{times!r:.60}"
        raise CaromError(f"{where}: times: expected times in s, (T,) or ({runs}, T), got {got}")
    bad = ~((found >= 0) & (found <= until) & np.isfinite(found))
    if bad.any():
        span = "from 0 on" if until == math.inf else f"from 0 to {until:g} s, the end of the run"
        raise CaromError(f"{where}: times: expected times {span}, got {float(found[bad][0])!r}")
    if (np.diff(found, axis=1) < 0).any():
        raise CaromError(f"{where}: times: expected increasing times, got a smaller one after a larger one; sort them")
    return np.ascontiguousarray(found)


def _with_states(
    found: ManySensitivities, scene: Scene, parameters: Parameters, starts: NDArray[np.void], time: Array, rows: int
) -> ManySensitivities:
    """Return the sensitivities with states and derivatives at times: each run once more, up to its last time."""
    arrays, p, places = parameters.arrays, len(parameters), np.full(len(starts), time.shape[1])
    by_scene = {name: parameters.packed[name] for name in ARRAYS if name != "balls"}
    by_start = np.repeat(parameters.packed["balls"][None], len(starts), axis=0)
    limits = Limits(rows, run_limits(scene)[1])
    states, slopes = states_and_slopes(
        arrays, dual_users(scene.called_laws), starts, time, places, by_scene, by_start, undefined=math.nan, limits=limits
    )  # fmt: skip
    d = np.moveaxis(slopes, 1, 4).reshape(*states.shape, -1)[..., :p]
    x, v, w = (states[..., k : k + 3] for k in (0, 3, 6))
    return replace(found, states=State.of(v, w, x), slopes=StateSensitivity(*(d[..., k : k + 3, :] for k in (0, 3, 6))))


def _phases(scene: Scene) -> list[int]:
    """Return the phases in which the balls of a scene begin."""
    run = run_scene(replaced(scene, {"run.max_events": 1}))
    return [int(phase) for phase in run.log["phase"][: len(scene.balls)]]


def _run_all(
    scene: Scene, arrays: SceneArrays, parameters: Parameters, starts: NDArray[np.void]
) -> tuple[ManySensitivities, int]:
    """Return the final states with derivatives, and how many rows of a log the longest run needs."""
    many, laws, p = compiled_many(), dual_users(scene.called_laws), len(parameters)
    world_d, features_d, starts_d = (parameters.packed[name] for name in ARRAYS)
    places = float_places(BALLS)
    first, last = places["x"].start, places["w"].stop
    total, chunks, count = len(starts), len(world_d), starts.shape[1]
    finals, ends = np.empty_like(starts), np.zeros(total)
    ended = np.zeros((total, 3), np.int64)
    found = np.full((total, count, last - first, p), math.nan)
    until, most = run_limits(scene)
    needed = ROWS_AT_FIRST
    for block in block_slices(total, BLOCK):
        size = block.stop - block.start
        slopes_d = np.zeros((size, chunks, count, last - first, LANES))
        which, rows = np.arange(size), ROWS_AT_FIRST
        while len(which):

            def part(
                some: NDArray[np.int64], rows: int = rows, block: slice = block, slopes_d: Array = slopes_d
            ) -> None:
                many(
                    arrays.world, world_d, arrays.features, features_d, starts[block], starts_d, some, arrays.users, laws, until,
                    most, first, np.empty(rows, LOG), np.empty(1, PASSAGES),
                    np.empty((chunks, 1, float_count(PASSAGES), LANES)), np.empty(count, BALLS), np.empty(starts_d.shape),
                    finals[block], slopes_d, ends[block], ended[block],
                )  # fmt: skip

            call_in_threads(part, np.array_split(which, min(thread_count(), len(which))))
            needed = max(needed, rows)
            which = np.flatnonzero(ended[block, 0] == FULL)
            rows *= 8
            if rows > MOST_ROWS and len(which):
                raise CaromError(
                    f"sensitivities: expected runs of at most {MOST_ROWS // 8:,} rows of the log, got a longer one at index"
                    f" {block.start + int(which[0])}; set run.duration or run.max_events"
                )
        good = np.isin(ended[block, 0], (DONE, QUIET, LIMIT)) & (ended[block, 2] < 0)
        found[block][good] = np.moveaxis(slopes_d, 1, 3).reshape(size, count, last - first, -1)[good][..., :p]
    why = np.array([REFUSALS.get(int(code), NO_DERIVATIVE if graze >= 0 else "") for code, _count, graze in ended])
    found_runs = ManySensitivities(
        [one.name for one in parameters.columns],
        State.of(*(np.array(finals[name]) for name in ("v", "w", "x"))),
        StateSensitivity(*(found[:, :, 3 * k : 3 * k + 3] for k in range(3))),
        np.array(finals["phase"]), ends, ended[:, 1].copy(), why,
    )  # fmt: skip
    return found_runs, needed
