"""Tables of a run: every number is the one that the run itself has."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

import carom
from carom.simulation.files import UNITS, event_columns

pytest.importorskip("pandas")

WALLS = {"shape": "table", "length": 2.0, "width": 1.0, "restitution": 0.9, "friction": 0.3, "name": "cushions"}


@pytest.fixture(scope="module")
def run() -> carom.Trajectory:
    """Three balls: walls, floor, balls, phases; one leaves."""
    ball = {"radius": 0.03, "mass": 0.2}
    return carom.simulate(
        carom.Scene(
            floor={"friction": 0.2, "restitution": 0.5, "rolling_resistance": 0.01, "spin_friction": 0.02},
            walls=[WALLS | {"height": 0.1}],
            balls=[
                ball | {"position": (-0.7, 0.0), "velocity": (2.0, 0.05), "rolling": True, "name": "white"},
                ball | {"position": (0.0, 0.04)},
                ball | {"position": (0.0, 0.4, 0.5), "velocity": (6.0, 0.0, 0.0)},
            ],
            ball_contact={"restitution": 0.95, "friction": 0.05},
            run={"duration": 4.0},
        )
    )


def test_events_are_those_of_the_run(run: carom.Trajectory) -> None:
    table = run.events.table()
    assert len(table) == len(run.events) > 10
    assert {"wall", "floor", "ball", "rolling", "left"} <= set(table["kind"])
    for event, row in zip(run.events, table.to_dict("records"), strict=True):
        for field in ("t", "kind", "ball", "other", "name", "phase", "regime", "required_friction"):
            assert row[field] == getattr(event, field), field
        assert row["energy_lost"] == pytest.approx(event.energy_lost, abs=1e-15)
        for k, axis in enumerate("xyz"):
            assert event.after.position is not None
            assert row[axis] == event.after.position[k]
            assert row[f"v{axis}"] == event.after.velocity[k]
            assert row[f"w{axis}"] == event.after.spin[k]
            assert row[f"v{axis}_before"] == event.before.velocity[k]
            assert row[f"w{axis}_before"] == event.before.spin[k]
            assert row[f"impulse_{axis}"] == event.impulse[k]
            assert row[f"floor_impulse_{axis}"] == event.floor_impulse[k]


def test_a_part_of_the_events(run: carom.Trajectory) -> None:
    table = run.events.of("wall", ball=0).table()
    assert len(table) == len(run.events.of("wall", ball=0)) > 0
    assert set(table["kind"]) == {"wall"}
    assert set(table["name"]) == {"cushions"}
    assert len(run.events[:0].table()) == 0


def test_every_quantity_has_its_unit(run: carom.Trajectory) -> None:
    units = run.events.table().attrs["units"]
    assert units["vx"] == units["vz_before"] == "m/s"
    assert units["wx"] == "rad/s"
    assert units["impulse_y"] == "N s"
    numbers = {name for name, values in event_columns(run, run.events.rows).items() if values.dtype.kind == "f"}
    assert numbers - set(UNITS) == {"required_friction"}


def test_states_one_ball_at_one_time_a_row(run: carom.Trajectory) -> None:
    times = np.array([0.0, 0.3, run.end])
    table, state = run.table(times), run.at(times)
    assert len(table) == 9
    assert table["t"].tolist() == np.repeat(times, 3).tolist()
    assert table["name"].tolist()[:3] == ["white", "ball 1", "ball 2"]
    assert table["phase"].tolist() == run.phase(times).ravel().tolist()
    assert np.array_equal(table[["vx", "vy", "vz"]].to_numpy(), state.velocity.reshape(-1, 3), equal_nan=True)
    assert state.position is not None
    assert np.array_equal(table[["x", "y", "z"]].to_numpy(), state.position.reshape(-1, 3), equal_nan=True)
    assert table["energy"][:3].sum() == pytest.approx(run.energy(0.0))
    assert len(run.table(0.5)) == 3


@pytest.mark.slow
def test_dataset_is_labelled(run: carom.Trajectory) -> None:
    pytest.importorskip("xarray")
    times = np.linspace(0.0, 1.0, 4)
    data = run.to_xarray(times)
    assert data["position"].dims == ("time", "ball", "axis")
    assert data["velocity"].attrs["units"] == "m/s"
    assert float(data["velocity"].sel(axis="y", ball=0).isel(time=2)) == run.at(times[2]).velocity[0, 1]
    assert np.array_equal(data["orientation"], run.orientation(times))
    assert data["phase"].values.tolist() == run.phase(times).tolist()


@pytest.mark.parametrize(
    ("library", "ask"), [("pandas", lambda run: run.table(0.0)), ("xarray", lambda run: run.to_xarray(0.0))]
)
def test_a_missing_library_is_named(
    run: carom.Trajectory, library: str, ask: Any, monkeypatch: pytest.MonkeyPatch
) -> None:
    import sys

    monkeypatch.setitem(sys.modules, library, None)
    with pytest.raises(carom.CaromError, match=f"needs {library}, .*install .*\\[{library}\\]") as caught:
        ask(run)
    assert len(caught.value.faults) == 1
