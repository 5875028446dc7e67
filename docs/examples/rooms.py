"""Pictures of the gallery: rooms with curved walls, and a room that a candle does not light."""

from __future__ import annotations

from typing import Any

import numpy as np
from matplotlib.colors import LinearSegmentedColormap
from matplotlib.patches import Circle

from carom import billiards
from carom.plot.billiards import on_curves
from carom.plot.style import new_figure, style

ROOMS = [
    "limacon:eps=0.3,radius=1", "oval:eps=0.12,radius=1", "curve:r=1 + 0.06*cos(3*theta)", "flower:leaves=5,eps=0.1,radius=1",
    "superellipse:half_axes=1,0.8,power=4", "lemon:radius=1,distance=0.5", "mushroom:radius=1,stem=0.8,0.9",
    "squash:radii=1,0.7,distance=0.8", "curve:r=1 + 0.15*cos(2*theta) + 0.05*cos(3*theta)", "oval:eps=0.4,radius=1",
]  # fmt: skip
HUES = LinearSegmentedColormap.from_list("hues", ["#0072B2", "#009E73", "#9063CD", "#CC4C99", "#D55E00"])


def portraits(law: str, orbits: int = 60, bounces: int = 1500) -> Any:
    """Each room with the first flights of an orbit, and below it the phase portrait of many."""
    with style():
        figure = new_figure(11, 8.6)
        axes = figure.subplots(4, 5, height_ratios=(1, 1.35, 1, 1.35))
        for k, text in enumerate(ROOMS):
            room = billiards.table(text)
            begin = billiards.starts(room, orbits, seed=k, law=law)
            found = billiards.orbit(room, begin, bounces, law=law, at_corner="pass")
            shape = room.wall()
            length = shape.lengths.sum()
            above, below = axes[2 * (k // 5), k % 5], axes[2 * (k // 5) + 1, k % 5]
            above.fill(*shape.place(np.linspace(0, length, 1001)[:-1])[1].T, fc="#e9e5da", ec="#3b3a36", lw=1)
            above.plot(*found.position[0, :45].T, lw=0.45, color="#0072B2")
            above.set_aspect("equal")
            above.axis("off")
            above.set_title(text.partition(":")[0], fontsize=8)
            if law == "mirror":
                x, y = found.arc / length, np.sin(found.angle)
                below.set(xlim=(0, 1), ylim=(-1, 1))
            else:
                x, y = found.phase[..., 0], found.phase[..., 1]
                below.add_patch(Circle((0, 0), 1, fc="none", ec="#3b3a36", lw=0.6))
                below.set(xlim=(-1.02, 1.02), ylim=(-1.02, 1.02), aspect="equal")
            regular = on_curves(found)
            order = np.argsort(np.abs(found.angle[regular]).mean(axis=1))
            colours = HUES(np.linspace(0, 1, max(len(order), 2)))[: len(order)]
            below.scatter(x[~regular], y[~regular], s=0.12, lw=0, c="#77736a", alpha=0.6, rasterized=True)
            shades = np.repeat(colours, bounces, axis=0)
            below.scatter(x[regular][order], y[regular][order], s=0.4, lw=0, c=shades, rasterized=True)
            below.set(xticks=[], yticks=[])
            for side in below.spines.values():
                side.set_visible(law == "mirror")
                side.set_linewidth(0.4)
        figure.subplots_adjust(left=0.01, right=0.99, top=0.97, bottom=0.01, hspace=0.1, wspace=0.06)
    return figure


def candle() -> Any:
    """Tokarsky's room, with flights from the candle."""
    room = billiards.table("tokarsky:side=0.25")
    light, dark = room.figure.dark_pair
    angle = np.linspace(0, 2 * np.pi, 120, endpoint=False) + 0.003
    start = billiards.Start(light, np.stack([np.cos(angle), np.sin(angle)], axis=-1))
    found = billiards.orbit(room, start, 16, law="mirror")
    with style():
        figure = new_figure(8, 4.2)
        axes = figure.subplots()
        shape = room.wall()
        axes.fill(*shape.place(shape.starts)[1].T, fc="#e9e5da", ec="#3b3a36", lw=1)
        for path, count in zip(found.position, found.count, strict=True):
            axes.plot(*np.concatenate([[light], path[:count]]).T, lw=0.3, color="#0072B2", alpha=0.35)
        axes.plot(*light, "o", color="#D55E00", ms=7)
        axes.plot(*dark, "x", color="#D55E00", ms=9, mew=2)
        axes.set_aspect("equal")
        axes.axis("off")
        figure.subplots_adjust(left=0, right=1, top=1, bottom=0)
    return figure
