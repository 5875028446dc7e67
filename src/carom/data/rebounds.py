"""Measured rebounds: one row per contact, velocity and spin before and after it, with error bars.

Two kinds. A **planar** bounce, of a ball in flight say: ``v_n_in, v_t_in, spin_in, v_n_out, v_t_out, spin_out``, where
``spin`` is about the axis for which the slip at the contact is v_t - a spin. A ball on a **table**: ``v_n_in, v_t_in,
spin_z_in, v_n_out, v_t_out, spin_z_out, stage``, where stage is when the ball was measured after the contact:
``after_wall``, as it leaves the wall, or ``rolling``, once it rolls again; before the contact it rolls. v_n is positive
toward the wall before and away from it after. SI: m/s and rad/s. What was not measured (a spin before the contact, anything after
it) is NaN: an empty cell, or no column. Every number may have an error bar, one standard deviation, in a column ``sigma_...``.

In a file the columns may be in any order and in other units (``v_n_in_mm_s``, ``spin_out [rpm]``).
"""

from __future__ import annotations

import csv
import io
import re
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

from carom.data.headers import ColumnNames
from carom.data.table_cells import parse_numbers
from carom.errors import (
    MAX_MAGNITUDE,
    MIN_MAGNITUDE,
    CaromError,
    FaultList,
    first_bad_index,
    float_array,
    shortened_list,
    suggestion,
)
from carom.files import as_path, atomic_file, import_optional

if TYPE_CHECKING:
    import pandas as pd

Array = NDArray[np.float64]
# A larger ratio of the speeds before and after a contact suggests mixed units.
MAX_SPEED_RATIO = 20.0
BEYOND = 3.0  # error bars by which a number has to exceed what is possible
# Columns of numbers that are known and passed on: labels, and what carom's own tables of contacts have beside the velocities
PASSED_ON = re.compile(
    r"use|shot|sheet|ball|film|drop|wall|cushion|camera|surface|racket|contact|bounce|striking|struck|plane|t|t_s|sigma_t|(sigma_)?drag_per_metre"
    r"|(sigma_)?floor_friction|(sigma_)?rolling_resistance|(sigma_)?slip_[nt]_(in|out)|covariance_v_[nt]|(sigma_)?(e_n|rebound_height)|(blind|cloth|rolling|drag|roll)_.*"
)
MOST_NAMED = 24  # columns in one note
EMPTY_CELL = "an empty cell"  # as messages name a number that is not there
WITHOUT_ERROR_BARS = 0.02  # relative excess that is reported where error bars are unknown


def not_used(headers: Iterable[str]) -> list[str]:
    """Return the note on columns of a table, of films or of rebounds, that were not used; none if there are none.

    Examples
    --------
    >>> not_used(["Area", "Mean"]), not_used([" "])
    (["not used: columns 'Area', 'Mean'"], [])
    """
    names = [repr(header.strip()) for header in headers if header.strip()]
    return [f"not used: column{'s' if len(names) > 1 else ''} {shortened_list(names, MOST_NAMED)}"] if names else []


def which_rows(bad: NDArray[np.bool_] | Sequence[int], rows: Sequence[str]) -> str:
    """Return which rows are bad, from a mask or indices: "at line 3 (2 in all)"."""
    which = np.flatnonzero(bad) if isinstance(bad, np.ndarray) else bad
    return f"at {rows[which[0]]}" + (f" ({len(which)} in all)" if len(which) > 1 else "")


