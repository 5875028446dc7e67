"""A gas, equilibrated and measured, in one call: of species in a box, or of a scene."""

from __future__ import annotations

import math
import os
import threading
from collections.abc import Callable, Sequence
from concurrent.futures import FIRST_COMPLETED, Future, ThreadPoolExecutor, wait
from dataclasses import dataclass
from pathlib import Path
from typing import Any, NamedTuple, overload

import numpy as np
from numpy.typing import NDArray

from carom.bodies import holds_arrays
from carom.core.jit.threads import thread_count
from carom.errors import CaromError, FaultList, require_type
from carom.files import require_memory
from carom.gas import initial, overlaps
from carom.gas import measures as histograms
from carom.gas.containers import Container, as_container
from carom.gas.edmd import driver
from carom.gas.gas import Gas
from carom.gas.report import report
from carom.gas.results import EarlyEnd, EndedEarlyError
from carom.gas.scene import GasScene, load_gas
from carom.gas.session import Session
from carom.gas.snapshots import read_initial_state
from carom.gas.species import Species
from carom.public.progress import Progress, loop_callback
from carom.scene.schema import from_file
from carom.scene.toml import replaced

Array = NDArray[np.float64]
POLL_SECONDS = 0.1  # between two looks for members that are done, progress, and interrupts
BYTES_PER_REPORT = 10_000.0  # of a gas, at least
SEED_BITS = 53  # of a member's seed: JSON readers keep so many


@holds_arrays
class Curve(NamedTuple):
    """Mean and standard error of a curve over the members, (B,) each."""

    x: Array
    mean: Array
    error: Array


@dataclass(frozen=True, eq=False)
class Ensemble:
    """Result of :func:`simulate_ensemble`."""

    scene: GasScene
    seeds: tuple[int, ...]
    """Seeds of the members; each runs alone as a gas with this seed."""
    members: tuple[dict[str, Any], ...]
    """The JSON object that ``carom gas`` prints for each."""
    mean: dict[str, Any]
    """The means of these, in the same form."""
    error: dict[str, Any]
    """Standard errors of the means: the standard deviation over the members, divided by the square root of their number."""
    curves: dict[str, Curve]
    """``temperature_translational`` and ``temperature_rotational`` over the time since the measurement began, and, of several
    species, each one's, as ``temperature_translational.NAME``; ``velocity.NAME`` and ``spin.NAME``; ``pair_correlation.NAME.NAME``;
    between walls the number ``density.NAME`` along gravity or across the walls; and without walls the mean square ``displacement``
    over the lag time or, where the temperature of a gas changes by more than a factor of two, ``displacement_by_collisions``: since
    the first sample, over the collisions per ball."""
    ended_early: dict[int, EarlyEnd]
    """Of the gases that ended before the collisions or the time asked for, by their seeds: why. They count up to there."""


def simulate_ensemble(
    scene: GasScene,
    members: int,
    *,
    threads: int | None = None,
    progress: Progress | None = None,
) -> Ensemble:
    """Simulate independent gases of one scene, on all cores.

    Parameters
    ----------
    scene : GasScene
        Its start must depend on the seed: random positions or velocities, a heated wall, or a thermostat.
    members : int
        Number of gases, at least 2. A larger ensemble begins with the members of a smaller one.
    threads : int, optional
        Default: one per core. The results are bitwise identical for any number, except ``cpu_seconds``.
    progress : callable(done, total, text), optional
        Called some ten times per second with the number of collisions so far, and of all (NaN: not known).

    Returns
    -------
    Ensemble

    Raises
    ------
    CaromError
        For a scene whose members would all be the same, and as :class:`Session` does, with the member's seed. Where gases end
        early, it is an EndedEarlyError that holds the ensemble: each of them counts up to its end.

    Examples
    --------
    >>> from carom.gas import GasScene, simulate_ensemble
    >>> contact = {"between": ("a", "a"), "restitution": 1, "friction": 0}
    >>> scene = GasScene(
    ...     container={"shape": "periodic", "size": (6, 6, 6)}, species=[{"count": 64, "radius": 0.5}], contacts=[contact],
    ...     run={"equilibrate": 500, "max_events": 2000},
    ... )
    >>> found = simulate_ensemble(scene, 4)
    >>> len(found.seeds), found.mean["pair_collisions"], found.error["pair_collisions"]
    (4, 2000.0, 0.0)
    >>> 0 < found.error["pressure"] < 0.1 * found.mean["pressure"]
    True
    """
    _require(scene, members, threads)
    seeds = np.random.SeedSequence(scene.run.seed).generate_state(members, np.uint64) >> np.uint64(64 - SEED_BITS)
    work = _Work(scene, tuple(map(int, seeds)))
    for room in (driver, histograms, initial, overlaps):
        room.compiled_loops()  # made once, before several threads ask for them
    with ThreadPoolExecutor(threads or thread_count()) as pool:
        runs = [pool.submit(work.run, k) for k in range(members)]
        try:
            _wait(runs, work, loop_callback(progress, _as_collisions))
        except BaseException:  # Ctrl-C as well: the members end between two pieces of their runs
            work.stop.set()
            pool.shutdown(cancel_futures=True)
            raise
        found = [run.result() for run in runs]
    reports = tuple(one[0] for one in found)
    mean, error = _statistics([{name: x for name, x in one.items() if name != "ended_early"} for one in reports])
    names = [name for name in found[0][1] if all(name in one[1] and len(one[1][name][0]) for one in found)]
    if "displacement" in names:  # (not of some gases only)
        names.remove("displacement_by_collisions")
    curves = {name: _mean_curve([one[1][name] for one in found]) for name in names}
    ended = {seed: one[2].end for seed, one in zip(work.seeds, found, strict=True) if one[2] is not None}
    ensemble = Ensemble(scene, work.seeds, reports, mean, error, curves, ended)
    for seed, (*_, why) in zip(work.seeds, found, strict=True):
        if why is not None:
            *others, last = why.faults
            said = f"{last}; {len(ended)} of {members} gases ended early (the gas with seed {seed})"
            raise EndedEarlyError(why.end, *others, said, result=ensemble)
    return ensemble


