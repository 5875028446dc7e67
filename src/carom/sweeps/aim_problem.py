"""A scene, the numbers of its start that may be chosen, and targets: by what starts miss them, many at once and one by one."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from carom.core.motion.phases import BOUNCING, FLIGHT, ROLLING, SLIDING
from carom.scene.paths import path_match, replaced
from carom.scene.scene import Scene
from carom.simulation.records import START
from carom.simulation.setup import set_up
from carom.simulation.simulate import simulate, simulate_many
from carom.sweeps.starts import start_states
from carom.sweeps.targets import Outcomes, TargetEvent, find, is_reached, residuals, sizes, slopes
from carom.sweeps.unknowns import ERRORS, Unknown, columns_at, slopes_at, values_at

__all__ = ["AimProblem", "CoarseSweep", "Signature", "signature"]

Array = NDArray[np.float64]
Signature = tuple[tuple[int, ...], ...]
MOVING = (FLIGHT, SLIDING, ROLLING, BOUNCING)
KINDS = ("wall", "ball", "pocketed")
FOLLOWED = 20  # of walls, balls and pockets, that a run is followed for in the coarse sweep
MOST_FOLLOWED = 8**3 * FOLLOWED  # where it is judged whether shots succeed
ROWS_AT_ONCE = 1 << 18  # of logs, some 300 bytes each


class CoarseSweep(NamedTuple):
    """Results of N starts."""

    x: Array
    """(N, U)."""
    miss: Array
    """(N,): by what they miss the target that they miss by most, as a share of what is allowed; inf without its event."""
    reached: NDArray[np.bool_]
    """(N,): whether they reach all targets."""
    rows: NDArray[np.int64]
    """(N, T): of the targets' events."""
    codes: NDArray[np.int32]
    """(N, FOLLOWED, 3): what happens; zeros after the last event."""
    moves: NDArray[np.bool_]
    """(N,): whether a ball that is to end at a place still moves when the run ends."""


