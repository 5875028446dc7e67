"""The ``carom`` command: one module for each subcommand, or for a few related ones."""

from __future__ import annotations

import functools
import importlib
import os
import sys
from typing import Annotated, Any

import typer
from typer.core import TyperGroup

from carom.cli.interrupts import noticed_interrupts, say_interrupted
from carom.errors import CaromError
from carom.public.interrupts import INTERRUPTED


class Verbs(TyperGroup):
    """The verbs, of which some are two words: ``fit gas``, unless the second is a file."""

    def resolve_command(self, ctx: Any, args: list[str]) -> Any:
        """Return the command that the first words name, and the rest of the arguments."""
        if (two := " ".join(args[:2])) in self.commands and len(args) > 1 and not os.path.exists(args[1]):
            args = [two, *args[2:]]
        return super().resolve_command(ctx, args)


app = typer.Typer(
    name="carom",
    cls=Verbs,
    no_args_is_help=True,
    pretty_exceptions_enable=False,
)

# Each module has a function `register(app)`, and imports heavy libraries inside its commands.
# fmt: off
MODULES: tuple[str, ...] = (
    "compare", "catalog", "paper", "predict", "scene", "simulate", "aim", "explore", "gas", "orbit", "sweep", "tracks", "fit",
    "fit_gas", "design", "judge", "doctor", "warm",
)
# fmt: on

for module in MODULES:
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
    from carom.cli.help import prepare_help
    from carom.cli.option_names import remember_verbs
    from carom.cli.usage import require_values

    return require_values(remember_verbs(prepare_help(typer.main.get_command(app))))


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
        from carom.cli.usage import help_of, usage_fault

        if type(error).__name__ == "NoArgsIsHelpError":
            sys.stderr.write(f"{error}\n")
        else:
            _print_errors(f"{usage_fault(error)} ({help_of(error)})")
    return 2


def _interrupted() -> int:
    say_interrupted()
    return INTERRUPTED


def _report(error: CaromError) -> int:
    from carom.cli.option_names import as_option
    from carom.cli.streams import say_notes

    _print_errors(*(str(as_option(fault)) for fault in error.records))
    say_notes(getattr(error, "__notes__", ()))
    return 2


def _print_errors(*faults: str) -> None:
    from carom.cli.option_names import in_options
    from carom.formatting import escape_controls

    colour = sys.stderr.isatty() and "NO_COLOR" not in os.environ
    for fault in faults:
        line = escape_controls(in_options(" ".join(fault.split())))
        sys.stderr.write(f"\033[1;31mcarom:\033[0m {line}\n" if colour else f"carom: {line}\n")
