"""Do error bars keep what they promise? 1,000 made-up tables; how often the truth lies within one and two (1.96) of them.

    python benchmarks/fit_coverage.py [runs]

Prints, for each kind of table, the share of 68.3 % and 95 % beside the counting error of so many runs; then how long fits take.
"""

from __future__ import annotations

import math
import sys
import time

import numpy as np

import carom
from carom.fitting import Setting, fit_law, make_problem, with_bootstrap, with_profiles
from carom.fitting.laws import laws_named
from carom.rebounds import make_rebounds

A, KAPPA = 0.02, 2 / 3
BALL = carom.Ball(radius=A, mass=0.0027, inertia="hollow")
SETTING = Setting(radius=A, kappa=KAPPA)
TRUTH = {"restitution": 0.8, "friction": 0.2, "tangential_restitution": 0.3, "spin_mean": 0.4, "spin_width": 0.35}
NAMES = ("v_n_in", "v_t_in", "spin_in", "v_n_out", "v_t_out", "spin_out")


def bounces(
    seed: int, n: int, sigma_v: float, sigma_spin: float, unknown: bool, spin_seen: bool = False
) -> dict[str, np.ndarray]:
    rng = np.random.default_rng(seed)
    vn, vt = rng.uniform(1, 4, n), rng.uniform(-3, 3, n)
    mean = TRUTH["spin_mean"] if unknown else 0.0
    spin = mean * vt / A + TRUTH["spin_width"] * np.hypot(vn, vt) / A * rng.normal(size=n)
    zero = np.zeros(n)
    state = carom.State(np.stack([-vn, vt, zero], -1), np.stack([zero, zero, spin], -1))
    beta = 0.0 if unknown else TRUTH["tangential_restitution"]
    after = carom.impact(BALL, state, surface=carom.Surface(TRUTH["restitution"], TRUTH["friction"], beta)).after
    columns = {}
    true = (vn, vt, spin, after.velocity[:, 0], after.velocity[:, 1], after.spin[:, 2])
    for name, values in zip(NAMES, true, strict=True):
        sigma = sigma_spin if "spin" in name else sigma_v
        columns[name] = values + sigma * rng.normal(size=n)
        columns[f"sigma_{name}"] = np.full(n, sigma)
    for name in ("spin_in", "spin_out") if not spin_seen else ("spin_in",):
        if unknown:
            columns[name] = np.full(n, np.nan)
    return columns


def coverage(
    title: str, law: str, n: int, sigma_v: float, sigma_spin: float, runs: int, *, unknown: bool = False,
    spin_seen: bool = False, profiles: bool = False,
) -> None:  # fmt: skip
    """How often the truth lies within one and 1.96 error bars, or within profiles; bars that were refused are counted."""
    chosen = laws_named([law], "planar", True)[0][0]
    held: dict[str, list[tuple[bool, bool]]] = {}
    refused: dict[str, int] = {}
    took = time.process_time()
    for seed in range(runs):
        table = make_rebounds("planar", bounces(seed, n, sigma_v, sigma_spin, unknown, spin_seen))
        fit = fit_law(chosen, make_problem(table, SETTING)[0])
        fit = with_profiles(fit) if profiles else fit
        for name, one in fit.estimates.items():
            truth = TRUTH[name] if name != "tangential_restitution" or not unknown else 0.0
            found = held.setdefault(name, [])
            if profiles and one.interval_68 and one.interval_95:
                found.append(tuple(low <= truth <= high for low, high in (one.interval_68, one.interval_95)))  # type: ignore[arg-type]
            elif not profiles and one.value is not None and one.stderr:
                pull = abs(one.value - truth) / one.stderr
                found.append((pull < 1, pull < 1.96))
            else:
                refused[name] = refused.get(name, 0) + 1
    took = time.process_time() - took
    for name, found in held.items():
        share = np.mean(found, axis=0)
        error = [math.sqrt(p * (1 - p) / len(found)) for p in (0.683, 0.95)]
        print(
            f"{title:44s} {name:24s} {100 * share[0]:5.1f} % of 68.3 +- {100 * error[0]:.1f}  {100 * share[1]:5.1f} % of 95.0 +-"
            f" {100 * error[1]:.1f}  ({len(found)} tables, {refused.get(name, 0)} told nothing; {took / runs:.2f} s a table)",
            flush=True,
        )


def main() -> None:
    runs = int(sys.argv[1]) if len(sys.argv) > 1 else 1000
    few = max(runs // 3, 20)
    coverage("40 bounces, all measured", "contact", 40, 0.02, 2.0, runs)
    coverage("40 bounces, ten times the noise", "contact", 40, 0.2, 20.0, runs)
    coverage("the same, by profiles", "contact", 40, 0.2, 20.0, few, profiles=True)
    coverage("40 bounces, spin after measured only", "sliding", 40, 0.03, 2.0, few, unknown=True, spin_seen=True)
    coverage("60 bounces, no spin measured", "sliding", 60, 0.03, 2.0, few, unknown=True)
    coverage("the same, by profiles", "sliding", 60, 0.03, 2.0, few, unknown=True, profiles=True)
    contact = laws_named(["contact"], "planar", True)[0][0]
    many, _ = make_problem(make_rebounds("planar", bounces(0, 10_000, 0.02, 2.0, False)), SETTING)
    some, _ = make_problem(make_rebounds("planar", bounces(0, 100, 0.02, 2.0, False)), SETTING)
    fit_law(contact, many)
    start, cpu = time.perf_counter(), time.process_time()
    fit_law(contact, many)
    print(
        f"one law, 10,000 rebounds: {time.perf_counter() - start:.2f} s ({time.process_time() - cpu:.2f} s of processor)"
    )
    fit = fit_law(contact, some)
    with_bootstrap(fit, 10)
    start, cpu = time.perf_counter(), time.process_time()
    with_bootstrap(fit, 1000)
    print(
        f"1,000 bootstrap fits of 100: {time.perf_counter() - start:.2f} s ({time.process_time() - cpu:.2f} s of processor)"
    )


if __name__ == "__main__":
    main()