def member_scene(scene: GasScene, seed: int) -> GasScene:
    """Return the scene of one member: the same with another seed."""
    return scene.model_copy(update={"run": scene.run.model_copy(update={"seed": seed})})


def _require(scene: Any, members: Any, threads: Any) -> None:
    require_type("simulate_ensemble", "scene", scene, GasScene)
    faults = FaultList("simulate_ensemble")
    for name, count, least in (("members", members, 2), ("threads", 1 if threads is None else threads, 1)):
        if isinstance(count, bool) or not isinstance(count, int | np.integer) or count < least:
            faults.add(name, f"a whole number >= {least}", f"{count!r}")
    faults.raise_if_any()
    require_memory("simulate_ensemble", "members", members, BYTES_PER_REPORT, "take fewer gases")
    if not _depends_on_seed(scene):
        raise CaromError(
            f"{scene.where}: run: expected a start that depends on the seed, got gases that would all be the same; give a"
            " temperature > 0 or start = 'random', or run one gas"
        )


def _depends_on_seed(scene: GasScene) -> bool:
    """Return whether two seeds give two different gases."""
    if scene.run.start == "random" or scene.thermostat is not None:
        return True
    if any(one.temperature is not None for one in scene.drives):
        return True
    start = Path(scene.run.start)
    has_velocity, has_spin = False, False
    if start.suffix:
        found = read_initial_state(start, scene.container.dimensions, scene.container.geometry.size)
        has_velocity, has_spin = found.velocity is not None, found.spin is not None
    warm = [(one.temperature, one.temperature_rotational) for one in scene.species]
    return any(
        (moves > 0 and not has_velocity) or ((moves if turns is None else turns) > 0 and not has_spin)
        for moves, turns in warm
    )


# --- members -------------------------------------------------------------------------------------------------------


class _Work:
    """The members, what each has done so far, and whether they are to stop."""

    def __init__(self, scene: GasScene, seeds: tuple[int, ...]) -> None:
        self.scene, self.seeds, self.stop = scene, seeds, threading.Event()
        self.shares, self.events = np.zeros(len(seeds)), np.zeros(len(seeds), np.int64)

    def run(self, k: int) -> tuple[dict[str, Any], dict[str, tuple[Array, Array]], EndedEarlyError | None]:
        """Simulate member k; return its report, its curves, and why it ended early if it did."""
        try:
            session = Session(member_scene(self.scene, self.seeds[k]), self._growing)
            early = None
            try:
                for _ in session.pieces(stop=self.stop.is_set):
                    self._note(k, session)
            except EndedEarlyError as error:
                if not session.measuring:
                    raise
                early = error
            return report(session), _curves(session), early
        except CaromError as error:
            raise CaromError(*(f"{fault} (the gas with seed {self.seeds[k]})" for fault in error.faults)) from None

    def _growing(self, *_progress: Any) -> None:
        if self.stop.is_set():
            raise CaromError("simulate_ensemble: expected a run to its end, got an interrupt")

    def _note(self, k: int, session: Session) -> None:
        most = session.scene.run.max_events
        self.events[k] = session.gas.collisions
        if most is None or session.scene.run.duration is not None:  # (how many collisions there will be is not known)
            self.shares[k] = (session.measuring + session.completed) / 2
        else:
            self.shares[k] = session.gas.collisions / (session.scene.equilibrate + most)


