"""A fault is one record: its text is made where it is shown, and the command names its own options."""

from __future__ import annotations

import pickle
import re
from pathlib import Path
from typing import Annotated

import pytest
from typer import Option
from typer.main import get_command

import carom
from carom.cli import verbs
from carom.cli.verbs import App, as_option, in_options
from carom.errors import Fault, FaultList, near_name


@pytest.mark.parametrize(
    ("fault", "line"),
    [
        (Fault("Ball", "radius", "a length", "-1"), "Ball: radius: expected a length, got -1"),
        (Fault("a.csv", "", "a table", ": no such file"), "a.csv: expected a table, got: no such file"),
        (Fault("", "x", "a number", "", "give one"), "x: expected a number; give one"),
        (Fault("gas", advice="the run ended early"), "gas: the run ended early"),
        (Fault("a", "b", "c", " many\n lines "), "a: b: expected c, got many lines"),
    ],
)
def test_the_line_of_a_fault(fault: Fault, line: str) -> None:
    assert str(fault) == line


def test_faults_of_parts_are_collected_and_survive_pickling() -> None:
    faults = FaultList("scene")
    assert faults.attempt(carom.Ball, radius=-1, mass=0) is None
    faults.add("floor", "one", "two", "leave one out")
    with pytest.raises(carom.CaromError) as caught:
        faults.raise_if_any()
    error = pickle.loads(pickle.dumps(caught.value))
    assert error.faults == (
        "Ball: radius: expected a length in m, > 0, got -1",
        "Ball: mass: expected a mass in kg, > 0, got 0",
        "scene: floor: expected one, got two; leave one out",
    )
    assert [fault.where for fault in error.records_at("wall", "Ball")] == ["wall", "wall", "scene"]


def test_the_command_names_its_options(monkeypatch: pytest.MonkeyPatch) -> None:
    imagined = App(name="carom")

    @imagined.callback()
    def root() -> None: ...

    @imagined.command("imagined")
    def verb(
        rate: Annotated[str, Option("--rate", "--fps")] = "",
        most: Annotated[str, Option("--max-size")] = "",
        view: Annotated[str, Option("--view")] = "",
    ) -> None: ...

    monkeypatch.setattr(verbs, "_running", [])
    get_command(imagined)(["imagined"], standalone_mode=False)
    assert in_options("`rate` or `view='side'`, not `nothing`") == "--rate or --view side, not nothing"
    assert in_options("allow more with `max_bytes`") == "allow more with --max-size"
    assert str(as_option(Fault("tracks", "rate", "a number", "x"))) == "--rate: expected a number, got x"
    assert str(as_option(Fault("film.csv", "rate", "a number", "x"))) == "film.csv: rate: expected a number, got x"
    assert str(as_option(Fault(advice="rate: expected a number, got x"))) == "--rate: expected a number, got x"
    assert str(as_option(Fault(advice="view: side: expected above"))) == "--view: side: expected above"
    assert str(as_option(Fault(advice="aim: reach: view: expected x"))) == "--view: expected x"
    assert str(as_option(Fault(advice="film.csv: rate: expected x"))) == "film.csv: rate: expected x"
    assert str(as_option(Fault(advice="rows: expected 3"))) == "rows: expected 3"


@pytest.mark.parametrize(
    ("name", "known", "near"),
    [
        ("restituton", ["restitution", "friction"], "restitution"),
        ("Floor-Friction", ["friction", "floor_friction"], "floor_friction"),
        ("rad", ["radius", "mass"], "radius"),
        ("--rack", ["--force", "--quiet", "--table"], ""),
        ("rum", ["new", "run"], "run"),
        ("nwe", ["new", "check"], "new"),
        ("--setting", ["--set", "--seed"], "--set"),
        ("--rate", ["--at", "--quiet"], ""),
        ("x", ["xy", "xz"], ""),
    ],
)
def test_a_name_is_suggested_where_it_is_near(name: str, known: list[str], near: str) -> None:
    assert near_name(name, known) == near


def test_faults_of_tables_films_and_fits_are_records_with_their_fields(tmp_path: Path) -> None:
    film, table = tmp_path / "film.csv", tmp_path / "table.csv"
    film.write_text("t [s],x [mm],y [mm]\n0,1,2\n1,a,3\n")
    table.write_text("v_n_in,v_t_in,v_n_out,v_t_out,spin_in\n1,1,x,1,0\n")
    found = []
    for act in (
        lambda: carom.measure_tracks(film, view="side"),
        lambda: carom.data.read_rebounds(table),
        lambda: carom.fit(table, 0.02, seed=-1),
        lambda: carom.explore(data=table, laws="no-such-law"),
    ):
        with pytest.raises(carom.CaromError) as caught:
            act()
        found += [(fault.where, fault.field, fault.expected) for fault in caught.value.records]
    assert (str(film), "x [mm]", "a number") in found
    assert found.count((str(table), "v_n_out", "a number")) == 3  # (of the table, the fit, the page)
    assert ("", "`seed`", "a whole number >= 0") in found
    assert any(where == "explore: laws" for where, _field, _expected in found)


def test_every_count_is_checked_in_the_same_words() -> None:
    ball = carom.Ball(0.5, 1.0)
    gas = carom.gas.Gas([carom.gas.Species(ball, 20)], (9, 9, 9), contacts=carom.Surface(1, 0, -1), seed=2)
    table, scene = (
        carom.billiards.circle(),
        carom.Scene(balls=[carom.SceneBall(radius=0.03, mass=0.2, position=(0, 0, 0))]),
    )
    counts = {
        "orbit: bounces": (lambda n: carom.billiards.orbit(table, ((0, 0), (0, 1), 1), n), ">= 1"),
        "Gas.run: chunk": (lambda n: list(gas.run(5, chunk=n)), ">= 1"),
        "aim: starts": (lambda n: carom.aim(scene, ["balls.0.velocity"], {"hit": 1}, starts=n), "from 1 to "),
        "sobol: count": (lambda n: carom.sweeps.sobol(0, 1, n), "from 1 to "),
        "Space: repeats": (lambda n: carom.Space(scene, {"balls.0.spin_z": [0, 1]}, repeats=n), "from 1 to "),
    }
    for where, (act, span) in counts.items():
        for bad, shown in ((True, "True"), (1.5, "1.5"), (0, "0"), ("3", "'3'")):
            with pytest.raises(carom.CaromError) as caught:
                act(bad)
            line = next(line for line in caught.value.faults if line.startswith(where))
            assert line.startswith(f"{where}: expected a whole number {span}")
            assert f", got {shown}" in line


def test_faults_are_raised_once() -> None:
    faults = FaultList("film")
    for _again in range(2):
        faults.add("rate", "a number", "x")
    with pytest.raises(carom.CaromError) as caught:
        faults.raise_if_any()
    assert caught.value.faults == ("film: rate: expected a number, got x",)


def test_no_list_of_faults_holds_texts() -> None:
    for file in Path(carom.__file__).parent.rglob("*.py"):
        assert not re.search(r"\b(faults|found_faults): list\[(str|Any)\]", file.read_text(encoding="utf-8")), file
