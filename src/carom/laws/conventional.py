"""The conventional law: the ball keeps rolling, the normal velocity is reversed, the energy is conserved.

The paper, section 2, (16)-(26); Treschev & Zubelevich; the rolling reflection of nonholonomic billiards (Borisov, Kilin
& Mamaev). With y along the wall, (17) and (21) leave two roots:

* a omega_z and y unchanged: nothing happens along the wall (rolling ball, mirror angle); friction plays no part;
* the slip y - a omega_z at the wall is reversed, (26): the root of the paper, (22).

The second is taken, as the paper does: it is the only one that answers to the constraint (4) imposed at the instant,
whose impulse is not zero where there is slip to act on; the first says that the constraint does nothing.
"""

from __future__ import annotations

from carom.kernel import Vec, kernel
from carom.laws.card import Card

__all__ = ["CARD", "conventional_reflection", "mirror_root"]

CARD = Card(
    name="conventional",
    summary="Rolling stays rolling, the normal velocity is reversed, the energy is conserved: the slip at the wall reverses.",
    assumptions=(
        "1: the ball rolls without sliding before and after",
        "2: the normal velocity is reversed (19), with e = 1",
        "3: the energy is conserved (21)",
        "wall and floor hold the ball at once, with impulses that friction need not be able to give",
    ),
    valid="The rolling reflection of nonholonomic billiards; a mathematical model. It asks the wall to pull the ball down and"
    " the floor for a friction above 1, so no real ball follows it.",
    equations="(16)-(26)",
    citation="D. V. Treschev & O. E. Zubelevich, Introduction to the Mechanics of Systems with Impacts; the paper, section 2.",
)


@kernel
def _tangential(v: Vec, n: Vec) -> float:
    """Velocity along the wall, in the direction k x n (+y for the wall of the examples)."""
    return v[1] * n[0] - v[0] * n[1]


@kernel
def _rolling(x: float, y: float, wz: float, n: Vec, a: float) -> tuple[Vec, Vec]:
    """State of a ball rolling with velocity x along n and y along k x n."""
    vx, vy = x * n[0] - y * n[1], x * n[1] + y * n[0]
    # (18): x' = a omega_y, y' = -a omega_x, z' = 0
    return (vx, vy, x - x), (-vy / a, vx / a, wz)


@kernel
def conventional_reflection(v: Vec, w: Vec, n: Vec, a: float, kappa: float) -> tuple[Vec, Vec]:
    """Velocity and spin of a rolling ball after a vertical wall with (horizontal, unit) normal n."""
    x, y, wz = v[0] * n[0] + v[1] * n[1], _tangential(v, n), w[2]
    # (22), with I = kappa m a^2: divide by m a^2 / 2
    y1 = (y + 2 * kappa * a * wz) / (1 + 2 * kappa)
    wz1 = (2 * (1 + kappa) * y / a - wz) / (1 + 2 * kappa)
    # (19) with e = 1
    return _rolling(-x, y1, wz1, n, a)


@kernel
def mirror_root(v: Vec, w: Vec, n: Vec, a: float, kappa: float) -> tuple[Vec, Vec]:
    """The other root of (17) and (21): what moves along the wall goes on, the ball rolls off at the mirror angle."""
    return _rolling(-(v[0] * n[0] + v[1] * n[1]), _tangential(v, n), w[2], n, a)
