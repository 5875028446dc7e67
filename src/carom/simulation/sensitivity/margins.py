"""How far each event of a run is from the nearest change of regime, to first order, as a change of the parameters.

A graze: the speed of approach goes to zero as the square root of what is left, so that its square is what varies linearly.
Where a wall presses a ball on the floor, slip may stop and begin again at both contacts while they act, and no number of the result
shows how near the next sequence is: the impact is computed again for states along each parameter, up to the first with another.
"""

from __future__ import annotations

import functools
import math
from collections.abc import Callable, Iterator, Sequence
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from carom.core.geometry.features import (
    BEHIND,
    FALLS,
    FEATURES,
    OVER,
    SEAM,
    feature_gap,
    gap_to_feature,
    impact_normal,
    pair_gap,
)
from carom.core.jit.compile import array_of, is_cached, njit, signature
from carom.core.jit.kernel import Vec, as_objects, kernel
from carom.core.jit.threads import block_slices
from carom.core.motion.phases import BOUNCING, HELD, REST, SLIDING, restitution
from carom.errors import CaromError
from carom.laws.law import TWO_STEP_WALL
from carom.simulation.contact_kinds import compiled_joint_impact, joint_impact
from carom.simulation.records import BALL, MEETINGS, WALL, WALLS, event_numbers
from carom.simulation.sensitivity.follow import Parameters, lifted, seeded_records
from carom.simulation.sensitivity.passages import PLACES, Dual, Passage, Passages, derivative, met_feature, value

Array = NDArray[np.float64]
SPAN = 0.5  # of the numbers of an impact: so far the next sequence of a joint impact is looked for
HALVINGS = 30  # from there on down
BISECTIONS = 40
EXACT = 1e-12  # share of the friction, or of the time, that counts as none


class Margin(NamedTuple):
    """How far an event is from the nearest change of regime, to first order."""

    which: str
    """ "graze", "stick/slip", "order", "roll/slide"; empty where nothing can switch."""
    distance: float
    """In the switch's own measure: m/s of approach, slip or velocity; friction; s."""
    radius: float
    """Length of the shortest change of the parameters (in their units) that reaches it; infinite if none does."""


def margins(run: Any, parameters: Parameters, passages: Passages) -> list[Margin]:
    """Return the nearest switch of each event: graze, stick or slip, roll or slide, or the order of two events of one ball."""
    log, p, first = run.log, len(parameters), len(run.scene.balls)
    joint = _JointImpacts(parameters)
    found = []
    for k in range(first, len(log)):
        one, row, choices = passages[k], log[k], []
        if one.approach is not None:
            graze = _linear("graze", one.approach, p)
            choices.append(graze._replace(radius=graze.radius / 2))
        if joint.has(row):
            choices.append(joint.margin(row, one))
        elif one.required is not None and one.friction is not None and 0 < one.friction < np.inf and one.required != 0:
            choices.append(_linear("stick/slip", one.required - one.friction, p))
        if one.slip is not None:
            choices.append(_vanishing(one.slip, p))
        if row["phase_before"] == SLIDING and row["kind"] in (WALL, *MEETINGS):
            # (the slip goes to zero along its direction: had it vanished just before, the ball would have rolled)
            choices.append(_linear("roll/slide", _slip_before(run, row, one), p))
        j = _next_of_its_balls(log, k)
        if j is not None:
            choices.append(_linear("order", passages[j].time - one.time, p))
        found.append(min(choices, key=lambda m: m.radius, default=Margin("", np.inf, np.inf)))
    return found


def _linear(which: str, distance: Any, p: int) -> Margin:
    size, slope = abs(float(value(distance))), float(np.linalg.norm(derivative(distance, p)))
    return Margin(which, size, size / slope if slope > 0 else np.inf)


def _vanishing(slip: list[Any], p: int) -> Margin:
    """Return how far a slip of two components is from zero: both vanish together."""
    now, slope = np.array([value(x) for x in slip]), np.stack([derivative(x, p) for x in slip])
    change = np.linalg.lstsq(slope, -now, rcond=1e-12)[0]
    size = float(np.hypot(*now))
    reached = float(np.hypot(*(now + slope @ change))) <= 1e-9 * size
    return Margin("roll/slide", size, float(np.linalg.norm(change)) if reached else np.inf)


def _slip_before(run: Any, row: Any, one: Passage) -> Any:
    a = run.scene.balls[row["ball"]].radius
    x, y = one.before.v[0] - a * one.before.w[1], one.before.v[1] + a * one.before.w[0]
    size = math.hypot(value(x), value(y))
    return (x * (value(x) / size) + y * (value(y) / size)) if size > 0 else 0.0


