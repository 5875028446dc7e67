"""A law tabulated in its own parameters, for fits of many rows to a law that is costly to solve.

Wall and floor at once takes 8 us a contact, and a fit to a row whose spin was not measured asks for some 20,000. But the answer
depends on few numbers: scaled by the speed, on the direction and the spin of the ball before the wall, on the wall's restitution
and friction, and, where the film's error of it is fitted, on the friction of the floor. So it is solved on a grid of directions and
spins for each node of a lattice in restitution and log friction, when a trial point first needs that node. At a trial point sixteen
nodes are combined into one grid, with its derivatives (:func:`carom.fitting.laws.look_up`); interpolation is cubic, and in the
floor's friction, which the film knows well, linear.

Where a contact changes from sliding to sticking the answer has a kink, across which a table is off by a share of its spacing:
by 1.3e-3 of the speed (rms; 4e-3 at most) on the coarse lattice, which serves the search, and by 3e-5 (3e-4) on a fine one for
narrow error bars, which space its nodes about the place that was found (tests keep that). With six error bars between nodes the
deviance of 89 rebounds was off by 12 beside the best friction, with one by 0.05. The fine one serves what asks how much the
deviance rises: what is identifiable, the friction's profile, the bootstrap, cross-validation. The estimates, chi^2 and AICc are
from the law itself, by a descent that starts there, and are those of a fit without a table to a hundredth of an error bar, the
friction's error bar to 5 % (a test says so).
"""

from __future__ import annotations

import functools
import itertools
import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from carom.core.jit.threads import block_slices
from carom.fitting.deviance import RowData
from carom.fitting.laws import DENSE, INDEX, NUMBERS, PARAMETERS, PLANES, TOGETHER
from carom.fitting.likelihood import predictions
from carom.fitting.model import FitModel
from carom.fitting.rows import Problem

Array = NDArray[np.float64]
LEAST_ROWS = 60  # without spin: from here on a table is quicker than the law
COARSE, NEAR, FINE = (28, 120), (40, 170), (56, 240)  # directions and spins
NARROW = 2e-3  # error bar of restitution or log friction: with a smaller one a fine table has a fine grid, too
SPACING = (2.0**-4, 2.0**-3)  # of the coarse lattice, in restitution and log(friction + OFFSET)
OFFSET = 0.02
FURTHEST_SPIN = 12.5  # v/a
STEEPEST = 0.97  # direction, v_t / (v_n + v_t), up to which there are tables
FLOOR_STEP = 1.0  # error bars of the floor's friction between the nodes in it
FINE_STEP = 1.0  # error bars of restitution and friction between fine nodes
FINEST = -12  # power of 2
MOST_NODES = 400  # kept in memory
COLUMNS = (
    2048  # of a product of matrices: for more, BLAS starts threads, which cost ten times the product on a busy machine
)
E, MU, FLOOR = INDEX["restitution"], INDEX["friction"], INDEX["floor_friction"]


@dataclass(frozen=True)
class _Grid:
    """Directions and spins, and what does not change."""

    shape: tuple[int, int]
    stages: tuple[int, ...]
    radius: float
    steepest: float
    others: tuple[float, ...]
    """All parameters; the lattice's are replaced."""
    floor_step: float
    """Between nodes in the floor's friction; 0: it does not move."""

    @property
    def directions(self) -> Array:
        """v_t / (v_n + v_t), from a little below 0."""
        step = self.steepest / (self.shape[0] - 5)
        return np.asarray((np.arange(self.shape[0]) - 2) * step, dtype=float)

    @property
    def spins(self) -> Array:
        """asinh of the spin over DENSE v/a."""
        far = math.asinh(FURTHEST_SPIN / DENSE)
        return np.linspace(-far, far, self.shape[1])

    def head(self) -> Array:
        """Return the head of a table, without the parameters."""
        one, two = self.directions, self.spins
        return np.array(
            [one[0], 1 / (one[1] - one[0]), len(one), two[0], 1 / (two[1] - two[0]), len(two), len(self.stages)]
        )


@functools.lru_cache(maxsize=MOST_NODES)
def _node(grid: _Grid, restitution: float, friction: float, floor: float) -> Array:
    """Return the law's predictions on the grid, flat: (stages, directions, spins, 3)."""
    one, two = np.meshgrid(grid.directions, grid.spins, indexing="ij")
    v_n, v_t = 1 - np.abs(one), one
    speed = np.hypot(v_n, v_t)
    ball = np.stack([v_n / speed, v_t / speed, DENSE * np.sinh(two) / grid.radius], axis=-1).reshape(-1, 3)
    p = np.array(grid.others)
    p[[E, MU, FLOOR]] = restitution, friction, floor
    x, empty = np.tile(ball, (len(grid.stages), 1)), np.empty((0, 3))
    stages = np.repeat(np.array(grid.stages, np.int64), len(ball))
    rows = RowData(TOGETHER, 0, stages, grid.radius, None, x, empty, empty[:, :2], empty, empty, 0.0, np.empty(0))
    out = predictions("table", rows, x, p)
    out[:, 2] *= grid.radius
    return out.ravel()


@dataclass(frozen=True, eq=False)
class LawTable:
    """A lattice of nodes, which are solved when they are first needed."""

    grid: _Grid
    spacing: tuple[float, float]

    def at(self, p: Array, moves: Array, free: NDArray[np.int64]) -> Array:
        """Return the table at a trial point p (NUMBERS + S,), with derivatives in the free numbers, as compiled code reads it."""
        floor = float(p[FLOOR] + p[NUMBERS:] @ moves[:, FLOOR])
        asked = (True, E in free, MU in free, bool((free >= NUMBERS).any()))
        planes = tuple(plane for plane in range(PLANES) if asked[plane])
        return _combined(self.grid, self.spacing, float(p[E]), float(p[MU]), floor, planes)

    def covers(self, problem: Problem) -> bool:
        """Return whether all rows lie within the grid."""
        return _steepest(problem) <= self.grid.steepest


