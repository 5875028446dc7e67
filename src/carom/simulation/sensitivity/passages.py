"""The passages of a run: what a pass over its log leaves, row by row, with derivatives."""

from __future__ import annotations

import functools
import math
from collections.abc import Callable, Iterator
from types import SimpleNamespace
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from carom.bodies import holds_arrays
from carom.core.geometry.features import (
    FALLS,
    OVER,
    contact_gap,
    contact_gap_rate,
    feature_gap,
    feature_gap_rate,
    gap_derivatives,
    gap_to_feature,
    pair_gap,
)
from carom.core.jit.dual import as_dual, depends, float_places, scaled, value_of, with_value
from carom.core.jit.kernel import Vec, dot, kernel, steepest, vector
from carom.core.motion.phases import BOUNCING, FLIGHT, HELD, REST, SLIDING, acts
from carom.simulation.contact_kinds import line_of_centres, pair_friction, resolve_event
from carom.simulation.motion import begin_phase, goes_on_in_air, move_by, set_on_floor, to_last_piece, write_vector
from carom.simulation.records import (
    BALL,
    FLOOR,
    HELD_EVENT,
    IN_CLUSTER,
    NOTHING,
    PHASE,
    POCKETED_EVENT,
    SETTLED,
    WALL,
    WALL_IN_CLUSTER,
)
from carom.simulation.resting_contact import stays_clear


class Dual:
    """A number x + d eps."""

    __slots__ = ("d", "x")
    __array_ufunc__ = None  # (a number of NumPy's on the left leaves the operation to us)

    def __init__(self, x: float, d: Any) -> None:
        self.x, self.d = x, d

    def __add__(self, o: Any) -> Dual:
        """Sum."""
        return Dual(self.x + o.x, self.d + o.d) if isinstance(o, Dual) else Dual(self.x + o, self.d)

    __radd__ = __add__

    def __sub__(self, o: Any) -> Dual:
        """Difference."""
        return Dual(self.x - o.x, self.d - o.d) if isinstance(o, Dual) else Dual(self.x - o, self.d)

    def __rsub__(self, o: Any) -> Dual:
        """Difference."""
        return Dual(o - self.x, -self.d)

    def __mul__(self, o: Any) -> Dual:
        """Product."""
        return Dual(self.x * o.x, self.d * o.x + o.d * self.x) if isinstance(o, Dual) else Dual(self.x * o, self.d * o)

    __rmul__ = __mul__

    def __truediv__(self, o: Any) -> Dual:
        """Quotient."""
        if isinstance(o, Dual):
            q = self.x / o.x
            return Dual(q, (self.d - o.d * q) * (1 / o.x))
        return Dual(self.x / o, self.d * (1 / o))

    def __rtruediv__(self, o: Any) -> Dual:
        """Quotient."""
        q = o / self.x
        return Dual(q, -(self.d * q) * (1 / self.x))

    def __pow__(self, n: Any) -> Dual:
        """Power with a constant exponent."""
        return Dual(self.x**n, self.d * (n * self.x ** (n - 1))) if n else Dual(1.0, 0 * self.d)

    def __neg__(self) -> Dual:
        """Minus."""
        return Dual(-self.x, -self.d)

    def __pos__(self) -> Dual:
        """Plus."""
        return self

    def __abs__(self) -> Dual:
        """Size."""
        return -self if self.x < 0 else self

    def __lt__(self, o: Any) -> bool:
        """Compare values."""
        return bool(self.x < value(o))

    def __le__(self, o: Any) -> bool:
        """Compare values."""
        return bool(self.x <= value(o))

    def __gt__(self, o: Any) -> bool:
        """Compare values."""
        return bool(self.x > value(o))

    def __ge__(self, o: Any) -> bool:
        """Compare values."""
        return bool(self.x >= value(o))

    def __eq__(self, o: object) -> bool:
        """Compare values."""
        return bool(self.x == value(o))

    __hash__ = None  # type: ignore[assignment]

    def __bool__(self) -> bool:
        """Whether the value is not zero."""
        return self.x != 0

    def __int__(self) -> int:
        """Whole part of the value, whose derivative is zero wherever it has one."""
        return int(self.x)

    def __float__(self) -> float:
        """Refuse: a derivative would be lost without a word."""
        raise TypeError(
            "a function that is neither carom's nor in Python's math was called with a number that has a derivative"
        )

    def __repr__(self) -> str:
        """Value and derivatives."""
        return f"Dual({self.x!r}, {self.d!r})"


