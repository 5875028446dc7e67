"""The classes of the command: verbs and groups of verbs, what their help looks like, and words that they do not know."""

from __future__ import annotations

import functools
import inspect
import os
import re
import shutil
import sys
import textwrap
from dataclasses import fields, is_dataclass, replace
from difflib import get_close_matches
from pathlib import Path
from typing import Any

import typer
from typer.core import TyperCommand, TyperGroup

from carom.errors import CaromError, Fault, MissingLibraryError, did_you_mean, near_name, shortened_list

PARAMETER = re.compile(r"(?:(carom(?: [a-z]+)+) )?`(\w+)(?:=([^`]*))?`")  # maybe after the verb that has it
TEXTS = ("verdict", "sentence", "notes")  # fields of results
# The functions and records whose arguments verbs take as options, as the ``where`` of faults names them; and the arguments that
# have other names there.
ARGUMENTS: dict[str, dict[str, str]] = {
    "Ball": {}, "Disc": {}, "wall": {}, "Surface": {}, "incoming": {}, "compare": {},
    "floor": {name: f"floor_{name}" for name in ("restitution", "friction", "tangential_restitution")},
    "in_magnetic_field": {}, "under": {},
    "Run": {}, "simulate": {}, "predict": {}, "fit": {}, "fit_gas": {},
    "fit_air": {}, "design": {}, "tracks": {}, "measure_tracks": {},
    "judge": {}, "track_film": {},
    "aim": {"errors": "error"}, "aim: reach": {}, "explore": {}, "plot": {"orbit": "plot"}, "sensitivity": {"wrt": "sensitivity"},
    "GasSettings": {}, "simulate_gas": {}, "gas_ensemble": {}, "orbit": {}, "orbit: start": {}, "starts": {},
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
    root = _running[0].find_root().command if _running else None
    return _options(getattr(root, "whole", lambda: root)()) if root else {}


def parameter_of(option: Any) -> str:
    """Return the name by which texts of the library call an option's parameter."""
    return str(option.name).removeprefix("as_").strip("_")


def option_of(parameter: str) -> str:
    """Return the option of the running verb for a parameter; where it has none, another verb's, with its name, or the parameter."""
    if option := _own(parameter):
        return option
    return next((f"{own[parameter]} of {verb}" for verb, own in _verbs().items() if parameter in own), parameter)


def _own(parameter: str) -> str | None:
    own = _options(_running[0].find_root().command).get(" ".join(path_of(_running[0])), {}) if _running else {}
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


# ----------------------------------------------------------------------------------------------------
# The classes of the command: verbs and groups of verbs, what their help looks like, and words that they do not know.


NEARLY = 0.83  # of an option of another verb (difflib's ratio): one letter of a short word
BESIDE = 72  # columns of the terminal from which texts stand beside the names, not below them
NUMBERS = {"RADII", "RATE", "T"}  # words in the help for one number, beside those of carom.cli.options.quantity
TYPES = {"float": " NUMBER", "int": " N", "str": " TEXT", "path": " FILE", "list[str]": " TEXT", "list[Path]": " FILE"}
LEFT = 30  # columns for names, at most


class _Word:
    """What verbs and groups share."""

    def parse_args(self, context: Any, given: list[str]) -> Any:
        """Show the help; or refuse an option without its value: it is the last word, or another option follows."""
        begin(context)
        words = given[: given.index("--")] if "--" in given else given
        if "--help" in (words[:1] if isinstance(self, TyperGroup) else words):
            sys.stdout.write(f"{context.get_help()}\n")
            raise typer.Exit
        _require_values(self, words)
        return super().parse_args(context, _with_points(self, given))  # type: ignore[misc]

    def invoke(self, context: Any) -> Any:
        """Run the verb; texts of the library name its options from here on."""
        begin(context)
        try:
            return super().invoke(context)  # type: ignore[misc]
        except MissingLibraryError as error:  # (a file that is not there is to be mended first)
            given = [context.params.get(one.name) for one in self.params if one.param_type_name == "argument"]  # type: ignore[attr-defined]
            files = [file for one in given for file in (one if isinstance(one, list | tuple) else [one])]
            lost = [file for file in files if isinstance(file, Path) and file.suffix and not file.exists()]
            if not lost:
                raise
            raise CaromError(
                *(f"{file}: expected a file, got: No such file or directory" for file in lost), *error.records
            ) from None

    def format_help(self, context: Any, formatter: Any) -> None:
        """Write the help in lines of the terminal's width: names, and their texts beside or below them."""
        formatter.write(_help(self, context, shutil.get_terminal_size().columns))


class Verb(_Word, TyperCommand):
    """A verb."""


class VerbGroup(_Word, TyperGroup):
    """Verbs, of which some are two words: ``fit gas``, unless the second is a file."""

    def resolve_command(self, ctx: Any, args: list[str]) -> Any:
        """Return the command that the first words name, and the rest of the arguments."""
        if (two := " ".join(args[:2])) in self.commands and len(args) > 1 and not os.path.exists(args[1]):
            args = [two, *args[2:]]
        return super().resolve_command(ctx, args)


class App(typer.Typer):
    """A group of verbs to which functions are added."""

    def __init__(self, **settings: Any) -> None:
        super().__init__(
            cls=VerbGroup, no_args_is_help=True, pretty_exceptions_enable=False, add_help_option=False, **settings
        )

    def command(self, name: str | None = None, **settings: Any) -> Any:
        """Add a function as a verb."""
        return super().command(name, cls=Verb, add_help_option=False, **settings)


def _help(command: Any, context: Any, width: int) -> str:
    """Return the help as lines of at most this width."""
    lines = [*_wrap(context.get_usage(), width, 0), "", *_wrap(inspect.cleandoc(command.help or ""), width, 0)]
    panels: dict[str, list[tuple[str, str]]] = {}
    for option in command.get_params(context):
        if isinstance(shown := getattr(option, "show_default", None), str):  # (else Typer adds brackets to it)
            option.help, option.show_default = f"{option.help} [default: {shown}]", False
        if record := option.get_help_record(context):
            argument = option.param_type_name == "argument"
            name, text = record
            for kind, word in TYPES.items():
                name = name.replace(f" <{kind}>", "" if argument else word)
            panel = option.rich_help_panel or ("Arguments" if argument else "Options")
            panels.setdefault(panel, []).append((name, text))
    for name, inner in getattr(command, "commands", {}).items():
        panels.setdefault(inner.rich_help_panel or "Commands", []).append((name, inner.get_short_help_str(1000)))
    version = [] if context.parent else [("--version", "Print the version.")]
    panels["Options"] = [*panels.pop("Options", []), *version, ("--help", "Show this message and exit.")]
    names = [len(name) for records in panels.values() for name, _text in records]
    left = min(max(names), LEFT) + 2
    bold = sys.stdout.isatty() and "NO_COLOR" not in os.environ
    for panel, records in panels.items():
        lines += ["", f"\033[1m{panel}:\033[0m" if bold else f"{panel}:"]
        for name, text in records:
            inside = _wrap(text, width, left + 2 if width >= BESIDE else 4)
            if width >= BESIDE and len(name) < left:
                inside = [f"  {name:{left}}{line.strip()}" if k == 0 else line for k, line in enumerate(inside or [""])]
                lines += [line.rstrip() for line in inside]
            else:
                lines += [*_wrap(name, width, 2), *inside]
    return "\n".join(lines) + "\n"


def _wrap(text: str, width: int, indent: int) -> list[str]:
    space = " " * indent
    return textwrap.wrap(
        " ".join(text.split()), width, initial_indent=space, subsequent_indent=space, break_on_hyphens=False
    )


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
    for word, after in zip(sys.argv, [*sys.argv[1:], ""], strict=True):
        name, _, value = word.partition("=")
        if name in names and expected != said and (value := value or after):
            number = re.match(r"[-+]?\d+(?:\.\d+)?(?= ?([%a-zA-Zµ]))", value)
            alone = "" if number is None else f"{float(number[0]) / 100:g}" if number[1] == "%" else number[0]
            return str(Fault("", name, expected, f"{value!r:.60}", f"write {alone}" if alone else ""))
    return message


def help_of(error: Any) -> str:
    """Return the words that show the help of the verb that an error is about."""
    context = getattr(error, "ctx", None)
    return " ".join([*(path_of(context) if context else ["carom"]), "--help"])


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


def _require_values(command: Any, given: list[str]) -> None:
    options = [one for one in command.params if one.param_type_name == "option"]
    takes = {name for one in options if not one.is_flag for name in one.opts}
    known = {name for one in options for name in (*one.opts, *one.secondary_opts)}
    for k, word in enumerate(given):
        after = given[k + 1] if k + 1 < len(given) else None
        if word in takes and (after is None or (after.startswith("--") and after.partition("=")[0] in known)):
            got = f"the next option, {after}" if after is not None else "none"
            raise CaromError(Fault("", word, _values(word, command), got))
    once = {name: one for one in options if not (one.is_flag or one.multiple) for name in one.opts}
    said = [once[name] for word in given if (name := word.partition("=")[0]) in once]
    for one in said:
        if (times := said.count(one)) > 1:
            advice = "carom compare takes several laws" * (one.name == "law")
            raise CaromError(Fault("", one.opts[0], "one value", f"{times}", advice))


def _with_points(command: Any, given: list[str]) -> list[str]:
    """Return the words with a point for a decimal comma, as in files, in the value of each option that takes one number."""
    if not any("," in word for word in given):
        return given
    from carom.core.units import decimal_point  # (NumPy comes with it)

    numbers = {
        name
        for one in command.params
        if getattr(getattr(one, "type_descriptor", None), "annotation", None) is float
        or getattr(getattr(one, "type", None), "name", "") == "float"  # (Typer on click)
        or (one.metavar in NUMBERS and not getattr(one, "multiple", False))
        for name in one.opts
    }
    words = list(given)
    for k, word in enumerate(words):
        name, equals, value = word.partition("=")
        if equals and name in numbers:
            words[k] = f"{name}={decimal_point(value)}"
        elif k and given[k - 1] in numbers:
            words[k] = decimal_point(word)
    return words


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
    return Fault("", said, f"an option of {' '.join(path_of(context))}", "", near or elsewhere)


def _unknown_verb(context: Any) -> Fault:
    """Return the fault of a verb that the command or one of its groups does not have."""
    verbs, group = list(context.command.commands), context.info_name
    words = sys.argv[len(path_of(context)) :]
    word = next((one for one in words if not one.startswith("-")), "")
    near = did_you_mean(word, verbs)
    if context.parent and not near:
        return Fault("", group, f"{' or '.join(verbs)} before {' '.join(words)!r:.60}")
    return Fault("", group if context.parent else "", f"one of {', '.join(verbs)}", repr(word), near)
