"""The explorer in a real Chromium: its numbers are Python's, and everything that a hand can move moves them."""

from __future__ import annotations

import csv
import json
from pathlib import Path
from typing import Any

import pytest

import carom
from carom.scene.scene import scene_dict

ALL_RUNS = """['two-step', 'stronge', 'sliding'].map(law => {
    try { return JSON.stringify(carom.run(carom.scene(), law)) } catch (error) { return error.message }
}).join()"""


def _scene(page: Any) -> dict:
    return page.evaluate("carom.scene()")


def _settled(page: Any) -> None:
    """Wait until two frames have been drawn."""
    page.evaluate("() => new Promise(done => requestAnimationFrame(() => requestAnimationFrame(done)))")


def _place(page: Any, handle: str) -> tuple[float, float]:
    """Where the edited ball, or the tip of its arrow, is on the screen."""
    _settled(page)
    x, y = map(float, page.locator("#stage canvas").get_attribute(f"data-{handle}").split(","))
    box = page.locator("#stage").bounding_box()
    return box["x"] + x, box["y"] + y


def _drag(page: Any, handle: str, dx: float, dy: float) -> None:
    x, y = _place(page, handle)
    page.mouse.move(x, y)
    page.mouse.down()
    page.mouse.move(x + dx / 2, y + dy / 2)
    page.mouse.move(x + dx, y + dy)
    page.mouse.up()
    _settled(page)


def _texts(page: Any, selector: str) -> list[str]:
    return page.locator(selector).all_inner_texts()


def _angle(page: Any, law: str) -> str:
    return page.locator(f'[data-law="{law}"] .angle dd').inner_text()


def test_the_page_shows_what_carom_compare_says(open_page: Any) -> None:
    page = open_page()
    assert page.locator("html").get_attribute("data-ready") == "true"
    compared = carom.compare()
    for verdict in compared.verdicts:
        card = page.locator(f'[data-law="{verdict.law}"]')
        assert _angle(page, verdict.law) == f"{verdict.reflection_angle_deg:.1f}°"
        assert card.locator(".energy dd").inner_text() == f"{100 * verdict.energy_ratio:.1f} %"
        assert ("✓" in card.locator(".verdict").inner_text()) == verdict.admissible
        if verdict.why:
            card.locator(".verdict").click()
        assert _texts(page, f'[data-law="{verdict.law}"] .why li') == list(verdict.why)


def test_ball_and_arrow_are_dragged_and_everything_follows(open_page: Any) -> None:
    page = open_page()
    before, angle = _scene(page)["balls"][0], _angle(page, "two-step")
    _drag(page, "arrow", 15, 4)
    turned = _scene(page)["balls"][0]
    assert turned["position"] == before["position"]
    assert turned["velocity"] != before["velocity"]
    assert turned["velocity"][2] == 0
    assert _angle(page, "two-step") != angle
    assert (
        page.locator("#control-speed-number").input_value()
        == f"{(turned['velocity'][0] ** 2 + turned['velocity'][1] ** 2) ** 0.5:.4g}"
    )
    _drag(page, "ball", 30, -10)
    moved = _scene(page)["balls"][0]
    assert moved["velocity"] == turned["velocity"]
    assert moved["position"][:2] != turned["position"][:2]
    assert moved["position"][2] == turned["position"][2]
    # into the wall: a sentence, and the ball stays where it last could be
    _drag(page, "ball", -400, -250)
    assert _scene(page)["balls"][0] == moved
    assert page.locator("#message").is_visible()
    page.keyboard.press("Control+z")
    _settled(page)
    assert _scene(page)["balls"][0] == turned
    page.keyboard.press("Control+Shift+z")
    assert _scene(page)["balls"][0] == moved


def test_a_finger_drags_too(open_page: Any) -> None:
    page = open_page(size=(390, 780), has_touch=True)
    x, y = _place(page, "arrow")
    before = _scene(page)["balls"][0]
    page.evaluate(
        """([x, y]) => {
            const canvas = document.querySelector("#stage canvas");
            canvas.setPointerCapture = () => {}; // (which takes no pointer that is made up)
            const finger = { pointerType: "touch", pointerId: 7, isPrimary: true, button: 0, buttons: 1, bubbles: true };
            for (const [kind, dx] of [["pointerdown", 0], ["pointermove", 12], ["pointerup", 12]])
                canvas.dispatchEvent(new PointerEvent(kind, { ...finger, clientX: x + dx, clientY: y }));
        }""",
        [x, y],
    )
    after = _scene(page)["balls"][0]
    assert after["velocity"] != before["velocity"]
    assert after["position"] == before["position"]


