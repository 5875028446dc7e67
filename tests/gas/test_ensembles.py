"""Ensembles of gases: the members are the gases of their seeds, means and errors are theirs, whatever the number of threads."""

from __future__ import annotations

import json
import math
import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import numpy as np
import pytest
from reference.gases import MIXED, ROUGH
from typer.testing import CliRunner

import carom
from carom.cli import app, main
from carom.formatting import format_uncertain
from carom.gas import Session, load_gas
from carom.gas.report import report
from carom.plot import plot_ensemble, plot_gas
from carom.sweeps import gas_ensemble

SHORT = ROUGH.replace("60_000", "6_000").replace("5_000", "1_000")


@pytest.fixture
def folder(tmp_path, monkeypatch) -> Path:
    for name, text in (("rough", SHORT), ("mixed", MIXED.replace("duration = 20.0", "duration = 3.0"))):
        (tmp_path / f"{name}.toml").write_text(text)
    monkeypatch.chdir(tmp_path)
    return tmp_path


def plain(value):
    """A report without the processor time, as text with all digits."""
    return json.dumps({name: part for name, part in value.items() if name != "cpu_seconds"})


def refusal(capsys, monkeypatch, *words: str) -> list[str]:
    monkeypatch.setattr(sys, "argv", ["carom", "gas", *words])
    with pytest.raises(SystemExit) as ended:
        main()
    out, err = capsys.readouterr()
    assert (ended.value.code, out) == (2, "")
    return [line.removeprefix("carom: ") for line in err.splitlines()]


@pytest.mark.parametrize("name", ["rough", "mixed"])
def test_neither_threads_nor_a_store_changes_a_bit(folder, name, monkeypatch):
    scene = load_gas(folder / f"{name}.toml")
    monkeypatch.setattr("carom.sweeps.ensembles.BLOCK_GASES", 2)
    monkeypatch.setattr("carom.sweeps.orbits.thread_count", lambda: 1)
    one = gas_ensemble(scene, 5)
    monkeypatch.setattr("carom.sweeps.orbits.thread_count", lambda: 4)
    pytest.importorskip("zarr")

    def halt(done: float, *_rest: object) -> None:
        if done == 2:
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        gas_ensemble(scene, 5, store=folder / "e.zarr", progress=halt)
    told: list[float] = []
    many = gas_ensemble(scene, 5, store=folder / "e.zarr", progress=lambda done, *_rest: told.append(done))
    assert told == [0, 2, 4, 5]  # the first block was there
    for part in ("mean", "error"):
        assert plain(getattr(one, part)) == plain(getattr(many, part))
    assert list(map(plain, one.members)) == list(map(plain, many.members))
    assert one.curves.keys() == many.curves.keys()
    for key, curve in one.curves.items():
        assert all(a.tobytes() == b.tobytes() for a, b in zip(curve, many.curves[key], strict=True)), key


def test_members_are_the_gases_of_their_seeds(folder):
    scene = load_gas(folder / "rough.toml")
    small, large = (gas_ensemble(scene, count) for count in (2, 5))
    assert large.seeds[:2] == small.seeds
    assert len(set(large.seeds)) == 5
    assert gas_ensemble(carom.replaced(scene, {"run.seed": 2}), 2).seeds != small.seeds
    for seed, member in zip(small.seeds, small.members, strict=True):
        alone = Session(carom.replaced(scene, {"run.seed": seed}))
        alone.run()
        assert plain(report(alone)) == plain(member)
    axes = plot_gas(alone).axes  # of the last one: every axis with its unit
    assert [one.get_xlabel() for one in axes[3:]] == ["time, s", "distance of centres, m", "lag time, s"]
    titles = [one.get_title(loc="left") for one in axes[3:]]
    assert titles == ["temperature, J", "pair correlation", "mean square displacement, m²"]


def test_means_and_errors_are_those_of_the_members(folder):
    found = gas_ensemble(load_gas(folder / "mixed.toml"), 4)
    places = (
        lambda one: one["pressure"],
        lambda one: one["species"]["small"]["a2_rotational"],
        lambda one: one["channels"][1]["rate"],
        lambda one: one["wall_pressure"]["bottom"],
    )
    for place in places:
        values = [place(one) for one in found.members]
        assert place(found.mean) == pytest.approx(math.fsum(values) / 4, rel=1e-13)
        square = math.fsum((x - place(found.mean)) ** 2 for x in values)
        assert place(found.error) == pytest.approx(math.sqrt(square / 3) / 2, rel=1e-12)
    assert math.isnan(found.mean["diffusion"])  # walls
    assert found.mean["channels"][1]["between"] == ("big", "small")
    assert not any(name.startswith("displacement") for name in found.curves)
    for part in ("translational", "rotational"):
        big, small = (found.curves[f"temperature_{part}.{name}"].mean for name in ("big", "small"))
        assert 60 * big + 100 * small == pytest.approx(160 * found.curves[f"temperature_{part}"].mean, rel=1e-12)
    assert found.curves["density.big"].mean.mean() == pytest.approx(60 / (20 * 16), rel=1e-12)
    warm = found.curves["temperature_translational"]
    assert len(warm.x) > 30
    assert (np.diff(warm.x) > 0).all()
    assert warm.x[-1] <= 3.0 * (1 + 1e-12)
    figure = plot_ensemble(found)
    assert len(figure.axes) == 6
    assert figure.axes[2].get_title(loc="left") == "temperature, J"
    assert [axes.get_xlabel() for axes in figure.axes[2:5]] == ["time, s", "distance of centres, m", "y, m"]
    assert figure.axes[3].get_title(loc="left") == "pair correlation (local density)"
    assert figure.axes[4].get_title(loc="left") == "mean number density, 1/m²"
    assert figure.axes[5].get_title(loc="left") == "pressure of each gas, N/m"
    assert "Units of the scene" in figure.texts[1].get_text()


