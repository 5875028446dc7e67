"""Derivatives of many runs of a scene, on all cores: each is run, and its log is followed, by the thread that has its arrays."""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import ArrayLike, NDArray

from carom.bodies import State
from carom.core.motion.phases import PHASES
from carom.errors import CaromError, require_type
from carom.scene.paths import replaced
from carom.scene.scene import Scene
from carom.simulation.contacts.kinds import REFUSALS
from carom.simulation.loop import FULL
from carom.simulation.run_log import run_limits, run_scene
from carom.simulation.sensitivity.at_times import ENDED, Limits, RunSlopes, kept_states
from carom.simulation.sensitivity.compiled import dual_users
from carom.simulation.sensitivity.parameters import ARRAYS, Parameters, parameters_of
from carom.simulation.sensitivity.passages import StateSensitivity
from carom.simulation.setup import SceneArrays, set_up
from carom.simulation.starts import starts_of

__all__ = ["ManySensitivities", "first_phases", "run_all", "sensitivities"]

Array = NDArray[np.float64]
# Rows of a log at first; a run that needs more is run again.
ROWS_AT_FIRST, MOST_ROWS = 512, 1 << 18
NO_DERIVATIVE = "a graze, or nearly one: no derivative exists"


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
        For paths as ``run.sensitivity`` does, for initial states as ``simulate_many`` does, for runs of more than 262,144 rows
        of the log, and for a law that takes no dual numbers.

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
    return run_all(scene, arrays, parameters_of(scene, arrays, wrt, first_phases(scene)), starts, wanted)


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


def first_phases(scene: Scene) -> list[int]:
    """Return the phases in which the balls of a scene begin."""
    run = run_scene(replaced(scene, {"run.max_events": 1}))
    return [int(phase) for phase in run.log["phase"][: len(scene.balls)]]


def run_all(
    scene: Scene,
    arrays: SceneArrays,
    parameters: Parameters | None,
    starts: NDArray[np.void],
    times: Array | None = None,
) -> ManySensitivities:
    """Run starts (N, B) in the arrays of the scene, or in those of N scenes, with derivatives by the parameters, if any."""
    (total, count), (until, most) = starts.shape, run_limits(scene)
    columns, slopes = [] if parameters is None else parameters.columns, None
    p = len(columns)
    if parameters is not None:
        world, features, balls = (parameters.packed[name] for name in ARRAYS)
        slopes = RunSlopes(world, features, balls[None], dual_users(scene.called_laws))
    places = None if times is None else np.full(total, times.shape[1])
    limits = Limits(ROWS_AT_FIRST, most, until, MOST_ROWS)
    kept = kept_states(arrays, starts, slopes, times, places, to_end=True, undefined=math.nan, limits=limits)
    status, events, grazes = kept.ended.T
    if (status == FULL).any():
        raise CaromError(
            f"sensitivities: expected runs of at most {MOST_ROWS:,} rows of the log, got a longer one at index"
            f" {int(np.argmax(status == FULL))}; set run.duration or run.max_events"
        )
    found = np.moveaxis(kept.finals_d, 1, 3).reshape(total, count, 9, -1)[..., :p]
    found[~(np.isin(status, ENDED) & (grazes < 0))] = math.nan
    why = np.array([REFUSALS.get(int(code), NO_DERIVATIVE if graze >= 0 else "") for code, _count, graze in kept.ended])
    made = ManySensitivities(
        [one.name for one in columns], _states(kept.finals), _slopes(found), np.array(kept.finals["phase"]), kept.ends,
        events.copy(), why,
    )  # fmt: skip
    if times is None:
        return made
    x, v, w = (kept.states[..., k : k + 3] for k in (0, 3, 6))
    at_times = np.moveaxis(kept.slopes, 1, 4).reshape(*kept.states.shape, -1)[..., :p]
    return replace(made, states=State.of(v, w, x), slopes=_slopes(at_times))


def _states(balls: NDArray[np.void]) -> State:
    return State.of(*(np.array(balls[name]) for name in ("v", "w", "x")))


def _slopes(numbers: Array) -> StateSensitivity:
    """Return the derivatives (..., 9, p) of positions, velocities and spins."""
    return StateSensitivity(*(numbers[..., k : k + 3, :] for k in (0, 3, 6)))
