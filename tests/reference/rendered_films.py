"""Films of balls whose truth is known to the pixel: motion in closed form, light, lens, shutter, sensor and H.264 around it.

Nothing of ``carom`` is used. World: metres, X to the right, Y up in the picture, Z toward the viewer (from above: Z is up). Pixels:
x to the right, y down, (0, 0) the centre of the first pixel of the picture as it is shown (turned as the file asks for).
A row is exposed around its time, ``stamp + readout * row / rows``, of the picture as the sensor has it.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from fractions import Fraction
from pathlib import Path
from typing import Any

import av
import numpy as np
from numpy.typing import NDArray
from scipy.ndimage import gaussian_filter, zoom

Array = NDArray[np.float64]
GRAVITY, KAPPA = 9.81, 0.4
TICKS = 90_000  # of the container's clock, per second
LIGHT = np.array([-0.4, 0.75, 0.55]) / np.linalg.norm([-0.4, 0.75, 0.55])
YELLOW, RED, WHITE, ORANGE, BLACK = (
    (0.9, 0.75, 0.15),
    (0.85, 0.25, 0.2),
    (0.93, 0.93, 0.9),
    (0.95, 0.5, 0.1),
    (0.08, 0.08, 0.1),
)
ASIDE = {"wall": 1.0, "beside": 3.2}  # of shadows on the wall behind, how far they are
GREEN_AS_RED = (0.1, 0.6, 0.37)  # of the same luma


# --- motion -----------------------------------------------------------------------------------------------------------


@dataclass(frozen=True)
class Motion:
    """Pieces of constant acceleration and of spins that change evenly: each from its start to the start of the next."""

    starts: Array
    place: Array
    velocity: Array
    acceleration: Array
    spin: Array
    spin_rate: Array
    contacts: tuple[float, ...] = ()
    """Times of contacts with the wall, s."""

    def _piece(self, t: Array) -> tuple[NDArray[np.intp], Array]:
        k = np.clip(np.searchsorted(self.starts, t, side="right") - 1, 0, None)
        return k, (t - self.starts[k])[..., None]

    def at(self, t: Array) -> Array:
        """Places of the centre (..., 3) at times (...)."""
        k, s = self._piece(np.asarray(t, dtype=float))
        return np.asarray(self.place[k] + s * self.velocity[k] + s**2 / 2 * self.acceleration[k])

    def velocity_at(self, t: Array) -> Array:
        k, s = self._piece(np.asarray(t, dtype=float))
        return np.asarray(self.velocity[k] + s * self.acceleration[k])

    def spin_at(self, t: Array) -> Array:
        k, s = self._piece(np.asarray(t, dtype=float))
        return np.asarray(self.spin[k] + s * self.spin_rate[k])


def pieces(rows: Sequence[tuple[Any, ...]], contacts: Sequence[float] = ()) -> Motion:
    """A motion of (start, place, velocity, acceleration, spin, spin rate) by piece."""
    start, *others = zip(*rows, strict=True)
    return Motion(np.array(start, dtype=float), *(np.array(one, dtype=float) for one in others), tuple(contacts))


def bounces(
    restitution: float = 0.78,
    height: float = 0.5,
    x: float = -0.3,
    speed: float = 0.35,
    spin: Sequence[float] = (0, 0, 0),
    *,
    radius: float = 0.02,
    friction: float = 0.35,
    gravity: float = GRAVITY,
    start: float = 0.0,
    count: int = 12,
    drop: float = 0.0,
) -> Motion:
    """A ball over the floor Y = 0, let go at ``start`` with its lowest point at ``height`` (m) and ``drop`` m/s (upward)."""
    place, v, w = np.array([x, height + radius, 0.0]), np.array([speed, drop, 0.0]), np.array(spin, dtype=float)
    fall, rows, contacts, t = np.array([0.0, -gravity, 0.0]), [], [], start
    for _ in range(count):
        rows.append((t, place, v, fall, w, np.zeros(3)))
        lasts = (v[1] + np.sqrt(v[1] ** 2 + 2 * gravity * (place[1] - radius))) / gravity
        place, v, t = place + v * lasts + fall * lasts**2 / 2, v + fall * lasts, t + lasts
        slip, normal = v[0] + radius * w[2], -v[1]
        lost = -np.sign(slip) * min(abs(slip) * KAPPA / (1 + KAPPA), friction * (1 + restitution) * normal)
        v, w = np.array([v[0] + lost, restitution * normal, 0.0]), w + np.array([0, 0, lost / (KAPPA * radius)])
        contacts.append(t)
    first = pieces(rows, contacts)
    # (held until it is let go)
    return Motion(
        *(np.concatenate([[a], b]) for a, b in zip(
            (-1.0, first.place[0], np.zeros(3), np.zeros(3), np.zeros(3), np.zeros(3)),
            (first.starts, first.place, first.velocity, first.acceleration, first.spin, first.spin_rate), strict=True)),
        tuple(contacts),
    ) if start > 0 else first  # fmt: skip


def collide(
    places: Sequence[Sequence[float]],
    velocities: Sequence[Sequence[float]],
    *,
    restitution: float = 0.95,
    radius: float = 0.03,
    rolling: float = 0.02,
    duration: float = 2.5,
    step: float = 5e-4,
    gravity: float = GRAVITY,
    bounds: Sequence[float] = (),
) -> list[Motion]:
    """Balls of equal mass on a table from above, in small steps: they slow down, and part without friction where they touch.

    ``bounds`` (x, y) are half the sides of the box around them.
    """  # fmt: skip
    x = np.array([[*one, radius] for one in places], dtype=float)
    v = np.array([[*one, 0.0] for one in velocities], dtype=float)
    rows: list[list[tuple[Any, ...]]] = [[] for _ in places]
    contacts: list[float] = []
    for k in range(int(duration / step)):
        for i in range(len(x)):
            for j in range(i):
                gap = x[i] - x[j]
                n = gap / np.linalg.norm(gap)
                closing = (v[i] - v[j]) @ n
                if np.linalg.norm(gap) < 2 * radius and closing < 0:
                    v[i] -= (1 + restitution) / 2 * closing * n
                    v[j] += (1 + restitution) / 2 * closing * n
                    contacts.append(k * step)
            for axis, most in enumerate(bounds):
                if abs(x[i, axis]) > most - radius and x[i, axis] * v[i, axis] > 0:
                    v[i, axis] *= -restitution
        speed = np.linalg.norm(v, axis=1, keepdims=True)
        a = -np.where(speed > rolling * gravity * step, rolling * gravity * v / np.maximum(speed, 1e-9), v / step)
        for i, mine in enumerate(rows):
            mine.append(
                (k * step, x[i].copy(), v[i].copy(), a[i], np.array([-v[i, 1], v[i, 0], 0]) / radius, np.zeros(3))
            )
        x, v = x + v * step + a * step**2 / 2, v + a * step
    return [pieces(mine, contacts) for mine in rows]


def turned(axis_angle: Array) -> Array:
    """Rotation matrices (..., 3, 3) of vectors (..., 3) in radians (Rodrigues)."""
    w = np.asarray(axis_angle, dtype=float)
    angle = np.linalg.norm(w, axis=-1)[..., None, None]
    k = np.zeros((*w.shape[:-1], 3, 3))
    k[..., 0, 1], k[..., 0, 2], k[..., 1, 2] = -w[..., 2], w[..., 1], -w[..., 0]
    k = k - np.swapaxes(k, -1, -2)
    safe = np.where(angle > 1e-9, angle, 1.0)
    first = np.where(angle > 1e-9, np.sin(angle) / safe, 1.0)
    second = np.where(angle > 1e-9, (1 - np.cos(angle)) / safe**2, 0.5)
    return np.asarray(np.eye(3) + first * k + second * k @ k)


def attitudes(motion: Motion, times: Array, step: float = 1e-3) -> Array:
    """Attitudes (n, 3, 3) at times that grow: the spin followed in small steps from t = 0."""
    found, attitude, t = [], turned(np.array([0.3, 0.5, 0.2])), 0.0
    for end in np.asarray(times).tolist():
        count = max(int(np.ceil((end - t) / step)), 1)
        h = (end - t) / count
        for one in turned(motion.spin_at(t + h * (np.arange(count) + 0.5)) * h):
            attitude = one @ attitude
        t = end
        found.append(attitude)
    return np.array(found)


# --- what is seen -----------------------------------------------------------------------------------------------------


@dataclass(frozen=True)
class Look:
    """A ball's skin: colours as encoded (0 to 1), marks by directions of the body with a half angle, light, highlight."""

    colour: Sequence[float] = YELLOW
    pattern: str = "spots"
    """``plain``, ``spots`` (8 small), ``soccer`` (12 large) or ``mark`` (one, and one half as large a quarter turn away)."""
    ink: Sequence[float] = BLACK
    ambient: float = 0.35
    highlight: float = 0.3


