"""Animations: pages whose motion is the run's, films with all their frames, nothing half-written."""

from __future__ import annotations

import itertools
import math
import shutil
import struct
import sys
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
from reference.drawn_scenes import away, hop, still, three

import carom
from carom.plot import film
from carom.scene import Plane, Scene, SceneBall

needs_ffmpeg = pytest.mark.skipif(shutil.which("ffmpeg") is None, reason="ffmpeg is not installed")


def test_a_page_needs_no_matplotlib(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    run = carom.simulate(hop())
    monkeypatch.setitem(sys.modules, "matplotlib", None)
    run.animate(tmp_path / "run.html")
    with pytest.raises(carom.CaromError, match=r"animate: needs Matplotlib, .*install .*\[plot\]"):
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
    from carom.plot.film import Film
    from carom.plot.style import style

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
    assert film.ffmpeg() == "/its/own/ffmpeg"


def test_without_ffmpeg_it_says_what_to_install(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    pytest.importorskip("matplotlib")
    monkeypatch.setattr(shutil, "which", lambda _name: None)
    monkeypatch.setitem(sys.modules, "imageio_ffmpeg", None)
    with pytest.raises(carom.CaromError, match=r"install .*\[film\]"):
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
    run.plot(tmp_path / "run.svg")
    run.animate(tmp_path / "run.gif", fps=5)
