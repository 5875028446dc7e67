"""Figure of measured tracks: paths with contacts, speed against time with the fitted motion, and residuals."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from carom.plot.style import COLOURS, GREY, INK, drawn, literal, new_figure, style
from carom.tracks.contact import TrackContact
from carom.tracks.films import usable_stages
from carom.tracks.measurement import Measured
from carom.tracks.track import Track

if TYPE_CHECKING:
    from matplotlib.figure import Figure

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
        places, speeds, gaps = (
            figure.add_subplot(grid[:, 0]),
            figure.add_subplot(grid[0, 1]),
            figure.add_subplot(grid[1, 1]),
        )
        _plot_paths(places, measured)
        _plot_speeds(speeds, measured)
        _plot_residuals(gaps, measured)
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
        n = np.array(wall.normal)
        along = np.array([-n[1], n[0]])
        middle = np.array(wall.point) + along * (((low + high) / 2 - wall.point) @ along)
        half = abs((high - low) @ np.abs(along)) / 2 + 0.02 * reach
        ends = np.stack([middle - half * along, middle + half * along])
        axes.plot(*ends.T, color=INK, lw=1.4, zorder=1)
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


def _plot_residuals(axes: Any, measured: Measured) -> None:
    fits = [one.fit for one in measured.contacts if one.fit is not None]
    axes.axhspan(-1e3 * measured.noise, 1e3 * measured.noise, color="#eceae4", zorder=0, lw=0)
    if fits:
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
