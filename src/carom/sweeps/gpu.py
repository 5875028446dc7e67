"""Which sweeps a GPU can compute: trajectories and single impacts, under laws that need no call by an address."""

from __future__ import annotations

import contextlib

import numpy as np

from carom.core.geometry.features import CURVE
from carom.core.jit.cuda import why_no_gpu
from carom.errors import CaromError, shortened_list
from carom.files import install_command
from carom.scene.paths import replaced
from carom.scene.scene import Scene
from carom.sweeps.axes import Values
from carom.sweeps.impacts import Impacts
from carom.sweeps.shots import SceneRuns
from carom.sweeps.space import Space

__all__ = ["require_gpu"]


def require_gpu(space: Space) -> None:
    """Raise CaromError for a sweep that a GPU does not compute, and where there is none."""
    found, subject = [], space.subject
    if isinstance(subject, SceneRuns):
        called = _called_laws(subject.scene, space)
        if called:
            found.append(
                "sweep: run: on='cuda': expected laws that are compiled into the event loop (two-step, contact, mirror, no-slip,"
                f" conventional), got {shortened_list(called)}, which is called by its address; use on='cores'"
            )
        curved = [i for i, wall in enumerate(subject.scene.walls) if any(one.kind == CURVE for one in wall.features())]
        if curved:
            wall = subject.scene.walls[curved[0]].describe()
            found.append(
                "sweep: run: on='cuda': expected walls of planes and circles, got"
                f" walls[{curved[0]}], {wall}, whose kernels are called by their address; use on='cores'"
            )
    elif not isinstance(subject, Impacts):
        found.append(
            f"sweep: run: on='cuda': expected a sweep of a scene or of impacts, got {subject.describe()}; use on='cores'"
        )
    reason = why_no_gpu()
    if reason:
        remedy = f"; run: {install_command('cuda')}" if "numba-cuda" in reason else ""
        found.append(
            f"sweep: run: on='cuda': expected a GPU of NVIDIA's and its driver, {reason}; or use on='cores'{remedy}"
        )
    if found:
        raise CaromError(*found)


def _called_laws(scene: Scene, space: Space) -> list[str]:
    """Return the names of the laws of all points that the event loop calls by their address."""
    made: list[Scene] = []
    for path, axis in space.parameters.items():
        if isinstance(axis, Values) and axis.values.dtype.kind == "U":
            for name in np.unique(axis.values).tolist():
                with contextlib.suppress(CaromError):  # (such points fail one by one)
                    made.append(replaced(scene, {path: axis.named(name)}))
    return list(dict.fromkeys(law.card.name for one in made or [scene] for law in one.called_laws))
