"""A film in which balls were tracked: places, times, outline of each frame, and the pixels around a ball."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from os import PathLike
from pathlib import Path as FilePath
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from carom.errors import CaromError, Fault, noting
from carom.files import as_path, write_text
from carom.formatting import counted
from carom.public.defaults import GRAVITY
from carom.public.other_rooms import figure_maker
from carom.public.progress import Progress
from carom.tracks.track import Track
from carom.tracks.video.balls import (
    CHANGED,
    LOST,
    Background,
    Blob,
    Linker,
    Path,
    cores_of,
    find_background,
    find_regions,
    joined,
    likely_paths,
    sampled,
)
from carom.tracks.video.edges import Optics, Patch, fit_optics, fit_outline
from carom.tracks.video.reading import Array, Bytes, FilmFile, film_times, open_film
from carom.tracks.video.scale import (
    MOST_MISFIT,
    Asked,
    check_arguments,
    choose_readout,
    choose_scale,
    contacts_within,
    fit_falls,
    row_phase,
    rows_direction,
    turning,
)

if TYPE_CHECKING:
    from matplotlib.figure import Figure

Mask = NDArray[np.bool_]
AROUND = 1.6  # radii that a crop shows around the middle of the ball


@dataclass(frozen=True, eq=False)
class TrackedFilm:
    """Balls tracked in a film, in pixels: x to the right and y down, from the middle of the first pixel of the upright picture.

    F is the number of frames.
    """

    path: FilePath
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
        """Return the columns ``t [s]``, ``x [m]``, ``y [m]``, ``ball`` of the tracks, a row per ball and frame; and their spins."""
        rows = {"t [s]": [one.time for one in self.tracks]}
        rows |= {f"{axis} [m]": [one.position[:, k] for one in self.tracks] for k, axis in enumerate("xy")}
        for name, label in (
            ("spin", "spin [rad/s]"),
            ("sigma_spin", "sigma_spin [rad/s]"),
            ("sigma_time", "sigma_t [s]"),
        ):
            more = [part for one in self.tracks if (part := getattr(one, name)) is not None]
            if np.isfinite(np.concatenate([np.zeros(0), *more])).any():
                rows[label] = more
        found = {name: np.concatenate([np.zeros(0), *parts]) for name, parts in rows.items()}
        return found | {"ball": np.array([one.name for one in self.tracks for _ in range(len(one))], dtype=object)}

    def save(self, path: str | PathLike[str]) -> FilePath:
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
    file, wanted = open_film(film.path), {int(k) for k in frames}
    last = max(wanted, default=-1)
    for frame in file.frames() if wanted else ():
        if frame.number > last:
            return
        x, y = film.places[ball][frame.number] if frame.number < len(film.times) else (np.nan, np.nan)
        if frame.number not in wanted or not np.isfinite(x):
            continue
        way = np.nan_to_num(film.velocity_px[ball][frame.number]) * film.exposure / 2
        (left, right), (top, bottom) = (
            np.clip([middle - half, middle + half], 0, most).astype(int) // 2 * 2
            for middle, half, most in zip(
                (x, y), AROUND * film.radius_px + np.abs(way) + 2, frame.y.shape[::-1], strict=True
            )
        )
        if right > left and bottom > top:
            rows, columns = slice(top, bottom), slice(left, right)
            halves = slice(top // 2, bottom // 2), slice(left // 2, right // 2)
            pixels = file.to_rgb(frame.y[rows, columns], frame.u[halves], frame.v[halves])
            yield Crop(frame.number, (int(left), int(top)), pixels)


# ----------------------------------------------------------------------------------------------------
# From the file to the record: background, blobs, paths; the optics from some frames of each candidate; then all frames.

LEAST_FRAMES = 6
SAMPLED = 10  # frames of a candidate from which the optics are found
FEW, MANY = 24, 80  # frames of a ball from which the camera's readout is found, at first and in the end
LAG_ERROR, LAG_SHARE = (
    (1.3, 4.0),
    0.04,
)  # times the error by the frames' scatter, rows from top to bottom, sideways; of the readout
MOST_BYTES = 150e6  # of patches that are kept at once
SHARE, RIM = 0.75, 0.6  # of what a candidate's picture shows, explained by a disc; of its rim, seen
WHOLE_RIM, SHIFT = 0.85, 0.25  # of the rim, seen in brightness and in colour; px between these two, usually
ALIKE_SIZE = 0.12  # scatter of a ball's radius in the frames, at most
SHARPER = 0.85  # blur of a ball without its shadow, of that with it
LIKE = 0.5  # of the frames of the best candidate: another one with as many is as likely
ASTRAY = 5.0, 0.06  # from where frames before, and those after, have the ball: times the usual, and radii
FLAGGED = 8.0  # times the usual cost
FAR = 25.0  # radii: the way of what surely moves
GROWS = 0.03  # of the radius, that is said
FAST = 0.2  # radii from frame to frame: a ball whose blur tells the exposure
LONGEST, STRETCHED = 1.2, 0.7  # of the time from frame to frame, an exposure; of the radius, a blur that says so
LONG_EXPOSURE = 0.5  # of the time from frame to frame


class Candidate(NamedTuple):
    """A path with the outline's usual numbers."""

    path: Path
    optics: Optics
    share: float
    seen: float
    scatter: float
    """Of the radius, relative."""
    radii: Array
    """(n, 2): frame and radius, px."""
    stretched: bool
    """Whether it is longer than it can move in the time from frame to frame."""

    @property
    def score(self) -> float:
        """How much speaks for a ball: frames, and that it moves far."""
        way = float(np.hypot(*np.diff(self.path.places, axis=0).T).sum())
        return len(self.path.frames) * max(self.share, 0.0) * min(way / self.optics.radius / FAR, 1.0)

    @property
    def is_ball(self) -> bool:
        """Whether a disc explains what is seen."""
        outline = (
            self.share > SHARE
            and self.seen > RIM
            and self.scatter < ALIKE_SIZE / 2 + 0.25 / self.optics.radius
            and self.optics.radius > 2.5
        )
        return outline and not self.stretched


