"""Pictures: paths that end as the laws say, files that are whole and the same every time."""

from __future__ import annotations

import math
import subprocess
import sys
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from matplotlib.backends.backend_agg import FigureCanvasAgg

import carom
from carom.plot.comparison import path_after_wall

pytest.importorskip("matplotlib")
from carom import billiards, plot
from carom.laws.registry import law_styles
from carom.plot.style import spread_apart

CASES: list[dict[str, Any]] = [
    {},
    {"friction": 0.1, "floor_friction": 0.2, "spin_z": 20.0},
    {"floor_restitution": 0.6, "floor_friction": 0.1, "restitution": 0.8},
    {"floor_restitution": 0.9, "floor_friction": math.inf, "inertia": "hollow"},
    {"contact_height": 1.3, "friction": 0.2, "floor_friction": 0.3, "restitution": 0.9},
    {"height": 0.05, "vertical_speed": 0.3, "floor_friction": 0.2, "floor_restitution": 0.3},
    {"sliding": True, "friction": 0.2, "floor_friction": 0.2},
]


@pytest.mark.parametrize("law", ["two-step", "no-slip"])
@pytest.mark.parametrize("given", CASES)
def test_a_path_ends_rolling_as_the_law_says(given: dict[str, Any], law: str) -> None:
    meeting = carom.incoming(**given)
    verdict = carom.compare(meeting, [law])[law]
    assert verdict.answer is not None
    assert verdict.final is not None
    path = path_after_wall(meeting, verdict.answer)
    assert path.velocity == pytest.approx(tuple(verdict.final.velocity), abs=1e-12)
    assert path.spin == pytest.approx(tuple(verdict.final.spin), abs=1e-9)
    assert path.points[:, 2].min() >= -1e-12


def test_the_first_flight_is_the_laws() -> None:
    meeting = carom.incoming()
    answer = carom.LAWS["two-step"].answer(meeting)
    assert answer.steps is not None
    ((name, points),) = path_after_wall(meeting, answer).pieces
    assert name == "flight"
    assert points[:, 2].max() == pytest.approx(answer.steps.flight.height, rel=1e-12)
    assert np.hypot(*points[-1, :2]) == pytest.approx(answer.steps.flight.distance, rel=1e-12)


def test_a_sliding_ball_draws_a_parabola() -> None:
    meeting = carom.incoming(floor_friction=0.2)
    answer = carom.LAWS["two-step"].answer(meeting)
    assert answer.steps is not None
    path = path_after_wall(meeting, answer)
    assert [name for name, _points in path.pieces] == ["flight", "slide"]
    slide = path.pieces[-1][1]
    start, end = answer.steps.after_floor.velocity, np.array(path.velocity)
    # constant acceleration mu g: the time from the change of velocity, the way from the mean velocity
    duration = float(np.linalg.norm((end - start)[:2])) / (0.2 * 9.80665)
    assert slide[-1] - slide[0] == pytest.approx((start + end) / 2 * duration, abs=1e-12)
    # and it is bent: its middle lies off the chord
    middle, chord = slide[20] - slide[0], slide[-1] - slide[0]
    assert abs(middle[0] * chord[1] - middle[1] * chord[0]) > 1e-3 * float(chord @ chord)


def _lines(figure: Any, axes: int, colour: str, width: float = 1.0) -> list[Any]:
    drawn = [line for line in figure.axes[axes].lines if line.get_linestyle() != "None"]
    return [line for line in drawn if line.get_color() == colour and line.get_linewidth() > width]


def test_the_picture_from_above_has_the_laws_angles() -> None:
    comparison = carom.compare()
    figure = plot.compare(comparison)
    for law in ("conventional", "two-step", "mirror"):
        (line,) = _lines(figure, 0, law_styles([law])[law][0])
        x, y = (np.asarray(u) for u in line.get_data())
        angle = math.degrees(math.atan2(y[-1] - y[-2], x[-1] - x[-2]))
        assert angle == pytest.approx(comparison[law].reflection_angle_deg, abs=1e-9)
    words = [text.get_text() for text in figure.axes[0].texts]
    assert "two-step  51.5°  ✓" in words
    assert "conventional  29.1°  ×" in words


