"""Plot orbits of single-particle billiards: paths in the table, and the convergence of Lyapunov exponents."""

from __future__ import annotations

import math
from itertools import pairwise
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from carom.billiards import Lyapunov, Orbit
from carom.billiards.boundary import Boundary
from carom.billiards.setup import OrbitSetup
from carom.errors import CaromError
from carom.formatting import format_number
from carom.plot.style import GREY, INK, new_figure, style

if TYPE_CHECKING:
    from matplotlib.figure import Figure

__all__ = ["draw_table", "flights_in_cell", "plot_lyapunov", "plot_orbit", "table_extent"]

Array = NDArray[np.float64]
WALL = "#b9b4a6"
MAX_FLIGHTS = 5_000  # with more flights the figure is illegible


def plot_orbit(found: Orbit, which: Any = None) -> Figure:
    """Draw one orbit in its table, its flights coloured by the spin; in space projected along z, with its height over time.

    Parameters
    ----------
    found : Orbit
        One orbit or many; at most 5,000 flights are drawn.
    which : int or tuple, optional
        Index of one of many orbits. Default: the first.

    Returns
    -------
    Figure
        A Matplotlib figure.

    Raises
    ------
    CaromError
        An orbit without a bounce.

    Examples
    --------
    >>> from carom import billiards, plot
    >>> found = billiards.orbit(billiards.circle(), ((0.2, 0.1), (0.8, 0.3), 0.5), bounces=20)
    >>> len(plot.plot_orbit(found).axes)
    2
    """
    if which is None:
        which = (0,) * np.ndim(found.count)
    if int(found.count[which]) < 1:
        raise CaromError(
            f"plot: orbit: expected at least one bounce, got an orbit that ended ({found.ended[which]}) before the first"
        )
    setup = found.setup
    count = min(int(found.count[which]), MAX_FLIGHTS)
    spin = found.spin[which][:count] if setup.planar else found.spin[which][:count, 2]
    first = np.broadcast_to(
        np.asarray(found.start.spin, float), found.spin[..., 0].shape if setup.planar else found.spin[..., 0, :].shape
    )[which]
    spins = np.append(first if setup.planar else first[2], spin) * float(setup.ball.radius)
    points = 24 if setup.table.bends_flights else 1
    path = found.path(which, points)[: count * points + 1]
    lines, owner = flights_in_cell(setup.shape, path[:, :2], points)
    with style():
        from matplotlib.collections import LineCollection
        from matplotlib.colors import LinearSegmentedColormap, TwoSlopeNorm

        low, high = table_extent(setup.table.wall(), setup.shape, path[:, :2])
        width, height = high - low
        tall = not setup.planar
        long = width / height > 1.9
        size = (6.4, max(1.9, min(5.4, 5.2 * height / width + 0.9)))
        figure = new_figure(8.4 if tall else size[0], 4.2 if tall else size[1])
        grid = (
            figure.add_gridspec(1, 2, width_ratios=(1, 1), wspace=0.32, left=0.03, right=0.97, bottom=0.14)
            if tall
            else None
        )
        axes = figure.add_subplot(grid[0]) if grid else figure.add_subplot()
        draw_table(axes, setup, low, high)
        most = float(np.abs(spins).max()) or 1.0
        thin = max(0.25, min(1.1, 12 / math.sqrt(count)))
        # grey in the middle, not white, so that flights without spin are visible
        colours = LinearSegmentedColormap.from_list("spin", ["#0072B2", "#7fb2cf", "#8a8a8a", "#e3a27a", "#D55E00"])
        flights = LineCollection(
            lines, cmap=colours, norm=TwoSlopeNorm(0.0, -most, most), lw=thin, zorder=3, capstyle="round"
        )
        flights.set_array(spins[np.minimum(owner, count)])
        axes.add_collection(flights)
        begin = setup.shape.folded(path[:1, :2])[0]
        axes.plot(*begin, "o", ms=3.4, color=INK, zorder=5)
        if setup.table.bounds == "surface":
            from matplotlib.patches import Circle

            end = setup.shape.folded(path[-1:, :2])[0]
            axes.add_patch(Circle(end, float(setup.ball.radius), fc="#00000018", ec=INK, lw=0.7, zorder=4))
        axes.set_xlim(low[0], high[0])
        axes.set_ylim(low[1], high[1])
        axes.set_aspect("equal", adjustable="box")
        axes.axis("off")
        label = r"$a\,\omega$ (m/s)" if setup.planar else r"$a\,\omega_z$ (m/s)"
        where = (
            {"location": "bottom", "pad": 0.06, "shrink": 0.5, "aspect": 30}
            if long and not tall
            else {"shrink": 0.75, "pad": 0.03, "aspect": 25}
        )
        if not tall:
            figure.subplots_adjust(left=0.02, right=0.98 if long else 0.93, bottom=0.12 if long else 0.02, top=0.98)
        if spins.any():  # (of a mirror's orbit without spin nothing is told by a colour)
            bar = figure.colorbar(flights, ax=axes, label=label, **where)
            bar.outline.set_linewidth(0.4)
        if grid:
            _heights(figure.add_subplot(grid[1]), found, which, count)
    return figure


