"""Impulsive motion derived from a Lagrangian and its constraints, symbolically; the paper, equation by equation (needs SymPy).

Of the other packages only `carom.errors`, `carom.bodies`, `carom.files` and the compiler of `carom.core` are imported, so that
the numeric laws can be tested against what is derived here. :mod:`carom.derive.euler` needs no SymPy.
"""

from typing import Any

from carom.files import require_library as _require_library
from carom.public.guard import attach_public as _attach_public

_attached, __dir__, __all__ = _attach_public(__name__, __file__)


def __getattr__(name: str) -> Any:
    if name in __all__:
        _require_library("sympy", "carom.derive")
    return _attached(name)
