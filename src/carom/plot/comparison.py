"""A comparison drawn: incidence and reflection under each law, seen from above and from the side."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from numpy.typing import NDArray

from carom import comparison as asked
from carom.law import Meeting
from carom.plot.drawing import GREY, INK, PALE, arrow, inks, sheet, spread
from carom.plot.path import Path, path_after_wall
from carom.plot.save import style
from carom.units import length, number

__all__ = ["compare"]

TALL = 0.72  # half the height of the view from above, over its width

Array = NDArray[np.float64]


def compare(comparison: asked.Comparison | Meeting | None = None, **settings: Any) -> Any:
    """Draw what each law says of one ball, to scale: from above, and from the side.

    Parameters
    ----------
    comparison : Comparison or Meeting, optional
        What :func:`carom.compare` or :func:`carom.incoming` gives; left out, made from ``settings``.
    settings
        As :func:`carom.incoming` takes them: ``carom.plot.compare(angle=30, friction=0.2)``.

    Returns
    -------
    matplotlib.figure.Figure, which a notebook shows and :func:`carom.plot.save` writes. Laws that refuse are left out and
    said so; so is a ball that never rolls. Raises CaromError for bad settings, or where Matplotlib is missing.
    """
    if not isinstance(comparison, asked.Comparison):
        comparison = asked.compare(comparison if comparison is not None else asked.incoming(**settings))
    m = comparison.meeting
    shown = [v for v in comparison.verdicts if v.answer is not None and v.after_wall is not None]
    paths = {v.law: path_after_wall(m, v.answer) for v in shown if v.answer is not None}
    a = float(m.ball.radius)
    reach = _reach(a, list(paths.values()))
    with style():
        return _draw(comparison, shown, paths, reach)


def _reach(a: float, paths: list[Path]) -> float:
    """How far from the wall, in m, the picture goes: past where the balls roll, within 6 to 30 radii."""
    far = max((float(np.abs(path.points[:, :2]).max()) for path in paths), default=0.0)
    return min(max(6.5 * a, 1.35 * far), 30 * a)


def _draw(comparison: asked.Comparison, shown: list[asked.Verdict], paths: dict[str, Path], reach: float) -> Any:
    m = comparison.meeting
    a = float(m.ball.radius) * 1e3
    r = reach * 1e3
    up = max(3.2 * a, 1.25 * max((float(p.points[:, 2].max()) * 1e3 for p in paths.values()), default=0.0) + 2.2 * a)
    up = min(up, 0.8 * r)
    width, left, right = 6.4, 0.55, 1.45
    scale = (width - left - right) / (1.12 * r)  # inches per mm, the same in both views
    heights = (2 * TALL * r * scale, (up + 0.12 * r) * scale)
    total = sum(heights) + 0.2 + 0.45 + 0.3
    figure = sheet(width, total)
    boxes = [
        (left / width, (total - 0.3 - heights[0]) / total, 1.12 * r * scale / width, heights[0] / total),
        (left / width, 0.45 / total, 1.12 * r * scale / width, heights[1] / total),
    ]
    above, side = (figure.add_axes(box) for box in boxes)
    looks = inks([v.law for v in comparison.verdicts])
    _above(above, comparison, shown, paths, looks, a, r)
    _side(side, comparison, shown, paths, looks, a, r, up)
    _notes(figure, comparison, left / width)
    return figure


def _notes(figure: Any, comparison: asked.Comparison, x: float) -> None:
    m = comparison.meeting
    figure.text(
        x, 0.995,
        f"In at {comparison.incident_angle:.1f}°, {number(float(np.hypot(*m.state.velocity[:2])))} m/s;"
        f" wall $e$ = {number(m.wall.restitution)}, $\\mu$ = {number(m.wall.friction)};"
        f" floor $e$ = {number(m.floor.restitution)}, $\\mu$ = {number(m.floor.friction)};"
        f" ball of radius {length(float(m.ball.radius), 4)}",
        ha="left", va="top", size=8, color=INK,
    )  # fmt: skip
    missing = [v.law for v in comparison.verdicts if v.after_wall is None]
    if missing:
        below = 0.45 / figure.get_figheight()
        words = "no answer:\n" + "\n".join(missing)
        figure.text(0.78, below, words, ha="left", va="bottom", size=8, color=GREY, linespacing=1.4)


def _above(
    axes: Any, comparison: asked.Comparison, shown: list[asked.Verdict], paths: dict[str, Path],
    looks: dict[str, tuple[str, Any]], a: float, r: float,
) -> None:  # fmt: skip
    m = comparison.meeting
    _frame(axes, (-0.12 * r, r), (-TALL * r, TALL * r))
    axes.fill_betweenx([-TALL * r, TALL * r], -0.12 * r, 0, color=PALE, lw=0, zorder=0)
    axes.axvline(0, color=INK, lw=1.2, zorder=3)
    # the wall touches the ball at -a n: for a cushion's nose the centre is nearer than a
    start = np.array([a * float(m.normal[0]), 0.0])
    axes.axhline(0, color=GREY, lw=0.6, ls=(0, (4, 3)), zorder=1)
    v = np.asarray(m.state.velocity)[:2]
    into = v / float(np.hypot(*v)) if np.any(v) else np.array([-1.0, 0.0])
    tail = _leave(start, -into, r)
    axes.plot(*np.stack([tail, start]).T, color=INK, lw=1.6, zorder=4)
    _heads(axes, tail, start, INK)
    _circle(axes, start, a, INK, 1.0, face="white")
    axes.plot(*start, "o", ms=2.6, color=INK, zorder=8)
    ends, words = [], []
    for verdict in shown:
        ink, dashes = looks[verdict.law]
        line, curved = _line_above(paths[verdict.law], verdict, start, r)
        axes.plot(
            *line.T, color=ink, ls=dashes, lw=1.8 if verdict.admissible else 1.3, zorder=5 if verdict.admissible else 4
        )
        if curved is not None:
            for point in curved[1:]:
                _circle(axes, point, a, ink, 0.7)
                axes.plot(*point, "o", ms=2.6, color=ink, zorder=7)
        ends.append(line[-1])
        words.append(f"{verdict.law}  {_angle(verdict)}")
    _labels(axes, ends, words, [looks[v.law][0] for v in shown], r)
    axes.set_ylabel("along the wall, mm")
    axes.set_xticklabels([])
    axes.text(0.02 * r, -0.98 * TALL * r, "from above", ha="left", va="bottom", style="italic", color=GREY, size=9)
    axes.text(-0.06 * r, 0.5 * TALL * r, "wall", rotation=90, ha="center", va="center", color=GREY, size=8)


def _angle(verdict: asked.Verdict) -> str:
    if verdict.final is None:
        return "never rolls"
    return "stops" if verdict.reflection_angle is None else f"{verdict.reflection_angle:.1f}°"


def _line_above(path: Path, verdict: asked.Verdict, start: Array, r: float) -> tuple[Array, Array | None]:
    """The path's points within the picture, and the ends of its pieces (None where it has none)."""
    points = start + path.points[:, :2] * 1e3
    marks = None
    if path.pieces:
        marks = np.array([start, *(start + p[-1, :2] * 1e3 for _name, p in path.pieces)])
        keep = np.array([True, *(np.hypot(*(b - c)) > 0.02 * r for b, c in zip(marks[1:], marks[:-1], strict=True))])
        marks = marks[keep][:4]
    velocity = np.array(path.velocity[:2])
    # a ball that never rolls goes on too, unless it comes back to the wall
    if np.hypot(*velocity) > 0 and (verdict.final is not None or velocity[0] > 0):
        points = np.concatenate([points, [_leave(points[-1], velocity / np.hypot(*velocity), r)]])
    inside = (np.abs(points[:, 1]) <= 1.0001 * TALL * r) & (points[:, 0] <= 1.0001 * r)
    last = len(points) if inside.all() else max(int(np.argmin(inside)), 1)
    return points[:last], marks


