"""Starts from files: positions, and velocities, spins and species where the file has them. CSV, NPZ, GSD."""

from __future__ import annotations

import csv
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from carom.checks import nearest
from carom.errors import CaromError
from carom.files import library

__all__ = ["Start", "read_start"]

Array = NDArray[np.float64]
VECTORS = {"position": ("x", "y", "z"), "velocity": ("vx", "vy", "vz"), "spin": ("wx", "wy", "wz")}


class Start(NamedTuple):
    """What a file says of the balls: (N, 3) each, and the names of their species; None for what it does not say."""

    position: Array
    velocity: Array | None
    spin: Array | None
    species: list[str] | None


def read_start(path: Path, axes: int, size: tuple[float, ...]) -> Start:
    """The balls of a file: the rows of a CSV, the arrays of an NPZ, the last frame of a GSD (whose box is centred on 0).

    Raises CaromError, one line, for what is not there or not numbers.
    """
    try:
        with path.open("rb"):
            pass
    except OSError as error:
        raise CaromError(f"{path}: expected a file with a start, got: {error.strerror}") from None
    kind = path.suffix.lower()
    start = _csv(path, axes) if kind == ".csv" else _npz(path) if kind == ".npz" else _gsd(path, axes, size)
    for name, values in zip(VECTORS, start[:3], strict=True):
        if values is not None and not np.isfinite(values).all():
            bad = int(np.argwhere(~np.isfinite(values).all(axis=1))[0, 0])
            raise CaromError(f"{path}: expected finite numbers, got {name} {values[bad].tolist()} of ball {bad}")
    return start


def _csv(path: Path, axes: int) -> Start:
    with path.open(newline="", encoding="utf-8-sig") as file:
        try:
            rows = list(csv.reader(line for line in file if not line.startswith("#")))
        except UnicodeDecodeError:
            raise CaromError(f"{path}: expected text in UTF-8") from None
    head = [name.strip() for name in rows[0]] if rows else []
    known = [*(name for names in VECTORS.values() for name in names), "species"]
    for name in head:
        if name not in known:
            raise CaromError(f"{path}: line 1: expected columns that are known, got {name!r}; {nearest(name, known)}")
    if missing := [name for name in "xyz"[:axes] if name not in head]:
        raise CaromError(f"{path}: line 1: expected the columns {', '.join('xyz'[:axes])}, got no {', '.join(missing)}")
    table: dict[str, list[Any]] = {name: [] for name in head}
    for number, row in enumerate(rows[1:], 2):
        if not row:
            continue
        if len(row) != len(head):
            raise CaromError(f"{path}: row {number}: expected {len(head)} cells, got {len(row)}")
        for name, cell in zip(head, row, strict=True):
            try:
                table[name].append(cell.strip() if name == "species" else float(cell))
            except ValueError:
                raise CaromError(f"{path}: row {number}: {name}: expected a number, got {cell!r}") from None
    count = len(table["x"])
    found: list[Array | None] = []
    for names in VECTORS.values():
        there = [name for name in names if name in table]
        found.append(np.stack([table.get(name, [0.0] * count) for name in names], axis=1) if there else None)
    position, velocity, spin = found
    assert position is not None
    return Start(position, velocity, spin, table.get("species"))


def _npz(path: Path) -> Start:
    try:
        with path.open("rb") as raw:
            file = np.load(raw, allow_pickle=False)
            arrays = {name: file[name] for name in (*VECTORS, "species") if name in file}
    except Exception as error:  # zip, pickles, short files: many classes
        raise CaromError(f"{path}: expected arrays that NumPy saved, got: {error}") from None
    if "position" not in arrays:
        raise CaromError(f"{path}: expected an array 'position' (N, 3), got none")
    found: list[Array | None] = []
    for name in VECTORS:
        values = arrays.get(name)
        if values is not None:
            if values.ndim == 1 and name == "spin":  # of discs: about z
                values = np.stack([np.zeros(len(values)), np.zeros(len(values)), values], axis=1)
            if values.ndim != 2 or values.shape[1] not in {2, 3} or values.dtype.kind not in "iuf":
                raise CaromError(f"{path}: {name}: expected numbers of shape (N, 3) or (N, 2), got {values.shape}")
            values = np.pad(values.astype(float), ((0, 0), (0, 3 - values.shape[1])))
        found.append(values)
    position, velocity, spin = found
    assert position is not None
    species = arrays.get("species")
    return Start(position, velocity, spin, None if species is None else [str(name) for name in species])


def _gsd(path: Path, axes: int, size: tuple[float, ...]) -> Start:
    from carom.gas.snapshots import spin_of

    gsd = library("gsd.hoomd", "gsd", path.name)
    try:
        with gsd.open(str(path), "r") as file:
            frame = file[-1]
    except Exception as error:  # the library raises OSError, RuntimeError and others
        raise CaromError(f"{path}: expected a GSD file of HOOMD's schema, got: {error}") from None
    particles = frame.particles
    box = np.array(frame.configuration.box, dtype=float)
    if np.abs(box[:axes] / np.array(size) - 1).max() > 1e-5 or box[3:].any():
        raise CaromError(f"{path}: expected the box of the container, {list(size)}, got {box.tolist()}")
    shift = np.zeros(3)
    shift[:axes] = np.array(size) / 2
    position = particles.position.astype(float) + shift
    if axes == 2:
        position[:, 2] = 0.0
    species = [particles.types[k] for k in particles.typeid]
    return Start(position, particles.velocity.astype(float), spin_of(particles), species)
