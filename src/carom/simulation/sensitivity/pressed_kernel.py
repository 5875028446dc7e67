"""The derivative of an impact of wall and floor at once in compiled code: as in ``pressed``, lane by lane."""

from __future__ import annotations

import functools
import math
from typing import Any

from carom.core.contact import wall_contact
from carom.core.jit.dual.functions import overload_for_duals
from carom.core.jit.dual.numbers import LANES, as_dual, lane_of, value_of, with_lane
from carom.core.jit.kernel import Vec, dot, kernel
from carom.laws.wall_and_floor.solver import pressed_down
from carom.simulation.wall_and_floor import joint_impact

__all__ = ["register_dual_joint_impact"]

# Share of the motion by which a stencil reaches to both sides; where the regime changes within, a quarter, and so on.
REACH, SMALLEST = 0.02, 1e-7

Numbers = tuple[Vec, Vec, Vec, float, float, float, float, float, float, float, float]
Flat = tuple[float, float, float, float, float, float, float, float, float, float, float, float, float]


@kernel
def _plain(x: Any) -> Vec:
    return (value_of(x[0]), value_of(x[1]), value_of(x[2]))


@kernel
def _lane(x: Any, k: int) -> Vec:
    return (lane_of(x[0], k), lane_of(x[1], k), lane_of(x[2], k))


@kernel
def _moved(x: Vec, d: Vec, h: float) -> Vec:
    return (x[0] + h * d[0], x[1] + h * d[1], x[2] + h * d[2])


@kernel
def _step(x: float, d: float, h: float) -> float:
    return x + h * d if d != 0 else x  # (an infinite friction stays infinite)


@kernel
def _at(z: Numbers, d: Numbers, h: float, together: bool) -> tuple[Flat, int]:
    """Return velocity, spin, impulses and required friction a step h along d, and the regime."""
    v, w, j, jf, required, regime = joint_impact(
        _moved(z[0], d[0], h), _moved(z[1], d[1], h), _moved(z[2], d[2], h), _step(z[3], d[3], h), _step(z[4], d[4], h),
        _step(z[5], d[5], h), _step(z[6], d[6], h), _step(z[7], d[7], h), _step(z[8], d[8], h), _step(z[9], d[9], h),
        _step(z[10], d[10], h), together,
    )  # fmt: skip
    return (v[0], v[1], v[2], w[0], w[1], w[2], j[0], j[1], j[2], jf[0], jf[1], jf[2], required), regime


@kernel
def _share(x: float, d: float) -> float:
    return abs(d) / (abs(x) if 0 < abs(x) < math.inf else 1.0)


@kernel
def _largest(d: Vec) -> float:
    return max(abs(d[0]), abs(d[1]), abs(d[2]))


@kernel
def _combined(slope: Flat, c: float, one: Flat, two: Flat) -> Flat:
    """Return slope + c (one - two)."""
    return (
        slope[0] + c * (one[0] - two[0]), slope[1] + c * (one[1] - two[1]), slope[2] + c * (one[2] - two[2]),
        slope[3] + c * (one[3] - two[3]), slope[4] + c * (one[4] - two[4]), slope[5] + c * (one[5] - two[5]),
        slope[6] + c * (one[6] - two[6]), slope[7] + c * (one[7] - two[7]), slope[8] + c * (one[8] - two[8]),
        slope[9] + c * (one[9] - two[9]), slope[10] + c * (one[10] - two[10]), slope[11] + c * (one[11] - two[11]),
        slope[12] + c * (one[12] - two[12]),
    )  # fmt: skip


@kernel
def _slope(z: Numbers, d: Numbers, regime: int, together: bool) -> Flat:
    """Return the derivative in the direction d, by differences of order 8; NaN where the regime changes at any distance."""
    v, w, a = z[0], z[1], z[3]
    speed = math.sqrt(dot(v, v)) + a * math.sqrt(dot(w, w))
    share = max(_largest(d[0]) / speed, _largest(d[1]) / (speed / a), _largest(d[2]))
    share = max(share, _share(z[3], d[3]), _share(z[4], d[4]))
    share = max(share, _share(z[5], d[5]), _share(z[6], d[6]))
    share = max(share, _share(z[7], d[7]), _share(z[8], d[8]))
    share = max(share, _share(z[9], d[9]), _share(z[10], d[10]))
    none = (0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0)
    if share == 0:
        return none
    reach = REACH
    while reach > SMALLEST:
        h = reach / (4 * share)
        slope, same = none, True
        for k in range(1, 5):
            c = 4 / 5 if k == 1 else (-1 / 5 if k == 2 else (4 / 105 if k == 3 else -1 / 280))
            one, first = _at(z, d, k * h, together)
            two, second = _at(z, d, -k * h, together)
            if first != regime or second != regime:
                same = False
                break
            slope = _combined(slope, c / h, one, two)
        if same:
            return slope
        reach /= 4
    x = math.nan
    return (x, x, x, x, x, x, x, x, x, x, x, x, x)


@kernel
def _set3(x: Any, k: int, a: float, b: float, c: float) -> Any:
    return (with_lane(x[0], k, a), with_lane(x[1], k, b), with_lane(x[2], k, c))


@kernel
def _duals(x: Vec) -> Any:
    return (as_dual(x[0]), as_dual(x[1]), as_dual(x[2]))


@kernel
def dual_joint_impact(
    v: Any, w: Any, n: Any, a: Any, kappa: Any, e: Any, mu: Any, beta: Any, floor_e: Any, floor_mu: Any, floor_beta: Any,
    together: bool,
) -> Any:  # fmt: skip
    """:func:`carom.simulation.wall_and_floor.joint_impact` of dual numbers."""
    z = (
        _plain(v), _plain(w), _plain(n), value_of(a), value_of(kappa), value_of(e), value_of(mu), value_of(beta),
        value_of(floor_e), value_of(floor_mu), value_of(floor_beta),
    )  # fmt: skip
    if not (together and pressed_down(z[0], z[1], z[2], z[3], z[6], 0.0)):
        v1, w1, j, required, regime = wall_contact(v, w, n, a, kappa, e, mu, beta)
        zero = as_dual(0.0)
        return v1, w1, j, (zero, zero, zero), required, regime
    pv, pw, pj, pjf, base, regime = joint_impact(
        z[0], z[1], z[2], z[3], z[4], z[5], z[6], z[7], z[8], z[9], z[10], together
    )
    v1, w1, j, jf, required = _duals(pv), _duals(pw), _duals(pj), _duals(pjf), as_dual(base)
    for k in range(LANES):
        d = (
            _lane(v, k), _lane(w, k), _lane(n, k), lane_of(a, k), lane_of(kappa, k), lane_of(e, k), lane_of(mu, k),
            lane_of(beta, k), lane_of(floor_e, k), lane_of(floor_mu, k), lane_of(floor_beta, k),
        )  # fmt: skip
        s = _slope(z, d, regime, together)
        v1, w1 = _set3(v1, k, s[0], s[1], s[2]), _set3(w1, k, s[3], s[4], s[5])
        j, jf = _set3(j, k, s[6], s[7], s[8]), _set3(jf, k, s[9], s[10], s[11])
        required = with_lane(required, k, s[12])
    return v1, w1, j, jf, required, regime


@functools.cache
def register_dual_joint_impact() -> None:
    """Have compiled code call it where joint_impact is given dual numbers."""
    overload_for_duals(joint_impact, dual_joint_impact)
