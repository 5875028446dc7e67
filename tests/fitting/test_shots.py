"""Whole shots: simulated films give their numbers back; derivatives; events; bad films."""

import json
import math
import pickle
import re
from dataclasses import replace

import numpy as np
import pytest

import carom
from carom.core.motion.phases import REST
from carom.fitting.identify import NOT_IDENTIFIABLE, Identified
from carom.fitting.result import Estimate
from carom.fitting.shots import drawn_films
from carom.fitting.shots.fit import DRAWS, _Together
from carom.fitting.shots.joint import (
    PRIOR_WIDTH,
    JointFit,
    Optimum,
    TablePrior,
    fit_scatter,
    frames_of_events,
    identified,
    in_combination,
    likely_widths,
    searched_together,
)
from carom.fitting.shots.result import FREE, TERMS, TableModel, begun, scene_of_films
from carom.fitting.shots.search import (
    VELOCITY,
    SearchSettings,
    _drawn,
    descend,
    filmed_shots,
    residuals,
    rms,
    search_start,
)
from carom.simulation.records import set_up
from carom.simulation.sensitivity.follow import parameters_of
from carom.tracks import Track

RADIUS = 0.03075
TRUTH = {"walls.0.restitution": 0.85, "floor.friction": 0.19, "ball_contact.friction": 0.06}


@pytest.fixture(scope="module")
def films():
    return drawn_films(2, seed=5, until=2.5)


@pytest.fixture(scope="module")
def ranking(films):
    tracks, scenes = films
    begin = {
        "walls.0.restitution": 0.82,
        "floor.friction": 0.2,
        "ball_contact.friction": 0.05,
    }
    table = carom.replaced(scenes[0], begin)
    return carom.fit_shots(tracks, table, free=list(TRUTH), seed=1)


def test_the_numbers_of_the_table_come_back(ranking, films):
    for name, true in TRUTH.items():
        found = ranking.best.estimates[name]
        assert abs(found.value - true) < 4 * found.stderr, name
        assert found.stderr < 0.05 * true + 0.002, name
    # numbers of few shots are those of all their events
    assert ranking.best.events == max(len(one.film.events) for one in ranking.best.shots)


def test_the_starts_come_back_and_the_film_is_followed(ranking, films):
    _tracks, scenes = films
    for one, scene in zip(ranking.best.shots, scenes, strict=True):
        assert one.followed
        assert one.rms < 2.5e-3
        assert np.abs(one.velocity - scene.balls[0].state.velocity[:2]).max() < 0.08
        match = one.events()
        assert (match.model_only, match.film_only) == ([], [])
        after = one.stroke.on(carom.Ball(RADIUS, 0.21)).state
        assert after.velocity[:2] == pytest.approx(one.velocity, abs=0.05)
    assert ranking.best.median("ball") < 2.5e-3
    assert "is the only law that was compared: the median distance of its shots" in ranking.verdict
    assert any("to rest" in line for line in ranking.describe())


def test_the_result_pickles_prints_and_goes_to_json(ranking):
    again = pickle.loads(pickle.dumps(ranking))
    assert again.best.shots[0].rms == ranking.best.shots[0].rms
    # (arrays made of a scene have addresses of the process)
    assert set(vars(again.best.model)) == {"scene", "paths", "bounds"} < set(vars(ranking.best.model))
    assert again.best.median() == ranking.best.median()
    assert "2 shots" in repr(ranking.best)
    text = json.dumps(ranking.as_dict())
    assert len(json.loads(text)["ranking"][0]["shots"]) == 2
    with pytest.raises(carom.CaromError, match="one of ball"):
        ranking.best.horizon("cushion 9")


