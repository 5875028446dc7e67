"""The boundary of the region open to the centre of a ball within a curved wall: arcs of parallel curves, and their corners."""

from __future__ import annotations

import functools
import math
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from carom.billiards.checks import ball_too_large
from carom.billiards.curved_wall import CurvedWall, WallLoop, chord_frame, graphs, left_of, plane_of, slopes
from carom.core.geometry.curve import BEND, CX, FIRST_XI, HALF, HIGH, LAST_XI, LOW, OX, ROW, SLOPE, TX, W0, W1, X

__all__ = ["CurveArc", "CurvedRegion", "curved_region"]

Array = NDArray[np.float64]
LONGEST_ARC = 2.8  # rad: by so much an arc turns at most, below pi
SAME_NODE = (
    1e-9  # of the size: so near are a node and its tangent to those of the next arc where these are joined smoothly
)
NODES, WEIGHTS = np.polynomial.legendre.leggauss(12)


TOUCHES = 1e-9  # of the size: so much nearer to another part of the wall is rounding
SAMPLES = np.linspace(-1, 1, 25)  # of each panel and circle, at which the distance from the wall is asked


class Stretch(NamedTuple):
    """Panels of the wall, one after the other, without a corner in between."""

    loop: int
    panels: list[int]


class Bend(NamedTuple):
    """The circle on which the centre passes a corner of the wall with the interior all around."""

    x: float
    y: float
    first: float
    """Angle at which it begins, rad; it goes clockwise."""
    span: float


class CurveArc(NamedTuple):
    """An arc of the parallel curve."""

    first: int
    """Row of the table with its first node."""
    last: int
    """Row of its last node."""
    direction: tuple[float, float]
    """A unit vector with which all its tangents make an angle below pi/2."""
    corner_before: bool
    corner_after: bool


