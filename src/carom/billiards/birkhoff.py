"""Weighted Birkhoff averages of orbits: rotation numbers to many digits, and whether an orbit is regular or chaotic."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from carom.billiards.orbits import Orbit, orbit_from_setup, state_of_rows
from carom.bodies import holds_arrays
from carom.core.jit.slices import block_slices
from carom.errors import CaromError, Fault

__all__ = ["RotationNumber", "digits_of_averages", "is_regular", "rotation_number"]

Array = NDArray[np.float64]
LEAST = 50  # bounces
# Regular orbits that rotate slowly have few digits for long, chaotic ones near an island many for a while. So orbits are followed
# on for so many bounces, until they have more digits than any chaotic one or, after the first, fewer than any regular one; at last
# the limit lies between both.
LONG = (3000, 30_000)
REGULAR, CHAOTIC, LIMIT = 5.0, 2.0, 3.2
AT_ONCE = 3_000_000  # bounces that are in memory


@holds_arrays
class RotationNumber(NamedTuple):
    """Mean advance along the boundary per bounce, over its length; arrays for many orbits."""

    number: Array
    """From 0 to 1."""
    digits: Array
    """Decimal digits to which the averages over both halves of the orbit agree: at most 16."""


def rotation_number(found: Orbit) -> RotationNumber:
    """Compute rotation numbers of orbits in a bounded table in the plane by weighted Birkhoff averages.

    On an invariant curve the average converges faster than any power of the number of bounces: ten digits in 10,000 bounces.
    Source: Das, Saiki, Sander & Yorke, Nonlinearity 30, 4111 (2017), doi 10.1088/1361-6544/aa84c2; digits: Sander & Meiss,
    Physica D 411, 132569 (2020), doi 10.1016/j.physd.2020.132569.

    Parameters
    ----------
    found : Orbit
        Of 50 bounces or more.

    Returns
    -------
    RotationNumber
        NaN for orbits that ended early.

    Raises
    ------
    CaromError
        A table without a boundary of finite length, or too few bounces.

    Examples
    --------
    The chord of a circle at the angle 1 from the tangent advances by 2 of 2 pi.

    >>> import math
    >>> from carom import billiards
    >>> start = (1.0, 0.0), (-math.sin(1.0), math.cos(1.0)), 0.0
    >>> found = billiards.rotation_number(billiards.orbit(billiards.circle(), start, 1000, law="mirror"))
    >>> bool(abs(found.number - 1 / math.pi) < 1e-12)
    True
    """
    length = _boundary_length(found)
    if not math.isfinite(length):
        raise CaromError(
            Fault("rotation_number", "table", "a boundary of finite length, in the plane", found.setup.table.name)
        )
    _require_bounces("rotation_number", found)
    steps = np.diff(found.arc, axis=-1) / length
    number, digits = _averages(steps - np.floor(steps))
    return RotationNumber(number, digits)


def digits_of_averages(found: Orbit) -> Array:
    """Return the number of decimal digits to which averages over both halves of an orbit agree, for each orbit.

    The averaged numbers are place and direction at each bounce; the number is the least of all of them. On smooth curves (islands,
    periodic orbits) it grows with the bounces; for chaotic orbits it stays at one or two.

    Parameters
    ----------
    found : Orbit
        Of 50 bounces or more.

    Examples
    --------
    >>> from carom import billiards
    >>> start = billiards.starts(billiards.stadium(), 1, seed=1)
    >>> orbit = billiards.orbit(billiards.stadium(), start, 2000, law="mirror")
    >>> bool(billiards.digits_of_averages(orbit)[0] < 3)
    True
    """
    _require_bounces("digits_of_averages", found)
    length = _boundary_length(found)
    phase = found.phase
    watched = [phase[..., 0], phase[..., 1]]
    if math.isfinite(length):
        turn = math.tau * found.arc / length
        watched += [np.cos(turn), np.sin(turn)]
    return np.asarray(np.min([_averages(values)[1] for values in watched], axis=0))


def is_regular(found: Orbit) -> NDArray[np.bool_]:
    """Return for each orbit whether it is regular rather than chaotic, by the digits to which both halves' averages agree.

    Orbits of which so few bounces do not tell are followed on, for up to 30,000: slow rotations about an island take long to show.
    Those that ended early are not regular. Compare `lyapunov`, which takes longer.
    """
    digits, bounces = np.array(digits_of_averages(found)).ravel(), found.t.shape[-1]
    ends = found.last.reshape(-1, found.last.shape[-1])[:, 1:]
    for longer in LONG:
        if bounces >= longer:
            continue
        unclear = np.flatnonzero((digits <= REGULAR) & ((digits >= CHAOTIC) | (bounces < LONG[0])))
        for some in block_slices(len(unclear), AT_ONCE // longer):
            which = unclear[some]
            start = state_of_rows(found.setup, ends[which], (len(which),))
            digits[which] = digits_of_averages(orbit_from_setup(found.setup, start, longer))
        bounces = longer
    return np.asarray(digits > LIMIT).reshape(found.count.shape)


def _averages(values: Array) -> tuple[Array, Array]:
    """Return the averages over whole orbits (..., N), and the digits to which those over both halves agree."""
    count = values.shape[-1]
    half = count // 2
    first, second = _average(values[..., :half]), _average(values[..., half : 2 * half])
    return _average(values), -np.log10(np.abs(first - second) + 1e-16)


def _average(values: Array) -> Array:
    """The average with the weights exp(-1/(t (1 - t))), which vanish at both ends with all derivatives."""
    t = np.arange(1, values.shape[-1] + 1) / (values.shape[-1] + 1)
    weight = np.exp(-1.0 / (t * (1.0 - t)))
    return np.asarray(values @ (weight / weight.sum()))


def _boundary_length(found: Orbit) -> float:
    shape = found.setup.shape
    return math.inf if shape.sphere is not None else float(shape.lengths.sum())


def _require_bounces(where: str, found: Orbit) -> None:
    if found.t.shape[-1] < LEAST:
        raise CaromError(Fault(where, "found", f"orbits of at least {LEAST} bounces", f"{found.t.shape[-1]}"))
