"""carom gas: files that cannot be written are found before the run, and what goes wrong later does not take the result."""

from __future__ import annotations

import json
import os
import sys
from pathlib import Path

import pytest
from reference.gases import ROUGH
from typer.testing import CliRunner

from carom.cli import app, main

runner = CliRunner()
FULL = "expected room to write, got: No space left on device; free some space, or choose another place"


@pytest.fixture
def folder(tmp_path, monkeypatch) -> Path:
    (tmp_path / "rough.toml").write_text(ROUGH.replace("60_000", "2_000").replace("5_000", "500"))
    monkeypatch.chdir(tmp_path)
    return tmp_path


def refusal(capsys, monkeypatch, *words: str) -> tuple[str, list[str]]:
    monkeypatch.setattr(sys, "argv", ["carom", "gas", *words])
    with pytest.raises(SystemExit) as ended:
        main()
    out, err = capsys.readouterr()
    assert ended.value.code == 2
    return out, [line.removeprefix("carom: ") for line in err.splitlines() if line.startswith("carom: ")]


@pytest.fixture
def locked(folder, monkeypatch) -> Path:
    """A folder that looks as if one could write there, and is full (nobody but a superuser sees such folders by their leave)."""
    (folder / "locked").mkdir()
    real = os.open

    def opened(path, flags, *rest, **more):
        if flags & os.O_CREAT and "locked" in Path(os.fsdecode(path)).parts:
            raise OSError(28, "No space left on device")
        return real(path, flags, *rest, **more)

    monkeypatch.setattr(os, "open", opened)
    return folder / "locked"


def test_every_place_is_tried_before_the_run(locked, folder, capsys, monkeypatch):
    out, lines = refusal(
        capsys, monkeypatch, "rough.toml", "--plot", "locked/g.svg", "--measures", "locked/m.json",
        "--snapshots", "locked/s.gsd", "--checkpoint", "locked/c.npz",
    )  # fmt: skip
    assert out == ""
    assert lines == [
        f"--plot locked/g.svg: {FULL}",
        f"--measures locked/m.json: {FULL}",
        f"--snapshots locked/s.gsd: {FULL}",
        f"--checkpoint locked/c.npz: {FULL}",
    ]
    assert list(locked.iterdir()) == []


def test_the_checkpoint_gone_on_from_has_to_have_a_place_too(folder, capsys, monkeypatch):
    (folder / "there").mkdir()
    assert runner.invoke(app, ["gas", "rough.toml", "--quiet", "--checkpoint", "there/c.npz"]).exit_code == 0
    real = os.open

    def opened(path, flags, *rest, **more):
        if flags & os.O_CREAT and "there" in Path(os.fsdecode(path)).parts:
            raise OSError(30, "Read-only file system")
        return real(path, flags, *rest, **more)

    monkeypatch.setattr(os, "open", opened)
    _out, lines = refusal(capsys, monkeypatch, "rough.toml", "--resume", "there/c.npz")
    assert lines == [
        "--resume there/c.npz: expected permission to write there, got: Read-only file system; choose another place"
    ]


def test_snapshots_that_are_there_are_not_written_over(folder, capsys, monkeypatch):
    words = ["gas", "rough.toml", "--quiet", "--snapshots", "s.gsd", "--every", "500 events", "--checkpoint", "c.npz"]
    assert runner.invoke(app, words).exit_code == 0
    before = (folder / "s.gsd").read_bytes()
    _out, lines = refusal(capsys, monkeypatch, *words[1:])
    assert lines == ["--snapshots s.gsd: expected a new file, got an existing one; --force overwrites it"]
    assert (folder / "s.gsd").read_bytes() == before
    assert runner.invoke(app, [*words, "--force"]).exit_code == 0
    assert len((folder / "s.gsd").read_bytes()) == len(before)
    # a run that goes on goes on with its own
    assert runner.invoke(app, [*words, "--resume", "c.npz"]).exit_code == 0


def test_a_checkpoint_does_not_take_the_place_of_another_file(folder, capsys, monkeypatch):
    before = (folder / "rough.toml").read_bytes()
    _out, lines = refusal(capsys, monkeypatch, "rough.toml", "--checkpoint", "rough.toml")
    assert lines == [
        "--checkpoint rough.toml: expected a checkpoint or a new file, got an existing file of another kind; choose a new name"
    ]
    assert (folder / "rough.toml").read_bytes() == before


def test_what_was_measured_is_told_even_if_its_files_fail(folder, capsys, monkeypatch):
    # the disk fills up while the run goes on
    from carom import plot
    from carom.gas import files as checkpoint

    def full(*_args):
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(checkpoint.os, "fsync", full)
    monkeypatch.setattr(plot, "plot_gas", _cannot)
    out, lines = refusal(
        capsys, monkeypatch, "rough.toml", "--json", "--checkpoint", "c.npz", "--plot", "g.svg", "--measures", "m.json"
    )
    assert json.loads(out)["pair_collisions"] == 2000
    assert lines == [
        f"c.npz: {FULL}",
        f"g.svg: {FULL}",
    ]
    assert json.loads((folder / "m.json").read_text())["pair_collisions"] == 2000
    assert not (folder / "c.npz").exists()


def _cannot(_session, path):
    from carom.errors import CaromError

    raise CaromError(f"{path}: {FULL}")
