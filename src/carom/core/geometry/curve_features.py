"""An arc of a smooth curve as a feature of a vertical wall: its hits, gap, normal and bend, in the curve's own frame.

Few scenes have curves, so that the engine calls :mod:`carom.core.geometry.curve_arcs` through an address, as it does for rims. The
feature has the place p and the direction u of the curve's x axis, and in ``lo1`` the address of the arc's table. From places with
derivatives the distance and the normal follow to first order, which is exact for derivatives: n' = -kappa t along the curve.
"""

from __future__ import annotations

import functools
import math
from typing import Any

from carom.core.geometry.curve import ROW
from carom.core.geometry.curve_arc_paths import arc_hit
from carom.core.geometry.curve_arcs import SEAM, arc_contact, arc_gap
from carom.core.jit.kernel import Vec, kernel, vector, without_slopes
from carom.core.jit.pointers import Answer, address_of, answer_at, python_address, register_tables, table_at

__all__ = [
    "HIT", "NUMBERS", "arc_address", "arc_entry", "curve_bend", "curve_depth", "curve_gap", "curve_hit", "curve_is_far",
    "curve_normal",
]  # fmt: skip

NUMBERS = 11
HIT, GAP, CONTACT = 0.0, 1.0, 2.0
LARGE = 1 << 20  # rows: more than a table has


@kernel
def call_arc(
    address: int, what: float, table: float, d: float, x: float, y: float, vx: float, vy: float, gx: float, gy: float,
    until: float, slow: float,
) -> Answer:  # fmt: skip
    """Call the kernels of an arc through their address: a hit, a gap, or a contact."""
    return answer_at(address, (what, table, d, x, y, vx, vy, gx, gy, until, slow))


def arc_entry(
    what: float, table: float, d: float, x: float, y: float, vx: float, vy: float, gx: float, gy: float, until: float,
    slow: float, out: Any,
) -> None:  # fmt: skip
    """Write what is asked of an arc: as it is called by its address, :data:`NUMBERS` numbers, and a place to write to."""
    rows = table_at(int(table), LARGE, ROW)
    if what == HIT:
        out[0] = arc_hit(rows, 0, d, 0.0, x, y, vx, vy, gx, gy, until, slow)
    elif what == GAP:
        out[0], out[1], out[2], out[3] = arc_gap(rows, 0, d, x, y)
    else:
        out[0], out[1], out[2], out[3] = arc_contact(rows, 0, x, y)


@functools.cache
def arc_address(compiled: bool = True) -> int:
    """Return the address of :func:`arc_entry`, compiled once or loaded; or one that only Python knows."""
    return (
        address_of(arc_entry, NUMBERS, keep=True, needs=(register_tables,)) if compiled else python_address(arc_entry)
    )


@kernel
def _in_frame(u: Vec, x: float, y: float) -> tuple[float, float]:
    """Return the components along the direction u and to its left."""
    return u[0] * x + u[1] * y, u[0] * y - u[1] * x


@kernel
def curve_hit(f: Any, a: float, x: Vec, v: Vec, acc: Vec, until: float, slow: float) -> float:
    """Return the time in [0, until] at which a ball of radius a touches an arc, or infinity."""
    u = vector(f.u)
    (px, py), (vx, vy), (gx, gy) = (
        _in_frame(u, x[0] - f.p[0], x[1] - f.p[1]),
        _in_frame(u, v[0], v[1]),
        _in_frame(u, acc[0], acc[1]),
    )
    return call_arc(f.at, HIT, f.lo1, a, px, py, vx, vy, gx, gy, until, slow)[0]


@kernel
def curve_gap(f: Any, a: float, x: Vec) -> float:
    """Return the gap between an arc and a ball, infinite where its nearest point is beyond an end."""
    px, py = _in_frame(vector(f.u), x[0] - f.p[0], x[1] - f.p[1])
    b, qx, qy = without_slopes(a), without_slopes(px), without_slopes(py)
    r = call_arc(f.at, GAP, without_slopes(f.lo1), b, qx, qy, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0)
    gap = r[0] if r[1] <= SEAM * b else math.inf
    return gap + (r[2] * (px - qx) + r[3] * (py - qy) - (a - b))  # type: ignore[no-any-return]


@kernel
def _contact(f: Any, x: Vec) -> tuple[float, float, float, float, float, float]:
    """Return the normal of an arc at a ball, its curvature and the distance of the centre; the centre's change from its value."""
    px, py = _in_frame(vector(f.u), x[0] - f.p[0], x[1] - f.p[1])
    qx, qy = without_slopes(px), without_slopes(py)
    r = call_arc(f.at, CONTACT, without_slopes(f.lo1), 0.0, qx, qy, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0)
    return r[0], r[1], r[2], r[3], px - qx, py - qy


@kernel
def curve_depth(f: Any, x: Vec) -> float:
    """Return the distance between a ball's centre and an arc."""
    nx, ny, _kappa, depth, dx, dy = _contact(f, x)
    return depth + (nx * dx + ny * dy)


@kernel
def curve_normal(f: Any, x: Vec) -> Vec:
    """Return the unit normal of an arc towards a ball."""
    nx, ny, kappa, depth, dx, dy = _contact(f, x)
    turn = (ny * dx - nx * dy) * (kappa / max(1.0 - kappa * depth, 1e-9))
    mx, my, u = nx - turn * ny, ny + turn * nx, vector(f.u)
    return (u[0] * mx - u[1] * my, u[1] * mx + u[0] * my, 0 * x[2])


@kernel
def curve_bend(f: Any, x: Vec, v: Vec) -> float:
    """Return the second derivative of the gap of a ball that moves with v, by the curvature alone."""
    nx, ny, kappa, depth, _dx, _dy = _contact(f, x)
    vx, vy = _in_frame(vector(f.u), v[0], v[1])
    along = vx * ny - vy * nx
    return -along * along * (kappa / max(1.0 - kappa * depth, 1e-9))


@kernel
def curve_is_far(f: Any, a: float, x: Vec, way: float) -> bool:
    """Return whether a ball that comes no further than ``way`` stays outside the circle in which the arc lies."""
    px, py = _in_frame(vector(f.u), x[0] - f.p[0], x[1] - f.p[1])
    px, py = px - f.d[0], py - f.d[1]
    return bool(math.sqrt(px * px + py * py) - f.R - a > way)
