"""The space of a sweep: what is computed, and which of its numbers run through what; points counted in C order."""

from __future__ import annotations

import itertools
import math
import zlib
from collections.abc import Collection, Mapping
from typing import Any, Protocol

import numpy as np
from numpy.typing import NDArray

from carom.errors import CaromError, Fault, FaultList, require_count, shown
from carom.public.own_laws import holds_own_laws
from carom.scene.scene import Scene
from carom.sweeps.axes import Axis, Design, Draw, Outcome, Polar, Values, as_axis, axis_to_data, design_columns
from carom.sweeps.draws import normal_draws, polar_rows, uniform_draws

Columns = dict[str, NDArray[Any]]
REPEAT = "repeat"
VECTOR_DIMS = {2: "component", 3: "axis"}  # of the components of vectors


class Coordinate:
    """Values along a dimension, with the units of the parameter that they belong to."""

    def __init__(self, dim: str, values: NDArray[Any], path: str, units: str) -> None:
        self.dim, self.values, self.path, self.units = dim, values, path, units
        self.name = path
        """In a result: the dimension's where that has no other values, else the path."""
        self.about = {"path": path, **({"units": units} if units != "1" else {})}

    @property
    def dims(self) -> tuple[str, ...]:
        """The dimension, and for vectors the dimension of their components."""
        return (self.dim, *(VECTOR_DIMS[size] for size in self.values.shape[1:]))


