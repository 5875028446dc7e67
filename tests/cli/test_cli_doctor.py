"""``carom doctor``, ``--version``, completion, and help without types of flags."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from reference.commands import command

import carom
from carom.files import install_command


def test_doctor_says_what_is_there(
    carom_command: Any, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    done = carom_command("doctor", "--json")
    assert done.returncode == 0, done.stderr
    found = json.loads(done.stdout)
    assert found["carom"] == carom.__version__
    assert found["libraries"]["numpy"] == np.__version__
    assert found["optional"]["scipy"]["extra"] == "fit"
    assert found["cores"] >= found["threads"] >= 1
    assert Path(found["cache"]["folder"]).name
    assert found["cache"]["versions"] >= 1
    assert found["cache"]["all_megabytes"] >= found["cache"]["megabytes"]
    monkeypatch.setenv("COLUMNS", "60")
    code, table, _err = command(capsys, "doctor")
    assert code == 0
    assert "numba" in table
    missing = any(about["version"] is None for about in found["optional"].values())
    assert (install_command("plot") in table) == missing  # whole, to be copied, however narrow the terminal


def test_version(carom_command: Any) -> None:
    assert carom_command("--version").stdout.startswith(f"carom {carom.__version__}")


def test_flags_have_no_type_in_help(carom_command: Any) -> None:
    shown = carom_command("simulate", "--help", COLUMNS="100").stdout
    (line,) = (line for line in shown.splitlines() if "--quiet" in line)
    assert "bool" not in line


def test_completion_can_be_shown(carom_command: Any) -> None:
    done = carom_command("--show-completion", "bash", _TYPER_COMPLETE_TEST_DISABLE_SHELL_DETECTION="1")
    assert done.returncode == 0
    assert "complete" in done.stdout
