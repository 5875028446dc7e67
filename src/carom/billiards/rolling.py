"""A ball that rolls without slipping on a surface, leaves it, flies, and lands on it again.

With the ball's angular velocity as an antisymmetric matrix W (W y = omega x y), the
normal n from the contact point to the centre x, and the ball's radius r:

    v = r W n                                            no slip at the contact point                            (R1)
    T = W - (v n' - n v')/r                              the spin about the normal: T n = 0                       (R2)
    (1 + kappa) dv/dt = a + kappa r T dn/dt              along the surface, a the force's acceleration there      (R3)
    kappa r dW/dt = -(f n' - n f'),  f = dv/dt - a       the torque of the friction, f its acceleration           (R4)
    N/m = -v . dn/dt - g . n                             the surface's force; the ball leaves where it is 0       (R5)

(R3) is (R4) applied to n, with (R1) and (R2); Borisov, Mamaev & Kilin, Regul. Chaotic Dyn. 7, 201 (2002) and Cox, Feres & Zhao,
arXiv 2009.05890, have the same equations. SciPy's DOP853 integrates x and W.
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from carom.billiards.surfaces import RollingSurface, SmoothPiece
from carom.bodies import Ball, State, Surface, holds_arrays
from carom.errors import CaromError, Fault, FaultList
from carom.files import import_optional
from carom.laws.contact import impact

Array = NDArray[np.float64]


class Rolling(NamedTuple):
    """The state of a ball on a surface and the forces on it, from :meth:`RollingMotion.forces`."""

    normal: Array
    velocity: Array
    """m/s."""
    turn: Array
    """dn/dt (1/s)."""
    acceleration: Array
    """Of the centre, along the surface (m/s^2)."""
    friction: Array
    """Friction over the mass (m/s^2)."""
    pressure: float
    """The surface's force over the mass (m/s^2)."""


class RollingMotion:
    """Equations (R1) to (R5) for one ball on one smooth piece of a surface; the state is x and W in one vector."""

    def __init__(self, piece: SmoothPiece, ball: Ball, gravity: Array) -> None:
        self.piece, self.gravity = piece, gravity
        self.radius, self.kappa = float(ball.radius), float(ball.kappa)

    def forces(self, state: Array) -> Rolling:
        """Return the velocity, the acceleration and the forces of a state."""
        x, w = self.place_and_spin(state)
        n = self.piece.normal(x)
        # (R1)
        v = self.radius * (w @ n)
        turn = self.piece.turn(x, n, v)
        # (R2)
        products = v[:, None] * n
        about = w - (products - products.T) / self.radius
        along = self.gravity - n * (n @ self.gravity)
        # (R3)
        acceleration = (along + self.kappa * self.radius * (about @ turn)) / (1.0 + self.kappa)
        # (R5)
        pressure = float(-(v @ turn) - self.gravity @ n)
        return Rolling(n, v, turn, acceleration, acceleration - along, pressure)

    def rates(self, _: float, state: Array) -> Array:
        """Return the time derivative of a state."""
        now = self.forces(state)
        # (R4)
        turning = now.normal[:, None] * now.friction
        return np.concatenate([now.velocity, ((turning - turning.T) / (self.kappa * self.radius)).ravel()])

    def energy(self, state: Array) -> float:
        """Return the energy over the mass (m^2/s^2); heights count from the origin."""
        x, w = self.place_and_spin(state)
        v = self.radius * (w @ self.piece.normal(x))
        return float(0.5 * (v @ v) + 0.25 * self.kappa * self.radius**2 * np.sum(w * w) - self.gravity @ x)

    def corrected(self, state: Array, energy: float) -> Array:
        """Return a state with the centre at the ball's radius from the surface and with the given energy: no drift."""
        x, w = self.place_and_spin(state)
        x = x - (self.piece.distance(x) - self.radius) * self.piece.normal(x)
        state = np.concatenate([x, w.ravel()])
        has, wanted = self.energy(state) + self.gravity @ x, energy + self.gravity @ x
        return np.concatenate([x, (math.sqrt(wanted / has) * w).ravel()]) if has > 0 and wanted > 0 else state

    def place_and_spin(self, state: Array) -> tuple[Array, Array]:
        """Split a state into the place of the centre and the matrix of the spin."""
        return state[:3], state[3:12].reshape(3, 3)


