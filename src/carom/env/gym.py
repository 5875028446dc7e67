"""Gymnasium's environments of one table, and of many at once."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import gymnasium
import numpy as np
from gymnasium.utils import seeding
from gymnasium.vector.utils import batch_space

from carom.env.billiards import EightBall, SumToThree, ThreeCushion
from carom.env.game import Game
from carom.env.rackets import AirHockey, TableTennisReturn
from carom.errors import CaromError, did_you_mean

GAMES: dict[str, type[Game]] = {
    game.__name__: game for game in (ThreeCushion, EightBall, SumToThree, AirHockey, TableTennisReturn)
}


def game_named(name: str, count: int, mode: str | None, **settings: Any) -> Game:
    """Return a game on so many tables; CaromError with the nearest name where there is none, and for another render mode."""
    if mode not in (None, *Game.metadata["render_modes"]):
        raise CaromError(f"render_mode: expected ansi or rgb_array, got {mode!r}")
    if name not in GAMES:
        raise CaromError(f"game: expected one of {', '.join(GAMES)}, got {name!r}{did_you_mean(name, GAMES)}")
    return GAMES[name](count, **settings)


def spaces_of(game: Game) -> tuple[gymnasium.spaces.Box, gymnasium.spaces.Box]:
    """Return the spaces of observations and of actions of one table."""
    low, high = np.array(list(game.bounds.values()), np.float32).T
    seen = (game.low.ravel().astype(np.float32), game.high.ravel().astype(np.float32))
    return gymnasium.spaces.Box(*seen, dtype=np.float32), gymnasium.spaces.Box(low, high, dtype=np.float32)


class CaromEnv(gymnasium.Env[Any, Any]):
    """One table: ``gymnasium.make("carom/ThreeCushion-v0", law="mirror", shots=20)``.

    ``render()`` tells the last shot in words (``render_mode="ansi"``), or draws it ("rgb_array"). ``game`` is the :class:`Game`.
    """

    metadata = Game.metadata

    def __init__(self, game: str, render_mode: str | None = None, **settings: Any) -> None:
        self.game, self.render_mode = game_named(game, 1, render_mode, **settings), render_mode
        self.observation_space, self.action_space = spaces_of(self.game)
        self.metadata = self.game.metadata

    def reset(self, *, seed: int | None = None, options: dict[str, Any] | None = None) -> tuple[Any, dict[str, Any]]:
        """Begin a new game; return what is observed, and an empty dict."""
        super().reset(seed=seed)
        self.game.begin(ONE, [self.np_random])
        return self.game.seen(ONE)[0], {}

    def step(self, action: Any) -> tuple[Any, float, bool, bool, dict[str, Any]]:
        """Play; return what is observed, the reward, whether the game is over, whether it is cut off, and more of the shot."""
        played = self.game.play(ONE, np.asarray(action, dtype=float)[None])
        info = {name: column[0] for name, column in played.info.items()}
        return self.game.seen(ONE)[0], float(played.reward[0]), bool(played.ended[0]), bool(played.cut[0]), info

    def render(self) -> str | np.ndarray[Any, np.dtype[np.uint8]] | None:
        """Return the last shot in words, or as a picture, (high, 640, 3) bytes."""
        return self.game.shown(0, self.render_mode) if self.render_mode else None


class CaromVectorEnv(gymnasium.vector.VectorEnv[Any, Any, Any]):
    """Many tables, each with the same game as alone: ``gymnasium.make_vec("carom/ThreeCushion-v0", num_envs=1000)``.

    As Gymnasium's own: seed s is s + k on table k, and a table whose game is over begins anew in the next step. Whole numbers and
    arrays in ``info`` are columns, zero where a table begins anew.
    """

    def __init__(self, game: str, num_envs: int = 1, render_mode: str | None = None, **settings: Any) -> None:
        self.game, self.num_envs = game_named(game, num_envs, render_mode, **settings), num_envs
        self.metadata = self.game.metadata | {"autoreset_mode": gymnasium.vector.AutoresetMode.NEXT_STEP}
        self.render_mode = render_mode
        self.single_observation_space, self.single_action_space = spaces_of(self.game)
        self.observation_space = batch_space(self.single_observation_space, num_envs)
        self.action_space = batch_space(self.single_action_space, num_envs)
        self._over = np.ones(num_envs, bool)
        self._rows = np.arange(num_envs)

    def reset(
        self, *, seed: int | Sequence[int | None] | None = None, options: dict[str, Any] | None = None
    ) -> tuple[Any, dict[str, Any]]:
        """Begin anew on all tables."""
        tables = self._rows.tolist()
        seeds = seed if isinstance(seed, Sequence) else [None if seed is None else seed + k for k in tables]
        if len(seeds) != self.num_envs:
            raise CaromError(f"reset: seed: expected {self.num_envs} seeds, got {len(seeds)}")
        known = zip(seeds, self.game.rngs, strict=True)
        self.game.begin(self._rows, [rng if one is None else seeding.np_random(one)[0] for one, rng in known])
        self._over = np.zeros(self.num_envs, bool)
        return self.game.seen(self._rows), {}

    def step(self, actions: Any) -> tuple[Any, Any, Any, Any, dict[str, Any]]:
        """Play on all tables."""
        anew, rows = np.flatnonzero(self._over), np.flatnonzero(~self._over)
        self.game.begin(anew, [self.game.rngs[row] for row in anew.tolist()])
        reward, (ended, cut) = np.zeros(self.num_envs), np.zeros((2, self.num_envs), bool)
        info: dict[str, Any] = {}
        if len(rows):
            played = self.game.play(rows, np.asarray(actions, dtype=float)[rows])
            reward[rows], ended[rows], cut[rows] = played.reward, played.ended, played.cut
            for name, column in played.info.items():
                info[name], info[f"_{name}"] = np.zeros(self.num_envs, column.dtype), ~self._over
                info[name][rows] = column
        self._over = ended | cut
        return self.game.seen(self._rows), reward, ended, cut, info

    def render(self) -> tuple[Any, ...] | None:
        """Return the last shots in words, or as pictures."""
        return (
            tuple(self.game.shown(row, self.render_mode) for row in range(self.num_envs)) if self.render_mode else None
        )


ONE = np.zeros(1, np.int64)
