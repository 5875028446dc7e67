"""Maps of sweeps: an outcome over one or two dimensions, with small multiples for a third; and of a plan of shots."""

from __future__ import annotations

import itertools
import math
import os
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import numpy as np

from carom.errors import CaromError, Fault, did_you_mean
from carom.formatting import counted, format_number
from carom.plot.style import GREY, INK, drawn, literal, new_figure, require_matplotlib, style

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from carom.fitting.design import Plan
    from carom.sweeps.aiming import Windows

MOST_PANELS = 16
MAP = "viridis"
LEAST_BAR = 0.7  # degrees
REPEAT = "repeat"  # the dimension of repeated points
# Colours of named outcomes (phases, pockets, laws): told apart in grey, and by those who see few colours (Okabe & Ito 2008).
NAMED = ("#0072B2", "#E69F00", "#009E73", "#CC79A7", "#56B4E9", "#D55E00", "#F0E442", "#666666", "#bbbbbb", "#44AA99")
NOTHING = "#ececec"
MOST_STEPS = 16  # of colours, one for each whole number
EVENTS = {
    "wall": "impacts on walls",
    "floor": "landings on the floor",
    "ball": "collisions of balls",
    "pocketed": "balls pocketed",
}


def plot_sweep(
    found: Any,
    of: str | None = None,
    *,
    x: str | None = None,
    y: str | None = None,
    panels: str | None = None,
    at: Mapping[str, Any] | None = None,
) -> Figure:
    """Draw an outcome of a sweep: a line over one dimension, a map over two, small multiples for a third.

    Of numbers, the mean over repeats is drawn, along a line with its standard error, unless ``repeat`` is one of the dimensions
    chosen.

    Parameters
    ----------
    found : xarray.Dataset
        The result of a sweep.
    of : str, optional
        Name of the outcome; default: the first.
    x, y, panels : str, optional
        Dimensions along x and y, and of the panels. Default: the dimensions in their order; numbers before names.
    at : mapping of dimensions to values, optional
        Where along the other dimensions; the nearest value is taken. Default: the first, as the title says.

    Returns
    -------
    Figure
        A Matplotlib figure. Points without an outcome stay grey.

    Raises CaromError for names that are not there, and for more than 16 panels.

    Examples
    --------
    >>> import numpy as np, carom
    >>> case = carom.sweeps.ImpactCase(restitution=0.85)
    >>> space = carom.Space(case, {"angle": np.linspace(5, 80, 16), "friction": [0.1, 0.2, 0.3], "law": ["two-step", "stronge"]})
    >>> found = carom.sweep(space, keep=["reflection_angle"]).run()
    >>> len(carom.plot.plot_sweep(found, x="angle", y="friction", panels="law").axes)
    3
    """
    names = [str(name) for name in found.data_vars if name != "failed"]
    of = of or names[0]
    if of not in found:
        raise CaromError(Fault("plot", "of", f"an outcome of {', '.join(names)}", repr(of), did_you_mean(of, names)))
    array, title, error = found[of], [_in_words(of)], None
    dims = [str(dim) for dim in array.dims]
    for option, dim in (("x", x), ("y", y), ("panels", panels), *(("at", dim) for dim in at or ())):
        if dim is not None and dim not in dims:
            raise CaromError(
                Fault("plot", f"{option}", f"a dimension of {', '.join(dims)}", repr(dim), did_you_mean(dim, dims))
            )
    named = REPEAT in (x, y, panels, *(at or {}))
    if REPEAT in dims and not named and "flag_meanings" not in array.attrs:
        array, error = _mean_over_repeats(array)
        title.append(f"mean of {found.sizes[REPEAT]:,} repeats")
        dims.remove(REPEAT)
    free = [dim for dim in dims if dim not in (at or {}) and dim not in (x, y, panels) and found.sizes[dim] > 1]
    own = [dim for dim in free if dim not in found["failed"].dims]  # (ball, axis)
    free = sorted((dim for dim in free if dim not in own), key=lambda dim: _is_named(found, dim))
    x = x or (free.pop(0) if free else None)
    if x is None:
        raise CaromError("plot: expected at least one dimension to draw along, got none; leave one out of at")
    y = y or (free.pop(0) if free and not _is_named(found, free[0]) else None)
    panels = panels or (free.pop(0) if free and found.sizes[free[0]] <= MOST_PANELS else None)
    for dim in dims:
        if dim not in (x, y, panels):
            value = (at or {}).get(dim)
            error = None if error is None else _chosen(error, dim, value)[0]
            array, said = _chosen(array, dim, value)
            if found.sizes[dim] > 1:
                title.append(said)
    count = 1 if panels is None else found.sizes[panels]
    if count > MOST_PANELS:
        raise CaromError(
            f"plot: panels: expected at most {MOST_PANELS} values, got {count} of {panels}; draw another dimension"
        )
    if error is not None and y is None:
        title[1] += " ± standard error"
    return _draw(array, error, x, y, panels, ", ".join(title))