def speed_remarks(
    columns: Mapping[str, Array], sigma: Mapping[str, Array], covariance: Array | None, rows: Sequence[str]
) -> list[str]:
    """Return notes on the speeds of rebounds: mixed units, a restitution above 1 beyond its error bar.

    Parameters
    ----------
    columns, sigma : mapping
        (N,) by name of the column, SI; of ``sigma`` only the known columns.
    covariance : (N,), optional
        Of the errors of v_n_in and v_n_out, m^2/s^2.
    rows : sequence of N str
    """
    remarks = []
    v_in, v_out = (np.hypot(columns[f"v_n_{side}"], columns[f"v_t_{side}"]) for side in ("in", "out"))
    spin_unknown = all(np.isnan(column).all() for name, column in columns.items() if name.startswith("spin"))
    odd = (v_out > MAX_SPEED_RATIO * v_in) | (v_out * MAX_SPEED_RATIO < v_in)
    if odd.any() and (spin_unknown or odd.mean() > 0.5):
        i = np.flatnonzero(odd)[0]
        remarks.append(
            f"speeds: {v_in[i]:.4g} m/s before and {v_out[i]:.4g} m/s after {which_rows(odd, rows)}: mixed units?"
            " write units in the headers, as in v_n_in_mm_s"
        )
    before, after = columns["v_n_in"], columns["v_n_out"]
    error = _difference_error(before, sigma, covariance)
    grows = after - before > BEYOND * error
    if grows.any():
        with np.errstate(over="ignore"):  # (a speed before the wall may be as small as a number can be)
            ratio = np.where(grows, after / before, -np.inf)
            i = int(np.argmax(ratio))
            said = f" ± {error[i] / before[i]:.2g}" if sigma else ""
        remarks.append(
            f"v_n_out: {grows.sum()} of {len(before)} rebounds have a restitution above 1 beyond the error bar, up to"
            f" {ratio[i]:.3g}{said} at {rows[i]}: no wall at rest gives back more than it gets; are columns swapped, or the scale,"
            " the frame rate or the view wrong?"
        )
    return remarks


def _difference_error(before: Array, sigma: Mapping[str, Array], covariance: Array | None) -> Array:
    """Return the error bar (N,) of v_n_out - v_n_in; where none is known, a third of what is reported."""
    variance = sum(
        (np.nan_to_num(sigma[name]) ** 2 for name in ("v_n_in", "v_n_out") if name in sigma),
        start=np.zeros(len(before)),
    )
    if covariance is not None:
        variance = np.maximum(variance - 2 * np.nan_to_num(covariance), 0.0)
    return np.where(variance > 0, np.sqrt(variance), WITHOUT_ERROR_BARS / BEYOND * before)


# ----------------------------------------------------------------------------------------------------
# Measured rebounds: one row per contact, velocity and spin before and after it, with error bars.


Kind = Literal["planar", "table"]
KINDS: tuple[Kind, ...] = ("planar", "table")
STAGES = ("after_wall", "rolling")
COLUMNS: dict[Kind, tuple[str, ...]] = {
    "planar": ("v_n_in", "v_t_in", "spin_in", "v_n_out", "v_t_out", "spin_out"),
    "table": ("v_n_in", "v_t_in", "spin_z_in", "v_n_out", "v_t_out", "spin_z_out"),
}
_MEASURED = tuple(dict.fromkeys(COLUMNS["planar"] + COLUMNS["table"]))


def _aliases(name: str) -> tuple[str, ...]:
    """Return other names of a column: vn_in, spin_y_in; v_n alone, as restitution is published against it."""
    if name == "v_n_in":
        return ("vn_in", "v_n", "normal_speed")
    if name.startswith("v_"):
        return (name.replace("v_", "v", 1),)
    return {"spin_z_in": ("spin_z",), "spin_z_out": ()}.get(name, (name.replace("spin", "spin_y", 1),))


_NAMES = {name: ("spin" if name.startswith("spin") else "speed", _aliases(name)) for name in _MEASURED}
NAMED = ColumnNames(_NAMES | {f"sigma_{name}": (kind, (f"u_{name}",)) for name, (kind, _) in _NAMES.items()})


