"""Compare a printed equation with what follows from its derivation, and compute the verdict.

An `Entry` holds the relations as the paper prints them, and what has been derived (``facts``: values of the symbols in the printed
relations). `judge` substitutes the facts and examines the difference. Which equations are misprints is not stated anywhere.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from functools import cache, lru_cache
from typing import Any

import sympy as sp
from sympy.physics.mechanics import dynamicsymbols

from carom.derive.impulsive import ImpulsiveMotion
from carom.derive.percussion import Jump
from carom.derive.system import Contact, Expr, Matrix, is_zero, tidy


@dataclass(frozen=True)
class Step:
    """One line of a derivation: a sentence, and the resulting expression or relation (or None)."""

    text: str
    result: Any = None


@dataclass(frozen=True)
class Branch:
    """A case: its name, and the values of the symbols of the printed relations in it."""

    name: str
    facts: Mapping[Expr, Expr] = field(default_factory=dict)


def one(facts: Mapping[Expr, Expr]) -> tuple[Branch, ...]:
    """Return a single case without a name."""
    return (Branch("", facts),)


@dataclass(frozen=True)
class Entry:
    """One equation or sentence of the paper.

    Attributes
    ----------
    id : str
        "1" to "41", a part as "41e", an unnumbered statement as "s4-1".
    title : str
        Its subject.
    printed : tuple
        Its relations, as printed.
    derived : tuple
        The derived relations, in the same symbols.
    branches : tuple of Branch
        Cases that the paper's wording admits; the printed relations should hold in each. Default: what is derived.
    cases : tuple of Branch
        Narrower cases, tried where a branch fails; the name states the condition.
    attitude : mapping
        Euler angles at which the paper uses the equation; a pole there makes it conditional.
    steps : tuple of Step
        The derivation.
    note : str
        Explanation; numbers in it are computed where the entry is made.
    """

    id: str
    title: str
    printed: tuple[Any, ...]
    derived: tuple[Any, ...]
    branches: tuple[Branch, ...] = ()
    cases: tuple[Branch, ...] = ()
    attitude: Mapping[Expr, Expr] = field(default_factory=dict)
    steps: tuple[Step, ...] = ()
    note: str = ""

    def __post_init__(self) -> None:
        """Without branches: the one case is what has been derived."""
        if not self.branches:
            object.__setattr__(self, "branches", one({relation.lhs: relation.rhs for relation in self.derived}))


@dataclass(frozen=True)
class EquationVerdict:
    """Status ("holds", "conditional", "misprint"), and the cases in which the printed form holds and fails."""

    status: str
    true_in: tuple[str, ...]
    false_in: tuple[str, ...]
    sentence: str
    failed: tuple[tuple[Any, Mapping[Expr, Expr]], ...] = ()
    """The printed relations, with the facts of each case in which not all of them hold."""
    idle: str = ""
    """Printed identities, which say nothing."""

    @property
    def gap(self) -> str:
        """The relations that fail, and by how much; simplified when asked for, which takes longer than the verdict."""
        fails = [f"{shown(r)}: {difference(r, facts)}" for r, facts in self.failed if not true_of(r, facts)]
        return self.idle or "; ".join(fails)


def _value(expr: Expr, facts: Mapping[Expr, Expr]) -> Expr:
    return sp.sympify(expr).subs(list(facts.items()), simultaneous=True).doit()


def shown(relation: Any) -> str:
    """Return a relation as text."""
    if isinstance(relation, sp.Equality):
        return f"{relation.lhs} = {relation.rhs}"
    if isinstance(relation, sp.core.relational.Relational):
        return f"{relation.lhs} {relation.rel_op} {relation.rhs}"
    return str(relation)


def true_of(relation: Any, facts: Mapping[Expr, Expr]) -> bool:
    """Return whether a relation holds with the facts substituted."""
    return _true_of(relation, tuple(facts.items()))


@lru_cache(maxsize=4096)
def _true_of(relation: Any, facts: tuple[tuple[Expr, Expr], ...]) -> bool:
    left, right = (_value(side, dict(facts)) for side in (relation.lhs, relation.rhs))
    if isinstance(relation, sp.Equality):
        return bool(left == right or is_zero(left - right))
    if relation.rel_op == "!=":
        return not is_zero(left - right)
    margin = left - right if relation.rel_op in (">", ">=") else right - left
    short = margin if margin.is_number else tidy(margin)
    # (a sum of squares may hide its sign until it is expanded)
    tried = (short, sp.expand(short))
    return any(x.is_positive if relation.rel_op in ("<", ">") else x.is_nonnegative for x in tried)


def difference(relation: Any, facts: Mapping[Expr, Expr]) -> str:
    """Return by how much a relation fails with the facts substituted."""
    left, right = _value(relation.lhs, facts), _value(relation.rhs, facts)
    if isinstance(relation, sp.Equality):
        return f"left - right = {tidy(left - right)}"
    if relation.rel_op == "!=":
        return "both sides are equal"
    margin = left - right if relation.rel_op in (">", ">=") else right - left
    return f"the margin {margin if margin.is_number else tidy(margin)} is not of one sign, or of the wrong one"


def says_nothing(relation: Any) -> bool:
    """Return whether an equation is an identity (x = x)."""
    return isinstance(relation, sp.Equality) and (relation.lhs == relation.rhs or is_zero(relation.lhs - relation.rhs))


def poles(relation: Any, facts: Mapping[Expr, Expr], attitude: Mapping[Expr, Expr]) -> list[str]:
    """Return the sides of a relation that are infinite at ``attitude``, taking the limits of the angles one after the other."""
    found = []
    for side in (relation.lhs, relation.rhs):
        value = side if any(sp.sympify(side).has(angle) for angle in attitude) else _value(side, facts)
        for angle, where in attitude.items():
            if value.has(angle):
                value = sp.limit(value, angle, where)
        if value.has(sp.oo, sp.zoo, sp.nan) or isinstance(value, sp.AccumBounds):
            found.append(str(side))
    return found


def judge(entry: Entry) -> EquationVerdict:
    """Return the verdict on an entry, from its printed relations, its facts and its cases."""
    true_in, false = [], []
    for branch in entry.branches:
        if all(true_of(r, branch.facts) for r in entry.printed):
            true_in.append(branch.name)
        else:
            false.append(branch)
    false_in = [branch.name for branch in false]
    failed = tuple((r, branch.facts) for branch in false for r in entry.printed)
    idle = [shown(r) for r in entry.printed if says_nothing(r)]
    wanted = [r for r in entry.derived if not says_nothing(r)]
    if idle and len(idle) > len(entry.derived) - len(wanted):
        said = "; ".join(idle)
        return EquationVerdict("misprint", (), tuple(false_in), f"{said} says nothing", failed, said)
    if not false_in:
        infinite = [s for r in entry.printed for s in poles(r, entry.branches[0].facts, entry.attitude)]
        if infinite:
            where = ", ".join(f"{k} = {v}" for k, v in entry.attitude.items())
            return EquationVerdict(
                "conditional", tuple(true_in), (), f"holds away from {where}, where {infinite[0]} is infinite"
            )
        return EquationVerdict("holds", tuple(true_in), (), "")
    true_in += [c.name for c in entry.cases if all(true_of(r, c.facts) for r in entry.printed)]
    named_true, named_false = [n for n in true_in if n], [n for n in false_in if n]
    if true_in:
        sentence = f"holds {'; '.join(named_true)}" + (f"; not {'; '.join(named_false)}" if named_false else "")
        return EquationVerdict("conditional", tuple(true_in), tuple(false_in), sentence, failed)
    right = "; ".join(shown(r) for r in entry.derived)
    return EquationVerdict("misprint", (), tuple(false_in), f"right is {right}", failed)


# ----------------------------------------------------------------------------------------------------
# The paper's ball from first principles: rotation matrices, contact points, and the motions its sections impose.


# The paper's symbols. Speeds just before carry 0, after the first impact 1, after the second 2.
a, m, I, g, mu = sp.symbols("a m I g mu", positive=True)  # noqa: E741 - the paper's moment
e = sp.Symbol("e", nonnegative=True)
beta = sp.Symbol("beta", real=True)
theta, phi, psi, c, d = sp.symbols("theta varphi psi c d", real=True)
dtheta, dphi, dpsi = sp.symbols("thetadot varphidot psidot", real=True)
wx, wy, wz = sp.symbols("omega_x omega_y omega_z", real=True)
dx, dy, dz = sp.symbols("xdot ydot zdot", real=True)
x0, y0, z0, x1, y1, z1, x2, y2, z2 = sp.symbols("xdot0 ydot0 zdot0 xdot1 ydot1 zdot1 xdot2 ydot2 zdot2", real=True)
wx0, wy0, wz0, wx1, wy1, wz1, wx2, wy2, wz2 = sp.symbols(
    "omega_x0 omega_y0 omega_z0 omega_x1 omega_y1 omega_z1 omega_x2 omega_y2 omega_z2", real=True
)
dtheta0, dphi0, dpsi0, dtheta1, dphi1, dpsi1 = sp.symbols(
    "thetadot0 varphidot0 psidot0 thetadot1 varphidot1 psidot1", real=True
)
Rx, Ry, Rz = sp.symbols("R_x R_y R_z", real=True)
T, T0, T1 = sp.symbols("T T_0 T_1", real=True)
u0, v0 = sp.symbols("u_0 v_0", positive=True)  # section 4: the ball comes with (-u0, v0, 0)

ATTITUDE = {phi: sp.S.Zero, theta: sp.pi / 2, psi: sp.S.Zero}  # the moment of collision, as the paper puts it
SOLID = sp.Rational(2, 5) * m * a**2

# Functions of time for derivations that differentiate
THETA, PHI, PSI, X, Y, Z = dynamicsymbols("theta varphi psi x y z")
WX, WY, WZ = dynamicsymbols("omega_x omega_y omega_z")
TIME = dynamicsymbols._t
RATES = {THETA.diff(TIME): dtheta, PHI.diff(TIME): dphi, PSI.diff(TIME): dpsi}
PLACES = {THETA: theta, PHI: phi, PSI: psi}
LIFTED = {v: q for q, v in (RATES | PLACES).items()} | {dx: X.diff(TIME), dy: Y.diff(TIME), dz: Z.diff(TIME)}


def eq(left: Expr, right: Expr) -> Any:
    """Return an unevaluated equation."""
    return sp.Eq(left, right, evaluate=False)


def flat(expr: Expr) -> Expr:
    """Replace functions of time by the symbols of the printed equations."""
    return expr.xreplace(RATES).xreplace(PLACES)


@cache
def rotation() -> Matrix:
    """Return the rotation matrix: nutation theta, precession psi about the vertical, spin varphi about the body's axis."""

    def about_z(q: Expr) -> Matrix:
        return sp.Matrix([[sp.cos(q), -sp.sin(q), 0], [sp.sin(q), sp.cos(q), 0], [0, 0, 1]])

    tilt = sp.Matrix([[1, 0, 0], [0, sp.cos(THETA), -sp.sin(THETA)], [0, sp.sin(THETA), sp.cos(THETA)]])
    return about_z(PSI) * tilt * about_z(PHI)


