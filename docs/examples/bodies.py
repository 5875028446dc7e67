"""Example bodies for `carom.derive`: each function returns an `ImpulsiveMotion` ready to solve.

The symbols that they use are module constants, all positive except the speeds. The documentation and the tests import them.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import sympy as sp
from sympy.physics.mechanics import dynamicsymbols

from carom.derive import Contact, ImpulsiveMotion
from carom.derive.system import Expr

__all__ = [
    "ball_in_corner",
    "ball_on_wall",
    "block_on_feet",
    "double_pendulum",
    "ellipsoid_on_wall",
    "ellipsoid_values",
    "knife_edge",
    "penny",
    "rod_on_one_end",
    "upright_disc",
]

a, b, c, l, m = sp.symbols("a b c l m", positive=True)  # noqa: E741 - l is the length
I, J, e, mu, beta, kappa = sp.symbols("I J e mu beta kappa", positive=True)  # noqa: E741 - the moment
reach, IXX, IYY, IZZ = sp.symbols("d I_xx I_yy I_zz", positive=True)
offset, IXY = sp.symbols("h I_xy", real=True)

x, y, z, theta, phi = dynamicsymbols("x y z theta phi")
_t = dynamicsymbols._t
VX, VY, VZ = (q.diff(_t) for q in (x, y, z))
WX, WY, WZ = dynamicsymbols("omega_x omega_y omega_z")
RIM_GAP = x - a * sp.cos(phi)


def _contact_velocity(arm: tuple[Expr, Expr, Expr]) -> list[Expr]:
    """Velocity of the body's point at ``arm`` from its mass centre: v + omega x arm."""
    spin = sp.Matrix([WX, WY, WZ]).cross(sp.Matrix(arm))
    return [v + s for v, s in zip((VX, VY, VZ), spin, strict=True)]


def ball_on_wall(restitution: Expr = e, friction: Expr = sp.oo, tangential: Expr = 0, **more: Any) -> ImpulsiveMotion:
    """A ball of moment kappa m a^2 against the plane x = 0; speeds are the velocity and the spin (fixed frame).

    Further constraints (``before``, ``nonhol_coneqs``, ``imposed``) go through to `ImpulsiveMotion`.
    """
    energy = m * (VX**2 + VY**2 + VZ**2) / 2 + kappa * m * a**2 * (WX**2 + WY**2 + WZ**2) / 2
    normal, *tangents = _contact_velocity((-a, sp.S.Zero, sp.S.Zero))  # B
    wall = Contact("wall", normal, tuple(tangents), restitution, friction, tangential)
    return ImpulsiveMotion(energy, [x, y, z], speeds=[VX, VY, VZ, WX, WY, WZ], contacts=[wall], **more)


def rolling() -> dict[str, Expr]:
    """The paper's (2) in velocity and spin: the ball's point on the floor z = 0 is at rest."""
    vx, vy, vz = _contact_velocity((sp.S.Zero, sp.S.Zero, -a))  # A
    return {"floor x": vx, "floor y": vy, "floor z": vz}


def ball_in_corner(restitution: Expr = sp.S.Zero, friction: Expr = sp.oo) -> ImpulsiveMotion:
    """A ball that meets the planes x = 0, y = 0 and z = 0 at one instant."""
    energy = m * (VX**2 + VY**2 + VZ**2) / 2 + kappa * m * a**2 * (WX**2 + WY**2 + WZ**2) / 2
    zero = sp.S.Zero
    contacts = []
    for k, name in enumerate(("wall x", "wall y", "floor")):
        arm = [zero, zero, zero]
        arm[k] = -a
        velocity = _contact_velocity((arm[0], arm[1], arm[2]))
        normal = velocity.pop(k)
        contacts.append(Contact(name, normal, tuple(velocity), restitution, friction))
    return ImpulsiveMotion(energy, [x, y, z], speeds=[VX, VY, VZ, WX, WY, WZ], contacts=contacts)


def rod_on_one_end(
    restitution: Expr = e, friction: Expr = mu, hypothesis: str = "newton", at: Mapping[Expr, Expr] | None = None
) -> ImpulsiveMotion:
    """A uniform rod of length 2 l, at the angle theta to the floor, that lands on its lower end."""
    energy = m * (VX**2 + VY**2) / 2 + m * l**2 / 3 * theta.diff(_t) ** 2 / 2
    end = sp.Matrix([x - l * sp.cos(theta), y - l * sp.sin(theta)]).diff(_t)
    tip = Contact("end", end[1], (end[0],), restitution, friction, hypothesis=hypothesis)
    return ImpulsiveMotion(energy, [x, y, theta], contacts=[tip], at=at)


def block_on_feet(which: str = "right", restitution: Expr = sp.S.Zero) -> ImpulsiveMotion:
    """A uniform block 2 b wide and 2 c high that lands on its feet; c -> 0 is a rod that lands along its length.

    ``which``: "right": it rocked about its left foot and comes down on the right one, which sticks (Housner 1963);
    "both": it falls freely and both feet stick at once; "smooth": both feet at once, without friction, with Newton's e.
    """
    moment = m * (b**2 + c**2) / 3
    energy = m * (VX**2 + VY**2) / 2 + moment * theta.diff(_t) ** 2 / 2
    spin = theta.diff(_t)
    left = {"left x": VX + c * spin, "left y": VY - b * spin}
    right = {"right x": VX + c * spin, "right y": VY + b * spin}
    coordinates = [theta, x, y]  # the first are kept as independent
    if which == "right":
        return ImpulsiveMotion(energy, coordinates, before=left, imposed=right)
    if which == "both":
        return ImpulsiveMotion(energy, coordinates, imposed={**left, **right})
    feet = [
        Contact(n, v, restitution=restitution, friction=0)
        for n, v in (("left", left["left y"]), ("right", right["right y"]))
    ]
    return ImpulsiveMotion(energy, coordinates, contacts=feet)


