"""Predictive distributions: covariances and regions in tables of known truth, and fits that go back into scenes."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from reference.varying_bounces import RADIUS, bounce, drawn_table

import carom
from carom.data.rebounds import make_rebounds
from carom.fitting import FITTED, Prediction, Setting, fit_law, make_problem
from carom.fitting.varying import impacts, predictive_of

TRUTH: dict[str, Any] = {"e": lambda v: 0.7 + 0 * v, "mu": lambda s: 0.3 + 0 * s, "beta": lambda s: 0.3 + 0 * s}
OPTIONS: dict[str, Any] = {"radius": RADIUS, "inertia": "hollow", "bootstrap": 0, "profiles": False}

SETTING = Setting(radius=RADIUS, kappa=2 / 3)
CONTACT = next(law for law in FITTED if (law.name, law.kind) == ("contact", "planar"))


@pytest.mark.parametrize("bars", [True, False])
@pytest.mark.parametrize("rows", [12, 40, 150])
@pytest.mark.slow(keep=2)
def test_regions_hold_their_share_of_rows_that_were_not_fitted(rows: int, bars: bool) -> None:
    tables = 14
    inside = np.zeros((tables, 2))
    for seed in range(tables):
        seen, problem = (
            make_problem(make_rebounds("planar", drawn_table(n, draw, sigma=0.1, bars=bars, **TRUTH)), SETTING)[0]
            for n, draw in ((rows, seed), (200, 1000 + seed))
        )
        fit = fit_law(CONTACT, seen)
        said = predictive_of(fit).of_rows(problem)
        inside[seed] = [said.inside(problem.y, share).mean() for share in (0.68, 0.95)]
        # (with the error bars of the table, of the rows, and of columns beside the states)
        beside = dict(zip(("v_n_in", "v_t_in", "spin_in"), problem.x.T, strict=True))
        bars = {"sigma_v_n_out": 0.1, "sigma_v_t_out": 0.1, "sigma_spin_out": 0.1 / RADIUS} if bars else {}
        for before in (problem.x, problem.rebounds, beside | bars):
            assert fit.predict(before).inside(problem.y, 0.68).tolist() == said.inside(problem.y, 0.68).tolist()
    # (rows of one table share its fit: the counting error is that of tables)
    error = inside.std(axis=0, ddof=1) / np.sqrt(tables)
    assert np.all(np.abs(inside.mean(axis=0) - (0.68, 0.95)) < 3 * error + (0.03, 0.012)), (inside.mean(axis=0), error)


def test_a_prediction_is_the_mean_and_its_error() -> None:
    fit = carom.fit(drawn_table(100, 1, sigma=0.05, **TRUTH), laws=["contact"], **OPTIONS)
    state = carom.State(velocity=(-6.0, 1.0, 0.0), spin=(0.0, 0.0, -200.0))
    said = fit.predict(state)
    expected = bounce(6.0, 1.0, -200.0, 0.7, 0.3, 0.3)
    assert said.mean.shape == (1, 3)
    assert said.covariance.shape == (1, 3, 3)
    assert np.all(np.abs(said.mean[0] - expected) < 4 * said.stderr[0])
    assert np.all(said.stderr[0] < (0.02, 0.03, 3.0))
    again = fit.predict({"v_n_in": [6.0], "v_t_in": [1.0], "spin_in": [-200.0]})
    assert np.array_equal(again.mean, said.mean)
    with pytest.raises(carom.CaromError, match="expected columns v_n_in, v_t_in, spin_in"):
        fit.predict({"v_n_in": [6.0]})


def test_an_estimated_scatter_is_in_the_covariance() -> None:
    fit = carom.fit(drawn_table(200, 4, sigma=0.1, bars=False, **TRUTH), laws=["contact"], **OPTIONS)
    assert np.allclose(fit.predict([[6.0, 1.0, -200.0]]).stderr, (0.1, 0.1, 0.1 / RADIUS), rtol=0.15)


def test_regions_of_a_prediction_by_hand() -> None:
    one = Prediction(np.zeros((1, 3)), 0.01 * np.eye(3)[None])
    # the root of chi^2 with 3 degrees of freedom at 0.68 is 1.872
    assert one.inside(np.array([[0.187, 0.0, 0.0]]), 0.68)[0]
    assert not one.inside(np.array([[0.188, 0.0, 0.0]]), 0.68)[0]


def test_what_has_no_error_bar_is_not_compared() -> None:
    columns = drawn_table(12, 1, sigma=0.1, **TRUTH)
    del columns["spin_out"], columns["sigma_spin_out"]
    fit = fit_law(CONTACT, make_problem(make_rebounds("planar", columns), SETTING)[0])
    with pytest.raises(carom.CaromError, match="expected an error bar of the spin after, got none"):
        fit.predict([[6.0, 1.0, -20.0]]).inside([[4.0, 0.9, 0.0]], 0.95)
    assert fit.predict([[6.0, 1.0, -20.0]]).inside([[4.2, 1.0, np.nan]], 0.95).shape == (1,)
    before = {"v_n_in": 6.0, "v_t_in": 1.0, "spin_in": -20.0, "sigma_v_n_in": 0.5, "sigma_spin_out": 9.0}
    said = fit.predict(before)
    assert said.stderr[0, 0] == pytest.approx(0.5 * fit.numbers[0], rel=0.1)
    assert said.inside(said.mean, 0.1).all()


def test_every_law_goes_back_into_a_scene(tmp_path: Path) -> None:
    for fit in (one.fit for one in carom.fit(drawn_table(60, 1, **TRUTH), **OPTIONS).ranked):
        scene = carom.load_scene(carom.save_scene(fit.to_scene(), tmp_path / "scene.toml"))
        last = carom.simulate(scene).final
        said = fit.predict(np.nanmedian(fit.problem.x, axis=0)).mean[0]
        assert np.allclose([*last.velocity[0, :2], last.spin[0, 2]], said, rtol=1e-9, atol=1e-9), fit.law.name


@pytest.mark.slow
def test_fitted_forms_go_back_into_a_scene() -> None:
    truth = TRUTH | {"e": lambda v: 0.6 + 0.3 * np.exp(-v / 3), "mu": lambda s: 0.15 + 0.02 * s}
    options = OPTIONS | {"restitution": "exponential", "friction": "linear", "laws": ["contact"]}
    fit = carom.fit(drawn_table(120, 1, **truth), **options).best
    last = carom.simulate(fit.to_scene()).final
    assert np.allclose(last.velocity[0, 0], fit.predict(np.nanmedian(fit.problem.x, axis=0)).mean[0, 0], rtol=1e-9)
    surface = fit.to_surface(np.array([[4.0, 0.0, 300.0], [8.0, 0.0, 50.0]]))
    assert np.allclose(surface.restitution, truth["e"](np.array([4.0, 8.0])), atol=0.03)
    assert np.allclose(surface.friction, truth["mu"](np.array([6.0, 1.0])), atol=0.03)
    with pytest.raises(carom.CaromError, match="a form that scenes have, got line"):
        carom.fit(drawn_table(60, 1, **truth), **OPTIONS | {"laws": ["contact"]}, restitution="line").to_scene()


@pytest.mark.parametrize("state", [(2.0, 1.0), "a", None])
def test_a_state_that_is_none_is_refused(state: Any) -> None:
    problem = make_problem(make_rebounds("planar", drawn_table(12, 1, sigma=0.1, bars=True, **TRUTH)), SETTING)[0]
    with pytest.raises(carom.CaromError, match="predict: state: expected v_n_in, v_t_in, spin_in, or an array"):
        impacts(problem, state)
    with pytest.raises(carom.CaromError, match="state: expected finite numbers, got spin_in nan in row 2"):
        impacts(problem, [(1, 2, 3), (1, 2, np.nan)])
