"""Frames and times of films: what the container says of stamps and rotation, against how the film was written."""

from __future__ import annotations

from fractions import Fraction
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import carom
from carom.errors import CaromError
from carom.tracks.video.reading import Frame, TrackedFilm, crops, film_times, is_film, open_film
from carom.tracks.video.scale import TableView, parse_corners

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


@pytest.mark.parametrize("tilt", [0.0, 0.5])
def test_corners_of_a_table_with_their_height_give_the_places_of_balls(tilt: float) -> None:
    """A pinhole camera of its own looks at a table of 2.84 m; its corners, 37 mm above the cloth, are known to a pixel."""
    focal, size, radius = 1400.0, (1920, 1080), 0.03
    eye = np.array([1.42, 0.71 - 3.0 * np.sin(tilt), 3.0 * np.cos(tilt)])
    axes = np.array([[1, 0, 0], [0, -np.cos(tilt), -np.sin(tilt)], [0, np.sin(tilt), -np.cos(tilt)]])

    def seen(points: np.ndarray) -> np.ndarray:
        rays = (points - eye) @ axes.T
        return (np.array(size) - 1) / 2 + focal * rays[:, :2] / rays[:, 2:]

    rng = np.random.default_rng(1)
    corners = seen(np.array([[0, 1.42, 0.037], [2.84, 1.42, 0.037], [2.84, 0, 0.037], [0, 0, 0.037]]))
    corners = corners + rng.normal(0, 0.5, (4, 2))
    text = ",".join(f"{x:.1f}" for x in corners.ravel()) + "=2.84mx1.42m@37mm"
    table = TableView.seen(parse_corners(text), size, radius)
    places = np.column_stack([rng.uniform(0.1, 2.7, 50), rng.uniform(0.1, 1.3, 50), np.full(50, radius)])
    assert np.abs(table(seen(places)) - places[:, :2]).max() < 0.006
    other = ",".join(f"{x:.1f}" for x in np.roll(corners, -2, axis=0).ravel()) + "=2.84x1.42@0.037"
    turned = TableView.seen(parse_corners(other), size, radius)
    assert np.abs(turned(seen(places)) - (np.array([2.84, 1.42]) - places[:, :2])).max() < 0.006
    with pytest.raises(CaromError):
        TableView.seen(parse_corners(text.replace("2.84mx1.42m", "1.42mx2.84m")), size, radius)


def test_the_readout_of_a_camera_is_taken_out_of_the_files_of_other_programs() -> None:
    """Rows of a picture 0.8 m high are read within 15 ms; a ball falls, and rises with 0.8 of its speed."""
    stamps = np.arange(52) / 60.0
    hit, g = 0.35, 9.81

    def height(t: np.ndarray) -> np.ndarray:
        down = 0.5 * g * (hit**2 - t**2)
        return np.where(t < hit, down, 0.8 * g * hit * (t - hit) - 0.5 * g * (t - hit) ** 2)

    t = stamps.copy()
    for _ in range(50):
        t = stamps + 0.015 * (0.5 - height(t) / 0.8)
    table = {"t [s]": stamps, "x [m]": 0.2 * t, "y [m]": height(t) + 0.02}
    given = {"view": "side", "noise": 2e-5, "drag_per_metre": 0.0}
    found = carom.measure_tracks(table, **given, film={"readout": 0.015, "picture_height": 0.8}).measured[0].contacts[0]
    assert found.fit is not None
    assert abs(found.fit["vn_out"] / -found.fit["vn_in"] - 0.8) < 0.0005
    with pytest.raises(CaromError, match="`picture_height`: expected none for a film"):
        carom.track_film("a.mp4", picture_height=0.8)
    with pytest.raises(CaromError, match="picture_height"):
        carom.measure_tracks(table, **given, film={"readout": 0.015})
