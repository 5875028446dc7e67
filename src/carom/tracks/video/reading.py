"""Frames of a film with the container's times: planes of brightness and colour as stored, upright; and balls tracked in them."""

from __future__ import annotations

import contextlib
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from os import PathLike
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from carom.errors import CaromError, Fault
from carom.files import as_path, import_optional, open_regular, write_text
from carom.formatting import counted
from carom.public.other_rooms import figure_maker
from carom.tracks.preprocess import even_interval
from carom.tracks.track import Track
from carom.tracks.video.edges import Patch

if TYPE_CHECKING:
    from matplotlib.figure import Figure

Array = NDArray[np.float64]
Bytes = NDArray[np.uint8]
Mask = NDArray[np.bool_]
STORED = ("yuv420p", "yuvj420p")  # pixel formats of which the planes are used as they are
SUFFIXES = (".mp4", ".mov", ".m4v", ".webm", ".mkv", ".avi", ".mts", ".m2ts", ".3gp", ".mpg", ".mpeg", ".wmv", ".ogv")
SIDE = 64, 16384  # px, least and largest
EVEN = 0.02  # of a frame: stamps so near an even clock are of one
STANDARDS = {1: (0.2126, 0.0722), 9: (0.2627, 0.0593)}  # weights of red and blue: BT.709, BT.2020; else BT.601
FULL_RANGE = 2
AROUND = 1.6  # radii that a crop shows around the middle of the ball


class Frame(NamedTuple):
    """A frame of a film: planes of brightness (H, W) and of colour (H / 2, W / 2), upright; valid until the next one is read."""

    number: int
    stamp: float
    """s; NaN where the container has none."""
    y: Bytes
    u: Bytes
    v: Bytes


def is_film(path: Path) -> bool:
    """Return whether a file is taken for a film, by the ending of its name.

    Examples
    --------
    >>> from pathlib import Path
    >>> is_film(Path("bounce.MOV")), is_film(Path("bounce.csv"))
    (True, False)
    """
    return path.suffix.lower() in SUFFIXES


