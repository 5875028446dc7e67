"""What a person has to see of a tracked film: frames around the ball with its outline, its path, residuals; and the film itself."""

from __future__ import annotations

import os
from collections.abc import Callable
from fractions import Fraction
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from carom.files import as_path, atomic_path, import_optional, require_writable
from carom.plot.style import COLOURS, GREY, INK, PALE, drawn, literal, new_figure
from carom.tracks.track import position_noise
from carom.tracks.video.reading import TrackedFilm, crops, open_film

if TYPE_CHECKING:
    from matplotlib.figure import Figure

Array = NDArray[np.float64]
SHOWN, COLUMNS = 24, 6  # frames around the ball
WIDTH, CELL, LABEL, RESIDUALS = 5.6, 0.88, 0.2, 1.35  # inches
MOST_RADII = 4.0  # of a crop, from its middle
LINE, RED = "#00e5ff", "#e8112d"  # of an outline; of one that does not fit
WINDOW = 6  # frames of a parabola
MOST_BACKGROUND = 560  # px, of the picture behind the path


def plot_film(film: TrackedFilm, file: str | os.PathLike[str] | None = None) -> Figure:
    """Draw the contact sheet of a tracked film: 24 frames around the balls with their outlines, the path over the background, and
    the distances from a smooth path against time.

    Parameters
    ----------
    film : TrackedFilm
        From :func:`carom.track_film`. Its file is read again.
    file : str or path, optional
        File to write, .svg, .pdf or .png.

    Returns
    -------
    matplotlib.figure.Figure
        Frames whose outline does not fit are red; those that are not used for another reason have a dashed outline.

    Raises CaromError: a file that cannot be written or read, or Matplotlib is missing.
    """
    return drawn(lambda: _sheet(film), file)