def _mean_over_repeats(array: Any) -> tuple[Any, Any]:
    """Return mean and standard error over the repeats that have an outcome."""
    known = array.where(array >= 0) if array.dtype.kind == "i" else array.where(np.isfinite(array))
    count = known.notnull().sum(REPEAT)
    mean, error = known.mean(REPEAT, keep_attrs=True), known.std(REPEAT, ddof=1) / np.sqrt(count)
    return mean.rename(array.name), error.where(count > 1)


def _is_named(found: Any, dim: str) -> bool:
    return dim in found.coords and found[dim].dtype.kind in "UO"


def _chosen(array: Any, dim: str, value: Any) -> tuple[Any, str]:
    """Return the array at a value of a dimension, the first by default, and a few words on it."""
    if dim not in array.coords:
        k = 0 if value is None else int(value)
        return array.isel({dim: k}), f"{_in_words(dim)} {k}"
    coordinate = array[dim]
    if value is None:
        k = 0
    elif coordinate.dtype.kind in "UO":
        known = [str(one) for one in coordinate.values]
        if str(value) not in known:
            raise CaromError(
                Fault("plot", "at", f"{dim} of {', '.join(known)}", repr(value), did_you_mean(str(value), known))
            )
        k = known.index(str(value))
    else:
        try:
            k = int(np.abs(coordinate.values - float(value)).argmin())
        except ValueError:
            raise CaromError(f"plot: at: expected a number for {dim}, got {value!r}") from None
    return array.isel({dim: k}), f"{_name(array, dim)} {_text(coordinate.values[k], coordinate)}"


def _text(value: Any, coordinate: Any) -> str:
    if coordinate.dtype.kind in "UO":
        return str(value)
    return f"{format_number(float(value))} {coordinate.attrs.get('units', '')}".strip()


def _in_words(path: str) -> str:
    """Return words for the name of an outcome, or for the path to a number."""
    words = path.replace("_", " ")
    match words.split("."):
        case ["events", "count"]:
            words = "number of events"
        case ["events", kind, "count"]:
            words = f"number of {EVENTS.get(kind, f'{kind} events')}"
        case ["events", kind, number, part]:
            words = f"{part} at {kind} event {number}"
        case ["final", part]:
            words = f"final {part}"
        case ["lyapunov", part]:
            words = f"Lyapunov exponents: {part}"
        case ["bounces", "count"]:
            words = "number of bounces"
        case [("balls" | "walls") as group, which, *_part, last]:
            words = f"{last} of all {group}" if which == "*" else f"{last} of {group.removesuffix('s')} {which}"
        case [part, last]:
            words = f"{last} of the {part}"
    return words


def _name(array: Any, dim: str) -> str:
    """Return words for a dimension: what runs along it, where that is one number."""
    path = array[dim].attrs.get("path") if dim in array.coords else None
    return _in_words(dim if path is None else path)


def _with_units(words: str, attrs: Mapping[str, Any]) -> str:
    return literal(f"{words} ({attrs['units']})" if attrs.get("units") else words)


