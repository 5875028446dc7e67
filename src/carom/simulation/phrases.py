"""Words that the sentences of a run share: times, speeds, directions, enumerations."""

from __future__ import annotations

import math
from typing import Any

from carom.formatting import format_number

__all__ = ["at", "direction", "listed", "speed", "when"]


def at(row: Any) -> str:
    """Return when a row of the log was written."""
    return f"At {when(row['t'])}"


def when(t: Any) -> str:
    """Format a time; a late one with all digits before the point."""
    return f"{format_number(float(t))} s" if t < 1000 else f"{float(t):,.1f} s"


def speed(v: Any) -> float:
    """Return the length of a vector."""
    return math.sqrt(float((v * v).sum()))


def direction(v: Any) -> str:
    """Return the direction of a velocity: its angle from the x axis, seen from above, and how steep it is."""
    flat = math.hypot(float(v[0]), float(v[1]))
    if flat == 0:
        return ", straight up" if v[2] > 0 else ", straight down"
    degrees = round(math.degrees(math.atan2(float(v[1]), float(v[0])))) % 360  # (0 to 359, as in aim and of cues)
    words = f", {degrees}° from the x axis" if degrees else ", along the x axis"
    steep = math.degrees(math.atan2(float(v[2]), flat))
    return words + (f", {abs(steep):.0f}° {'upwards' if steep > 0 else 'downwards'}" if abs(steep) >= 0.5 else "")


def listed(parts: list[str]) -> str:
    """Return an enumeration with its last two parts joined by "and"."""
    return parts[0] if len(parts) == 1 else f"{', '.join(parts[:-1])} and {parts[-1]}"