@cache
def spin() -> Matrix:
    """Return the angular velocity in the fixed frame, from the skew part of R' R^T."""
    turn = rotation()
    skew = (turn.diff(TIME) * turn.T).applyfunc(lambda w: sp.expand(flat(w)))
    return sp.Matrix([tidy(skew[2, 1]), tidy(skew[0, 2]), tidy(skew[1, 0])])


def point_velocity(arm: tuple[Expr, Expr, Expr]) -> Matrix:
    """Return the velocity of the material point at ``arm`` from the centre: d/dt (C + R s), s fixed in the body."""
    turn = rotation()
    fixed = sp.symbols("s_1:4")
    moved = (turn.diff(TIME) * sp.Matrix(fixed)).xreplace(dict(zip(fixed, turn.T * sp.Matrix(arm), strict=True)))
    return sp.Matrix([dx, dy, dz]) + moved.applyfunc(lambda w: tidy(sp.expand(flat(w))))


@cache
def rolling() -> dict[Expr, Expr]:
    """Return x', y', z' for which the ball's lowest point A is at rest."""
    found: dict[Expr, Expr] = sp.solve(list(point_velocity((0, 0, -a))), [dx, dy, dz], dict=True)[0]
    return found


@cache
def angle_energy() -> Expr:
    """Return the kinetic energy in Euler rates and the centre's velocity."""
    w = spin()
    return m * (dx**2 + dy**2 + dz**2) / 2 + tidy(I * (w.T * w)[0] / 2)


