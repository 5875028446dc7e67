"""Tracks of filmed balls: read them, find the contacts in them, and measure the rebound at each contact."""

from carom.public.guard import attach_public as _attach_public

__getattr__, __dir__, __all__ = _attach_public(__name__, __file__)