def test_the_picture_from_above_is_to_scale_and_hops_have_their_heights() -> None:
    figure = plot.compare()
    above, _hops = figure.axes
    box = above.get_position()
    width, height = box.width * figure.get_figwidth(), box.height * figure.get_figheight()
    (x0, x1), (y0, y1) = above.get_xlim(), above.get_ylim()
    assert (x1 - x0) / width == pytest.approx((y1 - y0) / height, rel=1e-9)
    assert figure.get_figwidth() > figure.get_figheight()
    (line,) = _lines(figure, 1, law_styles(["two-step"])["two-step"][0], 1.5)
    assert float(np.max(line.get_ydata())) == pytest.approx(2.081053495873324, rel=1e-9)


def test_settings_go_to_the_library() -> None:
    with pytest.raises(carom.CaromError, match="angle"):
        plot.compare(angle_deg=95.0)
    texts = [text.get_text() for text in plot.compare(spin_y=40.0).axes[0].texts]
    assert "no prediction:\nconventional" in texts


NO_END: list[dict[str, float]] = [
    {"floor_friction": 0.0}, {"gravity": 0.0}, {"angle_deg": 0.0, "restitution": 0.0}, {"friction": 0.0},
]  # fmt: skip


def test_head_on_the_laws_differ_in_speed_and_the_picture_says_so():
    """All paths lie on one line, and six laws were named with 0.0 degrees each."""
    texts = [text.get_text() for text in plot.compare(angle_deg=0.0).axes[0].texts]
    assert any("no law turns the ball" in one for one in texts)
    assert {"two-step  0.633 m/s", "no-slip  0.837 m/s", "mirror  1 m/s"} <= {text[:-3] for text in texts}
    for turned in ({"angle_deg": 1.0}, {"angle_deg": 0.0, "spin_z": 5.0}):  # sidespin turns it
        texts = [text.get_text() for text in plot.compare(**turned).axes[0].texts]
        assert "from above" in texts
        assert not any("m/s" in one for one in texts)


@pytest.mark.parametrize("given", NO_END)
def test_balls_that_never_roll_are_drawn(given: dict[str, float], tmp_path: Path) -> None:
    plot.save(plot.compare(**given), tmp_path / "a.svg")
    assert "nan" not in (tmp_path / "a.svg").read_text(encoding="utf-8").lower()


@pytest.mark.parametrize("kind", ["svg", "pdf", "png"])
@pytest.mark.slow(keep=1)
def test_the_same_picture_is_the_same_bytes(kind: str, tmp_path: Path) -> None:
    for name in ("a", "b"):
        plot.save(plot.compare(friction=0.2), tmp_path / f"{name}.{kind}")
    first = (tmp_path / f"a.{kind}").read_bytes()
    assert first == (tmp_path / f"b.{kind}").read_bytes()
    assert b"Date" not in first
    plot.save(plot.compare(friction=0.1), tmp_path / f"c.{kind}")
    assert first != (tmp_path / f"c.{kind}").read_bytes()


def test_the_papers_figures(tmp_path: Path) -> None:
    written = plot.figures(tmp_path / "new")
    names = [f"figure-{i}.{kind}" for i in (1, 2, 3) for kind in ("svg", "pdf")]
    assert [path.name for path in written] == names
    assert sorted(path.name for path in (tmp_path / "new").iterdir()) == sorted(names)
    for path in written:
        assert path.read_bytes().startswith(b"<?xml" if path.suffix == ".svg" else b"%PDF")
    again = plot.figures(tmp_path / "again")
    assert [path.read_bytes() for path in written] == [path.read_bytes() for path in again]


def test_figure_3_has_the_papers_angles() -> None:
    words = {text.get_text() for text in plot.incidence_and_reflection().axes[0].texts}
    assert {"two-step model\n51.5°", "conventional model\n29.1°", "incidence\n45.0°"} <= words


def test_nothing_is_half_written(tmp_path: Path) -> None:
    class Broken:
        def savefig(self, path: str, **_options: Any) -> None:
            Path(path).write_text("half", encoding="utf-8")
            raise OSError(28, "No space left on device")

    (tmp_path / "a.svg").write_text("old", encoding="utf-8")
    with pytest.raises(carom.CaromError, match="No space left"):
        plot.save(Broken(), tmp_path / "a.svg")
    assert [(path.name, path.read_text(encoding="utf-8")) for path in tmp_path.iterdir()] == [("a.svg", "old")]


