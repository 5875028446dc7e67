"""Han's law of a cushion: one rigid contact with friction at the nose; the vertical velocity is left out.

Han, J. Mech. Sci. Technol. 19, 976 (2005), (14) to (25), for any moment of inertia; his ball is solid, 1 + 1/kappa = 7/2. The
nose touches the ball at the angle theta_a above its centre, which the wall's normal contains.

The paper itself could not be had. These are its equations as restated by those who have it (the authors of pooltool, whose
code gives the numbers), checked here from first principles. Four places of the print are wrong or unclear, and are known from
their discussion (pooltool, issue 39 and pull request 247):

- (14c) and (21a) contradict (24a), which is right;
- the condition of sticking is printed without the friction, P_zS <= P_zE in place of P_zS <= mu P_zE: the nose would hold a
  ball with any friction, down to 0, as long as the required one is below 1, and the impulse jumps where sliding begins;
- the angle theta_0 of sliding is not explained. It is the angle of the slip. Programs that took it for the angle of the velocity
  push the ball in directions in which it does not slip, and can gain energy.

Han's own numbers for a carom table with balls of 65.5 mm and 230 g: e = 0.39 + 0.257 v - 0.044 v^2 (26), the form "han-2005"
of a scene, and mu = 0.471 - 0.241 theta (27), with theta in radians from the cushion's normal.
"""

from __future__ import annotations

from carom.core.jit.kernel import Vec, kernel
from carom.laws.cushion import cushion_law, nose_alone, stays_on_table
from carom.laws.law import ON_FLOOR, Card, FitSpec, contact_kernel

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
    # Han (14)-(25) are one contact whose friction stops the slip at most, beta = 0: (14) slip s_0 and speed of approach c = -u_n;
    # Han (17) P_z = (1 + e) c; (18) P_E = s_0/A, A = 1 + 1/kappa, if the friction suffices, else (19) P_E = mu P_zE s_0/|s_0|
    v1, w1 = contact_kernel(v, w, n, a, kappa, e, mu, 0 * beta)
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
