"""Print a run: a description, tables of events and states, the energy budget; or write it as JSON."""

from __future__ import annotations

import json
import math
import textwrap
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from carom.cli.console import out
from carom.formatting import Listing, counted, format_number, json_value
from carom.simulation.contact_kinds import cushion_side
from carom.simulation.files import event_columns
from carom.simulation.narrate import describe_run
from carom.simulation.records import BALL, FLOOR, WALL, event_numbers, kind_names
from carom.simulation.sensitivity.sensitivity import is_angle
from carom.simulation.trajectory import budget

if TYPE_CHECKING:
    from carom.bodies import State
    from carom.simulation.trajectory import Trajectory

MOST_ROWS = 40
WIDE = 112  # least width at which the table has room for the spin
# a law of impact may take energy only
CONTACTS, CREATED = ("at walls", "between balls"), " (by a law that creates energy)"
ROUNDING = 1e-12
RISES = ("flight", "bouncing")  # phases after a contact with the floor that is a bounce


# --- on the screen -------------------------------------------------------------------------------------------------


def show(run: Trajectory, times: list[float], most: int | None) -> None:
    """Print a run: scene, description, a table of at most ``most`` events (None: all), states, energy budget."""
    console = out()
    console.print(f"Scene: {run.scene.describe()}", soft_wrap=True)
    for paragraph in describe_run(run):
        text = textwrap.fill(paragraph[0].upper() + paragraph[1:], max(min(console.width, 110), 40))
        console.print(f"\n{text}", soft_wrap=True)
    if most != 0 and len(run.events):
        table, hidden = _events(run, most, console.width >= WIDE)
        console.table(table)
        if hidden > 0:
            said = f"{counted(hidden, 'event')} not shown: --events all shows all, --save-events FILE.csv writes them."
            console.print(said, style="dim", soft_wrap=True)
    console.table(_states(run, times, console.width >= WIDE))
    console.print(_energy(run), soft_wrap=True)


def show_sensitivity(found: Any) -> None:
    """Print the sensitivity: how far each ball's final place moves when a number changes by 1 %, an angle by 1 degree."""
    head, rows, _note = found.table()
    heads = ["changed by 1 %, angles by 1°", "value", *(f"{name}, mm" for name in head[2:])]
    console = out()
    console.print("What matters: how far the final places move", soft_wrap=True)
    console.table(Listing(heads, rows))
    for one in [one for one in found.near_misses[:1] if one.radius < np.inf]:
        away = f"{1e3 * one.distance:.3g} mm"
        if not one.at_rest:
            said = f"Nearest miss: at {one.time:.4g} s {one.ball} passes {one.other}, {away} away."
        else:  # (it would have come nearer if it had gone on)
            said = f"Nearest miss: from {one.time:.4g} s on {one.ball} is at rest {away} from {one.other}."
        console.print(said, soft_wrap=True)


def _triple(values: Any, count: int = 3) -> str:
    """Format numbers with three digits; rounding errors as zero."""
    return ", ".join(format_number(0.0 if abs(x) < ROUNDING else x) for x in map(float, values[:count]))


def _time(t: float) -> str:
    """Format a time so that the events of a long run can be distinguished."""
    return f"{t:.4f}" if t >= 0.01 or t == 0 else format_number(t, 4)


def _axes(run: Trajectory) -> int:
    """Return how many axes the tables show: two if all balls stay on the floor."""
    z = run.log["x"][:, 2] - np.array([ball.radius for ball in run.scene.balls])[run.log["ball"]]
    return 2 if run.scene.floor is not None and not z.any() and not run.log["v"][:, 2].any() else 3


def _folded(run: Trajectory) -> list[list[int]]:
    """Return the indices of the events of each row: a ball's contacts with the floor, one after the other, are one row."""
    rows: list[list[int]] = []
    last: dict[int, list[int] | None] = {}  # of each ball the row that its next contact with the floor belongs to
    for k, (kind, ball) in enumerate(zip(kind_names(run.events.rows), run.events.rows["ball"].tolist(), strict=True)):
        row = last.get(ball) if kind == "floor" else None
        if row is None:
            row = []
            rows.append(row)
        row.append(k)
        last[ball] = row if kind == "floor" else None
    return sorted(rows, key=lambda row: row[-1])


