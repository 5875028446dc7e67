"""The verbs: follow orbits, reverse them."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import NDArray

from carom.ball import Ball
from carom.errors import CaromError
from carom.orbits.arrays import DONE
from carom.orbits.loop import compiled
from carom.orbits.result import Orbit
from carom.orbits.setup import Setup, Start, prepare, setup_of
from carom.orbits.tables import Table
from carom.surface import Surface

__all__ = ["MOST", "final", "follow", "orbit", "require_reversible", "reverse", "whole"]

Array = NDArray[np.float64]
MOST = 4e9  # bytes of bounces that are kept
SHARE = 10_000_000  # bounces between two reports of progress


def orbit(
    table: Table,
    start: Any,
    bounces: int = 1000,
    *,
    ball: Ball | None = None,
    law: Any = "no-slip",
    surface: Surface | None = None,
    corners: str = "end",
    progress: Callable[[int, int], None] | None = None,
) -> Orbit:
    """Follow one ball, or many at once on all cores, for so many bounces; the same bits for any number of threads.

    Parameters
    ----------
    table : Table
        As :func:`carom.orbits.circle` and the others make it.
    start : Start, or (position, velocity, spin)
        Shapes (..., d), (..., d) and (...) (in space (..., 3)), broadcast; each orbit by itself.
    bounces : int
        How many.
    ball : Ball, optional
        In the plane a :func:`carom.Disc`, or a Ball with its axis upright; left out: kappa 1/2 (in space 2/5), mass 1, radius
        1, or 1/10 where the table bounds the surface.
    law : str or kernel
        "no-slip" (Broomhead & Gutkin), "mirror", "contact" (reads ``surface``: restitution, friction, tangential restitution),
        "rolling" (the nonholonomic reflection of a ball that rolls on the table's floor), "my_law.py:law", or a kernel
        (v, w, n, a, kappa, e, mu, beta) -> (v, w).
    corners : "end" or "pass"
        At a corner (within 1e-12 of the table's size) the map is not defined: the orbit ends. "pass": the ball meets the two
        sides one after the other, the one with the lower number first.
    progress : callable, optional
        Called with how many bounces of how many are done.

    Raises CaromError, one line a fault.
    """
    return follow(setup_of(table, ball, law, surface, corners), start, bounces, progress)


def follow(setup: Setup, start: Any, bounces: int, progress: Callable[[int, int], None] | None = None) -> Orbit:
    """:func:`orbit` of a table, a ball and a law that go together already."""
    rows, shape = prepare(setup, start)
    bounces = whole("bounces", bounces)
    d = setup.table.dimension
    width = 6 if setup.planar else 10
    if len(rows) * bounces * (8 * width + 4) > MOST:
        raise CaromError(
            f"orbit: bounces: expected no more than {int(MOST / (8 * width + 4)):,} in all, which are kept, got {len(rows)} x"
            f" {bounces:,}; final() keeps none"
        )
    kept = np.full((len(rows), bounces, width), np.nan)
    piece = np.full((len(rows), bounces), -1, np.int32)
    last, ends = _loop(setup, rows, bounces, kept, piece, progress)
    kept = kept.reshape(*shape, bounces, width)
    return Orbit(
        setup=setup,
        start=_state(setup, rows, shape),
        t=kept[..., 0],
        position=kept[..., 1 : 1 + d],
        velocity=kept[..., 1 + d : 1 + 2 * d],
        spin=kept[..., 5] if setup.planar else kept[..., 7:],
        piece=piece.reshape(*shape, bounces),
        count=ends[:, 1].reshape(shape),
        ending=ends[:, 0].reshape(shape),
        last=last.reshape(*shape, 10),
    )


def _state(setup: Setup, rows: Array, shape: tuple[int, ...]) -> Start:
    """Rows (N, 9) of position, velocity and spin, as a Start."""
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
    progress: Callable[[int, int], None] | None = None,
) -> tuple[Start, Array, Any, Any]:
    """As :func:`orbit`, keeping nothing on the way: the states at the end, their times, how many bounces, how it ended."""
    setup = setup_of(table, ball, law, surface, corners)
    rows, shape = prepare(setup, start)
    bounces = whole("bounces", bounces)
    width = 6 if setup.planar else 10
    nothing, none = np.empty((len(rows), 0, width)), np.empty((len(rows), 0), np.int32)
    last, ends = _loop(setup, rows, bounces, nothing, none, progress)
    return (
        _state(setup, last[:, 1:], shape),
        last[:, 0].reshape(shape),
        ends[:, 1].reshape(shape),
        ends[:, 0].reshape(shape),
    )


def whole(field: str, value: Any, least: int = 1) -> int:
    """A whole number, or a CaromError."""
    if isinstance(value, int | np.integer) and not isinstance(value, bool) and least <= value < 2**60:
        return int(value)
    raise CaromError(f"orbit: {field}: expected a whole number >= {least}, got {value!r}")


def _loop(
    setup: Setup, rows: Array, bounces: int, kept: Any, piece: Any, progress: Callable[[int, int], None] | None
) -> tuple[Array, NDArray[np.int64]]:
    """Run the compiled loop, in shares that let progress be told."""
    # in a periodic cell every orbit begins in the first
    shift = rows[:, :3] - setup.shape.folded(rows[:, :3])
    rows = rows - np.concatenate([shift, np.zeros((len(rows), 6))], axis=1)
    last, ends = np.empty((len(rows), 10)), np.zeros((len(rows), 2), np.int64)
    share = max(1, len(rows) if progress is None else min(len(rows), SHARE // bounces))
    for k in range(0, len(rows), share):
        here = slice(k, k + share)
        compiled().many(setup.world, setup.pieces, rows[here], bounces, kept[here], piece[here], last[here], ends[here])
        if progress is not None:
            progress(min(k + share, len(rows)) * bounces, len(rows) * bounces)
    if shift.any():
        d = setup.table.dimension
        kept[..., 1 : 1 + d] += shift[:, None, :d]
        last[:, 1:4] += shift
    return last, ends


def require_reversible(setup: Setup) -> None:
    """CaromError where the law loses energy, so that no orbit can be run backwards."""
    if not setup.keeps:
        raise CaromError(f"reverse: law: expected one that undoes itself (no-slip, mirror, rolling), got {setup.law}")


def reverse(found: Orbit) -> tuple[Orbit, Array]:
    """Run an orbit backwards from its last bounce; the orbit, and (..., B) how far each bounce lies from where it was.

    The no-slip, mirror and rolling reflections undo themselves, so it goes back through all its bounces, until chaos has
    multiplied what rounding took. Of orbits that made all their bounces.
    """
    setup = found.setup
    require_reversible(setup)
    if (np.asarray(found.ending) != DONE).any():
        raise CaromError("reverse: orbit: expected one that made all its bounces, got one that ended before")
    spin = found.spin[..., -1] if setup.planar else found.spin[..., -1, :]
    back = follow(setup, Start(found.position[..., -1, :], -found.velocity[..., -1, :], -spin), found.t.shape[-1])
    error = np.linalg.norm(back.position - np.flip(found.position, axis=found.t.ndim - 1), axis=-1)
    return back, error
