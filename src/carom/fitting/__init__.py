"""Laws fitted to measured rebounds and tracks: estimates with uncertainties, ranking, and which shot to film next.

ranking = fitting.fit_laws(carom.data.rebounds.read_rebounds("bounces.csv"), fitting.Setting(radius=0.02, kappa=2 / 3))
ranking.verdict, ranking.best.estimates["friction"]
"""

import lazy_loader as _lazy

__getattr__, __dir__, __all__ = _lazy.attach_stub(__name__, __file__)
