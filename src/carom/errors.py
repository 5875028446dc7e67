"""What carom raises when it cannot answer: one class, one clear line, or one line a fault."""

from __future__ import annotations

__all__ = ["CaromError"]


class CaromError(ValueError):
    """Input that has no answer: where, what was expected, what came, what to do.

    ``faults`` holds one line a fault, so that a file with three faults is told all three at once; the command line
    prints them on standard error and ends with exit code 2.
    """

    def __init__(self, *faults: str) -> None:
        super().__init__("\n".join(faults))
        self.faults: tuple[str, ...] = faults
