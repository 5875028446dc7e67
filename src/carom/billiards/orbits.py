"""Follow orbits of one ball, one or many at once; run them backwards; coordinates on the boundary and in phase space."""

from __future__ import annotations

import functools
import math
from dataclasses import dataclass, replace
from itertools import combinations, pairwise
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from carom.billiards.boundary import Boundary, Face
from carom.billiards.intersections import DONE, ENDING, ENDS, GRAZED, PARABOLA, POSITION, TIME
from carom.billiards.loop import LANES, MEMORY, STATE, compiled_many, iterate_one
from carom.billiards.setup import OrbitSetup, Start, needs_surface, orbit_setup, start_rows
from carom.billiards.tables import Table
from carom.bodies import Ball, Numbers, Surface
from carom.core.jit.threads import Pace
from carom.core.random import added
from carom.errors import CaromError, Fault, require_count
from carom.files import require_memory
from carom.formatting import counted, format_number
from carom.public.other_rooms import saved_figure
from carom.public.progress import Progress

if TYPE_CHECKING:
    from matplotlib.figure import Figure

Array = NDArray[np.float64]
CONSERVED = 1e-6  # a smaller relative change of the energy is rounding
INTO_THE_WALL = 1e-9  # of the table's size, by which a ball comes nearer to the wall on a millionth of that size


