"""What the verbs share: faults gathered, a console that fits where it writes, ticks."""

from __future__ import annotations

import json
import sys
from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Any

from carom.errors import CaromError

if TYPE_CHECKING:
    from rich.console import Console

__all__ = ["attempt", "noting", "out", "page_of", "tell", "tick", "working", "wrote"]


def attempt(found: list[str], action: Callable[..., Any], *args: Any) -> Any:
    """What the action gives; its faults, where it has any, go to ``found``."""
    try:
        return action(*args)
    except CaromError as error:
        found += error.faults
        return None


@contextmanager
def noting(notes: Iterable[str]) -> Iterator[None]:
    """What was noted of a file before it failed further on: it goes with the error, and often says why."""
    try:
        yield
    except CaromError as error:
        for note in notes:
            error.add_note(note)
        raise


def out() -> Console:
    """Standard output for tables: colours only on a terminal, no character that it cannot write."""
    from rich.console import Console

    encoding = (sys.stdout.encoding or "utf-8").lower().replace("-", "")
    if not encoding.startswith("utf") and hasattr(sys.stdout, "reconfigure"):
        sys.stdout.reconfigure(errors="replace")
    return Console(highlight=False)


@contextmanager
def working(
    what: str, console: Console | None = None, compiling: str = "compiling, once"
) -> Iterator[Callable[[float, float], None] | None]:
    """A bar on standard error where that is a terminal, with what is done, or that it is compiled first: a function to tell it how
    much of all is done. None elsewhere."""
    from rich.console import Console
    from rich.progress import BarColumn, Progress, TaskProgressColumn, TextColumn, TimeRemainingColumn

    from carom.compiled import telling

    console = console or Console(stderr=True, highlight=False)
    if not console.is_terminal:
        yield None
        return
    columns = (
        TextColumn("[progress.description]{task.description}"),
        BarColumn(),
        TaskProgressColumn(),
        TimeRemainingColumn(),
    )
    with Progress(*columns, console=console, transient=True) as bar:
        task = bar.add_task(what, total=None)
        with telling(lambda now: bar.update(task, description=compiling if now else what)):
            yield lambda done, size: bar.update(task, completed=done, total=size)


def tick(console: Console, good: bool) -> str:
    """A tick or a cross; words where the output has no such characters."""
    if console.encoding.startswith("utf"):
        return "✓" if good else "✗"
    return "yes" if good else "no"


def tell(ranking: Any, show: Callable[[Any], None], as_json: bool, console: Console, written: Path | None) -> None:
    """A ranking of laws on standard output, as JSON or shown; on the console its notes, and where its page is."""
    if as_json:
        sys.stdout.write(json.dumps(ranking.as_dict(), indent=2, allow_nan=False) + "\n")
    else:
        show(ranking)
    for note in ranking.notes:
        console.print(f"note: {note}", style="yellow", markup=False, soft_wrap=True)
    if written is not None:
        wrote(written)


def wrote(*paths: Path) -> None:
    """Say which files there are now."""
    for path in paths:
        sys.stderr.write(f"written: {path}\n")


def page_of(write: Callable[[], Path], insists: bool, console: Console) -> Path | None:
    """Where a page was written; None, and why, where none can be and nobody asked for it (``insists``)."""
    import importlib.util

    if importlib.util.find_spec("matplotlib") is None:
        if insists:
            raise CaromError("--report: needs Matplotlib, which is not installed; run: pip install matplotlib")
        console.print("no report: Matplotlib is not installed (pip install matplotlib)", style="yellow")
        return None
    try:
        return write()
    except CaromError as error:
        if insists:
            raise
        console.print(f"no report: {error}", style="yellow", markup=False, soft_wrap=True)
        return None
