"""Measures of a gas: velocity distributions, pair correlation, diffusion, temperatures over time.

:class:`Measures` samples a gas and returns means over its samples. What is counted at every collision (rates, energies, pressure)
is in :func:`carom.gas.channels` and :class:`carom.gas.GasRun`.
"""

from __future__ import annotations

import functools
import math
from collections.abc import Callable
from dataclasses import dataclass, fields
from typing import Any, NamedTuple

import numpy as np
from numpy.polynomial import Polynomial
from numpy.typing import NDArray

from carom.core.jit.kernel import hot_kernel
from carom.errors import CaromError, Fault, FaultList, require_count, suggestion
from carom.gas import containers
from carom.gas.containers import Container
from carom.gas.edmd.driver import synchronized
from carom.gas.gas import Gas
from carom.gas.results import LayerAverages, Profile, Profiles, layers, volume_within
from carom.gas.species import cells_at_most
from carom.public.progress import Progress

Array = NDArray[np.float64]
FIT_STEPS, LARGEST_LOG = 50, 30.0  # of the fit of g at contact
MAX_LOG_ERROR = 0.25  # of log g at contact: with fewer pairs it is not given


@dataclass(frozen=True, eq=False)
class Distribution:
    """Distribution of the velocity or spin components of a species, in units of their standard deviation at each time."""

    center: Array
    """Middles of the bins, (B,), in standard deviations."""
    density: Array
    """Probability density, (B,)."""
    error: Array
    """Statistical error of the density, from the counts, (B,)."""
    a2: float
    """The fourth cumulant of d components, d <c^4> / ((d + 2) <c^2>^2) - 1: 0 for a Maxwellian."""

    @property
    def maxwell(self) -> Array:
        """Return the Maxwellian of the same width, (B,)."""
        density: Array = np.exp(-(self.center**2) / 2) / math.sqrt(2 * math.pi)
        return density


@dataclass(frozen=True, eq=False)
class Displacement:
    """Mean square displacement as a function of the lag time, averaged over starting times."""

    lag: Array
    square: Array
    dimensions: int

    @property
    def diffusion(self) -> float:
        """Diffusion coefficient in d dimensions: slope of the later two thirds over 2 d (Einstein); nan with too few lags."""
        late = self.lag >= self.lag.max(initial=0.0) / 3
        if late.sum() < 3 or not (self.square[late] > 0).all():
            return math.nan
        # the error of a mean square is proportional to it
        line = Polynomial.fit(self.lag[late], self.square[late], 1, w=1 / self.square[late]).convert()
        return float(line.coef[1] / (2 * self.dimensions))


@dataclass(frozen=True)
class Outflow:
    """Balls that left a gas through a periodic border along gravity, and came in again on the other side."""

    axis: str
    """Along which they fall: "x", "y" or "z"."""
    balls: int
    """How many more went with gravity than against it."""
    time: float
    """In which they did (s)."""

    @property
    def rate(self) -> float:
        """Balls per unit time (1/s)."""
        return self.balls / self.time if self.time > 0 else math.nan

    def to_dict(self) -> dict[str, str | float]:
        """Return axis, balls, time and rate."""
        return {"axis": self.axis, "balls": self.balls, "time": self.time, "rate": self.rate}


@dataclass(frozen=True, eq=False)
class PairCorrelation:
    """Pair correlation function g(r) of two species."""

    distance: Array
    """Distances of the centres, (B,): the middles of the bins."""
    g: Array
    error: Array
    """Statistical error of g, from the counts, (B,)."""
    contact_distance: float
    """Distance of the centres in contact."""

    one_pair: Array
    """g of one counted pair, (B,)."""

    @property
    def contact(self) -> float:
        """g at contact: a parabola for log g up to 1.25 contact distances, of greatest likelihood; nan with too few pairs."""
        return self._at_contact()[0]

    @property
    def contact_error(self) -> float:
        """Standard error of :attr:`contact`, from the counts; nan with too few pairs."""
        return self._at_contact()[1]

    def _at_contact(self) -> tuple[float, float]:
        """Return g at contact and its standard error.

        The counts are those of Poisson's distribution, each pair counted twice. Weights follow from the fitted curve: those of the
        counts themselves would prefer bins that have more than their share.
        """
        near = self.distance < 1.25 * self.contact_distance
        g, unit = self.g[near], self.one_pair[near]
        if (g > 0).sum() < 4:
            return math.nan, math.nan
        powers = np.vander(self.distance[near] / self.contact_distance - 1, 3, increasing=True)
        log, rows, factors = np.full(len(g), math.log(g.mean())), powers, np.zeros(3)
        for _ in range(FIT_STEPS):  # Newton's
            weight = np.sqrt(np.exp(log) / (2 * unit))
            rows = powers * weight[:, None]
            factors = np.linalg.lstsq(rows, weight * (log + g * np.exp(-log) - 1), rcond=None)[0]
            log, before = np.clip(powers @ factors, -LARGEST_LOG, LARGEST_LOG), log
            if np.abs(log - before).max() < 1e-12:
                break
        value, error = math.exp(factors[0]), math.sqrt(np.linalg.inv(rows.T @ rows)[0, 0])
        # (an exponential of so uncertain a logarithm is biased, and far from normally distributed)
        return (value, value * error) if error < MAX_LOG_ERROR else (math.nan, math.nan)


