"""Stretches of a curved wall that a ball can touch: runs of panels, and circles around reflex corners, joined at corners.

A ball that is larger than a radius of curvature, or than a neck, does not touch all of the wall: the parallel curve crosses itself,
and what lies beyond the crossing is nearer than the radius to another part of the wall. The crossings P(t1) = P(t2) are corners.
They are seen by the distance of a sample of the parallel curve from the wall, and found by Newton's method. Where one stretch ends
another one begins in the same place: at a neck on the wall's other side, so that the ball keeps to a part of the table.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from carom.billiards.curved_wall import CurvedWall, graphs, plane_of
from carom.core.geometry.curve import HALF, OX
from carom.errors import CaromError, Fault

__all__ = ["Bend", "Stretch", "no_room", "touched"]

Array = NDArray[np.float64]
Index = NDArray[np.int64]
SAMPLES = 24  # of each panel, at which the distance from the wall is asked
TOUCHES = 1e-9  # of the size: so much less than the radius is rounding
SHARP = 1e-9  # of the smallest radius of curvature: so much larger a ball must be smaller
NEAR = 1e-4  # of the size: so near to each other are two sides of a crossing, before Newton's method
NEWTON = 40
HALVES = 40


class Stretch(NamedTuple):
    """Panels of the wall that a ball touches, one after the other, without a corner in between."""

    loop: int
    panels: list[int]
    begin: float
    """w in the first panel."""
    end: float
    """w in the last one."""


class Bend(NamedTuple):
    """Part of the circle on which the centre passes a corner of the wall with the interior all around."""

    x: float
    y: float
    first: float
    """Angle at which it begins, rad; it goes clockwise."""
    span: float


class WallPlace(NamedTuple):
    """A place on the parallel curve."""

    element: int
    w: float


@dataclass(frozen=True, eq=False)
class ParallelCurve:
    """The centres of balls that touch the wall here and there: its panels, and circles around its reflex corners, in order."""

    wall: CurvedWall
    a: float
    loop: Index
    panel: Index
    """Number of the panel in its loop; -1 for a circle."""
    circle: Array
    """(E, 4): of a circle as in :class:`Bend`."""
    before: Index
    after: Index
    corner: NDArray[np.bool_]
    """Whether the wall has a corner at the beginning of a panel."""

    def at(self, k: Index, w: Array) -> tuple[Array, Array]:
        """Return places (N, 2) of elements (N) at w (N), and their rates by w (N, 2)."""
        x, rate = np.empty((len(k), 2)), np.empty((len(k), 2))
        for number, loop in enumerate(self.wall.loops):
            here = (self.loop[k] == number) & (self.panel[k] >= 0)
            rows = loop.rows[self.panel[k[here]]]
            f, f1, f2 = graphs(rows, w[here])
            q, h = 1 / np.sqrt(1 + f1 * f1), rows[:, HALF]
            speed = h * (1 - self.a * f2 * q**3)
            x[here] = rows[:, OX : OX + 2] + plane_of(rows, h * (1 + w[here]) - self.a * f1 * q, f + self.a * q)
            rate[here] = plane_of(rows, speed, speed * f1)
        here = self.panel[k] < 0
        cx, cy, first, span = self.circle[k[here]].T
        angle = first - span * (1 + w[here]) / 2
        u = np.stack([np.cos(angle), np.sin(angle)], axis=-1)
        x[here] = np.stack([cx, cy], axis=-1) + self.a * u
        rate[here] = (self.a * span / 2)[:, None] * np.stack([u[:, 1], -u[:, 0]], axis=-1)
        return x, rate

    def moved(self, place: WallPlace, step: float) -> WallPlace:
        """Return a place that is so far further along, over the next element's beginning; no further than a corner of the wall."""
        k, w = place.element, place.w + step
        while abs(w) > 1.0:
            way = 1 if w > 1.0 else -1
            new = int(self.after[k] if way > 0 else self.before[k])
            if self.corner[new if way > 0 else k]:
                return WallPlace(k, float(way))
            beyond = (abs(w) - 1.0) * self._speed(k) / self._speed(new)
            k, w = new, -way + way * min(beyond, 2.0)
        return WallPlace(k, w)

    def _speed(self, k: int) -> float:
        if self.panel[k] < 0:
            return float(self.a * self.circle[k, 3] / 2)
        return float(self.wall.loops[self.loop[k]].rows[self.panel[k], HALF])

    def parts(self, begin: WallPlace, end: WallPlace, *, whole: bool = False) -> list[Stretch | Bend]:
        """Return the wall between two places, divided at corners of the wall; ``whole``: all around."""
        found: list[Stretch | Bend] = []
        k, low, panels, first = begin.element, begin.w, list[int](), -1.0
        while True:
            last = k == end.element and not whole and end.w >= low
            high = end.w if last else 1.0
            if self.panel[k] < 0:
                x, y, angle, span = self.circle[k].tolist()
                found.append(Bend(x, y, angle - span * (1 + low) / 2, span * (high - low) / 2))
            else:
                first = first if panels else low
                panels.append(int(self.panel[k]))
            new = int(self.after[k])
            stops = last or (whole and new == begin.element)
            if panels and (stops or self.panel[new] < 0 or self.corner[new]):
                found.append(Stretch(int(self.loop[k]), panels, first, high))
                panels = []
            if stops:
                return found
            k, low = new, -1.0


