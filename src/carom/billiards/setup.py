"""Validate a table, a ball, a law and starts, and convert them to the records that the loops read."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from carom.billiards.boundary import Boundary
from carom.billiards.intersections import ARC, PARABOLA, STRAIGHT
from carom.billiards.tables import Table
from carom.bodies import Ball, Disc, Surface
from carom.core.geometry.curve import ROW
from carom.errors import (
    MAX_MAGNITUDE,
    MIN_MAGNITUDE,
    CaromError,
    Fault,
    FaultList,
    broadcast_shape,
    did_you_mean,
    float_array,
    shown,
)
from carom.laws.callbacks import user_address
from carom.laws.law import (
    CALLED_WALL,
    CONTACT_WALL,
    MIRROR_WALL,
    NO_SLIP_WALL,
    ON_WALL,
    ROLLING_WALL,
    TWO_STEP_WALL,
    Card,
    Law,
    wall_law,
)
from carom.laws.registry import find_law, laws
from carom.public.defaults import LIKE_SOLIDS

Array = NDArray[np.float64]
LAWS = tuple(law.name for law in laws().values() if law.kernel is not None)
"""Names of the laws that a billiard takes."""


@dataclass(frozen=True, eq=False)
class Start:
    """Initial states of orbits: the start lies in the table or on its wall, moving away from it.

    Attributes
    ----------
    position : array (..., d)
        The centre, m; d is 2 in the plane, 3 in space.
    velocity : array (..., d)
        m/s.
    spin : array (...) in the plane, (..., 3) in space
        Angular velocity, rad/s. Default: 0.

    The arrays broadcast against each other.

    Examples
    --------
    >>> from carom import billiards
    >>> start = billiards.Start(position=(0.2, 0.1), velocity=(0.8, 0.3), spin=0.5)
    >>> billiards.orbit(billiards.circle(), start, bounces=2).count
    array(2)
    """

    position: ArrayLike
    velocity: ArrayLike
    spin: ArrayLike = 0.0


@dataclass(frozen=True, eq=False)
class OrbitSetup:
    """A table, a ball and a law, with the records that the loops read."""

    table: Table
    ball: Ball
    law: str
    response: int
    """How the loop carries the law out (:mod:`carom.laws.law`)."""
    shape: Boundary
    world: Any
    pieces: NDArray[np.void]
    panels: Array
    """Table of the panels of a smooth curve (:mod:`carom.core.geometry.curve`)."""
    conservative: bool
    """Whether the law is known to conserve the energy."""
    kernel: Any = None
    """Of a law that is called."""

    @property
    def rolls(self) -> bool:
        """Whether the ball rolls on the table's floor."""
        return self.response == ROLLING_WALL

    @property
    def keeps_spin(self) -> bool:
        """Whether the law leaves the spin alone: a smooth wall."""
        world = self.world[0]
        return bool(world["law"] == CONTACT_WALL and (world["mu"] == 0 or world["beta"] == -1))

    @property
    def planar(self) -> bool:
        """Whether the table lies in the plane."""
        return self.table.dimension == 2

    @property
    def has_corners(self) -> bool:
        """Whether the boundary has corners, at which the map of bounces is not defined, and beside which it is not continuous."""
        sides = self.pieces[: self.world[0]["faces"]]
        return bool(self.world[0]["arc_corners"] or np.isfinite(sides["low"]).any() or np.isfinite(sides["high"]).any())

    def reversed_in_time(self) -> OrbitSetup:
        """Return the setup in which an orbit runs backwards: with the opposite magnetic field."""
        if not self.table.magnetic_field:
            return self
        world = self.world.copy()
        world["magnetic_field"] *= -1
        return replace(self, table=replace(self.table, magnetic_field=-self.table.magnetic_field), world=world)


def default_ball(table: Table) -> Ball:
    """Return a uniform disc or a solid ball of radius 1/10, or 1 where the table bounds the centre (only a omega matters then)."""
    radius = 0.1 if table.bounds == "surface" else 1.0
    return Disc(radius, 1.0) if table.dimension == 2 else Ball(radius, 1.0)


