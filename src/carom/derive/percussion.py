"""Follow one rough contact through its impact, as a function of the normal impulse p: slip, reversal, stick, jam.

In the plane the velocities are piecewise linear in p (Routh, *Dynamics of a System of Rigid Bodies*, 1905, arts. 180
to 203) and the answer is exact for exact numbers. In space the slip may swerve (Keller, J. Appl. Mech. 53, 1986, 1);
there the hodograph is integrated. Newton's, Poisson's and Stronge's (Proc. R. Soc. A 431, 1990, 169) rules end the
impact.
"""

from __future__ import annotations

import math
import warnings
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

import sympy as sp

from carom.derive.jump import EnergyGain
from carom.derive.linear import Matrix
from carom.errors import CaromError

__all__ = ["Percussion", "Phase", "follow"]

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


def follow(g: Matrix, start: Sequence[Number], e: Number, mu: Number, hypothesis: str = "stronge") -> Percussion:
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
    phases = _in_plane(g, run, mu) if size == 2 else _in_space(g, run, mu)
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
    if mu == sp.oo and _stopped_at_once(g, run):
        return phases
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
    if mu == sp.oo and _stopped_at_once(g, run):
        return phases
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

    def rk4(y: list[float], h: float) -> list[float]:
        k1 = flow(y)
        k2 = flow([a + h / 2 * b for a, b in zip(y, k1, strict=True)])
        k3 = flow([a + h / 2 * b for a, b in zip(y, k2, strict=True)])
        k4 = flow([a + h * b for a, b in zip(y, k3, strict=True)])
        return [a + h / 6 * (b + 2 * c + 2 * d + f) for a, b, c, d, f in zip(y, k1, k2, k3, k4, strict=True)]

    def until(y: list[float], h: float, passed: Callable[[list[float]], bool]) -> list[float]:
        low, high = 0.0, h
        for _ in range(60):
            middle = (low + high) / 2
            low, high = (low, middle) if passed(rk4(y, middle)) else (middle, high)
        return rk4(y, high)

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
        new = rk4(y, step)
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
