"""Read a run from a file that :meth:`carom.Trajectory.save` wrote; all numbers have the same bits."""

from __future__ import annotations

import json
from contextlib import suppress
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from carom.core.contact import NO_REGIME
from carom.errors import CaromError, FaultList
from carom.files import as_path, import_optional, open_regular, require_unpacked_size
from carom.laws.landing import REGIME_NAMES
from carom.scene.scene import Scene
from carom.scene.schema import from_file
from carom.simulation.contact_kinds import PARTNERS
from carom.simulation.files import FORMAT, FORMATS, NAMED, SCALARS, VECTORS, digest_of, log_columns, version
from carom.simulation.loop import ENDS
from carom.simulation.records import LOG, START
from carom.simulation.trajectory import Trajectory

Array = NDArray[Any]


def load_trajectory(path: str | Path, *, allow_own_laws: bool = False) -> Trajectory:
    """Read a run from a file that :meth:`Trajectory.save` wrote; every number has the same bits.

    Parameters
    ----------
    path : str or Path
        A .parquet file (the extra ``parquet``).
    allow_own_laws : bool, optional
        Whether a custom law, a Python file that the stored scene names, is run. Default: it is refused, so that opening a file runs
        no code.

    Returns
    -------
    Trajectory. Raises CaromError, one line, for a file that is missing, damaged, of another kind, or of a newer format.

    Examples
    --------
    >>> import carom
    >>> carom.load_trajectory("run.csv")
    Traceback (most recent call last):
    carom.errors.CaromError: run.csv: expected a name that ends with .parquet, got '.csv'
    """
    path = as_path("load_trajectory", path)
    if path.suffix.lower() not in FORMATS:
        raise CaromError(f"{path}: expected a name that ends with {' or '.join(FORMATS)}, got {path.suffix!r}")
    open_regular(path, "a run that carom saved").close()
    try:
        about, fields = _from_parquet(path)
    except UnicodeDecodeError:
        raise _damaged(path, "one with invalid characters") from None
    log = np.zeros(len(fields["t"]), LOG)
    for field, values in fields.items():
        log[field] = _codes(path, field, values) if field in NAMED else values
    try:
        whole_as_saved = about["sha256"] == digest_of(log, about)
    except (KeyError, TypeError, ValueError):
        raise _damaged(path, "one with an unreadable description") from None
    if not whole_as_saved:
        raise _damaged(path, "one that was changed since it was saved")
    try:
        table = json.loads(about["scene"])
    except (TypeError, ValueError, RecursionError):
        raise _damaged(path, "one with an unreadable scene") from None
    scene = from_file(f"{path}: scene", Scene, table, allow_own_laws=allow_own_laws)
    _require_possible(path, scene, log, float(about["end"]), str(about["ended"]))
    return Trajectory(scene, log, float(about["end"]), str(about["ended"]))


def _require_possible(path: Path, scene: Scene, log: Array, end: float, ended: str) -> None:
    """Raise CaromError, a line a column, for numbers that no run has: a file that other code wrote, with the right checksum."""
    faults, count, t = FaultList(str(path)), len(scene.balls), log["t"]
    if not (0 <= end < np.inf and ended in ENDS):
        faults.add("end", f"a time in s, and one of {', '.join(ENDS)}", f"{end!r}, {ended!r:.40}")
    if len(log) < count:
        faults.add("ball", f"rows for all of {count} balls", f"{len(log)}")
    faults.raise_if_any()
    most, features = np.zeros(len(log), int), len(scene.features())
    for met, names in PARTNERS.items():
        most[log["met"] == met] = len(getattr(scene, names))
    number = np.arange(len(log))
    begins, of = number < count, log["ball"]
    rules = {
        "t": (np.isfinite(t) & (t >= 0) & (t <= end) & (np.diff(t, prepend=0) >= 0), f"times that rise from 0 to {end:.9g} s"),
        "ball": ((of >= 0) & (of < count) & (~begins | (of == number)), f"first 0 to {count - 1} in order, then one of them"),
        "kind": (begins == (log["kind"] == START), f"the start of each of {count} balls, and then events"),
        "other": ((log["other"] >= np.where(most, 0, -1)) & ((log["other"] < most) | (most == 0)), "a number of the scene"),
        "regime": ((log["regime"] >= NO_REGIME) & (log["regime"] < len(REGIME_NAMES)), f"{NO_REGIME} to {len(REGIME_NAMES) - 1}"),
        "borne_by": ((log["borne_by"] >= -1) & (log["borne_by"] <= features), f"-1 to {features}"),
        "required": (~(log["required"] < 0), "a number >= 0"),
        **{name: (np.isfinite(log[name]).all(axis=1), "finite numbers") for name in VECTORS},
    }  # fmt: skip
    for name, (good, expected) in rules.items():
        if not good.all():
            row = int(np.argmin(good))
            faults.add(f"{name}, row {row}", expected, f"{log[name][row].tolist()!r}")
    faults.raise_if_any()


