"""Output of ``carom gas``: tables, JSON, and progress on standard error (a bar on a terminal, else a line now and then)."""

from __future__ import annotations

import json
import math
import time
from collections.abc import Sequence
from types import TracebackType
from typing import TYPE_CHECKING, Any

from rich import box
from rich.table import Table
from rich.text import Text

from carom.cli.console import err, out
from carom.formatting import counted, format_number
from carom.gas.report import UNITS_NOTE, pressure_unit, report

__all__ = [
    "CONTACT_HEADS",
    "KEPT_IN_SPINS",
    "LINE_INTERVAL",
    "Progress",
    "as_json",
    "energy_kept_in_spins",
    "finite",
    "new_table",
    "no_diffusion",
    "print_tables",
    "show",
    "species_columns",
]

if TYPE_CHECKING:
    from carom.gas.scene import GasScene
    from carom.gas.session import Session


TEMPERATURES_NOTE = "Temperatures are energies."
MEANS_NOTE = (
    "Temperatures, pressures and rates are means over the time measured; a₂ over {:.0f} samples, at about equal {}."
)
CONSERVED = 1e-6  # a smaller relative change of the energy is rounding, not dissipation
# Of a species: head and name in the report. The temperatures of the only species are those of the gas.
SPECIES_TEMPERATURES = {
    "translational\ntemperature, J": "temperature_translational", "rotational\ntemperature, J": "temperature_rotational",
    "rotational /\ntranslational": "temperature_ratio",
}  # fmt: skip
SPECIES_CUMULANTS = {"a₂ of\nvelocity": "a2_translational", "a₂ of\nspin": "a2_rotational"}
KEPT_IN_SPINS = "of it in spins, which nothing changes, J"
CONTACT_HEADS = (
    "contact", "collisions", "collisions per ball\nof the first, 1/s", "energy lost\n(normal), J", "energy lost\n(tangential), J",
    "energy\nto spin, J",
)  # fmt: skip
LINE_INTERVAL = 20.0  # s between lines of progress where there is no terminal


def as_json(session: Session) -> str:
    """Return the report of a session as JSON, in full precision; infinite and undefined numbers are null."""
    return json.dumps(finite(report(session)), allow_nan=False, indent=1) + "\n"


def finite(value: Any) -> Any:
    """Return a value with None in place of infinite and undefined numbers, which JSON does not have."""
    if isinstance(value, float):
        return value if math.isfinite(value) else None
    if isinstance(value, dict):
        return {key: finite(part) for key, part in value.items()}
    return [finite(part) for part in value] if isinstance(value, (list, tuple)) else value


def show(session: Session) -> None:
    """Print the report of a session: the gas, its species, its contacts."""
    found = report(session)
    tables = [_totals(session, found), _species(session, found), _contacts(found)]
    measures = session.measures
    assert measures is not None
    undefined = measures.has_diffusion and math.isnan(found["diffusion"])
    notes = [no_diffusion(measures.is_stationary)] if undefined else []
    if found["ended_early"] is not None:
        notes.append(_until(found["ended_early"]))
    print_tables(session.scene, f"Gas: {session.scene.describe()}", tables, found["looks"], notes)


def _until(end: dict[str, Any]) -> str:
    """Return until when a gas was measured that ended early."""
    if end["kind"] != "inelastic collapse":
        return f"Measured until t = {format_number(end['time'], 6)}, where the gas ended: {end['kind']}."
    said = f"Measured until an inelastic collapse at t = {format_number(end['time'], 6)}"
    if end["collisions"] is None:
        return f"{said}; mean free time: none, since too many of the balls took part."
    left_out = counted(end["collisions"], "collision")
    return f"{said}; about {left_out} of the balls that took part are left out of the mean free time."


def no_diffusion(stationary: bool) -> str:
    """Return why a gas without walls has no diffusion coefficient."""
    why = "there are too few samples" if stationary else "the temperature changed by more than a factor of two"
    return f"Diffusion coefficient: none, since {why}."


def print_tables(scene: GasScene, title: str, tables: list[Table], samples: float, notes: Sequence[str] = ()) -> None:
    """Print a title and tables, each as wide as it is, of what they are means, and notes."""
    console = out()
    console.print(Text(title), soft_wrap=True)
    for table in tables:
        console.print(table)
    console.print(Text(f"{UNITS_NOTE} {TEMPERATURES_NOTE}", style="dim"), soft_wrap=True)
    between = "intervals of time" if scene.run.max_events is None else "numbers of collisions"
    between += ", spread over the phases of the walls" * any(one.amplitude > 0 for one in scene.drives)
    for note in (MEANS_NOTE.format(samples, between), *notes):
        console.print(Text(note, style="dim"), soft_wrap=True)


