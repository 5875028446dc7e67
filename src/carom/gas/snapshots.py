"""Snapshots: gases written to GSD, NPZ and extended XYZ files, and initial states read from CSV, NPZ and GSD files.

GSD files follow HOOMD's schema, which the field's viewers open (OVITO, freud, HOOMD itself): the box is centred on 0 (of discs Lz
= 0 and 2 dimensions), positions and velocities are in single precision, ``step`` is the number of collisions, ``image`` counts
the periods crossed. The spin w is in ``angmom``, the quaternion 2 q (0, S), with the orientation q and the angular momentum S = I
w about the body's axes. A gas does not track orientations, so q is 1. The time is the logged ``carom/time``.
The chunks are written one by one with GSD's file layer: its writer of frames keeps several copies of all balls.
"""

from __future__ import annotations

import csv
import hashlib
import io
import math
import shutil
import zipfile
from collections.abc import Callable, Collection, Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from typing import Any, BinaryIO, NamedTuple

import numpy as np
from numpy.typing import NDArray

from carom.data.table_cells import parse_numbers
from carom.errors import CaromError, Fault, suggestion
from carom.files import atomic_path, cannot_write, import_optional, open_regular, read_text, require_unpacked_size
from carom.formatting import format_bytes, format_number
from carom.gas.gas import Gas
from carom.gas.results import Every, GasBalls, LogTimes
from carom.gas.scene import GasScene
from carom.gas.species import ANY

MAX_BYTES = 1e9  # of a file of snapshots, unless a user allows more
# Per ball and frame, in single precision: position and velocity; angular momentum; the periods crossed. Per frame: the index.
MOVING, SPINNING, PERIODIC, INDEX = 24, 16, 12, 500
DOUBLE = {".npz": 84, ".xyz": 230}  # bytes per ball and frame of files in double precision


class SnapshotSize(NamedTuple):
    """Expected number of frames (nan where nothing is known of it), and bytes of each."""

    frames: float
    frame_bytes: float

    @property
    def total(self) -> float:
        """Bytes of the file."""
        return self.frames * self.frame_bytes

    def describe(self, balls: int) -> str:
        """Return one phrase."""
        frames = f"{self.frames:,.0f}" if self.frames < 1e12 else format_number(self.frames, 2)
        each = f"{frames} frames of {balls:,} balls, {format_bytes(self.frame_bytes)} each"
        return f"about {format_bytes(self.total)}: {each}"


def expected_snapshots(scene: GasScene, every: Every, kind: str = ".gsd") -> SnapshotSize:
    """Return the expected size of the snapshots of a run, at every so many collisions, so much time, or equal ratios of time.

    Where a run is limited by collisions and snapshots are spaced in time, or the other way round, the rate of collisions is that of
    Enskog's theory, with Haff's law for gases that cool: an estimate within a factor of two or so of uniform gases.

    Examples
    --------
    >>> from carom.gas import GasScene
    >>> from carom.gas.snapshots import expected_snapshots
    >>> contact = {"between": ("a", "a"), "restitution": 1, "friction": 0}
    >>> scene = GasScene(
    ...     container={"shape": "periodic", "size": (6, 6, 6)}, species=[{"count": 64, "radius": 0.5}], contacts=[contact],
    ...     run={"max_events": 10_000},
    ... )
    >>> expected_snapshots(scene, 100).frames, expected_snapshots(scene, 100).frame_bytes
    (101, 2804)
    """
    run = scene.run
    lengths: list[float] = []
    if isinstance(every, int):
        lengths += [run.max_events] if run.max_events is not None else []
        lengths += [_collisions(scene, run.duration)] if run.duration is not None else []
    else:
        lengths += [run.duration] if run.duration is not None else []
        lengths += [_duration(scene, run.max_events)] if run.max_events is not None else []
    single = MOVING + SPINNING * scene.spins_change + PERIODIC * any(scene.container.geometry.periodic)
    per_ball = DOUBLE.get(kind, single)
    length = min((one for one in lengths if not math.isnan(one)), default=math.nan)
    frames = every.count(length) if isinstance(every, LogTimes) else length / every
    return SnapshotSize(math.floor(frames) + 1 if frames < 1e15 else frames, scene.count * per_ball + INDEX)


