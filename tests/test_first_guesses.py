"""What people write first works: names, units, files, tables; results show themselves in a line, or as a table in a notebook."""

from __future__ import annotations

import re
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pandas
import pytest
from reference.commands import command

import carom
from carom.cli import console


@pytest.fixture
def file(tmp_path: Path) -> Path:
    (tmp_path / "x.toml").write_text(carom.scene_text(), encoding="utf-8")
    return tmp_path / "x.toml"


def test_a_scene_by_the_name_of_its_file(file: Path) -> None:
    run = carom.simulate(str(file))
    assert np.array_equal(run.final.position, carom.simulate(carom.load_scene(file)).final.position)
    assert np.array_equal(run.final.position, carom.simulate(file).final.position)
    with pytest.raises(carom.CaromError, match="expected a scene file, got: No such file"):
        carom.simulate(file.with_name("y.toml"))


def test_numbers_for_compare() -> None:
    assert carom.compare(angle_deg=30, friction=0.2)["two-step"].reflection_angle_deg == (
        carom.compare(carom.incoming(angle_deg=30, friction=0.2))["two-step"].reflection_angle_deg
    )
    assert [one.law for one in carom.compare(laws=["mirror"], angle_deg=30).verdicts] == ["mirror"]
    assert [one.law for one in carom.compare(laws="mirror", angle_deg=30).verdicts] == ["mirror"]
    with pytest.raises(carom.CaromError, match="did you mean 'angle_deg'"):
        carom.compare(angel=30)
    with pytest.raises(carom.CaromError, match="did you mean 'laws'"):
        carom.compare(law="mirror")
    with pytest.raises(carom.CaromError, match="got both \\(angle_deg\\)"):
        carom.compare(carom.incoming(), angle_deg=30)


def test_units() -> None:
    ball = carom.Ball("26 mm", "140 g")
    assert (ball.radius, ball.mass) == (0.026, 0.14)
    assert carom.Disc("1 cm").radius == 0.01
    for bad in ("26 kg", "wide", "26"):
        with pytest.raises(carom.CaromError, match="Ball: radius: expected a length in m, > 0, got"):
            carom.Ball(bad)


def test_settings_of_a_run_in_place_of_the_scenes(file: Path) -> None:
    run = carom.simulate(file, duration="200 ms", law="mirror")
    assert (run.end, run.scene.run.law) == (0.2, "mirror")
    assert carom.simulate(file, max_events=1).ended == "max_events"
    with pytest.raises(carom.CaromError) as error:
        carom.simulate(file, duration=-1, max_events=0)
    assert [fault.split(":")[1].strip() for fault in error.value.faults] == ["duration", "max_events"]


def test_balls_by_name_and_kinds_that_there_are() -> None:
    run = carom.simulate("carom", duration=2)
    name = run.scene.ball_names[0]
    assert run.index(name) == 0
    assert run.phases(name) == run.phases(0)
    assert len(run.events.of(ball=name)) == len(run.events.of(ball=0)) > 0
    assert {one.ball for one in run.events.of(ball=name)} == {0}
    with pytest.raises(carom.CaromError, match=r"Events.of: expected a kind of wall, floor, ball, .*, got 'cushion'"):
        run.events.of("cushion")
    for ball in ("nobody", 7, True, 1.5):
        with pytest.raises(carom.CaromError, match="ball: expected a ball of"):
            run.index(ball)
    with pytest.raises(carom.CaromError, match=r"run.table\(\)"):
        run.save("states.csv")


def test_an_unknown_argument_is_followed_by_those_that_there_are() -> None:
    with pytest.raises(TypeError, match="unexpected keyword argument 'raduis'; did you mean 'radius'") as error:
        carom.Ball(raduis=0.02)  # type: ignore[call-arg]
    assert error.value.__notes__ == ["Ball takes radius, mass, inertia"]
    with pytest.raises(TypeError) as error:
        carom.simulate("carom", t_max=1)  # type: ignore[call-arg]
    assert error.value.__notes__ == ["simulate takes scene, progress, law, duration, max_events"]
    with pytest.raises(
        carom.CaromError, match=r"^state: expected a State, got tuple \(-1, 1, 0\); make one with carom.rolling"
    ):
        carom.two_step(carom.Ball(0.026, 0.14), (-1, 1, 0))  # type: ignore[arg-type]


def test_the_time_of_a_state_is_a_number(file: Path) -> None:
    run = carom.simulate(file)
    with pytest.raises(carom.CaromError, match=r"Trajectory: t: expected times in s, got '0.5 s'"):
        run.at("0.5 s")


