"""Figures: regions in the plane or in space by name and sizes; scenes, gases and billiards make their records from them."""

from __future__ import annotations

import ast
import functools
import inspect
import json
import math
import warnings
from abc import ABC, abstractmethod
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from os import PathLike
from pathlib import Path
from typing import Annotated, Any, ClassVar, NamedTuple

import numpy as np
from numpy.typing import NDArray
from pydantic import BeforeValidator, PlainSerializer, PlainValidator

from carom.errors import CaromError, Fault, did_you_mean, near_name, shown
from carom.files import as_path, parse_json, read_regular
from carom.scene.presets import read_toml
from carom.scene.schema import Components, Model, Place, Size, from_file, refused, with_faults_of_part

Array = NDArray[np.float64]
Flat = tuple[float, float]
PARTS, ORDER = 64, 12  # Gauss-Legendre rules for the length of a piece, and nodes of each
STEPS = 8  # of Newton's method for the parameter at an arc length


class Piece(ABC):
    """A smooth piece of a boundary, with the open side on its left.

    A subclass has two methods: :meth:`at` and :meth:`span`. All others follow from these; a subclass with a closed form replaces
    them.

    Examples
    --------
    >>> from carom.scene.figures import ArcPiece
    >>> quarter = ArcPiece((0.0, 0.0), 2.0, 0.0, 90.0)
    >>> round(quarter.length, 6), quarter.curvature([1.0])
    (3.141593, array([0.5]))
    """

    @abstractmethod
    def at(self, t: Any) -> tuple[Array, Array, Array]:
        """Return the places (N, 2) at parameters t (N), and their first and second derivatives by t (N, 2)."""

    @abstractmethod
    def span(self) -> tuple[float, float]:
        """Return the parameters at its beginning and its end, the second one the greater."""

    def reversed(self) -> Piece:
        """Return the piece from its end to its beginning: its open side is the other one."""
        return _Turned(self)

    @functools.cached_property
    def _lengths(self) -> tuple[Array, Array]:
        """Return parameters, and the arc lengths there."""
        first, last = self.span()
        t = np.linspace(first, last, PARTS + 1)
        nodes, weights = np.polynomial.legendre.leggauss(ORDER)
        middle, half = (t[1:] + t[:-1]) / 2, (last - first) / PARTS / 2
        rate = np.linalg.norm(self.at((middle[:, None] + half * nodes).ravel())[1], axis=-1).reshape(PARTS, ORDER)
        return t, np.concatenate([[0.0], np.cumsum(rate @ weights * half)])

    @property
    def length(self) -> float:
        """Its length, m."""
        return float(self._lengths[1][-1])

    def arc_length(self, t: Any) -> Array:
        """Return the arc lengths (N), m, from its beginning to parameters t (N)."""
        ends, lengths = self._lengths
        t = np.asarray(t, float)
        nodes, weights = np.polynomial.legendre.leggauss(ORDER)
        k = np.clip(np.searchsorted(ends, t, side="right") - 1, 0, PARTS - 1)
        half = (t - ends[k]) / 2
        inner = ends[k][..., None] + half[..., None] * (nodes + 1)
        rate = np.linalg.norm(self.at(inner.ravel())[1], axis=-1).reshape(inner.shape)
        found: Array = lengths[k] + rate @ weights * half
        return found

    def parameter(self, s: Any) -> Array:
        """Return the parameters (N) at arc lengths s (N), m, from its beginning."""
        t, lengths = self._lengths
        s = np.asarray(s, float)
        found: Array = np.interp(s, lengths, t)
        for _ in range(STEPS):  # Newton: ds/dt = |x'|
            here = np.linalg.norm(self.at(found)[1], axis=-1)
            found = np.clip(found - (self.arc_length(found) - s) / here, t[0], t[-1])
        return found

    def place(self, s: Any) -> Array:
        """Return the places (N, 2), m, at arc lengths s (N), m."""
        return self.at(self.parameter(s))[0]

    def tangent(self, s: Any) -> Array:
        """Return the unit tangents (N, 2) at arc lengths s (N), m."""
        along = self.at(self.parameter(s))[1]
        found: Array = along / np.linalg.norm(along, axis=-1, keepdims=True)
        return found

    def normal(self, s: Any) -> Array:
        """Return the unit normals (N, 2) towards the open side at arc lengths s (N), m."""
        return _left(self.tangent(s))

    def curvature(self, s: Any) -> Array:
        """Return the curvatures (N), 1/m, at arc lengths s (N): above 0 where it bends towards the open side."""
        _x, d, dd = self.at(self.parameter(s))
        found: Array = (d[:, 0] * dd[:, 1] - d[:, 1] * dd[:, 0]) / np.linalg.norm(d, axis=-1) ** 3
        return found

    def inset(self, a: float) -> Piece:
        """Return the parallel curve at the distance a, m, on the open side: where a ball of radius a has its centre.

        Its radius of curvature is smaller by a. Where a is greater than the radius of curvature a ball does not reach the piece,
        and the parallel curve runs backwards there; who uses it cuts that part off.
        """
        return self if a == 0 else ParallelPiece(self, a)


