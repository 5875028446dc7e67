"""Animations: pages whose motion is the run's, films with all their frames, nothing half-written."""

from __future__ import annotations

import html.parser
import itertools
import json
import math
import re
import shutil
import struct
import sys
from pathlib import Path
from types import SimpleNamespace
from typing import Any, ClassVar

import numpy as np
import pytest
from reference.drawn_scenes import SCENES, away, free, hop, still, three

import carom
from carom.plot import animation
from carom.plot.html import page_data
from carom.scene import Floor, Plane, Scene, SceneBall

needs_ffmpeg = pytest.mark.skipif(shutil.which("ffmpeg") is None, reason="ffmpeg is not installed")


def data_of(path: Path) -> Any:
    found = re.search(
        r'<script id="run" type="application/json">(.*?)</script>', path.read_text(encoding="utf-8"), re.S
    )
    assert found is not None
    return json.loads(found[1])


def places(pieces: Any, t: float) -> Any:
    """What the page computes."""
    rows = np.array(pieces)
    p = rows[max(0, int(np.searchsorted(rows[:, 0], t, side="right")) - 1)]
    s = t - p[0]
    return p[1:4] + p[4:7] * s + p[7:10] * s * s / 2


@pytest.mark.parametrize("scene", SCENES)
def test_the_pages_motion_is_the_runs(scene: Any, tmp_path: Path) -> None:
    run = carom.simulate(scene())
    run.animate(tmp_path / "run.html")
    data = data_of(tmp_path / "run.html")
    first, last = data["span"]
    assert first == 0
    assert last > 0
    times = np.linspace(0, last, 500)
    exact = run.at(times)
    assert exact.position is not None
    size = 1 + float(np.abs(exact.position).max())
    for i, ball in enumerate(data["balls"]):
        drawn = np.array([places(ball["pieces"], t) for t in times])
        # in the last, infinitely many bounces chords stand for the hops; they are lower than a spot on the ball
        bouncing = np.array([run.phase(float(t))[i] == "bouncing" for t in times])
        np.testing.assert_allclose(drawn[~bouncing], exact.position[~bouncing, i], atol=1e-8 * size)
        np.testing.assert_allclose(drawn[bouncing], exact.position[bouncing, i], atol=0.02 * ball["radius"])


@pytest.mark.parametrize("scene", [hop, three, free])
def test_the_pages_balls_turn_as_the_runs(scene: Any) -> None:
    run = carom.simulate(scene())
    end = run.end
    data = page_data(run, 0.0, end, 1.0)
    times = np.linspace(0, end, 331)
    exact = run.orientation(times)
    for i, ball in enumerate(data["balls"]):
        turns = np.array(ball["turns"])
        assert np.all(np.diff(turns[:, 0]) > 0)
        k = np.clip(np.searchsorted(turns[:, 0], times, side="right") - 1, 0, len(turns) - 2)
        p, q = turns[k, 1:], turns[k + 1, 1:]
        share = ((times - turns[k, 0]) / (turns[k + 1, 0] - turns[k, 0]))[:, None]
        dot = (p * q).sum(axis=1)[:, None]
        q, dot = np.where(dot < 0, -q, q), np.clip(np.abs(dot), 0, 1)
        angle = np.arccos(dot)
        sine = np.where(angle > 1e-6, np.sin(angle), 1.0)
        slerp = np.where(
            angle > 1e-6,
            (np.sin((1 - share) * angle) * p + np.sin(share * angle) * q) / sine,
            (1 - share) * p + share * q,
        )
        off = 2 * np.arccos(np.clip(np.abs((slerp * exact[:, i]).sum(axis=1)), 0, 1))
        assert off.max() < 0.01  # rad
        # never so far apart that the shorter turn could be the wrong one
        assert (2 * angle).max() < 1.5


