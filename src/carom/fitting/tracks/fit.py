"""Fits of laws to whole tracks: the search for one law, and the ranking of all.

Fit of one law to whole tracks from its starting values, in growing windows: one search.

With given noise of the frames the deviance is chi^2; else the scatter of each segment is estimated from its residuals, so that one
deviating shot has no more weight than others. The fitted frames are extended from window to window: those before the first contact,
then those before the second, and so on, because a small error of a start has large effects only later.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import partial
from itertools import pairwise
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from carom.errors import CaromError
from carom.files import require_library
from carom.fitting.evidence import weigh
from carom.fitting.identify import HALF_WIDTH_CLOSE, LEVELS, half_width
from carom.fitting.ranking import step_callback
from carom.fitting.result import scaled
from carom.fitting.rows import Setting, require_settings
from carom.fitting.spin_chains import cross_kinks
from carom.fitting.table_numbers import RankedByShots, compared_by_shots
from carom.fitting.tracks.model import (
    MISFIT_AS_NOISE,
    SIDESPIN,
    SLIP,
    START_STEPS,
    VELOCITY,
    WALL_RANGE,
    BestStarts,
    Numbers,
    SegmentArrays,
    Starts,
    TrackFit,
    TrackModel,
    TrackSegment,
    ambiguous,
    descend,
    effective_numbers,
    find_segments,
    held_rises,
    scan,
    settle,
    side_of,
    track_models,
    with_errors,
)
from carom.formatting import format_length, json_value
from carom.laws.registry import one_or_several
from carom.public.progress import Progress
from carom.tracks.events import WallLine
from carom.tracks.measurement import Measured

Array = NDArray[np.float64]
# Decrease of chi^2 for which a slide before the first contact is accepted: two more parameters, 1 % by chance
SLIDE_GAIN = 9.21
SLIDE_SHARES = (0.15, 0.7)  # of full slip at the start: a small part of it, or most of it
SIDESPINS = 17  # number of sidespins that are tried
SLIPS = (0.0, 0.7, 1.5, 2.5)  # along the motion, in speeds: slips beside which sidespins are tried
BEST_SPINS = 2  # of each slip: those whose starts are then fitted
FOLLOWING_STEPS = 5  # of the rest of a start after a sidespin has been changed
TURNS = 4  # rounds in which sidespins are tried again and all parameters are fitted
# v/a and v: sidespin, where no width is given, and slip at the start are normal about zero
SPIN_WIDTH, SLIP_WIDTH = 1.25, 1.0
POSITION_SCALE, LEAST_SPEED = 1e-2, 0.1  # m, m/s
LINE_FRAMES = 8
FAST = 0.2  # m/s towards a wall: slower contacts do not determine the restitution


class SearchEnd(NamedTuple):
    """Where one search has ended. Error bars cost as much as the search; only the best end is given them."""

    fit: TrackFit
    """Without error bars (:func:`carom.fitting.tracks.model.with_errors`)."""
    settled: BestStarts


def starting_numbers(measured: Measured) -> dict[str, float]:
    """Return initial parameters; range_SIDE: distance within which a wall is searched for, if that is not WALL_RANGE (m)."""
    start = {}
    for name, label in (("floor_friction", "floor friction"), ("rolling_resistance", "rolling resistance")):
        if label in measured.floor and measured.floor[label][0] > 0:
            start[name] = measured.floor[label][0]
    fitted = [(one.wall.name, one.fit) for one in measured.contacts if one.fit is not None]
    ratio = [fit["vn_out"] / -fit["vn_in"] for _wall, fit in fitted if fit["vn_in"] < -FAST]
    if ratio:
        start["restitution"] = float(np.median(ratio))
    for wall in measured.walls:
        away = [fit["away"] for name, fit in fitted if name == wall.name]
        axis = int(abs(wall.normal[1]) > 0.5)
        if away:  # the point where the motions before and after meet: the frames themselves turn up to a step before it
            start[f"wall_{side_of(wall)}"] = wall.point[axis] + wall.normal[axis] * float(np.median(away))
        elif max(map(abs, wall.normal)) > 1 - 1e-9:
            # (met only in a corner, for example) it may lie beyond the frames by the distance between two of them
            far = _largest_step(measured, wall)
            start[f"wall_{side_of(wall)}"] = wall.point[axis] - wall.normal[axis] * far / 2
            start[f"range_{side_of(wall)}"] = WALL_RANGE + far / 2
    return start


def _largest_step(measured: Measured, wall: WallLine) -> float:
    """Return the largest distance (m) that a ball moves normal to a wall between two frames at a contact."""
    steps = [0.0]
    for track in measured.tracks:
        d = wall.frame(track.position)[:, 0]
        for event in measured.events[track.group, track.name]:
            if event.kind == "wall" and event.what == wall.name:
                at = int(np.searchsorted(track.time, (event.low + event.high) / 2))
                steps += np.abs(np.diff(d[max(at - 3, 0) : at + 3])).tolist()
    return max(steps)


def _straight_starts(frames: SegmentArrays) -> Array:
    """Return starts (N, 7) by straight lines through the first frames."""
    q = np.zeros((len(frames.segments), SIDESPIN + 1))
    for n, one in enumerate(frames.segments):
        rows = slice(0, min(one.frames_until(0), LINE_FRAMES))
        q[n, VELOCITY], q[n, : VELOCITY.start] = np.polyfit(one.time[rows], one.position[rows], 1)
    return q


def _speeds(q: Array) -> Array:
    return np.asarray(np.maximum(np.hypot(*q[:, VELOCITY].T), LEAST_SPEED))


def _width(setting: Setting) -> float:
    """Return the standard deviation of the prior of the sidespin, v/a."""
    return SPIN_WIDTH if setting.spin_width is None else setting.spin_width


def _starts(q: Array, slides: NDArray[np.bool_], setting: Setting) -> Starts:
    """Return scales and priors of the starts."""
    speed = _speeds(q)
    position = np.full_like(speed, POSITION_SCALE)
    scale = np.stack([position, position, *[speed] * 4, speed / setting.radius], axis=-1)
    weight, free = np.zeros(q.shape), np.ones(q.shape, bool)
    weight[:, SLIP] = (slides / (SLIP_WIDTH * speed) ** 2)[:, None]
    weight[:, SIDESPIN] = (setting.radius / (_width(setting) * speed)) ** 2
    free[:, SLIP] = slides[:, None]
    return Starts(free, weight, scale)


def _before_first_contact(
    model: TrackModel, frames: SegmentArrays, numbers: Mapping[str, float]
) -> tuple[Array, Starts]:
    """Fit starts to the frames before the first contact, and decide which balls slide there."""
    first, setting = frames.until(0), model.setting
    q, table = _straight_starts(frames), model.table(numbers)
    none = np.zeros(len(q), bool)
    rolls = settle(table, first, _starts(q, none, setting), q)
    if model.rolling_only:
        return rolls.q, _starts(rolls.q, none, setting)
    begin, tries = rolls.q.copy(), []
    for share in SLIDE_SHARES:
        begin[:, SLIP] = share * rolls.q[:, VELOCITY]
        tries.append(settle(table, first, _starts(q, ~none, setting), begin))
    slid = np.where((tries[0].cost < tries[1].cost)[:, None], tries[0].q, tries[1].q)
    cost = np.minimum(tries[0].cost, tries[1].cost)
    slides = np.array([one.slides for one in frames.segments]) | (rolls.cost - cost > SLIDE_GAIN)
    q = np.where(slides[:, None], slid, rolls.q)
    return q, _starts(q, slides, setting)


def fit_windows(
    model: TrackModel, frames: SegmentArrays, least_noise: float, tell: Callable[[float], None]
) -> SearchEnd:
    """Search once from the law's starting values: the frames before the first contact, then those before the second, and so on."""
    numbers = {name: parameter.value for name, parameter in model.free.items()}
    noise = frames.sigma
    first, starts = _before_first_contact(model, frames, numbers)
    q, most = first, max(len(one.contacts) for one in frames.segments)
    for contacts in range(1, most + 1):
        part = frames.until(contacts)
        q = _restarted(model, part, starts, q, first, numbers)
        part = _with_scatter(model, part, starts, q, numbers, noise)
        numbers, settled = descend(model, part, starts, q, numbers, partial(tell, contacts / (most + 1)), exact=False)
        q = settled.q
    return finish(model, frames, starts, q, numbers, least_noise, partial(tell, 0.95), slips=True)


