"""Trajectories of balls from a table, cut into pieces of constant acceleration: what :mod:`carom.tracks.judgement` looks at.

Between two pieces third differences of the positions show an event. A parabola is fitted to each piece, with the errors of its
numbers.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from carom.data.columns import Columns, as_columns, is_columns, read_columns
from carom.data.remarks import not_used
from carom.errors import CaromError, Fault, FaultList
from carom.files import MOST_TABLE, as_path, parse_json, read_regular
from carom.formatting import counted
from carom.tracks.frame_clock import times_behind_rounding

__all__ = ["EXACT", "FEW", "BallPath", "PathPiece", "read_paths"]

Array = NDArray[np.float64]
FEW = 4  # frames: three numbers of a parabola, and one to spare
UNEVEN = 10.0  # times the noise, squared: more is no noise
EXACT = 1e-12  # m: with less noise the numbers are a program's
POOL_BALL = 0.028575  # m
LARGEST = 1e30  # in SI units: no squares of squares overflow
LABELS = ("name", "ball")
# What carom's own files have besides
OF_FRAMES = ("vx", "vy", "vz", "qw", "qx", "qy", "qz", "energy", "phase", "species", "shot", "frame")
NUMBERS = ("t", "x", "y", "z", "wx", "wy", "wz", "radius", "mass")


@dataclass(frozen=True)
class PathPiece:
    """Frames of one ball with one acceleration: its parabola about the middle, with the covariance of a coordinate's numbers."""

    first: int
    last: int
    middle: float
    numbers: Array  # (3, 3): place, velocity, half the acceleration; by coordinate
    covariance: Array  # (3, 3)
    spins: Array | None  # (2, 3): spin, and its rate of change
    spin_error: float = 0.0  # of a component at the ends, at most

    def place(self, t: float) -> tuple[Array, float]:
        """Return the place (3,) at a time, and the standard error of a coordinate."""
        tau = t - self.middle
        g = np.array([1.0, tau, tau * tau])
        return g @ self.numbers, math.sqrt(g @ self.covariance @ g)

    def velocity(self, t: float) -> tuple[Array, float]:
        """Return the velocity (3,) at a time, and the standard error of a component."""
        tau = t - self.middle
        g = np.array([0.0, 1.0, 2 * tau])
        return g @ self.numbers, math.sqrt(g @ self.covariance @ g)

    def spin(self, t: float) -> Array:
        """Return the spin (3,) at a time."""
        assert self.spins is not None
        return np.array([1.0, t - self.middle]) @ self.spins

    @property
    def acceleration(self) -> tuple[Array, float]:
        """Return the acceleration (3,), and the standard error of a component."""
        return 2 * self.numbers[2], 2 * math.sqrt(self.covariance[2, 2])


@dataclass(frozen=True)
class BallPath:
    """A ball with its frames: times (n,), s, and places (n, 3), m; and its pieces."""

    name: str
    t: Array
    x: Array
    radius: float
    mass: float
    pieces: tuple[PathPiece, ...]

    @property
    def fastest(self) -> float:
        """The largest speed in the middle of a piece, m/s."""
        return max((float(np.linalg.norm(piece.numbers[1])) for piece in self.pieces), default=0.0)


class BallRows(NamedTuple):
    """A ball with its rows, sorted by time; its spins (n, 3) if they are known, radius and mass."""

    name: str
    t: Array
    x: Array
    w: Array | None
    radius: float
    mass: float


def read_paths(
    table: Any, radius: float | None, mass: float, noise: float | None
) -> tuple[list[BallPath], float, list[str]]:
    """Return the balls of a table with their pieces, the noise of a coordinate (m), and what was assumed."""
    rows, sigma, notes = read_rows(table, radius, mass, noise)
    return [BallPath(name, t, x, a, m, tuple(_pieces(t, x, w, sigma))) for name, t, x, w, a, m in rows], sigma, notes


