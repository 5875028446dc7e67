"""Targets of a shot: a place, a pocket, balls to be hit after so many cushions; found in the logs of many runs, and in one run.

What a shot misses by is a number that varies smoothly with its start while the sequence of events stays: for a ball that is to be
hit, the impact parameter (offset of the balls' centres across their relative motion); for a pocket, the impact parameter of the
ball and the pocket's centre; for a place, the distances along x and y. The speed with which a ball comes there may be a second one.

Many runs and one run are judged by the same functions (``find``, ``residuals``, ``is_reached``): a solution that is returned is a
shot that counts as a success.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from numbers import Integral
from typing import Annotated, Any, Literal, NamedTuple

import numpy as np
from numpy.typing import NDArray
from pydantic import BeforeValidator, PlainValidator, Strict, model_validator

from carom.bodies import holds_arrays
from carom.core.motion.phases import HELD, PHASES, PIVOTING, REST
from carom.errors import CaromError, Fault, FaultList, did_you_mean, shown
from carom.scene.scene import Scene
from carom.scene.schema import Model, Number, Place, Size, refused
from carom.scene.shapes.table import Table
from carom.scene.toml import ball_index
from carom.simulation.records import BALL, IN_CLUSTER, MEETINGS, POCKETED_EVENT, WALLS

Array = NDArray[np.float64]
WHERE = "aim: reach"
EXAMPLE = "a target such as {'ball': 0, 'hit': 1}"
# Kinds of events among which targets are looked for.
EVENTS = (*WALLS, *MEETINGS, POCKETED_EVENT)
# Phases in which a ball ends at a place: in flight, in a pocket, beside the table and while it rolls it does not.
LYING = (REST, PIVOTING, HELD)


def _several(value: Any) -> tuple[Any, ...] | None:
    """Return several things as a tuple; None for one."""
    if isinstance(value, str | bytes | Mapping | Target):
        return None
    try:
        return tuple(value)
    except TypeError:  # (no sequence, or an array without axes, which says that it is one)
        return None


def _hits(value: Any) -> Any:
    """Return balls to be hit: one, or a tuple of several (``ball_index`` says of each whether it is a ball)."""
    if (several := _several(value)) is None:
        return value
    if not several:
        raise refused("a ball, or several of them", shown(value))
    return several


def _cushions(value: Any) -> int:
    if isinstance(value, bool) or not isinstance(value, Integral) or value < 0:
        raise refused("a whole number >= 0", shown(value))
    return int(value)


PositiveSpeed = Annotated[float, BeforeValidator(Number("a number > 0", "m/s", least=0, above=True))]


class Target(Model):
    """Goal of a ball: one of ``point``, ``pocket`` and ``hit``.

    Parameters
    ----------
    ball : number or name of the ball; default: 0
    point : (x, y), m, where it is to come to rest, on the table
    within : m: how far from there it may lie; default: its radius
    pocket : name of a pocket, or "any"
    hit : number or name of a ball that it is to touch, or several of them, in any order
    cushions : number of cushions that it touches before the last of them, at least; default: 0
    speed : m/s, with which it comes to the ball or the pocket; default: any
    speed_within : m/s: by how much the speed may be another; default: a tenth of it
    """

    ball: Annotated[int | str, PlainValidator(lambda value: value)] = 0
    point: Place | None = None
    within: Size | None = None
    pocket: Annotated[str, Strict()] | None = None
    hit: Annotated[int | str | tuple[int | str, ...] | None, PlainValidator(_hits)] = None
    cushions: Annotated[int, BeforeValidator(_cushions)] = 0
    speed: PositiveSpeed | None = None
    speed_within: PositiveSpeed | None = None

    @model_validator(mode="after")
    def _one_aim(self) -> Target:
        aims = {name: value for name in ("point", "pocket", "hit") if (value := getattr(self, name)) is not None}
        if len(aims) != 1:
            raise refused("one of `point`, `pocket` and `hit`", ", ".join(aims) or "none of them")
        for name, fits, expected in (
            ("within", "point" in aims, "within with point only"),
            ("cushions", "hit" in aims, "cushions with hit only"),
            ("speed", "point" not in aims, "speed with hit or pocket: at its place the ball ends at rest"),
            ("speed_within", self.speed is not None, "speed_within with speed only"),
        ):
            if getattr(self, name) and not fits:
                raise refused(expected, f"{name} = {getattr(self, name):g} with {', '.join(aims)}")
        return self


@holds_arrays
class TargetEvent(NamedTuple):
    """A target in numbers of a scene."""

    kind: Literal["point", "pocket", "hit"]
    ball: int
    others: tuple[int, ...]
    """Balls to be hit; or pockets that will do."""
    cushions: int
    point: tuple[float, float]
    windows: tuple[float, ...]
    """Greatest allowed size of each number of the residual."""
    centers: Array
    """Centres of all pockets, (P, 2)."""
    speed: float | None = None
    """With which the ball comes there, m/s."""

    @property
    def units(self) -> tuple[str, ...]:
        """Unit of each number of the residual."""
        return ("m", "m") if self.kind == "point" else ("m", "m/s")[: len(self.windows)]


def targets_of(scene: Scene, reach: Any) -> list[TargetEvent]:
    """Return targets in numbers. CaromError for balls and pockets that are not there, all at once."""
    found: list[TargetEvent] = []
    faults = FaultList()
    several = _several(reach)
    given = (reach,) if several is None else several
    for k, one in enumerate(given):
        where = WHERE if len(given) == 1 else f"{WHERE}[{k}]"
        if not isinstance(one, Target) and not (
            isinstance(one, Mapping) and all(isinstance(name, str) for name in one)
        ):
            faults.append(Fault(where, "", EXAMPLE, shown(one, 60)))
            continue
        try:
            found.append(_event_of(scene, one if isinstance(one, Target) else Target(**one), where))
        except CaromError as error:
            faults += error.records_at(where, "Target")
    if not given:
        faults.append(Fault(WHERE, "", EXAMPLE, "none"))
    faults.raise_if_any()
    return found


def _event_of(scene: Scene, target: Target, where: str) -> TargetEvent:
    ball = ball_index(scene, target.ball, f"{where}: ball")
    radius = scene.balls[ball].radius
    pockets = [pocket for wall in scene.walls for pocket in wall.pockets]
    centers = np.array([pocket.center for pocket in pockets]).reshape(-1, 2)
    point, none, speed = target.point or (0.0, 0.0), np.zeros((0, 2)), target.speed
    more = () if speed is None else (target.speed_within or speed / 10,)
    if target.point is not None:
        halves = [(wall, (wall.length / 2, wall.width / 2)) for wall in scene.walls if isinstance(wall, Table)]
        if halves and not any(np.all(np.abs(np.subtract(point, wall.center)) < half) for wall, half in halves):
            size = f"{halves[0][0].length:g} m by {halves[0][0].width:g} m around {halves[0][0].center}"
            raise CaromError(Fault(where, "point", f"a place on the table, {size}", f"{point}"))
        return TargetEvent("point", ball, (), 0, point, (target.within or radius,) * 2, none)
    if target.pocket is not None:
        wanted = [k for k, pocket in enumerate(pockets) if target.pocket in ("any", pocket.name)]
        if not wanted:
            if not pockets:
                raise CaromError(
                    f"{where}: pocket: expected a table with pockets, got a scene without; aim at a ball or a place"
                )
            names = ["any", *(pocket.name for pocket in pockets)]
            near = did_you_mean(target.pocket, names)
            raise CaromError(Fault(where, "pocket", f"one of {', '.join(names)}", shown(target.pocket, 60), near))
        width = min(pockets[k].radius for k in wanted)
        return TargetEvent("pocket", ball, tuple(wanted), 0, point, (width, *more), centers, speed)
    assert target.hit is not None
    hits = target.hit if isinstance(target.hit, tuple) else (target.hit,)
    others = tuple(ball_index(scene, one, f"{where}: hit") for one in hits)
    if len(set(others)) < len(others):
        raise CaromError(f"{where}: hit: expected each ball once, got {', '.join(scene.ball_names[k] for k in others)}")
    if ball in others:
        raise CaromError(
            f"{where}: hit: expected balls other than the one that hits them, got {scene.ball_names[ball]} itself"
        )
    width = radius + min(scene.balls[k].radius for k in others)
    return TargetEvent("hit", ball, others, target.cushions, point, (width, *more), none, speed)


# --- what runs did ----------------------------------------------------------------------------------------------------


class Outcomes(NamedTuple):
    """Outcomes of N runs, as far as targets ask for them."""

    log: NDArray[np.void]
    """(N, M): rows of walls, balls and pockets; a meeting of balls has a row for each, one after the other."""
    position: Array
    """(N, B, 3), m: where the balls are at the end."""
    phase: NDArray[np.int64]
    """(N, B): the balls' phases at the end."""

    @classmethod
    def of_run(cls, run: Any, targets: Sequence[TargetEvent]) -> Outcomes:
        """Return the outcome of one run, N = 1; where the balls are at the end only if a target asks for it."""
        log = run.log[np.isin(run.log["kind"], EVENTS)][None, :]
        if all(target.kind != "point" for target in targets):
            return cls(log, np.empty((1, 0, 3)), np.empty((1, 0), np.int64))
        phase = np.array([PHASES.index(name) for name in run.final_phase])
        return cls(log, run.final.position[None, :], phase[None, :])


