"""The one compiled loop over many runs: of a scene, or of a sweep's scenes; events are counted, and some of them kept."""

from __future__ import annotations

import functools
import math
from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import NDArray

from carom.core.geometry.features import FEATURES
from carom.core.jit.compile import array_of, njit, signature
from carom.core.jit.kernel import kernel, prange, vector
from carom.core.motion.phases import PHASES
from carom.simulation.compiled import compiled_engine, plain_engine
from carom.simulation.contacts.contact import DONE
from carom.simulation.event_rows import PHASES_FROM, rows_of_an_event
from carom.simulation.loop import LIMIT, QUIET
from carom.simulation.motion import write_vector
from carom.simulation.records import BALLS, LOG, PHASE, WALL, WALL_IN_CLUSTER, WORLD

__all__ = ["LOG_ROWS", "LOOP", "PARTS", "ROWS_KEPT", "compiled_many", "empty_counts", "empty_logs"]

# Codes of events: kinds, and from PHASES_FROM on the phases that begin.
CODES = PHASES_FROM + len(PHASES)
# In the place after the last code stands how many rows were kept, where the first ones are.
ROWS_KEPT = CODES
PARTS = 64  # of the runs that threads take
LOG_ROWS = 128  # of the log of a thread, which is read and emptied again and again


def empty_logs(parts: int, rows: int = LOG_ROWS) -> NDArray[np.void]:
    """Return the logs of so many parts of the runs."""
    return np.empty((parts, rows), LOG)


def empty_counts(runs: int) -> NDArray[np.int64]:
    """Return the counts of events of so many runs, by code, and of the rows kept."""
    return np.zeros((runs, CODES + 1), np.int64)


@kernel
def _copy(to: Any, row: Any) -> None:
    """Copy a row of a log."""
    to.t, to.kind, to.ball, to.met, to.other = row.t, row.kind, row.ball, row.met, row.other
    write_vector(to.x, vector(row.x))
    write_vector(to.v_before, vector(row.v_before))
    write_vector(to.w_before, vector(row.w_before))
    write_vector(to.v, vector(row.v))
    write_vector(to.w, vector(row.w))
    to.phase_before, to.phase = row.phase_before, row.phase
    write_vector(to.impulse, vector(row.impulse))
    write_vector(to.floor_impulse, vector(row.floor_impulse))
    to.required, to.regime = row.required, row.regime


@kernel
def _keep_rows(log: Any, rows: int, wanted: Any, counts: Any, kept: Any) -> None:
    """Count the events of a log by their codes, and keep some of them: this is all that remains of a run's log.

    Kept are those that are wanted, (W, 2) code and which of its kind, in W places; with W = 0 the first ones, as many as there are
    places.
    """
    for r in range(rows):
        code = PHASES_FROM + log[r].phase if log[r].kind == PHASE else log[r].kind
        code = WALL if code == WALL_IN_CLUSTER else code
        for j in range(wanted.shape[0]):
            if wanted[j, 0] == code and wanted[j, 1] == counts[code]:
                _copy(kept[j], log[r])
        counts[code] += 1
    if wanted.shape[0] == 0:
        for r in range(min(rows, kept.shape[0] - counts[ROWS_KEPT])):
            _copy(kept[counts[ROWS_KEPT]], log[r])
            counts[ROWS_KEPT] += 1


# What the loop returns and takes.
LOOP = (
    None, array_of(WORLD), array_of(FEATURES, 2), array_of(BALLS, 2), array_of(LOG, 2), array_of(float), float, int, int,
    array_of(int), int, array_of(int, 2), array_of(int, 2), array_of(LOG, 2), array_of(int, 2),
)  # fmt: skip

# The compiled functions, once there are any (a closure over them would not be cached).
_run: Any
_finish: Any
_run, _finish = plain_engine()


def _many(
    worlds: Any, features: Any, balls: Any, logs: Any, slow: Any, until: float, most: int, share: int, users: Any, keep: int,
    wanted: Any, counts: Any, kept: Any, ended: Any,
) -> None:  # fmt: skip
    """Continue every run of ``balls`` (N, B) by at most ``share`` events.

    ``worlds`` (1 or N,), ``features`` (1 or N, F): of all runs, or of each; ``logs`` (T, rows): of each of T parts of the runs;
    ``counts`` (N, CODES + 1) and ``kept`` (N, W): :func:`_keep_rows`; ``ended`` (N, 2): status and number of events. A run goes on
    while its status is LIMIT, with fewer than ``most`` events.
    """
    total, parts = balls.shape[0], logs.shape[0]
    for part in prange(parts):
        log = logs[part]
        for n in range(part, total, parts):  # (neighbours cost about the same: every part has its share of them)
            here = n if worlds.shape[0] > 1 else 0
            shape = features[n if features.shape[0] > 1 else 0]
            left = min(share, most - ended[n, 1])
            while ended[n, 0] == LIMIT and left > 0:
                # (a full log loses rows, and one event may write several of them)
                many = rows_of_an_event(balls.shape[1], shape.shape[0], keep, log.shape[0])
                step = min(left, log.shape[0] // many) if keep != 0 else left
                status, events, rows, _ball, slow[n], last = _run(
                    worlds[here : here + 1], shape, balls[n], log, slow[n], until, step, users, keep
                )
                _keep_rows(log, rows, wanted, counts[n], kept[n])
                left -= events
                ended[n, 0], ended[n, 1] = status, ended[n, 1] + events
                if status != LIMIT or ended[n, 1] >= most:
                    _finish(
                        worlds[here : here + 1],
                        balls[n],
                        until if until < math.inf and status in (DONE, QUIET) else last,
                    )


@functools.cache
def compiled_many() -> Callable[..., None]:
    """Return the compiled loop, which uses all cores."""
    global _run, _finish
    _run, _finish = compiled_engine()
    return njit(_many, signature(*LOOP), parallel=True)
