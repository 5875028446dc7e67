"""The impact at wall and floor at once, compiled for the event loop as a function of its own.

It is a third of all that has to be compiled. When the loop is compiled for the first time, another process compiles this part
meanwhile (:mod:`carom.core.jit.background`).
"""

from __future__ import annotations

import functools
from collections.abc import Callable
from typing import Any

from carom.core.jit.background import wait_for
from carom.core.jit.compile import call_compiled, njit, signature
from carom.core.jit.kernel import Vec
from carom.laws.two_step import first_impact_and_way

__all__ = ["PART", "compiled_joint_impact", "joint_impact", "register_joint_impact"]

# The job of the other process (carom.core.jit.background).
PART = f"{__name__}:compiled_joint_impact"


def joint_impact(
    v: Vec, w: Vec, n: Vec, a: float, kappa: float, e: float, mu: float, beta: float,
    floor_e: float, floor_mu: float, floor_beta: float, together: bool,
) -> tuple[Vec, Vec, Vec, Vec, float, int, int]:  # fmt: skip
    """A wall meets a ball that lies on the floor (carom.laws.two_step); compiled code calls :func:`compiled_joint_impact`."""
    return first_impact_and_way(v, w, n, a, kappa, e, mu, beta, floor_e, floor_mu, floor_beta, 0.0, together)


@functools.cache
def compiled_joint_impact() -> Callable[..., Any]:
    """:func:`joint_impact` compiled; from the second time on, loaded."""
    wait_for(PART)
    vector = (float, float, float)
    found = (vector, vector, vector, vector, float, int, int)
    return njit(joint_impact, signature(found, *[vector] * 3, *[float] * 8, bool), _nrt=False)


@functools.cache
def register_joint_impact() -> None:
    """Have compiled code call :func:`compiled_joint_impact` for :func:`joint_impact`."""
    call_compiled(joint_impact, compiled_joint_impact)
