"""Measured rebounds: one row a contact, velocity and spin before and after, with error bars.

Two kinds. A **planar** bounce, of a ball in flight say: ``v_n_in, v_t_in, spin_in, v_n_out, v_t_out, spin_out``, where
``spin`` is about the axis for which the slip at the contact is v_t - a spin. A ball on a **table**: ``v_n_in, v_t_in,
spin_z_in, v_n_out, v_t_out, spin_z_out, stage``, where stage says when the ball was measured after the contact:
``after_wall``, as it leaves the wall, or ``rolling``, once it rolls again; before the contact it rolls. v_n is positive
toward the wall before and away from it after. SI: m/s and rad/s. A spin that nobody measured is NaN, an empty cell in a
file. Every number may have an error bar, one standard deviation, in a column ``sigma_...``.

In a file the columns may be in any order and in other units (``v_n_in_mm_s``, ``spin_out [rpm]``).
"""

from __future__ import annotations

import csv
import io
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

from carom.checks import LARGEST, nearest
from carom.errors import CaromError
from carom.files import path_of
from carom.tables.output import whole_file
from carom.tables.text import CsvTable
from carom.tables.units import BRACKETS, UNITS, Words, written

if TYPE_CHECKING:
    import pandas as pd

__all__ = ["COLUMNS", "KINDS", "STAGES", "Kind", "Rebounds", "make_rebounds", "read_rebounds"]

Array = NDArray[np.float64]
Kind = Literal["planar", "table"]
KINDS: tuple[Kind, ...] = ("planar", "table")
STAGES = ("after_wall", "rolling")
COLUMNS: dict[Kind, tuple[str, ...]] = {
    "planar": ("v_n_in", "v_t_in", "spin_in", "v_n_out", "v_t_out", "spin_out"),
    "table": ("v_n_in", "v_t_in", "spin_z_in", "v_n_out", "v_t_out", "spin_z_out"),
}
_MEASURED = tuple(dict.fromkeys(COLUMNS["planar"] + COLUMNS["table"]))


def _aliases(name: str) -> tuple[str, ...]:
    """Other ways in which a column is called: vn_in, spin_y_in."""
    if name.startswith("v_"):
        return (name.replace("v_", "v", 1),)
    return () if name.startswith("spin_z") else (name.replace("spin", "spin_y", 1),)


_NAMES = {name: ("spin" if name.startswith("spin") else "speed", _aliases(name)) for name in _MEASURED}
WORDS = Words(_NAMES | {f"sigma_{name}": (kind, (f"u_{name}",)) for name, (kind, _) in _NAMES.items()})
# A contact gives no ball this many times its speed, and leaves it more than this share: beyond, units were mixed.
MIXED = 20.0


