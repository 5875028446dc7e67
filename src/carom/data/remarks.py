"""Notes on the speeds of measured rebounds that can be read but look wrong: mixed units, and restitutions above 1."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping, Sequence

import numpy as np
from numpy.typing import NDArray

from carom.errors import shortened_list

__all__ = ["BEYOND", "EMPTY_CELL", "WITHOUT_ERROR_BARS", "not_used", "speed_remarks", "which_rows"]

Array = NDArray[np.float64]
# A larger ratio of the speeds before and after a contact suggests mixed units.
MAX_SPEED_RATIO = 20.0
BEYOND = 3.0  # error bars by which a number has to exceed what is possible
# Columns of numbers that are known and passed on: labels, and what carom's own tables of contacts have beside the velocities
PASSED_ON = re.compile(
    r"use|shot|sheet|ball|film|drop|wall|cushion|camera|surface|racket|contact|bounce|striking|struck|plane|t|t_s|sigma_t|air_drag|sigma_air_drag"
    r"|(sigma_)?floor_friction|(sigma_)?rolling_resistance|(sigma_)?slip_[nt]_(in|out)|covariance_v_[nt]|(blind|cloth|rolling|drag|roll)_.*"
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
