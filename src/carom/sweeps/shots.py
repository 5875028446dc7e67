"""Sweeps over a scene: the runs of many scenes that differ in some numbers, each bit for bit what ``carom.simulate`` gives.

A number of a scene ends in the records that the event loop reads. Where, is found by making the scene with a few of its values: if
the records hold the number itself (friction, restitution, gravity), they are filled for all points at once; if anything else
changes with it (a wall's place, a law), the scene is made anew for every value.
"""

from __future__ import annotations

import functools
from collections.abc import Mapping
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from carom.core.jit.threads import Pace
from carom.core.motion.phases import PHASES
from carom.errors import MAX_MAGNITUDE, MIN_MAGNITUDE, CaromError, Fault, did_you_mean, shown
from carom.laws.strike import Cue, strike
from carom.scene.ball import SceneBall
from carom.scene.scene import Scene
from carom.scene.toml import PathMatch, path_match, replaced, stored_model
from carom.simulation.contact_kinds import (
    REFUSED_ENDLESS,
    REFUSED_ON_FLOOR,
    REFUSED_ROLLING,
    REFUSED_STALL,
    REFUSED_UNDEFINED,
)
from carom.simulation.loop import LIMIT, PHASES_FROM, run_limits, run_scene
from carom.simulation.records import BALL, KINDS, LOG, POCKETED_EVENT, SceneArrays, overlapping, set_up
from carom.simulation.simulate import PARTS, compiled_many, empty_counts, empty_logs
from carom.sweeps.axes import AXES, FAILURES, Axis, Outcome, blank, check_paths, plain_value, unit_of

Array = NDArray[Any]
# Fields of a ball that its initial state is made from.
START_FIELDS = ("position", "velocity", "spin", "spin_z", "strike")


def start_states(scene: Scene, columns: dict[PathMatch, Array], arrays: SceneArrays) -> NDArray[np.bool_]:
    """Write the initial states of N points into ``arrays.balls`` (N, B); return (N,) which of them a scene may refuse."""
    balls = arrays.balls
    count = len(balls)
    doubtful = np.zeros(count, bool)
    by_ball: dict[int, dict[tuple[str | int, ...], Array]] = {}
    for match, column in columns.items():
        doubtful |= _out_of_range(column)
        for _balls, i, *rest in match.places:
            by_ball.setdefault(int(i), {})[tuple(rest)] = column
    moved = False
    for i, given in by_ball.items():
        ball = scene.balls[i]
        moved |= any(keys[0] == "position" for keys in given)
        _place(ball, given, balls[:, i], doubtful)
        with np.errstate(over="ignore", invalid="ignore"):  # (of numbers out of range, which are doubtful already)
            _set_motion(ball, given, balls[:, i], doubtful)
    if moved:
        doubtful |= overlapping(SceneArrays(arrays.world[:1], arrays.features[0], balls[0], arrays.users), balls)
        places, which = np.unique(balls["x"].reshape(-1, 3), axis=0, return_inverse=True)
        blocked = np.array([any(wall.blocked(tuple(x)) for wall in scene.walls) for x in places.tolist()])
        doubtful |= blocked[which.reshape(balls.shape)].any(axis=1)
    return doubtful


def _out_of_range(column: Array) -> NDArray[np.bool_]:
    size = np.abs(column)
    good = (size == 0) | ((size >= MIN_MAGNITUDE) & (size <= MAX_MAGNITUDE))
    bad: NDArray[np.bool_] = ~good.reshape(len(column), -1).all(axis=1)
    return bad


def _vector(
    given: dict[tuple[str | int, ...], Array], name: tuple[str, ...], base: tuple[float, ...], count: int
) -> Array:
    """Return a vector (N, 3) of the points: as the ball has it, or its columns, whole or by component."""
    found = np.tile(np.array(base, dtype=float), (count, 1))
    for keys, column in given.items():
        if keys == name:
            found[:, : column.shape[1]] = column
        elif keys[:-1] == name and isinstance(keys[-1], int):
            found[:, keys[-1]] = column
    return found


def _place(ball: SceneBall, given: dict[tuple[str | int, ...], Array], rows: Array, doubtful: Array) -> None:
    if not any(keys[0] == "position" for keys in given):
        return
    x, y, *z = ball.position
    # (a scene has given z to a ball with two numbers; two numbers of a column leave it there)
    rows["x"] = _vector(given, ("position",), (x, y, *z), len(rows))
    doubtful |= rows["x"][:, 2] != ball.center[2]  # (off the floor, where not every ball can be)


