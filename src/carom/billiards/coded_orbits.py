"""Periodic orbits by their itinerary: closed polygons of extremal length, with the mirror law; Newton's method from these."""

from __future__ import annotations

import itertools
import math
import string
from collections import Counter
from collections.abc import Iterable
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from carom.billiards.boundary import Boundary, ConnectedWall
from carom.billiards.intersections import DONE, POSITION, TIME, VELOCITY
from carom.billiards.orbits import Orbit, moved_in_flight, orbit_from_setup
from carom.billiards.setup import OrbitSetup, Start, orbit_setup
from carom.billiards.stability import end_coordinates, tangents_of_bounces
from carom.billiards.tables import Table
from carom.bodies import Ball, Surface
from carom.errors import CaromError, Fault, require_count

LETTERS = string.ascii_uppercase + string.ascii_lowercase


def letters_of(numbers: Any) -> str:
    """Return walls by number as one text; beyond 52 walls their numbers with dots between."""
    walls = [int(k) for k in numbers]
    return "".join(LETTERS[k] for k in walls) if max(walls, default=0) < len(LETTERS) else ".".join(map(str, walls))


def code_numbers(shape: Boundary, code: Any) -> list[int]:
    """Return the walls of a code such as "ABC" or "0.1.2" by number; CaromError where it is none of the table."""
    count = int(shape.parts.max(initial=-1)) + 1
    text = str(code)
    parts = text.split(".") if "." in text else list(text)
    known = {letter: k for k, letter in enumerate(LETTERS[:count])} | {str(k): k for k in range(count)}
    if len(parts) < 2 or any(one not in known for one in parts):
        last = letters_of([count - 1])
        raise CaromError(
            Fault("orbit", "itinerary", f"two walls or more, letters from A to {last}, such as AB", repr(text))
        )
    return [known[one] for one in parts]


def itinerary(found: Orbit) -> str | NDArray[np.str_]:
    """Return the walls that orbits meet as letters: A for the first piece of the boundary, B for the second.

    The pieces are those of :attr:`Orbit.piece` in order; images of an obstacle have its letter, and arcs of a smooth curve between
    corners are one wall. Beyond 52 walls numbers with dots between stand in place of letters.

    Parameters
    ----------
    found : Orbit, one or many

    Returns
    -------
    str, or array (...) of them

    Examples
    --------
    >>> from carom import billiards
    >>> found = billiards.orbit(billiards.rectangle(2.0, 1.0), ((0.0, 0.1), (1.0, 0.5), 0.0), bounces=6, law="mirror")
    >>> billiards.itinerary(found)
    'CBADCB'
    """
    numbers = found.setup.shape.wall_parts(found.piece)
    rows = numbers.reshape(-1, numbers.shape[-1])
    texts = [letters_of(row[:n]) for row, n in zip(rows, np.ravel(found.count), strict=True)]
    return np.array(texts).reshape(numbers.shape[:-1]) if numbers.ndim > 1 else texts[0]


@dataclass(frozen=True, eq=False)
class Words:
    """Words of orbits: how many of each length occur, and which do not.

    Examples
    --------
    Three discs in the plane: no disc follows itself, and all other words occur.

    >>> from carom import billiards
    >>> table = billiards.sinai(0.3)
    >>> found = billiards.words(billiards.orbit(billiards.rectangle(), billiards.starts(billiards.rectangle(), 99), 200), 3)
    >>> found.number, found.pruned[0][:3]
    ([4, 12, 36], ['AA', 'BB', 'CC'])
    """

    counts: tuple[dict[str, int], ...]
    """Number of times that each word of 1, 2, ... walls occurs."""
    symbols: tuple[str, ...]
    """Letters that occur."""

    @property
    def number(self) -> list[int]:
        """Number of different words of 1, 2, ... walls."""
        return [len(one) for one in self.counts]

    @property
    def entropy(self) -> list[float]:
        """ln(N(n)/N(n - 1)) for n = 2, 3, ...: it tends to the topological entropy per bounce where all words are seen."""
        return [math.log(b / a) for a, b in zip(self.number, self.number[1:], strict=False)]

    @property
    def unseen(self) -> list[float]:
        """Estimated chance that one more word of 1, 2, ... walls is a new one: the share of words seen once (Good 1953)."""
        return [sum(k == 1 for k in one.values()) / sum(one.values()) for one in self.counts]

    @property
    def pruned(self) -> list[list[str]]:
        """Words of 2, 3, ... walls that do not occur although their beginnings and ends do, and chance would show them 10 times."""
        found = []
        for shorter, longer in zip(self.counts, self.counts[1:], strict=False):
            total = sum(shorter.values())
            middles = Counter[str]()
            for word, count in shorter.items():
                middles[word[1:]] += count
            found.append(
                sorted(
                    word + end[-1]
                    for word in shorter
                    for end in shorter
                    if word[1:] == end[:-1]
                    and word + end[-1] not in longer
                    and shorter[word] * shorter[end] >= EXPECTED * (middles[word[1:]] if word[1:] else total)
                )
            )
        return found


