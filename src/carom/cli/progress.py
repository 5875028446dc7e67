"""Progress of a run and of its compiling on standard error: a bar on a terminal, else a line for each quarter of the compiling."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from rich.console import Console

    from carom.core.jit.progress import CompileProgress

__all__ = ["show_progress"]


@contextmanager
def show_progress(console: Console, quiet: bool, *loops: Callable[..., Any]) -> Iterator[Callable[[str], None]]:
    """Show the progress of compiling ``loops`` inside the block, if anything is compiled; nothing if ``quiet``.

    Yields a function that shows another text instead, on a terminal only.
    """
    from carom.core.jit.progress import compile_progress

    if quiet:
        yield lambda _text: None
    elif console.is_terminal:
        bar = _Bar(console)
        try:
            with compile_progress(bar.show, *loops):
                yield bar.say
        finally:
            bar.stop()
    else:
        with compile_progress(_lines(console), *loops):
            yield lambda _text: None


class _Bar:
    """A progress bar, shown from the first update on."""

    def __init__(self, console: Console) -> None:
        from rich.progress import BarColumn, Progress, TextColumn, TimeElapsedColumn

        texts = TextColumn("{task.description}", markup=False), TextColumn("{task.fields[count]}", markup=False)
        self._bar = Progress(texts[0], BarColumn(), texts[1], TimeElapsedColumn(), console=console, transient=True)
        self._task = self._bar.add_task("", total=None, count="")
        self.stop = self._bar.stop

    def show(self, now: CompileProgress) -> None:
        """Show the progress of a compilation."""
        count = f"{now.done} of {now.expected} functions"
        self._update(total=1.0, completed=now.share, description=f"compiling, once: {now.part}", count=count)

    def say(self, text: str) -> None:
        """Show a text with an indeterminate bar."""
        self._update(total=None, description=text, count="")

    def _update(self, **fields: Any) -> None:
        self._bar.update(self._task, **fields)
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