def new_table(heads: Sequence[str], words: int = 1) -> Table:
    """Return an empty table with these heads; the first ``words`` columns are text."""
    table = Table(box=box.SIMPLE_HEAD, padding=(0, 1), pad_edge=False, header_style="bold")
    for k, head in enumerate(heads):
        table.add_column(head, justify="left" if k < words else "right", no_wrap=True, vertical="bottom")
    return table


def _totals(session: Session, found: dict[str, Any]) -> Table:
    """Return the table of the whole gas."""
    table = new_table(["gas", ""], 1)
    events, cpu = found["events"], found["cpu_seconds"]
    translational = found["temperature_translational"]
    ideal = translational * found["balls"] / session.scene.container.geometry.volume
    unit = pressure_unit(session.scene)
    rows = [("pair collisions", f"{found['pair_collisions']:,}")]
    if found["wall_collisions"]:
        rows.append(("wall collisions", f"{found['wall_collisions']:,}"))
    rows += [
        ("simulated time, s", format_number(found["simulated_time"], 6)),
        ("mean free time, s", format_number(found["mean_free_time"], 6)),
        (f"pressure, {unit}", format_number(found["pressure"], 6)),
        ("  relative to an ideal gas", format_number(found["pressure"] / ideal, 5) if ideal > 0 else "–"),
        *((f"  on {wall}, {unit}", format_number(x, 6)) for wall, x in found["wall_pressure"].items()),
        ("translational temperature, J", format_number(translational, 6)),
    ]
    if session.scene.spins_change:
        rows += [
            ("rotational temperature, J", format_number(found["temperature_rotational"], 6)),
            ("  rotational / translational", format_number(found["temperature_ratio"], 5)),
        ]
    if session.measures is not None and session.measures.has_diffusion:
        rows.append(("diffusion coefficient, m²/s", format_number(found["diffusion"], 4)))
    rows += _energy(session.scene, found)
    rows += [
        ("largest overlap / contact distance", f"{found['max_overlap']:.1e}"),
        ("processor time of the event loop", f"{cpu:.2f} s, {events / cpu:,.0f} events/s" if cpu > 0 else "–"),
    ]
    for row in rows:
        table.add_row(*row)
    return table


def _energy(scene: GasScene, found: dict[str, Any]) -> list[tuple[str, str]]:
    """Return the rows of the energy balance; for a gas that conserves energy, its drift."""
    start, end = found["energy_start"], found["energy_end"]
    lost = sum(row["lost_normal"] + row["lost_tangential"] for row in found["channels"])
    given = {
        "given by walls": sum(found["energy_from_walls"].values()),
        "given by the thermostat": found["energy_from_thermostat"],
    }
    scale = abs(start) + abs(end)
    moved = [(f"  {name}, J", format_number(x, 5)) for name, x in given.items() if x != 0]
    moved += [("  lost in collisions, J", format_number(lost, 5))] if abs(lost) > CONSERVED * scale else []
    if not moved:
        return [("relative energy drift", f"{found['energy_drift']:.1e}")]
    rows = [("energy at start and end, J", f"{format_number(start, 5)}, {format_number(end, 5)}")]
    if (kept := energy_kept_in_spins(scene, found)) > 0:
        rows.append((f"  {KEPT_IN_SPINS}", format_number(kept, 5)))
    return [*rows, *moved, ("  relative imbalance", f"{found['energy_imbalance']:.1e}")]


def energy_kept_in_spins(scene: GasScene, found: dict[str, Any]) -> float:
    """Return the rotational energy of a gas in which nothing changes a spin; 0 for others."""
    components = 1 if scene.container.dimensions == 2 else 3
    kept: float = 0.0 if scene.spins_change else found["temperature_rotational"] * components * scene.count / 2
    return kept


def _species(session: Session, found: dict[str, Any]) -> Table:
    """Return the table of the species: temperatures, and fourth cumulants a₂ of velocity and spin."""
    columns = species_columns(session.scene)
    table = new_table(["species", "balls", *columns])
    for one in session.scene.species:
        row = found["species"][one.name]
        cells = [
            _signed(row[name]) if name in SPECIES_CUMULANTS.values() else format_number(row[name], 5)
            for name in columns.values()
        ]
        table.add_row(one.name, f"{one.count:,}", *cells)
    return table


