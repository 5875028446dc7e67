"""Simulate a scene: one run with all its events, or many runs on all cores."""

from __future__ import annotations

import math
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from carom.bodies import State, vectors
from carom.core.jit.slices import Pace, block_slices
from carom.core.motion.phases import PHASES
from carom.errors import CaromError, FaultList, require_type
from carom.formatting import counted
from carom.laws.law import Law
from carom.scene.paths import replaced
from carom.scene.scene import Run, Scene
from carom.scene.toml import load_scene
from carom.simulation.compiled import compiled_engine, compiled_many
from carom.simulation.interpreted import run_interpreted, worth_interpreting
from carom.simulation.loop import ALL, FULL, LIMIT, PHASES_FROM, QUIET, ROWS
from carom.simulation.many_runs import ManyRuns
from carom.simulation.records import KINDS, LOG, START
from carom.simulation.resolve import DONE, REFUSED_ROLLING, REFUSED_STALL, REFUSED_UNDEFINED
from carom.simulation.setup import set_up
from carom.simulation.trajectory import Trajectory

__all__ = ["MOST_EVENTS", "REFUSALS", "run_limits", "simulate", "simulate_many", "starts_of"]

Array = NDArray[np.float64]
# Where a scene names no end: a ball between elastic walls would never stop.
MOST_EVENTS = 100_000
# Events of all runs of a block in the first call of the compiled loop.
FIRST_EVENTS = 1 << 16
# Rows of the log that the loop fills before it is called again: enough for a shot, then more each time.
FIRST_ROWS, MOST_ROWS = 128, 65_536

REFUSALS = {
    REFUSED_ROLLING: "the wall's law is for a ball that rolls into a vertical wall (carom laws conventional); this one slides or"
    " flies there; the law two-step takes any ball",
    REFUSED_UNDEFINED: "a wall with tangential restitution presses the ball on the floor, which has no law; take"
    " tangential_restitution = 0, or floor_contact = 'after'",
    REFUSED_STALL: "wall and floor lock the ball between them, which is not followed to its end; take a smaller friction,"
    " or floor_contact = 'after'",
}


def _refusal(code: int, scene: Scene, ball: Any, i: int) -> CaromError:
    return CaromError(
        f"simulate: {scene.ball_names[i]}: expected an event that its law has an answer for, got one at"
        f" t = {float(ball['clock']):.6g} s, x = ({', '.join(f'{x:.4g}' for x in ball['x'])}): {REFUSALS[code]}"
    )


def run_limits(scene: Scene) -> tuple[float, int]:
    """Return until when, and for how many events at most, a scene is run."""
    run = scene.run
    most = run.max_events if run.max_events is not None else MOST_EVENTS if run.duration is None else 2**62
    return math.inf if run.duration is None else run.duration, most


