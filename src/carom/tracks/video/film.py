"""From a film to tracks: what moves; the optics from some frames of each candidate; then the outlines in all frames."""

from __future__ import annotations

import functools
from collections.abc import Callable, Sequence
from pathlib import Path as FilePath
from typing import Any, NamedTuple

import numpy as np

from carom.errors import CaromError, Fault, noting
from carom.files import as_path
from carom.formatting import counted
from carom.public.defaults import GRAVITY
from carom.public.progress import Progress
from carom.tracks.track import Track, position_noise
from carom.tracks.verdicts import WHOLE_WIDTH, FilmPath
from carom.tracks.video import balls as things
from carom.tracks.video import scale as scales
from carom.tracks.video.balls import LOST, Background, Blob, Path, joined
from carom.tracks.video.edges import Optics, Outline, Patch, fit_optics, fit_outline, look_closer
from carom.tracks.video.reading import Array, FilmFile, Mask, TrackedFilm, film_times, open_film, patches
from carom.tracks.video.scale import Asked, TableView, fit_falls, rows_direction, turning
from carom.tracks.video.spin import with_spins

LEAST_FRAMES = 6
SAMPLED = 10  # frames of a candidate from which the optics are found
FEW, MANY = 24, 80  # frames of a ball from which the camera's readout is found, at first and in the end
LAG_ERROR = 1.3, 4.0  # times the error by the frames' scatter, of rows from top to bottom, and of those read sideways
LAG_SHARE = 0.04  # of the readout, its error at least
RIM_ERROR = 0.03  # px by which marks and the ground make an outline longer where a ball rises than where it falls
MOST_BYTES = 150e6  # of patches that are kept at once
SHARE, RIM = 0.75, 0.6  # of what a candidate's picture shows, explained by a disc; of its rim, seen
WHOLE_RIM, SHIFT = 0.85, 0.25  # of the rim, seen in brightness and in colour; px between these two, usually
ALIKE_SIZE = 0.12  # scatter of a ball's radius in the frames, at most
SHARPER = 0.85  # blur of a ball without its shadow, of that with it
LIKE = 0.5  # of the frames of the best candidate: another one with as many is as likely
ASTRAY = 4.0, 0.25  # from where the frames beside it have the ball: times the usual, and px
OTHER_SHAPE = 0.06, 0.3  # by which a rim differs from the ball's usual one: radii, and px
NO_DISC = 0.2  # radii, by which it differs from a disc's
OTHER_LIGHT, OTHER_COLOUR = (0.35, 12.0), 14.0  # by which a ball differs from itself: of its light, and levels; levels
OTHER_SHARE = 0.035  # of its picture, explained less: a frame that the codec made of those beside it
OTHER_SCATTER = 7.0  # times the median difference, which marks on the ball make
SAME = 0.3  # of the tiles, of a frame that is no other picture
MOST_CUT = 0.05  # share of frames that are another picture
MOST_SHIFT = 1.2  # px by which most of a camera's frames may be shifted
MOVING = "a picture of which most moves by"
ELLIPSE = 0.985  # of the area of an ellipse with its moments: of a disc of which a part is hidden it is less, or it looks round
LEAST_GOOD = 0.5  # of the frames of a ball, whose outline fits
FLAGGED = 8.0  # times the usual cost
FAR = 25.0  # radii: the way of what surely moves
UNSTEADY = 0.04  # of the radius: scatter about a smooth path
GROWS = 0.03  # of the radius, that is said
FAST, SLOW = 0.2, 0.3  # radii from frame to frame, and of the largest speed: a ball whose blur tells the exposure
HELD, DEEP = 0.95, 0.8  # of the radius and of the misfit, what is left of both where a deep shadow was part of the disc
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
    offset: Array
    """(2,) px: from the blobs' places, which hold the ball's shadow, to the outlines', usually."""

    @property
    def score(self) -> float:
        """How much speaks for a ball: frames, and that it moves far."""
        way = float(np.hypot(*np.diff(self.path.places, axis=0).T).sum())
        return len(self.path.frames) * max(self.share, 0.0) * min(way / self.optics.radius / FAR, 1.0)

    @property
    def is_ball(self) -> bool:
        """Whether a disc explains what is seen."""
        even = self.scatter < ALIKE_SIZE / 2 + 0.25 / self.optics.radius
        return self.share > SHARE and self.seen > RIM and even and self.optics.radius > 2.5 and not self.stretched


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
    both[rows[1:-1]] = np.gradient(x, t, axis=0)[1:-1]
    return both, before, after


