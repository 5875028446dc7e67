"""Follow one rough contact through its impact, as a function of the normal impulse p: slip, reversal, stick, jam.

In the plane the velocities are piecewise linear in p (Routh, *Dynamics of a System of Rigid Bodies*, 1905, arts. 180
to 203) and the answer is exact for exact numbers. In space the slip may swerve (Keller, J. Appl. Mech. 53, 1986, 1);
there the hodograph is integrated. Newton's, Poisson's and Stronge's (Proc. R. Soc. A 431, 1990, 169) rules end the
impact.
"""

from __future__ import annotations

import math
import warnings
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np
import sympy as sp

from carom.core.jit.compile import njit
from carom.core.jit.threads import row_slices
from carom.derive.system import (
    ConstraintRow,
    Contact,
    Expr,
    Matrix,
    Speeds,
    atoms_of,
    bound_columns,
    independent_rows,
    is_zero,
    null_basis,
    solve_linear,
    tidy,
)
from carom.errors import CaromError


class ImpactWarning(UserWarning):
    """The closing hypothesis of an impact leads to a result that no pair of bodies shows.

    Base class of the warnings of this package; ``warnings.simplefilter("error", ImpactWarning)`` turns them into errors.

    Examples
    --------
    >>> from carom.derive import EnergyGain, ImpactWarning
    >>> issubclass(EnergyGain, ImpactWarning)
    True
    """


class EnergyGain(ImpactWarning):
    """Newton's restitution together with friction creates kinetic energy (Kane and Levinson, *Dynamics*, 1985).

    Examples
    --------
    >>> import warnings
    >>> from carom.derive import EnergyGain
    >>> with warnings.catch_warnings(record=True) as caught:
    ...     warnings.simplefilter("always")
    ...     warnings.warn("the jump gains energy", EnergyGain)
    >>> caught[0].category.__name__
    'EnergyGain'
    """


class FrictionJam(ImpactWarning):
    """Friction reverses the effect of the normal impulse: the sliding contact jams (Painlevé 1895).

    Examples
    --------
    >>> from carom.derive import FrictionJam, ImpactWarning
    >>> issubclass(FrictionJam, ImpactWarning)
    True
    """


@dataclass(frozen=True)
class Jump:
    """The change of all speeds at an instant: the result of :meth:`ImpulsiveMotion.solve`.

    Attributes
    ----------
    after : dict
        Each speed and its value just after the instant, in terms of the speeds just before.
    impulses : dict
        Each constraint's name and its impulse (Lagrange multiplier), positive along that constraint's velocity.
    energy_change : Expr
        Kinetic energy after the instant minus that before.
    redundant : dict
        Each redundant constraint's name and the linear combination of the other constraints that implies it.
    free_impulses : tuple
        Symbols of the impulses that rigid bodies leave undetermined, one for each redundant constraint.
    conditions : dict
        Relations under which the result is valid, by name, e.g. Coulomb's friction cone.
    notes : tuple of str
        Sentences on choices and limits.

    Examples
    --------
    A particle of mass m that meets a wall with Newton's restitution e:

    >>> import sympy as sp
    >>> from sympy.physics.mechanics import dynamicsymbols
    >>> from carom.derive import Contact, ImpulsiveMotion
    >>> m, e = sp.symbols("m e", positive=True)
    >>> x = dynamicsymbols("x")
    >>> wall = Contact("wall", x.diff(), restitution=e, friction=0)
    >>> jump = ImpulsiveMotion(m * x.diff() ** 2 / 2, [x], contacts=[wall]).solve()
    >>> jump.after[x.diff()], jump.impulses["wall.n"]
    (-e*xdot0, -m*xdot0*(e + 1))
    >>> jump.subs({e: 1}).energy_change
    0
    """

    after: dict[Expr, Expr]
    impulses: dict[str, Expr]
    energy_change: Expr
    redundant: dict[str, dict[str, Expr]] = field(default_factory=dict)
    free_impulses: tuple[Expr, ...] = ()
    conditions: dict[str, Expr] = field(default_factory=dict)
    notes: tuple[str, ...] = ()

    def subs(self, values: Mapping[Expr, Expr]) -> Jump:
        """Return the same jump with values substituted for symbols."""

        def put(table: Mapping[Any, Expr]) -> dict[Any, Expr]:
            return {k: sp.sympify(v).subs(values) for k, v in table.items()}

        return replace(
            self,
            after=put(self.after),
            impulses=put(self.impulses),
            conditions=put(self.conditions),
            energy_change=tidy(sp.sympify(self.energy_change).subs(values)),
        )


