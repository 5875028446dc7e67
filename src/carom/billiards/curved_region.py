"""The boundary of the region open to the centre of a ball within a curved wall: arcs of parallel curves, and their corners.

A ball that is larger than a radius of curvature, or than a neck, does not touch all of the wall: the parallel curve crosses itself,
and what lies beyond the crossing is nearer than the radius to another part of the wall. The crossings P(t1) = P(t2) are corners.
They are found by the distance of a sample of the parallel curve from the wall, and by Newton's method.
"""

from __future__ import annotations

import functools
import math
from dataclasses import dataclass
from itertools import pairwise
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from carom.billiards.curved_wall import CurvedWall, chord_frame, graphs, left_of, plane_of
from carom.core.geometry.curve import BEND, CX, FIRST_XI, HALF, HIGH, LAST_XI, LOW, OX, ROW, SLOPE, TX, W0, W1, X
from carom.errors import CaromError, Fault

__all__ = ["CurveArc", "CurvedRegion", "curved_region"]

Array = NDArray[np.float64]
LONGEST_ARC = 2.8  # rad: by so much an arc turns at most, below pi
SAMPLES = 24  # of each panel, at which the distance from the wall is asked
TOUCHES = 1e-9  # of the size: so much less than the radius is rounding
SHARP = 1e-9  # of the smallest radius of curvature: so much larger a ball must be smaller
SAME_NODE = (
    1e-9  # of the size: so near are a node and its tangent to those of the next arc where these are joined smoothly
)
NEWTON = 40
NODES, WEIGHTS = np.polynomial.legendre.leggauss(12)


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


class Stretch(NamedTuple):
    """Panels of the wall that a ball touches, one after the other, without a corner in between."""

    loop: int
    panels: list[int]
    begin: float
    """w in the first panel."""
    end: float
    """w in the last one."""


@dataclass(frozen=True, eq=False)
class CurvedRegion:
    """Arcs in the order of the boundary, and their table (:mod:`carom.core.geometry.curve`) for a ball of radius ``inset``."""

    wall: CurvedWall
    inset: float
    table: Array
    arcs: tuple[CurveArc, ...]
    reflex: tuple[tuple[float, float, float, float], ...]
    """Corners of the wall, with the interior all around, that the centre passes on a circle: x, y, first angle and span."""
    order: tuple[int, ...] | None
    """Order of the arcs and, after them, of these circles; None: by number."""

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
        for node, weight in zip(NODES, WEIGHTS, strict=True):
            total += weight * np.sqrt(1 + graphs(rows, low + half * (1 + node))[1] ** 2)
        turned = np.arctan(graphs(rows, w)[1]) - np.arctan(graphs(rows, low)[1])
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
        nodes = self.table[:, X : TX + 2]
        joined = [
            bool(np.abs(nodes[one.last] - nodes[two.first]).max() < SAME_NODE * max(self.wall.size, 1.0))
            for one, two in zip(self.arcs, (*self.arcs[1:], self.arcs[0]), strict=True)
        ]
        found = np.concatenate([[0], np.cumsum(~np.array(joined[:-1], bool))]).astype(np.int64)
        return np.where(found == found[-1], 0, found) if joined[-1] else found

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
            w = np.clip(w - (self._length_to(row, w) - rest) / rate, low, high)
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
    """Return the region open to the centre of a ball of radius a; CaromError where there is none, or not one piece."""
    wall.require_simple()
    stretches = [one for number in range(len(wall.loops)) for one in _stretches(wall, number, a)]
    table, arcs, shown = [], list[CurveArc](), list[int]()
    circles: list[tuple[float, float, float, float]] = []
    row, number = 0, 0
    for one in stretches:
        part, own = _table_of(wall, one, a, row)
        table.append(part)
        arcs += own
        row += len(part)
        shown += list(range(number, number + len(own)))
        number += len(own)
        reflex = _circle_after(wall, one, a)
        if reflex is not None:
            shown.append(-1 - len(circles))
            circles.append(reflex)
    rows = np.concatenate(table)
    for arc, after in zip(arcs, arcs[1:] + arcs[:1], strict=True):
        # arcs that meet in a corner share it to the last bit, so that nothing passes between them
        if np.abs(rows[arc.last, X : X + 2] - rows[after.first, X : X + 2]).max() < 1e-11 * wall.size:
            rows[arc.last, X : X + 2] = rows[after.first, X : X + 2]
    order = tuple(k if k >= 0 else number - 1 - k for k in shown) if circles else None
    return CurvedRegion(wall, a, rows, tuple(arcs), tuple(circles), order)


