"""Compile a symbolic jump to a function of numbers, for one state or for arrays of them."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

import numpy as np
import sympy as sp

from carom.core.jit.compile import njit
from carom.core.jit.slices import row_slices
from carom.derive.jump import Jump
from carom.derive.linear import Expr, atoms_of
from carom.derive.system import Speeds
from carom.errors import CaromError

__all__ = ["compile_jump"]

# A generated function has no file to be cached beside; a division by zero raises, as in Python.
OPTIONS: dict[str, Any] = {"cache": False, "error_model": "python"}


def compile_jump(jump: Jump, speeds: Speeds, arguments: Sequence[Expr] | None = None) -> Callable[..., Any]:
    """Compile a jump with Numba.

    Parameters
    ----------
    jump : Jump
        Result of :meth:`ImpulsiveMotion.solve`.
    speeds : Speeds
        The speeds of that motion.
    arguments : sequence of Expr, optional
        The symbols that the function takes, in order. Default: the speeds just before, then every other symbol by name.

    Returns
    -------
    callable
        ``f(*arguments) -> (after, impulses, energy_change)``: arrays whose last axis runs over the speeds, and over
        ``jump.impulses``; the arguments are numbers or arrays that broadcast. ``f.arguments`` lists them, ``f.kernel`` is the
        compiled scalar function. Impulses that rigid bodies leave undetermined (``jump.free_impulses``) are set to zero.

    Raises
    ------
    CaromError
        Where ``arguments`` lacks a symbol that the jump contains.
    """
    open_split = dict.fromkeys(jump.free_impulses, sp.S.Zero)
    outputs = [jump.after[u] for u in speeds.names]
    outputs += [sp.sympify(x).xreplace(open_split) for x in jump.impulses.values()]
    outputs.append(jump.energy_change)
    needed = {a for x in outputs for a in atoms_of(sp.sympify(x))}
    if arguments is None:
        own = [u for u in speeds.before if u in needed]
        arguments = own + sorted(needed - set(own), key=str)
    missing = sorted(str(a) for a in needed - set(arguments))
    if missing:
        raise CaromError(f"lambdify: arguments: expected every symbol of the jump; it also needs {', '.join(missing)}")
    many, count = len(arguments), len(outputs)
    formulas = sp.lambdify(list(arguments), tuple(sp.sympify(x) for x in outputs), modules="math", cse=True)
    kernel = njit(formulas, **OPTIONS)
    # one call per row, its arguments written out: Numba does not unpack arrays in calls
    call = ", ".join(f"rows[i, {k}]" for k in range(many))
    put = "; ".join(f"out[i, {k}] = r[{k}]" for k in range(count))
    source = f"def rows_of(rows, out):\n    for i in range(rows.shape[0]):\n        r = kernel({call})\n        {put}\n"
    space: dict[str, Any] = {"kernel": kernel}
    exec(source, space)
    rows_of = njit(space["rows_of"], **OPTIONS)
    split = speeds.count

    def run(*values: Any) -> tuple[Any, Any, Any]:
        if len(values) != many:
            raise CaromError(
                f"lambdify: expected {many} arguments ({', '.join(map(str, arguments))}), got {len(values)}"
            )
        arrays = np.broadcast_arrays(*[np.asarray(v, dtype=np.float64) for v in values]) if values else [np.zeros(())]
        shape = arrays[0].shape
        rows = np.stack([a.reshape(-1) for a in arrays], axis=-1)
        out = np.empty((rows.shape[0], count))
        for part in row_slices(len(rows)):
            rows_of(rows[part], out[part])
        out = out.reshape((*shape, count))
        return out[..., :split], out[..., split:-1], out[..., -1]

    run.arguments = tuple(arguments)  # type: ignore[attr-defined]
    run.kernel = kernel  # type: ignore[attr-defined]
    return run
