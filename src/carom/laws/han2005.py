"""Han's law of a cushion: one rigid contact with friction at the nose; the vertical velocity is left out.

Han, J. Mech. Sci. Technol. 19, 976 (2005), (14) to (25), for any moment of inertia; his ball is solid, 1 + 1/kappa = 7/2. The
nose touches the ball at the angle theta_a above its centre, which the wall's normal contains.

The paper itself could not be had. These are its equations as restated by those who have it (the authors of pooltool, whose
code gives the numbers), checked here from first principles. Four places of the print are wrong or unclear, and are known from
their discussion (pooltool, issue 39 and pull request 247):

- (14c) and (21a) contradict (24a), which is right;
- the condition of sticking is printed without the friction, P_zS <= P_zE in place of P_zS <= mu P_zE: the nose would hold a
  ball with any friction, down to 0, as long as the required one is below 1, and the impulse jumps where sliding begins;
- the angle theta_0 of sliding is not explained. It is that of the slip. Programs that took it for the angle of the velocity
  push the ball in directions in which it does not slip, and can gain energy.

Han's own numbers for a carom table with balls of 65.5 mm and 230 g: e = 0.39 + 0.257 v - 0.044 v^2 (26), the form "han-2005"
of a scene, and mu = 0.471 - 0.241 theta (27), with theta in radians from the cushion's normal.
"""

from __future__ import annotations

import math

from carom.core.contact import LEAST, slip_velocity, struck_along
from carom.core.jit.kernel import Vec, dot, kernel
from carom.laws.cushion import cushion_law, nose_alone, stays_on_table
from carom.laws.law import ON_FLOOR, Card, FitSpec, contact_kernel

__all__ = ["CARD", "LAW", "han2005"]

CARD = Card(
    name="han2005",
    summary="Han's cushion: one rigid contact with friction at the nose; the ball stays on the table.",
    assumptions=(
        "one contact with restitution e and Coulomb friction mu, at the height of the nose; friction at most stops the slip",
        "the table does not act during the impact; the vertical velocity after it is left out",
        "misprints of the paper are corrected: sticking requires friction, and sliding is along the slip",
    ),
    valid="Carom and pool cushions, for comparison with programs that use it. The nose drives the ball into the table, and the"
    " table's answer is missing: without friction and with e = 1, a ball that comes at 45 degrees to a nose at 1.295 radii leaves"
    " at 50.4. It never gains energy. Han's numbers: e = 0.39 + 0.257 v - 0.044 v^2, mu = 0.471 - 0.241 theta (radians).",
    equations="(14)-(25)",
    citation="I. Han, Dynamics in carom and three cushion billiards, J. Mech. Sci. Technol. 19, 976-984 (2005).",
    doi="10.1007/BF02919180",
)


@kernel
def han2005(v: Vec, w: Vec, n: Vec, a: float, kappa: float, e: float, mu: float, beta: float) -> tuple[Vec, Vec]:
    """Velocity and spin after the cushion; beta is not read."""
    # (14): the slip s_0 at the nose, and the speed of approach c = -u_n
    un, s0 = slip_velocity(v, w, n, a)
    slip = math.sqrt(dot(s0, s0))
    # (16), mass 1: s changes by A, and c by B, per impulse along them; B = 1
    a_slip = 1 + 1 / kappa
    # (17): the normal impulse of the whole impact
    pz = -(1 + e) * un
    f = 0 * slip
    if slip > 0 and pz > LEAST * slip:
        # (18): P_E = s_0/A, which leaves no slip, if the friction suffices; (19): sliding, P_E = mu P_zE s_0/|s_0|
        f = -1 / a_slip if slip / a_slip <= mu * pz else -mu * pz / slip
    # (21)-(25)
    v1, w1 = struck_along(v, w, n, a, kappa, pz if pz > LEAST * slip else 0 * pz, f, s0)
    return stays_on_table(v, v1, n), w1


LAW = cushion_law(
    CARD,
    han2005,
    lambda meeting: nose_alone(contact_kernel, meeting, 0.0),
    on_table="sliding",
    fit=FitSpec("table", "Han's cushion, then the table", on_request=True),
    reads=("restitution", "friction", *ON_FLOOR),
    needs=("restitution", "friction"),
    line=("#7B3F00", (0, (6, 1.5))),
    order=80,
)
