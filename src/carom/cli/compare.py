"""``carom compare``: one incoming ball, all laws side by side."""

from __future__ import annotations

import json
import math
import sys
from pathlib import Path
from typing import Annotated, Any, Literal

import typer

from carom.cli.places import require_drawable
from carom.cli.shared import attempt, wrote
from carom.errors import CaromError

BALL, WALL, FLOOR, SHOWN = "The ball", "The wall", "The floor", "What is shown"


def register(app: typer.Typer) -> None:
    """Add the verb to the command."""
    app.command("compare")(compare)


def compare(
    speed: Annotated[float, typer.Option(help="Along the floor, m/s.", rich_help_panel=BALL)] = 1.0,
    angle: Annotated[float, typer.Option(help="From the wall's normal, degrees.", rich_help_panel=BALL)] = 45.0,
    spin_z: Annotated[float, typer.Option(help="About the vertical, rad/s.", rich_help_panel=BALL)] = 0.0,
    spin_x: Annotated[float | None, typer.Option(help="rad/s; left out: rolling.", rich_help_panel=BALL)] = None,
    spin_y: Annotated[float | None, typer.Option(help="rad/s; left out: rolling.", rich_help_panel=BALL)] = None,
    sliding: Annotated[
        bool, typer.Option("--sliding", help="It slides: spin-x, spin-y are 0 where left out.", rich_help_panel=BALL)
    ] = False,
    vertical_speed: Annotated[float, typer.Option(help="Upwards at the wall, m/s.", rich_help_panel=BALL)] = 0.0,
    height: Annotated[float, typer.Option(help="Above the floor at the wall, m.", rich_help_panel=BALL)] = 0.0,
    inertia: Annotated[
        str, typer.Option(metavar="NAME|KAPPA", help="solid, hollow, or I/(m a^2).", rich_help_panel=BALL)
    ] = "solid",
    radius: Annotated[float, typer.Option(help="m.", rich_help_panel=BALL)] = 0.02625,
    mass: Annotated[float, typer.Option(help="kg.", rich_help_panel=BALL)] = 0.1406,
    restitution: Annotated[float, typer.Option(help="0 to 1.", rich_help_panel=WALL)] = 1.0,
    friction: Annotated[float, typer.Option(help="Coefficient; inf: never slips.", rich_help_panel=WALL)] = math.inf,
    tangential_restitution: Annotated[
        float, typer.Option(help="-1 to 1: 0 stops the slip, 1 returns it.", rich_help_panel=WALL)
    ] = 0.0,
    stiffness_ratio: Annotated[
        float, typer.Option(help="Along the surface over normally, for maw and stronge.", rich_help_panel=WALL)
    ] = 14 / 17,
    cushion_height: Annotated[
        float | None,
        typer.Option(
            "--cushion-height",
            "--contact-height",
            rich_help_panel=WALL,
            help="Where it touches, in radii above the floor; left out: 1. Billiard cushions: 1.25 to 1.4, with"
            " --friction 0.14 to 0.2 and --floor-friction 0.2.",
        ),
    ] = None,
    floor_restitution: Annotated[float, typer.Option(help="0 to 1.", rich_help_panel=FLOOR)] = 0.0,
    floor_friction: Annotated[
        float, typer.Option(help="Coefficient; inf: never slips.", rich_help_panel=FLOOR)
    ] = math.inf,
    gravity: Annotated[float, typer.Option(help="m/s^2.", rich_help_panel=FLOOR)] = 9.80665,
    floor_contact: Annotated[
        str,
        typer.Option(
            metavar="with|after", help="A ball pressed down: both at once, or in turn.", rich_help_panel=FLOOR
        ),
    ] = "with",
    law: Annotated[
        list[str] | None,
        typer.Option(
            metavar="NAME", help="Only this law, or your own: my_law.py:law; may be repeated.", rich_help_panel=SHOWN
        ),
    ] = None,
    as_json: Annotated[
        bool, typer.Option("--json", help="JSON on standard output, nothing else.", rich_help_panel=SHOWN)
    ] = False,
    plot: Annotated[
        Path | None,
        typer.Option(metavar="FILE", help="Draw it: .svg, .pdf or .png.", rich_help_panel=SHOWN),
    ] = None,
) -> None:
    """One ball meets a wall: what each law says, and what speaks against it. The paper's example by default."""
    from carom import comparison as library
    from carom.own_law import find_law

    contact: Literal["with", "after"] = floor_contact  # type: ignore[assignment]  # the library says what it takes
    settings: dict[str, Any] = {
        "speed": speed, "angle": angle, "spin_x": spin_x, "spin_y": spin_y, "spin_z": spin_z, "sliding": sliding,
        "vertical_speed": vertical_speed, "height": height, "inertia": _inertia(inertia), "radius": radius,
        "mass": mass, "restitution": restitution, "friction": friction, "tangential_restitution": tangential_restitution,
        "cushion_height": cushion_height, "floor_restitution": floor_restitution, "floor_friction": floor_friction,
        "gravity": gravity, "floor_contact": contact, "stiffness_ratio": stiffness_ratio,
    }  # fmt: skip
    # every fault at once, and before anything is written
    found: list[str] = []
    if plot is not None:
        attempt(found, require_drawable, plot)
    laws = [attempt(found, find_law, name) for name in law] if law else None
    meeting = attempt(found, lambda: library.incoming(**settings))
    if found:
        raise CaromError(*found)
    comparison = library.compare(meeting, laws)
    if plot is not None:
        from carom import plot as pictures

        pictures.save(pictures.compare(comparison), plot)
        wrote(plot)
    if as_json:
        sys.stdout.write(json.dumps(comparison.as_dict(), indent=2, allow_nan=False) + "\n")
    else:
        from carom.cli.comparison_table import show

        show(comparison)


def _inertia(text: str) -> str | float:
    try:
        return float(text)
    except ValueError:
        return text
