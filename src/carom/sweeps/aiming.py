"""Starts that reach a target: a coarse sweep for sequences of events that do, least squares with exact gradients within each."""

from __future__ import annotations

import copy
import itertools
import math
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from carom.core.geometry.circles import direction
from carom.core.motion.phases import BOUNCING, FLIGHT, ROLLING, SLIDING
from carom.errors import MAX_MAGNITUDE, CaromError, FaultList, float_or_nan, require_count, require_type, shortened_list
from carom.files import import_optional
from carom.formatting import Listing, counted, format_number
from carom.public.progress import Progress, loop_callback
from carom.scene.scene import Scene
from carom.scene.toml import path_match, replaced
from carom.simulation.contact_kinds import partner_names
from carom.simulation.records import START, set_up
from carom.simulation.simulate import run_starts, simulate
from carom.sweeps.draws import polar_rows
from carom.sweeps.shots import start_states
from carom.sweeps.targets import (
    EVENTS,
    Outcomes,
    TargetEvent,
    find,
    is_reached,
    residuals,
    shot_codes,
    shot_of,
    sizes,
    slopes,
    targets_of,
)  # fmt: skip

if TYPE_CHECKING:
    from carom.simulation.trajectory import Trajectory

Array = NDArray[np.float64]
# Range in which a start is looked for, and a player's error (one standard deviation; of speeds, a share of them).
SPEED, ANGLE = (0.5, 6.0), (0.0, 360.0)
RANGES = {"speed": SPEED, "angle": ANGLE, "azimuth": ANGLE, "elevation": (0.0, 30.0), "side": (-0.5, 0.5), "top": (-0.5, 0.5),
          "spin_z": (-100.0, 100.0)}  # fmt: skip
ERRORS = {"speed": 0.03, "angle": 0.2, "azimuth": 0.2, "elevation": 0.5, "side": 0.02, "top": 0.02, "spin_z": 2.0}
UNITS = {"speed": "m/s", "side": "radii", "top": "radii", "spin_z": "rad/s"}
UNITS |= dict.fromkeys(("angle", "azimuth", "elevation"), "°")
# What each kind of path has for unknowns.
PARTS = {
    "velocity": ("speed", "angle"),
    "strike": ("speed", "azimuth"),
    "offset": ("side", "top"),
    **{name: (name,) for name in ("azimuth", "elevation", "spin_z")},
}
# Within what a range may lie.
LIMITS = {"speed": (0.0, MAX_MAGNITUDE), "elevation": (0.0, 90.0), "side": (-1.0, 1.0), "top": (-1.0, 1.0)}
WHERE = "aim: free"
EXPECTED = (
    "one ball's velocity, spin_z, strike, or strike.offset, .azimuth, .elevation, .speed, such as 'balls.0.velocity'"
)


class Unknown(NamedTuple):
    """One number of the start."""

    name: str
    path: str
    """Path of the number in the scene, or of the vector that contains it."""
    low: float
    high: float
    error: float
    """The player's: one standard deviation; of a speed, as a share of it."""

    @property
    def circular(self) -> bool:
        """Whether it is an angle that goes round."""
        return self.name in ("angle", "azimuth") and self.high - self.low >= 360

    @property
    def unit(self) -> str:
        """Its unit."""
        return UNITS[self.name]

    def sigma(self, x: Any) -> Any:
        """Return the player's error at a value."""
        return self.error * x if self.name == "speed" else self.error + 0 * x


def unknowns_of(
    scene: Scene, free: Sequence[str] | Mapping[str, tuple[float, float]], errors: Mapping[str, float]
) -> list[Unknown]:
    """Return the unknowns that paths stand for. CaromError for paths that are no part of a ball's start, all at once."""
    ranges = dict(free) if isinstance(free, Mapping) else {}
    found: list[Unknown] = []
    faults = FaultList("aim")
    _check_errors(faults, errors)
    if isinstance(free, bytes) or not isinstance(free, Iterable):
        faults.add("free", EXPECTED, f"{free!r:.60}")
        free = ()
    freed: dict[tuple[Any, str], str] = {}  # which path frees a number of a ball
    for path in [free] if isinstance(free, str) else free:
        if (match := faults.attempt(path_match, scene, path, WHERE)) is None:
            continue
        (keys, *others) = match.places
        last = keys[-1]
        whole = len(keys) == (4 if keys[2:3] == ("strike",) and last != "strike" else 3)
        speed = keys[2:] == ("strike", "speed")
        parts = ("speed",) if speed else PARTS.get(str(last), ()) if keys[0] == "balls" and whole and not others else ()
        if last == "strike" and getattr(scene.balls[int(keys[1])], "strike", None) is None:
            parts = ()
        if not parts:
            faults.add("free", EXPECTED, f"{path!r:.60}")
        if not scene.floor and "velocity" in keys:
            faults.add(f"free: {path}", "a scene with a floor", "one without", "free the ball's strike there")
        for part in parts:
            if (keys[1], part) in freed:
                faults.add("free", "each number once", f"{part} by {freed[keys[1], part]} and {path}")
                break
            freed[keys[1], part] = path
            given = ranges.get(path, RANGES[part]) if part not in ("angle", "azimuth") or len(parts) == 1 else ANGLE
            own = path if last != "strike" else f"{path}.{part}"
            least, most = LIMITS.get(part, (-math.inf, math.inf))
            low, high = _range(given)
            if not (low < high and least <= low and high <= most and (part != "speed" or low > 0)):
                span = "" if part not in LIMITS else " > 0" if part == "speed" else f" from {least:g} to {most:g}"
                faults.add(f"free: {path}", f"a range (low, high) of {part}{span}", f"{given!r:.60}")
                continue
            found.append(Unknown(part, own, low, high, errors.get(part, ERRORS[part]) if not faults else 0.0))
    if not found and not faults:
        faults.add("free", "paths such as ['balls.0.velocity']", "none")
    faults.raise_if_any()
    return found


