"""Axes of a sweep: values, random draws, and designs of samples; in Python and as plain data."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Any, Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

from carom.errors import CaromError, Fault, FaultList, did_you_mean, require_count, shown, suggestion
from carom.files import import_optional
from carom.formatting import json_value
from carom.public.own_laws import OwnLaw
from carom.scene.schema import Model
from carom.scene.toml import PathMatch, overlapping_paths, path_match, replaced
from carom.sweeps.draws import polar_rows

MAX_VALUES = 100_000_000  # of one dimension, which lie in memory


@dataclass(frozen=True, eq=False)
class Values:
    """Values (N,), or vectors (N, 2) or (N, 3), or texts such as names of laws, along a dimension."""

    values: NDArray[Any]
    dim: str | None = None
    """Name of the dimension; parameters of one dimension vary together. Default: a dimension of its own."""
    own_laws: frozenset[OwnLaw] = frozenset()
    """The texts among the values that name a custom law which may be run."""

    def named(self, text: str) -> str:
        """Return a text of the values, as an OwnLaw if it is one: an array of texts does not keep that."""
        return OwnLaw(text) if text in self.own_laws else text


@dataclass(frozen=True)
class Draw:
    """A random number, drawn anew at every point."""

    kind: Literal["uniform", "normal"]
    first: float
    """Lower end, or mean."""
    second: float
    """Upper end, or standard deviation."""


@dataclass(frozen=True)
class Design:
    """A column of a design of samples: all parameters of one dimension share the design."""

    kind: Literal["sobol", "latin-hypercube"]
    low: float
    high: float
    count: int
    dim: str = "sample"


@dataclass(frozen=True, eq=False)
class Polar:
    """Vectors in the plane z = 0 by length and angle, each of which is a number or runs through something."""

    speed: Axis
    angle_deg: Axis


Axis = Values | Draw | Design | Polar


def along(dim: str, values: ArrayLike) -> Values:
    """Return values along a named dimension: parameters of the same dimension vary together.

    Parameters
    ----------
    dim : str
    values : array (N,), or (N, 2) or (N, 3) of vectors

    Examples
    --------
    >>> from carom import sweeps
    >>> sweeps.along("table", [0.1, 0.2]).dim
    'table'
    """
    found = as_axis(values, "along: values")
    if not isinstance(found, Values):
        raise CaromError(Fault("along", "values", "values", f"{found!r:.60}, which is drawn or made of two parameters"))
    return replace(found, dim=_dimension("along", dim))


def _dimension(where: str, dim: Any) -> str:
    """Return the name of a dimension; CaromError for what is no name."""
    if not isinstance(dim, str) or not dim.isidentifier():
        raise CaromError(Fault(where, "dim", "a name such as 'table'", shown(dim, 60)))
    return dim


def polar(speed: Any, angle_deg: Any) -> Polar:
    """Return velocities by speed and angle, each a number, an array (a dimension of the sweep), a draw, or a design.

    Parameters
    ----------
    speed : m/s
    angle_deg : degrees, counterclockwise from +x

    Examples
    --------
    >>> import numpy as np, carom
    >>> carom.polar(speed=2.0, angle_deg=np.linspace(0, 90, 4)).angle_deg.values
    array([ 0., 30., 60., 90.])
    """
    return Polar(_inner(speed, "polar: speed"), _inner(angle_deg, "polar: angle_deg"))


def _inner(value: Any, where: str) -> Axis:
    found = as_axis(value, where)
    if isinstance(found, Polar) or (isinstance(found, Values) and found.values.ndim > 1):
        raise CaromError(Fault(where, "", "numbers", "vectors"))
    if isinstance(found, Values) and found.values.dtype.kind != "f":
        raise CaromError(Fault(where, "", "numbers", repr(found.values.ravel()[0])))
    return found


def uniform(low: float, high: float) -> Draw:
    """Return a random number between two ends, drawn anew at every point of a sweep.

    Examples
    --------
    >>> from carom import sweeps
    >>> sweeps.uniform(0.1, 0.3).kind
    'uniform'
    """
    return Draw("uniform", *_two("uniform", ("low", low), ("high", high)))


def normal(mean: float, deviation: float) -> Draw:
    """Return a normal random number of a mean and a standard deviation, drawn anew at every point of a sweep.

    Examples
    --------
    >>> from carom import sweeps
    >>> sweeps.normal(2.0, 0.05).second
    0.05
    """
    found = _two("normal", ("mean", mean), ("deviation", deviation))
    if found[1] < 0:
        raise CaromError(Fault("normal", "deviation", "a number >= 0", repr(deviation)))
    return Draw("normal", *found)


def sobol(low: float, high: float, count: int, dim: str = "sample") -> Design:
    """Return a parameter's column of a scrambled Sobol sequence: the columns of one dimension fill the space evenly together.

    Parameters
    ----------
    low, high : float
    count : int
        Number of samples; a power of two keeps the sequence balanced.
    dim : str, optional

    Source: A. B. Owen, J. Complexity 14, 466 (1998), as ``scipy.stats.qmc.Sobol``.

    Examples
    --------
    >>> from carom import sweeps
    >>> sweeps.sobol(0.1, 0.3, 256).count
    256
    """
    ends = _two("sobol", ("low", low), ("high", high))
    return Design("sobol", *ends, _count("sobol", count), _dimension("sobol", dim))


def latin_hypercube(low: float, high: float, count: int, dim: str = "sample") -> Design:
    """Return a parameter's column of a Latin hypercube: each of ``count`` equal intervals holds one sample.

    Source: M. D. McKay et al., Technometrics 21, 239 (1979), as ``scipy.stats.qmc.LatinHypercube``.

    Examples
    --------
    >>> from carom import sweeps
    >>> sweeps.latin_hypercube(0, 90, 100).dim
    'sample'
    """
    ends = _two("latin_hypercube", ("low", low), ("high", high))
    return Design("latin-hypercube", *ends, _count("latin_hypercube", count), _dimension("latin_hypercube", dim))


def _two(where: str, *given: tuple[str, Any]) -> tuple[float, float]:
    found = []
    for name, value in given:
        try:
            number = float(value)
        except (TypeError, ValueError):
            number = math.nan
        if isinstance(value, bool) or not math.isfinite(number):
            raise CaromError(Fault(where, f"{name}", "a finite number", shown(value, 60)))
        found.append(number)
    return found[0], found[1]


def _count(where: str, value: Any) -> int:
    return require_count(where, "count", value, 1, MAX_VALUES, "more samples: uniform or normal, with repeats")


def design_columns(designs: Sequence[Design], seed: int) -> list[NDArray[np.float64]]:
    """Return the columns (count,) of the designs of one dimension, which have the same kind and count."""
    qmc = import_optional("scipy.stats.qmc", designs[0].kind)
    count, kind = designs[0].count, qmc.Sobol if designs[0].kind == "sobol" else qmc.LatinHypercube
    engine = kind(d=len(designs), rng=np.random.Generator(np.random.Philox(seed)))
    power = int(count).bit_length() - 1
    # (random(n) warns where n is no power of two: the user was told so)
    rows = engine.random_base2(power) if kind is qmc.Sobol and count == 1 << power else _quietly(engine, count)
    return [one.low + (one.high - one.low) * rows[:, k] for k, one in enumerate(designs)]


def _quietly(engine: Any, count: int) -> Any:
    import warnings

    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        return engine.random(count)


# --- from what people write ----------------------------------------------------------------------------------------


def as_axis(value: Any, where: str) -> Axis:
    """Return the axis of a parameter: an axis as it is, else values. CaromError, one line, for what is neither."""
    if isinstance(value, Values | Draw | Design | Polar):
        return value
    try:
        array = np.atleast_1d(np.asarray(value))
    except ValueError:
        raise CaromError(Fault(where, "", "numbers, or vectors of one length", shown(value, 60))) from None
    if not array.size:
        raise CaromError(Fault(where, "", "at least one value", "none"))
    if array.dtype.kind == "b" or array.dtype.kind not in "iufU":
        raise CaromError(Fault(where, "", "numbers, vectors, or names", shown(value, 60)))
    if array.ndim > 2 or (array.ndim == 2 and array.shape[1] not in (2, 3)):
        raise CaromError(Fault(where, "", "values (N,) or vectors (N, 2) or (N, 3)", f"shape {array.shape}"))
    if array.dtype.kind == "U":
        given = np.ravel(np.array(value, dtype=object)).tolist()
        return Values(array, own_laws=frozenset(one for one in given if isinstance(one, OwnLaw)))
    array = array.astype(float)
    if np.isnan(array).any():
        raise CaromError(Fault(where, "", "numbers", f"NaN at index {int(np.argwhere(np.isnan(array))[0][0])}"))
    return Values(array)


# --- as plain data, for TOML, JSON and stores ----------------------------------------------------------------------

FORMS = ("values", "linspace", "geomspace", "uniform", "normal", "sobol", "latin_hypercube", "polar", "arange")


def axis_to_data(axis: Axis) -> Any:
    """Return an axis as plain data, from which :func:`axis_from_data` makes it again, bit for bit."""
    if isinstance(axis, Draw):
        return {axis.kind: [axis.first, axis.second]}
    if isinstance(axis, Design):
        return {axis.kind.replace("-", "_"): [axis.low, axis.high, axis.count], "dim": axis.dim}
    if isinstance(axis, Polar):
        return {"polar": {"speed": axis_to_data(axis.speed), "angle": axis_to_data(axis.angle_deg)}}
    values = axis.values
    named = {} if axis.dim is None else {"dim": axis.dim}
    even = values.dtype.kind == "f" and values.ndim == 1 and len(values) > 3
    if even and np.array_equal(np.linspace(values[0], values[-1], len(values)), values):
        return {"linspace": [float(values[0]), float(values[-1]), len(values)], **named}
    return {"values": json_value(values, infinite=True), **named}


def from_plain(value: Any) -> Any:
    """Return plain data with the numbers that JSON has no word for: "inf" and "-inf"."""
    if isinstance(value, dict):
        return {name: from_plain(one) for name, one in value.items()}
    if isinstance(value, list):
        return [from_plain(one) for one in value]
    return float(value) if value in ("inf", "-inf") else value


def _require_few(where: str, name: str, given: list[Any]) -> None:
    """Raise CaromError for more values than one dimension may have, before they are made."""
    first, *rest = map(float, given)
    last, step = (rest[0] if rest else 0.0), (rest[1] if len(rest) > 1 else 1.0)
    count = step if name != "arange" else (last - first) / step if rest else first
    if not count <= MAX_VALUES:
        raise CaromError(
            Fault(where, f"{name}", f"at most {MAX_VALUES:,} values", f"{count:,.6g}", "take fewer, or draws")
        )


def axis_from_data(data: Any, where: str) -> Axis:
    """Return the axis that plain data stand for: a value, a list, or a table with one of FORMS. CaromError, one line."""
    if not isinstance(data, Mapping):
        return as_axis(from_plain(data) if isinstance(data, list) else data, where)
    form, dim = [name for name in data if name != "dim"], data.get("dim")
    if len(form) != 1 or form[0] not in FORMS:
        got = repr(form[0]) if len(form) == 1 else repr(form)
        advice = suggestion(form[0], FORMS) if len(form) == 1 else "one of them"
        raise CaromError(Fault(where, "", f"one of {', '.join(FORMS)}", f"{got}", advice))
    name, given = form[0], data[form[0]]
    if name == "polar":
        if not isinstance(given, Mapping) or set(given) != {"speed", "angle"}:
            raise CaromError(Fault(where, "polar", "speed and angle", shown(given, 60)))
        return polar(*(axis_from_data(given[part], f"{where}: {part}") for part in ("speed", "angle")))
    if not isinstance(given, list):
        raise CaromError(Fault(where, f"{name}", "a list", shown(given, 60)))
    try:
        made: Any
        if name == "values":
            made = as_axis(from_plain(given), where)
        elif name in ("linspace", "geomspace", "arange"):
            _require_few(where, name, given)
            with np.errstate(divide="raise", over="raise", invalid="raise"):  # (an end may be infinite)
                made = as_axis(getattr(np, name)(*given), where)
        else:
            makers = {"uniform": uniform, "normal": normal, "sobol": sobol, "latin_hypercube": latin_hypercube}
            maker: Any = makers[name]
            made = maker(*given)
    except (TypeError, ValueError, ArithmeticError) as error:
        if isinstance(error, CaromError):
            raise
        raise CaromError(Fault(where, f"{name}", "its arguments", f"{given!r:.60} ({error})")) from None
    if dim is None:
        return made  # type: ignore[no-any-return]
    if isinstance(made, Values):
        return replace(along(dim, made.values), own_laws=made.own_laws)
    if isinstance(made, Design):
        return replace(made, dim=_dimension(where, dim))
    raise CaromError(Fault(where, "dim", f"none with {name}, which is drawn anew at every point", repr(dim)))


# ----------------------------------------------------------------------------------------------------
# Sweeps over a model whose numbers are all of one level, or lie in its parts: paths, units, values made whole.


UNITS = {
    "velocity": "m/s", "speed": "m/s", "spin": "rad/s", "spin_x": "rad/s", "spin_y": "rad/s", "spin_z": "rad/s", "position": "m",
    "radius": "m", "ball_radius": "m", "mass": "kg", "azimuth": "degree", "elevation": "degree", "angle": "degree",
    "gravity": "m/s^2", "acceleration": "m/s^2", "duration": "s", "length": "m", "width": "m", "nose_height": "m", "height": "m",
    "depth": "m", "distance": "m", "period": "m", "side": "m", "straight": "m", "half_axes": "m", "points": "m", "point": "m",
    "size": "m", "vertical_speed": "m/s", "temperature": "J",
}  # fmt: skip


def unit_of(path: str) -> str:
    """Return the unit of a number by the last name of its path; "1" where it has none."""
    names = [name for name in path.split(".") if name not in ("x", "y", "z", "*") and not name.isdecimal()]
    return UNITS.get(names[-1], "1") if names else "1"


def check_paths(model: Model, parameters: Mapping[str, Axis]) -> None:
    """Raise CaromError for paths that lead nowhere or overlap, and for values that the model refuses wherever they stand."""
    found = FaultList("Space")
    matches = []
    for path, axis in parameters.items():
        try:
            match = path_match(model, path, "Space")
            matches.append(match)
            for value in ends_of(axis):
                replaced(model, {path: value})
            _require_kind(model, match, axis)
        except CaromError as error:
            fault = error.records[0]
            found.append(fault if fault.where == "Space" else Fault("Space", path, advice=str(fault)))
    for one, two in overlapping_paths(matches):
        found.add(f"{one} and {two}", "parameters of different numbers", "two of the same", "leave one out")
    found.raise_if_any()


def ends_of(axis: Axis) -> list[Any]:
    """Return the values of an axis that a model has to take: the ends of numbers, all names."""
    if not isinstance(axis, Values) or axis.values.ndim > 1:
        return []
    if axis.values.dtype.kind == "U":
        return [axis.named(text) for text in dict.fromkeys(axis.values.tolist())]
    return [plain_value(axis.values.min()), plain_value(axis.values.max())]


def _require_kind(model: Model, match: PathMatch, axis: Axis) -> None:
    """Raise CaromError for numbers where a vector stands, vectors where a number stands, and other things that no point can have.

    A model may refuse some of the points (a ball in a wall), which then have no outcome: a value of the right kind is asked about
    only if it may be the only one.
    """
    vectors = isinstance(axis, Polar) or (isinstance(axis, Values) and axis.values.ndim > 1)
    if isinstance(axis, Values) and not vectors:
        return  # (its ends were taken)
    stands, fault = match.values[0], None
    same = isinstance(stands, tuple) and _is_number(stands[:1]) if vectors else _is_number((stands,))
    for value in _some_of(axis):
        try:
            replaced(model, {match.path: value})
        except CaromError as error:
            fault = fault or error
        else:
            return
    if fault is not None and not same:
        raise fault


def _is_number(values: tuple[Any, ...]) -> bool:
    return any(isinstance(one, int | float) and not isinstance(one, bool) for one in values)


def _some_of(axis: Axis) -> list[Any]:
    """Return a few of the values of an axis, of draws the middle and the ends."""
    match axis:
        case Polar():
            sizes, angles = (np.array(_some_of(part), dtype=float) for part in (axis.speed, axis.angle_deg))
            return [row.tolist() for angle in angles for row in polar_rows(sizes, np.full(len(sizes), angle))]
        case Draw("normal"):
            return [axis.first, axis.first - axis.second, axis.first + axis.second]
        case Draw():
            return [(axis.first + axis.second) / 2, axis.first, axis.second]
        case Design():
            return [(axis.low + axis.high) / 2, axis.low, axis.high]
    places = np.unique(np.linspace(0, len(axis.values) - 1, 3).astype(int))
    return [plain_value(axis.values[k]) for k in places]


def plain_value(value: Any) -> Any:
    """Return one value as Python's own."""
    return value.tolist() if isinstance(value, np.generic | np.ndarray) else value  # (a text in a column is Python's)