# ----------------------------------------------------------------------------------------------------
# Follow one rough contact through its impact, as a function of the normal impulse p: slip, reversal, stick, jam.


Number = Any


@dataclass(frozen=True)
class Phase:
    """A phase of the impact: its kind ("slip", "jam", "stick", "reverse"), and p where it starts and ends."""

    kind: str
    start: Number
    end: Number


@dataclass(frozen=True)
class Percussion:
    """The result of following a contact through its impact.

    Attributes
    ----------
    velocity : tuple
        Contact velocity afterwards: normal, tangents.
    impulse : tuple
        Impulse on the body: normal, tangents.
    phases : tuple of Phase
        The phases of the contact, in order.
    compression : number
        Normal impulse up to the end of compression.
    energy_change : number
        Kinetic energy gained (negative: lost).
    """

    velocity: tuple[Number, ...]
    impulse: tuple[Number, ...]
    phases: tuple[Phase, ...]
    compression: Number
    energy_change: Number

    @property
    def jams(self) -> bool:
        """Whether friction reversed the effect of the normal impulse (Painlevé)."""
        return any(phase.kind == "jam" for phase in self.phases)


@dataclass
class _Run:
    """State of an impact in progress: p, normal velocity, tangential velocities and impulses, work of the normal impulse."""

    hypothesis: str
    e: Number
    first: Number  # normal velocity at the start
    p: Number
    un: Number
    ut: list[Number]
    rt: list[Number]
    work: Number
    p_c: Number = None  # p and work at the end of compression, once there
    work_c: Number = None

    def finish_in(self, rate: Number) -> Number | None:
        """Return the normal impulse left until the end, if the normal velocity keeps growing by ``rate`` per p; None: never."""
        if self.p_c is None:
            return None
        if self.hypothesis == "poisson":
            return (1 + self.e) * self.p_c - self.p
        if not rate > 0:
            return None
        if self.hypothesis == "newton":
            return (-self.e * self.first - self.un) / rate
        left = -(self.e**2) * self.work_c - (self.work - self.work_c)
        root = sp.sqrt if isinstance(self.un, sp.Basic) else math.sqrt
        return (root(self.un**2 + 2 * rate * left) - self.un) / rate

    def advance(self, dp: Number, rate: Number, rates: Sequence[Number], pushes: Sequence[Number]) -> None:
        self.work = self.work + self.un * dp + rate * dp**2 / 2
        self.un = self.un + rate * dp
        self.ut = [u + r * dp for u, r in zip(self.ut, rates, strict=True)]
        self.rt = [x + q * dp for x, q in zip(self.rt, pushes, strict=True)]
        self.p = self.p + dp

    def straight(self, rate: Number, rates: Sequence[Number], pushes: Sequence[Number], limit: Number | None) -> bool:
        """Advance at constant rates to the end of the impact, or by ``limit`` of p; return True when the impact is over."""
        gone = self.un * 0
        if self.p_c is None and rate > 0:
            to_zero = -self.un / rate
            if limit is None or to_zero <= limit:
                self.advance(to_zero, rate, rates, pushes)
                self.un, self.p_c, self.work_c = self.un * 0, self.p, self.work
                gone = to_zero
        rest = self.finish_in(rate)
        if rest is not None and (limit is None or gone + rest <= limit):
            self.advance(rest, rate, rates, pushes)
            return True
        if limit is None:
            raise CaromError(
                "percussion: expected an impact that ends, got one that does not; check the inertia along the normal"
            )
        self.advance(limit - gone, rate, rates, pushes)
        return False


