"""Simulate a scene: one run with all its events, or many runs on all cores."""

from __future__ import annotations

import math
import sys
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from carom.bodies import State
from carom.core.jit.slices import Pace, block_slices
from carom.core.motion.phases import PHASES
from carom.errors import CaromError, FaultList, require_type
from carom.files import memory_left, require_memory
from carom.formatting import counted
from carom.laws.law import Law
from carom.public.progress import Progress, loop_callback
from carom.scene.paths import replaced
from carom.scene.scene import Run, Scene
from carom.scene.toml import load_scene
from carom.simulation.contacts.kinds import REFUSALS
from carom.simulation.event_rows import PHASES_FROM, rows_of_an_event
from carom.simulation.loop import LIMIT
from carom.simulation.many_runs import ManyRuns
from carom.simulation.records import BALL, EVENT_KINDS, IN_CLUSTER, KINDS, LOG, START
from carom.simulation.run_log import run_limits, run_scene
from carom.simulation.run_many import LOG_ROWS, PARTS, ROWS_KEPT, compiled_many, empty_counts, empty_logs
from carom.simulation.scene_loop import FIRST_ROWS
from carom.simulation.setup import SceneArrays, set_up
from carom.simulation.starts import starts_of
from carom.simulation.trajectory import Trajectory

__all__ = ["simulate", "simulate_many"]

# Events of all runs of a block in the first call of the compiled loop.
FIRST_EVENTS = 1 << 16


def simulate(
    scene: Scene | str | Path,
    progress: Progress | None = None,
    *,
    law: str | Law | None = None,
    duration: float | str | None = None,
    max_events: int | None = None,
) -> Trajectory:
    """Simulate a scene event by event.

    Parameters
    ----------
    scene : Scene, or what :func:`carom.load_scene` takes: the name of a scene file, or of a real table, such as "pool-9ft"
        The run ends after ``scene.run.duration``, after ``scene.run.max_events``, or when no event follows; with neither given,
        after 100,000 events at most.
    progress : callable(done, total, text), optional
        Called from time to time on long runs: events so far, their greatest number or NaN, the simulated time.
    law : str or carom.Law, optional
        Law of all walls that name none of their own; default: the scene's, ``scene.run.law``.
    duration, max_events : s or text with a unit; whole number; optional
        When to stop, in place of what the scene says.

    Returns
    -------
    Trajectory
        The same bits on every run, interpreted or compiled.

    Raises CaromError for an event for which a law has no answer, and for a law that the scene cannot have.

    Examples
    --------
    >>> import carom
    >>> wall = carom.scene.Plane(point=(0, 0, 0), normal=(1, 0, 0), restitution=0.85, friction=0.2)
    >>> ball = carom.SceneBall(radius=0.03, mass=0.2, position=(1, 0), velocity=(-2, 1), rolling=True)
    >>> scene = carom.Scene(floor=carom.Floor(friction=0.2), walls=[wall], balls=[ball], run=carom.Run(duration=2))
    >>> run = carom.simulate(scene)
    >>> run.events.kinds
    ['wall', 'floor', 'rolling']
    >>> run.final.velocity.round(3)
    array([[1.051, 0.796, 0.   ]])
    >>> carom.simulate(scene, law="maw").final.velocity.round(3)
    array([[1.116, 0.764, 0.   ]])
    """
    if isinstance(scene, str | Path):
        scene = load_scene(scene)
    remedy = "carom.Scene(**scene) makes one" if isinstance(scene, Mapping) else ""
    require_type("simulate", "scene", scene, Scene, remedy)
    settings: dict[str, Any] = {"law": law, "duration": duration, "max_events": max_events}
    if given := {name: value for name, value in settings.items() if value is not None}:
        try:
            run = Run(**given)
        except CaromError as error:
            raise CaromError(*(fault.replace("Run:", "simulate:", 1) for fault in error.faults)) from None
        scene = replaced(scene, {f"run.{name}": getattr(run, name) for name in given})
    most = math.nan if scene.run.max_events is None else float(scene.run.max_events)
    tell = loop_callback(progress, lambda now: lambda events, t: now(events, most, f"{t:.4g} s"))
    return Trajectory(*run_scene(scene, tell))


