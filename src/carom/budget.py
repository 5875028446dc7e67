"""Where the energy of a run went."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

from carom.engine.arrays import BALL, FLOOR, WALL
from carom.trajectory import Trajectory

__all__ = ["Budget", "budget"]


class Budget(NamedTuple):
    """Where the energy of a run went, J."""

    start: float
    walls: float
    floor: float
    """In landings."""
    balls: float
    """Where balls meet."""
    way: float
    """On the way: sliding and rolling on the floor, and hops too low to be landings."""
    end: float


def budget(run: Trajectory) -> Budget:
    """Energy at the start, what was lost where, and what is left (kinetic and potential, as ``run.energy``).

    Of a ball that left or is held, what it had when it was last seen.
    """
    log = run.log
    lost = run._kinetic(log["ball"], log["v_before"], log["w_before"]) - run._kinetic(log["ball"], log["v"], log["w"])
    start, end = run.start, run.final
    at = {kind: float(lost[log["kind"] == kind].sum()) for kind in (WALL, FLOOR, BALL)}
    e0, e1 = _energy(run, start), _energy(run, end)
    way = e0 - e1 - sum(at.values())
    return Budget(e0, at[WALL], at[FLOOR], at[BALL], way, e1)


def _energy(run: Trajectory, state: Any) -> float:
    balls = run.scene.balls
    base = np.array([[0.0, 0.0, ball.radius if run.scene.floor is not None else 0.0] for ball in balls])
    lift = -((state.position - base) * np.array(run.scene.gravity)).sum(axis=1) * np.array(
        [ball.mass for ball in balls]
    )
    return float((run._kinetic(slice(None), state.velocity, state.spin) + lift).sum())
