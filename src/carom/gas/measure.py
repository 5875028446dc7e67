"""What physicists measure of a gas: distributions, pair correlation, diffusion, temperatures over time.

:class:`Measures` looks at a gas as often as one likes, and knows the means over what it saw. What is counted at every
collision (rates, energies, pressure) is in :func:`carom.gas.channels` and :class:`carom.gas.GasRun`.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.polynomial import Polynomial
from numpy.typing import NDArray

from carom.checks import nearest
from carom.engine.swarm_arrays import PLANE
from carom.engine.swarm_run import balls_at
from carom.errors import CaromError
from carom.gas.container import Container, container
from carom.gas.run import Gas
from carom.gas.tally import count_pairs, count_spread, count_sums

__all__ = ["SERIES", "Displacement", "Distribution", "Measures", "PairCorrelation", "mean_square_displacement"]

Array = NDArray[np.float64]
BIN, BINS = 0.1, 120  # of the components, in standard deviations
GAP, GAPS = 60, 180  # bins of the gap between balls: so many to the smallest diameter, and at most so many in all
MOST_FOLLOWED = 8192  # balls, for diffusion
MOST_CENTERS = 8192  # balls from which pairs are counted at each look
LAGS = 24  # at which the displacements are told
# What a look adds to the series: temperatures and energy of height, a ball.
SERIES = ("time", "collisions", "translational", "rotational", "height")
COUNTED = ("velocities", "spins", "fourth", "second", "pairs", "expected", "looks", "pair_looks", "rows", "ways")


@dataclass(frozen=True, eq=False)
class Distribution:
    """The components of velocity or spin of a species, scaled by their standard deviation at each time."""

    center: Array
    """Of the bins, (B,), in standard deviations."""
    density: Array
    """Probability density, (B,)."""
    error: Array
    """Of the density, by the counts."""
    a2: float
    """The fourth cumulant, d <c^4> / ((d + 2) <c^2>^2) - 1 of d components: 0 for a Maxwellian."""

    @property
    def maxwell(self) -> Array:
        """The Maxwellian of the same width, (B,)."""
        density: Array = np.exp(-(self.center**2) / 2) / math.sqrt(2 * math.pi)
        return density


@dataclass(frozen=True, eq=False)
class Displacement:
    """Mean square displacement over a time, from every look on."""

    lag: Array
    square: Array
    axes: int

    @property
    def diffusion(self) -> float:
        """Diffusion coefficient: the slope of the later two thirds, over 2 d (Einstein); nan where there are too few."""
        late = self.lag >= self.lag.max(initial=0.0) / 3
        if late.sum() < 3 or not (self.square[late] > 0).all():
            return math.nan
        # the error of a mean square is a share of it
        line = Polynomial.fit(self.lag[late], self.square[late], 1, w=1 / self.square[late]).convert()
        return float(line.coef[1] / (2 * self.axes))


@dataclass(frozen=True, eq=False)
class PairCorrelation:
    """g(r) of two species: how much denser one is around the other than anywhere."""

    distance: Array
    """Of the centres, (B,): the middles of the bins."""
    g: Array
    error: Array
    """Of g, by the counts."""
    reach: float
    """Distance in contact."""

    @property
    def contact(self) -> float:
        """g in contact: a parabola through the logarithms of the bins within a quarter of the reach, weighted by the counts."""
        near = (self.distance < 1.25 * self.reach) & (self.g > 0)
        if near.sum() < 4:
            return math.nan
        weight = self.g[near] / self.error[near]
        fit = Polynomial.fit(self.distance[near] - self.reach, np.log(self.g[near]), 2, w=weight)
        return float(math.exp(fit(0.0)))


class Measures:
    """Looks at a gas, and the means over them.

    Parameters
    ----------
    gas : Gas
    names : names of its species; left out: "a", "b", ...
    room : what holds it; left out: a box, as periodic as it is

    Call :meth:`look` between pieces of a run, best at times at which nothing in particular happens: just after a collision
    two balls are always in contact.
    """

    def __init__(self, gas: Gas, names: tuple[str, ...] = (), room: Container | None = None) -> None:
        self._about(gas, names, room)
        kinds = len(self.names)
        self.velocities, self.spins = np.zeros((kinds, BINS), np.int64), np.zeros((kinds, BINS), np.int64)
        # sums over the looks of d <c^4> / ((d + 2) <c^2>^2), and of the temperatures, of velocities and of spins
        self.fourth, self.second = np.zeros((kinds, 2)), np.zeros((kinds, 2))
        self.pairs = np.zeros((kinds, kinds, self.bins), np.int64)
        self.expected = np.zeros((kinds, kinds))  # sums of balls looked from, times density of those looked for
        self.looks = self.pair_looks = 0
        self.rows: list[tuple[float, ...]] = []
        self.ways: list[Array] = []  # of the balls followed, at each look

    def _about(self, gas: Gas, names: tuple[str, ...], room: Container | None) -> None:
        """What does not change: species, lengths."""
        kinds, one = gas._arrays.species, gas._arrays.swarm[0]
        self.names = names or tuple(chr(ord("a") + k) for k in range(len(kinds)))
        self.axes, self.spin_axes = (3, 3) if int(one["axes"]) == 3 else (2, 1)
        self.mass, self.radius = kinds["mass"].copy(), kinds["radius"].copy()
        self.moment = kinds["kappa"] * kinds["mass"] * kinds["radius"] ** 2
        self.side, self.around = one["side"].copy(), one["periodic"] == 1
        self.around[self.axes :] = False
        size, closed = self.side[: self.axes], self.around[: self.axes]
        self.room = room or container("box", size.tolist(), periodic=closed.tolist())
        # no further than half a period; within walls no further than a quarter: balls nearer to one are not looked from
        bound = float(np.where(closed, size / 2, size / 4).min())
        self.width = float(2 * self.radius.min() / GAP)
        self.bins = max(min(int((bound - 2 * self.radius.max()) / self.width), GAPS), 0)
        self.reach = float(2 * self.radius.max()) + self.width * self.bins
        self.inner = _volume_within(self.room, self.reach)

    # --- looking -----------------------------------------------------------------------------------------------

    def look(self, gas: Gas, *, pairs: bool = True) -> None:
        """Count what there is to count now; the pairs, if they are wanted, take the most time."""
        motions, bodies, images = balls_at(gas._arrays, gas.time)
        # (fourth powers of what has cooled for long would leave the range of numbers)
        units = np.array([_to_unit(motions, ("vx", "vy", "vz")), _to_unit(bodies, ("wx", "wy", "wz"))])
        sums = count_sums(motions, bodies, len(self.names))
        count = sums[:, :1]
        # mean squares of the components, of velocities and of spins
        square = sums[:, [1, 3]] / (count * (self.axes, self.spin_axes))
        moves = square > 0
        scale, fourth = np.zeros_like(square), np.zeros_like(square)
        scale[moves] = 1 / (BIN * np.sqrt(square[moves]))
        # <c^4> of a Maxwellian with d components is d (d + 2) times the square of theirs
        of = np.array([self.axes, self.spin_axes])
        fourth[moves] = (sums[:, [2, 4]] / count / (of * (of + 2)))[moves] / square[moves] ** 2
        count_spread(motions, bodies, self.axes, scale, self.velocities, self.spins)
        heat = square * units**2 * np.stack([self.mass, self.moment], axis=1)
        self.fourth += fourth
        self.second += heat
        mass, number = self.mass[motions["kind"]], len(motions)
        x = _positions(motions)
        height = -float((mass @ x) @ gas._arrays.swarm[0]["pull"])
        self.rows.append(
            (gas.time, float(gas.collisions), *map(float, (count * heat).sum(axis=0) / number), height / number)
        )
        if self.diffuses:
            x += images * self.side
            followed = np.arange(min(number, MOST_FOLLOWED)) * number // min(number, MOST_FOLLOWED)
            self.ways.append((x[followed] - mass @ x / mass.sum())[:, : self.axes])
        self.looks += 1
        if pairs and self.bins > 0 and self.inner > 0:
            self._count_pairs(motions)

    def _count_pairs(self, motions: Any) -> None:
        x, kinds = _positions(motions), len(self.names)
        inner = np.flatnonzero(self.room.clearance(np.zeros(len(x)), x) >= self.reach)
        inside = np.bincount(motions["kind"][inner], minlength=kinds)
        # of many balls some, others at each look
        step = max(len(inner) / MOST_CENTERS, 1.0)
        chosen = inner[((np.arange(min(len(inner), MOST_CENTERS)) + self.pair_looks / 7 % 1) * step).astype(int)]
        # in a period a ball has all but itself around it
        itself = np.eye(kinds) if self.diffuses else np.zeros((kinds, kinds))
        centers = np.bincount(motions["kind"][chosen], minlength=kinds)
        self.expected += centers[:, None] * (inside[None, :] - itself) / self.inner
        count_pairs(x, motions["kind"], chosen, self.radius, self.side, self.around, self.reach, self.width, self.pairs)
        self.pair_looks += 1

    # --- means -------------------------------------------------------------------------------------------------

    def _kind(self, name: str) -> int:
        if name not in self.names:
            raise CaromError(f"Measures: expected a species, got {name!r}; {nearest(name, list(self.names))}")
        return self.names.index(name)

    def velocity(self, name: str) -> Distribution:
        """The distribution of the components of a species' velocities."""
        return self._distribution(self.velocities[self._kind(name)], self.fourth[self._kind(name), 0])

    def spin(self, name: str) -> Distribution:
        """The distribution of the components of a species' spins; of discs, of the one that they have."""
        return self._distribution(self.spins[self._kind(name)], self.fourth[self._kind(name), 1])

    def _distribution(self, counts: NDArray[np.int64], fourth: float) -> Distribution:
        total = max(int(counts.sum()), 1)
        center: Array = np.linspace(0.5 - BINS / 2, BINS / 2 - 0.5, BINS) * BIN
        a2 = fourth / self.looks - 1 if counts.any() else math.nan
        density: Array = counts.astype(float) / (total * BIN)
        error: Array = np.sqrt(density / (total * BIN))
        return Distribution(center, density, error, float(a2))

    def temperature(self, name: str) -> tuple[float, float]:
        """Mean translational and rotational temperature of a species."""
        translational, rotational = self.second[self._kind(name)] / max(self.looks, 1)
        return float(translational), float(rotational)

    def pair_correlation(self, one: str, two: str) -> PairCorrelation:
        """g(r) of two species, or of one with itself."""
        i, j = self._kind(one), self._kind(two)
        reach = float(self.radius[i] + self.radius[j])
        edges = reach + self.width * np.arange(self.bins + 1)
        unit = math.pi if self.axes == 2 else 4 / 3 * math.pi
        shells = unit * np.diff(edges**self.axes)
        counts, expected = self.pairs[i, j], float(self.expected[i, j])
        if i != j:
            counts, expected = counts + self.pairs[j, i], expected + float(self.expected[j, i])
        scale = 1 / (shells * expected) if expected > 0 else np.full(self.bins, np.nan)
        # every pair was seen from both sides, but for those of which one ball was near a wall
        return PairCorrelation((edges[1:] + edges[:-1]) / 2, counts * scale, np.sqrt(2 * counts) * scale, reach)

    @property
    def series(self) -> dict[str, Array]:
        """What each look saw, by the names in SERIES: temperatures and energy of height a ball, mean square displacement."""
        table = np.array(self.rows).reshape(-1, len(SERIES))
        return {name: table[:, k] for k, name in enumerate(SERIES)}

    @property
    def diffuses(self) -> bool:
        """Whether balls can go anywhere: only in a period without walls does a diffusion coefficient mean what it says."""
        return not self.room.walls

    @property
    def steady(self) -> bool:
        """Whether the gas stayed as warm as it was, within a factor of two: only then is one time as good as another."""
        warm = self.series["translational"]
        return bool(len(warm) == 0 or warm.max() <= 2 * warm.min())

    def wandering(self) -> tuple[Array, Array]:
        """Collisions of the gas since the first look, and the mean square distance of its balls from where they were then.

        This is the mean square displacement of a gas that cools: its balls go about as far between two collisions, however
        long that takes.
        """
        ways, hits = np.array(self.ways), self.series["collisions"]
        return hits - hits[:1], ((ways - ways[:1]) ** 2).sum(axis=2).mean(axis=1)

    def displacement(self) -> Displacement:
        """Mean square displacement of up to 8192 balls, the centre of mass at rest, averaged over all pairs of looks.

        Lags go up to half of the time between the first look and the last; longer ones have few starts.
        """
        ways, t = self.ways, self.series["time"]
        found = [
            (t[j] - t[i], float(((ways[j] - ways[i]) ** 2).sum(axis=1).mean()))
            for i in range(len(ways))
            for j in range(i + 1, len(ways))
            if t[j] - t[i] <= (t[-1] - t[0]) / 2
        ]
        table = np.array(found).reshape(-1, 2)
        longest = float(table[:, 0].max(initial=0.0))
        place = np.minimum((table[:, 0] / (longest or 1.0) * LAGS).astype(int), LAGS - 1)
        count = np.bincount(place, minlength=LAGS)
        sums = [np.bincount(place, table[:, k], LAGS)[count > 0] / count[count > 0] for k in range(2)]
        return Displacement(sums[0], sums[1], self.axes)

    # --- kept --------------------------------------------------------------------------------------------------

    def state(self) -> dict[str, NDArray[Any]]:
        """All that was counted, as arrays."""
        return {name: np.array(getattr(self, name)) for name in COUNTED}

    @classmethod
    def restore(
        cls, gas: Gas, names: tuple[str, ...], room: Container | None, state: dict[str, NDArray[Any]]
    ) -> Measures:
        """The measures of :meth:`state`, to go on with."""
        found = object.__new__(cls)
        found._about(gas, names, room)
        for name in COUNTED:
            setattr(found, name, state[name].copy())
        found.looks, found.pair_looks = int(state["looks"]), int(state["pair_looks"])
        found.rows = [tuple(row) for row in state["rows"].reshape(-1, len(SERIES)).tolist()]
        found.ways = list(state["ways"])
        return found


