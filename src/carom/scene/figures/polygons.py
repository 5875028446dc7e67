"""Polygons: by their points, regular ones, rectangles; faults of outlines, and depths in polygons and ellipses."""

from __future__ import annotations

import functools
import math
from collections.abc import Callable, Sequence
from typing import Annotated, Any, ClassVar, Literal

import numpy as np
from numpy.typing import NDArray
from pydantic import BeforeValidator, model_validator

from carom.errors import Fault
from carom.scene.figures.figure import Loop, Piece, PlaneFigure, SegmentPiece, Sizes2
from carom.scene.schema import Components, Place, Size, Whole, raise_faults, refused

Sides = Annotated[int, BeforeValidator(Whole("a whole number from 3 to 10000", 3))]


def sides_through(points: Sequence[tuple[float, float]]) -> list[Loop]:
    """Return the loop of straight sides through points, and back to the first one."""
    return [[SegmentPiece(one, two) for one, two in zip(points, (*points[1:], points[0]), strict=True)]]


class PolygonFigure(PlaneFigure):
    """A polygon; it need not be convex, but must not meet itself.

    Parameters
    ----------
    points : 3 or more times 2 lengths, m: its corners in order
    """

    shape: Literal["polygon"] = "polygon"
    points: Annotated[tuple[Place, ...], BeforeValidator(Components("3 or more points (x, y)", range(3, 1_000_000)))]

    @model_validator(mode="after")
    def _simple(self) -> PolygonFigure:
        raise_faults(Fault("", "points", expected, got) for expected, got in outline_faults(np.array(self.points)))
        return self

    @property
    def clockwise(self) -> bool:
        """Whether the points go clockwise."""
        x, y = np.transpose(np.subtract(self.points, self.points[0]))
        return bool(np.sum(x * np.roll(y, -1) - y * np.roll(x, -1)) < 0)

    def outline(self) -> list[Loop]:
        """Return its sides, counterclockwise, in the order of the points; backwards where these go clockwise."""
        return sides_through(self.points[::-1] if self.clockwise else self.points)

    def piece_names(self) -> list[str]:
        """Return the names of the sides: edge1 goes from the first point to the second, whichever way round they are given."""
        count, back = len(self.points), self.clockwise
        return [f"edge{(count - 2 - k) % count + 1 if back else k + 1}" for k in range(count)]


class RegularFigure(PlaneFigure):
    """A regular polygon about the origin; its lowest side is horizontal.

    Parameters
    ----------
    sides : number of sides, at most 10,000
    radius : m: of the circle through its corners
    """

    usual: ClassVar = {"sides": 3, "radius": 1.0}
    shape: Literal["regular"] = "regular"
    sides: Sides
    radius: Size

    @model_validator(mode="after")
    def _few(self) -> RegularFigure:
        if self.sides > 10_000:
            raise_faults([Fault("", "sides", "a whole number from 3 to 10000", str(self.sides))])
        return self

    def outline(self) -> list[Loop]:
        """Return its sides."""
        angle = -math.pi / 2 + math.pi / self.sides * (2 * np.arange(self.sides) - 1)
        corners = self.radius * np.stack([np.cos(angle), np.sin(angle)], axis=-1)
        return sides_through([(float(x), float(y)) for x, y in corners])


class RectangleFigure(PlaneFigure):
    """A rectangle about the origin.

    Parameters
    ----------
    size : 2 lengths, m: along x, along y
    """

    usual: ClassVar = {"size": (2.0, 1.0)}
    shape: Literal["rectangle"] = "rectangle"
    size: Sizes2

    def outline(self) -> list[Loop]:
        """Return its sides, the lower one first."""
        x, y = self.size[0] / 2, self.size[1] / 2
        return sides_through([(-x, -y), (x, -y), (x, y), (-x, y)])

    def piece_names(self) -> list[str]:
        """Return the names of the sides."""
        return ["front", "right", "back", "left"]


# ----------------------------------------------------------------------------------------------------
# Tokarsky's room, in which a candle leaves a point dark.


