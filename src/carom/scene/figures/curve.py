"""Smooth closed curves: r(theta), x(s) and y(s), or a spline through points."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import Annotated, Any, ClassVar, Literal

import numpy as np
from numpy.typing import NDArray
from pydantic import BeforeValidator, Field, PlainSerializer, model_validator

from carom.errors import CaromError, Fault
from carom.files import import_optional
from carom.scene.figures.figure import Figure, Loop, Piece, PlaneFigure, Sizes2, as_jet, call, formula, variable
from carom.scene.schema import Angle, Components, Number, Place, Size, Whole, raise_faults, refused

Array = NDArray[np.float64]
LARGEST = 1e90  # m: the third powers of derivatives are still numbers
Function = Callable[[Any], Any]


@dataclass(frozen=True)
class FunctionPiece(Piece):
    """A piece x(t), y(t) by two functions, in arithmetic and NumPy's functions, which are differentiated exactly."""

    x: Function
    y: Function
    first: float = 0.0
    last: float = math.tau
    cuts: tuple[float, ...] = ()
    """Parameters at which its third derivative may jump."""

    def at(self, t: Any) -> tuple[Array, Array, Array]:
        """Return places and derivatives."""
        t = np.asarray(t, float)
        with np.errstate(all="ignore"):
            parts = [as_jet(one(variable(t))) for one in (self.x, self.y)]
        x, d, dd = (
            np.stack([np.broadcast_to(getattr(part, name), t.shape) for part in parts], axis=-1)
            for name in ("x", "d", "dd")
        )
        return x, d, dd

    def span(self) -> tuple[float, float]:
        """Return the first and the last parameter."""
        return self.first, self.last

    def reversed(self) -> FunctionPiece:
        """Return the curve the other way round."""
        x, y, turn = self.x, self.y, self.first + self.last
        cuts = tuple(turn - cut for cut in reversed(self.cuts))
        return FunctionPiece(lambda t: x(turn - t), lambda t: y(turn - t), self.first, self.last, cuts)


def PolarPiece(r: Function, cuts: tuple[float, ...] = ()) -> FunctionPiece:  # noqa: N802  (a piece, as the classes are)
    """Return the whole curve r(theta), counterclockwise about the origin."""
    return FunctionPiece(lambda t: r(t) * call("cos", t), lambda t: r(t) * call("sin", t), cuts=cuts)


class SplinePiece(Piece):
    """The cubic spline through points, closed or from the first to the last: its curvature is continuous.

    Its parameter is the length of the chords.
    """

    def __init__(self, points: Array, is_closed: bool = True) -> None:
        interpolate = import_optional("scipy.interpolate", "a spline through points")
        way = np.concatenate([points, points[:1]]) if is_closed else points
        chords = np.linalg.norm(np.diff(way, axis=0), axis=1)
        if not (chords > 0).all():
            raise CaromError(
                Fault("curve", "points", "points that differ from the one before", "two that are the same")
            )
        knots = np.concatenate([[0.0], np.cumsum(chords)])
        self.points, self.is_closed = points, is_closed
        self.cuts = tuple(knots[1:-1].tolist())
        self.spline = interpolate.CubicSpline(knots, way, bc_type="periodic" if is_closed else "not-a-knot")

    def at(self, t: Any) -> tuple[Array, Array, Array]:
        """Return places and derivatives."""
        return self.spline(t), self.spline(t, 1), self.spline(t, 2)

    def span(self) -> tuple[float, float]:
        """Return 0 and the length of all chords."""
        return 0.0, float(self.spline.x[-1])

    def reversed(self) -> SplinePiece:
        """Return the spline the other way round."""
        return SplinePiece(self.points[::-1], self.is_closed)


def _function(name: str) -> BeforeValidator:
    def read(value: Any) -> Any:
        if callable(value) or value is None:
            return value
        if isinstance(value, int | float) and not isinstance(value, bool):
            value = repr(value)
        if not isinstance(value, str):
            raise refused(f"a formula of {name}, or a Python function", f"{value!r:.60}")
        try:
            formula(value, name)
        except CaromError as error:
            fault = error.records_at("")[0]
            raise refused(fault.expected, fault.got, fault.advice) from None
        return value

    return BeforeValidator(read)


def _said(value: Any) -> Any:
    return getattr(value, "__name__", str(value)) if callable(value) else value


OfTheta = Annotated[Any, _function("theta"), PlainSerializer(_said, when_used="json")]
OfS = Annotated[Any, _function("s"), PlainSerializer(_said, when_used="json")]


