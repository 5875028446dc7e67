"""Surfaces as a population: the parameters of several surfaces, or balls, come from one distribution, which is fitted with them.

Every number of a surface, the logarithm of its scatter among them, is normal about a common mean with a common width (empirical
Bayes: Efron & Morris, J. Am. Stat. Assoc. 70, 311 (1975)). Mean and widths are those of an expectation-maximisation in which each
surface's numbers are normal about their best place (Laplace). A surface with few rows is drawn to the mean, one with many stays
where its rows put it; a new surface has the mean and the widths.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from carom.data.rebounds import Rebounds
from carom.errors import CaromError, Fault
from carom.fitting.data import make_problem
from carom.fitting.fit import fit_law
from carom.fitting.laws import laws_named
from carom.fitting.predictive import Prediction, Predictive, impacts, predictive_of
from carom.fitting.result import Fit
from carom.fitting.setting import Setting
from carom.fitting.usable_rows import usable_rows
from carom.fitting.varying import VaryingFit, VaryingModel, varying_model

__all__ = ["Population", "SurfaceFit", "fit_population"]

Array = NDArray[np.float64]
ROUNDS, SETTLED = 30, 1e-2
FIRST_WIDTH = 0.3  # of each number over the surfaces
LEAST_WIDTH = 1e-3
LEAST_ROWS = 3


@dataclass(frozen=True, eq=False)
class SurfaceFit:
    """One surface of a population."""

    name: str
    rows: int
    fit: VaryingFit
    """With the common distribution."""
    alone: Fit
    """Without."""

    @property
    def values(self) -> Array:
        """(k,) its numbers."""
        return self.fit.q

    @property
    def stderr(self) -> Array:
        """(k,)"""
        return np.asarray(np.sqrt(np.diag(np.linalg.pinv(self.fit.information, hermitian=True))))

    @property
    def shrinkage(self) -> Array:
        """(k,) the share of each number that comes from the common distribution: 0 the rows alone, 1 the mean."""
        precision = np.diag(self.fit.model.precision)
        return np.asarray(np.clip(precision * np.square(self.stderr), 0.0, 1.0))


@dataclass(frozen=True, eq=False)
class Population:
    """Several surfaces under one law, and their common distribution; made by :func:`fit_population`.

    Examples
    --------
    >>> from carom.data import published_rebounds
    >>> from carom.fitting import Setting, fit_population
    >>> rackets = published_rebounds("tt_rackets").rebounds
    >>> both = fit_population(rackets, Setting(radius=0.02, kappa=2 / 3), by="racket")
    >>> both.names[:3], both.predict([[6.0, 1.0, 0.0]]).mean.shape
    (('restitution', 'friction', 'tangential_restitution'), (1, 3))
    """

    law: str
    names: tuple[str, ...]
    """Of the numbers: parameters of the law, then the logarithms of scatters."""
    mean: Array
    """(k,)"""
    width: Array
    """(k,) standard deviations over the surfaces."""
    surfaces: dict[str, SurfaceFit]

    def predict(self, before: Any, surface: str | None = None) -> Prediction:
        """Return mean and covariance of the states after a surface's wall; without a name, after a new surface's."""
        if surface is not None and surface not in self.surfaces:
            raise CaromError(Fault("", "surface", f"one of {', '.join(self.surfaces)}", repr(surface)))
        one = self.surfaces[surface] if surface else next(iter(self.surfaces.values()))
        said = predictive_of(one.fit) if surface else self._new(one.fit.model)
        return said.at(impacts(one.fit.model.problem, before))

    def _new(self, model: VaryingModel) -> Predictive:
        """Return the prior of a surface that has not been measured."""
        m = model.parts["smooth"].stop
        variance = np.square(self.width[:m]) * (1 + 1 / len(self.surfaces))
        # (the mean of a scatter that is known to a factor exp(width) is larger than the scatter of the mean's logarithm)
        q = self.mean.copy()
        q[m:] += np.square(self.width[m:])
        return Predictive(replace(model, prior=None), q, np.diag(variance), float(model.problem.count))

    def add(self, rebounds: Rebounds, setting: Setting, name: str = "new") -> Population:
        """Return the population with one more surface, whose few rows are read in the light of the others; these stay."""
        alone = _alone(rebounds, setting, self.law)
        model = replace(varying_model(alone), prior=(self.mean, 1 / np.square(self.width)))
        fit = _placed(model, [self.mean, model.start()])
        return replace(self, surfaces=self.surfaces | {name: SurfaceFit(name, len(rebounds), fit, alone)})

    def as_dict(self) -> dict[str, Any]:
        """Return the population for JSON."""
        return {
            "law": self.law,
            "mean": dict(zip(self.names, self.mean.tolist(), strict=True)),
            "width": dict(zip(self.names, self.width.tolist(), strict=True)),
            "surfaces": {
                name: {"rows": one.rows, "values": dict(zip(self.names, one.values.tolist(), strict=True)),
                       "stderr": dict(zip(self.names, one.stderr.tolist(), strict=True)),
                       "shrinkage": dict(zip(self.names, one.shrinkage.tolist(), strict=True)),
                       "alone": {key: found.value for key, found in one.alone.estimates.items()}}
                for name, one in self.surfaces.items()
            },
        }  # fmt: skip


def _alone(rebounds: Rebounds, setting: Setting, law: str) -> Fit:
    chosen = laws_named([law], rebounds.kind, setting.contact_height == 1.0)[0][0]
    return fit_law(chosen, make_problem(rebounds, setting)[0])


def _placed(model: VaryingModel, starts: list[Array]) -> VaryingFit:
    """Return the most likely numbers of a surface under the common distribution."""
    q, value, information = model.minimize(np.clip(np.array(starts), *model.bounds))
    best = int(np.argmin(value))
    return VaryingFit(model, q[best], float(value[best]) - model.penalty(q[best])[0], information[best])


def fit_population(
    rebounds: Rebounds, setting: Setting, by: str = "surface", law: str = "contact", **choice: Any
) -> Population:
    """Fit one law to several surfaces, or balls, whose parameters have a common distribution.

    Parameters
    ----------
    rebounds : Rebounds
        With a column that names the surface of each row.
    setting : Setting
        The ball; forms of parameters that depend on the impact.
    by : str
        The column.
    law : str
    choice
        As for :func:`carom.fitting.usable_rows`.

    Returns
    -------
    Population

    Raises
    ------
    CaromError
        For fewer than two surfaces, surfaces of fewer than three rows, and spins that were not measured.

    Examples
    --------
    >>> from carom.data import published_rebounds
    >>> from carom.fitting import Setting
    >>> rackets = published_rebounds("tt_rackets").rebounds
    >>> both = fit_population(rackets, Setting(radius=0.02, kappa=2 / 3), by="racket")
    >>> [(name, one.rows) for name, one in both.surfaces.items()]
    [('01_inverted', 14), ('10_antispin', 24)]
    """
    rows, setting = usable_rows(rebounds, setting, **choice)
    if by not in rows.extra:
        known = ", ".join(rows.extra) or "none"
        raise CaromError(
            Fault(rows.source, f"column {by}", f"a column that names the surface of each row, one of {known}", "none")
        )
    label = np.array([str(one) for one in rows.extra[by].tolist()])
    names, counts = np.unique(label, return_counts=True)
    few = [f"{name} ({count})" for name, count in zip(names, counts, strict=True) if count < LEAST_ROWS]
    if len(names) < 2 or few:
        got = f"rows: {', '.join(few)}" if few else f"{len(names)} surface"
        raise CaromError(Fault(rows.source, f"column {by}", f"two surfaces or more, of {LEAST_ROWS} rows or more", got))
    alone = {name: _alone(rows.select(label == name), setting, law) for name in names.tolist()}
    models = [varying_model(fit) for fit in alone.values()]
    pooled = varying_model(_alone(rows, setting, law))
    mean = pooled.minimize(pooled.start()[None])[0][0]
    width, fits, starts = (
        np.full(len(mean), FIRST_WIDTH),
        list[VaryingFit](),
        [[model.start(), mean] for model in models],
    )
    for _ in range(ROUNDS):
        prior = (mean, 1 / np.square(width))
        fits = [_placed(replace(model, prior=prior), at) for model, at in zip(models, starts, strict=True)]
        q = np.array([fit.q for fit in fits])
        spread = np.array([np.diag(np.linalg.pinv(fit.information, hermitian=True)) for fit in fits])
        new = q.mean(axis=0)
        wide = np.sqrt((np.square(q - new) + spread).sum(axis=0) / len(fits))
        moved = np.abs(new - mean).max() + np.abs(np.log(wide / width)).max()
        mean, width, starts = new, np.maximum(wide, LEAST_WIDTH), [[one] for one in q]
        if moved < SETTLED:
            break
    base = models[0]
    places = {place: name for name, place in base.base.places.items()}
    scatter = list(next(iter(alone.values())).scatter)
    labels = (*(places[i] for i in base.free.tolist()), *(f"log scatter {name}" for name in scatter))
    surfaces = {
        name: SurfaceFit(name, len(fit.problem.x), placed, fit)
        for (name, fit), placed in zip(alone.items(), fits, strict=True)
    }
    return Population(law, labels, mean, width, surfaces)