def simulate(
    scene: Scene | str | Path,
    progress: Callable[[int, float], None] | None = None,
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
    progress : function of (events so far, simulated time in s), optional
        Called from time to time on long runs.
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
    require_type("simulate", "scene", scene, Scene)
    settings: dict[str, Any] = {"law": law, "duration": duration, "max_events": max_events}
    if given := {name: value for name, value in settings.items() if value is not None}:
        try:
            run = Run(**given)
        except CaromError as error:
            raise CaromError(*(fault.replace("Run:", "simulate:", 1) for fault in error.faults)) from None
        scene = replaced(scene, {f"run.{name}": getattr(run, name) for name in given})
    until, most = run_limits(scene)
    interpreted = worth_interpreting(scene)
    world, features, balls, users = set_up(scene, compiled=not interpreted)
    loop = run_interpreted if interpreted else compiled_engine().run
    log, parts = _rows(FIRST_ROWS + len(balls)), []
    events, status, slow = 0, FULL, -1.0
    pace = Pace(len(log))
    while status == FULL:
        pace.begin()
        answer = loop(world, features, balls, log, slow, until, most - events, users, ALL)
        if answer is not None:
            status, more, written, at_fault, slow, last = answer
            parts.append(log[:written])
            events += more
        if status == FULL:
            if interpreted and (answer is None or not worth_interpreting(scene)):
                interpreted, loop = False, compiled_engine().run
                world, features, _balls, users = set_up(scene)
            rows = 4 * len(log)
            if answer is not None:
                pace.done(written)
                rows = max(pace.amount, FIRST_ROWS)
            log = _rows(len(log) if interpreted else min(rows, MOST_ROWS))
            if progress is not None and answer is not None:
                progress(events, last)
    if status not in (DONE, QUIET, LIMIT):
        raise _refusal(status, scene, balls[at_fault], at_fault)
    if status == LIMIT:
        end, ended = last, "max_events"
    elif status == DONE and until < math.inf:
        end, ended = until, "duration"
    else:
        end, ended = last, "nothing more happens"
    return Trajectory(scene, _joined(parts), end, ended)


def _rows(count: int) -> NDArray[np.void]:
    """An empty log (records from bytes: NumPy takes three times as long for an array of records by itself)."""
    return np.frombuffer(np.empty(count * LOG.itemsize, np.uint8), LOG)


def _joined(parts: list[NDArray[np.void]]) -> NDArray[np.void]:
    """Parts of a log as one (records as bytes: NumPy copies the fields of records one by one, which takes a while)."""
    if len(parts) == 1:
        return parts[0]
    return np.concatenate([part.view(np.uint8) for part in parts]).view(LOG)


def simulate_many(
    scene: Scene,
    velocity: ArrayLike | None = None,
    spin: ArrayLike | None = None,
    position: ArrayLike | None = None,
    *,
    events: int = 0,
    kinds: tuple[str, ...] = (),
    progress: Callable[[int, int], None] | None = None,
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
    progress : function of (runs done, runs in total), optional

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
    names = [*KINDS, *PHASES]
    for kind in kinds:
        if kind not in names:
            faults.add(
                "kinds",
                f"kinds of events ({', '.join(sorted(set(names) - {'start', 'phase', 'nothing'}))})",
                repr(kind),
            )
    faults.raise_if_any()
    balls = starts_of("simulate_many", scene, velocity, spin, position)
    until, most = run_limits(scene)
    return _run_many(scene, balls, until, most, int(events), kinds, progress)


def starts_of(where: str, scene: Scene, velocity: Any, spin: Any, position: Any) -> NDArray[np.void]:
    """Return the balls (N, B) at their starts: the scene's, with the arrays that are given; CaromError for those it refuses."""
    faults = FaultList(where)
    given = {}
    for field, unit, value in (("v", "m/s", velocity), ("w", "rad/s", spin), ("x", "m", position)):
        if value is not None:
            given[field] = vectors(faults, {"v": "velocity", "w": "spin", "x": "position"}[field], value, unit)
    faults.raise_if_any()
    setup = set_up(scene)
    count = len(setup.balls)
    shape: tuple[int, ...] = (1, count)
    if count == 1:
        given = {field: array[:, None, :] if array.ndim == 2 else array for field, array in given.items()}
    for array in given.values():
        # (broadcast, one row a run would set all balls alike, and one row a ball would be one run)
        if count > 1 and (array.ndim != 3 or array.shape[1] != count):
            raise CaromError(
                f"{where}: expected states (N, {count}, 3), runs by balls by axes, got shape {array.shape}"
            )
        try:
            shape = np.broadcast_shapes(shape, array.shape[:-1])
        except ValueError:
            shape = ()
        if len(shape) != 2 or shape[1] != count:
            raise CaromError(f"{where}: expected states (N, {count}, 3), got shape {array.shape}")
    balls = np.empty(shape, setup.balls.dtype)
    balls[:] = setup.balls
    for field, array in given.items():
        balls[field] = array
    _check_starts(where, scene, balls, given)
    return balls


def _check_starts(where: str, scene: Scene, balls: NDArray[np.void], given: dict[str, Array]) -> None:
    """Raise CaromError for the first initial state that overlaps something, or lies where no ball can be."""
    if "x" not in given:
        return
    from carom.simulation.overlaps import overlapping

    bad = overlapping(set_up(scene), balls)
    places, which = np.unique(balls["x"].reshape(-1, 3), axis=0, return_inverse=True)
    blocked = np.array([any(wall.blocked(tuple(x)) for wall in scene.walls) for x in places.tolist()])
    bad |= blocked[which.reshape(balls.shape)].any(axis=1)
    if bad.any():
        n = int(np.flatnonzero(bad)[0])
        raise CaromError(
            f"{where}: position: expected places where the balls touch nothing, got {balls['x'][n].tolist()}"
            f" at index {n} ({int(bad.sum())} in all)"
        )


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
    return bits


def _run_many(
    scene: Scene, balls: NDArray[np.void], until: float, most: int, events: int, kinds: tuple[str, ...], progress: Any
) -> ManyRuns:
    many, setup = compiled_many(), set_up(scene)
    total = len(balls)
    ended, slow = np.zeros((total, 3), np.int64), np.full(total, -1.0)
    ended[:, 0] = LIMIT
    kept: list[NDArray[np.void]] = []
    room = events + ROWS - 1 if events else 0
    rows = room if events <= WHOLE_EVENTS else FIRST_ROWS
    for block in block_slices(total, BLOCK):
        logs, here = np.zeros((block.stop - block.start, rows), LOG), ended[block]
        pace, goes_on = Pace(FIRST_EVENTS), np.ones(len(logs), bool)
        while goes_on.any():  # (a few events of every run at a time)
            share = max(pace.begin() // len(logs), 1)
            if logs.shape[1] < room:
                logs = _with_room(logs, int(here[goes_on, 2].max()), room, total)
                if logs.shape[1] < room:
                    share = min(share, (logs.shape[1] - int(here[goes_on, 2].max())) // ROWS)
            many(
                setup.world, setup.features, balls[block], logs, slow[block], until, most, share, setup.users, _bits(kinds), here,
            )  # fmt: skip
            pace.done(share * len(logs))
            goes_on = (here[:, 0] == LIMIT) & (here[:, 1] < most)
        used = events if events <= WHOLE_EVENTS else min(events, int(here[:, 2].max()))
        kept.append(np.ascontiguousarray(logs[:, :used]))
        if progress is not None:
            progress(block.stop, total)
    first = _side_by_side(kept) if kept else np.zeros((0, events if events <= WHOLE_EVENTS else 0), LOG)
    first["t"][first["kind"] == START] = math.nan  # (no event is at no time: the least of a column is that of events)
    why = np.array([REFUSALS.get(int(code), "") for code in ended[:, 0]])
    final = State.of(np.array(balls["v"]), np.array(balls["w"]), np.array(balls["x"]))
    return ManyRuns(
        final, np.array(balls["phase"]), balls["clock"].max(axis=1), ended[:, 1].copy(), why, first, scene=scene
    )


def _with_room(logs: NDArray[np.void], written: int, room: int, total: int) -> NDArray[np.void]:
    """Return logs with room for events after ``written`` rows, at most ``room`` rows; CaromError where they would be too large."""
    if logs.shape[1] - written >= ROWS * LEAST_SHARE:
        return logs
    rows = min(room, 4 * logs.shape[1], int(MAX_KEPT_BYTES / LOG.itemsize / total))
    if rows < min(room, written + ROWS * LEAST_SHARE):
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