@dataclass(frozen=True)
class Camera:
    """Lens, shutter and sensor."""

    size: tuple[int, int] = (320, 240)
    scale: float = 300.0
    """px per metre in the plane Z = 0."""
    distance: float | None = None
    """m from Z = 0; None: parallel."""
    centre: tuple[float, float] = (0.0, 0.3)
    """World X and Y in the middle of the picture."""
    rate: float = 60.0
    exposure: float = 1 / 500
    readout: float = 0.0
    psf: float = 0.7
    gamma: float = 2.2
    gain: float = 1.0
    """Linear light that the sensor has for white."""
    electrons: float = 8000.0
    """At white."""
    read_noise: float = 4.0
    shake: float = 0.0
    """px, rms of a hand's slow movement."""
    smooth: float = 0.0
    """px: the picture is smoothed after the noise, as phones do."""

    def project(self, place: Array, radius: float) -> tuple[Array, Array]:
        """Centre (..., 2) and radius (...) of the outline of a sphere, px (of an ellipse: the geometric mean of its half axes)."""
        middle = np.array([(self.size[0] - 1) / 2, (self.size[1] - 1) / 2])
        x, y, z = np.moveaxis(np.asarray(place, dtype=float) - [*self.centre, 0.0], -1, 0)
        if self.distance is None:
            return np.stack([middle[0] + self.scale * x, middle[1] - self.scale * y], axis=-1), np.full(
                x.shape, self.scale * radius
            )
        focal, depth, aside = self.scale * self.distance, self.distance - z, np.hypot(x, y)
        alpha, beta = np.arctan2(aside, depth), np.arcsin(radius / np.sqrt(aside**2 + depth**2))
        near, far = focal * np.tan(alpha - beta), focal * np.tan(alpha + beta)
        other = focal * np.sin(beta) / np.sqrt(np.cos(alpha) ** 2 - np.sin(beta) ** 2)
        out = (near + far) / 2 / np.where(aside > 0, aside, 1.0)
        return np.stack([middle[0] + out * x, middle[1] - out * y], axis=-1), np.sqrt((far - near) / 2 * other)


