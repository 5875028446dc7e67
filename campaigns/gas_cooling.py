"""Rough balls that cool: mean field, the same contacts without places (Monte Carlo), and the gas itself, ever more dilute.

    python campaigns/gas_cooling.py [seeds]

Mean field takes velocities and spins to be Maxwellians with nothing in common. Direct simulation Monte Carlo (after Bird, Molecular
Gas Dynamics, 1994) draws the pairs and the directions of contacts at random and keeps whatever velocities and spins come to
have in common; only places are missing. A dilute gas should tend to it.
"""

import math
from collections.abc import Sequence

import numba
import numpy as np
from campaign import Campaign, campaign
from gas_physics import BALL, DISC, cooling, rough_rates

import carom

STOPS = np.array([2, 4, 10, 20])  # contacts a ball


@numba.njit  # type: ignore[untyped-decorator]
def monte_carlo(balls, axes, e, beta, q, rng, stops):  # type: ignore[no-untyped-def]
    """T_rot / T_tr after so many contacts a ball; masses and radii 1, moments of inertia q."""
    v, w = rng.normal(0, 1, (balls, 3)), rng.normal(0, 1, (balls, 3)) / math.sqrt(q)
    about = 1 if axes == 2 else 3
    if axes == 2:
        v[:, 2], w[:, 0], w[:, 1] = 0, 0, 0
    found, eta, fastest, done, stop = np.zeros(len(stops)), (1 + beta) * q / (1 + q), 6.0, 0, 0
    while stop < len(stops):
        i, j = int(rng.random() * balls), int(rng.random() * balls)
        n = rng.normal(0, 1, 3)
        if axes == 2:
            n[2] = 0
        n /= math.sqrt((n * n).sum())
        g = v[i] - v[j]
        approach = (g * n).sum()
        fastest = max(fastest, approach)
        if i == j or rng.random() * fastest > approach:
            continue
        slip = g - approach * n + np.cross(w[i] + w[j], n)
        p = -(1 + e) / 2 * approach * n - eta / 2 * slip
        v[i] += p
        v[j] -= p
        turn = np.cross(n, p) / q
        w[i] += turn
        w[j] += turn
        done += 1
        if done % (balls // 2) == 0:  # the law has no scale of speed: warm again, so that pairs go on being found
            warm = math.sqrt((v * v).sum() / (axes * balls))
            v /= warm
            w /= warm
            fastest = 6.0
        if 2 * done >= stops[stop] * balls:
            found[stop] = q * (w * w).sum() / about / ((v * v).sum() / axes)
            stop += 1
    return found


def mean_field(axes: int, e: float, beta: float, q: float) -> list[float]:
    """The same of Maxwellians, by the collisions n of a ball: (d/2) dT_tr = (1/2) dE_tr dn."""
    rates, about, step, tr, rot, found = rough_rates(e, beta, q, axes), 1 if axes == 2 else 3, 0.001, 1.0, 1.0, []
    for k in range(1, round(STOPS[-1] / step) + 1):
        d_tr, d_rot = rates(tr, rot)
        tr, rot = tr + d_tr / axes * step, rot + d_rot / about * step
        if k * step in STOPS:
            found.append(rot / tr)
    return found


def gas(axes: int, e: float, beta: float, density: float, balls: int, seed: int) -> list[float]:
    """The same of a gas from a start at random."""
    found, done = [], 0
    one = cooling(BALL if axes == 3 else DISC, balls, density, carom.Surface(e, math.inf, beta), seed)
    for stop in STOPS:
        one.advance(int(stop - done) * balls // 2)
        done = int(stop)
        tr, rot = one.energy()[:2]
        found.append(rot / (1 if axes == 2 else 3) / (tr / axes))
    return found


def show(run: Campaign, name: str, runs: list[list[float]]) -> None:
    """A line: means, and their largest error."""
    error = np.std(runs, axis=0).max() / math.sqrt(len(runs)) if len(runs) > 1 else 0.0
    run.say(f"  {name:32}" + "".join(f"{x:9.4f}" for x in np.mean(runs, axis=0)) + f"   +- {error:.4f}")


def main(words: Sequence[str] | None = None) -> None:
    """Print the table."""
    with campaign("gas_cooling", __doc__, words, count=60, small=1) as run:
        seeds = run.count
        for axes, e, beta in ((2, 0.9, -0.6), (3, 0.9, 0.0)):
            q = 0.5 if axes == 2 else 0.4
            kind = "discs" if axes == 2 else "spheres"
            if not run.wants(kind, ("discs", "spheres")):
                continue
            run.say(f"{kind}, e = {e}, beta = {beta}: T_rot/T_tr after {STOPS} contacts a ball")
            show(run, "mean field", [mean_field(axes, e, beta, q)])
            rngs = [np.random.default_rng(seed) for seed in range(max(seeds // 6, 2))]
            # (compiling takes longer than a few balls as plain Python)
            draw, balls = (monte_carlo.py_func, 50) if run.small else (monte_carlo, 20_000)
            show(run, "Monte Carlo", [draw(balls, axes, e, beta, q, rng, STOPS) for rng in rngs])
            for density, balls in ((0.2, 200), (0.02, 200), (0.002, 1000))[: 1 if run.small else 3]:
                runs = [
                    gas(axes, e, beta, density / (axes - 1), balls, seed)
                    for seed in range(max(200 * seeds // balls, 2))
                ]
                show(run, f"{balls} balls, density {density / (axes - 1)}", runs)


if __name__ == "__main__":
    main()
