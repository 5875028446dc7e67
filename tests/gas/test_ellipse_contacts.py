"""When a disc in an ellipse touches it, as a curve: against its distance, sampled closely."""

import functools
import math

import numpy as np
import pytest

from carom.core.geometry.curve_arcs import arc_hit, arc_tables
from carom.scene.figures import EllipsePiece
from carom.scene.figures.polygons import ellipse_depth


@functools.cache
def arcs(p, q):
    piece = EllipsePiece((p, q))
    return arc_tables(piece.at, *piece.span())


@pytest.mark.parametrize("pull", [0.0, 0.3, 3.0, 30.0])
@pytest.mark.parametrize("start", ["within", "on it", "along it"])
@pytest.mark.slow(keep=4)
def test_the_first_touch(pull, start):
    # balls smaller and larger than the smallest circle of curvature
    rng = np.random.default_rng(2)
    for k in range(40):
        p, q = ((1.0, 0.8), (0.6, 2.5), (3.0, 1.0), (1.3, 1.3))[k % 4]
        a, gap = float(rng.uniform(0.05, 0.9)) * min(p, q), -1.0
        while gap <= 0:
            x = rng.uniform(-1, 1, 2) * (p, q)
            gap = float(ellipse_depth(p, q, x)) - a
        v, g = rng.normal(size=2), rng.normal(size=2) * pull
        if start != "within":
            n = np.zeros(2)
            for _ in range(60):  # to where it touches, along the normal
                n = np.array(
                    [float(ellipse_depth(p, q, x + d) - ellipse_depth(p, q, x - d)) / 2e-6 for d in 1e-6 * np.eye(2)]
                )
                n /= np.hypot(*n)
                x = x - (float(ellipse_depth(p, q, x)) - a) * n
            v = v * np.sign(v @ n)
            if start == "along it":
                v -= (v @ n) * n * (1 - 10.0 ** -rng.integers(1, 6))
        s = min(
            arc_hit(table, 0, a, 0.0, *x.tolist(), *v.tolist(), *g.tolist(), math.inf, 1e-14) for table in arcs(p, q)
        )
        if start != "within" and s < 1e-8:
            continue  # (by so much it is not known whether it touches)
        t = s * np.linspace(0, 1, 2001)

        def far(t):
            return ellipse_depth(p, q, x + v * t[:, None] + g * t[:, None] ** 2 / 2) - a  # noqa: B023

        assert far(t).min() > -1e-9
        assert abs(far(t[-1:])[0]) < 1e-9
        # and it goes out there
        later = s + 1e-5 / math.hypot(*(v + g * s))
        assert far(np.array([later]))[0] < 1e-10
