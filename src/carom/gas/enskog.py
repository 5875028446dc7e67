"""Enskog's theory of smooth, elastic, equal spheres: transport coefficients of a dense gas."""

from __future__ import annotations

import math
from typing import Any, NamedTuple

from carom.errors import FaultList, checked_number

__all__ = ["Enskog", "enskog"]

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