def test_the_ratio_of_the_temperatures_is_a_mean_over_the_gases(folder):
    found = gas_ensemble(load_gas(folder / "mixed.toml"), 4)
    for place in (lambda one: one, lambda one: one["species"]["big"]):
        ratios = [
            place(one)["temperature_rotational"] / place(one)["temperature_translational"] for one in found.members
        ]
        assert place(found.mean)["temperature_ratio"] == pytest.approx(np.mean(ratios), rel=1e-12)
        error = np.std(ratios, ddof=1) / 2
        assert place(found.error)["temperature_ratio"] == pytest.approx(error, rel=1e-9)
    shown = CliRunner().invoke(app, ["gas", "mixed.toml", "--ensemble", "4"], catch_exceptions=False).stdout
    whole = format_uncertain(found.mean["temperature_ratio"], found.error["temperature_ratio"])
    assert f"rotational / translational {whole}" in " ".join(shown.split())


@pytest.mark.slow
def test_the_mean_agrees_with_one_long_run_and_the_error_bar_is_honest(folder):
    scene = load_gas(folder / "rough.toml")
    found = gas_ensemble(scene, 24)
    long = Session(scene.model_copy(update={"run": scene.run.model_copy(update={"max_events": 24 * 6000})}))
    long.run()
    # both have the same number of collisions, so about the same error
    assert abs(found.mean["pressure"] - long.result.pressure) < 4 * math.sqrt(2) * found.error["pressure"]
    assert found.error["pressure"] < 0.01 * found.mean["pressure"]
    # the errors of quarters of the ensemble follow from their scatter: chi^2 of 3 degrees of freedom, 0.1 % beyond 16.3
    quarters = np.array([one["pressure"] for one in found.members]).reshape(4, 6).mean(axis=1)
    chi2 = ((quarters - found.mean["pressure"]) ** 2).sum() / (4 * found.error["pressure"] ** 2)
    assert 0.02 < chi2 < 16.3


def test_gases_that_would_be_the_same_are_refused(folder, capsys, monkeypatch):
    rng, cold = (
        np.random.default_rng(1),
        SHORT.replace("temperature = 1.0\ntemperature_rotational = 0.5", "temperature = 0"),
    )
    said = "expected a start that depends on the seed, got gases that would all be the same"
    (folder / "cold.toml").write_text(cold.replace("max_events = 6_000", "duration = 1.0"))
    (line,) = refusal(capsys, monkeypatch, "cold.toml", "--ensemble", "3")
    assert line.startswith(f"cold.toml: run: {said}; give a temperature > 0")
    gas = Session(load_gas(folder / "rough.toml")).gas.balls()
    np.savez(folder / "start.npz", position=gas.position, velocity=rng.normal(size=(200, 3)))
    (folder / "file.toml").write_text(SHORT + 'start = "start.npz"\n')
    assert gas_ensemble(load_gas(folder / "file.toml"), 2).error["pressure"] > 0  # spins are drawn
    np.savez(folder / "start.npz", position=gas.position, velocity=gas.velocity, spin=gas.spin)
    with pytest.raises(carom.CaromError, match=said):
        gas_ensemble(load_gas(folder / "file.toml"), 2)


def test_bad_arguments_are_one_line(folder, capsys, monkeypatch):
    scene = load_gas(folder / "rough.toml")
    for members in (1, 2.5, True):
        with pytest.raises(carom.CaromError, match=r"^gas_ensemble: members: expected a whole number >= "):
            gas_ensemble(scene, members)
    (line,) = refusal(capsys, monkeypatch, "rough.toml", "--store", "e.zarr")
    assert line == "--ensemble: expected a number of gases with --store and --on, got none"
    with pytest.raises(carom.CaromError, match="scene: expected a GasScene, got int"):
        gas_ensemble(3, scene)
    (line,) = refusal(capsys, monkeypatch, "rough.toml", "--ensemble", "1")
    assert line == "--ensemble: expected a number of gases >= 2, got 1"
    lines = refusal(
        capsys,
        monkeypatch,
        "rough.toml",
        "--ensemble",
        "2",
        "--checkpoint",
        "c.npz",
        "--snapshots",
        "s.gsd",
        "--resume",
        "r.npz",
    )
    assert lines == [
        f"{option}: expected none with --ensemble, got {file}; run one of its gases by its --seed, which --json prints"
        for option, file in (("--snapshots", "s.gsd"), ("--checkpoint", "c.npz"), ("--resume", "r.npz"))
    ]
    assert sorted(path.name for path in folder.iterdir()) == ["mixed.toml", "rough.toml"]


