"""Whole shots in the files of other programs, and films as they are: gaps, jumps, exchanged and hidden balls, rounding."""

from __future__ import annotations

import json
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import carom
from carom.errors import CaromError
from carom.fitting.shots import drawn_films
from carom.fitting.shots.search import filmed_shots
from carom.tracks import Calibration, Track, read_tracks
from carom.tracks.films import tracks_of_films
from carom.tracks.formats.programs import TAILUGE as UNIT
from carom.tracks.preprocess import with_one_name, with_own_names

RADIUS = 0.03075


@pytest.fixture(scope="module")
def films() -> list[Track]:
    # (to a time at which no ball is about to turn)
    return [track.select(track.time < 2.3) for track in drawn_films(2, seed=5, until=2.5)[0]]


def by_shot(tracks: list[Track]) -> dict[str, list[Track]]:
    groups = dict.fromkeys(track.group for track in tracks)
    return {group: [track for track in tracks if track.group == group] for group in groups}


def tailuge_shots(tracks: list[Track]) -> str:
    """Write a list of shots as tailuge/billiards does: from the table's centre, in its units, three decimals."""
    shots = []
    for number, members in enumerate(by_shot(tracks).values()):
        balls = {}
        for one in members:
            x, y = ((one.position - (1.42, 0.71)) / UNIT).round(3).T.tolist()
            balls[one.name] = {"t": one.time.round(3).tolist(), "x": x, "y": y}
        shots.append({"id": number, "balls": balls, "shot": {"cueBallId": 0, "power": 5.25}, "mover": "1"})
    return json.dumps(shots)


def tailuge_truth(tracks: list[Track]) -> str:
    """Write one shot with the samples it is fitted to."""
    truth = [
        {"ball": k, "t": t, "x": (x - 1.42) / UNIT, "y": (y - 0.71) / UNIT}
        for k, one in enumerate(tracks)
        for t, (x, y) in zip(one.time.tolist(), one.position.tolist(), strict=True)
    ]
    return json.dumps({"source": "film.txt", "sim": {"shot": {"power": 2.8}, "balls": []}, "truth": truth}, indent=2)


def pooltool_shot(tracks: list[Track], pocketed: int = 0) -> dict[str, Any]:
    """Write the paths of a System of pooltool's; the last ones of the last ball in a pocket."""
    balls = {}
    for k, one in enumerate(tracks):
        rows = len(one) - (pocketed if k == len(tracks) - 1 else 0)
        states = [
            {"rvw": [[*place, RADIUS], [0, 0, 0], [0, 0, 0]], "s": 2 if i < rows else 4, "t": t}
            for i, (t, place) in enumerate(zip(one.time.tolist(), one.position.tolist(), strict=True))
        ]
        balls[one.name] = {"id": one.name, "history": {"states": states[:1]}, "history_cts": {"states": states}}
    return {"cue": {}, "table": {}, "balls": balls, "t": 2.5, "events": []}


def test_the_shots_of_tailuge_are_read(films: list[Track], tmp_path: Path) -> None:
    path = tmp_path / "shots.json"
    path.write_text(tailuge_shots(films))
    found = read_tracks(path)
    assert found.format == "tailuge"
    assert [(one.group, one.name) for one in found.tracks] == [
        (f"shot {k}", f"ball {i}") for k in (0, 1) for i in (1, 2, 3)
    ]
    for mine, one in zip(found.tracks, films, strict=True):
        np.testing.assert_allclose(mine.position, one.position - (1.42, 0.71), atol=0.0006)
        np.testing.assert_allclose(mine.time, one.time, atol=1e-9)
    assert any("table of 2.84 m" in note for note in found.notes)
    # as a whole shot: the same contacts as in the film, on a table whose centre is the origin
    assert [len(shot.events) for shot in filmed_shots(list(found.tracks), RADIUS).shots] == [
        len(shot.events) for shot in filmed_shots(films, RADIUS).shots
    ]
    doubled = read_tracks(path, calibration=Calibration(scale=2 * UNIT)).tracks[0]
    np.testing.assert_allclose(doubled.position, 2 * found.tracks[0].position, rtol=1e-12)

    one = tmp_path / "shot.json"
    one.write_text(tailuge_truth(films[:3]))
    mine = read_tracks(one).tracks
    assert [track.name for track in mine] == ["ball 0", "ball 1", "ball 2"]
    np.testing.assert_allclose(mine[0].position, films[0].position - (1.42, 0.71), atol=1e-12)


