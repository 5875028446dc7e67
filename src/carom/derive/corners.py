"""Impacts as corners of a path: the conditions of Weierstrass and Erdmann, with nonholonomic constraints.

A path that meets the surface h(q, t) = 0 has a corner there. By the principle of Lagrange and d'Alembert the variations of the
corner's place respect the constraints A(q) u = 0 and stay on the surface, those of its time shift it along the path, so that

    p1 - p0 = lambda dh + mu A             the momentum jumps within the span of the surface's and the constraints' forms   (C1)
    E1 - E0 = -lambda dh/dt                the energy is kept, up to the work of a surface that moves                       (C2)
    A u1 = 0                               the constraints go on                                                           (C3)

(W. Clark and A. Bloch, "The bouncing penny and nonholonomic impacts", IEEE Conference on Decision and Control 2019,
arXiv:1909.11192; derived here from the principle). Besides lambda = 0, a path that goes on through the surface, they leave
one solution: the velocity that the constraints allow is mirrored, in the metric of the kinetic energy, on the surface's tangent.
"""

from __future__ import annotations

import copy
from dataclasses import replace
from typing import Any

import sympy as sp

from carom.derive.delassus import delassus
from carom.derive.impulsive import ImpulsiveMotion
from carom.derive.jump import Jump
from carom.derive.linear import Expr, is_zero, tidy
from carom.derive.system import ConstraintRow
from carom.errors import CaromError, Fault

__all__ = ["corner_conditions", "corner_jump"]


def corner_conditions(motion: ImpulsiveMotion) -> list[Any]:
    """Return the conditions (C1) to (C3) of a corner of the path, without their multipliers.

    Parameters
    ----------
    motion : ImpulsiveMotion
        Its ``instant`` constraint is the surface: an expression of the coordinates (and the time) that vanishes there. More of
        them at the same instant, such as a contact that does not slip, widen the span in (C1); the conditions are then too few.

    Returns
    -------
    list of Eq
        In the symbols ``motion.speeds.after`` and ``motion.speeds.before``: the momenta along the virtual displacements, the
        constraints that go on, the energy.

    Raises
    ------
    CaromError
        No instant constraint, or several of which one moves.

    Examples
    --------
    >>> import sympy as sp
    >>> from sympy.physics.mechanics import dynamicsymbols
    >>> from carom.derive import ImpulsiveMotion, corner_conditions
    >>> m = sp.Symbol("m", positive=True)
    >>> x, y = dynamicsymbols("x y")
    >>> motion = ImpulsiveMotion(m * (x.diff() ** 2 + y.diff() ** 2) / 2, [x, y], instant={"wall": x - 1})
    >>> for equation in corner_conditions(motion):
    ...     print(equation.lhs)
    -m*(ydot0 - ydot1)
    -m*(xdot0**2 - xdot1**2 + ydot0**2 - ydot1**2)/2
    """
    walls = _walls(motion)
    gain = motion.energy(motion.u1) - motion.energy(motion.u0)
    if any(not is_zero(wall.drift) for wall in walls):
        wall = _only(walls)
        gain += wall.drift * (wall.coefficients * (motion.u1 - motion.u0))[0] / _yield(motion, wall)
    return [e for e in motion.jump_equations() if isinstance(e, sp.Equality)] + [sp.Eq(tidy(sp.expand(gain)), 0)]


def corner_jump(motion: ImpulsiveMotion) -> Jump:
    """Return the jump at a corner of the path: the solution of :func:`corner_conditions` in which the surface pushes.

    Parameters
    ----------
    motion : ImpulsiveMotion
        With one ``instant`` constraint, the surface.

    Returns
    -------
    Jump

    Raises
    ------
    CaromError
        Another number of instant constraints, or constraints that allow no motion across the surface.

    Examples
    --------
    A sledge on a blade that meets a wall at an angle: the blade holds, so it goes back the way it came.

    >>> import sympy as sp
    >>> from sympy.physics.mechanics import dynamicsymbols
    >>> from carom.derive import ImpulsiveMotion, corner_jump
    >>> m, phi = sp.symbols("m phi", positive=True)
    >>> x, y = dynamicsymbols("x y")
    >>> blade = {"blade": x.diff() * sp.sin(phi) - y.diff() * sp.cos(phi)}
    >>> energy = m * (x.diff() ** 2 + y.diff() ** 2) / 2
    >>> jump = corner_jump(ImpulsiveMotion(energy, [x, y], nonhol_coneqs=blade, instant={"wall": x}))
    >>> jump.after[x.diff()], jump.energy_change
    (-xdot0, 0)
    """
    wall = _only(_walls(motion))
    _yield(motion, wall)
    # (C2) with (C1) and (C3) is lambda (h1' + h0') = 0: with lambda, the gap opens as fast as it closed, as with e = 1
    bounced = copy.copy(motion)
    bounced.imposed = [replace(row, closing=sp.S.One) if row is wall else row for row in motion.imposed]
    return bounced.solve()


def _walls(motion: ImpulsiveMotion) -> list[ConstraintRow]:
    found = [row for row in motion.imposed if row.closing is None]
    if not found:
        raise CaromError(
            Fault(
                "corner", "instant", "the surface that the path meets, as instant={'wall': h}", "no instant constraint"
            )
        )
    return found


def _only(walls: list[ConstraintRow]) -> ConstraintRow:
    if len(walls) > 1:
        raise CaromError(
            Fault(
                "corner", "instant", "one surface", f"{len(walls)}: {', '.join(w.name for w in walls)}",
                "the conditions leave a family of solutions then; close it with ImpulsiveMotion.close(...)",
            )
        )  # fmt: skip
    return walls[0]


def _yield(motion: ImpulsiveMotion, wall: ConstraintRow) -> Expr:
    """Return a . w, the velocity across the surface that a unit impulse along a = dh gives while the constraints hold."""
    found = delassus(motion.mass, [wall], motion.permanent, f"surface {wall.name}")[0, 0]
    if is_zero(found):
        raise CaromError(
            Fault("corner", "instant", "a surface that the constraints let the body approach", f"{wall.name}")
        )
    return found
