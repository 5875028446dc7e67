"""What moves in a film: the background, what differs from it in each frame (blobs), and the blobs of one ball in all frames."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from carom.tracks.video.reading import Array, Bytes, FilmFile, Frame

Mask = NDArray[np.bool_]
SAMPLES, MOST_SAMPLE_BYTES = 32, 250e6  # frames of the background
MANY_KEYS = 24  # frames stored whole, from which the background is taken from these alone
LEAST_LEVELS = (7.0, 4.0, 4.0)  # by which a pixel of a plane differs from the background, at least
NOISES = 5.0  # times its own noise that it differs, at least
LEAST_AREA = 12  # px at half the size
MOST_BLOBS = 24  # of a frame, the largest
CHANGED = 0.2  # share of a picture that changes where the camera moves
GHOST = 0.75  # of the gradient along a region's edge: what was seen at another time is the background
LOST = 6  # frames after which a ball is no longer followed
REACH = 6.0  # radii that a ball moves at most between its first two frames
ALIKE = 0.35  # by which radii of blobs of one ball differ, in a frame and the next (as a logarithm)
COLOUR = 35.0  # levels
CORE = 0.2, 0.9  # of a blob: what is no shadow
SHADE = 0.45  # of the background's brightness: what is darker is no mere shadow


class Background(NamedTuple):
    """The picture without what moves, and from which difference on a pixel is part of something else."""

    planes: tuple[Bytes, Bytes, Bytes]
    """y (H, W); u, v (H / 2, W / 2)."""
    half: Bytes
    """y at half the size."""
    limits: tuple[Bytes, Bytes, Bytes]
    """Of y, u, v at half the size, levels."""
    noise: tuple[float, float, float]


class Blob(NamedTuple):
    """A region of a frame that differs from the background."""

    x: float
    """px of the whole picture."""
    y: float
    area: float
    major: float
    """Standard deviations along the axes, px."""
    minor: float
    colour: tuple[float, float, float]
    """Mean of y, u, v."""
    cut: bool
    """Whether it reaches the edge of the picture."""
    core: tuple[float, float, float] | None = None
    """x, y and radius, px, of the part that differs by more than a shadow does, if the rest is as a shadow."""
    shade: float = 0.0
    """Brightness over that of the background, of a blob that differs as a shadow does; 0 of others."""

    @property
    def radius(self) -> float:
        """Of a disc that is swept along its major axis, px."""
        return 2 * self.minor

    @property
    def blur(self) -> float:
        """Length of that way, px."""
        return float(np.sqrt(max(3 * (self.major**2 - self.minor**2), 0.0)))

    @property
    def fill(self) -> float:
        """Area over that of the ellipse of the same moments."""
        return self.area / (4 * np.pi * self.major * self.minor)


@dataclass
class Path:
    """Blobs of one thing, frame after frame."""

    frames: list[int] = field(default_factory=list)
    blobs: list[Blob] = field(default_factory=list)

    @property
    def places(self) -> Array:
        """(n, 2) px."""
        return np.array([[one.x, one.y] for one in self.blobs])

    @property
    def colour(self) -> Array:
        """(3,) y, u, v: of the last nine blobs, so that one blob of two balls that touch does not change it."""
        return np.asarray(np.median([one.colour for one in self.blobs[-9:]], axis=0))

    @property
    def radius(self) -> float:
        """Median, px, of blobs that are whole."""
        return float(np.median([one.radius for one in self.blobs if not one.cut] or [one.radius for one in self.blobs]))


def half_size(plane: Bytes) -> Bytes:
    """Return a plane (H, W) at half the size: means of four pixels."""
    wide = plane[0::2, 0::2].astype(np.uint16)
    for one in (plane[0::2, 1::2], plane[1::2, 0::2], plane[1::2, 1::2]):
        wide += one
    return ((wide + 2) >> 2).astype(np.uint8)


def sampled(film: FilmFile, keep: tuple[float, float]) -> list[tuple[Bytes, Bytes, Bytes]]:
    """Return the planes of some 16 to 32 frames, spread over the part of the film between two stamps, s."""
    most = int(np.clip(MOST_SAMPLE_BYTES / (1.5 * film.width * film.height), 8, SAMPLES))
    for keys in (True, False):
        kept: list[tuple[Bytes, Bytes, Bytes]] = []
        stride, count = 1, 0
        for frame in film.frames(keys=keys):
            if frame.stamp < keep[0] or frame.stamp > keep[1]:
                continue
            if count % stride == 0:
                kept.append((frame.y.copy(), frame.u.copy(), frame.v.copy()))
            count += 1
            if len(kept) >= 2 * most or (
                len(kept) > most and stride > 1 and count % stride == 0 and len(kept) > 2 * most
            ):
                kept, stride = kept[::2], 2 * stride
        if len(kept) >= MANY_KEYS or not keys:
            return kept[:: -(-len(kept) // most)] if len(kept) > most else kept
    raise AssertionError


def find_background(samples: Sequence[tuple[Bytes, Bytes, Bytes]]) -> Background:
    """Return the median of samples; regions of balls that rest for much of the film are replaced by what is seen without them."""
    stacks = [np.stack([one[k] for one in samples]) for k in range(3)]
    planes = [_median(stack) for stack in stacks]
    half = half_size(planes[0])
    deviation = []
    for k, stack in enumerate(stacks):
        some = stack if k else np.stack([half_size(one) for one in stack])
        deviation.append(_median(_differ(some, half if k == 0 else planes[k])))
    noise = [max(1.4826 * float(np.mean(one)), 0.3) for one in deviation]
    limits = [
        np.clip(np.maximum(least, NOISES * 1.4826 * _widened(one).astype(float) + 2), 0, 250).astype(np.uint8)
        for least, one in zip(LEAST_LEVELS, deviation, strict=True)
    ]
    quarter = max(len(samples) // 4, 1)
    for part in (slice(0, quarter), slice(len(samples) - quarter, None)) if len(samples) >= 8 else ():
        other = [_median(stack[part]) for stack in stacks]
        _without_ghosts(planes, other, limits)
    y, u, v = planes
    return Background((y, u, v), half_size(y), (limits[0], limits[1], limits[2]), (noise[0], noise[1], noise[2]))


def _median(stack: Bytes) -> Bytes:
    found = np.empty(stack.shape[1:], np.uint8)
    for low in range(0, len(found), 64):
        rows = stack[:, low : low + 64]
        found[low : low + 64] = np.partition(rows, len(rows) // 2, axis=0)[len(rows) // 2]
    return found


def _differ(one: Bytes, other: Bytes) -> Bytes:
    return np.asarray(np.maximum(one, other) - np.minimum(one, other))


def _widened(plane: Bytes) -> Bytes:
    from scipy.ndimage import maximum_filter

    return np.asarray(maximum_filter(plane, 3))


def _without_ghosts(planes: list[Bytes], other: list[Bytes], limits: Sequence[Bytes]) -> None:
    """Put into the background what was seen at another time, in regions that fit their surroundings better so."""
    from scipy.ndimage import binary_dilation, binary_erosion, find_objects, label

    halves = [[half_size(one[0]), one[1], one[2]] for one in (planes, other)]
    changed = np.zeros(halves[0][0].shape, bool)
    for one, two, limit in zip(*halves, limits, strict=True):
        changed |= _differ(one, two) > limit
    labels, _count = label(binary_dilation(changed, iterations=2))
    for k, box in enumerate(find_objects(labels)[:200], 1):
        wide = tuple(slice(max(one.start - 4, 0), one.stop + 4) for one in box)
        region = labels[wide] == k
        if region.sum() < LEAST_AREA:
            continue
        edge = binary_dilation(region, iterations=2) & ~binary_erosion(region, iterations=4)
        now, then = (
            sum(float(np.abs(np.array(np.gradient(one[wide].astype(float)))).sum(axis=0)[edge].mean()) for one in kind)
            for kind in halves
        )
        if then < GHOST * now:
            for plane, instead in zip(planes[1:], other[1:], strict=True):
                plane[wide][region] = instead[wide][region]
            whole = np.repeat(np.repeat(region, 2, axis=0), 2, axis=1)
            large = tuple(slice(2 * one.start, 2 * one.start + n) for one, n in zip(wide, whole.shape, strict=True))
            planes[0][large][whole] = other[0][large][whole]


def find_blobs(frame: Frame, ground: Background, inside: Mask | None = None) -> tuple[list[Blob], float]:
    """Return the regions of a frame that differ from the background, the largest first, and the share of it that does."""
    from scipy.ndimage import binary_fill_holes, find_objects, label

    halves = (half_size(frame.y), frame.u, frame.v)
    changed, shade = np.zeros(halves[0].shape, bool), np.zeros(halves[0].shape, bool)
    for k, (one, still, limit) in enumerate(zip(halves, (ground.half, *ground.planes[1:]), ground.limits, strict=True)):
        # (the exposure of a camera drifts: the median difference is none)
        drift = int(np.median(one[::8, ::8].astype(np.int16) - still[::8, ::8]))
        level = np.clip(still.astype(np.int16) + drift, 0, 255).astype(np.uint8) if drift else still
        differs = _differ(one, level) > limit
        changed |= differs
        shade = differs & (one < level) if k == 0 else shade & ~differs
    share = float(changed.mean())
    if inside is not None:
        changed &= inside
    if share > 2 * CHANGED:
        return [], share
    opened = _opened(~_opened(~changed))  # (parts of a ball that are like the ground are bridged; specks go)
    rows, columns = np.flatnonzero(opened.any(axis=1)), np.flatnonzero(opened.any(axis=0))
    if not len(rows):
        return [], share
    low = rows[0], columns[0]
    labels, _count = label(opened[low[0] : rows[-1] + 1, low[1] : columns[-1] + 1], np.ones((3, 3)))
    sizes = np.bincount(labels.ravel())
    boxes = find_objects(labels)
    order = [k for k in np.argsort(-sizes[1:])[:MOST_BLOBS] if sizes[k + 1] >= LEAST_AREA]
    return [
        _blob(boxes[k], binary_fill_holes(labels[boxes[k]] == k + 1), low, halves, shade, ground.half) for k in order
    ], share


def _opened(mask: Mask) -> Mask:
    """Return a mask without what is thinner than a cross of three pixels."""
    padded = np.pad(mask, 1)
    core = padded[1:-1, 1:-1] & padded[:-2, 1:-1] & padded[2:, 1:-1] & padded[1:-1, :-2] & padded[1:-1, 2:]
    padded = np.pad(core, 1)
    return np.asarray(padded[1:-1, 1:-1] | padded[:-2, 1:-1] | padded[2:, 1:-1] | padded[1:-1, :-2] | padded[1:-1, 2:])


def _blob(
    box: tuple[slice, slice], mask: Mask, low: tuple[int, int], halves: Sequence[Bytes], shade: Mask, still: Bytes
) -> Blob:
    top, left = box[0].start + low[0], box[1].start + low[1]
    y, x = np.nonzero(mask)
    here = (slice(top, top + mask.shape[0]), slice(left, left + mask.shape[1]))
    colour = [float(one[here][mask].mean()) for one in halves]
    moments = np.cov(np.stack([x, y])) if len(x) > 1 else np.eye(2)
    small, large = np.sqrt(np.maximum(np.linalg.eigvalsh(4 * moments), 0.1)).tolist()
    rest = _opened(mask & ~shade[here])
    core = None
    if CORE[0] < rest.sum() / len(x) < CORE[1]:
        down, across = np.nonzero(rest)
        core = (
            2 * (left + float(across.mean())) + 0.5,
            2 * (top + float(down.mean())) + 0.5,
            2 * float(np.sqrt(len(down) / np.pi)),
        )
    dark = colour[0] / max(float(still[here][mask].mean()), 1.0) if rest.sum() <= CORE[0] * len(x) else 0.0
    height, width = halves[0].shape
    cut = top <= 0 or left <= 0 or here[0].stop >= height or here[1].stop >= width
    return Blob(
        2 * (left + float(x.mean())) + 0.5, 2 * (top + float(y.mean())) + 0.5, 4.0 * len(x), large, small,
        (colour[0], colour[1], colour[2]), cut, core, dark,
    )  # fmt: skip


class Linker:
    """Links the blobs of one frame after the other to paths."""

    def __init__(self) -> None:
        self.paths: list[Path] = []
        self._live: list[Path] = []

    def add(self, number: int, blobs: Sequence[Blob]) -> None:
        """Take the blobs of the next frame."""
        self._live = [one for one in self._live if number - one.frames[-1] <= LOST]
        chances = []
        for i, path in enumerate(self._live):
            last, gap = path.blobs[-1], number - path.frames[-1]
            ahead = np.array([last.x, last.y])
            reach = REACH * last.radius * gap
            if len(path.frames) > 1:
                before, since = path.blobs[-2], path.frames[-1] - path.frames[-2]
                way = (ahead - [before.x, before.y]) / since * gap
                ahead = ahead + way
                # (a ball that turns back is where it was, or in between)
                reach = 2.2 * float(np.hypot(*way)) + 2.0 * last.radius
            for j, blob in enumerate(blobs):
                off = float(np.hypot(blob.x - ahead[0], blob.y - ahead[1]))
                size = abs(float(np.log(blob.radius / last.radius)))
                tone = float(np.abs(np.subtract(blob.colour, path.colour)).max())
                if off < reach and (size < ALIKE or blob.cut or last.cut) and tone < COLOUR:
                    chances.append((off / max(last.radius, 1.0) + 2 * size + tone / 20 + gap - 1, i, j))
        taken: set[int] = set()
        linked: set[int] = set()
        for _cost, i, j in sorted(chances):
            if i not in taken and j not in linked:
                taken.add(i)
                linked.add(j)
                self._live[i].frames.append(number)
                self._live[i].blobs.append(blobs[j])
        for j, blob in enumerate(blobs):
            if j not in linked:
                new = Path([number], [blob])
                self.paths.append(new)
                self._live.append(new)


def likely_paths(paths: Sequence[Path], least: int) -> list[Path]:
    """Return the paths that may be a ball's, the most likely first: things that move, keep their size, and are round."""
    found = []
    for path in paths:
        if len(path.frames) < least:
            continue
        whole = [one for one in path.blobs if not one.cut]
        if len(whole) < least / 2:
            continue
        extent = float(np.ptp(path.places, axis=0).max())
        spread = float(np.std([np.log(one.radius) for one in whole]))
        fill = float(np.median([one.fill for one in whole]))
        shadow = float(np.median([one.shade for one in whole])) > SHADE
        if shadow or extent < 1.5 * path.radius or path.radius < 2.0 or fill < 0.75:
            continue
        found.append(
            (len(path.frames) * fill**4 / (1 + (spread / 0.1) ** 2) * min(extent / path.radius / 6, 1.0), path)
        )
    return [path for _score, path in sorted(found, key=lambda one: -one[0])]


