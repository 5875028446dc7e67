"""From films to numbers of a law: what tracks measure is what laws say, and error bars hold the truth the whole way."""

from __future__ import annotations

import json
from dataclasses import replace

import numpy as np
import pytest
from reference.commands import command
from reference.exploring import tried
from reference.synthetic_tracks import NOSE, RADIUS, Camera, filmed, seen, shot, surfaces, truth
from reference.synthetic_verdicts import TRUTHS, verdict

from carom.data import make_rebounds
from carom.fitting import (
    Setting,
    fit_law,
    fit_laws,
    make_problem,
    with_bootstrap,
    with_profiles,
)
from carom.fitting.evidence import DECIDED
from carom.fitting.laws import (
    AFTER_WALL,
    INDEX,
    LAW_NUMBERS,
    PARAMETERS,
    ROLLING,
    TOGETHER,
    TURN,
    laws_named,
    table_rebound,
)
from carom.fitting.model import model_of, predict_law
from carom.tracks import Settings, measure, to_rebounds

CAMERA = Camera(50, 3e-4)


def record(p):
    """The parameters (K,) by their names."""
    return np.ascontiguousarray(p, float).view(LAW_NUMBERS).view(np.recarray)[0]


@pytest.mark.parametrize(("contact", "code"), [("after", TURN), ("with", TOGETHER)])
def test_laws_say_what_the_engine_does_with_a_ball_that_is_pressed_down(contact, code):
    # it lands in the instant in which it leaves the cushion; what the floor does then belongs to the contact
    rng = np.random.default_rng(3)
    for _ in range(4):
        on = surfaces(rng, contact)
        run = shot(rng, on=on)
        row = truth(run)[0]
        spin = next(event for event in run.events if event.kind == "wall").before.spin[2]
        p = np.array([parameter.value for parameter in PARAMETERS])
        p[INDEX["restitution"]], p[INDEX["friction"]] = on.restitution, on.friction
        p[INDEX["contact_height"]], p[INDEX["floor_friction"]] = NOSE / RADIUS, on.cloth
        before = (-row["vn_in"], row["vt_in"], spin)
        after = table_rebound(code, 0, AFTER_WALL, before, RADIUS, record(p))
        assert after[:2] == pytest.approx((row["vn_out"], row["vt_out"]), abs=1e-9)
        if "vn_roll" in row:
            rolls = table_rebound(code, 0, ROLLING, before, RADIUS, record(p))
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


def shifted(seed: int, n: int = 25, v: float = 2.0, own: float = 0.01, cloth: float = 0.03, rolling: float = 0.0):
    """Balls square on to a cushion, restitution 0.8, all with two errors in common; the rows and what errors do to them."""
    rng = np.random.default_rng(seed)
    z = rng.normal(size=2)
    columns = {"v_n_in": np.full(n, v), "v_t_in": np.zeros(n), "spin_z_in": np.zeros(n), "v_t_out": np.zeros(n)}
    columns["v_n_out"] = 0.8 * v + cloth * z[0] + rolling * z[1] + own * rng.normal(size=n)
    columns |= {f"sigma_{name}": np.full(n, np.sqrt(own**2 + cloth**2 + rolling**2)) for name in ("v_n_out", "v_t_out")}
    extra = {"cloth_v_n_out": np.full(n, cloth), "rolling_v_n_out": np.full(n, rolling)}
    return make_rebounds("table", columns, stage="rolling", extra=extra)


@pytest.mark.parametrize("rolling", [0.0, 0.02])
def test_profiles_and_bootstrap_have_the_errors_that_all_rows_share(rolling):
    own, cloth, v, n = 0.01, 0.03, 2.0, 25
    mirror = laws_named(["mirror"], "table", True)[0][0]
    fit = fit_law(mirror, make_problem(shifted(1, rolling=rolling), Setting(radius=0.03))[0])
    wanted = np.sqrt(own**2 / n + cloth**2 + rolling**2) / v
    one = with_bootstrap(with_profiles(fit), 400).estimates["restitution"]
    assert one.stderr == pytest.approx(wanted, rel=0.01)
    assert one.bootstrap == pytest.approx(wanted, rel=0.12)
    assert np.ptp(one.interval_68) / 2 == pytest.approx(wanted, rel=0.02)
    assert np.ptp(one.interval_95) / 2 == pytest.approx(1.96 * wanted, rel=0.02)
    # where all rows are off together no row is: what the law says is measured lies amid what was
    assert abs((fit.problem.y - fit.predicted())[:, 0].mean()) < 4 * own / np.sqrt(n)
    assert [one.name for one in fit.problem.shared] == ["floor friction", "rolling resistance"][: 1 + (rolling > 0)]