def _dense(path: Path, count: int, times: Array) -> Array:
    """Return the places (F, 2) of a path, with those of short gaps between; NaN elsewhere."""
    found = np.full((count, 2), np.nan)
    frames, places = np.array(path.frames), path.places
    inner = np.arange(frames[0], frames[-1] + 1)
    after = np.searchsorted(frames, inner)
    known = inner[frames[after] - frames[np.maximum(after - 1, 0)] <= np.where(frames[after] == inner, np.inf, LOST)]
    for axis in (0, 1):
        found[known, axis] = np.interp(times[known], times[frames], places[:, axis])
    return found


def _windows(
    path: Path, places: Array, times: Array, radii: Array | float, exposure: float
) -> dict[int, tuple[Array, float]]:
    """Return the places and half widths, px, of what shows a ball and what is around it, by frame."""
    way = np.abs(velocities(times, places)[0]).max(axis=1) * exposure
    way[path.frames] = np.fmax(way[path.frames], [one.blur for one in path.blobs])
    half = 1.7 * radii + way / 2 + 8
    return {k: (places[k], float(half[k])) for k in np.flatnonzero(np.isfinite(places[:, 0])).tolist()}


def _keep(film: FilmFile, ground: Background, paths: Sequence[Path], times: Array) -> None:
    """Keep the pixels around paths, the likely ones first, as much as may be kept, so that the film is not read again."""
    wanted: dict[int, list[Any]] = {}
    room, most = MOST_BYTES, 1.1 * float(np.median(np.diff(times)))
    for path in paths:
        windows = _windows(path, _dense(path, len(times), times), times, 1.2 * path.radius + 4, most)
        room -= sum(6 * half**2 for _place, half in windows.values())
        for k, window in windows.items() if room > 0 else ():
            wanted.setdefault(k, []).append((k, *window))
    for k, patch in patches(film, ground.planes, wanted):
        film.kept.setdefault(k, []).append(patch)