# ----------------------------------------------------------------------------------------------------
# Sums, component histograms and pair histograms over the balls of a gas: compiled loops over the engine's records.


# Of each species: the number of balls, and the sums of v^2, v^4, w^2, w^4, and of the components of v.
SUMS = ("count", "v2", "v4", "w2", "w4", "vx", "vy", "vz")


class _CompiledCounts(NamedTuple):
    sums: Callable[..., Any]
    spread: Callable[..., Any]
    pairs: Callable[..., Any]


@functools.cache
def compiled_loops() -> _CompiledCounts:
    """Return the compiled sums and histograms."""
    from carom.core.jit.compile import njit

    return _CompiledCounts(
        *(njit(loop, nogil=True) for loop in (_species_sums, _component_histograms, _pair_histogram))
    )


def species_sums(motions: Any, bodies: Any, kinds: int) -> Array:
    """Return sums over the balls of each species, (species, 8), in the order of SUMS."""
    sums = np.zeros((kinds, len(SUMS)))
    compiled_loops().sums(motions, bodies, sums)
    return sums


def add_component_histograms(motions: Any, bodies: Any, axes: int, scale: Array, velocities: Any, spins: Any) -> None:
    """Add the components of velocity and spin, times ``scale`` (species, 2), to histograms (species, bins) centred on zero.

    The bins have width 1; a species with scale zero is skipped. Discs have two components of velocity and one of spin.
    """
    compiled_loops().spread(motions, bodies, axes, scale, velocities, spins)


def add_pair_histograms(
    x: Array, kind: Any, chosen: Any, radius: Array, side: Array, periodic: Any, reach: float, width: float, pairs: Any
) -> None:
    """Add the pairs of a ball in ``chosen`` and any other to histograms (species, species, bins) of the gap between them.

    ``x`` is (N, 3), ``kind`` the species, ``chosen`` indices of balls, ``periodic`` by axis. The bins have a ``width``; ``reach``
    is the largest distance of centres that is counted, at most half of a periodic side.
    """
    # cells of at least reach; of fewer than 3 along a periodic axis all are searched, once
    n = np.array(cells_at_most((side / reach).tolist(), len(x)), np.int64)
    place = np.clip((x / (side / n)).astype(np.int64), 0, n - 1)
    cell = (place[:, 2] * n[1] + place[:, 1]) * n[0] + place[:, 0]
    order = np.argsort(cell, kind="stable")
    first = np.concatenate([[0], np.cumsum(np.bincount(cell, minlength=int(n.prod())))])
    # sorted by cell
    rows, kinds, here = np.ascontiguousarray(x[order].T), kind[order].astype(np.int64), np.argsort(order)[chosen]
    compiled_loops().pairs(
        rows, kinds, here, place[chosen], radius, side, periodic, n, first, reach * reach, width, pairs,
        np.zeros(3, np.int64), np.zeros(3, np.int64),
    )  # fmt: skip


def _species_sums(motions: Any, bodies: Any, sums: Any) -> None:
    for i in range(motions.shape[0]):
        ball, body = motions[i], bodies[i]
        k = ball.species
        v = ball.vx * ball.vx + ball.vy * ball.vy + ball.vz * ball.vz
        w = body.wx * body.wx + body.wy * body.wy + body.wz * body.wz
        sums[k, 0] += 1
        sums[k, 1] += v
        sums[k, 2] += v * v
        sums[k, 3] += w
        sums[k, 4] += w * w
        sums[k, 5] += ball.vx
        sums[k, 6] += ball.vy
        sums[k, 7] += ball.vz