@dataclass(frozen=True)
class _Turned(Piece):
    """A piece from its end to its beginning."""

    of: Piece

    def at(self, t: Any) -> tuple[Array, Array, Array]:
        first, last = self.of.span()
        x, d, dd = self.of.at(first + last - np.asarray(t, float))
        return x, -d, dd

    def span(self) -> tuple[float, float]:
        return self.of.span()

    @property
    def cuts(self) -> tuple[float, ...]:
        """Parameters at which a derivative jumps, as of a spline."""
        return tuple(sum(self.span()) - cut for cut in reversed(getattr(self.of, "cuts", None) or ()))

    def reversed(self) -> Piece:
        return self.of


def _left(t: Array) -> Array:
    return np.stack([-t[..., 1], t[..., 0]], axis=-1)


@dataclass(frozen=True)
class SegmentPiece(Piece):
    """A straight piece between two points, m."""

    start: Flat
    end: Flat

    def at(self, t: Any) -> tuple[Array, Array, Array]:
        """Return places and derivatives; t goes from 0 to 1."""
        t = np.asarray(t, float)
        x, d = np.array(self.start), np.subtract(self.end, self.start)
        return x + np.multiply.outer(t, d), np.broadcast_to(d, (*t.shape, 2)), np.zeros((*t.shape, 2))

    def span(self) -> tuple[float, float]:
        """Return 0 and 1."""
        return 0.0, 1.0

    def reversed(self) -> SegmentPiece:
        """Return the segment from its end to its beginning."""
        return SegmentPiece(self.end, self.start)

    @property
    def length(self) -> float:
        """Its length, m."""
        return math.dist(self.start, self.end)

    def parameter(self, s: Any) -> Array:
        """Return the parameters (N) at arc lengths s (N), m."""
        return np.asarray(s, float) / self.length

    def inset(self, a: float) -> SegmentPiece:
        """Return the segment moved by a, m, towards the open side."""
        off = a * self.normal(np.zeros(1))[0]
        (x, y), (u, v) = (np.add(one, off).tolist() for one in (self.start, self.end))
        return SegmentPiece((x, y), (u, v))


@dataclass(frozen=True)
class ArcPiece(Piece):
    """An arc of a circle from one angle to another, degrees from x: counterclockwise, the centre on the open side, or clockwise."""

    center: Flat
    radius: float
    from_angle_deg: float
    to_angle_deg: float
    """Degrees: above ``from_angle_deg``: counterclockwise; below: clockwise, an obstacle seen from outside."""

    @property
    def way(self) -> float:
        """1 where the centre is on the open side, else -1."""
        return math.copysign(1.0, self.to_angle_deg - self.from_angle_deg)

    def at(self, t: Any) -> tuple[Array, Array, Array]:
        """Return places and derivatives; t is the angle turned, rad."""
        t, w = np.asarray(t, float), self.way
        angle = math.radians(self.from_angle_deg) + w * t
        u = np.stack([np.cos(angle), np.sin(angle)], axis=-1)
        return np.add(self.center, self.radius * u), w * self.radius * _left(u), -self.radius * u

    def span(self) -> tuple[float, float]:
        """Return 0 and its angle, rad."""
        return 0.0, math.radians(abs(self.to_angle_deg - self.from_angle_deg))

    def reversed(self) -> ArcPiece:
        """Return the arc the other way round."""
        return ArcPiece(self.center, self.radius, self.to_angle_deg, self.from_angle_deg)

    @property
    def length(self) -> float:
        """Its length, m."""
        return self.radius * self.span()[1]

    def parameter(self, s: Any) -> Array:
        """Return the angles turned (N), rad, at arc lengths s (N), m."""
        return np.asarray(s, float) / self.radius

    def inset(self, a: float) -> Piece:
        """Return the arc about the same centre; of a ball that does not fit into it, the parallel curve that runs backwards."""
        radius = self.radius - self.way * a
        if radius <= 0:
            return ParallelPiece(self, a)
        return ArcPiece(self.center, radius, self.from_angle_deg, self.to_angle_deg)


