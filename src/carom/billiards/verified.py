"""Proof that a periodic orbit is there, and the only one near: an interval Newton method (Krawczyk) on all bounces together.

Unknowns are the place u on its wall, the velocity and the spin sqrt(kappa) a omega of every bounce, and sigma. The equations

    (P_{i+1} - P_i) x v_i = 0,      (v, q)_{i+1} = L_{i+1} (v, q)_i,      (v, q)_1 = (1 + sigma) L_1 (v, q)_p,      E_1 = E

have as many lines as unknowns: L keeps the energy, so that sigma = 0 follows. With C near the inverse of the derivative at y, and
a box X of radius r around y: where |C F(y)| + |I - C F'(X)| r < r in every component, X holds exactly one solution (R. Krawczyk,
Computing 4, 187, 1969; R. E. Moore, SIAM J. Numer. Anal. 14, 611, 1977). F and F' are computed in mpmath's interval arithmetic, the
product with C in floating point with a bound of its rounding. Then it is shown that every bounce lies within its wall and that no
other wall stands in the way of a flight. The table is that of the numbers in its records: lines, circles and ellipses with these
radii; curves by their functions.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from decimal import ROUND_CEILING, ROUND_FLOOR, Context
from itertools import product
from typing import Any

import numpy as np
from numpy.typing import NDArray

from carom.billiards.energy_shell import EnergyShell
from carom.billiards.interval_walls import Interval, Spot, WallPiece, intervals, low, wall_pieces
from carom.billiards.orbits import Orbit
from carom.errors import CaromError
from carom.laws.conventional import conventional_reflection
from carom.laws.no_slip import no_slip_bounce

__all__ = ["Verified", "rounded", "verify"]

Array = NDArray[np.float64]
EPS = float(np.finfo(float).eps)
LARGEST, SMALLEST, FALLS = 0.1, 1e-11, 0.5  # radii that are tried, and the factor from one to the next
STEPS = 8  # of Newton's method in quadruple precision
CLOSE = 1e-25  # residual after them


@dataclass(frozen=True)
class Verified:
    """Whether exactly one periodic orbit is shown to be near a computed one, and how near.

    True in conditions where it is. Distances are relative: of places along the wall to the table's size, of velocities and
    sqrt(kappa) a omega to the speed; they hold for every bounce.

    Examples
    --------
    >>> from carom import billiards
    >>> long = billiards.periodic_orbits(billiards.ellipse(2.0, 1.0), 2, law="mirror", starts=50)[1]
    >>> bool(long.verified), long.verified.radius > 1e-3, long.verified.error < 1e-15
    (True, True, True)
    """

    radius: float = 0.0
    """No other orbit of this energy whose bounces meet the same walls lies within it; 0 where nothing is shown."""
    error: float = math.inf
    """The periodic orbit lies within it."""
    reason: str = ""
    """Why nothing is shown."""

    def __bool__(self) -> bool:
        """Return whether the orbit is verified."""
        return self.radius > 0

    def describe(self) -> str:
        """Return one line."""
        if not self:
            return f"not verified: {self.reason}"
        return f"verified: the only one within {rounded(self.radius, -1)}, known to {rounded(self.error, 1)}"


def rounded(x: float, way: int) -> str:
    """Return a number with two digits, rounded up (``way`` 1) or down (-1), so that a bound stays one."""
    context = Context(prec=2, rounding=ROUND_CEILING if way > 0 else ROUND_FLOOR)
    return f"{context.create_decimal_from_float(x):.2g}"


def verify(shell: EnergyShell, run: Orbit, cells: Sequence[int], family: int = 0) -> Verified:
    """Verify one period of an orbit: p bounces, the last of which leads back to where the first flight began.

    ``cells``: periodic cells passed during it. Raises CaromError where mpmath is not installed.
    """
    intervals()
    try:
        if family:
            raise CaromError("one of a continuous family")
        if run.setup.table.has_force:
            raise CaromError("a force acts on the ball")
        return _Proof(shell, run, cells).result()
    except CaromError as error:
        return Verified(reason=str(error))


class _Proof:
    """The equations of one orbit."""

    def __init__(self, shell: EnergyShell, run: Orbit, cells: Sequence[int]) -> None:
        self.iv, self.shape, self.size = intervals(), shell.setup.shape, shell.size
        self.p, self.width = len(run.t), shell.free.stop
        ball, speed = shell.setup.ball, shell.speed
        pieces = wall_pieces(self.shape)
        made = [pieces.of(int(k), x) for k, x in zip(run.piece, run.folded, strict=True)]
        self.pieces: list[WallPiece] = [one for one, _u in made]
        self.numbers = [int(k) for k in self.shape._number(run.piece.astype(int))]
        sides = [side if math.isfinite(side) else 0.0 for side in self.shape.cell or (0.0, 0.0)]
        self.sides = [self.iv.mpf(side) for side in sides]
        # (of a copy of an obstacle, the copy's cell and not the ball's)
        places = np.array([[float(c.mid) for c in one.spot(self.iv.mpf(u)).place] for one, u in made])
        moved = [[round(d / s) if s else 0 for d, s in zip(row, sides, strict=True)] for row in run.position - places]
        self.counts, self.closing = moved, list(cells)
        self.bounds = pieces
        self.weight = 1.0 + float(ball.kappa) if shell.setup.rolls else 1.0
        q = math.sqrt(ball.kappa) * ball.radius * run.spin
        y = np.column_stack([[u for _one, u in made], run.velocity / speed, q / speed])[:, : self.width]
        self.start = y
        self.law = self._law(shell)

    def _law(self, shell: EnergyShell) -> list[list[Interval]]:
        """Return the law's matrix in the frame of the wall: of the velocity along n, that along t = left(n), and the spin."""
        iv, setup = self.iv, shell.setup
        zero, one = iv.mpf(0), iv.mpf(1)
        if self.width == 3:  # without friction
            return [[-one, zero], [zero, one]]
        a, kappa = iv.mpf(float(setup.ball.radius)), iv.mpf(float(setup.ball.kappa))
        scale = iv.sqrt(kappa) * a
        bounce = conventional_reflection if setup.rolls else no_slip_bounce
        columns = []
        for k in range(3):
            v, w = (one * (k == 0), one * (k == 1), zero), (zero, zero, (k == 2) / scale)
            v1, w1 = bounce(v, w, (one, zero, zero), a, kappa)
            columns.append((v1[0], v1[1], w1[2] * scale))
        return [list(row) for row in zip(*columns, strict=True)]

    def result(self) -> Verified:
        """Return the largest radius for which the proof succeeds."""
        y, inverse = self._refined()
        spots = [one.spot(row[0]) for one, row in zip(self.pieces, y, strict=True)]
        rates = np.array([max(float(self.iv.sqrt(s.rate[0] ** 2 + s.rate[1] ** 2).mid), 1e-300) for s in spots])
        units = np.ones((self.p, self.width))
        units[:, 0] = self.size / rates
        reason, radius = "no radius for which the method contracts (parabolic, or nearly so)", LARGEST
        residual = np.abs(inverse) @ np.array([_most(f) for f in self.equations(y)])
        while radius > SMALLEST:
            r = np.append(radius * units.ravel(), radius)
            try:
                ratio, why = self._contracts(y, inverse, r, residual)
            except (ValueError, ZeroDivisionError):  # (the root of a negative number, of too large a box)
                ratio, why = math.inf, ""
            if ratio < 1:
                off = np.array(
                    [
                        [_most(a - float(b)) for a, b in zip(*rows, strict=True)]
                        for rows in zip(y, self.start, strict=True)
                    ]
                )
                error = float((off / units).max()) + float((residual / r).max()) * radius / (1 - ratio)
                if not error < radius:
                    raise CaromError(f"the orbit that closes is {error:.2g} away")
                return Verified(radius, error * (1 + 1e-6))
            reason = why or reason
            radius *= FALLS
        return Verified(reason=reason)

    def _refined(self) -> tuple[list[list[Interval]], Array]:
        """Return the orbit in quadruple precision, and an approximate inverse of the derivative."""
        iv = self.iv
        y = [[iv.mpf(float(one)) for one in row] for row in self.start]
        matrix = self.derivative(y, iv.mpf(0))[0]
        sizes = np.linalg.svd(matrix, compute_uv=False)
        if not np.isfinite(matrix).all() or sizes[-1] < 1e-9 * sizes[0]:
            raise CaromError("its equations are singular: parabolic, or one of a family")
        inverse: Array = np.linalg.inv(matrix).astype(float)
        for _ in range(STEPS):
            f = self.equations(y)
            step = inverse @ np.array([float(one.mid) for one in f])
            y = [
                [(one - float(d)).mid for one, d in zip(row, part, strict=True)]
                for row, part in zip(y, step[:-1].reshape(self.p, self.width), strict=True)
            ]
        if not max(_most(one) for one in self.equations(y)) < CLOSE:
            raise CaromError("no isolated orbit that closes is near")
        return y, inverse

    def _links(self) -> list[tuple[int, int]]:
        return [(i, (i + 1) % self.p) for i in range(self.p)]

    def _cell(self, k: int, closing: bool) -> tuple[int, int]:
        """Return the periodic cell of a bounce; ``closing``: of the one that follows the last."""
        x, y = (n + closing * m for n, m in zip(self.counts[k], self.closing, strict=True))
        return x, y

    def _moved(self, place: Sequence[Interval], cell: Sequence[int]) -> list[Interval]:
        return [x + n * side for x, n, side in zip(place, cell, self.sides, strict=True)]

    def _chord(self, i: int, j: int, here: Spot, there: Spot) -> list[Interval]:
        begin, end = self._moved(here.place, self._cell(i, False)), self._moved(there.place, self._cell(j, j <= i))
        return [b - a for a, b in zip(begin, end, strict=True)]

    def _reflect(self, n: Sequence[Interval], z: Sequence[Interval]) -> list[Interval]:
        """Return the velocity and spin after a wall with normal n."""
        v = [z[0] * n[0] + z[1] * n[1], z[1] * n[0] - z[0] * n[1], *z[2:]]
        w = [sum((a * b for a, b in zip(row, v, strict=True)), self.iv.mpf(0)) for row in self.law]
        return [w[0] * n[0] - w[1] * n[1], w[0] * n[1] + w[1] * n[0], *w[2:]]

    def equations(self, y: list[list[Interval]]) -> list[Interval]:
        """Return F with sigma = 0."""
        spots = [one.spot(row[0]) for one, row in zip(self.pieces, y, strict=True)]
        f = []
        for i, j in self._links():
            d = self._chord(i, j, spots[i], spots[j])
            f.append(d[0] * y[i][2] - d[1] * y[i][1])
            f += [a - b for a, b in zip(y[j][1:], self._reflect(spots[j].normal, y[i][1:]), strict=True)]
        z = y[0][1:]
        return [*f, self.weight * (z[0] * z[0] + z[1] * z[1]) + sum((q * q for q in z[2:]), self.iv.mpf(0)) - 1]

    def derivative(self, y: list[list[Interval]], sigma: Interval) -> tuple[Array, Array]:
        """Return the middles and the radii (N, N) of F' for a box of orbits."""
        iv, w, count = self.iv, self.width, self.p * self.width + 1
        zero = iv.mpf(0)
        entries: dict[tuple[int, int], Interval] = {}

        def add(i: int, j: int, value: Interval) -> None:
            entries[i, j] = entries.get((i, j), zero) + value

        spots = [one.spot(row[0]) for one, row in zip(self.pieces, y, strict=True)]
        for i, j in self._links():
            here, there, v = spots[i], spots[j], y[i][1:]
            d = self._chord(i, j, here, there)
            line, a, b = i * w, i * w, j * w
            add(line, b, there.rate[0] * v[1] - there.rate[1] * v[0])
            add(line, a, here.rate[1] * v[0] - here.rate[0] * v[1])
            add(line, a + 1, -d[1])
            add(line, a + 2, d[0])
            grown = 1 + sigma if j <= i else iv.mpf(1)
            n = there.normal
            after = self._reflect(n, v)
            # L(n) = R L R^-1, R the turn of the wall's frame: its rate is [J, L], J the turn by a right angle of the velocity
            left = [-v[1], v[0], *(zero for _ in v[2:])]
            turned = self._reflect(n, left)
            for k in range(w - 1):
                add(line + 1 + k, b + 1 + k, iv.mpf(1))
                spin = (-after[1], after[0])[k] if k < 2 else zero
                add(line + 1 + k, b, -grown * there.turn * (spin - turned[k]))
                if j <= i:
                    add(line + 1 + k, count - 1, -after[k])
            for m in range(w - 1):
                unit = [iv.mpf(1) if k == m else zero for k in range(w - 1)]
                for k, value in enumerate(self._reflect(n, unit)):
                    add(line + 1 + k, a + 1 + m, -grown * value)
        for k, one in enumerate(y[0][1:]):
            add(count - 1, 1 + k, 2 * (self.weight if k < 2 else 1) * one)
        middle, radius = np.zeros((count, count)), np.zeros((count, count))
        for place, value in entries.items():
            middle[place] = float(value.mid)
            radius[place] = _most(value - middle[place])
        return middle, radius

    def _contracts(self, y: list[list[Interval]], inverse: Array, r: Array, residual: Array) -> tuple[float, str]:
        """Return the factor of the box of radii r into which it is mapped; where the orbits in it are no orbits, inf and why."""
        iv = self.iv
        around = [iv.mpf([-float(one), float(one)]) for one in r]
        box = [[one + d for one, d in zip(row, around[k * self.width :], strict=False)] for k, row in enumerate(y)]
        why = self._astray(box)
        if why:
            return math.inf, why
        middle, radius = self.derivative(box, around[-1])
        size = np.abs(inverse)
        rounding = 2 * (len(r) + 2) * EPS * (size @ np.abs(middle))
        off = np.abs(np.eye(len(r)) - inverse @ middle) + rounding + (1 + 1e-9) * (size @ radius)
        return float(((residual + off @ r) / r).max()) * (1 + 1e-9), ""

    # --- the flights ------------------------------------------------------------------------------------------------------

    def _astray(self, box: list[list[Interval]]) -> str:
        """Return why a box of orbits may hold some that leave their walls or meet others; empty where none does."""
        if not self.bounds.convex:
            return "a curve that is not shown to be convex"
        spots = []
        for number, (one, row) in enumerate(zip(self.pieces, box, strict=True)):
            if not one.holds(row[0]):
                return f"bounce {number + 1} may lie at the end of its wall"
            spots.append(one.spot(row[0]))
        for i, j in self._links():
            here, there, v = spots[i], spots[j], box[i][1:]
            d = self._chord(i, j, here, there)
            if not (d[0] * v[0] + d[1] * v[1] > 0 and v[0] * here.normal[0] + v[1] * here.normal[1] > 0):
                return f"bounce {i + 1} may graze its wall"
            if not v[0] * there.normal[0] + v[1] * there.normal[1] < 0:
                return f"bounce {j + 1} may graze its wall"
            if not self._is_free(self._moved(here.place, self._cell(i, False)), d, (i, j)):
                return f"another wall may stand between bounces {i + 1} and {j + 1}"
        return ""

    def _is_free(self, x: Sequence[Interval], d: Sequence[Interval], ends: tuple[int, int]) -> bool:
        """Return whether a flight from x by d meets no wall but the two at its ends."""
        shape, (i, j) = self.shape, ends
        begins, stops = self.numbers[i], self.numbers[j]
        for k, face in enumerate(shape.faces):
            if k not in (begins, stops) and not self._misses_face(face, x, d):
                return False
        first = len(shape.faces)
        for k, (cx, cy, r, half) in enumerate(shape.inside, start=first):
            e = (x[0] - cx, x[1] - cy)
            if half:
                if not _misses_half(e, d, r, half, (k == begins, k == stops), self.iv):
                    return False
            elif k not in (begins, stops) and not (_beyond(e, r) < 0 and _beyond((e[0] + d[0], e[1] + d[1]), r) < 0):
                return False
        first += len(shape.inside)
        own = {(begins, *self._cell(i, False)), (stops, *self._cell(j, j <= i))}
        for k, (cx, cy, r, *_rest) in enumerate(shape.outside, start=first):
            for cell in self._cells_near((cx, cy), r, x, d):
                apart = self._moved((x[0] - cx, x[1] - cy), [-n for n in cell])
                if (k, *cell) not in own and not _misses_circle(apart, d, r):
                    return False
        return True

    def _cells_near(self, centre: Sequence[float], r: float, x: Sequence[Interval], d: Sequence[Interval]) -> Any:
        """Return the periodic cells whose copy of a circle may reach the box around a flight."""
        found = []
        for c in (0, 1):
            side = float(self.sides[c].mid)
            ends = [low(x[c]), low(x[c] + d[c]), -low(-x[c]), -low(-x[c] - d[c])]
            reach = (min(ends) - r - centre[c], max(ends) + r - centre[c])
            found.append(range(math.floor(reach[0] / side), math.ceil(reach[1] / side) + 1) if side else range(1))
        return product(*found)

    def _misses_face(self, face: Any, x: Sequence[Interval], d: Sequence[Interval]) -> bool:
        (nx, ny, _nz), c, _r, begin, end, *_ends = face
        gap, gain = nx * x[0] + ny * x[1] - c, nx * d[0] + ny * d[1]
        if gap > 0 and gap + gain > 0:
            return True
        if not self.shape.finite_faces:
            return False
        along, way = ny * x[0] - nx * x[1], ny * d[0] - nx * d[1]
        if (
            (gap < 0 and gap + gain < 0)
            or (along < begin and along + way < begin)
            or (along > end and along + way > end)
        ):
            return True
        if not (gain > 0 or gain < 0):
            return False
        met = along - way * gap / gain
        return bool(met < begin or met > end)