def _check_errors(faults: FaultList, errors: Any) -> None:
    """Add the faults of the player's errors."""
    known = shortened_list(list(ERRORS))
    if not isinstance(errors, Mapping):
        faults.add("errors", f"a mapping of {known} to numbers", f"{errors!r:.60}")
        return
    for name, value in errors.items():
        if name not in ERRORS:
            faults.add("errors", f"names of {known}", f"{name!r:.60}")
        elif isinstance(value, bool) or not 0 <= float_or_nan(value) <= MAX_MAGNITUDE:
            faults.add(f"errors: {name}", "a number >= 0", f"{value!r:.60}")


def _range(given: Any) -> tuple[float, float]:
    """Return low and high of a range; NaN where it is not one."""
    pair = tuple(given) if isinstance(given, Iterable) and not isinstance(given, str) else ()
    low, high = (
        (math.nan if isinstance(x, bool) else float_or_nan(x) for x in pair) if len(pair) == 2 else (math.nan,) * 2
    )
    return (low, high) if max(abs(low), abs(high)) <= MAX_MAGNITUDE else (math.nan, math.nan)


def _polar(unknowns: Sequence[Unknown]) -> list[tuple[int, int]]:
    """Return where speed and angle of velocities stand."""
    return [
        (k, k + 1)
        for k, one in enumerate(unknowns)
        if one.name == "speed" and k + 1 < len(unknowns) and unknowns[k + 1].name == "angle"
    ]


def columns_at(unknowns: Sequence[Unknown], x: Array) -> dict[str, Array]:
    """Return the columns (N,) or (N, k) of the paths, for unknowns (N, U)."""
    found: dict[str, Array] = {}
    for s, a in _polar(unknowns):
        found[unknowns[s].path] = polar_rows(x[:, s], x[:, a])
    for k, one in enumerate(unknowns):
        if one.path in found:
            continue
        if one.name == "side":
            found[one.path] = x[:, k : k + 2]
        else:
            found[one.path] = x[:, k]
    return found


def values_at(unknowns: Sequence[Unknown], x: Array) -> dict[str, Any]:
    """Return the scene's numbers by path, for one point (U,)."""
    return {
        path: tuple(column[0].tolist()) if column.ndim > 1 else float(column[0])
        for path, column in columns_at(unknowns, x[None, :]).items()
    }


def slopes_at(unknowns: Sequence[Unknown], x: Array, columns: Sequence[str]) -> Array:
    """Return the derivatives (p, U) of the parameters of a sensitivity, by their names, with respect to the unknowns."""
    place = {name: i for i, name in enumerate(columns)}
    found = np.zeros((len(columns), len(unknowns)))
    for s, a in _polar(unknowns):
        c, d = direction(float(x[a]))
        path = unknowns[s].path
        found[place[f"{path}.x"], [s, a]] = c, -x[s] * d * math.pi / 180
        found[place[f"{path}.y"], [s, a]] = d, x[s] * c * math.pi / 180
    for k, one in enumerate(unknowns):
        name = {"side": f"{one.path}.x", "top": f"{one.path}.y"}.get(one.name, one.path)
        if name in place:
            found[place[name], k] = 1.0
    return found


# ----------------------------------------------------------------------------------------------------
# A scene, the numbers of its start that may be chosen, and targets: by what starts miss them, many at once and one by one.


Signature = tuple[tuple[int, ...], ...]
MOVING = (FLIGHT, SLIDING, ROLLING, BOUNCING)
KINDS = ("wall", "ball", "pocketed")
FOLLOWED = 20  # of walls, balls and pockets, that a run is followed for in the coarse sweep
MOST_FOLLOWED = 8**3 * FOLLOWED  # where it is judged whether shots succeed
ROWS_AT_ONCE = 1 << 18  # of logs, some 300 bytes each


class CoarseSweep(NamedTuple):
    """Results of N starts."""

    x: Array
    """(N, U)."""
    miss: Array
    """(N,): by what they miss the target that they miss by most, as a share of what is allowed; inf without its event."""
    reached: NDArray[np.bool_]
    """(N,): whether they reach all targets."""
    rows: NDArray[np.int64]
    """(N, T): of the targets' events."""
    codes: NDArray[np.int32]
    """(N, FOLLOWED, 3): what happens; zeros after the last event."""
    moves: NDArray[np.bool_]
    """(N,): whether a ball that is to end at a place still moves when the run ends."""