@dataclass(frozen=True, eq=False)
class CurvedRegion:
    """Arcs in the order of the boundary, and their table (:mod:`carom.core.geometry.curve`) for a ball of radius ``inset``."""

    wall: CurvedWall
    inset: float
    table: Array
    arcs: tuple[CurveArc, ...]
    reflex: tuple[Bend, ...]
    """Circles on which the centre passes reflex corners of the wall."""
    order: tuple[int, ...] | None
    """Order of the arcs and, after them, of these circles; None: by number."""
    rounds: tuple[int, ...]
    """Number of the first arc of each closed curve of the boundary."""

    @functools.cached_property
    def _ways(self) -> Array:
        """Return the arc length of each node from the beginning of its arc."""
        inner = self._length_to(np.arange(len(self.table)), self.table[:, W1])
        found = np.concatenate([[0.0], np.cumsum(inner)[:-1]])
        for arc in self.arcs:
            found[arc.first : arc.last + 1] -= found[arc.first]
        return found

    def _length_to(self, row: NDArray[np.int64], w: Array) -> Array:
        """Return the arc lengths (N) from the beginning of panels to w (N)."""
        rows = self.table[row]
        low, h = rows[:, W0], rows[:, HALF]
        half = (w - low) / 2
        total = np.zeros(len(row))
        rates = np.sqrt(1 + slopes(rows, low + half * (1 + NODES[:, None])) ** 2)
        for weight, rate in zip(WEIGHTS, rates, strict=True):
            total += weight * rate
        turned = np.arctan(slopes(rows, w)) - np.arctan(slopes(rows, low))
        found: Array = total * half * h - self.inset * turned
        return found

    @property
    def lengths(self) -> list[float]:
        """Length of each arc, m."""
        return [float(self._ways[arc.last]) for arc in self.arcs]

    def _feet(self, k: int, x: Array) -> tuple[NDArray[np.int64], Array]:
        """Return the rows and w of points (N, 2) on arc k."""
        arc = self.arcs[k]
        nodes = self.table[arc.first : arc.last, X : X + 2] @ np.array(arc.direction)
        row = arc.first + np.clip(
            np.searchsorted(nodes, x @ np.array(arc.direction), side="right") - 1, 0, len(nodes) - 1
        )
        rows = self.table[row]
        xi, eta = chord_frame(rows, x)
        w = np.clip(xi / rows[:, HALF] - 1, -1, 1)
        for _ in range(8 if self.inset else 1):
            f, f1, f2 = graphs(rows, w)
            dx, dy = xi - rows[:, HALF] * (1 + w), eta - f
            w = np.clip(w + (dx + f1 * dy) / (rows[:, HALF] * (1 + f1 * f1 - f2 * dy)), rows[:, W0], rows[:, W1])
        return row, w

    @functools.cached_property
    def parts(self) -> NDArray[np.int64]:
        """The smooth part that each arc belongs to, by number."""
        nodes, near = self.table[:, X : TX + 2], SAME_NODE * max(self.wall.size, 1.0)
        found = np.zeros(len(self.arcs), np.int64)
        number = 0
        for here in _each_round(self.rounds, len(self.arcs)):
            ends = [nodes[self.arcs[k].last] for k in here]
            joined = [
                bool(np.abs(ends[k - 1] - nodes[self.arcs[one].first]).max() < near) for k, one in enumerate(here)
            ]
            found[here] = number + np.cumsum([0, *(not one for one in joined[1:])])
            if joined[0]:
                found[here] = np.where(found[here] == found[here[-1]], number, found[here])
            number = int(found[here].max()) + 1
        return found

    def along(self, k: int, x: Array) -> Array:
        """Return the arc lengths (N) of points (N, 2) on arc k from its beginning."""
        row, w = self._feet(k, x)
        found: Array = self._ways[row] + self._length_to(row, w)
        return found

    def place(self, k: int, s: Array) -> tuple[Array, Array]:
        """Return points and normals (N, 2) at arc lengths (N) from the beginning of arc k."""
        arc = self.arcs[k]
        ways = self._ways[arc.first : arc.last + 1]
        row = arc.first + np.clip(np.searchsorted(ways, s, side="right") - 1, 0, len(ways) - 2)
        rows, rest = self.table[row], s - self._ways[row]
        low, high = rows[:, W0], rows[:, W1]
        w = low + (high - low) * rest / (self._ways[row + 1] - self._ways[row])
        for _ in range(8):
            _f, f1, f2 = graphs(rows, w)
            q = np.sqrt(1 + f1 * f1)
            rate = rows[:, HALF] * q * np.maximum(1 - self.inset * f2 / q**3, 1e-6)
            before, w = w, np.clip(w - (self._length_to(row, w) - rest) / rate, low, high)
            if (w == before).all():
                break
        return self._point(rows, w)

    def _point(self, rows: Array, w: Array) -> tuple[Array, Array]:
        f, f1, _f2 = graphs(rows, w)
        q = 1 / np.sqrt(1 + f1 * f1)
        n = plane_of(rows, -f1 * q, q)
        return rows[:, OX : OX + 2] + plane_of(rows, rows[:, HALF] * (1 + w), f) + self.inset * n, n

    def normals(self, k: int, x: Array) -> Array:
        """Return normals (N, 2) towards the ball at points (N, 2) on arc k."""
        row, w = self._feet(k, x)
        return self._point(self.table[row], w)[1]

    def curvatures(self, k: int, x: Array) -> Array:
        """Return curvatures (N) of the centre's curve at points (N, 2) on arc k."""
        row, w = self._feet(k, x)
        _f, f1, f2 = graphs(self.table[row], w)
        kappa = f2 / (1 + f1 * f1) ** 1.5
        found: Array = kappa / (1 - self.inset * kappa)
        return found

    def pieces(self) -> list[tuple[Any, ...]]:
        """Return its rows of :data:`carom.billiards.table_records.PIECES`."""
        return [
            ((*arc.direction, 0.0), arc.first, arc.last, arc.corner_before, arc.corner_after, -math.inf, math.inf)
            for arc in self.arcs
        ]


