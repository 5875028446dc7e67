"""The result of a run: its events, and the exact state of every ball at any time."""

from __future__ import annotations

import functools
import html
import itertools
import json
from collections.abc import Iterator, Sequence
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple, overload

import numpy as np
from numpy.typing import ArrayLike, NDArray

from carom.bodies import Numbers, State
from carom.core.contact import NO_REGIME
from carom.core.motion.phases import PHASES
from carom.errors import CaromError, Fault, FaultList, did_you_mean, float_array
from carom.files import as_path, import_optional, open_regular, require_unpacked_size
from carom.formatting import Listing
from carom.laws.landing import REGIME_NAMES
from carom.laws.landing import REGIME_NAMES as NAMES
from carom.public.other_rooms import figure_maker
from carom.scene.scene import Scene
from carom.scene.schema import from_file
from carom.scene.toml import ball_index
from carom.simulation.contact_kinds import PARTNERS, partner_names
from carom.simulation.files import (
    FORMAT,
    FORMATS,
    FRAME_RATE,
    NAMED,
    SCALARS,
    VECTORS,
    digest_of,
    events_table,
    kinetic_energy,
    log_columns,
    save,
    save_frames,
    states_dataset,
    states_table,
    version,
)
from carom.simulation.loop import ENDS
from carom.simulation.motion import orientations, states
from carom.simulation.narrate import BreakStatistics, break_statistics, describe_run
from carom.simulation.records import (
    BALL,
    EVENT_KINDS,
    FLOOR,
    LOG,
    START,
    WALL,
    RunRecord,
    SceneArrays,
    first_kinds,
    kind_names,
    set_up,
)

if TYPE_CHECKING:
    import pandas
    import xarray
    from matplotlib.figure import Figure

    from carom.simulation.sensitivity.sensitivity import Sensitivity

Array = NDArray[np.float64]
HTML_ROWS = 20  # of events in a notebook


@dataclass(frozen=True, eq=False)
class Event:
    """One event of one ball. An impact of two balls is two events, one for each; of several at once, as in a rack, one for each.

    Examples
    --------
    >>> import carom
    >>> run = carom.simulate("carom", duration=1)
    >>> hit = run.events.of("wall")[0]
    >>> hit.name, hit.regime, round(hit.t, 3), round(hit.energy_lost, 3)
    ('cushions', 'stick', 0.692, 0.264)
    """

    t: float
    """s."""
    kind: str
    """ "wall", "floor", "ball"; "rolling", "pivoting", "rest": the phase that begins; "settled": the end of infinitely many
    bounces; "left": it cleared a wall; "held": a force presses it on a wall or a ball, and it is followed no further;
    "pocketed": it fell into a pocket, and is followed no further."""
    ball: int
    other: int
    """Number of the wall, of the other ball (the first of several), or of the pocket (in ``scene.pocket_names``); -1 for none."""
    name: str
    """Name of the wall, of the other ball, or of the pocket; empty for none."""
    phase: str
    """The phase that begins: flight, sliding, rolling, pivoting, rest, bouncing, held, left, pocketed."""
    before: State
    after: State
    """Velocity, spin, position."""
    impulse: Array
    """(3,), N s, on the ball; of wall and floor together under ``han2005``, ``mathavan2010`` and ``stronge-cushion``."""
    floor_impulse: Array
    """(3,), N s: of the floor, while a wall pressed the ball on it."""
    required_friction: float
    """The least friction with which the contact would have stuck; 0 under laws that do not say (mirror, maw, stronge, cushions)."""
    regime: str
    """Regime of the contact: "stick", "slide", ...; empty if there was none."""
    energy_lost: float
    """J, of this ball (negative for a ball that is struck)."""

    @property
    def position(self) -> Array:
        """Of the centre at the event (3,), m."""
        assert self.after.position is not None
        return self.after.position

    @property
    def velocity(self) -> Array:
        """After the event (3,), m/s."""
        return self.after.velocity

    @property
    def spin(self) -> Array:
        """After the event (3,), rad/s."""
        return self.after.spin