@dataclass(frozen=True)
class Backdrop:
    """What does not move: a texture, over it a floor below its line, and shadows."""

    texture: str = "bricks"
    """``bricks``, ``cloth``, ``wall`` (white), ``flat`` (in ``colour``)."""
    colour: Sequence[float] = GREEN_AS_RED
    floor: bool = True
    """A table seen from its side, below Y = 0."""
    shadow: str = "floor"
    """``floor`` (below the ball, touches at the contact), ``wall`` (always touching), ``beside`` (apart from it) or empty."""
    depth: float = 0.5


@dataclass(frozen=True)
class RenderedFilm:
    """The file and its truth."""

    path: Path
    times: Array
    """Stamps (F,), s."""
    row_times: dict[str, Array]
    places: dict[str, Array]
    """Centres of the outlines (F, 2) in px, at the ball's row time."""
    radius_px: dict[str, Array]
    spin: dict[str, Array]
    """rad/s (F, 3): X right, Y up, Z to the viewer."""
    motions: dict[str, Motion]
    camera: Camera
    shake: Array
    """px (F, 2), by which the picture is moved."""
    restitution: float | None = None
    radius: float = 0.02
    extra: dict[str, float] = field(default_factory=dict)

    def seen(self, name: str, margin: float = 0.0) -> NDArray[np.bool_]:
        """Frames in which the whole outline is in the picture."""
        r = (self.radius_px[name] + margin)[:, None]
        return np.asarray(
            ((self.places[name] > r) & (self.places[name] < np.array(self.camera.size) - 1 - r)).all(axis=1)
        )


def _ico() -> Array:
    g = (1 + 5**0.5) / 2
    some = np.array([(0, a, b * g) for a in (-1, 1) for b in (-1, 1)], dtype=float)
    found = np.concatenate([some, some[:, [1, 2, 0]], some[:, [2, 0, 1]]])
    return np.asarray(found / np.linalg.norm(found, axis=1, keepdims=True))


def marks(pattern: str) -> tuple[Array, Array]:
    """Directions (n, 3) and half angles (n,) of the marks of a pattern."""
    if pattern == "soccer":
        return _ico(), np.full(12, 0.37)
    if pattern == "spots":
        k = np.arange(8) + 0.5
        z, turn = 1 - 2 * k / 8, np.pi * (1 + 5**0.5) * k
        return np.stack([np.cos(turn) * np.sqrt(1 - z**2), np.sin(turn) * np.sqrt(1 - z**2), z], axis=1), np.full(
            8, 0.22
        )
    if pattern == "mark":
        return np.array([[0.0, 0.0, 1.0], [0.0, 1.0, 0.0], [0.6, -0.8, 0.0], [0.0, -0.6, -0.8]]), np.array(
            [0.5, 0.25, 0.3, 0.4]
        )
    return np.empty((0, 3)), np.empty(0)


