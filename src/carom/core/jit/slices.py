"""Long compiled loops in slices: Ctrl-C is heard between two of them, since Python runs no handler while compiled code does."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator
from typing import Any

import numpy as np

__all__ = ["Pace", "block_slices", "row_slices", "sliced"]

SLICE_SECONDS = 0.2  # what a slice is to take
GROWTH = 8  # a slice is at most so many times as long as the one before


class Pace:
    """How much to do at once, so that a slice takes about a fifth of a second.

    Parameters
    ----------
    first : int
        Of the first slice: so little that it is short at any speed, so much that calling the loop takes no time beside it.
    """

    def __init__(self, first: int) -> None:
        self.amount = first
        self._begin = time.perf_counter()

    def begin(self) -> int:
        """Return how much to do in the slice that begins now."""
        self._begin = time.perf_counter()
        return self.amount

    def done(self, amount: int) -> None:
        """Set the amount of the next slice from what was done in this one."""
        took = time.perf_counter() - self._begin
        share = GROWTH if took * GROWTH <= SLICE_SECONDS else SLICE_SECONDS / took
        self.amount = max(int(amount * share), 1)


def block_slices(count: int, length: int) -> Iterator[slice]:
    """Yield slices of ``length`` rows, the last one shorter, that cover ``count`` rows."""
    for start in range(0, count, length):
        yield slice(start, min(start + length, count))


def row_slices(count: int, first: int = 1 << 12) -> Iterator[slice]:
    """Yield slices that cover ``count`` rows; how long they are follows from how long the caller takes with each."""
    pace, start = Pace(first), 0
    while start < count:
        rows = slice(start, min(start + pace.begin(), count))
        yield rows
        pace.done(rows.stop - start)
        start = rows.stop


def sliced(loop: Callable[..., Any], count: int, first: int = 1 << 12) -> Callable[..., None]:
    """Return a loop over ``count`` rows that is run slice by slice: of arrays with so many rows, or flat ones of vectors, a part.

    What has another length is the same for all rows and is passed on whole.
    """
    if count <= first:
        return loop

    def run(*arguments: Any) -> None:
        widths = [
            {count: 1, 3 * count: 3}.get(len(x), 0) if isinstance(x, np.ndarray) and x.ndim else 0 for x in arguments
        ]
        for rows in row_slices(count, first):
            loop(
                *(
                    x[width * rows.start : width * rows.stop] if width else x
                    for x, width in zip(arguments, widths, strict=True)
                )
            )

    return run