def _events(run: Trajectory, most: int | None, wide: bool) -> tuple[Listing, int]:
    """Return the table of events, and how many are not shown; ``most``: rows, hops folded; None: every event in its own row."""
    several, axes = len(run.scene.balls) > 1, _axes(run)
    names = ", ".join("xyz"[:axes])
    heads = ["t, s", *["ball"] * several, "event", f"position\n{names}, m", f"velocity after\n{names}, m/s"]
    heads += [*["spin after\nx, y, z, rad/s"] * wide, "energy lost\nJ", "next phase"]
    rows = [[k] for k in range(len(run.events))] if most is None else _folded(run)
    parts = [rows]
    if most is not None and len(rows) > most:
        parts = [rows[: (most + 1) // 2], rows[len(rows) - most // 2 :]]
    features, numbers = run.scene.features().view(np.recarray), event_numbers(run.events.rows)
    cells = [[_event_row(run, features, numbers, row, several, axes, wide) for row in part] for part in parts]
    hidden = len(run.events) - sum(len(row) for part in parts for row in part)
    between = [["–", *[""] * (len(heads) - 1)]] * (len(parts) - 1)
    return Listing(heads, [*cells[0], *between, *(cells[1] if between else [])]), hidden


def _event_row(
    run: Trajectory, features: Any, numbers: Any, folded: list[int], several: bool, axes: int, wide: bool
) -> list[str]:
    """Return the cells of one event; of hops the time of the last and the state after it, and the energy lost in all."""
    events = [run.events[k] for k in folded]
    first, event = events[0], events[-1]
    side = cushion_side(run, features, run.events.rows[folded[-1]]) if event.kind == "wall" else ""
    what = " ".join(one for one in (event.kind, event.name, side) if one)
    if len(events) > 1:
        bounces = sum(one.phase in RISES for one in events)
        since = f" since {_time(first.t)} s" if event.t > first.t else ""
        what = f"lands, {counted(bounces, 'bounce')}{since}"
    row = [_time(event.t), *([run.scene.ball_names[event.ball]] if several else []), what]
    row += [_triple(event.after.position, axes), _triple(event.after.velocity, axes)]
    row += [_triple(event.after.spin)] if wide else []
    # energy is lost instantaneously only in contacts
    lost, kind = math.nan, run.events.rows["kind"][folded[0]]
    if kind == FLOOR:
        lost = sum(one.energy_lost for one in events)
    elif kind in (WALL, BALL) and numbers[folded[0]] not in numbers[max(folded[0] - 1, 0) : folded[0]]:
        # (all that balls lose in a meeting, and in contacts that overlap, stands in its first row)
        lost = sum(run.events[k].energy_lost for k in np.flatnonzero(numbers == numbers[folded[0]]).tolist())
    return [
        *row,
        format_number(0.0 if abs(lost) < ROUNDING else lost),
        "" if event.phase == event.kind else event.phase,
    ]


def _states(run: Trajectory, times: list[float], wide: bool) -> Listing:
    """Return a table of the states at the requested times, and at the end."""
    axes = 3 if times else _axes(run)
    names = ", ".join("xyz"[:axes])
    heads = ["at t, s", "ball", "phase", f"position\n{names}, m", f"velocity\n{names}, m/s", "spin\nx, y, z, rad/s"]
    rows = []
    asked = [(_time(t), run.at(t), list(run.phase(t))) for t in times]
    for when, state, phases in [*asked, (f"end: {_time(run.end)}", run.final, run.final_phase)]:
        assert state.position is not None
        for i, name in enumerate(run.scene.ball_names):
            row = [_triple(state.position[i], axes), _triple(state.velocity[i], axes), _triple(state.spin[i])]
            rows.append((when if i == 0 else "", name, phases[i], *(row if wide else row[:2])))
    return Listing(heads if wide else heads[:5], rows)


def _energy(run: Trajectory) -> str:
    found = budget(run)
    rounding = ROUNDING * max(abs(found.start), abs(found.end)) * (1 + len(run.events))
    places = (
        ("at walls", found.walls),
        ("in landings", found.floor),
        ("between balls", found.balls),
        (f"{'to the air, ' if run.scene.air else ''}in sliding, rolling and small bounces", found.way),
    )
    told = [
        f"{format_number(abs(x))} J {'lost' if x > 0 else 'gained'} {where}{CREATED if x < 0 and where in CONTACTS else ''}"
        for where, x in places
        if abs(x) > rounding
    ]
    left = format_number(0.0 if abs(found.end) < rounding else found.end)
    fallen = [i for i, phase in enumerate(run.final_phase) if phase == "pocketed"]
    theirs = (
        float(np.sum(run.kinetic_energy(fallen, run.final.velocity[fallen], run.final.spin[fallen]))) if fallen else 0.0
    )
    held = f" ({format_number(theirs)} J as balls fell into pockets)" if theirs > rounding else ""
    return f"Energy: {format_number(found.start)} J at the start; {''.join(f'{part}, ' for part in told)}{left} J left{held}."


# --- as JSON -------------------------------------------------------------------------------------------------------


def as_json(run: Trajectory, times: list[float], notes: Sequence[str] = (), matters: Any = None) -> str:
    """Return events and final states as JSON in full precision, one event per line; infinite and undefined numbers are null."""
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
    if matters is not None:
        moved = zip(matters.columns, matters.values.tolist(), (1e3 * matters.what_matters()).T.tolist(), strict=True)
        rows = [
            {"parameter": name, "value": value, "mm_per_degree" if is_angle(name) else "mm_per_cent": by_ball}
            for name, value, by_ball in moved
        ]
        parts.append(f'"sensitivity": {_listed([_line(one) for one in rows])}')
    parts += [f'"end": {_line(run.end)}', f'"ended": {_line(run.ended)}']
    parts += [f'"notes": {_line(list(notes))}'] if notes else []
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
    return json.dumps(json_value(value), allow_nan=False)
