"""The first root of gap polynomials of degree 2, 4 and 8, judged with exact integers: worst relative error of each kind.

    python campaigns/first_roots.py [N]

N polynomials (10,000) of each kind: nearly double and triple roots, clusters, scales from 1e-12 to 1e12, starts at touch.
An error is a missed or made-up root (which ends the run), or a relative error beyond 1e-12.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from campaign import campaign
from reference.exact_roots import KINDS, PARABOLAS, make, make_parabolas, worst


def main(words: Sequence[str] | None = None) -> int:
    """A line a kind; 1 if an error is too large."""
    bad = 0
    with campaign("first_roots", __doc__, words, count=10_000, small=100) as run:
        names = [(2, kind) for kind in PARABOLAS] + [(degree, kind) for degree in (4, 8) for kind in KINDS]
        for seed, (degree, kind) in enumerate(names):
            name = f"degree {degree}, {kind}"
            if run.wants(name, [f"degree {d}, {k}" for d, k in names]):
                rng = np.random.default_rng(1000 + seed)
                error, hits = worst(
                    *(make_parabolas(kind, rng, run.count) if degree == 2 else make(kind, degree, rng, run.count))
                )
                run.say(f"{name:40} worst relative error {error:.1e}, {hits} roots of {run.count}")
                bad += error > 1e-12
    return int(bad > 0)


if __name__ == "__main__":
    raise SystemExit(main())