def _most(x: Interval) -> float:
    """Return a number above the size of all of an interval."""
    return max(-low(x), -low(-x), 0.0)


def _beyond(e: Sequence[Interval], r: float) -> Interval:
    return e[0] * e[0] + e[1] * e[1] - r * r


def _misses_circle(e: Sequence[Interval], d: Sequence[Interval], r: float) -> bool:
    """Return whether a segment from e by d stays farther than r from the origin."""
    gap, along, length = _beyond(e, r), e[0] * d[0] + e[1] * d[1], d[0] * d[0] + d[1] * d[1]
    if gap > 0 and (along > 0 or (along + length < 0 and gap + 2 * along + length > 0)):
        return True
    across = e[0] * d[1] - e[1] * d[0]
    return bool(across * across - r * r * length > 0)


def _misses_half(
    e: Sequence[Interval], d: Sequence[Interval], r: float, half: float, own: tuple[bool, bool], iv: Any
) -> bool:
    """Return whether a segment from e by d crosses a circle about the origin at its ends or on the half that is no wall."""
    gap, along, length = _beyond(e, r), e[0] * d[0] + e[1] * d[1], d[0] * d[0] + d[1] * d[1]
    if all(own) or (gap < 0 and gap + 2 * along + length < 0):
        return True
    if own[0]:
        crossings = [-2 * along / length]
    elif own[1]:
        crossings = [gap / length]  # the product of both, of which the other is 1
    else:
        root = along * along - gap * length
        if root < 0:
            return True
        if not root > 0:
            return False
        crossings = [(-along + sign * iv.sqrt(root)) / length for sign in (-1, 1)]
    return all(t < 0 or t > 1 or (e[0] + t * d[0]) * half < 0 for t in crossings)
