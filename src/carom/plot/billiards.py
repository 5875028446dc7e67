"""Plot orbits of single-particle billiards: paths in the table, and the convergence of Lyapunov exponents."""

from __future__ import annotations

import math
from collections.abc import Sequence
from itertools import pairwise
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from carom.billiards import Lyapunov, Orbit, is_regular
from carom.billiards.boundary import Boundary
from carom.billiards.continuation import Manifold, OrbitBranch
from carom.billiards.periodic import PeriodicOrbit
from carom.billiards.rolling import RollingRun
from carom.billiards.setup import OrbitSetup
from carom.errors import CaromError
from carom.formatting import format_number
from carom.plot.style import COLOURS as ORBITS
from carom.plot.style import GREY, INK, literal, new_figure, style

if TYPE_CHECKING:
    from matplotlib.figure import Figure

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
        size = (6.4, max(2.6, 5.2 * height / width + 1.5) if long else min(5.8, 5.2 * height / width + 0.9))
        figure = new_figure(8.4 if tall else size[0], 4.2 if tall else size[1])
        axes, *heights = figure.subplots(1, 1 + tall, squeeze=False)[0]
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
        axes.annotate("start", begin, (4, 4), textcoords="offset points", fontsize=7, color=INK, zorder=6)
        axes.set_title(_title(found).replace(f"{found.t.shape[-1]:,} bounces", f"{count:,} bounces"), fontsize=8)
        if setup.table.bounds == "surface":
            from matplotlib.patches import Circle

            end = setup.shape.folded(path[-1:, :2])[0]
            axes.add_patch(Circle(end, float(setup.ball.radius), fc="#00000018", ec=INK, lw=0.7, zorder=4))
        axes.set(xlim=(low[0], high[0]), ylim=(low[1], high[1]), aspect="equal")
        axes.axis("off")
        label = r"$a\,\omega$ (m/s)" if setup.planar else r"$a\,\omega_z$ (m/s)"
        where = (
            {"location": "bottom", "pad": 0.06, "shrink": 0.5, "aspect": 30}
            if long and not tall
            else {"shrink": 0.75, "pad": 0.03, "aspect": 25}
        )
        if tall:
            figure.subplots_adjust(wspace=0.32, left=0.03, right=0.97, bottom=0.14)
            _heights(heights[0], found, which, count)
        else:
            figure.subplots_adjust(left=0.02, right=0.98 if long else 0.93, bottom=0.12 if long else 0.02, top=0.88)
        if spins.any():  # (of a mirror's orbit without spin nothing is told by a colour)
            bar = figure.colorbar(flights, ax=axes, label=label, **where)
            bar.outline.set_linewidth(0.4)
    return figure


def _heights(axes: Any, found: Orbit, which: Any, count: int) -> None:
    t, z = found.t[which][:count], found.position[which][:count, 2]
    axes.plot(t, z, color="#0072B2", lw=0.8)
    if count <= 200:
        axes.plot(t, z, ".", color="#0072B2", ms=3)
    axes.set(xlabel=r"$t$ (s)", ylabel=r"height $z$ of the bounces (m)")
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
    dashed: dict[str, Any] = {"lw": 0.6, "ls": (0, (4, 3))}
    both: list[Any] = [(table.wall(), {"color": INK, "lw": 1.2}, {"fc": "#e9e5da", "ec": INK, "lw": 0.9})]
    if table.bounds == "surface":
        both.append((shape, {"color": GREY, **dashed}, {"fc": "none", "ec": GREY, **dashed}))
    for one, look, fill in both:
        for line in _outline(one, low, high):
            axes.plot(*line.T, zorder=2, snap=False, **look)
        for x, y, r, *_ in [*one.outside, *one.images]:
            from matplotlib.patches import Circle

            if one.cell is not None:
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
    if shape.cell is None:
        lines += [wall.place(np.linspace(0, wall.length, 400))[0] for wall in shape.walls[len(shape.faces) :]]
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
        axes.set(xlabel="bounces", ylabel=r"exponents $\lambda_i$ (per bounce)", xlim=(0, found.bounces))
        count = history.shape[1]
        axes.set_title("Lyapunov spectrum" + (f", mean and spread of {count:,} orbits" if count > 1 else ""))
        axes.legend(loc="center left", bbox_to_anchor=(1.0, 0.5), frameon=False, fontsize=8)
        figure.tight_layout()
    return figure


