"""Verdicts that do not rest on the shape of a prior, a number at its bound, a few bad rows or walls that differ."""

from __future__ import annotations

import numpy as np
import pytest
from reference.synthetic_bounces import SETTING, A, measured_bounces
from reference.written_tables import KAPPA, RADIUS, bounces, contact
from scipy.optimize import brentq, minimize_scalar
from scipy.stats import t as student

from carom.data import make_rebounds
from carom.fitting import Setting, fit_law, fit_laws, make_problem, with_profiles
from carom.fitting.forms import _Joint, with_mixtures
from carom.fitting.laws import laws_named
from carom.fitting.likelihood import SpinMixture
from carom.fitting.model import form_starts, model_of
from carom.fitting.ranking import _variances
from carom.fitting.rows import usable_rows

BALL = Setting(RADIUS, KAPPA)


def law(name: str, kind="planar"):
    return laws_named([name], kind, True)[0][0]


def two_kinds_of_spins(seed: int, rows: int):
    """Bounces without measured spins: most run with running side, the others without a preferred one."""
    rng = np.random.default_rng(seed)
    v_n, v_t = rng.uniform(1, 5, rows), rng.uniform(-4, 4, rows)
    speed = np.hypot(v_n, v_t)
    running = rng.random(rows) < 0.6
    spin = (
        np.where(running, 0.95 * v_t + 0.05 * speed * rng.normal(size=rows), 0.8 * speed * rng.normal(size=rows))
        / RADIUS
    )
    w_n, w_t, _w = contact(v_n, v_t, spin, 0.8, 0.2, 0.0)
    columns = {
        "v_n_in": v_n,
        "v_t_in": v_t,
        "spin_in": np.full(rows, np.nan),
        "sigma_v_n_out": 0.02,
        "sigma_v_t_out": 0.02,
    }
    return columns | {"v_n_out": w_n + 0.02 * rng.normal(size=rows), "v_t_out": w_t + 0.02 * rng.normal(size=rows)}


def test_a_mixture_of_equal_components_is_the_normal_prior_and_its_scores_are_differences():
    problem, _notes = make_problem(make_rebounds("planar", two_kinds_of_spins(1, 40)), BALL)
    fit = fit_law(law("sliding"), problem)
    model = model_of(fit.law, problem)
    joint = _Joint(model, fit.numbers, 2)
    mean, width = (float(fit.numbers[i]) for i in (model.places["spin_mean"], model.places["spin_width"]))
    q = joint.packed(fit.numbers, SpinMixture(np.array([0.3, 0.7]), np.array([mean, mean]), np.array([width, width])))
    assert joint(q[None])[0][0] == pytest.approx(fit.deviance, abs=1e-6)
    q = joint.packed(fit.numbers, SpinMixture(np.array([0.3, 0.7]), np.array([0.9, 0.1]), np.array([0.2, 0.7])))
    score = joint(q[None])[1][0]
    for i in range(1, len(q)):
        step = np.zeros(len(q))
        step[i] = 1e-4
        slope = -(joint((q + step)[None])[0][0] - joint((q - step)[None])[0][0]) / 4e-4
        assert score[i] == pytest.approx(slope, rel=0.03, abs=0.3)


def test_spins_of_two_kinds_are_found_with_the_law():
    problem, _notes = make_problem(make_rebounds("planar", two_kinds_of_spins(2, 120)), BALL)
    plain = fit_law(law("sliding"), problem)
    mixed = with_mixtures([plain], problem)[0]
    assert mixed.aicc < plain.aicc - 30
    mixture = mixed.problem.mixture
    narrow = int(np.argmin(mixture.width))
    assert mixture.share[narrow] == pytest.approx(0.6, abs=0.15)
    assert mixture.mean[narrow] == pytest.approx(0.95, abs=0.1)
    for name, true in (("restitution", 0.8), ("friction", 0.2)):
        one = mixed.estimates[name]
        assert abs(one.value - true) < 3.5 * one.stderr
    assert mixed.k == 2 + mixture.parameters


def test_the_ranking_says_that_spins_are_not_normal():
    columns = two_kinds_of_spins(3, 90)
    ranking = fit_laws(make_rebounds("planar", columns), BALL, ["sliding", "no-slip"], profiles=False, bootstrap=0)
    assert ranking.best.law.name == "sliding"
    assert any("their distribution is not normal" in note for note in ranking.notes)
    assert "a mixture distribution of unmeasured spins" in ranking.verdict
    assert ranking.as_dict()["ranking"][0]["parameters"]["spin_mean"]["note"] == "of a mixture"


# --- forms of the restitution ------------------------------------------------------------------------------------------


