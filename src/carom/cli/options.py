"""Options that several commands have, each defined once; and the parsers of their values."""

from __future__ import annotations

import functools
import math
from collections.abc import Callable, Iterator, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import typer

from carom.cli.streams import note, say_json
from carom.errors import CaromError, Fault, FaultList, collected
from carom.files import require_library, require_writable

if TYPE_CHECKING:
    from rich.console import Console

# Headings in the help, for options of all commands.
BALL, WALL, FLOOR, RUN, OUTPUT = "Ball", "Wall", "Floor", "Run", "Output"
TRACK, REBOUNDS, FILM = "Track", "Table of rebounds", "Film"

# What an option with this unit expects, and examples.
_QUANTITIES = {
    "m": ("a length", "0.0005 (m) or 0.5mm"),
    "kg": ("a mass", "0.17 (kg) or 170g"),
    "m/s": ("a speed", "1.5 (m/s) or 150cm/s"),
    "m/s^2": ("an acceleration", "9.81 (m/s^2) or 981cm/s^2"),
    "rad/s": ("a spin", "10 (rad/s) or 95rpm"),
    "degree": ("an angle", "45 (degrees) or 0.79rad"),
    "s": ("a time", "0.02 (s) or 20ms"),
}


def in_radii(text: str | float) -> float:
    """Return the height of a contact, which is given in radii of the ball."""
    try:
        return float(text)
    except ValueError:
        raise CaromError(
            f"--contact-height: expected a number of ball radii, such as 1.27 (height of the nose over radius), got {text!r}"
        ) from None


# Each shared option by its parameter's name: heading, help, and further arguments of typer.Option; ``unit`` is the SI unit of a
# value that may be given with another.
_SHARED: dict[str, tuple[str, str, dict[str, Any]]] = {
    "radius": (BALL, "Radius, m.", {"unit": "m"}),
    "mass": (BALL, "Mass, kg.", {"unit": "kg"}),
    "inertia": (BALL, "solid, hollow, or kappa = I/(m a^2).", {"metavar": "solid|hollow|KAPPA"}),
    "height": (BALL, "Height of the ball above the floor when it meets the wall, m.", {"unit": "m"}),
    "restitution": (WALL, "Coefficient of restitution, 0 to 1.", {}),
    "friction": (WALL, "Friction coefficient; inf: never slips.", {}),
    "tangential_restitution": (WALL, "Tangential restitution, -1 to 1: 0 stops the slip, 1 reverses it.", {}),
    "stiffness_ratio": (WALL, "Tangential over normal stiffness, for laws with tangential compliance.", {}),
    "contact_height": (
        WALL,
        "Height of the contact above the floor, in ball radii; billiard cushions: 1.25 to 1.4.",
        {"flags": ("--contact-height", "--cushion-height"), "parser": in_radii, "metavar": "RADII"},
    ),
    "floor_restitution": (FLOOR, "Coefficient of restitution, 0 to 1.", {}),
    "floor_friction": (FLOOR, "Friction coefficient; inf: never slips.", {}),
    "floor_tangential_restitution": (FLOOR, "Tangential restitution, -1 to 1: 0 stops the slip, 1 reverses it.", {}),
    "floor_contact": (
        FLOOR,
        "Whether a ball that the wall presses down meets the floor with the wall or after it.",
        {"metavar": "with|after"},
    ),
    "gravity": (FLOOR, "Gravity, m/s^2.", {"unit": "m/s^2"}),
    "duration": (RUN, "Duration; overrides the scene's.", {"metavar": "T"}),
    "max_events": (RUN, "Largest number of events; overrides the scene's.", {"metavar": "N", "whole": True}),
    "seed": (RUN, "Seed of the random numbers.", {"metavar": "N"}),
    "rate": (TRACK, "Frames per second; overrides the times of the file.", {"flags": ("--rate", "--fps")}),
    "scale": (TRACK, "Metres per unit of the file: 0.0005, or 0.5mm; of a film also gravity.", {}),
    "balls": (TRACK, "Measure balls that strike balls at rest, not balls at walls.", {}),
    "view": (TRACK, "above (balls on a table) or side (balls in flight).", {"metavar": "above|side"}),
    "noise": (TRACK, "Error of one coordinate in one frame: 0.0003 (m), or 0.3mm.", {}),
    "length": (FILM, "Two points of the picture, px, and their distance.", {"metavar": "X1,Y1,X2,Y2=1m"}),
    "readout": (
        FILM,
        "Time from the camera's first row to its last, s.",
        {"unit": "s", "show_default": "from the flights"},
    ),
    "ball": (FILM, "A place of the ball, px, at a time, s; once for each ball.", {"metavar": "X,Y@T"}),
    "colour": (FILM, "Colour of the balls, such as '#e0b020'.", {"metavar": "#RRGGBB"}),
    "region": (FILM, "Part of the picture in which balls move, px.", {"metavar": "X0,Y0,X1,Y1"}),
    "start": (FILM, "Begin at this time of the film, s.", {"flags": ("--from",), "unit": "s"}),
    "end": (FILM, "End at this time of the film, s.", {"flags": ("--to",), "unit": "s"}),
    "kind": (REBOUNDS, "planar (ball in flight) or table (ball on a table).", {"metavar": "planar|table"}),
    "sigma_v": (REBOUNDS, "Standard error of speeds, m/s.", {"unit": "m/s"}),
    "sigma_spin": (REBOUNDS, "Standard error of spins, rad/s.", {"unit": "rad/s"}),
    "allow_own_laws": (RUN, "Execute the Python files that the scene names as laws.", {"flags": ("--allow-own-laws",)}),
    "json": (OUTPUT, "Print JSON on standard output, and nothing else.", {"flags": ("--json",)}),
    "quiet": (OUTPUT, "Print nothing but errors.", {"flags": ("--quiet",)}),
    "force": (OUTPUT, "Overwrite a file that exists.", {"flags": ("--force",)}),
    "plot": (OUTPUT, "Draw a figure: .svg, .pdf or .png.", {"metavar": "FILE"}),
}