EXPECTED = 10.0  # times that a word must be expected, by the words of one wall less, before it counts as pruned


def words(found: Orbit, longest: int, symbols: str | None = None) -> Words:
    """Count the words of 1 to ``longest`` walls in the itineraries of orbits.

    Parameters
    ----------
    found : Orbit
        One or many; long orbits show more words.
    longest : int
        Length of the longest words.
    symbols : str, optional
        A letter for each wall, in the order of :func:`itinerary`: "ABAB" counts opposite sides of a rectangle as one.

    Returns
    -------
    Words

    Raises
    ------
    CaromError
        A number of letters that is not the number of walls; more than 52 walls.

    Examples
    --------
    Sides of a square by their direction, with the mirror law: there are 1 + sum of (n - k + 1) phi(k) words of length n (Mignosi
    1991), so that the entropy is zero.

    >>> from carom import billiards
    >>> table = billiards.rectangle(1.0, 1.0)
    >>> run = billiards.orbit(table, billiards.starts(table, 500, law="mirror"), 100, law="mirror")
    >>> billiards.words(run, 5, "ABAB").number
    [2, 4, 8, 14, 24]
    """
    longest = require_count("orbit", "longest", longest)
    count = int(found.setup.shape.parts.max(initial=-1)) + 1
    letters = LETTERS[:count] if symbols is None else symbols
    if len(letters) != count:
        raise CaromError(
            Fault("words", "symbols", f"{count} letters, one for each wall, and at most 52 walls", repr(symbols))
        )
    numbers = found.setup.shape.wall_parts(found.piece)
    table = np.array([*letters, ""])
    rows = numbers.reshape(-1, numbers.shape[-1])
    texts = ["".join(table[row[:n]]) for row, n in zip(rows, np.ravel(found.count), strict=True)]
    counts = [
        Counter(text[k : k + n] for text in texts for k in range(len(text) - n + 1)) for n in range(1, longest + 1)
    ]
    return Words(tuple(dict(one) for one in counts), tuple(sorted(set(letters))))


# ----------------------------------------------------------------------------------------------------
# Equations of periodic orbits on one energy shell, with exact derivatives, and Newton's method for them.
#
# An orbit of period p is a fixed point of p bounces. Its unknowns are the state just after one bounce: arc length s, velocities
# v_t and v_n along and across the wall, spin q = sqrt(kappa) a omega. The equations: p bounces lead back, and the energy is the
# given one. There is one equation more than unknowns, since bounces keep the energy; the step of least length solves them, also
# where orbits form a continuous family.


Array = NDArray[np.float64]
ITERATIONS = 60  # of Newton's method, steps that are shortened among them
LONGEST_STEP = 0.2  # relative to the table's size and the ball's speed
SHORTEST_SHARE = 1 / 64  # of Newton's step: where no larger share brings the orbit nearer to closing, the search ends
CLOSED = 1e-12  # residual at which an orbit counts as closed, relative to its tangent map; two more steps follow
LARGEST_RESIDUAL = 1e-8  # where rounding, enlarged by the map, exceeds it, nothing shows that an orbit is there
NULL = 1e-7  # singular values of the equations, relative to the largest, that count as zero