@hot_kernel
def _count_value(histogram: Any, k: int, x: float) -> None:
    """Count x in row k of a histogram with bins of width 1 centred on zero."""
    place = x + histogram.shape[1] / 2
    if 0 <= place < histogram.shape[1]:
        histogram[k, int(place)] += 1


def _component_histograms(motions: Any, bodies: Any, axes: int, scale: Any, velocities: Any, spins: Any) -> None:
    for i in range(motions.shape[0]):
        ball, body = motions[i], bodies[i]
        k = ball.species
        s = scale[k, 0]
        if s > 0:
            _count_value(velocities, k, ball.vx * s)
            _count_value(velocities, k, ball.vy * s)
            if axes == 3:
                _count_value(velocities, k, ball.vz * s)
        s = scale[k, 1]
        if s > 0:
            if axes == 3:
                _count_value(spins, k, body.wx * s)
                _count_value(spins, k, body.wy * s)
            _count_value(spins, k, body.wz * s)


@hot_kernel
def _nearest_image(r: float, side: float, periodic: bool) -> float:
    """Return a coordinate difference, between nearest images if the axis is periodic."""
    if not periodic:
        return r
    if r > side / 2:
        return r - side
    return r + side if r < -side / 2 else r


def _pair_histogram(
    x: Any, kind: Any, chosen: Any, place: Any, radius: Any, side: Any, periodic: Any, n: Any, first: Any, reach2: float,
    width: float, pairs: Any, low: Any, high: Any,
) -> None:  # fmt: skip
    """Count pairs; ``low`` and ``high`` (3,) are room for the cells around one."""
    bins = pairs.shape[2]
    for k in range(chosen.shape[0]):
        i = chosen[k]
        for axis in range(3):
            low[axis], high[axis] = place[k, axis] - 1, place[k, axis] + 1
            if periodic[axis] and n[axis] < 3:
                low[axis], high[axis] = 0, n[axis] - 1
            elif not periodic[axis]:
                low[axis], high[axis] = max(low[axis], 0), min(high[axis], n[axis] - 1)
        for cz in range(low[2], high[2] + 1):
            for cy in range(low[1], high[1] + 1):
                for cx in range(low[0], high[0] + 1):
                    cell = ((cz % n[2]) * n[1] + cy % n[1]) * n[0] + cx % n[0]
                    for j in range(first[cell], first[cell + 1]):
                        rx = _nearest_image(x[0, i] - x[0, j], side[0], periodic[0])
                        ry = _nearest_image(x[1, i] - x[1, j], side[1], periodic[1])
                        rz = _nearest_image(x[2, i] - x[2, j], side[2], periodic[2])
                        r2 = rx * rx + ry * ry + rz * rz
                        if r2 < reach2 and j != i:
                            gap = math.sqrt(r2) - (radius[kind[i]] + radius[kind[j]])
                            bin_ = max(int(gap / width), 0)
                            if bin_ < bins:
                                pairs[kind[i], kind[j], bin_] += 1


# ----------------------------------------------------------------------------------------------------
# Measures of a gas: velocity distributions, pair correlation, diffusion, temperatures over time.


BIN_WIDTH, BINS = 0.1, 120  # of the components, in standard deviations
GAP_BINS_PER_DIAMETER, MAX_GAP_BINS = 60, 180  # of the gap between balls: per smallest diameter, and in all
MAX_FOLLOWED = 8192  # balls, for diffusion
MAX_CENTERS = 8192  # balls around which pairs are counted in one sample
LAGS = 24  # at which the mean square displacement is given
# What a sample adds to the series: time, collisions so far, temperatures, the potential energy per ball, and how many balls more
# have crossed a periodic border along gravity than against it (:attr:`Measures.flow_axis`).
SERIES = ("time", "collisions", "translational", "rotational", "height", "passed")


