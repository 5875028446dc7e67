"""The outline of a ball in a frame: a disc swept over the exposure and blurred by the camera, before a known background.

A picture is (1 - A) B (1 + G) + A F: A is the part of a pixel that the ball covers, B the background, F and G are Fourier series
around the rim (what the ball looks like there; its shadow, of which a part falls off with the distance from the rim, as where a
ball touches the ground), found anew for each A (variable projection). Only pixels beside the edge enter, the same ones for all
that is compared. Light is what mixes in a pixel, so brightness is taken out of the camera's
gamma: as stored, an edge is off by an amount that changes with the ground behind it.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
ORDER = 6, 16  # of the Fourier series of a ball, least and most: one per px of the radius
RIDGE = 3e-4  # of the ball's series, of the band's weight
SHADOW = 1 / 30  # standard deviation of the shadow's prior, of the background
SHADOW_ORDER = 1, 2  # of the shadow's series, and of one that is deep
FALL = 0.3  # radii from the rim, over which a deep shadow falls off
INSIDE = 2.8, 0.5, 0.1  # of the band: of the blur, px, of the radius
EXPLAINED, MARKED, EVEN = (0.88, 0.92, 0.96), 0.62, 0.31  # of a ball's picture; of the usual band, and of the radius
OUTSIDE = 0.35, 3.5, 7.0  # of the radius; least and most px
CHROMA_BLUR = 1.3  # px, of colour planes, beside that of the lens
PLACES = 25  # of the exposure, at most
OUTLIER = 2.0  # times the usual misfit of a plane
STEPS, SMALL = 10, 3e-3  # of a descent, at most; px, of its last one
BANDS, NEAR = 3, 0.2  # of an outline, at most; px from where it was sought, of a last one
BLOCK = 2**18  # products of a sum: fewer than threads of their own are worth
GAMMA, BLACK, WHITE = 2.2, 16.0, 219.0  # of brightness as stored; levels: of black, and from there to white
LEAST_SLOPE = 0.15  # of light over brightness, by which noise is multiplied
LIGHT = WHITE * (np.maximum(np.arange(256) - BLACK, 1.0) / WHITE) ** GAMMA  # of brightness
LEAST_WAY = 0.4  # px, in an exposure of the fastest
MOST_PIXELS = 2000  # of a plane, evenly taken from the band
LEAST_PIXELS, LEAST_SEEN = 30, 0.2  # of a band; of a rim
SECTORS = 16
INNER = 0.8  # of the radius: what shows the colour of the ball


class Patch(NamedTuple):
    """The planes around a ball in a frame, and the background there."""

    frame: int
    corner: tuple[int, int]
    """x, y of the first pixel, even."""
    planes: tuple[NDArray[np.uint8], ...]
    """y (h, w), u and v (h / 2, w / 2)."""
    ground: tuple[NDArray[np.uint8], ...]

    def holds(self, low: NDArray[Any], high: NDArray[Any]) -> bool:
        """Return whether pixels from ``low`` to ``high`` (2,) are among these."""
        return bool((low >= self.corner).all() and (high <= np.add(self.corner, self.planes[0].shape[::-1])).all())

    def part(self, low: NDArray[Any], high: NDArray[Any]) -> Patch:
        """Return the pixels from ``low`` to ``high`` (2,), even."""
        (left, top), (right, bottom) = (low - self.corner).tolist(), (high - self.corner).tolist()
        windows = [(slice(top // n, bottom // n), slice(left // n, right // n)) for n in (1, 2, 2)]
        planes, ground = (
            tuple(plane[window] for plane, window in zip(some, windows, strict=False)) for some in self[2:]
        )
        return Patch(self.frame, (int(low[0]), int(low[1])), planes, ground)


class Optics(NamedTuple):
    """What all frames share."""

    radius: float
    """px."""
    psf: float
    """px."""
    exposure: float
    """s."""
    noise: tuple[float, float, float]
    """Of the planes, levels."""
    shift: tuple[float, float] = (0.0, 0.0)
    """Of the colour planes against brightness, px."""
    rows: tuple[float, float] = (0.0, 1.0)
    """Direction in the picture in which the camera reads its rows."""
    lag: float = 0.0
    """From row to row, s per px."""
    deep: bool = False
    """Whether the ball has a deep shadow at its rim."""
    fall: Sequence[float] | Array = (0.0, 0.0)
    """px/s²: the usual acceleration of a ball, also within an exposure."""
    share: float = 0.92
    """Of the ball's picture, explained: one that has marks is seen nearer to its rim."""