def test_pictures_say_what_is_drawn(ranking, tmp_path):
    from carom.plot.fit import plot_shot, plot_shots, write_shots_report

    one = plot_shot(ranking.best.shots[0])
    words = [text.get_text() for legend in one.legends for text in legend.get_texts()]
    assert words[0] == "ball 1, struck by the cue"
    assert words[3:] == ["film", "model", "start", "contact in the model", "contact in the film"]
    # the title and the legends of few small multiples are not cut off
    few = plot_shots(replace(ranking.best, shots=ranking.best.shots[:1]))
    few.canvas.draw()
    (drawn,) = few.subfigs
    for part in (drawn._suptitle, *drawn.legends):
        box = part.get_window_extent()
        assert 0 <= box.x0 < box.x1 <= few.bbox.x1
        assert 0 <= box.y0 < box.y1 <= few.bbox.y1
    text = write_shots_report(ranking, "films.csv", tmp_path / "shots.html").read_text(encoding="utf-8")
    assert ">nan<" not in text  # (no shot goes through three cushions)
    assert [text.count(f"<h3>{shot.name}: ") for shot in ranking.best.shots] == [1, 1]
    # small multiples, distances over time and against incidence, speed, shot, the legend, and two of each shot
    assert text.count("<svg") == 2 + 1 + 3 + 1 + 2 * 2
    against = {
        axes.get_xlabel(): axes.lines[0].get_ydata() for axes in plot_shots(ranking.best).axes if axes.get_xlabel()
    }
    assert list(against) == ["incidence, degrees", "speed, m/s", "shot"]
    assert against["shot"] == pytest.approx([1e3 * shot.rms for shot in ranking.best.shots])
    assert "<td>walls.0.restitution</td>" in text
    assert "prefers-color-scheme: dark" in text


def test_derivatives_are_central_differences(films):
    tracks, scenes = films
    found = filmed_shots(tracks, RADIUS)
    scene, paths = begun(scene_of_films(scenes[0], found, None, 3, 60.0, "test"), FREE)
    model = TableModel(scene, paths, {})
    shot, values = found.shots[1], np.array([one.value for one in model.shared])
    table, frames, p = model.at(values), len(found.shots[1].time), len(model.shared)
    # the deviations of this shot's table from that of all shots come after its own numbers
    deviations = 0.1 * np.array([one.scale for one in model.shared])
    start = np.array(
        [
            0.01,
            *scenes[1].balls[0].state.velocity[:2],
            *RADIUS * np.array(scenes[1].balls[0].state.spin),
            *shot.first.ravel(),
            *deviations,
        ]
    )
    at = residuals(table, shot, start[None], frames)
    for k in range(len(start)):
        h = 1e-6 * np.eye(len(start))[k]
        ends = [residuals(table, shot, (start + sign * h)[None], frames).gap[0] for sign in (1, -1)]
        by = at.by_start[0, :, k]
        assert np.abs((ends[0] - ends[1]) / 2e-6 - by).max() < 1e-3 * max(1.0, np.abs(by).max())
    # and a table with such deviations is the table at these numbers
    again = residuals(model.at(values + deviations), shot, start[None, :-p], frames, shared=True)
    assert np.abs(again.gap - at.gap).max() < 1e-9
    assert np.abs(again.by_shared - at.by_start[..., -p:]).max() < 1e-6 * np.abs(again.by_shared).max()


def test_derivatives_at_other_numbers_are_those_of_a_scene_there(films):
    tracks, scenes = films
    found = filmed_shots(tracks, RADIUS)
    scene, paths = begun(scene_of_films(scenes[0], found, None, 3, 60.0, "test"), FREE)
    falling = {"at_rest": 0.1, "at_speed": 0.05, "speed": 0.9}
    bent = carom.replaced(scene, {"ball_contact.friction": falling})
    for model, affine in (
        (TableModel(scene, paths, {}), True),
        (TableModel(bent, ("ball_contact.friction.speed", "walls.0.length"), {}), False),
    ):
        values = np.array([one.value + 0.3 * one.scale for one in model.shared])
        table = model.at(values)
        there = parameters_of(table.scene, table.arrays, model.paths, [REST] * 3)
        first = model.at(np.array([one.value for one in model.shared])).parameters
        assert (table.parameters.slopes is first.slopes) == affine
        for one, other in zip(table.parameters.slopes, there.slopes, strict=True):
            for name in ("world", "features"):
                for field, slope in other[name].items():
                    assert np.abs(one[name][field] - slope).max() <= 1e-9 * max(np.abs(slope).max(), 1.0), field