class CurveFigure(PlaneFigure):
    """A region within a smooth closed curve: r(theta), x(s) and y(s), or a periodic cubic spline through points.

    Parameters
    ----------
    r : formula of theta (rad), m, or a Python function: the distance from the origin
    x, y : formulas of s, which goes from 0 to 2 pi, m, or Python functions; counterclockwise
    points : 4 or more times 2 lengths, m: places of a curve whose curvature is continuous, in order (SciPy)

    A formula has numbers, pi, e, + - * / ** and sin, cos, tan, sinh, cosh, tanh, exp, log, sqrt, atan, abs. A Python function is
    written in arithmetic and NumPy's functions; it is differentiated exactly.

    Examples
    --------
    >>> from carom.scene.figures import figure
    >>> round(figure("curve", r="1 + 0.1*cos(2*theta)").area, 6)
    3.157301
    """

    shape: Literal["curve"] = "curve"
    r: OfTheta = None
    x: OfS = None
    y: OfS = None
    points: (
        Annotated[tuple[Place, ...], BeforeValidator(Components("4 or more points (x, y)", range(4, 100_000)))] | None
    ) = None

    @model_validator(mode="after")
    def _one_way(self) -> CurveFigure:
        given = [name for name in ("r", "x", "y", "points") if getattr(self, name) is not None]
        if given not in (["r"], ["x", "y"], ["points"]):
            got = " and ".join(given) or "none of these"
            raise_faults([Fault("", "curve", "r, or x and y, or points", got)])
        if not self.points:
            _try(self)
        return self

    def outline(self) -> list[Loop]:
        """Return one piece."""
        if self.r is not None:
            return [[PolarPiece(_as_function(self.r, "theta"))]]
        if self.points is not None:
            points = np.array(self.points)
            x, y = (points - points[0]).T
            clockwise = np.sum(x * np.roll(y, -1) - y * np.roll(x, -1)) < 0
            return [[SplinePiece(points[::-1] if clockwise else points)]]
        found = self._by_functions()
        x, y = found.at(np.linspace(*found.span(), 721))[0].T
        return [[found.reversed() if np.sum(x * np.roll(y, -1) - y * np.roll(x, -1)) < 0 else found]]

    def _by_functions(self) -> FunctionPiece:
        return FunctionPiece(_as_function(self.x, "s"), _as_function(self.y, "s"))

    def open_pieces(self) -> list[Piece]:
        """Return the curve from its first place to its last one, which need not be the same."""
        if self.points is not None:
            return [SplinePiece(np.array(self.points), is_closed=False)]
        return [self._by_functions()] if self.r is None else [*self.outline()[0]]


def _try(figure: CurveFigure) -> None:
    """Refuse functions that cannot be differentiated, or have no value somewhere."""
    for name, variable_name in (("r", "theta"), ("x", "s"), ("y", "s")):
        function = getattr(figure, name)
        if function is None:
            continue
        t = np.linspace(0, math.tau, 360, endpoint=False)
        try:
            with np.errstate(all="ignore"):
                found = as_jet(_as_function(function, variable_name)(variable(t)))
        except (TypeError, ValueError, ArithmeticError, AttributeError, LookupError) as error:
            expected = "a function in arithmetic and NumPy's functions, such as lambda theta: 1 + 0.3*np.cos(theta)"
            raise_faults([Fault("", name, expected, f"{type(error).__name__}: {error}")])
        if not all(np.isfinite(part).all() for part in (found.x, found.d, found.dd)):
            raise_faults(
                [Fault("", name, "finite values and derivatives from 0 to 2 pi", f"others, of {_said(function)}")]
            )
        largest = max(float(np.abs(part).max()) for part in (found.x, found.d, found.dd))
        if largest > LARGEST:
            raise_faults([Fault("", name, f"lengths below {LARGEST:g} m", f"{largest:.6g}, of {_said(function)}")])


def _as_function(value: Any, name: str) -> Function:
    found: Function = value if callable(value) else formula(value, name)
    return found


# ----------------------------------------------------------------------------------------------------
# Circles with ripples, r = radius (1 + eps cos(leaves theta)): limacon, oval, flower.


Eps = Annotated[float, BeforeValidator(Number("a number from 0 to below 1", least=0, most=0.999))]


def _ripples(radius: float, eps: float, leaves: float) -> list[Loop]:
    """Return the whole curve."""
    return [[PolarPiece(lambda t: radius * (1.0 + eps * call("cos", leaves * t)))]]


