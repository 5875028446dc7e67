"""The outline of a ball in a frame: a disc swept over the exposure and blurred by the camera, before a known background.

A picture is (1 - A) B (1 + G) + A F: A is the part of a pixel that the ball covers, B the background, F and G are Fourier series
around the rim (what the ball looks like there; its shadow), found anew for each A (variable projection). Only pixels beside the
edge enter, the same ones for all that is compared.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
ORDER, MORE, SHADOW_ORDER = (
    6,
    (15.0, 10),
    1,
)  # of the Fourier series of ball, of one from so many px on, and of its shadow
SHADOW = 1 / 30  # standard deviation of the shadow's prior, of the background
INSIDE, OUTSIDE = (2.8, 0.5), (0.35, 3.5, 7.0)  # of the band: times the blur plus px; of the radius, least and most px
CHROMA_BLUR = 1.3  # px, of colour planes, beside that of the lens
PLACES = 25  # of the exposure, at most
HUBER = 3.0
STEPS = 8
MOST_PIXELS = 2600  # of a plane, evenly taken from the band
SECTORS = 16


class Patch(NamedTuple):
    """The planes around a ball in a frame, and the background there."""

    frame: int
    corner: tuple[int, int]
    """x, y of the first pixel, even."""
    planes: tuple[NDArray[np.uint8], ...]
    """y (h, w), u and v (h / 2, w / 2)."""
    ground: tuple[NDArray[np.uint8], ...]


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


class Outline(NamedTuple):
    """An outline that was fitted."""

    place: Array
    """(2,) px."""
    radius: float
    blur: float
    """Way of the exposure, px."""
    psf: float
    cost: float
    """Mean square misfit, in units of the noise."""
    share: float
    """Of what the picture differs from the background, explained."""
    seen: float
    """Part of the rim at which ball and ground differ."""


@dataclass
class _Pixels:
    """Pixels of the band, of all planes in turn."""

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
        distance = np.hypot(x[None, :] - far * along[0], y[:, None] - far * along[1]) - radius
        wide = depth + (CHROMA_BLUR if k else 0.0)
        rows, columns = np.nonzero((distance > -wide) & (distance < beyond))
        every = -(-len(rows) // MOST_PIXELS) if len(rows) else 1
        rows, columns = rows[::every], columns[::every]
        parts.append(
            np.stack(
                [
                    x[columns] + place[0], y[rows] + place[1], plane[rows, columns].astype(float),
                    ground[rows, columns].astype(float), np.full(len(rows), CHROMA_BLUR**2 if k else 0.0),
                    np.full(len(rows), 1 / optics.noise[k]),
                ]
            )
        )  # fmt: skip
        planes.append(slice(count, count + len(rows)))
        count += len(rows)
    x, y, seen, behind, blur, weight = np.concatenate(parts, axis=1)
    return _Pixels(x, y, seen, behind, blur, weight, planes)


def _covered(pixels: _Pixels, p: Array, along: Array, names: str) -> tuple[Array, Array]:
    """Return the covered part A (N,) of pixels, and its derivatives (N, K) by the parameters named: x, y, r, l (way), s (psf)."""
    x, y, radius, length, psf = p
    sigma = np.sqrt(psf**2 + pixels.blur)
    count = int(np.clip(np.ceil(length / max(psf, 0.5)), 1, PLACES))
    part = (np.arange(count) + 0.5) / count - 0.5
    dx = (pixels.x - x)[None, :] - (part * length * along[0])[:, None]
    dy = (pixels.y - y)[None, :] - (part * length * along[1])[:, None]
    distance = np.maximum(np.sqrt(dx * dx + dy * dy), 1e-9)
    z = (radius - distance) / sigma
    density = np.exp(-0.5 * z * z) / (np.sqrt(2 * np.pi) * sigma)
    from scipy.special import ndtr

    slopes = {
        "x": lambda: (density * dx / distance).mean(axis=0),
        "y": lambda: (density * dy / distance).mean(axis=0),
        "r": lambda: density.mean(axis=0),
        "l": lambda: (density * (dx * along[0] + dy * along[1]) / distance * part[:, None]).mean(axis=0),
        "s": lambda: -(density * z).mean(axis=0) * psf / sigma,
    }
    return ndtr(z).mean(axis=0), np.stack([slopes[name]() for name in names], axis=1)


def _series(angle: Array, order: int) -> Array:
    turns = np.arange(1, order + 1) * angle[:, None]
    return np.concatenate([np.ones((len(angle), 1)), np.cos(turns), np.sin(turns)], axis=1)


def _residuals(
    pixels: _Pixels, p: Array, along: Array, names: str, order: int, weight: Array
) -> tuple[Array, Array, Array]:
    """Return residuals (N,), their projected derivatives (N, K), and by how much ball and ground differ (N,); all in levels."""
    cover, slope = _covered(pixels, p, along, names)
    angle = np.arctan2(pixels.y - p[1], pixels.x - p[0])
    ball, shadow = _series(angle, order), _series(angle, SHADOW_ORDER)
    behind = pixels.ground + 1.0
    columns = np.concatenate([cover[:, None] * ball, ((1 - cover) * behind)[:, None] * shadow], axis=1)
    target = pixels.seen - (1 - cover) * pixels.ground
    residual, differ = np.empty_like(target), np.empty_like(target)
    projected = np.empty_like(slope)
    count = ball.shape[1]
    prior = np.zeros(columns.shape[1])
    for part in pixels.planes:
        x, w = columns[part], weight[part]
        noise = 1 / pixels.weight[part][0] if part.stop > part.start else 1.0
        prior[1:count], prior[count:] = 1e-3 * len(w), (noise / SHADOW) ** 2
        wx = x * w[:, None]
        normal = x.T @ wx + np.diag(prior + 1e-9)
        both = np.linalg.solve(normal, wx.T)
        known = both @ target[part]
        differ[part] = ball[part] @ known[:count] - behind[part] * (shadow[part] @ known[count:]) - pixels.ground[part]
        derivative = differ[part][:, None] * slope[part]
        residual[part] = target[part] - x @ known
        projected[part] = derivative - x @ (both @ derivative)
    return residual, projected, differ


def fit_outline(
    patch: Patch, place: Array, way: Array, optics: Optics, *, free: str = "xy", order: int | None = None, coarse: bool = True,
    like: Sequence[tuple[Array, Array]] = (),
) -> Outline:  # fmt: skip
    """Fit the outline of a ball, beginning at a place (2,), px, with the way (2,) of the exposure, px.

    ``free``: of x, y, r (radius), l (length of the way), s (psf). ``like``: places and ways of other outlines with which this one
    is compared: their pixels enter, too.
    """
    if order is None:
        order = MORE[1] if optics.radius >= MORE[0] else ORDER
    length = float(np.hypot(*way))
    along = way / length if length > 0 else np.array([1.0, 0.0])
    p = np.array([*place, optics.radius, length, optics.psf])
    if coarse:
        soft = 0.12 * optics.radius + 1.0
        wide = max(0.5 * optics.radius, 3.0)
        p[4] = soft
        pixels = _band(patch, p[:2], way, optics.radius, wide, wide, optics)
        p = _descended(pixels, p, along, "xy", 1, 3, optics)[0]
        p[4] = optics.psf
    least, most = OUTSIDE[1:]
    beyond = float(np.clip(OUTSIDE[0] * optics.radius, least, most))
    depth = INSIDE[0] * optics.psf + INSIDE[1] + (0.1 * optics.radius if "r" in free else 0.0)
    bands = [_band(patch, at, by, optics.radius, depth, beyond, optics) for at, by in like]
    pixels = bands[0] if bands else _band(patch, p[:2], along * p[3], optics.radius, depth, beyond, optics)
    p, residual, differ = _descended(pixels, p, along, free, order, STEPS, optics)
    inner = pixels.planes[0]
    away = pixels.seen - pixels.ground
    scaled = (residual * pixels.weight) ** 2
    share = 1 - float(scaled.sum() / max(float(((away * pixels.weight) ** 2).sum()), 1e-9))
    sector = (
        np.floor((np.arctan2(pixels.y - p[1], pixels.x - p[0]) / (2 * np.pi) + 0.5) * SECTORS).astype(int) % SECTORS
    )
    strong = np.bincount(sector, np.abs(differ) * pixels.weight, SECTORS) / np.maximum(
        np.bincount(sector, minlength=SECTORS), 1
    )
    seen = float((strong > 4.0).mean())
    cost = float(scaled.mean()) if inner.stop > inner.start else np.inf
    return Outline(p[:2].copy(), float(p[2]), float(p[3]), float(p[4]), cost, share, seen)


def _descended(
    pixels: _Pixels, p: Array, along: Array, names: str, order: int, steps: int, optics: Optics
) -> tuple[Array, Array, Array]:
    """Return the parameters after Gauss-Newton steps, residuals (N,) and differences of ball and ground (N,)."""
    index = ["xyrls".index(name) for name in names]
    weight = pixels.weight**2
    limit = np.array([0.5 * optics.radius, 0.5 * optics.radius, 0.15 * optics.radius, optics.radius, 0.5])[index]
    low = np.array([-np.inf, -np.inf, 1.0, 0.0, 0.35])
    best: tuple[float, Array, Array, Array, Array] | None = None
    damping, robust = 1e-3, False
    trial = p.copy()
    for _ in range(steps):
        residual, slope, differ = _residuals(pixels, trial, along, names, order, weight)
        cost = float((residual * residual * weight).sum())
        if best is None or cost <= best[0]:
            moved = np.inf if best is None else float(np.abs(trial - best[1]).max())
            best = (cost, trial.copy(), residual, slope, differ)
            damping = max(damping / 5, 1e-4)
            if moved < 2e-3:
                break
            if moved < 0.3 and not robust:
                scale = np.maximum(np.median(np.abs(residual)) / 0.6745, 1e-3)
                weight = pixels.weight**2 * np.minimum(1.0, HUBER * scale / np.maximum(np.abs(residual), 1e-9))
                best, robust = (
                    (float((residual * residual * weight).sum()), trial.copy(), residual, slope, differ),
                    True,
                )
        else:
            damping = min(10 * damping, 1e3)
        _cost, at, residual, slope, _differ = best
        normal = (slope * weight[:, None]).T @ slope
        normal[np.diag_indices(len(index))] *= 1 + damping
        normal[np.diag_indices(len(index))] += 1e-9
        step = np.linalg.solve(normal, (slope * weight[:, None]).T @ residual)
        trial = at.copy()
        trial[index] += np.clip(step, -limit, limit)
        trial = np.maximum(trial, low)
    assert best is not None
    return best[1], best[2], best[4]