@dataclass(frozen=True, eq=False)
class Orbit:
    """One orbit or many: arrays (..., B) of the bounces, each with the state just after it.

    Where an orbit ended before B bounces (``count`` and ``ended`` say when and why) the rest is NaN. In a periodic cell positions
    continue through the cells; ``folded`` has them translated into the first.

    Examples
    --------
    >>> from carom import billiards
    >>> found = billiards.orbit(billiards.circle(), ((0.0, 0.0), (1.0, 0.0), 0.0), bounces=3)
    >>> found
    <Orbit: circle (radius 1.0; boundary of the ball's centre): no-slip, 3 bounces>
    >>> found.t, found.position[:, 0]
    (array([1., 3., 5.]), array([ 1., -1.,  1.]))
    """

    setup: OrbitSetup
    start: Start
    t: Array
    """(..., B): time of each bounce, s."""
    position: Array
    """(..., B, d): the centre, m."""
    velocity: Array
    """(..., B, d): m/s."""
    spin: Array
    """(..., B) in the plane, (..., B, 3) in space: rad/s."""
    piece: NDArray[np.int32]
    """(..., B): index of the piece of the boundary that was met; -1 for none."""
    count: NDArray[np.integer]
    """(...): number of bounces."""
    ending: NDArray[np.integer]
    """(...): why it ended, as an index into :data:`carom.billiards.ENDS`."""
    last: Array
    """(..., 10): time, position, velocity and spin at the end, each with three components."""

    def __repr__(self) -> str:
        """Return one line: the table, the law, the number of bounces."""
        many = f"{np.size(self.count):,} orbits, " if np.ndim(self.count) else ""
        return f"<Orbit: {self.setup.table}: {self.setup.law}, {many}{int(np.sum(self.count)):,} bounces>"

    @property
    def ended(self) -> str | NDArray[np.str_]:
        """(...): why it ended, as text; see :data:`carom.billiards.ENDS`."""
        found: str | NDArray[np.str_] = np.array(ENDS)[self.ending]
        return found

    @functools.cached_property
    def folded(self) -> Array:
        """(..., B, d): positions within the periodic cell."""
        return self.setup.shape.folded(self.position)

    @functools.cached_property
    def normal(self) -> Array:
        """(..., B, d): the wall's normal, towards the ball."""
        d = self.setup.table.dimension
        return self.setup.shape.normals(self.piece, self.position)[..., :d]

    @functools.cached_property
    def arc(self) -> Array:
        """(..., B): arc length s along the boundary of the centre's region, which lies on its left, m."""
        return self.setup.shape.coordinate(self.piece, self.position)

    @functools.cached_property
    def across(self) -> Array:
        """(..., B): velocity away from the wall, m/s."""
        found: Array = np.einsum("...i,...i", self.velocity, self.normal)
        return found

    @functools.cached_property
    def along(self) -> Array:
        """(..., B): velocity along the wall in the direction of growing s, m/s; in a sphere, along its circles of latitude."""
        n, v = self.normal, self.velocity
        found: Array = n[..., 1] * v[..., 0] - n[..., 0] * v[..., 1]
        if self.setup.shape.sphere is not None:
            found = found / np.hypot(n[..., 0], n[..., 1])
        return found

    @functools.cached_property
    def angle(self) -> Array:
        """(..., B): from the normal to the velocity, rad; positive where s grows (of a cylinder: of its cross-section)."""
        return np.arctan2(self.along, self.across)

    @functools.cached_property
    def speed(self) -> Array:
        """(..., B): sqrt(2 energy / m), the kinetic energy including the spin's."""
        ball = self.setup.ball
        with np.errstate(over="ignore"):  # (a law that creates energy soon has no number for it)
            spin = self.spin if self.setup.planar else np.linalg.norm(self.spin, axis=-1)
            found: Array = np.sqrt(self._rolls * (self.velocity**2).sum(-1) + ball.kappa * (ball.radius * spin) ** 2)
        return found

    @property
    def energy_drift(self) -> Array:
        """(...): change of the energy from the first bounce to the last, as a share of the largest kinetic energy."""
        last = np.take_along_axis(self._energy, np.maximum(self.count, 1)[..., None] - 1, -1)[..., 0]
        most = np.fmax.reduce(self.speed**2, axis=-1, initial=np.finfo(float).tiny)
        with np.errstate(invalid="ignore"):
            return np.asarray((last - self._energy[..., 0]) / most)

    @property
    def notes(self) -> list[str]:
        """A line where the law created energy, and one where a custom law left a ball moving into the wall."""
        setup, axis, counts = self.setup, np.ndim(self.count), np.ravel(self.count)
        if setup.conservative:
            return []
        notes, where = [], "bounce {1:,}" + " of orbit {0:,}" * (len(counts) > 1)
        begin: dict[str, Any] = {name: np.expand_dims(one, axis) for name, one in vars(self.start).items()}
        x, v, size = self.last.reshape(-1, 10)[:, POSITION], self.last.reshape(-1, 10)[:, 4:7], setup.shape.size
        with np.errstate(invalid="ignore"):
            gained = np.diff(self._energy, prepend=replace(self, **begin)._energy).reshape(len(counts), -1)
            created = gained > CONSERVED * self.speed.reshape(gained.shape) ** 2
            ahead = x + CONSERVED * size * v / np.abs(v).max(axis=-1, keepdims=True)
        if created.any():
            first, in_all = np.argwhere(created)[0], counted(int(created.sum()), "bounce")
            what = f"{where.format(*first + 1)}, {format_number(setup.ball.mass * gained[tuple(first)] / 2)} J"
            notes.append(f"law {setup.law} creates energy: first at {what}; {in_all} in all")
        nearer = setup.shape.gap(x) - setup.shape.gap(ahead) > INTO_THE_WALL * size
        for one in np.flatnonzero(nearer & (np.ravel(self.ending) == GRAZED))[:1]:
            what = f"leaves the ball moving into the wall: first at {where.format(one + 1, counts[one] + 1)}"
            got = ", ".join(map(format_number, v[one, : setup.table.dimension]))
            notes.append(f"law {setup.law} {what}, with the velocity ({got}) m/s; expected n . v > 0 after it")
        return notes

    @property
    def _energy(self) -> Array:
        """(..., B): twice the energy per mass, with that of the force."""
        table = self.setup.table
        return self.speed**2 - 2 * self.position @ np.array(table.acceleration[: table.dimension])  # type: ignore[no-any-return]

    @property
    def _rolls(self) -> Numbers:
        """Factor of velocity^2 in twice the energy per mass: a rolling ball's horizontal spin is tied to its velocity."""
        return 1.0 + self.setup.ball.kappa if self.setup.rolls else 1.0

    @functools.cached_property
    def phase(self) -> Array:
        """(..., B, 2): spin and velocity along the wall, normalised by the energy: sqrt(kappa) a omega_z and v_t over ``speed``.

        The velocity phase portrait (after Cox & Feres): points of the unit disc, in which the invariant measure is uniform.
        """
        ball = self.setup.ball
        spin = self.spin if self.setup.planar else self.spin[..., 2]
        parts = [np.sqrt(ball.kappa) * ball.radius * spin, np.sqrt(self._rolls) * self.along]
        return np.stack(parts, axis=-1) / self.speed[..., None]

    def path(self, which: Any = (), points: int = 1) -> Array:
        """Return the path of one orbit, (M, d): from the start through its bounces, with ``points`` points per flight."""
        d = self.setup.table.dimension
        k = int(self.count[which])
        x = np.concatenate([np.asarray(self.start.position)[which][None], self.position[which][:k]])
        v = np.concatenate([np.asarray(self.start.velocity)[which][None], self.velocity[which][:k]])
        t = np.diff(np.concatenate([[0.0], self.t[which][:k]]))
        if points == 1:
            return x
        u = np.arange(points) / points * t[:, None]
        inner = moved_in_flight(self.setup.table, x[:-1, None], v[:-1, None], u)[0]
        return np.concatenate([inner.reshape(-1, d), x[-1:]])

    def plot(self, file: str | Path | None = None, **options: Any) -> Figure:
        """Return a Matplotlib figure: one orbit in its table (:func:`carom.plot.plot_orbit`). ``file``: write it there."""
        return saved_figure("plot_orbit", file, self, **options)  # type: ignore[no-any-return]

    def portrait(self, file: str | Path | None = None) -> Figure:
        """Return the velocity phase portrait of all orbits (:func:`carom.plot.plot_portrait`). ``file``: write it there."""
        return saved_figure("plot_portrait", file, self)  # type: ignore[no-any-return]

    def boundary(self, file: str | Path | None = None) -> Figure:
        """Return the boundary map of all orbits (:func:`carom.plot.plot_boundary`). ``file``: write it there."""
        return saved_figure("plot_boundary", file, self)  # type: ignore[no-any-return]