@functools.lru_cache(maxsize=24)
def _combined(
    grid: _Grid, spacing: tuple[float, float], e: float, mu: float, floor: float, planes: tuple[int, ...]
) -> Array:
    """Return the predictions between nodes, plane 0, and those of their derivatives in restitution, friction or the floor's
    friction (1 to 3) that are asked for; zeros for the others."""
    one, w, dw = _stencil(e / spacing[0], 0, round(1 / spacing[0]))
    least = math.ceil(math.log(OFFSET) / spacing[1])
    two, u, du = _stencil(math.log(mu + OFFSET) / spacing[1], least, least + 1_000_000)
    t, df = 0.0, np.zeros(2)
    if grid.floor_step:  # (a straight line: the film knows the floor well)
        t, df = (floor - grid.others[FLOOR]) / grid.floor_step, np.array([-1, 1]) / grid.floor_step
    f = np.array([1 - t, t])
    each = ((w, u, f), (dw / spacing[0], u, f), (w, du / spacing[1] / (mu + OFFSET), f), (w, u, df))
    shares = np.stack([np.einsum("i,j,k->ijk", *each[plane]).ravel() for plane in planes])
    places = np.array(list(itertools.product(one, two, (0, 1))))
    used = shares.any(axis=0)  # (a floor as it is given, of which no derivative is asked, needs half of the nodes)
    nodes = _nodes(grid, spacing, tuple(map(tuple, places[used].tolist())))
    body, shares = np.zeros((PLANES, nodes.shape[1])), shares[:, used]
    for some in block_slices(nodes.shape[1], COLUMNS):
        body[list(planes), some] = shares @ nodes[:, some]
    return np.concatenate([[e, mu, floor], grid.head(), body.ravel()])


@functools.lru_cache(maxsize=6)
def _nodes(grid: _Grid, spacing: tuple[float, float], places: tuple[tuple[int, int, int], ...]) -> Array:
    """Return the predictions at some nodes of the lattice, one a row."""
    return np.stack(
        [
            _node(
                grid,
                i * spacing[0],
                max(math.exp(j * spacing[1]) - OFFSET, 0.0),
                grid.others[FLOOR] + k * grid.floor_step,
            )
            for i, j, k in places
        ]
    )


def _stencil(x: float, low: int, high: int) -> tuple[list[int], Array, Array]:
    """Return the four nodes about x, with Lagrange's weights and their derivatives in x; all nodes within low and high."""
    first = min(max(math.floor(x) - 1, low), high - 3)
    t = x - first
    nodes = np.arange(4.0)
    w, dw = np.ones(4), np.zeros(4)
    for i in range(4):
        others = [m for m in range(4) if m != i]
        bottom = math.prod(i - m for m in others)
        w[i] = math.prod(t - nodes[m] for m in others) / bottom
        dw[i] = sum(math.prod(t - nodes[m] for m in others if m != n) for n in others) / bottom
    return [first + m for m in range(4)], w, dw


def _steepest(problem: Problem) -> float:
    """Return the largest direction of a row, with five error bars of room."""
    v_n, v_t = problem.x[:, 0], np.abs(problem.x[:, 1])
    room = 5 * np.sqrt(problem.vx[:, :2].max(axis=1)) / (v_n + v_t)
    return float((v_t / (v_n + v_t) + room).max())


def coarse_table(model: FitModel) -> LawTable | None:
    """Return a table for the search; None where the law is as quick, or depends on more than a table has."""
    problem, law = model.problem, model.law
    free = set(model.free[model.free < NUMBERS].tolist()) - {INDEX["spin_mean"], INDEX["spin_width"]}
    moved = set(np.flatnonzero(model.moves.any(axis=0)).tolist())
    if law.code != TOGETHER or law.search_code is None or problem.spins is None or problem.unknown.sum() < LEAST_ROWS:
        return None
    if (
        not (free <= {E, MU} and moved <= {FLOOR} and model.form == 0)
        or problem.stages is None
        or problem.rebounds.kind != "table"
    ):
        return None
    steepest = math.ceil(_steepest(problem) * 32) / 32
    others = model.start[:NUMBERS]
    if steepest > STEEPEST or others[INDEX["tangential_restitution"]] != 0 or others[MU] > PARAMETERS[MU].high:
        return None
    step = FLOOR_STEP * float(np.linalg.norm(model.moves[:, FLOOR])) if moved else 0.0
    if step >= others[FLOOR]:
        return None
    grid = _Grid(
        COARSE, tuple(sorted(set(problem.stages.tolist()))), problem.setting.radius, steepest, tuple(others.tolist()), step,
    )  # fmt: skip
    return LawTable(grid, SPACING)


def fine_table(coarse: LawTable, stderr: tuple[float, float], friction: float) -> LawTable:
    """Return a finer table, whose nodes are some error bars of restitution and friction apart."""

    def power(bar: float, most: float) -> float:
        return float(2.0 ** max(FINEST, math.floor(math.log2(FINE_STEP * bar)))) if 0 < FINE_STEP * bar < most else most

    along = stderr[1] / (friction + OFFSET)
    narrow = any(0 < bar < NARROW for bar in (stderr[0], along))
    grid = _Grid(
        FINE if narrow else NEAR,
        coarse.grid.stages,
        coarse.grid.radius,
        coarse.grid.steepest,
        coarse.grid.others,
        coarse.grid.floor_step,
    )
    return LawTable(grid, (power(stderr[0], SPACING[0]), power(along, SPACING[1])))
