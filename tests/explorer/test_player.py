"""The page of ``simulate --animate``: in a real Chromium, its motion is the run's, computed there or recorded."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from reference.drawn_scenes import SCENES, hop, three

import carom
from carom.core.jit.kernel import kernel
from carom.explorer import page as player
from carom.laws.law import Card, wall_law
from carom.scene import Box, Floor, Plane, Run, Scene, SceneBall, Stadium, Table


def at(page: Any, times: Any) -> list[Any]:
    return page.evaluate("(times) => times.map(carom.at)", [float(t) for t in times])


def same_motion(page: Any, run: Any, times: Any) -> None:
    """The page's positions, velocities, spins, orientations and energies are the run's."""
    shown, exact = at(page, times), run.at(times)
    size = 1 + float(np.abs(exact.position).max())
    bouncing = np.array([[phase == "bouncing" for phase in run.phase(float(t))] for t in times])
    for name, of, tolerance in (("x", exact.position, 1e-9), ("v", exact.velocity, 1e-8), ("w", exact.spin, 1e-7)):
        found = np.array([[ball[name] for ball in one["balls"]] for one in shown])
        # of hops without number a chord is drawn: their height is less than can be seen
        np.testing.assert_allclose(found[~bouncing], of[~bouncing], atol=tolerance * size)
    turns = np.array([[ball["q"] for ball in one["balls"]] for one in shown])
    off = 2 * np.arccos(np.clip(np.abs((turns * run.orientation(times)).sum(axis=-1)), 0, 1))
    assert off.max() < 0.01  # rad
    energy = np.array([one["energy"] for one in shown])
    whole = ~bouncing.any(axis=1)
    np.testing.assert_allclose(energy[whole], run.energy(times)[whole], rtol=1e-9, atol=1e-12)


def between_events(run: Any, count: int = 200) -> Any:
    times = np.linspace(0, max(run.end, 0.1), count + 1)[1:-1]
    events = np.append(run.log["t"], -1.0)
    return times[np.abs(times[:, None] - events).min(axis=1) > 1e-9]


@pytest.mark.parametrize("recorded", [False, True])
@pytest.mark.parametrize("scene", SCENES)
def test_the_motion_is_the_runs(
    scene: Any, recorded: bool, open_page: Any, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    if recorded:
        monkeypatch.setattr(player, "MOST_EVENTS_RUN", -1)
    run = carom.simulate(scene())
    page = open_page(run.animate(tmp_path / "run.html"))
    assert page.locator("html").get_attribute("data-ready") == "true"
    assert (page.locator("html").get_attribute("data-recorded") is not None) == recorded
    same_motion(page, run, between_events(run))


def sticky(v: Any, w: Any, n: Any, a: float, kappa: float, e: float, mu: float, beta: float) -> Any:
    vn = v[0] * n[0] + v[1] * n[1] + v[2] * n[2]
    k = 1.9 * vn
    return (0.9 * v[0] - k * n[0], 0.9 * v[1] - k * n[1], 0.9 * v[2] - k * n[2]), w


def test_a_law_of_ones_own_is_played(open_page: Any, tmp_path: Path) -> None:
    law = wall_law(Card("sticky", "Loses a tenth.", (), "", "", ""), kernel(sticky))
    scene = Scene(
        gravity=0,
        walls=(Box(center=(0, 0, 0), size=(2, 2, 2), inside=True, restitution=1, friction=0),),
        balls=(SceneBall(radius=0.05, mass=0.1, position=(0, 0, 0), velocity=(1.3, 0.7, 0.4)),),
        run=Run(law=law, max_events=12),
    )
    run = carom.simulate(scene)
    page = open_page(run.animate(tmp_path / "own.html"))
    assert page.locator("[data-law]").get_attribute("data-law") == "sticky"
    assert "recorded" in page.locator("#about").inner_text()
    assert not page.locator("#controls").is_visible()
    assert not page.locator("#link").is_visible()
    same_motion(page, run, between_events(run))
    # a table of its events, and the picture; the scene stays as it is
    page.locator("summary", has_text="Save").click()
    with page.expect_download() as download:
        page.locator("#save-events").click()
    assert len(Path(download.value.path()).read_text().splitlines()) == 1 + len(run.events)
    before = page.evaluate("JSON.stringify(carom.scene())")
    x, y = map(float, page.locator("#stage canvas").get_attribute("data-ball").split(","))
    box = page.locator("#stage").bounding_box()
    page.mouse.move(box["x"] + x, box["y"] + y)
    page.mouse.down()
    page.mouse.move(box["x"] + x + 60, box["y"] + y)
    page.mouse.up()
    assert page.evaluate("JSON.stringify(carom.scene())") == before


def test_a_part_of_a_long_run(open_page: Any, tmp_path: Path) -> None:
    walls = (Stadium(straight=1.0, radius=0.5, law="mirror", restitution=1.0),)
    ball = SceneBall(radius=0.02, mass=0.1, position=(0.1, 0.05), velocity=(1.2, 0.9), spin=(0, 0, 9))
    run = carom.simulate(Scene(gravity=0, walls=walls, balls=(ball,), run=Run(max_events=4000)))
    whole = run.animate(tmp_path / "whole.html")
    file = run.animate(tmp_path / "part.html", start=100.0, end=130.0, speed=0.25)
    assert file.stat().st_size < whole.stat().st_size - 100_000
    page = open_page(file)
    assert page.locator("#clock").inner_text() == "100.000 s of 130.000 s"
    assert page.locator("#speed").input_value() == "0.25"
    times = np.linspace(100.01, 129.99, 50)
    shown = np.array([one["balls"][0]["x"] for one in at(page, times)])
    np.testing.assert_allclose(shown, run.at(times).position[:, 0], atol=1e-9)
    inside = [event for event in run.events if 100 < event.t <= 130]
    for event in inside[:3]:
        page.keyboard.press(".")
        page.evaluate("() => new Promise(done => requestAnimationFrame(done))")
        assert "meets stadium 0" in page.locator("#event").inner_text()
        assert page.locator("#event").inner_text().startswith(f"{event.t:.3f} s")
    page.keyboard.press("End")
    page.keyboard.press("Home")
    page.evaluate("() => new Promise(done => requestAnimationFrame(done))")
    assert page.locator("#clock").inner_text().startswith("100.000 s")


def test_many_balls_are_played_on_a_phone(open_page: Any, tmp_path: Path) -> None:
    rng = np.random.default_rng(5)
    balls = tuple(
        SceneBall(radius=0.02, mass=0.1, position=(0.1 * i, 0.1 * j, 0), velocity=(*rng.normal(size=2), 0))
        for i in range(11)
        for j in range(11)
    )
    box = Box(center=(0.5, 0.5, 0), size=(1.3, 1.3, 1), inside=True, restitution=1, friction=0.2)
    run = carom.simulate(Scene(gravity=0, walls=(box,), balls=balls, run=Run(max_events=2500)))
    page = open_page(run.animate(tmp_path / "many.html"), size=(390, 780))
    assert "121 balls" in page.locator("#about").inner_text()
    assert page.evaluate("document.documentElement.scrollWidth") == 390
    same_motion(page, run, between_events(run, 20))


def test_a_scene_that_the_page_runs_can_be_changed_there(open_page: Any, tmp_path: Path) -> None:
    page = open_page(carom.simulate(three()).animate(tmp_path / "run.html", start=0.5, end=1.5))
    assert page.locator("#clock").inner_text() == "0.500 s of 1.500 s"
    shown = page.locator("[data-law] header input:checked")
    assert shown.count() == 1
    assert shown.get_attribute("id") == "law-two-step"
    page.locator("#control-speed-number").fill("2")
    page.keyboard.press("Enter")
    page.evaluate("() => new Promise(done => requestAnimationFrame(done))")
    # the part that was asked for was one of another run
    assert not page.locator("#clock").inner_text().endswith("1.500 s")


def test_the_file_is_whole_and_by_itself(tmp_path: Path) -> None:
    run = carom.simulate(hop())
    assert run.animate(tmp_path / "run.html") == tmp_path / "run.html"
    text = (tmp_path / "run.html").read_text(encoding="utf-8")
    assert len(text) < 1_500_000
    assert not re.search(r"@[A-Z]+@", text.split("<script>")[0])
    assert list(tmp_path.iterdir()) == [tmp_path / "run.html"]


def test_a_name_is_text(open_page: Any, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(player, "MOST_EVENTS_RUN", -1)
    ball = SceneBall(radius=0.03, mass=0.2, position=(0, 0), velocity=(1, 0), name="</script><b id='in'>&")
    scene = Scene(floor=Floor(friction=0.2, rolling_resistance=0.01), balls=(ball,))
    page = open_page(carom.simulate(scene).animate(tmp_path / "run.html"))
    assert page.evaluate("carom.scene().balls[0].name") == "</script><b id='in'>&"
    assert page.locator("#in").count() == 0


def test_a_ball_that_left_has_left(open_page: Any, tmp_path: Path) -> None:
    ball = SceneBall(radius=0.03, mass=0.2, position=(0.3, 0, 0.3), velocity=(2.0, 0, 1.0))
    table = Table(length=1.0, width=1.0, height=0.05, restitution=0.8, friction=0.1)
    wall = Plane(point=(-3, 0, 0), normal=(1, 0, 0), restitution=0.5, friction=0.1)
    run = carom.simulate(Scene(floor=Floor(friction=0.2), walls=(table, wall), balls=(ball,), run=Run(duration=2.0)))
    assert run.final_phase == ["left"]
    page = open_page(run.animate(tmp_path / "run.html"))
    assert at(page, [1.9])[0]["balls"][0]["phase"] == "left"


def test_too_many_events_are_refused(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(player, "MOST_EVENTS_RUN", 5)
    monkeypatch.setattr(player, "MOST_ROWS", 10)
    with pytest.raises(carom.CaromError, match=r"at most 10 events in a page, got \d+; take a shorter time"):
        carom.simulate(three()).animate(tmp_path / "run.html")
    assert list(tmp_path.iterdir()) == []
