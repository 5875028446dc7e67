"""The model of whole tracks: segments, their least-squares objective, one law's result and its covariance."""

from __future__ import annotations

import functools
import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import pairwise
from typing import Any

import numpy as np
from numpy.typing import NDArray

from carom.errors import CaromError
from carom.fitting.evidence import UNLIKELY, akaike
from carom.fitting.identify import NOT_IDENTIFIABLE, identify, parameter_ranges
from carom.fitting.laws import FORMS, PARAMETERS, FittedLaw, Parameter, track_laws_named
from carom.fitting.result import Estimate, common_dict, without_estimate
from carom.fitting.rows import Setting, assumed_height, decided, forms_of, require_settings
from carom.fitting.table_numbers import (
    Projection,
    SharedNumber,
    StatesBy,
    TableNumbers,
    affine_table,
    balls_by,
    balls_of,
    covariance_by_shot,
    cushions_between,
    descend_shared,
    nearest_starts,
    states_by,
)
from carom.formatting import json_value
from carom.public.defaults import LIKE_SOLIDS
from carom.scene.ball import SceneBall
from carom.scene.floor import Floor
from carom.scene.restitution import Constant
from carom.scene.scene import Run, Scene
from carom.simulation.records import SceneArrays
from carom.simulation.sensitivity.sensitivity import states_at
from carom.simulation.simulate import simulate
from carom.simulation.trajectory import Trajectory
from carom.tracks.events import TrackEvent, WallLine
from carom.tracks.measurement import Measured
from carom.tracks.plausibility import unlisted_turns
from carom.tracks.track import Track

FAR = 100.0  # m: distance of sides of the table that no ball of the film meets
ON_WALL = ("friction", "tangential_restitution", "stiffness_ratio")
WALL_RANGE = 0.01  # m about the turning point of the frames, within which a cushion is searched for
SPIN_LOSS = 10.0  # rad/s^2 of spin about the vertical; Alciatore has 5 to 15
START_MARGIN = 0.02  # of a parameter's range, between its bounds and its start
START_VALUES = {
    "friction": 0.2, "tangential_restitution": 0.0, "stiffness_ratio": LIKE_SOLIDS, "restitution_1": 0.0, "restitution_2": 0.0,
}  # fmt: skip
_NAMED = {parameter.name: parameter for parameter in PARAMETERS}
# Parameters of the floor; the same friction acts while a cushion presses the ball on the cloth.
FLOOR = (
    replace(_NAMED["floor_friction"], low=0.01, value=0.2, meaning="of the cloth"),
    Parameter("rolling_resistance", 0.0, 0.1, (0.007,), 0.007, meaning="deceleration / g of a rolling ball"),
    Parameter(
        "spin_loss", 0.0, 200.0, (SPIN_LOSS,), SPIN_LOSS, "rad/s^2", "of the spin about the vertical", origin="setting"
    ),
)


@dataclass(frozen=True, eq=False)
class TrackModel:
    """A law, the parameters that all tracks share, and the table."""

    law: FittedLaw
    setting: Setting
    walls: tuple[WallLine, ...]
    free: dict[str, Parameter]
    held: dict[str, float]
    """Parameters that are not fitted."""
    start: TableNumbers | None = None
    """The table of :meth:`scene` where the search begins, by parameter, also of parameters that are held later on."""

    @property
    def rolling_only(self) -> bool:
        """Whether the law is about balls that roll before the wall."""
        return self.law.engine is not None and self.law.engine.rolling_only

    def holding(self, name: str, value: float) -> TrackModel:
        """Return the model with one parameter held."""
        free = {other: one for other, one in self.free.items() if other != name}
        return replace(self, free=free, held=self.held | {name: value})

    def table(self, numbers: Mapping[str, float]) -> TableNumbers:
        """Return the arrays of the scene, and their derivatives."""
        assert self.start is not None
        at = {**self.held, **numbers}
        return self.start.at(np.array([at[one.name] for one in self.start.shared]))

    def scene(self, numbers: Mapping[str, float]) -> Scene:
        """Return the table with one ball in its middle."""
        at, given, engine = {**self.held, **numbers}, self.setting, self.law.engine
        assert engine is not None
        a = given.radius
        nose = None if self.law.upright or given.contact_height == 1 else (given.contact_height or 1.0) * a
        lines = {"left": -FAR, "right": FAR, "bottom": -FAR, "top": FAR}
        lines |= {side: at[f"wall_{side}"] for side in map(side_of, self.walls)}
        smooth = self.law.frictionless
        table = cushions_between(
            lines, a, nose, stiffness_ratio=at["stiffness_ratio"],
            restitution=_form(given.restitution if "restitution" in self.law.free else "constant", at) if engine.surface else None,
            friction=None if not engine.surface else 0.0 if smooth else at["friction"],
            tangential_restitution=0.0 if smooth or not engine.surface else at["tangential_restitution"],
        )  # fmt: skip
        floor = Floor(
            friction=at["floor_friction"], restitution=Constant(value=given.floor_restitution),
            rolling_resistance=at["rolling_resistance"], spin_friction=given.kappa * a * at["spin_loss"] / given.gravity,
        )  # fmt: skip
        return Scene(
            gravity=(0.0, 0.0, -given.gravity), floor=floor, walls=(table,),
            balls=(SceneBall(radius=a, mass=1.0, inertia=given.kappa, position=table.center),),
            run=Run(law=engine.law, floor_contact=engine.floor_contact),
        )  # fmt: skip


