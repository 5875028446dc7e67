"""Share of the friction that contacts use: of bounces of which only the directions were measured, too."""

from __future__ import annotations

import numpy as np

from carom.data import make_rebounds
from carom.fitting import Setting, fit_law, friction_used, make_problem
from carom.fitting.laws import laws_named


def test_directions_alone_use_the_friction_of_the_law() -> None:
    """Angles of bounces with e = 0.8, mu = 0.2: those slide whose slip needs more, tan(angle) > 3.5 mu (1 + e) without spin."""
    angle = np.radians([10.0, 20.0, 30.0, 40.0, 50.0, 55.0, 60.0, 65.0])
    v_n, v_t, e, mu, kappa = np.cos(angle), np.sin(angle), 0.8, 0.2, 0.4
    needed = kappa / (1 + kappa) * v_t / (mu * (1 + e) * v_n)
    after = v_t - np.minimum(needed, 1.0) * mu * (1 + e) * v_n
    columns = {"v_n_in": v_n, "v_t_in": v_t, "spin_in": 0 * v_n, "v_t_out": after / np.hypot(after, e * v_n),
               "sigma_v_t_out": 0.002}  # fmt: skip
    rows = make_rebounds("planar", columns, extra={"unit_of_v_t_out": np.full(len(angle), "speed_out")})
    problem, _notes = make_problem(rows, Setting(radius=0.02, kappa=kappa))
    law = laws_named(["contact"], "planar", upright=True)[0][0]
    assert np.allclose(friction_used(fit_law(law, problem)), np.minimum(needed, 1.0), atol=0.02)
