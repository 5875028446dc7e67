"""The paper's Figures 1 to 3, redrawn from its equations."""

from __future__ import annotations

import math
import os
from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from carom.errors import CaromError
from carom.laws.comparison import compare, incoming
from carom.laws.registry import law_styles
from carom.plot.style import GREY, INK, PALE, arrow, new_figure, require_matplotlib, save, style

if TYPE_CHECKING:
    from matplotlib.figure import Figure

Array = NDArray[np.float64]
X, Y, Z = np.eye(3)
BLUE, ORANGE, GREEN = "#0072B2", "#D55E00", "#009E73"
WALL_INK = "#dcd8cc"


def figures(folder: str | os.PathLike[str] = ".") -> list[Path]:
    """Write the paper's Figures 1 to 3 into a folder, each as SVG and PDF.

    Parameters
    ----------
    folder : str or path
        Created if it does not exist.

    Returns
    -------
    list of Path
        The files written.

    Raises
    ------
    CaromError
        Matplotlib is missing, or the folder cannot be created.

    Examples
    --------
    >>> import tempfile
    >>> from carom import plot
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     [path.name for path in plot.figures(folder)]
    ['figure-1.svg', 'figure-1.pdf', 'figure-2.svg', 'figure-2.pdf', 'figure-3.svg', 'figure-3.pdf']
    """
    require_matplotlib()
    folder = Path(folder)
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise CaromError(f"plot: {folder}: expected a folder that can be created, got: {error.strerror}") from error
    makers: dict[str, Callable[[], Any]] = {
        "figure-1": setting,
        "figure-2": collision,
        "figure-3": incidence_and_reflection,
    }
    written = []
    for name, make in makers.items():
        figure = make()
        for kind in ("svg", "pdf"):
            written.append(folder / f"{name}.{kind}")
            save(figure, written[-1])
    return written


class ParallelProjection:
    """A parallel projection for drawings: x to the lower left, y to the right, z up, seen from in front of the wall."""

    def __init__(self, axes: Any, azimuth: float = 33.0, elevation: float = 20.0) -> None:
        self.axes = axes
        a, e = math.radians(azimuth), math.radians(elevation)
        self.right = np.array([-math.sin(a), math.cos(a), 0.0])
        self.up = np.array([-math.sin(e) * math.cos(a), -math.sin(e) * math.sin(a), math.cos(e)])
        self.towards = np.cross(self.right, self.up)

    def __call__(self, points: Any) -> Array:
        """Return points (..., 3) projected to (..., 2)."""
        p = np.asarray(points, dtype=float)
        return np.stack([p @ self.right, p @ self.up], axis=-1)

    def line(self, *points: Any, **options: Any) -> None:
        """Draw a line through points."""
        self.axes.plot(*self(np.array(points)).T, **({"color": INK, "lw": 0.8} | options))

    def face(self, *points: Any, **options: Any) -> None:
        """Draw a filled polygon."""
        self.axes.fill(*self(np.array(points)).T, **({"fc": PALE, "ec": "none", "zorder": 0} | options))

    def arrow(self, tail: Any, head: Any, colour: str = INK, **options: Any) -> None:
        """Draw an arrow between two points in space."""
        a, b = self([tail, head]).tolist()
        arrow(self.axes, (a[0], a[1]), (b[0], b[1]), colour, **options)

    def label(self, point: Any, text: str, shift: tuple[float, float] = (0, 0), **options: Any) -> None:
        """Draw a label, shifted by typographic points."""
        look = {"color": INK, "ha": "center", "va": "center", "size": 10, "zorder": 9} | options
        x, y = self(point).tolist()
        self.axes.annotate(text, (x, y), xytext=shift, textcoords="offset points", annotation_clip=False, **look)

    def circle(self, centre: Any, first: Any, second: Any, start: float = 0.0, end: float = 360.0) -> Array:
        """Return points of an arc about ``centre``, from the vector ``first`` towards ``second``, between two angles in degrees."""
        t = np.radians(np.linspace(start, end, 121))[:, None]
        return np.asarray(np.asarray(centre) + np.cos(t) * np.asarray(first) + np.sin(t) * np.asarray(second))

    def ball(self, centre: Any, a: float) -> None:
        """Draw a ball: outline, shading, and its equator."""
        from matplotlib.patches import Circle

        x, y = self(centre).tolist()
        for k in range(24):  # light from the upper right
            f = 1 - k / 24
            shade = 0.945 + 0.045 * k / 24
            spot = (x + 0.3 * a * (1 - f), y + 0.35 * a * (1 - f))
            self.axes.add_patch(Circle(spot, 0.995 * a * f**0.8, fc=str(shade), ec="none", zorder=2))
        self.axes.add_patch(Circle((x, y), a, fc="none", ec=INK, lw=1.1, zorder=3))
        ring = self.circle(centre, a * X, a * Y)
        front = (ring - np.asarray(centre)) @ self.towards > 0
        order = np.argmax(front & ~np.roll(front, 1))
        ring, front = np.roll(ring[:-1], -order, axis=0), np.roll(front[:-1], -order)
        self.line(*ring[front], color=GREY, lw=0.6, zorder=3)
        self.line(*ring[~front], color=GREY, lw=0.5, ls=(0, (3, 3)), zorder=3)