def _angles(**more: Any) -> ImpulsiveMotion:
    given: dict[str, Any] = {k: {n: sp.sympify(w).xreplace(LIFTED) for n, w in v.items()} for k, v in more.items()}
    return ImpulsiveMotion(angle_energy().xreplace(LIFTED), [X, Y, Z, THETA, PHI, PSI], **given)


@cache
def wall_rows() -> dict[str, Expr]:
    """Return V_B = 0, the constraints (4), in Euler rates."""
    return dict(zip(("wall x", "wall y", "wall z"), point_velocity((-a, 0, 0)), strict=True))


@cache
def floor_rows() -> dict[str, Expr]:
    """Return V_A = 0, the constraints (2), in Euler rates."""
    return dict(zip(("floor x", "floor y", "floor z"), point_velocity((0, 0, -a)), strict=True))


@cache
def both_contacts() -> ImpulsiveMotion:
    """Return section 2 in Euler angles, at any attitude: rolling on the floor, and V_B = 0 for the instant."""
    return _angles(nonhol_coneqs=floor_rows(), instant=wall_rows())


@cache
def freedom() -> dict[Expr, Expr]:
    """Return the rates of the only motion that both contacts allow, for varphi' = 1, from the null space of all six rows."""
    column = both_contacts().virtual_displacements([PHI.diff(TIME)])
    rates = dict(zip((dx, dy, dz, dtheta, dphi, dpsi), column, strict=True))
    return {k: tidy(flat(v)) for k, v in rates.items()}


