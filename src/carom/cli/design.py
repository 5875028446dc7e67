"""``carom design``: which shots to film next, and how many."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Any

import typer

from carom.cli.console import working
from carom.cli.options import require_outputs, shared, wrote
from carom.cli.parameters import Given, of_library
from carom.cli.streams import note, say_json

SHOTS = "Shots"


@of_library(
    "fitting.design_shots:design",
    without=("fine",),
    panels={SHOTS: "angles_deg speeds spins spin sigma_v sigma_spin odds"},
)
def design(
    file: Annotated[Path | None, typer.Argument(help="Rebounds measured so far. Default: none.")] = None,
    *,
    given: Given,
    plot: Annotated[Path | None, shared("plot")] = None,
    as_json: Annotated[bool, shared("json")] = False,
) -> None:
    """Find the angles of incidence, speeds and spins that discriminate best between two laws, and how many shots are needed.

    carom design --laws maw,contact --radius 0.02 --inertia hollow --sigma-v 0.15 --sigma-spin 10 --speeds 3:10
    """
    from carom.fitting.design_shots import check_design
    from carom.fitting.design_shots import design as plan_shots

    require_outputs(given.faults, {"--plot": plot})
    given.raise_if_any(lambda: check_design(file=file, **given))
    with working("planning"):
        plan = plan_shots(file, **given, fine=plot is not None)
    if plot is not None:
        from carom.plot.fit import plot_design
        from carom.plot.style import save

        save(plot_design(plan), plot)
        wrote(plot)
    if as_json:
        say_json(plan.as_dict())
    else:
        _show(plan)
    for line in plan.notes:
        note(f"note: {line}")


def _show(plan: Any) -> None:
    from rich.text import Text

    from carom.cli.console import out
    from carom.formatting import Listing

    console = out()
    said = ", ".join(f"{name} {value:.4g}" for name, value in plan.truth.items()) or "no parameters"
    other = ", ".join(f"{name} {value:.4g}" for name, value in plan.other.items()) or "no parameters"
    console.print(
        Text(f"Assumed true: {plan.laws[0]} ({said})\nClosest parameters of the other: {plan.laws[1]} ({other})")
    )
    if plan.shots and plan.count:
        compared = all(shot.without is not None for shot in plan.shots)
        heads = ["shot", "angle\ndegrees", "speed\nm/s", "spin\nrad/s", "repeats", "2 log odds\neach"]
        heads += ["2 log odds\nwithout one"] * compared
        rows = []
        for number, shot in enumerate(plan.shots, 1):
            spin = "unknown" if shot.spin is None else f"{shot.spin:.4g}"
            rows.append(
                [str(number), f"{shot.angle_deg:.4g}", f"{shot.speed:.4g}", spin, str(shot.repeat), f"{shot.gain:.3g}"]
            )
            rows[-1] += [f"{shot.without:.3g}" if shot.without >= 5e-3 else "0"] if compared else []
        console.table(Listing(heads, rows))
    console.print(plan.sentence, style="bold green" if plan.count else "bold yellow", soft_wrap=True)
