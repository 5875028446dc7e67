"""Figures of fits: one panel per law, and the report that holds them."""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np
import pytest

from carom.data.rebounds import make_rebounds
from carom.fitting import Ranking, Setting, fit_laws
from carom.plot.fit import write_report

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
    # normal speed, motion along the wall; residuals of two laws in two speeds against incidence, speed and row
    assert text.count("<svg") == 2 + 2 * 2 * 3
    assert re.findall("<h3>(.*?)</h3>", text) == [one.fit.law.name for one in ranking.ranked[:2]]
    # on a narrow page the head of its column stands before each number
    assert text.count('data-head="ΔAICc"') == len(ranking.ranked)
    verdict = text[text.index('class="verdict"') :].split("</p>")[0]
    assert "incidence 25 to 70°" in verdict
    again = write_report(ranking, tmp_path / "again.html").read_text(encoding="utf-8")
    assert again == text
