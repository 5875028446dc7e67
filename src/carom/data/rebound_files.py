"""Tables of rebounds read from files: names, units and error bars of columns, components from what people write.

A header is a name of :data:`carom.data.rebounds.NAMED` or of :mod:`carom.data.written_forms`, with a unit. An error bar is a column
``sigma_...`` (in the same units, or ``[%]`` of the value), stands in the cell (``7.83 ± 0.10``, ``7.83(10)``, ``7.83 ± 2 %``), or
in the header, for the whole column (``v_n_out [m/s] ± 0.10``, ``± 2 %``).
"""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from carom.data.headers import (
    BRACKETS,
    DIRECTION_COLUMN,
    DIRECTION_UNIT,
    Heading,
    missing_unit,
    series_headings,
    without_unit,
)
from carom.data.rebounds import (
    EMPTY_CELL,
    NAMED,
    PASSED_ON,
    Kind,
    Rebounds,
    make_rebounds,
    rows_of_stage,
    which_rows,
)
from carom.data.table_cells import (
    COMMENT,
    decimal_commas,
    header_error,
    number_advice,
    parse_numbers,
    relative_header,
    split_errors,
)
from carom.data.table_files import LEADING_LINES, PARQUET, CsvTable, ParquetTable
from carom.data.written_forms import SERIES, TARGETS, WRITTEN, components
from carom.errors import CaromError, FaultList, shortened_list, suggestion
from carom.files import MOST_TABLE, as_path, open_regular

Array = NDArray[np.float64]
Errors = tuple[Array, NDArray[np.bool_]]
"""Error bars (N,), NaN where there is none, and which are in per cent."""
Numbers = tuple[Array, Errors | None]
PERCENT = 100.0
TIMES = {"t", "time", "frame", "frames", "timestamp"}  # columns of a track
LEAST_SHARE = 0.05  # of the median size: error bars in per cent do not shrink below this where a value is nearly 0


def read_rebounds(
    path: str | Path, *, kind: Kind | None = None, stage: str | None = None, ball: tuple[float, float] | None = None
) -> Rebounds:
    """Read a table of rebounds from a CSV or Parquet file.

    Parameters
    ----------
    path : path
        Columns in any order, with units in their headers (SI without); other columns are kept as ``extra``.
    kind : "planar" or "table", optional
        By default recognised from the columns: spin_in or spin_out is planar, spin_z_in, spin_z_out or stage is a table.
    stage : "after_wall" or "rolling", optional
        Of all rows of a file without that column; of a file with it, the rows of that stage are read.

    ball : (radius, kappa), optional
        m and I/(m a^2): needed where spins are given as multiples of v/a, or ratios of the slip.

    Returns
    -------
    Rebounds. Raises CaromError with all problems of the file.

    Examples
    --------
    >>> import pathlib, tempfile
    >>> from carom.data import read_rebounds
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     path = pathlib.Path(folder) / "bounces.csv"
    ...     _ = path.write_text("v_n_in [mm/s],v_t_in,v_n_out,v_t_out,stage\\n1500,0.5,1.2,0.4,rolling\\n")
    ...     table = read_rebounds(path)
    >>> table.kind, table["v_n_in"], table.rows
    ('table', array([1.5]), ('line 2',))
    """
    path = as_path("read_rebounds", path)
    open_regular(path, "a table of rebounds", MOST_TABLE).close()
    faults = FaultList(str(path))
    read = _read_parquet if path.suffix.lower() in PARQUET else _read_csv
    headers, cells, rows, number = read(path, faults)
    if not rows:
        raise CaromError(f"{path}: expected rebounds, got none")
    return rebounds_of_columns(headers, cells, number, rows, kind, stage, faults, str(path), ball)


def heads_rebounds(text: str) -> bool:
    """Return whether a text begins with a header of a table of rebounds, below a title or comments: two columns that such a table
    has, one of them after the contact or a ratio, or times between bounces.

    >>> heads_rebounds("incidence_deg;e_n\\n30;0,8\\n"), heads_rebounds("t [s],x [cm],y [cm]\\n0,1,2\\n")
    (True, False)
    """
    return any(map(_heads_rebounds, text.splitlines()[:LEADING_LINES]))


