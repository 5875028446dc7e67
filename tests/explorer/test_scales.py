"""The page with scenes of all sizes, and its functions with arguments of all kinds, in a real Chromium."""

from __future__ import annotations

import io
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import carom


def scene(size: float, away: float = 0.0) -> carom.Scene:
    """A shot into a corner: lengths, speeds and gravity times a size, so that times are the same; moved away from the origin."""
    ball = {"radius": 0.03 * size, "mass": 0.17, "velocity": (1.2 * size, 0.7 * size, 0)}
    other = {"radius": 0.03 * size, "mass": 0.17, "position": (1.2 * size + away, 0.6 * size, 0.03 * size)}
    walls = [
        {"shape": "plane", "point": point, "normal": normal, "restitution": 0.9, "friction": 0.2}
        for point, normal in (((2 * size + away, 0, 0), (-1, 0, 0)), ((away, size, 0), (0, -1, 0)))
    ]
    return carom.Scene(
        gravity=9.81 * size, floor={"friction": 0.2}, walls=walls, run={"law": "sliding", "duration": 3.0},
        balls=[{**ball, "position": (0.5 * size + away, 0.5 * size, 0.03 * size)}, other],
    )  # fmt: skip


def picture(open_page: Any, folder: Path, what: carom.Scene, **settings: Any) -> tuple[Any, str]:
    """The scene as it is drawn, and the label of its scale."""
    image = pytest.importorskip("PIL.Image")
    page = open_page(carom.explore(what).save(folder / "scene.html"), **settings)
    page.evaluate("() => new Promise(done => requestAnimationFrame(() => requestAnimationFrame(done)))")
    drawn = np.asarray(image.open(io.BytesIO(page.locator("#stage canvas").screenshot())).convert("RGB"), float)
    return drawn, page.locator("#scale").text_content()


@pytest.mark.parametrize("settings", [{}, {"size": (390, 844), "color_scheme": "dark"}])
def test_a_scene_of_any_size_is_drawn_like_one_of_a_metre(
    open_page: Any, tmp_path: Path, settings: dict[str, Any]
) -> None:
    usual, said = picture(open_page, tmp_path, scene(1.0), **settings)
    number = said.split()[0]
    for size, unit in ((1e6, "km"), (1e-6, "nm")):
        drawn, said = picture(open_page, tmp_path, scene(size), **settings)
        assert said == f"{number} {unit}"
        # (arrows of velocities have a length of their own)
        assert (np.abs(drawn - usual).max(axis=2) > 40).mean() < 0.02
        assert drawn.std() > 0.9 * usual.std()
    if not settings:  # far from the origin
        drawn, said = picture(open_page, tmp_path, scene(1.0, away=1e6))
        assert said == f"{number} mm"
        assert drawn.std() > 0.7 * usual.std()


@pytest.mark.parametrize("size", [(1280, 720), (390, 844)])
def test_no_label_of_a_plot_lies_where_curves_run(open_page: Any, size: tuple[int, int]) -> None:
    """ "time, s" stood above the axis at the right, where the height or the energy may run."""
    page = open_page(size=size)
    boxes = page.evaluate(
        """() => {
            const box = ({ x, y, width, height }) => ({ x, y, width, height });
            return [...document.querySelectorAll(".plot svg")].map((plot) => ({
                lines: [...plot.querySelectorAll(".grid, .axis")].map((one) => box(one.getBBox())),
                words: [...plot.querySelectorAll("text")].map((one) => ({ text: one.textContent, box: box(one.getBBox()) })),
            }));
        }"""
    )
    assert len(boxes) == 2
    for plot in boxes:
        lines = [box for box in plot["lines"] if box["width"] > 100]
        left, right = min(box["x"] for box in lines), max(box["x"] + box["width"] for box in lines)
        low = max(box["y"] for box in lines)
        assert len(plot["words"]) > 5
        for word in plot["words"]:
            box = word["box"]
            title = box["x"] == pytest.approx(left, abs=2)
            beside = box["x"] + box["width"] <= left
            assert title or beside or box["y"] >= low - 1, word["text"]
            assert box["x"] + box["width"] < right + 12, word["text"]


WRONG = [
    ("run(null)", "scene: expected a table of fields, got nothing"),
    ("run(null, 'mirror')", "scene: expected a table of fields, got nothing"),
    ("pieces('x', 'mirror')", "scene: expected a table of fields, got 'x'"),
    ("run({...scene, walls: null}, 'mirror')", "walls: expected a list, got None"),
    ("run({...scene, run: null}, 'mirror')", "run: expected a table of fields, got None"),
    ("run({...scene, balls: [null]}, 'mirror')", "balls[0]: expected a table of fields, got None"),
    ("run({...scene, me: 1})", "me: expected a field that is known here, got 'me'"),
    ("run(scene, 5)", "law: expected one of mirror, "),
    ("run(scene, null)", "law: expected one of mirror, "),
    ("run(scene, 'mirror', null)", "limits: expected an object such as { events: 500, until: 2 }, got None"),
    ("run(scene, 'mirror', { events: 'x' })", "limits.events: expected a whole number >= 1, got 'x'"),
    ("run(scene, 'mirror', { until: NaN })", "limits.until: expected a number >= 0, got nan"),
    ("run(scene, 'mirror', { event: 5 })", "limits: expected events, until, milliseconds, got 'event'"),
    ("at(null)", "t: expected a time in s, such as 0.5, got None"),
    ("at('x')", "t: expected a time in s, such as 0.5, got 'x'"),
]


def test_wrong_arguments_are_told_in_one_line(open_page: Any) -> None:
    page = open_page()
    for call, said in WRONG:
        got = page.evaluate(
            f"() => {{ const scene = carom.scene(); try {{ carom.{call}; return 'no error' }} catch (error)"
            " { return `${error.constructor.name}: ${error.message}` } }"
        )
        assert got.startswith(f"Error: {said}")
        assert "\n" not in got
