"""Pockets of a table: their declaration, and the jaws that follow from it.

A pocket catches a ball at the moment at which its centre passes the pocket's edge below the cushions' upper edge: the edge is a
feature of kind OVER that ends in FALLS (:func:`pocket_features`); its event sets the phase POCKETED (``simulation/loop.py``).

Seen from above, the line of a cushion's nose ends in a tip, where it meets the line of the facing, which leads into the pocket. The
tip is rounded by an arc that touches both lines. The facing ends where it comes over the pocket, so that no ball gets past it: a
ball's centre crosses the pocket's edge before the ball reaches the facing's end.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from itertools import combinations
from typing import Annotated, NamedTuple

import numpy as np
from numpy.typing import NDArray
from pydantic import BeforeValidator

from carom.core.geometry.angles import direction
from carom.core.geometry.features import OVER
from carom.errors import Fault, shown
from carom.formatting import format_length
from carom.scene.feature_builders import UP, Feature, Flat, circle, cushion, round_cushion
from carom.scene.schema import Length, Model, Number, Size, Vector
from carom.scene.wall import Pocket

__all__ = [
    "Jaw", "Pockets", "is_free", "jaw_at", "jaw_features", "jaw_line", "mouth_faults", "overlap_faults",
    "pocket_features",
]  # fmt: skip


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


def jaw_at(tip: Flat, along: Flat, forward: bool, shape: Pockets, at: Flat) -> Jaw:
    """Return the jaw of a tip; ``along`` is the unit vector along the nose towards the pocket, which is at ``at``."""
    (tx, ty), r = along, shape.jaw_radius
    ox, oy = (ty, -tx) if forward else (-ty, tx)  # away from the table
    c, s = direction(180 - shape.jaw_angle)
    c2, s2 = direction((180 - shape.jaw_angle) / 2)
    d = r * s / (1 + c)  # from the tip to where the arc touches the lines: r tan(turn / 2)
    fx, fy = c * tx + s * ox, c * ty + s * oy
    nose_end = (tip[0] - d * tx, tip[1] - d * ty)
    wx, wy = at[0] - tip[0], at[1] - tip[1]
    on = wx * fx + wy * fy
    off2 = wx * wx + wy * wy - on * on
    reaches = off2 < shape.radius * shape.radius
    into = on - math.sqrt(shape.radius * shape.radius - off2) if reaches else d
    end = max(into, d)
    return Jaw(
        nose_end,
        (nose_end[0] + r * ox, nose_end[1] + r * oy),
        r,
        (s2 * tx - c2 * ox, s2 * ty - c2 * oy),
        c2,
        (fx, fy),
        (tip[0] + d * fx, tip[1] + d * fy),
        (tip[0] + end * fx, tip[1] + end * fy),
        reaches,
        forward,
    )


def _facing(jaw: Jaw) -> tuple[Flat, Flat] | None:
    """Return the facing's ends in the order in which they are passed counterclockwise, if it has a length."""
    if jaw.start == jaw.end:
        return None
    return (jaw.start, jaw.end) if jaw.forward else (jaw.end, jaw.start)


def jaw_features(jaw: Jaw, low: float, high: float) -> list[Feature]:
    """Return arc and facing of a jaw, which stands from low to high."""
    found = round_cushion(jaw.center, jaw.radius, jaw.middle, jaw.cosine, low, high)
    facing = _facing(jaw)
    return found + (cushion(*facing, low, high) if facing else [])


def jaw_line(jaw: Jaw) -> NDArray[np.float64]:
    """Return a jaw as seen from above, a polyline (n, 2) from the nose's end into the pocket."""
    middle, half = math.atan2(jaw.middle[1], jaw.middle[0]), math.acos(jaw.cosine)
    first, last = (middle + half, middle - half) if jaw.forward else (middle - half, middle + half)
    return np.vstack([circle(jaw.center, jaw.radius, first, last), jaw.end])


def pocket_features(number: int, pocket: Pocket, high: float) -> Iterator[Feature]:
    """Return the edge of a pocket: balls fall below the height of the cushions; above it they have left the table."""
    edge = Feature(
        OVER, (*pocket.center, 0.0), UP, pocket.radius, 1.0, (1.0, 0.0, 0.0), -1.0, 1.0, -math.inf, high, number
    )
    yield edge
    if math.isfinite(high):
        yield edge._replace(lo2=high, hi2=math.inf, pocket=-1)


# --- problems -----------------------------------------------------------------------------------------------------


def mouth_faults(field: str, shape: Pockets, jaws: list[Jaw]) -> list[Fault]:
    """Report pockets outside the table, and jaws that do not lead into their pocket."""
    most = format_length(shape.mouth)
    if abs(shape.shelf) > shape.mouth:
        expected = f"a shelf of at most the mouth, {most}"
        return [Fault("", f"{field}.shelf", expected, shown(shape.shelf), "the pocket would lie outside the table")]
    if not all(jaw.reaches for jaw in jaws):
        expected = "a pocket wide enough for the jaws to end over its edge"
        return [Fault("", f"{field}.radius", expected, shown(shape.radius), "make radius larger, or mouth smaller")]
    return []


def overlap_faults(field: str, pockets: list[Pocket]) -> list[Fault]:
    """Report the first two pockets that overlap."""
    for one, two in combinations(pockets, 2):
        gap = math.dist(one.center, two.center) - one.radius - two.radius
        if gap < 0:
            got = f"{one.name} and {two.name}, which overlap by {format_length(-gap)}"
            return [Fault("", field, "pockets that lie apart", got, "make radius smaller, or the table larger")]
    return []


def is_free(x: Vector, jaw: Jaw) -> bool:
    """Return whether a point behind the line of the nose is not in the rubber of a jaw."""
    fx, fy = jaw.facing
    nx, ny = (-fy, fx) if jaw.forward else (fy, -fx)
    if nx * (x[0] - jaw.start[0]) + ny * (x[1] - jaw.start[1]) >= 0:
        return True
    rx, ry = x[0] - jaw.center[0], x[1] - jaw.center[1]
    far = math.sqrt(rx * rx + ry * ry)  # in the sector that the arc rounds off, and beyond the arc
    return far >= jaw.radius and rx * jaw.middle[0] + ry * jaw.middle[1] >= jaw.cosine * far
