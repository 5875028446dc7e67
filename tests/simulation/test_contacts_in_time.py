"""Contacts that overlap in time, taken one pair at a time: which meetings are said to have them, against small steps."""

import json
import math

import numpy as np
import pytest
from typer.testing import CliRunner

import carom
from carom.cli import app
from carom.laws.pair import contact_time
from carom.simulation.contact_kinds import overlap_note, overlaps

R, M = 0.028575, 0.17
E_STAR = 5.84e9 / (2 * (1 - 0.34**2))
K = 4 / 3 * E_STAR * math.sqrt(R / 2)


PAIRS = {"overlap": False}


def row(*gaps, speed=1.0, aim=0.0, approach=0.2):
    """A ball that meets the first of balls in a row with these gaps, one pair at a time."""
    x, balls = 0.0, []
    for k, gap in enumerate((0.0, *gaps)):
        x += gap + 2 * R * (k > 0)
        balls.append({"radius": R, "mass": M, "position": (x, 0.0, R), "velocity": (0.0, 0.0, 0.0)})
    striker = {"radius": R, "mass": M, "position": (-2 * R - approach, aim, R), "velocity": (speed, 0.0, 0.0)}
    return carom.simulate(carom.Scene(balls=[striker, *balls], ball_contact=PAIRS, run={"duration": 2.0}))


def integrated(gap, speed):
    """Velocities after an elastic row of three, by Hertz's contacts in small steps; and whether both were closed at once."""
    x, v, dt, at_once = np.array([-2 * R, 0.0, 2 * R + gap]), np.array([speed, 0.0, 0.0]), 2e-7, False
    for _ in range(40_000):
        depth = np.maximum(2 * R - np.diff(x), 0.0)
        at_once |= bool((depth > 0).all())
        force = K * depth**1.5
        v += dt / M * np.array([-force[0], force[0] - force[1], force[1]])
        x += dt * v
    return v, at_once


@pytest.mark.parametrize(("gap", "overlap"), [(0.0, True), (5e-5, True), (1e-4, True), (1e-3, False), (3e-3, False)])
def test_a_row_of_three_is_said_to_overlap_where_contacts_do(gap, overlap):
    v, at_once = integrated(gap, 1.0)
    found = overlaps(row(gap))
    assert bool(found) == overlap
    if at_once:
        assert found  # none is missed
    if not overlap:  # and where nothing is said, one pair at a time is right
        assert v == pytest.approx([0.0, 0.0, 1.0], abs=2e-3)
    if found:
        assert (found[0].pair, found[0].third) == ((0, 1), 2)
        assert found[0].gap == pytest.approx(gap, abs=1e-12)


def test_the_duration_of_a_contact_is_the_integrated_one():
    for u in (0.1, 1.0, 9.5):
        depth, rate, t, dt = 0.0, u, 0.0, 1e-7
        while depth >= 0:
            rate -= dt * K * max(depth, 0.0) ** 1.5 / (M / 2)
            depth += dt * rate
            t += dt
        assert contact_time(M / 2, K, u) == pytest.approx(t, rel=3e-3)


def test_balls_that_touch_and_are_not_pushed_together_are_no_overlap():
    # the struck ball leaves the one that touches it, at a right angle
    still = [{"radius": R, "mass": M, "position": p} for p in ((0.0, 0.0, R), (0.0, 2 * R, R))]
    striker = {"radius": R, "mass": M, "position": (-0.3, 0.0, R), "velocity": (1.0, 0.0, 0.0)}
    run = carom.simulate(carom.Scene(balls=[striker, *still], ball_contact=PAIRS, run={"duration": 1.0}))
    assert overlap_note(run) is None
    assert overlap_note(row(0.3)) is None


def test_three_balls_and_their_numbers_do_not_matter():
    scene = row(0.0).scene
    turned = scene.model_copy(update={"balls": scene.balls[::-1]})
    (one,), (other,) = overlaps(row(0.0))[:1], overlaps(carom.simulate(turned))[:1]
    assert other.time == one.time
    assert other.third == 2 - one.third


def test_a_break_says_so_in_one_line(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "pairs.toml").write_text(
        carom.scene_text("pool-9ft").replace("[ball_contact]", "[ball_contact]\noverlap = false")
    )
    done = CliRunner().invoke(app, ["simulate", "pairs.toml", "--duration", "0.3"])
    said = " ".join(done.stdout.split())
    assert "Contacts overlap in time at " in said
    assert "(first at 0.1287 s: white and 1, with 2 100 µm away); the run resolves one pair at a time" in said
    done = CliRunner().invoke(app, ["simulate", "pairs.toml", "--duration", "0.3", "--json"])
    (note,) = json.loads(done.stdout)["notes"]
    assert note.startswith("contacts overlap in time at ")
    run = carom.simulate(carom.load_scene("pairs.toml"), duration=0.3)
    assert f"{note}." in run.describe()
    for table in ("carom", "pool-9ft"):  # (where contacts are resolved together there is nothing to say)
        done = CliRunner().invoke(app, ["simulate", table, "--duration", "0.3", "--json"])
        assert "notes" not in json.loads(done.stdout)
