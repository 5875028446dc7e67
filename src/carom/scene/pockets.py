"""Pockets of a table: their declaration, and the jaws that follow from it.

A pocket catches a ball at the moment at which its centre passes the pocket's edge below the cushions' upper edge: the edge is a
feature of kind OVER that ends in FALLS (:func:`put_pocket`); the event: ``simulation/contacts/gates.py``, ``fall_into_pocket``.

Seen from above, the line of a cushion's nose ends in a tip, where it meets the line of the facing, which leads into the pocket. The
tip is rounded by an arc that touches both lines. The facing ends where it comes over the pocket, so that no ball gets past it: a
ball's centre crosses the pocket's edge before the ball reaches the facing's end.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Annotated, Any, NamedTuple

import numpy as np
from numpy.typing import NDArray
from pydantic import BeforeValidator

from carom.core.geometry.angles import direction
from carom.core.geometry.features import OVER
from carom.core.jit.kernel import Vec, kernel
from carom.scene.feature_builders import UP, Flat, circle, put, put_cushion, put_round_cushion
from carom.scene.schema import Length, Model, Number, Size

__all__ = ["Jaw", "Pockets", "is_free", "jaw_at", "jaw_line", "put_jaw", "put_pocket"]

Numbers = Sequence[float]


class Pockets(Model):
    """The shape of a table's four corner pockets, or of its two side pockets.

    Parameters
    ----------
    mouth : m: from tip to tip, where the lines of the noses meet the lines of the facings
    jaw_angle : degrees, 90 to 175: between nose and facing; a corner pocket with parallel facings has 135, a side pocket 90
    jaw_radius : m: of the arc that rounds each tip
    shelf : m: from the middle of the mouth to the pocket's edge; negative where the edge comes in front of the mouth
    radius : m: of the pocket's edge, a circle: a ball whose centre passes it falls

    Raises CaromError, one line per problem.

    Examples
    --------
    >>> import carom
    >>> corner = carom.scene.Pockets(mouth="116 mm", jaw_angle=142, jaw_radius=0.005, shelf=0.041, radius=0.062)
    >>> corner.mouth
    0.116
    """

    mouth: Size
    jaw_angle: Annotated[
        float, BeforeValidator(Number("an angle from 90 to 175 degrees", "degree", least=90, most=175))
    ]
    jaw_radius: Size
    shelf: Length
    radius: Size


class Jaw(NamedTuple):
    """One side of a pocket's mouth, as seen from above: where the nose ends, the arc, the facing."""

    nose_end: Flat
    center: Flat
    radius: float
    middle: Flat
    """Unit vector from the arc's centre to its middle."""
    cosine: float
    """Of half the arc's angle."""
    facing: Flat
    """Unit vector along the facing, into the pocket."""
    start: Flat
    end: Flat
    """Where the facing begins and ends; one point where the arc reaches the pocket."""
    reaches: bool
    """Whether the facing's line comes over the pocket at all."""
    forward: bool
    """Whether it lies at the end of its cushion, as one goes round the table counterclockwise."""


@kernel
def jaw_at(
    x: float, y: float, tx: float, ty: float, forward: bool, p: Numbers, first: int, px: float, py: float
) -> Jaw:
    """Return the jaw of a tip (x, y); the unit vector (tx, ty) leads along the nose towards the pocket, which is at (px, py).

    The numbers of the pocket's shape are those of p from ``first`` on.
    """
    angle, r, radius = 180 - p[first + 1], p[first + 2], p[first + 4]
    ox, oy = (ty, -tx) if forward else (-ty, tx)  # away from the table
    c, s = direction(angle)
    c2, s2 = direction(angle / 2)
    d = r * s / (1 + c)  # from the tip to where the arc touches the lines: r tan(turn / 2)
    fx, fy = c * tx + s * ox, c * ty + s * oy
    nose_end = (x - d * tx, y - d * ty)
    wx, wy = px - x, py - y
    on = wx * fx + wy * fy
    off2 = wx * wx + wy * wy - on * on
    reaches = off2 < radius * radius
    into = on - math.sqrt(radius * radius - off2) if reaches else d
    end = max(into, d)
    return Jaw(
        nose_end,
        (nose_end[0] + r * ox, nose_end[1] + r * oy),
        r,
        (s2 * tx - c2 * ox, s2 * ty - c2 * oy),
        c2,
        (fx, fy),
        (x + d * fx, y + d * fy),
        (x + end * fx, y + end * fy),
        reaches,
        forward,
    )


@kernel
def put_jaw(jaw: Jaw, low: float, high: float, i: int, out: Any) -> int:
    """Write arc and facing of a jaw, which stands from low to high."""
    u = (jaw.middle[0], jaw.middle[1], 0.0)
    i = put_round_cushion(jaw.center[0], jaw.center[1], jaw.radius, u, jaw.cosine, low, high, i, out)
    if jaw.start[0] == jaw.end[0] and jaw.start[1] == jaw.end[1]:
        return i
    # (its ends in the order in which they are passed counterclockwise)
    one, two = (jaw.start, jaw.end) if jaw.forward else (jaw.end, jaw.start)
    return put_cushion(one[0], one[1], two[0], two[1], low, high, i, out)


def jaw_line(jaw: Jaw) -> NDArray[np.float64]:
    """Return a jaw as seen from above, a polyline (n, 2) from the nose's end into the pocket."""
    middle, half = math.atan2(jaw.middle[1], jaw.middle[0]), math.acos(jaw.cosine)
    first, last = (middle + half, middle - half) if jaw.forward else (middle - half, middle + half)
    return np.vstack([circle(jaw.center, jaw.radius, first, last), jaw.end])


@kernel
def put_pocket(place: int, x: float, y: float, R: float, high: float, i: int, out: Any) -> int:
    """Write the edge of a pocket: balls fall below the height of the cushions; above it they have left the table."""
    i = put(out, i, OVER, (x, y, 0.0), UP, R, 1.0, (1.0, 0.0, 0.0), -1.0, 1.0, -math.inf, high, place)
    if high < math.inf:
        i = put(out, i, OVER, (x, y, 0.0), UP, R, 1.0, (1.0, 0.0, 0.0), -1.0, 1.0, high, math.inf, -1)
    return i


@kernel
def is_free(x: Vec, jaw: Jaw) -> bool:
    """Return whether a point behind the line of the nose is not in the rubber of a jaw."""
    fx, fy = jaw.facing
    nx, ny = (-fy, fx) if jaw.forward else (fy, -fx)
    if nx * (x[0] - jaw.start[0]) + ny * (x[1] - jaw.start[1]) >= 0:
        return True
    rx, ry = x[0] - jaw.center[0], x[1] - jaw.center[1]
    far = math.sqrt(rx * rx + ry * ry)  # in the sector that the arc rounds off, and beyond the arc
    return far >= jaw.radius and rx * jaw.middle[0] + ry * jaw.middle[1] >= jaw.cosine * far
