"""Gases of many balls or discs: event-driven, rough or smooth, in periodic boxes, between walls, in round containers."""

from carom.public.guard import attach_public as _attach_public

__getattr__, __dir__, __all__ = _attach_public(__name__, __file__)
