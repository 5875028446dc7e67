"""Tokarsky's room: the lattice argument in whole numbers, and flights of the engine in all small directions."""

from __future__ import annotations

import math
from itertools import product

import numpy as np

from carom import billiards
from carom.scene.figures import figure

ROOM = figure("tokarsky", side=1.0)


def grid_corners() -> list[tuple[int, int]]:
    """Return the corners on the grid whose points with two even coordinates are images of the 45-degree corner."""
    (loop,) = ROOM.outline()  # type: ignore[attr-defined]
    return [(round(x) + 4, round(y) + 2) for x, y in (piece.at(np.array(piece.span()))[0][0] for piece in loop)]


def inside_or_on(x: int, y: int, corners: list[tuple[int, int]]) -> bool:
    """Return whether a grid point lies in the closed polygon, in whole numbers."""
    within = False
    for (ax, ay), (bx, by) in zip(corners, corners[1:] + corners[:1], strict=True):
        across = (bx - ax) * (y - ay) - (by - ay) * (x - ax)
        if across == 0 and min(ax, bx) <= x <= max(ax, bx) and min(ay, by) <= y <= max(ay, by):
            return True
        if (ay > y) != (by > y):
            within ^= (across > 0) == (by > ay)
    return within


def test_no_flight_leads_from_the_candle_to_the_dark_place() -> None:
    corners = grid_corners()
    assert len(set(corners)) == 26
    # all walls lie on mirrors of the triangles of 45, 45 and 90 degrees with a 45-degree corner in (0, 0)
    for (ax, ay), (bx, by) in zip(corners, corners[1:] + corners[:1], strict=True):
        assert ax == bx or ay == by or (abs(bx - ax) == abs(by - ay) and (ax - ay) % 2 == 0)
    # unfolded, a flight between points with even coordinates goes by (2 m, 2 n), through (2 m, 2 n)/gcd(2 m, 2 n) first, of
    # whose coordinates one is odd; such points of the room are its corners, where it ends
    odd = [(x, y) for x, y in product(range(9), range(5)) if (x % 2 or y % 2) and inside_or_on(x, y, corners)]
    assert set(odd) <= set(corners)
    (a, b), (c, d) = ROOM.dark_pair  # type: ignore[attr-defined]
    assert (a + 4, b + 2, c + 4, d + 2) == (2, 2, 6, 2)
    assert inside_or_on(2, 2, corners)
    assert inside_or_on(6, 2, corners)


def test_flights_of_the_engine_end_in_the_corner_that_the_lattice_tells() -> None:
    table = billiards.table(ROOM)
    candle, dark = ROOM.dark_pair  # type: ignore[attr-defined]
    # all directions in which a grid point lies, with that point reached after 1 s
    aims = [(p, q) for p, q in product(range(-12, 13), repeat=2) if math.gcd(p, q) == 1]
    start = billiards.Start(np.full((len(aims), 2), candle), np.array(aims, float))
    found = billiards.orbit(table, start, 60, law="mirror")
    assert (found.ended == "corner").all()
    assert (found.count >= 0).all()
    corners = np.array(grid_corners()) - (4, 2)
    for k, (aim, count) in enumerate(zip(aims, found.count, strict=True)):
        t, x, v = (
            (0.0, candle, aim)
            if not count
            else (found.t[k, count - 1], found.position[k, count - 1], found.velocity[k, count - 1])
        )
        end = np.array(x) + (1.0 - t) * np.array(v)
        assert np.abs(corners - end).max(axis=1).min() < 1e-9
        # nor does it pass the dark place on its way
        path = np.concatenate([[candle], found.position[k, :count], [end]])
        begin, step = path[:-1], np.diff(path, axis=0)
        share = np.clip(((dark - begin) * step).sum(-1) / np.maximum((step * step).sum(-1), 1e-300), 0, 1)
        assert np.linalg.norm(begin + share[:, None] * step - dark, axis=-1).min() > 1e-3