def finish(
    model: TrackModel, frames: SegmentArrays, starts: Starts, q: Array, numbers: dict[str, float], least_noise: float,
    tell: Callable[[], None], slips: bool = False,
) -> SearchEnd:  # fmt: skip
    """Descend to the nearest minimum, in turn trying sidespins (and ``slips``) again and fitting all parameters."""
    noise = np.full(len(q), model.setting.noise or least_noise)
    frames, least = _with_scatter(model, frames, starts, q, numbers, noise), math.inf
    for _ in range(TURNS):  # (none of the steps raises the deviance, of which the scatters are a part)
        q = with_best_sidespins(model, frames, starts, q, numbers, slips)
        numbers, settled = descend(model, frames, starts, q, numbers, tell)
        q, deviance = settled.q, float(settled.cost.sum()) + frames.scatter_deviance
        frames = _with_scatter(model, frames, starts, q, numbers, noise)
        if not deviance < least - max(1.0, 1e-3 * float(settled.cost.sum())):
            break
        least = deviance
    return _evaluated(model, frames, starts, numbers, settle(model.table(numbers), frames, starts, q), least_noise)


def _with_scatter(
    model: TrackModel, frames: SegmentArrays, starts: Starts, q: Array, numbers: Mapping[str, float], noise: Array
) -> SegmentArrays:
    """Return frames with the scatter of each segment if no noise is given: from its residuals, at least its noise."""
    if model.setting.noise is not None:
        return frames
    gap = settle(model.table(numbers), frames, starts, q, 1).gap * frames.sigma[:, None]
    return frames.with_scatter((gap * gap).sum(axis=1), noise)