def _blank(width: float, height: float) -> tuple[Figure, Any]:
    figure = new_figure(width, height)
    axes = figure.add_axes((0.01, 0.01, 0.98, 0.98))
    axes.set_aspect("equal")
    axes.axis("off")
    return figure, axes


def _room(view: ParallelProjection, a: float, wide: tuple[float, float], deep: float, high: float) -> None:
    """Draw the wall x = 0 and the floor z = 0."""
    low, far = wide
    view.face((0, low, 0), (0, far, 0), (0, far, high), (0, low, high), fc=WALL_INK)
    view.face((0, low, 0), (deep, low, 0), (deep, far, 0), (0, far, 0), fc=PALE)
    view.line((0, low, 0), (0, far, 0), lw=1.0, zorder=1)
    view.label((0, far - 0.32 * a, high - 0.22 * a), "wall", color="#6b675c", size=9)
    view.label((deep - 0.25 * a, far - 0.45 * a, 0), "floor", color="#6b675c", size=9)


def setting() -> Figure:
    """Draw Figure 1: ball, floor and wall, the frame, the contact points A and B, the Euler angles of (1).

    Returns
    -------
    Figure
        A Matplotlib figure.

    Examples
    --------
    >>> from carom import plot
    >>> len(plot.setting().axes)
    1
    """
    with style():
        figure, axes = _blank(5.2, 4.1)
        view = ParallelProjection(axes)
        a = 1.0
        centre = np.array([a, 0.0, a])
        _room(view, a, (-2.75, 2.1), 3.1, 2.9)
        view.ball(centre, a)
        corner = np.array([0.0, -2.45, 0.0])
        for axis, reach, word, shift in (
            (X, 2.2, "$x$", (-6, -3)),
            (Y, 0.55, "$y$", (0, 9)),
            (Z, 2.45, "$z$", (-8, 0)),
        ):
            view.arrow(corner, corner + reach * axis, lw=1.1)
            view.label(corner + reach * axis, word, shift)
        view.label(corner, "$O$", (5, -9))
        for point, word, shift in (
            (centre - a * Z, "$A$", (10, 3)),
            (centre - a * X, "$B$", (11, -1)),
            (centre, "$C$", (-10, 3)),
        ):
            axes.plot(*view(point), "o", ms=3.6, color=INK, zorder=8)
            view.label(point, word, shift)
        _euler(view, centre)
        return figure


