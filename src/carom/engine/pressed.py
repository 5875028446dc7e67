"""Wall and floor at once, for the event loop: a third of what has to be compiled, and so a part by itself.

It is compiled, or loaded, as one function that the loop calls; when the loop is compiled for the first time another process
does it meanwhile (:mod:`carom.beside`).
"""

from __future__ import annotations

import functools
from collections.abc import Callable
from typing import Any

from carom.beside import wait_for
from carom.kernel import Vec
from carom.laws.two_step import first_impact

__all__ = ["PART", "compiled_pressed", "pressed", "register_pressed"]

# Who compiles it, for carom.beside.
PART = f"{__name__}:compiled_pressed"


def pressed(
    v: Vec, w: Vec, n: Vec, a: float, kappa: float, e: float, mu: float, beta: float,
    floor_e: float, floor_mu: float, floor_beta: float, together: bool,
) -> tuple[Vec, Vec, Vec, Vec, float, int]:  # fmt: skip
    """A wall meets a ball that lies on the floor (carom.laws.two_step); compiled code calls :func:`compiled_pressed`."""
    return first_impact(v, w, n, a, kappa, e, mu, beta, floor_e, floor_mu, floor_beta, 0.0, together)


@functools.cache
def compiled_pressed() -> Callable[..., Any]:
    """:func:`pressed` compiled; from the second time on, loaded."""
    from numba import types

    from carom.compiled import njit

    wait_for(PART)
    vector = types.UniTuple(types.float64, 3)
    return njit(pressed, signature=(*[vector] * 3, *[types.float64] * 8, types.boolean), _nrt=False)


@functools.cache
def register_pressed() -> None:
    """Tell the compiler what :func:`pressed` is."""
    from numba.extending import overload

    from carom.compiled import KERNEL_OPTIONS, cache_folder
    from carom.linked import linked_only

    @overload(pressed, jit_options={**KERNEL_OPTIONS, **linked_only(cache_folder())})  # type: ignore[untyped-decorator]
    def _pressed(
        v: Any, w: Any, n: Any, a: Any, kappa: Any, e: Any, mu: Any, beta: Any,
        floor_e: Any, floor_mu: Any, floor_beta: Any, together: Any,
    ) -> Any:  # fmt: skip
        part = compiled_pressed()

        def call(
            v: Any, w: Any, n: Any, a: Any, kappa: Any, e: Any, mu: Any, beta: Any,
            floor_e: Any, floor_mu: Any, floor_beta: Any, together: Any,
        ) -> Any:  # fmt: skip
            return part(v, w, n, a, kappa, e, mu, beta, floor_e, floor_mu, floor_beta, together)

        return call
