"""Output of ``carom gas``: tables, JSON, and progress on standard error (a bar on a terminal, else a line now and then)."""

from __future__ import annotations

import math
import time
from collections.abc import Sequence
from types import TracebackType
from typing import TYPE_CHECKING, Any

from carom.cli.console import LINE_INTERVAL, Bar, err, out
from carom.formatting import Listing, counted, format_number, format_uncertain
from carom.gas.report import UNITS_NOTE, pressure_unit, report

if TYPE_CHECKING:
    from carom.gas.scene import GasScene
    from carom.gas.session import Session

CONSERVED = 1e-6  # a smaller relative change of the energy is rounding, not dissipation
MOST_OVERLAP = 1e-4  # of a contact distance: a start in single precision may have less
# Quantities of a species: head and name in the report. The temperatures of the only species are the gas's own.
SPECIES_TEMPERATURES = {
    "translational\ntemperature, J": "temperature_translational", "rotational\ntemperature, J": "temperature_rotational",
    "rotational /\ntranslational": "temperature_ratio",
}  # fmt: skip
SPECIES_CUMULANTS = {"a₂ of\nvelocity": "a2_translational", "a₂ of\nspin": "a2_rotational"}
CONTACT_HEADS = (
    "contact", "collisions", "collisions per ball\nof the first, 1/s", "energy lost\n(normal), J", "energy lost\n(tangential), J",
    "energy\nto spin, J",
)  # fmt: skip
ROUNDING = 1e-9  # of the energies: a smaller energy of a kind of contact is shown as zero

Report = dict[str, Any]


def gas_tables(scene: GasScene, found: Report, error: Report | None = None) -> list[Listing]:
    """Return the tables of the whole gas, its species, and its contacts: of a report, or of means with their errors."""
    return [_totals(scene, found, error), _species(scene, found, error), _contacts(found, error)]


def _cell(found: Report, error: Report | None, name: str, digits: int = 6) -> str:
    """Return a number of a report, with its standard error if it has one; whole numbers with all digits."""
    x = found[name]
    if error is not None:
        return format_uncertain(x, error[name])
    return f"{x:,}" if isinstance(x, int) else format_number(x, digits)


def _totals(scene: GasScene, found: Report, error: Report | None) -> Listing:
    """Return the table of the whole gas."""

    def row(label: str, name: str, digits: int = 6) -> tuple[str, str]:
        return label, _cell(found, error, name, digits)

    unit, cpu = pressure_unit(scene), found["cpu_seconds"]
    ideal = found["temperature_translational"] * found["balls"] / scene.container.geometry.volume
    rows = [row("pair collisions", "pair_collisions")]
    rows += [row("wall collisions", "wall_collisions")] if found["wall_collisions"] else []
    rows += [row("simulated time, s", "simulated_time"), row("mean free time, s", "mean_free_time")]
    rows.append(row(f"pressure, {unit}", "pressure"))
    if error is None:  # (the error of this ratio does not follow from those of its parts)
        rows.append(("  relative to an ideal gas", format_number(found["pressure"] / ideal, 5) if ideal > 0 else "–"))
    rows += _by_wall(found, error, "wall_pressure", f"  on {{}}, {unit}")
    rows += _flows(found, error)
    rows += _temperatures(scene, found, error)
    if scene.shear_rate:
        shear, of = found["shear"], None if error is None else error["shear"]
        rows.append((f"viscosity, {unit} s", _cell(shear, of, "viscosity")))
        rows.append(("  (P_xx - P_yy) / pressure", _cell(shear, of, "normal_difference", 4)))
    elif not scene.container.geometry.faces:
        rows.append(row("diffusion coefficient, m²/s", "diffusion", 4))
    rows += [row("energy at the start, J", "energy_start", 5), row("energy at the end, J", "energy_end", 5)]
    if not scene.spins_change and found["temperature_rotational"] > 0:
        # (their energy follows from their temperature)
        parts = (1 if scene.container.dimensions == 2 else 3) * scene.count / 2
        x, e = ({"": parts * one["temperature_rotational"]} for one in (found, error or found))
        rows.append(("  of it in spins, which nothing changes, J", _cell(x, None if error is None else e, "", 5)))
    rows += _balance(found, error)
    rows.append(("largest overlap / contact distance", f"{found['max_overlap']:.1e}"))
    rate = f"{cpu:.2f} s, {found['events'] / cpu:,.0f} events/s" if cpu > 0 else "–"
    rows.append(("processor time of the event loop", rate))
    return Listing(["gas", "" if error is None else "mean"], rows)


