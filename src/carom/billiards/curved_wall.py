"""A wall of smooth pieces: its panels, its corners, the distance of points from it.

Loops of pieces with the open side on the left; a corner is where the tangent jumps by more than CORNER_TURN.
"""

from __future__ import annotations

import functools
import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from carom.core.geometry.curve import COEFFICIENTS, CX, DEGREE, HALF, OX
from carom.core.geometry.panels import cut_into_panels
from carom.core.geometry.polygon import outline_faults
from carom.errors import CaromError, Fault
from carom.scene.figures import Piece

__all__ = ["CurvedWall", "WallLoop", "chord_frame", "graphs", "left_of", "plane_of", "slopes"]

Array = NDArray[np.float64]
CORNER_TURN = 1e-7  # rad
OPEN = 1e-9  # of the size: so far may the end of a piece be from the beginning of the next one
SAMPLES = 4  # of each panel, from which the nearest one is found
ROWS_AT_ONCE = 2_000  # (what they need fits into the processor's cache)
NEWTON = 16
RESTS = 1e-12  # a step in w that leaves less than rounding of a distance


class WallLoop(NamedTuple):
    """The panels of one closed loop, in order; all arrays have one entry per panel."""

    rows: Array
    """(P, ROW)."""
    piece: NDArray[np.int64]
    """Index of the piece of the wall."""
    t: Array
    """(P, 2): parameters of the piece at its ends."""
    sign: NDArray[np.int64]
    """Of the curvature."""
    turn: Array
    """Angle by which the tangent turns, rad."""
    begin: Array
    """(P, 2): unit tangent at the beginning."""
    jump: Array
    """Angle by which the tangent jumps at the beginning, rad; 0 where it does not."""


def left_of(t: Array) -> Array:
    """Return vectors (..., 2) turned by a right angle to the left."""
    return np.stack([-t[..., 1], t[..., 0]], axis=-1)


def graphs(rows: Array, w: Array) -> tuple[Array, Array, Array]:
    """Return f, f' and f'' (N) of panels, rows (N, ROW), at w (N)."""
    f, f1, f2 = (np.zeros(len(rows)) for _ in range(3))
    for k in range(DEGREE, -1, -1):
        c = rows[:, COEFFICIENTS + k]
        f = f * w + c
        f1 = f1 * w + k * c if k > 0 else f1
        f2 = f2 * w + k * (k - 1) * c if k > 1 else f2
    return f, f1 / rows[:, HALF], f2 / rows[:, HALF] ** 2


def slopes(rows: Array, w: Array) -> Array:
    """Return f' (..., N) of panels, rows (N, ROW), at w (..., N), with the bits of :func:`graphs`."""
    f1 = np.zeros_like(w)
    for k in range(DEGREE, 0, -1):
        f1 = f1 * w + k * rows[:, COEFFICIENTS + k]
    found: Array = f1 / rows[:, HALF]
    return found


def chord_frame(rows: Array, x: Array) -> tuple[Array, Array]:
    """Return xi and eta (N) of points (N, 2) over the chords of panels."""
    d, e = x - rows[:, OX : OX + 2], rows[:, CX : CX + 2]
    return (d * e).sum(-1), e[:, 0] * d[:, 1] - e[:, 1] * d[:, 0]


def plane_of(rows: Array, xi: Array, eta: Array) -> Array:
    """Return vectors (N, 2) of the plane from their components along the chords of panels and across them."""
    e = rows[:, CX : CX + 2]
    return xi[:, None] * e + eta[:, None] * left_of(e)