def _heads_rebounds(line: str) -> bool:
    plain = [_plain(cell.strip().strip('"')) for cell in re.split(r"[;\t|,]", COMMENT.sub("", line, count=1))]
    if not TIMES.intersection(map(without_unit, plain)) and series_headings(plain, []):
        return True
    found = {meaning.quantity for cell in plain if (meaning := NAMED.parse(cell) or WRITTEN.parse(cell)) is not None}
    after = any(
        "out" in name or name.startswith(("e_", "beta", "reflection", "rebound", "time_after")) for name in found
    )
    peaks = "peak_height" in found and not TIMES.intersection(map(without_unit, plain)) and "x" not in plain
    return "flight_time" in found or peaks or (after and len(found) > 1)


def rebounds_of_columns(
    headers: Sequence[str], cells: Callable[[int], Sequence[Any]], number: Callable[[int, str], Numbers], rows: Sequence[str],
    kind: Kind | None, stage: str | None, faults: FaultList, source: str, ball: tuple[float, float] | None = None,
) -> Rebounds:  # fmt: skip
    """Return rebounds of the columns of a table, from their headers, and their cells as text and as numbers.

    ``ball``: radius and kappa, for spins that are given as multiples of v/a, and for ratios of slips. ``faults`` has those of
    the cells. Raises CaromError with all problems.
    """
    measured: dict[str, Array] = {}
    extra: dict[str, NDArray[Any]] = {}
    stages: Any = stage
    meanings = _meanings(headers, source, faults)
    notes = _with_unit_of_other_angle(headers, meanings)
    relative: dict[str, Array] = {}
    for i, header in enumerate(headers):
        meaning = meanings.get(i)
        if header.strip().lower() == "stage":
            stages = np.array([str(cell).strip() or stage or "" for cell in cells(i)], dtype=str)
        elif meaning is None:
            if header.strip():
                extra[header.strip()] = np.array(["" if cell is None else str(cell) for cell in cells(i)])
        elif meaning.unit is None:
            faults.append(missing_unit(source, header, meaning))
        elif meaning.quantity in measured or meaning.quantity in relative:
            faults.add(f"column {header!r}", f"one column for {meaning.quantity}", "two")
        else:
            values, errors = number(i, header)
            errors = _errors_of(header, errors, rows, faults)
            if meaning.quantity.startswith("sigma_") and relative_header(header):
                relative[meaning.quantity] = values
                continue
            value = meaning.unit.to_si(values / PERCENT if relative_header(header) else values)
            measured[meaning.quantity] = value
            if errors is not None:
                sigma = np.where(errors[1], _share_of(value, errors[0]), np.abs(meaning.unit.to_si(errors[0])))
                known = np.isfinite(sigma) & (sigma > 0)
                filled = np.where(known, sigma, np.median(sigma[known]) if known.any() else np.nan)
                measured[f"sigma_{meaning.quantity}"] = np.where(np.isnan(value), np.nan, filled)
    # (the components that a quantity without a unit would have given are missing as well)
    if any(one.unit is None and (_targets(one) or one.quantity.startswith("spin")) for one in meanings.values()):
        faults.raise_if_any()
    for name, share in relative.items():
        if (of := measured.get(name.removeprefix("sigma_"))) is not None:
            measured[name] = np.where(np.isnan(of), np.nan, _share_of(of, share))
    measured = (found := components(measured, ball, extra, faults)).columns
    if found.rows is not None:
        extra = {name: column[found.rows] for name, column in extra.items()}
        rows = [rows[i] for i in found.rows.tolist()]
    on_table = stages is not None or any(name.removeprefix("sigma_").startswith("spin_z") for name in measured)
    kind = kind or (
        "planar" if found.planar and not on_table else _kind_of_columns(measured, stages is not None, headers, faults)
    )
    extra = found.extra | extra | _directions(found.directions, kind, faults)
    if faults:
        # check the columns as well, to report all problems at once
        more = FaultList()
        more.attempt(make_rebounds, kind, measured, stage=stages, extra=extra, rows=rows, source=source)
        headed = {meaning.quantity: f"column {headers[i]!r}" for i, meaning in meanings.items()}
        faults += [
            one
            for one in more
            if not (faults.has(one.field) or faults.has(headed.get(one.field, one.field)))
            and not (one.got.startswith(EMPTY_CELL) and _unread_cells(headers, meanings, faults))
        ]
        faults.raise_if_any()
    stages = None if kind == "planar" and stage is None else stages
    made = make_rebounds(kind, measured, stage=stages, extra=extra, rows=rows, source=source)
    return rows_of_stage(replace(made, notes=(*notes, *found.notes, *_unread(extra), *made.notes)), stage)


