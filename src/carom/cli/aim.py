"""``carom aim``: starts of a ball that reach a target, the most robust one first."""

from __future__ import annotations

import json
import shlex
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from carom.cli.options import OUTPUT, option, parse_pair, require_outputs, shared, wrote
from carom.cli.parameters import Given, of_library
from carom.cli.streams import note, say_json
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
    struck = [i for i, one in enumerate(made.balls) if one.strike is not None] if made is not None else []
    usual = f"balls.{struck[0]}.strike" if struck else "balls.0.velocity"
    ranges = found.attempt(_ranges, free or [usual])
    if found or made is None or ranges is None:
        raise CaromError(*found)
    from carom.cli.console import out, working
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