@pytest.mark.parametrize("form", ["polynomial", "power", "exponential", "line"])
def test_a_form_that_falls_over_fast_bounces_is_found(form):
    rng = np.random.default_rng(5)
    v = np.linspace(4, 12, 30)
    true = {"polynomial": 0.95 - 0.03 * v + 0.001 * v**2, "power": 0.85 * (v / 4) ** -0.2,
            "exponential": 0.6 + 0.35 * np.exp(-v / 7), "line": 0.7 + 0.6 / v}[form]  # fmt: skip
    columns = {
        "v_n_in": v,
        "v_t_in": 0.2 * v,
        "spin_in": np.zeros(30),
        "v_n_out": true * v + 0.02 * rng.normal(size=30),
    }
    rows = make_rebounds("planar", columns | {"sigma_v_n_out": 0.02})
    problem, _notes = make_problem(rows, Setting(0.02, 0.4, restitution=form))
    fit = fit_law(law("mirror"), problem)
    assert fit.chi2 < fit.dof + 4 * np.sqrt(2 * fit.dof)


def test_starts_of_a_form_come_from_the_ratios():
    v = np.linspace(1, 9, 20)
    (c,) = form_starts("viscoelastic", v, 1 / (1 + 0.2 * v**0.2 + 0.4 * 0.04 * v**0.4))[0]
    assert c == pytest.approx(0.2, rel=1e-6)
    assert form_starts("power", v, 0.9 * v**-0.25)[0] == pytest.approx((0.9, 1.0, 0.25), rel=1e-6)
    assert form_starts("polynomial", v[:2], v[:2]) == []


# --- intervals, outliers, bounds, groups, stages --------------------------------------------------------------------------


def test_an_interval_of_few_rows_without_error_bars_is_student_s():
    rng = np.random.default_rng(1)
    v = rng.uniform(1, 4, 8)
    out = v * (0.8 + 0.02 * rng.normal(size=8))
    columns = {"v_n_in": v, "v_t_in": 0 * v, "spin_in": 0 * v, "v_n_out": out, "v_t_out": 0 * v}
    problem, _notes = make_problem(make_rebounds("planar", columns), SETTING)
    one = with_profiles(fit_law(law("mirror"), problem)).estimates["restitution"]
    e = (v @ out) / (v @ v)
    error = np.sqrt(np.square(out - e * v).sum() / 7 / (v @ v))
    assert one.interval_95 == pytest.approx(e + error * student.ppf(0.975, 7) * np.array([-1, 1]), rel=2e-3)


def test_outputs_weighted_by_their_own_scatter_widen_an_interval():
    """Friction of eight sliding rows: log S of three outputs, profiled by SciPy; Student's t, Satterthwaite and Meier by hand."""
    rng, n = np.random.default_rng(3), 8
    v_n, v_t, noise = rng.uniform(1, 4, n), rng.uniform(3, 5, n), 0.02 * rng.normal(size=(3, n))
    seen = {"v_n_out": 0.8 * v_n + noise[0], "v_t_out": v_t - 0.36 * v_n + noise[1]}
    seen["spin_out"] = (-0.36 * v_n + noise[2]) / (A * 2 / 3) * -1
    rows = make_rebounds("planar", {"v_n_in": v_n, "v_t_in": v_t, "spin_in": 0 * v_n, **seen})
    fit = with_profiles(fit_law(law("sliding"), make_problem(rows, SETTING)[0]), ["friction"])
    sign = np.sign(fit.predicted()[0, 2])
    y = np.stack([seen["v_n_out"], v_t - seen["v_t_out"], sign * A * 2 / 3 * seen["spin_out"]]) / v_n

    def sums(mu, e):
        return (np.square(y - np.array([e, mu * (1 + e), mu * (1 + e)])[:, None]) * v_n**2).sum(axis=1)

    def profile(mu):
        return minimize_scalar(lambda e: n * np.log(sums(mu, e)).sum(), bounds=(0.5, 1), method="bounded").fun

    mu, e = fit.estimates["friction"].value, fit.estimates["restitution"].value
    slopes = np.array([[0, 1 + e, 1 + e], [1, mu, mu]])  # of mu and e
    each = np.einsum("aj,bj,j->jab", slopes, slopes, n * (v_n @ v_n) / sums(mu, e))
    inverse = np.linalg.inv(each.sum(axis=0))
    part = np.einsum("a,jab,b->j", inverse[0], each, inverse[0]) / inverse[0, 0]
    free = n - np.einsum("ab,jba->j", inverse, each)
    share, meier = part * n / free, 1 + 4 * (part * (1 - part) / free).sum()
    t = student.ppf(0.975, share.sum() ** 2 / (share**2 / free).sum())
    goal = n * np.log1p(part * share.sum() * meier * t**2 / n).sum() + profile(mu)
    ends = [brentq(lambda at: profile(at) - goal, mu, mu + side) for side in (-0.05, 0.05)]
    assert fit.estimates["friction"].interval_95 == pytest.approx(ends, abs=2e-3 * (ends[1] - ends[0]))


