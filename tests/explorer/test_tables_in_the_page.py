"""Tables with noses and pockets in the page: the laws shown, the contact they are compared at, a cue's strike, what is in view."""

from __future__ import annotations

import base64
import tomllib
from pathlib import Path
from typing import Any

import pytest

import carom
from carom.scene.openings import table_scene

TABLE = {"shape": "table", "preset": "pool-9ft"}
FLOOR = {"friction": 0.2, "restitution": 0.5, "rolling_resistance": 0.01, "spin_friction": 0.0117}
BALL = {"radius": 0.028575, "mass": 0.17}
SIZES = [(1400, 900), (1000, 800), (390, 844)]


def _scene(*balls: dict[str, Any], **run: Any) -> carom.Scene:
    return carom.Scene(floor=FLOOR, walls=[TABLE], balls=[BALL | ball for ball in balls], run=run)


def _struck() -> carom.Scene:
    strike = {"speed": 3, "azimuth": 20, "offset": [0.2, -0.3]}
    return _scene({"name": "cue", "position": [-0.5, 0.1], "strike": strike}, {"name": "red", "position": [0.6, -0.3]})


def _break() -> carom.Scene:
    """More than 500 events come before white meets a wall."""
    return carom.Scene(**tomllib.loads(table_scene("pool-9ft")))


def _into_a_pocket() -> carom.Scene:
    """A ball rolls into the corner at the bottom left."""
    return _scene({"name": "white", "position": [-1, -0.365], "velocity": [-1, -1], "rolling": True})


@pytest.fixture
def page_of(open_page: Any, tmp_path: Path) -> Any:
    """Open a page of a scene."""
    return lambda scene, **more: open_page(carom.explore(scene).save(tmp_path / "page.html"), **more)


def _settled(page: Any) -> None:
    page.evaluate("() => new Promise(done => requestAnimationFrame(() => requestAnimationFrame(done)))")


def _ticked(page: Any) -> list[str]:
    return page.locator(".law header input:checked").evaluate_all("all => all.map(one => one.id.slice(4))")


# --- laws -----------------------------------------------------------------------------------------------------------


def test_at_noses_the_laws_of_noses_are_ticked(page_of: Any) -> None:
    assert _ticked(page_of(_struck())) == ["mirror", "two-step", "han2005", "mathavan2010", "stronge-cushion"]


def test_at_upright_walls_they_are_those_of_the_paper(page_of: Any, open_page: Any) -> None:
    usual = ["mirror", "conventional", "no-slip", "two-step", "maw", "stronge"]
    assert _ticked(open_page()) == usual
    wall = {"shape": "segment", "start": [0, -1], "end": [0, 1], "restitution": 0.9, "friction": 0.2}
    scene = carom.Scene(
        floor=FLOOR, walls=[wall, TABLE], balls=[BALL | {"position": [0.5, 0], "velocity": [-1, 0], "rolling": True}]
    )
    assert _ticked(page_of(scene)) == [*usual, "han2005", "mathavan2010", "stronge-cushion"]


def test_the_laws_are_compared_at_the_first_wall_even_after_other_balls(page_of: Any) -> None:
    scene = _break()
    page = page_of(scene)
    hits = [event for event in carom.simulate(scene).events.of("wall") if event.ball == 0]
    said = page.locator("#laws .contact").inner_text()
    assert said.startswith("The laws are compared at the first wall that white meets: ")
    assert f"at {hits[0].t:.3f} s" in said
    assert said.endswith("after another ball.")
    assert page.locator('[data-law="two-step"] .angle dd').inner_text() != "–"
    assert page.locator("#angles .curve").count() == 1
    assert page.locator("#angles .now").count() == 1


def test_a_ball_that_meets_no_wall_is_said_so(page_of: Any) -> None:
    scene = _scene(
        {"name": "white", "position": [-0.2, 0], "velocity": [0.5, 0], "rolling": True},
        {"name": "red", "position": [0.1, 0]},
        duration=0.7,
    )
    page = page_of(scene)
    said = "The laws are compared at the first wall that white meets; here it meets another ball and no wall."
    assert page.locator("#laws .contact").inner_text() == said
    assert page.locator("#angles .missing").text_content() == "white meets no wall"


# --- time -----------------------------------------------------------------------------------------------------------


def test_the_time_ends_with_the_run_though_a_ball_is_in_a_pocket(page_of: Any) -> None:
    scene = _into_a_pocket()
    run = carom.simulate(scene)
    assert run.final_phase == ["pocketed"]
    page = page_of(scene)
    for law in _ticked(page):
        if law != "two-step":
            page.locator(f"#law-{law}").uncheck()
    _settled(page)
    assert page.locator("#clock").inner_text() == f"0.000 s of {run.events[-1].t:.3f} s"


# --- a strike -------------------------------------------------------------------------------------------------------