def patches(
    film: FilmFile, ground: Background, wanted: Mapping[int, Sequence[tuple[Any, Array, float]]]
) -> Iterator[tuple[Any, Patch]]:
    """Yield the pixels around places, with their keys: ``wanted`` has, by frame, keys, places (2,) and half widths, px."""
    last = max(wanted, default=-1)
    for frame in film.frames() if wanted else ():
        if frame.number > last:
            return
        height, width = frame.y.shape
        for key, place, half in wanted.get(frame.number, ()):
            low = np.maximum(np.floor(place - half), 0).astype(int) // 2 * 2
            high = np.minimum(np.ceil(place + half), [width, height]).astype(int) // 2 * 2
            if (high - low < 8).any():
                continue
            rows, columns = slice(low[1], high[1]), slice(low[0], high[0])
            halves = slice(low[1] // 2, high[1] // 2), slice(low[0] // 2, high[0] // 2)
            planes = frame.y[rows, columns].copy(), frame.u[halves].copy(), frame.v[halves].copy()
            y, u, v = ground.planes
            yield key, Patch(frame.number, (int(low[0]), int(low[1])), planes, (y[rows, columns], u[halves], v[halves]))


def velocities(times: Array, places: Array) -> tuple[Array, Array, Array]:
    """Return velocities (F, 2) in frames, px/s: of both sides, of the frames before, and of those after; NaN without a place.

    Those of one side are of the frame, not of the middle between frames, where there are three frames.
    """
    rows = np.flatnonzero(np.isfinite(places[:, 0]))
    both, before, after = (np.full(places.shape, np.nan) for _ in range(3))
    if len(rows) < 2:
        return both, before, after
    t, x = times[rows], places[rows]
    slope = np.diff(x, axis=0) / np.diff(t)[:, None]
    bend = np.diff(slope, axis=0) / (t[2:] - t[:-2])[:, None]  # (half the acceleration)
    first, second = np.concatenate([slope[:1], slope]), np.concatenate([slope, slope[-1:]])
    first[2:] += bend * np.diff(t)[1:, None]
    second[:-2] -= bend * np.diff(t)[:-1, None]
    both[rows], before[rows], after[rows] = (first + second) / 2, first, second
    weights = np.diff(t)
    both[rows[1:-1]] = (slope[:-1] * weights[1:, None] + slope[1:] * weights[:-1, None]) / (weights[:-1] + weights[1:])[
        :, None
    ]
    return both, before, after


def _dense(path: Path, count: int, times: Array) -> Array:
    """Return the places (F, 2) of a path, with those of short gaps between; NaN elsewhere."""
    found = np.full((count, 2), np.nan)
    frames, places = np.array(path.frames), path.places
    inner = np.arange(frames[0], frames[-1] + 1)
    gap = (
        np.diff(frames)[np.clip(np.searchsorted(frames, inner, side="right") - 1, 0, len(frames) - 2)]
        if len(frames) > 1
        else 1
    )
    known = inner[(gap <= LOST) | np.isin(inner, frames)]
    for axis in (0, 1):
        found[known, axis] = np.interp(times[known], times[frames], places[:, axis])
    return found


def _usual_optics(film: FilmFile, ground: Background, paths: Sequence[Path], times: Array) -> list[Candidate]:
    """Return candidates with radius, blur of the lens, exposure and noise, each from some frames of its own."""
    cores, interval = [one for one in map(cores_of, paths) if one is not None], float(np.median(np.diff(times)))
    found = [
        _candidate(path, mine, ground, interval)
        for path, mine in _some_patches(film, ground, [*paths, *cores], times)
        if len(mine) >= 3
    ]
    # (a ball with its shadow is no disc, or a larger one: what is no shadow of it is taken where that is a ball)
    better = {id(one): core for one in found for core in found if core.path in cores and one.path not in cores
              and core.is_ball and (not one.is_ball or core.optics.psf < SHARPER * one.optics.psf)
              and _within(core.path, one.path)}  # fmt: skip
    return [better.get(id(one), one) for one in found if one.path not in cores]


def _within(core: Path, path: Path) -> bool:
    """Return whether a path of cores is of the blobs of another path."""
    cores = {(k, one.core[:2]) for k, one in zip(path.frames, path.blobs, strict=True) if one.core is not None}
    return all((k, (one.x, one.y)) in cores for k, one in zip(core.frames, core.blobs, strict=True))


def _some_patches(
    film: FilmFile, ground: Background, paths: Sequence[Path], times: Array
) -> list[tuple[Path, list[tuple[Patch, Blob, Array]]]]:
    """Return for each path the pixels around it in some frames, slow and fast ones, with the blob and the velocity, px/s."""
    wanted: dict[int, list[Any]] = {}
    speeds = []
    for k, path in enumerate(paths):
        dense = _dense(path, len(times), times)
        speeds.append(velocities(times, dense)[0])
        size, turns = path.radius, np.convolve(turning(times, dense), np.ones(3), "same")[path.frames] > 0
        usual = [i for i, one in enumerate(path.blobs) if not one.cut and abs(np.log(one.radius / size)) < 0.4]
        steady = [i for i in usual if not turns[i]]
        good = sorted(steady if len(steady) >= LEAST_FRAMES else usual, key=lambda i: path.blobs[i].blur)
        for i in {good[round(one)] for one in np.linspace(0, len(good) - 1, SAMPLED)} if good else ():
            blob = path.blobs[i]
            wanted.setdefault(path.frames[i], []).append(
                ((k, i), np.array([blob.x, blob.y]), 1.7 * size + blob.blur / 2 + 8)
            )
    rows: list[list[tuple[Patch, Blob, Array]]] = [[] for _ in paths]
    for (k, i), patch in patches(film, ground, wanted):
        rows[k].append((patch, paths[k].blobs[i], np.nan_to_num(speeds[k][patch.frame])))
    return list(zip(paths, rows, strict=True))


def _candidate(path: Path, some: Sequence[tuple[Patch, Blob, Array]], ground: Background, interval: float) -> Candidate:
    """Return a candidate from its pixels in some frames, with blobs and velocities."""
    noise = tuple(max(2 * one, least) for one, least in zip(ground.noise, (1.5, 0.8, 0.8), strict=True))
    quick, blur = (
        np.array([np.hypot(*speed) for *_rest, speed in some]),
        np.array([one.blur for _patch, one, _speed in some]),
    )
    fast = quick * interval > FAST * path.radius
    exposure = float(np.median(blur[fast] / quick[fast])) if fast.any() else 0.0
    optics = Optics(0.95 * path.radius, 1.0, min(exposure, interval), noise, rows=ground.rows, lag=ground.lag)  # type: ignore[arg-type]
    first = [
        (patch, fit_outline(patch, np.array([one.x, one.y]), speed, optics, order=1), speed)
        for patch, one, speed in some
    ]
    usual = np.median([one.cost for _patch, one, _speed in first])
    good = [(patch, one.place, speed) for patch, one, speed in first if one.cost <= 2 * usual]
    optics, _errors, places = fit_optics(good, optics, "rse" if fast.any() else "rs")
    long = optics.exposure > LONGEST * interval
    stretched = long and optics.exposure * float(np.median(quick[fast])) > STRETCHED * optics.radius
    optics = optics._replace(exposure=min(optics.exposure, interval))
    slow = sorted(
        ((patch, at, speed) for (patch, _at, speed), at in zip(good, places, strict=True)),
        key=lambda one: np.hypot(*one[2]),
    )
    optics = optics._replace(shift=_colour_shift(slow[:5], optics))
    last = [fit_outline(patch, one.place, speed, optics, free="xyr", coarse=False) for patch, one, speed in first]
    radii = np.array([one.radius for one in last])
    return Candidate(
        path, optics._replace(radius=float(np.median(radii))), float(np.median([one.share for one in last])),
        float(np.median([one.seen for one in last])), float(1.4826 * np.median(np.abs(radii / np.median(radii) - 1))),
        np.array([[patch.frame, radius] for (patch, *_rest), radius in zip(some, radii, strict=True)]), stretched,
    )  # fmt: skip


def _colour_shift(slow: Sequence[tuple[Patch, Array, Array]], optics: Optics) -> tuple[float, float]:
    """Return by how much the colour planes are shifted against brightness, px, from frames in which the ball is slow."""
    off = []
    for patch, place, speed in slow:
        sides = []
        for blind in ((1, 1e3, 1e3), (1e3, 1, 1)):
            alone = optics._replace(noise=tuple(np.multiply(optics.noise, blind)))
            sides.append(fit_outline(patch, place, speed, alone, coarse=False, order=2))
        if min(one.seen for one in sides) > WHOLE_RIM:
            off.append(sides[0].place - sides[1].place)
    if len(off) < 3:
        return 0.0, 0.0
    found = np.median(off, axis=0)
    doubt = 1.4826 * np.median(np.abs(off - found), axis=0) / np.sqrt(len(off)) / SHIFT
    x, y = np.clip(found / (1 + doubt**2), -2 * SHIFT, 2 * SHIFT)
    return float(x), float(y)


def _followed(
    film: FilmFile, ground: Background, ball: Candidate, times: Array, tell: Callable[[int], None]
) -> tuple[Array, Array]:
    """Return the places (F, 2) and costs (F,) of a ball's outline in all frames of its path."""
    count = len(times)
    seeds = _dense(ball.path, count, times)
    places, costs = np.full((count, 2), np.nan), np.full(count, np.nan)
    speed = velocities(times, seeds)[0]
    blurs = dict(zip(ball.path.frames, (one.blur for one in ball.path.blobs), strict=True))
    radii = _radius_of_frames(ball, count)
    rows = np.flatnonzero(np.isfinite(seeds[:, 0]))
    # (a centre so near the edge that part of the outline is beyond it)
    low, high = 0.8 * ball.optics.radius, np.array([film.width, film.height]) - 1 - 0.8 * ball.optics.radius
    border = np.asarray(((seeds > low) & (seeds < high)).all(axis=1))
    rows = rows[border[rows]]
    wanted = {}
    for k in rows.tolist():
        way = max(float(np.abs(speed[k]).max()) * ball.optics.exposure, blurs.get(k, 0.0))
        wanted[k] = [(k, seeds[k], 1.7 * radii[k] + way / 2 + 8)]
    chunk: list[Patch] = []
    held = 0.0

    def finish() -> None:
        _fit_chunk(chunk, ball.optics, radii, times, seeds, places, costs)
        chunk.clear()

    for _key, patch in patches(film, ground, wanted):
        chunk.append(patch)
        held += 2 * sum(one.nbytes for one in patch.planes)
        if held > MOST_BYTES:
            finish()
            held = 0.0
        tell(patch.frame)
    finish()
    off = np.full(count, np.nan)
    for k in rows.tolist():
        near = _from_beside(k, times, places, costs, np.inf)
        if len(near) == 2:
            off[k] = min(float(np.hypot(*(at - places[k]))) for at, _speed in near)
    usual = float(np.nanmedian(off)) if np.isfinite(off).any() else 0.0
    costs[off > np.maximum(ASTRAY[0] * usual, ASTRAY[1] * radii)] = 1e6  # (the outline of something else)
    return places, costs


def _radius_of_frames(ball: Candidate, count: int) -> Array:
    """Return the radius (F,) in frames, px: one for all, or of a parabola in time where it changes by more than its scatter."""
    frame, radius = ball.radii.T
    usual = np.full(count, ball.optics.radius)
    keep = np.abs(radius / ball.optics.radius - 1) < 0.3
    if keep.sum() < 6 or np.ptp(frame[keep]) == 0:
        return usual
    middle, half = frame[keep].mean(), max(np.ptp(frame[keep]) / 2, 1.0)
    fit = np.polyfit((frame[keep] - middle) / half, radius[keep], 1)
    left = radius[keep] - np.polyval(fit, (frame[keep] - middle) / half)
    error = float(np.std(left)) / np.sqrt(keep.sum())
    if abs(fit[0]) < max(4 * error, GROWS * ball.optics.radius):
        return usual
    return np.polyval(fit, np.clip((np.arange(count) - middle) / half, -1, 1))


def _fit_chunk(
    chunk: Sequence[Patch], optics: Optics, radii: Array, times: Array, seeds: Array, places: Array, costs: Array
) -> None:
    """Fit the outlines in some frames, in rounds: with the way of the blobs, of the places found, and, where bad, from beside."""
    by_frame = {patch.frame: patch for patch in chunk}
    speed = np.nan_to_num(velocities(times, seeds)[0])
    for k, patch in by_frame.items():
        found = fit_outline(patch, seeds[k], speed[k], optics._replace(radius=radii[k]))
        places[k], costs[k] = found.place, found.cost
    for turn in range(3):
        both, before, after = velocities(times, places)
        usual = float(np.nanmedian(costs)) if np.isfinite(costs).any() else 1.0
        for k, patch in by_frame.items():
            choices = [one[k] for one in (both, before, after) if np.isfinite(one[k]).all()]
            bad = costs[k] > FLAGGED / 2 * usual
            turns = len(choices) == 3 and float(np.hypot(*(choices[1] - choices[2]))) * optics.exposure > 1.0
            moved = len(choices) > 0 and float(np.hypot(*(choices[0] - speed[k]))) * optics.exposure > 0.7
            if not (bad or (turns and turn == 0) or (moved and turn < 2)):
                continue
            if not turns:
                choices = choices[:1]
            starts = [(places[k], one) for one in [*choices, *([np.zeros(2)] if turns else [])]]
            if bad:
                starts += _from_beside(k, times, places, costs, FLAGGED / 2 * usual)
            at = optics._replace(radius=radii[k])
            same = [(places[k], speed[k]), *starts] if len(starts) > 1 else ()
            tried = [fit_outline(patch, *one, at, coarse=bad, like=same[:1]) for one in starts]
            best = min(range(len(tried)), key=lambda i: tried[i].cost)
            if not np.isfinite(costs[k]) or tried[best].cost < costs[k] or not bad:
                places[k], costs[k], speed[k] = tried[best].place, tried[best].cost, starts[best][1]


def _from_beside(k: int, times: Array, places: Array, costs: Array, most: float) -> list[tuple[Array, Array]]:
    """Return places and velocities in a frame by the parabolas through the good frames before it, and after it."""
    found = []
    good = np.flatnonzero((costs <= most) & np.isfinite(places[:, 0]))
    for side in (good[good < k][-4:], good[good > k][:4]):
        if len(side) >= 3 and abs(side - k).max() < 9:
            t = times[side] - times[k]
            fit = [np.polyfit(t, places[side, axis], 2) for axis in (0, 1)]
            found.append((np.array([one[2] for one in fit]), np.array([one[1] for one in fit])))
    return found


def track_film(
    path: str | FilePath,
    balls: int | None = None,
    *,
    radius: float | None = None,
    scale: float | str | None = None,
    length: str | None = None,
    readout: float | None = None,
    rate: float | None = None,
    ball: Sequence[str] | str = (),
    colour: str | None = None,
    region: str | None = None,
    start: float | None = None,
    end: float | None = None,
    gravity: float = GRAVITY,
    progress: Progress | None = None,
) -> TrackedFilm:
    """Track balls in a film, by their outlines: ``carom track``.

    Parameters
    ----------
    path : path
        A film that FFmpeg can read, taken with a camera at rest.
    balls : int, optional
        How many balls to track. Default: one, or as many as have a place.
    radius : float, optional
        Radius, m; gives the scale to some 2 % where nothing else does.
    scale : float or "gravity", optional
        Metres per pixel, 0.0005 or 0.5mm; or gravity: from free flight.
    length : str, optional
        Two points of the picture, px, and their distance: x1,y1,x2,y2=1m.
    readout : float, optional
        Time from the camera's first row to its last, s. Default: from the flights, if they show it.
    rate : float, optional
        True frames per second of a film in slow motion. Default: the container's times.
    ball : sequence of str, optional
        A place of the ball, px, at a time, s: x,y@t; once for each ball. Default: the things that move and are round.
    colour : str, optional
        Colour of the balls, such as '#e0b020'.
    region : str, optional
        Part of the picture in which balls move, px: x0,y0,x1,y1.
    start : float, optional
        Begin at this time of the film, s.
    end : float, optional
        End at this time of the film, s.
    gravity : float
        Gravity, m/s^2.
    progress : callable(done, total, text), optional

    Returns
    -------
    TrackedFilm
        ``.tracks`` in m, upward, ``.table()``, ``.sheet(file)``, ``.notes``; :func:`carom.measure_tracks` takes it.

    Raises
    ------
    CaromError
        One line: no film, no ball, two that may be meant, a camera that moves, no scale.

    Examples
    --------
    >>> import carom
    >>> film = carom.track_film("bounce.mp4", length="102,655,1180,650=1m")  # doctest: +SKIP
    >>> film.tracks[0].position.shape  # doctest: +SKIP
    (112, 2)
    """
    if balls is None:
        balls = 1 if isinstance(ball, str) else max(len(ball), 1)
    asked = check_arguments(balls, radius, scale, length, readout, rate, ball, colour, region, start, end)
    file = open_film(as_path("track_film", path))
    notes = list(file.notes)
    part = (file.start + (start or 0.0), np.inf if end is None else file.start + end)

    def tell(done: float, text: str) -> None:
        if progress is not None:
            progress(done, 1.0, text)

    tell(0.0, "background")
    samples = sampled(file, part)
    if len(samples) < LEAST_FRAMES:
        raise CaromError(Fault(f"{file.path}", "", f"{LEAST_FRAMES} frames or more", f"{len(samples)}"))
    size = file.width if file.rotation % 2 else file.height
    ground = find_background(samples)._replace(rows=rows_direction(file.rotation), lag=(readout or 0.0) / size)
    del samples
    stamps, paths, changed = _linked(file, ground, part, asked, tell)
    times = film_times(file, stamps, rate, notes)
    with noting(notes):
        chosen = _chosen(file, ground, paths, times, asked, balls, changed)
    if readout is None:
        chosen = _by_rows(file, ground, chosen, times)[0]
    notes += _outline_notes(chosen, times)
    names = ["ball"] if balls == 1 else [f"ball {k + 1}" for k in range(balls)]
    places, costs = {}, {}
    for k, (name, one) in enumerate(zip(names, chosen, strict=True)):

        def said(done: int, k: int = k) -> None:
            tell(0.3 + 0.7 * (k + done / len(times)) / balls, "outlines")

        places[name], costs[name] = _followed(file, ground, one, times, said)
        costs[name] /= max(float(np.nanmedian(costs[name])), 1e-9)
    chosen, lags = (
        _by_rows(file, ground, chosen, times, list(places.values()), list(costs.values()))
        if readout is None
        else (chosen, [])
    )
    optics = max(chosen, key=lambda one: len(one.path.frames)).optics
    return _record(file, ground, times, places, costs, optics, (scale, length, radius, readout, gravity), lags, notes)


def _by_rows(
    file: FilmFile,
    ground: Background,
    balls: Sequence[Candidate],
    times: Array,
    places: Sequence[Array] = (),
    costs: Sequence[Array] = (),
) -> tuple[list[Candidate], list[tuple[float, float]]]:
    """Return balls with the optics of many of their frames, and the camera's readout with its error, s, that each one shows.

    What is read later shows the ball further on: a ball that moves along with the reading is longer, another one shorter. Without
    ``places`` the blobs' places are where outlines are sought.
    """
    known = places or [_dense(one.path, len(times), times) for one in balls]
    wanted: dict[int, list[Any]] = {}
    speeds = []
    for n, (ball, place) in enumerate(zip(balls, known, strict=True)):
        speeds.append(velocities(times, place)[0])
        steady = np.isfinite(speeds[n][:, 0]) & ~(np.convolve(turning(times, place), np.ones(3), "same") > 0)
        if costs:
            steady &= costs[n] < FLAGGED / 2
        rows = np.flatnonzero(steady)
        for k in (
            rows[np.unique(np.linspace(0, len(rows) - 1, MANY if places else FEW).astype(int))].tolist()
            if len(rows)
            else ()
        ):
            half = 1.7 * ball.optics.radius + float(np.abs(speeds[n][k]).max()) * ball.optics.exposure / 2 + 8
            wanted.setdefault(k, []).append((n, place[k], half))
    frames: list[list[tuple[Patch, Array, Array]]] = [[] for _ in balls]
    for n, patch in patches(file, ground, wanted):
        place, speed = known[n][patch.frame], speeds[n][patch.frame]
        if not places:
            outline = fit_outline(patch, place, speed, balls[n].optics)
            place = outline.place
        frames[n].append((patch, place, speed))
    found, lags = [], []
    size = file.width if file.rotation % 2 else file.height
    for ball, some in zip(balls, frames, strict=True):
        if len(some) < LEAST_FRAMES:
            found.append(ball)
            continue
        optics, errors, _places = fit_optics(some, ball.optics, "rseqbcd")
        value, error = optics.lag * size, 1e-6 * float(errors[3]) * size
        # (rows read sideways only show as a slant, which light and blur make, too)
        times_error = LAG_ERROR[file.rotation % 2]
        lags.append((value, float(np.hypot(times_error * error, LAG_SHARE * value))))
        seen = ball.optics._replace(lag=optics.lag if value > 3 * error else 0.0)
        exposure = fit_optics(some, seen, "rse", steps=4)[0].exposure
        found.append(ball._replace(optics=seen._replace(exposure=min(exposure, float(np.median(np.diff(times)))))))
    return found, lags


def _linked(
    file: FilmFile, ground: Background, part: tuple[float, float], asked: Asked, tell: Callable[[float, str], None]
) -> tuple[list[float], list[Path], float]:
    """Return the stamps of all frames, the paths of what moves in part of the film, and which share of frames changes."""
    inside = None
    if asked.region is not None:
        inside = np.zeros(ground.half.shape, bool)
        x0, y0, x1, y1 = (int(one / 2) for one in asked.region)
        inside[y0 : y1 + 1, x0 : x1 + 1] = True
    linker, stamps, shares = Linker(), list[float](), list[float]()
    for frame in file.frames():
        stamps.append(frame.stamp)
        if part[0] <= frame.stamp <= part[1] or not np.isfinite(frame.stamp):
            regions, share = find_regions(frame, ground, inside)
            linker.add(frame.number, regions)
            shares.append(share)
        tell(0.05 + 0.25 * (1 - 100 / (100 + frame.number)), "what moves")
    return stamps, linker.paths, float(np.mean(np.array(shares) > CHANGED)) if shares else 0.0


def _chosen(
    file: FilmFile, ground: Background, paths: Sequence[Path], times: Array, asked: Asked, balls: int, changed: float
) -> list[Candidate]:
    """Return the candidates that are balls. Raises CaromError where they are not, or others are as likely."""
    where = f"{file.path}"
    if changed > 0.5:
        got = f"a picture that changes as a whole in {100 * changed:.0f} % of the frames"
        raise CaromError(
            Fault(where, "", "a camera at rest", got, "put it on a stand, or cut the film (`start`, `end`)")
        )
    likely = likely_paths(paths, LEAST_FRAMES)
    if asked.colour is not None:
        likely = [one for one in likely if np.abs(_rgb(file, one) - asked.colour).max() < 70]
    if asked.seeds:
        first = [_nearest(where, paths, times, seed) for seed in asked.seeds]
        found = _usual_optics(file, ground, [joined(one, likely) for one in first], times)
        if len(found) == balls:
            return found
        raise CaromError(
            Fault(
                where,
                "`ball`",
                f"outlines of {counted(balls, 'ball')}",
                f"{len(found)}",
                "name a frame in which it is seen alone",
            )
        )
    found = _usual_optics(file, ground, likely[: balls + 4], times)
    good = sorted((one for one in found if one.is_ball), key=lambda one: -one.score)
    apart: list[Candidate] = []
    for one in good:
        # (what goes on under another name is the same ball)
        if any(_one_ball(one.path, other.path) for other in apart):
            continue
        apart.append(one)
    if len(apart) < balls:
        raise CaromError(
            Fault(
                where,
                "",
                f"{counted(balls, 'round thing')} that move{'s' if balls == 1 else ''}",
                _what_moves(found, likely, times, len(apart)),
                "is the ball as bright as the ground, or too small? `ball` x,y@t names it",
            )
        )
    rest = [one for one in apart[balls:] if one.score > LIKE * apart[balls - 1].score]
    if rest:
        said = "; ".join(_said(one, times) for one in [*apart[:balls], *rest][:4])
        raise CaromError(
            Fault(
                where,
                "",
                counted(balls, "ball"),
                f"{len(apart[:balls]) + len(rest)} that are as likely: {said}",
                f"carom track `balls` {balls + len(rest)} tracks all, `ball` x,y@t names one",
            )
        )
    kept = [
        one._replace(
            path=joined(one.path, [path for path in likely if not any(path is other.path for other in apart[:balls])])
        )
        for one in apart[:balls]
    ]
    return sorted(kept, key=lambda one: (one.path.frames[0], one.path.blobs[0].x)) if balls > 1 else kept


def _one_ball(one: Path, other: Path) -> bool:
    """Return whether two paths may be one ball's: never at the same time, of one size and colour."""
    return len(joined(other, [one]).frames) > len(other.frames)


def _rgb(file: FilmFile, path: Path) -> Array:
    return np.asarray(file.matrix @ [*np.median([one.colour for one in path.blobs], axis=0), 1.0])


def _nearest(where: str, paths: Sequence[Path], times: Array, seed: tuple[float, ...]) -> Path:
    """Return the path that passes nearest to a place (px) at a time."""
    x, y, t = seed
    frame = int(np.argmin(np.abs(times - t)))
    near: list[tuple[float, int, Path, Blob]] = []
    for path in paths:
        k = int(np.argmin(np.abs(np.array(path.frames) - frame)))
        if abs(path.frames[k] - frame) <= 2:
            near.append((float(np.hypot(path.blobs[k].x - x, path.blobs[k].y - y)), len(near), path, path.blobs[k]))
    best = min(near, default=None)
    if best is None or best[0] > 2 * best[3].radius + 5 or len(best[2].frames) < LEAST_FRAMES:
        got = (
            "nothing"
            if best is None
            else f"at ({best[3].x:.0f}, {best[3].y:.0f}) the nearest, in {counted(len(best[2].frames), 'frame')}"
        )
        raise CaromError(Fault(where, "`ball`", f"something that moves near ({x:g}, {y:g}) at {t:g} s", got))
    return best[2]


def _said(one: Candidate, times: Array) -> str:
    k = len(one.path.frames) // 2
    blob, t = one.path.blobs[k], times[one.path.frames[k]]
    return (
        f"r = {one.optics.radius:.3g} px in {counted(len(one.path.frames), 'frame')}, {blob.x:.0f},{blob.y:.0f}@{t:.3g}"
    )


def _what_moves(found: Sequence[Candidate], likely: Sequence[Path], times: Array, count: int) -> str:
    lacking = [one for one in found if not one.is_ball]
    some = f"{count}, and " if count else ""
    if not lacking:
        return f"{some}{'nothing that keeps its size' if not likely else 'nothing with an outline'}"
    best = max(lacking, key=lambda one: one.share * one.seen)
    return (
        f"{some}at best {_said(best, times)}, of which a disc explains {100 * max(best.share, 0):.0f} %, with"
        f" {100 * best.seen:.0f} % of its rim seen, its radius scattering by {100 * best.scatter:.0f} %"
    )


def _outline_notes(chosen: Sequence[Candidate], times: Array) -> list[str]:
    notes = []
    interval = float(np.median(np.diff(times)))
    for one in chosen:
        radii = _radius_of_frames(one, len(times))[one.path.frames]
        if np.ptp(radii) > GROWS * one.optics.radius:
            notes.append(
                f"the ball's radius changes from {radii[0]:.3g} to {radii[-1]:.3g} px: it comes nearer or moves away, so the scale"
                " is not the same everywhere"
            )
    one = max(chosen, key=lambda one: len(one.path.frames))
    if one.optics.exposure > LONG_EXPOSURE * interval:
        blur = (
            float(np.nanmax(np.hypot(*velocities(times, _dense(one.path, len(times), times))[0].T)))
            * one.optics.exposure
        )
        notes.append(
            f"exposure of {1e3 * one.optics.exposure:.3g} ms of {1e3 * interval:.3g} ms from frame to frame: a blur of up to"
            f" {blur:.0f} px; frames whose exposure holds a contact are left out. 1/500 s would give more"
        )
    return notes


def _record(
    file: FilmFile, ground: Background, times: Array, places: dict[str, Array], costs: dict[str, Array], optics: Optics,
    asked: tuple[float | str | None, str | None, float | None, float | None, float], lags: Sequence[tuple[float, float]],
    notes: list[str],
) -> TrackedFilm:  # fmt: skip
    """Return the record: flagged frames, frames with contacts in them, the readout, the scale and the tracks."""
    scale, length, radius, given, gravity = asked
    size = (file.width, file.height)
    flags = {name: costs[name] > FLAGGED for name in places}
    used, speed = {}, {}
    held = 0
    for name, place in places.items():
        good = np.isfinite(place[:, 0]) & ~flags[name]
        within = contacts_within(times, np.where(good[:, None], place, np.nan), optics.exposure)
        held += int((within & good).sum())
        used[name] = good & ~within
        speed[name] = velocities(times, place)[0]
    flagged = np.any(list(flags.values()), axis=0)
    if flagged.any():
        notes.append(
            f"in {counted(int(flagged.sum()), 'frame')} the outline does not fit (a shadow, another thing beside the ball): left"
            f" out, at t = {', '.join(f'{t:.4g}' for t in times[flagged][:8])}{' ...' if flagged.sum() > 8 else ''} s"
        )
    if held:
        notes.append(f"{counted(held, 'frame')} whose exposure holds a contact left out")
    readout, error = (given, 0.0) if given is not None else (0.0, 0.0)
    phases = {name: np.nan_to_num(row_phase(place, size, file.rotation)) for name, place in places.items()}
    falls = None
    if given is None:
        balls = [(times, place, used[name]) for name, place in places.items()]
        falls = fit_falls(balls, size, file.rotation, free=True)
        flights = (
            [(falls.readout, falls.readout_error)]
            if falls is not None and falls.rises and falls.rms < MOST_MISFIT
            else []
        )
        readout, error = choose_readout([*lags, *flights], notes)
    balls = [(times + readout * phases[name], place, used[name]) for name, place in places.items()]
    falls = fit_falls(balls, size, file.rotation, free=False)
    value = choose_scale(optics.radius, falls, scale=scale, length=length, radius=radius, gravity=gravity, notes=notes)
    tracks = []
    for name, place in places.items():
        rows = np.flatnonzero(used[name])
        t = times[rows] + readout * phases[name][rows]
        up = np.stack([place[rows, 0], file.height - 1 - place[rows, 1]], axis=1) * value
        shared = error * phases[name][rows] if error else None
        tracks.append(Track(name, t, up, frame=rows.astype(float), stamped=True, sigma_time=shared))
    cost = np.full(len(times), np.nan)
    for one in costs.values():
        cost = np.fmax(cost, one)
    y, u, v = ground.planes
    return TrackedFilm(
        file.path, times, places, optics.radius, cost, flagged, optics.exposure, optics.psf, file.to_rgb(y, u, v), speed,
        tuple(notes), used, tuple(tracks), value, readout, error,
    )  # fmt: skip
