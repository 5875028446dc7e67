"""Frames and times of films: what the container says of stamps and rotation, against how the film was written."""

from __future__ import annotations

from fractions import Fraction
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from carom.errors import CaromError
from carom.tracks.video.film import TrackedFilm, crops
from carom.tracks.video.reading import Frame, film_times, is_film, open_film

av = pytest.importorskip("av")
RED, GREY = np.array([200, 30, 30]), np.array([60, 60, 60])
LEFT, TOP, WIDE, HIGH = 10, 20, 50, 30  # px of a red rectangle, in a picture of 320 x 240


def written(path: Path, stamps: Any = None, codec: str = "libx264", rotation: int = 0, pixels: str = "yuv420p") -> Path:
    """Write 12 frames of a red rectangle, with stamps in units of 1/18000 s."""
    picture = np.tile(GREY.astype(np.uint8), (240, 320, 1))
    picture[TOP : TOP + HIGH, LEFT : LEFT + WIDE] = RED
    with av.open(str(path), "w") as container:
        stream = container.add_stream(codec, rate=30)
        stream.width, stream.height, stream.pix_fmt = 320, 240, pixels
        if rotation:
            stream.set_display_rotation(rotation)
        if stamps is not None:
            stream.codec_context.time_base = stream.time_base = Fraction(1, 18000)
        for k in range(12):
            frame = av.VideoFrame.from_ndarray(picture, format="rgb24")
            if stamps is not None:
                frame.pts, frame.time_base = int(stamps[k]), Fraction(1, 18000)
            container.mux(stream.encode(frame))
        container.mux(stream.encode())
    return path


def all_frames(path: Path) -> list[Frame]:
    return [frame._replace(y=frame.y.copy(), u=frame.u.copy(), v=frame.v.copy()) for frame in open_film(path).frames()]


def test_stamps_of_a_variable_rate_come_back_exactly(tmp_path: Path) -> None:
    stamps = np.cumsum([0, 600, 600, 1200, 1700, 590, 610, 600, 300, 900, 600, 601])
    path = written(tmp_path / "variable.mp4", stamps)
    notes: list[str] = []
    times = film_times(open_film(path), [frame.stamp for frame in all_frames(path)], None, notes)
    assert np.abs(times - stamps / 18000).max() < 1e-12
    assert len(notes) == 1


def test_stamps_that_the_container_rounds_are_on_the_even_clock_behind_them(tmp_path: Path) -> None:
    path = written(tmp_path / "even.mkv")  # (Matroska rounds to 1 ms)
    stamps = [frame.stamp for frame in all_frames(path)]
    assert np.ptp(np.diff(stamps)) > 5e-4
    notes: list[str] = []
    times = film_times(open_film(path), np.delete(stamps, 5), None, notes)
    assert np.abs(times - np.delete(np.arange(12), 5) / 30).max() < 5e-4
    assert np.ptp(np.diff(times)[:4]) < 1e-12


@pytest.mark.parametrize(
    ("turn", "corner"), [(90, (TOP, 320 - LEFT - WIDE)), (-90, (240 - TOP - HIGH, LEFT)), (180, (260, 190))]
)
def test_pictures_stand_upright(tmp_path: Path, turn: int, corner: tuple[int, int]) -> None:
    path = written(tmp_path / "turned.mp4", rotation=turn)
    film, frame = open_film(path), all_frames(path)[3]
    pixels = film.to_rgb(frame.y, frame.u, frame.v)
    assert pixels.shape == (film.height, film.width, 3)
    y, x = np.nonzero(pixels[..., 0] > 130)
    assert np.abs(np.array([x.min(), y.min()]) - corner).max() <= 1
    middle = tuple(np.median([y, x], axis=1).astype(int))
    assert np.abs(pixels[middle].astype(int) - RED).max() <= 10


@pytest.mark.parametrize("pixels", ["yuv420p10le", "yuv444p"])
def test_other_pixel_formats_have_the_same_colours(tmp_path: Path, pixels: str) -> None:
    path = written(tmp_path / "other.mp4", pixels=pixels)
    film, frame = open_film(path), all_frames(path)[0]
    seen = film.to_rgb(frame.y, frame.u, frame.v)
    assert np.abs(seen[120, 200].astype(int) - GREY).max() <= 4
    assert seen[TOP + 15, LEFT + 25, 0] > seen[TOP + 15, LEFT + 25, 1] + 100


def test_stamps_out_of_order_are_put_in_order_or_refused(tmp_path: Path) -> None:
    path = written(tmp_path / "broken.avi")  # (AVI has no stamps: frames between frames get those of their packets)
    film, stamps = open_film(path), [frame.stamp for frame in all_frames(path)]
    notes: list[str] = []
    assert np.diff(stamps).min() < 0
    assert np.abs(film_times(film, stamps, None, notes) - np.arange(12) / 30).max() < 1e-9
    assert len(notes) == 1
    uneven = [0.0, 0.1, 0.05, 0.3, 0.4]
    with pytest.raises(CaromError, match="frame 2"):
        film_times(film, uneven, None, [])
    assert np.abs(film_times(film, uneven, 240.0, []) - np.arange(5) / 240).max() < 1e-12


def test_a_rate_scales_the_times_of_slow_motion(tmp_path: Path) -> None:
    path = written(tmp_path / "slow.mp4")
    film, stamps = open_film(path), [frame.stamp for frame in all_frames(path)]
    assert np.abs(film_times(film, stamps, 240.0, []) - np.arange(12) / 240).max() < 1e-9


def test_crops_show_the_pixels_around_the_ball(tmp_path: Path) -> None:
    path = written(tmp_path / "still.mp4")
    places = np.tile([LEFT + WIDE / 2, TOP + HIGH / 2], (12, 1))
    places[4] = np.nan
    film = TrackedFilm(
        path, np.arange(12) / 30, {"ball": places}, 8.0, np.ones(12), np.zeros(12, bool), 0.0, 0.8,
        np.zeros((240, 320, 3), np.uint8), {"ball": np.zeros((12, 2))},
    )  # fmt: skip
    found = list(crops(film, "ball", [2, 4, 7]))
    assert [crop.frame for crop in found] == [2, 7]
    assert (np.abs(found[0].pixels.astype(int) - RED).max(axis=2) < 25).mean() > 0.95
    x, y = found[0].corner
    assert (x, y) == (20, 20)
    with pytest.raises(CaromError, match="ball"):
        next(crops(film, "other", [1]))


def test_what_is_no_film_is_refused_in_one_line(tmp_path: Path) -> None:
    path = tmp_path / "text.mp4"
    path.write_text("t,x,y\n0,0,0\n")
    for one in (path, tmp_path / "none.mp4", tmp_path):
        with pytest.raises(CaromError) as error:
            open_film(one)
        assert str(error.value).count("\n") == 0
    assert is_film(path)
