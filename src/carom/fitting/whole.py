"""One law against whole tracks: each simulated from a start of its own, the table's numbers shared by all shots.

The noise of the frames as given makes the deviance chi^2; else each stretch has a scatter of its own, what the law leaves over,
so that one shot that goes astray has no more say than another. What is fitted grows from window to window: the frames before
the first contact, then those before the second, and so on, since a start that is a little off turns a hit into a miss only
later.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import partial

import numpy as np
from numpy.typing import NDArray

from carom.fitting.ways import Estimate
from carom.fitting.whole_descent import Frames, Settled, Starts, descend, scan, settle, spin_loss, used_numbers
from carom.fitting.whole_laws import GIVE, WholeLaw, WholeSetting, side_of
from carom.simulation import simulate
from carom.tracks.contacts import Wall
from carom.tracks.measure import Measured
from carom.trajectory import Trajectory

__all__ = ["WholeFit", "ended", "first_numbers", "fit_once", "sided"]

Array = NDArray[np.float64]
# chi^2 that a slide before the first contact has to earn: two numbers more, one chance in a hundred.
EARNED = 9.21
UNLIKELY, NOISY = 1e-3, 1.3  # a chi^2 that chance gives so rarely; a scatter of so many noises: the law does not follow
SIDES = 17  # sidespins that are tried
SOON = 4  # rounds in which the rest of a start follows one
TURNS = 4  # of sidespins tried anew and all numbers sought
SLIP = 1.0  # v: a slip at the start is normal about zero with this width


@dataclass(frozen=True, eq=False)
class WholeFit:
    """A law and the tracks."""

    law: WholeLaw
    frames: Frames
    starts: Starts
    q: Array
    """(N, 7): the starts, as carom.fitting.whole_follow.START, but for the sidespin, which is that at the first contact."""
    numbers: dict[str, float]
    """The shared numbers that were fitted."""
    estimates: dict[str, Estimate]
    covariance: Array
    """(P, P) of those numbers; NaN where the data do not tell them."""
    gap: Array
    """(N, T, 2) m: simulated less tracked, NaN where there is no frame."""
    chi2: float
    """Of all frames, and of what is known of the starts."""
    k: float
    """Numbers that were adjusted; of a start's number that something is known of, the share that the frames tell."""
    dof: float
    noise: float
    """m, of one coordinate: as given, or as the tracks room finds it beside the contacts."""
    known: bool
    """Whether it was given."""
    degenerate: tuple[str, ...] = ()
    untold: tuple[str, ...] = ()

    @property
    def count(self) -> int:
        """Measured numbers."""
        return int(2 * self.frames.count.sum())

    @property
    def scatter(self) -> Array:
        """(N,) m, of one coordinate: what the law leaves over in each stretch."""
        return np.asarray(np.sqrt(np.nanmean(self.gap**2, axis=(1, 2))))

    @property
    def deviance(self) -> float:
        """-2 log likelihood, but for a constant that is the same for all laws."""
        return self.chi2 if self.known else self.chi2 + 4 * float((self.frames.count * np.log(self.frames.sigma)).sum())

    @property
    def aicc(self) -> float:
        """chi^2 + 2 k with known noise; else Akaike's criterion for few data (Hurvich & Tsai 1989), the scatters counted."""
        if self.known:
            return self.deviance + 2 * self.k
        k, n = self.k + len(self.q), self.count
        return self.deviance + 2 * k + 2 * k * (k + 1) / (n - k - 1) if n > k + 1 else math.inf

    @property
    def follows(self) -> bool:
        """Whether the law follows the frames to within their noise."""
        if self.known:
            from scipy.stats import chi2 as distribution

            return bool(distribution.sf(self.chi2, max(self.dof, 1)) > UNLIKELY)
        return bool(np.median(self.scatter) < NOISY * self.noise)

    def rms(self, which: Sequence[int] | None = None) -> float:
        """Root mean square distance of tracked and simulated places, m; of some stretches."""
        gap = self.gap if which is None else self.gap[list(which)]
        return float(np.sqrt(np.nansum(gap * gap) / max(int(np.isfinite(gap[:, :, 0]).sum()), 1)))

    def start(self, n: int) -> Array:
        """(7,): the start of a stretch (carom.fitting.whole_follow.START)."""
        start: Array = self.q[n].copy()
        start[6] += np.sign(start[6]) * spin_loss(self.law.scene(self.numbers)) * self.frames.stretches[n].contacts[0]
        return start

    def simulate(self, n: int) -> Trajectory:
        """The run of a stretch."""
        x, y, vx, vy, ux, uy, spin_z = self.start(n).tolist()
        a = self.law.setting.radius
        scene = self.law.scene(self.numbers, float(self.frames.time[n, self.frames.count[n] - 1]))
        moved = {"position": (x, y, a), "velocity": (vx, vy, 0.0), "spin": ((uy - vy) / a, (vx - ux) / a, spin_z)}
        return simulate(scene.model_copy(update={"balls": (scene.balls[0].model_copy(update=moved),)}))


