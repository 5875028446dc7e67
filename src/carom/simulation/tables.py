"""Tables of a run: events, or states at given times, as columns, as pandas DataFrames, or as an xarray Dataset.

All numbers are in SI units, named in ``table.attrs["units"]`` and, in a Dataset, in the ``units`` of each variable.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from carom.bodies import Numbers
from carom.core.motion.phases import PHASES
from carom.files import import_optional
from carom.laws.results import REGIME_NAMES as NAMES
from carom.simulation.contacts.kinds import PARTNERS
from carom.simulation.records import START, kind_names
from carom.simulation.run_record import EventSource, RunRecord

if TYPE_CHECKING:
    import pandas
    import xarray

__all__ = [
    "UNITS", "Columns", "event_columns", "events_table", "kinetic_energy", "many_events_table", "state_columns",
    "states_dataset", "states_table",
]  # fmt: skip

Columns = dict[str, NDArray[Any]]
AXES = ("x", "y", "z")
UNITS = {
    "t": "s", **dict.fromkeys(AXES, "m"),
    **{f"{of}{axis}{when}": unit for of, unit in (("v", "m/s"), ("w", "rad/s")) for axis in AXES for when in ("", "_before")},
    **{f"{of}_{axis}": "N s" for of in ("impulse", "floor_impulse") for axis in AXES},
    "energy_lost": "J", "energy": "J", **{f"q{part}": "1" for part in ("w", *AXES)},
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

    ``qw`` ... ``qz`` are the orientation, a unit quaternion from the body's frame; ``energy`` is the ball's own.
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
