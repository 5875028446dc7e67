"""Stronge's two springs as a law of a cushion: the nose yields along its surface, too; the vertical velocity is left out.

Stronge's contact (:mod:`carom.laws.stronge`; Impact Mechanics, 2000, chapter 5) at the height of the nose, as pooltool (model
stronge_compliant) and tailuge/billiards use it for cushions: to explain balls that come back across the table twice or three
times. Their parameter is the ratio of the frequencies of the springs, omega_t/omega_n = sqrt(k (1 + 1/kappa)): 1.7 in pooltool,
which is k = 0.826, and 1.76 in tailuge's program, k = 0.885, whose nose is at the height of the centre.

Both evaluate the three regimes that the book gives for e omega > 1 whatever e is: with e = 0 they divide by zero, and at a small
e they take sticking contacts for sliding ones, whose friction then drives the ball beyond rest: at e = 0.3 and mu = 0.55 they
gain 47 % of energy. Here every transition between stick and slip is followed, and no ball gains energy.
"""

from __future__ import annotations

from carom.core.jit.kernel import Vec, kernel
from carom.laws.cushion import cushion_law, nose_alone, stays_on_table
from carom.laws.law import COMPLIANT_READS, Card, FitSpec
from carom.laws.stronge import LAW as STRONGE
from carom.laws.stronge import stronge_contact

CARD = Card(
    name="stronge-cushion",
    summary="Stronge's springs at the nose of a cushion: part of the slip is returned; the ball stays on the table.",
    assumptions=(
        "one normal and one tangential spring at the height of the nose, with stiffness ratio k; Coulomb friction",
        "the normal spring unloads with 1/e^2 times its stiffness; the tangential one keeps its stiffness",
        "the table does not act during the impact; the vertical velocity after it is left out",
    ),
    valid="Cushions, for balls that come back across the table with running side. Numbers of pooltool, used where a scene gives"
    " none: e = 0.85, mu = 0.2, k = 0.824 (frequency ratio 1.7). The nose drives the ball into the table, and the table's answer is"
    " missing. It never gains energy, unlike the programs that it is from, which at e = 0.3 and mu = 0.55 gain 47 %.",
    equations="carom.laws.stronge",
    citation="W. J. Stronge, Impact Mechanics (Cambridge University Press, 2000), chapter 5; as a cushion in pooltool 0.6"
    " (E. Kiefl, D. McBlane) and tailuge/billiards.",
    doi="10.1017/CBO9780511626432",
)


@kernel
def stronge_cushion(v: Vec, w: Vec, n: Vec, a: float, kappa: float, e: float, mu: float, k: float) -> tuple[Vec, Vec]:
    """Velocity and spin after the cushion with tangential over normal stiffness k."""
    v1, w1 = stronge_contact(v, w, n, a, kappa, e, mu, k)
    return stays_on_table(v, v1, n), w1


LAW = cushion_law(
    CARD,
    stronge_cushion,
    lambda meeting: nose_alone(stronge_contact, meeting, meeting.stiffness_ratio),
    on_table="stronge",
    fit=FitSpec("table", "two springs at the nose (Stronge), then the table", on_request=True),
    conditions=STRONGE.conditions,
    reads=COMPLIANT_READS,
    last="stiffness_ratio",
    defaults={"restitution": 0.85, "friction": 0.2},
    line=("#999933", (0, (4, 1, 1, 1))),
    order=82,
)
