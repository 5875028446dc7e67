"""The explorer's page: one file, up to date, in which names are text; what it refuses; and what its presets promise."""

from __future__ import annotations

import hashlib
import html
import json
import math
import re
import webbrowser
from pathlib import Path

import numpy as np
import pytest

import carom
from carom import cli
from carom.data import make_rebounds
from carom.explorer.page import ExplorerPage, presets
from carom.fitting.shots import drawn_films
from carom.laws.registry import law_styles
from carom.tracks import Track

ROOT = Path(__file__).parents[2]
ASSETS = ROOT / "src/carom/explorer/assets"
WEB = ROOT / "web"


def _data(page: ExplorerPage) -> dict:
    found = re.search(r'<script type="application/json" id="page-data">(.*?)</script>', page.html, re.DOTALL)
    return json.loads(found[1])


def _load(name: str) -> carom.Scene:
    return carom.load_scene(ROOT / f"src/carom/explorer/presets/{name}.toml")


def test_the_dots_of_a_film_stand_beside_the_paths() -> None:
    tracks, scenes = drawn_films(2, seed=5, until=0.2)

    def first(*given, **film):
        return _data(carom.explore(*given, **film))["presets"][0]

    page = first(scenes[0], film=tracks[:3])
    assert page["laws"] == ["two-step"]  # no paths of other laws among the dots
    found = page["film"]
    assert [len(dots) for dots in found] == [10, 10, 10]
    np.testing.assert_allclose(np.array(found[1])[:, 1:], tracks[1].position, atol=1e-5)
    # by names, whatever their order
    places = np.array(first(scenes[0], film=[tracks[2], tracks[0]])["film"][::2])
    np.testing.assert_allclose(places, np.array(found[::2]), atol=2e-3)
    assert first(scenes[1], film=tracks, shot="shot 2")["film"] != found
    assert "film" not in first(scenes[0], ["two-step"])
    # the scene begins between two frames, where its run is nearest to the film
    late = [Track(one.name, one.time + 7.013, one.position) for one in tracks[:3]]
    rows = np.array(first(scenes[0], film=late)["film"][0])
    run = carom.simulate(scenes[0])
    far = rows[:, 1:] - run.at(np.clip(rows[:, 0], 0, run.end)).position[:, 0, :2]
    assert np.sqrt(np.square(far).sum(axis=1).mean()) < 2.5e-3
    for given, expected in (
        ({"scene": scenes[0], "film": tracks}, r"film: expected one shot, got 2: shot 1, shot 2; name one with `shot`"),
        ({"scene": scenes[0], "film": tracks, "shot": "shot 3"}, r"shot: expected one of shot 1, shot 2, got 'shot 3'"),
        ({"film": tracks[:3]}, r"film: expected a scene beside it, .* got none"),
        ({"scene": scenes[0], "film": "none.csv"}, r"none\.csv"),
    ):
        with pytest.raises(carom.CaromError, match=expected) as error:
            carom.explore(**given)
        assert len(error.value.faults) == 1


# --- the file -----------------------------------------------------------------------------------------------------


def test_the_bundle_is_of_todays_sources() -> None:
    kept = [
        path for path in sorted(WEB.rglob("*"), key=str)
        if path.suffix in {".js", ".css", ".html", ".json"} and "node_modules" not in path.parts
        and path.name not in {"tsconfig.json", "eslint.config.js"} and not path.name.endswith(".test.js")
    ]  # fmt: skip
    digest = hashlib.sha256()
    for path in kept:
        digest.update(f"{path.relative_to(WEB).as_posix()}\n".encode())
        digest.update(path.read_bytes())
    record = json.loads((ASSETS / "page.json").read_text(encoding="utf-8"))
    assert record["sources"] == digest.hexdigest(), (
        "the page's sources have changed: make page, and commit src/carom/explorer/assets"
    )
    assert (ASSETS / "index.html").read_bytes() == (WEB / "index.html").read_bytes()


def test_licences_of_what_is_inside_are_kept() -> None:
    text = (ASSETS / "LICENSES.txt").read_text(encoding="utf-8")
    package = json.loads((WEB / "package.json").read_text(encoding="utf-8"))
    pinned = package["dependencies"] | package["overrides"]
    assert set(json.loads((ASSETS / "page.json").read_text(encoding="utf-8"))["packages"]) == set(pinned)
    assert all(re.fullmatch(r"\d+\.\d+\.\d+", version) for version in pinned.values())
    for name, version in pinned.items():
        assert f"{name} {version} (" in text
    assert "Copyright © 2010-" in text  # three.js


def test_the_page_carries_the_licences_of_what_is_inside() -> None:
    page = carom.explore().html
    assert "three.js authors" in page
    assert "musl as a whole is licensed" in page


