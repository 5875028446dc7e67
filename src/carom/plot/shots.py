"""Figures of fits to whole shots: film and model on each other, distances over time, all shots on one page; the HTML report."""

from __future__ import annotations

import html
import math
from collections.abc import Iterable
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from carom.fitting.result import with_error_bar
from carom.formatting import called_ball
from carom.plot.fit import BALLS, SHOWN, beside, panel, table_of_laws, write_page
from carom.plot.style import GREY, INK, literal, new_figure, style

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from carom.fitting import Ranked
    from carom.fitting.shots import FittedShot, ShotsFit, ShotsRanking

COLUMNS = 5  # of small multiples
LEAST_WIDTH = 5.2  # inches, that the legend of small multiples needs
ORDER = (
    "struck",
    "second",
    "third",
    "fourth",
    "fifth",
    "sixth",
)  # balls of a shot: by the cue, and in the order of the film
LEAST_MM = 0.1  # of a distance that is drawn
MARGINS = {"left": 0.13, "right": 0.98, "top": 0.9, "bottom": 0.18}  # of a panel with axes
DOTS = 120  # of a ball's path


def plot_shot(shot: FittedShot) -> Figure:
    """Plot one shot: film (dots) and model (lines) from above, contacts of both, and distances over time. Returns a Figure."""
    with style():
        figure = new_figure(9.0, 4.0)
        left, right = figure.subplots(1, 2, width_ratios=[1.5, 1])
        _from_above(left, shot, marks=True)
        _over_time(right, shot)
        balls = _balls_in_words(shot)
        figure.legend(
            handles=balls, loc="lower left", ncols=len(balls), fontsize=8, frameon=False, bbox_to_anchor=(0.01, 0.06)
        )
        figure.legend(
            handles=_marks(), loc="lower left", ncols=5, fontsize=8, frameon=False, bbox_to_anchor=(0.01, 0.0)
        )
        figure.suptitle(f"{literal(shot.name)}: {1e3 * shot.rms:.3g} mm (rms) from film to model", fontsize=9)
        figure.subplots_adjust(left=0.02, right=0.97, top=0.9, bottom=0.22, wspace=0.16)
    return figure


