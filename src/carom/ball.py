"""The ball: radius a, mass m, moment of inertia I = kappa m a^2."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Literal

import numpy as np
from numpy.typing import ArrayLike

from carom.checks import Faults, number

__all__ = ["INERTIAS", "Ball", "Disc"]

Inertia = Literal["solid", "hollow"]
INERTIAS = {"solid": 2 / 5, "hollow": 2 / 3}
DISCS = {"disc": 1 / 2, "ring": 1.0}


@dataclass(frozen=True, init=False)
class Ball:
    """A homogeneous ball, or any ball whose moment of inertia is the same about every axis through its centre.

    Parameters
    ----------
    radius : float or array
        a, in m, > 0.
    mass : float or array
        m, in kg, > 0.
    inertia : "solid", "hollow", or kappa as a float or an array
        I = kappa m a^2: 2/5 for a solid sphere, 2/3 for a thin shell; 0 < kappa <= 2/3.

    Arrays broadcast against the states that meet the ball. Raises CaromError with one line a fault.
    """

    radius: Any
    mass: Any
    kappa: Any
    planar: bool

    def __init__(
        self, radius: ArrayLike = 0.02625, mass: ArrayLike = 0.1406, inertia: Inertia | ArrayLike = "solid"
    ) -> None:
        _fill(self, "Ball", radius, mass, inertia, INERTIAS, 2 / 3, planar=False)

    @property
    def moment(self) -> Any:
        """Moment of inertia I about any axis through the centre, kg m^2."""
        return self.kappa * self.mass * self.radius * self.radius


def Disc(  # noqa: N802
    radius: ArrayLike = 0.02625, mass: ArrayLike = 0.1406, inertia: Literal["disc", "ring"] | ArrayLike = "disc"
) -> Ball:
    """A disc in the plane z = 0: a Ball with kappa up to 1 ("disc" 1/2, "ring" 1), whose spin has only its z part."""
    ball = object.__new__(Ball)
    _fill(ball, "Disc", radius, mass, inertia, DISCS, 1.0, planar=True)
    return ball


def _fill(
    ball: Ball, name: str, radius: Any, mass: Any, inertia: Any, names: dict[str, float], most: float, *, planar: bool
) -> None:
    faults = Faults(name)
    if isinstance(inertia, str):
        kappa: Any = names.get(inertia)
        if kappa is None:
            faults.add("inertia", f"one of {', '.join(map(repr, names))} or kappa as a number", repr(inertia))
            kappa = 1.0
    else:
        what = f"kappa = I/(m a^2) in (0, {'2/3' if most < 1 else '1'}]"
        kappa = number(faults, "inertia", inertia, what, lambda x: (x > 0) & (x <= most * (1 + 1e-12)))
        given = np.asarray(inertia)
        if most < 1 and faults.of("inertia") and given.dtype.kind in "iuf" and np.all((given > 0) & (given <= 1)):
            faults.advise("inertia", "a thin shell is 'hollow'; a disc, carom.Disc, goes up to 1")
    values = {
        "radius": number(faults, "radius", radius, "a length in m, > 0", lambda x: x > 0),
        "mass": number(faults, "mass", mass, "a mass in kg, > 0", lambda x: x > 0),
        "kappa": kappa,
        "planar": planar,
    }
    faults.done()
    for key, value in values.items():
        object.__setattr__(ball, key, value)
