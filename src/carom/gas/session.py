"""Sessions: a gas equilibrated and measured as its scene says, in pieces, saved and continued."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from carom.errors import MAX_MAGNITUDE, CaromError, Fault, suggestion
from carom.formatting import counted
from carom.gas.edmd.driver import BINS_PER_BALL, STATE, SystemRecords
from carom.gas.edmd.gas_records import NO_BALL
from carom.gas.edmd.walls import FIRST_WALL, PREDICT_AGAIN
from carom.gas.gas import Gas, records_of
from carom.gas.initial import dense
from carom.gas.measures import MAX_FOLLOWED, SERIES, Measures
from carom.gas.results import (
    AT_REST,
    TOTALS,
    EarlyEnd,
    EndedEarlyError,
    Every,
    GasRun,
    LogTimes,
    Mark,
    next_due,
    spread_time,
)
from carom.gas.scene import GasScene
from carom.gas.snapshots import InitialState, read_initial_state
from carom.gas.species import LONGEST_SIDE
from carom.public.other_rooms import figure_maker
from carom.public.progress import Progress, loop_callback

if TYPE_CHECKING:
    from matplotlib.figure import Figure

State = dict[str, NDArray[Any]]
Arrays = Mapping[str, NDArray[Any]]
# What a session keeps of its course, beside the gas and its measures: whole numbers, and times.
COUNTS = ("first_collision", "last_sample_collisions", "sample_interval", "snapshots_taken", "snapshots_by_time")
CLOCK = ("sample_due", "last_sample_time", "snapshot_due")
# What measures count, and what their profiles count.
MEASURED = (
    "velocity_counts", "spin_counts", "fourth_moments", "temperatures", "pair_counts", "expected_pairs", "samples",
    "pair_samples", "rows", "followed",
)  # fmt: skip
PROFILED = (
    "profile_counts", "profile_heat", "profile_centers", "profile_inner", "profile_samples", "profile_pair_samples",
)  # fmt: skip
# Of the gas when the measurement began: the arrays that have the form of the gas's own.
MARKED = ("system", *TOTALS)


# --- as arrays -----------------------------------------------------------------------------------------------------


def course_as_arrays(session: Any) -> State:
    """Return the state of a :class:`carom.gas.Session` without its gas."""
    found = {
        "session": np.array([getattr(session, name) for name in COUNTS], np.int64),
        "clock": np.array([getattr(session, name) for name in CLOCK]),
    }
    if session.mark is not None and session.measures is not None:
        mark, measures = session.mark, session.measures
        # (the processor time that the measurement has taken so far)
        numbers = np.array([*mark.energy, mark.time, session.result.cpu_seconds])
        begun = {"system": np.array([mark.system]), "numbers": numbers} | {name: getattr(mark, name) for name in TOTALS}
        found |= _named("mark.", begun) | _named("measures.", _counted(measures, MEASURED))
        if measures.profiles is not None:
            found |= _named("measures.", _counted(measures.profiles, PROFILED))
    return found


def _named(prefix: str, arrays: Arrays) -> State:
    return {prefix + name: array for name, array in arrays.items()}


def _counted(one: Any, names: tuple[str, ...]) -> State:
    return {name: np.array(getattr(one, name)) for name in names}


# --- from arrays ---------------------------------------------------------------------------------------------------


class _Part(Mapping[str, NDArray[Any]]):
    """The arrays whose names have a prefix, by the rest of the name; none is read before it is asked for."""

    def __init__(self, state: Arrays, prefix: str) -> None:
        self._state, self._prefix = state, prefix

    def __getitem__(self, name: str) -> NDArray[Any]:
        return self._state[self._prefix + name]

    def __iter__(self) -> Iterator[str]:
        return (name.removeprefix(self._prefix) for name in self._state if name.startswith(self._prefix))

    def __len__(self) -> int:
        return sum(1 for _ in self)


def gas_of_arrays(state: Arrays) -> Gas:
    """Return the gas in the state of a session."""
    return Gas.restore(_Part(state, "gas."))


def set_course(session: Any, state: Arrays) -> None:
    """Give a :class:`carom.gas.Session` that has its scene and its gas the rest of a state."""
    for names, kind in ((COUNTS, int), (CLOCK, float)):
        for name, value in zip(names, state["session" if kind is int else "clock"], strict=True):
            setattr(session, name, kind(value))
    session.mark, session.measures = None, None
    if (begun := _Part(state, "mark.")) and (counted := _Part(state, "measures.")):
        *energy, time, cpu = map(float, begun["numbers"])
        totals = (begun[name] for name in TOTALS)
        began = session.gas.cpu_seconds - cpu
        session.mark = Mark._make((begun["system"][0], *totals, (energy[0], energy[1], energy[2]), time, began))
        session.measures = Measures(session.gas, session.names, session.scene.container.geometry)
        _set_measures(session.measures, session.gas, counted)


def _set_measures(measures: Measures, gas: Gas, state: Arrays) -> None:
    """Let measures continue from what was counted."""
    samples = len(state["rows"])
    free = {"rows": (samples, len(SERIES)), "temperatures": (samples, len(measures.names), 2)}
    if samples == 0:
        free = dict.fromkeys(free, (0,))
    free["followed"] = state["followed"].shape
    _take(measures, MEASURED, state, free)
    moved = (samples, min(len(gas.arrays.balls.motions), MAX_FOLLOWED), measures.dimensions)
    if state["followed"].shape != (moved if measures.has_diffusion and samples else (0,)):
        raise ValueError(f"'followed' of shape {state['followed'].shape}, not {moved}")
    measures.rows = [tuple(row) for row in state["rows"].reshape(-1, len(SERIES)).tolist()]
    measures.followed, measures.temperatures = list(state["followed"]), list(state["temperatures"])
    if measures.profiles is not None:
        _take(measures.profiles, PROFILED, state, {})


def _take(one: Any, names: tuple[str, ...], state: Arrays, free: Mapping[str, tuple[int, ...]]) -> None:
    """Set attributes from arrays of the form that they have, or that ``free`` gives: numbers as whole numbers."""
    for name in names:
        fresh = np.array(getattr(one, name))
        require_same_form(name, state[name], fresh.dtype, free.get(name, fresh.shape))
    for name in names:
        setattr(one, name, int(state[name]) if isinstance(getattr(one, name), int) else state[name].copy())


# --- requirements --------------------------------------------------------------------------------------------------

# What changes while a gas runs, of records that the scene makes, and of the system what does not.
TOTAL = ("collisions", "lost_normal", "lost_tangential", "to_spin")
CHANGES = {
    "species": (), "pairs": TOTAL, "pair_forms": (), "contacts": TOTAL, "contact_forms": (), "shear": ("offset",), "curves": (),
    "faces": ("start", "offset", "speed", "since", "collisions", "impulse", "energy"),
}  # fmt: skip
FIXED = (
    "side", "periodic", "cells", "cell_size", "dimensions", "gravity", "contact_time", "volume", "scale", "growth", "key", "rate",
    "temperature", "spin_temperature",
)  # fmt: skip
MAY_BE_INFINITE = {"event_time", "collision_time", "last_contact", "overlap", "mu", "low", "high", "clock"}
MAY_BE_NEGATIVE = {"axis", "image", "key"}
SQUARED = {"motions", "bodies", "frame"}
OUTSIDE = 1e-6  # of a cell, by which rounding may have a ball outside its own


def require_state(scene: GasScene, state: Arrays) -> None:
    """Raise KeyError, TypeError or ValueError where an array of a session is missing, or has another form or other contents."""
    records, sizes = records_of(scene)
    forms = _forms(scene, records)
    if any(name.startswith("mark.") for name in state):
        forms |= {f"mark.{name}": forms[f"gas.{name}"] for name in MARKED}
        forms["mark.numbers"] = (np.dtype("f8"), (5,))
    for name in forms:
        if name not in state:
            raise KeyError(name)
    for name in state:  # (read from a file one at a time)
        array = state[name]
        if name in forms:
            require_same_form(name, array, *forms[name])
        _require_numbers(name.removeprefix("gas."), array)
        del array
    for name, changing in CHANGES.items():
        own = getattr(records, name)
        fields = [field for field in own.dtype.names or ("",) if field not in changing]
        for part in ("gas.", "mark."):  # (most are absent in a mark)
            _require_the_scenes(state.get(part + name, own.ravel()), name, own, fields)
    _require_the_scenes(state["gas.system"], "system", records.system, FIXED)
    _require_the_scenes(state["gas.whole"], "whole", records.whole, ("axis",))
    _require_the_scenes(state["gas.groups"], "groups", sizes.groups, ("",))
    _require_contents(scene, state, records.system[0])


def require_same_form(name: str, array: NDArray[Any], kind: np.dtype[Any], shape: tuple[int, ...]) -> None:
    """Raise TypeError where an array has other records, ValueError where it has another shape."""
    if array.dtype != kind and not (kind.kind == array.dtype.kind == "U"):
        raise TypeError(f"other records of {name.removeprefix('gas.')!r}")
    if array.shape != shape:
        raise ValueError(f"{name.removeprefix('gas.')!r} of shape {array.shape}, not {shape}")


def _forms(scene: GasScene, records: SystemRecords) -> dict[str, tuple[np.dtype[Any], tuple[int, ...]]]:
    """Return type and shape of every array of a gas and of its session, by name."""
    count = {name: getattr(records, name).size for name in records._fields}
    count |= dict.fromkeys(("motions", "bodies", "numbers"), scene.count) | {"plans": scene.count + 1}
    number, whole, text = np.dtype("f8"), np.dtype("i8"), np.dtype("U32")
    return {f"gas.{name}": (kind, (count[name],)) for name, kind in STATE.items()} | {
        "gas.names": (text, (len(records.faces),)), "gas.time": (number, (1,)), "gas.groups": (whole, (len(records.species),)),
        "session": (whole, (5,)), "clock": (number, (3,)),
    }  # fmt: skip


def _require_numbers(name: str, array: NDArray[Any]) -> None:
    """Raise ValueError for numbers that can be in no state: NaN, infinite ones, negative counts."""
    for field in array.dtype.names or ("",):
        values, what = array[field] if field else array, field or name
        if values.dtype.kind == "f" and not np.isfinite(values).all():
            if np.isnan(values).any() or what not in MAY_BE_INFINITE:
                raise ValueError(f"{name!r} with {what} that is {'NaN' if np.isnan(values).any() else 'infinite'}")
        elif (
            (name in SQUARED or what in SQUARED) and values.dtype.kind == "f" and (np.abs(values) > MAX_MAGNITUDE).any()
        ):
            raise ValueError(f"{name!r} with {what} beyond {MAX_MAGNITUDE:g}")
        elif values.dtype.kind == "i" and what not in MAY_BE_NEGATIVE and (values < 0).any():
            raise ValueError(f"{name!r} with {what} below 0")


def _require_the_scenes(given: NDArray[Any], name: str, own: NDArray[Any], fields: Iterable[str]) -> None:
    """Raise ValueError where fields of an array are not as the scene makes them."""
    for field in fields:
        if not np.array_equal(given[field] if field else given, own[field] if field else own.ravel()):
            raise ValueError(f"{name!r} with {field or 'numbers'} that no gas of this scene has")


def _require_contents(scene: GasScene, state: Arrays, own: Any) -> None:
    """Raise ValueError for indices out of range, balls outside their cells, times and counts that disagree."""
    motions, plans = state["gas.motions"], state["gas.plans"][: scene.count]
    one, count, now = state["gas.system"][0], scene.count, float(state["gas.system"][0]["now"])
    partner, boundary = plans["partner"], plans["boundary"].astype(np.int64)
    pairs, walls = (int(one[f"{name}_collisions"]) for name in ("pair", "wall"))
    counted = {
        name: int(state[f"gas.{name}"]["collisions"].sum()) for name in ("motions", "pairs", "contacts", "faces")
    }
    first, sampled, interval, *_snapshots = state["session"].tolist()
    time, clock = float(state["gas.time"][0]), state["clock"]
    planned = plans[: one["planned"]]
    first_event = float(planned["event_time"].min(initial=math.inf)) if len(planned) == count else math.inf
    slack = 1e-9 * (abs(now) + float(one["base"]))
    whole = {
        "numbers": np.array_equal(np.sort(state["gas.numbers"]), np.arange(count)),
        "motions": bool((motions["species"] < len(scene.groups)).all() and (motions["time"] <= now + slack).all())
        # (a ball's number of collisions is kept modulo 2^32; a kick of the thermostat counts as one, too)
        and (counted["motions"] - 2 * pairs - walls - int(one["kicks"])) % 2**32 == 0,
        "session": first <= pairs + walls and sampled <= pairs + walls and interval >= 1,
        "clock": bool((clock >= 0).all()) and clock[1] <= time,
        "time": time >= 0 and time - float(one["base"]) - float(one["rest"]) <= first_event + slack,
        "system": (pairs, walls, walls) == tuple(counted[name] for name in ("pairs", "contacts", "faces"))
        and one["balls"] == count
        and one["species"] == len(scene.groups)
        and one["bins"] == BINS_PER_BALL * count
        and one["bin"] <= one["bins"]
        and one["planned"] <= count
        and bool((one["free"] <= 1).all())
        and min(now, one["base"], one["threshold"], one["progress_time"]) >= 0
        and (len(planned) < count or one["bin_width"] > 0),
        "plans": bool(((partner < count) | (partner == NO_BALL)).all())
        and bool(((boundary < FIRST_WALL + len(state["gas.faces"])) | (boundary == PREDICT_AGAIN)).all())
        and bool((planned["event_time"] >= now - slack).all())
        and _in_their_cells(motions, plans, own, np.full(count, now))
        and _in_their_cells(motions[: len(planned)], planned, own, planned["event_time"]),
    }  # fmt: skip
    for name, sound in whole.items():
        if not sound:
            raise ValueError(f"{name!r} with contents that no gas of this scene has")


def _in_their_cells(motions: NDArray[Any], plans: NDArray[Any], own: Any, t: NDArray[Any]) -> bool:
    """Return whether all balls are, at times (N,), in the cells that they are entered in; at no time only balls at rest may be."""
    s = np.where(np.isinf(t), 0.0, t - motions["time"])
    for k, axis in enumerate("xyz"):
        cell, v, g = plans["c" + axis], motions["v" + axis], float(own["gravity"][k])
        with np.errstate(over="ignore", invalid="ignore"):
            place = (motions[axis] + (v + g / 2 * s) * s) / own["cell_size"][k] - cell
        # (a wall that moves may let balls out of the box: a piston that nothing holds, far out)
        last = own["cells"][k] - 1
        room = OUTSIDE + np.where((own["periodic"][k] == 0) & ((cell == 0) | (cell == last)), LONGEST_SIDE, 0)
        inside = (place >= -room) & (place <= 1 + room) & (cell <= last) & (cell >= 0)
        if not (inside & (np.isfinite(t) | ((v == 0) & (g == 0)))).all():
            return False
    return True


# ----------------------------------------------------------------------------------------------------
# The gas of a scene at its start, from a lattice, at random, or from a file.


SINGLE_PRECISION = 1e-5  # of a radius: an overlap that rounding to single precision may cause


def build(scene: GasScene, progress: Progress | None = None) -> Gas:
    """Return the gas of a scene, at its start.

    ``progress`` is called while a dense random start grows, as by :func:`carom.gas.dense`. Raises CaromError for initial positions
    that overlap, or that a file does not have.
    """
    run, container = scene.run, scene.container.geometry
    options: dict[str, Any] = {}
    if run.start == "random":
        radii = np.concatenate([one.all_radii for one in scene.species])
        # (velocities are drawn from the seed itself)
        seed = int(np.random.SeedSequence([run.seed, 1]).generate_state(1)[0])
        with _faults_of(scene):
            options["position"] = dense(radii, container, seed=seed, progress=progress)
    elif run.start != "lattice":
        options = _from_file(scene)
    with _faults_of(scene):
        return Gas.of_scene(scene, **options)


def _from_file(scene: GasScene) -> dict[str, Any]:
    """Return the content of the start's file, as options of Gas."""
    axes, path = scene.container.dimensions, Path(scene.run.start)
    try:
        start = read_initial_state(path, axes, scene.container.geometry.size, scene.count)
    except CaromError as error:
        raise CaromError(
            *(f"{scene.where}: {one}" if one.startswith("run.start: ") else one for one in error.faults)
        ) from None
    order = _order_by_species(scene, start, path)
    found: dict[str, Any] = {"position": start.position[order]}
    for name, values in (("velocity", start.velocity), ("spin", start.spin)):
        if values is not None:
            found[name] = values[order]
    if (
        path.suffix.lower() == ".gsd"
    ):  # single precision: balls that have just collided overlap; the first event separates them
        found["touch"] = SINGLE_PRECISION
    return found


