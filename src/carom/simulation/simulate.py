"""Simulate a scene: one run with all its events, or many runs on all cores."""

from __future__ import annotations

import functools
import math
import sys
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from carom.bodies import Numbers, State
from carom.core.geometry.features import FEATURES
from carom.core.jit.calls import caller_of, compiled_address
from carom.core.jit.compile import array_of, njit, signature
from carom.core.jit.kernel import kernel, prange, vector
from carom.core.jit.threads import Pace, block_slices
from carom.core.motion.phases import PHASES
from carom.errors import CaromError, FaultList, require_count, require_type
from carom.files import memory_left, require_memory
from carom.formatting import counted, format_number
from carom.laws.law import Law
from carom.laws.registry import laws
from carom.public.progress import Progress, loop_callback
from carom.scene.scene import Run, Scene
from carom.scene.toml import load_scene, replaced
from carom.scene.wall import law_name
from carom.simulation.contact_kinds import ALL_REFUSALS, DONE, wall_normal
from carom.simulation.files import kinetic_energy, many_events_table
from carom.simulation.loop import (
    ADVANCE,
    ENGINE_RUN,
    FIRST_ROWS,
    LIMIT,
    PHASES_FROM,
    QUIET,
    compiled_engine,
    rows_of_an_event,
    run_limits,
    run_scene,
)
from carom.simulation.motion import write_vector
from carom.simulation.records import (
    BALL,
    BALLS,
    CLUSTERS,
    EVENT_KINDS,
    IN_CLUSTER,
    KINDS,
    LOG,
    PHASE,
    START,
    WALL,
    WALL_IN_CLUSTER,
    WORLD,
    SceneArrays,
    are_in_clusters,
    set_up,
    starts_of,
)
from carom.simulation.trajectory import Trajectory

if TYPE_CHECKING:
    import pandas

# Codes of events: kinds, and from PHASES_FROM on the phases that begin.
CODES = PHASES_FROM + len(PHASES)
# In the place after the last code stands how many rows were kept, where the first ones are.
ROWS_KEPT = CODES
PARTS = 64  # of the runs that threads take
LOG_ROWS = 128  # of the log of a thread, which is read and emptied again and again


def empty_logs(parts: int, rows: int = LOG_ROWS) -> NDArray[np.void]:
    """Return the logs of so many parts of the runs."""
    return np.empty((parts, rows), LOG)


def empty_counts(runs: int) -> NDArray[np.int64]:
    """Return the counts of events of so many runs, by code, and of the rows kept."""
    return np.zeros((runs, CODES + 1), np.int64)


@kernel
def _copy(to: Any, row: Any) -> None:
    """Copy a row of a log."""
    to.t, to.kind, to.ball, to.met, to.other = row.t, row.kind, row.ball, row.met, row.other
    write_vector(to.x, vector(row.x))
    write_vector(to.v_before, vector(row.v_before))
    write_vector(to.w_before, vector(row.w_before))
    write_vector(to.v, vector(row.v))
    write_vector(to.w, vector(row.w))
    to.phase_before, to.phase = row.phase_before, row.phase
    write_vector(to.impulse, vector(row.impulse))
    write_vector(to.floor_impulse, vector(row.floor_impulse))
    to.required, to.regime = row.required, row.regime


@kernel
def _keep_rows(log: Any, rows: int, wanted: Any, counts: Any, kept: Any) -> None:
    """Count the events of a log by their codes, and keep some of them: this is all that remains of a run's log.

    Kept are those that are wanted, (W, 2) code and which of its kind, in W places; with W = 0 the first ones, as many as there are
    places.
    """
    for r in range(rows):
        code = PHASES_FROM + log[r].phase if log[r].kind == PHASE else log[r].kind
        code = WALL if code == WALL_IN_CLUSTER else code
        for j in range(wanted.shape[0]):
            if wanted[j, 0] == code and wanted[j, 1] == counts[code]:
                _copy(kept[j], log[r])
        counts[code] += 1
    if wanted.shape[0] == 0:
        for r in range(min(rows, kept.shape[0] - counts[ROWS_KEPT])):
            _copy(kept[counts[ROWS_KEPT]], log[r])
            counts[ROWS_KEPT] += 1


