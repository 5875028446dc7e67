"""Every script of benchmarks runs, as small as it goes, and a row is printed as it is read."""

import importlib
import sys
from pathlib import Path

import pytest

FOLDER = Path(__file__).parents[1] / "benchmarks"
SCRIPTS = sorted(path.stem for path in FOLDER.glob("*.py") if path.stem not in ("rows", "peers", "gas_dynamo"))
pytestmark = pytest.mark.skipif(not FOLDER.exists(), reason="the benchmarks are not installed")


@pytest.fixture
def small(monkeypatch):
    """Import a script as ``rows.py --small`` has it."""
    monkeypatch.setenv("CAROM_BENCHMARK_SMALL", "1")
    monkeypatch.delenv("CAROM_BENCHMARK_CPU", raising=False)
    monkeypatch.syspath_prepend(FOLDER)
    monkeypatch.setattr(sys, "argv", ["script"])
    for name in (*SCRIPTS, "rows", "peers", "gas_dynamo"):
        monkeypatch.delitem(sys.modules, name, raising=False)
    yield importlib.import_module
    for name in (*SCRIPTS, "rows", "peers", "gas_dynamo"):
        sys.modules.pop(name, None)


@pytest.mark.parametrize("name", SCRIPTS)
@pytest.mark.slow
def test_it_runs(small, name, capsys, monkeypatch):
    monkeypatch.setitem(sys.modules, "playwright.sync_api", None)  # (a browser takes longer than all others together)
    script = small(name)
    small("rows").run_script(script.main)
    said = capsys.readouterr().out.strip().splitlines()
    assert said
    if name.startswith("explorer"):  # what is not installed takes a line
        assert len(said) == 1
        assert said[0].startswith("not measured: ")
