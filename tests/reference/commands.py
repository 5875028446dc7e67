"""What several tests do: the command line in this process, and the scripts of the docs as modules."""

from __future__ import annotations

import importlib.util
import sys
from pathlib import Path
from types import ModuleType

import pytest

from carom.cli import main


def command(capsys: pytest.CaptureFixture[str], *words: str) -> tuple[int, str, str]:
    """Run ``carom`` with these words: how it ends, and what it says on standard output and standard error."""
    before = sys.argv
    sys.argv = ["carom", *words]
    try:
        with pytest.raises(SystemExit) as end:
            main()
    finally:
        sys.argv = before
    told = capsys.readouterr()
    return int(end.value.code or 0), told.out, told.err


def fails(capsys: pytest.CaptureFixture[str], *words: str) -> list[str]:
    """Run it; it must end with code 2 and say nothing but lines on standard error."""
    code, out, err = command(capsys, *words)
    assert code == 2
    assert out == ""
    return err.splitlines()


def script(name: str) -> ModuleType:
    """A script that stands beside the pages of the docs, or in docs/dev."""
    docs = Path(__file__).parents[2] / "docs"
    file = next(folder / f"{name}.py" for folder in (docs, docs / "dev") if (folder / f"{name}.py").exists())
    spec = importlib.util.spec_from_file_location(name, file)
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    sys.modules[name] = module
    spec.loader.exec_module(module)
    return module
