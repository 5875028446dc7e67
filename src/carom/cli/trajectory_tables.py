"""A run on the screen: the story, its events and states as tables, where the energy went; and the same as JSON."""

from __future__ import annotations

import json
import math
import textwrap
from typing import TYPE_CHECKING, Any

import numpy as np
from rich import box
from rich.console import Console
from rich.table import Table
from rich.text import Text

from carom.budget import budget
from carom.cli.shared import out
from carom.story import counted, story
from carom.tidy import event_columns
from carom.units import number

if TYPE_CHECKING:
    from carom.state import State
    from carom.trajectory import Trajectory

__all__ = ["MOST_ROWS", "as_json", "show"]

MOST_ROWS = 40
WIDE = 112  # from this width on the table has room for the spin
ROUNDING = 1e-12


# --- on the screen -------------------------------------------------------------------------------------------------


def show(run: Trajectory, times: list[float], most: int | None) -> None:
    """Print a run: the scene, the story, a table of at most so many events (None: all), states, energy."""
    console = out()
    console.print(Text(f"Scene: {run.scene.describe()}"), soft_wrap=True)
    for paragraph in story(run):
        text = textwrap.fill(paragraph[0].upper() + paragraph[1:], max(min(console.width, 110), 40))
        console.print(Text(f"\n{text}"), soft_wrap=True)
    if most != 0 and len(run.events):
        _print(console, _events(run, most, console.width >= WIDE))
        hidden = 0 if most is None else len(run.events) - most
        if hidden > 0:
            said = f"{counted(hidden, 'event')} left out: --events all shows all, --table FILE.csv writes them."
            console.print(Text(said, style="dim"), soft_wrap=True)
    _print(console, _states(run, times, console.width >= WIDE))
    console.print(Text(_energy(run)), soft_wrap=True)


def _print(console: Console, table: Table) -> None:
    """A table with no number cut off, even where lines get too long."""
    width = console.width
    console.width = 1000
    console.width = max(width, console.measure(table).maximum)
    console.print(table)
    console.width = width


def _new(heads: list[tuple[str, bool]]) -> Table:
    """A table; of each column its head, and whether it holds words."""
    table = Table(box=box.SIMPLE_HEAD, padding=(0, 1), pad_edge=False, header_style="bold")
    for head, words in heads:
        table.add_column(head, justify="left" if words else "right", no_wrap=True, overflow="fold", vertical="bottom")
    return table


def _triple(values: Any, count: int = 3) -> str:
    """Numbers with three digits; rounding's leftovers are zero."""
    return ", ".join(number(0.0 if abs(x) < ROUNDING else x) for x in map(float, values[:count]))


def _time(t: float) -> str:
    """A time with its decimals: of a long run, too, events are told apart."""
    return f"{t:.4f}" if t >= 0.01 or t == 0 else number(t, 4)


def _axes(run: Trajectory) -> int:
    """How many axes the tables show: two, if all balls stay on the floor."""
    z = run.log["x"][:, 2] - np.array([ball.radius for ball in run.scene.balls])[run.log["ball"]]
    return 2 if run.scene.floor is not None and not z.any() and not run.log["v"][:, 2].any() else 3


