"""Axes of a sweep: values, random draws, and designs of samples; in Python and as plain data."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any, Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

from carom.errors import CaromError, Fault, shown, suggestion
from carom.files import import_optional
from carom.formatting import json_value
from carom.public.own_laws import OwnLaw

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
    if isinstance(value, bool) or not isinstance(value, int | np.integer) or not 1 <= value <= MAX_VALUES:
        raise CaromError(
            Fault(
                where,
                "count",
                f"a whole number from 1 to {MAX_VALUES:,}",
                shown(value, 60),
                "more samples: uniform or normal, with repeats",
            )
        )
    return int(value)


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
