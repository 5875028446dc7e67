"""Figures of tracks: what was measured, laws of mechanics that a trajectory violates, and the contact sheet of a film."""

from __future__ import annotations

import os
from collections.abc import Callable
from fractions import Fraction
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from carom.files import as_path, atomic_path, import_optional, require_writable
from carom.plot.style import COLOURS, GREY, INK, PALE, drawn, literal, new_figure, style
from carom.tracks.contact import TrackContact
from carom.tracks.films import usable_stages
from carom.tracks.measurement import Measured
from carom.tracks.track import Track, position_noise
from carom.tracks.video.reading import TrackedFilm, crops, open_film

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from carom.tracks.least_squares import ContactFit
    from carom.tracks.verdicts import Judgement


Array = NDArray[np.float64]
BLUE, ORANGE = COLOURS[:2]
MAX_FRAMES_SHOWN = 12.0
MIN_WIDTH_SHARE, MAX_TICKS = 0.4, 6  # of the paths: the narrow side as a share of the long one, ticks of the long one
LINE_TOP = 0.87  # height of the lines at contacts, below the legend, as a fraction of the panel


def plot_tracks(measured: Measured) -> Figure:
    """Draw measured tracks: paths with walls and contacts, the speed of the ball with most contacts, and residuals.

    Parameters
    ----------
    measured : Measured
        From :func:`carom.tracks.measure`.

    Returns
    -------
    matplotlib.figure.Figure

    Examples
    --------
    >>> import numpy as np
    >>> from carom.plot.tracks import plot_tracks
    >>> from carom.tracks import Settings, Track, measure
    >>> t = np.arange(40) / 200
    >>> y = np.where(t < 0.1, 2 * (0.1 - t), 1.6 * (t - 0.1)) - 9.81 / 2 * (t - 0.1) ** 2
    >>> ball = Track("ball", t, np.stack([0.5 * t, y], axis=-1))
    >>> figure = plot_tracks(measure([ball], Settings(view="side", noise=1e-4)))
    >>> len(figure.axes)
    3
    """
    with style():
        figure = new_figure(9.0, 5.6)
        figure.set_layout_engine("constrained")
        grid = figure.add_gridspec(2, 2, width_ratios=[1.0, 1.05])
        fits = [one.fit for one in measured.contacts if one.fit is not None]
        _plot_paths(figure.add_subplot(grid[:, 0]), measured)
        _plot_speeds(figure.add_subplot(grid[0, 1] if fits else grid[:, 1]), measured)
        if fits:
            _plot_residuals(figure.add_subplot(grid[1, 1]), measured, fits)
    return figure


def _plot_paths(axes: Any, measured: Measured) -> None:
    many = len(measured.tracks) > len(COLOURS)
    names = list(dict.fromkeys(track.name for track in measured.tracks))
    for track in measured.tracks:
        colour = COLOURS[names.index(track.name) % len(COLOURS)]
        axes.plot(*track.position.T, "-", color=colour, lw=0.4 if many else 0.6, alpha=0.35 if many else 0.8, zorder=2)
        if not many:
            axes.plot(*track.position.T, "o", color=colour, ms=2.0, mec="none", zorder=3, label=literal(track.name))
    x = np.concatenate([track.position for track in measured.tracks])
    low, high = x.min(axis=0), x.max(axis=0)
    reach = float((high - low).max())
    for wall in measured.walls:
        along = np.array([-wall.normal[1], wall.normal[0]])
        middle = np.array(wall.point) + along * (((low + high) / 2 - wall.point) @ along)
        half = abs((high - low) @ np.abs(along)) / 2 + 0.02 * reach
        ends = np.stack([middle - half * along, middle + half * along])
        label = "where the centre turns" if wall is measured.walls[0] else None
        axes.plot(*ends.T, color=INK, lw=1.4, zorder=1, label=label)
    usable = [one for one in measured.contacts if one.fit is not None and usable_stages(one, "best", True)[0]]
    if usable:
        axes.plot(
            *np.array([_contact_position(one) for one in usable]).T,
            "o",
            ms=6,
            mfc="none",
            mec=INK,
            mew=0.9,
            zorder=5,
            label="contact, measured",
        )
    others = [
        place
        for one in measured.contacts
        if one not in usable and (place := _nearest_position(measured, one)) is not None
    ]
    if others:
        axes.plot(*np.array(others).T, "x", ms=5, color=GREY, mew=0.9, zorder=4, label="contact, not measured")
    side = measured.view == "side"
    axes.set(aspect="equal", xlabel="x, m", ylabel="height, m" if side else "y, m")
    axes.set_title("From the side" if side else "From above", loc="left")
    _widen_limits(axes)
    handles, _labels = axes.get_legend_handles_labels()
    if 0 < len(handles) <= 8:
        axes.legend(
            loc="lower center", bbox_to_anchor=(0.5, 1.04), ncols=3, frameon=False, fontsize=7.5, columnspacing=1.2
        )