class Events(Sequence[Event]):
    """The events of a run, in order of time.

    Examples
    --------
    >>> import carom
    >>> run = carom.simulate("carom", duration=1)
    >>> run.events
    <40 events: 2 ball, 31 floor, 2 rolling, 2 settled, 3 wall>
    >>> run.events.of("wall", ball="white").t.round(3)
    array([0.798, 0.991])
    """

    def __init__(self, run: RunRecord, rows: NDArray[np.void]) -> None:
        self._run = run
        self.rows = rows

    def __len__(self) -> int:
        """Return the number of events."""
        return len(self.rows)

    @overload
    def __getitem__(self, index: int) -> Event: ...
    @overload
    def __getitem__(self, index: slice) -> Events: ...
    def __getitem__(self, index: int | slice) -> Event | Events:
        """Return one event, or a slice of them."""
        if isinstance(index, slice):
            return Events(self._run, self.rows[index])
        return _event(self._run, self.rows[index])

    def __iter__(self) -> Iterator[Event]:
        """Iterate over the events."""
        return (self[i] for i in range(len(self)))

    def of(self, *kinds: str, ball: int | str | None = None) -> Events:
        """Return the events of some kinds (:attr:`Event.kind`; default: all), and of one ball, by number or name (default: of all).

        Raises CaromError for a kind that no event has, with the nearest one, and for an unknown ball.
        """
        if strange := [kind for kind in kinds if kind not in EVENT_KINDS]:
            raise CaromError(
                *(
                    Fault(
                        "Events.of",
                        "",
                        f"a kind of {', '.join(EVENT_KINDS)}",
                        repr(one),
                        did_you_mean(one, EVENT_KINDS),
                    )
                    for one in strange
                )
            )
        names = kind_names(self.rows)
        keep = np.isin(names, kinds) if kinds else np.ones(len(self), dtype=bool)
        if ball is not None:
            keep &= self.rows["ball"] == ball_index(self._run.scene, ball)
        return Events(self._run, self.rows[keep])

    @property
    def t(self) -> Array:
        """Return their times (N,), s."""
        return np.array(self.rows["t"])

    @property
    def kinds(self) -> list[str]:
        """Return their kinds."""
        return list(kind_names(self.rows))

    def table(self) -> pandas.DataFrame:
        """Return a pandas DataFrame, one row per event. CaromError without pandas."""
        return events_table(self._run, self.rows)

    def __repr__(self) -> str:
        """Return how many there are of each kind."""
        names, counts = np.unique(kind_names(self.rows), return_counts=True)
        listed = ", ".join(f"{count} {name}" for name, count in zip(names, counts, strict=True))
        return f"<{len(self)} events: {listed}>" if listed else "<no events>"

    def _repr_html_(self) -> str:
        """Return a table for notebooks: the first events."""
        names = self._run.scene.ball_names
        rows = []
        for one in itertools.islice(self, HTML_ROWS):
            place = np.concatenate([np.asarray(one.after.position), one.after.velocity])
            rows.append((f"{one.t:.6g}", names[one.ball], one.kind, one.name, *(f"{x:.4g}" for x in place)))
        heads = ("t, s", "ball", "event", "with", "x, m", "y", "z", "v_x, m/s", "v_y", "v_z")
        rest = f"and {len(self) - HTML_ROWS:,} more" if len(self) > HTML_ROWS else ""
        return Listing(heads, rows, rest)._repr_html_()


def _event(run: RunRecord, row: Any) -> Event:
    i, met, other = int(row["ball"]), int(row["met"]), int(row["other"])
    x = np.array(row["x"])
    before = State.of(np.array(row["v_before"]), np.array(row["w_before"]), x)
    after = State.of(np.array(row["v"]), np.array(row["w"]), x)
    names = partner_names(run.scene, met)
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
            run.kinetic_energy(i, before.velocity, before.spin) - run.kinetic_energy(i, after.velocity, after.spin)
        ),
    )


# ----------------------------------------------------------------------------------------------------
# The result of a run: its events, and the exact state of every ball at any time.


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


# ----------------------------------------------------------------------------------------------------
# The energy budget of a run: what was lost at walls, at the floor, between balls, and in between.


class Budget(NamedTuple):
    """Energies of a run, J: at the start, lost where, at the end."""

    start: float
    walls: float
    floor: float
    """In landings."""
    balls: float
    """Where balls meet, and at walls that they touch meanwhile."""
    way: float
    """Between events: by sliding and rolling on the floor, and in bounces that are summed (phase bouncing)."""
    end: float