def _euler(view: ParallelProjection, c: Array) -> None:
    """Draw the Euler angles: psi about z from x to the node line N, theta about N from z to zeta, phi about zeta from N to xi."""
    psi, theta, phi = math.radians(52), math.radians(38), math.radians(66)
    node = math.cos(psi) * X + math.sin(psi) * Y
    across = -math.sin(psi) * X + math.cos(psi) * Y
    # (1): the spin of phi has the direction (sin theta sin psi, -sin theta cos psi, cos theta)
    zeta = math.cos(theta) * Z - math.sin(theta) * across
    second = np.cross(zeta, node)
    xi = math.cos(phi) * node + math.sin(phi) * second
    thin = {"lw": 0.8, "zorder": 6}
    for axis, reach in ((X, 1.45), (Y, 1.5), (Z, 1.62)):
        view.arrow(c, c + reach * axis, GREY, ls=(0, (4, 2)), **thin)
    view.label(c + 1.45 * X, "$x'$", (-7, -3), color=GREY)
    view.label(c + 1.5 * Y, "$y'$", (8, -1), color=GREY)
    view.label(c + 1.62 * Z, "$z'$", (8, 1), color=GREY)
    for axis, reach, colour, word, shift in (
        (node, 1.3, BLUE, "$N$", (5, -7)), (zeta, 1.62, ORANGE, "$\\zeta$", (-6, 5)), (xi, 1.3, GREEN, "$\\xi$", (6, 5)),
    ):  # fmt: skip
        view.arrow(c, c + reach * axis, colour, lw=1.2, zorder=7)
        view.label(c + reach * axis, word, shift, color=colour)
    for first, other, end, size, colour, word, shift in (
        (X, Y, psi, 0.62, BLUE, "$\\psi$", (0, -8)),
        (Z, -across, theta, 0.95, ORANGE, "$\\theta$", (2, -10)),
        (node, second, phi, 0.6, GREEN, "$\\varphi$", (9, -3)),
    ):
        arc = view.circle(c, size * np.asarray(first), size * np.asarray(other), 0, math.degrees(end))
        view.line(*arc, color=colour, lw=1.0, zorder=7)
        view.arrow(arc[-6], arc[-1], colour, lw=1.0, zorder=7)
        view.label(arc[60], word, shift, color=colour)


def collision() -> Figure:
    """Draw Figure 2: the impulse R of the wall at B, its components by (31), and the friction cone (29).

    Returns
    -------
    Figure
        A Matplotlib figure.

    Examples
    --------
    >>> from carom import plot
    >>> len(plot.collision().axes)
    1
    """
    mu = 0.45
    with style():
        figure, axes = _blank(5.2, 4.1)
        view = ParallelProjection(axes, azimuth=52.0, elevation=18.0)
        a, reach = 1.0, 2.1
        centre = np.array([a, 0.0, a])
        b = centre - a * X
        _room(view, a, (-2.2, 1.5), 3.6, 2.8)
        view.ball(centre, a)
        # steeper than the paper's example, so that R_y can be seen; the components follow (31), to scale
        comparison = compare(incoming(angle_deg=68.0), ["two-step"])
        answer = comparison["two-step"].answer
        assert answer is not None
        jump = np.asarray(answer.after_wall.velocity - comparison.meeting.state.velocity)
        r = jump / float(jump[0]) * reach
        cone = view.circle(b + reach * X, mu * reach * Y, mu * reach * Z)[:-1]
        axes.fill(*_hull(view(cone), view(b)).T, fc=BLUE, alpha=0.10, ec="none", zorder=4)
        axes.plot(*_hull(view(cone), view(b)).T, color=BLUE, lw=0.7, zorder=5)
        view.line(*cone, cone[0], color=BLUE, lw=0.7, zorder=5)
        view.line(b, b + 3.0 * X, color=GREY, lw=0.6, ls=(0, (5, 3)), zorder=4)
        view.label(b + reach * X + 0.75 * mu * reach * Z, "friction cone,\nhalf-angle arctan $\\mu$", (-34, 16),
                  color=BLUE, size=9, ha="right")  # fmt: skip
        tips = [b + r[0] * X, b + r[0] * X + r[1] * Y, b + r]
        view.arrow(b, b + r, ORANGE, lw=1.8, zorder=8)
        for tail, head in zip([b, *tips[:2]], tips, strict=True):
            view.arrow(tail, head, INK, lw=1.0, zorder=7)
        view.label(b + 0.55 * r, "$\\mathbf{R}$", (3, 10), color=ORANGE, size=12)
        view.label(b + 0.78 * r[0] * X, "$R_x$", (5, -9))
        view.label((tips[0] + tips[1]) / 2, "$R_y$", (-3, -9))
        view.label((tips[1] + tips[2]) / 2, "$R_z$", (-14, 2))
        for point, word, shift in ((b, "$B$", (13, 3)), (centre - a * Z, "$A$", (10, 3)), (centre, "$C$", (5, -9))):
            axes.plot(*view(point), "o", ms=3.6, color=INK, zorder=8)
            view.label(point, word, shift)
        return figure