def test_a_notebook_runs_the_page_in_its_frame(open_page: Any, tmp_path: Path) -> None:
    file = tmp_path / "notebook.html"
    frame = carom.explore(laws=["two-step"])._repr_html_()
    file.write_text(f"<!doctype html><html data-ready='frame'><body>{frame}</body></html>", encoding="utf-8")
    inside = open_page(file).frame_locator("iframe")
    assert inside.locator('html[data-ready="true"] [data-law="two-step"] .angle dd').inner_text() == "51.5°"
    inside.locator("#link").click()
    assert "notebook" in inside.locator("#message").inner_text()


def test_every_slider_changes_the_scene_and_what_follows(open_page: Any) -> None:
    page = open_page()
    page.select_option("#preset", label="Backspin against a cushion's nose")
    sliders = page.locator('.row:visible input[type="range"]').evaluate_all("all => all.map(one => one.id)")
    assert len(sliders) == 18
    for slider in sliders:
        before, runs = _scene(page), page.evaluate(ALL_RUNS)
        field = page.locator(f"#{slider}-number").input_value()
        page.locator(f"#{slider}").focus()
        page.evaluate(
            "id => { const one = document.getElementById(id); const [low, high] = [+one.min, +one.max];"
            " one.value = +one.value + (+one.value < (low + high) / 2 ? 0.07 : -0.07) * (high - low);"
            " for (const kind of ['input', 'change']) one.dispatchEvent(new Event(kind, { bubbles: true })); }",
            slider,
        )
        _settled(page)
        assert _scene(page) != before, slider
        assert page.locator(f"#{slider}-number").input_value() != field, slider
        assert page.evaluate(ALL_RUNS) != runs, slider
        page.keyboard.press("Control+z")
        assert _scene(page) == before, slider
    assert not page.locator("#message").is_visible()


def test_numbers_are_typed_with_their_limits(open_page: Any) -> None:
    page = open_page()
    field = page.locator("#control-friction-number")
    field.fill("0.2")
    field.press("Enter")
    assert _scene(page)["walls"][0]["friction"] == 0.2
    for text in ("-1", "nonsense", ""):
        field.fill(text)
        field.press("Enter")
        assert page.locator("#message").inner_text() == "Friction: expected a number from 0 to ∞."
        assert _scene(page)["walls"][0]["friction"] == 0.2
    field.fill("inf")
    field.press("Enter")
    assert _scene(page)["walls"][0]["friction"] == "inf"


def test_laws_are_switched_and_followed(open_page: Any) -> None:
    page = open_page()
    assert page.locator("#angles .curve").count() == 6
    page.locator("#law-mirror").uncheck()
    page.locator("#law-maw").uncheck()
    _settled(page)
    assert page.locator("#angles .curve").count() == 4
    page.locator('[data-law="stronge"] .follow').click()
    _settled(page)
    assert page.locator('[data-law="stronge"] .follow').get_attribute("aria-pressed") == "true"
    t = page.evaluate("carom.run(carom.scene(), 'stronge').events.at(-1).t")
    page.keyboard.press("End")
    page.locator("#previous").click()
    _settled(page)
    assert page.locator("#clock").inner_text().startswith(f"{t:.3f} s of")
    for name in ("conventional", "no-slip", "two-step", "stronge"):
        page.locator(f"#law-{name}").uncheck()
    _settled(page)
    assert page.locator("#angles .curve").count() == 0


def test_time_goes_from_event_to_event_and_plays(open_page: Any) -> None:
    page = open_page()
    events = page.evaluate("carom.run(carom.scene(), 'two-step').events.map(one => one.t)")
    for t in events:
        page.keyboard.press(".")
        _settled(page)
        assert page.locator("#clock").inner_text().startswith(f"{t:.3f} s of")
    assert page.locator("#event").inner_text() == f"{events[-1]:.3f} s: ball 0 lands"
    page.keyboard.press(",")
    _settled(page)
    assert page.locator("#event").inner_text() == f"{events[0]:.3f} s: ball 0 meets wall"
    page.keyboard.press("Home")
    page.select_option("#speed", "0.1")
    page.locator("#play").click()
    page.wait_for_function("() => document.getElementById('play').textContent === 'Pause'")
    page.locator("#play").click()
    page.wait_for_function("() => document.getElementById('play').textContent === 'Play'")
    assert 0 < float(page.locator("#time").input_value()) < 10_000
    page.select_option("#speed", "4")
    page.locator("#play").click()
    page.wait_for_function("() => document.getElementById('clock').textContent === '0.900 s of 0.900 s'")


