"""Gases in one call: a session; or an ensemble, which is a sweep over seeds: means of all measures, with error bars."""

from __future__ import annotations

import math
import os
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple, cast, overload

import numpy as np
from numpy.typing import NDArray

from carom.bodies import holds_arrays
from carom.errors import CaromError, FaultList, require_count, require_type
from carom.files import require_memory
from carom.gas.containers import Container, as_container
from carom.gas.gas import Gas
from carom.gas.results import EarlyEnd, EndedEarlyError
from carom.gas.scene import GasScene, load_gas
from carom.gas.session import Session
from carom.gas.snapshots import read_initial_state
from carom.gas.species import Species
from carom.public.other_rooms import figure_maker
from carom.public.progress import Progress
from carom.scene.schema import from_file
from carom.scene.toml import replaced
from carom.sweeps.orbits import CURVE, ENDED, KINDS, REPORT, SEED, Gases, curve_names, refilled
from carom.sweeps.space import Space
from carom.sweeps.sweep import sweep_over

if TYPE_CHECKING:
    from matplotlib.figure import Figure

Array = NDArray[np.float64]
BYTES_PER_REPORT = 100_000.0  # of a gas, at least
SEED_BITS = 53  # of a gas's seed: JSON readers keep so many
BLOCK_GASES = 8  # of a block of a store


@holds_arrays
class Curve(NamedTuple):
    """Mean and standard error of a curve over the gases, (B,) each."""

    x: Array
    mean: Array
    error: Array


@dataclass(frozen=True, eq=False, repr=False)
class Ensemble:
    """Result of :func:`gas_ensemble`."""

    scene: GasScene
    seeds: tuple[int, ...]
    """Seeds of the gases; each is the gas of the scene with this seed."""
    members: tuple[dict[str, Any], ...]
    """The JSON object that ``carom gas`` prints for each."""
    mean: dict[str, Any]
    """The means of these, in the same form."""
    error: dict[str, Any]
    """Standard errors of the means: the standard deviation over the gases, divided by the square root of their number."""
    curves: dict[str, Curve]
    """``temperature_translational`` and ``temperature_rotational`` over the time since the measurement began, and, of several
    species, each one's, as ``temperature_translational.NAME``; ``velocity.NAME`` and ``spin.NAME``; ``pair_correlation.NAME.NAME``;
    between walls the number ``density.NAME`` along gravity or across the walls; and without walls the mean square ``displacement``
    over the lag time or, where the temperature of a gas changes by more than a factor of two, ``displacement_by_collisions``: since
    the first sample, over the collisions per ball."""
    ended_early: dict[int, EarlyEnd]
    """Of the gases that ended before the collisions or the time asked for, by their seeds: why. They count up to there."""

    def __repr__(self) -> str:
        """Return one line."""
        return f"<Ensemble of {len(self.seeds)} gases: {self.scene.describe()}>"

    def plot(self, file: str | Path | None = None, **options: Any) -> Figure:
        """Return a Matplotlib figure of the means (:func:`carom.plot.plot_ensemble`). ``file``: write it there."""
        return figure_maker("plot_ensemble")(self, file, **options)  # type: ignore[no-any-return]


def gas_ensemble(
    scene: GasScene,
    members: int,
    *,
    store: str | Path | None = None,
    on: Any = "cores",
    progress: Progress | None = None,
) -> Ensemble:
    """Simulate independent gases of one scene, a sweep over their seeds: on all cores, or on a cluster.

    Parameters
    ----------
    scene : GasScene
        Its start must depend on the seed: random positions or velocities, a heated wall, or a thermostat.
    members : int
        Number of gases, at least 2. A larger ensemble begins with the gases of a smaller one.
    store : path, optional
        Where the gases that are done are kept, eight at a time: an ensemble that was interrupted goes on from there.
    on : "cores", the address of a Dask scheduler, or a ``distributed.Client``
        As :meth:`carom.sweeps.Sweep.run` takes it; a cluster needs a store.
    progress : callable(done, total, text), optional
        Called with the number of gases that are done, and of all.

    Returns
    -------
    Ensemble. Its bits do not depend on the number of cores, or on interruptions, but for ``cpu_seconds``.

    Raises
    ------
    CaromError
        For a scene whose gases would all be the same, and as :class:`carom.gas.Session` does, with the gas's seed. Where gases
        end early, it is an EndedEarlyError that holds the ensemble: each of them counts up to its end.

    Examples
    --------
    >>> import carom
    >>> from carom.gas import GasScene, Species
    >>> from carom.sweeps import gas_ensemble
    >>> scene = GasScene(
    ...     container=(6, 6, 6), species=Species(carom.Ball(0.5, 1.0), 64), contacts=carom.Surface(1, 0, -1),
    ...     run={"equilibrate": 500, "max_events": 2000},
    ... )
    >>> found = gas_ensemble(scene, 4)
    >>> len(found.seeds), found.mean["pair_collisions"], found.error["pair_collisions"]
    (4, 2000.0, 0.0)
    >>> 0 < found.error["pressure"] < 0.1 * found.mean["pressure"]
    True
    """
    _require(scene, members)
    seeds = (
        np.random.SeedSequence(scene.run.seed).generate_state(members, np.uint64) >> np.uint64(64 - SEED_BITS)
    ).tolist()
    made = sweep_over(
        Space(scene, {SEED: seeds}), [REPORT, ENDED, *(CURVE + name for name in curve_names(scene))], store,
        members if store is None else BLOCK_GASES,
    )  # fmt: skip
    told = progress or (lambda *_: None)
    told(0, members, "gases")
    if store is None:
        done = iter(range(1, members + 1))
        found = made.compute(0, lambda: told(next(done), members, "gases"))
    else:
        kept = made.run(on, progress=lambda now, total: told(now, total, "gases"))
        found = {name: kept[name].values for name in kept.data_vars}
    for k in np.flatnonzero(found["failed"]).tolist():
        raise CaromError(f"{made.why(k)} (the gas with seed {seeds[k]})")
    return _ensemble(scene, seeds, found, cast(Gases, made.space.subject).template)


