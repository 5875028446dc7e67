"""Transport coefficients of gases in equilibrium, by the Einstein relations of Helfand, from exact integrals of the stress."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from carom.errors import FaultList
from carom.gas.gas import Gas
from carom.gas.time_averages import averages_between
from carom.public.progress import Progress

__all__ = ["Viscosity", "viscosity"]

Array = NDArray[np.float64]
WINDOW = 2.0  # mean free times of a window
LONGEST = 12  # windows of the longest lag
FITTED = 4  # from so many windows on the line is fitted: after what the stress has forgotten by then
BLOCKS = 10  # of the run, for the error
STEADY = 1e-6  # relative change of the energy of a gas in equilibrium


@dataclass(frozen=True, eq=False)
class Viscosity:
    """Shear viscosity of a gas, with what it follows from."""

    value: float
    """Pa s (discs: N s/m)."""
    error: float
    """Standard error, from blocks of the run."""
    lag: Array
    """Times (s), (L,)."""
    helfand: Array
    """Mean square of the integral of the shear stress over each time, times V / (2 k_B T), (L,): its slope is the viscosity."""


def viscosity(gas: Gas, windows: int = 2000, *, progress: Progress | None = None) -> Viscosity:
    """Return the shear viscosity of a gas in equilibrium, which is advanced meanwhile.

    Over a time t the integral of a shear stress has the mean square 2 eta k_B T t / V for long t (E. Helfand, Phys. Rev. 119, 1
    (1960); B. J. Alder, D. M. Gass & T. E. Wainwright, J. Chem. Phys. 53, 3813 (1970)). The integrals are exact
    (:class:`TimeAverages`), kinetic and collisional parts together, and all independent components of the stress are used (5 of
    balls, 2 of discs); of rough balls the symmetric part.

    Parameters
    ----------
    gas : Gas
        In equilibrium, without walls, drives and thermostat; its contacts conserve energy.
    windows : int
        Length of the run, in windows of two mean free times; at least 200.
    progress : callable(done, total, text), optional

    Returns
    -------
    Viscosity

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
    faults = FaultList("viscosity")
    if gas.walls:
        faults.add("gas", "a gas without walls", f"walls {', '.join(gas.walls)}")
    if isinstance(windows, bool) or not isinstance(windows, int | np.integer) or windows < 20 * BLOCKS:
        faults.add("windows", f"a whole number >= {20 * BLOCKS}", f"{windows!r}")
    faults.raise_if_any()
    start = gas.mark()
    gas.advance(20 * len(gas.balls().species))
    length = WINDOW * gas.measured_since(start).mean_free_time
    energy, rows = sum(gas.energy()), []
    before, begin = gas.integrals(), gas.time
    warm = 0.0
    for k in range(windows):
        gas.advance(until=begin + (k + 1) * length)
        after = gas.integrals()
        found = averages_between(gas.arrays, before, after, length)
        rows.append(_shear(found.stress) * length)
        warm += found.temperature / windows
        before = after
        if progress is not None and k % 100 == 0:
            progress(k, windows, "windows")
    if abs(sum(gas.energy()) / energy - 1) > STEADY:
        faults.add(
            "gas",
            "contacts that conserve energy",
            f"a gas whose energy changed from {energy:g} to {sum(gas.energy()):g} J",
        )
        faults.raise_if_any()
    scale = float(gas.arrays.system[0]["volume"]) / (2 * warm)
    blocks = np.array([_mean_squares(part) for part in np.array_split(np.array(rows), BLOCKS)]) * scale
    lag: Array = (length * np.arange(1, LONGEST + 1)).astype(np.float64)
    squares: Array = blocks.mean(axis=0)
    slopes = [np.polyfit(lag[FITTED - 1 :], one[FITTED - 1 :], 1)[0] for one in blocks]
    return Viscosity(float(np.mean(slopes)), float(np.std(slopes, ddof=1)) / math.sqrt(BLOCKS), lag, squares)


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