def moved_in_flight(table: Table, x: Array, v: Array, t: Array) -> tuple[Array, Array]:
    """Return positions and velocities (..., d) after flights of durations (...), given both at their beginning (..., d)."""
    if table.magnetic_field:
        angle = table.magnetic_field * t[..., None]
        turned = np.stack([-v[..., 1], v[..., 0]], axis=-1)
        sin, versed = np.sin(angle), 2 * np.sin(angle / 2) ** 2
        return x + (sin * v + versed * turned) / table.magnetic_field, v + sin * turned - versed * v
    g = np.array(table.acceleration[: v.shape[-1]])
    return x + v * t[..., None] + g * (t * t / 2)[..., None], v + g * t[..., None]


MAX_KEPT_BYTES = 4e9
BOUNCES_PER_REPORT = 10_000_000
FIRST_BOUNCES = 1 << 18  # of all orbits, in the first call of the compiled loop


def orbit(
    table: Table,
    start: Any,
    bounces: int = 1000,
    *,
    ball: Ball | None = None,
    law: Any = "no-slip",
    surface: Surface | None = None,
    at_corner: str = "end",
    progress: Progress | None = None,
) -> Orbit:
    """Follow one ball, or many at once on all cores, for a number of bounces; results do not depend on the number of threads.

    Parameters
    ----------
    table : Table
        From :func:`carom.billiards.circle` and the other functions that make tables.
    start : Start, or (position, velocity, spin)
        Shapes (..., d), (..., d) and (...) (in space (..., 3)), broadcast; every orbit is independent.
    bounces : int
        Number of bounces.
    ball : Ball, optional
        In the plane a :func:`carom.Disc`, or a Ball with its axis upright. Default: kappa 1/2 (in space 2/5), mass 1, radius 1,
        or 1/10 where the table bounds the surface.
    law : str or kernel
        "no-slip" (Broomhead & Gutkin, Physica D 67, 1993, 188), "mirror", "contact" (uses ``surface``), "rolling" (the nonholonomic
        reflection of a ball that rolls on the table's floor, equation (22)), "my_law.py:law", or a kernel
        (v, w, n, a, kappa, e, mu, beta) -> (v, w).
    surface : Surface, optional
        Restitution, friction and tangential restitution of law "contact"; restitution of "mirror".
    at_corner : "end" or "pass"
        At a corner (within 1e-12 of the table's size) the map is undefined and the orbit ends. "pass": the ball meets the two
        sides one after the other, the one with the lower index first.
    progress : callable(done, total, text), optional
        Called with the number of bounces done, and of all.

    Returns
    -------
    Orbit
        The bounces, each with the state just after it.

    Raises
    ------
    CaromError
        One line per problem: a start outside the table or at rest, a law that does not fit the table or the ball, more bounces
        than fit in 4 GB.

    Examples
    --------
    >>> from carom import billiards
    >>> table = billiards.rectangle(2.0, 1.0)
    >>> found = billiards.orbit(table, ((0.0, 0.0), (1.0, 0.5), 0.0), bounces=4, law="mirror", at_corner="pass")
    >>> found.t
    array([1., 1., 3., 3.])
    """
    return orbit_from_setup(orbit_setup(table, ball, law, surface, at_corner), start, bounces, progress)