def test_a_strike_is_said_until_it_is_replaced(page_of: Any) -> None:
    from playwright.sync_api import expect  # (which waits for the page's next frame)

    page = page_of(_struck())
    note = page.locator("#strike")
    said = "Struck by a cue: 3 m/s, azimuth 20°, offset 0.2 to the right and 0.3 down (in ball radii)."
    expect(note).to_contain_text(said)
    page.locator("#control-speed-number").fill("2")
    page.keyboard.press("Enter")
    expect(note).to_contain_text("The cue's strike (3 m/s, azimuth 20°, ")
    page.locator("#undo").click()
    expect(note).to_contain_text(said)
    page.select_option("#ball-choice", label="red")
    expect(note).to_be_hidden()
    page.select_option("#preset", label="Three cushions")
    expect(note).to_be_hidden()


# --- what is seen ---------------------------------------------------------------------------------------------------

LIT_IN_THE_DARK = """async (png) => {
    const image = new Image();
    image.src = `data:image/png;base64,${png}`;
    await image.decode();
    const { width, height } = image;
    const context = Object.assign(document.createElement("canvas"), { width, height }).getContext("2d");
    context.drawImage(image, 0, 0);
    const { data } = context.getImageData(0, 0, width, height);
    const sum = at => data[4 * at] + data[4 * at + 1] + data[4 * at + 2];
    let [dark, lit] = [0, 0];
    for (let at = 4; at < width * height - 4; at++) {
        if (sum(at) < 90) dark++;
        else if (sum(at) > 300 && sum(at - 4) < 90 && sum(at + 4) < 90) lit++;
    }
    return [dark, lit];
}"""


def test_no_line_of_the_floor_is_seen_in_a_pocket(page_of: Any) -> None:
    page = page_of(_scene({"name": "white", "position": [-0.5, 0.1]}))
    # (the line x = 0 goes through both pockets in the middle; the end of a nose over a pocket is a few pixels)
    dark, lit = page.evaluate(LIT_IN_THE_DARK, base64.b64encode(page.locator("#stage canvas").screenshot()).decode())
    assert dark > 500
    assert lit < 12


@pytest.mark.parametrize("size", SIZES)
def test_the_whole_table_is_in_the_view(page_of: Any, size: tuple[int, int]) -> None:
    page = page_of(_struck(), size=size)
    first = page.locator("#stage canvas").get_attribute("data-ball")
    page.locator('[data-view="free"]').click()
    _settled(page)
    assert page.locator("#stage canvas").get_attribute("data-ball") == first


def test_a_view_that_no_hand_has_turned_is_fitted_to_a_new_size(page_of: Any) -> None:
    page = page_of(_struck(), size=(1400, 900))
    canvas = page.locator("#stage canvas")
    page.set_viewport_size({"width": 1100, "height": 900})
    _settled(page)
    fitted = canvas.get_attribute("data-ball")
    page.locator('[data-view="free"]').click()
    _settled(page)
    assert canvas.get_attribute("data-ball") == fitted


TOO_WIDE = """() => {
    const over = (one, box) => one.getBoundingClientRect().right > box.getBoundingClientRect().right + 0.5;
    const all = [...document.querySelectorAll(".row input[type=text]")];
    const fields = all.filter(one => one.offsetParent && one.scrollWidth > one.clientWidth);
    const panel = document.getElementById("laws");
    const marks = [...panel.querySelectorAll("dd, .verdict, .follow")].filter(one => one.offsetParent && over(one, panel));
    return [...fields.map(one => `${one.id} ${one.value}`), ...marks.map(one => one.textContent)];
}"""


@pytest.mark.parametrize("size", SIZES)
def test_no_number_is_cut(page_of: Any, open_page: Any, size: tuple[int, int]) -> None:
    page = page_of(_struck(), size=size)
    assert page.evaluate(TOO_WIDE) == []
    for law in ("conventional", "no-slip", "maw", "stronge"):
        page.locator(f"#law-{law}").check()
    page.locator("#control-friction-number").fill("0.2213")
    page.keyboard.press("Enter")
    page.locator("#control-sidespin-number").fill("-123.4")
    page.keyboard.press("Enter")
    _settled(page)
    assert page.evaluate(TOO_WIDE) == []


def test_what_rounding_leaves_is_no_spin(page_of: Any) -> None:
    page = page_of(_scene({"name": "white", "position": [-0.635, -0.15], "velocity": [9.44, 1.083], "rolling": True}))
    assert page.locator("#control-massespin-number").input_value() == "0"


@pytest.mark.slow
def test_measured_rebounds_say_what_the_curves_are_for(open_page: Any, tmp_path: Path) -> None:
    table = tmp_path / "rebounds.csv"
    table.write_text(
        "v_n_in,v_t_in,v_n_out,v_t_out,stage\n1,1,0.8,0.7,rolling\n1,-2,0.8,-1.5,rolling\n", encoding="utf-8"
    )
    page = open_page(carom.explore(data=table).save(tmp_path / "page.html"))
    said = "2 from rebounds.csv. The curves are not fitted to them: they are for the restitution, friction and cushion height"
    assert page.locator("#measured").inner_text().startswith(said)