@dataclass(frozen=True, eq=False)
class Rebounds:
    """N rebounds of one kind, made and checked by :func:`make_rebounds` or :func:`read_rebounds`.

    Examples
    --------
    >>> from carom.data import make_rebounds
    >>> table = make_rebounds("planar", {"v_n_in": [1.5, 2.0], "v_t_in": 0.5, "v_n_out": [1.2, 1.7], "v_t_out": 0.4})
    >>> len(table), table["v_n_out"], table.select([True, False])["v_n_in"]
    (2, array([1.2, 1.7]), array([1.5]))
    """

    kind: Kind
    columns: dict[str, Array]
    """The kind's columns (:data:`COLUMNS`), all of them, (N,) each, SI; what was not measured is NaN."""
    sigma: dict[str, Array] = field(default_factory=dict)
    """Standard deviations (N,) by name of the column, of those columns that have them; NaN only where the column is NaN."""
    stage: NDArray[np.str_] | None = None
    """(N,) ``after_wall`` or ``rolling`` for a table; None for planar."""
    extra: dict[str, NDArray[Any]] = field(default_factory=dict)
    """Other columns, unchanged: shot, ball, wall, spin_source..."""
    rows: tuple[str, ...] = ()
    """Label of each row, such as "line 7"."""
    source: str = ""
    notes: tuple[str, ...] = ()
    """Assumptions made, and values that look wrong."""

    def __len__(self) -> int:
        """The number of rebounds."""
        return len(self.columns["v_n_in"])

    def __getitem__(self, name: str) -> Array:
        """Return a column (N,) by its name, also ``sigma_...``. Raises KeyError for an unknown name."""
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
        """Return the rows of a mask (N,) or of indices."""
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
        """Return all columns in the order of a file: extras, measured columns each with its sigma, stage."""
        found: dict[str, NDArray[Any]] = dict(self.extra)
        for name, column in self.columns.items():
            found[name] = column
            if name in self.sigma:
                found[f"sigma_{name}"] = self.sigma[name]
        if self.stage is not None:
            found["stage"] = self.stage
        return found

    def to_pandas(self) -> pd.DataFrame:
        """Return a DataFrame (the extra ``carom[pandas]``)."""
        frame: pd.DataFrame = import_optional("pandas", "Rebounds.to_pandas").DataFrame(self.flat())
        return frame

    def save(self, path: str | Path) -> Path:
        """Write a CSV file, or Parquet if the name ends with .parquet, completely or not at all; SI, all digits."""
        path = as_path("Rebounds.save", path)
        columns = self.flat()
        with atomic_file(path) as file:
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
    pa, pq = (import_optional(name, "rebounds as Parquet") for name in ("pyarrow", "pyarrow.parquet"))
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
    """Make a table of rebounds from columns, and check it.

    Parameters
    ----------
    kind : "planar" or "table"
    columns : mapping
        Columns by name, ``sigma_...`` among them, SI, each (N,) or one number for all rows. What was not measured is left out
        or NaN: not v_n_in and v_t_in, nor all that follows. v_t_in and v_t_out may be left out together (0).
    stage : "after_wall", "rolling", or (N,) of these
        Required for a table.
    extra, rows, source, notes : optional
        Other columns, labels of rows, the name used in messages, and notes of the result.

    Returns
    -------
    Rebounds. Raises CaromError with all problems: a missing or unknown column, numbers that are not finite, v_n_in or a sigma
    not above 0, a missing or unknown stage.

    Examples
    --------
    >>> from carom.data import make_rebounds
    >>> table = make_rebounds("table", {"v_n_in": [1.0], "v_n_out": [0.85], "sigma_v_n_out": 0.01}, stage="rolling")
    >>> table.kind, table["sigma_v_n_out"], table.notes
    ('table', array([0.01]), ('no v_t_in and v_t_out: taken as 0, normal incidence',))
    """
    if kind not in KINDS:
        raise CaromError(f"{source}: kind: expected planar or table, got {kind!r}")
    names = COLUMNS[kind]
    faults = FaultList(source)
    known = [*names, *(f"sigma_{name}" for name in names)]
    given = {name: np.atleast_1d(np.asarray(column, dtype=float)) for name, column in columns.items()}
    for name in given:
        if name not in known:
            faults.add(f"column {name!r}", f"a column of a {kind} bounce", "", suggestion(name, known))
    sizes = {len(column) for column in given.values() if len(column) != 1}
    count = sizes.pop() if sizes else 1
    if sizes:
        got = ", ".join(f"{name} {len(column)}" for name, column in given.items())
        faults.add("columns", "one length for all", got)
        faults.raise_if_any()
    given = {name: np.broadcast_to(column, count).copy() for name, column in given.items()}
    said = list(notes)
    followed = any(np.isfinite(given[name]).any() for name in names[3:] if name in given)
    if "v_t_in" not in given and "v_t_out" not in given:
        given |= {"v_t_in": np.zeros(count), "v_t_out": np.zeros(count)}
        said.append("no v_t_in and v_t_out: taken as 0, normal incidence")
    columns_given = shortened_list([*given, *(extra or {})]) or "none"
    for name in names:
        if name in ("v_n_in", "v_t_in") and name not in given:
            faults.add(f"column {name!r}", f"this column for a {kind} bounce", columns_given)
    if not followed and count > 0:
        faults.add("columns", f"at least one of {', '.join(names[3:])} with a number", "none")
    label = list(rows) or [f"row {i + 1}" for i in range(count)]
    if count == 0:
        faults.add("", "rebounds", "none")
    _check_cells(given, label, faults)
    stages = _stages(kind, stage, count, label, faults)
    faults.raise_if_any()
    found = Rebounds(
        kind,
        {name: given.get(name, np.full(count, np.nan)) for name in names},
        {name: given[f"sigma_{name}"] for name in names if f"sigma_{name}" in given},
        stages, dict(extra or {}), tuple(label), source,
    )  # fmt: skip
    return replace(found, notes=(*said, *_remarks(found)))


