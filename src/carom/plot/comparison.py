"""Draw a comparison of laws: incidence and reflection under each, seen from above, and its hops from the side.

:func:`path_after_wall` follows the ball from the wall until it rolls: flights, bounces and sliding, each as points of a curve.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from carom.core.jit.kernel import Vec
from carom.core.motion.phases import BOUNCING, FLIGHT, SLIDING
from carom.formatting import format_length, format_number
from carom.laws import comparison as laws_compared
from carom.laws.law import Answer, Meeting
from carom.laws.registry import law_styles
from carom.plot.style import GREY, INK, PALE, arrow, literal, new_figure, spread_apart, style
from carom.scene.scene import Scene
from carom.simulation.simulate import simulate

if TYPE_CHECKING:
    from matplotlib.figure import Figure

HALF_HEIGHT_OVER_WIDTH = 0.72  # of the view from above
LOW = 0.4  # of it below the normal to the wall, where no law turns the ball back
HOPS = 2.3  # width of the view of hops, inches
FLAG = 0.19  # height of a line of labels above or below that view, inches

Array = NDArray[np.float64]


def compare(comparison: laws_compared.Comparison | Meeting | None = None, **settings: Any) -> Figure:
    """Draw each law's prediction for one ball: from above, to scale, and its hops from the side, if there are any.

    Parameters
    ----------
    comparison : Comparison or Meeting, optional
        Result of :func:`carom.compare` or :func:`carom.incoming`; by default made from ``settings``.
    settings
        Arguments of :func:`carom.incoming`.

    Returns
    -------
    matplotlib.figure.Figure
        A notebook shows it, and :func:`carom.plot.save` writes it. Laws without a prediction are listed in the figure.

    Raises
    ------
    CaromError
        For bad settings, or if Matplotlib is not installed.

    Examples
    --------
    >>> from carom import plot
    >>> figure = plot.compare(angle_deg=30, friction=0.2)
    >>> [axes.get_ylabel() for axes in figure.axes]
    ['along the wall, mm', 'above the floor, mm']
    """
    if not isinstance(comparison, laws_compared.Comparison):
        comparison = laws_compared.compare(comparison if comparison is not None else laws_compared.incoming(**settings))
    shown = [v for v in comparison.verdicts if v.answer is not None and v.after_wall is not None]
    paths = {v.law: path_after_wall(comparison.meeting, v.answer) for v in shown if v.answer is not None}
    # the figure reaches beyond where the balls roll, 6.5 to 30 radii from the wall
    a = float(comparison.meeting.ball.radius)
    far = max((float(np.abs(path.points[:, :2]).max()) for path in paths.values()), default=0.0)
    with style():
        return _draw(comparison, shown, paths, min(max(6.5 * a, 1.35 * far), 30 * a))


def _draw(
    comparison: laws_compared.Comparison,
    shown: list[laws_compared.Verdict],
    paths: dict[str, PathAfterWall],
    reach: float,
) -> Figure:
    m = comparison.meeting
    a, r = float(m.ball.radius) * 1e3, reach * 1e3
    wide, left, labels = 4.3, 0.55, 1.7  # inches
    scale = wide / (1.12 * r)  # inches per mm
    start = np.array([a * float(m.normal[0]), 0.0])
    lines = [_line_above(paths[v.law], v, start, r) for v in shown]
    # below the normal there is only the ball that comes, unless a law turns it back
    lowest = min((float(line[:, 1].min()) for line, _marks in lines), default=0.0)
    low = HALF_HEIGHT_OVER_WIDTH if lowest < -0.9 * LOW * r else LOW
    # room above and below the view for the labels of paths that leave it there
    over, under = (sum(_edge(line[-1], r) == side for line, _marks in lines) * FLAG for side in (1, -1))
    tall, top, bottom = (HALF_HEIGHT_OVER_WIDTH + low) * r * scale, 0.3 + over, under + 0.45
    hops = [(v, paths[v.law]) for v in shown if any(name == "flight" for name, _points in paths[v.law].pieces)]
    width, total = left + wide + labels + (0.5 + HOPS if hops else 0.0), tall + top + bottom
    figure = new_figure(width, total)
    above = figure.add_axes((left / width, bottom / total, wide / width, tall / total))
    styles = law_styles([v.law for v in comparison.verdicts])
    _above(above, comparison, shown, lines, styles, a, r, FLAG / scale, low)
    if hops:
        place = ((width - HOPS - 0.1) / width, bottom / total, HOPS / width, 0.8 * tall / total)
        _hops(figure.add_axes(place), hops, styles, float(start[0]))
    _notes(figure, comparison, left / width)
    return figure


def _notes(figure: Any, comparison: laws_compared.Comparison, x: float) -> None:
    m = comparison.meeting
    figure.text(
        x, 0.995,
        f"Incidence at {comparison.incident_angle_deg:.1f}°, {format_number(float(np.hypot(*m.state.velocity[:2])))} m/s;"
        f" wall $e$ = {format_number(m.wall.restitution)}, $\\mu$ = {format_number(m.wall.friction)};"
        f" floor $e$ = {format_number(m.floor.restitution)}, $\\mu$ = {format_number(m.floor.friction)};"
        f" ball of radius {format_length(float(m.ball.radius), 4)}",
        ha="left", va="top", size=8, color=INK,
    )  # fmt: skip


def _above(
    axes: Any, comparison: laws_compared.Comparison, shown: list[laws_compared.Verdict],
    lines: list[tuple[Array, Array | None]], styles: dict[str, tuple[str, Any]], a: float, r: float, flag: float, low: float,
) -> None:  # fmt: skip
    m = comparison.meeting
    axes.set(xlim=(-0.12 * r, r), ylim=(-low * r, HALF_HEIGHT_OVER_WIDTH * r))
    axes.spines[["bottom", "left"]].set_visible(False)
    axes.fill_betweenx(
        [-HALF_HEIGHT_OVER_WIDTH * r, HALF_HEIGHT_OVER_WIDTH * r], -0.12 * r, 0, color=PALE, lw=0, zorder=0
    )
    axes.axvline(0, color=INK, lw=1.2, zorder=3)
    # the wall touches the ball at -a n: for a cushion's nose the centre is nearer than a
    start = np.array([a * float(m.normal[0]), 0.0])
    axes.axhline(0, color=GREY, lw=0.6, ls=(0, (4, 3)), zorder=1)
    v = np.asarray(m.state.velocity)[:2]
    into = v / float(np.hypot(*v)) if np.any(v) else np.array([-1.0, 0.0])
    tail = _leave(start, -into, r)
    tail = start + (tail - start) * min(1.0, low * r / -tail[1] if tail[1] < 0 else 1.0)  # (from the lower edge)
    axes.plot(*np.stack([tail, start]).T, color=INK, lw=1.6, zorder=4)
    _heads(axes, tail, start, INK)
    _circle(axes, start, a, INK, 1.0, face="white")
    axes.plot(*start, "o", ms=2.6, color=INK, zorder=8)
    # head on and without sidespin no law turns the ball: what differs is how fast it comes back
    straight = all(np.abs(line[:, 1]).max() < 1e-6 * r for line, _marks in lines)
    ends, words = [], []
    for verdict, (line, curved) in zip(shown, lines, strict=True):
        ink, dashes = styles[verdict.law]
        axes.plot(
            *line.T, color=ink, ls=dashes, lw=1.8 if verdict.admissible else 1.3, zorder=5 if verdict.admissible else 4
        )
        if curved is not None:
            for point in curved[1:]:
                _circle(axes, point, a, ink, 0.7)
                axes.plot(*point, "o", ms=2.6, color=ink, zorder=7)
        ends.append(line[-1])
        mark = "✓" if verdict.admissible else "×"
        words.append(f"{literal(verdict.law)}  {_speed(verdict) if straight else _angle(verdict)}  {mark}")
    bottom = -low * r
    missing = [v.law for v in comparison.verdicts if v.after_wall is None]
    if missing:  # below the labels
        text = "no prediction:\n" + "\n".join(map(literal, missing))
        axes.text(
            1.06 * r, 0.98 * bottom, text, ha="left", va="bottom", size=8, color=GREY, linespacing=1.4, clip_on=False
        )
        bottom += 0.06 * r * (len(missing) + 1)
    _labels(axes, ends, words, [styles[v.law][0] for v in shown], r, bottom, flag)
    axes.set(xlabel="from the wall, mm", ylabel="along the wall, mm")
    said = "from above: no law turns the ball; final speeds" if straight and lines else "from above"
    axes.text(0.02 * r, -0.98 * low * r, said, ha="left", va="bottom", style="italic", color=GREY, size=9)
    axes.text(
        -0.06 * r, 0.5 * HALF_HEIGHT_OVER_WIDTH * r, "wall", rotation=90, ha="center", va="center", color=GREY, size=8
    )


def _angle(verdict: laws_compared.Verdict) -> str:
    if verdict.final is None:
        return "never rolls"
    return "stops" if verdict.reflection_angle_deg is None else f"{verdict.reflection_angle_deg:.1f}°"


def _speed(verdict: laws_compared.Verdict) -> str:
    if verdict.final is None or verdict.reflection_angle_deg is None:
        return _angle(verdict)
    return f"{format_number(float(np.hypot(*verdict.final.velocity[:2])))} m/s"


def _line_above(
    path: PathAfterWall, verdict: laws_compared.Verdict, start: Array, r: float
) -> tuple[Array, Array | None]:
    """Return the path's points within the figure, and the ends of its pieces (None if it has none)."""
    points = start + path.points[:, :2] * 1e3
    marks = None
    if path.pieces:
        marks = np.array([start, *(start + p[-1, :2] * 1e3 for _name, p in path.pieces)])
        keep = np.array([True, *(np.hypot(*(b - c)) > 0.02 * r for b, c in zip(marks[1:], marks[:-1], strict=True))])
        marks = marks[keep][:4]
    velocity = np.array(path.velocity[:2])
    # the path of a ball that never rolls is continued too, unless it returns to the wall
    if np.hypot(*velocity) > 0 and (verdict.final is not None or velocity[0] > 0):
        points = np.concatenate([points, [_leave(points[-1], velocity / np.hypot(*velocity), r)]])
    inside = (np.abs(points[:, 1]) <= 1.0001 * HALF_HEIGHT_OVER_WIDTH * r) & (points[:, 0] <= 1.0001 * r)
    if inside.all():
        return points, marks
    last = max(int(np.argmin(inside)), 1)
    beyond = points[last] - points[last - 1]
    edge = _leave(points[last - 1], beyond / np.hypot(*beyond), r)
    return np.concatenate([points[:last], [edge]]), marks


