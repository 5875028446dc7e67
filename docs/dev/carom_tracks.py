"""Thirty filmed three-cushion shots, read from the reader's own copy of their source: no licence is stated, so carom has no copy.

    python docs/dev/carom_tracks.py 20170524_01_M_Ersin_Cemal.sapy carom_tracks_50hz.csv

The source is a file of the program Shot Analyzer (``.sapy``): a pickle of a dictionary whose list ``Shot`` has, of each shot, the
balls (``Ball`` or ``Route``), and of each ball the columns ``t``, ``x``, ``y``. A pickle can run code when it is loaded; this
one is read by an unpickler that makes numbers, texts, lists, dictionaries and NumPy arrays, and leaves everything else out.
"""

from __future__ import annotations

import csv
import pickle
import sys
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from carom.errors import CaromError
from carom.files import MOST_TABLE, as_path, atomic_path, open_regular

FILE = "20170524_01_M_Ersin_Cemal.sapy"
SOURCE = (
    f"GitHub repository erdo100/pooltool, branch test_scripts, BilliardData/{FILE}, shots 1 to 30; licence not stated."
)
SHOTS, ROWS = 30, 17187
SIDES = (2.84, 1.42)  # m, of the table
# m, along the long side and the short one: where the three balls of the first shot lie. They tell the file, its unit and its axes.
BEGIN = ((2.1354, 0.52725), (2.12688, 0.70688), (0.70688, 0.71014))
TOLERANCE = 2e-4  # m: less than a step of the positions
HEADER = ("shot", "ball", "t_s", "x_long_m", "y_short_m")
Columns = NDArray[np.float64]


def _latin1(text: str, _encoding: str) -> bytes:
    """Bytes, as old pickles write them."""
    return text.encode("latin1")


# What a pickle of arrays calls: the functions have other modules in other versions of NumPy, but the same names.
ARRAYS: dict[str, Any] = {
    "_reconstruct": np.zeros(1).__reduce__()[0],
    "_frombuffer": np.zeros(1).__reduce_ex__(5)[0],
    "scalar": np.float64(0).__reduce__()[0],
    "ndarray": np.ndarray,
    "dtype": np.dtype,
}


class WrittenTracks(NamedTuple):
    """The files that were written."""

    path: Path
    rows: int
    expected: int
    """Rows of the table that the validation pages use."""


class _LeftOut:
    """Stands for an object of any other class; nothing that a pickle does to it has an effect."""

    def __new__(cls, *_args: Any, **_options: Any) -> _LeftOut:
        return super().__new__(cls)

    def __init__(self, *_args: Any, **_options: Any) -> None:
        pass

    def __call__(self, *_args: Any, **_options: Any) -> _LeftOut:
        return self

    def _ignore(self, *_args: Any) -> None:
        pass

    __setstate__ = __setitem__ = append = extend = add = update = _ignore


class _NumbersOnly(pickle.Unpickler):
    """Makes NumPy arrays; any other class or function is left out."""

    def find_class(self, module: str, name: str) -> Any:
        """Return the object that a pickle calls by this name."""
        if (module, name) == ("_codecs", "encode"):
            return _latin1
        return ARRAYS.get(name, _LeftOut) if module.split(".", maxsplit=1)[0] == "numpy" else _LeftOut


