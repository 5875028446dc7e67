"""``carom orbit``: follow single-particle billiards; bounces, phase portraits, Lyapunov exponents."""

from __future__ import annotations

import json
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from carom.billiards.named import SIZES, named_table
from carom.cli.common import attempt, require_outputs, working, wrote
from carom.cli.options import BALL, OUTPUT, quantity, shared
from carom.cli.orbit_output import every_bounce, orbit_facts, print_orbit
from carom.errors import CaromError, Fault
from carom.public.own_laws import with_own_laws

if TYPE_CHECKING:
    from carom.billiards import Orbit, Table

TABLE, LAW, START = "Table", "Law", "Initial state"

SOLIDS = ("sphere", "box", "plates")


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
    bounces: Annotated[int, typer.Option(help="Number of bounces.")] = 200,
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
    angle: Annotated[
        float | None,
        _size("Of a wedge, degrees; it is open along +x: needs e.g. --acceleration=-9.81,0.", "--angle", "degree"),
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
    json_: Annotated[bool, shared("json", help="Print JSON on standard output, with every bounce.")] = False,
) -> None:
    """Single-particle billiards: follow one ball in a table from bounce to bounce, with the no-slip law or another.

    Without --position and --velocity, the initial state is sampled from the invariant measure. Default sizes are about 1 m.
    """
    from carom import billiards as library
    from carom.billiards.orbits import require_integer, require_reversible
    from carom.billiards.setup import law_of, orbit_setup, start_rows

    faults: list[str] = []
    require_outputs(
        faults, {"--plot": plot, "--portrait": portrait, "--boundary": boundary, "--lyapunov-plot": lyapunov_plot}
    )
    given = {
        "radius": radius, "major": major, "minor": minor, "straight": straight, "sides": sides, "vertices": vertices,
        "width": width, "height": height, "depth": depth, "angle": angle, "side": side, "period": period,
        "distance": distance, "acceleration": acceleration,
    }  # fmt: skip
    made = attempt(faults, _table, table, {k: v for k, v in given.items() if v is not None}, bounds)
    before = len(faults)
    law = with_own_laws(law)
    surface = attempt(faults, _surface, law, restitution, friction, tangential_restitution)
    ball = None if made is None else attempt(faults, _ball, made, kappa, ball_radius)
    together = len(faults) == before  # else each of these faults would be reported again below
    attempt(faults, require_integer, "bounces", bounces)
    attempt(faults, require_integer, "seed", seed, 0)
    begin = None if made is None else attempt(faults, _given, made, position, velocity, spin, orbits)
    if together:
        if made is None:
            attempt(faults, law_of, law, surface)
        elif (setup := attempt(faults, orbit_setup, made, ball, law, surface, corners)) is not None:
            if reverse:
                attempt(faults, require_reversible, setup)
            if begin is not None:
                attempt(faults, start_rows, setup, begin)
    if faults:
        raise CaromError(*faults)
    options = {"ball": ball, "law": law, "surface": surface}
    if begin is None:
        begin = _sampled(made, orbits, seed, ball, law)
    with working("orbits") as report:
        found = library.orbit(made, begin, bounces, corners=corners, progress=report, **options)
        wanted = lyapunov or lyapunov_plot is not None
        spectrum = library.lyapunov(made, begin, found.t.shape[-1], **options) if wanted else None
        facts = orbit_facts(found, made, spectrum=spectrum, back=reverse)
    if json_:
        facts["bounces"] = every_bounce(found)
        print(json.dumps(facts, indent=2, allow_nan=False))  # noqa: T201
    else:
        print_orbit(facts, found)
    _draw(found, plot, portrait, boundary)
    if lyapunov_plot is not None and spectrum is not None:
        from carom.plot import plot_lyapunov, save

        save(plot_lyapunov(spectrum), lyapunov_plot)
        wrote(lyapunov_plot)


def _table(name: str, given: dict[str, Any], bounds: str) -> Table:
    from carom import billiards
    from carom.errors import did_you_mean

    over, colon, flat = name.partition(":")
    given, pull = _force(name, given)
    kind = flat if colon else name
    known = [*SIZES, "cylinder:circle"]
    if kind not in SIZES or (colon and (over != "cylinder" or kind in SOLIDS)):
        raise CaromError(Fault("orbit", "table", f"one of {', '.join(known)}", repr(name), did_you_mean(name, known)))
    own = SIZES[kind] + (("height", "acceleration") if colon else ())
    faults = [
        f"--{key}: a {name} has no such size; it has {', '.join(f'--{k}' for k in own)}"
        for key in given
        if key not in own
    ]
    if faults:
        raise CaromError(*faults)
    sizes = dict(given)
    # a scalar acceleration acts along the cylinder; the height is the cylinder's unless the section has one
    axial = {"acceleration", "height"} - ({"height"} & set(SIZES[kind])) if colon else set()
    solid = {key: sizes.pop(key) for key in axial & set(sizes)}
    if "vertices" in sizes:
        sizes["vertices"] = _points(sizes["vertices"])
    section = named_table(kind, sizes, bounds)
    made = billiards.cylinder(section, **solid) if colon else section
    return made if pull is None else billiards.under(made, pull)


