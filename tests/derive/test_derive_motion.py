"""Impulsive motion: two derivations on every body, published results, restitution, redundancy, bad input."""

import functools

import numpy as np
import pytest
import sympy as sp
from examples import bodies
from sympy.physics.mechanics import LagrangesMethod, Point, ReferenceFrame, dynamicsymbols

from carom.derive import Contact, EnergyGain, FrictionJam, ImpulsiveMotion, contact_at
from carom.derive.system import is_zero, tidy
from carom.errors import CaromError

R = sp.Rational
t = dynamicsymbols._t
q1, q2, s = dynamicsymbols("q1 q2 s")
m, l, g, k = sp.symbols("m l g k", positive=True)  # noqa: E741

AT_ANGLE = {bodies.phi: sp.pi / 3}


# an ellipsoid with half-axes 2, 1, 3 turned by 45 degrees
TILTED = {k: v.subs({bodies.a: 2, bodies.b: 1, bodies.c: 3}) for k, v in bodies.ellipsoid_values(sp.pi / 4).items()}

CASES = {
    "ball on a wall, stick": (lambda: bodies.ball_on_wall(tangential=bodies.beta), None),
    "ball on a wall, slide": (lambda: bodies.ball_on_wall(friction=bodies.mu), "slide"),
    "ball on a wall, Poisson": (
        lambda: ImpulsiveMotion(
            bodies.ball_on_wall().lagrangian,
            [bodies.x, bodies.y, bodies.z],
            speeds=bodies.ball_on_wall().speeds.names,
            contacts=[Contact("wall", bodies.VX, (bodies.VY - bodies.a * bodies.WZ,), bodies.e, hypothesis="poisson")],
        ),
        None,
    ),
    "rolled ball on a wall": (lambda: bodies.ball_on_wall(before=bodies.rolling()), None),
    "ball onto the floor": (lambda: bodies.ball_on_wall(imposed=bodies.rolling()), "open"),
    "ball in a corner, rough": (bodies.ball_in_corner, None),
    "ball in a corner, smooth": (lambda: bodies.ball_in_corner(bodies.e, 0), None),
    "rod on one end, stick": (bodies.rod_on_one_end, None),
    "rod on one end, smooth": (bodies.rod_on_one_end, "smooth"),
    "rod on one end, Poisson": (
        lambda: bodies.rod_on_one_end(hypothesis="poisson", at={bodies.theta: sp.pi / 4}),
        None,
    ),
    "block on its right foot": (bodies.block_on_feet, None),
    "block on both feet": (lambda: bodies.block_on_feet("both"), None),
    "block on smooth feet": (lambda: bodies.block_on_feet("smooth", bodies.e), None),
    "Chaplygin sleigh": (bodies.knife_edge, None),
    "disc on edge": (lambda: bodies.upright_disc(at=AT_ANGLE), None),
    "ellipsoid, smooth": (bodies.ellipsoid_on_wall, None),
    "ellipsoid, stick": (lambda: bodies.ellipsoid_on_wall(friction=sp.oo, values=TILTED), None),
}


@functools.cache
def solved(name):
    """Return the motion of a case, its modes, and the jump by multipliers."""
    build, modes = CASES[name]
    motion = build()
    return motion, modes, motion.solve("multipliers", modes)


@pytest.mark.parametrize("name", CASES)
@pytest.mark.slow(keep=4)
def test_both_derivations_agree_symbolically(name):
    motion, modes, one = solved(name)
    other = motion.solve("virtual", modes)
    for u in motion.speeds.names:
        assert is_zero(one.after[u] - other.after[u]), u
    assert set(one.impulses) == set(other.impulses)
    for label in one.impulses:
        assert is_zero(one.impulses[label] - other.impulses[label]), label
    # and both meet the equations they came from: momenta along virtual displacements, then the closing ones
    if not any(c.hypothesis == "poisson" for c in motion.contacts):
        swap = dict(zip(motion.speeds.after, one.after.values(), strict=True))
        for equation in motion.jump_equations(modes):
            assert equation in (True, sp.true) or is_zero((equation.lhs - equation.rhs).subs(swap))