@functools.lru_cache(maxsize=64)
def curved_region(wall: CurvedWall, a: float) -> CurvedRegion:
    """Return the region open to the centre of a ball of radius a.

    CaromError for a ball that does not touch all of the wall: it is larger than a radius of curvature, or than a neck, or the
    wall has a corner that bends towards it.
    """
    wall.require_simple()
    if a > 0 and any(_hides(wall, loop, a) for loop in wall.loops):
        raise ball_too_large(wall.name, a)
    tables, arcs, order, rounds = list[Array](), list[CurveArc](), list[tuple[bool, int]](), list[int]()
    circles: list[Bend] = []
    row = 0
    for number, loop in enumerate(wall.loops):
        rounds.append(len(arcs))
        for one in _parts(number, loop, a):
            if isinstance(one, Bend):
                order.append((True, len(circles)))
                circles.append(one)
                continue
            part, own = _table_of(wall, one, a, row)
            order += [(False, len(arcs) + k) for k in range(len(own))]
            tables.append(part)
            arcs += own
            row += len(part)
    rows = np.concatenate(tables)
    for here in _each_round(rounds, len(arcs)):
        for arc, after in zip(here, here[1:] + here[:1], strict=True):
            # arcs that meet in a corner share it to the last bit, so that nothing passes between them
            end, begin = arcs[arc].last, arcs[after].first
            if np.abs(rows[end, X : X + 2] - rows[begin, X : X + 2]).max() < 1e-11 * wall.size:
                rows[end, X : X + 2] = rows[begin, X : X + 2]
    shown = tuple(len(arcs) * circle + k for circle, k in order) if circles else None
    return CurvedRegion(wall, a, rows, tuple(arcs), tuple(circles), shown, tuple(rounds))


def _bends(loop: WallLoop) -> dict[int, Bend]:
    """Return the circles around the reflex corners of a loop, by the panels before which they stand."""
    found = {}
    for k in np.flatnonzero(loop.jump < 0).tolist():
        (x, y), (tx, ty), jump = loop.rows[k, OX : OX + 2], loop.begin[k], float(loop.jump[k])
        found[k] = Bend(x, y, math.atan2(tx, -ty) - jump, -jump)
    return found


def _parts(number: int, loop: WallLoop, a: float) -> list[Stretch | Bend]:
    """Return all of a loop, divided at its corners, from the first one on; a ball goes around them on circles."""
    bends = _bends(loop) if a > 0 else {}
    corners = list(bends) if a > 0 else np.flatnonzero(loop.jump != 0).tolist()
    first, count = corners[0] if corners else 0, len(loop.rows)
    found: list[Stretch | Bend] = []
    for k in ((first + m) % count for m in range(count)):
        if k in corners or not found:
            # (the circle before the first panel comes last)
            found += [bends[k]] if k in bends and found else []
            found.append(Stretch(number, []))
        stretch = found[-1]
        assert isinstance(stretch, Stretch)
        stretch.panels.append(k)
    return found + ([bends[first]] if first in bends else [])


def _hides(wall: CurvedWall, loop: WallLoop, a: float) -> bool:
    """Return whether a ball of radius a cannot touch all of a loop."""
    rows, w = np.repeat(loop.rows, len(SAMPLES), axis=0), np.tile(SAMPLES, len(loop.rows))
    f, f1, f2 = graphs(rows, w)
    q = 1 / np.sqrt(1 + f1 * f1)
    if (loop.jump > 0).any() or a * float((f2 * q**3).max()) >= 1 - TOUCHES:
        return True
    x = rows[:, OX : OX + 2] + plane_of(rows, rows[:, HALF] * (1 + w) - a * f1 * q, f + a * q)
    for one in _bends(loop).values():
        angle = one.first - one.span * (1 + SAMPLES) / 2
        x = np.concatenate([x, (one.x, one.y) + a * np.stack([np.cos(angle), np.sin(angle)], axis=-1)])
    return bool((wall.depth(x) < a - TOUCHES * wall.size).any())


def _each_round(rounds: Sequence[int], count: int) -> list[list[int]]:
    """Return the numbers of the arcs of each closed curve, given its first one."""
    return [list(range(first, last)) for first, last in pairwise([*rounds, count]) if last > first]