def _restarted(
    model: TrackModel, frames: SegmentArrays, starts: Starts, q: Array, first: Array, numbers: Mapping[str, float]
) -> Array:
    """Return the starts that fit these frames best: the current ones, or the first ones with any sidespin, each fitted again.

    Two contacts in one window (a corner, for example) can move a start far from that of the frames before them if the parameters
    are still inaccurate; and a sidespin fits only once the rest of the start has been adjusted to it.
    """
    table = model.table(numbers)
    so_far = settle(table, frames, starts, q)
    n, every = len(q), np.repeat(np.arange(len(q)), SIDESPINS)
    begin = first[every]
    begin[:, SIDESPIN] = _sidespins(first, model.setting).ravel()
    tried = settle(table, frames.pick(every), starts.pick(every), begin, FOLLOWING_STEPS)
    best = np.arange(n) * SIDESPINS + np.argmin(tried.cost.reshape(n, SIDESPINS), axis=1)
    return np.where((tried.cost[best] < so_far.cost)[:, None], tried.q[best], so_far.q)


def _sidespins(q: Array, setting: Setting) -> Array:
    """Return the trial sidespins (N, SIDESPINS), rad/s."""
    return np.asarray(_speeds(q)[:, None] / setting.radius * np.linspace(-1, 1, SIDESPINS) * _width(setting))


