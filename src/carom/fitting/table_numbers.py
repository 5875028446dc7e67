"""A table at values of the numbers that a fit adjusts: its arrays, and their derivatives by these numbers.

Fits to whole tracks and to whole shots move it. A search of starts runs no scene again: the arrays of a table nearby follow from
the derivatives, which is exact for all numbers that end in the event loop's records linearly, and no two in a product.
"""

from __future__ import annotations

import functools
import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any, NamedTuple, Protocol, TypeVar

import numpy as np
from numpy.typing import NDArray

from carom.core.jit.dual import LANES, float_count, float_places
from carom.fitting.evidence import (
    DECIDED,
    LEANS,
    Evidence,
    OneFit,
    Ranked,
    RankedLaws,
    odds_in_words,
    verdict_words,
)
from carom.fitting.spin_chains import Minimum, minimize
from carom.formatting import format_length
from carom.scene.scene import Scene
from carom.scene.shapes import Table
from carom.simulation.records import BALLS, SceneArrays, set_up
from carom.simulation.sensitivity.follow import Column, Parameters, dual_users, linear_slopes
from carom.simulation.sensitivity.sensitivity import SEGMENT, Limits, states_and_slopes

Array = NDArray[np.float64]
MOVED = ("world", "features")
STEP = 2.0**-10  # of a number's range, for differences that are exact but for rounding


class SharedNumber(NamedTuple):
    """A number of the table that all shots share: a column of a sensitivity."""

    name: str
    value: float
    low: float
    high: float
    scale: float
    """Of a usual change, for a search."""


@dataclass(frozen=True, eq=False)
class TableNumbers:
    """The table at values of its shared numbers."""

    shared: tuple[SharedNumber, ...]
    values: Array
    """(P,)"""
    scene: Scene
    """At the values at which the derivatives were taken."""
    arrays: SceneArrays
    parameters: Parameters | None
    """Of a sensitivity: columns, and their derivatives; None where no number is fitted."""

    @functools.cached_property
    def duals(self) -> NDArray[np.int64]:
        """Addresses of laws that are called by address, of dual numbers."""
        return dual_users(self.scene.called_laws)

    @property
    def slopes(self) -> dict[str, Array]:
        """Derivatives of world and features, packed for compiled code: (C, rows, numbers, LANES)."""
        return {} if self.parameters is None else self.parameters.packed

    @functools.cached_property
    def _moved(self) -> tuple[list[tuple[str, str, slice]], Array]:
        """Arrays and fields that the numbers change, each with its columns in the derivatives (P, M) of all."""
        fields: list[tuple[str, str, slice]] = []
        parts, first = [], 0
        slopes = [] if self.parameters is None else self.parameters.slopes
        for array in MOVED if slopes else ():
            for field, some in slopes[0][array].items():
                every = np.array([one[array].get(field, 0.0 * some) for one in slopes])
                if every.any():
                    flat = every.reshape(len(slopes), -1)
                    fields.append((array, field, slice(first, first + flat.shape[1])))
                    parts.append(flat)
                    first += flat.shape[1]
        return fields, np.concatenate(parts, axis=1) if parts else np.zeros((len(slopes), 0))

    @functools.cached_property
    def ends(self) -> tuple[Array, Array]:
        """Bounds (P,) of the numbers."""
        low, high = (np.array([getattr(one, end) for one in self.shared]) for end in ("low", "high"))
        return low, high

    def at_deviations(self, by: Array) -> Array:
        """Return the numbers (..., P) of shots for which they differ by so much, within their bounds."""
        return np.asarray(np.clip(self.values + by, *self.ends))

    def moved(self, by: Array) -> SceneArrays:
        """Return the arrays of a shot for which the numbers differ by so much (P,), or of N shots (N, P), the features of one after
        the other's; none at all: the table of all shots."""
        if not np.any(by):
            return self.arrays
        many = by.size // by.shape[-1]
        made = self.arrays._replace(
            world=np.tile(self.arrays.world, many), features=np.tile(self.arrays.features, many)
        )
        fields, slopes = self._moved
        change = (self.at_deviations(by) - self.values).reshape(many, -1) @ slopes
        for array, field, columns in fields:
            into = getattr(made, array)[field]
            into += change[:, columns].reshape(into.shape)
        return made

    def at(self, values: Array) -> TableNumbers:
        """Return the table at other values (P,), of arrays that are affine in the numbers (:func:`affine_table`)."""
        return replace(self, values=values, arrays=self.moved(values - self.values))


