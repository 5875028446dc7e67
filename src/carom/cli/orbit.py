"""``carom orbit``: one ball in a table, a no-slip billiard or another; its bounces, portraits, exponents."""

from __future__ import annotations

import json
import math
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from carom.cli.orbit_report import every_bounce, orbit_facts, tell_orbit
from carom.cli.places import require_places
from carom.cli.shared import attempt, working, wrote
from carom.errors import CaromError

if TYPE_CHECKING:
    from carom.orbits import Orbit, Table

TABLE, BALL, LAW, START, RESULT = "The table", "The ball", "The law", "The start", "What to make of it"

# What each table is made of: the options that it reads.
SIZES = {
    "circle": ("radius",),
    "ellipse": ("major", "minor"),
    "stadium": ("straight", "radius"),
    "polygon": ("sides", "radius", "vertices"),
    "rectangle": ("width", "height"),
    "strip": ("width", "acceleration"),
    "wedge": ("angle",),
    "sinai": ("radius", "side"),
    "periodic-strip": ("period", "width", "radius"),
    "sphere": ("radius",),
    "box": ("width", "height", "depth"),
    "plates": ("distance", "acceleration"),
}
SOLIDS = ("sphere", "box", "plates")


def register(app: typer.Typer) -> None:
    """Add the verb."""
    app.command()(orbit)


def _size(text: str, **more: Any) -> Any:
    return typer.Option(help=text, rich_help_panel=TABLE, show_default=False, **more)


def orbit(
    table: Annotated[
        str, typer.Argument(help=f"{', '.join(SIZES)}; or cylinder:NAME, a cylinder along z over one of the plane")
    ],
    bounces: Annotated[int, typer.Option(help="how many")] = 200,
    bounds: Annotated[
        str, typer.Option(help="what the table bounds: centre or surface", rich_help_panel=TABLE)
    ] = "centre",
    radius: Annotated[
        float | None, _size("of a circle, a stadium's ends, a polygon's corners, a scatterer, a sphere; m")
    ] = None,
    major: Annotated[float | None, _size("half axis of an ellipse in x")] = None,
    minor: Annotated[float | None, _size("half axis of an ellipse in y")] = None,
    straight: Annotated[float | None, _size("length of a stadium's straight sides")] = None,
    sides: Annotated[int | None, _size("of a regular polygon")] = None,
    vertices: Annotated[str | None, _size("of any polygon: 'x,y x,y x,y ...'")] = None,
    width: Annotated[float | None, _size("of a rectangle, a strip, a box")] = None,
    height: Annotated[
        float | None, _size("of a rectangle, a box; or between the lids of a cylinder, but over a rectangle")
    ] = None,
    depth: Annotated[float | None, _size("of a box, in z")] = None,
    angle: Annotated[float | None, _size("of a wedge, degrees")] = None,
    side: Annotated[float | None, _size("of Sinai's square cell")] = None,
    period: Annotated[float | None, _size("of a periodic strip")] = None,
    distance: Annotated[float | None, _size("between plates")] = None,
    acceleration: Annotated[
        str | None,
        _size("of a constant force, m/s^2: x,y or x,y,z; or a number, along a strip (x), plates, a cylinder (z)"),
    ] = None,
    kappa: Annotated[
        float | None, typer.Option(help="I/(m a^2)", show_default="0.5; in space 0.4", rich_help_panel=BALL)
    ] = None,
    ball_radius: Annotated[
        float | None, typer.Option(help="m", show_default="1; 0.1 where the surface is bounded", rich_help_panel=BALL)
    ] = None,
    law: Annotated[
        str, typer.Option(help="no-slip, mirror, contact, rolling, or your own: my_law.py:law", rich_help_panel=LAW)
    ] = "no-slip",
    restitution: Annotated[
        float | None, typer.Option(help="of law contact", show_default="1", rich_help_panel=LAW)
    ] = None,
    friction: Annotated[
        float | None, typer.Option(help="of law contact", show_default="inf", rich_help_panel=LAW)
    ] = None,
    tangential_restitution: Annotated[
        float | None, typer.Option(help="of law contact", show_default="0", rich_help_panel=LAW)
    ] = None,
    corners: Annotated[
        str, typer.Option(help="at a corner: end, or pass (one side, then the other)", rich_help_panel=LAW)
    ] = "end",
    position: Annotated[
        str | None, typer.Option(help="of the centre: x,y or x,y,z", rich_help_panel=START, show_default="drawn")
    ] = None,
    velocity: Annotated[
        str | None, typer.Option(help="x,y or x,y,z; m/s", rich_help_panel=START, show_default="drawn")
    ] = None,
    spin: Annotated[
        str | None, typer.Option(help="rad/s; in space x,y,z", rich_help_panel=START, show_default="drawn, or 0")
    ] = None,
    orbits: Annotated[int, typer.Option(help="so many, drawn from the invariant measure", rich_help_panel=START)] = 1,
    seed: Annotated[int, typer.Option(help="of what is drawn", rich_help_panel=START)] = 0,
    plot: Annotated[
        Path | None, typer.Option(help="picture of the (first) orbit in the table", rich_help_panel=RESULT)
    ] = None,
    portrait: Annotated[Path | None, typer.Option(help="picture of the velocity phase", rich_help_panel=RESULT)] = None,
    boundary: Annotated[Path | None, typer.Option(help="picture of the boundary map", rich_help_panel=RESULT)] = None,
    lyapunov: Annotated[
        bool, typer.Option("--lyapunov", help="the Lyapunov spectrum as well", rich_help_panel=RESULT)
    ] = False,
    reverse: Annotated[
        bool, typer.Option("--reverse", help="run it backwards as well", rich_help_panel=RESULT)
    ] = False,
    json_: Annotated[bool, typer.Option("--json", help="as JSON, with every bounce", rich_help_panel=RESULT)] = False,
) -> None:
    """One ball in a table: follow its bounces, as no-slip billiard or by another law.

    Without a start one is drawn from the invariant measure. Sizes left out are about 1.
    """
    from carom import orbits as library
    from carom.orbits.setup import law_of, prepare, setup_of
    from carom.orbits.verbs import require_reversible, whole

    faults: list[str] = []
    require_places(faults, {"--plot": plot, "--portrait": portrait, "--boundary": boundary})
    given = {
        "radius": radius, "major": major, "minor": minor, "straight": straight, "sides": sides, "vertices": vertices,
        "width": width, "height": height, "depth": depth, "angle": angle, "side": side, "period": period,
        "distance": distance, "acceleration": acceleration,
    }  # fmt: skip
    made = attempt(faults, _table, table, {k: v for k, v in given.items() if v is not None}, bounds)
    before = len(faults)
    surface = attempt(faults, _surface, law, restitution, friction, tangential_restitution)
    ball = None if made is None else attempt(faults, _ball, made, kappa, ball_radius)
    together = len(faults) == before  # (else each of these would be told again below)
    attempt(faults, whole, "bounces", bounces)
    attempt(faults, whole, "seed", seed, 0)
    begin = None if made is None else attempt(faults, _given, made, position, velocity, spin, orbits)
    if together:
        if made is None:
            attempt(faults, law_of, law, surface)
        elif (setup := attempt(faults, setup_of, made, ball, law, surface, corners)) is not None:
            if reverse:
                attempt(faults, require_reversible, setup)
            if begin is not None:
                attempt(faults, prepare, setup, begin)
    if faults:
        raise CaromError(*faults)
    options = {"ball": ball, "law": law, "surface": surface}
    if begin is None:
        begin = _drawn(made, orbits, seed, ball, law)
    with working("orbits") as say:
        found = library.orbit(made, begin, bounces, corners=corners, progress=say, **options)
        facts = orbit_facts(found, made, begin, options, lyapunov=lyapunov, back=reverse)
    if json_:
        facts["bounces"] = every_bounce(found)
        print(json.dumps(facts, indent=2, allow_nan=False))  # noqa: T201
    else:
        tell_orbit(facts, found)
    _draw(found, plot, portrait, boundary)


