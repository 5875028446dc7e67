"""Random impacts under every law, up to its limits: energy, restitution, friction cone, angular momentum, nothing undefined.

    python campaigns/random_impacts.py [MILLIONS] [--only NAME] [--rows FILE]

MILLIONS of impacts (100) for each law: speeds over six orders of magnitude, any spin, normals along axes and in all directions,
kappa from 1e-6, restitution 0 and 1, frictions 0 and infinite among the others. Each is judged by what every impact must keep,
computed from the states before and after alone. Errors are in units of the rounding of the largest number that takes part; an
impact with one above LIMIT is a fault, and the first of them is printed.
"""

from __future__ import annotations

import functools
import math
import time
from collections.abc import Callable, Sequence
from concurrent.futures import ThreadPoolExecutor
from typing import Any

import numpy as np
from campaign import Campaign, campaign

from carom.core.contact import friction_at_slip, slip_velocity
from carom.core.jit.compile import njit
from carom.core.jit.kernel import Vec, cross, dot, kernel
from carom.core.motion.phases import ROUNDING
from carom.laws.pair import pair_contact
from carom.laws.registry import LAWS
from carom.laws.two_step import two_step_final

BLOCK, FEW = 1_000_000, 300
LIMIT = 1000.0  # roundings
CHECKS = ("finite", "energy", "restitution", "friction cone", "angular momentum")
FINITE, ENERGY, RESTITUTION, CONE, MOMENTUM = range(len(CHECKS))
EPSILON = 2.0**-52
LOCKS, CEILING = 1.0, -0.9  # friction from which nose and table can hold a ball; a normal below which less is enough
AT_REST = 1e-100  # m/s: a ball without motion has no rounding
NUMBERS = 24  # of a case
CONTACTS = [law.name for law in LAWS.values() if law.kernel is not None and law.name != "conventional"]
KINDS = [*CONTACTS, "two-step, to rolling", "ball against ball"]


# --- random cases ---------------------------------------------------------------------------------------------------


@kernel
def any_vector(rng: Any, size: float) -> Any:
    """A random vector: in any direction, with zeros among its components, or none at all."""
    kind = rng.random()
    x, y, z = size * rng.normal(), size * rng.normal(), size * rng.normal()
    if kind < 0.1:
        x = 0.0
    elif kind < 0.2:
        y = z = 0.0
    elif kind < 0.25:
        x = y = z = 0.0
    return x, y, z


@kernel
def any_normal(rng: Any, upright: bool) -> Any:
    """A unit vector: along x, in the plane, or in any direction; an upright wall's, or a nose's that touches above the centre."""
    kind, z = rng.random(), 0.0 if upright else rng.normal()
    if kind < 0.3:
        return 1.0, 0.0, 0.0
    x, y = rng.normal(), rng.normal()
    length = math.sqrt(x * x + y * y + z * z)
    return x / length, y / length, z / length


@kernel
def one_of(rng: Any, low: float, high: float, inside: float) -> float:
    """One of the two limits, or (with another chance of one half) what lies inside."""
    kind = rng.random()
    if kind < 0.25:
        return low
    return high if kind < 0.5 else inside


@kernel
def any_kappa(rng: Any) -> float:
    """Of solid and hollow balls, and down to a mass in the centre."""
    kind = rng.random()
    if kind < 0.5:
        return 0.4 if kind < 0.3 else 2 / 3
    return 10.0 ** rng.uniform(-3.0, -0.18) if kind < 0.95 else 1e-6


@kernel
def any_size(rng: Any) -> float:
    """Three orders of magnitude to either side of 1."""
    return 10.0 ** rng.uniform(-3.0, 3.0)


@kernel
def any_friction(rng: Any) -> float:
    """None, infinite, or anything between."""
    return one_of(rng, 0.0, math.inf, 10.0 ** rng.uniform(-4.0, 2.0))


# --- what every impact keeps ----------------------------------------------------------------------------------------


@kernel
def energy(v: Any, w: Any, a: float, kappa: float) -> float:
    """(20), per mass."""
    return (dot(v, v) + kappa * a * a * dot(w, w)) / 2