# In squares of a grid, from the left; the interior on the left. As N. Berglund draws the room
# (https://github.com/nilsberglund-orleans/YouTube-simulations).
CORNERS = (
    (0, 2), (1, 2), (1, 1), (2, 1), (2, 0), (3, 1), (4, 1), (4, 0), (5, 1), (6, 1), (6, 0), (7, 1), (7, 2), (8, 2), (8, 3), (7, 3),
    (6, 4), (6, 3), (5, 3), (5, 2), (3, 2), (3, 3), (2, 3), (2, 4), (1, 4), (1, 3),
)  # fmt: skip


class TokarskyFigure(PlaneFigure):
    """Tokarsky's room of 26 sides: no flight with mirror reflections leads from one of two places in it to the other.

    All walls lie on mirrors of the tiling of the plane by triangles of 45, 45 and 90 degrees: x, y, x + y or x - y is a
    whole number of squares, of the latter two an even one. So reflections take places with two even coordinates to such places.
    A straight line from one of them to another passes a grid point with an odd coordinate first, half-way or before; and
    all grid points of the room with an odd coordinate are corners of it, where a flight ends.

    Source: G. W. Tokarsky, Am. Math. Monthly 102, 867 (1995), https://doi.org/10.2307/2975263.

    Parameters
    ----------
    side : m: of the squares of the grid on which its corners lie; the room is 8 of them long
    """

    usual: ClassVar = {"side": 0.25}
    shape: Literal["tokarsky"] = "tokarsky"
    side: Size

    def outline(self) -> list[Loop]:
        """Return its sides."""
        return sides_through([self._place(*one) for one in CORNERS])

    @property
    def dark_pair(self) -> tuple[Place, Place]:
        """The two places, m, of which one is dark when a candle is in the other."""
        return self._place(2, 2), self._place(6, 2)

    def _place(self, x: float, y: float) -> Place:
        return self.side * (x - 4), self.side * (y - 2)


# ----------------------------------------------------------------------------------------------------
# A figure by its pieces, for programs.


def _loops(value: Any) -> tuple[tuple[Piece, ...], ...]:
    try:
        found = tuple(tuple(loop) for loop in value)
    except TypeError:
        found = ()
    if not found or not all(loop and all(isinstance(piece, Piece) for piece in loop) for loop in found):
        raise refused("loops of pieces, each a list of Piece", f"{value!r:.60}")
    return found


class OutlineFigure(PlaneFigure):
    """A figure by its pieces: closed loops, each piece with the open side on its left.

    Parameters
    ----------
    loops : lists of Piece: the outside, counterclockwise, and obstacles in it, clockwise

    Examples
    --------
    >>> from carom import billiards
    >>> from carom.scene.figures import ArcPiece, OutlineFigure, SegmentPiece
    >>> half = OutlineFigure(loops=[[ArcPiece((0, 0), 1.0, 0.0, 180.0), SegmentPiece((-1, 0), (1, 0))]])
    >>> round(half.area, 6), round(float(billiards.table(half).wall().lengths.sum()), 6)
    (1.570796, 5.141593)
    """

    tag: ClassVar[str] = ""
    loops: Annotated[tuple[tuple[Any, ...], ...], BeforeValidator(_loops)]

    @classmethod
    def kind(cls) -> str:
        """Return its name in messages."""
        return "outline"

    def phrases(self) -> list[str]:
        """Return the number of its pieces."""
        return [f"{sum(map(len, self.loops))} pieces"]

    def outline(self) -> list[Loop]:
        """Return its pieces."""
        return [list(loop) for loop in self.loops]


# ----------------------------------------------------------------------------------------------------
# Polygons and ellipses as outlines: depth of points inside, validation. For many points at once, with NumPy.

Array = NDArray[np.float64]
NEAR = 1e-9  # of a polygon's longest side: what lies so close is in one place
MOST = 8  # problems of an outline that are reported


def polygon_depth(vertices: Array, x: Array) -> Array:
    """Distance (...) of points x (..., 2 or more) to a polygon with vertices (N, 2) in order: positive inside, else negative."""
    found = np.empty(x.shape[:-1])
    _compiled_depths()(
        np.ascontiguousarray(vertices, float), np.array(x[..., :2].reshape(-1, 2), float), found.reshape(-1)
    )
    return found