def integrate(g: Matrix, start: Sequence[Number], e: Number, mu: Number, hypothesis: str = "stronge") -> Percussion:
    """Follow a contact with inverse mass ``g`` (2x2 or 3x3; normal, tangents) from the velocity ``start`` to its end.

    Rational numbers give exact results in the plane. Raises CaromError where the contact separates already, or ``g``
    is not positive definite. Warns EnergyGain where Newton's rule creates energy.
    """
    size = g.rows
    start = [sp.sympify(x) for x in start]
    if hypothesis not in ("newton", "poisson", "stronge"):
        raise CaromError(f"percussion: hypothesis: expected 'newton', 'poisson' or 'stronge', got {hypothesis!r}")
    if size not in (2, 3) or len(start) != size:
        raise CaromError(f"percussion: expected a normal and one or two tangents, got {len(start)} velocities")
    if not all(g[:k, :k].det() > 0 for k in range(1, size + 1)):
        raise CaromError(
            "percussion: the contact's inverse mass is not positive definite (redundant constraints hold it)"
        )
    if start[0] > 0:
        raise CaromError(f"percussion: the contact separates (normal velocity {start[0]} > 0), there is no impact")
    zero = start[0] * 0
    run = _Run(hypothesis, e, start[0], zero, start[0], list(start[1:]), [zero] * (size - 1), zero)
    over = mu == sp.oo and _stopped_at_once(g, run)
    phases = [] if over else (_in_plane if size == 2 else _in_space)(g, run, mu)
    velocity = (run.un, *run.ut)
    impulse = (run.p, *run.rt)
    change = sum(((v + u) * r for v, u, r in zip(velocity, start, impulse, strict=True)), zero) / 2
    if change > (0 if sp.sympify(change).is_Rational else 1e-12 * abs(start[0] * run.p)):
        warnings.warn(
            f"{hypothesis}'s restitution e = {e} with friction {mu} gains the energy {change}", EnergyGain, stacklevel=3
        )
    return Percussion(velocity, impulse, tuple(p for p in phases if p.end > p.start), run.p_c, change)


def _stopped_at_once(g: Matrix, run: _Run) -> bool:
    """End the slip at once, as infinite friction does before the normal impulse has grown; return whether the bodies part then."""
    pull = -(g[1:, 1:].inv() * sp.Matrix(run.ut))
    run.un = run.un + (g[0, 1:] * pull)[0]
    run.rt = list(pull)
    run.ut = [u * 0 for u in run.ut]
    if run.un >= 0:
        run.p_c = run.p
    return bool(run.un >= 0)


def _in_plane(g: Matrix, run: _Run, mu: Number) -> list[Phase]:
    """Follow the impact in the plane by Routh's diagram: slip, then stick or reversed slip."""
    nn, nt, tt = g[0, 0], g[0, 1], g[1, 1]
    phases: list[Phase] = []
    if run.ut[0] != 0:
        side = sp.sign(run.ut[0])
        rate, slip = nn - mu * side * nt, nt - mu * side * tt
        begun = run.p
        over = run.straight(rate, [slip], [-mu * side], -run.ut[0] / slip if slip * side < 0 else None)
        phases.append(Phase("slip" if rate > 0 else "jam", begun, run.p))
        if over:
            return phases
        run.ut = [run.ut[0] * 0]
    hold = -nt / tt  # tangential impulse a unit of normal impulse that keeps the contact from slipping
    begun = run.p
    if abs(hold) <= mu:
        run.straight(nn + nt * hold, [run.ut[0] * 0], [hold], None)
        phases.append(Phase("stick", begun, run.p))
    else:
        side = sp.sign(nt)
        run.straight(nn - mu * side * nt, [nt - mu * side * tt], [-mu * side], None)
        phases.append(Phase("reverse", begun, run.p))
    return phases


# -- space ------------------------------------------------------------------------------------------------------------

_STEP = 0.01  # of the slip's own decay; RK4 leaves about 1e-9 of the slip


