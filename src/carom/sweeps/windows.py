"""Acceptance windows of a shot: the directions, at each speed, from which a target is reached."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from numbers import Integral
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from carom.errors import FaultList, require_type
from carom.formatting import Listing, counted, format_number
from carom.public.progress import Progress
from carom.scene.scene import Scene
from carom.sweeps.aiming import ROWS_AT_ONCE, AimProblem, unknowns_of
from carom.sweeps.targets import targets_of

FOLLOWED = 40  # of walls, balls and pockets, that a run is followed for
HALVINGS = 16  # of a step, until an edge is found
MOST_RUNS = 1 << 24
SHOWN = 12  # windows that the table has


class Window(NamedTuple):
    """Directions between which every shot of the grid reaches the target."""

    outcome: str
    """The pocket, or what else reaches the target."""
    speed: float
    """m/s."""
    low: float
    """degrees."""
    high: float
    """degrees; above 360 where the window goes round."""

    @property
    def width(self) -> float:
        """In degrees."""
        return self.high - self.low


@dataclass(frozen=True, eq=False)
class Windows(Sequence[Window]):
    """Acceptance windows, the widest first: made by :func:`carom.aim_windows`."""

    windows: tuple[Window, ...]
    speeds: tuple[float, ...]
    """m/s: of the grid."""
    range: tuple[float, float]
    """degrees: of the grid."""
    step: float
    """degrees, between two directions of the grid: a narrower window may be missed."""
    runs: int
    """Shots that were simulated."""

    def __len__(self) -> int:
        """Return how many there are."""
        return len(self.windows)

    def __getitem__(self, k: Any) -> Any:
        """Return one, or several."""
        return self.windows[k]

    def table(self) -> Listing:
        """Return the widest windows."""
        rows = [
            [one.outcome, *(format_number(x, 5) for x in (one.speed, one.low, one.high)), format_number(one.width)]
            for one in self.windows[:SHOWN]
        ]
        some = f", the widest {len(rows)} shown" if len(rows) < len(self) else ""
        said = (
            f"{counted(len(self), 'window')} in {self.runs:,} shots{some}; a window below {self.step:g}° may be missed."
        )
        return Listing(["target", "speed m/s", "from °", "to °", "width °"], rows, said)

    def as_dict(self) -> dict[str, Any]:
        """Return all of it as plain numbers and texts."""
        each = [{**one._asdict(), "width": one.width} for one in self.windows]
        return {
            "speeds": list(self.speeds),
            "range": list(self.range),
            "step": self.step,
            "runs": self.runs,
            "windows": each,
        }

    def __repr__(self) -> str:
        """Return the table as text."""
        return repr(self.table())

    def _repr_html_(self) -> str:
        return self.table()._repr_html_()


def aim_windows(
    scene: Scene,
    free: Sequence[str] | Mapping[str, tuple[float, float]],
    reach: Any,
    *,
    speeds: int = 20,
    angles: int = 7200,
    progress: Progress | None = None,
) -> Windows:
    """Compute the acceptance windows of a shot: between which directions, at each speed, a ball reaches a target.

    Shots on a grid of speeds and directions are simulated on all cores; the edges of each window are then bisected to
    1/65,536 of the grid's step.

    Parameters
    ----------
    scene : Scene
    free : path, or a mapping of it to the range (low, high) of the speed, m/s
        ``balls.0.velocity`` or ``balls.0.strike``, as :func:`carom.aim` takes them.
    reach : mapping, or several
        The target, as :func:`carom.aim` takes it. For ``"pocket": "any"`` each pocket has windows of its own.
    speeds, angles : int
        Of the grid: speeds from the lowest to the highest, and directions round the circle.
    progress : callable(done, total, text), optional
        Called with the shots so far.

    Returns
    -------
    Windows
        The widest first. A window narrower than the grid's step may be missed; within one, a gap narrower than that.

    Raises CaromError: unknown paths, balls and pockets, numbers out of range.

    Examples
    --------
    >>> import carom
    >>> balls = [carom.SceneBall(radius=0.03, mass=0.2, position=(x, 0)) for x in (0, 0.6)]
    >>> scene = carom.Scene(floor=carom.Floor(friction=0.2, rolling_resistance=0.01), balls=balls, run=carom.Run(duration=3))
    >>> found = carom.aim_windows(scene, {"balls.0.velocity": (1.0, 2.0)}, {"hit": 1}, speeds=2, angles=360)
    >>> found[0].outcome, round(found[0].width, 3)  # 2 asin(2 a/d) = 11.478
    ('ball 1', 11.478)
    """
    require_type("aim_windows", "scene", scene, Scene)
    faults = FaultList("aim_windows")
    unknowns = faults.attempt(unknowns_of, scene, free, {})
    targets = faults.attempt(targets_of, scene, reach)
    for name, value, least in (("speeds", speeds, 1), ("angles", angles, 3)):
        if isinstance(value, bool) or not isinstance(value, Integral) or not least <= value <= MOST_RUNS:
            faults.add(name, f"a whole number from {least} to {MOST_RUNS:,}", f"{value!r:.60}")
    if not faults and speeds * angles > MOST_RUNS:
        faults.add("speeds", f"at most {MOST_RUNS:,} shots in all", f"{speeds:,} x {angles:,}")
    if unknowns and [one.name == "speed" or one.circular for one in unknowns] != [True, True]:
        faults.add("free", "one ball's velocity or strike: a speed and a direction", f"{free!r:.60}")
    faults.raise_if_any()
    problem = AimProblem(scene, unknowns, targets)
    step = 360.0 / angles
    grid = np.linspace(problem.low[0], problem.high[0], speeds)
    directions = problem.low[1] + step * np.arange(angles)
    runs = _Labels(problem, speeds * angles, progress)
    points = np.stack(np.broadcast_arrays(grid[:, None], directions), axis=-1)
    label = runs.of(points.reshape(-1, 2)).reshape(speeds, angles)
    row, first = np.nonzero(label != np.roll(label, -1, axis=1))
    edges = runs.edges(grid[row], directions[first], step, label[row, first])
    found = [
        Window(runs.names[code], float(grid[i]), low, high)
        for i in range(speeds)
        for code, low, high in _spans(label[i], first[row == i], edges[row == i], float(problem.low[1]))
    ]
    found.sort(key=lambda one: (-one.width, one.outcome, one.speed))
    return Windows(
        tuple(found), tuple(grid.tolist()), (float(problem.low[1]), float(problem.low[1]) + 360.0), step, runs.done
    )


def _spans(
    label: NDArray[np.int64], first: NDArray[np.int64], edges: NDArray[np.float64], low: float
) -> Iterator[tuple[int, float, float]]:
    """Yield code, low and high of each window at one speed; ``first``: the direction before each edge."""
    if len(first) == 0:
        if label[0] >= 0:
            yield int(label[0]), low, low + 360.0
        return
    for before, after, k in zip(edges, np.roll(edges, -1), first, strict=True):
        code = int(label[(k + 1) % len(label)])
        if code >= 0:
            start = before - 360.0 * math.floor((before - low) / 360.0)
            yield code, float(start), float(start + (after - before) % 360.0)


class _Labels:
    """Which target shots reach: a number by shot, -1 for none."""

    def __init__(self, problem: AimProblem, total: int, progress: Progress | None) -> None:
        self.problem, self.total, self.progress, self.done = problem, total, progress, 0
        pockets = [target for target in problem.targets if target.kind == "pocket"]
        self.pocket = pockets[0] if pockets else None
        target = problem.targets[0]
        other = (
            " and ".join(problem.scene.ball_names[k] for k in target.others) if target.kind == "hit" else "the place"
        )
        self.names: Sequence[str] = problem.scene.pocket_names if self.pocket is not None else (other,)

    def of(self, x: NDArray[np.float64]) -> NDArray[np.int64]:
        """Return the numbers (N,) of starts (N, 2)."""
        found = np.full(len(x), -1)
        for part in np.array_split(np.arange(len(x)), math.ceil(len(x) * FOLLOWED / ROWS_AT_ONCE)):
            _size, reached, rows, done = self.problem.run_many(x[part], FOLLOWED)
            code = np.zeros(len(part), np.int64)
            if self.pocket is not None:
                its = rows[:, self.problem.targets.index(self.pocket)]
                code = done.log["other"][np.arange(len(part)), its].astype(np.int64)
            found[part] = np.where(reached, code, -1)
            self.done += len(part)
            if self.progress is not None:
                self.progress(min(self.done, self.total), self.total, "shots")
        return found

    def edges(
        self, speed: NDArray[np.float64], angle: NDArray[np.float64], step: float, label: NDArray[np.int64]
    ) -> NDArray[np.float64]:
        """Return the directions between ``angle`` and the next one at which a label ends, by bisection."""
        low, width = angle.copy(), step
        for _ in range(HALVINGS if len(angle) else 0):
            width /= 2
            same = self.of(np.stack([speed, low + width], axis=1)) == label
            low = np.where(same, low + width, low)
        return low + width / 2
