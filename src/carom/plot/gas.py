"""Figure of a gas: balls, velocity and spin distributions, temperatures, pair correlation, diffusion or density profile."""

from __future__ import annotations

import math
import os
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from carom.errors import CaromError
from carom.gas.containers import BOXES, Container
from carom.gas.edmd.gas_records import PLANE
from carom.gas.measures import Distribution, Measures
from carom.gas.report import UNITS_NOTE, pressure_unit
from carom.gas.results import layers
from carom.gas.scene import GasScene
from carom.gas.session import Session
from carom.plot.style import COLOURS, GREY, INK, PALE, drawn, literal, new_figure
from carom.sweeps.ensembles import Curve, Ensemble

if TYPE_CHECKING:
    from matplotlib.figure import Figure

Array = NDArray[np.float64]
MAX_DRAWN = 4000  # balls; of more only a part of the box is drawn
LEAST_SHOWN = 0.003  # of the longer side: radius of discs that are smaller
MAX_PAIRS = 6  # of species
OUTLINE_POINTS = 400  # along each side of the grid on which walls are found


def plot_gas(session: Session, file: str | os.PathLike[str] | None = None, *, title: str | None = None) -> Figure:
    """Plot what a session measured.

    Parameters
    ----------
    session : Session
        One that has taken samples.
    file : path, optional
        Of a file to write, .svg, .pdf or .png.
    title : str, optional
        Default: the scene in words; "" for none.

    Returns
    -------
    matplotlib.figure.Figure
        The balls at the end (of spheres, the cross-sections by a plane through the middle); the distributions of velocity and
        spin, in units of their standard deviation; temperatures over time; g(r) for each pair of species; and the mean square
        displacement or, where there are walls, the mean number density along gravity or between them.

    Raises
    ------
    CaromError
        For a file that cannot be written, a session without samples, or if Matplotlib is missing.

    Examples
    --------
    >>> from carom.gas import GasScene, Session
    >>> from carom.plot import plot_gas
    >>> contact = {"between": ("a", "a"), "restitution": 1, "friction": 0}
    >>> scene = GasScene(
    ...     container={"shape": "periodic", "size": (8, 8, 8)}, species=[{"count": 64, "radius": 0.5}], contacts=[contact],
    ...     run={"equilibrate": 100, "max_events": 2000},
    ... )
    >>> session = Session(scene)
    >>> session.run()
    True
    >>> len(plot_gas(session).axes)
    6
    """
    if session.measures is None or session.measures.samples == 0:
        raise CaromError("plot_gas: expected a session with samples, got one without; run it further")
    measures = session.measures
    return drawn(lambda: _draw(session, measures, title), file)


