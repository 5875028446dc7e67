"""Scenes looked at by brute force, for comparison: their own geometry, their own motion, no roots of anything.

A run is judged leg by leg, each from the run's own last event, so that no errors pile up. A leg is walked through with a
step that shrinks with the distance to what is near (a distance changes no faster than the ball moves, so nothing lies
between two steps), the motion comes of integrating Coulomb's friction in steps, and a contact is one formula.

- Nothing is missed: a ball is never deeper than DEEP radii in anything; whatever is missed is passed through.
- Nothing is made up or doubled: at a wall, a ball or the floor there is contact, and an approach; at the end of a phase
  the slip, the speed or the spin is gone.
- Position, velocity and spin just before an event are those of the integration, and after it those of the law.
- Energy never grows.
"""

from __future__ import annotations

import collections
import functools
import math
from typing import Any

import numpy as np
from reference.compiling import part

import carom
from carom.core.jit.compile import njit
from carom.core.motion.phases import BOUNCING, FLIGHT, HELD, PIVOTING, ROLLING, SLIDING
from carom.simulation.records import (
    BALL,
    FLOOR,
    HELD_EVENT,
    IN_CLUSTER,
    LEFT_EVENT,
    LOG,
    PHASE,
    POCKETED_EVENT,
    SETTLED,
    WALL,
    WALL_IN_CLUSTER,
)

DEEP = 1e-9
# Of their distance, balls that leave each other; of the radius, a ball and a wall after contacts that overlap in time.
COMPRESSED, TOUCHES = 1e-3 + 1e-7, 2e-7
LEAST = 2e-3  # of the radius: the shortest step, which passes over no more than 1e-6 radii of a graze
CLOSE = 1e-9  # of the radius, for contact; and of the speeds, for states
PLANE, SHEET, BLOCK, PILLAR, TUBE, SPHERE, HOLLOW, ARC, STADIUM, WEDGE, ROUND, SLEEVE, HOLE = range(13)
FAULTS = (
    "", "deep in a wall", "deep in the floor", "deep in a ball", "no contact at the wall", "no approach at the wall",
    "no contact with the floor", "no approach to the floor", "no contact of the balls", "no approach of the balls",
    "a phase that had not ended", "another place before the event", "another velocity before the event",
    "another spin before the event", "another velocity after the event", "another spin after the event",
    "energy grew", "events out of order", "held without touch", "another place than run.at", "over a pocket",
    "not at a pocket's edge", "not into the pocket",
)  # fmt: skip

# --- shapes as rows of numbers: code, wall, parameters -------------------------------------------------------------


def solids(scene: carom.Scene) -> Any:
    """What stands in a scene, one row a piece (P, 14), from the walls' own parameters."""
    rows: list[list[float]] = []
    for i, wall in enumerate(scene.walls):
        kind, w = wall.kind, wall
        n = unit(getattr(w, "normal", (0, 0, 1)))
        if kind == "plane":
            rows.append([PLANE, i, *w.point, *n])
        elif kind == "strip":
            rows.append([PLANE, i, *w.point, *n])
            rows.append([PLANE, i, *(np.array(w.point) + w.width * n), *-n])
        elif kind == "segment":
            rows.append([SHEET, i, *w.start, *w.end, w.low, w.height])
        elif kind == "polygon":
            ends = w.points[1:] + (w.points[:1] if w.closed else ())
            rows += [[SHEET, i, *p, *q, w.low, w.height] for p, q in zip(w.points, ends, strict=False)]
        elif kind == "table" and (w.corner_pockets or w.side_pockets):
            first = sum(len(other.pockets) for other in scene.walls[:i])
            rows += _pocket_table(w, i, first)
        elif kind == "table":
            (x, y), p, q = w.center, w.length / 2, w.width / 2
            around = [(x - p, y - q), (x + p, y - q), (x + p, y + q), (x - p, y + q)]
            low = -math.inf if w.nose_height is None else w.nose_height
            rows += [[SHEET, i, *around[k - 1], *around[k], low, w.height] for k in range(4)]
        elif kind == "box":
            size = np.array(w.size)
            low = np.array(w.corner) if w.corner is not None else np.array(w.center) - size / 2
            if w.inside:
                for k in range(3):
                    e = np.eye(3)[k]
                    rows += [[PLANE, i, *low, *e], [PLANE, i, *(low + size), *-e]]
            else:
                rows.append([BLOCK, i, *low, *(low + size)])
        elif kind == "cylinder":
            kinds = (TUBE, PILLAR) if w.height == math.inf else (SLEEVE, ROUND)
            rows.append([kinds[not w.inside], i, *w.point, *unit(w.axis), w.radius, w.height])
        elif kind == "sphere":
            rows.append([HOLLOW if w.inside else SPHERE, i, *w.center, w.radius])
        elif kind == "arc":
            span = math.radians(w.to_angle - w.from_angle)
            rows.append([ARC, i, *w.center, w.radius, math.radians(w.from_angle) + span / 2, span / 2])
            rows[-1] += [w.low, w.height]
        elif kind == "stadium":
            turn = math.radians(w.angle)
            rows.append([STADIUM, i, *w.center, math.cos(turn), math.sin(turn), w.straight / 2, w.radius])
        elif kind == "wedge":
            axis = unit(w.axis)
            first = np.array((0, 1, 0) if abs(axis[0]) > 1 - 1e-9 else (1, 0, 0), float)
            u = unit(first - (first @ axis) * axis)
            v = np.cross(axis, u)
            for angle in (w.from_angle, w.to_angle):
                c, s = math.cos(math.radians(angle)), math.sin(math.radians(angle))
                rows.append([WEDGE, i, *w.apex, *axis, *(c * u + s * v)])
    out = np.zeros((len(rows), 14))
    for k, row in enumerate(rows):
        out[k, : len(row)] = row
    return out


