"""Results of fits: estimates with their uncertainty, the fit of one law to rebounds, and numbers with error bars as text."""

from __future__ import annotations

import math
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from carom.bodies import Surface
from carom.core.jit.kernel import Vec, kernel
from carom.errors import CaromError, Fault
from carom.fitting.evidence import akaike
from carom.fitting.laws import (
    ALONG_FORMS,
    FORMS,
    INDEX,
    LEAST_STIFFNESS,
    NUMBERS,
    PLACES,
    RESTITUTION_FORMS,
    FittedLaw,
    of_impact,
)
from carom.fitting.likelihood import TabulatedLaw
from carom.fitting.model import STEPS, FitModel, model_of, predict_law, predictions_beside, prior_parameters
from carom.fitting.rows import Problem, forms_of
from carom.fitting.varying import Prediction, impacts, parameter_at, predictive_of
from carom.formatting import json_value
from carom.laws.law import CALLED_WALL, Card, Law
from carom.laws.registry import law_named
from carom.scene import Floor, Plane, Run, Scene, SceneBall, Table
from carom.scene.restitution import Constant
from carom.scene.toml import replaced

ON_SURFACE = {"restitution": 0.0, "friction": 0.0, "tangential_restitution": -1.0}  # with the least value of a surface
TABLE = (2.84, 1.42)  # m, of a scene for balls on a table: a carom table's


# ----------------------------------------------------------------------------------------------------
# Results of fits: estimates with their uncertainty, the fit of one law to rebounds, and numbers with error bars as text.


Array = NDArray[np.float64]


@dataclass(frozen=True)
class Estimate:
    """The estimate of one parameter.

    Examples
    --------
    >>> from carom.fitting import Estimate
    >>> Estimate(0.212, 0.006).value
    0.212
    """

    value: float | None
    """None if it is not identifiable from these data."""
    stderr: float | None
    """Standard error; None if it is not identifiable, or at a bound. From the curvature at the minimum, or from the 95 % interval
    if that was computed and is far wider."""
    note: str = ""
    interval_68: tuple[float, float] | None = None
    """By profile likelihood; an end at a bound is the bound."""
    interval_95: tuple[float, float] | None = None
    bootstrap: float | None = None
    """Standard error from resampled rows."""
    shared: float | None = None
    """Standard error from systematic errors common to all rows (:func:`carom.fitting.identify.with_shared`)."""