def _usual_optics(film: FilmFile, ground: Background, paths: Sequence[Path], times: Array) -> list[Candidate]:
    """Return candidates with radius, blur of the lens, exposure and noise, each from some frames of its own."""
    cores, interval = [one for one in map(things.cores_of, paths) if one is not None], float(np.median(np.diff(times)))
    found = [
        _candidate(path, mine, ground, interval, shaded=any(path is one or _within(one, path) for one in cores))
        for path, mine in _some_patches(film, ground, [*paths, *cores], times)
        if len(mine) >= 3
    ]
    # (a ball with its shadow is no disc, or a larger one: what is no shadow of it is taken where that is a ball)
    better = {id(one): core for one in found for core in found if core.path in cores and one.path not in cores
              and core.is_ball and (not one.is_ball or one.optics.deep > core.optics.deep
                                or core.optics.psf < SHARPER * one.optics.psf)
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
            half = 1.7 * size + blob.blur / 2 + 8
            wanted.setdefault(path.frames[i], []).append(((k, i), np.array([blob.x, blob.y]), half))
    rows: list[list[tuple[Patch, Blob, Array]]] = [[] for _ in paths]
    for (k, i), patch in patches(film, ground.planes, wanted):
        rows[k].append((patch, paths[k].blobs[i], np.nan_to_num(speeds[k][patch.frame])))
    return list(zip(paths, rows, strict=True))


def _candidate(
    path: Path, some: Sequence[tuple[Patch, Blob, Array]], ground: Background, interval: float, *, shaded: bool
) -> Candidate:
    """Return a candidate from its pixels in some frames, with blobs and velocities; ``shaded``: some of these hold a shadow."""
    noise: Any = tuple(max(2 * one, least) for one, least in zip(ground.noise, (2.2, 0.8, 0.8), strict=True))
    quick = np.array([np.hypot(*speed) for *_rest, speed in some])
    blur = np.array([one.blur for _patch, one, _speed in some])
    fast = quick > max(FAST * path.radius / interval, SLOW * quick.max())
    exposure = float(np.median(blur[fast] / quick[fast])) if fast.any() else 0.0
    optics = Optics(
        0.95 * path.radius, 1.0, min(exposure, interval), noise, rows=ground.rows, lag=ground.lag, fall=_fall(path, interval)
    )  # fmt: skip
    first = [
        (patch, fit_outline(patch, np.array([one.x, one.y]), speed, optics, order=1), speed)
        for patch, one, speed in some
    ]
    usual = np.median([one.cost for _patch, one, _speed in first])
    good = [(patch, one.place, speed) for patch, one, speed in first if one.cost <= 2 * usual]
    free = "rse" if fast.any() else "rs"
    found = fit_optics(good, optics, free)
    if shaded:
        # (a disc that holds ball and shadow is larger than the ball)
        deep, flat = fit_optics(good, optics._replace(deep=True), free), found[0]
        misfits = np.median([
            [fit_outline(patch, at, speed, one, order=1, like=(at, speed * flat.exposure)).cost for patch, at, speed in good]
            for one in (deep[0], flat)
        ], axis=1)  # fmt: skip
        if deep[0].radius < HELD * flat.radius and misfits[0] < DEEP * misfits[1]:
            found = deep
    optics, _errors, places = found
    stretched = (
        optics.exposure > LONGEST * interval and optics.exposure * _median(quick[fast]) > STRETCHED * optics.radius
    )
    optics = optics._replace(exposure=min(optics.exposure, interval))
    slow = [(patch, at, speed) for (patch, _at, speed), at in zip(good, places, strict=True)]
    slow.sort(key=lambda one: float(np.hypot(*one[2])))
    optics = optics._replace(shift=_colour_shift(slow[:5], optics))
    last = [fit_outline(patch, one.place, speed, optics, free="xyr", coarse=False) for patch, one, speed in first]
    radii, share = np.array([one.radius for one in last]), float(np.median([one.share for one in last]))
    optics = optics._replace(radius=float(np.median(radii)))
    if optics.exposure * quick.max() < optics.radius:
        optics = optics._replace(share=share)
    return Candidate(
        path, optics, share, float(np.median([one.seen for one in last])),
        float(1.4826 * np.median(np.abs(radii / np.median(radii) - 1))),
        np.array([[patch.frame, radius] for (patch, *_rest), radius in zip(some, radii, strict=True)]), stretched,
        np.median([one.place - (blob.x, blob.y) for one, (_patch, blob, _speed) in zip(last, some, strict=True)], axis=0),
    )  # fmt: skip


def _fall(path: Path, interval: float) -> Array:
    """Return the usual acceleration (2,) of a path, px/s²: in three frames that follow one another."""
    near = np.subtract(path.frames[2:], path.frames[:-2]) == 2
    bend = np.diff(path.places, 2, axis=0)[near] / interval**2
    return np.median(bend, axis=0) if len(bend) >= LEAST_FRAMES else np.zeros(2)


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
    seeds = _dense(ball.path, count, times) + ball.offset
    found: dict[int, tuple[Outline, Array, Array]] = {}
    radii = _radius_of_frames(ball, count)
    # (a centre so near the edge that part of the outline is beyond it)
    low, high = 0.8 * ball.optics.radius, np.array([film.width, film.height]) - 1 - 0.8 * ball.optics.radius
    border = np.asarray(((seeds > low) & (seeds < high)).all(axis=1))
    windows = _windows(ball.path, seeds, times, radii, ball.optics.exposure)
    wanted = {k: [(k, *one)] for k, one in windows.items() if border[k]}
    chunk: list[Patch] = []
    held = 0.0

    def finish() -> None:
        found.update(_fit_chunk(chunk, ball.optics, radii, times, seeds))
        chunk.clear()

    for _key, patch in patches(film, ground.planes, wanted):
        chunk.append(patch)
        held += sum(one.nbytes for one in patch.planes)
        if held > MOST_BYTES:
            finish()
            held = 0.0
        tell(patch.frame)
    finish()
    places, costs = np.full((count, 2), np.nan), np.full(count, np.nan)
    shapes, looks = np.full((count, 5), np.nan), np.full((count, 4), np.nan)
    for k, (one, shapes[k], looks[k, :3]) in found.items():
        places[k], costs[k], looks[k, 3] = one.place, one.cost, one.share
    costs[_strange(times, places, costs, radii, shapes, looks)] = np.inf
    return places, costs


def _strange(times: Array, places: Array, costs: Array, radii: Array, shapes: Array, looks: Array) -> Mask:
    """Return the frames (F,) whose outline is of something else: of another shape or look than usual, or off the way."""
    strange = _astray(times, places, costs)
    if np.isfinite(looks).any():
        # (a shadow that touches the ball is part of its usual shape)
        other = np.abs(shapes - np.nanmedian(shapes, axis=0)).max(axis=1) > OTHER_SHAPE[0] * radii + OTHER_SHAPE[1]
        strange |= other | (np.abs(shapes).max(axis=1) > NO_DISC * radii)
        away = np.abs(looks - (usual := np.nanmedian(looks, axis=0)))
        least = np.array([OTHER_LIGHT[0] * usual[0] + OTHER_LIGHT[1], OTHER_COLOUR, OTHER_COLOUR, OTHER_SHARE])
        limit = np.maximum(least, OTHER_SCATTER * np.nanmedian(away, axis=0))
        away[looks[:, 3] > usual[3], 3] = 0.0
        strange |= (away > limit).any(axis=1)
    # (what fits among frames that mostly do not, fits by chance)
    sought = np.isfinite(places[:, 0])
    doubt = np.convolve(sought & (strange | ~(costs < FLAGGED * _median(costs))), np.ones(9), "same")
    return strange | (doubt > np.convolve(sought, np.ones(9), "same") / 2)


def _median(values: Array) -> float:
    """Return the median of the finite values; 0 without any."""
    return float(np.median(values[np.isfinite(values)])) if np.isfinite(values).any() else 0.0


def _astray(times: Array, places: Array, costs: Array) -> Mask:
    """Return whether each place (F,) is farther than usual from where the frames beside it have the ball.

    Of the parabolas before and after it, and a cubic through both, the one that is nearest.
    """
    off, rows = np.full(len(times), np.nan), np.flatnonzero(np.isfinite(places[:, 0]) & np.isfinite(costs))
    for k in rows.tolist():
        before, after = scales.beside(k, rows)
        if min(len(before), len(after)) < 3:
            continue
        away = []
        for near, order in ((before, 3), (after, 3), (np.concatenate([before, after]), 4)):
            weights = np.linalg.pinv(np.vander(times[near] - times[k], order))[-1]
            away.append(float(np.hypot(*(weights @ places[near] - places[k]))) / np.sqrt(1 + weights @ weights))
        off[k] = min(away)
    return np.asarray(off > max(ASTRAY[0] * _median(off), ASTRAY[1]))


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
    chunk: Sequence[Patch], optics: Optics, radii: Array, times: Array, seeds: Array
) -> dict[int, tuple[Outline, Array, Array]]:  # fmt: skip
    """Fit the outlines in some frames, with shapes and colours.

    In rounds: with the way of the blobs, of the places found, and, where bad, from beside.
    """
    by_frame = {patch.frame: patch for patch in chunk}
    found: dict[int, Outline] = {}
    places, costs = np.full(seeds.shape, np.nan), np.full(len(times), np.nan)

    def keep(k: int, outline: Outline) -> None:
        found[k], places[k], costs[k] = outline, outline.place, outline.cost

    speed = np.nan_to_num(velocities(times, seeds)[0])
    for k, patch in by_frame.items():
        keep(k, fit_outline(patch, seeds[k], speed[k], optics._replace(radius=radii[k])))
    for turn in range(3):
        both, before, after = velocities(times, places)
        usual, astray = _median(costs) or 1.0, _astray(times, places, costs)
        for k, patch in by_frame.items():
            choices = [one[k] for one in (both, before, after) if np.isfinite(one[k]).all()]
            bad = costs[k] > FLAGGED / 2 * usual or astray[k]
            turns = len(choices) == 3 and float(np.hypot(*(choices[1] - choices[2]))) * optics.exposure > 1.0
            moved = len(choices) > 0 and float(np.hypot(*(choices[0] - speed[k]))) * optics.exposure > 0.7
            if not (bad or (turns and turn == 0) or (moved and turn < 2)):
                continue
            if not turns:
                choices = choices[:1]
            starts = [(places[k], one) for one in [*choices, *([np.zeros(2)] if turns else [])]]
            good = np.flatnonzero((costs <= FLAGGED / 2 * usual) & np.isfinite(places[:, 0]) & ~astray)
            near = [(one[2], one[1]) for one in scales.sides(k, good, times, places)] if bad else []
            at = optics._replace(radius=radii[k])
            if near:
                starts.append((places[k], speed[k]))
            same = (places[k], speed[k] * at.exposure) if len(starts) + len(near) > 1 else None
            tried = [fit_outline(patch, *one, at, coarse=bad, like=same) for one in starts]
            tried += [fit_outline(patch, *one, at, coarse=False, like=same) for one in near]
            best = min(range(len(tried)), key=lambda i: tried[i].cost)
            if near or not np.isfinite(costs[k]) or tried[best].cost < costs[k] or not bad:
                speed[k] = (starts + near)[best][1]
                keep(k, fit_outline(patch, tried[best].place, speed[k], at, coarse=False) if same else tried[best])
    return {
        k: (one, *look_closer(by_frame[k], one, speed[k], optics._replace(radius=radii[k])))
        for k, one in found.items() if np.isfinite(one.cost)
    }  # fmt: skip


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
    corners: str | None = None,
    picture_height: float | None = None,
    marks: bool = False,
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
    corners : str, optional
        Corners of a table, px, one after the other, its sides and the corners' height above the cloth:
        x1,y1,x2,y2,x3,y3,x4,y4=2.84mx1.42m@37mm, the first side from the first corner to the second; needs ``radius``.
    picture_height : float, optional
        Height of the picture in the scene, m; with ``readout``, for files of other programs.
    marks : bool
        Measure the spin from marks on the ball.
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
    if picture_height is not None:
        expected = "none for a film, whose picture is known: it is for files of other programs"
        raise CaromError(Fault("track_film", "`picture_height`", expected, f"{picture_height!r:.40}"))
    asked = scales.check_arguments(
        balls, radius, scale, length, readout, rate, ball, colour, region, corners, start, end
    )  # fmt: skip

    def tell(done: float, text: str) -> None:
        if progress is not None:
            progress(done, 1.0, text)

    file, ground, stamps, paths, moves = _linked(as_path("track_film", path), (start, end), readout, asked, tell)
    notes = list(file.notes)
    if moves:
        advice = "put it on a stand, or name a part in which it rests (`start`, `end`)"
        raise CaromError(Fault(f"{file.path}", "", "a camera at rest, without cuts", moves, advice))
    times = film_times(file, stamps, rate, notes)
    with noting(notes):
        chosen = _chosen(file, ground, paths, times, asked, balls)
    if readout is None:
        chosen = _by_rows(file, ground, chosen, times)[0]
    notes += _outline_notes(chosen, times)
    names = ["ball"] if balls == 1 else [f"ball {k + 1}" for k in range(balls)]
    places, costs = {}, {}
    for k, (name, one) in enumerate(zip(names, chosen, strict=True)):
        said = functools.partial(lambda k, done: tell(0.3 + 0.7 * (k + done / len(times)) / balls, "outlines"), k)
        places[name], costs[name] = _followed(file, ground, one, times, said)
        costs[name] /= max(_median(costs[name]), 1e-9)
    lags: list[tuple[float, float]] = []
    if readout is None:
        chosen, lags = _by_rows(file, ground, chosen, times, list(places.values()), list(costs.values()))
    optics = max(chosen, key=lambda one: len(one.path.frames)).optics
    found = _record(
        file, ground, times, places, costs, optics, (scale, length, radius, readout, gravity), asked, lags, notes
    )
    return with_spins(found) if marks else found


