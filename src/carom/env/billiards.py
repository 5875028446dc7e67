"""Billiards for learning: three-cushion, sum to three and eight-ball, a shot a step; many tables at once by ``simulate_many``."""

from __future__ import annotations

from abc import abstractmethod
from typing import Any, ClassVar, NamedTuple

import numpy as np
from numpy.typing import NDArray

from carom.core.motion.phases import LEFT, POCKETED
from carom.env.game import Array, Game, Mask, Played, Rows
from carom.laws.strike import strike
from carom.scene.scene import Scene
from carom.scene.toml import new_scene, replaced
from carom.simulation.records import BALL, WALL
from carom.simulation.simulate import simulate_many

EVENTS = 64  # of cushions and balls, that a shot is followed for
LONGEST = 120.0  # s: every ball rests by then
CLEAR = 2.02  # radii: of balls that are put on the table
PLAYER = {
    "speed": (0.3, 7.0),  # m/s, of the cue
    "angle": (-180.0, 180.0),  # degrees, counterclockwise from x
    "side": (-0.5, 0.5),  # radii to the right of the middle, where the tip meets the ball
    "top": (-0.5, 0.5),  # radii above it
    "elevation": (0.0, 30.0),  # degrees, of the cue's butt
}


Judged = tuple[Played, dict[str, NDArray[Any]]]  # what a shot gives, and the state of the tables after it, by name
AT_REST = {"balls.0.velocity": (0.0, 0.0, 0.0), "balls.0.rolling": False, "balls.0.spin_z": None}


class PlayedShots(NamedTuple):
    """What n shots did."""

    start: tuple[Array, Array, Array]
    """Places, NaN of balls that are gone, velocities and spins, (n, B, 3)."""
    places: Array
    """(n, B, 2), m, at the end."""
    gone: Mask
    """(n, B): pocketed, or off the table; balls that were there before."""
    t: Array
    """(n, M): of meetings with cushions and balls, in order; NaN after the last one."""
    ball: Rows
    other: Rows
    """(n, M): ball, and the other ball; -1 for a cushion."""

    def first(self, cue: Rows, other: Rows | int) -> Array:
        """Return when the cue ball first meets another one, (n,); infinity where it does not."""
        met = (self.ball == cue[:, None]) & (self.other == np.reshape(other, (-1, 1)))
        return np.asarray(np.where(met, self.t, np.inf).min(axis=1, initial=np.inf))


