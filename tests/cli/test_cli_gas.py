"""carom gas: JSON that is the library's answer, files that are whole, runs that are stopped, killed, and resumed."""

from __future__ import annotations

import functools
import json
import re
import signal
import sys
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from reference.forking import Forked
from reference.gases import MIXED, ROUGH
from typer.testing import CliRunner

from carom.cli import app, main
from carom.gas.scene import load_gas
from carom.gas.session import Session

runner = CliRunner()
KEYS = [
    "pair_collisions", "wall_collisions", "simulated_time", "cpu_seconds", "mean_free_time", "pressure", "energy_drift",
    "temperature_translational", "temperature_rotational", "max_overlap",
]  # fmt: skip
LONG = ROUGH.replace("60_000", "200_000")


@pytest.fixture
def folder(tmp_path, monkeypatch) -> Path:
    for name, text in (("rough", ROUGH), ("mixed", MIXED), ("long", LONG)):
        (tmp_path / f"{name}.toml").write_text(text)
    monkeypatch.chdir(tmp_path)
    return tmp_path


def run(*words: str) -> str:
    done = runner.invoke(app, ["gas", *words], catch_exceptions=False)
    assert done.exit_code == 0
    return done.stdout


def answer(*words: str):
    found = json.loads(run(*words, "--json"))
    assert found.pop("cpu_seconds") > 0
    return found


def refusal(capsys, monkeypatch, *words: str) -> list[str]:
    monkeypatch.setattr(sys, "argv", ["carom", "gas", *words])
    with pytest.raises(SystemExit) as ended:
        main()
    out, err = capsys.readouterr()
    assert ended.value.code == 2
    assert out == ""
    lines = err.splitlines()
    assert all(line.startswith("carom: ") for line in lines)
    return [line.removeprefix("carom: ") for line in lines]


@functools.cache
def whole_long_run():
    """What the long run says that nothing stops."""
    return answer("long.toml")


HIT = """
import os, signal, sys
from carom.cli import main
from carom.gas import files as checkpoint
from carom.gas import snapshots

(where, call, which), sys.argv = SIGNAL, ["carom", "gas", *WORDS]
room, name = {"a checkpoint": (checkpoint.os, "fsync"), "a frame": (snapshots.Snapshots, "write")}[where]
before, calls = getattr(room, name), []


def hit(*words):
    calls.append(before(*words))
    if len(calls) == call:
        os.kill(os.getpid(), which)


setattr(room, name, hit)
main()
"""


Struck = Callable[..., tuple[int, str, str]]


@pytest.fixture
def struck(folder: Path, forked: Forked) -> Struck:
    """A run that gets a signal while it writes ``where`` for so many times: always at the same event."""

    def run(where: str, call: int, which: signal.Signals, *words: str) -> tuple[int, str, str]:
        code = HIT.replace("SIGNAL", repr((where, call, int(which)))).replace("WORDS", repr(words))
        return forked(folder, "-c", code)

    return run


# --- what it says --------------------------------------------------------------------------------------------------


def test_json_has_the_keys_and_is_the_librarys_answer(folder):
    found = json.loads(run("rough.toml", "--json"))
    assert [key for key in found if key in KEYS] == KEYS
    session = Session(load_gas(folder / "rough.toml"))
    session.run()
    result = session.result
    for key in KEYS:
        if key != "cpu_seconds":
            assert found[key] == getattr(result, key), key
    assert found["pair_collisions"] == 60_000 == found["events"]
    assert found["wall_collisions"] == 0
    assert found["mean_free_time"] == pytest.approx(200 * found["simulated_time"] / 120_000, rel=1e-12)
    assert abs(found["energy_drift"]) < 1e-12
    # conserving: both temperatures end where the energy is shared
    assert found["temperature_translational"] == pytest.approx(0.75, rel=0.02)
    assert found["temperature_rotational"] == pytest.approx(0.75, rel=0.02)
    # what Gas.run of the same gas says, by another way through the same events
    from carom.gas.session import build

    gas = build(load_gas(folder / "rough.toml"))
    gas.run(5000)
    other = gas.run(60_000)
    assert (other.pressure, other.simulated_time) == (result.pressure, result.simulated_time)


