"""Figures with Matplotlib (extra `plot`), and HTML animations without it.

Each function returns a Matplotlib Figure without a window; a notebook displays it, :func:`save` writes it.
"""

from carom.public.guard import attach_public as _attach_public

__getattr__, __dir__, __all__ = _attach_public(__name__, __file__)