def simulate_many(
    scene: Scene,
    velocity: ArrayLike | None = None,
    spin: ArrayLike | None = None,
    position: ArrayLike | None = None,
    *,
    events: int = 0,
    kinds: tuple[str, ...] = (),
    progress: Progress | None = None,
) -> ManyRuns:
    """Simulate a scene from many initial states, on all cores, each run independently.

    Parameters
    ----------
    scene : Scene
    velocity, spin, position : array (N, B, 3), or (N, 3) for a scene of one ball only, optional
        Initial velocities (m/s), spins (rad/s) and positions (m); default: the scene's. One run's, (1, B, 3), are those of all.
        A ball that is to roll at another velocity than the scene's needs its spin too: that of :func:`carom.rolling`.
    events : int
        How many events of each run to keep, the first ones; default: none. Of more than a thousand only those take memory that
        the longest run has.
    kinds : tuple of str
        Kinds of events to keep, such as "wall"; default: all.
    progress : callable(done, total, text), optional
        Called with the number of runs done, and of all.

    Returns
    -------
    ManyRuns
        Bitwise identical whatever the number of cores.

    Raises
    ------
    CaromError
        For initial states that overlap a wall or another ball, for unknown kinds, and for events that would fill 8 GB.

    Examples
    --------
    >>> import carom
    >>> wall = carom.scene.Plane(point=(0, 0, 0), normal=(1, 0, 0))
    >>> ball = carom.SceneBall(radius=0.03, mass=0.2, position=(1, 0, 0))
    >>> scene = carom.Scene(gravity=0, walls=[wall], balls=[ball], run=carom.Run(law="mirror", duration=2))
    >>> carom.simulate_many(scene, velocity=[[-1, 0, 0], [-2, 0, 0]]).final.velocity[:, 0, 0]
    array([1., 2.])
    """
    require_type("simulate_many", "scene", scene, Scene)
    faults = FaultList("simulate_many")
    if isinstance(events, bool) or not isinstance(events, int | np.integer) or events < 0:
        faults.add("events", "a whole number >= 0", repr(events))
    names = ("start", "phase", "nothing", *EVENT_KINDS)
    for kind in kinds:
        if kind not in names:
            faults.add(
                "kinds",
                f"kinds of events ({', '.join(sorted(EVENT_KINDS))})",
                repr(kind),
            )
    faults.raise_if_any()
    tell = loop_callback(progress, lambda now: lambda done, total: now(done, total, "runs"))
    arrays = set_up(scene)
    balls = starts_of("simulate_many", scene, arrays, velocity, spin, position)
    return _run_many(scene, arrays._replace(balls=balls), int(events), kinds, tell)


# Runs that are done in one go: enough to keep all cores busy, few enough that memory stays small.
BLOCK = 16_384
# So many events of each run have their places from the beginning; of more, those that happen.
WHOLE_EVENTS = 1000
# For how many events the logs have room when the loop is called, at least.
LEAST_SHARE = 64
MAX_KEPT_BYTES = 8e9


def _bits(kinds: tuple[str, ...]) -> int:
    """The loop's ``keep`` for kinds of events by name."""
    bits = 0
    for kind in kinds or tuple(KINDS[1:]) + PHASES:
        bits |= 1 << (KINDS.index(kind) if kind in KINDS else PHASES_FROM + PHASES.index(kind))
    return bits | ((bits >> BALL) & 1) << IN_CLUSTER


