"""What a verdict claims: odds together with how well the best law fits, and for which contacts; and scatter between contacts."""

from __future__ import annotations

import json
from dataclasses import replace

import numpy as np
import pytest
from reference.commands import command, fails
from reference.exploring import tried
from reference.synthetic_bounces import SETTING, A, measured_bounces
from reference.synthetic_bounces import bounces as unmeasured_bounces

from carom.data import make_rebounds, read_rebounds
from carom.data.datasets import load
from carom.data.published import published_rebounds
from carom.fitting import Setting, fit_law, fit_laws, make_problem
from carom.fitting.evidence import UNLIKELY
from carom.fitting.laws import laws_named
from carom.fitting.verdict import adequacy, coverage, odds_note


def law(name: str):
    return laws_named([name], "planar", True)[0][0]


def plain(columns):
    """The columns without error bars."""
    return {name: column for name, column in columns.items() if not name.startswith("sigma")}


def scattering(seed: int, share: float, n: int = 60, **truth: float):
    """Bounces that scatter by a share of their speed, beyond their error bars."""
    columns, rng = measured_bounces(seed, n, **truth), np.random.default_rng(seed + 1000)
    speed = np.hypot(columns["v_n_in"], columns["v_t_in"])
    for name, unit in (("v_n_out", 1.0), ("v_t_out", 1.0), ("spin_out", A)):
        columns[name] = columns[name] + share * speed / unit * rng.normal(size=n)
    return columns


# --- how well the best law fits ---------------------------------------------------------------------------------------


def test_fourteen_rows_of_one_rubber_do_not_speak_for_all():
    rebounds = read_rebounds(load("tt_rackets").path)
    rubber = rebounds.select(rebounds.extra["racket"] == "01_inverted")
    ranking = fit_laws(rubber, Setting(radius=0.02, kappa=2 / 3), bootstrap=0, profiles=False)
    assert (ranking.best.law.name, len(rubber)) == ("stronge", 14)
    assert 300 < ranking.odds < 330
    kept = {one.fit.law.name: one.fit.aicc for one in ranking.ranked}
    assert 6 < np.exp((kept["contact"] - kept["maw"]) / 2) < 7.2
    assert not ranking.decisive
    assert "lean to" in ranking.verdict
    assert "14 rows are few and they cover a small range of incidence" in ranking.verdict
    assert "incidence 0.0249 to 7.81°, 3.97 to 9.55 m/s, spin -1.14 to 1.92 v/a" in ranking.verdict


def test_a_restitution_that_falls_with_speed_shows_in_the_residuals_of_a_constant_one():
    set_ = published_rebounds("mathavan2009")
    for form, fits in (("constant", False), ("line", False), ("polynomial", True)):
        ranking = fit_laws(
            set_.rebounds, Setting(**set_.setting, restitution=form), ["mirror"], bootstrap=0, profiles=False
        )
        assert ranking.fits is fits
        assert ranking.as_dict()["fits"] is fits
        assert ("v_n on speed" in ranking.verdict) is not fits
    assert not ranking.adequacy.pattern_probability < 0.01


def test_a_wrong_law_without_error_bars_is_never_called_right():
    # it leaves a scatter that depends on what came before; chi^2 knows nothing of it
    ranking = fit_laws(make_rebounds("planar", plain(measured_bounces(1, 60))), SETTING, ["sticking", "mirror"],
                       bootstrap=0, profiles=False)  # fmt: skip
    assert ranking.odds > 1e6
    assert not ranking.fits
    assert not ranking.decisive
    assert ranking.verdict.startswith("No law fits: the residuals of the best, sticking")
    assert "prefer" not in ranking.verdict


def test_what_fails_its_chi2_is_not_preferred():
    columns = scattering(3, 0.03)
    ranking = fit_laws(make_rebounds("planar", columns), SETTING, bootstrap=0, profiles=False)
    assert ranking.odds > 1e6
    assert not ranking.decisive
    assert "prefer" not in ranking.verdict
    assert "`scatter`" in ranking.verdict


def test_true_laws_are_seldom_rejected():
    count = tried(40, 150)
    found = [adequacy(fit_law(law("contact"), make_problem(make_rebounds("planar", plain(measured_bounces(s, 40))), SETTING)[0]))
             for s in range(count)]  # fmt: skip
    pattern = np.array([one.pattern_probability for one in found])
    assert np.isnan([one.chi2_probability for one in found]).all()
    assert all(one.fits for one in found)
    # the probability counts all orders that were looked at, so that it is no less than it says (three errors of the count)
    for level in (0.05, 0.2):
        assert np.mean(pattern <= level) <= level + 3 * np.sqrt(level * (1 - level) / count)
    known = [adequacy(fit_law(law("contact"), make_problem(make_rebounds("planar", measured_bounces(s, 40)), SETTING)[0]))
             for s in range(count)]  # fmt: skip
    chi2 = np.array([one.chi2_probability for one in known])
    assert np.mean(chi2) == pytest.approx(0.5, abs=3 * np.sqrt(1 / 12 / count))
    assert (chi2 > UNLIKELY).all()


