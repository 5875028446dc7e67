"""Inelastic collapse: recognised early, with its balls and its time, and without losing what was measured."""

import json
import math

import numpy as np
import pytest
from typer.testing import CliRunner

from carom import CaromError, Disc, Surface, simulate_gas
from carom.cli import app
from carom.gas import EndedEarlyError, Gas, Session, Species, load_gas
from carom.gas.files import load_checkpoint, save_checkpoint
from carom.sweeps import gas_ensemble

COLLAPSING = """
[container]
shape = "periodic"
size = [60, 60]
[[species]]
count = 400
radius = 0.5
[[contacts]]
between = ["a", "a"]
restitution = 0.1
friction = 0.0
tangential_restitution = -1
[run]
max_events = 100_000
equilibrate = 0
seed = 1
"""


@pytest.fixture
def folder(tmp_path, monkeypatch):
    (tmp_path / "gas.toml").write_text(COLLAPSING)
    monkeypatch.chdir(tmp_path)
    return tmp_path


def three_in_a_row(e, walls=1.0):
    """A disc at rest between two that approach it, on a line; far from all walls."""
    return Gas(
        [Species(Disc(0.5, 1.0, 0.5), 3)], (40.0, 4.0), periodic=False,
        contacts={("a", "a"): Surface(e, 0, -1), ("a", "wall"): Surface(walls, 0, -1)},
        position=[(15.0, 2.0), (20.0, 2.0), (26.0, 2.0)], velocity=[(1.0, 0.0), (0.0, 0.0), (-1.0, 0.0)],
    )  # fmt: skip


def followed(e, x, v, most=500):
    """Collide three points on a line, with gaps in place of places: the times of the collisions."""
    gaps, t, times = [x[1] - x[0] - 1, x[2] - x[1] - 1], 0.0, []
    for _ in range(most):
        closing = [v[0] - v[1], v[1] - v[2]]
        waits = [gap / u if u > 0 else math.inf for gap, u in zip(gaps, closing, strict=True)]
        k = waits.index(min(waits))
        if waits[k] == math.inf:
            return times, True
        t += waits[k]
        gaps = [gap - u * waits[k] for gap, u in zip(gaps, closing, strict=True)]
        gaps[k], change = 0.0, (1 + e) / 2 * closing[k]
        v[k], v[k + 1] = v[k] - change, v[k + 1] + change
        times.append(t)
    return times, False


# The condition for three balls on a line: e < 7 - 4 sqrt(3) = 0.0718 (McNamara & Young, Phys. Fluids A 4, 496 (1992)).
@pytest.mark.parametrize("e", [0.0, 0.02, 0.05])
def test_three_discs_on_a_line_collapse_when_theory_says_so(e):
    times, ended = followed(e, [15.0, 20.0, 26.0], [1.0, 0.0, -1.0])
    assert not ended
    with pytest.raises(EndedEarlyError, match=r"balls 0, 1 and 2 collide ever faster") as found:
        three_in_a_row(e).run(100_000)
    end, run = found.value.end, found.value.result
    assert (end.kind, end.balls) == ("inelastic collapse", (0, 1, 2))
    assert end.time == pytest.approx(times[-1], rel=1e-8)  # (gaps are rounded to 4e-15, at speeds of 1e-8 and less)
    assert run.simulated_time == end.time
    assert run.pair_collisions < 300
    assert math.isnan(run.mean_free_time)  # all balls take part: which collisions are the collapse's is not known


@pytest.mark.parametrize("e", [0.075, 0.3])
def test_three_discs_on_a_line_separate_above_the_limit(e):
    times, ended = followed(e, [15.0, 20.0, 26.0], [1.0, 0.0, -1.0])
    assert ended
    gas = three_in_a_row(e)
    run = gas.run(until=times[-1] + 1.0)
    assert run.pair_collisions == len(times)
    assert run.ended_early is None


def test_what_was_measured_is_the_gas_before_the_collapse():
    with pytest.raises(EndedEarlyError) as found:
        Gas([Species(Disc(0.5, 1.0), 400)], (60.0, 60.0), contacts=Surface(0.1, 0, -1), seed=1).run(100_000)
    run, end = found.value.result, found.value.end
    # the same gas with a short contact time, to the same time: it had been 0.49 after 100,000 collisions
    other = Gas(
        [Species(Disc(0.5, 1.0), 400)], (60.0, 60.0), contacts=Surface(0.1, 0, -1), contact_time=1e-6, seed=1
    ).run(until=end.time)
    assert run.mean_free_time == pytest.approx(other.mean_free_time, rel=0.2)
    assert run.pressure == pytest.approx(other.pressure, rel=0.1)
    assert 3 <= len(end.balls) <= 8
    assert 50 < end.collisions < 500
    assert "such as 0.003" in str(found.value)