def _set_motion(ball: SceneBall, given: dict[tuple[str | int, ...], Array], rows: Array, doubtful: Array) -> None:
    count = len(rows)
    names = {str(keys[0]) for keys in given}
    if "strike" in names:
        assert ball.strike is not None
        shot = ball.strike

        def number(name: str, base: float) -> Array:
            return given.get(("strike", name), np.full(count, base))

        offset = _vector(given, ("strike", "offset"), shot.offset, count)
        speed, azimuth = number("speed", shot.speed), number("azimuth", shot.azimuth)
        elevation = number("elevation", shot.elevation)
        bad = ~(speed > 0) | ~((elevation >= 0) & (elevation <= 90)) | ~(np.hypot(offset[:, 0], offset[:, 1]) < 1)
        doubtful |= bad
        good = ~bad
        if good.any():
            state = strike(
                ball.ball, Cue(**dict(shot.cue)), speed[good], azimuth[good], elevation[good], offset[good]
            ).state
            v, w = rows["v"], rows["w"]
            v[good], w[good] = state.velocity, state.spin
        return
    if not names & {"velocity", "spin", "spin_z"}:
        return
    v = _vector(given, ("velocity",), ball.velocity, count)
    if ball.rolling:  # (27)
        spin_z = given.get(("spin_z",), np.full(count, ball.spin_z or 0.0))
        w = np.stack([-v[:, 1] / ball.radius, v[:, 0] / ball.radius, spin_z], axis=1)
        doubtful |= v[:, 2] != 0
    else:
        w = _vector(given, ("spin",), ball.spin or (0.0, 0.0, 0.0), count)
        doubtful |= "spin_z" in names
    rows["v"], rows["w"] = v, w


# ----------------------------------------------------------------------------------------------------
# Sweeps over a scene: the runs of many scenes that differ in some numbers, each bit for bit what ``carom.simulate`` gives.


Columns = dict[str, Array]
REFUSED = FAILURES.index("refused")
FAILURE_OF = {REFUSED_ROLLING: 1, REFUSED_UNDEFINED: 2, REFUSED_STALL: 3, REFUSED_ON_FLOOR: 5, REFUSED_ENDLESS: 6}
FIRST_EVENTS = 1 << 16  # of all runs in the first call of the loop
# A group of fewer points is not worth finding out where its numbers end.
WORTH_PROBING = 8
# Fields of the loop's records that may be filled without making the scene anew: no shape and no place depends on them.
FILLED = {
    "world": (
        "force",
        "g",
        "floor_p",
        "floor_mu",
        "floor_beta",
        "resistance",
        "spin_friction",
        "rolling_drag",
        "spin_damping",
        "spin_drag",
        "pair_p",
        "pair_mu",
        "pair_beta",
        "pair_drop",
        "pair_rate",
    ),
    "features": ("e", "mu", "beta", "yield_time"),
    "balls": ("mass", "kappa"),
}
EVENT_KINDS = {
    **{
        name: k
        for k, name in enumerate(KINDS)
        if name not in ("start", "phase", "nothing", "in-cluster", "wall-in-cluster")
    },
    **{name: PHASES_FROM + k for k, name in enumerate(PHASES) if name not in KINDS},
}
EVENT_PARTS = {"time": "t", "ball": "ball", "met": "other", "position": "x", "velocity": "v", "spin": "w"}
UNITS = {"position": "m", "velocity": "m/s", "spin": "rad/s", "time": "s"}


class Group(NamedTuple):
    """Points whose scenes differ in nothing but what the loop's records hold."""

    scene: Scene
    rows: Array
    filled: dict[str, dict[str, Array]]
    """By path: in which places (words of 8 bytes) of which records it ends."""


