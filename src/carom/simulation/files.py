"""Tables of a run: events, or states at given times, as columns, as pandas DataFrames, or as an xarray Dataset.

All numbers are in SI units, named in ``table.attrs["units"]`` and, in a Dataset, in the ``units`` of each variable.
"""

from __future__ import annotations

import csv
import hashlib
import json
import math
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from carom.bodies import Numbers
from carom.core.motion.phases import PHASES
from carom.errors import CaromError
from carom.files import atomic_path, import_optional, require_writable
from carom.formatting import counted, json_value
from carom.laws.landing import REGIME_NAMES as NAMES
from carom.scene.air import air_acceleration
from carom.scene.toml import stored_model
from carom.simulation.contact_kinds import PARTNERS
from carom.simulation.records import KINDS, LOG, START, EventSource, RunRecord, kind_names

if TYPE_CHECKING:
    import pandas
    import xarray

Columns = dict[str, NDArray[Any]]
AXES = ("x", "y", "z")
UNITS = {
    "radius": "m", "mass": "kg", "kappa": "1",
    "t": "s", **dict.fromkeys(AXES, "m"),
    **{f"{of}{axis}{when}": unit for of, unit in (("v", "m/s"), ("w", "rad/s")) for axis in AXES for when in ("", "_before")},
    **{f"{of}_{axis}": "N s" for of in ("impulse", "floor_impulse") for axis in AXES},
    **{f"air_{axis}": "m/s^2" for axis in AXES}, "energy_lost": "J", "energy": "J", **{f"q{part}": "1" for part in ("w", *AXES)},
}  # fmt: skip


def kinetic_energy(
    balls: NDArray[np.void], ball: Any, velocity: NDArray[np.float64], spin: NDArray[np.float64]
) -> Numbers:
    """Return the kinetic energy, J, of ball number ``ball`` at a velocity and spin (3,); or of several (N,) at (N, 3)."""
    m, moment = balls["mass"][ball], (balls["kappa"] * balls["mass"] * balls["radius"] ** 2)[ball]
    found: Numbers = m * (velocity * velocity).sum(axis=-1) / 2 + moment * (spin * spin).sum(axis=-1) / 2
    return found


def _parts(columns: Columns, name: str, vectors: NDArray[np.float64], after: str = "") -> None:
    for k, axis in enumerate(AXES):
        columns[f"{name}{axis}{after}"] = np.ascontiguousarray(vectors[:, k])


def event_columns(run: EventSource, rows: NDArray[np.void]) -> Columns:
    """Return rows of a run's log as named columns (N,).

    ``vx`` ... ``wz`` are velocity and spin just after the event, ``vx_before`` ... just before; ``other`` is the number of the
    wall, of the other ball or of the pocket, -1 for none, ``name`` its name; ``energy_lost`` is this ball's.
    """
    name = np.full(len(rows), "", dtype=object)
    for met, names in PARTNERS.items():
        its = rows["met"] == met
        name[its] = np.array(getattr(run.scene, names), dtype=object)[rows["other"][its]]
    columns: Columns = {
        "t": np.array(rows["t"]),
        "kind": kind_names(rows),
        "ball": np.array(rows["ball"]),
        "other": np.array(rows["other"]),
        "name": name,
        "phase_before": np.array(PHASES, dtype=object)[rows["phase_before"]],
        "phase": np.array(PHASES, dtype=object)[rows["phase"]],
    }
    _parts(columns, "", rows["x"])
    _parts(columns, "v", rows["v_before"], "_before")
    _parts(columns, "w", rows["w_before"], "_before")
    _parts(columns, "v", rows["v"])
    _parts(columns, "w", rows["w"])
    _parts(columns, "impulse_", rows["impulse"])
    _parts(columns, "floor_impulse_", rows["floor_impulse"])
    columns["required_friction"] = np.array(rows["required"])
    columns["regime"] = np.array([*NAMES, ""], dtype=object)[rows["regime"]]
    of = rows["ball"]
    before, after = (run.kinetic_energy(of, rows[f"v{when}"], rows[f"w{when}"]) for when in ("_before", ""))
    columns["energy_lost"] = np.asarray(before - after)
    return columns


def _frame(columns: Columns, what: str) -> pandas.DataFrame:
    pandas = import_optional("pandas", what)
    frame = pandas.DataFrame(columns)
    frame.attrs["units"] = {name: UNITS[name] for name in columns if name in UNITS}
    return frame


