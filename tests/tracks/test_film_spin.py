"""Spin from the marks on a ball, of films rendered with a known spin and places as a tracker has them."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from reference.rendered_films import WHITE, Look, RenderedFilm, bouncing_film
from reference.tracked_truth import as_tracked

from carom.tracks import Track
from carom.tracks.video.spin import flight_spins, with_spins


def made(path: Path, pattern: str, spin: tuple[float, float, float], frames: int = 17) -> RenderedFilm:
    """A ball of 20 px at 60/s; its first flight has 16 frames."""
    return bouncing_film(
        path, radius=0.04, look=Look(WHITE, pattern), spin=spin, frames=frames, size=(240, 240), speed=0.3
    )


@pytest.mark.slow
def test_a_spin_of_one_radian_a_frame_is_measured_before_and_after_a_bounce(tmp_path: Path) -> None:
    film = made(tmp_path / "film.mp4", "soccer", (5.0, -8.0, -60.0), 34)
    found = as_tracked(film)
    flights = flight_spins(found, "ball")
    assert [one.why for one in flights] == ["", ""]
    assert flights[0].first == 0
    assert flights[1].first in (16, 17)  # (the contact is between frames 15 and 16)
    for one in flights:
        truth = film.spin["ball"][(one.first + one.last) // 2]
        assert np.abs(one.spin - truth).max() < 0.5
        assert (np.abs(one.spin - truth) < 2.5 * one.error).all()
        assert one.error[2] < 1.0
    track = Track("ball", found.times[2:], found.places["ball"][2:], frame=np.arange(2.0, 34.0))
    spun = with_spins(replace(found, tracks=(track,)))
    columns = spun.table()
    assert columns["spin [rad/s]"][1] == flights[0].spin[2]
    assert columns["sigma_spin [rad/s]"][18] == flights[1].error[2]
    assert len(spun.notes) == 2


def test_of_a_spin_too_fast_for_the_frames_the_possible_ones_are_named(tmp_path: Path) -> None:
    """2.2 rad from frame to frame; 4.1 rad the other way round look the same."""
    (one, *_rest) = flight_spins(as_tracked(made(tmp_path / "film.mp4", "mark", (5.0, -8.0, -130.0))), "ball")
    assert np.isnan(one.spin).all()
    speeds = [np.linalg.norm(spin) for spin in one.candidates]
    assert min(abs(speed - np.linalg.norm((5, -8, -130))) for speed in speeds) < 3
    assert min(abs(speed - (120 * np.pi - np.linalg.norm((5, -8, -130)))) for speed in speeds) < 3


@pytest.mark.parametrize(("pattern", "spin"), [("plain", -40.0), ("mark", 0.0)])
def test_no_spin_is_read_from_the_light(tmp_path: Path, pattern: str, spin: float) -> None:
    (one, *_rest) = flight_spins(as_tracked(made(tmp_path / "film.mp4", pattern, (0.0, 0.0, spin), 14)), "ball")
    assert np.isnan(one.spin).all()
    assert one.candidates == ()