def _events(run: Trajectory, most: int | None, wide: bool) -> Table:
    several, axes = len(run.scene.balls) > 1, _axes(run)
    names = ", ".join("xyz"[:axes])
    heads = [("t, s", False), *([("ball", True)] if several else []), ("event", True), (f"place\n{names}, m", False)]
    heads += [(f"velocity after\n{names}, m/s", False)]
    heads += [("spin after\nx, y, z, rad/s", False)] if wide else []
    table = _new([*heads, ("lost\nJ", False), ("then", True)])
    count = len(run.events)
    parts = [run.events]
    if most is not None and count > most:
        parts = [run.events[: (most + 1) // 2], run.events[count - most // 2 :]]
    for k, part in enumerate(parts):
        if k > 0:
            table.add_row("...")
        for event in part:
            name = f" {event.name}" if event.name else ""
            row = [_time(event.t), *([run.scene.ball_names[event.ball]] if several else []), f"{event.kind}{name}"]
            row += [_triple(event.after.position, axes), _triple(event.after.velocity, axes)]
            row += [_triple(event.after.spin)] if wide else []
            # where nothing is met, nothing is lost at once
            lost = event.energy_lost if event.kind in ("wall", "floor", "ball") else math.nan
            row += [number(0.0 if abs(lost) < ROUNDING else lost), "" if event.phase == event.kind else event.phase]
            table.add_row(*row)
    return table


def _states(run: Trajectory, times: list[float], wide: bool) -> Table:
    """States at the times asked for, and at the end."""
    axes = 3 if times else _axes(run)
    names = ", ".join("xyz"[:axes])
    heads = [("at t, s", True), ("ball", True), ("phase", True), (f"place\n{names}, m", False)]
    heads += [(f"velocity\n{names}, m/s", False), ("spin\nx, y, z, rad/s", False)]
    table = _new(heads if wide else heads[:5])
    asked = [(_time(t), run.at(t), list(run.phase(t))) for t in times]
    for when, state, phases in [*asked, (f"end: {_time(run.end)}", run.final, run.final_phase)]:
        assert state.position is not None
        for i, name in enumerate(run.scene.ball_names):
            row = [_triple(state.position[i], axes), _triple(state.velocity[i], axes), _triple(state.spin[i])]
            table.add_row(when if i == 0 else "", name, phases[i], *(row if wide else row[:2]))
    return table


def _energy(run: Trajectory) -> str:
    found = budget(run)
    rounding = ROUNDING * max(abs(found.start), abs(found.end)) * (1 + len(run.events))
    places = (
        ("at walls", found.walls),
        ("at the floor", found.floor),
        ("between balls", found.balls),
        ("on the way", found.way),
    )
    told = [f"{number(abs(x))} J {'lost' if x > 0 else 'gained'} {where}" for where, x in places if abs(x) > rounding]
    left = number(0.0 if abs(found.end) < rounding else found.end)
    return f"Energy: {number(found.start)} J at the start; {''.join(f'{part}, ' for part in told)}{left} J left."


# --- as JSON -------------------------------------------------------------------------------------------------------


def as_json(run: Trajectory, times: list[float]) -> str:
    """Events and final states, every number in full; one event a line. Infinite and undefined numbers are null."""
    columns = {name: values.tolist() for name, values in event_columns(run, run.events.rows).items()}
    vectors = {
        name: zip(*(columns[f"{of}{axis}"] for axis in "xyz"), strict=True)
        for name, of in (("position", ""), ("velocity", "v"), ("spin", "w"), ("impulse", "impulse_"))
    }
    series: dict[str, Any] = {
        **{name: columns[name] for name in ("t", "kind", "ball")},
        **{name: vectors[name] for name in ("position", "velocity", "spin")},
        **{name: columns[name] for name in ("other", "name", "phase")},
        "impulse": vectors["impulse"],
        **{name: columns[name] for name in ("required_friction", "energy_lost")},
    }
    events = [_line(dict(zip(series, row, strict=True))) for row in zip(*series.values(), strict=True)]
    final = [_line(row) for row in _balls(run, run.final, run.final_phase)]
    parts = [f'"events": {_listed(events)}', f'"final": {_listed(final)}']
    if times:
        asked = [{"t": t, "states": _balls(run, run.at(t), list(run.phase(t)))} for t in times]
        parts.append(f'"at": {_listed([_line(one) for one in asked])}')
    parts += [f'"end": {_line(run.end)}', f'"ended": {_line(run.ended)}']
    return "{\n" + ",\n".join(parts) + "\n}\n"


def _balls(run: Trajectory, state: State, phases: list[str]) -> list[dict[str, Any]]:
    assert state.position is not None
    return [
        {
            "position": state.position[i].tolist(), "velocity": state.velocity[i].tolist(),
            "spin": state.spin[i].tolist(), "phase": str(phases[i]), "name": name,
        }
        for i, name in enumerate(run.scene.ball_names)
    ]  # fmt: skip


def _listed(lines: list[str]) -> str:
    return "[\n" + ",\n".join(lines) + "\n]" if lines else "[]"


def _line(value: Any) -> str:
    return json.dumps(_finite(value), allow_nan=False)


def _finite(value: Any) -> Any:
    if isinstance(value, float):
        return value if math.isfinite(value) else None
    if isinstance(value, dict):
        return {key: _finite(part) for key, part in value.items()}
    return [_finite(part) for part in value] if isinstance(value, (list, tuple)) else value
