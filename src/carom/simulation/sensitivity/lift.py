"""Derived kernels: the very functions that the engine runs, with ``math`` replaced by its extension to dual numbers.

A kernel is a function of numbers that names what it calls by the globals of its module. The derived one has the same code and other
globals, in which ``math`` is :data:`carom.simulation.sensitivity.dual.DUAL_MATH` and every function is a derived one too. So each
law, phase and shape has its exact derivative, without a line written by hand for it. What a kernel finds by trial and error
says so (:func:`carom.core.jit.kernel.root_of`), and has the derivative of the implicit function theorem.
"""

from __future__ import annotations

import math
import sys
from collections.abc import Callable
from types import FunctionType
from typing import Any

import numpy as np

from carom.core.jit.dual.numbers import LANES, seeded
from carom.core.jit.kernel import DERIVED
from carom.laws.callbacks import call_user
from carom.simulation.sensitivity.dual import DUAL_MATH, Dual

__all__ = ["lifted"]

_spaces: dict[str, dict[str, Any]] = {}
# math's functions that were imported by name
_BY_FUNCTION = {getattr(math, name): function for name, function in vars(DUAL_MATH).items() if callable(function)}


def _float(number: Any) -> Any:
    """In the place of Python's float: a number with a derivative stays one."""
    return number if isinstance(number, Dual) else float(number)


def _call_law(law: Any, *numbers: Any) -> Any:
    """In the place of carom.laws.callbacks.call_user, which goes through an address."""
    return lifted(law)(*numbers)


def _seeded(value: float, k: int, slope: float) -> Dual:
    """In the place of carom.core.jit.dual.numbers.seeded."""
    slopes = np.zeros(LANES)
    slopes[k] = slope
    return Dual(value, slopes)


_INSTEAD: dict[Any, Any] = {call_user: _call_law, seeded: _seeded}


def _space(names: dict[str, Any], module: str, spaces: dict[Any, dict[str, Any]], key: Any) -> dict[str, Any]:
    """Return the globals of a module with derived functions in the place of its own and of imported functions."""
    if key in spaces:
        return spaces[key]
    space = spaces[key] = dict(names)
    space["float"] = _float
    for name, one in names.items():
        if one is math:
            space[name] = DUAL_MATH
        elif isinstance(one, FunctionType) and one in _INSTEAD:
            space[name] = _INSTEAD[one]
        elif isinstance(one, FunctionType) and _is_kernel(one, module):
            space[name] = lifted(one, None if spaces is _spaces else spaces)
        elif callable(one) and not isinstance(one, type) and _BY_FUNCTION.get(one) is not None:
            space[name] = _BY_FUNCTION[one]
    return space


def _is_kernel(one: FunctionType, module: str) -> bool:
    return one.__module__ == module or one.__module__.startswith("carom.")


def lifted(function: Callable[..., Any], own: dict[Any, dict[str, Any]] | None = None) -> Callable[..., Any]:
    """Return a kernel that takes and returns dual numbers where the given one takes and returns floats.

    Those of carom's modules are kept. A user's are made anew with every law (``own``: the globals made for this one): a notebook's
    cell may be run again, and two modules may have one name.
    """
    if not isinstance(function, FunctionType) or hasattr(function, "__wrapped__"):
        return function
    function = DERIVED.get(function, function)
    module, names = function.__module__, function.__globals__
    if module.startswith("carom."):
        space = _space(vars(sys.modules[module]) if module in sys.modules else names, module, _spaces, module)
    else:
        space = _space(names, module, {} if own is None else own, id(names))
    return FunctionType(function.__code__, space, function.__name__, function.__defaults__, function.__closure__)