def orbit_from_setup(setup: OrbitSetup, start: Any, bounces: int, progress: Progress | None = None) -> Orbit:
    """Compute :func:`orbit` for a table, a ball and a law that are validated already."""
    rows, shape = start_rows(setup, start)
    bounces = require_count("orbit", "bounces", bounces)
    d = setup.table.dimension
    width = 6 if setup.planar else 10
    advice = "take fewer; in Python carom.billiards.final keeps none of them"
    require_memory("orbit", "bounces", len(rows) * bounces, 8 * width + 4, advice, MAX_KEPT_BYTES)
    kept, piece, last, ends = _loop(setup, rows, bounces, bounces, progress)
    kept = kept.reshape(*shape, bounces, width)
    return Orbit(
        setup=setup,
        start=state_of_rows(setup, rows, shape),
        t=kept[..., 0],
        position=kept[..., 1 : 1 + d],
        velocity=kept[..., 1 + d : 1 + 2 * d],
        spin=kept[..., 5] if setup.planar else kept[..., 7:],
        piece=piece.reshape(*shape, bounces),
        count=ends["bounces"].reshape(shape),
        ending=ends["reason"].reshape(shape),
        last=last.reshape(*shape, 10),
    )


def state_of_rows(setup: OrbitSetup, rows: Array, shape: tuple[int, ...]) -> Start:
    """Return rows (N, 9) of position, velocity and spin as a Start."""
    d = setup.table.dimension
    rows = rows.reshape(*shape, 9)
    return Start(rows[..., :d], rows[..., 3 : 3 + d], rows[..., 8] if setup.planar else rows[..., 6:])


def final(
    table: Table,
    start: Any,
    bounces: int,
    *,
    ball: Ball | None = None,
    law: Any = "no-slip",
    surface: Surface | None = None,
    at_corner: str = "end",
    progress: Progress | None = None,
) -> tuple[Start, Array, Any, Any]:
    """Follow orbits as :func:`orbit` does, without keeping the bounces.

    Parameters
    ----------
    table, start, bounces, ball, law, surface, at_corner, progress
        As for :func:`orbit`, which raises the same errors.

    Returns
    -------
    tuple
        The states at the end (a Start), their times (...) in s, the numbers of bounces (...), and why each orbit ended (...), an
        index into :data:`carom.billiards.ENDS`.

    Examples
    --------
    >>> from carom import billiards
    >>> state, t, count, ending = billiards.final(billiards.circle(), ((0.0, 0.0), (1.0, 0.0), 0.0), 1000)
    >>> float(t), int(count), billiards.ENDS[int(ending)]
    (1999.0, 1000, 'bounces')
    """
    setup = orbit_setup(table, ball, law, surface, at_corner)
    rows, shape = start_rows(setup, start)
    bounces = require_count("orbit", "bounces", bounces)
    _kept, _piece, last, ends = _loop(setup, rows, bounces, 0, progress)
    return (
        state_of_rows(setup, last[:, 1:], shape),
        last[:, TIME].reshape(shape),
        ends["bounces"].reshape(shape),
        ends["reason"].reshape(shape),
    )