def _drop(page: Any, name: str, text: str) -> None:
    page.evaluate(
        "([name, text]) => { const data = new DataTransfer(); data.items.add(new File([text], name));"
        " window.dispatchEvent(new DragEvent('drop', { dataTransfer: data, bubbles: true, cancelable: true })); }",
        [name, text],
    )
    page.locator("#message").wait_for()
    _settled(page)


def test_measured_rebounds_are_dropped_and_shown_as_text(open_page: Any, tmp_path: Path) -> None:
    page = open_page()
    _drop(
        page,
        "<img src=x onerror=alert(1)>.csv",
        "v_n_in [mm/s],v_t_in,v_n_out,v_t_out,stage\n1000,1,0.9,0.6,rolling\n800,0.4,0.7,0.3,after_wall\n",
    )
    assert page.locator("#message").inner_text() == "2 measured rebounds from <img src=x onerror=alert(1)>.csv."
    assert page.locator("#angles .measured").count() == 2
    assert page.locator("img").count() == 0
    for name, text, said in (
        (
            "other.csv",
            "a,b\n1,2\n",
            "Expected a table of rebounds, with the columns v_n_in, v_t_in, v_n_out, v_t_out; this one lacks",
        ),
        ("words.csv", "v_n_in,v_t_in,v_n_out,v_t_out\n1,fast,1,1\n", 'Row 1, v_t_in: expected a number, got "fast"'),
        ("scene.toml", "[run]\n", "A scene is opened by carom explore FILE"),
        ("empty.csv", "", "Expected a table of rebounds with a header"),
    ):
        _drop(page, name, text)
        assert said in page.locator("#message").inner_text()
    assert page.locator("#angles .measured").count() == 2
    table = carom.data.read_rebounds(_rebounds(tmp_path))
    file = carom.explore(data=table).save(tmp_path / "page.html")
    assert open_page(file).locator("#angles .measured").count() == len(table)


def _rebounds(folder: Path) -> Path:
    path = folder / "rebounds.csv"
    with path.open("w", encoding="utf-8", newline="") as file:
        csv.writer(file).writerows(
            [
                ("v_n_in", "v_t_in", "v_n_out", "v_t_out", "stage"),
                (1, 1, 0.8, 0.7, "rolling"),
                (1, -2, 0.8, -1.5, "rolling"),
            ]
        )
    return path


def test_a_link_restores_the_state(open_page: Any, page_file: Path) -> None:
    page = open_page()
    page.locator("#law-conventional").uncheck()
    page.locator("#control-restitution-number").fill("0.7")
    page.locator("#control-restitution-number").press("Enter")
    page.locator("#next").click()
    page.wait_for_function("() => location.hash.length > 100")
    page.wait_for_timeout(400)
    scene, clock = _scene(page), page.locator("#clock").inner_text()
    link = page.evaluate("location.hash")
    page.reload()
    page.wait_for_function("() => document.documentElement.dataset.ready")
    other = open_page(page_file, link)
    for one in (page, other):
        _settled(one)
        assert _scene(one) == scene
        assert one.locator("#clock").inner_text() == clock
        assert not one.locator("#law-conventional").is_checked()
    # in place of the state that is there
    page.evaluate(
        "link => { location.hash = link }",
        open_page().evaluate(
            "() => '#s=' + btoa(JSON.stringify({ scene: carom.scene() })).replaceAll('+', '-').replaceAll('/', '_')"
        ),
    )
    page.wait_for_function("() => carom.scene().walls[0].restitution.value === 1")


BAD_LINKS = {
    "null": "This link holds no scene.",
    "{ scene: null }": "scene",
    "{ scene: { ...scene, balls: [] } }": "balls: expected",
    "{ scene: { ...scene, balls: [{ ...scene.balls[0], radius: -1 }] } }": "balls[0].radius: expected",
    "{ scene: { ...scene, balls: [{ ...scene.balls[0], position: [-1, 0, 1] }] } }": "balls[0]",
    "{ scene: { ...scene, balls: Array(200).fill(scene.balls[0]) } }": "balls: expected at most 100",
    "{ scene: { ...scene, walls: [{ shape: 'constructor' }] } }": "walls[0].shape: expected",
    "{ scene: { ...scene, extra: '<b>' } }": "extra",
    "{ scene: { ...scene, run: { ...scene.run, law: 'nope' } }, laws: [] }": "nope",
}


