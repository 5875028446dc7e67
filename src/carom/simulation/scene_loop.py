"""The event loop of one scene, as Python or compiled with the same bits, which goes on where it stopped."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

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
from carom.simulation.setup import set_up

__all__ = ["FIRST_ROWS", "SceneLoop"]

# Rows of the log that the loop fills before it is called again: enough for a shot, then more each time.
FIRST_ROWS, MOST_ROWS = 128, 65_536


class SceneLoop:
    """A scene's balls, which the loop moves from event to event."""

    def __init__(self, scene: Scene) -> None:
        self.scene = scene
        self._interpreted = worth_interpreting(scene)
        self.arrays = set_up(scene, compiled=not self._interpreted)
        """The scene as the loop reads it."""
        if self._interpreted and len(self.arrays.features) > MOST_FEATURES:
            self._interpreted, self.arrays = False, set_up(scene)
        self.balls = self.arrays.balls_to_move()
        """(B,) of BALLS, each at its last event."""
        self.slow = -1.0
        """Speed below which a ball in contact is not approaching; less than 0 before the first event."""
        self.last = 0.0
        """Time of the last event, s."""
        self._loop: Callable[..., Any] = run_interpreted if self._interpreted else compiled_engine().run

    def follow(
        self, until: float, most: int, progress: Callable[[int, float], None] | None = None
    ) -> tuple[int, int, NDArray[np.void]]:
        """Run events until a time, or so many at most; return how that ended (DONE, QUIET, LIMIT), their number, the log's rows.

        ``progress`` is called with the events so far and the time, s. CaromError for an event for which a law has no answer.
        """
        log, parts = _rows(FIRST_ROWS + len(self.balls)), []
        events, status = 0, FULL
        pace = Pace(len(log))
        while status == FULL:
            pace.begin()
            world, features, users = self.arrays.world, self.arrays.features, self.arrays.users
            answer = self._loop(world, features, self.balls, log, self.slow, until, most - events, users, ALL)
            if answer is not None:
                status, more, written, at_fault, self.slow, self.last = answer
                parts.append(log[:written])
                events += more
            if status == FULL:
                if self._interpreted and (answer is None or not worth_interpreting(self.scene)):
                    self._interpreted, self._loop = False, compiled_engine().run
                    self.arrays = set_up(self.scene)
                rows = 4 * len(log)
                if answer is not None:
                    pace.done(written)
                    rows = max(pace.amount, FIRST_ROWS + len(self.balls))
                log = _rows(len(log) if self._interpreted else min(rows, MOST_ROWS + len(self.balls)))
                if progress is not None and answer is not None:
                    progress(events, self.last)
        if status not in (DONE, QUIET, LIMIT):
            raise _refusal(status, self.scene, self.balls[at_fault], at_fault)
        return status, events, _joined(parts)


def _refusal(code: int, scene: Scene, ball: Any, i: int) -> CaromError:
    return CaromError(
        f"simulate: {scene.ball_names[i]}: expected an event that its law has an answer for, got one at"
        f" t = {float(ball['clock']):.6g} s, x = ({', '.join(f'{x:.4g}' for x in ball['x'])}): {REFUSALS[code]}"
    )


def _rows(count: int) -> NDArray[np.void]:
    """An empty log (records from bytes: NumPy takes three times as long for an array of records by itself)."""
    return np.frombuffer(np.empty(count * LOG.itemsize, np.uint8), LOG)


def _joined(parts: list[NDArray[np.void]]) -> NDArray[np.void]:
    """Parts of a log as one (records as bytes: NumPy copies the fields of records one by one, which takes a while)."""
    if len(parts) == 1:
        return parts[0]
    return np.concatenate([part.view(np.uint8) for part in parts]).view(LOG)
