"""How a ball of a run moves: the numbers of its phase, and its state a time after its clock."""

from __future__ import annotations

import contextlib
import functools
import math
from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import NDArray

from carom.core.contact import slip_velocity
from carom.core.jit.compile import is_cached, njit
from carom.core.jit.kernel import Vec, as_objects, dot, hot_kernel, kernel, vector, without_slopes, write_back
from carom.core.jit.threads import sliced
from carom.core.motion.air import (
    GOES_ON,
    IN_AIR,
    SPIN_ENDS,
    acceleration_in_piece,
    begin_piece,
    bounces_in_air,
    enter_segments,
    error_in_piece,
    hop_in_air,
    phase_in_air,
    piece_rates,
    place_in_piece,
    spin_in_piece,
    turn_in_flight,
)
from carom.core.motion.phases import (
    BOUNCING,
    FLIGHT,
    HELD,
    LAST_HOP,
    PIVOTING,
    REST,
    ROLLING,
    SLIDING,
    UP,
    accelerations,
    acts,
    advance,
    advance_decaying,
    bounces,
    decay_integrals,
    decays,
    grounded,
)
from carom.core.motion.rotation import (
    NODE,
    STEP,
    Quaternion,
    compose,
    magnus_step,
    orientation_after,
    orientation_after_bounces,
    orientation_after_decay,
    rotation,
)
from carom.core.motion.tilt import (
    Lean,
    advance_on_slope,
    along_wall,
    course_error,
    is_tilted,
    lean_of,
    phase_on_slope,
    slope_acceleration,
)

STILL, NEAR = 1e-12, 1e-5  # of the radius: a ball that moved by less is where it was, and one that is slow, on a slope
ELASTIC_HEIGHT = 1e-6  # of the radius: bounces under a lasting force that are lower are elastic (resting_contact)


@hot_kernel
def write_vector(row: Any, value: Vec) -> None:
    """Write three numbers into an array."""
    row[0], row[1], row[2] = value[0], value[1], value[2]


@hot_kernel
def lean(ball: Any) -> Lean:
    """Return how a tilted floor turns a ball downhill (carom.core.motion.tilt)."""
    return (ball.lean[0], ball.lean[1], ball.lean[2], ball.lean[3])


@hot_kernel
def is_in_air(ball: Any) -> bool:
    """Return whether a ball is on a path that the air bends (carom.core.motion.air)."""
    return bool(ball.decays == IN_AIR)


@hot_kernel
def is_turned_downhill(ball: Any) -> bool:
    """Return whether a ball is on a path that is no parabola, as a tilted floor turns it."""
    return bool(ball.decays != 0 and ball.lean[3] > 0)


@kernel
def state_at(ball: Any, s: float) -> tuple[Vec, Vec, Vec]:
    """Return position, velocity and spin of a ball a time s after its clock, in its present phase."""
    if is_in_air(ball):
        return place_in_piece(ball, s)
    if ball.decays != 0:
        x, v, w = advance_decaying(
            vector(ball.x), vector(ball.v), vector(ball.w), vector(ball.acc), vector(ball.turn),
            ball.fade, ball.spin_fade, ball.spin_gain, s,
        )  # fmt: skip
        if is_turned_downhill(ball):
            z = w[2]
            x, v, w = advance_on_slope(
                ball.phase, vector(ball.x), vector(ball.v), vector(ball.w), ball.radius, ball.kappa, lean(ball), s
            )
            w = (w[0], w[1], z)
        return x, v, w
    return advance(vector(ball.x), vector(ball.v), vector(ball.w), vector(ball.acc), vector(ball.turn), s)


@kernel
def state_after(world: Any, ball: Any, s: float) -> tuple[Vec, Vec, Vec]:
    """Return position, velocity and spin of a ball a time s after its clock, also of one that bounces infinitely often."""
    if ball.phase == BOUNCING and air_acts(ball):
        x, v, w, _time = bounces_in_air(world, ball, s)
    elif ball.phase == BOUNCING:
        x, v, w, _time = bounces(
            vector(ball.x), vector(ball.v), vector(ball.w), ball.radius, ball.kappa,
            world.g, world.floor_form, vector(world.floor_p), world.floor_mu, world.floor_beta, s,
        )  # fmt: skip
    else:
        x, v, w = state_at(ball, s)
    return x, v, w


@kernel
def set_to_row(ball: Any, row: Any) -> None:
    """Bring a ball into the state of a row of a log."""
    write_vector(ball.x, vector(row.x))
    write_vector(ball.v, vector(row.v))
    write_vector(ball.w, vector(row.w))
    ball.phase, ball.borne_by = row.phase, row.borne_by
    for k in range(4):
        ball.borne[k] = row.borne[k]