def _next_of_its_balls(log: Any, k: int) -> int | None:
    """Return the row of the next event of the balls that row k is about; events of other balls may change places with it."""
    its = [int(log["ball"][k]), *([int(log["other"][k])] if log["kind"][k] in MEETINGS else [])]
    later = (log["t"] > log["t"][k]) & np.isin(log["ball"], its)
    at_once = impacts_at_once(log, k, its) & (np.arange(len(log)) > k)
    rows = np.flatnonzero(later | at_once)
    return int(rows[0]) if len(rows) else None


def impacts_at_once(log: Any, k: int, balls: Sequence[int]) -> NDArray[np.bool_]:
    """Mark the rows in which one of these balls, of row k, meets something else at the time of row k."""
    t, kind, other = log["t"], log["kind"], log["other"]
    found = np.isin(kind, (*WALLS, *MEETINGS)) & (np.abs(t - t[k]) <= EXACT * t[k]) & np.isin(log["ball"], balls)
    found &= (other != other[k]) | (kind != kind[k])
    number = event_numbers(log)
    return np.asarray(
        found & (number != number[k]) & ~((kind == BALL) & np.isin(other, balls))
    )  # (the same two once more)


# --- impacts at wall and floor at once -------------------------------------------------------------------------------


class _JointImpacts:
    """The impacts of a run at which a wall may press a ball on the floor."""

    def __init__(self, parameters: Parameters) -> None:
        arrays = parameters.arrays
        self.p = len(parameters)
        self.world, self.features, self.balls = (
            seeded_records(getattr(arrays, name), [one[name] for one in parameters.slopes])
            for name in ("world", "features", "balls")
        )
        self.walls = as_objects(arrays.features)
        # (the same bits: compiled where it has been)
        self.impact: Callable[..., Any] = compiled_joint_impact() if is_cached(joint_impact) else joint_impact

    def _feature(self, row: Any) -> int:
        return int(met_feature(self.walls, as_objects(row.reshape(1))[0], value(self.balls[row["ball"]].radius)))

    def has(self, row: Any) -> bool:
        """Return whether a row of the log is such an impact."""
        on_floor = row["kind"] == WALL and np.any(row["floor_impulse"])
        return bool(on_floor and self.walls[self._feature(row)].law == TWO_STEP_WALL)

    def margin(self, row: Any, one: Passage) -> Margin:
        """Return how far the next sequence of sticking and slipping is, of wall and floor."""
        numbers = self._numbers(row, one)
        now, slopes = np.array([value(x) for x in numbers]), np.stack([derivative(x, self.p) for x in numbers])
        inverse = np.zeros(self.p)
        for c in range(self.p):
            ways = [_first_change(self._sequence, now, sign * slopes[:, c]) for sign in (1.0, -1.0)]
            nearest = int(np.argmin(ways))
            inverse[c] = (1 - 2 * nearest) / ways[nearest]
        # a border that is met at d_c along each parameter is 1 / |(1 / d_c)| away
        size = float(np.linalg.norm(inverse))
        if size == 0:
            return Margin("stick/slip", np.inf, np.inf)
        return Margin("stick/slip", float(np.linalg.norm(slopes[:3] @ inverse)) / size**2, 1 / size)

    def _numbers(self, row: Any, one: Passage) -> list[Any]:
        """Return the arguments of the impact, with derivatives: v, w, n, a, kappa, e, mu, beta, the floor's e, mu, beta."""
        ball, f, world = self.balls[row["ball"]], self.features[self._feature(row)], self.world[0]
        n = lifted(impact_normal)(f, ball.radius, one.ball.x, one.before.v)
        e = lifted(restitution)(f.form, f.e, one.approach)
        ef = lifted(restitution)(world.floor_form, world.floor_p, 0.0)
        return [
            *one.before.v, *one.before.w, *n, ball.radius, ball.kappa, e, f.mu, f.beta, ef, world.floor_mu, world.floor_beta,
        ]  # fmt: skip

    def _sequence(self, x: Array) -> tuple[int, int]:
        """Return the course of an impact: the regime at the wall, and all modes of both contacts, one after the other."""
        y = x.tolist()
        v, w, n, rest = tuple(y[:3]), tuple(y[3:6]), tuple(y[6:9]), y[9:]
        *_after, regime, way = self.impact(v, w, n, *rest, True)
        return int(regime), int(way)


