"""Which walls a ball can touch while its centre is in a cell: in NumPy, once for each grid."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from carom.engine.swarm_arrays import INSIDE, OVAL, PLANE
from carom.engine.swarm_oval import inner_axes

__all__ = ["walls_of_cells"]

ROUNDING = 1e-9  # of a cell: so far beyond its faces a ball may be that is in it


def _spans(one: Any, axis: int) -> tuple[Any, Any]:
    """Where the cells along an axis begin and end."""
    n, size = int(one["cells"][axis]), float(one["size"][axis])
    places = np.arange(n)
    low, high = (places - ROUNDING) * size, (places + 1 + ROUNDING) * size
    return low, high


def _touched(one: Any, face: Any, keep: float) -> NDArray[np.bool_]:
    """The cells (z, y, x) that a wall with this least d (or, of an outside, largest) reaches into."""
    scale = _within(face, keep) if face["form"] == OVAL else None
    least: Any = 0.0
    most: Any = 0.0
    along_low: Any = 0.0
    along_high: Any = 0.0
    for axis, name in enumerate("xyz"):
        low, high = _spans(one, axis)
        n, m, a = float(face["n" + name]), float(face["m" + name]), float(face["a" + name])
        if scale is not None:
            n = scale[axis]
        near, far = n * (low - m), n * (high - m)
        if face["form"] == PLANE:
            part = np.minimum(near, far)
        elif face["form"] in {INSIDE, OVAL}:
            part = -np.maximum(near * near, far * far)
        else:
            part = np.where((near < 0) != (far < 0), 0.0, np.minimum(near * near, far * far))
        shape = [1, 1, 1]
        shape[2 - axis] = -1
        least = least + part.reshape(shape)
        most = most + np.maximum(near, far).reshape(shape)
        along_low = along_low + np.minimum(a * low, a * high).reshape(shape)
        along_high = along_high + np.maximum(a * low, a * high).reshape(shape)
    if face["form"] == PLANE:
        touched = least <= keep + face["swing"]
    elif face["form"] == INSIDE:
        touched = least + keep * keep <= 0
    elif face["form"] == OVAL:
        touched = least + 1 <= 0
    else:
        touched = least <= keep * keep
    if face["bounded"]:
        touched = touched & (along_low <= face["high"]) & (along_high >= face["low"])
        if face["form"] == PLANE:
            touched = touched & (most >= -face["deep"])
    return np.asarray(touched)


def _within(face: Any, keep: float) -> tuple[float, float, float]:
    """One over the half axes of the ellipse within the curve that centres at this distance from an OVAL keep to."""
    inner = inner_axes(float(face["nx"]), float(face["ny"]), keep)
    return 1 / inner[0], 1 / inner[1], 0.0


def _calm_block(walled: NDArray[np.bool_]) -> list[int]:
    """First and last places, along x, y and z, of a block of cells without walls: what is left when the worst layers go."""
    low, high = [0, 0, 0], list(walled.shape)
    while all(low[k] < high[k] for k in range(3)):
        block = walled[tuple(slice(low[k], high[k]) for k in range(3))]
        if not block.any():
            return [v for k in (2, 1, 0) for v in (low[k], high[k] - 1)]
        _, k, last = max((float(np.take(block, end, axis=k).mean()), k, end) for k in range(3) for end in (0, -1))
        low[k], high[k] = (low[k], high[k] - 1) if last else (low[k] + 1, high[k])
    return [1, 0] * 3


def walls_of_cells(swarm: Any, faces: Any, walls: Any) -> tuple[list[int], NDArray[np.int32], NDArray[np.int32]]:
    """The block of cells without walls; for each cell where in ``sets`` its walls stand; there, how many, and which."""
    one = swarm[0]
    shape = tuple(int(n) for n in one["cells"][::-1])
    if len(faces) == 0:
        return [v for n in shape[::-1] for v in (0, n - 1)], np.zeros(1, np.int32), np.zeros(1, np.int32)
    kinds = int(one["kinds"])
    # each cell's set by its number among the different ones so far
    number = np.zeros(shape, np.int64)
    members: list[tuple[int, ...]] = [()]
    for w, face in enumerate(faces):
        keeps = walls["keep"][w * kinds : (w + 1) * kinds]
        touched = _touched(one, face, float(keeps.min() if face["form"] == INSIDE else keeps.max()))
        known, number = np.unique(2 * number + touched, return_inverse=True)
        number = number.reshape(shape)
        members = [(*members[k // 2], w) if k % 2 else members[k // 2] for k in known.tolist()]
    sets: list[int] = []
    starts: list[int] = []
    for those in members:
        starts.append(len(sets))
        sets += [len(those), *those]
    walled = np.array([len(those) > 0 for those in members])[number]
    return _calm_block(walled), np.array(starts, np.int32)[number].ravel(), np.array(sets, np.int32)
