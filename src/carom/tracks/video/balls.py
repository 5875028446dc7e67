"""What moves in a film: the background, what differs from it in each frame (blobs), and the blobs of one ball in all frames."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from statistics import median
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from carom.tracks.video.reading import Array, Bytes, FilmFile, Mask

SAMPLES, MOST_SAMPLE_BYTES = 32, 250e6  # frames of the background
MANY = 24  # frames, so many that the background is taken from these alone
LEAST_LEVELS = (7.0, 4.0, 4.0)  # by which a pixel of a plane differs from the background, at least
NOISES = 5.0  # times its own noise that it differs, at least
# Classes of texture; the share of a class that differs by less than the codec's error, and times that error
CODED = 6, 0.8, 3.5
LEAST_AREA = 12  # px at half the size
MOST_BLOBS = 24  # of a frame, the largest
CHANGED = 0.2  # share of a picture that changes where the camera moves
TILE, TILES, LEAST_TILES = 24, 5, 4  # px of a tile at half the size; tiles along each side, at most; in all, at least
STEEP, CONTRAST = 1.0, 1.6  # levels per px of a tile with enough texture, and its contrast, levels
PARTS = 6  # of the samples, whose medians are compared
GHOST = 0.8  # of the gradient along a region's edge: what was seen at another time is the background
LOST = 6  # frames after which a ball is no longer followed
REACH = 14.0  # radii that a ball moves at most between its first two frames
ALIKE = 0.35  # by which radii of blobs of one ball differ, in a frame and the next (as a logarithm)
COLOUR, TONE = 35.0, 10.0  # levels by which colours of one ball differ at most, and usually
TONES = (60.0, 15.0, 15.0)  # of y, u, v: of the pixels of one ball
BOTH = 0.75  # of the areas of two balls, of a region that holds both
UNSEEN, NEVER = (3.0, 8.0), 1e6  # what a path costs that goes on without a blob: of up to three frames, of more
BLACK, GREY = 16.0, 128.0  # levels
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
    texture: tuple[Bytes, Bytes, Bytes]
    """Class of each pixel, the smoothest 0, of y, u, v at half the size."""
    tiles: tuple[tuple[tuple[slice, slice], Array], ...] = ()
    """Where a frame of the film (not the median, which smears what moves) has texture, at half the size: slopes along x and y, and
    contrast (n, 3)."""
    rows: tuple[float, float] = (0.0, 1.0)
    """Direction in which the camera reads its rows."""
    lag: float = 0.0
    """From row to row, s per px."""


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
    stretch: tuple[float, float] = (np.nan, np.nan)
    """Variance along x less that along y, and twice the covariance, over the sum of both variances: by how much it is no disc."""

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

    def ahead(self, number: int) -> Array:
        """Return where it is in a later frame if it moves on as in the last two, (2,) px."""
        last = [np.array([one.x, one.y]) for one in self.blobs[-2:]]
        if len(last) < 2:
            return last[0]
        since = self.frames[-1] - self.frames[-2]
        return np.asarray(last[1] + (last[1] - last[0]) / since * (number - self.frames[-1]))

    @property
    def area(self) -> float:
        """px, median of the last nine blobs."""
        return median(one.area for one in self.blobs[-9:])

    @property
    def colour(self) -> Array:
        """(3,) y, u, v: of the last nine blobs, so that one blob of two balls that touch does not change it."""
        return np.array([median(one) for one in zip(*(blob.colour for blob in self.blobs[-9:]), strict=True)])

    @property
    def radius(self) -> float:
        """Median, px, of blobs that are whole."""
        return median([one.radius for one in self.blobs if not one.cut] or [one.radius for one in self.blobs])


def half_size(plane: Bytes) -> Bytes:
    """Return a plane (H, W) at half the size: means of four pixels."""
    pairs = np.ascontiguousarray(plane).view(np.uint16)
    upper, lower = ((one & 255) + (one >> 8) for one in (pairs[0::2], pairs[1::2]))
    return ((upper + lower + 2) >> 2).astype(np.uint8)


def sampled(film: FilmFile, keep: tuple[float, float]) -> list[tuple[Bytes, Bytes, Bytes]]:
    """Return the planes of some 16 to 32 frames, spread over the part of the film between two stamps, s."""
    most = int(np.clip(MOST_SAMPLE_BYTES / (1.5 * film.width * film.height), 8, SAMPLES))
    for skip in ("NONKEY", "DEFAULT"):
        kept: list[tuple[Bytes, Bytes, Bytes]] = []
        stride, count = 1, 0
        for frame in film.frames(skip):
            if frame.stamp < keep[0] or frame.stamp > keep[1]:
                continue
            if count % stride == 0:
                kept.append((frame.y.copy(), frame.u.copy(), frame.v.copy()))
            count += 1
            if len(kept) >= 2 * most:
                kept, stride = kept[::2], 2 * stride
        if len(kept) >= MANY:
            break
    return kept[:: max(-(-len(kept) // most), 1)]


def find_background(samples: Sequence[tuple[Bytes, Bytes, Bytes]]) -> Background:
    """Return the median of samples; regions of balls that rest for much of the film are replaced by what is seen without them."""
    stacks = [np.stack([one[k] for one in samples]) for k in range(3)]
    planes = [_median(stack) for stack in stacks]
    half, deviation = half_size(planes[0]), []
    medians = [half, planes[1].copy(), planes[2].copy()]
    for k, stack in enumerate(stacks):
        some = stack if k else np.stack([half_size(one) for one in stack])
        deviation.append(_median(_differ(some, half if k == 0 else planes[k])))
    noise = [max(1.4826 * float(np.mean(one)), 0.3) for one in deviation]
    # (a ball may rest somewhere for any part of the film: what each part shows is tried, and twice, as one may uncover another)
    parts = np.array_split(np.arange(len(samples)), min(PARTS, len(samples) // 3)) if len(samples) >= 8 else []
    others = [[_median(stack[part[0] : part[-1] + 1]) for stack in stacks] for part in parts]
    for other in [*others[::-1], *others]:
        _without_ghosts(planes, other, noise)
    limits = []
    for now, before, off, least in zip(
        (half_size(planes[0]), *planes[1:]), medians, deviation, LEAST_LEVELS, strict=True
    ):
        # (what a ball at rest made of the scatter is none)
        off[_widened(_differ(now, before), 7) > least] = np.median(off)
        level = np.maximum(least, NOISES * 1.4826 * _widened(off).astype(float) + 2)
        limits.append(np.clip(level, 0, 250).astype(np.uint8))
    y, u, v = planes
    half = half_size(y)
    return Background(
        (y, u, v), half, (limits[0], limits[1], limits[2]), (noise[0], noise[1], noise[2]),
        (_classes(half), _classes(u), _classes(v)), tuple(_tiles(half_size(samples[len(samples) // 2][0]))),
    )  # fmt: skip


def _tiles(half: Bytes) -> list[tuple[tuple[slice, slice], Array]]:
    """Return tiles with texture in both directions, spread over the picture."""
    found, plane = [], half.astype(float)
    slopes = np.stack([np.gradient(plane, axis=1), np.gradient(plane, axis=0)])
    rows, columns = (np.arange(0, size - TILE + 1, TILE) for size in half.shape)
    for some in np.array_split(rows, min(TILES, max(len(rows), 1))):
        for others in np.array_split(columns, min(TILES, max(len(columns), 1))):
            best: tuple[float, Any] = STEEP, None
            for y in some.tolist():
                for x in others.tolist():
                    window = slice(y, y + TILE), slice(x, x + TILE)
                    g = slopes[:, *window].reshape(2, -1)
                    steep = float(np.sqrt(np.linalg.eigvalsh(g @ g.T / g.shape[1])[0]))
                    best = max(best, (steep, window), key=lambda one: one[0])
            if best[1] is not None and plane[best[1]].std() > CONTRAST:
                texture = np.stack([*slopes[:, *best[1]].reshape(2, -1), plane[best[1]].ravel()], axis=1)
                found.append((best[1], texture - texture.mean(axis=0)))
    return found


def movement(half: Bytes, ground: Background) -> tuple[Array, float]:
    """Return by how much tiles of a frame at half the size are shifted against another frame, (n, 2) px of the whole picture, and
    the share of tiles that show the same; 1 where they are too few."""
    if not ground.tiles:
        return np.zeros((0, 2)), 1.0
    seen = np.stack([half[window].ravel() for window, _columns in ground.tiles]).astype(float)
    seen -= seen.mean(axis=1, keepdims=True)
    columns = np.stack([texture for _window, texture in ground.tiles])
    across = columns.transpose(0, 2, 1)
    known = np.linalg.solve(across @ columns + 1e-6 * np.eye(3), across @ seen[:, :, None])
    # (what the codec has smeared is no other picture)
    left = ((seen - (columns @ known)[:, :, 0]) ** 2).sum(axis=1)
    same = left < 0.5 * np.maximum((seen**2).sum(axis=1), (columns[:, :, 2] ** 2).sum(axis=1))
    shifts = -2 * known[:, :2, 0] / np.maximum(known[:, 2], 0.3)
    return shifts, float(np.mean(same)) if len(same) >= LEAST_TILES else 1.0


def _classes(plane: Bytes) -> Bytes:
    """Return to which of some equal classes of texture each pixel belongs."""
    from scipy.ndimage import minimum_filter

    steep = _widened(plane, 5) - minimum_filter(plane, 5)
    edges = np.quantile(steep[::3, ::3], np.arange(1, CODED[0]) / CODED[0])
    return np.asarray(np.searchsorted(np.unique(edges), np.arange(256)).astype(np.uint8)[steep])


def _coded(differ: Bytes, texture: Bytes) -> Bytes:
    """Return by which a pixel of each class (n,) differs where only the codec's error is seen, which is larger in texture."""
    some = (256 * texture[::3, ::3].astype(np.intp) + differ[::3, ::3]).ravel()
    counts = np.bincount(some, minlength=256 * CODED[0]).reshape(-1, 256).cumsum(axis=1)
    total = counts[:, -1:]
    found = CODED[2] * (counts <= (CODED[1] * total).astype(int)).sum(axis=1, where=total > 0)
    return np.asarray(np.minimum(found, 250), np.uint8)


