"""The table that filmed shots share, and the result of a fit to them."""

from __future__ import annotations

import contextlib
import functools
import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, fields
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from carom.bodies import Ball, holds_arrays
from carom.core.motion.phases import REST
from carom.errors import CaromError
from carom.fitting.evidence import akaike
from carom.fitting.laws import FittedLaw
from carom.fitting.result import Estimate, common_dict, with_error_bar
from carom.fitting.shots.search import FIRST_PLACE, SPIN, TIME, VELOCITY, FilmedEvent, FilmedShot, Films, ShotStart
from carom.fitting.table_numbers import MOVED, RankedByShots, SharedNumber, TableNumbers, cushions_between, reach_of
from carom.formatting import called_ball, counted, json_value
from carom.laws.strike import DEFAULT_CUE, Cue, strike
from carom.scene.ball import CueStrike, SceneCue
from carom.scene.floor import Floor
from carom.scene.scene import Run, Scene
from carom.scene.shapes import Table
from carom.scene.toml import path_match, replaced
from carom.simulation.records import SceneArrays, set_up
from carom.simulation.sensitivity.follow import Parameters, parameters_of
from carom.simulation.simulate import simulate
from carom.simulation.trajectory import Trajectory

Array = NDArray[np.float64]
SIDES = {"left": "right", "right": "left", "bottom": "top", "top": "bottom"}  # and the one across
NOSE, MASS = 0.037, 0.21  # m, of a carom cushion; kg, of a ball
SPIN_LOSS, GRAVITY = 2.0, 9.80665  # rad/s^2 of spin about the vertical, where the search begins
ROUNDING = 1e-13  # of the largest number of a field
AFFINE_AT = 4  # places within the bounds
TERMS = {"walls.0.yield_time": 2.5e-3, "floor.rolling_drag": 2e-3, "floor.spin_drag": 3.0}
"""Numbers that most scenes leave at zero, and where a search for them begins."""
FREE = (
    "walls.0.restitution", "walls.0.friction", "floor.friction", "floor.rolling_resistance", "floor.spin_friction",
    "ball_contact.restitution", "ball_contact.friction", "walls.0.length", "walls.0.width", "walls.0.center", *TERMS,
)  # fmt: skip
"""The numbers of a scene that are fitted where nothing else is said."""
# By the end of a path: least and greatest value, and usual change; of lengths about their value.
LENGTHS = ("length", "width", "x", "y")
KNOWN = {
    "restitution": (0.3, 1.0, 0.02), "coefficients.0": (0.3, 1.2, 0.02), "coefficients.1": (-0.3, 0.3, 0.01),
    "coefficients.2": (-0.1, 0.1, 0.003), "yield_time": (0.0, 0.02, 5e-4), "rolling_drag": (0.0, 0.02, 5e-4),
    "spin_damping": (0.0, 2.0, 0.03), "spin_drag": (0.0, 20.0, 0.3), "slope.x": (-0.01, 0.01, 1e-4), "slope.y": (-0.01, 0.01, 1e-4),
}  # fmt: skip


