"""Problems of a scene's balls among each other: overlaps, names that several have."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from carom.errors import Fault, FaultList
from carom.formatting import format_length
from carom.scene.ball import SceneBall
from carom.scene.wall import format_vector

__all__ = ["BALLS_TOUCH", "TOUCH", "name_faults", "overlap_faults"]

TOUCH = 1e-9  # of the radius: what overlaps by less touches
BALLS_TOUCH = 1e-7  # so do balls: a rack in a file is rounded to some digits


def name_faults(balls: Sequence[SceneBall], names: Sequence[str]) -> list[Fault]:
    """Report names that an earlier ball has: a path, and a ball in a table, would be either. ``names``: "ball 1" for none."""
    first: dict[str, int] = {}
    found = FaultList()
    for i, (ball, name) in enumerate(zip(balls, names, strict=True)):
        one = first.setdefault(name, i)
        if one != i:
            named = ball if ball.name else balls[one]
            at, other = (i, one) if named is ball else (one, i)
            got = f"{name!r}, as balls[{other}] is called"
            found.add(f"balls[{at}].name", "a name that no other ball has", got)
    return found


def overlap_faults(balls: Sequence[SceneBall]) -> list[Fault]:
    """Report pairs of balls that overlap, found by sorting along x."""
    found: list[tuple[int, int, float]] = []
    x = np.array([ball.center for ball in balls])
    a = np.array([ball.radius for ball in balls])
    order = np.argsort(x[:, 0], kind="stable")
    x, a = x[order], a[order]
    last = np.searchsorted(x[:, 0], x[:, 0] + a + a.max(), side="right")
    for i in range(len(x) - 1):
        near = slice(i + 1, last[i])
        gap = np.sqrt(((x[near] - x[i]) ** 2).sum(axis=1)) - a[near] - a[i]
        for j in np.flatnonzero(gap < -BALLS_TOUCH * np.minimum(a[near], a[i])):
            one, two = sorted((int(order[i]), int(order[i + 1 + j])))
            found.append((one, two, float(-gap[j])))
    faults = FaultList()
    for one, two, deep in sorted(found):
        got = f"{format_vector(balls[two].center)}, which overlaps balls[{one}] by {format_length(deep)}"
        advice = f"move it by {format_length(deep)} or more"
        faults.add(f"balls[{two}].position", "a place where the ball touches nothing", got, advice)
    return faults
