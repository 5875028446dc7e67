"""Follow a recorded run again with dual numbers: flows, event times by the implicit function theorem, and the laws' derivatives.

The log tells what happened; roots are not solved again, and not differentiated. At an event whose gap g closes at the rate g', the
time changes by dt = -dg / g', dg the change of the gap at the time as recorded (Kong, Payne, Zhu & Johnson 2023, arXiv 2306.06862;
Zhong et al. 2023, arXiv 2305.00092). The balls are moved to the changed time by the flow before the impact, the law acts, and they
leave from there by the flow after it, with clocks that have derivatives: that is the saltation matrix.
"""

from __future__ import annotations

import math
from typing import Any, NamedTuple

import numpy as np

from carom.core.geometry.features import FALLS, OVER, distance
from carom.core.jit.objects import as_objects
from carom.core.motion.phases import BOUNCING, FLIGHT, HELD, LEFT, POCKETED, REST, SLIDING, grounded, next_phase
from carom.errors import CaromError
from carom.simulation.loop import move_by
from carom.simulation.predict import begin
from carom.simulation.records import BALL, FLOOR, HELD_EVENT, LEFT_EVENT, PHASE, POCKETED_EVENT, SETTLED, WALL
from carom.simulation.resolve import meet_ball, meet_floor, meet_wall
from carom.simulation.resting_contact import stays_clear
from carom.simulation.sensitivity.dual import Dual, derivative, value
from carom.simulation.sensitivity.gaps import feature_gap, feature_way, pair_gap
from carom.simulation.sensitivity.lift import lifted

__all__ = ["Passage", "follow", "state_of"]

# A gap that closes more slowly than this share of the speeds is a graze: no derivative exists.
LEAST_APPROACH = 1e-9
# Gaps below this share of the radius are contacts.
IN_TOUCH = 1e-7
FIELDS = ("x", "v", "w")


class Passage(NamedTuple):
    """One row of the log: its time, and what could switch there."""

    time: Any
    ball: Any
    approach: Any
    """Rate at which the gap closes (m/s); None where nothing is met."""
    required: Any
    friction: float | None
    slip: Any


def _copy(ball: Any) -> Any:
    new = object.__new__(type(ball))
    for name in type(ball).__slots__:
        one = getattr(ball, name)
        setattr(new, name, list(one) if isinstance(one, list) else one)
    return new


def _seeded(objects: Any, slopes: list[dict[str, Any]]) -> None:
    """Give the numbers of records their derivatives, one dict of fields for each parameter."""
    for field in slopes[0]:
        all_of = np.stack([one[field] for one in slopes], axis=-1)
        for row, d in zip(objects, all_of, strict=True):
            if not d.any():
                continue
            old = getattr(row, field)
            new = (
                [Dual(x, g) if g.any() else x for x, g in zip(old, d, strict=True)]
                if isinstance(old, list)
                else Dual(old, d)
            )
            setattr(row, field, new)


def state_of(world: Any, ball: Any, t: Any) -> Any:
    """Return the ball, advanced to the time t."""
    new = _copy(ball)
    if new.phase < HELD:
        lifted(begin)(world, new)
        lifted(move_by)(world, new, t - new.clock, t)
    return new


def follow(scene: Any, setup: Any, slopes: list[dict[str, dict[str, Any]]], log: Any) -> tuple[Any, list[Passage]]:
    """Return the world in dual numbers, and the passage of every row of the log."""
    world, features, balls = (as_objects(np.array(one)) for one in (setup.world, setup.features, setup.balls))
    plain = as_objects(setup.features)
    for name, objects in (("world", world), ("features", features), ("balls", balls)):
        _seeded(objects, [one[name] for one in slopes])
    world = world[0]
    users = [law.kernel for law in scene.called_laws]
    p, count = len(slopes), len(balls)
    passages: list[Passage] = []
    for i, row in enumerate(log[:count]):
        ball = balls[i]
        ball.phase, ball.clock, ball.repeats, ball.energy = int(row["phase"]), 0.0, 0, math.nan
        ball.next_kind, ball.next_at = 8, math.inf
        if SLIDING <= ball.phase <= REST:
            ball.x[2] = ball.radius
            _set(
                ball, *lifted(grounded)(tuple(ball.v), tuple(ball.w), ball.radius, ball.kappa, world.g, world.floor_mu)
            )
        _pin(ball, row)
        lifted(begin)(world, ball)
        passages.append(Passage(0.0, _copy(ball), None, None, None, None))
    n = count
    while n < len(log):
        row = log[n]
        kind, i = int(row["kind"]), int(row["ball"])
        ball = balls[i]
        rows = [row, log[n + 1]] if kind == BALL else [row]
        if kind == HELD_EVENT:
            ball.phase = HELD
            passages.append(Passage(_time(ball, row), _copy(ball), None, None, None, None))
            n += 1
            continue
        passages += _event(world, features, plain, balls, users, rows, p, n - count)
        n += len(rows)
        if n < len(log):
            _release(world, features, balls, {int(one["ball"]) for one in rows}, passages[-1].time)
    return world, passages