def test_what_is_not_known_is_null(folder):
    found = answer("mixed.toml")
    assert found["diffusion"] is None  # a box with walls
    assert set(found["species"]) == {"big", "small"}
    pairs = {tuple(row["between"]): row for row in found["channels"]}
    assert set(pairs) == {
        ("big", "big"), ("big", "small"), ("small", "small"),
        ("big", "bottom"), ("small", "bottom"), ("big", "top"), ("small", "top"),
    }  # fmt: skip
    assert sum(row["collisions"] for row in pairs.values()) == found["events"]
    assert (
        sum(row["collisions"] for name, row in pairs.items() if name[1] in ("bottom", "top"))
        == found["wall_collisions"]
    )
    lost = sum(row["lost_normal"] + row["lost_tangential"] for row in found["channels"])
    assert lost == pytest.approx(found["energy_start"] - found["energy_end"], rel=1e-10)
    assert pairs["small", "small"]["to_spin"] == 0
    assert pairs["big", "big"]["lost_tangential"] > 0
    assert found["simulated_time"] == pytest.approx(20, abs=1e-12)


def test_the_same_input_gives_the_same_answer_and_options_count(folder):
    one = answer("rough.toml")
    assert answer("rough.toml") == one
    assert answer("rough.toml", "--seed", "2") != one
    assert answer("rough.toml", "--max-events", "1000")["events"] == 1000
    assert answer("mixed.toml", "--duration", "2.5")["simulated_time"] == pytest.approx(2.5, abs=1e-12)


def test_the_table(folder):
    text = run("mixed.toml")
    assert "Gas: 160 discs of 2 species, a box 20 x 16, periodic along x, packing fraction" in text
    for words in (
        "wall collisions",
        "mean free time",
        "rotational /",
        "big – small",
        "small – top",
        "(tangential)",
    ):
        assert words in text
    assert "energy drift" not in text  # it is no drift, friction takes it
    assert run("rough.toml", "--quiet") == ""
    assert "relative energy drift" in run("rough.toml")


def test_files_are_written(folder):
    done = runner.invoke(app, ["gas", "rough.toml", "--measures", "m.json", "--plot", "g.svg", "--checkpoint", "c.npz"])
    assert done.exit_code == 0
    assert "written: g.svg" in done.stderr
    assert "checkpoint written: c.npz" in done.stderr
    found = json.loads((folder / "m.json").read_text())
    assert set(KEYS) < set(found)
    assert len(found["series"]["time"]) == found["samples"] >= 45
    assert len(found["pair_correlation"][0]["g"]) > 50
    assert sorted(path.name for path in folder.iterdir()) == [
        "c.npz", "g.svg", "long.toml", "m.json", "mixed.toml", "rough.toml",
    ]  # fmt: skip


def test_a_new_scene_checks_and_is_checked(folder):
    assert runner.invoke(app, ["scene", "new", "--gas", "new.toml"]).exit_code == 0
    done = runner.invoke(app, ["scene", "check", "new.toml"])
    assert done.stdout.startswith(
        "new.toml: 1,000 balls, periodic 12.6 x 12.6 x 12.6, packing fraction 0.2618, 1,000,000 events"
    )
    assert done.stdout.endswith(": ok\n")


# --- what is wrong -------------------------------------------------------------------------------------------------


def test_faults_are_lines_and_nothing_runs(folder, capsys, monkeypatch):
    (folder / "bad.toml").write_text(ROUGH.replace("count = 200", "count = 900"))
    (line,) = refusal(capsys, monkeypatch, "bad.toml", "--json")
    assert line.startswith("bad.toml: species: expected a packing fraction of at most 0.7405, the densest packing of")
    assert ", got 1.1220; use fewer or smaller balls" in line
    (folder / "x.csv").write_text("x,y,z\n" + "1,2,3\n" * 200)
    (folder / "bad.toml").write_text(ROUGH + 'start = "x.csv"')
    (line,) = refusal(capsys, monkeypatch, "bad.toml", "--quiet")
    assert line.startswith("bad.toml: run.start: expected balls that do not overlap, got balls 0 and 1, at [1. 2. 3.]")
    lines = refusal(
        capsys, monkeypatch, "none.toml", "--plot", "g.xyz", "--measures", "m.csv", "--snapshots", "no/s.gsd", "--every", "soon",
        "--checkpoint-every", "0 events",
    )  # fmt: skip
    assert [line.split(":")[0] for line in lines] == [
        "--plot g.xyz", "--measures m.csv", "--snapshots no/s.gsd", "--checkpoint-every", "none.toml", "--every",
    ]  # fmt: skip
    (line,) = refusal(capsys, monkeypatch)
    assert line == "SCENE.toml: expected a scene, got none; carom scene new --gas FILE writes one"
    (line,) = refusal(capsys, monkeypatch, "rough.toml", "--every", "5")
    assert line == "--every: expected --snapshots FILE as well, got none"
    (line,) = refusal(capsys, monkeypatch, "rough.toml", "--checkpoint-every", "5")
    assert line == "--checkpoint-every: expected --checkpoint FILE as well, got none"
    (line,) = refusal(capsys, monkeypatch, "rough.toml", "--max-events", "0")
    assert line == "--max-events: expected a whole number >= 1, got 0"


