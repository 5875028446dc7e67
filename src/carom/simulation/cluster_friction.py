"""Coulomb's friction of contacts that overlap in time.

A slip that has ended stays 0 as long as less than the most of friction does that. So the friction of each contact is carried from
step to step: in a step it is that of the step before, and at its end the impulse is changed by what ends the slip that is left, to
at most the coefficient of friction times the normal impulse in the step. A force in proportion to the slip would lag behind.

Where less than the slip ends, friction is along the slip of mid-step (the implicit midpoint rule): of second
order.

Eight numbers a contact are kept in a slot: the friction; of the step the mean normal force, the time in which it acted, and the
slip with which it began.
"""

from __future__ import annotations

import math
from typing import Any

from carom.core.jit.kernel import Vec, dot, kernel

WIDTH = 8  # of a slot
SLOTS = 12  # of a ball, for those near it that have a lower number: so many of its size can touch it


@kernel
def across(u: Vec, n: Vec) -> Vec:
    """Return the part of a velocity along the plane of normal n."""
    un = dot(u, n)
    return (u[0] - un * n[0], u[1] - un * n[1], u[2] - un * n[2])


@kernel
def friction_before(rub: Any, slot: int, share: float, push: float) -> Vec:
    """Return the friction of the step before, and note that the contact pushes in a share of this one; none beyond the slots."""
    if slot >= SLOTS:
        return (0 * push, 0 * push, 0 * push)
    at = WIDTH * slot
    rub[at + 3] += share * push
    rub[at + 4] += share
    return (rub[at], rub[at + 1], rub[at + 2])


@kernel
def begins(rub: Any, slot: int) -> bool:
    """Return whether a contact has not pushed in this step yet: its slip is to be noted (:func:`write_slip`)."""
    return bool(slot < SLOTS and rub[WIDTH * slot + 4] == 0)


@kernel
def write_slip(rub: Any, slot: int, t: Vec) -> None:
    """Note the slip with which a contact begins a step."""
    at = WIDTH * slot + 5
    rub[at], rub[at + 1], rub[at + 2] = t


@kernel
def mean_slip(rub: Any, slot: int, t: Vec) -> Vec:
    """Return the mean of the slip with which a contact began a step, and of t, that at the end."""
    at = WIDTH * slot + 5
    return ((rub[at] + t[0]) / 2, (rub[at + 1] + t[1]) / 2, (rub[at + 2] + t[2]) / 2)


@kernel
def rubbed(rub: Any, slot: int) -> bool:
    """Return whether a contact has pushed in this step, or in the one before."""
    at = WIDTH * slot
    return bool(slot < SLOTS and (rub[at + 4] != 0 or rub[at] != 0 or rub[at + 1] != 0 or rub[at + 2] != 0))


@kernel
def write_friction(rub: Any, slot: int, f: Vec) -> None:
    """Keep a contact's friction for the next step."""
    at = WIDTH * slot
    rub[at], rub[at + 1], rub[at + 2] = f
    rub[at + 3] = rub[at + 4] = 0.0


@kernel
def friction_of_step(
    rub: Any, slot: int, n: Vec, t: Vec, mean: Vec, mt: float, mu: float, h: float, last: bool
) -> Vec:  # fmt: skip
    """Return the impulse that friction lacks at the end of a step h, where a slip t is left; keep the friction for the next one.

    mean: the slip of mid-step; mt: the mass that the slip has.
    """
    at = WIDTH * slot
    part = rub[at + 4]
    push = rub[at + 3]
    most = mu * push if push > 0 else 0 * push
    old = (rub[at], rub[at + 1], rub[at + 2])
    g = across(old, n)
    c = mt / h
    f = (part * g[0] - c * t[0], part * g[1] - c * t[1], part * g[2] - c * t[2])
    if not dot(f, f) <= most * most:
        # f with the slip of mid-step after it, (mean + (f - part g) / 2 c), along -f
        f = (part * g[0] - 2 * c * mean[0], part * g[1] - 2 * c * mean[1], part * g[2] - 2 * c * mean[2])
        square = dot(f, f)
        less = most / math.sqrt(square) if square > 0 else 0 * most
        f = (less * f[0], less * f[1], less * f[2])
    write_friction(rub, slot, f)
    if not last:
        rub[at + 3], rub[at + 4] = push, 1.0
    return (h * (f[0] - part * old[0]), h * (f[1] - part * old[1]), h * (f[2] - part * old[2]))
