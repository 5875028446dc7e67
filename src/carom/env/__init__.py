"""Environments for learning: billiards, air hockey and table tennis, as Gymnasium and PettingZoo have them (extra ``env``).

Importing it registers ``carom/ThreeCushion-v0`` and the others, so that ``gymnasium.make("carom.env:carom/ThreeCushion-v0")``
works, and after ``import carom.env`` the name alone.
"""

from carom.env.registration import register as _register
from carom.public.guard import attach_public as _attach_public

__getattr__, __dir__, __all__ = _attach_public(__name__, __file__)
_register()
