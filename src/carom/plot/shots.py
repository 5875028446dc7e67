"""Figures of fits to whole shots: film and model on each other, distances over time, all shots on one page; the HTML report."""

from __future__ import annotations

import html
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from carom.fitting.result import with_error_bar
from carom.formatting import called_ball
from carom.plot.fit import PAGE, listed, svg, table_of_laws
from carom.plot.fit_tracks import BALLS
from carom.plot.style import GREY, INK, literal, new_figure, style

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from carom.fitting import Ranked
    from carom.fitting.shots import FittedShot, ShotsFit, ShotsRanking

__all__ = ["plot_shot", "plot_shots", "write_shots_report"]

COLUMNS = 5  # of small multiples
LEAST_MM = 0.1  # of a distance that is drawn
DOTS = 120  # of a ball's path


def plot_shot(shot: FittedShot) -> Figure:
    """Plot one shot: film (dots) and model (lines) from above, contacts of both, and distances over time. Returns a Figure."""
    with style():
        figure = new_figure(9.0, 3.8)
        left, right = figure.subplots(1, 2, width_ratios=[1.5, 1])
        _from_above(left, shot, marks=True)
        _over_time(right, shot)
        handles = [left.plot([], [], color=BALLS[k % len(BALLS)], label=literal(called_ball(name)))[0]
                   for k, name in enumerate(shot.film.balls)]  # fmt: skip
        figure.legend(handles=handles, loc="lower center", ncols=len(handles), fontsize=8, frameon=False)
        figure.suptitle(
            f"{literal(shot.film.name + ': ' if shot.film.name else '')}film (dots) and model (lines), {1e3 * shot.rms:.3g} mm;"
            " contacts: circles model, crosses film",
            fontsize=9,
        )
        figure.subplots_adjust(left=0.02, right=0.97, top=0.88, bottom=0.2, wspace=0.16)
    return figure


