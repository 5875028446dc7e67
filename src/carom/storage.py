"""A run in a file, and back with the same bits: Parquet (the extra ``parquet``) or NetCDF (the extra ``xarray``).

The file holds the log and the scene, from which a :class:`~carom.trajectory.Trajectory` is made as after a run. Kinds of
events and phases are kept by name, so that a later carom may number them otherwise.
"""

from __future__ import annotations

import hashlib
import json
from contextlib import suppress
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray
from pydantic import ValidationError

from carom.engine.arrays import KINDS, LOG
from carom.errors import CaromError
from carom.files import library, path_of, require_place, whole
from carom.law import Law
from carom.motion.phases import PHASES
from carom.scene.faults import told
from carom.scene.model import Scene
from carom.tidy import UNITS
from carom.trajectory import Trajectory

__all__ = ["FORMAT", "KINDS_OF_FILE", "load_trajectory", "require_place", "save", "whole", "write_parquet"]

FORMAT = 1
KINDS_OF_FILE = (".parquet", ".nc")
NAMED = {"kind": KINDS, "met": KINDS, "phase_before": PHASES, "phase": PHASES}
AXES = ("x", "y", "z")
# The log's vectors, by what their columns are called.
VECTORS = {
    "x": "{}", "v_before": "v{}_before", "w_before": "w{}_before", "v": "v{}", "w": "w{}",
    "impulse": "impulse_{}", "floor_impulse": "floor_impulse_{}",
}  # fmt: skip
SCALARS = {"t": "t", "ball": "ball", "other": "other", "required": "required_friction", "regime": "regime"}
# Fields of the log: the unit of a vector or scalar.
UNIT_OF = {"t": "s", "x": "m", "v_before": "m/s", "v": "m/s", "w_before": "rad/s", "w": "rad/s"}
UNIT_OF |= {"impulse": "N s", "floor_impulse": "N s"}

Array = NDArray[Any]


# --- saving --------------------------------------------------------------------------------------------------------


def save(run: Trajectory, path: Path) -> Path:
    """Write a run to a .parquet or .nc file, whole or not at all.

    Raises CaromError for another ending, a place that cannot be written to, and a run with a law that has no file.
    """
    require_place(path, KINDS_OF_FILE)
    about = {
        "carom_format": FORMAT,
        "carom": _version(),
        "scene": _scene_text(run.scene),
        "end": run.end,
        "ended": run.ended,
    }
    about["sha256"] = _digest(run.log, about)
    with whole(path) as part:
        if path.suffix.lower() == ".nc":
            _to_netcdf(run.log, about, part)
        else:
            write_parquet(_columns(run.log), {"carom": json.dumps(about)}, part)
    return path


def _digest(log: Array, about: dict[str, Any]) -> str:
    """A checksum over all that the file holds: a file in which one bit has changed is no longer the run."""
    digest = hashlib.sha256(f"{about['scene']} {float(about['end'])!r} {about['ended']}".encode())
    for values in _columns(log).values():
        digest.update(" ".join(values).encode() if values.dtype == object else values.tobytes())
    return digest.hexdigest()


def _version() -> str:
    import carom

    return carom.__version__


def _scene_text(scene: Scene) -> str:
    """A scene as JSON (Infinity where a number is infinite): the words of a scene file."""
    for law in (scene.run.law, *scene.wall_laws):
        if isinstance(law, Law):
            raise CaromError(
                f"save: expected laws with a name or a file, got the carom.Law {law.name!r}, which a file cannot hold;"
                f" put it into a Python file and give it to the scene as 'file.py:name'"
            )
    return scene.model_dump_json()


def write_parquet(columns: dict[str, Array], metadata: dict[str, str], path: Path) -> None:
    """Columns as a Parquet file, each with its unit."""
    pa = library("pyarrow", "parquet", path.name)
    pq = library("pyarrow.parquet", "parquet", path.name)
    arrays = {name: pa.array(values) for name, values in columns.items()}
    fields = [
        pa.field(name, array.type, nullable=False, metadata={"unit": UNITS[name]} if name in UNITS else None)
        for name, array in arrays.items()
    ]
    pq.write_table(pa.Table.from_arrays(list(arrays.values()), schema=pa.schema(fields, metadata=metadata)), path)


def _columns(log: Array) -> dict[str, Array]:
    """The log as columns of numbers and names."""
    columns: dict[str, Array] = {}
    for field in LOG.names or ():
        if field in NAMED:
            columns[field] = np.array(NAMED[field], dtype=object)[log[field]]
        elif field in SCALARS:
            columns[SCALARS[field]] = np.ascontiguousarray(log[field])
        else:
            for k, axis in enumerate(AXES):
                columns[VECTORS[field].format(axis)] = np.ascontiguousarray(log[field][:, k])
    return columns


def _to_netcdf(log: Array, about: dict[str, Any], path: Path) -> None:
    xarray = library("xarray", "xarray", path.name)
    for name in ("h5netcdf", "h5py"):
        library(name, "xarray", path.name)
    variables = {}
    for field in LOG.names or ():
        note: dict[str, Any] = {"units": UNIT_OF[field]} if field in UNIT_OF else {}
        if field in NAMED:
            note = {"flag_values": np.arange(len(NAMED[field])), "flag_meanings": " ".join(NAMED[field])}
        dims = ("row", "axis") if field in VECTORS else ("row",)
        variables[field] = (dims, np.ascontiguousarray(log[field]), note, {"_FillValue": None})
    dataset = xarray.Dataset(variables, attrs=about)
    dataset.to_netcdf(path, engine="h5netcdf")


# --- loading -------------------------------------------------------------------------------------------------------


