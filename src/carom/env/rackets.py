"""Air hockey and the return of a table tennis ball, for learning; many tables at once by ``simulate_many``."""

from __future__ import annotations

from pathlib import Path
from typing import Any, ClassVar

import numpy as np
from numpy.typing import NDArray

from carom.bodies import State, Surface
from carom.env.game import Array, Game, Played, Rows
from carom.errors import CaromError
from carom.laws.registry import law_named
from carom.scene.toml import load_scene, replaced
from carom.simulation.records import FLOOR, WALL
from carom.simulation.simulate import simulate_many

HERE = Path(__file__).parent

# --- air hockey ---------------------------------------------------------------------------------------------------------

TABLE = np.array([1.0, 0.5])  # m, half of it
SPEED, FASTEST = 3.0, 20.0  # m/s: of a mallet along x and y; that is observed
GOAL, GOALS = 0.15, 7  # m, half of it; goals that win


class AirHockey(Game):
    """Air hockey: a mallet's velocity each 1/60 s; a goal is 1, or -1 against oneself; seven win, and 3,600 steps are a game.

    The puck (radius 31.5 mm, 30 g) slides without friction on 2 by 1 m; mallets (48 mm, 30 kg) stay in their halves. A single
    player plays against one that follows the puck. Observed from a player's own side, (12,): x, y (m), velocity (m/s) of the puck,
    the own mallet, the other one; x grows towards the other side. ``info``: ``goals``, ``against``.
    """

    shots, metadata = 3600, Game.metadata | {"render_fps": 60}
    bounds: ClassVar = {"vx": (-SPEED, SPEED), "vy": (-SPEED, SPEED)}

    def __init__(self, count: int = 1, **settings: Any) -> None:
        super().__init__(count, **settings)
        self.scene = replaced(load_scene(HERE / "air_hockey.toml"), {"run.law": self.law})
        self.step, (puck, mallet, _other) = self.scene.run.duration or 0.0, (ball.radius for ball in self.scene.balls)
        # (the puck passes between a mallet and the cushions, and between both mallets: nothing is pressed)
        (near, far), side = (mallet + 1.3 * puck, TABLE[0] - mallet - 2.05 * puck), TABLE[1] - mallet - 2.05 * puck
        self.reach = np.array([[[-far, -side], [-near, side]], [[near, -side], [far, side]]])
        self.high = np.tile([*(1.01 * TABLE), FASTEST, FASTEST], (3, 1))
        self.low = -self.high
        self.x, self.v, self.w = np.zeros((3, count, 3, 3))
        self.goals = np.zeros((count, 2), np.int64)

    def draw(self, row: int, rng: np.random.Generator) -> None:
        """Put mallets and puck on their places; the puck goes to a side that is drawn."""
        self.goals[row], self.w[row] = 0, 0.0
        self.x[row], self.v[row] = [ball.center for ball in self.scene.balls], 0.0
        self._face_off(row, float(rng.choice([-1.0, 1.0])))

    def _face_off(self, row: int, side: float) -> None:
        """Put the puck in the middle, towards the player on a side."""
        angle = self.rngs[row].uniform(-0.8, 0.8)
        self.x[row, 0], self.w[row, 0] = 0.0, 0.0
        self.v[row, 0] = side * np.cos(angle), np.sin(angle), 0.0

    def observe(self, rows: Rows) -> NDArray[np.float32]:
        """Return what the player whose turn it is sees, (n, 3, 4)."""
        sign = np.where(self.turn[rows] == 1, -1.0, 1.0)[:, None, None]
        order = np.where(self.turn[rows, None] == 1, [0, 2, 1], [0, 1, 2])[..., None]
        seen = sign * np.concatenate([self.x[rows, :, :2], self.v[rows, :, :2]], axis=-1)
        return np.asarray(np.clip(np.take_along_axis(seen, order, axis=1), self.low, self.high), np.float32)

    def follower(self, rows: Rows) -> Array:
        """Return the velocity (n, 2), from its own side, of one who follows the puck and strikes it where it is slow and near."""
        puck, own = -self.x[rows, 0, :2], -self.x[rows, 2, :2]
        speed = -self.v[rows, 0, :2]
        strikes = (puck[:, 0] < -0.1) & (np.hypot(*speed.T) < SPEED) & (puck[:, 0] > own[:, 0])
        wait = np.stack([np.full(len(rows), -0.75 * TABLE[0]), 0.6 * puck[:, 1]], axis=1)
        return np.asarray(np.clip((np.where(strikes[:, None], puck, wait) - own) / (4 * self.step), -SPEED, SPEED))

    def play(self, rows: Rows, actions: Array) -> Played:
        """Play a step of 1/60 s: velocities (n, 2) of the first player, or (n, 4) of both, each from the own side."""
        pushed = self.clipped(actions.reshape(-1, 2)).reshape(len(rows), -1)
        other = pushed[:, 2:] if self.players == 2 else self.follower(rows)
        x, v, w = self.x[rows], self.v[rows], self.w[rows]
        to = x[:, 1:, :2] + np.stack([pushed[:, :2], -other], axis=1) * self.step
        v[:, 1:, :2], w[:, 1:] = (np.clip(to, self.reach[:, 0], self.reach[:, 1]) - x[:, 1:, :2]) / self.step, 0.0
        self._last = rows, x, v, w
        runs = simulate_many(self.scene, v, w, x, events=8, kinds=("wall",))
        self.x[rows], self.v[rows], self.w[rows] = runs.final.position, runs.final.velocity, runs.final.spin
        log = runs.events
        wall = TABLE[0] - 1.001 * self.scene.balls[0].radius
        end = (log["kind"] > 0) & (log["ball"] == 0) & (np.abs(log["x"][..., 0]) > wall)
        goal = end & (np.abs(log["x"][..., 1]) < GOAL)
        scored = np.where(goal.any(axis=1), np.sign(log["x"][np.arange(len(rows)), goal.argmax(axis=1), 0]), 0.0)
        self.taken[rows] += 1
        for k in np.flatnonzero(scored).tolist():
            self.goals[rows[k], 0 if scored[k] > 0 else 1] += 1
            self._face_off(int(rows[k]), scored[k])
        ended = np.asarray((self.goals[rows] >= GOALS).any(axis=1))
        info = {"goals": self.goals[rows, 0], "against": self.goals[rows, 1]}
        return Played(scored, ended, ~ended & (self.taken[rows] >= self.most), info, scored)