def _first_change(sequence: Callable[[Array], Any], now: Array, slope: Array) -> float:
    """Return the first step along a direction after which a sequence is another one, or infinity."""
    v, w, rest = slice(0, 3), slice(3, 6), slice(9, None)
    finite = np.where(np.isfinite(now), now, 0.0)
    sizes = [(float(np.linalg.norm(finite[part])), float(np.linalg.norm(slope[part]))) for part in (v, w)]
    sizes += [(abs(x), abs(d)) for x, d in zip(finite[rest], slope[rest], strict=True)]
    most = min((SPAN * size / rate for size, rate in sizes if rate > 0 and size > 0), default=0.0)
    if most == 0:
        return math.inf
    here, low = sequence(now), 0.0
    for k in range(HALVINGS, -1, -1):
        high = most * 2.0**-k
        if sequence(now + high * slope) != here:
            for _ in range(BISECTIONS):
                middle = (low + high) / 2
                low, high = (middle, high) if sequence(now + middle * slope) == here else (low, middle)
            return high
        low = high
    return math.inf


# ----------------------------------------------------------------------------------------------------
# Near misses of a run: how closely balls pass by each other, by walls and pockets, and how far a contact is in the parameters.
#
# Between two events of a run every ball moves on x + v s + a s^2/2. On each such stretch the least gap of every pair is found
# by sampling it and then by a golden-section search. Where the gap is least inside a stretch, its rate is zero, so that
# its derivative is the one at a fixed time (envelope theorem); where an event turns the ball round, it is the one at the event's
# time, which changes with the parameters.


SAMPLES = 24  # of the gap on a stretch, between which the search begins
STEPS = 48  # of the search: the bracket shrinks to 1e-10 of itself
LONGEST_STRETCH = 0.1  # s, where the acceleration of a ball changes
GOLDEN = (math.sqrt(5) - 1) / 2
BLOCK = 1 << 8  # stretches at once
MINIMA = 4  # of one gap on one stretch, at most
LEAST_GAPS = np.dtype(
    [
        ("gap", "f8", (MINIMA,)),  # inside the stretch, m; infinite for none
        ("at", "f8", (MINIMA,)),  # s since its begin
        ("nearest", "i8", (MINIMA,)),  # feature
        ("begin_gap", "f8"),
        ("opens", "i8"),  # whether it is no smaller just after the begin
        ("end_gap", "f8"),  # where it closes up to the end
        ("end_nearest", "i8"),
    ]
)


class NearMiss(NamedTuple):
    """A ball passes by something without touching it, or comes to rest near it."""

    time: float
    """s: when it is nearest."""
    ball: str
    other: str
    """Ball, wall or pocket, by name."""
    distance: float
    """m: gap between the surfaces; for a pocket, from its edge to the ball's centre."""
    radius: float
    """Length of the shortest change of the parameters (in their units) that makes them touch, to first order."""
    at_rest: bool
    """Whether both are at rest then: the ball did not pass, it stopped on its way."""


# --- the least gaps ---------------------------------------------------------------------------------------------------


@kernel
def _position_at(path: Any, s: float) -> Vec:
    h = s * s / 2
    return (
        path[0, 0] + path[1, 0] * s + path[2, 0] * h,
        path[0, 1] + path[1, 1] * s + path[2, 1] * h,
        path[0, 2] + path[1, 2] * s + path[2, 2] * h,
    )


@kernel
def _gap_to_target(
    features: Any, radius: Any, paths: Any, walls: int, i: int, target: int, s: float
) -> tuple[float, int]:
    """Return the gap between ball i and a ball, a wall or a pocket (numbered in this order), and the feature that is nearest."""
    x, balls = _position_at(paths[i], s), radius.shape[0]
    if target < balls:
        return pair_gap(x, _position_at(paths[target], s), radius[i] + radius[target]), -1
    best, nearest = math.inf, -1
    for k in range(features.shape[0]):
        f = features[k]
        gap = math.inf
        if target < balls + walls:
            if f.wall == target - balls and f.kind != OVER:
                gap = gap_to_feature(f, radius[i], x)
                if gap < -BEHIND * radius[i]:
                    gap = math.inf
        elif f.kind == OVER and f.ends == FALLS and f.at == target - balls - walls:
            gap = feature_gap(f, radius[i], x)
        if gap < best:
            best, nearest = gap, k
    return best, nearest


@kernel
def _least_gap(
    features: Any, radius: Any, paths: Any, walls: int, i: int, target: int, low: float, high: float
) -> tuple[float, float, int]:
    """Return where a gap is least between two times (golden-section search): gap, time, feature."""
    for _ in range(STEPS):
        one, two = high - GOLDEN * (high - low), low + GOLDEN * (high - low)
        left, _f = _gap_to_target(features, radius, paths, walls, i, target, one)
        right, _f = _gap_to_target(features, radius, paths, walls, i, target, two)
        if left < right:
            high = two
        else:
            low = one
    s = (low + high) / 2
    gap, nearest = _gap_to_target(features, radius, paths, walls, i, target, s)
    return gap, s, nearest


