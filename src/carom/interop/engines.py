"""A coefficient of restitution for engines whose contacts are springs with damping, and back.

In such a contact the force never pulls. In units of the contact's own frequency and of the speed, e depends on one number:
MuJoCo's damping ratio, or Hunt and Crossley's dissipation times the speed.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from carom.errors import FaultList, checked_number

Array = NDArray[np.float64]
HALVINGS = 80  # of a bracket: far below the last bit of a float
SMALL = 0.1  # below, x - ln(1 + x) is summed as a series


def _checked(where: str, *numbers: tuple[str, Any, str, Callable[[Any], Any]]) -> list[Array]:
    faults = FaultList(where)
    found = [np.asarray(checked_number(faults, *one), dtype=float) for one in numbers]
    faults.raise_if_any()
    return found


def _rising(function: Callable[[Array], Array], high: ArrayLike) -> Array:
    """Return the root of a function that is negative before it and positive behind, between 0 and ``high``."""
    high = np.array(high, dtype=float)
    low = np.zeros_like(high)
    for _ in range(HALVINGS):
        middle = (low + high) / 2
        below = function(middle) < 0
        low, high = np.where(below, middle, low), np.where(below, high, middle)
    return np.asarray((low + high) / 2)


def _loss(ratio: Array) -> Array:
    """Return -ln e of a damping ratio."""
    # Schwager & Poeschel (2007): e = exp(-2 z acos(z) / sqrt(1 - z^2)), and with acosh beyond z = 1
    root = np.sqrt(np.abs(1 - ratio**2))
    angle = np.where(ratio < 1, np.arccos(np.minimum(ratio, 1)), np.arccosh(np.maximum(ratio, 1)))
    return 2 * ratio * np.divide(angle, root, out=np.ones_like(root), where=root > 0)


def solref(restitution: ArrayLike, contact_time: ArrayLike) -> Array:
    """Return MuJoCo's ``solref`` for a coefficient of restitution.

    A contact of MuJoCo is a spring with a damper that does not pull. Gravity during the contact is left out, and so is slip: in
    MuJoCo a ball that slides bounces higher than this, and has no friction at e = 1 (without a ``solreffriction``).

    Parameters
    ----------
    restitution : array_like (...)
        e, above 0 and at most 1.
    contact_time : array_like (...)
        How long the contact lasts at e = 1, s. In 20 steps of the engine e is right to 0.04, in 100 to 0.01.

    Returns
    -------
    array (..., 2)
        -stiffness (1/s^2) and -damping (1/s): the form of two numbers that are not positive.

    Raises CaromError for numbers outside these ranges. Source: T. Schwager and T. Poeschel, Granular Matter 9 (2007) 465,
    doi 10.1007/s10035-007-0065-z.

    Examples
    --------
    >>> from carom.interop import engines
    >>> engines.solref(0.8, contact_time=0.04).round(2).tolist()
    [-6168.5, -11.68]
    >>> round(float(engines.restitution_of_solref([-6168.5, -11.68])), 3)
    0.8
    """
    e, time = _checked(
        "engines.solref",
        ("restitution", restitution, "numbers above 0, at most 1", lambda x: (x > 0) & (x <= 1)),
        ("contact_time", contact_time, "numbers > 0, in s", lambda x: x > 0),
    )
    ratio = _rising(lambda z: _loss(z) + np.log(e), 1 / np.sqrt(e))
    frequency = np.pi / time
    return np.stack(np.broadcast_arrays(-(frequency**2), -2 * ratio * frequency), axis=-1)


def restitution_of_solref(solref: ArrayLike) -> Array:
    """Return the coefficient of restitution of MuJoCo's ``solref``, of either form; see :func:`solref`.

    Parameters
    ----------
    solref : array_like (..., 2)
        -stiffness (1/s^2) and -damping (1/s), or a time constant (s) and a damping ratio, which are positive.

    Returns
    -------
    array (...)

    Examples
    --------
    >>> from carom.interop import engines
    >>> engines.restitution_of_solref([[0.02, 1.0], [-10000.0, 0.0]]).round(3).tolist()
    [0.135, 1.0]
    """
    (both,) = _checked("engines.restitution_of_solref", ("solref", solref, "pairs of numbers", np.isfinite))
    first, second = both[..., 0], both[..., 1]
    ratio = np.where(first > 0, second, -second / (2 * np.sqrt(np.abs(first))))
    return np.asarray(np.exp(-_loss(ratio)))


def _short(x: Array) -> Array:
    """Return x - ln(1 + x), of small x as well."""
    small = np.clip(x, -SMALL, SMALL)
    series = sum((-small) ** n / n for n in range(2, 18))
    return np.where(x == small, series, x - np.log1p(np.maximum(x, -1 + 1e-16)))


def hunt_crossley_restitution(dissipation: ArrayLike, speed: ArrayLike) -> Array:
    """Return the coefficient of restitution of a contact with the force k x^n (1 + d v), as in Drake and Simbody.

    It depends neither on k and n nor on the mass.

    Parameters
    ----------
    dissipation : array_like (...)
        d, s/m, at least 0.
    speed : array_like (...)
        Speed of approach, m/s, at least 0.

    Returns
    -------
    array (...)

    Raises CaromError for negative numbers. Sources: K. H. Hunt and F. R. E. Crossley, J. Appl. Mech. 42 (1975) 440,
    doi 10.1115/1.3423596; D. W. Marhefka and D. E. Orin, IEEE Trans. SMC A 29 (1999) 566, doi 10.1109/3468.798060.

    Examples
    --------
    >>> from carom.interop import engines
    >>> engines.hunt_crossley_restitution(0.2, [0.5, 1.0, 2.0]).round(4).tolist()
    [0.9375, 0.8822, 0.7885]
    """
    d, v = _checked(
        "engines.hunt_crossley_restitution",
        ("dissipation", dissipation, "numbers >= 0, in s/m", lambda x: x >= 0),
        ("speed", speed, "numbers >= 0, in m/s", lambda x: x >= 0),
    )
    u = np.maximum(d * v, 1e-150)
    # Marhefka & Orin (1999): u - ln(1 + u) = -e u - ln(1 - e u)
    return _rising(lambda e: _short(-e * u) - _short(u), np.minimum(1, 1 / u))


def hunt_crossley_dissipation(restitution: ArrayLike, speed: ArrayLike) -> Array:
    """Return the dissipation d (s/m) that gives a coefficient of restitution at a speed; see :func:`hunt_crossley_restitution`.

    Parameters
    ----------
    restitution : array_like (...)
        e, above 0 and at most 1.
    speed : array_like (...)
        Speed of approach, m/s, above 0.

    Returns
    -------
    array (...)

    Examples
    --------
    >>> from carom.interop import engines
    >>> round(float(engines.hunt_crossley_dissipation(0.8822, 1.0)), 3)
    0.2
    """
    e, v = _checked(
        "engines.hunt_crossley_dissipation",
        ("restitution", restitution, "numbers above 0, at most 1", lambda x: (x > 0) & (x <= 1)),
        ("speed", speed, "numbers > 0, in m/s", lambda x: x > 0),
    )
    return _rising(lambda u: _short(-e * u) - _short(u), np.ones_like(v) / e) / v