def _pocket_table(w: Any, i: int, first: int) -> list[list[float]]:
    """What stands in a table with pockets: the edges of pockets, then of each mouth two jaws, and the noses between them."""
    low = -math.inf if w.nose_height is None else w.nose_height
    rows: list[list[float]] = []
    corners = [
        np.array((w.center[0] + w.length / 2 * p, w.center[1] + w.width / 2 * q))
        for p, q in ((-1, -1), (1, -1), (1, 1), (-1, 1))
    ]
    points: list[Any] = []  # ends of noses, counterclockwise
    pocket = 0
    for k, corner in enumerate(corners):
        along = unit(corners[(k + 1) % 4] - corner)
        back = unit(corners[k - 1] - corner)
        longer = (w.length >= w.width) == (k % 2 == 0)
        places = [(w.corner_pockets, corner, back, along, -unit(back + along), math.pi / 2)] if w.corner_pockets else []
        if w.side_pockets and longer:
            out = np.array((along[1], -along[0]))
            places.append((w.side_pockets, (corner + corners[(k + 1) % 4]) / 2, -along, along, out, math.pi))
        if not w.corner_pockets:
            points += [corner, corner]
        for shape, at, one, two, out, opening in places:
            half = shape.mouth / 2 / math.sin(opening / 2)  # from where the two noses' lines meet to a tip
            middle = at - out * half * math.cos(opening / 2)
            center = middle + out * (shape.shelf + shape.radius)
            rows.append([HOLE, -1 - first - pocket, *center, shape.radius])
            pocket += 1
            for nose, turn in ((one, 1.0), (two, -1.0)):
                # from the tip the facing leads away from the nose at the jaw's angle
                tip, angle = at + half * nose, math.radians(shape.jaw_angle) * turn
                facing = np.array(
                    (
                        nose[0] * math.cos(angle) - nose[1] * math.sin(angle),
                        nose[0] * math.sin(angle) + nose[1] * math.cos(angle),
                    )
                )
                far = shape.jaw_radius / math.tan(math.radians(shape.jaw_angle) / 2)
                inner = unit(nose + facing) * shape.jaw_radius / math.sin(math.radians(shape.jaw_angle) / 2)
                towards = -unit(nose + facing)
                span = (math.pi - math.radians(shape.jaw_angle)) / 2
                rows.append(
                    [ARC, i, *(tip + inner), shape.jaw_radius, math.atan2(towards[1], towards[0]), span, low, w.height]
                )
                # (as far as the middle of the pocket, where no ball comes)
                if np.linalg.norm(tip + far * facing - center) > shape.radius:
                    rows.append(
                        [SHEET, i, *(tip + far * facing), *(tip + (center - tip) @ facing * facing), low, w.height]
                    )
                points.append(tip + far * nose)
    ends = [*points[1:], points[0]]
    return rows + [[SHEET, i, *p, *q, low, w.height] for p, q in zip(ends[::2], ends[1::2], strict=True)]


def unit(v: Any) -> Any:
    v = np.array(v, dtype=float)
    return v / np.sqrt(v @ v)


