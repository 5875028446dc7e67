"""Figure of the contacts of a fit: which slide, the share of the friction that the others use, and which rows decide."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from carom.fitting import friction_used
from carom.fitting.friction_used import SLIDES
from carom.plot.style import INK, new_figure, style

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from carom.fitting import Ranking

__all__ = ["plot_friction"]


def plot_friction(ranking: Ranking) -> Figure:
    """Plot for each row the share of the friction used under the best law, against slip over normal speed, and by how much the row
    speaks for that law against its strongest rival (chi^2 of the rival less that of the best). Returns a Matplotlib Figure.

    Raises CaromError for balls on a table.
    """
    best, problem = ranking.best, ranking.best.problem
    share = friction_used(best)
    slip = np.abs(problem.x[:, 1] - problem.setting.radius * np.nan_to_num(problem.x[:, 2])) / problem.x[:, 0]
    slides = share >= SLIDES
    rival = next((one.fit for one in ranking.ranked if one.fit.law.name == ranking.against), None)
    with style():
        figure = new_figure(8.4, 3.2)
        left, right = figure.subplots(1, 2)
        for rows, label, marker in ((slides, "slides", "o"), (~slides, "grips", "s")):
            left.plot(
                slip[rows],
                100 * share[rows],
                marker,
                ms=4,
                mfc="none" if label == "grips" else None,
                label=f"{label}: {rows.sum()}",
            )
        left.set_xlabel("slip over normal speed")
        left.set_ylabel("friction used (%)")
        left.set_ylim(-3, 106)
        left.legend(fontsize=8)
        left.set_title(f"{best.law.name}")
        if rival is not None:
            gain = rival.by_row - best.by_row
            right.axhline(0, color=INK, lw=0.6)
            for rows, marker in ((slides, "o"), (~slides, "s")):
                right.plot(np.flatnonzero(rows) + 1, gain[rows], marker, ms=4, mfc="none" if marker == "s" else None)
            right.set_xlabel("row")
            right.set_ylabel(f"χ² of {rival.law.name} less that of {best.law.name}")
            right.set_title("which rows decide")
        else:
            right.set_axis_off()
        figure.tight_layout()
    return figure