@dataclass(frozen=True, eq=False)
class TableModel:
    """A scene with as many balls as the shots have, and the paths that are fitted."""

    scene: Scene
    paths: tuple[str, ...]
    bounds: Mapping[str, tuple[float, float]]

    def __getstate__(self) -> dict[str, Any]:
        """Without what is made of the scene: its arrays have addresses of this process."""
        return {one.name: getattr(self, one.name) for one in fields(self)}

    @functools.cached_property
    def _parameters(self) -> Any:
        arrays = set_up(self.scene)
        return parameters_of(self.scene, arrays, self.paths, [REST] * len(self.scene.balls)) if self.paths else None

    @functools.cached_property
    def shared(self) -> list[SharedNumber]:
        """The numbers that are fitted."""
        return (
            [] if self._parameters is None else [self._number(one.name, one.value) for one in self._parameters.columns]
        )

    def _number(self, name: str, value: float) -> SharedNumber:
        last = name.rpartition(".")[2]
        known = next((end for end in KNOWN if name.endswith(f".{end}")), None)
        if known is not None:
            low, high, scale = KNOWN[known]
            low, high = min(low, value), max(high, value)
        elif last in LENGTHS and "coefficients" not in name:
            low, high, scale = value - 0.05, value + 0.05, 0.005
        else:
            size = max(abs(value), 1e-3)
            low, high, scale = (0.0 if value >= 0 else -10 * size), max(10 * size, 0.02), 0.1 * size
        low, high = self.bounds.get(name, (low, high))
        return SharedNumber(name, value, low, high, scale)

    def scene_at(self, values: Array) -> Scene:
        """Return the scene at values (P,) of the shared numbers."""
        scene, wanted = self.scene, dict(zip((one.name for one in self.shared), values.tolist(), strict=True))
        changes: dict[str, Any] = {}
        for column in self._parameters.columns if self.paths else ():
            for place in path_match(scene, column.path).places:
                path = ".".join(map(str, place))
                if column.component is None:
                    changes[path] = wanted[column.name]
                else:
                    old = changes.get(path, path_match(scene, path).values[0])
                    changes[path] = tuple(
                        wanted[column.name] if k == column.component else x for k, x in enumerate(old)
                    )
        return replaced(scene, changes) if changes else scene

    def values_in(self, scene: Scene) -> Array:
        """Return the values (P,) that the shared numbers have in another scene; NaN where it has no such number."""
        found = np.full(len(self.shared), np.nan)
        for k, column in enumerate(self._parameters.columns if self.paths else ()):
            with contextlib.suppress(CaromError):
                value = path_match(scene, column.path).values[0]
                value = value if column.component is None else value[column.component]
                value = getattr(value, "value", value)
                found[k] = value if isinstance(value, int | float) else np.nan
        return found

    def at(self, values: Array) -> TableNumbers:
        """Return the table at values (P,) of the shared numbers, with derivatives; CaromError where no scene has these."""
        if self._start is not None:
            return self._start.at(values)
        scene = self.scene_at(values)
        arrays = set_up(scene)
        found = parameters_of(scene, arrays, self.paths, [REST] * len(scene.balls)) if self.paths else None
        return TableNumbers(tuple(self.shared), values, scene, arrays, found)

    @functools.cached_property
    def _start(self) -> TableNumbers | None:
        """The table as it is, where the arrays are affine in the numbers: a scene takes five milliseconds, its derivatives a
        hundred. That they are affine shows at the bounds and at some values within, where there are scenes and these follow."""
        if not self.shared:
            return None
        value, low, high = (np.array([getattr(one, name) for one in self.shared]) for name in ("value", "low", "high"))
        inside = low + (high - low) * np.random.default_rng(0).random((AFFINE_AT, len(low)))
        # (numbers that must not be larger than another stand beside it)
        odd = np.arange(len(low)) % 2 == 1
        for values in (np.where(odd, low, high), np.where(odd, high, low), low, high, *inside):
            try:
                arrays = set_up(self.scene_at(values), compiled=False)
            except CaromError:
                return None
            if not _follow(self._parameters, arrays, values - value):
                return None
        return TableNumbers(tuple(self.shared), value, self.scene, self._parameters.arrays, self._parameters)


def _follow(known: Parameters, arrays: SceneArrays, by: Array) -> bool:
    """Return whether arrays follow from those of parameters that differ by (P,), and their derivatives, to rounding."""
    for array in MOVED:
        there, here = getattr(known.arrays, array), getattr(arrays, array)
        if len(there) != len(here):
            return False
        for name in here.dtype.names:
            x, then, size = here[name], there[name], np.abs(there[name])
            if name in known.slopes[0][array]:
                changes = [d * one[array][name] for d, one in zip(by.tolist(), known.slopes, strict=True)]
                then, size = then + sum(changes), np.maximum(size, np.abs(changes).max(axis=0))
            rounding = ROUNDING * size[np.isfinite(size)].max(initial=0.0)  # (also of a number that becomes 0)
            if not np.allclose(x, then, rtol=0.0, atol=rounding, equal_nan=True):
                return False
    return True


