"""Films without any option: pucks without friction, dead balls, bounces whose frames are lost, balls that come to the camera."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from reference.plain_films import GRAVITY, KINDS, dropped, measured, puck, with_lost_frames
from reference.synthetic_tracks import Camera, seen, shot

from carom.errors import CaromError
from carom.tracks import Settings, Track, measure, to_rebounds
from carom.tracks.events import wall_through
from carom.tracks.flights import falls_freely
from carom.tracks.plausibility import find_turns


@pytest.mark.parametrize("name", KINDS)
def test_the_view_the_restitutions_and_the_count_are_right(name: str) -> None:
    found = measured(KINDS[name](np.random.default_rng(1)))
    assert found.view
    assert not found.unlisted
    assert max(map(abs, found.pulls)) < 4


@pytest.mark.slow
def test_a_floor_has_the_friction_that_its_contacts_show() -> None:
    film = puck(np.random.default_rng(7))
    bare, given, slides = (
        measure([film.track], Settings(view="above", **some))
        for some in ({}, {"floor_friction": 0.0}, {"floor_friction": 0.2})
    )  # type: ignore[arg-type]
    assert bare.floor["floor friction"].value == given.floor["floor friction"].value == 0
    assert [one.fit["vn_out"] for one in bare.measured if one.fit] == [
        one.fit["vn_out"] for one in given.measured if one.fit
    ]
    assert to_rebounds(bare).kind == "planar"
    assert to_rebounds(slides).kind == "table"
    rng = np.random.default_rng(3)
    ball = measure([seen(shot(rng), Camera(120, 3e-4), rng)], Settings(view="above"))
    assert ball.floor["floor friction"].value > 0.1
    assert sum(one.friction_excess for one in ball.contacts) < -9
    with pytest.raises(CaromError, match="floor_friction: expected a number of at least 0"):
        Settings(floor_friction=-0.1).check()


def test_frames_that_do_not_show_the_friction_are_said() -> None:
    t = np.arange(0, 1.2, 1 / 30)  # slow, far apart, and noisy
    x = np.where(t < 0.6, 0.4 * (0.6 - t), 0.32 * (t - 0.6))
    place = np.stack([x, 0.3 * t], axis=-1) + np.random.default_rng(1).normal(0, 1e-3, (len(t), 2))
    found = measure([Track("puck", t, place)], Settings(view="above"))
    excess = sum(one.friction_excess for one in found.contacts)
    assert 0 < abs(excess) < 9
    (one,) = found.measured
    assert one.fit is not None
    e, error = one.fit.restitution
    assert abs(e - 0.8) < 2 * error


def test_a_free_fall_is_none_of_a_table() -> None:
    film = dropped(np.random.default_rng(5), 0.3, 0.4)
    assert falls_freely([film.track], GRAVITY) > 0.1
    down = replace(film.track, position=film.track.position * [1, -1])
    with pytest.raises(CaromError, match="falls upward"):
        measure([down])
    with pytest.raises(CaromError, match="falls to the left"):
        measure([replace(film.track, position=film.track.position[:, ::-1])])
    # a corner between straight lines, as of a ball that meets a wall, is no fall
    t = np.arange(0, 1.0, 1 / 60)
    place = np.stack([0.1 * t, -np.abs(t - 0.5)], axis=-1) + np.random.default_rng(2).normal(0, 2e-3, (len(t), 2))
    assert falls_freely([Track("ball", t, place)], GRAVITY) == 0


def test_bounces_whose_frames_are_lost_are_met_at_a_given_wall_too() -> None:
    whole = dropped(np.random.default_rng(4), 0.75, 0.85, rate=120.0)
    film = with_lost_frames(whole, 4)
    visible = [one.time for one in film.bounces if one.visible]
    bottom = measure([film.track], Settings(view="side"))
    (wall,) = bottom.walls
    level = whole.track.position[:, 1].min()
    assert wall.point[1] == pytest.approx(level, abs=4e-3)
    given = wall_through("floor", (0.0, level), (1.0, level), [film.track])
    for found in (bottom, measure([film.track], Settings(view="side", walls=(given,)))):
        times = np.array([one.time for one in found.measured])
        assert all(np.abs(times - one).min() < 2e-3 for one in visible[:3])


def test_a_turn_at_no_wall_is_listed() -> None:
    """On a table a ball comes back from a block in the middle, after it has met the wall on the left."""
    t = np.arange(0, 2.0, 1 / 120)
    x = np.where(t < 0.6, 0.9 * (0.6 - t), np.where(t < 1.2, 0.7 * (t - 0.6), 0.42 - 0.5 * (t - 1.2)))
    place = np.stack([x, 0.1 * t], axis=-1) + np.random.default_rng(1).normal(0, 2e-4, (len(t), 2))
    ball = Track("ball", t, place)
    left = wall_through("left", (0.0, 0.0), (0.0, 1.0), [ball])
    found = measure([ball], Settings(view="above", walls=(left,)))
    assert len(found.contacts) == 1
    assert any("1 bounce away from the wall, at (x, y) = (0.42" in note for note in found.notes)


@pytest.mark.parametrize(
    ("name", "seed"), [("2 frames lost on either side of each bounce", 29), ("4 frames lost, 120 per second", 2)]
)
def test_bounces_whose_frames_are_lost_are_counted_where_no_minimum_is_seen(name: str, seed: int) -> None:
    found = measured(KINDS[name](np.random.default_rng([seed, len(name)])))
    assert not found.unlisted
    assert max(map(abs, found.pulls)) < 4


def test_frames_lost_of_a_ball_that_is_not_hit_are_no_turn() -> None:
    rng, t = np.random.default_rng(6), np.arange(0, 0.8, 1 / 60)
    free, held = 4 * t - GRAVITY / 2 * t * t, -GRAVITY / 2 * np.maximum(t - 0.4, 0) ** 2
    bounces = np.where(t < 0.4, free, free + 3.0 * (t - 0.4))  # (it still rises less than it fell: no minimum is seen)
    for height, turns in ((free, 0), (0 * t, 0), (held, 0), (bounces, 1)):
        kept = np.abs(t - 0.405) > 0.06
        place = np.stack([t, height], axis=-1) + rng.normal(0, 3e-4, (len(t), 2))
        track = Track("ball", t, place).select(kept)
        assert len(find_turns(track, 3e-4, (0.0, -1.0), GRAVITY, 1 / 60)) == turns
