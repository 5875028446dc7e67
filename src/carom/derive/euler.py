"""Euler angles of the rolling ball: angular velocity, constraints, kinetic energy, and the paper's integrals.

The paper's angles are theta (nutation), phi (precession) and psi (rotation in the fixed frame): psi turns the line of nodes, phi
spins the body, so that at phi = psi = 0, theta = pi/2 the angular velocity is (theta', -phi', psi').

``angles`` and ``rates`` are arrays (..., 3) of (theta, phi, psi) in rad and of their rates in rad/s. Every function raises
CaromError for another shape or numbers that are not finite.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from carom.bodies import Ball
from carom.errors import CaromError

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
    size = np.asarray(speed, dtype=float) / np.sqrt(2)
    # (4) with (2): omega_y = 0 and omega_x = -omega_z
    return euler_rates(angles, np.stack([size, 0 * size, -size], axis=-1))


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
