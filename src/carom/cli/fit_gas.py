"""``carom fit gas``: restitution and friction of a gas's balls, from their tracks."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from carom.cli.options import OUTPUT, shared


def register(app: typer.Typer) -> None:
    """Add the verb."""
    app.command(name="fit gas")(fit_gas)


def fit_gas(
    file: Annotated[
        Path,
        typer.Argument(
            metavar="FILE",
            help="Tracks: columns t, ball, x, y, z, wx, wy, wz.",
        ),
    ],
    scene: Annotated[Path, typer.Option(metavar="SCENE.toml", help="The gas: container and balls.")],
    as_json: Annotated[bool, shared("json", rich_help_panel=OUTPUT)] = False,
) -> None:
    """Infer restitution, friction and tangential restitution of a gas from tracks of its balls.

    Example: carom fit gas tracks.csv --scene gas.toml.
    """
    from carom.cli.streams import say, say_json, say_notes
    from carom.files import require_library

    require_library("scipy", "fit")
    from carom.fitting.gas import fit_gas as infer
    from carom.fitting.result import with_error_bar

    found = infer(file, scene)
    if as_json:
        say_json(found.to_dict())
        return
    say_notes(found.notes)
    for name, one in found.estimates().items():
        say(f"{name.replace('_', ' ')}  {with_error_bar(one)}")
