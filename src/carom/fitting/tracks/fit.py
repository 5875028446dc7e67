"""Fit of one law to whole tracks from its starting values, in growing windows: one search.

With given noise of the frames the deviance is chi^2; else the scatter of each segment is estimated from its residuals, so that one
deviating shot has no more weight than others. The fitted frames are extended from window to window: those before the first contact,
then those before the second, and so on, because a small error of a start has large effects only later.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import replace
from functools import partial
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from carom.fitting.setting import Setting
from carom.fitting.tracks.model import WALL_RANGE, TrackModel, side_of
from carom.fitting.tracks.objective import (
    SIDESPIN,
    SLIP,
    VELOCITY,
    BestStarts,
    SegmentArrays,
    Starts,
    descend,
    effective_numbers,
    scan,
    settle,
)
from carom.fitting.tracks.result import TrackFit
from carom.tracks.events import WallLine
from carom.tracks.measurement import Measured

__all__ = ["SearchEnd", "finish", "fit_windows", "starting_numbers", "with_best_sidespins"]

Array = NDArray[np.float64]
SLIDE_GAIN = (
    9.21  # decrease of chi^2 for which a slide before the first contact is accepted: two more parameters, 1 % by chance
)
SLIDE_SHARES = (0.15, 0.7)  # of full slip at the start: a small part of it, or most of it
SIDESPINS = 17  # number of sidespins that are tried
FOLLOWING_STEPS = 5  # of the rest of a start after a sidespin has been changed
TURNS = 4  # rounds in which sidespins are tried again and all parameters are fitted
SPIN_WIDTH, SLIP_WIDTH = (
    1.25,
    1.0,
)  # v/a and v: sidespin, where no width is given, and slip at the start are normal about zero
POSITION_SCALE, LEAST_SPEED = 1e-2, 0.1  # m, m/s
LINE_FRAMES = 8
FAST = 0.2  # m/s towards a wall: slower contacts do not determine the restitution


class SearchEnd(NamedTuple):
    """Where one search has ended. Error bars cost as much as the search; only the best end is given them."""

    fit: TrackFit
    """Without error bars (:func:`carom.fitting.tracks.errors.with_errors`)."""
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
    return finish(model, frames, starts, q, numbers, least_noise, partial(tell, 0.95))


def finish(
    model: TrackModel, frames: SegmentArrays, starts: Starts, q: Array, numbers: dict[str, float], least_noise: float,
    tell: Callable[[], None],
) -> SearchEnd:  # fmt: skip
    """Descend to the nearest minimum, in turn trying sidespins again and fitting all parameters."""
    noise = np.full(len(q), model.setting.noise or least_noise)
    least = math.inf
    for _ in range(TURNS):
        q = with_best_sidespins(model, frames, starts, q, numbers)
        frames = _with_scatter(model, frames, starts, q, numbers, noise)
        numbers, settled = descend(model, frames, starts, q, numbers, tell)
        q = settled.q
        frames = _with_scatter(model, frames, starts, q, numbers, noise)
        deviance = float(settled.cost.sum() + (4 * frames.count * np.log(frames.sigma)).sum())
        if not deviance < least - max(1.0, 1e-4 * abs(least)):
            break
        least = deviance
    return _evaluated(model, frames, starts, numbers, settle(model.table(numbers), frames, starts, q), least_noise)


def _with_scatter(
    model: TrackModel, frames: SegmentArrays, starts: Starts, q: Array, numbers: Mapping[str, float], noise: Array
) -> SegmentArrays:
    """Return frames with the scatter of each segment if no noise is given: from its residuals, at least its noise and the median.

    (With smaller scatters the fit comes to follow whichever shot it is nearest to, since that shot's weight grows as it does so.)
    """
    if model.setting.noise is not None:
        return frames
    gap = settle(model.table(numbers), frames, starts, q, 1).gap * frames.sigma[:, None]
    scatter = np.sqrt((gap * gap).sum(axis=1) / np.maximum(2 * frames.count - q.shape[1], 1))
    return replace(frames, sigma=np.maximum(scatter, np.maximum(noise, np.median(scatter))))


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
    model: TrackModel, frames: SegmentArrays, starts: Starts, q: Array, numbers: Mapping[str, float]
) -> Array:
    """Return starts with the sidespin that fits these frames best: the current one, or another that lowers the deviance."""
    table = model.table(numbers)
    so_far = settle(table, frames, starts, q)
    tried = _sidespins(so_far.q, model.setting)
    other = so_far.q.copy()
    other[:, SIDESPIN] = tried[np.arange(len(q)), np.argmin(scan(table, frames, so_far.q, tried), axis=1)]
    again = settle(table, frames, starts, other)
    return np.where((again.cost < so_far.cost)[:, None], again.q, so_far.q)


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