@dataclass(frozen=True)
class EllipsePiece(Piece):
    """An arc of the ellipse (p cos u, q sin u) about a centre, for u from one angle to another, degrees."""

    half_axes: Flat
    from_angle_deg: float = 0.0
    to_angle_deg: float = 360.0
    center: Flat = (0.0, 0.0)

    @property
    def is_whole(self) -> bool:
        """Whether it is the whole ellipse, counterclockwise about the origin."""
        return self.to_angle_deg - self.from_angle_deg == 360.0 and not any(self.center)

    def at(self, t: Any) -> tuple[Array, Array, Array]:
        """Return places and derivatives; t is the change of u, rad."""
        t, w = np.asarray(t, float), math.copysign(1.0, self.to_angle_deg - self.from_angle_deg)
        u, axes = math.radians(self.from_angle_deg) + w * t, np.array(self.half_axes)
        out = axes * np.stack([np.cos(u), np.sin(u)], axis=-1)
        along = w * axes * np.stack([-np.sin(u), np.cos(u)], axis=-1)
        return np.add(self.center, out), along, -out

    def span(self) -> tuple[float, float]:
        """Return 0 and the change of u, rad."""
        return 0.0, math.radians(abs(self.to_angle_deg - self.from_angle_deg))

    def reversed(self) -> EllipsePiece:
        """Return the arc the other way round."""
        return EllipsePiece(self.half_axes, self.to_angle_deg, self.from_angle_deg, self.center)

    @property
    def length(self) -> float:
        """Its length, m; of a whole ellipse by the midpoint rule, which converges fast: the integrand is periodic."""
        if abs(self.to_angle_deg - self.from_angle_deg) != 360:
            return super().length
        t, (a, b) = (np.arange(256) + 0.5) * (2 * math.pi / 256), self.half_axes
        return float(np.hypot(a * np.sin(t), b * np.cos(t)).mean() * 2 * math.pi)


@dataclass(frozen=True)
class ParallelPiece(Piece):
    """The parallel curve of a piece at the distance a on its open side, with the same parameter."""

    of: Piece
    a: float

    def at(self, t: Any) -> tuple[Array, Array, Array]:
        """Return places and derivatives: P = x + a n, P' = (1 - a kappa) x'; the second one by differences of the first."""
        first, last = self.of.span()
        h = 1e-5 * (last - first)
        t = np.asarray(t, float)
        x, d = self._first(t)
        return x, d, (self._first(t + h)[1] - self._first(t - h)[1]) / (2 * h)

    def _first(self, t: Array) -> tuple[Array, Array]:
        x, d, dd = self.of.at(t)
        speed = np.linalg.norm(d, axis=-1, keepdims=True)
        kappa = (d[..., 0] * dd[..., 1] - d[..., 1] * dd[..., 0])[..., None] / speed**3
        return x + self.a * _left(d / speed), (1.0 - self.a * kappa) * d

    def span(self) -> tuple[float, float]:
        """Return the parameters of the piece."""
        return self.of.span()

    def reversed(self) -> ParallelPiece:
        """Return the same curve the other way round: it is at the distance -a from the piece the other way round."""
        return ParallelPiece(self.of.reversed(), -self.a)

    def curvature(self, s: Any) -> Array:
        """Return kappa/(1 - a kappa) (N), 1/m, at arc lengths s (N), m."""
        _x, d, dd = self.of.at(self.parameter(s))
        kappa: Array = (d[:, 0] * dd[:, 1] - d[:, 1] * dd[:, 0]) / np.linalg.norm(d, axis=-1) ** 3
        return kappa / (1.0 - self.a * kappa)


Loop = list[Piece]


class Joints(NamedTuple):
    """How the pieces of a closed loop follow each other; all arrays have an entry for each piece."""

    ends: Array
    """(N, 2, 2): its first and its last place, m."""
    tangents: Array
    """(N, 2, 2): unit tangents there."""
    speed: Array
    """(N): length of the derivative where it begins; of a segment its length, m."""
    turn: Array
    """(N): sine of the angle by which the tangent turns at its end: below 0 at a re-entrant corner."""
    cosine: Array
    """(N): of that angle."""