def _in_space(g: Matrix, run: _Run, mu: Number) -> list[Phase]:
    """Follow the impact in space: integrate the hodograph of the slip, then stick or straight slip."""
    phases: list[Phase] = []
    for name in ("e", "first", "p", "un", "work"):
        setattr(run, name, float(getattr(run, name)))
    run.ut, run.rt = [float(u) for u in run.ut], [float(r) for r in run.rt]
    m = [[float(g[i, j]) for j in range(3)] for i in range(3)]
    friction = math.inf if mu == sp.oo else float(mu)
    if math.hypot(*run.ut) > 0:
        begun = run.p
        over, jammed = _swerve(m, run, friction)
        phases.append(Phase("jam" if jammed else "slip", begun, run.p))
        if over:
            return phases
        run.ut = [0.0, 0.0]
    det = m[1][1] * m[2][2] - m[1][2] * m[2][1]
    hold = [-(m[2][2] * m[0][1] - m[1][2] * m[0][2]) / det, -(m[1][1] * m[0][2] - m[1][2] * m[0][1]) / det]
    begun = run.p
    if math.hypot(*hold) <= friction:
        run.straight(m[0][0] + m[0][1] * hold[0] + m[0][2] * hold[1], [0.0, 0.0], hold, None)
        phases.append(Phase("stick", begun, run.p))
    else:
        rates, pushes = _ray(m, friction)
        run.straight(m[0][0] + m[0][1] * pushes[0] + m[0][2] * pushes[1], rates, pushes, None)
        phases.append(Phase("reverse", begun, run.p))
    return phases


def _ray(m: list[list[float]], mu: float) -> tuple[list[float], list[float]]:
    """Return the only direction s in which slip can start again and grow: G_tn - mu G_tt s = k s with k > 0."""

    def turn(angle: float) -> tuple[float, float]:
        s = (math.cos(angle), math.sin(angle))
        rate = [m[i + 1][0] - mu * (m[i + 1][1] * s[0] + m[i + 1][2] * s[1]) for i in (0, 1)]
        return s[0] * rate[1] - s[1] * rate[0], s[0] * rate[0] + s[1] * rate[1]

    count = 720
    for k in range(count):
        low, high = 2 * math.pi * k / count, 2 * math.pi * (k + 1) / count
        if turn(low)[0] >= 0 > turn(high)[0] and turn(low)[1] > 0:  # a stable ray: the slip turns towards it
            for _ in range(80):
                middle = (low + high) / 2
                low, high = (middle, high) if turn(middle)[0] >= 0 else (low, middle)
            s = (math.cos(low), math.sin(low))
            k_s = turn(low)[1]
            return [k_s * s[0], k_s * s[1]], [-mu * s[0], -mu * s[1]]
    raise CaromError("percussion: the contact can neither stick nor slip; its inverse mass is not a rigid body's")


def rk4(flow: Callable[[list[float]], list[float]], y: list[float], h: float) -> list[float]:
    """Return y after a step h of y' = flow(y), by the classical method of Runge and Kutta."""
    k1 = flow(y)
    k2 = flow([a + h / 2 * b for a, b in zip(y, k1, strict=True)])
    k3 = flow([a + h / 2 * b for a, b in zip(y, k2, strict=True)])
    k4 = flow([a + h * b for a, b in zip(y, k3, strict=True)])
    return [a + h / 6 * (b + 2 * c + 2 * d + f) for a, b, c, d, f in zip(y, k1, k2, k3, k4, strict=True)]