def _label(array: Any, dim: str) -> str:
    return _with_units(_name(array, dim), array[dim].attrs if dim in array.coords else {})


def _draw(array: Any, error: Any, x: str, y: str | None, panels: str | None, title: str) -> Figure:
    from matplotlib.ticker import MaxNLocator

    with style():
        outcome = _with_units(_in_words(str(array.name)), array.attrs)
        count = 1 if panels is None else array.sizes[panels]
        # (as few empty places as possible)
        columns = min(count, min((3, 2, 4) if count <= 6 else (3, 4, 2), key=lambda n: -count % n))
        rows = math.ceil(count / columns)
        figure = new_figure(max(2.5 * columns + 1.3, 4.6), 2.3 * rows + 0.9)
        figure.set_layout_engine("constrained")
        grid = figure.subplots(rows, columns, sharex=True, sharey=True, squeeze=False)
        flat = grid.ravel().tolist()
        drawn: Any = None
        names = list(array.attrs.get("flag_meanings", ()))
        names = names.split() if isinstance(names, str) else names
        values = array.values.astype(float)
        numbers = values[np.isfinite(values) & ((values >= 0) | (not names))]
        if error is not None and y is None:
            spread = np.nan_to_num(error.transpose(*array.dims).values)
            numbers = np.concatenate([part[np.isfinite(part)] for part in (values - spread, values + spread)])
        limits = (float(numbers.min()), float(numbers.max())) if numbers.size else (0.0, 1.0)
        for k in range(count):
            one, bars = (part if panels is None or part is None else part.isel({panels: k}) for part in (array, error))
            axes = flat[k]
            if panels is not None:
                coordinate = array[panels] if panels in array.coords else None
                axes.set_title(
                    literal(
                        f"{_name(array, panels)} {k if coordinate is None else _text(coordinate.values[k], coordinate)}"
                    )
                )
            if y is None:
                _line(axes, one, bars, x, limits)
            else:
                drawn = _map(axes, one, x, y, limits, names)
            if k >= count - columns:
                axes.set_xlabel(_label(array, x))
                axes.tick_params(labelbottom=True)
            if k % columns == 0:
                axes.set_ylabel(outcome if y is None else _label(array, y))
        for axes in flat[count:]:
            axes.set_visible(False)
        figure.suptitle(literal(title), fontsize=10)
        if y is not None and names:
            _legend(figure, names, {int(value) for value in np.unique(numbers)})
        elif y is not None:
            bar = figure.colorbar(drawn, ax=flat[:count], fraction=0.05, pad=0.02)
            bar.set_label(outcome)
            if array.dtype.kind == "i":
                bar.locator = MaxNLocator(integer=True)
                bar.minorticks_off()
        return figure


def _line(axes: Any, one: Any, error: Any, x: str, limits: tuple[float, float]) -> None:
    place = one[x].values if x in one.coords and one[x].dtype.kind not in "UO" else np.arange(one.sizes[x])
    if x in one.coords and one[x].dtype.kind in "UO":
        axes.set_xticks(place, [literal(name) for name in one[x].values], rotation=30, ha="right")
    few = len(place) <= 40
    values = one.values.astype(float)
    axes.plot(place, values, color=INK, lw=1.2, marker="o" if few else None, ms=3)
    if error is not None:
        axes.errorbar(place, values, yerr=error.values, fmt="none", ecolor=INK, elinewidth=0.9, capsize=2)
    space = 0.05 * (limits[1] - limits[0]) or 0.5
    axes.set_ylim(limits[0] - space, limits[1] + space)


def _edges(one: Any, dim: str) -> Any:
    """Return the edges of the cells along a dimension: half-way between its values."""
    if dim not in one.coords or one[dim].dtype.kind in "UO":
        return np.arange(one.sizes[dim] + 1) - 0.5
    values = one[dim].values.astype(float)
    if len(values) == 1:
        return np.array([values[0] - 0.5, values[0] + 0.5])
    middle = (values[1:] + values[:-1]) / 2
    return np.concatenate([[2 * values[0] - middle[0]], middle, [2 * values[-1] - middle[-1]]])