class LimaconFigure(PlaneFigure):
    """A limacon r = radius (1 + eps cos theta): a circle for eps = 0, convex up to 1/2, a cardioid with its cusp for 1.

    Pascal's curve, Robnik's billiard. Source: M. Robnik, J. Phys. A 16, 3971 (1983), https://doi.org/10.1088/0305-4470/16/17/014.

    Parameters
    ----------
    eps : from 0 to below 1
    radius : m
    """

    usual: ClassVar = {"eps": 0.3, "radius": 1.0}
    shape: Literal["limacon"] = "limacon"
    eps: Eps
    radius: Size

    def outline(self) -> list[Loop]:
        """Return the whole curve."""
        return _ripples(self.radius, self.eps, 1.0)


class OvalFigure(PlaneFigure):
    """An oval r = radius (1 + eps cos 2 theta): convex up to eps = 1/5, and with a neck beyond.

    Below 1/5 orbits along the wall stay there: there are rotational invariant curves. Beyond there are none.
    Source: M. V. Berry, Eur. J. Phys. 2, 91 (1981), https://doi.org/10.1088/0143-0807/2/2/006.

    Parameters
    ----------
    eps : from 0 to below 1
    radius : m
    """

    usual: ClassVar = {"eps": 0.1, "radius": 1.0}
    shape: Literal["oval"] = "oval"
    eps: Eps
    radius: Size

    def outline(self) -> list[Loop]:
        """Return the whole curve."""
        return _ripples(self.radius, self.eps, 2.0)


class FlowerFigure(PlaneFigure):
    """A flower r = radius (1 + eps cos(leaves theta)); with inflections beyond eps = 1/(1 + leaves^2).

    Parameters
    ----------
    leaves : number of leaves, from 1 to 50
    eps : from 0 to below 1
    radius : m
    """

    usual: ClassVar = {"leaves": 5, "eps": 0.2, "radius": 1.0}
    shape: Literal["flower"] = "flower"
    leaves: Annotated[int, BeforeValidator(Whole("a whole number from 1 to 50", 1)), Field(le=50)]
    eps: Eps
    radius: Size

    def outline(self) -> list[Loop]:
        """Return the whole curve."""
        return _ripples(self.radius, self.eps, float(self.leaves))


# ----------------------------------------------------------------------------------------------------
# Lame's superellipse.


class SuperellipseFigure(PlaneFigure):
    """A superellipse |x/p|^n + |y/q|^n = 1: an ellipse for n = 2, nearly a rectangle for large n.

    Parameters
    ----------
    half_axes : 2 lengths, m: p, q
    power : n, a whole number from 2 to 20
    """

    usual: ClassVar = {"half_axes": (1.0, 0.8), "power": 4}
    shape: Literal["superellipse"] = "superellipse"
    half_axes: Sizes2
    power: Annotated[int, BeforeValidator(Whole("a whole number from 2 to 20", 2)), Field(le=20)]

    def outline(self) -> list[Loop]:
        """Return the whole curve, by the angle; for odd n its third derivative or a higher one jumps on the axes."""
        (p, q), n = self.half_axes, float(self.power)

        def r(t: Any) -> Any:
            x, y = call("absolute", call("cos", t) / p), call("absolute", call("sin", t) / q)
            return (x**n + y**n) ** (-1.0 / n)

        return [[PolarPiece(r, tuple(math.pi / 2 * k for k in range(1, 4)))]]


# ----------------------------------------------------------------------------------------------------
# Figures without an end: strip and wedge in the plane, plates in space.


class StripFigure(Figure):
    """A strip: two parallel walls y = -width/2 and y = width/2.

    Parameters
    ----------
    width : m
    """

    usual: ClassVar = {"width": 1.0}
    shape: Literal["strip"] = "strip"
    width: Size


class WedgeFigure(Figure):
    """A wedge: two walls from the origin, symmetric about the x axis.

    Parameters
    ----------
    angle : degrees, above 0 and below 180: between the walls
    """

    usual: ClassVar = {"angle": 40.0}
    shape: Literal["wedge"] = "wedge"
    angle: Angle

    @model_validator(mode="after")
    def _opens(self) -> WedgeFigure:
        if not 0 < self.angle < 180:
            raise_faults([Fault("", "angle", "degrees > 0 and < 180", f"{self.angle:g}")])
        return self


class PlatesFigure(Figure):
    """Two parallel plates in space, y = -distance/2 and y = distance/2.

    Parameters
    ----------
    distance : m
    """

    dimension: ClassVar[int] = 3
    usual: ClassVar = {"distance": 1.0}
    shape: Literal["plates"] = "plates"
    distance: Size
