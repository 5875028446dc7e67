"""Laws of films without units: balls that fly as balls do are not blamed, those that hang in the air or tremble are."""

from __future__ import annotations

import json

import numpy as np
import pytest
from reference.judged_runs import FILM_KINDS, film_of

from carom.tracks.verdicts import by_film_laws


@pytest.mark.parametrize("kind", FILM_KINDS)
def test_films_of_bounces_violate_nothing_with_drag_perspective_and_a_rolled_camera(kind: str) -> None:
    found = [by_film_laws(film_of(kind, seed), "no scale") for seed in range(4)]
    assert [one.violations for one in found] == [[]] * 4
    assert sum(one.checked["flight"] for one in found) >= 2


@pytest.mark.parametrize(("wrong", "size", "law"), [("hang", 0.5, "flight"), ("jitter", 0.3, "steady")])
def test_a_ball_that_hangs_or_trembles_is_found(wrong: str, size: float, law: str) -> None:
    found = [by_film_laws(film_of("clean", seed, wrong, size), "no scale") for seed in range(6)]
    blamed = [one for one in found if any(violation.law == law for violation in one.violations)]
    assert len(blamed) >= 3
    worst = blamed[0].worst(law)
    assert worst is not None
    assert worst.sigmas > 5
    assert blamed[0].unit == "px"
    assert json.dumps(blamed[0].scores)  # (as the command prints them)
    assert 0 <= blamed[0].scores[law] < 1


def test_what_cannot_be_judged_is_said() -> None:
    path = film_of("clean", 1)
    for other, said in (
        (path._replace(seen=0.8), "hidden in part"),
        (path._replace(radius=5.0), "too small"),
        (path._replace(places=np.repeat(path.places[::2], 2, axis=0)[: len(path.times)]), "frames are repeated"),
        (
            path._replace(places=np.where(np.arange(len(path.times))[:, None] < 10, path.places, np.nan)),
            "10 frames only",
        ),
    ):
        found = by_film_laws(other, "no scale")
        assert found.violations == []
        assert said in found.unchecked["flight"]
        assert found.verdict.startswith("checked 0 of 2 laws")
