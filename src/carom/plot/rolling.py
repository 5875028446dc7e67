"""Plot balls that roll on surfaces: a run from above and from the side."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from carom.billiards.rolling_run import RollingRun
from carom.plot.style import GREY, INK, new_figure, style

if TYPE_CHECKING:
    from matplotlib.figure import Figure

__all__ = ["plot_roll"]

ROLLS, FLIES = "#0072B2", "#D55E00"
POINTS = 1200


def plot_roll(run: RollingRun) -> Figure:
    """Draw the path of the ball's centre from above, and its height against time: blue while it rolls, orange in flight.

    Parameters
    ----------
    run : RollingRun

    Returns
    -------
    Figure
        A Matplotlib figure.

    Examples
    --------
    >>> import carom
    >>> from carom import billiards, plot
    >>> ball, bowl = carom.Ball(0.1, 1.0), billiards.surfaces.bowl(1.0)
    >>> run = billiards.roll(bowl, (0.0, 0.0, -0.9), (1.0, 0.0, 0.0), ball=ball, duration=1.0)
    >>> len(plot.plot_roll(run).axes)
    2
    """
    states = run.at(np.linspace(0.0, run.duration, POINTS))
    path, rolls = 1e3 * states.place, states.rolls
    with style():
        figure = new_figure(9.0, 4.2)
        above, side = figure.subplots(1, 2, width_ratios=(1, 1.2))
        for axes, x, y in ((above, path[:, 0], path[:, 1]), (side, states.time, path[:, 2])):
            axes.plot(x, np.where(rolls, y, math.nan), color=ROLLS, lw=1.4, label="rolls")
            if not rolls.all():
                axes.plot(x, np.where(rolls, math.nan, y), color=FLIES, lw=1.4, label="in flight")
        if run.setting.surface.name == "hole":
            rim = 1e3 * run.setting.surface.pieces[1].ring  # type: ignore[attr-defined]
            turn = np.linspace(0, math.tau, 200)
            above.plot(rim * np.cos(turn), rim * np.sin(turn), color=GREY, lw=1.0)
        for event in run.events:
            if event.kind in ("leaves", "lands"):
                side.plot(event.time, 1e3 * event.place[2], "o", ms=3, color=INK)
        above.set_aspect("equal")
        above.set(xlabel="x (mm)", ylabel="y (mm)", title="from above")
        side.set(xlabel="time (s)", ylabel="height of the centre (mm)", title=f"ends: {run.end}")
        side.legend(loc="best")
    return figure