@kernel
def is_slow(world: Any, v: Vec, w: Vec, a: float) -> bool:
    """Return whether a slope gives a ball such a velocity and spin between bounces too low to see."""
    pull = math.sqrt(world.force[0] * world.force[0] + world.force[1] * world.force[1])
    return bool(dot(v, v) + a * a * dot(w, w) <= 8 * ELASTIC_HEIGHT * a * pull)


@kernel
def move_by(world: Any, ball: Any, s: float, t: float) -> None:
    """Advance a ball by s, to the time t."""
    y, v, whole, begun = vector(ball.x), vector(ball.v), s, ball.begun
    while goes_on_in_air(ball) and without_slopes(s) > without_slopes(ball.lasts):
        begin_next_piece(world, ball)
        s = whole - (ball.begun - begun)
    x, v1, w = state_after(world, ball, s)
    write_vector(ball.x, x)
    write_vector(ball.v, v1)
    write_vector(ball.w, w)
    stays, count = whole * math.sqrt(dot(v, v)) <= STILL * ball.radius, 1
    if is_tilted(vector(world.force)):
        d = (x[0] - y[0], x[1] - y[1], x[2] - y[2])
        stays = dot(d, d) <= NEAR * NEAR * ball.radius * ball.radius and is_slow(world, v, w, ball.radius)
        count = 100 if whole == 0 and dot(v, v) + dot(w, w) == 0 else 1
    ball.repeats = ball.repeats + count if stays else 0
    ball.clock = t


@kernel
def accelerations_of(world: Any, ball: Any) -> tuple[Vec, Vec, float]:
    """Return acceleration, angular acceleration and duration of the phase that a ball is in."""
    if ball.borne_by != 0:
        _phase, _v, _w, acc, turn, lasts = motion_along_wall(world, ball)
        return acc, turn, lasts
    if feels_air(world, ball):
        enter_segments(world, ball, vector(ball.v), vector(ball.w), True)
        acc, turn = piece_rates(world, ball, vector(ball.v), vector(ball.w), -1.0)
        return acc, turn, math.inf
    acc, turn, lasts = accelerations(
        ball.phase, vector(ball.v), vector(ball.w), ball.radius, ball.kappa,
        vector(world.force), world.g * (1 - ball.buoyancy), world.floor_mu, world.resistance, world.spin_friction,
        world.rolling_drag, world.spin_damping, world.spin_drag,
    )  # fmt: skip
    if _is_on_slope(world, ball):
        z = turn[2]
        acc, turn, lasts = slope_acceleration(
            ball.phase, vector(ball.v), vector(ball.w), ball.radius, ball.kappa,
            vector(world.force), world.g, world.floor_mu, world.resistance,
        )  # fmt: skip
        turn = (turn[0], turn[1], z)
    return acc, turn, lasts


@kernel
def motion_along_wall(world: Any, ball: Any) -> tuple[int, Vec, Vec, Vec, Vec, float]:
    """Return :func:`along_wall` of a ball that a wall bears."""
    n = (ball.borne[0], ball.borne[1], ball.borne[2])
    return along_wall(
        vector(ball.v), vector(ball.w), ball.radius, ball.kappa, vector(world.force), world.g,
        world.floor_mu, world.resistance, world.spin_friction, n, ball.borne[3],
    )  # fmt: skip


@kernel
def _is_on_slope(world: Any, ball: Any) -> bool:
    """Return whether a ball slides or rolls on a tilted floor (one that is infinitely rough ends its slip at once)."""
    moves = ball.borne_by == 0 and (ball.phase == ROLLING or (ball.phase == SLIDING and world.floor_mu < math.inf))
    return bool(moves and world.floor != 0 and is_tilted(vector(world.force)))


@kernel
def is_on_floor(world: Any, ball: Any) -> bool:
    """Return whether a ball is on the floor: by its phase, or, where nothing presses it, by its position and velocity."""
    if ball.phase == FLIGHT:
        return bool(world.floor != 0 and not world.g > 0 and ball.v[2] == 0 and ball.x[2] == ball.radius)
    return bool(SLIDING <= ball.phase <= REST)


@kernel
def on_floor_with(world: Any, ball: Any, v: Vec, w: Vec) -> tuple[int, Vec, Vec]:
    """Return the phase of a ball that is on the floor with velocity v and spin w, and both without rounding errors."""
    phase, v, w = grounded(v, w, ball.radius, ball.kappa, world.g, world.floor_mu)
    return phase_on_floor(world, ball, phase, v, w), v, w