class BilliardGame(Game):
    """Billiards on a table by name: a step is a shot, and ends when all balls rest."""

    table: ClassVar[str]
    changes: ClassVar[dict[str, Any]] = {}
    bounds = PLAYER

    def __init__(self, count: int = 1, **settings: Any) -> None:
        super().__init__(count, **settings)
        self.scene = replaced(self.opening(), {"run.law": self.law, "run.duration": LONGEST, **self.changes, **AT_REST})
        self.names, self.ball, self.radius = self.scene.ball_names, self.scene.balls[0].ball, self.scene.balls[0].radius
        cushions: Any = self.scene.walls[0]
        self.start = np.array([ball.position[:2] for ball in self.scene.balls])
        self._scenes = [replaced(self.scene, {"balls": self.scene.balls[: k + 1]}) for k in range(len(self.names))]
        self.size = np.array([cushions.length, cushions.width]) / 2
        self.low, self.high = np.tile(-self.size, (len(self.names), 1)), np.tile(self.size, (len(self.names), 1))
        self.places = np.tile(self.start, (count, 1, 1))
        """(count, B, 2), m."""
        self.lies = np.ones((count, len(self.names)), bool)
        """(count, B): which balls are on the table."""

    def opening(self) -> Scene:
        """Return the scene of the table, with all balls where the game begins."""
        return new_scene(self.table)

    def draw(self, row: int, rng: np.random.Generator) -> None:
        """Put the balls where the game begins."""
        self.places[row], self.lies[row] = self.start, True

    def cue(self, rows: Rows) -> Rows:
        """Return the numbers of the cue balls, (n,)."""
        return np.zeros(len(rows), np.int64)

    def strokes(self, rows: Rows, actions: Array) -> Array:
        """Return speed, angle, side, top and elevation, (n, 5), of actions."""
        return self.clipped(actions)

    @abstractmethod
    def judged(self, rows: Rows, shots: PlayedShots) -> Judged:
        """Return what shots give by the rules, and the state of the tables after them, by name."""

    def play(self, rows: Rows, actions: Array) -> Played:
        """Play a shot on each of some tables."""
        shots = self.shoot(rows, actions)
        self._last = rows, *shots.start
        played, after = self.judged(rows, shots)
        for name, value in after.items():
            getattr(self, name)[rows] = value
        self.taken[rows] += 1
        return played

    def foresee(self, row: int, actions: Array) -> Played:
        """Return what each of n shots would give on a table, which stays as it is."""
        rows = np.full(len(actions), row)
        return self.judged(rows, self.shoot(rows, actions))[0]

    def observe(self, rows: Rows) -> NDArray[np.float32]:
        """Return the places of all balls, (n, B, 2), m from the middle of the table, the cue ball first."""
        return self.places[rows].astype(np.float32)

    def shoot(self, rows: Rows, actions: Array) -> PlayedShots:
        """Run shots from where the balls lie; the tables stay as they are."""
        speed, angle, side, top, elevation = self.strokes(rows, actions).T
        offset = np.stack([side, top], axis=-1)
        struck = strike(self.ball, speed=speed, azimuth_deg=angle, elevation_deg=elevation, offset=offset).state
        places, lies, here = self.places[rows], self.lies[rows], np.arange(len(rows))
        x, v, w = np.zeros((3, *lies.shape, 3))
        x[..., :2], x[..., 2] = np.where(lies[..., None], places, np.nan), self.radius
        v[here, self.cue(rows)], w[here, self.cue(rows)] = struck.velocity, struck.spin
        number, order = lies.sum(axis=1), np.argsort(~lies, axis=1, kind="stable")
        gone, t = np.zeros_like(lies), np.full((len(rows), EVENTS), np.nan)
        ball, other = np.full((2, len(rows), EVENTS), -1)
        for balls in np.unique(number).tolist():
            mine = np.flatnonzero(number == balls)
            which = order[mine, :balls]
            at = mine[:, None], which
            runs = simulate_many(self._scenes[balls - 1], v[at], w[at], x[at], events=EVENTS, kinds=("wall", "ball"))
            places[at] = np.nan_to_num(np.asarray(runs.final.position)[..., :2])
            gone[at] = np.isin(runs.code, (POCKETED, LEFT))
            met = runs.events["met"] == BALL
            seen = (runs.events["kind"] > 0) & (met | (runs.events["met"] == WALL))
            t[mine] = np.where(seen, runs.events["t"], np.nan)
            ball[mine] = np.take_along_axis(which, np.where(seen, runs.events["ball"], 0), axis=1)
            other[mine] = np.where(met, np.take_along_axis(which, np.where(met, runs.events["other"], 0), axis=1), -1)
        return PlayedShots((x, v, w), places, gone, t, ball, other)

    def put(self, places: Array, lies: Mask, ball: int, spot: Array, along: Array) -> None:
        """Put a ball on a spot, or beside it along a line where that is not free: one table's places (B, 2), which change."""
        away = np.arange(0.0, 2 * self.size[0], self.radius / 4)
        spots = spot + np.outer(np.stack([away, -away], axis=1).ravel(), along)
        spots = spots[(np.abs(spots) < self.size - 1.01 * self.radius).all(axis=1)]
        beside = lies & (np.arange(len(lies)) != ball)
        gaps = np.linalg.norm(spots[:, None] - places[beside], axis=-1).min(axis=1, initial=np.inf)
        places[ball] = spots[np.argmax(gaps > CLEAR * self.radius)]


ALONG_X, ALONG_Y = np.eye(2)
HEAD = np.array([-0.5, 0.0])  # the head spot, as a share of half the table


class ThreeCushion(BilliardGame):
    """Three-cushion billiards: a point where the cue ball meets both others, and three cushions before the second of them.

    A game has ten shots. Two players have a ball each; a point gives another shot. Observed, (6,): x, y (m) of the player's ball,
    the opponent's and the red one. ``info``: ``point``, and ``cushions`` before the second ball.
    """

    table = "carom"

    def cue(self, rows: Rows) -> Rows:
        """Return the numbers of the cue balls, (n,): white, or yellow, of the player whose turn it is."""
        return self.turn[rows]

    def observe(self, rows: Rows) -> NDArray[np.float32]:
        """Return the places (n, 3, 2) of the player's ball, the opponent's, and the red one."""
        mine = self.turn[rows, None]
        order = np.concatenate([mine, 1 - mine, np.full_like(mine, 2)], axis=1)
        return np.take_along_axis(self.places[rows], order[..., None], axis=1).astype(np.float32)

    def judged(self, rows: Rows, shots: PlayedShots) -> Judged:
        """Return points, and whose turn it is then."""
        cue = self.cue(rows)
        second = np.maximum(shots.first(cue, 1 - cue), shots.first(cue, 2))
        before = (shots.ball == cue[:, None]) & (shots.other < 0) & (shots.t < second[:, None])
        cushions = before.sum(axis=1)
        point = np.isfinite(second) & (cushions >= 3)
        return self.scored(rows, shots, point, {"point": point, "cushions": cushions})

    def scored(self, rows: Rows, shots: PlayedShots, point: Mask, info: dict[str, NDArray[Any]]) -> Judged:
        """Return what a game gives that counts points, a shot each; balls that left the table are put on their spots."""
        for k in np.flatnonzero(shots.gone.any(axis=1)).tolist():
            for ball in np.flatnonzero(shots.gone[k]).tolist():
                self.put(shots.places[k], ~shots.gone[k], ball, self.start[ball], ALONG_Y)
                shots.gone[k, ball] = False
        turn = np.where(point, self.turn[rows], (self.turn[rows] + 1) % self.players)
        ended, reward = self.taken[rows] + 1 >= self.most, point.astype(float)
        return Played(reward, ended, np.zeros_like(ended), info, reward), {"places": shots.places, "turn": turn}