def _map(axes: Any, one: Any, x: str, y: str, limits: tuple[float, float], names: list[str]) -> Any:
    from matplotlib.colors import BoundaryNorm, ListedColormap, Normalize

    values = np.ma.masked_invalid(one.transpose(y, x).values.astype(float))
    if names:
        values = np.ma.masked_less(values, 0)
        colours: Any = ListedColormap([NAMED[k % len(NAMED)] for k in range(len(names))])
        norm: Any = BoundaryNorm(np.arange(len(names) + 1) - 0.5, len(names)) if len(names) > 1 else Normalize(0, 1)
    elif one.dtype.kind == "i" and limits[1] - limits[0] < MOST_STEPS:
        edges = np.arange(limits[0], limits[1] + 2) - 0.5
        colours, norm = MAP, BoundaryNorm(edges, 256) if len(edges) > 2 else Normalize(*limits)
    else:
        colours, norm = MAP, Normalize(*limits)
    axes.set_facecolor(NOTHING)
    drawn = axes.pcolormesh(_edges(one, x), _edges(one, y), values, cmap=colours, norm=norm, rasterized=True)
    for dim, axis in ((x, axes.xaxis), (y, axes.yaxis)):
        if dim in one.coords and one[dim].dtype.kind in "UO":
            axis.set_ticks(np.arange(one.sizes[dim]), [literal(name) for name in one[dim].values])
    return drawn


def _legend(figure: Any, names: list[str], there: set[int]) -> None:
    from matplotlib.patches import Patch

    parts = [Patch(color=NAMED[k % len(NAMED)], label=literal(names[k])) for k in sorted(there) if k < len(names)]
    # as many columns as the figure's width has room for: of letters of 8 points, and of the patch before them
    longest = max((len(names[k]) for k in there if k < len(names)), default=0)
    most = int(figure.get_figwidth() / (0.065 * longest + 0.5))
    figure.legend(
        handles=parts, loc="outside lower center", ncols=max(min(len(parts), most, 6), 1), frameon=False, fontsize=8
    )


def plot_windows(found: Windows, file: str | os.PathLike[str] | None = None) -> Figure:
    """Draw acceptance windows: a bar for each, over direction, at its speed; a colour for each pocket.

    Parameters
    ----------
    found : Windows
        Of :func:`carom.aim_windows`.
    file : str or path, optional
        File to write, .svg, .pdf or .png.

    Returns
    -------
    matplotlib.figure.Figure
        A bar is at least 0.7 degrees wide, so that it can be seen. The bars of direct shots are twice as high as others.

    Raises CaromError: a file that cannot be written, or Matplotlib is missing.

    Examples
    --------
    >>> import carom
    >>> balls = [carom.SceneBall(radius=0.03, mass=0.2, position=(x, 0)) for x in (0, 0.6)]
    >>> scene = carom.Scene(floor=carom.Floor(friction=0.2, rolling_resistance=0.01), balls=balls, run=carom.Run(duration=3))
    >>> found = carom.aim_windows(scene, {"balls.0.velocity": (1.0, 2.0)}, {"hit": 1}, speeds=2, directions=360)
    >>> len(carom.plot.plot_windows(found).axes[0].collections)
    1
    """
    require_matplotlib()
    from matplotlib.collections import PolyCollection
    from matplotlib.ticker import MultipleLocator

    names = sorted({one.outcome for one in found})
    gap = (found.speeds[-1] - found.speeds[0]) / max(len(found.speeds) - 1, 1) or 1.0

    def draw() -> Figure:
        figure = new_figure(6.4, 3.6)
        axes = figure.add_subplot()
        for name, colour in zip(names, itertools.cycle(NAMED), strict=False):
            bars = [one for one in found if one.outcome == name]
            middle = np.array([(one.low_deg + one.high_deg) / 2 for one in bars])
            width = np.array([max(one.width_deg, LEAST_BAR) for one in bars])
            height = np.array([one.speed for one in bars])
            half = gap * np.array([0.4 if one.shot == "direct" else 0.2 for one in bars])
            corners = np.stack([middle - width / 2, height - half, middle + width / 2, height + half], axis=1)
            boxes = [[(x, y), (z, y), (z, w), (x, w)] for x, y, z, w in corners.tolist()]
            axes.add_collection(PolyCollection(boxes, facecolors=colour, edgecolors="none", label=literal(name)))
        axes.set(xlim=found.range_deg, ylim=(found.speeds[0] - gap / 2, found.speeds[-1] + gap / 2))
        axes.set(xlabel="direction, degrees", ylabel="speed, m/s")
        axes.xaxis.set_major_locator(MultipleLocator(45))
        if names:
            figure.legend(loc="outside upper center", ncols=3, frameon=False)
        return figure

    return drawn(draw, file)