def test_starts_descend_together_as_each_alone(films):
    tracks, scenes = films
    found = filmed_shots(tracks, RADIUS)
    model = TableModel(scene_of_films(scenes[0], found, None, 3, 60.0, "test"), ("walls.0.restitution",), {})
    table, shot = model.at(np.array([0.85])), found.shots[0]
    start = search_start(table, shot, found.noise, np.random.default_rng(0), SearchSettings(), widths=np.array([0.02]))
    frames = shot.horizons["ball"]
    tries = np.array([*start.pool[:3], start.best[frames]])
    together = descend(table, shot, tries, frames, start.prior, 2e-3, 6)
    for one, (best, cost, information) in zip(tries, together, strict=True):
        ((alone, least, known),) = descend(table, shot, one[None], frames, start.prior, 2e-3, 6)
        assert best == pytest.approx(alone, rel=1e-6, abs=1e-9)
        assert cost == pytest.approx(least, rel=1e-9)
        assert information == pytest.approx(known, rel=1e-6, abs=1e-6 * np.abs(known).max())


def test_starts_are_drawn_with_the_other_side_spin_too():
    start = np.array([0.01, 4.0, 0.0, 0.0, 1.6, 2.0, *np.zeros(6)])
    other = [
        float((_drawn(start, 1e8 * np.eye(12), 400, np.random.default_rng(0), 1.0, 12, anew)[:, 5] < -1.0).mean())
        for anew in (0.0, 0.3)
    ]
    assert other[0] < 0.02
    assert 0.05 < other[1] < 0.2


def test_a_shot_that_is_far_is_searched_again_without_its_starts():
    tracks, scenes = drawn_films(3, seed=5, until=1.5)
    films, none = filmed_shots(tracks, RADIUS), np.zeros(0)
    model = TableModel(scene_of_films(scenes[0], films, None, 3, 60.0, "test"), (), {})
    together = _Together(model, films, 0, lambda _done, _text: None)
    starts = together.searched(none, [None] * 3, 0.0, 0.0, together.events)
    astray, n = starts[1], max(starts[1].best)
    wrong = astray.best[n].copy()
    wrong[VELOCITY] *= 0.5
    astray.best, astray.pool = {n: wrong}, [wrong]
    before = [len(one.pool) for one in starts]
    together.searched_again(none, starts, 0)
    assert [len(one.pool) - size for one, size in zip(starts, before, strict=True)] == [0, DRAWS, 0]
    assert rms(model.at(none), astray.shot, astray.pool[-1], n) < 2.5e-3


@pytest.mark.slow
def test_a_number_that_one_shot_does_not_tell_stays_near_that_of_the_table():
    tracks, scenes = drawn_films(1, seed=3, until=0.6)
    best = carom.fit_shots(tracks, scenes[0], seed=1).best
    for one, value in zip(best.model.shared, best.values, strict=True):
        assert abs(value - one.value) < 1.5 * PRIOR_WIDTH * one.scale, one.name
    assert best.shots[0].followed
    known = TablePrior(np.array([0.8, 2.0]), np.array([0.02, 0.5]), 0.03)
    at = np.array([0.85, 1.0])
    score, half = known.information(at)
    for k in range(2):
        h = 1e-4 * known.scale * np.eye(2)[k]
        up, down = known.cost(at + h), known.cost(at - h)
        assert -(up - down) / 2e-4 / 2 == pytest.approx(score[k], rel=1e-6)
        assert (up - 2 * known.cost(at) + down) / 1e-8 / 2 == pytest.approx(half[k, k], rel=1e-4)


def test_terms_that_a_scene_leaves_at_zero_begin_at_a_usual_value(films):
    _tracks, scenes = films
    scene, paths = begun(scenes[0], FREE)
    assert scene.walls[0].yield_time == TERMS["walls.0.yield_time"]
    assert set(TERMS) < set(paths)
    # one law of the loss of spin: the one that is asked for, or that the scene has
    assert "floor.spin_drag" not in begun(scenes[0], [*FREE, "floor.spin_damping"])[1]
    damped = carom.replaced(scenes[0], {"floor.spin_damping": 0.1})
    assert "floor.spin_drag" not in begun(damped, FREE)[1]