def orbit_setup(table: Table, ball: Ball | None, law: Any, surface: Surface | None, at_corner: str) -> OrbitSetup:
    """Validate a table, a ball and a law together and return them with the BILLIARD record; CaromError, one line per problem."""
    if not isinstance(table, Table):
        raise CaromError(
            Fault(
                "orbit",
                "table",
                "a table such as carom.billiards.circle()",
                f"{type(table).__name__} {table!r:.60}",
                f"carom.billiards.table({table!r:.60}) makes one of a name" if isinstance(table, str) else "",
            )
        )
    faults = FaultList("orbit")
    ball = default_ball(table) if ball is None else ball
    if not isinstance(ball, Ball) or np.ndim(ball.radius) or np.ndim(ball.kappa):
        faults.add("ball", "one carom.Ball or carom.Disc", f"{ball!r:.60}")
        ball = default_ball(table)
    elif ball.planar != (table.dimension == 2) and not (table.dimension == 2 and ball.kappa <= 2 / 3):
        faults.add("ball", "a carom.Ball, because the table lies in space", "a carom.Disc")
    if at_corner not in ("end", "pass"):
        faults.add("at_corner", "'end' or 'pass'", repr(at_corner))
    faults.raise_if_any()
    chosen, name = law_of(law, surface)
    response = response_of(chosen)
    e, mu, beta = surface_numbers(chosen, surface)
    if response == ROLLING_WALL and (table.dimension == 3 or any(table.acceleration)):
        raise CaromError(
            Fault("orbit", "law", "a horizontal table in the plane for the rolling reflection", f"{table.name}")
        )
    if response == ROLLING_WALL and not ball.kappa <= (2 / 3) * (1 + 1e-12):
        raise CaromError(
            Fault("orbit", "ball", "a carom.Ball for the rolling reflection (kappa <= 2/3)", repr(ball.kappa))
        )
    shape = table.shape(float(ball.radius))
    world, pieces = shape.arrays()
    world["planar"], world["corners"], world["law"] = table.dimension == 2, at_corner == "end", response
    world["a"], world["kappa"], world["e"], world["mu"], world["beta"] = ball.radius, ball.kappa, e, mu, beta
    world["acceleration"], world["magnetic_field"] = table.acceleration, table.magnetic_field
    world["flight"] = ARC if table.magnetic_field else PARABOLA if shape.crossed_by(table.acceleration) else STRAIGHT
    keeps = response in (NO_SLIP_WALL, ROLLING_WALL) or (
        response == CONTACT_WALL and e == 1 and (mu == 0 or beta == -1 or (beta == 1 and mu == math.inf))
    )
    world["conservative"] = keeps
    kernel = chosen.kernel if response == CALLED_WALL else None
    if kernel is not None:
        world["user"] = user_address(kernel)
    panels = np.zeros((1, ROW)) if shape.curve is None else shape.curve.table
    return OrbitSetup(table, ball, name, response, shape, world, pieces, panels, keeps, kernel)


def law_of(law: Any, surface: Surface | None) -> tuple[Law, str]:
    """Return the law and the name by which it was asked for; CaromError where a billiard cannot have it, or not so."""
    if surface is not None and not isinstance(surface, Surface):
        raise CaromError(Fault("orbit", "surface", "a carom.Surface", shown(surface, 60)))
    asked = law if isinstance(law, str) and ":" not in law else ""
    if isinstance(law, str):
        if asked and not any(asked == one.name or asked in one.aliases for one in laws().values()):
            known = [name for one in laws().values() if one.kernel is not None for name in (one.name, *one.aliases)]
            raise CaromError(
                Fault(
                    "orbit",
                    "law",
                    f"one of {', '.join(known)}, or a custom law (my_law.py:law)",
                    repr(law),
                    did_you_mean(law, known),
                )
            )
        law = find_law(law)
    elif callable(law) and not isinstance(law, Law):
        law = wall_law(Card(getattr(law, "__name__", "own"), "A custom law.", (), "", "", ""), law)
    if not isinstance(law, Law):
        raise CaromError(Fault("orbit", "law", "a name or a kernel", shown(law, 60)))
    if law.kernel is None:
        raise CaromError(Fault("orbit", "law", "a law of a wall alone", f"{law.name}, which needs a floor"))
    if surface is not None and not law.free and law.response != CALLED_WALL:
        raise CaromError(Fault("orbit", "surface", f"none with the {law.name} law", "one", "law='contact' uses it"))
    if surface is None and needs_surface(law):
        raise CaromError(Fault("orbit", "surface", f"a carom.Surface, which the {law.name} law needs", "none"))
    return law, asked or law.name


def needs_surface(law: Any) -> bool:
    """Whether a law, by name or as a carom.Law, has numbers that a billiard must be given."""
    if isinstance(law, str):
        law = next((one for one in laws().values() if law == one.name or law in one.aliases), None)
    return isinstance(law, Law) and bool(law.needs) and law.response != CALLED_WALL