@dataclass(frozen=True)
class FilmFile:
    """A film to read: size, rotation and clock of its pictures; made by :func:`open_film`."""

    path: Path
    height: int
    """px, of the upright picture; even."""
    width: int
    rotation: int
    """Quarter turns, counter-clockwise, by which the stored picture was turned: rows of the camera run along x for 1 and 3."""
    rate: float
    """Frames per second, as the container says; NaN if it does not."""
    tick: float
    """Step of the stamps, s."""
    start: float
    """Stamp of the first frame, s."""
    matrix: Array
    """(3, 4): red, green, blue (0 to 255) of y, u, v and 1."""
    notes: tuple[str, ...] = ()
    kept: dict[int, list[Patch]] = field(default_factory=dict)
    """By frame: pixels that were read once, in which :func:`patches` looks before it reads the film again."""

    def frames(self, skip: str = "DEFAULT") -> Iterator[Frame]:
        """Yield the frames in the order of the film; of some codecs only those that are stored whole, with ``NONKEY``."""
        with _opened(self.path) as (container, stream):
            stream.thread_type = "AUTO"
            stream.codec_context.skip_frame = skip
            number = 0
            for picture in _decoded(self.path, container, stream):
                if picture.width * picture.height == 0:
                    continue
                stamp = np.nan if picture.pts is None else float(picture.pts * picture.time_base)
                yield Frame(number, stamp, *self._planes(picture))
                number += 1

    def _planes(self, picture: Any) -> list[Bytes]:
        stored = (self.width, self.height) if self.rotation % 2 == 0 else (self.height, self.width)
        off = max(abs(picture.width - stored[0]), abs(picture.height - stored[1]))
        if picture.format.name not in STORED or off > 1:
            picture = picture.reformat(width=stored[0], height=stored[1], format="yuv420p")
        found = []
        for part, plane in zip((1, 2, 2), picture.planes[:3], strict=True):
            pixels = np.frombuffer(plane, np.uint8).reshape(-1, plane.line_size)
            found.append(np.rot90(pixels[: stored[1] // part, : stored[0] // part], self.rotation))
        return found

    def to_rgb(self, y: Bytes, u: Bytes, v: Bytes) -> Bytes:
        """Return planes (h, w), (h / 2, w / 2) twice as a picture (h, w, 3), 0 to 255."""
        u, v = (np.repeat(np.repeat(one, 2, axis=0), 2, axis=1)[: y.shape[0], : y.shape[1]] for one in (u, v))
        stacked = np.stack([y, u, v, np.ones_like(y)], axis=-1).astype(np.float32)
        return np.clip(np.rint(stacked @ self.matrix.T.astype(np.float32)), 0, 255).astype(np.uint8)


def open_film(path: Path) -> FilmFile:
    """Look at a film: its size, rotation and clock. Raises CaromError for what is no film, and where PyAV is not installed."""
    import_optional("av", "films")
    open_regular(path, "a film").close()
    with _opened(path) as (container, stream):
        picture = next(_decoded(path, container, stream), None)
        if picture is None:
            raise CaromError(Fault(f"{path}", "", "a film with pictures", "none that can be decoded"))
        rotation, aspect = int(np.rint(picture.rotation / 90)) % 4, stream.sample_aspect_ratio
        notes = []
        width, height = int(picture.width), int(picture.height)
        if aspect and aspect != 1:
            width = round(width * float(aspect))
            notes.append(
                f"pixels are {float(aspect):.4g} times as wide as high: the picture was stretched to {width} px"
            )
        if picture.interlaced_frame:
            notes.append("frames are interlaced: every second row is from another moment; remove the interlacing first")
        width, height = width // 2 * 2, height // 2 * 2
        if rotation % 2:
            width, height = height, width
        if not SIDE[0] <= min(width, height) <= max(width, height) <= SIDE[1]:
            raise CaromError(
                Fault(f"{path}", "", f"pictures of {SIDE[0]} to {SIDE[1]} px a side", f"{width} x {height}")
            )
        rate = stream.average_rate or stream.guessed_rate
        space = int(picture.colorspace)
        matrix = _matrix(space if space in STANDARDS or height < 720 else 1, int(picture.color_range) == FULL_RANGE)
        start = 0.0 if picture.pts is None else float(picture.pts * picture.time_base)
        return FilmFile(
            path, height, width, rotation, float(rate) if rate else np.nan, float(stream.time_base or 1e-3), start, matrix,
            tuple(notes),
        )  # fmt: skip


@contextlib.contextmanager
def _opened(path: Path) -> Iterator[tuple[Any, Any]]:
    """Open a film, and find its first stream of pictures."""
    av = import_optional("av", "films")
    try:
        container = av.open(str(path))
    except (av.error.FFmpegError, ValueError) as error:
        raise CaromError(Fault(f"{path}", "", "a film", f"{getattr(error, 'strerror', None) or error}")) from None
    with container:
        if not container.streams.video:
            raise CaromError(Fault(f"{path}", "", "a film", "a file without pictures"))
        yield container, container.streams.video[0]


def _decoded(path: Path, container: Any, stream: Any) -> Iterator[Any]:
    """Yield decoded pictures; a film that is cut off ends where it does."""
    av = import_optional("av", "films")
    picture = None
    try:
        for picture in container.decode(stream):
            yield picture
    except av.error.FFmpegError as error:
        if picture is None:
            raise CaromError(Fault(f"{path}", "", "a film", f"{error.strerror or error}")) from None


def _matrix(space: int, full: bool) -> Array:
    red, blue = STANDARDS.get(space, (0.299, 0.114))
    green = 1 - red - blue
    low, span, colour = (0.0, 255.0, 255.0) if full else (16.0, 219.0, 224.0)
    scale, c = 255 / span, 255 / colour
    of_v = np.array([2 * (1 - red), -2 * red * (1 - red) / green, 0.0])
    of_u = np.array([0.0, -2 * blue * (1 - blue) / green, 2 * (1 - blue)])
    return np.stack([np.full(3, scale), c * of_u, c * of_v, -scale * low - 128 * c * (of_u + of_v)], axis=1)


def film_times(film: FilmFile, stamps: Sequence[float] | Array, rate: float | None, notes: list[str]) -> Array:
    """Return the times (F,) of frames, s, from the first on; notes say what was made of the stamps.

    Stamps are used as they are, of variable rates too; those that the container rounds, and an even clock explains, are on that
    clock. ``rate``: true frames per second (slow motion): times are scaled.

    Raises CaromError for stamps that go backward or are missing, without a ``rate``.
    """
    known: NDArray[Any] = np.asarray(stamps, dtype=np.float64)
    count, step = len(known), np.diff(known)
    missing, back = int((~np.isfinite(known)).sum()), np.flatnonzero(step <= 0)
    if missing or len(back):
        got = f"{missing} frames without one"
        if not missing:
            k = int(back[0])
            got = f"{known[k + 1]:.6g} s after {known[k]:.6g} s, at frame {k + 1} ({len(back)} in all)"
        known = np.arange(count) / film.rate if missing else np.sort(known)
        step = np.diff(known)
        if rate is None and not np.ptp(step) < 2 * film.tick + EVEN * float(np.median(step)):
            advice = "the file's clock is broken: `rate` gives the frames per second, which are then taken as even"
            raise CaromError(
                Fault(f"{film.path}", "times", "one for each frame, later than the one before", got, advice)
            )
        known = np.arange(count) * (float(np.mean(step)) if rate is None else 1 / rate)
        step = np.diff(known)
        notes.append(
            f"the container's times are out of order: {got}; taken as even, {1 / float(step[0]):.4g} frames per second"
        )
    usual = float(np.median(step)) if count > 1 else np.nan
    times = known - known[0] if count else known
    number = np.concatenate([[0.0], np.cumsum(np.round(step / usual))])[:count]
    tick = np.full(count, max(film.tick, 1e-9))
    even = even_interval(times, 2 * tick, number, off=0.0) if count > 2 and (np.diff(number) > 0).all() else None
    if even is not None and film.tick < 0.5 * even:
        times, usual = even * number, even
        if number[-1] > count - 1:
            notes.append(
                f"{int(number[-1]) + 1 - count} frames are missing between others, by the times of the container"
            )
    elif count > 2 and np.abs(np.diff(times) / usual - 1).max() > EVEN:
        notes.append(
            f"variable frame rate: {1e3 * step.min():.3g} to {1e3 * step.max():.3g} ms from frame to frame; the container's times"
            " are used"
        )
    if rate is None:
        return np.asarray(times)
    if abs(rate * usual - 1) > EVEN:
        notes.append(f"the container plays {1 / usual:.4g} frames per second, `rate` {rate:g} overrides it")
    return np.asarray(times / (usual * rate))


# ----------------------------------------------------------------------------------------------------
# Balls that were tracked in a film, and the pixels around them.


@dataclass(frozen=True, eq=False)
class TrackedFilm:
    """Balls tracked in a film, in pixels: x to the right and y down, from the middle of the first pixel of the upright picture.

    F is the number of frames.
    """

    path: Path
    times: Array
    """(F,) s, from the first frame on: the middle of each exposure, in the row of the picture's middle."""
    places: Mapping[str, Array]
    """By ball: (F, 2) px, the middle of its outline; NaN where it was not seen."""
    radius_px: float
    """Radius of the balls, px."""
    outline_cost: Array
    """(F,) mean square misfit of the outline, 1 for the usual frame; the worst of the balls, NaN where none was seen."""
    flagged: Mask
    """(F,): frames in which the outline of a ball does not fit."""
    exposure: float
    """s."""
    psf: float
    """Standard deviation of the blur of the camera, px."""
    background: Bytes
    """(H, W, 3): red, green, blue of the picture without what moves."""
    velocity_px: Mapping[str, Array]
    """By ball: (F, 2) px/s, in the frame; NaN where it was not seen."""
    notes: tuple[str, ...] = ()
    used: Mapping[str, Mask] = field(default_factory=dict)
    """By ball: (F,) frames whose place is used: seen, not flagged, without a contact within the exposure."""
    tracks: tuple[Track, ...] = ()
    """In m, upward from the picture's lower left corner, with the times of the balls' rows."""
    scale: float = np.nan
    """m per px."""
    readout: float = 0.0
    """s, from the first to the last row of the camera."""
    readout_error: float = 0.0
    """s, where it was found; shared by all times of rows, and so part of the error bars of what is measured."""

    def table(self) -> dict[str, NDArray[Any]]:
        """Return the columns ``t [s]``, ``x [m]``, ``y [m]``, ``ball`` of the tracks, a row per ball and frame; and their spins.

        ``sigma_t [s]`` is the error that the times have in common; a table with it keeps its times, which are not evenly spaced.
        """
        rows = {"t [s]": [one.time for one in self.tracks]}
        rows |= {f"{axis} [m]": [one.position[:, k] for one in self.tracks] for k, axis in enumerate("xy")}
        more = {"spin": "spin [rad/s]", "sigma_spin": "sigma_spin [rad/s]", "sigma_time": "sigma_t [s]"}
        for name, label in more.items():
            parts = [part for one in self.tracks if (part := getattr(one, name)) is not None]
            if np.isfinite(np.concatenate([np.zeros(0), *parts])).any():
                rows[label] = parts
        found = {name: np.concatenate([np.zeros(0), *parts]) for name, parts in rows.items()}
        return found | {"ball": np.array([one.name for one in self.tracks for _ in range(len(one))], dtype=object)}

    def save(self, path: str | PathLike[str]) -> Path:
        """Write the table as .csv: ``t [s]``, ``x [m]``, ``y [m]``, ``ball``, with all digits."""
        file, columns = as_path("TrackedFilm.save", path), self.table()
        rows = zip(*(column.tolist() for column in columns.values()), strict=True)
        lines = [",".join(columns), *(",".join(map(str, row)) for row in rows), ""]
        write_text(file, "\n".join(lines))
        return file

    def sheet(self, file: str | PathLike[str]) -> Figure:
        """Draw the contact sheet, to look at what was tracked: .png, .svg or .pdf."""
        return figure_maker("plot_film")(self, file)  # type: ignore[no-any-return]

    def __repr__(self) -> str:
        """Return one line: the number of balls and frames."""
        balls = ", ".join(f"{name} {int(np.isfinite(x[:, 0]).sum())}" for name, x in self.places.items())
        return f"<TrackedFilm {self.path.name}: {counted(len(self.times), 'frame')}; seen: {balls}>"


class Crop(NamedTuple):
    """Pixels around a ball in a frame."""

    frame: int
    corner: tuple[int, int]
    """x, y of the first pixel, px."""
    pixels: Bytes
    """(h, w, 3): red, green, blue; parts beyond the picture's edge are left out."""


def crops(film: TrackedFilm, ball: str, frames: Sequence[int]) -> Iterator[Crop]:
    """Yield the pixels around a ball in some frames, in the order of the film; frames in which it was not seen are left out.

    Each shows 1.6 radii around the middle, and the way of the exposure. The film is read again from its beginning.
    Raises CaromError for a ball that is none of the film's, and if the film can no longer be read.
    """
    if ball not in film.places:
        raise CaromError(Fault("crops", "ball", f"one of {', '.join(film.places)}", repr(ball)))
    file, wanted = open_film(film.path), dict[int, list[Any]]()
    for k in map(int, frames):
        if 0 <= k < len(film.times) and np.isfinite(film.places[ball][k]).all():
            way = float(np.abs(np.nan_to_num(film.velocity_px[ball][k])).max()) * film.exposure / 2
            wanted[k] = [(k, film.places[ball][k], AROUND * film.radius_px + way + 2)]
    for frame, patch in patches(file, (), wanted):
        yield Crop(frame, patch.corner, file.to_rgb(*patch.planes))


def patches(
    film: FilmFile, ground: Sequence[Bytes], wanted: Mapping[int, Sequence[tuple[Any, Array, float]]]
) -> Iterator[tuple[Any, Patch]]:
    """Yield the pixels around places, and of the planes of the background there, with their keys.

    ``wanted`` has, by frame, keys, places (2,) and half widths, px.
    """
    windows: dict[int, list[Any]] = {}
    for number in sorted(wanted):
        for key, place, half in wanted[number]:
            low = np.maximum(np.floor(place - half), 0).astype(int) // 2 * 2
            high = np.minimum(np.ceil(place + half), [film.width, film.height]).astype(int) // 2 * 2
            if (high - low >= 8).all():
                held = [one for one in film.kept.get(number, ()) if one.holds(low, high)]
                windows.setdefault(number, []).append((key, low, high, held[:1]))
    if all(held for some in windows.values() for *_rest, held in some):
        yield from ((key, held[0].part(*window)) for some in windows.values() for key, *window, held in some)
        return
    for frame in film.frames():
        whole = Patch(frame.number, (0, 0), (frame.y, frame.u, frame.v), tuple(ground))
        for key, low, high, _held in windows.pop(frame.number, ()):
            part = whole.part(low, high)
            yield key, part._replace(planes=tuple(one.copy() for one in part.planes))
        if not windows:
            return