def _to_unit(records: Any, names: tuple[str, ...]) -> float:
    """Scale components so that the largest is between 1/2 and 1, by a power of two, which is exact; what one of them then is."""
    largest = max(float(np.abs(records[name]).max()) for name in names)
    unit = math.ldexp(1.0, math.frexp(largest)[1])
    for name in names:
        records[name] /= unit
    return unit


def _positions(motions: Any) -> Array:
    return np.stack([motions[axis] for axis in "xyz"], axis=1)


def _volume_within(room: Container, depth: float) -> float:
    """Volume of the places at least so deep within a room: of boxes exactly, of others by a grid of a million points."""
    axes, size = len(room.size), np.array(room.size)
    if not room.walls:
        return float(size.prod())
    if room.shape == "box" and all(wall.form == PLANE for wall in room.walls):
        return float(np.maximum(np.where(room.periodic, size, size - 2 * depth), 0).prod())
    n = round(1e6 ** (1 / axes))
    steps = [(np.arange(n) + 0.5) / n] * axes
    x = np.zeros((n**axes, 3))
    x[:, :axes] = np.stack(np.meshgrid(*steps, indexing="ij"), axis=-1).reshape(-1, axes) * size
    return float(size.prod() * (room.clearance(np.zeros(len(x)), x) >= depth).mean())


def mean_square_displacement(positions: Array, masses: Array | None = None) -> Array:
    """Mean square displacement over 0, 1, 2... frames, from every frame on: (F,) of unwrapped positions (F, N, 3).

    The centre of mass of each frame is taken out. The more frames apart, the fewer starts there are to average over.
    """
    x = np.array(positions, dtype=float)
    weight = np.ones(x.shape[1]) if masses is None else np.asarray(masses, dtype=float)
    x -= (weight[:, None] * x).sum(axis=1, keepdims=True) / weight.sum()
    found = [0.0] + [float(((x[k:] - x[:-k]) ** 2).sum(axis=2).mean()) for k in range(1, len(x))]
    return np.array(found)