def test_the_page_is_one_small_file_that_asks_for_nothing() -> None:
    page = carom.explore()
    assert len(page.html.encode()) < 1_500_000
    assert not re.search(r"<(script|link|img|iframe)[^>]*(src|href)\s*=", page.html.replace(_script(page), ""))
    assert "default-src 'none'" in page.html
    assert page.html.count("</script>") == 5


def _script(page: ExplorerPage) -> str:
    return page.html[page.html.rindex("<script>") :]


def test_names_are_data_and_nothing_else() -> None:
    ball = carom.SceneBall(radius=0.03, mass=0.2, position=(1, 0), name="</script><script>alert(1)</script>@LAYOUT@")
    scene = carom.Scene(floor=carom.Floor(friction=0.2), balls=[ball])
    page = carom.explore(scene)
    assert "alert(1)</script>" not in page.html
    assert _data(page)["presets"][0]["scene"]["balls"][0]["name"] == ball.name


def test_a_notebook_shows_the_same_page_in_a_frame() -> None:
    page = carom.explore(laws=["two-step"])
    frame = page._repr_html_()
    inside = re.search(r'srcdoc="([^"]*)"', frame)
    assert html.unescape(inside[1]) == page.html
    assert 'sandbox="allow-scripts' in frame


def test_laws_have_the_colours_of_figures() -> None:
    cards = _data(carom.explore(laws=["sliding", "two-step"]))["cards"]
    names = [card["name"] for card in cards]
    listed = [law.name for law in carom.LAWS.values() if not (law.variant_of or law.ignores_floor)]
    assert sorted(names) == sorted([*listed, "sliding"])
    assert names[-3:] == ["han2005", "mathavan2010", "stronge-cushion"]
    own = cards.pop(names.index("sliding"))
    for card in cards:
        colour, dashes = law_styles([card["name"]])[card["name"]]
        assert card["colour"] == colour
        assert card["dashes"] == (None if dashes == "solid" else list(dashes[1]))
    assert re.fullmatch(r"#[0-9A-Fa-f]{6}", own["colour"])


def test_measured_rebounds_are_angles_from_the_normal() -> None:
    table = make_rebounds(
        "planar",
        {"v_n_in": [1.0, 1.0, 1.0], "v_t_in": [1.0, -1.0, 1.0], "v_n_out": [1.0, 1.0, np.nan], "v_t_out": [0.5, -0.5, 0.5]},
    )  # fmt: skip
    found = _data(carom.explore(data=table))["rebounds"]
    reflection = round(math.degrees(math.atan(0.5)), 4)
    assert found == [{"incidence": 45.0, "reflection": reflection, "stage": ""}] * 2


# --- refusals -----------------------------------------------------------------------------------------------------


def test_what_cannot_be_shown_is_refused_in_one_line_each(tmp_path: Path) -> None:
    many = [carom.SceneBall(radius=0.01, mass=0.1, position=(0.1 * i, 0)) for i in range(101)]
    law = carom.wall_law(carom.Card("soft", "", (), "", "", ""), lambda v, w, n, a, kappa, e, mu, beta: (v, w))
    wall = carom.scene.Plane(point=(-1, 0, 0), normal=(1, 0, 0), law=law)
    scene = carom.Scene(floor=carom.Floor(friction=0.2), balls=many, walls=[wall])
    text = tmp_path / "text.csv"
    text.write_text("a,b\n1,2\n", encoding="utf-8")
    with pytest.raises(carom.CaromError) as caught:
        carom.explore(scene, laws=["two-stpe", "mirror"], data=text)
    faults = caught.value.faults
    assert faults[0] == "explore: balls: expected at most 100, got 101; carom simulate takes more"
    assert faults[1].startswith("explore: law: expected one of mirror, ")
    assert "got 'soft'" in faults[1]
    assert faults[2].startswith("explore: laws: expected one of mirror, ")
    assert "did you mean 'two-step'?" in faults[2]
    assert faults[3].startswith(f"{text}: ")
    with pytest.raises(carom.CaromError, match="expected a name that ends with"):
        carom.explore().save(tmp_path / "page.txt")
    assert not (tmp_path / "page.txt").exists()


def _cli(monkeypatch: pytest.MonkeyPatch, *words: str) -> int:
    monkeypatch.setattr("sys.argv", ["carom", "explore", *words])
    with pytest.raises(SystemExit) as ended:
        cli.main()
    return int(ended.value.code or 0)


