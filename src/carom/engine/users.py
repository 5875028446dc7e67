"""A wall law of a user's own: compiled by itself, called by the engine through its address.

So the engine is compiled once for all laws that will ever be written. (Numba's own functions as arguments would do as
well, but each takes 75 us to hand over, longer than a whole shot.)
"""

from __future__ import annotations

import functools
from collections.abc import Callable
from typing import Any

from carom.address import address_of, answer_at, register_answers
from carom.kernel import Vec, kernel

__all__ = ["call_user", "register_calls", "user_address"]

WallKernel = Callable[[Vec, Vec, Vec, float, float, float, float, float], tuple[Vec, Vec]]
NUMBERS = 14  # velocity, spin, normal, a, kappa, e, mu, beta


def register_calls() -> None:
    """Tell the compiler how laws are called."""
    register_answers()


@kernel
def call_user(
    address: int, v: Vec, w: Vec, n: Vec, a: float, kappa: float, e: float, mu: float, beta: float
) -> tuple[Vec, Vec]:
    """The law at an address."""
    r = answer_at(address, (v[0], v[1], v[2], w[0], w[1], w[2], n[0], n[1], n[2], a, kappa, e, mu, beta))
    return (r[0], r[1], r[2]), (r[3], r[4], r[5])


@functools.cache
def user_address(law: WallKernel) -> int:
    """Compile a law (0.1 to 0.3 s) and return where it lies. It stays there as long as the process lives."""
    kernel(law)

    def entry(
        vx: float, vy: float, vz: float, wx: float, wy: float, wz: float, nx: float, ny: float, nz: float,
        a: float, kappa: float, e: float, mu: float, beta: float, out: Any,
    ) -> None:  # fmt: skip
        v, w = law((vx, vy, vz), (wx, wy, wz), (nx, ny, nz), a, kappa, e, mu, beta)
        out[0], out[1], out[2] = v[0], v[1], v[2]
        out[3], out[4], out[5] = w[0], w[1], w[2]

    return address_of(entry, NUMBERS)
