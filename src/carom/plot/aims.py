"""Shots that reach a target, side by side: paths up to the target, and where a player's errors bring the ball."""

from __future__ import annotations

import math
import os
from typing import TYPE_CHECKING, Any

import numpy as np

from carom.errors import CaromError
from carom.formatting import format_number
from carom.plot.scene_view import View, colour, view, walls_in, way
from carom.plot.style import INK, drawn, literal, new_figure
from carom.plot.trajectory import CUSHION, FILLS
from carom.sweeps.unknowns import UNITS

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from carom.sweeps.aiming import Aim, Aims

__all__ = ["DRAWN", "plot_aims"]

WIDTH, COLUMNS = 4.2, 2  # inches, of a panel; panels side by side
DRAWN = 4  # solutions, if not said otherwise


def plot_aims(aims: Aims, file: str | os.PathLike[str] | None = None, *, solutions: int = DRAWN) -> Figure:
    """Draw solutions of :func:`carom.aim`, a panel each: the balls' paths, and the target's error ellipse.

    Parameters
    ----------
    aims : Aims
    file : str or path, optional
        File to write, .svg, .pdf or .png.
    solutions : int
        How many, the most robust first.

    Returns
    -------
    matplotlib.figure.Figure
        The ellipse, or for a ball to be hit and a pocket the bar across the ball's path, is twice the standard deviation that
        the player's errors give, by the gradients; none where the miss is not linear within them (``Aim.linear``).

    Raises CaromError: no solution, a file that cannot be written, or Matplotlib is missing.

    Examples
    --------
    >>> import carom
    >>> wall = carom.scene.Plane(point=(0, 0, 0), normal=(1, 0, 0), restitution=0.85, friction=0.2)
    >>> balls = [carom.SceneBall(radius=0.03, mass=0.2, position=(0.5, y), velocity=(0, 0), rolling=True) for y in (0, 0.6)]
    >>> scene = carom.Scene(floor=carom.Floor(friction=0.2, rolling_resistance=0.01), walls=[wall], balls=balls)
    >>> best = carom.aim(scene, ["balls.0.velocity"], {"hit": 1, "cushions": 1}, starts=512)
    >>> len(carom.plot.plot_aims(best).axes) == min(len(best), 4)
    True
    """
    shown = list(aims)[:solutions]
    if not shown:
        raise CaromError("plot_aims: aims: expected at least one solution, got none")
    runs = [one.run for one in shown]
    ways = [[way(run, i, one.time) for i in range(len(run.scene.balls))] for run, one in zip(runs, shown, strict=True)]
    points = [x for run in ways for ball in run for _phase, _t, x in ball] + [np.asarray(runs[0].start.position)]
    seen = view(runs[0], np.concatenate(points))
    columns = min(COLUMNS, len(shown))
    rows = math.ceil(len(shown) / columns)

    def draw() -> Figure:
        panel = WIDTH * seen.size[1] / seen.size[0] + 0.45
        figure = new_figure(WIDTH * columns, panel * rows)
        for k, one in enumerate(shown):
            axes = figure.add_subplot(rows, columns, k + 1)
            _panel(axes, aims, one, runs[k], ways[k], seen)
        figure.subplots_adjust(
            left=0.01, right=0.99, bottom=0.01, top=1 - 0.32 / (panel * rows), wspace=0.04, hspace=0.16
        )
        return figure

    return drawn(draw, file)


def _panel(axes: Any, aims: Aims, one: Aim, run: Any, ways: list[Any], seen: View) -> None:
    from matplotlib.patches import Circle

    for line, what in walls_in(run, seen):
        if what == "line":
            axes.plot(*line.T, color=CUSHION, lw=1.6, zorder=2)
        else:
            axes.fill(*line.T, color=FILLS[what], lw=0, zorder=0 if what == "felt" else 1)
    at = run.at(one.time)
    for i, ball in enumerate(run.scene.balls):
        ink = colour(run, i)
        for _phase, _t, x in ways[i]:
            axes.plot(x[:, 0], x[:, 1], color=ink, lw=1.2, zorder=4, solid_joinstyle="round")
        axes.add_patch(Circle(run.start.position[i, :2], ball.radius, fc=ink, ec="white", lw=0.6, zorder=5))
        if np.linalg.norm(at.position[i] - run.start.position[i]) > ball.radius:
            axes.add_patch(Circle(at.position[i, :2], ball.radius, fc="none", ec=ink, lw=1.0, zorder=5))
    first = 0
    for target in aims.targets:
        place = slice(first, first + len(target.windows))
        first += len(target.windows)
        if target.kind == "point":
            axes.add_patch(Circle(target.point, target.windows[0], fc="none", ec=INK, lw=0.8, ls=(0, (2, 2)), zorder=6))
        if not one.linear:
            continue
        if target.kind == "point":
            axes.plot(*_ellipse(target.point, one.covariance[place, place]), color=INK, lw=1.0, zorder=6)
        else:
            before = run.at(math.nextafter(one.time, 0.0))
            v = before.velocity[target.ball, :2]
            across = np.array([-v[1], v[0]]) / (np.hypot(*v) or 1.0) * 2 * float(one.spread[place.start])
            center = before.position[target.ball, :2]
            axes.plot(*np.array([center - across, center + across]).T, color=INK, lw=1.4, zorder=6, marker="|", ms=4)
    numbers = ", ".join(
        f"{name} {format_number(x, 4)} {UNITS[name.rpartition('.')[2]]}" for name, x in one.values.items()
    )
    axes.set_title(f"{literal(numbers.replace(' °', '°'))}: {one.chance:.0%}", fontsize=8, color=INK, pad=3)
    axes.set(xlim=seen.x, ylim=seen.y, aspect="equal")
    axes.axis("off")


def _ellipse(center: tuple[float, float], covariance: Any) -> Any:
    """Return the ellipse of two standard deviations, (2, N)."""
    values, axes = np.linalg.eigh(covariance)
    turn = np.linspace(0, 2 * np.pi, 73)
    circle = np.stack([np.cos(turn), np.sin(turn)])
    return np.asarray(center)[:, None] + 2 * axes @ (np.sqrt(np.maximum(values, 0))[:, None] * circle)