class SumToThree(ThreeCushion):
    """LightZero's game: a point where the cue ball meets the other one and both together meet three cushions; ten shots.

    Table, places, ten shots, actions and the reward of a point are those of its zoo/pooltool/sum_to_three (rules:
    zoo/pooltool/README.md, whose section of results is empty; ``binary`` in envs/utils.py; table: pooltool's SUMTOTHREE_WIP).
    An action is the speed of the cue and the angle at which the ball is cut, negative on its left. Observed, (4,): x, y (m) of cue
    ball and object ball. ``info``: ``point``, ``hit``, ``cushions``.
    """

    changes: ClassVar = {"walls.0.length": 1.22, "walls.0.width": 0.61}
    bounds: ClassVar = {"speed": (0.3, 3.0), "cut": (-70.0, 70.0)}

    def opening(self) -> Scene:
        """Return a table of 1.22 by 0.61 m with two balls, a quarter of its length from the ends."""
        scene = new_scene(self.table)
        white, _yellow, red = replaced(
            scene, {f"balls.{k}.position": (0.305 * (k - 1), 0.2 * (k == 1)) for k in range(3)}
        ).balls
        return replaced(scene, {"balls": [white, red]})

    def cue(self, rows: Rows) -> Rows:
        """Return zeros: the players share the cue ball."""
        return np.zeros(len(rows), np.int64)

    def strokes(self, rows: Rows, actions: Array) -> Array:
        """Return the strokes (n, 5) that cut the object ball at an angle."""
        speed, cut = self.clipped(actions).T
        way = self.places[rows, 1] - self.places[rows, 0]
        far = np.linalg.norm(way, axis=1)
        turned = np.arcsin(np.minimum(2 * self.radius * np.sin(np.radians(cut)) / far, 1.0))
        angle = np.degrees(np.arctan2(way[:, 1], way[:, 0]) - turned)
        return np.stack([speed, angle, 0 * speed, 0 * speed, 0 * speed], axis=1)

    def observe(self, rows: Rows) -> NDArray[np.float32]:
        """Return the places (n, 2, 2) of the cue ball and the object ball."""
        return self.places[rows].astype(np.float32)

    def judged(self, rows: Rows, shots: PlayedShots) -> Judged:
        """Return points, and whose turn it is then."""
        hit = np.isfinite(shots.first(self.cue(rows), 1))
        cushions = (np.isfinite(shots.t) & (shots.other < 0)).sum(axis=1)
        point = hit & (cushions == 3)
        return self.scored(rows, shots, point, {"point": point, "hit": hit, "cushions": cushions})


FOULS = ("", "cue ball lost", "no ball hit", "wrong ball hit first", "no cushion after the hit")
BLACK = 8
KIND = np.array([0, *[1] * 7, 0, *[2] * 7])  # of balls by number


