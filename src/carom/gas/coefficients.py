"""Transport coefficients of gases in equilibrium, by the Einstein relations of Helfand, from exact integrals of the currents."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from carom.errors import FaultList, checked_number, require_count
from carom.gas.gas import Gas
from carom.gas.results import Mark, averages_between
from carom.public.progress import Progress

Array = NDArray[np.float64]
WINDOW = 2.0  # mean free times of a window
LONGEST = 12  # windows of the longest lag
FITTED = 4  # from so many windows on the line is fitted: after what the current has forgotten by then
BLOCKS = 10  # of the run, for the error
STEADY = 1e-6  # relative change of the energy of a gas in equilibrium


@dataclass(frozen=True, eq=False)
class Coefficient:
    """A transport coefficient, with what it follows from."""

    value: float
    """Of viscosities in Pa s (discs: N s/m), of the conductivity, heat flux over the gradient of k_B T, in 1/(m s) (discs: 1/s)."""
    error: float
    """Standard error, from blocks of the run."""
    lag: Array
    """Times (s), (L,); none of a sheared gas."""
    helfand: Array
    """Mean square of the integral of the current over each time, in units in which its slope is the coefficient, (L,)."""


class TransportCoefficients(NamedTuple):
    """Transport coefficients of a gas, each with its error."""

    viscosity: Coefficient
    bulk_viscosity: Coefficient
    conductivity: Coefficient


def viscosity(gas: Gas, windows: int = 2000, *, progress: Progress | None = None) -> Coefficient:
    """Return the shear viscosity of a gas in equilibrium, which is advanced meanwhile.

    Over a time t the integral of a shear stress has the mean square 2 eta k_B T t / V for long t (E. Helfand, Phys. Rev. 119, 1
    (1960); B. J. Alder, D. M. Gass & T. E. Wainwright, J. Chem. Phys. 53, 3813 (1970)). The integrals are exact
    (:class:`TimeAverages`), kinetic and collisional parts together, and all independent components of the stress are used (5 of
    balls, 2 of discs); of rough balls the symmetric part.

    Parameters
    ----------
    gas : Gas
        In equilibrium, without walls, drives, thermostat and shear; its contacts conserve energy.
    windows : int
        Length of the run, in windows of two mean free times; at least 200.
    progress : callable(done, total, text), optional

    Returns
    -------
    Coefficient

    Raises
    ------
    CaromError
        For a gas with walls, or whose energy changes, and for too few windows.

    Examples
    --------
    >>> from carom import Ball, Surface
    >>> from carom.gas import Gas, Species, viscosity
    >>> gas = Gas([Species(Ball(0.5, 1.0), 64)], (8.6, 8.6, 8.6), contacts=Surface(1, 0, -1), seed=1)
    >>> gas.advance(2000)
    >>> found = viscosity(gas, 400)
    >>> 0.12 < found.value < 0.25 and found.error < 0.06
    True
    """
    windowed = _Windows.of("viscosity", gas, windows, False, progress)
    return windowed.coefficient(windowed.shear, 1 / windowed.temperature)


def transport_coefficients(gas: Gas, windows: int = 2000, *, progress: Progress | None = None) -> TransportCoefficients:
    """Return the shear and bulk viscosity and the heat conductivity of a gas in equilibrium, which is advanced meanwhile.

    As :func:`viscosity`: the bulk viscosity from the fluctuations of the pressure about its mean, the conductivity from the heat
    current, the energy that balls carry and pass on in collisions (with the energy of spins, where contacts
    change them).

    Parameters
    ----------
    gas, windows, progress : as of :func:`viscosity`

    Returns
    -------
    TransportCoefficients. Raises CaromError as :func:`viscosity` does.

    Examples
    --------
    >>> from carom import Ball, Surface
    >>> from carom.gas import Gas, Species, enskog, transport_coefficients
    >>> gas = Gas([Species(Ball(0.5, 1.0), 64)], (8.6, 8.6, 8.6), contacts=Surface(1, 0, -1), seed=1)
    >>> gas.advance(2000)
    >>> found, theory = transport_coefficients(gas, 400), enskog(64 / 8.6**3)
    >>> abs(found.conductivity.value / theory.conductivity - 1) < 0.5
    True
    """
    one = _Windows.of("transport_coefficients", gas, windows, True, progress)
    warm = one.temperature
    return TransportCoefficients(
        one.coefficient(one.shear, 1 / warm),
        one.coefficient(one.pressure, 1 / warm),
        one.coefficient(one.heat, 1 / warm**2),
    )


def sheared_viscosity(
    gas: Gas, collisions: int, *, blocks: int = BLOCKS, progress: Progress | None = None
) -> Coefficient:
    """Return the viscosity of a sheared gas, -P_xy over the shear rate, which is advanced by so many collisions.

    Parameters
    ----------
    gas : Gas
        With a shear rate; in a steady state, or nearly.
    collisions : int
        To measure over.
    blocks : int
        Into which the run is divided for the error, at least 2.
    progress : callable(done, total, text), optional

    Returns
    -------
    Coefficient

    Raises
    ------
    CaromError
        For a gas without a shear rate, too few collisions or blocks, and as :meth:`Gas.run` does.

    Examples
    --------
    >>> from carom import Ball, Surface
    >>> from carom.gas import Gas, Species, sheared_viscosity
    >>> gas = Gas([Species(Ball(0.5, 1.0), 64)], (6.0, 6.0, 6.0), contacts=Surface(0.8, 0, -1), shear_rate=0.5, seed=1)
    >>> gas.advance(5000)
    >>> found = sheared_viscosity(gas, 5000)
    >>> found.value > 3 * found.error > 0
    True
    """
    faults = FaultList("sheared_viscosity")
    if gas.shear_rate == 0:
        faults.add("gas", "a gas with a shear_rate", "one without")
    for name, value in (("blocks", blocks), ("collisions", collisions)):
        faults.attempt(require_count, "sheared_viscosity", name, value, 2)
    faults.raise_if_any()
    found, times = [], []
    for k in range(blocks):
        run = gas.run(max(int(collisions) // int(blocks), 1))
        assert run.shear is not None
        found.append(run.shear.viscosity)
        times.append(run.simulated_time)
        if progress is not None:
            progress(k + 1, blocks, "blocks")
    none = np.empty(0)
    mean = float(np.average(found, weights=times))
    return Coefficient(mean, float(np.std(found, ddof=1)) / math.sqrt(blocks), none, none)


def require_equilibrium(faults: FaultList, gas: Gas) -> None:
    """Add the faults of a gas that cannot be in equilibrium: walls, and a shear."""
    if gas.walls:
        faults.add("gas", "a gas without walls", f"walls {', '.join(gas.walls)}")
    if gas.shear_rate != 0:
        faults.add("gas", "a gas in equilibrium", f"a shear rate of {gas.shear_rate:g}", "use sheared_viscosity")


def require_steady(faults: FaultList, gas: Gas, energy: float) -> None:
    """Raise CaromError for a gas whose energy is no longer what it was."""
    if abs(sum(gas.energy()) / energy - 1) > STEADY:
        got = f"a gas whose energy changed from {energy:g} to {sum(gas.energy()):g} J"
        faults.add("gas", "contacts that conserve energy", got)
        faults.raise_if_any()


class _Windows(NamedTuple):
    """Integrals over the windows of a run in equilibrium, (windows, components) each, and what they are divided by."""

    length: float
    volume: float
    temperature: float
    shear: Array
    pressure: Array
    heat: Array

    @classmethod
    def of(cls, where: str, gas: Gas, windows: Any, heat: bool, progress: Progress | None) -> _Windows:
        """Run a gas over so many windows. Raises CaromError."""
        faults = FaultList(where)
        require_equilibrium(faults, gas)
        faults.attempt(require_count, where, "windows", windows, 20 * BLOCKS)
        faults.raise_if_any()
        if heat:
            gas.measure_heat()
        start: Mark = gas.mark()
        gas.advance(20 * len(gas.balls().species))
        length = WINDOW * gas.measured_since(start).mean_free_time
        energy, begin, stress, passed = sum(gas.energy()), gas.time, [], []
        before, warm = gas.integrals(), 0.0
        for k in range(windows):
            gas.advance(until=begin + (k + 1) * length)
            after = gas.integrals()
            found = averages_between(gas.arrays, before, after, length)
            stress.append(found.stress * length)
            passed += [gas.heat_passed()] if heat else []
            warm += found.temperature / windows
            before = after
            if progress is not None and k % 100 == 0:
                progress(k, windows, "windows")
        require_steady(faults, gas, energy)
        volume, rows = float(gas.arrays.system[0]["volume"]), np.array(stress)
        traces = np.trace(rows, axis1=1, axis2=2)[:, None] / rows.shape[1]
        currents = np.diff(np.array(passed), axis=0) / volume if heat else np.empty((0, 0))
        return cls(length, volume, warm, np.array([_shear(one) for one in rows]), traces - traces.mean(), currents)

    def coefficient(self, rows: Array, scale: float) -> Coefficient:
        """Return the slope of the mean square of the integral of a current, times V / 2 and a scale."""
        scale *= self.volume / 2
        blocks = np.array([_mean_squares(part) for part in np.array_split(rows, BLOCKS)]) * scale
        lag: Array = (self.length * np.arange(1, LONGEST + 1)).astype(np.float64)
        squares: Array = blocks.mean(axis=0)
        slopes = [np.polyfit(lag[FITTED - 1 :], one[FITTED - 1 :], 1)[0] for one in blocks]
        return Coefficient(float(np.mean(slopes)), float(np.std(slopes, ddof=1)) / math.sqrt(BLOCKS), lag, squares)


def _shear(stress: Array) -> Array:
    """Return the independent components of the traceless symmetric part, each with the variance of an off-diagonal one."""
    even = (stress + stress.T) / 2
    if len(even) == 2:
        return np.array([even[0, 1], (even[0, 0] - even[1, 1]) / 2])
    last = (2 * even[2, 2] - even[0, 0] - even[1, 1]) / math.sqrt(12)
    return np.array([even[0, 1], even[0, 2], even[1, 2], (even[0, 0] - even[1, 1]) / 2, last])


def _mean_squares(rows: Array) -> Array:
    """Return the mean squares of the sums over 1, 2, ... successive rows, over all starts and components, (LONGEST,)."""
    total = np.concatenate([np.zeros((1, rows.shape[1])), np.cumsum(rows, axis=0)])
    return np.array([((total[k:] - total[:-k]) ** 2).mean() for k in range(1, LONGEST + 1)])


# ----------------------------------------------------------------------------------------------------
# Diffusion of the balls of a gas and of their spins, by Green and Kubo's relations and by Einstein's.


STEP = 0.25  # mean free times between two samples
MEMORY = 48  # samples over which the correlation is integrated: 12 mean free times
LONGEST_LAG = 96  # samples of the longest lag; Einstein's line is fitted to those beyond the memory


@dataclass(frozen=True, eq=False)
class DiffusionCoefficient:
    """A diffusion coefficient by two ways, with standard errors from blocks of the run."""

    value: float
    """By Einstein: the slope of the mean square way over twice the number of components (m^2/s; of spins, angles: rad^2/s)."""
    error: float
    green_kubo: float
    """By Green and Kubo: the integral of the correlation over 12 mean free times."""
    green_kubo_error: float
    lag: Array
    """Times (s), (L,)."""
    square: Array
    """Mean square way over each time, for one component, (L,)."""
    correlation: Array
    """Of one component of the velocity or spin with itself after 0 and each of these times, (L + 1,)."""


class DiffusionCoefficients(NamedTuple):
    """Of the balls, and of their spins."""

    self_diffusion: DiffusionCoefficient
    spin_diffusion: DiffusionCoefficient


def diffusion_coefficients(
    gas: Gas, samples: int = 8000, *, progress: Progress | None = None
) -> DiffusionCoefficients:  # fmt: skip
    """Return how fast balls diffuse, and how fast the angles by which they have turned do, in equilibrium.

    Both are integrals of a correlation, D = int <v_x(0) v_x(t)> dt (M. S. Green, J. Chem. Phys. 22, 398 (1954); R. Kubo, J. Phys.
    Soc. Japan 12, 570 (1957)), and half the slope of a mean square, <(x(t) - x(0))^2> = 2 D t for long t (A. Einstein, Ann.
    Phys. 17, 549 (1905)); for spins w_x stands in place of v_x, and the angle, its exact integral over time, in place of x.
    Positions and angles are exact; the correlation is integrated by the trapezoidal rule, whose error is below 0.5 %.

    Parameters
    ----------
    gas : Gas
        In equilibrium, without walls, drives, thermostat and shear; its contacts conserve energy. It is advanced meanwhile.
    samples : int
        Length of the run, in quarters of a mean free time; at least 2000.
    progress : callable(done, total, text), optional

    Returns
    -------
    DiffusionCoefficients

    Raises
    ------
    CaromError
        For a gas with walls, a shear or whose energy changes, and for too few samples.

    Notes
    -----
    Where collisions change no spin, spins do not diffuse: the spin diffusion is nan.

    Examples
    --------
    >>> import math
    >>> from carom import Ball, Surface
    >>> from carom.gas import Gas, Species, diffusion_coefficients
    >>> gas = Gas([Species(Ball(0.5, 1.0), 60)], (8.6, 8.6, 8.6), contacts=Surface(1, math.inf, 1), seed=1)
    >>> gas.advance(1000)
    >>> found = diffusion_coefficients(gas, 2000)
    >>> abs(found.spin_diffusion.value / found.spin_diffusion.green_kubo - 1) < 0.1
    True
    """
    faults = FaultList("diffusion_coefficients")
    require_equilibrium(faults, gas)
    faults.attempt(require_count, "diffusion_coefficients", "samples", samples, 2 * LONGEST_LAG * BLOCKS + 80)
    faults.raise_if_any()
    gas.measure_heat()
    start, axes = gas.mark(), int(gas.arrays.system[0]["dimensions"])
    gas.advance(20 * len(gas.balls().species))
    step = STEP * gas.measured_since(start).mean_free_time
    energy, begin, side = sum(gas.energy()), gas.time, gas.arrays.system[0]["side"][:axes]
    turns = not gas.arrays.materials.pairs["smooth"].all()
    about = slice(None) if axes == 3 else slice(2, 3)
    parts: list[tuple[Any, Any]] = []
    for block in np.array_split(np.arange(samples), BLOCKS):
        ways, angles = [], []
        for k in block:
            gas.advance(until=begin + (k + 1) * step)
            now = gas.balls()
            place = now.position[:, :axes] + now.images[:, :axes] * side
            ways.append((place - place.mean(axis=0), now.velocity[:, :axes]))  # (all may move together)
            angles.append((gas.turned()[:, about], now.spin[:, about]))
        parts.append((_of_block(ways, step), _of_block(angles, step)))
        if progress is not None:
            progress(int(block[-1]) + 1, int(samples), "samples")
    require_steady(faults, gas, energy)
    return DiffusionCoefficients(
        _joined([one for one, _ in parts], step, True), _joined([two for _, two in parts], step, turns)
    )


def _of_block(rows: list[tuple[Array, Array]], step: float) -> tuple[Array, Array]:
    """Return the mean squares of the ways and the correlation of the rates of one block, from places and rates at each sample."""
    place, rate = (np.array(part) for part in zip(*rows, strict=True))
    square = np.array([((place[k:] - place[:-k]) ** 2).mean() for k in range(1, LONGEST_LAG + 1)])
    count = len(rate)
    correlation = np.array([(rate[k:] * rate[: count - k]).mean() for k in range(LONGEST_LAG + 1)])
    return square, correlation


def _joined(parts: list[tuple[Array, Array]], step: float, moves: bool) -> DiffusionCoefficient:
    """Return the coefficient by both ways from the blocks of a run."""
    lag: Array = np.arange(1, LONGEST_LAG + 1) * np.float64(step)
    squares, correlations = (np.array(part) for part in zip(*parts, strict=True))
    slopes = np.array([np.polyfit(lag[MEMORY:], one[MEMORY:], 1)[0] for one in squares]) / 2
    sums = np.trapezoid(correlations[:, : MEMORY + 1], dx=step, axis=1)

    def with_error(values: Array) -> tuple[float, float]:
        if not moves:
            return math.nan, math.nan
        return float(values.mean()), float(np.std(values, ddof=1)) / math.sqrt(BLOCKS)

    return DiffusionCoefficient(
        *with_error(slopes), *with_error(sums), lag, squares.mean(axis=0), correlations.mean(axis=0)
    )


# ----------------------------------------------------------------------------------------------------
# Enskog's theory of smooth, elastic, equal spheres: transport coefficients of a dense gas.


# Beyond the first order of Sonine's polynomials: factors of the dilute viscosity and conductivity (Chapman & Cowling 1970, 10.21).
VISCOSITY, CONDUCTIVITY, DIFFUSION = 1.01600, 1.02513, 1.01896


class Enskog(NamedTuple):
    """Transport coefficients and what they follow from."""

    contact: float
    """g(r) at contact, of Carnahan & Starling."""
    mean_free_time: float
    """s"""
    pressure: float
    """Pa"""
    viscosity: float
    """Pa s"""
    bulk_viscosity: float
    """Pa s"""
    conductivity: float
    """Heat flux over the gradient of k_B T, 1/(m s)."""
    self_diffusion: float
    """m^2/s"""


def enskog(density: Any, diameter: Any = 1.0, mass: Any = 1.0, temperature: Any = 1.0) -> Enskog:
    """Return the transport coefficients of smooth elastic spheres by Enskog's theory.

    Parameters
    ----------
    density : float
        Number of spheres per volume (1/m^3), > 0; the packing fraction is below 1.
    diameter : float
        m
    mass : float
        kg
    temperature : float
        k_B T (J).

    Returns
    -------
    Enskog

    Raises
    ------
    CaromError
        For numbers that are not > 0, and spheres that do not fit.

    Notes
    -----
    S. Chapman & T. G. Cowling, The Mathematical Theory of Non-Uniform Gases (1970), chapter 16, with the dilute values to high
    order. Within some per cent of simulations up to packing fractions of 0.25.

    Examples
    --------
    >>> from carom.gas import enskog
    >>> dilute = enskog(1e-6)
    >>> round(dilute.viscosity, 4), round(dilute.conductivity, 3)
    (0.1791, 0.678)
    >>> round(enskog(0.1).viscosity, 4)
    0.1934
    """
    faults = FaultList("enskog")
    n, d, m, t = (
        checked_number(faults, name, value, "a number > 0", lambda x: x > 0)
        for name, value in (("density", density), ("diameter", diameter), ("mass", mass), ("temperature", temperature))
    )
    filled = math.pi / 6 * n * d**3
    if not filled < 1:
        faults.add("density", f"fewer than {6 / math.pi / d**3:.4g} spheres per volume, which would fill it", f"{n!r}")
    faults.raise_if_any()
    contact = (1 - filled / 2) / (1 - filled) ** 3
    pushed = 2 * math.pi / 3 * n * d**3
    y = pushed * contact
    speed = math.sqrt(t / (math.pi * m))
    # of a dilute gas
    eta = VISCOSITY * 5 / 16 * m * speed / d**2
    heat = CONDUCTIVITY * 75 / 64 * speed / d**2
    return Enskog(
        contact,
        1 / (4 * math.pi * n * d**2 * contact * speed),
        n * t * (1 + y),
        eta * pushed * (1 / y + 0.8 + 0.7614 * y),
        1.002 * eta * pushed * y,
        heat * pushed * (1 / y + 1.2 + 0.7574 * y),
        DIFFUSION * 3 / 8 * speed / (n * d**2 * contact),
    )