def option(panel: str, text: str, *flags: str, unit: str | None = None, **more: Any) -> Any:
    """Return an option under a heading of the help, for ``Annotated``.

    ``unit`` is the SI unit of a value that may be given with another; ``more`` are further arguments of typer.Option.
    """
    settings = quantity(flags[0], unit) if unit else {}
    return typer.Option(*flags, help=text, rich_help_panel=panel, **settings | more)


def shared(name: str, default: str | None = None, **changes: Any) -> Any:
    """Return the option with this name in the table, for ``Annotated``.

    ``default`` is shown in the help in place of the parameter's default if that is None. ``changes`` override arguments of
    typer.Option for a command in which the option has a more specific meaning (``help``, ``rich_help_panel``).
    """
    panel, text, more = _SHARED[name]
    settings = {**more, **changes}
    flag = f"--{name.replace('_', '-')}"
    flags = settings.pop("flags", (flag,) if "unit" in settings else ())
    if settings.pop("whole", False):
        settings["parser"] = functools.partial(parse_whole, flag)
    if default is not None:
        settings["show_default"] = default
    return option(settings.pop("rich_help_panel", panel), settings.pop("help", text), *flags, **settings)


def parse_scale(text: str | None) -> float | str | None:
    """Return a length in m from a text with or without a unit, or "gravity"."""
    return text if text == "gravity" else parse_length("scale", text)


def of_films(**given: Any) -> dict[str, Any]:
    """Return the options of films that were given, as arguments of ``carom.track_film``."""
    return {name: value for name, value in given.items() if value not in (None, [], ())}


def comma_separated(text: str) -> list[str]:
    """Return the non-empty parts between commas."""
    return [part.strip() for part in text.split(",") if part.strip()]


def parse_length(name: str, text: str | None) -> float | None:
    """Return a length in m from a text with or without a unit."""
    if text is None:
        return None
    value = parse_with_unit(f"--{name}", "m", text)
    if not math.isfinite(value):
        raise CaromError(_no_quantity(f"--{name}", "m", text))
    return value


def parse_with_unit(option: str, unit: str, text: str | float) -> float:
    """Return the value of an option in an SI unit, from a text with or without a unit; the library checks its range."""
    from carom.core.units import parse_quantity

    try:
        return float(text)
    except ValueError:
        pass
    try:
        return parse_quantity(str(text), unit)
    except ValueError:
        raise CaromError(_no_quantity(option, unit, text)) from None


def _no_quantity(option: str, unit: str, text: str | float) -> str:
    what, such = _QUANTITIES[unit]
    return f"{option}: expected {what}, such as {such}, got {str(text)!r}"


def quantity(option: str, unit: str) -> dict[str, Any]:
    """Return the arguments of typer.Option for a value that may have a unit: ``--radius 0.0286`` or ``--radius 28.6mm``."""
    what = _QUANTITIES[unit][0].partition(" ")[2]
    return {"parser": functools.partial(parse_with_unit, option, unit), "metavar": what.replace(" ", "_").upper()}


def parse_whole(option: str, text: str | int) -> int:
    """Return a whole number, which may be written as 20000, 20_000 or 2e4."""
    if isinstance(text, int):
        return text
    try:
        value = float(text)
    except ValueError:
        value = math.nan
    if not (math.isfinite(value) and value == math.floor(value)):
        raise CaromError(f"{option}: expected a whole number, such as 20000 or 2e4, got {text!r:.60}")
    return int(text) if text.lstrip("+-").isdecimal() else int(value)


