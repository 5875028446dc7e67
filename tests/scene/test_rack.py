"""Racks whose gaps are drawn from a seed, and bad input to them."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import carom

POOL = carom.load_scene("pool-9ft")
A = POOL.balls[1].radius


def gaps_of(scene: carom.Scene) -> Any:
    """The gaps of all pairs of racked balls, sorted, m."""
    x = np.array([scene.balls[scene.ball_names.index(name)].center for name in scene.rack.balls])  # type: ignore[union-attr]
    one, other = np.triu_indices(len(x), 1)
    return np.sort(np.linalg.norm(x[one] - x[other], axis=1) - 2 * A)


def racked(**fields: Any) -> carom.Scene:
    return carom.replaced(POOL, {f"rack.{name}": value for name, value in fields.items()})


def test_a_rack_has_the_gaps_that_are_asked_for() -> None:
    tight = racked(gap="0.05 mm")
    assert gaps_of(tight)[:30] == pytest.approx(np.full(30, 5e-5), abs=1e-12)
    assert gaps_of(tight)[30] > A  # (30 pairs of neighbours)
    assert tight.balls[1].position == POOL.balls[1].position
    # the numbers in the file of the table are those of its own gap, rounded to a micrometre
    found, written = (np.array([ball.center for ball in one.balls]) for one in (racked(gap="0.1 mm"), POOL))
    assert np.abs(found - written).max() < 5e-7


def test_gaps_are_drawn_within_the_spread_from_a_seed() -> None:
    found = np.array([gaps_of(racked(gap=5e-5, gap_spread=4e-5, seed=seed))[:30] for seed in range(60)])
    assert np.abs(found - 5e-5).max() < 4e-5
    assert found.mean() == pytest.approx(5e-5, abs=1e-6)
    assert found.std() == pytest.approx(4e-5 / math.sqrt(8), rel=0.05)
    assert len({tuple(row) for row in found}) == 60
    same = [racked(gap=5e-5, gap_spread=4e-5, seed=3) for _ in range(2)]
    assert same[0] == same[1]
    # as recorded: the same seed, the same bits, on every machine and in every version
    assert [x.hex() for x in same[0].balls[2].center[:2]] == ["0x1.5e7debc273b23p-1", "-0x1.d4e9d65efc137p-6"]


def test_touching_balls_are_no_overlap_and_a_spread_lets_none_overlap() -> None:
    assert len(carom.simulate(racked(gap=0), max_events=1).events) == 16
    assert gaps_of(racked(gap=0))[:30] == pytest.approx(np.zeros(30), abs=1e-15)
    assert all(gaps_of(racked(gap=1e-5, gap_spread=1e-5, seed=seed))[0] > 0 for seed in range(40))


def test_other_rows_and_other_copies(tmp_path: Path) -> None:
    nine = {"balls": POOL.balls[:10], "rack.balls": list("123456789"), "rack.gap": 0}
    diamond = carom.replaced(POOL, {**nine, "rack.rows": [1, 2, 3, 2, 1]})
    assert (gaps_of(diamond) < 1e-12).sum() == 16
    row = carom.replaced(POOL, {**nine, "rack.rows": [1] * 9})
    assert {ball.center[1] for ball in row.balls[1:]} == {0}
    file = carom.save_scene(racked(gap=5e-5, gap_spread=4e-5, seed=7), tmp_path / "rack.toml")
    assert carom.load_scene(file) == racked(gap=5e-5, gap_spread=4e-5, seed=7)
    assert carom.replaced(carom.load_scene(file), {"rack.seed": 3}) == racked(gap=5e-5, gap_spread=4e-5, seed=3)


@pytest.mark.parametrize(
    ("fields", "said"),
    [
        ({"gap": -1e-5}, "rack.gap: expected a length in m, >= 0, got -1e-05"),
        ({"gap": "5 kg"}, "rack.gap: expected a length in m, >= 0, got '5 kg'"),
        ({"gap": 0.05}, "rack.gap: expected less than the radius, 28.6 mm, got 50 mm; a number is in m"),
        ({"gap": 5e-5, "gap_spread": 6e-5}, "rack.gap_spread: expected at most the gap, 50 µm, got 60 µm; balls would overlap"),
        ({"gap_spread": 6e-5}, "rack.gap: expected a length in m, >= 0, as there is a gap_spread, got nothing"),
        ({"gap": 5e-5, "seed": -1}, "rack.seed: expected a whole number >= 0, got -1"),
        ({"gap": 5e-5, "seed": 0.5}, "rack.seed: expected a whole number >= 0, got 0.5"),
        ({"balls": ["1", "2"]}, "rack.balls: expected names of 1, 3, 6, 10, 15, ... balls, got 2 balls"),
        ({"balls": []}, "rack.balls: expected names of 1, 3, 6, 10, 15, ... balls, got 0 balls"),
        ({"rows": [7, 7]}, "rack.balls: expected names of 14 balls, got 15 balls in rows of [7, 7]"),
        ({"balls": ["1", "2", "2"]}, "rack.balls: expected each ball once, got '2' twice"),
        ({"balls": ["1", "2", "whit"]}, "got 'whit'; did you mean 'white'?"),
    ],
)  # fmt: skip
def test_bad_racks_are_refused_in_one_line(fields: dict[str, Any], said: str) -> None:
    with pytest.raises(carom.CaromError) as caught:
        racked(**fields)
    assert len(caught.value.faults) == 1
    assert said in caught.value.faults[0]


def test_a_rack_without_its_balls_is_refused() -> None:
    ball = {"radius": A, "mass": 0.17, "position": (0, 0, A)}
    with pytest.raises(
        carom.CaromError, match=r"^Scene: rack\.balls: expected names of 1, 3, 6, 10, 15, .* balls, got 0 balls"
    ):
        carom.Scene(balls=[ball], rack={"gap": "0.05 mm"})
    with pytest.raises(carom.CaromError, match=r"^Scene: rack\.balls: expected a list, got '1'"):
        carom.Scene(balls=[ball], rack={"balls": "1"})


def test_a_place_of_a_ball_that_the_gaps_lay_is_refused_and_so_are_two_radii() -> None:
    laid = racked(gap="0.05 mm")
    with pytest.raises(carom.CaromError, match=r"a ball of the rack, '4', whose place follows from rack\.gap"):
        carom.replaced(laid, {"balls.4.position": (0, 0)})
    moved = carom.replaced(laid, {"balls.1.position": (0.6, 0.1)})
    assert gaps_of(moved)[:30] == pytest.approx(np.full(30, 5e-5), abs=1e-12)
    with pytest.raises(
        carom.CaromError, match=r"rack\.balls\[3\]: expected a ball of radius 28.6 mm, as the first, got 27 mm"
    ):
        carom.replaced(laid, {"balls.4.radius": 0.027})


def test_balls_that_are_too_soft_or_too_hard_are_refused_in_one_line() -> None:
    for young, said in (
        (
            1.0,
            r"ball_contact\.young: expected at least 4\.\d+e\+06 Pa: softer balls press deeper than 14.3 mm at 9.5 m/s",
        ),
        (1e16, r"ball_contact\.young: expected at most 1e\+15 Pa, got 1e\+16 Pa"),
    ):
        with pytest.raises(carom.CaromError, match=said) as caught:
            carom.replaced(POOL, {"ball_contact.young": young})
        assert len(caught.value.faults) == 1
    assert carom.replaced(POOL, {"ball_contact.young": 1.0, "ball_contact.overlap": False}).ball_contact.young == 1
    assert carom.replaced(POOL, {"ball_contact.young": 5e6}).ball_contact.young == 5e6


def test_a_rack_that_overlaps_by_digits_passes_and_a_deeper_one_says_how_much_and_which() -> None:
    balls = [{"radius": A, "mass": 0.17, "position": (x, 0, A)} for x in (0.0, 2 * A - 7e-10)]
    assert len(carom.Scene(balls=balls).balls) == 2
    balls[1]["position"] = (2 * A - 1e-6, 0, A)
    with pytest.raises(
        carom.CaromError, match=r"balls\[1\]\.position: .* overlaps balls\[0\] by 1 µm; move it by 1 µm"
    ):
        carom.Scene(balls=balls)


def test_a_default_that_is_too_soft_is_no_fault() -> None:
    """Balls of no matter that there is, a kilogram in a micrometre, have contacts without a duration; a given modulus is judged."""
    balls = [carom.SceneBall(radius=1e-6, mass=1.0, position=(k * 4e-6, 0, 0), velocity=(1 - k, 0, 0)) for k in (0, 1)]
    scene = carom.Scene(gravity=0, balls=balls, run=carom.Run(duration=1e-3))
    assert not scene.ball_contact.overlap
    assert carom.Scene.model_validate_json(scene.model_dump_json()) == scene
    assert carom.simulate(scene).final.velocity[1, 0] == pytest.approx(1.0)
    with pytest.raises(carom.CaromError, match=r"ball_contact\.young: expected at least"):
        carom.Scene(gravity=0, balls=balls, ball_contact=carom.BallContact(young=1e9), run=carom.Run(duration=1e-3))
