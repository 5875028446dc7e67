"""Balls that roll over the rims of pockets within a run: it is cut at the edge, and goes on with the ball that comes out again.

The loop ends a ball's motion where its centre passes a pocket's edge. If it rolls there, and the scene asks for rims, it is handed
to :func:`carom.billiards.pocket_rim`, while the loop follows all other balls, whose bits stay the same. There it meets nothing
but rim and pocket. It falls to the bottom, or comes back over the cloth, where the loop takes it up again; one that comes out
where a wall stands, or behind the mouth, has met the liner, and falls.
"""

from __future__ import annotations

import copy
import functools
import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from carom.bodies import State
from carom.core.geometry.features import OVER, gap_to_feature
from carom.core.jit.kernel import vector
from carom.core.jit.objects import as_objects, write_back
from carom.core.motion.phases import BOUNCING, FLIGHT, HELD, POCKETED, ROLLING
from carom.errors import CaromError
from carom.files import import_optional
from carom.public.other_rooms import function_of
from carom.scene.scene import Scene
from carom.scene.scene_rules import BALLS_TOUCH, TOUCH
from carom.simulation.contacts.contact import DONE
from carom.simulation.loop import LIMIT, QUIET, finish
from carom.simulation.motion import begin_phase, move_by, on_floor_with, write_vector
from carom.simulation.predict import predict
from carom.simulation.records import LOG, NOTHING, ON_RIM, PHASE, POCKETED_EVENT, RIM_EVENT
from carom.simulation.resting_contact import stays_clear
from carom.simulation.scene_loop import SceneLoop, joined
from carom.simulation.setup import set_up

__all__ = ["Rides", "follow_over_rims"]

Array = NDArray[np.float64]
AHEAD = 1e-6  # of the pocket's radius: so far beyond the edge is the ball that the loop takes up again
NEAR = 1e-6
STEP = 1e-3  # s, of the orientation


@dataclass(frozen=True, eq=False)
class _Ride:
    """The way of a ball over a rim, from the row of the log with which it begins."""

    row: Any
    run: Any
    """The `RollingRun`, about the pocket's middle."""
    middle: Array
    size: float
    """Radius of the pocket, m."""

    def state(self, s: float) -> tuple[Array, Array, Array]:
        """Return place, velocity and spin a time s after its beginning."""
        found = self.run.at(min(max(s, 0.0), self.run.duration))
        return found.place[0] + self.middle, found.velocity[0], found.angular_velocity[0]

    def turn(self, begin: float, end: float) -> Array:
        """Return the rotation between two times, a unit quaternion (w, x, y, z): in short steps by the spin at their middles."""
        from scipy.spatial.transform import Rotation

        times = np.linspace(begin, min(end, self.run.duration), max(8, math.ceil((end - begin) / STEP)) + 1)
        found, steps = Rotation.identity(), np.diff(times)[:, None]
        for one in self.run.at((times[1:] + times[:-1]) / 2).angular_velocity * steps:
            found = Rotation.from_rotvec(one) * found
        return np.roll(found.as_quat(), 1)

    @functools.cached_property
    def events(self) -> list[Any]:
        """Its events; of a ball that comes out, the last one is that at which its centre is over the cloth again, for good."""
        events = list(self.run.events)
        if self.run.end != "away":
            return events
        k = max(k for k, one in enumerate(events[:-1]) if math.hypot(*one.place[:2]) <= self.size * (1 + NEAR))
        last = events[k]
        (x, y, _z), (vx, vy, _vz) = last.place, last.velocity
        if last.kind == "crosses" and x * vx + y * vy > 0:
            return events[: k + 1]
        # it flies out: |x + v s| = size
        a, b, c = vx * vx + vy * vy, x * vx + y * vy, x * x + y * y - self.size**2
        time = last.time + (math.sqrt(max(b * b - a * c, 0.0)) - b) / a
        there = self.run.at(time)
        return [
            *events[: k + 1],
            last._replace(kind="flies", time=time, place=there.place[0], velocity=there.velocity[0]),
        ]

    @property
    def end(self) -> float:
        """Time at which it ends, s."""
        return float(self.row["t"] + self.events[-1].time)


def _ride(scene: Scene, row: Any) -> _Ride:
    import_optional("scipy.integrate", "run.pockets = 'rim'")
    pockets = [pocket for wall in scene.walls for pocket in wall.pockets]
    pocket = pockets[row["other"]]
    state = State.of(np.array(row["v_before"]), np.array(row["w_before"]), np.array(row["x"]))
    run = function_of("billiards", "pocket_rim")(scene, pocket.name, state, ball=int(row["ball"]))
    if run.end not in ("bottom", "away"):
        raise CaromError(
            f"simulate: {scene.ball_names[row['ball']]}: expected a ball that falls or comes out of the {pocket.name}, got"
            f" one that still rolls around its rim after {run.duration:g} s"
        )
    return _Ride(row, run, np.array([*pocket.center, 0.0]), float(pocket.radius))