class AimProblem:
    """A scene, its unknowns, and its targets."""

    def __init__(self, scene: Scene, unknowns: list[Unknown], targets: list[TargetEvent]) -> None:
        self.scene, self.unknowns, self.targets = scene, unknowns, targets
        self.low = np.array([one.low for one in unknowns])
        self.high = np.array([one.high for one in unknowns])
        self.paths = list(values_at(unknowns, self.low))

    def sigma(self, x: Array) -> Array:
        """Return the player's errors (U,) at a start."""
        return np.array([one.sigma(value) for one, value in zip(self.unknowns, x, strict=True)])

    def scale(self, x: Array) -> Array:
        """Return (U,) what is a small step at a start: the player's errors, and where there is none the usual one."""
        usual = np.array(
            [one._replace(error=ERRORS[one.name]).sigma(v) for one, v in zip(self.unknowns, x, strict=True)]
        )
        return np.where(self.sigma(x) > 0, self.sigma(x), usual)

    def wrapped(self, x: Array) -> Array:
        """Return starts with angles that go round within their range."""
        circular = np.array([one.circular for one in self.unknowns])
        return np.where(circular, self.low + np.mod(x - self.low, 360.0), x)

    # --- many runs ---------------------------------------------------------------------------------------------------

    def outcomes(self, x: Array, events: int) -> tuple[Outcomes, NDArray[np.bool_]]:
        """Return the runs of starts (N, U), with the first ``events`` of walls, balls and pockets, and which of them can be run."""
        arrays = set_up(self.scene).for_runs(len(x))
        columns = {path_match(self.scene, path): column for path, column in columns_at(self.unknowns, x).items()}
        doubtful = start_states(self.scene, columns, arrays)
        many = simulate_many(self.scene, arrays.balls["v"], arrays.balls["w"], events=events, kinds=KINDS)
        return Outcomes(many.events, np.asarray(many.final.position), many.code), ~doubtful & (many.why == "")

    def run_many(
        self, x: Array, events: int = FOLLOWED
    ) -> tuple[Array, NDArray[np.bool_], NDArray[np.int64], Outcomes]:
        """Return by what (N, T) starts (N, U) miss the targets, which (N,) reach all, their events' rows (N, T), and outcomes."""
        done, runs = self.outcomes(x, events)
        rows = np.stack([find(target, done.log) for target in self.targets], axis=1)
        missed = [residuals(target, done, row) for target, row in zip(self.targets, rows.T, strict=True)]
        size = np.stack([sizes(target, one) for target, one in zip(self.targets, missed, strict=True)], axis=1)
        reached = np.all([is_reached(target, one) for target, one in zip(self.targets, missed, strict=True)], axis=0)
        return np.where(runs[:, None], size, np.inf), reached & runs, rows, done

    def sweep(self, x: Array) -> CoarseSweep:
        """Return the results of starts (N, U)."""
        parts = []
        places = [target.ball for target in self.targets if target.kind == "point"]
        for part in np.array_split(x, math.ceil(len(x) * FOLLOWED / ROWS_AT_ONCE)):
            size, reached, rows, done = self.run_many(part)
            moves = np.asarray(np.isin(done.phase[:, places], MOVING).any(axis=1))
            parts.append(CoarseSweep(part, size.max(axis=1), reached, rows, codes_of(done.log), moves))
        return CoarseSweep(*(np.concatenate(columns) for columns in zip(*parts, strict=True)))

    def judge(self, x: Array) -> tuple[Array, NDArray[np.bool_]]:
        """Return by what (N, T) starts (N, U) miss the targets, and which (N,) reach all of them, however late."""
        size, reached = np.full((len(x), len(self.targets)), np.inf), np.zeros(len(x), bool)
        by_event = [target.kind != "point" for target in self.targets]
        events, open_ = FOLLOWED, np.arange(len(x))
        while len(open_) and events <= MOST_FOLLOWED:
            later = []
            for part in np.array_split(open_, math.ceil(len(open_) * events / ROWS_AT_ONCE)):
                size[part], reached[part], rows, done = self.run_many(x[part], events)
                goes_on = done.log["kind"][:, -1] != START
                later.append(part[goes_on & (rows[:, by_event] < 0).any(axis=1)])
            open_, events = np.concatenate(later), 8 * events
        return size, reached

    # --- one run -----------------------------------------------------------------------------------------------------

    def follow(self, x: Array) -> tuple[Any, Signature, list[int]]:
        """Run a start; return the run, the sequence of its events up to the last target, and the rows of the targets."""
        run = simulate(replaced(self.scene, values_at(self.unknowns, x)))
        log = Outcomes.of_run(run).log
        found = [int(find(target, log)[0]) for target in self.targets]
        return run, signature(codes_of(log)[0], self.targets, found), found

    def miss(self, run: Any, found: list[int], derivatives: Any, x: Array) -> tuple[Array, Array]:
        """Return a run's misses of the targets, as shares of what is allowed (R,), and its derivatives (R, U)."""
        parts = [slopes(target, run, row, derivatives) for target, row in zip(self.targets, found, strict=True)]
        return np.concatenate(self.missed(run, found)), np.concatenate(parts) @ slopes_at(
            self.unknowns, x, derivatives.columns
        )

    def missed(self, run: Any, found: list[int]) -> list[Array]:
        """Return a run's miss of each target, (R,) as shares of what is allowed."""
        done = Outcomes.of_run(run)
        return [residuals(target, done, np.array([row]))[0] for target, row in zip(self.targets, found, strict=True)]

    def reaches(self, run: Any, found: list[int]) -> bool:
        """Return whether a run reaches all targets."""
        pairs = zip(self.targets, self.missed(run, found), strict=True)
        return all(is_reached(target, missed[None, :])[0] for target, missed in pairs)


def codes_of(log: NDArray[np.void]) -> NDArray[np.int32]:
    """Return the events in logs (N, M): kind, ball, and which wall, ball or pocket it meets, (N, M, 3)."""
    return np.stack([log["kind"], log["ball"], log["other"]], axis=-1).astype(np.int32)


def signature(codes: NDArray[np.int32], targets: Sequence[TargetEvent], found: Sequence[int]) -> Signature:
    """Return the events (M, 3) that the targets depend on: all of them for a place, the ones up to the target's event else."""
    to_the_end = any(target.kind == "point" for target in targets)
    count = int((codes[:, 0] != START).sum()) if to_the_end else max(found, default=-1) + 1
    return tuple((kind, ball, other) for kind, ball, other in codes[:count].tolist())