def _widen_limits(axes: Any) -> None:
    """Set limits with a margin; a track that is nearly a line gets room beside it, and only as many ticks as fit there."""
    from matplotlib.ticker import MaxNLocator

    low, high = np.array(axes.dataLim.min), np.array(axes.dataLim.max)
    reach = float((high - low).max()) or 1.0
    half = np.maximum((high - low) / 2 + 0.05 * reach, MIN_WIDTH_SHARE * reach / 2)
    for axis, limits, middle, room in zip(
        (axes.xaxis, axes.yaxis), (axes.set_xlim, axes.set_ylim), (low + high) / 2, half, strict=True
    ):
        limits(middle - room, middle + room)
        axis.set_major_locator(MaxNLocator(max(round(MAX_TICKS * room / half.max()), 2)))


def _contact_position(one: TrackContact) -> Array:
    assert one.fit is not None
    return np.asarray(one.wall.back(np.array([[one.fit["away"], one.fit["along"]]]))[0])


def _nearest_position(measured: Measured, one: TrackContact) -> Array | None:
    """Return the position in the frame nearest to a contact that was not fitted."""
    for track in measured.tracks:
        if (track.group, track.name) == (one.group, one.track):
            return np.asarray(track.position[int(np.argmin(np.abs(track.time - one.time)))])
    return None


def _track_with_most_contacts(measured: Measured) -> tuple[Track, list[TrackContact]]:
    """Return the track with the most measured contacts, and these."""
    counts: dict[tuple[str, str], list[TrackContact]] = {}
    for one in measured.contacts:
        counts.setdefault((one.group, one.track), []).append(one)

    def rank(track: Track) -> int:
        return sum(one.fit is not None for one in counts.get((track.group, track.name), []))

    track = max(measured.tracks, key=rank)
    return track, [one for one in counts.get((track.group, track.name), []) if one.fit is not None]


def _plot_speeds(axes: Any, measured: Measured) -> None:
    track, contacts = _track_with_most_contacts(measured)
    step = np.diff(track.time)
    good = step < 1.5 * measured.interval
    middle = (track.time[1:] + track.time[:-1]) / 2
    speed = np.hypot(*np.diff(track.position, axis=0).T) / np.maximum(step, 1e-9)
    axes.plot(middle[good], speed[good], "o", ms=1.8, color=GREY, mec="none", label="between frames")
    label: str | None = "fitted motion"
    for one in contacts:
        fit = one.fit
        assert fit is not None
        for t in (np.linspace(fit.time[0], fit["t"] - 1e-6, 60), np.linspace(fit["t"] + 1e-6, fit.time[-1], 120)):
            path = fit.position(t)
            rate = np.hypot(*np.diff(path, axis=0).T) / np.diff(t)
            axes.plot((t[1:] + t[:-1]) / 2, rate, color=ORANGE, lw=1.2, label=label)
            label = None
        axes.axvline(fit["t"], ymax=LINE_TOP, color=INK, lw=0.5, ls=(0, (2, 2)))
    label_of_track = " ".join(filter(None, (track.group, track.name)))
    axes.set_title(f"Speed of {literal(label_of_track)}", loc="left")
    axes.set(
        xlabel="time, s",
        ylabel="speed, m/s",
        ylim=(0, 1.25 * float(np.quantile(speed[good], 0.99)) if good.any() else None),
    )
    if contacts:
        first, last = contacts[0].fit, contacts[-1].fit
        assert first is not None
        assert last is not None
        room = 0.05 * (last.time[-1] - first.time[0])
        axes.set_xlim(first.time[0] - room, last.time[-1] + room)
    axes.legend(loc="upper right", frameon=False, fontsize=7.5, ncols=2)


