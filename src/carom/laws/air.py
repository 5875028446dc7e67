"""Laws of the air on a ball by name: coefficients of drag and lift, each with its card and source.

A law of a coefficient is a list of segments, each up to a Reynolds number (or a spin ratio), on which

    C = (p0 + p1 Re + p2 / Re + p3 / Re^2 + q S) / (1 + r S),    S = a |w| / |u|.
"""

from __future__ import annotations

import math
from typing import NamedTuple

from carom.laws.law import Card


class AirSegment(NamedTuple):
    """A law of a coefficient on a part of its range, up to ``high`` of the Reynolds number, or with ``over_spin`` of S."""

    p0: float = 0.0
    p1: float = 0.0
    p2: float = 0.0
    p3: float = 0.0
    q: float = 0.0
    r: float = 0.0
    high: float = math.inf
    over_spin: bool = False


class AirLaw(NamedTuple):
    """Drag and lift of a kind of ball by name; of one without lift there are no segments of that."""

    card: Card
    drag: tuple[AirSegment, ...]
    lift: tuple[AirSegment, ...] = ()


SATURATING = (AirSegment(q=1.0, r=2.0),)  # C_L = S/(1 + 2 S)

TENNIS = Card(
    name="tennis",
    summary="A tennis ball in air: C_D = 0.507, C_L = S/(1 + 2 S), S the ratio of the surface's speed to the ball's.",
    assumptions=(
        "drag does not depend on the speed, nor on the spin",
        "the spin keeps its axis, and fades by spin_decay alone",
    ),
    valid="New tennis balls in flight, some 15 to 30 m/s, S up to about 0.7. A worn or a wet ball has another drag.",
    equations="C_L = 1/(2 + v/(a w))",
    citation="R. Cross & C. Lindsey, Measurements of drag and lift on tennis balls in flight, Sports Eng. 17, 89 (2014)",
    doi="10.1007/s12283-013-0144-9",
)
TABLE_TENNIS = Card(
    name="table-tennis",
    summary="A table tennis ball in air: C_D = 0.54, C_L = S/(1 + 2 S), S the ratio of the surface's speed to the ball's.",
    assumptions=(
        "drag does not depend on the speed, nor on the spin",
        "the spin keeps its axis, and fades by spin_decay alone",
    ),
    valid="A ball of 40 mm at 3 to 10 m/s, S up to about 1.1: 107 filmed flights of 0.3 s are met to 4 mm. Where a smooth ball's"
    " lift is turned round, at S of about 0.1 and less near the drag crisis, it does not hold.",
    equations="C_D fitted to the flights; C_L of tennis balls",
    citation="Flights of T. Gossard, J. Tebbe, A. Ziegler & A. Zell, SpinDOE, arXiv 2303.03879 (2023); R. Cross & C. Lindsey,"
    " Sports Eng. 17, 89 (2014)",
    doi="10.48550/arXiv.2303.03879",
)
SMOOTH_SPHERE = Card(
    name="smooth-sphere",
    summary="Drag of a smooth sphere without spin: C_D = k1 + k2/Re + k3/Re^2, in eight ranges of the Reynolds number.",
    assumptions=("steady flow, a smooth sphere that does not spin", "no force across the way"),
    valid="Reynolds numbers up to 5e4; beyond the drag crisis, at some 2e5, the drag is a fifth of what the law has.",
    equations="table 1",
    citation="S. A. Morsi & A. J. Alexander, An investigation of particle trajectories in two-phase flow systems, J. Fluid Mech."
    " 55, 193 (1972)",
    doi="10.1017/S0022112072001806",
)
# k1, k2, k3, up to which Reynolds number
_MORSI_ALEXANDER = (
    (0.0, 24.0, 0.0, 0.1), (3.69, 22.73, 0.0903, 1.0), (1.222, 29.1667, -3.8889, 10.0), (0.6167, 46.5, -116.67, 100.0),
    (0.3644, 98.33, -2778.0, 1e3), (0.357, 148.62, -4.75e4, 5e3), (0.46, -490.546, 57.87e4, 1e4),
    (0.5191, -1662.5, 5.4167e6, math.inf),
)  # fmt: skip
AIR_LAWS = {
    law.card.name: law
    for law in (
        AirLaw(TABLE_TENNIS, (AirSegment(0.54),), SATURATING),
        AirLaw(TENNIS, (AirSegment(0.507),), SATURATING),
        AirLaw(SMOOTH_SPHERE, tuple(AirSegment(k1, 0.0, k2, k3, high=up) for k1, k2, k3, up in _MORSI_ALEXANDER)),
    )
}
