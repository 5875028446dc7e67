"""Subjects of a sweep: one for each kind, all with the same few functions."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, Protocol

import numpy as np
from numpy.typing import NDArray

from carom.errors import CaromError
from carom.scene.scene import Scene
from carom.sweeps.axes import Axis
from carom.sweeps.fields import Outcome

Columns = dict[str, NDArray[Any]]


class SweepSubject(Protocol):
    """The computation at every point of a sweep."""

    kind: str

    def describe(self) -> str:
        """Return a few words."""

    def to_data(self) -> dict[str, Any]:
        """Return it as plain data: its kind, and what it is made from."""

    def units(self, path: str) -> str:
        """Return the unit of a parameter."""

    def check(self, parameters: Mapping[str, Axis]) -> None:
        """Raise CaromError for paths that lead nowhere or overlap, all at once."""

    def outcomes(self, names: tuple[str, ...]) -> list[Outcome]:
        """Return the outcomes of some names. CaromError, with the nearest name."""

    def evaluate(
        self, columns: Columns, outcomes: list[Outcome], first: int, seed: int, tick: Any = None
    ) -> tuple[Columns, NDArray[np.int8]]:
        """Return the outcomes of N points by name, and (N,) the codes of points that have none."""

    def why(self, columns: Columns) -> str:
        """Return why the one point of ``columns`` has no outcome; empty if it has one."""


def subject_of(given: Any) -> SweepSubject:
    """Return the subject for what a user sweeps."""
    from carom.gas.scene import GasScene
    from carom.sweeps.impacts import ImpactCase, Impacts
    from carom.sweeps.orbits import Gases, OrbitCase, Orbits
    from carom.sweeps.shots import SceneRuns

    kinds: tuple[tuple[type, type[Any]], ...] = (
        (Scene, SceneRuns),
        (ImpactCase, Impacts),
        (OrbitCase, Orbits),
        (GasScene, Gases),
    )
    for model, subject in kinds:
        if isinstance(given, model):
            return subject(given)  # type: ignore[no-any-return]
    names = ", ".join(model.__name__ for model, _subject in kinds)
    raise CaromError(f"Space: subject: expected one of {names}, got {type(given).__name__} {given!r:.60}")


def subject_from_data(data: Mapping[str, Any], where: str, *, allow_own_laws: bool = False) -> Any:
    """Return the Scene, ImpactCase, OrbitCase or GasScene that a subject's plain data stand for."""
    from carom.gas.scene import GasScene
    from carom.scene.schema import from_file
    from carom.sweeps.impacts import ImpactCase
    from carom.sweeps.orbits import OrbitCase

    models: dict[str, Any] = {"scene": Scene, "impact": ImpactCase, "orbit": OrbitCase, "gas": GasScene}
    (kind, fields), *_rest = data.items()
    return from_file(where, models[kind], dict(fields), allow_own_laws=allow_own_laws)
