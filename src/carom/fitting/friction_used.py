"""Which contacts of a table slide, and the share of the friction that the others use, under a fitted law."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from carom.errors import CaromError
from carom.fitting.kernels import DIRECTION
from carom.fitting.parameters import INDEX
from carom.fitting.result import Fit

__all__ = ["SLIDES", "friction_used"]

SLIDES = 1 - 1e-6  # share of the friction from which a contact slides throughout


def friction_used(fit: Fit) -> NDArray[np.float64]:
    """Return the share of the friction that each contact uses under a law: 1 where it slides throughout.

    Parameters
    ----------
    fit : Fit
        To bounces in the plane.

    Returns
    -------
    (N,) impulse along the wall over friction times the normal impulse, both as the law predicts them; NaN where the law has no
    friction, 0 where its friction is infinite. A spin that was not measured is taken at the mean of its distribution.

    Raises
    ------
    CaromError
        For balls on a table, where part of the impulse along the wall is that of the floor, and for a friction that depends on the
        impact.

    Examples
    --------
    >>> from carom.data import make_rebounds
    >>> from carom.fitting import FITTED, Setting, fit_law, friction_used, make_problem
    >>> v = [1.0, 2.0, 3.0, 4.0]
    >>> columns = {"v_n_in": v, "v_t_in": [0.1, 0.2, 3.0, 4.0], "spin_in": [0.0] * 4, "v_n_out": [0.8, 1.6, 2.4, 3.2],
    ...            "v_t_out": [0.06, 0.12, 2.46, 3.28], "sigma_v_n_out": 0.02, "sigma_v_t_out": 0.02}
    >>> problem, _notes = make_problem(make_rebounds("planar", columns), Setting(radius=0.02, kappa=2 / 3))
    >>> sliding = next(law for law in FITTED if law.name == "sliding" and law.kind == "planar")
    >>> friction_used(fit_law(sliding, problem)).round(2).tolist()
    [0.22, 0.22, 1.0, 1.0]
    """
    if fit.law.kind != "planar" or fit.problem.setting.friction != "constant":
        got = "balls on a table" if fit.law.kind != "planar" else f"a friction {fit.problem.setting.friction}"
        raise CaromError(f"friction used: expected bounces in the plane and a constant friction, got {got}")
    x, after, mu = fit.problem.x, fit.predicted(), float(fit.numbers[INDEX["friction"]])
    if (
        stages := fit.problem.stages
    ) is not None:  # (where only directions were measured, v_t is in units of the speed)
        sine = np.where(stages == DIRECTION, after[:, 1], 0.0)
        after[:, 1] = np.where(stages == DIRECTION, after[:, 0] * sine / np.sqrt(1 - sine**2), after[:, 1])
    with np.errstate(divide="ignore", invalid="ignore"):
        share = np.abs(x[:, 1] - after[:, 1]) / (mu * (x[:, 0] + after[:, 0]))
    return np.minimum(share, 1.0) if mu > 0 else np.full(len(x), np.nan)