def _spins(**more: Any) -> ImpulsiveMotion:
    speeds = [X.diff(TIME), Y.diff(TIME), Z.diff(TIME), WX, WY, WZ]
    up = dict(zip((dx, dy, dz, wx, wy, wz), speeds, strict=True))

    def lift(value: Any) -> Any:
        if isinstance(value, dict):
            return {k: lift(v) for k, v in value.items()}
        if isinstance(value, (list, tuple)):
            return type(value)(lift(v) for v in value)
        if isinstance(value, Contact):
            return replace(value, normal=lift(value.normal), tangents=lift(value.tangents))
        return value.xreplace(up) if isinstance(value, sp.Basic) else value

    energy = m * (dx**2 + dy**2 + dz**2) / 2 + I * (wx**2 + wy**2 + wz**2) / 2
    return ImpulsiveMotion(energy.xreplace(up), [X, Y, Z], speeds=speeds, **lift(more))


# Contact velocities in velocity and spin, V_C + omega x arm; `point_velocity` checks them in (4)
FLOOR = {"floor x": dx - a * wy, "floor y": dy + a * wx, "floor z": dz}
WALL = {"wall x": dx, "wall y": dy - a * wz, "wall z": dz + a * wy}


def wall_contact(**surface: Any) -> Contact:
    """Return B as a contact."""
    return Contact("B", WALL["wall x"], (WALL["wall y"], WALL["wall z"]), **surface)


@cache
def conventional() -> ImpulsiveMotion:
    """Return section 2 in velocity and spin: both contacts act, the floor's also afterwards."""
    return _spins(nonhol_coneqs=FLOOR, instant=WALL)


@cache
def smooth_wall() -> ImpulsiveMotion:
    """Return a ball that rolls on the floor, before and after, and meets the wall as a surface of its centre's path."""
    return _spins(nonhol_coneqs=FLOOR, instant={"wall x": WALL["wall x"]})


