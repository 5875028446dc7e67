"""A law's card: what it assumes, when it is valid, where it comes from. `carom laws`, the docs and citations read it."""

from __future__ import annotations

from dataclasses import dataclass

__all__ = ["Card"]


@dataclass(frozen=True)
class Card:
    """What a law says of itself."""

    name: str
    summary: str
    """One sentence."""
    assumptions: tuple[str, ...]
    valid: str
    """When to use it, and when not."""
    equations: str
    """Where in its source, e.g. "paper (27)-(39)"."""
    citation: str
    doi: str = ""
