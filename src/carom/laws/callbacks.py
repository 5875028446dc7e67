"""Wall laws that are not compiled into the engine (custom laws, spring models): the engine calls them through their address.

So the engine is compiled once, for all custom laws, and its compilation is not lengthened by rarely used ones. (Numba's
first-class functions would also work, but passing each takes 75 us, longer than a whole shot.)
"""

from __future__ import annotations

import functools
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any

from carom.core.jit.calls import address_of, answer_at, python_address, register_answers
from carom.core.jit.dual import (
    dual_address,
    read_duals,
    register_calls_of_duals,
    register_functions,
    register_numbers,
    write_duals,
)
from carom.core.jit.kernel import Vec, kernel
from carom.errors import CaromError

WallKernel = Callable[[Vec, Vec, Vec, float, float, float, float, float], tuple[Vec, Vec]]
NUMBERS = 14  # velocity, spin, normal, a, kappa, e, mu, beta


def register_calls() -> None:
    """Declare the signature by which compiled code calls laws."""
    register_answers()


@kernel
def call_user(
    address: int, v: Vec, w: Vec, n: Vec, a: float, kappa: float, e: float, mu: float, beta: float
) -> tuple[Vec, Vec]:
    """Call the law at an address."""
    r = answer_at(address, (v[0], v[1], v[2], w[0], w[1], w[2], n[0], n[1], n[2], a, kappa, e, mu, beta))
    return (r[0], r[1], r[2]), (r[3], r[4], r[5])


@kernel
def _write_state(out: Any, state: tuple[Vec, Vec]) -> None:
    (out[0], out[1], out[2]), (out[3], out[4], out[5]) = state


@functools.cache
def user_address(law: WallKernel, compiled: bool = True) -> int:
    """Compile a law's kernel (0.1 to 0.3 s; carom's own laws are cached) and return its address.

    The address is valid for the lifetime of the process. With ``compiled`` false, one of carom's own laws gets an address
    usable only from Python. (A custom law is always compiled, because its results in Python may differ by rounding.)
    """
    # (the cache's key is a hash of carom's own sources, which does not change with a custom law)
    own = str(law.__module__).startswith("carom.")
    entry = law_entry(law)
    if own and not compiled:
        return python_address(entry)
    with _explained(law):
        return address_of(entry, NUMBERS, keep=own)


@contextmanager
def _explained(law: WallKernel) -> Iterator[None]:
    """While inside, what Numba says of a custom law is one line."""
    try:
        yield
    except Exception as error:
        if str(law.__module__).startswith("carom.") or not type(error).__module__.startswith("numba."):
            raise
        raise CaromError(_not_compiled(law, str(error))) from error


@functools.cache
def register_duals() -> None:
    """Tell the compiler what dual numbers are, and how laws are called with them."""
    register_calls()
    register_numbers()
    register_functions()
    register_calls_of_duals(NUMBERS)


@functools.cache
def dual_law_address(law: WallKernel) -> int:
    """Compile a law's kernel with dual numbers and return its address: it carries derivatives from before an impact to after it."""
    with _explained(law):
        return dual_address(law_of_duals(law), (register_duals,), keep=str(law.__module__).startswith("carom."))


def _not_compiled(law: WallKernel, said: str) -> str:
    """Return the faults of a custom law that Numba cannot compile."""
    lines = [line.strip() for line in said.splitlines() if line.strip()]
    known = ("Unknown", "Untyped", "Use of", "Cannot", "Unsupported", "No implementation", "NameError")
    told = next((line for line in lines if line.startswith(known)), next(iter(lines), ""))
    return (
        f"law {getattr(law, '__name__', law)}: expected a function that Numba compiles (numbers, tuples and math, no NumPy;"
        f" functions that it calls marked with @kernel of carom.core.jit.kernel), got: {told:.160}"
    )


def law_entry(law: WallKernel) -> Callable[..., None]:
    """Return the function of :data:`NUMBERS` numbers, and of a place to write six to, by which a law is called."""
    kernel(law)

    def entry(
        vx: float, vy: float, vz: float, wx: float, wy: float, wz: float, nx: float, ny: float, nz: float,
        a: float, kappa: float, e: float, mu: float, last: float, out: Any,
    ) -> None:  # fmt: skip
        _write_state(out, law((vx, vy, vz), (wx, wy, wz), (nx, ny, nz), a, kappa, e, mu, last))

    return entry


def law_of_duals(law: WallKernel) -> Callable[..., None]:
    """Return the function of a place to read dual numbers from, and of one to write to, by which a law is called."""
    kernel(law)

    def entry(given: Any, out: Any) -> None:
        x = read_duals(given)
        v, w = law((x[0], x[1], x[2]), (x[3], x[4], x[5]), (x[6], x[7], x[8]), x[9], x[10], x[11], x[12], x[13])
        write_duals(out, v, w)

    return entry
