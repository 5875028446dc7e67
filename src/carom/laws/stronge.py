"""Lumped tangential compliance: one tangential spring, in series with friction, in addition to the normal spring.

Stronge, Impact Mechanics (Cambridge University Press, 2000), chapter 5. The contact is a massless point on two springs.
The normal one is linear and unloads with 1/e^2 times its stiffness, so that the wall returns e^2 of the energy stored. The
tangential one is k times as stiff as the normal one under loading, and is stretched by the motion of the ball's surface as
long as friction holds the point (stick).

Units in which every phase is an arc: the normal force is mu sin(phi), phi from 0 to pi/2 in compression and on to pi in
restitution, which is 1/e times as fast. The tangential force over mu is x, and the slip of the ball's surface is y, scaled
so that during stick (x, y) rotates by w times the change of phi,

    w = omega = sqrt(k (1 + 1/kappa)) in compression, e omega in restitution, y = k u_t / (omega mu |u_n|) at first.

The point sticks while |x| < sin(phi). Where it slips, x = s sin(phi), y changes by w s cos(phi), and the slip of the point
is y - s cos(phi)/w. All of this is in closed form except the ends of stick phases, the roots of a difference of two sines.
"""

from __future__ import annotations

import math

from carom.core.contact import LEAST, slip_velocity, struck_along
from carom.core.jit.kernel import Vec, dot, kernel, root_of
from carom.laws.law import (
    COMPLIANT_READS,
    Card,
    Case,
    Conditions,
    FitSpec,
    Rule,
    Said,
    compliant_objections,
    wall_law,
)

CARD = Card(
    name="stronge",
    summary="Tangential compliance by one spring that stores part of the slip, in series with Coulomb friction.",
    assumptions=(
        "one normal and one tangential spring, with stiffness ratio k; Coulomb's law for the whole contact",
        "the normal spring is linear and unloads with 1/e^2 times its stiffness; the tangential one keeps its stiffness",
        "the ball touches nothing else during the contact",
    ),
    valid="Balls on hard or rubber surfaces where no constant tangential restitution fits all angles, with any stiffness"
    " ratio k. For a sphere on a solid, maw is closer to elasticity theory: there slip begins at the edge of the contact.",
    equations="carom.laws.stronge",
    citation="W. J. Stronge, Impact Mechanics (Cambridge University Press, 2000), chapter 5.",
    doi="10.1017/CBO9780511626432",
)

STIFFNESS = (1e-3, 1e3)  # range of stiffness ratios
# The largest omega: ratio of the angular frequencies of the tangential and the normal spring. Beyond it, which requires a
# moment of inertia near zero, the phase at the end is no longer resolved.
MOST_OMEGA = 1e3
SWINGS = 1000  # half oscillations in a quarter of the contact, at most: MOST_OMEGA / 2, and the two at its ends
ARCS = 3 * SWINGS  # at most: each half oscillation has three


@kernel
def _oscillate_on_spring(x: float, y: float, turn: float) -> tuple[float, float]:
    """Rotate (x, y): oscillation of the ball on the spring."""
    c, s = math.cos(turn), math.sin(turn)
    return c * x + s * y, c * y - s * x


@kernel
def _friction_margin(x: float, y: float, w: float, start: float, phi: float, rising: bool) -> float:
    """Margin of friction at phi; or, if ``rising``, the rate of the tangential over the normal force."""
    p, q = _oscillate_on_spring(x, y, w * (phi - start))
    if rising:
        # (x / sin)' sin^2: it changes its sign once at most, since its rate is (1 - w^2) x sin
        return (w * q * math.sin(phi) - p * math.cos(phi)) * (1 if p >= 0 else -1)
    return math.sin(phi) - abs(p)


@kernel
def _margin_root(x: float, y: float, w: float, start: float, low: float, high: float, rising: bool) -> float:
    """Root of :func:`_friction_margin` between low (positive) and high (negative), by safeguarded false position."""
    f, g = _friction_margin(x, y, w, start, low, rising), _friction_margin(x, y, w, start, high, rising)
    for i in range(100):
        phi = low + (high - low) * f / (f - g) if f - g > 0 else high
        if i % 4 == 3 or not low < phi < high:
            phi = (low + high) / 2
        if not low < phi < high or high - low < 1e-15:
            break
        h = _friction_margin(x, y, w, start, phi, rising)
        if h >= 0:
            # (Illinois: the weight of the other end is halved)
            low, f, g = phi, h, g / 2
        else:
            high, f, g = phi, f / 2, h
        if h == 0:
            break
    p, q = _oscillate_on_spring(x, y, w * (high - start))
    side = 1 if p >= 0 else -1
    rate = side * (1 - w * w) * p * math.sin(high) if rising else math.cos(high) - side * w * q
    return root_of(high, _friction_margin(x, y, w, start, high, rising), rate)


