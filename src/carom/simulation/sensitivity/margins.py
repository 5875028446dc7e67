"""How far each event of a run is from the nearest change of regime, to first order, as a change of the parameters.

A graze: the speed of approach goes to zero as the square root of what is left, so that its square is what varies linearly.
Where a wall presses a ball on the floor, slip may stop and begin again at both contacts while they act, and no number of the result
shows how near the next sequence is: the impact is computed again for states along each parameter, up to the first with another.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from carom.core.geometry.gaps import impact_normal
from carom.core.jit.compile import is_cached
from carom.core.jit.objects import as_objects
from carom.core.motion.phases import SLIDING
from carom.core.motion.restitution import restitution
from carom.laws.law import TWO_STEP_WALL
from carom.simulation.records import BALL, MEETINGS, WALL, WALLS, event_numbers
from carom.simulation.sensitivity.dual import derivative, value
from carom.simulation.sensitivity.interpreted import seeded
from carom.simulation.sensitivity.lift import lifted
from carom.simulation.sensitivity.parameters import Parameters
from carom.simulation.sensitivity.pass_kernels import met_feature
from carom.simulation.sensitivity.passages import Passage, Passages
from carom.simulation.wall_and_floor import compiled_joint_impact, joint_impact

__all__ = ["EXACT", "Margin", "impacts_at_once", "margins"]

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
            seeded(getattr(arrays, name), [one[name] for one in parameters.slopes])
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
