"""Initial states of a gas: lattices, random and dense random positions, thermal velocities.

Dense random positions follow Lubachevsky & Stillinger, J. Stat. Phys. 60, 561 (1990), doi:10.1007/BF01025983: small balls are put
in at random, move, collide and grow until they are as large as asked. Radii grow linearly in time, with their final ratios, and a
contact separates balls at least as fast as their surfaces grow.
"""

from __future__ import annotations

import functools
import math
from collections.abc import Callable, Sequence
from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from carom.core.jit.kernel import kernel
from carom.core.jit.threads import block_slices, row_slices
from carom.errors import CaromError, FaultList, require_count
from carom.gas.containers import Container, as_container
from carom.gas.edmd.driver import advance, arrays_at_start, put_in_place, synchronized, time_of_last_event
from carom.gas.edmd.gas_records import DONE, PLANE
from carom.gas.species import ANY, GasContact, Kind, cells_at_most, lattice_steps, side_faults, system_records
from carom.public.progress import Progress, loop_callback

Array = NDArray[np.float64]
BLOCK = 1 << 16  # balls that are handled at once
MAX_LATTICES = 200  # tried, each a twentieth finer
MAX_PROPOSALS = 300  # per ball, after which a density counts as out of reach of random insertion
DENSEST = {
    2: math.pi / math.sqrt(12),
    3: math.pi / math.sqrt(18),
}  # packing fractions of equal discs, spheres (Thue, Hales)
FIRST_FRACTION = {2: 0.25, 3: 0.15}  # packing fraction at which the balls are put in
GROWTH = 0.05  # of the largest diameter, relative to the mean speed along an axis; slower where the balls jam
LEAST_GROWTH = 1e-4
STAGE = 50  # collisions per ball, after which the speeds are reset
LEAST_STEP = 2e-3  # of the growth that is missing: a stage with less is too slow
MAX_STAGES = 1500
MAX_RADII = 500


