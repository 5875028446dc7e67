"""Runs of a ball on a surface, from its start to its end: states at any time and the events."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from carom.billiards.rolling import spin_matrix, spin_vector
from carom.billiards.rolling_phases import Ended, RollingPhase, RollingSetting, fly, land, roll_on, size
from carom.billiards.surfaces import RollingSurface
from carom.bodies import Ball, Surface, holds_arrays
from carom.errors import CaromError, Fault, FaultList

__all__ = ["RollingEvent", "RollingRun", "RollingStates", "roll"]

Array = NDArray[np.float64]
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
    return _follow(setting, np.concatenate([x, w.ravel()]))


def _follow(setting: RollingSetting, state: Array) -> RollingRun:
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
