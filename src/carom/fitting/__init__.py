"""Laws against measured rebounds: fits, error bars, which law wins, which shot to film next.

ranking = fitting.fit_laws(carom.rebounds.read_rebounds("bounces.csv"), fitting.Setting(radius=0.02, kappa=2 / 3))
ranking.verdict, ranking.best.estimates["friction"]
"""

from __future__ import annotations

from carom.fitting.data import Problem, Setting, make_problem
from carom.fitting.fit import Estimate, Fit, fit_law
from carom.fitting.laws import FITTED, FittedLaw
from carom.fitting.outliers import Outlier
from carom.fitting.profile import with_bootstrap, with_profiles
from carom.fitting.rank import Ranked, Ranking, fit_laws

__all__ = [
    "FITTED",
    "Estimate",
    "Fit",
    "FittedLaw",
    "Outlier",
    "Problem",
    "Ranked",
    "Ranking",
    "Setting",
    "fit_law",
    "fit_laws",
    "make_problem",
    "with_bootstrap",
    "with_profiles",
]