def budget(run: Trajectory) -> Budget:
    """Return the energy at the start, what was lost where, and what is left (kinetic and potential, as ``run.energy``).

    A ball that left, or is held, counts with the energy that it had last.
    """
    log = run.log
    before, after = (run.kinetic_energy(log["ball"], log[f"v{when}"], log[f"w{when}"]) for when in ("_before", ""))
    lost = np.asarray(before - after)
    start, end, kinds = run.start, run.final, first_kinds(log)
    walls, floor, balls = (float(lost[kinds == kind].sum()) for kind in (WALL, FLOOR, BALL))
    e0, e1 = _energy(run, start), _energy(run, end)
    return Budget(e0, walls, floor, balls, e0 - e1 - walls - floor - balls, e1)


def _energy(run: Trajectory, state: Any) -> float:
    balls = run.scene.balls
    base = np.array([[0.0, 0.0, ball.radius if run.scene.floor is not None else 0.0] for ball in balls])
    lift = -((state.position - base) * np.array(run.scene.pull)).sum(axis=1) * np.array([ball.mass for ball in balls])
    return float(np.sum(run.kinetic_energy(slice(None), state.velocity, state.spin) + lift))


# ----------------------------------------------------------------------------------------------------
# Read a run from a file that :meth:`carom.Trajectory.save` wrote; all numbers have the same bits.


def load_trajectory(path: str | Path, *, allow_own_laws: bool = False) -> Trajectory:
    """Read a run from a file that :meth:`Trajectory.save` wrote; every number has the same bits.

    Parameters
    ----------
    path : str or Path
        A .parquet file (the extra ``parquet``).
    allow_own_laws : bool, optional
        Whether a custom law, a Python file that the stored scene names, is run. Default: it is refused, so that opening a file runs
        no code.

    Returns
    -------
    Trajectory. Raises CaromError, one line, for a file that is missing, damaged, of another kind, or of a newer format.

    Examples
    --------
    >>> import carom
    >>> carom.load_trajectory("run.csv")
    Traceback (most recent call last):
    carom.errors.CaromError: run.csv: expected a name that ends with .parquet, got '.csv'
    """
    path = as_path("load_trajectory", path)
    if path.suffix.lower() not in FORMATS:
        raise CaromError(f"{path}: expected a name that ends with {' or '.join(FORMATS)}, got {path.suffix!r}")
    open_regular(path, "a run that carom saved").close()
    try:
        about, fields = _from_parquet(path)
    except UnicodeDecodeError:
        raise _damaged(path, "one with invalid characters") from None
    log = np.zeros(len(fields["t"]), LOG)
    for field, values in fields.items():
        log[field] = _codes(path, field, values) if field in NAMED else values
    try:
        whole_as_saved = about["sha256"] == digest_of(log, about)
    except (KeyError, TypeError, ValueError):
        raise _damaged(path, "one with an unreadable description") from None
    if not whole_as_saved:
        raise _damaged(path, "one that was changed since it was saved")
    try:
        table = json.loads(about["scene"])
    except (TypeError, ValueError, RecursionError):
        raise _damaged(path, "one with an unreadable scene") from None
    scene = from_file(f"{path}: scene", Scene, table, allow_own_laws=allow_own_laws)
    _require_possible(path, scene, log, float(about["end"]), str(about["ended"]))
    return Trajectory(scene, log, float(about["end"]), str(about["ended"]))