def value(number: Any) -> Any:
    """Return the value of a dual number, or the number."""
    return number.x if isinstance(number, Dual) else number


def derivative(number: Any, p: int) -> Any:
    """Return the derivatives (p,) of a number."""
    return number.d if isinstance(number, Dual) else np.zeros(p)


def _chain(function: Any, slope: Any) -> Any:
    def lifted(x: Any) -> Any:
        return Dual(function(x.x), x.d * slope(x.x)) if isinstance(x, Dual) else function(x)

    return lifted


def _sqrt(x: Any) -> Any:
    if not isinstance(x, Dual):
        return math.sqrt(x)
    root = math.sqrt(x.x)
    # (the size of a vector that is zero has no derivative; nothing that is returned depends on it then: a kernel multiplies it by
    # the vector, or compares it)
    return Dual(root, x.d * (1 / (2 * root) if root > 0 else 0.0))


def _hypot(x: Any, y: Any) -> Any:
    return _sqrt(x * x + y * y)


def _atan2(y: Any, x: Any) -> Any:
    y0, x0 = value(y), value(x)
    size = x0 * x0 + y0 * y0
    slope = (x0 / size) * getattr(y, "d", 0.0) - (y0 / size) * getattr(x, "d", 0.0)
    return Dual(math.atan2(y0, x0), slope) if isinstance(y, Dual) or isinstance(x, Dual) else math.atan2(y, x)


def _test(function: Any) -> Any:
    return lambda x: function(value(x))


DUAL_MATH = SimpleNamespace(
    inf=math.inf, nan=math.nan, pi=math.pi, tau=math.tau, e=math.e,
    isnan=_test(math.isnan), isfinite=_test(math.isfinite), isinf=_test(math.isinf),
    floor=_test(math.floor), ceil=_test(math.ceil), trunc=_test(math.trunc),
    fabs=abs, sqrt=_sqrt, hypot=_hypot, atan2=_atan2,
    exp=_chain(math.exp, math.exp), log=_chain(math.log, lambda x: 1 / x), log1p=_chain(math.log1p, lambda x: 1 / (1 + x)),
    expm1=_chain(math.expm1, math.exp), sin=_chain(math.sin, math.cos), cos=_chain(math.cos, lambda x: -math.sin(x)),
    tan=_chain(math.tan, lambda x: 1 + math.tan(x) * math.tan(x)),
    tanh=_chain(math.tanh, lambda x: 1 - math.tanh(x) * math.tanh(x)),
    sinh=_chain(math.sinh, math.cosh), cosh=_chain(math.cosh, math.sinh),
    atan=_chain(math.atan, lambda x: 1 / (1 + x * x)), asin=_chain(math.asin, lambda x: 1 / math.sqrt(1 - x * x)),
    acos=_chain(math.acos, lambda x: -1 / math.sqrt(1 - x * x)), pow=lambda x, n: x**n,
    copysign=lambda x, y: abs(x) if math.copysign(1.0, value(y)) > 0 else -abs(x),
)  # fmt: skip


# ----------------------------------------------------------------------------------------------------
# Follow a recorded run again with dual numbers: flows, event times by the implicit function theorem, and the laws' derivatives.
#
# The log tells what happened; roots are not solved again, and not differentiated. At an event whose gap g closes at the rate g',
# the time changes by dt = -dg / g', dg the change of the gap at the time as recorded (Kong, Payne, Zhu & Johnson 2023, arXiv
# 2306.06862; Zhong et al. 2023, arXiv 2305.00092). The balls are moved to the changed time by the flow before the impact, the law
# acts, and they leave from there by the flow after it, with clocks that have derivatives: that is the saltation matrix.
#
# These are kernels: Python runs them on objects (:mod:`carom.simulation.sensitivity.follow`), and compiled code on records of
# dual numbers (:mod:`carom.simulation.sensitivity.follow`), with the same bits. ``walls`` and ``plain`` are the features and the
# balls once more, but their numbers are the values: what happened is known, and looked up there.


