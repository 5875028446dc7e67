"""Declarations of a user: balls, floor, walls and their shapes, how long to run; read from Python or TOML, and validated."""

from carom.public.guard import attach_public as _attach_public

__getattr__, __dir__, __all__ = _attach_public(__name__, __file__)