def _mean_speed(scene: GasScene) -> float:
    """Return the thermal speed along an axis of balls of the mean mass and temperature."""
    mass = sum(one.total_mass(scene.container.dimensions) for one in scene.species)
    temperature = sum(one.count * one.temperature for one in scene.species)
    return math.sqrt(temperature / mass)


def _rate(scene: GasScene) -> float:
    """Return the initial rate of collisions of a ball with others: Enskog's for balls of the mean size, mass and temperature."""
    count, axes = scene.count, scene.container.dimensions

    diameter = 2 * sum(one.count * float(one.all_radii.mean()) for one in scene.species) / count
    speed = _mean_speed(scene)
    density, filled = count / scene.container.geometry.volume, min(scene.packing_fraction, 0.7)
    if axes == 2:
        contact = (1 - 7 * filled / 16) / (1 - filled) ** 2
        return 2 * math.sqrt(math.pi) * density * diameter * speed * contact
    contact = (1 - filled / 2) / (1 - filled) ** 3
    return 4 * math.sqrt(math.pi) * density * diameter**2 * speed * contact


def _cooling(scene: GasScene) -> float:
    """Return by how much ln v falls per collision of a ball; 0 for gases that are supplied with energy."""
    if not scene.cools:
        return 0.0
    names, speed = {one.name for one in scene.species}, _mean_speed(scene)
    lost = [1 - one.restitution_at(speed) ** 2 for one in scene.contacts if set(one.between) <= {ANY, *names}]
    return sum(lost) / len(lost) / (2 * scene.container.dimensions) if lost else 0.0


def mean_free_time(scene: GasScene) -> float:
    """Return the expected mean free time of a ball at the start; nan for a gas at rest, or of one ball."""
    rate = _rate(scene) if scene.count > 1 else 0.0
    return 1 / rate if rate > 0 else math.nan


def _duration(scene: GasScene, collisions: float) -> float:
    """Return the expected time of so many collisions."""
    rate, cooling = _rate(scene), _cooling(scene)
    each = 2 * collisions / scene.count
    if rate == 0:  # (a gas that starts at rest)
        return math.nan
    if cooling == 0:
        return each / rate
    return math.expm1(cooling * each) / (cooling * rate) if cooling * each < 700 else math.inf


def _collisions(scene: GasScene, time: float) -> float:
    """Return the expected number of collisions in so much time."""
    rate, cooling = _rate(scene), _cooling(scene)
    if rate == 0:
        return math.nan
    each = rate * time if cooling == 0 else math.log1p(cooling * rate * time) / cooling
    return each * scene.count / 2


def require_size(path: Path, size: SnapshotSize, balls: int, most: float) -> None:
    """Raise CaromError where snapshots are expected to be larger than ``most`` bytes, or than the disk has room for."""
    said = size.describe(balls)
    if size.total > most:
        raise CaromError(
            f"{path}: expected snapshots of at most {format_bytes(most)}, got {said}; choose a larger `every`, or allow more"
            " with `max_bytes`"
        )
    try:
        free = shutil.disk_usage(path.absolute().parent).free
    except OSError:
        return
    if size.total > free:
        raise CaromError(
            f"{path}: expected snapshots that fit on the disk, where {format_bytes(free)} are free, got {said}; choose a longer"
            " interval"
        )


# ----------------------------------------------------------------------------------------------------
# Files of NumPy's arrays, .npz: what they declare is looked at before anything is unpacked.


class ArrayHeader(NamedTuple):
    """Description of an array in a file, from its header."""

    shape: tuple[int, ...]
    dtype: np.dtype[Any]

    @property
    def nbytes(self) -> int:
        """Its size in memory."""
        return math.prod(self.shape) * self.dtype.itemsize


