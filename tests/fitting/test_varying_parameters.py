"""Parameters that depend on the impact: forms are found again in tables of known truth, and gain nothing where there are none."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest

import carom
from carom.fitting.parameters import ALONG
from tests.reference.varying_bounces import RADIUS, drawn_table

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
