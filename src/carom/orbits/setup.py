"""From what people hand in to what the loops read: starts, the ball, the law."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from carom.ball import Ball, Disc
from carom.checks import LARGEST, Faults, float_array, require_shapes
from carom.errors import CaromError
from carom.orbits.arrays import CONTACT, NO_SLIP, ROLLING, USER
from carom.orbits.shape import Shape
from carom.orbits.tables import Table
from carom.surface import Surface

__all__ = ["LAWS", "Setup", "Start", "default_ball", "prepare", "setup_of"]

Array = NDArray[np.float64]
LAWS = ("no-slip", "mirror", "contact", "rolling")


@dataclass(frozen=True, eq=False)
class Start:
    """Where orbits begin, and how: position (..., d), velocity (..., d), spin (...) in the plane, (..., 3) in space.

    A start may lie on the wall, moving away from it: just after a bounce. The arrays broadcast against each other.
    """

    position: Any
    velocity: Any
    spin: Any = 0.0


@dataclass(frozen=True, eq=False)
class Setup:
    """A table, a ball and a law, as the loops read them."""

    table: Table
    ball: Ball
    law: str
    shape: Shape
    world: Any
    pieces: NDArray[np.void]
    keeps: bool
    """Whether the law conserves the energy."""

    @property
    def planar(self) -> bool:
        """Whether the table lies in the plane."""
        return self.table.dimension == 2


def default_ball(table: Table) -> Ball:
    """A uniform disc of radius 1/10, or a solid ball; of radius 1 where the table bounds the centre (only a omega counts)."""
    radius = 0.1 if table.bounds == "surface" else 1.0
    return Disc(radius, 1.0) if table.dimension == 2 else Ball(radius, 1.0)


def setup_of(table: Table, ball: Ball | None, law: Any, surface: Surface | None, corners: str) -> Setup:
    """Check what goes together, and write the world's record."""
    if not isinstance(table, Table):
        raise CaromError(
            f"orbit: table: expected a table, as carom.orbits.circle() makes one, got {type(table).__name__} {table!r:.60}"
        )
    faults = Faults("orbit")
    ball = default_ball(table) if ball is None else ball
    if not isinstance(ball, Ball) or np.ndim(ball.radius) or np.ndim(ball.kappa):
        faults.add("ball", "one carom.Ball or carom.Disc", f"{ball!r:.60}")
        ball = default_ball(table)
    elif ball.planar != (table.dimension == 2) and not (table.dimension == 2 and ball.kappa <= 2 / 3):
        faults.add("ball", "a carom.Ball, for the table lies in space", "a carom.Disc")
    if corners not in ("end", "pass"):
        faults.add("corners", "'end' or 'pass'", repr(corners))
    faults.done()
    number, kernel, name = law_of(law, surface)
    e, mu, beta = 1.0, math.inf, 1.0
    if number == CONTACT:
        if name == "mirror":
            e, mu, beta = (1.0 if surface is None else float(surface.restitution)), 0.0, -1.0
        elif surface is None:
            raise CaromError("orbit: surface: expected a carom.Surface, for the contact law reads it, got none")
    if surface is not None and name != "mirror":
        if any(np.ndim(x) for x in (surface.restitution, surface.friction, surface.tangential_restitution)):
            raise CaromError("orbit: surface: expected one surface, got arrays of them")
        e, mu, beta = float(surface.restitution), float(surface.friction), float(surface.tangential_restitution)
    if number == ROLLING and (table.dimension == 3 or any(table.pull)):
        raise CaromError(
            f"orbit: law: expected a level table of the plane for the rolling reflection, got {table.name}; the ball rolls on it"
        )
    if number == ROLLING and not ball.kappa <= (2 / 3) * (1 + 1e-12):
        raise CaromError(
            f"orbit: ball: expected a carom.Ball for the rolling reflection (kappa <= 2/3), got {ball.kappa!r}"
        )
    shape = table.shape(float(ball.radius))
    world, pieces = shape.arrays()
    world["planar"], world["corners"], world["law"] = table.dimension == 2, corners == "end", number
    world["a"], world["kappa"], world["e"], world["mu"], world["beta"] = ball.radius, ball.kappa, e, mu, beta
    world["pull"], world["falls"] = table.pull, shape.crossed_by(table.pull)
    keeps = number in (NO_SLIP, ROLLING) or (
        number == CONTACT and e == 1 and (mu == 0 or beta == -1 or (beta == 1 and mu == math.inf))
    )
    world["keeps"] = keeps
    if kernel is not None:
        from carom.engine.users import user_address

        world["user"] = user_address(kernel)
    return Setup(table, ball, name, shape, world, pieces, keeps)


