"""Figure of an ensemble of gases: means of its curves with bands of their standard errors, and what each member has."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING, Any

import numpy as np

from carom.errors import CaromError
from carom.gas.ensembles import Curve, Ensemble
from carom.gas.report import pressure_unit
from carom.gas.spatial_profiles import layers
from carom.plot.gas import (
    COLOURS,
    MAX_PAIRS,
    density_title,
    draw_maxwell,
    heading,
    note_maxwell,
    pair_title,
    panel_title,
    scale_temperatures,
)
from carom.plot.style import GREY, drawn, literal, new_figure

if TYPE_CHECKING:
    from matplotlib.figure import Figure

__all__ = ["plot_ensemble"]

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
    >>> from carom.gas import GasScene, simulate_ensemble
    >>> from carom.plot import plot_ensemble
    >>> contact = {"between": ("a", "a"), "restitution": 1, "friction": 0}
    >>> scene = GasScene(
    ...     container={"shape": "periodic", "size": (8, 8, 8)}, species=[{"count": 64, "radius": 0.5}], contacts=[contact],
    ...     run={"equilibrate": 100, "max_events": 2000},
    ... )
    >>> len(plot_ensemble(simulate_ensemble(scene, 3)).axes)
    6
    """
    if not ensemble.curves:
        raise CaromError("plot_ensemble: expected an ensemble with samples, got one without; run it for longer")
    return drawn(lambda: _draw(ensemble, title), file)


def _draw(ensemble: Ensemble, title: str | None) -> Any:
    curves, names = ensemble.curves, [one.name for one in ensemble.scene.species]
    scene = ensemble.scene
    axis, layered = layers(scene.container.geometry, scene.gravity_vector, [one.wall for one in scene.drives])
    figure = new_figure(7.4, 5.2)
    axes = figure.subplots(2, 3).ravel()
    figure.subplots_adjust(left=0.075, right=0.985, top=0.875, bottom=0.085, wspace=0.36, hspace=0.42)
    pairs = [(f"{a} – {b}", f"pair_correlation.{a}.{b}") for i, a in enumerate(names) for b in names[i:]]
    _panel(axes[0], "velocity", {name: curves[f"velocity.{name}"] for name in names}, "velocity / standard deviation")
    _panel(axes[1], "spin", {name: curves[f"spin.{name}"] for name in names}, "spin / standard deviation")
    note_maxwell(axes[0], 0.02, "left")
    for one in axes[:2]:
        draw_maxwell(one)
        one.set_yscale("log")
        one.set_xlim(-5, 5)
        one.set_ylim(2e-6, 1)
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
