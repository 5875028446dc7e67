"""Forms of cushion, cloth and balls compared on the same shots: what each term is worth, and what would replace it."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from carom.fitting.shots.joint import FEWEST, deviance_of, fit_shared, frames_of_events, mean_squares
from carom.fitting.shots.result import ComparedForm, ShotsFit, criterion
from carom.fitting.shots.search import ShotStart
from carom.fitting.shots.table import TERMS, TableModel
from carom.scene.paths import path_match, replaced
from carom.scene.scene import Scene

__all__ = ["FORMS", "compare_forms"]

Array = NDArray[np.float64]
FALL = 0.9  # m/s over which the friction of balls falls with their slip (Alciatore, TP A.14)
SLOPE = 1e-4  # where the search for a tilt begins
ROUNDS = 2  # in which forms are searched again from each other's optimum
ENOUGH = 1.0  # of the deviance: less than this in a round ends the search
NEARLY = 0.1  # of a usual value: a term that another form does not have


class ChangedForm(NamedTuple):
    """Another form of a part of the table: changes of the scene, paths that are no longer fitted, and others that are."""

    part: str
    name: str
    change: Callable[[Scene], dict[str, Any]]
    without: tuple[str, ...] = ()
    more: tuple[str, ...] = ()


def _falling(scene: Scene) -> dict[str, Any]:
    mu = float(path_match(scene, "ball_contact.friction").values[0])
    return {"ball_contact.friction": {"at_rest": 1.2 * mu, "at_speed": 0.8 * mu, "speed": FALL}}


def _by_speed(scene: Scene) -> dict[str, Any]:
    e = path_match(scene, "walls.0.restitution").values[0].value
    return {"walls.0.restitution": {"form": "polynomial", "coefficients": [float(e), 0.0, 0.0]}}


def _tilted(_scene: Scene) -> dict[str, Any]:
    # (a path on a slope has a closed form only where the rates are constant)
    return {"floor.rolling_drag": 0.0, "floor.spin_drag": 0.0, "floor.slope": (SLOPE, SLOPE)}


COEFFICIENTS = tuple(f"walls.0.restitution.coefficients.{k}" for k in range(2))
FORMS = (
    ChangedForm("cushion", "does not yield", lambda _s: {"walls.0.yield_time": 0.0}, ("walls.0.yield_time",)),
    ChangedForm("cushion", "restitution c0 + c1 v", _by_speed, ("walls.0.restitution",), COEFFICIENTS),
    ChangedForm("cloth", "rolling resistance without drag", lambda _s: {"floor.rolling_drag": 0.0}, ("floor.rolling_drag",)),
    ChangedForm("cloth", "constant loss of spin", lambda _s: {"floor.spin_drag": 0.0}, ("floor.spin_drag",)),
    ChangedForm(
        "cloth", "loss of spin that grows with the spin", lambda _s: {"floor.spin_drag": 0.0, "floor.spin_damping": 0.1},
        ("floor.spin_drag",), ("floor.spin_damping",),
    ),
    ChangedForm("cloth", "tilted, constant rates", _tilted, ("floor.rolling_drag", "floor.spin_drag"), ("floor.slope",)),
    ChangedForm(
        "balls", "friction that falls with the slip", _falling, ("ball_contact.friction",),
        ("ball_contact.friction.at_rest", "ball_contact.friction.at_speed"),
    ),
)  # fmt: skip
"""Forms that are compared with those of :data:`carom.fitting.shots.table.FREE`."""


@dataclass(eq=False)
class _Tried:
    """A form, and the best that has been found for it."""

    model: TableModel
    values: Array
    starts: list[ShotStart]
    squares: Array
    """(N,) m^2: mean square distances of the shots."""
    deviance: float
    count: int

    @property
    def numbers(self) -> dict[str, float]:
        return dict(zip((one.name for one in self.model.shared), self.values.tolist(), strict=True))


def compare_forms(fit: ShotsFit, forms: Sequence[ChangedForm] = FORMS) -> tuple[ComparedForm, ...]:
    """Fit other forms of the cushion, the cloth and the balls to the same shots, and compare them with a fit.

    Each is fitted up to the joint horizon, on one table for all shots. The form of the fit and each other one are searched again
    from the optimum of the other, with the starts of both, until neither comes nearer: else the search would decide between forms
    that contain each other. Forms whose paths the fit does not have are left out. With ten shots or more each half of the shots is
    also compared with the table that the other half gives.
    """
    scene, frames = fit.table.scene, [frames_of_events(one.shot, fit.events) for one in fit.starts]
    chosen, models = [], []
    for form in forms:
        if set(form.without) <= set(fit.model.paths):
            paths = (*(path for path in fit.model.paths if path not in form.without), *form.more)
            chosen.append(form)
            models.append(replace(fit.model, scene=replaced(scene, form.change(scene)), paths=paths))
    if not chosen:
        return ()
    own, *others = (_first(fit, model, frames) for model in (replace(fit.model, scene=scene), *models))
    for _ in range(ROUNDS):
        before = np.array([one.deviance for one in (own, *others)])
        for other in others:
            _search_from(other, own, frames, fit.noise)
            _search_from(own, other, frames, fit.noise)
        if (before - np.array([one.deviance for one in (own, *others)]) < ENOUGH).all():
            break
    first, mine = _aicc(own), _held_out(own, frames, fit.noise)
    found = []
    for form, other in zip(chosen, others, strict=True):
        more = {name: x for name, x in other.numbers.items() if name not in own.numbers}
        nearer = (int((other.squares < own.squares).sum()), len(frames))
        held = _held_out(other, frames, fit.noise)
        found.append(
            ComparedForm(
                form.part, form.name, _aicc(other) - first, more, nearer, held[0] - mine[0], (held[1], mine[1])
            )
        )
    return tuple(found)


def _first(fit: ShotsFit, model: TableModel, frames: Sequence[int]) -> _Tried:
    """Return a model at its own numbers, with the starts of a fit."""
    starts = [_copied(one) for one in fit.starts]
    values = np.array([one.value for one in model.shared])
    squares = mean_squares(model.at(values), starts, frames)
    return _Tried(model, values, starts, squares, *deviance_of(squares, starts, frames, fit.noise))


def _copied(one: ShotStart) -> ShotStart:
    return ShotStart(one.shot, one.prior, dict(one.best), list(one.pool))


def _search_from(one: _Tried, other: _Tried, frames: Sequence[int], noise: float) -> None:
    """Search for a form from the optimum of another, with the starts of both; keep what is better."""
    theirs, begin = other.numbers, []
    for number, value in zip(one.model.shared, one.values.tolist(), strict=True):
        absent = NEARLY * TERMS[number.name] if number.name in TERMS else value
        begin.append(theirs.get(number.name, absent))
    starts = [_copied(mine) for mine in one.starts]
    for mine, more, n in zip(starts, other.starts, frames, strict=True):
        mine.pool.append(more.best[n])
    found = fit_shared(one.model, np.array(begin), starts, frames, noise, lambda _done: None)
    squares = mean_squares(one.model.at(found.values), starts, frames)
    deviance, one.count = deviance_of(squares, starts, frames, noise)
    if deviance < one.deviance:
        one.values, one.starts, one.squares, one.deviance = found.values, starts, squares, deviance


def _aicc(one: _Tried) -> float:
    return criterion(one.deviance, len(one.values) + len(one.starts), one.count)


def _held_out(one: _Tried, frames: Sequence[int], noise: float) -> tuple[float, float]:
    """Return the deviance of each half of the shots on the table of the other half, and their median distance, m; NaN of few."""
    if len(frames) < 2 * FEWEST:
        return float("nan"), float("nan")
    squares = np.zeros(len(frames))
    for k in range(2):
        here, there = [[_copied(start) for start in one.starts[first::2]] for first in (k, 1 - k)]
        found = fit_shared(one.model, one.values, here, frames[k::2], noise, lambda _done: None)
        squares[1 - k :: 2] = mean_squares(one.model.at(found.values), there, frames[1 - k :: 2])
    return deviance_of(squares, one.starts, frames, noise)[0], float(np.sqrt(np.median(squares)))