def npz_headers(path: Path, raw: BinaryIO) -> dict[str, ArrayHeader]:
    """Return the headers of the arrays in an NPZ file by name; nothing else is unpacked.

    Raises errors of zipfile, zlib and NumPy for what is no such file, and ValueError where an array is not as large as its data.
    """
    with zipfile.ZipFile(raw) as archive:
        found = {}
        for one in archive.infolist():
            name, _dot, ending = one.filename.rpartition(".")
            if ending != "npy":  # (NumPy hands out such a member as a whole)
                raise ValueError(f"{one.filename}: no array")
            with archive.open(one) as part:
                version = np.lib.format.read_magic(part)
                if version != (1, 0):  # (whose headers may be as large as the array)
                    require_unpacked_size(path, one.file_size)
                v1 = version == (1, 0)
                read = np.lib.format.read_array_header_1_0 if v1 else np.lib.format.read_array_header_2_0
                shape, _order, dtype = read(part)
                found[name] = ArrayHeader(shape, dtype)
                # (np.load refuses objects)
                if not dtype.hasobject and found[name].nbytes != one.file_size - part.tell():
                    raise ValueError(f"{one.filename}: an array {shape} of another size than its data")
    raw.seek(0)
    return found


def require_npz_size(path: Path, headers: Mapping[str, ArrayHeader]) -> None:
    """Raise CaromError where the arrays of a file would be far larger in memory than the file."""
    require_unpacked_size(path, sum(one.nbytes for one in headers.values()))


# ----------------------------------------------------------------------------------------------------
# Snapshots: gases written frame by frame, and initial states read from CSV, NPZ and GSD files.


Array = NDArray[np.float64]
GSD_BYTES = 100  # of a particle or bond of a frame, as the library has it in memory
FRAMES = ("time", "collisions", "position", "velocity", "spin", "images")  # of an .npz file, a row per frame
VECTORS = {"position": ("x", "y", "z"), "velocity": ("vx", "vy", "vz"), "spin": ("wx", "wy", "wz")}


def _gsd(path: Path) -> Any:
    return import_optional("gsd.fl", path.name)


class Snapshots:
    """A file of snapshots that is written frame by frame: .gsd, .npz or .xyz (extended), by its ending.

    Parameters
    ----------
    path : Path
        Of the file.
    names : names of the species
    keep : int, optional
        How many frames of an existing file to keep and append to; default: a new file.
    max_bytes : float, optional
        A frame that would make the file larger is refused. Default: 1 GB.

    An .npz file has arrays ``time``, ``collisions`` (F,), ``position``, ``velocity``, ``spin`` and ``images`` (F, N, 3), and
    ``species``, ``radius``, ``mass`` (N,), and ``box`` (3,), in double precision. Frames are in memory until the file is closed.

    Raises CaromError where the file cannot be written, becomes too large, or has fewer frames than are to be kept, and where GSD
    is not installed.

    Examples
    --------
    >>> import tempfile
    >>> from pathlib import Path
    >>> from carom import Ball, Surface
    >>> from carom.gas import Gas, Snapshots, Species
    >>> gas = Gas([Species(Ball(0.5, 1.0), 8)], (6.0, 6.0, 6.0), contacts=Surface(1, 0, -1))
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     file = Snapshots(Path(folder) / "gas.gsd", ("a",))
    ...     file.write(gas)
    ...     file.close()
    ...     (Path(folder) / "gas.gsd").stat().st_size > 0
    True
    """

    _file: Any
    # What each format has of its own: how a file is opened, and how a frame is written.
    _open: Callable[[int | None], None]
    _write: Callable[[Gas], None]

    def __new__(cls, path: Path, *_more: Any, **_options: Any) -> Snapshots:
        """Return the writer of the file's format."""
        kinds = {".npz": NpzSnapshots, ".xyz": XyzSnapshots}
        suffix = Path(path).suffix.lower() if isinstance(path, str | Path) else ""
        return super().__new__(kinds.get(suffix, GsdSnapshots) if cls is Snapshots else cls)

    def __init__(
        self, path: Path, names: tuple[str, ...], keep: int | None = None, *, max_bytes: float = MAX_BYTES
    ) -> None:
        self.path, self.names, self.max_bytes = path, names, max_bytes
        self._bytes, self._last_frame, self._count = 0, 0, keep or 0
        self._open(keep)

    def write(self, gas: Gas) -> None:
        """Append the gas as it is now."""
        if self._bytes + self._last_frame > self.max_bytes:
            raise CaromError(
                f"{self.path}: expected snapshots of at most {format_bytes(self.max_bytes)}, got {self._count:,} frames"
                f" with {format_bytes(self._bytes)}; choose a larger `every`, or allow more with `max_bytes`"
            )
        before = self._bytes
        with self._writing():
            self._write(gas)
        self._count += 1
        self._last_frame = self._bytes - before

    def flush(self) -> None:
        """Write all frames to disk."""
        with self._writing():
            self._file.flush()

    def close(self) -> None:
        """Write all frames to disk, and close the file."""
        with self._writing():
            self._file.close()

    @contextmanager
    def _writing(self) -> Iterator[None]:
        try:
            yield
        except OSError as error:
            raise cannot_write(self.path, error) from None
        except RuntimeError as error:  # GSD's own
            raise CaromError(f"{self.path}: expected a file to write frames to, got: {error}") from None

    def _require_frames(self, found: int, keep: int) -> None:
        if found < keep:
            raise CaromError(
                f"{self.path}: expected at least {keep} frames, as many as the checkpoint says, got {found}"
            )