@dataclass(frozen=True, eq=False)
class Rebounds:
    """N rebounds of one kind. Make them with :func:`make_rebounds` or :func:`read_rebounds`, which check."""

    kind: Kind
    columns: dict[str, Array]
    """The kind's columns (:data:`COLUMNS`), all of them, (N,) each, SI; a spin that was not measured is NaN."""
    sigma: dict[str, Array] = field(default_factory=dict)
    """Standard deviations (N,) by the column's name, of those columns that have them; NaN only where the spin is."""
    stage: NDArray[np.str_] | None = None
    """(N,), of a table: ``after_wall`` or ``rolling``; None for planar."""
    extra: dict[str, NDArray[Any]] = field(default_factory=dict)
    """Columns that carom does not read, as they came: shot, ball, wall, spin_source..."""
    rows: tuple[str, ...] = ()
    """What people call a row: "line 7"."""
    source: str = ""
    notes: tuple[str, ...] = ()
    """What was assumed, and what looks odd: for people."""

    def __len__(self) -> int:
        """The number of rebounds."""
        return len(self.columns["v_n_in"])

    def __getitem__(self, name: str) -> Array:
        """A column by its name, ``sigma_...`` too; KeyError where there is none."""
        return self.sigma[name.removeprefix("sigma_")] if name.startswith("sigma_") else self.columns[name]

    @property
    def angle_in(self) -> Array:
        """Angle of incidence from the wall's normal (N,), rad; positive toward positive v_t."""
        return np.arctan2(self.columns["v_t_in"], self.columns["v_n_in"])

    @property
    def angle_out(self) -> Array:
        """Angle of reflection from the wall's normal (N,), rad."""
        return np.arctan2(self.columns["v_t_out"], self.columns["v_n_out"])

    def select(self, which: ArrayLike) -> Rebounds:
        """Those rows that a mask or indices name."""
        index = np.asarray(which)
        index = np.flatnonzero(index) if index.dtype == bool else index.astype(np.intp)
        return replace(
            self,
            columns={name: column[index] for name, column in self.columns.items()},
            sigma={name: column[index] for name, column in self.sigma.items()},
            stage=None if self.stage is None else self.stage[index],
            extra={name: column[index] for name, column in self.extra.items()},
            rows=tuple(self.rows[i] for i in index.tolist()) if self.rows else (),
        )

    def flat(self) -> dict[str, NDArray[Any]]:
        """All columns as a file has them, in order: extras, measured ones each with its sigma, stage."""
        found: dict[str, NDArray[Any]] = dict(self.extra)
        for name, column in self.columns.items():
            found[name] = column
            if name in self.sigma:
                found[f"sigma_{name}"] = self.sigma[name]
        if self.stage is not None:
            found["stage"] = self.stage
        return found

    def to_pandas(self) -> pd.DataFrame:
        """A DataFrame (the extra ``carom[pandas]``)."""
        import pandas as pd

        return pd.DataFrame(self.flat())

    def save(self, path: str | Path) -> Path:
        """Write a CSV file, or Parquet if the name ends with .parquet; whole or not at all. Numbers in full, SI."""
        path = path_of("Rebounds.save", path)
        columns = self.flat()
        with whole_file(path) as file:
            if path.suffix.lower() in (".parquet", ".pq"):
                _write_parquet(file, columns)
            else:
                text = io.StringIO(newline="")
                writer = csv.writer(text, lineterminator="\n")
                writer.writerow(columns)
                writer.writerows(zip(*(map(_cell, column.tolist()) for column in columns.values()), strict=True))
                file.write(text.getvalue().encode())
        return path


def _cell(value: Any) -> str:
    if isinstance(value, float):
        return "" if value != value else repr(value)  # noqa: PLR0124
    return str(value)


def _write_parquet(file: Any, columns: Mapping[str, NDArray[Any]]) -> None:
    try:
        import pyarrow as pa
        import pyarrow.parquet as pq
    except ImportError:
        raise CaromError("rebounds: expected pyarrow, to write Parquet, got none; pip install pyarrow") from None
    table = {name: pa.array(list(column) if column.dtype.kind == "O" else column, from_pandas=True)
             for name, column in columns.items()}  # fmt: skip
    pq.write_table(pa.table(table), file)