class SeveralBallsError(CaromError):
    """Raised where other things in a film are as likely to be the ball."""


def likeliest_ball(path: FilePath, error: CaromError, **given: Any) -> FilmPath:
    """Follow what is most likely a ball in a film that is refused: to be judged, not to be measured.

    ``given``: ``rate``, ``start``, ``end``, ``region`` of :func:`track_film`. Raises ``error`` where nothing moves that may be a
    ball, for cuts, and where several are as likely.
    """
    start, end, region, rate = (given.get(name) for name in ("start", "end", "region", "rate"))
    asked = scales.check_arguments(1, None, None, None, None, rate, (), None, region, None, start, end)
    file, ground, stamps, paths, moves = _linked(path, (start, end), None, asked, lambda _done, _text: None)
    # (of several balls none is judged: they meet one another)
    if (moves and not moves.startswith(MOVING)) or isinstance(error, SeveralBallsError):
        raise error
    times = film_times(file, stamps, rate, [])
    found = _usual_optics(file, ground, things.likely_paths(paths, LEAST_FRAMES)[:5], times)
    if not found:
        raise error
    ball = max(found, key=lambda one: one.score)
    outlines = np.full((len(times), 3), np.nan)
    for k, blob in zip(ball.path.frames, ball.path.blobs, strict=True):
        if blob.fill > ELLIPSE and not blob.cut:
            outlines[k] = blob.radius, *blob.stretch
    places = _dense(ball.path, len(times), times)
    if not moves:
        places = _followed(file, ground, ball, times, lambda _done: None)[0]
    corner = ((file.width - 1) / 2, (file.height - 1) / 2)
    return FilmPath(times, places, ball.optics.radius, ball.seen, outlines, corner, moves)


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
        quick = np.hypot(*speeds[n][rows].T)
        fast = rows[quick > SLOW * quick.max(initial=0.0)]
        rows = fast if len(fast) >= FEW else np.sort(rows[np.argsort(-quick)[:FEW]])
        some = np.linspace(0, len(rows) - 1, MANY if places else FEW).astype(int)
        for k in np.unique(rows[some]).tolist() if len(rows) else ():
            half = 1.7 * ball.optics.radius + float(np.abs(speeds[n][k]).max()) * ball.optics.exposure / 2 + 8
            wanted.setdefault(k, []).append((n, place[k], half))
    frames: list[list[tuple[Patch, Array, Array]]] = [[] for _ in balls]
    for n, patch in patches(file, ground.planes, wanted):
        place, speed = known[n][patch.frame], speeds[n][patch.frame]
        at = place if places else fit_outline(patch, place, speed, balls[n].optics).place
        frames[n].append((patch, at, speed))
    found, lags = [], []
    size = file.width if file.rotation % 2 else file.height
    for ball, its in zip(balls, frames, strict=True):
        if len(its) < LEAST_FRAMES:
            found.append(ball)
            continue
        optics, errors, _places = fit_optics(its, ball.optics, "rseqbcd")
        value, error = optics.lag * size, 1e-6 * float(errors[3]) * size
        # (rows read sideways only show as a slant, which light and blur make, too)
        times_error = LAG_ERROR[file.rotation % 2]
        # (marks and the ground behind are alike in frame after frame: the frames' scatter does not show what they do)
        spread = float(np.std([speed @ optics.rows for *_rest, speed in its]))
        common = RIM_ERROR * size / max(optics.radius * spread, 1e-9)
        lags.append((value, float(np.linalg.norm([times_error * error, LAG_SHARE * value, common]))))
        seen = ball.optics._replace(lag=optics.lag if value > 3 * error else 0.0)
        exposure = fit_optics(its, seen, "rse", steps=4)[0].exposure
        found.append(ball._replace(optics=seen._replace(exposure=min(exposure, float(np.median(np.diff(times)))))))
    return found, lags


