"""Plot periodic orbits of billiards: each in its table, and branches of them."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from carom.billiards.continuation import OrbitBranch
from carom.billiards.manifolds import Manifold
from carom.billiards.periodic_records import PeriodicOrbit
from carom.errors import CaromError
from carom.plot.billiards import draw_table, flights_in_cell, table_extent
from carom.plot.style import GREY, INK, new_figure, style

if TYPE_CHECKING:
    from matplotlib.figure import Figure

__all__ = ["plot_branch", "plot_manifolds", "plot_periodic"]

COLOURS = {"elliptic": "#0072B2", "parabolic": "#8a8a8a", "hyperbolic": "#D55E00"}
MANIFOLDS = {"unstable": "#D55E00", "stable": "#0072B2"}
MOST = 24  # orbits in one figure
POINTS = 24  # of each flight, under a force


def plot_periodic(found: Sequence[PeriodicOrbit]) -> Figure:
    """Draw periodic orbits, each in its table, coloured by their stability: blue elliptic, orange hyperbolic, grey parabolic.

    Parameters
    ----------
    found : PeriodicOrbits, or several PeriodicOrbit
        The first 24 are drawn.

    Returns
    -------
    Figure
        A Matplotlib figure.

    Raises
    ------
    CaromError
        No orbit.

    Examples
    --------
    >>> from carom import billiards, plot
    >>> found = billiards.periodic_orbits(billiards.ellipse(2.0, 1.0), (2, 3), law="mirror", starts=100)
    >>> len(plot.plot_periodic(found).axes) == len(found)
    True
    """
    shown = list(found[:MOST])
    if not shown:
        raise CaromError("plot: periodic orbits: expected at least one, got none")
    setup = shown[0].orbit.setup
    forced = setup.table.bends_flights
    paths = [one.orbit.path((), POINTS if forced else 1)[:, :2] for one in shown]
    low, high = table_extent(setup.table.wall(), setup.shape, paths[0])
    width, height = high - low
    columns = min(len(shown), 4 if width < 1.9 * height else 3)
    rows = math.ceil(len(shown) / columns)
    side = 8.0 / max(columns, 2)
    with style():
        figure = new_figure(columns * side, rows * (min(side * height / width, 1.3 * side) + 0.5))
        grid = figure.add_gridspec(rows, columns, left=0.02, right=0.98, bottom=0.02, hspace=0.3, wspace=0.06)
        for k, (one, path) in enumerate(zip(shown, paths, strict=True)):
            axes = figure.add_subplot(grid[k // columns, k % columns])
            draw_table(axes, one.orbit.setup, low, high)
            for line in flights_in_cell(one.orbit.setup.shape, path, POINTS if forced else 1)[0]:
                axes.plot(
                    line[:, 0], line[:, 1], color=COLOURS[one.stability], lw=1.1, zorder=3, solid_capstyle="round"
                )
            at = one.orbit.folded
            axes.plot(at[:, 0], at[:, 1], "o", ms=2.6, color=INK, zorder=5)
            axes.set(xlim=(low[0], high[0]), ylim=(low[1], high[1]))
            axes.set_aspect("equal", adjustable="box")
            axes.axis("off")
            said = f"{one.period} bounces, {one.stability}\n{_number_of(one)}"
            axes.set_title(said, fontsize=8, color=COLOURS[one.stability])
    return figure


def _number_of(one: PeriodicOrbit) -> str:
    if one.rotation_number is not None:
        return f"rotation number {one.rotation_number:.4f}"
    return f"multiplier {one.multipliers[0].real:.4g}"


def plot_branch(branch: OrbitBranch, name: str = "parameter") -> Figure:
    """Draw the trace of a branch of periodic orbits against the parameter: between -2 and 2 the orbit is elliptic.

    Parameters
    ----------
    branch : OrbitBranch
        From :func:`carom.billiards.continue_orbit`.
    name : str
        Of the parameter, with its unit.

    Returns
    -------
    Figure
        A Matplotlib figure.

    Examples
    --------
    >>> from carom import billiards, plot
    >>> one = billiards.periodic_orbits(billiards.ellipse(1.2, 1.0), 2, law="mirror", starts=100)[0]
    >>> branch = billiards.continue_orbit(one, lambda major: {"table": billiards.ellipse(major, 1.0)}, 1.2, 1.6)
    >>> len(plot.plot_branch(branch, "major half axis (m)").axes)
    1
    """
    with style():
        figure = new_figure(6.0, 3.8)
        axes = figure.add_subplot()
        axes.axhspan(-2, 2, color=COLOURS["elliptic"], alpha=0.08, lw=0)
        at, trace = branch.parameter, branch.trace
        # (at the end of the band where the curve is outside it)
        free_left = abs(trace[at.argmax()]) <= 2 < abs(trace[at.argmin()])
        axes.text(
            0.01 if free_left else 0.99, 2, "elliptic", transform=axes.get_yaxis_transform(),
            ha="left" if free_left else "right", va="top", fontsize=8,
            color=COLOURS["elliptic"],
        )  # fmt: skip
        axes.plot(at, trace, color=INK, lw=1.2)
        for event in branch.events:
            axes.plot(event.parameter, event.trace, "o", ms=4, color=COLOURS["hyperbolic"], zorder=4)
            # (towards the middle of the picture, above the curve where it falls towards there, else below)
            left = event.parameter > (at.min() + at.max()) / 2
            k = int(
                np.hypot((at - event.parameter) / np.ptp(at), (trace - event.trace) / (np.ptp(trace) or 1.0)).argmin()
            )
            lower, upper = max(k - 1, 0), min(k + 1, len(at) - 1)
            above = ((trace[upper] - trace[lower]) * (at[upper] - at[lower]) > 0) == left
            axes.annotate(
                f"{event.kind}\n{event.parameter:.6g}", (event.parameter, event.trace),
                xytext=(-6 if left else 6, 6 if above else -6), textcoords="offset points", ha="right" if left else "left",
                va="bottom" if above else "top", fontsize=8, color=GREY,
            )  # fmt: skip
        axes.set(xlabel=name, ylabel="trace of the pair of multipliers")
        axes.margins(x=0.02, y=0.12)
    return figure


def plot_manifolds(curves: Sequence[Manifold]) -> Figure:
    """Draw manifolds as arc length against the velocity along the wall over the speed: orange unstable, blue stable.

    Parameters
    ----------
    curves : several Manifold
        Of one table, from `carom.billiards.manifold`.

    Returns
    -------
    Figure
        A Matplotlib figure.

    Examples
    --------
    >>> from carom import billiards, plot
    >>> axis = billiards.periodic_orbits(billiards.ellipse(1.25, 1.0), 2, law="mirror", starts=60)[-1]
    >>> len(plot.plot_manifolds([billiards.manifold(axis, kind) for kind in ("unstable", "stable")]).axes)
    1
    """
    if not curves:
        raise CaromError("plot_manifolds: curves: expected at least one manifold, got none")
    with style():
        figure = new_figure(7.2, 4.4)
        axes = figure.add_subplot()
        for curve in curves:
            colour = MANIFOLDS[curve.kind]
            axes.plot(curve.arc, curve.phase[:, 1], ".", ms=1.6, color=colour, mew=0, rasterized=True)
            axes.plot([], [], "-", color=colour, lw=2, label=curve.kind)
        axes.set(xlabel="arc length (m)", ylabel="velocity along the wall", ylim=(-1.04, 1.04))
        handles, labels = axes.get_legend_handles_labels()
        once = dict(zip(labels, handles, strict=True))
        axes.legend(once.values(), once.keys(), loc="upper center", bbox_to_anchor=(0.5, 1.13), ncols=2)
    return figure