class GsdSnapshots(Snapshots):
    """A GSD file in HOOMD's schema."""

    def _open(self, keep: int | None) -> None:
        path, gsd = self.path, _gsd(self.path)
        self._first: dict[str, str] = {}  # digests of the chunks of the first frame
        try:
            if keep is not None:
                self._truncate(gsd, keep)
            self._file = _opened(gsd, path, "w" if keep is None else "r+")
            if keep:
                self._bytes = path.stat().st_size
                names_there = self._file.find_matching_chunk_names("")
                self._first = {
                    name: _digest(self._file.read_chunk(0, name))
                    for name in names_there
                    if self._file.chunk_exists(0, name)
                }
        except CaromError:
            raise
        except Exception as error:  # OSError, RuntimeError and others
            raise CaromError(f"{path}: expected a GSD file to write to, got: {error}") from None

    def _truncate(self, gsd: Any, keep: int) -> None:
        """Remove the frames written after the checkpoint from which the run continues."""
        with _opened(gsd, self.path, "r") as old:
            self._require_frames(old.nframes, keep)
            if old.nframes == keep:
                return
            with atomic_path(self.path) as part, _opened(gsd, part, "w") as new:
                for k in range(keep):
                    for name in old.find_matching_chunk_names(""):
                        if old.chunk_exists(k, name):
                            new.write_chunk(name, old.read_chunk(k, name))
                    new.end_frame()

    def _write(self, gas: Gas) -> None:
        # (one quantity after the other, so that no copy of the whole gas is in memory)
        starts = self._file.nframes == 0
        for name, make, default in _chunks(gas, self.names):
            data = make()
            digest = _digest(data)
            # what is not written is as in the first frame or, where that has none, as HOOMD's schema says
            if name in self._first:
                written = digest != self._first[name]
            else:
                written = default is None or not np.array_equiv(data, np.asarray(default, data.dtype))
            if written:
                self._file.write_chunk(name, data)
                self._bytes += data.nbytes
                if starts:
                    self._first[name] = digest
            del data
        self._file.end_frame()
        self._bytes += INDEX
        if starts:
            self._file.flush()


class NpzSnapshots(Snapshots):
    """Arrays of all frames in one file of NumPy's."""

    def _open(self, keep: int | None) -> None:
        self._frames: list[dict[str, Any]] = []
        self._fixed: dict[str, Any] = {}
        if not keep:
            return
        arrays = _arrays_of(self.path)
        self._require_frames(min((len(arrays.get(name, ())) for name in FRAMES), default=0), keep)
        self._frames = [{name: arrays[name][k] for name in FRAMES} for k in range(keep)]
        self._fixed = {name: array for name, array in arrays.items() if name not in FRAMES}
        self._bytes = sum(arrays[name][:keep].nbytes for name in FRAMES)

    def _write(self, gas: Gas) -> None:
        now, species, fixed = gas.balls(), gas.arrays.materials.species, self._fixed
        if not fixed:
            fixed["species"] = np.array(self.names)[gas.groups[now.species]]
            fixed["radius"], fixed["mass"] = species["radius"][now.species], species["mass"][now.species]
            fixed["box"] = gas.arrays.system[0]["side"]
        values = (now.time, gas.collisions, now.position, now.velocity, now.spin, now.images)
        self._frames.append(dict(zip(FRAMES, map(np.asarray, values), strict=True)))
        self._bytes += sum(one.nbytes for one in self._frames[-1].values())

    def flush(self) -> None:
        """Write all frames to disk."""
        if not self._frames:
            return
        stacked = {name: np.stack([one[name] for one in self._frames]) for name in FRAMES}
        with self._writing(), atomic_path(self.path) as part, part.open("wb") as file:
            np.savez(file, allow_pickle=False, **stacked, **self._fixed)

    close = flush


