"""Parameters that texts of the library name, in backquotes, as options of the command: `view='side'` is --view side."""

from __future__ import annotations

import functools
import re
from dataclasses import replace
from typing import Any

from carom.errors import Fault

__all__ = ["as_option", "in_options", "option_of", "remember_verbs", "verbs_with", "with_options"]

PARAMETER = re.compile(r"`(\w+)(?:=([^`]*))?`")
# The functions and records whose arguments verbs take as options, as the ``where`` of faults names them; and the arguments that
# have other names there.
ARGUMENTS: dict[str, dict[str, str]] = {
    "Ball": {}, "Disc": {}, "wall": {}, "Surface": {}, "incoming": {}, "compare": {},
    "floor": {name: f"floor_{name}" for name in ("restitution", "friction", "tangential_restitution")},
    "Run": {}, "simulate": {}, "predict": {}, "fit": {}, "design": {}, "aim": {}, "tracks": {}, "measure_tracks": {},
    "GasSettings": {}, "simulate_gas": {}, "simulate_ensemble": {}, "orbit": {}, "starts": {},
}  # fmt: skip
_verbs: dict[str, dict[str, str]] = {}  # options by parameter, by verb
_running: list[str] = [""]


def remember_verbs(command: Any, path: str = "carom") -> Any:
    """Return a command, with all below it, that is remembered as the one that runs as soon as it does."""
    options = [option for option in command.params if option.param_type_name == "option"]
    _verbs[path] = {option.name.removeprefix("as_").strip("_"): option.opts[0] for option in options}
    _verbs[path] |= {name.strip("-").replace("-", "_"): name for option in options for name in option.opts}
    command.invoke = functools.partial(_invoke, path, command.invoke)
    for name, inner in getattr(command, "commands", {}).items():
        remember_verbs(inner, f"{path} {name}")
    return command


def _invoke(path: str, invoke: Any, context: Any) -> Any:
    _running[0] = path
    return invoke(context)


def option_of(parameter: str) -> str:
    """Return the option of the running verb for a parameter; where it has none, another verb's, with its name, or the parameter."""
    if option := _own(parameter):
        return option
    return next((f"{own[parameter]} of {verb}" for verb, own in _verbs.items() if parameter in own), parameter)


def _own(parameter: str) -> str | None:
    own = _verbs.get(_running[0], {})
    return own.get(parameter, own.get(parameter.removesuffix("_deg")))


def verbs_with(option: str) -> list[str]:
    """Return the verbs that have an option."""
    return [verb for verb, own in _verbs.items() if option in own.values()]


def in_options(text: str) -> str:
    """Return a text of the library with options in the place of parameters."""
    return PARAMETER.sub(_in_options, text)


def _in_options(found: re.Match[str]) -> str:
    option, value = option_of(found[1]), (found[2] or "").strip("'\"")
    if option == found[1]:
        return found[0] if value else option
    return f"{option} {value}" if value else option


def as_option(fault: Fault) -> Fault:
    """Return a fault of an argument that the running verb takes as an option as a fault of that option."""
    option = _own(ARGUMENTS[fault.where].get(fault.field, fault.field)) if fault.where in ARGUMENTS else None
    return replace(fault, where="", field=option) if option else fault


def with_options(value: Any) -> Any:
    """Return nested lists and dictionaries, as JSON has them, with options in the place of parameters in all texts."""
    if isinstance(value, str):
        return in_options(value)
    if isinstance(value, dict):
        return {name: with_options(one) for name, one in value.items()}
    return [with_options(one) for one in value] if isinstance(value, list | tuple) else value