@kernel
def judge(v: Any, w: Any, v1: Any, w1: Any, n: Any, a: float, kappa: float, e: float, mu: float, errors: Any) -> None:
    """Write the errors of one contact of a ball with a wall, in roundings, by place of CHECKS."""
    scale = math.sqrt(dot(v, v)) + a * math.sqrt(dot(w, w)) + AT_REST
    j = (v1[0] - v[0], v1[1] - v[1], v1[2] - v[2])
    jn = dot(j, n)
    f = (j[0] - jn * n[0], j[1] - jn * n[1], j[2] - jn * n[2])
    # (the spin changes by the impulse over kappa a, and with it every rounding)
    unit = EPSILON * scale * (1 + 1 / kappa)
    errors[FINITE] = 0.0 if math.isfinite(dot(v1, v1) + dot(w1, w1)) else math.inf
    before = energy(v, w, a, kappa)
    errors[ENERGY] = max(0.0, energy(v1, w1, a, kappa) - before) / (EPSILON * scale * scale * (1 + 1 / kappa))
    errors[RESTITUTION] = abs(dot(v1, n) + e * dot(v, n)) / unit
    errors[CONE] = max(0.0, math.sqrt(dot(f, f)) - mu * jn) / unit if mu < math.inf else 0.0
    # (28): about the contact point, a n x dv + kappa a^2 d(omega) = 0
    t = cross(n, j)
    m = (t[0] + kappa * a * (w1[0] - w[0]), t[1] + kappa * a * (w1[1] - w[1]), t[2] + kappa * a * (w1[2] - w[2]))
    errors[MOMENTUM] = math.sqrt(dot(m, m)) / unit


@kernel
def at_fault(errors: Any, worst: Any) -> bool:
    """Keep the largest error of each kind; return whether one of them is a fault."""
    bad = False
    for k in range(len(errors)):
        worst[k] = max(worst[k], errors[k])
        bad = bad or not errors[k] <= LIMIT
    return bad


@functools.cache
def contact_loop(
    law: Callable[..., Any],
    elastic: bool,
    rough: bool,
    smooth: bool,
    low: float,
    high: float,
    cushion: bool,
    falls: Vec,
) -> Any:
    """Return the loop over random contacts under a law; ``low`` to ``high``: its last number.
    ``falls``: mu, drop and rate of a friction of its own, which falls with the slip; zeros for the surface's.

    ``cushion``: it keeps a ball on its table, whose force enters the other balances: of such a ball only the energy is judged.
    """

    def loop(rng: Any, count: int, worst: Any, case: Any, errors: Any) -> int:
        faults = 0
        for _ in range(count):
            n = any_normal(rng, False)
            speed, a, kappa = any_size(rng), any_size(rng), any_kappa(rng)
            v, w = any_vector(rng, speed), any_vector(rng, speed / a * any_size(rng))
            un = dot(v, n)
            if un > 0:
                v = (v[0] - 2 * un * n[0], v[1] - 2 * un * n[1], v[2] - 2 * un * n[2])
            e, mu = one_of(rng, 0.0, 1.0, rng.random()), any_friction(rng)
            last = one_of(rng, low, high, low + (high - low) * rng.random())
            v1, w1 = law(v, w, n, a, kappa, e, mu, last)
            used = 1.0 if elastic else e
            if falls[1] > 0:
                slip = slip_velocity(v, w, n, a)[1]
                mu = friction_at_slip(falls[0], falls[1], falls[2], math.sqrt(dot(slip, slip)))
            judge(v, w, v1, w1, n, a, kappa, used, math.inf if rough else 0.0 if smooth else mu, errors)
            if cushion and v[2] == 0:
                errors[RESTITUTION] = errors[CONE] = errors[MOMENTUM] = 0.0
                # no prediction of a ball that is locked between nose and table, or under a nose that is nearly a ceiling
                if math.isnan(v1[0]) and (max(mu, last) >= LOCKS or n[2] < CEILING):
                    errors[FINITE] = errors[ENERGY] = 0.0
            if at_fault(errors, worst):
                faults += 1
                if faults == 1:
                    case[:9] = (v[0], v[1], v[2], w[0], w[1], w[2], n[0], n[1], n[2])
                    case[9:14] = (a, kappa, e, mu, last)
        return faults

    return loop


