"""Laws fitted to measured rebounds and tracks: estimates with uncertainties, ranking, and which shot to film next.

ranking = fitting.fit_laws(carom.data.read_rebounds("bounces.csv"), fitting.Setting(radius=0.02, kappa=2 / 3))
ranking.verdict, ranking.best.estimates["friction"]
"""

from carom.public.guard import attach_public as _attach_public

__getattr__, __dir__, __all__ = _attach_public(__name__, __file__)