def test_the_page_is_whole_and_by_itself(tmp_path: Path) -> None:
    path = tmp_path / "run.html"
    assert carom.simulate(three()).animate(path) == path
    text = path.read_text(encoding="utf-8")
    assert len(text) < 1_000_000
    assert not re.search(r"https?://|src=|@import|url\(", text)
    assert "@DATA@" not in text
    assert "@TITLE@" not in text

    class Check(html.parser.HTMLParser):
        seen: ClassVar[list[str]] = []

        def handle_starttag(self, tag: str, attrs: Any) -> None:
            self.seen.append(tag)

    Check().feed(text)
    assert {"canvas", "input", "button", "select"} <= set(Check.seen)
    assert list(tmp_path.iterdir()) == [path]


def test_the_page_tells_the_events(tmp_path: Path) -> None:
    run = carom.simulate(three())
    run.animate(tmp_path / "run.html")
    events = data_of(tmp_path / "run.html")["events"]
    said = [event[1] for event in events]
    assert "white meets red" in said
    assert "red meets white" not in said  # one meeting, one line
    assert "white meets table 0" in said
    assert said[-1].endswith("rest")
    assert [event[0] for event in events] == sorted(event[0] for event in events)
    assert len(events) == len(run.events) - 1


def test_the_pages_energy_is_the_runs() -> None:
    run = carom.simulate(three())
    energy = np.array(page_data(run, 0.0, run.end, 1.0)["energy"])
    t, total, start = energy[:, 0], energy[:, 1:].sum(axis=1), run.energy(0.0)
    assert np.all(energy[:, 1:] >= 0)
    assert np.all(np.diff(t) >= 0)
    plain = np.abs(t[:, None] - run.events.t).min(axis=1) > 1e-9
    assert plain.sum() > 300
    np.testing.assert_allclose(total[plain], run.energy(t[plain]), atol=1e-5 * start)
    # at an event two rows, the instant before and the event
    hit = run.events.of("wall")[0]
    (pair,) = [np.flatnonzero(np.abs(t - hit.t) < 1e-9)]
    assert total[pair[0]] - total[pair[-1]] == pytest.approx(hit.energy_lost, abs=1e-5 * start)
    assert hit.energy_lost > 0.01 * start


def test_a_name_cannot_end_the_script(tmp_path: Path) -> None:
    ball = SceneBall(radius=0.03, mass=0.2, position=(0, 0), velocity=(1, 0), name="</script><b>&")
    scene = Scene(floor=Floor(friction=0.2, rolling_resistance=0.01), balls=(ball,))
    carom.simulate(scene).animate(tmp_path / "run.html")
    assert data_of(tmp_path / "run.html")["balls"][0]["name"] == "</script><b>&"


def test_a_part_of_the_run(tmp_path: Path) -> None:
    run = carom.simulate(three())
    run.animate(tmp_path / "part.html", start=0.5, end=1.5, speed=0.25)
    run.animate(tmp_path / "whole.html")
    data, whole = data_of(tmp_path / "part.html"), data_of(tmp_path / "whole.html")
    assert data["span"] == [0.5, 1.5]
    assert data["speed"] == 0.25
    assert all(0.5 <= event[0] <= 1.5 for event in data["events"])
    assert 0 < len(data["events"]) < len(whole["events"])
    exact = run.at([0.5, 1.0, 1.5]).position
    assert exact is not None
    drawn = [[places(ball["pieces"], t) for ball in data["balls"]] for t in (0.5, 1.0, 1.5)]
    np.testing.assert_allclose(drawn, exact, atol=1e-7)


