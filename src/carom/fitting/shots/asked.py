"""Whole shots as :func:`carom.fit` is asked for them: its arguments, and those that have no effect."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from types import SimpleNamespace
from typing import Any

from carom.errors import CaromError, FaultList
from carom.fitting.shots.fit import fit_shots
from carom.fitting.shots.result import ShotsRanking
from carom.fitting.shots.table import FREE
from carom.scene.scene import Scene
from carom.scene.toml import load_scene

__all__ = ["check_asked", "fit_asked"]

TAKEN = (
    "files",
    "radius",
    "laws",
    "fit",
    "fix",
    "bound",
    "rate",
    "scale",
    "where",
    "seed",
    "shot",
    "table",
    "progress",
)


def check_asked(asked: SimpleNamespace, defaults: Mapping[str, Any]) -> None:
    """Raise CaromError, one line per problem, for arguments of :func:`carom.fit` without effect on whole shots."""
    faults = FaultList()
    for name, default in defaults.items():
        if name not in TAKEN and getattr(asked, name) != default:
            faults.add("", "", advice=f"`{name}` has no effect with `shot`, which fits whole shots; omit it")
    if asked.radius is None and asked.table is None:
        faults.add("`radius`", "the balls' radius in m", "none", "a carom ball has `radius` 0.03075")
    faults.raise_if_any()


def fit_asked(asked: SimpleNamespace, defaults: Mapping[str, Any]) -> ShotsRanking:
    """Fit whole shots with the arguments of :func:`carom.fit`."""
    check_asked(asked, defaults)
    table = asked.table
    if isinstance(table, str | Path):
        table = load_scene(table)
    if table is not None and not isinstance(table, Scene):
        raise CaromError(f"`table`: expected a scene, or its file, got {type(table).__name__}")
    return fit_shots(
        asked.files, table, asked.radius, laws=asked.laws or None, free=(*FREE, *asked.fit), fix=asked.fix, bound=asked.bound,
        rate=asked.rate, scale=asked.scale, where=asked.where, seed=asked.seed or 0, progress=asked.progress,
    )  # fmt: skip
