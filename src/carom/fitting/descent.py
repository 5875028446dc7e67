"""The way down: Levenberg and Marquardt's, within bounds, many fits of the same rows at once.

lmfit's way down takes some 5 ms a fit to set out, and a bootstrap is a thousand fits; and the deviance of a row whose spin
nobody measured is no sum of squares. So this one is carom's own; tests hold it against lmfit's.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from carom.fitting.looks import Look, Rows, look

__all__ = ["descend"]

Array = NDArray[np.float64]
ENOUGH = 1e-7  # of the deviance: a step that promises less is none
ENOUGH_AVERAGED = 1e-4  # the same where a spin is averaged over, as exactly as that is done
MOST_FAILS = 12  # steps in a row that lead up


def descend(
    rows: Rows, p: Array, most: int, weights: Array | None = None, middles: Array | None = None
) -> tuple[Array, Array, Array, Array]:
    """Down from each of p (B, K), with weights (B or 1, N) of the rows: places, deviances (B,), scores (B, k) and information
    (B, k, k) there. ``most`` looks; 1: only what it is where it stands.

    A shared error is normal, with width 1, about 0 or ``middles`` (B, S).
    """
    free = rows.free
    low, high = rows.low[free], rows.high[free]
    enough = ENOUGH if rows.spins is None else ENOUGH_AVERAGED
    p = np.array(p, dtype=float)
    count, k, own = len(p), len(free), rows.moves.shape[1]
    middles = np.zeros((count, len(rows.moves))) if middles is None else middles
    prior = np.diag((free >= own).astype(float))
    tried, alive = p.copy(), np.arange(count)
    now, gained = np.full(count, np.inf), np.full(count, np.inf)
    damp, fails = np.full(count, 1e-3), np.zeros(count, int)
    u, h = np.zeros((count, k)), np.zeros((count, k, k))
    bare = replace(rows, free=free[:0])

    def seen(rows: Rows, which: NDArray[np.int64]) -> tuple[Array, Look]:
        """Deviances of some, with those of shared errors; and all that there is to see."""
        some = weights if weights is None or len(weights) == 1 else weights[which]
        at = look(rows, tried[which], some)
        deviance = at.deviance if some is None else at.deviance * some
        return deviance.sum(axis=1) + np.square(tried[which, own:] - middles[which]).sum(axis=1), at

    for _ in range(most):
        # where a step led up the next one may as well, and slopes take longer than the deviance: they wait until it leads down
        wary = alive[fails[alive] > 0]
        worth = alive[fails[alive] == 0]
        if len(wary):
            worth = np.sort(np.append(worth, wary[seen(bare, wary)[0] < now[wary]]))
        then, found = seen(rows, worth)
        better = then < now[worth]
        down = worth[better]
        up = np.setdiff1d(alive, down)
        pull = np.zeros((len(worth), k))
        pull[:, free >= own] = (tried[worth, own:] - middles[worth])[:, free[free >= own] - own]
        gained[down], now[down], fails[down] = now[down] - then[better], then[better], 0
        p[down], u[down], h[down] = tried[down], (found.scores - pull)[better], found.information[better] + prior
        damp[down] = np.maximum(damp[down] / 10, 1e-9)
        fails[up] += 1
        damp[up] = np.maximum(damp[up] * 8, 1e-4)
        alive = alive[(gained[alive] >= enough) & (fails[alive] <= MOST_FAILS) & np.isfinite(now[alive])]
        if not len(alive) or k == 0:
            break
        here = p[np.ix_(alive, free)]
        stuck = ((here <= low) & (u[alive] < 0)) | ((here >= high) & (u[alive] > 0))
        step, damp[alive] = _step(h[alive], u[alive], ~stuck, damp[alive])
        there = np.clip(here + step, low, high)
        tried[np.ix_(alive, free)] = there
        promise = ((there - here) * u[alive]).sum(axis=1)
        alive = alive[promise > enough]
        if not len(alive):
            break
    return p, now, u, h


def _step(h: Array, u: Array, active: NDArray[np.bool_], damp: Array) -> tuple[Array, Array]:
    """(h + damp diag h)^-1 u over the active ones, with as much damping as makes that positive."""
    k = u.shape[1]
    plain = np.where(active[:, :, None] & active[:, None, :], h, 0.0)
    diagonal = np.abs(np.einsum("bjj->bj", plain))
    damp = damp.copy()
    for _ in range(40):
        extra = np.where(active, damp[:, None] * diagonal + 1e-9, 1.0)
        strength, direction = np.linalg.eigh(plain + extra[:, :, None] * np.eye(k))
        bad = ~(strength.min(axis=1) > 0)
        if not bad.any():
            break
        damp[bad] = np.maximum(10 * damp[bad], 1e-3)
    along = np.einsum("bjm,bj->bm", direction, np.where(active, u, 0.0)) / np.where(strength > 0, strength, np.inf)
    return np.einsum("bjm,bm->bj", direction, along), damp
