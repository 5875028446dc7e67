"""Run a scene once: the log of its events, and when and why it ends (:func:`carom.simulate` makes a Trajectory of it)."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from carom.scene.scene import Scene
from carom.simulation.contacts.contact import DONE
from carom.simulation.loop import LIMIT
from carom.simulation.scene_loop import SceneLoop
from carom.simulation.setup import SceneArrays

__all__ = ["MOST_EVENTS", "RunLog", "run_limits", "run_scene"]

# Where a scene names no end: a ball between elastic walls would never stop.
MOST_EVENTS = 100_000


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
    loop = SceneLoop(scene)
    status, _events, log = loop.follow(until, most, progress)
    if status == LIMIT:
        end, ended = loop.last, "max_events"
    elif status == DONE and until < math.inf:
        end, ended = until, "duration"
    else:
        end, ended = loop.last, "nothing more happens"
    return RunLog(scene, log, end, ended, loop.arrays)