def _loop(
    setup: OrbitSetup,
    rows: Array,
    bounces: int,
    keep: int,
    progress: Progress | None,
) -> tuple[Array, NDArray[np.int32], Array, NDArray[np.void]]:
    """Run the compiled loop, in parts if progress is reported; ``keep``: of how many bounces the states are kept."""
    kept = np.full((len(rows), keep, 6 if setup.planar else 10), np.nan)
    piece = np.full((len(rows), keep), -1, np.int32)
    # the loop expects positions in the first periodic cell
    shift = rows[:, :3] - setup.shape.folded(rows[:, :3])
    rows = rows - np.concatenate([shift, np.zeros((len(rows), 6))], axis=1)
    last, ends, memory = np.empty((len(rows), 10)), np.zeros(len(rows), ENDING), np.zeros((len(rows), MEMORY))
    pace, advance = Pace(FIRST_BOUNCES), compiled_many() if len(rows) > 1 else iterate_one
    share = max(1, len(rows) if progress is None else min(len(rows), BOUNCES_PER_REPORT // bounces))
    for k in range(0, len(rows), share):
        here = slice(k, k + share)
        while ((ends[here]["reason"] == DONE) & (ends[here]["bounces"] < bounces)).any():
            more = pace.begin()
            advance(
                setup.world, setup.pieces, setup.panels, rows[here], bounces, max(more // len(rows[here]), 1), kept[here],
                piece[here], last[here], ends[here], memory[here], np.empty((-(-len(rows[here]) // LANES), STATE)),
            )  # fmt: skip
            pace.done(more)
        if progress is not None:
            progress(min(k + share, len(rows)) * bounces, len(rows) * bounces, "orbits")
    if shift.any():
        d = setup.table.dimension
        kept[..., 1 : 1 + d] += shift[:, None, :d]
        last[:, POSITION] += shift
    return kept, piece, last, ends


def require_reversible(setup: OrbitSetup) -> None:
    """Raise CaromError where the law loses energy, so that orbits cannot be run backwards."""
    if not setup.conservative:
        raise CaromError(Fault("reverse", "law", "a reversible one (no-slip, mirror, rolling)", f"{setup.law}"))


def reverse(found: Orbit) -> tuple[Orbit, Array]:
    """Run orbits backwards from their last bounce.

    The no-slip, mirror and rolling reflections are their own inverses, so an orbit returns through all its bounces, until chaos
    has amplified the rounding errors. A magnetic field is reversed as well.

    Parameters
    ----------
    found : Orbit
        Orbits that made all their bounces.

    Returns
    -------
    tuple
        The reversed Orbit, and the distance (..., B) of each of its bounces from the original one, m.

    Raises
    ------
    CaromError
        The law loses energy, or an orbit ended early.

    Examples
    --------
    >>> from carom import billiards
    >>> found = billiards.orbit(billiards.circle(), ((0.2, 0.1), (0.8, 0.3), 0.5), bounces=50)
    >>> back, error = billiards.reverse(found)
    >>> bool(error.max() < 1e-11)
    True
    """
    setup = found.setup
    require_reversible(setup)
    if (np.asarray(found.ending) != DONE).any():
        raise CaromError(Fault("reverse", "orbit", "one that made all its bounces", "one that ended early"))
    spin = found.spin[..., -1] if setup.planar else found.spin[..., -1, :]
    setup = setup.reversed_in_time()
    back = orbit_from_setup(
        setup, Start(found.position[..., -1, :], -found.velocity[..., -1, :], -spin), found.t.shape[-1]
    )
    error = np.linalg.norm(back.position - np.flip(found.position, axis=found.t.ndim - 1), axis=-1)
    return back, error


# ----------------------------------------------------------------------------------------------------
# Draw initial states of orbits from the invariant measure of a billiard.


BYTES_PER_START = 400  # of memory, while a start is drawn and followed
COVERED = 1e-9  # radii within the image of an obstacle: rounding
OUTLINE_POINTS = 20_000  # of an outline whose length and area are found
LATTICE_POINTS = 1000  # along each side of a cell whose free area is found
ENERGY_SCAN_POINTS = 20_000  # points of a wall at which the greatest kinetic energy is sought


def starts(
    table: Table,
    count: int,
    seed: int = 0,
    *,
    ball: Ball | None = None,
    law: Any = "no-slip",
    speed: float = 1.0,
    spins: bool = True,
) -> Start:
    """Draw states just after a bounce from the invariant measure ``|v.n|`` ds d(velocities and spins of one energy).

    Positions are uniform along the wall. The velocities along the wall and the spins, each times the square root of its inertia,
    are uniform in the unit ball, so that the velocity across the wall has the density ``|v.n|``. Under a force across walls,
    positions are weighted by the kinetic energy left there: in the plane by its first power, in space by its power 5/2.

    Along an axis in which the table is invariant, starts lie in one place: of a cylinder at z = 0, of a strip at x = 0, of
    plates at x = z = 0; in a periodic cell they lie in the first. A wedge has such a measure only under a force that brings back
    every ball: its walls then count as far as a ball of that energy gets.

    Parameters
    ----------
    table : Table
        The table.
    count : int
        Number of starts.
    seed : int
        Seed of the random numbers.
    ball, law
        As for :func:`orbit`.
    speed : float
        sqrt(2 energy / m), m/s; under a force across walls, the speed of a ball at the origin.
    spins : bool
        Whether velocities and spins share the energy. Without, no ball spins and all have one speed, in the directions of the same
        measure: the point particle of textbooks, for laws that leave the spin alone.

    Returns
    -------
    Start
        Arrays (count, ...).

    Raises
    ------
    CaromError
        A wedge without such a force, an energy with which no ball reaches a wall, too many starts.

    Examples
    --------
    >>> from carom import billiards
    >>> start = billiards.starts(billiards.stadium(), 1000, seed=1)
    >>> start.position.shape, start.spin.shape
    ((1000, 2), (1000,))
    """
    setup = orbit_setup(table, ball, law, Surface() if needs_surface(law) else None, "end")
    count, seed = require_count("orbit", "count", count), require_count("orbit", "seed", seed, 0)
    require_memory("starts", "count", count, BYTES_PER_START, "draw them in parts", MAX_KEPT_BYTES)
    rng = np.random.default_rng(seed)
    radius, kappa = float(setup.ball.radius), float(setup.ball.kappa)
    planar = setup.planar
    # dimension of the unit ball of all components except the one across: 2 in the plane, 5 in space
    free = 2 if planar else 5
    if setup.world["flight"][0] == PARABOLA:
        x, n, pace = _weighted_by_energy(table, setup.shape, count, rng, speed, 1.0 if planar else 2.5)
    else:
        x, n = _on_the_wall(_cut_at_energy(table, setup.shape, speed), count, rng)
        pace = np.full((count, 1), float(speed))
    u = rng.normal(size=(count, free))
    u *= (rng.uniform(size=count) ** (1 / free) / np.linalg.norm(u, axis=1))[:, None]
    across = np.sqrt(1 - (u * u).sum(1))
    if not spins:
        moves = 1 if planar else 2  # components of the velocity along the wall; the others are spins
        u[:, moves:] = 0.0
        share = np.sqrt(across**2 + (u * u).sum(1))
        across, u = across / share, u / share[:, None]
    t = np.cross(n, np.where(np.abs(n[:, 2:]) < 0.9, [0.0, 0.0, 1.0], [1.0, 0.0, 0.0]))
    t /= np.linalg.norm(t, axis=1, keepdims=True)
    rolls = math.sqrt(1 + kappa) if setup.rolls else 1.0
    v = pace * (across[:, None] * n + u[:, :1] * t) / rolls
    inertia = math.sqrt(kappa) * radius
    if planar:
        return Start(x[:, :2], v[:, :2], pace[:, 0] * u[:, 1] / inertia)
    v += pace * u[:, 1:2] * np.cross(n, t)
    return Start(x, v, pace * u[:, 2:] / inertia)


def _weighted_by_energy(
    table: Table, shape: Boundary, count: int, rng: np.random.Generator, speed: float, power: float
) -> tuple[Array, Array, Array]:
    """Draw points (count, 3) of the wall weighted by a power of the kinetic energy there.

    Return them with the normals (count, 3) and sqrt(2 kinetic energy / m) (count, 1).
    """
    acceleration, shape = np.array(table.acceleration), _cut_at_energy(table, shape, speed)
    x, n = np.empty((0, 3)), np.empty((0, 3))
    # upper bound of the energy: the greatest of many points, and a margin for those between them
    some = _on_the_wall(shape, ENERGY_SCAN_POINTS, np.random.default_rng(0))[0] @ acceleration
    most = speed**2 + 2 * (some.max() + 0.02 * np.ptp(some))
    if not most > 0 or not np.isfinite(speed):
        raise CaromError(Fault("starts", "speed", "one at the origin with which a ball reaches a wall", repr(speed)))
    while len(x) < count:
        y, m = _on_the_wall(shape, 2 * count + 100, rng)
        left = np.maximum(speed**2 + 2 * y @ acceleration, 0)
        on = rng.uniform(size=len(y)) < (left / most) ** power
        x, n = np.concatenate([x, y[on]]), np.concatenate([n, m[on]])
    x, n = x[:count], n[:count]
    return x, n, np.sqrt(speed**2 + 2 * x @ acceleration)[:, None]


def _cut_at_energy(table: Table, shape: Boundary, speed: float) -> Boundary:
    """Return the boundary with half-infinite walls cut off where a ball of that energy gets no further."""
    faces: list[Face] = []
    for (nx, ny, nz), c, r, begin, end, low, high in shape.faces:
        cut = begin, end
        if not nz and math.isinf(begin) != math.isinf(end):
            # speed^2 + 2 g.x is twice the energy per mass that is left: at the corner, and its rate along the wall
            t, corner = np.array([ny, -nx]), begin if math.isfinite(begin) else end
            left = speed**2 + 2 * np.dot(table.acceleration[:2], np.multiply((nx, ny), c) + corner * t)
            rate = 2 * float(np.dot(table.acceleration[:2], t)) * (1 if corner == begin else -1)
            if not rate < 0:
                raise CaromError(
                    Fault(
                        "starts",
                        "table",
                        "a force that brings back every ball",
                        f"a {table.name}, whose walls are infinite",
                        "give an acceleration towards the vertex (of a wedge such as -9.81,0), or `position` and `velocity`",
                    )
                )
            reach = max(left, 0.0) / -rate
            cut = (begin, begin + reach) if corner == begin else (end - reach, end)
        faces.append(Face((nx, ny, nz), c, r, *cut, low, high))
    return replace(shape, faces=faces)


def _on_infinite_walls(
    sides: list[Face], lids: list[Face], count: int, rng: np.random.Generator
) -> tuple[Array, Array]:
    """Draw points (count, 3) at x = 0 of infinite walls and of the lids between them; return them with the normals."""
    x, n = np.zeros((count, 3)), np.zeros((count, 3))
    which = rng.integers(len(sides), size=count)
    n[:, :2] = np.array([normal[:2] for normal, *_ in sides])[which]
    x[:, :2] = n[:, :2] * np.array([c for _n, c, *_ in sides])[which, None]
    if lids:
        high, width = -float(lids[0].offset), -float(added(c for _n, c, *_ in sides))
        x[:, 2] = rng.uniform(-high, high, count)
        on = rng.uniform(size=count) < width / (width + 2 * high)
        up = np.where(rng.uniform(size=count) < 0.5, 1.0, -1.0)
        x[on, 1], x[on, 2] = rng.uniform(-width / 2, width / 2, on.sum()), high * up[on]
        n[on] = np.stack([np.zeros(on.sum()), np.zeros(on.sum()), -up[on]], axis=1)
    return x, n


def _on_the_wall(shape: Boundary, count: int, rng: np.random.Generator) -> tuple[Array, Array]:
    """Draw points (count, 3) uniformly on the wall; return them with the normals."""
    if shape.sphere is not None:
        out = rng.normal(size=(count, 3))
        out /= np.linalg.norm(out, axis=1, keepdims=True)
        return shape.sphere * out, -out
    lids = [f for f in shape.faces if f.is_lid]
    # (without lids the pieces have other numbers; starts are drawn in the order of these)
    side = replace(shape, faces=[f for f in shape.faces if not f.is_lid], order=None if lids else shape.order)
    if side.faces and not np.isfinite(side.lengths).any():
        return _on_infinite_walls(side.faces, lids, count, rng)
    around = float(side.lengths.sum())
    if not around > 0:
        raise CaromError(Fault("starts", "speed", "one at the origin with which a ball reaches a wall", "less"))
    x2, n2 = _exposed(side, around, count, rng)
    x, n = (np.concatenate([p, np.zeros((count, 1))], axis=1) for p in (x2, n2))
    if lids:
        high = -float(lids[0].offset)
        x[:, 2] = rng.uniform(-high, high, count)
        # the share on the lids is the share of their area
        area, length, low, size = _cross_section(side, around)
        on = np.flatnonzero(rng.uniform(size=count) < area / (area + length * high))
        left = on
        while len(left):
            x[left, :2] = low + rng.uniform(size=(len(left), 2)) * size
            left = left[side.gap(x[left, :2]) < 0]
        up = np.where(rng.uniform(size=len(on)) < 0.5, 1.0, -1.0)
        x[on, 2], n[on] = high * up, np.stack([np.zeros(len(on)), np.zeros(len(on)), -up], axis=1)
    return x, n


def _exposed(side: Boundary, around: float, count: int, rng: np.random.Generator) -> tuple[Array, Array]:
    """Draw points (count, 2) uniformly on a wall's outline; return them with the normals.

    Points of an obstacle that its periodic images cover are drawn again.
    """
    _k, x, n = side.place(rng.uniform(0, around, count))
    left = np.flatnonzero(_covered(side, x))
    while len(left):
        _k, x[left], n[left] = side.place(rng.uniform(0, around, len(left)))
        left = left[_covered(side, x[left])]
    return x, n


def _covered(side: Boundary, x: Array) -> NDArray[np.bool_]:
    """Return whether points (N, 2) of an outline lie within the image of an obstacle in a neighbouring cell."""
    if not side.images:
        return np.zeros(len(x), bool)
    covered: NDArray[np.bool_] = side.gap(x) < -COVERED * max(one[2] for one in side.images)
    return covered


def free_area(side: Boundary) -> tuple[float, float]:
    """Return the area within a boundary in the plane and the length of the boundary that a ball can touch, m^2 and m."""
    around = float(side.lengths.sum())
    if side.cell is None:
        # the integral of -x.n/2 along the boundary, n the normal inwards
        nodes, weights = np.polynomial.legendre.leggauss(16)
        ends = np.unique(np.concatenate([side.starts, side.starts + side.lengths]))
        cuts = np.concatenate([np.linspace(a, b, 65)[:-1] for a, b in pairwise(ends)] + [ends[-1:]])
        half = np.diff(cuts)[:, None] / 2
        _k, x, n = side.place((cuts[:-1, None] + half + half * nodes).ravel())
        return float(-((x * n).sum(-1).reshape(-1, 16) * half * weights).sum() / 2), around
    circles = [(x, y, r) for x, y, r, *_ in [*side.outside, *side.images]]
    apart = all(math.hypot(a - c, b - d) >= r + s for (a, b, r), (c, d, s) in combinations(circles, 2))
    if not apart or any(abs(y) + r > -one.offset for _x, y, r in circles for one in side.faces):
        area, around, *_ = _cross_section(side, around)
        return area, around
    w, h = side.cell
    whole = w * (-sum(one.offset for one in side.faces) if side.faces else h)
    return whole - math.pi * math.fsum(r * r for _x, _y, r, *_ in side.outside), around


def _cross_section(side: Boundary, around: float) -> tuple[float, float, Array, Array]:
    """Return the area within an outline, its length, and the corner and the sides of a rectangle around it."""
    curve = side.place(np.linspace(0, around, OUTLINE_POINTS + 1)[:-1])[1]
    if side.cell is None:
        a, b = curve, np.roll(curve, -1, axis=0)
        return float((a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0]).sum() / 2), around, curve.min(0), np.ptp(curve, axis=0)
    # of a periodic cell what obstacles leave free, on a lattice
    size = np.array(side.cell)
    places = (np.arange(LATTICE_POINTS) + 0.5) / LATTICE_POINTS - 0.5
    lattice = np.stack(np.meshgrid(places * size[0], places * size[1]), axis=-1)
    area = float((side.gap(lattice) > 0).mean() * size.prod())
    return area, around * float(1 - _covered(side, curve).mean()), -size / 2, size