def textured(backdrop: Backdrop, camera: Camera, shape: tuple[int, int], over: int, rng: np.random.Generator) -> Array:
    """The encoded background (rows, columns, 3) with ``over`` samples per pixel."""
    h, w = shape
    y, x = np.mgrid[0:h, 0:w].astype(np.float32) / over
    grain = gaussian_filter(rng.normal(size=(h, w)).astype(np.float32), 0.6 * over)
    grain /= grain.std()
    slow = zoom(rng.normal(size=(6, 6)), (h / 6, w / 6), order=1)[:h, :w]
    if backdrop.texture == "bricks":
        high, wide = camera.size[1] / 15, camera.size[1] / 6
        row = np.floor(y / high)
        column = np.floor(x / wide + 0.5 * (row % 2))
        tone = rng.uniform(-0.12, 0.12, size=4096)[((row * 61 + column * 17) % 4096).astype(int)]
        mortar = ((y % high) < 2.0) | (((x / wide + 0.5 * (row % 2)) % 1.0) * wide < 2.0)
        base = np.where(mortar[..., None], [0.68, 0.66, 0.62], np.array([0.5, 0.27, 0.2]) + tone[..., None])
        base = base + 0.02 * grain[..., None]
    elif backdrop.texture == "cloth":
        base = np.array([0.1, 0.42, 0.22]) * (1 + 0.06 * grain + 0.04 * slow)[..., None]
    elif backdrop.texture == "wall":
        base = np.array([0.8, 0.8, 0.77]) * (1 + 0.006 * grain + 0.03 * slow)[..., None]
    else:
        base = np.broadcast_to(np.array(backdrop.colour), (h, w, 3)) + 0.004 * grain[..., None]
    if backdrop.floor:
        line = (h / over - camera.size[1]) / 2 + camera.project(np.array([0.0, 0.0, 0.0]), 1e-3)[0][1]
        wood = np.array([0.52, 0.44, 0.36]) + (0.02 * grain + 0.03 * np.sin(y * 0.9 + 0.02 * x))[..., None]
        base = np.where((y > line)[..., None], wood, base)
    return np.clip(base, 0, 1)


def _shadow(backdrop: Backdrop, camera: Camera, centre: Array, radius: float, x: Array, y: Array) -> Array:
    """What is left of the light at places of the picture, from the outline's centre."""
    if backdrop.shadow in ASIDE:
        aside = ASIDE[backdrop.shadow]
        away = np.hypot(x - centre[0] - 0.8 * aside * radius, y - centre[1] - 0.5 * aside * radius) / radius
        return np.asarray(1 - backdrop.depth / (1 + np.exp((away - 1) * 12)))
    line = camera.project(np.array([0.0, 0.0, 0.0]), 1e-3)[0][1]
    height = max((line - centre[1]) / radius - 1, 0.0)
    wide = radius * (1 + 0.25 * height)
    away = np.hypot((x - centre[0] - 0.25 * radius * (1 + height)) / wide, (y - line - 0.25 * radius) / (0.35 * wide))
    strong = backdrop.depth / (1 + 0.25 * height)
    return np.asarray(np.where(y > line, 1 - strong / (1 + np.exp((away - 1) * 6)), 1.0))


