"""The result of judging a trajectory, and the laws without units for films.

Laws that a trajectory is judged by, and the result: :class:`Judgement`.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, field
from itertools import pairwise
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from carom.formatting import counted

LAWS = {
    "penetration": "balls, and a ball and the floor, do not overlap",
    "gravity": "a ball in the air falls freely",
    "turn": "a ball in the air turns at a ball or a wall alone",
    "momentum": "two balls that meet keep their momentum",
    "energy": "no contact adds energy",
    "friction": "a contact's friction is at most mu times its normal force",
    "slip": "friction acts against the slip, and a ball that rolls goes on rolling",
}
FILM_LAWS = {
    "flight": "a ball in the air keeps one acceleration",
    "steady": "a ball moves smoothly from frame to frame",
    "shape": "a ball is round in a picture",
    "bounce": "no bounce adds to height and time in the air",
    "restitution": "a slower bounce gives back no smaller share",
    "size": "a ball keeps its size: in its radii it falls alike in all flights",
}
UNITS = {
    "penetration": "m",
    "gravity": "m/s^2",
    "turn": "m/s",
    "momentum": "N s",
    "energy": "J",
    "friction": "",
    "slip": "",
}
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
    """m, m/s^2, m/s, N s, J; of friction and slip, a coefficient or a share; of laws of films, px."""
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
WHOLE_WIDTH = 0.85  # radii: half the width of what differs from the background, at least
WHOLE_RIM = 0.97  # of the rim seen: nobody holds the ball
LEAST_RUN, LONG_RUN, SHORT_RUN = 15, 24, 8  # frames
NOISE = 0.004  # radii: of the outline of a ball, at least
SCATTER = 0.05, 0.8  # radii, and px: more from frame to frame no ball does whose outline is whole
MISFIT, MISFIT_PARTS, MISFIT_SHORT = 0.04, 0.1, 0.08  # radii: from one cubic, two, one that is nearly a parabola
LEAST_FLIGHT, HIGHER = 8, 0.1  # frames from bounce to bounce; of a fall, that a rise after it is larger
CHANGE = 0.4  # of the acceleration, at the ends of a short part of a flight: drag and perspective change it by less
SHALLOW = 3.0  # radii that a short part is high, at least
SLOW, LEAST_SLOW = 0.3, 8  # radii from frame to frame that hardly blur; frames
OBLIQUE = 1.155  # length over width of a sphere's outline, 30 degrees off the axis of the camera: 1 / cos 30
WIDEST = 1.0  # tangent of the angle off the axis in the corner of a picture, at most: 45 degrees
NEARER = 0.2  # by which the width of a ball (as a logarithm) changes in a short part of a flight, at most
SLOWER = 0.1  # of a restitution (as a logarithm): by as much it may be less at a slower bounce; spin and drag change it
ALIKE = 0.25  # by which flights may differ in acceleration over width (as a logarithm): by drag, spin and perspective
SLOW_AT_TOP = 0.5  # of the speed at the ends, beside the top of a flight
DEEP = 4.0  # radii that a ball rises and falls, at least
MOST_NEARER = 2.0  # times, that a ball comes nearer
REPEATED = 0.1  # of the frames, that show the picture before them again
NEAR_ENDS = 0.75  # of its height, of a flight: below, shadows and floors are near


UNSEEN = {
    "flight": "no flight that rises and falls, or a long way, is seen",
    "shape": "the ball is not seen slow, with a whole outline",
    "bounce": "fewer than three bounces in a row are seen",
    "restitution": "fewer than four bounces in a row are seen",
    "size": "fewer than two flights from bounce to bounce are seen, with whole outlines",
}


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
    outlines: Array | None = None
    """(F, 3): half the width, px; and of second moments, (xx - yy, 2 xy) / (xx + yy). NaN where the outline is not seen whole."""
    corner: tuple[float, float] = (0.0, 0.0)
    """Half the size of the picture, px."""
    moves: str = ""
    """How the camera moves, if it does."""


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
    noise = max((one.noise for one in found), default=0.0)
    judged = Judgement(noise, notes, times, dict.fromkeys(FILM_LAWS, 0), laws=dict(FILM_LAWS), unit="px")
    for one in found:
        judged.check(one.law, one.time, ["ball"], one.size, one.error, one.least, one.text)
    judged.violations.sort(key=lambda one: one.time)
    judged.unchecked = {law: why or UNSEEN.get(law, "") for law, count in judged.checked.items() if not count}
    return judged


def film_findings(path: FilmPath) -> tuple[list[Finding], str]:
    """Return what the laws of films say of a ball, and why they say nothing, if they do not."""
    rows = np.flatnonzero(np.isfinite(path.places[:, 0]))
    t, x, r = path.times[rows], path.places[rows], path.radius
    if why := _not_judged(path, len(rows)):
        return [], why
    found = _shape(path, rows)
    if path.moves:
        return found, f"the camera moves: {path.moves}"
    if r < LEAST_RADIUS or path.seen < WHOLE_RIM:
        return found, f"the ball is too small, or hidden in part (radius {r:.3g} px, {path.seen:.0%} of its rim seen)"
    step = np.hypot(*np.diff(x, axis=0).T)
    beside = np.minimum(np.roll(step, 1), np.roll(step, -1))[1:-1]
    if np.mean((step[1:-1] < 0.2 * beside) & (beside > 0.1 * r)) > REPEATED:
        return found, "frames are repeated"
    fourth = np.diff(x, 4, axis=0)[rows[4:] - rows[:-4] == 4]
    # the median of |N(0, 1)| is 0.6745; 1 + 16 + 36 + 16 + 1 = 70
    sigma = float(np.median(np.abs(fourth))) / 0.6745 / np.sqrt(70) if len(fourth) else 0.0
    noise = max(sigma, NOISE * r)
    text = f"its place scatters by {sigma:.2g} px from frame to frame, {sigma / r:.2g} of its radius"
    error = sigma / np.sqrt(max(len(fourth), 1))
    found += [Finding("steady", float(t[0]), sigma - max(SCATTER[0] * r, SCATTER[1]), error, 0.0, text, sigma)]
    runs = _runs(rows, x, r)
    found += _bounces(
        rows, t, x[:, 1], runs, noise, np.full(len(rows), np.nan) if path.outlines is None else path.outlines[rows, 0]
    )
    for first, last in zip(*runs, strict=True):
        y = x[first:last, 1]
        if len(y) < SHORT_RUN:
            continue
        top = int(np.argmin(y))
        deep = min(y[0], y[-1]) - y[top]
        near = np.flatnonzero(y < y[top] + NEAR_ENDS * np.ptp(y)) + first
        down = np.diff(x[near, 1])
        bounces = (down < -3 * noise) & np.logical_or.accumulate(down > 3 * noise)  # (one that is too low to be cut at)
        short = SHORT_RUN <= len(near) < LEAST_RUN and np.ptp(y) > SHALLOW * r
        if short and not bounces.any() and _keeps_size(path, rows[near]):
            upper, rest, least, what = near, _nearly_even(t[near], x[near]), MISFIT_SHORT, "one acceleration"
        elif len(y) < LEAST_RUN:
            continue
        elif deep > DEEP * r and 3 < top < len(y) - 4:
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
    return found, ""


def _not_judged(path: FilmPath, frames: int) -> str:
    """Return why nothing is to be said of a ball; empty if something is."""
    if frames < LEAST_RUN:
        return f"the ball is seen in {frames} frames only"
    width = np.zeros(0) if path.outlines is None else path.outlines[np.isfinite(path.outlines[:, 0]), 0]
    if len(width) and np.median(width) < WHOLE_WIDTH * path.radius:
        return "a part of the ball looks like what is behind it"
    return ""


def _bounces(
    rows: NDArray[np.intp], t: Array, y: Array, runs: tuple[list[int], list[int]], noise: float, width: Array
) -> list[Finding]:
    """Return what bounces in a row say: by how much more a ball rises after one than it fell before it; restitution; size.

    It rises more in the picture where it goes away from a camera that looks down, and is longer in the air beyond the edge of a
    table; both is energy. A flight takes 2 v/g, so that restitutions are ratios of times.
    """
    found = list[Finding]()
    between = [
        sorted((max(last - 1, 0), min(first, len(y) - 1))) for first, last in zip(runs[0][1:], runs[1], strict=False)
    ]
    lows = [first + int(np.argmax(y[first : last + 1])) for first, last in between]
    for one, two, three in zip(lows, lows[1:], lows[2:], strict=False):
        if min(two - one, three - two) < LEAST_FLIGHT or np.diff(rows[one : three + 1]).max() > 2:
            continue
        fall, rise = (float(y[two] - y[a:b].min()) for a, b in ((one, two), (two, three)))
        longer = t[three] - t[two] - (t[two] - t[one])
        gained = rise - (1 + HIGHER) * fall if longer > 2 * np.median(np.diff(t)) else -fall
        text = f"it rises by {rise:.3g} px after it fell by {fall:.3g} px, and is {longer:.2g} s longer in the air"
        found.append(Finding("bounce", float(t[two]), gained, 3 * noise, 0.0, text, 0.0))
    frame, flights = float(np.median(np.diff(t))), list[tuple[int, float, float, float, float]]()
    for one, two in pairwise(lows):
        inner = slice(one + 2, two - 1)
        long, tau = float(t[two] - t[one]), t[inner] - t[one]
        if two - one < LEAST_FLIGHT or np.diff(rows[one : two + 1]).max() > 2:
            flights.append((one, long, math.nan, math.nan, math.nan))
            continue
        fall, _v, _y = np.polyfit(tau, y[inner], 2)
        known = width[inner][np.isfinite(width[inner])]
        wide = float(np.median(known)) if len(known) > LEAST_FLIGHT / 2 else math.nan
        flights.append((one, long, 2 * float(fall), wide, noise * math.sqrt(720 / len(tau)) / float(np.ptp(tau)) ** 2))
    for first, second, third in zip(flights, flights[1:], flights[2:], strict=False):
        falls = [one[2] for one in (first, second, third)]
        a, b, c = (one[1] for one in (first, second, third))
        if not (min(falls) > 0 and max(falls) < 1.5 * min(falls) and a > b > c):
            continue
        less = math.log(b * b / (a * c))
        # (a bounce is half a frame beside its lowest place, at most)
        late = frame / 2 * (2 / a + 4 / b + 2 / c)
        text = f"a bounce gives back {b / a:.2g} of its speed, the slower one after it {c / b:.2g}"
        found.append(Finding("restitution", float(t[third[0]]), less - SLOWER, late / SIGMAS, 0.0, text, 0.0))
    sized = [one for one in flights if one[2] > 0 and one[3] > 0]
    for first, second in pairwise(sized):
        ratio = math.log(second[2] * first[3] / (first[2] * second[3]))
        error = math.hypot(first[4] / first[2], second[4] / second[2])
        text = f"in its radii it falls {math.exp(abs(ratio)):.3g} times as fast in one flight as in the next"
        found.append(Finding("size", float(t[second[0]]), abs(ratio) - ALIKE, error, 0.0, text, 0.0))
    return found


def _shape(path: FilmPath, rows: NDArray[np.intp]) -> list[Finding]:
    """Return how much longer than wide the outline is where the ball is slow; in perspective a sphere's is, too."""
    if path.outlines is None:
        return []
    step = np.hypot(*np.gradient(path.places[rows], rows, axis=0).T)
    slow = rows[(step < SLOW * path.radius) & np.isfinite(path.outlines[rows, 0])]
    if path.radius < LEAST_RADIUS or len(slow) < LEAST_SLOW:
        return []
    usual = np.median(path.outlines[slow, 1:], axis=0)
    off = np.hypot(*(path.outlines[slow, 1:] - usual).T)
    stretch = min(float(np.hypot(*usual)), 0.99)
    # half the length less half the width, of as large an ellipse
    aside = np.hypot(*(path.places[slow] - path.corner).T).max() / np.hypot(*path.corner)
    ratios = np.sqrt((1 + stretch) / (1 - stretch)), max(OBLIQUE, np.hypot(1.0, WIDEST * aside))
    long, allowed = (path.radius * (np.sqrt(one) - 1 / np.sqrt(one)) for one in ratios)
    error = path.radius * float(np.median(off)) / np.sqrt(len(slow))
    text = f"its outline is {ratios[0]:.3g} times as long as wide, in {len(slow)} frames in which it hardly moves"
    k = slow[int(np.argmin(off))]
    size, least = float(long - allowed), NOISE * path.radius
    return [Finding("shape", float(path.times[k]), size, max(error, 1e-3), least, text, 0.0)]


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