@pytest.mark.parametrize("name", CASES)
def test_energy_change_is_the_work_of_the_impulses(name):
    # Kelvin: each impulse works on the mean of its velocity before and after
    motion, _modes, jump = solved(name)
    rows = {
        r.name: r for r in [*motion.permanent, *motion.imposed, *(r for c in motion.contact_rows.values() for r in c)]
    }
    u1 = sp.Matrix([jump.after[u] for u in motion.speeds.names])
    work = sum(
        impulse * ((rows[name].coefficients * (motion.u0 + u1))[0] / 2 + rows[name].drift)
        for name, impulse in jump.impulses.items()
    )
    assert is_zero(work - jump.energy_change)


# -- published results ------------------------------------------------------------------------------------------------


def test_rod_jams_above_four_thirds():
    """Painlevé's rod: the least friction that can jam a uniform rod is 4/3.

    Génot & Brogliato, Eur. J. Mech. A 18, 653 (1999); Hogan & Kristiansen, Proc. R. Soc. A 473, 20160773 (2017): mu_P =
    2 sqrt(1 + alpha) / alpha with alpha = 3.
    """
    critical = bodies.rod_on_one_end().jam_friction("end")
    tangent = sp.Symbol("T", positive=True)  # tan(theta)
    value = critical.subs(bodies.theta, sp.atan(tangent))
    best = sp.solve(sp.diff(sp.simplify(value), tangent), tangent)
    assert best == [2]
    assert sp.simplify(value.subs(tangent, 2)) == R(4, 3) == 2 * sp.sqrt(1 + 3) / 3


def test_rod_that_lands_flat_on_one_end_rises_at_half_its_speed():
    # Irodov, Problems in General Physics, part 1.5: a stick, falling level, that strikes elastically with one end
    motion = bodies.rod_on_one_end(restitution=1, friction=0)
    jump = motion.solve().subs({bodies.theta: 0})
    v = sp.Symbol("v", positive=True)
    pre = dict(zip(motion.speeds.before, (0, -v, 0), strict=True))
    assert jump.subs(pre).after[bodies.VY] == -v / 2
    assert jump.subs(pre).energy_change == 0


def test_rocking_block_loses_what_housner_says():
    # Housner, Bull. Seismol. Soc. Am. 53, 403 (1963): omega1/omega0 = 1 - (3/2) sin^2 alpha, tan alpha = b/c
    jump = bodies.block_on_feet("right").solve()
    alpha = sp.Symbol("alpha", positive=True)
    rate = jump.after[bodies.theta.diff(t)] / sp.Symbol("thetadot0", real=True)
    assert is_zero(rate.subs(bodies.b, bodies.c * sp.tan(alpha)) - (1 - R(3, 2) * sp.sin(alpha) ** 2))
    # a rod is the flat limit: it turns on at minus half the speed, that is, its far foot cannot stay down
    assert sp.limit(rate, bodies.c, 0) == -R(1, 2)


def test_superball_comes_back_after_three_bounces():
    """Garwin, Am. J. Phys. 37, 88 (1969): thrown under a table, a superball returns after floor, table and floor."""
    kappa = R(2, 5)
    motion = bodies.ball_on_wall(restitution=1, tangential=1)
    jump = motion.solve()
    y0, w0 = sp.Symbol("ydot0", real=True), sp.Symbol("omega_z0", real=True)
    speed, spin = (sp.expand(jump.after[u].subs({bodies.kappa: kappa, bodies.a: 1})) for u in (bodies.VY, bodies.WZ))
    # y' = (3 y + 4 a w)/7, a w' = (10 y - 3 a w)/7
    assert speed == R(3, 7) * y0 + R(4, 7) * w0
    assert spin == R(10, 7) * y0 - R(3, 7) * w0
    y, w = sp.S.One, sp.S.Zero
    for side in (1, -1, 1):  # the underside of the table turns the sense of the spin
        y, w = (
            speed.subs({y0: y, w0: side * w}, simultaneous=True),
            side * spin.subs({y0: y, w0: side * w}, simultaneous=True),
        )
    assert y == -R(333, 343)