@cache
def first_impact(
    hypothesis: str = "newton", tangential: Expr = sp.S.Zero, rolls: bool = True
) -> tuple[ImpulsiveMotion, Jump]:
    """Return section 3.2: the wall alone acts on a ball that rolled (or on any ball)."""
    contact = wall_contact(restitution=e, tangential_restitution=tangential, hypothesis=hypothesis)
    motion = _spins(contacts=[contact], before=FLOOR if rolls else {})
    return motion, motion.solve()


@cache
def sliding_impact() -> tuple[ImpulsiveMotion, Jump]:
    """Return the first impact outside the friction cone: B slides throughout."""
    motion = _spins(contacts=[wall_contact(restitution=e, friction=mu)], before=FLOOR)
    return motion, motion.solve(modes="slide")


@cache
def second_impact() -> tuple[ImpulsiveMotion, Jump]:
    """Return section 3.3: a ball in the air meets the floor, and V_A = 0 from then on; 0 and 1 mean before and after it."""
    motion = _spins(imposed=FLOOR)
    return motion, motion.solve()


BEFORE = (x0, y0, z0, wx0, wy0, wz0)
FIRST = (x1, y1, z1, wx1, wy1, wz1)
SECOND = (x2, y2, z2, wx2, wy2, wz2)


def after(jump: Jump, symbols: tuple[Expr, ...]) -> dict[Expr, Expr]:
    """Return the speeds afterwards as facts for the given symbols."""
    return dict(zip(symbols, jump.after.values(), strict=True))


def _facts(motion: ImpulsiveMotion, jump: Jump) -> dict[Expr, Expr]:
    impulses = {Rx: jump.impulses["B.n"], Ry: jump.impulses["B.t1"], Rz: jump.impulses["B.t2"]}
    return after(jump, FIRST) | impulses | motion.pre_relations


@cache
def first_facts() -> dict[Expr, Expr]:
    """Return the state just after the first impact, its impulses, and the relations of rolling before it."""
    return _facts(*first_impact())


@cache
def sliding_facts() -> dict[Expr, Expr]:
    """Return the same outside the friction cone, where B slides throughout and the impulse lies on the cone."""
    return _facts(*sliding_impact())


# The two cases of the first impact; what rests on (30) holds in the first only
INSIDE, OUTSIDE = "where the impulse stays within the cone (29)", "where it slides throughout, on the cone"


@cache
def second_facts() -> dict[Expr, Expr]:
    """Return the speeds after the second impact in terms of those before it (1), for any state that lands."""
    _, jump = second_impact()
    renamed = dict(zip(BEFORE, FIRST, strict=True))
    return {k: tidy(v.xreplace(renamed)) for k, v in after(jump, SECOND).items()}


@cache
def example_facts(slides: bool = False) -> dict[Expr, Expr]:
    """Return both impacts of section 4: (-u0, v0, 0) without side spin, e = 1, a solid ball; B sticks, or slides throughout."""
    given = {x0: -u0, y0: v0, wz0: sp.S.Zero, e: sp.S.One, I: SOLID}
    first = {k: tidy(v.subs(given)) for k, v in (sliding_facts() if slides else first_facts()).items()}
    second = {k: tidy(v.subs(first).subs(given)) for k, v in second_facts().items()}
    return {**given, **first, **second}


@cache
def conventional_roots() -> tuple[tuple[str, dict[Expr, Expr], Jump], ...]:
    """Return the roots of (17) with hypotheses 1 to 3, e = 1: name, facts, jump."""
    motion = conventional()
    energy = eq(motion.energy(motion.u1), motion.energy(motion.u0))
    found = []
    for jump in motion.close([eq(x1, -x0), energy]):
        facts = after(jump, FIRST) | motion.pre_relations
        mirror = tidy(facts[y1] - y0) == 0
        does = "leaves the tangential velocity as it was (mirror)" if mirror else "reverses the slip at B"
        found.append((f"on the root that {does}", facts, jump))
    return tuple(found)


def reversed_root() -> dict[Expr, Expr]:
    """Return the conventional solution that the paper gives."""
    return next(facts for name, facts, _ in conventional_roots() if "reverses" in name)
