"""Tables of what was measured of a gas, or of an ensemble: then with standard errors in the last digits."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

from rich import box
from rich.table import Table

from carom.formatting import format_number, format_uncertain
from carom.gas.report import pressure_unit

if TYPE_CHECKING:
    from carom.gas.scene import GasScene

__all__ = ["gas_tables"]

CONSERVED = 1e-6  # a smaller relative change of the energy is rounding, not dissipation
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


def gas_tables(scene: GasScene, found: Report, error: Report | None = None) -> list[Table]:
    """Return the tables of the whole gas, its species, and its contacts: of a report, or of means with their errors."""
    return [_totals(scene, found, error), _species(scene, found, error), _contacts(found, error)]


def _cell(found: Report, error: Report | None, name: str, digits: int = 6) -> str:
    """Return a number of a report, with its standard error if it has one; whole numbers with all digits."""
    x = found[name]
    if error is not None:
        return format_uncertain(x, error[name])
    return f"{x:,}" if isinstance(x, int) else format_number(x, digits)


def _totals(scene: GasScene, found: Report, error: Report | None) -> Table:
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
    table = _new_table(["gas", "" if error is None else "mean"])
    for one in rows:
        table.add_row(*one)
    return table


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


def _species(scene: GasScene, found: Report, error: Report | None) -> Table:
    """Return the table of the species: temperatures, and fourth cumulants a₂; of spins only where something can change them."""
    heads = SPECIES_CUMULANTS if len(scene.species) == 1 else SPECIES_TEMPERATURES | SPECIES_CUMULANTS
    of_velocity = {"temperature_translational", "a2_translational"}
    columns = {head: name for head, name in heads.items() if scene.spins_change or name in of_velocity}
    table = _new_table(["species", "balls", *columns])
    for one in scene.species:
        row, errors = found["species"][one.name], None if error is None else error["species"][one.name]
        cells = (
            f"{row[name]:+.4f}".replace("+nan", "–")
            if errors is None and name in SPECIES_CUMULANTS.values()
            else _cell(row, errors, name, 5)
            for name in columns.values()
        )
        table.add_row(one.name, f"{one.count:,}", *cells)
    return table


def _contacts(found: Report, error: Report | None) -> Table:
    """Return the table of the contacts: rates (per ball of the first species), and energies."""
    table = _new_table(CONTACT_HEADS)
    least = ROUNDING * _scale(found)
    for k, row in enumerate(found["channels"]):
        errors = None if error is None else error["channels"][k]
        energies = (
            "0" if abs(row[name]) < least else _cell(row, errors, name, 4)
            for name in ("lost_normal", "lost_tangential", "to_spin")
        )
        numbers = (_cell(row, errors, "collisions"), _cell(row, errors, "rate", 4))
        table.add_row(" – ".join(row["between"]), *numbers, *energies)
    return table


def _new_table(heads: Sequence[str]) -> Table:
    """Return an empty table with these heads; the first column is text."""
    table = Table(box=box.SIMPLE_HEAD, padding=(0, 1), pad_edge=False, header_style="bold")
    for k, head in enumerate(heads):
        table.add_column(head, justify="right" if k else "left", no_wrap=True, vertical="bottom")
    return table