def _table(name: str, given: dict[str, Any], bounds: str) -> Table:
    from carom import orbits
    from carom.checks import meant

    over, colon, flat = name.partition(":")
    given, pull = _force(name, given)
    kind = flat if colon else name
    known = [*SIZES, "cylinder:circle"]
    if kind not in SIZES or (colon and (over != "cylinder" or kind in SOLIDS)):
        raise CaromError(f"orbit: table: expected one of {', '.join(known)}, got {name!r}{meant(name, known)}")
    own = SIZES[kind] + (("height", "acceleration") if colon else ())
    faults = [
        f"--{key}: {name} has no such size; it has {', '.join(f'--{k}' for k in own)}"
        for key in given
        if key not in own
    ]
    if faults:
        raise CaromError(*faults)
    sizes = dict(given)
    # the force acts along the cylinder, the height is its own unless the section has one
    axial = {"acceleration", "height"} - ({"height"} & set(SIZES[kind])) if colon else set()
    solid = {key: sizes.pop(key) for key in axial & set(sizes)}
    section = _make(orbits, kind, sizes, bounds)
    made = orbits.cylinder(section, **solid) if colon else section
    return made if pull is None else orbits.under(made, pull)


def _force(name: str, given: dict[str, Any]) -> tuple[dict[str, Any], tuple[float, ...] | None]:
    """The sizes, with an acceleration along the table as a number among them; one with components apart from them."""
    text = given.get("acceleration")
    if text is None:
        return given, None
    rest = {key: value for key, value in given.items() if key != "acceleration"}
    over, colon, flat = name.partition(":")
    axial = bool(colon) or "acceleration" in SIZES.get(flat or over, ())
    if axial and "," not in text:
        return rest | {"acceleration": _numbers("--acceleration", text, 1)[0]}, None
    return rest, _numbers("--acceleration", text, 3 if colon or over in SOLIDS else 2)