def spin_matrix(spin: ArrayLike) -> Array:
    """Return the matrix of an angular velocity in space: W y = spin x y."""
    x, y, z = np.asarray(spin, dtype=float)
    return np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])


def spin_vector(matrix: Array) -> Array:
    """Return the angular velocity of a matrix, of shape (..., 3, 3)."""
    return np.stack([matrix[..., 2, 1], matrix[..., 0, 2], matrix[..., 1, 0]], axis=-1)


# ----------------------------------------------------------------------------------------------------
# The phases of a run on a surface: rolling until an event, flight until the ball touches, and the impact between them.


LOOKS = 6  # at each function of the state in a step of the integrator
SETTLES = 1e-6  # of its speed: a ball that comes off the surface more slowly stays on it
STILL = 1e-9  # of the speeds: a contact point that moves more slowly does not slip
SHORT = 0.02  # least step of a flight, in the time that the ball takes for its radius


@holds_arrays
@dataclass(frozen=True)
class RollingSetting:
    """All that stays the same in a run."""

    surface: RollingSurface
    ball: Ball
    gravity: Array
    duration: float
    friction: float
    held: bool
    contact: Surface
    accuracy: float

    @property
    def radius(self) -> float:
        """Of the ball (m)."""
        return float(self.ball.radius)

    @property
    def force(self) -> float:
        """Size of gravity (m/s^2)."""
        return size(self.gravity)

    def motion(self, piece: int) -> RollingMotion:
        """Return the equations of motion on a piece of the surface."""
        return RollingMotion(self.surface.pieces[piece], self.ball, self.gravity)


class RollingPhase(NamedTuple):
    """A stretch of time with one motion, and the event at its end."""

    rolls: bool
    motion: RollingMotion
    begin: float
    end: float
    state: Callable[[float], Array]
    """Place and spin matrix at a time, in one vector; in flight the velocity follows."""


class Ended(NamedTuple):
    """The end of a phase: the event, the state there and the piece of the surface that follows."""

    kind: str
    time: float
    state: Array
    piece: int
    phases: list[RollingPhase]


class _Watched(NamedTuple):
    """A function of the state that ends rolling where it becomes negative."""

    kind: str
    piece: int
    value: Callable[[Array], float]


def size(x: Array) -> float:
    """Return the length of a vector."""
    return math.sqrt(float(x @ x))


def roll_on(setting: RollingSetting, piece: int, begin: float, state: Array) -> Ended:
    """Roll on one piece until an event."""
    motion = setting.motion(piece)
    state = motion.corrected(state, motion.energy(state))
    watched = _watched(setting, motion, piece)
    values = [one.value(state) for one in watched]
    for one, value in zip(watched, values, strict=True):
        if value < 0 and one.kind in ("leaves", "slips"):
            return Ended(one.kind, begin, state, piece, [])
    phases: list[RollingPhase] = []
    energy, scale = motion.energy(state), setting.accuracy * _sizes_of_state(setting, motion, state)
    solver = import_optional("scipy.integrate", "rolling on a surface").DOP853(
        motion.rates, begin, state, setting.duration, rtol=setting.accuracy, atol=scale
    )
    while solver.status == "running":
        solver.step()
        if solver.status == "failed":
            raise CaromError(
                Fault("roll", "", "a motion that can be integrated", f"a step that vanishes at {solver.t:.9g} s")
            )
        inside = solver.dense_output()
        first, values = _first_event(watched, values, inside, solver.t_old, solver.t, begin)
        end = first[0] if first else solver.t
        phases.append(RollingPhase(True, motion, solver.t_old, end, inside))
        if first:
            return Ended(first[1].kind, end, motion.corrected(inside(end), energy), first[1].piece, phases)
        solver.y = motion.corrected(solver.y, energy)
        solver.f = motion.rates(solver.t, solver.y)
    return Ended("duration", solver.t, solver.y, piece, phases)


