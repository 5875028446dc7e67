"""Prefetching from compiled code: it compiles for arrays of records, and changes nothing."""

import numpy as np

from carom.core.jit.calls import prefetch, register_prefetch
from carom.core.jit.compile import njit


def test_a_compiled_loop_may_prefetch_what_it_reads() -> None:
    register_prefetch()

    @njit
    def total(rows):
        s = 0.0
        for i in range(rows.shape[0]):
            prefetch(rows, i)
            s += rows[i].x
        return s

    rows = np.zeros(100, np.dtype([("x", "f8"), ("more", "f8", (7,))]))
    rows["x"] = np.arange(100)
    assert total(rows) == 4950
    assert (rows["x"] == np.arange(100)).all()