def _swerve(m: list[list[float]], run: _Run, mu: float) -> tuple[bool, bool]:
    """Integrate in s, dp = |u_t| ds, in which the slip decays smoothly; return whether the impact is over, and has jammed."""
    first = math.hypot(*run.ut)
    step = _STEP / max(mu * (m[1][1] + m[2][2]) + abs(m[0][1]) + abs(m[0][2]), 1e-300)
    jammed = False

    def flow(y: list[float]) -> list[float]:
        size = math.hypot(y[2], y[3])
        push = [size, -mu * y[2], -mu * y[3]]
        speed = [sum(m[i][j] * push[j] for j in range(3)) for i in range(3)]
        return [push[0], speed[0], speed[1], speed[2], push[1], push[2], y[1] * push[0]]

    def until(y: list[float], h: float, passed: Callable[[list[float]], bool]) -> list[float]:
        low, high = 0.0, h
        for _ in range(60):
            middle = (low + high) / 2
            low, high = (low, middle) if passed(rk4(flow, y, middle)) else (middle, high)
        return rk4(flow, y, high)

    def ended(y: list[float]) -> bool:
        if run.p_c is None:
            return False
        if run.hypothesis == "newton":
            return bool(y[1] >= -run.e * run.first)
        if run.hypothesis == "poisson":
            return bool(y[0] >= (1 + run.e) * run.p_c)
        return bool(y[6] - run.work_c >= -(run.e**2) * run.work_c)

    y = [run.p, run.un, *run.ut, *run.rt, run.work]
    over = False
    while math.hypot(y[2], y[3]) > 1e-12 * first:
        new = rk4(flow, y, step)
        jammed = jammed or (run.p_c is None and new[1] < y[1])
        if run.p_c is None and y[1] < 0 <= new[1]:
            y = until(y, step, lambda z: z[1] >= 0)
            run.p_c, run.work_c = y[0], y[6]
            if run.e == 0:
                over = True
                break
            continue
        if ended(new):
            y = until(y, step, ended)
            over = True
            break
        y = new
        if math.hypot(y[2], y[3]) > 1e12 * first:
            raise CaromError("percussion: the slip grows without end")
    run.p, run.un, run.ut, run.rt, run.work = y[0], y[1], y[2:4], y[4:6], y[6]
    return over, jammed


# ----------------------------------------------------------------------------------------------------
# Solve for a jump by two independent methods: virtual displacements, and impulse and momentum with Lagrange multipliers.
#
# Both take the mass matrix, the speeds just before, the acting constraint rows and the directions of their impulses. They share
# no intermediate result, and the tests compare them.


Redundant = dict[str, dict[str, Expr]]


@dataclass(frozen=True)
class Instant:
    """The impulsive problem: mass matrix, speeds just before, acting rows, directions of their impulses, known impulse."""

    mass: Matrix
    u0: Matrix
    rows: list[ConstraintRow]
    columns: Matrix
    impulse: Matrix


def value_of(row: ConstraintRow, speeds: Matrix) -> Expr:
    """Return the velocity that a constraint row measures, for given speeds."""
    return tidy((row.coefficients * speeds)[0] + row.drift)


def split_rows(rows: Sequence[ConstraintRow]) -> tuple[list[int], Redundant]:
    """Return the indices of independent rows, and each redundant row's name with the combination that implies it.

    Raises CaromError where a row depends on others but asks for another value.
    """
    if not rows:
        return [], {}
    kept, dependent = independent_rows(sp.Matrix.vstack(*[r.coefficients for r in rows]))
    redundant = {}
    for i, how in dependent.items():
        said = {rows[j].name: c for j, c in how.items()}
        gap = rows[i].drift - sum((c * rows[j].drift for j, c in how.items()), sp.S.Zero)
        if not is_zero(gap):
            raise CaromError(f"constraints: {rows[i].name} contradicts {', '.join(said) or '0 = 0'}")
        redundant[rows[i].name] = said
    return kept, redundant


def targets(at: Instant) -> tuple[list[int], dict[int, Expr]]:
    """Return the independent rows, and the velocity along each just after; redundant rows must ask for the same."""
    rows = at.rows
    kept, redundant = split_rows(rows)
    wants = {
        i: -r.drift if r.closing == 0 else -r.drift - r.closing * value_of(r, at.u0)
        for i, r in enumerate(rows)
        if r.closing is not None
    }
    by_name = {r.name: i for i, r in enumerate(rows)}
    for name, how in redundant.items():
        i = by_name[name]
        if i not in wants or any(by_name[n] not in wants for n in how):
            continue
        gap = wants[i] - sum((c * wants[by_name[n]] for n, c in how.items()), sp.S.Zero)
        if not is_zero(gap):
            raise CaromError(
                f"constraints: {name} follows from {', '.join(how)}, but their restitution asks for another velocity "
                f"afterwards (they differ by {tidy(gap)})"
            )
    return kept, {i: wants[i] for i in kept if i in wants}