def _wait(runs: Sequence[Future[Any]], work: _Work, progress: Callable[[float, int], None] | None) -> None:
    """Wait until all members are done, and report the progress; raise what the first that fails raises."""
    left = set(runs)
    while left:
        done, left = wait(left, timeout=POLL_SECONDS, return_when=FIRST_COMPLETED)
        for one in done:
            one.result()
        if progress is not None:
            progress(float(work.shares.mean()), int(work.events.sum()))


def _as_collisions(progress: Progress) -> Callable[[float, int], None]:
    return lambda share, events: progress(events, events / share if share else math.nan, "collisions")


# --- means ---------------------------------------------------------------------------------------------------------


def _statistics(parts: Sequence[Any]) -> tuple[Any, Any]:
    """Return mean and standard error of numbers, or of those in dicts and lists of the same form; texts stay as they are."""
    first = parts[0]
    if isinstance(first, dict):
        pairs = {name: _statistics([part[name] for part in parts]) for name in first}
        return {name: one for name, (one, _) in pairs.items()}, {name: two for name, (_, two) in pairs.items()}
    if isinstance(first, list):
        rows = [_statistics(column) for column in zip(*parts, strict=True)]
        return [one for one, _ in rows], [two for _, two in rows]
    if isinstance(first, str | tuple):
        return first, first
    mean, error = _mean_and_error(np.array(parts, dtype=float))
    return float(mean), float(error)


def _mean_and_error(rows: Array) -> tuple[Array, Array]:
    """Return mean and standard error over the first axis; nan where a member has no number."""
    with np.errstate(invalid="ignore"):
        return rows.mean(axis=0), rows.std(axis=0, ddof=1) / math.sqrt(len(rows))


def _curves(session: Session) -> dict[str, tuple[Array, Array]]:
    """Return the curves of a member, as x and y."""
    measures, mark = session.measures, session.mark
    assert measures is not None
    assert mark is not None
    found: dict[str, tuple[Array, Array]] = {}
    if measures.samples == 0:
        return found
    rows = measures.series
    for name in ("translational", "rotational"):
        found[f"temperature_{name}"] = (rows["time"] - mark.time, rows[name])
        if len(session.names) > 1:
            for kind, warm in measures.species_series.items():
                found[f"temperature_{name}.{kind}"] = (rows["time"] - mark.time, warm[name])
    for i, name in enumerate(session.names):
        for what, one in (("velocity", measures.velocity(name)), ("spin", measures.spin(name))):
            found[f"{what}.{name}"] = (one.center, one.density)
        for other in session.names[i:]:
            pair = measures.pair_correlation(name, other)
            found[f"pair_correlation.{name}.{other}"] = (pair.distance, pair.g)
        if measures.profiles is not None:
            slices = measures.profile(name)
            found[f"density.{name}"] = (slices.middle, np.nan_to_num(slices.density, posinf=0.0))
    if measures.has_diffusion:
        collisions, square = measures.displacement_by_collisions()
        found["displacement_by_collisions"] = (2 * collisions / session.scene.count, square)
        if measures.is_stationary:
            moved = measures.displacement()
            found["displacement"] = (moved.lag, moved.square)
    return found


def _mean_curve(curves: Sequence[tuple[Array, Array]]) -> Curve:
    """Return the mean over curves, interpolated where they were sampled at different places."""
    x = curves[0][0]
    if any(not np.array_equal(one[0], x) for one in curves):
        # the k-th places of the members are near each other: their median, where all have values
        count = min(len(one[0]) for one in curves)
        x = np.median([one[0][:count] for one in curves], axis=0)
        low, high = max(one[0][0] for one in curves), min(one[0][-1] for one in curves)
        shared = (x >= low) & (x <= high)
        # (gases that end early may have no time in common: their first samples then stand for each other)
        x = x[shared] if shared.any() else x[:1]
    return Curve(x, *_mean_and_error(np.array([np.interp(x, *one) for one in curves])))


# ----------------------------------------------------------------------------------------------------
# A gas, equilibrated and measured, in one call: of species in a box, or of a scene.


@overload
def simulate_gas(
    species: GasScene | str | Path | Sequence[Species],
    side: Sequence[float] | Container | None = None,
    *,
    max_events: int | None = None,
    duration: float | str | None = None,
    seed: int | None = None,
    ensemble: None = None,
    equilibrate: int | None = None,
    from_time: float | str | None = None,
    progress: Progress | None = None,
    **options: Any,
) -> Session: ...


