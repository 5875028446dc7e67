"""Which shots tell two laws apart: a map."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from carom.plot.drawing import GREY, INK, sheet
from carom.plot.save import style

if TYPE_CHECKING:
    from carom.fitting.design import Plan

__all__ = ["plot_design"]


def plot_design(plan: Plan) -> Any:
    """What one more shot would tell, over angle and speed, and over angle and spin where spins vary; the plan's shots on it."""
    from matplotlib.patheffects import withStroke  # a circle on the border is half on white

    angles, speeds, spins = plan.axes
    with style():
        panels = [(speeds, "speed, m/s", plan.gain.max(axis=2), "speed")]
        if len(spins) > 1:
            panels.append((spins, "spin before, rad/s", plan.gain.max(axis=1), "spin"))
        figure = sheet(4.8 * len(panels) + 0.6, 3.8)
        for axes, (values, label, gain, name) in zip(
            figure.subplots(1, len(panels), squeeze=False)[0], panels, strict=True
        ):
            if len(values) > 1 and len(angles) > 1:
                drawn = axes.contourf(angles, values, gain.T, levels=12, cmap="viridis")
                for shot in plan.shots:
                    axes.plot(shot.angle_deg, getattr(shot, name), "o", ms=7 + 2 * min(shot.repeat, 6) ** 0.5, mfc="none",
                              mec="white", mew=1.4, clip_on=False, zorder=3,
                              path_effects=[withStroke(linewidth=2.6, foreground=INK)])  # fmt: skip
                bar = figure.colorbar(drawn, ax=axes, pad=0.03)
                bar.set_label("one more shot adds to 2 log odds")
                bar.outline.set_visible(False)
                axes.set_ylabel(label)
            else:
                axes.plot(angles, gain.max(axis=1), color=INK)
                for shot in plan.shots:
                    axes.plot(shot.angle_deg, shot.gain, "o", color="#D55E00", ms=5, zorder=3, clip_on=False)
                axes.set(ylabel="one more shot adds to 2 log odds", ylim=(0, None))
            axes.set_xlabel("incidence from the wall's normal, degrees")
        more = "more " if plan.filmed is not None else ""
        need = f"{plan.count} {more}shots for {plan.odds:g} to 1" if plan.count else "no more shots are needed"
        if plan.count is None:
            need = "no number of shots is enough"
        figure.suptitle(
            f"{plan.laws[0]} (true) against {plan.laws[1]}: {need}; circles: the shots to film", fontsize=9, color=INK
        )
        figure.text(
            0.01, 0.01, "noise of the shots as given; the other law fitted anew to all of them", fontsize=7, color=GREY
        )
        figure.tight_layout(rect=(0, 0.03, 1, 1))
    return figure
