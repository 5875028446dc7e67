"""Measures of a gas: velocity distributions, pair correlation, diffusion, temperatures over time.

:class:`Measures` samples a gas and returns means over its samples. What is counted at every collision (rates, energies, pressure)
is in :func:`carom.gas.channels` and :class:`carom.gas.GasRun`.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from numpy.typing import NDArray

from carom.errors import CaromError, Fault, suggestion
from carom.gas import containers
from carom.gas.containers import Container
from carom.gas.curves import Displacement, Distribution, Outflow, PairCorrelation
from carom.gas.edmd.driver import synchronized
from carom.gas.gas import Gas
from carom.gas.histograms import add_component_histograms, add_pair_histograms, species_sums
from carom.gas.spatial_profiles import Profile, Profiles, layers, volume_within

__all__ = [
    "MAX_FOLLOWED",
    "SERIES",
    "Displacement",
    "Distribution",
    "Measures",
    "PairCorrelation",
    "mean_square_displacement",
]

Array = NDArray[np.float64]
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
            drives = (faces["amplitude"] > 0) | (faces["temperature"] >= 0) | (faces["moving"] == 1)
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