def load_trajectory(path: str | Path) -> Trajectory:
    """The run that :meth:`Trajectory.save` wrote, with the same bits of every number.

    Raises CaromError, one line, for a file that is missing, damaged, of another kind, or of a newer format.
    """
    path = path_of("load_trajectory", path)
    if path.suffix.lower() not in KINDS_OF_FILE:
        raise CaromError(f"{path}: expected a name that ends with {' or '.join(KINDS_OF_FILE)}, got {path.suffix!r}")
    try:
        with path.open("rb"):
            pass
    except OSError as error:
        raise CaromError(f"{path}: expected a run that carom saved, got: {error.strerror}") from None
    try:
        about, fields = _from_netcdf(path) if path.suffix.lower() == ".nc" else _from_parquet(path)
    except UnicodeDecodeError:
        raise _damaged(path, "one with letters that are none") from None
    log = np.zeros(len(fields["t"]), LOG)
    for field, values in fields.items():
        log[field] = _codes(path, field, values) if field in NAMED else values
    try:
        whole_as_saved = about["sha256"] == _digest(log, about)
    except (KeyError, TypeError, ValueError):
        raise _damaged(path, "one whose description cannot be read") from None
    if not whole_as_saved:
        raise _damaged(path, "one that was changed since")
    try:
        scene = Scene.model_validate(json.loads(about["scene"]))
    except ValidationError as error:
        raise CaromError(*told(f"{path}: scene", error, Scene)) from None
    return Trajectory(scene, log, float(about["end"]), str(about["ended"]))


def _damaged(path: Path, what: str) -> CaromError:
    return CaromError(f"{path}: expected a whole file that carom saved, got {what}; save the run again")


def _foreign(path: Path, kind: str) -> CaromError:
    return CaromError(f"{path}: expected a run that carom saved, got {kind} without one; Trajectory.save writes one")


def _known_format(path: Path, about: dict[str, Any]) -> None:
    """CaromError for a file of a later carom. First of all: its columns may be others."""
    number = about.get("carom_format")
    if not isinstance(number, int):
        raise _damaged(path, "no number of its format")
    if number > FORMAT:
        raise CaromError(
            f"{path}: expected format {FORMAT}, which this carom ({_version()}) reads, got format {number} of carom"
            f" {about.get('carom')}; use that one or a later one"
        )


def _from_parquet(path: Path) -> tuple[dict[str, Any], dict[str, Any]]:
    pa = library("pyarrow", "parquet", path.name)
    pq = library("pyarrow.parquet", "parquet", path.name)
    try:
        with pq.ParquetFile(path) as file:
            text = (file.schema_arrow.metadata or {}).get(b"carom")
            if text is None:
                raise _foreign(path, "a Parquet file")
            about = json.loads(text)
            _known_format(path, about)
            table = file.read()
    except (pa.ArrowException, OSError) as error:
        raise CaromError(f"{path}: expected a whole Parquet file, got: {str(error).splitlines()[0]}") from None
    except (json.JSONDecodeError, AttributeError):
        raise _damaged(path, "one whose description cannot be read") from None
    names = list(_columns(np.zeros(0, LOG)))
    if missing := [name for name in names if name not in table.column_names]:
        raise _damaged(path, f"none of the column{'s' if len(missing) > 1 else ''} {', '.join(missing)}")
    fields: dict[str, Any] = {}
    for field in LOG.names or ():
        if field in VECTORS:
            parts = [_numbers(path, table, VECTORS[field].format(axis)) for axis in AXES]
            fields[field] = np.stack(parts, axis=1)
        elif field in NAMED:
            fields[field] = table.column(field).to_pylist()
        else:
            fields[field] = _numbers(path, table, SCALARS[field])
    return about, fields


def _numbers(path: Path, table: Any, name: str) -> Array:
    column = table.column(name)
    values: Array = column.to_numpy()
    if column.null_count or values.dtype.kind not in "if":
        raise _damaged(path, f"a column {name!r} that is not all numbers")
    return values


def _from_netcdf(path: Path) -> tuple[dict[str, Any], dict[str, Any]]:
    h5py = library("h5py", "xarray", path.name)
    try:
        # as HDF5, which NetCDF is: nothing is decoded, neither times nor missing numbers
        with h5py.File(path) as file:
            about = {name: _plain(value) for name, value in file.attrs.items()}
            if "carom_format" not in about:
                raise _foreign(path, "a NetCDF file")
            _known_format(path, about)
            found = {name: (file[name][()], file[name].attrs.get("flag_meanings")) for name in file}
    except CaromError:
        raise
    except Exception as error:  # HDF5 tells of damage in many classes
        first = (str(error).splitlines() or [type(error).__name__])[0]
        raise CaromError(f"{path}: expected a whole NetCDF file, got: {first}") from None
    fields: dict[str, Any] = {}
    for field in LOG.names or ():
        if field not in found:
            raise _damaged(path, f"no variable {field!r}")
        values, meanings = found[field]
        if values.shape != (len(found["t"][0]), *LOG[field].shape) or values.dtype.kind not in "if":
            raise _damaged(path, f"a variable {field!r} of another shape")
        if field in NAMED:
            names = str(meanings).split()
            fields[field] = [names[i] if 0 <= i < len(names) else str(i) for i in values.tolist()]
        else:
            fields[field] = values
    return about, fields


def _plain(value: Any) -> Any:
    """An attribute as Python has it."""
    return np.ravel(value)[0].item() if isinstance(value, (np.ndarray, np.generic)) and np.size(value) == 1 else value


def _codes(path: Path, field: str, names: list[Any]) -> list[int]:
    known = {name: code for code, name in enumerate(NAMED[field])}
    with suppress(KeyError, TypeError):
        return [known[name] for name in names]
    unknown = next(name for name in names if name not in known)
    raise _damaged(path, f"a {field} {unknown!r}")