def test_tables_without_times(file: Path) -> None:
    pytest.importorskip("pandas")
    run = carom.simulate(file)
    table = run.table()
    assert len(table) == 201
    assert table["t"].iloc[-1] == run.end
    assert run.to_pandas().equals(table)
    pytest.importorskip("xarray")
    assert run.to_xarray().sizes["time"] == 201


def test_names() -> None:
    assert carom.Table is carom.scene.Table
    assert carom.data.read_rebounds is not None
    assert {"fitting", "tracks", "rebounds", "Table", "Space", "sweep"} <= set(dir(carom))
    assert not [name for name in dir(carom) if name.startswith("_")]


def test_results_in_one_line(file: Path) -> None:
    ball = carom.Ball()
    two = carom.two_step(ball, carom.rolling(ball, (-1.0, 1.0)))
    assert repr(two) == "<TwoStep: reflected at 51.52 degrees, flight 58.3 ms, 4.16 mm high, wall stick, floor stick>"
    many = carom.two_step(ball, carom.rolling(ball, [(-1.0, 1.0), (-2.0, 1.0)]))
    assert repr(many) == "<TwoStep of shape (2,)>"
    assert repr(two.wall).startswith("<Impact: stick, impulse (")
    assert repr(many.wall) == "<Impact of shape (2,)>"
    found = carom.compare(laws=["mirror", "two-step"])
    assert repr(found) == "<Comparison at 45 degrees: mirror 45, two-step 51.52*>"
    assert found._repr_html_().count("<tr>") == 3
    assert repr(carom.LAWS["mirror"]).startswith("<Law mirror: ")
    run = carom.simulate(file)
    assert run._repr_html_().count("<tr>") == 1 + min(len(run.events), 20)
    assert len(repr(run)) < 120


@pytest.mark.parametrize("make", [lambda: carom.Table("pool-9ft"), lambda: carom.Floor(0.5, 0.2)])
def test_a_part_of_a_scene_takes_fields_by_name(make: Callable[[], object]) -> None:
    with pytest.raises(carom.CaromError, match=r"^(Table|Floor): expected fields by name, of restitution, friction"):
        make()


def test_what_cannot_be_meant_is_said_once_with_what_is_meant(tmp_path: Path) -> None:
    rows = tmp_path / "rows.csv"
    rows.write_text("v_n_in,v_t_in\n1.5,0.5\n", encoding="utf-8")
    table = "expected a CSV file, as the table is one (.csv or .tsv or .txt), got the ending"
    balls = [carom.SceneBall(radius=0.03, mass=0.2, position=(0, 0))]
    for call, said in (
        (lambda: carom.simulate({"balls": []}),
         "simulate: scene: expected a Scene, got dict {'balls': []}; carom.Scene(**scene) makes one"),
        (lambda: carom.simulate_gas(3),
         "simulate_gas: species: expected a scene (the name of a file, or a GasScene), or a list of Species, got int 3"),
        (lambda: carom.predict(rows, out=tmp_path / "p.qqq"), f"`out` {tmp_path / 'p.qqq'}: {table} .qqq"),
        (lambda: carom.predict(rows, out=tmp_path / "p.pq"), f"`out` {tmp_path / 'p.pq'}: {table} .pq"),
        (lambda: carom.measure_tracks([3]),
         "measure_tracks: files: expected the name of a track file, columns t, x, y, or Tracks, got int 3"),
        (lambda: carom.Scene(walls=[{"shape": "boks"}], balls=balls),
         "Scene: walls[0].shape: expected one of plane, segment, polygon, table, box, strip, wedge, cylinder, arc, sphere, outline,"
         " regular, rectangle, tokarsky, curve, limacon, oval, flower, superellipse, circle, ellipse, sector, stadium, squash,"
         " lemon, mushroom, got 'boks'; did you mean 'box'?"),
    ):  # fmt: skip
        with pytest.raises(carom.CaromError) as error:
            call()
        assert error.value.faults == (said,)
    assert [path.name for path in tmp_path.iterdir()] == ["rows.csv"]
    laws = {"v_n_in": [1.0, 2.0, 3.0], "v_t_in": [1.0] * 3, "v_n_out": [0.8, 1.6, 2.4], "v_t_out": [0.9] * 3}
    for name, advice in (("foo", ""), ("mirorr", "; did you mean 'mirror'?")):
        with pytest.raises(carom.CaromError, match="expected one of mirror, ") as error:
            carom.fit(laws, radius=0.03, laws=[name])
        assert error.value.faults[0].endswith(f"got {name!r}{advice}")