def affine_table(scene: Callable[[dict[str, float]], Scene], shared: tuple[SharedNumber, ...]) -> TableNumbers:
    """Return the table of a scene whose arrays are affine functions of numbers, at their values."""
    start = {one.name: one.value for one in shared}
    made = scene(start)
    arrays, slopes = set_up(made), []
    for one in shared:

        def shifted(by: float, name: str = one.name) -> SceneArrays:
            return set_up(scene({**start, name: start[name] + by}), compiled=False)

        found = linear_slopes(arrays, shifted, one.value, STEP * min(one.high - one.low, 1.0))
        assert found is not None, f"{one.name}: the arrays of a scene are not linear in it"
        slopes.append(found)
    columns = [Column(name, name, None, (value,)) for name, value in start.items()]
    parameters = Parameters(arrays, tuple(start), columns, slopes) if shared else None
    return TableNumbers(shared, np.array([*start.values()]), made, arrays, parameters)


# ----------------------------------------------------------------------------------------------------
# Starts of filmed balls: the states that they lead to, with derivatives, the start whose run is nearest to the frames, and the
# descent of the numbers that all share, which the starts follow.
#
# A start is a vector of numbers in which the places, velocities and spins of the balls are linear. One call serves N starts of
# one ball each (segments of tracks) as well as one start of many balls (a shot).


Residual = Callable[[NDArray[np.int64], Array, bool], tuple[Array, Array | None]]
"""Of some starts: gaps (n, M) in standard deviations, and on request their derivatives (n, M, K)."""
Tried = TypeVar("Tried")


def balls_by(balls: int, numbers: Sequence[Sequence[tuple[int, str, int, float]]]) -> Array:
    """Return the derivatives (B, numbers of a ball, K) of balls by the K numbers of a start.

    Of each number of the start what it moves: ball, x, v or w, the component, and by how much.
    """
    found, places = np.zeros((balls, float_count(BALLS), len(numbers))), float_places(BALLS)
    for k, moved in enumerate(numbers):
        for ball, name, component, slope in moved:
            found[ball, places[name].start + component, k] = slope
    return found


def balls_of(arrays: SceneArrays, by: Array, starts: Array) -> NDArray[np.void]:
    """Return the balls (N, B), which lie on the floor, of starts (N, K); ``by`` (B, numbers, K): :func:`balls_by`."""
    balls, places = np.tile(arrays.balls[: len(by)], (len(starts), 1)), float_places(BALLS)
    for name in "xvw":
        balls[name] = np.einsum("bfk,nk->nbf", by[:, places[name]], starts)
    balls["x"][..., 2] = balls["radius"]
    return balls


class StatesBy(NamedTuple):
    """States of N runs of B balls at T times, with exact derivatives."""

    states: Array
    """(N, T, B, 9): position, velocity, spin; NaN where the model has none."""
    by_start: Array
    """(N, T, B, n, K): of their first n numbers, by the numbers of the start; 0 from a graze on."""
    by_shared: Array
    """(N, T, B, n, P): by the numbers of the table."""