# --- table tennis -------------------------------------------------------------------------------------------------------

END, SIDE = 1.37, 0.7625  # m: ITTF, The Laws of Table Tennis, 2.1
BAT = Surface(restitution=0.85, friction=1.0, tangential_restitution=0.3)  # of a sponge with rubber: an estimate
SERVES = np.array([[[1.0, -0.5, 0.15], [-9.0, -1.0, -1.0], [-20.0, -200.0, -60.0]],
                   [[1.4, 0.5, 0.4], [-4.0, 1.0, 2.0], [20.0, 200.0, 60.0]]])  # fmt: skip
SPEEDS, ANGLES = ((-1.0, 12.0), (-4.0, 4.0), (-6.0, 6.0)), ((-45.0, 45.0), (-60.0, 60.0))


class TableTennisReturn(Game):
    """Return balls that a machine serves: a point where the ball comes down on the machine's half first; ten balls.

    The ball flies in air (drag and lift of the law ``table-tennis``), bounces once on the player's half, and is met at x = -1.6 m.
    An action is the velocity of the bat there (m/s) and the direction of its face: degrees to the left, and up. Observed, (9,):
    place (m), velocity (m/s) and spin (rad/s) as the machine lets the ball go; x runs from the player to the machine, the top of
    the table is z = 0. ``law`` is that of the bat. ``info``: ``point``, ``x``, ``y`` (m): where the ball first comes down.
    """

    bounds: ClassVar = dict(zip(("vx", "vy", "vz", "left", "up"), SPEEDS + ANGLES, strict=True))
    low = -np.repeat([[2.0], [20.0], [300.0]], 3, axis=1)
    high = -low

    def __init__(self, count: int = 1, **settings: Any) -> None:
        super().__init__(count, **settings)
        if self.players > 1:
            raise CaromError("TableTennisReturn: players: expected 1, got 2: a machine serves")
        self.bat = law_named(self.law)
        self.serves = load_scene(HERE / "table_tennis.toml")
        self.scene = replaced(self.serves, {"walls": self.serves.walls[:1]})
        self.ball, (self.released, self.met) = self.scene.balls[0].ball, np.zeros((2, count, 3, 3))

    def draw(self, row: int, rng: np.random.Generator) -> None:
        """Serve: the first of balls drawn at random that bounces on the player's half and comes to the bat."""
        while True:
            x, v, w = np.moveaxis(rng.uniform(SERVES[0], SERVES[1], (16, 3, 3)), 1, 0)
            log = simulate_many(self.serves, v, w, x, events=2, kinds=("wall", "floor")).events
            at = log["x"]
            good = (
                (log["kind"] == np.array([FLOOR, WALL])).all(axis=1) & (log["other"][:, 1] == 1) & (at[:, 1, 2] > 0.1)
            )
            good &= (np.abs(at[:, 0, 0] + END / 2) < END / 2) & (np.abs(at[:, 0, 1]) < SIDE)
            for k in np.flatnonzero(good).tolist():
                self.released[row] = x[k], v[k], w[k]
                self.met[row] = log["x"][k, 1], log["v_before"][k, 1], log["w_before"][k, 1]
                return

    def observe(self, rows: Rows) -> NDArray[np.float32]:
        """Return place, velocity and spin of the balls as they are served, (n, 3, 3)."""
        return self.released[rows].astype(np.float32)

    def play(self, rows: Rows, actions: Array) -> Played:
        """Return a ball on each of some tables."""
        *bat, left, up = self.clipped(actions).T
        moves, (left, up) = np.stack(bat, axis=1), np.radians([left, up])
        face = np.stack([np.cos(up) * np.cos(left), np.cos(up) * np.sin(left), np.sin(up)], axis=1)
        x, v, w = np.moveaxis(self.met[rows], 1, 0)
        meets = ((v - moves) * face).sum(axis=1) < 0
        after = State(velocity=v.copy(), spin=w.copy())
        for k in np.flatnonzero(meets).tolist():  # (laws take one normal)
            come = State(velocity=v[k] - moves[k], spin=w[k])
            hit = self.bat(self.ball, come, wall=BAT, normal=face[k], height=1.0).after_wall
            after.velocity[k], after.spin[k] = hit.velocity + moves[k], hit.spin
        self._last = rows, x[:, None], after.velocity[:, None], after.spin[:, None]
        log = simulate_many(self.scene, after.velocity, after.spin, x, events=1, kinds=("floor",)).events
        down, at = meets & (log["kind"][:, 0] == FLOOR), log["x"][:, 0]
        point = down & (at[:, 0] > 0) & (at[:, 0] < END) & (np.abs(at[:, 1]) < SIDE)
        self.taken[rows] += 1
        ended = self.taken[rows] >= self.most
        for row in rows[~ended].tolist():
            self.draw(row, self.rngs[row])
        info = {"point": point, "x": np.where(down, at[:, 0], 0.0), "y": np.where(down, at[:, 1], 0.0)}
        reward = point.astype(float)
        return Played(reward, ended, np.zeros_like(ended), info, reward)
