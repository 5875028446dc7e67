"""What one asks of orbits: periods, caustics, sections, drift, escape, whether the measure is kept."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from carom.ball import Ball
from carom.checks import float_array
from carom.errors import CaromError
from carom.orbits.arrays import DONE, ESCAPED
from carom.orbits.draw import starts
from carom.orbits.result import Orbit
from carom.orbits.setup import setup_of
from carom.orbits.tables import Table
from carom.orbits.verbs import follow, whole
from carom.surface import Surface

__all__ = [
    "Caustics", "Drift", "Escape", "Section", "Uniformity", "caustics", "drift", "escape", "period", "section", "uniformity",
]  # fmt: skip

Array = NDArray[np.float64]


def period(found: Orbit, tolerance: float = 1e-9) -> Any:
    """The least p (...) such that the state after each bounce is that p bounces before; 0 where there is none.

    Compared are positions (by the table's size; of a cell or a cylinder those within it), velocities and spins (by the
    energy), each to ``tolerance``, over all bounces; a period is found only if the orbit shows it twice.
    """
    size, ball = found.setup.shape.size, found.setup.ball
    x = found.folded[..., :2] if found.setup.table.name == "cylinder" else found.folded
    speed = found.speed[..., :1, None] if found.t.shape[-1] else np.ones((1, 1))
    spin = found.spin[..., None] if found.setup.planar else found.spin
    parts = (x / size, found.velocity / speed, np.sqrt(ball.kappa) * ball.radius * spin / speed)
    states = np.concatenate(parts, axis=-1)
    count = states.shape[-2]
    answer = np.zeros(states.shape[:-2], int)
    # the first return of the first state, then all the others
    for p in range(1, count // 2 + 1):
        near = (np.abs(states[..., p, :] - states[..., 0, :]) <= tolerance).all(-1) & (answer == 0)
        if near.any():
            worst = np.abs(states[near][..., p:, :] - states[near][..., :-p, :]).max(axis=(-1, -2))
            answer[near] = np.where(worst <= tolerance, p, 0)
    return answer if answer.ndim else int(answer)


@dataclass(frozen=True, eq=False)
class Caustics:
    """Circles about a centre that the flights of an orbit touch: their radii, one for the flights after odd bounces, one after

    even ones, and how far the flights scatter about them (zero for a true caustic).
    """

    radii: Array
    """(..., 2)."""
    scatter: Array
    """(..., 2): greatest less least distance of the flights from the centre."""


def caustics(found: Orbit, centre: Sequence[float] = (0.0, 0.0)) -> Caustics:
    """How near to a centre every second flight passes: the envelopes of an orbit in a circle.

    In space the orbit is seen along z. CaromError where a force bends the flights.
    """
    if any(found.setup.table.pull[:2]):
        raise CaromError(
            f"caustics: table: expected one whose flights are straight (seen along z), got {found.setup.table}"
        )
    x, v = found.position[..., :2] - np.asarray(centre, float), found.velocity[..., :2]
    distance = np.abs(x[..., 0] * v[..., 1] - x[..., 1] * v[..., 0]) / np.hypot(v[..., 0], v[..., 1])
    both = [distance[..., k::2] for k in (0, 1)]
    return Caustics(
        np.stack([np.nanmean(one, axis=-1) for one in both], axis=-1),
        np.stack([np.nanmax(one, axis=-1) - np.nanmin(one, axis=-1) for one in both], axis=-1),
    )


@dataclass(frozen=True, eq=False)
class Section:
    """Where flights cross a line, in order: arrays of all crossings of all orbits."""

    orbit: NDArray[np.int64]
    """Which orbit (of many, counted in order)."""
    t: Array
    at: Array
    """Where on the line, from its point, along its direction."""
    velocity: Array
    """Of the ball there, (M, d)."""
    spin: Array


def section(
    found: Orbit, point: Sequence[float] = (0.0, 0.0), direction: Sequence[float] = (1.0, 0.0), *, both: bool = False
) -> Section:
    """Poincaré's section of the flow with a line of the plane, crossed to its left; ``both``: to its right as well.

    In a periodic cell the flights are not folded back; in space the line stands for the plane along z through it.
    """
    p, e = np.asarray(point, float), np.asarray(direction, float)
    if p.shape != (2,) or e.shape != (2,) or not np.isfinite([*p, *e]).all() or not e.any():
        raise CaromError(f"section: expected a point and a direction, got {point!r} and {direction!r}")
    e = e / math.hypot(*e)
    d = found.setup.table.dimension
    bounces = found.t.shape[-1]
    x, v = found.position.reshape(-1, bounces, d), found.velocity.reshape(-1, bounces, d)
    t = found.t.reshape(-1, bounces)
    spin = found.spin.reshape(len(t), bounces, *found.spin.shape[found.t.ndim :])
    g = np.array(found.setup.table.pull[:2])
    height = e[0] * (x[..., 1] - p[1]) - e[1] * (x[..., 0] - p[0])
    rate, force = e[0] * v[..., 1] - e[1] * v[..., 0], e[0] * g[1] - e[1] * g[0]
    if force:
        raise CaromError("section: expected a line along the force, or a table without one")
    with np.errstate(divide="ignore", invalid="ignore"):
        after = -height / rate
        met = (after >= 0) & (after < np.append(np.diff(t), np.full((len(t), 1), np.nan), axis=1))
    met &= (rate > 0) | both
    who, k = np.nonzero(met)
    dt = after[who, k]
    where = x[who, k, :2] + v[who, k, :2] * dt[:, None] + g * (dt * dt / 2)[:, None]
    pull = np.array(found.setup.table.pull[:d])
    return Section(who, t[who, k] + dt, (where - p) @ e, v[who, k] + pull * dt[:, None], spin[who, k])


@dataclass(frozen=True, eq=False)
class Drift:
    """How an orbit goes along an axis."""

    extent: Any
    """(...): greatest less least place, m."""
    velocity: Any
    """(...): mean velocity, from the first to the last bounce, m/s."""
    acceleration: Any
    """(...): of the parabola that fits the places best, m/s^2."""
    growth: Any
    """(...): extent of the whole orbit over that of its first half: 1 bounded, 2 a drift, 4 a fall."""


def drift(found: Orbit, axis: int | None = None) -> Drift:
    """How far an orbit goes along an axis of its table, x, y or z (0, 1, 2); left out: the one along which it is open."""
    if axis is None:
        axis = 2 if found.setup.table.dimension == 3 and found.setup.table.name == "cylinder" else 0
    if axis not in range(found.setup.table.dimension):
        raise CaromError(f"drift: axis: expected one of {list(range(found.setup.table.dimension))}, got {axis!r}")
    if (np.asarray(found.count) < 4).any():
        raise CaromError("drift: orbit: expected at least 4 bounces")
    place, t = found.position[..., axis], found.t
    half = place.shape[-1] // 2

    def extent(part: Array) -> Any:
        return np.nanmax(part, axis=-1) - np.nanmin(part, axis=-1)

    span = np.nanmax(t, axis=-1) - t[..., 0]
    u = (t - t[..., :1]) / span[..., None]
    flat, rows = place.reshape(-1, place.shape[-1]), u.reshape(-1, place.shape[-1])
    bend = [np.polyfit(a[np.isfinite(b)], b[np.isfinite(b)], 2)[0] for a, b in zip(rows, flat, strict=True)]
    ends = np.array([b[np.isfinite(b)][[0, -1]] for b in flat])
    with np.errstate(divide="ignore", invalid="ignore"):
        return Drift(
            extent(place), (ends[:, 1] - ends[:, 0]).reshape(span.shape) / span,
            2 * np.array(bend).reshape(span.shape) / span**2, extent(place) / extent(place[..., :half]),
        )  # fmt: skip


@dataclass(frozen=True, eq=False)
class Escape:
    """When orbits leave."""

    t: Array
    """(...): time at which the orbit leaves through a hole, or of its last bounce before it flies off; NaN where it stays."""
    bounces: NDArray[np.int64]
    """(...): after how many bounces; those made where it stays."""
    escaped: NDArray[np.bool_]


def escape(
    table: Table,
    start: Any,
    bounces: int = 10_000,
    *,
    holes: Sequence[Sequence[float]] = (),
    ball: Ball | None = None,
    law: Any = "no-slip",
    surface: Surface | None = None,
) -> Escape:
    """When orbits leave: an open table (a wedge) for good, or a closed one through holes in its wall.

    ``holes``: intervals (from, to) of arc length; a ball that would bounce there is gone. Other arguments as
    :func:`carom.orbits.orbit`.
    """
    setup = setup_of(table, ball, law, surface, "end")
    bounces = whole("bounces", bounces)
    intervals = float_array(holes).reshape(-1, 2) if len(holes) else np.empty((0, 2))
    if not (intervals[:, 0] < intervals[:, 1]).all():
        raise CaromError(f"escape: holes: expected intervals (from, to) of arc length, from < to, got {holes!r}")
    first = follow(setup, start, 1)  # (checks the starts)
    shape = np.shape(first.count)
    n = int(np.prod(shape))
    t, count, gone = np.full(n, np.nan), np.full(n, bounces), np.zeros(n, bool)
    block = max(1, min(bounces, 20_000_000 // max(n, 1)))
    now = first.start
    d = table.dimension
    left = np.arange(n)
    clock = np.zeros(n)
    x, v = (np.asarray(a).reshape(n, d) for a in (now.position, now.velocity))
    w = np.asarray(now.spin).reshape(n, *(() if setup.planar else (3,)))
    done = 0
    while done < bounces and len(left):
        share = min(block, bounces - done)
        run = follow(setup, (x, v, w), share)
        s = run.arc
        through = np.zeros(s.shape, bool)
        for low, high in intervals:
            through |= (s >= low) & (s <= high)
        hit = np.asarray(through.any(1))
        k = np.asarray(np.where(hit, np.argmax(through, 1), run.count))
        off = ~hit & (np.asarray(run.ending) == ESCAPED)
        out = hit | off
        row = np.arange(len(left))
        at = np.where(hit, run.t[row, np.minimum(k, share - 1)], run.last[:, 0])
        t[left[out]] = clock[left[out]] + at[out]
        count[left[out]] = done + k[out] + hit[out]
        gone[left[out]] = True
        stuck: NDArray[np.bool_] = ~out & (np.asarray(run.ending) != DONE)
        count[left[stuck]] = done + np.asarray(run.count)[stuck]
        on = ~out & ~stuck
        clock[left] += run.last[:, 0]
        left = left[on]
        x, v = run.last[on, 1 : 1 + d], run.last[on, 4 : 4 + d]
        w = run.last[on, 9] if setup.planar else run.last[on, 7:]
        done += share
    return Escape(t.reshape(shape), count.reshape(shape), gone.reshape(shape))


@dataclass(frozen=True)
class Uniformity:
    """Kolmogorov and Smirnov's test of whether the invariant measure is kept."""

    bounces: int
    orbits: int
    distance: dict[str, float]
    """The greatest distance of the found distribution from the even one: of the arc length, of the radius squared and of the

    angle in the velocity's phase disc.
    """
    p: dict[str, float]
    """The chance of a distance at least as great if the measure is kept."""


