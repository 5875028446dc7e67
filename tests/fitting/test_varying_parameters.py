"""Parameters that depend on the impact: forms are found again in tables of known truth, and gain nothing where there are none."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest
from reference.exploring import tried
from reference.varying_bounces import RADIUS, bounce, drawn_table

import carom
from carom.fitting.forms import choose_forms
from carom.fitting.laws import ALONG, INDEX
from carom.fitting.varying import Noise, fit_varying, smooth_parameter

CONSTANT = {"e": lambda v: 0.7 + 0 * v, "mu": lambda s: 0.5 + 0 * s, "beta": lambda s: 0.3 + 0 * s}


def fitted(columns: dict[str, Any], **options: Any) -> Any:
    return carom.fit(columns, RADIUS, inertia="hollow", laws=["contact"], bootstrap=0, profiles=False, **options).best


@pytest.mark.parametrize(
    ("truth", "options", "expected"),
    [
        ({"beta": lambda s: 0.6 - 0.3 * s}, {"tangential_restitution": "linear"},
         {"tangential_restitution_0": 0.6, "tangential_restitution_1": -0.3}),
        ({"mu": lambda s: 0.15 + 0.01 * s}, {"friction": "linear"}, {"friction_0": 0.15, "friction_1": 0.01}),
        ({"mu": lambda s: 0.12 + 0.2 * np.exp(-s / 1.5)}, {"friction": "exponential:slip"},
         {"friction_at_rest": 0.32, "friction_at_speed": 0.12, "friction_speed": 1.5}),
        ({"e": lambda v: 0.6 + 0.3 * np.exp(-v / 3), "beta": lambda s: 0.6 - 0.3 * s},
         {"restitution": "exponential", "tangential_restitution": "linear"},
         {"restitution_at_rest": 0.9, "restitution_at_speed": 0.6, "restitution_speed": 3.0, "tangential_restitution_1": -0.3}),
    ],
)  # fmt: skip
def test_forms_are_found_again(truth: dict[str, Any], options: dict[str, str], expected: dict[str, float]) -> None:
    columns = drawn_table(300, 3, **(CONSTANT | truth))
    found, plain = fitted(columns, **options), fitted(columns)
    for name, value in expected.items():
        one = found.estimates[name]
        assert abs(one.value - value) < 3.5 * one.stderr, name
    assert found.aicc < plain.aicc - 20
    assert abs(found.chi2 - found.dof) < 4 * math.sqrt(2 * found.dof)


def test_a_form_gains_nothing_where_the_parameter_is_constant() -> None:
    columns = drawn_table(200, 5, **CONSTANT)
    plain = fitted(columns)
    for parameter, form in (
        ("friction", "linear"),
        ("tangential_restitution", "linear:speed"),
        ("restitution", "line"),
    ):
        found = fitted(columns, **{parameter: form})
        # (the form contains the constant, and costs one parameter)
        assert -0.01 < plain.aicc - found.aicc + 2 < 9, parameter


def test_a_fitted_form_is_told_with_its_numbers() -> None:
    found = fitted(drawn_table(60, 2, **CONSTANT), tangential_restitution="linear", restitution="exponential")
    first, second = found.forms["tangential_restitution"]["coefficients"]
    assert found.estimates["tangential_restitution_0"].value == first
    assert abs(second) < 0.2
    assert found.forms["tangential_restitution"]["variable"] == "slip/v_n"
    wall = carom.scene.Plane(point=(0, 0, 0), normal=(1, 0, 0), restitution=found.restitution, friction=0.5)
    assert wall.restitution.at(5.0) == pytest.approx(0.7, abs=0.03)


def test_every_form_begins_at_a_constant() -> None:
    for parameter, forms in ALONG.items():
        for form in forms.values():
            places = form.like(0.4, 5.0)
            assert places[:2] in ((0.4, 0.0), (0.4, 0.4)), parameter


@pytest.mark.parametrize(
    "options", [{"friction": "linar"}, {"tangential_restitution": "linear:angle"}, {"stiffness_ratio": "polynomial"}]
)
def test_an_unknown_form_is_refused(options: dict[str, str]) -> None:
    with pytest.raises(carom.CaromError, match="expected one of constant"):
        fitted(drawn_table(20, 1, **CONSTANT), **options)


def choice_of(columns: dict[str, Any], **options: Any) -> Any:
    return choose_forms(fitted(columns, **options), ("friction", "tangential_restitution"), noise=False)


def test_a_spline_follows_what_no_form_has() -> None:
    def wave(s: Any) -> Any:
        return 0.3 + 0.25 * np.sin(3 * s)

    base = fitted(drawn_table(400, 7, **(CONSTANT | {"beta": wave, "mu": lambda s: 5 + 0 * s})))
    fit = fit_varying(base, (smooth_parameter(base, "tangential_restitution", "slip/v_n", 0.06),))
    s = np.linspace(0.1, 1.2, 9)
    x = np.stack([0 * s + 6, 0 * s, -6 * s / RADIUS], axis=-1)
    beta = fit.model.records(fit.q[None], x)[0][:, INDEX["tangential_restitution"]]
    assert np.allclose(beta, wave(s), atol=0.06)
    assert fit.aicc < base.aicc - 100
    assert 4 < fit.k - 2 < 8.5  # of eight coefficients


@pytest.mark.slow
def test_held_out_rows_choose_the_parameter_that_depends_on_the_impact() -> None:
    found = choice_of(
        drawn_table(tried(60, 80), 3, **(CONSTANT | {"beta": lambda s: 0.6 - 0.3 * s}), sigma=0.1, bars=False)
    )
    assert found.tried[found.chosen[1]].words.startswith("tangential restitution")
    assert found.best.gain > found.best.gain_error
    said = found.predict([[6.0, 1.0, -200.0]])
    expected = bounce(6.0, 1.0, -200.0, 0.7, 0.5, 0.6 - 0.3 * 5 / 6)
    assert np.all(np.abs(said.mean[0] - expected) < 4 * said.stderr[0])


@pytest.mark.slow
def test_held_out_rows_choose_constants_where_nothing_depends_on_the_impact() -> None:
    found = choice_of(drawn_table(40, 1, **CONSTANT))
    assert found.chosen == (0,)
    assert found.sentence.startswith("contact: constants predict held-out rows best")


@pytest.mark.parametrize(("noise", "expected"), [("student", "student"), ("laplace", "two-sided")])
def test_heavy_tails_are_found(noise: str, expected: str) -> None:
    columns = drawn_table(400, 11, **CONSTANT, sigma=0.1, bars=False, noise=noise)
    base = fitted(columns)
    scores = {errors: fit_varying(base, (), Noise(errors)).aicc for errors in ("normal", "student", "two-sided")}
    assert scores[expected] < scores["normal"] - 20


def test_scatter_that_grows_with_the_speed_is_found() -> None:
    base = fitted(drawn_table(300, 12, **CONSTANT, sigma=0.1, bars=False, noise="grows"))
    fit = fit_varying(base, (), Noise(grows=True))
    power = fit.q[fit.model.parts["power"]][0]
    assert abs(power - 1.5) < 0.4
    assert fit.aicc < base.aicc - 20


def test_constants_have_the_deviance_of_the_compiled_likelihood() -> None:
    for bars in (True, False):
        base = fitted(drawn_table(60, 4, **CONSTANT, bars=bars))
        assert fit_varying(base).aicc == pytest.approx(base.aicc, abs=1e-4)


@pytest.mark.parametrize("errors", ["student", "two-sided"])
def test_densities_of_errors_have_the_integral_one(errors: str) -> None:
    r = np.linspace(-60, 60, 400_001)
    rho = Noise(errors).rho(r * r, r, np.ones(len(r), int), np.array([0.7]))[0]
    assert np.trapezoid(np.exp(-rho / 2) / math.sqrt(2 * math.pi), r) == pytest.approx(1.0, abs=0.02)


def test_forms_of_rows_without_spins_are_not_tried_and_a_note_says_so() -> None:
    columns = drawn_table(12, 4, **CONSTANT)
    columns["spin_in"] = np.full(12, np.nan)
    options: dict[str, Any] = {"inertia": "hollow", "laws": ["sticking"], "bootstrap": 0, "profiles": False}
    found = carom.fit(columns, RADIUS, forms=True, **options)
    assert not found.forms
    assert any(note.startswith("`forms`: spins before the wall were not measured") for note in found.notes)


def test_a_number_is_held_and_a_form_is_fitted() -> None:
    """One name, one meaning in all verbs: a parameter is a number, or the form in which it depends on the impact."""
    columns = drawn_table(60, 2, **CONSTANT)
    held, fixed = (
        fitted(columns, restitution="0,7", friction=0.3),
        fitted(columns, fix={"restitution": 0.7, "friction": 0.3}),
    )
    assert held.estimates == fixed.estimates
    assert {"restitution", "friction"}.isdisjoint(held.names)
    with pytest.raises(carom.CaromError, match="`restitution`: expected a form beside `fix` or `bound`"):
        fitted(columns, restitution=0.7, fix={"restitution": 0.8})
