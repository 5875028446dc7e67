"""What a run returns: its events, and the exact state at any time."""

from __future__ import annotations

import functools
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any, overload

import numpy as np
from numpy.typing import ArrayLike, NDArray

from carom.engine.arrays import BALL, KINDS, PHASE, START, WALL
from carom.engine.setup import set_up
from carom.errors import CaromError
from carom.files import path_of
from carom.motion.phases import PHASES
from carom.path import orientations, states
from carom.scene.model import Scene
from carom.state import State
from carom.verbs import NAMES

if TYPE_CHECKING:
    import pandas
    import xarray

__all__ = ["Event", "Events", "Trajectory"]

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Event:
    """Something that happened to one ball. A meeting of two balls is two events, one for each."""

    t: float
    """s."""
    kind: str
    """ "wall", "floor", "ball"; "rolling", "pivoting", "rest": the phase that begins; "settled": the last of infinitely many
    bounces; "left": it cleared a wall; "held": a force presses it on a wall or a ball, and it is followed no further."""
    ball: int
    other: int
    """The wall's number, or the other ball's; -1 for none."""
    name: str
    """What it met: the wall's or the ball's name; empty for none."""
    phase: str
    """The phase that begins: flight, sliding, rolling, pivoting, rest, bouncing, held, left."""
    before: State
    after: State
    """Velocity, spin, position."""
    impulse: Array
    """(3,), N s, on the ball."""
    floor_impulse: Array
    """(3,), N s: what the floor gave while a wall pressed the ball on it."""
    required_friction: float
    """The friction from which on the contact would have held."""
    regime: str
    """ "stick", "slide", ...: what the contact did; empty where nothing was met."""
    energy_lost: float
    """J, by this ball (a ball that is struck gains)."""


class Events(Sequence[Event]):
    """The events of a run, in the order of time."""

    def __init__(self, run: Trajectory, rows: NDArray[np.void]) -> None:
        self._run = run
        self.rows = rows

    def __len__(self) -> int:
        """How many."""
        return len(self.rows)

    @overload
    def __getitem__(self, index: int) -> Event: ...
    @overload
    def __getitem__(self, index: slice) -> Events: ...
    def __getitem__(self, index: int | slice) -> Event | Events:
        """One event, or a part of them."""
        if isinstance(index, slice):
            return Events(self._run, self.rows[index])
        return self._run._event(self.rows[index])

    def __iter__(self) -> Iterator[Event]:
        """One after the other."""
        return (self[i] for i in range(len(self)))

    def of(self, *kinds: str, ball: int | None = None) -> Events:
        """The events of some kinds, and of one ball."""
        names = kind_names(self.rows)
        keep = np.isin(names, kinds) if kinds else np.ones(len(self), dtype=bool)
        if ball is not None:
            keep &= self.rows["ball"] == ball
        return Events(self._run, self.rows[keep])

    @property
    def t(self) -> Array:
        """Their times (N,), s."""
        return np.array(self.rows["t"])

    @property
    def kinds(self) -> list[str]:
        """Their kinds."""
        return list(kind_names(self.rows))

    def table(self) -> pandas.DataFrame:
        """A tidy table, one event a row (needs pandas)."""
        from carom.tidy import events_table

        return events_table(self._run, self.rows)

    def __repr__(self) -> str:
        """How many of each kind."""
        names, counts = np.unique(kind_names(self.rows), return_counts=True)
        told = ", ".join(f"{count} {name}" for name, count in zip(names, counts, strict=True))
        return f"<{len(self)} events: {told}>" if told else "<no events>"


def kind_names(rows: NDArray[np.void]) -> NDArray[Any]:
    """Kinds of rows of a log, as people see them: the end of a phase is called after the phase that begins."""
    kinds = np.array(KINDS, dtype=object)[rows["kind"]]
    phases = np.array(PHASES, dtype=object)[rows["phase"]]
    names: NDArray[Any] = np.where(rows["kind"] == PHASE, phases, kinds)
    return names