class Space:
    """Space of a sweep: parameters of a scene, an impact, an orbit or a gas, each with its values.

    Parameters
    ----------
    subject : Scene, GasScene, ImpactCase or OrbitCase
        What is computed at every point.
    parameters : mapping of paths to what they run through
        A path leads to a number of the subject, such as ``balls.0.velocity``, ``walls.*.friction``, ``run.law``. It runs through
        a list or array (a dimension of its own), :func:`carom.sweeps.along` (a named dimension: parameters of one dimension vary
        together), :func:`carom.polar`, :func:`carom.sweeps.uniform` or :func:`carom.sweeps.normal` (drawn anew at every point),
        :func:`carom.sweeps.sobol` or :func:`carom.sweeps.latin_hypercube`. Different dimensions multiply.
    repeats : int, optional
        Number of points with the same values, for random draws and for gases. Default: 1.
    seed : int, optional
        0 to 2^32 - 1; default: 0.

    Raises CaromError, all faults at once: unknown paths (with the nearest name), paths that overlap, empty axes.

    Examples
    --------
    >>> import numpy as np, carom
    >>> ball = carom.SceneBall(radius=0.03, mass=0.2, position=(1, 0, 0))
    >>> wall = carom.scene.Plane(point=(0, 0, 0), normal=(1, 0, 0), restitution=0.85, friction=0.2)
    >>> scene = carom.Scene(gravity=0, walls=[wall], balls=[ball], run=carom.Run(duration=2))
    >>> space = carom.Space(scene, {
    ...     "balls.0.velocity": carom.polar(speed=2.0, angle_deg=np.linspace(120, 240, 5)), "walls.*.friction": [0.1, 0.2, 0.3]})
    >>> space
    <Space: angle 5 x friction 3 = 15 points of a scene>
    >>> space.columns(0, 2)["walls.*.friction"]
    array([0.1, 0.2])
    """

    def __init__(self, subject: Any, parameters: Mapping[str, Any], repeats: int = 1, seed: int = 0) -> None:
        self.subject: SweepSubject = subject_of(subject)
        found = FaultList("Space")
        if not isinstance(parameters, Mapping) or not parameters:
            raise CaromError(
                Fault(
                    "Space",
                    "parameters",
                    "a mapping of paths to values",
                    shown(parameters, 60),
                    "such as {'walls.*.friction': [0.1, 0.2]}",
                )
            )
        for name, value, low, high in (("repeats", repeats, 1, 10**15), ("seed", seed, 0, 2**32 - 1)):
            found.attempt(require_count, "Space", name, value, low, high)
        self.parameters: dict[str, Axis] = {}
        for path, value in parameters.items():
            try:
                self.parameters[path] = as_axis(value, f"Space: {path}")
            except CaromError as error:
                found += error.records
        try:
            self.subject.check(self.parameters)
        except CaromError as error:
            found += error.records
        if found:
            raise CaromError(*found)
        self.repeats, self.seed = int(repeats), int(seed)
        self.has_own_laws = holds_own_laws([subject, *map(vars, self.parameters.values())])
        self.coordinates: list[Coordinate] = []
        self._columns: dict[str, tuple[str, NDArray[Any]]] = {}
        self.dims: dict[str, int] = {}
        self._lay_out()

    def __repr__(self) -> str:
        """Return one line: dimensions, points, and of what."""
        sizes = " x ".join(f"{dim} {size:,}" for dim, size in self.dims.items()) or "1"
        return f"<Space: {sizes} = {self.size:,} points of {self.subject.describe()}>"

    @property
    def shape(self) -> tuple[int, ...]:
        """Sizes of the dimensions, in their order."""
        return tuple(self.dims.values())

    @property
    def size(self) -> int:
        """Number of points."""
        return math.prod(self.shape)

    def _parts(self) -> list[tuple[str, str, Axis]]:
        """Return the single axes: path, the name that a dimension of its own would have, axis."""
        found: list[tuple[str, str, Axis]] = []
        for path, axis in self.parameters.items():
            if isinstance(axis, Polar):
                found += [(path, "speed", axis.speed), (path, "angle", axis.angle_deg)]
            else:
                names = [name for name in path.split(".") if not name.isdecimal() and name != "*"]
                found.append((path, names[-1] if names[-1] not in ("x", "y", "z") else "_".join(names[-2:]), axis))
        return found

    def _lay_out(self) -> None:
        """Give every axis its dimension, and every dimension its coordinates."""
        parts, found = self._parts(), []
        own = [
            name
            for _path, name, axis in parts
            if isinstance(axis, Values) and axis.dim is None and len(axis.values) > 1
        ]
        taken = {REPEAT, *VECTOR_DIMS.values(), *(axis.dim for _path, _name, axis in parts if hasattr(axis, "dim"))}
        designs: dict[str, list[tuple[str, str, Design]]] = {}
        for path, name, axis in parts:
            if isinstance(axis, Values):
                if len(axis.values) == 1 and axis.dim is None:
                    continue
                whole = path.replace(".", "_").replace("*", "all")
                more = (f"{whole}_{name}{k or ''}" for k in itertools.count())
                names = itertools.chain([name] if own.count(name) == 1 else [], [whole], more)
                dim = axis.dim or next(one for one in names if one not in taken)
                taken.add(dim)
                found += self._add(dim, axis.values, path, name)
            elif isinstance(axis, Design):
                designs.setdefault(axis.dim, []).append((path, name, axis))
        for dim, group in designs.items():
            if len({(axis.kind, axis.count) for _path, _name, axis in group}) > 1:
                found.append(
                    f"Space: dimension {dim}: expected designs of one kind and count, got"
                    f" {', '.join(f'{axis.kind} of {axis.count}' for _path, _name, axis in group)}; name another dim"
                )
                continue
            key = zlib.crc32(dim.encode())
            columns = design_columns([axis for _path, _name, axis in group], self.seed << 32 | key)
            for (path, name, _axis), values in zip(group, columns, strict=True):
                found += self._add(dim, values, path, name)
        dims = [one.dim for one in self.coordinates]
        for one in self.coordinates:
            if dims.count(one.dim) == 1 and one.values.ndim == 1:
                one.name = one.dim
        if found:
            raise CaromError(*found)
        self.require_names({name for one in self.coordinates for name in one.dims[1:]} | {REPEAT})
        if self.repeats > 1:
            self.dims[REPEAT] = self.repeats

    def _add(self, dim: str, values: NDArray[Any], path: str, name: str) -> list[str]:
        size = self.dims.setdefault(dim, len(values))
        units = {"speed": "m/s", "angle": "degree"}.get(name) if isinstance(self.parameters[path], Polar) else None
        part = path if units is None else f"{path}.{name}"
        self.coordinates.append(Coordinate(dim, values, part, units or self.subject.units(path)))
        self._columns[part] = dim, values
        if size != len(values):
            return [f"Space: {path}: expected {size} values, as the dimension {dim} has, got {len(values)}"]
        return []

    def require_names(self, used: Collection[str]) -> None:
        """Raise CaromError where a dimension, or the values along it, would have a name that the result uses for something else."""
        found = []
        for one in self.coordinates:
            name = one.dim if one.dim in used else one.name
            if name in used or (name != one.dim and name in self.dims):
                found.append(
                    f"Space: {one.path}: expected a name that the result does not use for something else, got {name!r}; give the"
                    f" dimension another name, such as sweeps.along('{one.path.rpartition('.')[2]}_values', ...)"
                )
        if found:
            raise CaromError(*found)

    # --- the points ------------------------------------------------------------------------------------------------

    def columns(self, first: int, stop: int) -> Columns:
        """Return the values of every path, (N,) or (N, 2 or 3), at the points ``first`` to ``stop``, in C order."""
        count = stop - first
        index = dict(zip(self.dims, np.unravel_index(np.arange(first, stop), self.shape or (1,)), strict=False))
        found: Columns = {}
        for path, axis in self.parameters.items():
            if isinstance(axis, Polar):
                speed, angle = (
                    self._column(part, f"{path}.{name}", index, first, count)
                    for part, name in ((axis.speed, "speed"), (axis.angle_deg, "angle"))
                )
                found[path] = polar_rows(speed, angle)
            else:
                found[path] = self._column(axis, path, index, first, count)
        return found

    def _column(self, axis: Axis, name: str, index: dict[str, Any], first: int, count: int) -> NDArray[Any]:
        if isinstance(axis, Draw):
            draws = uniform_draws if axis.kind == "uniform" else normal_draws
            return draws(self.seed, zlib.crc32(name.encode()), first, count, axis.first, axis.second)
        if name in self._columns:
            dim, values = self._columns[name]
            found: NDArray[Any] = values[index[dim]]
        else:
            assert isinstance(axis, Values)
            found = np.repeat(axis.values, count, axis=0)
        if found.dtype.kind == "U":
            assert isinstance(axis, Values)
            found = np.array([axis.named(text) for text in found.tolist()], dtype=object)
        return found

    def point(self, index: int) -> dict[str, Any]:
        """Return the values at one point, by path."""
        columns = self.columns(index, index + 1)
        return {path: column[0] if column.dtype.kind == "O" else column[0].tolist() for path, column in columns.items()}

    def to_data(self) -> dict[str, Any]:
        """Return the space as plain data, the same for the same space."""
        return {
            "subject": self.subject.to_data(),
            "parameters": {path: axis_to_data(axis) for path, axis in self.parameters.items()},
            "repeats": self.repeats,
            "seed": self.seed,
        }


# ----------------------------------------------------------------------------------------------------
# Subjects of a sweep: one for each kind, all with the same few functions.


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
