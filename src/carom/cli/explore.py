"""``carom explore``: the explorer, as one HTML file that opens in the browser."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from carom.cli.options import OUTPUT, RUN, comma_separated, option, require_outputs, shared, wrote
from carom.errors import FaultList


def explore(
    scene: Annotated[
        Path | None, typer.Argument(metavar="SCENE.toml", help="A scene file. Default: the paper's example.")
    ] = None,
    laws: Annotated[
        str | None,
        option(
            RUN,
            "Laws that are shown at first. Default: the scene's own laws, and the laws of carom compare for its walls.",
            metavar="NAME,NAME...",
        ),
    ] = None,
    data: Annotated[
        Path | None,
        option(
            RUN,
            "Measured rebounds, drawn over the laws' curves. These are not fitted to them: they are for the restitution and"
            " friction of the scene, and of the page's sliders.",
            metavar="REBOUNDS.csv",
        ),
    ] = None,
    film: Annotated[
        Path | None,
        option(
            RUN,
            "A track file of one shot, in the coordinates of the scene: dots beside the balls' paths.",
            metavar="FILM",
        ),
    ] = None,
    shot: Annotated[str | None, option(RUN, "Its name in a film of several shots.", metavar="NAME")] = None,
    out: Annotated[
        Path | None, option(OUTPUT, "File to write.", metavar="FILE.html", show_default="carom_explorer.html")
    ] = None,
    no_open: Annotated[bool, option(OUTPUT, "Write the file, and open no browser.", "--no-open")] = False,
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
