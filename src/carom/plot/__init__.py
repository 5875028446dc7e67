"""Pictures, with Matplotlib (the extra [plot]): `compare`, `figures`, `plot_trajectory`, and `save` for any of
them; `animate` makes films, and pages that need no Matplotlib.

Each picture function returns a Matplotlib Figure that belongs to no window; a notebook shows it, :func:`save` writes it.
"""

from __future__ import annotations

from carom.plot.animation import animate
from carom.plot.comparison import compare
from carom.plot.gas import plot_gas
from carom.plot.orbits import plot_boundary, plot_lyapunov, plot_orbit, plot_portrait
from carom.plot.paper import collision, figures, incidence_and_reflection, setting
from carom.plot.path import Path, path_after_wall
from carom.plot.save import require_matplotlib, require_writable, save
from carom.plot.trajectory import plot_trajectory

__all__ = [
    "Path",
    "animate",
    "collision",
    "compare",
    "figures",
    "incidence_and_reflection",
    "path_after_wall",
    "plot_boundary",
    "plot_gas",
    "plot_lyapunov",
    "plot_orbit",
    "plot_portrait",
    "plot_trajectory",
    "require_matplotlib",
    "require_writable",
    "save",
    "setting",
]