def _run_many(scene: Scene, arrays: SceneArrays, events: int, kinds: tuple[str, ...], progress: Any) -> ManyRuns:
    many, bits, (until, most) = compiled_many(), _bits(kinds) if events else 0, run_limits(scene)
    balls, total = arrays.balls, len(arrays.balls)
    advice = "keep fewer, choose kinds, or run the starts in parts"
    require_memory(
        "simulate_many", "events", total * min(events, WHOLE_EVENTS), 2 * LOG.itemsize, advice, MAX_KEPT_BYTES
    )
    ended, slow, written = np.zeros((total, 2), np.int64), np.full(total, -1.0), empty_counts(total)
    ended[:, 0] = LIMIT
    kept: list[NDArray[np.void]] = []
    room = events if events <= WHOLE_EVENTS else FIRST_ROWS
    shape = len(scene.balls), len(arrays.features)
    longest = max(LOG_ROWS, rows_of_an_event(*shape, bits, sys.maxsize))
    one, first_ones = rows_of_an_event(*shape, bits, longest), np.empty((0, 2), np.int64)
    logs = empty_logs(min(PARTS, total), longest)
    for block in block_slices(total, BLOCK):
        rows, here, counts = np.zeros((block.stop - block.start, room), LOG), ended[block], written[block]
        pace, goes_on = Pace(FIRST_EVENTS), np.ones(len(rows), bool)
        while goes_on.any():  # (a few events of every run at a time)
            share = max(pace.begin() // len(rows), 1)
            if rows.shape[1] < events:
                longest = int(counts[goes_on, ROWS_KEPT].max())
                rows = _with_room(rows, longest, events, total, one)
                if rows.shape[1] < events:
                    share = min(share, (rows.shape[1] - longest) // one)
            many(
                arrays.world, arrays.features[None], balls[block], logs, slow[block], until, most, share, arrays.users, bits,
                first_ones, counts, rows, here,
            )  # fmt: skip
            pace.done(share * len(rows))
            goes_on = (here[:, 0] == LIMIT) & (here[:, 1] < most)
        used = events if events <= WHOLE_EVENTS else int(counts[:, ROWS_KEPT].max())
        kept.append(np.ascontiguousarray(rows[:, :used]))
        if progress is not None:
            progress(block.stop, total)
    first = _side_by_side(kept) if kept else np.zeros((0, events if events <= WHOLE_EVENTS else 0), LOG)
    first["t"][first["kind"] == START] = math.nan  # (no event is at no time: the least of a column is that of events)
    why = np.array([REFUSALS.get(int(code), "") for code in ended[:, 0]])
    final = State.of(np.array(balls["v"]), np.array(balls["w"]), np.array(balls["x"]))
    return ManyRuns(
        final, np.array(balls["phase"]), balls["clock"].max(axis=1), ended[:, 1].copy(), why, first, scene=scene
    )


def _with_room(logs: NDArray[np.void], written: int, room: int, total: int, one: int) -> NDArray[np.void]:
    """Return logs with room for events of ``one`` row at most after ``written`` rows, at most ``room``; CaromError if too large."""
    if logs.shape[1] - written >= one * LEAST_SHARE:
        return logs
    rows = min(room, 4 * logs.shape[1], int(min(MAX_KEPT_BYTES, memory_left()) / LOG.itemsize / total))
    if rows < min(room, written + one * LEAST_SHARE):
        raise CaromError(
            f"simulate_many: events: expected runs of no more than {rows:,} events, which fill {MAX_KEPT_BYTES / 1e9:g} GB, of"
            f" {counted(total, 'run')}, got one with more than {written:,}; keep fewer, choose kinds, or run the starts in parts"
        )
    found = np.zeros((len(logs), rows), LOG)
    found[:, : logs.shape[1]] = logs
    return found


def _side_by_side(parts: list[NDArray[np.void]]) -> NDArray[np.void]:
    """Return the logs of all blocks as one array, as wide as the widest."""
    if len(parts) == 1:
        return parts[0]
    found = np.zeros((sum(map(len, parts)), max(part.shape[1] for part in parts)), LOG)
    first = 0
    for part in parts:
        found[first : first + len(part), : part.shape[1]] = part
        first += len(part)
    return found