def test_the_shots_of_pooltool_are_read(films: list[Track], tmp_path: Path) -> None:
    path = tmp_path / "shot.json"
    path.write_text(json.dumps(pooltool_shot(films[:3], pocketed=20)))
    found = read_tracks(path)
    assert found.format == "pooltool"
    for mine, one in zip(found.tracks, films[:3], strict=True):
        np.testing.assert_allclose(mine.position[mine.seen], one.position[mine.seen])
    assert [int((~one.seen).sum()) for one in found.tracks] == [0, 0, 20]
    several = {"multisystem": [pooltool_shot(one) for one in by_shot(films).values()], "active_index": 0}
    path.write_text(json.dumps(several))
    assert [one.group for one in read_tracks(path).tracks] == ["shot 0"] * 3 + ["shot 1"] * 3


def test_a_shot_that_pooltool_wrote_itself_is_read() -> None:
    """As MessagePack (tests/interop/files), the path every 0.02 s."""
    pytest.importorskip("msgpack")
    found = read_tracks(Path(__file__).parents[1] / "interop/files/bank.msgpack")
    assert [one.name for one in found.tracks] == ["ball white", "ball red"]
    white = found.tracks[0]
    np.testing.assert_allclose(white.position[0], (0.4, 0.5))
    assert np.ptp(np.diff(white.time)[:20]) < 0.03


WRONG: list[tuple[str, str | bytes, str]] = [
    ("a.json", '[{"id":0,"balls":{"1":{"t":[0,1],"x":[0],"y":[0,0]}}}]', "tailuge/billiards: shot 0: expected balls"),
    ("a.json", '[{"id":0,"balls":{"1":{"t":[0,1],"x":[0,1],"y":[0,"a"]}}}]', "missing or no number: could not convert"),
    ("a.json", '[{"id":0,"balls":{"1":{"t":[0,1', "tailuge/billiards: expected JSON, got text "),
    ("a.json", '{"sim": {}, "truth": [{"ball": 0, "t": 1, "x": 2}]}', "missing or no number: 'y'"),
    ("a.json", '[{"id":0,"balls":{"1":{"t":[0,1],"x":[0,1e999],"y":[0,0]}}}]', "1: x: expected"),
    ("a.json", '{"balls": {"1": {"history_cts": {"states": []}}}}', "in steps of time, got none, but events"),
    (
        "a.json",
        '{"balls": {"1": {"history_cts": {"states": [{"t": 0}]}}}}',
        "balls.1.history_cts.states.0.rvw: expected",
    ),
    ("a.json", '{"balls": {"1": {"history_cts": {"sta', "pooltool: expected JSON, got text "),
    ("a.msgpack", b"\x84\xa3cue\x00\x00", "expected a whole MessagePack file, got one that ends or errs"),
]


@pytest.mark.parametrize(("name", "text", "expected"), WRONG)
def test_a_wrong_file_is_one_line(name: str, text: str | bytes, expected: str, tmp_path: Path) -> None:
    path = tmp_path / name
    path.write_bytes(text if isinstance(text, bytes) else text.encode())
    with pytest.raises(CaromError) as error:
        read_tracks(path)
    assert len(error.value.faults) == 1
    assert expected in str(error.value), str(error.value)
    assert "\n" not in str(error.value)


def contacts(tracks: list[Track]) -> list[list[tuple[str, int, str]]]:
    return [[(one.kind, one.ball, one.other) for one in shot.events] for shot in filmed_shots(tracks, RADIUS).shots]


def jumping(track: Track) -> Track:
    place = track.position.copy()
    place[[20, 61]] += (0.3, -0.2)
    return replace(track, position=place)


def hidden(track: Track) -> Track:
    return track.select(np.r_[0:44, 50 : len(track)])


FAULTS: dict[str, Callable[[Track], Track]] = {
    "a place far off in two frames": jumping,
    "hidden for 0.12 s": hidden,
    "every tenth frame missing": lambda track: track.select(np.arange(len(track)) % 10 != 7),
    "places to the millimetre": lambda track: replace(track, position=np.round(track.position, 3)),
    "times to the centisecond": lambda track: replace(track, time=np.round(track.time, 2)),
    "a clock that begins late": lambda track: replace(track, time=track.time + 12.34),
}


@pytest.mark.parametrize("fault", FAULTS)
def test_a_film_as_films_are_shows_the_same_contacts(fault: str, films: list[Track]) -> None:
    assert contacts([FAULTS[fault](one) for one in films]) == contacts(films)