def _draw(session: Session, measures: Measures, title: str | None) -> Any:
    figure = new_figure(7.4, 5.2)
    grid = figure.add_gridspec(2, 3, left=0.075, right=0.985, top=0.875, bottom=0.085, wspace=0.36, hspace=0.42)
    panels = [figure.add_subplot(grid[k // 3, k % 3]) for k in range(6)]
    _balls(panels[0], session)
    _distributions(panels[1], measures, "velocity")
    _distributions(panels[2], measures, "spin", session.scene.spins_change)
    _temperatures(panels[3], measures, session.scene.spins_change)
    _pair_correlation(panels[4], measures)
    last = _flow if measures.sheared else (_displacement if measures.has_diffusion else _profile)
    last(panels[5], session, measures)
    for k, letter in enumerate("abcdef"):
        place = grid[k // 3, k % 3].get_position(figure)
        figure.text(place.x0 - 0.062, place.y1 + 0.012, letter, fontweight="bold", va="bottom", color=INK)
    words = session.scene.describe() if title is None else title
    heading(figure, words)
    return figure


def heading(figure: Any, words: str) -> None:
    """Write what a figure of a gas is about, and its units."""
    figure.text(0.0135, 0.985, literal(words), ha="left", va="top", fontsize=8, color=GREY)
    figure.text(0.0135, 0.955, UNITS_NOTE, ha="left", va="top", fontsize=7, color=GREY)


def panel_title(axes: Any, text: str) -> None:
    """Set the title of a panel."""
    axes.set_title(text, loc="left", fontsize=8.5, color=INK, pad=5)


# --- the balls -----------------------------------------------------------------------------------------------------


def _balls(axes: Any, session: Session) -> None:
    from matplotlib.collections import EllipseCollection
    from matplotlib.patches import Rectangle

    gas = session.gas
    balls, kinds = gas.balls(), gas.arrays.materials.species
    flat = session.scene.container.dimensions == 2
    size = np.array(session.scene.container.geometry.size)
    x, radius = balls.position, kinds["radius"][balls.species]
    names = "xy" if flat else "xz"
    pair = [0, 1] if flat else [0, 2]
    # (of spheres their cross-sections by a plane)
    depth = np.zeros(len(x)) if flat else np.abs(x[:, 1] - size[1] / 2)
    cut = depth < radius
    x, radius, species = x[cut], np.sqrt(radius[cut] ** 2 - depth[cut] ** 2), gas.groups[balls.species[cut]]
    velocity = balls.velocity[cut]
    window = size[pair] * min(1.0, math.sqrt(MAX_DRAWN / max(len(x), 1)))
    radius = np.maximum(radius, LEAST_SHOWN * float(window.max())) if flat else radius
    low = (size[pair] - window) / 2 if window[0] < size[pair][0] else np.zeros(2)
    around = np.array(session.scene.container.geometry.periodic)[pair]
    x, colours = x[:, pair], _colours(session, species, velocity)
    # in a periodic box what protrudes on one side enters on the other
    shifts = [(i, j) for i in ((-1, 0, 1) if around[0] else (0,)) for j in ((-1, 0, 1) if around[1] else (0,))]
    places = np.concatenate([x + np.array(shift) * size[pair] for shift in shifts])
    radii, inks = np.tile(radius, len(shifts)), np.tile(colours, (len(shifts), 1))
    seen = ((places > low - radii[:, None]) & (places < low + window + radii[:, None])).all(axis=1)
    circles = EllipseCollection(
        2 * radii[seen], 2 * radii[seen], np.zeros(seen.sum()), units="xy", offsets=places[seen],
        offset_transform=axes.transData, facecolors=inks[seen], edgecolors="white", linewidths=0.2,
    )  # fmt: skip
    axes.add_collection(circles)
    draw_outline(axes, session.scene.container.geometry, pair, low, window)
    circles.set_clip_path(Rectangle(tuple(low), *window, transform=axes.transData))
    margin = 0.004 * window.max()  # half a line's width
    axes.set(
        xlim=(low[0] - margin, low[0] + window[0] + margin),
        ylim=(low[1] - margin, low[1] + window[1] + margin),
        aspect="equal",
    )
    axes.set_axis_off()
    what = "discs" if flat else f"middle cross-section, {names[0]} and {names[1]}"
    part = ", part of the box" if window[0] < size[pair][0] else ""
    text = (
        what + part if len(session.names) == 1 else f"{'discs' if flat else 'cross-section'}{part}: {_listed(session)}"
    )
    place = axes.get_subplotspec().get_position(axes.figure)  # (the panel itself is as narrow as the box)
    axes.figure.text(place.x0, place.y1 + 0.012, literal(text), fontsize=8.5, color=INK, va="bottom")
    if len(session.names) == 1:
        axes.text(
            0.5, -0.02, "darker: faster", transform=axes.transAxes, ha="center", va="top", fontsize=7.5, color=GREY
        )


def draw_outline(axes: Any, container: Container, pair: list[int], low: Array, window: Array) -> None:
    """Draw the walls where the plane of the figure cuts them; periodic borders are dashed, and the outside is shaded.

    The walls are contours on a fine grid: one mechanism for every shape, and for obstacles.
    """
    n = OUTLINE_POINTS
    over = 0.002 * window  # so that a wall along the border has grid points on both sides
    steps = [np.linspace(low[k] - over[k], low[k] + window[k] + over[k], n) for k in range(2)]
    x = np.zeros((n * n, 3))
    x[:, 1] = container.size[1] / 2
    u, v = np.meshgrid(*steps)
    x[:, pair[0]], x[:, pair[1]] = u.ravel(), v.ravel()
    if container.shape not in BOXES or any(face.form != PLANE for face in container.faces):
        gap = np.minimum(container.clearance(np.zeros(n * n), x), max(container.size)).reshape(n, n)
        if (gap < 0).any():
            axes.contourf(u, v, gap, levels=[-np.inf, 0], colors=[PALE], zorder=0)
            axes.contour(u, v, gap, levels=[0], colors=[INK], linewidths=0.8, zorder=3)
    for face in container.faces:
        if face.thin:  # (a side of a plate)
            along, at = np.asarray(face.along), np.asarray(face.centre)
            ends = np.array([at + (end - at @ along) * along for end in (face.low, face.high)])[:, pair]
            axes.plot(*ends.T, color=INK, linewidth=0.8, zorder=3)
    high = low + window
    for axis in range(2):
        bare = container.periodic[pair[axis]] or window[axis] < container.size[pair[axis]]
        round_ = container.shape in {"circle", "cylinder", "ellipse", "stadium", "rectangle"}
        closed = (
            container.shape == "box" or (container.shape != "sphere" and pair[axis] == 2) or (round_ and pair == [0, 2])
        )
        if bare or closed:
            style: dict[str, Any] = {"color": INK, "linewidth": 0.8, "zorder": 3}
            style |= {"dashes": (3, 2)} if bare else {}
            for edge in (low[axis], high[axis]):
                (axes.axvline if axis == 0 else axes.axhline)(edge, **style)


def _listed(session: Session) -> str:
    words = ("blue", "vermilion", "green", "purple", "orange", "sky blue")
    return ", ".join(f"{name} {word}" for name, word in zip(session.names, words, strict=False))


def _colours(session: Session, species: Any, velocity: Array) -> Array:
    """Return one colour per ball: by species or, where there is one, darker with speed."""
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


def _distributions(axes: Any, measures: Measures, what: str, changes: bool = True) -> None:
    said, shown = [], 0
    for k, name in enumerate(measures.names):
        one: Distribution = getattr(measures, what)(name)
        if math.isnan(one.a2) or not changes:
            continue
        if shown == 0:
            draw_maxwell(axes)
        seen = (one.density > 0) & (np.abs(one.center) < 5)
        many = len(measures.names) > 1
        axes.plot(
            one.center[seen], one.density[seen], ".", markersize=2.6, color=COLOURS[k % len(COLOURS)], zorder=2 + k
        )
        said.append((f"{literal(name)}: " if many else "") + f"$a_2$ = {one.a2:+.4f}".replace("-", "−"))
        shown += 1
    axes.set_yscale("log")
    axes.set(xlim=(-5, 5), ylim=(2e-6, 1), xlabel=f"{what} / standard deviation")
    panel_title(axes, what)
    if shown == 0:
        note_no_spin(axes, changes)
    for k, line in enumerate(said[:4]):
        colour = COLOURS[k % len(COLOURS)] if len(said) > 1 else INK
        axes.text(0.5, 0.16 - 0.08 * k + 0.08 * (len(said[:4]) - 1), line, transform=axes.transAxes, ha="center", color=colour,
                  fontsize=7.5)  # fmt: skip
    if what == "velocity":
        note_maxwell(axes, 0.98, "right")


def note_no_spin(axes: Any, changes: bool) -> None:
    """Write why there is no distribution of spins."""
    text = "no spin" if changes else "smooth: no spin changes"
    axes.text(0.5, 0.5, text, transform=axes.transAxes, ha="center", va="center", color=GREY)


def draw_maxwell(axes: Any) -> None:
    """Draw the Maxwellian, dashed."""
    c = np.linspace(-5, 5, 201)
    axes.plot(c, np.exp(-(c**2) / 2) / math.sqrt(2 * math.pi), color=GREY, linewidth=1.0, dashes=(4, 2), zorder=1)


def note_maxwell(axes: Any, x: float, align: str) -> None:
    """Write what the dashed line is."""
    style: dict[str, Any] = {"transform": axes.transAxes, "color": GREY, "fontsize": 7.5}
    axes.text(x, 0.97, "dashed:\nMaxwell", ha=align, va="top", **style)


def scale_temperatures(axes: Any, times: Array, values: Array) -> None:
    """Make the axes of temperatures and times logarithmic where the former fall by a factor of 20, else begin at zero."""
    from matplotlib.ticker import NullFormatter

    cools = bool(values.min() > 0 and values.max() / values.min() > 20)
    if cools:
        axes.set_yscale("log")
        axes.yaxis.set_minor_formatter(NullFormatter())
    else:
        axes.set_ylim(0, 1.25 * values.max() if values.max() > 0 else 1)
    if cools and times[-1] > 20 * times[0] > 0:
        axes.set_xscale("log")


def _temperatures(axes: Any, measures: Measures, spins_change: bool) -> None:
    rows = measures.series
    t = rows["time"]
    curves = [("translational", COLOURS[0]), ("rotational", COLOURS[1])][: 1 + spins_change]
    for name, colour in curves:
        if rows[name].any():
            axes.plot(t, rows[name], ".-", markersize=2.5, linewidth=0.8, color=colour, label=name)
    scale_temperatures(axes, t, np.concatenate([rows[name] for name, _colour in curves]))
    axes.set_xlabel("time, s")
    panel_title(axes, "temperature, J")
    axes.legend(
        frameon=False, fontsize=6.5, loc="lower right", bbox_to_anchor=(1.07, 0.97), ncols=2, handlelength=0.8, handletextpad=0.3,
        columnspacing=0.7, borderaxespad=0.2,
    )  # fmt: skip


def pair_title(layered: bool) -> str:
    """Return the title of a pair correlation; ``layered``: it is relative to the density at each place."""
    return "pair correlation (local density)" if layered else "pair correlation"


def _pair_correlation(axes: Any, measures: Measures) -> None:
    panel_title(axes, pair_title(measures.is_layered))
    axes.set_xlabel("distance of centres, m")
    many = len(measures.names) > 1
    pairs = [(a, b) for i, a in enumerate(measures.names) for b in measures.names[i:]]
    top, drawn = 1.0, 0
    for k, (a, b) in enumerate(pairs[:MAX_PAIRS]):
        one = measures.pair_correlation(a, b)
        if len(one.g) == 0 or not np.isfinite(one.g).all():
            continue
        # bins wide enough to show more than noise
        step = next((n for n in (1, 2, 3, 5, 10) if one.error.mean() / math.sqrt(n) < 0.05 * max(one.g.mean(), 1)), 15)
        whole = len(one.g) // step * step
        weight = one.distance[:whole] ** (measures.dimensions - 1)
        g = (one.g[:whole] * weight).reshape(-1, step).sum(axis=1) / weight.reshape(-1, step).sum(axis=1)
        r = one.distance[:whole].reshape(-1, step).mean(axis=1)
        axes.plot(r, g, linewidth=1.0, color=COLOURS[k % len(COLOURS)], label=literal(f"{a} – {b}") if many else None)
        top, drawn = max(top, float(g.max())), drawn + 1
    axes.axhline(1, color=GREY, linewidth=0.6, dashes=(4, 2), zorder=1)
    axes.set(xlim=(0, None), ylim=(0, 1.1 * top))
    if drawn == 0:
        why = "not counted where images slide" if measures.sheared else "the box is too small"
        axes.text(0.5, 0.5, why, transform=axes.transAxes, ha="center", color=GREY, fontsize=7.5)
    elif many:
        axes.legend(frameon=False, fontsize=7.5, loc="upper right", handlelength=1.2, borderaxespad=0.2)
    else:
        one = measures.pair_correlation(*pairs[0])
        text, y = f"at contact: {one.contact:.3f} ± {one.contact_error:.2g}", 0.95
        if math.isnan(one.contact):  # (the curve is ragged then, and near the top)
            text, y = "at contact: too few pairs", 0.12
        axes.text(0.97, y, text, transform=axes.transAxes, ha="right", va="top", fontsize=7.5)


def _displacement(axes: Any, session: Session, measures: Measures) -> None:
    panel_title(axes, "mean square displacement, m²")
    if not measures.is_stationary:
        collisions, square = measures.displacement_by_collisions()
        axes.plot(2 * collisions / session.scene.count, square, ".", markersize=3.5, color=COLOURS[0])
        axes.set(xlim=(0, None), ylim=(0, None), xlabel="collisions per ball")
        return
    moved = measures.displacement()
    axes.set_xlabel("lag time, s")
    axes.plot(moved.lag, moved.square, ".", markersize=3.5, color=COLOURS[0])
    d = moved.diffusion
    if not math.isnan(d):
        late = moved.lag >= moved.lag.max() / 3
        shift = float((moved.square - 2 * measures.dimensions * d * moved.lag)[late].mean())
        t = np.array([0.0, moved.lag.max()])
        axes.plot(t, 2 * measures.dimensions * d * t + shift, color=GREY, linewidth=0.9, dashes=(4, 2), zorder=1)
        text = f"$D$ = {d:.4g} m²/s"
        axes.text(0.05, 0.93, text, transform=axes.transAxes, va="top", fontsize=7.5, color=INK)
    axes.set(xlim=(0, None), ylim=(0, None))


def _flow(axes: Any, session: Session, _measures: Measures) -> None:
    """Plot the mean velocity of a sheared gas in layers, and the flow of its images."""
    layers = session.result.averages.layers
    assert layers is not None
    middle, rate = (layers.edges[1:] + layers.edges[:-1]) / 2, session.scene.shear_rate
    axes.plot(rate * (layers.edges - layers.edges[-1] / 2), layers.edges, color=GREY, linewidth=0.8)
    for k, name in enumerate(session.names):
        axes.plot(
            layers.velocity[k, :, 0], middle, ".", color=COLOURS[k % len(COLOURS)], markersize=4, label=literal(name)
        )
    axes.set(ylim=(0, layers.edges[-1]), xlabel="mean velocity along x, m/s", ylabel="y, m")
    panel_title(axes, "mean velocity across the flow")


def _profile(axes: Any, session: Session, measures: Measures) -> None:
    """Plot the mean number density along gravity, or between the walls."""
    for k, name in enumerate(session.names):
        one = measures.profile(name)
        axes.stairs(
            one.density, one.edges, baseline=None, color=COLOURS[k % len(COLOURS)], linewidth=1.0, label=literal(name)
        )
    axes.set(xlim=(0, one.edges[-1]), ylim=(0, None), xlabel=f"{one.axis}, m")
    panel_title(axes, density_title(session.scene))
    if len(session.names) > 1:
        axes.legend(frameon=False, fontsize=7.5, handlelength=1.2, borderaxespad=0.2)


def density_title(scene: GasScene) -> str:
    """Return the title of a density profile, with its unit."""
    return f"mean number density, 1/m{'²' if scene.container.dimensions == 2 else '³'}"


# ----------------------------------------------------------------------------------------------------
# Figure of an ensemble of gases: means of its curves with bands of their standard errors, and what each member has.


BAND = 0.3  # opacity


def plot_ensemble(
    ensemble: Ensemble, file: str | os.PathLike[str] | None = None, *, title: str | None = None
) -> Figure:
    """Plot what an ensemble measured.

    Parameters
    ----------
    ensemble : Ensemble
    file : path, optional
        Of a file to write, .svg, .pdf or .png.
    title : str, optional
        Default: the scene in words; "" for none.

    Returns
    -------
    matplotlib.figure.Figure
        Means over the members, with bands of one standard error: the distributions of velocity and spin, temperatures over time,
        g(r) for each pair of species, the mean square displacement or, between walls, the number density; and the pressure of each
        member.

    Raises
    ------
    CaromError
        For a file that cannot be written, an ensemble without samples, or if Matplotlib is missing.

    Examples
    --------
    >>> from carom.gas import GasScene
    >>> from carom.plot import plot_ensemble
    >>> from carom.sweeps import gas_ensemble
    >>> contact = {"between": ("a", "a"), "restitution": 1, "friction": 0}
    >>> scene = GasScene(
    ...     container={"shape": "periodic", "size": (8, 8, 8)}, species=[{"count": 64, "radius": 0.5}], contacts=[contact],
    ...     run={"equilibrate": 100, "max_events": 2000},
    ... )
    >>> len(plot_ensemble(gas_ensemble(scene, 3)).axes)
    6
    """
    if not ensemble.curves:
        raise CaromError("plot_ensemble: expected an ensemble with samples, got one without; run it for longer")
    return drawn(lambda: _draw_ensemble(ensemble, title), file)


def _draw_ensemble(ensemble: Ensemble, title: str | None) -> Any:
    curves, names = ensemble.curves, [one.name for one in ensemble.scene.species]
    scene = ensemble.scene
    axis, layered = layers(scene.container.geometry, scene.gravity_vector, [one.wall for one in scene.drives])
    figure = new_figure(7.4, 5.2)
    axes = figure.subplots(2, 3).ravel()
    figure.subplots_adjust(left=0.075, right=0.985, top=0.875, bottom=0.085, wspace=0.36, hspace=0.42)
    pairs = [(f"{a} – {b}", f"pair_correlation.{a}.{b}") for i, a in enumerate(names) for b in names[i:]]
    _panel(axes[0], "velocity", {name: curves[f"velocity.{name}"] for name in names}, "velocity / standard deviation")
    spins = {name: curves[f"spin.{name}"] for name in names if scene.spins_change and curves[f"spin.{name}"].mean.any()}
    _panel(axes[1], "spin", spins, "spin / standard deviation")
    if not spins:
        note_no_spin(axes[1], scene.spins_change)
    note_maxwell(axes[0], 0.02, "left")
    for one in axes[: 1 + bool(spins)]:
        draw_maxwell(one)
        one.set_yscale("log")
        one.set(xlim=(-5, 5), ylim=(2e-6, 1))
    warm = {name: curves[f"temperature_{name}"] for name in ("translational", "rotational")[: 1 + scene.spins_change]}
    _panel(axes[2], "temperature, J", {name: one for name, one in warm.items() if one.mean.any()}, "time, s")
    scale_temperatures(axes[2], warm["translational"].x, np.array([one.mean for one in warm.values()]))
    found = {name: curves[key] for name, key in pairs[:MAX_PAIRS]}
    _panel(axes[3], pair_title(layered), found, "distance of centres, m")
    axes[3].axhline(1, color=GREY, linewidth=0.6, dashes=(4, 2), zorder=1)
    if "displacement" in curves:
        _panel(axes[4], "mean square displacement, m²", {"": curves["displacement"]}, "lag time, s")
    elif "displacement_by_collisions" in curves:
        one = {"": curves["displacement_by_collisions"]}
        _panel(axes[4], "mean square displacement, m²", one, "collisions per ball")
    else:
        slices = {name: curves[f"density.{name}"] for name in names}
        _panel(axes[4], density_title(scene), slices, f"{'xyz'[axis]}, m")
        axes[4].set_ylim(bottom=0)
    _members(axes[5], ensemble)
    words = f"{len(ensemble.seeds)} gases: {ensemble.scene.describe()}" if title is None else title
    heading(figure, words)
    return figure


def _panel(axes: Any, title: str, curves: dict[str, Curve], label: str) -> None:
    """Draw curves with their bands."""
    for k, (name, one) in enumerate(curves.items()):
        colour = COLOURS[k % len(COLOURS)]
        # (a bin that no ball of any member was in has no place on a logarithmic axis)
        mean = np.where(one.mean == 0, np.nan, one.mean)
        axes.plot(one.x, mean, color=colour, linewidth=0.9, label=literal(name))
        axes.fill_between(one.x, mean - one.error, mean + one.error, color=colour, alpha=BAND, linewidth=0)
    panel_title(axes, title)
    axes.set_xlabel(label)
    if len(curves) > 1:
        axes.legend(frameon=False, fontsize=7, handlelength=1.0, borderaxespad=0.2)


def _members(axes: Any, ensemble: Ensemble) -> None:
    """Draw the pressure of each member, the mean, and its standard error."""
    from matplotlib.ticker import MaxNLocator

    values = [one["pressure"] for one in ensemble.members]
    mean, error = ensemble.mean["pressure"], ensemble.error["pressure"]
    axes.plot(np.arange(1, len(values) + 1), values, "o", markersize=3, color=COLOURS[0])
    axes.axhline(mean, color=GREY, linewidth=0.9)
    axes.axhspan(mean - error, mean + error, color=GREY, alpha=BAND, linewidth=0)
    panel_title(axes, f"pressure of each gas, {pressure_unit(ensemble.scene)}")
    axes.set_xlabel("gas")
    axes.xaxis.set_major_locator(MaxNLocator(integer=True))