class Rides:
    """All ways of balls over rims that a log tells of, computed again from it."""

    def __init__(self, scene: Scene, log: NDArray[np.void]) -> None:
        self._begins = np.flatnonzero((log["kind"] == RIM_EVENT) & (log["phase_before"] == ROLLING))
        self._scene, self._log = scene, log
        self._found: dict[int, _Ride] = {}

    def followed(self, rows: NDArray[np.void]) -> NDArray[np.void]:
        """Return rows of the log as the closed forms take them: they do not follow balls on rims."""
        if not len(self._begins):
            return rows
        rows = rows.copy()
        rows["phase"][rows["phase"] == ON_RIM] = HELD
        return rows

    def fill(self, which: NDArray[np.int64], after: Array, x: Array, v: Array, w: Array) -> None:
        """Write the states (N, 3) of balls on rims, a time ``after`` (N,) the rows with the numbers ``which`` (N,)."""
        for k in np.flatnonzero(self._log["phase"][which] == ON_RIM) if len(self._begins) else ():
            if after[k] > 0:  # (the row has the state after its event)
                row = self._log[which[k]]
                ride = self._of(row["ball"], which[k])
                x[k], v[k], w[k] = ride.state(float(row["t"] - ride.row["t"] + after[k]))

    def turns(self, which: NDArray[np.int64], after: Array, q: Array) -> Array:
        """Return rotations (N, 4) of a time ``after`` (N,) the rows with the numbers ``which`` (N,): q, but of balls on rims."""
        for k in np.flatnonzero(self._log["phase"][which] == ON_RIM) if len(self._begins) else ():
            if after[k] > 0:
                row = self._log[which[k]]
                ride = self._of(row["ball"], which[k])
                begin = float(row["t"] - ride.row["t"])
                q[k] = ride.turn(begin, begin + after[k])
        return q

    def _of(self, ball: int, row: int) -> _Ride:
        own = self._begins[(self._log["ball"][self._begins] == ball) & (self._begins <= row)]
        first = int(own[-1])
        if first not in self._found:
            self._found[first] = _ride(self._scene, self._log[first])
        return self._found[first]


def follow_over_rims(
    loop: SceneLoop, until: float, most: int, progress: Callable[[int, float], None] | None = None
) -> tuple[int, int, NDArray[np.void]]:
    """Run events as `SceneLoop.follow` does, with balls that roll over rims; the whole way of a ball is one event of ``most``."""
    rides: list[_Ride] = []
    parts: list[NDArray[np.void]] = []
    events = 0
    while True:
        ride = min(rides, key=lambda one: one.end, default=None)
        stop = until if ride is None else min(until, ride.end)
        kept = loop.balls.copy(), loop.slow, loop.last
        status, count, log = loop.follow(stop, most - events, progress)
        caught = np.flatnonzero((log["kind"] == POCKETED_EVENT) & (log["phase_before"] == ROLLING))
        if len(caught):
            if log["t"][caught[0]] < log["t"][-1]:  # no further than to the first of them
                loop.balls, loop.slow, loop.last = kept
                status, count, log = loop.follow(float(log["t"][caught[0]]), most - events, progress)
                caught = np.flatnonzero((log["kind"] == POCKETED_EVENT) & (log["phase_before"] == ROLLING))
            log["kind"][caught], log["phase"][caught] = RIM_EVENT, ON_RIM
            found = [_ride(loop.scene, row.copy()) for row in log[caught]]
            rides += found
            parts += [log, *map(_rows_between, found)]
        else:
            parts.append(log)
        events += count
        if status == LIMIT and events >= most:
            break
        if not len(caught):
            if ride is None or ride.end > until:
                break
            rides.remove(ride)
            parts.append(_end(loop, ride))
    if rides and status == QUIET:  # (all others are)
        status = DONE
    log = joined(parts)
    starts, rest = log[: len(loop.balls)], log[len(loop.balls) :]
    rest = rest[np.argsort(rest["t"], kind="stable")]
    return status, events, joined([starts, rest[rest["t"] <= (loop.last if status == LIMIT else until)]])


