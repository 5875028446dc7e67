"""Random numbers by counting: known answers, distributions, the same compiled."""

import math

import numpy as np
import pytest

from carom.core.jit.compile import njit
from carom.core.random import exponential, logarithm, normals, threefry, uniform

ONES = 0xFFFFFFFF


@pytest.mark.parametrize(
    ("key", "count", "known"),
    [
        # Random123's known answers for threefry2x32 with 20 rounds
        ((0, 0), (0, 0), (0x6B200159, 0x99BA4EFE)),
        ((ONES, ONES), (ONES, ONES), (0x1CB996FC, 0xBB002BE7)),
        ((0x13198A2E, 0x03707344), (0x243F6A88, 0x85A308D3), (0xC4923A9C, 0x483DF7A0)),
    ],
)
def test_known_answers(key, count, known):
    assert threefry(*key, *count) == known


def test_logarithm():
    x = np.exp(np.random.default_rng(0).uniform(-40, 1, 3000))
    assert max(abs(logarithm(v) - math.log(v)) / max(abs(math.log(v)), 1e-300) for v in x.tolist()) < 1e-15
    assert logarithm(1.0) == 0.0


def test_compiled_and_distributed():
    def many(n):
        found = np.zeros((n, 4))
        for k in range(n):
            found[k, 0] = uniform(3, 5, k)
            found[k, 1] = exponential(3, 6, k)
            found[k, 2], found[k, 3], _next = normals(3, 7, 10 * k)
        return found

    found = njit(many, cache=False)(20_000)
    assert (found[:50] == many(50)).all()
    bounds = 5 / math.sqrt(20_000)
    assert ((found[:, 0] > 0) & (found[:, 0] < 1)).all()
    for moment in (1, 2, 3):
        assert (found[:, 0] ** moment).mean() == pytest.approx(1 / (moment + 1), abs=bounds)
        assert (found[:, 1] ** moment).mean() == pytest.approx(math.factorial(moment), rel=5 * bounds)
    for k in (2, 3):
        assert found[:, k].mean() == pytest.approx(0, abs=bounds)
        assert (found[:, k] ** 2).mean() == pytest.approx(1, abs=1.5 * bounds)
        assert (found[:, k] ** 4).mean() == pytest.approx(3, abs=10 * bounds)
    assert np.corrcoef(found[:-1, 0], found[1:, 0])[0, 1] == pytest.approx(0, abs=bounds)
