"""``python -m carom.interop.pooltool play``: pooltool's own game, with carom's laws."""

from __future__ import annotations

import sys
from typing import Annotated

import typer

from carom.bodies import Surface
from carom.errors import CaromError
from carom.formatting import escape_controls
from carom.interop.pooltool.engine import engine, use_as_default

app = typer.Typer(add_completion=False, no_args_is_help=True)


@app.callback()
def main() -> None:
    """pooltool with carom's laws."""


@app.command()
def play(
    context: typer.Context,
    cushion: Annotated[str, typer.Option(help="Law of the cushions, as listed by `carom laws`.")] = "two-step",
    restitution: Annotated[float | None, typer.Option(help="Of the cushions. Default: the balls' own e_c.")] = None,
    friction: Annotated[float | None, typer.Option(help="Of the cushions. Default: the balls' own f_c.")] = None,
    own_balls: Annotated[bool, typer.Option(help="Keep pooltool's model where balls meet.")] = False,
) -> None:
    """Open pooltool's game; shots are played with carom's laws. Nothing of pooltool's settings is changed."""
    if (restitution is None) != (friction is None):
        names = [one.opts[0] for one in context.command.params if one.name in ("restitution", "friction")]
        raise CaromError(f"play: expected {' and '.join(names)} together, got one of them; give both or none")
    wall = None if restitution is None or friction is None else Surface(restitution, friction)
    use_as_default(engine(cushion, wall, None if own_balls else "carom"))
    from pooltool.main import run

    run.main(args=[], standalone_mode=False)


if __name__ == "__main__":
    try:
        app()
    except CaromError as error:
        for fault in error.faults:
            print(escape_controls(fault), file=sys.stderr)  # noqa: T201
        sys.exit(2)
