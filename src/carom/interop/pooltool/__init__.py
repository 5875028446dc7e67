"""pooltool 0.6: its shots with carom's laws, its files as carom's scenes. It is imported only where it is run."""

from carom.public.guard import attach_public as _attach_public

__getattr__, __dir__, __all__ = _attach_public(__name__, __file__)
