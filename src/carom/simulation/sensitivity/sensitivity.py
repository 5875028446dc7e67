"""The sensitivity of a run: derivatives of its events and states with respect to numbers of its scene, and how far they hold."""

from __future__ import annotations

import functools
import warnings
from collections.abc import Iterable
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from carom.errors import CaromError
from carom.formatting import Listing, format_number
from carom.simulation.records import BALL, START, WALL
from carom.simulation.sensitivity.follow import follow
from carom.simulation.sensitivity.margins import EXACT, Margin, NearMiss, impacts_at_once, margins, near_misses
from carom.simulation.sensitivity.passages import PLACES, Passages, StateSensitivity
from carom.simulation.sensitivity.seeds import Parameters, parameters_of

Array = NDArray[np.float64]


class EventSensitivity(NamedTuple):
    """Derivatives of one event: of its time (p,), and of the ball's state there, each (3, p), at the time that changes with it."""

    time: Array
    position: Array
    velocity: Array
    spin: Array
    velocity_before: Array
    spin_before: Array


class Sensitivity:
    """Derivatives of a run; made by :meth:`carom.Trajectory.sensitivity`."""

    def __init__(self, run: Any, parameters: Parameters, passages: Passages) -> None:
        self._run, self._passages, self._parameters = run, passages, parameters
        self.parameters = columns = parameters.columns
        self.columns: list[str] = [one.name for one in columns]
        """Names of the p parameters."""
        self.values = np.array([one.value for one in columns])
        """Their values in the scene (p,)."""

    def __reduce__(self) -> tuple[Any, ...]:
        """Pickle the run and the parameters: the derivatives are computed again, with the same bits."""
        return sensitivity, (self._run, self._parameters.wrt)

    @property
    def events(self) -> list[EventSensitivity]:
        """Derivatives of each event, in the order of ``run.events``."""
        d = self._passages.derivatives[len(self._run.scene.balls) :]
        time, *motion = (d[:, PLACES[name]] for name in ("time", "x", "v", "w", "v_before", "w_before"))
        return [EventSensitivity(t[0], *rest) for t, *rest in zip(time, *motion, strict=True)]

    def at(self, t: ArrayLike) -> StateSensitivity:
        """Return the derivatives of all states at a fixed time, s, or at times (...): each (B, 3, p), or (..., B, 3, p)."""
        times = np.asarray(t, dtype=float)
        self._run.at(times if times.size else 0.0)  # (which refuses times before and after the run)
        return self._passages.at(times)

    @property
    def final(self) -> StateSensitivity:
        """Derivatives of the final states, at the fixed time ``run.end``."""
        return self._passages.at(self._run.end)

    @functools.cached_property
    def margin(self) -> list[Margin]:
        """For each event the nearest switch: graze, stick or slip, roll or slide, or the order of two events of one ball."""
        return margins(self._run, self._parameters, self._passages)

    @functools.cached_property
    def near_misses(self) -> list[NearMiss]:
        """Objects that balls pass without touching; first the object that the smallest change of the parameters makes a contact."""
        return near_misses(self._run, self._parameters, self._passages)

    @property
    def radius(self) -> float:
        """Length of the shortest change of the parameters (in their units) that changes the sequence of events, to first order."""
        radii = [one.radius for one in self.margin] + [one.radius for one in self.near_misses]
        return min(radii, default=np.inf)

    def what_matters(self) -> Array:
        """Return how far each ball's final place moves when a parameter changes by 1 %, an angle by 1 degree: (B, p), m."""
        changes = np.where([is_angle(name) for name in self.columns], 1.0, np.abs(self.values) / 100)
        return np.asarray(np.linalg.norm(self.final.position, axis=1) * changes)

    def table(self) -> Listing:
        """Return the displacements of final places, mm, for a change of each parameter by 1 % or 1 degree; the largest first."""
        moved = 1e3 * self.what_matters()
        order = np.argsort(-moved.max(axis=0), kind="stable")
        rows = [
            [self.columns[c], format_number(self.values[c]), *map(format_number, moved[:, c])] for c in order.tolist()
        ]
        return Listing(["mm per cent", "value", *self._run.scene.ball_names], rows)

    def __repr__(self) -> str:
        """One line."""
        return f"<Sensitivity: {len(self.columns)} parameters, {len(self.events)} events>"


def is_angle(parameter: str) -> bool:
    """Return whether a number of a scene is an angle in degrees, of which a per cent means nothing."""
    return parameter.endswith((".azimuth", ".elevation"))


def sensitivity(run: Any, wrt: str | Iterable[str]) -> Sensitivity:
    """Compute the derivatives of a run with respect to numbers of its scene, by a second pass over its log."""
    scene, log = run.scene, run.log
    first = log[: len(scene.balls)]
    if len(log) and (len(first) < len(scene.balls) or (first["kind"] != START).any()):
        raise CaromError("sensitivity: expected a run with a complete log")
    parameters = parameters_of(scene, run.arrays, wrt, first["phase"].tolist())
    passages = follow(scene, parameters, log, run.end)
    _warn_of_switches(run, passages)
    return Sensitivity(run, parameters, passages)


def _warn_of_switches(run: Any, passages: Passages) -> None:
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
            " those of one side",
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
