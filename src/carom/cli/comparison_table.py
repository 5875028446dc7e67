"""A comparison as a table, and a sentence for each law."""

from __future__ import annotations

import math
import textwrap
from typing import TYPE_CHECKING

from rich import box
from rich.console import Console
from rich.table import Table
from rich.text import Text

from carom.cli.shared import out, tick
from carom.units import length, number

if TYPE_CHECKING:
    from carom.comparison import Comparison, Verdict

__all__ = ["show"]

WIDE = 112  # from this width on the table has room for the spin


def show(comparison: Comparison) -> None:
    """Print what comes in, the table, and a sentence for each law on what speaks against it, or on what happens."""
    console = out()
    console.print(Text(_incoming(comparison)))
    table = _table(comparison, console)
    width = console.width
    console.width = 1000
    console.width = max(width, console.measure(table).maximum)  # no number is cut off, even where lines get too long
    console.print(table)
    console.width = width
    for verdict in comparison.verdicts:
        good = verdict.admissible
        head = f"{tick(console, good)} {verdict.law}:"
        lines = textwrap.wrap(f"{head} {_sentence(verdict)}", max(width, 40), subsequent_indent="  ")
        text = Text("\n".join(lines))
        text.stylize("bold green" if good else "bold red", 0, len(head))
        console.print(text)


def _incoming(comparison: Comparison) -> str:
    m = comparison.meeting
    v = m.state.velocity
    spin = ", ".join(_number(float(x)) for x in m.state.spin)
    lines = [
        f"In:    {number(math.hypot(v[0], v[1]))} m/s at {comparison.incident_angle:.2f}° from the wall's normal,"
        f" spin ({spin}) rad/s",
        f"Ball:  radius {length(m.ball.radius, 4)}, mass {number(m.ball.mass, 4)} kg, I = {number(m.ball.kappa)} m a²",
        f"Wall:  restitution {number(m.wall.restitution)}, friction {number(m.wall.friction)}{_more(comparison)}",
        f"Floor: restitution {number(m.floor.restitution)}, friction {number(m.floor.friction)}",
    ]
    if v[2] != 0 or m.height > 0:
        lines[0] += f"\n       {length(float(m.height))} above the floor, {number(float(v[2]))} m/s upwards"
    return "\n".join(lines)


def _more(comparison: Comparison) -> str:
    m = comparison.meeting
    beta = m.wall.tangential_restitution
    more = f", tangential restitution {number(beta)}" if beta != 0 else ""
    if m.normal[2] != 0:
        more += f", touching {number(1 + m.height / m.ball.radius - float(m.normal[2]))} radii above the floor"
    return more


def _table(comparison: Comparison, console: Console) -> Table:
    wide = console.width >= WIDE
    table = Table(box=box.SIMPLE_HEAD, padding=(0, 1 if wide else 0), pad_edge=False, header_style="bold")
    heads = ["law", "after\nwall", "\nfinal", "final velocity\nx, y, m/s"]
    heads += ["final spin\nx, y, z, rad/s"] if wide else []
    heads += ["hops\nmm", "flies\nmm", "energy\nkept", "needs\nμ at\nwall", "needs\nμ at\nfloor", "ok"]
    for i, head in enumerate(heads):
        table.add_column(head, justify="left" if i == 0 else "right", no_wrap=True, overflow="fold", vertical="bottom")
    for verdict in comparison.verdicts:
        good = verdict.admissible
        row = [verdict.law, _degrees(verdict.angle_after_wall), _degrees(verdict.reflection_angle)]
        row += [_vector(verdict, "velocity", 2)] + ([_vector(verdict, "spin", 3)] if wide else [])
        row += [*_hop(verdict), "–" if verdict.energy_ratio is None else f"{verdict.energy_ratio:.1%}"]
        row += [number(verdict.required_wall), number(verdict.required_floor)]
        table.add_row(*row, Text(tick(console, good), style="bold green" if good else "bold red"))
    return table


def _degrees(x: float | None) -> str:
    return "–" if x is None else f"{x:.2f}°"


def _number(x: float) -> str:
    """Three digits; rounding left by a sum of larger numbers is zero."""
    return number(0.0 if abs(x) < 1e-12 else x)


def _vector(verdict: Verdict, part: str, count: int) -> str:
    if verdict.final is None:
        return "–"
    return ", ".join(_number(float(x)) for x in getattr(verdict.final, part)[:count])


def _hop(verdict: Verdict) -> tuple[str, str]:
    if verdict.answer is None or verdict.answer.steps is None:
        return "–", "–"
    flight = verdict.answer.steps.flight
    return number(float(flight.height) * 1e3), number(float(flight.distance) * 1e3)


def _sentence(verdict: Verdict) -> str:
    if verdict.admissible:
        return "; ".join(verdict.remarks) or "nothing speaks against it"
    parts = [*verdict.why]
    if verdict.after_wall is not None and verdict.final is None:
        parts += verdict.remarks[-1:]  # why it never rolls
    return "; ".join(parts)