def write_carom_tracks(source: str | Path, out: str | Path) -> WrittenTracks:
    """Write shots 1 to 30 of the source as CSV: shot, ball, t_s, x_long_m, y_short_m; no other shot is used.

    Rows that repeat the place before are dropped, but for a ball's last.

    Parameters
    ----------
    source : str or path
        Your own copy of the file (``SOURCE`` says where it was published).
    out : str or path
        The table to write.

    Returns
    -------
    WrittenTracks

    Raises
    ------
    CaromError
        For a file that cannot be read, of another layout, or with another first shot; nothing is written then.
    """
    path, target = as_path("write_carom_tracks", source), as_path("write_carom_tracks", out)
    shots = _shots(path)
    place = _placing(path, shots[0])
    rows = [
        (f"shot_{number:02d}", ball, f"{t:.4f}", f"{x:.5f}", f"{y:.5f}")
        for number, balls in enumerate(shots)
        for ball, columns in enumerate(balls, 1)
        for t, x, y in _moved(place(columns))
    ]
    with atomic_path(target, source=path) as part, part.open("w", encoding="utf-8", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(HEADER)
        writer.writerows(rows)
    return WrittenTracks(target, len(rows), ROWS)


def _shots(path: Path) -> list[list[Columns]]:
    """Return the first thirty shots, each as three arrays (N, 3): t, x, y in the file's axes and units."""
    try:
        with open_regular(path, most=MOST_TABLE) as file:
            found = _NumbersOnly(file).load()
    except CaromError:
        raise
    except Exception as error:  # (a damaged pickle raises anything)
        raise CaromError(f"{path}: expected a file of Shot Analyzer (a pickle), got: {error}") from None
    shots = found.get("Shot") if isinstance(found, dict) else None
    if not isinstance(shots, (list, dict)) or len(shots) < SHOTS:
        raise CaromError(f"{path}: expected a dictionary with a list 'Shot' of {SHOTS} shots or more; is it {FILE}?")
    return [_balls(path, number, shot) for number, shot in zip(range(SHOTS), _items(shots), strict=False)]


def _items(found: Any) -> Iterator[Any]:
    return iter(found.values() if isinstance(found, Mapping) else found)


def _balls(path: Path, number: int, shot: Any) -> list[Columns]:
    where = f"{path}: shot {number + 1}"
    balls = shot.get("Ball", shot.get("Route")) if isinstance(shot, dict) else None
    if not isinstance(balls, (list, dict)) or len(balls) != 3:
        raise CaromError(f"{where}: expected three balls under 'Ball' or 'Route'")
    try:
        found = [
            np.array([np.asarray(ball[name], float) for name in ("t", "x", "y")]).reshape(3, -1).T
            for ball in _items(balls)
        ]
    except (KeyError, TypeError, ValueError) as error:
        raise CaromError(f"{where}: expected columns t, x, y of numbers, of one length, got: {error}") from None
    if not all(len(ball) and np.isfinite(ball).all() for ball in found):
        raise CaromError(f"{where}: expected finite numbers, and one row or more per ball")
    return found


def _placing(path: Path, first: list[Columns]) -> Any:
    """Return the function that puts a ball's columns on the table as the first shot demands: metres, long side first."""
    begin = np.array(BEGIN)
    for unit in (1.0, 1e-3):
        for axes in ((1, 2), (2, 1)):
            for flips in ((False, False), (True, False), (False, True), (True, True)):

                def place(columns: Columns, unit: float = unit, axes: Any = axes, flips: Any = flips) -> Columns:
                    put = unit * columns[:, axes]
                    return np.column_stack([columns[:, 0], np.where(flips, SIDES - put, put)])

                if np.abs(np.array([place(ball)[0, 1:] for ball in first]) - begin).max() < TOLERANCE:
                    return place
    raise CaromError(
        f"{path}: expected the balls of the first shot at {', '.join(f'({x:g}, {y:g})' for x, y in BEGIN)} m at first,"
        f" got others; is it {FILE}?"
    )


def _moved(columns: Columns) -> Columns:
    """Drop rows that repeat the place before, but for the last."""
    keep = np.append(True, (np.diff(columns[:, 1:], axis=0) != 0).any(axis=1))
    keep[-1] = True
    return np.asarray(columns[keep])


if __name__ == "__main__":
    written = write_carom_tracks(*sys.argv[1:3])
    print(f"{written.rows} rows; the table behind the validation pages has {written.expected}. {SOURCE}")