def _leave(point: Array, direction: Array, r: float) -> Array:
    """Where a ray from a point within the picture leaves it."""
    t = []
    if direction[0] > 0:
        t.append((r - point[0]) / direction[0])
    elif direction[0] < 0:
        t.append(-point[0] / direction[0])
    if direction[1] != 0:
        t.append((math.copysign(TALL * r, direction[1]) - point[1]) / direction[1])
    return np.asarray(point + direction * max(min(t), 0.0))


def _labels(axes: Any, ends: list[Array], words: list[str], colours: list[str], r: float) -> None:
    """Each law's name at the right edge, level with its path's end, joined to it by a hair line."""
    # those that leave through the top or the bottom follow those at the right edge, the farther the nearer to the wall
    order = [float(end[1]) + math.copysign(max(r - float(end[0]), 0.0), float(end[1])) for end in ends]
    places = spread(order, 0.09 * r, 0.03 * r - TALL * r, TALL * r - 0.03 * r)
    for end, place, word, colour in zip(ends, places, words, colours, strict=True):
        axes.plot([end[0], 1.045 * r], [end[1], place], color=colour, lw=0.5, clip_on=False, zorder=2)
        axes.text(1.06 * r, place, word, color=colour, ha="left", va="center", size=9, clip_on=False)


