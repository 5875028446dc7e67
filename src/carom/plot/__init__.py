"""Figures with Matplotlib (extra `plot`), and animations that need no Matplotlib.

Each function returns a Matplotlib Figure that belongs to no window; a notebook shows it, :func:`save` writes it.
"""

import lazy_loader as _lazy

__getattr__, __dir__, __all__ = _lazy.attach_stub(__name__, __file__)
