"""The surface that a ball meets: how it gives back the normal velocity, how it rubs, how it gives back the slip."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

from numpy.typing import ArrayLike

from carom.checks import Faults, number

__all__ = ["Surface"]


@dataclass(frozen=True, init=False)
class Surface:
    """A wall, a floor or another ball, as one contact feels it.

    Parameters
    ----------
    restitution : float or array
        e, 0 to 1: the share of the normal velocity that comes back.
    friction : float or array
        mu, 0 to infinity (``math.inf``: never slips).
    tangential_restitution : float or array
        beta, -1 to 1: a contact that holds turns the slip u into -beta u. 0 stops it (the paper's wall), 1 returns it
        (a superball), -1 leaves it (smooth).

    Arrays broadcast against the states that meet the surface. Raises CaromError with one line a fault.
    """

    restitution: Any
    friction: Any
    tangential_restitution: Any

    def __init__(
        self, restitution: ArrayLike = 1.0, friction: ArrayLike = math.inf, tangential_restitution: ArrayLike = 0.0
    ) -> None:
        faults = Faults("Surface")
        values = {
            "restitution": number(faults, "restitution", restitution, "a number from 0 to 1", lambda x: (x >= 0) & (x <= 1)),
            "friction": number(faults, "friction", friction, "a number >= 0 (inf: never slips)", lambda x: x >= 0, infinite=True),
            "tangential_restitution": number(
                faults, "tangential_restitution", tangential_restitution, "a number from -1 to 1",
                lambda x: (x >= -1) & (x <= 1),
            ),
        }  # fmt: skip
        faults.done()
        for key, value in values.items():
            object.__setattr__(self, key, value)
