"""Parameters that texts of the library name, in backquotes, as options of the command: `view='side'` is --view side."""

from __future__ import annotations

import functools
import re
from dataclasses import fields, is_dataclass, replace
from typing import Any

from carom.errors import Fault

PARAMETER = re.compile(r"(?:(carom(?: [a-z]+)+) )?`(\w+)(?:=([^`]*))?`")  # maybe after the verb that has it
TEXTS = ("verdict", "sentence", "notes")  # fields of results
# The functions and records whose arguments verbs take as options, as the ``where`` of faults names them; and the arguments that
# have other names there.
ARGUMENTS: dict[str, dict[str, str]] = {
    "Ball": {}, "Disc": {}, "wall": {}, "Surface": {}, "incoming": {}, "compare": {},
    "floor": {name: f"floor_{name}" for name in ("restitution", "friction", "tangential_restitution")},
    "in_magnetic_field": {}, "under": {},
    "Run": {}, "simulate": {}, "predict": {}, "fit": {}, "fit_gas": {}, "design": {}, "tracks": {}, "measure_tracks": {},
    "judge": {}, "track_film": {},
    "aim": {"errors": "error"}, "aim: reach": {}, "explore": {}, "plot": {"orbit": "plot"}, "sensitivity": {"wrt": "sensitivity"},
    "GasSettings": {}, "simulate_gas": {}, "simulate_ensemble": {}, "orbit": {}, "orbit: start": {}, "starts": {},
}  # fmt: skip
# A fault of an argument, in the text of any fault: its function, where it is named, the argument, and the rest.
ARGUMENT = re.compile(
    rf"(?:({'|'.join(sorted(ARGUMENTS, key=len, reverse=True))}): (\w+): |(\w+): (?=(?:\w+: )?expected ))(.*)",
    re.DOTALL,
)
SYNONYMS = {"max_bytes": "max_size"}  # parameters of other names than their option's, in all verbs
_running: list[Any] = []  # the context of the verb that runs


def begin(context: Any) -> None:
    """Let texts of the library name the options of this verb from here on."""
    _running[:] = [context]


def path_of(context: Any) -> list[str]:
    """Return the words that name a verb: carom, its group, itself."""
    return [*path_of(context.parent), context.info_name] if context.parent else ["carom"]


@functools.lru_cache(maxsize=4)
def _options(root: Any) -> dict[str, dict[str, str]]:
    """Return the options of all verbs by parameter, by verb."""
    found = {}

    def collect(command: Any, path: str) -> None:
        options = [option for option in command.params if option.param_type_name == "option"]
        found[path] = {parameter_of(option): option.opts[0] for option in options}
        found[path] |= {name.strip("-").replace("-", "_"): name for option in options for name in option.opts}
        for name, inner in getattr(command, "commands", {}).items():
            collect(inner, f"{path} {name}")

    collect(root, "carom")
    return found


def _verbs() -> dict[str, dict[str, str]]:
    return _options(_running[0].find_root().command) if _running else {}


def parameter_of(option: Any) -> str:
    """Return the name by which texts of the library call an option's parameter."""
    return str(option.name).removeprefix("as_").strip("_")


def option_of(parameter: str) -> str:
    """Return the option of the running verb for a parameter; where it has none, another verb's, with its name, or the parameter."""
    if option := _own(parameter):
        return option
    return next((f"{own[parameter]} of {verb}" for verb, own in _verbs().items() if parameter in own), parameter)


def _own(parameter: str) -> str | None:
    own = _verbs().get(" ".join(path_of(_running[0])), {}) if _running else {}
    parameter = SYNONYMS.get(parameter, parameter)
    return own.get(parameter, own.get(parameter.removesuffix("_deg")))


def verbs_with(option: str) -> list[str]:
    """Return the verbs that have an option."""
    return [verb for verb, own in _verbs().items() if option in own.values()]


def options_of_all_verbs() -> list[str]:
    """Return the options of all verbs."""
    return sorted({option for own in _verbs().values() for option in own.values()})


def in_options(text: str) -> str:
    """Return a text of the library with options in the place of parameters."""
    return PARAMETER.sub(_in_options, text)


def _in_options(found: re.Match[str]) -> str:
    said, parameter, value = found[1], found[2], (found[3] or "").strip("'\"")
    if said:
        words = said.split()
        verb = next((name for k in range(len(words), 0, -1) if (name := " ".join(words[:k])) in _verbs()), "")
        option = _verbs().get(verb, {}).get(parameter) or option_of(parameter)
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