def test_a_restart_file_of_another_scene_is_refused(folder, capsys, monkeypatch):
    run("rough.toml", "--checkpoint", "c.npz")
    (line,) = refusal(capsys, monkeypatch, "mixed.toml", "--resume", "c.npz")
    assert line.startswith(
        "c.npz: expected a checkpoint of this scene, got one of another scene: its gravity is 0.0, not 0.2"
    )
    (line,) = refusal(capsys, monkeypatch, "rough.toml", "--resume", "rough.toml", "--quiet")
    assert (
        line
        == "rough.toml: expected an intact checkpoint of carom gas, got a file that cannot be read (not a file of NumPy)"
    )
    (line,) = refusal(capsys, monkeypatch, "rough.toml", "--resume", "none.npz", "--quiet")
    assert line.startswith("none.npz: expected a checkpoint, got: No such file or directory")


def test_a_gas_that_collapses_is_told(folder, capsys, monkeypatch):
    # inelastic, no contact_time: three balls clap together without end
    text = MIXED.replace("contact_time = 1e-6\n", "").replace("restitution = 0.99", "restitution = 0.0")
    text = text.replace("gravity = 0.2", "gravity = 5.0").replace("restitution = 1.0", "restitution = 0.0")
    (folder / "dead.toml").write_text(text.replace("duration = 20.0", "duration = 1000.0"))
    lines = refusal(capsys, monkeypatch, "dead.toml", "--quiet")
    (line,) = lines
    assert line.startswith(
        "Gas.run: contact_time: expected a finite number of collisions, got an inelastic collapse at t = "
    )
    assert "give a contact_time > 0" in line


# --- stopped, killed, resumed -------------------------------------------------------------------------------------


@pytest.mark.parametrize("which", [signal.SIGINT, signal.SIGTERM])
def test_a_signal_ends_it_with_a_checkpoint(folder, struck, which):
    keep = ("--checkpoint", "c.npz", "--checkpoint-every", "20000 events")
    code, out, err = struck("a checkpoint", 2, which, "long.toml", "--json", *keep)
    assert code == 128 + which
    assert out == ""
    last = err.splitlines()[-1]
    assert last.startswith("carom: stopped after ")
    assert last.endswith("resume with: carom gas long.toml --resume c.npz")
    assert answer("long.toml", "--resume", "c.npz") == whole_long_run()


def test_a_signal_while_the_gas_is_made_ends_the_command(folder, monkeypatch, capsys):
    """A dense start takes minutes; a note of the signal was kept until it was made."""

    def made(*_):
        signal.raise_signal(signal.SIGINT)
        for _ in range(100_000):  # (Python looks for signals where a loop goes back)
            pass

    monkeypatch.setattr("carom.gas.session.build", made)
    monkeypatch.setattr(sys, "argv", ["carom", "gas", "rough.toml"])
    with pytest.raises(SystemExit) as ended:
        main()
    assert ended.value.code == 128 + signal.SIGINT
    assert len(list(folder.iterdir())) == 3


def test_a_signal_without_a_checkpoint_asked_for_makes_one(folder, struck):
    code, _out, err = struck("a frame", 3, signal.SIGINT, "long.toml", "--snapshots", "s.gsd", "--every", "1000 events")
    assert code == 130
    again = "resume with: carom gas long.toml --resume long.checkpoint.npz --snapshots s.gsd --every '1000 events'"
    assert err.splitlines()[-1].endswith(again)
    assert answer("--resume", "long.checkpoint.npz") == whole_long_run()