def with_best_sidespins(
    model: TrackModel, frames: SegmentArrays, starts: Starts, q: Array, numbers: Mapping[str, float], slips: bool = False
) -> Array:  # fmt: skip
    """Return starts with the sidespin that fits these frames best: the current one, or another that lowers the deviance.

    ``slips``: beside other slips, too. A ball that slides until its contact shows its slip only after it, so that the frames before
    it do not lead from one slip to another.
    """
    table = model.table(numbers)
    so_far = settle(table, frames, starts, q)
    best, cost = so_far.q.copy(), so_far.cost.copy()
    sliding = np.flatnonzero(starts.free[:, SLIP].all(axis=1))
    for share in (None, *SLIPS * (slips and len(sliding) > 0)):
        rows = np.arange(len(q)) if share is None else sliding
        begin, some = so_far.q[rows], (frames.pick(rows), starts.pick(rows))
        if share is not None:
            begin[:, SLIP] = share * begin[:, VELOCITY]
        tried = _sidespins(begin, model.setting) * (1 + slips)
        order = np.argsort(scan(table, some[0], begin, tried), axis=1)
        for k in range(BEST_SPINS if slips else 1):
            begin[:, SIDESPIN] = tried[np.arange(len(rows)), order[:, k]]
            again = settle(table, *some, begin, FOLLOWING_STEPS if slips else START_STEPS)
            better = again.cost < cost[rows]
            best[rows[better]], cost[rows[better]] = again.q[better], again.cost[better]
    return settle(table, frames, starts, best).q if slips else best


def _evaluated(
    model: TrackModel,
    frames: SegmentArrays,
    starts: Starts,
    numbers: dict[str, float],
    settled: BestStarts,
    noise: float,
) -> SearchEnd:
    """Return the fit at a place, without error bars."""
    gap = settled.gap.reshape(len(settled.q), -1, 2) * frames.sigma[:, None, None]
    gap[np.arange(gap.shape[1]) >= frames.count[:, None]] = np.nan
    k, given = len(model.free) + effective_numbers(settled, starts), model.setting.noise
    fit = TrackFit(
        model, frames, starts, settled.q, numbers, {}, np.zeros((0, 0)), gap, float(settled.cost.sum()), k,
        2 * float(frames.count.sum()) - k, given or noise, given is not None,
    )  # fmt: skip
    return SearchEnd(fit, settled)


# ----------------------------------------------------------------------------------------------------
# Fit of one law to whole tracks: searches from several frictions, continued beyond kinks, and the friction's profile.
#
# A contact that changes between sliding and sticking causes a kink in the deviance, and a search on its wrong side stays there,
# with a wrong friction for which sidespins and walls compensate. So the friction is held at other values until all else has been
# fitted, and freed if this lowers the deviance.


FREED = 6  # number of held frictions that are then freed: a narrow minimum can be higher than others at a held friction
NEW_STARTS = (0.1, 0.3)  # frictions from which the search is repeated
DISTINCT = 3.0  # error bars: frictions that fit equally well and differ by more are distinct


class _Held(NamedTuple):
    """A minimum with the friction held."""

    chi2: float
    numbers: Numbers
    q: Array


def fit_track_law(
    model: TrackModel, found: Sequence[TrackSegment], noise: float, tell: Callable[[float], None]
) -> TrackFit:
    """Fit one law to segments; ``noise`` (m) of one coordinate of one frame; ``tell`` is given the fraction done."""
    frames = SegmentArrays.of(found, model.setting.noise or noise)

    def part(turn: int, done: float) -> None:
        tell((turn + done) / (2 + len(NEW_STARTS)))

    best = fit_windows(model, frames, noise, partial(part, 0))
    if "friction" not in model.free:
        return with_errors(*best)
    parameter = model.free["friction"]
    for turn, friction in enumerate(NEW_STARTS, 1):
        if best.fit.follows:
            break
        inside = replace(parameter, value=min(max(friction, parameter.low), parameter.high))
        other = fit_windows(replace(model, free=model.free | {"friction": inside}), frames, noise, partial(part, turn))
        if other.fit.deviance < best.fit.deviance:
            best = other
    best, others = _across_kinks(model, best._replace(fit=replace(best.fit, model=model)), noise)
    if not best.fit.follows:
        end = best.fit
        last = finish(model, end.frames, end.starts, end.q, end.numbers, noise, lambda: None, slips=True)
        best = min(best, last, key=lambda one: one.fit.deviance)
    fit = with_errors(*best)
    return _with_friction_profile(fit, others) if fit.follows or fit.design_effect > 1 else fit