# One row of the log: its time, the ball, and what could switch there; NaN where nothing could.
PASSAGES = np.dtype(
    [
        ("time", "f8"),
        ("x", "f8", (3,)),
        ("v", "f8", (3,)),
        ("w", "f8", (3,)),
        ("v_before", "f8", (3,)),  # as it comes to the event
        ("w_before", "f8", (3,)),
        ("approach", "f8"),  # rate at which the gap closes, m/s
        ("required", "f8"),  # friction
        ("friction", "f8"),
        ("slip", "f8", (2,)),  # of a ball that slides from here on, at the floor, m/s
        ("borne", "f8", (4,)),  # as a ball has it (carom.simulation.records)
    ]
)
# As in replay: a graze; a contact.
LEAST_APPROACH, IN_TOUCH = 1e-9, 1e-7


@kernel
def _revalued(row: Any, values: Vec) -> None:
    """Give three numbers the values of the log, to the last bit; their derivatives stay."""
    row[0] = with_value(row[0], values[0])
    row[1] = with_value(row[1], values[1])
    row[2] = with_value(row[2], values[2])


@kernel
def _set_to_log(ball: Any, row: Any) -> None:
    """Give a ball the values that the log has after an event."""
    _revalued(ball.x, vector(row.x))
    _revalued(ball.v, vector(row.v))
    _revalued(ball.w, vector(row.w))
    ball.phase, ball.borne_by = row.phase, row.borne_by
    ball.clock = with_value(ball.clock, row.t)


@kernel
def _set_to_log_before(ball: Any, row: Any) -> None:
    x, y = vector(row.x), (value_of(ball.x[0]), value_of(ball.x[1]), value_of(ball.x[2]))
    off = max(abs(x[0] - y[0]), abs(x[1] - y[1]), abs(x[2] - y[2]))
    if off <= IN_TOUCH * value_of(ball.radius):  # (else a cluster has put it there; it was met where it has come to)
        _revalued(ball.x, x)
    _revalued(ball.v, vector(row.v_before))
    _revalued(ball.w, vector(row.w_before))


@kernel
def _record_state(out: Any, ball: Any) -> None:
    """Write what the ball is now, and that nothing can switch."""
    out.time = ball.clock
    write_vector(out.x, vector(ball.x))
    write_vector(out.v, vector(ball.v))
    write_vector(out.w, vector(ball.w))
    out.approach = out.required = out.friction = math.nan
    out.slip[0] = out.slip[1] = math.nan
    for k in range(4):
        out.borne[k] = ball.borne[k]


@kernel
def _record_state_before(out: Any, ball: Any) -> None:
    write_vector(out.v_before, vector(ball.v))
    write_vector(out.w_before, vector(ball.w))


@kernel
def _begin_all(world: Any, balls: Any, log: Any, out: Any, last: int) -> None:
    for i in range(balls.shape[0]):
        ball = balls[i]
        ball.phase, ball.clock, ball.repeats, ball.energy = log[i].phase, 0.0, 0, math.nan
        ball.next_kind, ball.next_at, ball.lasts = NOTHING, math.inf, math.inf
        if SLIDING <= ball.phase <= REST:
            ball.x[2] = ball.radius
            set_on_floor(world, ball, vector(ball.v), vector(ball.w))
        _set_to_log(ball, log[i])
        begin_phase(world, ball)
        _record_state_before(out[min(i, last)], ball)
        _record_state(out[min(i, last)], ball)


@kernel
def met_feature(walls: Any, row: Any, a: float) -> int:
    """Return the number of the feature that a ball has met: of the wall's or pocket's, the one in touch."""
    kind, who = row.kind, row.other
    x, v = vector(row.x), vector(row.v_before)
    least, best, found = 3, math.inf, -1
    for k in range(walls.shape[0]):
        f = walls[k]
        gate = f.kind == OVER
        if kind == WALL:
            mine = f.wall == who and not gate and gap_to_feature(f, a, x) < math.inf
        elif kind == POCKETED_EVENT:
            mine = gate and f.ends == FALLS and f.at == who
        else:
            mine = gate and f.wall == who and f.ends != FALLS
        if mine:
            # (in a corner two are in touch: the ball has met the one that it approaches fastest)
            gap, rate = feature_gap(f, a, x), feature_gap_rate(f, x, v)
            deep = contact_gap(f, a, gap, rate) if f.yield_time > 0 else gap
            if abs(deep) <= IN_TOUCH * a:
                order, score = 0, rate
            elif (
                f.yield_time > 0 and deep < 0 and rate < 0
            ):  # (something has driven it back to the depth at which it was)
                order, score = 1, rate
            else:
                order, score = 2, abs(deep)
            if order < least or (order == least and score < best):
                least, best, found = order, score, k
    return found