@pytest.mark.slow
def test_a_scatter_between_shots_is_found_and_widens_the_errors():
    name, spread = "walls.0.restitution", 0.04
    tracks, scenes = drawn_films(5, seed=3, until=0.6, scatter={name: spread})
    table = carom.replaced(scenes[0], {name: 0.85})
    best = carom.fit_shots(tracks, table, free=[name], seed=1).best
    met = np.array([one.restitution.value for one in (scene.walls[0] for scene in scenes)])
    assert 0.3 * met.std() < best.scatter[name] < 3 * met.std()
    estimate = best.estimates[name]
    assert estimate.stderr > 0.5 * best.scatter[name] / np.sqrt(len(met))
    assert abs(estimate.value - 0.85) < 3 * estimate.stderr
    own = [one.scene.walls[0].restitution.value for one in best.shots]
    assert own == pytest.approx([estimate.value + one.deviations[name] for one in best.shots], abs=1e-12)
    # laws are compared on one table for all shots, as AICc is
    again = searched_together([best, best], lambda _done, _text: None)
    assert [one.deviance for one in again] == pytest.approx([best.deviance] * 2, abs=0.1)


@pytest.mark.slow
def test_error_bars_hold_the_difference_of_two_halves_that_never_saw_each_other():
    name = "floor.friction"
    tracks, scenes = drawn_films(10, seed=3, until=0.6)
    # every other film has another scale, so that its cloth has another friction
    for one in tracks:
        if int(one.group.split()[-1]) % 2:
            one.position[:] = scenes[0].walls[0].center + 1.03 * (one.position - scenes[0].walls[0].center)
    table = carom.replaced(scenes[0], {"walls.0.length": 2.9, "walls.0.width": 1.5})
    alone = [
        carom.fit_shots([one for one in tracks if int(one.group.split()[-1]) % 2 == odd], table, free=[name]).best
        for odd in (1, 0)
    ]
    first, second = (one.estimates[name] for one in alone)
    both = carom.fit_shots(tracks, table, free=[name]).best
    apart = (first.value - second.value) / math.hypot(first.stderr, second.stderr)
    # (the noise of a frame is that of all films)
    assert both.halves == pytest.approx((apart**2, 1), rel=0.02)
    assert both.halves.enlarge > 1.5
    assert both.estimates[name].stderr == pytest.approx(np.sqrt(both.covariance[0, 0]))
    assert any("from scratch" in said for said in both.describe())


def test_the_table_at_other_numbers_is_that_of_its_scene(films):
    """Also where numbers are 0, and where the arrays are not affine in the numbers, of a friction that falls with the slip."""
    _tracks, scenes = films
    scene, paths = begun(scenes[0], FREE)
    falling = carom.replaced(scene, {"ball_contact.friction": {"at_rest": 0.1, "at_speed": 0.05, "speed": 1.0}})
    ends = tuple(f"ball_contact.friction.{name}" for name in ("at_rest", "at_speed"))
    for model in (
        TableModel(scene, paths, {}),
        TableModel(falling, ends, {"ball_contact.friction.at_speed": (0.0, 0.1)}),
    ):
        low, high = (np.array([getattr(one, end) for one in model.shared]) for end in ("low", "high"))
        share = np.random.default_rng(1).random((3, len(low)))
        share[0, [one.name == "floor.spin_friction" for one in model.shared]] = 0.0
        assert (model._start is None) == (model.scene is falling)
        for values in low + np.sort(share)[:, ::-1] * (high - low):
            found, made = model.at(values), set_up(model.scene_at(values))
            for array in ("world", "features"):
                for name in getattr(made, array).dtype.names:
                    one, other = getattr(found.arrays, array)[name], getattr(made, array)[name]
                    assert one == pytest.approx(other, rel=1e-12, abs=1e-12, nan_ok=True), name


@pytest.mark.slow
def test_laws_are_searched_from_each_others_optimum(ranking):
    best, said = ranking.best, []
    # another law, whose own search has lost its way
    law = replace(best.model, scene=carom.replaced(best.model.scene, {"run.law": "two-step-after"}))
    other = replace(best, model=law, deviance=best.deviance + 1e3)
    found = searched_together([best, other], lambda done, text: said.append((done, text)))
    assert found[1].deviance <= best.deviance
    assert found[0].deviance < best.deviance + 500
    assert max(done for done, _text in said) < 1
    assert "two-step: from the other's optimum" in {text for _done, text in said}


