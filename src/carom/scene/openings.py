"""Scenes of real tables: the text of a scene file with the numbers of a table, and balls as they lie when a game begins."""

from __future__ import annotations

import math
import textwrap
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

from carom.core.units import in_si, unlikely_density
from carom.errors import CaromError, Fault, did_you_mean, shown
from carom.formatting import format_length, format_time
from carom.scene.presets import Preset, Sourced, preset_fault, presets
from carom.scene.restitution import Constant

if TYPE_CHECKING:
    from carom.scene.scene import Scene

EARTH = (9.7, 9.9)  # m/s^2: with another gravity, or none, the numbers need not be in SI units
LOW = 1e-4  # of the radius: so low a ball hardly was to be let go
FAST = 100.0  # m/s: faster than any struck ball but one of golf, squash or badminton


def ball_notes(at: str, radius: float, mass: float, speed: float, gravity: float) -> list[str]:
    """Return one line for each number of a ball that is hardly one in m, kg and m/s; ``at``: what the lines begin with."""
    if not EARTH[0] <= gravity <= EARTH[1]:
        return []
    found = [f"{at}: {said}"] if (said := unlikely_density(radius, mass)) else []
    if speed > FAST:
        found.append(f"{at}: a speed of {speed:g} m/s; are the velocities in mm/s or cm/s?")
    return found


def bounce_notes(scene: Scene) -> list[str]:
    """Return a line for each ball that begins a little above a floor that returns all its speed: it bounces for ever, unseen."""
    floor, g = scene.floor, -scene.pull[2]
    if floor is None or not g > 0 or not (isinstance(floor.restitution, Constant) and floor.restitution.value == 1):
        return []
    found = []
    for i, ball in enumerate(scene.balls):
        height = ball.center[2] - ball.radius + float(ball.state.velocity[2]) ** 2 / (2 * g)
        if 1e-9 < height / ball.radius < LOW:
            found.append(
                f"balls.{ball.name or i}: bounces {format_length(height)} high on a floor of restitution 1, which never ends: an"
                f" event every {format_time(2 * math.sqrt(2 * height / g))}; leave out z to lay it on the floor"
            )
    return found


def scene_notes(scene: Scene) -> list[str]:
    """Return these lines for all balls of a scene.

    Examples
    --------
    >>> import carom
    >>> ball = carom.SceneBall(radius=28.6, mass=0.17, position=(0, 0, 30))
    >>> scene_notes(carom.Scene(balls=[ball]))
    ['balls.0: 0.17 kg with a radius of 28.6 m: lighter than air; is the radius in mm? write "28.6 mm"']
    """
    gravity = math.hypot(*scene.gravity)
    units = [
        line
        for i, ball in enumerate(scene.balls)
        for line in ball_notes(
            f"balls.{ball.name or i}", ball.radius, ball.mass, math.hypot(*ball.state.velocity), gravity
        )
    ]
    return units + bounce_notes(scene)


def rolling_notes(scene: Scene) -> list[str]:
    """Return a line where balls roll on without an end, which a search for shots would wait for."""
    if scene.floor is None or scene.floor.rolling_resistance != 0:
        return []
    return ["floor.rolling_resistance is 0: balls roll until run.duration; cloth has 0.005 to 0.015"]


# ----------------------------------------------------------------------------------------------------
# Scenes of real tables: the text of a scene file with the numbers of a table, and balls as they lie when a game begins.


GAP = 1e-4  # m: between racked balls, some of which touch in a real rack
# said in scenes with a rack
RACK = "# Contacts of the rack overlap in time, and are resolved together (docs, Ball-ball collisions)."
GAPS = """\
# In a real rack some balls touch. With gap = "0.05 mm" in this table the balls are laid anew around the first, so far apart, and
# moved at random with gap_spread = "0.04 mm", so that no gap differs from it by more; seed = 1 draws another rack.
[rack]"""
WIDTH = 30  # of a field with its value, before its source
# WPBSA, official rules: baulk-line and D, and where black stands, m
BAULK, D_RADIUS, BLACK = 0.737, 0.292, 0.324
BREAK_SPEED, BREAK_FROM = 9.5, 0.15  # m/s; m beside the middle: white falls on no table
# WPA, rules of play 2.2, 3.2, 4.2: rows from the foot spot on, the ball of the game's name in the middle; in 8-ball the corners
# behind are one ball of 1 to 7 and one of 9 to 15
RACKS = {
    "15 balls": ((1,), (2, 3), (4, 5, 6), (7, 8, 9, 10), (11, 12, 13, 14, 15)),
    "8-ball": ((1,), (9, 2), (10, 8, 3), (4, 11, 5, 12), (13, 6, 14, 15, 7)),
    "9-ball": ((1,), (2, 3), (4, 9, 5), (6, 7), (8,)),
    "10-ball": ((1,), (2, 3), (4, 10, 5), (6, 7, 8, 9)),
}