def joints(loop: Sequence[Piece]) -> Joints:
    """Return the ends of the pieces of a closed loop, and the angles between them."""
    if all(isinstance(piece, SegmentPiece) for piece in loop):
        ends = np.array([(piece.start, piece.end) for piece in loop])  # type: ignore[attr-defined]
        along = np.repeat(ends[:, 1:] - ends[:, :1], 2, axis=1)
    else:
        found = [piece.at(np.array(piece.span())) for piece in loop]
        ends, along = (np.array([one[k] for one in found]) for k in (0, 1))
    speed = np.hypot(along[..., 0], along[..., 1])
    t = along / speed[..., None]
    before, after = t[:, 1], np.roll(t[:, 0], -1, axis=0)
    turn = before[:, 0] * after[:, 1] - before[:, 1] * after[:, 0]
    return Joints(ends, t, speed[:, 0], turn, (before * after).sum(-1))


# --- figures ------------------------------------------------------------------------------------------------------------------


Sizes2 = Annotated[tuple[Size, Size], BeforeValidator(Components("2 lengths in m, > 0: along x, y", (2,)))]
Circle = tuple[float, float, float]

FIGURES: dict[str, type[Figure]] = {}
"""All figures by name; a class enters it when it is made."""


class Figure(Model):
    """A figure: its fields are its sizes, with units. Each kind is one class, in a file of :mod:`carom.scene.figures`.

    Raises CaromError, one line per problem.

    Examples
    --------
    >>> from carom.scene.figures import figure
    >>> figure("stadium:straight=2,radius=50 cm").describe()
    'stadium (straight 2.0, radius 0.5)'
    """

    tag: ClassVar[str] = "shape"
    dimension: ClassVar[int] = 2
    """2: in the plane, 3: in space."""
    usual: ClassVar[dict[str, Any]] = {}
    """Sizes of about 1 m, for who gives none."""

    @classmethod
    def __pydantic_init_subclass__(cls, **_options: Any) -> None:
        """Enter it among all figures."""
        # (a wall of a scene derives from its figure, and is none itself)
        if "shape" in inspect.get_annotations(cls):  # (its own; from Python 3.14 on they are made when asked for)
            FIGURES[cls.kind()] = cls

    @classmethod
    def kind(cls) -> str:
        """Return its name."""
        return str(cls.model_fields["shape"].default)

    @property
    def sizes(self) -> dict[str, Any]:
        """Its fields but its name, as plain data; what is not given is left out."""
        return {name: plain for name, value in self if name != "shape" and (plain := _plain(value)) is not None}

    def describe(self) -> str:
        """Return its name and its sizes in one line."""
        return f"{self.kind()} ({', '.join(self.phrases())})"

    def phrases(self) -> list[str]:
        """Return its sizes in words; a figure among them by its own."""
        found = []
        for name, value in self:
            plain = _plain(value)
            if isinstance(value, Figure):
                found += [f"{name} {value.kind()}", *value.phrases()]
            elif name != "shape" and plain is not None:
                found.append(f"{name} {plain}")
        return found


def _plain(value: Any) -> Any:
    if isinstance(value, Figure):
        return {"shape": value.kind(), **value.sizes}
    if isinstance(value, Mapping):
        return {name: _plain(one) for name, one in value.items()}
    if callable(value):
        return str(getattr(value, "__name__", value))
    return [_plain(one) for one in value] if isinstance(value, tuple) else value


class PlaneFigure(Figure):
    """A figure in the plane, about the origin: closed loops of pieces, with the open side on their left.

    To make your own, derive a class with a ``shape``, its sizes and :meth:`outline`, in a file of this package.
    """

    @abstractmethod
    def outline(self) -> list[Loop]:
        """Return the loops of its boundary: the first is the outside, counterclockwise; others are obstacles in it, clockwise."""

    def piece_names(self) -> list[str]:
        """Return the names of the pieces of its outer loop, as of a gas's walls: edge1, edge2, ... unless it has its own."""
        return [f"edge{k + 1}" for k in range(len(self.outline()[0]))]

    @property
    def area(self) -> float:
        """Its area, m^2."""
        return math.fsum(_area_of(piece) for loop in self.outline() for piece in loop)

    @property
    def length(self) -> float:
        """The length of its boundary, m."""
        return math.fsum(piece.length for loop in self.outline() for piece in loop)


def _area_of(piece: Piece) -> float:
    """Return half the integral of x dy - y dx along a piece."""
    nodes, weights = np.polynomial.legendre.leggauss(16)
    t = np.linspace(*piece.span(), 65)
    half = (t[1] - t[0]) / 2
    x, d, _dd = piece.at(((t[:-1] + half)[:, None] + half * nodes).ravel())
    rate = (x[:, 0] * d[:, 1] - x[:, 1] * d[:, 0]).reshape(-1, len(nodes))
    return math.fsum((rate @ weights * half / 2).tolist())