def _parallel(wall: CurvedWall, a: float) -> ParallelCurve:
    """Return the parallel curve of all of a wall."""
    rows, before, after = list[tuple[float, ...]](), list[int](), list[int]()
    for number, loop in enumerate(wall.loops):
        first = len(rows)
        for k, jump in enumerate(loop.jump.tolist()):
            if a > 0 and jump < 0:
                (x, y), (tx, ty) = loop.rows[k, OX : OX + 2], loop.begin[k]
                rows.append((number, -1, x, y, math.atan2(tx, -ty) - jump, -jump, False))
            rows.append((number, k, 0.0, 0.0, 0.0, 0.0, jump > 0 or (a == 0 and jump != 0)))
        here = np.arange(first, len(rows))
        before += np.roll(here, 1).tolist()
        after += np.roll(here, -1).tolist()
    table = np.array(rows)
    owner, panel = table[:, 0].astype(np.int64), table[:, 1].astype(np.int64)
    return ParallelCurve(wall, a, owner, panel, table[:, 2:6], np.array(before), np.array(after), table[:, 6] > 0)


def touched(wall: CurvedWall, a: float) -> list[list[Stretch | Bend]]:
    """Return the closed curves that bound the centres of balls of radius a, each as its parts in order.

    CaromError where there are none, and where the radius is within rounding of a radius of curvature.
    """
    curve = _parallel(wall, a)
    hidden = [a > 0.0 and _hides(wall, number, a) for number in range(len(wall.loops))]
    if not any(hidden):
        return [_all_around(curve, number) for number in range(len(wall.loops))]
    return _trimmed(curve)


def _all_around(curve: ParallelCurve, number: int) -> list[Stretch | Bend]:
    """Return all of a loop, from its first corner on."""
    here = np.flatnonzero(curve.loop == number)
    breaks = here[curve.corner[here] | (curve.panel[here] < 0)]
    # (after a circle, so that the loop ends with it)
    first = int(here[0] if not len(breaks) else breaks[0])
    first = int(curve.after[first]) if curve.panel[first] < 0 else first
    return curve.parts(WallPlace(first, -1.0), WallPlace(first, -1.0), whole=True)


def _sample(curve: ParallelCurve) -> tuple[Array, NDArray[np.bool_]]:
    """Return w (S) of samples of each element, and whether a ball touches it there (E, S)."""
    w = (2 * np.arange(SAMPLES) + 1) / SAMPLES - 1
    near = 1 - np.power(10.0, -np.arange(2, 8))  # (near a corner the part that a small ball does not touch is short)
    w = np.concatenate([[-1.0], -near[::-1], w, near, [1.0]])
    count = len(curve.loop)
    return w, _touches(curve, np.repeat(np.arange(count), len(w)), np.tile(w, count)).reshape(count, len(w))


def _touches(curve: ParallelCurve, k: Index, w: Array) -> NDArray[np.bool_]:
    wall = curve.wall
    found: NDArray[np.bool_] = wall.depth(curve.at(k, w)[0]) >= curve.a - TOUCHES * wall.size
    return found


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
        raise _too_near(wall, a)
    curve = _parallel(wall, a)
    return not bool(_sample(curve)[1][curve.loop == number].all())


def _too_near(wall: CurvedWall, a: float) -> CaromError:
    return CaromError(
        Fault(
            wall.name, "radius of the ball", "one that is not within rounding of the smallest radius of curvature of the wall",
            repr(a), "take a ball that is smaller or larger by a thousandth",
        )
    )  # fmt: skip


