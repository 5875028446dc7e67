"""Sweeps over single-particle billiards: exponents and phase portraits over families of tables."""

from __future__ import annotations

import functools
import math
import threading
from abc import ABC, abstractmethod
from collections.abc import Callable, Iterator, Mapping
from concurrent.futures import ThreadPoolExecutor
from typing import Annotated, Any, Literal

import numpy as np
from numpy.typing import NDArray
from pydantic import BeforeValidator, PlainValidator
from pydantic_core.core_schema import ValidationInfo

from carom.billiards.intersections import ENDS
from carom.billiards.orbits import orbit, starts
from carom.billiards.setup import default_ball, needs_surface
from carom.billiards.stability import lyapunov
from carom.billiards.tables import Table, table
from carom.bodies import Ball, Disc, Surface
from carom.core.jit.threads import thread_count
from carom.core.random import threefry
from carom.errors import CaromError, shown, suggestion
from carom.gas import initial
from carom.gas import measures as histograms
from carom.gas.edmd import driver
from carom.gas.report import report
from carom.gas.results import AT_REST, COLLAPSE, TOO_SLOW, EarlyEnd, EndedEarlyError
from carom.gas.scene import GasScene
from carom.gas.session import Session
from carom.laws.registry import laws
from carom.scene.figures import AnyFigure
from carom.scene.schema import Count, Friction, Model, Number, Share, Spring, refused
from carom.scene.toml import replaced, stored_model
from carom.scene.wall import permitted_law
from carom.sweeps.axes import FAILURES, Axis, Outcome, blank, check_paths, plain_value, require_outcomes, unit_of

Array = NDArray[Any]
REFUSED = FAILURES.index("refused")


class PointByPoint(ABC):
    """A sweep's subject that computes one point at a time; a kind of it says what a point is."""

    kind = ""

    def __init__(self, model: Any) -> None:
        self.model: Model = model

    def describe(self) -> str:
        """Return a few words."""
        return f"a{'n' if self.kind[0] in 'aeiou' else ''} {self.kind}"

    def to_data(self) -> dict[str, Any]:
        """Return the model as plain data."""
        return {self.kind: stored_model("sweep", self.model)}

    def units(self, path: str) -> str:
        """Return the unit of a parameter."""
        return unit_of(path)

    def check(self, parameters: Mapping[str, Axis]) -> None:
        """Raise CaromError for paths that lead nowhere or overlap, and for values that the model refuses."""
        check_paths(self.model, parameters)

    @abstractmethod
    def outcomes(self, names: tuple[str, ...]) -> list[Outcome]:
        """Return the outcomes of some names. CaromError with the nearest name."""

    @abstractmethod
    def compute(self, model: Any, seed: int, index: int) -> Mapping[str, Any]:
        """Return the outcomes of the point with this index."""

    def evaluate(
        self, columns: dict[str, Array], outcomes: list[Outcome], first: int, seed: int, tick: Any = None
    ) -> tuple[dict[str, Array], Array]:
        """Return the outcomes of N points by name, and (N,) the codes of those without one."""
        count = len(next(iter(columns.values())))
        found = {outcome.name: blank(outcome, count) for outcome in outcomes}
        failed = np.zeros(count, np.int8)
        for k, values in enumerate(self._computed(columns, range(count), seed, first)):
            if values is None:
                failed[k] = REFUSED
                continue
            for outcome in outcomes:
                found[outcome.name][k] = values[outcome.name]
            if tick is not None:
                tick()
        return found, failed

    def _computed(
        self, columns: dict[str, Array], points: range, seed: int, first: int
    ) -> Iterator[Mapping[str, Any] | None]:
        """Yield the outcomes of points one after the other; None where there are none."""
        for k in points:
            try:
                yield self.compute(self._at(columns, k), seed, first + k)
            except CaromError:
                yield None

    def _at(self, columns: dict[str, Array], k: int) -> Any:
        return replaced(self.model, {path: plain_value(column[k]) for path, column in columns.items()})

    def why(self, columns: dict[str, Array]) -> str:
        """Return why the one point of ``columns`` has no outcome; empty if it has one."""
        try:
            self.compute(self._at(columns, 0), 0, 0)
        except CaromError as error:
            return str(error)
        return ""