def plot_design(plan: Plan) -> Figure:
    """Plot what one shot gains before the plan over angle and speed, and over spin where spins vary, with the numbered shots."""
    fine = plan.fine_axes is not None and plan.fine_gain is not None
    angles, speeds, spins = plan.fine_axes if fine else plan.axes  # type: ignore[misc]
    found: Any = plan.fine_gain if fine else plan.gain
    gained = "2 log odds of one shot, " + ("before the plan" if fine else "after the plan")
    with style():
        panels = [(speeds, "speed, m/s", found.max(axis=2), "speed")]
        if len(spins) > 1:
            panels.append((spins, "spin before, rad/s", found.max(axis=1), "spin"))
        figure = new_figure(4.8 * len(panels) + 0.6, 3.8)
        for axes, (values, label, gain, name) in zip(
            figure.subplots(1, len(panels), squeeze=False)[0], panels, strict=True
        ):
            is_map = len(values) > 1 and len(angles) > 1
            if is_map:
                drawn = axes.contourf(angles, values, gain.T, levels=12, cmap="viridis")
                bar = figure.colorbar(drawn, ax=axes, pad=0.03)
                bar.set_label(gained)
                bar.outline.set_visible(False)
            else:
                axes.plot(angles, gain.max(axis=1), color=INK)
                axes.set(ylim=(0, None))
            for number, shot in enumerate(plan.shots, 1):
                at = getattr(shot, name) if is_map else float(np.interp(shot.angle_deg, angles, gain.max(axis=1)))
                axes.plot(shot.angle_deg, at, "o", ms=12, mfc="white", mec=INK, mew=1, zorder=3 + number, label="_shot")
                axes.text(
                    shot.angle_deg, at, str(number), ha="center", va="center_baseline", fontsize=8, zorder=3 + number
                )
            # the best shots often are at the border of the map: leave room for their circles
            axes.margins(0.05, 0.07)
            axes.use_sticky_edges = False
            axes.autoscale_view()
            axes.set(xlabel="angle of incidence, degrees from the wall's normal", ylabel=label if is_map else gained)
        more = "more " if plan.filmed is not None else ""
        shots = "shot" if plan.count == 1 else "shots"
        need = f"{plan.count} {more}{shots} for {plan.odds:g} to 1" if plan.count else "no more shots are needed"
        if plan.count is None:
            need = "no number of shots suffices"
        figure.suptitle(f"{plan.laws[0]} (true) against {plan.laws[1]}: {need}", fontsize=9, color=INK)
        each = [
            f"{k}: {counted(shot.repeat, 'shot')} at {shot.angle_deg:.4g}\N{DEGREE SIGN}, {shot.speed:.4g} m/s"
            for k, shot in enumerate(plan.shots, 1)
        ]
        figure.text(0.01, 0.01, ";  ".join(each), fontsize=7, color=GREY, va="bottom", wrap=True)
        figure.tight_layout(rect=(0, 0.03, 1, 1))
    return figure
