"""``carom predict``: a table of incoming states to the same table with the outgoing state added."""

from __future__ import annotations

import json
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, Literal

import typer
from rich.console import Console
from rich.markup import escape

from carom.cli.shared import attempt, working, wrote
from carom.errors import CaromError

if TYPE_CHECKING:
    from carom.law import Law

BALL, WALL, FLOOR, TABLE = "The ball", "The wall", "The floor", "The table"


def register(app: typer.Typer) -> None:
    """Add the verb."""
    app.command()(predict)


def predict(
    table: Annotated[Path, typer.Argument(help="CSV or Parquet, a state a row; see the guide for columns and units")],
    law: Annotated[str, typer.Option(help="a law's name (carom laws), or your own: my_law.py:law")] = "two-step",
    out: Annotated[Path | None, typer.Option(help="new file of the same kind; left out: standard output (CSV)")] = None,
    strict: Annotated[
        bool, typer.Option("--strict", help="a row without an answer is an error: nothing is written")
    ] = False,
    json_: Annotated[bool, typer.Option("--json", help="a summary as JSON on standard output (with --out)")] = False,
    spin: Annotated[
        str | None,
        typer.Option(
            help="where the table has no spin: rolling or none", show_default="rolling; none for contact, maw, stronge"
        ),
    ] = None,
    suffix: Annotated[str | None, typer.Option(help="put after the names of the added columns")] = None,
    speed: Annotated[
        float | None, typer.Option(help="of every row, m/s, beside incidence_deg", rich_help_panel=TABLE)
    ] = None,
    radius: Annotated[float | None, typer.Option(help="m", show_default="0.02625", rich_help_panel=BALL)] = None,
    mass: Annotated[float | None, typer.Option(help="kg", show_default="0.1406", rich_help_panel=BALL)] = None,
    inertia: Annotated[
        str | None, typer.Option(help="solid, hollow or kappa", show_default="solid", rich_help_panel=BALL)
    ] = None,
    height: Annotated[
        float | None, typer.Option(help="of the centre above its place on the floor, m", rich_help_panel=BALL)
    ] = None,
    restitution: Annotated[float | None, typer.Option(show_default="1", rich_help_panel=WALL)] = None,
    friction: Annotated[float | None, typer.Option(show_default="inf", rich_help_panel=WALL)] = None,
    tangential_restitution: Annotated[float | None, typer.Option(show_default="0", rich_help_panel=WALL)] = None,
    stiffness_ratio: Annotated[
        float | None,
        typer.Option(
            help="along the surface, for maw, stronge", show_default="14/17: like solids", rich_help_panel=WALL
        ),
    ] = None,
    normal: Annotated[
        str | None, typer.Option(help="from wall to ball, vector form", show_default="1,0,0", rich_help_panel=WALL)
    ] = None,
    contact_height: Annotated[
        float,
        typer.Option(
            "--contact-height",
            "--cushion-height",
            help="where it touches, in radii: a cushion 1.4",
            rich_help_panel=WALL,
        ),
    ] = 1.0,
    floor_restitution: Annotated[float | None, typer.Option(show_default="0", rich_help_panel=FLOOR)] = None,
    floor_friction: Annotated[float | None, typer.Option(show_default="inf", rich_help_panel=FLOOR)] = None,
    floor_tangential_restitution: Annotated[float | None, typer.Option(show_default="0", rich_help_panel=FLOOR)] = None,
    floor_contact: Annotated[str, typer.Option(help="with the wall, or after it", rich_help_panel=FLOOR)] = "with",
    gravity: Annotated[float, typer.Option(help="m/s^2", rich_help_panel=FLOOR)] = 9.80665,
) -> None:
    """A table of incoming states, one a row, to the same table with the outgoing state added.

    An option wins over a column of the same name. Rows without an answer keep their place; the note column says why.
    """
    from carom.ball import INERTIAS
    from carom.files import try_place
    from carom.own_law import find_law
    from carom.predict import Settings, predict_table, spin_rule
    from carom.tables.plan import bad_numbers

    faults: list[str] = []
    given = {
        "speed": speed, "radius": radius, "mass": mass, "height": height,
        "restitution": restitution, "friction": friction,
        "tangential_restitution": tangential_restitution, "stiffness_ratio": stiffness_ratio,
        "floor_restitution": floor_restitution, "floor_friction": floor_friction,
        "floor_tangential_restitution": floor_tangential_restitution,
    }  # fmt: skip
    numbers = {name: value for name, value in given.items() if value is not None}
    if inertia is not None:
        try:
            numbers["kappa"] = INERTIAS[inertia] if inertia in INERTIAS else float(inertia)
        except ValueError:
            faults.append(f"--inertia: expected solid, hollow or kappa = I/(m a^2), got {inertia!r}")
    values: dict[str, Any] = {"given": numbers, "contact_height": contact_height, "gravity": gravity, "suffix": suffix}
    for name, make in (
        ("law", lambda: find_law(law)),
        ("spin", lambda: spin_rule(spin)),
        ("normal", lambda: None if normal is None else _vector(normal)),
        ("floor_contact", lambda: _floor_contact(floor_contact)),
    ):
        try:
            values[name] = make()
        except CaromError as error:
            faults += error.faults
    idle = _unread(values.get("law"), numbers)
    faults += idle.values()
    read = {name: value for name, value in numbers.items() if name not in idle}
    faults += bad_numbers(read, values.get("normal"), contact_height, gravity)
    if out is not None:
        no_place: list[str] = []
        attempt(no_place, try_place, out)
        faults += [f"--out {fault}" for fault in no_place]
    if json_ and out is None:
        faults.append("--out: expected a file for the table, got none, and --json takes the standard output")
    if faults:
        raise CaromError(*faults)
    console = Console(stderr=True, highlight=False)

    def say(note: str) -> None:
        console.print(f"[dim]{escape(note)}[/]", soft_wrap=True)

    with working("predict", console, *(["compiling the law"] if ".py:" in law else [])) as progress:
        summary = predict_table(table, out, Settings(**values), strict=strict, progress=progress, say=say)
    if json_:
        print(json.dumps({**vars(summary), "without_answer": summary.without_answer}, indent=2, allow_nan=False))  # noqa: T201
    _report(console, summary)


