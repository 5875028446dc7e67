"""A wall law that is not compiled into the engine, a user's own or one with springs: called by the engine through its address.

So the engine is compiled once for all laws that will ever be written, and no longer for those that few ask for. (Numba's own
functions as arguments would do as well, but each takes 75 us to hand over, longer than a whole shot.)
"""

from __future__ import annotations

import functools
from collections.abc import Callable
from typing import Any

from carom.core.jit.kernel import Vec, kernel
from carom.core.jit.pointers import address_of, answer_at, python_address, register_answers

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


@kernel
def _write(out: Any, state: tuple[Vec, Vec]) -> None:
    (out[0], out[1], out[2]), (out[3], out[4], out[5]) = state


@functools.cache
def user_address(law: WallKernel, compiled: bool = True) -> int:
    """Compile a law's kernel (0.1 to 0.3 s; one of carom's own is loaded from the second time on) and return its address.

    The address is valid as long as the process lives. With ``compiled`` false, one of carom's own laws gets an address that only
    Python knows. (A law of the user's is compiled all the same: it need not give the same bits as Python.)
    """
    kernel(law)

    def entry(
        vx: float, vy: float, vz: float, wx: float, wy: float, wz: float, nx: float, ny: float, nz: float,
        a: float, kappa: float, e: float, mu: float, last: float, out: Any,
    ) -> None:  # fmt: skip
        _write(out, law((vx, vy, vz), (wx, wy, wz), (nx, ny, nz), a, kappa, e, mu, last))

    # (the cache's key is a hash of carom's own sources: a law from elsewhere may have changed)
    own = str(law.__module__).startswith("carom.")
    return address_of(entry, NUMBERS, keep=own) if compiled or not own else python_address(entry)
