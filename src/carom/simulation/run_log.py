"""Run a scene once: the log of its events, and when and why it ends (:func:`carom.simulate` makes a Trajectory of it)."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from carom.core.jit.slices import Pace
from carom.errors import CaromError
from carom.scene.scene import Scene
from carom.simulation.compiled import compiled_engine
from carom.simulation.contacts.contact import DONE
from carom.simulation.contacts.kinds import REFUSALS
from carom.simulation.event_rows import ALL
from carom.simulation.interpreted import MOST_FEATURES, run_interpreted, worth_interpreting
from carom.simulation.loop import FULL, LIMIT, QUIET
from carom.simulation.records import LOG
from carom.simulation.setup import SceneArrays, set_up

__all__ = ["FIRST_ROWS", "MOST_EVENTS", "RunLog", "run_limits", "run_scene"]

# Where a scene names no end: a ball between elastic walls would never stop.
MOST_EVENTS = 100_000
# Rows of the log that the loop fills before it is called again: enough for a shot, then more each time.
FIRST_ROWS, MOST_ROWS = 128, 65_536


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


class RunLog(NamedTuple):
    """One run of a scene, as the event loop leaves it."""

    scene: Scene
    log: NDArray[np.void]
    """Rows of the balls' starts and of the events (carom.simulation.records.LOG)."""
    end: float
    """s: time up to which the balls were followed."""
    ended: str
    """Why it ended: "nothing more happens", "duration", "max_events"."""
    arrays: SceneArrays
    """The scene as the loop read it."""


def run_scene(scene: Scene, progress: Callable[[int, float], None] | None = None) -> RunLog:
    """Run a scene event by event, as Python or compiled, with the same bits.

    ``progress`` is called with the events so far and the simulated time, s. Raises CaromError for an event for which a law has no
    answer.
    """
    until, most = run_limits(scene)
    interpreted = worth_interpreting(scene)
    arrays = set_up(scene, compiled=not interpreted)
    if interpreted and len(arrays.features) > MOST_FEATURES:
        interpreted, arrays = False, set_up(scene)
    balls = arrays.balls_to_move()
    loop = run_interpreted if interpreted else compiled_engine().run
    log, parts = _rows(FIRST_ROWS + len(balls)), []
    events, status, slow = 0, FULL, -1.0
    pace = Pace(len(log))
    while status == FULL:
        pace.begin()
        answer = loop(arrays.world, arrays.features, balls, log, slow, until, most - events, arrays.users, ALL)
        if answer is not None:
            status, more, written, at_fault, slow, last = answer
            parts.append(log[:written])
            events += more
        if status == FULL:
            if interpreted and (answer is None or not worth_interpreting(scene)):
                interpreted, loop, arrays = False, compiled_engine().run, set_up(scene)
            rows = 4 * len(log)
            if answer is not None:
                pace.done(written)
                rows = max(pace.amount, FIRST_ROWS + len(balls))
            log = _rows(len(log) if interpreted else min(rows, MOST_ROWS + len(balls)))
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
    return RunLog(scene, _joined(parts), end, ended, arrays)


def _rows(count: int) -> NDArray[np.void]:
    """An empty log (records from bytes: NumPy takes three times as long for an array of records by itself)."""
    return np.frombuffer(np.empty(count * LOG.itemsize, np.uint8), LOG)


def _joined(parts: list[NDArray[np.void]]) -> NDArray[np.void]:
    """Parts of a log as one (records as bytes: NumPy copies the fields of records one by one, which takes a while)."""
    if len(parts) == 1:
        return parts[0]
    return np.concatenate([part.view(np.uint8) for part in parts]).view(LOG)