def no_room(wall: CurvedWall, a: float) -> CaromError:
    """Return the refusal of a ball that is too large."""
    return CaromError(
        Fault(wall.name, "radius of the ball", "one that fits into the curve", repr(a), "take a smaller ball")
    )


def _trimmed(curve: ParallelCurve) -> list[list[Stretch | Bend]]:
    """Return the closed curves between the crossings of the parallel curve with itself."""
    wall, a = curve.wall, curve.a
    w, sampled = _sample(curve)
    on, count = sampled.ravel(), len(w)
    if on.all():
        # a convex corner, or a swallowtail, that is smaller than the samples tell
        raise _too_near(wall, a)
    if not on.any():
        raise no_room(wall, a)
    sample = np.arange(len(on))
    later = np.where(sample % count == count - 1, curve.after[sample // count] * count, sample + 1)
    ends = sample[on & ~on[later]]
    begins = later[~on & on[later]]
    end_places = _border(curve, w, ends, 1)
    begin_places = _border(curve, w, begins, -1)
    pairs = _pairs(curve, end_places, begin_places)
    found = []
    crossings = [_crossing(curve, end_places[k], begin_places[m]) for k, m in enumerate(pairs)]
    begin_of = {m: crossings[k][1] for k, m in enumerate(pairs)}
    # (samples along each loop, in order; the end of a stretch is the first one from its beginning on)
    left = set(range(len(begins)))
    while left:
        m = min(left)
        parts: list[Stretch | Bend] = []
        while m in left:
            left.remove(m)
            k = _end_from(later, int(begins[m]), ends)
            parts += curve.parts(begin_of[m], crossings[k][0])
            m = pairs[k]
        found.append(parts)
    whole = [number for number in range(len(wall.loops)) if sampled[curve.loop == number].all()]
    return found + [_all_around(curve, number) for number in whole]


def _end_from(later: Index, begin: int, ends: Index) -> int:
    """Return the number of the first end of a stretch from a sample on."""
    numbers = {int(sample): k for k, sample in enumerate(ends)}
    while begin not in numbers:
        begin = int(later[begin])
    return numbers[begin]


def _border(curve: ParallelCurve, w: Array, samples: Index, way: int) -> list[WallPlace]:
    """Return the places from samples on, or before them, up to which the ball touches: by halving."""
    k, i = samples // len(w), samples % len(w)
    beyond = np.clip(i + way, 0, len(w) - 1)
    touching, not_touching = w[i], w[beyond]
    for _ in range(HALVES):
        middle = (touching + not_touching) / 2
        on = _touches(curve, k, middle)
        touching, not_touching = np.where(on, middle, touching), np.where(on, not_touching, middle)
    return [WallPlace(int(one), float(at)) for one, at in zip(k, touching, strict=True)]


def _pairs(curve: ParallelCurve, ends: list[WallPlace], begins: list[WallPlace]) -> list[int]:
    """Return the number of the beginning that lies where each stretch ends."""
    (x, _d), (y, _e) = (curve.at(*(np.array(one) for one in zip(*places, strict=True))) for places in (ends, begins))
    apart = np.linalg.norm(x[:, None] - y, axis=-1)
    found = apart.argmin(axis=1)
    if len(set(found.tolist())) < len(begins) or (apart.min(axis=1) > NEAR * curve.wall.size).any():
        raise _too_near(curve.wall, curve.a)
    return [int(one) for one in found]


def _crossing(curve: ParallelCurve, end: WallPlace, begin: WallPlace) -> tuple[WallPlace, WallPlace]:
    """Return the places of both branches at a crossing, the one that ends there first: Newton's method."""
    wall = curve.wall
    places = [end, begin]
    off, last = math.inf, math.inf
    for _ in range(NEWTON):
        x, d = curve.at(np.array([one.element for one in places]), np.array([one.w for one in places]))
        off = float(np.abs(x[0] - x[1]).max())
        if off < 1e-15 * wall.size or (off < 1e-13 * wall.size and off >= last):
            break
        last = off
        matrix = np.stack([d[0], -d[1]], axis=1)
        if abs(float(np.linalg.det(matrix))) < 1e-12 * wall.size**2 * 1e-6:
            raise _too_near(wall, curve.a)
        step = np.linalg.solve(matrix, x[1] - x[0])
        step *= min(1.0, 0.5 / float(np.abs(step).max()))
        places = [curve.moved(one, by) for one, by in zip(places, step.tolist(), strict=True)]
    if not off < 1e-12 * wall.size:
        raise _too_near(wall, curve.a)
    return places[0], places[1]
