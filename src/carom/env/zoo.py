"""PettingZoo's environments of two players: in turn at a table, or at the same time at air hockey."""

from __future__ import annotations

from typing import Any

import numpy as np
from gymnasium.spaces import Box
from gymnasium.utils import seeding
from numpy.typing import NDArray
from pettingzoo import AECEnv, ParallelEnv

from carom.env.gym import ONE, game_named, spaces_of
from carom.errors import CaromError

AGENTS = ["player_0", "player_1"]


class _Players:
    """What both kinds of environments have: spaces, seeds and words."""

    def __init__(self, game: str, render_mode: str | None = None, **settings: Any) -> None:
        self.game = game_named(game, 1, render_mode, players=2, **settings)
        named = {"name": f"carom_{game.lower()}_v0", "is_parallelizable": game == "AirHockey"}
        self.metadata = self.game.metadata | named
        self.render_mode, self.possible_agents, self.agents = render_mode, AGENTS[:], AGENTS[:]
        self._spaces = spaces_of(self.game)

    def observation_space(self, agent: str) -> Box:
        """Return the space of what a player observes."""
        return self._spaces[0]

    def action_space(self, agent: str) -> Box:
        """Return the space of a player's actions."""
        return self._spaces[1]

    def render(self) -> str | NDArray[np.uint8] | None:
        """Return the last shot in words, or as a picture, (high, 640, 3) bytes."""
        return self.game.shown(0, self.render_mode) if self.render_mode else None

    def close(self) -> None:
        """Do nothing: PettingZoo wants it beside ``render``."""

    def _begin(self, seed: int | None) -> None:
        if seed is not None or not hasattr(self, "_rng"):
            self._rng = seeding.np_random(seed)[0]
        self.game.begin(ONE, [self._rng])
        self.agents = self.possible_agents[:]

    def _seen_by(self, player: int) -> NDArray[np.float32]:
        turn, self.game.turn[0] = self.game.turn[0], player
        seen = np.asarray(self.game.seen(ONE)[0])
        self.game.turn[0] = turn
        return seen


class TurnPlayers(_Players, AECEnv[Any, Any, Any]):
    """Two players in turn, rewards of sum zero: :func:`two_players` makes it."""

    def reset(self, seed: int | None = None, options: dict[str, Any] | None = None) -> None:
        """Begin a new game."""
        self._begin(seed)
        self.rewards, self._cumulative_rewards = (dict.fromkeys(AGENTS, 0.0) for _ in range(2))
        self.terminations, self.truncations = (dict.fromkeys(AGENTS, False) for _ in range(2))
        self.infos: dict[str, dict[str, Any]] = {agent: {} for agent in AGENTS}
        self.agent_selection = AGENTS[0]

    def observe(self, agent: str) -> NDArray[np.float32]:
        """Return what a player sees."""
        return self._seen_by(AGENTS.index(agent))

    def step(self, action: Any) -> None:
        """Play a shot."""
        agent = self.agent_selection
        if self.terminations[agent] or self.truncations[agent]:
            self._was_dead_step(action)
            return
        played = self.game.play(ONE, np.asarray(action, dtype=float)[None])
        self._cumulative_rewards[agent] = 0.0
        for one in AGENTS:
            self.rewards[one] = float(played.against[0]) * (1 if one == agent else -1)
            self.terminations[one], self.truncations[one] = bool(played.ended[0]), bool(played.cut[0])
            self.infos[one] = {name: column[0] for name, column in played.info.items()} if one == agent else {}
        self.agent_selection = AGENTS[int(self.game.turn[0])]
        self._accumulate_rewards()


class ParallelPlayers(_Players, ParallelEnv[Any, Any, Any]):
    """Two players at the same time, rewards of sum zero: :func:`two_players` makes it."""

    def reset(
        self, seed: int | None = None, options: dict[str, Any] | None = None
    ) -> tuple[dict[str, Any], dict[str, Any]]:
        """Begin a new game."""
        self._begin(seed)
        return self._all_seen(), {agent: {} for agent in self.agents}

    def step(self, actions: dict[str, Any]) -> tuple[dict[str, Any], ...]:
        """Play a step."""
        played = self.game.play(ONE, np.concatenate([np.asarray(actions[agent], float) for agent in AGENTS])[None])
        won = {agent: float(played.against[0]) * (1 - 2 * k) for k, agent in enumerate(AGENTS)}
        ended, cut = (dict.fromkeys(AGENTS, bool(one[0])) for one in (played.ended, played.cut))
        self.agents = [] if ended[AGENTS[0]] or cut[AGENTS[0]] else self.agents
        return self._all_seen(), won, ended, cut, {agent: {} for agent in AGENTS}

    def _all_seen(self) -> dict[str, Any]:
        return {agent: self._seen_by(k) for k, agent in enumerate(AGENTS)}


def two_players(game: str, **settings: Any) -> TurnPlayers | ParallelPlayers:
    """Return PettingZoo's environment of a game for two: in turn an AECEnv, air hockey a ParallelEnv.

    Raises CaromError for a game of one player.

    Examples
    --------
    >>> import carom.env
    >>> env = carom.env.two_players("EightBall", law="mirror")
    >>> env.reset(seed=1)
    >>> env.agent_selection, env.observe("player_1").shape
    ('player_0', (48,))
    """
    if game == "TableTennisReturn":
        raise CaromError("two_players: expected a game for two, got TableTennisReturn, in which a machine serves")
    return (ParallelPlayers if game == "AirHockey" else TurnPlayers)(game, **settings)
