"""The energy budget of a run: what was lost at walls, at the floor, between balls, and in between."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

from carom.simulation.records import BALL, FLOOR, WALL, first_kinds
from carom.simulation.trajectory import Trajectory

__all__ = ["Budget", "budget"]


class Budget(NamedTuple):
    """Energies of a run, J: at the start, lost where, at the end."""

    start: float
    walls: float
    floor: float
    """In landings."""
    balls: float
    """Where balls meet, and at walls that they touch meanwhile."""
    way: float
    """Between events: by sliding and rolling on the floor, and in bounces that are summed (phase bouncing)."""
    end: float


def budget(run: Trajectory) -> Budget:
    """Return the energy at the start, what was lost where, and what is left (kinetic and potential, as ``run.energy``).

    A ball that left, or is held, counts with the energy that it had last.
    """
    log = run.log
    before, after = (run.kinetic_energy(log["ball"], log[f"v{when}"], log[f"w{when}"]) for when in ("_before", ""))
    lost = np.asarray(before - after)
    start, end, kinds = run.start, run.final, first_kinds(log)
    walls, floor, balls = (float(lost[kinds == kind].sum()) for kind in (WALL, FLOOR, BALL))
    e0, e1 = _energy(run, start), _energy(run, end)
    return Budget(e0, walls, floor, balls, e0 - e1 - walls - floor - balls, e1)


def _energy(run: Trajectory, state: Any) -> float:
    balls = run.scene.balls
    base = np.array([[0.0, 0.0, ball.radius if run.scene.floor is not None else 0.0] for ball in balls])
    lift = -((state.position - base) * np.array(run.scene.pull)).sum(axis=1) * np.array([ball.mass for ball in balls])
    return float(np.sum(run.kinetic_energy(slice(None), state.velocity, state.spin) + lift))