@kernel
def set_on_floor(world: Any, ball: Any, v: Vec, w: Vec) -> None:
    """Let a ball go on with velocity v and spin w on the floor, which alone bears it."""
    ball.phase, v, w = on_floor_with(world, ball, v, w)
    ball.borne_by = 0
    write_vector(ball.v, v)
    write_vector(ball.w, w)


@kernel
def phase_on_floor(world: Any, ball: Any, phase: int, v: Vec, w: Vec) -> int:
    """Return the phase of a ball, with velocity v and spin w, that would be in ``phase`` on a level floor without air."""
    if air_acts(ball) and SLIDING <= phase <= REST:
        return phase_in_air(world, ball, phase, v, w)
    if is_tilted(vector(world.force)) and SLIDING <= phase <= REST:
        return phase_on_slope(phase, vector(world.force), ball.kappa, world.g, world.floor_mu, world.resistance)
    return phase


@kernel
def begin_phase(world: Any, ball: Any) -> None:
    """Set the accelerations and the duration of the phase that a ball has entered."""
    acc, turn, lasts = accelerations_of(world, ball)
    write_vector(ball.acc, acc)
    write_vector(ball.turn, turn)
    ball.decays = 0
    if acts(world.rolling_drag) or acts(world.spin_damping) or acts(world.spin_drag):
        ball.decays = 1
        ball.fade, ball.spin_fade, ball.spin_gain = decays(
            ball.phase, vector(ball.v), vector(ball.w), acc,
            world.g, world.rolling_drag, world.spin_damping, world.spin_drag,
        )  # fmt: skip
    if _is_on_slope(world, ball):
        ball.decays = 1
        found = lean_of(
            ball.phase, vector(ball.v), vector(ball.w), ball.radius, ball.kappa,
            vector(world.force), world.g, world.floor_mu, world.resistance,
        )  # fmt: skip
        ball.lean[0], ball.lean[1], ball.lean[2], ball.lean[3] = found
    elif ball.decays != 0:
        ball.lean[3] = 0 * ball.radius
    if feels_air(world, ball):
        ball.decays, ball.fade, ball.lean[3] = IN_AIR, 0 * ball.radius, 0 * ball.radius
        ball.since, ball.begun = ball.clock, 0.0
        begin_piece(world, ball, 0.0, _time_to_floor(world, ball, acc))
    elif ball.phase != BOUNCING:  # whose end was set when its bounces were found to be clear of everything else
        ball.lasts = lasts


@kernel
def feels_air(world: Any, ball: Any) -> bool:
    """Return whether a ball in its phase moves as air has it: one that spins on the spot only does in wind."""
    blows = world.wind[0] != 0 or world.wind[1] != 0 or world.wind[2] != 0
    slides = ball.phase == SLIDING and world.floor_mu < math.inf  # (an infinitely rough floor ends the slip at once)
    moves = ball.phase in (FLIGHT, ROLLING) or slides or (blows and ball.phase == PIVOTING)
    return bool(moves and air_acts(ball))


@kernel
def air_acts(ball: Any) -> bool:
    """Return whether air acts on a ball that moves in it."""
    return bool(ball.air > 0 or ball.spin_decay > 0 or ball.buoyancy != 0)


@hot_kernel
def goes_on_in_air(ball: Any) -> bool:
    """Return whether a ball goes on with another piece after that on which it is."""
    return bool(ball.decays == IN_AIR and ball.ends in (GOES_ON, SPIN_ENDS))


@kernel
def _time_to_floor(world: Any, ball: Any, acc: Vec) -> float:
    """Return about how long a ball that will meet the floor flies: its piece need not be much longer."""
    z, v, g = without_slopes(ball.x[2] - ball.radius), without_slopes(ball.v[2]), without_slopes(-acc[2])
    square = v * v + 2 * g * z
    if world.floor == 0 or not g > 0 or not square > 0:
        return math.inf
    t = (v + math.sqrt(square)) / g
    return float(1.1 * t if t > 0 else math.inf)


@kernel
def begin_next_piece(world: Any, ball: Any) -> None:
    """Move a ball in air to the end of its piece, and begin the next one; its clock and its count of events stay."""
    lasts = without_slopes(ball.lasts)
    ball.begun = ball.begun + lasts
    x, v, w = place_in_piece(ball, lasts)
    if ball.ends == SPIN_ENDS:
        w = (w[0], w[1], 0 * x[0])
        for k in range(2, 9):
            ball.work[7 * k + 5] = 0 * x[0]
    write_vector(ball.x, x)
    write_vector(ball.v, v)
    write_vector(ball.w, w)
    begin_piece(world, ball, without_slopes(ball.guess), _time_to_floor(world, ball, vector(ball.acc)))


