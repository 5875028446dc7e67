"""Sweeps: maps over parameters of scenes, impacts, orbits and gases, as labelled arrays; resumable, on cores or a cluster."""

from carom.public.guard import attach_public as _attach_public

__getattr__, __dir__, __all__ = _attach_public(__name__, __file__)