def _linked(
    path: FilePath, part: tuple[float | None, float | None], readout: float | None, asked: Asked,
    tell: Callable[[float, str], None],
) -> tuple[FilmFile, Background, list[float], list[Path], str]:  # fmt: skip
    """Return a film, its background, the stamps of all frames, the paths of what moves in part of it, and what speaks against a
    camera at rest. Raises CaromError for what is no film, and for a part with few frames."""
    file = open_film(path)
    low, high = file.start + (part[0] or 0.0), np.inf if part[1] is None else file.start + part[1]
    tell(0.0, "background")
    samples = things.sampled(file, (low, high))
    if len(samples) < LEAST_FRAMES:
        raise CaromError(Fault(f"{file.path}", "", f"{LEAST_FRAMES} frames or more", f"{len(samples)}"))
    size = file.width if file.rotation % 2 else file.height
    ground = things.find_background(samples)._replace(rows=rows_direction(file.rotation), lag=(readout or 0.0) / size)
    del samples
    inside = None
    if asked.region is not None:
        inside = np.zeros(ground.half.shape, bool)
        x0, y0, x1, y1 = (int(one / 2) for one in asked.region)
        inside[y0 : y1 + 1, x0 : x1 + 1] = True
    linker, stamps, shares, shifts = things.Linker(), list[float](), list[float](), list[Array]()
    for frame in file.frames():
        stamps.append(frame.stamp)
        if low <= frame.stamp <= high or not np.isfinite(frame.stamp):
            halves = things.half_size(frame.y), frame.u, frame.v
            regions, share = things.find_regions(halves, ground, inside)
            shift, same = things.movement(halves[0], ground)
            linker.add(frame.number, regions if same > SAME else [])
            shares.append(share if same > SAME else 1.0)
            shifts.append(shift)
        tell(0.05 + 0.25 * (1 - 100 / (100 + frame.number)), "what moves")
    return file, ground, stamps, linker.paths, _unsteady(np.array(shares), np.array(shifts))