def test_the_range_is_what_the_rows_cover():
    columns = measured_bounces(1, 60)
    problem = make_problem(make_rebounds("planar", columns), SETTING)[0]
    covers = coverage(problem)
    assert covers.rows == 60
    assert covers.narrow == ""
    speed = np.hypot(columns["v_n_in"], columns["v_t_in"])
    assert covers.speed == pytest.approx((speed.min(), speed.max()))
    assert covers.angle_deg[1] == pytest.approx(
        np.degrees(np.arctan(np.abs(columns["v_t_in"] / columns["v_n_in"]))).max()
    )
    # the side on which a ball comes does not matter, running spin is positive
    turned = columns | {name: -columns[name] for name in ("v_t_in", "spin_in", "v_t_out", "spin_out")}
    assert coverage(make_problem(make_rebounds("planar", turned), SETTING)[0]) == covers
    one_speed = problem.select(np.flatnonzero(np.abs(speed - 3.0) < 0.4))
    assert "small range of speed" in coverage(one_speed).narrow
    assert (
        "spin not measured"
        in coverage(
            make_problem(make_rebounds("planar", unmeasured_bounces(1, 40, 0.02, 2.0, True)), SETTING)[0]
        ).in_words()
    )


# --- scatter between contacts -----------------------------------------------------------------------------------------


@pytest.mark.parametrize(("share", "kind"), [(0.03, "share"), (0.1, "share")])
@pytest.mark.slow(keep=1)
def test_the_scatter_between_contacts_comes_back(share, kind):
    setting, pulls, chi2, mine = replace(SETTING, scatter=kind), [], [], []
    for seed in range(40):
        fit = fit_law(law("contact"), make_problem(make_rebounds("planar", scattering(seed, share)), setting)[0])
        found = fit.contact_scatter
        pulls.append((found.value - share) / found.stderr)
        chi2.append(fit.chi2 / fit.dof)
        mine.append((fit.estimates["friction"].value - 0.2) / fit.estimates["friction"].stderr)
    # (the likeliest scatter is too small, by some k/2n of itself: a third of its error bar)
    assert np.mean(pulls) == pytest.approx(-0.3, abs=3 / np.sqrt(40))
    assert np.std(pulls) == pytest.approx(1.0, abs=3 / np.sqrt(80))
    assert np.mean(chi2) == pytest.approx(1.0, abs=0.06)
    assert np.std(mine) == pytest.approx(1.0, abs=3 / np.sqrt(80))


def test_an_absolute_scatter_is_in_metres_a_second():
    columns, rng = measured_bounces(2, 60), np.random.default_rng(5)
    for name, unit in (("v_n_out", 1.0), ("v_t_out", 1.0), ("spin_out", A)):
        columns[name] = columns[name] + 0.15 / unit * rng.normal(size=60)
    fit = fit_law(
        law("contact"), make_problem(make_rebounds("planar", columns), replace(SETTING, scatter="absolute"))[0]
    )
    assert abs(fit.contact_scatter.value - 0.15) < 3 * fit.contact_scatter.stderr
    assert fit.contact_scatter.stderr < 0.015
    assert fit.scatter_in_words.endswith(" m/s")
    # the same as error bars that were given so large from the beginning
    wide = dict(columns)
    for name, unit in (("v_n_out", 1.0), ("v_t_out", 1.0), ("spin_out", A)):
        wide[f"sigma_{name}"] = np.hypot(columns[f"sigma_{name}"], fit.contact_scatter.value / unit)
    given = fit_law(law("contact"), make_problem(make_rebounds("planar", wide), SETTING)[0])
    for name, one in fit.estimates.items():
        assert one.value == pytest.approx(given.estimates[name].value, abs=0.01 * one.stderr)


def test_where_error_bars_are_enough_no_scatter_is_found():
    problem = make_problem(make_rebounds("planar", measured_bounces(7, 60)), replace(SETTING, scatter="share"))[0]
    fit = fit_law(law("contact"), problem)
    assert fit.contact_scatter.value < 0.004
    without = fit_law(law("contact"), make_problem(make_rebounds("planar", measured_bounces(7, 60)), SETTING)[0])
    assert fit.deviance <= without.deviance + 1e-6