# ----------------------------------------------------------------------------------------------------
# Plot periodic orbits of billiards: each in its table, and branches of them.


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
            number = f"multiplier {one.multipliers[0].real:.4g}"
            if one.rotation_number is not None:
                number = f"rotation number {one.rotation_number:.4f}"
            said = f"{one.period} bounces, {one.stability}\n{number}"
            axes.set_title(said, fontsize=8, color=COLOURS[one.stability])
    return figure


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


# ----------------------------------------------------------------------------------------------------
# Velocity phase portraits and boundary maps of single-particle billiards, orbits on curves (islands) highlighted.


SEA = "#5f6368"
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
    >>> from carom.plot.billiards import on_curves
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
        f"{literal(', '.join([table.name, *sizes]))}; boundary of the ball's {table.bounds}\n{literal(found.setup.law)},"
        f" $\\kappa$ = {format_number(float(found.setup.ball.kappa), 4)}; {orbits} of {found.t.shape[-1]:,} bounces"
    )


def _legend(axes: Any, curves: NDArray[np.bool_], below: float) -> None:
    """Write what the inks mean, with the numbers of orbits, below the axes."""
    from matplotlib.lines import Line2D

    inks = [(SEA, "others: no invariant curve detected", int((~curves).sum()))]
    inks.append((ORBITS[0], "islands: on smooth curves (any colour but grey)", int(curves.sum())))
    dots = [
        Line2D([], [], ls="", marker="o", ms=4, mew=0, color=ink, label=f"{words}  ({count:,})")
        for ink, words, count in inks
        if count
    ]
    axes.legend(handles=dots, loc="upper center", bbox_to_anchor=(0.5, below), ncols=1, frameon=False, fontsize=8,
                handletextpad=0.2)  # fmt: skip


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
        ticks = [-1, -0.5, 0, 0.5, 1]
        axes.set(xlim=(-1.04, 1.04), ylim=(-1.04, 1.04), xticks=ticks, yticks=ticks, aspect="equal")
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
        axes.set(ylim=(-1, 1), xlabel=r"arc length  $s$ (m)", ylabel=r"$\sin\theta = v_t/|v|$")
        figure.tight_layout()
    return figure


def _scatter(axes: Any, x: Array, y: Array, curves: NDArray[np.bool_]) -> None:
    """Draw points of many orbits (N, B), islands above the sea; rasterised where there are many, to keep vector files small."""
    many = x.size > 20_000
    sea = ~curves
    # (a dot is the smaller the more there are)
    look = {"s": float(np.clip(4e4 / max(x.size, 1), 0.02, 6.0)), "lw": 0, "rasterized": many}
    if sea.any():
        axes.scatter(x[sea].ravel(), y[sea].ravel(), c=SEA, alpha=0.6, zorder=3, label="_sea", **look)
    for k in np.flatnonzero(curves).tolist():
        ink = ORBITS[int(np.count_nonzero(curves[:k])) % len(ORBITS)]
        axes.scatter(x[k], y[k], c=ink, zorder=4, label="_island", **look)


# ----------------------------------------------------------------------------------------------------
# Plot balls that roll on surfaces: a run from above and from the side.


ROLLS, FLIES = "#0072B2", "#D55E00"
ROLLING_POINTS = 1200


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
    states = run.at(np.linspace(0.0, run.duration, ROLLING_POINTS))
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
