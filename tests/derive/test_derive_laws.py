"""The numeric laws of `carom.laws` are what `ImpulsiveMotion` derives: symbolically, branch by branch.

The kernels are run on `Witness` numbers: a SymPy expression that is computed with, and a rational value of it that
decides every comparison. So a kernel runs its own code along one branch, and what it returns is an expression, exact
for every state of that branch, which is compared with the derived one.
"""

import math
from fractions import Fraction
from types import SimpleNamespace

import numpy as np
import pytest
import sympy as sp
from examples import bodies

from carom.core import contact as contact_module
from carom.core.contact import SLIDE, STICK, wall_contact
from carom.core.motion.phases import rolls_at_last
from carom.derive import Contact, ImpulsiveMotion
from carom.derive.system import is_zero, tidy
from carom.laws.conventional import conventional_reflection, mirror_root
from carom.laws.mirror import mirror_reflection
from carom.laws.no_slip import no_slip_reflection
from carom.laws.wall_and_floor.solver import wall_and_floor

NAMES = sp.symbols("xdot0 ydot0 zdot0 omega_x0 omega_y0 omega_z0", real=True)
a, kappa, e, mu, beta = bodies.a, bodies.kappa, bodies.e, bodies.mu, bodies.beta
NORMAL = (1, 0, 0)
# One sticking and one sliding state of a ball that comes to x = 0; only which branch they choose matters
VALUES = dict(zip(NAMES, map(Fraction, ("-3", "1/2", "-1/3", "2/7", "-1", "5/3")), strict=True)) | {
    a: Fraction(3, 2),
    kappa: Fraction(2, 5),
    e: Fraction(2, 3),
    mu: Fraction(9),
    beta: Fraction(1, 4),
}


class Witness:
    """An expression with a rational value that decides comparisons."""

    def __init__(self, expr, value):
        self.expr, self.value = sp.sympify(expr), value

    @classmethod
    def of(cls, thing):
        return thing if isinstance(thing, Witness) else cls(thing, math.inf if thing == math.inf else Fraction(thing))

    def __add__(self, other):
        other = Witness.of(other)
        return Witness(self.expr + other.expr, self.value + other.value)

    def __mul__(self, other):
        other = Witness.of(other)
        return Witness(self.expr * other.expr, self.value * other.value)

    def __truediv__(self, other):
        other = Witness.of(other)
        return Witness(self.expr / other.expr, self.value / other.value)

    def __neg__(self):
        return Witness(-self.expr, -self.value)

    def __sub__(self, other):
        return self + -Witness.of(other)

    def __rsub__(self, other):
        return Witness.of(other) + -self

    def __rtruediv__(self, other):
        return Witness.of(other) / self

    __radd__, __rmul__ = __add__, __mul__

    def __gt__(self, other):
        return self.value > Witness.of(other).value

    def __lt__(self, other):
        return self.value < Witness.of(other).value

    def __le__(self, other):
        return self.value <= Witness.of(other).value

    def __ge__(self, other):
        return self.value >= Witness.of(other).value

    def __eq__(self, other):
        return self.value == Witness.of(other).value

    __hash__ = None

    def sqrt(self):
        return Witness(sp.sqrt(self.expr), Fraction(math.sqrt(self.value)))


@pytest.fixture(autouse=True)
def roots(monkeypatch):
    """The kernels' square root, of a witness too."""

    def root(x):
        return x.sqrt() if isinstance(x, Witness) else math.sqrt(x)

    monkeypatch.setattr(contact_module, "math", SimpleNamespace(sqrt=root, inf=math.inf))


def witnesses(values):
    return {name: Witness(name, value) for name, value in values.items()}


def run_contact(values, **fixed):
    w = witnesses(values)
    given = {name: fixed.get(str(name), w[name]) for name in (e, mu, beta)}
    v, spin = tuple(w[n] for n in NAMES[:3]), tuple(w[n] for n in NAMES[3:])
    return wall_contact(v, spin, NORMAL, w[a], w[kappa], given[e], given[mu], given[beta])


def derived(mode, **surface):
    motion = bodies.ball_on_wall(surface.get("e", e), surface.get("mu", mu), surface.get("beta", beta))
    return motion.solve(modes=mode)


def agree(got, jump, impulse):
    for mine, theirs in zip((*got[0], *got[1]), jump.after.values(), strict=True):
        assert is_zero(Witness.of(mine).expr - theirs)
    for mine, theirs in zip(impulse, jump.impulses.values(), strict=True):
        assert is_zero(Witness.of(mine).expr - theirs / bodies.m)


def test_sticking_contact_for_any_state_kappa_e_beta():
    v1, w1, j, required, regime = run_contact(VALUES)
    assert regime == STICK
    jump = derived("stick")
    agree((v1, w1), jump, j)
    # Coulomb's cone (29): the derived condition is the kernel's required friction
    cone = jump.conditions["wall cone"]
    assert is_zero(cone.lhs - (required.expr * jump.impulses["wall.n"]) ** 2)
    assert is_zero(cone.rhs - (mu * jump.impulses["wall.n"]) ** 2)


