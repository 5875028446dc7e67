"""Laws fitted to whole tracks: each ball is simulated from its own initial state, and compared with the frames.

ranking = fit_tracks(measured, Setting(radius=0.03075), ["two-step"])
"""

from carom.public.guard import attach_public as _attach_public

__getattr__, __dir__, __all__ = _attach_public(__name__, __file__)