@dataclass(frozen=True, eq=False)
class EnergyShell:
    """Coordinates of states just after a bounce, on one energy shell, and the map of bounces in them.

    States are rows (N, 4) of s over the table's size, v_t, v_n and q. ``free``: the coordinates that are unknowns; q is none where
    the law leaves the spin alone.
    """

    setup: OrbitSetup
    energy: float
    """Twice the energy per mass, m^2/s^2."""

    @property
    def free(self) -> slice:
        """The unknowns among the coordinates."""
        return slice(0, 3 if self.setup.keeps_spin else 4)

    @property
    def speed(self) -> float:
        """Of a ball that does not spin, m/s."""
        return math.sqrt(self.energy)

    @property
    def size(self) -> float:
        """Of the table, m."""
        return float(self.setup.shape.size)

    def rows(self, y: Array) -> tuple[Array, Array, NDArray[np.int64]]:
        """Return the states (N, 9) of coordinates (N, 4), the normals (N, 3) and the pieces (N) of the boundary there."""
        ball = self.setup.ball
        piece, x, n = self.setup.shape.place(y[:, 0] * self.size)
        rows, normal = np.zeros((len(y), 9)), np.zeros((len(y), 3))
        rows[:, :2], normal[:, :2] = x, n
        t = np.stack([n[:, 1], -n[:, 0]], axis=1)
        rows[:, 3:5] = y[:, 1:2] * t + y[:, 2:3] * n
        rows[:, 8] = y[:, 3] / (math.sqrt(ball.kappa) * ball.radius)
        if self.setup.rolls:
            # as start_rows has it
            rows[:, 6], rows[:, 7] = -rows[:, 4] / ball.radius, rows[:, 3] / ball.radius
        return rows, normal, piece

    def coordinates(self, piece: Any, x: Array, v: Array, spin: Array) -> Array:
        """Return the coordinates (..., 4) of states: pieces (...), positions and velocities (..., 2), spins (...)."""
        n = self.setup.shape.normals(piece, x)
        s = self.setup.shape.coordinate(piece, x)
        ball = self.setup.ball
        along, across = n[..., 1] * v[..., 0] - n[..., 0] * v[..., 1], (n[..., :2] * v).sum(-1)
        return np.stack([s / self.size, along, across, math.sqrt(ball.kappa) * ball.radius * spin], axis=-1)

    def excess(self, rows: Array, y: Array) -> tuple[Array, Array]:
        """Return twice the energy per mass beyond the given one (N), and its derivative (N, 4) by the coordinates."""
        rolls = 1.0 + self.setup.ball.kappa if self.setup.rolls else 1.0
        g = np.array(self.setup.table.acceleration)
        # (where no force acts, the energy does not depend on the place; to find this on a curve takes as long as a bounce)
        n = self.setup.shape.place(y[:, 0] * self.size)[2] if g.any() else np.zeros((len(y), 2))
        value = rolls * (y[:, 1] ** 2 + y[:, 2] ** 2) + y[:, 3] ** 2 - 2 * rows[:, :3] @ g - self.energy
        slope = np.stack(
            [-2 * self.size * (n[:, 1] * g[0] - n[:, 0] * g[1]), 2 * rolls * y[:, 1], 2 * rolls * y[:, 2], 2 * y[:, 3]],
            axis=1,
        )
        return value, slope

    def equations(self, y: Array, bounces: int) -> tuple[Array, Array, Array]:
        """Return the residuals (N, 5) of p bounces and of the energy, their derivatives (N, 5, 4), and the tangent maps (N, 4, 4).

        Residuals are infinite where the orbit ends before.
        """
        rows, n, piece = self.rows(y)
        f, df = np.full((len(y), 5), np.inf), np.full((len(y), 5, 4), np.nan)
        vectors, last, ends, after = tangents_of_bounces(self.setup, rows, n, bounces)
        ok = (ends["reason"] == DONE) & (y[:, 2] > 0)
        f[:, 4], df[:, 4] = self.excess(rows, y)
        new = self.coordinates(ends["piece"], last[:, POSITION][:, :2], last[:, VELOCITY][:, :2], last[:, 9])
        f[ok, :4] = (new - y)[ok]
        f[ok, 0] = self._around(ends["piece"], new[:, 0], y[:, 0])[ok]
        # the map's own coordinates keep the directions of velocities; here v_t and v_n turn with the wall
        turned, back = self._turn(ends["piece"], last[:, POSITION], new), self._turn(piece, rows[:, :3], y)
        matrix = turned @ end_coordinates(self.setup, vectors, after) @ (2 * np.eye(4) - back)
        scale = np.array([self.size, 1.0, 1.0, 1.0])
        matrix *= scale / scale[:, None]
        df[:, :4] = matrix - np.eye(4)
        f[~ok] = np.inf
        return f, df, matrix

    def duration(self, y: Array, bounces: int) -> float:
        """Return the time of a number of bounces from coordinates (4), s."""
        rows, n, _piece = self.rows(y[None])
        return float(tangents_of_bounces(self.setup, rows, n, bounces)[1][0, TIME])

    def _turn(self, piece: Any, x: Array, y: Array) -> Array:
        """Return the derivatives (N, 4, 4) of (s, v_t, v_n, q) by displacements along a wall of curvature k with velocities held.

        The normal turns by -k ds t, the tangent by k ds n.
        """
        k = self.setup.shape.curvatures(piece, x)
        found = np.tile(np.eye(4), (len(y), 1, 1))
        found[:, 1, 0], found[:, 2, 0] = k * y[:, 2], -k * y[:, 1]
        return found

    @cached_property
    def _walls(self) -> tuple[list[ConnectedWall], NDArray[np.int64]]:
        """The connected walls, and the number of the wall of each piece; the first entry is for none, as those of windows."""
        shape = self.setup.shape
        found = np.full(1 + len(self.setup.pieces), -1)
        first = len(shape.faces)
        met = np.array([k for k in range(len(found) - 1) if not first <= k < first + len(shape.windows)], int)
        found[1 + met] = shape.wall_numbers(met)
        return shape.connected, found

    def _around(self, piece: Any, new: Array, old: Array) -> Array:
        """Return differences of arc lengths (over the size), the shorter way around a closed wall if both are on it."""
        shape = self.setup.shape
        begin = old % (shape.lengths.sum() / self.size)
        d: Array = new - begin
        walls, table = self._walls
        numbers = table[np.asarray(piece, int) + 1]
        for k, wall in enumerate(walls):
            length = (wall.last - wall.first) / self.size
            here = (numbers == k) & wall.closed & (begin >= wall.first / self.size) & (begin < wall.last / self.size)
            d[here] -= length * np.round(d[here] / length)
        return d


