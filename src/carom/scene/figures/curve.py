"""Smooth closed curves: r(theta), x(s) and y(s), or a spline through points."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import Annotated, Any, Literal

import numpy as np
from numpy.typing import NDArray
from pydantic import BeforeValidator, PlainSerializer, model_validator

from carom.core.jets import as_jet, call, variable
from carom.errors import CaromError, Fault
from carom.files import import_optional
from carom.scene.figures.figure import Loop, PlaneFigure
from carom.scene.figures.formula import formula
from carom.scene.figures.pieces import Piece
from carom.scene.schema import Components, Place, raise_faults, refused

__all__ = ["CurveFigure", "FunctionPiece", "PolarPiece", "SplinePiece"]

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