def _bite(
    look: Look, attitude: Array, x: Array, y: Array, camera: Camera, place: Array, radius: float, over: int
) -> tuple[Array, Array]:
    """Coverage (h, w) and linear colour (h, w, 3) of a ball at places (h or 1, w or 1, 3), from line to line."""
    middle = np.array([(camera.size[0] - 1) / 2, (camera.size[1] - 1) / 2])
    u, v = (x - middle[0]) / camera.scale, -(y - middle[1]) / camera.scale
    px, py, pz = place[..., 0] - camera.centre[0], place[..., 1] - camera.centre[1], place[..., 2]
    if camera.distance is None:
        d = (0.0, 0.0, -1.0)
        qx, qy, qz = u - px, v - py, np.zeros_like(u - px)
        size = camera.scale * radius
    else:
        long = np.sqrt(u**2 + v**2 + camera.distance**2)
        d = (u / long, v / long, -camera.distance / long)
        wx, wy, wz = px, py, pz - camera.distance
        b = wx * d[0] + wy * d[1] + wz * d[2]
        qx, qy, qz = b * d[0] - wx, b * d[1] - wy, b * d[2] - wz
        size = camera.scale * radius * camera.distance / float(np.mean(camera.distance - pz))
    rho2 = (qx**2 + qy**2 + qz**2) / radius**2
    cover = np.clip((1 - np.sqrt(rho2)) * size * over + 0.5, 0, 1)
    inside = cover > 0
    root = np.sqrt(np.clip(1 - rho2[inside], 0, None))
    n = np.stack([
        np.broadcast_to(q, inside.shape)[inside] / radius - root * np.broadcast_to(one, inside.shape)[inside]
        for q, one in zip((qx, qy, qz), d, strict=True)
    ], axis=1)  # fmt: skip
    skin = np.broadcast_to(np.array(look.colour) ** camera.gamma, n.shape)
    directions, angles = marks(look.pattern)
    if len(directions):
        # (an edge of the mark is as soft as a sample is large)
        depth = (n @ (attitude @ directions.T) - np.cos(angles)) * size * over / np.sin(angles)
        gone = np.clip(depth + 0.5, 0, 1).max(axis=1)[:, None]
        skin = skin * (1 - gone) + gone * np.array(look.ink) ** camera.gamma
    half = LIGHT + np.array([0, 0, 1.0])
    shine = look.highlight * np.clip(n @ (half / np.linalg.norm(half)), 0, None) ** 40
    colour = np.zeros((*cover.shape, 3))
    colour[inside] = skin * (look.ambient + (1 - look.ambient) * np.clip(n @ LIGHT, 0, None))[:, None] + shine[:, None]
    return cover, colour


def row_phase(x: Array, y: Array, size: tuple[int, int], rotation: int) -> Array:
    """Which share of the readout has passed at a place of the picture shown, turned counterclockwise by 90, ..."""
    w, h = size
    return np.asarray({0: y / h, 90: x / w, 180: (h - 1 - y) / h, 270: (w - 1 - x) / w}[rotation % 360])


