"""The figure of whole tracks: the shares over time where there are many tracks; the distances; panels for every shape of table."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

pytest.importorskip("matplotlib")

from carom.plot.fit import WIDTH, plot_tracks


def ranking(tracks: int, size: tuple[float, float]) -> Any:
    """A ranking of one law with tracks along the diagonal, of which only what is drawn is there."""
    time = np.linspace(0.0, 1.0, 100)
    place = np.linspace((0.0, 0.0), size, 100)
    rng = np.random.default_rng(1)
    segments = [
        SimpleNamespace(group=f"shot_{n}", name="a", position=place, time=time, contacts=[0.5], walls=["top"])
        for n in range(tracks)
    ]
    fit: Any = SimpleNamespace(
        frames=SimpleNamespace(
            segments=segments, count=np.full(tracks, 100), groups=[[n] for n in range(tracks)]
        ),
        gap=1e-3 * rng.normal(size=(tracks, 100, 2)),
        model=SimpleNamespace(held={"wall_left": 0.0, "wall_bottom": 0.0}),
        numbers={},
        law=SimpleNamespace(name="two-step"),
        noise=1e-3,
        rms=lambda which: 1e-3 * (1 + which[0]),
        simulate=lambda _n: SimpleNamespace(end=1.0, at=lambda t: SimpleNamespace(position=np.zeros((len(t), 1, 3)))),
    )  # fmt: skip
    return SimpleNamespace(best=fit, fits=[fit])


@pytest.mark.parametrize(("tracks", "lines", "bands"), [(4, 4, 0), (30, 0, 2)])
def test_of_many_tracks_the_shares_are_drawn(tracks: int, lines: int, bands: int) -> None:
    axes = plot_tracks(ranking(tracks, (2.8, 1.4))).axes[-1]
    thin = [line for line in axes.lines if line.get_alpha() == 0.5]
    assert (len(thin), len(axes.collections)) == (lines, bands)
    (median,) = [line for line in axes.lines if line.get_label() == "median"]
    assert 0.5 < np.median(median.get_ydata()) < 2.0  # mm, as the distances were drawn


def test_distances_are_drawn_against_what_was_varied() -> None:
    (axes,) = [one for one in plot_tracks(ranking(30, (2.8, 1.4))).axes if one.get_ylabel() == "RMS, mm"]
    assert axes.get_xlabel() == "segment"  # (all have one incidence and speed)
    assert axes.lines[0].get_ydata() == pytest.approx(1.0 + np.arange(30))


@pytest.mark.parametrize("size", [(2.8, 1.4), (1.4, 2.8), (1.0, 1.0)])
def test_panels_are_wide_enough_and_do_not_overlap(size: tuple[float, float]) -> None:
    figure = plot_tracks(ranking(30, size))
    figure.draw_without_rendering()
    shown = [axes for axes in figure.axes if axes.get_title().startswith("shot")]
    assert [axes.get_title() for axes in shown] == [f"shot_{n}: {n + 1} mm" for n in (29, 28, 27, 26)]  # the farthest
    boxes = [axes.get_window_extent() for axes in figure.axes]
    assert all(not a.overlaps(b) for k, a in enumerate(boxes) for b in boxes[:k])
    assert figure.get_figwidth() == WIDTH
    assert min(axes.get_window_extent().width for axes in shown) > 0.2 * WIDTH * figure.dpi