def _force(name: str, given: dict[str, Any]) -> tuple[dict[str, Any], tuple[float, ...] | None]:
    """Return the sizes, a scalar acceleration along the table among them, and an acceleration vector (or None)."""
    text = given.get("acceleration")
    if text is None:
        return given, None
    rest = {key: value for key, value in given.items() if key != "acceleration"}
    over, colon, flat = name.partition(":")
    axial = bool(colon) or "acceleration" in SIZES.get(flat or over, ())
    if axial and "," not in text:
        return rest | {"acceleration": _numbers("--acceleration", text, 1)[0]}, None
    return rest, _numbers("--acceleration", text, 3 if colon or over in SOLIDS else 2)


def _points(text: str) -> list[tuple[float, ...]]:
    return [_numbers("--vertices", part, 2) for part in text.split()]


def _numbers(option: str, text: str, count: int) -> tuple[float, ...]:
    try:
        found = tuple(float(part) for part in text.replace(",", " ").split())
    except ValueError:
        found = ()
    if len(found) != count:
        what = {1: "a number", 2: "two numbers, such as 0.1,0.2", 3: "three numbers, such as 0.1,0.2,0"}[count]
        raise CaromError(f"{option}: expected {what}, got {text!r}")
    return found


def _ball(table: Table, kappa: float | None, radius: float | None) -> Any:
    from carom.billiards.setup import default_ball
    from carom.bodies import Ball, Disc

    if kappa is None and radius is None:
        return None
    usual = default_ball(table)
    make = Disc if table.dimension == 2 else Ball
    return make(usual.radius if radius is None else radius, 1.0, usual.kappa if kappa is None else kappa)


def _surface(law: str, e: float | None, mu: float | None, beta: float | None) -> Any:
    from carom.billiards.setup import law_of, needs_surface
    from carom.bodies import Surface

    given = {"restitution": e, "friction": mu, "tangential_restitution": beta}
    chosen: dict[str, Any] = {key: value for key, value in given.items() if value is not None}
    used = law_of(law, Surface() if needs_surface(law) else None)[0].free
    if idle := [key for key in chosen if key not in used]:
        raise CaromError(*(f"--{key.replace('_', '-')}: law {law} does not use it; --law contact does" for key in idle))
    return Surface(**chosen) if chosen or needs_surface(law) else None


def _given(table: Table, position: str | None, velocity: str | None, spin: str | None, count: int) -> Any:
    """Return the initial state that the options give; None where it is to be sampled."""
    from carom import billiards
    from carom.billiards.orbits import require_integer

    d = table.dimension
    if (position is None) != (velocity is None):
        missing, given = ("--velocity", "--position") if velocity is None else ("--position", "--velocity")
        raise CaromError(f"{missing}: expected one together with {given}, got none")
    if position is None or velocity is None:
        if spin is not None:
            raise CaromError("--spin: expected --position and --velocity with it, got none")
        require_integer("orbits", count)
        return None
    if count != 1:
        raise CaromError(f"--orbits: expected 1 with --position, got {count}; without it, initial states are sampled")
    turn = () if spin is None else _numbers("--spin", spin, 1 if d == 2 else 3)
    start = (_numbers("--position", position, d), _numbers("--velocity", velocity, d))
    return billiards.Start(*start, (turn[0] if turn else 0.0) if d == 2 else (turn or 0.0))


def _sampled(table: Table, count: int, seed: int, ball: Any, law: str) -> Any:
    """Return initial states from the invariant measure."""
    from carom import billiards

    try:
        return billiards.starts(table, count, seed, ball=ball, law=law)
    except CaromError as error:
        raise CaromError(
            *(fault.replace("starts of your own", "--position and --velocity") for fault in error.faults)
        ) from None


def _draw(found: Orbit, plot: Path | None, portrait: Path | None, boundary: Path | None) -> None:
    if plot is None and portrait is None and boundary is None:
        return
    from carom.plot import plot_boundary, plot_orbit, plot_portrait, save

    for path, make in ((plot, plot_orbit), (portrait, plot_portrait), (boundary, plot_boundary)):
        if path is not None:
            save(make(found), path)
            wrote(path)
