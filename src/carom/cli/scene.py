"""``carom scene``: a scene to begin with; all that is wrong with one."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import Annotated

import typer


def register(app: typer.Typer) -> None:
    """Add the verbs to the command."""
    scene = typer.Typer(help="Scene files: write one to begin with, check one.", no_args_is_help=True)
    scene.command("new")(new)
    scene.command("check")(check)
    app.add_typer(scene, name="scene")


def new(
    file: Annotated[Path | None, typer.Argument(metavar="[FILE]", help="Where to; left out: standard output.")] = None,
    gas: Annotated[bool, typer.Option("--gas", help="A gas of balls, for carom gas.")] = False,
    force: Annotated[bool, typer.Option("--force", help="Write over a file that is there.")] = False,
) -> None:
    """Write a commented scene that runs as it stands: one ball on a carom table; or a gas."""
    from carom.cli.shared import wrote
    from carom.errors import CaromError
    from carom.files import whole
    from carom.gas.toml import new_gas
    from carom.scene.toml import new_scene

    text = new_gas() if gas else new_scene()
    if file is None:
        sys.stdout.write(text)
        return
    if file.is_dir():
        raise CaromError(f"{file}: expected a file to write, got a folder; name a file in it")
    if file.exists() and not force:
        raise CaromError(f"{file}: expected a new file, got one that is there; --force writes over it")
    with whole(file) as part:
        part.write_text(text, encoding="utf-8")
    wrote(file)


def check(file: Annotated[Path, typer.Argument(metavar="FILE", help="A scene, as TOML.")]) -> None:
    """Say all that is wrong with a scene, at once; or what it is."""
    from carom.gas.toml import is_gas, load_gas
    from carom.scene.toml import load_scene

    if is_gas(file):
        from carom.gas.build import build

        gas = load_gas(file)
        build(gas, str(file))
        sys.stdout.write(f"{file}: {gas.describe()}: ok\n")
        return
    scene = load_scene(file)
    sys.stdout.write(f"{file}: {scene.describe()}: ok\n")
