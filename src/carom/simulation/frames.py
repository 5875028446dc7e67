"""A run frame by frame, and tables of it, as files for other programs: CSV, Parquet, and for frames JSON.

Every number has full precision. A file is written completely or not at all.
"""

from __future__ import annotations

import csv
import json
import math
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from carom.errors import CaromError
from carom.files import atomic_path, require_writable
from carom.formatting import counted, json_value
from carom.simulation.run_record import RunRecord
from carom.simulation.save import write_parquet
from carom.simulation.tables import UNITS, Columns, state_columns

__all__ = ["FORMATS", "FRAME_RATE", "frame_times", "save_frames", "write_columns"]

FORMATS = (".csv", ".json", ".parquet")
FRAME_RATE = 60.0  # 1/s
MOST_STATES = 10_000_000  # in one file: 2 GB of CSV


def frame_times(run: RunRecord, rate: float = FRAME_RATE) -> NDArray[np.float64]:
    """Return the times of all frames of a run, s: 0, 1/rate, 2/rate, ..., up to the run's end.

    Raises CaromError, one line, for a rate that is not a finite number above 0, and for more than ten million states.
    """
    if not (isinstance(rate, int | float) and 0 < rate < math.inf):
        raise CaromError(f"rate: expected frames per second, a number > 0, got {rate!r}")
    count = math.floor(run.end * rate * (1 + 1e-12)) + 1
    balls = len(run.scene.balls)
    if count * balls > MOST_STATES:
        got = f"{counted(count, 'frame')} of {counted(balls, 'ball')}"
        raise CaromError(
            f"rate: expected at most {MOST_STATES:,} states in a file, got {got}; lower the rate, or shorten the run"
        )
    return np.arange(count) / rate


def save_frames(run: RunRecord, path: Path, rate: float = FRAME_RATE) -> Path:
    """Write the states of all balls at every frame: .csv and .parquet a row per ball and frame, .json arrays (frame, ball, axis).

    Orientations are unit quaternions (w, x, y, z). A ball that is pocketed has no numbers: null in JSON, nan in CSV.
    """
    require_writable(path, FORMATS)
    times = frame_times(run, rate)
    with atomic_path(path) as part:
        if path.suffix.lower() == ".json":
            part.write_text(json.dumps(json_value(_arrays(run, times, rate)), allow_nan=False) + "\n", encoding="utf-8")
        else:
            write_columns(state_columns(run, times), part)
    return path


def write_columns(columns: Columns, path: Path) -> None:
    """Write named columns (N,) as CSV or Parquet, by the ending of the path."""
    if path.suffix.lower() == ".parquet":
        write_parquet(columns, {}, path)
        return
    with path.open("w", encoding="utf-8", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(columns)
        writer.writerows(zip(*(values.tolist() for values in columns.values()), strict=True))


def _arrays(run: RunRecord, times: NDArray[np.float64], rate: float) -> dict[str, Any]:
    state = run.at(times)
    assert state.position is not None
    balls = zip(run.scene.ball_names, run.scene.balls, strict=True)
    return {
        "scene": run.scene.describe(),
        "rate": rate,
        "units": {
            "t": "s",
            "position": UNITS["x"],
            "velocity": UNITS["vx"],
            "spin": UNITS["wx"],
            "orientation": "w, x, y, z",
        },
        "balls": [{"name": name, "radius": ball.radius, "mass": ball.mass} for name, ball in balls],
        "t": times.tolist(),
        "position": state.position.tolist(),
        "velocity": state.velocity.tolist(),
        "spin": state.spin.tolist(),
        "orientation": run.orientation(times).tolist(),
        "phase": run.phase(times).tolist(),
    }
