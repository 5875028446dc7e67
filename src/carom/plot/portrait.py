"""Velocity phase portraits and boundary maps of single-particle billiards, orbits on curves (islands) highlighted."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from carom.billiards import Orbit, is_regular
from carom.errors import CaromError
from carom.formatting import format_number
from carom.plot.style import GREY, INK, literal, new_figure, style

if TYPE_CHECKING:
    from matplotlib.figure import Figure

__all__ = ["on_curves", "plot_boundary", "plot_portrait"]

Array = NDArray[np.float64]
SEA = "#5f6368"
ISLANDS = ("#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9")
LEAST_BOUNCES = 50  # of an orbit of which can be said whether it lies on curves


def on_curves(found: Orbit) -> NDArray[np.bool_]:
    """Return for each orbit (N,) whether it stays on smooth curves of the velocity phase portrait: islands, and periodic orbits.

    Weighted Birkhoff averages over both halves of an orbit agree to many digits on curves, to one or two for chaotic orbits
    (:func:`carom.billiards.is_regular`, which follows orbits on until that is clear). Orbits of fewer than 50 bounces count as
    others, as do those that ended early. Not all of the others are chaotic: in polygons no orbit has a positive Lyapunov
    exponent. The largest exponent decides (:func:`carom.billiards.lyapunov`).

    Examples
    --------
    >>> from carom import billiards
    >>> from carom.plot.portrait import on_curves
    >>> start = billiards.starts(billiards.stadium(), 1, seed=1)
    >>> on_curves(billiards.orbit(billiards.stadium(), start, bounces=300, law="mirror")).tolist()
    [False]
    """
    if found.t.shape[-1] < LEAST_BOUNCES:
        return np.zeros(int(np.prod(found.t.shape[:-1], dtype=int)), dtype=bool)
    return np.atleast_1d(is_regular(found)).ravel()


def _title(found: Orbit) -> str:
    """Return table, law, kappa, and numbers of orbits and bounces, in two lines."""
    table = found.setup.table
    sizes = [
        f"{name.replace('_', ' ')} = {value if isinstance(value, str) else format_number(float(value))}"
        for name, value in table.sizes.items()
        if isinstance(value, int | float | str)
    ]
    count = int(np.size(found.count))
    orbits = f"{count:,} orbits" if count > 1 else "1 orbit"
    return (
        f"{literal(', '.join([table.name, *sizes]))}; bounds the {table.bounds}\n{literal(found.setup.law)},"
        f" $\\kappa$ = {format_number(float(found.setup.ball.kappa), 4)}; {orbits} of {found.t.shape[-1]:,} bounces"
    )


def _legend(axes: Any, curves: NDArray[np.bool_], below: float) -> None:
    """Write what the inks mean, with the numbers of orbits, below the axes."""
    from matplotlib.lines import Line2D

    inks = [(SEA, "others: not found to be on curves", int((~curves).sum()))]
    inks.append((ISLANDS[0], "islands: on smooth curves (any colour but grey)", int(curves.sum())))
    dots = [
        Line2D([], [], ls="", marker="o", ms=4, mew=0, color=ink, label=f"{words}  ({count:,})")
        for ink, words, count in inks
        if count
    ]
    axes.legend(handles=dots, loc="upper center", bbox_to_anchor=(0.5, below), ncols=1, frameon=False, fontsize=8,
                handletextpad=0.2)  # fmt: skip


def _dots(count: int) -> float:
    """Return the size of a dot, smaller the more there are."""
    return float(np.clip(4e4 / max(count, 1), 0.02, 6.0))


def plot_portrait(found: Orbit) -> Figure:
    """Draw the velocity phase portrait (after Cox & Feres): every bounce is a point of the unit disc.

    Orbits that stay on smooth curves (islands) are highlighted, each in one of six colours; all others share one ink.

    Horizontal: the spin, sqrt(kappa) a omega; vertical: the velocity along the wall; both divided by sqrt(2 energy/m). The
    invariant measure is uniform in the disc, so areas are to scale.

    Parameters
    ----------
    found : Orbit
        One orbit or many.

    Returns
    -------
    Figure
        A Matplotlib figure.

    Examples
    --------
    >>> from carom import billiards, plot
    >>> found = billiards.orbit(billiards.circle(), ((0.2, 0.1), (0.8, 0.3), 0.5), bounces=20)
    >>> len(plot.plot_portrait(found).axes)
    1
    """
    phase = found.phase.reshape(-1, found.t.shape[-1], 2)
    with style():
        figure = new_figure(4.8, 5.4)
        axes = figure.add_subplot()
        u = np.linspace(0, math.tau, 721)
        axes.plot(np.cos(u), np.sin(u), color=INK, lw=0.8)
        curves = on_curves(found)
        _scatter(axes, phase[..., 0], phase[..., 1], curves)
        axes.set_title(_title(found))
        _legend(axes, curves, -0.13)
        axes.set_aspect("equal")
        axes.set_xlim(-1.04, 1.04)
        axes.set_ylim(-1.04, 1.04)
        axes.set_xticks([-1, -0.5, 0, 0.5, 1])
        axes.set_yticks([-1, -0.5, 0, 0.5, 1])
        axes.set_xlabel(r"spin  $\sqrt{\kappa}\,a\,\omega\,/\,\sqrt{2E/m}$")
        roll = r"\sqrt{1+\kappa}\," if found.setup.rolls else ""
        axes.set_ylabel(rf"velocity along the wall  ${roll}v_t\,/\,\sqrt{{2E/m}}$")
        figure.tight_layout()
    return figure


def plot_boundary(found: Orbit) -> Figure:
    """Draw the boundary map: arc length s, and the velocity along the wall over that in the plane (the sine of the angle).

    Parameters
    ----------
    found : Orbit
        One orbit or many, in a table in the plane or a cylinder over one.

    Returns
    -------
    Figure
        A Matplotlib figure.

    Raises
    ------
    CaromError
        For an orbit in a sphere.

    Examples
    --------
    >>> from carom import billiards, plot
    >>> found = billiards.orbit(billiards.circle(), ((0.2, 0.1), (0.8, 0.3), 0.5), bounces=20)
    >>> len(plot.plot_boundary(found).axes)
    1
    """
    shape = found.setup.shape
    if shape.sphere is not None:
        raise CaromError("plot: boundary map: expected a table in the plane, or a cylinder over one, got a sphere")
    speed = np.hypot(found.velocity[..., 0], found.velocity[..., 1])
    s, sine = found.arc.reshape(-1, found.t.shape[-1]), (found.along / speed).reshape(-1, found.t.shape[-1])
    lengths = shape.lengths
    with style():
        figure = new_figure(6.6, 4.1)
        axes = figure.add_subplot()
        curves = on_curves(found)
        _scatter(axes, s, sine, curves)
        axes.set_title(_title(found))
        _legend(axes, curves, -0.17)
        if np.isfinite(lengths).all():
            axes.set_xlim(0, lengths.sum())
            if 1 < len(lengths) <= 12:
                for start in shape.starts[shape.starts > 0]:
                    axes.axvline(start, color=GREY, lw=0.5, ls=(0, (1, 2)), zorder=1)
        axes.set_ylim(-1, 1)
        axes.set_xlabel(r"arc length  $s$ (m)")
        axes.set_ylabel(r"$\sin\theta = v_t/|v|$")
        figure.tight_layout()
    return figure


def _scatter(axes: Any, x: Array, y: Array, curves: NDArray[np.bool_]) -> None:
    """Draw points of many orbits (N, B), islands above the sea; rasterised where there are many, to keep vector files small."""
    many = x.size > 20_000
    sea = ~curves
    look = {"s": _dots(x.size), "lw": 0, "rasterized": many}
    if sea.any():
        axes.scatter(x[sea].ravel(), y[sea].ravel(), c=SEA, alpha=0.6, zorder=3, label="_sea", **look)
    for k in np.flatnonzero(curves).tolist():
        ink = ISLANDS[int(np.count_nonzero(curves[:k])) % len(ISLANDS)]
        axes.scatter(x[k], y[k], c=ink, zorder=4, label="_island", **look)