def _across_kinks(model: TrackModel, best: SearchEnd, noise: float) -> tuple[SearchEnd, list[tuple[Numbers, float]]]:
    """Continue the search beyond kinks. Return the best end, and other frictions, each with its chi^2, of the last round.

    Widely spread frictions are tried too, with the walls at the measured contacts: first, and again if the law does not follow the
    frames.
    """
    walls = {name: one.value for name, one in model.free.items() if name.startswith("wall_")}
    seen: list[tuple[Numbers, float]] = []

    def explore(end: SearchEnd, nearby: list[float], everywhere: list[float]) -> SearchEnd:
        best = end.fit
        held = [_hold(model, best, friction, best.numbers) for friction in nearby]
        held += [_hold(model, best, friction, best.numbers | walls) for friction in everywhere]
        freed = sorted(_other_minima(best, held) if best.follows else held, key=lambda one: one.chi2)[:FREED]
        others = [
            finish(model, best.frames, best.starts, one.q, one.numbers, noise, lambda: None, True) for one in freed
        ]
        seen[:] = [(one.numbers, one.chi2) for one in held]
        # (by deviance: each has scatters, and so a chi^2, of its own)
        seen.extend((fit.numbers, best.chi2 + fit.deviance - best.deviance) for fit, _settled in others)
        return min([end, *others], key=lambda one: one.fit.deviance)

    best = cross_kinks(
        best, lambda end: end.fit.numbers["friction"], lambda end: end.fit.deviance, explore,
        lambda end: not end.fit.follows, lambda end: end.fit.chi2,
    )  # fmt: skip
    return best, seen


def _other_minima(best: TrackFit, held: Sequence[_Held]) -> list[_Held]:
    """Return the minima with held friction that belong to a different minimum than the best.

    These are those lower than their neighbours along the friction, and the lowest of each piece of the deviance in which other
    contacts slide: between kinks it is smooth and usually has one minimum, which may be too narrow to appear along the friction.
    """
    line = sorted([_Held(best.chi2, best.numbers, best.q), *held], key=lambda one: one.numbers["friction"])
    height = np.array([math.inf, *(one.chi2 for one in line), math.inf])
    low = (height[1:-1] < height[:-2]) & (height[1:-1] <= height[2:])
    pieces: dict[object, float] = {_regimes(best): -math.inf, None: -math.inf}
    for one in line:
        piece = _regimes(replace(best, numbers=one.numbers, q=one.q))
        pieces[piece] = min(one.chi2, pieces.get(piece, math.inf))
    there = [one for one, is_low in zip(line, low, strict=True) if is_low or one.chi2 in pieces.values()]
    return [one for one in there if one.numbers is not best.numbers]


def _regimes(fit: TrackFit) -> tuple[tuple[str, ...], ...] | None:
    """Return whether the contacts of each segment slide or stick; None where a start lies in a wall."""
    try:
        return tuple(tuple(event.regime for event in fit.simulate(n).events.of("wall")) for n in range(len(fit.q)))
    except CaromError:
        return None


