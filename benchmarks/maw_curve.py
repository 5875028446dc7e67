"""Solve the curve of tangential compliance anew, and say how far the table that carom reads is from finer solutions.

python benchmarks/maw_curve.py [--write]
"""

from __future__ import annotations

import sys
from importlib import resources

import numpy as np

from carom.laws import maw

if "--write" in sys.argv:
    path = resources.files("carom.laws").joinpath("maw_curve.csv")
    np.savetxt(str(path), maw.table().reshape(-1, maw.STEPS + 1), fmt="%.6f", delimiter=",")
rng = np.random.default_rng(1)
chi = np.exp(rng.uniform(*np.log(maw.CHI), 200))
psi = rng.uniform(0.02, 1.0, 200) * np.maximum(4 * chi - 1, 1)
gap = [maw.slip_kept(p, c) * p - maw.solve(p, c, 900, 9000) for p, c in zip(psi, chi, strict=True)]
print(f"psi after the impact, table - finer solution: rms {np.std(gap):.1e}, largest {np.abs(gap).max():.1e}")