# ----------------------------------------------------------------------------------------------------
# Sweeps over single-particle billiards: exponents and phase portraits over families of tables.


_SIZE = Number("a length in m, > 0", "m", least=0, above=True)
Extent = Annotated[float, BeforeValidator(_SIZE)]
WORD = 0xFFFFFFFF


def _orbit_law(value: Any, info: ValidationInfo) -> str:
    """Validate the law of a billiard's wall."""
    if isinstance(value, str) and ".py" in value:
        return permitted_law(value, info)
    known = [name for law in laws().values() if law.kernel is not None for name in (law.name, *law.aliases)]
    if value not in known:
        raise refused(f"one of {', '.join(known)}, or file.py:name", shown(value), suggestion(str(value), known))
    return str(value)


class OrbitCase(Model):
    """Orbits of a ball in a table, from initial states drawn from the invariant measure: the options of ``carom orbit``.

    Parameters
    ----------
    table : the figure, as :func:`carom.scene.figures.figure` takes it: a text such as "stadium:straight=2,radius=1", or a table of
        its fields; its sizes are swept by their paths, such as ``table.straight``
    bounds : "centre" or "surface" of the ball
    law : "no-slip", "mirror", "contact", "rolling"
    kappa : I/(m a^2), in the plane any above 0; default: 0.5, in space 0.4
    restitution, friction, tangential_restitution : of the law "contact"
    bounces : of every orbit; default: 1000
    orbits : how many, at every point; default: 1

    Examples
    --------
    >>> import carom
    >>> case = carom.sweeps.OrbitCase(table="sinai", law="mirror", bounces=500)
    >>> space = carom.Space(case, {"table.radius": [0.2, 0.4]})
    >>> found = carom.sweep(space, keep=["lyapunov.largest"]).run()["lyapunov.largest"].values
    >>> bool((found > 0.3).all())
    True
    """

    table: AnyFigure
    bounds: Literal["centre", "surface"] = "centre"
    law: Annotated[str, PlainValidator(_orbit_law)] = "no-slip"
    kappa: Annotated[float, BeforeValidator(Number("kappa = I/(m a^2), > 0", least=0, above=True))] | None = None
    ball_radius: Extent | None = None
    restitution: Share = 1.0
    friction: Friction = float("inf")
    tangential_restitution: Spring = 0.0
    bounces: Count = 1000
    orbits: Count = 1

    @functools.cached_property
    def made(self) -> Table:
        """The table."""
        return table(self.table, bounds=self.bounds)

    @property
    def options(self) -> dict[str, Any]:
        """Ball, law and surface, as :func:`carom.billiards.orbit` takes them."""
        usual = default_ball(self.made)
        make = Disc if self.made.dimension == 2 else Ball
        ball = make(self.ball_radius or usual.radius, 1.0, self.kappa or usual.kappa)
        surface = Surface(self.restitution, self.friction, self.tangential_restitution)
        return {"ball": ball, "law": self.law, "surface": surface if needs_surface(self.law) else None}


OUTCOMES = {
    "lyapunov.largest": Outcome("lyapunov.largest"),
    "lyapunov.error": Outcome("lyapunov.error"),
    "lyapunov.spectrum": Outcome("lyapunov.spectrum", dims={"exponent": tuple(range(4))}),
    "bounces.count": Outcome("bounces.count"),
    "ended": Outcome("ended", "i1", meanings=ENDS),
    "time": Outcome("time", units="s"),
}