def _check_cells(given: Mapping[str, Array], rows: Sequence[str], faults: FaultList) -> None:
    """Add the faults of the numbers, one for each column and kind of problem."""

    def check(name: str, bad: NDArray[np.bool_], expected: str, remedy: str) -> None:
        if bad.any():
            got = float(given[name][np.flatnonzero(bad)[0]])
            got_text = EMPTY_CELL if np.isnan(got) else repr(got)
            faults.add(name, expected, f"{got_text} {which_rows(bad, rows)}", remedy)

    for name, column in given.items():
        far = ~(np.abs(column) <= MAX_MAGNITUDE)
        if name.startswith("sigma_"):
            of = given.get(name.removeprefix("sigma_"))
            unknown = np.zeros(len(column), bool) if of is None else np.isnan(of) & np.isnan(column)
            check(name, (far | ~(column > 0)) & ~unknown, "an error bar above 0",
                  "no measurement is exact: give its real error, or leave the column out")  # fmt: skip
        elif name.startswith("spin") or name.endswith("_out"):
            check(name, far & ~np.isnan(column), "a finite number", "leave the cell empty where it was not measured")
        else:
            check(name, far, "a finite number", "leave the row out, or fill in the cell")
    if "v_n_in" in given:
        v = given["v_n_in"]
        check("v_n_in", np.isfinite(v) & ~(v >= MIN_MAGNITUDE), "a speed toward the wall, above 0",
              "v_n is positive toward the wall before the contact and away from it after: change the signs")  # fmt: skip
    if "v_n_out" in given:
        v = given["v_n_out"]
        slack = 3 * np.clip(np.nan_to_num(given.get("sigma_v_n_out", np.zeros(len(v)))), 0, MAX_MAGNITUDE)
        check("v_n_out", np.isfinite(v) & (v < -slack), "a speed away from the wall, at least 0 within 3 sigma",
              "v_n is positive toward the wall before the contact and away from it after: change the signs")  # fmt: skip


