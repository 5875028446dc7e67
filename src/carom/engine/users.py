"""A wall law of a user's own: compiled by itself, called by the engine through its address.

So the engine is compiled once for all laws that will ever be written. (Numba's own functions as arguments would do as
well, but each takes 75 us to hand over, longer than a whole shot.)
"""

from __future__ import annotations

import functools
from collections.abc import Callable
from typing import Any

from carom.kernel import Vec

__all__ = ["call_user", "register_calls", "user_address"]

WallKernel = Callable[[Vec, Vec, Vec, float, float, float, float, float], tuple[Vec, Vec]]
NUMBERS = 14  # velocity, spin, normal, a, kappa, e, mu, beta

_by_address: dict[int, WallKernel] = {}


def call_user(
    address: int, v: Vec, w: Vec, n: Vec, a: float, kappa: float, e: float, mu: float, beta: float
) -> tuple[Vec, Vec]:
    """The law at an address; compiled code jumps there (:func:`register_calls`)."""
    return _by_address[address](v, w, n, a, kappa, e, mu, beta)


@functools.cache
def user_address(law: WallKernel) -> int:
    """Compile a law (0.1 to 0.3 s) and return where it lies. It stays there as long as the process lives."""
    from carom.compiled import cfunc
    from carom.kernel import kernel

    kernel(law)

    def entry(
        vx: float, vy: float, vz: float, wx: float, wy: float, wz: float, nx: float, ny: float, nz: float,
        a: float, kappa: float, e: float, mu: float, beta: float, out: Any,
    ) -> None:  # fmt: skip
        v, w = law((vx, vy, vz), (wx, wy, wz), (nx, ny, nz), a, kappa, e, mu, beta)
        out[0], out[1], out[2] = v[0], v[1], v[2]
        out[3], out[4], out[5] = w[0], w[1], w[2]

    compiled = cfunc(entry, NUMBERS)
    _by_address[compiled.address] = law
    _alive.append(compiled)
    return int(compiled.address)


_alive: list[Any] = []


@functools.cache
def register_calls() -> None:
    """Tell the compiler what :func:`call_user` is."""
    from llvmlite import ir
    from numba import types
    from numba.core import cgutils
    from numba.extending import intrinsic, overload

    @intrinsic  # type: ignore[untyped-decorator]
    def jump(_context: Any, address: Any, numbers: Any) -> Any:
        def build(context: Any, builder: Any, signature: Any, args: Any) -> Any:
            double, index = ir.DoubleType(), ir.IntType(32)
            kind = ir.FunctionType(ir.VoidType(), [double] * NUMBERS + [double.as_pointer()])
            function = builder.inttoptr(args[0], kind.as_pointer())
            out = cgutils.alloca_once(builder, double, size=6)
            builder.call(function, [*cgutils.unpack_tuple(builder, args[1]), out])
            found = [builder.load(builder.gep(out, [ir.Constant(index, k)])) for k in range(6)]
            return context.make_tuple(builder, signature.return_type, found)

        return types.UniTuple(types.float64, 6)(address, numbers), build

    # (Numba compares the annotations of the two signatures as well)
    @overload(call_user)  # type: ignore[untyped-decorator]
    def _call_user(address: Any, v: Any, w: Any, n: Any, a: Any, kappa: Any, e: Any, mu: Any, beta: Any) -> Any:
        def call(address: Any, v: Any, w: Any, n: Any, a: Any, kappa: Any, e: Any, mu: Any, beta: Any) -> Any:
            r = jump(address, (v[0], v[1], v[2], w[0], w[1], w[2], n[0], n[1], n[2], a, kappa, e, mu, beta))
            return (r[0], r[1], r[2]), (r[3], r[4], r[5])

        return call
