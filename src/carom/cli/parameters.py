"""Options of verbs from the functions of the library that they call: names, types, defaults and texts stand in these alone.

A function is read as text, so that the help of a verb imports none of the library's rooms. A parameter's text is its entry in the
docstring, with ``name`` in it shown as the option; what only the command line has stands in OPTIONS (:mod:`carom.cli.options`).
"""

from __future__ import annotations

import ast
import contextlib
import functools
import inspect
import math
import re
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Annotated, Any, NamedTuple

import carom
from carom.cli.options import (
    IN_RADII,
    OPTIONS,
    PANELS,
    RUN,
    SPLIT,
    comma_separated,
    in_radii,
    option,
    parse_assignments,
    parse_bounds,
    parse_number,
    parse_pair,
    parse_with_unit,
    quantity,
)
from carom.errors import CaromError, FaultList
from carom.public import defaults
from carom.public.own_laws import with_own_laws

ROOT = Path(carom.__file__).parent
SECTION = re.compile(r"^Parameters\n-+\n(.*?)(?=^\S[^\n]*\n---|\Z)", re.DOTALL | re.MULTILINE)
ENTRY = re.compile(r"^(\S[^\n:]*)(?: : [^\n]*)?\n((?:    [^\n]*\n?|\n)*)", re.MULTILINE)
UNIT = re.compile(r", (m/s\^2|m/s|rad/s|kg|m|s|degrees)(?=[.;,:]|$)")


class Declared(NamedTuple):
    """A parameter of a function, as its source has it."""

    type: str
    default: Any
    text: str

    @property
    def unit(self) -> str:
        """The SI unit of a number that may be given with another; empty where it has none."""
        found = UNIT.search(self.text) if self.type.partition(" |")[0] == "float" and "str" not in self.type else None
        return found[1].replace("degrees", "degree") if found else ""


@functools.cache
def parameters(place: str) -> dict[str, Declared]:
    """Return the parameters of a function, ``"fitting.files:fit"``, from its signature and docstring."""
    module, _, name = place.partition(":")
    source = (ROOT / module.replace(".", "/")).with_suffix(".py").read_text(encoding="utf-8")
    start = source.index(f"\ndef {name}(") + 1
    end = source.index('"""', source.index('"""', start) + 3) + 3
    function: Any = ast.parse(source[start:end]).body[0]
    section = SECTION.search(inspect.cleandoc(ast.get_docstring(function) or ""))
    texts = {
        one.strip(): " ".join(entry[2].split())
        for entry in ENTRY.finditer(section[1] if section else "")
        for one in entry[1].split(",")
    }
    given = function.args
    every = [*given.args, *given.kwonlyargs]
    values = [*([None] * (len(given.args) - len(given.defaults))), *given.defaults, *given.kw_defaults]
    known = {"math": math, **vars(defaults)}
    return {
        one.arg: Declared(
            ast.unparse(one.annotation),
            inspect.Parameter.empty if value is None else eval(ast.unparse(value), known),
            texts.get(one.arg, ""),
        )
        for one, value in zip(every, values, strict=True)
    }


class Given(dict[str, Any]):
    """Arguments of a function of the library that were given on the command line; the others have their defaults there."""

    faults: FaultList
    """Of texts that are no values, and of what else the verb adds."""

    def raise_if_any(self, check: Callable[[], Any]) -> None:
        """Raise CaromError for faults, after those that ``check`` of the library finds in the other arguments."""
        if self.faults:
            found = FaultList()
            found.attempt(check)
            raise CaromError(*found, *self.faults)


def of_library(
    place: str, *films: str, without: tuple[str, ...] = (), panels: Mapping[str, str] | None = None
) -> Callable[[Callable[..., None]], Callable[..., None]]:
    """Give a verb the parameters of a function, in the place of its own one, ``given``, which gets them as :class:`Given`.

    ``films`` are further functions whose parameters the function takes as the mapping ``film``; ``without`` are parameters that
    the verb has itself, or not at all; ``panels`` are headings of the help, by the names below them.
    """

    def decorate(verb: Callable[..., None]) -> Callable[..., None]:
        own = dict(inspect.signature(verb, eval_str=True).parameters)
        left = {*own, *without, "progress", *["film"] * bool(films)}
        found = {name: one for name, one in parameters(place).items() if name not in left}
        more = {
            name: one._replace(default=None)
            for film in films
            for name, one in parameters(film).items()
            if name not in (*own, *found, "film", "progress", "path", "files", "balls")
        }
        every = found | more
        headings = {name: panel for panel, names in (panels or {}).items() for name in names.split()}
        options = {name: _option(name, one, headings.get(name), every) for name, one in every.items()}
        signature = []
        for name, one in own.items():
            signature += [one] if name != "given" else [
                inspect.Parameter(name, one.KEYWORD_ONLY, default=default, annotation=Annotated[kind, info])
                for name, (kind, info, default) in options.items()
            ]  # fmt: skip

        @functools.wraps(verb)
        def run(**values: Any) -> None:
            given = Given()
            given.faults = FaultList()
            for name, one in every.items():
                value = values.pop(name)
                if value not in (None, [], options[name][2]):
                    radius = given.get("radius", every["radius"].default if "radius" in every else None)
                    read = given.faults.attempt(_read, name, one, value, radius)
                    if read is not None:
                        (given if name in found else given.setdefault("film", {}))[name] = read
            verb(**values, given=given)

        run.__signature__ = inspect.Signature(  # type: ignore[attr-defined]
            [one.replace(kind=inspect.Parameter.KEYWORD_ONLY) for one in signature]
        )
        run.__annotations__ = {one.name: one.annotation for one in signature}
        del run.__wrapped__
        return run

    return decorate


