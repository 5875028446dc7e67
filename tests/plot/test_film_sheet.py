"""The contact sheet of a tracked film shows the ball in its outlines, flagged frames red; the overlay keeps the film's times."""

from __future__ import annotations

from pathlib import Path

import av
import numpy as np
import pytest
from matplotlib.colors import to_hex
from reference.rendered_films import Look, bouncing_film
from reference.tracked_truth import as_tracked

from carom.plot.fit import film_parts
from carom.plot.tracks import COLUMNS, RED, SHOWN, outline_of, plot_film, smooth_residuals, write_overlay
from carom.tracks.video.reading import TrackedFilm

FLAGGED = (8, 21)


@pytest.fixture(scope="module")
def film(tmp_path_factory: pytest.TempPathFactory) -> TrackedFilm:
    path = tmp_path_factory.mktemp("film") / "bounce.mp4"
    look = Look((0.95, 0.95, 0.95), "plain", ambient=1.0, highlight=0.0)
    made = bouncing_film(
        path, size=(160, 120), scale=250.0, radius=0.03, frames=30, look=look, texture="flat", colour=(0.1, 0.1, 0.1), shadow="",
        floor=False, exposure=1 / 100, late=0.2,
    )  # fmt: skip
    return as_tracked(made, flagged=FLAGGED)


@pytest.mark.slow
def test_a_sheet_shows_frames_of_the_whole_film_and_flagged_ones_red(film: TrackedFilm, tmp_path: Path) -> None:
    figure = plot_film(film, tmp_path / "sheet.png")
    *cells, path, residuals = figure.axes
    assert len(cells) == SHOWN
    assert len({round(axes.get_position().x0, 3) for axes in cells}) == COLUMNS
    times = [float(axes.get_xlabel().removesuffix(" s")) for axes in cells]
    red = [t for t, axes in zip(times, cells, strict=True) if to_hex(axes.lines[0].get_color()) == RED]
    assert red == [round(t, 3) for t in film.times[list(FLAGGED)].tolist()]
    assert times == sorted(times)
    assert path.lines[0].get_xydata().shape == (len(film.times) - 2, 2)
    assert np.ptp(residuals.get_ylim()) < 1.0  # (contacts, where the path has a corner, are no residuals)
    assert (tmp_path / "sheet.png").stat().st_size < 1e6
    assert all("<svg" in part for part in film_parts([film]))


def test_outlines_enclose_the_bright_ball_of_the_crops(film: TrackedFilm) -> None:
    """In pixels: inside the outline it is bright, outside it is dark, also where the exposure draws the ball out."""
    from matplotlib.path import Path as Polygon

    with av.open(str(film.path)) as container:
        pictures = [frame.to_ndarray(format="rgb24").mean(axis=2) for frame in container.decode(video=0)]
    y, x = np.mgrid[0 : pictures[0].shape[0], 0 : pictures[0].shape[1]]
    for k in (3, 11, 25):
        inside = (
            Polygon(outline_of(film, "ball", k))
            .contains_points(np.stack([x.ravel(), y.ravel()], axis=1))
            .reshape(x.shape)
        )
        bright = pictures[k] > 135.0  # (half of the light of white on black, in the encoded picture)
        assert (bright & ~inside).sum() < 0.03 * bright.sum()
        assert 1.0 <= inside.sum() / bright.sum() < 1.5  # (ends of the way are less than half bright)


def test_an_overlay_has_the_frames_and_times_of_the_film(film: TrackedFilm, tmp_path: Path) -> None:
    write_overlay(film, tmp_path / "over.mp4")
    with av.open(str(tmp_path / "over.mp4")) as container:
        frames = [(float(one.time), one.to_ndarray(format="rgb24").astype(float)) for one in container.decode(video=0)]
    assert np.array([t for t, _picture in frames]) == pytest.approx(film.times, abs=1e-4)
    redness = np.array([(picture[..., 0] - picture[..., 1:].mean(axis=2)).max() for _t, picture in frames])
    assert set(np.flatnonzero(redness > 0.75 * redness.max()).tolist()) == set(FLAGGED)


def test_residuals_are_of_the_side_of_a_corner() -> None:
    t = np.arange(30.0)
    x = np.stack([np.abs(t - 14.3), t**2], axis=1)
    assert np.abs(smooth_residuals(t, x)).max() < 1e-9
