"""Words that the command does not know, and values that its options do not take: one line each, with the name that was meant."""

from __future__ import annotations

import functools
import re
import sys
from difflib import get_close_matches
from typing import Any

from carom.cli.option_names import options_of_all_verbs, verbs_with
from carom.errors import CaromError, Fault, did_you_mean, near_name, shortened_list

NEARLY = 0.83  # of an option of another verb (difflib's ratio): one letter of a short word

__all__ = ["help_of", "require_values", "usage_fault"]


def usage_fault(error: Any) -> str:
    """Return expectation and finding for the command's words; Typer's own sentence where it is another fault."""
    context, kind = getattr(error, "ctx", None), type(error).__name__
    message, said = str(error.format_message()), str(getattr(error, "message", ""))
    if kind == "NoSuchOption" and context is not None:
        return str(_unknown_option(error.option_name, context))
    if message.startswith("No such command") and context is not None:
        return str(_unknown_verb(context))
    if kind == "MissingParameter" and (taken := _taken_for_a_value(context)):
        return taken
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


def _values(name: str, command: Any) -> str:
    """Return what an option takes: its values where its help names them."""
    metavars = [str(one.metavar or "") for one in command.params if name in one.opts]
    named = re.fullmatch(r"[a-z]+(\|[a-z]+)+", metavars[0] if metavars else "")
    return named[0].replace("|", " or ") if named else "a value"


def _taken_for_a_value(context: Any) -> str:
    """Return the fault of an option that took the argument which is missing for its value, where its help names others."""
    for option in context.command.params if context else ():
        values = [] if not option.opts else _values(option.opts[0], context.command).split(" or ")
        for k, word in enumerate(sys.argv[:-1]):
            if word in option.opts and len(values) > 1 and sys.argv[k + 1] not in values:
                return str(Fault("", word, " or ".join(values), f"{sys.argv[k + 1]!r:.60}"))
    return ""


def require_values(command: Any) -> Any:
    """Return a command that says, with all below it, which option has no value: it is the last word, or another option follows."""
    command.parse_args = functools.partial(_parse, command, command.parse_args)
    for inner in getattr(command, "commands", {}).values():
        require_values(inner)
    return command


def _parse(command: Any, parse: Any, context: Any, given: list[str]) -> Any:
    options = [one for one in command.params if one.param_type_name == "option"]
    takes = {name for one in options if not one.is_flag for name in one.opts}
    known = {name for one in options for name in (*one.opts, *one.secondary_opts)}
    words = given[: given.index("--")] if "--" in given else given
    for k, word in enumerate(words):
        after = words[k + 1] if k + 1 < len(words) else None
        if word in takes and (after is None or (after.startswith("--") and after.partition("=")[0] in known)):
            got = f"the next option, {after}" if after is not None else "none"
            raise CaromError(Fault("", word, _values(word, command), got))
    return parse(context, given)


def _unknown_option(name: str, context: Any) -> Fault:
    """Return the fault of an option that a verb does not have, with one that is near, or other verbs that have it."""
    words = [one for option in context.command.params for one in (*option.opts, *option.secondary_opts)]
    own = [one for one in words if one.startswith("--")]
    said = name
    if not (did_you_mean(name, own) or verbs_with(name)):
        name = next(
            iter(get_close_matches(name, options_of_all_verbs(), 1, NEARLY)), name
        )  # (mistyped, of another verb)
    verbs = verbs_with(name)
    listed = (
        shortened_list(verbs, 3) if len(verbs) > 3 else " and ".join(filter(None, (", ".join(verbs[:-1]), *verbs[-1:])))
    )
    elsewhere = f"{listed} {'have' if len(verbs) > 1 else 'has'} {name}" if verbs else ""
    near = "" if verbs and name not in near_name(name, own) else did_you_mean(name, own)
    return Fault("", said, f"an option of {' '.join(_path(context))}", "", near or elsewhere)


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