@part
def _gap(s: Any, x: float, y: float, z: float) -> float:  # noqa: PLR0911
    """Distance of a point from a solid; from a pocket's edge as seen from above."""
    kind = s[0]
    if kind == HOLE:
        return math.sqrt((x - s[2]) ** 2 + (y - s[3]) ** 2) - s[4]
    if kind == PLANE:
        return (x - s[2]) * s[5] + (y - s[3]) * s[6] + (z - s[4]) * s[7]
    if kind == SHEET:
        dx, dy = s[4] - s[2], s[5] - s[3]
        t = ((x - s[2]) * dx + (y - s[3]) * dy) / (dx * dx + dy * dy)
        t = min(max(t, 0.0), 1.0)
        h = max(s[6] - z, z - s[7], 0.0)
        return math.sqrt((x - s[2] - t * dx) ** 2 + (y - s[3] - t * dy) ** 2 + h * h)
    if kind == BLOCK:
        p, q, r = max(s[2] - x, x - s[5]), max(s[3] - y, y - s[6]), max(s[4] - z, z - s[7])
        most = max(p, q, r)
        return most if most < 0 else math.sqrt(max(p, 0.0) ** 2 + max(q, 0.0) ** 2 + max(r, 0.0) ** 2)
    if kind in (PILLAR, TUBE):
        rx, ry, rz = x - s[2], y - s[3], z - s[4]
        cx, cy, cz = ry * s[7] - rz * s[6], rz * s[5] - rx * s[7], rx * s[6] - ry * s[5]
        far = math.sqrt(cx * cx + cy * cy + cz * cz) - s[8]
        return far if kind == PILLAR else -far
    if kind in (SPHERE, HOLLOW):
        far = math.sqrt((x - s[2]) ** 2 + (y - s[3]) ** 2 + (z - s[4]) ** 2) - s[5]
        return far if kind == SPHERE else -far
    if kind in (ROUND, SLEEVE):
        rx, ry, rz = x - s[2], y - s[3], z - s[4]
        h = rx * s[5] + ry * s[6] + rz * s[7]
        p = math.sqrt((rx - h * s[5]) ** 2 + (ry - h * s[6]) ** 2 + (rz - h * s[7]) ** 2) - s[8]
        q = max(-h, h - s[9])
        if kind == SLEEVE:
            return math.sqrt(p * p + max(q, 0.0) ** 2)
        most = max(p, q)
        return most if most < 0 else math.sqrt(max(p, 0.0) ** 2 + max(q, 0.0) ** 2)
    if kind == ARC:
        up = max(s[7] - z, z - s[8], 0.0)
        angle = abs((math.atan2(y - s[3], x - s[2]) - s[5] + math.pi) % (2 * math.pi) - math.pi)
        if angle <= s[6]:
            return math.sqrt((math.sqrt((x - s[2]) ** 2 + (y - s[3]) ** 2) - s[4]) ** 2 + up * up)
        one, two = s[5] - s[6], s[5] + s[6]
        d1 = (x - s[2] - s[4] * math.cos(one)) ** 2 + (y - s[3] - s[4] * math.sin(one)) ** 2
        d2 = (x - s[2] - s[4] * math.cos(two)) ** 2 + (y - s[3] - s[4] * math.sin(two)) ** 2
        return math.sqrt(min(d1, d2) + up * up)
    if kind == STADIUM:
        p, q = (x - s[2]) * s[4] + (y - s[3]) * s[5], (y - s[3]) * s[4] - (x - s[2]) * s[5]
        return s[7] - math.sqrt(max(abs(p) - s[6], 0.0) ** 2 + q * q)
    # WEDGE: a half-plane from the apex line
    rx, ry, rz = x - s[2], y - s[3], z - s[4]
    c = rx * s[5] + ry * s[6] + rz * s[7]
    rx, ry, rz = rx - c * s[5], ry - c * s[6], rz - c * s[7]
    t = max(rx * s[8] + ry * s[9] + rz * s[10], 0.0)
    return math.sqrt((rx - t * s[8]) ** 2 + (ry - t * s[9]) ** 2 + (rz - t * s[10]) ** 2)


def free(scene_solids: Any, x: Any) -> float:
    """Distance of a point from all that stands there (a sheet and an arc have no inside)."""
    return min((_gap(s, *x) for s in scene_solids), default=math.inf)


# --- motion and contact --------------------------------------------------------------------------------------------


@part
def _slip(v: Any, w: Any, n: Any, a: float, u: Any) -> float:
    """Slip of the contact point at -a n into u; the normal velocity."""
    un = v[0] * n[0] + v[1] * n[1] + v[2] * n[2]
    u[0] = v[0] - un * n[0] - a * (w[1] * n[2] - w[2] * n[1])
    u[1] = v[1] - un * n[1] - a * (w[2] * n[0] - w[0] * n[2])
    u[2] = v[2] - un * n[2] - a * (w[0] * n[1] - w[1] * n[0])
    return un


@part
def _push(v: Any, w: Any, jx: float, jy: float, jz: float, n: Any, a: float, m: float, k: float) -> None:
    """An impulse on a ball at -a n."""
    v[0] += jx / m
    v[1] += jy / m
    v[2] += jz / m
    c = -1 / (k * m * a)
    w[0] += c * (n[1] * jz - n[2] * jy)
    w[1] += c * (n[2] * jx - n[0] * jz)
    w[2] += c * (n[0] * jy - n[1] * jx)


@part
def _strike(v: Any, w: Any, n: Any, a: float, k: float, e: float, mu: float, beta: float, u: Any) -> None:
    """One contact of a ball of mass 1: (e, mu, beta); the slip before it is written to u."""
    un = _slip(v, w, n, a, u)
    size = math.sqrt(u[0] ** 2 + u[1] ** 2 + u[2] ** 2)
    p = -(1 + e) * un
    f = (1 + beta) * k / (1 + k) * size
    f = min(f, mu * p)
    if size == 0:
        size = 1.0
    _push(v, w, p * n[0] - f * u[0] / size, p * n[1] - f * u[1] / size, p * n[2] - f * u[2] / size, n, a, 1.0, k)


STEPS = 6
UP = (0.0, 0.0, 1.0)