def knife_edge(at: Mapping[Expr, Expr] | None = None) -> ImpulsiveMotion:
    """A Chaplygin sleigh that slides freely until its blade, c behind the mass centre, bites: from then no side slip
    there."""
    energy = m * (VX**2 + VY**2) / 2 + I * theta.diff(_t) ** 2 / 2
    side = -VX * sp.sin(theta) + VY * sp.cos(theta) - c * theta.diff(_t)
    return ImpulsiveMotion(energy, [x, y, theta], imposed={"blade": side}, at=at)


def upright_disc(restitution: Expr = e, at: Mapping[Expr, Expr] | None = None) -> ImpulsiveMotion:
    """A disc kept upright that rolls on its edge, heading phi, and whose rim meets the smooth wall x = 0.

    I is the moment about its axle, J about its vertical diameter. The rim's nearest point is a cos(phi) before the
    centre.
    """
    rim = Contact("rim", RIM_GAP.diff(_t), restitution=restitution, friction=0)
    return _rolling_disc(contacts=[rim], at=at)


def penny(at: Mapping[Expr, Expr] | None = None) -> ImpulsiveMotion:
    """The same disc; the wall is a surface that its path meets, without a law of restitution."""
    return _rolling_disc(instant={"wall": RIM_GAP}, at=at)


def _rolling_disc(**given: Any) -> ImpulsiveMotion:
    energy = m * (VX**2 + VY**2) / 2 + I * theta.diff(_t) ** 2 / 2 + J * phi.diff(_t) ** 2 / 2
    roll = {
        "roll x": VX - a * theta.diff(_t) * sp.cos(phi),
        "roll y": VY - a * theta.diff(_t) * sp.sin(phi),
    }
    return ImpulsiveMotion(energy, [theta, phi, x, y], nonhol_coneqs=roll, **given)


def ellipsoid_on_wall(
    restitution: Expr = e, friction: Expr = 0, values: Mapping[Expr, Expr] | None = None
) -> ImpulsiveMotion:
    """A homogeneous ellipsoid, one axis along z, against the plane x = 0.

    The contact lies at (-reach, -offset, 0) from the centre and the moments are I_xx, I_yy, I_zz, I_xy, so that the
    answer is rational; `ellipsoid_values` gives such ``values`` for half-axes a, b, c and the angle of the first axis to the
    normal.
    """
    given = dict(values or {})
    inertia = sp.Matrix([[IXX, IXY, 0], [IXY, IYY, 0], [0, 0, IZZ]]).xreplace(given)
    spin = sp.Matrix([WX, WY, WZ])
    energy = m * (VX**2 + VY**2 + VZ**2) / 2 + (spin.T * inertia * spin)[0] / 2
    normal, *tangents = _contact_velocity((-reach.xreplace(given), -offset.xreplace(given), sp.S.Zero))
    contact = Contact("wall", normal, tuple(tangents), restitution, friction)
    return ImpulsiveMotion(energy, [x, y, z], speeds=[VX, VY, VZ, WX, WY, WZ], contacts=[contact])


def ellipsoid_values(angle: Expr) -> dict[Expr, Expr]:
    """Support point and moments of the ellipsoid with half-axes a, b, c whose first axis is turned by ``angle`` about
    z."""
    cos, sin = sp.cos(angle), sp.sin(angle)
    turn = sp.Matrix([[cos, -sin, 0], [sin, cos, 0], [0, 0, 1]])
    moments = turn * sp.diag(b**2 + c**2, a**2 + c**2, a**2 + b**2) * turn.T * m / 5
    # the point where the tangent plane has the normal -x: -S n / sqrt(n . S n), S the square of the half-axes
    far = sp.sqrt(a**2 * cos**2 + b**2 * sin**2)
    return {
        reach: far,
        offset: (a**2 - b**2) * sin * cos / far,
        IXX: moments[0, 0],
        IYY: moments[1, 1],
        IZZ: moments[2, 2],
        IXY: moments[0, 1],
    }


def double_pendulum(
    restitution: Expr = e, friction: Expr = mu, hypothesis: str = "newton", at: Mapping[Expr, Expr] | None = None
) -> ImpulsiveMotion:
    """Two equal uniform rods of length l, hinged, hung from a pivot; the free end strikes a floor (Kane and Levinson
    1985).

    theta and phi are the rods' angles from the downward vertical.
    """
    w1, w2 = theta.diff(_t), phi.diff(_t)
    first = sp.Matrix([l / 2 * sp.sin(theta), -l / 2 * sp.cos(theta)]).diff(_t)
    second = sp.Matrix([l * sp.sin(theta) + l / 2 * sp.sin(phi), -l * sp.cos(theta) - l / 2 * sp.cos(phi)]).diff(_t)
    tip = sp.Matrix([l * sp.sin(theta) + l * sp.sin(phi), -l * sp.cos(theta) - l * sp.cos(phi)]).diff(_t)
    energy = m * (first.dot(first) + second.dot(second)) / 2 + m * l**2 / 12 * (w1**2 + w2**2) / 2
    end = Contact("tip", tip[1], (tip[0],), restitution, friction, hypothesis=hypothesis)
    return ImpulsiveMotion(energy, [theta, phi], contacts=[end], at=at)