# ----------------------------------------------------------------------------------------------------
# Outcomes of a point of a sweep: names, shapes, types, units; and why a point has no outcome.


AXES = ("x", "y", "z")
FAILED = "failed"
# Codes of the variable ``failed``.
FAILURES = (
    "no", "law_needs_a_rolling_ball", "law_undefined_for_pressed_ball", "ball_locked", "refused", "lost_in_air", "endless_in_air",
)  # fmt: skip
NOT_DONE = -1  # of a point that was not computed yet


@dataclass(frozen=True)
class Outcome:
    """One variable of a sweep's result.

    ``dims`` are its dimensions in addition to the space's, with the labels of their places.
    """

    name: str
    dtype: str = "f8"
    dims: dict[str, tuple[Any, ...]] = field(default_factory=dict)
    units: str = "1"
    meanings: tuple[str, ...] = ()
    """Meanings of its whole numbers, from 0 on; -1 stands for a point without an outcome."""

    @property
    def shape(self) -> tuple[int, ...]:
        """Sizes of its own dimensions."""
        return tuple(len(labels) for labels in self.dims.values())

    @property
    def fill(self) -> float:
        """Value of a point that has no outcome."""
        return float("nan") if self.dtype.startswith("f") else -1

    @property
    def bounds(self) -> tuple[float, float]:
        """Least and greatest value that it can have; NaN stands for none."""
        if self.dtype.startswith("f"):
            return (0.0, np.finfo(float).max) if self.units == "s" else (-np.inf, np.inf)
        return -1, len(self.meanings) - 1 if self.meanings else np.inf

    def impossible(self, values: NDArray[Any]) -> NDArray[np.bool_]:
        """Return which values it cannot have."""
        low, high = self.bounds
        return np.asarray((values < low) | (values > high))


WHY = Outcome(FAILED, "i1", meanings=FAILURES)


def blank(outcome: Outcome, count: int) -> NDArray[Any]:
    """Return an array of ``count`` points without an outcome."""
    return np.full((count, *outcome.shape), outcome.fill, dtype=outcome.dtype)


def require_outcomes(names: tuple[str, ...], known: list[str]) -> None:
    """Raise CaromError, with the nearest name, for names that are not known."""
    for name in names:
        if name not in known:
            hint = did_you_mean(str(name), known)
            raise CaromError(Fault("sweep", "keep", f"names among {', '.join(known)}", shown(name, 60), hint))