def side_of(wall: WallLine) -> str:
    """Return which side of a table a wall along an axis is: left, right, bottom or top."""
    return {(1, 0): "left", (-1, 0): "right", (0, 1): "bottom", (0, -1): "top"}[
        round(wall.normal[0]), round(wall.normal[1])
    ]


def _form(name: str, at: Mapping[str, float]) -> Any:
    """Return the scene's form of restitution, from the parameters of a fit."""
    least = 1e-12 if name == "viscoelastic" else -math.inf  # (a scene has no form without dissipation)
    return FORMS[name].for_scene(name, [max(at[one.name], least) for one in FORMS[name].parameters])


def track_models(
    names: Sequence[str] | None, setting: Setting, walls: Sequence[WallLine], start: Mapping[str, float]
) -> tuple[list[TrackModel], list[str]]:
    """Return the laws to fit, and notes. ``start``: initial values of parameters, as far as known."""
    require_settings(setting, whole=True)
    odd = [wall.name for wall in walls if max(abs(wall.normal[0]), abs(wall.normal[1])) < 1 - 1e-9]
    sides = [side_of(wall) for wall in walls if wall.name not in odd]
    faults = [f"wall {name}: expected walls along the axes for whole tracks, got one that is tilted" for name in odd]
    faults += [
        f"walls: expected one {side} wall, got {sides.count(side)}"
        for side in dict.fromkeys(sides)
        if sides.count(side) > 1
    ]
    if faults:
        raise CaromError(*faults)
    notes = assumed_height("table", setting)
    setting = setting.with_height()
    chosen, more = track_laws_named(names, setting.contact_height == 1.0)
    return [_model(law, setting, walls, start) for law in chosen], [*notes, *more]


def _model(law: FittedLaw, setting: Setting, walls: Sequence[WallLine], start: Mapping[str, float]) -> TrackModel:
    form = forms_of(law, setting).get("restitution", FORMS["constant"]).parameters
    known = [*form, *(_NAMED[name] for name in ON_WALL), *FLOOR]
    if setting.floor_friction is not None:
        known[-len(FLOOR)] = replace(FLOOR[0], value=setting.floor_friction, origin="setting")
    for wall in walls:
        side = side_of(wall)
        at = start.get(f"wall_{side}", wall.point[0 if side in ("left", "right") else 1])
        far = start.get(f"range_{side}", WALL_RANGE)
        meaning = "position at which the ball's centre is reflected"
        known.append(Parameter(f"wall_{side}", at - far, at + far, (at,), at, "m", meaning))
    also = [one.name for one in known[len(form) + len(ON_WALL) :] if not one.origin or one.name in setting.fit]
    every = decided(law, setting, known, also)
    free = {name: _begun(one, start) for name, one in every.items() if one.free}
    model = TrackModel(
        law, setting, tuple(walls), free, {name: one.value for name, one in every.items() if not one.free}
    )
    shared = tuple(SharedNumber(name, one.value, one.low, one.high, one.high - one.low) for name, one in free.items())
    return replace(model, start=affine_table(model.scene, shared))