def render(
    path: Path,
    balls: Mapping[str, tuple[Motion, float, Look]],
    *,
    camera: Camera | None = None,
    backdrop: Backdrop | None = None,
    frames: int = 50,
    seed: int = 0,
    bit_rate: float | None = 3e6,
    dropped: float = 0.0,
    late: float = 0.0,
    rotation: int = 0,
    begin: float = 0.0,
    codec: str = "libx264",
    options: Mapping[str, str] | None = None,
    restitution: float | None = None,
    disturb: Callable[[Array, int], Array] | None = None,
) -> RenderedFilm:
    """Make a film of balls (motion, radius in m, look) by name.

    ``bit_rate``: None is lossless (apart from the chroma, which is halved). ``dropped`` and ``late`` are shares of frames that are
    not there, or late by a third of the interval; stamps are those of the container, exactly. ``rotation``: degrees
    counterclockwise by which the file is to be turned when shown. The clock starts at ``begin`` of the motion. ``disturb``
    changes linear pictures.
    """  # fmt: skip
    camera, backdrop = camera or Camera(), backdrop or Backdrop()
    rng = np.random.default_rng(seed)
    w, h = camera.size
    over = 2 if min((one[1] for one in balls.values()), default=1.0) * camera.scale > 13 else 3
    ticks = np.round(np.arange(frames) * TICKS / camera.rate)
    ticks += np.round((rng.random(frames) < late) * TICKS / camera.rate / 3)
    keep = rng.random(frames) >= dropped
    keep[:2] = True
    ticks = ticks[keep]
    stamps = ticks / TICKS
    frames = len(ticks)
    margin = int(np.ceil(4 * camera.shake)) + 2 if camera.shake else 0
    sway = np.zeros((frames, 2))
    if camera.shake:
        sway = gaussian_filter(rng.normal(size=(frames, 2)), (0.08 * camera.rate, 0), mode="nearest")
        sway = np.clip(np.round(over * camera.shake * sway / sway.std()) / over, -margin, margin)
    sharp = textured(backdrop, camera, ((h + 2 * margin) * over, (w + 2 * margin) * over), over, rng) ** camera.gamma
    blurred = gaussian_filter(sharp, (camera.psf * over, camera.psf * over, 0))

    def halved(one: Array) -> Array:
        return np.asarray(sum(one[i::over, j::over] for i in range(over) for j in range(over)) / over**2)

    # the time at which the sensor reads the ball's row
    t0 = begin + stamps
    row_times, places, radii = {}, {}, {}
    for name, (motion, radius, _look) in balls.items():
        t = t0.copy()
        for _ in range(60 if camera.readout else 1):
            centre, radii[name] = camera.project(motion.at(t), radius)
            if camera.readout:
                t = t0 + camera.readout * row_phase(*(centre + sway).T, camera.size, rotation)
        row_times[name], places[name] = t - begin, centre + sway
    turns = {name: attitudes(motion, row_times[name] + begin) for name, (motion, _r, _l) in balls.items()}

    still = halved(blurred)
    axis_x = rotation % 180 == 90  # along which the sensor reads
    encode = _Encoder(path, camera, rotation, codec, bit_rate, options)
    for k in range(frames):
        cut = np.round((margin - sway[k]) * over).astype(int)
        window = (slice(cut[1], cut[1] + h * over), slice(cut[0], cut[0] + w * over))
        picture = halved(blurred[window]) if camera.shake else still.copy()
        boxes: list[tuple[list[str], NDArray[np.intp]]] = []
        for name, (motion, radius, _look) in balls.items():
            soft = radii[name][k] + 4 * camera.psf + 3
            if backdrop.shadow:
                reach = (1.4 + 0.8 * ASIDE.get(backdrop.shadow, 1.0)) * radii[name][k]
                x, y = places[name][k]
                y0, y1, x0, x1 = y - reach, y + reach, x - reach, x + reach
                if backdrop.shadow == "floor":
                    line = camera.project(np.zeros(3), 1e-3)[0][1] + sway[k, 1]
                    side = 4 * radii[name][k] + max(line - y, 0)
                    y0, y1, x0, x1 = line, h, x - side, x + side
                y0, y1, x0, x1 = (int(np.clip(v, 0, most)) for v, most in ((y0, h), (y1, h), (x0, w), (x1, w)))
                if y1 > y0 and x1 > x0:
                    yy, xx = np.mgrid[y0:y1, x0:x1].astype(float)
                    left = _shadow(
                        backdrop, camera, places[name][k] - sway[k], radii[name][k], xx - sway[k, 0], yy - sway[k, 1]
                    )
                    picture[y0:y1, x0:x1] *= left[..., None]
            wide = camera.exposure / 2 + camera.readout * soft / (w if axis_x else h)
            some = (
                camera.project(motion.at(row_times[name][k] + begin + wide * np.linspace(-1, 1, 9)), radius)[0]
                + sway[k]
            )
            box = np.array([some.min(axis=0) - soft, some.max(axis=0) + soft + 1]).round().astype(int)
            box = np.clip(box, 0, camera.size)
            if (box[1] > box[0]).all():
                boxes.append(([name], box))
        for names, box in _merged(boxes):
            (x0, y0), (x1, y1) = box
            yy = (np.arange(y0 * over, y1 * over) + 0.5)[:, None] / over - 0.5 - sway[k, 1]
            xx = (np.arange(x0 * over, x1 * over) + 0.5)[None, :] / over - 0.5 - sway[k, 0]
            ground = sharp[window][y0 * over : y1 * over, x0 * over : x1 * over]
            if backdrop.shadow:
                ground = ground.copy()
                for name in names:
                    ground *= _shadow(backdrop, camera, places[name][k] - sway[k], radii[name][k], xx, yy)[..., None]
            lines = row_phase(xx + sway[k, 0], yy + sway[k, 1], camera.size, rotation)
            lines = np.broadcast_to(lines, (1, xx.shape[1]) if axis_x else (yy.shape[0], 1)) * camera.readout
            speed = max(float(np.linalg.norm(balls[name][0].velocity_at(np.array(t0[k])))) for name in names)
            subs = int(np.clip(np.ceil(1.5 * speed * camera.exposure * camera.scale), 4, 64))
            total = np.zeros_like(ground)
            for sub in camera.exposure * ((np.arange(subs) + 0.5) / subs - 0.5):
                now = ground
                for name in names:
                    motion, radius, look = balls[name]
                    # (spin over the exposure and over the readout's rest, from the attitude at the row)
                    attitude = turned(motion.spin_at(np.array(row_times[name][k] + begin + sub)) * sub) @ turns[name][k]
                    cover, colour = _bite(look, attitude, xx, yy, camera, motion.at(t0[k] + lines + sub), radius, over)
                    now = now * (1 - cover[..., None]) + colour * cover[..., None]
                total += now
            soft_picture = halved(
                gaussian_filter(total / subs, (camera.psf * over, camera.psf * over, 0), mode="nearest")
            )
            rim = 1 + int(np.ceil(3 * camera.psf))  # (which the filter has not seen all around)
            a, b = (0 if y0 == 0 else rim), (soft_picture.shape[0] if y1 == h else soft_picture.shape[0] - rim)
            c, d = (0 if x0 == 0 else rim), (soft_picture.shape[1] if x1 == w else soft_picture.shape[1] - rim)
            if b > a and d > c:
                picture[y0 + a : y0 + b, x0 + c : x0 + d] = soft_picture[a:b, c:d]
        if disturb is not None:
            picture = disturb(picture, k)
        light = np.clip(camera.gain * picture, 0, 1.5).astype(np.float32) * np.float32(camera.electrons)
        light += np.sqrt(light + np.float32(camera.read_noise**2)) * rng.standard_normal(light.shape, dtype=np.float32)
        seen = np.clip(light / np.float32(camera.electrons), 0, 1) ** np.float32(1 / camera.gamma)
        if camera.smooth:
            seen = gaussian_filter(seen, (camera.smooth, camera.smooth, 0))
        encode(seen, int(ticks[k]))
    encode.close()
    return RenderedFilm(
        path, stamps, row_times, places, radii,
        {name: motion.spin_at(row_times[name] + begin) for name, (motion, _r, _l) in balls.items()},
        {name: motion for name, (motion, _r, _l) in balls.items()}, camera, sway, restitution,
        next((one[1] for one in balls.values()), 0.0),
    )  # fmt: skip