def _stages(kind: Kind, stage: Any, count: int, rows: Sequence[str], faults: FaultList) -> NDArray[np.str_] | None:
    if kind == "planar":
        if stage is not None:
            faults.add("stage", "none for a planar bounce", f"{stage!r:.40}", "leave it out, or use kind table")
        return None
    if stage is None:
        wanted = "after_wall (measured as the ball leaves the wall) or rolling (once it rolls again)"
        faults.add("stage", wanted, "none", "give the column, or `stage` for all rows")
        return None
    found: NDArray[np.str_] = np.char.strip(np.broadcast_to(np.atleast_1d(np.asarray(stage, dtype=str)), count))
    bad = ~np.isin(found, STAGES)
    if bad.any():
        got = str(found[np.flatnonzero(bad)[0]])
        faults.add("stage", "after_wall or rolling", f"{got!r} {which_rows(bad, rows)}")
    return found


def rows_of_stage(found: Rebounds, stage: str | None) -> Rebounds:
    """Return the rows of one stage, with a note where others are left out. Raises CaromError where there is none."""
    if stage is None or found.stage is None or (keep := found.stage == stage).all():
        return found
    if not keep.any():
        raise CaromError(
            f"{found.source}: stage: expected rows with stage {stage}, got {found.stage[0]} in all; omit `stage`"
        )
    note = f"stage: {keep.sum()} of {len(found)} rows are of stage {stage}; the others are left out"
    return replace(found.select(keep), notes=(*found.notes, note))


def _remarks(found: Rebounds) -> list[str]:
    """Return notes on what can be read but looks wrong."""
    covariance = found.extra.get("covariance_v_n")
    numbers = None if covariance is None else parse_numbers([str(cell) for cell in covariance.tolist()]).values
    remarks = speed_remarks(found.columns, found.sigma, numbers, found.rows)
    if not found.sigma:
        remarks.append("no sigma_ columns: the error bars are unknown, and a fit has to estimate them")
    return remarks


# ----------------------------------------------------------------------------------------------------
# A note on measured rebounds with more energy after the contact than before it.


MAX_SPIN = 3.0  # largest spin before a contact that is taken for possible where it was not measured, in units of speed / radius


def energy_remarks(rebounds: Rebounds, radius: float | None, kappa: float, roll: float = 1.0) -> list[str]:
    """Return a note on rebounds with more energy after the contact than before it, beyond the error bar.

    Where the spin before was not measured, the ball may have brought the energy along as spin, but no more than MAX_SPIN speeds per
    radius. A spin after that was not measured counts as none.

    Parameters
    ----------
    rebounds : Rebounds
    radius : float or None
        Of the ball, m; None: not known, so that spins that were measured do not tell energies.
    kappa : float
        I/(m a^2).
    roll : float
        Spin of a ball on a table before the contact, in units of a rolling ball's spin.
    """
    columns, sigma, n = rebounds.columns, rebounds.sigma, len(rebounds)
    if radius is None:
        columns = columns | {name: np.full(n, np.nan) for name in columns if name.startswith("spin")}
    rows = rebounds.rows or tuple(f"row {i + 1}" for i in range(n))
    # the spin about a horizontal axis of a ball that rolls goes with its velocity
    rolls = np.zeros((n, 2))
    if rebounds.kind == "table":
        rolls[:, 0], rolls[:, 1] = roll**2, rebounds.stage == "rolling"
    spin = next(name.removesuffix("_in") for name in columns if name.startswith("spin"))
    energy, error = np.zeros((2, len(rows))), np.zeros((2, len(rows)))
    # (numbers that are too large are refused elsewhere; the square of one that is hardly more than zero is zero)
    with np.errstate(over="ignore", divide="ignore", invalid="ignore"):
        for k, side in enumerate(("in", "out")):
            for name, factor in ((f"v_n_{side}", 1 + kappa * rolls[:, k]), (f"v_t_{side}", 1 + kappa * rolls[:, k]),
                                 (f"{spin}_{side}", kappa * (radius or 0.0) ** 2)):  # fmt: skip
                value = columns[name]
                energy[k] += np.where(np.isnan(value) & (name == f"{spin}_{side}"), 0.0, factor * value**2 / 2)
                error[k] += np.nan_to_num(factor * value * sigma.get(name, np.zeros(len(rows)))) ** 2
        speed2 = columns["v_n_in"] ** 2 + columns["v_t_in"] ** 2
        energy[0] += np.where(np.isnan(columns[f"{spin}_in"]), kappa * MAX_SPIN**2 * speed2 / 2, 0.0)
        bar = np.sqrt(error.sum(axis=0))
        bar = np.where(bar > 0, bar, 2 * WITHOUT_ERROR_BARS / BEYOND * energy[0])
        grows = energy[1] - energy[0] > BEYOND * bar
        if not grows.any():
            return []
        ratio = np.where(grows, energy[1] / energy[0], -np.inf)
    i = int(np.argmax(ratio))
    return [
        f"energy: {grows.sum()} of {len(rows)} rebounds have more energy after the contact than before, beyond the error bar, up"
        f" to {ratio[i]:.3g} times as much at {rows[i]}: no wall at rest gives energy; are the radius, and the spins' signs and"
        " units, right?"
    ]