@overload
def simulate_gas(
    species: GasScene | str | Path | Sequence[Species],
    side: Sequence[float] | Container | None = None,
    *,
    max_events: int | None = None,
    duration: float | str | None = None,
    seed: int | None = None,
    ensemble: int,
    equilibrate: int | None = None,
    from_time: float | str | None = None,
    progress: Progress | None = None,
    **options: Any,
) -> Ensemble: ...


def simulate_gas(
    species: Sequence[Species] | GasScene | str | Path,
    side: Sequence[float] | Container | None = None,
    *,
    max_events: int | None = None,
    duration: float | str | None = None,
    seed: int | None = None,
    ensemble: int | None = None,
    equilibrate: int | None = None,
    from_time: float | str | None = None,
    progress: Progress | None = None,
    **options: Any,
) -> Session | Ensemble:
    """Make a gas, equilibrate it, and measure.

    Parameters
    ----------
    species : path, GasScene, or sequence of Species
        A scene, as a file or as :func:`load_gas` returns it, has all the rest too.
    side, **options : as for :class:`Gas`; not with a scene
    max_events : int, optional
        Number of collisions that are measured, with walls included. Default: the scene's.
    duration : float or str, optional
        Time that is measured. Default: the scene's.
    seed : int, optional
        Of the random numbers. Default: the scene's, or 0.
    ensemble : int, optional
        Simulate so many independent gases, on all cores, as :func:`simulate_ensemble` does.
    equilibrate : int, optional
        Number of collisions before; default: the scene's, or 40 per ball.
    from_time : float or str, optional
        Simulated time before which nothing is measured; all means are then over the time after it.
    progress : callable(done, total, text), optional
        Called some ten times per second with the number of collisions so far, and of all (NaN: not known).

    Returns
    -------
    Session; with ``ensemble`` an Ensemble
        ``.result``: what ``carom gas`` prints, a :class:`GasRun`. ``.measures``: distributions, g(r), diffusion, profiles.
        ``.gas``: the balls at the end. ``gas, run = simulate_gas(...)`` takes it apart. Raises CaromError as :class:`Session` does.

    Examples
    --------
    >>> from carom import Ball, Surface
    >>> from carom.gas import GasScene, Species, simulate_gas
    >>> elastic = Surface(1, 0, -1)
    >>> found = simulate_gas([Species(Ball(0.5, 1.0), 64)], (6.0, 6.0, 6.0), contacts=elastic, max_events=1000)
    >>> found.gas.collisions, found.result.pair_collisions
    (3560, 1000)

    The scene of a file is run in the same way, ``simulate_gas("gas.toml")``:

    >>> scene = GasScene(container=(6, 6, 6), species=[Species(Ball(0.5, 1.0), 64)], contacts=elastic, run={"max_events": 2000})
    >>> simulate_gas(scene).result.pair_collisions, simulate_gas(scene, max_events=500).result.pair_collisions
    (2000, 500)
    """
    faults, where = FaultList("simulate_gas"), "simulate_gas"
    settings = {
        "max_events": max_events, "duration": duration, "seed": seed, "equilibrate": equilibrate, "from_time": from_time,
    }  # fmt: skip
    run = {name: value for name, value in settings.items() if value is not None}
    if isinstance(species, str | os.PathLike):
        species = load_gas(species)
    given = {name: value for name, value in {"side": side, **options}.items() if value is not None}
    start = {name: given.pop(name) for name in ("position", "velocity", "spin", "touch") if name in given}
    if isinstance(species, GasScene):
        for name, value in (given | start).items():
            faults.add(name, "none beside a GasScene", f"{value!r}", "change the scene")
        faults.raise_if_any()
        scene = replaced(species, {f"run.{name}": x for name, x in run.items()})
    else:
        if not isinstance(species, list | tuple) or not all(isinstance(one, Species) for one in species):
            wanted = "a scene (the name of a file, or a GasScene), or a list of Species"
            faults.add("species", wanted, f"{type(species).__name__} {species!r:.60}")
        elif side is None:
            faults.add("side", "two or three lengths, or a container, with a list of Species", "none")
        if start and ensemble is not None:
            faults.add("ensemble", "none with a start of one's own", f"{ensemble!r}", "omit one of them")
        faults.raise_if_any()
        box = as_container(given.pop("side"), given.pop("periodic", True))
        scene = from_file(where, GasScene, {"container": box, "species": species, "run": run, **given})
    if ensemble is not None:
        return simulate_ensemble(scene, ensemble, progress=progress)
    session, most = Session(scene, gas=Gas.of_scene(scene, **start) if start else None), scene.run.max_events
    total = math.nan if most is None else scene.equilibrate + most
    session.run(progress=progress and (lambda *_: progress(session.gas.collisions, total, "collisions")))
    return session