@kernel
def _stick_ends(x: float, y: float, w: float, start: float, end: float, falls: bool) -> tuple[float, bool]:
    """Return where the stick phase that begins at ``start`` ends, at most at ``end``, and whether slip begins there.

    Between two zeros of x, x / sin(phi) has one extremum at most (see :func:`_friction_margin`). Its value there decides whether it
    passes 1, and brackets the root. ``falls``: it starts from 1 and decreases until the next zero.
    """
    # x is largest after a rotation by atan2(y, x); it is zero a quarter of a turn later, and then after every half turn
    zero = math.atan2(y, x) + math.pi / 2
    zero -= math.pi * math.floor(zero / math.pi)
    if zero < 1e-12:
        zero += math.pi
    low = start
    for swing in range(SWINGS):
        high = min(end, start + (zero + swing * math.pi) / w)
        if not low < high:
            break
        first, last = low + 1e-9 * (high - low), high - 1e-9 * (high - low)  # x is not zero there
        if not falls and (w <= 1 or _friction_margin(x, y, w, start, first, True) > 0):
            top = high
            if w > 1 and _friction_margin(x, y, w, start, last, True) < 0:
                top = _margin_root(x, y, w, start, first, last, True)
            if _friction_margin(x, y, w, start, top, False) < 0:
                return _margin_root(x, y, w, start, low, top, False), True
        low, falls = high, False
    return end, False


@kernel
def _spring_half(x: float, y: float, w: float, slips: bool, side: int, second: bool) -> tuple[float, float, bool, int]:
    """Force and slip after compression (or restitution, ``second``): arcs of stick or slip, the latter towards ``side``."""
    start, falls = math.pi / 2 if second else 0.0, False
    phi, level, last = start, 0.0 if second else 1.0, -1.0 if second else 0.0  # level: cos(phi)
    for _ in range(ARCS):
        if slips:
            # slip ends where that of the point, s y - cos/w, vanishes; with w <= 1 it only grows
            stops = min(level, (w * level - side * y) / (w - 1 / w)) if w > 1 else -2.0
            slips, falls = stops < last, True
            now = last if slips else stops
            y += w * side * (now - level)
            x, level = side * math.sqrt(max(1 - now * now, 0.0)), now
            if slips:
                break
            phi = max(phi, math.acos(level))
        else:
            until, slips = _stick_ends(x, y, w, phi, start + math.pi / 2, falls and w > 1)
            x, y = _oscillate_on_spring(x, y, w * (until - phi))
            phi, level = until, math.cos(until)
            if not slips:
                break
            side = 1 if x > 0 else -1
    return x, y, slips, side


@kernel
def stronge_slip_ratio(u: float, kappa: float, e: float, k: float) -> float:
    """Slip after over slip before the impact, with its sign; u = slip / (mu u_n) > 0, k the stiffness ratio."""
    omega = min(math.sqrt(k * (1 + 1 / kappa)), MOST_OMEGA)
    if not u > 0:  # slip begins only at the end of the contact
        return math.cos(omega * (1 + e) * math.pi / 2)
    y0 = k * u / omega
    x, y, slips, side = _spring_half(0 * u, y0, omega, y0 * omega > 1, 1, False)
    if e > 0:
        x, y, slips, side = _spring_half(x, y, e * omega, slips, side, True)
    return y / y0


@kernel
def stronge_contact(v: Vec, w: Vec, n: Vec, a: float, kappa: float, e: float, mu: float, k: float) -> tuple[Vec, Vec]:
    """Velocity and spin of a ball after a wall contact with tangential over normal stiffness k."""
    un, ut = slip_velocity(v, w, n, a)
    slip = math.sqrt(dot(ut, ut))
    pn = -(1 + e) * un
    f = 0 * slip
    most = mu * -un
    if slip > 0 and most > 0 and pn > LEAST * slip:
        if slip >= most * (1 + e) * (1 + 1 / kappa) and k * slip >= most:  # it slips throughout
            f = -mu * pn / slip
        else:
            f = (stronge_slip_ratio(slip / most if mu < math.inf else f, kappa, e, k) - 1) * kappa / (1 + kappa)
    return struck_along(v, w, n, a, kappa, pn, f, ut)


@kernel
def _stiff(c: Case) -> Said:
    return (c.stiffness >= STIFFNESS[0]) & (c.stiffness <= STIFFNESS[1]), STIFFNESS[0], STIFFNESS[1]


@kernel
def _slow(c: Case) -> Said:
    most = MOST_OMEGA * MOST_OMEGA
    return c.stiffness * (1 + 1 / c.kappa) <= most, most, 0.0


CONDITIONS = Conditions(
    Rule(_stiff, "a stiffness ratio from {a:g} to {b:g}", "stiffness_ratio"),
    Rule(_slow, "a stiffness ratio k and an inertia kappa with k (1 + 1/kappa) at most {a:g}", "stiffness_ratio"),
)

LAW = wall_law(
    CARD,
    stronge_contact,
    CONDITIONS,
    compliant_objections,
    COMPLIANT_READS,
    last="stiffness_ratio",
    needs=("restitution", "friction"),
    in_flight=True,
    # (fitted only on request, because its predictions are close to those of maw)
    fits=(
        FitSpec("planar", "two springs (Stronge)"),
        FitSpec("table", "two springs (Stronge), then the floor", on_request=True),
    ),
    line=("#E69F00", (0, (8, 2, 2, 2))),
    order=60,
)