@dataclass(frozen=True, eq=False)
class Fit:
    """A law fitted to rebounds; made by :func:`fit_law`. ``aicc`` is infinite if there are too few measured numbers for it.

    Examples
    --------
    >>> from carom.data.rebounds import make_rebounds
    >>> from carom.fitting import FITTED, Setting, fit_law, make_problem
    >>> v = [1.0, 2.0, 3.0, 4.0]
    >>> columns = {"v_n_in": v, "v_t_in": v, "spin_in": [0.0] * 4, "v_n_out": [0.81, 1.59, 2.42, 3.18], "v_t_out": v,
    ...            "sigma_v_n_out": 0.02, "sigma_v_t_out": 0.02}
    >>> problem, _notes = make_problem(make_rebounds("planar", columns), Setting(radius=0.02))
    >>> fit = fit_law(FITTED[0], problem)
    >>> fit.names, fit.dof, fit.predicted().shape
    (('restitution',), 7, (4, 3))
    """

    law: FittedLaw
    problem: Problem
    names: tuple[str, ...]
    """Names of the free parameters."""
    estimates: dict[str, Estimate]
    numbers: Array
    """(K,) all parameters in the order of PARAMETERS, at the best place; then the shared errors, in their error bars."""
    deviance: float
    """-2 log likelihood, up to a constant that is the same for all laws."""
    chi2: float
    dof: int
    covariance: Array
    """(k, k) of the free parameters; NaN where they are not identifiable."""
    by_row: Array
    """(N,) chi^2 of each row; where the spin was not measured, at the most likely spin, whose distance from the mean of its prior,
    in widths, counts too."""
    degenerate: tuple[str, ...] = ()
    """Sentences on parameters that are not identifiable from these data."""
    untold: tuple[str, ...] = ()
    """The parameters concerned."""
    scatter: dict[str, float] = field(default_factory=dict)
    """Scatter of the outputs without error bars, or between ``contacts`` beyond the error bars."""
    contact_scatter: Estimate | None = None
    """The scatter between contacts, where it was fitted: a share of the speed before the wall, or m/s,"""
    determinants: float = 0.0
    """and what log det S has grown by with it, in all rows."""
    tabulated: TabulatedLaw | None = None
    """A table near the best place that stands in for a costly law in what is done with the fit (:func:`working_model`)."""
    edge: float | None = None
    """The friction at which one row would slide, where no more than that speaks for it."""

    @property
    def k(self) -> int:
        """Number of adjusted parameters, with the parameters of a mixture of spins."""
        return len(self.names) + len(self.scatter) + prior_parameters(self.law, self.problem)

    @property
    def aicc(self) -> float:
        """Akaike's criterion: chi^2 + 2 k where errors are known, which needs no correction for few data; where the scatter is
        estimated, that of Hurvich & Tsai (Biometrika 76, 297 (1989)). Infinite where there are too few data."""
        return akaike(self.deviance, self.k, self.problem.count, corrected=bool(self.scatter))

    @property
    def bic(self) -> float:
        """Schwarz's criterion."""
        return self.deviance + self.k * math.log(self.problem.count)

    @property
    def scatter_in_words(self) -> str:
        """The scatter between contacts with its unit; empty where it was not fitted."""
        if self.contact_scatter is None:
            return ""
        unit = " m/s" if self.problem.setting.scatter == "absolute" else " of the speed"
        return f"scatter {with_error_bar(self.contact_scatter)}{unit if self.contact_scatter.value else ''}"

    @property
    def restitution(self) -> float | dict[str, Any] | None:
        """The fitted restitution as a wall of a scene takes it: a number, or a form with its fields; None for a line."""
        name = self.problem.setting.restitution if "restitution" in self.law.free else "constant"
        form = FORMS[name]
        values = self.numbers[[INDEX[one] for one in ("restitution", "restitution_1", "restitution_2")]]
        return form.for_scene(name, values[: len(form.parameters)].tolist())

    @property
    def forms(self) -> dict[str, dict[str, Any]]:
        """Forms of the parameters along the wall that depend on the impact: by parameter, shape and variable with the numbers."""
        return {
            name: {"variable": form.variable, **form.table(form.shape, self.numbers[list(PLACES[name])].tolist())}
            for name, form in forms_of(self.law, self.problem.setting).items()
            if name != "restitution" and form.code
        }

    def predicted(self) -> Array:
        """Return the prediction (N, 3) for each row; rows without spin at the mean of its prior."""
        return predict_law(self.law, self.problem, self.numbers)

    def residuals(self) -> Array:
        """Return measured less predicted (N, 3), over error bars that hold those before the wall and the width of unmeasured spins.

        Errors before the wall go through central differences of the law over the size of each.
        """
        problem, p = self.problem, self.numbers
        mean, width = ((p[INDEX[name]] / problem.setting.radius) for name in ("spin_mean", "spin_width"))
        spins = np.where(problem.unknown, mean * problem.x[:, 1], problem.x[:, 2])
        filled = replace(problem, x=np.column_stack([problem.x[:, :2], spins]))
        size = np.sqrt(np.nan_to_num(problem.vx))
        size[problem.unknown, 2] = width * np.hypot(*filled.x[problem.unknown, :2].T)
        changes = [(up - down) / 2 for up, down in predictions_beside(self.law, filled, p, size)]
        total = np.nan_to_num(problem.vy + np.square(np.nan_to_num(changes)).sum(axis=0))
        return np.asarray((problem.y - self.predicted()) / np.sqrt(np.where(total > 0, total, 1.0)))

    def predict(self, before: Any) -> Prediction:
        """Return mean and covariance of the states after the wall, from the parameters' covariance and the fitted scatter.

        Parameters
        ----------
        before : State, mapping of columns, or array (N, 3)
            Balls that meet a wall with normal (1, 0, 0); or v_n_in, v_t_in (m/s) and spin_in (rad/s), for a ball on a table
            spin_z_in. Columns ``sigma_...`` are error bars of these, and of states measured after the wall.

        Returns
        -------
        Prediction
            Of v_n, v_t and spin; ``inside`` adds the error bars of measured states, where the scatter was not estimated.
        """
        return predictive_of(self).of_states(before)

    def to_surface(self, before: Any = None) -> Surface:
        """Return restitution, friction and tangential restitution as :func:`carom.impact` takes them.

        ``before``: impacts, as for :meth:`predict`, at which parameters that depend on the impact are taken. Default: the rows.
        """
        x = np.nan_to_num(self.problem.x) if before is None else impacts(self.problem, before)
        model, found = model_of(self.law, self.problem), dict[str, Any]()
        for name, least in ON_SURFACE.items():
            values = np.maximum(parameter_at(name, model, self.numbers, x), least)
            found[name] = float(values[0]) if (values == values[0]).all() else values
        return Surface(**found)

    def to_law(self) -> Law:
        """Return the law; with friction and its last number as functions of the impact, where these were fitted.

        A wall's restitution stays as the scene has it; what it has for the others is not read.
        """
        law, code = law_named(self.law.name), model_of(self.law, self.problem).form // RESTITUTION_FORMS
        if not code:
            return law
        if law.kernel is None or law.last not in PLACES:
            raise CaromError(
                Fault("", f"law {law.name}", "a law of one contact, whose parameters depend on the impact", "another")
            )
        first, base, stiff = code % ALONG_FORMS, law.kernel, law.last == "stiffness_ratio"
        last, least = code // ALONG_FORMS, LEAST_STIFFNESS if stiff else -1.0
        mu0, mu1, mu2 = (float(self.numbers[i]) for i in PLACES["friction"])
        p0, p1, p2 = (float(self.numbers[i]) for i in PLACES[law.last])
        most = 100.0 if stiff else 1.0

        @kernel
        def of_fit(
            v: Vec, w: Vec, n: Vec, a: float, kappa: float, e: float, _mu: float, _last: float
        ) -> tuple[Vec, Vec]:
            friction = max(of_impact(first, (mu0, mu1, mu2), v, w, n, a), 0 * a)
            along = min(max(of_impact(last, (p0, p1, p2), v, w, n, a), least + 0 * a), most + 0 * a)
            return base(v, w, n, a, kappa, e, friction, along)

        words = ", ".join(f"{name} {form['form']} in {form['variable']}" for name, form in self.forms.items())
        card = Card(
            f"{law.name}-fitted", f"{law.name} with {words}.", (), "The impacts of the fit.", "carom.fitting", "carom"
        )
        return replace(law, card=card, kernel=of_fit, response=CALLED_WALL, pinned={})

    def to_scene(self) -> Scene:
        """Return a scene with the ball and the fitted wall, at the median impact: :func:`carom.save_scene` writes it as TOML.

        Raises CaromError for a restitution that no scene has. Friction, tangential restitution and stiffness ratio that depend on
        the impact are in the scene's law (:meth:`to_law`), which a file cannot hold.
        """
        setting, law = self.problem.setting, self.law
        if self.restitution is None:
            raise CaromError(
                Fault("", "restitution", "a form that scenes have", "line", "fit polynomial or exponential instead")
            )
        a = setting.radius
        v_n, v_t, spin = (float(x) for x in np.nan_to_num(np.nanmedian(self.problem.x, axis=0)))
        wall: dict[str, Any] = {"restitution": self.restitution, "friction": float(self.numbers[INDEX["friction"]]),
                                "tangential_restitution": float(self.numbers[INDEX["tangential_restitution"]]),
                                "stiffness_ratio": float(self.numbers[INDEX["stiffness_ratio"]])}  # fmt: skip
        # (of a law that holds the restitution fixed in scenes, the fit is of the contact that it is a case of)
        name = "contact" if "restitution" in law_named(law.name).pinned else law.name
        run = Run(law=name if not self.forms else self.to_law(), duration=1.0)
        ball: dict[str, Any] = {"radius": a, "mass": 1.0, "inertia": setting.kappa}
        if law.kind == "planar":
            at = (a + 0.2 * v_n, 0.0, 0.0)
            one = SceneBall(position=at, velocity=(-v_n, v_t, 0.0), spin=(0.0, 0.0, spin), **ball)
            plane = Plane(point=(0.0, 0.0, 0.0), normal=(1.0, 0.0, 0.0), **wall)
            return Scene(gravity=(0.0, 0.0, 0.0), walls=(plane,), balls=(one,), run=run)
        height = setting.contact_height or 1.0
        nose = None if law.upright or height == 1 else height * a
        rolls = {"rolling": True, "spin_z": spin} if setting.roll == 1 else {"spin": (0.0, 0.0, spin)}
        one = SceneBall(position=(0.3 - TABLE[0] / 2, 0.0), velocity=(-v_n, v_t), **rolls, **ball)
        table = Table(length=TABLE[0], width=TABLE[1], center=(0.0, 0.0), nose_height=nose, **wall)
        mu = float(self.numbers[INDEX["floor_friction"]])
        run = replaced(run, {"law": law.engine.law, "floor_contact": law.engine.floor_contact}) if law.engine else run
        return Scene(
            floor=Floor(friction=mu, restitution=Constant(value=setting.floor_restitution)),
            walls=(table,),
            balls=(one,),
            run=run,
        )

    def as_dict(self) -> dict[str, Any]:
        """Return the fit for JSON."""
        found = common_dict(self)
        mixture = self.problem.mixture if prior_parameters(self.law, self.problem) else None
        if mixture is not None:
            for name in ("spin_mean", "spin_width"):
                found["parameters"][name] = {
                    "value": float(self.numbers[INDEX[name]]),
                    "stderr": None,
                    "note": "of a mixture",
                }
        return found | {
            "spin_mixture": None if mixture is None else {name: x.tolist() for name, x in mixture._asdict().items()},
            "bic": json_value(self.bic),
            "restitution": self.restitution,
            "forms": self.forms,
            "scatter": self.scatter,
            "contact_scatter": None if self.contact_scatter is None else estimate_dict(self.contact_scatter),
            "shared_errors": dict(
                zip((one.name for one in self.problem.shared), self.numbers[NUMBERS:].tolist(), strict=True)
            ),
        }