def make_rebounds(
    kind: Kind,
    columns: Mapping[str, ArrayLike],
    *,
    stage: str | Sequence[str] | NDArray[np.str_] | None = None,
    extra: Mapping[str, NDArray[Any]] | None = None,
    rows: Sequence[str] = (),
    source: str = "rebounds",
    notes: Sequence[str] = (),
) -> Rebounds:
    """Rebounds from columns by name, ``sigma_...`` among them, SI, each (N,) or one number for all rows.

    A spin that is left out is unknown; v_t_in and v_t_out left out together are 0. Raises CaromError with all faults: a
    missing or unknown column, cells that are not finite, v_n_in not above 0, a sigma that is not above 0, a stage that is
    unknown or left out.
    """
    if kind not in KINDS:
        raise CaromError(f"{source}: kind: expected planar or table, got {kind!r}")
    names = COLUMNS[kind]
    faults: list[str] = []
    known = [*names, *(f"sigma_{name}" for name in names)]
    given = {name: np.atleast_1d(np.asarray(column, dtype=float)) for name, column in columns.items()}
    faults += [
        f"{source}: column {name!r}: expected a column of a {kind} bounce; {nearest(name, known)}"
        for name in given
        if name not in known
    ]
    sizes = {len(column) for column in given.values() if len(column) != 1}
    count = sizes.pop() if sizes else 1
    if sizes:
        got = ", ".join(f"{name} {len(column)}" for name, column in given.items())
        raise CaromError(*faults, f"{source}: columns: expected one length for all, got {got}")
    given = {name: np.broadcast_to(column, count).copy() for name, column in given.items()}
    said = list(notes)
    if "v_t_in" not in given and "v_t_out" not in given:
        given |= {"v_t_in": np.zeros(count), "v_t_out": np.zeros(count)}
        said.append("no v_t_in and v_t_out: taken as 0, square on to the wall")
    faults += [
        f"{source}: column {name!r}: expected it for a {kind} bounce, got none"
        for name in names
        if name.startswith("v_") and name not in given
    ]
    label = list(rows) or [f"row {i + 1}" for i in range(count)]
    if count == 0:
        faults.append(f"{source}: expected rebounds, got none")
    faults += _bad_cells(given, label, source)
    stages = _stages(kind, stage, count, label, source, faults)
    if faults:
        raise CaromError(*faults)
    found = Rebounds(
        kind,
        {name: given.get(name, np.full(count, np.nan)) for name in names},
        {name: given[f"sigma_{name}"] for name in names if f"sigma_{name}" in given},
        stages, dict(extra or {}), tuple(label), source,
    )  # fmt: skip
    return replace(found, notes=(*said, *_remarks(found)))


def _where(bad: NDArray[np.bool_], rows: Sequence[str]) -> str:
    which = np.flatnonzero(bad)
    return f"at {rows[which[0]]}" + (f" ({len(which)} in all)" if len(which) > 1 else "")


def _bad_cells(given: Mapping[str, Array], rows: Sequence[str], source: str) -> list[str]:
    """What is wrong with the numbers, one line a column and kind of fault."""
    faults = []

    def check(name: str, bad: NDArray[np.bool_], expected: str, remedy: str) -> None:
        if bad.any():
            got = float(given[name][np.flatnonzero(bad)[0]])
            got_text = "an empty cell" if np.isnan(got) else repr(got)
            faults.append(f"{source}: {name}: expected {expected}, got {got_text} {_where(bad, rows)}; {remedy}")

    for name, column in given.items():
        far = ~(np.abs(column) <= LARGEST)
        if name.startswith("sigma_"):
            of = given.get(name.removeprefix("sigma_"))
            unknown = np.zeros(len(column), bool) if of is None else np.isnan(of) & np.isnan(column)
            check(name, (far | ~(column > 0)) & ~unknown, "an error bar above 0",
                  "an exact measurement does not exist: give its real error, or leave the column out")  # fmt: skip
        elif name.startswith("spin"):
            check(name, far & ~np.isnan(column), "a finite number", "leave the cell empty where it was not measured")
        else:
            check(name, far, "a finite number", "leave the row out, or fill in the cell")
    if "v_n_in" in given:
        v = given["v_n_in"]
        check("v_n_in", np.isfinite(v) & ~(v > 0), "a speed toward the wall, above 0",
              "v_n is positive toward the wall before the contact and away from it after: turn the signs")  # fmt: skip
    if "v_n_out" in given:
        v = given["v_n_out"]
        slack = 3 * np.nan_to_num(given.get("sigma_v_n_out", np.zeros(len(v))))
        check("v_n_out", np.isfinite(v) & (v < -slack), "a speed away from the wall, at least 0 within 3 sigma",
              "v_n is positive toward the wall before the contact and away from it after: turn the signs")  # fmt: skip
    return faults


