"""Numbers of a gas's contacts from its tracks."""

from __future__ import annotations

import csv
import json

import numpy as np
import pytest
from reference.commands import command, fails
from reference.gas_films import film, scene

import carom
from carom.fitting.free_balls import collisions_of_tracks
from carom.gas import gas_text

TRUTH = {"restitution": 0.85, "friction": 0.3, "tangential_restitution": 0.4}


def test_collisions_in_exact_tracks_have_the_restitution_and_the_impulse_of_the_law():
    rows, _notes = collisions_of_tracks(film(scene(), 80, noise=0.0, spin_noise=0.0), 0.5)
    assert len(rows["v_n_in"]) > 10
    assert rows["v_n_out"] == pytest.approx(0.85 * rows["v_n_in"], rel=1e-6)
    # the tangential impulse from velocity and from spin, and Coulomb's bound or the tangential restitution
    push = rows["v_t_out"] - rows["v_t_in"]
    assert rows["spin_out"] - rows["spin_in"] == pytest.approx(-push / (0.5 * 0.5), abs=1e-6)
    slip = rows["v_t_in"] - 0.5 * rows["spin_in"]
    assert -push == pytest.approx(np.minimum(1.4 / 3 * slip, 0.3 * 1.85 * rows["v_n_in"]), rel=1e-5)


def test_the_numbers_are_found_in_a_noisy_film_and_by_the_command(tmp_path, capsys):
    columns = film(scene(seed=4))
    found = carom.fit_gas(columns, scene(0.5, 0.5, 0.0))
    assert found.rows > 12
    for name, true in TRUTH.items():
        assert abs(found.values[name] - true) < 4 * found.errors[name] < 0.1
    with (tmp_path / "film.csv").open("w", newline="") as file:
        csv.writer(file).writerows([list(columns), *zip(*columns.values(), strict=True)])
    (tmp_path / "gas.toml").write_text(gas_text(scene(0.5, 0.5, 0.0)), encoding="utf-8")
    words = [str(tmp_path / "film.csv"), "--scene", str(tmp_path / "gas.toml")]
    code, out, _err = command(capsys, "fit", "gas", *words, "--json", "--plot", str(tmp_path / "gas.svg"))
    assert code == 0
    assert (tmp_path / "gas.svg").is_file()
    (line,) = fails(capsys, "fit", "gas", *words, "--plot", str(tmp_path / "gas.doc"))
    assert "ends with .svg, .pdf or .png" in line
    assert json.loads(out)["parameters"]["restitution"]["value"] == pytest.approx(found.values["restitution"], rel=1e-9)


def test_balls_that_meet_across_the_border_are_found_and_a_restitution_that_depends_on_the_speed():
    sides, e = (9.0, 9.0, 9.0), {"form": "viscoelastic", "c": 0.2}
    columns = film(scene(e, seed=1, sides=sides), 120, 0.05)
    free, _notes = collisions_of_tracks(columns, 0.5)
    found = carom.fit_gas(columns, scene({"form": "viscoelastic", "c": 0.5}, sides=sides))
    assert found.rows > 2 * len(free["v_n_in"])
    for name, true in (("restitution_c", 0.2), ("friction", 0.3), ("tangential_restitution", 0.4)):
        assert abs(found.values[name] - true) < 4 * found.errors[name] < 0.1


def test_the_command_says_where(tmp_path, capsys):
    (tmp_path / "gas.toml").write_text(gas_text(scene()), encoding="utf-8")
    (tmp_path / "a.csv").write_text("t,temperature\n0,1\n1,0.5\n", encoding="utf-8")
    (line,) = fails(capsys, "fit", "gas", str(tmp_path / "a.csv"), "--scene", str(tmp_path / "gas.toml"))
    assert "a.csv: expected tracks of balls (columns t, ball, x, y), got t, temperature" in line
