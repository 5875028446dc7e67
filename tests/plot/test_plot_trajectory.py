"""Runs drawn: what the picture shows is the run's own, files are whole, faults are one line."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any
from xml.etree import ElementTree as ET

import numpy as np
import pytest
from reference.drawn_scenes import SCENES, gallery, hop, three

import carom
from carom.simulation.trajectory import budget

pytest.importorskip("matplotlib")
from carom.plot.trajectory import CALLED, View, _clipped, colour, last_time, steps, view, walls_in, way


@pytest.mark.parametrize("scene", SCENES)
def test_any_run_can_be_drawn(scene: Any, tmp_path: Path) -> None:
    run = carom.simulate(scene())
    figure = run.plot(tmp_path / "run.svg")
    root = ET.fromstring((tmp_path / "run.svg").read_text())
    assert root.tag.endswith("svg")
    assert len(list(root.iter())) > 50
    assert [p.name for p in tmp_path.iterdir()] == ["run.svg"]
    # nothing is drawn from far away: planes end where the picture does
    axes = figure.axes[0]
    for line in axes.lines:
        x, y = np.asarray(line.get_xdata(), dtype=float), np.asarray(line.get_ydata(), dtype=float)
        assert np.all((x >= axes.get_xlim()[0] - 1e-9) & (x <= axes.get_xlim()[1] + 1e-9))
        assert np.all((y >= axes.get_ylim()[0] - 1e-9) & (y <= axes.get_ylim()[1] + 1e-9))


@pytest.mark.parametrize("scene", SCENES)
def test_a_way_is_the_runs_own(scene: Any) -> None:
    run = carom.simulate(scene())
    until = last_time(run)
    assert until > 0
    for i in range(len(run.scene.balls)):
        pieces = way(run, i, until)
        for _phase, t, x in pieces:
            # the end of a piece is the beginning of the next event: the place is the same
            place = run.at(t).position
            assert place is not None
            np.testing.assert_allclose(x, place[:, i], atol=1e-12)
        assert pieces[0][1][0] == 0
        assert pieces[-1][1][-1] == pytest.approx(until)


def test_the_top_of_a_hop_is_in_the_picture() -> None:
    run = carom.simulate(hop())
    hit = run.events.of("wall")[0]
    height = hit.after.velocity[2] ** 2 / 2 / 9.80665
    assert height > 1e-3
    figure = run.plot()
    axes = figure.axes[1]
    assert axes.get_ylabel() == "height above the floor, mm"
    drawn = max(float(np.max(line.get_ydata())) for line in axes.lines if len(line.get_xdata()) > 10)
    assert drawn == pytest.approx(1e3 * height, rel=2e-3)


def test_no_height_where_no_ball_leaves_the_floor() -> None:
    scene = carom.simulate(gallery())
    assert len(scene.plot().axes) == 2
    assert len(carom.simulate(hop()).plot().axes) == 3
    assert len(carom.simulate(hop(0.3)).plot().axes) == 2  # before it meets the wall


@pytest.mark.parametrize(
    ("axis", "sign", "said"), [(1, -1, "height y, m"), (0, 1, "height −x, m"), (2, -1, "height z, m")]
)
def test_a_drop_is_drawn_over_time_whichever_way_is_down(axis: int, sign: int, said: str) -> None:
    down, start = [0.0, 0.0, 0.0], [0.0, 0.0, 0.0]
    down[axis], start[axis] = 9.8 * sign, -sign
    wall = {
        "shape": "plane",
        "point": (0, 0, 0),
        "normal": [-x / 9.8 for x in down],
        "restitution": 0.8,
        "friction": 0.2,
    }
    ball = {"radius": 0.03, "mass": 0.2, "position": start}
    scene = carom.Scene(gravity=down, walls=[wall], balls=[ball], run={"law": "contact", "duration": 2})
    above, height, _energy = carom.simulate(scene).plot().axes
    assert (above.get_xlabel(), height.get_ylabel(), height.get_xlabel()) == ("x, m", said, "time, s")
    drawn = height.lines[0].get_ydata()
    assert drawn[0] == pytest.approx(1)
    assert min(drawn) == pytest.approx(0.03)
    # a ball that goes across as well shows its heights from above
    if axis < 2:
        assert len(carom.simulate(carom.replaced(scene, {"balls.0.velocity": (0.5, 0.5, 0.0)})).plot().axes) == 2


def test_energy_has_its_steps() -> None:
    run = carom.simulate(hop())
    axes = run.plot().axes[-1]
    assert axes.get_ylabel() == "energy, mJ"
    (line,) = [line for line in axes.lines if len(line.get_xdata()) > 10]
    t, energy = np.asarray(line.get_xdata()), np.asarray(line.get_ydata())
    hit = run.events.of("wall")[0]
    lost = energy[t < hit.t][-1] - energy[t >= hit.t][0]
    assert lost == pytest.approx(1e3 * hit.energy_lost, rel=1e-9)
    assert t[t < hit.t][-1] == np.nextafter(hit.t, 0)
    assert np.all(np.diff(steps(run, run.end)) > 0)


def test_marks_stand_where_things_happen() -> None:
    run = carom.simulate(three())
    axes = run.plot().axes[0]
    stars = [line for line in axes.lines if line.get_marker() == "*" and len(line.get_xdata())]
    drawn = sorted((float(x), float(y)) for line in stars for x, y in zip(*line.get_data(), strict=True))
    places = [event.after.position for event in run.events.of("ball")]
    assert len(places) == 2
    assert drawn == sorted((float(p[0]), float(p[1])) for p in places if p is not None)


def test_only_the_chosen_balls() -> None:
    run = carom.simulate(three())
    assert len({colour(run, i) for i in range(3)}) == 3
    axes = run.plot(ball="red").axes[0]
    inks = {
        line.get_color()
        for line in axes.lines
        if len(line.get_xdata()) > 1 and line.get_color() in [colour(run, i) for i in range(3)]
    }
    assert inks == {colour(run, 2)}
    both = run.plot(ball=[0, "red"]).axes[0]
    assert {line.get_color() for line in both.lines if line.get_marker() == "None"} >= {colour(run, 0), colour(run, 2)}


@pytest.mark.parametrize("kind", ["svg", "pdf", "png"])
def test_the_same_run_gives_the_same_file(kind: str, tmp_path: Path) -> None:
    run = carom.simulate(hop())
    first, second = tmp_path / f"a.{kind}", tmp_path / f"b.{kind}"
    run.plot(first, title="A hop")
    run.plot(second, title="A hop")
    assert first.read_bytes() == second.read_bytes()
    assert first.read_bytes()[:4] in (b"<?xm", b"%PDF", b"\x89PNG")


def test_the_title_is_the_users(tmp_path: Path) -> None:
    run = carom.simulate(hop())
    assert "My shot" in [text.get_text() for text in run.plot(title="My shot").texts]
    assert any("plane" in text.get_text() for text in run.plot().texts)


@pytest.mark.parametrize(
    ("file", "options", "said"),
    [
        ("run.jpg", {}, r"\.svg, \.pdf or \.png, got '\.jpg'"),
        ("nowhere/run.svg", {}, "a folder that exists"),
        ("run.svg", {"ball": "blue"}, "got 'blue'"),
        ("run.svg", {"ball": 3}, "from 0 to 2, got 3"),
        ("run.svg", {"ball": [0, True]}, "got True"),
    ],
)
def test_faults_are_one_line_and_write_nothing(file: str, options: Any, said: str, tmp_path: Path) -> None:
    run = carom.simulate(three())
    with pytest.raises(carom.CaromError, match=said) as caught:
        run.plot(tmp_path / file, **options)
    assert len(caught.value.faults) == 1
    assert "\n" not in str(caught.value)
    assert list(tmp_path.iterdir()) == []


def test_lines_are_clipped_to_the_view() -> None:
    shown = View((-1.0, 1.0), (-2.0, 2.0))
    (piece,) = _clipped(np.array([(-1000.0, -1000.0), (1000.0, 1000.0)]), shown)
    np.testing.assert_allclose(piece, [(-1, -1), (1, 1)])
    assert _clipped(np.array([(-1000.0, 3.0), (1000.0, 3.0)]), shown) == []
    (level,) = _clipped(np.array([(1000.0, 0.5), (-1000.0, 0.5)]), shown)
    np.testing.assert_allclose(level, [(1, 0.5), (-1, 0.5)])
    (inner,) = _clipped(np.array([(0.0, 0.0), (0.5, 0.5)]), shown)
    np.testing.assert_allclose(inner, [(0, 0), (0.5, 0.5)])


def test_behind_a_plane_is_solid_and_a_table_is_felt() -> None:
    run = carom.simulate(hop())
    shown = view(run, np.array(run.start.position))
    kinds = [what for _line, what in walls_in(run, shown)]
    assert kinds in ([], ["solid", "line"])
    wide = View((-0.2, 1.0), (-1.0, 1.0))
    band = {what: line for line, what in walls_in(run, wide)}
    assert set(band) == {"solid", "line"}
    assert band["solid"][:, 0].max() <= 1e-12 > band["solid"][:, 0].min()
    table = carom.simulate(three())
    assert [what for _line, what in walls_in(table, wide)] == ["felt", "line"]
    post = carom.simulate(gallery())
    assert sorted(what for _line, what in walls_in(post, wide)) == ["felt", "line", "line", "solid"]


def test_paths_say_how_the_ball_moved() -> None:
    figure = carom.simulate(three()).plot()
    said = [text.get_text() for legend in figure.legends for text in legend.get_texts()]
    assert {"white", "yellow", "red", "rolls", "slides", "in the air", "meets a wall", "meets a ball", "lands"} <= set(
        said
    )
    assert "comes to rest" in said
    assert not re.search("clears|held", " ".join(said))


def test_pockets_are_drawn_and_a_ball_that_fell_lies_in_one(tmp_path: Path) -> None:
    ball = {"radius": 0.028575, "mass": 0.163}
    balls = [
        {**ball, "position": (0, 0), "velocity": (0, -1.2), "rolling": True, "name": "red 1"},
        {**ball, "position": (0.5, 0)},
    ]
    table = {"shape": "table", "preset": "pool-9ft"}
    run = carom.simulate(carom.Scene(floor={"friction": 0.2}, walls=[table], balls=balls))
    from matplotlib.colors import to_rgb
    from matplotlib.patches import Circle

    figure = run.plot(tmp_path / "run.png")
    above = figure.axes[0]
    circles = [patch for patch in above.patches if isinstance(patch, Circle)]
    pocket = run.scene.walls[0].pockets[1]
    assert [circle.center for circle in circles].count(pocket.center) == 1
    fills = [patch for patch in above.patches if not isinstance(patch, Circle)]
    assert sum(patch.get_facecolor()[:3] == to_rgb("#2b2926") for patch in fills) == 6
    assert "falls" in {text.get_text() for text in figure.legends[0].get_texts()}
    assert above.get_xlim()[0] < -1.27 - pocket.radius
    assert colour(run, 0) == CALLED["red"]


def test_the_bed_of_a_table_is_one_outline_through_its_pockets() -> None:
    for name in ("pool-9ft", "snooker"):
        table = carom.scene.Table(preset=name)
        x, y = table.bed.T
        area = float(x @ np.roll(y, -1) - y @ np.roll(x, -1)) / 2
        assert table.length * table.width < area < 1.03 * table.length * table.width
        # no step is longer than a nose
        assert np.hypot(*np.diff(table.bed, axis=0).T).max() < table.width
    assert carom.scene.Table(preset="carom").bed is None


def test_energy_begins_with_that_of_the_strike() -> None:
    """What a ball loses as it is driven onto the floor, at t = 0, is a step of the curve."""
    strike = {"speed": 4.0, "elevation": 40.0}
    ball = carom.SceneBall(radius=0.03, mass=0.2, position=(0, 0), strike=strike)
    scene = carom.Scene(floor=carom.Floor(restitution=0.5, friction=0.2), balls=[ball], run=carom.Run(duration=0.5))
    run = carom.simulate(scene)
    line = run.plot().axes[-1].lines[-1]
    t, energy = line.get_xdata()[:2], line.get_ydata()[:2]
    assert t.tolist() == [0, 0]
    assert energy == pytest.approx([budget(run).start, run.energy(0.0)])
    assert energy[0] > 1.2 * energy[1]
