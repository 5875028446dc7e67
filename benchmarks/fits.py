"""How long fits take: one law to 10,000 rebounds, and 1,000 bootstrap fits to 100.

python benchmarks/fits.py
"""

from __future__ import annotations

import sys
import time
from pathlib import Path

from carom.data.rebounds import make_rebounds
from carom.fitting import fit_law, make_problem, with_bootstrap
from carom.fitting.laws import laws_named

sys.path.insert(0, str(Path(__file__).parents[1] / "tests"))
from reference.synthetic_bounces import SETTING, bounces


def main() -> None:
    """Two lines."""
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
