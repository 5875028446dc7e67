"""Laws fitted to whole tracks: each ball is simulated from its own initial state, and compared with the frames.

ranking = fit_tracks(measured, TrackSetting(radius=0.03075), ["two-step"])
"""

import lazy_loader as _lazy

__getattr__, __dir__, __all__ = _lazy.attach_stub(__name__, __file__)