def _report(console: Console, summary: Any) -> None:
    for fault in summary.faults:
        console.print(f"[yellow]{fault['row']}:[/] {escape(fault['what'])}", soft_wrap=True)
    more = summary.without_answer - len(summary.faults)
    if more > 0:
        console.print(
            f"[yellow]and {more:,} more rows without an answer[/]; the column {summary.added[-1]} has them all"
        )
    rate = summary.rows / summary.seconds if summary.seconds else 0
    console.print(
        f"[bold]{summary.law}[/]: {summary.answered:,} of {summary.rows:,} rows answered"
        + (f" in {summary.seconds:.1f} s ({rate:,.0f} rows/s)" if summary.seconds > 1 else ""),
        soft_wrap=True,
    )
    if summary.out:
        wrote(Path(summary.out))


def _unread(law: Law | None, numbers: dict[str, float]) -> dict[str, str]:
    """Faults of options that were given and that the law does not read, by name."""
    from carom.tables.plan import unread

    idle = [] if law is None else unread(law)
    reads = "" if law is None else ", ".join(law.reads or ())
    return {
        name: f"--{name.replace('_', '-')}: expected a law that reads it, got {law.name}, which reads {reads}; leave it out"
        for name in numbers
        if law is not None and name in idle
    }


def _vector(text: str) -> tuple[float, float, float]:
    try:
        x, y, z = (float(part) for part in text.replace(",", " ").split())
    except ValueError:
        raise CaromError(f"--normal: expected three numbers, such as 1,0,0, got {text!r}") from None
    return x, y, z


def _floor_contact(text: str) -> Literal["with", "after"]:
    if text in ("with", "after"):
        return text  # type: ignore[return-value]
    raise CaromError(
        f"--floor-contact: expected 'with' (at once) or 'after' (the wall alone, then the floor), got {text!r}"
    )
