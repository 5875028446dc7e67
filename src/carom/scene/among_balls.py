"""Problems of a scene's balls among each other: overlaps, names that several have."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from carom.errors import Fault, FaultList
from carom.formatting import format_length
from carom.scene.ball import SceneBall
from carom.scene.ball_contact import YOUNG, BallContact
from carom.scene.wall import format_vector

__all__ = ["BALLS_TOUCH", "TOUCH", "default_is_too_soft", "name_faults", "overlap_faults", "stiffness_faults"]

TOUCH = 1e-9  # of the radius: what overlaps by less touches
BALLS_TOUCH = 1e-7  # so do balls: a rack in a file is rounded to some digits
DEEPEST = 0.5  # of the radius: softer balls would press deeper, where Hertz's force is no answer
HARDEST = 1e15  # Pa, a thousand times that of diamond: harder balls press less than they may overlap


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


def least_young(contact: BallContact, balls: Sequence[SceneBall]) -> tuple[float, float, float]:
    """Return the modulus (Pa) below which the fastest ball would press one alike by more than half its radius; speed and radius.

    Two elastic balls press (15 m u^2 / (16 E* sqrt(R*)))^(2/5) deep (K. L. Johnson, Contact Mechanics, 11.4; m and R* are halves).
    """
    speeds = [math.hypot(*ball.state.velocity) for ball in balls]
    u, ball = max(zip(speeds, balls, strict=True), key=lambda one: one[0])
    a = ball.radius
    modulus = 15 * ball.mass / 2 * u * u / (16 * math.sqrt(a / 2) * (DEEPEST * a) ** 2.5)
    return contact.young * modulus / contact.modulus, u, a


def default_is_too_soft(contact: BallContact, balls: Sequence[SceneBall]) -> bool:
    """Return whether the default modulus, that of phenolic resin, is too soft for balls of these sizes, masses and speeds."""
    return contact.modulus > 0 and len(balls) > 1 and YOUNG == contact.young < least_young(contact, balls)[0]


def stiffness_faults(contact: BallContact, balls: Sequence[SceneBall]) -> list[Fault]:
    """Report a modulus that makes balls too soft for the fastest of them, or harder than any matter."""
    if not contact.modulus > 0 or len(balls) < 2 or contact.young == YOUNG:
        return []
    least, u, a = least_young(contact, balls)
    at, got, advice = "ball_contact.young", f"{contact.young:.3g} Pa", "overlap = false takes contacts as hard"
    found = FaultList()
    if contact.young < least:
        expected = (
            f"at least {least:.3g} Pa: softer balls press deeper than {format_length(DEEPEST * a)} at {u:.3g} m/s"
        )
        found.add(at, expected, got, advice)
    if contact.young > HARDEST:
        found.add(at, f"at most {HARDEST:g} Pa", got, advice)
    return found