def _heights(axes: Any, found: Orbit, which: Any, count: int) -> None:
    t, z = found.t[which][:count], found.position[which][:count, 2]
    axes.plot(t, z, color="#0072B2", lw=0.8)
    if count <= 200:
        axes.plot(t, z, ".", color="#0072B2", ms=3)
    axes.set_xlabel(r"$t$ (s)")
    axes.set_ylabel(r"height $z$ of the bounces (m)")
    axes.margins(x=0.01)


def flights_in_cell(shape: Boundary, path: Array, points: int) -> tuple[list[Array], NDArray[np.int64]]:
    """Return the line segments to draw, folded into the periodic cell, and the flight that each belongs to."""
    a, b = path[:-1], path[1:]
    owner = np.arange(len(a)) // points
    if shape.cell is None:
        return list(np.stack([a, b], axis=1)), owner
    lines, who = [], []
    for p, q, k in zip(a, b, owner, strict=True):
        cuts = [0.0, 1.0]
        for j, side in enumerate(shape.cell):
            if math.isfinite(side) and p[j] != q[j]:
                low, high = sorted((p[j] / side + 0.5, q[j] / side + 0.5))
                cuts += [(side * (m - 0.5) - p[j]) / (q[j] - p[j]) for m in range(math.ceil(low), math.floor(high) + 1)]
        cuts = sorted(c for c in cuts if 0 <= c <= 1)
        for u, v in pairwise(cuts):
            middle = p + (u + v) / 2 * (q - p)
            shift = shape.folded(middle[None])[0] - middle
            lines.append(np.array([p + u * (q - p) + shift, p + v * (q - p) + shift]))
            who.append(k)
    return lines, np.array(who)


def table_extent(wall: Boundary, shape: Boundary, path: Array) -> tuple[Array, Array]:
    """Return the corners of the drawing: of the table, and where it is infinite, of the orbit."""
    sides = [f for f in wall.faces if not f.is_lid]
    if shape.cell is not None:
        high = np.array([side / 2 if math.isfinite(side) else -wall.faces[0].offset for side in shape.cell])
        low = -high
    elif wall.sphere is not None:
        low, high = np.full(2, -wall.sphere), np.full(2, wall.sphere)
    elif all(math.isfinite(f.length) for f in sides):
        curve = _curve(wall)
        low, high = curve.min(0), curve.max(0)
    elif len(sides) == 2 and sides[0].normal[0] == 0:  # a strip: from wall to wall
        low, high = np.array([path[:, 0].min(), sides[0].offset]), np.array([path[:, 0].max(), -sides[1].offset])
    else:  # a wedge: from its vertex
        low, high = np.minimum(path.min(0), 0.0), path.max(0)
    margin = 0.04 * float((high - low).max()) + 1e-9
    return low - margin, high + margin


def _curve(shape: Boundary) -> Array:
    """Return points along a closed boundary, its corners among them."""
    flat = shape.without_lids()
    s = np.linspace(0, flat.lengths.sum(), 2001)[:-1]
    return flat.place(np.union1d(s, flat.starts))[1]


