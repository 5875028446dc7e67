"""Tangential compliance: the contact is elastic along the surface as well, and slip spreads from its edge inwards.

Maw, Barber & Fawcett, Wear 38, 101 (1976): an elastic sphere meets an elastic wall, with Hertz's pressure and Coulomb's
friction at every point of the contact. The result depends on two numbers only,

    psi = k u_t / (mu u_n),    chi = k (1 + 1/kappa) / 2,    k = 2 (1 - nu) / (2 - nu),

with u_t the slip of the ball as a rigid body, u_n the speed of approach, and k the tangential over the normal stiffness of
the contact (nu is Poisson's ratio of ball and wall, if the same). For psi < 1 the contact first sticks, and its tangential
compliance reverses the slip, to a smaller or larger value; for psi >= 4 chi - 1 it slides throughout.

The curve psi_after(psi, chi) is computed in advance (:func:`integrate_hertz_springs`), with a row of independent springs: Popov &
Hess, Method of Dimensionality Reduction in Contact Mechanics (2015), which reproduces Hertz's contact with friction as exactly
as the theory of Cattaneo and Mindlin does. A normal restitution below 1 enters through the mean speed, (1 + e)/2 u_n, so that the
impulse of sliding is mu (1 + e) m u_n, as required; this is a convention of carom, not of Maw et al.
"""

from __future__ import annotations

import math
from importlib import resources
from typing import Any

import numpy as np

from carom.core.contact import LEAST, slip_velocity, struck_along
from carom.core.jit.kernel import Vec, dot, kernel
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
    name="maw",
    summary="Elastic contact with tangential compliance: part of the slip is stored and reversed; slip begins at the edge.",
    assumptions=(
        "Hertz's contact of a sphere; friction by Coulomb's law at every point of it (Cattaneo, Mindlin)",
        "tangential and normal compliance are uncoupled: ball and wall of the same material, or one of them incompressible",
        "the impact is slow compared with sound in the ball; restitution below 1 only scales the normal speed",
    ),
    valid="Hard balls on hard walls at every angle, where no constant tangential restitution fits. For rubber, shells and"
    " blades the stiffness ratio has to be fitted (carom fit, laws maw and stronge); it is not 2 (1 - nu)/(2 - nu): with that"
    " default the tangential velocity of steel superballs has the wrong sign at small slip.",
    equations="carom.laws.maw",
    citation="N. Maw, J. R. Barber & J. N. Fawcett, The oblique impact of elastic spheres, Wear 38, 101-114 (1976).",
    doi="10.1016/0043-1648(76)90201-5",
)

CHI = (0.3, 6.0)  # range of the tabulated curve
# Numbers of steps of the table: psi from 0 to 1 and from 1 to 4 chi - 1, and chi, evenly spaced in its logarithm
STEPS, CHIS = 32, 31
_FIRST, _LOGS = math.log(CHI[0]), math.log(CHI[1] / CHI[0]) / (CHIS - 1)


def integrate_hertz_springs(psi: float, chi: float, springs: int = 300, times: int = 3000) -> float:
    """Return psi after the impact, by integration with ``springs`` springs over half the contact, in ``times`` steps.

    Units in which E* sqrt(R), the mass and u_n are 1: d'' = -4/3 d^(3/2), and a spring at x presses with d - x^2. While it
    sticks, a spring is stretched along the surface by the motion of the ball; its tangential force is limited by friction.
    """
    deepest = (15 / 16) ** 0.4  # 1/2 = (4/3)(2/5) d^(5/2)
    # spring n is at (n + 1/2) width, all with the same share of the contact; leapfrog for the ball's speed
    width = math.sqrt(deepest) / springs
    rim = ((np.arange(springs) + 0.5) * width) ** 2
    stretch = np.zeros(springs)
    step = 2.9432 * deepest / times  # Hertz: the contact lasts 2.943 d_max / u_n
    d, speed, slip = 0.0, 1.0, psi
    force = 0.0
    while d >= 0:
        speed -= 4 / 3 * d * math.sqrt(d) * step / 2
        slip -= 2 * chi * force * step / 2
        d += speed * step
        if d < 0:
            break
        stretch += slip * step
        pressed = np.maximum(d - rim, 0)
        np.clip(stretch, -pressed, pressed, out=stretch)
        force = 2 * width * float(stretch.sum())
        speed -= 4 / 3 * d * math.sqrt(d) * step / 2
        slip -= 2 * chi * force * step / 2
    return slip


