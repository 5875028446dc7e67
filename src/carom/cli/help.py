"""The help of every command: flags without a type, defaults in one pair of brackets, plain where panels would cut names."""

from __future__ import annotations

import contextlib
import functools
import inspect
import io
import re
import shutil
import textwrap
from typing import Any

__all__ = ["prepare_help"]

INDENT = 4


def prepare_help(command: Any) -> Any:
    """Return a command, with all below it, whose flags (--help among them) have no type and whose help cuts no name.

    Defaults that are texts stand in one pair of brackets; Typer writes two.
    """
    for option in command.get_params(command.context_class(command)):
        if getattr(option, "is_flag", False) and option.metavar is None:
            option.metavar = ""
        if hasattr(option, "display_type_rich"):
            option.display_type_rich = functools.partial(_of_one, option.display_type_rich)
        if isinstance(getattr(option, "show_default", None), str) and hasattr(option, "_get_default_string"):
            option._get_default_string = functools.partial(_default_text, option.show_default)
    command.format_help = functools.partial(_format_help, command, command.format_help)
    for inner in getattr(command, "commands", {}).values():
        prepare_help(inner)
    return command


def _of_one(display_type: Any, **context: Any) -> str | None:
    """Return the type of one value where an option may be repeated: <str>, not <list[str]>."""
    text = display_type(**context)
    return text and re.sub(r"<list\[(\w+)\]>", lambda found: f"<{found[1].lower()}>", text)


def _default_text(text: str, **_context: Any) -> str:
    """Return a default that is a text as it is: [default: solid], not [default: (solid)]."""
    return text


def _format_help(command: Any, in_panels: Any, context: Any, formatter: Any) -> None:
    """Print the help in panels; as plain text if the terminal is so narrow that Rich ends a name with an ellipsis."""
    drawn = io.StringIO()
    with contextlib.redirect_stdout(drawn):
        in_panels(context, formatter)
    if "…" in drawn.getvalue():
        formatter.write(_plain_help(command, context, shutil.get_terminal_size().columns))
    else:
        in_panels(context, formatter)  # (again: this time to the terminal, in its colours)


def _plain_help(command: Any, context: Any, width: int) -> str:
    """Return the help as lines of at most this width: names, and below each its text."""
    lines = [*_wrap(context.get_usage(), width, 0), "", *_wrap(inspect.cleandoc(command.help or ""), width, 0)]
    panels: dict[str, list[tuple[str, str]]] = {}
    for option in command.get_params(context):
        if record := option.get_help_record(context):
            default = "Arguments" if option.param_type_name == "argument" else "Options"
            panels.setdefault(option.rich_help_panel or default, []).append(record)
    for name, inner in getattr(command, "commands", {}).items():
        panels.setdefault("Commands", []).append((name, inner.get_short_help_str(1000)))
    for panel, records in panels.items():
        lines += ["", f"{panel}:"]
        for names, text in records:
            lines += [*_wrap(names, width, INDENT // 2), *_wrap(text, width, INDENT)]
    return "\n".join(lines) + "\n"


def _wrap(text: str, width: int, indent: int) -> list[str]:
    space = " " * indent
    return textwrap.wrap(
        " ".join(text.split()), width, initial_indent=space, subsequent_indent=space, break_on_hyphens=False
    )
