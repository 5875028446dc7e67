"""Laws for whole tracks: the parameters that all tracks share, and the scene in which a ball is simulated."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import pairwise
from typing import Any

import numpy as np
from numpy.typing import NDArray

from carom.errors import CaromError
from carom.fitting.laws import FORMS, PARAMETERS, FittedLaw, Parameter, track_laws_named
from carom.fitting.rows import Setting, assumed_height, decided, forms_of, require_settings
from carom.fitting.table_numbers import SharedNumber, TableNumbers, affine_table, cushions_between
from carom.public.defaults import LIKE_SOLIDS
from carom.scene.ball import SceneBall
from carom.scene.floor import Floor
from carom.scene.restitution import Constant
from carom.scene.scene import Run, Scene
from carom.tracks.events import TrackEvent, WallLine
from carom.tracks.measurement import Measured
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
SLIDING_STARTS = ("onset", "ball", "wall")


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
    ends: str
    """Cause of its end: ball, gap, end, another contact."""

    @property
    def label(self) -> str:
        """Shot and ball."""
        return " ".join(filter(None, (self.group, self.name)))

    def frames_until(self, contacts: int) -> int:
        """Return the number of frames before the contact that follows the first ``contacts`` ones."""
        every = contacts >= len(self.contacts)
        return len(self.time) if every else int(np.searchsorted(self.time, self.contacts[contacts]))


def find_segments(measured: Measured, cushions: int, after: float = np.inf) -> tuple[list[TrackSegment], list[str]]:
    """Return all segments with a contact, and notes on those omitted."""
    found: list[TrackSegment] = []
    lost: dict[str, int] = {}
    times = _contact_times(measured)
    for track in measured.tracks:
        events = measured.events[track.group, track.name]
        edges = [event for event in events if event.kind != "wall"]
        edges.sort(key=lambda event: (event.low, event.high))
        for first, last in pairwise(edges):
            inner = [
                event for event in events if event.kind == "wall" and first.high <= event.low and event.high <= last.low
            ]
            inner.sort(key=lambda event: event.low)
            one, why = _segment(track, first, last, inner, measured, times, cushions, after)
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
    times: dict[tuple[str, str, float], float], cushions: int, seconds: float,
) -> tuple[TrackSegment | None, str]:  # fmt: skip
    """Return the frames from one event to another, through the walls between them; or why they cannot be used."""
    low, kind, ends = first.high, first.kind, last.kind
    high = last.low
    while inner:
        before = int(((track.time >= low) & (track.time < inner[0].low - measured.blind[0])).sum())
        if before >= FRAMES_BEFORE:
            break
        low, kind = inner[0].high + measured.blind[1], "wall"  # too few for its velocity: it starts after that wall
        inner = inner[1:]
    if not inner:
        return None, ""
    if len(inner) > cushions:
        high, ends = inner[cushions].low, "another contact"
        inner = inner[:cushions]
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
        TrackSegment(
            track.group, track.name, t - t[0], float(t[0]), x, middles - t[0], met, kind in SLIDING_STARTS, ends
        ),
        "",
    )


def _clear(track: Track, rows: NDArray[np.intp], walls: Sequence[WallLine], noise: float) -> NDArray[np.intp]:
    """Drop first frames that are so near a wall that the start might lie behind it."""
    for k, row in enumerate(rows.tolist()):
        if all(wall.frame(track.position[row : row + 1])[0, 0] > CLEARANCE + 6 * noise for wall in walls):
            return rows[k:]
    return rows[:0]