@functools.cache
def _compiled_depths() -> Callable[..., None]:
    from carom.core.jit.compile import njit

    return njit(_depths, nogil=True)


def _depths(vertices: Any, x: Any, depth: Any) -> None:
    """Write the distance of each point x (M, 2) into depth (M,)."""
    for k in range(x.shape[0]):
        nearest, inside = math.inf, False
        px, py = vertices[-1, 0], vertices[-1, 1]
        for n in range(vertices.shape[0]):
            qx, qy = vertices[n, 0], vertices[n, 1]
            rx, ry, ex, ey = x[k, 0] - px, x[k, 1] - py, qx - px, qy - py
            u = min(max((rx * ex + ry * ey) / (ex * ex + ey * ey), 0.0), 1.0)
            nearest = min(nearest, (rx - u * ex) * (rx - u * ex) + (ry - u * ey) * (ry - u * ey))
            # sides cut by the level line to the right of the point
            if (py > x[k, 1]) != (qy > x[k, 1]) and x[k, 0] < px + ry * ex / ey:
                inside = not inside
            px, py = qx, qy
        depth[k] = math.sqrt(nearest) if inside else -math.sqrt(nearest)


def outline_faults(corners: Array) -> list[tuple[str, str]]:
    """Faults of points (N, 2), N >= 3, as the corners of a polygon in order: pairs of expectation and finding.

    Corners in one place, sides that run back along the one before (a slit or a spike of no width), that lie on each other, that
    cross, corners on other sides. What is closer than 1e-9 of the longest side is in one place. Corners are counted from 1; where
    there are many, the first are reported.
    """
    every = np.linalg.norm(np.roll(corners, -1, axis=0) - corners, axis=1)
    near = NEAR * float(every.max())
    # one of corners that follow each other in one place is enough for all that comes after
    keep = np.flatnonzero(np.roll(every, 1) > near)
    found = [
        (
            "each corner once",
            f"corners {_which(k, n)} both at {_at(corners[k])}; "
            + ("the last side closes by itself: leave the last corner out" if k == n - 1 else "leave one out"),
        )
        for n in [len(corners)]
        for k in np.flatnonzero(every <= near).tolist()
    ]
    p = corners[keep]
    if len(p) < 3 or np.linalg.svd(p - p[0], compute_uv=False)[-1] <= near:
        return [*found[:MOST], ("corners around some area", "corners that are all on one line")]
    found += _meetings(p, keep, near)
    more = len(found) - MOST
    return found if more <= 0 else [*found[:MOST], ("an outline without faults", f"{more} more of these")]


def _at(x: Array) -> str:
    return f"({x[0]:.6g}, {x[1]:.6g})"


def _which(k: int, n: int) -> str:
    """A corner and the next one."""
    return f"{k + 1} and {(k + 1) % n + 1}" if k < n - 1 else f"1 and {n}"