def still(name, place, count=40):
    return Track(name, np.arange(count) / 50, np.tile(place, (count, 1)), group="s")


def moving(name, place, velocity, count=40):
    t = np.arange(count) / 50
    return Track(name, t, np.array(place) + t[:, None] * np.array(velocity), group="s")


@pytest.mark.parametrize(
    ("tracks", "said"),
    [
        ([still("1", (0.5, 0.5)), still("2", (1.5, 0.5))], "expected a stroke, got 2 balls at rest"),
        ([moving("1", (0.5, 0.5), (1, 0)), moving("2", (2.0, 1.0), (-1, 0.2))], "in the middle of a shot"),
    ],
)
def test_films_that_show_no_shot_are_refused_in_one_line(tracks, said):
    with pytest.raises(carom.CaromError, match=said) as caught:
        carom.fit_shots(tracks, radius=RADIUS)
    assert "\n" not in str(caught.value)


def test_films_of_different_tables_are_refused(films):
    tracks, scenes = films
    far = [Track(one.name, one.time, 1.5 * one.position, group="other table") for one in tracks[:3]]
    with pytest.raises(carom.CaromError, match="other table: expected balls on the table of the other films"):
        carom.fit_shots([*tracks, *far], radius=RADIUS)
    # one turn is enough: no ball goes on there
    aside = [Track(one.name, one.time, one.position - [0.9, 0.0], group="aside") for one in tracks[3:]]
    with pytest.raises(carom.CaromError, match=r"aside: .* beyond its left cushion"):
        carom.fit_shots([*tracks[:3], *aside], radius=RADIUS)
    with pytest.raises(
        carom.CaromError, match=r"aside: expected balls on the table that is given, .* its left cushion"
    ):
        carom.fit_shots(aside, scenes[0])


def test_a_cushion_that_no_ball_reaches_follows_from_the_others(films):
    tracks, _scenes = films
    some = [one if one.group == "shot 1" else one.select(one.time < 1.0) for one in tracks]
    found = filmed_shots(some, RADIUS)
    wall = scene_of_films(None, found, RADIUS, 3, 60.0, "test").walls[0]
    assert (wall.length, wall.width) == pytest.approx((2.84, 1.42), abs=0.02)
    assert "no ball reaches the right cushion: taken to be 2.8" in found.notes[-1]
    with pytest.raises(
        carom.CaromError, match="expected shots that reach three cushions at least, got none at right, top"
    ):
        carom.fit_shots(tracks[:3], radius=RADIUS)


def test_shots_with_different_numbers_of_balls_are_fitted(films):
    tracks, scenes = films
    lies = Track("4", tracks[0].time, np.tile([2.5, 1.2], (len(tracks[0]), 1)), group="shot 1")
    both = [*tracks, lies]
    until = [Track(one.name, one.time[:40], one.position[:40], group=one.group) for one in both]
    best = carom.fit_shots(until, scenes[0], free=["walls.0.restitution"]).best
    assert [len(one.scene.balls) for one in best.shots] == [4, 3]
    assert best.median() < 3e-3


def test_a_ball_that_never_moves_is_noted(films):
    tracks, _scenes = films
    lies = Track("4", tracks[0].time, np.tile([2.5, 1.2], (len(tracks[0]), 1)), group="shot 1")
    found = filmed_shots([*tracks[:3], lies], RADIUS)
    assert "shot 1: 4 is never seen to move: taken to lie at rest" in found.notes
    assert found.shots[0].known[:, 3].all()


@pytest.mark.parametrize(
    ("given", "said"),
    [
        ({"free": ["walls.0.restitutoin"]}, "restitution"),
        ({"free": ["balls.0.velocity"]}, "the start of each shot is fitted anyway"),
        ({"seed": -1}, "seed: expected a whole number"),
        ({"laws": "two-stp"}, "two-step"),
    ],
)
def test_wrong_arguments_are_refused(films, given, said):
    tracks, scenes = films
    with pytest.raises(carom.CaromError, match=said):
        carom.fit_shots(tracks, scenes[0], **given)


