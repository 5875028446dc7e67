"""``carom gas --ensemble N``: independent gases of one scene; tables of means with standard errors, JSON, the plot."""

from __future__ import annotations

import json
import math
import sys
import time
from pathlib import Path
from typing import TYPE_CHECKING, Any

from rich.text import Text

from carom.cli.common import attempt, wrote
from carom.cli.console import out
from carom.cli.gas_output import (
    CONTACT_HEADS,
    KEPT_IN_SPINS,
    LINE_INTERVAL,
    Progress,
    energy_kept_in_spins,
    finite,
    new_table,
    no_diffusion,
    print_tables,
    species_columns,
)
from carom.cli.interrupts import say_interrupted
from carom.errors import CaromError
from carom.formatting import format_uncertain
from carom.gas.report import pressure_unit

if TYPE_CHECKING:
    from rich.table import Table

    from carom.gas.ensembles import Ensemble
    from carom.gas.scene import GasScene

__all__ = ["require_no_files", "run_ensemble"]


def require_no_files(found: list[str], members: int, files: dict[str, Any]) -> None:
    """Add the faults of a number of members, and of files that only a single gas has, to ``found``."""
    if members < 2:
        found.append(f"--ensemble: expected a number of gases >= 2, got {members}")
    found += [
        f"{option}: expected none with --ensemble, got {value}; run one of its gases by its --seed, which --json prints"
        for option, value in files.items()
        if value is not None
    ]


def run_ensemble(
    scene: GasScene,
    where: str,
    members: int,
    progress: Progress,
    plot: Path | None,
    measures: Path | None,
    as_json: bool,
    quiet: bool,
) -> None:
    """Simulate an ensemble; print it, plot it, and write its measures."""
    from carom.gas.endings import EndedEarlyError
    from carom.gas.ensembles import simulate_ensemble

    progress.note_compiling()
    found: list[str] = []
    try:
        with progress:
            ensemble = simulate_ensemble(scene, members, where=where, progress=_Bar(progress, members).show)
    except EndedEarlyError as error:
        if error.result is None:
            raise
        ensemble, found = error.result, [*error.faults]
    except KeyboardInterrupt:
        say_interrupted("carom: interrupted; nothing was saved")
        raise
    written: list[Path] = []
    for path, action in ((plot, _plot), (measures, _write)):
        if path is not None:
            before = len(found)
            attempt(found, action, ensemble, path)
            written += [path] * (len(found) == before)
    # the report is printed even if a file cannot be written
    if as_json:
        sys.stdout.write(json.dumps(finite(_numbers(ensemble)), allow_nan=False, indent=1) + "\n")
    elif not quiet:
        undefined = not scene.container.geometry.faces and math.isnan(ensemble.mean["diffusion"])
        notes = [no_diffusion("displacement" in ensemble.curves or not ensemble.curves)] if undefined else []
        if ensemble.ended_early:
            notes.append(f"{len(ensemble.ended_early)} of {members} gases ended early; each counts up to its end.")
        print_tables(scene, f"{members} gases: {scene.describe()}", _tables(ensemble), ensemble.mean["looks"], notes)
        out().print(Text("In brackets: standard error of the mean, in units of the last digits."), soft_wrap=True)
    wrote(*(() if quiet else written))
    if found:
        raise CaromError(*found)


class _Bar:
    """Shows how far all members are."""

    def __init__(self, progress: Progress, members: int) -> None:
        self.progress, self.members, self.begin = progress, members, time.monotonic()
        self.announced = False

    def show(self, share: float, events: int) -> None:
        """Show the fraction that is done, and the number of collisions so far."""
        one, now = self.progress, time.monotonic()
        if one.bar is None and not self.announced:
            one.say(f"simulating {self.members} gases")
        self.announced = True
        rate = f"{events / max(now - self.begin, 1e-9):,.0f} events/s"
        if one.bar is not None:
            if one.task is None:
                one.task = one.bar.add_task(f"{self.members} gases", total=1.0, events="", rate="", time="")
            one.bar.update(one.task, completed=share, events=f"{events:,} events", rate=rate)
        elif now - one.last_line >= LINE_INTERVAL:
            one.last_line = now
            one.say(f"{self.members} gases: {share:.0%}, {events:,} events, {rate}")