class Outline(NamedTuple):
    """An outline that was fitted."""

    place: Array
    """(2,) px."""
    radius: float
    cost: float
    """Mean square misfit, in units of the noise."""
    share: float
    """Of what the picture differs from the background, explained."""
    seen: float
    """Part of the rim at which ball and ground differ."""


@dataclass
class _Pixels:
    """Pixels of the band, of all planes in turn; those of v lie where those of u do."""

    x: Array
    y: Array
    seen: Array
    ground: Array
    blur: Array
    """px², added to the square of the psf."""
    weight: Array
    planes: list[slice]


def _band(
    patch: Patch, place: Array, way: Array, radius: float, depth: float, beyond: float, optics: Optics
) -> _Pixels:
    """Return the pixels whose distance from the swept disc's edge is within ``depth`` inside and ``beyond`` outside."""
    parts, planes, count = [], [], 0
    length = float(np.hypot(*way))
    along = way / length if length > 0 else np.array([1.0, 0.0])
    for k, (plane, ground) in enumerate(zip(patch.planes, patch.ground, strict=True)):
        size, offset = (1.0, 0.0) if k == 0 else (2.0, 0.5)
        shift = (0.0, 0.0) if k == 0 else optics.shift
        x = patch.corner[0] + size * np.arange(plane.shape[1]) + offset + shift[0] - place[0]
        y = patch.corner[1] + size * np.arange(plane.shape[0]) + offset + shift[1] - place[1]
        far = np.clip(x[None, :] * along[0] + y[:, None] * along[1], -length / 2, length / 2)
        distance = np.sqrt((x[None, :] - far * along[0]) ** 2 + (y[:, None] - far * along[1]) ** 2) - radius
        wide = depth + (CHROMA_BLUR if k else 0.0)
        rows, columns = np.nonzero((distance > -wide) & (distance < beyond))
        every = -(-len(rows) // MOST_PIXELS) if len(rows) else 1
        rows, columns = rows[::every], columns[::every]
        seen, behind = (one[rows, columns] if k else LIGHT[one[rows, columns]] for one in (plane, ground))
        steep = 1.0 if k else np.maximum(GAMMA * (seen / WHITE) ** (1 - 1 / GAMMA), LEAST_SLOPE)
        ones = np.ones(len(rows))
        where = x[columns] + place[0], y[rows] + place[1]
        wide = CHROMA_BLUR**2 if k else 0.0
        parts.append(np.stack([*where, seen, behind, ones * wide, ones / (optics.noise[k] * steep)]))
        planes.append(slice(count, count + len(rows)))
        count += len(rows)
    x, y, seen, behind, blur, weight = np.concatenate(parts, axis=1)
    return _Pixels(x, y, seen, behind, blur, weight, planes)


def _covered(pixels: _Pixels, p: Array, speed: Array, optics: Optics, names: str) -> tuple[Array, Array, Array, Array]:
    """Return the covered part A (N,) of pixels of y and u, its derivatives (K, N) by the parameters named, and their directions
    and distances (N,), px, from the ball's middle and its rim.

    Parameters: x, y, r (radius), s (psf), px; e (exposure), ms; q (lag), us per px; and what light makes of the outline, so that it
    is not taken for lag: it is longer along the rows' direction by b, and by c times the square of the speed, and askew by d.
    ``speed``: (2,) px/ms of stamps, which a ball has that moves along with the reading where its own is less: its rows are read
    later and later.
    """
    from scipy.special import ndtr

    x, y, radius, psf, exposure, lag, long, more, skew = p
    rows, some = optics.rows, pixels.planes[1].stop
    later = 1e-3 * (speed[0] * rows[0] + speed[1] * rows[1])
    speed = speed / (1 + lag * later)
    later *= exposure / (1 + lag * later)
    sigma = psf**2 + pixels.blur[:some]
    count = int(np.clip(np.ceil(exposure * np.hypot(*speed) / max(psf, 0.5)), 1, PLACES))
    part = ((np.arange(count) + 0.5) / count - 0.5)[:, None]
    # (speeds within the exposure)
    u, v = (speed[k] + part * (exposure * 1e-6 * optics.fall[k]) for k in (0, 1))
    dx, dy = pixels.x[:some] - x, pixels.y[:some] - y
    row = 1e-3 * (dx * rows[0] + dy * rows[1])
    middle = dx + 1j * dy
    # (a row that is read later sees the ball further on)
    fast = (speed[0] * rows[0] + speed[1] * rows[1]) ** 2
    along = 1e3 * row * (long + more * fast)
    turn = 1e3 * row * skew
    dx = dx - along * rows[0] - turn * rows[1] - lag * row * speed[0] - part * exposure * (speed[0] + u) / 2
    dy = dy - along * rows[1] + turn * rows[0] - lag * row * speed[1] - part * exposure * (speed[1] + v) / 2
    distance = np.maximum(np.sqrt(dx * dx + dy * dy), 1e-9)
    # (from place to place the rim is swept, too)
    wide = exposure / count / np.sqrt(12) * speed
    sigma = np.sqrt(sigma + ((dx * wide[0] + dy * wide[1]) / distance) ** 2)
    z = (radius - distance) / sigma
    density = np.exp(-0.5 * z * z) / sigma * (1 / np.sqrt(2 * np.pi) / count)
    out = density / distance
    slopes: dict[str, Callable[[], Array]] = {
        "x": lambda: (out * dx).sum(axis=0),
        "y": lambda: (out * dy).sum(axis=0),
        "r": lambda: density.sum(axis=0),
        "s": lambda: -(density * z / sigma).sum(axis=0) * psf,
        "e": lambda: (out * (dx * u + dy * v) * part).sum(axis=0),
        "q": lambda: (out * (dx * speed[0] + dy * speed[1]) * (row - part * later)).sum(axis=0),
        "b": lambda: (out * (dx * rows[0] + dy * rows[1])).sum(axis=0) * 1e3 * row,
        "c": lambda: slopes["b"]() * fast,
        "d": lambda: (out * (dx * rows[1] - dy * rows[0])).sum(axis=0) * 1e3 * row,
        "2": lambda: density.sum(axis=0) * (around**2).real,
        "3": lambda: density.sum(axis=0) * (around**2).imag,
        "4": lambda: density.sum(axis=0) * (around**3).real,
        "5": lambda: density.sum(axis=0) * (around**3).imag,
    }
    around = middle / np.maximum(np.abs(middle), 1e-9)
    beyond = np.maximum(distance.min(axis=0) - radius, 0.0)
    return ndtr(z).mean(axis=0), np.stack([slopes[name]() for name in names]), around, beyond


def _product(a: Array, b: Array) -> Array:
    """Return a b^T of (K, N) and (L, N), in blocks that are too small for threads of their own."""
    size = BLOCK // (len(a) * len(b))
    return sum(a[:, k : k + size] @ b[:, k : k + size].T for k in range(0, a.shape[1], size))  # type: ignore[return-value]


def _residuals(
    pixels: _Pixels, p: Array, speed: Array, optics: Optics, names: str, order: int, weight: Array
) -> tuple[Array, Array, Array]:
    """Return residuals (N,), their projected derivatives (K, N), and by how much ball and ground differ (N,); all in levels."""
    from scipy.linalg.lapack import dpotrf, dpotrs

    cover, slope, turn, beyond = _covered(pixels, p, speed, optics, names)
    orders = order, SHADOW_ORDER[optics.deep]
    powers = np.cumprod(np.broadcast_to(turn, (max(orders), len(turn))), axis=0)
    ball, shadow = (
        np.concatenate([np.ones((1, len(turn))), powers[:most].real, powers[:most].imag]) for most in orders
    )
    if optics.deep:
        shadow = np.concatenate([shadow, shadow * np.exp(-beyond / (FALL * p[2]))])
    count, root, (bright, tint, _tint) = len(ball), np.sqrt(weight), pixels.planes
    residual, differ, projected = np.empty_like(weight), np.empty_like(weight), np.empty((len(slope), len(weight)))
    prior = np.full(count + len(shadow), SHADOW**-2 + 1e-9)
    prior[0] = 1e-9
    for part, at in zip(pixels.planes, (bright, tint, tint), strict=True):
        ground, veil, w = pixels.ground[part], 1 - cover[at], root[part]
        x, seen = np.empty((len(prior), len(w))), w * (pixels.seen[part] - veil * ground)
        np.multiply(ball[:, at], cover[at] * w, out=x[:count])
        np.multiply(shadow[:, at], w * veil * (ground + 1), out=x[count:])
        prior[1:count] = RIDGE * weight[part].sum() + 1e-9
        normal = dpotrf(_product(x, x) + np.diag(prior))[0]
        known = dpotrs(normal, x @ seen)[0]
        differ[part] = known[:count] @ ball[:, at] - (ground + 1) * (known[count:] @ shadow[:, at]) - ground
        derivative = w * differ[part] * slope[:, at]
        residual[part] = (seen - known @ x) / w
        projected[:, part] = (derivative - dpotrs(normal, _product(x, derivative))[0].T @ x) / w
    return residual, projected, differ


def _start(place: Array, optics: Optics) -> Array:
    return np.array([*place, optics.radius, optics.psf, 1e3 * optics.exposure, 1e6 * optics.lag, 0.0, 0.0, 0.0])


def _order(optics: Optics) -> int:
    return int(np.clip(optics.radius, *ORDER))


def fit_outline(
    patch: Patch, place: Array, speed: Array, optics: Optics, *, free: str = "xy", order: int | None = None, coarse: bool = True,
    like: tuple[Array, Array] | None = None,
) -> Outline:  # fmt: skip
    """Fit the outline of a ball, beginning at a place (2,), px, with its speed (2,), px/s.

    ``free``: of x, y, r (radius). ``like``: place and way (px, in the exposure) of another outline, whose pixels are used, as the
    two are compared.
    """
    p, v = _start(place, optics), 1e-3 * speed
    if coarse:
        p[3] = 0.12 * optics.radius + 1.0
        wide = max(0.5 * optics.radius, 3.0)
        pixels = _band(patch, p[:2], speed * optics.exposure, optics.radius, wide, wide, optics)
        p = _descended(pixels, p, v, "xy", 1, 3, optics)[0] if len(pixels.x) >= LEAST_PIXELS else p
        p[3] = optics.psf
    for _ in range(1 if like else BANDS):
        # (pixels of a band beside the ball give a place that is off)
        at = p[:2].copy()
        pixels = _rim(patch, *(like or (at, speed * optics.exposure)), optics)
        if len(pixels.x) < LEAST_PIXELS:
            return Outline(at, optics.radius, np.inf, 0.0, 0.0)
        p, residual, differ = _descended(pixels, p, v, free, order or _order(optics), STEPS, optics)
        if float(np.hypot(*(p[:2] - at))) < NEAR:
            break
    scaled, away = (residual * pixels.weight) ** 2, ((pixels.seen - pixels.ground) * pixels.weight) ** 2
    share = 1 - float(scaled.sum() / max(float(away.sum()), 1e-9))
    angle = np.arctan2(pixels.y - p[1], pixels.x - p[0])
    sector = np.floor((angle / (2 * np.pi) + 0.5) * SECTORS).astype(int) % SECTORS
    strong = np.bincount(sector, np.abs(differ) * pixels.weight, SECTORS)
    seen = float((strong > 4.0 * np.maximum(np.bincount(sector, minlength=SECTORS), 1)).mean())
    cost = float(scaled.mean()) if seen >= LEAST_SEEN else np.inf
    return Outline(p[:2].copy(), float(p[2]), cost, share, seen)


def look_closer(patch: Patch, outline: Outline, speed: Array, optics: Optics) -> tuple[Array, Array]:
    """Return what else there is to an outline that was fitted: the shape of its rim, and the colour within.

    Shape (5,), px: by which the rim differs from that of the disc in radius, and by cosine and sine of twice and three times the
    angle around it. Colour (3,): mean light, u, v of the ball, levels.
    """
    p, v = _start(outline.place, optics), 1e-3 * speed
    pixels = _rim(patch, outline.place, speed * optics.exposure, optics)
    residual, slope, _differ = _residuals(pixels, p, v, optics, "xyr2345", _order(optics), pixels.weight**2)
    weight = _robust(pixels, residual)
    normal = _product(slope * weight, slope) + 1e-6 * np.eye(7)
    shape = np.linalg.solve(normal, slope @ (weight * residual))[2:]
    inner, part, colour = INNER * optics.radius, np.linspace(-0.5, 0.5, 7)[:, None, None], []
    for k, (plane, ground) in enumerate(zip(patch.planes, patch.ground, strict=True)):
        size, offset = (1.0, 0.0) if k == 0 else (2.0, 0.5)
        x, y = (patch.corner[n] + size * np.arange(plane.shape[1 - n]) + offset - outline.place[n] for n in (0, 1))
        way = speed * optics.exposure
        away = (x[None, None] - part * way[0]) ** 2 + (y[None, :, None] - part * way[1]) ** 2
        cover = (away < inner**2).mean(axis=0)
        seen, behind = ((one if k else LIGHT[one]) for one in (plane, ground))
        total = float((cover * cover).sum())
        colour.append(float((cover * (seen - (1 - cover) * behind)).sum()) / total if total else np.nan)
    return np.asarray(shape), np.array(colour)


def _rim(patch: Patch, place: Array, way: Array, optics: Optics) -> _Pixels:
    """Return the pixels beside the edge, from which outlines are found."""
    beyond = float(np.clip(OUTSIDE[0] * optics.radius, *OUTSIDE[1:]))
    usual = float(np.dot(INSIDE, (optics.psf, 1.0, optics.radius)))
    depth = float(np.interp(optics.share, EXPLAINED, (MARKED * usual, usual, max(usual, EVEN * optics.radius))))
    return _band(patch, place, way, optics.radius, depth, beyond, optics)


def _descended(
    pixels: _Pixels, p: Array, speed: Array, names: str, order: int, steps: int, optics: Optics
) -> tuple[Array, Array, Array]:
    """Return the parameters after Gauss-Newton steps, residuals (N,) and differences of ball and ground (N,)."""
    index = ["xyr".index(name) for name in names]
    weight = pixels.weight**2
    limit = optics.radius * np.array([0.5, 0.5, 0.15])[index]
    best: tuple[float, Array, Array, Array, Array] | None = None
    damping, robust = 1e-3, False
    trial = p.copy()
    for _ in range(steps):
        residual, slope, differ = _residuals(pixels, trial, speed, optics, names, order, weight)
        cost = float((residual * residual * weight).sum())
        moved = np.inf if best is None else float(np.abs(trial - best[1]).max())
        if best is None or cost <= best[0]:
            best = (cost, trial.copy(), residual, slope, differ)
            damping = max(damping / 5, 1e-4)
            if moved < 0.3 and not robust:
                weight, robust = _robust(pixels, residual), True
                best = (float((residual * residual * weight).sum()), *best[1:])
        else:
            damping = min(10 * damping, 1e3)
        if moved < SMALL:
            break
        _cost, at, residual, slope, _differ = best
        normal = _product(slope * weight, slope)
        normal[np.diag_indices(len(index))] *= 1 + damping
        normal[np.diag_indices(len(index))] += 1e-9
        step = np.linalg.solve(normal, slope @ (weight * residual))
        trial = at.copy()
        trial[index] += np.clip(step, -limit, limit)
        trial[2] = max(trial[2], 1.0)
    assert best is not None
    return best[1], best[2], best[4]


def _robust(pixels: _Pixels, residual: Array) -> Array:
    """Return weights (N,): less of a plane that the outline explains less, and of pixels far off."""
    weight, off = pixels.weight**2, np.abs(residual) * pixels.weight
    for part in pixels.planes:
        scale = max(float(np.median(off[part])) / 0.6745, 1.0) if part.stop > part.start else 1.0
        weight[part] *= np.minimum(1.0, OUTLIER * scale / np.maximum(off[part], 1e-9)) ** 2 / scale
    return weight


def fit_optics(
    frames: Sequence[tuple[Patch, Array, Array]], optics: Optics, free: str, order: int | None = None, steps: int = 8
) -> tuple[Optics, Array, list[Array]]:
    """Fit what frames have in common: of the parameters of _covered, from r on.

    ``frames``: patch, place (2,), px, and speed (2,), px/s. Returns the optics, the standard errors of what is free by the scatter
    between the frames, and the places.
    """
    order = order or _order(optics)
    bands = [_rim(patch, place, speed * optics.exposure, optics) for patch, place, speed in frames]
    places, shared = [place.copy() for _patch, place, _speed in frames], _start(np.zeros(2), optics)
    index = ["xyrseqbcd".index(name) for name in free]
    limit = np.array([0.15 * optics.radius, 0.5, 4.0, 20.0, 0.1, 0.1, 0.1])[np.array(index) - 2]
    # (nothing is seen of an exposure of zero that it should be longer)
    fastest = max(1e-3 * max(float(np.hypot(*speed)) for *_rest, speed in frames), 1e-3)
    least = np.array([1.0, 0.35, LEAST_WAY / fastest])
    for turn in range(steps):
        total, pulls, inner = np.zeros((len(index), len(index))), [], []
        for pixels, place, (_patch, _place, speed) in zip(bands, places, frames, strict=True):
            p = np.array([*place, *shared[2:]])
            residual, slope, _differ = _residuals(pixels, p, 1e-3 * speed, optics, "xy" + free, order, pixels.weight**2)
            weight = _robust(pixels, residual) if turn > 1 else pixels.weight**2
            # (a frame that the outline does not explain counts less)
            weight = weight / max(float((residual**2 * weight).mean()), 1.0)
            a, b = _product(slope * weight, slope) + 1e-9 * np.eye(len(slope)), slope @ (weight * residual)
            back = np.linalg.solve(a[:2, :2], np.column_stack([b[:2], a[:2, 2:]]))
            total += a[2:, 2:] - a[2:, :2] @ back[:, 1:]
            pulls.append(b[2:] - a[2:, :2] @ back[:, 0])
            inner.append(back)
        normal = np.linalg.inv(total + 1e-6 * np.eye(len(index)))
        step = np.clip(normal @ np.sum(pulls, axis=0), -limit, limit)
        before = shared.copy()
        shared[index] += step
        shared[2:5] = np.maximum(shared[2:5], least)
        for k, back in enumerate(inner):
            places[k] = places[k] + np.clip(back[:, 0] - back[:, 1:] @ step, -limit[0] - 1, limit[0] + 1)
        errors = np.sqrt(np.diag(normal @ np.array(pulls).T @ np.array(pulls) @ normal))
        if turn > 1 and (np.abs(shared - before)[index] < 0.1 * errors + 1e-4).all():
            break
    return (
        optics._replace(radius=shared[2], psf=shared[3], exposure=1e-3 * shared[4], lag=1e-6 * shared[5]),
        errors,
        places,
    )
