"""Follow orbits of one ball, one or many at once; run them backwards; coordinates on the boundary and in phase space."""

from __future__ import annotations

import functools
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from carom.billiards.loop import LANES, MEMORY, STATE, compiled_many, follow_one
from carom.billiards.setup import OrbitSetup, Start, orbit_setup, start_rows
from carom.billiards.table_records import DONE, ENDING, ENDS, POSITION, TIME
from carom.billiards.tables import Table
from carom.bodies import Ball, Numbers, Surface
from carom.core.jit.threads import Pace
from carom.errors import CaromError, Fault
from carom.files import require_memory
from carom.public.progress import Progress

Array = NDArray[np.float64]


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
    <Orbit: circle (radius 1.0; bounds the centre): no-slip, 3 bounces>
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
        spin = self.spin if self.setup.planar else np.linalg.norm(self.spin, axis=-1)
        ball = self.setup.ball
        found: Array = np.sqrt(self._rolls * (self.velocity**2).sum(-1) + ball.kappa * (ball.radius * spin) ** 2)
        return found

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
        first = np.broadcast_to(np.asarray(self.start.position, float), (*self.count.shape, d))[which]
        v0 = np.broadcast_to(np.asarray(self.start.velocity, float), (*self.count.shape, d))[which]
        x = np.concatenate([first[None], self.position[which][:k]])
        v = np.concatenate([v0[None], self.velocity[which][:k]])
        t = np.diff(np.concatenate([[0.0], self.t[which][:k]]))
        if points == 1:
            return x
        u = np.arange(points) / points * t[:, None]
        inner = moved_in_flight(self.setup.table, x[:-1, None], v[:-1, None], u)[0]
        return np.concatenate([inner.reshape(-1, d), x[-1:]])


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
    corners: str = "end",
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
    corners : "end" or "pass"
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
    >>> found = billiards.orbit(table, ((0.0, 0.0), (1.0, 0.5), 0.0), bounces=4, law="mirror", corners="pass")
    >>> found.t
    array([1., 1., 3., 3.])
    """
    return orbit_from_setup(orbit_setup(table, ball, law, surface, corners), start, bounces, progress)


def orbit_from_setup(setup: OrbitSetup, start: Any, bounces: int, progress: Progress | None = None) -> Orbit:
    """Compute :func:`orbit` for a table, a ball and a law that are validated already."""
    rows, shape = start_rows(setup, start)
    bounces = require_integer("bounces", bounces)
    d = setup.table.dimension
    width = 6 if setup.planar else 10
    advice = "use final(), which keeps none"
    require_memory("orbit", "bounces", len(rows) * bounces, 2 * (8 * width + 4), advice, 2 * MAX_KEPT_BYTES)
    kept = np.full((len(rows), bounces, width), np.nan)
    piece = np.full((len(rows), bounces), -1, np.int32)
    last, ends = _loop(setup, rows, bounces, kept, piece, progress)
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
    corners: str = "end",
    progress: Progress | None = None,
) -> tuple[Start, Array, Any, Any]:
    """Follow orbits as :func:`orbit` does, without keeping the bounces.

    Parameters
    ----------
    table, start, bounces, ball, law, surface, corners, progress
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
    setup = orbit_setup(table, ball, law, surface, corners)
    rows, shape = start_rows(setup, start)
    bounces = require_integer("bounces", bounces)
    width = 6 if setup.planar else 10
    nothing, none = np.empty((len(rows), 0, width)), np.empty((len(rows), 0), np.int32)
    last, ends = _loop(setup, rows, bounces, nothing, none, progress)
    return (
        state_of_rows(setup, last[:, 1:], shape),
        last[:, TIME].reshape(shape),
        ends["bounces"].reshape(shape),
        ends["reason"].reshape(shape),
    )


def require_integer(field: str, value: Any, least: int = 1) -> int:
    """Return an integer >= ``least``; CaromError for anything else."""
    if isinstance(value, int | np.integer) and not isinstance(value, bool) and least <= value < 2**60:
        return int(value)
    raise CaromError(Fault("orbit", field, f"an integer >= {least}", repr(value)))


def _loop(
    setup: OrbitSetup,
    rows: Array,
    bounces: int,
    kept: Any,
    piece: Any,
    progress: Progress | None,
) -> tuple[Array, NDArray[np.void]]:
    """Run the compiled loop, in parts if progress is reported."""
    # the loop expects positions in the first periodic cell
    shift = rows[:, :3] - setup.shape.folded(rows[:, :3])
    rows = rows - np.concatenate([shift, np.zeros((len(rows), 6))], axis=1)
    last, ends, memory = np.empty((len(rows), 10)), np.zeros(len(rows), ENDING), np.zeros((len(rows), MEMORY))
    pace, advance = Pace(FIRST_BOUNCES), compiled_many() if len(rows) > 1 else follow_one
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
    return last, ends


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