def test_a_fit_with_shared_errors_speaks_of_rows_without():
    mirror = laws_named(["mirror"], "table", True)[0][0]
    fit = fit_law(mirror, make_problem(shifted(1), Setting(radius=0.03))[0])
    assert len(fit.numbers) > len(PARAMETERS)
    plain = make_rebounds("table", {name: np.full(3, 2.0) for name in ("v_n_in", "v_n_out")} | {
        name: np.zeros(3) for name in ("v_t_in", "v_t_out", "spin_z_in")
    }, stage="rolling")  # fmt: skip
    said = predict_law(mirror, make_problem(plain, Setting(radius=0.03))[0], fit.numbers)
    assert said[0, 0] == pytest.approx(2.0 * fit.estimates["restitution"].value)


def test_error_bars_hold_with_shared_errors():
    mirror = laws_named(["mirror"], "table", True)[0][0]
    off, count = [], tried(80, 300)
    for seed in range(count):
        fit = fit_law(mirror, make_problem(shifted(seed, rolling=0.02), Setting(radius=0.03))[0])
        off.append((fit.estimates["restitution"].value - 0.8) / fit.estimates["restitution"].stderr)
    assert np.mean(np.abs(off) < 1) == pytest.approx(0.683, abs=3 * np.sqrt(0.683 * 0.317 / count))
    assert np.mean(np.abs(off) < 1.96) == pytest.approx(0.95, abs=3 * np.sqrt(0.95 * 0.05 / count))


def test_the_film_s_error_of_the_floor_is_the_law_s_too():
    # the law with the floor's friction one error bar to either side: by so much its numbers are uncertain
    rng = np.random.default_rng(2)
    law = laws_named(["two-step-after"], "table", False)[0][0]
    p = np.array([parameter.value for parameter in PARAMETERS])
    p[INDEX["restitution"]], p[INDEX["friction"]], p[INDEX["contact_height"]] = 0.85, 0.15, 1.2
    v_n, v_t, spin = rng.uniform(0.8, 2.5, 30), rng.uniform(-1.5, 1.5, 30), rng.normal(0, 15, 30)
    said = np.array(
        [table_rebound(TURN, 0, AFTER_WALL, row, RADIUS, record(p)) for row in zip(v_n, v_t, spin, strict=True)]
    )
    columns = {"v_n_in": v_n, "v_t_in": v_t, "spin_z_in": spin, "v_n_out": said[:, 0], "v_t_out": said[:, 1]}
    columns |= {f"sigma_{name}": np.full(30, 0.002) for name in ("v_n_out", "v_t_out")}
    film = {
        "floor_friction": np.full(30, 0.2),
        "sigma_floor_friction": np.full(30, 0.02),
        "cloth_v_n_out": np.full(30, 1e-9),
    }
    rebounds = make_rebounds("table", columns, stage="after_wall", extra=film)
    height = 1.2
    told, low, high = (
        fit_law(law, make_problem(rebounds, Setting(radius=RADIUS, contact_height=height, floor_friction=floor))[0])
        for floor in (None, 0.18, 0.22)
    )
    held = fit_law(law, make_problem(rebounds, Setting(radius=RADIUS, contact_height=height, floor_friction=0.2))[0])
    assert abs(told.numbers[len(PARAMETERS)]) < 0.1
    ends = np.array([[fit.estimates["restitution"].value, fit.deviance] for fit in (low, high)])
    follows, curve = (ends[1, 0] - ends[0, 0]) / 2, ends[:, 1].mean() - held.deviance + 1
    wanted = np.sqrt(held.estimates["restitution"].stderr ** 2 + follows**2 / curve)
    assert told.estimates["restitution"].stderr == pytest.approx(wanted, rel=0.05)
    assert told.estimates["restitution"].stderr > 1.3 * held.estimates["restitution"].stderr


def test_what_rolling_resistance_does_to_the_rows_is_what_it_does():
    rng = np.random.default_rng(5)
    on = surfaces(rng, "after")
    films = [replace(seen(shot(rng, on=on), CAMERA, rng), group=f"shot {k}") for k in range(8)]
    free = measure(films, Settings(radius=0.0, view="above", noise=3e-4))
    value, error = free.floor["rolling resistance"]
    table = to_rebounds(free)
    cloth = free.floor["floor friction"][0]
    ends = [
        to_rebounds(
            measure(
                films,
                Settings(radius=0.0, view="above", noise=3e-4, floor_friction=cloth, rolling_resistance=value + step),
            )
        )
        for step in (-error, error)
    ]
    assert np.array_equal(ends[0].extra["contact"], table.extra["contact"])
    for name in ("v_n_in", "v_n_out"):
        moves = (ends[1][name] - ends[0][name]) / 2
        said = table.extra[f"rolling_{name}"]
        assert np.abs(moves).max() > 2e-4
        assert np.corrcoef(moves, said)[0, 1] > 0.98
        assert np.dot(moves, said) / np.dot(moves, moves) == pytest.approx(1, abs=0.3)


