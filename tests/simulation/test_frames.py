"""Files of frames: states and orientations of all balls as other programs read them; racks by name, and figures of a break."""

from __future__ import annotations

import csv
import json
from pathlib import Path

import numpy as np
import pytest

import carom
from carom.errors import CaromError


@pytest.fixture(scope="module")
def run() -> carom.Trajectory:
    return carom.simulate(carom.new_scene("pool-9ft", rack="9-ball", break_speed=8.0))


def turned(q: np.ndarray, v: np.ndarray) -> np.ndarray:
    """A vector turned by unit quaternions (w, x, y, z), by Rodrigues' formula."""
    w, u = q[..., :1], q[..., 1:]
    return v + 2 * np.cross(u, np.cross(u, v) + w * v)


def test_json_and_csv_hold_the_states_in_full_precision(run: carom.Trajectory, tmp_path: Path) -> None:
    found = json.loads(run.save_frames(tmp_path / "run.json", 20).read_text())
    rows = list(csv.DictReader(run.save_frames(tmp_path / "run.csv", 20).read_text().splitlines()))
    t = np.array(found["t"])
    assert t.tolist() == (np.arange(len(t)) / 20).tolist()
    assert t[-1] <= run.end < t[-1] + 1 / 20
    state = run.at(t)
    for name in ("position", "velocity", "spin"):
        given = np.array(found[name], dtype=float)  # (None, of a pocketed ball, becomes NaN)
        assert given.tobytes() == np.where(np.isnan(getattr(state, name)), np.nan, getattr(state, name)).tobytes()
    assert [ball["name"] for ball in found["balls"]] == list(run.scene.ball_names)
    assert len(rows) == len(t) * len(run.scene.balls)
    columns = {"x": state.position, "vy": state.velocity, "wz": state.spin}
    for (name, vectors), k in zip(columns.items(), range(3), strict=True):
        np.testing.assert_array_equal([float(row[name]) for row in rows], vectors[..., k].ravel())


def test_orientations_turn_with_the_spin(run: carom.Trajectory, tmp_path: Path) -> None:
    """A mark on the ball moves at spin x mark: differences of frames 10 us apart, by a formula of their own."""
    spin = run.at(1.0).spin
    moving = np.linalg.norm(spin, axis=1) > 1
    assert moving.sum() >= 3
    mark = np.array([0.3, -0.5, 0.8])
    before, now, after = (turned(run.orientation(1.0 + dt), mark) for dt in (-1e-5, 0.0, 1e-5))
    np.testing.assert_allclose((after - before)[moving] / 2e-5, np.cross(spin, now)[moving], atol=1e-3)


@pytest.mark.parametrize(
    ("name", "rate", "said"),
    [
        ("run.txt", 60, "expected a name that ends with .csv, .json or .parquet, got '.txt'"),
        ("run.csv", 0, "rate: expected frames per second, a number > 0, got 0"),
        ("run.csv", 1e9, "rate: expected at most 10,000,000 states in a file"),
    ],
)
def test_files_that_cannot_be(run: carom.Trajectory, tmp_path: Path, name: str, rate: float, said: str) -> None:
    with pytest.raises(CaromError) as caught:
        run.save_frames(tmp_path / name, rate)
    assert said in str(caught.value)
    assert not list(tmp_path.iterdir())


@pytest.mark.parametrize(("rack", "middle"), [("8-ball", "8"), ("9-ball", "9"), ("10-ball", "10")])
def test_racks_by_name_touch_as_racks_do(rack: str, middle: str) -> None:
    scene = carom.new_scene("pool-9ft", rack=rack)
    assert scene.rack is not None
    names = [name for name in scene.ball_names if name != "white"]
    assert sorted(names, key=int) == [str(k + 1) for k in range(len(names))]
    x = np.array([scene.balls[scene.ball_names.index(name)].position[:2] for name in names])
    gaps = np.linalg.norm(x[:, None] - x[None], axis=-1) - 2 * scene.balls[0].radius
    np.fill_diagonal(gaps, np.inf)
    assert gaps.min() == pytest.approx(1e-4, abs=1e-6)  # (positions in the file have six digits)
    near = (gaps < 2e-4).sum(axis=1)
    assert near[names.index(middle)] == 6
    assert near[names.index("1")] == 2
    again = carom.replaced(scene, {"rack.gap": 1e-4})  # laid anew by the rack's own rows: the same places
    np.testing.assert_allclose(
        [ball.position for ball in again.balls], [ball.position for ball in scene.balls], atol=2e-6
    )


def test_figures_of_a_break(run: carom.Trajectory) -> None:
    found = run.break_statistics()
    first = min(event.t for event in run.events.of("ball"))
    assert found.time == first
    v = run.at(first + 0.012).velocity
    energy = (v**2).sum(axis=1)
    assert found.share == pytest.approx(energy[found.fastest] / energy.sum(), rel=1e-12)
    assert found.fast == (np.sqrt(energy) > 1).sum()
    assert found.describe() in run.describe()
    with pytest.raises(CaromError, match="expected a scene with a rack"):
        carom.simulate(carom.new_scene()).break_statistics()


@pytest.mark.parametrize(
    ("asked", "said"),
    [
        (
            {"table": "pool-9ft", "rack": "9ball"},
            "rack: expected one of 15 balls, 8-ball, 9-ball, 10-ball, got '9ball'",
        ),
        (
            {"table": "snooker", "rack": "9-ball"},
            "rack: expected a pool table, for a rack by name, got a snooker table",
        ),
        (
            {"table": "pool-9ft", "break_speed": -1.0},
            "break_speed: expected a speed in m/s, > 0 and at most 100, got -1",
        ),
        (
            {"table": "pool-9ft", "break_speed": 400.0},
            "break_speed: expected a speed in m/s, > 0 and at most 100, got 400",
        ),
        ({"rack": "9-ball"}, "rack: expected a pool table by name with it"),
    ],
)
def test_racks_that_cannot_be(asked: dict[str, object], said: str) -> None:
    with pytest.raises(CaromError) as caught:
        carom.new_scene(**asked)  # type: ignore[arg-type]
    assert said in str(caught.value)
    assert len(caught.value.faults) == 1
