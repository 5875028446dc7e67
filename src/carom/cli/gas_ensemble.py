"""``carom gas --ensemble N``: independent gases of one scene; tables of means with standard errors, JSON, the plot."""

from __future__ import annotations

import math
import time
from pathlib import Path
from typing import TYPE_CHECKING, Any

from rich.text import Text

from carom.cli.common import write_files, wrote
from carom.cli.console import out
from carom.cli.gas_output import LINE_INTERVAL, Progress, no_diffusion, print_tables
from carom.cli.interrupts import say_interrupted
from carom.cli.streams import json_text, say_json
from carom.errors import FaultList

if TYPE_CHECKING:
    from carom.gas.ensembles import Ensemble
    from carom.gas.scene import GasScene

__all__ = ["require_no_files", "run_ensemble"]


def require_no_files(found: FaultList, members: int, files: dict[str, Any]) -> None:
    """Add the faults of a number of members, and of files that only a single gas has, to ``found``."""
    if members < 2:
        found.add("--ensemble", "a number of gases >= 2", str(members))
    for file_option, value in files.items():
        if value is not None:
            advice = "run one of its gases by its --seed, which --json prints"
            found.add(file_option, "none with --ensemble", str(value), advice)


def run_ensemble(
    scene: GasScene,
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
    found = FaultList()
    try:
        with progress:
            ensemble = simulate_ensemble(scene, members, progress=_Bar(progress, members).show)
    except EndedEarlyError as error:
        if error.result is None:
            raise
        ensemble = error.result
        found += error.records
    except KeyboardInterrupt:
        say_interrupted("carom: interrupted; nothing was saved")
        raise
    written = write_files(found, ensemble, [(plot, _plot), (measures, _write)])
    # the report is printed even if a file cannot be written
    if as_json:
        say_json(_numbers(ensemble), 1)
    elif not quiet:
        undefined = not (scene.container.geometry.faces or scene.shear_rate) and math.isnan(ensemble.mean["diffusion"])
        notes = [no_diffusion("displacement" in ensemble.curves or not ensemble.curves)] if undefined else []
        if ensemble.ended_early:
            notes.append(f"{len(ensemble.ended_early)} of {members} gases ended early; each counts up to its end.")
        print_tables(scene, f"{members} gases: {scene.describe()}", ensemble.mean, ensemble.error, notes)
        out().print(Text("In brackets: standard error of the mean, in units of the last digits."), soft_wrap=True)
    wrote(*(() if quiet else written))
    found.raise_if_any()


class _Bar:
    """Shows how far all members are."""

    def __init__(self, progress: Progress, members: int) -> None:
        self.progress, self.members, self.begin = progress, members, time.monotonic()
        self.announced = False

    def show(self, events: float, total: float, _text: str) -> None:
        """Show the number of collisions so far, and the fraction that is done."""
        share = events / total if total > 0 else 0.0
        one, now = self.progress, time.monotonic()
        if one.bar is None and not self.announced:
            one.say(f"simulating {self.members} gases")
        self.announced = True
        rate = f"{events / max(now - self.begin, 1e-9):,.0f} events/s"
        if one.bar is not None:
            one.bar.describe(f"{self.members} gases")
            one.bar.show(share, 1.0, f"{events:,} events  {rate}")
        elif now - one.last_line >= LINE_INTERVAL:
            one.last_line = now
            one.say(f"{self.members} gases: {share:.0%}, {events:,} events, {rate}")


# --- output --------------------------------------------------------------------------------------------------------


def _numbers(ensemble: Ensemble) -> dict[str, Any]:
    """Return the object of ``--json``."""
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
    write_text(path, json_text(found, None))


def _plot(ensemble: Ensemble, path: Path) -> None:
    from carom.plot.gas_ensemble import plot_ensemble

    plot_ensemble(ensemble, path)