def _keeps_measure(setup: OrbitSetup) -> bool:
    """Return whether a law that is called keeps, in some impacts, the energy and the volume of (v_n, v_t, spin)."""
    if setup.kernel is None:
        return False
    world, (a, kappa) = setup.world[0], (setup.ball.radius, setup.ball.kappa)
    numbers = [float(world[name]) for name in ("e", "mu", "beta")]

    def after(u: Array) -> Array:
        v, w = setup.kernel(
            (u[0], u[1], 0.0), (0.0, 0.0, u[2] / (math.sqrt(kappa) * a)), (1.0, 0.0, 0.0), a, kappa, *numbers
        )
        return np.array([v[0], v[1], w[2] * math.sqrt(kappa) * a])

    for u in np.random.default_rng(0).normal(size=(20, 3)):
        u[0] = -abs(u[0])
        slopes = [(after(u + h) - after(u - h)) / 2e-5 for h in 1e-5 * np.eye(3)]
        if abs(after(u) @ after(u) - u @ u) > 1e-9 * (u @ u) or abs(abs(np.linalg.det(slopes)) - 1) > 1e-6:
            return False
    return True


def energy_shell(table: Table, ball: Ball | None, law: Any, surface: Surface | None, speed: float) -> EnergyShell:
    """Return the energy shell of a table, a ball and a law; CaromError where periodic orbits cannot be found there."""
    setup = orbit_setup(table, ball, law, surface, "end")
    if not setup.conservative and not _keeps_measure(setup):
        expected = "one that keeps the energy and volumes of velocities (no-slip, mirror, rolling, some custom laws)"
        raise CaromError(Fault("periodic_orbits", "law", expected, f"{setup.law}"))
    if not setup.planar:
        raise CaromError(Fault("periodic_orbits", "table", "a table in the plane", f"{table}"))
    lengths = setup.shape.lengths
    if not len(lengths) or not np.isfinite(lengths).all():
        expected, advice = (
            "a closed boundary, such as a polygon's",
            "carom.billiards.tangent_map has the multipliers of an orbit",
        )
        got = f"{table}, whose walls have no end"
        raise CaromError(Fault("periodic_orbits", "table", expected, got, f"in Python {advice} that is known"))
    if not (isinstance(speed, int | float | np.number) and 0 < speed < math.inf):
        raise CaromError(Fault("periodic_orbits", "speed", "a positive number", repr(speed)))
    return EnergyShell(setup, float(speed) ** 2)


def solve_periodic(shell: EnergyShell, y: Array, p: int) -> Array:
    """Return the coordinates (M, 4) of the orbits of p bounces to which Newton's method leads from coordinates (N, 4)."""
    free, closed = shell.free, []
    f, df, matrix = shell.equations(y, p)
    size, share = residual(f), np.ones(len(y))
    for _ in range(ITERATIONS):
        on = np.isfinite(size) & (share >= SHORTEST_SHARE)
        y, f, df, matrix, size, share = (one[on] for one in (y, f, df, matrix, size, share))
        if not len(y):
            break
        done = size <= np.minimum(CLOSED * (1 + np.abs(matrix).max(axis=(1, 2))), LARGEST_RESIDUAL)
        closed.append(y[done])
        y, f, df, matrix, size, share = (one[~done] for one in (y, f, df, matrix, size, share))
        step = newton_steps(f, df[..., free])
        length = np.linalg.norm(step, axis=1)
        step *= np.minimum(1.0, LONGEST_STEP / np.maximum(length, 1e-300))[:, None] * share[:, None]
        trial = y.copy()
        trial[:, free] += step
        f2, df2, matrix2 = shell.equations(trial, p)
        size2 = residual(f2)
        better = size2 < size
        y, f, df, matrix = (
            np.where(_like(better, a), b, a) for a, b in ((y, trial), (f, f2), (df, df2), (matrix, matrix2))
        )
        size, share = np.where(better, size2, size), np.where(better, np.minimum(1.0, 2 * share), share / 4)
    return _polished(shell, np.concatenate([np.empty((0, 4)), *closed]), p)