def response_of(law: Law) -> int:
    """Return how the loop carries a law out: without a floor, the two-step law and the mirror are one contact."""
    return CONTACT_WALL if law.response in (TWO_STEP_WALL, MIRROR_WALL) else law.response


def surface_numbers(law: Law, surface: Surface | None) -> tuple[float, float, float]:
    """Return restitution, friction and the law's last number: those it holds fixed, the surface's, or an ideal wall's."""
    given = {"restitution": 1.0, "friction": math.inf, "tangential_restitution": 1.0, "stiffness_ratio": LIKE_SOLIDS}
    given |= {**law.defaults, "floor_friction": 0.0}  # (there is no floor)
    if surface is not None:
        found = {name: getattr(surface, name) for name in ON_WALL}
        if any(np.ndim(x) for x in found.values()):
            raise CaromError(Fault("orbit", "surface", "one surface", "arrays of them"))
        given |= {name: float(x) for name, x in found.items()}
    given |= law.pinned
    return given["restitution"], given["friction"], given[law.last]


def start_rows(setup: OrbitSetup, start: Any) -> tuple[Array, tuple[int, ...]]:
    """Return starts as rows (N, 9) of position, velocity and spin, and their shape (...)."""
    if not isinstance(start, Start):
        try:
            start = Start(*start)
        except TypeError:
            raise CaromError(
                Fault("orbit", "start", "a Start, or (position, velocity, spin)", shown(start, 60))
            ) from None
    d = setup.table.dimension
    faults = FaultList("orbit: start")
    x, v = _vectors(faults, "position", start.position, d), _vectors(faults, "velocity", start.velocity, d)
    if d == 2:
        w = _numbers(faults, "spin", start.spin)[..., None] * np.array([0.0, 0.0, 1.0])
    else:
        w = np.zeros(3) if np.ndim(start.spin) == 0 and not start.spin else _vectors(faults, "spin", start.spin, 3)
    faults.raise_if_any()
    shape = broadcast_shape(x.shape[:-1], v.shape[:-1], w.shape[:-1])
    rows = np.zeros((*shape, 9))
    rows[..., :d], rows[..., 3 : 3 + d], rows[..., 6:] = x, v, w
    rows = rows.reshape(-1, 9)
    if setup.rolls:
        # (18): the ball rolls on the table's floor, so its velocity determines its horizontal spin
        rows[:, 6], rows[:, 7] = -rows[:, 4] / setup.ball.radius, rows[:, 3] / setup.ball.radius
    _inside(setup, rows, shape, faults)
    faults.raise_if_any()
    return rows, shape


def _numbers(faults: FaultList, field: str, value: ArrayLike) -> Array:
    try:
        array = float_array(value)
    except (TypeError, ValueError):
        array = np.full((), np.nan)
    if not np.isfinite(array).all():
        faults.add(field, "finite numbers", f"{value!r:.60}")
        return np.zeros(())
    return array


def _vectors(faults: FaultList, field: str, value: ArrayLike, d: int) -> Array:
    try:
        array = float_array(value)
    except (TypeError, ValueError):
        array = np.empty(0)
    if array.ndim == 0 or array.shape[-1] != d or not np.isfinite(array).all():
        faults.add(field, f"finite vectors (..., {d})", f"{value!r:.60}")
        return np.zeros(d)
    return array


def _inside(setup: OrbitSetup, rows: Array, shape: tuple[int, ...], faults: FaultList) -> None:
    """Add a fault where a start lies outside the table, or does not move."""
    gap = setup.shape.gap(rows[:, :3])
    bad = gap < -1e-9 * setup.shape.size
    if bad.any():
        first = int(np.argmax(bad))
        where = (
            f" at index {tuple(int(i) for i in np.unravel_index(first, shape))} ({int(bad.sum())} in all)"
            if shape
            else ""
        )
        faults.add(
            "position",
            f"a centre inside {setup.table}",
            f"{rows[first, : setup.table.dimension].tolist()}, {-gap[first]:.3g} outside{where}",
            f"keep the centre {setup.ball.radius:g} or more from the wall" if setup.table.bounds == "surface" else "",
        )
    speed = np.abs(rows[:, 3:6]).max(axis=1)
    if (speed == 0).any():
        faults.add("velocity", "a moving ball", "one at rest")
    elif not ((speed >= MIN_MAGNITUDE) & (np.abs(rows[:, 3:]).max(axis=1) < MAX_MAGNITUDE)).all():
        faults.add(
            "velocity", "speeds and spins from 1e-100 to 1e100, whose squares are finite", f"{float(speed.max())!r}"
        )
