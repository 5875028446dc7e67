"""The result of many runs of one scene: final states, and selected events of each."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from carom.bodies import Numbers, State
from carom.core.motion.phases import PHASES
from carom.formatting import counted
from carom.scene.scene import Scene
from carom.simulation.records import START
from carom.simulation.setup import set_up
from carom.simulation.tables import kinetic_energy, many_events_table

if TYPE_CHECKING:
    import pandas

__all__ = ["ManyRuns"]


@dataclass(frozen=True, eq=False, repr=False)
class ManyRuns:
    """Final states of N runs of B balls, and selected events, at most M per run.

    Examples
    --------
    >>> import carom
    >>> ball = carom.SceneBall(radius=0.03, mass=0.2, position=(0, 0))
    >>> scene = carom.Scene(floor=carom.Floor(friction=0.2, rolling_resistance=0.01), balls=[ball])
    >>> runs = carom.simulate_many(scene, velocity=[[1, 0, 0], [2, 0, 0]], events=2)
    >>> runs
    <ManyRuns: 2 runs of 1 ball, 4 events kept>
    >>> runs.final.position[:, 0, 0].round(3), runs.count
    (array([ 2.726, 10.905]), array([2, 2]))
    >>> runs.table()[["run", "t", "kind"]].round(3).values.tolist()
    [[0, 0.146, 'rolling'], [0, 7.429, 'rest'], [1, 0.291, 'rolling'], [1, 14.859, 'rest']]
    """

    final: State
    """(N, B, 3)."""
    code: NDArray[np.int64]
    """(N, B): final phases as numbers; ``phase`` has their names."""
    end: NDArray[np.float64]
    """(N,), s: time up to which each run was followed."""
    count: NDArray[np.int64]
    """(N,): number of events."""
    why: NDArray[np.str_]
    """(N,): empty, or why a run ended at an event for which a law has no answer."""
    events: NDArray[np.void]
    """(N, M) rows of the log, the first M selected events of each run (M: ``events``; above a thousand, what the longest has):
    ``t``, ``ball``, ``x``, ``v_before``, ``w_before``, ``v``,
    ``w`` and more; :meth:`table` has names for what is a number here. ``kind``: 1 wall, 2 floor, 3 ball, 4 another phase begins,
    5 settled, 6 left, 7 held, 9 pocketed; 0, with ``t`` NaN, where a run has fewer events. ``other``: number of the wall, ball or
    pocket, or -1. ``phase``, ``phase_before``: 0 flight, 1 sliding, 2 rolling, 3 pivoting, 4 rest, 5 bouncing, 6 held, 7 left,
    8 pocketed. ``regime``: 0 graze, 1 stick, 2 slide, 3 jam, -1 none."""
    scene: Scene = field(kw_only=True)
    """The scene; the runs have other starts than its balls."""

    @property
    def phase(self) -> NDArray[np.str_]:
        """(N, B): flight, sliding, rolling, pivoting, rest, bouncing, held, left, pocketed."""
        return np.array(PHASES)[self.code]

    def kinetic_energy(self, ball: Any, velocity: NDArray[np.float64], spin: NDArray[np.float64]) -> Numbers:
        """Return the kinetic energies, J, of balls given by number (N,) at velocities and spins (N, 3)."""
        return kinetic_energy(set_up(self.scene, compiled=False).balls, ball, velocity, spin)

    def table(self) -> pandas.DataFrame:
        """Return the events as a pandas DataFrame, one row each, with the columns of ``run.events.table()`` after ``run``.

        CaromError without pandas.
        """
        return many_events_table(self, self.events)

    to_pandas = table

    def __repr__(self) -> str:
        """Return one line."""
        runs, balls = self.code.shape
        kept = int((self.events["kind"] != START).sum())
        refused = int((self.why != "").sum())
        more = f", {refused:,} without an answer of the law" if refused else ""
        return f"<ManyRuns: {counted(runs, 'run')} of {counted(balls, 'ball')}, {counted(kept, 'event')} kept{more}>"