def newton_steps(f: Array, df: Array) -> Array:
    """Return the steps (N, K) of least length that solve the linearised equations (N, 5) in the least-squares sense."""
    inverse = np.linalg.pinv(np.where(np.isfinite(df), df, 0.0), rcond=NULL)
    found: Array = -np.einsum("nij,nj->ni", inverse, f)
    return found


def _like(condition: Any, array: Array) -> Any:
    return condition.reshape(condition.shape + (1,) * (array.ndim - 1))


def residual(f: Array) -> Array:
    """Return the size (N) of residuals (N, 5); infinite where an orbit ends."""
    with np.errstate(invalid="ignore"):
        found: Array = np.linalg.norm(f, axis=1)
    return found


def _polished(shell: EnergyShell, y: Array, p: int) -> Array:
    """Return solutions after two more steps, each where it does not enlarge the residual."""
    for _ in range(2):
        if not len(y):
            break
        f, df, _matrix = shell.equations(y, p)
        trial = y.copy()
        trial[:, shell.free] += newton_steps(f, df[..., shell.free])
        better = residual(shell.equations(trial, p)[0]) < residual(f)
        y = np.where(better[:, None], trial, y)
    return y


# ----------------------------------------------------------------------------------------------------
# Which periodic orbits are the same: up to first bounce, direction of time, rotation and reflection, and within families.


EQUAL = 1e-6  # relative: difference of flight times, velocities and spins of two orbits that are congruent
MAX_PERIOD = 1000
SYMMETRY_POINTS = 720  # of a boundary, by which its symmetries are found


def run_orbits(shell: EnergyShell, y: Array, p: int) -> Orbit:
    """Follow orbits from coordinates (N, 4) for a number of bounces."""
    begin = shell.rows(y)[0]
    return orbit_from_setup(shell.setup, Start(begin[:, :2], begin[:, 3:5], begin[:, 8]), p)


def bounce_sequences(shell: EnergyShell, run: Orbit) -> tuple[Array, Array]:
    """Return flight time, v_n, v_t, q (N, p, 4) of the bounces of closed orbits, and those of the orbits run backwards."""
    dt = np.diff(run.t, axis=1, prepend=0.0)  # before each bounce
    n = run.normal
    q = math.sqrt(shell.setup.ball.kappa) * shell.setup.ball.radius * run.spin
    before = moved_in_flight(shell.setup.table, np.roll(run.position, 1, axis=1), np.roll(run.velocity, 1, axis=1), dt)[
        1
    ]

    def split(u: Array) -> list[Array]:
        return [(u * n).sum(-1), n[..., 1] * u[..., 0] - n[..., 0] * u[..., 1]]

    ahead = np.stack([np.roll(dt, -1, axis=1), *split(run.velocity), q], axis=-1)
    back = np.stack([dt, *split(-before), -np.roll(q, 1, axis=1)], axis=-1)[:, ::-1]
    return ahead, back


def periods_of(period: Any) -> list[int]:
    """Return the periods that a number, several numbers, or a text of numbers and ranges mean, in ascending order."""
    if isinstance(period, str):
        parts = [[part.strip() for part in one.split("-")] for one in period.split(",")]
        if not all(len(ends) <= 2 and all(end.isdecimal() and len(end) < 9 for end in ends) for ends in parts):
            raise CaromError(Fault("orbit", "periodic", "numbers of bounces, such as 4, 2-6 or 3,5", repr(period)))
        ends = [(_period(int(one[0])), _period(int(one[-1]))) for one in parts]
        if turned := next((f"{first}-{last}" for first, last in ends if first > last), ""):
            raise CaromError(
                Fault("orbit", "periodic", "ranges from the smaller number to the larger, such as 2-6", repr(turned))
            )
        return sorted({p for first, last in ends for p in range(first, last + 1)})
    return sorted({_period(p) for p in (period if isinstance(period, Iterable) else (period,))})


def _period(period: Any) -> int:
    p: int = require_count("orbit", "periodic", period)
    if p > MAX_PERIOD:
        raise CaromError(Fault("orbit", "periodic", f"at most {MAX_PERIOD} bounces", f"{p}"))
    return p


