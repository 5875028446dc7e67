"""Options that several commands have, each defined once; and the parsers of their values."""

from __future__ import annotations

import contextlib
import functools
import math
import sys
import tomllib
from collections.abc import Callable, Iterator, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import typer

from carom.cli.streams import note, say_json
from carom.errors import CaromError, Fault, FaultList, collected
from carom.files import require_library, require_writable, write_text
from carom.public.own_laws import with_own_laws

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
IN_RADII = "RADII|LENGTH"  # a height of a contact
LEAST_RADII = 0.1  # a number below is a length whose unit was left out


def in_radii(option: str, text: str, radius: float | None) -> float:
    """Return the height of a contact in radii of the ball: a number of them, or a length with its unit."""
    from carom.core.units import decimal_point

    expected = "radii of the ball, such as 1.25, or a length with its unit, such as 37mm"
    try:
        height = float(decimal_point(text))
    except ValueError:
        try:
            length = parse_with_unit(option, "m", text)
        except CaromError:
            raise CaromError(Fault("", option, expected, repr(text))) from None
        if not radius:
            raise CaromError(Fault("", option, "`radius` beside a length", "none")) from None
        return length / radius
    if 0 < height < LEAST_RADII:
        raise CaromError(Fault("", option, expected, text, f"for a length write {1000 * height:g}mm"))
    return height


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


# Options that several verbs declare: heading, help, and further arguments of typer.Option.
_SHARED: dict[str, tuple[str, str, dict[str, Any]]] = {
    "duration": (RUN, "Duration; overrides the scene's.", {"metavar": "T"}),
    "max_events": (RUN, "Largest number of events; overrides the scene's.", {"metavar": "N", "whole": True}),
    "seed": (RUN, "Seed of the random numbers.", {"metavar": "N"}),
    "set": (
        RUN,
        "Another value for numbers of the scene, such as walls.*.restitution=0.8 or balls.0.velocity=[2,1]; may be repeated.",
        {"flags": ("--set",), "metavar": "PATH=VALUE"},
    ),
    "allow_own_laws": (RUN, "Execute the Python files that the scene names as laws.", {"flags": ("--allow-own-laws",)}),
    "json": (OUTPUT, "Print JSON on standard output, and nothing else.", {"flags": ("--json",)}),
    "quiet": (OUTPUT, "Print nothing but errors.", {"flags": ("--quiet",)}),
    "force": (OUTPUT, "Overwrite a file that exists.", {"flags": ("--force",)}),
    "plot": (OUTPUT, "Draw a figure: .svg, .pdf or .png.", {"metavar": "FILE"}),
}

# What only the command line has of the library's parameters (carom.cli.parameters): their headings in the help ...
_NAMES = {
    BALL: "radius mass inertia kappa height speed angle_deg spin_x spin_y spin_z sliding vertical_speed",
    WALL: "restitution friction tangential_restitution stiffness_ratio contact_height normal truth",
    FLOOR: "floor_restitution floor_friction floor_tangential_restitution floor_contact gravity rolling_resistance slope",
    RUN: "seed starts law",
    TRACK: "format scale rate down view balls noise wall hard drag_per_metre window blind",
    FILM: "length readout ball colour region corners picture_height start end marks",
    REBOUNDS: "kind stage where by sigma_v sigma_spin spin every_contact scatter suffix strict",
}
SPLIT = ("laws", "fit", "itinerary")  # at commas
PANELS = {name: panel for panel, names in _NAMES.items() for name in names.split()}