def _temperatures(scene: GasScene, found: Report, error: Report | None) -> list[tuple[str, str]]:
    """Return the rows of the temperatures: means over time; where they change, also those at the end, and their ratio.

    A ratio is one of equal times: of means only where the temperature stays.
    """
    heads = {"translational temperature, J": "temperature_translational"}
    if scene.spins_change:
        heads["rotational temperature, J"] = "temperature_rotational"
    ratio = {"  rotational / translational": "temperature_ratio"} if scene.spins_change else {}
    if found["stationary"] == 1:
        return [(label, _cell(found, error, name)) for label, name in (heads | ratio).items()]
    rows = [(f"{label[:-3]}, mean over time, J", _cell(found, error, name)) for label, name in heads.items()]
    end, errors = found["final"], None if error is None else error["final"]
    rows += [(f"{label[:-3]} at the end, J", _cell(end, errors, name)) for label, name in heads.items()]
    return rows + [(f"{label} at the end", _cell(end, errors, name, 5)) for label, name in ratio.items()]


def _flows(found: Report, error: Report | None) -> list[tuple[str, str]]:
    """Return the rows of the outflow along gravity, and of the walls that move, at the end."""
    rows = []
    if flow := found["outflow"]:
        errors = None if error is None else error["outflow"]
        rows.append((f"balls out along {flow['axis']}", _cell(flow, errors, "balls")))
        rows.append(("  per unit time, 1/s", _cell(flow, errors, "rate", 5)))
    for name, one in found["walls"].items():
        errors = None if error is None else error["walls"][name]
        rows.append((f"{name} at the end: displacement, m", _cell(one, errors, "displacement")))
        rows.append(("  speed, m/s", _cell(one, errors, "speed", 5)))
    return rows


def _by_wall(found: Report, error: Report | None, name: str, label: str) -> list[tuple[str, str]]:
    """Return a row for each wall that has a number other than zero."""
    errors = None if error is None else error[name]
    return [(label.format(wall), _cell(found[name], errors, wall)) for wall, x in found[name].items() if x != 0]


def _balance(found: Report, error: Report | None) -> list[tuple[str, str]]:
    """Return the rows of the energy balance: what was given and lost; of a gas that conserves energy, its drift."""
    lost = sum(row["lost_normal"] + row["lost_tangential"] for row in found["channels"])
    rows = _by_wall(found, error, "energy_from_walls", "  given by {}, J")
    if found["energy_from_thermostat"] != 0:
        rows.append(("  given by the thermostat, J", _cell(found, error, "energy_from_thermostat", 5)))
    if "shear" in found:
        rows.append(
            ("  given by the shear, J", _cell(found["shear"], None if error is None else error["shear"], "energy", 5))
        )
    if abs(lost) > CONSERVED * _scale(found):
        rows.append(("  lost in collisions, J", format_number(lost, 5)))
    name, label = ("energy_imbalance", "  relative imbalance") if rows else ("energy_drift", "relative energy drift")
    return [*rows, (label, f"{found[name]:.1e}")]


def _scale(found: Report) -> float:
    return float(abs(found["energy_start"]) + abs(found["energy_end"]))