@kernel
def _record_least_gaps(
    features: Any, radius: Any, paths: Any, walls: int, i: int, target: int, span: float, out: Any
) -> None:
    """Note the least gaps inside a stretch, and what the gap is where it begins and ends."""
    before, found, now, f = math.inf, 0, math.inf, -1
    for k in range(SAMPLES + 2):
        later, g = math.inf, -1
        if k <= SAMPLES:
            later, g = _gap_to_target(features, radius, paths, walls, i, target, span * k / SAMPLES)
        if k == 1:
            out.begin_gap, out.opens = now, now <= later
        if 1 < k <= SAMPLES and now < before and now <= later < math.inf and found < MINIMA:
            low, high = span * (k - 2) / SAMPLES, span * k / SAMPLES
            out.gap[found], out.at[found], out.nearest[found] = _least_gap(
                features, radius, paths, walls, i, target, low, high
            )
            found += 1
        if k == SAMPLES + 1 and now < before:
            out.end_gap, out.end_nearest = now, f
        before, now, f = now, later, g


def _least_gaps(features: Any, radius: Any, paths: Any, moves: Any, spans: Any, walls: int, out: Any) -> None:
    """Fill ``out`` (J, B, T) with the least gaps on J stretches of B balls to T targets; ``paths`` (J, B, 3, 3).

    ``moves`` (J, B): 1 for a ball that moves, 0 for one that does not, -1 for one that is no longer there.
    """
    for j in range(spans.shape[0]):
        for i in range(radius.shape[0]):
            for target in range(out.shape[2]):
                pair = target < radius.shape[0]
                other = moves[j, target] if pair else 0
                if not (pair and target <= i) and moves[j, i] >= 0 and other >= 0 and moves[j, i] + other > 0:
                    _record_least_gaps(features, radius, paths[j], walls, i, target, spans[j], out[j, i, target])


LEAST = (
    None, array_of(FEATURES), array_of(float), array_of(float, 4), array_of(int, 2), array_of(float), int,
    array_of(LEAST_GAPS, 3),
)  # fmt: skip


@functools.cache
def compiled_least_gaps() -> Callable[..., None]:
    """Return the search, compiled; from the second time on it is loaded from the cache."""
    return njit(_least_gaps, signature(*LEAST), _nrt=False)


# --- along a run ------------------------------------------------------------------------------------------------------


class _Place(NamedTuple):
    """Where a gap is least: of which ball, to what, and when."""

    ball: int
    target: int
    feature: int
    time: float
    turned: bool
    """Whether an event ends the approach."""


def _stretches(run: Any) -> tuple[Array, Array, NDArray[np.int64]]:
    """Return times (J + 1,), paths (J, B, 3, 3) and whether balls move (J, B), between the events of a run."""
    log, balls = run.log, len(run.scene.balls)
    times = np.unique(np.append(log["t"], run.end))
    floor = run.scene.floor
    if floor is not None and (floor.rolling_drag > 0 or any(floor.slope)):
        # (a ball that rolls is on a parabola for a short time only: to 1e-7 m)
        pieces = np.maximum(np.ceil(np.diff(times) / LONGEST_STRETCH).astype(int), 1)
        inner = [np.linspace(a, b, n, endpoint=False) for a, b, n in zip(times, times[1:], pieces, strict=False)]
        times = np.unique(np.append(np.concatenate([*inner, times[-1:]]), times))
    middle = (times[:-1] + times[1:]) / 2
    start, half = run.at(times[:-1]), run.at(middle)
    paths = np.zeros((len(middle), balls, 3, 3))
    moves = np.zeros((len(middle), balls), np.int64)
    paths[:, :, 0], paths[:, :, 1] = start.position, start.velocity
    paths[:, :, 2] = (half.velocity - start.velocity) / (middle - times[:-1])[:, None, None]
    for i in range(balls):
        own = log[log["ball"] == i]
        phase = own["phase"][np.searchsorted(own["t"], times[:-1], side="right") - 1]
        hops = phase == BOUNCING  # so low that it is as if it slid, at a constant velocity
        paths[hops, i, 2], paths[hops, i, 1, 2], paths[hops, i, 0, 2] = 0.0, 0.0, run.scene.balls[i].radius
        moves[:, i] = np.where(phase >= HELD, -1, (phase < REST) | hops)
    return times, np.ascontiguousarray(np.nan_to_num(paths)), moves