def _sheet(film: TrackedFilm) -> Figure:
    chosen = _chosen(film)
    pictures = {
        (ball, crop.frame): crop for ball, frames in chosen.items() for crop in crops(film, ball, frames.tolist())
    }
    rows = max(-(-len(pictures) // COLUMNS), 1)
    high, wide = film.background.shape[:2]
    path = (WIDTH - 0.2) * min(high / wide, 1.0)
    top = 0.42 + rows * (CELL + LABEL)
    height = top + 0.3 + path + 0.35 + RESIDUALS + 0.45
    figure = new_figure(WIDTH, height)
    head = f"{literal(film.path.name)}: {len(film.times):,} frames, radius {film.radius_px:.3g} px"
    head += f", exposure {1e3 * film.exposure:.3g} ms"
    figure.text(0.02, 1 - 0.08 / height, head, fontsize=9, color=INK, va="top")
    flagged = int(film.flagged.sum())
    said = f"red: the outline does not fit ({flagged} in all, left out); dashed: not used, a contact is near"
    figure.text(0.02, 1 - 0.24 / height, said, fontsize=8, color=RED if flagged else GREY, va="top")
    step = (WIDTH - 0.1) / COLUMNS
    for k, ((ball, frame), crop) in enumerate(pictures.items()):
        left = 0.05 + step * (k % COLUMNS) + (step - CELL) / 2
        bottom = height - 0.42 - (k // COLUMNS) * (CELL + LABEL) - CELL
        axes = figure.add_axes((left / WIDTH, bottom / height, CELL / WIDTH, CELL / height))
        _cell(axes, film, ball, frame, crop)
    axes = figure.add_axes((0.1 / WIDTH, (height - top - 0.3 - path) / height, (WIDTH - 0.2) / WIDTH, path / height))
    _path(axes, film)
    axes = figure.add_axes((0.6 / WIDTH, 0.42 / height, (WIDTH - 0.7) / WIDTH, RESIDUALS / height))
    _residuals(axes, film)
    return figure


def _chosen(film: TrackedFilm) -> dict[str, NDArray[np.intp]]:
    """Return the frames (n,) of each ball to show: flagged ones, those where the path bends most, others evenly over the film."""
    found = {}
    for ball, place in film.places.items():
        seen = np.flatnonzero(np.isfinite(place).all(axis=1))
        count = min(max(SHOWN // len(film.places), 3), len(seen))
        bends = np.zeros(len(seen))
        if len(seen) > 2:
            t, x = film.times[seen], place[seen]
            v = np.diff(x, axis=0) / np.diff(t)[:, None]
            bends[1:-1] = np.hypot(*np.diff(v, axis=0).T)
        bad = seen[film.flagged[seen]]
        bad = bad[np.unique(np.linspace(0, len(bad) - 1, min(count // 4, len(bad))).astype(int))]
        turns = seen[np.argsort(-bends, kind="stable")[: count // 3]]
        special = np.union1d(bad, turns)
        rest = np.setdiff1d(seen, special)
        rest = rest[np.unique(np.linspace(0, len(rest) - 1, max(min(count - len(special), len(rest)), 0)).astype(int))]
        found[ball] = np.union1d(special, rest)
    return found


def outline_of(film: TrackedFilm, ball: str, frame: int) -> Array:
    """Return the outline (n, 2) px of a ball in a frame: a circle, moved along the way of the exposure."""
    turn = np.linspace(0, 2 * np.pi, 73)
    rim = np.stack([np.cos(turn), np.sin(turn)], axis=1)
    way = np.nan_to_num(film.velocity_px[ball][frame]) * film.exposure
    return np.asarray(film.places[ball][frame] + film.radius_px * rim + np.sign(rim @ way)[:, None] * way / 2)


def _used(film: TrackedFilm, ball: str) -> NDArray[np.bool_]:
    seen = np.isfinite(film.places[ball]).all(axis=1)
    return np.asarray(seen & ~film.flagged & film.used.get(ball, seen))


def _cell(axes: Any, film: TrackedFilm, ball: str, frame: int, crop: Any) -> None:
    (x, y), (left, top) = film.places[ball][frame], crop.corner
    h, w = crop.pixels.shape[:2]
    way = np.hypot(*np.nan_to_num(film.velocity_px[ball][frame])) * film.exposure / 2
    half = min(1.5 * film.radius_px + way, MOST_RADII * film.radius_px)
    axes.imshow(
        crop.pixels, extent=(left - 0.5, left + w - 0.5, top + h - 0.5, top - 0.5), interpolation="nearest", rasterized=True
    )  # fmt: skip
    bad = bool(film.flagged[frame])
    dashed = not bad and not _used(film, ball)[frame]
    axes.plot(*outline_of(film, ball, frame).T, color=RED if bad else LINE, lw=0.9, ls=(0, (3, 2)) if dashed else "-")
    axes.set(xlim=(x - half, x + half), ylim=(y + half, y - half), xticks=[], yticks=[], facecolor=PALE)
    for spine in axes.spines.values():
        spine.set(visible=True, color=RED if bad else GREY, lw=2.0 if bad else 0.5)
    name = f"{literal(ball)} " if len(film.places) > 1 else ""
    axes.set_xlabel(f"{name}{film.times[frame]:.3f} s", fontsize=8, labelpad=2, color=RED if bad else INK)


def _path(axes: Any, film: TrackedFilm) -> None:
    high, wide = film.background.shape[:2]
    every = max(-(-max(high, wide) // MOST_BACKGROUND), 1)
    shown = film.background[::every, ::every].astype(np.float32)
    # (paler, so that points stand out on it)
    axes.imshow(
        (0.5 * shown + 0.5 * 255).astype(np.uint8), extent=(-0.5, wide - 0.5, high - 0.5, -0.5), rasterized=True
    )
    for k, (ball, place) in enumerate(film.places.items()):
        used = _used(film, ball)
        rest = np.isfinite(place).all(axis=1) & ~used
        axes.plot(*place[used].T, "o", ms=2.2, mec="none", color=COLOURS[k % len(COLOURS)], label=literal(ball))
        axes.plot(*place[rest & ~film.flagged].T, "o", ms=2.6, mfc="none", mew=0.6, mec=COLOURS[k % len(COLOURS)])
        axes.plot(*place[rest & film.flagged].T, "x", ms=3.5, mew=0.9, color=RED)
    axes.set(xlim=(-0.5, wide - 0.5), ylim=(high - 0.5, -0.5), xticks=[], yticks=[])
    axes.set_title("Path" + " (red: flagged)" * bool(film.flagged.any()), loc="left", fontsize=9)
    if len(film.places) > 1:
        axes.legend(loc="lower right", bbox_to_anchor=(1.0, 1.0), ncols=3, frameon=False, fontsize=8, borderpad=0.1)


def smooth_residuals(t: Array, x: Array) -> Array:
    """Return the distances (n, 2) of places from a parabola through six frames in a row, of those with the frame the best.

    Beside a contact the best lie on one side of it.
    """
    if len(t) < WINDOW:
        return np.full(x.shape, np.nan)
    found, least = np.zeros(x.shape), np.full(x.shape, np.inf)
    for k in range(len(t) - WINDOW + 1):
        s = t[k : k + WINDOW] - t[k : k + WINDOW].mean()
        design = np.stack([np.ones(WINDOW), s, s**2], axis=1)
        part = x[k : k + WINDOW]
        gap = (part - design @ np.linalg.lstsq(design, part, rcond=None)[0]) * np.sqrt(WINDOW / (WINDOW - 3))
        size = np.square(gap).sum(axis=0)
        better = np.broadcast_to(size, gap.shape) < least[k : k + WINDOW]
        found[k : k + WINDOW][better] = gap[better]
        least[k : k + WINDOW][better] = np.broadcast_to(size, gap.shape)[better]
    return found


def _residuals(axes: Any, film: TrackedFilm) -> None:
    sizes, noise = [], []
    interval = float(np.median(np.diff(film.times))) if len(film.times) > 1 else np.nan
    for k, (ball, place) in enumerate(film.places.items()):
        used = _used(film, ball)
        gap = smooth_residuals(film.times[used], place[used])
        sizes.append(np.abs(gap[np.isfinite(gap)]))
        noise.append(position_noise(film.times[used], place[used], interval))
        for part, marker in zip(gap.T, "ox", strict=True):
            axes.plot(
                film.times[used], part, marker, ms=2.6, mew=0.8 * (marker == "x"), color=COLOURS[k % len(COLOURS)]
            )
    most = 1.5 * max(float(np.quantile(np.concatenate([*sizes, [0.0]]), 0.98)), 0.05)
    said = " and ".join(
        filter(None, [", ".join(f"{one:.2g}" for one in noise[:-1]), *(f"{one:.2g}" for one in noise[-1:])])
    )
    axes.text(1.0, 1.03, f"noise {said} px", transform=axes.transAxes, ha="right", va="bottom", fontsize=8, color=INK)
    for t in film.times[film.flagged]:
        axes.axvline(t, ymax=0.08, color=RED, lw=1.0)
    axes.axhline(0, color=GREY, lw=0.5, zorder=0)
    span = film.times[[0, -1]] if len(film.times) else np.array([0.0, 1.0])
    room = 0.02 * max(float(np.ptp(span)), 1e-9)
    axes.set(ylim=(-most, most), xlim=(span[0] - room, span[1] + room), xlabel="time, s", ylabel="px")
    axes.set_title("From a smooth path (o across, x down)", loc="left", fontsize=9)


# --- the film with the outlines ---------------------------------------------------------------------------------------


def write_overlay(
    film: TrackedFilm, file: str | os.PathLike[str], progress: Callable[[float, float, str], None] | None = None
) -> None:
    """Write the film again as .mp4, with the outlines of the balls and where they were; flagged outlines are red.

    Frames keep the times of the film. Raises CaromError for a file that cannot be written or read.
    """
    path = as_path("overlay", file)
    require_writable(path, [".mp4"])
    av, source = import_optional("av", "films"), open_film(film.path)
    clock = Fraction(1, 90_000)
    ticks = np.round((film.times - film.times[0]) / float(clock)).astype(int)
    with atomic_path(path) as part, av.open(str(part), "w", format="mp4") as container:
        rate = len(film.times) / max(float(np.ptp(film.times)), 1e-3)
        stream = container.add_stream("libx264", rate=max(round(rate), 1), options={"crf": "20", "preset": "veryfast"})
        stream.width, stream.height, stream.pix_fmt = source.width, source.height, "yuv420p"
        stream.codec_context.time_base = stream.time_base = clock
        for frame in source.frames():
            k = frame.number
            if k >= len(film.times):
                break
            picture = source.to_rgb(frame.y, frame.u, frame.v)
            _draw(picture, film, k)
            made = av.VideoFrame.from_ndarray(np.ascontiguousarray(picture), format="rgb24")
            made.pts, made.time_base = int(ticks[k]), clock
            container.mux(stream.encode(made))
            if progress is not None:
                progress(k + 1, len(film.times), "overlay")
        container.mux(stream.encode())


def _draw(picture: NDArray[np.uint8], film: TrackedFilm, frame: int) -> None:
    """Draw into a picture (h, w, 3): the last second's places as points, and the outlines as dots two pixels wide."""
    h, w = picture.shape[:2]
    since = (film.times <= film.times[frame]) & (film.times > film.times[frame] - 1)
    for k, (ball, place) in enumerate(film.places.items()):
        colour = [int(COLOURS[k % len(COLOURS)][i : i + 2], 16) for i in (1, 3, 5)]
        marks: list[tuple[Array, list[int]]] = [(place[since & _used(film, ball)], colour)]
        if np.isfinite(place[frame]).all():
            rim = outline_of(film, ball, frame)
            fine = np.linspace(0, len(rim) - 1, int(8 * film.radius_px) + 73)
            rim = np.stack([np.interp(fine, np.arange(len(rim)), part) for part in rim.T], axis=1)
            marks.append((rim, [232, 17, 45] if film.flagged[frame] else [0, 229, 255]))
        for points, its in marks:
            for dx, dy in ((0, 0), (1, 0), (0, 1), (1, 1)):
                x, y = (np.floor(points + np.array([dx, dy]))).astype(int).T
                there = (x >= 0) & (x < w) & (y >= 0) & (y < h)
                picture[y[there], x[there]] = its