def scene_of_films(
    table: Scene | None, films: Films, radius: float | None, count: int, duration: float, where: str
) -> Scene:
    """Return the scene with ``count`` balls: the one given, or a carom table between the lines of the films."""
    if table is None:
        if radius is None:
            raise CaromError(f"{where}: `radius`: expected the balls' radius in m, got none; a carom ball has 30.75 mm")
        a, ball = radius, dict[str, Any](radius=radius, mass=MASS)
        shape = _table_between(films, a, where)
        given: dict[str, Any] = {
            "floor": Floor(friction=0.2, rolling_resistance=0.006, spin_friction=0.4 * a * SPIN_LOSS / GRAVITY),
            "walls": (shape,), "ball_contact": {"restitution": 0.95, "friction": 0.06}, "run": Run(),
        }  # fmt: skip
    else:
        first = table.balls[0]
        a, ball = (
            radius or first.radius,
            {"radius": radius or first.radius, "mass": first.mass, "inertia": first.inertia},
        )
        found = next((wall for wall in table.walls if isinstance(wall, Table)), None)
        if found is None or table.floor is None:
            raise CaromError(f"{where}: table: expected a scene with a floor and a wall of the shape table, got none")
        shape, given = found, _fields(table)
    places = [(shape.center[0] + 3 * a * (k - (count - 1) / 2), shape.center[1]) for k in range(count)]
    given["balls"] = [ball | {"position": at} for at in places]
    given["run"] = given["run"].model_copy(update={"duration": duration, "max_events": None})
    return Scene(**given)


def begun(scene: Scene, free: Sequence[str]) -> tuple[Scene, tuple[str, ...]]:
    """Return the scene from which a search begins, and the paths of ``free``: of a term at zero a usual value (there it has no
    derivative on one side), of a cushion's number that it has from the table the table's, of the two laws of the loss of spin the
    one that the scene has.
    """
    paths = list(dict.fromkeys(free))
    other = {"floor.spin_damping": "floor.spin_drag", "floor.spin_drag": "floor.spin_damping"}
    for path, against in other.items():
        taken = path_match(scene, against).values[0] > 0 or (path in TERMS and against in paths)
        if path in paths and taken:
            paths.remove(path)
    starts = TERMS | {"floor.spin_damping": 0.1}
    zero = {path: x for path, x in starts.items() if path in paths and path_match(scene, path).values[0] == 0}
    own = {path: path_match(scene, of_table(path)).values[0] for path in paths if _taken_from_table(scene, path)}
    return (replaced(scene, zero | own) if zero or own else scene), tuple(paths)


def of_table(path: str) -> str:
    """Return the path of the table's number in the place of that of one of its cushions; other paths as they are."""
    wall, found, rest = path.partition(".sides.")
    return f"{wall}.{rest.partition('.')[2]}" if found else path


def _taken_from_table(scene: Scene, path: str) -> bool:
    return of_table(path) != path and path_match(scene, path).values[0] is None


def _fields(scene: Scene) -> dict[str, Any]:
    return {name: getattr(scene, name) for name in type(scene).model_fields if name != "rack"}


def table_of(scene: Scene) -> Table:
    """Return the table of a scene of :func:`scene_of_films`."""
    return next(wall for wall in scene.walls if isinstance(wall, Table))


def with_balls(scene: Scene, balls: Sequence[dict[str, Any]]) -> Scene:
    """Return a scene with other balls; they are moved apart, and off the cushions, by as little as it takes.

    (Fitted first places overlap by less than the error of a frame.)
    """
    try:
        return Scene(**(_fields(scene) | {"balls": balls}))
    except CaromError:
        return Scene(**(_fields(scene) | {"balls": _apart(balls, table_of(scene))}))


def _apart(balls: Sequence[dict[str, Any]], wall: Table) -> list[dict[str, Any]]:
    a = balls[0]["radius"]
    reach = reach_of(a, wall.nose_height)
    half, middle = np.array([wall.length, wall.width]) / 2 - reach * (1 + 1e-9), np.array(wall.center)
    places = np.array([one["position"] for one in balls])
    for _ in range(3):
        places = np.clip(places, middle - half, middle + half)
        for i in range(len(places)):
            for j in range(i):
                gap = places[i] - places[j]
                size = float(np.hypot(*gap))
                if size < 2 * a * (1 + 1e-9):
                    places[i] += gap / max(size, 1e-9) * (2 * a * (1 + 2e-9) - size)
    return [one | {"position": tuple(at)} for one, at in zip(balls, places.tolist(), strict=True)]