def _ensemble(scene: GasScene, seeds: list[int], found: dict[str, Any], form: dict[str, Any]) -> Ensemble:
    """Return the means of what is kept of gases; EndedEarlyError, which holds them, where some ended early."""
    rows, count = found[REPORT], len(seeds)
    columns = np.ascontiguousarray(rows.T)
    with np.errstate(invalid="ignore"):
        mean, error = columns.mean(axis=1), columns.std(axis=1, ddof=1) / math.sqrt(count)
    ended: dict[int, EarlyEnd] = {}
    for seed, (kind, time, collisions, *balls) in zip(seeds, found[ENDED].tolist(), strict=True):
        if not math.isnan(kind):
            those = tuple(int(k) for k in balls if not math.isnan(k))
            ended[seed] = EarlyEnd(KINDS[int(kind)], time, those, None if math.isnan(collisions) else int(collisions))
    members = [refilled(form, iter(row), True) for row in rows.tolist()]
    for seed, one in zip(seeds, members, strict=True):
        one[ENDED] = ended[seed].to_dict() if seed in ended else None
    curves = {
        name: _mean_curve([row[:, ~np.isnan(row[0])] for row in found[CURVE + name]])
        for name in curve_names(scene)
        if not np.isnan(found[CURVE + name][:, 0, 0]).any()
    }
    if "displacement" in curves:  # (not of some gases only)
        curves.pop("displacement_by_collisions", None)
    middle, spread = (refilled(form, iter(part.tolist()), False) for part in (mean, error))
    ensemble = Ensemble(scene, tuple(seeds), tuple(members), middle, spread, curves, ended)
    for seed, end in ended.items():
        why = EndedEarlyError.of(end, members[seeds.index(seed)]["mean_free_time"])
        *others, last = why.faults
        said = f"{last}; {len(ended)} of {count} gases ended early (the gas with seed {seed})"
        raise EndedEarlyError(end, *others, said, result=ensemble)
    return ensemble


def _require(scene: Any, members: Any) -> None:
    require_type("gas_ensemble", "scene", scene, GasScene)
    require_count("gas_ensemble", "members", members, 2)
    require_memory("gas_ensemble", "members", members, BYTES_PER_REPORT, "take fewer gases")
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


def _mean_curve(curves: list[Array]) -> Curve:
    """Return the mean over curves (2, B), interpolated where they were sampled at different places."""
    x = curves[0][0]
    if any(not np.array_equal(one[0], x) for one in curves):
        # the k-th places of the gases are near each other: their median, where all have values
        count = min(len(one[0]) for one in curves)
        x = np.median([one[0][:count] for one in curves], axis=0)
        low, high = max(one[0][0] for one in curves), min(one[0][-1] for one in curves)
        shared = (x >= low) & (x <= high)
        # (gases that end early may have no time in common: their first samples then stand for each other)
        x = x[shared] if shared.any() else x[:1]
    rows = np.array([np.interp(x, *one) for one in curves])
    with np.errstate(invalid="ignore"):
        return Curve(x, rows.mean(axis=0), rows.std(axis=0, ddof=1) / math.sqrt(len(rows)))


# --- one way to run gases ------------------------------------------------------------------------------------------


@overload
def simulate_gas(
    species: Sequence[Species] | GasScene | str | Path, side: Any = None, *, ensemble: None = None, **options: Any
) -> Session: ...


@overload
def simulate_gas(
    species: Sequence[Species] | GasScene | str | Path, side: Any = None, *, ensemble: int, **options: Any
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
    store: str | Path | None = None,
    on: Any = "cores",
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
        Simulate so many independent gases, as :func:`gas_ensemble` does, with its ``store`` and ``on``.
    equilibrate : int, optional
        Number of collisions before; default: the scene's, or 40 per ball, none of a gas that cools.
    from_time : float or str, optional
        Simulated time before which nothing is measured; all means are then over the time after it.
    progress : callable(done, total, text), optional
        Called some ten times per second with the number of collisions so far, and of all (NaN: not known); of an ensemble with the
        number of gases that are done.

    Returns
    -------
    Session; with ``ensemble`` an Ensemble
        ``.result``: what ``carom gas`` prints, a :class:`GasRun`. ``.measures``: distributions, g(r), diffusion, profiles.
        ``.gas``: the balls at the end. ``gas, run = simulate_gas(...)`` takes it apart. Raises CaromError as :class:`Session` does.

    Examples
    --------
    >>> from carom import Ball, Surface, simulate_gas
    >>> from carom.gas import GasScene, Species
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
        return gas_ensemble(scene, ensemble, store=store, on=on, progress=progress)
    session, most = Session(scene, gas=Gas.of_scene(scene, **start) if start else None), scene.run.max_events
    total = math.nan if most is None else scene.equilibrate + most
    session.run(progress=progress and (lambda *_: progress(session.gas.collisions, total, "collisions")))
    return session