def events_table(run: RunRecord, rows: NDArray[np.void]) -> pandas.DataFrame:
    """Return a DataFrame, one row per event (:func:`event_columns`). Raises CaromError without pandas."""
    return _frame(event_columns(run, rows), "Events.table")


def many_events_table(runs: EventSource, rows: NDArray[np.void]) -> pandas.DataFrame:
    """Return a DataFrame of many runs' events (N, M): :func:`event_columns` after ``run``, without the rows that no event fills."""
    number, place = np.nonzero(rows["kind"] != START)
    return _frame({"run": number, **event_columns(runs, rows[number, place])}, "ManyRuns.table")


def state_columns(run: RunRecord, times: NDArray[np.float64]) -> Columns:
    """Return states at times, s, as named columns, one row per ball and time.

    ``qw`` ... ``qz`` are the orientation, a unit quaternion from the body's frame; ``energy`` is the ball's own; in air
    ``air_x`` ... are the acceleration that it gives the ball.
    """
    state, count = run.at(times), len(run.scene.balls)
    assert state.position is not None
    columns: Columns = {
        "t": np.repeat(times.ravel(), count),
        "ball": np.tile(np.arange(count), times.size),
        "name": np.array(run.scene.ball_names * times.size, dtype=object),
        "phase": run.phase(times).astype(object).ravel(),
    }
    for name, vectors in (("", state.position), ("v", state.velocity), ("w", state.spin)):
        _parts(columns, name, vectors.reshape(-1, 3))
    for name, part in zip(("qw", "qx", "qy", "qz"), run.orientation(times).reshape(-1, 4).T, strict=True):
        columns[name] = np.ascontiguousarray(part)
    columns["energy"] = np.ravel(run.energy(times, each=True))
    for field in ("radius", "mass", "kappa"):
        columns[field] = np.tile([float(getattr(one.ball, field)) for one in run.scene.balls], times.size)
    if run.scene.air is not None:
        _parts(columns, "air_", air_acceleration(run.scene, state.velocity, state.spin).reshape(-1, 3))
    return columns


def states_table(run: RunRecord, times: NDArray[np.float64]) -> pandas.DataFrame:
    """Return a DataFrame of :func:`state_columns`. Raises CaromError without pandas."""
    return _frame(state_columns(run, times), "Trajectory.table")


def states_dataset(run: RunRecord, times: NDArray[np.float64]) -> xarray.Dataset:
    """Return a Dataset of the states, with the dimensions time, ball, axis. Raises CaromError without xarray.

    ``orientation`` is a unit quaternion (w, x, y, z) from the body's frame.
    """
    labelled = import_optional("xarray", "Trajectory.to_xarray")
    times = times.ravel()
    state = run.at(times)
    vector = ("time", "ball", "axis")
    dataset: xarray.Dataset = labelled.Dataset(
        {
            "position": (vector, state.position, {"units": "m"}),
            "velocity": (vector, state.velocity, {"units": "m/s"}),
            "spin": (vector, state.spin, {"units": "rad/s"}),
            "orientation": (("time", "ball", "part"), run.orientation(times), {"units": "1"}),
            "energy": (("time", "ball"), run.energy(times, each=True), {"units": "J"}),
            "phase": (("time", "ball"), run.phase(times)),
        },
        coords={
            "time": ("time", times, {"units": "s"}),
            "ball": np.arange(len(run.scene.balls)),
            "name": ("ball", np.array(run.scene.ball_names)),
            "axis": list(AXES),
            "part": ["w", *AXES],
        },
        attrs={"scene": run.scene.describe()},
    )
    return dataset


# ----------------------------------------------------------------------------------------------------
# Write a run to a file: Parquet (the extra ``parquet``).
#
# The file holds the log of events and the scene, from which :func:`carom.load_trajectory` makes the same
# :class:`~carom.Trajectory`, bit for bit. Kinds of events and phases are written by name, so that a later version of carom may
# number them otherwise.


FORMAT = 1
FORMATS = (".parquet",)
NAMED = {"kind": KINDS, "met": KINDS, "phase_before": PHASES, "phase": PHASES}
# The log's vectors, by what their columns are called.
VECTORS = {
    **{field: tuple(text.format(axis) for axis in AXES) for field, text in {
        "x": "{}", "v_before": "v{}_before", "w_before": "w{}_before", "v": "v{}", "w": "w{}",
        "impulse": "impulse_{}", "floor_impulse": "floor_impulse_{}",
    }.items()},
    "borne": ("borne_x", "borne_y", "borne_z", "borne_friction"),
}  # fmt: skip
SCALARS = {
    "t": "t", "ball": "ball", "other": "other", "required": "required_friction", "borne_by": "borne_by", "regime": "regime",
}  # fmt: skip