def _leave(point: Array, direction: Array, r: float) -> Array:
    """Return where a ray from a point within the figure leaves it."""
    t = []
    if direction[0] > 0:
        t.append((r - point[0]) / direction[0])
    elif direction[0] < 0:
        t.append(-point[0] / direction[0])
    if direction[1] != 0:
        t.append((math.copysign(HALF_HEIGHT_OVER_WIDTH * r, direction[1]) - point[1]) / direction[1])
    return np.asarray(point + direction * max(min(t), 0.0))


def _edge(end: Array, r: float) -> int:
    """Return 1 for a path that ends at the upper edge of the view from above, -1 at the lower, 0 elsewhere."""
    return int(math.copysign(1, end[1])) if abs(end[1]) > 0.999 * HALF_HEIGHT_OVER_WIDTH * r else 0


def _labels(
    axes: Any, ends: list[Array], words: list[str], colours: list[str], r: float, bottom: float, flag: float
) -> None:
    """Write each law's name, joined to the end of its path by a thin line; no two of these lines cross.

    Of paths that leave through the upper or the lower edge, the names stand beyond it one above the other, the nearer the wall the
    farther out. All others stand in a column at the right.
    """
    places: dict[int, tuple[float, float]] = {}
    for side in (1, -1):
        leaving = sorted((i for i in range(len(ends)) if _edge(ends[i], r) == side), key=lambda i: -float(ends[i][0]))
        for level, i in enumerate(leaving):
            places[i] = float(ends[i][0]), side * (HALF_HEIGHT_OVER_WIDTH * r + (level + 0.6) * flag)
    rest = [i for i in range(len(ends)) if i not in places]
    heights = spread_apart(
        [float(ends[i][1]) for i in rest], 0.07 * r, bottom + 0.03 * r, HALF_HEIGHT_OVER_WIDTH * r - 0.03 * r
    )
    places |= dict(zip(rest, _uncrossed([ends[i] for i in rest], [(1.045 * r, y) for y in heights]), strict=True))
    for i, (x, y) in places.items():
        axes.plot([ends[i][0], x], [ends[i][1], y], color=colours[i], lw=0.5, clip_on=False, zorder=2, label="_leader")
        axes.text(x + 0.015 * r, y, words[i], color=colours[i], ha="left", va="center", size=9, clip_on=False)