class AimProblem:
    """A scene, its unknowns, and its targets."""

    def __init__(self, scene: Scene, unknowns: list[Unknown], targets: list[TargetEvent]) -> None:
        self.scene, self.unknowns, self.targets = scene, unknowns, targets
        self.low = np.array([one.low for one in unknowns])
        self.high = np.array([one.high for one in unknowns])
        self.paths = tuple(values_at(unknowns, self.low))
        self._linear: dict[Any, Any] = {}

    def sigma(self, x: Array) -> Array:
        """Return the player's errors (U,) at a start."""
        return np.array([one.sigma(value) for one, value in zip(self.unknowns, x, strict=True)])

    def scale(self, x: Array) -> Array:
        """Return (U,) what is a small step at a start: the player's errors, and where there is none the usual one."""
        usual = np.array(
            [one._replace(error=ERRORS[one.name]).sigma(v) for one, v in zip(self.unknowns, x, strict=True)]
        )
        return np.where(self.sigma(x) > 0, self.sigma(x), usual)

    def wrapped(self, x: Array) -> Array:
        """Return starts with angles that go round within their range."""
        circular = np.array([one.circular for one in self.unknowns])
        return np.where(circular, self.low + np.mod(x - self.low, 360.0), x)

    # --- many runs ---------------------------------------------------------------------------------------------------

    def outcomes(self, x: Array, events: int) -> tuple[Outcomes, NDArray[np.bool_]]:
        """Return the runs of starts (N, U), with the first ``events`` of walls, balls and pockets, and which of them can be run."""
        arrays = set_up(self.scene).for_runs(len(x))
        columns = {path_match(self.scene, path): column for path, column in columns_at(self.unknowns, x).items()}
        doubtful = start_states(self.scene, columns, arrays)
        many = run_starts(self.scene, arrays, events, KINDS)
        return Outcomes(many.events, np.asarray(many.final.position), many.code), ~doubtful & (many.why == "")

    def run_many(
        self, x: Array, events: int = FOLLOWED
    ) -> tuple[Array, NDArray[np.bool_], NDArray[np.int64], Outcomes]:
        """Return by what (N, T) starts (N, U) miss the targets, which (N,) reach all, their events' rows (N, T), and outcomes."""
        done, runs = self.outcomes(x, events)
        rows = np.stack([find(target, done.log) for target in self.targets], axis=1)
        missed = [residuals(target, done, row) for target, row in zip(self.targets, rows.T, strict=True)]
        size = np.stack([sizes(target, one) for target, one in zip(self.targets, missed, strict=True)], axis=1)
        reached = np.all([is_reached(target, one) for target, one in zip(self.targets, missed, strict=True)], axis=0)
        return np.where(runs[:, None], size, np.inf), reached & runs, rows, done

    def sweep(self, x: Array) -> CoarseSweep:
        """Return the results of starts (N, U)."""
        parts = []
        places = [target.ball for target in self.targets if target.kind == "point"]
        for part in np.array_split(x, math.ceil(len(x) * FOLLOWED / ROWS_AT_ONCE)):
            size, reached, rows, done = self.run_many(part)
            moves = np.asarray(np.isin(done.phase[:, places], MOVING).any(axis=1))
            parts.append(CoarseSweep(part, size.max(axis=1), reached, rows, codes_of(done.log), moves))
        return CoarseSweep(*(np.concatenate(columns) for columns in zip(*parts, strict=True)))

    def judge(self, x: Array) -> tuple[Array, NDArray[np.bool_]]:
        """Return by what (N, T) starts (N, U) miss the targets, and which (N,) reach all of them, however late."""
        size, reached = np.full((len(x), len(self.targets)), np.inf), np.zeros(len(x), bool)
        by_event = [target.kind != "point" for target in self.targets]
        events, open_ = FOLLOWED, np.arange(len(x))
        while len(open_) and events <= MOST_FOLLOWED:
            later = []
            for part in np.array_split(open_, math.ceil(len(open_) * events / ROWS_AT_ONCE)):
                size[part], reached[part], rows, done = self.run_many(x[part], events)
                goes_on = done.log["kind"][:, -1] != START
                later.append(part[goes_on & (rows[:, by_event] < 0).any(axis=1)])
            open_, events = np.concatenate(later), 8 * events
        return size, reached

    # --- one run -----------------------------------------------------------------------------------------------------

    def run_one(self, x: Array) -> tuple[Any, Signature, list[int]]:
        """Run a start; return the run, the sequence of its events up to the last target, and the rows of the targets."""
        run = simulate(replaced(self.scene, values_at(self.unknowns, x)))
        log = Outcomes.of_run(run, self.targets).log
        found = [int(find(target, log)[0]) for target in self.targets]
        return run, signature(codes_of(log)[0], self.targets, found), found

    def sensitivity(self, run: Any) -> Any:
        """Return a run's derivatives. What the loop reads is linear in velocities: those are found at the first start alone."""
        kept = run.scene.kept.setdefault("parameters", {})
        asked = self.paths, tuple(run.log["phase"][: len(run.scene.balls)].tolist())
        if asked in self._linear:
            kept[asked] = copy.copy(self._linear[asked])
            kept[asked].arrays = run.arrays
        found = run.sensitivity(self.paths)
        if all(path.endswith(".velocity") for path in self.paths):
            self._linear[asked] = kept[asked]
        return found

    def miss(self, run: Any, found: list[int], derivatives: Any, x: Array) -> tuple[Array, Array]:
        """Return a run's misses of the targets, as shares of what is allowed (R,), and its derivatives (R, U)."""
        parts = [slopes(target, run, row, derivatives) for target, row in zip(self.targets, found, strict=True)]
        return np.concatenate(self.missed(run, found)), np.concatenate(parts) @ slopes_at(
            self.unknowns, x, derivatives.columns
        )

    def missed(self, run: Any, found: list[int]) -> list[Array]:
        """Return a run's miss of each target, (R,) as shares of what is allowed."""
        done = Outcomes.of_run(run, self.targets)
        return [residuals(target, done, np.array([row]))[0] for target, row in zip(self.targets, found, strict=True)]

    def reaches(self, run: Any, found: list[int]) -> bool:
        """Return whether a run reaches all targets."""
        pairs = zip(self.targets, self.missed(run, found), strict=True)
        return all(is_reached(target, missed[None, :])[0] for target, missed in pairs)


