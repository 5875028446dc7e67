"""The map of a plan of shots: where circles stand, what they mean, how fine the map is."""

from __future__ import annotations

import json

import numpy as np
import pytest
from matplotlib.backends.backend_agg import FigureCanvasAgg

from carom.fitting import Setting
from carom.fitting.design import Plan, Shots, design
from carom.fitting.fit import fit_law
from carom.fitting.laws import laws_named
from carom.plot.sweeps import plot_design

SETTING = Setting(radius=0.02625, kappa=0.4)


@pytest.fixture(scope="module")
def plan() -> Plan:
    """README's example."""
    return design("planar", SETTING, ("contact", "maw"), Shots(), fine=True)


def test_no_shot_of_the_plan_is_worthless(plan: Plan) -> None:
    """The third shot stood where the map was 0.1 of 4.3, and the other law could follow nearly all of it elsewhere."""
    assert plan.count == sum(shot.repeat for shot in plan.shots) > 1
    for shot in plan.shots:
        # without one such shot the odds are missed, and by far where the map is dark at it
        assert shot.without is not None
        assert shot.without < 2 * np.log(plan.odds)
        assert shot.gain > 0.05 * plan.gain.max() or shot.without < 0.5 * plan.expected
    assert min(shot.gain for shot in plan.shots) > 1
    json.dumps(plan.as_dict(), allow_nan=False)


def test_the_odds_of_a_plan_hold_in_every_minimum() -> None:
    """Searched from all starts, the other law followed a plan of 12 shots with 2 log odds of about 1 in place of 6."""
    from carom.fitting.design import candidates

    setting, shots = Setting(radius=0.02, kappa=2 / 3), Shots(speeds=(3, 10), sigma_v=0.15, sigma_spin=10)
    found = design("planar", setting, ("maw", "contact"), shots)
    laws = {law.name: law for law in laws_named(["maw", "contact"], "planar", True)[0]}
    rows = candidates("planar", setting, shots, laws["maw"], {}, None)
    angles, speeds, _spins = rows.axes
    chosen = [
        int(np.argmin(abs(angles - shot.angle_deg))) * len(speeds) + int(np.argmin(abs(speeds - shot.speed)))
        for shot in found.shots
        for _ in range(shot.repeat)
    ]
    # (both laws have as many parameters, and without noise the true one has no misfit)
    assert fit_law(laws["contact"], rows.problem.select(np.array(chosen))).deviance >= 2 * np.log(20)


def test_circles_are_whole_and_the_map_is_fine(plan: Plan) -> None:
    figure = plot_design(plan)
    axes = figure.axes[0]
    FigureCanvasAgg(figure).draw()
    circles = [line for line in axes.lines if line.get_label() == "_shot"]
    assert len(circles) == len(plan.shots)
    frame = axes.get_window_extent()
    for circle in circles:
        x, y = axes.transData.transform(np.ravel(circle.get_xydata()))
        half = (circle.get_markersize() / 2 + 1.4) * figure.dpi / 72
        assert frame.x0 <= x - half < x + half <= frame.x1
        assert frame.y0 <= y - half < y + half <= frame.y1
    assert plan.fine_axes is not None
    assert plan.fine_gain is not None
    steps = [np.diff(axis).max() / np.ptp(axis) for axis in plan.fine_axes[:2]]
    assert max(steps) < 0.07  # contours of the five speeds that are searched had corners
    # before the plan one shot gains most near a shot of the plan
    gains = [
        plan.fine_gain[np.argmin(abs(angles - shot.angle_deg)), np.argmin(abs(speeds - shot.speed)), 0]
        for angles, speeds in [plan.fine_axes[:2]]
        for shot in plan.shots
    ]
    assert max(gains) > 0.9 * plan.fine_gain.max()