def _meetings(p: Array, number: NDArray[np.int64], near: float) -> list[tuple[str, str]]:
    """Where sides of an outline p (N, 2) meet that should not; ``number`` (N) says which corner each was."""
    n = len(p)
    q, after = np.roll(p, -1, axis=0), np.roll(np.arange(n), -1)
    d = q - p
    length = np.linalg.norm(d, axis=1)
    t = d / length[:, None]
    name = [f"{number[k] + 1} to {number[after[k]] + 1}" for k in range(n)]
    turn = np.arctan2(t[:, 0] * t[after, 1] - t[:, 1] * t[after, 0], (t * t[after]).sum(1))
    if ((turn > 0).all() or (turn < 0).all()) and np.abs(turn).max() < 3 and abs(turn.sum()) < 7:
        return []  # convex, and once around
    # run back: the side after it lies on it
    back = (t * t[after]).sum(1) < 0
    back &= np.abs(t[:, 0] * d[after, 1] - t[:, 1] * d[after, 0]) <= near
    reported = {(int(k), int(after[k])) for k in np.flatnonzero(back)}
    found = [
        (
            "sides that do not run back along the one before",
            f"the side from corner {name[after[k]]} back along that from {name[k]}: it encloses no width;"
            f" give it one, or leave corner {number[after[k]] + 1} out",
        )
        for k in np.flatnonzero(back).tolist()
    ]
    touches: list[tuple[int, int]] = []
    for i in range(n):
        # of all corners: how far along side i, and how far off its line
        along, off = (p - p[i]) @ t[i], t[i, 0] * (p[:, 1] - p[i, 1]) - t[i, 1] * (p[:, 0] - p[i, 0])
        on = (np.abs(off) <= near) & (along >= -near) & (along <= length[i] + near)
        touches += [(k, i) for k in np.flatnonzero(on).tolist() if k not in (i, after[i])]
        later = np.arange(i + 2, n - (i == 0))
        if not len(later):
            continue
        one, two = along[later], along[after[later]]
        flat = (np.abs(off[later]) <= near) & (np.abs(off[after[later]]) <= near)
        low, high = np.minimum(one, two), np.maximum(one, two)
        for j in later[flat & (np.minimum(high, length[i]) - np.maximum(low, 0) > near)].tolist():
            reported.add((i, j))
            found.append(
                ("sides that do not lie on each other", f"those from corner {name[i]} and from corner {name[j]}")
            )
        # the ends of each well on either side of the other
        x, y = p[i] - p[later], q[i] - p[later]
        left, right = (t[later, 0] * z[:, 1] - t[later, 1] * z[:, 0] for z in (x, y))
        a, b = off[later], off[after[later]]
        for j in np.flatnonzero(
            (np.minimum(a, b) < -near) & (np.maximum(a, b) > near)
            & (np.minimum(left, right) < -near) & (np.maximum(left, right) > near)
        ).tolist():  # fmt: skip
            where = p[later[j]] + (p[after[later[j]]] - p[later[j]]) * (a[j] / (a[j] - b[j]))
            found.append(
                (
                    "sides that do not cross",
                    f"those from corner {name[i]} and from corner {name[later[j]]}, which meet at {_at(where)}",
                )
            )
    for k, i in touches:
        end = next((m for m in (i, int(after[i])) if np.linalg.norm(p[k] - p[m]) <= near), None)
        sides = {i} if end is None else {(end - 1) % n, end}
        if any({(one, two), (two, one)} & reported for one in ((k - 1) % n, k) for two in sides):
            continue  # (it is said above)
        if end is None:
            got = f"corner {number[k] + 1}, {_at(p[k])}, on the side from corner {name[i]}"
        elif k < end == i:  # (each pair once)
            got = f"corners {number[k] + 1} and {number[end] + 1} both at {_at(p[k])}"
        else:
            continue
        found.append(("an outline that does not touch itself", got))
    return found


def ellipse_depth(p: float, q: float, x: Array) -> Array:
    """Distance (...) of points x (..., 2 or more) to the ellipse (p cos u, q sin u): positive inside, else negative.

    The nearest point is (p^2 x/(t + e), q^2 y/t), where (p x/(t + e))^2 + (q y/t)^2 = 1, e = p^2 - q^2, p >= q. The left side falls
    and is convex in t > 0: Newton's steps come from the left and never pass the root.
    """
    (p, u), (q, v) = sorted([(p, np.abs(x[..., 0])), (q, np.abs(x[..., 1]))], key=lambda pair: -pair[0])
    e = (p - q) * (p + q)
    t = np.maximum(q * v, p * u - e)
    with np.errstate(divide="ignore", invalid="ignore"):
        for _ in range(100):
            a, b = p * u / (t + e), q * v / t
            step = 0.5 * (a * a + b * b - 1.0) / (a * a / (t + e) + b * b / t)
            t = t + np.where(t > 0, step, 0.0)
            if not (step > 1e-15 * t).any():
                break
        off_axis = (q * q - t) * np.hypot(u / (t + e), v / t)
        # on the long axis, between the centres of curvature of its ends: two points are nearest
        c = p * u / e if e > 0 else np.zeros_like(u)
        on_axis = q * np.sqrt(np.maximum((1.0 - c) * (1.0 + c), 0.0) + (c * q / p) ** 2)
    found: Array = np.where(t > 0, off_axis, on_axis)
    return found
