"""Bounces of a disc in a stadium to any number of digits, with the no-slip law or the mirror, from the laws' own statements.

Independent of carom: straight sides at y = -r and y = r, half circles about (-l/2, 0) and (l/2, 0), the wall met first, and at it
the tangential impulse that reverses the velocity of the contact point.
"""

from __future__ import annotations

from typing import Any

from mpmath import mp, mpf, sqrt

__all__ = ["closed_orbit", "return_map_trace", "stadium_bounces"]


def stadium_bounces(state: Any, count: int, straight: Any, radius: Any, kappa: Any, no_slip: bool) -> Any:
    """Return the state (x, y, vx, vy, a omega) after a number of bounces, just after the last."""
    x, y, vx, vy, w = state
    half = mpf(straight) / 2
    tiny = mpf(10) ** (-mp.dps // 2)
    for _ in range(count):
        hits = []
        for side in (-1, 1):
            if vy * side > 0:
                t = (side * radius - y) / vy
                if t > tiny and abs(x + t * vx) <= half:
                    hits.append((t, mpf(0), mpf(-side)))
            # the half circle about (side half, 0): |p + t v| = r, met from inside, beyond its middle
            px, py = x - side * half, y
            v2, b = vx * vx + vy * vy, px * vx + py * vy
            root = b * b - v2 * (px * px + py * py - radius * radius)
            if root > 0:
                t = (-b + sqrt(root)) / v2
                if t > tiny and (px + t * vx) * side >= 0:
                    hits.append((t, -(px + t * vx) / radius, -(py + t * vy) / radius))
        t, nx, ny = min(hits)
        x, y = x + t * vx, y + t * vy
        # the tangent (ny, -nx): the contact point at -a n moves along it with v_t + a omega
        across, along = vx * nx + vy * ny, vx * ny - vy * nx
        impulse = -2 * kappa / (1 + kappa) * (along + w) if no_slip else mpf(0)
        along, w, across = along + impulse, w + impulse / kappa, -across
        vx, vy = across * nx + along * ny, across * ny - along * nx
    return x, y, vx, vy, w


def _return_map(state: Any, count: int, straight: Any, radius: Any, kappa: Any, no_slip: bool) -> tuple[Any, Any, Any]:
    """Return coordinates of a state on a wall, the state of such coordinates, and these after a number of bounces.

    The wall's arc length from there, the velocities along and across it, and sqrt(kappa) a omega.
    """
    x, y, vx, vy, w = map(mpf, state)
    half, scale = mpf(straight) / 2, sqrt(mpf(kappa))

    def frame(x: Any, y: Any) -> tuple[Any, Any]:
        if abs(x) <= half:
            return mpf(0), mpf(-1 if y > 0 else 1)
        middle = half if x > 0 else -half
        size = sqrt((x - middle) ** 2 + y * y)
        return -(x - middle) / size, -y / size

    nx, ny = frame(x, y)
    first = (mpf(0), vx * ny - vy * nx, vx * nx + vy * ny, scale * w)

    def state_of(c: Any) -> Any:
        s, along, across, q = c
        if abs(x) <= half:
            px, py, mx, my = x + s * ny, y, nx, ny
        else:
            # along the tangent (ny, -nx) of a circle whose normal points inwards
            turn = s / radius
            mx, my = nx * mp.cos(turn) - ny * mp.sin(turn), nx * mp.sin(turn) + ny * mp.cos(turn)
            middle = half if x > 0 else -half
            px, py = middle - radius * mx, -radius * my
        return px, py, across * mx + along * my, across * my - along * mx, q / scale

    def after(c: Any) -> Any:
        px, py, ux, uy, spin = stadium_bounces(state_of(c), count, straight, radius, kappa, no_slip)
        mx, my = frame(px, py)
        s = (px - x) * ny if abs(x) <= half else radius * mp.asin(nx * my - ny * mx)
        return s, ux * my - uy * mx, ux * mx + uy * my, scale * spin

    return first, state_of, after


def closed_orbit(
    state: Any, count: int, straight: Any, radius: Any, kappa: Any, no_slip: bool, move: Any = (0, 0, 0, 0)
) -> list[Any]:
    """Return the state on a wall near a given one, with the speed 1, to which a number of bounces leads back, and the others.

    Newton's method in the least-squares sense with central differences, from the given state's coordinates plus ``move``.
    """
    first, state_of, after = _return_map(state, count, straight, radius, kappa, no_slip)
    unknowns = 4 if no_slip else 3
    c = [one + mpf(d) for one, d in zip(first, move, strict=True)]
    h = mpf(10) ** (-mp.dps // 3)

    def misses(c: Any) -> list[Any]:
        return [*(p - q for p, q in zip(after(c), c, strict=True)), sum(one * one for one in c[1:]) - 1]

    for _ in range(12):
        slopes = []
        for k in range(unknowns):
            up, down = list(c), list(c)
            up[k] += h
            down[k] -= h
            slopes.append([(p - q) / (2 * h) for p, q in zip(misses(up), misses(down), strict=True)])
        f = misses(c)
        step = mp.lu_solve(mp.matrix(slopes).T, mp.matrix(f))
        c = [one - (step[k] if k < unknowns else 0) for k, one in enumerate(c)]
        if max(abs(one) for one in f) < mpf(10) ** (5 - mp.dps):
            break
    begin = state_of(c)
    return [stadium_bounces(begin, k, straight, radius, kappa, no_slip) if k else begin for k in range(count)]


def return_map_trace(state: Any, count: int, straight: Any, radius: Any, kappa: Any, no_slip: bool) -> tuple[Any, Any]:
    """Return the distance of the state after a number of bounces from one on a wall, and the trace of the map between them.

    Central differences in the coordinates of :func:`_return_map`.
    """
    first, _state_of, after = _return_map(state, count, straight, radius, kappa, no_slip)
    gap = max(abs(p - q) for p, q in zip(after(first), first, strict=True))
    h = mpf(10) ** (-mp.dps // 3)
    trace = mpf(0)
    for k in range(4):
        up, down = list(first), list(first)
        up[k] += h
        down[k] -= h
        trace += (after(up)[k] - after(down)[k]) / (2 * h)
    return gap, trace