def plot_shots(fit: ShotsFit) -> Figure:
    """Plot all shots as small multiples, film (dots) and model (lines), with their distances. Returns a Matplotlib Figure."""
    columns = min(COLUMNS, len(fit.shots))
    rows = -(-len(fit.shots) // columns)
    height = 1.3 * rows + 1.0
    with style():
        figure = new_figure(max(2.15 * columns + 0.3, LEAST_WIDTH), height)
        panels = figure.subplots(rows, columns, squeeze=False)
        for axes in panels.flat[len(fit.shots) :]:
            axes.set_axis_off()
        for axes, shot in zip(panels.flat, fit.shots, strict=False):
            _small(axes, shot)
        balls = _legend(f"{word} ball" for word, _ in zip(ORDER, range(most_balls(fit)), strict=False))
        figure.legend(
            handles=balls, loc="lower center", ncols=6, fontsize=7.5, frameon=False, bbox_to_anchor=(0.5, 0.18 / height)
        )
        figure.legend(
            handles=_marks(), loc="lower center", ncols=5, fontsize=7.5, frameon=False, bbox_to_anchor=(0.5, 0.0)
        )
        figure.subplots_adjust(
            left=0.01, right=0.99, top=1 - 0.42 / height, bottom=0.45 / height, wspace=0.05, hspace=0.2
        )
        figure.suptitle(f"Film and {literal(fit.law.name)}, distance (rms) to rest", fontsize=9, y=1 - 0.05 / height)
    return figure


def most_balls(fit: ShotsFit) -> int:
    """Return the largest number of balls of a shot."""
    return max(len(shot.film.balls) for shot in fit.shots)


def _small(axes: Any, shot: FittedShot) -> None:
    """Plot one shot small, with its distance."""
    _from_above(axes, shot, marks=True, size=0.5)
    lost = "" if shot.followed else ", not followed"
    axes.set_title(
        f"{literal(shot.name)}: {1e3 * shot.rms:.3g} mm{lost}", fontsize=7, color="#D55E00" if lost else INK, pad=2
    )


def _legend(names: Iterable[str]) -> list[Any]:
    """Return a line for each ball."""
    from matplotlib.lines import Line2D

    return [Line2D([], [], color=BALLS[k % len(BALLS)], label=literal(name)) for k, name in enumerate(names)]


def _balls_in_words(shot: FittedShot) -> list[Any]:
    return _legend(
        f"{called_ball(name)}{', struck by the cue' if k == 0 else ''}" for k, name in enumerate(shot.film.balls)
    )


def _marks() -> list[Any]:
    """Return what dots, lines, circles and crosses are."""
    from matplotlib.lines import Line2D

    look: dict[str, Any] = {"color": INK, "ls": "none", "mfc": "none"}
    return [
        Line2D([], [], color=INK, ls="none", marker="o", ms=2, label="film"),
        Line2D([], [], color=INK, lw=0.8, label="model"),
        Line2D([], [], **look, marker="s", ms=4, mew=0.8, label="start"),
        Line2D([], [], **look, marker="o", ms=6, mew=0.6, label="contact in the model"),
        Line2D([], [], **look, marker="x", ms=5, mew=0.7, label="contact in the film"),
    ]


def _distances(axes: Any, fit: ShotsFit) -> None:
    """Plot the distances of all shots over time."""
    for shot in fit.shots:
        seen = shot.film.measured.any(axis=1)
        far = 1e3 * np.sqrt(np.nanmean(np.square(shot.distance[seen]), axis=1))
        axes.plot(shot.film.time[seen], np.maximum(far, LEAST_MM), lw=0.5, color=INK, alpha=0.4)
    axes.axhline(1e3 * fit.noise * np.sqrt(2), color=GREY, lw=0.8, ls=":")
    _in_mm(axes)
    axes.set(xlabel="time, s (dotted: noise of the film)", ylabel="distance, mm")
    axes.set_title("Distance from film to model, all shots", fontsize=9)


def _by_horizon(axes: Any, fit: ShotsFit) -> None:
    """Plot the distances of all shots by horizon, and their medians."""
    from carom.fitting.shots.result import HORIZONS

    places = [name for name in HORIZONS if len(fit.horizon(name))]
    for k, name in enumerate(places):
        far = np.maximum(1e3 * fit.horizon(name), LEAST_MM)
        spread = np.linspace(-0.2, 0.2, len(far)) if len(far) > 1 else np.zeros(1)
        axes.plot(k + spread, np.sort(far), "o", ms=2.5, color=BALLS[0], alpha=0.7)
        axes.plot([k - 0.3, k + 0.3], [np.median(far)] * 2, color=BALLS[1], lw=1.5)
    _in_mm(axes)
    axes.set(xticks=range(len(places)), xticklabels=places, ylabel="distance (rms), mm")
    axes.set_title("From the start to (line: median of the shots)", fontsize=9)


def _all_shots(fit: ShotsFit) -> list[str]:
    """Return the drawings of all shots: small multiples, if there are several, and their distances."""
    small = [
        panel(lambda axes, one=one: _small(axes, one), 2.15, 1.3, left=0.02, right=0.98, top=0.88, bottom=0.02)  # type: ignore[misc]
        for one in fit.shots
    ]
    curves = [
        panel(lambda axes: _distances(axes, fit), 4.5, 3.0, **MARGINS),
        panel(lambda axes: _by_horizon(axes, fit), 4.5, 3.0, **MARGINS),
    ]
    return [beside(small, "beside small") if len(small) > 1 else "", beside(curves)]


def _from_above(axes: Any, shot: FittedShot, *, marks: bool = False, size: float = 1.0) -> None:
    """Plot one shot from above: noses of the cushions, rows of the film, paths and contacts of the model; ``size`` of the marks."""
    from carom.fitting.shots.result import table_of

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
        axes.plot(*shot.film.first[k], "s", ms=4 * size, mfc="none", mec=colour, mew=0.8, zorder=4)
        met = [event for event in run.events.of("wall", "ball", ball=k) if event.t + shot.time < end] if marks else []
        for event in met:
            place = np.asarray(event.after.position)[:2]
            axes.plot(*place, "o", ms=7 * size, mfc="none", mec=colour, mew=0.6 * size, zorder=4)
    for one in shot.film.events if marks else ():
        rows = np.flatnonzero(shot.film.known[:, one.ball])
        if len(rows):
            near = rows[np.argmin(np.abs(shot.film.time[rows] - (one.low + one.high) / 2))]
            axes.plot(*shot.film.position[near, one.ball], "x", ms=5 * size, color=INK, mew=0.7 * size, zorder=5)
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
    axes.set(xlabel="time, s (contacts in the film: ball solid, cushion dotted)", ylabel="distance, mm")


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
        medians = (1e3 * one.fit.median(name) for name in HORIZONS)
        return tuple("–" if math.isnan(mm) else f"{mm:.1f}" for mm in medians)

    return table_of_laws(ranking, tuple(f"{name}, mm" for name in HORIZONS), cells, parameters=False)


def _numbers(ranking: ShotsRanking) -> str:
    """Return the table of the fitted numbers, a column for each of the best laws."""
    fits = [one.fit for one in ranking.ranked[:SHOWN]]
    rows = [
        [name, *(with_error_bar(fit.estimates[name]) if name in fit.estimates else "–" for fit in fits)]
        for name in dict.fromkeys(name for fit in fits for name in fit.estimates)
    ]
    head = "".join(f"<th>{html.escape(text)}</th>" for text in ("number", *(fit.law.name for fit in fits)))
    body = "".join(f"<tr>{''.join(f'<td>{html.escape(text)}</td>' for text in row)}</tr>" for row in rows)
    return f'<div class="wide"><table><tr>{head}</tr>{body}</table></div>'


def _shot(shot: FittedShot) -> str:
    """Return the two drawings of a shot below its name."""

    def above(axes: Any) -> None:
        _from_above(axes, shot, marks=True)
        axes.legend(
            handles=_balls_in_words(shot),
            loc="upper center",
            bbox_to_anchor=(0.5, 0.0),
            ncols=3,
            fontsize=8,
            frameon=False,
        )

    said = f"{html.escape(shot.name)}: {1e3 * shot.rms:.3g} mm{'' if shot.followed else ', not followed'}"
    whole = panel(above, 4.6, 2.6, left=0.01, right=0.99, top=0.99, bottom=0.12)
    return f"<h3>{said}</h3>" + beside([whole, panel(lambda axes: _over_time(axes, shot), 4.4, 2.6, **MARGINS)])


def _legend_of_marks() -> str:
    def draw(axes: Any) -> None:
        axes.set_axis_off()
        axes.legend(handles=_marks(), loc="center", ncols=3, fontsize=8, frameon=False)

    return panel(draw, 4.6, 0.5, left=0.0, right=1.0, top=1.0, bottom=0.0)


def write_shots_report(ranking: ShotsRanking, source: str, path: str | Path) -> Path:
    """Write the HTML report atomically: verdict, sentences, all shots, each shot, the laws."""
    best = ranking.best
    parts = [
        *(f"<p>{html.escape(line)}</p>" for line in best.describe()), *_all_shots(best),
        "<h2>The laws, best first</h2>", _laws(ranking), "<h2>The table</h2>", _numbers(ranking),
        "<h2>The shots, the farthest from the film first</h2>",
        _legend_of_marks(), *map(_shot, sorted(best.shots, key=lambda one: -one.rms)),
    ]  # fmt: skip
    return write_page(ranking, path, source, "Whole shots: {}", parts)
