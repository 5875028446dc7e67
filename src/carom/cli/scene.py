"""``carom scene``: write a first scene file, and validate one."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import Annotated, Any

import typer

from carom.cli.options import quantity, shared, write_new
from carom.cli.streams import say, say_json, say_notes
from carom.errors import CaromError


def new(
    file: Annotated[
        Path | None, typer.Argument(metavar="FILE", help="File to write. Default: standard output.")
    ] = None,
    gas: Annotated[bool, typer.Option("--gas", help="A gas of balls, for carom gas.")] = False,
    table: Annotated[
        str | None,
        typer.Option("--table", metavar="NAME", help="A real table with its balls and cloth; --table list names all."),
    ] = None,
    rack: Annotated[
        str | None,
        typer.Option(
            "--rack",
            metavar="NAME",
            help="The rack of a pool table: 8-ball, 9-ball or 10-ball. Default: fifteen balls in the order of their numbers.",
        ),
    ] = None,
    break_speed: Annotated[
        float | None,
        typer.Option(
            "--break",
            help='Speed of the cue ball in the break on a pool table, m/s, or "30 km/h". Default: 9.5.',
            **quantity("--break", "m/s"),
        ),
    ] = None,
    force: Annotated[bool, shared("force")] = False,
) -> None:
    """Write a commented scene that runs as it stands: one ball on a carom table; a real table by name; or a gas."""
    from carom.gas.scene import gas_text
    from carom.scene.toml import scene_text

    if table is not None and gas:
        raise CaromError("--table: expected a scene of single balls, got --gas as well; give one of the two")
    if table is None and (rack, break_speed) != (None, None):
        option = "--rack" if rack is not None else "--break"
        raise CaromError(f"{option}: expected a pool table with it, got no --table; add --table pool-9ft")
    if rack == "list":
        from carom.scene.openings import RACKS

        sys.stdout.write("".join(f"{name}\n" for name in RACKS))
        return
    if table == "list":
        from carom.scene.presets import presets

        sys.stdout.write("".join(f"{name:<18}{preset.title}\n" for name, preset in presets().items()))
        return
    text = gas_text() if gas else scene_text(table, rack=rack, break_speed=break_speed)
    write_new(file, text, force)


def check(
    file: Annotated[Path, typer.Argument(metavar="FILE", help="A scene, as TOML.")],
    allow_own_laws: Annotated[bool, shared("allow_own_laws")] = False,
    as_json: Annotated[bool, shared("json")] = False,
) -> None:
    """Validate a scene and summarise it; or print it in full, in SI units, with every default filled in."""
    from carom.gas.scene import is_gas, load_gas
    from carom.scene.openings import scene_notes
    from carom.scene.scene import plain_model, scene_dict
    from carom.scene.toml import load_scene

    gas = is_gas(file)
    scene: Any = load_gas(file) if gas else load_scene(file, allow_own_laws=allow_own_laws)
    if gas:
        from carom.gas.session import build

        build(scene)
    if as_json:
        say_json(plain_model(scene) if gas else scene_dict(scene))
        return
    say(f"{file}: {scene.describe()}: ok")
    say_notes(scene.notes() if gas else scene_notes(scene))