# in the middle of its fourth checkpoint, and between two of them
@pytest.mark.parametrize(("where", "call"), [("a checkpoint", 4), ("a frame", 20)])
@pytest.mark.slow(keep=1)
def test_a_killed_run_goes_on_with_the_same_bits(folder, struck, where, call):
    import gsd.hoomd

    options = ("--snapshots", "s.gsd", "--every", "0.6")
    keep = ("--checkpoint", "c.npz", "--checkpoint-every", "5000 events")
    code, out, _err = struck(where, call, signal.SIGKILL, "long.toml", "--json", *keep, *options)
    assert code == -signal.SIGKILL
    assert out == ""
    kept = dict(np.load(folder / "c.npz"))
    assert 0 < kept["gas.system"]["pair_collisions"][0] < 205_000
    resumed = answer("long.toml", "--resume", "c.npz", *options)
    whole = answer("long.toml", "--snapshots", "w.gsd", "--every", "0.6")
    assert resumed == whole
    with gsd.hoomd.open(str(folder / "s.gsd")) as one, gsd.hoomd.open(str(folder / "w.gsd")) as two:
        assert len(one) == len(two) > 50
        for a, b in zip(one, two, strict=True):
            assert a.configuration.step == b.configuration.step
            assert a.particles.position.tobytes() == b.particles.position.tobytes()
            assert a.particles.angmom.tobytes() == b.particles.angmom.tobytes()
    # the finished run's checkpoint goes on too, for longer
    more = answer("long.toml", "--resume", "c.npz", "--max-events", "220000")
    again = answer("long.toml", "--max-events", "220000")
    for key in ("pressure", "simulated_time", "energy_drift", "temperature_rotational", "channels"):
        assert more[key] == again[key]


def test_a_full_disk_does_not_end_the_run(folder, monkeypatch):
    from carom.gas import files as checkpoint

    tries = []

    def full(handle):
        tries.append(handle)
        if len(tries) < 4:
            raise OSError(28, "No space left on device")

    monkeypatch.setattr(checkpoint.os, "fsync", full)
    done = runner.invoke(
        app, ["gas", "rough.toml", "--json", "--checkpoint", "c.npz", "--checkpoint-every", "1000 events"]
    )
    assert done.exit_code == 0
    full = "expected room to write, got: No space left on device; free some space, or choose another place"
    said = f"carom: c.npz: {full}; the previous checkpoint stays, and the run continues"
    assert done.stderr.splitlines().count(said) == 3
    assert (folder / "c.npz").exists()


def test_the_checkpoint_that_is_written_at_the_end_is_named(folder):
    """A run resumed without --checkpoint replaced the file it came from without saying so."""
    run("rough.toml", "--checkpoint", "c.npz", "--max-events", "20000", "--quiet")
    before = (folder / "c.npz").read_bytes()
    done = runner.invoke(app, ["gas", "rough.toml", "--resume", "c.npz", "--json"])
    assert done.stderr.splitlines()[-1] == "checkpoint written: c.npz"
    assert (folder / "c.npz").read_bytes() != before
    done = runner.invoke(
        app, ["gas", "rough.toml", "--resume", "c.npz", "--checkpoint", "d.npz", "--measures", "m.json"]
    )
    assert done.stderr.splitlines()[-2:] == ["checkpoint written: d.npz", "written: m.json"]
    shown = runner.invoke(app, ["gas", "--help"], env={"COLUMNS": "200"}).stdout
    assert "Without --checkpoint the state of the run is saved to FILE too" in shown


def test_files_that_a_resumed_run_does_not_name_again_are_said(folder):
    """A run resumed without --snapshots wrote none, and said nothing."""
    import gsd.hoomd

    first = ("--max-events", "2000", "--checkpoint", "c.npz", "--snapshots", "s.gsd", "--every", "200 events")
    run("rough.toml", *first, "--measures", "m.json", "--quiet")
    silent = runner.invoke(
        app, ["gas", "rough.toml", "--resume", "c.npz", "--checkpoint", "d.npz", "--max-events", "3000"]
    )
    said = (
        "this run wrote s.gsd, m.json; repeat --snapshots s.gsd --measures m.json --every '200 events' to continue it"
    )
    assert said in silent.stderr.splitlines()
    more = [
        "gas",
        "rough.toml",
        "--resume",
        "c.npz",
        "--max-events",
        "3000",
        "--snapshots",
        "s.gsd",
        "--measures",
        "m.json",
    ]
    done = runner.invoke(app, more)
    assert done.exit_code == 0
    assert "this run wrote" not in done.stderr
    with gsd.hoomd.open(str(folder / "s.gsd")) as frames:
        steps = [frame.configuration.step for frame in frames]
    assert np.diff(steps).tolist() == [200] * 15


def test_progress_goes_to_standard_error(folder, forked):
    _code, out, err = forked(folder, "gas", "rough.toml", "--json")
    assert set(KEYS) < set(json.loads(out))
    assert "equilibrating: 200 balls" in err
    assert "measuring: 200 balls" in err