def codes_of(log: NDArray[np.void]) -> NDArray[np.int32]:
    """Return the events in logs (N, M): kind, ball, and which wall, ball or pocket it meets, (N, M, 3)."""
    return np.stack([log["kind"], log["ball"], log["other"]], axis=-1).astype(np.int32)


def signature(codes: NDArray[np.int32], targets: Sequence[TargetEvent], found: Sequence[int]) -> Signature:
    """Return the events (M, 3) that the targets depend on: all of them for a place, the ones up to the target's event else."""
    to_the_end = any(target.kind == "point" for target in targets)
    count = int((codes[:, 0] != START).sum()) if to_the_end else max(found, default=-1) + 1
    return tuple((kind, ball, other) for kind, ball, other in codes[:count].tolist())


# ----------------------------------------------------------------------------------------------------
# Starts that reach a target: a coarse sweep for sequences of events that do, least squares with exact gradients within each.


SEQUENCES, STARTS_EACH = 10, 2  # that are refined: sequences of events, and starts of each
MOST_STARTS = 1 << 20
DRAWS = 200  # of the player's errors, for the share of shots that succeed
STEPS, ENOUGH = 8, 1e-3  # of least squares, at most; and a share of what is allowed that need not be improved on
LINEAR = 3.0  # times what shots miss by, that gradients say at most
NOT_LINEAR = "–: the miss is not linear within the player's errors; success, of shots that were run, holds."
APART = 4.0  # solutions nearer than this, in the player's errors, are one
LOST = 10.0  # miss, in what is allowed, of a start with another sequence of events


@dataclass(frozen=True, eq=False)
class Aim:
    """One solution: made by :func:`carom.aim`."""

    values: dict[str, float]
    """The unknowns: speed in m/s, angles in degrees, offsets in radii."""
    chance: float
    """Share of shots that reach the target under the player's errors, of 200 that were drawn and run."""
    spread: Array
    """(R,), m: standard deviation of the miss under the player's errors, by gradients: of an impact parameter, or along x, y;
    m/s of the speed where that is asked for."""
    covariance: Array
    """(R, R) of the miss."""
    sequence: tuple[str, ...]
    """Objects that the targets' balls meet, in this order."""
    time: float
    """When the last target is reached, s."""
    scene: Scene
    """The scene with this start."""
    changes: dict[str, Any]
    """The numbers of the start by path, as :func:`carom.replaced` takes them."""
    linear: bool = True
    """Whether spread and covariance hold: gradients say of the shots that were run by about how much they miss."""

    @property
    def run(self) -> Trajectory:
        """The run of this start."""
        return simulate(self.scene)

    def __repr__(self) -> str:
        """Return one line."""
        numbers = ", ".join(f"{name} {format_number(x, 5)}" for name, x in self.values.items())
        return f"<Aim: {numbers}: {self.chance:.0%} under the player's errors>"