def _stages(
    kind: Kind, stage: Any, count: int, rows: Sequence[str], source: str, faults: list[str]
) -> NDArray[np.str_] | None:
    if kind == "planar":
        if stage is not None:
            faults.append(f"{source}: stage: expected none of a planar bounce, got {stage!r:.40}; or is it a table?")
        return None
    if stage is None:
        faults.append(
            f"{source}: stage: expected after_wall (measured as the ball leaves the wall) or rolling (once it rolls"
            " again), got none; give the column, or --stage for all rows"
        )
        return None
    found: NDArray[np.str_] = np.char.strip(np.broadcast_to(np.atleast_1d(np.asarray(stage, dtype=str)), count))
    bad = ~np.isin(found, STAGES)
    if bad.any():
        got = str(found[np.flatnonzero(bad)[0]])
        faults.append(f"{source}: stage: expected after_wall or rolling, got {got!r} {_where(bad, rows)}")
    return found


def _remarks(found: Rebounds) -> list[str]:
    """What looks odd, though it can be read."""
    remarks = []
    v_in = np.hypot(found["v_n_in"], found["v_t_in"])
    v_out = np.hypot(found["v_n_out"], found["v_t_out"])
    spin_unknown = all(np.isnan(found[name]).all() for name in COLUMNS[found.kind] if name.startswith("spin"))
    odd = (v_out > MIXED * v_in) | (v_out * MIXED < v_in)
    if odd.any() and (spin_unknown or odd.mean() > 0.5):
        i = np.flatnonzero(odd)[0]
        remarks.append(
            f"speeds: {v_in[i]:.4g} m/s before and {v_out[i]:.4g} m/s after {_where(odd, found.rows)}: mixed units?"
            " write them in the headers, as in v_n_in_mm_s"
        )
    if not found.sigma:
        remarks.append("no sigma_ columns: the error bars are not known, and a fit has to estimate them")
    return remarks


# --- files -------------------------------------------------------------------------------------------------------------


def read_rebounds(path: str | Path, *, kind: Kind | None = None, stage: str | None = None) -> Rebounds:
    """A rebound table from a CSV or Parquet file.

    The kind shows in the columns (spin_in or spin_out: planar; spin_z_in, spin_z_out or stage: table); a table with neither
    needs ``kind``. ``stage`` is for all rows of a file without that column. Columns with other names are kept as ``extra``.
    Raises CaromError with all faults of the file.
    """
    path = path_of("read_rebounds", path)
    if not path.is_file():
        raise CaromError(f"{path}: expected a table of rebounds, got {'a folder' if path.is_dir() else 'no such file'}")
    faults: list[str] = []
    read = _read_parquet if path.suffix.lower() in (".parquet", ".pq") else _read_csv
    headers, cells, rows, number = read(path, faults)
    measured: dict[str, Array] = {}
    extra: dict[str, NDArray[Any]] = {}
    stages: Any = stage
    for i, header in enumerate(headers):
        name = header.strip().lower()
        meaning = WORDS.heading(header)
        if name == "stage":
            stages = np.array([str(cell) for cell in cells(i)]) if stage is None else stage
        elif meaning is None:
            if header.strip():
                extra[header.strip()] = np.array([_text(cell) for cell in cells(i)])
        elif meaning.unit is None:
            example = written(meaning.alias, next(iter(UNITS[meaning.dimension].values())), "suffix")
            faults.append(f"{path}: column {header!r}: expected a unit, one of {meaning.units}; as in {example!r}")
        elif meaning.quantity in measured:
            faults.append(f"{path}: column {header!r}: expected one column for {meaning.quantity}, got two")
        else:
            measured[meaning.quantity] = meaning.unit.to_si(number(i, header))
    kind = kind or _kind(path, measured, stages is not None, headers, faults)
    if faults:
        # the columns are checked too: all faults at once
        try:
            make_rebounds(kind, measured, stage=stages, rows=rows, source=str(path))
        except CaromError as error:
            already = {fault.split(": expected")[0] for fault in faults}
            faults += [fault for fault in error.faults if fault.split(": expected")[0] not in already]
        raise CaromError(*faults)
    if kind == "planar" and stage is None:
        stages = None
    return make_rebounds(kind, measured, stage=stages, extra=extra, rows=rows, source=str(path))