def test_a_missing_matplotlib_is_one_line(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "matplotlib", None)
    with pytest.raises(carom.CaromError, match=r"plot: needs Matplotlib, .*install .*\[plot\]") as caught:
        plot.compare()
    assert len(caught.value.faults) == 1


def test_a_notebook_shows_it() -> None:
    # (by itself: other tests may have taken pyplot)
    told = "plot.compare()._repr_png_()[:4] == b'\\x89PNG' and 'matplotlib.pyplot' not in sys.modules"
    code = f"import sys; from carom import plot; sys.exit(0 if {told} else 1)"
    assert subprocess.run([sys.executable, "-c", code], check=False).returncode == 0


def test_labels_keep_apart_and_in_order() -> None:
    assert spread_apart([0.0, 0.01, 0.5], 0.1, -1, 1) == pytest.approx([0.0, 0.1, 0.5])
    assert spread_apart([0.98, 0.99, 1.5], 0.1, -1, 1) == pytest.approx([0.8, 0.9, 1.0])
    crowded = spread_apart([0.0] * 5, 1.0, 0.0, 1.0)
    assert crowded == pytest.approx([0, 0.25, 0.5, 0.75, 1.0])


@pytest.mark.parametrize(
    "given",
    [
        {},
        {"angle_deg": 60.0, "friction": 0.15, "restitution": 0.85, "floor_friction": 0.2},
        {"angle_deg": 0.0, "spin_z": -80.0, "friction": 0.3},
        {"angle_deg": 20.0, "spin_z": 60.0, "friction": 0.2, "floor_friction": 0.2},
    ],
)
def test_labels_of_the_laws_do_not_overlap_and_their_lines_do_not_cross(given: dict[str, float]) -> None:
    """Lines to labels crossed one another, and ran through the view across other laws' paths."""
    figure = plot.compare(**given)
    above = figure.axes[0]
    leaders = [np.array(line.get_xydata()) for line in above.lines if line.get_label() == "_leader"]
    assert len(leaders) >= 5

    def left_of(p: Any, q: Any, o: Any) -> float:
        return float((q[0] - p[0]) * (o[1] - p[1]) - (q[1] - p[1]) * (o[0] - p[0]))

    for i, (a, b) in enumerate(leaders):
        for c, d in leaders[:i]:
            assert left_of(a, b, c) * left_of(a, b, d) >= 0 or left_of(c, d, a) * left_of(c, d, b) >= 0
        # from a path that leaves the view the line goes outwards
        top, right = above.get_ylim()[1], above.get_xlim()[1]
        if abs(a[1]) > 0.999 * top:
            assert abs(b[1]) > top
        elif a[0] > 0.999 * right:
            assert b[0] > right
    FigureCanvasAgg(figure).draw()
    boxes = [text.get_window_extent() for axes in figure.axes for text in axes.texts] + [
        text.get_window_extent() for text in figure.texts
    ]
    for i, one in enumerate(boxes):
        assert figure.bbox.x0 <= one.x0 <= one.x1 <= figure.bbox.x1
        for other in boxes[:i]:
            assert one.y1 <= other.y0 + 1 or other.y1 <= one.y0 + 1 or one.x1 <= other.x0 or other.x1 <= one.x0


def test_labels_of_a_branch_keep_off_its_curve_and_each_other() -> None:
    one = billiards.refine_orbit(billiards.sinai(0.3), ((0.5, 0.0), (1.0, 0.0), 0.0), 2)
    branch = billiards.continue_orbit(one, lambda radius: {"table": billiards.sinai(radius)}, 0.3, 0.45)
    figure = plot.plot_branch(branch, "radius (m)")
    canvas = FigureCanvasAgg(figure)
    canvas.draw()
    boxes = [text.get_window_extent() for text in figure.axes[0].texts]
    u = np.linspace(branch.parameter.min(), branch.parameter.max(), 500)
    order = np.argsort(branch.parameter)
    curve = figure.axes[0].transData.transform(
        np.column_stack([u, np.interp(u, branch.parameter[order], branch.trace[order])])
    )
    assert len(boxes) == 4
    assert not any(box.contains(*place) for box in boxes for place in curve)
    assert not any(box.overlaps(other) for k, box in enumerate(boxes) for other in boxes[:k])