def _time(ball: Any, row: Any) -> Any:
    """Return the time of a row, at the ball's clock."""
    return ball.clock if isinstance(ball.clock, Dual) else float(row["t"])


def _set(ball: Any, phase: int, v: Any, w: Any) -> None:
    ball.phase, ball.v, ball.w = phase, list(v), list(w)


def _pin(ball: Any, row: Any, when: str = "") -> None:
    """Give a ball the values that the log has after an event, or before it, to the last bit; its derivatives stay."""
    for field in FIELDS:
        old = getattr(ball, field)
        new = [float(x) for x in row[field if field == "x" else field + when]]
        setattr(ball, field, [Dual(x, o.d) if isinstance(o, Dual) else x for x, o in zip(new, old, strict=True)])
    if when:
        return
    ball.phase = int(row["phase"])
    if isinstance(ball.clock, Dual):
        ball.clock = Dual(float(row["t"]), ball.clock.d)


def _release(world: Any, features: Any, balls: Any, busy: set[int], t: Any) -> None:
    """Follow the bounces of a ball one by one from here on if something may reach it (carom.simulation.loop)."""
    for m, ball in enumerate(balls):
        if ball.phase == BOUNCING and m not in busy and not lifted(stays_clear)(features, balls, m, ball.lasts):
            lifted(move_by)(world, ball, t - ball.clock, t)
            ball.phase = FLIGHT
            lifted(begin)(world, ball)


def _event(
    world: Any, features: Any, plain: Any, balls: Any, users: Any, rows: list[Any], p: int, number: int
) -> list[Passage]:
    """Follow the ball, or the pair, of one event through it."""
    row = rows[0]
    pair = [balls[int(one["ball"])] for one in rows]
    feature = -1
    if int(row["kind"]) in (PHASE, SETTLED):
        t = pair[0].clock + pair[0].lasts
    else:
        here = [state_of(world, one, float(row["t"])) for one in pair]
        if int(row["kind"]) not in (BALL, FLOOR):
            x, v = (tuple(value(one) for one in part) for part in (here[0].x, here[0].v))
            feature = _feature(plain, row, value(here[0].radius), x, v)
        t = _time_of_contact(features, plain, feature, here, row, p, number)
    t = Dual(float(row["t"]), derivative(t, p))
    for one, its in zip(pair, rows, strict=True):
        lifted(move_by)(world, one, t - one.clock, t)
        _pin(one, its, "_before")
    approach, required, friction = _act(world, features, feature, balls, users, rows, number)
    for one, its in zip(pair, rows, strict=True):
        _pin(one, its)
        lifted(begin)(world, one)
    slip, ball = None, pair[0]
    if ball.phase == SLIDING:
        x, y = ball.v[0] - ball.radius * ball.w[1], ball.v[1] + ball.radius * ball.w[0]
        slip = (x * x + y * y, x, y)
    return [Passage(t, _copy(one), approach, required, friction, slip) for one in pair]