def _unread_cells(headers: Sequence[str], meanings: Mapping[int, Heading], faults: FaultList) -> bool:
    """Return whether a cell that gives components is no number, so that these are empty."""
    return any(_targets(one) and faults.has(headers[i].strip()) for i, one in meanings.items())


def _unread(extra: Mapping[str, NDArray[Any]]) -> list[str]:
    """Return a note on columns of numbers that are not used."""
    found = []
    for header, cells in extra.items():
        numbers = parse_numbers([str(cell) for cell in cells], decimal_comma=True)
        if not PASSED_ON.fullmatch(header.lower()) and not numbers.bad and np.isfinite(numbers.values).any():
            found.append(header)
    names = "incidence_deg, reflection_deg, speed_in, e_n, e_t, and sigma_ before one of these for an error bar"
    said = f"not read: {shortened_list([repr(one) for one in found])}; names that are read are for example {names}"
    return [said] if found else []


def _directions(alone: NDArray[np.bool_] | None, kind: Kind, faults: FaultList) -> dict[str, NDArray[Any]]:
    """Return the column that marks rows of which only the direction after the contact is known; for balls in flight alone."""
    if alone is None:
        return {}
    if kind == "table":
        faults.add("columns", "a speed beside the angle after the wall, for a ball on a table", "the angle alone")
    return {DIRECTION_COLUMN: np.where(alone, DIRECTION_UNIT, "")}


def _errors_of(header: str, errors: Errors | None, rows: Sequence[str], faults: FaultList) -> Errors | None:
    """Return the error bars of cells, else the error bar of the header; none, with a fault, where one is infinite."""
    if errors is None and (shared := header_error(header)) is not None:
        errors = np.full(len(rows), shared[0]), np.full(len(rows), shared[1])
    if errors is None or not (endless := np.isinf(errors[0])).any():
        return errors
    faults.add(header.strip(), "an error bar that is a finite number", f"inf {which_rows(endless, rows)}")
    return None


def _share_of(value: Array, percent: Array) -> Array:
    """Return error bars in per cent of values, which do not vanish where a value nearly does."""
    size = np.abs(value)
    return np.asarray(percent / PERCENT * np.maximum(size, LEAST_SHARE * np.nanmedian(size)))


def _meanings(headers: Sequence[str], source: str, faults: FaultList) -> dict[int, Heading]:
    """Return the meaning of each column that is read. A column of another form is read only for what has no column of its own."""
    plain = [_plain(header) for header in headers]
    found = {i: meaning for i, header in enumerate(plain) if (meaning := NAMED.parse(header)) is not None}
    if any(
        meaning.quantity.startswith("spin_z") for meaning in found.values()
    ):  # (of all three a ball on a table has one)
        found = {i: meaning for i, meaning in found.items() if not meaning.alias.startswith("spin_y")}
    own = {meaning.quantity for meaning in found.values()}
    in_series = series_headings(plain, faults)
    for i, header in enumerate(plain):
        meaning = in_series.get(i) or WRITTEN.parse(header)
        if i not in found and meaning is not None and not own.intersection(_targets(meaning)):
            found[i] = meaning
    if len({one.quantity.removeprefix("sigma_") for one in found.values()}) > 1:
        # (heights in a row are a table of their own; beside anything else a height is another one)
        found = {i: one for i, one in found.items() if one.quantity.removeprefix("sigma_") != "peak_height"}
    if in_series or {"rebound_height", "time_after"}.intersection(one.quantity for one in found.values()):
        # (a ratio beside the heights of which it was made)
        found = {i: one for i, one in found.items() if one.quantity.removeprefix("sigma_") != "e_n"}
    return found


def _with_unit_of_other_angle(headers: Sequence[str], meanings: dict[int, Heading]) -> list[str]:
    """Put the unit of the angles in one unit to those without one, and return a note on it."""
    angles = {i: one for i, one in meanings.items() if one.dimension == "angle"}
    units = {one.unit for one in angles.values() if one.unit is not None}
    bare = [i for i, one in angles.items() if one.unit is None and one.style == "plain"]
    if not bare or len(units) != 1:
        return []
    (unit,) = units
    meanings |= {i: replace(meanings[i], unit=unit) for i in bare}
    return [f"{', '.join(headers[i].strip() for i in bare)}: no unit, taken in {unit.name} as the other angle"]


