"""Spins that were not measured, carried from bounce to bounce: against sums over the first spin, and fits with a known truth."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from reference.puck_sequences import KAPPA, RADIUS, deviance, table

from carom.data import Rebounds, make_rebounds
from carom.fitting import Setting, fit_law, make_problem, spin_chains, usable_rows
from carom.fitting.laws import INDEX, laws_named
from carom.fitting.model import model_of
from carom.fitting.ranking import cross_validated_score
from carom.fitting.result import Estimate
from carom.fitting.rows import Problem
from carom.fitting.verdict import unsettled

SETTING = Setting(RADIUS, KAPPA)
CONTACT = laws_named(["contact"], "planar", upright=True)[0][0]
NUMBERS = {"restitution": 0.75, "friction": 0.15, "tangential_restitution": 0.1, "spin_mean": 0.2, "spin_width": 0.5}


def rows_of(seed: int, **options: float) -> Rebounds:
    columns = table(seed, **options)
    return make_rebounds("planar", columns, extra={name: columns.pop(name) for name in ("shot", "bounce")})


def problem_of(seed: int, **options: float) -> Problem:
    return make_problem(*usable_rows(rows_of(seed, **options), SETTING))[0]


def test_chains_are_contacts_that_follow_each_other() -> None:
    numbers = {"shot": np.array(["b", "a", "a", "b", "a", "a"]), "bounce": np.array([2, 2, 1, 1, 4, 5])}
    speeds = {"v_n_in": [1.0] * 6, "v_t_in": 0.5, "v_n_out": 0.8}
    assert spin_chains.chains_of(make_rebounds("planar", speeds, extra=numbers)).tolist() == [[2, 1], [4, 5], [3, 0]]
    assert spin_chains.chains_of(make_rebounds("planar", speeds)).tolist() == [[i] for i in range(6)]


def test_the_likelihood_is_the_sum_over_the_first_spin(monkeypatch: pytest.MonkeyPatch) -> None:
    problem = problem_of(1, shots=3)
    problem = replace(problem, vx=0 * problem.vx)  # (the sum takes speeds before the wall as exact)
    p = model_of(CONTACT, problem).start.copy()
    p[[INDEX[name] for name in NUMBERS]] = list(NUMBERS.values())
    monkeypatch.setattr(spin_chains, "COMPONENTS", 401)
    monkeypatch.setattr(spin_chains, "NARROW", 0.02)
    found = model_of(CONTACT, problem).row_deviances(p)[0]
    for chain in problem.chains:
        rows = np.concatenate([problem.x[chain][:, :2], problem.y[chain][:, :2]], axis=1)
        assert abs(found[chain].sum() - deviance(rows, 0.02, *NUMBERS.values(), points=2001)) < 0.02


def test_the_deviance_has_no_ripples() -> None:
    """With steps and ripples of half a unit descents stopped anywhere, by the last bit of a prediction."""
    model = model_of(CONTACT, problem_of(0))
    numbers = NUMBERS | {"friction": 0.16, "tangential_restitution": -0.02, "spin_mean": 0.0}
    for name, half, degree in (("spin_width", 0.15, 4), ("friction", 0.006, 4)):
        p, t = np.tile(model.start, (41, 1)), np.linspace(-1, 1, 41)
        p[:, [INDEX[one] for one in numbers]] = list(numbers.values())
        p[:, INDEX[name]] += half * t
        seen = np.array([model.evaluate(one[None], derivatives=False).deviance.sum() for one in p])
        assert np.abs(seen - np.polynomial.Polynomial.fit(t, seen, degree)(t)).max() < 0.25


def test_scores_and_information_are_those_of_the_deviance() -> None:
    model = model_of(CONTACT, problem_of(2))
    p = model.start.copy()
    p[[INDEX[name] for name in NUMBERS]] = list(NUMBERS.values())
    seen, step = model.evaluate(p[None]), 1e-5 * np.eye(len(p))[model.free]
    up, down = (model.evaluate(p + sign * step, derivatives=False).deviance.sum(axis=1) for sign in (1, -1))
    assert np.allclose(seen.scores[0], -0.5 * (up - down) / 2e-5, rtol=0.1, atol=2.0)
    assert (np.linalg.eigvalsh(seen.information[0]) > 0).all()


@pytest.mark.slow
def test_no_row_is_dropped_and_friction_is_known_as_with_measured_spins() -> None:
    seen, hidden = (fit_law(CONTACT, problem_of(4, spins=spins)) for spins in (True, False))
    assert len(hidden.problem.x) == 25
    for name, true in (("restitution", 0.75), ("friction", 0.15)):
        one, other = hidden.estimates[name], seen.estimates[name]
        assert abs(one.value - true) < 3 * one.stderr
        assert one.stderr < 1.4 * other.stderr
    assert 0.4 < hidden.chi2 / hidden.dof < 1.6
    # discs thrown without spin: a width of 0 forbids no decision, a wide one does
    for value, note in ((1e-3, ""), (3.0, "its spin_width is at a bound and its spin_width is 3, which no ball has")):
        bound = {"spin_width": Estimate(value, None, "at a bound")}
        assert unsettled(replace(hidden, estimates=hidden.estimates | bound)) == note


@pytest.mark.parametrize("name", ["shot", "drop", "ball"])
def test_a_chain_is_held_out_whole(name: str) -> None:
    """Contacts whose predecessor was in another fold had the prior of a first one: the true law scored -1316 a row."""
    rng, rows = np.random.default_rng(1), []
    for throw in range(6):
        spin = 0.0
        for bounce in range(1, 4):
            v_n, v_t = rng.uniform(0.5, 2), rng.uniform(-1.5, 1.5)
            after = (v_t + KAPPA * RADIUS * spin) / (
                1 + KAPPA
            )  # it sticks: a spin = v_t, and v_t + kappa a spin is conserved
            rows.append((throw, bounce, v_n, v_t, 0.8 * v_n, after))
            spin = after / RADIUS
    throw, bounce, *speeds = np.array(rows)[:17].T
    names = ("v_n_in", "v_t_in", "v_n_out", "v_t_out")
    columns = {one: speed + 0.01 * rng.normal(size=17) for one, speed in zip(names, speeds, strict=True)}
    columns |= {f"sigma_{one}": np.full(17, 0.01) for one in names}
    made = make_rebounds("planar", columns, extra={name: throw.astype(int), "bounce": bounce.astype(int)})
    problem = make_problem(*usable_rows(made, SETTING, spin=0.0))[0]
    assert problem.carried
    assert problem.units.tolist() == throw.tolist()
    assert problem.some(6).units.tolist() == [0, 0, 0, 1, 1]
    law = laws_named(["sticking"], "planar", upright=True)[0][0]
    assert -2 < cross_validated_score(fit_law(law, problem)) < 0


def test_rows_of_a_film_a_sheet_or_a_shot_are_held_out_together() -> None:
    speeds = {
        "v_n_in": np.arange(1.0, 9),
        "v_t_in": 0.5,
        "spin_in": 0.0,
        "v_n_out": np.arange(1.0, 9) * 0.8,
        "v_t_out": 0.4,
    }
    film, shot = np.array(list("bbbaaacc")), np.array([1, 1, 2, 1, 1, 2, 1, 2])
    units = {}
    for columns in ({}, {"film": film}, {"sheet": film}, {"shot": shot}, {"film": film[::-1] == "a", "shot": shot}):
        made = make_rebounds("planar", speeds | {"sigma_v_n_out": 0.1, "sigma_v_t_out": 0.1}, extra=columns)
        units["".join(columns)] = make_problem(made, SETTING)[0].units.tolist()
    assert units == {"": [0, 1, 2, 3, 4, 5, 6, 7], "film": [0, 0, 0, 1, 1, 1, 2, 2], "sheet": [0, 0, 0, 1, 1, 1, 2, 2],
                     "shot": [0, 1, 2, 3, 4, 5, 6, 7], "filmshot": [0, 0, 1, 2, 2, 3, 0, 3]}  # fmt: skip
