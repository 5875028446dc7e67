"""Ctrl-C while the command starts: one line and exit code 130, whatever is being imported."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
from pathlib import Path

import pytest

import carom
from carom.cli.streams import noticed_interrupts, say_interrupted

BOX = """
gravity = 0
[[walls]]
shape = "box"
corner = [0, 0, 0]
size = [9, 9, 9]
inside = true
[[balls]]
radius = 0.1
mass = 1
position = [1, 1, 1]
velocity = [1, 0.3, 0.7]
[run]
law = "mirror"
max_events = 1_000_000_000
"""
SCRIPT = "#!{}\nimport re\nimport sys\nfrom carom.cli import main\nif __name__ == '__main__':\n    sys.exit(main())\n"


@pytest.mark.skipif(os.name != "posix", reason="needs signals")
@pytest.mark.parametrize("how", ["module", "script"])
@pytest.mark.parametrize("stage", ["carom", "typer.core", "carom.cli", "numpy", "pydantic"])
@pytest.mark.slow(keep=4)
def test_while_the_command_is_imported(tmp_path: Path, how: str, stage: str) -> None:
    """Python says, module by module, how long an import took; at one of them the signal comes."""
    (tmp_path / "box.toml").write_text(BOX)
    script = tmp_path / "carom"
    script.write_text(SCRIPT.format(sys.executable))
    start = ["-m", "carom"] if how == "module" else [str(script)]
    # (a shell that runs the tests in the background has told them to ignore SIGINT, and they pass that on)
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    environment = {**os.environ, "PYTHONPATH": str(Path(carom.__file__).parents[1])}
    with subprocess.Popen(
        [sys.executable, "-X", "importtime", *start, "simulate", "box.toml"],
        cwd=tmp_path, env=environment, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
    ) as process:  # fmt: skip
        try:
            assert process.stderr is not None
            for line in process.stderr:
                if line.rpartition("|")[2].strip() == stage:
                    break
            process.send_signal(signal.SIGINT)
            out, err = process.communicate(timeout=60)
        finally:
            process.kill()
            signal.signal(signal.SIGINT, before)
    said = [line for line in err.splitlines() if not line.startswith("import time:")]
    assert process.returncode == 130
    assert out == ""
    assert len(said) == 1
    assert said[0] in ("carom: interrupted", "carom: interrupted; nothing was written")


def ended_as_module(folder: Path, name: str) -> tuple[int, str, str]:
    """How ``python -m`` of a module in a folder ends: exit code, and what it wrote."""
    environment = {**os.environ, "PYTHONPATH": str(Path(carom.__file__).parents[1])}
    order = [sys.executable, "-m", name]
    done = subprocess.run(order, cwd=folder, capture_output=True, text=True, check=False, env=environment)
    return done.returncode, done.stdout, done.stderr


def test_the_exit_code_is_that_of_the_command(tmp_path: Path) -> None:
    """Where the interrupt comes while a text is executed (a namedtuple is made so), ``python -m`` killed itself at the end."""
    (tmp_path / "interrupted.py").write_text(
        "import signal, sys, carom.laws.registry\n"
        "signal.signal(signal.SIGINT, signal.default_int_handler)\n"
        "from carom.cli import main\n"
        "carom.laws.registry.card_named = lambda *words: exec('import signal; signal.raise_signal(signal.SIGINT)')\n"
        "sys.argv = ['carom', 'laws', 'maw']\n"
        "main()\n"
    )
    assert ended_as_module(tmp_path, "interrupted") == (130, "", "carom: interrupted\n")


def test_while_the_handler_is_set(tmp_path: Path) -> None:
    """Between the command's handler and the code that it protects, an interrupt ended the process by the signal itself."""
    (tmp_path / "early.py").write_text(
        "import signal, sys\n"
        "from carom.cli import main\n"
        "signal.signal(signal.SIGINT, signal.default_int_handler)\n"
        "change, left = signal.signal, [signal.SIGINT]\n"
        "def change_and_interrupt(which, handler):\n"
        "    before = change(which, handler)\n"
        "    if left:\n"
        "        signal.raise_signal(left.pop())\n"
        "    return before\n"
        "signal.signal = change_and_interrupt\n"
        "sys.argv = ['carom', 'laws', 'maw']\n"
        "main()\n"
    )
    assert ended_as_module(tmp_path, "early") == (130, "", "carom: interrupted\n")


def test_one_line_is_enough(capsys: pytest.CaptureFixture[str]) -> None:
    with noticed_interrupts():
        say_interrupted("carom: interrupted; nothing was written\n")
        say_interrupted()
    with noticed_interrupts():
        say_interrupted()
    assert capsys.readouterr().err == "carom: interrupted; nothing was written\ncarom: interrupted\n"


def test_what_python_swallows_comes_again() -> None:
    """An interrupt that arrives while an object is finalised is raised a moment later; a program of a user's own is left alone."""
    before = signal.getsignal(signal.SIGINT)

    class Finalised:
        def __del__(self) -> None:
            signal.raise_signal(signal.SIGINT)

    with noticed_interrupts(always=True) as asked:
        with pytest.raises(KeyboardInterrupt):  # noqa: PT012
            Finalised()
            for _ in range(10**9):
                pass
        assert asked
    assert signal.getsignal(signal.SIGINT) is before
