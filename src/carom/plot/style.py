"""Write figures; shared elements: style, size, line styles of the laws, arrows, labels that do not overlap.

Figures are written atomically and reproducibly: the same figure gives the same bytes.
"""

from __future__ import annotations

import io
import math
import os
import warnings
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Any

from carom import files
from carom.files import as_path, atomic_path, require_library
from carom.formatting import escape_controls

if TYPE_CHECKING:
    from matplotlib.figure import Figure

# Metadata of a file, by kind: without dates or other content that differs between runs.
METADATA: dict[str, dict[str, str | None]] = {
    "svg": {"Date": None},
    "pdf": {"CreationDate": None, "Creator": "carom", "Producer": None},
    "png": {"Software": None},
}


def require_matplotlib() -> None:
    """Raise CaromError if Matplotlib (the extra ``plot``) is not installed.

    Returns
    -------
    None

    Examples
    --------
    >>> from carom import plot
    >>> plot.require_matplotlib()
    """
    require_library("matplotlib", "plot")


def require_writable(path: str | os.PathLike[str]) -> None:
    """Raise CaromError if a figure cannot be written to a path.

    Parameters
    ----------
    path : str or path
        Name of a figure, .svg, .pdf or .png.

    Returns
    -------
    None

    Raises
    ------
    CaromError
        For another ending, a folder that does not exist, or missing permission.

    Examples
    --------
    >>> from carom import plot
    >>> plot.require_writable("figure.svg")
    """
    files.require_writable(as_path("plot", path), [f".{kind}" for kind in METADATA])


@contextmanager
def style() -> Iterator[None]:
    """Draw and write figures with carom's settings on Matplotlib's defaults, not the user's.

    A character that the font lacks is drawn as a box; Matplotlib's warning of it, once for each, says nothing that a user can mend.
    """
    require_matplotlib()
    import matplotlib.style

    look = matplotlib.style.context(["default", str(Path(__file__).with_name("carom.mplstyle"))])
    with warnings.catch_warnings(), look:
        warnings.filterwarnings("ignore", message="Glyph .* missing from")
        yield


def literal(text: object) -> str:
    r"""Return a name given by a user as Matplotlib is to draw it: as it stands.

    A dollar sign would begin a formula, a control character is none, and what begins with an underscore has no place in a legend.
    All names of balls, walls, species, tracks, shots, laws and dimensions, and all titles, come to a figure through here.

    >>> print(literal("$x$ \x1b[31m"))
    \$x\$ \x1b[31m
    """
    found = escape_controls(str(text).replace("\r\n", "\n")).replace("$", r"\$")
    return f" {found}" if found.startswith("_") else found


def drawn(draw: Callable[[], Figure], file: str | os.PathLike[str] | None) -> Figure:
    """Return the figure that ``draw`` makes, in carom's style; written if a file is named, which is checked first."""
    if file is not None:
        require_writable(file)
    with style():
        figure = draw()
    if file is not None:
        save(figure, file)
    return figure


def save(figure: Figure, path: str | os.PathLike[str]) -> None:
    """Write a figure as .svg, .pdf or .png; atomically, and the same figure gives the same bytes.

    Parameters
    ----------
    figure : Figure
        A Matplotlib figure, such as the functions of this package return.
    path : str or path
        The ending determines the format.

    Returns
    -------
    None

    Raises
    ------
    CaromError
        If the file cannot be written.

    Examples
    --------
    >>> import tempfile
    >>> from carom import plot
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     plot.save(plot.compare(angle_deg=30), f"{folder}/angle.svg")
    """
    require_writable(path)
    path = Path(path)
    kind = path.suffix.lower().removeprefix(".")
    with style(), atomic_path(path) as part:
        figure.savefig(part, format=kind, metadata=METADATA[kind])


INK, GREY, PALE = "#222222", "#8a8a8a", "#eceae4"
# Okabe & Ito's colours, distinct for colour-blind people.
COLOURS = ("#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9")


def new_figure(width: float, height: float) -> Figure:
    """Return an empty figure of a size in inches that notebooks display; to be called in the context of :func:`style`."""
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
    """Draw an arrow with a small filled head, from tail to head in data coordinates."""
    shape = "-|>,head_length=0.75,head_width=0.24"
    look = {"arrowstyle": shape, "color": colour, "lw": 1.0, "shrinkA": 0, "shrinkB": 0, "zorder": 6} | options
    axes.annotate("", xy=head, xytext=tail, arrowprops=look, annotation_clip=False, zorder=look["zorder"])


def spread_apart(wanted: Sequence[float], gap: float, low: float, high: float) -> list[float]:
    """Return positions near the wanted ones, in their order, at least ``gap`` apart and within [low, high] if they fit."""
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
