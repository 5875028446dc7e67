"""Output of ``carom gas``: tables, JSON, and progress on standard error (a bar on a terminal, else a line now and then)."""

from __future__ import annotations

import math
import time
from collections.abc import Sequence
from types import TracebackType
from typing import TYPE_CHECKING, Any

from rich.text import Text

from carom.cli.console import err, out
from carom.cli.gas_tables import gas_tables
from carom.cli.progress import Bar
from carom.cli.streams import json_text
from carom.formatting import counted, format_number
from carom.gas.report import UNITS_NOTE, report

__all__ = [
    "LINE_INTERVAL",
    "Progress",
    "as_json",
    "no_diffusion",
    "print_tables",
    "show",
]

if TYPE_CHECKING:
    from carom.gas.scene import GasScene
    from carom.gas.session import Session


TEMPERATURES_NOTE = "Temperatures are energies."
MEANS_NOTE = "Temperatures, pressures and rates are exact means over the time measured; a₂ over {:.0f} samples, at about equal {}."
LINE_INTERVAL = 20.0  # s between lines of progress where there is no terminal


def as_json(session: Session) -> str:
    """Return the report of a session as JSON, in full precision; infinite and undefined numbers are null."""
    return json_text(report(session), 1)


def show(session: Session) -> None:
    """Print the report of a session: the gas, its species, its contacts."""
    found = report(session)
    measures = session.measures
    assert measures is not None
    undefined = measures.has_diffusion and math.isnan(found["diffusion"])
    notes = [no_diffusion(measures.is_stationary)] if undefined else []
    if found["ended_early"] is not None:
        notes.append(_until(found["ended_early"]))
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
    console.print(Text(title), soft_wrap=True)
    for table in gas_tables(scene, found, error):
        console.print(table)
    console.print(Text(f"{UNITS_NOTE} {TEMPERATURES_NOTE}", style="dim"), soft_wrap=True)
    between = "intervals of time" if scene.run.max_events is None else "numbers of collisions"
    between += ", spread over the phases of the walls" * any(one.amplitude > 0 for one in scene.drives)
    for note in (MEANS_NOTE.format(found["looks"], between), *notes):
        console.print(Text(note, style="dim"), soft_wrap=True)


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

    def growing(self, fraction: float, _total: float, _text: str) -> None:
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