def _plot_residuals(axes: Any, measured: Measured, fits: list[ContactFit]) -> None:
    axes.axhspan(-1e3 * measured.noise, 1e3 * measured.noise, color="#eceae4", zorder=0, lw=0)
    frames = np.concatenate([(fit.time - fit["t"]) / measured.interval for fit in fits])
    gap = 1e3 * np.concatenate([fit.residuals for fit in fits])
    near = np.abs(frames) < MAX_FRAMES_SHOWN
    axes.plot(frames[near], gap[near, 0], "o", ms=2.2, color=BLUE, mec="none", label="normal to the wall")
    axes.plot(frames[near], gap[near, 1], "o", ms=2.2, color=ORANGE, mec="none", alpha=0.7, label="along the wall")
    most = max(4.5e3 * measured.noise, 1.1 * float(np.quantile(np.abs(gap[near]), 0.995)))
    axes.set_ylim(-most, 1.35 * most)
    axes.legend(loc="upper right", frameon=False, fontsize=7.5, ncols=2)
    axes.axvline(0, ymax=LINE_TOP, color=INK, lw=0.5, ls=(0, (2, 2)))
    axes.set_title(f"Residuals (measured − fitted); band: noise {1e3 * measured.noise:.2g} mm", loc="left")
    axes.set(xlabel="frames from the contact", ylabel="residual, mm", xlim=(-MAX_FRAMES_SHOWN, MAX_FRAMES_SHOWN))


# ----------------------------------------------------------------------------------------------------
# The laws of mechanics that a trajectory violates, in a strip each: when, and by how many error bars.


WIDTH, STRIP, TOP, BOTTOM = 6.2, 0.9, 0.08, 0.6  # inches: the figure, a law, and the room above and below all
LEAST_SPAN = 1e-9  # s, of times


def plot_judgement(found: Judgement, file: str | os.PathLike[str] | None = None) -> Figure:
    """Draw what :func:`carom.tracks.judge` found: a strip per law that is violated, with a dot per violation.

    Parameters
    ----------
    found : Judgement
    file : str or path, optional
        File to write, .svg, .pdf or .png.

    Returns
    -------
    matplotlib.figure.Figure
        Sizes are in physical units, with bars of one standard error; of each law the balls of the clearest violation are named.

    Raises CaromError: a file that cannot be written, or Matplotlib is missing.

    Examples
    --------
    >>> import numpy as np
    >>> from carom import plot
    >>> from carom.tracks import judge
    >>> t = np.arange(60) / 200
    >>> falling = {"t": t, "x": t, "y": 0 * t, "z": 2.0 - 0.5 * 9.0 * t**2}  # g = 9.0 m/s^2
    >>> figure = plot.plot_judgement(judge(falling, radius=0.03))
    >>> [axes.get_title(loc="right") for axes in figure.axes]  # gravity
    ['1 of 1']
    """
    return drawn(lambda: _figure(found), file)


SIZES = {  # of violations: what it is, its unit, and how many of these are in the SI unit
    "penetration": ("depth", "mm", 1e3), "momentum": ("momentum", "N s", 1.0), "energy": ("energy", "J", 1.0),
    "gravity": ("acceleration", "m/s²", 1.0),
}  # fmt: skip


