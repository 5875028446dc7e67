"""``carom predict``: add the outgoing states that a law predicts to a table of incoming states."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Any

import typer
from rich.console import Console
from rich.text import Text

from carom.cli.console import err, working
from carom.cli.options import require_outputs, shared, wrote
from carom.cli.parameters import Given, of_library
from carom.cli.streams import say_json
from carom.cli.verbs import in_options

OTHER_TABLES = (".xlsx", ".xls", ".ods", ".json", ".nc", ".h5", ".feather")  # formats that are not written


@of_library("data.predict:predict", without=("say",))
def predict(
    table: Annotated[
        Path, typer.Argument(help="CSV or Parquet, one state per row; the guide lists columns and units.")
    ],
    *,
    given: Given,
    out: Annotated[Path | None, typer.Option(help="New file of the same kind. Default: standard output (CSV).")] = None,
    json_: Annotated[bool, shared("json", help="Print a summary as JSON on standard output (with --out).")] = False,
) -> None:
    """Add the outgoing states that a law predicts to a table of incoming states, one per row.

    An option takes precedence over a column of the same name. Rows without a prediction stay in the table, with the reason
    in the note column.
    """
    from carom.data.predict import STANDARD_OUTPUT, predict_settings
    from carom.data.predict import predict as predict_rows

    faults = given.faults
    require_outputs(faults, {"--out": out}, {"--out": ()}, source=table)
    if out is not None and out.suffix.lower() in OTHER_TABLES:
        faults.add("--out", "a .csv or .parquet file", repr(out.suffix), "spreadsheets open .csv")
    if json_ and out is None:
        faults.add("--out", "a file for the table with --json, which uses standard output", "none")
    given.raise_if_any(lambda: predict_settings(**{name: one for name, one in given.items() if name != "strict"}))
    console = err()

    def say(note: str) -> None:
        console.print(in_options(note), style="dim", soft_wrap=True)

    with working("predict", console, *(["compiling the law"] if ".py:" in given.get("law", "") else [])) as progress:
        summary = predict_rows(table, out=out or STANDARD_OUTPUT, progress=progress, say=say, **given)
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
