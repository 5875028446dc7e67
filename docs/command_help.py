"""The help of every command as Markdown: python docs/command_help.py."""

from __future__ import annotations

import io
from contextlib import redirect_stdout, suppress

import typer

from carom.cli import app

COMMAND = typer.main.get_command(app)


def told(*words: str) -> str:
    """Return the help of a command, in a block of Markdown."""
    with redirect_stdout(io.StringIO()) as said, suppress(SystemExit):
        COMMAND([*words, "--help"], prog_name="carom")
    lines = [line.rstrip() for line in said.getvalue().strip("\n").splitlines()]
    return "\n".join(["```text", *lines, "```"])


if __name__ == "__main__":
    verbs = [
        words
        for name, verb in COMMAND.commands.items()
        for words in [(name, sub) for sub in getattr(verb, "commands", {})] or [(name,)]
    ]
    print(told(), *(f"## carom {' '.join(words)}\n\n{told(*words)}" for words in verbs), sep="\n\n")