def _unsteady(shares: Array, shifts: Array) -> str:
    """Return what speaks against a camera at rest: the shares of frames that change, the shifts (F, n, 2) of their tiles, px."""
    whole, other = float((shares > things.CHANGED).mean()), np.flatnonzero(shares > 0.99)
    if len(other) > MOST_CUT * len(shares):
        return f"another picture in {counted(len(other), 'frame')} from frame {other[0]} on"
    if whole > 0.5:
        return f"a picture that changes as a whole in {100 * whole:.0f} % of the frames"
    if shifts.shape[1] >= things.LEAST_TILES:
        way = np.hypot(*(shifts - np.median(shifts, axis=0)).transpose(2, 0, 1))
        usual = float(np.quantile(np.quantile(way, 0.8, axis=0), 0.3))
        if usual > MOST_SHIFT:
            return f"{MOVING} {usual:.2g} px and more"
    return ""


def _chosen(
    file: FilmFile, ground: Background, paths: Sequence[Path], times: Array, asked: Asked, balls: int
) -> list[Candidate]:
    """Return the candidates that are balls. Raises CaromError where they are not, or others are as likely."""
    refused, some = functools.partial(Fault, f"{file.path}"), counted(balls, "ball")
    likely = things.likely_paths(paths, LEAST_FRAMES)
    if asked.colour is not None:
        tones = [file.matrix @ [*np.median([blob.colour for blob in one.blobs], axis=0), 1.0] for one in likely]
        likely = [one for one, tone in zip(likely, tones, strict=True) if np.abs(tone - asked.colour).max() < 70]
    if asked.seeds:
        named = [joined(_nearest(f"{file.path}", paths, times, seed), likely) for seed in asked.seeds]
        _keep(file, ground, named, times)
        found = _usual_optics(file, ground, named, times)
        if len(found) < balls:
            advice = "name a frame in which it is seen alone"
            raise CaromError(refused("`ball`", f"outlines of {some}", f"{len(found)}", advice))
        return found
    _keep(file, ground, likely, times)
    found = _usual_optics(file, ground, likely[: balls + 4], times)
    apart: list[Candidate] = []
    for one in sorted((one for one in found if one.is_ball), key=lambda one: -one.score):
        # (what goes on under another name, never at the same time, is the same ball)
        if all(joined(other.path, [one.path]).frames == other.path.frames for other in apart):
            apart.append(one)
    if len(apart) < balls:
        wanted = f"{counted(balls, 'round thing')} that move{'s' if balls == 1 else ''}"
        advice = "is the ball as bright as the ground, or too small? `ball` x,y@t names it"
        raise CaromError(refused("", wanted, _what_moves(found, likely, times, len(apart)), advice))
    count = sum(one.score > LIKE * apart[balls - 1].score for one in apart[balls:]) + balls
    if count > balls:
        got = f"{count} that are as likely: {'; '.join(_said(one, times) for one in apart[: min(count, 4)])}"
        advice = f"carom track `balls` {count} tracks all, `ball` x,y@t names one"
        raise SeveralBallsError(refused("", some, got, advice))
    rest = [path for path in likely if not any(path is one.path for one in apart[:balls])]
    kept = [one._replace(path=joined(one.path, rest)) for one in apart[:balls]]
    return sorted(kept, key=lambda one: (one.path.frames[0], one.path.blobs[0].x)) if balls > 1 else kept