def _circle_after(wall: CurvedWall, one: Stretch, a: float) -> tuple[float, float, float, float] | None:
    """Return the circle around the reflex corner after a stretch: place, angle where it begins, span; None where there is none."""
    loop = wall.loops[one.loop]
    after = (one.panels[-1] + 1) % len(loop.rows)
    if a == 0 or one.end != 1.0 or loop.jump[after] >= 0:
        return None
    x, y = loop.rows[after, OX : OX + 2]
    tx, ty = loop.begin[after]
    span = -float(loop.jump[after])
    return float(x), float(y), math.atan2(tx, -ty) + span, span


def _stretches(wall: CurvedWall, number: int, a: float) -> list[Stretch]:
    """Return the stretches of a loop that a ball touches, in order."""
    loop = wall.loops[number]
    count = len(loop.rows)
    corners = np.flatnonzero(loop.jump != 0.0)
    if a == 0.0 or not _hides(wall, number, a):
        if not len(corners):
            return [Stretch(number, list(range(count)), -1.0, 1.0)]
        ends = [*corners.tolist(), int(corners[0]) + count]
        return [Stretch(number, [k % count for k in range(first, last)], -1.0, 1.0) for first, last in pairwise(ends)]
    return _trimmed(wall, number, a)


def _sampled(wall: CurvedWall, number: int, a: float) -> tuple[Array, NDArray[np.bool_]]:
    """Return w (S) of samples of each panel, and whether a ball of radius a touches it there (P, S)."""
    loop = wall.loops[number]
    w = (2 * np.arange(SAMPLES) + 1) / SAMPLES - 1
    near = 1 - np.power(10.0, -np.arange(2, 8))  # (near a corner the part that a small ball does not touch is short)
    w = np.concatenate([-near[::-1], w, near])
    panel = np.repeat(np.arange(len(loop.rows)), len(w))
    x = _centres(wall, number, a, panel, np.tile(w, len(loop.rows)))[0]
    touches = wall.depth(x) >= a - TOUCHES * wall.size
    return w, touches.reshape(-1, len(w))


def _sharpest(wall: CurvedWall, number: int) -> float:
    """Return the smallest radius of curvature of a loop's wall where it bends towards the ball; infinity where it does not."""
    loop = wall.loops[number]
    w = np.linspace(-1, 1, 33)
    rows = np.repeat(loop.rows, len(w), axis=0)
    _f, f1, f2 = graphs(rows, np.tile(w, len(loop.rows)))
    most = float((f2 / (1 + f1 * f1) ** 1.5).max())
    return 1 / most if most > 0 else math.inf


def _hides(wall: CurvedWall, number: int, a: float) -> bool:
    """Return whether a ball of radius a cannot touch all of a loop."""
    if bool((wall.loops[number].jump > 0).any()) or a > _sharpest(wall, number):
        return True
    if a > (1 - SHARP) * _sharpest(wall, number):
        raise CaromError(_too_near(wall, a))
    return not bool(_sampled(wall, number, a)[1].all())


def _too_near(wall: CurvedWall, a: float) -> Fault:
    return Fault(
        wall.name, "radius of the ball", "one that is not within rounding of the smallest radius of curvature of the wall", repr(a),
        "take a ball that is smaller or larger by a thousandth",
    )  # fmt: skip


def _trimmed(wall: CurvedWall, number: int, a: float) -> list[Stretch]:
    """Return the stretches between the crossings of the parallel curve with itself."""
    loop = wall.loops[number]
    w, touches = _sampled(wall, number, a)
    on = touches.ravel()
    if on.all():
        # a convex corner, or a swallowtail, that is smaller than the samples tell
        raise CaromError(_too_near(wall, a))
    if not on.any():
        raise CaromError(
            Fault(wall.name, "radius of the ball", "one that fits into the curve", repr(a), "take a smaller ball")
        )
    ends = np.flatnonzero(on & ~np.roll(on, -1))
    begins = np.array([next((e + k) % len(on) for k in range(1, len(on) + 1) if on[(e + k) % len(on)]) for e in ends])
    x = _centres(wall, number, a, *_parameters(loop, w, np.concatenate([ends, begins])))[0]
    step = np.linalg.norm(x[: len(ends)] - x[len(ends) :], axis=-1)
    spacing = 8 * a / SAMPLES + 16 * float(loop.rows[:, HALF].max()) / SAMPLES
    if (step > spacing).any():
        raise CaromError(
            Fault(
                wall.name, "radius of the ball", "one that passes everywhere in the table", f"{a!r}, to which a neck is closed",
                "take a smaller ball, or a table of one of the parts",
            )
        )  # fmt: skip
    found = _crossings(wall, number, a, w, ends, begins)
    stretches = []
    for k in range(len(ends)):
        # from where crossing k begins the next stretch to where the next one ends it
        (panel0, w0), (panel1, w1) = found[k][1], found[(k + 1) % len(ends)][0]
        count = (panel1 - panel0) % len(loop.rows) + 1
        if count == 1 and w1 < w0:
            count += len(loop.rows)
        stretches.append(Stretch(number, [(panel0 + m) % len(loop.rows) for m in range(count)], w0, w1))
    return [part for one in stretches for part in _at_reflex(loop.jump, one)]