class CellFigure(Figure):
    """A rectangle about the origin that is periodic in x, and in y or between two walls, with round obstacles."""

    @property
    @abstractmethod
    def sides(self) -> Place:
        """Its lengths along x and y, m."""

    @property
    @abstractmethod
    def circles(self) -> tuple[Circle, ...]:
        """Its obstacles: x, y, radius, m."""

    @property
    def along(self) -> tuple[bool, bool]:
        """Whether it is periodic in x, and in y."""
        return True, True


# ----------------------------------------------------------------------------------------------------
# Formulas in files: arithmetic of one variable with a fixed list of functions, read by Python's ``ast``; nothing is run.


NAMES = {
    "sin": "sin", "cos": "cos", "tan": "tan", "sinh": "sinh", "cosh": "cosh", "tanh": "tanh", "exp": "exp", "log": "log",
    "sqrt": "sqrt", "atan": "arctan", "abs": "absolute",
}  # fmt: skip
"""Functions of a formula, by the names of NumPy's."""
CONSTANTS = {"pi": math.pi, "e": math.e}
LONGEST, DEEPEST = 2000, 60
OPERATORS: dict[type[ast.AST], Callable[..., Any]] = {
    ast.Add: lambda x, y: x + y, ast.Sub: lambda x, y: x - y, ast.Mult: lambda x, y: x * y, ast.Div: lambda x, y: x / y,
    ast.Pow: lambda x, y: x**y, ast.USub: lambda x: -x, ast.UAdd: lambda x: x,
}  # fmt: skip


def formula(text: str, name: str) -> Callable[[Any], Any]:
    """Return the function that a formula of one variable says, of a number or a jet (:mod:`carom.scene.figures.figure`).

    Numbers, ``name``, pi, e, + - * / ** and the functions of NAMES. Anything else raises CaromError, one line.

    Examples
    --------
    >>> from carom.scene.figures.figure import variable
    >>> from carom.scene.figures.figure import formula
    >>> import numpy as np
    >>> found = formula("1 + 0.3*cos(2*theta)", "theta")(variable(np.array([0.0])))
    >>> found.x, found.d, found.dd
    (array([1.3]), array([0.]), array([-1.2]))
    """
    if len(text) > LONGEST:
        raise _fault(f"a formula of at most {LONGEST:,} characters", f"{len(text):,}")
    try:
        with warnings.catch_warnings(action="ignore"):  # (Python's about a text that is refused anyway)
            tree = ast.parse(text.strip(), mode="eval").body
    except (SyntaxError, ValueError, RecursionError, MemoryError):
        raise _fault(f"a formula of {name}, such as 1 + 0.3*cos(2*{name})", shown(text)) from None
    return _read(tree, name, DEEPEST)


def _fault(expected: str, got: str, advice: str = "") -> CaromError:
    return CaromError(Fault("", "", expected, got, advice))


def _read(node: ast.AST, name: str, depth: int) -> Callable[[Any], Any]:
    """Return the function that a node says."""
    if depth == 0:
        raise _fault(f"a formula nested at most {DEEPEST} deep", "a deeper one")
    if isinstance(node, ast.Constant) and isinstance(node.value, int | float) and not isinstance(node.value, bool):
        try:
            value = float(node.value)
        except OverflowError:
            value = math.inf
        if not math.isfinite(value):
            raise _fault("numbers below 1e308", "a larger one")
        return lambda _x: np.float64(value)  # (which overflows to infinity, and has no complex powers)
    if isinstance(node, ast.Name):
        if node.id == name:
            return lambda x: x
        if node.id in CONSTANTS:
            constant = np.float64(CONSTANTS[node.id])
            return lambda _x: constant
        if node.id in NAMES:
            raise _fault(f"{node.id} of something, such as {node.id}({name})", f"{node.id} alone")
        known = [name, *CONSTANTS, *NAMES]
        raise _fault(f"{name}, {', '.join(CONSTANTS)} and functions", shown(node.id), did_you_mean(node.id, known))
    if isinstance(node, ast.BinOp | ast.UnaryOp) and type(node.op) in OPERATORS:
        work = OPERATORS[type(node.op)]
        parts = [node.left, node.right] if isinstance(node, ast.BinOp) else [node.operand]
        made = [_read(part, name, depth - 1) for part in parts]
        return lambda x: work(*(part(x) for part in made))
    if isinstance(node, ast.Call) and isinstance(node.func, ast.Name) and len(node.args) == 1 and not node.keywords:
        if node.func.id not in NAMES:
            raise _fault(f"one of {', '.join(NAMES)}", shown(node.func.id), did_you_mean(node.func.id, list(NAMES)))
        inner, function = _read(node.args[0], name, depth - 1), NAMES[node.func.id]
        return lambda x: call(function, inner(x))
    raise _fault("numbers, + - * / **, and functions of one argument", shown(ast.unparse(node)))


