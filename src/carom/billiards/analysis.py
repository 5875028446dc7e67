"""Analyse orbits: periods, caustics, Poincaré sections, drift, uniformity of the invariant measure."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from carom.billiards.orbits import CONSERVED, Orbit, orbit_from_setup, starts, state_of_rows
from carom.billiards.setup import orbit_setup
from carom.billiards.tables import Table
from carom.bodies import Ball, Numbers, Surface, holds_arrays
from carom.core.jit.threads import block_slices
from carom.errors import CaromError, Fault

Array = NDArray[np.float64]
MAX_BOUNCES_AT_ONCE = 20_000_000
DRIFT_PARTS = 20  # of an orbit, whose scatter gives the errors of its drift


def period(found: Orbit, tolerance: float = 1e-9) -> int | NDArray[np.int64]:
    """Return the period (...) of orbits in bounces: the least p with equal states at bounces k and k + p; 0 where none is found.

    Positions (relative to the table's size; in a periodic cell or a cylinder, within it), velocities and spins (relative to the
    energy) are compared to ``tolerance`` over all bounces; an orbit must show its period at least twice.

    Parameters
    ----------
    found : Orbit, one or many
    tolerance : float, relative

    Returns
    -------
    int or array (...)

    Examples
    --------
    >>> from carom import billiards
    >>> found = billiards.orbit(billiards.rectangle(2.0, 1.0), ((0.0, 0.1), (1.0, 0.5), 0.0), bounces=40, law="mirror")
    >>> billiards.period(found)
    4
    """
    size, ball = found.setup.shape.size, found.setup.ball
    x = found.folded[..., :2] if found.setup.table.name == "cylinder" else found.folded
    speed = found.speed[..., :1, None] if found.t.shape[-1] else np.ones((1, 1))
    spin = found.spin[..., None] if found.setup.planar else found.spin
    parts = (x / size, found.velocity / speed, np.sqrt(ball.kappa) * ball.radius * spin / speed)
    states = np.concatenate(parts, axis=-1)
    count = states.shape[-2]
    answer = np.zeros(states.shape[:-2], int)
    # first the returns of the first state, then of all the others
    for p in range(1, count // 2 + 1):
        near = (np.abs(states[..., p, :] - states[..., 0, :]) <= tolerance).all(-1) & (answer == 0)
        if near.any():
            worst = np.abs(states[near][..., p:, :] - states[near][..., :-p, :]).max(axis=(-1, -2))
            answer[near] = np.where(worst <= tolerance, p, 0)
    return answer if answer.ndim else int(answer)


@dataclass(frozen=True, eq=False)
class Caustics:
    """Circles about a centre that the flights of an orbit touch: one for the flights after odd bounces, one for the others.

    Examples
    --------
    >>> from carom import billiards
    >>> found = billiards.orbit(billiards.circle(), ((0.2, 0.1), (0.8, 0.3), 0.5), bounces=100)
    >>> bool((billiards.caustics(found).scatter < 1e-11).all())
    True
    """

    radii: Array
    """(..., 2): m."""
    scatter: Array
    """(..., 2): range of the distances of the flights from the centre, m; zero for a true caustic."""


def caustics(found: Orbit, centre: Sequence[float] = (0.0, 0.0)) -> Caustics:
    """Return the mean distance of every second flight from a centre: the caustics of an orbit in a circle.

    Parameters
    ----------
    found : Orbit, one or many; in space it is projected along z
    centre : (x, y), m

    Returns
    -------
    Caustics, NaN where there is no such flight. CaromError if an acceleration bends the flights.
    In a magnetic field the distance of a flight is the distance of its circle from the centre.

    Examples
    --------
    >>> from carom import billiards
    >>> found = billiards.orbit(billiards.circle(), ((0.0, 0.5), (1.0, 0.0), 0.0), bounces=10, law="mirror")
    >>> billiards.caustics(found).radii.round(12)
    array([0.5, 0.5])
    """
    if any(found.setup.table.acceleration[:2]):
        expected = "a table of straight flights (along z apart) or arcs of circles"
        raise CaromError(Fault("caustics", "", expected, f"{found.setup.table}"))
    x, v = found.position[..., :2] - np.asarray(centre, float), found.velocity[..., :2]
    moment, speed = x[..., 0] * v[..., 1] - x[..., 1] * v[..., 0], np.hypot(v[..., 0], v[..., 1])
    distance = np.abs(moment) / speed
    if field := found.setup.table.magnetic_field:
        # the circle's middle x + J v/field is at a distance d, and d - r = (d^2 - r^2)/(d + r)
        d = np.hypot(x[..., 0] - v[..., 1] / field, x[..., 1] + v[..., 0] / field)
        distance = np.abs(((x * x).sum(-1) - 2 * moment / field) / (d + speed / abs(field)))
    # (..., N, 2), flights after odd and after even bounces; a single one has none of one kind
    more = [(0, 0)] * (distance.ndim - 1) + [(0, 2 - distance.shape[-1] % 2)]
    flights = np.pad(distance, more, constant_values=np.nan).reshape(*distance.shape[:-1], -1, 2)
    with np.errstate(invalid="ignore"):
        radii = np.nansum(flights, axis=-2) / np.isfinite(flights).sum(axis=-2)
    return Caustics(radii, np.fmax.reduce(flights, axis=-2) - np.fmin.reduce(flights, axis=-2))


@dataclass(frozen=True, eq=False)
class Section:
    """Crossings of flights with a line, in order, of all orbits.

    Examples
    --------
    >>> from carom import billiards
    >>> found = billiards.orbit(billiards.circle(), ((0.0, 0.5), (1.0, 0.0), 0.0), bounces=10, law="mirror")
    >>> len(billiards.section(found).t)
    3
    """

    orbit: NDArray[np.int64]
    """(M): index of the orbit."""
    t: Array
    """(M): time, s."""
    at: Array
    """(M): coordinate along the line, measured from its point, m."""
    velocity: Array
    """(M, d): velocity there, m/s."""
    spin: Array
    """(M) in the plane, (M, 3) in space: rad/s."""


def section(
    found: Orbit, point: Sequence[float] = (0.0, 0.0), direction: Sequence[float] = (1.0, 0.0), *, both: bool = False
) -> Section:
    """Return the Poincaré section of orbits with a line in the plane, crossed from its right to its left.

    Parameters
    ----------
    found : Orbit
        The orbits. In a periodic cell the flights are not folded back.
    point, direction : sequence of 2 floats
        A point of the line and its direction; in space it stands for the plane parallel to z through it.
    both : bool
        Whether crossings from left to right count as well.

    Returns
    -------
    Section

    Raises
    ------
    CaromError
        A force that is not parallel to the line, a magnetic field.

    Examples
    --------
    >>> from carom import billiards
    >>> found = billiards.orbit(billiards.circle(), ((0.0, 0.5), (1.0, 0.0), 0.0), bounces=10, law="mirror")
    >>> bool((abs(billiards.section(found, both=True).at) >= 0.5).all())
    True
    """
    p, e = np.asarray(point, float), np.asarray(direction, float)
    if p.shape != (2,) or e.shape != (2,) or not np.isfinite([*p, *e]).all() or not e.any():
        raise CaromError(Fault("section", "", "a point (x, y) and a direction (x, y)", f"{point!r} and {direction!r}"))
    e = e / math.hypot(*e)
    d = found.setup.table.dimension
    bounces = found.t.shape[-1]
    x, v = found.position.reshape(-1, bounces, d), found.velocity.reshape(-1, bounces, d)
    t = found.t.reshape(-1, bounces)
    spin = found.spin.reshape(len(t), bounces, *found.spin.shape[found.t.ndim :])
    g = np.array(found.setup.table.acceleration[:2])
    height = e[0] * (x[..., 1] - p[1]) - e[1] * (x[..., 0] - p[0])
    rate, force = e[0] * v[..., 1] - e[1] * v[..., 0], e[0] * g[1] - e[1] * g[0]
    if found.setup.table.magnetic_field:
        raise CaromError(Fault("section", "", "a table without a magnetic field", f"{found.setup.table}"))
    if force:
        raise CaromError(Fault("section", "direction", "that of the force, or a table without one"))
    with np.errstate(divide="ignore", invalid="ignore"):
        after = -height / rate
        met = (after >= 0) & (after < np.append(np.diff(t), np.full((len(t), 1), np.nan), axis=1))
    met &= (rate > 0) | both
    who, k = np.nonzero(met)
    dt = after[who, k]
    where = x[who, k, :2] + v[who, k, :2] * dt[:, None] + g * (dt * dt / 2)[:, None]
    pull = np.array(found.setup.table.acceleration[:d])
    return Section(who, t[who, k] + dt, (where - p) @ e, v[who, k] + pull * dt[:, None], spin[who, k])


@dataclass(frozen=True, eq=False)
class Drift:
    """Motion of an orbit along an axis.

    Examples
    --------
    >>> from carom import billiards
    >>> found = billiards.orbit(billiards.strip(), ((0.0, 0.0), (0.3, 1.0), 0.0), bounces=100, law="mirror")
    >>> float(billiards.drift(found).velocity.round(12))
    0.3
    """

    extent: Numbers
    """(...): greatest minus least coordinate, m."""
    velocity: Numbers
    """(...): mean velocity, from the first to the last bounce, m/s."""
    acceleration: Numbers
    """(...): acceleration of the parabola fitted to the coordinates, m/s^2."""
    growth: Numbers
    """(...): extent of the orbit over the extent of its first half: 1 bounded, 2 uniform drift, 4 uniform acceleration."""
    velocity_error: Numbers
    """(...): standard error of the mean velocity, from the scatter of parts about a uniform acceleration; NaN for fewer
    than 40 bounces."""
    acceleration_error: Numbers
    """(...): standard error of the acceleration, likewise."""


def drift(found: Orbit, axis: int | None = None) -> Drift:
    """Return extent, mean velocity and acceleration of orbits along an axis.

    Parameters
    ----------
    found : Orbit, one or many
    axis : 0, 1 or 2 for x, y or z; default: the axis along which the table is open

    Returns
    -------
    Drift. Raises CaromError for orbits with fewer than 4 bounces.

    Examples
    --------
    No-slip orbits in a strip stay bounded (Broomhead & Gutkin 1993):

    >>> from carom import billiards
    >>> found = billiards.orbit(billiards.strip(), ((0.0, 0.0), (0.3, 1.0), 0.2), bounces=1000)
    >>> float(billiards.drift(found).growth.round(6))
    1.0
    """
    if axis is None:
        axis = 2 if found.setup.table.name == "cylinder" else 0
    if axis not in range(found.setup.table.dimension):
        raise CaromError(Fault("drift", "axis", f"one of {list(range(found.setup.table.dimension))}", repr(axis)))
    if (np.asarray(found.count) < 4).any():
        raise CaromError(Fault("drift", "orbit", "at least 4 bounces"))
    coordinate, t = found.position[..., axis], found.t
    half = coordinate.shape[-1] // 2

    def extent(part: Array) -> Array:
        found: Array = np.nanmax(part, axis=-1) - np.nanmin(part, axis=-1)
        return found

    span = np.nanmax(t, axis=-1) - t[..., 0]
    u = (t - t[..., :1]) / span[..., None]
    flat, rows = coordinate.reshape(-1, coordinate.shape[-1]), u.reshape(-1, coordinate.shape[-1])
    bend = [np.polyfit(a[np.isfinite(b)], b[np.isfinite(b)], 2)[0] for a, b in zip(rows, flat, strict=True)]
    ends = np.array([b[np.isfinite(b)][[0, -1]] for b in flat])
    errors = np.array([_scatter(a[np.isfinite(b)], b[np.isfinite(b)]) for a, b in zip(rows, flat, strict=True)])
    with np.errstate(divide="ignore", invalid="ignore"):
        return Drift(
            extent(coordinate), (ends[:, 1] - ends[:, 0]).reshape(span.shape) / span,
            2 * np.array(bend).reshape(span.shape) / span**2, extent(coordinate) / extent(coordinate[..., :half]),
            errors[:, 0].reshape(span.shape) / span, errors[:, 1].reshape(span.shape) / span**2,
        )  # fmt: skip


def _scatter(u: Array, x: Array) -> tuple[float, float]:
    """Return standard errors of the mean velocity and of the acceleration of coordinates x over times u from 0 to 1.

    Mean velocities of parts of the orbit scatter about a straight line in time. Their acceleration is from a parabola through the
    coordinates, whose variance is 10/7 of the variance of the line's slope where velocities are independent.
    """
    if len(u) < 2 * DRIFT_PARTS:
        return math.nan, math.nan
    cuts = np.linspace(0, len(u) - 1, DRIFT_PARTS + 1).round().astype(int)
    size, middle = np.diff(u[cuts]), (u[cuts[1:]] + u[cuts[:-1]]) / 2
    velocity = np.diff(x[cuts]) / size
    middle = middle - middle @ size
    slope = (velocity * middle) @ size / ((middle * middle) @ size)
    rest = velocity - velocity @ size - slope * middle
    spread = math.sqrt(float(rest * rest @ size) / (DRIFT_PARTS - 2))
    return spread, spread * math.sqrt(10 / 7 / float((middle * middle) @ size))


@dataclass(frozen=True)
class Uniformity:
    """Kolmogorov-Smirnov test of whether the invariant measure is preserved.

    Examples
    --------
    >>> from carom import billiards
    >>> found = billiards.uniformity(billiards.circle(), orbits=1000, bounces=10)
    >>> sorted(found.p)
    ['angle', 'arc', 'radius']
    """

    bounces: int
    orbits: int
    distance: dict[str, float]
    """Greatest distances of the empirical distributions from the uniform one: of "arc", "radius", "angle"."""
    p: dict[str, float]
    """p-values: probability of a distance at least as great if the measure is preserved."""


def uniformity(
    table: Table, orbits: int = 10_000, bounces: int = 100, seed: int = 0, *, ball: Ball | None = None,
    law: Any = "no-slip", surface: Surface | None = None,
) -> Uniformity:  # fmt: skip
    """Test whether orbits drawn from the invariant measure still follow it after a number of bounces.

    Starts have the measure ``|v.n|`` ds dv d(spin) on one energy shell. Uniformly distributed are then: the arc length (in a sphere
    the height); the radius in the unit ball of all velocities except the one across, to the power of its dimension (2 in the
    plane, 5 in space); the angle in the velocity's phase disc. In a cylinder with lids, arc and angle are those of the bounces at
    its side.

    Parameters
    ----------
    table, ball, law, surface
        As for :func:`orbit`.
    orbits, bounces, seed : int
        Number of orbits, bounces of each, and seed of :func:`starts`.

    Returns
    -------
    Uniformity

    Raises
    ------
    CaromError
        A table that is open, or has a force.

    Examples
    --------
    >>> from carom import billiards
    >>> found = billiards.uniformity(billiards.stadium(), orbits=2000, bounces=20, seed=3)
    >>> found.orbits, min(found.p.values()) > 0.01
    (2000, True)
    """
    setup = orbit_setup(table, ball, law, surface, "pass")
    if any(table.acceleration):
        raise CaromError(Fault("uniformity", "table", "one without a force", f"{table}"))
    if any(math.isinf(f.length) for f in setup.shape.faces if not f.is_lid):
        raise CaromError(Fault("uniformity", "table", "a closed one", f"{table}"))
    found = orbit_from_setup(setup, starts(table, orbits, seed, ball=ball, law=law), bounces)
    good = np.asarray(found.count) == bounces
    # only the last bounce counts
    ends = {name: getattr(found, name)[:, -1:] for name in ("t", "position", "velocity", "spin", "piece")}
    found, shape = replace(found, **ends), setup.shape
    side = good & ~np.isin(found.piece[:, -1], [k for k, f in enumerate(shape.faces) if f.is_lid])
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
    distance = {name: _ks_distance(np.sort(value)) for name, value in values.items()}
    chance = {name: _ks_p_value(distance[name], len(value)) for name, value in values.items()}
    return Uniformity(bounces, int(good.sum()), distance, chance)


def _ks_distance(u: Array) -> float:
    """Return the Kolmogorov-Smirnov distance of a sorted sample from the uniform distribution on [0, 1]."""
    n = len(u)
    return float(max((np.arange(1, n + 1) / n - u).max(), (u - np.arange(n) / n).max()))


def _ks_p_value(d: float, n: int) -> float:
    """Return the p-value by Kolmogorov's limit distribution, with Stephens's correction for finite samples."""
    x = (math.sqrt(n) + 0.12 + 0.11 / math.sqrt(n)) * d
    if x < 0.2:
        return 1.0
    return min(1.0, max(0.0, 2 * sum((-1.0) ** (k - 1) * math.exp(-2 * k * k * x * x) for k in range(1, 101))))


# ----------------------------------------------------------------------------------------------------
# Weighted Birkhoff averages of orbits: rotation numbers to many digits, and whether an orbit is regular or chaotic.


LEAST = 50  # bounces
# Regular orbits that rotate slowly have few digits for long, chaotic ones near an island many for a while. So orbits are followed
# on for so many bounces, until they have more digits than any chaotic one or, after the first, fewer than any regular one; at last
# the limit lies between both.
LONG = (3000, 30_000)
REGULAR, CHAOTIC, LIMIT = 5.0, 2.0, 3.2
AT_ONCE = 3_000_000  # bounces that are in memory


@holds_arrays
class RotationNumber(NamedTuple):
    """Mean advance along the boundary per bounce, over its length; arrays for many orbits."""

    number: Array
    """From 0 to 1."""
    digits: Array
    """Decimal digits to which the averages over both halves of the orbit agree: at most 16."""


def rotation_number(found: Orbit) -> RotationNumber:
    """Compute rotation numbers of orbits in a bounded table in the plane by weighted Birkhoff averages.

    On an invariant curve the average converges faster than any power of the number of bounces: ten digits in 10,000 bounces.
    Source: Das, Saiki, Sander & Yorke, Nonlinearity 30, 4111 (2017), doi 10.1088/1361-6544/aa84c2; digits: Sander & Meiss,
    Physica D 411, 132569 (2020), doi 10.1016/j.physd.2020.132569.

    Parameters
    ----------
    found : Orbit
        Of 50 bounces or more.

    Returns
    -------
    RotationNumber
        NaN for orbits that ended early.

    Raises
    ------
    CaromError
        A table without a boundary of finite length, or too few bounces.

    Examples
    --------
    The chord of a circle at the angle 1 from the tangent advances by 2 of 2 pi.

    >>> import math
    >>> from carom import billiards
    >>> start = (1.0, 0.0), (-math.sin(1.0), math.cos(1.0)), 0.0
    >>> found = billiards.rotation_number(billiards.orbit(billiards.circle(), start, 1000, law="mirror"))
    >>> bool(abs(found.number - 1 / math.pi) < 1e-12)
    True
    """
    length = _boundary_length(found)
    if not math.isfinite(length):
        raise CaromError(
            Fault("rotation_number", "table", "a boundary of finite length, in the plane", found.setup.table.name)
        )
    _require_bounces("rotation_number", found)
    steps = np.diff(found.arc, axis=-1) / length
    number, digits = _averages(steps - np.floor(steps))
    return RotationNumber(number, digits)


def digits_of_averages(found: Orbit) -> Array:
    """Return the number of decimal digits to which averages over both halves of an orbit agree, for each orbit.

    The averaged numbers are place and direction at each bounce; the number is the least of all of them. On smooth curves (islands,
    periodic orbits) it grows with the bounces; for chaotic orbits it stays at one or two.

    Parameters
    ----------
    found : Orbit
        Of 50 bounces or more.

    Examples
    --------
    >>> from carom import billiards
    >>> start = billiards.starts(billiards.stadium(), 1, seed=1)
    >>> orbit = billiards.orbit(billiards.stadium(), start, 2000, law="mirror")
    >>> bool(billiards.digits_of_averages(orbit)[0] < 3)
    True
    """
    _require_bounces("digits_of_averages", found)
    length = _boundary_length(found)
    phase = found.phase
    watched = [phase[..., 0], phase[..., 1]]
    if math.isfinite(length):
        turn = math.tau * found.arc / length
        watched += [np.cos(turn), np.sin(turn)]
    return np.asarray(np.min([_averages(values)[1] for values in watched], axis=0))


def is_regular(found: Orbit) -> NDArray[np.bool_]:
    """Return for each orbit whether it is regular rather than chaotic, by the digits to which both halves' averages agree.

    Orbits of which so few bounces do not tell are followed on, for up to 30,000: slow rotations about an island take long to show.
    Those that ended early are not regular, nor are those whose energy changes. Compare `lyapunov`, which takes longer.
    """
    digits, bounces = np.array(digits_of_averages(found)).ravel(), found.t.shape[-1]
    ends = found.last.reshape(-1, found.last.shape[-1])[:, 1:]
    for longer in LONG:
        if bounces >= longer:
            continue
        unclear = np.flatnonzero((digits <= REGULAR) & ((digits >= CHAOTIC) | (bounces < LONG[0])))
        for some in block_slices(len(unclear), AT_ONCE // longer):
            which = unclear[some]
            start = state_of_rows(found.setup, ends[which], (len(which),))
            digits[which] = digits_of_averages(orbit_from_setup(found.setup, start, longer))
        bounces = longer
    keeps = np.abs(np.ravel(found.energy_drift)) < CONSERVED
    return np.asarray((digits > LIMIT) & keeps).reshape(found.count.shape)


def _averages(values: Array) -> tuple[Array, Array]:
    """Return the averages over whole orbits (..., N), and the digits to which those over both halves agree."""
    count = values.shape[-1]
    half = count // 2
    first, second = _average(values[..., :half]), _average(values[..., half : 2 * half])
    return _average(values), -np.log10(np.abs(first - second) + 1e-16)


def _average(values: Array) -> Array:
    """The average with the weights exp(-1/(t (1 - t))), which vanish at both ends with all derivatives."""
    t = np.arange(1, values.shape[-1] + 1) / (values.shape[-1] + 1)
    weight = np.exp(-1.0 / (t * (1.0 - t)))
    return np.asarray(values @ (weight / weight.sum()))


def _boundary_length(found: Orbit) -> float:
    shape = found.setup.shape
    return math.inf if shape.sphere is not None else float(shape.lengths.sum())


def _require_bounces(where: str, found: Orbit) -> None:
    if found.t.shape[-1] < LEAST:
        raise CaromError(Fault(where, "found", f"orbits of at least {LEAST} bounces", f"{found.t.shape[-1]}"))
