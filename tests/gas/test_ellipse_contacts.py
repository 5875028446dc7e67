"""When a disc in an ellipse touches it: against its distance, sampled closely, and against what is known of ellipses."""

import math

import numpy as np
import pytest

from carom.core.geometry.outlines import ellipse_depth, inner_axes, oval_depth, oval_hit
from carom.core.roots.first_root import hit4


def test_distance_and_foot():
    rng = np.random.default_rng(0)
    for k in range(3000):
        p, q = rng.uniform(0.2, 3, 2).tolist()
        q = p if k % 10 == 0 else q
        x, y = rng.uniform(-1.2, 1.2, 2) * (p, q) * (k % 7 != 0, k % 11 != 0)
        depth, nx, ny, rho = oval_depth(p, q, float(x), float(y))
        assert depth == pytest.approx(float(ellipse_depth(p, q, np.array([x, y]))), abs=1e-11)
        assert math.hypot(nx, ny) == pytest.approx(1, abs=1e-15)
        # the foot is on the ellipse, its normal that of the ellipse there, its curvature too
        u, w = x - depth * nx, y - depth * ny
        assert (u / p) ** 2 + (w / q) ** 2 == pytest.approx(1, abs=1e-9)
        assert nx * w / q**2 == pytest.approx(ny * u / p**2, abs=1e-8 * (1 / p**2 + 1 / q**2) * max(p, q))
        assert rho == pytest.approx((p * q) ** 2 * ((u / p**2) ** 2 + (w / q**2) ** 2) ** 1.5, rel=1e-8)


def test_the_two_ellipses_about_the_curve_of_the_centres():
    rng = np.random.default_rng(1)
    for _ in range(500):
        p, q = rng.uniform(0.5, 3, 2).tolist()
        a, u = float(rng.uniform(0.01, 0.95)) * min(p, q), rng.uniform(0, 2 * math.pi)
        one, two = inner_axes(p, q, a)
        assert oval_depth(p, q, one * math.cos(u), two * math.sin(u))[0] >= a - 1e-12
        n = np.array([math.cos(u) / p, math.sin(u) / q])
        x = np.array([p * math.cos(u), q * math.sin(u)]) - a * n / np.hypot(*n)
        if oval_depth(p, q, *x.tolist())[0] > a - 1e-9:  # (else a ball as large does not come there)
            assert (x[0] / (p - a)) ** 2 + (x[1] / (q - a)) ** 2 <= 1 + 1e-12


@pytest.mark.parametrize("pull", [0.0, 0.3, 3.0, 30.0])
@pytest.mark.parametrize("start", ["within", "on it", "along it"])
def test_the_first_touch(pull, start):
    # balls smaller and larger than the smallest circle of curvature
    rng = np.random.default_rng(2)
    for _ in range(60):
        p, q = rng.uniform(0.5, 3, 2).tolist()
        a, gap = float(rng.uniform(0.05, 0.9)) * min(p, q), -1.0
        while gap <= 0:
            x, y = (rng.uniform(-1, 1, 2) * (p, q)).tolist()
            gap, nx, ny, _rho = oval_depth(p, q, x, y)
            gap -= a
        v, g = rng.normal(size=2), rng.normal(size=2) * pull
        if start != "within":
            x, y = x - gap * nx, y - gap * ny
            n = np.array(oval_depth(p, q, x, y)[1:3])
            v = v * np.sign(v @ n)
            if start == "along it":
                v -= (v @ n) * n * (1 - 10.0 ** -rng.integers(1, 8))
        s = oval_hit(p, q, a, 0.0, a, x, y, *v.tolist(), *g.tolist(), math.inf, 1e-14)
        t = s * np.linspace(0, 1, 2001)

        def far(t):
            return ellipse_depth(p, q, np.array([x, y]) + v * t[:, None] + g * t[:, None] ** 2 / 2) - a  # noqa: B023

        assert far(t).min() > -1e-9
        assert abs(far(t[-1:])[0]) < 1e-9
        # and it goes out there
        later = s + 1e-5 / math.hypot(*(v + g * s))
        assert far(np.array([later]))[0] < 1e-10


def test_a_circle_is_one():
    rng = np.random.default_rng(3)
    for _ in range(200):
        r, (x, y), (u, v), (g, h) = (
            2.0,
            rng.uniform(-1, 1, 2).tolist(),
            rng.normal(size=2).tolist(),
            rng.normal(size=2).tolist(),
        )
        c = (
            1.5**2 - x * x - y * y,
            -2 * (x * u + y * v),
            -(u * u + v * v + x * g + y * h),
            -(u * g + v * h),
            -(g * g + h * h) / 4,
        )
        s = oval_hit(r, r, 0.5, 0.0, 0.5, x, y, u, v, g, h, 50.0, 1e-14)
        assert s == pytest.approx(hit4(*c, 50.0, 0.0), rel=1e-12)
        # of a disc that grows, as fast as is known
        s = oval_hit(r, r, 0.3, 0.1, 1.9, x, y, u, v, 0.0, 0.0, math.inf, 1e-14)
        assert math.hypot(x + u * s, y + v * s) == pytest.approx(r - 0.3 - 0.1 * s, rel=1e-12)


def test_what_does_not_move_meets_nothing():
    assert oval_hit(3.0, 2.0, 0.5, 0.0, 0.5, 0.3, 0.2, 0.0, 0.0, 0.0, 0.0, math.inf, 0.0) == math.inf
    assert oval_hit(3.0, 2.0, 0.5, 0.0, 0.5, 0.3, 0.2, 1.0, 0.0, 0.0, 0.0, 1.0, 1e-14) == math.inf