@part
def _move(row: Any, ball: Any, world: Any, s: float, x: Any, v: Any, w: Any, u: Any) -> None:
    """Integrate a ball from a row of the log for a time s, in steps; u is for its slip."""
    for c in range(3):
        x[c], v[c], w[c] = row.x[c], row.v[c], row.w[c]
    a, k, phase = ball.radius, ball.kappa, row.phase
    g = world.g
    if phase == BOUNCING:
        left = s
        while v[2] > 0 and left > 0:
            hop = min(2 * v[2] / g, left)
            x[0] += v[0] * hop
            x[1] += v[1] * hop
            x[2] += v[2] * hop - g * hop * hop / 2
            v[2] -= g * hop
            left -= hop
            if left > 0:
                _strike(v, w, UP, a, k, world.floor_p[0], world.floor_mu, world.floor_beta, u)
                x[2] = a
                if v[2] < 1e-12 * row.v[2]:
                    break
        return
    h = s / STEPS
    for _ in range(STEPS):
        bx = by = bz = tx = ty = 0.0
        if phase == FLIGHT:
            bx, by, bz = world.force[0], world.force[1], world.force[2]
        elif phase == SLIDING:
            u[0], u[1] = v[0] - a * w[1], v[1] + a * w[0]
            size = math.sqrt(u[0] ** 2 + u[1] ** 2)
            if size > 0 and world.floor_mu > 0:
                bx, by = -world.floor_mu * g * u[0] / size, -world.floor_mu * g * u[1] / size
            tx, ty = by / (k * a), -bx / (k * a)
        elif phase == ROLLING:
            size = math.sqrt(v[0] ** 2 + v[1] ** 2)
            if size > 0:
                bx, by = -world.resistance * g * v[0] / size, -world.resistance * g * v[1] / size
            tx, ty = -by / a, bx / a
        if SLIDING <= phase <= PIVOTING:
            fade = world.spin_friction * g / (k * a) * h
            w[2] = max(w[2] - fade, 0.0) if w[2] > 0 else min(w[2] + fade, 0.0)
        x[0] += v[0] * h + bx * h * h / 2
        x[1] += v[1] * h + by * h * h / 2
        x[2] += v[2] * h + bz * h * h / 2
        v[0] += bx * h
        v[1] += by * h
        v[2] += bz * h
        w[0] += tx * h
        w[1] += ty * h


# --- a run is judged -----------------------------------------------------------------------------------------------


def _energy(v: Any, w: Any, m: float, k: float, a: float) -> float:
    return m * (v[0] ** 2 + v[1] ** 2 + v[2] ** 2) / 2 + k * m * a * a * (w[0] ** 2 + w[1] ** 2 + w[2] ** 2) / 2


def _is_in_cluster(log: list[Any], row: int) -> bool:
    """Whether a row is of contacts that overlap in time, which are judged elsewhere (tests/reference/hertz_contacts.py)."""
    return bool(row < len(log) and log[row].kind in (IN_CLUSTER, WALL_IN_CLUSTER))


def _differ(p: Any, q: Any, least: float) -> bool:
    return max(abs(p[0] - q[0]), abs(p[1] - q[1]), abs(p[2] - q[2])) > least


@part
def _pace(v: Any, w: Any, a: float) -> float:
    return math.sqrt(v[0] ** 2 + v[1] ** 2 + v[2] ** 2) + a * math.sqrt(w[0] ** 2 + w[1] ** 2 + w[2] ** 2)


@part
def _speed(v: Any) -> float:
    return math.sqrt(v[0] ** 2 + v[1] ** 2 + v[2] ** 2)


def _walk(
    log: Any, balls: Any, worlds: Any, stuff: Any, last: Any, t: float, until: float, row: int, room: Any, out: Any
) -> None:
    """Nothing on the way: every ball from t to until, with a step that shrinks with the distance.

    out = number of the first fault, row, size, depth allowed in radii; steps taken. ``last`` has each ball's row that it follows,
    ``room`` (7, 3) is for vectors: no array is made here, nor is more compiled than these many steps need.
    """
    world, deep = worlds[0], out[3]
    count = balls.shape[0]
    x, v, w, y, u, q, slip = room[0], room[1], room[2], room[3], room[4], room[5], room[6]
    pull = math.sqrt(world.force[0] ** 2 + world.force[1] ** 2 + world.force[2] ** 2)
    for i in range(count):
        own, ball = log[last[i]], balls[i]
        if own.phase >= HELD:
            continue
        a = ball.radius
        at = t
        while True:
            at_end = at >= until
            at = min(at, until)
            _move(own, ball, world, at - own.t, x, v, w, slip)
            most = _pace(v, w, a) if own.phase != FLIGHT else _speed(v) + pull * (until - at)
            near = math.inf
            for k in range(stuff.shape[0]):
                gap = _gap(stuff[k], x[0], x[1], x[2])
                if stuff[k, 0] == HOLE and gap < -DEEP * a:
                    out[0], out[1], out[2] = 20, row, gap / a
                    return
                near = min(near, gap if stuff[k, 0] == HOLE else gap - a)
            if near < -deep * a:
                out[0], out[1], out[2] = 1, row, near / a
                return
            if world.floor != 0:
                if x[2] - a < -deep * a:
                    out[0], out[1], out[2] = 2, row, x[2] / a - 1
                    return
                if own.phase == FLIGHT:
                    near = min(near, x[2] - a)
            for k in range(count):
                other = log[last[k]]
                if k == i or other.phase >= HELD:
                    continue
                _move(other, balls[k], world, at - other.t, y, u, q, slip)
                far = math.sqrt((x[0] - y[0]) ** 2 + (x[1] - y[1]) ** 2 + (x[2] - y[2]) ** 2)
                gap = far - a - balls[k].radius
                leave = 0.0
                for c in range(3):
                    leave += (x[c] - y[c]) * (v[c] - u[c])
                if gap < (-COMPRESSED * (a + balls[k].radius) if leave > 0 else -deep * min(a, balls[k].radius)):
                    out[0], out[1], out[2] = 3, row, gap / a
                    return
                speed = _pace(u, q, balls[k].radius) if other.phase != FLIGHT else _speed(u) + pull * (until - at)
                near = min(near, gap * most / (most + speed) if most + speed > 0 else gap)
            out[4] += 1
            if at_end:
                break
            at += max(near, LEAST * a) / most if most > 0 else math.inf