def plot_shots(fit: ShotsFit) -> Figure:
    """Plot all shots as small multiples, film (dots) and model (lines), with their distances. Returns a Matplotlib Figure."""
    columns = min(COLUMNS, len(fit.shots))
    rows = -(-len(fit.shots) // columns)
    with style():
        figure = new_figure(2.15 * columns + 0.3, 1.3 * rows + 0.6)
        panels = figure.subplots(rows, columns, squeeze=False)
        for axes in panels.flat[len(fit.shots) :]:
            axes.set_axis_off()
        for axes, shot in zip(panels.flat, fit.shots, strict=False):
            _from_above(axes, shot)
            colour = INK if shot.followed else "#D55E00"
            axes.set_title(f"{literal(shot.name)}: {1e3 * shot.rms:.3g} mm", fontsize=7, color=colour, pad=2)
        top = 1 - 0.42 / (1.3 * rows + 0.6)
        figure.subplots_adjust(left=0.01, right=0.99, top=top, bottom=0.01, wspace=0.05, hspace=0.2)
        figure.suptitle(f"Film (dots) and {literal(fit.law.name)} (lines), distance (rms) to rest", fontsize=9, y=0.995)
    return figure


def plot_distances(fit: ShotsFit) -> Figure:
    """Plot the distances of all shots over time, and by horizon. Returns a Matplotlib Figure."""
    from carom.fitting.shots.result import HORIZONS

    with style():
        figure = new_figure(9.0, 3.2)
        left, right = figure.subplots(1, 2, width_ratios=[1.3, 1])
        for shot in fit.shots:
            seen = shot.film.measured.any(axis=1)
            far = 1e3 * np.sqrt(np.nanmean(np.square(shot.distance[seen]), axis=1))
            left.plot(shot.film.time[seen], np.maximum(far, LEAST_MM), lw=0.5, color=INK, alpha=0.4)
        left.axhline(1e3 * fit.noise * np.sqrt(2), color=GREY, lw=0.8, ls=":")
        _in_mm(left)
        left.set(xlabel="time, s (dotted: noise)", ylabel="distance, mm")
        left.set_title("Distance from film to model, all shots", fontsize=9)
        places = [name for name in HORIZONS if len(fit.horizon(name))]
        for k, name in enumerate(places):
            far = np.maximum(1e3 * fit.horizon(name), LEAST_MM)
            spread = np.linspace(-0.2, 0.2, len(far)) if len(far) > 1 else np.zeros(1)
            right.plot(k + spread, np.sort(far), "o", ms=2.5, color=BALLS[0], alpha=0.7)
            right.plot([k - 0.3, k + 0.3], [np.median(far)] * 2, color=BALLS[1], lw=1.5)
        _in_mm(right)
        right.set(xticks=range(len(places)), xticklabels=places, ylabel="distance (rms), mm")
        right.set_title("By horizon (line: median)", fontsize=9)
        figure.subplots_adjust(left=0.08, right=0.98, top=0.9, bottom=0.16, wspace=0.22)
    return figure


def _from_above(axes: Any, shot: FittedShot, *, marks: bool = False) -> None:
    """Plot one shot from above: noses of the cushions, rows of the film, paths and contacts of the model."""
    from carom.fitting.shots.table import table_of

    table = table_of(shot.scene)
    half, (cx, cy) = np.array([table.length, table.width]) / 2, table.center
    corners = np.array([[-1, -1], [1, -1], [1, 1], [-1, 1], [-1, -1]]) * half + [cx, cy]
    axes.plot(*corners.T, color=GREY, lw=0.8)
    run, end = shot.simulate(), float(shot.film.time[-1])
    t = np.linspace(0.0, max(min(end - shot.time, run.end), 1e-3), 600)
    x = np.asarray(run.at(t).position)
    for k in range(len(shot.film.balls)):
        colour = BALLS[k % len(BALLS)]
        axes.plot(*x[:, k, :2].T, color=colour, lw=0.7, zorder=2)
        rows = np.flatnonzero(shot.film.measured[:, k])
        rows = rows[:: max(1, len(rows) // DOTS)]
        axes.plot(*shot.film.position[rows, k].T, "o", ms=1.6, color=colour, mec="none", alpha=0.7, zorder=3)
        axes.plot(*shot.film.first[k], "o", ms=4, mfc="none", mec=colour, mew=0.8, zorder=4)
        if marks:
            met = run.events.of("wall", "ball", ball=k)
            for event in met:
                if event.t + shot.time < end:
                    axes.plot(
                        *np.asarray(event.after.position)[:2], "o", ms=7, mfc="none", mec=colour, mew=0.6, zorder=4
                    )
    if marks:
        for one in shot.film.events:
            rows = np.flatnonzero(shot.film.known[:, one.ball])
            if len(rows):
                near = rows[np.argmin(np.abs(shot.film.time[rows] - (one.low + one.high) / 2))]
                axes.plot(*shot.film.position[near, one.ball], "x", ms=5, color=INK, mew=0.7, zorder=5)
    margin = 0.02 * table.length
    axes.set(aspect="equal", xticks=[], yticks=[])
    axes.set(xlim=(cx - half[0] - margin, cx + half[0] + margin), ylim=(cy - half[1] - margin, cy + half[1] + margin))
    for spine in axes.spines.values():
        spine.set_visible(False)


def _over_time(axes: Any, shot: FittedShot) -> None:
    """Plot the distances of the balls over time; lines at the events of the film."""
    for k in range(len(shot.film.balls)):
        rows = shot.film.measured[:, k]
        if rows.sum() > 2:
            axes.plot(
                shot.film.time[rows],
                np.maximum(1e3 * shot.distance[rows, k], LEAST_MM),
                lw=0.8,
                color=BALLS[k % len(BALLS)],
            )
    for one in shot.film.events:
        axes.axvline((one.low + one.high) / 2, color=GREY, lw=0.5, ls="-" if one.kind == "ball" else ":")
    _in_mm(axes)
    axes.set(xlabel="time, s (lines: events of the film, balls solid, cushions dotted)", ylabel="distance, mm")


def _in_mm(axes: Any) -> None:
    """Let the vertical axis be logarithmic, with plain numbers at its ticks."""
    from matplotlib.ticker import LogFormatter

    class Plain(LogFormatter):
        def __call__(self, x: float, pos: Any = None) -> str:
            return f"{x:g}" if super().__call__(x, pos) else ""

    axes.set(yscale="log")
    axes.yaxis.set_major_formatter(Plain(labelOnlyBase=False))
    axes.yaxis.set_minor_formatter(Plain(labelOnlyBase=False, minor_thresholds=(1, 0.4)))


def _laws(ranking: ShotsRanking) -> str:
    from carom.fitting.shots.result import HORIZONS

    def cells(one: Ranked[ShotsFit]) -> tuple[str, ...]:
        numbers = "<br>".join(
            f"{html.escape(name)} {html.escape(with_error_bar(e))}" for name, e in one.fit.estimates.items()
        )
        return (*(f"{1e3 * one.fit.median(name):.1f}" for name in HORIZONS), numbers)

    return table_of_laws(ranking, tuple(f"{name}, mm" for name in HORIZONS), cells)


def write_shots_report(ranking: ShotsRanking, source: str, path: str | Path) -> Path:
    """Write the HTML report atomically: verdict, sentences, all shots, each shot, the laws."""
    from carom import __version__
    from carom.files import write_text

    path, best = Path(path), ranking.best
    name = html.escape(Path(source).name)
    order = sorted(best.shots, key=lambda one: -one.rms)
    body = [
        f"<h1>Whole shots: {name}</h1>", f'<p class="verdict">{html.escape(ranking.verdict)}</p>',
        *(f"<p>{html.escape(line)}</p>" for line in best.describe()), svg(plot_shots(best)), svg(plot_distances(best)),
        "<h2>The laws, best first</h2>", _laws(ranking),
        listed("Other forms", [one.describe() for one in ranking.forms]), "<h2>The shots, the farthest from the film first</h2>",
        *(svg(plot_shot(one)) for one in order), listed("Notes", list(ranking.notes)),
        f"<footer>carom {__version__}. {ranking.aicc_note}</footer>",
    ]  # fmt: skip
    colour = "#009E73" if ranking.decisive else "#E69F00"
    write_text(path, PAGE.format(title=f"carom fit: {name}", colour=colour, body="\n".join(body)))
    return path