def test_sliding_contact_for_any_state_kappa_e_mu():
    v1, w1, j, _required, regime = run_contact(VALUES | {mu: Fraction(1, 50)})
    assert regime == SLIDE
    agree((v1, w1), derived("slide"), j)


def test_mirror_and_no_slip_are_its_corners():
    w = witnesses(VALUES)
    v, spin = tuple(w[n] for n in NAMES[:3]), tuple(w[n] for n in NAMES[3:])
    v1, w1, j = mirror_reflection(v, spin, NORMAL, w[a], w[e])
    smooth = derived("smooth", mu=0)
    agree((v1, w1), smooth, j[:1])
    assert all(Witness.of(x).expr == 0 for x in j[1:])
    v1, w1, j, _required = no_slip_reflection(v, spin, NORMAL, w[a], w[kappa])
    jump = derived("stick", e=1, mu=sp.oo, beta=1)
    agree((v1, w1), jump, j)
    assert jump.energy_change == 0
    # beta = -1 is the mirror too
    still = derived("stick", mu=sp.oo, beta=-1)
    assert all(is_zero(still.after[u] - smooth.after[u]) for u in still.after)


def rolling_state():
    x, y, _z, _wx, _wy, spin = NAMES
    return (x, y, sp.S.Zero), (-y / a, x / a, spin)


def conventional_jumps():
    motion = bodies.ball_on_wall(friction=sp.oo, nonhol_coneqs=bodies.rolling())
    (contact,) = motion.contacts
    wall = {f"wall {i}": expr for i, expr in enumerate((contact.normal, *contact.tangents))}
    energy = bodies.m * (bodies.VX**2 + bodies.VY**2 + bodies.VZ**2) / 2
    energy += bodies.kappa * bodies.m * a**2 * (bodies.WX**2 + bodies.WY**2 + bodies.WZ**2) / 2
    motion = ImpulsiveMotion(
        energy, motion.coordinates, speeds=motion.speeds.names, nonhol_coneqs=bodies.rolling(), instant=wall
    )
    x1, x0 = motion.speeds.after[0], motion.speeds.before[0]
    return motion.close([x1 + x0, motion.energy(motion.u1) - motion.energy(motion.u0)])


def test_conventional_law_and_its_mirror_root():
    v, w = rolling_state()
    answers = [
        [sp.sympify(q) for q in (*r[0], *r[1])]
        for r in (conventional_reflection(v, w, NORMAL, a, kappa), mirror_root(v, w, NORMAL, a, kappa))
    ]
    found = [list(j.after.values()) for j in conventional_jumps()]
    for answer in answers:
        assert sum(all(is_zero(p - q) for p, q in zip(answer, f, strict=True)) for f in found) == 1
    assert len(found) == 2


def test_conventional_law_is_the_no_slip_law_of_a_heavier_disc():
    """e = 1, beta = 1, mu infinite, kappa' = kappa/(1 + kappa): while it rolls, the ball is as heavy as m (1 + kappa).

    In the plane this is Broomhead and Gutkin's law for a disc with that moment; beta = -1 is the mirror root.
    """
    x, y = bodies.x, bodies.y
    heavy, share, sign = sp.symbols("m kappa s")
    T = heavy * (bodies.VX**2 + bodies.VY**2) / 2 + share * heavy * a**2 * bodies.WZ**2 / 2
    disc = Contact("wall", bodies.VX, (bodies.VY - a * bodies.WZ,), restitution=1, tangential_restitution=sign)
    jump = ImpulsiveMotion(T, [x, y], speeds=[bodies.VX, bodies.VY, bodies.WZ], contacts=[disc]).solve()
    # the 2-D kernel is the 3-D one with nothing along z
    v, w = rolling_state()
    for beta_, law in ((1, conventional_reflection), (-1, mirror_root)):
        v1, w1 = law(v, w, NORMAL, a, kappa)
        plane = {u: jump.after[u].subs({share: kappa / (1 + kappa), sign: beta_}) for u in jump.after}
        for u, q in ((bodies.VX, v1[0]), (bodies.VY, v1[1]), (bodies.WZ, w1[2])):
            assert is_zero(plane[u] - q)
    # and the kinetic energies agree: (1 + kappa) m for the translation, kappa m a^2 for the vertical spin
    x0, y0, _z, _wx, _wy, spin = NAMES
    full = bodies.ball_on_wall(before=bodies.rolling())
    assert is_zero(
        full.energy(full.u0) - (bodies.m * (1 + kappa) * (x0**2 + y0**2) + kappa * bodies.m * a**2 * spin**2) / 2
    )
    # no other kappa' does
    other = sp.Symbol("k", positive=True)
    lateral = (
        jump.after[bodies.VY].subs({share: other, sign: 1}) - conventional_reflection(v, w, NORMAL, a, kappa)[0][1]
    )
    assert sp.solve(sp.numer(sp.together(lateral)).subs({y0: 1, spin: 0, a: 1}), other) == [kappa / (kappa + 1)]