def test_one_bad_row_in_twenty_is_not_the_end():
    columns = measured_bounces(4, 20)
    columns["v_t_out"][7] += 0.8
    ranking = fit_laws(make_rebounds("planar", columns), SETTING, ["contact", "sliding", "no-slip"], bootstrap=0)
    assert ranking.fits
    assert not ranking.verdict.startswith("No law fits")
    assert ranking.best.problem.setting.robust
    for name, true in (("friction", 0.2), ("tangential_restitution", 0.3)):
        low, high = ranking.best.estimates[name].interval_95
        assert low - 0.02 < true < high + 0.02


def test_a_law_at_a_bound_is_not_preferred():
    rows = make_rebounds("planar", measured_bounces(2, 60, beta=0.3))
    ranking = fit_laws(
        rows, Setting(A, 2 / 3, bounds={"tangential_restitution": (-1.0, 0.2)}), ["contact", "mirror"], bootstrap=0
    )
    assert ranking.odds > 1e3
    assert not ranking.decisive
    assert "its tangential_restitution is at its upper bound" in ranking.held_back


def test_walls_that_differ_widen_the_error_bar():
    parts = [bounces(seed, 20, e=e) for seed, e in enumerate((0.70, 0.74, 0.78, 0.82))]
    columns = {name: np.concatenate([part[name] for part in parts]) for name in parts[0]}
    columns |= {"sigma_v_n_out": 0.05, "sigma_v_t_out": 0.05, "sigma_spin_out": 2.0}
    walls = {"wall": np.repeat(["a", "b", "c", "d"], 20)}
    ranking = fit_laws(make_rebounds("planar", columns, extra=walls), BALL, ["contact"], bootstrap=0, profiles=False)
    # the scatter of the four walls, over the root of 4, times Student's t of three degrees of freedom
    assert ranking.best.estimates["restitution"].stderr == pytest.approx(1.197 * 0.0516 / 2, rel=0.1)
    assert any(note.startswith("wall: under contact the 4 kinds of rows differ") for note in ranking.notes)


def test_both_stages_of_a_contact_are_not_independent_rows():
    columns = {"v_n_in": [1.0, 1.0, 2.0, 2.0, 3.0], "v_t_in": 0.5, "v_n_out": [0.8, 0.6, 1.6, 1.2, 1.8]}
    stages = ["after_wall", "rolling", "after_wall", "rolling", "rolling"]
    rows, _setting = usable_rows(make_rebounds("table", columns, stage=stages), Setting(0.03))
    assert rows["v_n_out"].tolist() == [0.8, 1.6, 1.8]
    rows, _setting = usable_rows(make_rebounds("table", columns, stage=stages), Setting(0.03), where="stage=rolling")
    assert rows["v_n_out"].tolist() == [0.6, 1.2, 1.8]


def test_rows_of_one_stage_or_film_are_selected_from_both_stages():
    v = np.repeat(np.linspace(1, 3, 12), 2)
    columns = {
        "v_n_in": v,
        "v_t_in": 0.1 * v,
        "spin_z_in": 0 * v,
        "v_n_out": np.tile([0.8, 0.6], 12) * v,
        "v_t_out": 0.1 * v,
    }
    columns |= {"sigma_v_n_out": 0.02, "sigma_v_t_out": 0.02}
    films = {"film": np.repeat(["a", "b"], 12)}
    rows = make_rebounds("table", columns, stage=["after_wall", "rolling"] * 12, extra=films)
    for where, used in (("stage=after_wall", 12), ("stage=rolling", 12), ("film=b", 6)):
        best = fit_laws(rows, Setting(0.03, 0.4), ["mirror"], where=where, bootstrap=0, profiles=False).best
        assert len(best.problem.x) == used


def test_laws_that_were_not_tried_are_named():
    assert "stronge" in [one.name for one in laws_named(None, "planar", True)[0]]
    (note,) = laws_named(None, "table", False)[1]
    assert "han2005" in note
    assert "stronge-cushion" in note


def test_a_number_without_information_in_a_group_has_no_error_bar() -> None:
    """Where all rows of a group stick, the information on friction is rounding, and its inverse was an error bar of 3e-9."""
    own = np.array([[8e6, -2e-8, 3e6], [-2e-8, 2.7e-21, -9e-9], [3e6, -9e-9, 1.6e6]])
    expected = np.diag(np.linalg.inv(own[np.ix_([0, 2], [0, 2])]))
    found = _variances(own, np.array([1.0, 5.0, 2.0]))
    assert np.isnan(found[1])
    np.testing.assert_allclose(found[[0, 2]], expected, rtol=1e-12)