@kernel
def to_last_piece(world: Any, ball: Any, s: float) -> None:
    """Bring a ball in air, and its clock, to the beginning of the piece that ends its phase, which it does not a time s later."""
    while goes_on_in_air(ball) and s > 0:
        lasts = without_slopes(ball.lasts)
        ball.clock, s = ball.clock + lasts, s - lasts
        begin_next_piece(world, ball)


@hot_kernel
def slows_down(ball: Any) -> bool:
    """Return whether the acceleration of a ball's centre decays: it rolls on a straight line."""
    return bool(ball.decays != 0 and ball.fade > 0)


@hot_kernel
def has_no_parabola(ball: Any) -> bool:
    """Return whether the acceleration of a ball's centre changes."""
    return bool(ball.decays == IN_AIR or (ball.decays != 0 and (ball.fade > 0 or ball.lean[3] > 0)))


@kernel
def motion_in(ball: Any, s: float) -> tuple[Vec, Vec, Vec]:
    """Return position, velocity and acceleration of a ball a time s after its clock."""
    x, v, w = state_at(ball, s)
    return x, v, acceleration_in(ball, v, w, s)


@kernel
def acceleration_in(ball: Any, v: Vec, w: Vec, s: float) -> Vec:
    """Return the acceleration of a ball a time s after its clock, where it moves with v and w."""
    if is_in_air(ball):
        return acceleration_in_piece(ball, s)
    if is_turned_downhill(ball):
        fx, fy, m, q = lean(ball)
        _un, u = slip_velocity(v, w, UP, ball.radius)
        x, y = (v[0], v[1]) if ball.phase == ROLLING else (u[0], u[1])
        size = math.sqrt(x * x + y * y)
        c = q * m / size if size > 0 else 0 * m
        return (fx - c * x, fy - c * y, 0 * c)
    c = decay_integrals(ball.fade, s)[0] if slows_down(ball) else 1 + 0 * s
    return (c * ball.acc[0], c * ball.acc[1], c * ball.acc[2])


@hot_kernel
def error_ahead(ball: Any, s: float, ahead: float) -> float:
    """Return how far from its present parabola a floor or the air can turn a ball, a time s after its clock, within ``ahead``."""
    if is_in_air(ball):
        return error_in_piece(ball, ahead)
    if not is_turned_downhill(ball):
        return 0 * ahead
    _x, v, w = state_at(ball, s)
    return error_from(ball, v, w, s, ahead)


@kernel
def error_from(ball: Any, v: Vec, w: Vec, s: float, ahead: float) -> float:
    """Return the same of a ball on a path that is no parabola, which moves with v and w at that time."""
    if is_in_air(ball):
        return error_in_piece(ball, ahead)
    return course_error(ball.phase, v, w, ball.radius, lean(ball), ahead)


# ----------------------------------------------------------------------------------------------------
# Compute states between events from the closed forms of carom.core.motion, for many times at once.


Array = NDArray[np.float64]
# Below so many rows Python is quicker than loading the compiled loop; and than compiling it.
FEW, FEW_BEFORE_COMPILING = 200, 20_000


def state_rows(worlds: Any, balls: Any, after: Any) -> None:
    """Advance every ball, each by its own time."""
    for i in range(balls.shape[0]):
        begin_phase(worlds[0], balls[i])
        move_by(worlds[0], balls[i], after[i], after[i])


@kernel
def _turned_in_piece(ball: Any, q: Quaternion, s: float) -> Quaternion:
    """Return the orientation a time s after the beginning of a piece in air, where it was q."""
    if ball.phase == FLIGHT:  # the axis of the spin stays
        return compose(rotation(turn_in_flight(ball, s)), q)
    w = vector(ball.w)
    steps = 1 + int(s * math.sqrt(dot(w, w)) / STEP)
    h = s / steps
    for k in range(steps):
        t = (k + 1 / 2) * h
        q = magnus_step(
            q, spin_in_piece(ball, t - NODE * h), spin_in_piece(ball, t), spin_in_piece(ball, t + NODE * h), h
        )
    return q