def _time_of_contact(features: Any, plain: Any, feature: int, here: list[Any], row: Any, p: int, number: int) -> Any:
    """Return the time of an event, from the gap and its rate at the time as recorded."""
    t0, ball = float(row["t"]), here[0]
    x, v = (np.array([value(one) for one in part]) for part in (ball.x, ball.v))
    if len(here) > 1:
        other = here[1]
        gap = lifted(pair_gap)(tuple(ball.x), tuple(other.x), ball.radius + other.radius)
        r = x - [value(one) for one in other.x]
        v = v - [value(one) for one in other.v]
        rate = float(r @ v / np.linalg.norm(r))
    elif feature < 0:
        gap, rate = ball.x[2] - ball.radius, float(v[2])
    else:
        gap = lifted(feature_gap)(features[feature], ball.radius, tuple(ball.x))
        rate = feature_way(plain[feature], tuple(x.tolist()), tuple(v.tolist()))
    moved = derivative(gap, p)
    if not np.any(moved):
        return Dual(t0, moved)
    if not abs(rate) > LEAST_APPROACH * float(np.linalg.norm(v)):
        raise CaromError(
            f"sensitivity: events[{number}] ({t0:.9g} s, ball {int(row['ball'])}): expected an impact, got one at {abs(rate):.2g}"
            " m/s (a graze, or the last of ever lower bounces), where no derivative exists; move a start a little, or end the"
            " run before"
        )
    return Dual(t0, -moved / rate)


def _act(
    world: Any, features: Any, feature: int, balls: Any, users: Any, rows: list[Any], number: int
) -> tuple[Any, Any, float | None]:
    """Let what happens at an event happen; return speed of approach, required friction, and the friction there is."""
    row, kind = rows[0], int(rows[0]["kind"])
    ball = balls[int(row["ball"])]
    approach = required = friction = None
    if kind == BALL:
        other = balls[int(rows[1]["ball"])]
        approach = -_closing(ball, other)
        _j, required, _regime = lifted(meet_ball)(world, ball, other)
        friction = value(world.pair_mu)
    elif kind == FLOOR:
        approach = -ball.v[2]
        _j, required, _regime = lifted(meet_floor)(world, features, balls, int(row["ball"]))
        friction = value(world.floor_mu)
    elif kind == WALL:
        f = features[feature]
        approach = -lifted(feature_way)(f, tuple(ball.x), tuple(ball.v))
        try:
            _j, _jf, required, _regime, _refused = lifted(meet_wall)(world, f, ball, users)
        except TypeError as error:
            raise CaromError(
                f"sensitivity: events[{number}]: expected a wall's law made of + - * / and functions of math, got: {error}"
            ) from error
        friction = value(f.mu)
    elif kind == PHASE:
        _set(ball, *lifted(next_phase)(int(row["phase_before"]), tuple(ball.v), tuple(ball.w), ball.radius, ball.kappa))
    elif kind == SETTLED:
        _set(ball, *lifted(grounded)(tuple(ball.v), tuple(ball.w), ball.radius, ball.kappa, world.g, world.floor_mu))
    elif kind == POCKETED_EVENT:
        ball.phase = POCKETED
    elif kind == LEFT_EVENT and int(row["phase"]) == LEFT:
        ball.phase = LEFT
    return approach, required, friction


def _closing(ball: Any, other: Any) -> Any:
    r = [one - two for one, two in zip(ball.x, other.x, strict=True)]
    u = [one - two for one, two in zip(ball.v, other.v, strict=True)]
    size = math.sqrt(sum(value(one) ** 2 for one in r))
    far = Dual(size, sum(value(one) * derivative(one, 1) for one in r) / size)
    return (r[0] * u[0] + r[1] * u[1] + r[2] * u[2]) / far


def _feature(features: Any, row: Any, a: float, x: Any, v: Any) -> int:
    """Return the number of the feature that a ball has met: of the wall's or pocket's, the one in touch."""
    kind, who = int(row["kind"]), int(row["other"])
    best, found = (True, math.inf), -1
    for k, f in enumerate(features):
        gate = f.kind == OVER
        if kind == WALL:
            mine = f.wall == who and not gate and math.isfinite(distance(f, a, x))
        elif kind == POCKETED_EVENT:
            mine = gate and f.ends == FALLS and f.at == who
        else:
            mine = gate and f.wall == who and f.ends != FALLS
        if mine:
            # (in a corner two are in touch: the ball has met the one that it approaches fastest)
            gap, way = abs(feature_gap(f, a, x)), feature_way(f, x, v)
            score = (gap > IN_TOUCH * a, gap if gap > IN_TOUCH * a else way)
            if score < best:
                best, found = score, k
    return found
