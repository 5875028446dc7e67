"""Parameters that texts of the library name, in backquotes, as options of the command: ``sigma_v`` is --sigma-v."""

from __future__ import annotations

import functools
import re
from collections.abc import Mapping
from typing import Any

__all__ = ["in_options", "option_of", "remember_verbs", "with_options"]

PARAMETER = re.compile(r"`(\w+)`")
_verbs: dict[str, Mapping[str, str]] = {}  # options by parameter, by verb
_running: list[str] = [""]


def remember_verbs(command: Any, path: str = "carom") -> Any:
    """Return a command, with all below it, that is remembered as the one that runs as soon as it does."""
    _verbs[path] = {
        option.name.removeprefix("as_").strip("_"): option.opts[0]
        for option in command.params
        if option.param_type_name == "option"
    }
    command.invoke = functools.partial(_invoke, path, command.invoke)
    for name, inner in getattr(command, "commands", {}).items():
        remember_verbs(inner, f"{path} {name}")
    return command


def _invoke(path: str, invoke: Any, context: Any) -> Any:
    _running[0] = path
    return invoke(context)


def option_of(parameter: str) -> str:
    """Return the option of the running verb for a parameter; where it has none, another verb's, with its name, or the parameter."""
    if option := _verbs.get(_running[0], {}).get(parameter):
        return option
    return next((f"{own[parameter]} of {verb}" for verb, own in _verbs.items() if parameter in own), parameter)


def in_options(text: str) -> str:
    """Return a text of the library with options in the place of parameters."""
    return PARAMETER.sub(lambda found: option_of(found[1]), text)


def with_options(value: Any) -> Any:
    """Return nested lists and dictionaries, as JSON has them, with options in the place of parameters in all texts."""
    if isinstance(value, str):
        return in_options(value)
    if isinstance(value, dict):
        return {name: with_options(one) for name, one in value.items()}
    return [with_options(one) for one in value] if isinstance(value, list | tuple) else value
