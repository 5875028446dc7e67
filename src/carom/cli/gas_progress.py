"""How far a gas is, on standard error: a bar on a terminal, now and then a line elsewhere."""

from __future__ import annotations

import time
from types import TracebackType
from typing import TYPE_CHECKING, Any

from rich.console import Console

if TYPE_CHECKING:
    from carom.gas.session import Session

__all__ = ["Progress"]

LINES = 20.0  # seconds between lines where there is no terminal


class Progress:
    """A bar: what it does, events, events a second, simulated time. Used as a context; quiet where it is asked to be."""

    def __init__(self, quiet: bool) -> None:
        self.console = Console(stderr=True, highlight=False)
        self.quiet = quiet
        self.bar: Any = None
        self.task: Any = None
        self.part: bool | None = None
        self.begin = self.told = time.monotonic()
        self.first = 0

    def say(self, text: str) -> None:
        """A line that matters."""
        if not self.quiet:
            self.console.print(text, soft_wrap=True, markup=False)

    def note_compiling(self) -> None:
        """Say so, if the loop is to be compiled first."""
        from carom.compiled import cache_folder

        if not any(cache_folder().glob("*/swarm.run-*.nbi")):
            self.say("compiling the event loop, once")

    def growing(self, share: float) -> None:
        """How far a dense start has grown."""
        now = time.monotonic()
        if self.quiet or (now - self.told < (0.3 if self.console.is_terminal else LINES) and share < 1):
            return
        self.told = now
        end = "\r" if self.console.is_terminal and share < 1 else "\n"
        self.console.print(f"growing a dense start: {share:.1%} of the radii ", end=end, markup=False)

    def __enter__(self) -> Progress:
        """Begin."""
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
        """End."""
        if self.bar is not None:
            self.bar.stop()

    def show(self, session: Session) -> None:
        """How far it is now."""
        if self.quiet:
            return
        now = time.monotonic()
        if session.measuring != self.part:
            self._next_part(session, now)
        took = now - self.begin
        rate = (session.gas.collisions - self.first) / took if took > 0 else 0.0
        words = (f"{session.done:,} events", f"{rate:,.0f} events/s", f"t = {session.gas.time:.5g}")
        if self.bar is not None:
            self.bar.update(self.task, completed=session.share, events=words[0], rate=words[1], time=words[2])
        elif now - self.told >= LINES:
            self.told = now
            self.say(f"{self._name(session)}: {session.share:.0%}, {', '.join(words)}")

    def _next_part(self, session: Session, now: float) -> None:
        self.part, self.begin, self.first = session.measuring, now, session.gas.collisions
        if self.bar is not None:
            if self.task is not None:
                self.bar.remove_task(self.task)
            self.task = self.bar.add_task(self._name(session), total=1.0, events="", rate="", time="")
        elif not session.finished:
            self.say(f"{self._name(session)}: {session.scene.count:,} balls")

    @staticmethod
    def _name(session: Session) -> str:
        return "measuring" if session.measuring else "equilibrating"