class Aims(Sequence[Aim]):
    """Solutions, the most robust one first."""

    def __init__(self, solutions: list[Aim], unknowns: list[Unknown], targets: list[TargetEvent]) -> None:
        self._solutions, self._unknowns = solutions, unknowns
        self.targets = targets

    def __len__(self) -> int:
        """Return how many there are."""
        return len(self._solutions)

    def __getitem__(self, k: Any) -> Any:
        """Return one, or several."""
        return self._solutions[k]

    def table(self) -> Listing:
        """Return the solutions with the player's errors."""
        head = [
            *(f"{name} {one.unit}" for name, one in zip(self._names(), self._unknowns, strict=True)),
            "success",
            "spread mm",
        ]
        body = []
        for one in self._solutions:
            units = [unit for target in self.targets for unit in target.units]
            told = [
                format_number(1e3 * s) if unit == "m" else f"{format_number(s)} m/s"
                for s, unit in zip(one.spread, units, strict=True)
            ]
            spread = " x ".join(told) if one.linear else "–"
            numbers = [format_number(x, 5) for x in one.values.values()]
            body.append([*numbers, f"{one.chance:.0%}", spread, ", ".join(one.sequence)])
        return Listing([*head, "sequence"], body, self.note)

    @property
    def note(self) -> str:
        """Notes below the table: the player's errors, and the meaning of a dash."""
        each = [
            f"{one.name} {100 * one.error:g} %" if one.name == "speed" else f"{one.name} {one.error:g} {one.unit}"
            for one in self._unknowns
        ]
        said = f"The player's errors, one standard deviation: {', '.join(dict.fromkeys(each))}.".replace(" °", "°")
        return said if all(one.linear for one in self) else f"{said} {NOT_LINEAR}"

    def _names(self) -> list[str]:
        return list(self._solutions[0].values) if self._solutions else []

    def __repr__(self) -> str:
        """Return a table as text."""
        return repr(self.table())

    def _repr_html_(self) -> str:
        return self.table()._repr_html_()


def aim(
    scene: Scene,
    free: Sequence[str] | Mapping[str, tuple[float, float]],
    reach: Any,
    *,
    errors: Mapping[str, float] | None = None,
    solutions: int = 5,
    starts: int = 1 << 14,
    seed: int = 0,
    progress: Progress | None = None,
) -> Aims:
    """Find starts of a ball that reach a target, the most robust one first.

    Parameters
    ----------
    scene : Scene
    free : paths, or a mapping of them to ranges (low, high)
        What may be chosen: a ball's ``velocity`` on the floor (speed 0.5 to 6 m/s, or the range given, and all directions),
        ``strike`` (speed and azimuth), ``strike.offset`` (side and top, up to half a radius), ``strike.elevation``, ``spin_z``.
    reach : mapping, or several
        ``{"ball": 2, "point": (1.2, 0.4)}``: where it comes to rest, within its radius, or ``"within"`` m;
        ``{"ball": 1, "pocket": "any"}``: it falls into a pocket, of that name or any;
        ``{"ball": 0, "hit": ("yellow", "red"), "cushions": 3}``: it touches both, and at least three cushions before the last one.
        ``"speed": 0.8``: and comes there with this speed (m/s), within a tenth, or ``"speed_within"`` m/s.
        Several must all be met: pot a ball and leave the cue ball at a place.
    errors : mapping, optional
        Standard deviations of the player's: speed (a share: 0.03), angle and azimuth (0.2 degrees), elevation (0.5 degrees),
        side and top (0.02 radii), spin_z (2 rad/s).
    solutions : int
        How many are found, at most.
    starts : int
        Starts of the coarse sweep.
    seed : int
        Seed of the player's errors.
    progress : callable(done, total, text), optional
        Called with the current step in words; how much of it is done is not known (NaN).

    Returns
    -------
    Aims
        Distinct solutions, each centred within its sequence of events; ordered by the share of shots that succeed.

    Raises CaromError: unknown paths, balls and pockets, numbers out of range; no start that reaches the target.

    Examples
    --------
    >>> import carom
    >>> wall = carom.scene.Plane(point=(0, 0, 0), normal=(1, 0, 0), restitution=0.85, friction=0.2)
    >>> balls = [carom.SceneBall(radius=0.03, mass=0.2, position=(0.5, y), velocity=(0, 0), rolling=True) for y in (0, 0.6)]
    >>> scene = carom.Scene(floor=carom.Floor(friction=0.2, rolling_resistance=0.01), walls=[wall], balls=balls)
    >>> best = carom.aim(scene, ["balls.0.velocity"], {"hit": 1, "cushions": 1}, starts=512)
    >>> best[0].sequence
    ('plane 0', 'ball 1')
    """
    require_type("aim", "scene", scene, Scene)
    faults = FaultList("aim")
    unknowns: list[Unknown] = faults.attempt(unknowns_of, scene, free, {} if errors is None else errors)
    targets: list[TargetEvent] = faults.attempt(targets_of, scene, reach)
    faults.attempt(require_count, "aim", "solutions", solutions)
    faults.attempt(require_count, "aim", "starts", starts, 1, MOST_STARTS)
    faults.attempt(require_count, "aim", "seed", seed, 0)
    faults.raise_if_any()
    problem = AimProblem(scene, unknowns, targets)
    say = loop_callback(progress, lambda tell: lambda text: tell(math.nan, math.nan, text)) or (lambda _text: None)
    say(f"{starts:,} starts")
    refined: list[tuple[Array, Array, Any]] = []
    sweep = _coarse(problem, starts)
    for x0, sequence in _candidates(problem, sweep):
        say(f"refining, {len(refined)} so far")
        found = _refined(problem, x0, sequence)
        if found is not None:
            refined.append(found)
    draws = np.random.default_rng(seed).normal(size=(DRAWS, len(unknowns)))
    say("the player's errors")
    if not (made := _judged(problem, refined, draws)):
        advice = "free more numbers, widen their ranges, or try more starts"
        if moving := int(sweep.moves.sum()):
            advice += f"; in {moving:,} of them the ball still moves when the run ends: a longer run.duration"
        if reached := int(sweep.reached.sum()):
            advice = f"{reached:,} do, each by events of its own, as in a break: aim without a rack"
        raise CaromError(f"aim: reach: expected a target that some of {starts:,} starts come near, got none; {advice}")
    return Aims(made[:solutions], unknowns, targets)