TABLES = (".csv", ".nc", ".xlsx", ".xls", ".json", ".txt")  # for which somebody wants the numbers, not the run

Array = NDArray[Any]


def save(run: RunRecord, path: Path) -> Path:
    """Write a run to a .parquet file, completely or not at all.

    Raises CaromError for another ending, a place that cannot be written to, and a run with a law that has no file.
    """
    if path.suffix.lower() in TABLES:
        raise CaromError(
            f"{path}: expected a name that ends with {' or '.join(FORMATS)}, got {path.suffix!r}; for a table of states use"
            " run.table() (a pandas DataFrame) or run.to_xarray(), of events run.events.table()"
        )
    require_writable(path, FORMATS)
    about = {
        "carom_format": FORMAT,
        "carom": version(),
        "scene": json.dumps(stored_model("save", run.scene)),
        "end": run.end,
        "ended": run.ended,
    }
    about["sha256"] = digest_of(run.log, about)
    with atomic_path(path) as part:
        write_parquet(log_columns(run.log), {"carom": json.dumps(about)}, part)
    return path


def digest_of(log: Array, about: dict[str, Any]) -> str:
    """Return a checksum of the contents of a file, which detects one changed bit."""
    digest = hashlib.sha256(f"{about['scene']} {float(about['end'])!r} {about['ended']}".encode())
    for values in log_columns(log).values():
        digest.update(" ".join(values).encode() if values.dtype == object else values.tobytes())
    return digest.hexdigest()


def version() -> str:
    """Return the version of carom that is installed."""
    from importlib import metadata

    try:
        return metadata.version("carom")
    except metadata.PackageNotFoundError:  # run from its sources
        return "unknown"


def write_parquet(columns: dict[str, Array], metadata: dict[str, str], path: Path) -> None:
    """Write columns to a Parquet file, each with its unit."""
    pa = import_optional("pyarrow", path.name)
    pq = import_optional("pyarrow.parquet", path.name)
    arrays = {name: pa.array(values) for name, values in columns.items()}
    fields = [
        pa.field(name, array.type, nullable=False, metadata={"unit": UNITS[name]} if name in UNITS else None)
        for name, array in arrays.items()
    ]
    pq.write_table(pa.Table.from_arrays(list(arrays.values()), schema=pa.schema(fields, metadata=metadata)), path)


def log_columns(log: Array) -> dict[str, Array]:
    """Return the log as columns of numbers and names."""
    columns: dict[str, Array] = {}
    for field in LOG.names or ():
        if field in NAMED:
            columns[field] = np.array(NAMED[field], dtype=object)[log[field]]
        elif field in SCALARS:
            columns[SCALARS[field]] = np.ascontiguousarray(log[field])
        else:
            for k, name in enumerate(VECTORS[field]):
                columns[name] = np.ascontiguousarray(log[field][:, k])
    return columns


# ----------------------------------------------------------------------------------------------------
# A run frame by frame, and tables of it, as files for other programs: CSV, Parquet, and for frames JSON.
#
# Every number has full precision. A file is written completely or not at all.


FRAME_FORMATS = (".csv", ".json", ".parquet")
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
    require_writable(path, FRAME_FORMATS)
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
    found = {
        "scene": run.scene.describe(),
        "rate": rate,
        "units": {
            "t": "s",
            "position": "m",
            "velocity": "m/s",
            "spin": "rad/s",
            "orientation": "w, x, y, z",
            "air": "m/s^2",
        },
        "balls": [
            {"name": name, "radius": one.radius, "mass": one.mass, "kappa": float(one.ball.kappa)}
            for name, one in balls
        ],
        "t": times.tolist(),
        "position": state.position.tolist(),
        "velocity": state.velocity.tolist(),
        "spin": state.spin.tolist(),
        "orientation": run.orientation(times).tolist(),
        "phase": run.phase(times).tolist(),
    }
    if run.scene.air is not None:
        found["air"] = air_acceleration(run.scene, state.velocity, state.spin).tolist()
    return found