def _not_closed(rows: Sequence[ConstraintRow], kept: list[int], wanted: Mapping[int, Expr]) -> CaromError:
    loose = ", ".join(rows[i].name for i in kept if i not in wanted)
    return CaromError(
        f"jump: expected a closing equation for every acting constraint, got none for {loose}; give its restitution or call "
        "close(...)"
    )


def solve_by_displacements(at: Instant) -> Matrix:
    """Return the speeds just after: momenta along virtual displacements are conserved, and restitution closes the rest."""
    rows = at.rows
    kept, wanted = targets(at)
    basis = null_basis(at.columns.T)
    left = [basis.T * at.mass] + [rows[i].coefficients for i in sorted(wanted)]
    right = [basis.T * (at.mass * at.u0 + at.impulse)] + [sp.Matrix([wanted[i]]) for i in sorted(wanted)]
    matrix = sp.Matrix.vstack(*left)
    if matrix.rows != matrix.cols:
        raise _not_closed(rows, kept, wanted)
    return solve_linear(matrix, sp.Matrix.vstack(*right), "jump equations")


def solve_by_multipliers(at: Instant) -> tuple[Matrix, dict[str, Expr]]:
    """Return the speeds just after and the impulses: M (u1 - u0) = sum of impulses, with restitution as closing equations."""
    rows = at.rows
    kept, wanted = targets(at)
    if len(wanted) < len(kept):
        raise _not_closed(rows, kept, wanted)
    n, r = at.mass.rows, len(kept)
    push = at.columns.extract(list(range(n)), kept)
    table = sp.zeros(n + r, n + r)
    table[:n, :n] = at.mass
    right = sp.zeros(n + r, 1)
    right[:n, 0] = at.mass * at.u0 + at.impulse
    if r:
        table[:n, n:] = -push
        table[n:, :n] = sp.Matrix.vstack(*[rows[i].coefficients for i in kept])
        right[n:, 0] = sp.Matrix([wanted[i] for i in kept])
    found = solve_linear(table, right, "impulse and momentum")
    return found[:n, :], {rows[i].name: found[n + k] for k, i in enumerate(kept)}


def impulses_of(at: Instant, kept: list[int], u1: Matrix) -> dict[str, Expr]:
    """Return the impulses of a known jump: the multipliers whose sum is the change of momentum."""
    if not kept:
        return {}
    rows = at.rows
    push = at.columns.extract(list(range(at.mass.rows)), kept)
    change = at.mass * (u1 - at.u0) - at.impulse
    pick, _ = independent_rows(push)
    found = solve_linear(push.extract(pick, list(range(len(kept)))), change.extract(pick, [0]), "impulses")
    for gap in push * found - change:
        if not is_zero(gap):
            raise CaromError(
                "jump: the speeds afterwards require an impulse along a displacement that no constraint resists"
            )
    return {rows[i].name: found[k] for k, i in enumerate(kept)}


def relations_before(held: Sequence[ConstraintRow], before: Sequence[Expr]) -> dict[Expr, Expr]:
    """Return the speeds just before that the constraints held until then determine, in terms of the other speeds."""
    kept, _ = split_rows(held)
    system = sp.Matrix.vstack(*[held[i].coefficients for i in kept])
    bound = bound_columns(system)
    loose = [j for j in range(system.cols) if j not in bound]
    right = -sp.Matrix([held[i].drift for i in kept])
    if loose:
        right -= system.extract(list(range(len(kept))), loose) * sp.Matrix([before[j] for j in loose])
    found = solve_linear(system.extract(list(range(len(kept))), bound), right, "constraints before the instant")
    return {before[j]: found[i] for i, j in enumerate(bound)}


