"""The consoles of standard output and standard error: what they print is text, and no name in it steers the terminal."""

from __future__ import annotations

import os
import sys
import time
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from typing import Any

from rich import box
from rich.cells import cell_len
from rich.console import Console
from rich.segment import Segment
from rich.table import Column, Table
from rich.text import Text

from carom.cli.verbs import in_options
from carom.formatting import Listing, escape_controls

LONGEST_WORD = 16  # columns of the screen; a longer word, such as a path, is folded where a table has to be narrow
WIDEST = 1000
LINE_INTERVAL = 10.0  # s between lines of progress where there is no terminal


class TextConsole(Console):
    """Rich's console for text that others wrote: control characters are escaped, and square brackets are no markup."""

    def __init__(self, **settings: Any) -> None:
        super().__init__(highlight=False, markup=False, emoji=False, **settings)

    def print(self, *objects: Any, soft_wrap: bool | None = None, **settings: Any) -> None:
        """Print so that no number is cut: a table is as wide as its numbers, even if that is wider than the terminal.

        Lines with ``soft_wrap`` are wrapped at words where the width is known (a terminal, or COLUMNS), else left whole for
        programs that read them.
        """
        if soft_wrap and (self.is_terminal or "COLUMNS" in os.environ):
            soft_wrap = False
            settings.setdefault("overflow", "fold")
        for table in objects:
            if isinstance(table, Table):
                _escape_cells(table)
        objects = tuple(map(_with_options, objects))
        width = self.width
        self.width = max([width, *(self._fit(table) for table in objects if isinstance(table, Table))])
        try:
            super().print(*objects, soft_wrap=soft_wrap, **settings)
        finally:
            self.width = width

    def table(
        self, listing: Listing, styles: Mapping[int, str] | None = None, grid: bool = False, fold: Sequence[int] = ()
    ) -> None:
        """Print a table of text; ``styles`` by row; ``grid``: no line below the heads; ``fold``: columns broken into lines."""
        table = Table(
            box=None if grid else box.SIMPLE_HEAD, padding=(0, 1, 0, 0 if grid else 1), pad_edge=False,
            header_style="dim" if grid else "bold",
        )  # fmt: skip
        place: Any = "bottom" if any("\n" in head for head in listing.heads) else "top"
        for k, (head, side) in enumerate(zip(listing.heads, listing.sides, strict=True)):
            table.add_column(head, justify=side, overflow="fold", vertical=place, no_wrap=k not in fold)
        for k, row in enumerate(listing.rows):
            table.add_row(*row, style=(styles or {}).get(k))
        if not grid and self.measure(table, options=self.options.update(width=WIDEST)).maximum > self.width:
            table.padding = (0, 0)
        self.print(table)
        if listing.note:
            self.print(listing.note, style="dim", soft_wrap=True)

    def facts(self, rows: Iterable[tuple[str, str]]) -> None:
        """Print names, in bold, with what is said of each."""
        table = Table.grid("", "", padding=(0, 2))
        table.columns[0].style, table.columns[0].no_wrap, table.columns[1].overflow = "bold", True, "fold"
        for row in rows:
            table.add_row(*row)
        self.print(table)

    def _fit(self, table: Table) -> int:
        """Set the widths of a table's columns, and return its own: the terminal's if its numbers have room there.

        (Rich narrows all columns in proportion, and cuts numbers then.)
        """
        widest = self.options.update(width=WIDEST)
        natural_width = self.measure(table, options=widest).maximum
        if natural_width <= self.width or all(column.no_wrap for column in table.columns):
            return natural_width
        natural = [max(_least_width(column, WIDEST), column.min_width or 0) for column in table.columns]
        least = [_least_width(column, LONGEST_WORD) for column in table.columns]
        for column, width in zip(table.columns, least, strict=True):
            column.overflow, column.width = "fold", width
        spare = self.width - self.measure(table, options=widest).maximum
        while spare > 0 and natural != least:  # the column whose cells take most lines is widened
            k = max(range(len(least)), key=lambda k: natural[k] / max(least[k], 1))
            least[k] += 1
            spare -= 1
        for column, width in zip(table.columns, least, strict=True):
            column.width = width
        return self.measure(table, options=widest).maximum

    def render(self, *args: Any, **options: Any) -> Iterable[Segment]:
        """Yield the pieces of what is printed, with all that is not Rich's own escaped."""
        for piece in super().render(*args, **options):
            if piece.control or piece.text == "\r":  # (a line that is written anew)
                yield piece
            else:
                yield piece._replace(text=escape_controls(piece.text))


