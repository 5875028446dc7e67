"""Results of SymPy as equations: ``%load_ext typeset_results`` sets dicts, lists and tuples of expressions as lines of formulas."""

from __future__ import annotations

import re
from typing import Any

import sympy as sp
from sympy.physics.vector import vlatex

NAMED = re.compile(r"Lambda_\{([^}]*)\}")  # an impulse that is left open, named after its constraint


def equations(found: Any) -> str | None:
    """Return the lines as LaTeX; None where anything else than expressions stands among them."""
    items = list(found.items()) if isinstance(found, dict) else [(None, value) for value in found]
    if not items or not all(isinstance(value, sp.Basic) for _, value in items):
        return None
    return "\\begin{aligned}\n" + " \\\\\n".join(_line(*item) for item in items) + "\n\\end{aligned}"


def _line(name: Any, value: sp.Basic) -> str:
    """Return a line: an equation, an expression, or what a name stands for."""
    if isinstance(value, sp.Equality):
        return f"{_tex(value.lhs)} &= {_tex(value.rhs)}"
    if name is None:
        return f"& {_tex(value)}"
    left = _tex(name) if isinstance(name, sp.Basic) else rf"\text{{{name}}}"
    return (
        rf"{left}:\quad & {_tex(value)}"
        if isinstance(value, sp.core.relational.Relational)
        else f"{left} &= {_tex(value)}"
    )


def _tex(value: sp.Basic) -> str:
    tex: str = vlatex(value)
    return NAMED.sub(r"\\Lambda_{\\text{\1}}", tex)


def _latex(found: Any) -> str | None:
    lines = equations(found)
    return None if lines is None else f"$\\displaystyle {lines}$"


def load_ipython_extension(shell: Any) -> None:
    """``%load_ext typeset_results``."""
    formatter = shell.display_formatter.formatters["text/latex"]
    for kind in (dict, list, tuple):
        formatter.for_type(kind, _latex)