def prescribe_poisson_impulses(
    at: Instant, restitution: Mapping[str, Expr], contacts: set[str]
) -> tuple[Instant, dict[str, Expr]]:
    """Apply Poisson's rule: solve compression, then prescribe (1 + e) times its normal impulses as known impulses.

    ``restitution`` maps the normal rows to e; the rows of all ``contacts`` are held during compression. Return the remaining
    problem and the prescribed impulses.
    """
    ends = [replace(r, closing=sp.S.Zero) if r.name.split(".")[0] in contacts else r for r in at.rows]
    _, squeeze = solve_by_multipliers(replace(at, rows=ends))
    impulse, known, keep = at.impulse, dict[str, Expr](), []
    for i, row in enumerate(at.rows):
        if row.name in restitution:
            if row.name not in squeeze:
                raise CaromError(f"contact {row.name}: redundant, so Poisson's rule does not determine its impulse")
            known[row.name] = tidy((1 + restitution[row.name]) * squeeze[row.name])
            impulse = impulse + at.columns[:, i] * known[row.name]
        else:
            keep.append(i)
    columns = at.columns.extract(list(range(at.mass.rows)), keep)
    return replace(at, rows=[at.rows[i] for i in keep], columns=columns, impulse=impulse), known


# ----------------------------------------------------------------------------------------------------
# The inverse mass that a contact feels (Delassus operator), and what follows from it.
#
# That is: the gain of normal velocity while the contact slides, the friction coefficient above which it jams, the energy that
# Newton's rule takes from a sticking contact, and the conditions under which a contact's assumed mode is valid.


def delassus(mass: Matrix, contact: Sequence[ConstraintRow], held: Sequence[ConstraintRow], where: str) -> Matrix:
    """Return the inverse mass G of a contact while the ``held`` constraints stay satisfied: du = G dp.

    Rows and columns: normal, then tangents; symmetric, kg^-1 for velocities in m/s. ``where`` names the contact in errors.
    """
    n = mass.rows
    own = sp.Matrix.vstack(*[r.coefficients for r in contact])
    kept, _ = split_rows(held)
    table = sp.zeros(n + len(kept), n + len(kept))
    table[:n, :n] = mass
    if kept:
        block = sp.Matrix.vstack(*[held[i].coefficients for i in kept])
        table[n:, :n] = block
        table[:n, n:] = block.T
    right = sp.zeros(n + len(kept), own.rows)
    right[:n, :] = own.T
    return (own * solve_linear(table, right, where)[:n, :]).applyfunc(tidy)


def slide_gain(inverse_mass: Matrix, friction: Expr, slip: Sequence[Expr]) -> Expr:
    """Return d u_n / d p of a contact that slides along ``slip``; where it is not positive the contact jams (Painlevé)."""
    g = inverse_mass
    return tidy(g[0, 0] - friction * sum((g[0, i + 1] * s for i, s in enumerate(slip)), sp.S.Zero))


def contact_conditions(
    contact: Contact, mode: str, approach: Expr, impulses: dict[str, Expr], slip: Sequence[Expr], gain: Expr | None
) -> dict[str, Expr]:
    """Return the relations under which a contact's mode ("stick", "slide", "smooth", "open") is valid.

    ``approach`` is the normal velocity just before. For a sliding contact ``slip`` is the unit direction of its slip, ``gain``
    its :func:`slide_gain`, and its tangential impulses are added to ``impulses``.
    """
    if mode == "open":
        return {}
    name, push = contact.name, impulses[f"{contact.name}.n"]
    found = {f"{name} approaches": sp.Lt(approach, 0)}
    found[f"{name} pushes"] = sp.Ge(push, 0)
    if mode == "stick" and contact.friction != sp.oo:
        drag = tidy(sum((impulses[f"{name}.t{i + 1}"] ** 2 for i in range(len(contact.tangents))), sp.S.Zero))
        found[f"{name} cone"] = sp.Le(drag, tidy(contact.friction**2 * push**2))  # (29)
    if gain is not None:
        for i, s in enumerate(slip):
            impulses[f"{name}.t{i + 1}"] = tidy(-contact.friction * s * push)
        found[f"{name} does not jam"] = sp.Gt(gain, 0)
        if gain.is_nonpositive:
            warnings.warn(
                f"contact {name}: friction {contact.friction} jams the slip (d u_n / d p = {gain}); "
                "follow it with percussion(...)",
                FrictionJam,
                stacklevel=4,
            )
    return found