# ... and further arguments of typer.Option.
OPTIONS: dict[str, dict[str, Any]] = {
    "inertia": {"metavar": "solid|hollow|KAPPA"},
    "contact_height": {"flags": ("--contact-height", "--cushion-height"), "metavar": IN_RADII},
    "floor_contact": {"metavar": "with|after"},
    "floor_friction": {"flags": ("--floor-friction", "--cloth")},
    "rolling_resistance": {"flags": ("--rolling-resistance", "--rolling")},
    "rate": {"flags": ("--rate", "--fps")},
    "view": {"metavar": "above|side"},
    "down": {"flags": ("--down/--up",)},
    "hard": {"flags": ("--hard",)},
    "slope": {"metavar": "X,Y"},
    "length": {"metavar": "X1,Y1,X2,Y2=1m"},
    "ball": {"metavar": "X,Y@T"},
    "colour": {"metavar": "#RRGGBB"},
    "region": {"metavar": "X0,Y0,X1,Y1"},
    "corners": {"metavar": "X1,Y1,...,X4,Y4=2.84mx1.42m@37mm"},
    "marks": {"flags": ("--marks",)},
    "start": {"flags": ("--from",)},
    "end": {"flags": ("--to",)},
    "kind": {"metavar": "planar|table"},
    "scatter": {"metavar": "share|absolute"},
    "laws": {"metavar": "NAME,NAME"},
    "fit": {"metavar": "NAME,NAME"},
    "itinerary": {"metavar": "AB,ABC"},
    "bounces": {"metavar": "N", "parser": functools.partial(parse_whole, "--bounces")},
    "fix": {"metavar": "NAME=VALUE"},
    "truth": {"metavar": "NAME=VALUE"},
    "errors": {"metavar": "NAME=SIGMA", "flags": ("--error",)},
    "bound": {"metavar": "NAME=LOW:HIGH"},
    "where": {"metavar": "COLUMN=VALUE"},
    "by": {"metavar": "COLUMN"},
    "table": {"metavar": "SCENE.toml"},
    "angles_deg": {"metavar": "LOW:HIGH"},
    "speeds": {"metavar": "LOW:HIGH"},
    "spins": {"metavar": "LOW:HIGH|unknown"},
    "seed": {"metavar": "N"},
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


def comma_separated(text: str) -> list[str]:
    """Return the non-empty parts between commas."""
    return [part.strip() for part in text.split(",") if part.strip()]


def parse_with_unit(option: str, unit: str, text: str | float) -> float:
    """Return the value of an option in an SI unit, from a text with or without a unit; the library checks its range."""
    from carom.core.units import decimal_point, parse_quantity

    text = decimal_point(str(text))
    try:
        with contextlib.suppress(ValueError):
            return float(text)
        return parse_quantity(text, unit)
    except ValueError:
        what, such = _QUANTITIES[unit]
        raise CaromError(f"{option}: expected {what}, such as {such}, got {text!r}") from None


def quantity(option: str, unit: str) -> dict[str, Any]:
    """Return the arguments of typer.Option for a value that may have a unit: ``--radius 0.0286`` or ``--radius 28.6mm``."""
    what = _QUANTITIES[unit][0].partition(" ")[2]
    return {"parser": functools.partial(parse_with_unit, option, unit), "metavar": what.replace(" ", "_").upper()}


def parse_assignments(faults: FaultList, option: str, texts: list[str] | None) -> Iterator[tuple[str, str]]:
    """Yield names and values of repeated NAME=VALUE; the library knows the names."""
    for text in texts or []:
        name, equals, value = text.partition("=")
        if not equals:
            faults.add(option, "NAME=...", repr(text))
        else:
            yield name, value


def assigned(found: FaultList, texts: list[str] | None) -> dict[str, Any]:
    """Return the values of PATH=VALUE by their paths, as in a scene file, text without quotes as it is; faults to ``found``."""
    from carom.core.units import decimal_point

    values: dict[str, Any] = {}
    for text in texts or []:
        path, equals, value = (part.strip() for part in text.partition("="))
        if not (path and equals and value):
            found.add("--set", "PATH=VALUE, such as walls.*.restitution=0.8", repr(text))
            continue
        try:
            values[path] = tomllib.loads(f"value = {decimal_point(value)}")["value"]
        except (tomllib.TOMLDecodeError, RecursionError):
            values[path] = value
    return dict(with_own_laws(values))


def parse_number(option: str, name: str, text: str) -> float:
    """Return the number of NAME=VALUE."""
    from carom.core.units import decimal_point

    try:
        return float(decimal_point(text))
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
    with contextlib.suppress(CaromError):
        low, high = parse_pair("--bound", text, ":")
        if low < high:
            return low, high
    raise CaromError(f"--bound: {name}: expected LOW:HIGH, LOW below HIGH, got {text!r}")


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


def write_new(file: Path | None, text: str, force: bool) -> None:
    """Write a text to a new file, or to standard output where none is named."""
    if file is None:
        sys.stdout.write(text)
        return
    if file.is_file() and not force:
        raise CaromError(f"{file}: expected a new file, got one that exists; --force overwrites it")
    write_text(file, text)
    wrote(file)


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
        faults = FaultList()
        faults.attempt(require_writable, path, (kinds or {}).get(option, PICTURES), source=source)
        found += [of_option(option, fault) for fault in faults]
        for library in LIBRARIES.get(path.suffix.lower(), ()) if not faults else ():
            found.attempt(require_library, library, option)
        if (other := seen.setdefault(path.absolute(), option)) != option:
            found.add(f"{option} {path}", f"another file than {other}'s", "the same", "name a new one")


def of_option(option: str, fault: Fault) -> Fault:
    """Return the fault of a file with the option that names it in front of its name."""
    return Fault(advice=f"{option} {fault}")
