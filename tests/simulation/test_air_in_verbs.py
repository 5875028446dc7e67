"""Air in every verb: derivatives through whole runs, JAX, aim, sweeps, judge, frames, plots, the page; and what refuses it."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import matplotlib.pyplot as plt
import numpy as np
import pytest
from reference.air_events import drawn_room, drawn_table
from simulation.test_air import BALL, K, flight, on_table

import carom
from carom.gas.scene import gas_text
from carom.interop.run_function import RunFunction
from carom.scene.air import air_acceleration
from carom.sweeps.axes import FAILURES
from carom.tracks import judge

api: Any = carom  # (parts of scenes as dicts)


def differences(scene: Any, path: str, h: float) -> Any:
    """Central differences of order 4 of the final places, by a number of the scene or a component of one."""
    whole, _, axis = path.rpartition(".") if path[-2:] in (".x", ".y", ".z") else (path, "", "")
    base: Any = scene
    for part in whole.split("."):
        base = base[int(part)] if part.isdecimal() else getattr(base, part)

    def at(by: float) -> Any:
        value = tuple(x + (by if axis == "xyz"[k] else 0) for k, x in enumerate(base)) if axis else base + by
        return api.simulate(api.replaced(scene, {whole: value})).final.position

    return (8 * (at(h) - at(-h)) - (at(2 * h) - at(-2 * h))) / (12 * h)


@pytest.mark.parametrize(
    "columns",
    [
        ["balls.0.velocity", "balls.0.spin"],
        ["balls.0.drag", "floor.friction", "floor.rolling_resistance", "air.wind"],
    ],
)
def test_derivatives_through_the_end_of_a_slide_that_air_drives_sideways(columns: list[str]) -> None:
    scene = on_table(
        0.8, air={"wind": (1.0, 2.0, 0)}, velocity=(2, 1, 0), spin=(20, -30, 15), lift="tennis",
        floor={"rolling_resistance": 0.02},
    )  # fmt: skip
    run = api.simulate(scene)
    assert "rolling" in run.events.kinds
    found = run.sensitivity(columns)
    for k, column in enumerate(found.columns):
        expected = differences(scene, column, 1e-3 if column.startswith("balls.0.spin") else 1e-4)
        assert np.abs(found.final.position[..., k] - expected).max() < 1e-7 * (1 + np.abs(expected).max()), column
    many = api.sensitivities(scene, columns, velocity=[scene.balls[0].velocity])
    assert many.why.tolist() == [""]
    assert np.abs(many.derivatives.position[0] - found.final.position).max() < 1e-9


def test_derivatives_by_the_air() -> None:
    scene = api.replaced(drawn_room(1, balls=1), {"air.wind": (0.3, 1.0, 0.1)})
    for columns, h in ((["air.density"], 1e-4), (["air.temperature", "air.pressure"], 1e-2), (["air.wind"], 1e-4)):
        if columns[0] == "air.temperature":
            scene = api.replaced(scene, {"air": api.scene.SceneAir(wind=scene.air.wind)})
        found = api.simulate(scene).sensitivity(columns)
        for k, column in enumerate(found.columns):
            step = 10.0 if column == "air.pressure" else h
            expected = differences(scene, column, step)
            assert np.abs(found.final.position[..., k] - expected).max() < 1e-8 * (1 + np.abs(expected).max()), column
    for path, names in (("air.density", "air.temperature and air.pressure"), ("air.viscosity", "air.temperature")):
        with pytest.raises(carom.CaromError, match=f"follows from {names}"):
            api.simulate(scene).sensitivity([path])


def test_a_run_in_air_as_a_function() -> None:
    """What JAX and PyTorch are given."""
    wrt = ["balls.0.velocity", "balls.0.drag", "air.density"]
    scene = on_table(0.4, velocity=(3, 1, 0), lift="tennis")
    function = RunFunction(scene, wrt, "final.position", "test")
    x = np.array([function.start, function.start * 1.02])
    value, slopes = function.differentiate(x)
    for n, row in enumerate(x):
        changed = api.replaced(
            scene, {"balls.0.velocity": (*row[:2], 0.0), "balls.0.drag": float(row[2]), "air.density": float(row[3])}
        )
        run = api.simulate(changed)
        assert np.abs(value[n] - run.final.position).max() < 1e-14
        assert np.abs(slopes[n] - run.sensitivity(wrt).final.position).max() < 1e-9


def test_aim_at_a_ball_in_air() -> None:
    scene = api.Scene(
        air={"density": 1.2}, floor={"friction": 0.25, "restitution": 0.5, "rolling_resistance": 0.01},
        balls=[BALL | {"position": place, "drag": 0.5, "lift": "tennis"} for place in ((0, 0), (0.8, 0.3))],
        run={"law": "contact", "duration": 5},
    )  # fmt: skip
    best = carom.aim(
        scene, {"balls.0.velocity": (1.0, 2.0)}, [{"ball": 0, "hit": 1}, {"ball": 1, "point": (1.2, 0.45)}], starts=512
    )
    run = api.simulate(best[0].scene)
    assert np.abs(run.final.position[1, :2] - (1.2, 0.45)).max() < 0.01


def test_a_sweep_over_air_is_its_runs() -> None:
    scene = flight(0.5, velocity=(4, 0, 2), floor={"friction": 0.3, "restitution": 0.8})
    space = carom.Space(scene, {"air.density": [0.5, 1.2], "balls.0.drag": [0.3, 0.5]})
    found = carom.sweep(space, keep=["final.position"]).run()["final.position"].values
    for i, density in enumerate((0.5, 1.2)):
        for j, drag in enumerate((0.3, 0.5)):
            run = api.simulate(api.replaced(scene, {"air.density": density, "balls.0.drag": drag}))
            assert np.array_equal(found[i, j], run.final.position)


def test_a_sweep_names_the_points_that_air_ends() -> None:
    crisis = {"form": "table", "reynolds": [1.2e4, 1.25e4], "values": [4.0, 0.05]}
    scene = on_table(velocity=(8, 0, 0), rolling=True, drag=crisis)
    found = carom.sweep(carom.Space(scene, {"balls.0.velocity.x": [1.0, 8.0]}), keep=["final.position"]).run()
    assert found["failed"].values.tolist() == [0, FAILURES.index("lost_in_air")]
    assert np.isnan(found["final.position"].values[1]).all()


@pytest.mark.parametrize("rate", [60, 240])
@pytest.mark.parametrize("kind", [".csv", ".json"])
def test_judge_blames_no_run_in_air(rate: float, kind: str, tmp_path: Path) -> None:
    topspin = carom.simulate(Path(carom.__file__).parent / "explorer/presets/topspin.toml")
    for n, run in enumerate((topspin, api.simulate(drawn_table(1)), api.simulate(drawn_room(2)))):
        found = judge(run.save_frames(tmp_path / f"{n}{kind}", rate))
        assert found.violations == []
    assert judge(topspin.save_frames(tmp_path / f"run{kind}", rate)).checked["gravity"] > 2
    # without what the air does to them, they do not fall freely; with a drag they do
    rows = json.loads(topspin.save_frames(tmp_path / "run.json", 240).read_text())
    del rows["air"]
    (bare := tmp_path / "bare.json").write_text(json.dumps(rows))
    blamed = judge(bare)
    assert blamed.of("gravity")
    assert any("drag_per_metre" in note for note in blamed.notes)
    assert not judge(bare, drag_per_metre=0.54 * K).of("gravity")
    assert judge(bare, drag_per_metre=0.02 * K).of("gravity")


def test_the_acceleration_by_the_air_is_that_of_the_path() -> None:
    run = api.simulate(drawn_room(1))
    end = float(run.events[0].t)
    times = np.linspace(0.2, 0.8, 4) * end
    h = 1e-3 * end
    v = [run.at(times + k * h).velocity for k in (-1, 1)]
    here = run.at(times)
    found = air_acceleration(run.scene, here.velocity, here.spin) + np.array(run.scene.pull)
    assert np.abs((v[1] - v[0]) / (2 * h) - found).max() < 1e-4


def test_frames_and_plots_of_a_run_in_air(tmp_path: Path) -> None:
    run = carom.simulate(Path(carom.__file__).parent / "explorer/presets/topspin.toml")
    table = run.table(np.linspace(0, 1, 5))
    assert {"air_x", "air_y", "air_z"} <= set(table.columns)
    figure = run.plot(tmp_path / "run.png")
    lines = [line for axes in figure.axes for line in axes.lines]
    assert (tmp_path / "run.png").stat().st_size > 10_000
    # (a curve through the states, no parabola)
    assert max(len(line.get_xdata()) for line in lines) > 20
    plt.close(figure)


def test_what_refuses_air_in_one_line(tmp_path: Path) -> None:
    gas = tmp_path / "gas.toml"
    gas.write_text("[air]\ndensity = 1.2\n" + gas_text())
    with pytest.raises(carom.CaromError) as raised:
        carom.simulate_gas(gas)
    assert [fault.field for fault in raised.value.records] == ["air"]
    scene = flight(0.5, drag={"form": "spin", "still": 0.4, "per_spin": 0.1})
    with pytest.raises(carom.CaromError) as raised:
        carom.explore(scene)
    assert [fault.field for fault in raised.value.records] == ["balls[0].drag"]
    run = api.simulate(flight(0.5))
    with pytest.raises(carom.CaromError, match="without air"):
        _ = run.sensitivity(["balls.0.velocity"]).near_misses
    with pytest.raises(carom.CaromError, match="number >= 0"):
        flight(0.5, drag=-1)
    with pytest.raises(carom.CaromError, match="circle: air: expected a field that is known here"):
        api.orbit("circle", air={"density": 1.2})
