"""Mathavan's law of a cushion: slip with friction at the nose and at the table at once, and energetic restitution.

Mathavan, Jackson & Parkin, Proc. IMechE C 224, 1863 (2010). During the impact the velocities change with the impulse P_I of
the nose by (14) and (17), in which the table presses with dP_C = (sin theta + mu_w sin phi cos theta) dP_I; phi and phi' are the
directions of the slips (12) at the nose and (13) at the table, and a contact that does not slip rubs as much as keeps it so
(15). Compression ends with the approach; restitution ends when the nose has returned e_e^2 of its work (16).

The paper steps P_I. Here the same equations are followed from event to event with an error of 1e-10
(:mod:`carom.laws.wall_and_floor.rates` has them for any moment of inertia): its u is (12), its f is (13), its rates are (14)
and (17), its push dP_C/dP_I, its modes (15), its stored energy (16).

Where the friction of the nose would lift the ball, mu_w sin phi < -tan theta, the printed dP_C is negative: the table would
pull, and its friction would drive the ball, which can gain energy. Here the table then does nothing, and the vertical velocity
is left out; with the authors' numbers it does not occur.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from carom.bodies import Surface
from carom.core.jit.kernel import Vec, kernel
from carom.laws.cushion import Struck, cushion_law, nose_alone, stays_on_table
from carom.laws.law import ON_FLOOR, Card, FitSpec, Meeting
from carom.laws.two_step import answer_two_step, first_impact

CARD = Card(
    name="mathavan2010",
    summary="Mathavan's cushion: friction at nose and table at once, energetic restitution; the ball stays on the table.",
    assumptions=(
        "the nose does not deform: one direction of its normal impulse throughout",
        "Coulomb friction at the nose and at the table, with transitions between stick and slip",
        "the nose returns e^2 of the work done on it (Stronge); the table is rigid and keeps the ball down",
    ),
    valid="Snooker and pool cushions at normal speeds up to 2.5 m/s, where they do not yet deform much. Authors' numbers, used"
    " where a scene gives none: e = 0.98, mu = 0.14 at the nose (at 7/5 of the radius), 0.212 at the table. At hard shots a"
    " constant e is too large. A ball that the friction of the nose would lift stays on the table, without the table's friction:"
    " the printed equations let the table pull there, and can gain energy.",
    equations="(12)-(17)",
    citation="S. Mathavan, M. R. Jackson & R. M. Parkin, A theoretical analysis of billiard ball dynamics under cushion impacts,"
    " Proc. IMechE C 224, 1863-1873 (2010).",
    doi="10.1243/09544062JMES1964",
)


@kernel
def mathavan2010(v: Vec, w: Vec, n: Vec, a: float, kappa: float, e: float, muw: float, mus: float) -> tuple[Vec, Vec]:
    """Velocity and spin after the cushion, with frictions muw at the nose and mus at the table."""
    zero = 0 * a
    v1, w1, _j, _jf, _required, _regime = first_impact(
        v, w, n, a, kappa, e, muw, zero, zero, mus, zero, zero, v[2] == 0
    )
    return stays_on_table(v, v1, n), w1


def _struck(meeting: Meeting) -> Struck:
    """Nose and table at once (one in flight: the nose alone), as the two-step law has them."""
    m = meeting
    if m.ball.planar:
        return nose_alone(mathavan2010, m, m.floor.friction)
    wall, floor = Surface(m.wall.restitution, m.wall.friction), Surface(0.0, m.floor.friction)
    above = np.where(m.state.velocity[..., 2] == 0, 0.0, m.ball.radius)  # (any height, for one in flight)
    height = above if above.ndim else float(above)
    found = answer_two_step(replace(m, wall=wall, floor=floor, height=height, floor_contact="with"))
    lifted = found.after_wall.velocity[..., 2] > 0  # (what its landing would require is not asked)
    return Struck(found.after_wall, found.required_wall, np.where(lifted, 0.0, found.required_floor))


LAW = cushion_law(
    CARD,
    mathavan2010,
    _struck,
    on_table="two-step",
    # (the two differ in the vertical velocity alone)
    fit=FitSpec("table", same_as="two-step"),
    reads=("restitution", "friction", *ON_FLOOR),
    last="floor_friction",
    defaults={"restitution": 0.98, "friction": 0.14, "floor_friction": 0.212},
    line=("#332288", (0, (1, 1))),
    order=81,
)
