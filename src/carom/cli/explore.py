"""``carom explore``: the explorer, as one HTML file that opens in the browser."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from carom.cli.options import OUTPUT, option, require_outputs, shared, wrote
from carom.cli.parameters import Given, of_library


@of_library("explorer.page:explore")
def explore(
    scene: Annotated[
        Path | None, typer.Argument(metavar="SCENE.toml", help="A scene file. Default: the paper's example.")
    ] = None,
    *,
    given: Given,
    out: Annotated[
        Path | None, option(OUTPUT, "File to write.", metavar="FILE.html", show_default="carom_explorer.html")
    ] = None,
    no_open: Annotated[bool, option(OUTPUT, "Write the file, and open no browser.", "--no-open")] = False,
    quiet: Annotated[bool, shared("quiet")] = False,
) -> None:
    """Write an interactive page that compares all laws as you drag the ball, and open it in the browser."""
    from carom.explorer.page import explore as make_page

    found = given.faults
    target = out or Path("carom_explorer.html")
    require_outputs(found, {"--out": target}, {"--out": (".html", ".htm")})
    page = found.attempt(lambda: make_page(scene, **given))
    found.raise_if_any()
    assert page is not None
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
