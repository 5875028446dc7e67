"""Periodic billiard tables in the plane, with circular obstacles: torus, Sinai's billiard, periodic strip."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace
from functools import partial

import numpy as np
from numpy.typing import NDArray

from carom.billiards.boundary import Boundary, Obstacle, ObstacleImage, face
from carom.billiards.checks import Bounds, positive_number, require_bounds, require_room
from carom.billiards.tables import Table
from carom.errors import CaromError, Fault, FaultList, float_array

__all__ = ["periodic_strip", "sinai", "torus"]

Array = NDArray[np.float64]


def torus(
    cell: Sequence[float] = (1.0, 1.0),
    scatterers: Sequence[Sequence[float]] = ((0.0, 0.0, 0.3),),
    *,
    bounds: Bounds = "centre",
) -> Table:
    """Return a periodic cell about the origin with circular obstacles.

    Parameters
    ----------
    cell : (width, height), m
    scatterers : sequence of (x, y, radius), m
    bounds : "centre" or "surface"
        Whether the wall bounds the ball's centre or its surface.

    Returns
    -------
    Table

    Raises
    ------
    CaromError
        One line per problem.

    Examples
    --------
    >>> from carom import billiards
    >>> print(billiards.torus((1.0, 1.0), [(0.0, 0.0, 0.4)]))
    torus (cell [1.0, 1.0], scatterers [[0.0, 0.0, 0.4]]; bounds the centre)
    """
    return _cell("torus", cell, scatterers, bounds, periodic=(True, True))


def sinai(radius: float = 0.3, side: float = 1.0, *, bounds: Bounds = "centre") -> Table:
    """Return Sinai's billiard: one circular obstacle in a square torus.

    Parameters
    ----------
    radius, side : float
        Radius of the obstacle and side of the torus, m.
    bounds : "centre" or "surface"
        Whether the wall bounds the ball's centre or its surface.

    Returns
    -------
    Table

    Raises
    ------
    CaromError
        One line per problem.

    Examples
    --------
    >>> from carom import billiards
    >>> print(billiards.sinai(0.3))
    sinai (radius 0.3, side 1.0; bounds the centre)
    """
    faults = FaultList("sinai")
    radius, side = positive_number(faults, "radius", radius), positive_number(faults, "side", side)
    faults.raise_if_any()
    made = _cell("sinai", (side, side), ((0.0, 0.0, radius),), bounds, periodic=(True, True))
    return replace(made, sizes={"radius": radius, "side": side})


def periodic_strip(
    period: float = 1.0,
    width: float = 1.0,
    scatterers: Sequence[Sequence[float]] = ((0.0, 0.0, 0.2),),
    *,
    bounds: Bounds = "centre",
) -> Table:
    """Return a strip, periodic in x, with walls y = -width/2 and y = width/2 and circular obstacles in each period.

    Parameters
    ----------
    period, width : float
        m.
    scatterers : sequence of (x, y, radius), m
    bounds : "centre" or "surface"
        Whether the wall bounds the ball's centre or its surface.

    Returns
    -------
    Table

    Raises
    ------
    CaromError
        One line per problem.

    Examples
    --------
    >>> from carom import billiards
    >>> billiards.periodic_strip(2.0, 1.0).wall().cell
    (2.0, inf)
    """
    return _cell("periodic strip", (period, width), scatterers, bounds, periodic=(True, False))


def _cell_boundary(
    name: str, w: float, h: float, circles: Array, periodic: tuple[bool, bool], inset: float
) -> Boundary:
    """Return the boundary of a cell with circular scatterers for a centre that stays ``inset`` away from the wall."""
    found = Boundary(size=2 * max(w, h), cell=(2 * w, 2 * h if periodic[1] else math.inf))
    along = [(2 * w, 0.0)]
    if periodic[1]:
        along += [(0.0, 2 * h), (2 * w, 2 * h), (2 * w, -2 * h)]
    else:
        c = inset - h
        require_room(name, -c, "between the walls", inset)
        # their length is one period; there are no corners at the windows
        found.faces = [
            face(0, 1, c, -w, w, low=-math.inf, high=math.inf),
            face(0, -1, c, -w, w, low=-math.inf, high=math.inf),
        ]
    found.windows = [face(1, 0, -w), face(-1, 0, -w)] + ([face(0, 1, -h), face(0, -1, -h)] if periodic[1] else [])
    found.windows = [one._replace(separation=2 * (w if one.normal[0] else h)) for one in found.windows]
    for k, (x, y, r) in enumerate(circles.tolist()):
        r += inset  # noqa: PLW2901
        if r >= math.hypot(w, h if periodic[1] else h - inset + abs(y)):
            what = (
                "one that covers the cell"
                if not inset
                else f"one that, with a ball of radius {inset:g}, covers the cell"
            )
            raise CaromError(Fault(f"{name}", "scatterers", "room between them", f"{what}", "take a smaller one"))
        found.outside.append(Obstacle(x, y, r, 0.0, math.tau))
        for dx, dy in along + [(-dx, -dy) for dx, dy in along]:
            if abs(x + dx) < w + r and abs(y + dy) < h + r:
                found.images.append(ObstacleImage(x + dx, y + dy, r, k))
    return found


def _cell(
    name: str, cell: Sequence[float], scatterers: Sequence[Sequence[float]], bounds: str, periodic: tuple[bool, bool]
) -> Table:
    faults = FaultList(name)
    require_bounds(faults, bounds)
    side = np.ones(2)
    circles = np.zeros((0, 3))
    for field, value, shape, what in (
        ("cell", cell, (2,), "two lengths > 0"),
        (
            "scatterers",
            scatterers,
            (len(scatterers) if hasattr(scatterers, "__len__") else 0, 3),
            "one or more (x, y, radius)",
        ),
    ):
        try:
            array = float_array(value)
        except (TypeError, ValueError):
            array = np.empty(0)
        lengths = array if field == "cell" else array[..., 2:]
        if array.shape != shape or not array.size or not np.isfinite(array).all() or not (lengths > 0).all():
            faults.add(field, what, repr(value))
        elif field == "cell":
            side = array
        else:
            circles = array
    faults.raise_if_any()
    w, h = (float(x) for x in side / 2)
    if (np.abs(circles[:, :2]) > side / 2).any():
        faults.add("scatterers", f"centres within the cell, |x| <= {w:.6g} and |y| <= {h:.6g}", repr(scatterers))
    faults.raise_if_any()

    make = partial(_cell_boundary, name, w, h, circles, periodic)
    return Table(name, bounds, 2, make, {"cell": [2 * w, 2 * h], "scatterers": circles.tolist()})
