"""A ball, the surface that it touches, and its state of motion.

:class:`Ball` has a radius a, a mass m and a moment of inertia I = kappa m a^2; :class:`Surface` restitution, friction and
tangential restitution; :class:`State` velocity and spin. All are validated when made, and broadcast as NumPy arrays.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, fields
from typing import Any, Literal, TypeVar

import numpy as np
from numpy.typing import ArrayLike, NDArray

from carom.core.units import in_si, unlikely_density
from carom.errors import (
    MAX_MAGNITUDE,
    CaromError,
    FaultList,
    broadcast_shape,
    checked_number,
    first_bad_index,
    float_array,
    require_type,
)

Array = NDArray[np.float64]
Record = TypeVar("Record")
Numbers = float | Array  # one number, or an array of them
Inertia = Literal["solid", "hollow"]
# kappa = I/(m a^2)
INERTIAS = {"solid": 2 / 5, "hollow": 2 / 3}
DISC_INERTIAS = {"disc": 1 / 2, "ring": 1.0}


def holds_arrays(record: type[Record]) -> type[Record]:
    """Let two records of a class be equal where all they hold is: of arrays all numbers (NumPy's ``==`` has no truth value)."""

    def same(one: Any, other: Any) -> Any:
        if type(one) is not type(other):
            return NotImplemented
        names = getattr(one, "_fields", None) or [field.name for field in fields(one) if field.compare]
        return all(_equal(getattr(one, name), getattr(other, name)) for name in names)

    record.__eq__ = same  # type: ignore[method-assign]
    return record


def _equal(a: Any, b: Any) -> bool:
    arrays = isinstance(a, np.ndarray) or isinstance(b, np.ndarray)
    return a is b or (bool(np.array_equal(a, b)) if arrays else bool(a == b))


@holds_arrays
@dataclass(frozen=True, init=False)
class Ball:
    """A ball whose moment of inertia is the same about every axis through its centre.

    Parameters
    ----------
    radius : float or array, or a text such as "26 mm"
        a, in m, > 0.
    mass : float or array, or a text such as "210 g"
        m, in kg, > 0.
    inertia : "solid", "hollow", or kappa as a float or an array
        I = kappa m a^2: 2/5 for a solid sphere, 2/3 for a thin shell; 0 < kappa <= 2/3.

    Attributes
    ----------
    radius, mass, kappa : float or array
        As given; arrays broadcast with the states of the ball.
    planar : bool
        Whether it is a disc in the plane (:func:`Disc`).

    Raises
    ------
    CaromError
        One line per problem. (A warning: numbers that look like mm or g.)

    Examples
    --------
    >>> import carom
    >>> ball = carom.Ball(radius=0.02, mass=0.0027, inertia="hollow")
    >>> round(ball.kappa, 4), round(1e7 * ball.moment, 3)
    (0.6667, 7.2)
    >>> carom.Ball("26 mm", "140 g").radius
    0.026
    """

    radius: Numbers
    mass: Numbers
    kappa: Numbers
    planar: bool

    def __init__(
        self, radius: ArrayLike | str = 0.02625, mass: ArrayLike | str = 0.1406, inertia: Inertia | ArrayLike = "solid"
    ) -> None:
        _fill(self, "Ball", radius, mass, inertia, INERTIAS, 2 / 3, planar=False)

    def _unlikely(self) -> str:
        """Return the line about numbers in mm or g; near 1 they may be in any consistent units."""
        a, m = self.radius, self.mass
        if not (isinstance(a, float) and isinstance(m, float)):
            return ""
        return unlikely_density(a, m) if a < 1e3 and m < 1e5 and (a > 5 or m > 10) else ""

    @property
    def moment(self) -> Numbers:
        """Moment of inertia I about an axis through the centre, kg m^2."""
        return self.kappa * self.mass * self.radius * self.radius


def Disc(  # noqa: N802
    radius: ArrayLike = 0.02625, mass: ArrayLike = 0.1406, inertia: Literal["disc", "ring"] | ArrayLike = "disc"
) -> Ball:
    """Make a disc in the plane z = 0, which spins about z only: a :class:`Ball` with any kappa above 0.

    Parameters
    ----------
    radius, mass : float or array
        a > 0 in m, m > 0 in kg.
    inertia : "disc", "ring", or kappa as a float or an array
        I = kappa m a^2, > 0: 1/2 for a homogeneous disc, 1 for a ring; above 1 for a hoop with weights outside its rim, on arms
        that pass over the walls.

    Returns
    -------
    Ball, with ``planar`` true. Raises CaromError, one line per problem.

    Examples
    --------
    >>> import carom
    >>> carom.Disc(radius=1.0, mass=1.0, inertia="ring").kappa
    1.0
    >>> carom.Disc(radius=1.0, mass=1.0, inertia=4.0).moment
    4.0
    """
    ball = object.__new__(Ball)
    _fill(ball, "Disc", radius, mass, inertia, DISC_INERTIAS, math.inf, planar=True)
    return ball


def inertia_number(inertia: str | float) -> float:
    """Return kappa = I/(m a^2) of "solid", "hollow" or a number, which may be a text. Raises CaromError for anything else."""
    try:
        kappa = INERTIAS[inertia] if isinstance(inertia, str) and inertia in INERTIAS else float(inertia)
    except (TypeError, ValueError):
        kappa = math.nan
    if not 0 < kappa <= 1:
        raise CaromError(f"`inertia`: expected solid, hollow or kappa = I/(m a^2) above 0, up to 1, got {inertia!r}")
    return kappa


def _fill(
    ball: Ball,
    name: str,
    radius: Any,
    mass: Any,
    inertia: Any,
    names: dict[str, float],
    largest_kappa: float,
    *,
    planar: bool,
) -> None:
    """Validate and set the fields of a ball or a disc; ``names``: kappa of inertias with a name."""
    faults = FaultList(name)
    if isinstance(inertia, str):
        kappa: Any = names.get(inertia)
        if kappa is None:
            faults.add("inertia", f"one of {', '.join(map(repr, names))} or kappa as a number", repr(inertia))
            kappa = 1.0
    else:
        what = f"kappa = I/(m a^2) {'above 0' if planar else 'in (0, 2/3]'}"
        kappa = checked_number(faults, "inertia", inertia, what, lambda x: (x > 0) & (x <= largest_kappa * (1 + 1e-12)))
        given = np.asarray(inertia)
        if (
            not planar
            and faults.has("inertia")
            and given.dtype.kind in "iuf"
            and np.all((given > 0) & (given <= MAX_MAGNITUDE))
        ):
            faults.add_remedy("inertia", "a thin shell is 'hollow'; in the plane carom.Disc takes any")
    values = {
        "radius": checked_number(faults, "radius", in_si(radius, "m"), "a length in m, > 0", lambda x: x > 0),
        "mass": checked_number(faults, "mass", in_si(mass, "kg"), "a mass in kg, > 0", lambda x: x > 0),
        "kappa": kappa,
        "planar": planar,
    }
    faults.raise_if_any()
    vars(ball).update(values)  # (the record is frozen)


@holds_arrays
@dataclass(frozen=True, init=False)
class Surface:
    """The contact properties of a wall, a floor or another ball.

    Parameters
    ----------
    restitution : float or array
        e, 0 to 1: normal velocity after over before a contact.
    friction : float or array
        mu, Coulomb's coefficient, 0 to infinity (``math.inf``: never slips).
    tangential_restitution : float or array
        beta, -1 to 1: a contact that does not slip turns the tangential velocity u into -beta u. 0 stops it (the paper's
        wall), 1 reverses it (a superball), -1 leaves it (smooth).

    Arrays broadcast with the states that meet the surface.

    Raises
    ------
    CaromError
        One line per problem.

    Examples
    --------
    >>> import carom
    >>> carom.Surface(restitution=0.85, friction=0.2)
    Surface(restitution=0.85, friction=0.2, tangential_restitution=0.0)
    """

    restitution: Numbers
    friction: Numbers
    tangential_restitution: Numbers

    def __init__(
        self, restitution: ArrayLike = 1.0, friction: ArrayLike = math.inf, tangential_restitution: ArrayLike = 0.0
    ) -> None:
        faults = FaultList("Surface")
        values = {
            "restitution": checked_number(
                faults, "restitution", restitution, "a number from 0 to 1", lambda x: (x >= 0) & (x <= 1)
            ),
            "friction": checked_number(
                faults, "friction", friction, "a number >= 0 (inf: never slips)", lambda x: x >= 0, infinite=True
            ),
            "tangential_restitution": checked_number(
                faults,
                "tangential_restitution",
                tangential_restitution,
                "a number from -1 to 1",
                lambda x: (x >= -1) & (x <= 1),
            ),
        }
        faults.raise_if_any()
        vars(self).update(values)  # (the record is frozen)


@dataclass(frozen=True, init=False, eq=False)
class State:
    """Velocity and spin, and optionally the position, of one ball or of many.

    Parameters
    ----------
    velocity : array (..., 3)
        Velocity of the centre, m/s.
    spin : array (..., 3)
        Angular velocity in the fixed frame, rad/s. Velocity and spin broadcast.
    position : array (..., 3), optional
        Centre of the ball, m; a ball on the floor has its centre at z = a.

    The arrays are copies. Two states are equal if all their velocities and spins are (NaN equals NaN).

    Raises
    ------
    CaromError
        For other shapes, for what is not a finite number.

    Examples
    --------
    >>> import carom
    >>> state = carom.State(velocity=[(1, 0, 0), (2, 0, 0)], spin=(0, 0, 5))
    >>> state.shape, state[1].spin
    ((2,), array([0., 0., 5.]))
    """

    velocity: Array
    spin: Array
    position: Array | None

    def __init__(
        self, velocity: ArrayLike, spin: ArrayLike = (0.0, 0.0, 0.0), position: ArrayLike | None = None
    ) -> None:
        faults = FaultList("State")
        v = vectors(faults, "velocity", velocity, "m/s")
        w = vectors(faults, "spin", spin, "rad/s")
        x = None if position is None else vectors(faults, "position", position, "m")
        faults.raise_if_any()
        if v.shape != w.shape:
            try:
                v, w = (np.ascontiguousarray(u) for u in np.broadcast_arrays(v, w))
            except ValueError:
                message = f"State: velocity and spin: expected shapes that broadcast, got {v.shape} and {w.shape}"
                raise CaromError(message) from None
        vars(self).update(velocity=v, spin=w, position=x)  # (the record is frozen)

    @classmethod
    def of(cls, velocity: Array, spin: Array, position: Array | None = None) -> State:
        """Return a state of arrays that are not checked: a law's results, NaN where there is no answer."""
        state = object.__new__(cls)
        vars(state).update(velocity=velocity, spin=spin, position=position)
        return state

    @property
    def shape(self) -> tuple[int, ...]:
        """Shape without the last axis; () for one state."""
        return self.velocity.shape[:-1]

    def __getitem__(self, index: Any) -> State:
        """Return the state, or states, at an index of the leading axes."""
        x = None if self.position is None else self.position[index]
        return State.of(self.velocity[index], self.spin[index], x)

    def __eq__(self, other: object) -> bool:
        """Return whether velocities and spins are equal, and positions where both have one (NaN equals NaN)."""
        if not isinstance(other, State):
            return NotImplemented
        pairs = [(self.velocity, other.velocity), (self.spin, other.spin)]
        if self.position is not None and other.position is not None:
            pairs.append((self.position, other.position))
        return all(np.array_equal(one, two, equal_nan=True) for one, two in pairs)

    __hash__ = None  # type: ignore[assignment]


def vectors(faults: FaultList, field: str, value: ArrayLike, unit: str, length: int = 3) -> Array:
    """Return an array (..., length) of finite numbers; else add a fault and return zeros."""
    try:
        array = float_array(value)
    except (TypeError, ValueError):
        faults.add(field, f"{length} numbers in {unit}, or an array (..., {length}) of them", f"{value!r}")
        return np.zeros(length)
    if array.ndim == 0 or array.shape[-1] != length:
        faults.add(field, f"{length} numbers in {unit}, or an array (..., {length}) of them", f"shape {array.shape}")
        return np.zeros(length)
    bad = ~(np.abs(array) <= MAX_MAGNITUDE)  # NaN compares false
    if bad.any():
        where = first_bad_index(bad.any(axis=-1))
        faults.add(field, f"finite numbers in {unit}", f"{float(array[bad].flat[0])!r}{where}")
    return array


def rolling(ball: Ball, velocity: ArrayLike = (-1.0, 1.0), spin_z: ArrayLike = 0.0) -> State:
    """Return the state of a ball that rolls on the floor without sliding.

    Parameters
    ----------
    ball : Ball
    velocity : array (..., 2) or (..., 3)
        Velocity of the centre along the floor, m/s; a third component must be zero.
    spin_z : float or array (...)
        Spin about the vertical, rad/s.

    Returns
    -------
    State
        With omega_x = -v_y/a and omega_y = v_x/a, the paper's (27).

    Raises
    ------
    CaromError
        For a vertical velocity, a disc, other shapes, and what is not a finite number.

    Examples
    --------
    >>> import carom
    >>> carom.rolling(carom.Ball(radius=0.025), velocity=(-1.0, 0.5)).spin
    array([-20., -40.,   0.])
    """
    require_type("rolling", "ball", ball, Ball)
    faults = FaultList("rolling")
    try:
        length = np.shape(velocity)[-1]
    except (ValueError, IndexError):
        length = 0
    v = vectors(faults, "velocity", velocity, "m/s", 3 if length == 3 else 2)
    if length == 3 and np.any(v[..., 2] != 0):
        faults.add(
            "velocity", "no vertical component: the ball is on the floor", f"v_z = {float(v[..., 2].flat[0])!r} m/s"
        )
    wz = vectors(faults, "spin_z", np.asarray(spin_z)[..., None], "rad/s", 1)[..., 0]
    if ball.planar:
        faults.add("ball", "a ball: a disc in the plane has no floor to roll on", "a disc")
    faults.raise_if_any()
    shape = broadcast_shape(v.shape[:-1], wz.shape, np.shape(ball.radius))
    velocities, spins = np.zeros((*shape, 3)), np.zeros((*shape, 3))
    velocities[..., :2] = v[..., :2]
    # (27)
    spins[..., 0] = -v[..., 1] / ball.radius
    spins[..., 1] = v[..., 0] / ball.radius
    spins[..., 2] = wz
    return State.of(velocities, spins)


def kinetic_energy(ball: Ball, state: State) -> Numbers:
    """Return the kinetic energy m v^2/2 + I omega^2/2, the paper's (20).

    Parameters
    ----------
    ball : Ball
    state : State (...)

    Returns
    -------
    float, or array (...)
        J. Raises CaromError for shapes that do not broadcast.

    Examples
    --------
    >>> import carom
    >>> ball = carom.Ball(radius=0.03, mass=0.2)
    >>> round(carom.kinetic_energy(ball, carom.rolling(ball, (3, 4))), 12)
    3.5
    """
    require_type("kinetic_energy", "ball", ball, Ball)
    require_type("kinetic_energy", "state", state, State)
    broadcast_shape(state.shape, np.shape(ball.mass), np.shape(ball.moment))
    v, w = state.velocity, state.spin
    # (20), (34)
    # (32), (33) are its values before and after the wall (31)
    energy = ball.mass * (v * v).sum(axis=-1) / 2 + ball.moment * (w * w).sum(axis=-1) / 2
    return float(energy) if np.ndim(energy) == 0 else energy


def slip(ball: Ball, state: State, normal: ArrayLike = (0.0, 0.0, 1.0)) -> Array:
    """Return the tangential velocity of the ball's contact point, from the paper's (24).

    Parameters
    ----------
    ball : Ball
    state : State (...)
    normal : array (..., 3)
        Unit normal n from the surface to the ball, whose contact point is -a n from its centre; by default the floor's.

    Returns
    -------
    array (..., 3)
        m/s; zero if the ball rolls. Raises CaromError for shapes that do not broadcast.

    Examples
    --------
    >>> import carom
    >>> ball = carom.Ball(radius=0.025)
    >>> carom.slip(ball, carom.State(velocity=(1, 0, 0), spin=(0, 40, 0)))
    array([0., 0., 0.])
    """
    n = np.asarray(normal, dtype=float)
    broadcast_shape(state.shape, n.shape[:-1], np.shape(ball.radius))
    a = np.asarray(ball.radius)[..., None]
    v, w = state.velocity, state.spin
    # (24), less its normal part; the product w x n written out, five times as fast as np.cross for one state
    i, k = [1, 2, 0], [2, 0, 1]
    turn = w[..., i] * n[..., k] - w[..., k] * n[..., i]
    result: Array = v - (v * n).sum(axis=-1, keepdims=True) * n - a * turn
    return result