def _uncrossed(ends: list[Array], places: list[tuple[float, float]]) -> list[tuple[float, float]]:
    """Return the places in an order in which the lines from the ends to them do not cross.

    Exchanging two lines that cross makes them shorter together, so this ends.
    """
    places = list(places)
    pairs = [(i, j) for i in range(len(ends)) for j in range(i)]
    while crossed := [(i, j) for i, j in pairs if _cross(ends[i], places[i], ends[j], places[j])]:
        i, j = crossed[0]
        places[i], places[j] = places[j], places[i]
    return places


def _cross(a: Any, b: Any, c: Any, d: Any) -> bool:
    """Return whether the segments a-b and c-d have an inner point in common."""

    def side(p: Any, q: Any, o: Any) -> float:
        return float((q[0] - p[0]) * (o[1] - p[1]) - (q[1] - p[1]) * (o[0] - p[0]))

    return side(a, b, c) * side(a, b, d) < 0 and side(c, d, a) * side(c, d, b) < 0


def _hops(
    axes: Any, hops: list[tuple[laws_compared.Verdict, PathAfterWall]], styles: dict[str, tuple[str, Any]], start: float
) -> None:
    """Draw the hops from the side, heights exaggerated: how far the ball is above the floor, over its way from the wall."""
    highest = [float(path.points[:, 2].max()) * 1e3 for _verdict, path in hops]
    far = max(start + float(np.abs(path.pieces[-1][1][:, 0]).max()) * 1e3 for _verdict, path in hops)
    for k, ((verdict, path), top) in enumerate(zip(hops, highest, strict=True)):
        ink, dashes = styles[verdict.law]
        points = path.points[:, [0, 2]] * 1e3
        strong = verdict.admissible
        axes.plot(
            start + points[:, 0], points[:, 1], color=ink, ls=dashes, lw=1.8 if strong else 1.3, zorder=5 + strong
        )
        words = f"{literal(verdict.law)}  {format_number(top)} mm"
        axes.text(0.98, 0.98 - 0.075 * k, words, color=ink, ha="right", va="top", size=8, transform=axes.transAxes)
    axes.axhline(0, color=INK, lw=1.2, zorder=3)
    axes.set(xlim=(0, 1.03 * far), ylim=(0, max(highest) * (1.1 + 0.11 * len(hops))))
    axes.set(xlabel="from the wall, mm", ylabel="above the floor, mm")
    axes.set_title("hops, from the side; heights exaggerated", size=8, color=GREY, loc="left", style="italic")