def test_smooth_corner_sends_the_ball_straight_back():
    jump = bodies.ball_in_corner(1, 0).solve()
    for u, before in zip((bodies.VX, bodies.VY, bodies.VZ), sp.symbols("xdot0 ydot0 zdot0", real=True), strict=True):
        assert jump.after[u] == -before
    assert jump.energy_change == 0


def test_smooth_ellipsoid_is_a_particle_of_its_effective_mass():
    # 1/m_n = 1/m + (r x n)^2 / I, e.g. Brach, Mechanical Impact Dynamics (1991)
    motion = bodies.ellipsoid_on_wall()
    jump = motion.solve()
    effective = 1 / (1 / bodies.m + bodies.offset**2 / bodies.IZZ)
    approach = motion.velocity(motion.contacts[0].normal)
    assert is_zero(jump.impulses["wall.n"] + (1 + bodies.e) * effective * approach)
    sphere = bodies.ellipsoid_values(sp.pi / 5)
    sphere = {key: value.subs({bodies.b: bodies.a, bodies.c: bodies.a}) for key, value in sphere.items()}
    assert tidy(sphere[bodies.offset]) == 0
    assert tidy(sphere[bodies.reach] - bodies.a) == 0
    assert tidy(sphere[bodies.IZZ] - R(2, 5) * bodies.m * bodies.a**2) == 0


def test_ellipsoid_support_point_touches_the_wall():
    # the point lies on the ellipsoid, and the ellipsoid's normal there is the wall's
    angle, values = R(7, 10), bodies.ellipsoid_values(R(7, 10))
    arm = sp.Matrix([-values[bodies.reach], -values[bodies.offset]])
    turn = sp.Matrix([[sp.cos(angle), -sp.sin(angle)], [sp.sin(angle), sp.cos(angle)]])
    shape = turn * sp.diag(1 / bodies.a**2, 1 / bodies.b**2) * turn.T
    assert is_zero((arm.T * shape * arm)[0] - 1)
    assert is_zero((shape * arm)[1])


def test_upright_disc_reflects_in_the_metric_of_its_energy():
    # e = 1: the allowed velocities (theta', phi') are mirrored in the kinetic metric on the wall's tangent
    motion = bodies.upright_disc(restitution=1, at=AT_ANGLE)
    jump = motion.solve()
    metric = sp.diag(bodies.I + bodies.m * bodies.a**2, bodies.J)
    row = sp.Matrix([[sp.cos(sp.pi / 3), sp.sin(sp.pi / 3)]])
    u = sp.Matrix(motion.speeds.before[:2])
    mirrored = u - 2 * metric.inv() * row.T * (row * u) / (row * metric.inv() * row.T)[0]
    assert is_zero(jump.after[bodies.theta.diff(t)] - mirrored[0])
    assert is_zero(jump.after[bodies.phi.diff(t)] - mirrored[1])
    assert jump.energy_change == 0


def test_sleigh_keeps_angular_momentum_about_its_blade():
    motion = bodies.knife_edge(at={bodies.theta: 0})
    jump = motion.solve()
    spin0, side0 = sp.symbols("thetadot0 ydot0", real=True)
    spin = jump.after[bodies.theta.diff(t)]
    assert is_zero(spin * (bodies.I + bodies.m * bodies.c**2) - (bodies.I * spin0 + bodies.m * bodies.c * side0))
    assert jump.after[bodies.VX] == sp.Symbol("xdot0", real=True)


# -- in the manner of sympy.physics.mechanics ------------------------------------------------------------------------


def cart():
    """A pendulum on a cart, as SymPy tutorials have it."""
    x, angle = dynamicsymbols("x theta")
    big = sp.Symbol("M", positive=True)
    bob = sp.Matrix([x + l * sp.sin(angle), -l * sp.cos(angle)]).diff(t)
    return x, angle, big, (big * x.diff(t) ** 2 + m * bob.dot(bob)) / 2 + m * g * l * sp.cos(angle)