def scaled(fit: Any, name: str, by: float) -> Any:
    """Return a fit with one error bar scaled and correlations unchanged."""
    i, covariance = list(fit.names).index(name), fit.covariance.copy()
    covariance[i, :] *= by
    covariance[:, i] *= by
    wider = replace(fit.estimates[name], stderr=by * (fit.estimates[name].stderr or 0.0))
    return replace(fit, covariance=covariance, estimates=fit.estimates | {name: wider})


def without_estimate(fit: Any, name: str, estimate: Estimate, said: str) -> Any:
    """Return a fit in which one parameter is not identifiable: with an estimate without value, and the sentence that says so."""
    i, covariance = list(fit.names).index(name), fit.covariance.copy()
    covariance[i, :] = covariance[:, i] = math.nan
    known = {"covariance": covariance, "estimates": fit.estimates | {name: estimate}}
    return replace(fit, **known, degenerate=(*fit.degenerate, said), untold=(*fit.untold, name))


def working_model(fit: Fit, problem: Problem) -> FitModel:
    """Return the law prepared for rows, with the fit's table in its place where there is one: for differences of the deviance."""
    model, table = model_of(fit.law, problem), fit.tabulated
    return model.using(table) if table is not None and table.covers(problem) else model


def rows_of_fit(fit: Fit, problem: Problem, p: Array) -> tuple[Array, Array]:
    """Return deviance and chi^2 (N,) of each row of a problem under the fit's law with numbers p."""
    return model_of(fit.law, problem).row_deviances(p)


