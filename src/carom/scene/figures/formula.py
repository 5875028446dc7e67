"""Formulas in files: arithmetic of one variable with a fixed list of functions, read by Python's ``ast``; nothing is run."""

from __future__ import annotations

import ast
import math
import warnings
from collections.abc import Callable
from typing import Any

import numpy as np

from carom.core.jets import call
from carom.errors import CaromError, Fault, did_you_mean, shown

__all__ = ["NAMES", "formula"]

NAMES = {
    "sin": "sin", "cos": "cos", "tan": "tan", "sinh": "sinh", "cosh": "cosh", "tanh": "tanh", "exp": "exp", "log": "log",
    "sqrt": "sqrt", "atan": "arctan", "abs": "absolute",
}  # fmt: skip
"""Functions of a formula, by the names of NumPy's."""
CONSTANTS = {"pi": math.pi, "e": math.e}
LONGEST, DEEPEST = 2000, 60
OPERATORS: dict[type[ast.AST], Callable[..., Any]] = {
    ast.Add: lambda x, y: x + y, ast.Sub: lambda x, y: x - y, ast.Mult: lambda x, y: x * y, ast.Div: lambda x, y: x / y,
    ast.Pow: lambda x, y: x**y, ast.USub: lambda x: -x, ast.UAdd: lambda x: x,
}  # fmt: skip


def formula(text: str, name: str) -> Callable[[Any], Any]:
    """Return the function that a formula of one variable says, of a number or a jet (:mod:`carom.core.jets`).

    Numbers, ``name``, pi, e, + - * / ** and the functions of NAMES. Anything else raises CaromError, one line.

    Examples
    --------
    >>> from carom.core.jets import variable
    >>> from carom.scene.figures.formula import formula
    >>> import numpy as np
    >>> found = formula("1 + 0.3*cos(2*theta)", "theta")(variable(np.array([0.0])))
    >>> found.x, found.d, found.dd
    (array([1.3]), array([0.]), array([-1.2]))
    """
    if len(text) > LONGEST:
        raise _fault(f"a formula of at most {LONGEST:,} characters", f"{len(text):,}")
    try:
        with warnings.catch_warnings(action="ignore"):  # (Python's about a text that is refused anyway)
            tree = ast.parse(text.strip(), mode="eval").body
    except (SyntaxError, ValueError, RecursionError, MemoryError):
        raise _fault(f"a formula of {name}, such as 1 + 0.3*cos(2*{name})", shown(text)) from None
    return _read(tree, name, DEEPEST)


def _fault(expected: str, got: str, advice: str = "") -> CaromError:
    return CaromError(Fault("", "", expected, got, advice))


def _read(node: ast.AST, name: str, depth: int) -> Callable[[Any], Any]:
    """Return the function that a node says."""
    if depth == 0:
        raise _fault(f"a formula nested at most {DEEPEST} deep", "a deeper one")
    if isinstance(node, ast.Constant) and isinstance(node.value, int | float) and not isinstance(node.value, bool):
        try:
            value = float(node.value)
        except OverflowError:
            value = math.inf
        if not math.isfinite(value):
            raise _fault("numbers below 1e308", "a larger one")
        return lambda _x: np.float64(value)  # (which overflows to infinity, and has no complex powers)
    if isinstance(node, ast.Name):
        if node.id == name:
            return lambda x: x
        if node.id in CONSTANTS:
            constant = np.float64(CONSTANTS[node.id])
            return lambda _x: constant
        if node.id in NAMES:
            raise _fault(f"{node.id} of something, such as {node.id}({name})", f"{node.id} alone")
        known = [name, *CONSTANTS, *NAMES]
        raise _fault(f"{name}, {', '.join(CONSTANTS)} and functions", shown(node.id), did_you_mean(node.id, known))
    if isinstance(node, ast.BinOp | ast.UnaryOp) and type(node.op) in OPERATORS:
        work = OPERATORS[type(node.op)]
        parts = [node.left, node.right] if isinstance(node, ast.BinOp) else [node.operand]
        made = [_read(part, name, depth - 1) for part in parts]
        return lambda x: work(*(part(x) for part in made))
    if isinstance(node, ast.Call) and isinstance(node.func, ast.Name) and len(node.args) == 1 and not node.keywords:
        if node.func.id not in NAMES:
            raise _fault(f"one of {', '.join(NAMES)}", shown(node.func.id), did_you_mean(node.func.id, list(NAMES)))
        inner, function = _read(node.args[0], name, depth - 1), NAMES[node.func.id]
        return lambda x: call(function, inner(x))
    raise _fault("numbers, + - * / **, and functions of one argument", shown(ast.unparse(node)))
