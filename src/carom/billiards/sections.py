"""Cylinders of any section as surfaces to roll on: a smooth closed figure in x and y, and the axis z."""

from __future__ import annotations

import math
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from carom.errors import CaromError, Fault
from carom.scene.figures import Piece

__all__ = ["SectionPiece", "section_piece"]

Array = NDArray[np.float64]
SAMPLES = 256  # of each piece, at which the search for the nearest point begins
NEWTON, CLOSE = 30, 4e-16
SMOOTH = 1e-9  # sine of the angle between two pieces that continue each other


@dataclass(frozen=True, eq=False)
class SectionPiece:
    """A cylinder along z over a closed curve of pieces that continue each other smoothly, with their open side on the left."""

    pieces: tuple[Piece, ...]
    side: float
    """1 for a ball on the open side of the curve, -1 for a ball on the other."""
    places: Array
    """(N, 2): points of the curve."""
    parameters: Array
    """(N)."""
    owners: NDArray[np.int64]
    """(N): the piece of each."""
    last: dict[bytes, tuple[Array, Array, float]] = field(default_factory=dict)
    """The foot that was asked for last: distance, normal and turn ask for the same one."""

    def distance(self, x: Array) -> float:
        """From the surface to the centre's place x, positive on the ball's side."""
        foot, left, _bend = self._foot(x)
        return self.side * float((x[:2] - foot) @ left)

    def normal(self, x: Array) -> Array:
        """Return the gradient of the distance."""
        left = self._foot(x)[1]
        return np.array([self.side * left[0], self.side * left[1], 0.0])

    def turn(self, x: Array, n: Array, v: Array) -> Array:
        """Return the rate of change of the normal n while the centre moves with v."""
        # x = y + d n, and the normal turns by -k t along the curve, so that dn/dt = -k/(1 - d k) (v.t) t with k towards the ball
        foot, left, bend = self._foot(x)
        t = np.array([left[1], -left[0]])
        along = float((x[:2] - foot) @ left)
        rate = -self.side * bend / (1.0 - along * bend) * float(v[:2] @ t)
        return np.array([rate * t[0], rate * t[1], 0.0])

    def _foot(self, x: Array) -> tuple[Array, Array, float]:
        """Return the nearest point of the curve (2), the normal to its open side there (2), and its curvature towards that side."""
        asked = x[:2].tobytes()
        if asked in self.last:
            return self.last[asked]
        squares = ((self.places - x[:2]) ** 2).sum(1)
        k = int(squares.argmin())
        number = int(self.owners[k])
        t = float(self.parameters[k])
        for _ in range(3):  # (the nearest point may lie on the next piece)
            piece = self.pieces[number]
            first, last = piece.span()
            t = self._nearest(piece, x, min(max(t, first), last))
            if first < t < last:
                break
            number, step = (number + 1, 0) if t >= last else (number - 1, 1)
            number %= len(self.pieces)
            t = self.pieces[number].span()[step]
        y, d, dd = (one[0] for one in self.pieces[number].at(np.array([t])))
        rate = math.hypot(*d)
        found = y, np.array([-d[1], d[0]]) / rate, float(d[0] * dd[1] - d[1] * dd[0]) / rate**3
        self.last.clear()
        self.last[asked] = found
        return found

    @staticmethod
    def _nearest(piece: Piece, x: Array, t: float) -> float:
        """Return the parameter of the point of a piece that is nearest to x, or its first one beyond an end."""
        first, last = piece.span()
        for _ in range(NEWTON):
            y, d, dd = (one[0] for one in piece.at(np.array([t])))
            away = x[:2] - y
            slope = float(d @ d - away @ dd)
            step = float(away @ d) / (slope if slope > 0 else float(d @ d))
            new = min(max(t + step, first), last)
            if abs(new - t) <= CLOSE * (abs(t) + last - first):
                return new
            t = new
        return t


def section_piece(name: str, loop: list[Piece], inside: bool, ball: float) -> SectionPiece:
    """Return the cylinder over a closed loop, counterclockwise, for a ball of some radius.

    CaromError for a loop with corners, and for a ball that is larger than the radius of curvature somewhere.
    """
    ends = [piece.at(np.array(piece.span()))[1] for piece in loop]
    tangents = [one / np.linalg.norm(one, axis=1, keepdims=True) for one in ends]
    for before, after in zip(tangents, tangents[1:] + tangents[:1], strict=True):
        if abs(before[1, 0] * after[0, 1] - before[1, 1] * after[0, 0]) > SMOOTH or before[1] @ after[0] < 0:
            raise CaromError(Fault("cylinder", "section", "a smooth closed curve", f"the {name}, which has corners"))
    places, parameters, owners, least = [], [], [], math.inf
    for k, piece in enumerate(loop):
        t = np.linspace(*piece.span(), SAMPLES)
        x, d, dd = piece.at(t)
        bend = (d[:, 0] * dd[:, 1] - d[:, 1] * dd[:, 0]) / np.linalg.norm(d, axis=1) ** 3
        sharpest = float((bend if inside else -bend).max())
        least = min(least, 1 / sharpest if sharpest > 0 else math.inf)
        places.append(x)
        parameters.append(t)
        owners.append(np.full(SAMPLES, k))
    if not ball < least:
        raise CaromError(
            Fault("cylinder", "ball", f"a radius below the least one of curvature, {least:.6g} m", f"{ball:g}")
        )
    side = 1.0 if inside else -1.0
    return SectionPiece(tuple(loop), side, np.concatenate(places), np.concatenate(parameters), np.concatenate(owners))