def refit(
    fit: Fit, problem: Problem, weights: Array | None = None, p: Array | None = None, *, hold: str = "", steps: int = STEPS,
    centers: Array | None = None,
) -> tuple[Array, Array]:  # fmt: skip
    """Fit the law, or its table, again to (weighted) rows, from p (B, K), with the parameter ``hold`` (if any) held fixed.

    Returns numbers (B, K) and deviances (B,). ``centers`` (B, S) of shared errors.
    """
    model = working_model(fit, problem)
    count = 1 if weights is None else len(weights)
    p = np.tile(fit.numbers, (count, 1)) if p is None else p
    found = (model.holding(hold) if hold else model).minimize(p, steps, weights, centers)
    return found.p, found.value


def estimate_dict(estimate: Estimate) -> dict[str, Any]:
    """Return an estimate for JSON."""
    found: dict[str, Any] = {"value": json_value(estimate.value), "stderr": json_value(estimate.stderr)}
    if estimate.interval_68 and estimate.interval_95:
        found |= {"interval_68": list(estimate.interval_68), "interval_95": list(estimate.interval_95)}
    if estimate.bootstrap is not None:
        found["bootstrap_stderr"] = json_value(estimate.bootstrap)
    if estimate.shared is not None:
        found["shared_stderr"] = json_value(estimate.shared)
    if estimate.note:
        found["note"] = estimate.note
    return found


def common_dict(fit: Any) -> dict[str, Any]:
    """Return for JSON what fits to rebounds and to whole tracks have in common."""
    return {
        "law": fit.law.name, "aicc": json_value(fit.aicc), "chi2": json_value(fit.chi2), "dof": fit.dof,
        "parameters": {name: estimate_dict(one) for name, one in fit.estimates.items()},
        "covariance": {"names": list(fit.names), "matrix": json_value(fit.covariance)},
    }  # fmt: skip


def with_error_bar(estimate: Estimate, *, interval: bool = False) -> str:
    """Return a value with its error bar as text, to two digits of the error; on request with its 95 % interval, if known."""
    if estimate.value is None:
        return f"? ({estimate.note})"
    if estimate.stderr is None or not 0 < estimate.stderr < math.inf:
        return f"{estimate.value:.4g} ({estimate.note or 'at its bound'})"
    places = max(0, 1 - math.floor(math.log10(estimate.stderr)))
    text = f"{estimate.value:.{places}f} ± {estimate.stderr:.{places}f}"
    if estimate.shared is not None:
        text += f" ± {estimate.shared:.{places}f}"
    if interval and estimate.interval_95:
        text += f" (95 %: {estimate.interval_95[0]:.{places}f} to {estimate.interval_95[1]:.{places}f})"
    return text
