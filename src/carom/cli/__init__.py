"""The ``carom`` command: one module a verb."""

from __future__ import annotations

import importlib
import os
import sys
from typing import Annotated

import typer

from carom.errors import CaromError

app = typer.Typer(
    name="carom",
    help="A ball meets a wall: what does it do next, and which law of impact is right?",
    no_args_is_help=True,
    add_completion=False,
    pretty_exceptions_enable=False,
)

# One module a verb; each has a function `register(app)` and imports what is heavy inside its command.
# fmt: off
VERBS: tuple[str, ...] = (
    "compare", "laws", "figures", "derive", "predict", "datasets", "scene", "simulate",
    "gas", "orbit", "tracks", "fit", "design",
)
# fmt: on

for verb in VERBS:
    importlib.import_module(f"carom.cli.{verb}").register(app)


def _version(wanted: bool) -> None:
    if wanted:
        from carom import __version__

        sys.stdout.write(f"carom {__version__}\n")
        raise typer.Exit


@app.callback()
def root(
    version: Annotated[
        bool, typer.Option("--version", callback=_version, is_eager=True, help="Print the version.")
    ] = False,
) -> None:
    """A ball meets a wall: what does it do next, and which law of impact is right?"""


def main() -> None:
    """Run the command; a fault is one line on standard error and exit code 2."""
    try:
        sys.exit(app(standalone_mode=False) or 0)
    except CaromError as error:
        _tell(*error.faults)
        for note in getattr(error, "__notes__", ()):
            sys.stderr.write(f"note: {note}\n")
    except Exception as error:  # usage errors: Typer's own class has no public name in all its versions
        if not hasattr(error, "format_message"):
            raise
        if type(error).__name__ == "NoArgsIsHelpError":
            sys.stderr.write(f"{error}\n")
        else:
            _tell(f"{error.format_message()} (carom --help)")
    sys.exit(2)


def _tell(*faults: str) -> None:
    colour = sys.stderr.isatty() and "NO_COLOR" not in os.environ
    for fault in faults:
        line = " ".join(fault.split())
        sys.stderr.write(f"\033[1;31mcarom:\033[0m {line}\n" if colour else f"carom: {line}\n")