def _require_possible(path: Path, scene: Scene, log: NDArray[Any], end: float, ended: str) -> None:
    """Raise CaromError, a line a column, for numbers that no run has: a file that other code wrote, with the right checksum."""
    faults, count, t = FaultList(str(path)), len(scene.balls), log["t"]
    if not (0 <= end < np.inf and ended in ENDS):
        faults.add("end", f"a time in s, and one of {', '.join(ENDS)}", f"{end!r}, {ended!r:.40}")
    if len(log) < count:
        faults.add("ball", f"rows for all of {count} balls", f"{len(log)}")
    faults.raise_if_any()
    most, features = np.zeros(len(log), int), len(scene.features())
    for met, names in PARTNERS.items():
        most[log["met"] == met] = len(getattr(scene, names))
    number = np.arange(len(log))
    begins, of = number < count, log["ball"]
    rules = {
        "t": (np.isfinite(t) & (t >= 0) & (t <= end) & (np.diff(t, prepend=0) >= 0), f"times that rise from 0 to {end:.9g} s"),
        "ball": ((of >= 0) & (of < count) & (~begins | (of == number)), f"first 0 to {count - 1} in order, then one of them"),
        "kind": (begins == (log["kind"] == START), f"the start of each of {count} balls, and then events"),
        "other": ((log["other"] >= np.where(most, 0, -1)) & ((log["other"] < most) | (most == 0)), "a number of the scene"),
        "regime": ((log["regime"] >= NO_REGIME) & (log["regime"] < len(REGIME_NAMES)), f"{NO_REGIME} to {len(REGIME_NAMES) - 1}"),
        "borne_by": ((log["borne_by"] >= -1) & (log["borne_by"] <= features), f"-1 to {features}"),
        "required": (~(log["required"] < 0), "a number >= 0"),
        **{name: (np.isfinite(log[name]).all(axis=1), "finite numbers") for name in VECTORS},
    }  # fmt: skip
    for name, (good, expected) in rules.items():
        if not good.all():
            row = int(np.argmin(good))
            faults.add(f"{name}, row {row}", expected, f"{log[name][row].tolist()!r}")
    faults.raise_if_any()


def _damaged(path: Path, what: str) -> CaromError:
    return CaromError(f"{path}: expected an undamaged file that carom saved, got {what}; save the run again")


def _known_format(path: Path, about: dict[str, Any]) -> None:
    """CaromError for a file of a later carom. First of all: its columns may be others."""
    number = about.get("carom_format")
    if not isinstance(number, int):
        raise _damaged(path, "no number of its format")
    if number > FORMAT:
        raise CaromError(
            f"{path}: expected format {FORMAT}, which this carom ({version()}) reads, got format {number} of carom"
            f" {about.get('carom')}; use that one or a later one"
        )


def _from_parquet(path: Path) -> tuple[dict[str, Any], dict[str, Any]]:
    pa = import_optional("pyarrow", path.name)
    pq = import_optional("pyarrow.parquet", path.name)
    try:
        with pq.ParquetFile(path) as file:
            text = (file.schema_arrow.metadata or {}).get(b"carom")
            if text is None:
                raise CaromError(
                    f"{path}: expected a run that carom saved, got a Parquet file without one; Trajectory.save writes one"
                )
            about = json.loads(text)
            _known_format(path, about)
            require_unpacked_size(path, file.metadata.num_rows * LOG.itemsize)
            names = list(log_columns(np.zeros(0, LOG)))
            if missing := [name for name in names if name not in file.schema_arrow.names]:
                raise _damaged(path, f"none of the column{'s' if len(missing) > 1 else ''} {', '.join(missing)}")
            table = file.read(names)
    except (pa.ArrowException, OSError) as error:
        raise CaromError(f"{path}: expected an undamaged Parquet file, got: {str(error).splitlines()[0]}") from None
    except (ValueError, RecursionError, AttributeError) as error:  # (no JSON, too deep, too long a number, no table)
        if isinstance(error, CaromError | UnicodeDecodeError):
            raise
        raise _damaged(path, "one with an unreadable description") from None
    fields: dict[str, Any] = {}
    for field in LOG.names or ():
        if field in VECTORS:
            parts = [_numbers(path, table, name) for name in VECTORS[field]]
            fields[field] = np.stack(parts, axis=1)
        elif field in NAMED:
            fields[field] = table.column(field).to_pylist()
        else:
            fields[field] = _numbers(path, table, SCALARS[field], "if" if LOG[field].kind == "f" else "i")
    return about, fields


def _numbers(path: Path, table: Any, name: str, kinds: str = "if") -> NDArray[Any]:
    column = table.column(name)
    values: NDArray[Any] = column.to_numpy()
    if column.null_count or values.dtype.kind not in kinds:
        raise _damaged(path, f"a column {name!r} that is not all numbers")
    return values


def _codes(path: Path, field: str, names: list[Any]) -> list[int]:
    known = {name: code for code, name in enumerate(NAMED[field])}
    with suppress(KeyError, TypeError):
        return [known[name] for name in names]
    unknown = next(name for name in names if name not in known)
    raise _damaged(path, f"a {field} {unknown!r}")