def test_a_link_is_validated_like_a_scene(open_page: Any, page_file: Path) -> None:
    page = open_page()
    for change, said in BAD_LINKS.items():
        link = page.evaluate(
            "() => { const scene = carom.scene(); return '#s=' + btoa(JSON.stringify("
            + change
            + ")).replaceAll('+', '-').replaceAll('/', '_') }"
        )
        page.evaluate("link => { location.hash = link }", link)
        page.wait_for_function("said => document.getElementById('message').textContent.includes(said)", arg=said)
        assert _scene(page)["balls"][0]["radius"] == 0.02625
    assert "damaged" in open_page(page_file, "#s=%%%").locator("#message").inner_text()


def test_files_are_saved(open_page: Any, tmp_path: Path) -> None:
    page = open_page()
    page.select_option("#preset", label="Three cushions")
    _settled(page)
    saved = {}
    for what in ("scene", "events", "picture"):
        page.locator("details.menu summary").click()
        with page.expect_download() as download:
            page.locator(f"#save-{what}").click()
        saved[what] = tmp_path / download.value.suggested_filename
        download.value.save_as(saved[what])
    scene = carom.load_scene(saved["scene"])
    assert json.loads(json.dumps(scene_dict(scene))) == _scene(page)
    with saved["events"].open(encoding="utf-8", newline="") as file:
        rows = list(csv.DictReader(file))
    run = carom.simulate(scene)
    assert [row["kind"] for row in rows] == [event.kind for event in run.events]
    assert [float(row["t"]) for row in rows] == pytest.approx([event.t for event in run.events], rel=1e-9)
    assert saved["picture"].read_bytes()[:4] == b"\x89PNG"


def test_all_presets_in_the_dark_on_a_phone(open_page: Any) -> None:
    page = open_page(size=(390, 780), color_scheme="dark", has_touch=True)
    assert page.locator("html").get_attribute("data-theme") == "dark"
    for i in range(8):
        page.select_option("#preset", str(i))
        page.keyboard.press("End")
        _settled(page)
        assert not page.locator("#message").is_visible(), page.locator("#message").inner_text()
        assert page.evaluate("document.documentElement.scrollWidth") <= 390
    page.locator("#theme").click()
    assert page.locator("html").get_attribute("data-theme") == "light"
    for view in ("above", "side", "along", "free"):
        page.locator(f'[data-view="{view}"]').click()
        _settled(page)
    # whatever is operated has a name
    nameless = page.evaluate(
        "() => [...document.querySelectorAll('button:enabled, select, input, summary, canvas')].filter(one => !(one.ariaLabel"
        " || one.textContent.trim() || one.labels?.length)).map(one => one.id)"
    )
    assert nameless == []


def test_without_webgl_the_scene_is_flat(open_page: Any) -> None:
    script = (
        "const get = HTMLCanvasElement.prototype.getContext; HTMLCanvasElement.prototype.getContext = function (kind, ...more) {"
        " return kind.startsWith('webgl') ? null : get.call(this, kind, ...more) }"
    )
    page = open_page(script=script)
    assert "no WebGL 2" in page.locator("#message").inner_text()
    before = _scene(page)["balls"][0]
    _drag(page, "arrow", -25, 20)
    assert _scene(page)["balls"][0]["velocity"] != before["velocity"]
    _drag(page, "ball", 20, 5)
    assert _scene(page)["balls"][0]["position"] != before["position"]


def test_without_webassembly_or_with_another_module_a_sentence(open_page: Any, page_file: Path, tmp_path: Path) -> None:
    page = open_page(script="delete window.WebAssembly")
    assert "no WebAssembly" in page.locator("#message").inner_text()
    version = open_page().evaluate("carom.version")
    other = tmp_path / "other.html"
    text = page_file.read_text(encoding="utf-8")
    other.write_text(text.replace(f'"version":"{version}"', f'"version":"{"0" * len(version)}"'), encoding="utf-8")
    page = open_page(other)
    assert page.locator("html").get_attribute("data-ready") == "failed"
    assert page.locator("#message").inner_text()


def test_an_address_may_name_a_preset(open_page: Any) -> None:
    page = open_page(after="#preset=three_cushions")
    assert page.locator("#preset option:checked").inner_text() == "Three cushions"
    assert len(_scene(page)["balls"]) == 3
    assert page.locator("#law-two-step").is_checked()
    assert not page.locator("#law-maw").is_checked()
    page = open_page(after="#preset=none")
    assert page.locator("#preset option:checked").inner_text() == "The paper's example"
