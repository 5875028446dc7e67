"""Loops over rows: every kernel for many balls, compiled for many and plain Python for few.

Rows: velocities and spins (N, 3), normals (N or 1, 3), parameters (N or 1, K); a single row serves all. Each loop writes
into arrays that exist. The loops are plain functions too: Python runs them for a few rows, with the same bits.
"""

from __future__ import annotations

import functools
from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import NDArray

from carom.kernel import Vec, kernel
from carom.kernel import kernel as mark
from carom.laws.contact import wall_contact
from carom.laws.pair import pair_contact
from carom.laws.two_step import first_impact, second_impact, two_step_plain
from carom.lockstep import ROOM, pressed_block

__all__ = [
    "FEW",
    "contact_final",
    "contact_full",
    "first_rows",
    "law_rows",
    "loop_for",
    "pair_rows",
    "second_rows",
    "two_step_final_rows",
]

Array = NDArray[np.float64]
# Below this many rows compiling, or loading what was compiled, costs more than it saves.
FEW = 400

prange: Any = range  # Numba's prange once something is compiled; Python's range means the same


def contact_full(
    v: Array, w: Array, n: Array, p: Array, v1: Array, w1: Array, j: Array, required: Array, regime: Any
) -> None:
    """One contact with all its results; parameters a, kappa, e, mu, beta; the impulse is per mass."""
    sn, sp = min(n.shape[0] - 1, 1), min(p.shape[0] - 1, 1)
    for i in prange(v.shape[0]):
        k, q = i * sn, i * sp
        x, y, z, required[i], regime[i] = wall_contact(
            (v[i, 0], v[i, 1], v[i, 2]),
            (w[i, 0], w[i, 1], w[i, 2]),
            (n[k, 0], n[k, 1], n[k, 2]),
            p[q, 0], p[q, 1], p[q, 2], p[q, 3], p[q, 4],
        )  # fmt: skip
        v1[i, 0], v1[i, 1], v1[i, 2] = x
        w1[i, 0], w1[i, 1], w1[i, 2] = y
        j[i, 0], j[i, 1], j[i, 2] = z


# The two loops that run at the speed of memory: one wall, one ball, one floor for all, arrays flat, (3 N,), and in blocks.
# A block is a function of its own and knows its step when it is compiled, so that it answers four balls at once.
BLOCK = 1024


