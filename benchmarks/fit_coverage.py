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
from carom.fitting import Setting, fit_law, make_problem, with_bootstrap
from carom.fitting.laws import laws_named
from carom.rebounds import make_rebounds

A, KAPPA = 0.02, 2 / 3
BALL = carom.Ball(radius=A, mass=0.0027, inertia="hollow")
SETTING = Setting(radius=A, kappa=KAPPA)
TRUTH = {"restitution": 0.8, "friction": 0.2, "tangential_restitution": 0.3, "spin_width": 0.35}
NAMES = ("v_n_in", "v_t_in", "spin_in", "v_n_out", "v_t_out", "spin_out")


def bounces(seed: int, n: int, sigma_v: float, sigma_spin: float, unknown: bool) -> dict[str, np.ndarray]:
    rng = np.random.default_rng(seed)
    vn, vt = rng.uniform(1, 4, n), rng.uniform(-3, 3, n)
    spin = TRUTH["spin_width"] * np.hypot(vn, vt) / A * rng.normal(size=n)
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
    if unknown:
        columns["spin_in"] = columns["spin_out"] = np.full(n, np.nan)
    return columns


def coverage(title: str, law: str, n: int, sigma_v: float, sigma_spin: float, unknown: bool, runs: int) -> None:
    chosen = laws_named([law], "planar", True)[0][0]
    pulls: dict[str, list[float]] = {}
    for seed in range(runs):
        table = make_rebounds("planar", bounces(seed, n, sigma_v, sigma_spin, unknown))
        for name, estimate in fit_law(chosen, make_problem(table, SETTING)[0]).estimates.items():
            if estimate.value is not None and estimate.stderr:
                pulls.setdefault(name, []).append((estimate.value - TRUTH[name]) / estimate.stderr)
    for name, found in pulls.items():
        share = [float(np.mean(np.abs(found) < width)) for width in (1, 1.96)]
        error = [math.sqrt(p * (1 - p) / len(found)) for p in (0.683, 0.95)]
        print(
            f"{title:34s} {name:24s} {100 * share[0]:5.1f} % of 68.3 +- {100 * error[0]:.1f}  {100 * share[1]:5.1f} % of 95.0 +-"
            f" {100 * error[1]:.1f}  mean pull {np.mean(found):+.3f} +- {1 / math.sqrt(len(found)):.3f}  ({len(found)} tables)",
            flush=True,
        )


def main() -> None:
    runs = int(sys.argv[1]) if len(sys.argv) > 1 else 1000
    coverage("40 bounces, all measured", "contact", 40, 0.02, 2.0, False, runs)
    coverage("40 bounces, ten times the noise", "contact", 40, 0.2, 20.0, False, runs)
    coverage("40 bounces, spin not measured", "sliding", 40, 0.03, 2.0, True, max(runs // 5, 20))
    contact = laws_named(["contact"], "planar", True)[0][0]
    many, _ = make_problem(make_rebounds("planar", bounces(0, 10_000, 0.02, 2.0, False)), SETTING)
    few, _ = make_problem(make_rebounds("planar", bounces(0, 100, 0.02, 2.0, False)), SETTING)
    fit_law(contact, many)
    start, cpu = time.perf_counter(), time.process_time()
    fit_law(contact, many)
    print(
        f"one law, 10,000 rebounds: {time.perf_counter() - start:.2f} s ({time.process_time() - cpu:.2f} s of processor)"
    )
    fit = fit_law(contact, few)
    with_bootstrap(fit, 10)
    start, cpu = time.perf_counter(), time.process_time()
    with_bootstrap(fit, 1000)
    print(
        f"1,000 bootstrap fits of 100: {time.perf_counter() - start:.2f} s ({time.process_time() - cpu:.2f} s of processor)"
    )


if __name__ == "__main__":
    main()