@kernel
def _shift_in_time(ball: Any, dt: Any) -> None:
    """Move a ball by a time that is zero and has derivatives."""
    x, v, w, acc, turn = ball.x, ball.v, ball.w, ball.acc, ball.turn
    for k in range(3):
        x[k] = x[k] + dt * value_of(v[k])
        v[k] = v[k] + dt * value_of(acc[k])
        if k < 2 or value_of(w[k]) != 0:  # (a spin about the vertical that has faded stays zero)
            w[k] = w[k] + dt * value_of(turn[k])
    ball.clock = ball.clock + dt


@kernel
def _move_to_event(
    world: Any, features: Any, walls: Any, balls: Any, plain: Any, row: Any, i: int, k: int, f: int
) -> int:
    """Move ball i, and k if it is another, to the event, at the time that changes with the parameters; False at a graze."""
    ball, other = balls[i], balls[k]
    t = row.t
    yields = f >= 0 and k == i and (acts(walls[f].yield_time) or acts(features[f].yield_time))
    before = as_dual(0.0)
    if yields:
        before = ball.turned_at if ball.turned_in == f + 1 else feature_gap(features[f], ball.radius, vector(ball.x))
    move_by(world, ball, t - ball.clock, as_dual(t))
    if k != i:
        move_by(world, other, t - other.clock, as_dual(t))
    for one in (ball, other):
        if one.decays != 0:  # (what the event's time changes is what the accelerations are now)
            begin_phase(world, one)
    x, v = vector(plain[i].x), vector(plain[i].v)
    speed = math.sqrt(dot(v, v))
    if k != i:
        y, u = vector(plain[k].x), vector(plain[k].v)
        gap = pair_gap(vector(ball.x), vector(other.x), ball.radius + other.radius)
        r, v = (x[0] - y[0], x[1] - y[1], x[2] - y[2]), (v[0] - u[0], v[1] - u[1], v[2] - u[2])
        rate, speed = dot(r, v) / math.sqrt(dot(r, r)), math.sqrt(dot(v, v))
    elif f < 0:
        gap, rate = ball.x[2] - ball.radius, v[2]
    else:
        gap, rate = feature_gap(features[f], ball.radius, vector(ball.x)), feature_gap_rate(walls[f], x, v)
        if yields:
            a = plain[i].radius
            at_contact = contact_gap(
                features[f], ball.radius, gap, feature_gap_rate(features[f], vector(ball.x), vector(ball.v))
            )
            if abs(value_of(at_contact)) <= IN_TOUCH * a:
                gap = at_contact
                rate = contact_gap_rate(walls[f], a, *gap_derivatives(walls[f], x, v, vector(plain[i].acc)))
            else:  # it is back at the depth at which it was
                gap = gap - before
    if depends(gap):
        if not abs(rate) > LEAST_APPROACH * speed:
            return False
        dt = scaled(gap, 0.0, -1 / rate)
        _shift_in_time(ball, dt)
        if k != i:
            _shift_in_time(other, dt)
    return True


@kernel
def _closing(ball: Any, other: Any) -> Any:
    x, y, v, u = vector(ball.x), vector(other.x), vector(ball.v), vector(other.v)
    r = (x[0] - y[0], x[1] - y[1], x[2] - y[2])
    return -dot(r, (v[0] - u[0], v[1] - u[1], v[2] - u[2])) / math.sqrt(dot(r, r))


@kernel
def _resolve_event(
    world: Any, features: Any, balls: Any, users: Any, row: Any, i: int, k: int, f: int
) -> tuple[Any, Any, Any]:
    """Let what happens at an event happen; return speed of approach, required friction, and the friction there is."""
    ball, kind = balls[i], row.kind
    approach = friction = as_dual(math.nan)
    if kind == BALL:
        approach = _closing(ball, balls[k])
        friction = pair_friction(world, ball, balls[k], line_of_centres(ball, balls[k]))
    elif kind == FLOOR:
        approach, friction = -ball.v[2], world.floor_mu
    elif kind == WALL:
        approach, friction = -feature_gap_rate(features[f], vector(ball.x), vector(ball.v)), features[f].mu
    outcome = resolve_event(kind, world, features, balls, i, k if kind == BALL else f, users)
    required = outcome[2] if kind in (WALL, FLOOR, BALL) else as_dual(math.nan)
    return approach, required, friction