def test_second_impact_is_the_derived_landing():
    v1, w1 = rolls_at_last(NAMES[:3], NAMES[3:], a, kappa)
    jump = bodies.ball_on_wall(imposed=bodies.rolling()).solve(modes="open")
    for mine, theirs in zip((*v1, *w1), jump.after.values(), strict=True):
        assert is_zero(mine - theirs)


def floor_history(*pushes, arm=None, torque=0):
    """A ball that leaves the wall and gets impulses from the floor, at its contact point or at ``arm``; then it
    rolls."""
    speeds = bodies.ball_on_wall().speeds.names
    v, w = sp.Matrix(NAMES[:3]), sp.Matrix(NAMES[3:])
    lever = sp.Matrix([0, 0, -a]) if arm is None else arm
    for push in pushes:
        v = v + push / bodies.m
        w = w + (lever.cross(push) + sp.Matrix([0, 0, torque])) / (kappa * bodies.m * a**2)
    last = bodies.ball_on_wall(imposed=bodies.rolling()).solve(modes="open")
    swap = dict(zip(NAMES, [*v, *w], strict=True))
    return [last.after[u].subs(swap, simultaneous=True) for u in speeds]


def test_final_rolling_does_not_depend_on_how_the_floor_brings_it_about():
    """Any number of impulses, of any direction and size (bounces, sliding to either side), at the floor's contact
    point."""
    first, second = (sp.Matrix(sp.symbols(f"P{n}x P{n}y P{n}z", real=True)) for n in (1, 2))
    jump = bodies.ball_on_wall(imposed=bodies.rolling()).solve(modes="open")
    direct = list(jump.after.values())
    for q, p in zip(floor_history(first, second), direct, strict=True):
        assert is_zero(p - q)
    # exactly that assumption: each of these breaks it
    h = sp.Symbol("h", positive=True)
    off_centre = floor_history(
        first, arm=sp.Matrix([h, 0, -a])
    )  # rolling resistance: the push acts ahead of the contact
    assert not is_zero(off_centre[0] - direct[0])
    pivot = floor_history(first, torque=sp.Symbol("tau"))  # pivoting friction: a torque about the normal
    assert is_zero(pivot[0] - direct[0])
    assert not is_zero(pivot[5] - direct[5])
    soft = floor_history(first, arm=sp.Matrix([0, 0, -h]))  # a floor that gives way: the contact is nearer the centre
    assert not is_zero(soft[0] - direct[0])


def test_two_step_is_first_and_second_impact():
    x0, y0, _z, _wx, _wy, spin = NAMES
    values = VALUES | {NAMES[2]: 0}
    values |= {NAMES[3]: -values[y0] / values[a], NAMES[4]: values[x0] / values[a]}
    motion = bodies.ball_on_wall(e, sp.oo, 0, before=bodies.rolling())
    first = motion.solve()
    last = bodies.ball_on_wall(imposed=bodies.rolling()).solve(modes="open")
    both = {
        u: tidy(q.subs(dict(zip(NAMES, first.after.values(), strict=True)), simultaneous=True))
        for u, q in last.after.items()
    }
    w = witnesses(values)
    v1, w1, *_ = wall_contact(
        tuple(w[n] for n in NAMES[:3]), tuple(w[n] for n in NAMES[3:]), NORMAL, w[a], w[kappa], w[e], math.inf, 0
    )
    rolled = dict(zip(NAMES, (q for part in rolling_state() for q in part), strict=True))
    v1, w1 = (tuple(Witness.of(q).expr.subs(rolled) for q in part) for part in (v1, w1))
    v2, w2 = rolls_at_last(v1, w1, a, kappa)
    for mine, theirs in zip((*v2, *w2), both.values(), strict=True):
        assert is_zero(mine - theirs)
    # (41): the paper's example as rationals
    example = {kappa: sp.Rational(2, 5), e: 1, x0: -1, y0: 1, spin: 0, a: 1}
    assert [q.subs(example) for q in both.values()] == [sp.Rational(n, 49) for n in (31, 39, 0, -39, 31, 35)]


@pytest.mark.parametrize("friction", [0.05, 0.2, 0.6, math.inf])
def test_ball_pressed_on_a_smooth_rigid_floor(friction):
    """Backspin: the wall pushes the ball down; with z' = 0 held, the contact at B is one percussion in space."""
    motion = bodies.ball_on_wall(e, mu, 0, imposed={"floor": bodies.VZ})
    v, w = (-1.0, 0.3, 0.0), (0.2, 0.9, -0.4)
    values = {
        a: 1,
        kappa: sp.Rational(2, 5),
        bodies.m: 1,
        e: sp.Rational(7, 10),
        mu: sp.oo if friction == math.inf else sp.Float(friction),
    }
    values |= dict(zip(NAMES, map(sp.Float, (*v, *w)), strict=True))
    found = motion.percussion("wall", values, "stronge")
    _v1, _w1, impulse, _floor, _regime = wall_and_floor(v, w, (1.0, 0.0, 0.0), 1.0, 0.4, 0.7, friction, 0.0, 0.0, 0.0)
    assert np.allclose([float(p) for p in found.impulse], impulse, rtol=1e-6, atol=1e-7)