def test_scatter_of_contacts_whose_spin_nobody_measured():
    columns, rng = unmeasured_bounces(3, 80, 0.02, 2.0, True), np.random.default_rng(8)
    speed = np.hypot(columns["v_n_in"], columns["v_t_in"])
    for name in ("v_n_out", "v_t_out"):
        columns[name] = columns[name] + 0.03 * speed * rng.normal(size=80)
    setting = replace(SETTING, scatter="share")
    fit = fit_law(law("sliding"), make_problem(make_rebounds("planar", columns), setting)[0])
    assert abs(fit.contact_scatter.value - 0.03) < 3 * fit.contact_scatter.stderr
    assert fit.contact_scatter.stderr < 0.006
    assert abs(fit.estimates["restitution"].value - 0.8) < 3.5 * fit.estimates["restitution"].stderr


def test_the_scores_of_laws_with_a_scatter_are_those_of_densities():
    # the score is a log density per row: with the right scatter it is the higher, and near what the fit says in its own rows
    rebounds = make_rebounds("planar", scattering(3, 0.03))
    with_, without = (fit_laws(rebounds, setting, ["contact", "sliding"], bootstrap=0, profiles=False)
                      for setting in (replace(SETTING, scatter="share"), SETTING))  # fmt: skip
    assert with_.ranked[0].score > without.ranked[0].score + 5
    fit = with_.best
    assert with_.ranked[0].score == pytest.approx(-fit.deviance / 2 / 60, abs=0.15)
    assert with_.ranked[0].score < -fit.deviance / 2 / 60
    assert with_.decisive


def test_scatter_on_the_command_line(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    make_rebounds("planar", scattering(3, 0.03)).save("bounces.csv")
    words = (
        "fit",
        "bounces.csv",
        "--radius",
        "0.02",
        "--inertia",
        "hollow",
        "--laws",
        "contact,sliding",
        "--bootstrap",
        "0",
    )
    code, out, err = command(capsys, *words, "--scatter", "share", "--json")
    assert code == 0, err
    best = json.loads(out)["ranking"][0]
    assert best["contact_scatter"]["value"] == pytest.approx(0.0293, abs=0.0005)
    assert best["scatter"] == {"contacts": best["contact_scatter"]["value"]}
    assert "of the speed" in command(capsys, *words, "--scatter", "share", "--no-profiles")[1]
    (line,) = fails(capsys, *words, "--scatter", "both")
    assert "scatter: expected share or absolute, got 'both'" in line
    make_rebounds("planar", plain(scattering(3, 0.03))).save("plain.csv")
    lines = fails(capsys, "fit", "plain.csv", *words[2:], "--scatter", "share")
    assert any(
        "scatter: expected error bars, beyond which contacts scatter, got no sigma_v_n_out" in line for line in lines
    )
    assert any(
        "--scatter: expected no --whole" in line for line in fails(capsys, *words[:4], "--whole", "--scatter", "share")
    )


# --- two springs on bounces in the plane ------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("words", "best", "ratios"),
    [
        (("kharaz2001",), "maw", {"maw": (0.919, 0.045), "stronge": (0.842, 0.034)}),
        (
            ("tt_rackets", "--where", "racket=01_inverted"),
            "stronge",
            {"maw": (0.765, 0.028), "stronge": (0.314, 0.013)},
        ),
    ],
)
def test_two_springs_are_fitted_to_bounces_in_the_plane(tmp_path, monkeypatch, capsys, words, best, ratios):
    monkeypatch.chdir(tmp_path)
    options = ("--laws", "maw,stronge", "--bootstrap", "0", "--no-profiles")
    code, out, err = command(capsys, "fit", *words, *options, "--json")
    assert code == 0, err
    ranking = json.loads(out)["ranking"]
    assert ranking[0]["law"] == best
    for one in ranking:
        found, (value, stderr) = one["parameters"]["stiffness_ratio"], ratios[one["law"]]
        assert found["value"] == pytest.approx(value, abs=0.001)
        assert found["stderr"] == pytest.approx(stderr, abs=0.001)
    text = " ".join(command(capsys, "fit", *words, *options)[1].split())
    assert text.count("stiffness_ratio") == 2
    for value, _stderr in ratios.values():
        assert f"{value:.3f} \u00b1" in text


def test_the_error_rate_is_that_of_tables_of_this_size() -> None:
    for rows, said in ((6, "tables of 8 rows"), (25, "tables of 30 rows"), (500, "tables of 200 rows")):
        (note,) = odds_note(rows, 50.0)
        assert said in note
    assert "none was wrong (below 1.2 %)" in odds_note(500, 50.0)[0]
    assert odds_note(30, 5.0) == []
