"""Figures of fits: one panel per law, and the report that holds them."""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np
import pytest

from carom.data.rebounds import make_rebounds
from carom.fitting import Ranking, Setting, fit_laws
from carom.plot.fit import plot_fit, write_report

LAWS = ["sliding", "sticking", "mirror", "no-slip"]


@pytest.fixture(scope="module")
def ranking() -> Ranking:
    """Balls that slide: friction 0.1, restitution 0.9."""
    angle = np.radians(np.linspace(25, 70, 24))
    v_n, v_t, noise = 2 * np.cos(angle), 2 * np.sin(angle), np.random.default_rng(1).normal(0, 0.01, (2, 24))
    columns = {
        "v_n_in": v_n, "v_t_in": v_t, "spin_in": np.zeros(24), "v_n_out": 0.9 * v_n + noise[0],
        "v_t_out": v_t - 0.1 * 1.9 * v_n + noise[1], "spin_out": np.full(24, np.nan),
        "sigma_v_n_out": np.full(24, 0.01), "sigma_v_t_out": np.full(24, 0.01),
    }  # fmt: skip
    return fit_laws(make_rebounds("planar", columns), Setting(radius=0.02, kappa=0.4), LAWS, bootstrap=0)


def test_the_report_has_the_panels_and_the_range_of_incidence_in_its_verdict(ranking: Ranking, tmp_path: Path) -> None:
    text = write_report(ranking, tmp_path / "page.html").read_text(encoding="utf-8")
    # what was measured; residuals of two laws in two speeds against incidence and row (the speed is the same in all)
    assert text.count("<svg") == 1 + 2 * 2
    best, second = (one.fit.law.name for one in ranking.ranked[:2])
    assert re.findall("Filled: (.*?); open: (.*?);", text) == [(best, second)]
    # on a narrow page the head of its column stands before each number
    assert text.count('data-head="ΔAICc"') == len(ranking.ranked)
    verdict = text[text.index('class="verdict"') :].split("</p>")[0]
    assert "incidence 25 to 70°" in verdict
    again = write_report(ranking, tmp_path / "again.html").read_text(encoding="utf-8")
    assert again == text


def test_the_figure_has_the_residuals_of_the_two_best_laws_in_error_bars(ranking: Ranking) -> None:
    best = ranking.best
    gap = best.residuals()
    assert np.nansum(gap**2) == pytest.approx(best.chi2)
    figure = plot_fit(ranking)
    _measured, *panels = figure.axes
    assert [axes.get_xlabel() for axes in panels[-2:]] == ["incidence, degrees", "row"]
    assert [axes.get_ylabel() for axes in panels[::2]] == ["normal speed", "speed along wall"]
    for axes, column in zip(panels, (0, 0, 1, 1), strict=True):
        assert axes.lines[1].get_ydata() == pytest.approx(gap[:, column])


def test_errors_before_the_wall_are_in_the_error_bars_of_residuals() -> None:
    rng = np.random.default_rng(3)
    v, n = rng.uniform(1, 3, 40), 40
    columns = {
        "v_n_in": v + rng.normal(0, 0.05, n), "v_t_in": 0.2 * v, "spin_in": np.zeros(n), "sigma_v_n_in": np.full(n, 0.05),
        "v_n_out": 0.8 * v + rng.normal(0, 0.01, n), "sigma_v_n_out": np.full(n, 0.01),
    }  # fmt: skip
    fit = fit_laws(make_rebounds("planar", columns), Setting(radius=0.02, kappa=0.4), ["mirror"], bootstrap=0).best
    assert np.nansum(fit.residuals() ** 2) == pytest.approx(fit.chi2, rel=1e-6)
