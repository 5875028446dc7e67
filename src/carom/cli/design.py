"""``carom design``: which shots to film next, and how many."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Any

import typer

from carom.cli.console import working
from carom.cli.options import BALL, WALL, option, parse_assignments, parse_number, require_outputs, shared, wrote
from carom.cli.streams import note, say_json
from carom.errors import CaromError, FaultList
from carom.public.defaults import ANGLES_DEG, DESIGNED_LAWS, ODDS, RADIUS, SIGMA_V, SPEEDS, SPINS

SHOTS = "Shots"


def register(app: typer.Typer) -> None:
    """Add the verb."""
    app.command()(design)


def design(
    file: Annotated[Path | None, typer.Argument(help="Rebounds measured so far. Default: none.")] = None,
    laws: Annotated[
        str, typer.Option(metavar="TRUE,OTHER", help="Two laws; the first is assumed to be true.")
    ] = ",".join(DESIGNED_LAWS),
    radius: Annotated[float, shared("radius")] = RADIUS,
    inertia: Annotated[str, shared("inertia")] = "solid",
    kind: Annotated[str | None, shared("kind", default="FILE's, else planar", rich_help_panel=BALL)] = None,
    stage: Annotated[
        str, option(BALL, "Stage at which a ball on a table is measured: after_wall or rolling.")
    ] = "after_wall",
    truth: Annotated[
        list[str] | None, option(WALL, "Parameter of the first law; may be repeated.", metavar="NAME=VALUE")
    ] = None,
    contact_height: Annotated[float | None, shared("contact_height", default="1")] = None,
    floor_friction: Annotated[float | None, shared("floor_friction", default="what FILE says, else 0.2")] = None,
    angles_deg: Annotated[
        str, option(SHOTS, "Angles of incidence, degrees from the normal.", "--angles", metavar="LOW:HIGH")
    ] = "{:g}:{:g}".format(*ANGLES_DEG),
    speeds: Annotated[str, option(SHOTS, "Speeds, m/s.", metavar="LOW:HIGH")] = "{:g}:{:g}".format(*SPEEDS),
    spins: Annotated[
        str, option(SHOTS, "Spin before the wall, rad/s; unknown if not measured.", metavar="LOW:HIGH|unknown")
    ] = "{:g}:{:g}".format(*SPINS),
    spin: Annotated[
        str | None,
        option(
            SHOTS,
            "Unmeasured spins before the wall in FILE, as in carom fit: rad/s at the first contact of each ball, or a prior.",
            show_default="normal, mean along v_t and width fitted",
        ),
    ] = None,
    sigma_v: Annotated[float, shared("sigma_v", rich_help_panel=SHOTS)] = SIGMA_V,
    sigma_spin: Annotated[
        float | None, shared("sigma_spin", default="spin not measured", rich_help_panel=SHOTS)
    ] = None,
    odds: Annotated[float, option(SHOTS, "Target odds, N:1.")] = ODDS,
    plot: Annotated[Path | None, shared("plot")] = None,
    as_json: Annotated[bool, shared("json")] = False,
) -> None:
    """Find the angles of incidence, speeds and spins that discriminate best between two laws, and how many shots are needed.

    carom design --laws maw,contact --radius 0.02 --inertia hollow --sigma-v 0.15 --sigma-spin 10 --speeds 3:10
    """
    from carom.fitting.design_shots import check_design
    from carom.fitting.design_shots import design as plan_shots

    faults = FaultList()
    ranges = {
        name: None if text == "unknown" and name == "spins" else faults.attempt(_range, f"--{option}", text)
        for name, option, text in (
            ("angles_deg", "angles", angles_deg),
            ("speeds", "speeds", speeds),
            ("spins", "spins", spins),
        )
    }
    numbers = {
        name: faults.attempt(parse_number, "--truth", name, text)
        for name, text in parse_assignments(faults, "--truth", truth)
    }
    require_outputs(faults, {"--plot": plot})
    options: dict[str, Any] = {
        "file": file, "laws": laws, "radius": radius, "inertia": inertia, "kind": kind, "stage": stage,
        "truth": {name: value for name, value in numbers.items() if value is not None}, "contact_height": contact_height,
        "floor_friction": floor_friction, "spin": spin, "sigma_v": sigma_v, "sigma_spin": sigma_spin, "odds": odds,
        **{name: ends for name, ends in ranges.items() if ends is not None},
        **({"spins": "unknown"} if spins == "unknown" else {}),
    }  # fmt: skip
    if faults:
        found = FaultList()
        found.attempt(check_design, **options)
        raise CaromError(*found, *faults)
    with working("planning"):
        plan = plan_shots(**options, fine=plot is not None)
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


def _range(option: str, text: str) -> tuple[float, float]:
    low, colon, high = text.partition(":")
    try:
        return float(low), float(high if colon else low)
    except ValueError:
        such = "0:0, or unknown" if option == "--spins" else "5:75"
        raise CaromError(f"{option}: expected LOW:HIGH, such as {such}, got {text!r}") from None


def _show(plan: Any) -> None:
    from rich import box
    from rich.table import Table
    from rich.text import Text

    from carom.cli.console import out

    console = out()
    said = ", ".join(f"{name} {value:.4g}" for name, value in plan.truth.items()) or "no parameters"
    other = ", ".join(f"{name} {value:.4g}" for name, value in plan.other.items()) or "no parameters"
    console.print(
        Text(f"Assumed true: {plan.laws[0]} ({said})\nClosest parameters of the other: {plan.laws[1]} ({other})")
    )
    if plan.shots and plan.count:
        table = Table(box=box.SIMPLE_HEAD, pad_edge=False, header_style="bold")
        heads = ["angle\ndegrees", "speed\nm/s", "spin\nrad/s", "repeats", "2 log odds\neach"]
        compared = all(shot.without is not None for shot in plan.shots)
        for head in [*heads, *(["2 log odds\nwithout one"] if compared else [])]:
            table.add_column(head, justify="right", vertical="bottom")
        for shot in plan.shots:
            table.add_row(
                f"{shot.angle_deg:.4g}",
                f"{shot.speed:.4g}",
                "unknown" if shot.spin is None else f"{shot.spin:.4g}",
                str(shot.repeat),
                f"{shot.gain:.3g}",
                *([f"{shot.without:.3g}" if shot.without >= 5e-3 else "0"] if compared else []),
            )
        console.print(table)
    console.print(Text(plan.sentence, style="bold green" if plan.count else "bold yellow"), soft_wrap=True)
