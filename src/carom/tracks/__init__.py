"""Tracks of filmed balls: read them, find the contacts in them, and measure the rebound at each contact."""

import lazy_loader as _lazy

__getattr__, __dir__, __all__ = _lazy.attach_stub(__name__, __file__)