def first_numbers(measured: Measured) -> dict[str, float]:
    """Numbers to begin with; give_SIDE: how far from there a wall is sought, where that is not GIVE (m)."""
    start = {}
    for name, label in (("floor_friction", "cloth friction"), ("rolling_resistance", "rolling resistance")):
        if label in measured.floor:
            start[name] = measured.floor[label][0]
    ratio = [
        one.fit["vn_out"] / -one.fit["vn_in"]
        for one in measured.contacts
        if one.fit is not None and one.fit["vn_in"] < -0.2
    ]
    if ratio:
        start["restitution"] = float(np.median(ratio))
    for wall in measured.walls:
        away = [one.fit["away"] for one in measured.contacts if one.fit is not None and one.wall.name == wall.name]
        axis = int(abs(wall.normal[1]) > 0.5)
        if away:  # where the motions before and after meet: the frames themselves turn up to a step before it
            start[f"wall_{side_of(wall)}"] = wall.point[axis] + wall.normal[axis] * float(np.median(away))
        elif max(map(abs, wall.normal)) > 1 - 1e-9:
            # met in a corner, say: it may lie as far beyond the frames as the ball goes from one to the next
            far = _step_at(measured, wall)
            start[f"wall_{side_of(wall)}"] = wall.point[axis] - wall.normal[axis] * far / 2
            start[f"give_{side_of(wall)}"] = GIVE + far / 2
    return start


def _step_at(measured: Measured, wall: Wall) -> float:
    """How far (m) across a wall the balls go from frame to frame where they meet it, at most."""
    steps = [0.0]
    for track in measured.tracks:
        d = wall.frame(track.position)[:, 0]
        for event in measured.events[track.group, track.name]:
            if event.kind == "wall" and event.what == wall.name:
                at = int(np.searchsorted(track.time, (event.low + event.high) / 2))
                steps += np.abs(np.diff(d[max(at - 3, 0) : at + 3])).tolist()
    return max(steps)


def _lines(frames: Frames) -> Array:
    """Starts (N, 7) by straight lines through the first frames."""
    q = np.zeros((len(frames.stretches), 7))
    for n, one in enumerate(frames.stretches):
        rows = slice(0, min(one.frames_until(0), 8))
        line = np.polyfit(one.time[rows], one.position[rows], 1)
        q[n, 2:4], q[n, :2] = line[0], line[1]
    return q


def _starts(q: Array, slides: NDArray[np.bool_], setting: WholeSetting) -> Starts:
    speed = np.maximum(np.hypot(q[:, 2], q[:, 3]), 0.1)
    ones = np.ones_like(speed)
    scale = np.stack([1e-2 * ones, 1e-2 * ones, *[speed] * 4, speed / setting.radius], axis=-1)
    weight = np.zeros((len(q), 7))
    weight[:, 4:6] = (slides / (SLIP * speed) ** 2)[:, None]
    weight[:, 6] = (setting.radius / (setting.spin_width * speed)) ** 2
    free = np.ones((len(q), 7), bool)
    free[:, 4:6] = slides[:, None]
    return Starts(free, weight, scale)


def _before(law: WholeLaw, frames: Frames, numbers: Mapping[str, float]) -> tuple[Array, Starts]:
    """Starts from the frames before the first contact; whether a ball slides there."""
    first, setting = frames.until(0), law.setting
    q = _lines(frames)
    scene = law.scene(numbers)
    none = np.zeros(len(q), bool)
    rolling = _starts(q, none, setting)
    rolls = settle(scene, first, rolling, q)
    if law.rolls:
        return rolls.q, _starts(rolls.q, none, setting)
    sliding = _starts(q, ~none, setting)
    begin = rolls.q.copy()
    tries = []
    for share in (0.15, 0.7):  # a little left, or all of it
        begin[:, 4:6] = share * rolls.q[:, 2:4]
        tries.append(settle(scene, first, sliding, begin))
    best = np.where(tries[0].cost < tries[1].cost, 0, 1)
    slid = np.array([tries[b].q[n] for n, b in enumerate(best)])
    cost = np.minimum(tries[0].cost, tries[1].cost)
    just = np.array([one.slides for one in frames.stretches])
    slides = just | (rolls.cost - cost > EARNED)
    q = np.where(slides[:, None], slid, rolls.q)
    return q, _starts(q, slides, setting)


def fit_once(law: WholeLaw, frames: Frames, least_noise: float, tell: Callable[[float], None]) -> WholeFit:
    """One search, from the law's starts: the frames before the first contact, then those before the second, and so on."""
    numbers = {name: parameter.start for name, parameter in law.free.items()}
    noise = frames.sigma
    first, starts = _before(law, frames, numbers)
    q = first
    most = max(len(one.contacts) for one in frames.stretches)
    for contacts in range(1, most + 1):
        part = frames.until(contacts)
        q = _begun_anew(law, part, starts, q, first, numbers)
        part = _scattered(law, part, starts, q, numbers, noise)
        numbers, settled = descend(law, part, starts, q, numbers, partial(tell, contacts / (most + 1)), exact=False)
        q = settled.q
    return ended(law, frames, starts, q, numbers, least_noise, partial(tell, 0.95))


