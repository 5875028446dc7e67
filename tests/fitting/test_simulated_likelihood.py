"""The likelihood of numbers by simulations, where it is known."""

from __future__ import annotations

import numpy as np
import pytest

from carom.fitting.simulated_likelihood import interval, likelihood_of, plausible


def found(features, measured, numbers=1, count=3000):
    """Likelihood and plausible numbers from -1 to 1."""
    rng = np.random.default_rng(4)
    begin, end = -np.ones(numbers), np.ones(numbers)
    inputs = begin + (end - begin) * rng.random((count, numbers))
    simulated = likelihood_of(inputs, features(inputs, rng), np.array(measured))
    near, deviance = plausible([simulated.deviance], begin, end, rng)
    return simulated, near, [interval(deviance, near, begin, end, rise, rng) for rise in (1.0, 3.8415)]


def test_noise_that_all_features_share_and_noise_that_grows_are_those_of_the_simulations():
    def features(numbers, rng):
        # two features with one noise, as of points of one path: the difference tells the number ten times as well
        common, own = rng.standard_normal((len(numbers), 1)), rng.standard_normal((len(numbers), 2))
        size = np.exp(numbers / 2)  # noise
        return numbers * [1.0, -1.0] + size * (0.5 * common + 0.05 * own)

    simulated, near, (one, two) = found(features, [0.3, -0.3])
    error = 0.05 * np.exp(0.15) / np.sqrt(2)
    assert np.ptp(one, axis=0) == pytest.approx(2 * error, rel=0.1)
    assert np.ptp(two, axis=0) == pytest.approx(2 * 1.96 * error, rel=0.1)
    assert one.mean() == pytest.approx(0.3, abs=0.02)
    assert simulated.probability(near)[2] > 0.3
    # no number has features whose sum is so large
    unlike, near, _intervals = found(features, [4.3, 3.7])
    assert unlike.probability(near)[2] < 1e-6


def test_a_product_alone_tells_a_limit_of_each_number():
    def features(numbers, rng):
        return (numbers[:, :1] + 1) * (numbers[:, 1:] + 1) + 0.01 * rng.standard_normal((len(numbers), 1))

    _simulated, _near, (one, two) = found(features, [1.0], numbers=2)
    assert one[1] == pytest.approx([1, 1])  # the box's own end
    assert one[0] == pytest.approx([-0.5, -0.5], abs=0.03)  # where the other is 1
    assert (two[0] < one[0]).all()