@kernel
def _turned_in_bounces(world: Any, ball: Any, q: Quaternion, s: float) -> Quaternion:
    """Return the orientation a time s after bounces too low to see have begun in air, where it was q."""
    first = ball.v[2]
    while s > 0 and ball.v[2] > LAST_HOP * first:
        w = vector(ball.w)
        hop, _acc, _jerk, turn, _rate = hop_in_air(world, ball, vector(ball.v), w)
        h = min(hop, s)
        half = h * h / 2
        q = compose(rotation((w[0] * h + turn[0] * half, w[1] * h + turn[1] * half, w[2] * h + turn[2] * half)), q)
        x, v, w, _time = bounces_in_air(world, ball, h)
        write_vector(ball.x, x)
        write_vector(ball.v, v)
        write_vector(ball.w, w)
        s = s - hop
    return q


def _turn_rows(worlds: Any, balls: Any, after: Any, q: Any) -> None:
    """Rotate every orientation (N, 4) by the rotation of its ball in its time."""
    world = worlds[0]
    for i in range(balls.shape[0]):
        ball = balls[i]
        v, w = vector(ball.v), vector(ball.w)
        old = (q[i, 0], q[i, 1], q[i, 2], q[i, 3])
        if ball.phase == BOUNCING and air_acts(ball):
            new = _turned_in_bounces(world, ball, old, after[i])
        elif ball.phase == BOUNCING:
            new = orientation_after_bounces(
                old, v, w, ball.radius, ball.kappa, world.g, world.floor_form, vector(world.floor_p),
                world.floor_mu, world.floor_beta, after[i],
            )  # fmt: skip
        else:
            begin_phase(world, ball)
            turn = vector(ball.turn)
            if is_in_air(ball):
                s = after[i]
                while s > ball.lasts and goes_on_in_air(ball):
                    old = _turned_in_piece(ball, old, ball.lasts)
                    s = s - ball.lasts
                    begin_next_piece(world, ball)
                new = _turned_in_piece(ball, old, s)
            elif ball.decays == 0:
                new = orientation_after(old, w, turn, after[i])
            else:
                slope = (ball.phase, v, ball.radius, ball.kappa, lean(ball))
                new = orientation_after_decay(old, w, turn, ball.fade, ball.spin_fade, ball.spin_gain, slope, after[i])
        q[i, 0], q[i, 1], q[i, 2], q[i, 3] = new


@functools.cache
def _compiled(loop: Callable[..., None]) -> Callable[..., None]:
    return njit(loop)


def _run(loop: Callable[..., None], world: Any, balls: Any, after: Array, *q: Array) -> None:
    count = balls.shape[0]
    if count < FEW or (count < FEW_BEFORE_COMPILING and not is_cached(loop)):
        objects, turned_q = as_objects(balls), [np.array(one) for one in q]
        # (what Python refuses, such as a division by zero, compiled code has a number for)
        with contextlib.suppress(ArithmeticError, ValueError), np.errstate(all="ignore"):
            loop(as_objects(world), objects, after.tolist(), *turned_q)
            write_back(objects, balls)
            for one, new in zip(q, turned_q, strict=True):
                one[:] = new
            return
    sliced(_compiled(loop), count)(world, balls, after, *q)


def _rows(balls: Any, which: Any, log: Any) -> Any:
    """Return the balls in the states of a log's rows."""
    rows = balls[which].copy()
    for field in ("x", "v", "w", "phase", "borne_by", "borne"):
        rows[field] = log[field]
    rows["clock"] = 0
    return rows


def states(world: Any, balls: Any, log: Any, after: Array) -> tuple[Array, Array, Array, Any]:
    """Return position, velocity, spin (N, 3) and phase (N,), each a time ``after`` (N,) its row of the log.

    NaN where the ball is no longer followed.
    """
    rows = _rows(balls, log["ball"], log)
    gone = (rows["phase"] >= HELD) & (after > 0)
    _run(state_rows, world, rows, np.where(gone, 0.0, after))
    for field in ("x", "v", "w"):
        rows[field][after == 0] = log[field][after == 0]  # (the path on a slope is exact to rounding there)
        rows[field][gone] = np.nan
    return rows["x"], rows["v"], rows["w"], rows["phase"]


def orientations(world: Any, balls: Any, log: Any, after: Array, q: Array) -> Array:
    """Return unit quaternions (N, 4) a time ``after`` (N,) each row of the log, at which the orientation was q (N, 4)."""
    rows = _rows(balls, log["ball"], log)
    q = np.array(q)
    _run(_turn_rows, world, rows, np.where(rows["phase"] >= HELD, 0.0, after), q)
    return q
