"""The consoles of standard output and standard error: what they print is text, and no name in it steers the terminal."""

from __future__ import annotations

import sys
from collections.abc import Iterable
from typing import Any

from rich.console import Console
from rich.segment import Segment

from carom.formatting import escape_controls

__all__ = ["TextConsole", "err", "out"]


class TextConsole(Console):
    """Rich's console for text that others wrote: control characters are escaped, and square brackets are no markup."""

    def __init__(self, **settings: Any) -> None:
        super().__init__(highlight=False, markup=False, emoji=False, **settings)

    def render(self, *args: Any, **options: Any) -> Iterable[Segment]:
        """Yield the pieces of what is printed, with all that is not Rich's own escaped."""
        for piece in super().render(*args, **options):
            if piece.control or piece.text == "\r":  # (a line that is written anew)
                yield piece
            else:
                yield piece._replace(text=escape_controls(piece.text))


def out() -> TextConsole:
    """Return the console of standard output: colours only on a terminal, no character that it cannot write."""
    encoding = (sys.stdout.encoding or "utf-8").lower().replace("-", "")
    if not encoding.startswith("utf") and hasattr(sys.stdout, "reconfigure"):
        sys.stdout.reconfigure(errors="replace")
    return TextConsole()


def err() -> TextConsole:
    """Return the console of standard error, for notes and progress."""
    return TextConsole(stderr=True)