@dataclass(frozen=True)
class Opening:
    """The opening of a table: the shot, the balls by name and place, and the motion of the first one."""

    about: str
    balls: list[tuple[str, float, float]]
    velocity: tuple[float, float]
    spin_z: float = 0.0
    duration: float = 20.0
    racked: tuple[str, ...] = ()
    rows: tuple[int, ...] = ()


def table_scene(name: str, rack: str | None = None, break_speed: float | str | None = None) -> str:
    """Return the text of a scene file for a real table: cushions and pockets, balls, cloth, each number with its source.

    Raises CaromError for a name that no table has, and for another rack or speed of the break than the table's game has.
    """
    found = [replace(fault, field="table") for fault in preset_fault(name)]
    game = "" if found else name.split("-", maxsplit=1)[0]
    speed = in_si(break_speed, "m/s")
    found += rack_fault(game, rack) + _speed_fault(game, speed)
    if found:
        raise CaromError(*found)
    preset = presets()[name]
    length, radius = preset.cushions["length"].value, preset.parts["ball"]["radius"].value
    if game == "pool":
        opening = _pool(length, radius, rack or "15 balls", speed or BREAK_SPEED)
    else:
        opening = {"carom": _carom, "snooker": _snooker}[game](length, radius)
    lines = [
        f"# A {preset.title}. {opening.about}",
        f"# Check it with `carom scene check FILE`, run it with `carom simulate FILE`. SI units. {_key()}",
        *([RACK] if opening.racked else []),
        "",
        "[floor]",
        *_numbers(preset.parts["floor"]),
        "",
        "[[walls]]",
        'name = "cushions"',
        'shape = "table"',
        f'preset = "{name}"'.ljust(WIDTH) + "# fills the numbers below; one that is given here has precedence",
        *_numbers(preset.cushions, comment=True),
        *_pockets(preset),
        "",
    ]
    for i, (ball, x, y) in enumerate(opening.balls):
        lines += [
            "[[balls]]",
            f'name = "{ball}"',
            *_numbers(preset.parts["ball"], known=i > 0),
            f"position = [{x:.6g}, {y:.6g}]",
        ]
        if i == 0:
            lines += [f"velocity = [{opening.velocity[0]:g}, {opening.velocity[1]:g}]", "rolling = true"]
            lines += [f"spin_z = {opening.spin_z:g}"] if opening.spin_z else []
        lines.append("")
    if opening.racked:
        names = textwrap.wrap(", ".join(f'"{name}"' for name in opening.racked), 110)
        lines += [GAPS, "balls = [", *(f"    {line}" for line in names), "]"]
        lines += [f"rows = {list(opening.rows)}", ""] if opening.rows else [""]
    lines += ["[ball_contact]", *_numbers(preset.parts["ball_contact"]), ""]
    lines += ["[run]", 'law = "two-step"', f"duration = {opening.duration:g}", "", *_sources(preset)]
    return "\n".join(lines) + "\n"


def _key() -> str:
    return "Behind each number stands its source, listed at the end."


def _numbers(numbers: dict[str, Sourced], comment: bool = False, known: bool = False) -> list[str]:
    """Return a line for each field; ``known``: without its source."""
    lines = [f"{'# ' if comment else ''}{field} = {_value(one.value)}" for field, one in numbers.items()]
    return (
        lines
        if known
        else [f"{line:<{WIDTH - 2}}  # {one.key}" for line, one in zip(lines, numbers.values(), strict=True)]
    )


def _pockets(preset: Preset) -> list[str]:
    """Return the lines of a table's pockets, all of them comments."""
    found = []
    for part in ("corner_pockets", "side_pockets"):
        for field, one in preset.parts.get(part, {}).items():
            found.append(f"{f'# {part}.{field} = {_value(one.value)}':<{WIDTH}} # {one.key}")
    return found


def _value(value: Any) -> str:
    if isinstance(value, dict):
        return "{ " + ", ".join(f"{key} = {_value(one)}" for key, one in value.items()) + " }"
    return f'"{value}"' if isinstance(value, str) else str(value)


