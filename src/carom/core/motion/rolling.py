"""Rolling on the floor: the state in which a sliding ball rolls at last, from the angular momentum that friction conserves."""

from __future__ import annotations

from carom.core.jit.kernel import Vec, hot_kernel

__all__ = ["UP", "rolls_at_last"]

UP: Vec = (0.0, 0.0, 1.0)  # normal of the floor


@hot_kernel
def rolls_at_last(v: Vec, w: Vec, a: float, kappa: float) -> tuple[Vec, Vec]:
    """Return velocity and spin of the rolling that a ball in the state (v, w) comes to, if it comes to roll.

    Friction at the floor's contact point conserves the angular momentum about that point and omega_z.
    """
    # (37), (38), solved for velocity and spin: (39), with I = kappa m a^2
    c, d = 1 / (1 + kappa), 1 / a
    x = (v[0] + kappa * a * w[1]) * c
    y = (v[1] - kappa * a * w[0]) * c
    return (x, y, x - x), (-y * d, x * d, w[2])