def find(target: TargetEvent, log: NDArray[np.void]) -> NDArray[np.int64]:
    """Return the row (N,) of the event at which runs reach a target, for logs (N, M); -1 where none does. A place has no event."""
    count, width = log.shape
    if target.kind == "point" or width == 0:
        return np.full(count, -1)
    mine = log["ball"] == target.ball
    far = width + 1
    if target.kind == "pocket":
        there = (log["kind"] == POCKETED_EVENT) & mine & np.isin(log["other"], target.others)
        row = np.where(there.any(axis=1), there.argmax(axis=1), far)
    else:
        row = np.zeros(count, np.int64)
        for other in target.others:
            there = np.isin(log["kind"], MEETINGS) & mine & (log["other"] == other)
            if width > 1:  # (a log that is cut off between the two rows of a meeting does not have it)
                cut = log["kind"][:, -1] == BALL
                there[:, -1] &= ~cut | ((log["ball"][:, -2] == other) & (log["t"][:, -2] == log["t"][:, -1]))
            # of several balls at once it is the other one's row that says that this one touched it first
            there |= (log["kind"] == IN_CLUSTER) & (log["ball"] == other) & (log["other"] == target.ball)
            row = np.maximum(row, np.where(there.any(axis=1), there.argmax(axis=1), far))
        cushions = (np.isin(log["kind"], WALLS) & mine).cumsum(axis=1)
        before = cushions[np.arange(count), np.minimum(row, width - 1)]
        row = np.where(before >= target.cushions, row, far)
    return np.where(row < far, row, -1)


