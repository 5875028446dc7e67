"""The laws of mechanics that a trajectory violates, in a strip each: when, and by how many error bars."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING, Any

import numpy as np

from carom.plot.style import GREY, INK, PALE, drawn, literal, new_figure
from carom.tracks.judgement import LAWS, SIGMAS

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from carom.tracks.judgement import Judgement

__all__ = ["plot_judgement"]

WIDTH, STRIP, TOP, BOTTOM = 6.2, 0.78, 0.08, 0.45  # inches: the figure, a law, and the room above and below all
MOST = 1000.0  # error bars: what is more is drawn as a triangle here
LEAST_SPAN = 1e-9  # s, of times


def plot_judgement(found: Judgement, file: str | os.PathLike[str] | None = None) -> Figure:
    """Draw what :func:`carom.tracks.judge` found: a strip per law that was checked, with a dot per violation, at its time and its
    number of error bars.

    Parameters
    ----------
    found : Judgement
    file : str or path, optional
        File to write, .svg, .pdf or .png.

    Returns
    -------
    matplotlib.figure.Figure
        Violations of more than 1000 error bars are triangles at the upper edge; of each law the balls of the clearest are named.

    Raises CaromError: a file that cannot be written, or Matplotlib is missing.

    Examples
    --------
    >>> import numpy as np
    >>> from carom import plot
    >>> from carom.tracks import judge
    >>> t = np.arange(60) / 200
    >>> falling = {"t": t, "x": t, "y": 0 * t, "z": 2.0 - 0.5 * 9.0 * t**2}  # g = 9.0 m/s^2
    >>> figure = plot.plot_judgement(judge(falling, radius=0.03))
    >>> [axes.get_title(loc="right") for axes in figure.axes]  # penetration, gravity
    ['0 of 1', '1 of 1']
    """
    return drawn(lambda: _figure(found), file)


def _figure(found: Judgement) -> Figure:
    laws = [law for law, checks in found.checked.items() if checks]  # (penetration always is)
    height = STRIP * len(laws) + TOP + BOTTOM
    figure = new_figure(WIDTH, height)
    strips = figure.subplots(len(laws), 1, sharex=True, sharey=True, squeeze=False)[:, 0]
    figure.subplots_adjust(left=0.1, right=0.98, top=1 - (TOP + 0.2) / height, bottom=BOTTOM / height, hspace=0.65)
    for axes, law in zip(strips, laws, strict=True):
        axes.set_title(f"{law}: {LAWS[law]}", loc="left", fontsize=8, color=INK, pad=3)
        violated = len(found.of(law))
        said = f"{violated:,} of {found.checked[law]:,}"
        axes.set_title(said, loc="right", fontsize=8, color=INK if violated else GREY, pad=3)
        axes.axhspan(1, SIGMAS, color=PALE, lw=0, zorder=0)  # (what could be noise)
        _dots(axes, found, law)
    first, last = found.times
    room = 0.02 * max(last - first, LEAST_SPAN)
    strips[0].set(yscale="log", ylim=(2, 1.5 * MOST), xlim=(first - room, last + room))
    strips[0].set_yticks([10, 100, MOST], ["10", "100", "1000"])
    strips[0].yaxis.minorticks_off()
    strips[-1].set_xlabel("time, s")
    figure.supylabel("error bars", fontsize=9, x=0.005, color=INK)
    if others := ", ".join(law for law in LAWS if law not in laws):
        figure.text(0.98, 0.02, f"not checked: {others}", fontsize=8, color=GREY, ha="right")
    return figure


def _dots(axes: Any, found: Judgement, law: str) -> None:
    violations = found.of(law)
    times, sigmas = np.array([(one.time, one.sigmas) for one in violations]).reshape(-1, 2).T
    far = sigmas > MOST
    for some, marker in ((~far, "o"), (far, "^")):
        axes.plot(
            times[some], np.minimum(sigmas[some], MOST), marker, ms=4, mfc=INK, mec="white", mew=0.4, clip_on=False
        )
    worst = found.worst(law)
    if worst is not None:
        late = worst.time > sum(found.times) / 2
        axes.annotate(
            literal(" and ".join(worst.balls)), (worst.time, min(worst.sigmas, MOST)), xytext=(3 if late else -3, -5),
            textcoords="offset points", ha="right" if late else "left", va="top", fontsize=8, color=INK,
        )  # fmt: skip