def test_tables_of_gases_have_units(folder: Path) -> None:
    """Times, pressures, temperatures and energies had none."""
    out = runner.invoke(app, ["gas", "rough.toml"], catch_exceptions=False, env={"COLUMNS": "120"}).stdout
    for label in (
        "simulated time, s",
        "mean free time, s",
        "pressure, Pa",
        "translational temperature, J",
        "rotational temperature, J",
    ):
        assert any(line.strip().startswith(label) for line in out.splitlines()), label
    heads = " ".join(out.split())
    assert "species balls velocity spin" in heads  # (one species' temperatures are those of the gas)
    assert "1/s (normal), J (tangential), J to spin, J" in heads
    assert "Units of the scene" in heads
    out = runner.invoke(
        app, ["gas", "rough.toml", "--ensemble", "2"], catch_exceptions=False, env={"COLUMNS": "120"}
    ).stdout
    assert "pressure, Pa" in out
    assert "energy at the start, J" in out
    out = runner.invoke(app, ["gas", "mixed.toml"], catch_exceptions=False, env={"COLUMNS": "120"}).stdout
    assert "temperature, J temperature, J translational" in " ".join(out.split())


COOLING = ROUGH.replace("restitution = 1.0\n", "restitution = 0.9\n").replace("equilibrate = 5_000", "equilibrate = 0")
SMOOTH = COOLING.replace("friction = inf\n", "friction = 0.0\n").replace("60_000", "20_000")


def test_a_smooth_gas_reports_nothing_of_spins_that_nothing_changes(folder):
    (folder / "smooth.toml").write_text(SMOOTH)
    for words in (("smooth.toml",), ("smooth.toml", "--ensemble", "2")):
        text = run(*words)
        assert "translational temperature at the end, J" in text  # (it cools)
        assert "rotational" not in text
        assert "a₂ of" in text
        assert "spin " not in text.split("contact")[0]
        assert re.search(r"of it in spins, which nothing changes, J +150 \n", text)  # 200 balls, 3/2 of 0.5 J
    found = answer("smooth.toml")
    assert found["temperature_rotational"] == pytest.approx(0.5)
    assert found["temperature_ratio"] is None
    assert found["species"]["a"]["temperature_ratio"] is found["species"]["a"]["a2_rotational"] is None
    run("smooth.toml", "--plot", "smooth.svg")
    assert "smooth: no spin changes" in (folder / "smooth.svg").read_text()
    rough = run("rough.toml")
    assert "rotational temperature" in rough
    assert "of the first, 1/s" in rough  # whose balls the rates are of


def test_the_energy_balance_and_the_pressures_on_walls_are_in_table_and_json(folder):
    (folder / "cooling.toml").write_text(COOLING.replace("60_000", "20_000"))
    found = answer("cooling.toml")
    assert found["energy_drift"] < -0.1  # what was dissipated
    assert abs(found["energy_imbalance"]) < 1e-12
    assert (
        f"relative imbalance {found['energy_imbalance']:.1e}".split()
        == re.search(r"relative imbalance +\S+", run("cooling.toml"))[0].split()
    )
    pressures = answer("mixed.toml")["wall_pressure"]
    text = run("mixed.toml")
    for wall in ("bottom", "top"):
        shown = re.search(rf"  on {wall}, N/m +(\S+)", text)
        assert float(shown[1]) == pytest.approx(pressures[wall], rel=1e-4)


def test_why_there_is_no_diffusion_coefficient(folder):
    (folder / "cooling.toml").write_text(COOLING.replace("60_000", "20_000"))
    why = "Diffusion coefficient: none, since the temperature changed by more than a factor of two."
    for words in (("cooling.toml",), ("cooling.toml", "--ensemble", "2")):
        assert run(*words).splitlines().count(why) == 1
    assert "Diffusion coefficient: none, since there are too few samples." in run("rough.toml", "--max-events", "2")
    for words in (("rough.toml",), ("mixed.toml",)):
        assert "Diffusion coefficient: none" not in run(*words)


def test_series_of_each_species(folder):
    run("mixed.toml", "--measures", "m.json")
    found = json.loads((folder / "m.json").read_text())
    whole, kinds = found["series"], found["species_series"]
    assert set(kinds) == {"big", "small"}
    for part in ("translational", "rotational"):
        mean = (60 * np.array(kinds["big"][part]) + 100 * np.array(kinds["small"][part])) / 160
        assert mean == pytest.approx(np.array(whole[part]), rel=1e-12)