def read_rows(
    table: Any, radius: float | None, mass: float, noise: float | None
) -> tuple[list[BallRows], float, list[str]]:
    """Return the rows of each ball of a table, on the camera's clock, the noise of a coordinate (m), and what was assumed."""
    where, notes = "judge", list[str]()
    if is_columns(table):
        columns = as_columns(table, where)
    else:
        where = str(path := as_path("judge", table))
        columns = _columns(path, notes)
    faults = FaultList(where)
    if not {"t", "x", "y"} <= set(columns):
        got = ", ".join(columns)
        faults.add(
            "", "columns t, x and y, in s and m, a row per ball and frame", f"{got:.60}{'...' if got[60:] else ''}"
        )
    faults.raise_if_any()
    numbers = {name: _numbers(faults, name, columns[name]) for name in NUMBERS if name in columns}
    faults.raise_if_any()
    notes += not_used(name for name in columns if name not in (*NUMBERS, *LABELS, *OF_FRAMES))
    known = _known_rows(faults, numbers, notes)
    if "z" not in numbers:
        notes.append("no column z: all balls lie on the floor")
    if not {"wx", "wy", "wz"} <= set(numbers):
        notes.append("no columns wx, wy, wz: spins are unknown; a contact may add as much energy as rolling has")
    rows = _rows_of_balls(where, columns, numbers, known, radius, mass, notes)
    if not any(len(one.t) > FEW for one in rows):
        raise CaromError(f"{where}: expected more than {FEW} frames of a ball, got fewer")
    # (rows share a time in some frames only where times are rounded)
    several = [one.name for one in rows if len(one.t) > FEW and np.unique(one.t, return_counts=True)[1].min() > 1]
    clock = [one.t for one in rows] if several else times_behind_rounding([one.t for one in rows], notes)
    several += [one.name for one, t in zip(rows, clock, strict=True) if len(t) > FEW and np.any(np.diff(t) <= 0)]
    if several:
        raise CaromError(
            f"{where}: {several[0]}: expected one row per frame, got two of the same time; give each ball a name"
        )
    rows = [one._replace(t=t) for one, t in zip(rows, clock, strict=True)]
    sigma = _noise(rows) if noise is None else float(noise)
    return rows, max(sigma, 4e-16 * max(float(np.abs(one.x).max(initial=0.0)) for one in rows)), notes


def _rows_of_balls(
    where: str, columns: Columns, numbers: dict[str, Array], known: NDArray[np.bool_], radius: float | None, mass: float,
    notes: list[str],
) -> list[BallRows]:  # fmt: skip
    """Return the rows of each ball; a note says where a radius was assumed. Raises for balls whose radius is not known."""
    count, label = len(known), next((name for name in LABELS if name in columns), None)
    names = np.full(count, "ball")
    if label:  # (numbers are read as such: ball 1, not 1.0)
        names = np.array([f"{one:g}" if isinstance(one, float) else str(one) for one in columns[label]])
    spins = np.stack([numbers[f"w{axis}"] for axis in "xyz"], axis=-1) if {"wx", "wy", "wz"} <= set(numbers) else None
    if radius is None and "radius" not in numbers:
        assumed = "its least height" if "z" in numbers else f"{POOL_BALL:g} m, a pool ball's"
        notes.append(f"no radius: each ball's is assumed to be {assumed}")
    used, inverse = np.unique(names[known], return_inverse=True)
    order = np.lexsort((numbers["t"][known], inverse))
    by_name = np.split(np.flatnonzero(known)[order], np.cumsum(np.bincount(inverse))[:-1]) if len(used) else []
    faults, rows = FaultList(where), list[BallRows]()
    for own in sorted(by_name, key=lambda one: int(one.min())):
        name = str(names[own[0]])
        least = float(numbers["z"][own].min()) if "z" in numbers else POOL_BALL
        a = float(numbers["radius"][own][0]) if "radius" in numbers else least if radius is None else radius
        if not a > 0:
            got = f"none, and a least height of {a:g} m"
            faults.add(name, "the radius of the ball", got, "give it, or heights of the ball's centre")
        m = float(numbers["mass"][own][0]) if "mass" in numbers else mass
        z = numbers["z"][own] if "z" in numbers else np.full(len(own), a)
        x = np.stack([numbers["x"][own], numbers["y"][own], z], axis=-1)
        rows.append(BallRows(name, numbers["t"][own], x, None if spins is None else spins[own], a, m))
    faults.raise_if_any()
    return rows