# ----------------------------------------------------------------------------------------------------
# Measured collisions of two balls as rebounds of one: what a fit of restitution and friction between balls takes.


def rebounds_of_collisions(
    before: ArrayLike, after: ArrayLike, struck: ArrayLike, centres: ArrayLike, *, sigma_v: ArrayLike | None = None
) -> Rebounds:
    """Return collisions of a rolling ball with an equal one at rest as rebounds, whose laws a fit compares.

    By their relative velocity two balls meet as one meets a wall (:func:`carom.collide`), and a ball that rolls without sidespin
    meets one at rest as a rolling ball does. So `carom.fit(table, radius, laws=["contact", "maw"], spin="0")` gives restitution and
    friction between the balls, with error bars.

    Parameters
    ----------
    before, after : array (N, 2)
        Velocity of the striking ball along the table just before the collision and just after it, before the cloth has bent its
        path, m/s.
    struck : array (N, 2)
        Velocity of the ball that was at rest, just after the collision.
    centres : array (N, 2)
        From the centre of the striking ball to the centre of the other as they touch; any length.
    sigma_v : float or array (N,), optional
        One standard deviation of each component of these velocities, m/s.

    Returns
    -------
    Rebounds
        Of the kind "table", stage "after_wall". Raises CaromError for arrays of other shapes, a line of centres of zero length, or
        balls that do not approach.

    Examples
    --------
    >>> from carom.data import rebounds_of_collisions
    >>> table = rebounds_of_collisions([[1.0, 0.0]], [[0.26, 0.42]], [[0.74, -0.42]], [[0.866, -0.5]], sigma_v=0.01)
    >>> table["v_n_in"].round(3).tolist(), table["v_n_out"].round(3).tolist(), table["v_t_out"].round(3).tolist()
    ([0.866], [0.836], [0.487])
    """
    given = {"before": before, "after": after, "struck": struck, "centres": centres}
    arrays = {name: float_array(value) for name, value in given.items()}
    shape = (len(np.atleast_1d(arrays["before"])), 2)
    for name, array in arrays.items():
        if array.shape != shape:
            raise CaromError(f"rebounds_of_collisions: {name}: expected an array of shape {shape}, got {array.shape}")
    u, v, w, line = arrays.values()
    length = np.linalg.norm(line, axis=1)
    if (length == 0).any():
        bad = first_bad_index(length == 0)
        raise CaromError(f"rebounds_of_collisions: centres: expected a direction, got zero length{bad}")
    n = line / length[:, None]
    t = np.stack([-n[:, 1], n[:, 0]], axis=1)
    relative = v - w
    columns: dict[str, ArrayLike] = {
        "v_n_in": (u * n).sum(axis=1), "v_t_in": (u * t).sum(axis=1),
        "v_n_out": -(relative * n).sum(axis=1), "v_t_out": (relative * t).sum(axis=1),
    }  # fmt: skip
    if sigma_v is not None:
        sigma = np.broadcast_to(float_array(sigma_v), shape[:1])
        columns |= {f"sigma_{name}": sigma * (1 if name.endswith("in") else np.sqrt(2)) for name in list(columns)}
    return make_rebounds("table", columns, stage="after_wall", source="collisions")