def test_from_a_film_to_restitution_and_friction():
    # all speeds hang on the cloth: taken for independent, the rows say more than they know
    on, measured, rebounds = filmed("after", CAMERA, 8, 30)
    setting = Setting(radius=RADIUS, contact_height=NOSE / RADIUS, floor_friction=measured.floor["floor friction"][0])
    law = laws_named(["two-step-after"], "table", False)[0][0]
    fit = fit_law(law, make_problem(rebounds, setting)[0])
    for name in ("restitution", "friction", "spin_mean", "spin_width"):
        assert abs(fit.estimates[name].value - getattr(on, name)) < 2.5 * fit.estimates[name].stderr, name
    assert fit.chi2 < fit.dof + 3 * np.sqrt(2 * fit.dof)
    # what is likeliest of a width is too small on average
    assert fit.estimates["spin_width"].value > fit.numbers[INDEX["spin_width"]]
    bare = replace(
        rebounds,
        extra={name: one for name, one in rebounds.extra.items() if not name.startswith(("cloth_", "rolling_"))},
    )
    alone = fit_law(law, make_problem(bare, setting)[0]).estimates["restitution"]
    assert fit.estimates["restitution"].stderr > 1.3 * alone.stderr
    assert abs(alone.value - on.restitution) > 2 * alone.stderr


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
    ("tangential compliance", 1.0, {"true", "cannot"}), ("sliding, no row that holds", 1.0, {"cannot"}),
    ("tangential compliance", 10.0, {"cannot"}),
])  # fmt: skip
@pytest.mark.slow(keep=1)
def test_the_true_law_wins_when_it_can(name, noise, says):
    # cannot: a law that contains the true one is a hair ahead, by chance (so is stronge, another law of tangential compliance);
    # else it must be the true one that wins
    found = [verdict(TRUTHS[name], noise, seed) for seed in range(4)]
    assert {one["verdict"] for one in found} <= says
    if "true" in says:
        assert all(one["right"] for one in found)
        # (stronge with a restitution that falls with the speed is as good as compliance in most of them: it depends on the form)
        assert sum(one["verdict"] == "true" for one in found) >= (1 if name == "tangential compliance" else 2)


@pytest.mark.parametrize(("law", "floor_contact", "shots", "seed", "decides"), [
    ("two-step-after", "after", 5, 2, True), ("two-step-after", "after", 5, 3, True), ("two-step", "with", 5, 1, True),
    ("two-step", "with", 5, 0, False), ("two-step", "with", 5, 2, False),
])  # fmt: skip
@pytest.mark.slow(keep=2)
def test_films_decide_where_they_can(law, floor_contact, shots, seed, decides):
    # nobody measured a sidespin; balls of few shots may have had what makes another law as likely
    rebounds = filmed(floor_contact, CAMERA, seed, shots)[2]
    setting = Setting(radius=RADIUS, contact_height=NOSE / RADIUS)
    laws = ["two-step-after", "two-step", "no-slip", "mirror"]
    ranking = fit_laws(rebounds, setting, laws, profiles=False, bootstrap=0)
    assert ranking.fits
    assert (ranking.odds >= DECIDED) is decides
    if decides:
        assert ranking.best.law.name == law
    assert ranking.ranked[-1].fit.law.name == "mirror"
    assert ranking.ranked[-1].weight < 1e-9


def fitted_film(camera: Camera, seed: int):
    """A film of twenty shots under its law: the surfaces that were played, and the fit."""
    on, _measured, rebounds = filmed("after", camera, seed, 20)
    law = laws_named(["two-step-after"], "table", False)[0][0]
    return on, fit_law(law, make_problem(rebounds, Setting(radius=RADIUS, contact_height=NOSE / RADIUS))[0])


def test_a_cloth_that_seems_to_differ_is_each_row_s_own_error():
    # contacts differ by chance in what they say of the cloth; where each keeps its own opinion, all do not share its error: the
    # fits were seven error bars off
    on, fit = fitted_film(Camera(30, 3e-4), 868)
    for name in ("restitution", "friction"):
        assert abs(fit.estimates[name].value - getattr(on, name)) < 2 * fit.estimates[name].stderr


def test_an_interval_of_two_valleys_makes_the_error_bar():
    on, bare = fitted_film(Camera(30, 3e-4), 64)
    fit = with_profiles(bare, ["restitution", "friction"])
    for name in ("restitution", "friction"):
        one = fit.estimates[name]
        low, high = one.interval_95
        assert low < getattr(on, name) < high
        # the curvature is that of the nearer valley alone
        assert one.interval_68[1] - one.interval_68[0] < 0.3 * (high - low)
        assert one.stderr == pytest.approx((high - low) / 2 / 1.96, rel=1e-3)
        assert one.stderr > 5 * bare.estimates[name].stderr
        i = fit.names.index(name)
        assert fit.covariance[i, i] == pytest.approx(one.stderr**2)