def _columns(path: Path, notes: list[str]) -> Columns:
    """Return the columns of a file; of JSON, frames as ``save_frames`` writes them, with arrays (frame, ball, axis).

    Any other file of tracks is read as tracks, with its units.
    """
    if path.suffix.lower() != ".json":
        columns = {} if path.suffix.lower() == ".msgpack" else read_columns(path)[0]
        return columns if {"t", "x", "y"} <= set(columns) else _of_tracks(path, columns, notes)
    wanted = "a table (.csv, .parquet), or JSON with t, balls and position as frames are saved"
    expected, given = f"{path}: expected {wanted}", parse_json(path, read_regular(path, most=MOST_TABLE), wanted)
    try:
        count, balls = len(given["t"]), given["balls"]
        found: Columns = {"t": np.repeat(np.array(given["t"], dtype=float), len(balls))}
        for key, axes in (("position", "x y z"), ("spin", "wx wy wz")):
            if key == "position" or key in given:
                flat = np.array(given[key], dtype=float).reshape(count * len(balls), 3)
                found |= dict(zip(axes.split(), flat.T, strict=True))
        found |= {key: np.tile([ball[key] for ball in balls], count) for key in ("name", "radius", "mass")}
    except KeyError as error:
        raise CaromError(f"{expected}, got JSON without {error.args[0]!r}") from None
    except (ValueError, TypeError):
        raise CaromError(f"{expected}, got JSON of another form") from None
    return found


def _of_tracks(path: Path, columns: Columns, notes: list[str]) -> Columns:
    """Return the columns of a file that a tracking program wrote, with headers that have units, too."""
    from carom.tracks.read import read_tracks

    try:
        file = read_tracks(path)
    except CaromError:
        if {"t", "x"} <= set(columns) or not columns:
            raise
        got = ", ".join(columns)
        expected = (
            "columns t, x and y, in s and m, a row per ball and frame, or tracks of a program that carom tracks reads"
        )
        raise CaromError(Fault(f"{path}", "", expected, f"{got:.60}{'...' if got[60:] else ''}")) from None
    notes += [
        note for note in file.notes if "assumed" in note or note.startswith(("not used", "column ", "times "))
    ]  # (others are on rebounds)
    plane = all(track.position.shape[1] == 2 for track in file.tracks)
    side = plane and any("height" in name.lower() or name.lower()[:1] == "z" for name in columns)
    names = ("x", "z") if side else ("x", "y", "z")
    found: dict[str, list[Any]] = {name: [] for name in ("t", "x", "y", "z", "ball")}
    for track in file.tracks:
        where = dict(zip(names, track.position.T, strict=False))
        found["t"].append(track.time)
        found["ball"].append(np.full(len(track.time), track.name))
        for name in ("x", "y", "z"):
            found[name].append(where.get(name, np.zeros(len(track.time))))
    flat = plane and not side
    return {name: np.concatenate(values) for name, values in found.items() if not (flat and name == "z")}


def _known_rows(faults: FaultList, numbers: dict[str, Array], notes: list[str]) -> NDArray[np.bool_]:
    """Return which rows have a time and a place; a note says how many have not. Raises for radii and masses that are none."""
    known = np.ones(len(numbers["t"]), dtype=bool)
    for name in {"t", "x", "y", "z"} & set(numbers):
        known &= np.isfinite(numbers[name])
    for name in ("radius", "mass"):
        wrong = numbers[name][known & ~(numbers[name] > 0)] if name in numbers else np.array([])
        if len(wrong):
            faults.add(name, "numbers > 0", f"{wrong[0]:g}")
    faults.raise_if_any()
    if not known.all():
        notes.append(f"{counted(int((~known).sum()), 'row')} without a time and a place in finite numbers left out")
    return known