def _row(ride: _Ride, number: int) -> Any:
    """Return a row of the log for an event of a ride, with the states before and after it."""
    event, row = ride.events[number], np.zeros(1, LOG)[0]
    row["t"], row["ball"] = ride.row["t"] + event.time, ride.row["ball"]
    row["met"], row["other"], row["regime"] = NOTHING, -1, ride.row["regime"]
    row["x"], row["v"], row["v_before"] = event.place + ride.middle, event.velocity, event.velocity
    row["w"] = row["w_before"] = ride.state(math.nextafter(event.time, math.inf))[2]
    row["phase_before"] = FLIGHT if event.kind in ("lands", "flies") else ON_RIM
    if event.kind == "lands":
        mass = float(ride.run.setting.ball.mass)
        _x, row["v_before"], row["w_before"] = ride.state(event.time)
        row["impulse"] = mass * (row["v"] - row["v_before"])
    return row


def _rows_between(ride: _Ride) -> NDArray[np.void]:
    """Return the rows of a ride's flights and landings."""
    rows = []
    for k, event in enumerate(ride.events[:-1]):
        if event.kind in ("leaves", "lands"):
            row = _row(ride, k)
            rolls = ride.run.at(math.nextafter(event.time, math.inf)).rolls[0]
            row["kind"], row["phase"] = (PHASE if event.kind == "leaves" else RIM_EVENT), (ON_RIM if rolls else FLIGHT)
            if event.kind == "lands":
                row["met"], row["other"] = POCKETED_EVENT, ride.row["other"]
            rows.append(row)
    return np.array(rows, LOG)


def _end(loop: SceneLoop, ride: _Ride) -> NDArray[np.void]:
    """End a ride in the loop's balls: the ball lies in the pocket, or goes on; return the row of the log."""
    row, t, i = _row(ride, -1), ride.end, int(ride.row["ball"])
    arrays = set_up(loop.scene, compiled=False, with_rims=True)
    world, features, balls = as_objects(arrays.world)[0], as_objects(arrays.features), as_objects(loop.balls)
    ball = balls[i]
    kind, x, v, w = ride.events[-1].kind, row["x"], row["v"], row["w"]
    if kind == "crosses":  # (it rolls, without the slip of rounding)
        v[2], x[2] = 0.0, ball.radius
        w[0], w[1] = -v[1] / ball.radius, v[0] / ball.radius
    if kind != "bottom":  # as pocket_rim begins ahead of the edge
        x[:2] += AHEAD * ride.size / math.hypot(v[0], v[1]) * v[:2]
    ball.x, ball.v, ball.w, ball.clock = x.tolist(), v.tolist(), w.tolist(), t
    if kind == "bottom" or not _is_free(loop.scene, world, features, balls, i, t):
        row["kind"], row["phase"] = POCKETED_EVENT, POCKETED
        row["met"], row["other"] = POCKETED_EVENT, ride.row["other"]
    else:
        ball.phase, ball.repeats, ball.energy, ball.turned_in = FLIGHT, 0, math.nan, 0
        if kind == "crosses":
            ball.phase, new_v, new_w = on_floor_with(world, ball, vector(ball.v), vector(ball.w))
            write_vector(ball.v, new_v)
            write_vector(ball.w, new_w)
        ball.next_kind, ball.next_at = NOTHING, math.inf
        _look_ahead(world, features, balls, i, t, loop.slow)
        row["kind"], row["phase"], row["v"], row["w"] = PHASE, ball.phase, ball.v, ball.w
    write_back(balls, loop.balls)
    loop.last = max(loop.last, t)
    return np.array([row], LOG)


def _look_ahead(world: Any, features: Any, balls: Any, i: int, t: float, slow: float) -> None:
    """Predict the next event of ball i, which the loop takes up again at time t."""
    begin_phase(world, balls[i])
    for m, ball in enumerate(balls):
        if ball.phase == BOUNCING and m != i and not stays_clear(features, balls, m, ball.lasts):
            move_by(world, ball, t - ball.clock, t)
            ball.phase = FLIGHT
            begin_phase(world, ball)
            predict(world, features, balls, m, slow)
    predict(world, features, balls, i, slow)


def _is_free(scene: Scene, world: Any, features: Any, balls: Any, i: int, t: float) -> bool:
    """Return whether ball i is where nothing else is at time t; CaromError where it overlaps another ball."""
    ball = balls[i]
    x, a = vector(ball.x), ball.radius
    if any(wall.blocked(x) for wall in scene.walls):
        return False
    if any(f.kind != OVER and -a < gap_to_feature(f, a, x) < -TOUCH * a for f in features):
        return False
    moved = copy.deepcopy(balls)
    finish(world, moved, t)
    for k, other in enumerate(moved):
        reach = a + other.radius - BALLS_TOUCH * min(a, other.radius)
        if k != i and other.phase < HELD and math.dist(x, other.x) < reach:
            raise CaromError(
                f"simulate: {scene.ball_names[i]}: expected a free place where it comes back over a pocket's edge, at"
                f" t = {t:.6g} s, got one where {scene.ball_names[k]} is"
            )
    return True
