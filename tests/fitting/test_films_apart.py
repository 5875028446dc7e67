"""Several films in one table: each measured its own floor, so their errors are their own."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from reference.synthetic_tracks import NOSE, RADIUS, Camera, seen, shot, surfaces

from carom.data import make_rebounds
from carom.fitting import Setting, fit_law, make_problem
from carom.fitting.laws import laws_named
from carom.fitting.shared_errors import film_says, shared_errors
from carom.tracks import Settings, measure, to_rebounds
from carom.tracks.films import combined_rebounds

V, OWN, CLOTH = 2.0, 0.01, 0.03  # m/s: speed, error of a row, error that a film's rows have in common


def films(sizes, seed=0, **more):
    """Balls square on to a cushion with restitution 0.8; the rows of each film are off together."""
    rng = np.random.default_rng(seed)
    film = np.repeat([f"film {k}" for k in range(len(sizes))], sizes)
    n = len(film)
    columns = {"v_n_in": np.full(n, V), "v_t_in": np.zeros(n), "spin_z_in": np.zeros(n), "v_t_out": np.zeros(n)}
    columns["v_n_out"] = 0.8 * V + CLOTH * np.repeat(rng.normal(size=len(sizes)), sizes) + OWN * rng.normal(size=n)
    columns |= {f"sigma_{name}": np.full(n, np.hypot(OWN, CLOTH)) for name in ("v_n_out", "v_t_out")}
    extra = {"film": film.astype(object), "cloth_v_n_out": np.full(n, CLOTH)} | more
    return make_rebounds("table", columns, stage="rolling", extra=extra)


@pytest.mark.parametrize("sizes", [(12, 6, 9), (12, 1, 1, 4), (1,) * 20])
def test_the_mean_over_films_is_known_as_far_as_films_differ(sizes):
    mirror = laws_named(["mirror"], "table", True)[0][0]
    fit = fit_law(mirror, make_problem(films(sizes), Setting(radius=0.03))[0])
    weight = 1 / (OWN**2 / np.array(sizes) + CLOTH**2)  # of each film's mean
    told = fit.estimates["restitution"]
    assert told.stderr == pytest.approx(weight.sum() ** -0.5 / V, rel=0.01)
    assert abs(told.value - 0.8) < 3 * told.stderr
    assert [one.name for one in fit.problem.shared] == [
        f"floor friction (film {k})" for k, size in enumerate(sizes) if size > 1
    ]
    assert 0.3 < fit.chi2 / fit.dof < 2


def test_the_law_s_floor_follows_every_film_with_its_weight():
    sizes, sigma = (3, 2, 1, 1), np.array([0.01, 0.02, 0.02, 0.04])
    told = {"floor_friction": np.repeat([0.2, 0.21, 0.19, 0.2], sizes), "sigma_floor_friction": np.repeat(sigma, sizes)}
    rebounds = films(sizes, **told)
    value, error, count = film_says(rebounds, "floor_friction")
    assert count == 4
    names = ("v_n_in", "v_t_in", "spin_z_in", "v_n_out", "v_t_out", "spin_z_out")
    found = {one.name: one for one in shared_errors(rebounds, names, error)}
    weight = sigma**-2 / (sigma**-2).sum()
    assert value == pytest.approx((weight * [0.2, 0.21, 0.19, 0.2]).sum())
    assert found["floor friction (film 0)"].floor == pytest.approx(weight[0] * sigma[0])
    assert found["floor friction (film 1)"].floor == pytest.approx(weight[1] * sigma[1])
    assert found["floor friction"].floor == pytest.approx(np.hypot(weight[2] * sigma[2], weight[3] * sigma[3]))
    assert np.sqrt(sum(one.floor**2 for one in found.values())) == pytest.approx(error)


def test_one_shot_per_film_is_fitted_by_the_law_that_made_it():
    rng = np.random.default_rng(6)
    on = replace(surfaces(rng), spin_mean=0.0, spin_width=0.0)
    settings = Settings(radius=0.0, view="above")
    tables = {}
    for k in range(14):
        found = to_rebounds(measure([seen(shot(rng, on=on), Camera(60, 4e-4), rng)], settings))
        tables[f"film {k}"] = found.select(np.arange(len(found)) == 0)
    columns = combined_rebounds(tables)
    given = {name: columns[name] for name in ("v_n_in", "v_t_in", "v_n_out", "v_t_out")} | {
        f"sigma_{name}": error for name, error in columns.sigma.items()
    }
    n = len(columns)
    rebounds = make_rebounds(
        "table", given | {"spin_z_in": np.zeros(n)}, stage=columns.stage, extra=dict(columns.extra)
    )
    law = laws_named(["two-step"], "table", True)[0][0]
    fit = fit_law(law, make_problem(rebounds, Setting(radius=RADIUS, contact_height=NOSE / RADIUS))[0])
    assert fit.chi2 < fit.dof + 4 * np.sqrt(2 * fit.dof)
    for name, value in (("restitution", on.restitution), ("friction", on.friction)):
        assert abs(fit.estimates[name].value - value) < 4 * fit.estimates[name].stderr