class XyzSnapshots(Snapshots):
    """Text in the extended XYZ format, which OVITO and ASE read: a line per ball."""

    def _open(self, keep: int | None) -> None:
        if keep:
            with open_regular(self.path) as file:
                for k in range(keep):
                    balls = file.readline().strip()
                    whole = balls.isdigit() and all(file.readline() for _ in range(int(balls) + 1))
                    self._require_frames(keep if whole else k, keep)
                self._bytes = file.tell()
        with self._writing():
            self._file = self.path.open("a", encoding="utf-8", newline="\n")
            self._file.truncate(self._bytes)

    def _write(self, gas: Gas) -> None:
        one, now, species = gas.arrays.system[0], gas.balls(), gas.arrays.materials.species
        axes, side = int(one["dimensions"]), one["side"].tolist()
        box = " ".join(f"{side[i] if i == j and i < axes else 0.0!r}" for i in range(3) for j in range(3))
        around = " ".join("FT"[int(one["periodic"][i])] if i < axes else "F" for i in range(3))
        names = ["_".join(name.split()) for name in self.names]
        head = (
            f'{len(now.position)}\nLattice="{box}" pbc="{around}"'
            " Properties=species:S:1:pos:R:3:velo:R:3:angular_velocity:R:3:radius:R:1:mass:R:1"
            f" Time={now.time!r} collisions={gas.collisions}\n"
        )
        sizes = np.stack([species["radius"][now.species], species["mass"][now.species]], axis=1)
        rows = np.concatenate([now.position, now.velocity, now.spin, sizes], axis=1).tolist()
        kinds = gas.groups[now.species].tolist()
        lines = [f"{names[kind]} {' '.join(map(repr, row))}\n" for kind, row in zip(kinds, rows, strict=True)]
        self._bytes += self._file.write(head) + sum(map(self._file.write, lines))


def _opened(gsd: Any, path: Path, mode: str) -> Any:
    if mode == "w":
        path.touch()  # (with the permissions of other new files: GSD's own are 0640, whatever the umask)
    return gsd.open(name=str(path), mode=mode, application="carom", schema="hoomd", schema_version=(1, 4))


def _digest(data: NDArray[Any]) -> str:
    return hashlib.blake2b(np.ascontiguousarray(data).data, digest_size=16).hexdigest()


Chunk = tuple[str, Callable[[], NDArray[Any]], Any]


def _chunks(gas: Gas, names: tuple[str, ...]) -> Iterator[Chunk]:
    """Yield the quantities of a frame: name, a function that makes the array, and the value that HOOMD's schema has for none."""
    one, species, count = gas.arrays.system[0], gas.arrays.materials.species, len(gas.arrays.balls.motions)
    axes, side = int(one["dimensions"]), np.zeros(3)
    side[:axes] = one["side"][:axes]
    moment = species["kappa"] * species["mass"] * species["radius"] ** 2
    # without moments about x and y HOOMD lets discs turn about z only
    turns = np.array([0, 0, 1] if axes == 2 else [1, 1, 1])
    width = max(len(name.encode()) for name in names) + 1
    types = np.array([name.encode() for name in names], dtype=(bytes, width)).view(np.int8).reshape(len(names), width)

    def of_all(kind: str, columns: int, of: Callable[[GasBalls], Any]) -> Callable[[], NDArray[Any]]:
        def make() -> NDArray[Any]:
            found = np.zeros((count, columns) if columns > 1 else count, kind)
            for rows, balls in gas.blocks():
                found[rows] = of(balls)
            return found

        return make

    def angmom(balls: GasBalls) -> Any:
        return np.concatenate([np.zeros((len(balls.spin), 1)), 2 * moment[balls.species, None] * balls.spin], axis=1)

    yield "configuration/step", lambda: np.array([gas.collisions], np.uint64), 0
    yield "configuration/dimensions", lambda: np.array([axes], np.uint8), 3
    yield "configuration/box", lambda: np.array([*side, 0, 0, 0], np.float32), (1, 1, 1, 0, 0, 0)
    yield "particles/N", lambda: np.array([count], np.uint32), 0
    yield "particles/types", lambda: types, None if names != ("A",) else types
    yield "particles/typeid", of_all("u4", 1, lambda balls: gas.groups[balls.species]), 0
    yield "particles/mass", of_all("f4", 1, lambda balls: species["mass"][balls.species]), 1
    yield "particles/diameter", of_all("f4", 1, lambda balls: 2 * species["radius"][balls.species]), 1
    yield "particles/moment_inertia", of_all("f4", 3, lambda balls: moment[balls.species, None] * turns), 0
    yield "particles/position", of_all("f4", 3, lambda balls: balls.position - side / 2), 0
    yield "particles/velocity", of_all("f4", 3, lambda balls: balls.velocity), 0
    yield "particles/angmom", of_all("f4", 4, angmom), 0
    yield "particles/image", of_all("i4", 3, lambda balls: balls.images), 0
    yield "log/carom/time", lambda: np.array([gas.time]), None