def _order_by_species(scene: GasScene, start: InitialState, path: Path) -> Any:
    """Return the order of a file's rows by species, as the scene has them."""
    names = [one.name for one in scene.species]
    if start.species is None:
        if len(start.position) != scene.count:
            got = f"{len(start.position)} in {path.name}"
            raise CaromError(
                f"{scene.where}: run.start: expected {scene.count} balls, the sum over the species, got {got}"
            )
        return slice(None)
    for name in start.species:
        if name not in names:
            raise CaromError(Fault(f"{path}", "species", ", ".join(names), repr(name), suggestion(name, names)))
    for one in scene.species:
        if (count := start.species.count(one.name)) != one.count:
            raise CaromError(
                f"{scene.where}: run.start: expected {one.count} balls of species {one.name!r}, got {count} in {path.name}"
            )
    return np.argsort([names.index(name) for name in start.species], kind="stable")


@contextmanager
def _faults_of(scene: GasScene) -> Iterator[None]:
    """Raise the faults of a gas as faults of its scene."""
    try:
        yield
    except CaromError as error:
        raise CaromError(*(_in_scene(scene, fault) for fault in error.faults)) from None


def _in_scene(scene: GasScene, fault: str) -> str:
    """Return a fault of the gas as one of the scene."""
    said = fault.removeprefix("Gas: ")
    for part in ("position: ", "dense: ", "lattice: "):
        if said.startswith(part):
            file = f", in {Path(scene.run.start).name}" if Path(scene.run.start).suffix else ""
            return f"{scene.where}: run.start: {said.removeprefix(part)}{file}"
    return f"{scene.where}: {said}"


