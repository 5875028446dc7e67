"""The final state of a run as a function of numbers of its scene, with its derivatives: what JAX and PyTorch are given."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Iterator
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from carom.bodies import Ball, Surface
from carom.core.contact import LEAST
from carom.errors import CaromError, Fault, require_type, suggestion
from carom.scene.scene import Scene
from carom.scene.toml import path_match, replaced
from carom.simulation.records import SceneArrays, set_up, starts_of
from carom.simulation.sensitivity.follow import Column, parameters_of
from carom.simulation.sensitivity.sensitivity import ManySensitivities, first_phases, run_all
from carom.simulation.simulate import simulate, simulate_many
from carom.sweeps.shots import start_states

Array = NDArray[np.float64]
LINEAR_FIELDS = ("position", "velocity", "spin", "spin_z")
NEXT, LAST = np.array([1, 2, 0]), np.array([2, 0, 1])  # axes of a vector product
OUTCOMES = {"final.position": "position", "final.velocity": "velocity", "final.spin": "spin"}


class _Place(NamedTuple):
    """Places of a field of the scene's arrays."""

    array: str
    field: str
    holds: NDArray[np.bool_]
    """Which hold the number itself."""


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
        # (many runs need no other scene where a start is linear in the numbers, as that of a struck ball is not, or where a scene's
        # arrays hold a number itself, as those of surfaces do)
        self._places: list[list[_Place]] = []
        self._at_once = all(self._find_places())
        self._accepted = np.stack([self.start, self.start])

    def evaluate(self, x: Array) -> Array:
        """Return the outcome (..., B, 3) at points (..., p), of none for none. CaromError where a scene or its run is refused."""
        rows = self._rows(x)
        if not len(rows):
            found = np.zeros(0)
        elif (arrays := self._arrays(rows)) is None:
            found = np.array([getattr(simulate(self._scene(row)).final, self.part) for row in rows])
        else:
            starts = arrays is set_up(self.scene)
            many = simulate_many(self.scene, *self._motion(rows)) if starts else self._run(arrays, rows, False)
            self._require_answers(many.why)
            found = np.asarray(getattr(many.final, self.part))
        return found.reshape(*np.shape(x)[:-1], *self.shape)

    def differentiate(self, x: Array) -> tuple[Array, Array]:
        """Return the outcome (..., B, 3) and its derivatives (..., B, 3, p)."""
        rows = self._rows(x)
        if not len(rows):
            found, slopes = np.zeros(0), np.zeros(0)
        elif (arrays := self._arrays(rows)) is None:
            runs = [simulate(self._scene(row)) for row in rows]
            found = np.array([getattr(run.final, self.part) for run in runs])
            slopes = np.array([getattr(run.sensitivity(self.wrt).final, self.part) for run in runs])
        else:
            many = self._run(arrays, rows, True)
            self._require_answers(many.why)
            found, slopes = np.asarray(getattr(many.final, self.part)), getattr(many.derivatives, self.part)
        before = np.shape(x)[:-1]
        return found.reshape(*before, *self.shape), slopes.reshape(*before, *self.shape, len(self.columns))

    def _find_places(self) -> Iterator[bool]:
        """Find the places of the scene's arrays that hold each number itself, none for a start; yield whether it has one."""
        arrays = set_up(self.scene)
        self._parameters = parameters_of(self.scene, arrays, self.wrt, first_phases(self.scene))
        taken: set[tuple[Any, ...]] = set()
        for column, slopes in zip(self._columns, self._parameters.slopes, strict=True):
            match, places, itself = path_match(self.scene, column.path), list[_Place](), True
            start = all(keys[0] == "balls" and keys[2] in LINEAR_FIELDS for keys in match.places)
            for name in () if start else ("world", "features"):
                for field, slope in slopes[name].items():
                    if slope.any():
                        holds = slope == 1
                        same = getattr(arrays, name)[field][holds] == column.value
                        itself &= bool(same.all() and (holds | (slope == 0)).all())
                        places.append(_Place(name, field, holds))
            self._places.append(places)
            held = [(one.array, one.field, *at) for one in places for at in np.argwhere(one.holds).tolist()]
            on_balls = any(slope.any() for slope in slopes["balls"].values())
            has_one = len(match.places) == 1 if start else bool(places) and itself and not on_balls
            yield has_one and taken.isdisjoint(held)
            taken.update(held)

    def _arrays(self, rows: Array) -> SceneArrays | None:
        """Return the arrays of the scene, or those of points (N, p) that differ; None where each point needs a scene of its own.

        A scene is made for a value beyond those that were accepted: it says what it refuses, and has the same arrays.
        """
        base = set_up(self.scene)
        if not self._at_once or not any(self._places):
            return base if self._at_once else None
        count = len(rows)
        made = base._replace(world=np.tile(base.world, count), features=np.tile(base.features, count))
        for places, column in zip(self._places, rows.T, strict=True):
            for one in places:
                into = getattr(made, one.array)[one.field]
                into.reshape(count, *one.holds.shape)[:, one.holds] = column[:, None]
        for j in [j for j, places in enumerate(self._places) if places]:
            for n in (int(np.argmin(rows[:, j])), int(np.argmax(rows[:, j]))):
                if self._accepted[0, j] <= rows[n, j] <= self._accepted[1, j]:
                    continue
                own = set_up(self._scene(rows[n]), compiled=False)
                ours = made.world[n : n + 1], made.features.reshape(count, -1)[n]
                if [one.tobytes() for one in ours] != [own.world.tobytes(), own.features.tobytes()]:
                    self._at_once = False
                    return None
                ends = np.append(self._accepted[:, j], rows[n, j])
                self._accepted[:, j] = ends.min(), ends.max()
        return made

    def _run(self, arrays: SceneArrays, rows: Array, derivatives: bool) -> ManySensitivities:
        starts = starts_of(self.where, self.scene, set_up(self.scene), *self._motion(rows))
        return run_all(self.scene, arrays, self._parameters if derivatives else None, starts)

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
        paths = [path for path in values[0] if path.startswith("balls.")]
        columns = {path_match(self.scene, path): np.array([one[path] for one in values]) for path in paths}
        doubtful = start_states(self.scene, columns, arrays)
        for n in np.flatnonzero(doubtful).tolist():
            self._scene(rows[n])  # (which says what it refuses)
        moved = any("position" in match.path for match in columns)
        return arrays.balls["v"], arrays.balls["w"], arrays.balls["x"] if moved else None


