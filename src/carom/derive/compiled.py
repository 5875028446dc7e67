"""A symbolic jump as a compiled function of numbers, for one state or for many."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, Any

import sympy as sp

from carom.derive.linear import Expr, atoms_of
from carom.errors import CaromError

if TYPE_CHECKING:
    from carom.derive.jump import Jump
    from carom.derive.setup import Speeds

__all__ = ["compile_jump"]


def compile_jump(jump: Jump, speeds: Speeds, arguments: Sequence[Expr] | None = None) -> Callable[..., Any]:
    """Compile a jump with Numba.

    Args:
        jump: what `ImpulsiveMotion.solve` gave.
        speeds: the speeds of that motion.
        arguments: the symbols the function takes, in order; left out: the speeds just before, then every other symbol
            in the order of their names.

    Returns:
        ``f(*arguments) -> (after, impulses, energy_change)``: arrays whose last axis runs over the speeds, and over
        ``jump.impulses``; arguments are numbers or arrays that broadcast. ``f.arguments`` lists them, ``f.kernel`` is
        the compiled scalar function. Impulses that rigid bodies leave open (``jump.free_impulses``) are taken as zero.

    Raises:
        CaromError: where ``arguments`` lacks a symbol the jump needs.
    """
    import numba
    import numpy as np

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
        raise CaromError(f"lambdify: the jump also needs {', '.join(missing)}; expected it among the arguments")
    many, count = len(arguments), len(outputs)
    kernel = numba.njit(sp.lambdify(list(arguments), tuple(sp.sympify(x) for x in outputs), modules="math", cse=True))
    # one call a row, its arguments spelled out: Numba unpacks no arrays into a call
    call = ", ".join(f"rows[i, {k}]" for k in range(many))
    put = "; ".join(f"out[i, {k}] = r[{k}]" for k in range(count))
    source = f"def rows_of(rows, out):\n    for i in range(rows.shape[0]):\n        r = kernel({call})\n        {put}\n"
    space: dict[str, Any] = {"kernel": kernel}
    exec(source, space)
    rows_of = numba.njit(space["rows_of"])
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
        rows_of(rows, out)
        out = out.reshape((*shape, count))
        return out[..., :split], out[..., split:-1], out[..., -1]

    run.arguments = tuple(arguments)  # type: ignore[attr-defined]
    run.kernel = kernel  # type: ignore[attr-defined]
    return run