@pytest.mark.parametrize("e", [0.8, 0.95])
def test_many_contacts_at_one_instant_are_no_collapse(e):
    # a disc hits 100 discs that touch: each has up to 150 contacts at one instant
    rows = [[10.0 + i + 0.5 * (j % 2), 10.0 + j * math.sqrt(3) / 2] for j in range(10) for i in range(10)]
    position = np.array([[8.0, 8.0], *rows])
    velocity = np.zeros_like(position)
    velocity[0] = 1.0
    gas = Gas(
        [Species(Disc(0.5, 1.0, 0.5), 101)], (30.0, 30.0), periodic=False, contacts=Surface(e, 0, -1), position=position,
        velocity=velocity,
    )  # fmt: skip
    assert gas.run(1500).ended_early is None


def test_a_ball_that_comes_to_lie_on_the_floor():
    gas = Gas(
        [Species(Disc(0.5, 1.0, 0.5), 1)], (4.0, 9.0), periodic=(True, False), gravity=(0, -1.0), contacts=Surface(0.5, 0, 0),
        position=[(2.0, 1.0)], velocity=[(0.3, 0.0)],
    )  # fmt: skip
    with pytest.raises(EndedEarlyError, match="ball 0 hits a wall ever faster") as found:
        gas.run(100_000)
    # it falls 0.5, then bounces for 2 e/(1 - e) times as long
    assert found.value.end.time == pytest.approx(3 * math.sqrt(2 * 0.5), rel=1e-9)
    assert found.value.result.wall_collisions < 200


def test_a_session_keeps_its_measures_and_its_checkpoint_knows(folder):
    session = Session(load_gas("gas.toml"))
    with pytest.raises(EndedEarlyError) as found:
        session.run()
    assert session.result.ended_early == found.value.end
    assert session.measures.samples == 1
    save_checkpoint(session, "c.npz")
    with pytest.raises(EndedEarlyError) as again:
        load_checkpoint("c.npz").run()
    assert again.value.end.balls == found.value.end.balls
    with pytest.raises(EndedEarlyError) as simple:
        simulate_gas(load_gas("gas.toml"))
    assert simple.value.result.pair_collisions == session.result.pair_collisions


def test_a_collapse_in_equilibration_says_that_nothing_was_measured(folder):
    (folder / "gas.toml").write_text(COLLAPSING.replace("equilibrate = 0", "equilibrate = 16000"))
    with pytest.raises(CaromError, match="nothing was measured, since the gas was still equilibrating"):
        simulate_gas(load_gas("gas.toml"))


@pytest.mark.slow
def test_the_command_prints_and_writes_what_was_measured(folder):
    words = ["gas", "gas.toml", "--quiet", "--json", "--measures", "m.json", "--snapshots", "s.gsd", "--plot", "p.svg"]
    done = CliRunner().invoke(app, words)
    (line,) = done.exception.faults
    shown = json.loads(done.stdout)
    end = shown["ended_early"]
    assert f"an inelastic collapse at t = {end['time']!r}: balls {end['balls'][0]}, {end['balls'][1]}" in line
    assert 2.4 < shown["mean_free_time"] < 3.6
    assert {"events", "species", "channels", "temperature_translational"} <= set(shown)
    assert json.loads((folder / "m.json").read_text())["ended_early"] == shown["ended_early"]
    assert {"m.json", "s.gsd", "p.svg"} <= {path.name for path in folder.iterdir()}
    table = CliRunner().invoke(app, ["gas", "gas.toml"])
    assert f"Measured until an inelastic collapse at t = {end['time']:.6g}" in table.stdout


def test_an_ensemble_keeps_gases_that_collapse(folder):
    with pytest.raises(EndedEarlyError, match=r"3 of 3 gases ended early \(the gas with seed \d+\)$") as found:
        gas_ensemble(load_gas("gas.toml"), 3)
    ensemble = found.value.result
    assert list(ensemble.ended_early) == list(ensemble.seeds)
    assert ensemble.mean["mean_free_time"] == pytest.approx(2.8, abs=0.4)
    done = CliRunner().invoke(app, ["gas", "gas.toml", "--ensemble", "3", "--json", "--quiet"])
    assert set(json.loads(done.stdout)["ended_early"]) == {str(seed) for seed in ensemble.seeds}