@pytest.mark.slow
def test_numbers_that_a_shot_does_not_tell_are_said():
    tracks, scenes = drawn_films(1, seed=3, until=0.6)
    ranking = carom.fit_shots(tracks, scenes[0], seed=1)
    assert np.isfinite(ranking.best.aicc)
    assert [note for note in ranking.notes if "AIC instead of AICc" in note]
    untold = [one for one in ranking.best.estimates.values() if one.note == NOT_IDENTIFIABLE]
    assert untold
    assert all(one.value is None and one.stderr is None for one in untold)
    assert len(untold) == len(ranking.best.untold)


def test_two_numbers_that_are_one_are_given_as_their_combination():
    """The lines of cushions and their yield had small error bars each: 1.408 m between cushions for a table of 1.42 m."""
    bars, rho = np.array([2e-3, 1e-3, 0.01]), 0.98
    covariance = np.diag(bars**2)
    covariance[0, 1] = covariance[1, 0] = -rho * bars[0] * bars[1]
    values = np.array([1.408, 2.5e-3, 0.8])
    names = ("walls.0.width", "walls.0.yield_time", "walls.0.restitution")
    estimates = {name: Estimate(x, bar) for name, x, bar in zip(names, values.tolist(), bars.tolist(), strict=True)}
    found = in_combination(Identified(covariance, estimates, (), ()), values, "two-step")
    assert found.untold == names[:2]
    assert [found.estimates[name].value for name in names] == [None, None, 0.8]
    # (by draws: the combination of least scatter is that which does not depend on the second)
    draws = np.random.default_rng(1).multivariate_normal(values, covariance, 100_000)
    by = -np.polyfit(draws[:, 1], draws[:, 0], 1)[0]
    said, *_more = found.degenerate
    told = re.search(r"width \+ ([\d.]+) walls\.0\.yield_time = ([\d.]+) ± ([\d.]+)", said)
    assert [float(one) for one in told.groups()] == pytest.approx(
        [by, 1.408 + by * 2.5e-3, (draws @ [1, by, 0]).std()], rel=0.02
    )


def test_a_number_without_influence_and_two_in_combination_are_named():
    # the cue ball meets another, and that one the right cushion: half the length and the centre are one number
    tracks, scenes = drawn_films(1, seed=3, until=0.6)
    best = carom.fit_shots(tracks, scenes[0], free=["walls.0.length", "walls.0.center", "ball_contact.friction"]).best
    aside, both = best.degenerate
    assert aside == "two-step: walls.0.center.y: these data hardly depend on it"
    assert both.startswith("two-step: walls.0.length: other parameters compensate for it")
    assert set(best.untold) == {"walls.0.length", "walls.0.center.y"}
    # (what is known of the centre is what the bounds of the length leave: half of these 0.05 m to both sides)
    assert 0.015 < best.estimates["walls.0.center.x"].stderr < 0.03
    assert best.estimates["ball_contact.friction"].stderr < 0.02
    # by runs of other scenes: these changes move no ball, one of the two alone does
    (x, y), length = scenes[0].walls[0].center, scenes[0].walls[0].length
    last = best.shots[0].film.time[-1]
    moved = {}
    for name, change in (
        ("none", {}),
        ("aside", {"walls.0.center": (x, y + 0.01)}),
        ("both", {"walls.0.center": (x + 0.01, y), "walls.0.length": length - 0.02}),
        ("one", {"walls.0.center": (x + 0.01, y)}),
    ):
        moved[name] = carom.simulate(carom.replaced(scenes[0], change)).at(last).position
    far = {name: np.abs(place - moved["none"]).max() for name, place in moved.items()}
    assert max(far["aside"], far["both"]) < 1e-9
    assert far["one"] > 5e-3


def test_the_information_of_shots_is_half_the_curvature_of_their_deviance(ranking):
    best = ranking.best
    frames = [max(one.best) for one in best.starts]
    fitted = JointFit(best.values, frames, [], 0.0)
    at = Optimum.of_few(best.model, fitted, best.starts)
    assert np.sqrt(np.diag(np.linalg.inv(at.information))) == pytest.approx(
        [one.stderr for one in best.estimates.values()], rel=0.05
    )
    least = at.deviance(at.found)
    for k, one in enumerate(best.estimates.values()):
        h = 2 * one.stderr * np.eye(len(best.values))[k]
        up, down = (at.followed(best.values + sign * h)[0] for sign in (1, -1))
        assert (up + down - 2 * least) / (2 * 4 * one.stderr**2) == pytest.approx(at.information[k, k], rel=0.1)


