"""Fits of balls on a table: rolling balls against a cushion, with sidespin measured and not."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest
from reference.exploring import tried

import carom
from carom.data import make_rebounds, rebounds_of_collisions
from carom.fitting import Setting, fit_law, fit_laws, make_problem
from carom.fitting import model as tabulated
from carom.fitting import ranking as cross_validation
from carom.fitting.laws import INDEX, NUMBERS, PARAMETERS, laws_for, laws_named
from carom.fitting.likelihood import evaluate, predictions
from carom.fitting.model import model_of, predict_law
from carom.fitting.verdict import adequacy

A, HEIGHT = 0.03075, 37 / 30.75
BALL = carom.Ball(radius=A, mass=0.21)
SETTING = Setting(radius=A, contact_height=HEIGHT)


def rolled(seed, n, *, friction=0.2, spin_seen=True, floor_contact="with", spin_mean=0.0, spin_width=0.5):
    """Rolling balls against a cushion with a nose above their centres, by `carom.two_step`; measured once they roll again."""
    rng = np.random.default_rng(seed)
    vn, vt = rng.uniform(0.5, 3, n), rng.uniform(-2, 2, n)
    spin = spin_mean * vt / A + spin_width * np.hypot(vn, vt) / A * rng.normal(size=n)
    state = carom.rolling(BALL, np.stack([-vn, vt], -1), spin_z=spin)
    two = carom.two_step(
        BALL, state, wall=carom.Surface(0.85, friction), floor=carom.Surface(0.0, 0.2),
        normal=(math.sqrt(1 - (HEIGHT - 1) ** 2), 0.0, 1 - HEIGHT), floor_contact=floor_contact,
    )  # fmt: skip
    columns = {"v_n_in": vn, "v_t_in": vt, "spin_z_in": spin if spin_seen else np.full(n, np.nan)}
    for name, values in (
        ("v_n_out", two.rolling.velocity[:, 0]), ("v_t_out", two.rolling.velocity[:, 1]), ("spin_z_out", two.rolling.spin[:, 2])
    ):  # fmt: skip
        if name == "spin_z_out" and not spin_seen:
            continue
        sigma = 1.0 if "spin" in name else 0.02
        columns |= {name: values + sigma * rng.normal(size=n), f"sigma_{name}": np.full(n, sigma)}
    return make_rebounds("table", columns, stage="rolling")


@pytest.fixture(scope="module")
def measured():
    return rolled(12, 30)


def test_two_step_wins_on_a_table_and_its_surfaces_come_back(measured):
    ranking = fit_laws(measured, SETTING, profiles=False, bootstrap=0)
    assert ranking.best.law.name == "two-step"
    assert ranking.fits
    assert {one.fit.law.name for one in ranking.ranked} == {one.name for one in laws_for("table", False)}
    for name, value in (("restitution", 0.85), ("friction", 0.2)):
        estimate = ranking.best.estimates[name]
        assert abs(estimate.value - value) < 3.5 * estimate.stderr
    worst = ranking.ranked[-1]
    assert worst.fit.law.name == "conventional"
    assert worst.weight < 1e-10


def test_laws_say_on_a_table_what_the_verbs_say(measured):
    problem, _ = make_problem(measured, SETTING)
    velocity = np.stack([-measured["v_n_in"], measured["v_t_in"]], -1)
    state = carom.rolling(BALL, velocity, spin_z=measured["spin_z_in"])
    conventional = fit_law(laws_named(["conventional"], "table", False)[0][0], problem)
    assert conventional.predicted()[:, :2] == pytest.approx(carom.conventional(BALL, state).velocity[:, :2])
    paper = fit_law(laws_named(["two-step-paper"], "table", False)[0][0], problem)
    assert paper.predicted()[:, :2] == pytest.approx(carom.two_step(BALL, state).rolling.velocity[:, :2])


@pytest.mark.slow
def test_sidespins_nobody_measured_on_a_table():
    rebounds = rolled(4, 60, spin_seen=False, floor_contact="after", spin_mean=0.5)
    ranking = fit_laws(rebounds, SETTING, ["two-step-after", "conventional", "two-step-paper", "mirror"],
                       profiles=False, bootstrap=0)  # fmt: skip
    best = ranking.best
    assert best.law.name == "two-step-after"
    assert ranking.fits
    assert ranking.odds > 1e6
    for name, value in (("restitution", 0.85), ("friction", 0.2), ("spin_mean", 0.5), ("spin_width", 0.5)):
        assert abs(best.estimates[name].value - value) < 3 * best.estimates[name].stderr, name


def test_wall_and_floor_at_once_with_unmeasured_sidespin():
    # the law that costs most: it starts where wall and floor in turn ended
    rebounds = rolled(6, 40, spin_seen=False)
    fit = fit_law(laws_named(["two-step"], "table", False)[0][0], make_problem(rebounds, SETTING)[0])
    for name, value in (("restitution", 0.85), ("friction", 0.2), ("spin_mean", 0.0), ("spin_width", 0.5)):
        assert abs(fit.estimates[name].value - value) < 3.5 * fit.estimates[name].stderr, name


@pytest.mark.slow
def test_the_score_of_many_rows_without_spins_is_a_number(monkeypatch):
    monkeypatch.setattr(cross_validation, "CROSS_VALIDATION_WORK", 4e5)
    # (98 rows of wall and floor at once were beyond the work that cross-validation was allowed; all else is given, to be quick)
    given = {"friction": 0.2, "spin_mean": 0.4, "spin_width": 0.5}
    setting = Setting(radius=A, contact_height=HEIGHT, fixed=given)
    laws = ["two-step", "two-step-after"]
    ranking = fit_laws(rolled(1, 100, spin_seen=False, spin_mean=0.4), setting, laws, profiles=False, bootstrap=0)
    for one in ranking.ranked:
        in_sample = -one.fit.deviance / 2 / 100
        assert in_sample - 0.1 < one.score < in_sample


def test_one_newton_step_is_where_a_descent_without_the_rows_ends(monkeypatch):
    fit = fit_law(
        laws_named(["two-step-after"], "table", False)[0][0],
        make_problem(rolled(1, 60, spin_seen=False, spin_mean=0.4), SETTING)[0],
    )
    scores = []
    for work in (math.inf, 0.0):
        monkeypatch.setattr(cross_validation, "CROSS_VALIDATION_WORK", work)
        scores.append(cross_validation.cross_validated_score(fit))
    assert scores[0] < -fit.deviance / 2 / 60 - 0.01  # (what is left out is predicted worse than what was fitted)
    assert scores[1] == pytest.approx(scores[0], abs=0.003)
    # nothing is left out: nothing moves
    same = cross_validation.one_step_without(fit, fit.problem, np.zeros((1, 60)))[0]
    width = fit.estimates["spin_mean"].stderr
    assert np.abs(same - fit.numbers).max() < 0.05 * width


def test_spins_that_nobody_measured_are_no_pattern_of_the_law_s():
    # what a mean spin leaves depends on the incidence, whatever the law
    law = laws_named(["two-step-after"], "table", False)[0][0]
    rebounds = rolled(1, 200, spin_seen=False, floor_contact="after", spin_mean=0.4)
    found = adequacy(fit_law(law, make_problem(rebounds, SETTING)[0]))
    assert found.fits
    assert found.pattern == "v_n on the order of the rows"  # (what else there is would be by incidence)
    assert found.pattern_probability > 0.01
    assert found.chi2_probability > 1e-3


def test_a_score_that_cannot_be_had_or_disagrees_is_said():
    said = cross_validation.score_warnings("sliding", {"sliding": -2.0, "maw": -1.9, "contact": math.nan}, "maw", 20)
    assert [line.split(":")[1].split(",")[0].strip() for line in said] == [
        "none for contact",
        "maw predicts rows that were left out better than sliding (-1.9 and -2 per row)",
    ]
    assert cross_validation.score_warnings("sliding", {"sliding": -2.0, "maw": -2.1}, "maw", 20) == []
    assert cross_validation.score_warnings("sliding", {"sliding": 7.5906, "maw": 7.5911}, "maw", 200) == []


def filmed(seed, n, sigma=0.004, shared=False):
    """Balls that leave a cushion with a nose, filmed: errors before and after, no spin, perhaps one error of the cloth in all."""
    rng = np.random.default_rng(seed)
    vn, vt = rng.uniform(0.5, 3, n), rng.uniform(-2, 2, n)
    spin = 0.4 * vt / A + 0.4 * np.hypot(vn, vt) / A * rng.normal(size=n)
    law, setting = (
        laws_named(["two-step"], "table", False)[0][0],
        Setting(radius=A, contact_height=HEIGHT, floor_friction=0.2),
    )
    before = {"v_n_in": vn, "v_t_in": vt, "spin_z_in": spin}
    stand_in = make_problem(
        make_rebounds("table", before | {"v_n_out": vn, "v_t_out": vt}, stage="after_wall"), setting
    )[0]
    p = np.array([parameter.value for parameter in PARAMETERS])
    for name, value in (("restitution", 0.8), ("friction", 0.2), ("contact_height", HEIGHT), ("floor_friction", 0.2)):
        p[INDEX[name]] = value
    true = predict_law(law, stand_in, p)
    columns = before | {"v_n_out": true[:, 0], "v_t_out": true[:, 1], "spin_z_in": np.full(n, np.nan)}
    for name in ("v_n_in", "v_t_in", "v_n_out", "v_t_out"):
        error = sigma / 2 if name.endswith("_in") else sigma
        columns[name] = columns[name] + error * rng.normal(size=n)
        columns[f"sigma_{name}"] = np.full(n, error)
    extra = {}
    if shared:
        along = np.array([str(0.001 * sign) for sign in np.sign(vt)])
        extra = {
            "floor_friction": np.full(n, "0.2"),
            "sigma_floor_friction": np.full(n, "0.005"),
            "cloth_v_t_out": along,
        }
        setting = Setting(radius=A, contact_height=HEIGHT)
    return law, make_problem(make_rebounds("table", columns, stage="after_wall", extra=extra), setting)[0]


@pytest.mark.slow
def test_a_table_of_the_law_changes_no_estimate(monkeypatch):
    law, problem = filmed(3, 64)
    quick = fit_law(law, problem)
    in_the_valley(quick)
    monkeypatch.setattr(tabulated, "LEAST_ROWS", 1000)
    plain = fit_law(law, problem)
    assert quick.tabulated is not None
    assert plain.tabulated is None
    assert quick.deviance == pytest.approx(plain.deviance, abs=0.02)
    for name, one in plain.estimates.items():
        assert quick.estimates[name].value == pytest.approx(one.value, abs=0.01 * one.stderr), name
        assert quick.estimates[name].stderr == pytest.approx(one.stderr, rel=0.02), name
    assert quick.degenerate == plain.degenerate
    scores = [cross_validation.cross_validated_score(fit) for fit in (quick, plain)]
    assert scores[0] == pytest.approx(scores[1], abs=0.002)  # (of a row; with numbers by the table it was 0.0036 off)


def in_the_valley(fit):
    # small error bars: between the frictions that were tried the search saw nothing of it, and ended 170 above in chi^2
    for name, value in (("restitution", 0.8), ("friction", 0.2), ("spin_mean", 0.4), ("spin_width", 0.4)):
        assert abs(fit.estimates[name].value - value) < 3.5 * fit.estimates[name].stderr, name
    assert fit.estimates["friction"].stderr < 0.002


@pytest.mark.parametrize(("seed", "shared"), tried([(6, True)], [(1, False), (6, True)]))
@pytest.mark.slow
def test_the_valley_of_the_true_friction_is_found_however_narrow(seed, shared):
    in_the_valley(fit_law(*filmed(seed, 64, shared=shared)))


def said(model, x, p):
    return predictions(model.kind, model.rows, x, p)


def test_a_table_says_what_the_law_says():
    law, problem = filmed(2, 400, shared=True)
    model = model_of(law, problem)
    p = model.start.copy()
    p[INDEX["restitution"]], p[INDEX["friction"]], p[NUMBERS:] = 0.813, 0.187, 0.7
    coarse = tabulated.coarse_table(model)
    fine = tabulated.fine_table(coarse, (0.0004, 0.0008), 0.187)
    spins = 0.5 * np.random.default_rng(3).normal(size=400) * np.hypot(problem.x[:, 0], problem.x[:, 1]) / A
    x = np.stack([problem.x[:, 0], problem.x[:, 1], spins], axis=-1)
    there = np.append(p[:NUMBERS] + p[NUMBERS:] @ model.moves, 0 * p[NUMBERS:])
    exact, speed = said(model.likelihood(), x, there), np.hypot(x[:, 0], x[:, 1])[:, None]
    for table, rms, most in ((coarse, 2e-3, 6e-3), (fine, 6e-5, 5e-4)):
        known = model.using(table).likelihood()
        known = replace(known, rows=known.rows._replace(known=table.at(p, model.moves, model.free)))
        off = (said(known, x, there) - exact) * (1, 1, A) / speed
        assert np.sqrt(np.square(off).mean(axis=0)).max() < rms
        assert np.abs(off).max() < most
    # and its slopes in restitution and friction are the law's
    step = np.zeros((2, len(there)))
    step[0, INDEX["restitution"]] = step[1, INDEX["friction"]] = 1e-4
    for by in step:
        slope = said(known, x, there + by) - said(known, x, there)
        true = said(model.likelihood(), x, there + by) - exact
        assert np.median(np.abs(slope - true)[:, :2]) < 0.02 * np.median(np.abs(true)[:, :2])


def test_sets_of_a_tabulated_law_are_those_of_each_alone():
    """To the last bit, however many are evaluated at once, with rows drawn for each."""
    law, problem = filmed(2, 64, shared=True)
    model = model_of(law, problem)
    model = model.using(tabulated.coarse_table(model))
    p, rng = np.tile(model.start, (18, 1)), np.random.default_rng(1)
    p[:, INDEX["restitution"]], p[:, INDEX["friction"]] = np.linspace(0.80, 0.81, 18), 0.187
    weights = rng.multinomial(64, np.full(64, 1 / 64), size=18).astype(float)
    every = evaluate(model.likelihood(), p, weights)
    for b in (0, 15, 16, 17):
        alone = evaluate(model.likelihood(), p[b : b + 1], weights[b : b + 1])
        for name, values in vars(alone).items():
            assert np.array_equal(values[0], getattr(every, name)[b]), name


def test_what_a_table_does_not_have_is_asked_of_the_law():
    law, problem = filmed(1, 64)
    for changes in ({"fit": ("contact_height",)}, {"restitution": "line"}, {"fit": ("floor_friction",)}):
        other = replace(problem, setting=replace(problem.setting, **changes))
        assert tabulated.coarse_table(model_of(law, other)) is None
    assert tabulated.coarse_table(model_of(law, problem)) is not None
    assert tabulated.coarse_table(model_of(law, problem.select(np.arange(30)))) is None


def test_restitution_and_friction_between_two_balls_come_back():
    rng = np.random.default_rng(1)
    n, sigma = 40, 0.01
    speed, cut = rng.uniform(0.8, 3, n), np.radians(rng.uniform(-70, 70, n))
    turn = rng.uniform(0, 2 * np.pi, n)  # (whatever the direction on the table)
    centres = np.stack([np.cos(turn + cut), np.sin(turn + cut), 0 * cut], axis=-1)
    rolling = carom.rolling(BALL, np.stack([speed * np.cos(turn), speed * np.sin(turn)], axis=-1))
    rest = carom.State(np.zeros((n, 3)), np.zeros((n, 3)))
    hit = carom.collide(BALL, rolling, BALL, rest, -centres, carom.Surface(0.93, 0.06))
    one, other = (state.velocity[:, :2] + sigma * rng.normal(size=(n, 2)) for state in hit.after)
    before = rolling.velocity[:, :2] + sigma * rng.normal(size=(n, 2))
    table = rebounds_of_collisions(before, one, other, 0.06 * centres[:, :2], sigma_v=sigma)
    ranking = carom.fit(table, radius=A, laws=["sliding"], spin="0")
    assert ranking.fits
    for name, value, error in (("restitution", 0.93, 0.003), ("friction", 0.06, 0.002)):
        found = ranking.best.estimates[name]
        assert abs(found.value - value) < 3 * found.stderr
        assert found.stderr < error
    with pytest.raises(carom.CaromError, match=r"struck: expected an array of shape \(40, 2\), got \(39, 2\)"):
        rebounds_of_collisions(before, one, other[1:], centres[:, :2])
    with pytest.raises(carom.CaromError, match=r"centres: expected a direction, got zero length at index \(3,\)"):
        rebounds_of_collisions(before, one, other, centres[:, :2] * (np.arange(n) != 3)[:, None])