class Trajectory:
    """A run: what happened, and the exact state of every ball at any time.

    Made by :func:`carom.simulate`, or read from a file (:meth:`load`). Between two events every ball moves on a closed
    form, so nothing is interpolated.
    """

    def __init__(self, scene: Scene, log: NDArray[np.void], end: float, ended: str) -> None:
        self.scene = scene
        self.log = log
        """All rows, the balls' starts first (carom.engine.arrays.LOG)."""
        self.end = end
        """s: how far the balls were followed."""
        self.ended = ended
        """Why it ended: "nothing more happens", "duration", "max_events"."""

    # --- what happened ---------------------------------------------------------------------------------------------

    @functools.cached_property
    def events(self) -> Events:
        """All events, in the order of time; the starts are not events."""
        return Events(self, self.log[self.log["kind"] != START])

    def _event(self, row: Any) -> Event:
        i, met, other = int(row["ball"]), int(row["met"]), int(row["other"])
        x = np.array(row["x"])
        before = State.of(np.array(row["v_before"]), np.array(row["w_before"]), x)
        after = State.of(np.array(row["v"]), np.array(row["w"]), x)
        names = {WALL: self.scene.wall_names, BALL: self.scene.ball_names}.get(met)
        return Event(
            t=float(row["t"]),
            kind=str(kind_names(row)),
            ball=i,
            other=other,
            name=names[other] if names else "",
            phase=PHASES[row["phase"]],
            before=before,
            after=after,
            impulse=np.array(row["impulse"]),
            floor_impulse=np.array(row["floor_impulse"]),
            required_friction=float(row["required"]),
            regime="" if row["regime"] < 0 else str(NAMES[row["regime"]]),
            energy_lost=float(
                self._kinetic(i, before.velocity, before.spin) - self._kinetic(i, after.velocity, after.spin)
            ),
        )

    # --- states ----------------------------------------------------------------------------------------------------

    @functools.cached_property
    def _setup(self) -> Any:
        return set_up(self.scene)

    @functools.cached_property
    def _rows_of(self) -> list[NDArray[np.int64]]:
        """Numbers of the log's rows of each ball."""
        return [np.flatnonzero(self.log["ball"] == i) for i in range(len(self.scene.balls))]

    def _find(self, t: ArrayLike) -> tuple[Array, Array, NDArray[np.int64]]:
        """Times (T,), and for each time and ball (T, B) the row of the log that it follows and by how much."""
        times = np.asarray(t, dtype=float)
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
        """Exact states at a time, or at times: arrays (B, 3), or (..., B, 3) for times (...).

        At the time of an event, the state just after it. NaN after a ball has left or is held. Raises CaromError for
        times before the start or after the end of the run.
        """
        times, after, rows = self._find(t)
        x, v, w, _phase = states(self._setup.world, self._setup.balls, self.log[rows.ravel()], after.ravel())
        shape = (*times.shape, len(self.scene.balls), 3)
        return State.of(v.reshape(shape), w.reshape(shape), x.reshape(shape))

    def phase(self, t: ArrayLike) -> Any:
        """Phases at a time or times: names, shape (B,) or (..., B)."""
        times, _after, rows = self._find(t)
        return np.array(PHASES)[self.log["phase"][rows]].reshape(*times.shape, len(self.scene.balls))

    def phases(self, ball: int = 0) -> list[tuple[float, float, str]]:
        """The phases of a ball, one after the other: from, to (s), name."""
        rows = self.log[self._rows_of[ball]]
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
        """States (B, 3) at the start."""
        rows = self.log[: len(self.scene.balls)]
        return State.of(np.array(rows["v"]), np.array(rows["w"]), np.array(rows["x"]))

    @property
    def final(self) -> State:
        """States (B, 3) at the end; of a ball that left or is held, those in which it was last followed."""
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
        """Phases at the end, one a ball."""
        return [PHASES[self.log["phase"][own[-1]]] for own in self._rows_of]

    @functools.cached_property
    def _turned(self) -> Array:
        """Orientation (rows of the log, 4) of the row's ball at each row."""
        q = np.zeros((len(self.log), 4))
        for own in self._rows_of:
            turn = orientations(
                self._setup.world, self._setup.balls, self.log[own[:-1]], np.diff(self.log["t"][own]),
                np.tile([1.0, 0.0, 0.0, 0.0], (len(own) - 1, 1)),
            )  # fmt: skip
            q[own[0]] = last = np.array([1.0, 0.0, 0.0, 0.0])
            for row, by in zip(own[1:], turn, strict=True):
                last = _product(by, last)
                q[row] = last
        return q

    def orientation(self, t: ArrayLike) -> Array:
        """Orientations at a time or times: unit quaternions (w, x, y, z) from the body's frame, (B, 4) or (..., B, 4).

        All balls start unturned. Exact where the spin keeps its direction, elsewhere to 1e-10 rad a phase
        (:mod:`carom.motion.rotation`).
        """
        times, after, rows = self._find(t)
        which = rows.ravel()
        q = orientations(self._setup.world, self._setup.balls, self.log[which], after.ravel(), self._turned[which])
        return q.reshape(*times.shape, len(self.scene.balls), 4)

    # --- energy ----------------------------------------------------------------------------------------------------

    def _kinetic(self, ball: Any, v: Array, w: Array) -> Any:
        balls = self._setup.balls
        m, moment = balls["mass"][ball], (balls["kappa"] * balls["mass"] * balls["radius"] ** 2)[ball]
        return m * (v * v).sum(axis=-1) / 2 + moment * (w * w).sum(axis=-1) / 2

    def energy(self, t: ArrayLike, *, each: bool = False) -> Any:
        """Kinetic and potential energy at a time or times, J: of all balls (...), or of each (..., B).

        The potential energy counts from the floor's contact (z = a), without a floor from z = 0.
        """
        state = self.at(t)
        x, balls = state.position, self._setup.balls
        assert x is not None
        base = np.zeros((len(balls), 3))
        if self.scene.floor is not None:
            base[:, 2] = balls["radius"]
        lift = -((x - base) * np.array(self.scene.gravity)).sum(axis=-1) * balls["mass"]
        found = self._kinetic(slice(None), state.velocity, state.spin) + lift
        if not each:
            found = found.sum(axis=-1)
        return float(found) if np.ndim(found) == 0 else found

    # --- tables, files, pictures -------------------------------------------------------------------------------------

    def table(self, times: ArrayLike) -> pandas.DataFrame:
        """A tidy table of all balls at the given times (needs pandas)."""
        from carom.tidy import states_table

        return states_table(self, np.atleast_1d(np.asarray(times, dtype=float)))

    def to_xarray(self, times: ArrayLike) -> xarray.Dataset:
        """The states at the given times, labelled (needs xarray)."""
        from carom.tidy import states_dataset

        return states_dataset(self, np.atleast_1d(np.asarray(times, dtype=float)))

    def save(self, path: str | Path) -> Path:
        """Write the run to a .parquet or .nc file; :func:`carom.load_trajectory` gives back the same bits."""
        from carom.storage import save

        return save(self, path_of("Trajectory.save", path))

    def plot(self, file: str | Path | None = None, **options: Any) -> Any:
        """Draw the run from above, from the side, and its energy over time: a Matplotlib figure, written if named."""
        from carom.plot.trajectory import plot_trajectory

        return plot_trajectory(self, file, **options)

    def animate(self, file: str | Path, **options: Any) -> Path:
        """Write an animation: .mp4, .gif, or a self-contained .html page."""
        from carom.plot.animation import animate

        return animate(self, path_of("Trajectory.animate", file), **options)

    def __repr__(self) -> str:
        """One line."""
        balls = len(self.scene.balls)
        return f"<Trajectory: {balls} ball{'s' if balls > 1 else ''}, {len(self.events)} events, {self.end:.6g} s, {self.ended}>"


def _product(p: Array, q: Array) -> Array:
    from carom.motion.rotation import compose

    return np.array(compose(tuple(p.tolist()), tuple(q.tolist())))
