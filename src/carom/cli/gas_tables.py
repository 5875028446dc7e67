"""What a gas measured, on the screen and as JSON."""

from __future__ import annotations

import json
import math
from typing import TYPE_CHECKING, Any

from rich import box
from rich.table import Table
from rich.text import Text

from carom.cli.shared import out
from carom.gas.report import report
from carom.units import number

if TYPE_CHECKING:
    from carom.gas.session import Session

__all__ = ["as_json", "finite", "show"]

CONSERVED = 1e-6  # a relative change of the energy below this is rounding, not loss


def as_json(session: Session) -> str:
    """The run after equilibration, every number in full. Infinite and undefined numbers are null."""
    return json.dumps(finite(report(session)), allow_nan=False, indent=1) + "\n"


def finite(value: Any) -> Any:
    """The same, with None for numbers that JSON has no words for."""
    if isinstance(value, float):
        return value if math.isfinite(value) else None
    if isinstance(value, dict):
        return {key: finite(part) for key, part in value.items()}
    return [finite(part) for part in value] if isinstance(value, (list, tuple)) else value


def show(session: Session) -> None:
    """Print what was measured: the gas, its species, its contacts."""
    told, console = report(session), out()
    console.print(Text(f"Gas: {session.scene.describe()}"), soft_wrap=True)
    tables = [_whole(session, told), _species(session, told), _contacts(told)]
    width = console.width
    for table in tables:
        console.width = 1000
        console.width = max(width, console.measure(table).maximum)
        console.print(table)
    console.width = width


def _table(heads: list[str], words: int = 1) -> Table:
    table = Table(box=box.SIMPLE_HEAD, padding=(0, 1), pad_edge=False, header_style="bold")
    for k, head in enumerate(heads):
        table.add_column(head, justify="left" if k < words else "right", no_wrap=True, vertical="bottom")
    return table


def _whole(session: Session, told: dict[str, Any]) -> Table:
    table = _table(["the whole", ""], 1)
    events, cpu = told["events"], told["cpu_seconds"]
    rotational, translational = told["temperature_rotational"], told["temperature_translational"]
    ideal = translational * told["balls"] / session.scene.container.room.volume
    rows = [("pair collisions", f"{told['pair_collisions']:,}")]
    if told["wall_collisions"]:
        rows.append(("wall collisions", f"{told['wall_collisions']:,}"))
    rows += [
        ("simulated time", number(told["simulated_time"], 6)),
        ("mean free time", number(told["mean_free_time"], 6)),
        ("pressure", number(told["pressure"], 6)),
        ("  over the ideal gas's", number(told["pressure"] / ideal, 5) if ideal > 0 else "–"),
        ("temperature, translational", number(translational, 6)),
        ("temperature, rotational", number(rotational, 6)),
        ("  over translational", number(rotational / translational, 5) if translational > 0 else "–"),
    ]
    if session.measures is not None and session.measures.diffuses:
        rows.append(("diffusion coefficient", number(told["diffusion"], 4)))
    rows += _energy(told)
    rows += [
        ("largest overlap, of a diameter", f"{told['max_overlap']:.1e}"),
        ("event loop", f"{cpu:.2f} s, {events / cpu:,.0f} events/s" if cpu > 0 else "–"),
    ]
    for row in rows:
        table.add_row(*row)
    return table


def _energy(told: dict[str, Any]) -> list[tuple[str, str]]:
    """Where the energy went; of a gas that neither wins nor loses any, its drift."""
    start, end = told["energy_start"], told["energy_end"]
    lost = sum(row["lost_normal"] + row["lost_tangential"] for row in told["channels"])
    given = {
        "from walls": sum(told["energy_from_walls"].values()),
        "from the thermostat": told["energy_from_thermostat"],
    }
    scale = abs(start) + abs(end)
    moved = [(f"  {name}", number(x, 5)) for name, x in given.items() if x != 0]
    moved += [("  lost in contacts", number(lost, 5))] if abs(lost) > CONSERVED * scale else []
    if not moved:
        return [("energy drift, relative", f"{told['energy_drift']:.1e}")]
    left = end - start - sum(given.values()) + lost
    scale += abs(lost)
    rows = [("energy, start and end", f"{number(start, 5)}, {number(end, 5)}"), *moved]
    return [*rows, ("  unaccounted for, relative", f"{left / scale if scale > 0 else 0.0:.1e}")]


def _species(session: Session, told: dict[str, Any]) -> Table:
    table = _table(["species", "balls", "T trans.", "T rot.", "rot./trans.", "a₂ velocity", "a₂ spin"])
    for one in session.scene.species:
        row = told["species"][one.name]
        translational, rotational = row["temperature_translational"], row["temperature_rotational"]
        ratio = rotational / translational if translational > 0 else math.nan
        cells = [number(translational, 5), number(rotational, 5), number(ratio, 4)]
        table.add_row(one.name, f"{one.count:,}", *cells, _small(row["a2_translational"]), _small(row["a2_rotational"]))
    return table


def _small(x: float) -> str:
    return "–" if math.isnan(x) else f"{x:+.4f}"


def _contacts(told: dict[str, Any]) -> Table:
    table = _table(["contacts", "collisions", "a ball\nand time", "lost, normal", "lost, tangential", "to spin"])
    scale = abs(told["energy_start"]) + abs(told["energy_end"])
    for row in told["channels"]:
        # what rounding leaves of nothing is nothing
        energies = [
            number(0.0 if abs(row[name]) < 1e-9 * scale else row[name], 4)
            for name in ("lost_normal", "lost_tangential", "to_spin")
        ]
        table.add_row(" – ".join(row["between"]), f"{row['collisions']:,}", number(row["rate"], 4), *energies)
    return table
