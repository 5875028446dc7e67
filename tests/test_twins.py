"""Each verb of the command is a function of Python: the same names and defaults, and the command calls it."""

from __future__ import annotations

import importlib
import inspect
import math
import re
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
import typer

import carom
from carom.cli import app
from carom.cli.parameters import Given, of_library, parameters
from carom.cli.verbs import App
from carom.fitting import Ranking

# Verbs that take the parameters of functions, which are read as text.
TWINS: dict[str, str] = {
    "predict": "data.predict:predict", "orbit": "billiards.orbit_by_name:orbit", "design": "fitting.design_shots:design",
    "fit": "fitting.files:fit", "track": "tracks.video.film:track_film", "tracks show": "tracks.films:measure_tracks",
    "judge": "tracks.judgement:judge", "compare": "laws.comparison:incoming",
}  # fmt: skip
OTHERS = {"progress", "say", "film", "fine", "path", "files", "file", "table", "kappa", "gravity", "sizes"}
REFUSED = {"track": {"picture_height"}}  # by the function, too: it is for the files of other programs


def commands(group: Any, path: str = "") -> dict[str, Any]:
    found = {}
    for name, one in group.commands.items():
        inner = commands(one, f"{path}{name} ") if hasattr(one, "commands") else {f"{path}{name}": one}
        found |= inner
    return found


COMMANDS = commands(typer.main.get_command(app))


@pytest.mark.parametrize("verb", TWINS)
def test_a_verb_has_the_parameters_of_its_function(verb: str) -> None:
    module, _, name = TWINS[verb].partition(":")
    function = getattr(importlib.import_module(f"carom.{module}"), name)
    read = parameters(TWINS[verb])
    own = {name: one for name, one in inspect.signature(function).parameters.items() if one.kind is not one.VAR_KEYWORD}
    assert {name: one.default for name, one in read.items()} == {name: one.default for name, one in own.items()}
    assert [name for name, one in read.items() if not one.text and name != "progress"] == []
    options = {name for option in COMMANDS[verb].params for name in (option.name, option.name.strip("_"))}
    assert set(own) - options <= OTHERS | REFUSED.get(verb, set())


def test_options_become_the_values_that_the_function_takes() -> None:
    seen: list[Any] = []

    @of_library("fitting.design_shots:design", "tracks.video.film:track_film")
    def verb(*, given: Given) -> None:
        seen.append((dict(given), [str(fault) for fault in given.faults]))

    def run(*words: str) -> Any:
        app = App()
        app.command("verb")(verb)
        app.callback()(lambda: None)
        typer.main.get_command(app)(["verb", *words], standalone_mode=False)
        return seen.pop()

    assert run() == ({}, [])
    words = (
        "--laws maw,contact --laws mirror --inertia 0.5 --radius 20mm --truth e=0.5 --truth f=1 --angles 5:60 --spins unknown"
        " --speeds 2 --spin normal --length 1,2,3,4=1m --ball 1,2@0 --ball 3,4@1 --from 100ms"
    )
    assert run(*words.split()) == (
        {
            "laws": ["maw", "contact", "mirror"], "inertia": 0.5, "radius": 0.02, "truth": {"e": 0.5, "f": 1.0},
            "angles_deg": (5.0, 60.0), "spins": "unknown", "speeds": (2.0, 2.0), "spin": "normal",
            "film": {"length": "1,2,3,4=1m", "ball": ["1,2@0", "3,4@1"], "start": 0.1},
        },
        [],
    )  # fmt: skip
    found, faults = run("--truth", "e", "--angles", "a:b", "--spins", "5:1")
    assert found == {"spins": (5.0, 1.0)}
    assert [fault.partition(":")[0] for fault in faults] == ["--truth", "--angles"]


def test_each_verb_has_a_function_or_is_known_to_have_none() -> None:
    others = {
        "figures", "simulate", "aim", "explore", "gas", "sweep new", "sweep run", "scene new", "scene check", "laws", "datasets",
        "derive", "tracks example", "doctor",
    }  # fmt: skip
    left = {
        verb
        for verb in COMMANDS
        if verb not in (*TWINS, "fit gas", "fit air") and verb.split()[0] not in {one.split()[0] for one in others}
    }
    assert not left, left


