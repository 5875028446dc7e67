"""When a gas between oscillating walls is sampled: at all phases, whatever the duration and the frequency."""

from __future__ import annotations

import numpy as np
import pytest

from carom.gas import GasScene, Session
from carom.gas.files import load_checkpoint, save_checkpoint
from carom.gas.results import spread_time


def shaken(**run) -> GasScene:
    """Return inelastic discs on a floor with a period of 1."""
    between = [("a", "a"), ("a", "wall")]
    return GasScene(
        gravity=10.0, contact_time=1e-5, container={"shape": "box", "size": (12.0, 40.0), "periodic": ["x"]},
        species=[{"count": 40, "radius": 0.5, "temperature": 4.0}],
        contacts=[{"between": pair, "restitution": 0.9, "friction": 0} for pair in between],
        drives=[{"wall": "bottom", "amplitude": 0.6, "frequency": 1.0}], run={"equilibrate": 8000, "seed": 1, **run},
    )  # fmt: skip


def discrepancy(phases) -> float:
    """Return the largest difference between the share of the phases below a value and the value."""
    x, n = np.sort(np.mod(phases, 1.0)), len(phases)
    return float(max((np.arange(1, n + 1) / n - x).max(), (x - np.arange(n) / n).max()))


@pytest.mark.parametrize("frequencies", [[1.0], [1.0, 2.0], [1.0, 1.5], [1.0, np.pi, 7.0]])
@pytest.mark.parametrize("interval", [0.5, 1.0, 2.0, 0.618034, 34.0, 55.0, 64.0, 256.0, 12345.6])
def test_phases_are_spread_at_any_interval(interval, frequencies):
    times = [interval]
    while len(times) < 50:
        times.append(spread_time((len(times) + 1) * interval, interval, frequencies, times, 5))
    assert (np.diff(times) >= 0).all()
    assert np.abs(np.array(times) - interval * np.arange(0.5, 50)).max() <= interval / 2 * (1 + 1e-9)
    for one in frequencies:
        assert discrepancy(np.array(times) * one) < 0.1
        assert discrepancy(np.array(times[::5]) * one) < 0.25  # those at which pairs are counted


@pytest.mark.parametrize("run", [{"duration": 100.0}, {"max_events": 24_000}])
def test_samples_of_a_shaken_gas_have_all_phases(run):
    session, dense = Session(shaken(**run)), Session(shaken(**run))
    session.run()
    # far closer samples of the same motion, at steps that are no multiples of a period
    dense.run(stop=lambda: dense.mark is not None)
    gas, begin, warm = dense.gas, dense.gas.time, []
    for k in range(1000):
        gas.advance(until=begin + 0.1013 * (k + 1))
        warm.append(gas.energy()[0] / 40)
    series = session.measures.series
    assert 45 <= session.measures.samples <= 55
    assert discrepancy(series["time"]) < 0.1
    # (the temperature is 25 at one phase, 14 at another)
    assert series["translational"].mean() == pytest.approx(np.mean(warm), rel=0.04)


def test_a_run_in_pieces_takes_the_same_samples(tmp_path):
    scene = shaken(duration=20.0)
    whole, session, stops = Session(scene), Session(scene), 0
    whole.run()
    while not session.run(stop=iter([False, False, True]).__next__):
        stops += 1
        save_checkpoint(session, tmp_path / "c.npz")
        session = load_checkpoint(tmp_path / "c.npz", scene)
    assert stops > 5
    assert session.measures.series["time"].tobytes() == whole.measures.series["time"].tobytes()
    assert session.gas.balls().velocity.tobytes() == whole.gas.balls().velocity.tobytes()