def _species(scene: GasScene, found: Report, error: Report | None) -> Listing:
    """Return the table of the species: temperatures, and fourth cumulants a₂; of spins only where something can change them."""
    heads = SPECIES_CUMULANTS if len(scene.species) == 1 else SPECIES_TEMPERATURES | SPECIES_CUMULANTS
    of_velocity = {"temperature_translational", "a2_translational"}
    columns = {head: name for head, name in heads.items() if scene.spins_change or name in of_velocity}
    rows = []
    for one in scene.species:
        row, errors = found["species"][one.name], None if error is None else error["species"][one.name]
        cells = (
            f"{row[name]:+.4f}".replace("+nan", "–")
            if errors is None and name in SPECIES_CUMULANTS.values()
            else _cell(row, errors, name, 5)
            for name in columns.values()
        )
        rows.append((one.name, f"{one.count:,}", *cells))
    return Listing(["species", "balls", *columns], rows)


def _contacts(found: Report, error: Report | None) -> Listing:
    """Return the table of the contacts: rates (per ball of the first species), and energies."""
    rows = []
    least = ROUNDING * _scale(found)
    for k, row in enumerate(found["channels"]):
        errors = None if error is None else error["channels"][k]
        energies = (
            "0" if abs(row[name]) < least else _cell(row, errors, name, 4)
            for name in ("lost_normal", "lost_tangential", "to_spin")
        )
        numbers = (_cell(row, errors, "collisions"), _cell(row, errors, "rate", 4))
        rows.append((" – ".join(row["between"]), *numbers, *energies))
    return Listing(CONTACT_HEADS, rows)


# ----------------------------------------------------------------------------------------------------
# Output of ``carom gas``: tables, JSON, and progress on standard error (a bar on a terminal, else a line now and then).


TEMPERATURES_NOTE = "Temperatures are energies."
MEANS_NOTE = "Temperatures, pressures and rates are exact means over the time measured; a₂ over {:.0f} samples, at about equal {}."


def show(session: Session) -> None:
    """Print the report of a session: the gas, its species, its contacts."""
    found = report(session)
    measures = session.measures
    assert measures is not None
    undefined = measures.has_diffusion and math.isnan(found["diffusion"])
    notes = [no_diffusion(measures.is_stationary)] if undefined else []
    if found["ended_early"] is not None:
        notes.append(_until(found["ended_early"]))
    if found["max_overlap"] > MOST_OVERLAP:
        notes.append(
            "Balls overlapped by more than rounding: collisions were missed, which is a fault of carom; please report it."
        )
    print_tables(session.scene, f"Gas: {session.scene.describe()}", found, None, notes)


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


def print_tables(
    scene: GasScene, title: str, found: dict[str, Any], error: dict[str, Any] | None, notes: Sequence[str]
) -> None:
    """Print a title and the tables of a report, or of means with their errors, each as wide as it is, and notes."""
    console = out()
    console.print(title, soft_wrap=True)
    for table in gas_tables(scene, found, error):
        console.table(table)
    console.print(f"{UNITS_NOTE} {TEMPERATURES_NOTE}", style="dim", soft_wrap=True)
    between = "intervals of time" if scene.run.max_events is None else "numbers of collisions"
    between += ", spread over the phases of the walls" * any(one.amplitude > 0 for one in scene.drives)
    for note in (MEANS_NOTE.format(found["samples"], between), *notes):
        console.print(note, style="dim", soft_wrap=True)


# --- progress ------------------------------------------------------------------------------------------------------


class Progress:
    """Progress of a session: its part, events, events per second, simulated time. A context manager."""

    def __init__(self, quiet: bool) -> None:
        self.console = err()
        self.quiet = quiet
        self.bar: Bar | None = None
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

    def __enter__(self) -> Progress:
        """Start the display."""
        if self.console.is_terminal and not self.quiet:
            self.bar = Bar(self.console)
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
            self.bar.show(session.completed, 1.0, "  ".join(words))
        elif now - self.last_line >= LINE_INTERVAL:
            self.last_line = now
            self.say(f"{session.part}: {session.completed:.0%}, {', '.join(words)}")

    def _next_part(self, session: Session, now: float) -> None:
        self.part, self.begin, self.first = session.measuring, now, session.gas.collisions
        if self.bar is not None:
            self.bar.describe(session.part, anew=True)
        elif not session.finished:
            self.say(f"{session.part}: {counted(session.scene.count, 'ball')}")