class EightBall(BilliardGame):
    """Eight-ball from the break on, by the rules of the WPA without calls.

    A ball of one's own kind gives a reward of 1 and another shot; the black one, once these are gone, wins (1 more, and the game
    ends), and before, or with a foul, loses (-1). The first balls of one kind alone decide who plays which. After a foul the cue
    ball is put on the head spot, or beside it. The black ball comes back if it falls at the break. A single player goes on after a
    miss; ``shots`` (60) cut the game. Observed, (48,): of each ball x, y (m), and 1 for one that may be hit first, 0 for others, -1
    (with x = y = 0) for those that are gone; the cue ball first, then 1 to 15.
    ``info``: ``foul`` (0, or a number of :data:`FOULS`), ``pocketed`` (balls), ``own`` (of these one's own), ``won`` (1, -1 or 0),
    ``cleared`` (won in one turn after the break).
    """

    table = "pool-9ft"
    shots = 60

    def __init__(self, count: int = 1, **settings: Any) -> None:
        super().__init__(count, **settings)
        one = np.ones((len(self.names), 1))
        self.low, self.high = np.hstack([self.low, -one]), np.hstack([self.high, one])
        self.kind = np.zeros(count, np.int64)
        """(count,): what the first player plays: 1 to 7 (1), 9 to 15 (2), not decided (0)."""
        self.missed = np.zeros(count, bool)
        """(count,): whether a turn has ended after the break."""

    def opening(self) -> Scene:
        """Return the table with its rack; ball k has the number k."""
        scene = new_scene(self.table, rack="8-ball")
        names = ["cue", *(f"{k}-ball" for k in range(1, 16))]
        balls = [ball.model_copy(update={"name": name}) for ball, name in zip(scene.balls, names, strict=True)]
        return replaced(scene, {"rack": None, "balls": balls})

    def draw(self, row: int, rng: np.random.Generator) -> None:
        """Rack the balls: black in the middle, one of each kind in the corners behind; gaps differ by up to 0.08 mm."""
        super().draw(row, rng)
        rack = np.zeros(15, np.int64)
        rack[4], rack[[10, 14]] = BLACK, rng.permutation([rng.integers(1, 8), rng.integers(9, 16)])
        rack[rack == 0] = rng.permutation([k for k in range(1, 16) if k not in rack])
        self.places[row, rack] = self.start[1:] + rng.uniform(-2.8e-5, 2.8e-5, (15, 2))
        self.places[row, 0] = self.start[0]
        self.kind[row], self.missed[row] = 0, False

    def targets(self, rows: Rows) -> Mask:
        """Return which balls (n, 16) may be hit first."""
        lies, kind = self.lies[rows], self.kind[rows]
        kind = np.where((kind > 0) & (self.turn[rows] == 1), 3 - kind, kind)[:, None]
        black = np.arange(16) == BLACK
        free = (KIND > 0) | black & (self.taken[rows, None] == 0)
        mine = lies & np.where(kind == 0, free, kind == KIND)
        return np.asarray(np.where(mine.any(axis=1, keepdims=True), mine, lies & black))

    def observe(self, rows: Rows) -> NDArray[np.float32]:
        """Return places and roles (n, 16, 3)."""
        role = np.where(self.lies[rows], self.targets(rows), -1.0)
        places = np.where(self.lies[rows][..., None], self.places[rows], 0.0)
        return np.concatenate([places, role[..., None]], axis=-1).astype(np.float32)

    def judged(self, rows: Rows, shots: PlayedShots) -> Judged:
        """Return what shots give, and the tables after them."""
        n, targets, opening, lies = np.arange(len(rows)), self.targets(rows), self.taken[rows] == 0, self.lies[rows]
        hits = np.stack([shots.first(self.cue(rows), k) for k in range(16)], axis=1)
        first, at = hits.argmin(axis=1), hits.min(axis=1)
        gone = shots.gone & lies
        down = gone.copy()
        down[:, 0] = False
        cushion = ((shots.other < 0) & (shots.t > at[:, None])).any(axis=1) | down.any(axis=1)
        foul = np.select([gone[:, 0], ~np.isfinite(at), ~targets[n, first], ~cushion], [1, 2, 3, 4], 0)
        fair = foul == 0
        # who plays what
        kinds = np.stack([(down & (k == KIND)).any(axis=1) for k in (1, 2)], axis=1)
        decided = (self.kind[rows] == 0) & ~opening & fair & (kinds.sum(axis=1) == 1)
        mine = np.where(decided, kinds.argmax(axis=1) + 1, 0)
        kind = np.where(decided, np.where(self.turn[rows] == 1, 3 - mine, mine), self.kind[rows])
        own = (down & (KIND > 0) & (opening[:, None] | targets)).sum(axis=1)
        won = np.where(down[:, BLACK] & ~opening, np.where(fair & targets[:, BLACK], 1, -1), 0)
        stays = fair & ((own > 0) | (won > 0))
        missed = self.missed[rows] | (~stays & ~opening)
        info = {"foul": foul, "pocketed": down.sum(axis=1), "own": own * fair, "won": won}
        info["cleared"] = (won > 0) & ~missed
        places, lies = shots.places, lies & ~gone
        for k in np.flatnonzero((~fair | (down[:, BLACK] & opening)) & (won == 0)).tolist():
            if not fair[k]:
                lies[k, 0] = True
                self.put(places[k], lies[k], 0, HEAD * self.size, ALONG_Y)
            if down[k, BLACK]:
                lies[k, BLACK] = True
                self.put(places[k], lies[k], BLACK, self.start[1], ALONG_X)
        turn = np.where(stays, self.turn[rows], (self.turn[rows] + 1) % self.players)
        cut = (won == 0) & (self.taken[rows] + 1 >= self.most)
        state = {"places": places, "lies": lies, "turn": turn, "kind": kind, "missed": missed}
        return Played(own * fair + won.astype(float), won != 0, cut, info, won.astype(float)), state