def _numbers(faults: FaultList, name: str, column: NDArray[Any]) -> Array:
    numbers = np.full(len(column), math.nan)
    for k, value in enumerate(column if column.dtype.kind not in "fiu" else ()):
        try:
            numbers[k] = math.nan if value is None else float(value)
        except (TypeError, ValueError):
            faults.add(name, "numbers", f"{str(value)!r:.40}")
            return numbers
    if column.dtype.kind in "fiu":
        numbers = np.asarray(column, dtype=float)
    large = np.flatnonzero(np.isfinite(numbers) & (np.abs(numbers) > LARGEST))
    if len(large):
        faults.add(name, f"numbers up to {LARGEST:g}", f"{numbers[large[0]]:g}")
    return numbers


def _third_differences(t: Array, x: Array) -> Array:
    """Return third differences (n - 3, 3) of places (n, 3) at any times: a parabola has none, noise as many as at even times."""
    a, b, c = np.diff(t)[:-2], np.diff(t)[1:-1], np.diff(t)[2:]
    weights = np.array(
        [1 / (a * (a + b) * (a + b + c)), 1 / (a * b * (b + c)), 1 / ((a + b) * b * c), 1 / ((a + b + c) * (b + c) * c)]
    )
    weights *= (
        np.array([-1, 1, -1, 1])[:, None] * math.sqrt(20) / np.linalg.norm(weights, axis=0)
    )  # (of even times 1, 3, 3, 1)
    # (relative to the first place, so that a coordinate at rest has none at all)
    found: Array = sum(weights[k][:, None] * (x[k : len(x) - 3 + k] - x[:-3]) for k in (1, 2, 3))
    return found


def _noise(rows: Sequence[BallRows]) -> float:
    """Estimate the noise of a coordinate from third differences, which events affect in few frames: their median is taken."""
    sizes = np.concatenate(
        [
            np.abs(_third_differences(t, x))[np.abs(x[3:] - x[:-3]).max(axis=1) > 0].ravel()
            for _name, t, x, *_rest in rows
            if len(t) > 3
        ]
    )
    # the median of |N(0, 1)| is 0.6745; 1 + 9 + 9 + 1 = 20
    return float(np.median(sizes[sizes > 0]) / 0.6745 / math.sqrt(20)) if (sizes > 0).any() else 0.0


def _pieces(t: Array, x: Array, w: Array | None, sigma: float) -> Iterator[PathPiece]:
    """Yield pieces of constant acceleration: runs of frames in which third differences are noise."""
    if len(t) < FEW:
        return
    calm = (np.abs(_third_differences(t, x)) < 6 * math.sqrt(20) * sigma + 1e-9).all(axis=1)
    edges = np.flatnonzero(np.diff(np.concatenate([[False], calm, [False]])))
    for low, high in zip(edges[::2].tolist(), edges[1::2].tolist(), strict=True):
        first, last = low, high + 2  # window i has the frames i to i + 3
        if sigma > EXACT and last - first > FEW + 2:  # (noise may hide an event within the last of them)
            first, last = first + 1, last - 1
        middle = (t[first] + t[last]) / 2
        tau = t[first : last + 1] - middle
        design = np.stack([np.ones_like(tau), tau, tau * tau], axis=-1)
        numbers = np.linalg.lstsq(design, x[first : last + 1], rcond=None)[0]
        misfit = float(np.square(design @ numbers - x[first : last + 1]).sum()) / (3 * max(len(tau) - 3, 1))
        # (more than noise is a path that is no parabola: it does not average out)
        misfit *= len(tau) if misfit > UNEVEN * sigma**2 else 1
        covariance = np.linalg.inv(design.T @ design) * max(sigma**2, misfit)
        turns = w is not None and bool(np.isfinite(w[first : last + 1]).all())
        spins = None if w is None or not turns else np.linalg.lstsq(design[:, :2], w[first : last + 1], rcond=None)[0]
        error = 0.0
        if spins is not None and w is not None:
            left = float(np.square(design[:, :2] @ spins - w[first : last + 1]).sum(axis=0).max())
            # (noise averages out, a spin that changes unevenly does not: the ends of its line are off by twice the rest)
            error = 2 * math.sqrt(left / max(len(tau) - 2, 1))
        yield PathPiece(first, last, float(middle), numbers, covariance, spins, error)