def _circle(axes: Any, centre: Array, a: float, colour: str, width: float, face: str = "none") -> None:
    from matplotlib.patches import Circle

    axes.add_patch(Circle((float(centre[0]), float(centre[1])), a, ec=colour, fc=face, lw=width, zorder=3.5))


def _heads(axes: Any, tail: Array, head: Array, colour: str) -> None:
    """Draw an arrowhead two fifths along a straight path."""
    a, b = tail + 0.38 * (head - tail), tail + 0.42 * (head - tail)
    arrow(axes, (float(a[0]), float(a[1])), (float(b[0]), float(b[1])), colour)


MOST_EVENTS = 2000
STAGES = {FLIGHT: "flight", BOUNCING: "flight", SLIDING: "slide"}
POINTS_PER_CURVE = 41


@dataclass(frozen=True, eq=False)
class PathAfterWall:
    """Path of the centre after the wall, relative to its position at the wall; z is relative to a ball on the floor.

    Examples
    --------
    >>> import carom
    >>> from carom import plot
    >>> meeting = carom.incoming()
    >>> path = plot.path_after_wall(meeting, carom.LAWS["mirror"].answer(meeting))
    >>> path.pieces, path.end.tolist()
    ((), [0.0, 0.0, 0.0])
    """

    pieces: tuple[tuple[str, Array], ...]
    """("flight" | "slide", points (N, 3), m), one after the other."""
    velocity: Vec
    """Velocity at the end of the last piece, m/s; a rolling ball then moves in a straight line."""
    spin: Vec

    @property
    def end(self) -> Array:
        """The last point (3,), m."""
        return self.pieces[-1][1][-1] if self.pieces else np.zeros(3)

    @property
    def points(self) -> Array:
        """All points (N, 3), m."""
        return np.concatenate([points for _name, points in self.pieces]) if self.pieces else np.zeros((1, 3))