def lattice(count: int, side: Sequence[float] | Container, radius: float = 0.0) -> Array:
    """Return positions (count, 3) on a face-centred cubic lattice, or in two dimensions on a centred square one.

    Parameters
    ----------
    count : int
    side : two or three lengths, or a Container
        A box, which the lattice is stretched to fill; in a container it is as wide as leaves enough sites within the walls.
    radius : float
        Least distance from the sides of the box, or from the walls, m.

    Returns
    -------
    array (count, 3)
        m; of the sites, ``count`` are used, spread evenly.

    Raises
    ------
    CaromError
        If the container has too few sites.

    Examples
    --------
    >>> from carom.gas import lattice
    >>> lattice(4, (2.0, 2.0, 2.0)).tolist()
    [[0.5, 0.5, 0.5], [1.5, 1.5, 0.5], [1.5, 0.5, 1.5], [0.5, 1.5, 1.5]]
    """
    if not isinstance(side, Container):
        return _stretched(count, side, [radius] * len(side))
    if side.shape in {"periodic", "box"} and all(face.form == PLANE for face in side.faces):
        # (a wall that bounds the centres needs no margin)
        margin = radius if all(face.bounds_surfaces for face in side.faces) else 0.0
        return _stretched(count, side.size, [0.0 if closed else margin for closed in side.periodic])
    # a lattice of the whole box, fine enough to leave enough sites within the walls
    most = count
    for _ in range(MAX_LATTICES):
        x = _stretched(most, side.size, [0.0] * len(side.size))
        x = x[side.clearance(radius, x) >= 0]
        if len(x) >= count:
            return x[(np.arange(count) * len(x)) // count]
        most += max(most // 20, 1)
    raise CaromError(
        f"lattice: expected a container with enough sites for balls of radius {radius:g}, got one of size {side.size}"
    )


def _stretched(count: int, side: Sequence[float], margins: Sequence[float]) -> Array:
    """Return positions on a lattice stretched to fill a box, within a margin along each axis."""
    inner = np.array(side, dtype=float) - 2 * np.array(margins)
    faults = FaultList("lattice")
    faults.attempt(require_count, "lattice", "count", count)
    if not (np.isfinite(inner) & (inner > 0)).all():
        faults.add("radius", f"a margin within sides of {', '.join(f'{x:g}' for x in side)}", f"{max(margins):g}")
    faults.raise_if_any()
    basis = [(0, 0, 0), (1, 1, 0), (1, 0, 1), (0, 1, 1)] if len(inner) == 3 else [(0, 0), (1, 1)]
    # steps along each axis: the cells nearly cubic, and enough sites
    steps = np.maximum(np.round(lattice_steps(inner.tolist(), count, len(basis))), 1).astype(int)
    while steps.prod() * len(basis) < count:
        steps[np.argmax(inner / steps)] += 1
    shifts, sites = (np.array(basis) + 0.5) / 2, int(steps.prod()) * len(basis)
    centres = np.zeros((count, 3))
    for rows in block_slices(count, BLOCK):  # so that nothing but the result is as long as the gas
        taken = np.arange(rows.start, rows.stop) * sites // count
        corners = np.stack(np.unravel_index(taken // len(basis), steps), axis=-1)
        centres[rows, : len(inner)] = np.array(margins) + ((corners + shifts[taken % len(basis)]) / steps) * inner
    return centres


def thermal(mass: Array, axes: tuple[int, ...], temperature: float, rng: np.random.Generator) -> Array:
    """Draw thermal velocities (N, 3) for balls of masses (N,): normal components along ``axes``, no total momentum.

    They are scaled so that the mean of m v^2 along an axis is exactly ``temperature``. With moments of inertia in place of
    masses the results are spins.

    Parameters
    ----------
    mass : array (N,)
        kg.
    axes : tuple of int
        Axes along which velocities are drawn, 0 to 2.
    temperature : float
        k_B T, J.
    rng : numpy.random.Generator

    Returns
    -------
    array (N, 3)
        m/s.

    Examples
    --------
    >>> import numpy as np
    >>> from carom.gas import thermal
    >>> v = thermal(np.ones(100), (0, 1, 2), 2.0, np.random.default_rng(1))
    >>> v.shape, round(float((v**2).sum()) / 300, 12), bool(abs(v.sum(axis=0)).max() < 1e-12)
    ((100, 3), 2.0, True)
    """
    if temperature == 0 or len(mass) == 0:
        return np.zeros((len(mass), 3))
    # (in place: of many balls an array of vectors is large)
    v = rng.normal(size=(len(mass), len(axes)))
    v /= np.sqrt(mass)[:, None]
    product = mass[:, None] * v
    if len(mass) > 1:
        v -= product.sum(axis=0) / mass.sum()
        np.multiply(mass[:, None], v, out=product)
    product *= v
    v *= math.sqrt(temperature * len(mass) * len(axes) / product.sum())
    if axes == (0, 1, 2):
        return v
    found = np.zeros((len(mass), 3))
    found[:, axes] = v
    return found


def scattered(
    radius: ArrayLike, side: Sequence[float] | Container, periodic: Any = True, rng: np.random.Generator | None = None
) -> Array:
    """Draw random positions (N, 3) without overlap, by random sequential addition, the largest balls first.

    Parameters
    ----------
    radius : (N,) radii, m
    side, periodic : as for :class:`carom.gas.Gas`
    rng : numpy.random.Generator, optional

    Returns
    -------
    array (N, 3)
        m. Random sequential addition reaches a packing fraction of 0.38 (discs: 0.55), and is slow well below it;
        :func:`carom.gas.dense` reaches higher ones.

    Raises
    ------
    CaromError
        If the balls do not fit.

    Examples
    --------
    >>> import numpy as np
    >>> from carom.gas import scattered
    >>> x = scattered(np.full(50, 0.5), (6.0, 6.0, 6.0), rng=np.random.default_rng(1))
    >>> r = np.linalg.norm((x[:, None] - x + 3.0) % 6.0 - 3.0, axis=2)  # nearest images
    >>> x.shape, bool((r[r > 0] >= 1.0).all())
    ((50, 3), True)
    """
    container, rng = as_container(side, periodic), np.random.default_rng(0) if rng is None else rng
    axes = len(container.size)
    size = np.ones(3)
    size[:axes] = container.size
    around = np.ones(3, bool)
    around[:axes] = container.periodic
    thick = all(face.bounds_surfaces for face in container.faces)
    radii = np.array(radius, dtype=float)
    order = np.argsort(-radii, kind="stable")
    cells = np.array(cells_at_most((size / (2 * radii.max())).tolist(), len(radii)), np.int64)
    cells[axes:] = 1
    first, after = np.full(cells.prod(), -1, np.int64), np.full(len(radii), -1, np.int64)
    x, placed, tried = np.zeros((len(radii), 3)), 0, 0
    while placed < len(radii):
        if tried > MAX_PROPOSALS * len(radii):
            raise CaromError(
                f"scattered: expected a density within reach of random insertion, got {placed} of {len(radii)} balls placed;"
                " start from a lattice, or with carom.gas.dense"
            )
        batch = rng.random((2 * (len(radii) - placed) + 100, 3)) * size
        tried += len(batch)
        batch[:, axes:] = 0
        free = container.clearance(0.0, batch)
        gap = free if thick else np.where(free >= 0, math.inf, -1.0)
        for some in row_slices(len(batch)):
            placed = compiled_loops()(
                x,
                radii[order],
                placed,
                batch[some],
                gap[some],
                size,
                around,
                cells,
                first,
                after,
                axes,
                np.zeros(3, np.int64),
            )
    found = np.zeros_like(x)
    found[order] = x
    return found


@functools.cache
def compiled_loops() -> Callable[..., int]:
    """Return the compiled random insertion."""
    from carom.core.jit.compile import njit

    return njit(_scatter, nogil=True)


def _scatter(
    x: Any, radii: Any, placed: int, batch: Any, gap: Any, size: Any, around: Any, cells: Any, first: Any, after: Any,
    axes: int, place: Any,
) -> int:  # fmt: skip
    """Place as many balls as possible at a batch of positions with these distances from the walls; return how many are placed.

    ``place`` (3,) is room for a cell's numbers.
    """
    for k in range(batch.shape[0]):
        if placed == x.shape[0]:
            break
        a = radii[placed]
        if gap[k] < a:
            continue
        for axis in range(3):
            x[placed, axis] = batch[k, axis]
            place[axis] = min(int(x[placed, axis] / size[axis] * cells[axis]), cells[axis] - 1)
        free = True
        for step in range(27 if axes == 3 else 9):
            neighbour = neighbour_cell(place, step, cells, around, axes)
            other = first[neighbour] if neighbour >= 0 else -1
            while other >= 0:
                square = 0.0
                for axis in range(axes):
                    r = abs(x[placed, axis] - x[other, axis])
                    r = min(r, size[axis] - r) if around[axis] else r
                    square += r * r
                if square < (a + radii[other]) * (a + radii[other]):
                    free = False
                other = after[other]
        if free:
            cell = (place[2] * cells[1] + place[1]) * cells[0] + place[0]
            after[placed] = first[cell]
            first[cell] = placed
            placed += 1
    return placed


def dense(
    radius: ArrayLike,
    side: Sequence[float] | Container,
    *,
    periodic: bool | Sequence[bool] = True,
    seed: int = 0,
    progress: Progress | None = None,
) -> Array:
    """Draw random positions (N, 3) without overlap, up to dense packings.

    Parameters
    ----------
    radius : (N,) radii, m
    side, periodic : as for :class:`carom.gas.Gas`
    seed : int
        The same seed gives bitwise identical positions.
    progress : callable(done, total, text), optional
        Called with the current fraction of the final radii, and 1.

    Returns
    -------
    array (N, 3)
        m. Equal spheres reach a packing fraction of about 0.64 before they jam, discs and mixtures more; the densest take
        longest.

    Raises
    ------
    CaromError
        If the balls cannot fit, or no packing was found.

    After Lubachevsky & Stillinger, J. Stat. Phys. 60, 561 (1990), doi:10.1007/BF01025983.

    Examples
    --------
    >>> import numpy as np
    >>> from carom.gas import dense
    >>> x = dense(np.full(60, 0.5), (4.2, 4.2, 4.2), seed=1)  # packing fraction 0.42
    >>> r = np.linalg.norm((x[:, None] - x + 2.1) % 4.2 - 2.1, axis=2)  # nearest images
    >>> x.shape, bool((r[r > 0] > 1 - 1e-12).all())
    ((60, 3), True)
    """
    tell = loop_callback(progress, lambda now: lambda scale: now(scale, 1.0, "growing"))
    container, radii = as_container(side, periodic), np.atleast_1d(np.array(radius, dtype=float))
    axes = len(container.size)
    fraction = _packing_fraction(container, radii)
    rng = np.random.default_rng(seed)
    scale = min(1.0, (FIRST_FRACTION[axes] / fraction) ** (1 / axes))
    x = scattered(radii * scale, container, rng=rng)
    if scale == 1.0:
        return x
    sizes, which = np.unique(radii, return_inverse=True)
    counts = np.bincount(which)
    pairs = enumerate(zip(sizes.tolist(), counts.tolist(), strict=True))
    kinds = [Kind(str(k), n, a, 1.0, 0.4) for k, (a, n) in pairs]
    smooth = [GasContact(between=(ANY, ANY), restitution=1.0, friction=0.0, tangential_restitution=-1.0)]
    rate = GROWTH / (2 * sizes[-1])
    v = thermal(np.ones(len(x)), tuple(range(axes)), 1.0, rng)
    for _ in range(MAX_STAGES):
        records = system_records(kinds, container, smooth, (0.0,) * axes, seed=seed)
        one = records.system[0]
        one["scale"], one["growth"] = scale, rate
        arrays = arrays_at_start(records, put_in_place(records, which, x), v, np.zeros_like(x))
        advance(arrays, (1 - scale) / rate, STAGE * len(x))
        one = arrays.system[0]
        done = one["status"] == DONE
        time = (1 - scale) / rate if done else time_of_last_event(arrays)
        motions, _bodies, _images = synchronized(arrays, time)
        x = np.stack([motions[name] for name in ("x", "y", "z")], axis=1)
        if done:
            return x
        v = np.stack([motions[name] for name in ("vx", "vy", "vz")], axis=1)
        v *= math.sqrt(len(x) * axes / (v * v).sum())
        before, scale = scale, min(scale + rate * time, 1.0)
        if tell is not None:
            tell(scale)
        if scale - before < LEAST_STEP * (1 - before):
            if rate * 2 * sizes[-1] < LEAST_GROWTH:
                break
            rate /= 2
    raise CaromError(
        f"dense: expected a packing fraction that can be reached, got {fraction:.4f}: the balls jam at"
        f" {fraction * scale**axes:.4f}; ask for less, or start from a lattice"
    )


def _packing_fraction(container: Container, radii: Array) -> float:
    """Return the packing fraction of balls in a container; CaromError where they cannot fit."""
    faults, axes = FaultList("dense"), len(container.size)
    if radii.ndim != 1 or len(radii) == 0 or not (np.isfinite(radii) & (radii > 0)).all():
        faults.add("radius", "a number > 0 for each ball", f"{radii!r:.60}")
    elif len(np.unique(radii)) > MAX_RADII:
        faults.add("radius", f"at most {MAX_RADII} different radii", f"{len(np.unique(radii))}")
    faults.raise_if_any()
    faults += [replace(one, where="dense") for one in side_faults(container, float(radii.max()), float(radii.min()))]
    faults.raise_if_any()
    fraction = float((radii**axes).sum()) * (math.pi if axes == 2 else 4 / 3 * math.pi) / container.volume
    # (walls that bound the centres leave the balls more space than the volume says)
    inside = all(face.bounds_surfaces for face in container.faces)
    most = DENSEST[axes] if (radii == radii[0]).all() else 1.0
    if inside and fraction > most:
        shapes = "discs" if axes == 2 else "spheres"
        bound = f"at most {most:.4f}, the densest packing of equal {shapes}" if most < 1 else "at most 1"
        faults.add("radius", f"a packing fraction of {bound}", f"{fraction:.4f}")
    faults.raise_if_any()
    return fraction


# ----------------------------------------------------------------------------------------------------
# Which balls of a start overlap: a list of the balls in each cell, and a compiled loop over pairs in neighbouring cells.


NONE = 0xFFFFFFFF  # end of a chain


def first_overlap(one: Any, radius: Array, x: Array, touch: float) -> tuple[int, int] | None:
    """Return the first pair (i < j) of balls that overlap by more than ``touch`` of the smaller radius, or None.

    ``one`` is the record of the system; its cells are at least as wide as the largest diameter.
    """
    n, side, periodic = one["cells"], one["side"], one["periodic"] == 1
    first, after = np.full(int(n.prod()), NONE, np.uint32), np.empty(len(x), np.uint32)
    place = np.zeros(3, np.int64)
    for rows in row_slices(len(x)):
        _, enter = compiled_search()
        enter(x, rows.start, rows.stop, n, side, periodic, first, after, place)
    touch = float(touch)  # (an int, or an array of no axes, would have the search compiled again)
    for rows in row_slices(len(x)):
        search, _ = compiled_search()
        # (the first ball has the pair that is asked for: its partner is the least)
        i, j = search(x, radius, rows.start, rows.stop, n, side, periodic, first, after, touch, place)
        if i >= 0:
            return int(i), int(j)
    return None


@functools.cache
def compiled_search() -> tuple[Callable[..., Any], Callable[..., Any]]:
    """Return the compiled search, and what fills its cells."""
    from carom.core.jit.compile import njit

    return njit(_search, nogil=True), njit(_enter, nogil=True)


@kernel
def neighbour_cell(place: Any, step: int, n: Any, periodic: Any, axes: int) -> int:
    """Return the number of a cell's neighbour ``step`` (0 to 3^axes - 1, itself among them), or -1 beyond a side of the box."""
    cell, stride = 0, 1
    for axis in range(3):
        there = place[axis] + (step % 3 - 1 if axis < axes else 0)
        step //= 3
        if periodic[axis]:
            there %= n[axis]
        elif there < 0 or there >= n[axis]:
            return -1
        cell += stride * there
        stride *= n[axis]
    return cell


def _enter(x: Any, start: int, stop: int, n: Any, side: Any, periodic: Any, first: Any, after: Any, place: Any) -> None:
    """Put balls ``start`` to ``stop`` at the heads of their cells' chains; ``place`` (3,) is room for a cell's numbers."""
    for i in range(start, stop):
        for axis in range(3):
            r = x[i, axis] % side[axis] if periodic[axis] else x[i, axis]
            place[axis] = min(max(int(r / side[axis] * n[axis]), 0), n[axis] - 1)
        cell = (place[2] * n[1] + place[1]) * n[0] + place[0]
        after[i] = first[cell]
        first[cell] = i


def _search(
    x: Any, radius: Any, start: int, stop: int, n: Any, side: Any, periodic: Any, first: Any, after: Any, touch: float,
    place: Any,
) -> tuple[int, int]:  # fmt: skip
    """Return the first of the balls ``start`` to ``stop`` that overlaps a later one, and the first of those; or (-1, -1)."""
    for i in range(start, stop):
        for axis in range(3):
            r = x[i, axis] % side[axis] if periodic[axis] else x[i, axis]
            place[axis] = min(max(int(r / side[axis] * n[axis]), 0), n[axis] - 1)
        least: Any = -1
        for step in range(27):
            cell = neighbour_cell(place, step, n, periodic, 3)
            j: Any = np.int64(first[cell]) if cell >= 0 else np.int64(NONE)
            while j != NONE:
                if i < j and (least < 0 or j < least):
                    square = 0.0
                    for axis in range(3):
                        r = x[i, axis] - x[j, axis]
                        if periodic[axis]:
                            r -= side[axis] * np.round(r / side[axis])
                        square += r * r
                    reach = radius[i] + radius[j] - touch * min(radius[i], radius[j])
                    if square < reach * reach:
                        least = j
                j = np.int64(after[j])
        if least >= 0:
            return i, least
    return -1, -1
