"""``carom orbit``: one ball in a table, a no-slip billiard or another; its bounces, portraits, exponents."""

from __future__ import annotations

import json
import math
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

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
    height: Annotated[float | None, _size("of a rectangle, a box; of a cylinder with lids")] = None,
    depth: Annotated[float | None, _size("of a box, in z")] = None,
    angle: Annotated[float | None, _size("of a wedge, degrees")] = None,
    side: Annotated[float | None, _size("of Sinai's square cell")] = None,
    period: Annotated[float | None, _size("of a periodic strip")] = None,
    distance: Annotated[float | None, _size("between plates")] = None,
    acceleration: Annotated[float | None, _size("along a strip (x), plates or a cylinder (z), m/s^2")] = None,
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
    from carom.plot import require_matplotlib, require_writable

    pictures = [path for path in (plot, portrait, boundary) if path is not None]
    if pictures:
        require_matplotlib()
        for path in pictures:
            require_writable(path)
    given = {
        "radius": radius, "major": major, "minor": minor, "straight": straight, "sides": sides, "vertices": vertices,
        "width": width, "height": height, "depth": depth, "angle": angle, "side": side, "period": period,
        "distance": distance, "acceleration": acceleration,
    }  # fmt: skip
    made = _table(table, {k: v for k, v in given.items() if v is not None}, bounds)
    ball, surface = _ball(made, kappa, ball_radius), _surface(law, restitution, friction, tangential_restitution)
    options = {"ball": ball, "law": law, "surface": surface}
    begin = _start(made, position, velocity, spin, orbits, seed, ball, law)
    found = _follow(made, begin, bounces, options, corners)
    facts = _facts(found, made, begin, options, lyapunov=lyapunov, back=reverse)
    if json_:
        facts["bounces"] = _bounces(found)
        print(json.dumps(facts, indent=2, allow_nan=False))  # noqa: T201
    else:
        _tell(facts, found)
    _draw(found, plot, portrait, boundary)


def _table(name: str, given: dict[str, Any], bounds: str) -> Table:
    from carom import orbits
    from carom.checks import nearest

    over, colon, flat = name.partition(":")
    kind = flat if colon else name
    known = [*SIZES, "cylinder:circle"]
    if kind not in SIZES or (colon and over != "cylinder"):
        raise CaromError(f"orbit: table: expected one of {', '.join(known)}, got {name!r}; {nearest(name, known)}")
    own = SIZES[kind] + (("height", "acceleration") if colon else ())
    faults = [
        f"--{key}: {name} has no such size; it has {', '.join(f'--{k}' for k in own)}"
        for key in given
        if key not in own
    ]
    if faults:
        raise CaromError(*faults)
    sizes = dict(given)
    solid = {}
    if colon and kind not in ("rectangle", "polygon"):
        solid = {key: sizes.pop(key) for key in ("height", "acceleration") if key in sizes and key not in SIZES[kind]}
    elif colon:
        solid = {key: sizes.pop(key) for key in ("acceleration",) if key in sizes}
    section = _make(orbits, kind, sizes, bounds)
    if not colon:
        return section
    return orbits.cylinder(section, **solid)


def _make(orbits: Any, kind: str, sizes: dict[str, Any], bounds: Any) -> Table:  # noqa: PLR0911  (one return a table)
    b = {"bounds": bounds}
    if kind == "polygon":
        if "vertices" in sizes:
            if len(sizes) > 1:
                raise CaromError("--vertices: expected no --sides or --radius beside them")
            return orbits.polygon(_points(sizes["vertices"]), **b)  # type: ignore[no-any-return]
        return orbits.regular(sizes.pop("sides", 3), **sizes, **b)  # type: ignore[no-any-return]
    if kind == "wedge":
        return orbits.wedge(math.radians(sizes.get("angle", 40.0)), **b)  # type: ignore[no-any-return]
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
    if law in ("no-slip", "rolling", "conventional") and chosen:
        raise CaromError(
            *(f"--{key.replace('_', '-')}: law {law} needs none; --law contact reads it" for key in chosen)
        )
    return Surface(**chosen) if chosen or law == "contact" else None


def _start(
    table: Table,
    position: str | None,
    velocity: str | None,
    spin: str | None,
    count: int,
    seed: int,
    ball: Any,
    law: str,
) -> Any:
    from carom import orbits

    d = table.dimension
    if (position is None) != (velocity is None):
        missing, given = ("--velocity", "--position") if velocity is None else ("--position", "--velocity")
        raise CaromError(f"{missing}: expected one beside {given}, got none")
    if position is None or velocity is None:
        if spin is not None:
            raise CaromError("--spin: expected --position and --velocity beside it, got none")
        try:
            return orbits.starts(table, count, seed, ball=ball, law=law)
        except CaromError as error:
            if "wall of some length" not in str(error):
                raise
            raise CaromError(
                f"orbit: start: {table.name} has no end, so none can be drawn; give --position and --velocity"
            ) from None
    if count != 1:
        raise CaromError(f"--orbits: expected 1 where a start is given, got {count}; left out, starts are drawn")
    turn = () if spin is None else _numbers("--spin", spin, 1 if d == 2 else 3)
    start = (_numbers("--position", position, d), _numbers("--velocity", velocity, d))
    return orbits.Start(*start, (turn[0] if turn else 0.0) if d == 2 else (turn or 0.0))


