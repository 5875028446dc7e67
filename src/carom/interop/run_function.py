"""The final state of a run as a function of numbers of its scene, with its derivatives: what JAX and PyTorch are given."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

import numpy as np
from numpy.typing import NDArray

from carom.errors import CaromError, Fault, require_type, suggestion
from carom.scene.paths import path_match, replaced
from carom.scene.scene import Scene
from carom.simulation.sensitivity.many import sensitivities
from carom.simulation.sensitivity.seeds import Column
from carom.simulation.setup import set_up
from carom.simulation.simulate import simulate, simulate_many
from carom.sweeps.starts import start_states

__all__ = ["OUTCOMES", "RunFunction"]

Array = NDArray[np.float64]
LINEAR_FIELDS = ("position", "velocity", "spin", "spin_z")
OUTCOMES = {"final.position": "position", "final.velocity": "velocity", "final.spin": "spin"}


class RunFunction:
    """Final positions, velocities or spins (B, 3) of a scene as a function of p of its numbers.

    Parameters
    ----------
    scene : Scene
    wrt : paths, as for ``run.sensitivity``
    of : "final.position", "final.velocity" or "final.spin"
    where : str
        What messages begin with.
    """

    def __init__(self, scene: Scene, wrt: str | Iterable[str], of: str, where: str) -> None:
        require_type(where, "scene", scene, Scene)
        if of not in OUTCOMES:
            raise CaromError(
                Fault(f"{where}", "of", ", ".join(OUTCOMES), f"{of!r:.60}", suggestion(str(of), list(OUTCOMES)))
            )
        self.scene, self.where, self.part = scene, where, OUTCOMES[of]
        self.wrt = [wrt] if isinstance(wrt, str) else list(wrt)
        found = simulate(replaced(scene, {"run.max_events": 1})).sensitivity(self.wrt)
        self.columns = found.columns
        """Names of the p numbers."""
        self.start = np.array(found.values)
        """Their values in the scene (p,)."""
        self.shape = (len(scene.balls), 3)
        self._columns: list[Column] = found.parameters
        # (many runs from other starts need no other scene, where a start is linear in the numbers: that of a struck ball is not)
        self._starts = all(
            keys[0] == "balls" and keys[2] in LINEAR_FIELDS and len(match.places) == 1
            for match in (path_match(scene, path) for path in self.wrt)
            for keys in match.places
        )

    def evaluate(self, x: Array) -> Array:
        """Return the outcome (..., B, 3) at points (..., p), of none for none. CaromError where a scene or its run is refused."""
        rows = self._rows(x)
        if not len(rows):
            found = np.zeros(0)
        elif self._starts:
            many = simulate_many(self.scene, *self._motion(rows))
            self._require_answers(many.why)
            found = np.asarray(getattr(many.final, self.part))
        else:
            found = np.array([getattr(simulate(self._scene(row)).final, self.part) for row in rows])
        return found.reshape(*np.shape(x)[:-1], *self.shape)

    def differentiate(self, x: Array) -> tuple[Array, Array]:
        """Return the outcome (..., B, 3) and its derivatives (..., B, 3, p)."""
        rows = self._rows(x)
        if not len(rows):
            found, slopes = np.zeros(0), np.zeros(0)
        elif self._starts:
            many = sensitivities(self.scene, self.wrt, *self._motion(rows))
            self._require_answers(many.why)
            found, slopes = np.asarray(getattr(many.final, self.part)), getattr(many.derivatives, self.part)
        else:
            runs = [simulate(self._scene(row)) for row in rows]
            found = np.array([getattr(run.final, self.part) for run in runs])
            slopes = np.array([getattr(run.sensitivity(self.wrt).final, self.part) for run in runs])
        before = np.shape(x)[:-1]
        return found.reshape(*before, *self.shape), slopes.reshape(*before, *self.shape, len(self.columns))

    def _rows(self, x: Array) -> Array:
        x = np.asarray(x, dtype=float)
        if x.shape[-1:] != (len(self.columns),):
            raise CaromError(
                f"{self.where}: expected {len(self.columns)} numbers ({', '.join(self.columns)}), got shape {x.shape}"
            )
        return x.reshape(-1, len(self.columns))

    def _require_answers(self, why: NDArray[np.str_]) -> None:
        bad = np.flatnonzero(why != "")
        if len(bad):
            raise CaromError(
                f"{self.where}: expected a run to its end at every point, got at point {bad[0]}: {why[bad[0]]}"
            )

    def _values(self, row: Array) -> dict[str, Any]:
        """Return the scene's numbers by path, each changed by as much as the function's argument."""
        found: dict[str, Any] = {}
        for one, by in zip(self._columns, (row - self.start).tolist(), strict=True):
            for keys, old in zip(path_match(self.scene, one.path).places, one.values, strict=True):
                path = ".".join(map(str, keys))
                if one.component is None:
                    found[path] = old + by
                else:
                    found[path] = tuple(
                        x + (by if k == one.component else 0.0) for k, x in enumerate(found.get(path, old))
                    )
        return found

    def _scene(self, row: Array) -> Scene:
        return replaced(self.scene, self._values(row))

    def _motion(self, rows: Array) -> tuple[Array, Array, Array | None]:
        """Return velocities, spins and, where they change, positions (N, B, 3)."""
        arrays = set_up(self.scene).for_runs(len(rows))
        values = [self._values(row) for row in rows]
        columns = {path_match(self.scene, path): np.array([one[path] for one in values]) for path in values[0]}
        doubtful = start_states(self.scene, columns, arrays)
        for n in np.flatnonzero(doubtful).tolist():
            self._scene(rows[n])  # (which says what it refuses)
        moved = any("position" in match.path for match in columns)
        return arrays.balls["v"], arrays.balls["w"], arrays.balls["x"] if moved else None
