"""Plot balls that roll on surfaces: a run from above and from the side, and maps of putts."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from carom.billiards.golf import OUTCOMES, Putts
from carom.billiards.rolling_run import RollingRun
from carom.errors import CaromError
from carom.plot.style import GREY, INK, new_figure, style

if TYPE_CHECKING:
    from matplotlib.figure import Figure

__all__ = ["plot_putts", "plot_roll"]

ROLLS, FLIES = "#0072B2", "#D55E00"
CAUGHT = {
    "caught": "#009E73", "lips out": "#D55E00", "rolls past": "#8a8a8a", "goes round": "#56B4E9", "flies over": "#CCCCCC"
}  # fmt: skip
FROM_HOLE = "lips out of the hole", "#7B1FA2"
POINTS = 1200


def plot_roll(run: RollingRun) -> Figure:
    """Draw the path of the ball's centre from above, and its height against time: blue while it rolls, orange in flight.

    Parameters
    ----------
    run : RollingRun
        In space.

    Returns
    -------
    Figure
        A Matplotlib figure.

    Raises
    ------
    CaromError
        A run that is not in three dimensions.

    Examples
    --------
    >>> from carom import billiards, plot
    >>> len(plot.plot_roll(billiards.putt(1.2, 0.03)).axes)
    2
    """
    if run.setting.surface.dimension != 3:
        raise CaromError(f"plot_roll: run: expected one in three dimensions, got {run.setting.surface.dimension}")
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


def plot_putts(found: Putts) -> Figure:
    """Draw which putts are caught, by offset and speed, coloured by outcome.

    Parameters
    ----------
    found : Putts
        From `carom.billiards.putts`, of at least two speeds and two offsets.

    Returns
    -------
    Figure
        A Matplotlib figure.

    Examples
    --------
    >>> from carom import billiards, plot
    >>> len(plot.plot_putts(billiards.putts([0.5, 1.5], [0.0, 0.03])).axes)
    1
    """
    if found.speeds.size < 2 or found.offsets.size < 2:
        raise CaromError(
            f"plot_putts: putts: expected at least two speeds and two offsets, got {found.speeds.size} and {found.offsets.size}"
        )
    from matplotlib.colors import ListedColormap

    shown = np.where(found.lips_out_of_hole, len(OUTCOMES), found.outcome)
    names = {**{name: CAUGHT[name] for name in OUTCOMES}, FROM_HOLE[0]: FROM_HOLE[1]}
    colours = ListedColormap(list(names.values()))
    with style():
        figure = new_figure(6.4, 4.6)
        axes = figure.add_subplot()
        axes.pcolormesh(
            1e3 * found.offsets,
            found.speeds,
            shown,
            cmap=colours,
            vmin=-0.5,
            vmax=len(names) - 0.5,
            shading="nearest",
            alpha=0.8,
        )
        for name in (name for k, name in enumerate(names) if (shown == k).any()):
            axes.plot([], [], "s", ms=9, color=names[name], alpha=0.8, label=name)
        axes.set(xlabel="offset from the centre (mm)", ylabel="speed at the edge (m/s)")
        axes.legend(loc="lower center", bbox_to_anchor=(0.5, 1.0), ncols=3)
        figure.subplots_adjust(top=0.84)
    return figure