def law_of(law: Any, surface: Surface | None) -> tuple[int, Any, str]:
    """The law's number in the loop, a kernel where it is a user's own, its name."""
    from carom.law import Law

    if surface is not None and not isinstance(surface, Surface):
        raise CaromError(f"orbit: surface: expected a carom.Surface, got {surface!r:.60}")
    known = {"no-slip": NO_SLIP, "mirror": CONTACT, "contact": CONTACT, "rolling": ROLLING, "conventional": ROLLING}
    if isinstance(law, str) and law in known:
        if law == "no-slip" and surface is not None:
            raise CaromError("orbit: surface: expected none, for the no-slip law needs none; law='contact' reads it")
        return known[law], None, "rolling" if law == "conventional" else law
    if isinstance(law, str):
        if ":" not in law:
            from carom.checks import meant

            raise CaromError(
                f"orbit: law: expected one of {', '.join(LAWS)}, or a kernel of your own (my_law.py:law), got {law!r}"
                f"{meant(law, list(LAWS))}"
            )
        from carom.own_law import find_law

        law = find_law(law)
    if isinstance(law, Law):
        if law.kernel is None:
            raise CaromError(f"orbit: law: expected a law of one wall, got {law.name}, which needs a floor as well")
        return USER, law.kernel, law.name
    if callable(law):
        return USER, law, getattr(law, "__name__", "own")
    raise CaromError(f"orbit: law: expected a name or a kernel, got {law!r:.60}")


def prepare(setup: Setup, start: Any) -> tuple[Array, tuple[int, ...]]:
    """Starts as rows (N, 9) of position, velocity and spin, and the shape (...) that they had."""
    if not isinstance(start, Start):
        try:
            start = Start(*start)
        except TypeError:
            raise CaromError(
                f"orbit: start: expected a Start, or (position, velocity, spin), got {start!r:.60}"
            ) from None
    d = setup.table.dimension
    faults = Faults("orbit: start")
    x, v = _vectors(faults, "position", start.position, d), _vectors(faults, "velocity", start.velocity, d)
    if d == 2:
        w = _numbers(faults, "spin", start.spin)[..., None] * np.array([0.0, 0.0, 1.0])
    else:
        w = np.zeros(3) if np.ndim(start.spin) == 0 and not start.spin else _vectors(faults, "spin", start.spin, 3)
    faults.done()
    shape = require_shapes(x.shape[:-1], v.shape[:-1], w.shape[:-1])
    rows = np.zeros((*shape, 9))
    rows[..., :d], rows[..., 3 : 3 + d], rows[..., 6:] = x, v, w
    rows = rows.reshape(-1, 9)
    if setup.law == "rolling":
        # (18): the ball rolls on the table's floor, so its spin follows its velocity but for spin_z
        rows[:, 6], rows[:, 7] = -rows[:, 4] / setup.ball.radius, rows[:, 3] / setup.ball.radius
    _inside(setup, rows, shape, faults)
    faults.done()
    return rows, shape


def _numbers(faults: Faults, field: str, value: ArrayLike) -> Array:
    try:
        array = float_array(value)
    except (TypeError, ValueError):
        array = np.full((), np.nan)
    if not np.isfinite(array).all():
        faults.add(field, "finite numbers", f"{value!r:.60}")
        return np.zeros(())
    return array


def _vectors(faults: Faults, field: str, value: ArrayLike, d: int) -> Array:
    try:
        array = float_array(value)
    except (TypeError, ValueError):
        array = np.empty(0)
    if array.ndim == 0 or array.shape[-1] != d or not np.isfinite(array).all():
        faults.add(field, f"finite vectors (..., {d})", f"{value!r:.60}")
        return np.zeros(d)
    return array


def _inside(setup: Setup, rows: Array, shape: tuple[int, ...], faults: Faults) -> None:
    """A fault where a start lies outside, or does not move."""
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
            f"a centre within the table, {setup.table}",
            f"{rows[first, : setup.table.dimension].tolist()}, {-gap[first]:.3g} outside{where}",
        )
        if setup.table.bounds == "surface":
            faults.advise("position", f"the centre keeps {setup.ball.radius:g} from the wall")
    speed = np.abs(rows[:, 3:6]).max(axis=1)
    if (speed == 0).any():
        faults.add("velocity", "a ball that moves", "one at rest")
    elif not ((speed > 1 / LARGEST) & (np.abs(rows[:, 3:]).max(axis=1) < LARGEST)).all():
        faults.add(
            "velocity", "speeds and spins whose squares are numbers (1e-100 to 1e100)", f"{float(speed.max())!r}"
        )