def _damaged(path: Path, what: str) -> CaromError:
    return CaromError(f"{path}: expected an undamaged file that carom saved, got {what}; save the run again")


def _known_format(path: Path, about: dict[str, Any]) -> None:
    """CaromError for a file of a later carom. First of all: its columns may be others."""
    number = about.get("carom_format")
    if not isinstance(number, int):
        raise _damaged(path, "no number of its format")
    if number > FORMAT:
        raise CaromError(
            f"{path}: expected format {FORMAT}, which this carom ({version()}) reads, got format {number} of carom"
            f" {about.get('carom')}; use that one or a later one"
        )


def _from_parquet(path: Path) -> tuple[dict[str, Any], dict[str, Any]]:
    pa = import_optional("pyarrow", path.name)
    pq = import_optional("pyarrow.parquet", path.name)
    try:
        with pq.ParquetFile(path) as file:
            text = (file.schema_arrow.metadata or {}).get(b"carom")
            if text is None:
                raise CaromError(
                    f"{path}: expected a run that carom saved, got a Parquet file without one; Trajectory.save writes one"
                )
            about = json.loads(text)
            _known_format(path, about)
            require_unpacked_size(path, file.metadata.num_rows * LOG.itemsize)
            names = list(log_columns(np.zeros(0, LOG)))
            if missing := [name for name in names if name not in file.schema_arrow.names]:
                raise _damaged(path, f"none of the column{'s' if len(missing) > 1 else ''} {', '.join(missing)}")
            table = file.read(names)
    except (pa.ArrowException, OSError) as error:
        raise CaromError(f"{path}: expected an undamaged Parquet file, got: {str(error).splitlines()[0]}") from None
    except (ValueError, RecursionError, AttributeError) as error:  # (no JSON, too deep, too long a number, no table)
        if isinstance(error, CaromError | UnicodeDecodeError):
            raise
        raise _damaged(path, "one with an unreadable description") from None
    fields: dict[str, Any] = {}
    for field in LOG.names or ():
        if field in VECTORS:
            parts = [_numbers(path, table, name) for name in VECTORS[field]]
            fields[field] = np.stack(parts, axis=1)
        elif field in NAMED:
            fields[field] = table.column(field).to_pylist()
        else:
            fields[field] = _numbers(path, table, SCALARS[field], "if" if LOG[field].kind == "f" else "i")
    return about, fields


def _numbers(path: Path, table: Any, name: str, kinds: str = "if") -> Array:
    column = table.column(name)
    values: Array = column.to_numpy()
    if column.null_count or values.dtype.kind not in kinds:
        raise _damaged(path, f"a column {name!r} that is not all numbers")
    return values


def _codes(path: Path, field: str, names: list[Any]) -> list[int]:
    known = {name: code for code, name in enumerate(NAMED[field])}
    with suppress(KeyError, TypeError):
        return [known[name] for name in names]
    unknown = next(name for name in names if name not in known)
    raise _damaged(path, f"a {field} {unknown!r}")
