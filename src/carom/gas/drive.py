"""What gives a gas energy: walls that swing or are warm, and a thermostat."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

from carom.checks import Faults, number

__all__ = ["Drive", "Thermostat"]


def _check(faults: Faults, of: Any, **fields: tuple[str, Any]) -> None:
    """Every field that is given must be a finite number for which what is asked of it holds."""
    for field, (expected, holds) in fields.items():
        if getattr(of, field) is not None:
            number(faults, field, getattr(of, field), expected, holds)


@dataclass(frozen=True)
class Drive:
    """A wall that swings, or is warm, or both.

    Parameters
    ----------
    amplitude, frequency : float
        A plane wall swings along its normal by this height, so often a time. Its place is made of parabolas, ``amplitude`` up
        and then down, half a period each: place and velocity are continuous and the instants of contact are roots of
        parabolas, exact. Of a sine of this amplitude and frequency it is within 6 % of the amplitude; its greatest speed is
        8 amplitude frequency (2 pi), its acceleration 32 amplitude frequency^2 (4 pi^2, at most).
    phase : float
        Where in the period it starts, 0 to 1: at 0 in the middle, moving into the gas; at 1/4 furthest in.
    temperature : float
        k_B T of balls that leave a warm wall: their velocities are Maxwellian in flux (all that comes is thermalized).
    temperature_rotational : float
        That of their spins; left out: the same.

    Raises CaromError with one line a fault.
    """

    amplitude: float = 0.0
    frequency: float = 0.0
    phase: float = 0.0
    temperature: float | None = None
    temperature_rotational: float | None = None

    def __post_init__(self) -> None:  # noqa: D105
        faults = Faults("Drive")
        warm = ("a number >= 0", lambda x: x >= 0)
        _check(
            faults, self, amplitude=warm, frequency=warm, temperature=warm, temperature_rotational=warm,
            phase=("a number from 0 to 1", lambda x: (x >= 0) & (x <= 1)),
        )  # fmt: skip
        if self.amplitude > 0 and not self.frequency > 0:
            faults.add("frequency", "a number > 0 for a wall that swings", f"{self.frequency!r}")
        if self.amplitude == 0 and self.temperature is None:
            faults.add("amplitude", "a wall that swings or has a temperature", "neither")
        faults.done()


@dataclass(frozen=True)
class Thermostat:
    """Andersen's thermostat: each ball, at random instants, gets a velocity and a spin from a Maxwellian.

    The instants are those of a Poisson process, ``rate`` a ball and time, and events like all others, exact. The gas comes to
    the canonical distribution, positions included, whatever its contacts conserve; momentum is not kept (H. C. Andersen,
    J. Chem. Phys. 72, 2384 (1980)).

    Parameters
    ----------
    temperature : float
        k_B T.
    rate : float
        Kicks a ball and time.
    temperature_rotational : float
        That of the spins; left out: the same.

    Raises CaromError with one line a fault.
    """

    temperature: float
    rate: float
    temperature_rotational: float | None = None

    def __post_init__(self) -> None:  # noqa: D105
        faults = Faults("Thermostat")
        warm = ("a number >= 0", lambda x: x >= 0)
        _check(
            faults, self, temperature=warm, temperature_rotational=warm,
            rate=("a number > 0", lambda x: (x > 0) & (x < math.inf)),
        )  # fmt: skip
        faults.done()
