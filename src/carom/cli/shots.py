"""Shots before and after a run: `carom aim`, `carom explore`, `carom scene`."""

from __future__ import annotations

import json
import shlex
import sys
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from carom.cli.options import (
    OUTPUT,
    comma_separated,
    option,
    parse_pair,
    quantity,
    require_outputs,
    shared,
    write_new,
    wrote,
)
from carom.cli.parameters import Given, of_library
from carom.cli.streams import note, say, say_json, say_notes
from carom.errors import CaromError

if TYPE_CHECKING:
    from carom.sweeps.aiming import Aims


TARGET, START = "Target", "Start"


@of_library("sweeps.aiming:aim", without=("reach",), panels={START: "errors", OUTPUT: "solutions"})
def aim(
    scene: Annotated[Path, typer.Argument(metavar="SCENE.toml", help="A scene file; carom scene new FILE writes one.")],
    *,
    ball: Annotated[
        str, option(TARGET, "Number or name of the ball that reaches the target.", "--ball", metavar="BALL")
    ] = "0",
    hit: Annotated[
        list[str] | None,
        option(TARGET, "A ball to be touched; may be repeated, in any order.", "--hit", metavar="BALL"),
    ] = None,
    cushions: Annotated[
        int, option(TARGET, "Cushions before the last of them, at least.", "--cushions", min=0, metavar="N")
    ] = 0,
    pocket: Annotated[
        str | None, option(TARGET, "Pocket into which the ball falls.", "--pocket", metavar="NAME|any")
    ] = None,
    point: Annotated[str | None, option(TARGET, "Place where the ball ends, m.", "--point", metavar="X,Y")] = None,
    within: Annotated[
        float | None,
        option(
            TARGET, "Largest distance of the end from that place, m.", "--within", unit="m", show_default="its radius"
        ),
    ] = None,
    speed: Annotated[
        float | None,
        option(
            TARGET,
            "Required speed at the target ball or pocket, m/s (±10 %).",
            "--speed",
            unit="m/s",
            show_default="any",
        ),
    ] = None,
    free: Annotated[
        list[str] | None,
        option(
            START,
            "What may be chosen: balls.0.velocity, balls.0.strike, balls.0.strike.offset, ...; may be repeated.",
            "--free",
            metavar="PATH[=LOW:HIGH]",
            show_default="balls.0.velocity, or the strike of a ball that is struck",
        ),
    ] = None,
    given: Given,
    windows: Annotated[
        int | None,
        option(
            OUTPUT,
            "Acceptance windows of directions at so many speeds, in place of solutions.",
            "--windows",
            min=1,
            metavar="SPEEDS",
        ),
    ] = None,
    allow_own_laws: Annotated[bool, shared("allow_own_laws")] = False,
    as_json: Annotated[bool, shared("json")] = False,
    quiet: Annotated[bool, shared("quiet")] = False,
    plot: Annotated[Path | None, shared("plot")] = None,
) -> None:
    """Find starts that reach a target: a ball hit after so many cushions, a pocket, a place; ranked by a player's errors."""
    from carom.scene.toml import load_scene

    found = given.faults
    require_outputs(found, {"--plot": plot})
    made = found.attempt(load_scene, scene, allow_own_laws=allow_own_laws)
    place = None if point is None else found.attempt(parse_pair, "--point", point)
    target: dict[str, Any] = {
        "ball": ball,
        "hit": tuple(hit) if hit else None,
        "cushions": cushions,
        "pocket": pocket,
        "point": place,
        "within": within,
        "speed": speed,
    }
    for one in hit or () if made is not None else ():
        if len(names := comma_separated(one)) > 1 and one not in made.ball_names:
            found.add("--hit", "a ball", repr(one), f"several are {' '.join(f'--hit {name}' for name in names)}")
    struck = [i for i, one in enumerate(made.balls) if one.strike is not None] if made is not None else []
    usual = f"balls.{struck[0]}.strike" if struck else "balls.0.velocity"
    ranges = found.attempt(_ranges, free or [usual])
    if found or made is None or ranges is None:
        raise CaromError(*found)
    from carom.cli.console import out, working
    from carom.scene.openings import rolling_notes, scene_notes

    if not quiet:
        say_notes(scene_notes(made) + rolling_notes(made))
    from carom.sweeps.aiming import aim as solve
    from carom.sweeps.aiming import aim_windows

    if windows is not None:
        with working("shots", quiet=quiet) as show:
            wide = aim_windows(made, ranges, target, speeds=windows, progress=show)
        if as_json:
            say_json(wide.as_dict())
        elif not quiet:
            out().table(wide.table())
        if plot is not None:
            from carom.plot.sweeps import plot_windows

            plot_windows(wide, plot)
            wrote(plot)
        return

    with working("aiming", quiet=quiet) as show:
        aims = solve(made, ranges, target, progress=show and (lambda _done, _total, text: show(0, None, text)), **given)
    if as_json:
        plain = [
            {
                **one.values,
                "success": one.chance,
                "spread_m": one.spread.tolist() if one.linear else None,
                "sequence": list(one.sequence),
            }
            for one in aims
        ]
        say_json(plain)
    elif not quiet:
        _show(aims, scene)
    if plot is not None:
        from carom.plot.trajectory import DRAWN, plot_aims

        plot_aims(aims, plot)
        if len(aims) > DRAWN and not quiet:
            note(f"note: the figure has the first {DRAWN} of the {len(aims)} shots")
        wrote(plot)