def rolling(n: int = 12, **extra: object) -> dict[str, object]:
    """Columns of balls that roll at a cushion, of a file."""
    v_n, v_t = np.linspace(0.8, 2.5, n), np.linspace(-1, 1.2, n)
    columns: dict[str, object] = {
        "v_n_in": v_n,
        "v_t_in": v_t,
        "v_n_out": 0.6 * v_n,
        "v_t_out": 0.8 * v_t,
        "spin_z_in": 0 * v_n,
    }
    return columns | {f"sigma_{name}": np.full(n, 0.01) for name in ("v_n_out", "v_t_out")} | extra


def test_the_floor_is_what_the_film_says():
    def floor(setting: Setting | None = None, **extra: np.ndarray) -> tuple[float | None, str]:
        rebounds = make_rebounds("table", rolling(), stage="rolling", extra=extra)  # type: ignore[arg-type]
        problem, notes = make_problem(rebounds, setting or Setting(radius=RADIUS))
        return problem.setting.floor_friction, " ".join(note for note in notes if note.startswith("`floor_friction`"))

    says = {"floor_friction": np.full(12, "0.23"), "sigma_floor_friction": np.full(12, "0.004")}  # as a file has it
    assert floor() == (
        0.2,
        "`floor_friction` is not given: assumed to be 0.2; give it, or `fit` floor_friction",
    )
    value, said = floor(**says)
    assert value == 0.23
    assert "0.23 ± 0.004, from the film" in said
    assert floor(Setting(radius=RADIUS, floor_friction=0.3), **says) == (0.3, "")
    assert floor(Setting(radius=RADIUS, fit=("floor_friction",)), **says) == (0.23, "")
    # of two films the one that knows better counts more; a film that did not measure it has no say
    two = {
        "floor_friction": np.repeat([0.2, 0.24, np.nan], 4),
        "sigma_floor_friction": np.repeat([0.01, 0.02, np.nan], 4),
    }
    value, said = floor(**two)
    assert value == pytest.approx((4 * 0.2 + 0.24) / 5)
    assert "2 films" in said
    # a number that is held without being fitted is held
    problem, _ = make_problem(
        make_rebounds("table", rolling(), stage="rolling", extra=says),  # type: ignore[arg-type]
        Setting(radius=RADIUS, fixed={"floor_friction": 0.1}),
    )
    law = laws_named(["two-step"], "table", True)[0][0]
    assert model_of(law, problem).start[INDEX["floor_friction"]] == 0.1


@pytest.mark.slow
def test_a_film_says_it_as_far_as_the_page(tmp_path, monkeypatch, capsys):
    rng = np.random.default_rng(11)
    on = replace(surfaces(rng, "after"), cloth=0.26)
    films = [replace(seen(shot(rng, on=on), CAMERA, rng), group=f"shot {k}") for k in range(4)]
    measured = measure(films, Settings(radius=0.0, view="above"))
    to_rebounds(measured).save(tmp_path / "rebounds.csv")
    value, error = measured.floor["floor friction"]
    assert abs(value - 0.26) < 4 * error < 0.1
    monkeypatch.chdir(tmp_path)
    words = ("fit", "rebounds.csv", "--radius", str(RADIUS), "--laws", "mirror", "--contact-height", "1.2", "--json")
    code, out, err = command(capsys, *words, "--report", "page.html")
    assert code == 0
    assert json.loads(out)["setting"]["floor_friction"] == value
    assert f"--floor-friction is {value:.4g} ± {error:.2g}, from the film" in err
    page = (tmp_path / "page.html").read_text()
    assert f"friction of the cloth {value:.4g}" in page
    assert f"{value:.4g} ± {error:.2g}, from the film" in page
    code, out, err = command(capsys, *words, "--floor-friction", "0.3")
    assert json.loads(out)["setting"]["floor_friction"] == 0.3
    assert "from the film" not in err
    # which shot next, with a film of which nobody knows the sidespins
    shots = (
        "design",
        "rebounds.csv",
        "--radius",
        str(RADIUS),
        "--laws",
        "two-step-after,mirror",
        "--contact-height",
        "1.2",
    )
    code, out, err = command(capsys, *shots, "--sigma-v", "0.05", "--spins", "unknown", "--json")
    plan = json.loads(out)
    assert code == 0
    assert f"--floor-friction is {value:.4g} ± {error:.2g}, from the film" in err
    assert plan["filmed_2_log_odds"] > 10
    assert {"spin_mean", "spin_width"} <= set(plan["truth"])
    assert plan["map"]["spin"] == [None]
    assert plan["sentence"].startswith("The film gives odds of")