def _make(orbits: Any, kind: str, sizes: dict[str, Any], bounds: Any) -> Table:  # noqa: PLR0911  (one return a table)
    b = {"bounds": bounds}
    if kind == "polygon":
        if "vertices" in sizes:
            if len(sizes) > 1:
                raise CaromError("--vertices: expected no --sides or --radius beside them")
            return orbits.polygon(_points(sizes["vertices"]), **b)  # type: ignore[no-any-return]
        return orbits.regular(sizes.pop("sides", 3), **sizes, **b)  # type: ignore[no-any-return]
    if kind == "wedge":
        angle = sizes.get("angle", 40.0)
        if not 0 < angle < 180:
            raise CaromError(f"--angle: expected degrees > 0 and < 180, got {angle:g}")
        return orbits.wedge(math.radians(angle), **b)  # type: ignore[no-any-return]
    if kind == "periodic-strip":
        r = sizes.pop("radius", 0.2)
        return orbits.periodic_strip(**sizes, scatterers=((0.0, 0.0, r),), **b)  # type: ignore[no-any-return]
    if kind == "box":
        return orbits.box([sizes.get(key, 1.0) for key in ("width", "height", "depth")], **b)  # type: ignore[no-any-return]
    if kind == "plates":
        g = sizes.pop("acceleration", 0.0)
        return orbits.plates(**sizes, acceleration=(0.0, g), **b)  # type: ignore[no-any-return]
    return getattr(orbits, kind)(**sizes, **b)  # type: ignore[no-any-return]


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
    from carom.ball import Ball, Disc
    from carom.orbits.setup import default_ball

    if kappa is None and radius is None:
        return None
    usual = default_ball(table)
    make = Disc if table.dimension == 2 else Ball
    return make(usual.radius if radius is None else radius, 1.0, usual.kappa if kappa is None else kappa)


def _surface(law: str, e: float | None, mu: float | None, beta: float | None) -> Any:
    from carom.surface import Surface

    given = {"restitution": e, "friction": mu, "tangential_restitution": beta}
    chosen: dict[str, Any] = {key: value for key, value in given.items() if value is not None}
    idle = set(chosen) if law in ("no-slip", "rolling", "conventional") else set()
    if law == "mirror":
        idle = set(chosen) - {"restitution"}
    if idle:
        raise CaromError(
            *(
                f"--{key.replace('_', '-')}: law {law} needs none; --law contact reads it"
                for key in given
                if key in idle
            )
        )
    return Surface(**chosen) if chosen or law == "contact" else None


def _given(table: Table, position: str | None, velocity: str | None, spin: str | None, count: int) -> Any:
    """The start that the options give; None where it is to be drawn."""
    from carom import orbits
    from carom.orbits.verbs import whole

    d = table.dimension
    if (position is None) != (velocity is None):
        missing, given = ("--velocity", "--position") if velocity is None else ("--position", "--velocity")
        raise CaromError(f"{missing}: expected one beside {given}, got none")
    if position is None or velocity is None:
        if spin is not None:
            raise CaromError("--spin: expected --position and --velocity beside it, got none")
        whole("orbits", count)
        return None
    if count != 1:
        raise CaromError(f"--orbits: expected 1 where a start is given, got {count}; left out, starts are drawn")
    turn = () if spin is None else _numbers("--spin", spin, 1 if d == 2 else 3)
    start = (_numbers("--position", position, d), _numbers("--velocity", velocity, d))
    return orbits.Start(*start, (turn[0] if turn else 0.0) if d == 2 else (turn or 0.0))


def _drawn(table: Table, count: int, seed: int, ball: Any, law: str) -> Any:
    """Starts from the invariant measure."""
    from carom import orbits

    try:
        return orbits.starts(table, count, seed, ball=ball, law=law)
    except CaromError as error:
        raise CaromError(
            *(fault.replace("starts of your own", "--position and --velocity") for fault in error.faults)
        ) from None


def _draw(found: Orbit, plot: Path | None, portrait: Path | None, boundary: Path | None) -> None:
    if plot is None and portrait is None and boundary is None:
        return
    from carom.plot import save
    from carom.plot.orbits import plot_boundary, plot_orbit, plot_portrait

    for path, make in ((plot, plot_orbit), (portrait, plot_portrait), (boundary, plot_boundary)):
        if path is not None:
            save(make(found), path)
            wrote(path)