@pytest.mark.slow
def test_a_scatter_as_large_as_the_number_is_found():
    name = "ball_contact.friction"
    tracks, scenes = drawn_films(5, seed=3, until=0.6, scatter={name: 1.5})
    best = carom.fit_shots(tracks, carom.replaced(scenes[0], {name: 0.06}), free=[name]).best
    frames = [
        frames_of_events(one.shot, best.events) for one in best.starts
    ]  # (widths grow step by step: once more from these)
    more = fit_scatter(best.model, best.values, best.starts, frames, best.widths, best.noise, lambda _done: None)
    met = np.array([float(scene.ball_contact.friction) for scene in scenes])
    assert more.widths[0] == pytest.approx(met.std(ddof=1), rel=0.25)
    estimate = identified(Optimum.of_scatter(best.model, more, frames), name).estimates[name]
    assert estimate.stderr == pytest.approx(met.std(ddof=1) / np.sqrt(len(met)), rel=0.25)
    assert abs(estimate.value - met.mean()) < 2 * estimate.stderr


def test_a_scatter_is_as_wide_as_it_was_drawn():
    rng = np.random.default_rng(0)
    for true, low, high in ((0.0, 0.0, 0.3), (1.0, 0.85, 1.15)):
        found = []
        for _ in range(100):
            error, width = rng.uniform(0.5, 1.5, (12, 1)), np.array([2.0])
            seen = true * rng.normal(size=(12, 1)) + error * rng.normal(size=(12, 1))
            # each shot's deviation is drawn towards the mean by the width that is taken
            share = width**2 / (width**2 + error**2)
            mean = (share * seen).sum() / share.sum()
            found.append(likely_widths(share * (seen - mean), np.sqrt(share) * error, width, 300)[0])
        assert low < np.median(found) < high


def test_a_contact_of_which_no_frame_shows_the_balls_together_is_an_event():
    tracks, scenes = drawn_films(1, seed=5, until=1.0)
    first = next(event for event in carom.simulate(scenes[0]).events if event.kind == "ball")
    whole = filmed_shots(tracks, RADIUS).shots[0]
    (seen,) = (one for one in whole.events if one.kind == "ball" and one.low < first.t + 0.05)
    hidden = [
        Track(one.name, one.time[keep], one.position[keep], group=one.group)
        for one in tracks
        for keep in (np.abs(one.time - first.t - 0.04) > 0.065,)
    ]
    shot = filmed_shots(hidden, RADIUS).shots[0]
    (found,) = (one for one in shot.events if one.kind == "ball" and one.low < first.t + 0.05)
    assert (found.ball, found.other) == (seen.ball, seen.other)
    assert found.low < first.t + 0.02
    assert found.high > first.t
    assert found.high - found.low < 0.05


@pytest.mark.slow
def test_a_cushion_that_differs_is_found():
    path = "walls.0.sides.right.restitution"
    tracks, scenes = drawn_films(2, seed=5, until=2.5, numbers={path: 0.75})
    table = carom.replaced(scenes[0], {path: None})
    found = carom.fit_shots(tracks, table, free=["walls.0.restitution", path], seed=1).best.estimates
    for name, true in (("walls.0.restitution", 0.85), (path, 0.75)):
        assert abs(found[name].value - true) < 4 * found[name].stderr, name
        assert found[name].stderr < 0.02, name


def test_a_law_that_holds_the_friction_holds_that_of_a_cushion_too(films):
    tracks, scenes = films
    table = carom.replaced(scenes[0], {"walls.0.nose_height": None})
    free = ["walls.0.restitution", "walls.0.sides.right.friction"]
    best = carom.fit_shots(tracks[:3], table, free=free, laws=["mirror"], seed=1).best
    assert list(best.estimates) == ["walls.0.restitution"]
    assert best.scene.walls[0].sides.right.friction == 0.0
