"""Kinds of films that people have, small: each is tracked rightly, or refused; no frame that is used is off by more than 1 px."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import carom
from carom.errors import CaromError
from carom.tracks.video.balls import find_background, movement
from carom.tracks.video.edges import Optics, Patch, fit_outline, look_closer
from carom.tracks.video.film import _strange

pytest.importorskip("av")
from reference.rendered_films import (
    RED,
    WHITE,
    Backdrop,
    Camera,
    Look,
    RenderedFilm,
    bouncing_film,
    pieces,
    render,
    three_balls_film,
)


def on_a_plank(path: Path) -> RenderedFilm:
    """A white ball rolls along a plank to its end and back, in a file that is to be turned."""
    still, radius = np.zeros(3), 0.024
    rows = [
        (0.0, (-0.25, radius, 0), (0.7, 0, 0), (-0.15, 0, 0), still, still),
        (0.6, (0.143, radius, 0), (-0.4, 0, 0), (0.15, 0, 0), still, still),
    ]
    camera = Camera(scale=500.0, centre=(0.0, 0.1), rate=30.0, exposure=1 / 100)
    look, cloth = Look(WHITE, "plain", ambient=0.5), Backdrop("cloth")
    return render(path, {"ball": (pieces(rows), radius, look)}, camera=camera, backdrop=cloth, frames=36, rotation=90)


def between_plates(path: Path) -> RenderedFilm:
    """A dark ball with white marks flies to and fro between a plate above and the floor."""
    radius, high, rows, place, v, t = 0.024, 0.3, [], np.array([-0.25, 0.15, 0]), np.array([0.5, -2.0, 0]), 0.0
    for k in range(6):
        rows.append((t, place, v, np.zeros(3), (0, 0, 30 * (-0.8) ** k), np.zeros(3)))
        lasts = ((high - radius if k % 2 else radius) - place[1]) / v[1]
        place, v, t = place + v * lasts, v * [0.9, -0.9, 0], t + lasts

    def plate(picture: np.ndarray, _k: int) -> np.ndarray:
        picture[: int(119.5 - 500 * (high - 0.18))] = 0.5
        return picture

    ball, camera = (
        (pieces(rows), radius, Look((0.15, 0.2, 0.6), "mark", WHITE)),
        Camera(scale=500.0, centre=(0.0, 0.18)),
    )
    return render(path, {"ball": ball}, camera=camera, backdrop=Backdrop("wall"), frames=36, disturb=plate)


def beside_its_shadow(path: Path) -> RenderedFilm:
    """A red ball with a shadow of its own size, apart from it, strongly blurred."""
    return bouncing_film(
        path, look=Look(RED, "plain"), texture="wall", shadow="beside", depth=0.6, rate=30.0, exposure=1 / 60, frames=26
    )


def at_few_bits(path: Path) -> RenderedFilm:
    """The texture of the ground comes and goes with the key frames of the codec."""
    return bouncing_film(path, bit_rate=0.4e6, frames=40)


@pytest.mark.slow(keep=1)
@pytest.mark.parametrize("made", [at_few_bits, on_a_plank, between_plates, beside_its_shadow])
def test_the_right_ball_is_tracked(tmp_path: Path, made: Callable[[Path], RenderedFilm]) -> None:
    truth = made(tmp_path / "film.mp4")
    film = carom.track_film(truth.path, scale=1 / truth.camera.scale)
    off = np.hypot(*(film.places["ball"] - truth.places["ball"]).T)[film.used["ball"]]
    assert len(off) > 0.8 * truth.seen("ball").sum()
    assert off.max() < 1.0


def moving(kind: str) -> Callable[[np.ndarray, int], np.ndarray]:
    """What a camera does to frame k: it turns slowly, or another one takes over."""
    if kind == "cut":
        return lambda picture, k: picture if k < 20 else np.ascontiguousarray(picture[::-1, ::-1])
    return lambda picture, k: np.roll(picture, k // 4, axis=1)


@pytest.mark.parametrize("kind", ["cut", "pan"])
@pytest.mark.slow(keep=1)
def test_cuts_and_a_camera_that_turns_are_refused(tmp_path: Path, kind: str) -> None:
    truth = three_balls_film(tmp_path / "film.mp4", frames=40, disturb=moving(kind))
    with pytest.raises(CaromError, match="a camera at rest, without cuts"):
        carom.track_film(truth.path, 3, scale=0.001)


def textured(shift: float = 0.0) -> np.ndarray:
    """Brightness of a picture of waves, moved to the right."""
    y, x = np.mgrid[0:120, 0:160].astype(float)
    return (120 + 30 * np.sin((x - shift) / 5) * np.cos(y / 4) + 20 * np.sin(y / 7)).astype(np.uint8)


def test_a_shift_of_the_picture_is_measured() -> None:
    colour = np.full((60, 80), 128, np.uint8)
    ground = find_background([(textured(), colour, colour)] * 8)
    half = (
        textured(0.8)[::2, ::2] // 4
        + textured(0.8)[1::2, ::2] // 4
        + textured(0.8)[::2, 1::2] // 4
        + textured(0.8)[1::2, 1::2] // 4
    )
    shifts, same = movement(half, ground)
    assert np.median(shifts, axis=0) == pytest.approx([0.8, 0.0], abs=0.15)
    assert same == 1.0
    assert movement(half[::-1], ground)[1] < 0.3


def disc(radii: Any, ground: float = 60.0) -> Patch:
    """A patch with a bright thing whose rim has these radii, px, as a function of the angle."""
    y, x = np.mgrid[0:64, 0:64].astype(float)
    away, angle = np.hypot(x - 31.5, y - 31.5), np.arctan2(y - 31.5, x - 31.5)
    cover = 1 / (1 + np.exp(-1.7 * (radii(angle) - away)))
    light = (1 - cover) * ground**2.2 + cover * 180**2.2
    colour = np.full((32, 32), 128, np.uint8)
    behind = np.full((64, 64), round(ground + 16), np.uint8)
    return Patch(0, (0, 0), ((light ** (1 / 2.2) + 16).astype(np.uint8), colour, colour), (behind, colour, colour))


def test_the_shape_of_a_rim_and_the_colour_within_are_seen() -> None:
    optics = Optics(15.0, 1.0, 0.0, (1.5, 1.0, 1.0))
    for radii, expected in (
        (lambda angle: 15 + 0 * angle, [0, 0, 0, 0, 0]),
        (lambda angle: 15.5 + 0.6 * np.cos(2 * angle), [0.5, 0.6, 0, 0, 0]),
        (lambda angle: 15 + 0.5 * np.sin(3 * angle), [0, 0, 0, 0, 0.5]),
    ):
        patch = disc(radii)
        outline = fit_outline(patch, np.array([31.0, 32.0]), np.zeros(2), optics)
        shape, colour = look_closer(patch, outline, np.zeros(2), optics)
        assert shape == pytest.approx(expected, abs=0.15)
        assert colour == pytest.approx([219 * (180 / 219) ** 2.2, 128, 128], abs=2)


def test_a_ball_that_falls_within_an_exposure_is_where_it_is_in_the_middle_of_it() -> None:
    # (a long exposure of a ball that falls by 8 px in it: both ends of its way are 1 px lower than if it moved evenly)
    y, x = np.mgrid[0:120, 0:64].astype(float)
    speed, fall, part = np.array([0.0, 2000.0]), np.array([0.0, 40000.0]), (np.arange(400) + 0.5) / 400 - 0.5
    after = part / 50
    at = 58.0 + speed[1] * after + fall[1] * after**2 / 2
    cover = np.mean([1 / (1 + np.exp(-1.7 * (15 - np.hypot(x - 31.5, y - one)))) for one in at], axis=0)
    light = (1 - cover) * 60**2.2 + cover * 180**2.2
    colour, behind = np.full((60, 32), 128, np.uint8), np.full((120, 64), 76, np.uint8)
    patch = Patch(0, (0, 0), ((light ** (1 / 2.2) + 16.5).astype(np.uint8), colour, colour), (behind, colour, colour))
    optics = Optics(15.0, 1.0, 0.02, (1.5, 1.0, 1.0), fall=fall)
    off = [fit_outline(patch, np.array([31.0, 58.0]), speed, one).place[1] - 58.0 for one in
           (optics, optics._replace(fall=(0.0, 0.0)))]  # fmt: skip
    assert abs(off[0]) < 0.15
    assert off[1] > 0.8


def test_a_place_is_not_that_of_the_pixels_it_was_sought_in() -> None:
    # (a shaded ball, blurred by two radii: a band of pixels that is 2 px off gives a place that is off to the same side)
    y, x = np.mgrid[0:120, 0:64].astype(float)
    light, cover = np.zeros((120, 64)), np.zeros((120, 64))
    for one in 58.0 + 40 * ((np.arange(400) + 0.5) / 400 - 0.5):
        away = np.hypot(x - 31.5, y - one)
        part = 1 / (1 + np.exp(-2.5 * (15 - away)))
        shade = 0.3 + 0.7 * np.clip(np.sqrt(np.clip(1 - (away / 15) ** 2, 0, 1)) - 0.7 * (y - one) / 15, 0, None)
        light, cover = light + part * shade * 200**2.2 / 400, cover + part / 400
    seen = (((1 - cover) * 60**2.2 + light) ** (1 / 2.2) + 16.5).astype(np.uint8)
    colour, behind = np.full((60, 32), 128, np.uint8), np.full((120, 64), 76, np.uint8)
    patch = Patch(0, (0, 0), (seen, colour, colour), (behind, colour, colour))
    optics = Optics(15.0, 0.7, 0.02, (1.5, 1.0, 1.0))
    found = [fit_outline(patch, np.array([31.5, start]), np.array([0.0, 2000.0]), optics, coarse=False).place[1] for start in
             (56.0, 58.0, 60.0)]  # fmt: skip
    assert np.ptp(found) < 0.05


def test_a_frame_that_the_codec_made_of_others_is_flagged() -> None:
    """Of frame 3 less is explained than of the others, of frame 9 more."""
    rng, t = np.random.default_rng(3), np.arange(30) / 60
    places = np.stack([100 + 300 * t, 80 + 4000 * t * t], axis=1) + rng.normal(0, 0.05, (30, 2))
    looks = np.array([120.0, 110.0, 140.0, 0.95]) + rng.normal(0, [1.0, 0.5, 0.5, 0.004], (30, 4))
    looks[3, 3], looks[9, 3] = 0.89, 0.99
    shapes = rng.normal(0, 0.05, (30, 5))
    strange = _strange(t, places, np.ones(30), np.full(30, 20.0), shapes, looks)
    assert np.flatnonzero(strange).tolist() == [3]
