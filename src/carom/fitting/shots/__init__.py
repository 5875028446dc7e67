"""Whole shots, from the stroke to rest, fitted with all balls and contacts.

ranking = carom.fit_shots("shots.csv", radius=0.03075)
"""

from carom.public.guard import attach_public as _attach_public

__getattr__, __dir__, __all__ = _attach_public(__name__, __file__)