def states_by(
    table: TableNumbers, balls: NDArray[np.void], by: Array, time: Array, count: NDArray[np.int64], numbers: int = 2, *,
    shared: bool = False, deviations: Array | None = None, limits: Limits = SEGMENT,
) -> StatesBy:  # fmt: skip
    """Return states of runs of balls (N, B) at times (N, T) since their starts, of which ``count`` (N,) are evaluated, s.

    ``by``: :func:`balls_by`; ``numbers``: of a state, whose derivatives are wanted; ``shared``: whether those by the table's
    numbers are; ``deviations`` (P,) or (N, P): by which these differ for these runs, or for each.
    """
    b, floats, k = by.shape
    parts = table.slopes if shared else {}
    mine = -(-k // LANES)
    by_start = np.zeros((1, mine + (len(parts["world"]) if parts else 0), b, floats, LANES))
    for column in range(k):
        by_start[0, column // LANES, :, :, column % LANES] = by[:, :, column]
    by_scene = {
        name: np.concatenate(
            [np.zeros((mine, len(rows), float_count(rows.dtype), LANES)), *([parts[name]] if parts else [])]
        )
        for name, rows in (("world", table.arrays.world), ("features", table.arrays.features))
    }
    arrays = table.arrays if deviations is None else table.moved(deviations)
    states, slopes = states_and_slopes(
        arrays, table.duals, balls, time, count, by_scene, by_start, numbers, limits=limits
    )
    d = np.moveaxis(slopes, 1, 4).reshape(*slopes.shape[:1], *slopes.shape[2:5], -1)
    first = mine * LANES
    return StatesBy(states, d[..., :k], d[..., first : first + (len(table.values) if parts else 0)])


def nearest_starts(
    residual: Residual, begin: Array, scale: Array, center: Array, rows: Array, *, steps: int, tolerance: float, dof: Array,
    joint: bool,
) -> tuple[Array, Minimum]:  # fmt: skip
    """Find the nearest minima of N sums of squares: gaps and prior. Return the starts (N, K), and the minima in units of ``scale``.

    From ``begin`` (N, K), with ``scale`` (N, K), 0 of a number that is held. Priors are normal: ``rows`` (N, R, K) times (start -
    ``center`` (N, K)) are of unit width. The rest: :func:`carom.fitting.spin_chains.minimize`.
    """

    def evaluate(which: NDArray[np.int64], u: Array, derivatives: bool) -> tuple[Array, Array, Array]:
        at = begin[which] + scale[which] * u
        gap, slope = residual(which, at, derivatives)
        off = np.einsum("nrk,nk->nr", rows[which], at - center[which])
        value = np.square(gap).sum(axis=1) + np.square(off).sum(axis=1)
        if slope is None:
            return value, u, u
        slope, prior = slope * scale[which][:, None], rows[which] * scale[which][:, None]
        # (1 for a held number: a 0 is lost in the rounding of the others, and the matrix taken for an indefinite one)
        held = (scale[which] == 0)[:, :, None] * np.eye(begin.shape[1])
        with np.errstate(over="ignore", invalid="ignore"):
            score = -np.einsum("nmk,nm->nk", slope, gap) - np.einsum("nrk,nr->nk", prior, off)
            information = np.swapaxes(slope, 1, 2) @ slope + np.swapaxes(prior, 1, 2) @ prior + held
        # (derivatives through many contacts may be so large that their squares are infinite: such a start stays where it is)
        lost = ~np.isfinite(information).all(axis=(1, 2))
        score[lost], information[lost] = 0.0, np.eye(begin.shape[1])
        return value, score, information

    far = np.full(begin.shape[1], np.inf)
    found = minimize(evaluate, np.zeros_like(begin), -far, far, steps=steps, tolerance=tolerance, dof=dof, joint=joint)
    return begin + scale * found.p, found


class Projection(NamedTuple):
    """The starts' part of the derivatives of residuals: variable projection (Golub & Pereyra, SIAM J. Numer. Anal. 10, 413 (1973))
    with Kaufman's derivative, BIT 15, 49 (1975)."""

    basis: Array
    """(..., M, K) orthonormal."""
    inverse: Array
    """(..., K, K): basis and inverse make the pseudoinverse of the derivatives by the starts."""

    @classmethod
    def of(cls, by_start: Array) -> Projection:
        """Return the projection for residuals (..., M), prior included, with such derivatives (..., M, K) by the starts."""
        with np.errstate(over="ignore"):  # (derivatives too large to be squared have no part in the fit)
            unit = 1 / np.maximum(np.sqrt(np.square(by_start).sum(axis=-2)), 1e-300)
        basis, triangle = np.linalg.qr(by_start * unit[..., None, :])
        return cls(basis, unit[..., :, None] * np.linalg.pinv(triangle, rcond=1e-12))

    def rest(self, by_shared: Array) -> Array:
        """Return the derivatives (..., M, P) with the starts refitted; the squares of these are the information."""
        return np.asarray(by_shared - self.basis @ (np.swapaxes(self.basis, -1, -2) @ by_shared))

    def follows(self, by_shared: Array) -> Array:
        """Return how the starts follow the shared numbers (..., K, P)."""
        return np.asarray(-self.inverse @ (np.swapaxes(self.basis, -1, -2) @ by_shared))


class Followers(Protocol[Tried]):
    """Filmed balls whose starts follow the numbers that all share: segments of tracks, or shots."""

    def tried(self, values: Array) -> tuple[float, Tried]:
        """Return the deviance at shared numbers (P,) with the starts fitted again, from the best so far, and these starts; inf
        where no table has such numbers."""

    def taken(self, values: Array, tried: Tried) -> tuple[float, Array, Array]:
        """Take these starts for the best so far. Return the deviance, -1/2 of its gradient (P,) and 1/2 of its curvature (P, P),
        with the starts projected out. (They may be fitted once more, which makes the deviance smaller.)"""


def descend_shared(
    followers: Followers[Tried], begin: Array, low: Array, high: Array, *, steps: int, tolerance: float, dof: float | None = None,
    most: float = np.inf,
) -> Array:  # fmt: skip
    """Return the numbers (P,) that all share, at the nearest minimum: variable projection within bounds.

    The rest: :func:`carom.fitting.spin_chains.minimize`.
    """
    last: tuple[float, Tried]

    def evaluate(_which: NDArray[np.int64], at: Array, derivatives: bool) -> tuple[Array, Array, Array]:
        nonlocal last
        if not derivatives:
            last = followers.tried(at[0])
            return np.array([last[0]]), at, at
        value, score, information = followers.taken(at[0], last[1])
        return np.array([value]), score[None], information[None]

    each = None if dof is None else np.array([dof])
    found = minimize(
        evaluate, begin[None], low, high, steps=steps, tolerance=tolerance, dof=each, joint=False, most=most
    )
    return np.asarray(found.p[0])


# ----------------------------------------------------------------------------------------------------
# The table of a film: cushions between the lines at which they reflect the centres of the balls.


def reach_of(radius: float, nose: float | None) -> float:
    """Return how far from a cushion's edge at the height ``nose`` (m) the centre of a ball is when it touches it, m."""
    return radius if nose is None or nose <= radius else math.sqrt(radius * radius - (nose - radius) ** 2)


def cushions_between(lines: Mapping[str, float], radius: float, nose: float | None, **surface: Any) -> Table:
    """Return the table whose cushions reflect the centres of balls at lines: left, right, bottom, top, m."""
    reach = reach_of(radius, nose)
    x0, x1 = lines["left"] - reach, lines["right"] + reach
    y0, y1 = lines["bottom"] - reach, lines["top"] + reach
    return Table(length=x1 - x0, width=y1 - y0, center=((x0 + x1) / 2, (y0 + y1) / 2), nose_height=nose, **surface)


# ----------------------------------------------------------------------------------------------------
# Filmed shots as the independent data: laws compared by shots, in how many one is nearer and by what chance, and error bars by
# the scatter of shots. (Frames of a shot are not independent.)


NOTHING_LEFT = 1e-9  # share of the information that the other shots have
# Probabilities of such a difference between laws that are equally good (Wilcoxon's signed ranks)
SURE, HINT = 0.01, 0.1


class NearerShots(NamedTuple):
    """A law against another, shot by shot."""

    closer: tuple[int, int] | None
    """Shots in which it is nearer, and shots in all; None without a rival."""
    chance: float
    """Probability of such a difference between equally good laws."""

    @property
    def support(self) -> float:
        """Weight of this difference on the scale of odds."""
        if self.closer is None or self.chance > HINT or self.closer[0] <= self.closer[1] / 2:
            return 0.0
        return LEANS if self.chance > SURE else DECIDED


def nearer_shots(near: Array, far: Array) -> NearerShots:
    """Compare the distances (N,) of a law and of another in the same shots, by Wilcoxon's signed-rank test on their ratios."""
    from scipy.stats import wilcoxon

    ratio = np.log(np.maximum(far, 1e-12) / np.maximum(near, 1e-12))
    chance = float(wilcoxon(ratio).pvalue) if len(ratio) > 1 and np.any(ratio != 0) else 1.0
    return NearerShots((int((ratio > 0).sum()), len(ratio)), chance)


@dataclass(frozen=True, eq=False, repr=False)
class RankedByShots(RankedLaws[OneFit]):
    """All laws fitted to filmed shots, best first, and the verdict: what rankings of whole tracks and whole shots share."""

    closer: tuple[int, int] | None
    """Shots in which the best law is nearer than that one, and shots in all."""
    chance: float
    """Probability of such a difference between equally good laws (Wilcoxon's signed-rank test on the distances of shots)."""
    decisive: bool = False
    """Whether the verdict is a decision."""


def compared_by_shots(
    fits: Sequence[OneFit], evidence: Evidence, distances: Callable[[OneFit], Array], subject: str, *, by_odds: bool = False,
    before: str = "", more: str = "", alone: str = "",
) -> dict[str, Any]:  # fmt: skip
    """Return the fields of :class:`RankedByShots` but for the notes: all laws, and the verdict on the best and its rival.

    ``distances``: of a fit to each shot (N,), m; ``subject``: the tracks, the shots; ``by_odds``: whether the best law follows the
    frames, so that odds count; else shots do, ``before`` says so, and ``more`` is appended; ``alone``: a reason without a rival.
    """
    rival, best = evidence.rival, fits[0]
    found, support, odds, reason = NearerShots(None, math.nan), evidence.odds, math.nan, alone
    if rival is not None:
        near, far = distances(best), distances(rival)
        found, medians = nearer_shots(near, far), [format_length(float(np.median(one))) for one in (near, far)]
        nearer = f"nearer than {rival.law.name} in {found.closer[0]} of {found.closer[1]} shots" if found.closer else ""
        support, reason = found.support, f"{nearer} (median {' against '.join(medians)})"
        if by_odds:
            support = odds = evidence.odds
            reason = f"{odds_in_words(odds)} over {rival.law.name}"
    said = verdict_words(best.law.called, evidence, subject, support, reason)
    if before and support < LEANS:
        said += f"; {best.law.name} is {reason}"
    return found._asdict() | {
        "ranked": tuple(map(Ranked, fits, evidence.weights.tolist())), "against": rival.law.name if rival else "", "odds": odds,
        "verdict": f"{before}{said[0].upper()}{said[1:]}{more}.", "decisive": rival is not None and support >= DECIDED,
    }  # fmt: skip


def covariance_by_shot(information: Array, scores: Array, by_shot: Array) -> Array:
    """Return the covariance (P, P) from the scatter of shots: their scores (N, P) and information (N, P, P), whose sum is given.

    Each score is corrected for how much of the information is the shot's own (CR2 of Bell & McCaffrey 2002).
    """
    root = np.linalg.inv(np.linalg.cholesky(information))
    moved = []
    for score, own in zip(scores, by_shot, strict=True):
        share, along = np.linalg.eigh(root @ own @ root.T)
        left = 1 - np.clip(share, 0.0, 1.0)
        # (a wall that only this shot meets: nothing is left, and the score of the other shots is zero)
        factor = np.divide(1.0, np.sqrt(left), out=np.zeros_like(left), where=left > NOTHING_LEFT)
        moved.append(root.T @ (along @ (factor * (along.T @ (root @ score)))))
    return np.asarray(np.array(moved).T @ np.array(moved))