def _table_between(films: Films, a: float, where: str) -> Table:
    """Return a carom table whose cushions reflect centres at the lines of the films; a field is twice as long as wide."""
    at = {wall.name: wall.point[int(abs(wall.normal[1]) > 0.5)] for wall in films.walls}
    nose = NOSE if a < NOSE < 2 * a else None
    missing = [side for side in SIDES if side not in at]
    if len(missing) == 1:
        side, other = missing[0], SIDES[missing[0]]
        axis = int(side in ("bottom", "top"))
        low, high = ("left", "right") if axis else ("bottom", "top")
        reach = reach_of(a, nose)
        across = at[high] - at[low] + 2 * reach
        far = max(float(np.abs(shot.position[shot.known][:, axis] - at[other]).max()) for shot in films.shots)
        size = across * (2 if far > across / 2 else 0.5)
        at[side] = at[other] + (1 if side in ("right", "top") else -1) * (size - 2 * reach)
        taken = f"taken to be {size:.2f} m from the {other} one, as a field is twice as long as wide"
        films.notes.append(f"no ball reaches the {side} cushion: {taken}")
    elif missing:
        names = ", ".join(missing)
        raise CaromError(
            f"{where}: expected shots that reach three cushions at least, got none at {names}: give the table as a scene"
        )
    return cushions_between(at, a, nose, restitution=0.83, friction=0.22)


# ----------------------------------------------------------------------------------------------------
# The stroke of a ball that has left the cue with a velocity and a spin.


MOST = 0.7  # radii of an offset along each axis: a tip slips before
STEEPEST = 60.0  # degrees
FASTEST = 2.0  # times the speed of the ball


def stroke_of(ball: Ball, velocity: ArrayLike, spin: ArrayLike, cue: Cue = DEFAULT_CUE) -> CueStrike:
    """Return the stroke after which a ball has a velocity (2,), m/s, along the table and a spin (3,), rad/s, or comes nearest.

    Five numbers of the ball give five of the stroke: speed, azimuth, elevation, and the offset to the right and up. (A film tells
    little of the spin about the way of the ball, on which the elevation depends most.)

    Examples
    --------
    >>> import carom
    >>> from carom.fitting.shots import stroke_of
    >>> ball = carom.Ball(0.03075, 0.21)
    >>> after = carom.strike(ball, speed=3.0, azimuth_deg=30.0, elevation_deg=5.0, offset=(0.3, 0.2)).state
    >>> found = stroke_of(ball, after.velocity[:2], after.spin)
    >>> round(found.speed, 3), round(found.azimuth, 2), round(found.elevation, 2), [round(x, 3) for x in found.offset]
    (3.0, 30.0, 5.0, [0.3, 0.2])
    """
    from scipy.optimize import least_squares

    v, w, a = np.asarray(velocity, dtype=float), np.asarray(spin, dtype=float), float(ball.radius)
    size = max(float(np.hypot(*v)), 1e-9)
    wanted = np.concatenate([v, a * w]) / size

    def gap(p: np.ndarray) -> np.ndarray:
        after = strike(ball, cue, size * p[0], np.degrees(p[1]), p[2], p[3:]).state
        return np.concatenate([after.velocity[:2], a * after.spin]) / size - wanted

    along = float(np.arctan2(v[1], v[0]))
    low, high = [1e-3, along - 1.0, 0.0, -MOST, -MOST], [FASTEST, along + 1.0, STEEPEST, MOST, MOST]
    best = min(
        (
            least_squares(gap, [0.8, along, 5.0, side * 0.2, up], bounds=(low, high), x_scale=[1, 0.1, 10, 0.3, 0.3])
            for side in (-1, 1)
            for up in (-0.2, 0.2)
        ),
        key=lambda found: float(found.cost),
    )
    speed, turn, raised, right, up = best.x.tolist()
    numbers = {name: float(getattr(cue, name)) for name in SceneCue.model_fields}
    return CueStrike(
        speed=size * speed,
        azimuth=float(np.degrees(turn)),
        elevation=raised,
        offset=(right, up),
        cue=SceneCue(**numbers),
    )


# ----------------------------------------------------------------------------------------------------
# The result of a fit to whole shots: each shot beside its film, the table's numbers with their errors, and all laws ranked.


