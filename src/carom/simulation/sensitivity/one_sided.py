"""One-sided derivatives: at a change of regime those for a smaller and for a greater value of a parameter differ."""

from __future__ import annotations

import warnings
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from carom.errors import CaromError
from carom.simulation.records import BALL, WALL
from carom.simulation.run_log import run_scene
from carom.simulation.sensitivity.follow import follow
from carom.simulation.sensitivity.margins import EXACT, impacts_at_once
from carom.simulation.sensitivity.parameters import parameters_of
from carom.simulation.sensitivity.passages import Passages, StateSensitivity
from carom.simulation.sensitivity.seeds import Column, shifted_scene

__all__ = ["OneSided", "one_sided", "warn_of_switches"]

Array = NDArray[np.float64]
STEP = 1e-9  # of a parameter: so far from the switch a run is differentiated, and a sixteenth of it
GROWS = 1e-3  # change of the derivatives between these two steps that is too large for them to have a limit


class OneSided(NamedTuple):
    """Derivatives of the final states for values of each parameter below, and above, the scene's value."""

    below: StateSensitivity
    above: StateSensitivity


def one_sided(run: Any, columns: list[Column]) -> OneSided:
    """Return the derivatives of a run's final states on both sides of each parameter's value.

    The run is repeated a little on each side, with the other parameters as they are, and its derivatives there are extrapolated
    to the value. CaromError where they grow without bound, as for a ball that just touches.
    """
    sides = [np.stack([_limit(run, one, sign) for one in columns], axis=-1) for sign in (-1, 1)]
    return OneSided(*(StateSensitivity(*one) for one in sides))


def _limit(run: Any, column: Column, sign: int) -> Array:
    """Return the derivatives (3, B, 3) of final positions, velocities and spins on one side."""
    step = sign * STEP * (abs(column.value) or 1.0)
    far, near = (_beside(run, column, by) for by in (step, step / 16))
    size = np.abs(near).max(axis=(1, 2), keepdims=True)
    if not (np.abs(far - near) <= GROWS * size).all():
        raise CaromError(
            f"sensitivity: {column.name}: expected derivatives with a limit at {column.value:.9g}, got some that grow without"
            f" bound for {'smaller' if sign < 0 else 'greater'} values, as at a graze; move a start a little"
        )
    return np.asarray((16 * near - far) / 15)


def _beside(run: Any, column: Column, by: float) -> Array:
    scene = shifted_scene(run.scene, column, by)
    there = run_scene(scene)
    # (of a run that ends because nothing more happens, the states at rest)
    end = there.end if run.ended == there.ended == "nothing more happens" else min(run.end, there.end)
    first = there.log[: len(scene.balls)]
    parameters = parameters_of(scene, there.arrays, column.path, first["phase"].tolist())
    passages = follow(scene, parameters, there.log, there.end)
    c = [one.name for one in parameters.columns].index(column.name)
    return np.stack([part[..., c] for part in passages.at(end)])


def warn_of_switches(run: Any, passages: Passages) -> None:
    """Warn of events that are exactly at a switch, where derivatives are one-sided."""
    log, first = run.log, len(run.scene.balls)
    required, friction = passages.values["required"], passages.values["friction"]
    border = np.flatnonzero((required >= (1 - EXACT) * friction) & (required <= (1 + EXACT) * friction))
    found = {k: "at the border of sticking and slipping" for k in border.tolist() if _sticks_just(log[k], friction[k])}
    found |= dict.fromkeys(_ties(log), "at the same time as another impact of this ball")
    if found:
        k = min(found)
        more = f" (and {len(found) - 1} more)" if len(found) > 1 else ""
        warnings.warn(
            f"sensitivity: events[{k - first}] ({log['t'][k]:.9g} s, ball {int(log['ball'][k])}): {found[k]}{more}: derivatives are"
            " those of one side; one_sided() has both",
            stacklevel=4,
        )


def _sticks_just(row: Any, friction: float) -> bool:
    """Return whether the required friction is the border's (a pressed ball that slides requires all there is)."""
    return bool(0 < friction < np.inf and not np.any(row["floor_impulse"]))


def _ties(log: Any) -> list[int]:
    """Return the rows of impacts at the same time as another impact of their ball."""
    t, kind = log["t"], log["kind"]
    hits = (kind == WALL) | (kind == BALL)
    soon = np.flatnonzero(hits[1:] & hits[:-1] & (t[1:] - t[:-1] <= EXACT * t[1:]))
    # (of most there is nothing to look at: the two rows of one meeting of two balls)
    ball, other = log["ball"], log["other"]
    met = (kind[soon + 1] == BALL) & (other[soon] == ball[soon + 1]) & (ball[soon] == other[soon + 1])
    return [k for k in (soon[~met] + 1).tolist() if impacts_at_once(log, k, [ball[k]])[:k].any()]
