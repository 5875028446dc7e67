"""Films beside runs in a real Chromium: the ring and the distance at the time that is shown; the shots of a fit in one page."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import carom
from carom.fitting.shots import FittedShot, drawn_films
from carom.fitting.shots.search import filmed_shots

RADIUS = 0.03075


@pytest.fixture(scope="module")
def shots() -> list[FittedShot]:
    """Two shots as a fit that ends at the truth has them."""
    tracks, scenes = drawn_films(2, seed=5, until=2.0)
    found = []
    for film, scene in zip(filmed_shots(tracks, RADIUS).shots, scenes, strict=True):
        state = scene.balls[0].state
        start = np.concatenate([[film.set_off[0]], state.velocity[:2], state.spin * RADIUS, film.first.ravel()])
        run = carom.simulate(scene)
        seen = run.at(np.clip(film.time - start[0], 0, run.end)).position[:, :, :2]
        found.append(FittedShot(film, start, scene, np.hypot(*np.moveaxis(seen - film.position, 2, 0)), {}))
    return found


def distances(page: Any) -> list[float]:
    return [float(mm) for mm in re.findall(r"ball \d: ([\d.]+) mm", page.locator("#apart").inner_text())]


def seek(page: Any, t: float) -> None:
    page.evaluate(
        "share => { const one = document.getElementById('time'); one.value = share * one.max; one.oninput(); }",
        t / page.evaluate("Number(document.getElementById('clock').textContent.split('of')[1].replace(' s', ''))"),
    )
    page.evaluate("() => new Promise(done => requestAnimationFrame(() => requestAnimationFrame(done)))")


@pytest.mark.parametrize("webgl", [True, False])
def test_the_film_moves_with_the_run(shots: list[FittedShot], webgl: bool, open_page: Any, tmp_path: Path) -> None:
    shot = shots[1]
    file = carom.explore(shot).save(tmp_path / "shot.html")
    flat = (
        ""
        if webgl
        else "HTMLCanvasElement.prototype.getContext = (get => function (kind, ...rest) {\
        return kind === 'webgl2' ? null : get.call(this, kind, ...rest); })(HTMLCanvasElement.prototype.getContext);"
    )
    page = open_page(file, script=flat)
    assert page.locator("#preset option").all_inner_texts() == [f"{shot.name}: {1e3 * shot.rms:.3g} mm from the film"]
    assert page.locator("#key-film").is_visible()
    for row in (20, 60):
        seek(page, shot.film.time[row] - shot.time)
        far = distances(page)
        assert len(far) == len(shot.film.balls)
        # (the slider has 10,000 steps: up to 0.7 ms)
        np.testing.assert_allclose(far, 1e3 * shot.distance[row], atol=1.5)
    assert "from film to run, mm" in page.locator("#course").inner_text()


def test_the_shots_of_a_fit_are_in_the_menu_and_a_link_keeps_its_film(
    shots: list[FittedShot], open_page: Any, tmp_path: Path
) -> None:
    from carom.explorer.page import ExplorerPage, _shots_text

    file = ExplorerPage(_shots_text(shots, [], None)).save(tmp_path / "shots.html")
    page = open_page(file)
    page.select_option("#preset", index=1)
    seek(page, 1.0)
    far = distances(page)
    assert max(far) < 8
    # of a film the arrow of the velocity is drawn at the start alone, and a changed speed moves the run away from the film
    page.locator("#control-speed-number").fill("9")
    page.locator("#control-speed-number").press("Enter")
    page.wait_for_function("() => location.hash.includes('preset=shot') && location.hash.includes('s=')")
    page.evaluate("() => new Promise(done => setTimeout(done, 400))")
    changed = distances(page)
    assert max(changed) > 10 * max(far)
    again = open_page(file, "#" + page.evaluate("location.hash").removeprefix("#"))
    assert distances(again) == changed
