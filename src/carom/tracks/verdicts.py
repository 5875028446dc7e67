"""Laws that a trajectory is judged by, and the result: :class:`Judgement`."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from carom.formatting import counted

LAWS = {
    "penetration": "balls, and a ball and the floor, do not overlap",
    "gravity": "a ball in the air falls freely",
    "momentum": "two balls that meet keep their momentum",
    "energy": "no contact adds energy",
    "friction": "a contact's friction is at most mu times its normal force",
    "slip": "friction acts against the slip, and a ball that rolls goes on rolling",
}
FILM_LAWS = {
    "flight": "a ball in the air keeps one acceleration",
    "steady": "a ball moves smoothly from frame to frame",
}
UNITS = {"penetration": "m", "gravity": "m/s^2", "momentum": "N s", "energy": "J", "friction": "", "slip": ""}
SIGMAS = 5.0  # a violation is larger than so many of its standard errors


@dataclass(frozen=True)
class Violation:
    """A law that a trajectory violates."""

    law: str
    """One of :data:`LAWS`, or of :data:`FILM_LAWS`."""
    time: float
    """s."""
    balls: tuple[str, ...]
    size: float
    """m, m/s^2, N s, J; of friction and slip, a coefficient or a share; of laws of films, px."""
    error: float
    """Standard error of the size."""
    text: str

    @property
    def sigmas(self) -> float:
        """The size over its error."""
        return self.size / self.error if self.error > 0 else math.inf


@dataclass
class Judgement:
    """Result of :func:`judge`."""

    noise: float
    """Standard deviation of a coordinate in a frame, m."""
    notes: list[str]
    times: tuple[float, float] = (0.0, 0.0)
    """Of the first and the last frame, s."""
    checked: dict[str, int] = field(default_factory=lambda: dict.fromkeys(LAWS, 0))
    """How often each law was checked."""
    violations: list[Violation] = field(default_factory=list)
    """In order of time."""
    unchecked: dict[str, str] = field(default_factory=dict)
    """Why the other laws could not be checked."""
    laws: dict[str, str] = field(default_factory=lambda: dict(LAWS))
    """What they say; of a film without a scale or a clock those without units."""
    unit: str = "m"
    """Of the noise, and of sizes that are lengths."""

    @property
    def scores(self) -> dict[str, float | None]:
        """Return the share of checks that each law passed; None of one that was not checked."""
        return {law: 1 - len(self.of(law)) / n if n else None for law, n in self.checked.items()}

    @property
    def verdict(self) -> str:
        """How many laws were checked, and how many violations there are in them."""
        laws, count = len(self.laws) - len(self.unchecked), len(self.violations)
        found = counted(count, "violation") if count else "no violation"
        return f"checked {laws} of {len(self.laws)} laws: {found} in {'it' if laws == 1 else 'them'}"

    def of(self, law: str) -> list[Violation]:
        """Return the violations of a law."""
        return [one for one in self.violations if one.law == law]

    def worst(self, law: str) -> Violation | None:
        """Return the violation of a law that is the largest in its own errors; None if there is none."""
        return max(self.of(law), key=lambda one: one.sigmas, default=None)

    def check(
        self, law: str, time: float, balls: Sequence[str], size: float, error: float, least: float, text: str
    ) -> None:
        """Count a check; keep it if it is larger than its errors and than rounding."""
        self.checked[law] += 1
        if size > SIGMAS * error and size > least:
            self.violations.append(Violation(law, time, tuple(balls), size, error, text))


# ----------------------------------------------------------------------------------------------------
# Laws without units, for films: what a ball in the air does whatever the scale and the clock; perspective and drag are allowed.


Array = NDArray[np.float64]
LEAST_RADIUS = 10.0  # px: outlines of smaller balls scatter by a share of them
WHOLE_RIM = 0.97  # of the rim seen: nobody holds the ball
LEAST_RUN, LONG_RUN = 15, 24  # frames
NOISE = 0.004  # radii: of the outline of a ball, at least
SCATTER = 0.05, 0.8  # radii, and px: more from frame to frame no ball does whose outline is whole
MISFIT, MISFIT_PARTS = 0.04, 0.1  # radii: from one cubic, and from two
SLOW_AT_TOP = 0.5  # of the speed at the ends, beside the top of a flight
DEEP = 4.0  # radii that a ball rises and falls, at least
MOST_NEARER = 2.0  # times, that a ball comes nearer
REPEATED = 0.1  # of the frames, that show the picture before them again
NEAR_ENDS = 0.75  # of its height, of a flight: below, shadows and floors are near


class FilmPath(NamedTuple):
    """A ball in a film."""

    times: Array
    """(F,) s."""
    places: Array
    """(F, 2) px, downward; NaN where it is not seen."""
    radius: float
    """px."""
    seen: float
    """Of its rim, usually."""


class Finding(NamedTuple):
    """What a law of films says of a part of a film."""

    law: str
    time: float
    size: float
    """px."""
    error: float
    least: float
    text: str
    noise: float
    """px, of a coordinate."""


def by_film_laws(path: FilmPath, reason: str) -> Judgement:
    """Return the judgement of a ball by the laws without units; ``reason``: why the others cannot be checked."""
    found, why = film_findings(path)
    seen = path.times[np.isfinite(path.places[:, 0])]
    times = (float(seen.min()), float(seen.max())) if len(seen) else (0.0, 0.0)
    notes = [f"judged by laws without units: {reason}"]
    noise = next((one.noise for one in found), 0.0)
    judged = Judgement(noise, notes, times, dict.fromkeys(FILM_LAWS, 0), laws=dict(FILM_LAWS), unit="px")
    for one in found:
        judged.check(one.law, one.time, ["ball"], one.size, one.error, one.least, one.text)
    judged.violations.sort(key=lambda one: one.time)
    judged.unchecked = {law: why for law, count in judged.checked.items() if not count}
    return judged


def film_findings(path: FilmPath) -> tuple[list[Finding], str]:
    """Return what the laws of films say of a ball, and why they say nothing, if they do not."""
    rows = np.flatnonzero(np.isfinite(path.places[:, 0]))
    t, x, r = path.times[rows], path.places[rows], path.radius
    if len(rows) < LEAST_RUN:
        return [], f"the ball is seen in {len(rows)} frames only"
    if r < LEAST_RADIUS or path.seen < WHOLE_RIM:
        return (
            [],
            f"the ball is too small, or hidden in part (radius {r:.3g} px, {100 * path.seen:.0f} % of its rim seen)",
        )
    step = np.hypot(*np.diff(x, axis=0).T)
    beside = np.minimum(np.roll(step, 1), np.roll(step, -1))[1:-1]
    if np.mean((step[1:-1] < 0.2 * beside) & (beside > 0.1 * r)) > REPEATED:
        return [], "frames are repeated"
    fourth = np.diff(x, 4, axis=0)[rows[4:] - rows[:-4] == 4]
    # the median of |N(0, 1)| is 0.6745; 1 + 16 + 36 + 16 + 1 = 70
    sigma = float(np.median(np.abs(fourth))) / 0.6745 / np.sqrt(70) if len(fourth) else 0.0
    noise = max(sigma, NOISE * r)
    text = f"its place scatters by {sigma:.2g} px from frame to frame, {sigma / r:.2g} of its radius"
    error = sigma / np.sqrt(max(len(fourth), 1))
    found = [Finding("steady", float(t[0]), sigma - max(SCATTER[0] * r, SCATTER[1]), error, 0.0, text, sigma)]
    for first, last in zip(*_runs(rows, x, r), strict=True):
        part = slice(first, last)
        y = x[part, 1]
        if len(y) < LEAST_RUN:
            continue
        top = int(np.argmin(y))
        deep = min(y[0], y[-1]) - y[top]
        if deep > DEEP * r and 3 < top < len(y) - 4:
            upper = np.flatnonzero(y < y[top] + NEAR_ENDS * deep) + first
            speed = np.abs(np.gradient(x[upper, 1], t[upper]))
            at = int(np.argmin(x[upper, 1]))
            beside_top = speed[max(at - 3, 0) : at + 4].max()
            if len(upper) < LEAST_RUN or beside_top > SLOW_AT_TOP * min(speed[0], speed[-1]):
                continue
            rest, least, what = _rest(t[upper], x[upper]), MISFIT, "one acceleration"
        elif last - first >= LONG_RUN and np.ptp(y) > 2 * DEEP * r:
            upper = np.arange(first, last)
            rest = min((_pair(t[upper], x[upper], k) for k in range(6, len(upper) - 6)), key=_mean)
            least, what = MISFIT_PARTS, "two accelerations"
        else:
            continue
        size = _mean(rest)
        worst = int(np.argmax((rest**2).sum(axis=1)))
        text = f"from {t[upper[0]]:.3g} to {t[upper[-1]]:.3g} s no path of {what} is nearer than {size:.2g} px"
        # (beside the noise, and the error of the mean of 2 n squares)
        size, error = float(np.sqrt(max(size**2 - 2 * noise**2, 0.0))), noise / np.sqrt(len(upper))
        found.append(Finding("flight", float(t[upper[worst]]), size, error, least * r, text, sigma))
    why = "" if any(one.law == "flight" for one in found) else "no flight that rises and falls, or a long way, is seen"
    return found, why


def _runs(rows: NDArray[np.intp], x: Array, r: float) -> tuple[list[int], list[int]]:
    """Return where runs without a bounce begin and end: a bounce is a lowest place, and a gap ends a run."""
    y, cuts = x[:, 1], [0]
    for k in range(1, len(y)):
        if rows[k] - rows[k - 1] > 6:
            cuts.append(k)
        elif k < len(y) - 1 and y[k] == y[max(k - 3, 0) : k + 4].max() and k - cuts[-1] > 1:
            drop = y[k] - max(y[max(k - 12, 0) : k].min(), y[k + 1 : k + 13].min())
            cuts += [k] if drop > 0.7 * r else []
    ends = [*cuts[1:], len(y)]
    # (the frames beside a bounce hold a part of it)
    firsts = [k + (2 if k else 0) for k in cuts]
    lasts = [k - (1 if k < len(y) else 0) for k in ends]
    return firsts, lasts


def _rest(t: Array, x: Array) -> Array:
    """Return what a cubic leaves, drag makes one of a parabola, over a quadratic: the distance from the camera."""
    tau, centred = (t - t.mean()) / max(float(np.ptp(t)), 1e-12), x - x.mean(axis=0)
    powers, none = np.vander(tau, 4), np.zeros((len(t), 4))
    # p (1 + d1 tau + d2 tau^2) = n0 + n1 tau + n2 tau^2 + n3 tau^3 in both coordinates
    nearer = -centred.T[:, :, None] * powers[:, 1:3]
    design = np.vstack([np.hstack([powers, none, nearer[0]]), np.hstack([none, powers, nearer[1]])])
    found = np.linalg.lstsq(design, centred.T.ravel(), rcond=1e-9)[0]
    distance = 1 + powers[:, 1:3] @ found[8:]
    if distance.min() < 1 / MOST_NEARER or distance.max() > MOST_NEARER:
        found, distance = np.append(np.linalg.lstsq(powers, centred, rcond=None)[0].T.ravel(), [0, 0]), np.ones(len(t))
    fitted = np.column_stack([powers @ found[:4], powers @ found[4:8]]) / distance[:, None]
    return np.asarray(centred - fitted)


def _pair(t: Array, x: Array, k: int) -> Array:
    """Return what two cubics leave, before and from frame k on: a contact may lie between."""
    return np.concatenate([_rest(t[:k], x[:k]), _rest(t[k:], x[k:])])


def _mean(rest: Array) -> float:
    """Return the root of the mean square distance."""
    return float(np.sqrt((rest**2).sum(axis=1).mean()))