# ----------------------------------------------------------------------------------------------------
# Figures by a text, such as "stadium:straight=2,radius=1", by a table of their fields, and from a file.


# What other names are called here, with an example as it is written
CALLED = {
    "cardioid": "a cardioid is the limit of 'limacon:eps=0.99'", "bunimovich": "'stadium' is Bunimovich's",
    "triangle": "a regular one is 'regular:sides=3'", "square": "it is 'regular:sides=4', or 'rectangle:size=1,1'",
    "pentagon": "it is 'regular:sides=5'", "hexagon": "it is 'regular:sides=6'", "octagon": "it is 'regular:sides=8'",
    "lorentz": "'sinai' is one cell of the Lorentz gas, and 'cell' others",
    "poincare": "`portrait` draws the Poincare section of a table", "portrait": "`portrait` draws the portrait of a table",
}  # fmt: skip
OTHER_CURVES = "any smooth curve is given by its formula: 'curve:r=1 + 0.1*cos(3*theta)'"


def figure(what: str | Mapping[str, Any] | Figure | PathLike[str], /, **sizes: Any) -> Figure:
    """Return a figure by its name and its sizes.

    Parameters
    ----------
    what : str, dict, Path or Figure
        A name; a text such as "stadium:straight=2,radius=50 cm", "rectangle:size=2,1", "polygon:points=[[0,0],[2,0],[0,1]]" or
        "cylinder:stadium:straight=2,radius=1,height=3"; a table of its fields; a Path of a TOML file of these, or of a JSON file
        of these or of a polygon's points.
    **sizes : optional
        Its sizes, by their names. Of a text, and with no sizes at all, those left out are about 1 m.

    Returns
    -------
    Figure

    Raises
    ------
    CaromError
        One line per problem.

    Examples
    --------
    >>> from carom.scene.figures import figure
    >>> round(figure("ellipse", half_axes=(1.2, "50 cm")).area, 6)
    1.884956
    >>> figure("cylinder:stadium:straight=2,radius=1,height=3").over.describe()
    'stadium (straight 2.0, radius 1.0)'
    """
    table = figure_table(what, sizes)
    return what if isinstance(what, Figure) else _made(str(what) if isinstance(what, PathLike) else "figure", table)


def figure_table(what: str | Mapping[str, Any] | Figure | PathLike[str], sizes: Mapping[str, Any]) -> dict[str, Any]:
    """Return the table of the fields of a figure that is given as :func:`figure` takes it."""
    if isinstance(what, Figure):
        if sizes:
            expected = "no sizes beside a figure, which has its own"
            raise CaromError(*(Fault("figure", name, expected, shown(x)) for name, x in sizes.items()))
        return _fields_of(what)
    if isinstance(what, PathLike):
        return {**_read_file(as_path("figure", what)), **sizes}
    return {**what, **sizes} if isinstance(what, Mapping) else _table(str(what), sizes)


def _made(where: str, table: dict[str, Any]) -> Figure:
    name = table.get("shape")
    if name not in FIGURES:
        got = "nothing" if name is None else shown(name)
        meant = CALLED.get(near_name(str(name), CALLED)) or did_you_mean(str(name), list(FIGURES))
        raise CaromError(Fault(where, "shape", f"one of {', '.join(FIGURES)}", got, meant or OTHER_CURVES))
    try:
        return from_file(name if where == "figure" else where, FIGURES[name], table)
    except CaromError as error:
        raise CaromError(*(_with_example(fault, FIGURES[name]) for fault in error.records)) from None


def _with_example(fault: Fault, kind: type[Figure]) -> Fault:
    """Return the fault of a size that the figure does not have with its usual sizes, as they are written."""
    if not kind.usual or "." in fault.field or not fault.advice.startswith("known are"):
        return fault
    sizes = {name: json.dumps(value).replace(" ", "") for name, value in kind.usual.items()}
    example = ",".join(f"{name}={text if '[[' in text else text.strip('[]')}" for name, text in sizes.items())
    return replace(fault, advice=f"{fault.advice}; an example is {kind.model_fields['shape'].default}:{example}")