def test_the_command_writes_the_page_and_opens_it(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture
) -> None:
    opened: list[str] = []
    monkeypatch.setattr(webbrowser, "open", lambda url: opened.append(url) or True)
    monkeypatch.chdir(tmp_path)
    assert _cli(monkeypatch, str(ROOT / "docs/scenes/three_balls.toml"), "--laws", "two-step,mirror") == 0
    page = tmp_path / "carom_explorer.html"
    assert opened == [page.as_uri()]
    assert capsys.readouterr().err == "written: carom_explorer.html\n"
    first = _data(ExplorerPage(page.read_text(encoding="utf-8")))["presets"][0]
    assert (first["title"], first["laws"]) == ("Your scene", ["two-step", "mirror"])
    assert [ball["name"] for ball in first["scene"]["balls"]] == ["white", "yellow", "red"]
    assert _cli(monkeypatch, "--out", "other.html", "--no-open", "--quiet") == 0
    assert len(opened) == 1
    assert (tmp_path / "other.html").stat().st_size > 500_000


def test_bad_input_of_the_command_writes_nothing(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture
) -> None:
    monkeypatch.chdir(tmp_path)
    assert _cli(monkeypatch, "none.toml", "--laws", "nope", "--data", "none.csv", "--no-open") == 2
    lines = capsys.readouterr().err.splitlines()
    assert [line.split(":")[1].strip() for line in lines] == ["none.toml", "--laws", "none.csv"]
    assert list(tmp_path.iterdir()) == []


# --- what the presets promise ---------------------------------------------------------------------------------------


def test_presets_are_scenes_with_words_and_known_laws() -> None:
    names = [preset["name"] for preset in presets()]
    assert names == [
        "paper",
        "three_cushions",
        "nose",
        "no_slip_strip",
        "no_slip_circle",
        "superball",
        "cradle",
        "break",
        "topspin",
    ]
    for preset in presets():
        assert preset["title"]
        assert preset["about"]
        assert set(preset["laws"]) <= set(carom.LAWS)
        assert preset["scene"]["run"]["law"] in preset["laws"]


def test_the_papers_example_reflects_at_its_angle() -> None:
    final = carom.simulate(_load("paper")).final.velocity[0]
    assert math.degrees(math.atan2(final[1], final[0])) == pytest.approx(51.5198, abs=1e-4)


def test_three_cushions_come_before_the_third_ball() -> None:
    met = [
        (e.kind, e.other)
        for e in carom.simulate(_load("three_cushions")).events
        if e.ball == 0 and e.kind in ("wall", "ball")
    ]
    first = met.index(("ball", 1))
    third = met.index(("ball", 2))
    assert sum(kind == "wall" for kind, _ in met[first:third]) == 3


def test_the_nose_presses_a_ball_with_backspin_on_the_floor() -> None:
    (hit,) = carom.simulate(_load("nose")).events.of("wall")
    assert hit.floor_impulse[2] > 0


def test_no_slip_stays_in_the_strip_and_a_smooth_ball_does_not() -> None:
    scene = _load("no_slip_strip")
    smooth = carom.Scene(
        **{name: getattr(scene, name) for name in carom.Scene.model_fields}
        | {"run": carom.Run(law="mirror", duration=6)}
    )
    y = [run.at(np.linspace(0, 6, 500)).position[:, 0, 1] for run in (carom.simulate(scene), carom.simulate(smooth))]
    assert np.ptp(y[0]) < 0.5
    assert np.ptp(y[1]) > 3


def test_chords_in_the_circle_touch_two_circles_in_turn() -> None:
    hits = [event.after.position for event in carom.simulate(_load("no_slip_circle")).events.of("wall")]
    points = np.array(hits)[:, :2]
    d = np.diff(points, axis=0)
    distance = np.abs(points[:-1, 0] * d[:, 1] - points[:-1, 1] * d[:, 0]) / np.hypot(*d.T)
    assert np.allclose(distance[::2], distance[0], atol=1e-9)
    assert np.allclose(distance[1::2], distance[1], atol=1e-9)
    assert abs(distance[0] - distance[1]) > 0.05


def test_the_superball_comes_back() -> None:
    run = carom.simulate(_load("superball"))
    x = run.at(np.linspace(0, run.end, 300)).position[:, 0, 0]
    assert x.max() > -0.3
    assert run.final.position[0][0] < -0.9


def test_the_cradle_passes_most_of_the_impulse_on() -> None:
    # (its contacts overlap in time: the last ball does not get all)
    run = carom.simulate(_load("cradle"))
    v = run.at(0.3).velocity[:, 0]
    assert v.sum() == pytest.approx(0.8, abs=1e-12)
    assert v[0] < 0 < 0.95 * 0.8 < v[-1]


def test_the_break_spreads_the_balls() -> None:
    run = carom.simulate(_load("break"))
    centre = run.final.position[:, :2]
    assert np.hypot(*(centre - centre.mean(axis=0)).T).mean() > 0.4
    assert 200 < len(run.events) < 1500