def draw_table(axes: Any, setup: OrbitSetup, low: Array, high: Array) -> None:
    """Draw the wall and, where it bounds the surface, the curve of the centre (dashed)."""
    table, shape = setup.table, setup.shape
    both = [(table.wall(), {"color": INK, "lw": 1.2})]
    if table.bounds == "surface":
        both.append((shape, {"color": GREY, "lw": 0.6, "ls": (0, (4, 3))}))
    for one, look in both:
        for line in _outline(one, low, high):
            axes.plot(*line.T, zorder=2, **look)
        for x, y, r, *_ in [*one.outside, *one.images]:
            from matplotlib.patches import Circle

            if one.cell is not None:
                fill = (
                    {"fc": "#e9e5da", "ec": INK, "lw": 0.9}
                    if look["color"] == INK
                    else {"fc": "none", "ec": GREY, "lw": 0.6, "ls": (0, (4, 3))}
                )
                axes.add_patch(Circle((x, y), r, zorder=1.5, **fill))
    if shape.cell is not None:
        w, h = (side / 2 for side in shape.cell)
        for x in (-w, w):
            axes.plot([x, x], [max(-h, low[1]), min(h, high[1])], color=WALL, lw=0.8, ls=(0, (1, 2)), zorder=1)
        if math.isfinite(h):
            for y in (-h, h):
                axes.plot([-w, w], [y, y], color=WALL, lw=0.8, ls=(0, (1, 2)), zorder=1)


def _outline(shape: Boundary, low: Array, high: Array) -> list[Array]:
    """Return the lines to draw: faces, arcs, ellipses, smooth curves."""
    size = float(np.abs([low, high]).sum())
    lines = []
    for n, c, _r, begin, end, *_ in shape.faces:
        if n[2]:
            continue
        s = np.array([max(begin, -size), min(end, size)])
        lines.append(np.multiply(n[:2], c) + s[:, None] * np.array([n[1], -n[0]]))
    for x, y, r, half in shape.inside:
        u = (
            np.linspace(-math.pi / 2, math.pi / 2, 200) + (0 if half >= 0 else math.pi)
            if half
            else np.linspace(0, math.tau, 400)
        )
        lines.append(np.stack([x + r * np.cos(u), y + r * np.sin(u)], axis=-1))
    if shape.cell is None:
        for x, y, r, first, span in shape.outside:
            u = first - np.linspace(0, span, 60)
            lines.append(np.stack([x + r * np.cos(u), y + r * np.sin(u)], axis=-1))
    if shape.ellipse is not None:
        curve = _curve(shape)
        lines.append(np.concatenate([curve, curve[:1]]))
    if shape.curve is not None:
        lines += [shape.curve.place(k, np.linspace(0, length, 200))[0] for k, length in enumerate(shape.curve.lengths)]
    if shape.sphere is not None:
        u = np.linspace(0, math.tau, 400)
        lines.append(shape.sphere * np.stack([np.cos(u), np.sin(u)], axis=-1))
    return lines


def plot_lyapunov(found: Lyapunov) -> Figure:
    """Draw the convergence of Lyapunov exponents with the number of bounces.

    Parameters
    ----------
    found : Lyapunov
        From :func:`carom.billiards.lyapunov`; for several orbits the mean is drawn, with a band of one standard deviation.

    Returns
    -------
    Figure
        A Matplotlib figure.

    Examples
    --------
    >>> from carom import billiards, plot
    >>> table = billiards.stadium()
    >>> len(plot.plot_lyapunov(billiards.lyapunov(table, billiards.starts(table, 3), 200)).axes)
    1
    """
    history = found.history.reshape(len(found.history), -1, found.history.shape[-1])
    bounces = found.bounces * (np.arange(len(history)) + 1) / len(history)
    with style():
        figure = new_figure(5.4, 3.4)
        axes = figure.add_subplot()
        for k in range(history.shape[-1]):
            mean = np.nanmean(history[..., k], axis=1)
            words = rf"$\lambda_{{{k + 1}}}$ = {format_number(float(mean[-1]))}"
            (line,) = axes.plot(bounces, mean, lw=1.2, label=words)
            if history.shape[1] > 1:
                spread = np.nanstd(history[..., k], axis=1)
                axes.fill_between(bounces, mean - spread, mean + spread, color=line.get_color(), alpha=0.15, lw=0)
        axes.axhline(0, color=GREY, lw=0.5, zorder=1)
        axes.set_xlabel("bounces")
        axes.set_ylabel(r"exponents $\lambda_i$ (per bounce)")
        axes.set_xlim(0, found.bounces)
        count = history.shape[1]
        axes.set_title("Lyapunov spectrum" + (f", mean and spread of {count:,} orbits" if count > 1 else ""))
        axes.legend(loc="center left", bbox_to_anchor=(1.0, 0.5), frameon=False, fontsize=8)
        figure.tight_layout()
    return figure