def _follow(table: Table, begin: Any, bounces: int, options: dict[str, Any], corners: str) -> Orbit:
    """With a progress bar where it takes long and someone looks."""
    from rich.console import Console
    from rich.progress import BarColumn, Progress, TaskProgressColumn, TextColumn, TimeRemainingColumn

    from carom import orbits

    console = Console(stderr=True, highlight=False)
    if not console.is_terminal:
        return orbits.orbit(table, begin, bounces, corners=corners, **options)
    columns = (TextColumn("orbits"), BarColumn(), TaskProgressColumn(), TimeRemainingColumn())
    with Progress(*columns, console=console, transient=True) as bar:
        task = bar.add_task("orbits", total=None)
        return orbits.orbit(
            table, begin, bounces, corners=corners, **options,
            progress=lambda done, size: bar.update(task, completed=done, total=size),
        )  # fmt: skip


def _facts(
    found: Orbit, table: Table, begin: Any, options: dict[str, Any], *, lyapunov: bool, back: bool
) -> dict[str, Any]:
    """What is known of the orbits, as plain numbers; None where there is none."""
    import numpy as np

    from carom import orbits

    ball = found.setup.ball
    made, ends = np.atleast_1d(found.count), np.atleast_1d(found.ended)
    facts: dict[str, Any] = {
        "table": {"name": table.name, "bounds": table.bounds, **table.sizes},
        "ball": {"radius": float(ball.radius), "kappa": float(ball.kappa)},
        "law": found.setup.law,
        "orbits": len(made),
        "count": int(made.sum()),
        "ended": {str(name): int((ends == name).sum()) for name in np.unique(ends)},
        "energy_drift": None,
    }
    whole = made == found.t.shape[-1]
    if made.max(initial=0) > 0:
        speed = np.atleast_2d(found.speed)
        last = speed[np.arange(len(made)), np.maximum(made, 1) - 1]
        facts["mean_time_between_bounces"] = float(np.nansum(found.last[..., 0]) / made.sum())
        if found.setup.keeps and not any(table.pull):
            facts["energy_drift"] = float(np.nanmax(np.abs((last / speed[:, 0]) ** 2 - 1)))
    if whole.all():
        periods = np.atleast_1d(orbits.period(found))
        names, counts = np.unique(periods, return_counts=True)
        facts["periods"] = {str(p): int(c) for p, c in zip(names.tolist(), counts.tolist(), strict=True) if p}
        if table.name == "circle" or (table.name == "cylinder" and table.sizes["section"] == "circle"):
            caustics = orbits.caustics(found)
            facts["caustics"] = np.atleast_2d(caustics.radii)[0].tolist() if len(made) == 1 else None
        if (any(table.pull) or table.name in ("strip", "plates", "cylinder")) and found.t.shape[-1] >= 4:
            axis = 2 if table.name in ("plates", "cylinder") else 0
            drift = orbits.drift(found, axis)
            names_ = ("extent", "velocity", "acceleration", "growth")
            if len(made) == 1:
                facts["drift"] = {"axis": "xyz"[axis]} | {n: _plain(np.ravel(getattr(drift, n))[0]) for n in names_}
    if back:
        _orbit, error = orbits.reverse(found)
        facts["reversal_error"] = float(np.max(error))
    if lyapunov:
        spectrum = orbits.lyapunov(table, begin, found.t.shape[-1], **options)
        mean = spectrum.per_bounce.reshape(-1, spectrum.per_bounce.shape[-1])
        facts["lyapunov"] = {
            "per_bounce": [_plain(x) for x in np.nanmean(mean, axis=0)],
            "per_time": [_plain(x) for x in np.nanmean(spectrum.per_time.reshape(mean.shape), axis=0)],
            "error": [
                _plain(x) for x in np.sqrt(np.nanmean(spectrum.error.reshape(mean.shape) ** 2, axis=0) / len(mean))
            ],
        }
    return facts


def _plain(x: Any) -> float | None:
    return float(x) if math.isfinite(x) else None


def _bounces(found: Orbit) -> list[Any]:
    """Every bounce: of one orbit a list, of many a list of lists."""
    import numpy as np

    d = found.setup.table.dimension
    n = found.t.shape[-1]
    flat = found.setup.shape.sphere is None
    columns = {
        "t": found.t, "piece": found.piece, "s": found.arc if flat else None, "position": found.position,
        "velocity": found.velocity, "spin": found.spin, "along": found.along, "across": found.across,
    }  # fmt: skip
    rows = []
    counts = np.atleast_1d(found.count)
    reshaped = {
        key: np.asarray(value).reshape(
            len(counts), n, *([-1] if key in ("position", "velocity") or (key == "spin" and d == 3) else [])
        )
        for key, value in columns.items()
        if value is not None
    }
    for m, count in enumerate(counts):
        lists = {key: value[m, :count].tolist() for key, value in reshaped.items()}
        rows.append([dict(zip(lists, values, strict=True)) for values in zip(*lists.values(), strict=True)])
    return rows[0] if len(rows) == 1 else rows


