"""The break of a rack, against an integration of its contacts and against the figures of many racks (docs/theory/pairs.md)."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from reference.hertz_contacts import RADIUS, Case, integrate, known, rack

import carom

BREAKS = known()["breaks"]
SPEED, RACKS = 9.5, 48
Array = Any


def speeds_of_both(gap: float, spread: float = 0.0, seed: int = 1) -> tuple[Array, Array, Array]:
    """Speeds (16,) after the break of smooth balls: carom's, those of the integration, and those of one pair at a time."""
    centres = np.vstack([[-2.05 * RADIUS, 0.0, RADIUS], rack(gap, spread, seed)])
    moving = np.zeros_like(centres)
    moving[0] = SPEED, 0.02, 0.0
    case = Case(centres, moving, 0 * moving, 0.97, 0.0)
    balls = [
        carom.SceneBall(radius=RADIUS, mass=case.mass, position=tuple(x), velocity=tuple(v))
        for x, v in zip(centres.tolist(), moving.tolist(), strict=True)
    ]
    found = [
        carom.simulate(
            carom.Scene(
                gravity=0, balls=balls, ball_contact={"restitution": 0.97, "overlap": overlap}, run={"duration": 0.008}
            )
        )
        for overlap in (True, False)
    ]
    together, one_by_one = (np.linalg.norm(run.final.velocity, axis=1) for run in found)
    return together, np.linalg.norm(integrate(case, 0.008)[1], axis=1), one_by_one


@pytest.mark.parametrize(("gap", "spread", "seed", "most"), [(1e-4, 0.0, 1, 0.02), (3e-4, 2e-4, 4, 0.05)])
def test_a_rack_leaves_as_with_contacts_that_take_time(gap: float, spread: float, seed: int, most: float) -> None:
    # (gaps of 1 mm are as large as the places that the event neglects, u tau/2: speeds differ by up to 0.8 m/s there)
    found, right, one_by_one = speeds_of_both(gap, spread, seed)
    assert (found > 1).sum() == (right > 1).sum() > (one_by_one > 1).sum()
    assert np.abs(found - right).max() < most
    assert np.abs(one_by_one - right).max() > 1


def break_of(seed: int, *, overlap: bool = True) -> tuple[Array, Array]:
    """Figures of a break on a table of pool with gaps of 0.05 mm, drawn within 0.02: just after it, and 5 s later."""
    table = carom.load_scene("pool-9ft")
    radius, mass, foot = table.balls[0].radius, table.balls[0].mass, table.balls[1].position[0]
    centres = rack(5e-5, 4e-5, seed, radius) + np.array([foot, 0.0, 0.0])
    first = centres[0] - [2 * radius + 0.3, 0.0, 0.0]
    balls = [
        {"radius": radius, "mass": mass, "position": x, "velocity": (SPEED * (k == 0), 0.0, 0.0)}
        for k, x in enumerate(np.vstack([first, centres]).tolist())
    ]
    pair = {"restitution": 0.95, "friction": table.ball_contact.friction, "overlap": overlap}
    scene = carom.Scene(floor=table.floor, walls=table.walls, balls=balls, ball_contact=pair, run={"duration": 5.0})
    run = carom.simulate(scene)
    v = run.at(run.events.of("ball").t[0] + 0.012).velocity
    speed, x = np.linalg.norm(v, axis=1), run.final.position[1:]
    away = np.linalg.norm((x - centres.mean(axis=0))[:, :2], axis=1)
    return (
        np.array([(speed > 1).sum(), np.median(speed), (speed**2).max() / (speed**2).sum(), v[0, 0]]),
        np.array([away.mean(), (run.final.position[:, 0] < 0).sum()]),  # (of all 16, white too)
    )


def test_many_breaks_spread_as_they_should() -> None:
    found = np.mean([np.concatenate(break_of(seed)) for seed in range(RACKS)], axis=0)
    right = {
        name: bounds for name, bounds in BREAKS.items() if name != "one pair at a time"
    }  # (in this order: how many are fast, median, share, white, distance, across the line)
    for value, (name, (low, high)) in zip(found, right.items(), strict=True):
        assert low <= value <= high, f"{name}: {value}"


def test_one_pair_at_a_time_sends_most_of_the_energy_to_one_ball() -> None:
    found = np.mean([np.concatenate(break_of(seed, overlap=False)) for seed in range(8)], axis=0)
    assert found[0] < 5
    assert found[2] > 0.6
    assert found[4] < 0.5


def test_the_gap_of_a_rack_has_exact_derivatives() -> None:
    gaps = {"rack.gap": 5e-5, "rack.gap_spread": 4e-5, "rack.seed": 3}
    smooth = {"ball_contact.friction": 0.0, "run.duration": 0.135}  # (a slip that ends is noise to differences)
    scene = carom.replaced(carom.load_scene("pool-9ft"), gaps | smooth)
    found = np.squeeze(carom.simulate(scene).sensitivity("rack.gap").final.velocity)
    step = 1e-9
    more, less = (carom.simulate(carom.replaced(scene, {"rack.gap": 5e-5 + h})).final.velocity for h in (step, -step))
    assert np.abs(found).max() > 1000
    np.testing.assert_allclose(found, (more - less) / (2 * step), rtol=0, atol=1e-5 * np.abs(found).max())