def least_period(shell: EnergyShell, positions: Array, bounces: Array, equal: float = EQUAL) -> int:
    """Return the least number of bounces after which positions (p, 2) and bounces (p, 4) repeat."""
    p, shape = len(bounces), shell.setup.shape
    for d in range(1, p):
        if p % d == 0:
            moved = shape.folded(np.roll(positions, -d, axis=0) - positions)
            turned = np.roll(bounces, -d, axis=0) - bounces
            if max(np.abs(moved).max() / shell.size, np.abs(turned).max()) < equal:
                return d
    return p


def congruent(one: Array, other: Array, reversed_other: Array, equal: float = EQUAL, magnetic: bool = False) -> bool:
    """Whether the bounces (p, 4) of two orbits agree up to where they begin, a reflection and the direction of time.

    A magnetic field is turned round by either of the two, so there they count together only.
    """
    if abs(one[:, 0].sum() - other[:, 0].sum()) > equal * len(one):
        return False
    ways = [(other, 1.0), (reversed_other, -1.0)]
    ways += [] if magnetic else [(other, -1.0), (reversed_other, 1.0)]
    for variant, sign in ways:
        shown = variant * np.array([1.0, 1.0, sign, sign])
        if any(np.abs(np.roll(shown, k, axis=0) - one).max() < equal for k in range(len(one))):
            return True
    return False


def piece_symmetries(shape: Boundary) -> list[list[int]]:
    """Return how the rotations and reflections of a closed boundary about its middle permute its pieces; the identity first.

    The middles of the pieces and their ends are mapped on one another; a map is one of the table if all points of a sample stay on
    the boundary. Arcs of a smooth curve count as one piece between its corners.
    """
    total = float(shape.lengths.sum())
    met, x, _n = shape.place((np.arange(SYMMETRY_POINTS) + 0.5) * total / SYMMETRY_POINTS)
    pieces = shape.wall_parts(met)
    middles, lengths = shape.place(shape.starts + shape.lengths / 2)[1], shape.lengths
    if shape.curve is not None:
        first = np.unique(shape.parts, return_index=True)[1]
        lengths = np.bincount(shape.parts, lengths).astype(float)
        middles = shape.place(shape.starts[first] + lengths / 2)[1]
    origin = (
        np.zeros(2) if shape.cell is not None else (x.max(0) + x.min(0)) / 2 if len(middles) < 3 else middles.mean(0)
    )
    # (pieces of unequal length: their middles, weighted by length, have the table's own centre)
    if shape.cell is None and len(middles) >= 3:
        origin = (middles * lengths[:, None]).sum(0) / total
    angles = np.arctan2(*(middles - origin).T[::-1])
    found = [list(range(int(pieces.max()) + 1))]
    for sign in (1, -1):
        for angle in angles:
            turn = angle - sign * angles[0]
            image = (x - origin) * (1, sign) @ np.array(
                [[np.cos(turn), np.sin(turn)], [-np.sin(turn), np.cos(turn)]]
            ) + origin
            distance = np.linalg.norm(shape.folded(image[:, None] - x), axis=-1)
            nearest = distance.argmin(1)
            if distance.min(1).max() > total / SYMMETRY_POINTS:
                continue
            permuted = list(found[0])
            for k in set(pieces.tolist()):
                permuted[k] = int(np.bincount(pieces[nearest[pieces == k]]).argmax())
            if permuted not in found:
                found.append(permuted)
    return found


def family_key(
    pieces: list[int], symmetries: list[list[int]], winding: int, cells: tuple[int, int], magnetic: bool = False
) -> Any:
    """Return the itinerary up to where it begins, its direction and the table's symmetries, the winding and the cells passed.

    In a magnetic field orbits that wind one way and the other are different ones.
    """
    p = len(pieces)
    ways = []
    for permuted in symmetries:
        named = [permuted[k] for k in pieces]
        for way in (named, named[::-1]):
            ways += [way[k:] + way[:k] for k in range(p)]
    return min(ways), winding if magnetic else min(winding, p - winding), tuple(sorted(map(abs, cells)))


def windings(shell: EnergyShell, run: Orbit) -> list[int]:
    """Return how often each orbit runs around the boundary; -1 where this is not one closed curve."""
    shape = shell.setup.shape
    walls = shape.connected
    if len(walls) != 1 or not walls[0].closed or shape.cell is not None:
        return [-1] * len(run.t)
    length = float(shape.lengths.sum())
    forward = (np.roll(run.arc, -1, axis=1) - run.arc) % length
    return [round(turns) if math.isfinite(turns) else -1 for turns in forward.sum(1) / length]