def _table(text: str, sizes: Mapping[str, Any]) -> dict[str, Any]:
    """Return the table of fields of a text; what it leaves out is as usual."""
    name, _colon, rest = text.partition(":")
    over, _colon, of_section = rest.partition(":")
    if name == "cylinder" and over in FIGURES:
        given = {**_fields(of_section), **sizes}
        own = {"height": given.pop("height")} if "height" in given else {}
        if over == "circle":
            return {"shape": name, **own, **FIGURES[over].usual, **given}
        return {"shape": name, **own, "section": {"shape": over, **FIGURES[over].usual, **given}}
    given = {**_fields(rest), **sizes}
    usual = FIGURES[name].usual if name in FIGURES and "section" not in given else {}
    return {"shape": name, **usual, **given}


def _fields(text: str) -> dict[str, Any]:
    """Return the fields of "name=value,name=value"; commas without a name after them belong to a value."""
    parts: list[str] = []
    for part in text.split(",") if text else []:
        if "=" in part or not parts:
            parts.append(part)
        else:
            parts[-1] += f",{part}"
    found = {}
    for part in parts:
        name, equals, value = part.partition("=")
        if not equals or not name.strip():
            raise CaromError(Fault("figure", "", "sizes such as straight=2,radius=1", repr(part)))
        found[name.strip()] = value_of_text(value.strip())
    return found


def value_of_text(text: str) -> Any:
    """Return the value of a text: JSON; numbers with commas between them; points "x,y x,y"; else a quantity with its unit."""
    try:
        return json.loads(text)
    except (ValueError, RecursionError):
        pass
    if "," not in text:
        return text
    rows = [[value_of_text(one.strip()) for one in row.split(",")] for row in text.split()]
    if len(rows) > 1 and all(len(row) > 1 for row in rows):
        return rows
    return [value_of_text(one.strip()) for one in text.split(",")]


def _read_file(path: Path) -> dict[str, Any]:
    """Return the table of fields in a file."""
    if path.suffix.lower() in {".csv", ".tsv", ".txt", ".parquet"}:
        curve = 'shape = "curve" with points = [[x, y], ...]'
        advice = f"corners are a list of [x, y] in JSON; points of a smooth curve are {curve} in TOML"
        raise CaromError(Fault(f"{path}", "", "a figure in TOML or JSON", f"a table ({path.suffix})", advice))
    if path.suffix.lower() != ".json":
        return read_toml(path, "it holds a shape and its sizes, as a wall of a scene does", "a file of a figure")
    found = parse_json(path, read_regular(path, "a file of a figure"))
    if isinstance(found, list):
        return {"shape": "polygon", "points": found}
    if not isinstance(found, dict):
        raise CaromError(Fault(f"{path}", "", "a table of fields, or a list of points", shown(found)))
    return found


def _validated(value: Any) -> Figure:
    return (
        with_faults_of_part(lambda: figure(value)) if isinstance(value, str | Mapping | Figure) else _no_figure(value)
    )


def _no_figure(value: Any) -> Figure:
    raise refused("a figure: a text such as 'stadium:straight=2,radius=1', or a table of its fields", shown(value))


def _fields_of(value: Figure) -> dict[str, Any]:
    return {"shape": value.kind(), **value.sizes}


# A field of a model that takes any figure.
AnyFigure = Annotated[Figure, PlainValidator(_validated), PlainSerializer(_fields_of)]


# ----------------------------------------------------------------------------------------------------
# Numbers with two derivatives: a function of one variable, in arithmetic and NumPy's functions, is differentiated exactly.
#
# A jet holds arrays of values, first and second derivatives by the variable; each operation has its chain rule.

# The value of each function, and its first and second derivative.
FUNCTIONS: dict[str, Callable[[Array], tuple[Array, Array, Array]]] = {
    "sin": lambda x: (np.sin(x), np.cos(x), -np.sin(x)),
    "cos": lambda x: (np.cos(x), -np.sin(x), -np.cos(x)),
    "tan": lambda x: (np.tan(x), 1 / np.cos(x) ** 2, 2 * np.tan(x) / np.cos(x) ** 2),
    "sinh": lambda x: (np.sinh(x), np.cosh(x), np.sinh(x)),
    "cosh": lambda x: (np.cosh(x), np.sinh(x), np.cosh(x)),
    "tanh": lambda x: (np.tanh(x), 1 / np.cosh(x) ** 2, -2 * np.tanh(x) / np.cosh(x) ** 2),
    "exp": lambda x: (np.exp(x), np.exp(x), np.exp(x)),
    "log": lambda x: (np.log(x), 1 / x, -1 / x**2),
    "sqrt": lambda x: (np.sqrt(x), 0.5 / np.sqrt(x), -0.25 / (x * np.sqrt(x))),
    "arctan": lambda x: (np.arctan(x), 1 / (1 + x * x), -2 * x / (1 + x * x) ** 2),
    "absolute": lambda x: (np.abs(x), np.sign(x), np.zeros_like(x)),
}
UFUNCS = {
    "add": "+",
    "subtract": "-",
    "multiply": "*",
    "divide": "/",
    "power": "**",
    "negative": "neg",
    "positive": "pos",
}