def test_a_page_needs_no_matplotlib(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    run = carom.simulate(hop())
    monkeypatch.setitem(sys.modules, "matplotlib", None)
    run.animate(tmp_path / "run.html")
    with pytest.raises(carom.CaromError, match=r"animate: needs Matplotlib, .*pip install 'carom\[plot\]'"):
        run.animate(tmp_path / "run.gif")


def test_a_gif_has_its_frames_and_its_pace(tmp_path: Path) -> None:
    image = pytest.importorskip("PIL.Image")
    pytest.importorskip("matplotlib")
    told: list[tuple[int, int]] = []
    run = carom.simulate(hop())
    path = run.animate(tmp_path / "run.gif", fps=15, speed=0.5, start=0.2, progress=lambda *a: told.append(a))
    assert told[0] == (0, 25)  # 0.8 s at half speed, 15 a second, and the first
    assert told[-1] == (25, 25)
    with image.open(path) as film:
        assert film.n_frames == 25
        lasts = []
        frames = []
        for n in range(film.n_frames):
            film.seek(n)
            lasts.append(film.info["duration"])
            frames.append(np.asarray(film.convert("RGB")).copy())
    assert sum(lasts) == pytest.approx(1000 * 25 / 15, abs=10)
    assert all((a != b).any() for a, b in itertools.pairwise(frames))
    assert list(tmp_path.iterdir()) == [path]


def test_a_film_shows_the_ball_where_it_is() -> None:
    pytest.importorskip("matplotlib")
    from carom.plot.style import style
    from carom.plot.video import Film

    run = carom.simulate(hop())
    times = np.array([0.0, 0.3, 0.9])
    with style():
        film = Film(run, times, (0.0, 1.0), 800)
        for n, t in enumerate(times):
            frame = film.frame(n)
            assert frame.shape == (*film.size[::-1], 4)
            position = run.at(t).position
            assert position is not None
            x, y = film._place(position[0])
            r = 0.5 * film.k * run.scene.balls[0].radius
            for d in ((r, 0), (-r, 0), (0, r), (0, -r)):
                pixel = frame[film.size[1] - 1 - round(y + d[1]), round(x + d[0]), :3].astype(int)
                # the ball's blue, or a white spot on it; never the paper's or the felt's tint between
                assert pixel[2] > 150
                assert pixel[2] >= pixel[0]
                if (pixel < 230).any():
                    assert pixel[2] - pixel[0] > 20


@needs_ffmpeg
def test_an_mp4_is_one(tmp_path: Path) -> None:
    pytest.importorskip("matplotlib")
    told: list[tuple[int, int]] = []
    path = carom.simulate(hop()).animate(tmp_path / "run.mp4", fps=10, progress=lambda *a: told.append(a))
    content = path.read_bytes()
    assert content[4:8] == b"ftyp"
    assert told[-1] == (11, 11)
    # the header's duration, in its own ticks: 11 frames
    at = content.index(b"mvhd")
    scale, duration = struct.unpack(">II", content[at + 16 : at + 24])
    assert duration / scale == pytest.approx(1.1, abs=0.02)
    assert list(tmp_path.iterdir()) == [path]


def test_ffmpeg_may_come_from_a_package(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(shutil, "which", lambda _name: None)
    monkeypatch.setitem(sys.modules, "imageio_ffmpeg", SimpleNamespace(get_ffmpeg_exe=lambda: "/its/own/ffmpeg"))
    assert animation._ffmpeg() == "/its/own/ffmpeg"


def test_without_ffmpeg_it_says_what_to_install(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    pytest.importorskip("matplotlib")
    monkeypatch.setattr(shutil, "which", lambda _name: None)
    monkeypatch.setitem(sys.modules, "imageio_ffmpeg", None)
    with pytest.raises(carom.CaromError, match=r"pip install 'carom\[film\]'"):
        carom.simulate(hop()).animate(tmp_path / "run.mp4")
    assert list(tmp_path.iterdir()) == []


@pytest.mark.skipif(sys.platform == "win32", reason="a shell script stands for ffmpeg")
@pytest.mark.parametrize("script", ["cat >/dev/null; echo no such codec >&2; exit 3", "echo no such codec >&2; exit 3"])
def test_what_ffmpeg_complains_of_is_told(script: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    pytest.importorskip("matplotlib")
    program = tmp_path / "ffmpeg"
    program.write_text(f"#!/bin/sh\n{script}\n")
    program.chmod(0o755)
    monkeypatch.setattr(shutil, "which", lambda _name: str(program))
    out = tmp_path / "out"
    out.mkdir()
    with pytest.raises(carom.CaromError, match="no such codec"):
        carom.simulate(hop()).animate(out / "run.mp4", fps=10)
    assert list(out.iterdir()) == []


@pytest.mark.parametrize("kind", ["gif", pytest.param("mp4", marks=needs_ffmpeg)])
def test_what_stops_halfway_leaves_nothing_and_keeps_the_old(kind: str, tmp_path: Path) -> None:
    pytest.importorskip("matplotlib")

    def stop(done: int, _total: int) -> None:
        if done == 3:
            raise KeyboardInterrupt

    path = tmp_path / f"run.{kind}"
    path.write_bytes(b"old")
    with pytest.raises(KeyboardInterrupt):
        carom.simulate(hop()).animate(path, fps=10, progress=stop)
    assert path.read_bytes() == b"old"
    assert list(tmp_path.iterdir()) == [path]


@pytest.mark.parametrize(
    ("file", "options", "said"),
    [
        ("run.avi", {}, r"\.mp4, \.gif or \.html, got '\.avi'"),
        ("run", {}, "got none"),
        ("nowhere/run.html", {}, "a folder that exists"),
        ("run.html", {"fps": 0}, "fps: expected a number above 0"),
        ("run.gif", {"fps": 60}, "at most 50"),
        ("run.html", {"speed": -1.0}, "speed: expected a number above 0"),
        ("run.html", {"speed": math.inf}, "speed"),
        ("run.html", {"start": 1.0}, "start: expected a time from 0"),
        ("run.html", {"start": math.nan}, "start"),
        ("run.html", {"start": 0.5, "end": 0.4}, "end: expected a time after 0.5 s"),
        ("run.html", {"end": 2.0}, "at most 1 s"),
        ("run.gif", {"speed": 1e-9}, "frames"),
    ],
)
def test_faults_are_told_and_nothing_is_written(file: str, options: Any, said: str, tmp_path: Path) -> None:
    pytest.importorskip("matplotlib")
    with pytest.raises(carom.CaromError, match=said) as caught:
        carom.simulate(hop()).animate(tmp_path / file, **options)
    assert len(caught.value.faults) == 1
    assert list(tmp_path.iterdir()) == []


def test_two_faults_are_two_lines(tmp_path: Path) -> None:
    with pytest.raises(carom.CaromError) as caught:
        carom.simulate(hop()).animate(tmp_path / "run.html", fps=-1, speed="fast")
    assert len(caught.value.faults) == 2


@pytest.mark.parametrize("scene", [still, away, three])
def test_any_run_can_be_filmed(scene: Any, tmp_path: Path) -> None:
    pytest.importorskip("matplotlib")
    run = carom.simulate(scene())
    path = run.animate(tmp_path / "run.gif", fps=4, speed=4.0)
    assert path.read_bytes()[:6] == b"GIF89a"


def test_a_ball_that_left_is_not_drawn(tmp_path: Path) -> None:
    ball = SceneBall(radius=0.03, mass=0.2, position=(0.3, 0, 0.3), velocity=(2.0, 0, 1.0))
    table = {"shape": "table", "length": 1.0, "width": 1.0, "height": 0.05, "restitution": 0.8, "friction": 0.1}
    wall = Plane(point=(-3, 0, 0), normal=(1, 0, 0), restitution=0.5, friction=0.1)
    scene = Scene.model_validate(
        {"floor": {"friction": 0.2}, "walls": [table, wall], "balls": [ball], "run": {"duration": 2.0}}
    )
    run = carom.simulate(scene)
    assert run.final_phase == ["left"]
    run.animate(tmp_path / "run.html")
    data = data_of(tmp_path / "run.html")
    assert data["phases"][data["balls"][0]["pieces"][-1][-1]] == "left"
    run.plot(tmp_path / "run.svg")
    run.animate(tmp_path / "run.gif", fps=5)
