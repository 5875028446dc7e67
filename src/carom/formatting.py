"""Format numbers, lengths and times for people: three significant digits, and the unit that suits the size."""

from __future__ import annotations

import math

__all__ = ["format_length", "format_number", "format_time"]


def format_number(x: float | None, digits: int = 3) -> str:
    """Return ``digits`` significant digits without trailing zeros; a dash for None or NaN, the sign of infinity for infinity.

    >>> format_number(0.28571), format_number(2.0), format_number(1.5e-7), format_number(None)
    ('0.286', '2', '1.5e-07', '–')
    """
    if x is None or math.isnan(x):
        return "–"
    if math.isinf(x):
        return "∞" if x > 0 else "−∞"
    if x != 0 and not 1e-3 <= abs(x) < 1e4:
        return f"{x:.{digits - 1}g}"
    places = digits if x == 0 else max(0, digits - 1 - math.floor(math.log10(abs(x))))
    text = f"{x:.{places}f}"
    return text.rstrip("0").rstrip(".") if "." in text else text


def format_length(x: float, digits: int = 3) -> str:
    """Return a length given in m as text in m, mm or µm.

    >>> format_length(0.02625, 4), format_length(-2.0)
    ('26.25 mm', '-2 m')
    """
    for size, unit, factor in ((1.0, "m", 1.0), (1e-3, "mm", 1e3), (0.0, "µm", 1e6)):
        if abs(x) >= size:
            return f"{format_number(x * factor, digits)} {unit}"
    return "0 m"


def format_time(x: float) -> str:
    """Return a time given in s as text in s or ms.

    >>> format_time(0.25), format_time(12.0)
    ('250 ms', '12 s')
    """
    return f"{format_number(x)} s" if x >= 1 else f"{format_number(x * 1e3)} ms"