def _watched(setting: RollingSetting, motion: RollingMotion, piece: int) -> list[_Watched]:
    def grips(state: Array) -> float:
        now = motion.forces(state)
        return setting.friction * now.pressure - size(now.friction)

    def at_place(function: Callable[[Array], float]) -> Callable[[Array], float]:
        return lambda state: function(state[:3])

    found = [] if setting.held else [_Watched("leaves", piece, lambda state: motion.forces(state).pressure)]
    found += [_Watched("slips", piece, grips)] if math.isfinite(setting.friction) else []
    borders = setting.surface.borders[piece] if setting.surface.borders else ()
    found += [_Watched("crosses", follows, at_place(border)) for border, follows in borders]
    return found + [_Watched(name, piece, at_place(inside)) for name, inside in setting.surface.ends]


def _first_event(
    watched: list[_Watched],
    values: list[float],
    state: Callable[[float], Array],
    early: float,
    late: float,
    begin: float,
) -> tuple[tuple[float, _Watched] | None, list[float]]:
    """Return the first event of a step, and the values at its end; ``values`` are those at its begin."""
    times = np.linspace(early, late, LOOKS + 1)
    for before, after in itertools.pairwise(times):
        there = state(after)
        now = [one.value(there) for one in watched]
        found = [
            (float(before) if was == 0 else _root(lambda t, one=one: one.value(state(t)), before, after), one)  # type: ignore[misc]
            for one, was, is_now in zip(watched, values, now, strict=True)
            if was >= 0 > is_now
        ]
        values = now
        if later := [one for one in found if one[0] > begin]:
            return min(later, key=lambda one: one[0]), values
    return None, values


def _root(function: Callable[[float], float], early: float, late: float) -> float:
    return float(
        import_optional("scipy.optimize", "rolling on a surface").brentq(function, early, late, xtol=1e-300, rtol=1e-15)
    )


def _sizes_of_state(setting: RollingSetting, motion: RollingMotion, state: Array) -> Array:
    """Sizes of the components of a state: the radius, and the spin of a ball that has fallen by its radius."""
    x, w = motion.place_and_spin(state)
    fast = size(w.ravel()) + math.sqrt(setting.force / setting.radius)
    return np.concatenate([np.full(x.size, setting.radius), np.full(w.size, fast or 1.0)])


def flight(begin: float, state: Array, gravity: Array, t: float) -> Array:
    """Return place, spin matrix and velocity of a ball in flight."""
    s, x, v = t - begin, state[:3], state[-3:]
    return np.concatenate([x + s * v + (0.5 * s * s) * gravity, state[3:-3], v + s * gravity])