HORIZONS = ("ball", "cushion 1", "cushion 2", "cushion 3", "whole")
"""To the first event after the first ball; to the cue ball's cushions after the first one; to rest."""
TOLERANCE_S, TOLERANCE_SHARE = 0.06, 0.02  # between an event of the film and one of the model, of the time
TOO_LATE_S = 0.15  # before the last frame, in which a film does not show that a ball has turned
FAILED = 0.1  # m: a shot whose distance (rms) is larger is not followed


def criterion(deviance: float, k: int, n: int) -> float:
    """Return Akaike's criterion of k numbers fitted to n; without the correction for few data where n is too small for it."""
    return akaike(deviance, k, n) if n > k + 1 else deviance + 2 * k


class EventMatch(NamedTuple):
    """Events that only the film has, and events that only the model has, in words."""

    film_only: list[str]
    model_only: list[str]


@dataclass(frozen=True, eq=False)
class FittedShot:
    """One shot beside its film; made by :func:`carom.fit_shots`."""

    film: FilmedShot
    start: Array
    """(K,): time at which the cue ball sets off (s), velocity (m/s), spin times radius (m/s), first places of the balls (m)."""
    scene: Scene
    """The table with the balls as they start; its time begins when the cue ball sets off."""
    distance: Array
    """(T, B) m, from film to model; NaN where the film has no row of a ball."""
    by_horizon: dict[str, float]
    """m: distance (rms) up to each horizon of HORIZONS that the shot reaches, with the start fitted to these frames."""
    deviations: dict[str, float] = field(default_factory=dict)
    """By how much the table's numbers differ for this shot, where they scatter from shot to shot."""

    @property
    def name(self) -> str:
        """Name of the shot."""
        return self.film.name or "film"

    @property
    def velocity(self) -> Array:
        """(2,) m/s, with which the cue ball sets off."""
        return np.array(self.start[VELOCITY])

    @property
    def spin(self) -> Array:
        """(3,) rad/s, with which the cue ball sets off."""
        return np.array(self.start[SPIN] / self.scene.balls[0].radius)

    @property
    def time(self) -> float:
        """When the cue ball sets off, s of the film."""
        return float(self.start[TIME])

    @property
    def stroke(self) -> CueStrike:
        """The stroke of an ordinary cue with which the ball sets off so: :func:`carom.fitting.shots.stroke_of`."""
        one = self.scene.balls[0]
        return stroke_of(Ball(one.radius, one.mass), self.velocity, self.spin)

    @property
    def rms(self) -> float:
        """Root mean square distance over all frames of all balls, m."""
        return float(np.sqrt(np.nanmean(np.square(self.distance))))

    @property
    def followed(self) -> bool:
        """Whether the model follows the shot at all."""
        return self.rms < FAILED

    def simulate(self) -> Trajectory:
        """Simulate the shot; its time 0 is the film's :attr:`time`."""
        return simulate(self.scene)

    def events(self) -> EventMatch:
        """Compare the events of film and model: kisses and cushions that only one of them has, in order of time."""
        last = float(self.film.time[-1]) - TOO_LATE_S
        film = [one for one in self.film.events if one.high < last]
        model = self._model_events()
        lonely: list[tuple[float, str]] = []
        for time, kind, ball, other in model:
            match = next((one for one in self.film.events if self._same(one, time, kind, ball, other)), None)
            if match is None:
                lonely.append((time, self._words(time, kind, ball, other)))
            elif match in film:
                film.remove(match)
        names = self.film.balls
        return EventMatch(
            [self._words((one.low + one.high) / 2, one.kind, names[one.ball], one.other) for one in film],
            [words for _time, words in sorted(lonely)],
        )

    @staticmethod
    def _words(time: float, kind: str, ball: str, other: str) -> str:
        met = called_ball(other) if kind == "ball" else f"the {other} cushion"
        return f"{called_ball(ball)} meets {met} at {time:.2f} s"

    def _same(self, one: FilmedEvent, time: float, kind: str, ball: str, other: str) -> bool:
        names = self.film.balls
        near = TOLERANCE_S + TOLERANCE_SHARE * time
        both = {names[one.ball], one.other} == {ball, other}
        return one.kind == kind and both and one.low - near <= time <= one.high + near

    def _model_events(self) -> list[tuple[float, str, str, str]]:
        """Return the model's events on the film's clock: time, kind, ball, and the other ball or side."""
        run = self.simulate()
        names, last, found = self.film.balls, float(self.film.time[-1]) - TOO_LATE_S, []
        table = table_of(self.scene)
        half = np.array([table.length, table.width]) / 2
        pairs: set[tuple[float, int]] = set()
        for event in run.events.of("wall", "ball"):
            time = float(event.t) + self.time
            if time > last:
                continue
            k = run.index(event.ball)
            if event.kind == "wall":
                x = np.asarray(event.after.position)[:2] - table.center
                gaps = [half[0] + x[0], half[0] - x[0], half[1] + x[1], half[1] - x[1]]
                found.append((time, "wall", names[k], ("left", "right", "bottom", "top")[int(np.argmin(gaps))]))
            elif (event.t, k) not in pairs:
                other = run.index(event.other)
                pairs.add((event.t, other))
                found.append((time, "ball", names[k], names[other]))
        return found