def test_gases_by_the_names_of_the_command(tmp_path: Any) -> None:
    names = inspect.signature(COMMANDS["gas"].callback).parameters
    own = inspect.signature(carom.simulate_gas).parameters
    assert {"max_events", "duration", "seed", "ensemble", "store", "on"} <= set(names) & set(own)
    assert all(
        own[name].default is names[name].default is None for name in ("max_events", "duration", "seed", "ensemble")
    )
    file = tmp_path / "gas.toml"
    file.write_text(
        '[container]\nshape = "periodic"\nsize = [6, 6, 6]\n[[species]]\nname = "a"\ncount = 30\nradius = 0.5\n'
        '[[contacts]]\nbetween = ["a", "a"]\nrestitution = 1\nfriction = 0\n[run]\nmax_events = 300\n'
    )
    seen: list[Any] = []
    gas, run = carom.simulate_gas(file, max_events=200, seed=3, progress=lambda *one: seen.append(one))
    assert (run.pair_collisions, gas.collisions) == (200, 40 * 30 + 200)
    assert all((total, text) == (1400, "collisions") for _done, total, text in seen)
    scene = carom.replaced(carom.gas.load_gas(file), {"run.seed": 3})
    assert carom.simulate_gas(scene, max_events=200)[0].balls().position.tobytes() == gas.balls().position.tobytes()
    assert len(carom.simulate_gas(file, max_events=100, ensemble=2).seeds) == 2


V = [1.0, 2.0, 3.0, 4.0]
REBOUNDS: dict[str, Any] = {
    "v_n_in": V, "v_t_in": V, "spin_in": [0.0] * 4, "v_n_out": [0.81, 1.59, 2.42, 3.18], "v_t_out": [0.71, 1.43, 2.15, 2.85],
    "sigma_v_n_out": 0.02, "sigma_v_t_out": 0.02,
}  # fmt: skip


def test_fits_take_files_columns_and_rebounds_alike(tmp_path: Any) -> None:
    table = carom.data.make_rebounds("planar", REBOUNDS)
    kinds = [table.save(tmp_path / "t.csv"), str(tmp_path / "t.csv"), REBOUNDS, table]
    found = [carom.fit(one, 0.02, laws=["sticking", "mirror"], bootstrap=0) for one in kinds]
    assert re.fullmatch(r"<Ranking: AICc sticking -?[\d.]+, mirror \+[\d.]+>", repr(found[0]))
    assert all(isinstance(one, Ranking) for one in found)
    assert len({one.best.aicc for one in found}) == 1
    inches = REBOUNDS | {"v_n_in_mm_s": [1000.0 * v for v in V]}
    del inches["v_n_in"]
    again = carom.fit(inches, 0.02, laws="sticking", bootstrap=0)
    assert again.best.aicc == pytest.approx(found[0].best.aicc, rel=1e-9)


def test_measured_films_are_one_line(tmp_path: Any) -> None:
    film = tmp_path / "film.csv"
    film.write_text("t [s],x [m],y [m]\n" + "".join(f"{k / 100},{abs(0.2 - k / 100)},{k / 1000}\n" for k in range(40)))
    found = carom.measure_tracks(film, view="above", noise=1e-4)
    assert repr(found) == "<MeasuredFilms: 1 film, 1 contact>"


def test_designs_take_the_rebounds_measured_so_far() -> None:
    plan = carom.design(REBOUNDS, "sliding,mirror", truth={"restitution": 0.8, "friction": 0.3}, radius=0.02)
    assert plan.filmed is not None
    assert not math.isnan(plan.filmed)
    alone = carom.design(laws=("sliding", "mirror"), truth={"restitution": 0.8, "friction": 0.3}, radius=0.02)
    assert alone.filmed is None
    assert np.isfinite(alone.gain).all()


@pytest.mark.parametrize(
    ("call", "said"),
    [
        (lambda: carom.fit(REBOUNDS), "`radius`: expected the ball's radius in m"),
        (
            lambda: carom.fit(REBOUNDS, 0.02, fix={"frction": 0.2}),
            "`fix`: expected a parameter of a law, got 'frction'",
        ),
        (lambda: carom.fit(REBOUNDS, 0.02, restitution=1.4), "restitution: expected 0 to 1, got 1.4"),
        (lambda: carom.fit(REBOUNDS, 0.02, bound={"friction": (1, 0)}), "`bound`: friction: expected LOW:HIGH"),
        (lambda: carom.fit(REBOUNDS, 0.02, view="above", laws="mirror"), "`view`: expected a track, got rebounds"),
        (lambda: carom.fit(REBOUNDS, 0.02, whole=True), "expected track files with `whole`, got dict"),
        (lambda: carom.fit({"v_n_in": ["a"], "v_n_out": [1.0], "spin_in": [0.0]}, 0.02), "expected numbers, got 'a'"),
        (lambda: carom.design(kind="tabel"), "`kind`: expected planar or table"),
        (lambda: carom.design(spin=0.0), "`spin`: expected a file of rebounds with it"),
        (lambda: carom.measure_tracks("nothing.txt", view="below"), "`view`: expected one of above, side"),
    ],
)
def test_faults_name_arguments(call: Callable[[], Any], said: str) -> None:
    with pytest.raises(carom.CaromError) as error:
        call()
    assert len(error.value.faults) == 1
    assert said in error.value.faults[0]