def _hull(rim: Array, tip: Array) -> Array:
    """Return the outline of a cone in the drawing: its tip, and the side of its rim that is farther from it."""
    axis = rim.mean(axis=0) - tip
    turn = np.arctan2((rim - tip) @ np.array([-axis[1], axis[0]]), (rim - tip) @ axis)
    low, high = int(np.argmin(turn)), int(np.argmax(turn))
    count = len(rim)
    sides = [[(low + k * sign) % count for k in range((sign * (high - low)) % count + 1)] for sign in (1, -1)]
    far = max(sides, key=lambda side: float(np.hypot(*(rim[side].mean(axis=0) - tip))))
    return np.concatenate([[tip], rim[far], [tip]])


def incidence_and_reflection() -> Figure:
    """Draw Figure 3: incidence at 45 degrees, reflection at arctan 39/31 = 51.5 (two-step) and arctan 5/9 = 29.1 (conventional).

    Returns
    -------
    Figure
        A Matplotlib figure.

    Examples
    --------
    >>> from carom import plot
    >>> len(plot.incidence_and_reflection().axes)
    1
    """
    comparison = compare(incoming(), ["conventional", "two-step"])
    styles = law_styles(["conventional", "two-step"])
    with style():
        figure, axes = _blank(4.4, 3.9)
        axes.fill([-0.16, 0, 0, -0.16], [-1.05, -1.05, 1.05, 1.05], fc=WALL_INK, ec="none")
        axes.plot([0, 0], [-1.05, 1.05], color=INK, lw=1.1)
        axes.text(-0.08, -0.6, "wall", rotation=90, ha="center", va="center", color="#6b675c")
        axes.plot([0, 1.25], [0, 0], color=GREY, lw=0.6, ls=(0, (5, 3)))
        axes.text(1.27, 0, "normal", color=GREY, ha="left", va="center", size=8)
        rays = [("incidence", -comparison.incident_angle_deg, INK, "solid", 0.3, "$\\tau_i$")]
        for law, size, word in (("conventional", 0.42, "$\\tau_r$"), ("two-step", 0.56, "$\\tau_r$")):
            angle = comparison[law].reflection_angle_deg
            assert angle is not None
            rays.append((law, angle, *styles[law], size, word))
        for law, degrees, ink, dashes, size, word in rays:
            t = math.radians(degrees)
            end = (1.22 * math.cos(t), 1.22 * math.sin(t))
            axes.plot([0, end[0]], [0, end[1]], color=ink, ls=dashes, lw=1.6, zorder=4)
            tail, head = (0.78, 0.70) if law == "incidence" else (0.78, 0.86)
            arrow(axes, (tail * end[0], tail * end[1]), (head * end[0], head * end[1]), ink, zorder=5)
            arc = np.radians(np.linspace(0, degrees, 60))
            axes.plot(size * np.cos(arc), size * np.sin(arc), color=ink, lw=0.8)
            middle = arc[30 if law != "two-step" else 48]
            beside = (size + 0.065) * np.array([math.cos(middle), math.sin(middle)])
            axes.text(*beside, word, color=ink, ha="center", va="center")
            name = law if law == "incidence" else f"{law} model"
            axes.text(end[0] + 0.03, end[1] * 1.02, f"{name}\n{abs(degrees):.1f}°", color=ink, ha="left",
                      va="bottom" if degrees > 0 else "top", linespacing=1.25)  # fmt: skip
        axes.plot(0, 0, "o", ms=3.6, color=INK, zorder=6)
        axes.set(xlim=(-0.18, 1.75), ylim=(-1.14, 1.2))
        return figure
