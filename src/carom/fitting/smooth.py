"""Parameters of a law as penalised B-splines of v_n, slip, slip/v_n or speed."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from carom.fitting.kernels import of_impact, speed_restitution
from carom.fitting.model import FitModel
from carom.fitting.parameters import ALONG_FORMS, PLACES, RESTITUTION_FORMS

__all__ = ["Smooth", "impact_variable", "parameter_at", "smooth_parameter", "spline_basis"]

Array = NDArray[np.float64]
SPLINES, ROWS_PER_SPLINE, DEGREE = 8, 6, 3


def impact_variable(name: str, x: Array, radius: float) -> Array:
    """Return v_n, slip, slip/v_n or speed (N,) of rebounds x (N, 3); of balls on a table the slip by sidespin along the wall."""
    slip = np.abs(x[:, 1] - radius * x[:, 2])
    found = {"v_n": x[:, 0], "slip": slip, "slip/v_n": slip / x[:, 0], "speed": np.hypot(x[:, 0], x[:, 1])}
    return np.asarray(found[name])


def parameter_at(parameter: str, model: FitModel, numbers: Array, x: Array) -> Array:
    """Return restitution, friction, tangential restitution or stiffness ratio (N,) at impacts x, by their forms."""
    p, a, along = (
        [float(numbers[i]) for i in PLACES[parameter]],
        model.problem.setting.radius,
        model.form // RESTITUTION_FORMS,
    )
    triple = (p[0], p[1], p[2])
    if parameter == "restitution":
        return np.array([speed_restitution(model.form % RESTITUTION_FORMS, triple, v) for v in x[:, 0].tolist()])
    code = along % ALONG_FORMS if parameter == "friction" else along // ALONG_FORMS
    balls = [((-v, u, 0.0), (0.0, 0.0, w)) for v, u, w in x.tolist()]
    return np.array([of_impact(code, triple, v, w, (1.0, 0.0, 0.0), a) for v, w in balls])


def spline_basis(s: Array, ends: tuple[float, float], count: int) -> Array:
    """Return B-splines (N, count) at s, which is held within its ends."""
    from scipy.interpolate import BSpline

    inner = np.linspace(*ends, count - DEGREE + 1)
    width = inner[1] - inner[0]
    knots = np.concatenate(
        [inner[0] - width * np.arange(DEGREE, 0, -1), inner, inner[-1] + width * np.arange(1, DEGREE + 1)]
    )
    return np.asarray(BSpline.design_matrix(np.clip(s, *ends), knots, DEGREE).toarray())


@dataclass(frozen=True)
class Smooth:
    """One parameter as a spline of one variable: its place in the record, the ends and number of splines, the penalty."""

    parameter: str
    variable: str
    ends: tuple[float, float]
    count: int
    width: float
    """Of the second differences of the coefficients, under the penalty."""

    @property
    def penalty(self) -> Array:
        """The precision (K, K) of the coefficients."""
        differences = np.diff(np.eye(self.count), 2, axis=0)
        return np.asarray(differences.T @ differences / self.width**2)


def smooth_parameter(fit: Any, parameter: str, variable: str, width: float) -> Smooth:
    """Return a spline of one parameter, with ends and number as the rows allow."""
    s = impact_variable(variable, fit.problem.x, fit.problem.setting.radius)
    count = int(np.clip(len(s) // ROWS_PER_SPLINE, DEGREE + 1, SPLINES))
    return Smooth(parameter, variable, (float(s.min()), float(s.max())), count, width)