@holds_arrays
class OneTable(NamedTuple):
    """The fit on one table for all shots, before numbers scatter between them: there laws are compared."""

    values: Array
    """(P,)"""
    starts: tuple[ShotStart, ...] = ()


class Halves(NamedTuple):
    """Two halves of the shots, each fitted from scratch, beside each other."""

    squares: float = 0.0
    """Sum of squares of the differences of their numbers, in error bars."""
    numbers: int = 0
    """That have an error bar in both; 0 where the shots are too few for halves."""

    @property
    def enlarge(self) -> float:
        """The factor of the error bars with which the mean square is 1; 1 where it is less."""
        return math.sqrt(max(1.0, self.squares / self.numbers)) if self.numbers else 1.0


@dataclass(frozen=True, eq=False, repr=False)
class ShotsFit:
    """A law of the cushions fitted to whole shots; made by :func:`carom.fit_shots`, with an example there."""

    law: FittedLaw
    scene: Scene
    """The table with the fitted numbers."""
    shots: tuple[FittedShot, ...]
    estimates: dict[str, Estimate]
    """The numbers that all shots share, by their path in the scene."""
    covariance: Array
    """(P, P)"""
    deviance: float
    """Sum over shots of n log(mean square distance up to the joint horizon), n: two for each ball and stretch between events."""
    count: int
    """The sum of these n."""
    events: int
    """The joint horizon: events of each shot up to which the shared numbers were fitted."""
    noise: float
    """m, of one coordinate of one frame, estimated."""
    by_shots: bool = False
    """Whether the errors are from the scatter of shots, not from the noise of frames."""
    degenerate: tuple[str, ...] = ()
    untold: tuple[str, ...] = ()
    model: TableModel = field(kw_only=True)
    values: Array = field(kw_only=True)
    """(P,) of the shared numbers, also of those that are not identifiable."""
    widths: Array | None = field(kw_only=True, default=None)
    """(P,) standard deviations of the shared numbers between shots; None where these are too few to tell."""
    starts: tuple[ShotStart, ...] = field(kw_only=True, default=())
    """Up to the joint horizon, where the numbers are fitted."""
    one_table: OneTable = field(kw_only=True)
    halves: Halves = field(kw_only=True, default=Halves())

    @property
    def table(self) -> TableNumbers:
        """The table at the fitted numbers, with derivatives."""
        return self.model.at(self.values)

    @property
    def scatter(self) -> dict[str, float]:
        """Standard deviations of the shared numbers between shots, by path."""
        return {} if self.widths is None else dict(zip(self.names, self.widths.tolist(), strict=True))

    @property
    def names(self) -> tuple[str, ...]:
        """Paths of the shared numbers."""
        return tuple(self.estimates)

    @property
    def k(self) -> int:
        """Number of adjusted numbers that differ between laws: shared ones, and the scatter of each shot."""
        return len(self.estimates) + len(self.shots)

    @property
    def aicc(self) -> float:
        """Akaike's criterion for few data (Hurvich & Tsai 1989); the starts, which all laws have, are not counted."""
        return criterion(self.deviance, self.k, self.count)

    @property
    def chi2(self) -> float:
        """NaN: no law follows whole shots to the noise of their frames."""
        return float("nan")

    @property
    def dof(self) -> int:
        """Independent numbers beyond those that are fitted."""
        return max(self.count - self.k, 0)

    def horizon(self, name: str) -> Array:
        """Return the distances (rms, m) of the shots that reach a horizon of HORIZONS."""
        if name not in HORIZONS:
            raise CaromError(f"ShotsFit.horizon: expected one of {', '.join(HORIZONS)}, got {name!r:.60}")
        return np.array([one.by_horizon[name] for one in self.shots if name in one.by_horizon])

    def median(self, name: str = "whole") -> float:
        """Return the median over the shots of the distance (rms, m) up to a horizon; NaN where no shot reaches it."""
        found = self.horizon(name)
        return float(np.median(found)) if len(found) else float("nan")

    def describe(self) -> list[str]:
        """Return sentences: the distances by horizon, shots that are not followed, and events that film and model do not share."""
        heads = {"ball": "to the first ball", "whole": "to rest"}
        parts = [
            f"{heads.get(name, 'through ' + name)} {1e3 * self.median(name):.1f} mm ({len(self.horizon(name))})"
            for name in HORIZONS
            if len(self.horizon(name))
        ]
        found = [f"Distance from film to model, median of the shots (their number): {', '.join(parts)}."]
        if self.scatter:
            each = ", ".join(f"{name} {width:.2g}" for name, width in self.scatter.items())
            found.append(f"Scatter between shots (standard deviation): {each}.")
        if self.halves.numbers:
            wider = (
                f"; the error bars are {self.halves.enlarge:.2g} times as wide for it"
                if self.halves.enlarge > 1
                else ""
            )
            found.append(
                f"Two halves of the shots, each searched from scratch: {counted(self.halves.numbers, 'number')} differ by"
                f" {self.halves.squares:.3g} (sum of squares, in error bars){wider}."
            )
        lost = [one for one in self.shots if not one.followed]
        if lost:
            each = ", ".join(f"{one.name} ({1e3 * one.rms:.0f} mm)" for one in lost)
            found.append(f"Not followed: {each}.")
        for one in self.shots:
            match = one.events()
            for who, words in (("film", match.film_only), ("model", match.model_only)):
                if words and one.followed:
                    more = f" and {counted(len(words) - 2, 'more event')}" if len(words) > 2 else ""
                    found.append(f"{one.name}: only the {who} has: {'; '.join(words[:2])}{more}.")
        return found

    def as_dict(self) -> dict[str, Any]:
        """Return the fit for JSON."""
        return common_dict(self) | {
            "joint_horizon_events": self.events,
            "scatter_between_shots": self.scatter,
            "halves": {**self.halves._asdict(), "enlarge": self.halves.enlarge},
            "median_rms": {name: json_value(self.median(name)) for name in HORIZONS},
            "shots": [
                {
                    "shot": one.name, "balls": list(one.film.balls), "rms": one.rms, "rms_by_horizon": one.by_horizon,
                    "followed": one.followed, "time": one.time, "velocity": one.velocity.tolist(), "spin": one.spin.tolist(),
                    "deviations": one.deviations,
                    "places": one.start[FIRST_PLACE:].reshape(-1, 2).tolist(),
                    "events_of_film_only": one.events().film_only, "events_of_model_only": one.events().model_only,
                }
                for one in self.shots
            ],
        }  # fmt: skip

    def __repr__(self) -> str:
        """Return one line."""
        return (
            f"<ShotsFit: {self.law.name}, {counted(len(self.shots), 'shot')}, whole {1e3 * self.median():.1f} mm,"
            f" {', '.join(f'{name} {with_error_bar(one)}' for name, one in list(self.estimates.items())[:2])}, ...>"
        )


@dataclass(frozen=True, eq=False, repr=False)
class ShotsRanking(RankedByShots[ShotsFit]):
    """Laws of the cushions fitted to whole shots, best first, with a verdict; made by :func:`carom.fit_shots`."""

    def describe(self) -> list[str]:
        """Return the sentences of the best fit, after the verdict."""
        return [self.verdict, *self.best.describe()]