def test_a_member_that_fails_names_its_seed(folder):
    text = MIXED.replace("contact_time = 1e-6\n", "").replace("restitution = 0.99", "restitution = 0.0")
    text = text.replace("gravity = 0.2", "gravity = 5.0").replace("restitution = 1.0", "restitution = 0.0")
    (folder / "dead.toml").write_text(text.replace("duration = 20.0", "duration = 1000.0"))
    with pytest.raises(carom.CaromError, match=r"an inelastic collapse at t = .* \(the gas with seed \d+\)$") as found:
        gas_ensemble(load_gas(folder / "dead.toml"), 3)
    assert len(found.value.faults) == 1


def test_the_command_prints_what_the_library_finds(folder):
    words = ["gas", "rough.toml", "--ensemble", "3", "--measures", "m.json", "--plot", "g.svg", "--json"]
    done = CliRunner().invoke(app, words, catch_exceptions=False)
    assert done.exit_code == 0
    shown, ensemble = json.loads(done.stdout), gas_ensemble(load_gas(folder / "rough.toml"), 3)
    assert shown["seeds"] == list(ensemble.seeds)
    for part in ("mean", "error"):
        assert plain(shown[part]) == plain(getattr(ensemble, part))
    written = json.loads((folder / "m.json").read_text())
    assert len(written["members"]) == shown["ensemble"] == 3
    g = written["curves"]["pair_correlation.a.a"]
    assert g["mean"] == ensemble.curves["pair_correlation.a.a"].mean.tolist()
    assert (folder / "g.svg").stat().st_size > 10_000
    table = CliRunner().invoke(app, words[:4], catch_exceptions=False).stdout
    assert "3 gases: 200 balls" in table
    mean, error = (getattr(ensemble, part)["pressure"] for part in ("mean", "error"))
    assert f"{mean:.4f}"[:5] in table
    assert 0 < error < 0.1 * mean


COOLING = """
[container]
shape = "periodic"
size = [8.0, 8.0, 8.0]
[[species]]
count = 100
radius = 0.5
[[contacts]]
between = ["a", "a"]
restitution = 0.8
friction = 0.0
[run]
equilibrate = 0
max_events = 10_000
"""


def test_a_cooling_ensemble_is_drawn_as_a_single_gas_is(folder):
    """There was an empty place in the grid of panels, and the temperature was drawn over a linear axis of time."""
    (folder / "cooling.toml").write_text(COOLING)
    found = gas_ensemble(load_gas(folder / "cooling.toml"), 3)
    assert "displacement" not in found.curves
    moved = found.curves["displacement_by_collisions"]
    assert (np.diff(moved.mean) > 0).all()
    assert 150 < moved.x[-1] <= 200  # collisions per ball
    axes = plot_ensemble(found).axes
    assert (axes[2].get_xscale(), axes[2].get_yscale()) == ("log", "log")
    assert axes[4].get_xlabel() == "collisions per ball"
    assert len(axes) == 6
    assert all(one.axison for one in axes)
    # the spins of smooth balls, which nothing changes, have no curve
    assert axes[2].get_legend() is None
    assert len(axes[2].lines) == 1


def test_gases_of_which_only_some_have_a_diffusion_coefficient(folder):
    text = COOLING.replace("0.8", "0.99").replace("10_000", "{}")
    counts = (2000, 3000, 4000, 5000, 6000, 7000)
    kinds = []
    for count in counts:
        (folder / "cooling.toml").write_text(text.format(count))
        curves = gas_ensemble(load_gas(folder / "cooling.toml"), 4).curves
        kinds.append("displacement" in curves)
        assert kinds[-1] != ("displacement_by_collisions" in curves)
    assert kinds[0] > kinds[-1]


@pytest.mark.slow
def test_an_interrupt_ends_all_members(folder):
    (folder / "long.toml").write_text(ROUGH.replace("60_000", "900_000_000"))
    # (a shell that runs the tests in the background has told them to ignore SIGINT, and they pass that on)
    heeding = (
        "import runpy, signal; signal.signal(signal.SIGINT, signal.default_int_handler);"
        " runpy.run_module('carom', run_name='__main__')"
    )
    running = subprocess.Popen(
        [sys.executable, "-c", heeding, "gas", "long.toml", "--ensemble", "3"],
        stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
        env={**os.environ, "PYTHONPATH": str(Path(carom.__file__).parents[1])},
    )  # fmt: skip
    try:
        assert running.stderr is not None
        assert any("simulating 3 gases" in line for line in running.stderr)
        time.sleep(1)
        running.send_signal(signal.SIGINT)
        out, err = running.communicate(timeout=60)
    finally:  # (it would go on for hours)
        running.kill()
    assert (running.returncode, out) == (130, "")
    assert err.splitlines()[-1] == "carom: interrupted; nothing was saved"
