"""The result of a run: its events, and the exact state of every ball at any time."""

from __future__ import annotations

import functools
import html
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from carom.bodies import Numbers, State
from carom.core.motion.phases import PHASES
from carom.errors import CaromError, float_array
from carom.files import as_path
from carom.public.other_rooms import figure_maker
from carom.scene.paths import ball_index
from carom.scene.scene import Scene
from carom.simulation.break_statistics import BreakStatistics, break_statistics
from carom.simulation.events import Events
from carom.simulation.frames import FRAME_RATE, save_frames
from carom.simulation.narrate import describe_run
from carom.simulation.records import START
from carom.simulation.save import save
from carom.simulation.setup import SceneArrays, set_up
from carom.simulation.states import orientations, states
from carom.simulation.tables import kinetic_energy, states_dataset, states_table

if TYPE_CHECKING:
    import pandas
    import xarray
    from matplotlib.figure import Figure

    from carom.simulation.sensitivity.sensitivity import Sensitivity

__all__ = ["Trajectory"]

Array = NDArray[np.float64]
TABLE_TIMES = 201  # of a run's table, where no times are given


class Trajectory:
    """The result of a run: its events, and the exact state of every ball at any time.

    Returned by :func:`carom.simulate` and :func:`carom.load_trajectory`. Between two events the motion of every ball has a closed
    form, so nothing is interpolated.

    Examples
    --------
    >>> import carom
    >>> wall = carom.scene.Plane(point=(0, 0, 0), normal=(1, 0, 0), restitution=0.85, friction=0.2)
    >>> ball = carom.SceneBall(radius=0.03, mass=0.2, position=(1, 0), velocity=(-2, 1), rolling=True)
    >>> scene = carom.Scene(floor=carom.Floor(friction=0.2), walls=[wall], balls=[ball], run=carom.Run(duration=2))
    >>> run = carom.simulate(scene)
    >>> run
    <Trajectory: 1 ball, 3 events, 2 s, duration>
    >>> run.phase(0.0).tolist(), run.final_phase
    (['rolling'], ['rolling'])
    >>> run.at([0.0, 2.0]).position.round(3)[:, 0, 0]
    array([1.   , 1.772])
    """

    def __init__(
        self, scene: Scene, log: NDArray[np.void], end: float, ended: str, arrays: SceneArrays | None = None
    ) -> None:
        self.scene = scene
        self.log = log
        """All rows, the balls' starts first (carom.simulation.records.LOG)."""
        self.end = end
        """s: time up to which the balls were followed."""
        self.ended = ended
        """Why it ended: "nothing more happens", "duration", "max_events"."""
        if arrays is not None:
            self.arrays = arrays

    def __reduce__(self) -> tuple[Any, ...]:
        """Pickle and copy what was computed; the scene's arrays hold addresses of this process, and are made again."""
        return type(self), (self.scene, self.log, self.end, self.ended)

    @functools.cached_property
    def arrays(self) -> SceneArrays:
        """The scene as the event loop reads it, with the balls at their starts."""
        return set_up(self.scene, compiled=False)

    # --- what happened ---------------------------------------------------------------------------------------------

    @functools.cached_property
    def events(self) -> Events:
        """All events, in order of time, without the initial states."""
        return Events(self, self.log[self.log["kind"] != START])

    def describe(self) -> list[str]:
        """Return the paragraphs of ``carom simulate``: one for each of the first balls that move, one for how the run ended."""
        return describe_run(self)

    # --- states ----------------------------------------------------------------------------------------------------

    @functools.cached_property
    def _rows_of(self) -> list[NDArray[np.int64]]:
        """Numbers of the log's rows of each ball."""
        return [np.flatnonzero(self.log["ball"] == i) for i in range(len(self.scene.balls))]

    def _find(self, t: ArrayLike) -> tuple[Array, Array, NDArray[np.int64]]:
        """Times (T,), and for each time and ball (T, B) the row of the log that it follows and by how much."""
        try:
            times = float_array(t)
        except (TypeError, ValueError):
            raise CaromError(f"Trajectory: t: expected times in s, got {t!r:.60}") from None
        flat = np.atleast_1d(times).ravel()
        late = self.ended != "nothing more happens"
        bad = ~((flat >= 0) & ((flat <= self.end) if late else np.isfinite(flat)))
        if bad.any():
            span = f"from 0 to {self.end:.9g} s" if late else "from 0 on"
            raise CaromError(f"Trajectory: t: expected times {span}, got {float(flat[bad][0])!r}")
        rows = np.stack(
            [own[np.searchsorted(self.log["t"][own], flat, side="right") - 1] for own in self._rows_of], axis=1
        )
        return times, flat[:, None] - self.log["t"][rows], rows

    def at(self, t: ArrayLike) -> State:
        """Return the exact states at a time, s, or at times: arrays (B, 3), or (..., B, 3) for times (...).

        At the time of an event, the state just after it. NaN after a ball has left, is held or is pocketed. Raises CaromError for
        times before the start or after the end of the run.
        """
        times, after, rows = self._find(t)
        x, v, w, _phase = states(self.arrays.world, self.arrays.balls, self.log[rows.ravel()], after.ravel())
        shape = (*times.shape, len(self.scene.balls), 3)
        return State.of(v.reshape(shape), w.reshape(shape), x.reshape(shape))

    def phase(self, t: ArrayLike) -> NDArray[np.str_]:
        """Return the names of the phases at a time or times, s: (B,) or (..., B)."""
        times, _after, rows = self._find(t)
        found: NDArray[np.str_] = np.array(PHASES)[self.log["phase"][rows]].reshape(*times.shape, len(self.scene.balls))
        return found

    def index(self, ball: int | str) -> int:
        """Return the number of a ball by its name: ``run.at(0.5).position[run.index("white")]``. CaromError for an unknown one."""
        return ball_index(self.scene, ball)

    def phases(self, ball: int | str = 0) -> list[tuple[float, float, str]]:
        """Return the phases of a ball (its number or name) in order: start and end (s), name."""
        rows = self.log[self._rows_of[self.index(ball)]]
        found: list[tuple[float, float, str]] = []
        for start, end, phase in zip(rows["t"], [*rows["t"][1:], self.end], rows["phase"], strict=True):
            name = PHASES[phase]
            if found and found[-1][2] == name:
                found[-1] = (found[-1][0], float(end), name)
            elif end > start or start == self.end:
                found.append((float(start), float(end), name))
        return found

    @property
    def start(self) -> State:
        """Return the initial states (B, 3)."""
        rows = self.log[: len(self.scene.balls)]
        return State.of(np.array(rows["v"]), np.array(rows["w"]), np.array(rows["x"]))

    @property
    def final(self) -> State:
        """Return the final states (B, 3); of a ball that left, is held or is pocketed, its last one."""
        found = self.at(self.end)
        last = self.log[[own[-1] for own in self._rows_of]]
        gone = np.isnan(found.velocity[:, 0])
        position = found.position
        assert position is not None
        for array, field in ((found.velocity, "v"), (found.spin, "w"), (position, "x")):
            array[gone] = last[field][gone]
        return found

    @property
    def final_phase(self) -> list[str]:
        """Return the final phase of each ball."""
        return [PHASES[self.log["phase"][own[-1]]] for own in self._rows_of]

    @functools.cached_property
    def _turned(self) -> Array:
        """Orientation (rows of the log, 4) of the row's ball at each row."""
        q = np.zeros((len(self.log), 4))
        for own in self._rows_of:
            turn = orientations(
                self.arrays.world, self.arrays.balls, self.log[own[:-1]], np.diff(self.log["t"][own]),
                np.tile([1.0, 0.0, 0.0, 0.0], (len(own) - 1, 1)),
            )  # fmt: skip
            q[own[0]] = last = np.array([1.0, 0.0, 0.0, 0.0])
            for row, by in zip(own[1:], turn, strict=True):
                last = _product(by, last)
                q[row] = last
        return q

    def orientation(self, t: ArrayLike) -> Array:
        """Return orientations at a time or times, s: unit quaternions (w, x, y, z) from the body's frame, (B, 4) or (..., B, 4).

        All balls start with the unit quaternion. Exact where the spin keeps its direction, elsewhere to 1e-10 rad a phase
        (:mod:`carom.core.motion.rotation`).
        """
        times, after, rows = self._find(t)
        which = rows.ravel()
        q = orientations(self.arrays.world, self.arrays.balls, self.log[which], after.ravel(), self._turned[which])
        return q.reshape(*times.shape, len(self.scene.balls), 4)

    # --- energy ----------------------------------------------------------------------------------------------------

    def kinetic_energy(self, ball: Any, velocity: Array, spin: Array) -> Numbers:
        """Return the kinetic energy, J, of ball number ``ball`` at a velocity and spin (3,); or of several (N,) at (N, 3)."""
        return kinetic_energy(self.arrays.balls, ball, velocity, spin)

    def energy(self, t: ArrayLike, *, each: bool = False) -> Numbers:
        """Return kinetic plus potential energy at a time or times, J: of all balls (...), or of each (..., B).

        The potential energy is measured from the floor's contact (z = a), without a floor from z = 0. A ball that is pocketed has
        none (NaN), and adds nothing to the energy of all balls.
        """
        state = self.at(t)
        x, balls = state.position, self.arrays.balls
        assert x is not None
        base = np.zeros((len(balls), 3))
        if self.scene.floor is not None:
            base[:, 2] = balls["radius"]
        lift = -((x - base) * np.array(self.scene.pull)).sum(axis=-1) * balls["mass"]
        found = self.kinetic_energy(slice(None), state.velocity, state.spin) + lift
        if not each:
            gone = np.isnan(found)
            found = np.where(
                gone.all(axis=-1) & (np.asarray(t) > self.end), np.nan, np.where(gone, 0.0, found).sum(axis=-1)
            )
        return float(found) if np.ndim(found) == 0 else found

    # --- derivatives -------------------------------------------------------------------------------------------------

    def sensitivity(self, wrt: str | Sequence[str]) -> Sensitivity:
        """Compute exact derivatives of events and states with respect to numbers of the scene.

        Sources: Kong, Payne, Zhu & Johnson (2023), arXiv 2306.06862 (saltation matrices); Zhong et al. (2023), arXiv 2305.00092.

        Parameters
        ----------
        wrt : list of str
            Paths such as ``balls.0.velocity`` and ``walls.*.friction``. A vector is a column for x and y, and for z where the ball
            is in flight; ``*`` is one shared column.

        Returns
        -------
        Sensitivity
            ``columns`` (p names), ``final`` and ``at(t)`` with ``position``, ``velocity``, ``spin`` (B, 3, p) at a fixed time,
            ``events[i]`` with ``time`` (p,) and ``position``, ``velocity``, ``spin`` (3, p), ``margin`` (distance of each event to
            the next change of regime), ``near_misses``, ``radius``.

        Raises CaromError for an unknown path, for a path to what is no finite real number, for the motion of a ball at rest, at an
        exact graze, and for a law of one's own that calls more than Python's ``math``.

        Examples
        --------
        >>> import carom
        >>> wall = carom.scene.Plane(point=(0, 0, 0), normal=(1, 0, 0), restitution=0.5, friction=0)
        >>> ball = carom.SceneBall(radius=0.1, mass=0.2, position=(1.1, 0, 0), velocity=(-2, 1, 0))
        >>> run = carom.simulate(carom.Scene(gravity=0, walls=[wall], balls=[ball], run=carom.Run(duration=1)))
        >>> s = run.sensitivity(["balls.0.velocity", "walls.0.restitution"])
        >>> s.columns
        ['balls.0.velocity.x', 'balls.0.velocity.y', 'balls.0.velocity.z', 'walls.0.restitution']
        >>> s.final.position[0, 0].round(6).tolist()
        [-0.5, 0.0, 0.0, 1.0]
        """
        from carom.simulation.sensitivity.sensitivity import sensitivity

        return sensitivity(self, wrt)

    def break_statistics(self) -> BreakStatistics:
        """Compute figures of the break of a rack: ``fast``, ``median``, ``share``, ``distance``, ``pocketed``; ``describe()``.

        Raises CaromError, one line, for a scene without a rack, and for a run in which no ball meets it.
        """
        return break_statistics(self)

    # --- tables, files, pictures -------------------------------------------------------------------------------------

    def table(self, times: ArrayLike | None = None) -> pandas.DataFrame:
        """Return a pandas DataFrame, one row per ball and time (s; default: 201 over the run). CaromError without pandas."""
        return states_table(self, self._times(times))

    to_pandas = table

    def to_xarray(self, times: ArrayLike | None = None) -> xarray.Dataset:
        """Return the states at some times (s; default: 201 over the run) as an xarray Dataset. CaromError without xarray."""
        return states_dataset(self, self._times(times))

    def _times(self, times: ArrayLike | None) -> Array:
        return (
            np.linspace(0.0, self.end, TABLE_TIMES) if times is None else np.atleast_1d(np.asarray(times, dtype=float))
        )

    def save(self, path: str | Path) -> Path:
        """Write the run to a .parquet file; :func:`carom.load_trajectory` gives back the same bits."""
        return save(self, as_path("Trajectory.save", path))

    def save_frames(self, path: str | Path, rate: float = FRAME_RATE) -> Path:
        """Write every ball's place, velocity, spin and orientation frame by frame, for other programs: .csv, .json or .parquet.

        Parameters
        ----------
        path : str or Path
            .csv and .parquet have a row per ball and frame, .json arrays (frame, ball, axis).
        rate : float, optional
            Frames per second.

        Raises CaromError, one line, for another ending, a rate that is not above 0, and more than ten million states.
        """
        return save_frames(self, as_path("Trajectory.save_frames", path), rate)

    def plot(self, file: str | Path | None = None, **options: Any) -> Figure:
        """Return a Matplotlib figure: the run from above and from the side, its energy over time. ``file``: write it there."""
        return figure_maker("plot_trajectory")(self, file, **options)  # type: ignore[no-any-return]

    def animate(self, file: str | Path, **options: Any) -> Path:
        """Write an animation to ``file``: .mp4, .gif, or a self-contained .html page."""
        return figure_maker("animate")(self, as_path("Trajectory.animate", file), **options)  # type: ignore[no-any-return]

    def __repr__(self) -> str:
        """Return one line."""
        balls = len(self.scene.balls)
        return f"<Trajectory: {balls} ball{'s' if balls > 1 else ''}, {len(self.events)} events, {self.end:.6g} s, {self.ended}>"

    def _repr_html_(self) -> str:
        """Return one line and the first events, for notebooks."""
        return f"<p>{html.escape(repr(self))}</p>{self.events._repr_html_()}"


def _product(p: Array, q: Array) -> Array:
    from carom.core.motion.rotation import compose

    return np.array(compose(tuple(p.tolist()), tuple(q.tolist())))
