"""Other programs: their files read, carom's laws in them, and carom's runs shown by them."""

from carom.public.guard import attach_public as _attach_public

__getattr__, __dir__, __all__ = _attach_public(__name__, __file__)