def uniformity(
    table: Table,
    orbits: int = 10_000,
    bounces: int = 100,
    seed: int = 0,
    *,
    ball: Ball | None = None,
    law: Any = "no-slip",
    surface: Surface | None = None,
) -> Uniformity:
    """Draw starts from the measure ``|v.n|`` ds dv d(spin) on one energy, let them bounce, and test whether they still fill it.

    Evenly distributed are then: the arc length (of a sphere the height); the radius in the unit ball of all velocities but
    the one across, to the power of its dimension (2 in the plane, 5 in space); the angle in the velocity's phase disc. For
    closed tables without a force; of a cylinder with lids the bounces at its side are looked at for arc and angle.
    """
    setup = setup_of(table, ball, law, surface, "pass")
    if any(table.pull):
        raise CaromError(f"uniformity: table: expected one without a force, got {table}")
    if any(math.isinf(f[4] - f[3]) for f in setup.shape.faces if not f[0][2]):
        raise CaromError(f"uniformity: table: expected one whose wall has an end, got {table}")
    found = follow(setup, starts(table, orbits, seed, ball=ball, law=law), bounces)
    good = np.asarray(found.count) == bounces
    # (what follows is told of the last bounce alone)
    ends = {name: getattr(found, name)[:, -1:] for name in ("t", "position", "velocity", "spin", "piece")}
    found, shape = replace(found, **ends), setup.shape
    side = good & ~np.isin(found.piece[:, -1], [k for k, f in enumerate(shape.faces) if f[0][2]])
    if shape.sphere is not None:
        arc = found.position[side, -1, 2] / (2 * shape.sphere) + 0.5
    else:
        lengths = shape.lengths
        arc = found.arc[side, -1] / lengths[np.isfinite(lengths)].sum()
    across = np.sqrt(found._rolls) * found.across[good, -1] / found.speed[good, -1]
    disc = found.phase[side, -1]
    values = {
        "arc": arc,
        "radius": np.maximum(1 - across**2, 0.0) ** (1.0 if setup.planar else 2.5),
        "angle": np.arctan2(disc[:, 1], disc[:, 0]) / math.tau + 0.5,
    }
    distance = {name: _distance(np.sort(value)) for name, value in values.items()}
    chance = {name: _chance(distance[name], len(value)) for name, value in values.items()}
    return Uniformity(bounces, int(good.sum()), distance, chance)


def _distance(u: Array) -> float:
    """Greatest distance of the sample's distribution from that of numbers spread evenly over [0, 1]."""
    n = len(u)
    return float(max((np.arange(1, n + 1) / n - u).max(), (u - np.arange(n) / n).max()))


def _chance(d: float, n: int) -> float:
    """Kolmogorov's limit distribution, with Stephens's correction for finite samples."""
    x = (math.sqrt(n) + 0.12 + 0.11 / math.sqrt(n)) * d
    if x < 0.2:
        return 1.0
    return min(1.0, max(0.0, 2 * sum((-1.0) ** (k - 1) * math.exp(-2 * k * k * x * x) for k in range(1, 101))))