def _table_of(wall: CurvedWall, one: Stretch, a: float, base: int) -> tuple[Array, list[CurveArc]]:
    """Return the rows of a stretch, divided into arcs, and these; ``base``: the number of its first row in the table."""
    loop = wall.loops[one.loop]
    rows = loop.rows[one.panels].copy()
    low, high = rows[:, W0], rows[:, W1]
    begins, tangents = _nodes(rows, low, a)
    last, last_tangent = _nodes(rows[-1:], high[-1:], a)
    # the last node of a closed curve without a corner is its first one
    count = len(loop.rows)
    closed = (one.panels[-1] + 1) % count == one.panels[0] and loop.jump[one.panels[0]] == 0
    if closed:
        last, last_tangent = begins[:1], tangents[:1]
    rows[:, X : X + 2], rows[:, TX : TX + 2] = begins, tangents
    _bounds(rows, a)
    turn, sign = np.arctan(graphs(rows, high)[1]) - np.arctan(graphs(rows, low)[1]), loop.sign[one.panels]
    cuts, way, turned = [0], 0, 0.0
    for k in range(len(rows)):
        if (sign[k] * way < 0) or abs(turned + turn[k]) > LONGEST_ARC:
            cuts.append(k)
            way, turned = 0, 0.0
        way, turned = int(sign[k]) or way, turned + float(turn[k])
    cuts.append(len(rows))
    parts, arcs = [], list[CurveArc]()
    for first, stop in pairwise(cuts):
        node = np.zeros((1, ROW))
        node[:, X : X + 2] = rows[stop, X : X + 2] if stop < len(rows) else last
        node[:, TX : TX + 2] = rows[stop, TX : TX + 2] if stop < len(rows) else last_tangent
        node[:, HALF], node[:, CX] = 1.0, 1.0
        parts += [rows[first:stop], node]
        middle = rows[first, TX : TX + 2] + node[0, TX : TX + 2]
        middle = middle / np.linalg.norm(middle)
        begin = base + first + len(arcs)
        arcs.append(
            CurveArc(
                begin, begin + stop - first, (float(middle[0]), float(middle[1])),
                first == 0 and not closed and not _smooth(loop, one, a, before=True),
                stop == len(rows) and not closed and not _smooth(loop, one, a, before=False),
            )
        )  # fmt: skip
    return np.concatenate(parts), arcs


def _smooth(loop: Any, one: Stretch, a: float, *, before: bool) -> bool:
    """Return whether the centre's curve goes on smoothly beyond an end of a stretch: around a reflex corner."""
    node = one.panels[0] if before else (one.panels[-1] + 1) % len(loop.rows)
    return bool(a > 0 and loop.jump[node] < 0)


def _nodes(rows: Array, w: Array, a: float) -> tuple[Array, Array]:
    """Return places and unit tangents (N, 2) of the parallel curve at w (N)."""
    f, f1, _f2 = graphs(rows, w)
    q = 1 / np.sqrt(1 + f1 * f1)
    t = plane_of(rows, q, f1 * q)
    return rows[:, OX : OX + 2] + plane_of(rows, rows[:, HALF] * (1 + w), f) + a * left_of(t), t


def _bounds(rows: Array, a: float) -> None:
    """Write the ends of the parallel curve in the chord's frame, and bounds of its graph, slope and second derivative."""
    low, high = rows[:, W0], rows[:, W1]
    values = []
    for share in np.linspace(0.0, 1.0, 33):
        w = low + (high - low) * share
        f, f1, f2 = graphs(rows, w)
        q = 1 / np.sqrt(1 + f1 * f1)
        bend = f2 / np.maximum(1 - a * f2 * q**3, 1e-14)
        values.append((rows[:, HALF] * (1 + w) - a * f1 * q, f + a * q, np.abs(f1), np.abs(bend)))
    xi, eta, slope, bend = (np.array(one) for one in zip(*values, strict=True))
    rows[:, FIRST_XI], rows[:, LAST_XI] = xi[0], xi[-1]
    # f is smooth on the scale of a panel: between 33 places it exceeds them by less than a thousandth of its range
    margin = 2e-3 * np.ptp(eta, axis=0) + 1e-15
    rows[:, LOW], rows[:, HIGH] = eta.min(0) - margin, eta.max(0) + margin
    rows[:, SLOPE], rows[:, BEND] = 1.01 * slope.max(0), 1.1 * bend.max(0)
