"""Diffusion of the balls of a gas and of their spins, by Green and Kubo's relations and by Einstein's."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from carom.errors import FaultList
from carom.gas.gas import Gas
from carom.gas.transport import BLOCKS, require_equilibrium, require_steady
from carom.public.progress import Progress

__all__ = ["DiffusionCoefficient", "DiffusionCoefficients", "diffusion_coefficients"]

Array = NDArray[np.float64]
STEP = 0.25  # mean free times between two looks
MEMORY = 48  # looks over which the correlation is integrated: 12 mean free times
LONGEST = 96  # looks of the longest lag; Einstein's line is fitted to those beyond the memory


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
    gas: Gas, looks: int = 8000, *, progress: Progress | None = None
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
    looks : int
        Length of the run, in quarters of a mean free time; at least 2000.
    progress : callable(done, total, text), optional

    Returns
    -------
    DiffusionCoefficients

    Raises
    ------
    CaromError
        For a gas with walls, a shear or whose energy changes, and for too few looks.

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
    if isinstance(looks, bool) or not isinstance(looks, int | np.integer) or looks < 2 * LONGEST * BLOCKS + 80:
        faults.add("looks", f"a whole number >= {2 * LONGEST * BLOCKS + 80}", f"{looks!r}")
    faults.raise_if_any()
    gas.measure_heat()
    start, axes = gas.mark(), int(gas.arrays.system[0]["dimensions"])
    gas.advance(20 * len(gas.balls().species))
    step = STEP * gas.measured_since(start).mean_free_time
    energy, begin, side = sum(gas.energy()), gas.time, gas.arrays.system[0]["side"][:axes]
    turns = not gas.arrays.materials.pairs["smooth"].all()
    about = slice(None) if axes == 3 else slice(2, 3)
    parts: list[tuple[Any, Any]] = []
    for block in np.array_split(np.arange(looks), BLOCKS):
        ways, angles = [], []
        for k in block:
            gas.advance(until=begin + (k + 1) * step)
            now = gas.balls()
            place = now.position[:, :axes] + now.images[:, :axes] * side
            ways.append((place - place.mean(axis=0), now.velocity[:, :axes]))  # (all may move together)
            angles.append((gas.turned()[:, about], now.spin[:, about]))
        parts.append((_of_block(ways, step), _of_block(angles, step)))
        if progress is not None:
            progress(int(block[-1]) + 1, int(looks), "looks")
    require_steady(faults, gas, energy)
    return DiffusionCoefficients(
        _joined([one for one, _ in parts], step, True), _joined([two for _, two in parts], step, turns)
    )


def _of_block(rows: list[tuple[Array, Array]], step: float) -> tuple[Array, Array]:
    """Return the mean squares of the ways and the correlation of the rates of one block, from places and rates at each look."""
    place, rate = (np.array(part) for part in zip(*rows, strict=True))
    square = np.array([((place[k:] - place[:-k]) ** 2).mean() for k in range(1, LONGEST + 1)])
    count = len(rate)
    correlation = np.array([(rate[k:] * rate[: count - k]).mean() for k in range(LONGEST + 1)])
    return square, correlation


def _joined(parts: list[tuple[Array, Array]], step: float, moves: bool) -> DiffusionCoefficient:
    """Return the coefficient by both ways from the blocks of a run."""
    lag: Array = np.arange(1, LONGEST + 1) * np.float64(step)
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