def _places(run: Any, features: Any, times: Array, paths: Array, moves: NDArray[np.int64]) -> Iterator[_Place]:
    """Yield where gaps are least, along the whole run."""
    scene = run.scene
    radius = np.array([ball.radius for ball in scene.balls])
    targets = len(radius) + len(scene.walls) + len(scene.pocket_names)
    spans = np.diff(times)
    # gaps that still close where a stretch ends, and their features
    still_closing, features_then = np.full((len(radius), targets), math.inf), np.zeros((len(radius), targets), np.int64)
    for rows in block_slices(len(spans), BLOCK):
        least = np.zeros((rows.stop - rows.start, len(radius), targets), LEAST_GAPS)
        least["gap"], least["end_gap"] = math.inf, math.inf
        compiled_least_gaps()(features, radius, paths[rows], moves[rows], spans[rows], len(scene.walls), least)
        # contacts are no misses: a gap that closes to nothing where an event is, or that is none from the begin on
        touching = SEAM * radius[:, None]
        least["end_gap"][least["end_gap"] <= touching] = math.inf
        least["gap"][least["begin_gap"] <= touching] = math.inf
        for j, here in enumerate(least):
            begin, last = float(times[rows.start + j]), rows.start + j == len(spans) - 1
            turned = (still_closing < math.inf) & ((here["opens"] > 0) | _neither_moves(moves[rows.start + j], targets))
            for i, target in np.argwhere(turned).tolist():
                yield _Place(i, target, int(features_then[i, target]), begin, True)
            for i, target, k in np.argwhere(here["gap"] < math.inf).tolist():
                one = here[i, target]
                yield _Place(i, target, int(one["nearest"][k]), min(begin + float(one["at"][k]), run.end), False)
            still_closing, features_then = here["end_gap"], here["end_nearest"]
            if last:
                for i, target in np.argwhere(still_closing < math.inf).tolist():
                    yield _Place(i, target, int(features_then[i, target]), run.end, False)


def _neither_moves(moves: NDArray[np.int64], targets: int) -> NDArray[np.bool_]:
    """Return of which ball (B,) and target (T,) neither moves."""
    rest: NDArray[np.bool_] = (moves[:, None] == 0) & (np.append(moves, np.zeros(targets - len(moves), np.int64)) == 0)
    return rest


def near_misses(run: Any, parameters: Parameters, passages: Passages) -> list[NearMiss]:
    """Return all near misses of a run, the one that the smallest change of the parameters makes a contact first."""
    scene, log, p = run.scene, run.log, len(parameters)
    if scene.air is not None:
        raise CaromError(
            "near_misses: expected a scene without air, got one with it; margin has the switches at its events"
        )
    arrays = parameters.arrays
    features, balls = (
        seeded_records(getattr(arrays, name), [one[name] for one in parameters.slopes])
        for name in ("features", "balls")
    )
    names = [*scene.ball_names, *scene.wall_names, *scene.pocket_names]
    time_of = passages.derivatives[:, PLACES["time"]][:, 0]
    states: dict[float, tuple[Any, Any]] = {}
    found = []
    for one in _places(run, arrays.features, *_stretches(run)):
        if one.time not in states:
            states[one.time] = run.at(one.time), passages.at(one.time)[0]
        here, slopes = states[one.time]
        shift = np.zeros(p)
        if one.turned:
            its = (log["t"] == one.time) & np.isin(log["ball"], [one.ball, one.target])
            shift = time_of[np.flatnonzero(its)[0]] if its.any() else shift

        def place(k: int, here: Any = here, slopes: Any = slopes, shift: Array = shift) -> list[Dual]:
            x, v = here.position[k], here.velocity[k]
            return [Dual(float(x[c]), slopes[k, c] + v[c] * shift) for c in range(3)]

        with np.errstate(all="ignore"):
            if one.target < len(scene.balls):
                reach = balls[one.ball].radius + balls[one.target].radius
                gap = lifted(pair_gap)(place(one.ball), place(one.target), reach)
            else:
                gap = lifted(feature_gap)(features[one.feature], balls[one.ball].radius, place(one.ball))
        size, slope = abs(float(value(gap))), float(np.linalg.norm(derivative(gap, p)))
        radius = size / slope if slope > 0 else math.inf
        both = [k for k in (one.ball, one.target) if k < len(scene.balls)]
        at_rest = not np.any(here.velocity[both])
        found.append(NearMiss(one.time, names[one.ball], names[one.target], size, radius, at_rest))
    return sorted(found, key=lambda miss: (miss.radius, miss.time))
