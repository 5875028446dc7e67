"""The contest of laws and learners: its scores on a table of known truth, and where a learner gains."""

from __future__ import annotations

import numpy as np
import pytest
from dev.contest import contest, where_it_wins
from reference.varying_bounces import RADIUS, drawn_table

from carom.data.rebounds import make_rebounds
from carom.fitting import Setting, make_problem


def test_a_law_predicts_rows_that_it_has_not_seen() -> None:
    columns = drawn_table(40, 1, lambda v: 0.7 + 0 * v, lambda s: 0.3 + 0 * s, lambda s: 0.3 + 0 * s, 0.1, bars=False)
    problem = make_problem(make_rebounds("planar", columns), Setting(radius=RADIUS, kappa=2 / 3))[0]
    found = contest(problem, ("law",))["law"]
    # three normal errors of 0.1 m/s: -3/2 log(2 pi e) - 3 log 0.1
    assert abs(found["score"].mean() - 2.65) < 0.6
    assert abs(found["velocity"].mean() - 0.1 * np.sqrt(np.pi / 2)) < 0.03
    assert abs(found["spin"].mean() - 5.0 * np.sqrt(2 / np.pi)) < 1.5
    said = where_it_wins(problem, np.ones(len(problem.x)))
    assert said.count("+1.00") == 4


@pytest.mark.filterwarnings("ignore::Warning")  # (lengths at their bounds)
@pytest.mark.slow
def test_a_process_finds_nothing_beside_the_true_law() -> None:
    pytest.importorskip("sklearn")
    columns = drawn_table(40, 1, lambda v: 0.7 + 0 * v, lambda s: 0.3 + 0 * s, lambda s: 0.3 + 0 * s, 0.1, bars=False)
    problem = make_problem(make_rebounds("planar", columns), Setting(radius=RADIUS, kappa=2 / 3))[0]
    found = contest(problem, ("law", "law and process"))
    gain = found["law and process"]["score"] - found["law"]["score"]
    assert abs(gain.mean()) < 0.3
    assert np.allclose(found["law and process"]["velocity"].mean(), found["law"]["velocity"].mean(), rtol=0.15)