def species_columns(scene: GasScene) -> dict[str, str]:
    """Return head and name of what is reported of each species: of spins only where something can change them."""
    columns = SPECIES_CUMULANTS if len(scene.species) == 1 else SPECIES_TEMPERATURES | SPECIES_CUMULANTS
    return {
        head: name
        for head, name in columns.items()
        if scene.spins_change or name in {"temperature_translational", "a2_translational"}
    }


def _signed(x: float) -> str:
    """Return a fourth cumulant with its sign; a dash for nan."""
    return "–" if math.isnan(x) else f"{x:+.4f}"


def _contacts(found: dict[str, Any]) -> Table:
    """Return the table of the contacts: rates (per ball of the first species), and energies in units of the scene's."""
    table = new_table(CONTACT_HEADS)
    scale = abs(found["energy_start"]) + abs(found["energy_end"])
    for row in found["channels"]:
        # (rounding is shown as zero)
        energies = [
            format_number(0.0 if abs(row[name]) < 1e-9 * scale else row[name], 4)
            for name in ("lost_normal", "lost_tangential", "to_spin")
        ]
        table.add_row(" – ".join(row["between"]), f"{row['collisions']:,}", format_number(row["rate"], 4), *energies)
    return table


# --- progress ------------------------------------------------------------------------------------------------------


class Progress:
    """Progress of a session: its part, events, events per second, simulated time. A context manager."""

    def __init__(self, quiet: bool) -> None:
        self.console = err()
        self.quiet = quiet
        self.bar: Any = None
        self.task: Any = None
        self.part: bool | None = None
        self.begin = self.last_line = time.monotonic()
        self.first = 0

    def say(self, text: str) -> None:
        """Print a line, unless quiet."""
        if not self.quiet:
            self.console.print(text, soft_wrap=True, markup=False)

    def note_compiling(self) -> None:
        """Print a line if the event loop has not been compiled yet."""
        from carom.gas.edmd.driver import loop_is_cached

        if not loop_is_cached():
            self.say("compiling the event loop (once)")

    def growing(self, fraction: float) -> None:
        """Show the progress of growing a dense start."""
        now = time.monotonic()
        if self.quiet or (now - self.last_line < (0.3 if self.console.is_terminal else LINE_INTERVAL) and fraction < 1):
            return
        self.last_line = now
        end = "\r" if self.console.is_terminal and fraction < 1 else "\n"
        self.console.print(f"growing a dense start: {fraction:.1%} of the final radii ", end=end, markup=False)

    def __enter__(self) -> Progress:
        """Start the display."""
        if self.console.is_terminal and not self.quiet:
            from rich.progress import BarColumn, TaskProgressColumn, TextColumn, TimeRemainingColumn
            from rich.progress import Progress as Bar

            text = TextColumn("{task.fields[events]}  {task.fields[rate]}  {task.fields[time]}")
            self.bar = Bar(
                TextColumn("{task.description:13}"), BarColumn(), TaskProgressColumn(), text, TimeRemainingColumn(),
                console=self.console, transient=True,
            )  # fmt: skip
            self.bar.start()
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        """Stop the display."""
        if self.bar is not None:
            self.bar.stop()

    def show(self, session: Session) -> None:
        """Show the progress of a session."""
        if self.quiet:
            return
        now = time.monotonic()
        if session.measuring != self.part:
            self._next_part(session, now)
        took = now - self.begin
        rate = (session.gas.collisions - self.first) / took if took > 0 else 0.0
        words = (f"{session.done:,} events", f"{rate:,.0f} events/s", f"t = {session.gas.time:.5g}")
        if self.bar is not None:
            self.bar.update(self.task, completed=session.completed, events=words[0], rate=words[1], time=words[2])
        elif now - self.last_line >= LINE_INTERVAL:
            self.last_line = now
            self.say(f"{self._part_name(session)}: {session.completed:.0%}, {', '.join(words)}")

    def _next_part(self, session: Session, now: float) -> None:
        self.part, self.begin, self.first = session.measuring, now, session.gas.collisions
        if self.bar is not None:
            if self.task is not None:
                self.bar.remove_task(self.task)
            self.task = self.bar.add_task(self._part_name(session), total=1.0, events="", rate="", time="")
        elif not session.finished:
            self.say(f"{self._part_name(session)}: {counted(session.scene.count, 'ball')}")

    @staticmethod
    def _part_name(session: Session) -> str:
        return "measuring" if session.measuring else "equilibrating"
