"""Words that the command does not know, and values that its options do not take: one line each, with the name that was meant."""

from __future__ import annotations

import sys
from typing import Any

from carom.cli.option_names import verbs_with
from carom.errors import Fault, did_you_mean, near_name, shortened_list

__all__ = ["help_of", "usage_fault"]


def usage_fault(error: Any) -> str:
    """Return expectation and finding for the command's words; Typer's own sentence where it is another fault."""
    context, kind = getattr(error, "ctx", None), type(error).__name__
    message, said = str(error.format_message()), str(getattr(error, "message", ""))
    if kind == "NoSuchOption" and context is not None:
        return str(_unknown_option(error.option_name, context))
    if message.startswith("No such command") and context is not None:
        return str(_unknown_verb(context))
    if said.endswith("requires an argument."):
        return str(Fault("", error.option_name, "a value", "none"))
    names = getattr(getattr(error, "param", None), "opts", [])
    expected = said.partition(", ")[0].removeprefix("Input should be ")
    if expected == "Value error":  # raised by the parser of an option, which says all
        return said.partition(", ")[2]
    for k, word in enumerate(sys.argv):
        name, _, value = word.partition("=")
        if name in names and expected != said and (value or k + 1 < len(sys.argv)):
            return str(Fault("", name, expected, f"{value or sys.argv[k + 1]!r:.60}"))
    return message


def help_of(error: Any) -> str:
    """Return the words that show the help of the verb that an error is about."""
    context = getattr(error, "ctx", None)
    return " ".join([*(_path(context) if context else ["carom"]), "--help"])


def _unknown_option(name: str, context: Any) -> Fault:
    """Return the fault of an option that a verb does not have, with one that is near, or other verbs that have it."""
    own = [one for option in context.command.params for one in option.opts if one.startswith("--")]
    verbs = verbs_with(name)
    listed = (
        shortened_list(verbs, 3) if len(verbs) > 3 else " and ".join(filter(None, (", ".join(verbs[:-1]), *verbs[-1:])))
    )
    elsewhere = f"{listed} {'have' if len(verbs) > 1 else 'has'} {name}" if verbs else ""
    near = "" if verbs and name not in near_name(name, own) else did_you_mean(name, own)
    return Fault("", name, f"an option of {' '.join(_path(context))}", "", near or elsewhere)


def _unknown_verb(context: Any) -> Fault:
    """Return the fault of a verb that the command or one of its groups does not have."""
    verbs, group = list(context.command.commands), context.info_name
    words = sys.argv[len(_path(context)) :]
    word = next((one for one in words if not one.startswith("-")), "")
    near = did_you_mean(word, verbs)
    if context.parent and not near:
        return Fault("", group, f"{' or '.join(verbs)} before {' '.join(words)!r:.60}")
    return Fault("", group if context.parent else "", f"one of {', '.join(verbs)}", repr(word), near)


def _path(context: Any) -> list[str]:
    """Return the words that name a verb: carom, its group, itself."""
    return [*_path(context.parent), context.info_name] if context.parent else ["carom"]