def _judge(  # noqa: PLR0911
    run: carom.Trajectory, surfaces: Any, out: Any
) -> None:
    """The first fault of a run: out = number of the fault, row, size, events seen; steps taken."""
    setup, walk = run.arrays, _compiled()
    stuff = solids(run.scene)
    arrays = run.log, setup.balls_to_move(), setup.world, stuff
    log, balls, (world,) = (_rows(one) for one in arrays[:3])
    pieces = stuff.tolist()
    count = len(balls)
    last = np.arange(count)  # each ball's row that it follows
    room = np.zeros((7, 3))
    x, v, w, y, u, q, n = ([0.0, 0.0, 0.0] for _ in range(7))
    pull = math.sqrt(world.force[0] ** 2 + world.force[1] ** 2 + world.force[2] ** 2)
    # (contacts of two balls end sooner)
    lasts = max([1e-3, *(wall.contact_time for wall in run.scene.walls)])
    t, row = 0.0, count
    while True:
        until = log[row].t if row < len(log) else run.end
        if until < t:
            out[0], out[1] = 17, row
            return
        out[3] = TOUCHES if _is_in_cluster(log, row - 1) else max(out[3], DEEP)
        if until > t or not (_is_in_cluster(log, row) or out[3] > DEEP):  # (a cluster's balls are moved at once)
            walk(*arrays, last, t, until, row, room, out)
        if out[0]:
            return
        t = until
        if row >= len(log):
            out[3] = row - count
            return
        # --- the event
        r = log[row]
        i = r.ball
        ball, own = balls[i], log[last[i]]
        a, kappa, m = ball.radius, ball.kappa, ball.mass
        # (the second row of a held ball, and of a pair, stands at the same place)
        _move(own, ball, world, t - own.t, x, v, w, u)
        speed = _pace(v, w, a) + math.sqrt(pull * a)
        # what the rounding of the time changes
        rub = world.floor_mu * (1 + 1 / kappa) if world.floor_mu < math.inf else 0.0
        late = 1e-15 * t * (pull + world.g * (rub + world.resistance + world.spin_friction / kappa))
        close = max(CLOSE, out[3])
        mates = [r, log[row + 1]] if r.kind == BALL and row + 1 < len(log) else [r]
        soon = any(
            log[k].t <= t + lasts and log[k].ball in (one.ball for one in mates)
            for k in range(row + len(mates), min(row + len(mates) + 4, len(log)))
        )
        together = _is_in_cluster(log, row) or _is_in_cluster(log, row + len(mates)) or (r.kind == BALL and soon)
        if r.kind != SETTLED:
            # (after contacts that overlap in time a ball is on the way on which it leaves them: their times are the scene's)
            far = abs(x[0]) + abs(x[1]) + abs(x[2])
            moved = lasts * max(speed, _pace(r.v, r.w, a)) if together else 0.0
            if _differ(x, r.x, moved + close * a + 1e-14 * far):
                out[0], out[1] = 11, row
                return
            if r.kind != HELD_EVENT and _differ(v, r.v_before, CLOSE * speed + late):
                out[0], out[1] = 12, row
                return
            if r.kind != HELD_EVENT and _differ(w, r.w_before, (CLOSE * speed + late) / a):
                out[0], out[1] = 13, row
                return
        elif _differ(x, r.x, 1e-6 * a):
            out[0], out[1] = 11, row
            return
        if r.kind == WALL:
            nearest, code = math.inf, 4
            for piece in pieces:
                if piece[1] != r.other:
                    continue
                near = _gap(piece, x[0], x[1], x[2]) - a
                nearest = near if abs(near) < abs(nearest) else nearest
                if abs(near) > close * a or code == 0:
                    continue
                for c in range(3):  # the normal, from the distance itself; good to 1e-4 where a face ends
                    d = 1e-4 * a
                    y[0], y[1], y[2] = x[0], x[1], x[2]
                    y[c] = x[c] + d
                    more = _gap(piece, y[0], y[1], y[2])
                    y[c] = x[c] - d
                    n[c] = more - _gap(piece, y[0], y[1], y[2])
                size = _speed(n)
                for c in range(3):
                    n[c] /= size
                    v[c], w[c] = r.v_before[c], r.w_before[c]
                un = v[0] * n[0] + v[1] * n[1] + v[2] * n[2]
                if un > 1e-4 * speed:
                    code = 5 if code == 4 else code
                    continue
                f = surfaces[r.other]
                lies = world.floor != 0 and x[2] <= a * (1 + CLOSE)
                if f[3] == 3:
                    _strike(v, w, n, a, kappa, f[0], 0.0, 0.0, u)
                elif f[3] == 2:
                    _strike(v, w, n, a, kappa, 1.0, math.inf, 1.0, u)
                elif f[3] == 0:
                    _strike(v, w, n, a, kappa, f[0], f[1], f[2], u)
                # (contact that lasts goes on in hops, which have no more than 1e-6 of the energy)
                hop = 1e-3 * speed
                # what a floor answers, and the conventional law, are judged elsewhere; grazes are for a better normal
                if f[3] in (1, 4) or lies or un > -1e-3 * speed or _is_in_cluster(log, row + 1):
                    code = 0
                elif _differ(v, r.v, (2e-4 if v[0] * n[0] + v[1] * n[1] + v[2] * n[2] > hop else 1.2e-3) * speed):
                    code = 14
                elif _differ(w, r.w, 2e-4 * speed / a):
                    code = 15
                else:
                    code = 0
            if code != 0:
                out[0], out[1], out[2] = code, row, nearest / a
                return
        elif r.kind == POCKETED_EVENT:
            code = 21
            for piece in pieces:
                own_edge = piece[0] == HOLE and piece[1] == -1 - r.other
                if own_edge and abs(_gap(piece, x[0], x[1], x[2])) <= CLOSE * a:
                    into = (piece[2] - x[0]) * v[0] + (piece[3] - x[1]) * v[1]
                    code = 0 if into > 0 and r.phase > HELD else 22
            if code != 0:
                out[0], out[1] = code, row
                return
        elif r.kind == FLOOR:
            if abs(x[2] - a) > close * a:
                out[0], out[1], out[2] = 6, row, x[2] / a - 1
                return
            if not r.v_before[2] < 0:
                out[0], out[1] = 7, row
                return
            for c in range(3):
                v[c], w[c] = r.v_before[c], r.w_before[c]
            _strike(v, w, UP, a, kappa, world.floor_p[0], world.floor_mu, world.floor_beta, u)
            still = 0.0 if r.phase == FLIGHT else 2e-6 * math.sqrt(world.g * a)  # hops that are not made any more
            if _differ(v, r.v, 1e-11 * speed + 1e-6 * abs(r.v_before[2]) + still):
                out[0], out[1] = 14, row
                return
            if _differ(w, r.w, 1e-9 * speed / a):
                out[0], out[1] = 15, row
                return
        elif r.kind == BALL:
            other, k = log[last[r.other]], r.other
            if other.kind == BALL and other.t == t and log[row - 1].ball == k and r.other == log[row - 1].ball:
                pass  # the second row of the pair: judged with the first
            else:
                b = balls[k]
                _move(other, b, world, t - other.t, y, u, q, n)
                far = math.sqrt((x[0] - y[0]) ** 2 + (x[1] - y[1]) ** 2 + (x[2] - y[2]) ** 2)
                low = COMPRESSED * (a + b.radius) if out[3] > DEEP else close * min(a, b.radius)
                if far - a - b.radius < -low or far - a - b.radius > close * min(a, b.radius):
                    out[0], out[1], out[2] = 8, row, (far - a - b.radius) / a
                    return
                for c in range(3):
                    n[c] = (x[c] - y[c]) / far
                mate = log[row + 1]
                un = 0.0
                for c in range(3):
                    v[c], w[c], u[c], q[c] = r.v_before[c], r.w_before[c], mate.v_before[c], mate.w_before[c]
                    un += (v[c] - u[c]) * n[c]
                if un > 1e-13 * speed:
                    out[0], out[1], out[2] = 9, row, un
                    return
                before = _energy(v, w, m, kappa, a) + _energy(u, q, b.mass, b.kappa, b.radius)
                after = _energy(r.v, r.w, m, kappa, a) + _energy(mate.v, mate.w, b.mass, b.kappa, b.radius)
                if after > before * (1 + 1e-12) and not _is_in_cluster(log, row + 2):
                    out[0], out[1], out[2] = 16, row, after / before - 1
                    return
        elif r.kind == PHASE:
            speed = _pace(r.v_before, r.w_before, a)
            scale = speed + _pace(own.v, own.w, a)
            if r.phase_before == SLIDING:
                wrong = math.hypot(v[0] - a * w[1], v[1] + a * w[0]) > CLOSE * scale + late
            elif r.phase_before == ROLLING:
                wrong = math.hypot(v[0], v[1]) > CLOSE * scale + late
            else:
                wrong = abs(w[2]) * a > CLOSE * scale + late
            if wrong:
                out[0], out[1] = 10, row
                return
        if r.kind not in (BALL, HELD_EVENT, LEFT_EVENT, POCKETED_EVENT):
            before, after = _energy(r.v_before, r.w_before, m, kappa, a), _energy(r.v, r.w, m, kappa, a)
            # (what rounding took of a ball's energy is given back, that of its height too)
            height = m * abs(world.force[0] * x[0] + world.force[1] * x[1] + world.force[2] * x[2])
            if after > before * (1 + 1e-12) + 1e-15 * height and not together:
                out[0], out[1], out[2] = 16, row, after / before - 1
                return
        last[i] = row
        row += 1
        if r.kind == BALL and row < len(log):
            mate = log[row]
            if mate.t == t and mate.kind == BALL and mate.ball == r.other:
                last[mate.ball] = row  # the pair changes at once
                row += 1