def _keeps_size(path: FilmPath, rows: NDArray[np.intp]) -> bool:
    """Return whether the ball is known to come hardly nearer, and to go hardly farther away."""
    widths = np.full(len(rows), np.nan) if path.outlines is None else np.log(path.outlines[rows, 0])
    first, last = (one[np.isfinite(one)] for one in np.array_split(widths, 2))
    return bool(len(first) and len(last) and abs(np.median(first) - np.median(last)) < NEARER / 2)


def _nearly_even(t: Array, x: Array) -> Array:
    """Return what a cubic leaves whose acceleration changes by a share of it at most, from the middle to the ends."""
    tau, centred = 2 * (t - t.mean()) / max(float(np.ptp(t)), 1e-12), x - x.mean(axis=0)
    powers = np.vander(tau, 4, increasing=True)
    free = np.linalg.lstsq(powers, centred, rcond=None)[0]
    if 3 * np.hypot(*free[3]) <= CHANGE * np.hypot(*free[2]):
        return np.asarray(centred - powers @ free)
    rests = []
    for sign in (1, -1):
        bent = np.column_stack([powers[:, :2], powers[:, 2] + sign * CHANGE / 3 * powers[:, 3]])
        rests.append(centred - bent @ np.linalg.lstsq(bent, centred, rcond=None)[0])
    return min(rests, key=_mean)


def _pair(t: Array, x: Array, k: int) -> Array:
    """Return what two cubics leave, before and from frame k on: a contact may lie between."""
    return np.concatenate([_rest(t[:k], x[:k]), _rest(t[k:], x[k:])])


def _mean(rest: Array) -> float:
    """Return the root of the mean square distance."""
    return float(np.sqrt((rest**2).sum(axis=1).mean()))