def ended(
    law: WholeLaw, frames: Frames, starts: Starts, q: Array, numbers: dict[str, float], least_noise: float, tell: Callable[[], None]
) -> WholeFit:  # fmt: skip
    """Down to the best place from here, sidespins tried anew and all numbers sought by turns."""
    noise = np.full(len(q), law.setting.noise or least_noise)
    least = math.inf
    for _ in range(TURNS):
        q = sided(law, frames, starts, q, numbers)
        frames = _scattered(law, frames, starts, q, numbers, noise)
        numbers, settled = descend(law, frames, starts, q, numbers, tell)
        q = settled.q
        frames = _scattered(law, frames, starts, q, numbers, noise)
        deviance = _deviance(settled, frames)
        if not deviance < least - max(1.0, 1e-4 * abs(least)):
            break
        least = deviance
    return told(law, frames, starts, numbers, settle(law.scene(numbers), frames, starts, q), least_noise)


def _deviance(settled: Settled, frames: Frames) -> float:
    return float(settled.cost.sum() + (4 * frames.count * np.log(frames.sigma)).sum())


def _scattered(
    law: WholeLaw,
    frames: Frames,
    starts: Starts,
    q: Array,
    numbers: Mapping[str, float],
    noise: Array,
) -> Frames:
    """With the scatter of each stretch, where no noise is given: what the law leaves over, never less than its frames have."""
    if law.setting.noise is not None:
        return frames
    gap = settle(law.scene(numbers), frames, starts, q, 0).gap * frames.sigma[:, None]
    scatter = np.sqrt((gap * gap).sum(axis=1) / np.maximum(2 * frames.count - 7, 1))
    return replace(frames, sigma=np.maximum(scatter, noise))


def _begun_anew(
    law: WholeLaw, frames: Frames, starts: Starts, q: Array, first: Array, numbers: Mapping[str, float]
) -> Array:  # fmt: skip
    """Starts that these frames like best: those so far, or from the first ones with any sidespin, each brought to its own place.

    Two contacts in one window (a corner, say) bend a start far from what the frames before them tell, where those so far were
    sought with numbers that are not yet right; and a sidespin shows what it is good for when the rest of the start has followed it.
    """
    scene = law.scene(numbers)
    so_far = settle(scene, frames, starts, q)
    n, every = len(q), np.repeat(np.arange(len(q)), SIDES)
    begin = first[every]
    begin[:, 6] = _sidespins(first, law.setting).ravel()
    tried = settle(scene, frames.pick(every), starts.pick(every), begin, SOON)
    best = np.arange(n) * SIDES + np.argmin(tried.cost.reshape(n, SIDES), axis=1)
    return np.where((tried.cost[best] < so_far.cost)[:, None], tried.q[best], so_far.q)


def _sidespins(q: Array, setting: WholeSetting) -> Array:
    """(N, SIDES) rad/s that are tried."""
    speed = np.maximum(np.hypot(q[:, 2], q[:, 3]), 0.1)
    return np.asarray(speed[:, None] / setting.radius * np.linspace(-1, 1, SIDES) * setting.spin_width)


def sided(law: WholeLaw, frames: Frames, starts: Starts, q: Array, numbers: Mapping[str, float]) -> Array:
    """Starts with the sidespin that these frames like best: the one so far, or another where that leads nearer."""
    scene = law.scene(numbers)
    so_far = settle(scene, frames, starts, q)
    tried = _sidespins(so_far.q, law.setting)
    costs = scan(scene, frames, so_far.q, tried)
    other = so_far.q.copy()
    other[:, 6] = tried[np.arange(len(q)), np.argmin(costs, axis=1)]
    again = settle(scene, frames, starts, other)
    return np.where((again.cost < so_far.cost)[:, None], again.q, so_far.q)


def told(
    law: WholeLaw, frames: Frames, starts: Starts, numbers: dict[str, float], settled: Settled, noise: float
) -> WholeFit:
    """The fit with its error bars, and what the tracks do not tell."""
    from carom.fitting.whole_told import with_errors

    used = used_numbers(settled, starts)
    gap = settled.gap.reshape(len(settled.q), -1, 2) * frames.sigma[:, None, None]
    gap[np.arange(gap.shape[1]) >= frames.count[:, None]] = np.nan
    k = len(law.free) + used
    given = law.setting.noise
    fit = WholeFit(
        law, frames, starts, settled.q, numbers, {}, np.zeros((0, 0)), gap, float(settled.cost.sum()), k,
        2 * float(frames.count.sum()) - k, given or noise, given is not None,
    )  # fmt: skip
    return with_errors(fit, settled)
