"""The ``carom`` command: one module for each subcommand, or for a few related ones."""

from __future__ import annotations

import functools
import importlib
import os
import sys
from typing import Any

import typer

from carom.cli.streams import noticed_interrupts, say_interrupted
from carom.cli.verbs import App, help_of, usage_fault
from carom.errors import CaromError
from carom.public.interrupts import INTERRUPTED

# The verbs by heading of the help: each a function of a module, which imports heavy libraries when it is called.
# fmt: off
VERBS: dict[str, dict[str, str]] = {
    "Laws": {"compare": "compare:compare", "laws": "catalog:laws"},
    "Shots": {
        "simulate": "simulate:simulate", "aim": "shots:aim", "explore": "shots:explore", "scene new": "shots:new",
        "scene check": "shots:check", "sweep new": "sweep:new", "sweep explain": "sweep:explain", "sweep run": "sweep:run",
        "sweep status": "sweep:status", "sweep verify": "sweep:verify", "sweep plot": "sweep:plot",
    },
    "Billiards": {"orbit": "orbit:orbit"},
    "Gases": {"gas": "gas:gas"},
    "Measurements": {
        "track": "tracks:track", "tracks show": "tracks:show", "tracks example": "tracks:example", "fit": "fit:fit",
        "fit gas": "fit:fit_gas",
        "fit air": "fit:fit_air", "datasets": "catalog:datasets", "predict": "predict:predict", "design": "fit:design",
        "judge": "judge:judge",
    },
    "Installation": {"doctor": "doctor:doctor"},
    "The paper": {"derive": "paper:derive", "figures": "paper:figures"},
}
GROUPS = {
    "scene": "Write a first scene file, or validate one.",
    "sweep": "Compute maps over parameters of a scene, an impact, an orbit or a gas.",
    "tracks": "Tracks of filmed balls: summarise a file or a film, and measure its rebounds.",
}
# fmt: on
FIRST = {name.partition(" ")[0] for verbs in VERBS.values() for name in verbs}


def app_of(first: str | None) -> App:
    """Return the command with the verbs that begin with this word; all of them for None."""
    app, groups = App(name="carom", add_completion=first is None), {}
    app.callback()(root)
    for panel, verbs in VERBS.items():
        for name, place in verbs.items():
            group, _, inner = name.partition(" ")
            if first not in (None, group):
                continue
            module, _, function = place.partition(":")
            verb = getattr(importlib.import_module(f"carom.cli.{module}"), function)
            if group not in GROUPS:
                app.command(name, rich_help_panel=panel)(verb)
                continue
            if group not in groups:
                groups[group] = App(help=GROUPS[group])
                app.add_typer(groups[group], name=group, rich_help_panel=panel)
            groups[group].command(inner)(verb)
    return app


def root() -> None:
    """Balls that meet walls: impact laws, trajectories, billiards, gases, and laws fitted to measurements."""


def __getattr__(name: str) -> App:
    """Return the command with all its verbs, ``app``, when it is asked for."""
    if name != "app":
        raise AttributeError(name)
    found: App = globals().setdefault(name, app_of(None))
    return found


@functools.cache
def _command(first: str | None) -> Any:
    """Return the command, which takes longer to make than most verbs to run (a process may run several)."""
    found: Any = typer.main.get_command(app_of(first))
    found.whole = functools.partial(_command, None)
    return found


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


def _run(asked: list[bool]) -> int:
    try:
        words = sys.argv[1:]
        if words == ["--version"]:
            return _version()
        first = words[0] if words and "_CAROM_COMPLETE" not in os.environ else None
        code = int(_command(first if first in FIRST else None)(prog_name="carom", standalone_mode=False) or 0)
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


def _version() -> int:
    from carom import __version__
    from carom.cli.doctor import commit

    found = commit()
    sys.stdout.write(f"carom {__version__}{f' (commit {found})' if found else ''}\n")
    return 0


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