def _hold(model: TrackModel, best: TrackFit, friction: float, numbers: Numbers) -> _Held:
    """Return the minimum with a friction held and all else fitted."""
    parameter = model.free["friction"]
    friction = min(max(friction, parameter.low), parameter.high)
    held = model.holding("friction", friction)
    others = {name: numbers[name] for name in held.free}
    q = with_best_sidespins(held, best.frames, best.starts, best.q, others)
    others, settled = descend(held, best.frames, best.starts, q, others, lambda: None, exact=False)
    return _Held(
        float(settled.cost.sum()), {name: (others | {"friction": friction})[name] for name in model.free}, settled.q
    )


def _with_friction_profile(best: TrackFit, others: Sequence[tuple[Numbers, float]]) -> TrackFit:
    """Return the fit with the friction's error bar by profile likelihood, up to its farther end (beside a kink one side is steep),
    and without an estimate where another friction, beyond a kink, fits as well (95 %). Error bars of other parameters reach the
    values that go with each friction that fits as well.

    Where the law does not follow the frames, chi^2 counts by its design effect: at a kink the derivatives say nothing of how far a
    friction may be off.
    """
    step = best.estimates["friction"].stderr
    if not step:
        return best
    here, parameter = best.numbers["friction"], best.model.free["friction"]
    alike = [(list(one.values()), chi2 - best.chi2) for one, chi2 in others
             if chi2 < best.chi2 + LEVELS[1] and abs(one["friction"] - here) > DISTINCT * step]  # fmt: skip

    def rises(values: Array, _which: object) -> Array:
        rise, numbers = held_rises(best, "friction", values)
        rise /= best.design_effect
        near = rise < LEVELS[1] * (1 + HALF_WIDTH_CLOSE)
        alike.extend(zip(numbers[near].tolist(), rise[near].tolist(), strict=True))
        return rise

    if alike and best.follows:
        wide = ambiguous(best, "friction", dict(zip(best.names, alike[0][0], strict=True))["friction"])
    else:
        ends = parameter.low, parameter.high
        bar = max(half_width(rises, here, step, *ends, level, farther=True)[0] for level in LEVELS)
        wide = scaled(best, "friction", bar / step)
    for i, (name, estimate) in enumerate(wide.estimates.items()):
        if estimate.stderr and name != "friction":
            moved = [abs(one[i] - best.numbers[name]) / math.sqrt(max(rise, 1.0)) for one, rise in alike]
            wide = scaled(wide, name, max([estimate.stderr, *moved]) / estimate.stderr)
    return wide


# ----------------------------------------------------------------------------------------------------
# Where a law leaves the frames: its distance from them through one contact, two, and so on.


LEAST_SEGMENTS = 3  # for a median
CLOTH = 3.0  # times the noise: larger distances before any contact are the cloth's
GROWTH = 1.5  # from one number of contacts to the next, for which the contacts are to blame


def distances_through_contacts(fit: TrackFit) -> Array:
    """Return the median over segments of the RMS distance (m) up to the first contact, through one contact, two, ...

    Each start is fitted anew to the frames of its stage alone, with the shared parameters of the fit, so that no stage pays for a
    later one. Stages with fewer than LEAST_SEGMENTS segments are left out.
    """
    table, found = fit.model.table(fit.numbers), []
    for contacts in range(1 + max(len(one.contacts) for one in fit.frames.segments)):
        which = np.array([n for n, one in enumerate(fit.frames.segments) if len(one.contacts) >= contacts])
        if len(which) < LEAST_SEGMENTS:
            break
        frames, starts, q = fit.frames.until(contacts).pick(which), fit.starts.pick(which), fit.q[which]
        if contacts:
            q = with_best_sidespins(fit.model, frames, starts, q, fit.numbers)
        gap = settle(table, frames, starts, q).gap * frames.sigma[:, None]
        found.append(float(np.median(np.sqrt((gap * gap).sum(axis=1) / frames.count))))
    return np.array(found)


