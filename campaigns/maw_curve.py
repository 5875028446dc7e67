"""How far the table of the curve of tangential compliance, which carom reads, is from finer solutions of it.

    python campaigns/maw_curve.py [N] [--write]

N points (200) of the curve are solved with finer steps. ``--write`` solves the table anew first.
"""

from __future__ import annotations

from collections.abc import Sequence
from importlib import resources

import numpy as np
from campaign import campaign

from carom.laws import maw


def main(words: Sequence[str] | None = None) -> None:
    """A line."""
    with campaign("maw_curve", __doc__, words, count=200, small=2, write={"action": "store_true"}) as run:
        if run.given.write:
            path = resources.files("carom.laws").joinpath("maw_curve.csv")
            np.savetxt(str(path), maw.compute_curve_table().reshape(-1, maw.STEPS + 1), fmt="%.6f", delimiter=",")
        rng = np.random.default_rng(1)
        chi = np.exp(rng.uniform(*np.log(maw.CHI), run.count))
        psi = rng.uniform(0.02, 1.0, run.count) * np.maximum(4 * chi - 1, 1)
        gap = [
            maw.maw_slip_ratio(p, c) * p - maw.integrate_hertz_springs(p, c, 900, 9000)
            for p, c in zip(psi, chi, strict=True)
        ]
        run.say(f"psi after the impact, table - finer solution: rms {np.std(gap):.1e}, largest {np.abs(gap).max():.1e}")


if __name__ == "__main__":
    main()