def _nearest(where: str, paths: Sequence[Path], times: Array, seed: tuple[float, ...]) -> Path:
    """Return the path that passes nearest to a place (px) at a time."""
    x, y, t = seed
    frame = int(np.argmin(np.abs(times - t)))
    near: list[tuple[float, int, Path, Blob]] = []
    for n, path in enumerate(paths):
        k = int(np.argmin(np.abs(np.array(path.frames) - frame)))
        if abs(path.frames[k] - frame) <= 2:
            near.append((float(np.hypot(path.blobs[k].x - x, path.blobs[k].y - y)), n, path, path.blobs[k]))
    got = "nothing"
    if near:
        off, _n, path, blob = min(near)
        if off <= 2 * blob.radius + 5 and len(path.frames) >= LEAST_FRAMES:
            return path
        got = f"at ({blob.x:.0f}, {blob.y:.0f}) the nearest, in {counted(len(path.frames), 'frame')}"
    raise CaromError(Fault(where, "`ball`", f"something that moves near ({x:g}, {y:g}) at {t:g} s", got))


def _said(one: Candidate, times: Array) -> str:
    k = len(one.path.frames) // 2
    place = f"{one.path.blobs[k].x:.0f},{one.path.blobs[k].y:.0f}@{times[one.path.frames[k]]:.3g}"
    return f"r = {one.optics.radius:.3g} px in {counted(len(one.path.frames), 'frame')}, {place}"


def _what_moves(found: Sequence[Candidate], likely: Sequence[Path], times: Array, count: int) -> str:
    lacking = [one for one in found if not one.is_ball]
    some = f"{count}, and " if count else ""
    if not lacking:
        return f"{some}{'nothing that keeps its size' if not likely else 'nothing with an outline'}"
    best = max(lacking, key=lambda one: one.share * one.seen)
    if best.stretched:
        return f"{some}at best {_said(best, times)}, which is longer than it moves from frame to frame"
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
        if np.median([blob.radius for blob in one.path.blobs]) < WHOLE_WIDTH * one.optics.radius:
            notes.append("a part of the ball looks like what is behind it: its radius is known far worse than to 2 %")
    one = max(chosen, key=lambda one: len(one.path.frames))
    if one.optics.exposure > LONG_EXPOSURE * interval:
        speed = velocities(times, _dense(one.path, len(times), times))[0]
        blur = float(np.nanmax(np.hypot(*speed.T))) * one.optics.exposure
        notes.append(
            f"exposure of {1e3 * one.optics.exposure:.3g} ms of {1e3 * interval:.3g} ms from frame to frame: a blur of up to"
            f" {blur:.0f} px; frames whose exposure holds a contact, or is beside it, are left out. 1/500 s would give more"
        )
    return notes


