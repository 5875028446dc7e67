"""Fits of bounces by the impulse's closed form, which campaigns/known_bounces.py counts."""

from __future__ import annotations

import numpy as np
import pytest
from reference.plain_bounces import (
    A,
    after,
    before,
    drifting,
    holding,
    measured,
    mixed,
    of_walls,
    racket,
    strayed,
    two_rows,
)

import carom
from carom.data import make_rebounds
from carom.fitting import Setting, fit_law, fit_laws, make_problem
from carom.fitting.forms import with_mixtures
from carom.fitting.laws import laws_named

SETTING = Setting(radius=A)


def fit_of(name, columns):
    return fit_law(laws_named([name], "planar", True)[0][0], make_problem(make_rebounds("planar", columns), SETTING)[0])


@pytest.mark.parametrize(("seed", "rows"), [(0, 12), (1, 12), (2, 12), (6, 25)])
def test_no_friction_is_claimed_where_no_row_slides(seed, rows):
    columns, needed = holding(seed, rows)
    fit = fit_of("sliding", columns)
    assert fit.untold == ("friction",)
    # the row that slips most tells the limit, and nothing is gained over a law that never slides
    limit = float(fit.degenerate[0].split("identifiable: ")[1].split()[0])
    assert needed * 0.97 < limit < needed * 1.01
    sticking = fit_of("sticking", columns)
    assert fit.deviance == pytest.approx(sticking.deviance, abs=0.02)


def test_friction_of_rows_that_slide_is_claimed():
    rng = np.random.default_rng(5)
    state = before(rng, 25, 0.2, 0.3)
    assert (after(*state, 0.8, 0.1)[3] > 0.1).sum() >= 5
    one = fit_of("sliding", measured(rng, state, 0.8, 0.1, 0.0, 0.003)).estimates["friction"]
    assert abs(one.value - 0.1) < 3 * one.stderr < 0.003


@pytest.mark.parametrize("seed", range(3))
def test_no_law_ends_above_what_it_contains(seed):
    rng = np.random.default_rng(seed)
    columns = measured(rng, before(rng, 12, 0.2, 0.3), 0.8, 0.15, 0.0, 0.003)
    ranking = fit_laws(
        make_rebounds("planar", columns), SETTING, ["mirror", "sticking", "sliding", "contact"], profiles=False
    )
    fits = {one.fit.law.name: one.fit for one in ranking.ranked}
    for one in fits.values():
        assert all(fits[name].deviance < one.deviance + 0.02 for name in one.law.within if name in fits)


@pytest.mark.slow
def test_error_bars_beside_a_mixture_of_spins_agree_with_the_deviance():
    columns, truth = mixed(0, 40)
    problem = make_problem(make_rebounds("planar", columns), SETTING)[0]
    plain = [fit_of(name, columns) for name in ("sliding", "contact")]
    inner, outer = with_mixtures(sorted(plain, key=lambda fit: fit.aicc), problem)
    inner, outer = sorted((inner, outer), key=lambda fit: fit.law.name == "contact")
    beta = outer.estimates["tangential_restitution"]
    off = abs(beta.value - truth["tangential_restitution"]) / beta.stderr
    assert outer.deviance < inner.deviance + 0.05
    assert off < 1.3 * max(inner.deviance - outer.deviance, 1.0) ** 0.5


@pytest.mark.parametrize(("seed", "bars"), [(0, False), (1, True), (33, True), (35, False)])
def test_numbers_of_walls_that_differ_are_their_means(seed, bars):
    columns, e, mu = of_walls(seed, bars=bars)
    best = carom.fit(columns, radius=A, laws=["sliding"], bootstrap=0).best
    for name, true in (("restitution", e), ("friction", mu)):
        assert abs(best.estimates[name].value - true) < 2.5 * best.estimates[name].stderr
    # one restitution for all walls would pull the friction
    assert best.estimates["friction"].stderr < 0.03 * mu


def ranked(columns, *laws):
    return carom.fit(columns, radius=A, laws=list(laws), bootstrap=0, profiles=False)


def test_odds_do_not_survive_the_forms_that_the_rows_support():
    ranking = ranked(racket(3), "contact", "maw", "stronge")
    # with constants more than a million to 1
    assert ranking.ranked[1].fit.aicc - ranking.best.aicc > 400
    assert ranking.odds < 20
    assert not ranking.decisive


def test_two_rows_in_two_hundred_decide_nothing():
    ranking = ranked(two_rows(0), "mirror", "sticking")
    assert ranking.fits
    assert ranking.odds > 1e6
    assert not ranking.decisive
    assert ranking.held_back.startswith("2 of 205 rows")


def test_errors_that_follow_each_other_in_the_order_of_the_rows_are_found():
    assert ranked(drifting(0), "sliding", "mirror").adequacy.pattern == "v_n on the order of the rows"
    steady = ranked(drifting(0, share=0.0), "sliding", "mirror")
    assert steady.fits
    assert steady.decisive


def test_heavy_tails_are_tried_where_outliers_sway_and_the_rest_has_small_error_bars():
    best = ranked(strayed(0), "sliding", "mirror").best
    assert best.problem.nu > 0
    assert abs(best.estimates["friction"].value - 0.2) < 3 * best.estimates["friction"].stderr < 0.002