def _coarse(problem: AimProblem, starts: int) -> CoarseSweep:
    """Run starts that are spread over the ranges."""
    qmc = import_optional("scipy.stats.qmc", "aim")
    power = math.ceil(math.log2(starts))
    points = qmc.Sobol(len(problem.unknowns), scramble=False).random_base2(power)[:starts]
    return problem.sweep(problem.low + points * (problem.high - problem.low))


def _candidates(problem: AimProblem, sweep: CoarseSweep) -> Iterator[tuple[Array, Signature]]:
    """Yield starts to be refined, with their sequences: of those that come nearest to the targets, some of each sequence."""
    x, worst, reached = sweep.x, sweep.miss, sweep.reached
    groups: dict[Signature, list[int]] = {}
    for n in np.argsort(worst, kind="stable").tolist():
        if not math.isfinite(worst[n]):
            break
        groups.setdefault(signature(sweep.codes[n], problem.targets, sweep.rows[n].tolist()), []).append(n)
    # (a sequence that many starts have is one that is easily kept; a place is mostly come near by a few)
    reaches = {sequence: int(reached[group].sum()) for sequence, group in groups.items()}
    order = sorted(groups, key=lambda one: (-reaches[one], worst[groups[one][0]]))
    for sequence in order[:SEQUENCES]:
        chosen: list[int] = []
        for n in groups[sequence]:
            if all((np.abs(x[n] - x[k]) > APART * problem.scale(x[n])).any() for k in chosen):
                chosen.append(n)
                yield x[n], sequence
            if len(chosen) == STARTS_EACH:
                break


def _refined(problem: AimProblem, x0: Array, sequence: Signature) -> tuple[Array, Array, Any] | None:
    """Bring a start to the middle of its target, within its sequence; return it, its miss's derivatives (R, U), and its run."""
    optimize = import_optional("scipy.optimize", "aim")
    known: dict[bytes, tuple[Array, Array, Any]] = {}

    def at(x: Array) -> tuple[Array, Array, Any]:
        key = x.tobytes()
        if key not in known:
            size = sum(len(target.windows) for target in problem.targets)
            lost = np.full(size, LOST), np.zeros((size, len(x))), None
            known[key] = lost
            try:
                run, its, found = problem.run_one(x)
                if its == sequence:
                    miss, derivatives = problem.miss(run, found, problem.sensitivity(run), x)
                    if np.isfinite(miss).all() and np.isfinite(derivatives).all():
                        known[key] = miss, derivatives, (run, found)
            except (
                CaromError
            ):  # (a start that the scene refuses, an event without an answer, a graze without a derivative)
                pass
        return known[key]

    if at(x0)[2] is None:
        return None
    circular = np.array([one.circular for one in problem.unknowns])
    bounds = np.where(circular, -np.inf, problem.low), np.where(circular, np.inf, problem.high)
    try:
        found = optimize.least_squares(
            lambda x: at(x)[0],
            x0,
            jac=lambda x: at(x)[1],
            bounds=bounds,
            x_scale=problem.scale(x0),
            max_nfev=STEPS,
            ftol=ENOUGH,
            xtol=ENOUGH,
            gtol=ENOUGH**2,
        )
    except ValueError:  # (a start on the border of its range)
        return None
    _miss, rates, followed = at(found.x)
    return (found.x, rates, followed[0]) if followed is not None and problem.reaches(*followed) else None


def _judged(problem: AimProblem, refined: list[tuple[Array, Array, Any]], draws: Array) -> list[Aim]:
    """Return distinct solutions with the share of shots that succeed, in its order."""
    found: list[tuple[float, Array, Aim]] = []
    if not refined:
        return []
    tried = [x + draws * problem.sigma(x) for x, _slopes, _run in refined]
    # (speeds stay positive, and miscues are left to the scene)
    low = np.array([1e-3 if one.name == "speed" else -np.inf for one in problem.unknowns])
    miss, reached = problem.judge(np.maximum(np.concatenate(tried), low))
    success = reached.reshape(len(refined), len(draws)).mean(axis=1)
    windows = np.concatenate([target.windows for target in problem.targets])
    each = miss.max(axis=1).reshape(len(refined), len(draws))
    for (x, rates, run), chance, missed in zip(refined, success, each, strict=True):
        scaled = rates * problem.sigma(x) * windows[:, None]
        covariance = scaled @ scaled.T
        one = Aim(
            dict(zip(_names(problem.unknowns), problem.wrapped(x).tolist(), strict=True)),
            float(chance), np.sqrt(np.diag(covariance)), covariance, *_sequence(problem, run), run.scene,
            values_at(problem.unknowns, x),
            is_linear(draws * problem.sigma(x) @ rates.T, missed),
        )  # fmt: skip
        found.append((float(chance), x, one))
    found.sort(key=lambda item: (-item[0], float(item[2].spread.max())))
    kept: list[tuple[Array, Aim]] = []
    for _chance, x, one in found:
        near = [(np.abs(_turn(problem, x - other)) <= APART * problem.scale(x)).all() for other, _aim in kept]
        if not any(near):
            kept.append((x, one))
    return [one for _x, one in kept]


