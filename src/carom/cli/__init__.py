"""The ``carom`` command: one module for each subcommand, or for a few related ones."""

from __future__ import annotations

import functools
import importlib
import os
import sys
from typing import Annotated, Any

import typer

from carom.cli.streams import noticed_interrupts, say_interrupted
from carom.cli.verbs import App, help_of, usage_fault
from carom.errors import CaromError
from carom.public.interrupts import INTERRUPTED

app = App(name="carom")

# Each module has a function `register(app)`, and imports heavy libraries inside its commands; by heading of the help.
# fmt: off
MODULES: dict[str, tuple[str, ...]] = {
    "Laws": ("compare", "catalog"),
    "Shots": ("scene", "simulate", "aim", "explore", "sweep"),
    "Billiards": ("orbit",),
    "Gases": ("gas",),
    "Measurements": ("tracks", "fit", "fit_gas", "predict", "design", "judge"),
    "Installation": ("doctor",),
    "The paper": ("paper",),
}
# fmt: on

for app.panel, modules in MODULES.items():
    for module in modules:
        importlib.import_module(f"carom.cli.{module}").register(app)


def _version(wanted: bool) -> None:
    if wanted:
        from carom import __version__
        from carom.cli.doctor import commit

        found = commit()
        sys.stdout.write(f"carom {__version__}{f' (commit {found})' if found else ''}\n")
        raise typer.Exit


@app.callback()
def root(
    version: Annotated[
        bool, typer.Option("--version", callback=_version, is_eager=True, help="Print the version.")
    ] = False,
) -> None:
    """Balls that meet walls: impact laws, trajectories, billiards, gases, and laws fitted to measurements."""


def main() -> None:
    """Run the command; each problem is one line on standard error, and the exit code is 2."""
    try:  # (outside: Ctrl-C may come while its handler is being set)
        with noticed_interrupts() as asked:
            code = _guarded(asked)
    except KeyboardInterrupt:
        code = _interrupted()
    # (after an interrupt in a text that is executed, of a namedtuple, python -m ends by the signal itself; another text helps)
    exec("pass")
    sys.exit(code)


def _guarded(asked: list[bool]) -> int:
    from carom.cli.streams import guarded_streams

    with guarded_streams():
        code = _run(asked)
        try:
            sys.stdout.flush()
        except CaromError as error:
            code = _report(error)
        sys.stderr.flush()
    return code


@functools.cache
def _command() -> Any:
    """Return the whole command, which takes longer to make than most verbs to run (a process may run several)."""
    return typer.main.get_command(app)


def _run(asked: list[bool]) -> int:
    try:
        code = int(_command()(standalone_mode=False) or 0)
        return _interrupted() if asked and code == INTERRUPTED else code  # (some versions of Typer end by themselves)
    except CaromError as error:
        return _interrupted() if asked else _report(error)
    except KeyboardInterrupt:
        return _interrupted()
    except Exception as error:  # usage errors: Typer's own classes have no public name in all its versions
        # (Typer aborts there, as at Ctrl-C; a file of the program that ends early is a fault)
        if isinstance(error.__cause__, EOFError):
            raise error.__cause__ from None
        # (what Typer makes of Ctrl-C, and what becomes of an import in the middle of which it comes)
        if type(error).__name__ == "Abort" or asked:
            return _interrupted()
        if not hasattr(error, "format_message"):
            raise
        if type(error).__name__ == "NoArgsIsHelpError":
            sys.stderr.write(f"{error}\n")
        else:
            _print_errors(f"{usage_fault(error)} ({help_of(error)})")
    return 2


def _interrupted() -> int:
    say_interrupted()
    return INTERRUPTED


def _report(error: CaromError) -> int:
    from carom.cli.streams import say_notes
    from carom.cli.verbs import as_option

    _print_errors(*(str(as_option(fault)) for fault in error.records))
    say_notes(getattr(error, "__notes__", ()))
    return 2


def _print_errors(*faults: str) -> None:
    from carom.cli.verbs import in_options
    from carom.formatting import escape_controls

    colour = sys.stderr.isatty() and "NO_COLOR" not in os.environ
    for fault in faults:
        line = escape_controls(in_options(" ".join(fault.split())))
        sys.stderr.write(f"\033[1;31mcarom:\033[0m {line}\n" if colour else f"carom: {line}\n")
