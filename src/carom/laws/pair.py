"""Ball against ball: the same one contact, with the pair's masses."""

from __future__ import annotations

from carom.kernel import Vec, cross, dot, kernel
from carom.laws.contact import contact

__all__ = ["pair_contact"]


@kernel
def pair_contact(
    v1: Vec, w1: Vec, v2: Vec, w2: Vec, n: Vec,
    a1: float, m1: float, kappa1: float, a2: float, m2: float, kappa2: float, e: float, mu: float, beta: float,
) -> tuple[Vec, Vec, Vec, Vec, Vec, float, int]:  # fmt: skip
    """Both velocities and spins after contact, the impulse (N s) on ball 1, required friction, regime.

    n points from the centre of ball 2 to that of ball 1.
    """
    # Ball 1 is touched at -a1 n, ball 2 at +a2 n: the velocity of the first point relative to the second.
    r = cross((a1 * w1[0] + a2 * w2[0], a1 * w1[1] + a2 * w2[1], a1 * w1[2] + a2 * w2[2]), n)
    u = (v1[0] - v2[0] - r[0], v1[1] - v2[1] - r[1], v1[2] - v2[2] - r[2])
    un = dot(u, n)
    ut = (u[0] - un * n[0], u[1] - un * n[1], u[2] - un * n[2])
    mn = m1 * m2 / (m1 + m2)
    mt = 1 / ((1 + 1 / kappa1) / m1 + (1 + 1 / kappa2) / m2)
    pn, f, required, regime = contact(un, ut, mn, mt, e, mu, beta)
    j = (pn * n[0] + f[0], pn * n[1] + f[1], pn * n[2] + f[2])
    t = cross(n, f)
    c1, c2 = kappa1 * m1 * a1, kappa2 * m2 * a2
    return (
        (v1[0] + j[0] / m1, v1[1] + j[1] / m1, v1[2] + j[2] / m1),
        (w1[0] - t[0] / c1, w1[1] - t[1] / c1, w1[2] - t[2] / c1),
        (v2[0] - j[0] / m2, v2[1] - j[1] / m2, v2[2] - j[2] / m2),
        (w2[0] - t[0] / c2, w2[1] - t[1] / c2, w2[2] - t[2] / c2),
        j,
        required,
        regime,
    )