def _flag(name: str) -> str:
    return f"--{name.removesuffix('_deg').replace('_', '-')}"


def _option(name: str, one: Declared, panel: str | None, every: Mapping[str, Declared]) -> tuple[Any, Any, Any]:
    """Return the type, the option and the default of a parameter on the command line."""
    text = re.sub(r" \(:\w+:`[^`]*`\)|``(?=\{)[^`]*``", "", one.text)
    text = re.sub(r":\w+:`([\w.]+)`", lambda said: said[1].replace(".", " "), text)
    text = re.sub(r"``(\w+)``", lambda said: _flag(said[1]) if said[1] in every else said[1], text)
    settings = dict(OPTIONS.get(name, {}))
    flags = settings.pop("flags", ())
    default = None if one.default in ((), inspect.Parameter.empty) else one.default
    kind: Any = {"float": float, "int": int, "bool": bool}.get(one.type.partition(" |")[0], str)
    if one.type.startswith(("str | Path", "str | PathLike")):
        kind = Path
    elif "Sequence[str]" in one.type or one.type.startswith(("Mapping", "Where", "str | Iterable")):
        kind, default = list[str], list(default) if default else default
        text += "" if name in SPLIT else " May be repeated."
    elif "str" in one.type.split(" | "):
        kind = str
    if kind is bool and not flags:
        flags = (_flag(name), *([f"--no-{_flag(name)[2:]}"] if "None" in one.type else []))
        flags = ("/".join(flags),)
    if isinstance(default, tuple):
        default = (":" if ":" in settings["metavar"] else ",").join(f"{x:g}" for x in default)
    if isinstance(default, float):
        settings["show_default"] = f"{default:g}"
    if kind is float and (one.unit or settings.get("metavar") == IN_RADII):
        kind, default = str, None  # (read with the others: all faults at once)
        settings |= {"metavar": quantity(name, one.unit)["metavar"]} if one.unit else {}
    info = option(
        panel or PANELS.get(name, RUN), f"{text[:1].upper()}{text[1:]}", *(flags or (_flag(name),)), **settings
    )
    return (kind if default is not None or (kind is bool and "None" not in one.type) else kind | None), info, default


def _read(name: str, one: Declared, value: Any, radius: float | None) -> Any:  # noqa: PLR0911
    """Return the value of an option as its function takes it; ``radius``: of the ball, m, if it is known (it stands before)."""
    flag, wanted, kind = _flag(name), OPTIONS.get(name, {}).get("metavar", ""), one.type
    if kind.startswith("Mapping"):
        faults = FaultList()
        read = parse_bounds if "tuple" in kind else functools.partial(parse_number, flag)
        found = {key: faults.attempt(read, key, text) for key, text in parse_assignments(faults, flag, value)}
        faults.raise_if_any()
        return found
    if isinstance(value, list):
        return [part for text in value for part in comma_separated(text)] if name in SPLIT else value
    if kind.startswith("tuple"):
        return value if value in wanted.split("|") else _pair(flag, value, wanted)
    if kind.startswith(("ArrayLike", "Sequence[float]")):
        return _numbers(value)
    if wanted == IN_RADII:
        return in_radii(flag, value, radius)
    if name in ("scale", "noise") and value != "gravity":
        return parse_with_unit(flag, "m", value)
    if one.unit:
        return parse_with_unit(OPTIONS.get(name, {}).get("flags", (flag,))[0], one.unit, value)
    if name == "inertia":  # a number, or a word
        from carom.core.units import decimal_point

        with contextlib.suppress(ValueError):
            return float(decimal_point(value))
    return with_own_laws(value) if name == "law" else value


def _pair(flag: str, text: str, wanted: str) -> tuple[float, float]:
    """Return two numbers, LOW:HIGH or X,Y."""
    if ":" not in wanted:
        return parse_pair(flag, text)
    with contextlib.suppress(CaromError):
        return parse_pair(flag, text if ":" in text else f"{text}:{text}", ":")
    such = "5:75, or unknown" if "unknown" in wanted else "5:75"
    raise CaromError(f"{flag}: expected LOW:HIGH, such as {such}, got {text!r}")


def _numbers(text: str) -> float | list[float] | str:
    """Return the numbers between commas; a number where there is but one, and another text as it is, for the library to refuse."""
    with contextlib.suppress(ValueError):
        if found := [float(part) for part in text.replace(",", " ").split()]:
            return found[0] if len(found) == 1 and "," not in text else found
    return text