class Orbits(PointByPoint):
    """A sweep's subject: orbits in tables."""

    kind = "orbit"

    def outcomes(self, names: tuple[str, ...]) -> list[Outcome]:
        """Return the outcomes of some names. CaromError with the nearest name."""
        require_outcomes(names, list(OUTCOMES))
        self._names = names
        return [OUTCOMES[name] for name in names]

    def compute(self, model: OrbitCase, seed: int, index: int) -> dict[str, Any]:
        """Return the outcomes of a point: means over its orbits, the initial states drawn for its index."""
        options = model.options
        number = threefry(seed, 0, index & WORD, index >> 32)[0]
        begin = starts(model.made, model.orbits, number, ball=options["ball"], law=options["law"])
        found: dict[str, Any] = {}
        if any(name.startswith("lyapunov") for name in self._names):
            spectrum = lyapunov(model.made, begin, model.bounces, **options)
            largest = spectrum.per_bounce[..., 0]
            found["lyapunov.largest"] = np.nanmean(largest) if np.isfinite(largest).any() else np.nan
            spread = (
                np.nanstd(largest) / np.sqrt(max(model.orbits - 1, 1))
                if model.orbits > 1
                else spectrum.error[..., 0].max()
            )
            found["lyapunov.error"] = spread
            found["lyapunov.spectrum"] = spectrum.per_bounce.reshape(model.orbits, -1)[:, :4].mean(axis=0)
        if not all(name.startswith("lyapunov") for name in self._names):
            run = orbit(model.made, begin, model.bounces, **options)
            found["bounces.count"] = np.mean(run.count)
            found["ended"] = np.bincount(np.ravel(run.ending)).argmax()
            found["time"] = np.mean(run.last[..., 0])
        return found


# ----------------------------------------------------------------------------------------------------
# Sweeps over gases: one run a point; of an ensemble, whose seeds are swept, all numbers and curves of each.


TOTALS = (
    "pair_collisions", "wall_collisions", "simulated_time", "mean_free_time", "pressure", "energy_from_thermostat",
    "energy_drift", "temperature_translational", "temperature_rotational", "temperature_ratio", "max_overlap", "events", "time",
    "packing_fraction", "energy_start", "energy_end", "energy_imbalance", "diffusion",
)  # fmt: skip
OF_SPECIES = (
    "temperature_translational",
    "temperature_rotational",
    "temperature_ratio",
    "a2_translational",
    "a2_rotational",
)
# What an ensemble keeps of each gas: the numbers of its report, why it ended early (kind, time, collisions, balls), and curves.
REPORT, ENDED, CURVE = "report", "ended_early", "curve."
KINDS, MOST_BALLS, PLACES = (COLLAPSE, AT_REST, TOO_SLOW), 64, 256
SEED = "run.seed"


class Gases(PointByPoint):
    """A sweep's subject: the gas of a scene, what ``carom gas`` reports of it. Gases of a block run at once, on all cores."""

    kind = "gas"
    model: GasScene

    def check(self, parameters: Mapping[str, Axis]) -> None:
        """Raise CaromError for paths that lead nowhere or overlap, and for values that the model refuses."""
        super().check(parameters)
        self._has_seeds, self._whole = SEED in parameters, False

    def outcomes(self, names: tuple[str, ...]) -> list[Outcome]:
        """Return the outcomes of some names. CaromError with the nearest name."""
        if self._has_seeds and REPORT in names:
            self._whole = True
            sizes = {REPORT: len(_numbers(self.template)), ENDED: 3 + MOST_BALLS}
            own = {name: Outcome(name, dims={f"{name}.number": tuple(range(size))}) for name, size in sizes.items()}
            places = {"axis": ("x", "y"), "place": tuple(range(PLACES))}
            return [own.get(name) or Outcome(name, dims=dict(places)) for name in names]
        known = [*TOTALS, *(f"species.{one.name}.{part}" for one in self.model.species for part in OF_SPECIES)]
        require_outcomes(names, known)
        return [Outcome(name) for name in names]

    @functools.cached_property
    def template(self) -> dict[str, Any]:
        """A report of the same form as those of all its gases: after one collision, at most."""
        run = {"equilibrate": 0, "max_events": 1, "from_time": None}
        session = Session(self.model.model_copy(update={"run": self.model.run.model_copy(update=run)}))
        assert session.measures is not None
        session.measures.sample(session.gas)
        return report(session)

    def compute(
        self, model: GasScene, seed: int, index: int, stop: Callable[[], bool] = lambda: False
    ) -> dict[str, Any]:
        """Return the report of a run whose seed is swept, or follows from the sweep's, the scene's, and the point's index."""
        if not self._has_seeds:
            number = threefry(seed, model.run.seed & WORD, index & WORD, index >> 32)[0]
            model = replaced(model, {SEED: number})
        session, end = Session(model), None
        try:
            for _ in session.pieces(stop=stop):
                pass
        except EndedEarlyError as error:
            if not (self._whole and session.measuring):
                raise
            end = error.end
        if not session.finished and end is None:
            raise CaromError("sweep: expected gases that run to their ends, got an interrupt")
        found = report(session)
        if self._whole:
            return _kept(session, found, end)
        own = {
            f"species.{name}.{part}": value for name, parts in found["species"].items() for part, value in parts.items()
        }
        return {**{name: found[name] for name in TOTALS if name in found}, **own}

    def _computed(
        self, columns: dict[str, NDArray[Any]], points: range, seed: int, first: int
    ) -> Iterator[Mapping[str, Any] | None]:
        """Yield the outcomes of points, each computed by a thread of its own, in their order."""
        loops = (driver.compiled_loops, histograms.compiled_loops, initial.compiled_loops, initial.compiled_search)
        for made in loops:  # once, before several threads ask for them
            made()
        halted = threading.Event()

        def computed(k: int) -> Mapping[str, Any] | None:
            try:
                return self.compute(self._at(columns, k), seed, first + k, halted.is_set)
            except CaromError:
                return None

        with ThreadPoolExecutor(thread_count()) as pool:
            try:
                yield from pool.map(computed, points)
            finally:  # (after Ctrl-C: the gases end between two pieces of their runs)
                halted.set()
                pool.shutdown(cancel_futures=True)


