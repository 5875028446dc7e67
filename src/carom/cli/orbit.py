"""``carom orbit``: follow single-particle billiards; bounces, phase portraits, Lyapunov exponents."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from carom.billiards.named import SIZES
from carom.cli.common import require_outputs, wrote
from carom.cli.options import BALL, OUTPUT, quantity, shared
from carom.cli.orbit_output import every_bounce, orbit_facts, print_orbit
from carom.cli.progress import working
from carom.cli.streams import say_json
from carom.errors import CaromError, FaultList
from carom.public.defaults import BOUNCES, PERIODIC_STARTS
from carom.public.own_laws import with_own_laws

if TYPE_CHECKING:
    from carom.billiards import OrbitResult

TABLE, LAW, START = "Table", "Law", "Initial state"


def register(app: typer.Typer) -> None:
    """Add the command."""
    app.command()(orbit)


def _size(text: str, option: str = "", unit: str = "m") -> Any:
    more = quantity(option, unit) if option else {}
    return typer.Option(help=text, rich_help_panel=TABLE, show_default=False, **more)


def orbit(
    table: Annotated[
        str, typer.Argument(help=f"{', '.join(SIZES)}; or cylinder:NAME, a cylinder along z over a table in the plane.")
    ],
    bounces: Annotated[int, typer.Option(help="Number of bounces.")] = BOUNCES,
    bounds: Annotated[
        str, typer.Option(help="What the table bounds: the ball's centre or its surface.", rich_help_panel=TABLE)
    ] = "centre",
    radius: Annotated[
        float | None,
        _size("Of a circle, a sphere, a stadium's ends, an obstacle; circumradius of a polygon; m.", "--radius"),
    ] = None,
    major: Annotated[float | None, _size("Half axis of an ellipse in x, m.", "--major")] = None,
    minor: Annotated[float | None, _size("Half axis of an ellipse in y, m.", "--minor")] = None,
    straight: Annotated[float | None, _size("Length of a stadium's straight sides, m.", "--straight")] = None,
    sides: Annotated[int | None, _size("Number of sides of a regular polygon.")] = None,
    vertices: Annotated[str | None, _size("Of any polygon: 'x,y x,y x,y ...', m.")] = None,
    width: Annotated[float | None, _size("Of a rectangle, a strip, a box, m.", "--width")] = None,
    height: Annotated[
        float | None,
        _size("Of a rectangle, a box; distance of the lids of a cylinder (except over a rectangle), m.", "--height"),
    ] = None,
    depth: Annotated[float | None, _size("Of a box, in z, m.", "--depth")] = None,
    angle_deg: Annotated[
        float | None,
        typer.Option(
            "--angle",
            help="Of a wedge, degrees; it is open along +x: needs e.g. --acceleration=-9.81,0.",
            rich_help_panel=TABLE,
            show_default=False,
            **quantity("--angle", "degree"),
        ),
    ] = None,
    side: Annotated[float | None, _size("Of Sinai's square cell, m.", "--side")] = None,
    period: Annotated[float | None, _size("Of a periodic strip, m.", "--period")] = None,
    distance: Annotated[float | None, _size("Between plates, m.", "--distance")] = None,
    acceleration: Annotated[
        str | None,
        _size("Constant acceleration, m/s^2: x,y or x,y,z; or a number: along a strip (x), plates or a cylinder (z)."),
    ] = None,
    kappa: Annotated[
        float | None,
        typer.Option(help="Moment of inertia, I/(m a^2).", show_default="0.5; in space 0.4", rich_help_panel=BALL),
    ] = None,
    ball_radius: Annotated[
        float | None,
        typer.Option(
            help="Radius, m.",
            show_default="1; 0.1 with --bounds surface",
            rich_help_panel=BALL,
            **quantity("--ball-radius", "m"),
        ),
    ] = None,
    law: Annotated[
        str,
        typer.Option(
            help="no-slip, mirror, contact, rolling, another law of carom laws that answers at a wall alone (of two-step the"
            " part at the wall: there is no floor), or a custom law: my_law.py:law.",
            rich_help_panel=LAW,
        ),
    ] = "no-slip",
    restitution: Annotated[float | None, shared("restitution", default="1", rich_help_panel=LAW)] = None,
    friction: Annotated[float | None, shared("friction", default="inf", rich_help_panel=LAW)] = None,
    tangential_restitution: Annotated[
        float | None, shared("tangential_restitution", default="0", rich_help_panel=LAW)
    ] = None,
    corners: Annotated[
        str, typer.Option(help="At a corner: end the orbit, or pass (one side, then the other).", rich_help_panel=LAW)
    ] = "end",
    position: Annotated[
        str | None, typer.Option(help="Of the centre: x,y or x,y,z; m.", rich_help_panel=START, show_default="sampled")
    ] = None,
    velocity: Annotated[
        str | None, typer.Option(help="x,y or x,y,z; m/s.", rich_help_panel=START, show_default="sampled")
    ] = None,
    spin: Annotated[
        str | None, typer.Option(help="rad/s; in space x,y,z.", rich_help_panel=START, show_default="sampled, or 0")
    ] = None,
    orbits: Annotated[
        int, typer.Option(help="Number of orbits, sampled from the invariant measure.", rich_help_panel=START)
    ] = 1,
    seed: Annotated[int, shared("seed", rich_help_panel=START)] = 0,
    plot: Annotated[Path | None, shared("plot", help="Draw the first orbit in the table: .svg, .pdf or .png.")] = None,
    portrait: Annotated[Path | None, shared("plot", help="Draw the velocity phase portrait.")] = None,
    boundary: Annotated[Path | None, shared("plot", help="Draw the boundary map.")] = None,
    lyapunov: Annotated[
        bool, typer.Option("--lyapunov", help="Compute the Lyapunov spectrum.", rich_help_panel=OUTPUT)
    ] = False,
    lyapunov_plot: Annotated[
        Path | None, shared("plot", help="Draw how the Lyapunov exponents converge; computes them.")
    ] = None,
    reverse: Annotated[
        bool,
        typer.Option("--reverse", help="Run the orbits backwards, too, and print the error.", rich_help_panel=OUTPUT),
    ] = False,
    periodic: Annotated[
        str | None,
        typer.Option(
            help="Find the periodic orbits with these numbers of bounces, such as 4, 2-6 or 3,5; --plot draws them.",
            rich_help_panel=OUTPUT,
            show_default=False,
        ),
    ] = None,
    starts: Annotated[
        int, typer.Option(help="Starts of the search for periodic orbits, for each period.", rich_help_panel=OUTPUT)
    ] = PERIODIC_STARTS,
    json_: Annotated[bool, shared("json", help="Print JSON on standard output, with every bounce.")] = False,
) -> None:
    """Single-particle billiards: follow one ball in a table from bounce to bounce, with the no-slip law or another.

    Without --position and --velocity, the initial state is sampled from the invariant measure. Default sizes are about 1 m.
    """
    from carom.billiards.orbit_by_name import check_orbit
    from carom.billiards.orbit_by_name import orbit as follow

    faults = FaultList()
    require_outputs(
        faults, {"--plot": plot, "--portrait": portrait, "--boundary": boundary, "--lyapunov-plot": lyapunov_plot}
    )
    options = {
        "bounds": bounds, "radius": radius, "major": major, "minor": minor, "straight": straight, "sides": sides,
        "vertices": None if vertices is None else faults.attempt(_points, vertices), "width": width, "height": height,
        "depth": depth, "angle_deg": angle_deg, "side": side, "period": period, "distance": distance,
        "kappa": kappa, "ball_radius": ball_radius, "law": with_own_laws(law), "restitution": restitution,
        "friction": friction, "tangential_restitution": tangential_restitution, "corners": corners, "orbits": orbits,
        "seed": seed, "reverse": reverse,
    }  # fmt: skip
    for name, text in (("acceleration", acceleration), ("position", position), ("velocity", velocity), ("spin", spin)):
        options[name] = None if text is None else faults.attempt(_numbers, f"--{name}", text)
    if faults:
        faults.attempt(check_orbit, table=table, bounces=bounces, **options)
        raise CaromError(*faults)
    with working("orbits") as report:
        exponents = lyapunov or lyapunov_plot is not None
        found = follow(table, bounces, lyapunov=exponents, periodic=periodic, starts=starts, progress=report, **options)
        facts = orbit_facts(found)
    if json_:
        facts["bounces"] = every_bounce(found)
        say_json(facts)
    else:
        print_orbit(facts, found)
    _draw(found, plot, portrait, boundary)
    if lyapunov_plot is not None and found.spectrum is not None:
        from carom.plot import plot_lyapunov, save

        save(plot_lyapunov(found.spectrum), lyapunov_plot)
        wrote(lyapunov_plot)


def _points(text: str) -> list[list[float]]:
    points = []
    for part in text.split():
        found = FaultList().attempt(_numbers, "--vertices", part)
        if not isinstance(found, list) or len(found) != 2:
            raise CaromError(f"--vertices: expected two numbers, such as 0.1,0.2, got {part!r}")
        points.append(found)
    return points


def _numbers(option: str, text: str) -> float | list[float]:
    """Return the numbers between commas; a number where there is but one."""
    try:
        found = [float(part) for part in text.replace(",", " ").split()]
    except ValueError:
        found = []
    if not found:
        raise CaromError(f"{option}: expected numbers, such as 0.1,0.2, got {text!r}")
    return found[0] if len(found) == 1 and "," not in text else found


def _draw(found: OrbitResult, plot: Path | None, portrait: Path | None, boundary: Path | None) -> None:
    if plot is None and portrait is None and boundary is None:
        return
    from carom.plot import plot_boundary, plot_orbit, plot_periodic, plot_portrait, save

    closed = found.periodic
    first = plot_orbit if closed is None else lambda _found: plot_periodic(closed)
    for path, make in ((plot, first), (portrait, plot_portrait), (boundary, plot_boundary)):
        if path is not None:
            save(make(found), path)
            wrote(path)