OVER = (
    "",
    "carom",
    "combination",
)  # a carom: the shot ball strikes another one before the target's; a combination: that one does
IN_LINE = 2.0  # a cushion touched within so many radii of the pocket's centre, across, is the pocket's own: no bank
MOST_CUSHIONS = 63  # that are counted
CODES = (1 << 16, len(OVER), MOST_CUSHIONS + 1, MOST_CUSHIONS + 1)  # pockets, OVER, cushions before and after


def shot_codes(target: TargetEvent, shot: int, log: NDArray[np.void], rows: NDArray[np.int64]) -> NDArray[np.int64]:
    """Return numbers (N,) of the pocket and the kind of shot by which the ball ``shot`` came to the target in ``rows`` (N,)."""
    columns, row, n = np.arange(log.shape[1]), np.maximum(rows, 0), np.arange(len(log))
    ball, other, before = log["ball"], log["other"], columns < row[:, None]
    wall, meets = np.isin(log["kind"], WALLS) & before, np.isin(log["kind"], MEETINGS) & before
    pocket = over = np.zeros(len(log), np.int64)
    kick = bank = np.zeros_like(wall)
    if target.kind == "hit":
        kick = wall & (ball == target.ball)
    else:
        pocket = other[n, row]
        apart = np.abs(log["x"][..., :2] - target.centers[pocket % len(target.centers)][:, None]).min(axis=2)
        bank = wall & (ball == target.ball)
        other_cushions = bank & (apart > IN_LINE * target.windows[0])
        last = np.where(other_cushions, columns, -1).max(axis=1, initial=-1)
        bank &= columns <= last[:, None]

    def first_meeting(k: int) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
        """Return the rows (N,) of the first meetings of ball k, and the balls that it meets there."""
        its = meets & ((ball == k) | (other == k))
        at = np.where(its.any(axis=1), its.argmax(axis=1), row)
        return at, np.where(ball[n, at] == k, other[n, at], ball[n, at])

    if target.kind == "pocket" and shot != target.ball:
        at, struck = first_meeting(shot)
        over = np.where(struck == target.ball, 0, np.where(first_meeting(target.ball)[1] == shot, 1, 2))
        kick = wall & (ball == shot) & (columns < at[:, None])
    counts = (np.minimum(one.sum(axis=1), MOST_CUSHIONS) for one in (kick, bank))
    return np.asarray(np.ravel_multi_index((pocket, over, *counts), CODES))