@pytest.mark.parametrize("until", [75, None])
def test_balls_that_exchange_their_names_get_them_back(until: int | None, films: list[Track]) -> None:
    wrong = list(films)
    for first in (0, 3):
        mine, yours = (wrong[k].position.copy() for k in (first, first + 1))
        mine[70:until], yours[70:until] = yours[70:until].copy(), mine[70:until].copy()
        wrong[first : first + 2] = replace(wrong[first], position=mine), replace(wrong[first + 1], position=yours)
    notes: list[str] = []
    for one, right in zip(with_own_names(wrong, notes), films, strict=True):
        np.testing.assert_array_equal(one.position, right.position)
    times = "once" if until is None else "2 times"
    assert notes[0] == f"shot 1: 1, 2 exchange their names in the file {times}, first at t = 1.4 s: exchanged back"


def test_a_ball_that_goes_on_under_another_name_is_one_ball(films: list[Track]) -> None:
    notes: list[str] = []
    assert all(one is two for one, two in zip(with_one_name(films, notes), films, strict=True))
    assert notes == []
    # renamed twice, once after two missing frames
    whole = films[0]
    rows = np.arange(len(whole))
    parts = [
        whole.select(rows < 60),
        replace(whole.select((rows >= 60) & (rows < 90)), name="7"),
        replace(whole.select(rows >= 92), name="8"),
    ]
    found = with_one_name([*parts, *films[1:]], notes)
    assert [one.name for one in found] == [one.name for one in films]
    np.testing.assert_array_equal(found[0].position, whole.position[(rows < 90) | (rows >= 92)])
    assert len(notes) == 2
    assert f"shot 1: 7 begins at t = {whole.time[60]:.6g} s where 1 ends: taken as one ball, 1" in notes
    # another ball, which comes into view a diameter away, or a second later
    t, x = whole.time[rows < 60], whole.position[rows < 60]
    for late, away in ((0.02, 2 * RADIUS), (1.0, 0.0)):
        other = Track("9", t[-1] + late + t, x[-1] + [away, 0.0] + 0 * x, group="shot 1")
        assert len(with_one_name([parts[0], other], notes)) == 2
    assert len(notes) == 2


@pytest.mark.parametrize("several", [False, True], ids=["one file", "two"])
def test_notes_of_reading_are_of_the_chosen_shots(several: bool, tmp_path: Path) -> None:
    t = np.arange(80) * 0.02
    rows = {
        shot: [
            f"{shot},1,{at:.2f},{x:.4f},0.5"
            for at, x in zip(t, jumping(Track("1", t, np.c_[0.2 * t, 0 * t])).position[:, 0], strict=True)
        ]
        for shot in ("s1", "s11")
    }
    files = [rows["s1"], rows["s11"]] if several else [[*rows["s1"], *rows["s11"]]]
    paths = [tmp_path / f"{'ab'[k]}.csv" for k in range(len(files))]
    for path, lines in zip(paths, files, strict=True):
        path.write_text("\n".join(["shot,ball,t,x (m),y (m)", *lines]))
    for name, start in (
        (("a s1", "a: s1 1: "), ("b s11", "b: s11 1: ")) if several else (("s1", "s1 1: "), ("s11", "s11 1: "))
    ):
        tracks, notes = tracks_of_films(paths, where=f"shot={name}")
        assert [track.group for track in tracks] == [name]
        assert len([note for note in notes if "the ball jumps" in note]) == 1
        assert any(note.startswith(f"{start}the ball jumps") for note in notes)
    assert len([note for note in tracks_of_films(paths)[1] if "the ball jumps" in note]) == 2


def test_balls_that_collide_keep_their_names(films: list[Track]) -> None:
    notes: list[str] = []
    assert all(one is two for one, two in zip(with_own_names(films, notes), films, strict=True))
    # head-on, at 6 m/s and 25 frames per second: the second goes on as the first would have
    balls = [{"radius": RADIUS, "mass": 0.21, "position": (x, 0), "velocity": (v, 0)} for x, v in ((0, 6), (0.8, 0))]
    run = carom.simulate(carom.Scene(floor={"friction": 0.01}, balls=balls, run={"duration": 0.5}))
    for begin in np.linspace(0, 0.04, 21):
        t = begin + np.arange(0, 0.45, 0.04)
        place = np.asarray(run.at(t).position)
        assert with_own_names([Track(str(k), t, place[:, k, :2], group="a") for k in (0, 1)], notes)
    assert notes == []
