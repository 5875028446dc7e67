"""Figures of whole tracks and their simulations, and the HTML report."""

from __future__ import annotations

import html
from itertools import pairwise
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from carom.fitting.result import with_error_bar
from carom.plot.fit import SHOWN, listed, svg, table_of_laws, write_page
from carom.plot.style import GREY, INK, law_styles, literal, new_figure, style

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from carom.fitting import Ranked
    from carom.fitting.tracks import TrackFit, TrackRanking

__all__ = ["plot_tracks", "write_track_report"]

WIDTH = 8.2  # inches
SHOTS, MORE = 6, 12  # largest number of shots drawn from above, and that for wide tables, of which more rows fit
BALLS = ("#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9")


def plot_tracks(ranking: TrackRanking) -> Figure:
    """Plot shots from above, tracked and simulated, distances by shot and law, and over time. Returns a Matplotlib Figure."""
    best = ranking.best
    shots = list(dict.fromkeys(one.group for one in best.frames.segments))
    size = np.ptp(np.concatenate([one.position for one in best.frames.segments]), axis=0)
    shown = shots[: MORE if size[0] > 1.5 * size[1] else SHOTS]
    names = list(dict.fromkeys(one.name for one in best.frames.segments))
    columns = min(4 if len(shown) > SHOTS else 3, len(shown))
    rows = -(-len(shown) // columns)
    above = rows * min(3.0, 0.3 + WIDTH / columns * float(size[1] / size[0])) + 0.3  # inches
    with style():
        figure = new_figure(WIDTH, above + 3.1)
        upper, lower = figure.subfigures(2, 1, squeeze=False, height_ratios=[above, 3.1]).flat
        panels = upper.subplots(rows, columns, squeeze=False)
        for axes in panels.flat[len(shown) :]:
            axes.set_axis_off()
        for axes, shot in zip(panels.flat, shown, strict=False):
            _from_above(axes, best, shot, names)
        upper.subplots_adjust(left=0.01, right=0.99, top=1 - 0.5 / above, bottom=0.01, wspace=0.06, hspace=0.28)
        more = f", {len(shown)} of {len(shots)} shots" if len(shots) > len(shown) else ""
        upper.suptitle(f"Tracked (dots) and simulated by {literal(best.law.name)} (lines){more}", fontsize=9)
        left, right = lower.subplots(1, 2)
        _by_shot(left, ranking)
        _over_time(right, best)
        lower.subplots_adjust(left=0.08, right=0.98, top=0.9, bottom=0.16, wspace=0.24)
    return figure


def _from_above(axes: Any, fit: TrackFit, shot: str, names: list[str]) -> None:
    """Plot one shot: all its segments, and the lines on which the ball's centre turns."""
    at = {**fit.model.held, **fit.numbers}
    which = [n for n, one in enumerate(fit.frames.segments) if one.group == shot]
    every = np.concatenate([one.position for one in fit.frames.segments])
    low, high = every.min(axis=0), every.max(axis=0)
    for name, value in at.items():
        side = name.removeprefix("wall_")
        if side in ("left", "right"):
            axes.plot([value, value], [low[1], high[1]], color=GREY, lw=0.8)
        elif side in ("bottom", "top"):
            axes.plot([low[0], high[0]], [value, value], color=GREY, lw=0.8)
    for n in which:
        one = fit.frames.segments[n]
        colour = BALLS[names.index(one.name) % len(BALLS)]
        count = int(fit.frames.count[n])
        t = np.linspace(0.0, one.time[count - 1], 300)
        run = fit.simulate(n)
        x = np.asarray(run.at(np.minimum(t, run.end)).position)[:, 0, :2]
        axes.plot(*x.T, "-", color=colour, lw=0.9, zorder=2)
        step = max(1, count // 60)
        axes.plot(*one.position[:count:step].T, "o", color=colour, ms=2.2, mec="none", alpha=0.75, zorder=3)
        axes.plot(*one.position[0], "o", color=colour, ms=5, mfc="none", mew=0.8, zorder=3)
    margin = 0.03 * float((high - low).max())
    axes.set(aspect="equal", xlim=(low[0] - margin, high[0] + margin), ylim=(low[1] - margin, high[1] + margin))
    axes.set(xticks=[], yticks=[])
    for spine in axes.spines.values():
        spine.set_visible(False)
    axes.set_title(f"{literal(shot or 'track')}: {1e3 * fit.rms(which):.2g} mm", fontsize=8)


def _by_shot(axes: Any, ranking: TrackRanking) -> None:
    """Plot the cumulative distribution of the shots' distances for each law."""
    fits = ranking.fits[: SHOWN + 2]
    look = law_styles([fit.law.name for fit in fits])
    rows = ranking.best.frames.groups
    for fit in fits:
        size = np.sort([1e3 * fit.rms(which) for which in rows])
        colour, dashes = look[fit.law.name]
        share = np.arange(1, len(size) + 1)
        axes.plot(
            size, share, color=colour, ls=dashes, marker="o", ms=2.5 if len(size) > 8 else 4, lw=1, label=fit.law.name
        )
    axes.axvline(1e3 * ranking.best.noise * np.sqrt(2), color=GREY, lw=0.8, ls=":")
    axes.set(xscale="log", xlabel="RMS distance of a shot, mm (dotted: noise)", ylabel="shots that are nearer")
    axes.set_ylim(0, len(rows) * 1.04)
    axes.set_title("Distance from track to simulation", fontsize=9)
    axes.legend(fontsize=7, frameon=False, loc="lower right")


def _over_time(axes: Any, fit: TrackFit) -> None:
    """Plot the distances of the best law since the first contact: a line per track, of more than a few tracks the shares."""
    gaps = [1e3 * np.hypot(*fit.gap[n, : int(c)].T) for n, c in enumerate(fit.frames.count)]
    times = [one.time[: len(gap)] - one.contacts[0] for one, gap in zip(fit.frames.segments, gaps, strict=True)]
    if len(gaps) <= len(BALLS):
        for time, gap in zip(times, gaps, strict=True):
            axes.plot(time, gap, color=INK, lw=0.5, alpha=0.5)
    since, every = np.concatenate(times), np.concatenate(gaps)
    bins = [(a, b, every[(since >= a) & (since < b)]) for a, b in pairwise(np.linspace(since.min(), since.max(), 25))]
    middles = [(a + b) / 2 for a, b, some in bins if len(some) >= 10]
    if middles:
        shares = np.array([np.percentile(some, (10, 25, 50, 75, 90)) for *_, some in bins if len(some) >= 10]).T
        if len(gaps) > len(BALLS):
            axes.fill_between(middles, shares[0], shares[4], color=INK, alpha=0.12, lw=0, label="80 % of frames")
            axes.fill_between(middles, shares[1], shares[3], color=INK, alpha=0.25, lw=0, label="50 %")
        axes.plot(middles, shares[2], color="#D55E00", lw=1.8, label="median")
        axes.legend(fontsize=7, frameon=False, loc="upper left")
    axes.axvline(0, color=GREY, lw=0.8, ls=":")
    axes.set(yscale="log", xlabel="time since the first contact, s", ylabel="distance, mm")
    axes.set_title(f"Over time, {fit.law.name}", fontsize=9)


def _laws(ranking: TrackRanking) -> str:
    def cells(one: Ranked[TrackFit]) -> tuple[str, ...]:
        fit = one.fit
        numbers = "<br>".join(f"{name} {html.escape(with_error_bar(e))}" for name, e in fit.estimates.items())
        goodness = f"{fit.chi2:.5g} / {fit.dof:.0f}" if fit.known else "–"
        return goodness, f"{1e3 * fit.median_rms:.3g}", f"{1e3 * fit.rms():.3g}", numbers

    return table_of_laws(ranking, ("chi² / dof", "median RMS, mm", "RMS, mm"), cells)


def write_track_report(ranking: TrackRanking, source: str, path: str | Path) -> Path:
    """Write the HTML report atomically: verdict, figure, table, unconstrained parameters."""
    from carom import __version__

    best, name = ranking.best, Path(source).name
    tracks = best.frames.segments
    contacts = sum(len(one.contacts) for one in tracks)
    ball = f"{1e3 * best.model.setting.radius:.4g} mm, moment of inertia {best.model.setting.kappa:.4g} m a²"
    body = [
        f"<h1>Which law follows {html.escape(name)}?</h1>",
        f'<p class="verdict">{html.escape(ranking.verdict)}</p>',
        f"<p>{len(tracks)} track segments, {contacts} contacts, {int(best.frames.count.sum()):,} frames; each segment is simulated"
        f" from its own start. Ball of radius {ball}.</p>",
        svg(plot_tracks(ranking)), "<h2>The laws, best first</h2>", _laws(ranking),
        listed("Unconstrained parameters", ranking.degenerate),
        listed("Notes", list(ranking.notes)),
        f"<footer>carom {__version__}. {ranking.aicc_note} wall_left, ...: position at which"
        " the ball's centre is reflected, m.</footer>",
    ]  # fmt: skip
    return write_page(path, name, ranking.decisive, body)