def _merged(boxes: list[tuple[list[str], NDArray[np.intp]]]) -> list[tuple[list[str], NDArray[np.intp]]]:
    """Boxes of which none overlaps another: those that do are one."""
    found: list[tuple[list[str], NDArray[np.intp]]] = []
    for names, box in boxes:
        mine, edges = list(names), box.copy()
        for other in [one for one in found if (one[1][0] < edges[1]).all() and (one[1][1] > edges[0]).all()]:
            found = [one for one in found if one is not other]
            mine = other[0] + mine
            edges = np.array([np.minimum(other[1][0], edges[0]), np.maximum(other[1][1], edges[1])])
        found.append((mine, edges))
    return found


class _Encoder:
    """Writes encoded pictures (0 to 1) with stamps in ticks."""

    def __init__(
        self, path: Path, camera: Camera, rotation: int, codec: str, bit_rate: float | None, options: Mapping[str, str] | None
    ) -> None:  # fmt: skip
        self.file = av.open(str(path), "w")
        lossless = {"qp": "0"} if bit_rate is None else {}
        self.stream: Any = self.file.add_stream(codec, rate=Fraction(camera.rate).limit_denominator(1001))
        self.turns = rotation // 90 % 4
        w, h = camera.size if self.turns % 2 == 0 else camera.size[::-1]
        self.stream.width, self.stream.height, self.stream.pix_fmt = w, h, "yuv420p"
        self.stream.codec_context.thread_count = 1
        self.stream.codec_context.time_base = Fraction(1, TICKS)
        if codec in ("libx264", "libx265"):
            # (what x264 looks ahead depends on more than the pictures: from one process to the next it writes other bits)
            ahead = {"mbtree": "0", "rc-lookahead": "0"} if codec == "libx264" else {}
            self.stream.options = {"preset": "veryfast", **ahead, **lossless, **(options or {})}
        if bit_rate is not None:
            self.stream.codec_context.bit_rate = int(bit_rate)
        if self.turns:
            self.stream.set_display_rotation(90 * self.turns if self.turns < 3 else -90)

    def __call__(self, picture: Array, ticks: int) -> None:
        rgb = np.ascontiguousarray(np.rot90((picture * 255 + 0.5).astype(np.uint8), -self.turns))
        frame = av.VideoFrame.from_ndarray(rgb, format="rgb24")
        frame.pts, frame.time_base = ticks, Fraction(1, TICKS)
        for packet in self.stream.encode(frame):
            self.file.mux(packet)

    def close(self) -> None:
        for packet in self.stream.encode():
            self.file.mux(packet)
        self.file.close()


# --- films ------------------------------------------------------------------------------------------------------------