def _at_reflex(jump: Array, one: Stretch) -> list[Stretch]:
    """Return a stretch divided at the reflex corners within it."""
    cuts = [0, *(m for m in range(1, len(one.panels)) if jump[one.panels[m]] != 0.0), len(one.panels)]
    return [
        Stretch(
            one.loop, one.panels[first:last], one.begin if first == 0 else -1.0, one.end if last == len(one.panels) else 1.0
        )
        for first, last in pairwise(cuts)
    ]  # fmt: skip


def _parameters(loop: Any, w: Array, samples: NDArray[np.int64]) -> tuple[NDArray[np.int64], Array]:
    return samples // len(w), w[samples % len(w)]


def _centres(wall: CurvedWall, number: int, a: float, panel: Any, w: Any) -> tuple[Array, Array]:
    """Return centres (N, 2) of balls that touch panels at w, and their rates by w (N, 2)."""
    rows = wall.loops[number].rows[panel]
    f, f1, f2 = graphs(rows, w)
    q = 1 / np.sqrt(1 + f1 * f1)
    rate = rows[:, HALF] * (1 - a * f2 * q**3)
    x = rows[:, OX : OX + 2] + plane_of(rows, rows[:, HALF] * (1 + w) - a * f1 * q, f + a * q)
    return x, plane_of(rows, rate, rate * f1)


def _crossings(
    wall: CurvedWall, number: int, a: float, w: Array, ends: NDArray[np.int64], begins: NDArray[np.int64]
) -> list[tuple[tuple[int, float], tuple[int, float]]]:
    """Return panel and w of both branches at each crossing, the one that ends there first: Newton from the samples."""
    loop = wall.loops[number]
    count = len(loop.rows)
    found = []
    for end, begin in zip(ends.tolist(), begins.tolist(), strict=True):
        place = [[end // len(w), w[end % len(w)]], [begin // len(w), w[begin % len(w)]]]
        off, last = np.inf, np.inf
        for _ in range(NEWTON):
            panel, at = np.array([one[0] for one in place]), np.array([one[1] for one in place])
            x, d = _centres(wall, number, a, panel, at)
            off = float(np.abs(x[0] - x[1]).max())
            if off < 1e-15 * wall.size or (off < 1e-13 * wall.size and off >= last):
                break
            last = off
            matrix = np.stack([d[0], -d[1]], axis=1)
            determinant = float(np.linalg.det(matrix))
            if abs(determinant) < 1e-12 * wall.size**2 * 1e-6:
                raise CaromError(_too_near(wall, a))
            step = np.linalg.solve(matrix, x[1] - x[0])
            step *= min(1.0, 0.5 / float(np.abs(step).max()))
            for one, by in zip(place, step.tolist(), strict=True):
                one[1] += by
                while abs(one[1]) > 1.0:
                    _cross_node(loop, one, count, wall, a)
        if not off < 1e-12 * wall.size:
            raise CaromError(_too_near(wall, a))
        found.append(((place[0][0], place[0][1]), (place[1][0], place[1][1])))
    return found


def _cross_node(loop: Any, place: list[Any], count: int, wall: CurvedWall, a: float) -> None:
    """Move a place that has left its panel into the next one; no further than a corner of the wall."""
    way = 1 if place[1] > 1.0 else -1
    node = (place[0] + (way > 0)) % count
    if loop.jump[node] != 0.0:
        place[1] = float(way)
        return
    new = (place[0] + way) % count
    beyond = (abs(place[1]) - 1.0) * loop.rows[place[0], HALF] / loop.rows[new, HALF]
    place[0], place[1] = new, -way + way * min(beyond, 2.0)


def _table_of(wall: CurvedWall, one: Stretch, a: float, base: int) -> tuple[Array, list[CurveArc]]:
    """Return the rows of a stretch, divided into arcs, and these; ``base``: the number of its first row in the table."""
    loop = wall.loops[one.loop]
    rows = loop.rows[one.panels].copy()
    rows[0, W0], rows[-1, W1] = one.begin, one.end
    low, high = rows[:, W0], rows[:, W1]
    begins, tangents = _nodes(rows, low, a)
    last, last_tangent = _nodes(rows[-1:], high[-1:], a)
    # the last node of a closed curve without a corner is its first one
    count = len(loop.rows)
    closed = (
        one.begin == -1.0
        and one.end == 1.0
        and (one.panels[-1] + 1) % count == one.panels[0]
        and loop.jump[one.panels[0]] == 0
    )
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
    return bool(a > 0 and (one.begin == -1.0 if before else one.end == 1.0) and loop.jump[node] < 0)


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