def fly(setting: RollingSetting, begin: float, state: Array) -> Ended:
    """Fly until the ball touches the surface, in steps within which it cannot reach it: the gap changes by no more than the way."""
    surface, force, duration = setting.surface, setting.force, setting.duration
    at = partial(flight, begin, state, setting.gravity)

    def gap(t: float) -> float:
        return surface.distance(at(t)[:3]) - setting.radius

    def opening(t: float) -> float:
        now = at(t)
        return float(now[-3:] @ surface.normal(now[:3]))

    def ended(kind: str, t: float) -> Ended:
        piece = surface.at(at(t)[:3])
        return Ended(kind, t, at(t), piece, [RollingPhase(False, setting.motion(piece), begin, t, at)])

    short = SHORT * setting.radius / (size(state[-3:]) + math.sqrt(force * setting.radius))
    t, room = begin, max(gap(begin), 0.0)
    while t < duration:
        now = at(t)
        speed = size(now[-3:])
        free = min([room, *(inside(now[:3]) for _, inside in surface.ends)])
        # the time in which the ball covers ``free``, with all of gravity along its way
        step = 2.0 * free / (speed + math.sqrt(speed * speed + 2.0 * force * free)) if free > 0 else 0.0
        late = min(t + max(step, short), duration)
        after = gap(late)
        if after > 0 and opening(t) < 0 < opening(late):  # nearest in between: it may have touched
            nearest = _root(opening, t, late)
            late, after = (nearest, gap(nearest)) if gap(nearest) < 0 else (late, after)
        if after < 0 and (gap(t) > 0 or opening(late) < 0):
            # (a ball that has just left is at a gap of 0 give or take rounding: its gap opens first, if only for a moment)
            early = next((float(s) for s in np.linspace(t, late, LOOKS + 1)[:-1] if gap(s) > 0), late)
            return ended("lands", _root(gap, early, late) if early < late else late)
        for name, inside in surface.ends:
            if inside(at(late)[:3]) < 0:
                left = partial(_at_place, at, inside)
                return ended(name, _root(left, t, late) if left(t) > 0 else t)
        t, room = late, max(after, 0.0)
    return ended("duration", duration)


def _at_place(state: Callable[[float], Array], function: Callable[[Array], float], t: float) -> float:
    return function(state(t)[:3])


def land(setting: RollingSetting, piece: int, state: Array) -> tuple[bool, bool, Array]:
    """Apply the contact law; return whether the ball stays on the surface, whether it slides there, and its state."""
    x, v, w = state[:3], state[-3:], spin_vector(state[3:-3].reshape(3, 3))
    n = setting.surface.pieces[piece].normal(x)
    speed, law = size(v), setting.contact
    if -(v @ n) * float(law.restitution) <= SETTLES * speed:
        law = Surface(0.0, law.friction, law.tangential_restitution)
    after = impact(setting.ball, State(v, w), tuple(n), law).after if v @ n < 0 else State(v, w)
    v, w = np.array(after.velocity), np.array(after.spin)
    if v @ n > SETTLES * speed:
        return False, False, np.concatenate([x, spin_matrix(w).ravel(), v])
    v = v - n * (v @ n)
    slips = size(v - setting.radius * np.cross(w, n)) > STILL * (speed + setting.radius * size(w))
    w = w if slips else n * (w @ n) + np.cross(n, v) / setting.radius
    return True, slips, np.concatenate([x, spin_matrix(w).ravel(), v])


# ----------------------------------------------------------------------------------------------------
# Runs of a ball on a surface, from its start to its end: states at any time and the events.


GRAVITY = 9.81
STICKS = Surface(restitution=0.0)
NEAR = 1e-9  # of the radius: a ball touches; of the speed: a velocity is along the surface
MOST_EVENTS = 10_000


@holds_arrays
class RollingEvent(NamedTuple):
    """An event of a run."""

    kind: str
    """"leaves", "lands", "crosses" (a border between pieces); the last one is :attr:`RollingRun.end`."""
    time: float
    """s."""
    place: Array
    """Of the centre (m)."""
    velocity: Array
    """After the event (m/s)."""


@holds_arrays
class RollingStates(NamedTuple):
    """States at several times; forces are divided by the mass."""

    time: Array
    place: Array
    velocity: Array
    spin: Array
    """Matrices W, (N, d, d): in space :attr:`angular_velocity` has them as vectors."""
    pressure: Array
    """Force of the surface (m/s^2), 0 in flight."""
    friction: Array
    """Friction that rolling needs (m/s^2), 0 in flight."""
    rolls: NDArray[np.bool_]

    @property
    def angular_velocity(self) -> Array:
        """Return the spins as vectors in space (N, 3), rad/s."""
        return spin_vector(self.spin)