def two_step_loop(rng: Any, count: int, worst: Any, case: Any, errors: Any) -> int:
    """Whole impacts on a table, to rolling: energy falls, the ball moves away from the wall and rolls."""
    faults = 0
    for _ in range(count):
        n = any_normal(rng, rng.random() < 0.5)
        if n[2] > 0:
            n = (n[0], n[1], -n[2])
        speed, a, kappa = any_size(rng), any_size(rng), any_kappa(rng)
        v, w = any_vector(rng, speed), any_vector(rng, speed / a * any_size(rng))
        h = 0.0 if rng.random() < 0.7 else a * rng.random()
        v = (v[0], v[1], 0.0 if h == 0 else v[2])
        un = dot(v, n)
        if un > 0:
            v, w = (-v[0], -v[1], -v[2]), (-w[0], -w[1], -w[2])
        e, mu = one_of(rng, 0.0, 1.0, rng.random()), any_friction(rng)
        ef, muf = one_of(rng, 0.0, 0.9, 0.9 * rng.random()), 10.0 ** rng.uniform(-3.0, 1.0)
        v3, w3, why = two_step_final(v, w, n, a, kappa, e, mu, 0.0, ef, muf, 0.0, 9.8, h, rng.random() < 0.5)
        scale = math.sqrt(dot(v, v)) + a * math.sqrt(dot(w, w)) + math.sqrt(2 * 9.8 * h) + AT_REST
        unit = EPSILON * scale * (1 + 1 / kappa)
        errors[:] = 0.0
        if why == 0:
            errors[FINITE] = 0.0 if math.isfinite(dot(v3, v3) + dot(w3, w3)) else math.inf
            errors[ENERGY] = max(0.0, energy(v3, w3, a, kappa) - energy(v, w, a, kappa) - 9.8 * h) / (unit * scale)
            # (along the wall within the rounding that the law allows for)
            errors[RESTITUTION] = max(0.0, -(v3[0] * n[0] + v3[1] * n[1]) - ROUNDING * scale) / unit
            # (27): rolling
            errors[MOMENTUM] = (abs(v3[0] - a * w3[1]) + abs(v3[1] + a * w3[0]) + abs(v3[2])) / unit
        if at_fault(errors, worst):
            faults += 1
            if faults == 1:
                case[:9] = (v[0], v[1], v[2], w[0], w[1], w[2], n[0], n[1], n[2])
                case[9:16] = (a, kappa, e, mu, ef, muf, h)
    return faults


def pair_loop(rng: Any, count: int, worst: Any, case: Any, errors: Any) -> int:
    """Ball against ball: momentum and angular momentum of both, energy, restitution, cone."""
    faults = 0
    for _ in range(count):
        n, speed = any_normal(rng, False), any_size(rng)
        a1, a2, m1, m2 = any_size(rng), any_size(rng), any_size(rng), any_size(rng)
        k1, k2 = any_kappa(rng), any_kappa(rng)
        v1, v2 = any_vector(rng, speed), any_vector(rng, speed)
        w1, w2 = any_vector(rng, speed / a1), any_vector(rng, speed / a2)
        if dot(v1, n) > dot(v2, n):
            v1, v2 = v2, v1
        e, mu, beta = (
            one_of(rng, 0.0, 1.0, rng.random()),
            any_friction(rng),
            one_of(rng, -1.0, 1.0, rng.uniform(-1.0, 1.0)),
        )
        x1, y1, x2, y2, j, _required, _regime = pair_contact(v1, w1, v2, w2, n, a1, m1, k1, a2, m2, k2, e, mu, beta)
        scale = AT_REST + math.sqrt(dot(v1, v1)) + math.sqrt(dot(v2, v2))
        scale += a1 * math.sqrt(dot(w1, w1)) + a2 * math.sqrt(dot(w2, w2))
        unit, heavy = EPSILON * scale * (1 + 1 / k1 + 1 / k2), m1 + m2
        gone = m1 * (energy(v1, w1, a1, k1) - energy(x1, y1, a1, k1)) + m2 * (
            energy(v2, w2, a2, k2) - energy(x2, y2, a2, k2)
        )
        errors[FINITE] = 0.0 if math.isfinite(dot(x1, x1) + dot(y1, y1) + dot(x2, x2) + dot(y2, y2)) else math.inf
        errors[ENERGY] = max(0.0, -gone) / (heavy * unit * scale)
        was = dot((v1[0] - v2[0], v1[1] - v2[1], v1[2] - v2[2]), n)
        now = dot((x1[0] - x2[0], x1[1] - x2[1], x1[2] - x2[2]), n)
        jn = dot(j, n)
        errors[RESTITUTION] = abs(now + e * was) / unit if jn > 0 else 0.0
        f = (j[0] - jn * n[0], j[1] - jn * n[1], j[2] - jn * n[2])
        errors[CONE] = max(0.0, math.sqrt(dot(f, f)) - mu * jn) / (heavy * unit) if mu < math.inf else 0.0
        p = 0.0
        for k in range(3):
            p = max(p, abs(m1 * (x1[k] - v1[k]) + m2 * (x2[k] - v2[k])))
        # the contact points exert opposite forces: both spins turn the same way
        t = cross(n, j)
        for k in range(3):
            p = max(p, abs(k1 * m1 * a1 * (y1[k] - w1[k]) + t[k]), abs(k2 * m2 * a2 * (y2[k] - w2[k]) + t[k]))
        errors[MOMENTUM] = p / (heavy * unit)
        if at_fault(errors, worst):
            faults += 1
            if faults == 1:
                case[:18] = (*v1, *w1, *v2, *w2, *n, a1, m1, k1)
                case[18:24] = (a2, m2, k2, e, mu, beta)
    return faults


