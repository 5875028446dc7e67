"""The progress of all verbs on standard error: a bar on a terminal; of compiling, else, a line for each quarter."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from rich.console import Console

    from carom.core.jit.progress import CompileProgress

__all__ = ["Bar", "show_progress", "working"]


@contextmanager
def show_progress(console: Console, quiet: bool, *loops: Callable[..., Any]) -> Iterator[Callable[[str], None]]:
    """Show the progress of compiling ``loops`` inside the block, if anything is compiled; nothing if ``quiet``.

    Yields a function that shows another text instead, on a terminal only.
    """
    from carom.core.jit.progress import compile_progress

    if quiet:
        yield lambda _text: None
    elif console.is_terminal:
        bar = Bar(console)

        def show(now: CompileProgress) -> None:
            bar.describe(f"compiling, once: {now.part}")
            bar.show(now.share, 1.0, f"{now.done} of {now.expected} functions")

        def say(text: str) -> None:
            bar.describe(text)
            bar.show(0, None)

        try:
            with compile_progress(show, *loops):
                yield say
        finally:
            bar.stop()
    else:
        with compile_progress(_lines(console), *loops):
            yield lambda _text: None


@contextmanager
def working(
    what: str,
    console: Console | None = None,
    compiling: str = "compiling, once",
    *,
    quiet: bool = False,
    unit: str = "",
) -> Iterator[Callable[..., None] | None]:
    """Show a progress bar on standard error if that is a terminal; yield its update function (done, total, text), else None.

    While loops are compiled, ``compiling`` is shown in place of ``what``. With a unit, such as "points", their number and how
    many of them are done in a second are shown, too.
    """
    from carom.cli.console import err
    from carom.core.jit.progress import watch_compiling

    console = console or err()
    if quiet or not console.is_terminal:
        yield None
        return
    bar = Bar(console, unit)
    depth = 0

    def describe(_function: str, finished: bool) -> None:
        nonlocal depth
        depth += -1 if finished else 1
        bar.describe(compiling if depth else what)

    try:
        bar.describe(what)
        with watch_compiling(describe):
            yield bar.show
    finally:
        bar.stop()


class Bar:
    """The progress bar of all verbs, shown from the first update on: what is done, how much of it, and the time that is left."""

    def __init__(self, console: Console, unit: str = "") -> None:
        from rich.progress import BarColumn, Progress, TaskProgressColumn, TextColumn, TimeRemainingColumn

        texts = TextColumn("{task.description}", markup=False), TextColumn("{task.fields[said]}", markup=False)
        columns = (texts[0], BarColumn(), TaskProgressColumn(), texts[1], TimeRemainingColumn())
        self._bar = Progress(*columns, console=console, transient=True)
        self._task: Any = None
        self._unit = unit
        self.stop = self._bar.stop

    def show(self, done: float, total: float | None, text: str = "") -> None:
        """Show how much is done, and a text beside it."""
        if self._task is None:
            self.describe("")
        if total is not None and self._bar.tasks[0].total is None:  # (what was done before counts for no rate)
            self._bar.reset(self._task, total=total, completed=int(done))
        self._bar.update(self._task, total=total, completed=done)
        if self._unit:
            speed = self._bar.tasks[0].speed
            text = f"{done:,.0f} of {total:,.0f} {self._unit}" + (f", {speed:,.0f} {self._unit}/s" if speed else "")
        self._bar.update(self._task, said="" if text == self._bar.tasks[0].description else text)
        self._bar.start()

    def describe(self, what: str, *, anew: bool = False) -> None:
        """Say in front of the bar what is done; ``anew``: with a bar and a time of its own."""
        if anew and self._task is not None:
            self._bar.remove_task(self._task)
            self._task = None
        if self._task is None:
            self._task = self._bar.add_task(what, total=None, said="")
        self._bar.update(self._task, description=what)
        self._bar.start()


def _lines(console: Console) -> Callable[[CompileProgress], None]:
    quarter = -1

    def show(now: CompileProgress) -> None:
        nonlocal quarter
        if int(4 * now.share) > quarter:
            quarter = int(4 * now.share)
            text = f"compiling, once: {now.share:.0%}, {now.done} of {now.expected} functions"
            console.print(f"{text}: {now.part}" if now.share < 1 else text, soft_wrap=True, markup=False)

    return show