def is_linear(predicted: Array, missed: Array) -> bool:
    """Return whether gradients say by how much shots miss: ``predicted`` (N, R) as shares of what is allowed, ``missed`` (N,).

    Of shots that do not reach the target's event it is not known by how much (inf), and where none does the gradients say nothing.
    """
    known = np.isfinite(missed)
    if not known.any():
        return False
    said = np.median(np.abs(predicted[known]).max(axis=1))
    return bool(said <= LINEAR * max(1.0, float(np.median(missed[known]))))


def _turn(problem: AimProblem, x: Array) -> Array:
    """Return differences of starts, of angles that go round the shorter one."""
    circular = np.array([one.circular for one in problem.unknowns])
    return np.where(circular, (x + 180.0) % 360.0 - 180.0, x)


def _names(unknowns: Sequence[Unknown]) -> list[str]:
    """Return names of the unknowns, with the ball's path where two have the same."""
    names = [one.name for one in unknowns]
    return [name if names.count(name) == 1 else f"{one.path}.{name}" for name, one in zip(names, unknowns, strict=True)]


def _sequence(problem: AimProblem, run: Any) -> tuple[tuple[str, ...], float]:
    """Return the objects that the balls of the targets meet, up to the last target, and its time."""
    scene = problem.scene
    rows = run.log[np.isin(run.log["kind"], EVENTS)]
    found = [int(find(target, rows[None, :])[0]) for target in problem.targets]
    to_the_end = any(target.kind == "point" for target in problem.targets)
    last = len(rows) if to_the_end else max(found) + 1
    balls = {target.ball for target in problem.targets}
    met = [
        (f"{scene.ball_names[int(row['ball'])]}: " if len(balls) > 1 else "")
        + (partner_names(scene, int(row["met"])) or ())[int(row["other"])]
        for row in rows[:last]
        if int(row["ball"]) in balls
    ]
    counted = ((name, len(list(same))) for name, same in itertools.groupby(met))
    told = tuple(name if count == 1 else f"{count} x {name}" for name, count in counted)
    return told, float(run.end if to_the_end else rows["t"][last - 1])


# ----------------------------------------------------------------------------------------------------
# Acceptance windows of a shot: the directions, at each speed, from which a target is reached.


FOLLOWED_IN_WINDOWS, HALVINGS = 40, 16  # events of a shot; of a step, until an edge is found
MOST_RUNS, SHOWN = 1 << 24, 12  # shots; windows that the table has


class Window(NamedTuple):
    """Directions between which every shot of the grid reaches the target."""

    outcome: str
    """The pocket, or the balls that are hit."""
    shot: str
    """Which way: "direct", "1-cushion kick" (before the first ball), "2-cushion bank" (after it), "carom", "combination"."""
    speed: float
    """m/s."""
    low_deg: float
    """degrees."""
    high_deg: float
    """degrees; above 360 where the window goes round."""

    @property
    def width_deg(self) -> float:
        """In degrees."""
        return self.high_deg - self.low_deg