def test_the_same_lagrangian_as_lagranges_method():
    x, angle, big, lagrangian = cart()
    smooth = LagrangesMethod(lagrangian, [x, angle])
    smooth.form_lagranges_equations()
    motion = ImpulsiveMotion(lagrangian, [x, angle], imposed={"buffer": x.diff(t)}, forcelist=[], frame=None)
    assert (motion.mass - smooth.mass_matrix).applyfunc(sp.simplify) == sp.zeros(2)
    jump = motion.solve()
    v, w = motion.speeds.before
    assert jump.after[x.diff(t)] == 0
    assert is_zero(jump.after[angle.diff(t)] - (w + v * sp.cos(angle) / l))
    assert is_zero(jump.impulses["buffer"] + v * (big + m - m * sp.cos(angle) ** 2))


def test_contact_from_points_and_frames():
    N = ReferenceFrame("N")
    A = N.orientnew("A", "Axis", [q1, N.z])
    O, P = Point("O"), Point("P")  # noqa: E741
    O.set_vel(N, 0)
    P.set_pos(O, l * A.x)
    P.v2pt_theory(O, N, A)
    tip = contact_at("tip", P, N, (N.y, N.x), restitution=R(1, 2), friction=0)
    motion = ImpulsiveMotion(m * l**2 * q1.diff(t) ** 2 / 2, [q1], contacts=[tip])
    assert motion.solve().after[q1.diff(t)] == -motion.speeds.before[0] / 2
    with pytest.raises(CaromError, match="not orthonormal"):
        contact_at("tip", P, N, (N.y, A.x))


def test_holonomic_constraint_outside_impulse_and_drift():
    x, y = dynamicsymbols("x y")
    T = m * (x.diff(t) ** 2 + y.diff(t) ** 2) / 2
    push = sp.Symbol("P")
    motion = ImpulsiveMotion(T, [x, y], hol_coneqs=[x**2 + y**2 - l**2], impulse={x.diff(t): push}, at={x: 0, y: l})
    jump = motion.solve()
    assert is_zero(jump.after[x.diff(t)] - motion.speeds.before[0] - push / m)
    assert jump.after[y.diff(t)] == 0
    belt = sp.Symbol("w")
    caught = ImpulsiveMotion(T, [x, y], imposed={"belt": x.diff(t) - belt}).solve()
    assert caught.after[x.diff(t)] == belt
    assert is_zero(caught.impulses["belt"] - m * (belt - sp.Symbol("xdot0", real=True)))


def test_a_gyroscopic_term_takes_no_part_in_the_jump():
    x, y = dynamicsymbols("x y")
    field = sp.Symbol("B")
    T = m * (x.diff(t) ** 2 + y.diff(t) ** 2) / 2
    plain = ImpulsiveMotion(T, [x, y], imposed=[x.diff(t) - y.diff(t)])
    charged = ImpulsiveMotion(T + field * (x * y.diff(t) - y * x.diff(t)), [x, y], imposed=[x.diff(t) - y.diff(t)])
    assert plain.solve().after == charged.solve().after


def test_a_slide_says_under_which_conditions_it_stands():
    motion = bodies.ball_on_wall(friction=bodies.mu)
    jump = motion.solve(modes="slide")
    state = dict(zip(motion.speeds.before, (-1, 3, 0, 0, 0, 0), strict=True)) | {bodies.e: 1, bodies.kappa: R(2, 5)}
    # the slip that is left is 3 - 7 mu: it slides throughout up to mu = 3/7
    for friction, stands in ((R(42, 100), True), (R(44, 100), False)):
        seen = {
            k: bool(v.subs(state | {bodies.mu: friction, bodies.a: 1, bodies.m: 1})) for k, v in jump.conditions.items()
        }
        assert seen["wall goes on sliding"] is stands
        assert seen["wall approaches"]
        assert seen["wall pushes"]
        assert seen["wall does not jam"]


# -- redundancy and singular attitudes -------------------------------------------------------------------------------


def test_redundant_constraints_are_named_and_their_split_left_open():
    ball = bodies.ball_on_wall(nonhol_coneqs=bodies.rolling(), restitution=0)
    assert ball.redundancy() == {"wall.t2": {"floor x": -1, "floor z": 1, "wall.n": 1}}
    jump = ball.solve()
    (free,) = jump.free_impulses
    momentum = m * 0 + bodies.m * (jump.after[bodies.VX] - sp.Symbol("xdot0", real=True))
    # whatever the split, the impulses along x are the change of momentum
    assert is_zero(jump.impulses["wall.n"] + jump.impulses["floor x"] - momentum)
    assert jump.impulses["wall.t2"] == free
    assert "redundant" in jump.notes[0]