def path_after_wall(meeting: Meeting, answer: Answer) -> PathAfterWall:
    """Return the path of a ball after the wall, until it rolls or as far as it can be followed.

    Parameters
    ----------
    meeting : Meeting
        Ball, wall and floor.
    answer : Answer
        A law's answer for that meeting. If it does not describe the motion after the wall (``answer.steps`` is None), the
        path has no pieces.

    Returns
    -------
    PathAfterWall
        Parabolas, and sliding with Coulomb's constant deceleration; at most 2000 events.

    Examples
    --------
    >>> import carom
    >>> from carom import plot
    >>> meeting = carom.incoming()
    >>> path = plot.path_after_wall(meeting, carom.LAWS["two-step"].answer(meeting))
    >>> [name for name, points in path.pieces], round(float(path.end[0]), 4)
    (['flight'], 0.0291)
    """
    m, a = meeting, float(meeting.ball.radius)
    v, w = _vec(answer.after_wall.velocity), _vec(answer.after_wall.spin)
    if answer.steps is None or not m.gravity > 0:
        return PathAfterWall((), v, w)
    ball = {
        "radius": a,
        "mass": float(m.ball.mass),
        "inertia": float(m.ball.kappa),
        "position": (0, 0, a + float(m.height)),
    }
    names = ("restitution", "friction", "tangential_restitution")
    parts: dict[str, Any] = {
        "gravity": float(m.gravity),
        "floor": {name: float(getattr(m.floor, name)) for name in names},
        "balls": [ball | {"velocity": v, "spin": w}],
        "run": {"max_events": MOST_EVENTS},
    }
    run = simulate(Scene(**parts))
    pieces = []
    for (t, phase), end in zip(run.log[["t", "phase"]].tolist(), [*run.log["t"][1:].tolist(), run.end], strict=True):
        if end > t and phase in STAGES:
            # (the instant of an event is that after it)
            points = np.asarray(run.at(np.linspace(t, np.nextafter(end, t), POINTS_PER_CURVE)).position)[:, 0]
            pieces.append((STAGES[phase], points - [0.0, 0.0, a]))
    return PathAfterWall(tuple(pieces), _vec(run.final.velocity[0]), _vec(run.final.spin[0]))


def _vec(x: Array) -> Vec:
    return float(x[0]), float(x[1]), float(x[2])