@dataclass(frozen=True, eq=False)
class Windows(Sequence[Window]):
    """Acceptance windows, the widest first: made by :func:`carom.aim_windows`."""

    windows: tuple[Window, ...]
    speeds: tuple[float, ...]
    """m/s: of the grid."""
    range_deg: tuple[float, float]
    """degrees: of the grid."""
    step_deg: float
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
            [one.outcome, one.shot, *(format_number(x, 5) for x in one[2:]), format_number(one.width_deg)]
            for one in self.windows[:SHOWN]
        ]
        some = f", the widest {len(rows)} shown" if len(rows) < len(self) else ""
        said = f"{counted(len(self), 'window')} in {self.runs:,} shots{some}; a window below {self.step_deg:g}° may be missed."
        return Listing(["target", "shot", "speed m/s", "from °", "to °", "width °"], rows, said)

    def as_dict(self) -> dict[str, Any]:
        """Return all of it as plain numbers and texts."""
        each = [{**one._asdict(), "width_deg": one.width_deg} for one in self.windows]
        grid = {"speeds": list(self.speeds), "range_deg": list(self.range_deg), "step_deg": self.step_deg}
        return {**grid, "runs": self.runs, "windows": each}

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
    directions: int = 7200,
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
        The target, as :func:`carom.aim` takes it. Each pocket, and each kind of shot (direct, kick, bank), has windows of its own.
    speeds, directions : int
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
    >>> found = carom.aim_windows(scene, {"balls.0.velocity": (1.0, 2.0)}, {"hit": 1}, speeds=2, directions=360)
    >>> found[0].outcome, found[0].shot, round(found[0].width_deg, 3)  # 2 asin(2 a/d) = 11.478
    ('ball 1', 'direct', 11.478)
    """
    require_type("aim_windows", "scene", scene, Scene)
    faults = FaultList("aim_windows")
    unknowns = faults.attempt(unknowns_of, scene, free, {})
    targets = faults.attempt(targets_of, scene, reach)
    for name, value, least in (("speeds", speeds, 1), ("directions", directions, 3)):
        faults.attempt(require_count, "aim_windows", name, value, least, MOST_RUNS)
    if not faults and speeds * directions > MOST_RUNS:
        faults.add("speeds", f"at most {MOST_RUNS:,} shots in all", f"{speeds:,} x {directions:,}")
    if unknowns and [one.name == "speed" or one.circular for one in unknowns] != [True, True]:
        faults.add("free", "one ball's velocity or strike: a speed and a direction", f"{free!r:.60}")
    faults.raise_if_any()
    problem = AimProblem(scene, unknowns, targets)
    step, low_deg = 360.0 / directions, float(problem.low[1])
    grid = np.linspace(problem.low[0], problem.high[0], speeds)
    around: Array = low_deg + step * np.arange(directions, dtype=float)
    runs = _Labels(problem, speeds * directions, progress)
    points = np.stack(np.broadcast_arrays(grid[:, None], around), axis=-1)
    label = runs.of(points.reshape(-1, 2)).reshape(speeds, directions)
    row, first = np.nonzero(label != np.roll(label, -1, axis=1))
    ends = runs.ends(grid[row], around[first], step, label[row, first])
    begins = runs.ends(grid[row], around[first] + step, -step, label[row, (first + 1) % directions])
    found = [
        Window(*runs.name(code), float(grid[i]), low, high)
        for i in range(speeds)
        for code, low, high in _spans(
            label[i], first[row == i], begins[row == i], ends[row == i], float(problem.low[1])
        )
    ]
    found.sort(key=lambda one: (-one.width_deg, one.outcome, one.shot, one.speed))
    return Windows(tuple(found), tuple(grid.tolist()), (low_deg, low_deg + 360.0), step, runs.done)


def _spans(label: NDArray[np.int64], first: NDArray[np.int64], begins: Array, ends: Array, low: float) -> Iterator[Any]:
    """Yield code, low and high of each window at one speed; ``first``: the direction before each begin, and end."""
    if len(first) == 0:
        if label[0] >= 0:
            yield int(label[0]), low, low + 360.0
        return
    for begin, end, k in zip(begins, np.roll(ends, -1), first, strict=True):
        code = int(label[(k + 1) % len(label)])
        if code >= 0:
            start = begin - 360.0 * math.floor((begin - low) / 360.0)
            yield code, float(start), float(start + (end - begin) % 360.0)


class _Labels:
    """Which target shots reach, and by which kind of shot: a number by shot, -1 for none."""

    def __init__(self, problem: AimProblem, total: int, progress: Progress | None) -> None:
        self.problem, self.total, self.progress, self.done = problem, total, progress, 0
        with_event = [target for target in problem.targets if target.kind != "point"]
        self.target = min(with_event, key=lambda one: one.kind != "pocket", default=None)
        self.shot = int(path_match(problem.scene, problem.unknowns[0].path).places[0][1])

    def of(self, x: NDArray[np.float64]) -> NDArray[np.int64]:
        """Return the numbers (N,) of starts (N, 2)."""
        found = np.full(len(x), -1)
        for part in np.array_split(np.arange(len(x)), math.ceil(len(x) * FOLLOWED_IN_WINDOWS / ROWS_AT_ONCE)):
            _size, reached, rows, done = self.problem.run_many(x[part], FOLLOWED_IN_WINDOWS)
            code = np.zeros(len(part), np.int64)
            if self.target is not None:
                its = rows[:, self.problem.targets.index(self.target)]
                code = shot_codes(self.target, self.shot, done.log, its)
            found[part] = np.where(reached, code, -1)
            self.done += len(part)
            if self.progress is not None:
                self.progress(min(self.done, self.total), self.total, "shots")
        return found

    def name(self, code: int) -> tuple[str, str]:
        """Return the target that is reached, and the kind of shot, of a number."""
        return ("the place", "") if self.target is None else shot_of(self.target, self.problem.scene, code)

    def ends(self, speed: Array, angle: Array, step: float, label: NDArray[np.int64]) -> Array:
        """Return where a label that shots have at ``angle`` (N,) ends before ``angle + step``, by bisection; NaN of none (-1)."""
        some, found, width = label >= 0, np.full(len(angle), np.nan), step
        at = angle[some]
        for _ in range(HALVINGS if some.any() else 0):
            width /= 2
            same = self.of(np.stack([speed[some], at + width], axis=1)) == label[some]
            at = np.where(same, at + width, at)
        found[some] = at + width / 2
        return found