def _median(stack: Bytes) -> Bytes:
    """Return the median of planes (n, h, w), sorted by exchanges between neighbours."""
    found, count = np.empty(stack.shape[1:], np.uint8), len(stack)
    for low in range(0, len(found), 16):
        rows = list(stack[:, low : low + 16])
        for k in range(count):
            for i in range(k % 2, count - 1, 2):
                pair = rows[i : i + 2]
                rows[i : i + 2] = np.minimum(*pair), np.maximum(*pair)
        found[low : low + 16] = rows[count // 2]
    return found


def _differ(one: Bytes, other: Bytes) -> Bytes:
    return np.asarray(np.maximum(one, other) - np.minimum(one, other))


def _widened(plane: Bytes, size: int = 3) -> Bytes:
    from scipy.ndimage import maximum_filter

    return np.asarray(maximum_filter(plane, size))


def _without_ghosts(planes: list[Bytes], other: list[Bytes], noise: Sequence[float]) -> None:
    """Put into the background what was seen at another time, in regions that fit their surroundings better so."""
    from scipy.ndimage import binary_dilation, binary_erosion, find_objects, label

    halves = [[half_size(one[0]), one[1], one[2]] for one in (planes, other)]
    changed = np.zeros(halves[0][0].shape, bool)
    for one, two, level, least in zip(*halves, noise, LEAST_LEVELS, strict=True):
        off, texture = _differ(one, two), _classes(one)
        changed |= off > np.maximum(max(least, NOISES * level), _coded(off, texture)[texture])
    changed = binary_dilation(changed, iterations=2)
    labels, _count = label(changed)
    for k, box in enumerate(find_objects(labels)[:200], 1):
        wide = tuple(slice(max(one.start - 6, 0), one.stop + 6) for one in box)
        region = labels[wide] == k
        if region.sum() < LEAST_AREA:
            continue
        now, then = (np.stack([one[wide].astype(float) for one in kind]) for kind in halves)
        steps = [np.abs(np.array(np.gradient(one, axis=(1, 2)))).sum(axis=(0, 1)) for one in (now, then)]

        edge = binary_dilation(region, iterations=2) & ~binary_erosion(region, iterations=4)
        good = region if steps[1][edge].sum() < GHOST * steps[0][edge].sum() else np.zeros_like(region)
        ring = binary_dilation(region, iterations=6) & ~changed[wide]
        if not good.any() and ring.any():
            # (one ball went away where another one came beside it: parts that are more like what is around)
            around = np.median(now[:, ring], axis=1)[:, None, None]
            strange = [np.abs(one - around).sum(axis=0) for one in (then, now)]
            parts, count = label(_opened(region & (strange[0] < strange[1])))
            for j in range(1, min(count, 9) + 1):
                part = binary_dilation(parts == j, iterations=3) & region & (strange[0] <= strange[1])
                if part.sum() >= LEAST_AREA and strange[0][part].sum() < strange[1][part].sum() / 2:
                    good |= part
        if good.any():
            for plane, instead in zip(planes[1:], other[1:], strict=True):
                plane[wide][good] = instead[wide][good]
            whole = np.repeat(np.repeat(good, 2, axis=0), 2, axis=1)
            large = tuple(slice(2 * one.start, 2 * one.start + n) for one, n in zip(wide, whole.shape, strict=True))
            planes[0][large][whole] = other[0][large][whole]


class Region(NamedTuple):
    """Pixels (n,) of a frame at half the size that together differ from the background."""

    x: NDArray[np.intp]
    y: NDArray[np.intp]
    tone: Array
    """(n, 3): y, u, v."""
    still: Array
    """Brightness of the background."""
    shade: Mask
    """Whether they differ as a shadow does: darker, and of the same hue."""
    cut: bool

    def blob(self) -> Blob:
        """Return size, shape and colour."""
        x, y = 2 * self.x + 0.5, 2 * self.y + 0.5
        moments = np.cov(np.stack([x, y])) if len(x) > 1 else np.eye(2)
        small, large = np.sqrt(np.maximum(np.linalg.eigvalsh(moments), 0.1)).tolist()
        lit = np.zeros((np.ptp(self.y) + 1, np.ptp(self.x) + 1), bool)
        lit[self.y - self.y.min(), self.x - self.x.min()] = ~self.shade
        rest = _opened(lit)[self.y - self.y.min(), self.x - self.x.min()]
        share, core, colour = float(rest.mean()), None, self.tone.mean(axis=0)
        if CORE[0] < share < CORE[1]:
            core = float(x[rest].mean()), float(y[rest].mean()), 2 * float(np.sqrt(rest.sum() / np.pi))
        dark = float(colour[0] / max(self.still.mean(), 1.0)) if share <= CORE[0] else 0.0
        (xx, xy), (_xy, yy) = moments.tolist()
        stretch = (xx - yy) / max(xx + yy, 0.1), 2 * xy / max(xx + yy, 0.1)
        tone = tuple(colour.tolist())
        return Blob(float(x.mean()), float(y.mean()), 4.0 * len(x), large, small, tone, self.cut, core, dark, stretch)


def find_regions(halves: Sequence[Bytes], ground: Background, inside: Mask | None = None) -> tuple[list[Region], float]:
    """Return the regions of a frame (y at half the size, u, v) that differ from the background, the largest first, and the share
    of it that does."""
    from scipy.ndimage import label

    changed, darker = np.zeros(halves[0].shape, bool), np.zeros(halves[0].shape, bool)
    for k, (one, still, limit, texture) in enumerate(
        zip(halves, (ground.half, *ground.planes[1:]), ground.limits, ground.texture, strict=True)
    ):
        # (the exposure of a camera drifts: the median difference is none)
        drift = int(np.median(one[::8, ::8].astype(np.int16) - still[::8, ::8]))
        level = np.clip(still.astype(np.int16) + drift, 0, 255).astype(np.uint8) if drift else still
        off = _differ(one, level)
        differs = off > limit
        at = np.flatnonzero(differs)
        differs.flat[at] = off.take(at) > _coded(off, texture)[texture.take(at)]
        changed |= differs
        if k == 0:
            darker = differs & (one < level)
    share = np.count_nonzero(changed) / changed.size
    if inside is not None:
        changed &= inside
    opened = _opened(~_opened(~changed))  # (parts of a ball that are like the ground are bridged; specks go)
    rows, columns = np.divmod(np.flatnonzero(opened), opened.shape[1])
    if share > 2 * CHANGED or not len(rows):
        return [], share
    labels, _count = label(opened[rows[0] : rows[-1] + 1], np.ones((3, 3)))
    which, found = labels[rows - rows[0], columns], list[Region]()
    sizes = np.bincount(which)[1:]
    for k in np.argsort(-sizes)[:MOST_BLOBS]:
        if sizes[k] < LEAST_AREA:
            break
        y, x = rows[which == k + 1], columns[which == k + 1]
        # (what its rim encloses is part of it)
        top, side = int(y.min()) - 1, int(x.min()) - 1
        outer = np.ones((y.max() - top + 2, x.max() - side + 2), bool)
        outer[y - top, x - side] = False
        y, x = np.nonzero(label(outer)[0] != 1) + np.array([[top], [side]])
        tone = np.stack([one[y, x] for one in halves], axis=1).astype(float)
        behind = np.stack([one[y, x] for one in (ground.half, *ground.planes[1:])], axis=1).astype(float)
        # (a shadow takes the same part of brightness and of colour)
        left = (tone[:, :1] - BLACK) / np.maximum(behind[:, :1] - BLACK, 1.0)
        hue = np.abs(tone[:, 1:] - GREY - left * (behind[:, 1:] - GREY))
        most = np.stack([one[y, x] for one in ground.limits[1:]], axis=1)
        height, width = opened.shape
        cut = bool(y.min() <= 0 or x.min() <= 0 or y.max() >= height - 1 or x.max() >= width - 1)
        found.append(Region(x, y, tone, behind[:, 0], darker[y, x] & (hue <= most).all(axis=1), cut))
    return found, share


def _opened(mask: Mask) -> Mask:
    """Return a mask without what is thinner than a cross of three pixels."""
    padded = np.pad(mask, 1)
    core = padded[1:-1, 1:-1] & padded[:-2, 1:-1] & padded[2:, 1:-1] & padded[1:-1, :-2] & padded[1:-1, 2:]
    padded = np.pad(core, 1)
    return np.asarray(padded[1:-1, 1:-1] | padded[:-2, 1:-1] | padded[2:, 1:-1] | padded[1:-1, :-2] | padded[1:-1, 2:])


class Linker:
    """Links the blobs of one frame after the other to paths."""

    def __init__(self) -> None:
        self.paths: list[Path] = []
        self._live: list[Path] = []

    def add(self, number: int, regions: Sequence[Region]) -> None:
        """Take the regions of the next frame."""
        from scipy.optimize import linear_sum_assignment

        self._live = [one for one in self._live if number - one.frames[-1] <= LOST]
        ahead = [one.ahead(number) for one in self._live]
        usuals = [one.area for one in self._live]
        known = [one for one in zip(self._live, ahead, usuals, strict=True) if len(one[0].frames) > 2]
        blobs = [part.blob() for region in regions for part in _parted(region, known)]
        count = len(blobs)
        at = np.array([[one.x, one.y] for one in blobs]).reshape(-1, 2)
        tones = np.array([one.colour for one in blobs]).reshape(-1, 3)
        radius, areas = (np.array([getattr(one, name) for one in blobs]) for name in ("radius", "area"))
        cut = np.array([one.cut for one in blobs], bool)
        # (each path may also go on without a blob: one that is long known does so at a higher price)
        costs = np.full((len(self._live), count + len(self._live)), NEVER)
        for i, (path, place, usual) in enumerate(zip(self._live, ahead, usuals, strict=True)):
            costs[i, count + i] = UNSEEN[len(path.frames) > 3]
            last, gap = path.blobs[-1], number - path.frames[-1]
            start, colour = np.array([last.x, last.y]), path.colour
            way = place - start
            length = float(np.hypot(*way))
            # (a ball that turns back is where it was, or in between)
            reach = REACH * last.radius * gap if len(path.frames) == 1 else 2.2 * length + 2.0 * last.radius
            off = np.hypot(*(at - place).T)
            size, tone = np.abs(np.log(radius / last.radius)), np.abs(tones - colour).max(axis=1)
            near = (off < reach) & ((size < ALIKE) | cut | last.cut) & (tone < COLOUR)
            part = np.clip((at - start) @ way / max(length**2, 1e-9), 0, 1)
            aside = (off + np.hypot(*(at - start - part[:, None] * way).T)) / 2
            if len(path.frames) == 1:  # (nothing is known of its way)
                aside *= UNSEEN[0] / REACH / 2
            area = np.where(cut | last.cut, 0.0, np.abs(np.log(areas / usual)) / 2)
            total = aside / max(last.radius, 1.0) + 2 * size + tone / TONE + area + gap - 1
            costs[i, :count] = np.where(near, total, NEVER)
        linked: set[int] = set()
        for i, j in zip(*linear_sum_assignment(costs), strict=True):
            if j < count and costs[i, j] < NEVER:
                linked.add(int(j))
                self._live[i].frames.append(number)
                self._live[i].blobs.append(blobs[j])
        for j, blob in enumerate(blobs):
            if j not in linked:
                new = Path([number], [blob])
                self.paths.append(new)
                self._live.append(new)


def _parted(region: Region, known: Sequence[tuple[Path, Array, float]]) -> list[Region]:
    """Return the parts of a region that is as large as the balls that reach it, where these are several.

    ``known``: paths, where they are if they move on, and their areas.
    """
    size = 4 * len(region.x)
    if size < BOTH * 2 * min((area for *_rest, area in known), default=np.inf):
        return [region]
    pixels = np.stack([2 * region.x + 0.5, 2 * region.y + 0.5], axis=1)
    low, high = pixels.min(axis=0), pixels.max(axis=0)
    claims: list[tuple[float, int, Array, Path, float]] = []
    for path, place, area in known:
        last = path.blobs[-1]
        at = np.array([last.x, last.y])
        if ((np.maximum(at, place) < low - last.radius) | (np.minimum(at, place) > high + last.radius)).any():
            continue
        # (the first place on its way at which it is in the region: balls do not pass through one another)
        way = at + np.linspace(0, 1, 9)[:, None] * (place - at)
        away = np.sqrt(((pixels[:, None] - way) ** 2).sum(axis=2)).min(axis=0)
        k = int(np.argmin(np.maximum(away, 2.0)))
        if away[k] < last.radius:
            claims.append((float(away[k]), len(claims), way[k], path, area))
    claims.sort(key=lambda one: one[:2])
    while len(claims) > 1 and size < BOTH * sum(area for *_rest, area in claims):
        claims.pop()
    if len(claims) < 2:
        return [region]
    middles = np.array([way for _off, _k, way, *_rest in claims])
    sizes = np.array([path.blobs[-1].radius for *_rest, path, _area in claims])
    unlike = (((region.tone[:, None] - np.array([one[3].colour for one in claims])) / TONES) ** 2).sum(axis=2)
    for _ in range(8):
        owner = (((pixels[:, None] - middles) ** 2).sum(axis=2) / sizes**2 + unlike).argmin(axis=1)
        parts = [owner == k for k in range(len(claims))]
        if any(4 * part.sum() < one[4] / 4 for part, one in zip(parts, claims, strict=True)):
            return [region]
        middles = np.array([pixels[part].mean(axis=0) for part in parts])
    return [Region(*(one[part] for one in region[:-1]), region.cut) for part in parts]  # type: ignore[call-arg]


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
        score = len(path.frames) * fill**4 / (1 + (spread / 0.1) ** 2) * min(extent / path.radius / 6, 1.0)
        found.append((score, path))
    return [path for _score, path in sorted(found, key=lambda one: -one[0])]


def joined(first: Path, others: Sequence[Path]) -> Path:
    """Return a path with what goes on or went before under another: paths of the same size and colour, at other times."""
    path = replace(first)
    tone = np.median([one.colour for one in first.blobs], axis=0)
    for other in others:
        apart = other.frames[0] > path.frames[-1] or other.frames[-1] < path.frames[0]
        far = np.abs(np.median([one.colour for one in other.blobs], axis=0) - tone).max()
        if other is not first and apart and abs(np.log(other.radius / first.radius)) < 0.2 and far < COLOUR / 2:
            parts = [path, other] if path.frames[-1] < other.frames[0] else [other, path]
            path = Path([k for one in parts for k in one.frames], [blob for one in parts for blob in one.blobs])
    return path


def cores_of(path: Path) -> Path | None:
    """Return a path of what is no shadow in its blobs; None where they have no such part."""
    some = [(k, one, one.core) for k, one in zip(path.frames, path.blobs, strict=True) if one.core is not None]
    if len(some) < max(len(path.frames) / 2, 5):
        return None
    blobs = [
        Blob(*core[:2], np.pi * core[2] ** 2, core[2] / 2, core[2] / 2, one.colour, one.cut, shade=one.shade)
        for _k, one, core in some
    ]
    return Path([k for k, _one, _core in some], blobs)