def _tell(facts: dict[str, Any], found: Orbit) -> None:
    """Tables for people."""
    from rich import box
    from rich.table import Table as Grid

    from carom.cli.shared import out

    console = out()
    grid = Grid(box=None, show_header=False, pad_edge=False)
    grid.add_column(style="bold")
    grid.add_column()
    sizes = ", ".join(
        f"{k} {v:.6g}" if isinstance(v, float) else f"{k} {v}"
        for k, v in facts["table"].items()
        if k not in ("name", "bounds")
    )
    grid.add_row("table", f"{facts['table']['name']}: {sizes}; bounds the {facts['table']['bounds']}")
    grid.add_row(
        "ball", f"kappa {facts['ball']['kappa']:.6g}, radius {facts['ball']['radius']:.6g} m; law {facts['law']}"
    )
    ends = ", ".join(f"{count} {name}" if facts["orbits"] > 1 else name for name, count in facts["ended"].items())
    grid.add_row(
        "bounces", f"{facts['count']:,} of {facts['orbits']:,} orbit{'s' * (facts['orbits'] > 1)}; ended: {ends}"
    )
    if facts.get("mean_time_between_bounces") is not None:
        grid.add_row("mean time", f"{facts['mean_time_between_bounces']:.6g} s between bounces")
    if facts["energy_drift"] is not None:
        grid.add_row("energy", f"kept to {facts['energy_drift']:.1e}")
    if facts.get("periods"):
        shown = ", ".join(p if facts["orbits"] == 1 else f"{p} ({c})" for p, c in facts["periods"].items())
        grid.add_row("period", shown)
    elif "periods" in facts:
        grid.add_row("period", "none seen")
    if facts.get("caustics"):
        grid.add_row("caustics", " and ".join(f"{r:.9g}" for r in facts["caustics"]) + " m")
    if facts.get("drift"):
        d = facts["drift"]
        kind = "bounded" if d["growth"] is not None and d["growth"] < 1.3 else "not bounded, so far"
        grid.add_row(
            "along " + d["axis"],
            f"{kind}: extent {d['extent']:.6g} m, mean velocity {d['velocity']:.3g} m/s, acceleration {d['acceleration']:.3g} m/s²",
        )
    if facts.get("reversal_error") is not None:
        grid.add_row("backwards", f"comes back to {facts['reversal_error']:.1e} m")
    console.print(grid)
    if facts.get("lyapunov"):
        spectrum = Grid(box=box.SIMPLE_HEAD, pad_edge=False)
        for name in ("Lyapunov exponents", "per bounce", "±", "per second"):
            spectrum.add_column(name, justify="right")
        both = facts["lyapunov"]
        for number, row in enumerate(zip(both["per_bounce"], both["error"], both["per_time"], strict=True)):
            spectrum.add_row(str(number + 1), *("–" if x is None else f"{x:.5f}" for x in row))
        console.print(spectrum)
    if facts["orbits"] == 1 and facts["count"]:
        console.print(_first_bounces(found))


def _first_bounces(found: Orbit) -> Any:
    """The first five bounces and the last, as a table; at 80 columns nothing is cut."""
    import numpy as np
    from rich.table import Table as Grid

    n = found.t.shape[-1]
    x = found.position.reshape(n, -1)
    columns = {"t": found.t}
    if found.setup.planar:
        columns |= {"s": found.arc, "x": x[:, 0], "y": x[:, 1]}
    else:
        columns["z"] = x[:, 2]
    columns |= {"v along": found.along, "v across": found.across}
    spins = found.spin.reshape(n, -1)
    grid = Grid(box=None, padding=(0, 1, 0, 0), title="bounces (m, s, rad)", title_style="dim", title_justify="left")
    for name in ("", *columns, "spin"):
        grid.add_column(name, justify="right", no_wrap=True, header_style="bold")
    count = int(np.ravel(found.count)[0])
    for k in [*range(min(count, 5)), *([count - 1] if count > 5 else [])]:
        if k > 5:
            grid.add_row("…")
        numbers = [float(column.reshape(n)[k]) for column in columns.values()]
        turn = " ".join(f"{w:.3g}" if len(spins[k]) > 1 else f"{w:.4g}" for w in spins[k])
        grid.add_row(str(k + 1), *(f"{number + 0.0:.4g}" if math.isfinite(number) else "–" for number in numbers), turn)
    return grid


def _draw(found: Orbit, plot: Path | None, portrait: Path | None, boundary: Path | None) -> None:
    if plot is None and portrait is None and boundary is None:
        return
    from rich.console import Console

    from carom.plot import save
    from carom.plot.orbits import plot_boundary, plot_orbit, plot_portrait

    console = Console(stderr=True, highlight=False)
    for path, make in ((plot, plot_orbit), (portrait, plot_portrait), (boundary, plot_boundary)):
        if path is not None:
            save(make(found), path)
            console.print(f"[dim]written: {path}[/]", soft_wrap=True)
