"""From films to numbers of a law: what tracks measure is what laws say, and error bars hold the truth the whole way."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from track_truth import NOSE, RADIUS, Camera, seen, shot, surfaces, truth
from verdict_truth import TRUTHS, verdict

from carom.fitting import Setting, fit_law, make_problem
from carom.fitting.kernels import AFTER_WALL, ROLLING, TOGETHER, TURN, table
from carom.fitting.laws import laws_named
from carom.fitting.parameters import INDEX, PARAMETERS
from carom.rebounds import make_rebounds
from carom.tracks.measure import Settings, measure
from carom.tracks.table import to_rebounds

CAMERA = Camera(50, 3e-4)


@pytest.mark.parametrize(("contact", "code"), [("after", TURN), ("with", TOGETHER)])
def test_laws_say_what_the_engine_does_with_a_ball_that_is_pressed_down(contact, code):
    # it lands in the instant in which it leaves the cushion; what the floor does then belongs to the contact
    rng = np.random.default_rng(3)
    for _ in range(4):
        on = surfaces(rng, contact)
        run = shot(rng, on=on)
        row = truth(run)[0]
        spin = next(event for event in run.events if event.kind == "wall").before.spin[2]
        p = np.array([parameter.start for parameter in PARAMETERS])
        p[INDEX["restitution"]], p[INDEX["friction"]] = on.restitution, on.friction
        p[INDEX["contact_height"]], p[INDEX["floor_friction"]] = NOSE / RADIUS, on.cloth
        before = (-row["vn_in"], row["vt_in"], spin)
        after = table(code, 0, AFTER_WALL, before, RADIUS, p)
        assert after[:2] == pytest.approx((row["vn_out"], row["vt_out"]), abs=1e-9)
        if "vn_roll" in row:
            rolls = table(code, 0, ROLLING, before, RADIUS, p)
            assert rolls[:2] == pytest.approx((row["vn_roll"], row["vt_roll"]), abs=1e-9)


def test_the_cloth_s_error_is_one_for_all_rows():
    # all rows alike: restitution is their mean over the speed, and the cloth moves all of them
    n, v, own, shared = 25, 2.0, 0.01, 0.03
    rng = np.random.default_rng(0)
    columns = {"v_n_in": np.full(n, v), "v_t_in": np.zeros(n), "v_n_out": 0.8 * v + shared + own * rng.normal(size=n),
               "v_t_out": np.zeros(n)}  # fmt: skip
    for name in ("v_n_out", "v_t_out"):
        columns[f"sigma_{name}"] = np.full(n, np.hypot(own, shared))
    columns |= {"spin_z_in": np.zeros(n)}
    moved = {"cloth_v_n_out": np.full(n, str(shared))}  # as a file has it
    mirror = laws_named(["mirror"], "table", True)[0][0]
    fits = [
        fit_law(
            mirror, make_problem(make_rebounds("table", columns, stage="rolling", extra=extra), Setting(radius=0.03))[0]
        )
        for extra in ({}, moved)
    ]
    by_itself, together = (fit.estimates["restitution"] for fit in fits)
    assert by_itself.stderr == pytest.approx(np.hypot(own, shared) / v / np.sqrt(n), rel=1e-3)
    assert together.stderr == pytest.approx(np.sqrt(own**2 / n + shared**2) / v, rel=0.01)
    assert abs(together.value - 0.8) < 1.5 * together.stderr
    assert abs(by_itself.value - 0.8) > 2 * by_itself.stderr
    # (a law with an infinite friction: what is infinite does not follow, and no one is warned of it)
    holds = laws_named(["no-slip"], "table", True)[0][0]
    rebounds = make_rebounds("table", columns, stage="rolling", extra=moved)
    assert np.isfinite(fit_law(holds, make_problem(rebounds, Setting(radius=0.03))[0]).covariance).all()


def test_from_a_film_to_restitution_and_friction():
    # here the cloth is measured 1.6 of its error bars too low, and with it every speed after the cushion
    rng = np.random.default_rng(7)
    on = surfaces(rng, "after")
    runs = [shot(rng, on=on) for _ in range(30)]
    films = [replace(seen(run, CAMERA, rng), group=f"shot {k}") for k, run in enumerate(runs)]
    measured = measure(films, Settings(radius=0.0, view="above"))
    rebounds = to_rebounds(measured)
    names = rebounds.extra["shot"].tolist()
    rebounds = rebounds.select(np.array([names.index(name) for name in dict.fromkeys(names)]))
    setting = Setting(radius=RADIUS, contact_height=NOSE / RADIUS, floor_friction=measured.floor["cloth friction"][0])
    law = laws_named(["two-step-after"], "table", False)[0][0]
    fit = fit_law(law, make_problem(rebounds, setting)[0])
    for name in ("restitution", "friction", "spin_mean", "spin_width"):
        assert abs(fit.estimates[name].value - getattr(on, name)) < 2.5 * fit.estimates[name].stderr, name
    assert fit.chi2 < fit.dof + 3 * np.sqrt(2 * fit.dof)
    # what is likeliest of a width is too small on average
    assert fit.estimates["spin_width"].value > fit.numbers[INDEX["spin_width"]]
    bare = replace(rebounds, extra={name: one for name, one in rebounds.extra.items() if not name.startswith("cloth_")})
    alone = fit_law(law, make_problem(bare, setting)[0]).estimates["restitution"]
    assert abs(alone.value - on.restitution) > 3 * alone.stderr


def test_a_slide_after_the_wall_that_was_found_once_is_found_again():
    rng = np.random.default_rng(1003)
    on = replace(surfaces(rng, "with"), friction=rng.uniform(0.1, 0.25), cloth=0.2)
    runs = [shot(rng, on=on) for _ in range(30)]
    films = [replace(seen(run, CAMERA, rng), group=f"shot {k}") for k, run in enumerate(runs)]
    measured = measure([films[8], *films[:6]], Settings(radius=0.0, view="above"))
    contact = next(one for one in measured.contacts if one.group == "shot 8" and abs(one.time - 0.944) < 0.02)
    wanted = min(truth(runs[8]), key=lambda row: abs(row["t"] - contact.time))
    assert contact.fit is not None
    assert abs(contact.fit["slides"] - wanted["slides"]) < 0.02
    assert abs(contact.fit["vn_roll"] - wanted["vn_roll"]) < 3 * contact.fit.error("vn_roll")


@pytest.mark.parametrize(("name", "noise", "says"), [
    ("sliding", 1.0, {"true", "cannot"}), ("no-slip", 1.0, {"true", "cannot"}), ("tangential restitution 0.3", 1.0, {"true"}),
    ("tangential compliance", 1.0, {"true"}), ("sliding, no row that holds", 1.0, {"cannot"}),
    ("tangential compliance", 10.0, {"cannot"}),
])  # fmt: skip
def test_the_true_law_wins_when_it_can(name, noise, says):
    # cannot: a law that contains the true one is a hair ahead, by chance; else it must be the true one that wins
    found = [verdict(TRUTHS[name], noise, seed) for seed in range(4)]
    assert {one["verdict"] for one in found} <= says
    if "true" in says:
        assert all(one["right"] for one in found)
        assert sum(one["verdict"] == "true" for one in found) >= 2