def test_contradictory_constraints_are_refused():
    x = dynamicsymbols("x")
    T = m * x.diff(t) ** 2 / 2
    with pytest.raises(CaromError, match="two contradicts one"):
        ImpulsiveMotion(T, [x], imposed={"one": x.diff(t), "two": x.diff(t) - 1}).solve()
    with pytest.raises(CaromError, match="right contradicts left"):
        ImpulsiveMotion(T, [x], nonhol_coneqs={"left": x.diff(t) - 2, "right": 2 * x.diff(t) - 1})
    with pytest.raises(CaromError, match="restitution asks for another velocity"):
        bodies.ball_in_corner(bodies.e).solve()


def test_singular_attitude_is_told_and_has_a_limit():
    from carom.derive.paper import ledger as model

    motion = model.both_contacts()
    rate = model.PHI.diff(t)
    column = motion.virtual_displacements([rate])
    assert column[4] == 1
    at = {model.THETA: sp.pi / 2, model.PSI: sp.S.Zero, model.PHI: sp.S.Zero}
    fixed = model._angles(nonhol_coneqs=model.floor_rows(), instant=model.wall_rows())
    fixed = ImpulsiveMotion(
        fixed.lagrangian,
        fixed.coordinates,
        at=at,
        nonhol_coneqs={name: row.xreplace(model.LIFTED) for name, row in model.floor_rows().items()},
        instant={name: row.xreplace(model.LIFTED) for name, row in model.wall_rows().items()},
    )
    with pytest.raises(CaromError, match=r"varphi.*cannot parametrise.*speeds that move: .*theta.*psi"):
        fixed.virtual_displacements([rate])
    limit = motion.displacement_limit(rate, at)
    # the limit is the one allowed displacement at the attitude itself
    assert sp.Matrix.hstack(limit, fixed.virtual_displacements()).rank() == 1


def test_euler_angles_fail_upright_and_the_message_names_the_idle_motion():
    from carom.derive.paper import ledger as model

    up = model._angles()
    with pytest.raises(
        CaromError, match=r"mass matrix: singular; the motion .*varphi.*psi.* carries no kinetic energy"
    ):
        ImpulsiveMotion(up.lagrangian, up.coordinates, at={model.THETA: 0})


# -- closing hypotheses ----------------------------------------------------------------------------------------------


def test_closing_equations_of_ones_own():
    from carom.derive.paper import ledger as model

    motion = model.conventional()
    with pytest.raises(CaromError, match="closing"):
        motion.solve()
    energy = motion.energy(motion.u1) - motion.energy(motion.u0)
    roots = motion.close([model.x1 + model.x0, energy])
    assert len(roots) == 2
    assert all(r.energy_change == 0 for r in roots)
    with pytest.raises(CaromError, match="family"):
        motion.close([model.x1 + model.x0])
    with pytest.raises(CaromError, match="no speeds meet"):
        motion.close([model.x1 + model.x0, model.x1 - model.x0 - 1, model.x0 - 5 + model.x1])


def test_newton_poisson_and_stronge_agree_on_a_central_contact_only():
    ball = bodies.ball_on_wall(before=bodies.rolling()).solve()
    poisson = Contact(
        "wall",
        bodies.VX,
        (bodies.VY - bodies.a * bodies.WZ, bodies.VZ + bodies.a * bodies.WY),
        bodies.e,
        hypothesis="poisson",
    )
    other = ImpulsiveMotion(
        bodies.ball_on_wall().lagrangian,
        [bodies.x, bodies.y, bodies.z],
        speeds=bodies.ball_on_wall().speeds.names,
        before=bodies.rolling(),
        contacts=[poisson],
    ).solve()
    assert all(is_zero(ball.after[u] - other.after[u]) for u in ball.after)
    pendulum = bodies.double_pendulum(at=HANGING)
    ends = {h: pendulum.percussion("tip", pendulum_values(), h) for h in ("newton", "poisson", "stronge")}
    assert {h: [p.kind for p in r.phases] for h, r in ends.items()} == {h: ["slip", "reverse"] for h in ends}
    assert ends["poisson"].velocity[0] < ends["stronge"].velocity[0] < ends["newton"].velocity[0]
    approach = pendulum.velocity(pendulum.contacts[0].normal).subs(pendulum_values())
    assert abs(ends["newton"].velocity[0] + approach / 2) < 1e-15
    assert abs(ends["poisson"].impulse[0] - ends["poisson"].compression * R(3, 2)) < 1e-15