def _rows(array: Any) -> list[Any]:
    """Rows of a structured array as named tuples of Python's numbers and lists."""
    row = collections.namedtuple("row", array.dtype.names)
    return [row(*values) for values in zip(*(array[name].tolist() for name in array.dtype.names), strict=True)]


@functools.cache
def _compiled() -> Any:
    """The walk, compiled."""
    return njit(_walk, _nrt=False)


def judge(run: carom.Trajectory) -> tuple[str, int, float, int]:
    """The first fault of a run (empty for none), its row of the log, its size, and the steps taken."""
    surfaces = np.zeros((len(run.scene.walls), 4))
    laws = ("two-step", "conventional", "no-slip", "mirror")
    for i, (wall, law) in enumerate(zip(run.scene.walls, run.scene.wall_laws, strict=True)):
        c = wall.contact
        surfaces[i] = c.p[0], c.mu, c.beta, laws.index(law) if law in laws else 4
    assert run.log.dtype == LOG
    out = np.zeros(5)
    _judge(run, surfaces.tolist(), out)
    return FAULTS[int(out[0])], int(out[1]), float(out[2]), int(out[4])


# --- random scenes ---------------------------------------------------------------------------------------------------


def random_scene(seed: int) -> carom.Scene:
    """A scene of 1 to 4 balls among walls of all shapes; the same for the same seed."""
    rng = np.random.default_rng(seed)

    def pick(*items: Any) -> Any:
        return items[rng.integers(len(items))]

    def vector(size: float = 1.0) -> list[float]:
        return [float(c) for c in rng.normal(size=3) * size]

    floor = rng.random() < 0.6
    law = pick("two-step", "two-step", "two-step", "no-slip", "mirror", "conventional")
    if law == "conventional" and not floor:
        law = "two-step"
    rolling = law == "conventional"
    upright = rolling
    surface = lambda: {  # noqa: E731
        "restitution": 1.0 if rolling else float(pick(0.0, 1.0, rng.random(), 0.9)),
        "friction": float(pick(0.0, 0.2, rng.random(), math.inf)),
        "tangential_restitution": 0.0 if floor else float(pick(0.0, 0.0, rng.uniform(-1, 1))),
    }
    walls: list[dict[str, Any]] = []
    around = pick("box", "tube", "ball", "table", "stadium", "polygon", "strip", "none")
    if rolling and around in ("box", "ball", "none"):
        around = "table"
    if around == "box":
        walls.append({"shape": "box", "center": [0, 0, 0.5], "size": [2, 1.6, 1.4], "inside": True})
        if floor:
            walls[-1]["size"] = [2, 1.6, 2.4]
    elif around == "tube":
        axis = [0, 0, 1] if upright or rng.random() < 0.5 else vector()
        walls.append({"shape": "cylinder", "point": [0, 0, 0], "axis": axis, "radius": 1.0, "inside": True})
    elif around == "ball":
        walls.append({"shape": "sphere", "center": [0, 0, 0.2], "radius": 1.0, "inside": True})
    elif around == "table":
        walls.append({"shape": "table", "length": 2.0, "width": 1.2})
        if floor and not upright and rng.random() < 0.5:
            walls[-1]["nose_height"] = float(rng.uniform(0.02, 0.039))  # lower than the smallest ball is high
        if not upright and rng.random() < 0.4:
            walls[-1]["height"] = float(rng.uniform(0.13, 0.3))
    elif around == "stadium":
        walls.append({"shape": "stadium", "straight": 1.0, "radius": 0.8, "angle": float(rng.uniform(0, 180))})
    elif around == "polygon":
        points = [[-1.0, -0.9], [0.2, -0.2], [1.0, -0.8], [0.9, 0.9], [0.0, 0.4], [-0.9, 1.0]]
        if rng.random() < 0.5:
            points.reverse()
        walls.append({"shape": "polygon", "points": points})
        if not upright and rng.random() < 0.4:
            walls[-1]["height"] = float(rng.uniform(0.03, 0.3))
    elif around == "strip":
        normal = [1.0, 0.5, 0.0] if upright else vector()
        at = -0.8 * unit(normal)
        walls.append({"shape": "strip", "point": [float(c) for c in at], "normal": normal, "width": 1.6})
    for _ in range(rng.integers(0 if walls else 1, 4)):
        kind = pick("plane", "segment", "box", "cylinder", "arc", "sphere", "wedge", "polygon")
        x, y = (float(c) for c in rng.uniform(-0.6, 0.6, 2))
        if kind == "plane":
            n = vector()
            if upright:
                n[2] = 0.0
            p = unit(n) * -rng.uniform(0.3, 0.9)
            walls.append({"shape": "plane", "point": [float(c) for c in p], "normal": n})
        elif kind == "segment":
            end = [x + float(rng.uniform(-0.5, 0.5)), y + float(rng.uniform(-0.5, 0.5))]
            walls.append({"shape": "segment", "start": [x, y], "end": end})
            if not upright and rng.random() < 0.6:
                walls[-1]["low"] = float(pick(-math.inf, 0.0, rng.uniform(0.05, 0.2)))
                walls[-1]["height"] = float(rng.uniform(0.2, 0.3) if rng.random() < 0.5 else rng.uniform(0.2, 0.6))
                if walls[-1]["low"] <= 0 and rng.random() < 0.5:
                    walls[-1]["height"] = float(rng.uniform(0.02, 0.1))
        elif kind == "box":
            size = [float(c) for c in rng.uniform(0.1, 0.4, 3)]
            walls.append({"shape": "box", "center": [x, y, 0.1], "size": [*size[:2], 2.0 if upright else size[2]]})
        elif kind == "cylinder":
            axis = [0, 0, 1] if upright or rng.random() < 0.5 else vector()
            walls.append(
                {"shape": "cylinder", "point": [x, y, 0.3], "axis": axis, "radius": float(rng.uniform(0.02, 0.3))}
            )
        elif kind == "arc":
            start = float(rng.uniform(0, 360))
            to = start + float(rng.uniform(20, 360))
            walls.append(
                {
                    "shape": "arc",
                    "center": [x, y],
                    "radius": float(rng.uniform(0.15, 0.5)),
                    "from_angle": start,
                    "to_angle": to,
                }
            )
        elif kind == "sphere" and not upright:
            walls.append(
                {
                    "shape": "sphere",
                    "center": [x, y, float(rng.uniform(-0.1, 0.3))],
                    "radius": float(rng.uniform(0.02, 0.3)),
                }
            )
        elif kind == "wedge":
            first = float(rng.uniform(0, 360))
            axis = [0, 0, 1] if upright or rng.random() < 0.5 else vector()
            to = first + float(pick(rng.uniform(40, 180), rng.uniform(180, 360), 360.0))
            walls.append({"shape": "wedge", "apex": [x, y, 0.0], "axis": axis, "from_angle": first, "to_angle": to})
        elif kind == "polygon":
            ring = [
                [x + float(r * math.cos(f)), y + float(r * math.sin(f))]
                for r, f in zip(rng.uniform(0.1, 0.3, 5), np.arange(5) * 1.2566, strict=True)
            ]
            walls.append({"shape": "polygon", "points": ring, "closed": bool(rng.random() < 0.7)})
            if not upright and rng.random() < 0.4:
                walls[-1]["height"] = float(rng.uniform(0.03, 0.3))
    if not upright:
        # (numbers of their own, so that all else of a seed stays as it was)
        more = np.random.default_rng([seed, 1])
        for wall in walls:
            if wall["shape"] == "cylinder" and wall is not walls[0] and more.random() < 0.6:
                wall["height"] = float(more.uniform(0.05, 0.6))
                if more.random() < 0.4:
                    wall["inside"] = True
            elif wall["shape"] == "arc" and more.random() < 0.6:
                low = [-math.inf, 0.0, float(more.uniform(0.05, 0.2))][more.integers(3)]
                wall["low"], wall["height"] = low, float(max(low, 0.0) + more.uniform(0.0, 0.3))
    for wall in walls:
        wall.update(surface())
    data: dict[str, Any] = {"walls": walls, "run": {"law": law, "duration": 8.0, "max_events": 60}}
    if floor:
        data["floor"] = {
            "restitution": float(pick(0.0, 0.5, rng.random() * 0.95, 1.0)),
            "friction": float(pick(0.0, 0.2, rng.random(), math.inf)),
            "tangential_restitution": float(pick(0.0, 0.0, rng.uniform(-1, 1))),
            "rolling_resistance": float(pick(0.0, 0.01, 0.1)),
            "spin_friction": float(pick(0.0, 0.02)),
        }
        data["gravity"] = float(pick(9.8, 9.8, 1.0, 0.0))
        if rolling:
            data["gravity"], data["floor"]["friction"] = 9.8, 0.2
    else:
        data["gravity"] = pick(0.0, [float(c) for c in rng.normal(size=3) * 3], 9.8)
    data["ball_contact"] = {
        "restitution": float(pick(1.0, 0.95, rng.random(), 0.0)),
        "friction": float(pick(0.0, 0.06, rng.random())),
        "tangential_restitution": float(pick(0.0, 0.0, rng.uniform(-1, 1))),
    }
    one = {"radius": 0.05, "mass": 0.2, "position": [0.0, 0.0, 50.0]}
    wanted = 1 if rolling else int(rng.integers(1, 5))
    balls: list[dict[str, Any]] = []
    pieces = None
    for _ in range(300):
        if len(balls) == wanted:
            break
        ball = dict(
            one,
            radius=float(rng.uniform(0.02, 0.07)),
            mass=float(rng.uniform(0.1, 0.3)),
            inertia=float(pick(0.4, 2 / 3, rng.uniform(0.05, 0.66))),
        )
        on = floor and (rolling or rng.random() < 0.7)
        x, y = (float(c) for c in rng.uniform(-0.9, 0.9, 2))
        z = ball["radius"] if on else float(rng.uniform(ball["radius"] if floor else -0.3, 0.7))
        ball["position"] = [x, y, z]
        if any(math.dist(b["position"], ball["position"]) < b["radius"] + ball["radius"] + 1e-6 for b in balls):
            continue
        speed = float(pick(0.3, 1.0, 3.0, 10.0))
        ball["velocity"] = vector(speed)
        if on:
            ball["velocity"][2] = 0.0
        if on and (rolling or rng.random() < 0.4):
            ball["rolling"] = True
            ball["spin_z"] = float(rng.normal() * 20)
        elif rng.random() < 0.7:
            ball["spin"] = vector(speed / ball["radius"])
        if not rolling and rng.random() < 0.1:
            ball["velocity"] = [0.0, 0.0, 0.0]
        try:  # whether there is room
            scene = carom.Scene(**{**data, "balls": [ball]})
        except carom.CaromError as error:
            if "expected a floor" in str(error):  # (of a table that falls, whatever the ball)
                break
            continue
        if pieces is None:
            pieces = solids(scene)
        if free(pieces, ball["position"]) - ball["radius"] > 1e-6:
            balls.append(ball)
    if not balls:
        return random_scene(seed + 1_000_000_007)
    return carom.Scene(**{**data, "balls": balls})
