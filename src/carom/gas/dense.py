"""Dense random starts: small balls put in at random, which then fly, meet and grow until they are as large as asked.

After Lubachevsky & Stillinger, J. Stat. Phys. 60, 561 (1990), doi:10.1007/BF01025983: radii grow linearly in time, and a contact
gives the balls at least the speed at which their surfaces grow. All radii have their final ratios throughout.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence

import numpy as np
from numpy.typing import ArrayLike, NDArray

from carom.ball import Ball
from carom.checks import Faults
from carom.engine.swarm_arrays import DONE
from carom.engine.swarm_run import advance, balls_at, make
from carom.errors import CaromError
from carom.gas.container import Container, room_of
from carom.gas.setup import Species, world_records
from carom.gas.start import scattered, thermal
from carom.surface import Surface

__all__ = ["dense"]

Array = NDArray[np.float64]
CLOSEST = {
    2: math.pi / math.sqrt(12),
    3: math.pi / math.sqrt(18),
}  # shares that equal discs, spheres can take (Thue, Hales)
FIRST = {2: 0.25, 3: 0.15}  # share of the balls when they are put in
GROWTH = 0.05  # of the widest diameter, against the mean speed along an axis; slower where the balls jam
SLOWEST = 1e-4
STAGE = 50  # collisions a ball, after which the speeds are set back to what they were
LEAST_STEP = 2e-3  # less than this share of what is missing, in a stage, is too slow
MOST_STAGES = 1500
MOST_SIZES = 500


def dense(
    radius: ArrayLike,
    side: Sequence[float] | Container,
    *,
    periodic: bool | Sequence[bool] = True,
    seed: int = 0,
    progress: Callable[[float], None] | None = None,
) -> Array:
    """Centres (N, 3) of balls of these radii (N,), at random and without overlap, up to dense packings.

    ``side`` and ``periodic`` are those of :class:`carom.gas.Gas`. Equal spheres come to about 0.64 of the volume before they jam,
    discs and mixtures to more; below that the densest take longest. ``progress`` is called with the share of the final radii.
    The same seed gives the same bits. CaromError where so much cannot fit, or did not.

    After Lubachevsky & Stillinger, J. Stat. Phys. 60, 561 (1990).
    """
    room, radii = room_of(side, periodic), np.atleast_1d(np.array(radius, dtype=float))
    axes = len(room.size)
    share = _share(room, radii)
    rng = np.random.default_rng(seed)
    scale = min(1.0, (FIRST[axes] / share) ** (1 / axes))
    x = scattered(radii * scale, room, rng=rng)
    if scale == 1.0:
        return x
    sizes, which = np.unique(radii, return_inverse=True)
    counts = np.bincount(which)
    species = [
        Species(Ball(float(a), 1.0, 0.4), int(n), str(k)) for k, (a, n) in enumerate(zip(sizes, counts, strict=True))
    ]
    rate = GROWTH / (2 * sizes[-1])
    v = thermal(np.ones(len(x)), tuple(range(axes)), 1.0, rng)
    for _ in range(MOST_STAGES):
        records = world_records(species, room, Surface(1.0, 0.0, -1.0), (0.0,) * axes, 0.0, {}, None, seed)
        one = records.world[0]
        one["scale"], one["growth"] = scale, rate
        arrays = make(*records, which, x, v, np.zeros_like(x))
        advance(arrays, (1 - scale) / rate, STAGE * len(x))
        one = arrays.swarm[0]
        done = one["status"] == DONE
        time = (1 - scale) / rate if done else float(one["base"] + (one["rest"] + one["now"]))
        motions, _bodies, _images = balls_at(arrays, time)
        x = np.stack([motions[name] for name in ("x", "y", "z")], axis=1)
        if done:
            return x
        v = np.stack([motions[name] for name in ("vx", "vy", "vz")], axis=1)
        v *= math.sqrt(len(x) * axes / (v * v).sum())
        before, scale = scale, min(scale + rate * time, 1.0)
        if progress is not None:
            progress(scale)
        if scale - before < LEAST_STEP * (1 - before):
            if rate * 2 * sizes[-1] < SLOWEST:
                break
            rate /= 2
    raise CaromError(
        f"dense: expected a density that can be reached, got balls that jam at {share * scale**axes:.4f} of the room,"
        f" asked for {share:.4f}; ask for less, or start from a lattice"
    )


def _share(room: Container, radii: Array) -> float:
    """The share of the room that the balls take; CaromError if they cannot."""
    faults, axes = Faults("dense"), len(room.size)
    if radii.ndim != 1 or len(radii) == 0 or not (np.isfinite(radii) & (radii > 0)).all():
        faults.add("radius", "a number > 0 for each ball", f"{radii!r:.60}")
    elif len(np.unique(radii)) > MOST_SIZES:
        faults.add("radius", f"at most {MOST_SIZES} different radii", f"{len(np.unique(radii))}")
    faults.done()
    share = float((radii**axes).sum()) * (math.pi if axes == 2 else 4 / 3 * math.pi) / room.volume
    # (walls that bound the centres leave the surfaces more room than the volume says)
    inside = all(wall.thick for wall in room.walls)
    most = CLOSEST[axes] if (radii == radii[0]).all() else 1.0
    if inside and share > most:
        shapes = "discs" if axes == 2 else "spheres"
        what = (
            f"equal {shapes} fill at most {most:.4f} of any room"
            if most < 1
            else "balls cannot fill more than the room"
        )
        faults.add("radius", f"a density that can exist: {what}", f"{share:.4f}")
    faults.done()
    return share