HANGING = {bodies.theta: (sp.pi / 9).evalf(30), bodies.phi: (sp.pi / 6).evalf(30)}


def pendulum_values(**more):
    """A double pendulum at 20 and 30 degrees whose tip comes down on the floor and slides, e = mu = 1/2."""
    names = sp.symbols("thetadot0 phidot0", real=True)
    given = {
        bodies.l: 1,
        bodies.m: 1,
        bodies.e: R(1, 2),
        bodies.mu: R(1, 2),
        names[0]: -R(1, 10),
        names[1]: -R(1, 5),
    }
    return given | {getattr(bodies, name): value for name, value in more.items()}


def test_kane_and_levinsons_pendulum_gains_energy_under_newtons_rule_only():
    # Kane & Levinson, Dynamics: Theory and Applications (1985): friction that reverses the slip, with Newton's e
    pendulum = bodies.double_pendulum(at=HANGING)
    values = pendulum_values(e=R(9, 10))
    start = pendulum.energy(pendulum.u0).subs(values)
    with pytest.warns(EnergyGain, match="newton's restitution e = 9/10 with friction 1/2 gains"):
        newton = pendulum.percussion("tip", values, "newton")
    assert newton.energy_change / start == pytest.approx(0.298, abs=1e-3)
    for rule in ("poisson", "stronge"):  # silent, and dissipative
        assert pendulum.percussion("tip", values, rule).energy_change / start < -0.3


def test_energy_gain_and_jam_warn():
    x, y = dynamicsymbols("x y")
    # an inverse mass with strong coupling: sticking with Newton's e = 1 gains
    T = (x.diff(t) ** 2 + y.diff(t) ** 2 + R(9, 5) * x.diff(t) * y.diff(t)) / 2
    contact = Contact("c", y.diff(t), (x.diff(t),), restitution=1, friction=2)
    motion = ImpulsiveMotion(
        T, [x, y], contacts=[contact], before={"known": x.diff(t) + y.diff(t), "speed": y.diff(t) + 1}
    )
    with pytest.warns(EnergyGain, match="gains the energy"):
        jump = motion.solve()
    assert jump.energy_change > 0
    back = ImpulsiveMotion(
        T, [x, y], contacts=[contact], before={"known": x.diff(t) - y.diff(t), "speed": y.diff(t) + 1}
    )
    with pytest.warns() as seen:
        back.solve(modes="slide")
    assert {w.category for w in seen} == {FrictionJam, EnergyGain}
    assert any("jams the slip" in str(w.message) for w in seen)
    assert motion.jam_friction("c") == R(10, 9)
    found = back.percussion("c", {})
    assert found.jams


def test_stronge_needs_the_way_there():
    rod = bodies.rod_on_one_end(hypothesis="stronge")
    with pytest.raises(CaromError, match="percussion"):
        rod.solve()


# -- compiled --------------------------------------------------------------------------------------------------------


def test_compiled_for_one_state_and_many():
    motion = bodies.ball_on_wall(before=bodies.rolling())
    jump = motion.solve()
    run = motion.lambdify(jump)
    rng = np.random.default_rng(3)
    numbers = rng.uniform(0.2, 1.0, (len(run.arguments), 5, 4))
    after, impulses, energy = run(*numbers)
    assert after.shape == (5, 4, 6)
    assert impulses.shape == (5, 4, 3)
    at = dict(zip(run.arguments, numbers[:, 2, 3], strict=True))
    assert np.allclose(after[2, 3], [float(v.subs(at)) for v in jump.after.values()], rtol=1e-13)
    assert np.allclose(impulses[2, 3], [float(v.subs(at)) for v in jump.impulses.values()], rtol=1e-13)
    assert np.isclose(energy[2, 3], float(jump.energy_change.subs(at)), rtol=1e-12)
    one = run(*numbers[:, 2, 3])
    assert np.array_equal(one[0], after[2, 3])
    with pytest.raises(CaromError, match="expected 7 arguments"):
        run(1.0)
    with pytest.raises(CaromError, match="also needs"):
        motion.lambdify(jump, run.arguments[:-1])