def spins_of(particles: Any) -> NDArray[np.float64] | None:
    """Return the spins (N, 3) of a frame's particles about fixed axes; None where it has no moments of inertia."""
    moment = np.asarray(particles.moment_inertia, dtype=float)
    if not moment.any():
        return None
    q, p = (np.asarray(part, dtype=float) for part in (particles.orientation, particles.angmom))
    # S = Im(q* p) / 2 about the body's axes
    body = (q[:, :1] * p[:, 1:] - p[:, :1] * q[:, 1:] - np.cross(q[:, 1:], p[:, 1:])) / 2
    w = np.divide(body, moment, out=np.zeros_like(body), where=moment > 0)
    # and about fixed ones: q w q*
    t = 2 * np.cross(q[:, 1:], w)
    turned: NDArray[np.float64] = w + q[:, :1] * t + np.cross(q[:, 1:], t)
    return turned


# --- starts from files ---------------------------------------------------------------------------------------------


class InitialState(NamedTuple):
    """Positions, velocities and spins (N, 3) from a file, and the names of the species; None for what it does not have."""

    position: Array
    velocity: Array | None
    spin: Array | None
    species: list[str] | None


def read_initial_state(path: Path, axes: int, size: tuple[float, ...], count: int | None = None) -> InitialState:
    """Read balls from the rows of a CSV file, the arrays of an NPZ file, or the last frame of a GSD file.

    With the number of balls that is expected, arrays of another number are refused by their headers, before they are unpacked.
    Raises CaromError, one line, for what is missing or not a finite number.
    """
    open_regular(path, "a file with positions").close()
    kind = path.suffix.lower()
    start = (
        _read_csv(path, axes)
        if kind == ".csv"
        else _read_npz(path, count)
        if kind == ".npz"
        else _read_gsd(path, axes, size, count)
    )
    for name, values in zip(VECTORS, start[:3], strict=True):
        if values is not None and not np.isfinite(values).all():
            bad = int(np.argwhere(~np.isfinite(values).all(axis=1))[0, 0])
            raise CaromError(f"{path}: expected finite numbers, got {name} {values[bad].tolist()} of ball {bad}")
    return start


def _read_csv(path: Path, axes: int) -> InitialState:
    lines = io.StringIO(read_text(path), newline="")
    rows = list(csv.reader(line for line in lines if not line.startswith("#")))
    head = [name.strip() for name in rows[0]] if rows else []
    known = [*(name for names in VECTORS.values() for name in names), "species"]
    for name in head:
        if name not in known:
            raise CaromError(Fault(f"{path}", "line 1", "a known column", repr(name), suggestion(name, known)))
    if missing := [name for name in "xyz"[:axes] if name not in head]:
        raise CaromError(f"{path}: line 1: expected the columns {', '.join('xyz'[:axes])}, got no {', '.join(missing)}")
    records = [(number, row) for number, row in enumerate(rows[1:], 2) if row]
    for number, row in records:
        if len(row) != len(head):
            raise CaromError(f"{path}: row {number}: expected {len(head)} cells, got {len(row)}")
    table: dict[str, Any] = {}
    for i, name in enumerate(head):
        cells = [row[i] for _number, row in records]
        if name == "species":
            table[name] = [cell.strip() for cell in cells]
            continue
        table[name], bad = parse_numbers(cells, missing=())
        if bad:
            raise CaromError(f"{path}: row {records[bad[0]][0]}: {name}: expected a number, got {cells[bad[0]]!r}")
    count = len(table["x"])
    found: list[Array | None] = []
    for names in VECTORS.values():
        there = [name for name in names if name in table]
        found.append(np.stack([table.get(name, np.zeros(count)) for name in names], axis=1) if there else None)
    position, velocity, spin = found
    assert position is not None
    return InitialState(position, velocity, spin, table.get("species"))


