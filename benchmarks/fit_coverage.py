"""Do error bars keep what they promise? 1,000 made-up tables; how often the truth lies within one and two (1.96) of them.

    python benchmarks/fit_coverage.py [runs] [--only NAME] [--rows FILE]

Prints, for each kind of table, the share of 68.3 % and 95 % beside the counting error of so many runs; how far off the numbers are
on average, and how far they scatter, both in error bars; then how long fits take. With --rows every table is written down as it is
done, and a run goes on from what is there.
"""

from __future__ import annotations

import argparse
import time
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np
from coverage_rows import Kept, shares

import carom
from carom.fitting import Setting, fit_law, make_problem, with_bootstrap, with_profiles
from carom.fitting.laws import laws_named
from carom.rebounds import make_rebounds

A, KAPPA = 0.02, 2 / 3
BALL = carom.Ball(radius=A, mass=0.0027, inertia="hollow")
SETTING = Setting(radius=A, kappa=KAPPA)
TRUTH = {"restitution": 0.8, "friction": 0.2, "tangential_restitution": 0.3, "spin_mean": 0.4, "spin_width": 0.35}
NAMES = ("v_n_in", "v_t_in", "spin_in", "v_n_out", "v_t_out", "spin_out")


@dataclass(frozen=True)
class Kind:
    """How made-up tables are made, and fitted."""

    law: str
    rows: int
    sigma_v: float
    sigma_spin: float
    unknown: bool = False
    """Whether spins before the wall were not measured."""
    spin_seen: bool = False
    """Whether those after it were, then."""
    profiles: bool = False


KINDS = {
    "40 bounces, all measured": Kind("contact", 40, 0.02, 2.0),
    "40 bounces, spin after measured only": Kind("sliding", 40, 0.03, 2.0, unknown=True, spin_seen=True),
    "60 bounces, no spin measured": Kind("sliding", 60, 0.03, 2.0, unknown=True),
    "40 bounces, ten times the noise": Kind("contact", 40, 0.2, 20.0),
    "40 bounces, ten times the noise, by profiles": Kind("contact", 40, 0.2, 20.0, profiles=True),
}
KINDS |= {
    f"{name}, by profiles": replace(KINDS[name], profiles=True)
    for name in ("40 bounces, spin after measured only", "60 bounces, no spin measured")
}


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


def one(kind: Kind, seed: int) -> dict[str, Any]:
    """A table, fitted: of each number (fitted - true) / error, or whether profiles hold it; None where it got no error bar."""
    law = laws_named([kind.law], "planar", True)[0][0]
    made = bounces(seed, kind.rows, kind.sigma_v, kind.sigma_spin, kind.unknown, kind.spin_seen)
    took = time.process_time()
    fit = fit_law(law, make_problem(make_rebounds("planar", made), SETTING)[0])
    fit = with_profiles(fit) if kind.profiles else fit
    found: dict[str, Any] = {"seconds": time.process_time() - took}
    for name, estimate in fit.estimates.items():
        found[name] = None
        if kind.profiles and estimate.interval_68 and estimate.interval_95:
            found[name] = [low <= TRUTH[name] <= high for low, high in (estimate.interval_68, estimate.interval_95)]
        elif not kind.profiles and estimate.value is not None and estimate.stderr:
            found[name] = (estimate.value - TRUTH[name]) / estimate.stderr
    return found


def times() -> None:
    """How long fits take."""
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


def main() -> None:
    """A line a number on standard output."""
    parser = argparse.ArgumentParser(description=__doc__.split("\n", maxsplit=1)[0])
    parser.add_argument("runs", nargs="?", type=int, default=1000)
    parser.add_argument(
        "--only", default="", help="kinds of tables whose names begin so; 'times': only how long fits take"
    )
    parser.add_argument("--rows", type=Path, help="keep every table here, a line each; go on from what is there")
    given = parser.parse_args()
    kept = Kept(given.rows)
    for name, kind in KINDS.items():
        if name == given.only or (given.only not in KINDS and name.startswith(given.only)):
            count = max(given.runs // 3, 20) if kind.profiles else given.runs
            rows = kept.fill(name, range(count), lambda seed, kind=kind: one(kind, seed))
            took = np.mean([row["seconds"] for row in rows])
            for number in [number for number in rows[0] if number in TRUTH]:
                print(
                    f"{name:50} {number:24} {shares([row[number] for row in rows])}; {took:.2f} s a table", flush=True
                )
    if "times".startswith(given.only):
        times()


if __name__ == "__main__":
    main()