def bouncing_film(
    path: Path, *, restitution: float = 0.78, radius: float = 0.02, look: Look | None = None, **given: Any
) -> RenderedFilm:
    """A ball bounces along in front of a wall, filmed from the side: by default 320 x 240 px, r = 10 px, 50 frames at 60/s.

    What :func:`bounces`, :class:`Camera` and :class:`Backdrop` take may be given beside what :func:`render` takes.
    """
    motion = {
        k: given.pop(k) for k in ("height", "x", "speed", "spin", "friction", "gravity", "start", "drop") if k in given
    }
    lens = {k: given.pop(k) for k in Camera.__dataclass_fields__ if k in given}
    behind = {k: given.pop(k) for k in Backdrop.__dataclass_fields__ if k in given}
    scale = lens.pop("scale", 500.0)
    size = lens.get("size", (320, 240))
    high = size[1] / scale
    lens = {"centre": (0.0, 0.42 * high), "scale": scale, **lens}
    wide = size[0] / scale
    motion = {"height": 0.72 * high, "x": -0.38 * wide, "speed": 0.9 * wide * 60 / 50 / 1.2, **motion}
    return render(
        path, {"ball": (bounces(restitution, radius=radius, **motion), radius, look or Look())}, camera=Camera(**lens),
        backdrop=Backdrop(**behind), restitution=restitution, **given,
    )  # fmt: skip


def big(**given: Any) -> dict[str, Any]:
    """Arguments of :func:`bouncing_film` for 720p, r = 20 px, 120 frames at 60/s, 12 Mbit/s."""
    return {
        "size": (1280, 720), "scale": 1000.0, "frames": 119, "bit_rate": 12e6, "height": 0.5, "x": -0.55, "speed": 0.55, **given,
    }  # fmt: skip


def three_balls_film(path: Path, *, seed: int = 0, radius: float = 0.03, **given: Any) -> RenderedFilm:
    """White, red and yellow on cloth from above: one is shot at another, which meets the third; drawn from the seed."""
    rng = np.random.default_rng(1000 + seed)
    lens = {k: given.pop(k) for k in Camera.__dataclass_fields__ if k in given}
    lens = {"scale": 270.0, "centre": (0.0, 0.0), "exposure": 1 / 250, **lens}
    half = np.array(lens.get("size", (320, 240))) / lens["scale"] / 2
    while True:
        first = np.array([-0.75 * half[0], rng.uniform(-0.3, 0.3) * half[1]])
        second = np.array([rng.uniform(-0.1, 0.15) * half[0], rng.uniform(-0.4, 0.4) * half[1]])
        third = np.array([rng.uniform(0.35, 0.7) * half[0], rng.uniform(-0.5, 0.5) * half[1]])
        toward = second + np.array([0, rng.uniform(-1.2, 1.2) * radius]) - first
        velocity = rng.uniform(0.9, 1.5) * toward / np.linalg.norm(toward)
        motions = collide([first, second, third], [velocity, (0, 0), (0, 0)], radius=radius, bounds=half, duration=1.6)
        way = [np.ptp(one.at(np.linspace(0, 1.2, 9)), axis=0).max() for one in motions]
        if min(way) > 2 * radius:
            break
    looks = given.pop("looks", (Look(WHITE, "plain"), Look(RED, "plain"), Look(YELLOW, "plain")))
    backdrop = given.pop("backdrop", Backdrop("cloth", floor=False, shadow="wall", depth=0.3))
    given = {"frames": 80, **given}
    return render(
        path, {name: (one, radius, look) for name, one, look in zip(("white", "red", "yellow"), motions, looks, strict=True)},
        camera=Camera(**lens), backdrop=backdrop, seed=seed, **given,
    )  # fmt: skip


def empty_film(path: Path, **given: Any) -> RenderedFilm:
    """A wall and a table, and nothing that moves."""
    lens = {k: given.pop(k) for k in Camera.__dataclass_fields__ if k in given}
    return render(path, {}, camera=Camera(**{"scale": 500.0, "centre": (0.0, 0.2), **lens}), **given)


def two_alike_film(path: Path, *, restitution: float = 0.78, radius: float = 0.02, **given: Any) -> RenderedFilm:
    """Two balls that look the same, and bounce beside one another."""
    lens = {k: given.pop(k) for k in Camera.__dataclass_fields__ if k in given}
    balls = {
        "left": (bounces(restitution, 0.33, -0.24, 0.08, radius=radius), radius, Look()),
        "right": (bounces(restitution, 0.28, 0.24, -0.08, radius=radius), radius, Look()),
    }
    return render(
        path, balls, camera=Camera(**{"scale": 500.0, "centre": (0.0, 0.2), **lens}), restitution=restitution, **given
    )