def _require_count(path: Path, found: int, count: int | None) -> None:
    """Raise CaromError where a file has another number of balls than the scene."""
    if count is not None and found != count:
        raise CaromError(f"run.start: expected {count} balls, the sum over the species, got {found} in {path.name}")


def _require_headers(path: Path, headers: dict[str, ArrayHeader], count: int | None) -> None:
    """Raise CaromError for arrays that cannot be the start of so many balls."""
    for name in (*VECTORS, "species"):
        if name not in headers:
            continue
        shape, dtype = headers[name]
        shape = shape[1:] if len(shape) == 3 and shape[0] else shape  # (snapshots: the last frame)
        flat = name == "species" or (name == "spin" and len(shape) == 1)  # (of discs: about z)
        if not flat and (len(shape) != 2 or shape[1] not in {2, 3} or dtype.kind not in "iuf"):
            raise CaromError(f"{path}: {name}: expected numbers of shape (N, 3) or (N, 2), got {shape}")
        _require_count(path, math.prod(shape[:1]), count)


def _arrays_of(path: Path, names: Collection[str] = (), count: int | None = None) -> dict[str, NDArray[Any]]:
    """Return the arrays of an NPZ file, or some of them, after a look at their headers."""
    try:
        with open_regular(path) as raw:
            headers = npz_headers(path, raw)
            if names:
                _require_headers(path, headers, count)
            require_npz_size(path, headers)
            file = np.load(raw, allow_pickle=False)
            return {name: file[name] for name in names or headers if name in file}
    except CaromError:
        raise
    except Exception:  # zip, pickles, short files: many classes, and a remedy of NumPy's that would be unsafe
        raise CaromError(f"{path}: expected arrays saved by NumPy, got another file, or a damaged one") from None


def _read_npz(path: Path, count: int | None) -> InitialState:
    arrays = _arrays_of(path, (*VECTORS, "species"), count)
    if "position" not in arrays:
        raise CaromError(f"{path}: expected an array 'position' (N, 3), got none")
    found: list[Array | None] = []
    for name in VECTORS:
        values = arrays.get(name)
        if values is not None:
            values = values[-1] if values.ndim == 3 else values
            if values.ndim == 1 and name == "spin":  # of discs: about z
                values = np.stack([np.zeros(len(values)), np.zeros(len(values)), values], axis=1)
            values = np.pad(values.astype(float), ((0, 0), (0, 3 - values.shape[1])))
        found.append(values)
    position, velocity, spin = found
    assert position is not None
    species = arrays.get("species")
    return InitialState(position, velocity, spin, None if species is None else [str(name) for name in species])


def _require_gsd_counts(path: Path, count: int | None) -> None:
    """Raise CaromError for numbers of particles and bonds that a file declares, for which the library would make arrays."""
    with _gsd(path).open(name=str(path), mode="r") as file:
        last = file.nframes - 1
        for part in ("particles", "bonds", "angles", "dihedrals", "impropers", "constraints", "pairs"):
            for frame in {0, last}:  # (what a frame leaves out is that of the first)
                if file.chunk_exists(frame=frame, name=f"{part}/N"):
                    found = int(file.read_chunk(frame=frame, name=f"{part}/N")[0])
                    if part == "particles" and frame == last:
                        _require_count(path, found, count)
                    require_unpacked_size(path, found * GSD_BYTES)


def _read_gsd(path: Path, axes: int, size: tuple[float, ...], count: int | None) -> InitialState:
    gsd = import_optional("gsd.hoomd", path.name)
    try:
        _require_gsd_counts(path, count)
        with gsd.open(str(path), "r") as file:
            frame = file[-1]
    except CaromError:
        raise
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
    return InitialState(position, particles.velocity.astype(float), spins_of(particles), species)