# ----------------------------------------------------------------------------------------------------
# One impact as a function of its numbers, in the arrays of JAX or PyTorch: differentiated and compiled by these.


def impact_in(library: Any, array: Callable[[Any], Any], ball: Ball, *given: Any) -> tuple[Any, Any]:
    """Return velocity and spin after :func:`carom.impact`: of velocity, spin, normal (..., 3), e, mu, beta (...).

    A ball that moves away stays as it is. Raises CaromError for plain numbers that no surface has.
    """
    names = ("restitution", "friction", "tangential_restitution")
    plain = {name: one for name, one in zip(names, given[3:], strict=True) if isinstance(one, int | float)}
    Surface(**({"restitution": 1.0, "friction": 0.0} | plain))
    v, w, n = (array(one) for one in given[:3])
    e, mu, beta = (array(one)[..., None] for one in given[3:])

    def dot(a: Any, b: Any) -> Any:
        return (a * b).sum(-1)[..., None]

    def cross(a: Any, b: Any) -> Any:
        return a[..., NEXT] * b[..., LAST] - a[..., LAST] * b[..., NEXT]

    n = n / library.sqrt(dot(n, n))
    # the squared slip, by carom.core.contact's formulas; a root of 0 has no derivative
    un = dot(v, n)
    ut = v - un * n - ball.radius * cross(w, n)
    squared = dot(ut, ut)
    slides = squared > 0
    slip = library.sqrt(library.where(slides, squared, array(1.0)))
    pn = -(1 + e) * un
    hold = (1 + beta) * ball.kappa / (1 + ball.kappa)
    finite = library.where(mu < math.inf, mu, array(0.0))
    holds = (mu == math.inf) | (slides & (hold * slip <= finite * pn)) | (~slides & (mu > 0))
    f = -library.where(holds, hold, finite * pn / slip) * ut
    presses = pn > LEAST * slip * slides
    spin = w - cross(n, f) / (ball.kappa * ball.radius)
    return library.where(presses, v + pn * n + f, v), library.where(presses, spin, w)
