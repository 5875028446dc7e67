"""Parameters that texts of the library name, in backquotes, as options of the command: `view='side'` is --view side."""

from __future__ import annotations

import functools
import re
from dataclasses import fields, is_dataclass, replace
from typing import Any

from carom.errors import Fault

__all__ = [
    "SYNONYMS",
    "as_option",
    "in_options",
    "option_of",
    "options_of_all_verbs",
    "parameter_of",
    "remember_verbs",
    "verbs_with",
    "with_options",
]

PARAMETER = re.compile(r"(?:(carom(?: [a-z]+)+) )?`(\w+)(?:=([^`]*))?`")  # maybe after the verb that has it
TEXTS = ("verdict", "sentence", "notes")  # fields of results
# The functions and records whose arguments verbs take as options, as the ``where`` of faults names them; and the arguments that
# have other names there.
ARGUMENTS: dict[str, dict[str, str]] = {
    "Ball": {}, "Disc": {}, "wall": {}, "Surface": {}, "incoming": {}, "compare": {},
    "floor": {name: f"floor_{name}" for name in ("restitution", "friction", "tangential_restitution")},
    "in_magnetic_field": {}, "under": {},
    "Run": {}, "simulate": {}, "predict": {}, "fit": {}, "fit_gas": {}, "design": {}, "tracks": {}, "measure_tracks": {},
    "judge": {},
    "aim": {"errors": "error"}, "aim: reach": {}, "explore": {}, "plot": {"orbit": "plot"}, "sensitivity": {"wrt": "sensitivity"},
    "GasSettings": {}, "simulate_gas": {}, "simulate_ensemble": {}, "orbit": {}, "orbit: start": {}, "starts": {},
}  # fmt: skip
# A fault of an argument, in the text of any fault: its function, where it is named, the argument, and the rest.
ARGUMENT = re.compile(
    rf"(?:({'|'.join(sorted(ARGUMENTS, key=len, reverse=True))}): (\w+): |(\w+): (?=(?:\w+: )?expected ))(.*)",
    re.DOTALL,
)
SYNONYMS = {"max_bytes": "max_size"}  # parameters of other names than their option's, in all verbs
_verbs: dict[str, dict[str, str]] = {}  # options by parameter, by verb
_running: list[str] = [""]


def remember_verbs(command: Any, path: str = "carom") -> Any:
    """Return a command, with all below it, that is remembered as the one that runs as soon as it does."""
    options = [option for option in command.params if option.param_type_name == "option"]
    _verbs[path] = {parameter_of(option): option.opts[0] for option in options}
    _verbs[path] |= {name.strip("-").replace("-", "_"): name for option in options for name in option.opts}
    command.invoke = functools.partial(_invoke, path, command.invoke)
    for name, inner in getattr(command, "commands", {}).items():
        remember_verbs(inner, f"{path} {name}")
    return command


def _invoke(path: str, invoke: Any, context: Any) -> Any:
    _running[0] = path
    return invoke(context)


def parameter_of(option: Any) -> str:
    """Return the name by which texts of the library call an option's parameter."""
    return str(option.name).removeprefix("as_").strip("_")


def option_of(parameter: str) -> str:
    """Return the option of the running verb for a parameter; where it has none, another verb's, with its name, or the parameter."""
    if option := _own(parameter):
        return option
    return next((f"{own[parameter]} of {verb}" for verb, own in _verbs.items() if parameter in own), parameter)


def _own(parameter: str) -> str | None:
    own, parameter = _verbs.get(_running[0], {}), SYNONYMS.get(parameter, parameter)
    return own.get(parameter, own.get(parameter.removesuffix("_deg")))


def verbs_with(option: str) -> list[str]:
    """Return the verbs that have an option."""
    return [verb for verb, own in _verbs.items() if option in own.values()]


def options_of_all_verbs() -> list[str]:
    """Return the options of all verbs."""
    return sorted({option for own in _verbs.values() for option in own.values()})


def in_options(text: str) -> str:
    """Return a text of the library with options in the place of parameters."""
    return PARAMETER.sub(_in_options, text)


def _in_options(found: re.Match[str]) -> str:
    said, parameter, value = found[1], found[2], (found[3] or "").strip("'\"")
    if said:
        words = said.split()
        verb = next((name for k in range(len(words), 0, -1) if (name := " ".join(words[:k])) in _verbs), "")
        option = _verbs.get(verb, {}).get(parameter) or option_of(parameter)
    else:
        option = (_own(parameter) or parameter) if found.start() == 0 else option_of(parameter)
    if option == parameter and value:
        return found[0]
    return " ".join(filter(None, (said, option, "" if value == "True" else value)))


def as_option(fault: Fault) -> Fault:
    """Return a fault of an argument that the running verb takes as an option as a fault of that option."""
    if (found := ARGUMENT.fullmatch(str(fault))) is None:
        return fault
    argument = ARGUMENTS[found[1]].get(found[2], found[2]) if found[1] else found[3]
    option = _own(argument)
    return Fault(field=option, advice=found[4]) if option else fault


def with_options(found: Any) -> Any:
    """Return a result, or the lists and dictionaries of its JSON, with options in the place of parameters in all texts."""
    if isinstance(found, str):
        return in_options(found)
    if isinstance(found, dict):
        return {name: with_options(one) for name, one in found.items()}
    if type(found) in (list, tuple):
        return type(found)(with_options(one) for one in found)
    if is_dataclass(found) and not isinstance(found, type):
        texts = {one.name: getattr(found, one.name) for one in fields(found) if one.name in TEXTS}
        return replace(found, **{name: with_options(text) for name, text in texts.items()})
    return found