@dataclass(frozen=True, eq=False)
class RollingRun:
    """A ball on a surface, from its start to the end of its run.

    Examples
    --------
    In a vertical pipe a ball that rolls does not fall: its height swings sqrt(2/7) times a turn.

    >>> import math
    >>> import carom
    >>> from carom import billiards
    >>> pipe, ball = billiards.surfaces.pipe(0.1), carom.Ball(0.02, 0.1)
    >>> run = billiards.roll(pipe, (0.08, 0, 0), (0, 3, 0), ball=ball, duration=math.tau * 0.08 / 3 / math.sqrt(2 / 7))
    >>> swing = run.at([0, run.duration / 2, run.duration]).place[:, 2]
    >>> run.end, swing.round(6).tolist()
    ('duration', [0.0, -0.03488, 0.0])
    """

    setting: RollingSetting
    events: tuple[RollingEvent, ...]
    phases: tuple[RollingPhase, ...]

    @property
    def end(self) -> str:
        """Why the run ended: "duration", "slips", "slides" after a landing, or an end of the surface."""
        return self.events[-1].kind

    @property
    def duration(self) -> float:
        """Time of the last event (s)."""
        return self.events[-1].time

    def at(self, times: ArrayLike) -> RollingStates:
        """Return places, velocities, spins and forces at times in s."""
        asked = np.atleast_1d(np.asarray(times, dtype=float))
        if not (np.isfinite(asked).all() and (asked >= 0).all() and (asked <= self.duration).all()):
            raise CaromError(Fault("at", "times", f"times from 0 to {self.duration:.9g} s", f"{times!r}"))
        ends = np.array([phase.end for phase in self.phases])
        places = np.minimum(np.searchsorted(ends, asked), len(ends) - 1)
        rows = [_state_of(self.phases[k], t) for t, k in zip(asked, places, strict=True)]
        return RollingStates(asked, *(np.array(column) for column in zip(*rows, strict=True)))


def _state_of(phase: RollingPhase, t: float) -> tuple[Array, Array, Array, float, float, bool]:
    state = phase.state(t)
    x, w = phase.motion.place_and_spin(state)
    if not phase.rolls:
        return x, state[-3:], w, 0.0, 0.0, False
    now = phase.motion.forces(state)
    return x, now.velocity, w, now.pressure, size(now.friction), True


def roll(
    surface: RollingSurface,
    place: ArrayLike,
    velocity: ArrayLike,
    spin: float = 0.0,
    *,
    ball: Ball | None = None,
    gravity: ArrayLike | None = None,
    duration: float = 10.0,
    friction: float = math.inf,
    held: bool = False,
    contact: Surface = STICKS,
    accuracy: float = 3e-14,
) -> RollingRun:
    """Follow a ball that rolls without slipping on a surface, leaves it, flies and lands.

    Source: equations (R1) to (R5) of the module `carom.billiards.rolling`.

    Parameters
    ----------
    surface : RollingSurface
        From `carom.billiards.surfaces`, or your own.
    place : array (3,)
        Of the ball's centre (m): it touches the surface.
    velocity : array (3,)
        Of the centre (m/s), along the surface.
    spin : float
        About the normal (rad/s).
    ball : Ball, optional
        Only its radius and kappa count; the default of `Ball` otherwise.
    gravity : array (3,), optional
        m/s^2; 9.81 downwards along the last axis by default.
    duration : float
        s, > 0.
    friction : float
        Coefficient of friction: the run ends with "slips" where rolling would need more. The default never slips.
    held : bool
        Whether the surface may pull: a ball that is held never leaves.
    contact : Surface
        For impacts after a flight, by the contact law; the default sticks.
    accuracy : float
        Relative error of a step of the integrator, from 3e-14 to 1e-3.

    Returns
    -------
    RollingRun
        States at any time, and the events.

    Raises
    ------
    CaromError
        One line per problem: a ball that does not touch the surface, a velocity that is not along it.
    """
    faults = FaultList("roll")
    pull = _vector(faults, "gravity", (0.0, 0.0, -GRAVITY) if gravity is None else gravity)
    setting = RollingSetting(surface, ball or Ball(), pull, duration, friction, held, contact, accuracy)
    x = _vector(faults, "place", place)
    v = _vector(faults, "velocity", velocity)
    _check(faults, setting)
    if not any(map(faults.has, ("gravity", "place", "velocity"))):
        _check_start(faults, setting, x, v)
    (about,) = _vector(faults, "spin", [spin], 1)
    faults.raise_if_any()

    n = surface.normal(x)
    v = v - n * (v @ n)
    # (R1) and (R2)
    w = (np.outer(v, n) - np.outer(n, v)) / setting.radius + spin_matrix(about * n)
    return _integrate(setting, np.concatenate([x, w.ravel()]))