def shot_of(target: TargetEvent, scene: Scene, code: int) -> tuple[str, str]:
    """Return the names of a number of :func:`shot_codes`: the pocket, or the balls that are hit; and the kind of shot."""
    pocket, over, kick, bank = map(int, np.unravel_index(code, CODES))
    is_hit = target.kind == "hit"
    outcome = " and ".join(scene.ball_names[k] for k in target.others) if is_hit else scene.pocket_names[pocket]
    before = f"{kick}-cushion" if is_hit and len(target.others) > 1 else f"{kick}-cushion kick"
    parts = [OVER[over], before if kick else "", f"{bank}-cushion bank" if bank else ""]
    return outcome, ", ".join(part for part in parts if part) or "direct"


def residuals(target: TargetEvent, done: Outcomes, rows: NDArray[np.int64]) -> Array:
    """Return by what N runs miss a target, as shares of what is allowed: (N, R); infinite where they do not come to it.

    ``rows`` (N,): of the target's events. A run comes to an event where that happens, and to a place, be it near or far, where the
    ball lies at the end.
    """
    windows = np.array(target.windows)
    if target.kind == "point":
        lies = np.isin(done.phase[:, target.ball], LYING)
        apart = done.position[:, target.ball, :2] - np.array(target.point)
        return np.where(lies[:, None], apart / windows, np.inf)
    found = np.full((len(rows), len(windows)), np.inf)
    n = np.flatnonzero(rows >= 0)
    r, u, v, _own, _other = _meeting(target, done.log, n, rows[n])
    found[n, 0] = _impact_parameter(r, u)
    if target.speed is not None:
        found[n, 1] = np.hypot(v[:, 0], v[:, 1]) - target.speed
    return np.asarray(found / windows)


def sizes(target: TargetEvent, missed: Array) -> Array:
    """Return residuals (N, R) as one number each (N,): the distance from a place, the largest of others."""
    if target.kind == "point":
        return np.asarray(np.hypot(missed[:, 0], missed[:, 1]))
    return np.asarray(np.abs(missed).max(axis=1))


