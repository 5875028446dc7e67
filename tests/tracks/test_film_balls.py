"""Balls tracked in rendered films whose truth is known: places, exposure, times of rows, names; and films that are refused."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import carom
from carom.errors import CaromError
from carom.tracks import Track, judge
from carom.tracks.video.edges import Optics, Patch, fit_optics
from carom.tracks.video.reading import TrackedFilm

pytest.importorskip("av")
from reference.rendered_films import (
    RED,
    WHITE,
    Look,
    RenderedFilm,
    bouncing_film,
    empty_film,
    three_balls_film,
    two_alike_film,
)


def errors(film: TrackedFilm, truth: RenderedFilm, ball: str = "ball", true: str = "ball") -> np.ndarray:
    """Distances (n,) of the places that are used from the truth, without a constant offset."""
    off = (film.places[ball] - truth.places[true])[film.used[ball]]
    constant = np.median(off, axis=0)
    assert np.abs(constant).max() < 0.5
    return np.asarray(np.hypot(*(off - constant).T))


def restitutions(film: TrackedFilm) -> tuple[np.ndarray, np.ndarray]:
    """Restitution of each contact with its error bar."""
    fits = [one.fit for one in carom.measure_tracks(film, radius=0.02).measured[0].contacts if one.fit is not None]
    value, error = np.array([fit.restitution for fit in fits]).T
    return value, error


@pytest.mark.parametrize(
    ("given", "most"),
    [
        ({}, 0.4),
        ({"look": Look(RED, "plain"), "texture": "flat", "shadow": ""}, 0.25),  # (only its colour differs)
        ({"look": Look(WHITE, "plain"), "texture": "wall"}, 0.25),  # (parts are as bright as the wall)
        ({"shadow": "wall", "texture": "wall"}, 0.35),  # (a shadow that touches it throughout)
    ],
)
@pytest.mark.slow(keep=1)
def test_places_are_those_of_the_outline(tmp_path: Path, given: dict[str, Any], most: float) -> None:
    truth = bouncing_film(tmp_path / "film.mp4", **given)
    film = carom.track_film(truth.path)
    off = errors(film, truth)
    assert len(off) >= 45
    assert np.percentile(off, 95) < most
    assert off.max() < 1.0
    assert film.radius_px == pytest.approx(10.0, abs=0.4)
    assert film.scale == pytest.approx(1 / truth.camera.scale, rel=0.01)  # (by gravity)


@pytest.mark.slow
def test_a_blurred_film_gives_exposure_and_restitution(tmp_path: Path) -> None:
    truth = bouncing_film(tmp_path / "film.mp4", exposure=1 / 62)
    film = carom.track_film(truth.path)
    assert film.exposure == pytest.approx(1 / 62, rel=0.1)
    assert np.percentile(errors(film, truth), 95) < 0.8
    value, error = restitutions(film)
    assert len(value) >= 1
    assert (np.abs(value - 0.78) < 3 * error).all()
    assert error.max() < 0.03


@pytest.mark.slow(keep=1)
@pytest.mark.parametrize(
    "given",
    [
        {"readout": 0.006, "look": Look(WHITE, "plain"), "texture": "wall"},
        {"readout": 0.016, "rotation": 180},
        {"look": Look(WHITE, "plain"), "texture": "wall", "seed": 1},
    ],
)
def test_the_readout_is_found_and_its_error_is_in_the_error_bars(tmp_path: Path, given: dict[str, Any]) -> None:
    truth = bouncing_film(tmp_path / "film.mp4", **given)
    film = carom.track_film(truth.path)
    true = given.get("readout", 0.0)
    assert abs(film.readout - true) <= max(2.5 * film.readout_error, 1e-9)
    assert (film.readout_error > 0) == (true > 0)
    assert film.readout_error < 1.5e-3
    # its own table keeps its times, which rows of the picture shift
    again = carom.measure_tracks(film.save(tmp_path / "track.csv"), radius=0.02)
    (one,), (two,) = again.files[0].tracks, film.tracks
    np.testing.assert_allclose(one.time - one.time[0], two.time - two.time[0], atol=1e-12)
    assert not [note for note in again.notes if "camera's" in note]
    value, error = restitutions(film)
    assert (np.abs(value - 0.78) < 2 * error).all()
    if true:
        given_value, given_error = restitutions(carom.track_film(truth.path, readout=true))
        assert (np.abs(given_value - 0.78) < 3 * given_error).all()
        assert (error > given_error).all()


def test_an_error_that_all_times_share_enters_the_error_bars() -> None:
    t = np.arange(60) / 100
    y = np.where(t < 0.3, 3 * (0.3 - t), 2.4 * (t - 0.3)) - 9.81 / 2 * (t - 0.3) ** 2
    found = [
        carom.measure_tracks(
            [Track("ball", t, np.stack([0.5 * t, y], axis=1), sigma_time=shared)], view="side", noise=1e-4
        )
        for shared in (None, 0.01 * (t - 0.3))
    ]
    plain, late = (one.measured[0].contacts[0].fit for one in found)
    # (a clock that runs slow by 1 %: speeds along the floor are less by that)
    extra = [late.error(name) ** 2 - plain.error(name) ** 2 for name in ("vt_in", "vt_out")]
    assert np.sqrt(extra) == pytest.approx([0.5 - 0.5 / 1.01] * 2, rel=0.02)
    assert late.covariance_of("vt_in", "vt_out") > 0.9 * extra[0]
    assert np.array_equal(late.value, plain.value, equal_nan=True)


@pytest.mark.slow
def test_a_soft_shadow_on_the_floor_is_no_second_ball(tmp_path: Path) -> None:
    truth = bouncing_film(
        tmp_path / "film.mp4", size=(480, 320), scale=560.0, radius=0.033, height=0.4, x=-0.36, speed=0.4, frames=60, depth=0.6,
        look=Look((0.8, 0.85, 0.2), "mark"),
    )  # fmt: skip
    film = carom.track_film(truth.path)
    assert errors(film, truth).max() < 1.0
    assert film.used["ball"].sum() >= 55


@pytest.mark.slow
def test_a_variable_rate_loses_no_frame(tmp_path: Path) -> None:
    truth = bouncing_film(tmp_path / "film.mp4", dropped=0.06, late=0.2)
    film = carom.track_film(truth.path)
    assert np.abs(film.times - truth.times + truth.times[0]).max() < 1e-9
    measured = carom.measure_tracks(film, radius=0.02).measured[0]
    assert len(measured.tracks[0]) == film.used["ball"].sum()
    value, error = restitutions(film)
    assert (np.abs(value - 0.78) < 3 * error).all()
    assert not judge(truth.path, radius=0.02).violations


@pytest.mark.slow
def test_a_ball_that_is_held_leaves_no_ghost(tmp_path: Path) -> None:
    truth = bouncing_film(tmp_path / "film.mp4", start=0.5, frames=70)
    film = carom.track_film(truth.path)
    assert errors(film, truth).max() < 1.0
    assert film.used["ball"].sum() >= 34


@pytest.mark.parametrize("looks", [None, (Look(RED, "plain"),) * 3])
@pytest.mark.slow
def test_three_balls_keep_their_names(tmp_path: Path, looks: tuple[Look, ...] | None) -> None:
    truth = three_balls_film(tmp_path / "film.mp4", seed=2, **({"looks": looks} if looks else {}))
    film = carom.track_film(truth.path, 3, scale=1 / truth.camera.scale)
    found = set()
    for ball in film.places:
        true = min(
            truth.places, key=lambda name: float(np.nanmedian(np.hypot(*(film.places[ball] - truth.places[name]).T)))
        )
        off = np.hypot(*(film.places[ball] - truth.places[true])[film.used[ball]].T)
        assert (off < 1.0).all()
        assert len(off) >= 74
        found.add(true)
    assert found == {"white", "red", "yellow"}


@pytest.mark.parametrize(
    ("make", "word"),
    [
        (empty_film, "round thing that moves"),
        (two_alike_film, "2 that are as likely"),
        (lambda path: bouncing_film(path, shake=4.0), "round thing that moves|camera at rest"),
    ],
)
@pytest.mark.slow(keep=1)
def test_no_ball_two_balls_and_a_camera_that_moves_are_refused(
    tmp_path: Path, make: Callable[[Path], Any], word: str
) -> None:
    make(tmp_path / "film.mp4")
    with pytest.raises(CaromError, match=word) as error:
        carom.track_film(tmp_path / "film.mp4")
    assert "\n" not in str(error.value)


@pytest.mark.slow
def test_a_place_of_a_ball_says_which_one(tmp_path: Path) -> None:
    truth = two_alike_film(tmp_path / "film.mp4")
    x, y = truth.places["right"][20]
    film = carom.track_film(truth.path, ball=f"{x:.0f},{y:.0f}@{truth.times[20]:.3f}", length="0,100,200,100=40cm")
    assert errors(film, truth, "ball", "right").max() < 1.0
    assert film.scale == pytest.approx(0.4 / 200)


def test_a_fall_alone_has_a_scale_only_if_gravity_is_said_to_act(tmp_path: Path) -> None:
    truth = bouncing_film(tmp_path / "film.mp4", height=0.35, frames=16)
    with pytest.raises(CaromError, match=r"px/s\^2.*gravity \((1.9\d|2(.0\d)?) mm per px\)"):
        carom.track_film(truth.path)
    assert carom.track_film(truth.path, scale="gravity").scale == pytest.approx(0.002, rel=0.01)


def test_all_wrong_arguments_are_said_at_once(tmp_path: Path) -> None:
    with pytest.raises(CaromError) as error:
        carom.track_film(tmp_path / "film.mp4", 0, length="1,2", ball="5..,3@1", colour="red", region="9,9,1,1")
    assert len(error.value.faults) >= 5


def test_a_film_is_rendered_to_the_same_bits(tmp_path: Path) -> None:
    films = [bouncing_film(tmp_path / f"{k}.mp4", texture="wall", frames=12).path.read_bytes() for k in range(4)]
    assert len(set(films)) == 1


def test_a_disc_holds_no_shadow_that_is_deep_at_its_rim() -> None:
    x, y = np.meshgrid(np.arange(64), np.arange(64))
    frames = []
    for k in range(6):
        middle = np.array([31.0 + 0.37 * k, 30.0 + 0.21 * k])
        from_rim = np.hypot(x - middle[0], y - middle[1]) - 9.5
        below = np.hypot(x - middle[0], y - middle[1] - 3.0) - 9.5
        light = 60 * (1 - 0.8 / (1 + np.exp(2.0 * below)))
        light += (190 - 4 * (y - middle[1]) - light) / (1 + np.exp(2.0 * from_rim))
        planes = [16 + 219 * (one / 219) ** (1 / 2.2) for one in (light, np.full((64, 64), 60.0))]
        seen, ground = (np.rint(one).astype(np.uint8) for one in planes)
        grey = np.full((32, 32), 128, np.uint8)
        frames.append(
            (
                Patch(k, (0, 0), (seen, grey, grey), (ground, grey, grey)),
                middle + np.array([0.5, 1.5]),
                np.zeros(2),
                middle,
            )
        )
    start = Optics(11.5, 1.0, 0.0, (2.2, 0.8, 0.8))
    plain, deep = (fit_optics([one[:3] for one in frames], start._replace(deep=kind), "rs") for kind in (False, True))
    assert deep[0].radius == pytest.approx(9.5, abs=0.05)
    assert abs(plain[0].radius - 9.5) > 0.1
    assert np.abs(np.array(deep[2]) - [one[3] for one in frames]).max() < 0.1