def _side(
    axes: Any, comparison: asked.Comparison, shown: list[asked.Verdict], paths: dict[str, Path],
    looks: dict[str, tuple[str, Any]], a: float, r: float, up: float,
) -> None:  # fmt: skip
    m = comparison.meeting
    _frame(axes, (-0.12 * r, r), (-0.12 * r, up))
    axes.fill_between([-0.12 * r, r], -0.12 * r, 0, color=PALE, lw=0, zorder=0)
    axes.plot([-0.12 * r, r], [0, 0], color=INK, lw=1.2, zorder=3)
    start = np.array([a * float(m.normal[0]), a + float(m.height) * 1e3])
    nose = a + float(m.height) * 1e3 - a * float(m.normal[2])
    if m.normal[2] == 0:
        axes.fill_betweenx([0, up], -0.12 * r, 0, color=PALE, lw=0, zorder=0)
        axes.plot([0, 0], [0, up], color=INK, lw=1.2, zorder=3)
    else:  # a cushion: all that is known of it is where its nose touches
        corners = [(-0.12 * r, min(nose + 0.5 * a, up)), (0, nose), (-0.12 * r, max(nose - 0.8 * a, 0))]
        axes.fill(*zip(*corners, strict=True), color="#d9d5ca", ec=INK, lw=0.8, zorder=2)
    _circle(axes, start, a, INK, 1.0, face="white")
    axes.plot(*start, "o", ms=2.6, color=INK, zorder=8)
    hops = []
    for verdict in shown:
        ink, dashes = looks[verdict.law]
        path = paths[verdict.law]
        points = np.array([start[0], a]) + path.points[:, [0, 2]] * 1e3
        if verdict.final is not None and path.velocity[0] > 0:
            points = np.concatenate([points, [[r, points[-1, 1]]]])
        points = points[points[:, 0] <= 1.0001 * r]
        strong = verdict.admissible
        axes.plot(*points.T, color=ink, ls=dashes, lw=1.8 if strong else 1.3, zorder=6 if strong else 5)
        flights = [p for name, p in path.pieces if name == "flight"]
        if flights:
            end = np.array([start[0] + flights[0][-1, 0] * 1e3, a])
            top = float(flights[0][:, 2].max()) * 1e3
            if end[0] <= r:
                _circle(axes, end, a, ink, 0.7)
                axes.plot([end[0], end[0]], [-0.03 * r, 0], color=ink, lw=1.2, zorder=4)
            hops.append((ink, f"{verdict.law}  {number(top)} mm"))
    for i, (ink, word) in enumerate([(GREY, "hops as high as"), *hops] if hops else []):
        axes.text(1.06 * r, up - (0.03 + 0.075 * i) * r, word, color=ink, ha="left", va="center", size=8, clip_on=False)
    axes.text(0.5 * r, -0.06 * r, "floor", ha="center", va="center", size=8, color=GREY)
    axes.set_xlabel("from the wall, mm")
    axes.set_ylabel("height, mm")
    axes.text(r, up * 0.98, "from the side", ha="right", va="top", style="italic", color=GREY, size=9)


def _frame(axes: Any, x: tuple[float, float], y: tuple[float, float]) -> None:
    axes.set_xlim(*x)
    axes.set_ylim(*y)
    axes.spines["bottom"].set_visible(False)
    axes.spines["left"].set_visible(False)


def _circle(axes: Any, centre: Array, a: float, colour: str, width: float, face: str = "none") -> None:
    from matplotlib.patches import Circle

    axes.add_patch(Circle((float(centre[0]), float(centre[1])), a, ec=colour, fc=face, lw=width, zorder=3.5))


def _heads(axes: Any, tail: Array, head: Array, colour: str) -> None:
    """An arrowhead two fifths along a straight path."""
    a, b = tail + 0.38 * (head - tail), tail + 0.42 * (head - tail)
    arrow(axes, (float(a[0]), float(a[1])), (float(b[0]), float(b[1])), colour)