class SceneRuns:
    """A sweep's subject: the runs of a scene."""

    kind = "scene"

    def __init__(self, scene: Scene) -> None:
        self.scene = scene
        self._matches: dict[str, PathMatch] = {}
        self._pace = Pace(FIRST_EVENTS)

    def describe(self) -> str:
        """Return a few words."""
        return "a scene"

    def to_data(self) -> dict[str, Any]:
        """Return the scene as plain data."""
        return {"scene": stored_model("sweep", self.scene)}

    def units(self, path: str) -> str:
        """Return the unit of a parameter."""
        return unit_of(path)

    # --- parameters ------------------------------------------------------------------------------------------------

    def check(self, parameters: Mapping[str, Axis]) -> None:
        """Raise CaromError for paths that lead nowhere or overlap, and for values that the scene refuses wherever they stand."""
        check_paths(self.scene, parameters)
        self._matches = {path: path_match(self.scene, path) for path in parameters}

    def _is_start(self, path: str) -> bool:
        """Return whether a path is of the initial state of balls."""
        return all(
            place[0] == "balls" and len(place) > 2 and place[2] in START_FIELDS and (place[2] != "strike" or len(place) > 3)
            and place[3:4] != ("cue",)
            for place in self._matches[path].places
        )  # fmt: skip

    # --- outcomes --------------------------------------------------------------------------------------------------

    def outcomes(self, names: tuple[str, ...]) -> list[Outcome]:
        """Return the outcomes of some names. CaromError with the nearest name."""
        return [self._outcome(name) for name in names]

    def _outcome(self, name: str) -> Outcome:
        balls = {"ball": self.scene.ball_names}
        vector = {"axis": AXES}
        places = [
            Outcome(f"final.{part}", "f8", balls | vector, UNITS[part]) for part in ("position", "velocity", "spin")
        ]
        final = {
            **{one.name: one for one in places},
            "final.phase": Outcome("final.phase", "i1", balls, meanings=PHASES),
            "final.pocket": Outcome("final.pocket", "i2", balls, meanings=self.scene.pocket_names),
            "final.time": Outcome("final.time", "f8", {}, "s"),
            "events.count": Outcome("events.count", "i8"),
        }  # fmt: skip
        if name in final:
            return final[name]
        known = [*final, *(f"events.{kind}.count" for kind in EVENT_KINDS)]
        match str(name).split("."):
            case ["events", kind, "count"] if kind in EVENT_KINDS:
                return Outcome(name, "i8")
            case ["events", kind, number, part] if kind in EVENT_KINDS and number.isdecimal() and part in EVENT_PARTS:
                vector = vector if part in ("position", "velocity", "spin") else {}
                return Outcome(name, "i4" if part in ("ball", "met") else "f8", vector, UNITS.get(part, "1"))
        parts = (
            f"events.KIND.count, or events.KIND.N.PART (N from 0 on; PART: {', '.join(EVENT_PARTS)};"
            f" KIND: {', '.join(EVENT_KINDS)})"
        )
        raise CaromError(
            Fault(
                "sweep", "keep", f"names among {', '.join(final)}, {parts}", shown(name, 60), did_you_mean(name, known)
            )
        )

    # --- points ----------------------------------------------------------------------------------------------------

    def evaluate(
        self, columns: Columns, outcomes: list[Outcome], first: int, seed: int, tick: Any = None
    ) -> tuple[Columns, Array]:
        """Return the outcomes of N points by name, and (N,) the codes of those without one."""
        count = len(next(iter(columns.values())))
        found = {outcome.name: blank(outcome, count) for outcome in outcomes}
        failed = np.zeros(count, np.int8)
        starts = [path for path in columns if self._is_start(path)]
        numbers = [path for path in columns if path not in starts and self._may_be_filled(path, columns[path], starts)]
        others = [path for path in columns if path not in starts and path not in numbers]
        for group in self._groups(self.scene, np.arange(count), columns, others, numbers, failed):
            self._run(group, columns, starts, outcomes, found, failed, tick)
        return found, failed

    def _may_be_filled(self, path: str, column: Array, starts: list[str]) -> bool:
        """Return whether a number may end in the loop's records as it is; not if the initial states must be made with it."""
        places = self._matches[path].places
        tied = any(place[0] == "balls" and (place[2] == "radius" or starts) for place in places)
        return column.dtype.kind == "f" and column.ndim == 1 and places[0][0] != "run" and not tied

    def _groups(
        self, scene: Scene, rows: Array, columns: Columns, others: list[str], numbers: list[str], failed: Array
    ) -> list[Group]:
        """Split points into groups whose scenes are made once."""
        if len(rows) < WORTH_PROBING:
            others, numbers = [*others, *numbers], []
        found = []
        for part in _split(rows, [columns[path] for path in others]):
            values = {path: plain_value(columns[path][part[0]]) for path in others}
            try:
                made = replaced(scene, values) if values else scene
                filled = {path: self._filled(made, path, columns[path][part]) for path in numbers}
            except CaromError:
                failed[part] = REFUSED
                continue
            again = [path for path, places in filled.items() if places is None]
            if again:
                found += self._groups(
                    made, part, columns, again, [path for path in numbers if path not in again], failed
                )
            else:
                found.append(Group(made, part, {path: places for path, places in filled.items() if places is not None}))
        return found

    def _filled(self, scene: Scene, path: str, column: Array) -> dict[str, Array] | None:
        """Return where in the loop's records a number stands as it is; None where something else changes with it."""
        probes = np.unique([column.min(), column.max(), column[len(column) // 2]])
        try:
            made = [set_up(replaced(scene, {path: float(value)})) for value in probes]
        except CaromError:
            return None
        found, base = {}, set_up(scene)
        for name in ("world", "features", "balls"):
            words = [_words(getattr(base, name))] + [_words(getattr(one, name)) for one in made]
            if len({len(one) for one in words}) > 1:
                return None
            changed = np.flatnonzero(
                np.any([one.view(np.int64) != words[0].view(np.int64) for one in words[1:]], axis=0)
            )
            if not set(changed.tolist()) <= _fillable(name, len(words[0])):
                return None
            if any((one[changed] != value).any() for one, value in zip(words[1:], probes, strict=True)):
                return None
            if len(changed):
                found[name] = changed
        return found

    def _run(
        self,
        group: Group,
        columns: Columns,
        starts: list[str],
        outcomes: list[Outcome],
        found: Columns,
        failed: Array,
        tick: Any,
    ) -> None:
        """Run the points of a group, and write their outcomes."""
        scene, rows = group.scene, group.rows
        arrays = self._arrays(group, columns)
        if starts:
            doubtful = start_states(scene, {self._matches[path]: columns[path][rows] for path in starts}, arrays)
            # (what a scene refuses is decided by the scene alone)
            bad = [k for k in np.flatnonzero(doubtful).tolist() if self._refused(columns, int(rows[k]))]
            if bad:
                failed[rows[bad]] = REFUSED
                good = np.ones(len(rows), bool)
                good[bad] = False
                world = arrays.world[good] if len(arrays.world) > 1 else arrays.world
                features = arrays.features[good] if len(arrays.features) > 1 else arrays.features
                arrays = SceneArrays(world, features, arrays.balls[good], arrays.users)
                rows = rows[good]
        if not len(rows):
            return
        until, most = run_limits(scene)
        kept = _Kept(outcomes, len(scene.balls))
        counts, firsts, ended = _run_to_ends(arrays, until, most, kept, self._pace, tick)
        for outcome in outcomes:
            found[outcome.name][rows] = kept.values(outcome, arrays.balls, counts, firsts, ended)
        for code, failure in FAILURE_OF.items():
            lost = rows[ended[:, 0] == code]
            failed[lost] = failure
            for outcome in outcomes:
                found[outcome.name][lost] = outcome.fill

    def _arrays(self, group: Group, columns: Columns) -> SceneArrays:
        """Return the records of a group's points: of the world and the features one for all where nothing in them varies."""
        base, n = set_up(group.scene), len(group.rows)
        named = {"world": base.world, "features": base.features, "balls": base.balls}
        made = {}
        for name, records in named.items():
            varies = name == "balls" or any(name in places for places in group.filled.values())
            block = np.tile(_words(records), (n if varies else 1, 1))
            for path, places in group.filled.items():
                if name in places:
                    block[:, places[name]] = columns[path][group.rows][:, None]
            shape = (len(block),) if name == "world" else (len(block), len(records))
            made[name] = (
                block.reshape(-1).view(records.dtype).reshape(shape) if len(records) else np.empty(shape, records.dtype)
            )
        return SceneArrays(made["world"], made["features"], made["balls"], base.users)

    def _values(self, columns: Columns, k: int) -> dict[str, Any]:
        return {path: plain_value(column[k]) for path, column in columns.items()}

    def _refused(self, columns: Columns, k: int) -> bool:
        try:
            replaced(self.scene, self._values(columns, k))
        except CaromError:
            return True
        return False

    def why(self, columns: Columns) -> str:
        """Return why the one point of ``columns`` has no outcome, as the scene or its run says it; empty if it has one."""
        try:
            run_scene(replaced(self.scene, self._values(columns, 0)))
        except CaromError as error:
            return str(error)
        return ""


def _words(records: Array) -> NDArray[np.float64]:
    """Return records as their words of 8 bytes."""
    return records.reshape(-1).view(np.float64)


@functools.cache
def _fillable(name: str, words: int) -> frozenset[int]:
    from carom.core.geometry.features import FEATURES
    from carom.simulation.records import BALLS, WORLD

    dtype = {"world": WORLD, "features": FEATURES, "balls": BALLS}[name]
    assert dtype.fields is not None
    one = [
        dtype.fields[field][1] // 8 + k for field in FILLED[name] for k in range(dtype.fields[field][0].itemsize // 8)
    ]
    size = dtype.itemsize // 8
    return frozenset(start + k for start in range(0, words, size) for k in one)


def _split(rows: Array, columns: list[Array]) -> list[Array]:
    """Split rows into those with the same values in all columns, in the order in which these come first."""
    if not columns:
        return [rows]
    label = np.zeros(len(rows), np.int64)
    for column in columns:
        values = column[rows].astype(str) if column.dtype.kind == "O" else column[rows]
        _unique, which = np.unique(values, axis=0, return_inverse=True)
        _unique, label = np.unique(label * (int(which.max()) + 1) + which.reshape(-1), return_inverse=True)
    order = np.argsort(label, kind="stable")
    return np.split(rows[order], np.flatnonzero(np.diff(label[order])) + 1)


class _Kept:
    """Which events the loop must count and copy for some outcomes, and what it then finds."""

    def __init__(self, outcomes: list[Outcome], balls: int) -> None:
        self.keep, wanted = 0, []
        for outcome in outcomes:
            match outcome.name.split("."):
                case ["events", kind, "count"]:
                    self.keep |= 1 << EVENT_KINDS[kind]
                case ["events", kind, number, _part]:
                    self.keep |= 1 << EVENT_KINDS[kind]
                    wanted.append((EVENT_KINDS[kind], self._row(kind, int(number))))
                case ["final", "pocket"]:
                    self.keep |= 1 << POCKETED_EVENT
                    wanted += [(POCKETED_EVENT, k) for k in range(balls)]
        self.wanted = list(dict.fromkeys(wanted))
        self.balls = balls

    def _row(self, kind: str, number: int) -> int:
        return 2 * number if EVENT_KINDS[kind] == BALL else number  # (an event of two balls has two rows)

    def values(self, outcome: Outcome, balls: Array, counts: Array, firsts: Array, ended: Array) -> Array:
        """Return an outcome (N, ...) of N runs."""
        match outcome.name.split("."):
            case ["final", "pocket"]:
                found = blank(outcome, len(balls))
                for k in range(self.balls):
                    row = firsts[:, self.wanted.index((POCKETED_EVENT, k))]
                    there = np.flatnonzero(row["kind"] == POCKETED_EVENT)
                    found[there, row["ball"][there]] = row["other"][there]
                return found
            case ["final", "time"]:
                return balls["clock"].max(axis=1)  # type: ignore[no-any-return]
            case ["final", part]:
                return balls[{"position": "x", "velocity": "v", "spin": "w", "phase": "phase"}[part]]
            case ["events", "count"]:
                return ended[:, 1]
            case ["events", kind, "count"]:
                code = EVENT_KINDS[kind]
                return counts[:, code] // (2 if code == BALL else 1)
            case ["events", kind, number, part]:
                key = EVENT_KINDS[kind], self._row(kind, int(number))
                row = firsts[:, self.wanted.index(key)]
                found = blank(outcome, len(balls))
                reached = counts[:, key[0]] > key[1]
                found[reached] = row[EVENT_PARTS[part]][reached]
                return found
        raise AssertionError(outcome.name)


def _run_to_ends(
    arrays: SceneArrays, until: float, most: int, kept: _Kept, pace: Pace, tick: Any
) -> tuple[Array, Array, Array]:
    """Run all points to their ends; return counts (N, CODES + 1), wanted events (N, W), status and number of events (N, 2)."""
    n = len(arrays.balls)
    wanted = np.array(kept.wanted, dtype=np.int64).reshape(-1, 2)
    counts, firsts = empty_counts(n), np.zeros((n, len(wanted)), LOG)
    ended, slow = np.zeros((n, 2), np.int64), np.full(n, -1.0)
    ended[:, 0] = LIMIT
    logs, run_many = empty_logs(min(PARTS, n)), compiled_many()
    goes_on = True
    while goes_on:  # (a few events of every run at a time)
        share = pace.begin()
        run_many(
            arrays.world, arrays.features, arrays.balls, logs, slow, until, most, max(share // n, 1), arrays.users, kept.keep,
            wanted, counts, firsts, ended,
        )  # fmt: skip
        goes_on = bool(((ended[:, 0] == LIMIT) & (ended[:, 1] < most)).any())
        if goes_on:  # (what ends before its share is up says nothing of how long a share takes)
            pace.done(share)
        if tick is not None:
            tick()
    return counts, firsts, ended
