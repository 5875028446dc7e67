"""Write a run to a file: Parquet (the extra ``parquet``).

The file holds the log of events and the scene, from which :func:`carom.load_trajectory` makes the same
:class:`~carom.Trajectory`, bit for bit. Kinds of events and phases are written by name, so that a later version of carom may number
them otherwise.
"""

from __future__ import annotations

import hashlib
import json
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from carom.core.motion.phases import PHASES
from carom.errors import CaromError
from carom.files import atomic_path, import_optional, require_writable
from carom.scene.toml import stored_model
from carom.simulation.records import KINDS, LOG
from carom.simulation.run_record import RunRecord
from carom.simulation.tables import UNITS

__all__ = ["FORMAT", "FORMATS", "NAMED", "digest_of", "log_columns", "save", "version", "write_parquet"]

FORMAT = 1
FORMATS = (".parquet",)
NAMED = {"kind": KINDS, "met": KINDS, "phase_before": PHASES, "phase": PHASES}
AXES = ("x", "y", "z")
# The log's vectors, by what their columns are called.
VECTORS = {
    "x": "{}", "v_before": "v{}_before", "w_before": "w{}_before", "v": "v{}", "w": "w{}",
    "impulse": "impulse_{}", "floor_impulse": "floor_impulse_{}",
}  # fmt: skip
SCALARS = {"t": "t", "ball": "ball", "other": "other", "required": "required_friction", "regime": "regime"}

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
            for k, axis in enumerate(AXES):
                columns[VECTORS[field].format(axis)] = np.ascontiguousarray(log[field][:, k])
    return columns
