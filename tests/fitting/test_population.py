"""Surfaces as a population, in tables drawn from a known distribution of surfaces."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from reference.varying_bounces import RADIUS, drawn_table

import carom
from carom.data.rebounds import Rebounds, make_rebounds
from carom.fitting import Population, Setting, fit_population, make_problem
from carom.fitting.predictive import predictive_of

SETTING = Setting(radius=RADIUS, kappa=2 / 3)
RUBBERS = np.random.default_rng(0).normal((0.75, 0.6, 0.7), (0.03, 0.05, 0.05), (6, 3))


def rows_of(rubber: int, rows: int, seed: int) -> dict[str, Any]:
    e, mu, beta = RUBBERS[rubber]
    return drawn_table(rows, seed, lambda v: e + 0 * v, lambda s: mu + 0 * s, lambda s: beta + 0 * s, 0.2, bars=False)


def named(tables: dict[str, dict[str, Any]]) -> Rebounds:
    columns = {name: np.concatenate([table[name] for table in tables.values()]) for name in next(iter(tables.values()))}
    names = np.repeat(list(tables), [len(table["v_n_in"]) for table in tables.values()])
    return replace(make_rebounds("planar", columns), extra={"surface": names})


@pytest.fixture(scope="module")
def population() -> Population:
    return fit_population(named({f"rubber {j}": rows_of(j, 40, j) for j in range(5)}), SETTING)


def test_the_common_distribution_is_found_again(population: Population) -> None:
    assert population.names[:3] == ("restitution", "friction", "tangential_restitution")
    assert np.allclose(population.mean[:3], RUBBERS[:5].mean(axis=0), atol=0.03)
    assert np.all(population.width[:3] < (0.08, 0.12, 0.12))
    assert population.width[0] > 0.01
    # the scatter is the same for all, and its width is smaller than what each surface's rows say alone
    assert np.allclose(np.exp(population.mean[3:5]), 0.2, rtol=0.15)


def test_few_rows_are_drawn_to_the_mean_and_many_are_not(population: Population) -> None:
    few = population.add(make_rebounds("planar", rows_of(5, 4, 100)), SETTING).surfaces["new"]
    assert np.all(few.shrinkage[:3] > population.surfaces["rubber 0"].shrinkage[:3])
    assert population.surfaces["rubber 0"].shrinkage[0] < 0.2
    assert np.all(np.abs(few.values[:3] - population.mean[:3]) < 3 * population.width[:3])


def test_held_out_rows_of_a_new_surface_gain_by_the_others(population: Population) -> None:
    gains = []
    for seed in range(4):
        new = population.add(make_rebounds("planar", rows_of(5, 4, 100 + seed)), SETTING).surfaces["new"]
        rows = make_problem(make_rebounds("planar", rows_of(5, 60, 200 + seed)), SETTING)[0]
        gains.append(
            predictive_of(new.fit).log_density(rows).mean() - predictive_of(new.alone).log_density(rows).mean()
        )
    assert np.mean(gains) > 0.5


def test_a_new_surface_is_predicted_with_the_width_of_the_population(population: Population) -> None:
    new, known = population.predict([[6.0, 1.0, -200.0]]), population.predict([[6.0, 1.0, -200.0]], "rubber 0")
    assert np.all(new.stderr > 0.9 * known.stderr)
    assert population.as_dict()["surfaces"]["rubber 0"]["rows"] == 40
    with pytest.raises(carom.CaromError, match="expected one of rubber 0, rubber 1"):
        population.predict([[6.0, 1.0, -200.0]], "rubber 9")


def test_a_table_without_surfaces_is_refused() -> None:
    table = make_rebounds("planar", rows_of(0, 8, 1))
    with pytest.raises(carom.CaromError, match="column surface: expected a column that names the surface of each row"):
        fit_population(table, SETTING)
    with pytest.raises(carom.CaromError, match="expected two surfaces or more, of 3 rows or more, got 1 surface"):
        fit_population(named({"one": rows_of(0, 8, 1)}), SETTING)


def test_surfaces_of_one_table_have_a_common_distribution() -> None:
    rows = named({name: rows_of(j, 12, j) for j, name in enumerate(("hard", "soft", ""))})
    each = carom.fit(
        rows, RADIUS, inertia="hollow", laws="contact", by="surface", population=True, bootstrap=0, profiles=False
    )
    assert list(each) == ["hard", "soft", "(no surface)"]
    assert each.population.law == "contact"
    found = each.as_dict()["population"]["surfaces"]
    assert list(found) == ["(no surface)", "hard", "soft"]
    assert all(0 <= share <= 1 for one in found.values() for share in one["shrinkage"].values())
    with pytest.raises(carom.CaromError, match="`population`: expected `by` as well"):
        carom.fit(rows, RADIUS, population=True)