@dataclass(frozen=True, eq=False)
class CurvedWall:
    """Closed loops of pieces; the first is the outside. CaromError where they are no boundary."""

    name: str
    outline: tuple[tuple[Piece, ...], ...]

    @functools.cached_property
    def size(self) -> float:
        """Half the diagonal of its box, or its largest coordinate, m."""
        x = np.concatenate([piece.at(np.linspace(*piece.span(), 257))[0] for loop in self.outline for piece in loop])
        if not np.isfinite(x).all():
            raise CaromError(Fault(self.name, "outline", "finite places", "some that are none"))
        size = float(np.linalg.norm(np.ptp(x, axis=0)) / 2)
        if not size > 0:
            raise CaromError(Fault(self.name, "outline", "a curve of a length above 0", "one point"))
        return max(size, float(np.abs(x).max()))

    @functools.cached_property
    def loops(self) -> tuple[WallLoop, ...]:
        """Its loops, cut into panels."""
        found, first = [], 0
        for pieces in self.outline:
            found.append(self._loop(pieces, first))
            first += len(pieces)
        return tuple(found)

    @functools.cached_property
    def pieces(self) -> tuple[Piece, ...]:
        """Its pieces, of all loops."""
        return tuple(piece for loop in self.outline for piece in loop)

    def _loop(self, pieces: Sequence[Piece], first: int) -> WallLoop:
        size, parts, ends = self.size, [], []
        for number, piece in enumerate(pieces):
            t0, t1 = piece.span()
            try:
                panels = cut_into_panels(piece.at, t0, t1, size, getattr(piece, "cuts", None))
            except ValueError as error:
                at = piece.at(np.array([error.args[0]]))[0][0]
                raise CaromError(
                    Fault(
                        self.name,
                        "curve",
                        "a curve with a continuous tangent and curvature between its corners",
                        f"one that has none near ({at[0]:.6g}, {at[1]:.6g})",
                        "divide it into pieces there",
                    )
                ) from None
            parts.append((panels, np.full(len(panels.rows), first + number)))
            ends.append(piece.at(np.array([t0, t1])))
        for (x, _d, _dd), (y, _e, _ee) in zip(ends, ends[1:] + ends[:1], strict=True):
            if np.abs(x[1] - y[0]).max() > OPEN * size:
                raise CaromError(
                    Fault(
                        self.name, "outline", "a closed curve", f"one from ({y[0, 0]:.6g}, {y[0, 1]:.6g}) that ends at"
                        f" ({x[1, 0]:.6g}, {x[1, 1]:.6g})", "its last place is its first one",
                    )
                )  # fmt: skip
        rows, t, sign, turn = (
            np.concatenate([getattr(one, name) for one, _k in parts]) for name in ("rows", "t", "sign", "turn")
        )
        owner = np.concatenate([k for _one, k in parts])
        begin = self._tangents(owner, t[:, 0], pieces, first)
        end = np.roll(self._tangents(owner, t[:, 1], pieces, first), 1, axis=0)
        jump = np.arctan2(end[:, 0] * begin[:, 1] - end[:, 1] * begin[:, 0], (end * begin).sum(-1))
        jump[np.abs(jump) < CORNER_TURN] = 0.0
        if (np.abs(jump) > math.pi - 1e-6).any():
            at = rows[np.argmax(np.abs(jump)), OX : OX + 2]
            raise CaromError(Fault(self.name, "outline", "no cusp", f"one at ({at[0]:.6g}, {at[1]:.6g})"))
        return WallLoop(rows, owner, t, sign, turn, begin, jump)

    @staticmethod
    def _tangents(number: NDArray[np.int64], t: Array, pieces: Sequence[Piece], first: int) -> Array:
        found = np.empty((len(t), 2))
        for k, piece in enumerate(pieces, start=first):
            here = number == k
            found[here] = piece.at(t[here])[1]
        found /= np.linalg.norm(found, axis=-1, keepdims=True)
        return found

    @functools.cached_property
    def _samples(self) -> tuple[Array, Array, NDArray[np.int64], NDArray[np.int64], Array]:
        """Return places along the wall and their w; panels before and after each one; and at nodes the sum of both normals."""
        rows = np.concatenate([loop.rows for loop in self.loops])
        before, after, sums, base = [], [], [], 0
        for loop in self.loops:
            k = np.arange(len(loop.rows))
            before.append(base + np.roll(k, 1))
            after.append(base + np.roll(k, -1))
            tip = np.stack([np.cos(loop.jump / 2), -np.sin(loop.jump / 2)], axis=-1)
            n = left_of(loop.begin)
            sums.append(
                np.stack(
                    [n[:, 0] * tip[:, 0] - n[:, 1] * tip[:, 1], n[:, 1] * tip[:, 0] + n[:, 0] * tip[:, 1]], axis=-1
                )
            )
            base += len(k)
        w = np.tile((2 * np.arange(SAMPLES) + 1) / SAMPLES - 1, len(rows))
        many = np.repeat(rows, SAMPLES, axis=0)
        x = many[:, OX : OX + 2] + plane_of(many, many[:, HALF] * (1 + w), graphs(many, w)[0])
        return x, w, np.concatenate(before), np.concatenate(after), np.concatenate(sums)

    def depth(self, x: Array) -> Array:
        """Return the distances (N) of points (N, 2) from the wall: positive on the open side, else negative."""
        found = np.empty(len(x))
        for k in range(0, len(x), ROWS_AT_ONCE):
            found[k : k + ROWS_AT_ONCE] = self._depth(x[k : k + ROWS_AT_ONCE])
        return found

    def _depth(self, x: Array) -> Array:
        places, ws, before, after, normals = self._samples
        rows = np.concatenate([loop.rows for loop in self.loops])
        squared = (x[:, None, 0] - places[:, 0]) ** 2 + (x[:, None, 1] - places[:, 1]) ** 2
        best, found = np.full(len(x), np.inf), np.empty(len(x))
        candidates = []
        for _ in range(2):  # (half-way between two parts of the wall the samples do not say which is nearer)
            nearest = squared.argmin(axis=1)
            middle = nearest // SAMPLES
            candidates += [(middle, ws[nearest]), (before[middle], np.ones(len(x))), (after[middle], -np.ones(len(x)))]
            for k in range(-2 * SAMPLES, 2 * SAMPLES + 1):
                squared[np.arange(len(x)), (nearest + k) % len(places)] = np.inf
        for panel, begin in candidates:
            here = rows[panel]
            w, h, (xi, eta) = begin.copy(), here[:, HALF], chord_frame(here, x)
            on = np.arange(len(x))  # those that have not come to rest
            for _ in range(NEWTON):
                rows_on, w_on = here[on], w[on]
                f, f1, f2 = graphs(rows_on, w_on)
                dx, dy = xi[on] - h[on] * (1 + w_on), eta[on] - f
                rate = np.maximum(np.abs(1 + f1 * f1 - f2 * dy), 0.01)
                w[on] = np.clip(w_on + (dx + f1 * dy) / (h[on] * rate), -1.0, 1.0)
                on = on[np.abs(w[on] - w_on) > RESTS]
                if not len(on):
                    break
            f, f1, _f2 = graphs(here, w)
            dx, dy = xi - h * (1 + w), eta - f
            distance = np.hypot(dx, dy)
            side = dy - f1 * dx
            end = np.where(w == 1.0, after[panel], panel)
            at_end = np.abs(w) == 1.0
            side[at_end] = (plane_of(here[at_end], dx[at_end], dy[at_end]) * normals[end[at_end]]).sum(-1)
            better = distance < best
            best[better], found[better] = distance[better], np.copysign(distance, side)[better]
        return found

    def require_simple(self) -> None:
        """Raise CaromError where a loop crosses or touches itself, or runs clockwise around the table."""
        for number, loop in enumerate(self.loops):
            x = loop.rows[:, OX : OX + 2]
            turn = float(loop.turn.sum() + loop.jump.sum())
            if outline_faults(x) or abs(abs(turn) - math.tau) > 1e-6:
                raise CaromError(
                    Fault(self.name, "outline", "a closed curve that does not meet itself", "one that does")
                )
            if (turn > 0) != (number == 0):
                raise CaromError(Fault(self.name, "outline", "the table on the left of the curve", "one on its right"))