# --- a report as numbers -------------------------------------------------------------------------------------------


def _numbers(found: Any) -> list[float]:
    """Return the numbers in a report, in their order."""
    if isinstance(found, dict):
        return [x for name, part in found.items() if name != ENDED for x in _numbers(part)]
    if isinstance(found, list):
        return [x for part in found for x in _numbers(part)]
    return [] if isinstance(found, str | tuple) else [float(found)]


def refilled(form: Any, numbers: Iterator[float], whole: bool) -> Any:
    """Return a report of a form with other numbers; ``whole``: counts are whole numbers, as they are of one gas."""
    if isinstance(form, dict):
        names = [name for name in form if whole or name != ENDED]
        return {name: None if name == ENDED else refilled(form[name], numbers, whole) for name in names}
    if isinstance(form, list):
        return [refilled(part, numbers, whole) for part in form]
    if isinstance(form, str | tuple):
        return form
    return type(form)(next(numbers)) if whole else next(numbers)


def _kept(session: Session, found: dict[str, Any], end: EarlyEnd | None) -> dict[str, Any]:
    """Return what an ensemble keeps of a gas, by outcome."""
    ended = np.full(3 + MOST_BALLS, np.nan)
    if end is not None:
        ended[:3] = KINDS.index(end.kind), end.time, math.nan if end.collisions is None else end.collisions
        ended[3 : 3 + len(end.balls)] = end.balls[:MOST_BALLS]
    values: dict[str, Any] = {REPORT: _numbers(found), ENDED: ended}
    for name, rows in _curves(session).items():
        values[CURVE + name] = np.full((2, PLACES), np.nan)
        values[CURVE + name][:, : len(rows[0])] = [row[:PLACES] for row in rows]
    return _Kept(values)


class _Kept(dict[str, Any]):
    """What is kept; of a curve that a gas has not, nothing."""

    def __missing__(self, name: str) -> float:
        return math.nan


def curve_names(scene: GasScene) -> list[str]:
    """Return the names of all curves that gases of a scene may have."""
    names = [one.name for one in scene.species]
    warm = [
        f"temperature_{part}{kind}"
        for part in ("translational", "rotational")
        for kind in ("", *(f".{one}" for one in names))
    ]
    own = [f"{what}.{name}" for name in names for what in ("velocity", "spin", "density")]
    pairs = [f"pair_correlation.{one}.{other}" for k, one in enumerate(names) for other in names[k:]]
    return [*warm, *own, *pairs, "displacement", "displacement_by_collisions"]


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