def _ranges(free: list[str]) -> Any:
    """Return paths, with their ranges where any is given."""
    from carom.sweeps.aiming import RANGES

    pairs = [text.partition("=") for text in free]
    if not any(sign for _path, sign, _range in pairs):
        return [path for path, _sign, _range in pairs]
    first = {"velocity": "speed", "strike": "speed", "offset": "side"}
    found = {}
    for path, sign, text in pairs:
        last = path.rpartition(".")[2]
        usual = RANGES.get(first.get(last, last), (0.0, 1.0))
        found[path] = parse_pair(f"--free {path}", text, ":") if sign else usual
    return found


def _show(aims: Aims, scene: Path) -> None:
    from carom.cli.console import out

    out().table(aims.table())
    if len(aims):
        values = (f"{path}={json.dumps(value)}" for path, value in aims[0].changes.items())
        words = ["carom", "simulate", str(scene), *(word for one in values for word in ("--set", one))]
        out().print(f"The first one: {shlex.join(words)}", soft_wrap=True)


# ----------------------------------------------------------------------------------------------------
# ``carom explore``: the explorer, as one HTML file that opens in the browser.


@of_library("explorer.page:explore")
def explore(
    scene: Annotated[
        Path | None, typer.Argument(metavar="SCENE.toml", help="A scene file. Default: the paper's example.")
    ] = None,
    *,
    given: Given,
    out: Annotated[
        Path | None, option(OUTPUT, "File to write.", metavar="FILE.html", show_default="carom_explorer.html")
    ] = None,
    no_open: Annotated[bool, option(OUTPUT, "Write the file, and open no browser.", "--no-open")] = False,
    quiet: Annotated[bool, shared("quiet")] = False,
) -> None:
    """Write an interactive page that compares all laws as you drag the ball, and open it in the browser."""
    from carom.explorer.page import explore as make_page

    found = given.faults
    target = out or Path("carom_explorer.html")
    require_outputs(found, {"--out": target}, {"--out": (".html", ".htm")})
    page = found.attempt(lambda: make_page(scene, **given))
    found.raise_if_any()
    assert page is not None
    page.save(target)
    if not quiet:
        wrote(target)
    if not no_open:
        _open(target)


def _open(path: Path) -> None:
    import webbrowser

    from carom.cli.streams import note

    if not webbrowser.open(path.absolute().as_uri()):
        note(f"note: no browser was found; open {path} in one")


# ----------------------------------------------------------------------------------------------------
# ``carom scene``: write a first scene file, and validate one.


def new(
    file: Annotated[
        Path | None, typer.Argument(metavar="FILE", help="File to write. Default: standard output.")
    ] = None,
    gas: Annotated[bool, typer.Option("--gas", help="A gas of balls, for carom gas.")] = False,
    table: Annotated[
        str | None,
        typer.Option("--table", metavar="NAME", help="A real table with its balls and cloth; --table list names all."),
    ] = None,
    rack: Annotated[
        str | None,
        typer.Option(
            "--rack",
            metavar="NAME",
            help="The rack of a pool table: 8-ball, 9-ball or 10-ball. Default: fifteen balls in the order of their numbers.",
        ),
    ] = None,
    break_speed: Annotated[
        float | None,
        typer.Option(
            "--break",
            help='Speed of the cue ball in the break on a pool table, m/s, or "30 km/h". Default: 9.5.',
            **quantity("--break", "m/s"),
        ),
    ] = None,
    force: Annotated[bool, shared("force")] = False,
) -> None:
    """Write a commented scene that runs as it stands: one ball on a carom table; a real table by name; or a gas."""
    from carom.gas.scene import gas_text
    from carom.scene.toml import scene_text

    if table is not None and gas:
        raise CaromError("--table: expected a scene of single balls, got --gas as well; give one of the two")
    if table is None and (rack, break_speed) != (None, None):
        option = "--rack" if rack is not None else "--break"
        raise CaromError(f"{option}: expected a pool table with it, got no --table; add --table pool-9ft")
    if rack == "list":
        from carom.scene.openings import RACKS

        sys.stdout.write("".join(f"{name}\n" for name in RACKS))
        return
    if table == "list":
        from carom.scene.presets import presets

        sys.stdout.write("".join(f"{name:<18}{preset.title}\n" for name, preset in presets().items()))
        return
    text = gas_text() if gas else scene_text(table, rack=rack, break_speed=break_speed)
    write_new(file, text, force)


def check(
    file: Annotated[Path, typer.Argument(metavar="FILE", help="A scene, as TOML.")],
    allow_own_laws: Annotated[bool, shared("allow_own_laws")] = False,
    as_json: Annotated[bool, shared("json")] = False,
) -> None:
    """Validate a scene and summarise it; or print it in full, in SI units, with every default filled in."""
    from carom.gas.scene import is_gas, load_gas
    from carom.scene.openings import scene_notes
    from carom.scene.scene import plain_model, scene_dict
    from carom.scene.toml import load_scene

    gas = is_gas(file)
    scene: Any = load_gas(file) if gas else load_scene(file, allow_own_laws=allow_own_laws)
    if gas:
        from carom.gas.session import build

        build(scene)
    if as_json:
        say_json(plain_model(scene) if gas else scene_dict(scene))
        return
    say(f"{file}: {scene.describe()}: ok")
    say_notes(scene.notes() if gas else scene_notes(scene))