@kernel
def _contact_block(
    v: Array, w: Array, n: Vec, a: float, kappa: float, e: float, mu: float, beta: float, v1: Array, w1: Array
) -> None:
    for i in range(v.shape[0] // 3):
        k = 3 * i
        x, y, _j, _required, _regime = wall_contact(
            (v[k], v[k + 1], v[k + 2]), (w[k], w[k + 1], w[k + 2]), n, a, kappa, e, mu, beta
        )
        v1[k], v1[k + 1], v1[k + 2] = x[0], x[1], x[2]
        w1[k], w1[k + 1], w1[k + 2] = y[0], y[1], y[2]


def contact_final(v: Array, w: Array, n: Array, p: Array, v1: Array, w1: Array) -> None:
    """One contact, velocity and spin only: one normal (3,) and one row of parameters a, kappa, e, mu, beta for all."""
    normal, count = (n[0], n[1], n[2]), v.shape[0]
    a, kappa, e, mu, beta = p[0], p[1], p[2], p[3], p[4]
    for block in prange((count + 3 * BLOCK - 1) // (3 * BLOCK)):
        i = 3 * BLOCK * block
        k = min(i + 3 * BLOCK, count)
        _contact_block(v[i:k], w[i:k], normal, a, kappa, e, mu, beta, v1[i:k], w1[i:k])


@kernel
def _two_step_block(
    v: Array, w: Array, n: Vec, a: float, kappa: float,
    e: float, mu: float, beta: float, ef: float, muf: float, betaf: float, g: float, together: bool,
    v3: Array, w3: Array, why: Any,
) -> None:  # fmt: skip
    for i in range(v.shape[0] // 3):
        k = 3 * i
        x, y, plain = two_step_plain(
            (v[k], v[k + 1], v[k + 2]), (w[k], w[k + 1], w[k + 2]), n,
            a, kappa, e, mu, beta, ef, muf, betaf, g, together,
        )  # fmt: skip
        v3[k], v3[k + 1], v3[k + 2] = x[0], x[1], x[2]
        w3[k], w3[k + 1], w3[k + 2] = y[0], y[1], y[2]
        why[i] = 0 if plain else -1


def two_step_final_rows(v: Array, w: Array, n: Array, p: Array, together: bool, v3: Array, w3: Array, why: Any) -> None:
    """The two-step, rolling state only; the plain balls of a block first, then in full what that left open.

    Parameters a, kappa, e, mu, beta, the floor's e, mu, beta, gravity, height.
    """
    normal, count = (n[0], n[1], n[2]), v.shape[0]
    a, kappa, e, mu, beta = p[0], p[1], p[2], p[3], p[4]
    ef, muf, betaf, g, h = p[5], p[6], p[7], p[8], p[9]
    for block in prange((count + 3 * BLOCK - 1) // (3 * BLOCK)):
        i = 3 * BLOCK * block
        k = min(i + 3 * BLOCK, count)
        _two_step_block(
            v[i:k], w[i:k], normal, a, kappa, e, mu, beta, ef, muf, betaf, g, together,
            v3[i:k], w3[i:k], why[i // 3 : k // 3],
        )  # fmt: skip
        pressed_block(
            v[i:k], w[i:k], normal, a, kappa, e, mu, beta, ef, muf, betaf, g, h, together,
            v3[i:k], w3[i:k], why[i // 3 : k // 3], np.empty(ROOM),
        )  # fmt: skip


def first_rows(
    v: Array, w: Array, n: Array, p: Array, together: bool,
    v1: Array, w1: Array, j: Array, jf: Array, required: Array, regime: Any,
) -> None:  # fmt: skip
    """The two-step's first impact; parameters a, kappa, e, mu, beta, the floor's e, mu, beta, height."""
    sn, sp = min(n.shape[0] - 1, 1), min(p.shape[0] - 1, 1)
    for i in prange(v.shape[0]):
        k, q = i * sn, i * sp
        x, y, z, f, required[i], regime[i] = first_impact(
            (v[i, 0], v[i, 1], v[i, 2]),
            (w[i, 0], w[i, 1], w[i, 2]),
            (n[k, 0], n[k, 1], n[k, 2]),
            p[q, 0], p[q, 1], p[q, 2], p[q, 3], p[q, 4], p[q, 5], p[q, 6], p[q, 7], p[q, 8], together,
        )  # fmt: skip
        v1[i, 0], v1[i, 1], v1[i, 2] = x
        w1[i, 0], w1[i, 1], w1[i, 2] = y
        j[i, 0], j[i, 1], j[i, 2] = z
        jf[i, 0], jf[i, 1], jf[i, 2] = f


def second_rows(
    v: Array, w: Array, n: Array, p: Array,
    t: Array, rise: Array, far: Array, v2: Array, w2: Array, j: Array, required: Array, regime: Any,
    v3: Array, w3: Array, why: Any,
) -> None:  # fmt: skip
    """From the wall to rolling; parameters a, kappa, the floor's e, mu, beta, gravity, height."""
    sn, sp = min(n.shape[0] - 1, 1), min(p.shape[0] - 1, 1)
    for i in prange(v.shape[0]):
        k, q = i * sn, i * sp
        t[i], rise[i], far[i], x, y, z, required[i], regime[i], r, s, why[i] = second_impact(
            (v[i, 0], v[i, 1], v[i, 2]),
            (w[i, 0], w[i, 1], w[i, 2]),
            (n[k, 0], n[k, 1], n[k, 2]),
            p[q, 0], p[q, 1], p[q, 2], p[q, 3], p[q, 4], p[q, 5], p[q, 6],
        )  # fmt: skip
        v2[i, 0], v2[i, 1], v2[i, 2] = x
        w2[i, 0], w2[i, 1], w2[i, 2] = y
        j[i, 0], j[i, 1], j[i, 2] = z
        v3[i, 0], v3[i, 1], v3[i, 2] = r
        w3[i, 0], w3[i, 1], w3[i, 2] = s


def pair_rows(
    v1: Array, w1: Array, v2: Array, w2: Array, n: Array, p: Array, out: Array, required: Array, regime: Any
) -> None:
    """Ball against ball; parameters a, m, kappa of both, e, mu, beta; ``out`` (N, 15): both states, the impulse."""
    for i in prange(v1.shape[0]):
        a, b, c, d, j, required[i], regime[i] = pair_contact(
            (v1[i, 0], v1[i, 1], v1[i, 2]),
            (w1[i, 0], w1[i, 1], w1[i, 2]),
            (v2[i, 0], v2[i, 1], v2[i, 2]),
            (w2[i, 0], w2[i, 1], w2[i, 2]),
            (n[i, 0], n[i, 1], n[i, 2]),
            p[i, 0], p[i, 1], p[i, 2], p[i, 3], p[i, 4], p[i, 5], p[i, 6], p[i, 7], p[i, 8],
        )  # fmt: skip
        for k in range(3):
            out[i, k], out[i, 3 + k], out[i, 6 + k], out[i, 9 + k], out[i, 12 + k] = a[k], b[k], c[k], d[k], j[k]


@functools.cache
def law_rows(kernel: Callable[..., Any]) -> Callable[..., None]:
    """The loop over rows of any wall law with the signature (v, w, n, a, kappa, e, mu, beta) -> (v, w)."""
    mark(kernel)  # compiled loops call only what is marked, and a law of a user's own need not be

    def rows(v: Array, w: Array, n: Array, p: Array, v1: Array, w1: Array) -> None:
        sn, sp = min(n.shape[0] - 1, 1), min(p.shape[0] - 1, 1)
        for i in prange(v.shape[0]):
            k, q = i * sn, i * sp
            x, y = kernel(
                (v[i, 0], v[i, 1], v[i, 2]),
                (w[i, 0], w[i, 1], w[i, 2]),
                (n[k, 0], n[k, 1], n[k, 2]),
                p[q, 0], p[q, 1], p[q, 2], p[q, 3], p[q, 4],
            )  # fmt: skip
            v1[i, 0], v1[i, 1], v1[i, 2] = x
            w1[i, 0], w1[i, 1], w1[i, 2] = y

    if not kernel.__module__.startswith("carom."):
        _FRESH.add(rows)
    return rows


# Loops over kernels from outside carom: the cache's key is a hash of carom's own sources, so it would go on answering
# with a law that its owner has changed.
_FRESH: set[Callable[..., None]] = set()


@functools.cache
def _compiled(loop: Callable[..., None]) -> Callable[..., None]:
    global prange  # noqa: PLW0603
    import numba

    from carom.compiled import njit

    prange = numba.prange
    return njit(loop, parallel=True, cache=loop not in _FRESH)


def loop_for(loop: Callable[..., None], rows: int) -> Callable[..., None]:
    """The loop as Python for a few rows, compiled for many."""
    return _quiet(loop) if rows < FEW else _compiled(loop)


def _quiet(loop: Callable[..., None]) -> Callable[..., None]:
    """A loop run by Python meets NumPy's numbers, which warn of 0 * inf where compiled code does not."""

    def quiet(*args: Any) -> None:
        with np.errstate(all="ignore"):
            loop(*args)

    return quiet
