"""Forms of cushion, cloth and balls compared on the same shots: what each term is worth, and what would replace it."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Any, NamedTuple

import numpy as np

from carom.fitting.shots.joint import deviance_of, fit_shared, frames_of_events
from carom.fitting.shots.result import ComparedForm, ShotsFit, criterion
from carom.fitting.shots.search import ShotStart, refined, rms
from carom.fitting.shots.table import TableModel
from carom.scene.paths import path_match, replaced
from carom.scene.scene import Scene

__all__ = ["FORMS", "compare_forms"]

FALL = 0.9  # m/s over which the friction of balls falls with their slip (Alciatore, TP A.14)


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
    ChangedForm(
        "balls", "friction that falls with the slip", _falling, ("ball_contact.friction",),
        ("ball_contact.friction.at_rest", "ball_contact.friction.at_speed"),
    ),
)  # fmt: skip
"""Forms that are compared with those of :data:`carom.fitting.shots.table.FREE`."""


def compare_forms(fit: ShotsFit, forms: tuple[ChangedForm, ...] = FORMS) -> tuple[ComparedForm, ...]:
    """Fit other forms of the cushion, the cloth and the balls to the same shots, and compare them with a fit.

    Each is fitted up to the joint horizon from the starts of the fit, on one table for all shots. Forms whose paths the fit does
    not have are left out.
    """
    before = _fitted(fit, replace(fit.model, scene=fit.table.scene))
    found = []
    for form in forms:
        scene = fit.table.scene
        mine = [path for path in fit.model.paths if path not in form.without]
        if len(mine) + len(form.without) > len(fit.model.paths):
            continue
        changed = replaced(scene, form.change(scene))
        after = _fitted(fit, replace(fit.model, scene=changed, paths=(*mine, *form.more)))
        more = {name: x for name, x in after.numbers.items() if name not in before.numbers}
        nearer = (int((after.far < before.far).sum()), len(before.far))
        found.append(ComparedForm(form.part, form.name, after.aicc - before.aicc, more, nearer))
    return tuple(found)


class _Fitted(NamedTuple):
    aicc: float
    numbers: dict[str, float]
    far: np.ndarray[Any, np.dtype[np.float64]]


def _fitted(fit: ShotsFit, model: TableModel) -> _Fitted:
    """Return the fit of a model up to the joint horizon."""
    starts = [ShotStart(one.shot, one.prior, dict(one.best), list(one.pool)) for one in fit.starts]
    frames = [frames_of_events(one.shot, fit.events) for one in starts]
    values = np.array([one.value for one in model.shared])
    found = fit_shared(model, values, starts, frames, lambda _done: None)
    table = model.at(found.values)
    deviance, n = deviance_of(table, starts, frames, fit.noise)
    aicc = criterion(deviance, len(values) + len(starts), n)
    far = [rms(table, one.shot, refined(table, one, m, 9, 2).start, m) for one, m in zip(starts, frames, strict=True)]
    return _Fitted(
        aicc, dict(zip((one.name for one in model.shared), found.values.tolist(), strict=True)), np.array(far)
    )