def test_films_in_memory_are_measured_as_their_file_is(tmp_path: Path) -> None:
    t = np.arange(0.0, 0.6, 0.01)
    x, y = np.where(t < 0.3, 0.6 - 2 * t, 1.5 * (t - 0.3)), 0.1 + t
    path = tmp_path / "film.csv"
    rows = zip(t.tolist(), x.tolist(), y.tolist(), strict=True)
    path.write_text("t,x,y\n" + "".join(f"{a!r},{b!r},{c!r}\n" for a, b, c in rows), encoding="utf-8")
    track = carom.tracks.Track("ball", t, np.stack([x, y], axis=-1))
    columns = {"t": t, "x": x, "y": y}
    settings = {"view": "above", "radius": 0.03, "noise": 1e-4}
    first, *others = (
        carom.measure_tracks(film, **settings).rebounds()
        for film in (path, columns, pandas.DataFrame(columns), track, [track])
    )
    for other in others:
        assert {name: column.tobytes() for name, column in other.columns.items()} == {
            name: column.tobytes() for name, column in first.columns.items()
        }
    assert len(carom.measure_tracks([columns, path], **settings).rebounds()) == 2
    with pytest.raises(carom.CaromError, match="`scale` has no effect with Tracks, which are in m; omit it"):
        carom.measure_tracks(track, scale=2.0, **settings)
    with pytest.raises(carom.CaromError) as error:
        carom.measure_tracks({"t": t}, **settings)
    assert error.value.records[0].where == "table 1"
    height = carom.measure_tracks(
        {"t": t, "x": 4 * t - 4.9 * t * t}, radius=0.03, view="side"
    )  # (one coordinate is the height)
    assert any("one coordinate" in line for line in height.notes)


def test_results_draw_themselves(tmp_path: Path) -> None:
    pytest.importorskip("matplotlib")
    orbit = carom.orbit("circle", 30, orbits=2, seed=1)
    for make in (orbit.plot, orbit.portrait, orbit.boundary, orbit.lyapunov):
        assert make().axes
    orbit.plot(tmp_path / "o.png")
    assert carom.orbit("circle", 5, periodic=2).plot().axes
    gas = carom.gas.GasScene(
        container=(6, 6, 6), species=[carom.gas.Species(carom.Ball(0.5, 1.0), 64)], contacts=carom.Surface(1, 0, -1),
        run={"equilibrate": 0, "max_events": 500},
    )  # fmt: skip
    found = carom.simulate_gas(gas)
    assert repr(found).startswith("<Session: 64 balls")
    assert "\n" not in repr(found)
    found.plot(tmp_path / "g.png")
    assert {path.name for path in tmp_path.iterdir()} == {"o.png", "g.png"}


def test_events_are_the_place_of_a_callback(file: Path) -> None:
    with pytest.raises(TypeError, match=r"for event in run\.events"):
        carom.simulate(file, on_event=print)  # type: ignore[call-arg]


def test_laws_that_predict_the_same_share_a_row() -> None:
    found = carom.compare(carom.incoming(restitution=0.85, friction=0.2, floor_restitution=0.5, floor_friction=0.2))
    rows = {row[0]: row[1:] for row in found.table().rows}
    assert list(rows) == ["mirror", "conventional", "no-slip", "two-step, maw, stronge"]
    assert {found[law].reflection_angle_deg.hex() for law in ("maw", "stronge")} == {
        found["maw"].reflection_angle_deg.hex()
    }


def test_decimal_commas_in_options(capsys: pytest.CaptureFixture[str]) -> None:
    comma = ["compare", "--json", "--speed", "1,5", "--restitution", "0,85", "--radius", "28,6mm", "--inertia", "0,4"]
    point = [word.replace(",", ".") for word in comma]
    assert command(capsys, *comma) == command(capsys, *point)
    code, _out, err = command(capsys, "compare", "--speed", "1,500")  # (a thousand and a half, or one and a half)
    assert (code, "'1,500'" in err) == (2, True)


def test_progress_where_there_is_no_terminal(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(console, "LINE_INTERVAL", 0.0)
    with console.working("fit") as show:
        show(1, 4, "two-step")
    assert re.fullmatch(r"fit: 25%, two-step, \d+ s\n", capsys.readouterr().err)