def joined(first: Path, others: Sequence[Path]) -> Path:
    """Return a path with what goes on or went before under another: paths of the same size and colour, at other times."""
    path = replace(first)
    tone = np.median([one.colour for one in first.blobs], axis=0)
    for other in others:
        apart = other.frames[0] > path.frames[-1] or other.frames[-1] < path.frames[0]
        far = np.abs(np.median([one.colour for one in other.blobs], axis=0) - tone).max()
        if other is not first and apart and abs(np.log(other.radius / first.radius)) < 0.2 and far < COLOUR / 2:
            order = np.argsort([*path.frames, *other.frames], kind="stable")
            frames, blobs = [*path.frames, *other.frames], [*path.blobs, *other.blobs]
            path = Path([frames[k] for k in order], [blobs[k] for k in order])
    return path


def cores_of(path: Path) -> Path | None:
    """Return a path of what is no shadow in its blobs; None where they have no such part."""
    some = [(k, one, one.core) for k, one in zip(path.frames, path.blobs, strict=True) if one.core is not None]
    if len(some) < max(len(path.frames) / 2, 5):
        return None
    blobs = [
        one._replace(x=core[0], y=core[1], minor=core[2] / 2, major=core[2] / 2, area=np.pi * core[2] ** 2, core=None)
        for _k, one, core in some
    ]
    return Path([k for k, _one, _core in some], blobs)
