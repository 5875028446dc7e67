"""The plan of a sweep: its points, blocks, bytes, and how long it will take."""

from __future__ import annotations

from typing import Any

__all__ = ["SweepPlan"]


class SweepPlan:
    """Plan of a sweep: :meth:`Sweep.explain`."""

    def __init__(self, text: str, **numbers: Any) -> None:
        self.text = text
        self.points: int = numbers["points"]
        self.blocks: int = numbers["blocks"]
        self.blocks_done: int = numbers["blocks_done"]
        self.bytes: int = numbers["bytes"]
        self.seconds: float = numbers["seconds"]
        """Time for the blocks that are not done, on this machine's cores."""

    def __repr__(self) -> str:
        """Return the table as text."""
        return self.text