# What the loop returns and takes.
LOOP = (
    None, int, array_of(WORLD), array_of(FEATURES, 2), array_of(BALLS, 2), array_of(LOG, 2), array_of(float), float, int,
    int, array_of(int), int, array_of(int, 2), array_of(int, 2), array_of(LOG, 2), array_of(int, 2),
)  # fmt: skip


# The compiled event loop, called through its address, once there is one: single runs, many runs and runs with derivatives share
# the machine code of one engine.
_call_run: Any = None


def _many(
    engine: int, worlds: Any, features: Any, balls: Any, logs: Any, slow: Any, until: float, most: int, share: int, users: Any,
    keep: int, wanted: Any, counts: Any, kept: Any, ended: Any,
) -> None:  # fmt: skip
    """Continue every run of ``balls`` (N, B) by at most ``share`` events.

    ``engine``: address of the event loop; ``worlds`` (1 or N,), ``features`` (1 or N, F): of all runs, or of each; ``logs``
    (T, rows): of each of T parts of the runs; ``counts`` (N, CODES + 1) and ``kept`` (N, W): :func:`_keep_rows`; ``ended`` (N, 2):
    status and number of events. A run goes on while its status is LIMIT, with fewer than ``most`` events.
    """
    total, parts = balls.shape[0], logs.shape[0]
    for part in prange(parts):
        log = logs[part]
        for n in range(part, total, parts):  # (neighbours cost about the same: every part has its share of them)
            here = n if worlds.shape[0] > 1 else 0
            shape = features[n if features.shape[0] > 1 else 0]
            left = min(share, most - ended[n, 1])
            while ended[n, 0] == LIMIT and left > 0:
                # (a full log loses rows, and one event may write several of them)
                many = rows_of_an_event(balls.shape[1], shape.shape[0], keep, log.shape[0])
                step = min(left, log.shape[0] // many) if keep != 0 else left
                status, events, rows, _ball, slow[n], last = _call_run(
                    engine, (worlds[here : here + 1], shape, balls[n], log, slow[n], until, step, users, keep)
                )
                _keep_rows(log, rows, wanted, counts[n], kept[n])
                left -= events
                ended[n, 0], ended[n, 1] = status, ended[n, 1] + events
                if status != LIMIT or ended[n, 1] >= most:
                    end = until if until < math.inf and status in (DONE, QUIET) else last
                    _call_run(
                        engine, (worlds[here : here + 1], shape, balls[n], log, slow[n], end, ADVANCE, users, keep)
                    )


@functools.cache
def _declare_calls() -> None:
    """Tell the compiler what the loop calls by address."""
    global _call_run  # noqa: PLW0603
    _call_run = caller_of(*ENGINE_RUN)


@functools.cache
def compiled_many() -> Callable[..., None]:
    """Return the compiled loop, which uses all cores."""
    loop = njit(_many, signature(*LOOP), (_declare_calls,), parallel=True)
    return functools.partial(loop, compiled_address(compiled_engine()))


# ----------------------------------------------------------------------------------------------------
# The result of many runs of one scene: final states, and selected events of each.


@dataclass(frozen=True, eq=False, repr=False)
class ManyRuns:
    """Final states of N runs of B balls, and selected events, at most M per run.

    Examples
    --------
    >>> import carom
    >>> ball = carom.SceneBall(radius=0.03, mass=0.2, position=(0, 0))
    >>> scene = carom.Scene(floor=carom.Floor(friction=0.2, rolling_resistance=0.01), balls=[ball])
    >>> runs = carom.simulate_many(scene, velocity=[[1, 0, 0], [2, 0, 0]], events=2)
    >>> runs
    <ManyRuns: 2 runs of 1 ball, 4 events kept>
    >>> runs.final.position[:, 0, 0].round(3), runs.count
    (array([ 2.726, 10.905]), array([2, 2]))
    >>> runs.table()[["run", "t", "kind"]].round(3).values.tolist()
    [[0, 0.146, 'rolling'], [0, 7.429, 'rest'], [1, 0.291, 'rolling'], [1, 14.859, 'rest']]
    """

    final: State
    """(N, B, 3)."""
    code: NDArray[np.int64]
    """(N, B): final phases as numbers; ``phase`` has their names."""
    end: NDArray[np.float64]
    """(N,), s: time up to which each run was followed."""
    count: NDArray[np.int64]
    """(N,): number of events."""
    why: NDArray[np.str_]
    """(N,): empty, or why a run ended at an event for which a law has no answer."""
    events: NDArray[np.void]
    """(N, M) rows of the log, the first M selected events of each run (M: ``events``; above a thousand, what the longest has):
    ``t``, ``ball``, ``x``, ``v_before``, ``w_before``, ``v``,
    ``w`` and more; :meth:`table` has names for what is a number here. ``kind``: 1 wall, 2 floor, 3 ball, 4 another phase begins,
    5 settled, 6 left, 7 held, 9 pocketed; 0, with ``t`` NaN, where a run has fewer events. ``other``: number of the wall, ball or
    pocket, or -1. ``phase``, ``phase_before``: 0 flight, 1 sliding, 2 rolling, 3 pivoting, 4 rest, 5 bouncing, 6 held, 7 left,
    8 pocketed. ``regime``: 0 graze, 1 stick, 2 slide, 3 jam, -1 none."""
    scene: Scene = field(kw_only=True)
    """The scene; the runs have other starts than its balls."""

    @property
    def phase(self) -> NDArray[np.str_]:
        """(N, B): flight, sliding, rolling, pivoting, rest, bouncing, held, left, pocketed."""
        return np.array(PHASES)[self.code]

    def kinetic_energy(self, ball: Any, velocity: NDArray[np.float64], spin: NDArray[np.float64]) -> Numbers:
        """Return the kinetic energies, J, of balls given by number (N,) at velocities and spins (N, 3)."""
        return kinetic_energy(set_up(self.scene, compiled=False).balls, ball, velocity, spin)

    def table(self) -> pandas.DataFrame:
        """Return the events as a pandas DataFrame, one row each, with the columns of ``run.events.table()`` after ``run``.

        CaromError without pandas.
        """
        return many_events_table(self, self.events)

    to_pandas = table

    def __repr__(self) -> str:
        """Return one line."""
        runs, balls = self.code.shape
        kept = int((self.events["kind"] != START).sum())
        refused = int((self.why != "").sum())
        more = f", {refused:,} without an answer of the law" if refused else ""
        return f"<ManyRuns: {counted(runs, 'run')} of {counted(balls, 'ball')}, {counted(kept, 'event')} kept{more}>"


# ----------------------------------------------------------------------------------------------------
# Simulate a scene: one run with all its events, or many runs on all cores.


# Events of all runs of a block in the first call of the compiled loop.
FIRST_EVENTS = 1 << 16


def simulate(
    scene: Scene | str | Path,
    progress: Progress | None = None,
    *,
    law: str | Law | None = None,
    duration: float | str | None = None,
    max_events: int | None = None,
) -> Trajectory:
    """Simulate a scene event by event.

    Parameters
    ----------
    scene : Scene, or what :func:`carom.load_scene` takes: the name of a scene file, or of a real table, such as "pool-9ft"
        The run ends after ``scene.run.duration``, after ``scene.run.max_events``, or when no event follows; with neither given,
        after 100,000 events at most.
    progress : callable(done, total, text), optional
        Called from time to time on long runs: events so far, their greatest number or NaN, the simulated time.
    law : str or carom.Law, optional
        Law of all walls that name none of their own; default: the scene's, ``scene.run.law``.
    duration, max_events : s or text with a unit; whole number; optional
        When to stop, in place of what the scene says.

    Returns
    -------
    Trajectory
        The same bits on every run, interpreted or compiled.

    Raises CaromError for an event for which a law has no answer, and for a law that the scene cannot have.

    Examples
    --------
    >>> import carom
    >>> wall = carom.scene.Plane(point=(0, 0, 0), normal=(1, 0, 0), restitution=0.85, friction=0.2)
    >>> ball = carom.SceneBall(radius=0.03, mass=0.2, position=(1, 0), velocity=(-2, 1), rolling=True)
    >>> scene = carom.Scene(floor=carom.Floor(friction=0.2), walls=[wall], balls=[ball], run=carom.Run(duration=2))
    >>> run = carom.simulate(scene)
    >>> run.events.kinds
    ['wall', 'floor', 'rolling']
    >>> run.final.velocity.round(3)
    array([[1.051, 0.796, 0.   ]])
    >>> carom.simulate(scene, law="maw").final.velocity.round(3)
    array([[1.116, 0.764, 0.   ]])
    """
    if not isinstance(scene, Scene):
        scene = load_scene(scene) if isinstance(scene, str | Path) else scene
        remedy = "carom.Scene(**scene) makes one" if isinstance(scene, Mapping) else ""
        require_type("simulate", "scene", scene, Scene, remedy)
    if law is not None or duration is not None or max_events is not None:
        scene = _with_settings(scene, {"law": law, "duration": duration, "max_events": max_events})
    if progress is None:
        return Trajectory(*run_scene(scene))
    most = math.nan if scene.run.max_events is None else float(scene.run.max_events)
    return Trajectory(*run_scene(scene, lambda events, t: progress(events, most, f"{t:.4g} s")))


def _with_settings(scene: Scene, settings: dict[str, Any]) -> Scene:
    """Return the scene with what is given of the settings of its run."""
    given = {name: value for name, value in settings.items() if value is not None}
    try:
        run = Run(**given)
    except CaromError as error:
        raise CaromError(*(fault.replace("Run:", "simulate:", 1) for fault in error.faults)) from None
    return replaced(scene, {f"run.{name}": getattr(run, name) for name in given})


def simulate_many(
    scene: Scene,
    velocity: ArrayLike | None = None,
    spin: ArrayLike | None = None,
    position: ArrayLike | None = None,
    *,
    events: int = 0,
    kinds: tuple[str, ...] = (),
    progress: Progress | None = None,
) -> ManyRuns:
    """Simulate a scene from many initial states, on all cores, each run independently.

    Parameters
    ----------
    scene : Scene
    velocity, spin, position : array (N, B, 3), or (N, 3) for a scene of one ball only, optional
        Initial velocities (m/s), spins (rad/s) and positions (m); default: the scene's. One run's, (1, B, 3), are those of all.
        A ball that is to roll at another velocity than the scene's needs its spin too: that of :func:`carom.rolling`.
    events : int
        How many events of each run to keep, the first ones; default: none. Of more than a thousand only those take memory that
        the longest run has.
    kinds : tuple of str
        Kinds of events to keep, such as "wall"; default: all.
    progress : callable(done, total, text), optional
        Called with the number of runs done, and of all.

    Returns
    -------
    ManyRuns
        Bitwise identical whatever the number of cores.

    Raises
    ------
    CaromError
        For initial states that overlap a wall or another ball, for unknown kinds, and for events that would fill 8 GB.

    Examples
    --------
    >>> import carom
    >>> wall = carom.scene.Plane(point=(0, 0, 0), normal=(1, 0, 0))
    >>> ball = carom.SceneBall(radius=0.03, mass=0.2, position=(1, 0, 0))
    >>> scene = carom.Scene(gravity=0, walls=[wall], balls=[ball], run=carom.Run(law="mirror", duration=2))
    >>> carom.simulate_many(scene, velocity=[[-1, 0, 0], [-2, 0, 0]]).final.velocity[:, 0, 0]
    array([1., 2.])
    """
    require_type("simulate_many", "scene", scene, Scene)
    faults = FaultList("simulate_many")
    faults.attempt(require_count, "simulate_many", "events", events, 0)
    names = ("start", "phase", "nothing", *EVENT_KINDS)
    for kind in kinds:
        if kind not in names:
            faults.add(
                "kinds",
                f"kinds of events ({', '.join(sorted(EVENT_KINDS))})",
                repr(kind),
            )
    faults.raise_if_any()
    tell = loop_callback(progress, lambda now: lambda done, total: now(done, total, "runs"))
    arrays = set_up(scene)
    balls = starts_of("simulate_many", scene, arrays, velocity, spin, position)
    return run_starts(scene, arrays._replace(balls=balls), int(events), kinds, tell)


# Runs that are done in one go: enough to keep all cores busy, few enough that memory stays small.
BLOCK = 16_384
# So many events of each run have their places from the beginning; of more, those that happen.
WHOLE_EVENTS = 1000
# For how many events the logs have room when the loop is called, at least.
LEAST_SHARE = 64
MAX_KEPT_BYTES = 8e9


def _bits(kinds: tuple[str, ...]) -> int:
    """The loop's ``keep`` for kinds of events by name."""
    bits = 0
    for kind in kinds or tuple(KINDS[1:]) + PHASES:
        bits |= 1 << (KINDS.index(kind) if kind in KINDS else PHASES_FROM + PHASES.index(kind))
    return bits | ((bits >> BALL) & 1) << IN_CLUSTER


def run_starts(
    scene: Scene, arrays: SceneArrays, events: int, kinds: tuple[str, ...], progress: Any = None
) -> ManyRuns:
    """Run the starts ``arrays.balls`` (N, B), which it moves: :func:`simulate_many` of states that are checked."""
    many, bits, (until, most) = compiled_many(), _bits(kinds) if events else 0, run_limits(scene)
    balls, total = arrays.balls, len(arrays.balls)
    advice = "keep fewer, choose kinds, or run the starts in parts"
    require_memory(
        "simulate_many", "events", total * min(events, WHOLE_EVENTS), 2 * LOG.itemsize, advice, MAX_KEPT_BYTES
    )
    ended, slow, written = np.zeros((total, 2), np.int64), np.full(total, -1.0), empty_counts(total)
    ended[:, 0] = LIMIT
    kept: list[NDArray[np.void]] = []
    room = events if events <= WHOLE_EVENTS else FIRST_ROWS
    shape = len(scene.balls), len(arrays.features)
    longest = max(LOG_ROWS, rows_of_an_event(*shape, bits, sys.maxsize))
    one, first_ones = rows_of_an_event(*shape, bits, longest), np.empty((0, 2), np.int64)
    logs = empty_logs(min(PARTS, total), longest)
    for block in block_slices(total, BLOCK):
        rows, here, counts = np.zeros((block.stop - block.start, room), LOG), ended[block], written[block]
        pace, goes_on = Pace(FIRST_EVENTS), np.ones(len(rows), bool)
        while goes_on.any():  # (a few events of every run at a time)
            share = max(pace.begin() // len(rows), 1)
            if rows.shape[1] < events:
                longest = int(counts[goes_on, ROWS_KEPT].max())
                rows = _with_room(rows, longest, events, total, one)
                if rows.shape[1] < events:
                    share = min(share, (rows.shape[1] - longest) // one)
            many(
                arrays.world, arrays.features[None], balls[block], logs, slow[block], until, most, share, arrays.users, bits,
                first_ones, counts, rows, here,
            )  # fmt: skip
            pace.done(share * len(rows))
            goes_on = (here[:, 0] == LIMIT) & (here[:, 1] < most)
        used = events if events <= WHOLE_EVENTS else int(counts[:, ROWS_KEPT].max())
        kept.append(np.ascontiguousarray(rows[:, :used]))
        if progress is not None:
            progress(block.stop, total)
    first = _side_by_side(kept) if kept else np.zeros((0, events if events <= WHOLE_EVENTS else 0), LOG)
    first["t"][first["kind"] == START] = math.nan  # (no event is at no time: the least of a column is that of events)
    why = np.array([ALL_REFUSALS.get(int(code), "") for code in ended[:, 0]])
    final = State.of(np.array(balls["v"]), np.array(balls["w"]), np.array(balls["x"]))
    return ManyRuns(
        final, np.array(balls["phase"]), balls["clock"].max(axis=1), ended[:, 1].copy(), why, first, scene=scene
    )


def _with_room(logs: NDArray[np.void], written: int, room: int, total: int, one: int) -> NDArray[np.void]:
    """Return logs with room for events of ``one`` row at most after ``written`` rows, at most ``room``; CaromError if too large."""
    if logs.shape[1] - written >= one * LEAST_SHARE:
        return logs
    rows = min(room, 4 * logs.shape[1], int(min(MAX_KEPT_BYTES, memory_left()) / LOG.itemsize / total))
    if rows < min(room, written + one * LEAST_SHARE):
        raise CaromError(
            f"simulate_many: events: expected runs of no more than {rows:,} events, which fill {MAX_KEPT_BYTES / 1e9:g} GB, of"
            f" {counted(total, 'run')}, got one with more than {written:,}; keep fewer, choose kinds, or run the starts in parts"
        )
    found = np.zeros((len(logs), rows), LOG)
    found[:, : logs.shape[1]] = logs
    return found


def _side_by_side(parts: list[NDArray[np.void]]) -> NDArray[np.void]:
    """Return the logs of all blocks as one array, as wide as the widest."""
    if len(parts) == 1:
        return parts[0]
    found = np.zeros((sum(map(len, parts)), max(part.shape[1] for part in parts)), LOG)
    first = 0
    for part in parts:
        found[first : first + len(part), : part.shape[1]] = part
        first += len(part)
    return found


# ----------------------------------------------------------------------------------------------------
# Objections of a run to the laws of its walls and pairs: energy created, balls left moving into what they have met.


ROUNDING = 1e-9  # of the energy, or the speed
LOOKED_AT = 1000  # contacts of a law, for the direction in which balls leave


def law_notes(run: Trajectory) -> list[str]:
    """Return a line for each law that creates energy, and for each custom one that leaves a ball moving into what it has met."""
    rows = run.log[(run.log["kind"] == WALL) & ~are_in_clusters(run.log)]
    names = np.array([law_name(law) for law in run.scene.wall_laws], dtype=object)[rows["other"]]
    found = []
    for name in dict.fromkeys(names):
        own = rows[names == name]
        found += _created(run, name, own, own[:0])
        if name not in laws() and (row := _into_the_wall(run, own[:LOOKED_AT])) is not None:
            found.append(
                f"law {name} leaves the ball moving into the wall: first {_where(run, row)}; expected n . v >= 0 after it"
            )
    return found + _notes_on_pairs(run)


def _notes_on_pairs(run: Trajectory) -> list[str]:
    """Return the lines on the law by which two balls meet, where no contacts overlap in time."""
    name = law_name(run.scene.ball_contact.law)
    kinds = np.append(run.log["kind"], START)
    first = np.flatnonzero(kinds == BALL)[::2]
    first = first[~np.isin(kinds[first + 2], CLUSTERS)]
    rows, others = run.log[first], run.log[first + 1]
    found = _created(run, name, rows, others)
    n, v = rows["x"] - others["x"], rows["v"] - others["v"]
    sizes = np.linalg.norm(n, axis=1) * (np.linalg.norm(rows["v"], axis=1) + np.linalg.norm(others["v"], axis=1))
    meets = np.flatnonzero((n * v).sum(axis=1) < -ROUNDING * sizes)
    if name not in laws() and len(meets):
        where = _where(run, rows[meets[0]])
        found.append(f"law {name} leaves two balls moving into each other: first {where}; expected n . v >= 0 after it")
    return found + _replaced(run, name, int(np.unique(run.log["t"][np.isin(run.log["kind"], CLUSTERS)]).size))


def _replaced(run: Trajectory, name: str, clusters: int) -> list[str]:
    """Return a line where contacts of balls that overlap in time did not have the law of the pair, but friction alone."""
    contact = run.scene.ball_contact
    law = laws().get(name)
    if not clusters or not ((law is None or not law.one_contact) or contact.tangential_restitution != 0):
        return []
    what = f"law {name}" if law is None or not law.one_contact else "tangential restitution"
    return [
        f"{what} did not act in {counted(clusters, 'event')} in which contacts overlap in time: friction there is Coulomb's, and a"
        " contact whose slip ends goes on without slip (0.006 to 0.017 of the speed from contacts that store slip, at a friction of"
        " 0.05)"
    ]


def _created(run: Trajectory, name: str, rows: Any, others: Any) -> list[str]:
    """Return a line if a law creates energy in contacts; ``others`` are the second balls, where balls meet."""
    with np.errstate(over="ignore", invalid="ignore"):  # (a law that doubles speeds soon has no number for the energy)
        before, after = (
            sum(np.asarray(run.kinetic_energy(x["ball"], x[v], x[w])) for x in (rows, others) if len(x))
            for v, w in (("v_before", "w_before"), ("v", "w"))
        )
        gained = np.asarray(after - before)
        created = gained > ROUNDING * before
    if not created.any():
        return []
    in_all = f"{counted(int(created.sum()), 'contact')}, {format_number(float(gained[created].sum()))} J in all"
    first = int(created.argmax())
    where, energy = _where(run, rows[first]), format_number(float(gained[first]))
    return [f"law {name} creates energy: first {where}, {energy} J; {in_all}"]


def _where(run: Trajectory, row: Any) -> str:
    names = run.scene.ball_names if row["met"] == BALL else run.scene.wall_names
    return f"at t = {float(row['t']):.4g} s, {run.scene.ball_names[row['ball']]} at {names[row['other']]}"


def _into_the_wall(run: Trajectory, rows: Any) -> Any:
    """Return the first of a log's rows after which a ball moves into the wall that it has met; None for none."""
    features = run.scene.features().view(np.recarray)
    for row in rows:
        n = np.array(wall_normal(features, row, run.scene.balls[row["ball"]].radius))
        if n @ row["v"] < -ROUNDING * np.linalg.norm(row["v"]):
            return row
    return None
