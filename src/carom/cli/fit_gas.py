"""``carom fit gas``: restitution and friction of a gas's balls, from their tracks or from the gas's temperatures."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from carom.cli.options import OUTPUT, RUN, comma_separated, option, shared


def register(app: typer.Typer) -> None:
    """Add the verb."""
    app.command(name="fit gas")(fit_gas)


def fit_gas(
    file: Annotated[
        Path,
        typer.Argument(
            metavar="FILE",
            help="Tracks (columns t, ball, x, y, z, wx, wy, wz), or curves (t and temperature, temperature_rotational, ratio).",
        ),
    ],
    scene: Annotated[
        Path, typer.Option(metavar="SCENE.toml", help="The gas: container, balls, and what is not inferred.")
    ],
    names: Annotated[
        str | None,
        option(RUN, "What a curve is to tell: restitution, friction, tangential_restitution.", metavar="NAME,NAME"),
    ] = None,
    simulations: Annotated[int, option(RUN, "Gases simulated in each of four rounds, for a curve.")] = 80,
    seed: Annotated[int, shared("seed", default="0", help="Seed of the simulations.", rich_help_panel=RUN)] = 0,
    as_json: Annotated[bool, shared("json", rich_help_panel=OUTPUT)] = False,
) -> None:
    """Infer restitution, friction and tangential restitution of a gas from tracks of its balls, or from its cooling.

    Examples: carom fit gas tracks.csv --scene gas.toml; carom fit gas cooling.csv --scene gas.toml --names restitution.
    """
    from carom.cli.console import err
    from carom.cli.progress import working
    from carom.cli.streams import say, say_json, say_notes
    from carom.files import require_library

    require_library("scipy", "fit")
    from carom.fitting.gas_fit import fit_gas as infer
    from carom.fitting.result import with_error_bar

    wanted = None if names is None else comma_separated(names)
    with working("fit gas", err()) as update:
        found = infer(file, scene, names=wanted, simulations=simulations, seed=seed, progress=update)
    if as_json:
        say_json(found.to_dict())
        return
    say_notes(found.notes)
    for name, one in found.estimates().items():
        say(f"{name.replace('_', ' ')}  {with_error_bar(one, interval=True)}")