def failing_part(distances: Sequence[float] | Array, noise: float) -> str:
    """Return a sentence on where a law leaves the frames; empty if there are too few segments to tell.

    Examples
    --------
    >>> from carom.fitting.tracks.fit import failing_part
    >>> print(failing_part([0.0007, 0.002, 0.005], 0.0004))
    distance from the frames up to the first contact: 700 µm, through 1 contact: 2 mm, through 2: 5 mm (noise of a frame: 566 µm); \
worst described: the contacts
    """
    if not len(distances):
        return ""
    of_frame = float(np.sqrt(2.0)) * noise
    stages = [f"up to the first contact: {format_length(distances[0])}"]
    stages += [
        f"through {n}{' contact' if n == 1 else ''}: {format_length(distance)}"
        for n, distance in enumerate(distances[1:], 1)
    ]
    worst = []
    if distances[0] > CLOTH * of_frame:
        worst.append("the motion on the cloth before any contact (a slope, an obstacle that was not tracked)")
    if any(after > GROWTH * before for before, after in pairwise(distances)):
        worst.append("the contacts")
    said = f"distance from the frames {', '.join(stages)} (noise of a frame: {format_length(of_frame)})"
    return f"{said}; worst described: {', '.join(worst)}" if worst else said


# ----------------------------------------------------------------------------------------------------
# Fit laws to whole tracks and rank them: which law the tracks favour, and with what odds.


@dataclass(frozen=True, eq=False, repr=False)
class TrackRanking(RankedByShots[TrackFit]):
    """All laws fitted to whole tracks, best first, and the verdict; made by :func:`fit_tracks`, with an example there.

    If no law follows the frames to within their noise, weights are overconfident, and the verdict counts shots.
    """

    distances: Array = field(default_factory=lambda: np.zeros(0))
    """m: of the best law, up to the first contact, through one contact, two, ...; empty where it follows the frames."""

    @property
    def fits(self) -> tuple[TrackFit, ...]:
        """The fits, best first."""
        return tuple(one.fit for one in self.ranked)

    @property
    def weights(self) -> Array:
        """Their Akaike weights."""
        return np.array([one.weight for one in self.ranked])

    def as_dict(self) -> dict[str, Any]:
        """Return the ranking for JSON: numbers in full precision, None where there is none."""
        best = self.best
        return super().as_dict() | {
            "follows": best.follows,
            "closer_in": None if self.closer is None else {"shots": self.closer[0], "of": self.closer[1]},
            "chance": json_value(self.chance),
            "distance_through_contacts": self.distances.tolist(),
            "noise": best.noise,
            "noise_given": best.known,
            "tracks": [
                {
                    "shot": one.group, "ball": one.name, "since": one.since, "frames": int(best.frames.count[n]),
                    "walls": list(one.walls), "contacts": one.contacts.tolist(),
                    "slides_at_start": bool(best.starts.free[n].all()),
                    "rms": {fit.law.name: fit.rms([n]) for fit in self.fits},
                    "start": {fit.law.name: fit.start(n).tolist() for fit in self.fits},
                }
                for n, one in enumerate(best.frames.segments)
            ],
        }  # fmt: skip