class Jet:
    """Values (N) with their first and second derivatives."""

    def __init__(self, x: Any, d: Any, dd: Any) -> None:
        self.x, self.d, self.dd = np.asarray(x, float), np.asarray(d, float), np.asarray(dd, float)

    def like(self, x: Any) -> Jet:
        """Return a number as a jet of the same kind without derivatives; a jet as it is."""
        return x if isinstance(x, Jet) else Jet(x, 0.0, 0.0)

    def of(self, x: Any, first: Any, second: Any) -> Jet:
        """Return a function of it that has the value x and these derivatives by it."""
        return Jet(x, first * self.d, second * self.d**2 + first * self.dd)

    def function(self, name: str) -> Jet:
        """Return one of FUNCTIONS of it."""
        return self.of(*FUNCTIONS[name](self.x))

    def __add__(self, other: Any) -> Jet:
        """Return the sum."""
        q = self.like(other)
        return Jet(self.x + q.x, self.d + q.d, self.dd + q.dd)

    def __neg__(self) -> Jet:
        """Return the negative."""
        return Jet(-self.x, -self.d, -self.dd)

    def __pos__(self) -> Jet:
        """Return itself."""
        return self

    def __sub__(self, other: Any) -> Jet:
        """Return the difference."""
        return self + -self.like(other)

    def __rsub__(self, other: Any) -> Jet:
        """Return the difference from a number."""
        found: Jet = -self + other
        return found

    def __mul__(self, other: Any) -> Jet:
        """Return the product."""
        q = self.like(other)
        return Jet(self.x * q.x, self.d * q.x + self.x * q.d, self.dd * q.x + 2 * self.d * q.d + self.x * q.dd)

    def __truediv__(self, other: Any) -> Jet:
        """Return the quotient."""
        q = self.like(other)
        return self * q.of(1 / q.x, -1 / q.x**2, 2 / q.x**3)

    def __rtruediv__(self, other: Any) -> Jet:
        """Return the quotient of a number by it."""
        return self.like(other) / self

    def __pow__(self, other: Any) -> Jet:
        """Return a power; with an exponent that varies, of a positive number."""
        if not isinstance(other, Jet) or not (other.d.any() or other.dd.any()):
            n = other.x if isinstance(other, Jet) else np.asarray(other, float)
            low = [np.where(n == k, 0.0, self.x ** np.where(n == k, 1.0, n - k - 1)) for k in (0, 1)]
            first = n * low[0]
            second = n * (n - 1) * np.where(n == 0, 0.0, low[1])
            return self.of(self.x**n, first, second)
        return call("exp", self.like(other) * call("log", self))

    def __rpow__(self, other: Any) -> Jet:
        """Return a number to the power of it."""
        found: Jet = self.like(other).__pow__(self)
        return found

    def __abs__(self) -> Jet:
        """Return the absolute value."""
        return call("absolute", self)

    __radd__ = __add__
    __rmul__ = __mul__

    def __array_ufunc__(self, ufunc: Any, method: str, *inputs: Any, **_options: Any) -> Any:
        """Apply NumPy's function."""
        name = ufunc.__name__
        if method != "__call__":
            return NotImplemented
        if name in FUNCTIONS and len(inputs) == 1:
            return call(name, inputs[0])
        if name in UFUNCS:
            first = self.like(inputs[0])
            work: dict[str, Callable[..., Jet]] = {
                "+": first.__add__, "-": first.__sub__, "*": first.__mul__, "/": first.__truediv__, "**": first.__pow__,
                "neg": lambda: -first, "pos": lambda: first,
            }  # fmt: skip
            return work[UFUNCS[name]](*inputs[1:])
        return NotImplemented


def as_jet(x: Any) -> Jet:
    """Return a number as a jet without derivatives; a jet as it is."""
    return x if isinstance(x, Jet) else Jet(x, 0.0, 0.0)


def call(name: str, x: Any) -> Jet:
    """Return one of FUNCTIONS of a jet."""
    return as_jet(x).function(name)


def variable(t: Array) -> Jet:
    """Return the variable itself at values (N)."""
    return Jet(t, np.ones_like(t), np.zeros_like(t))