def cells_passed(shell: EnergyShell, run: Orbit) -> list[tuple[int, int]]:
    """Return the cells that each orbit passes in x and y; zeros in a table that is not periodic."""
    cell = shell.setup.shape.cell
    if cell is None:
        return [(0, 0)] * len(run.t)
    sides = np.where(np.isfinite(cell), cell, np.inf)
    moved = np.nan_to_num((run.position[:, -1] - np.asarray(run.start.position)) / sides).round().astype(int)
    return [(int(x), int(y)) for x, y in moved]


# ----------------------------------------------------------------------------------------------------
# Periodic orbits by their itinerary: closed polygons of extremal length, with the mirror law; Newton's method from these.


LONGEST_STEP_ON_WALL = 0.1  # of the wall
SHORTEST_SHARE_ON_WALL = 1e-4  # of Newton's step
ROUNDING = 1e-13  # of the tangent map: so nearly must a polygon's state come back
SOFT = 1e-9  # second derivatives below it, 1/m, are those of a family: its members are extremal, too
MOST_CODES = 1_000_000


def codes(table: Table, period: int) -> list[str]:
    """Return the codes of a length that periodic orbits may have, each once up to where it begins.

    A flat wall or a round obstacle cannot follow itself, but for an obstacle and its image in a periodic cell; codes of obstacles
    alone do not repeat themselves. Which of the codes have an orbit, :func:`periodic_orbits` shows: the others are pruned.

    Parameters
    ----------
    table : Table
        In the plane, with at most 52 walls.
    period : int
        Number of bounces, 2 or more.

    Returns
    -------
    list of str

    Raises
    ------
    CaromError
        More than a million words to go through.

    Examples
    --------
    >>> from carom import billiards
    >>> [len(billiards.codes(billiards.discs(), p)) for p in range(2, 8)]
    [3, 2, 3, 6, 9, 18]
    """
    p = require_count("orbit", "period", period, 2)
    shape = orbit_setup(table, None, "mirror", None, "end").shape
    count = int(shape.parts.max(initial=-1)) + 1
    again, around = _meets_itself(shape)
    if not 0 < count <= 52 or count**p > MOST_CODES:
        expected = f"walls and a period with at most {MOST_CODES:,} words, and at most 52 walls"
        raise CaromError(Fault("codes", "period", expected, f"{count} walls and {p}"))
    found = set()
    for word in itertools.product(range(count), repeat=p):
        turns = [word[k:] + word[:k] for k in range(p)]
        once = len(set(turns)) == p or not all(around[k] for k in word)
        if word == min(turns) and once and all(a != b or again[a] for a, b in zip(word, turns[1], strict=True)):
            found.add(word)
    return [letters_of(word) for word in sorted(found)]


def _meets_itself(shape: Boundary) -> tuple[list[bool], list[bool]]:
    """Return which walls can be met twice in turn, and which are round obstacles: by part."""
    flat, outside = len(shape.faces), len(shape.faces) + len(shape.inside)
    first = [int(np.flatnonzero(shape.parts == part)[0]) for part in range(int(shape.parts.max()) + 1)]
    around = [outside <= k < outside + len(shape.outside) for k in first]
    return [k >= flat and (not one or bool(shape.images)) for k, one in zip(first, around, strict=True)], around


def orbits_with_code(shell: EnergyShell, code: list[int], first: Array, count: int) -> Array:
    """Return coordinates (M, 4) of the orbits with a code.

    They are found by Newton's method from ``count`` polygons with corners on these walls, and from the states ``first`` (N, 4).
    """
    p, shape = len(code), shell.setup.shape
    begin = _polygons(shell, code, count)
    if shell.free.stop == 4:
        y = solve_periodic(shell, np.concatenate([begin, first]), p)
    else:
        # (Newton's steps over a whole period are less exact than the polygons where multipliers are large)
        f, _df, matrix = shell.equations(begin, p)
        y = begin[residual(f) <= ROUNDING * (1 + np.abs(matrix).max(axis=(1, 2)))]
    if not len(y):
        return y
    met = shape.wall_parts(run_orbits(shell, y, p).piece)
    turns = {tuple(code[k:] + code[:k]) for k in range(p)}
    return y[[tuple(row.tolist()) in turns for row in met]]


