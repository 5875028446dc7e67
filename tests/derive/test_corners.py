"""Corner conditions of nonholonomic impacts: the penny, the paper's ball, a wall that moves; against a stiff spring."""

import numpy as np
import pytest
import sympy as sp
from examples import bodies
from reference.spring_walls import after_spring
from sympy.physics.mechanics import dynamicsymbols

from carom.derive import ImpulsiveMotion, corner_conditions, corner_jump
from carom.derive.paper import ledger as model
from carom.derive.system import is_zero
from carom.errors import CaromError
from carom.laws.conventional import mirror_root

A, M, AXLE, DIAMETER = 0.7, 1.3, 0.4, 0.25  # of the disc: radius, mass, moments about its axle and its diameter


def moving_bead():
    """A bead on a plane whose wall x = s(t) comes at the speed v."""
    m, v = sp.symbols("m v", positive=True)
    x, y = dynamicsymbols("x y")
    energy = m * (x.diff() ** 2 + y.diff() ** 2) / 2
    return ImpulsiveMotion(energy, [x, y], instant={"wall": x - v * dynamicsymbols._t}), v


CASES = {
    "penny": lambda: bodies.penny(at={bodies.phi: sp.pi / 3}),
    "ball": model.smooth_wall,
    "moving wall": lambda: moving_bead()[0],
}


@pytest.mark.parametrize("name", CASES)
def test_the_jump_and_going_on_are_the_solutions_of_the_conditions(name):
    motion = CASES[name]()
    jump = corner_jump(motion)
    conditions = corner_conditions(motion)
    swap = dict(zip(motion.speeds.after, jump.after.values(), strict=True))
    through = dict(zip(motion.speeds.after, motion.u0, strict=True))
    for equation in conditions:
        assert is_zero(equation.lhs.subs(swap) - equation.rhs.subs(swap))
        assert is_zero(equation.lhs.subs(through) - equation.rhs.subs(through))
    # one condition is quadratic and as many as unknowns are there, so these are all
    assert len(conditions) == len(motion.speeds.names)
    wrong = {u: 2 * value for u, value in swap.items()}
    assert not all(is_zero(e.lhs.subs(wrong) - e.rhs.subs(wrong)) for e in conditions)


def test_a_moving_wall_does_work():
    motion, v = moving_bead()
    jump = corner_jump(motion)
    x0 = motion.speeds.before[0]
    assert is_zero(jump.after[motion.speeds.names[0]] - (2 * v - x0))
    assert is_zero(jump.energy_change - jump.impulses["wall"] * v)


def test_the_ball_is_reflected_as_by_the_mirror_root_and_meets_17():
    jump = corner_jump(model.smooth_wall())
    after = dict(zip(model.FIRST, jump.after.values(), strict=True))
    a, kappa = model.a, sp.Symbol("kappa", positive=True)
    v, w = (model.x0, model.y0, sp.S.Zero), (-model.y0 / a, model.x0 / a, model.wz0)
    v1, w1 = mirror_root(v, w, (1, 0, 0), a, kappa)
    relations = model.smooth_wall().pre_relations
    for found, wanted in zip((*model.FIRST,), (*v1, *w1), strict=True):
        assert is_zero((after[found] - wanted).subs(relations)), found
    # (17): both sides are zero, since neither spin about the line of the two contacts changes
    assert is_zero((after[model.wx1] - model.wx0).subs(relations))
    assert is_zero(after[model.wz1] - model.wz0)


def disc_spring(phi, stiffness):
    """The disc of docs/examples/bodies.py with the coordinates (theta, phi, x, y)."""
    speeds = (-2.0, 0.8)
    start = np.array([0.0, phi, A * np.cos(phi), 0.0])
    u = np.array([*speeds, A * speeds[0] * np.cos(phi), A * speeds[0] * np.sin(phi)])

    def constraints(q):
        return np.array([[-A * np.cos(q[1]), 0, 1, 0], [-A * np.sin(q[1]), 0, 0, 1]])

    def gap(q):
        return q[2] - A * np.cos(q[1]), np.array([0, A * np.sin(q[1]), 1, 0])

    return u, after_spring(np.diag([AXLE, DIAMETER, M, M]), lambda q, u: u, constraints, gap, (start, u), stiffness)


def ball_spring(stiffness):
    """A solid ball of radius A that rolls on the floor; its quasi-velocities are (x', y', omega_x, omega_y, omega_z)."""
    u = np.array([-1.0, 0.6, -0.6 / A, -1.0 / A, 0.9])
    roll = np.array([[1, 0, 0, -A, 0], [0, 1, A, 0, 0]])
    mass = np.diag([M, M, *[0.4 * M * A * A] * 3])
    start = np.array([A, 0.0])
    normal = np.array([1.0, 0, 0, 0, 0])
    return u, after_spring(
        mass, lambda _q, u: u[:2], lambda _q: roll, lambda q: (q[0] - A, normal), (start, u), stiffness
    )


def test_a_stiff_spring_tends_to_the_corner():
    phi = np.pi / 3
    motion = bodies.penny(at={bodies.phi: sp.pi / 3})
    jump = corner_jump(motion)
    numbers = {bodies.a: A, bodies.m: M, bodies.I: AXLE, bodies.J: DIAMETER}
    errors = []
    for stiffness in (1e6, 1e8):
        u, found = disc_spring(phi, stiffness)
        before = numbers | dict(zip(motion.speeds.before, u, strict=True))
        wanted = np.array([float(value.subs(before)) for value in jump.after.values()])
        errors.append(np.abs(found - wanted).max())
    assert errors[1] < 2e-3
    assert 5 < errors[0] / errors[1] < 20  # 1/sqrt(stiffness)
    u, found = ball_spring(1e6)
    jump = corner_jump(model.smooth_wall())
    numbers = {model.a: A, model.m: M, model.I: 0.4 * M * A * A, model.x0: u[0], model.y0: u[1], model.wz0: u[4]}
    numbers |= {model.wx0: u[2], model.wy0: u[3]}
    wanted = [
        float(value.subs(numbers))
        for name, value in zip(model.FIRST, jump.after.values(), strict=True)
        if name != model.z1
    ]
    assert np.abs(found - wanted).max() < 1e-7  # (its constraints do not turn, so that a soft spring does as well)


def test_bad_input():
    motion = bodies.upright_disc()
    with pytest.raises(CaromError, match=r"corner: instant: expected the surface .* got no instant constraint"):
        corner_jump(motion)
    with pytest.raises(CaromError, match="expected one surface, got 3: wall x, wall y, wall z"):
        corner_jump(model.conventional())
    x, y = dynamicsymbols("x y")
    held = ImpulsiveMotion(x.diff() ** 2 + y.diff() ** 2, [x, y], hol_coneqs={"rail": x}, instant={"wall": x})
    with pytest.raises(CaromError, match="a surface that the constraints let the body approach, got wall"):
        corner_jump(held)