# --- output --------------------------------------------------------------------------------------------------------


def _numbers(ensemble: Ensemble) -> dict[str, Any]:
    """Return what ``--json`` prints."""
    return {
        "ensemble": len(ensemble.seeds), "seeds": list(ensemble.seeds), "mean": ensemble.mean, "error": ensemble.error,
        "ended_early": {str(seed): end.to_dict() for seed, end in ensemble.ended_early.items()},
    }  # fmt: skip


def _write(ensemble: Ensemble, path: Path) -> None:
    """Write all measures, of each member and their means, and the curves as JSON."""
    from carom.files import write_text

    curves = {
        name: {part: values.tolist() for part, values in curve._asdict().items()}
        for name, curve in ensemble.curves.items()
    }
    found = _numbers(ensemble) | {"curves": curves, "members": ensemble.members}
    write_text(path, json.dumps(finite(found), allow_nan=False) + "\n")


def _plot(ensemble: Ensemble, path: Path) -> None:
    from carom.plot.gas_ensemble import plot_ensemble

    plot_ensemble(ensemble, path)


def _tables(ensemble: Ensemble) -> list[Table]:
    """Return the tables of the whole gas, its species, and its contacts."""
    mean, error = ensemble.mean, ensemble.error

    def cell(place: Any, deviation: Any, name: str, scale: float = 0.0) -> str:
        if abs(place[name]) < 1e-9 * scale:  # rounding
            return "0"
        return format_uncertain(place[name], deviation[name])

    gas = new_table(["gas", "mean"], 1)
    pressure = pressure_unit(ensemble.scene)
    rows = {
        "pair collisions": "pair_collisions", "wall collisions": "wall_collisions", "simulated time, s": "simulated_time",
        "mean free time, s": "mean_free_time", f"pressure, {pressure}": "pressure",
        "translational temperature, J": "temperature_translational",
        "rotational temperature, J": "temperature_rotational", "  rotational / translational": "temperature_ratio",
        "diffusion coefficient, m²/s": "diffusion",
        "energy at the start, J": "energy_start", "energy at the end, J": "energy_end",
        "energy from the thermostat, J": "energy_from_thermostat",
    }  # fmt: skip
    turns = ensemble.scene.spins_change
    for label, name in rows.items():
        if name in {"temperature_rotational", "temperature_ratio"} and not turns:
            continue
        always = name not in {"wall_collisions", "energy_from_thermostat", "diffusion"}
        if always or (mean[name] != 0 and not math.isnan(mean[name])):
            gas.add_row(label, cell(mean, error, name))
        if name == "energy_end" and energy_kept_in_spins(ensemble.scene, mean) > 0:
            kept = (energy_kept_in_spins(ensemble.scene, one) for one in (mean, error))
            gas.add_row(f"  {KEPT_IN_SPINS}", format_uncertain(*kept))
    for what, label in (("wall_pressure", f"pressure on {{}}, {pressure}"), ("energy_from_walls", "energy from {}, J")):
        for name, x in mean[what].items():
            if x != 0:
                gas.add_row(label.format(name), cell(mean[what], error[what], name))
    columns = species_columns(ensemble.scene)
    kinds = new_table(["species", "balls", *columns])
    for one in ensemble.scene.species:
        place, deviation = mean["species"][one.name], error["species"][one.name]
        kinds.add_row(one.name, f"{one.count:,}", *(cell(place, deviation, name) for name in columns.values()))
    contacts = new_table(CONTACT_HEADS)
    scale = abs(mean["energy_start"]) + abs(mean["energy_end"])
    for place, deviation in zip(mean["channels"], error["channels"], strict=True):
        energies = (cell(place, deviation, name, scale) for name in ("lost_normal", "lost_tangential", "to_spin"))
        numbers = (cell(place, deviation, "collisions"), cell(place, deviation, "rate"))
        contacts.add_row(" – ".join(place["between"]), *numbers, *energies)
    return [gas, kinds, contacts]
