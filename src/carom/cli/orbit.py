"""``carom orbit``: follow single-particle billiards; bounces, phase portraits, Lyapunov exponents."""

from __future__ import annotations

import functools
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from carom.cli.common import require_outputs, wrote
from carom.cli.options import BALL, OUTPUT, option, parse_whole, shared
from carom.cli.orbit_output import every_bounce, orbit_facts, print_orbit
from carom.cli.progress import working
from carom.cli.streams import note, say_json
from carom.errors import CaromError, FaultList
from carom.public.defaults import BOUNCES, PERIODIC_STARTS
from carom.public.own_laws import with_own_laws

if TYPE_CHECKING:
    from carom.billiards import OrbitResult

TABLE, LAW, START = "Table", "Law", "Initial state"


def register(app: typer.Typer) -> None:
    """Add the command."""
    app.command()(orbit)


def orbit(
    table: Annotated[
        str | None,
        typer.Argument(
            help="A figure, with sizes or without: circle, stadium:straight=2,radius=1, polygon:points=[[0,0],[2,0],[0,1]];"
            " or cylinder:NAME, a cylinder along z over a figure in the plane. An unknown name is answered with all names."
        ),
    ] = None,
    bounces: Annotated[
        int, typer.Option(help="Number of bounces.", metavar="N", parser=functools.partial(parse_whole, "--bounces"))
    ] = BOUNCES,
    table_file: Annotated[
        Path | None,
        option(
            TABLE,
            "The table from a file: TOML with a shape and sizes, or JSON, such as a list of points.",
            "--table",
            show_default=False,
            metavar="FILE",
        ),
    ] = None,
    bounds: Annotated[str, option(TABLE, "Whether the table bounds the ball's centre or its surface.")] = "centre",
    acceleration: Annotated[
        str | None,
        option(
            TABLE,
            "Constant acceleration, m/s^2: x,y or x,y,z; or a number: along a strip (x), plates or a cylinder (z).",
            show_default=False,
        ),
    ] = None,
    magnetic_field: Annotated[
        float | None,
        option(
            TABLE,
            "Magnetic field perpendicular to the plane, as the cyclotron frequency, rad/s: the centre moves on circles of"
            " the Larmor radius speed/|this|, counterclockwise where it is positive.",
            show_default=False,
        ),
    ] = None,
    kappa: Annotated[
        float | None, option(BALL, "Moment of inertia, I/(m a^2); any in the plane.", show_default="0.5; in space 0.4")
    ] = None,
    ball_radius: Annotated[
        float | None, option(BALL, "Radius, m.", "--ball-radius", unit="m", show_default="1; 0.1 with --bounds surface")
    ] = None,
    law: Annotated[
        str,
        option(
            LAW,
            "no-slip, mirror, contact, rolling, another law of carom laws that answers at a wall alone (of two-step the"
            " part at the wall: there is no floor), or a custom law: my_law.py:law.",
        ),
    ] = "no-slip",
    restitution: Annotated[float | None, shared("restitution", default="1", rich_help_panel=LAW)] = None,
    friction: Annotated[float | None, shared("friction", default="inf", rich_help_panel=LAW)] = None,
    tangential_restitution: Annotated[
        float | None, shared("tangential_restitution", default="0", rich_help_panel=LAW)
    ] = None,
    corners: Annotated[str, option(LAW, "At a corner: end the orbit, or pass (one side, then the other).")] = "end",
    position: Annotated[str | None, option(START, "Of the centre: x,y or x,y,z; m.", show_default="sampled")] = None,
    velocity: Annotated[str | None, option(START, "x,y or x,y,z; m/s.", show_default="sampled")] = None,
    spin: Annotated[str | None, option(START, "rad/s; in space x,y,z.", show_default="sampled, or 0")] = None,
    orbits: Annotated[int, option(START, "Number of orbits, sampled from the invariant measure.")] = 1,
    seed: Annotated[int, shared("seed", rich_help_panel=START)] = 0,
    plot: Annotated[Path | None, shared("plot", help="Draw the first orbit in the table: .svg, .pdf or .png.")] = None,
    portrait: Annotated[Path | None, shared("plot", help="Draw the velocity phase portrait.")] = None,
    boundary: Annotated[Path | None, shared("plot", help="Draw the boundary map.")] = None,
    lyapunov: Annotated[bool, option(OUTPUT, "Compute the Lyapunov spectrum.", "--lyapunov")] = False,
    lyapunov_plot: Annotated[
        Path | None, shared("plot", help="Draw how the Lyapunov exponents converge; computes them.")
    ] = None,
    reverse: Annotated[
        bool, option(OUTPUT, "Run the orbits backwards, too, and print the error.", "--reverse")
    ] = False,
    periodic: Annotated[
        str | None,
        option(
            OUTPUT,
            "Find the periodic orbits with these numbers of bounces, such as 4, 2-6 or 3,5; --plot draws them.",
            show_default=False,
        ),
    ] = None,
    itinerary: Annotated[
        str | None,
        option(
            OUTPUT,
            "Find the periodic orbits that meet these walls in turn, such as ABC or AB,ABC; A is the boundary's first piece.",
            show_default=False,
        ),
    ] = None,
    starts: Annotated[
        int, option(OUTPUT, "Starts of the search for periodic orbits, for each period.")
    ] = PERIODIC_STARTS,
    json_: Annotated[bool, shared("json", help="Print JSON on standard output, with every bounce.")] = False,
) -> None:
    """Single-particle billiards: follow one ball in a table from bounce to bounce, with the no-slip law or another.

    Sizes that the table leaves out are about 1 m. Without --position and --velocity, the initial state is sampled from the
    invariant measure.
    """
    from carom.billiards.orbit_by_name import check_orbit
    from carom.billiards.orbit_by_name import orbit as follow

    faults = FaultList()
    require_outputs(
        faults, {"--plot": plot, "--portrait": portrait, "--boundary": boundary, "--lyapunov-plot": lyapunov_plot}
    )
    what = faults.attempt(_table, table, table_file)
    options = {
        "bounds": bounds, "magnetic_field": magnetic_field,
        "kappa": kappa, "ball_radius": ball_radius, "law": with_own_laws(law), "restitution": restitution,
        "friction": friction, "tangential_restitution": tangential_restitution, "corners": corners, "orbits": orbits,
        "seed": seed, "reverse": reverse,
    }  # fmt: skip
    for name, text in (("acceleration", acceleration), ("position", position), ("velocity", velocity), ("spin", spin)):
        options[name] = None if text is None else faults.attempt(_numbers, f"--{name}", text)
    if faults:
        faults.attempt(check_orbit, table=what, bounces=bounces, **options)
        raise CaromError(*faults)
    with working("orbits") as report:
        exponents = lyapunov or lyapunov_plot is not None
        codes = None if itinerary is None else itinerary.split(",")
        found = follow(
            what,
            bounces,
            lyapunov=exponents,
            periodic=periodic,
            itinerary=codes,
            starts=starts,
            progress=report,
            **options,
        )
        facts = orbit_facts(found)
    if json_:
        facts["bounces"] = every_bounce(found)
        say_json(facts)
    else:
        print_orbit(facts, found)
        if found.periodic is not None and not len(found.periodic) and itinerary is None:
            note(
                "note: random starts seldom lead to unstable orbits between obstacles or through openings;"
                " --itinerary AB,ABC seeks those that meet given walls"
            )
    _draw(found, plot, portrait, boundary)
    if lyapunov_plot is not None and found.spectrum is not None:
        from carom.plot import plot_lyapunov, save

        save(plot_lyapunov(found.spectrum), lyapunov_plot)
        wrote(lyapunov_plot)


def _table(table: str | None, file: Path | None) -> Any:
    """Return the table of a text or of a file."""
    if (table is None) == (file is None):
        raise CaromError(
            f"TABLE: expected a table such as circle, or --table FILE, got {'both' if file else 'neither'}"
        )
    return table if file is None else file


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
