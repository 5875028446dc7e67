"""``carom predict``: add the outgoing states that a law predicts to a table of incoming states."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Any

import typer
from rich.console import Console
from rich.text import Text

from carom.cli.catalog import datasets
from carom.cli.console import err, working
from carom.cli.options import WALL, option, require_outputs, shared, wrote
from carom.cli.streams import say_json
from carom.cli.verbs import in_options
from carom.errors import CaromError, FaultList
from carom.public.defaults import CONTACT_HEIGHT, FLOOR_CONTACT, GRAVITY
from carom.public.own_laws import with_own_laws

TABLE = "Table"
OTHER_TABLES = (".xlsx", ".xls", ".ods", ".json", ".nc", ".h5", ".feather")  # formats that are not written


def register(app: typer.Typer) -> None:
    """Add the verb, and the published tables before it."""
    app.command()(datasets)
    app.command()(predict)


def predict(
    table: Annotated[
        Path, typer.Argument(help="CSV or Parquet, one state per row; the guide lists columns and units.")
    ],
    law: Annotated[str, typer.Option(help="Name of a law (carom laws), or a custom one: my_law.py:law.")] = "two-step",
    out: Annotated[Path | None, typer.Option(help="New file of the same kind. Default: standard output (CSV).")] = None,
    strict: Annotated[
        bool, typer.Option("--strict", help="Fail, and write nothing, if there is no prediction for a row.")
    ] = False,
    json_: Annotated[bool, shared("json", help="Print a summary as JSON on standard output (with --out).")] = False,
    spin: Annotated[
        str | None,
        typer.Option(
            help="Spin of rows without one: rolling or none.", show_default="rolling; none for laws of a ball in flight"
        ),
    ] = None,
    suffix: Annotated[str | None, typer.Option(help="Suffix of the names of added columns.")] = None,
    speed: Annotated[
        float | None, option(TABLE, "Speed of every row, m/s, for tables with incidence_deg.", "--speed", unit="m/s")
    ] = None,
    radius: Annotated[float | None, shared("radius", default="0.02625")] = None,
    mass: Annotated[float | None, shared("mass", default="0.1406")] = None,
    inertia: Annotated[str | None, shared("inertia", default="solid")] = None,
    height: Annotated[float | None, shared("height", default="0")] = None,
    restitution: Annotated[float | None, shared("restitution", default="1")] = None,
    friction: Annotated[float | None, shared("friction", default="inf")] = None,
    tangential_restitution: Annotated[float | None, shared("tangential_restitution", default="0")] = None,
    stiffness_ratio: Annotated[float | None, shared("stiffness_ratio", default="14/17: same material")] = None,
    normal: Annotated[
        str | None, option(WALL, "Normal from wall to ball, for states as vectors.", show_default="1,0,0")
    ] = None,
    contact_height: Annotated[float, shared("contact_height")] = CONTACT_HEIGHT,
    floor_restitution: Annotated[float | None, shared("floor_restitution", default="0")] = None,
    floor_friction: Annotated[float | None, shared("floor_friction", default="inf")] = None,
    floor_tangential_restitution: Annotated[float | None, shared("floor_tangential_restitution", default="0")] = None,
    floor_contact: Annotated[str, shared("floor_contact")] = FLOOR_CONTACT,
    gravity: Annotated[float, shared("gravity")] = GRAVITY,
) -> None:
    """Add the outgoing states that a law predicts to a table of incoming states, one per row.

    An option takes precedence over a column of the same name. Rows without a prediction stay in the table, with the reason
    in the note column.
    """
    from carom.data.predict import STANDARD_OUTPUT, predict_settings
    from carom.data.predict import predict as predict_rows

    faults = FaultList()
    require_outputs(faults, {"--out": out}, {"--out": ()}, source=table)
    if out is not None and out.suffix.lower() in OTHER_TABLES:
        faults.add("--out", "a .csv or .parquet file", repr(out.suffix), "spreadsheets open .csv")
    if json_ and out is None:
        faults.add("--out", "a file for the table with --json, which uses standard output", "none")
    options: dict[str, Any] = {
        "spin": spin, "suffix": suffix, "speed": speed, "radius": radius, "mass": mass, "inertia": inertia, "height": height,
        "restitution": restitution, "friction": friction, "tangential_restitution": tangential_restitution,
        "stiffness_ratio": stiffness_ratio, "normal": None if normal is None else faults.attempt(_vector, normal),
        "contact_height": contact_height, "floor_restitution": floor_restitution, "floor_friction": floor_friction,
        "floor_tangential_restitution": floor_tangential_restitution, "floor_contact": floor_contact, "gravity": gravity,
    }  # fmt: skip
    typed: Any = with_own_laws(law)
    if faults:
        found = FaultList()
        found.attempt(predict_settings, typed, **options)
        raise CaromError(*found, *faults)
    console = err()

    def say(note: str) -> None:
        console.print(in_options(note), style="dim", soft_wrap=True)

    with working("predict", console, *(["compiling the law"] if ".py:" in law else [])) as progress:
        summary = predict_rows(
            table, typed, out=out or STANDARD_OUTPUT, strict=strict, progress=progress, say=say, **options
        )
    if json_:
        say_json(summary.as_dict())
    _report(console, summary)


def _report(console: Console, summary: Any) -> None:
    for fault in summary.faults:
        console.print(Text.assemble((f"{fault['row']}:", "yellow"), f" {fault['what']}"), soft_wrap=True)
    more = summary.without_answer - len(summary.faults)
    if more > 0:
        left = (f"and {more:,} more row{'s' * (more > 1)} without a prediction", "yellow")
        console.print(Text.assemble(left, f"; see the column {summary.added[-1]}"))
    rate = summary.rows / summary.seconds if summary.seconds else 0
    answered = f": predictions for {summary.answered:,} of {summary.rows:,} row{'s' * (summary.rows != 1)}"
    took = f" in {summary.seconds:.1f} s ({rate:,.0f} rows/s)" if summary.seconds > 1 else ""
    console.print(Text.assemble((summary.law, "bold"), answered, took), soft_wrap=True)
    if summary.out:
        wrote(Path(summary.out))


def _vector(text: str) -> list[float]:
    try:
        return [float(part) for part in text.replace(",", " ").split()]
    except ValueError:
        raise CaromError(f"--normal: expected three numbers, such as 1,0,0, got {text!r}") from None