def _sources(preset: Preset) -> list[str]:
    """Return the list of all sources that a table's numbers have, as comments."""
    numbers = [*preset.cushions.values(), *(one for part in preset.parts.values() for one in part.values())]
    lines = ["# Sources"]
    for key, source in dict.fromkeys((one.key, one.source) for one in numbers):
        lines += textwrap.wrap(f"{key}: {source}", 116, initial_indent="# ", subsequent_indent="#   ")
    return lines


# --- games ----------------------------------------------------------------------------------------------------------


def _carom(length: float, radius: float) -> Opening:
    """The start of three-cushion billiards, and a first shot that scores on the match table."""
    quarter = length / 4
    about = "White plays the first shot of three-cushion billiards: red, at least three cushions, then yellow."
    balls = [("white", -quarter, -0.1825 * length / 2.84), ("yellow", -quarter, 0.0), ("red", quarter, 0.0)]
    return Opening(about, balls, (3.5, 0.54), -13.0, 10.0)


def rack_fault(game: str, rack: str | None) -> list[Fault]:
    """Return the problem with a rack by name on the table of a game (empty: unknown)."""
    if rack is None or (rack in RACKS and game in ("pool", "")):
        return []
    if game not in ("pool", ""):
        return [Fault("", "rack", "a pool table, for a rack by name", f"a {game} table", "omit the rack")]
    return [Fault("", "rack", f"one of {', '.join(RACKS)}", shown(rack), did_you_mean(rack, RACKS))]


def _speed_fault(game: str, speed: Any) -> list[Fault]:
    """Return the problem with the speed of a break on the table of a game (empty: unknown)."""
    given = speed if isinstance(speed, int | float) else math.nan
    if speed is None or (0 < given <= FAST and game in ("pool", "")):
        return []
    if game not in ("pool", ""):
        return [Fault("", "break_speed", "a pool table, for a break", f"a {game} table", "omit the speed")]
    return [
        Fault(
            "",
            "break_speed",
            f"a speed in m/s, > 0 and at most {FAST:g}",
            shown(speed) if isinstance(speed, str) else f"{speed:g}",
        )
    ]


def _rows(x: float, radius: float, rows: Sequence[int]) -> list[tuple[float, float]]:
    """Return places of a rack of balls with its apex at x, row by row; rows differ by one ball."""
    step = 2 * radius + GAP
    return [
        (x + row * step * math.sqrt(0.75), (k - (count - 1) / 2) * step)
        for row, count in enumerate(rows)
        for k in range(count)
    ]


def _pool(length: float, radius: float, rack: str, speed: float) -> Opening:
    """The balls of a rack with the first on the foot spot, and the cue ball on the head string."""
    counts, names = tuple(map(len, RACKS[rack])), [str(ball) for row in RACKS[rack] for ball in row]
    balls = [(name, x, y) for name, (x, y) in zip(names, _rows(length / 4, radius, counts), strict=True)]
    # past the middle of the first ball by 0.15 of the radius
    dx, dy = length / 2, BREAK_FROM - 0.15 * radius
    far = math.hypot(dx, dy)
    velocity = (round(speed * dx / far, 2), round(speed * dy / far, 3))
    about = "The break: white meets the rack from the head string."
    white = ("white", -length / 4, -BREAK_FROM)
    triangle = counts == tuple(range(1, len(counts) + 1))
    return Opening(about, [white, *balls], velocity, 0.0, 15.0, tuple(names), () if triangle else counts)


def _snooker(length: float, radius: float) -> Opening:
    """Fifteen reds behind pink, the colours on their spots; the cue ball between yellow and brown."""
    baulk, quarter = BAULK - length / 2, length / 4
    reds = [(f"red {i + 1}", x, y) for i, (x, y) in enumerate(_rows(quarter + 2 * radius + GAP, radius, range(1, 6)))]
    colours = [
        ("yellow", baulk, -D_RADIUS), ("green", baulk, D_RADIUS), ("brown", baulk, 0.0), ("blue", 0.0, 0.0), ("pink", quarter, 0.0),
        ("black", length / 2 - BLACK, 0.0),
    ]  # fmt: skip
    about = "The break-off: white grazes the last row of the reds and comes back to baulk."
    return Opening(
        about, [("white", baulk, -0.14), *colours, *reds], (4.3, 0.008), -20.0, 20.0, tuple(name for name, *_ in reds)
    )