def fit_tracks(
    measured: Measured, setting: Setting, laws: str | Sequence[str] | None = None, *, progress: Progress | None = None
) -> TrackRanking:
    """Fit laws to whole tracks by simulating every ball, and rank them.

    Parameters
    ----------
    measured : Measured
        Tracks with their walls and contacts (:func:`carom.tracks.measurement.measure`).
    setting : Setting
        The ball, the noise, and the extent of the simulation.
    laws : str or sequence of str, optional
        Names. Default: all laws for balls on a table.
    progress : callable(done, total, text), optional
        Called with the fraction done, 1, and the current step.

    Returns
    -------
    TrackRanking
        All laws, best first, with a verdict.

    Raises
    ------
    CaromError
        If no track can be simulated, or for an invalid setting, one line per problem.

    Examples
    --------
    >>> import carom
    >>> import numpy as np
    >>> from carom.fitting import Setting
    >>> from carom.fitting.tracks import fit_tracks
    >>> from carom.tracks import Settings, Track, measure
    >>> wall = carom.scene.Plane(point=(0, 0, 0), normal=(1, 0, 0), restitution=0.8, friction=0.2)
    >>> ball = carom.SceneBall(radius=0.03, mass=0.2, position=(0.5, 0.1), velocity=(-1.5, 0.5), rolling=True)
    >>> scene = carom.Scene(floor=carom.Floor(friction=0.2), walls=[wall], balls=[ball], run=carom.Run(duration=1))
    >>> run, t = carom.simulate(scene), np.arange(120) / 120
    >>> track = Track("ball", t, np.array([run.at(time).position[0, :2] for time in t]))
    >>> measured = measure([track], Settings(radius=0.03, view="above", noise=1e-4))
    >>> ranking = fit_tracks(measured, Setting(radius=0.03, noise=1e-4), ["two-step"])
    >>> round(ranking.best.estimates["restitution"].value, 3)
    0.8
    """
    require_library("scipy", "fit")
    if measured.view != "above":
        raise CaromError(
            "tracks: expected balls on a table, seen from above, got balls in flight; fit their rebounds instead"
        )
    require_settings(setting, whole=True)
    found, notes = find_segments(measured, setting.contacts, setting.after)
    if not found:
        raise CaromError(
            "tracks: expected a ball that is seen before and after a wall, without another contact in between, got none"
            + "".join(f"; {note}" for note in notes)
        )
    tell = step_callback(progress)
    chosen, more = track_models(
        one_or_several("fit_tracks", laws) if laws else None, setting, measured.walls, starting_numbers(measured)
    )
    fits = []
    for i, model in enumerate(chosen):

        def part(done: float, i: int = i, name: str = model.law.name) -> None:
            tell(f"fit {name}", (i + done) / len(chosen))

        part(0.0)
        fits.append(fit_track_law(model, found, measured.noise, part))
    fits.sort(key=lambda fit: fit.aicc)
    notes = [*measured.notes, *more, *notes]
    rolling = [fit.law.name for fit in fits if fit.model.rolling_only]
    if rolling and any(one.slides for one in found):
        notes.append(f"{', '.join(rolling)}: for balls that roll; balls that slide at the start were assumed to roll")
    return _ranked(fits, notes)


def _ranked(fits: list[TrackFit], notes: list[str]) -> TrackRanking:
    best = fits[0]
    poor = best.known and not best.follows
    evidence = weigh(fits, max(math.sqrt(best.chi2 / max(best.dof, 1)), 1.0) if poor else 1.0)
    compared = compared_by_shots(
        fits, evidence, lambda fit: np.array([fit.rms(one) for one in best.frames.groups]), "the tracks",
        by_odds=best.follows, before=_misfit(best),
    )  # fmt: skip
    distances = np.zeros(0) if best.follows else distances_through_contacts(best)
    if failing := failing_part(distances, best.noise):
        notes.append(f"{best.law.name}: {failing}")
    return TrackRanking(**compared, notes=tuple(notes), distances=distances)


def _misfit(best: TrackFit) -> str:
    """Return why no law fits, as the beginning of the verdict; empty if the best one follows the frames."""
    if best.follows:
        return ""
    worst = best.frames.segments[int(np.argmax(best.scatter))].label
    scatter, noise = (format_length(size) for size in (float(np.median(best.scatter)), best.noise))
    said = f"No law fits: the best, {best.law.called}, leaves {scatter} where the noise is {noise}"
    said += f", chi^2 {best.chi2:.0f} for {best.dof:.0f} degrees of freedom" if best.known else ""
    said += f", most in {worst}" if len(best.scatter) > 1 else ""
    loose = any(estimate.note == MISFIT_AS_NOISE for estimate in best.estimates.values())
    return f"{said}{'; its error bars take this as noise that is correlated from frame to frame' if loose else ''}. "