def _integrate(setting: RollingSetting, state: Array) -> RollingRun:
    """Follow the ball through rolling and flights until an event ends the run."""
    t, rolls, piece = 0.0, True, setting.surface.at(state[:3])
    events: list[RollingEvent] = []
    phases: list[RollingPhase] = []

    def note(kind: str, ended: Ended, v: Array) -> None:
        events.append(RollingEvent(kind, ended.time, ended.state[:3].copy(), v.copy()))

    while len(events) < MOST_EVENTS:
        ended = roll_on(setting, piece, t, state) if rolls else fly(setting, t, state)
        t, state, piece = ended.time, ended.state, ended.piece
        phases += ended.phases
        v = setting.motion(piece).forces(state).velocity if rolls else state[-3:]
        if ended.kind == "lands":
            rolls, slides, state = land(setting, piece, state)
            note("lands", ended, state[-3:])
            if slides:
                note("slides", ended, state[-3:])
                return RollingRun(setting, tuple(events), tuple(phases))
            state = state[:-3] if rolls else state
            continue
        note(ended.kind, ended, v)
        if ended.kind == "leaves":
            rolls, state = False, np.concatenate([state, v])
        elif ended.kind != "crosses":
            return RollingRun(setting, tuple(events), tuple(phases))
    raise CaromError(
        Fault("roll", "", f"fewer than {MOST_EVENTS} events", f"as many in {t:.6g} s", "give a shorter duration")
    )


def _check(faults: FaultList, setting: RollingSetting) -> None:
    if not 0 < setting.duration <= 1e9:
        faults.add("duration", "a time > 0 s and at most 1e9 s", repr(setting.duration))
    if not setting.friction > 0:
        faults.add("friction", "a number > 0", repr(setting.friction))
    if not 3e-14 <= setting.accuracy <= 1e-3:
        faults.add("accuracy", "a number from 3e-14 to 1e-3", repr(setting.accuracy))


def _check_start(faults: FaultList, setting: RollingSetting, x: Array, v: Array) -> None:
    distance, r = setting.surface.distance(x), setting.radius
    if not abs(distance - r) <= NEAR * r:
        faults.add("place", f"a centre at the ball's radius, {r:g} m, from the surface", f"{distance:.9g} m")
    elif abs(across := float(v @ setting.surface.normal(x))) > NEAR * (size(v) + math.sqrt(setting.force * r)):
        faults.add("velocity", "a velocity along the surface", f"{across:.6g} m/s along its normal")


def _vector(faults: FaultList, name: str, value: ArrayLike, count: int = 3) -> Array:
    try:
        array = np.array(value, dtype=float)
    except (TypeError, ValueError):
        array = np.empty(0)
    if array.shape == (count,) and np.isfinite(array).all():
        return array
    faults.add(name, f"{count} finite numbers", repr(value))
    return np.zeros(count)
