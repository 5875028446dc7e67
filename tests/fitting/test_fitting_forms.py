"""A restitution that depends on the speed is found by the law itself, where that with which its search begins is at a bound."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from reference.written_tables import KAPPA, RADIUS, bounces

from carom.data import make_rebounds, published_rebounds
from carom.fitting import FITTED, Setting, fit_law, fit_laws, make_problem
from carom.fitting.laws import INDEX
from carom.fitting.model import predict_law
from carom.fitting.rows import usable_rows


def fitted(form: str, fixed: dict[str, float]) -> tuple[float, dict[str, float | None]]:
    snooker = published_rebounds("mathavan2009")
    setting = Setting(**snooker.setting, restitution=form, fixed=fixed)
    fit = fit_laws(snooker.rebounds, setting, ["two-step"], profiles=False, bootstrap=0).best
    return fit.aicc, {name: estimate.value for name, estimate in fit.estimates.items()}


def test_a_falling_restitution_of_a_pressed_ball_is_found() -> None:
    """The wall and then the floor would need a restitution above 1, at which no slope of the restitution matters."""
    constant, _e = fitted("constant", {"friction": 0.14})
    falling, numbers = fitted("polynomial", {"friction": 0.14})
    assert falling < constant - 35
    assert numbers["restitution_0"] == pytest.approx(1.0, abs=1e-6)
    assert numbers["restitution_2"] == pytest.approx(-0.01386, abs=2e-5)
    free, numbers = fitted("polynomial", {})
    assert free < constant - 40
    assert numbers["restitution_0"] == pytest.approx(0.95568, abs=2e-5)


@pytest.mark.slow
def test_rounding_does_not_decide_where_a_fit_with_estimated_scatter_ends() -> None:
    """The valley of this table is narrow and full of kinks, one for each row that begins to stick."""
    snooker = published_rebounds("mathavan2009")
    setting = Setting(**snooker.setting, restitution="polynomial")
    problem = make_problem(*usable_rows(snooker.rebounds, setting))[0]
    law, rng = next(law for law in FITTED if law.name == "two-step"), np.random.default_rng(2)
    rounded = [1 + 2e-16 * rng.integers(-2, 3, problem.x.shape) for _ in range(2)]
    ends = [fit_law(law, replace(problem, x=problem.x * last)).deviance for last in rounded]
    assert ends == pytest.approx([-168.88698] * 2, abs=2e-6)


def test_error_bars_of_some_columns_alone_are_not_counted_for_all() -> None:
    """Spins without error bars made those of the speeds count three times: intervals of 95 % held 75 %."""
    columns = bounces(3)
    bars = {"sigma_v_n_out": 0.05, "sigma_v_t_out": 0.05}
    law = next(law for law in FITTED if (law.name, law.kind) == ("contact", "planar"))
    some, every = (fit_law(law, make_problem(make_rebounds("planar", columns | one), Setting(RADIUS, KAPPA))[0])
                   for one in (bars, bars | {"sigma_spin_out": 2.0}))  # fmt: skip
    for name, estimate in every.estimates.items():
        assert some.estimates[name].stderr == pytest.approx(estimate.stderr, rel=0.3)


def test_the_scatter_is_that_of_the_best_numbers() -> None:
    """Fitted in turn, numbers and scatter of one rubber stopped 4 units of the deviance above their joint optimum."""
    rackets = published_rebounds("tt_rackets").rebounds
    rows = rackets.select(rackets.extra["racket"] == "01_inverted")
    problem = make_problem(*usable_rows(rows, Setting(radius=0.02, kappa=2 / 3)))[0]
    law = next(law for law in FITTED if law.name == "contact")
    fit = fit_law(law, problem)
    p, found = fit.numbers.copy(), []
    for p[INDEX["friction"]] in (0.5, 0.6, 0.8, 1.5):
        for p[INDEX["tangential_restitution"]] in np.linspace(0.4, 0.9, 101):
            off = problem.y - predict_law(law, problem, p)
            found.append(14 * np.log(np.square(off).mean(axis=0)).sum() + 3 * 14)
    assert min(found) - 0.02 < fit.deviance < min(found) + 1e-9