def _text(cell: Any) -> str:
    return "" if cell is None else str(cell)


def _kind(path: Path, measured: Mapping[str, Array], staged: bool, headers: list[str], faults: list[str]) -> Kind:
    bare = {name.removeprefix("sigma_") for name in measured}
    planar, table = bare & {"spin_in", "spin_out"}, bare & {"spin_z_in", "spin_z_out"}
    if planar and table:
        got = ", ".join(sorted(planar | table))
        faults.append(f"{path}: columns: expected spin (a planar bounce) or spin_z (a ball on a table), got {got}")
    elif not planar and not table and not staged:
        wanted = "v_n_in" if "v_n_in" in measured or not headers else nearest("v_n_in", headers)
        faults.append(
            f"{path}: columns: expected a spin_in or spin_out column (a planar bounce), or spin_z_in, spin_z_out or stage"
            f" (a ball on a table), got {', '.join(map(repr, headers))}; say which with --kind planar or --kind table"
            + ("" if wanted == "v_n_in" else f"; v_n_in: {wanted}")
        )
    return "table" if (table or staged) and not planar else "planar"


Reader = tuple[list[str], Callable[[int], list[Any]], list[str], Callable[[int, str], Array]]


def _read_csv(path: Path, faults: list[str]) -> Reader:
    with CsvTable(path) as table:
        headers = table.headers
        records = list(table.records())
        semicolons = table.delimiter != ","
    lines = [f"line {number}" for number, _text, _fields in records]
    width = len(headers)
    wrong = np.array([len(fields) > width or len(fields) < width for _n, _t, fields in records], bool)
    rows = [fields[:width] + [""] * (width - len(fields)) for _n, _t, fields in records]
    spare = [fields[width:] for _n, _t, fields in records]
    if wrong.any() and any(any(cell.strip() for cell in cells) for cells in spare):
        got = len(records[np.flatnonzero(wrong)[0]][2])
        faults.append(f"{path}: rows: expected {width} fields, as the header has, got {got} {_where(wrong, lines)}")

    def number(i: int, header: str) -> Array:
        texts = [row[i].strip() for row in rows]
        if semicolons:
            texts = [text.replace(",", ".") for text in texts]
        values, bad = np.full(len(texts), np.nan), np.zeros(len(texts), bool)
        for k, text in enumerate(texts):
            try:
                values[k] = float(text) if text else np.nan
            except ValueError:
                bad[k] = True
        if bad.any():
            unit = BRACKETS.match(header)
            faults.append(
                f"{path}: {header if unit else header.strip()}: expected a number, got"
                f" {texts[np.flatnonzero(bad)[0]]!r} {_where(bad, lines)}; units belong in the header"
            )
        return values

    return headers, lambda i: [row[i] for row in rows], lines, number


def _read_parquet(path: Path, faults: list[str]) -> Reader:
    from carom.tables.parquet import ParquetTable

    with ParquetTable(path) as table:
        arrow = table.file.read()
    lines = [f"row {i + 1}" for i in range(arrow.num_rows)]

    def number(i: int, header: str) -> Array:
        values = arrow.column(i).to_pylist()
        if all(value is None or isinstance(value, int | float) for value in values):
            return np.array([np.nan if value is None else float(value) for value in values])
        faults.append(f"{path}: column {header!r}: expected numbers, got {arrow.column(i).type}")
        return np.full(len(values), np.nan)

    return list(table.headers), lambda i: arrow.column(i).to_pylist(), lines, number
