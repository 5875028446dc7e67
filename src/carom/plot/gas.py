"""A gas drawn: its balls, velocities and spins against Maxwell, temperatures, pair correlation, where the balls go."""

from __future__ import annotations

import math
import os
from typing import Any

import numpy as np
from numpy.typing import NDArray

from carom.engine.swarm_arrays import PLANE
from carom.errors import CaromError
from carom.gas.container import Container
from carom.gas.measure import Distribution, Measures
from carom.gas.session import Session
from carom.plot.drawing import GREY, INK, PALE, sheet
from carom.plot.save import require_writable, save, style

__all__ = ["plot_gas"]

Array = NDArray[np.float64]
# Okabe & Ito's colours, for species and pairs of species.
COLOURS = ("#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9")
MOST_DRAWN = 4000  # balls; of more only a part of the box is drawn
MOST_PAIRS = 6


def plot_gas(session: Session, file: str | os.PathLike[str] | None = None, *, title: str | None = None) -> Any:
    """Draw what a session measured.

    Parameters
    ----------
    session : Session
        One that has measured something.
    file : path of a file to write, .svg, .pdf or .png, optional
    title : left out: the scene in words; "" for none

    Returns
    -------
    matplotlib.figure.Figure: the balls at the end (of spheres those that a plane through the middle cuts, as it cuts them);
    the distributions of velocity and spin, in units of their standard deviation; temperatures over time; g(r) for each pair
    of species; and the mean square displacement or, where there are walls, the density between them. Raises CaromError for a
    file that cannot be written, for a session that has not looked yet, or where Matplotlib is missing.
    """
    if file is not None:
        require_writable(file)
    if session.measures is None or session.measures.looks == 0:
        raise CaromError("plot: expected a gas that was measured, got one without a look at it; run it further")
    with style():
        figure = _draw(session, session.measures, title)
    if file is not None:
        save(figure, file)
    return figure


