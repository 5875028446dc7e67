"""Likelihood with a prior of flexible shape for spins that were not measured: a mixture of normal distributions.

The likelihood of a row under a mixture is the sum of its likelihoods under the components, each weighted with the component's
share. Scores are those of the components, weighted with the row's probability of having come from each (Fisher's identity); so is
the information, which is that of the rows with known component, an upper bound (Dempster, Laird & Rubin, J. R. Stat. Soc. B 39, 1
(1977)).
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from carom.fitting.deviance import SPIN_MEAN, SPIN_WIDTH
from carom.fitting.likelihood import Evaluation, LikelihoodModel, evaluate

__all__ = ["SpinMixture", "evaluate_components", "evaluate_mixture", "mixture_deviances"]

Array = NDArray[np.float64]


class SpinMixture(NamedTuple):
    """A prior of spins: normal distributions with shares (C,), means (C,) in v_t/a and widths (C,) in v/a."""

    share: Array
    mean: Array
    width: Array

    @property
    def parameters(self) -> int:
        """Number of adjusted parameters: the shares add up to 1."""
        return 3 * len(self.share) - 1

    @property
    def in_words(self) -> str:
        """The components, largest first."""
        order = np.argsort(-self.share)
        return ", ".join(f"{self.share[i]:.0%} at {self.mean[i]:.2f} ± {self.width[i]:.2f}" for i in order)

    def given(self, p: Array) -> Array:
        """Return numbers (B C, K) of all components for p (B, K)."""
        every = np.repeat(p, len(self.share), axis=0)
        every[:, SPIN_MEAN], every[:, SPIN_WIDTH] = np.tile(self.mean, len(p)), np.tile(self.width, len(p))
        return every


def evaluate_components(likelihood: LikelihoodModel, every: Array, components: int) -> Evaluation:
    """Evaluate the rows under each component, for numbers (B C, K): all results have (B, C, N) in place of (B, N)."""
    seen = vars(evaluate(likelihood, every, by_row=True))
    return Evaluation(**{name: x.reshape(len(x) // components, components, *x.shape[1:]) for name, x in seen.items()})


def mixture_deviances(deviance: Array, log_share: Array) -> tuple[Array, Array]:
    """Return the rows' deviances (B, N), and their probabilities (B, C, N) of each component, from the components' likelihoods."""
    logs = log_share[:, :, None] - deviance / 2
    top = logs.max(axis=1, keepdims=True)
    total = top[:, 0] + np.log(np.exp(logs - top).sum(axis=1))
    return -2 * total, np.exp(logs - total[:, None])


def evaluate_mixture(
    likelihood: LikelihoodModel, mixture: SpinMixture, p: Array, weights: Array | None
) -> Evaluation:  # fmt: skip
    """Evaluate the likelihood under a mixture at B sets of numbers p (B, K), with weights (B or 1, N) of the rows."""
    seen = evaluate_components(likelihood, mixture.given(p), len(mixture.share))
    deviance, belongs = mixture_deviances(seen.deviance, np.log(mixture.share)[None])
    chi2 = np.take_along_axis(seen.chi2, np.argmax(belongs, axis=1)[:, None], axis=1)[:, 0]
    weighted = belongs if weights is None else belongs * weights[:, None]
    scores, information = (np.einsum("bcn,bcn...->b...", weighted, x) for x in (seen.scores, seen.information))
    return Evaluation(deviance, chi2, scores, information)
