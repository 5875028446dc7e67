"""Figures with Matplotlib (extra `plot`), and HTML animations without it.

Each function returns a Matplotlib Figure without a window; a notebook displays it, :func:`save` writes it.
"""

import lazy_loader as _lazy

__getattr__, __dir__, __all__ = _lazy.attach_stub(__name__, __file__)