def parse_assignments(faults: FaultList, option: str, texts: list[str] | None) -> Iterator[tuple[str, str]]:
    """Yield names and values of repeated NAME=VALUE; the library knows the names."""
    for text in texts or []:
        name, equals, value = text.partition("=")
        if not equals:
            faults.add(option, "NAME=...", repr(text))
        else:
            yield name, value


def parse_number(option: str, name: str, text: str) -> float:
    """Return the number of NAME=VALUE."""
    try:
        return float(text)
    except ValueError:
        raise CaromError(f"{option}: {name}: expected a number, got {text!r}") from None


def parse_pair(option: str, text: str, between: str = ",") -> tuple[float, float]:
    """Return the two numbers of X,Y."""
    first, _sign, second = text.partition(between)
    try:
        return float(first), float(second)
    except ValueError:
        raise CaromError(f"{option}: expected two numbers, such as 1.2{between}0.4, got {text!r:.60}") from None


def parse_bounds(name: str, text: str) -> tuple[float, float]:
    """Return the two numbers of NAME=LOW:HIGH."""
    low, _, high = text.partition(":")
    try:
        found = float(low), float(high)
    except ValueError:
        found = (1.0, 0.0)
    if not found[0] < found[1]:
        raise CaromError(f"--bound: {name}: expected LOW:HIGH, LOW below HIGH, got {text!r}")
    return found


# ----------------------------------------------------------------------------------------------------
# Shared by commands: collection of errors, the console, and checks of output files before a run.


def tick(console: Console, good: bool) -> str:
    """Return a tick or a cross; yes or no if the output has no such characters."""
    if console.encoding.startswith("utf"):
        return "✓" if good else "✗"
    return "yes" if good else "no"


def tell(ranking: Any, show: Callable[[Any], None], as_json: bool, console: Console, written: Sequence[Path]) -> None:
    """Print a ranking of laws, as JSON or by ``show``; on the console also its notes, and the paths of files that were written."""
    if as_json:
        say_json(ranking.as_dict())
    else:
        show(ranking)
    for text in ranking.notes:
        console.print(f"note: {text}", style="yellow", soft_wrap=True)
    wrote(*written)


def wrote(*paths: Path) -> None:
    """Print the names of files that were written, on standard error."""
    for path in paths:
        note(f"written: {path}")


def write_files(
    found: FaultList, result: Any, actions: Sequence[tuple[Path | None, Callable[[Any, Path], None]]]
) -> list[Path]:
    """Write the files of a result that were asked for; return the paths of those written, and add the faults to ``found``."""
    written = []
    for path, action in actions:
        if path is not None:
            with collected(found):
                action(result, path)
                written.append(path)
    return written


def write_report_page(write: Callable[[], Path], say: Callable[[str, float], None]) -> Path:
    """Write a requested report and return its path; CaromError if Matplotlib is missing."""
    require_library("matplotlib", "--report")
    say("report", 1.0)
    return write()


PICTURES = (".svg", ".pdf", ".png")
GAS_FILMS = (".svg", ".gif", ".mp4")
LIBRARIES = {
    **dict.fromkeys((*PICTURES, ".mp4", ".gif"), ("matplotlib",)),
    **dict.fromkeys((".parquet", ".pq"), ("pyarrow",)),
    ".gsd": ("gsd",),
}
"""The optional libraries that a file needs, by its ending."""


def require_outputs(
    found: FaultList,
    named: dict[str, Path | None],
    kinds: dict[str, tuple[str, ...]] | None = None,
    source: Path | None = None,
) -> None:
    """Add to ``found`` why the files that options name cannot be written.

    ``kinds`` are the endings that an option accepts; other options accept the endings of figures. The libraries that a file
    requires must be installed. ``source`` is an input file, which must not be overwritten.
    """
    seen: dict[Path, str] = {}
    for option, path in named.items():
        if path is None:
            continue
        endings = (kinds or {}).get(option, PICTURES)
        faults = FaultList()
        faults.attempt(lambda path=path, endings=endings: require_writable(path, endings, source=source))
        found += [of_option(option, fault) for fault in faults]
        for library in LIBRARIES.get(path.suffix.lower(), ()) if not faults else ():
            found.attempt(require_library, library, option)
        if (other := seen.setdefault(path.absolute(), option)) != option:
            found.add(f"{option} {path}", f"another file than {other}'s", "the same", "name a new one")


def of_option(option: str, fault: Fault) -> Fault:
    """Return the fault of a file with the option that names it in front of its name."""
    return Fault(advice=f"{option} {fault}")
