"""The shots that pooltool 0.6.0 wrote (tests/interop/files/README.md says how), and a picture of them from above."""

from __future__ import annotations

import shutil
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

import carom
from carom.plot.style import new_figure, style

FILES = Path(__file__).parents[1] / "tests" / "interop" / "files"
LINES = (
    ("#777777", (0, (4, 2)), 1.3),
    ("#D55E00", (0, (2, 2)), 1.3),
    ("#9CC8E8", "solid", 3.0),
)  # colour, dashes, width


def fetch() -> None:
    """Copy the files to where the page is run."""
    for file in FILES.iterdir():
        if file.suffix in (".json", ".msgpack"):
            shutil.copy(file, ".")


def picture(scene: carom.Scene, paths: Mapping[str, NDArray[np.float64]]) -> Any:
    """Return a figure of the table from above, turned on its side, with paths (n, 4): time and place."""
    with style():
        figure = new_figure(7.2, 4.1)
        axes = figure.subplots()
        for wall in scene.walls:
            for line in wall.outline():
                axes.plot(line[:, 1], line[:, 0], color="#444444", lw=1.2)
        for (label, path), (colour, dashes, width) in zip(paths.items(), LINES, strict=True):
            axes.plot(path[:, 2], path[:, 1], color=colour, ls=dashes, lw=width, label=label, zorder=4 - width)
            axes.plot(*path[-1, [2, 1]], "o", color=colour, ms=4 + width, zorder=4 - width)
        for ball in scene.balls:
            axes.plot(ball.position[1], ball.position[0], "o", mfc="none", mec="#444444", ms=7)
        axes.set(aspect="equal", xlabel="y, m", ylabel="x, m")
        axes.invert_yaxis()  # x downwards, as y to the right is a quarter turn
        axes.legend(loc="upper center", bbox_to_anchor=(0.5, 1.16), ncols=3, frameon=False)
    return figure