def _load_curves() -> Any:
    """Load the table of psi after over psi before: (2, CHIS, STEPS + 1)."""
    path = resources.files("carom.laws").joinpath("maw_curve.csv")
    with path.open(encoding="utf-8") as file:
        return np.loadtxt(file, delimiter=",").reshape(2, CHIS, STEPS + 1)


_CURVE = _load_curves()


def compute_curve_table() -> Any:
    """Recompute the content of ``maw_curve.csv`` (takes a minute); for chi <= 0.5 there is no second part."""
    found = np.zeros((2, CHIS, STEPS + 1))
    for m in range(CHIS):
        chi = math.exp(_FIRST + m * _LOGS)
        for i in range(STEPS + 1):
            for part, psi in enumerate((max(i / STEPS, 0.01), 1 + i / STEPS * max(4 * chi - 2, 0))):
                found[part, m, i] = integrate_hertz_springs(psi, chi) / psi
    return found


@kernel
def _catmull_rom(p: float, q: float, r: float, s: float, t: float) -> float:
    """Catmull-Rom cubic from q (t = 0) to r (t = 1)."""
    return q + t / 2 * (r - p + t * (2 * p - 5 * q + 4 * r - s + t * (3 * (q - r) + s - p)))


@kernel
def _value_on_curve(part: int, row: int, place: float) -> float:
    """The curve of one chi at a place between 0 and STEPS."""
    i = min(int(place), STEPS - 1)
    q, r = _CURVE[part, row, i], _CURVE[part, row, i + 1]
    p = _CURVE[part, row, i - 1] if i > 0 else 2 * q - r
    s = _CURVE[part, row, i + 2] if i + 2 <= STEPS else 2 * r - q
    return _catmull_rom(p, q, r, s, place - i)


@kernel
def maw_slip_ratio(psi: float, chi: float) -> float:
    """Slip after over slip before the impact, with its sign: psi after over psi before; chi within :data:`CHI`."""
    if psi >= max(4 * chi - 1, 1.0):  # sliding throughout
        return 1 - 4 * chi / psi
    part = 0 if psi < 1 else 1
    place = STEPS * (psi if part == 0 else (psi - 1) / (4 * chi - 2))
    across = (math.log(chi) - _FIRST) / _LOGS
    m = max(0, min(int(across), CHIS - 2))
    q, r = _value_on_curve(part, m, place), _value_on_curve(part, m + 1, place)
    p = _value_on_curve(part, m - 1, place) if m > 0 else 2 * q - r
    s = _value_on_curve(part, m + 2, place) if m + 2 < CHIS else 2 * r - q
    # (no contact stores more slip than it was given: the table passes 1 by its own error, 2e-4)
    return max(-1.0, min(1.0, _catmull_rom(p, q, r, s, across - m)))


@kernel
def maw_contact(v: Vec, w: Vec, n: Vec, a: float, kappa: float, e: float, mu: float, k: float) -> tuple[Vec, Vec]:
    """Velocity and spin of a ball after a wall contact with tangential over normal stiffness k."""
    un, ut = slip_velocity(v, w, n, a)
    slip = math.sqrt(dot(ut, ut))
    pn = -(1 + e) * un
    most = mu * pn
    f = 0 * slip
    if slip > 0 and most > 0 and pn > LEAST * slip:
        chi = min(max(k * (1 + 1 / kappa) / 2, CHI[0]), CHI[1])
        k = 2 * chi / (1 + 1 / kappa)
        kept = maw_slip_ratio(2 * k * slip / most, chi) if most < math.inf else maw_slip_ratio(0 * k, chi)
        f = (kept - 1) * kappa / (1 + kappa)
        f = max(f, -most / slip)
    return struck_along(v, w, n, a, kappa, pn, f, ut)


@kernel
def _tabulated(c: Case) -> Said:
    share = (1 + 1 / c.kappa) / 2
    chi = c.stiffness * share
    return (chi >= CHI[0]) & (chi <= CHI[1]), CHI[0] / share, CHI[1] / share


TABULATED = "a stiffness ratio from {a:.3g} to {b:.3g}, for which the law is tabulated"

LAW = wall_law(
    CARD,
    maw_contact,
    Conditions(Rule(_tabulated, TABULATED, "stiffness_ratio")),
    compliant_objections,
    COMPLIANT_READS,
    last="stiffness_ratio",
    needs=("restitution", "friction"),
    in_flight=True,
    chi_range=CHI,
    fits=(
        FitSpec("planar", "tangential compliance (Maw et al.)"),
        FitSpec("table", "tangential compliance (Maw et al.), then the floor"),
    ),
    line=("#CC79A7", (0, (5, 1.5, 1, 1.5, 1, 1.5))),
    order=50,
)