# -- bad input -------------------------------------------------------------------------------------------------------

x, y = dynamicsymbols("x y")
VX, VY = x.diff(t), y.diff(t)
FLAT = m * (VX**2 + VY**2) / 2

BAD = {
    "not linear": (
        lambda: ImpulsiveMotion(FLAT, [x, y], imposed={"speed": VX**2 - VY}),
        "constraint speed: not linear in the speed",
    ),
    "unknown coordinate": (
        lambda: ImpulsiveMotion(FLAT, [x, y], imposed={"c": VX - s.diff(t)}),
        r"constraint c: unknown .*s\(t\)",
    ),
    "unknown in the Lagrangian": (lambda: ImpulsiveMotion(FLAT + s**2, [x, y]), r"Lagrangian: unknown s\(t\)"),
    "singular mass": (
        lambda: ImpulsiveMotion(m * (VX + VY) ** 2 / 2, [x, y]),
        "mass matrix: singular; the motion .*carries no kinetic",
    ),
    "cubic": (lambda: ImpulsiveMotion(FLAT + VX**3, [x, y]), "not quadratic in the speed"),
    "empty constraint": (
        lambda: ImpulsiveMotion(FLAT, [x, y], imposed={"c": m - 1}),
        "expected an expression of the coordinates or the speeds, got m - 1",
    ),
    "symbol for a coordinate": (lambda: ImpulsiveMotion(FLAT, [m]), "coordinates: expected functions of time"),
    "twice": (lambda: ImpulsiveMotion(FLAT, [x, x]), "coordinates: expected each one once"),
    "name twice": (
        lambda: ImpulsiveMotion(FLAT, [x, y], imposed={"c": VX}, instant={"c": VY}),
        "the name c is given twice",
    ),
    "at": (lambda: ImpulsiveMotion(FLAT, [x, y], at={s: 1}), "is not a coordinate"),
    "impulse": (lambda: ImpulsiveMotion(FLAT, [x, y], impulse={s: 1}), "is not a speed"),
    "restitution": (
        lambda: ImpulsiveMotion(FLAT, [x, y], instant={"c": VX}, restitution={"d": 1}),
        "no instant constraint is named d",
    ),
    "e": (lambda: Contact("c", VX, restitution=R(3, 2)), "restitution: expected a value from 0 to 1, got 3/2"),
    "mu": (lambda: Contact("c", VX, friction=-1), "friction: expected a value from 0 to oo"),
    "hypothesis": (lambda: Contact("c", VX, hypothesis="hertz"), "hypothesis: expected 'newton'"),
    "mode": (
        lambda: ImpulsiveMotion(FLAT, [x, y], contacts=[Contact("c", VX)]).solve(modes={"c": "roll"}),
        "expected one of stick, slide, smooth, open",
    ),
    "contact": (lambda: ImpulsiveMotion(FLAT, [x, y]).delassus("c"), "none is named c"),
    "no slip": (
        lambda: ImpulsiveMotion(FLAT, [x, y], contacts=[Contact("c", VX, friction=1)]).solve(modes="slide"),
        "expected a contact with tangents",
    ),
    "method": (lambda: ImpulsiveMotion(FLAT, [x, y]).solve("magic"), "expected 'multipliers' or 'virtual'"),
    "numbers": (
        lambda: bodies.rod_on_one_end().percussion("end", {}),
        "expected a number for every symbol, got none for",
    ),
    "quasi holonomic": (
        lambda: ImpulsiveMotion(m * q1**2 / 2, [x], speeds=[q1], hol_coneqs=[x]),
        "give its velocity form",
    ),
}


@pytest.mark.parametrize("name", BAD)
def test_bad_input_names_the_culprit(name):
    build, message = BAD[name]
    with pytest.raises(CaromError, match=message) as caught:
        build()
    assert all("\n" not in fault for fault in caught.value.faults)