@kernel
def _has_slopes(ball: Any) -> bool:
    """Return whether velocity and spin have derivatives: a law answers NaN where it has none."""
    slopes = 0.0
    for k in range(3):
        slopes = slopes + steepest(ball.v[k]) + steepest(ball.w[k])
    return not math.isnan(slopes)


@kernel
def _record_after(world: Any, ball: Any, row: Any, out: Any, approach: Any, required: Any, friction: Any) -> None:
    _set_to_log(ball, row)
    begin_phase(world, ball)
    _record_state(out, ball)
    out.approach, out.required, out.friction = approach, required, friction


@kernel
def _record_slip(out: Any, ball: Any) -> None:
    if ball.phase == SLIDING:
        out.slip[0] = ball.v[0] - ball.radius * ball.w[1]
        out.slip[1] = ball.v[1] + ball.radius * ball.w[0]


@kernel
def _release(world: Any, walls: Any, balls: Any, plain: Any, i: int, k: int, t: Any) -> None:
    """Follow the bounces of a ball one by one from here on if something may reach it (carom.simulation.loop)."""
    for m in range(balls.shape[0]):
        ball = balls[m]
        if ball.phase == BOUNCING and m not in (i, k) and not stays_clear(world, walls, plain, m, plain[m].lasts):
            move_by(world, ball, t - ball.clock, t)
            ball.phase = FLIGHT
            begin_phase(world, ball)


@kernel
def state_at_time(world: Any, ball: Any, first: Any, passage: Any, row: Any, t: float) -> None:
    """Set a ball to what it is at the time t: ``first`` at the start, and with ``passage`` at its last event before, ``row``."""
    ball.radius, ball.mass, ball.kappa = first.radius, first.mass, first.kappa
    write_vector(ball.x, vector(passage.x))
    write_vector(ball.v, vector(passage.v))
    write_vector(ball.w, vector(passage.w))
    ball.clock, ball.phase, ball.repeats, ball.lasts = passage.time, row.phase, 0, math.inf
    ball.borne_by = row.borne_by
    for k in range(4):
        ball.borne[k] = passage.borne[k]
    if row.phase < HELD:
        begin_phase(world, ball)
        move_by(world, ball, as_dual(t) - ball.clock, as_dual(t))


@kernel
def follow_log(world: Any, features: Any, walls: Any, balls: Any, plain: Any, log: Any, users: Any, out: Any) -> int:  # noqa: PLR0915
    """Follow a run again, from the START rows of its log on: ``out`` are its passages, ``balls`` are at their last events.

    Returns -1, or the row of a graze, or of a pressed ball at a border of regimes, where no derivative exists.
    """
    count, rows, last = balls.shape[0], log.shape[0], out.shape[0] - 1
    _begin_all(world, balls, log, out, last)
    n = count
    while n < rows:
        row = log[n]
        i, kind = row.ball, row.kind
        k = log[n + 1].ball if kind == BALL else i
        ball = balls[i]
        if kind == HELD_EVENT:
            ball.phase = HELD
            _record_state_before(out[min(n, last)], ball)
            _record_state(out[min(n, last)], ball)
            n += 1
            continue
        f = -1
        if kind in (PHASE, SETTLED):
            if goes_on_in_air(ball):  # (to the piece that ends the phase)
                to_last_piece(world, ball, value_of(row.t - ball.clock))
            elif kind == PHASE and not abs(plain[i].clock + plain[i].lasts - row.t) <= IN_TOUCH * (1 + row.t):
                return int(n)  # (not by itself: its wall ends, or it lies still, or is let go)
            t = with_value(ball.clock + ball.lasts, row.t)
            move_by(world, ball, t - ball.clock, t)
        else:
            if kind not in (BALL, FLOOR):
                f = met_feature(walls, row, plain[i].radius)
                if f < 0:  # (a ball that began behind a wall is beyond all walls)
                    return int(n)
            if not _move_to_event(world, features, walls, balls, plain, row, i, k, f):
                return int(n)
        one = out[min(n, last)]  # (where passages are not wanted there is one row for all of them)
        _set_to_log_before(ball, row)
        _record_state_before(one, ball)
        if k != i:
            _set_to_log_before(balls[k], log[n + 1])
            _record_state_before(out[min(n + 1, last)], balls[k])
        approach, required, friction = _resolve_event(world, features, balls, users, row, i, k, f)
        if kind == WALL and not _has_slopes(ball):
            return int(n)
        _record_after(world, ball, row, one, approach, required, friction)
        _record_slip(one, ball)
        if k != i:
            one = out[min(n + 1, last)]
            _record_after(world, balls[k], log[n + 1], one, approach, required, friction)
            _record_slip(one, balls[k])
        n += 1 if k == i else 2
        while n < rows and log[n].kind in (IN_CLUSTER, WALL_IN_CLUSTER):
            # (its contacts were integrated again with all others of the event, whose time changes for it too)
            other, one = balls[log[n].ball], out[min(n, last)]
            again = log[n].kind == WALL_IN_CLUSTER or log[n].ball == i
            write_vector(one.v_before, vector(other.v if again else other.dv))
            write_vector(one.w_before, vector(other.w if again else other.dw))
            none = as_dual(math.nan)
            _record_after(world, other, log[n], one, none, none, none)
            _record_slip(one, other)
            n += 1
        if n < rows:
            _release(world, walls, balls, plain, i, k, ball.clock)
    return -1