def loop_of(name: str) -> Any:
    """Return the loop of a kind, as plain Python."""
    if name == "two-step, to rolling":
        return two_step_loop
    if name == "ball against ball":
        return pair_loop
    law = LAWS[name]
    pinned = law.pinned
    low, high = {"stiffness_ratio": (0.2, 3.0), "floor_friction": (0.0, 2.0)}.get(law.last, (-1.0, 1.0))
    rough, smooth = pinned.get("friction", 0.5) == math.inf, pinned.get("friction") == 0
    falls, elastic = law.slip_friction or (0.0, 0.0, 0.0), pinned.get("restitution") == 1
    return contact_loop(law.kernel, elastic, rough, smooth, low, high, bool(law.on_table), falls)


def one(loop: Any, seed: int, count: int) -> dict[str, Any]:
    """A block: its faults, the worst errors, the first faulty case."""
    worst, case, errors = np.zeros(len(CHECKS)), np.zeros(NUMBERS), np.zeros(len(CHECKS))
    faults = loop(np.random.default_rng(seed), count, worst, case, errors)
    return {"count": count, "faults": int(faults), "worst": worst.tolist(), "case": case.tolist() if faults else None}


def main(words: Sequence[str] | None = None) -> int:
    """A line a law; 1 if there is a fault."""
    with campaign("random_impacts", __doc__, words, count=100, small=1) as run:
        return int(sum(report(run, name) for name in KINDS if run.small or run.wants(name, KINDS)) > 0)


def report(run: Campaign, name: str) -> int:
    """Judge the impacts under one law, on all cores."""
    begin, count = time.monotonic(), FEW if run.small else BLOCK
    # (a few are judged by plain Python, which needs nothing compiled)
    loop = loop_of(name) if run.small else njit(loop_of(name), nogil=True, cache=False)
    with ThreadPoolExecutor() as pool:
        blocks = {seed: pool.submit(one, loop, seed, count) for seed in range(run.count)
                  if (name, seed) not in run.rows.known}  # fmt: skip
        rows = run.rows.fill(name, range(run.count), lambda seed: blocks[seed].result())
    worst = np.max([row["worst"] for row in rows], axis=0)
    faults, total = sum(row["faults"] for row in rows), sum(row["count"] for row in rows)
    said = ", ".join(f"{check} {error:.2g}" for check, error in zip(CHECKS[1:], worst[1:], strict=True))
    run.say(
        f"{name:22} {total:,} impacts, {faults} faults; worst, in roundings: {said}; {time.monotonic() - begin:.0f} s"
    )
    for row in rows:
        if row["faults"]:
            run.say("    the first:", *(f"{x!r}" for x in row["case"]))
            break
    return int(faults)


if __name__ == "__main__":
    raise SystemExit(main())