def _targets(meaning: Heading) -> tuple[str, ...]:
    """Return the components that a quantity gives; none for one that is a component."""
    quantity = meaning.quantity.removeprefix("sigma_")
    series = SERIES.get(quantity.rpartition(" ")[0], (quantity,))
    return tuple(to for one in series for to in TARGETS.get(one, ()))


def _plain(header: str) -> str:
    """Return a header without an error bar, and without the per cent of a relative one."""
    error = header_error(header)
    return relative_header(header) or (header if error is None else error[2])


def _kind_of_columns(measured: Mapping[str, Array], staged: bool, headers: Sequence[str], faults: FaultList) -> Kind:
    """Return the kind of bounces that the names of columns say; a table by default, with a fault if they do not say it."""
    bare = {name.removeprefix("sigma_") for name in measured}
    planar, table = bare & {"spin_in", "spin_out"}, bare & {"spin_z_in", "spin_z_out"}
    if planar and table:
        got = ", ".join(sorted(planar | table))
        faults.add("columns", "spin (a planar bounce) or spin_z (a ball on a table)", got)
    elif not planar and not table and not staged:
        wanted = "v_n_in" if "v_n_in" in measured or not headers else suggestion("v_n_in", headers)
        faults.add(
            "columns",
            "a spin_in or spin_out column (a planar bounce), or spin_z_in, spin_z_out or stage (a ball on a table)",
            ", ".join(map(repr, headers)),
            "say which with `kind` planar or table" + ("" if wanted == "v_n_in" else f"; v_n_in: {wanted}"),
        )
    return "table" if (table or staged) and not planar else "planar"


Reader = tuple[list[str], Callable[[int], list[Any]], list[str], Callable[[int, str], Numbers]]


def _read_csv(path: Path, faults: FaultList) -> Reader:
    with CsvTable(path, (NAMED, WRITTEN)) as table:
        headers = table.headers
        records = list(table.records())
        semicolons = table.delimiter != ","
    lines = [f"line {number}" for number, _text, _fields in records]
    width = len(headers)
    wrong = np.array([len(fields) != width for _n, _t, fields in records], bool)
    rows = [fields[:width] + [""] * (width - len(fields)) for _n, _t, fields in records]
    spare = [fields[width:] for _n, _t, fields in records]
    if wrong.any() and any(any(cell.strip() for cell in cells) for cells in spare):
        got = len(records[np.flatnonzero(wrong)[0]][2])
        comma = "a comma within a number: write a decimal point there, and no comma before thousands"
        advice = "" if semicolons or got < width else comma
        faults.add("rows", f"{width} fields, as the header has", f"{got} {which_rows(wrong, lines)}", advice)

    commas = semicolons or decimal_commas([cell for row in rows for cell in row])

    def number(i: int, header: str) -> Numbers:
        cells = [row[i] for row in rows]
        cells, errors = split_errors(cells, decimal_comma=commas)
        values, bad = parse_numbers(cells, decimal_comma=commas)
        if bad:
            unit, got = BRACKETS.match(header), cells[bad[0]].strip()
            field = header if unit else header.strip()
            faults.add(field, "a number", f"{got!r} {which_rows(bad, lines)}", number_advice(got))
        return values, errors

    return headers, lambda i: [row[i] for row in rows], lines, number


def _read_parquet(path: Path, faults: FaultList) -> Reader:
    with ParquetTable(path) as table:
        arrow = table.whole()
    return reader_of_columns(table.headers, [column.to_numpy() for column in arrow.columns], faults)


def reader_of_columns(headers: list[str], columns: Sequence[NDArray[Any]], faults: FaultList) -> Reader:
    """Return headers, cells, labels of rows and numbers of columns (N,)."""

    def number(i: int, header: str) -> Numbers:
        try:
            return np.asarray(columns[i], dtype=float), None
        except (TypeError, ValueError):
            faults.add(f"column {header!r}", "numbers", f"{columns[i].tolist()[0]!r:.40}")
        return np.full(len(columns[i]), np.nan), None

    rows = [f"row {i + 1}" for i in range(len(columns[0]) if columns else 0)]
    return headers, lambda i: columns[i].tolist(), rows, number
