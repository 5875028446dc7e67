"""Scenes of real tables: the text of a scene file with the numbers of a table, and balls as they lie when a game begins."""

from __future__ import annotations

import math
import textwrap
from dataclasses import dataclass, replace
from typing import Any

from carom.errors import CaromError
from carom.scene.presets import Preset, Sourced, preset_fault, presets

__all__ = ["table_scene"]

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


@dataclass(frozen=True)
class Opening:
    """The opening of a table: the shot, the balls by name and place, and the motion of the first one."""

    about: str
    balls: list[tuple[str, float, float]]
    velocity: tuple[float, float]
    spin_z: float = 0.0
    duration: float = 20.0
    racked: tuple[str, ...] = ()


def table_scene(name: str) -> str:
    """Return the text of a scene file for a real table: cushions and pockets, balls, cloth, each number with its source.

    Raises CaromError for a name that no table has.
    """
    for fault in preset_fault(name):
        raise CaromError(replace(fault, field="table"))
    preset = presets()[name]
    length, radius = preset.cushions["length"].value, preset.parts["ball"]["radius"].value
    game = name.split("-", maxsplit=1)[0]
    opening = {"carom": _carom, "pool": _pool, "snooker": _snooker}[game](length, radius)
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
        lines += [GAPS, "balls = [", *(f"    {line}" for line in names), "]", ""]
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


def _triangle(x: float, radius: float, rows: int) -> list[tuple[float, float]]:
    """Return places of a rack of balls with its apex at x, row by row."""
    step = 2 * radius + GAP
    return [(x + row * step * math.sqrt(0.75), (k - row / 2) * step) for row in range(rows) for k in range(row + 1)]


def _pool(length: float, radius: float) -> Opening:
    """Fifteen balls with the first on the foot spot, and the cue ball on the head string."""
    rack = [(str(i + 1), x, y) for i, (x, y) in enumerate(_triangle(length / 4, radius, 5))]
    # past the middle of the first ball by 0.15 of the radius
    dx, dy = length / 2, BREAK_FROM - 0.15 * radius
    far = math.hypot(dx, dy)
    velocity = (round(BREAK_SPEED * dx / far, 2), round(BREAK_SPEED * dy / far, 3))
    about = "The break: white meets the rack from the head string."
    return Opening(
        about, [("white", -length / 4, -BREAK_FROM), *rack], velocity, 0.0, 15.0, tuple(name for name, *_ in rack)
    )


def _snooker(length: float, radius: float) -> Opening:
    """Fifteen reds behind pink, the colours on their spots; the cue ball between yellow and brown."""
    baulk, quarter = BAULK - length / 2, length / 4
    reds = [(f"red {i + 1}", x, y) for i, (x, y) in enumerate(_triangle(quarter + 2 * radius + GAP, radius, 5))]
    colours = [
        ("yellow", baulk, -D_RADIUS), ("green", baulk, D_RADIUS), ("brown", baulk, 0.0), ("blue", 0.0, 0.0), ("pink", quarter, 0.0),
        ("black", length / 2 - BLACK, 0.0),
    ]  # fmt: skip
    about = "The break-off: white grazes the last row of the reds and comes back to baulk."
    return Opening(
        about, [("white", baulk, -0.14), *colours, *reds], (4.3, 0.008), -20.0, 20.0, tuple(name for name, *_ in reds)
    )
