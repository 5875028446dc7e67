"""What the verbs share: a console that fits where it writes, ticks."""

from __future__ import annotations

import sys
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from rich.console import Console

__all__ = ["out", "tick"]


def out() -> Console:
    """Standard output for tables: colours only on a terminal, no character that it cannot write."""
    from rich.console import Console

    encoding = (sys.stdout.encoding or "utf-8").lower().replace("-", "")
    if not encoding.startswith("utf") and hasattr(sys.stdout, "reconfigure"):
        sys.stdout.reconfigure(errors="replace")
    return Console(highlight=False)


def tick(console: Console, good: bool) -> str:
    """A tick or a cross; words where the output has no such characters."""
    if console.encoding.startswith("utf"):
        return "✓" if good else "✗"
    return "yes" if good else "no"