def jam_friction(inverse_mass: Matrix) -> Expr:
    """Return the friction coefficient above which some slip jams (Painlevé), G_nn / |G_nt|; oo where none does."""
    g = inverse_mass
    if all(is_zero(g[0, i]) for i in range(1, g.cols)):
        return sp.oo
    cross = sp.Abs(g[0, 1]) if g.cols == 2 else sp.sqrt(sum((g[0, i] ** 2 for i in range(1, g.cols)), sp.S.Zero))
    return g[0, 0] / cross


# ----------------------------------------------------------------------------------------------------
# Compile a symbolic jump to a function of numbers, for one state or for arrays of them.


# A generated function has no file to be cached beside; a division by zero raises, as in Python.
OPTIONS: dict[str, Any] = {"cache": False, "error_model": "python"}


def compile_jump(jump: Jump, speeds: Speeds, arguments: Sequence[Expr] | None = None) -> Callable[..., Any]:
    """Compile a jump with Numba.

    Parameters
    ----------
    jump : Jump
        Result of :meth:`ImpulsiveMotion.solve`.
    speeds : Speeds
        The speeds of that motion.
    arguments : sequence of Expr, optional
        The symbols that the function takes, in order. Default: the speeds just before, then every other symbol by name.

    Returns
    -------
    callable
        ``f(*arguments) -> (after, impulses, energy_change)``: arrays whose last axis runs over the speeds, and over
        ``jump.impulses``; the arguments are numbers or arrays that broadcast. ``f.arguments`` lists them, ``f.kernel`` is the
        compiled scalar function. Impulses that rigid bodies leave undetermined (``jump.free_impulses``) are set to zero.

    Raises
    ------
    CaromError
        Where ``arguments`` lacks a symbol that the jump contains.
    """
    open_split = dict.fromkeys(jump.free_impulses, sp.S.Zero)
    outputs = [jump.after[u] for u in speeds.names]
    outputs += [sp.sympify(x).xreplace(open_split) for x in jump.impulses.values()]
    outputs.append(jump.energy_change)
    needed = {a for x in outputs for a in atoms_of(sp.sympify(x))}
    if arguments is None:
        own = [u for u in speeds.before if u in needed]
        arguments = own + sorted(needed - set(own), key=str)
    missing = sorted(str(a) for a in needed - set(arguments))
    if missing:
        raise CaromError(f"lambdify: arguments: expected every symbol of the jump; it also needs {', '.join(missing)}")
    many, count = len(arguments), len(outputs)
    formulas = sp.lambdify(list(arguments), tuple(sp.sympify(x) for x in outputs), modules="math", cse=True)
    kernel = njit(formulas, **OPTIONS)
    # one call per row, its arguments written out: Numba does not unpack arrays in calls
    call = ", ".join(f"rows[i, {k}]" for k in range(many))
    put = "; ".join(f"out[i, {k}] = r[{k}]" for k in range(count))
    source = f"def rows_of(rows, out):\n    for i in range(rows.shape[0]):\n        r = kernel({call})\n        {put}\n"
    space: dict[str, Any] = {"kernel": kernel}
    exec(source, space)
    rows_of = njit(space["rows_of"], **OPTIONS)
    split = speeds.count

    def run(*values: Any) -> tuple[Any, Any, Any]:
        if len(values) != many:
            raise CaromError(
                f"lambdify: expected {many} arguments ({', '.join(map(str, arguments))}), got {len(values)}"
            )
        arrays = np.broadcast_arrays(*[np.asarray(v, dtype=np.float64) for v in values]) if values else [np.zeros(())]
        shape = arrays[0].shape
        rows = np.stack([a.reshape(-1) for a in arrays], axis=-1)
        out = np.empty((rows.shape[0], count))
        for part in row_slices(len(rows)):
            rows_of(rows[part], out[part])
        out = out.reshape((*shape, count))
        return out[..., :split], out[..., split:-1], out[..., -1]

    run.arguments = tuple(arguments)  # type: ignore[attr-defined]
    run.kernel = kernel  # type: ignore[attr-defined]
    return run