class Measures:
    """Samples of a gas, and means over them.

    Parameters
    ----------
    gas : Gas
    names : names of its species (of radii by distribution, too, one each); default: "a", "b", ...
    container : what holds it; default: a box with the same periodic axes

    Call :meth:`sample` between pieces of a run, at times that do not depend on the collisions: just after a collision two balls are
    always in contact.

    Examples
    --------
    >>> from carom import Ball, Surface
    >>> from carom.gas import Gas, Measures, Species
    >>> gas = Gas([Species(Ball(0.5, 1.0), 200)], (8.0, 8.0, 8.0), contacts=Surface(1, 0, -1), seed=1)
    >>> gas.advance(4000)
    >>> measures, start = Measures(gas), gas.time
    >>> for k in range(20):
    ...     gas.advance(until=start + k)
    ...     measures.sample(gas)
    >>> abs(measures.velocity("a").a2) < 0.05  # nearly Maxwellian
    True
    >>> round(measures.temperature("a")[0], 6)
    1.0
    >>> 1.5 < measures.pair_correlation("a", "a").contact < 2.5
    True
    """

    def __init__(self, gas: Gas, names: tuple[str, ...] = (), container: Container | None = None) -> None:
        self._set_constants(gas, names, container)
        kinds = len(self.names)
        self.velocity_counts, self.spin_counts = np.zeros((kinds, BINS), np.int64), np.zeros((kinds, BINS), np.int64)
        # sums over the samples of d <c^4> / ((d + 2) <c^2>^2), of velocities and of spins
        self.fourth_moments = np.zeros((kinds, 2))
        self.temperatures: list[Array] = []  # of each species, translational and rotational, at each sample
        self.pair_counts = np.zeros((kinds, kinds, self.bins), np.int64)
        self.expected_pairs = np.zeros((kinds, kinds))  # sums of central balls times the density of the others
        self.samples = self.pair_samples = 0
        self.rows: list[tuple[float, ...]] = []
        self.followed: list[Array] = []  # positions of the balls followed, at each sample

    def _set_constants(self, gas: Gas, names: tuple[str, ...], container: Container | None) -> None:
        """Set what does not change: species, lengths."""
        kinds, one = gas.arrays.materials.species, gas.arrays.system[0]
        self.groups = gas.groups
        species = int(self.groups.max()) + 1
        self.names = names or tuple(chr(ord("a") + k) for k in range(species))
        self.dimensions, self.spin_components = (3, 3) if int(one["dimensions"]) == 3 else (2, 1)
        # of each class of radii; of each species: means over its balls
        self.class_mass, self.class_radius = kinds["mass"].copy(), kinds["radius"].copy()
        self.class_moment = kinds["kappa"] * kinds["mass"] * kinds["radius"] ** 2
        of_class = np.bincount(gas.arrays.balls.motions["species"], minlength=len(kinds))
        count = np.bincount(self.groups, of_class, species)
        self.class_shares = of_class / np.maximum(count, 1)[self.groups]
        self.mass, self.radius, self.moment = (
            one.copy()
            if species == len(kinds)
            else np.bincount(self.groups, of_class * one, species) / np.maximum(count, 1)
            for one in (self.class_mass, self.class_radius, self.class_moment)
        )
        self.side, self.periodic = one["side"].copy(), one["periodic"] == 1
        self.periodic[self.dimensions :] = False
        along = np.abs(one["gravity"]) * self.periodic
        self.flow_axis = int(np.argmax(along)) if along.any() else -1  # periodic, along which balls fall
        size, closed = self.side[: self.dimensions], self.periodic[: self.dimensions]
        self.container = container or containers.container("box", size.tolist(), periodic=closed.tolist())
        # no further than half a period; within walls no further than a quarter: balls near a wall are no central balls
        bound = float(np.where(closed, size / 2, size / 4).min())
        self.width = float(2 * self.class_radius.min() / GAP_BINS_PER_DIAMETER)
        self.sheared = gas.shear_rate != 0
        self.bins = (
            0 if self.sheared else max(min(int((bound - 2 * self.class_radius.max()) / self.width), MAX_GAP_BINS), 0)
        )
        self.reach = float(2 * self.class_radius.max()) + self.width * self.bins
        self.profiles, self.depth = None, self.reach
        if self.container.faces:
            faces = gas.arrays.walls.faces
            drives = (faces["amplitude"] > 0) | (faces["temperature"] >= 0) | (faces["mass"] > 0)
            driven = {name for name, k in zip(gas.faces, drives, strict=True) if k}
            gravity = one["gravity"].tolist()
            if layers(self.container, gravity, driven)[1]:  # what is counted around a ball is where centres can be
                self.depth += float(self.class_radius.max())
            self.profiles = Profiles(self.container, gravity, driven, self.mass, int(count.sum()), self.depth)
        self.inner = volume_within(self.container, self.depth)

    # --- sampling ----------------------------------------------------------------------------------------------

    def sample(self, gas: Gas, *, pairs: bool = True) -> None:
        """Add a sample of the gas as it is now; counting the pairs, which is optional, takes the most time."""
        motions, bodies, images = synchronized(gas.arrays, gas.time)
        if self.sheared:  # velocities are relative to the flow
            motions["vx"] -= gas.shear_rate * (motions["y"] - self.side[1] / 2)
        of_class = motions["species"].copy()
        mass = self.class_mass[of_class]
        if len(self.names) < len(self.class_mass):
            self._join_classes(motions, bodies)
        # (fourth powers of the speeds of a gas that has cooled for long would underflow)
        units = np.array([_scale_to_unit(motions, ("vx", "vy", "vz")), _scale_to_unit(bodies, ("wx", "wy", "wz"))])
        sums = species_sums(motions, bodies, len(self.names))
        count = sums[:, :1]
        # mean squares of the components, of velocities and of spins
        square = sums[:, [1, 3]] / (count * (self.dimensions, self.spin_components))
        moves = square > 0
        scale, fourth = np.zeros_like(square), np.zeros_like(square)
        scale[moves] = 1 / (BIN_WIDTH * np.sqrt(square[moves]))
        # <c^4> of a Maxwellian with d components is d (d + 2) times the square of theirs
        of = np.array([self.dimensions, self.spin_components])
        fourth[moves] = (sums[:, [2, 4]] / count / (of * (of + 2)))[moves] / square[moves] ** 2
        add_component_histograms(motions, bodies, self.dimensions, scale, self.velocity_counts, self.spin_counts)
        heat = square * units**2 * np.stack([self.mass, self.moment], axis=1)
        self.fourth_moments += fourth
        self.temperatures.append(heat)
        number = len(motions)
        x = _positions(motions)
        height = -float((mass @ x) @ gas.arrays.system[0]["gravity"])
        axis, pull = self.flow_axis, gas.arrays.system[0]["gravity"]
        passed = 0.0 if axis < 0 else float(images[:, axis].sum() * np.sign(pull[axis]))
        warm = map(float, (count * heat).sum(axis=0) / number)
        self.rows.append((gas.time, float(gas.collisions), *warm, height / number, passed))
        if self.has_diffusion:
            x += images * self.side
            followed = np.arange(min(number, MAX_FOLLOWED)) * number // min(number, MAX_FOLLOWED)
            self.followed.append((x[followed] - mass @ x / mass.sum())[:, : self.dimensions])
        if self.profiles is not None:
            self.profiles.add(motions, float(units[0]))
        self.samples += 1
        if pairs and self.bins > 0 and self.inner > 0:
            self._count_pairs(motions, of_class)

    def _join_classes(self, motions: Any, bodies: Any) -> None:
        """Give balls the numbers of their species, and velocities and spins with which the mean mass has their energy."""
        of_class = motions["species"].copy()
        groups = self.groups[of_class]
        by_mass = np.sqrt(self.class_mass[of_class] / self.mass[groups])
        by_moment = np.sqrt(self.class_moment[of_class] / self.moment[groups])
        for name in ("x", "y", "z"):
            motions["v" + name] *= by_mass
            bodies["w" + name] *= by_moment
        motions["species"] = groups

    def _count_pairs(self, motions: Any, of_class: Any) -> None:
        x, kinds = _positions(motions), len(self.names)
        inner = np.flatnonzero(self.container.clearance(np.zeros(len(x)), x) >= self.depth)
        inside = np.bincount(motions["species"][inner], minlength=kinds)
        # of many balls some, and others in each sample
        step = max(len(inner) / MAX_CENTERS, 1.0)
        chosen = inner[((np.arange(min(len(inner), MAX_CENTERS)) + self.pair_samples / 7 % 1) * step).astype(int)]
        # in a periodic box a ball has all others around it
        itself = np.eye(kinds) if self.has_diffusion else np.zeros((kinds, kinds))
        centers = np.bincount(motions["species"][chosen], minlength=kinds)
        self.expected_pairs += centers[:, None] * (inside[None, :] - itself) / self.inner
        joined = kinds < len(self.class_mass)
        counts = np.zeros((*2 * (len(self.class_mass),), self.bins), np.int64) if joined else self.pair_counts
        add_pair_histograms(
            x, of_class, chosen, self.class_radius, self.side, self.periodic, self.reach, self.width, counts
        )
        if joined:
            np.add.at(self.pair_counts, (self.groups[:, None], self.groups[None, :]), counts)
        self.pair_samples += 1
        if self.profiles is not None:
            self.profiles.add_centers(motions[chosen])

    # --- means -------------------------------------------------------------------------------------------------

    def _kind(self, name: str) -> int:
        if name not in self.names:
            raise CaromError(Fault("Measures", "", "a species", repr(name), suggestion(name, list(self.names))))
        return self.names.index(name)

    def velocity(self, name: str) -> Distribution:
        """Return the distribution of the velocity components of a species."""
        return self._distribution(self.velocity_counts[self._kind(name)], self.fourth_moments[self._kind(name), 0])

    def spin(self, name: str) -> Distribution:
        """Return the distribution of the spin components of a species; discs have one."""
        return self._distribution(self.spin_counts[self._kind(name)], self.fourth_moments[self._kind(name), 1])

    def _distribution(self, counts: NDArray[np.int64], fourth: float) -> Distribution:
        total = max(int(counts.sum()), 1)
        center: Array = np.linspace(0.5 - BINS / 2, BINS / 2 - 0.5, BINS) * BIN_WIDTH
        a2 = fourth / self.samples - 1 if counts.any() else math.nan
        density: Array = counts.astype(float) / (total * BIN_WIDTH)
        error: Array = np.sqrt(density / (total * BIN_WIDTH))
        return Distribution(center, density, error, float(a2))

    def temperature(self, name: str) -> tuple[float, float]:
        """Return the translational and rotational temperature of a species (J), means over the time between the samples."""
        translational, rotational = self._mean_temperatures()[self._kind(name)]
        return float(translational), float(rotational)

    def _mean_temperatures(self) -> Array:
        """Return the mean temperatures (species, 2) over the time from the first sample to the last.

        Where a gas cools, samples at equal numbers of collisions are ever farther apart: so each one stands for its time.
        """
        if self.samples == 0:
            return np.full((len(self.names), 2), math.nan)
        found, t = np.array(self.temperatures), self.series["time"]
        mean: Array = found[-1] if t[-1] == t[0] else np.trapezoid(found, t, axis=0) / (t[-1] - t[0])
        return mean

    def pair_correlation(self, one: str, two: str) -> PairCorrelation:
        """Return g(r) of two species, or of one with itself.

        It is relative to the mean density of the balls far from the walls or, where the gas :attr:`is_layered`, to the mean
        density of those far from the side walls in each slice of the :meth:`profile`. Where radii differ within a species it is a
        function of the gap between two balls, given at this gap beyond their mean distance in contact.
        """
        i, j = self._kind(one), self._kind(two)
        reach = float(self.radius[i] + self.radius[j])
        steps = self.width * np.arange(self.bins + 1)
        edges, unit = reach + steps, math.pi if self.dimensions == 2 else 4 / 3 * math.pi
        shells = np.zeros(self.bins)
        for k in np.flatnonzero(self.groups == i):
            for m in np.flatnonzero(self.groups == j):
                around_one = float(self.class_radius[k] + self.class_radius[m]) + steps
                share = self.class_shares[k] * self.class_shares[m]
                shells += share * (unit * np.diff(around_one**self.dimensions))
        counts, expected = self.pair_counts[i, j], float(self.expected_pairs[i, j])
        if i != j:
            counts, expected = counts + self.pair_counts[j, i], expected + float(self.expected_pairs[j, i])
        distance = (edges[1:] + edges[:-1]) / 2
        around: Array = np.full(self.bins, expected)
        if self.is_layered and self.profiles is not None:
            around = self.profiles.expected_density(i, j, distance)
            around = around + self.profiles.expected_density(j, i, distance) if i != j else around
        scale = np.divide(1.0, shells * around, out=np.full(self.bins, np.nan), where=around > 0)
        # every pair was counted from both sides, except where one ball was near a wall
        return PairCorrelation(distance, counts * scale, np.sqrt(2 * counts) * scale, reach, scale)

    @property
    def is_layered(self) -> bool:
        """Whether g(r) is relative to the profile: under gravity, or where plane walls oscillate or are heated."""
        one = self.profiles
        return one is not None and one.layered and one.profile_pair_samples == self.pair_samples

    def profile(self, name: str) -> Profile:
        """Return density and temperature of a species across the container; CaromError where there are no walls."""
        if self.profiles is None:
            raise CaromError("Measures.profile: expected a gas between walls, got one without; it has no profile")
        return self.profiles.of(self._kind(name))

    @property
    def series(self) -> dict[str, Array]:
        """Values of each sample by the names in SERIES: time, collisions, temperatures, potential energy per ball, balls passed."""
        table = np.array(self.rows).reshape(-1, len(SERIES))
        return {name: table[:, k] for k, name in enumerate(SERIES)}

    @property
    def outflow(self) -> Outflow | None:
        """Balls through the periodic border across gravity, from the first sample to the last; None without such a border."""
        if self.flow_axis < 0 or self.samples < 2:
            return None
        t, passed = self.series["time"], self.series["passed"]
        return Outflow("xyz"[self.flow_axis], int(passed[-1] - passed[0]), float(t[-1] - t[0]))

    @property
    def species_series(self) -> dict[str, dict[str, Array]]:
        """Temperatures of each species (J), ``translational`` and ``rotational``, at the times of the :attr:`series`."""
        table = np.array(self.temperatures).reshape(-1, len(self.names), 2)
        return {
            name: {"translational": table[:, k, 0], "rotational": table[:, k, 1]} for k, name in enumerate(self.names)
        }

    @property
    def has_diffusion(self) -> bool:
        """Whether displacements are unbounded: only without walls does a gas have a diffusion coefficient."""
        return not (self.container.faces or self.sheared)

    @property
    def is_stationary(self) -> bool:
        """Whether the temperature stayed within a factor of two, or fluctuated about a mean that stayed.

        Only then may starting times be averaged over. A steady change by a factor of two, of time or of collisions, is one by its
        square root between the means of the two halves; single samples of few balls or on a shaken floor differ more.
        """
        warm = self.series["translational"]
        if len(warm) < 2 or warm.max() <= 2 * warm.min():
            return True
        first, second = warm[: len(warm) // 2].mean(), warm[len(warm) // 2 :].mean()
        return bool(max(first, second) ** 2 <= 2 * min(first, second) ** 2)

    def displacement_by_collisions(self) -> tuple[Array, Array]:
        """Return the collisions since the first sample, and the mean square displacement since then.

        This suits a gas that cools: its balls move about equally far between two collisions, however long that takes.
        """
        positions, collisions = np.array(self.followed), self.series["collisions"]
        return collisions - collisions[:1], ((positions - positions[:1]) ** 2).sum(axis=2).mean(axis=1)

    def displacement(self) -> Displacement:
        """Return the mean square displacement of up to 8192 balls relative to the centre of mass, averaged over pairs of samples.

        Lags go up to half of the time between the first and the last sample; longer ones have few starting times.
        """
        x, t = self.followed, self.series["time"]
        found = [
            (t[j] - t[i], float(((x[j] - x[i]) ** 2).sum(axis=1).mean()))
            for i in range(len(x))
            for j in range(i + 1, len(x))
            if t[j] - t[i] <= (t[-1] - t[0]) / 2
        ]
        table = np.array(found).reshape(-1, 2)
        longest = float(table[:, 0].max(initial=0.0))
        place = np.minimum((table[:, 0] / (longest or 1.0) * LAGS).astype(int), LAGS - 1)
        count = np.bincount(place, minlength=LAGS)
        sums = [np.bincount(place, table[:, k], LAGS)[count > 0] / count[count > 0] for k in range(2)]
        return Displacement(sums[0], sums[1], self.dimensions)


def _scale_to_unit(records: Any, names: tuple[str, ...]) -> float:
    """Divide components by a power of two, exactly, so that the largest is between 1/2 and 1; return the divisor."""
    largest = max(float(np.abs(records[name]).max()) for name in names)
    unit = math.ldexp(1.0, math.frexp(largest)[1])
    for name in names:
        records[name] /= unit
    return unit


def _positions(motions: Any) -> Array:
    return np.stack([motions[axis] for axis in "xyz"], axis=1)


def mean_square_displacement(positions: Array, masses: Array | None = None) -> Array:
    """Return the mean square displacement (F,) over 0, 1, 2, ... frames of unwrapped positions (F, N, 3), over all starting frames.

    Positions are relative to the centre of mass of each frame, with ``masses`` (N,). The longer the lag, the fewer starting frames
    there are to average over.

    Examples
    --------
    >>> import numpy as np
    >>> from carom.gas.measures import mean_square_displacement
    >>> t = np.arange(4.0)[:, None, None]
    >>> mean_square_displacement(t * np.array([[1.0, 0, 0], [-1.0, 0, 0]])).tolist()
    [0.0, 1.0, 4.0, 9.0]
    """
    x = np.array(positions, dtype=float)
    weight = np.ones(x.shape[1]) if masses is None else np.asarray(masses, dtype=float)
    x -= (weight[:, None] * x).sum(axis=1, keepdims=True) / weight.sum()
    found = [0.0] + [float(((x[k:] - x[:-k]) ** 2).sum(axis=2).mean()) for k in range(1, len(x))]
    return np.array(found)


# ----------------------------------------------------------------------------------------------------
# Profiles across a gas with their errors: density, velocity, temperatures and fluxes in layers, from blocks of a run.


BLOCKS = 10  # of the run, for the errors
PLACES = ("axis", "edges")  # fields that are no measurements


class LayerProfiles(NamedTuple):
    """Exact means over a run, and their standard errors in the same form."""

    mean: LayerAverages
    error: LayerAverages


def layer_profiles(
    gas: Gas, collisions: int, *, blocks: int = BLOCKS, progress: Progress | None = None
) -> LayerProfiles:
    """Return the profiles of a gas between walls, or of a sheared gas, which is advanced by so many collisions.

    The means are exact (:class:`carom.gas.results.LayerAverages`). Their standard errors are those of the means of the
    blocks, which should be long compared with the memory of the gas: the time in which heat crosses it.

    Parameters
    ----------
    gas : Gas
        With walls or a shear rate; in a steady state.
    collisions : int
        To measure over, those with walls included.
    blocks : int
        Into which the run is divided, at least 2.
    progress : callable(done, total, text), optional

    Returns
    -------
    LayerProfiles

    Raises
    ------
    CaromError
        For a gas without layers, too few collisions or blocks, and as :meth:`Gas.run` does.

    Examples
    --------
    >>> from carom import Ball, Surface
    >>> from carom.gas import Drive, Gas, Species, layer_profiles
    >>> surfaces = {("a", "a"): Surface(1, 0, -1), ("a", "wall"): Surface(1, 0, -1)}
    >>> gas = Gas(
    ...     [Species(Ball(0.5, 1.0), 60)], (5.0, 5.0, 12.0), periodic=(True, True, False), contacts=surfaces,
    ...     drives={"bottom": Drive(temperature=2.0), "top": Drive(temperature=1.0)}, seed=1,
    ... )
    >>> gas.advance(2000)
    >>> found = layer_profiles(gas, 20_000)
    >>> flux, error = found.mean.heat_flux[1:-1], found.error.heat_flux[1:-1]
    >>> bool((flux > 3 * error).all())  # from the warm wall at the bottom to the top
    True
    """
    faults = FaultList("layer_profiles")
    if len(gas.arrays.averages.layers) == 0:
        faults.add("gas", "a gas with walls or a shear rate", "one without")
    for name, value in (("blocks", blocks), ("collisions", collisions)):
        faults.attempt(require_count, "layer_profiles", name, value, 2)
    faults.raise_if_any()
    begin, found = gas.mark(), []
    for k in range(blocks):
        layers = gas.run(max(int(collisions) // int(blocks), 1)).averages.layers
        assert layers is not None
        found.append(layers)
        if progress is not None:
            progress(k + 1, blocks, "blocks")
    mean = gas.measured_since(begin).averages.layers
    assert mean is not None

    def error(name: str) -> Any:
        values = np.array([getattr(one, name) for one in found])
        return getattr(mean, name) if name in PLACES else np.std(values, axis=0, ddof=1) / math.sqrt(blocks)

    return LayerProfiles(mean, LayerAverages(**{one.name: error(one.name) for one in fields(LayerAverages)}))