def _draw(session: Session, measures: Measures, title: str | None) -> Any:
    figure = sheet(7.4, 5.2)
    grid = figure.add_gridspec(2, 3, left=0.075, right=0.985, top=0.875, bottom=0.085, wspace=0.36, hspace=0.42)
    panels = [figure.add_subplot(grid[k // 3, k % 3]) for k in range(6)]
    _balls(panels[0], session)
    _distributions(panels[1], measures, "velocity")
    _distributions(panels[2], measures, "spin")
    _temperatures(panels[3], measures)
    _pair_correlation(panels[4], measures)
    (_displacement if measures.diffuses else _profile)(panels[5], session, measures)
    for k, letter in enumerate("abcdef"):
        place = grid[k // 3, k % 3].get_position(figure)
        figure.text(place.x0 - 0.062, place.y1 + 0.012, letter, fontweight="bold", va="bottom", color=INK)
    words = session.scene.describe() if title is None else title
    figure.text(0.0135, 0.975, words, ha="left", va="top", fontsize=8, color=GREY)
    return figure


def _name(axes: Any, text: str) -> None:
    axes.set_title(text, loc="left", fontsize=8.5, color=INK, pad=5)


# --- the balls -----------------------------------------------------------------------------------------------------


def _balls(axes: Any, session: Session) -> None:
    from matplotlib.collections import EllipseCollection
    from matplotlib.patches import Rectangle

    gas = session.gas
    balls, kinds = gas.balls(), gas._arrays.species
    flat = session.scene.container.axes == 2
    size = np.array(session.scene.container.room.size)
    x, radius = balls.position, kinds["radius"][balls.species]
    names = "xy" if flat else "xz"
    pair = [0, 1] if flat else [0, 2]
    if not flat:  # where a plane cuts them
        depth = np.abs(x[:, 1] - size[1] / 2)
        cut = depth < radius
        x, radius, species = x[cut], np.sqrt(radius[cut] ** 2 - depth[cut] ** 2), balls.species[cut]
        velocity = balls.velocity[cut]
    else:
        species, velocity = balls.species, balls.velocity
    window = size[pair] * min(1.0, math.sqrt(MOST_DRAWN / max(len(x), 1)))
    low = (size[pair] - window) / 2 if window[0] < size[pair][0] else np.zeros(2)
    around = np.array(session.scene.container.room.periodic)[pair]
    x, colours = x[:, pair], _colours(session, species, velocity)
    # in a period what stands out on one side comes in on the other
    shifts = [(i, j) for i in ((-1, 0, 1) if around[0] else (0,)) for j in ((-1, 0, 1) if around[1] else (0,))]
    places = np.concatenate([x + np.array(shift) * size[pair] for shift in shifts])
    radii, inks = np.tile(radius, len(shifts)), np.tile(colours, (len(shifts), 1))
    seen = ((places > low - radii[:, None]) & (places < low + window + radii[:, None])).all(axis=1)
    circles = EllipseCollection(
        2 * radii[seen], 2 * radii[seen], np.zeros(seen.sum()), units="xy", offsets=places[seen],
        offset_transform=axes.transData, facecolors=inks[seen], edgecolors="white", linewidths=0.2,
    )  # fmt: skip
    axes.add_collection(circles)
    _outline(axes, session.scene.container.room, pair, low, window)
    circles.set_clip_path(Rectangle(tuple(low), *window, transform=axes.transData))
    margin = 0.004 * window.max()  # half a line's width
    axes.set_xlim(low[0] - margin, low[0] + window[0] + margin)
    axes.set_ylim(low[1] - margin, low[1] + window[1] + margin)
    axes.set_aspect("equal")
    axes.set_axis_off()
    what = "discs" if flat else f"a cut through the middle, {names[0]} and {names[1]}"
    part = ", part of the box" if window[0] < size[pair][0] else ""
    text = what + part if len(kinds) == 1 else f"{'discs' if flat else 'cut'}{part}: {_listed(session)}"
    place = axes.get_subplotspec().get_position(axes.figure)  # (the panel itself is as narrow as the box)
    axes.figure.text(place.x0, place.y1 + 0.012, text, fontsize=8.5, color=INK, va="bottom")


def _outline(axes: Any, room: Container, pair: list[int], low: Array, window: Array) -> None:
    """The room's walls where the plane of the picture cuts them: dark; a period's border dashed, what is no room shaded.

    A fine grid tells where the walls are: every shape there is, and all that scatterers cut out, by one mechanism.
    """
    n = 400
    over = 0.002 * window  # so that a wall along the border has the grid on both sides
    steps = [np.linspace(low[k] - over[k], low[k] + window[k] + over[k], n) for k in range(2)]
    x = np.zeros((n * n, 3))
    x[:, 1] = room.size[1] / 2
    u, v = np.meshgrid(*steps)
    x[:, pair[0]], x[:, pair[1]] = u.ravel(), v.ravel()
    if any(wall.form != PLANE for wall in room.walls) or room.shape == "polygon":
        gap = np.minimum(room.clearance(np.zeros(n * n), x), max(room.size)).reshape(n, n)
        if (gap < 0).any():
            axes.contourf(u, v, gap, levels=[-np.inf, 0], colors=[PALE], zorder=0)
            axes.contour(u, v, gap, levels=[0], colors=[INK], linewidths=0.8, zorder=3)
    high = low + window
    for axis in range(2):
        bare = room.periodic[pair[axis]] or window[axis] < room.size[pair[axis]]
        round_ = room.shape in {"circle", "cylinder", "ellipse", "stadium"}
        closed = room.shape == "box" or (room.shape != "sphere" and pair[axis] == 2) or (round_ and pair == [0, 2])
        if bare or closed:
            style: dict[str, Any] = {"color": INK, "linewidth": 0.8, "zorder": 3}
            style |= {"dashes": (3, 2)} if bare else {}
            for edge in (low[axis], high[axis]):
                (axes.axvline if axis == 0 else axes.axhline)(edge, **style)


def _listed(session: Session) -> str:
    words = ("blue", "vermilion", "green", "purple", "orange", "sky blue")
    return ", ".join(f"{name} {word}" for name, word in zip(session.names, words, strict=False))


def _colours(session: Session, species: Any, velocity: Array) -> Array:
    """One colour a ball: its species', or, where there is one, the darker the faster."""
    from matplotlib import colormaps
    from matplotlib.colors import to_rgba_array

    if len(session.names) > 1:
        known: Array = np.array(to_rgba_array(COLOURS))[species % len(COLOURS)]
        return known
    speed = np.sqrt((velocity**2).sum(axis=1))
    scale = np.sqrt((speed**2).mean()) if len(speed) else 1.0
    shade = np.clip(speed / (2.2 * (scale or 1.0)), 0, 1)
    inks: Array = np.array(colormaps["Blues"](0.18 + 0.77 * shade))
    return inks


# --- curves --------------------------------------------------------------------------------------------------------


def _distributions(axes: Any, measures: Measures, what: str) -> None:
    c = np.linspace(-5, 5, 201)
    axes.plot(c, np.exp(-(c**2) / 2) / math.sqrt(2 * math.pi), color=GREY, linewidth=1.0, dashes=(4, 2), zorder=1)
    said, shown = [], 0
    for k, name in enumerate(measures.names):
        one: Distribution = getattr(measures, what)(name)
        if math.isnan(one.a2):
            continue
        seen = (one.density > 0) & (np.abs(one.center) < 5)
        many = len(measures.names) > 1
        axes.plot(
            one.center[seen], one.density[seen], ".", markersize=2.6, color=COLOURS[k % len(COLOURS)], zorder=2 + k
        )
        said.append((f"{name}: " if many else "") + f"$a_2$ = {one.a2:+.4f}".replace("-", "−"))
        shown += 1
    axes.set_yscale("log")
    axes.set_xlim(-5, 5)
    axes.set_ylim(2e-6, 1)
    axes.set_xlabel(f"{what} / standard deviation")
    _name(axes, what)
    if shown == 0:
        axes.text(0.5, 0.5, "no spin", transform=axes.transAxes, ha="center", va="center", color=GREY)
    for k, line in enumerate(said[:4]):
        colour = COLOURS[k % len(COLOURS)] if len(said) > 1 else INK
        axes.text(0.5, 0.16 - 0.08 * k + 0.08 * (len(said[:4]) - 1), line, transform=axes.transAxes, ha="center", color=colour,
                  fontsize=7.5)  # fmt: skip
    if what == "velocity":
        axes.text(
            0.98, 0.97, "dashed:\nMaxwell", transform=axes.transAxes, ha="right", va="top", color=GREY, fontsize=7.5
        )


def _temperatures(axes: Any, measures: Measures) -> None:
    from matplotlib.ticker import NullFormatter

    rows = measures.series
    t = rows["time"]
    curves = [("translational", COLOURS[0]), ("rotational", COLOURS[1])]
    values = np.concatenate([rows[name] for name, _colour in curves])
    cools = values.min() > 0 and values.max() / values.min() > 20
    for name, colour in curves:
        if rows[name].any():
            axes.plot(t, rows[name], ".-", markersize=2.5, linewidth=0.8, color=colour, label=name)
    if cools:
        axes.set_yscale("log")
        axes.yaxis.set_minor_formatter(NullFormatter())
        if t[-1] > 20 * t[0] > 0:
            axes.set_xscale("log")
    else:
        axes.set_ylim(0, 1.25 * values.max() if values.max() > 0 else 1)
    axes.set_xlabel("time")
    _name(axes, "temperature")
    axes.legend(
        frameon=False, fontsize=7, loc="lower right", bbox_to_anchor=(1.05, 0.97), ncols=2, handlelength=0.8, handletextpad=0.3,
        columnspacing=0.7, borderaxespad=0.2,
    )  # fmt: skip


def _pair_correlation(axes: Any, measures: Measures) -> None:
    _name(axes, "pair correlation")
    axes.set_xlabel("distance of centres")
    many = len(measures.names) > 1
    pairs = [(a, b) for i, a in enumerate(measures.names) for b in measures.names[i:]]
    top, drawn = 1.0, 0
    for k, (a, b) in enumerate(pairs[:MOST_PAIRS]):
        one = measures.pair_correlation(a, b)
        if len(one.g) == 0 or not np.isfinite(one.g).all():
            continue
        # as wide bins as show more than noise
        step = next((n for n in (1, 2, 3, 5, 10) if one.error.mean() / math.sqrt(n) < 0.05 * max(one.g.mean(), 1)), 15)
        whole = len(one.g) // step * step
        weight = one.distance[:whole] ** (measures.axes - 1)
        g = (one.g[:whole] * weight).reshape(-1, step).sum(axis=1) / weight.reshape(-1, step).sum(axis=1)
        r = one.distance[:whole].reshape(-1, step).mean(axis=1)
        axes.plot(r, g, linewidth=1.0, color=COLOURS[k % len(COLOURS)], label=f"{a} – {b}" if many else None)
        top, drawn = max(top, float(g.max())), drawn + 1
    axes.axhline(1, color=GREY, linewidth=0.6, dashes=(4, 2), zorder=1)
    axes.set_xlim(left=0)
    axes.set_ylim(0, 1.1 * top)
    if drawn == 0:
        axes.text(
            0.5, 0.5, "the box is too small for it", transform=axes.transAxes, ha="center", color=GREY, fontsize=7.5
        )
    elif many:
        axes.legend(frameon=False, fontsize=7.5, loc="upper right", handlelength=1.2, borderaxespad=0.2)
    else:
        contact = measures.pair_correlation(*pairs[0]).contact
        axes.text(
            0.97, 0.95, f"in contact: {contact:.3f}", transform=axes.transAxes, ha="right", va="top", fontsize=7.5
        )


def _displacement(axes: Any, session: Session, measures: Measures) -> None:
    _name(axes, "mean square displacement")
    if not measures.steady:
        hits, square = measures.wandering()
        axes.plot(2 * hits / session.scene.count, square, ".", markersize=3.5, color=COLOURS[0])
        axes.set_xlim(left=0)
        axes.set_ylim(bottom=0)
        axes.set_xlabel("collisions a ball")
        return
    moved = measures.displacement()
    axes.set_xlabel("time")
    axes.plot(moved.lag, moved.square, ".", markersize=3.5, color=COLOURS[0])
    d = moved.diffusion
    if not math.isnan(d):
        late = moved.lag >= moved.lag.max() / 3
        shift = float((moved.square - 2 * measures.axes * d * moved.lag)[late].mean())
        t = np.array([0.0, moved.lag.max()])
        axes.plot(t, 2 * measures.axes * d * t + shift, color=GREY, linewidth=0.9, dashes=(4, 2), zorder=1)
        text = f"$D$ = {d:.4g}"
        axes.text(0.05, 0.93, text, transform=axes.transAxes, va="top", fontsize=7.5, color=INK)
    axes.set_xlim(left=0)
    axes.set_ylim(bottom=0)


def _slices(room: Container, axis: int, bins: int) -> Array:
    """The volume of the room in each of so many slices across an axis, from a lattice of points in the middle of its cells."""
    shape = [61] * len(room.size)  # (a prime: slanted walls do not go through point after point)
    shape[axis] = 4 * bins
    middles = [(np.arange(n) + 0.5) * (size / n) for n, size in zip(shape, room.size, strict=True)]
    x = np.zeros((math.prod(shape), 3))
    for k, grid in enumerate(np.meshgrid(*middles, indexing="ij")):
        x[:, k] = grid.ravel()
    within = room.clearance(0.0, x) > 0
    share = np.moveaxis(within.reshape(shape), axis, 0).reshape(bins, -1).mean(axis=1)
    volume: Array = share * math.prod(room.size) / bins
    return volume


def _profile(axes: Any, session: Session, measures: Measures) -> None:
    """The number density between the walls at the end, along gravity or the first axis with walls."""
    scene = session.scene
    room = scene.container.room
    closed = [k for k, around in enumerate(room.periodic) if not around]
    pulled = [k for k in closed if k < len(scene.pull) and scene.pull[k] != 0]
    axis = (pulled or closed or [0])[0]
    balls = session.gas.balls()
    side, count = room.size[axis], len(balls.species)
    bins = int(np.clip(math.sqrt(count), 8, 60))
    edges = np.linspace(0, side, bins + 1)
    space = _slices(room, axis, bins)
    for k, name in enumerate(session.names):
        found, _ = np.histogram(balls.position[balls.species == k, axis], edges)
        with np.errstate(invalid="ignore"):  # (a slice that no ball gets into has no density)
            density = found / space
        axes.stairs(density, edges, baseline=None, color=COLOURS[k % len(COLOURS)], linewidth=1.0, label=name)
    axes.set_xlim(0, side)
    axes.set_ylim(bottom=0)
    axes.set_xlabel("xyz"[axis])
    _name(axes, "number density at the end")
    if len(session.names) > 1:
        axes.legend(frameon=False, fontsize=7.5, handlelength=1.2, borderaxespad=0.2)