# ----------------------------------------------------------------------------------------------------
# Sessions: a gas equilibrated and measured as its scene says, in pieces, saved and continued.


SAMPLES = 50  # of the gas while it is measured
PAIR_SAMPLING = 5  # every fifth sample counts pairs
RATE_SAMPLES = 8  # over which the rate of collisions is taken where walls oscillate: over one it varies with the phase
TINY = 1e-300
CHUNK = 100_000  # collisions between two checks for progress and interrupts: a tenth of a second


class Session:
    """The run of a gas scene: equilibration, then measurement.

    Parameters
    ----------
    scene : GasScene
    growing : callable(done, total, text), optional
        Called while a dense random start grows, as by :func:`carom.gas.dense`.
    gas : Gas, optional
        Of this scene. Default: one at its start.

    :meth:`run` continues to the end, or to where it is stopped; neither the gas nor its measures depend on how often it was
    stopped. Samples are taken after about every fiftieth of the events (or of the duration), at times that follow from the rate of
    collisions; these are no instants of collision, at which two balls are in contact. Where walls oscillate, each sample is taken
    within its interval at a phase that the earlier ones have left out. Raises CaromError for a scene in which nothing can ever
    happen, and as :class:`carom.gas.Gas` does.

    Examples
    --------
    >>> from carom.gas import GasScene, Session
    >>> species = {"count": 64, "radius": 0.5}
    >>> contact = {"between": ("a", "a"), "restitution": 1, "friction": 0}
    >>> scene = GasScene(
    ...     container={"shape": "periodic", "size": (6, 6, 6)}, species=[species], contacts=[contact],
    ...     run={"equilibrate": 500, "max_events": 2000},
    ... )
    >>> session = Session(scene)
    >>> session.run()
    True
    >>> session.result.pair_collisions
    2000
    """

    def __init__(self, scene: GasScene, growing: Progress | None = None, gas: Gas | None = None) -> None:
        self._set(scene, build(scene, growing) if gas is None else gas)
        self.mark: Mark | None = None
        self.measures: Measures | None = None
        self.first_collision = 0  # number of collisions when the measurement began
        # the interval of the next sample ends at a time; the last one was at this time and number of collisions
        self.sample_due, self.last_sample_time, self.last_sample_collisions = math.inf, 0.0, 0
        self.next_sample = math.inf
        if self.max_wait == math.inf and (scene.equilibrate > 0 or scene.run.duration is None):
            what = "balls at rest" if scene.count > 1 or scene.container.geometry.faces else "one ball without walls"
            remedy = "add balls or walls" if what.startswith("one") else "give a temperature > 0"
            raise CaromError(
                f"{scene.where}: run: expected a gas with collisions to come, got {what}; {remedy},"
                " or set equilibrate = 0 and a duration"
            )
        self.sample_interval = SAMPLES if scene.run.max_events is None else max(scene.run.max_events // SAMPLES, 1)
        # the next snapshot is due after so many collisions, or after this time, as ``every`` says
        self.snapshots_taken, self.snapshot_due, self.snapshots_by_time = 0, 0.0, 0
        self._start_measuring()

    def _set(self, scene: GasScene, gas: Gas) -> None:
        self.scene, self.gas = scene, gas
        self.outputs: dict[str, str] = {}  # options that name files of the run, for those who resume it
        self.max_wait = _max_wait(scene, gas)
        self.oscillations = sorted({one.frequency or 0.0 for one in scene.drives if one.amplitude > 0})
        self.names = tuple(one.name for one in scene.species)

    def __repr__(self) -> str:
        """Return one line: the gas, and how far it has been run."""
        what = f"{counted(self.done, 'event')} measured" if self.measuring else "equilibrating"
        return f"<Session: {self.scene.describe()}; {what}, t = {self.gas.time:.6g}>"

    def plot(self, file: str | Path | None = None, **options: Any) -> Figure:
        """Return a Matplotlib figure of what was measured (:func:`carom.plot.plot_gas`). ``file``: write it there."""
        return figure_maker("plot_gas")(self, file, **options)  # type: ignore[no-any-return]

    # --- progress ------------------------------------------------------------------------------------------------

    @property
    def done(self) -> int:
        """Number of collisions in the current part, equilibration or measurement."""
        return self.gas.collisions - self.first_collision

    @property
    def measuring(self) -> bool:
        """Whether equilibration is over."""
        return self.mark is not None

    @property
    def part(self) -> str:
        """Name of the current part: "equilibrating" or "measuring"."""
        return "measuring" if self.measuring else "equilibrating"

    @property
    def finished(self) -> bool:
        """Whether the measurement is complete."""
        run = self.scene.run
        return self.mark is not None and (
            (run.max_events is not None and self.done >= run.max_events)
            or (run.duration is not None and self.gas.time >= self.mark.time + run.duration)
        )

    @property
    def completed(self) -> float:
        """Fraction of the current part that is done, 0 to 1."""
        run, fractions = self.scene.run, [0.0]
        if self.mark is None:
            shares = [self.done / max(self.scene.equilibrate, 1)]
            shares += [] if run.from_time is None else [self.gas.time / run.from_time]
            return min(*shares, 1.0)
        if run.max_events is not None:
            fractions.append(self.done / run.max_events)
        if run.duration is not None:
            fractions.append((self.gas.time - self.mark.time) / run.duration)
        return min(max(fractions), 1.0)

    def __getitem__(self, part: int) -> Any:
        """Return the gas (0) or the result (1): ``gas, run = simulate_gas(scene)`` takes a session apart."""
        return (self.gas, self.result)[part]

    @property
    def result(self) -> GasRun:
        """Measurements so far; CaromError before the measurement has begun."""
        if self.mark is None:
            raise CaromError("Session: expected an equilibrated gas, got one in equilibration; run it further")
        return self.gas.measured_since(self.mark)

    # --- running -------------------------------------------------------------------------------------------------

    def run(
        self,
        *,
        stop: Callable[[], bool] = lambda: False,
        progress: Progress | None = None,
        every: Every | None = None,
        snapshot: Callable[[Session], None] | None = None,
    ) -> bool:
        """Continue to the end and return True, or return False where ``stop`` returns True.

        ``progress`` is called some ten times per second with the share of the part that is done, 1, and the part,
        "equilibrating" or "measuring". ``snapshot`` is called when the measurement begins, and then every so many
        collisions (``every`` an int), every so much simulated time (a float), or at :class:`LogTimes`. What these raise
        ends the run.

        Raises EndedEarlyError as :meth:`pieces` does.
        """
        if not isinstance(every, LogTimes | None) and not (isinstance(every, int | float) and 0 < every < math.inf):
            raise CaromError(f"Session.run: every: expected a whole number >= 1, or a time > 0, got {every!r}")
        tell = loop_callback(progress, lambda now: lambda: now(self.completed, 1.0, self.part))
        for due in self.pieces(None if snapshot is None else every, stop=stop):
            if due and snapshot is not None:
                snapshot(self)
            if tell is not None:
                tell()
        return self.finished

    def pieces(self, every: Every | None = None, *, stop: Callable[[], bool] = lambda: False) -> Iterator[bool]:
        """Continue to the end, or until ``stop`` returns True, piece by piece; yield before each whether a snapshot is due.

        A piece takes some tenth of a second. Raises EndedEarlyError as :meth:`carom.gas.Gas.run` does; :attr:`result` and
        :attr:`measures` then hold what was measured until then.
        """
        while True:
            yield every is not None and self.mark is not None and self._snapshot_is_due(every)
            if self.finished or stop():
                return
            collisions, until = self._next_piece(every)
            before, end = self.gas.collisions, self.gas.time + self.max_wait
            try:
                if self.gas.at_rest and (self.mark is None or self.scene.run.duration is None):
                    self.gas.raise_early(EarlyEnd(AT_REST, self.gas.time))
                self.gas.advance(collisions, min(until, end), stop=stop)
            except EndedEarlyError as error:
                raise self._explained(error) from None
            # a cooling gas slows down without limit: after few collisions in a piece, take longer ones
            if end < until and self.gas.collisions - before <= collisions // 8:
                self.max_wait *= 2
            self._start_measuring()
            if self.measures is not None and self.gas.time >= self.next_sample:
                self._take_sample(self.measures)

    def _explained(self, error: EndedEarlyError) -> EndedEarlyError:
        """Return the error with what was measured until then, or with the word that nothing was."""
        if self.mark is None:
            *others, last = error.faults
            said = "nothing was measured, since the gas was still equilibrating"
            return EndedEarlyError(error.end, *others, f"{last}; {said}")
        if self.measures is not None and self.measures.samples == 0:
            self.measures.sample(self.gas, pairs=False)  # (those that collide ever faster are in contact)
        error.result = self.result
        return error

    def _next_piece(self, every: Every | None) -> tuple[int, float]:
        """Return how far to advance at once: a number of collisions, and a time."""
        run, least = self.scene.run, CHUNK
        if self.mark is None:
            left = self.scene.equilibrate - self.done
            return (min(least, left), math.inf) if left > 0 else (least, run.from_time or math.inf)
        until = self.next_sample
        if run.max_events is not None:
            least = min(least, run.max_events - self.done)
        if run.duration is not None:
            until = min(until, self.mark.time + run.duration)
        if self.sample_due == math.inf:  # the rate of collisions is not known yet
            least = min(least, max(self.sample_interval - self.done, 1))
        if every is not None and self.snapshots_by_time:
            until = min(until, self.mark.time + self.snapshot_due)
        elif every is not None:
            least = min(least, int(self.snapshot_due) - self.done)
        return least, until

    def _snapshot_is_due(self, every: Every) -> bool:
        """Return whether a snapshot is due, and set when the next one is: at the next multiple of ``every``."""
        assert self.mark is not None
        timed = not isinstance(every, int)
        passed = self.gas.time - self.mark.time if timed else self.done
        if timed != self.snapshots_by_time:  # another unit than before
            self.snapshots_by_time, self.snapshot_due = int(timed), passed
        due = self.gas.time >= self.mark.time + self.snapshot_due if timed else self.done >= self.snapshot_due
        if due:
            self.snapshots_taken += 1
            self.snapshot_due = next_due(every, passed)
        return due

    def snapshot_gap(self, every: Every) -> tuple[float, float] | None:
        """Return from when to when snapshots are missing, in simulated time, since the run was continued without them; or None."""
        if self.mark is None or self.snapshots_taken == 0 or isinstance(every, int) == bool(self.snapshots_by_time):
            return None
        if isinstance(every, int):
            rate = max(self.done, 1) / max(self.gas.time - self.mark.time, TINY)
            due = self.mark.time + self.snapshot_due / rate if self.done > self.snapshot_due else math.inf
        else:
            due = self.mark.time + self.snapshot_due
        return (due, self.gas.time) if due < self.gas.time else None

    def _start_measuring(self) -> None:
        """Begin the measurement after equilibration; set the time of the first sample once the collision rate is known."""
        gas, run = self.gas, self.scene.run
        if self.mark is None and self.done >= self.scene.equilibrate and gas.time >= (run.from_time or 0.0):
            # (a gas that has cooled has less energy than the rounding of sums from its start)
            for table in (gas.arrays.materials.pairs, gas.arrays.walls.contacts):
                table[["lost_normal", "lost_tangential", "to_spin"]] = 0
            self.mark, self.measures = gas.mark(), Measures(gas, self.names, self.scene.container.geometry)
            self.first_collision = self.last_sample_collisions = gas.collisions
            self.last_sample_time = gas.time
            if run.duration is not None and run.max_events is None:
                self.sample_due = gas.time + run.duration / SAMPLES
            elif gas.time > 0 and gas.collisions > 0:
                self.sample_due = gas.time + self.sample_interval * gas.time / gas.collisions
        elif self.mark is not None and self.sample_due == math.inf and self.done >= self.sample_interval:
            self.sample_due = gas.time + self.sample_interval * (gas.time - self.mark.time) / self.done
        else:
            return
        self.next_sample = self._time_in_interval()

    def _take_sample(self, measures: Measures) -> None:
        """Take a sample, and set the time of the next one."""
        gas, run = self.gas, self.scene.run
        measures.sample(gas, pairs=measures.samples % PAIR_SAMPLING == 0)
        if self.oscillations or (run.duration is not None and run.max_events is None):
            self.sample_due += self._interval(measures)
        else:
            events = gas.collisions - self.last_sample_collisions
            self.sample_due = gas.time + (gas.time - self.last_sample_time) * min(
                self.sample_interval / max(events, 1), 2.0
            )
        self.last_sample_time, self.last_sample_collisions = gas.time, gas.collisions
        self.next_sample = self._time_in_interval()

    def _interval(self, measures: Measures) -> float:
        """Return the length of the interval in which a sample is taken after those so far: with a duration a share of it.

        Else it is the time in which so many collisions happen, at the rate since some samples ago.
        """
        run, mark = self.scene.run, self.mark
        assert mark is not None
        if run.duration is not None and run.max_events is None:
            return run.duration / SAMPLES
        rows = measures.series
        times = np.concatenate([[mark.time], rows["time"]])[-RATE_SAMPLES - 1 :]
        events = np.concatenate([[self.first_collision], rows["collisions"]])[-RATE_SAMPLES - 1 :]
        passed = float(times[-1] - times[0]) / (len(times) - 1)
        share = self.sample_interval * (len(times) - 1) / max(float(events[-1] - events[0]), 1.0)
        return passed * min(share, 2.0)

    def _time_in_interval(self) -> float:
        """Return when the next sample is taken: where walls oscillate, within its interval at the phase most needed.

        It follows from what is kept in a checkpoint, so that a run that is continued takes the same samples.
        """
        measures = self.measures
        if not self.oscillations or measures is None or measures.samples == 0:
            return self.sample_due
        width, times = self._interval(measures), measures.series["time"]
        return max(spread_time(self.sample_due, width, self.oscillations, times, PAIR_SAMPLING), self.gas.time)

    # --- state ---------------------------------------------------------------------------------------------------

    def state(self) -> State:
        """Return all that a later session needs to continue with the same bits."""
        return {f"gas.{name}": array for name, array in self.gas.state().items()} | course_as_arrays(self)

    @classmethod
    def restore(
        cls, scene: GasScene, state: Mapping[str, NDArray[Any]], compiling: Callable[[], None] | None = None
    ) -> Session:
        """Return the session with a :meth:`state`. ``compiling`` is called when the state is known to be complete."""
        require_state(scene, state)
        if compiling is not None:
            compiling()
        found = object.__new__(cls)
        found._set(scene, gas_of_arrays(state))
        set_course(found, state)
        found.next_sample = found._time_in_interval()
        return found


def _max_wait(scene: GasScene, gas: Gas) -> float:
    """Return the longest simulated time between two checks for interrupts: what a ball needs to cross the container thirty times.

    Infinite where nothing can ever happen.
    """
    container = scene.container.geometry
    side, mass = max(container.size), sum(one.total_mass(scene.container.dimensions) for one in scene.species)
    pull = math.hypot(*scene.gravity_vector)
    speed = math.sqrt(2 * gas.energy()[0] / mass) + math.sqrt(pull * side)
    speed += sum(one.greatest_speed for one in scene.drives)
    if scene.thermostat is not None:
        speed += math.sqrt(scene.thermostat.temperature * scene.count / mass)
    collides = scene.count > 1 or bool(container.faces)
    return 30 * side / speed if speed > 0 and collides else math.inf