def is_reached(target: TargetEvent, missed: Array) -> NDArray[np.bool_]:
    """Return which of N runs with residuals (N, R) reach a target: at a place within the distance, at an event with the speed."""
    asked = missed if target.kind == "point" else missed[:, 1:]
    within = sizes(target, asked) <= 1 if asked.shape[1] else True
    return np.asarray(np.isfinite(missed[:, 0]) & within)


def slopes(target: TargetEvent, run: Any, row: int, derivatives: Any) -> Array:
    """Return the derivatives (R, p) of the residuals of a run that comes to the target; ``derivatives``: the run's sensitivity."""
    windows = np.array(target.windows)[:, None]
    if target.kind == "point":
        return np.asarray(derivatives.final.position[target.ball, :2] / windows)
    places = np.flatnonzero(np.isin(run.log["kind"], EVENTS))
    (r,), (u,), (v,), (own,), (other,) = _meeting(target, run.log[places][None, :], np.array([0]), np.array([row]))
    dx, dv = _slopes_at(run, places[own], derivatives)
    if target.kind == "pocket":
        dr, du = -dx, dv
    else:
        dy, dw = _slopes_at(run, places[other], derivatives)
        dr, du = dy - dx, dv - dw
    size, b = math.hypot(*u), float(_impact_parameter(r, u))
    cross = dr[0] * u[1] - dr[1] * u[0] + r[0] * du[1] - r[1] * du[0]
    found = [cross / size - b * (u[0] * du[0] + u[1] * du[1]) / size**2]
    if target.speed is not None:
        found.append((v[0] * dv[0] + v[1] * dv[1]) / math.hypot(*v))
    return np.asarray(np.stack(found) / windows)


def _meeting(
    target: TargetEvent, log: NDArray[np.void], n: NDArray[np.int64], rows: NDArray[np.int64]
) -> tuple[Array, Array, Array, NDArray[np.int64], NDArray[np.int64]]:
    """Return r, u, v (K, 2) just before the target's events, rows of runs ``n`` (K,), and the rows (K,) of both balls.

    r: from the ball to the ball or pocket that it meets; u: its velocity relative to it; v: its velocity.
    """
    if target.kind == "pocket":
        own = log[n, rows]
        v = own["v_before"][:, :2]
        return target.centers[own["other"]] - own["x"][:, :2], v, v, rows, rows
    theirs = log[n, rows]["ball"] != target.ball
    partner = _nearest(log, n, rows, log[n, rows]["other"])
    mine, other = np.where(theirs, partner, rows), np.where(theirs, rows, partner)
    own, met = log[n, mine], log[n, other]
    v = own["v_before"][:, :2]
    return (met["x"] - own["x"])[:, :2], v - met["v_before"][:, :2], v, mine, other


def _nearest(
    log: NDArray[np.void], n: NDArray[np.int64], rows: NDArray[np.int64], ball: NDArray[np.int64]
) -> NDArray[np.int64]:
    """Return the rows (K,) of the balls ``ball`` (K,) in the same event: the nearest ones, of two the later."""
    here = log[n]
    same = np.isin(here["kind"], MEETINGS) & (here["ball"] == ball[:, None]) & (here["t"] == log[n, rows]["t"][:, None])
    apart = np.arange(log.shape[1]) - rows[:, None]
    far = np.where(same, np.abs(2 * apart - 1), 2 * log.shape[1] + 1)
    return np.asarray(far.argmin(axis=1))


def _impact_parameter(r: Array, u: Array) -> Array:
    across, size = r[..., 0] * u[..., 1] - r[..., 1] * u[..., 0], np.hypot(u[..., 0], u[..., 1])
    return np.asarray(np.divide(across, size, out=np.zeros_like(across), where=size > 0))


def _slopes_at(run: Any, k: int, derivatives: Any) -> tuple[Array, Array]:
    """Return the derivatives (2, p) of place and velocity with which the ball of a row of the log comes to its event."""
    event = derivatives.events[k - len(run.scene.balls)]
    return event.position[:2], event.velocity_before[:2]
