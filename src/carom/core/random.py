"""Counter-based random numbers: the n-th number of a key is computed from n alone, so that the state is two numbers, and a run
that is continued from it draws what it would have drawn.

Threefry-2x32 with 20 rounds (Salmon, Moraes, Dror & Shaw, *Parallel random numbers: as easy as 1, 2, 3*, SC11, 2011),
and a logarithm of its own, so that the same key gives the same bits on every machine.
"""

from __future__ import annotations

import math
from collections.abc import Iterable
from typing import Any

from carom.core.jit.kernel import kernel

ROTATIONS = (13, 15, 26, 6, 17, 29, 16, 24)
PARITY = 0x1BD11BDA
WORD = 0xFFFFFFFF
LOG2_HIGH = (
    6.93147180369123816490e-01  # the first 33 bits of ln 2, so that small multiples of it are exact, and the rest
)
LOG2_LOW = 1.90821492927058770002e-10
ROOT_HALF, LEAST_STEP = 0.7071067811865476, 1.0 / 65536.0


@kernel
def threefry(key0: int, key1: int, count0: int, count1: int) -> tuple[int, int]:
    """Two words of 32 bits for a key and a count of two such words each."""
    keys = (key0, key1, (PARITY ^ key0) ^ key1)
    x, y = (count0 + key0) & WORD, (count1 + key1) & WORD
    for r in range(20):
        turn = ROTATIONS[r % 8]
        x = (x + y) & WORD
        y = ((y << turn) | (y >> (32 - turn))) & WORD
        y = y ^ x
        if r % 4 == 3:
            k = r // 4 + 1
            x, y = (x + keys[k % 3]) & WORD, (y + keys[(k + 1) % 3] + k) & WORD
    return x, y


@kernel
def uniform(key0: int, key1: int, n: int) -> float:
    """The n-th number of a key, above 0 and below 1."""
    x, y = threefry(key0, key1, n & WORD, n >> 32)
    # 52 bits, and half of the last one: neither 0 nor 1
    return ((x >> 6) * 67108864.0 + (y >> 6) + 0.5) / 4503599627370496.0


@kernel
def logarithm(x: float) -> float:
    """Natural logarithm of a number > 0, to 1e-15, with + - * / alone."""
    m, n = x, 0  # x = m 2^n, 1/2 <= m < 1, without rounding; not by frexp, which the package's own loops cannot call
    while m < LEAST_STEP:
        m, n = m / LEAST_STEP, n - 16
    while m < 0.5:
        m, n = 2.0 * m, n - 1
    while m >= 1.0:
        m, n = 0.5 * m, n + 1
    if m < ROOT_HALF:
        m, n = 2.0 * m, n - 1
    # 2 artanh, by its series: |s| < 0.172
    s = (m - 1.0) / (m + 1.0)
    square = s * s
    total = 0.0
    for k in range(11):
        total = total * square + 1.0 / (23 - 2 * k)
    return n * LOG2_HIGH + (n * LOG2_LOW + 2.0 * s * (1.0 + square * total))


@kernel
def exponential(key0: int, key1: int, n: int) -> float:
    """An exponential number of mean 1, from the n-th uniform one."""
    return -logarithm(uniform(key0, key1, n))


@kernel
def normals(key0: int, key1: int, n: int) -> tuple[float, float, int]:
    """Two normal numbers of variance 1 (Marsaglia's polar method, from 32 bits each), and the count of the next number."""
    square = 2.0
    x = y = 0.0
    while square >= 1.0:
        p, q = threefry(key0, key1, n & WORD, n >> 32)
        n += 1
        # from -1 to 1, and never both 0
        x, y = (p + 0.5) / 2147483648.0 - 1.0, (q + 0.5) / 2147483648.0 - 1.0
        square = x * x + y * y
    c = math.sqrt(-2.0 * logarithm(square) / square)
    return c * x, c * y, n


# ----------------------------------------------------------------------------------------------------
# Sums from left to right, with the same bits in every Python: from 3.12 on the built-in sum corrects its rounding.


def added(numbers: Iterable[Any]) -> Any:
    """Return the sum of numbers, each added to those before it."""
    total: Any = 0
    for one in numbers:
        total += one
    return total