def _figure(found: Judgement) -> Figure:
    checked = {law: count for law, count in found.checked.items() if count}  # (penetration always is)
    laws = [law for law in checked if found.of(law)]
    height = STRIP * max(len(laws), 1) + TOP + BOTTOM
    figure = new_figure(WIDTH, height)
    strips = figure.subplots(max(len(laws), 1), 1, sharex=True, squeeze=False)[:, 0]
    figure.subplots_adjust(left=0.12, right=0.98, top=1 - (TOP + 0.2) / height, bottom=BOTTOM / height, hspace=0.65)
    first, last = found.times
    room = 0.02 * max(last - first, LEAST_SPAN)
    strips[0].set_xlim(first - room, last + room)
    for axes, law in zip(strips, laws, strict=False):
        axes.set_title(f"{law}: {found.laws[law]}", loc="left", fontsize=8, color=INK, pad=3)
        axes.set_title(f"{len(found.of(law)):,} of {checked[law]:,}", loc="right", fontsize=8, color=INK, pad=3)
        _dots(axes, found, law)
    if not laws:
        strips[0].set(yticks=[], title="no violation")
    strips[-1].set_xlabel("time, s")
    kept = ", ".join(f"{law} ({count:,})" for law, count in checked.items() if law not in laws)
    rest = ", ".join(law for law in found.laws if law not in checked)
    words = [f"{what}: {names}" for what, names in (("not violated", kept), ("not checked", rest)) if names]
    figure.text(0.98, 0.06 / height, "; ".join(words), fontsize=8, color=GREY, ha="right")
    return figure


def _dots(axes: Any, found: Judgement, law: str) -> None:
    what, unit, factor = SIZES.get(law, ("size", "", 1.0))
    times, sizes, errors = np.array([(one.time, factor * one.size, factor * one.error) for one in found.of(law)]).T
    axes.errorbar(times, sizes, errors, fmt="o", ms=4, mfc=INK, mec="white", mew=0.4, ecolor=GREY, elinewidth=0.8)
    axes.set_ylim(0, 1.3 * float((sizes + errors).max()) or 1.0)
    axes.set_ylabel(f"{what}, {unit}".rstrip(", "))
    worst = found.worst(law)
    if worst is not None:
        late = worst.time > sum(found.times) / 2
        axes.annotate(
            literal(" and ".join(worst.balls)), (worst.time, factor * worst.size), xytext=(-5 if late else 5, 3),
            textcoords="offset points", ha="right" if late else "left", va="bottom", fontsize=8, color=INK,
        )  # fmt: skip


# ----------------------------------------------------------------------------------------------------
# What a person has to see of a tracked film: frames around the ball with its outline, its path, residuals; and the film itself.

SHOWN, COLUMNS = 24, 6  # frames around the ball
SHEET_WIDTH, CELL, LABEL, RESIDUALS = 5.6, 0.88, 0.2, 1.35  # inches
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
    path = (SHEET_WIDTH - 0.2) * min(high / wide, 1.0)
    top = 0.42 + rows * (CELL + LABEL)
    height = top + 0.3 + path + 0.35 + RESIDUALS + 0.45
    figure = new_figure(SHEET_WIDTH, height)
    head = f"{literal(film.path.name)}: {len(film.times):,} frames, radius {film.radius_px:.3g} px"
    head += f", exposure {1e3 * film.exposure:.3g} ms"
    figure.text(0.02, 1 - 0.08 / height, head, fontsize=9, color=INK, va="top")
    flagged = int(film.flagged.sum())
    said = f"red: the outline does not fit ({flagged} in all, left out); dashed: not used, a contact is near"
    figure.text(0.02, 1 - 0.24 / height, said, fontsize=8, color=RED if flagged else GREY, va="top")
    step = (SHEET_WIDTH - 0.1) / COLUMNS
    for k, ((ball, frame), crop) in enumerate(pictures.items()):
        left = 0.05 + step * (k % COLUMNS) + (step - CELL) / 2
        bottom = height - 0.42 - (k // COLUMNS) * (CELL + LABEL) - CELL
        axes = figure.add_axes((left / SHEET_WIDTH, bottom / height, CELL / SHEET_WIDTH, CELL / height))
        _cell(axes, film, ball, frame, crop)
    axes = figure.add_axes(
        (0.1 / SHEET_WIDTH, (height - top - 0.3 - path) / height, (SHEET_WIDTH - 0.2) / SHEET_WIDTH, path / height)
    )
    _path(axes, film)
    axes = figure.add_axes((0.6 / SHEET_WIDTH, 0.42 / height, (SHEET_WIDTH - 0.7) / SHEET_WIDTH, RESIDUALS / height))
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