# ----------------------------------------------------------------------------------------------------
# The passages of a run: what a pass over its log leaves, row by row, with derivatives.


Array = NDArray[np.float64]
PLACES = float_places(PASSAGES)


class Motion(NamedTuple):
    """Position, velocity and spin, in dual numbers."""

    x: list[Any]
    v: list[Any]
    w: list[Any]


class Passage(NamedTuple):
    """One row of the log: its time, and what could switch there."""

    time: Any
    ball: Motion
    before: Motion
    """As it comes to the event."""
    approach: Any
    """Rate at which the gap closes (m/s); None where nothing is met."""
    required: Any
    friction: float | None
    slip: Any


@holds_arrays
class StateSensitivity(NamedTuple):
    """Derivatives of the states of all balls at a fixed time, each (B, 3, p); at times (...), each (..., B, 3, p)."""

    position: Array
    """m per unit of the parameter."""
    velocity: Array
    spin: Array


def rows_at(log: NDArray[np.void], ball: int, times: Array) -> NDArray[np.int64]:
    """Return the rows of a log (T,) that a ball follows at times (T,)."""
    own = np.flatnonzero(log["ball"] == ball)
    found: NDArray[np.int64] = own[np.searchsorted(log["t"][own], times, side="right") - 1]
    return found


class Passages:
    """A sequence of passages, which are made when they are asked for."""

    def __init__(
        self, values: NDArray[np.void], derivatives: Callable[[], Array], at: Callable[[Array], Array]
    ) -> None:
        self.values = values
        """(M,) of PASSAGES."""
        self._derivatives = derivatives
        self._at = at

    @functools.cached_property
    def derivatives(self) -> Array:
        """(M, numbers of PASSAGES, p)."""
        return self._derivatives()

    def at(self, t: ArrayLike) -> StateSensitivity:
        """Return the derivatives of all states at a time, s, or at times (...)."""
        times = np.asarray(t, dtype=float)
        found = self._at(times.ravel())
        found = found.reshape(*times.shape, *found.shape[1:])
        return StateSensitivity(*(found[..., k : k + 3, :] for k in (0, 3, 6)))

    def __len__(self) -> int:
        """How many rows the log has."""
        return len(self.values)

    def __iter__(self) -> Iterator[Passage]:
        """All passages."""
        return (self[n] for n in range(len(self)))

    def __getitem__(self, n: int) -> Passage:
        """Return the passage of one row."""
        row, d = self.values[n], self.derivatives[n]

        def numbers(name: str) -> list[Any]:
            return [Dual(float(x), g) for x, g in zip(np.atleast_1d(row[name]), d[PLACES[name]], strict=True)]

        def number(name: str) -> Any:
            return None if np.isnan(row[name]) else numbers(name)[0]

        slip = None if np.isnan(row["slip"][0]) else numbers("slip")
        friction = None if np.isnan(row["friction"]) else float(row["friction"])
        motion = Motion(*(numbers(name) for name in Motion._fields))
        before = Motion(motion.x, numbers("v_before"), numbers("w_before"))
        return Passage(number("time"), motion, before, number("approach"), number("required"), friction, slip)
