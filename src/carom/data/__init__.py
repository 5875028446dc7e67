"""Tables: predicted rebounds, measured rebounds, and the published data sets that come with carom."""

from carom.public.guard import attach_public as _attach_public

__getattr__, __dir__, __all__ = _attach_public(__name__, __file__)
