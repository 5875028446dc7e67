"""Numbers as people read them: three digits, with the unit that suits the size."""

from __future__ import annotations

import math

__all__ = ["length", "number", "of_time", "share"]


def number(x: float | None, digits: int = 3) -> str:
    """Three significant digits and no trailing noise; a dash for none, the sign of infinity for infinity."""
    if x is None or math.isnan(x):
        return "–"
    if math.isinf(x):
        return "∞" if x > 0 else "−∞"
    if x != 0 and not 1e-3 <= abs(x) < 1e4:
        return f"{x:.{digits - 1}g}"
    places = digits if x == 0 else max(0, digits - 1 - math.floor(math.log10(abs(x))))
    text = f"{x:.{places}f}"
    return text.rstrip("0").rstrip(".") if "." in text else text


def share(x: float) -> str:
    """A coefficient, as 0.286."""
    return number(x)


def length(x: float, digits: int = 3) -> str:
    """A length in m, mm or µm."""
    for size, unit, factor in ((1.0, "m", 1.0), (1e-3, "mm", 1e3), (0.0, "µm", 1e6)):
        if abs(x) >= size:
            return f"{number(x * factor, digits)} {unit}"
    return "0 m"


def of_time(x: float) -> str:
    """A time in s or ms."""
    return f"{number(x)} s" if x >= 1 else f"{number(x * 1e3)} ms"