def _polygons(shell: EnergyShell, code: list[int], count: int) -> Array:
    """Return coordinates (M, 4) of states that fly along closed polygons, which are of extremal length without spin and force."""
    shape = shell.setup.shape
    begins, sizes = shape.starts, shape.lengths
    rng = np.random.default_rng(0)
    s = np.empty((count, len(code)))
    for k, part in enumerate(code):
        pieces = np.flatnonzero(shape.parts == part)
        which = rng.choice(pieces, count, p=sizes[pieces] / sizes[pieces].sum())
        s[:, k] = begins[which] + rng.uniform(size=count) * sizes[which]
    # corners stay on their walls
    low, size = np.empty(len(code)), np.empty(len(code))
    for wall in shape.connected:
        on = [
            k
            for k, part in enumerate(code)
            if shape.parts[wall.pieces[0]] <= part and part in shape.parts[list(wall.pieces)]
        ]
        low[on], size[on] = wall.first, wall.last - wall.first
    if shell.free.stop < 4 and not shell.setup.table.has_force:
        s = _extremal(shape, s, low, size)
    _slope, _bend, _flight, u, t, n = _length_derivatives(shape, s)
    y = np.zeros((count, 4))
    y[:, 0] = s[:, 0] / shell.size
    rolls = np.sqrt(1.0 + float(shell.setup.ball.kappa)) if shell.setup.rolls else 1.0
    y[:, 1], y[:, 2] = (shell.speed / rolls * (u[:, 0] * one[:, 0]).sum(-1) for one in (t, n))
    return y[np.isfinite(y).all(1) & (y[:, 2] > 0)]


def _extremal(shape: Boundary, s: Array, low: Array, size: Array) -> Array:
    """Return polygons (N, p) of extremal length to which Newton's method leads; a step that makes one worse is shortened.

    Half of them go to the next extremum, half to the next minimum: around obstacles it is the only one that a ball can follow.
    """
    shortest = np.arange(len(s)) >= len(s) // 2
    share = np.ones(len(s))
    slope, bend, flight, *_rest = _length_derivatives(shape, s)
    worth = np.where(shortest, flight.sum(1), (slope**2).sum(1))
    for _ in range(ITERATIONS):
        sizes, axes = np.linalg.eigh(bend)
        sizes[shortest] = np.abs(sizes[shortest])
        sizes = np.where(np.abs(sizes) < SOFT, SOFT, sizes)
        step = -np.einsum("nij,nj,nkj,nk->ni", axes, 1 / sizes, axes, slope, optimize=True)
        most = np.abs(step / size).max(1)
        step *= (share * np.minimum(1.0, LONGEST_STEP_ON_WALL / np.maximum(most, 1e-300)))[:, None]
        trial = low + (s + step - low) % size
        slope2, bend2, flight2, *_rest = _length_derivatives(shape, trial)
        worth2 = np.where(shortest, flight2.sum(1), (slope2**2).sum(1))
        # (at the extremum itself lengths differ by rounding)
        better = (worth2 < worth) | ((slope2**2).sum(1) < (slope**2).sum(1)) & (worth2 < worth + 1e-13 * np.abs(worth))
        s, slope = np.where(better[:, None], trial, s), np.where(better[:, None], slope2, slope)
        bend, worth = np.where(better[:, None, None], bend2, bend), np.where(better, worth2, worth)
        share = np.where(better, np.minimum(1.0, 2 * share), share / 4)
        share = np.where(share < SHORTEST_SHARE_ON_WALL, 1.0, share)
    return s


def _length_derivatives(shape: Boundary, s: Array) -> tuple[Array, Array, Array, Array, Array, Array]:
    """Return slopes (N, p) and second derivatives (N, p, p) of the lengths of polygons by their corners' arc lengths (N, p).

    And the lengths (N, p) of their sides, the directions (N, p, 2) of these, and the tangents and normals at their corners.
    """
    count, p = s.shape
    piece, x, n = shape.place(s)
    t = np.stack([n[..., 1], -n[..., 0]], axis=-1)
    k = shape.curvatures(piece.ravel(), x.reshape(-1, 2)).reshape(s.shape)
    side = shape.folded(np.roll(x, -1, axis=1) - x)
    flight = np.maximum(np.linalg.norm(side, axis=-1), 1e-9 * shape.size)
    u = side / flight[..., None]
    before = np.roll(u, 1, axis=1)
    slope = (t * (before - u)).sum(-1)
    # tangents turn by k ds n; sides by their component across
    across, across_before = (1 - (t * one).sum(-1) ** 2 for one in (u, before))
    bend = np.zeros((count, p, p))
    i = np.arange(p)
    bend[:, i, i] = k * (n * (before - u)).sum(-1) + across / flight + across_before / np.roll(flight, 1, axis=1)
    next_t = np.roll(t, -1, axis=1)
    mixed = -((t * next_t).sum(-1) - (t * u).sum(-1) * (next_t * u).sum(-1)) / flight
    for one in range(p):
        bend[:, one, (one + 1) % p] += mixed[:, one]
        bend[:, (one + 1) % p, one] += mixed[:, one]
    return slope, bend, flight, u, t, n
