"""The phases of a run on a surface: rolling until an event, flight until the ball touches, and the impact between them."""

from __future__ import annotations

import itertools
import math
from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from carom.billiards.rolling import RollingMotion, spin_matrix, spin_vector
from carom.billiards.surfaces import RollingSurface
from carom.bodies import Ball, State, Surface, holds_arrays
from carom.errors import CaromError, Fault
from carom.files import import_optional
from carom.laws.contact import impact

__all__ = ["RollingPhase", "RollingSetting", "fly", "land", "roll_on"]

Array = NDArray[np.float64]
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
