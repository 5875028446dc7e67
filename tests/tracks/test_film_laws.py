"""Laws of films without units: balls that fly as balls do are not blamed, those that hang in the air or tremble are."""

from __future__ import annotations

import json

import numpy as np
import pytest
from reference.judged_runs import FILM_KINDS, film_of

from carom.cli.judge import _show
from carom.tracks.verdicts import FilmPath, by_film_laws


@pytest.mark.parametrize("kind", FILM_KINDS)
def test_films_of_bounces_violate_nothing_with_drag_perspective_and_a_rolled_camera(kind: str) -> None:
    found = [by_film_laws(film_of(kind, seed), "no scale") for seed in range(4)]
    assert [one.violations for one in found] == [[]] * 4
    assert sum(one.checked["flight"] for one in found) >= 2


@pytest.mark.parametrize(
    ("wrong", "size", "law"), [("hang", 0.5, "flight"), ("jitter", 0.3, "steady"), ("long", 0.3, "shape")]
)
def test_a_ball_that_hangs_or_trembles_or_is_none_is_found(wrong: str, size: float, law: str) -> None:
    found = [by_film_laws(film_of("clean", seed, wrong, size), "no scale") for seed in range(6)]
    blamed = [one for one in found if any(violation.law == law for violation in one.violations)]
    assert len(blamed) >= 3
    worst = blamed[0].worst(law)
    assert worst is not None
    assert worst.sigmas > 5
    assert blamed[0].unit == "px"
    assert json.dumps(blamed[0].scores)  # (as the command prints them)
    assert 0 <= blamed[0].scores[law] < 1


def test_what_cannot_be_judged_is_said(capsys: pytest.CaptureFixture[str]) -> None:
    path = film_of("clean", 1)
    _show(by_film_laws(path, "no scale"))
    assert "noise of a coordinate 0." in capsys.readouterr().out
    _show(by_film_laws(path._replace(seen=0.8), "no scale"))
    assert "noise of a coordinate" not in capsys.readouterr().out
    for other, said in (
        (path._replace(seen=0.8), "hidden in part"),
        (path._replace(radius=5.0), "too small"),
        (path._replace(outlines=0.6 * path.radius * np.ones((len(path.times), 3))), "looks like what is behind it"),
        (path._replace(places=np.repeat(path.places[::2], 2, axis=0)[: len(path.times)]), "frames are repeated"),
        (
            path._replace(places=np.where(np.arange(len(path.times))[:, None] < 10, path.places, np.nan)),
            "10 frames only",
        ),
    ):
        found = by_film_laws(other, "no scale")
        assert found.violations == []
        assert said in found.unchecked["flight"]
        assert found.checked["flight"] == found.checked["steady"] == 0


@pytest.mark.parametrize("falls", [True, False])
def test_a_ball_that_falls_at_one_speed_soon_after_its_top_is_found(falls: bool) -> None:
    """Ten frames after a bounce: with the acceleration of gravity all the way, or without any from the third frame on."""
    t = np.arange(15.0)
    v = np.where(t < 7, -24.0 + 4 * t, -24.0 + 4 * t if falls else 12.0)
    y = 395 + np.cumsum(v) + np.random.default_rng(3).normal(scale=0.1, size=15)
    places = np.column_stack([np.full(24, 500.0), np.append(400 + 20 * np.arange(-8.0, 1), y)])
    path = FilmPath(np.arange(24) / 30, places, 12.0, 1.0, np.tile([12.0, 0.0, 0.0], (24, 1)), (640.0, 360.0))
    found = by_film_laws(path, "no scale")
    assert found.checked["flight"] == 1
    assert bool(found.of("flight")) is not falls
    larger = path._replace(outlines=np.column_stack([np.linspace(9, 15, 24), np.zeros((24, 2))]))
    assert by_film_laws(larger, "no scale").checked["flight"] == 0  # (perspective may do that)


def test_a_ball_that_bounces_higher_each_time_is_found() -> None:
    for seed in (16, 19, 34):
        for e, wrong in ((1.15, True), (0.85, False)):
            found = by_film_laws(film_of("clean", seed, "gain", e), "no scale")
            assert bool(found.of("bounce")) is wrong
            assert found.checked["bounce"] or not wrong


@pytest.mark.parametrize(
    ("wrong", "size", "law", "seeds"),
    [("softer", 0.2, "restitution", (3, 4, 12)), ("faster", 0.5, "size", (4,)), ("swell", 0.5, "size", (1, 6))],
)
def test_flights_of_a_film_have_one_restitution_and_one_gravity(
    wrong: str, size: float, law: str, seeds: tuple[int, ...]
) -> None:
    for seed in seeds:
        assert by_film_laws(film_of("clean", seed, wrong, size), "no scale").of(law)
        assert by_film_laws(film_of("clean", seed, wrong, 0.0), "no scale").violations == []


def test_of_a_camera_that_moves_the_shape_alone_is_judged() -> None:
    found = by_film_laws(film_of("clean", 2, "long", 0.3)._replace(moves="a picture that moves"), "no scale")
    assert [one.law for one in found.violations] == ["shape"]
    assert "the camera moves" in found.unchecked["flight"]
    # a ball that bounces higher each time, before a camera that sees all of it
    # as long a ball in the corner of a wide picture is one
    seen = film_of("clean", 2)
    assert by_film_laws(seen._replace(corner=(1.0, 1.0)), "").violations == []
