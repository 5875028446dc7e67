"""``carom figures``: the paper's Figures 1 to 3, redrawn."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import Annotated

import typer


def register(app: typer.Typer) -> None:
    """Add the verb to the command."""
    app.command("figures")(figures)


def figures(
    out: Annotated[
        Path, typer.Option("--out", metavar="DIR", help="Where to write; made if it does not exist.")
    ] = Path(),
) -> None:
    """Redraw the paper's Figures 1 to 3 as SVG and PDF."""
    from carom import plot

    for path in plot.figures(out):
        sys.stdout.write(f"{path}\n")