def _begun(one: Parameter, start: Mapping[str, float]) -> Parameter:
    """Return a free parameter with the value from which its search begins, off its bounds."""
    at = start.get(one.name, START_VALUES.get(one.name, one.tried[len(one.tried) // 2]))
    inside = START_MARGIN * (one.high - one.low)
    return replace(one, value=float(np.clip(at, one.low + inside, one.high - inside)))


# ----------------------------------------------------------------------------------------------------
# Segments of tracks that are simulated: one ball, from where it runs freely until it meets another ball.


Array = NDArray[np.float64]
FRAMES_BEFORE, FRAMES_AFTER = 4, 5  # at least
CLEARANCE = 0.004  # m from every wall, where a simulation starts
MIN_SPEED = 0.1  # m/s at the start
# Events after which a ball may slide; after others this is determined from the frames
SLIDING_STARTS = ("onset", "ball", "wall", "turn")


@dataclass(frozen=True, eq=False)
class TrackSegment:
    """A ball's path through some contacts with walls, without other events."""

    group: str
    name: str
    time: Array
    """(n,) s since its first frame."""
    since: float
    """s: the first frame's time in the track."""
    position: Array
    """(n, 2) m."""
    contacts: Array
    """(c,) s since the first frame, as :mod:`carom.tracks` measured them."""
    walls: tuple[str, ...]
    """(c,) their names."""
    slides: bool
    """Whether it has just been set in motion, so that it may slide."""

    @property
    def label(self) -> str:
        """Shot and ball."""
        return " ".join(filter(None, (self.group, self.name)))

    def frames_until(self, contacts: int) -> int:
        """Return the number of frames before the contact that follows the first ``contacts`` ones."""
        every = contacts >= len(self.contacts)
        return len(self.time) if every else int(np.searchsorted(self.time, self.contacts[contacts]))


def find_segments(measured: Measured, most: int, after: float = np.inf) -> tuple[list[TrackSegment], list[str]]:
    """Return all segments with a contact, and notes on those omitted.

    A bounce away from the walls ends a segment, as a contact with a ball does: often it is one that the tracker did not show.
    """
    found: list[TrackSegment] = []
    lost: dict[str, int] = {}
    times = _contact_times(measured)
    for track in measured.tracks:
        events = measured.events[track.group, track.name]
        turns, step = unlisted_turns([track], measured.events, measured.interval), measured.interval
        edges = [replace(turn, low=turn.low - step, high=turn.high + step) for turn in turns]
        edges += [event for event in events if event.kind != "wall"]
        edges.sort(key=lambda event: (event.low, event.high))
        for first, last in pairwise(edges):
            inner = [
                event for event in events if event.kind == "wall" and first.high <= event.low and event.high <= last.low
            ]
            inner.sort(key=lambda event: event.low)
            one, why = _segment(track, first, last, inner, measured, times, most, after)
            if one is not None:
                found.append(one)
            elif why:
                lost[why] = lost.get(why, 0) + 1
    return found, [f"{count} segment{'s' if count > 1 else ''} omitted: {why}" for why, count in lost.items()]


def _contact_times(measured: Measured) -> dict[tuple[str, str, float], float]:
    """Return the measured times of contacts, by the beginning of their event."""
    found = {}
    for one in measured.contacts:
        for event in measured.events[one.group, one.track]:
            if event.kind == "wall" and event.what == one.wall.name and event.low <= one.time <= event.high:
                found[one.group, one.track, event.low] = one.time
    return found


def _segment(
    track: Track, first: TrackEvent, last: TrackEvent, inner: list[TrackEvent], measured: Measured,
    times: dict[tuple[str, str, float], float], most: int, seconds: float,
) -> tuple[TrackSegment | None, str]:  # fmt: skip
    """Return the frames from one event to another, through the walls between them; or why they cannot be used."""
    low, kind, high = first.high, first.kind, last.low
    while inner:
        before = int(((track.time >= low) & (track.time < inner[0].low - measured.blind[0])).sum())
        if before >= FRAMES_BEFORE:
            break
        low, kind = inner[0].high + measured.blind[1], "wall"  # too few for its velocity: it starts after that wall
        inner = inner[1:]
    if not inner:
        return None, ""
    if len(inner) > most:
        high = inner[most].low
        inner = inner[:most]
    middles = np.array([times.get((track.group, track.name, e.low), (e.low + e.high) / 2) for e in inner])
    use = (track.time >= low) & (track.time <= min(high, middles[-1] + seconds))
    for t in middles:
        use &= (track.time < t - measured.blind[0]) | (track.time > t + measured.blind[1])
    for wall in measured.walls:
        d = wall.frame(track.position)[:, 0]
        if wall.clamped:
            use &= d > 1e-6
    rows = _clear(track, np.flatnonzero(use), measured.walls, measured.noise)
    after = int((track.time[rows] > middles[0]).sum())
    if len(rows) - after < FRAMES_BEFORE or after < FRAMES_AFTER:
        return None, f"fewer than {FRAMES_BEFORE} frames before or {FRAMES_AFTER} after the first contact"
    t, x = track.time[rows], track.position[rows]
    speed = np.hypot(*(x[3] - x[0])) / (t[3] - t[0])
    if speed < MIN_SPEED:
        return None, f"slower than {MIN_SPEED} m/s at the start"
    met = tuple(e.what for e in inner)
    return (
        TrackSegment(track.group, track.name, t - t[0], float(t[0]), x, middles - t[0], met, kind in SLIDING_STARTS),
        "",
    )


def _clear(track: Track, rows: NDArray[np.intp], walls: Sequence[WallLine], noise: float) -> NDArray[np.intp]:
    """Drop first frames that are so near a wall that the start might lie behind it."""
    for k, row in enumerate(rows.tolist()):
        if all(wall.frame(track.position[row : row + 1])[0, 0] > CLEARANCE + 6 * noise for wall in walls):
            return rows[k:]
    return rows[:0]


# ----------------------------------------------------------------------------------------------------
# Least-squares objective of whole tracks: parameters that all segments share, and a separate start for each segment.
#
# A start affects only its own segment, so for given shared parameters the starts are fitted separately, all segments in one call of
# the engine with its exact derivatives, and the shared parameters minimise the remainder (:mod:`carom.fitting.table_numbers`).


Numbers = dict[str, float]
UNDEFINED_DISTANCE = 0.5  # m between frame and ball where the law is undefined
START_TOLERANCE, START_STEPS, NEXT_STEPS = 1e-3, 30, 9  # of chi^2; steps from anywhere, and from nearby parameters
SHARED_TOLERANCE, ROUGH_TOLERANCE = 1e-2, 1e-3  # of chi^2; of its value
SHARED_STEPS, ROUGH_STEPS = 60, 12
START = ("x", "y", "v_x", "v_y", "u_x", "u_y", "spin_z")
"""The numbers of a start: position (m), velocity (m/s), slip on the floor (m/s), sidespin (rad/s)."""
K = len(START)
SCATTER_ROUNDS = 40  # until the scatters of segments and their common scale agree
VELOCITY, SLIP, SIDESPIN = slice(2, 4), slice(4, 6), START.index("spin_z")  # parts of a start


@dataclass(frozen=True, eq=False)
class SegmentArrays:
    """Segments as arrays, padded to the longest."""

    segments: tuple[TrackSegment, ...]
    time: Array
    """(N, T) s."""
    position: Array
    """(N, T, 2) m."""
    count: NDArray[np.int64]
    """(N,) frames that count."""
    sigma: Array
    """(N,) m, of one coordinate of one frame."""

    @classmethod
    def of(cls, segments: Sequence[TrackSegment], sigma: float) -> SegmentArrays:
        """Return all frames."""
        count = np.array([len(one.time) for one in segments], dtype=np.int64)
        time, position = np.zeros((len(count), count.max())), np.zeros((len(count), count.max(), 2))
        for n, one in enumerate(segments):
            time[n, : count[n]], position[n, : count[n]] = one.time, one.position
        return cls(tuple(segments), time, position, count, np.full(len(count), sigma))

    def until(self, contacts: int) -> SegmentArrays:
        """Return only those before the contact after so many."""
        count = np.array([one.frames_until(contacts) for one in self.segments], dtype=np.int64)
        time, position = self.time[:, : count.max()].copy(), self.position[:, : count.max()].copy()
        return replace(self, time=time, position=position, count=count)

    def pick(self, which: NDArray[np.int64]) -> SegmentArrays:
        """Return only those segments."""
        arrays = {name: getattr(self, name)[which] for name in ("time", "position", "count", "sigma")}
        return SegmentArrays(tuple(self.segments[i] for i in which.tolist()), **arrays)

    @property
    def freedom(self) -> Array:
        """(N,) degrees of freedom: measured numbers less those of a start."""
        return np.asarray(np.maximum(2.0 * self.count - K, 1.0))

    def with_scatter(self, squares: Array, noise: Array) -> SegmentArrays:
        """Return these with the most likely scatters, from sums of squares of residuals (N,), m^2; each is at least its noise.

        Deviations of a law are alike from frame to frame, so that a segment says less of its scatter than its frames are many: the
        scatters have a common prior, scaled inverse chi^2 (Gelman et al., Bayesian Data Analysis, section 2.6), with as many
        degrees of freedom as a segment has on average, and with the most likely scale. (With none, a fit comes to follow whichever
        shot it is nearest to, since that shot's weight grows as it does so.)
        """
        m, prior = self.freedom, self.freedom.mean()
        common = float(np.median(squares / m))
        for _ in range(SCATTER_ROUNDS):
            variance = np.maximum((squares + prior * common) / (m + prior), noise**2)
            common = 1 / np.mean(1 / variance)
        return replace(self, sigma=np.sqrt(variance))

    @property
    def scatter_deviance(self) -> float:
        """The scatters' part of the deviance, -2 log of their normalisation and prior, up to a constant."""
        variance, prior = self.sigma**2, self.freedom.mean()
        of_prior = prior * math.log(1 / np.mean(1 / variance))
        return float(((self.freedom + prior) * np.log(variance) - of_prior).sum())

    def gap(self, places: Array) -> Array:
        """Return simulated less tracked positions (N, 2 T), in standard deviations; 0 where there is no frame."""
        inside = (np.arange(self.time.shape[1]) < self.count[:, None])[:, :, None]
        gap = (
            np.where(np.isnan(places), UNDEFINED_DISTANCE, places - self.position) * inside / self.sigma[:, None, None]
        )
        return np.asarray(gap.reshape(len(gap), -1))

    @property
    def groups(self) -> list[NDArray[np.int64]]:
        """Segments of each shot."""
        names = np.array([one.group or one.name for one in self.segments])
        return [np.flatnonzero(names == name) for name in dict.fromkeys(names.tolist())]


@dataclass(frozen=True, eq=False)
class Starts:
    """The numbers of the starts: which are free, their prior, their scales. (N, 7) each."""

    free: NDArray[np.bool_]
    weight: Array
    """1 / variance of a normal prior about zero; 0: none."""
    scale: Array

    def pick(self, which: NDArray[np.int64]) -> Starts:
        """Return only those segments."""
        return Starts(self.free[which], self.weight[which], self.scale[which])

    @property
    def prior(self) -> Array:
        """(N, 7, 7): times a start, a normal prior of unit width."""
        return np.asarray(np.sqrt(self.weight)[:, :, None] * np.eye(K))


@dataclass(frozen=True, eq=False)
class BestStarts:
    """The best starts for given parameters."""

    q: Array
    """(N, 7)"""
    gap: Array
    """(N, 2 T)"""
    slope: Array
    """(N, 2 T, 7) derivative of the gaps in the starts; 0 in a number that is held."""
    cost: Array
    """(N,) sum of squares, with the prior."""

    def residual(self, starts: Starts) -> Array:
        """Return gaps and prior (N, 2 T + 7)."""
        return np.concatenate([self.gap, np.sqrt(starts.weight) * self.q], axis=1)

    def projection(self, starts: Starts) -> Projection:
        """Return the projection of derivatives of these residuals. (A held number follows nothing: its prior is its own.)"""
        own = starts.prior + ~starts.free[:, :, None] * np.eye(K)
        return Projection.of(np.concatenate([self.slope, own], axis=1))


def _on_table(setup: SceneArrays, frames: SegmentArrays, q: Array) -> tuple[NDArray[np.void], Array]:
    """Return the balls (N, 1) of q (N, 7), whose sidespin is that at the first contact, and their derivatives.

    The spin at the start is larger, by the loss on the cloth until then: a ball that had less than this loss arrives without
    sidespin, so within a range no residual depends on the spin at the start, and a search would not converge.
    """
    start, by = q.copy(), balls_by_start(float(setup.balls["radius"][0]))
    start[:, SIDESPIN] += np.sign(q[:, SIDESPIN]) * spin_loss(setup) * _first_contacts(frames)
    return balls_of(setup, by, start), by


def balls_by_start(radius: float) -> Array:
    """Return the derivatives of a ball by START. (The slip is u = v + w x (-a z) = (v_x - a w_y, v_y + a w_x).)"""
    place = [[(0, "x", 0, 1.0)], [(0, "x", 1, 1.0)]]
    velocity = [[(0, "v", 0, 1.0), (0, "w", 1, 1 / radius)], [(0, "v", 1, 1.0), (0, "w", 0, -1 / radius)]]
    slip = [[(0, "w", 1, -1 / radius)], [(0, "w", 0, 1 / radius)]]
    return balls_by(1, [*place, *velocity, *slip, [(0, "w", 2, 1.0)]])


def _first_contacts(frames: SegmentArrays) -> Array:
    return np.array([one.contacts[0] for one in frames.segments])


def spin_loss(setup: SceneArrays) -> float:
    """Return the rate at which the cloth reduces the spin about the vertical, rad/s^2."""
    world, ball = setup.world[0], setup.balls[0]
    return float(world["spin_friction"] * world["g"] / (ball["kappa"] * ball["radius"]))


def gaps(table: TableNumbers, frames: SegmentArrays, q: Array) -> Array:
    """Return the gaps (N, 2 T) of starts (N, 7)."""
    balls, _by = _on_table(table.arrays, frames, q)
    return frames.gap(states_at(table.arrays, balls, frames.time, frames.count, 2)[:, :, 0])


def _states(table: TableNumbers, frames: SegmentArrays, q: Array, shared: bool = False) -> StatesBy:
    """Return the states of starts (N, 7) at the frames, and the derivatives of their places."""
    balls, by = _on_table(table.arrays, frames, q)
    return states_by(table, balls, by, frames.time, frames.count, shared=shared)


def _by_frame(slope: Array, frames: SegmentArrays) -> Array:
    """Return derivatives (N, T, 1, 2, P) of places as those of gaps (N, 2 T, P)."""
    return np.asarray(slope.reshape(len(slope), -1, slope.shape[-1]) / frames.sigma[:, None, None])


def settle(
    table: TableNumbers, frames: SegmentArrays, starts: Starts, q: Array, steps: int = START_STEPS
) -> BestStarts:
    """Find the starts whose simulations are nearest to the frames, descending from q (N, 7). ``steps`` 1: evaluate only at q."""
    width = 2 * frames.time.shape[1]
    gap, slope = np.zeros((len(q), width)), np.zeros((len(q), width, K))

    def residual(which: NDArray[np.int64], at: Array, derivatives: bool) -> tuple[Array, Array | None]:
        some = frames.pick(which)
        if not derivatives:
            return gaps(table, some, at), None
        found = _states(table, some, at)
        gap[which] = some.gap(found.states[:, :, 0, :2])
        slope[which] = _by_frame(found.by_start, some) * starts.free[which][:, None]
        return gap[which], slope[which]

    best, found = nearest_starts(
        residual, q, np.where(starts.free, starts.scale, 0.0), np.zeros_like(q), starts.prior, steps=steps,
        tolerance=START_TOLERANCE, dof=np.asarray(2.0 * frames.count, dtype=np.float64), joint=False,
    )  # fmt: skip
    return BestStarts(best, gap, slope, found.value)


def scan(table: TableNumbers, frames: SegmentArrays, q: Array, tried: Array) -> Array:
    """Return sums of squares (N, M) with M sidespins (N, M) instead of the starts' own."""
    n, m = tried.shape
    every = np.repeat(np.arange(n), m)
    starts = q[every]
    starts[:, SIDESPIN] = tried.ravel()
    return np.asarray(np.square(gaps(table, frames.pick(every), starts)).sum(axis=-1).reshape(n, m))


def shared_slope(model: TrackModel, frames: SegmentArrays, q: Array, numbers: Mapping[str, float]) -> Array:
    """Return the derivative (N, 2 T, P) of the gaps in the shared parameters, with the starts held."""
    table = model.table(numbers)
    names, found = [one.name for one in table.shared], _states(table, frames, q, shared=True)
    slope = _by_frame(found.by_shared, frames)
    if "spin_loss" in names:  # (which the sidespin at the start follows)
        turned = np.sign(q[:, SIDESPIN]) * _first_contacts(frames)
        slope[..., names.index("spin_loss")] += _by_frame(found.by_start, frames)[..., SIDESPIN] * turned[:, None]
    return slope[..., [names.index(name) for name in model.free]]


def projected(settled: BestStarts, starts: Starts, by_shared: Array) -> Array:
    """Return the derivatives (N, 2 T + 7, P) of gaps and prior in the shared parameters with the starts refitted."""
    prior = np.zeros((len(by_shared), K, by_shared.shape[-1]))
    return settled.projection(starts).rest(np.concatenate([by_shared, prior], axis=1))


def effective_numbers(settled: BestStarts, starts: Starts) -> float:
    """Return the effective number of parameters of the starts: the share of the frames in their information."""
    return float(np.square(settled.projection(starts).basis[:, :-K]).sum())


@dataclass(eq=False)
class _Segments:
    """Segments whose starts follow the shared parameters."""

    model: TrackModel
    frames: SegmentArrays
    starts: Starts
    q: Array
    """(N, 7): the best so far."""
    tell: Callable[[], None]
    steps: int = START_STEPS

    def numbers(self, values: Array) -> Numbers:
        return dict(zip(self.model.free, values.tolist(), strict=True))

    def tried(self, values: Array) -> tuple[float, BestStarts]:
        settled = settle(self.model.table(self.numbers(values)), self.frames, self.starts, self.q, self.steps)
        self.tell()
        return float(settled.cost.sum()), settled

    def taken(self, values: Array, tried: BestStarts) -> tuple[float, Array, Array]:
        self.q, self.steps = tried.q, NEXT_STEPS
        by_shared = shared_slope(self.model, self.frames, tried.q, self.numbers(values))
        rest = projected(tried, self.starts, by_shared)
        score = -np.einsum("ntp,nt->p", rest, tried.residual(self.starts))
        return float(tried.cost.sum()), score, np.einsum("ntp,ntr->pr", rest, rest)


def descend(
    model: TrackModel, frames: SegmentArrays, starts: Starts, q: Array, numbers: Mapping[str, float], tell: Callable[[], None],
    exact: bool = True,
) -> tuple[Numbers, BestStarts]:  # fmt: skip
    """Find the best shared parameters, and the starts that go with them."""
    if not model.free:
        return {}, settle(model.table(numbers), frames, starts, q)
    segments, dof = _Segments(model, frames, starts, q, tell), 2.0 * float(frames.count.sum())
    low, high = (np.array([getattr(one, end) for one in model.free.values()]) for end in ("low", "high"))
    values = descend_shared(
        segments, np.clip([numbers[name] for name in model.free], low, high), low, high, dof=dof,
        steps=SHARED_STEPS if exact else ROUGH_STEPS, tolerance=SHARED_TOLERANCE if exact else ROUGH_TOLERANCE * dof,
    )  # fmt: skip
    best = segments.numbers(values)
    return best, settle(model.table(best), frames, starts, segments.q)


# ----------------------------------------------------------------------------------------------------
# Result of one law fitted to whole tracks.


# Largest ratio of scatter to estimated noise, in the median segment, for a law that follows the frames
MAX_SCATTER = 1.3


@dataclass(frozen=True, eq=False)
class TrackFit:
    """A law fitted to whole tracks; made by :func:`carom.fitting.tracks.fit_tracks`, with an example there."""

    model: TrackModel
    frames: SegmentArrays
    starts: Starts
    q: Array
    """(N, 7): the starts (carom.fitting.tracks.model.START), but with the sidespin at the first contact."""
    numbers: dict[str, float]
    """The shared parameters that were fitted."""
    estimates: dict[str, Estimate]
    covariance: Array
    """(P, P) of those parameters; NaN where they are not identifiable."""
    gap: Array
    """(N, T, 2) m: simulated less tracked, NaN where there is no frame."""
    chi2: float
    """chi^2 of all frames, and of the prior of the starts."""
    k: float
    """Effective number of fitted parameters; of a start's parameter with a prior, the share determined by the frames."""
    dof: float
    noise: float
    """Standard deviation of one coordinate, m: as given, or as estimated by :mod:`carom.tracks` away from contacts."""
    known: bool
    """Whether the noise was given."""
    degenerate: tuple[str, ...] = ()
    """Sentences on parameters that are not identifiable from these tracks."""
    untold: tuple[str, ...] = ()
    """The parameters concerned."""
    design_effect: float = 1.0
    """Variance of the parameters over that for independent frames, by the scatter of shots; 1 where the law follows the frames."""

    @property
    def law(self) -> FittedLaw:
        """The law."""
        return self.model.law

    @property
    def names(self) -> tuple[str, ...]:
        """Names of the fitted parameters."""
        return tuple(self.model.free)

    @property
    def count(self) -> int:
        """Measured numbers."""
        return int(2 * self.frames.count.sum())

    @property
    def scatter(self) -> Array:
        """(N,) m, of one coordinate: root mean square residual of each segment."""
        return np.asarray(np.sqrt(np.nanmean(self.gap**2, axis=(1, 2))))

    @property
    def deviance(self) -> float:
        """-2 log likelihood, up to a constant that is the same for all laws."""
        return self.chi2 if self.known else self.chi2 + self.frames.scatter_deviance

    @property
    def aicc(self) -> float:
        """chi^2 + 2 k with known noise; else Akaike's criterion for few data (Hurvich & Tsai 1989), with the scatters counted."""
        if self.known:
            return self.deviance + 2 * self.k
        return akaike(self.deviance, self.k + len(self.q), self.count)

    @property
    def follows(self) -> bool:
        """Whether the law follows the frames to within their noise."""
        if self.known:
            from scipy.stats import chi2 as distribution

            return bool(distribution.sf(self.chi2, max(self.dof, 1)) > UNLIKELY)
        return bool(np.median(self.scatter) < MAX_SCATTER * self.noise)

    def rms(self, which: Sequence[int] | NDArray[np.int64] | None = None) -> float:
        """Return the root mean square distance between tracked and simulated positions, m; of some segments."""
        gap = self.gap if which is None else self.gap[np.asarray(which)]
        return float(np.sqrt(np.nansum(gap * gap) / max(int(np.isfinite(gap[:, :, 0]).sum()), 1)))

    @property
    def median_rms(self) -> float:
        """Median over the segments of the root mean square distance, m."""
        return float(np.median([self.rms([n]) for n in range(len(self.q))]))

    def start(self, n: int) -> Array:
        """Return the start (7,) of a segment (carom.fitting.tracks.model.START)."""
        start: Array = self.q[n].copy()
        loss = spin_loss(self.model.table(self.numbers).arrays) * self.frames.segments[n].contacts[0]
        start[SIDESPIN] += np.sign(start[SIDESPIN]) * loss
        return start

    def simulate(self, n: int) -> Trajectory:
        """Return the simulated run of a segment."""
        x, y, vx, vy, ux, uy, spin_z = self.start(n).tolist()
        a = self.model.setting.radius
        scene = self._table
        run = scene.run.model_copy(update={"duration": float(self.frames.time[n, self.frames.count[n] - 1])})
        moved = {"position": (x, y, a), "velocity": (vx, vy, 0.0), "spin": ((uy - vy) / a, (vx - ux) / a, spin_z)}
        return simulate(scene.model_copy(update={"run": run, "balls": (scene.balls[0].model_copy(update=moved),)}))

    @functools.cached_property
    def _table(self) -> Scene:
        """The scene of all segments, without its end."""
        return self.model.scene(self.numbers)

    def as_dict(self) -> dict[str, Any]:
        """Return the fit for JSON."""
        return common_dict(self) | {
            "numbers_adjusted": self.k,
            "rms": self.rms(),
            "median_rms": self.median_rms,
            "held": json_value(self.model.held),
        }


# ----------------------------------------------------------------------------------------------------
# Covariance of the shared parameters of whole tracks, and what the tracks do not identify.


MISFIT_AS_NOISE = "the law does not follow the frames; error bar as if their distances were correlated noise"
LEAST_SHOTS = 5  # for error bars from the scatter of shots
FOLLOWING_STEPS = 5  # of the starts after a parameter has been changed


def misfit_as_noise(gap: Array, count: NDArray[np.int64], dof: float) -> float:
    """Return by how much variances grow if the gaps (N, 2 T), in standard deviations, are noise that fades from frame to frame.

    With the correlation r of neighbours a mean has (1 + r) / (1 - r) times the variance that independent frames would give it, at
    most that of one free number a segment; ``count`` (N,): frames of each.
    """
    steps = gap.reshape(len(gap), -1, 2)
    r = max(float((steps[:, 1:] * steps[:, :-1]).sum()) / max(float((gap * gap).sum()), 1e-300), 0.0)
    length = min((1 + r) / max(1 - r, 1e-9), float(count.mean()))
    return float(max((gap * gap).sum() / max(dof, 1.0) * length, 1.0))


class _Subject:
    """A fit of whole tracks, for :func:`carom.fitting.identify.identify`.

    If the law follows the frames, the covariance is computed from derivatives and the noise, with all starts free. If not,
    residuals are correlated from frame to frame; only shots are independent, and the covariance is computed from the scores of
    shots, each corrected for how much of the information is its own (CR2 of Bell & McCaffrey, Survey Methodology 28, 169 (2002));
    of fewer than five shots their segments are taken as independent, and of fewer than five segments the covariance is enlarged as
    by noise of this size and correlation.
    The design effect is the median over the parameters of this variance over the variance of independent frames.
    """

    def __init__(self, fit: TrackFit, settled: BestStarts) -> None:
        self.fit, self.label, self.names, self.trade_offs = fit, fit.law.name, fit.names, False
        self.parameters = tuple(fit.model.free.values())
        self.values = np.array([fit.numbers[name] for name in self.names])
        self.ranges = parameter_ranges(self.parameters, self.values)
        rest = projected(settled, fit.starts, shared_slope(fit.model, fit.frames, settled.q, fit.numbers))
        by_segment = np.einsum("ntp,ntq->npq", rest, rest)
        self.information = by_segment.sum(axis=0)
        each = np.einsum("ntp,nt->np", rest, settled.residual(fit.starts))
        # (of few shots the balls: each has walls of its own)
        groups = fit.frames.groups
        groups = groups if len(groups) >= LEAST_SHOTS else [np.array([n]) for n in range(len(each))]
        self.scores = np.array([each[rows].sum(axis=0) for rows in groups])
        self.by_shot = np.array([by_segment[rows].sum(axis=0) for rows in groups])
        self.by_shots, self.design_effect = False, 1.0
        self.misfit = misfit_as_noise(settled.gap, fit.frames.count, fit.dof)

    def covariance(self, inside: NDArray[np.int64]) -> Array:
        """Return the covariance of some parameters."""
        independent = np.linalg.inv(self.information[np.ix_(inside, inside)])
        self.by_shots = not self.fit.follows and len(self.scores) >= LEAST_SHOTS
        if not self.by_shots:
            if not self.fit.follows:
                self.design_effect = self.misfit
            return np.asarray(self.design_effect * independent)
        both = np.ix_(inside, inside)
        by_shot = np.array([one[both] for one in self.by_shot])
        found = covariance_by_shot(self.information[both], self.scores[:, inside], by_shot)
        self.design_effect = float(max(np.median(np.diag(found) / np.diag(independent)), 1.0))
        return found

    def rise(self, i: int, value: float) -> float:
        """Return the deviance above its minimum with one shared parameter changed and the starts fitted again."""
        fit = self.fit
        table = fit.model.table({**fit.numbers, self.names[i]: value})
        return float(settle(table, fit.frames, fit.starts, fit.q, FOLLOWING_STEPS).cost.sum()) - fit.chi2

    def refit_rises(self, i: int, values: Array, start: Array | None = None) -> tuple[Array, Array]:
        """Return the profile above its minimum, and the shared parameters there."""
        return held_rises(self.fit, self.names[i], values, start)


def held_rises(fit: TrackFit, name: str, values: Array, start: Array | None = None) -> tuple[Array, Array]:
    """Return the rise of chi^2 (m,) with a parameter held at values (m,) and all else fitted, from the minimum or from parameters
    ``start`` (m, P), and the parameters (m, P) there."""
    rises, found = [], []
    for j, value in enumerate(values.tolist()):
        begin = fit.numbers if start is None else fit.numbers | dict(zip(fit.names, start[j].tolist(), strict=True))
        numbers, settled = descend(fit.model.holding(name, value), fit.frames, fit.starts, fit.q, begin, lambda: None)
        rises.append(float(settled.cost.sum()) - fit.chi2)
        found.append([(numbers | {name: value})[other] for other in fit.names])
    return np.array(rises), np.array(found)


def with_errors(fit: TrackFit, settled: BestStarts) -> TrackFit:
    """Return the fit with covariance, estimates, and sentences on parameters that are not identifiable."""
    if not fit.names:
        return fit
    subject = _Subject(fit, settled)
    found = identify(subject)
    note: dict[str, Any] = {} if fit.follows or subject.by_shots else {"note": MISFIT_AS_NOISE}
    estimates = {name: one if one.stderr is None else replace(one, **note) for name, one in found.estimates.items()}
    return replace(fit, **{**vars(found), "estimates": estimates}, design_effect=subject.design_effect)


def ambiguous(fit: TrackFit, name: str, other: float) -> TrackFit:
    """Return the fit without an estimate of a parameter for which two values fit equally well."""
    here = fit.numbers[name]
    said = (
        f"{fit.law.name}: {name}: {min(here, other):.4g} and {max(here, other):.4g} fit equally well: a contact is at the edge"
        " between sliding and sticking; film another shot"
    )
    found: TrackFit = without_estimate(fit, name, Estimate(None, None, NOT_IDENTIFIABLE), said)
    return found