def _with_options(printed: Any) -> Any:
    """Return a text of the library with the names of options in it; anything else as it is."""
    if isinstance(printed, Text) and not printed.spans:
        return Text(in_options(printed.plain), style=printed.style)
    return in_options(printed) if isinstance(printed, str) else printed


def _escape_cells(table: Table) -> None:
    """Name options, and write out control characters, in a table's texts, before the widths of its columns are found."""
    for column in table.columns:
        column._cells = [escape_controls(in_options(cell)) if isinstance(cell, str) else cell for cell in column._cells]
        if isinstance(column.header, str):
            column.header = escape_controls(column.header)


def _least_width(column: Column, longest: int) -> int:
    """Return the width that keeps the cells of a column whole if they are numbers (aligned right), else words up to ``longest``.

    With ``WIDEST`` it is the width at which no cell is wrapped.
    """
    cells = [line for cell in column.cells for line in str(cell).splitlines()]
    heads = str(column.header).split("\n" if column.no_wrap or longest == WIDEST else None)
    if column.no_wrap or column.justify == "right" or longest == WIDEST:
        return max(map(cell_len, [*heads, *cells]), default=0)
    return min(max((cell_len(word) for text in (*heads, *cells) for word in text.split()), default=0), longest)


def out() -> TextConsole:
    """Return the console of standard output: colours only on a terminal, no character that it cannot write."""
    encoding = (sys.stdout.encoding or "utf-8").lower().replace("-", "")
    if not encoding.startswith("utf") and hasattr(sys.stdout, "reconfigure"):
        sys.stdout.reconfigure(errors="replace")
    return TextConsole()


def err() -> TextConsole:
    """Return the console of standard error, for notes and progress."""
    return TextConsole(stderr=True)


# ----------------------------------------------------------------------------------------------------
# The progress of all verbs on standard error: a bar on a terminal.


@contextmanager
def working(
    what: str,
    console: Console | None = None,
    compiling: str = "compiling, once",
    *,
    quiet: bool = False,
    unit: str = "",
) -> Iterator[Callable[..., None] | None]:
    """Show progress on standard error; yield its function (done, total, text), None with ``quiet``.

    It is a bar on a terminal, else a line every ten seconds. While loops are compiled, ``compiling`` is shown in place of
    ``what``. With a unit, such as "points", their number and how many of them are done in a second are shown, too.
    """
    from carom.core.jit.threads import watch_compiling

    console = console or err()
    if quiet:
        yield None
        return
    if not console.is_terminal:
        yield Lines(console, what, unit).show
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


class Lines:
    """Progress where standard error is no terminal: a line every ten seconds."""

    def __init__(self, console: Console, what: str, unit: str = "") -> None:
        self._console, self._what, self._unit = console, what, unit
        self._begin = self._last = time.monotonic()

    def show(self, done: float, total: float | None, text: str = "") -> None:
        """Print what is done, how much of it, and since when, if the last line was ten seconds ago."""
        now = time.monotonic()
        if now - self._last < LINE_INTERVAL:
            return
        self._last = now
        share = f"{done / total:.0%}" if total and total > 0 else ""
        amount = f"{done:,.0f} {self._unit}" if self._unit else "" if text == self._what else text
        parts = ", ".join(filter(None, (share, amount, f"{now - self._begin:.0f} s")))
        self._console.print(f"{self._what}: {parts}", soft_wrap=True)


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
