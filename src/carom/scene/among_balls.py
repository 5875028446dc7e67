"""Balls of a scene among each other: which of them overlap, and whether their material is too soft for them."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from carom.scene.ball import SceneBall
from carom.scene.ball_contact import YOUNG, BallContact
from carom.scene.scene_rules import least_young

__all__ = ["default_is_too_soft", "fastest", "near_pairs"]


def near_pairs(balls: Sequence[SceneBall]) -> list[tuple[int, int]]:
    """Return the pairs of balls that are nearer than their radii together, by their numbers in order, found by sorting along x."""
    x = np.array([ball.center for ball in balls])
    a = np.array([ball.radius for ball in balls])
    order = np.argsort(x[:, 0], kind="stable")
    x, a = x[order], a[order]
    last = np.searchsorted(x[:, 0], x[:, 0] + a + a.max(), side="right")
    found: list[tuple[int, int]] = []
    for i in range(len(x) - 1):
        near = slice(i + 1, last[i])
        apart = np.sqrt(((x[near] - x[i]) ** 2).sum(axis=1))
        close = np.flatnonzero(apart < a[near] + a[i]).tolist()
        pairs = ((int(order[i]), int(order[i + 1 + j])) for j in close)
        found += [(min(pair), max(pair)) for pair in pairs]
    return sorted(found)


def fastest(balls: Sequence[SceneBall]) -> tuple[float, float, float]:
    """Return the speed (m/s), mass and radius of the fastest ball."""
    speeds = [math.hypot(*ball.state.velocity) for ball in balls]
    u, ball = max(zip(speeds, balls, strict=True), key=lambda one: one[0])
    return u, ball.mass, ball.radius


def default_is_too_soft(contact: BallContact, balls: Sequence[SceneBall]) -> bool:
    """Return whether the default modulus, that of phenolic resin, is too soft for balls of these sizes, masses and speeds."""
    default = contact.modulus > 0 and len(balls) > 1 and contact.young == YOUNG
    return default and contact.young < least_young(contact.young, contact.modulus, *fastest(balls))
