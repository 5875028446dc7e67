"""What all pictures share: sheets, inks, arrows, labels that keep out of each other's way."""

from __future__ import annotations

import io
import math
from collections.abc import Sequence
from typing import Any

from carom.plot.save import style

__all__ = ["GREY", "INK", "PALE", "arrow", "inks", "sheet", "spread"]

INK, GREY, PALE = "#222222", "#8a8a8a", "#eceae4"

# Okabe & Ito's colours, which colour-blind people tell apart, each with its own dashes, for print without colour.
INKS: dict[str, tuple[str, Any]] = {
    "mirror": ("#8a8a8a", (0, (1, 1.6))),
    "conventional": ("#D55E00", (0, (6, 2))),
    "no-slip": ("#009E73", (0, (4, 1.5, 1, 1.5))),
    "two-step": ("#0072B2", "solid"),
    "contact": ("#56B4E9", (0, (2.5, 1.5))),
    "maw": ("#CC79A7", (0, (5, 1.5, 1, 1.5, 1, 1.5))),
    "stronge": ("#E69F00", (0, (8, 2, 2, 2))),
}
MORE = ("#B8A600", "#000000", "#7A4FB5", "#A0522D")


def inks(laws: Sequence[str]) -> dict[str, tuple[str, Any]]:
    """Colour and dashes of each law; laws that carom does not know get those that are left, in order."""
    found, new = {}, 0
    for law in laws:
        if law in INKS:
            found[law] = INKS[law]
        else:
            found[law] = (MORE[new % len(MORE)], (0, (3 + new, 1.5)))
            new += 1
    return found


def sheet(width: float, height: float) -> Any:
    """An empty Figure, inches; call inside :func:`carom.plot.save.style`. Notebooks show it."""
    from matplotlib.figure import Figure

    figure = Figure(figsize=(width, height))
    setattr(figure, "_repr_png_", lambda: _png(figure))  # noqa: B010
    return figure


def _png(figure: Any) -> bytes:
    buffer = io.BytesIO()
    with style():
        figure.savefig(buffer, format="png", metadata={"Software": None}, dpi=150)
    return buffer.getvalue()


def arrow(axes: Any, tail: tuple[float, float], head: tuple[float, float], colour: str = INK, **options: Any) -> None:
    """An arrow with a small filled head, from tail to head in data coordinates."""
    look = {
        "arrowstyle": "-|>,head_length=0.75,head_width=0.24",
        "color": colour,
        "lw": 1.0,
        "shrinkA": 0,
        "shrinkB": 0,
    }
    axes.annotate(
        "", xy=head, xytext=tail, arrowprops=look | options, annotation_clip=False, zorder=options.get("zorder", 6)
    )


def spread(wanted: Sequence[float], gap: float, low: float, high: float) -> list[float]:
    """Places near the wanted ones, in their order, at least ``gap`` apart and within [low, high] as far as they fit."""
    order = sorted(range(len(wanted)), key=lambda i: wanted[i])
    gap = min(gap, (high - low) / max(len(wanted) - 1, 1))
    placed = [0.0] * len(wanted)
    floor = -math.inf
    for i in order:
        placed[i] = floor = max(wanted[i], floor + gap, low)
    ceiling = high + gap
    for i in reversed(order):
        placed[i] = ceiling = min(placed[i], ceiling - gap)
    return placed
