"""``carom explore``: the explorer, as one HTML file that opens in the browser."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from carom.cli.common import require_outputs, wrote
from carom.cli.options import OUTPUT, RUN, comma_separated, shared
from carom.errors import FaultList


def register(app: typer.Typer) -> None:
    """Add the verb to the command."""
    app.command()(explore)


def explore(
    scene: Annotated[
        Path | None, typer.Argument(metavar="SCENE.toml", help="A scene file. Default: the paper's example.")
    ] = None,
    laws: Annotated[
        str | None,
        typer.Option(
            metavar="NAME,NAME...",
            help="Laws that are shown at first. Default: the scene's own laws, and the laws of carom compare for its walls.",
            rich_help_panel=RUN,
        ),
    ] = None,
    data: Annotated[
        Path | None,
        typer.Option(
            metavar="REBOUNDS.csv",
            help="Measured rebounds, drawn over the laws' curves. These are not fitted to them: they are for the restitution and"
            " friction of the scene, and of the page's sliders.",
            rich_help_panel=RUN,
        ),
    ] = None,
    film: Annotated[
        Path | None,
        typer.Option(
            metavar="FILM",
            help="A track file of one shot, in the coordinates of the scene: dots beside the balls' paths.",
            rich_help_panel=RUN,
        ),
    ] = None,
    shot: Annotated[
        str | None, typer.Option(metavar="NAME", help="Its name in a film of several shots.", rich_help_panel=RUN)
    ] = None,
    out: Annotated[
        Path | None,
        typer.Option(
            metavar="FILE.html", help="File to write.", show_default="carom_explorer.html", rich_help_panel=OUTPUT
        ),
    ] = None,
    no_open: Annotated[
        bool, typer.Option("--no-open", help="Write the file, and open no browser.", rich_help_panel=OUTPUT)
    ] = False,
    quiet: Annotated[bool, shared("quiet")] = False,
) -> None:
    """Write a page in which a ball is thrown by hand and every law is watched at once, and open it in the browser."""
    from carom.explorer.page import explore as make_page

    found = FaultList()
    target = out or Path("carom_explorer.html")
    require_outputs(found, {"--out": target}, {"--out": (".html", ".htm")})
    page = found.attempt(make_page, scene, None if laws is None else comma_separated(laws), data, film, shot)
    found.raise_if_any()
    page.save(target)
    if not quiet:
        wrote(target)
    if not no_open:
        _open(target)


def _open(path: Path) -> None:
    import webbrowser

    from carom.cli.streams import note

    if not webbrowser.open(path.absolute().as_uri()):
        note(f"note: no browser was found; open {path} in one")
