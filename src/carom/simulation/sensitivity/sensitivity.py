"""The sensitivity of a run: derivatives of its events and states with respect to numbers of its scene, and how far they hold."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from carom.errors import CaromError
from carom.formatting import format_number, html_table
from carom.simulation.records import BALL, START
from carom.simulation.sensitivity.dual import derivative, value
from carom.simulation.sensitivity.follow import follow
from carom.simulation.sensitivity.parameters import parameters_of
from carom.simulation.sensitivity.passages import PLACES, Passages

__all__ = ["EventSensitivity", "Margin", "Sensitivity", "SensitivityTable", "StateSensitivity", "sensitivity"]

Array = NDArray[np.float64]


class StateSensitivity(NamedTuple):
    """Derivatives of the states of all balls at a fixed time, each (B, 3, p)."""

    position: Array
    """m per unit of the parameter."""
    velocity: Array
    spin: Array


class EventSensitivity(NamedTuple):
    """Derivatives of one event: of its time (p,), and of the ball's state there, each (3, p), at the time that changes with it."""

    time: Array
    position: Array
    velocity: Array
    spin: Array


class Margin(NamedTuple):
    """How far an event is from the nearest switch of behaviour, to first order."""

    which: str
    """ "graze", "stick/slip", "order", "roll/slide"; empty where nothing can switch."""
    distance: float
    """In the switch's own measure: m/s of approach or slip, friction, s."""
    radius: float
    """Length of the shortest change of the parameters (in their units) that reaches it; infinite if none does."""


class SensitivityTable(NamedTuple):
    """A table of text: head and rows."""

    head: list[str]
    rows: list[list[str]]

    def __repr__(self) -> str:
        """Return it in columns."""
        lines = [self.head, *self.rows]
        widths = [max(len(line[k]) for line in lines) for k in range(len(self.head))]
        return "\n".join(
            "  ".join(f"{cell:<{width}}" for cell, width in zip(line, widths, strict=True)).rstrip() for line in lines
        )

    def _repr_html_(self) -> str:
        return html_table(self.head, self.rows)


class Sensitivity:
    """Derivatives of a run; made by :meth:`carom.Trajectory.sensitivity`."""

    def __init__(self, run: Any, columns: list[Any], passages: Passages) -> None:
        self._run, self._passages = run, passages
        self.parameters = columns
        self.columns: list[str] = [one.name for one in columns]
        """Names of the p parameters."""
        self.values = np.array([one.value for one in columns])
        """Their values in the scene (p,)."""

    @property
    def events(self) -> list[EventSensitivity]:
        """Derivatives of each event, in the order of ``run.events``."""
        d = self._passages.derivatives[len(self._run.scene.balls) :]
        time, *motion = (d[:, PLACES[name]] for name in ("time", "x", "v", "w"))
        return [EventSensitivity(t[0], *rest) for t, *rest in zip(time, *motion, strict=True)]

    def at(self, t: float) -> StateSensitivity:
        """Return the derivatives of all states at a fixed time t, s."""
        t = float(t)
        self._run.at(t)  # (which refuses times before and after the run)
        return StateSensitivity(*self._passages.at(t))

    @property
    def final(self) -> StateSensitivity:
        """Derivatives of the final states, at the fixed time ``run.end``."""
        return StateSensitivity(*self._passages.at(self._run.end))

    @property
    def margin(self) -> list[Margin]:
        """For each event the nearest switch: graze, stick or slip, roll or slide, or the order of two events of one ball."""
        log, p, first = self._run.log, len(self.columns), len(self._run.scene.balls)
        found = []
        for k in range(first, len(log)):
            one, choices = self._passages[k], []
            if one.approach is not None:
                choices.append(_margin("graze", one.approach, p))
            if (
                one.required is not None
                and one.friction is not None
                and 0 < one.friction < np.inf
                and one.required != 0
            ):
                choices.append(_margin("stick/slip", one.required - one.friction, p))
            if one.slip is not None:
                size = float(np.sqrt(value(one.slip[0])))
                slope = np.stack([derivative(s, p) for s in one.slip[1:]])
                most = float(np.linalg.svd(slope, compute_uv=False)[0])
                choices.append(Margin("roll/slide", size, size / most if most > 0 else np.inf))
            j = _next_of_its_balls(log, k)
            if j is not None:
                choices.append(_margin("order", self._passages[j].time - one.time, p))
            found.append(min(choices, key=lambda m: m.radius, default=Margin("", np.inf, np.inf)))
        return found

    def what_matters(self) -> Array:
        """Return how far each ball's final place moves when a parameter changes by 1 %: (B, p), m."""
        return np.asarray(np.linalg.norm(self.final.position, axis=1) * np.abs(self.values) / 100)

    def table(self) -> SensitivityTable:
        """Return what matters: how far each ball's final place moves when a parameter changes by 1 %, mm, the largest first."""
        moved = 1e3 * self.what_matters()
        order = np.argsort(-moved.max(axis=0), kind="stable")
        rows = [
            [self.columns[c], format_number(self.values[c]), *map(format_number, moved[:, c])] for c in order.tolist()
        ]
        return SensitivityTable(["mm per cent", "value", *self._run.scene.ball_names], rows)

    def __repr__(self) -> str:
        """One line."""
        return f"<Sensitivity: {len(self.columns)} parameters, {len(self.events)} events>"


def _next_of_its_balls(log: Any, k: int) -> int | None:
    """Return the row of the next event of the balls that row k is about; events of other balls may change places with it."""
    its = {int(log["ball"][k])} | ({int(log["other"][k])} if log["kind"][k] == BALL else set())
    rows = np.flatnonzero((log["t"] > log["t"][k]) & np.isin(log["ball"], list(its)))
    return int(rows[0]) if len(rows) else None


def _margin(which: str, distance: Any, p: int) -> Margin:
    size, slope = abs(float(value(distance))), float(np.linalg.norm(derivative(distance, p)))
    return Margin(which, size, size / slope if slope > 0 else np.inf)


def sensitivity(run: Any, wrt: str | Iterable[str]) -> Sensitivity:
    """Compute the derivatives of a run with respect to numbers of its scene, by a second pass over its log."""
    scene, log = run.scene, run.log
    first = log[: len(scene.balls)]
    if len(log) and (len(first) < len(scene.balls) or (first["kind"] != START).any()):
        raise CaromError("sensitivity: expected a run with a complete log")
    parameters = parameters_of(scene, wrt, first["phase"].tolist())
    return Sensitivity(run, parameters.columns, follow(scene, parameters, log, run.end))
