"""Convert a Lagrangian and its constraints to matrices: mass matrix, generalised speeds, constraint rows."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
import sympy as sp
from numpy.typing import ArrayLike, NDArray
from sympy.core.function import AppliedUndef
from sympy.physics.mechanics import dynamicsymbols

from carom.bodies import Ball
from carom.derive.linear import Expr, Matrix, independent_rows, is_zero, null_basis, reduce_trig, tidy
from carom.errors import CaromError

TIME = dynamicsymbols._t


@dataclass(frozen=True)
class ConstraintRow:
    """One constraint that is linear in the speeds: ``coefficients . u + drift = 0``.

    ``closing`` is Newton's coefficient of restitution e, a number or an expression (e = 0: the constraint holds afterwards), or
    None where the user gives closing equations.
    """

    name: str
    coefficients: Matrix
    drift: Expr
    closing: Expr | None = sp.S.Zero
    expression: Expr = None


@dataclass(frozen=True)
class Speeds:
    """The generalised speeds, and the symbols that denote them just before (0) and just after (1) the instant."""

    names: tuple[Expr, ...]
    before: tuple[Expr, ...]
    after: tuple[Expr, ...]
    dummies: tuple[Expr, ...]

    @property
    def count(self) -> int:
        """Number of speeds."""
        return len(self.names)

    def plain(self, expr: Expr) -> Expr:
        """Return ``expr`` with every speed replaced by a dummy symbol, so that it can be differentiated with respect to it."""
        return sp.sympify(expr).xreplace(dict(zip(self.names, self.dummies, strict=True)))

    def at(self, expr: Expr, moment: int) -> Expr:
        """Return ``expr`` with the speeds just before (``moment`` 0) or just after (1) the instant."""
        return sp.sympify(expr).xreplace(dict(zip(self.names, self.after if moment else self.before, strict=True)))


def _base_name(speed: Expr) -> str:
    if isinstance(speed, sp.Derivative):
        return f"{speed.expr.func.__name__}dot"
    return speed.func.__name__ if isinstance(speed, AppliedUndef) else str(speed)


def make_speeds(coordinates: Sequence[Expr], speeds: Sequence[Expr] | None) -> Speeds:
    """Return the speeds: the given quasi-velocities, or the time derivatives of the coordinates."""
    for q in coordinates:
        if not isinstance(q, AppliedUndef):
            raise CaromError(f"coordinates: expected functions of time such as dynamicsymbols('x'), got {q}")
    if len(set(coordinates)) != len(coordinates):
        raise CaromError(f"coordinates: expected each one once, got {list(coordinates)}")
    names = tuple(speeds) if speeds is not None else tuple(q.diff(TIME) for q in coordinates)
    if not names:
        raise CaromError("coordinates: expected at least one, got none")
    for u in names:
        if not isinstance(u, AppliedUndef | sp.Derivative):
            raise CaromError(f"speeds: expected functions of time or their derivatives, got {u}")
    return Speeds(
        names,
        tuple(sp.Symbol(f"{_base_name(u)}0", real=True) for u in names),
        tuple(sp.Symbol(f"{_base_name(u)}1", real=True) for u in names),
        tuple(sp.Dummy(_base_name(u), real=True) for u in names),
    )


def check_known(expr: Expr, coordinates: Sequence[Expr], speeds: Speeds, where: str) -> None:
    """Raise CaromError for a function of time, or a derivative, that is neither a coordinate nor a speed of the system."""
    rest = speeds.plain(expr)
    if rest.has(sp.zoo, sp.nan, sp.oo):
        raise CaromError(f"{where}: expected a finite expression, got {expr}")
    unknown = set(rest.atoms(sp.Derivative)) | (rest.atoms(AppliedUndef) - set(coordinates))
    inside = {f for d in rest.atoms(sp.Derivative) for f in d.atoms(AppliedUndef)}
    unknown -= {f for f in inside if f in coordinates}
    if unknown:
        listed = ", ".join(sorted(str(s) for s in unknown))
        raise CaromError(
            f"{where}: unknown {listed}; expected only the coordinates {list(coordinates)} and their speeds"
        )


def mass_matrix(
    lagrangian: Expr, coordinates: Sequence[Expr], speeds: Speeds, at: Mapping[Expr, Expr]
) -> tuple[Matrix, Matrix]:
    """Return the mass matrix M and the part b of the momenta that does not depend on the speeds: p = M u + b.

    Raises CaromError where the Lagrangian is not quadratic in the speeds, or M is singular; the message then names the motion
    that carries no kinetic energy.
    """
    check_known(lagrangian, coordinates, speeds, "Lagrangian")
    plain = speeds.plain(lagrangian)
    momenta = [sp.diff(plain, u) for u in speeds.dummies]
    mass = sp.Matrix([[sp.diff(p, u) for u in speeds.dummies] for p in momenta])
    for i, u in enumerate(speeds.names):
        if any(mass[i, j].has(*speeds.dummies) for j in range(speeds.count)):
            raise CaromError(
                f"Lagrangian: not quadratic in the speed {u}; impulsive motion needs a momentum linear in it"
            )
    rest = sp.Matrix([p.xreplace(dict.fromkeys(speeds.dummies, sp.S.Zero)) for p in momenta])
    mass = mass.xreplace(dict(at)).applyfunc(tidy)
    kept, _ = independent_rows(mass)
    if len(kept) < speeds.count:
        idle = null_basis(mass)
        parts = [f"{tidy(idle[i, 0])}*{u}" for i, u in enumerate(speeds.names) if not is_zero(idle[i, 0])]
        raise CaromError(
            f"mass matrix: singular; the motion {' + '.join(parts)} carries no kinetic energy "
            "(a massless coordinate, or an attitude where the angles themselves fail: take other angles or "
            "quasi-velocities)"
        )
    return mass, rest


def constraint_row(
    name: str,
    expr: Expr,
    coordinates: Sequence[Expr],
    speeds: Speeds,
    at: Mapping[Expr, Expr],
    closing: Expr | None = sp.S.Zero,
) -> ConstraintRow:
    """Return the row of an expression that must vanish: of the speeds (Pfaffian), or of the coordinates alone (differentiated)."""
    if isinstance(expr, sp.Equality):
        expr = expr.lhs - expr.rhs
    expr = sp.sympify(expr)
    check_known(expr, coordinates, speeds, f"constraint {name}")
    plain = speeds.plain(expr)
    if not plain.has(*speeds.dummies):
        if any(not isinstance(u, sp.Derivative) for u in speeds.names):
            raise CaromError(
                f"constraint {name}: holonomic, but the speeds are quasi-velocities; give its velocity form"
            )
        plain = speeds.plain(sp.diff(expr, TIME))
        if not plain.has(*speeds.dummies):
            raise CaromError(f"constraint {name}: expected an expression of the coordinates or the speeds, got {expr}")
    coefficients = []
    for u, dummy in zip(speeds.names, speeds.dummies, strict=True):
        c = sp.diff(plain, dummy)
        if c.has(*speeds.dummies) and tidy(c).has(*speeds.dummies):
            raise CaromError(f"constraint {name}: not linear in the speed {u}: {expr}")
        coefficients.append(tidy(c.xreplace(dict(at))))
    drift = tidy(plain.xreplace(dict.fromkeys(speeds.dummies, sp.S.Zero)).xreplace(dict(at)))
    return ConstraintRow(name, sp.Matrix([coefficients]), drift, closing, expr)


def named_constraints(constraints: Mapping[str, Any] | Iterable[Any] | None, prefix: str) -> dict[str, Any]:
    """Return the constraints by name: the given names, or ``prefix`` and a count."""
    if constraints is None:
        return {}
    if isinstance(constraints, Mapping):
        return {str(k): v for k, v in constraints.items()}
    if isinstance(constraints, sp.Basic) and not isinstance(constraints, sp.Tuple):
        constraints = [constraints]
    return {f"{prefix} {i + 1}": c for i, c in enumerate(constraints)}


# ----------------------------------------------------------------------------------------------------
# Contact points with restitution and friction, and the virtual displacements that constraints allow.


@dataclass(frozen=True)
class Contact:
    """A contact point: its velocity in the surface's frame, and the laws that close its impact.

    Attributes
    ----------
    name : str
        Prefix of its impulses: ``name.n``, ``name.t1``, ``name.t2``.
    normal : Expr
        Velocity of the contact point along the surface's normal, positive when it separates; linear in the speeds.
    tangents : tuple of Expr
        Its one (in the plane) or two (in space) velocities along orthonormal tangents.
    restitution : Expr
        Coefficient of restitution e, 0 to 1; number or symbol.
    friction : Expr
        Coulomb's mu: 0 is smooth, ``sympy.oo`` never slips; number or symbol.
    tangential_restitution : Expr
        beta, -1 to 1: a sticking contact returns -beta times its tangential velocity.
    hypothesis : str
        What e relates: "newton" (velocities), "poisson" (impulses) or "stronge" (work).

    Raises
    ------
    CaromError
        A value outside its range, more than two tangents, an unknown hypothesis; one line for each.

    Examples
    --------
    >>> from sympy.physics.mechanics import dynamicsymbols
    >>> from carom.derive import Contact
    >>> y = dynamicsymbols("y")
    >>> Contact("floor", y.diff(), restitution=1, friction=0).restitution
    1
    >>> Contact("floor", y.diff(), restitution=2)
    Traceback (most recent call last):
        ...
    carom.errors.CaromError: contact floor: restitution: expected a value from 0 to 1, got 2
    """

    name: str
    normal: Expr
    tangents: tuple[Expr, ...] = ()
    restitution: Expr = sp.S.Zero
    friction: Expr = sp.oo
    tangential_restitution: Expr = sp.S.Zero
    hypothesis: str = "newton"

    def __post_init__(self) -> None:
        """Validate the ranges."""
        faults = []
        if self.hypothesis not in ("newton", "poisson", "stronge"):
            faults.append(
                f"contact {self.name}: hypothesis: expected 'newton', 'poisson' or 'stronge', got {self.hypothesis!r}"
            )
        if len(self.tangents) > 2:
            faults.append(f"contact {self.name}: tangents: expected at most two, got {len(self.tangents)}")
        for what, value, low, high in (
            ("restitution", self.restitution, 0, 1),
            ("friction", self.friction, 0, sp.oo),
            ("tangential_restitution", self.tangential_restitution, -1, 1),
        ):
            number = sp.sympify(value)
            object.__setattr__(self, what, number)
            if number.is_number and not (number.is_extended_real and low <= number <= high):
                faults.append(f"contact {self.name}: {what}: expected a value from {low} to {high}, got {value}")
        if faults:
            raise CaromError(*faults)


def contact_at(name: str, point: Any, frame: Any, axes: Sequence[Any], **surface: Any) -> Contact:
    """Return the contact at a ``Point`` of SymPy's mechanics, whose velocity is known in ``frame``.

    Parameters
    ----------
    name : str
        The contact's name.
    point : sympy.physics.mechanics.Point
        ``point.vel(frame)`` must be defined.
    frame : sympy.physics.mechanics.ReferenceFrame
        The frame in which the surface is at rest.
    axes : sequence
        Unit vectors of ``sympy.physics.vector``: the surface's normal, then one or two tangents.
    **surface
        restitution, friction, tangential_restitution, hypothesis, as in :class:`Contact`.

    Returns
    -------
    Contact

    Raises
    ------
    CaromError
        For another number of axes, or axes that are not orthonormal.

    Examples
    --------
    >>> from sympy.physics.mechanics import Point, ReferenceFrame, dynamicsymbols
    >>> from carom.derive import contact_at
    >>> x, y = dynamicsymbols("x y")
    >>> frame, point = ReferenceFrame("N"), Point("P")
    >>> point.set_vel(frame, x.diff() * frame.x + y.diff() * frame.y)
    >>> contact = contact_at("floor", point, frame, (frame.y, frame.x), restitution=1)
    >>> contact.normal, contact.tangents
    (Derivative(y(t), t), (Derivative(x(t), t),))
    """
    if not 2 <= len(axes) <= 3:
        raise CaromError(f"contact {name}: axes: expected the normal and one or two tangents, got {len(axes)} axes")
    for i, first in enumerate(axes):
        for j, second in enumerate(axes[: i + 1]):
            if sp.simplify(first.dot(second) - (1 if i == j else 0)) != 0:
                raise CaromError(
                    f"contact {name}: axes: expected orthonormal ones, but axes {j + 1} and {i + 1} are not orthonormal"
                )
    velocity = point.vel(frame)
    normal, *tangents = (sp.expand(velocity.dot(axis)) for axis in axes)
    return Contact(name, normal, tuple(tangents), **surface)


def displacement_basis(names: Sequence[Expr], columns: Matrix, independent: Sequence[Expr] | None) -> Matrix:
    """Return columns that span the orthogonal complement of ``columns`` (a row per speed), parametrised by ``independent``."""
    if independent is None:
        return null_basis(columns.T, None)
    for u in independent:
        if u not in names:
            raise CaromError(f"independent speeds: {u} is not a speed; expected some of {list(names)}")
    try:
        return null_basis(columns.T, [names.index(u) for u in independent])
    except CaromError as error:
        found = null_basis(columns.T)
        can = [
            str(u)
            for i, u in enumerate(names)
            if found.cols == len(independent)
            and not is_zero(sum((found[i, k] ** 2 for k in range(found.cols)), sp.S.Zero))
        ]
        asked = ", ".join(str(u) for u in independent)
        raise CaromError(
            f"independent speeds: {asked} cannot parametrise the {found.cols} virtual displacement(s) at this "
            f"configuration (a chart that fails here); speeds that move: {', '.join(can) or 'none'}"
        ) from error


def displacement_limit(column: Matrix, towards: Mapping[Expr, Expr]) -> Matrix:
    """Return the direction of a displacement at a pole of its components: times their common denominator it has a limit."""
    together = [sp.fraction(reduce_trig(x)) for x in column]
    common = sp.S.One
    for _, below in together:
        common = sp.lcm(common, below)
    cleared = [tidy(above * common / below) for above, below in together]
    found = sp.Matrix([tidy(x.xreplace(dict(towards))) for x in cleared])
    if all(is_zero(x) for x in found):
        raise CaromError(
            "displacement limit: independent: expected a speed with a limit there, but every component vanishes; take another"
        )
    return found


# ----------------------------------------------------------------------------------------------------
# Euler angles of the rolling ball: angular velocity, constraints, kinetic energy, and the paper's integrals.
#
# The paper's angles are theta (nutation), phi (precession) and psi (rotation in the fixed frame): psi turns the line of nodes,
# phi
# spins the body, so that at phi = psi = 0, theta = pi/2 the angular velocity is (theta', -phi', psi').
#
# ``angles`` and ``rates`` are arrays (..., 3) of (theta, phi, psi) in rad and of their rates in rad/s. Every function raises
# CaromError for another shape or numbers that are not finite.


Array = NDArray[np.float64]


def _triple(values: ArrayLike, name: str) -> tuple[Array, Array, Array]:
    array = np.asarray(values, dtype=float)
    if array.ndim == 0 or array.shape[-1] != 3:
        raise CaromError(f"{name}: expected (theta, phi, psi) along the last axis, got shape {array.shape}")
    if not np.isfinite(array).all():
        raise CaromError(f"{name}: expected finite numbers, got {array[~np.isfinite(array)][0]}")
    return array[..., 0], array[..., 1], array[..., 2]


def angular_velocity(angles: ArrayLike, rates: ArrayLike) -> Array:
    """Return the angular velocity (..., 3) in the fixed frame, rad/s, from Euler angles and rates (..., 3): equation (1).

    Examples
    --------
    >>> from carom.derive import euler
    >>> euler.angular_velocity((1.5707963267948966, 0.0, 0.0), (1.0, 2.0, 3.0)).round(12)
    array([ 1., -2.,  3.])
    """
    th, _ph, ps = _triple(angles, "angles")
    dth, dph, dps = _triple(rates, "rates")
    # (1)
    return np.stack(
        [
            dth * np.cos(ps) + dph * np.sin(th) * np.sin(ps),
            dth * np.sin(ps) - dph * np.sin(th) * np.cos(ps),
            dph * np.cos(th) + dps,
        ],
        axis=-1,
    )


def euler_angles(orientation: ArrayLike) -> Array:
    """Return the paper's angles (..., 3) = (theta, phi, psi), rad, of orientations (..., 4): unit quaternions (w, x, y, z).

    The turn is R = R_z(psi) R_x(theta) R_z(phi), 0 <= theta <= pi, so that (1) holds for its rates. Where sin theta = 0 only
    the sum (theta = 0) or the difference (theta = pi) of phi and psi is known, and psi is set to zero.

    Examples
    --------
    >>> from carom.derive import euler
    >>> euler.euler_angles((1.0, 0.0, 0.0, 0.0))
    array([0., 0., 0.])
    """
    q = np.asarray(orientation, dtype=float)
    if q.ndim == 0 or q.shape[-1] != 4:
        raise CaromError(f"euler_angles: orientation: expected quaternions (..., 4), got shape {q.shape}")
    w, x, y, z = np.moveaxis(q, -1, 0)
    if not np.all(np.abs(w * w + x * x + y * y + z * z - 1) < 1e-6):
        raise CaromError("euler_angles: orientation: expected unit quaternions (w, x, y, z), got one of another length")
    # q = (cos t/2 cos s, sin t/2 cos d, sin t/2 sin d, cos t/2 sin s) with s = (psi + phi)/2, d = (psi - phi)/2
    across, along = np.hypot(x, y), np.hypot(w, z)
    s, d = np.arctan2(z, w), np.arctan2(y, x)
    d = np.where(across < 1e-12, -s, d)
    s = np.where(along < 1e-12, -d, s)
    theta = 2 * np.arctan2(across, along)
    wrapped = [(angle + np.pi) % (2 * np.pi) - np.pi for angle in (s - d, s + d)]
    return np.stack([theta, *wrapped], axis=-1)


def euler_rates(angles: ArrayLike, spin: ArrayLike) -> Array:
    """Return the Euler rates (..., 3), rad/s, from the angular velocity (..., 3): the inverse of (1).

    At sin theta = 0 the angles are singular (phi and psi turn about the same axis); there the smallest rates that give the
    spin are returned where they exist, and CaromError says where they do not.

    Examples
    --------
    >>> from carom.derive import euler
    >>> euler.euler_rates((1.5707963267948966, 0.0, 0.0), (1.0, -2.0, 3.0)).round(12)
    array([1., 2., 3.])
    """
    th, _ph, ps = _triple(angles, "angles")
    wx, wy, wz = _triple(spin, "spin")
    dth = wx * np.cos(ps) + wy * np.sin(ps)
    across = wx * np.sin(ps) - wy * np.cos(ps)  # = phi' sin theta
    s = np.sin(th)
    singular = np.abs(s) < 1e-12
    scale = np.maximum(np.abs(wx) + np.abs(wy) + np.abs(wz), 1e-300)
    if np.any(singular & (np.abs(across) > 1e-9 * scale)):
        raise CaromError(
            "euler_rates: theta: expected sin(theta) != 0 for this spin, got a singular attitude; choose other axes for the body"
        )
    # phi' = psi' cos theta shares the spin about the common axis
    dph = np.where(singular, wz * np.cos(th) / 2, across / np.where(singular, 1.0, s))
    return np.stack([dth, dph, wz - dph * np.cos(th)], axis=-1)


def rolling_velocity(ball: Ball, angles: ArrayLike, rates: ArrayLike) -> Array:
    """Return the velocity (..., 3) of the centre, m/s, of a ball that rolls on the floor: the constraints (2).

    Examples
    --------
    >>> from carom.derive import euler
    >>> import carom
    >>> ball = carom.Ball(radius=0.5, mass=1.0)
    >>> euler.rolling_velocity(ball, (1.5707963267948966, 0.0, 0.0), (0.0, -2.0, 0.0)).round(12)
    array([ 1., -0.,  0.])
    """
    w = angular_velocity(angles, rates)
    # (2): x' = a omega_y, y' = -a omega_x, z' = 0
    return np.stack([ball.radius * w[..., 1], -ball.radius * w[..., 0], np.zeros_like(w[..., 0])], axis=-1)


def kinetic_energy_rolling(ball: Ball, angles: ArrayLike, rates: ArrayLike) -> Any:
    """Return the kinetic energy (...) of a rolling ball, J, in the Euler rates: equation (3).

    Examples
    --------
    >>> from carom.derive import euler
    >>> import carom
    >>> ball = carom.Ball(radius=1.0, mass=1.0, inertia=0.4)
    >>> float(euler.kinetic_energy_rolling(ball, (1.5707963267948966, 0.0, 0.0), (1.0, 0.0, 0.0)))
    0.7
    """
    th, _ph, _ps = _triple(angles, "angles")
    dth, dph, dps = _triple(rates, "rates")
    m, a, moment = ball.mass, ball.radius, ball.moment
    # (3)
    return (
        (m * a * a + moment) * dth**2 / 2
        + (m * a * a * np.sin(th) ** 2 + moment) * dph**2 / 2
        + moment * (dps**2 + 2 * dph * dps * np.cos(th)) / 2
    )


def wall_constraint(angles: ArrayLike, rates: ArrayLike) -> Array:
    """Return the left-hand sides (..., 2) of (5), rad/s: both zero where a rolling ball also does not slip on the wall x = 0, (4).

    Examples
    --------
    >>> from carom.derive import euler
    >>> euler.wall_constraint((1.0, 0.2, 0.3), euler.wall_rates((1.0, 0.2, 0.3))).round(12) + 0.0
    array([0., 0.])
    """
    th, _ph, ps = _triple(angles, "angles")
    dth, dph, dps = _triple(rates, "rates")
    return np.stack(
        [
            # (5)
            dth * np.sin(ps) - dph * np.sin(th) * np.cos(ps),
            dth * np.cos(ps) + dph * (np.sin(th) * np.sin(ps) + np.cos(th)) + dps,
        ],
        axis=-1,
    )


def wall_rates(angles: ArrayLike, speed: ArrayLike = 1.0) -> Array:
    """Return the Euler rates (..., 3) that satisfy (5): the only motion left, a rotation about the line through both
    contact points.

    (6) takes phi' for the independent rate and divides by sin psi: at psi = 0, which is where the paper uses it, phi'
    vanishes and (6) has no value. The solution does: here its size is the angular velocity ``speed`` (rad/s) about
    (1, 0, -1)/sqrt 2, so that psi = 0 is a regular point. For sin psi != 0 the ratios agree with (6).
    At sin theta = 0 the angles themselves are singular and CaromError is raised, as by :func:`euler_rates`.

    Examples
    --------
    >>> from carom.derive import euler
    >>> euler.wall_rates((1.5707963267948966, 0.0, 0.0), speed=2**0.5).round(12) + 0.0
    array([ 1.,  0., -1.])
    """
    th, _ph, _ps = _triple(angles, "angles")
    size = np.asarray(speed, dtype=float) / np.sqrt(2)
    # (4) with (2): omega_y = 0 and omega_x = -omega_z
    spin = np.stack(np.broadcast_arrays(size, 0 * size, -size), axis=-1)
    shape = np.broadcast_shapes(th.shape, spin.shape[:-1])
    return euler_rates(
        np.broadcast_to(np.asarray(angles, dtype=float), (*shape, 3)), np.broadcast_to(spin, (*shape, 3))
    )


def psi_integral(angles: ArrayLike) -> Any:
    """Return the constant c of (8): c = sin psi sin theta - cos theta, which the motion (6) keeps; 0 at the paper's attitude.

    It is the direction cosine of the body's axis on (1, 0, -1), less the sign: the axis turns about that line.

    Examples
    --------
    >>> from carom.derive import euler
    >>> float(euler.psi_integral((1.5707963267948966, 0.0, 0.0)).round(12)) + 0.0
    0.0
    """
    th, _ph, ps = _triple(angles, "angles")
    # (8)
    return np.sin(ps) * np.sin(th) - np.cos(th)


def phi_integral(angles: ArrayLike) -> Any:
    """Return the constant d of (11), on the branch c = 0 of (8), in [0, pi): pi/4 at the paper's attitude with theta = pi/2.

    (11) holds for 2 sin^2 theta > 1; the sign of cos psi, which the paper leaves to the reader, picks the branch of the
    square root (plus from the paper's attitude onwards).

    Examples
    --------
    >>> from carom.derive import euler
    >>> float(euler.phi_integral((1.5707963267948966, 0.0, 0.0)).round(6))
    0.785398
    """
    th, ph, ps = _triple(angles, "angles")
    # (11): tan(phi - d) = -1/sqrt(2 sin^2 theta - 1), with sqrt(2 sin^2 theta - 1) = sin theta cos psi by (9)
    return np.mod(ph + np.arctan2(np.ones_like(th), np.sin(th) * np.cos(ps)), np.pi)