def _record(
    file: FilmFile, ground: Background, times: Array, places: dict[str, Array], costs: dict[str, Array], optics: Optics,
    given: tuple[float | str | None, str | None, float | None, float | None, float], asked: Asked,
    lags: Sequence[tuple[float, float]], notes: list[str],
) -> TrackedFilm:  # fmt: skip
    """Return the record: flagged frames, frames with contacts in them, the readout, the scale and the tracks."""
    scale, length, radius, row_time, gravity = given
    size = (file.width, file.height)
    table = TableView.seen(asked.corners, size, radius) if asked.corners and radius else None
    flags = {name: costs[name] > FLAGGED for name in places}
    used, speed = {}, {}
    held = 0
    for name, place in places.items():
        good = np.isfinite(place[:, 0]) & ~flags[name]
        within = scales.contacts_within(times, np.where(good[:, None], place, np.nan), optics.exposure)
        held += int((within & good).sum())
        used[name] = good & ~within
        speed[name] = velocities(times, place)[0]
        seen = int(np.isfinite(place[:, 0]).sum())
        if good.sum() < max(LEAST_FRAMES, LEAST_GOOD * seen):
            got = f"the outline of {name} fits in {int(good.sum())} of {counted(seen, 'frame')} in which it was looked for"
            advice = "is it a ball, alone and in front of something else? `start`, `end`, `region`, `ball` choose another part"
            raise CaromError(Fault(f"{file.path}", "", "a ball that looks the same in most frames", got, advice))
    flagged = np.any(list(flags.values()), axis=0)
    if flagged.any():
        notes.append(
            f"in {counted(int(flagged.sum()), 'frame')} the outline does not fit (a shadow, another thing beside the ball): left"
            f" out, at t = {', '.join(f'{t:.4g}' for t in times[flagged][:8])}{' ...' if flagged.sum() > 8 else ''} s"
        )
    if held:
        notes.append(f"{counted(held, 'frame')} whose exposure holds a contact, or is beside it, left out")
    noise = max(position_noise(times[good], place[good], float(np.median(np.diff(times)))) for place, good in
                ((places[name], used[name]) for name in places))  # fmt: skip
    if noise > UNSTEADY * optics.radius:
        notes.append(
            f"outlines scatter by {noise:.2g} px about a smooth path: a part of the rim is not seen, or it is no ball; look at the"
            " sheet"
        )
    readout, error = row_time or 0.0, 0.0
    phases = {name: np.nan_to_num(scales.row_phase(place, size, file.rotation)) for name, place in places.items()}
    if row_time is None:
        # (speeds of rows, not of stamps: as they are read by what was found)
        for _ in range(3):
            balls = [(times + readout * phases[name], place, used[name]) for name, place in places.items()]
            free = fit_falls(balls, size, file.rotation, free=True)
            readout += 0.0 if free is None else free.readout
        if free is not None and free.rises and free.rms < scales.MOST_MISFIT:
            lags = [*lags, (readout, free.readout_error)]
        readout, error = scales.choose_readout(lags, notes)
    balls = [(times + readout * phases[name], place, used[name]) for name, place in places.items()]
    falls = fit_falls(balls, size, file.rotation, free=False)
    value = scales.choose_scale(
        optics.radius, falls, scale=scale, length=length, radius=radius, gravity=gravity, table=table, notes=notes
    )  # fmt: skip
    tracks = []
    for name, place in places.items():
        rows = np.flatnonzero(used[name])
        t = times[rows] + readout * phases[name][rows]
        up = table(place[rows]) if table else value * (place[rows] * (1, -1) + (0, file.height - 1))
        shared = error * phases[name][rows]
        tracks.append(Track(name, t, up, frame=rows.astype(float), stamped=True, sigma_time=shared))
    cost = functools.reduce(np.fmax, costs.values())
    y, u, v = ground.planes
    return TrackedFilm(
        file.path, times, places, optics.radius, cost, flagged, optics.exposure, optics.psf, file.to_rgb(y, u, v), speed,
        tuple(notes), used, tuple(tracks), value, readout, error,
    )  # fmt: skip
